"""The motion of piston and rod of a slider-crank, by the method asked for."""

from __future__ import annotations

import math
from typing import NamedTuple

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.series import series_transfer
from crankwork.kinematics.slider_crank import (
    RodSwing,
    SliderCrank,
    piston_displacement,
    piston_transfer_1,
    piston_transfer_2,
    rod_angle,
    rod_swing,
    rod_transfer_1,
    rod_transfer_2,
)
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method


class PistonMotion(NamedTuple):
    """Motion of a slider-crank in the engine's own terms, arrays of shape (n,).

    `piston` counts from top dead centre towards the crankshaft [m]; `rod` is the swing of the rod from
    the cylinder axis [rad]; `swing` holds the functions of that angle [-].
    """

    piston: Transfer
    rod: Transfer
    swing: RodSwing


def piston_motion(slider_crank: SliderCrank, grid: CrankGrid, method: Method = EXACT) -> PistonMotion:
    """Return the motion of piston and rod by the method asked for (kolchin_demidov_2008, ch. 6).

    The rod angle itself is exact in every method; the textbook takes its derivatives to first order. Displacement,
    dx/dphi and d2x/dphi2 of the piston [m]; angle and derivatives of the rod [rad].
    """
    lam = slider_crank.rod_ratio
    swing = rod_swing(slider_crank, grid, lam)
    angle = rod_angle(swing.sin, swing.cos)
    if method.kinematics == "textbook":
        rod = Transfer(angle, textbook_rod_transfer_1(lam, grid.cos), textbook_rod_transfer_2(lam, grid.sin))
        return PistonMotion(textbook_piston(slider_crank, grid, lam), rod, swing)
    is_series = method.kinematics == "series"
    piston = (
        series_transfer(slider_crank, grid, method.order) if is_series else exact_piston(slider_crank, grid, swing, lam)
    )
    rod_1 = rod_transfer_1(lam, grid.cos, swing.cos)
    rod_2 = rod_transfer_2(rod_1, lam, grid.sin, swing.sin, swing.cos)
    return PistonMotion(piston, Transfer(angle, rod_1, rod_2), swing)


def exact_piston(slider_crank: SliderCrank, grid: CrankGrid, swing: RodSwing, lam: Value) -> Transfer:
    """Return the closed-form displacement of the piston and its derivatives (kolchin_demidov_2008, ch. 6). [m]"""
    r, l, e = slider_crank  # noqa: E741
    return Transfer(
        piston_displacement(r, grid.cos, l, swing.sin, swing.cos, e),
        piston_transfer_1(r, swing.sin_sum, swing.cos),
        piston_transfer_2(r, lam, grid.cos, swing.cos_sum, swing.cos),
    )


def textbook_piston(slider_crank: SliderCrank, grid: CrankGrid, lam: Value) -> Transfer:
    """Return the two-term displacement of the piston and its derivatives (kolchin_demidov_2008, ch. 6). [m]"""
    r, _, e = slider_crank
    return Transfer(
        textbook_displacement(r, grid.cos, lam, grid.cos_2, e, grid.sin),
        textbook_transfer_1(r, grid.sin, lam, grid.sin_2, e, grid.cos),
        textbook_transfer_2(r, grid.cos, lam, grid.cos_2, e, grid.sin),
    )


def as_slider_crank(mechanism: Mechanism) -> SliderCrank | None:
    """Return the three lengths of a mechanism that is a slider-crank, or None if it is another one. [m]"""
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


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6")
def textbook_displacement(r: Value, cos_phi: Value, lam: Value, cos_2phi: Value, e: Value, sin_phi: Value) -> Value:
    """Piston displacement in two terms, and what an offset of the cylinder adds."""
    return r * ((1 - cos_phi) + lam / 4 * (1 - cos_2phi)) - lam * e * sin_phi


@formula("piston_transfer_1", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_1(r: Value, sin_phi: Value, lam: Value, sin_2phi: Value, e: Value, cos_phi: Value) -> Value:
    """First transfer function of the piston in two terms, dx/dphi, and what an offset of the cylinder adds."""
    return r * (sin_phi + lam / 2 * sin_2phi) - lam * e * cos_phi


@formula("piston_transfer_2", "kolchin_demidov_2008, ch. 6")
def textbook_transfer_2(r: Value, cos_phi: Value, lam: Value, cos_2phi: Value, e: Value, sin_phi: Value) -> Value:
    """Second transfer function of the piston in two terms, d2x/dphi2, and what an offset of the cylinder adds."""
    return r * (cos_phi + lam * cos_2phi) + lam * e * sin_phi


@formula("rod_transfer_1", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_1(lam: Value, cos_phi: Value) -> Value:
    """First transfer function of the rod to first order, dbeta/dphi."""
    return lam * cos_phi


@formula("rod_transfer_2", "khurmi_gupta_2005, ch. 15")
def textbook_rod_transfer_2(lam: Value, sin_phi: Value) -> Value:
    """Second transfer function of the rod to first order, d2beta/dphi2."""
    return -lam * sin_phi
