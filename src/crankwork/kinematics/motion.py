"""The motion of a mechanism: positions and transfer functions of its points, links and sliders."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.errors import MethodError
from crankwork.kinematics import textbook
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import PointMotion, Transfer, crank_pin_motion, rrp_motion
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
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method


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
        Direction of each link from the x axis, arrays of shape (n,). [rad]
    sliders : mapping of str to Transfer
        Distance of each slider along its guide, arrays of shape (n,). [m]
    method : Method
        How it was made.
    """

    grid: CrankGrid
    points: Mapping[str, PointMotion]
    links: Mapping[str, Transfer]
    sliders: Mapping[str, Transfer]
    method: Method


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
    crank = mechanism.crank
    if len(mechanism.dyads) != 1:
        return None
    (rod,) = mechanism.dyads
    along_guide = math.isclose(math.sin((rod.guide_angle - crank.start) / 2), 0.0, abs_tol=1e-12)
    if rod.joint != crank.pin or rod.branch != 1 or not along_guide:
        return None
    side = crank.start + crank.direction * math.pi / 2
    x, y = (rod.guide_point[0] - crank.pivot[0], rod.guide_point[1] - crank.pivot[1])
    offset = x * math.cos(side) + y * math.sin(side)
    return SliderCrank(crank.radius, rod.length, 0.0 if abs(offset) < 1e-15 * rod.length else offset)


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
    lengths = as_slider_crank(mechanism)
    if lengths is None:
        if not method.is_exact:
            raise MethodError(f"method {method.name} exists for a slider-crank only; use exact")
        return linkage_motion(mechanism, grid)
    check_slider_crank(lengths)
    return _slider_crank_motion(mechanism, lengths, grid, method)


def linkage_motion(mechanism: Mechanism, grid: CrankGrid) -> Motion:
    """Return the exact motion of a mechanism, dyad after dyad.

    Parameters
    ----------
    mechanism : Mechanism
        A crank and dyads.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    Motion
        Positions and transfer functions. [m], [rad]

    Raises
    ------
    GeometryError
        If a dyad cannot be assembled, with its link, the angle and the length that is missing.
    """
    crank = mechanism.crank
    pin, arm = crank_pin_motion(crank, grid)
    points, links, sliders = {crank.pin: pin}, {crank.link: arm}, {}
    for dyad in mechanism.dyads:
        point, link, slider = rrp_motion(dyad, points[dyad.joint], grid)
        points[dyad.slider], links[dyad.link], sliders[dyad.slider] = point, link, slider
    return Motion(grid, points, links, sliders, EXACT)


def _slider_crank_motion(mechanism: Mechanism, lengths: SliderCrank, grid: CrankGrid, method: Method) -> Motion:
    """Return the motion with piston and rod by the engine's own formulas, in the frame of the mechanism."""
    crank, (dyad,) = mechanism.crank, mechanism.dyads
    (x, x_1, x_2), swing, _ = piston_motion(lengths, grid, method)
    r, l, e = lengths  # noqa: E741
    top = np.sqrt((r + l) ** 2 - e**2)
    slider = Transfer(_along_guide(mechanism) + top - x, -x_1, -x_2)
    cos, sin = math.cos(dyad.guide_angle), math.sin(dyad.guide_angle)
    (qx, qy), d = dyad.guide_point, crank.direction
    piston = PointMotion(
        Transfer(qx + cos * slider.position, cos * slider.position_1, cos * slider.position_2),
        Transfer(qy + sin * slider.position, sin * slider.position_1, sin * slider.position_2),
    )
    rod = Transfer(dyad.guide_angle - d * swing.position, -d * swing.position_1, -d * swing.position_2)
    pin, arm = crank_pin_motion(crank, grid)
    points = {crank.pin: pin, dyad.slider: piston}
    return Motion(grid, points, {crank.link: arm, dyad.link: rod}, {dyad.slider: slider}, method)


def _along_guide(mechanism: Mechanism) -> float:
    """Return where the foot of the crank pivot lies along the guide, counted from the guide point."""
    (rod,), (px, py) = mechanism.dyads, mechanism.crank.pivot
    qx, qy = rod.guide_point
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
