"""What measured pressure says about the dead centre that its angles count from."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import VolumeAt
from crankwork.loads.measured import Told

_TURN = 360.0
# where the peak of four strokes lies, and that of two, whose delivery may begin early [deg]
_NEAR = {720.0: 40.0, 360.0: 100.0}
_EXPONENTS = (1.2, 1.45)
# part of the compression without valves and burning, before top dead centre [deg]
_COMPRESSION = (90.0, 20.0)
# around the peak of a motored cycle [deg]
_PEAK = 12.0
_FEWEST = 8
# share of the largest volume below which the least one is without that of the clearance
_NO_CLEARANCE = 1e-3
# how far a dead centre is looked for [deg]
_FARTHEST = 6.0
# what bends a compression line although its dead centre is right: a pressure that is off [Pa], an exponent that changes
_OFF, _CHANGE = 5e3, 0.05


def contradictions(
    samples: tuple[Array, Array],
    volume_at: VolumeAt,
    where: tuple[float, float],
    *,
    shift: float,
    loss_angle: float | None,
) -> Iterator[Told]:
    """Yield what peak, work and compression line say against the dead centre, and what shift they propose. [deg], [Pa]

    `samples`: crank angles and absolute pressures; `where`: cycle and top dead centre; `shift`: what was added already;
    `loss_angle`: from the peak of a motored cycle to top dead centre.
    """
    degrees, pressure = samples
    cycle, top = where
    peak = float(degrees[np.argmax(pressure)])
    apart = (peak - top + _TURN / 2) % _TURN - _TURN / 2
    if abs(apart) > _NEAR[cycle]:
        yield "peak_far", {"angle": peak % cycle, "apart": abs(apart)}
        return
    centre = peak - apart
    if loss_angle is not None:
        yield from _by_peak(samples, cycle, (centre - loss_angle, peak), shift)
        return
    if cycle < 2 * _TURN:
        return
    volume = volume_at(np.mod(np.append(degrees, degrees[0]), cycle))
    if float((pressure + np.roll(pressure, -1)) @ np.diff(volume)) < 0:
        yield "work_negative", {}
    yield from _by_compression(samples, volume_at, (cycle, centre), shift)


def _by_peak(samples: tuple[Array, Array], cycle: float, where: tuple[float, float], shift: float) -> Iterator[Told]:
    """Yield what the peak of a motored cycle says, `where` it should be and is. [deg]"""
    wanted, peak = where
    x, y = _between(samples, cycle, peak - _PEAK, peak + _PEAK)
    if len(x) < _FEWEST:
        return
    x, scale = (x - peak) / _PEAK, float(np.max(np.abs(y)))
    found = []
    for degree in (4, 6):
        if len(x) <= degree + 1:
            break
        curve = np.polynomial.polynomial.polyfit(x, y / scale, degree)
        basis = np.vander(x, degree + 1, increasing=True)
        noise = float(np.sum((basis @ curve - y / scale) ** 2)) / (len(x) - degree - 1)
        slope, bend = np.polynomial.polynomial.polyder(curve), np.polynomial.polynomial.polyder(curve, 2)
        at = 0.0
        for _ in range(8):
            at -= float(np.polynomial.polynomial.polyval(at, slope) / np.polynomial.polynomial.polyval(at, bend))
        if not abs(at) < 1:
            return
        gradient = np.array([k * at ** (k - 1) if k else 0.0 for k in range(degree + 1)])
        error = float(np.sqrt(noise * (gradient @ np.linalg.pinv(basis.T @ basis) @ gradient)))
        found.append((at, abs(error / float(np.polynomial.polynomial.polyval(at, bend)))))
    (at, error), (other, _) = found[0], found[-1]
    yield from _proposed(
        "dead_centre_motored", wanted - peak - at * _PEAK, _PEAK * (2 * error + abs(other - at)), shift
    )


def _by_compression(
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], shift: float
) -> Iterator[Told]:
    """Yield what the exponent of the compression says, and the shift that makes its line straight. [deg]"""
    cycle, centre = where
    x, y = _between(samples, cycle, centre - _COMPRESSION[0], centre - _COMPRESSION[1])
    ends = volume_at(np.array([centre, centre + _TURN / 2]) % cycle)
    if len(x) < _FEWEST or float(y.min()) <= 2 * _OFF or ends[0] < _NO_CLEARANCE * ends[1]:
        return

    def line(by: float, off: float = 0.0) -> tuple[float, float, float, float]:
        """Return exponent and bend of the line, the error of the bend, and half of its length."""
        along = np.log(volume_at(np.mod(x + by, cycle)))
        half = float(np.ptp(along)) / 2
        basis = np.vander(along - along.mean(), 3, increasing=True)
        inverse = np.linalg.pinv(basis)
        curve = inverse @ np.log(y + off)
        noise = float(np.sum((basis @ curve - np.log(y + off)) ** 2)) / (len(x) - 3)
        return -float(curve[1]), float(curve[2]), float(np.sqrt(noise) * np.linalg.norm(inverse[2])), half

    exponent, _, error, half = line(0.0)
    if not _EXPONENTS[0] <= exponent <= _EXPONENTS[1]:
        yield "exponent_odd", {"exponent": exponent, "low": _EXPONENTS[0], "high": _EXPONENTS[1]}
    found = _straight(lambda by: line(by)[1])
    if found is None:
        return
    rate = (line(found + 0.1)[1] - line(found - 0.1)[1]) / 0.2
    offs = [abs(line(found, off)[1] - line(found)[1]) for off in (-_OFF, _OFF)]
    yield from _proposed(
        "dead_centre_compression", found, (2 * error + max(offs) + _CHANGE / 4 / half) / abs(rate), shift
    )


def _straight(bend: Callable[[float], float]) -> float | None:
    """Return where a bend vanishes, None if it does not nearby. [deg]"""
    low, high = -_FARTHEST, _FARTHEST
    at_low = bend(low)
    if at_low * bend(high) > 0:
        return None
    while high - low > 1e-4:
        middle = (low + high) / 2
        if bend(middle) * at_low > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _between(samples: tuple[Array, Array], cycle: float, start: float, end: float) -> tuple[Array, Array]:
    """Return samples between two angles, in their order, at angles from the first on. [deg], [Pa]"""
    degrees, pressure = samples
    after = np.mod(degrees - start, cycle)
    order = np.argsort(after)
    order = order[after[order] <= end - start]
    return start + after[order], pressure[order]


def _proposed(code: str, more: float, error: float, shift: float) -> Iterator[Told]:
    """Yield a shift that is worth proposing: one that is larger than what is uncertain about it. [deg]"""
    if abs(more) > error:
        yield code, {"shift": round(shift + more, 2), "error": error}
