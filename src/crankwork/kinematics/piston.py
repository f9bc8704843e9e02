"""The motion of piston and rod of a slider-crank, by the method asked for."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.kinematics import textbook
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.series import series_transfer
from crankwork.kinematics.slider_crank import (
    RodSwing,
    SliderCrank,
    piston_displacement,
    piston_displacement_offset,
    piston_transfer_1,
    piston_transfer_2,
    rod_swing,
    rod_transfer_1,
    rod_transfer_2,
)
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method

# Step of the first look for the largest error; the second look is a hundred times finer. [deg]
_COARSE = 0.25


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
    crank, rod = mechanism.crank, only_rod(mechanism)
    if rod is None:
        return None
    along_guide = math.isclose(math.sin((rod.guide_angle - crank.start) / 2), 0.0, abs_tol=1e-12)
    if rod.joint != crank.pin or rod.branch != 1 or not along_guide:
        return None
    side = crank.start + crank.direction * math.pi / 2
    x, y = (rod.guide_point[0] - crank.pivot[0], rod.guide_point[1] - crank.pivot[1])
    offset = x * math.cos(side) + y * math.sin(side)
    return SliderCrank(crank.radius, rod.length, 0.0 if abs(offset) < 1e-15 * rod.length else offset)


def only_rod(mechanism: Mechanism) -> RRP | None:
    """Return the one dyad of a mechanism if it is a link on a fixed guide, else None."""
    match mechanism.dyads:
        case (RRP(guide_link="") as rod,):
            return rod
    return None


def largest_error(slider_crank: SliderCrank, method: Method, *, unsteadiness: float = 0.0) -> tuple[float, ...]:
    """Return the largest error of a method against exact over one revolution.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    method : Method
        Series or textbook; exact gives zeros.
    unsteadiness : float
        Angular acceleration over the square of the angular speed. [-]

    Returns
    -------
    tuple of float
        Largest absolute errors of x, of dx/dphi and of d2x/dphi2 + unsteadiness dx/dphi. [m]
    """

    def errors(degrees: Array) -> tuple[Array, ...]:
        grid = CrankGrid.from_degrees(degrees)
        exact = piston_motion(slider_crank, grid).piston
        approximate = piston_motion(slider_crank, grid, method).piston
        x, x_1, x_2 = (np.abs(one - other) for one, other in zip(approximate, exact, strict=True))
        if not unsteadiness:
            return x, x_1, x_2
        both = approximate.position_2 - exact.position_2 + unsteadiness * (approximate.position_1 - exact.position_1)
        return x, x_1, np.abs(both)

    coarse = np.arange(0.0, 360.0, _COARSE)
    tops = [coarse[int(np.argmax(one))] for one in errors(coarse)]
    near = [errors(top + np.linspace(-_COARSE, _COARSE, 201))[i] for i, top in enumerate(tops)]
    return tuple(float(np.max(one)) for one in near)
