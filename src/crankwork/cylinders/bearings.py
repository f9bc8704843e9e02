"""Loads on crankpin, big end and small end.

The load on a journal is the force on the journal, from rods or main bearing; that on a bearing is the force of
the journal on it, the opposite. Frames are those of `load_vectors`; the speed is constant.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from crankwork.cylinders.layout import Layout
from crankwork.cylinders.load_vectors import BearingLoad, turned
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.slider_crank import RodSwing


@formula("big_end_inertia_force", "kolchin_demidov_2008, ch. 7")
def big_end_inertia_force(m_2: Value, r: Value, w: Value) -> Value:
    """Inertia force of the rod mass at the crankpin."""
    return -m_2 * r * w**2


@formula("crankpin_radial_force", "kolchin_demidov_2008, ch. 7")
def crankpin_radial_force(K: Value, K_Rb: Value) -> Value:
    """Load on the crankpin along the crank arm."""
    return K + K_Rb


@formula("crankpin_load", "kolchin_demidov_2008, ch. 7")
def crankpin_load(T: Value, K: Value, K_Rb: Value) -> Value:
    """Size of the load on the crankpin."""
    return np.sqrt(T**2 + (K + K_Rb) ** 2)


@formula("piston_pin_force", "lukanin_shatrov_2007, ch. 1")
def piston_pin_force(F_g: Value, m_p: Value, a: Value, F_wp: Value) -> Value:
    """Force of the piston on its pin along the cylinder axis, without the rod mass at the pin."""
    return F_g - m_p * a + F_wp


@formula("small_end_load", "lukanin_shatrov_2007, ch. 1")
def small_end_load(P_p: Value, N: Value) -> Value:
    """Size of the load on the small end of the rod."""
    return np.sqrt(P_p**2 + N**2)


@formula("bearing_pressure", "kolchin_demidov_2008, ch. 7")
def bearing_pressure(R_b: Value, d_b: Value, l_b: Value) -> Value:
    """Load per projected area of the bearing."""
    return R_b / (d_b * l_b)


@formula("bearing_load_ratio", "kolchin_demidov_2008, ch. 9")
def bearing_load_ratio(R_max: Value, R_mean: Value) -> Value:
    """Largest load over the mean load."""
    return R_max / R_mean


def crank_frame_load(radial: Value, tangential: Value, inertia: Value) -> BearingLoad:
    """Return the load on a crankpin from one rod in the crank frame; `crankpin_loads` add up those of several.

    Parameters
    ----------
    radial, tangential : array, shape (n,)
        Forces of the rod on the crankpin, towards the crankshaft and with the rotation. [N]
    inertia : float
        Inertia force of the rod mass at the crankpin; never positive. [N]

    Returns
    -------
    BearingLoad of array, shape (n,)
        Force of the rod on the crankpin. [N]

    References
    ----------
    kolchin_demidov_2008, ch. 7.
    """
    return BearingLoad(-crankpin_radial_force(radial, inertia), tangential)


def crankpin_loads(layout: Layout, loads: Sequence[BearingLoad]) -> tuple[BearingLoad, ...]:
    """Return the load on every crankpin: the sum over the cylinders that work on it.

    Parameters
    ----------
    layout : Layout
        Which cylinder works on which crankpin.
    loads : sequence of BearingLoad of array, shape (n,)
        Force of each rod on its crankpin in the frame of its own crank, by cylinder, at the same instants. [N]

    Returns
    -------
    tuple of BearingLoad of array, shape (n,)
        Loads by crankpin, each in the frame of its own crank. [N]

    Raises
    ------
    CrankworkError
        If there is not one load per cylinder.
    """
    check_one_load_per_cylinder(layout, loads)
    sums: dict[int, BearingLoad] = {}
    for place, load in zip(layout.places, loads, strict=True):
        other = sums.get(place.crankpin)
        sums[place.crankpin] = load if other is None else BearingLoad(other.x + load.x, other.y + load.y)
    return tuple(sums[crankpin] for crankpin in sorted(sums))


def check_one_load_per_cylinder(layout: Layout, loads: Sequence[BearingLoad]) -> None:
    """Raise unless there is one load for every cylinder.

    Parameters
    ----------
    layout : Layout
        The cylinders.
    loads : sequence of BearingLoad of array, shape (n,)
        Their loads. [N]

    Raises
    ------
    CrankworkError
        With both numbers.
    """
    if len(loads) != len(layout.places):
        raise CrankworkError(
            f"{len(loads)} loads are given for {len(layout.places)} cylinders; give one load per cylinder"
        )


def big_end_bearing_load(load: BearingLoad, swing: RodSwing) -> BearingLoad:
    """Return the load on the big-end bearing of a rod: the force of the crankpin on it, in the rod frame.

    Parameters
    ----------
    load : BearingLoad of array, shape (n,)
        Force of this rod alone on the crankpin, in the crank frame. [N]
    swing : RodSwing
        Functions of phi + beta at the same instants. [-]

    Returns
    -------
    BearingLoad of array, shape (n,)
        Opposite to the load on the crankpin, turned by phi + beta; positive x presses the bearing towards the
        piston pin, as compression does. [N]

    References
    ----------
    kolchin_demidov_2008, ch. 7.
    """
    return turned(load.opposite, swing.sin_sum, swing.cos_sum)


def small_end_bearing_load(pin_force: Value, side: Value, swing: RodSwing) -> BearingLoad:
    """Return the load on the small-end bearing: the force of the piston pin on it, in the rod frame.

    Parameters
    ----------
    pin_force : array, shape (n,)
        Axial force of the piston on its pin, `piston_pin_force`, positive towards the crankshaft. [N]
    side : array, shape (n,)
        Side force; where the cylinder leans, with the weight of the piston group across the axis added. [N]
    swing : RodSwing
        Functions of beta at the same instants. [-]

    Returns
    -------
    BearingLoad of array, shape (n,)
        Negative x presses the bearing towards the crankpin, as compression does. [N]

    References
    ----------
    lukanin_shatrov_2007, ch. 1.

    Notes
    -----
    The piston hands on axially what acts on it and sideways what the wall gives back, so the force on the rod
    needs no rod mass. It is the force along the rod plus the inertia force that moves the rod's small-end mass.
    """
    return turned(BearingLoad(-pin_force, side), swing.sin, swing.cos)
