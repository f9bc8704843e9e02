"""Measured cylinder pressure: from rows of angle and pressure to a closed diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import DiagramError, IndicatorDiagram, Segment
from crankwork.loads.monotone import hermite, hermite_slope, monotone_slopes
from crankwork.locale import Refusal

_GAP_FACTOR = 4.0
_SAME_ANGLE = 1e-6
_WRAP = 0.05


# what the reader should know: the code of a notice and its values
Told = tuple[str, Mapping[str, float | str]]


@dataclass(frozen=True)
class MeasuredPressure:
    """Pressure samples of one or more cycles, as recorded."""

    # Crank angles, rising throughout, and pressures, shape (n,) [deg], [Pa]
    degrees: Array
    pressure: Array
    rows: Sequence[int]  # Line numbers of the samples in their file, for messages
    file: str = ""  # Name of that file, without its folder
    told: tuple[Told, ...] = ()  # How the file was read


def measured_diagram(
    measured: MeasuredPressure, cycle: float, *, shift: float = 0.0, step: float | None = None, path: str = "gas"
) -> tuple[IndicatorDiagram, int, float]:
    """Return the closed diagram of measured pressure, how many cycles it averages, and its step from end to start. [Pa]

    `shift` is added to every angle, so that zero is top dead centre [deg]; without a `step` to resample at, the samples
    of the first cycle set the angles [deg]. `path`: where a description states the diagram.
    """
    _check_angles(measured, cycle, f"{path}.measured")
    file = f"{path}.measured.file"
    start, end = measured.degrees[0], measured.degrees[-1]
    typical = float(np.median(np.diff(measured.degrees)))
    cycles = max(1, int((end - start + 1.5 * typical) // cycle))
    wrap = _wrap_step(measured, cycle)
    first = measured.degrees[measured.degrees < start + cycle - _SAME_ANGLE] - start
    offsets = first if step is None else step * np.arange(np.ceil(cycle / step - 1e-6))
    # a cycle recorded without its last angle is closed by its first sample
    degrees = np.append(measured.degrees, start + cycle * cycles)
    pressure = np.append(measured.pressure, measured.pressure[0])
    keep = np.append(measured.degrees < start + cycle * cycles - 1e-9, True)
    degrees, pressure = degrees[keep], pressure[keep]
    slopes = monotone_slopes(degrees, pressure, periodic=True)
    samples = [hermite(degrees, pressure, slopes, start + number * cycle + offsets) for number in range(cycles)]
    # what is averaged or resampled stands on no line
    rows = measured.rows[: len(offsets)] if cycles == 1 and step is None else ()
    places = [f"{measured.file}:{row}" for row in rows] or [file] * len(offsets)
    return _closed(offsets + start + shift, np.mean(samples, axis=0), cycle, (places, file)), cycles, wrap


def _closed(degrees: Array, pressure: Array, cycle: float, stated: tuple[Sequence[str], str]) -> IndicatorDiagram:
    """Return a diagram from 0 to `cycle` through samples at any angles of one period.

    `stated`: the line of each sample, and the key of their file.
    """
    places, file = stated
    degrees = np.asarray(np.round(np.mod(degrees, cycle), 9) % cycle)
    order = np.argsort(degrees)
    degrees, pressure = degrees[order], pressure[order]
    lines = {degree: places[at] for degree, at in zip(degrees.tolist(), order.tolist(), strict=True)}
    around = np.concatenate([[degrees[-1] - cycle], degrees, [degrees[0] + cycle]])
    values = np.concatenate([pressure[-1:], pressure, pressure[:1]])
    slopes = monotone_slopes(around[1:], values[1:], periodic=True)
    slopes = np.concatenate([slopes[-2:-1], slopes])
    curve = (around, values, slopes)
    inside = np.concatenate([[0.0], around[(around > 0) & (around < cycle)], [cycle]])
    values, slopes = hermite(*curve, inside), hermite_slope(*curve, inside)
    names = tuple(lines.get(one % cycle, file) for one in inside.tolist())
    return IndicatorDiagram((Segment(0.0, cycle, "rounded", inside, values, slopes, places=names),), {})


def _check_angles(measured: MeasuredPressure, cycle: float, key: str) -> None:
    degrees, rows = measured.degrees, measured.rows
    if len(degrees) < 8:
        raise DiagramError(key, Refusal("samples_few", count=len(degrees)))
    steps = np.diff(degrees)
    if np.any(steps <= 0):
        worst = int(np.argmax(steps <= 0))
        raise DiagramError(
            key,
            Refusal("samples_backwards", line=rows[worst + 1], first=degrees[worst], second=degrees[worst + 1]),
        )
    typical = float(np.median(steps))
    if np.max(steps) > _GAP_FACTOR * typical:
        worst = int(np.argmax(steps))
        raise DiagramError(
            key,
            Refusal(
                "samples_gap",
                line=rows[worst + 1],
                first=degrees[worst],
                second=degrees[worst + 1],
                step=typical,
            ),
        )
    covered = float(degrees[-1] - degrees[0]) + 1.5 * typical
    if covered < cycle:
        raise DiagramError(
            key,
            Refusal("samples_short", covered=degrees[-1] - degrees[0], cycle=cycle),
        )


def _wrap_step(measured: MeasuredPressure, cycle: float) -> float:
    """Return the pressure one cycle after the first sample less that of the first sample."""
    degrees, pressure = measured.degrees, measured.pressure
    end = degrees[0] + cycle
    if degrees[-1] >= end:
        after = float(np.interp(end, degrees, pressure))
    else:
        # the last row of a cycle is often left out; carry on as the samples before it go
        slope = (pressure[-1] - pressure[-2]) / (degrees[-1] - degrees[-2])
        after = float(pressure[-1] + slope * (end - degrees[-1]))
    return after - float(measured.pressure[0])


def wrap_is_rough(diagram: IndicatorDiagram, wrap: float) -> bool:
    """Return whether the step between end and start of the cycle is worth a warning."""
    pressures = diagram.segments[0].pressures
    return abs(wrap) > _WRAP * float(np.ptp(pressures))
