"""Measured pressure treated as requested: choice of the cycle, pegging, smoothing; checks of data and phase."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple, cast

import numpy as np
from numpy.polynomial.polynomial import polyder, polyfit, polyval
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import DiagramError, IndicatorDiagram, VolumeAt
from crankwork.loads.measured_pressure import (
    AMBIENT,
    MeasuredPressure,
    NoticeData,
    Pegging,
    Preprocessing,
    RecordedCycles,
    closed_diagram,
    likely_unit,
    recorded_cycles,
    wrap_is_rough,
)
from crankwork.locale import ErrorMessage

# notices that a description has to answer
QUESTIONS = ("measured_strokes", "measured_centre", "measured_reversed", "measured_constant")
# lower than any gauge pressure [Pa]
_VACUUM = -110e3
_EVEN = 1e-3
# share of the largest volume below which the smallest volume has no clearance
_NO_CLEARANCE = 1e-3
_FEWEST = 5
# share of the range by which a single sample may differ from its neighbours, and share by which these may differ
_SPIKE, _NEIGHBOURS = 0.25, 0.2
# at low pressure: share of the pressure, least share of the range, multiple of the median difference
_LOW, _LEAST, _RARE = 0.5, 0.01, 50.0
_TURN = 360.0
# largest distance of the peak from top dead centre: four strokes; two, where delivery may begin early [deg]
_NEAR = {720.0: 40.0, 360.0: 100.0}
_EXPONENTS = (1.2, 1.45)
# part of the compression with closed valves and without combustion, before top dead centre [deg]
_COMPRESSION = (90.0, 20.0)
# around the peak of a motored cycle [deg]
_PEAK = 12.0
_FEWEST_POINTS = 8
# where the peak of a fired or motored cycle may stand, from top dead centre [deg]
PEAKS = (-15, 40)
# share of the range above which delivery goes on, and how long it takes at least [deg]
_DELIVERY, _DELIVERED = 0.7, 50.0
# how long what is left expands at most, usual exponents, and the least shift that is told [deg]
_EXPANSION, _EXPANDING, _SMALLEST = 80.0, (0.9, 1.6), 3.0
# how much longer a compressor takes to compress than to expand what is left
_SLOWLY = 1.5
# how near an angle must come to a quarter of a turn to be one [deg]
_QUARTER = 15.0
# change over a cycle that is none, by the greatest pressure
_CONSTANT = 0.02
# lines that a notice lists
_MOST_LINES = 5
# errors that bend a compression line too: offset of the pressure [Pa], change of the exponent
_OFF, _CHANGE = 5e3, 0.045
# offset that is reported, over the pressure at the start, and how far from that of the surroundings it is theirs [Pa]
_LEVEL, _SURE = 0.3, 40e3
# most work of a driven cylinder over its stroke and greatest pressure
_DRIVEN = 0.04


class PressureReference(NamedTuple):
    """Reference of the samples: volume at crank angles of the machine, and top dead centre if known."""

    volume_at: VolumeAt  # [deg] -> [m3]
    top: float | None = None  # [deg]
    has_strokes: bool = False  # Whether a cycle of 720 degrees begins at the top dead centre before intake


def measured_diagram(
    measured: MeasuredPressure, cycle: float, around: PressureReference, *, shift: float, step: float | None, path: str
) -> tuple[IndicatorDiagram, list[NoticeData]]:
    """Return the closed diagram of measured pressure, and notices about it. [Pa]

    `shift` is added to every angle, so that zero is top dead centre [deg]; without a `step` to resample at, the samples
    of the first cycle set the angles [deg]. `path`: where a description states the diagram.
    """
    treatment, key = measured.treatment, f"{path}.measured"
    recorded, degrees, offsets = treated_cycles(measured, cycle, around.volume_at, shift=shift, step=step, path=path)
    notices = [*recorded.notices, *_spikes(measured)]
    volume, cycles = around.volume_at(np.mod(degrees, cycle)), recorded.cycles
    if treatment.peg is not None:
        notices.append(("pressure_pegged", {"step": float(offsets.mean())}))
    notices += _spread(cycles, volume)
    pressure = _chosen(cycles, treatment.cycle, f"{key}.cycle", notices)
    stated = f"{key}.cycle" if len(cycles) > 1 else f"{key}.peg" if treatment.peg else f"{key}.file"
    if treatment.smooth is not None:
        before, pressure = pressure, _smooth(degrees, pressure, (cycle, treatment.smooth), f"{key}.smooth")
        stated = f"{key}.smooth"
        window, peaks = treatment.smooth, (float(before.max()) / 1e6, float(pressure.max()) / 1e6)
        notices.append(("pressure_smoothed", {"window": window, "before": peaks[0], "after": peaks[1]}))
    _check_vacuum(pressure, measured, key)
    is_raw = stated.endswith("file") and len(recorded.rows) > 0
    places = [f"{measured.file}:{row}" for row in recorded.rows] if is_raw else [stated] * len(degrees)
    diagram = closed_diagram(degrees, pressure, cycle, (places, stated))
    if treatment.rest is None and wrap_is_rough(diagram, recorded.wrap):
        notices.append(("wrap", {"step": recorded.wrap}))
    if around.top is not None:
        # a wrong sample tells nothing of the dead centre
        smooth = _without_spikes(pressure)
        absolute = smooth if treatment.absolute else smooth + AMBIENT
        against = contradictions((degrees, absolute), around, cycle, measured, shift=shift)
        questions = list[NoticeData]()
        if not treatment.is_placed:
            questions += _other_strokes((degrees, absolute), around, cycle, shift)
        notices += [(code, {**values, "name": key}) for code, values in questions or against]
    return diagram, notices


def treated_cycles(
    measured: MeasuredPressure, cycle: float, volume_at: VolumeAt, *, shift: float, step: float | None, path: str
) -> tuple[RecordedCycles, Array, Array]:
    """Return the cycles of a recording with their pegs, the crank angles of the machine, and the offsets added.

    Arguments as those of `measured_diagram`. [deg], [Pa]
    """
    recorded = recorded_cycles(measured, cycle, step=step, path=path)
    degrees, offsets = recorded.degrees + shift, np.zeros(len(recorded.cycles))
    if measured.treatment.peg is not None:
        where, key = np.mod(degrees, cycle), f"{path}.measured.peg"
        offsets = _offsets(recorded.cycles, degrees, volume_at(where), measured.treatment.peg, (cycle, key))
    return recorded._replace(cycles=recorded.cycles + offsets[:, None]), degrees, offsets


def _other_strokes(
    samples: tuple[Array, Array], around: PressureReference, cycle: float, shift: float
) -> Iterator[NoticeData]:
    """Yield a pressure that does not change, a peak far from the dead centre, or angles against the rotation."""
    degrees, pressure = samples
    own, least, highest = f"{shift:g} deg", float(np.min(pressure)), float(np.max(pressure))
    if highest - least < _CONSTANT * highest:
        yield "measured_constant", {"low": least / 1e6, "high": highest / 1e6, "own": own}
        return
    top = around.top or 0.0
    # a chamber may fire in either turn
    period, centre = (cycle, top + _TURN) if around.has_strokes else (_TURN, top)
    high = pressure > least + _DELIVERY * (highest - least)
    steps = np.diff(np.append(degrees, degrees[0] + cycle))
    # a compressor delivers over a part of its stroke, takes the work that an engine gives, and compresses slowly
    sign = -1 if cycle == _TURN and float(steps[high].sum()) > _DELIVERED else 1
    middle = ~high & (pressure > least + (1 - _DELIVERY) * (highest - least))
    rises = np.roll(pressure, -1) > pressure
    is_slow = float(steps[middle & ~rises].sum()) > _SLOWLY * float(steps[middle & rises].sum())
    near = _NEAR[2 * _TURN if sign > 0 else _TURN]

    def work(both: tuple[Array, Array], more: float) -> float:
        """Return the work after a shift over that of the greatest pressure, positive as it should be."""
        volume = around.volume_at(np.mod(np.append(both[0], both[0][0]) + more, cycle))
        done = float((both[1] + np.roll(both[1], -1)) @ np.diff(volume)) / 2
        return sign * done / (float(np.ptp(volume)) * highest)

    def placed(both: tuple[Array, Array]) -> tuple[float, float, bool]:
        """Return how late the peak is, the shift that puts it in place, and whether that is by the compression."""
        late = centred(float(both[0][np.argmax(both[1])]) - centre, period)
        if sign < 0:
            # delivery ends at the dead centre
            end = float(both[0][_end_of(both[1] > least + _DELIVERY * (highest - least))])
            return late, _quarter(-centred(end - centre, period), _QUARTER), False
        return late, *_moved(both, around.volume_at, (cycle, centre), late, near)

    mirrored = (-degrees[::-1], pressure[::-1])
    (late, more, is_known), (_, back, is_known_back) = placed(samples), placed(mirrored)
    is_near, gained = abs(late) <= near, work(mirrored, back)
    # one that is driven takes little work for its peak
    is_against = is_slow if sign < 0 else work(samples, more) < -_DRIVEN < gained
    is_against |= sign > 0 and is_known_back and not is_known and gained > _DRIVEN
    if is_near and not is_against and work(samples, 0.0) >= -_DRIVEN:
        return
    if is_against or (is_near and abs(more) < 1):
        # angles that are counted against the rotation have the shift that is there with the other sign
        turned = "" if abs(back - 2 * shift) < 2 else f', shift = "{_wrapped(back - shift):g} deg"'
        yield "measured_reversed", {"lines": f"reversed = true{turned}", "own": own}
        return
    angles = {"angle": _in_cycle(late + centre, cycle), "firing": _in_cycle(centre, cycle)}
    code = "measured_strokes" if cycle > _TURN and around.has_strokes else "measured_centre"
    yield code, {**angles, "turned": f"{_wrapped(shift + more):g} deg", "own": own}


def _moved(
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], late: float, near: float
) -> tuple[float, bool]:
    """Return the shift that puts a peak in place, and whether it is by the compression; arguments as below. [deg]"""
    correction = _straightest(samples, volume_at, where, late)
    return _quarter(-late, near) if correction is None else _quarter(correction, 2.0), correction is not None


def centred(degrees: float, period: float) -> float:
    """Return an angle between minus and plus half of a period. [deg]"""
    return (degrees + period / 2) % period - period / 2


def _quarter(degrees: float, near: float) -> float:
    """Return an angle as a multiple of a right angle if it is near to one, else rounded. [deg]"""
    quarters = round(degrees / 90) * 90.0
    return quarters if abs(degrees - quarters) <= near else float(round(degrees))


def _end_of(high: NDArray[np.bool_]) -> int:
    """Return the index of the last sample of the longest run within a closed cycle."""
    ends = np.flatnonzero(high & ~np.roll(high, -1))
    starts = np.flatnonzero(high & ~np.roll(high, 1))
    return int(max(ends, key=lambda end: np.min((end - starts) % len(high))))


def _straightest(
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], late: float
) -> float | None:
    """Return the shift after which the line of compression is straight in logarithms, None if there is none. [deg]

    `where`: cycle and dead centre of firing; `late`: how far from there the peak is.
    """
    shifts = np.arange(math.ceil(PEAKS[0] - late), math.floor(PEAKS[1] - late) + 1.0)
    windows = [_compressed(samples, where, shift) for shift in shifts.tolist()]
    # the volumes of all of them at once
    ends = np.cumsum([len(x) for x, _ in windows])[:-1]
    volumes = np.split(volume_at(np.mod(np.concatenate([x for x, _ in windows]), where[0])), ends)
    lines = [_line(volume, y) if _is_long(y) else None for volume, (_, y) in zip(volumes, windows, strict=True)]
    candidates = []
    for shift, line, after in zip(shifts.tolist(), lines, lines[1:], strict=False):
        if line is None or after is None or line.bend * after.bend > 0:
            continue
        if all(_EXPONENTS[0] <= either.exponent <= _EXPONENTS[1] for either in (line, after)):
            candidates.append((line.noise, shift + line.bend / (line.bend - after.bend or 1.0)))
    least = 2 * min((noise for noise, _ in candidates), default=0.0)
    return min((exact for noise, exact in candidates if noise <= least), key=abs, default=None)


class _Compression(NamedTuple):
    """The line of compression in logarithms: exponent, bend and its error, scatter, half of its length."""

    exponent: float
    bend: float
    error: float
    noise: float
    half: float


def _compression(
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], shift: float, off: float = 0.0
) -> _Compression | None:
    """Return the line of compression of pressures after a shift [deg] and with an offset [Pa]; None if too short."""
    x, y = _compressed(samples, where, shift)
    return _line(volume_at(np.mod(x, where[0])), y + off) if _is_long(y + off) else None


def _compressed(samples: tuple[Array, Array], where: tuple[float, float], shift: float) -> tuple[Array, Array]:
    """Return the samples that a shift [deg] puts on the line of compression. [deg], [Pa]"""
    x, y = _between(samples, where[0], *(where[1] - before - round(shift) for before in _COMPRESSION))
    return x + shift, y


def _is_long(pressure: Array) -> bool:
    return len(pressure) >= _FEWEST_POINTS and float(pressure.min()) > 0


def _line(volume: Array, pressure: Array) -> _Compression:
    """Return the line of compression or expansion through samples. [m3], [Pa]"""
    along = np.log(volume)
    basis = np.vander(along - along.mean(), 3, increasing=True)
    inverse, logarithms = np.linalg.pinv(basis), np.log(pressure)
    curve = inverse @ logarithms
    noise = float(np.sqrt(np.sum((basis @ curve - logarithms) ** 2) / (len(along) - 3)))
    error = noise * float(np.linalg.norm(inverse[2]))
    return _Compression(-float(curve[1]), float(curve[2]), error, noise, float(np.ptp(along)) / 2)


def _in_cycle(degrees: float, cycle: float) -> float:
    """Return a crank angle within the cycle, without what rounding leaves of zero. [deg]"""
    return round(degrees % cycle, 6) % cycle


def _spikes(measured: MeasuredPressure) -> Iterator[NoticeData]:
    """Yield notices of samples that differ from both neighbours, the worst of each column first."""
    for pressure in measured.pressure.reshape(len(measured.degrees), -1).T:
        off = _off(pressure)
        if np.any(off):
            worst = np.argsort(-off)[: min(_MOST_LINES, int(np.sum(off > 0)))]
            lines = ", ".join(str(measured.rows[line]) for line in worst.tolist())
            yield "pressure_spike", {"line": lines, "step": float(pressure[worst[0]]), "count": float(np.sum(off > 0))}


def _without_spikes(pressure: Array) -> Array:
    return np.where(_off(pressure) > 0, (np.roll(pressure, 1) + np.roll(pressure, -1)) / 2, pressure)


def peak_angle(measured: MeasuredPressure) -> float:
    """Return the angle of the greatest pressure, as it is recorded. [deg]"""
    pressure = measured.pressure.reshape(len(measured.degrees), -1).mean(axis=1)
    return float(measured.degrees[np.argmax(_without_spikes(pressure))])


def _off(pressure: Array) -> Array:
    """Return how far samples that stand alone are from the mean of their neighbours, 0 for all others. [Pa]"""
    middle = np.median(np.stack([pressure[:-2], pressure[1:-1], pressure[2:]]), axis=0)
    off = np.abs(pressure[1:-1] - (pressure[:-2] + pressure[2:]) / 2)
    neighbours = np.abs(pressure[:-2] + pressure[2:]) / 2
    # at low pressure, compared with the pressure and with the usual difference
    low = (off > _LOW * neighbours) & (off > _LEAST * np.ptp(middle)) & (off > _RARE * np.median(off))
    alone = ((off > _SPIKE * np.ptp(middle)) | low) & (np.abs(pressure[2:] - pressure[:-2]) < _NEIGHBOURS * off)
    return np.concatenate([[0.0], np.where(alone, off, 0.0), [0.0]])


def _offsets(cycles: Array, degrees: Array, volume: Array, peg: Pegging, cycle_and_key: tuple[float, str]) -> Array:
    """Return the offset of each cycle that gives it the stated pressure or exponent. [Pa]"""
    cycle, key = cycle_and_key
    if peg.exponent is None:
        angles = np.mod(degrees, cycle)
        return peg.pressure - np.array([np.interp(peg.angle % cycle, angles, row, period=cycle) for row in cycles])
    if np.min(volume) < _NO_CLEARANCE * np.max(volume):
        raise DiagramError(key, ErrorMessage("gas_volume"))
    inside = np.mod(degrees - peg.start, cycle) <= peg.end - peg.start
    if np.sum(inside) < _FEWEST:
        raise DiagramError(key, ErrorMessage("peg_few", count=int(np.sum(inside)), fewest=_FEWEST))
    # p + offset = constant V^-n
    polytrope = (volume[inside] / volume[inside].mean()) ** -peg.exponent
    system = np.stack([polytrope, -np.ones_like(polytrope)], axis=1)
    return np.asarray(np.linalg.lstsq(system, cycles[:, inside].T)[0][1])


def _spread(cycles: Array, volume: Array) -> Iterator[NoticeData]:
    """Yield how much peak pressure and work differ from cycle to cycle. [%]"""
    if len(cycles) < 2:
        return
    peaks = cycles.max(axis=1)
    closed = np.concatenate([cycles, cycles[:, :1]], axis=1)
    work = (closed[:, 1:] + closed[:, :-1]) @ np.diff(np.append(volume, volume[0])) / 2
    means = [float(abs(np.mean(values))) for values in (peaks, work)]
    shares = [
        float(np.std(values, ddof=1)) / mean if mean else 0.0 for values, mean in zip((peaks, work), means, strict=True)
    ]
    varies = [round(100 * share, 6) for share in shares]
    yield "cycles_spread", {"cycles": float(len(cycles)), "peak": varies[0], "work": varies[1]}


def _chosen(cycles: Array, which: str | int | None, key: str, notices: list[NoticeData]) -> Array:
    """Return one of the cycles, or their mean, as stated. [Pa]"""
    count = len(cycles)
    if which is None and count > 1:
        raise DiagramError(key.removesuffix(".cycle"), ErrorMessage("samples_cycles", cycles=str(count)))
    if which == "mean" and count > 1:
        notices.append(("cycles_averaged", {"cycles": count}))
        return np.asarray(np.mean(cycles, axis=0))
    peaks = cycles.max(axis=1)
    index = {"least peak": int(peaks.argmin()), "greatest peak": int(peaks.argmax())}.get(str(which), 0)
    if isinstance(which, int):
        if which > count:
            raise DiagramError(key, ErrorMessage("samples_cycle", number=str(which), cycles=str(count)))
        index = which - 1
    if count > 1:
        notices.append(("cycle_chosen", {"number": float(index + 1), "cycles": float(count)}))
    return np.asarray(cycles[index])


def _smooth(degrees: Array, pressure: Array, cycle_and_window: tuple[float, float], key: str) -> Array:
    """Return samples smoothed by the cubic filter of Savitzky and Golay. [Pa]"""
    cycle, window = cycle_and_window
    steps = np.diff(np.append(degrees, degrees[0] + cycle))
    typical = float(np.median(steps))
    if np.max(np.abs(steps - typical)) > _EVEN * typical:
        raise DiagramError(key, ErrorMessage("smooth_uneven", step=f"{typical:.3g} deg"))
    half = round(window / typical / 2)
    if 2 * half + 1 < _FEWEST:
        raise DiagramError(key, ErrorMessage("smooth_short", count=2 * half + 1, window=f"{4 * typical:.3g} deg"))
    along = np.arange(-half, half + 1) / half
    weights = np.linalg.pinv(np.vander(along, 4, increasing=True))[0]
    closed = np.take(pressure, np.arange(-half, len(pressure) + half), mode="wrap")
    return np.convolve(closed, weights, mode="valid")


def _check_vacuum(pressure: Array, measured: MeasuredPressure, key: str) -> None:
    least = float(pressure.min())
    if least >= (0.0 if measured.treatment.absolute else _VACUUM):
        return
    columns = measured.pressure.reshape(len(measured.degrees), -1)
    line = measured.rows[int(np.argmin(columns.min(axis=1)))]
    if measured.treatment.peg is not None:
        peg = _peg_line(_TURN, absolute=measured.treatment.absolute)
        raise DiagramError(f"{key}.peg", ErrorMessage("peg_vacuum", line=line, pressure=least / 1e6, peg=peg))
    name = "measured_vacuum" if measured.treatment.absolute else "measured_vacuum_gauge"
    raise DiagramError(key, ErrorMessage(name, line=line, pressure=least / 1e6))


def contradictions(
    samples: tuple[Array, Array],
    around: PressureReference,
    cycle: float,
    measured: MeasuredPressure,
    *,
    shift: float,
) -> Iterator[NoticeData]:
    """Yield notices on peak, work and compression line that contradict what is stated. [deg], [Pa]

    `samples`: crank angles and absolute pressures; `shift`: added already.
    """
    (degrees, pressure), volume_at, top = samples, around.volume_at, around.top or 0.0
    loss_angle = measured.treatment.loss_angle
    peak = float(degrees[np.argmax(pressure)])
    distance = (peak - top + _TURN / 2) % _TURN - _TURN / 2
    if abs(distance) > _NEAR[cycle]:
        # firing is a turn after the beginning of four strokes
        period, centre = (cycle, top + _TURN) if around.has_strokes else (_TURN, top)
        more, _ = _moved(samples, volume_at, (cycle, centre), centred(peak - centre, period), _NEAR[cycle])
        yield "peak_far", {"angle": _in_cycle(peak, cycle), "apart": abs(distance), "shift": _wrapped(shift + more)}
        return
    centre = peak - distance
    if loss_angle is not None:
        yield from _by_peak(samples, cycle, (centre - loss_angle, peak), shift)
        return
    if cycle < 2 * _TURN:
        # the greatest pressure of a compressor is some ten times the least
        yield from _unit_of(float(np.max(pressure)) / 10, measured.unit, spread=50.0)
        yield from _by_expansion(samples, volume_at, (cycle, centre), shift)
        return
    volume = volume_at(np.mod(np.append(degrees, degrees[0]), cycle))
    if float((pressure + np.roll(pressure, -1)) @ np.diff(volume)) < 0:
        yield "work_negative", {}
    yield from _by_compression(samples, volume_at, (cycle, centre), measured, shift=shift)


def _by_peak(
    samples: tuple[Array, Array], cycle: float, where: tuple[float, float], shift: float
) -> Iterator[NoticeData]:
    """Yield a shift from the peak of a motored cycle; `where`: expected and actual peak. [deg]"""
    expected, peak = where
    x, y = _between(samples, cycle, peak - _PEAK, peak + _PEAK)
    if len(x) < _FEWEST_POINTS:
        return
    x, scale = (x - peak) / _PEAK, float(np.max(np.abs(y)))
    fits = []
    for degree in (4, 6):
        if len(x) <= degree + 1:
            break
        curve = polyfit(x, y / scale, degree)
        basis = np.vander(x, degree + 1, increasing=True)
        noise = float(np.sum((basis @ curve - y / scale) ** 2)) / (len(x) - degree - 1)
        slope, bend = polyder(curve), polyder(curve, 2)
        maximum = 0.0
        for _ in range(8):
            maximum -= float(polyval(maximum, slope) / polyval(maximum, bend))
        if not abs(maximum) < 1:
            return
        gradient = np.array([k * maximum ** (k - 1) if k else 0.0 for k in range(degree + 1)])
        error = float(np.sqrt(noise * (gradient @ np.linalg.pinv(basis.T @ basis) @ gradient)))
        fits.append((maximum, abs(error / float(polyval(maximum, bend)))))
    (maximum, error), (other, _) = fits[0], fits[-1]
    yield from _proposed(
        "dead_centre_motored", expected - peak - maximum * _PEAK, _PEAK * (2 * error + abs(other - maximum)), shift
    )


def _by_compression(
    samples: tuple[Array, Array],
    volume_at: VolumeAt,
    where: tuple[float, float],
    measured: MeasuredPressure,
    *,
    shift: float,
) -> Iterator[NoticeData]:
    """Yield what makes the line of compression straight: another unit or reference of pressures, or a shift. [deg]"""
    cycle, centre = where
    x, y = _between(samples, cycle, centre - _COMPRESSION[0], centre - _COMPRESSION[1])
    ends = volume_at(np.array([centre, centre + _TURN / 2]) % cycle)
    if len(x) < _FEWEST_POINTS or float(y.min()) <= 2 * _OFF or ends[0] < _NO_CLEARANCE * ends[1]:
        # the greatest pressure of an engine is some sixty times that before compression
        yield from _unit_of(float(np.max(samples[1])) / 60, measured.unit, spread=15.0)
        return

    def line(shift: float, off: float = 0.0) -> _Compression:
        """Return the line of compression, which has samples enough."""
        return cast("_Compression", _compression(samples, volume_at, where, shift, off))

    own = line(0.0)
    correction = _straightest(samples, volume_at, where, float(samples[0][np.argmax(samples[1])]) - centre)
    offset = _zero(lambda off: line(0.0, off).bend, -0.99 * float(y.min()), 0.5 * float(y.max()))
    # the straighter line tells which of them is wrong
    by_shift = math.inf if correction is None else line(correction).noise
    by_offset = math.inf if offset is None else line(0.0, offset).noise
    is_known, is_offset = by_shift < by_offset / 2, by_offset < by_shift / 2
    moved, offset = (correction or 0.0, 0.0) if is_known else (0.0, offset or 0.0)
    exponent = line(moved, offset).exponent
    x, y = _between(samples, cycle, centre - _COMPRESSION[0] - moved, centre)
    start = (float(y[0]) + offset) * float(volume_at(np.mod(x[:1] + moved, cycle))[0] / ends[1]) ** exponent
    odd = [*_unit_of(start, measured.unit, spread=4.0)]
    if not odd and abs(offset) > _LEVEL * start and _EXPONENTS[0] <= exponent <= _EXPONENTS[1]:
        odd = [_level_of(offset, measured.treatment, centre)]
    if odd:
        yield from odd
        return
    if not _EXPONENTS[0] <= own.exponent <= _EXPONENTS[1] and not is_known:
        yield "exponent_odd", {"exponent": own.exponent, "low": _EXPONENTS[0], "high": _EXPONENTS[1]}
    if correction is None or is_offset:
        return
    rate = (line(correction + 0.1).bend - line(correction - 0.1).bend) / 0.2
    offs = [abs(line(correction, off).bend - line(correction).bend) for off in (-_OFF, _OFF) if not is_known] or [0.0]
    uncertain = 2 * line(correction).error + max(offs) + _CHANGE / 4 / own.half
    yield from _proposed("dead_centre_compression", correction, uncertain / abs(rate), shift)


def _unit_of(level: float, unit: str, *, spread: float) -> Iterator[NoticeData]:
    """Yield another unit for pressures whose level is far from that of the surroundings. [Pa]"""
    if unit and not 1 / spread < level / AMBIENT < spread:
        yield "pressure_unit_odd", {"step": level, "unit": likely_unit(level, unit)}


def _level_of(offset: float, treatment: Preprocessing, centre: float) -> NoticeData:
    """Return the notice of pressures that count from elsewhere than stated. [Pa]"""
    stated, other = ("absolute", "gauge") if treatment.absolute else ("gauge", "absolute")
    if treatment.peg is None and abs(offset - (AMBIENT if treatment.absolute else -AMBIENT)) < _SURE:
        return "pressures_other", {"stated": stated, "other": other}
    return "pressure_level", {"step": offset, "peg": _peg_line(centre, absolute=treatment.absolute)}


def _peg_line(centre: float, *, absolute: bool) -> str:
    """Return the usual pegging, to the line of compression or to the pressure at its beginning; `centre`: its end."""
    if absolute:
        return f'peg = {{ exponent = 1.32, from = "{centre - 90:g} deg", to = "{centre - 30:g} deg" }}'
    return f'peg = {{ angle = "{centre - 180:g} deg", pressure = "0 bar" }}'


def _wrapped(degrees: float) -> float:
    """Return an angle between minus one and one turn. [deg]"""
    return _TURN - (_TURN - degrees) % (2 * _TURN) or 0.0


def _zero(bend: Callable[[float], float], low: float, high: float) -> float | None:
    """Return the zero of a function by bisection, None if there is none between two ends."""
    at_low, least = bend(low), 1e-5 * (high - low)
    if at_low * bend(high) > 0:
        return None
    while high - low > least:
        middle = (low + high) / 2
        if bend(middle) * at_low > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _between(samples: tuple[Array, Array], cycle: float, start: float, end: float) -> tuple[Array, Array]:
    """Return the samples between two angles, in ascending order from the first angle on. [deg], [Pa]"""
    degrees, pressure = samples
    after = np.mod(degrees - start, cycle)
    order = np.argsort(after)
    order = order[after[order] <= end - start]
    return start + after[order], pressure[order]


def _by_expansion(
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], shift: float
) -> Iterator[NoticeData]:
    """Yield a shift after which what a compressor has left expands along a straight line in logarithms. [deg]"""
    (degrees, pressure), (cycle, centre) = samples, where
    least, size = float(np.min(pressure)), float(np.ptp(pressure))
    high = pressure > least + _DELIVERY * size
    if float(np.diff(np.append(degrees, degrees[0] + cycle))[high].sum()) <= _DELIVERED:
        return
    end = centre + centred(float(degrees[_end_of(high)]) - centre, _TURN)
    x, y = _between(samples, cycle, end, end + _EXPANSION)
    last = int(np.argmin(np.append(y > least + (1 - _DELIVERY) / 2 * size, False)))
    if last < _FEWEST_POINTS or least <= 0:
        return
    shifts = np.arange(max(-_EXPANSION / 2, math.ceil(centre - x[0])), _EXPANSION / 2)
    lines = [_line(volume_at(np.mod(x[:last] + more, cycle)), y[:last]) for more in shifts]
    candidates = []
    for more, line, after in zip(shifts.tolist(), lines, lines[1:], strict=False):
        rate = after.bend - line.bend
        if line.bend * after.bend <= 0 < -rate and _EXPANDING[0] <= line.exponent <= _EXPANDING[1]:
            candidates.append((more - line.bend / rate, (2 * line.error + _CHANGE / 4 / line.half) / -rate))
    for more, error in sorted(candidates, key=lambda item: abs(item[0]))[:1]:
        yield from _proposed("dead_centre_expansion", more, max(error, _SMALLEST), shift)


def _proposed(code: str, more: float, error: float, shift: float) -> Iterator[NoticeData]:
    """Yield a shift if it is larger than its uncertainty. [deg]"""
    if abs(more) > error:
        yield code, {"shift": round(shift + more, 2), "error": error}
