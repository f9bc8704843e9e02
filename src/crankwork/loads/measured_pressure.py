"""Measured cylinder pressure: from rows of angle and pressure to cycles and a closed diagram."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.curves import hermite, hermite_slope, monotone_slopes
from crankwork.loads.indicator import DiagramError, IndicatorDiagram, Segment
from crankwork.locale import ErrorMessage
from crankwork.units import UNITS

_GAP_FACTOR = 4.0
_SAME_ANGLE = 1e-6
_WRAP = 0.05
# other angles after which programs restart their count within a cycle [deg]
_OFTEN = {720.0: (360.0,), 360.0: (720.0,)}
# share of the range of pressures by which equal cycles differ at most
_EQUAL_CYCLES = 0.5
# samples of one cycle
FEWEST, _MOST = 8, 50_000
# shortest recorded part of a cycle if the rest is stated [deg]
_CLOSED = 60.0
# larger than any gas pressure [Pa]
_HIGHEST = 1e9
AMBIENT = 101325.0
_USUAL = ("MPa", "bar", "kPa", "Pa", "psi")
# greatest pressures and those before compression of machines [Pa], and share of the former below which these are gauge
_PEAKS, _LEVELS, _GAUGE = (3e5, 3e7), (2e4, 8e5), 0.003

# code of a notice and its values
NoticeData = tuple[str, Mapping[str, float | str]]


class Pegging(NamedTuple):
    """Reference of gauge pressures: a pressure at an angle, or an exponent between two angles. [deg], [Pa]"""

    angle: float = 0.0
    pressure: float = 0.0
    exponent: float | None = None
    start: float = 0.0
    end: float = 0.0


class Preprocessing(NamedTuple):
    """Requested treatment of samples, none by default. [deg], [Pa]"""

    cycle: str | int | None = None  # Which of several cycles, or their mean
    rest: float | None = None  # The pressure in the part of a cycle that was not recorded
    peg: Pegging | None = None
    smooth: float | None = None
    loss_angle: float | None = None  # Of a motored cycle, from its peak to top dead centre
    absolute: bool = False  # Whether pressures are absolute
    is_placed: bool = False  # Whether the angle from which they count is stated


AS_RECORDED = Preprocessing()


@dataclass(frozen=True)
class MeasuredPressure:
    """Pressure samples of one or more cycles, as recorded."""

    # Crank angles, continuous or restarting with every cycle, shape (n,) [deg], and pressures, shape (n,), or
    # (n, cycles) for cycles side by side [Pa]
    degrees: Array
    pressure: Array
    rows: Sequence[int]  # Line numbers of the samples in their file, for messages
    file: str = ""  # Name of that file, without its folder
    notices: tuple[NoticeData, ...] = ()  # How the file was read
    treatment: Preprocessing = AS_RECORDED
    reference: str = ""  # Whether the file says that its pressures are absolute, or gauge
    unit: str = ""  # Unit in which the pressures were read
    zero: float = 0.0  # Angle of the cycle from which the file says that it counts [deg]


class RecordedCycles(NamedTuple):
    """The cycles of a recording at the same crank angles, those of the file, shape (n,) and (cycles, n). [deg], [Pa]

    `rows` are the lines of the samples if there is one cycle; `wrap` is the pressure one cycle after the first sample
    less that of the first; `notices` say how the file was read.
    """

    degrees: Array
    cycles: Array
    rows: Sequence[int]
    wrap: float
    notices: tuple[NoticeData, ...] = ()


def recorded_cycles(
    measured: MeasuredPressure, cycle: float, *, step: float | None = None, path: str
) -> RecordedCycles:
    """Return the cycles of a recording, at the angles of the first or at every `step`. [deg]

    `path`: where a description states them.
    """
    key = f"{path}.measured"
    _check_size(measured, key)
    running = _running_on(measured, cycle, key)
    _check_angles(running, cycle, key)
    degrees = running.degrees
    start = degrees[0]
    typical = float(np.median(np.diff(degrees)))
    count = max(1, int((degrees[-1] - start + 1.5 * typical) // cycle))
    first = degrees[degrees < start + cycle - _SAME_ANGLE] - start
    offsets = first if step is None else np.asarray(step * np.arange(np.ceil(cycle / step - 1e-6)), float)
    if len(offsets) > _MOST:
        raise DiagramError(key, ErrorMessage("samples_many", count=len(offsets)))
    cycles = [row for column in running.pressure.T for row in _of_column(degrees, column, (cycle, count), offsets)]
    # resampled values are on no line
    rows = running.rows[: len(offsets)] if len(cycles) == 1 and step is None else ()
    return RecordedCycles(offsets + start, np.array(cycles), rows, _wrap_step(running, cycle), running.notices)


def _of_column(degrees: Array, pressure: Array, cycles: tuple[float, int], offsets: Array) -> Iterator[Array]:
    """Yield the pressures of each cycle of a column [Pa]; `cycles`: length, count; `offsets`: angles from its start."""
    (cycle, count), start = cycles, degrees[0]
    # a cycle recorded without its last angle is closed by its first sample
    keep = np.append(degrees < start + cycle * count - 1e-9, True)
    degrees = np.append(degrees, start + cycle * count)[keep]
    pressure = np.append(pressure, pressure[0])[keep]
    slopes = monotone_slopes(degrees, pressure, periodic=True)
    for number in range(count):
        yield hermite(degrees, pressure, slopes, start + number * cycle + offsets)


def _check_size(measured: MeasuredPressure, key: str) -> None:
    if len(measured.degrees) < FEWEST:
        raise DiagramError(key, ErrorMessage("samples_few", count=len(measured.degrees)))
    columns = measured.pressure.reshape(len(measured.degrees), -1)
    worst = int(np.argmax(np.max(np.abs(columns), axis=1)))
    largest = float(np.max(np.abs(columns[worst])))
    if largest > _HIGHEST:
        unit = likely_unit(largest / 60, measured.unit or "Pa")
        values = {"line": measured.rows[worst], "pressure": largest / 1e6, "unit": unit}
        raise DiagramError(key, ErrorMessage("samples_no_gas", **values))


def likely_unit(level: float, unit: str) -> str:
    """Return the unit that brings a level of pressures, read in another one, nearest to the surroundings. [Pa]"""
    number = level / UNITS[unit].factor
    return min(_USUAL, key=lambda name: abs(np.log(number * UNITS[name].factor / AMBIENT)))


def plausible_units(numbers: Array) -> list[str]:
    """Return the units in which numbers are pressures of a machine, the likeliest first; of none the nearest."""
    low, high = float(np.percentile(numbers, 10)), float(np.max(numbers))
    factors = {unit: UNITS[unit].factor for unit in (*_USUAL, "mbar", "kgf/cm2")}
    # around zero are gauge pressures
    is_gauge = low < _GAUGE * high
    suitable = [
        unit
        for unit, factor in factors.items()
        if _PEAKS[0] < high * factor < _PEAKS[1] and (is_gauge or _LEVELS[0] < low * factor < _LEVELS[1])
    ]
    level = high / 60 if is_gauge else low
    return sorted(suitable, key=lambda unit: abs(np.log(level * factors[unit] / AMBIENT))) or [
        likely_unit(max(level, 1e-6), "Pa")
    ]


def _running_on(measured: MeasuredPressure, cycle: float, key: str) -> MeasuredPressure:
    """Return samples with continuous angles and, if stated, the pressure of the part that was not recorded."""
    degrees, rows, rest = measured.degrees, np.asarray(measured.rows), measured.treatment.rest
    pressure = measured.pressure.reshape(len(degrees), -1)
    steps = np.diff(degrees)
    typical = float(np.median(steps))
    # angles of a recorded part of every cycle go back by most of this part
    shift, restarts = (cycle, -steps > 0.5 * np.ptp(degrees)) if rest is not None else _restarts(steps, cycle)
    notices = measured.notices
    turns = np.concatenate([[0], np.cumsum(restarts)])
    if shift < cycle and restarts.any():
        if _are_equal_turns(degrees, pressure, turns):
            raise DiagramError(key, ErrorMessage("samples_turns", line=int(rows[np.argmax(turns > 0)])))
        notices = (*notices, ("measured_turns", {"file": measured.file, "name": key}))
    degrees = degrees + shift * turns
    # drop a sample at the end of a cycle that is repeated at the beginning of the next
    keep = np.append(~(restarts & (np.diff(degrees) < _SAME_ANGLE)), True)
    degrees, pressure, rows, turns = degrees[keep], pressure[keep], rows[keep], turns[keep]
    if rest is not None:
        blocks = [turns == number for number in range(int(turns[-1]) + 1)]
        ends = [_with_rest(degrees[block], (cycle, typical)) for block in blocks]
        added = np.concatenate(ends)
        if min(float(np.ptp(degrees[block])) for block in blocks) < _CLOSED or not len(added):
            raise DiagramError(
                key, ErrorMessage("samples_rest", covered=float(np.ptp(degrees[blocks[0]])), cycle=cycle)
            )
        degrees = np.concatenate([degrees, added])
        pressure = np.concatenate([pressure, np.full((len(added), pressure.shape[1]), rest)])
        last = [rows[block][-1] for block, more in zip(blocks, ends, strict=True) for _ in more]
        rows = np.concatenate([rows, np.array(last, dtype=rows.dtype)])
        order = np.argsort(degrees, kind="stable")
        degrees, pressure, rows = degrees[order], pressure[order], rows[order]
    return replace(measured, degrees=degrees, pressure=pressure, rows=rows.tolist(), notices=notices)


def _restarts(steps: Array, cycle: float) -> tuple[float, NDArray[np.bool_]]:
    """Return after which angle the count restarts (cycle, turn or two cycles), and after which steps. [deg]"""
    typical = float(np.median(steps))
    for shift in (cycle, *_OFTEN.get(cycle, ())):
        restarts = (-steps > shift - 3 * typical) & (-steps < shift + typical / 2)
        if restarts.any():
            return shift, restarts
    return cycle, np.zeros(len(steps), dtype=bool)


def _are_equal_turns(degrees: Array, pressure: Array, turns: NDArray[np.intp]) -> bool:
    """Return whether the first two turns are equal cycles, not the two turns of four strokes."""
    (angles, pressures), (other_angles, other_pressures) = (
        (degrees[turns == number], pressure[turns == number, 0]) for number in (0, 1)
    )
    differences = np.abs(np.interp(angles, other_angles, other_pressures) - pressures)
    return float(differences.max()) < _EQUAL_CYCLES * float(np.ptp(pressure[:, 0]))


def _with_rest(degrees: Array, steps: tuple[float, float]) -> Array:
    """Return angles in the part of a cycle that was not recorded; `steps`: cycle and typical step. [deg]"""
    cycle, typical = steps
    left = degrees[0] + cycle - degrees[-1]
    return (
        degrees[-1] + typical + np.arange(0.0, left - 1.5 * typical, typical) if left > 2.5 * typical else degrees[:0]
    )


def closed_diagram(
    degrees: Array, pressure: Array, cycle: float, stated: tuple[Sequence[str], str]
) -> IndicatorDiagram:
    """Return a diagram from 0 to `cycle` through samples at any angles of one period. [deg], [Pa]

    `stated`: the source of each sample, and that of interpolated values.
    """
    places, file = stated
    degrees = np.asarray(np.round(np.mod(degrees, cycle), 9) % cycle)
    order = np.argsort(degrees)
    degrees, pressure = degrees[order], pressure[order]
    around = np.concatenate([[degrees[-1] - cycle], degrees, [degrees[0] + cycle]])
    values = np.concatenate([pressure[-1:], pressure, pressure[:1]])
    slopes = monotone_slopes(around[1:], values[1:], periodic=True)
    slopes = np.concatenate([slopes[-2:-1], slopes])
    curve = (around, values, slopes)
    inside = np.concatenate([[0.0], around[(around > 0) & (around < cycle)], [cycle]])
    values, slopes = hermite(*curve, inside), hermite_slope(*curve, inside)
    lines = {degree: places[index] for degree, index in zip(degrees.tolist(), order.tolist(), strict=True)}
    names = tuple(lines.get(angle % cycle, file) for angle in inside.tolist())
    return IndicatorDiagram((Segment(0.0, cycle, "rounded", inside, values, slopes, places=names),), {})


def _check_angles(measured: MeasuredPressure, cycle: float, key: str) -> None:
    degrees, rows = measured.degrees, measured.rows
    steps = np.diff(degrees)
    if np.any(steps <= 0):
        worst = int(np.argmax(steps <= 0))
        raise DiagramError(
            key,
            ErrorMessage("samples_backwards", line=rows[worst + 1], first=degrees[worst], second=degrees[worst + 1]),
        )
    typical = float(np.median(steps))
    if np.max(steps) > _GAP_FACTOR * typical:
        worst = int(np.argmax(steps))
        raise DiagramError(
            key,
            ErrorMessage(
                "samples_gap", line=rows[worst + 1], first=degrees[worst], second=degrees[worst + 1], step=typical
            ),
        )
    if float(degrees[-1] - degrees[0]) + 1.5 * typical < cycle:
        raise DiagramError(key, ErrorMessage("samples_short", covered=degrees[-1] - degrees[0], cycle=cycle))


def _wrap_step(measured: MeasuredPressure, cycle: float) -> float:
    """Return the pressure one cycle after the first sample less that of the first sample."""
    degrees, pressure = measured.degrees, measured.pressure[:, 0]
    end = degrees[0] + cycle
    if degrees[-1] >= end:
        after = float(np.interp(end, degrees, pressure))
    else:
        # the last row of a cycle is often left out: extrapolate
        slope = (pressure[-1] - pressure[-2]) / (degrees[-1] - degrees[-2])
        after = float(pressure[-1] + slope * (end - degrees[-1]))
    return after - float(pressure[0])


def wrap_is_rough(diagram: IndicatorDiagram, wrap: float) -> bool:
    """Return whether the step between end and start of the cycle is worth a warning."""
    return abs(wrap) > _WRAP * float(np.ptp(diagram.segments[0].pressures))
