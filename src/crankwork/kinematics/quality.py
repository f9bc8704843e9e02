"""How good a linkage is: whether the crank turns, limits and stroke of an output, time ratio, transmission angle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.extremes import closed_in
from crankwork.kinematics.motion import direction
from crankwork.kinematics.placement import Placed, assembled, place
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import RPR, RRP, RRR, Dyad
from crankwork.mechanism.mechanism import Mechanism

FourBarType = Literal["crank-rocker", "double crank", "double rocker", "rocker-crank", "triple rocker", "change point"]
_SCAN = 1440
_ZOOMS = 8


class Grashof(NamedTuple):
    """The type of a four-bar linkage, and p + q - s - l: positive if its shortest link turns fully. [m]"""

    type: FourBarType
    margin: float


def grashof(crank: float, coupler: float, rocker: float, ground: float) -> Grashof:
    """Return the type of a four-bar linkage (norton_2012, ch. 2).

    Type and margin; `change point` where the links can all come into line. `crank`, `coupler`, `rocker` and `ground`:
    the lengths; the crank is the link that drives [m].
    """
    lengths = (crank, coupler, rocker, ground)
    shortest, longest = min(lengths), max(lengths)
    margin = sum(lengths) - 2 * shortest - 2 * longest
    if abs(margin) <= 1e-12 * longest:
        return Grashof("change point", 0.0)
    if margin < 0:
        return Grashof("triple rocker", margin)
    types: tuple[FourBarType, ...] = ("crank-rocker", "double rocker", "rocker-crank", "double crank")
    return Grashof(types[lengths.index(shortest)], margin)


class Limits(NamedTuple):
    """Where an output turns back over one revolution of the crank.

    Crank angles [deg] and the output there [m] or [rad], arrays of shape (k,); largest less smallest.
    """

    degrees: Array
    position: Array
    travel: float


def limits(mechanism: Mechanism, output: str) -> Limits:
    """Return the dead positions of an output, and its stroke or swing.

    Where the first transfer function is zero; empty for a link that turns fully. `output`: name of a sliding piece,
    or of a link.
    """
    return limits_of_all(mechanism, [output])[0]


def limits_of_all(mechanism: Mechanism, outputs: Sequence[str]) -> list[Limits]:
    """Return the dead positions of several outputs, found together."""
    grid = CrankGrid.from_degrees(np.linspace(0.0, 360.0, _SCAN + 1))
    scanned = assembled(mechanism, grid)
    coarse = [_output(scanned, one) for one in outputs]
    rates = np.stack([one.position_1 for one in coarse])
    which, left = np.nonzero(np.sign(rates[:, :-1]) * np.sign(rates[:, 1:]) < 0)

    def rate(degrees: Array) -> Array:
        different, where = np.unique(degrees, return_inverse=True)
        there = place(mechanism, CrankGrid.from_degrees(different))
        return np.stack([_output(there, one).position_1 for one in outputs])[which, where]

    found = np.empty(0)
    if left.size:
        found = closed_in(rate, grid.degrees[left], grid.degrees[left + 1], rates[which, left], rates[which, left + 1])
    zeros = [np.concatenate([grid.degrees[:-1][rates[at, :-1] == 0], found[which == at]]) for at in range(len(outputs))]
    every = np.unique(np.concatenate(zeros))
    placed = place(mechanism, CrankGrid.from_degrees(every)) if every.size else scanned
    return [
        _limits(np.sort(at), one, placed, every, known) for at, one, known in zip(zeros, outputs, coarse, strict=True)
    ]


def _limits(degrees: Array, output: str, placed: Placed, every: Array, coarse: Transfer) -> Limits:
    """Return the dead positions of an output at some of the angles at which a mechanism is placed."""
    if not degrees.size:
        return Limits(degrees, degrees, abs(float(coarse.position[-1] - coarse.position[0])))
    found = _output(placed, output).position[np.searchsorted(every, degrees)]
    if output not in placed.sliders:
        scanned = np.interp(degrees, np.linspace(0.0, 360.0, _SCAN + 1), coarse.position)
        found = found + math.tau * np.rint((scanned - found) / math.tau)
    return Limits(degrees, found, float(np.ptp(found)))


def _output(placed: Placed, output: str) -> Transfer:
    if output in placed.sliders:
        return placed.sliders[output]
    if output in placed.links:
        return direction(placed.grid, placed.links[output])
    raise GeometryError(f"{output} is not an output; there is {', '.join([*placed.sliders, *placed.links])}")


def time_ratio(mechanism: Mechanism, output: str) -> float:
    """Return the time of the slower stroke over that of the faster one, at constant crank speed. [-]

    `output`: name of a sliding piece or link with two dead positions. Source: artobolevsky_1988, ch. 27.
    """
    found = limits(mechanism, output)
    if found.degrees.size != 2:
        raise GeometryError(
            f"{output} has {found.degrees.size} dead positions in a turn of the crank; a time ratio needs two"
        )
    return stroke_ratio(found)


def stroke_ratio(found: Limits) -> float:
    """Return the time of the slower stroke over that of the faster one, between two dead positions. [-]"""
    way = float(found.degrees[1] - found.degrees[0])
    return max(way, 360.0 - way) / min(way, 360.0 - way)


def transmission_angle(mechanism: Mechanism, group: int, grid: CrankGrid) -> Array:
    """Return the transmission angle of a dyad (norton_2012, ch. 2, 4). [deg]

    RRR: angle between the links, from 0 to 180 degrees. RRP: angle between the link and the normal of the guide, from
    0 to 90; 90 less it is the pressure angle. RPR: always 90 degrees.
    """
    return np.degrees(_transmission(mechanism.dyads[group], assembled(mechanism, grid)))


def _transmission(dyad: Dyad | Chain, placed: Placed) -> Array:
    """Return the transmission angle of a placed dyad. [rad]"""
    match dyad:
        case RRR():
            one, other = placed.links[dyad.link_a], placed.links[dyad.link_b]
        case RRP():
            one, other = placed.links[dyad.link], placed.links[dyad.piece]
        case RPR():
            return np.full(placed.grid.angle.shape, math.pi / 2)
        case _:
            raise GeometryError("a transmission angle is defined for RRR, RRP and RPR dyads; ask for another group")
    sine, cosine = one.cos * other.sin - one.sin * other.cos, one.cos * other.cos + one.sin * other.sin
    found = np.arctan2(np.abs(sine), cosine) if isinstance(dyad, RRR) else np.arctan2(np.abs(cosine), np.abs(sine))
    # links between points that do not move have one angle only
    return np.broadcast_to(found, placed.grid.angle.shape)


def pressure_angle(mechanism: Mechanism, group: int, grid: CrankGrid) -> Array:
    """Return the pressure angle of a dyad, by which the force departs from the way of the driven link. [deg]

    Departure of the transmission angle from 90 degrees.
    """
    return np.abs(90.0 - transmission_angle(mechanism, group, grid))


class Extremes(NamedTuple):
    """Least and greatest value over a turn, and the crank angles at which they occur. [deg]"""

    least: float
    least_at: float
    greatest: float
    greatest_at: float


def transmission_extremes(mechanism: Mechanism, groups: Sequence[int]) -> list[Extremes]:
    """Return the least and greatest transmission angles over a turn of the crank.

    What surrounds the least and greatest angles of a scan is looked at ever closer, of all dyads at once: to place the
    mechanism for each of them would take a time that grows with the square of their number.
    """
    dyads, sign = [mechanism.dyads[one] for one in groups], np.array([[1.0], [-1.0]])

    def values(placed: Placed) -> Array:
        return np.stack([np.degrees(_transmission(one, placed)) for one in dyads])

    scanned = assembled(mechanism, CrankGrid.from_degrees(np.linspace(0.0, 360.0, _SCAN + 1)))
    at = scanned.grid.degrees[np.argmin(sign[..., None] * values(scanned), axis=-1)]
    width, best = 360.0 / _SCAN, np.zeros_like(at)
    for _ in range(_ZOOMS):
        windows = at[..., None] + width * np.linspace(-1.0, 1.0, 9)
        degrees, where = np.unique(windows, return_inverse=True)
        found = values(place(mechanism, CrankGrid.from_degrees(degrees)))
        inside = np.take_along_axis(found[None], where.reshape(2, len(dyads), -1), axis=-1)
        closest = np.argmin(sign[..., None] * inside, axis=-1)[..., None]
        at, best = (np.take_along_axis(one, closest, axis=-1)[..., 0] for one in (windows, inside))
        width /= 4
    return [Extremes(*map(float, one)) for one in zip(best[0], at[0] % 360.0, best[1], at[1] % 360.0, strict=True)]


def coupler_curve(mechanism: Mechanism, point: str, grid: CrankGrid) -> tuple[Array, Array]:
    """Return the path of a point. [m]"""
    motion = assembled(mechanism, grid).points[point]
    return motion.x.position, motion.y.position
