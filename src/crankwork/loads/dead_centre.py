"""Checks of the top dead centre of measured pressure: peak, work and compression line."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.polynomial.polynomial import polyder, polyfit, polyval

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import VolumeAt
from crankwork.loads.measured import NoticeData

_TURN = 360.0
# largest distance of the peak from top dead centre: four strokes; two, where delivery may begin early [deg]
_NEAR = {720.0: 40.0, 360.0: 100.0}
_EXPONENTS = (1.2, 1.45)
# part of the compression with closed valves and without combustion, before top dead centre [deg]
_COMPRESSION = (90.0, 20.0)
# around the peak of a motored cycle [deg]
_PEAK = 12.0
_FEWEST = 8
# share of the largest volume below which the smallest volume has no clearance
_NO_CLEARANCE = 1e-3
# search range of the dead centre [deg]
_FARTHEST = 6.0
# errors that bend a compression line too: offset of the pressure [Pa], change of the exponent
_OFF, _CHANGE = 5e3, 0.05


def contradictions(
    samples: tuple[Array, Array],
    volume_at: VolumeAt,
    where: tuple[float, float],
    *,
    shift: float,
    loss_angle: float | None,
) -> Iterator[NoticeData]:
    """Yield notices on peak, work and compression line that contradict the dead centre. [deg], [Pa]

    `samples`: crank angles and absolute pressures; `where`: cycle and top dead centre; `shift`: added already;
    `loss_angle`: from the peak of a motored cycle to top dead centre.
    """
    degrees, pressure = samples
    cycle, top = where
    peak = float(degrees[np.argmax(pressure)])
    distance = (peak - top + _TURN / 2) % _TURN - _TURN / 2
    if abs(distance) > _NEAR[cycle]:
        yield "peak_far", {"angle": peak % cycle, "apart": abs(distance)}
        return
    centre = peak - distance
    if loss_angle is not None:
        yield from _by_peak(samples, cycle, (centre - loss_angle, peak), shift)
        return
    if cycle < 2 * _TURN:
        return
    volume = volume_at(np.mod(np.append(degrees, degrees[0]), cycle))
    if float((pressure + np.roll(pressure, -1)) @ np.diff(volume)) < 0:
        yield "work_negative", {}
    yield from _by_compression(samples, volume_at, (cycle, centre), shift)


def _by_peak(
    samples: tuple[Array, Array], cycle: float, where: tuple[float, float], shift: float
) -> Iterator[NoticeData]:
    """Yield a shift from the peak of a motored cycle; `where`: expected and actual peak. [deg]"""
    expected, peak = where
    x, y = _between(samples, cycle, peak - _PEAK, peak + _PEAK)
    if len(x) < _FEWEST:
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
    samples: tuple[Array, Array], volume_at: VolumeAt, where: tuple[float, float], shift: float
) -> Iterator[NoticeData]:
    """Yield an unusual exponent of the compression, and the shift that makes its line straight. [deg]"""
    cycle, centre = where
    x, y = _between(samples, cycle, centre - _COMPRESSION[0], centre - _COMPRESSION[1])
    ends = volume_at(np.array([centre, centre + _TURN / 2]) % cycle)
    if len(x) < _FEWEST or float(y.min()) <= 2 * _OFF or ends[0] < _NO_CLEARANCE * ends[1]:
        return

    def line(offset: float, off: float = 0.0) -> tuple[float, float, float, float]:
        """Return exponent and bend of the line, the error of the bend, and half of its length."""
        along = np.log(volume_at(np.mod(x + offset, cycle)))
        half = float(np.ptp(along)) / 2
        basis = np.vander(along - along.mean(), 3, increasing=True)
        inverse = np.linalg.pinv(basis)
        curve = inverse @ np.log(y + off)
        noise = float(np.sum((basis @ curve - np.log(y + off)) ** 2)) / (len(x) - 3)
        return -float(curve[1]), float(curve[2]), float(np.sqrt(noise) * np.linalg.norm(inverse[2])), half

    exponent, _, error, half = line(0.0)
    if not _EXPONENTS[0] <= exponent <= _EXPONENTS[1]:
        yield "exponent_odd", {"exponent": exponent, "low": _EXPONENTS[0], "high": _EXPONENTS[1]}
    correction = _straight(lambda offset: line(offset)[1])
    if correction is None:
        return
    rate = (line(correction + 0.1)[1] - line(correction - 0.1)[1]) / 0.2
    offs = [abs(line(correction, off)[1] - line(correction)[1]) for off in (-_OFF, _OFF)]
    yield from _proposed(
        "dead_centre_compression", correction, (2 * error + max(offs) + _CHANGE / 4 / half) / abs(rate), shift
    )


def _straight(bend: Callable[[float], float]) -> float | None:
    """Return the zero of a function by bisection, None if there is none nearby. [deg]"""
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
    """Return the samples between two angles, in ascending order from the first angle on. [deg], [Pa]"""
    degrees, pressure = samples
    after = np.mod(degrees - start, cycle)
    order = np.argsort(after)
    order = order[after[order] <= end - start]
    return start + after[order], pressure[order]


def _proposed(code: str, more: float, error: float, shift: float) -> Iterator[NoticeData]:
    """Yield a shift if it is larger than its uncertainty. [deg]"""
    if abs(more) > error:
        yield code, {"shift": round(shift + more, 2), "error": error}
