"""Where a knuckle pin must stand for an articulated rod to compress as much as the master rod."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from crankwork.cylinders.articulated import ArticulatedRod, slave_stroke
from crankwork.errors import GeometryError, MethodError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank, rod_swing

PARTS = ("knuckle_angle", "knuckle_radius", "length")

# Where the angle of a knuckle pin is looked for, to both sides of the one that reaches farthest. [deg]
_REACH, _STEPS = 30.0, 60
_BISECTIONS, _SECANTS = 60, 30


@formula("compression_ratio", "lukanin_shatrov_2007, ch. 1")
def compression_ratio_of_lengths(stroke: Value, h_c: Value) -> Value:
    """Compression ratio from stroke and height of the clearance, both for the same piston area."""
    return 1 + stroke / h_c


def farthest_knuckle_angle(lengths: SliderCrank, rod: ArticulatedRod) -> float:
    """Return the knuckle angle at which crank, knuckle and rod come into line at top dead centre.

    A rod as long as the master rod less the knuckle radius then reaches exactly as far as the master rod.

    Parameters
    ----------
    lengths : SliderCrank
        Crank and master rod. [m]
    rod : ArticulatedRod
        The articulated rod; its knuckle angle is not used.

    Returns
    -------
    float
        Axis of the cylinder plus the angle of the master rod at that instant. [deg]
    """
    straight = math.degrees(math.asin(rod.offset / (lengths.crank_radius + rod.knuckle_radius + rod.length)))
    swing = rod_swing(lengths, CrankGrid.from_degrees(np.array([rod.axis + straight])))
    return rod.axis + straight + math.degrees(math.atan2(swing.sin[0], swing.cos[0]))


def compression_ratio_of_slave(lengths: SliderCrank, rod: ArticulatedRod, compression_ratio: float) -> float:
    """Return the compression ratio of an articulated rod whose cylinder head stands as far out as the master's.

    Parameters
    ----------
    lengths : SliderCrank
        Crank and master rod. [m]
    rod : ArticulatedRod
        The articulated rod.
    compression_ratio : float
        Of the master cylinder. [-]

    Returns
    -------
    float
        Compression ratio. [-]

    Raises
    ------
    GeometryError
        If its piston would meet the head.
    """
    slave = slave_stroke(lengths, rod)
    clearance = _head(lengths, compression_ratio) - slave.top
    if clearance <= 0:
        raise GeometryError(
            f"the piston of the articulated rod runs {-clearance * 1e3:.6g} mm into the head; shorten its rod"
        )
    return float(compression_ratio_of_lengths(slave.stroke, clearance))


def _top(lengths: SliderCrank) -> float:
    """Return the distance of the master's piston pin at its top dead centre. [m]"""
    r, l, e = lengths  # noqa: E741
    return math.sqrt((r + l - e) * (r + l + e))


def _head(lengths: SliderCrank, compression_ratio: float) -> float:
    return _top(lengths) + float(lengths.stroke) / (compression_ratio - 1)


def corrected_rod(
    lengths: SliderCrank, rod: ArticulatedRod, part: str = "knuckle_angle", compression_ratio: float = math.inf
) -> ArticulatedRod:
    """Return the articulated rod, one dimension changed so that it compresses as much as the master rod.

    Parameters
    ----------
    lengths : SliderCrank
        Crank and master rod. [m]
    rod : ArticulatedRod
        The articulated rod to change.
    part : str
        knuckle_angle, knuckle_radius or length.
    compression_ratio : float
        To be had in both cylinders; infinite asks for equal distances at top dead centre instead. [-]

    Returns
    -------
    ArticulatedRod
        The changed rod; of several knuckle angles the one nearest to the given.

    Raises
    ------
    GeometryError
        If no knuckle angle does it, with the length that the rod is short of.

    References
    ----------
    taylor_1985, ch. 8.
    """
    if part not in PARTS:
        raise MethodError(f"{part} of an articulated rod cannot be corrected; write {', '.join(PARTS)}")
    share = 1 / (compression_ratio - 1)
    wanted = _top(lengths) + float(lengths.stroke) * share

    def surplus(value: float) -> float:
        changed = rod._replace(**{part: value})
        slave = slave_stroke(lengths, changed)
        return slave.top + share * slave.stroke - wanted

    if part != "knuckle_angle":
        return rod._replace(**{part: _secant(surplus, getattr(rod, part), 1e-3 * rod.length)})
    return rod._replace(knuckle_angle=_knuckle_angle(surplus, lengths, rod, compares_tops=share == 0))


def _secant(surplus: Callable[[float], float], start: float, step: float) -> float:
    one, other = start, start + step
    at_one, at_other = surplus(one), surplus(other)
    for _ in range(_SECANTS):
        if at_other in (0.0, at_one):
            break
        one, other, at_one = other, other - at_other * (other - one) / (at_other - at_one), at_other
        at_other = surplus(other)
    return other


def _knuckle_angle(
    surplus: Callable[[float], float], lengths: SliderCrank, rod: ArticulatedRod, *, compares_tops: bool
) -> float:
    """Return the angle nearest to that of the rod at which it reaches as far as wanted."""
    farthest = farthest_knuckle_angle(lengths, rod)
    reach = lengths.crank_radius + lengths.rod_length
    if compares_tops and abs(surplus(farthest)) <= 1e-12 * reach:
        return farthest
    angles = farthest + np.linspace(-_REACH, _REACH, _STEPS + 1)
    values = np.array([surplus(float(one)) for one in angles])
    at = np.flatnonzero(values[:-1] * values[1:] < 0)
    if not at.size:
        # the two angles have met where it reaches farthest
        least = float(angles[int(np.argmax(values))])
        best = _largest(surplus, least - 1.0, least + 1.0) if values.max() < 0 else least
        best = farthest if surplus(farthest) >= surplus(best) else best
        if abs(surplus(best)) <= 1e-12 * reach:
            return best
        raise GeometryError(
            f"no knuckle angle makes the articulated rod compress as much as the master rod: at "
            f"{best:.4g} deg it misses {-surplus(best) * 1e3:.6g} mm; change its length by that, or its knuckle radius"
        )
    found = [_bisected(surplus, float(angles[one]), float(angles[one + 1])) for one in at]
    return min(found, key=lambda angle: abs(angle - rod.knuckle_angle))


def _bisected(surplus: Callable[[float], float], low: float, high: float) -> float:
    is_below = surplus(low) < 0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if (surplus(middle) < 0) == is_below else (low, middle)
    return (low + high) / 2


def _largest(surplus: Callable[[float], float], low: float, high: float) -> float:
    """Return where a value with one maximum is largest, by thirds."""
    for _ in range(_BISECTIONS):
        third = (high - low) / 3
        low, high = (low + third, high) if surplus(low + third) < surplus(high - third) else (low, high - third)
    return (low + high) / 2
