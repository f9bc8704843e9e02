"""The motion of a mechanism: positions and transfer functions of its points, links and sliders."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import MethodError
from crankwork.kinematics import textbook
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import (
    LinkMotion,
    PointMotion,
    Transfer,
    crank_motion,
    crank_pin_motion,
    fixed_guide,
    fixed_point,
    point_on_guide,
    point_on_link,
)
from crankwork.kinematics.placement import Placed, assembled, place, reached
from crankwork.kinematics.series import series_transfer
from crankwork.kinematics.slider_crank import (
    RodSwing,
    SliderCrank,
    check_slider_crank,
    piston_displacement,
    piston_displacement_offset,
    piston_transfer_1,
    piston_transfer_2,
    rod_swing,
    rod_transfer_1,
    rod_transfer_2,
)
from crankwork.mechanism.dyads import RRP, Point
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method

Status = NDArray[np.int8]


@dataclass(frozen=True)
class Motion:
    """Position, first and second transfer function of everything that moves.

    Parameters
    ----------
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    points : mapping of str to PointMotion
        Coordinates of the named points, arrays of shape (n,). [m]
    links : mapping of str to Transfer
        Direction of each link that does not slide from the x axis, arrays of shape (n,). [rad]
    sliders : mapping of str to Transfer
        Distance of each slider along its guide, arrays of shape (n,). [m]
    method : Method
        How it was made.
    frames : mapping of str to LinkMotion
        Links and sliding pieces as frames, with origin and direction; empty where the motion comes from a table.
    status : int, shape (n,), or None
        0 where the crank gets, 1 where the mechanism cannot be assembled, 2 where it can, but not be reached.
    """

    grid: CrankGrid
    points: Mapping[str, PointMotion]
    links: Mapping[str, Transfer]
    sliders: Mapping[str, Transfer]
    method: Method
    frames: Mapping[str, LinkMotion] = field(default_factory=dict)
    status: Status | None = None


class Directions(Mapping[str, Transfer]):
    """Directions of links as angles, worked out when asked for: an arc tangent costs as much as half a dyad.

    Parameters
    ----------
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    frames : mapping of str to LinkMotion
        The links.
    """

    def __init__(self, grid: CrankGrid, frames: Mapping[str, LinkMotion]) -> None:
        self._grid, self._frames = grid, frames
        self._known: dict[str, Transfer] = {}

    def __getitem__(self, name: str) -> Transfer:
        """Return the direction of a link from the x axis, arrays of shape (n,). [rad]"""
        if name not in self._known:
            self._known[name] = direction(self._grid, self._frames[name])
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._frames)

    def __len__(self) -> int:
        return len(self._frames)


def direction(grid: CrankGrid, link: LinkMotion) -> Transfer:
    """Return the direction of a link, free of jumps by a turn.

    Parameters
    ----------
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    link : LinkMotion
        The frame of the link.

    Returns
    -------
    Transfer of array, shape (n,)
        Angle from the x axis, from -pi to pi at the first position, and its derivatives. [rad]

    Notes
    -----
    Between neighbours the angle grows by about the mean rate times the step, which says how many turns to add.
    """
    still = np.zeros_like(grid.angle)
    angle, rate = np.arctan2(link.sin, link.cos) + still, link.angle_1 + still
    grown = np.diff(grid.angle) * (rate[1:] + rate[:-1]) / 2
    turns = np.nan_to_num(np.rint((grown - np.diff(angle)) / math.tau))
    angle[1:] += math.tau * np.cumsum(turns)
    return Transfer(angle, rate, link.angle_2 + still)


class PistonMotion(NamedTuple):
    """Motion of a slider-crank in the engine's own terms, arrays of shape (n,).

    `piston` counts from top dead centre towards the crankshaft [m]; `rod` is the swing of the rod from
    the cylinder axis [rad]; `swing` holds the functions of that angle [-].
    """

    piston: Transfer
    rod: Transfer
    swing: RodSwing


def piston_motion(slider_crank: SliderCrank, grid: CrankGrid, method: Method = EXACT) -> PistonMotion:
    """Return the motion of piston and rod by the method asked for.

    The rod angle itself is exact in every method; the textbook takes its derivatives to first order.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    method : Method
        Exact, series or textbook.

    Returns
    -------
    PistonMotion
        Displacement, dx/dphi and d2x/dphi2 of the piston [m]; angle and derivatives of the rod [rad].

    References
    ----------
    kolchin_demidov_2008, ch. 6.
    """
    swing = rod_swing(slider_crank, grid)
    angle = np.arctan2(swing.sin, swing.cos)
    lam = slider_crank.rod_ratio
    if method.kinematics == "textbook":
        piston = textbook_piston(slider_crank, grid)
        rod_1 = textbook.textbook_rod_transfer_1(lam, grid.cos)
        rod_2 = textbook.textbook_rod_transfer_2(lam, grid.sin)
        return PistonMotion(piston, Transfer(angle, rod_1, rod_2), swing)
    rod_1 = rod_transfer_1(lam, grid.cos, swing.cos)
    rod_2 = rod_transfer_2(rod_1, lam, grid.sin, swing.sin, swing.cos)
    rod = Transfer(angle, rod_1, rod_2)
    if method.kinematics == "series":
        return PistonMotion(Transfer(*series_transfer(slider_crank, grid, method.order)), rod, swing)
    return PistonMotion(exact_piston(slider_crank, grid, swing), rod, swing)


def exact_piston(slider_crank: SliderCrank, grid: CrankGrid, swing: RodSwing) -> Transfer:
    """Return the closed-form displacement of the piston and its derivatives.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    swing : RodSwing
        Functions of the rod angle there.

    Returns
    -------
    Transfer of array, shape (n,)
        x, dx/dphi, d2x/dphi2. [m]

    References
    ----------
    kolchin_demidov_2008, ch. 6.
    """
    r, l, e = slider_crank  # noqa: E741
    lam = slider_crank.rod_ratio
    if np.all(np.equal(e, 0)):
        x = piston_displacement(r, lam, grid.sin, grid.cos, swing.cos)
    else:
        x = piston_displacement_offset(r, l, e, grid.cos, swing.cos)
    return Transfer(
        x,
        piston_transfer_1(r, swing.sin_sum, swing.cos),
        piston_transfer_2(r, lam, grid.cos, swing.cos_sum, swing.cos),
    )


def textbook_piston(slider_crank: SliderCrank, grid: CrankGrid) -> Transfer:
    """Return the two-term displacement of the piston and its derivatives.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    Transfer of array, shape (n,)
        x, dx/dphi, d2x/dphi2. [m]

    References
    ----------
    kolchin_demidov_2008, ch. 6.
    """
    r, _, e = slider_crank
    lam = slider_crank.rod_ratio
    x = textbook.textbook_displacement(r, lam, grid.cos, grid.cos_2)
    x_1 = textbook.textbook_transfer_1(r, lam, grid.sin, grid.sin_2)
    x_2 = textbook.textbook_transfer_2(r, lam, grid.cos, grid.cos_2)
    if np.all(np.equal(e, 0)):
        return Transfer(x, x_1, x_2)
    return Transfer(
        x + textbook.textbook_displacement_offset(lam, e, grid.sin),
        x_1 + textbook.textbook_transfer_1_offset(lam, e, grid.cos),
        x_2 + textbook.textbook_transfer_2_offset(lam, e, grid.sin),
    )


def as_slider_crank(mechanism: Mechanism) -> SliderCrank | None:
    """Return the three lengths of a mechanism that is a slider-crank, or None if it is another one.

    Parameters
    ----------
    mechanism : Mechanism
        A crank and dyads.

    Returns
    -------
    SliderCrank or None
        Radius, rod length and offset. [m]
    """
    crank, rod = mechanism.crank, _only_rod(mechanism)
    if rod is None:
        return None
    along_guide = math.isclose(math.sin((rod.guide_angle - crank.start) / 2), 0.0, abs_tol=1e-12)
    if rod.joint != crank.pin or rod.branch != 1 or not along_guide:
        return None
    side = crank.start + crank.direction * math.pi / 2
    x, y = (rod.guide_point[0] - crank.pivot[0], rod.guide_point[1] - crank.pivot[1])
    offset = x * math.cos(side) + y * math.sin(side)
    return SliderCrank(crank.radius, rod.length, 0.0 if abs(offset) < 1e-15 * rod.length else offset)


def _only_rod(mechanism: Mechanism) -> RRP | None:
    """Return the one dyad of a mechanism if it is a link on a fixed guide."""
    match mechanism.dyads:
        case (RRP(guide_link="") as rod,):
            return rod
    return None


def motion(mechanism: Mechanism, grid: CrankGrid, method: Method = EXACT) -> Motion:
    """Return the motion of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        A crank and dyads.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    method : Method
        Anything but exact is defined for a slider-crank only.

    Returns
    -------
    Motion
        Positions and transfer functions of points, links and sliders. [m], [rad]

    Raises
    ------
    GeometryError
        If the mechanism cannot be assembled at some angle.
    MethodError
        If a series or textbook is asked for where none exists.
    """
    lengths, rod = as_slider_crank(mechanism), _only_rod(mechanism)
    if lengths is None or rod is None:
        if not method.is_exact:
            raise MethodError(f"method {method.name} exists for a slider-crank only; use exact")
        return linkage_motion(mechanism, grid)
    check_slider_crank(lengths)
    return _slider_crank_motion(mechanism, rod, lengths, grid, method)


def linkage_motion(mechanism: Mechanism, grid: CrankGrid, *, partial: bool = False) -> Motion:
    """Return the exact motion of a mechanism, group after group.

    Parameters
    ----------
    mechanism : Mechanism
        A crank and groups.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    partial : bool
        Keep the positions that the crank can reach, with NaN and a status at the others, instead of refusing.

    Returns
    -------
    Motion
        Positions and transfer functions. [m], [rad]

    Raises
    ------
    GeometryError
        If a group cannot be assembled or is singular at an angle or between two that follow each other, with
        its links, the angle and the length that is missing.
    """
    if not partial:
        return _as_motion(assembled(mechanism, grid), np.zeros(len(grid), dtype=np.int8))
    placed = place(mechanism, grid)
    status = reached(mechanism, placed)
    return _as_motion(placed, status)


def _as_motion(placed: Placed, status: Status) -> Motion:
    """Return the motion of what has been placed, NaN where the crank does not get."""
    lost = status != 0 if status.any() else None

    def full(one: Array) -> Array:
        if lost is not None:
            return np.where(lost, np.nan, one)
        return one if one.ndim else np.broadcast_to(one, status.shape)

    def transfer(one: Transfer) -> Transfer:
        return Transfer(full(one[0]), full(one[1]), full(one[2]))

    points = {name: PointMotion(transfer(one.x), transfer(one.y)) for name, one in placed.points.items()}
    frames = placed.links
    if lost is not None:
        frames = {name: _masked(link, full) for name, link in frames.items()}
    sliders = {name: transfer(one) for name, one in placed.sliders.items()}
    links = {name: frame for name, frame in frames.items() if name not in sliders}
    return Motion(placed.grid, points, Directions(placed.grid, links), sliders, EXACT, frames, status)


def _masked(link: LinkMotion, full: Callable[[Array], Array]) -> LinkMotion:
    x, y = (Transfer(*(full(one) for one in side)) for side in link.origin)
    return LinkMotion(PointMotion(x, y), *(full(one) for one in link[1:]))


def _slider_crank_motion(
    mechanism: Mechanism, dyad: RRP, lengths: SliderCrank, grid: CrankGrid, method: Method
) -> Motion:
    """Return the motion with piston and rod by the engine's own formulas, in the frame of the mechanism."""
    crank = mechanism.crank
    (x, x_1, x_2), rod, swing = piston_motion(lengths, grid, method)
    r, l, e = lengths  # noqa: E741
    top = np.sqrt((r + l) ** 2 - e**2)
    guide = fixed_guide(dyad.guide)
    slider = Transfer(_along_guide(dyad, crank.pivot) + top - x, -x_1, -x_2)
    piston = point_on_guide(guide, slider)
    d, cos, sin = crank.direction, guide.cos, guide.sin
    pin, arm = crank_pin_motion(crank, grid)
    still = np.zeros_like(grid.angle)
    frames = {
        crank.link: crank_motion(crank, grid),
        dyad.link: LinkMotion(
            pin,
            cos * swing.cos + d * sin * swing.sin,
            sin * swing.cos - d * cos * swing.sin,
            *(-d * one for one in rod[1:]),
        ),
        dyad.piece: LinkMotion(piston, cos + still, sin + still, still, still),
    }
    angle = Transfer(dyad.guide_angle - d * rod.position, -d * rod.position_1, -d * rod.position_2)
    points = {crank.pin: pin, dyad.slider: piston}
    points |= {name: fixed_point(place) for name, place in mechanism.ground.items()}
    points |= {one.name: point_on_link(frames[one.link], one.along, one.across) for one in mechanism.points}
    return Motion(grid, points, {crank.link: arm, dyad.link: angle}, {dyad.piece: slider}, method, frames)


def _along_guide(rod: RRP, pivot: Point) -> float:
    """Return where the foot of the crank pivot lies along the guide, counted from the guide point."""
    (px, py), (qx, qy) = pivot, rod.guide_point
    return (px - qx) * math.cos(rod.guide_angle) + (py - qy) * math.sin(rod.guide_angle)


def largest_error(slider_crank: SliderCrank, method: Method) -> tuple[float, ...]:
    """Return the largest error of a method against exact over one revolution.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    method : Method
        Series or textbook; exact gives zeros.

    Returns
    -------
    tuple of float
        Largest absolute errors of x, dx/dphi and d2x/dphi2. [m]
    """
    grid = CrankGrid.steps(0.5, 360.0)
    exact = piston_motion(slider_crank, grid).piston
    approximate = piston_motion(slider_crank, grid, method).piston
    return tuple(_largest(one - other) for one, other in zip(approximate, exact, strict=True))


def _largest(error: Array) -> float:
    return float(np.max(np.abs(error)))
