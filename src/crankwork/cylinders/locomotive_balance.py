"""What counterweights on the wheels of a steam locomotive leave: hammer blow, pull and sway.

Everything here is of the first order; the rods of locomotives are long.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.cylinders.balance import InertiaHarmonics, free_forces
from crankwork.cylinders.counterweights import Unbalance, rotating_unbalances, two_plane_counterweights
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.cylinders.layout import Layout
from crankwork.formula.expression import Value, formula


@formula("tractive_effort_variation", "khurmi_gupta_2005, ch. 22")
def tractive_effort_variation(k_b: Value, m_rec: Value, r: Value, w: Value, cos_phi: Value, sin_phi: Value) -> Value:
    """Primary force that two cylinders with cranks at right angles leave along the line of stroke."""
    return (1 - k_b) * m_rec * r * w**2 * (cos_phi - sin_phi)


@formula("swaying_couple", "khurmi_gupta_2005, ch. 22")
def swaying_couple(  # noqa: PLR0913 - one argument per symbol
    k_b: Value, m_rec: Value, r: Value, w: Value, a_z: Value, cos_phi: Value, sin_phi: Value
) -> Value:
    """Couple of the primary forces that two cylinders with cranks at right angles leave."""
    return (1 - k_b) * m_rec * r * w**2 * a_z / 2 * (cos_phi + sin_phi)


class LocomotiveMasses(NamedTuple):
    """Masses of one cylinder [kg], crank radius [m] and the balanced share of the reciprocating mass [-]."""

    reciprocating: float
    rotating: float
    crank_radius: float
    share: float


class LocomotiveBalance(NamedTuple):
    """Counterweights of the two wheels of the driving axle and what they leave.

    Parameters
    ----------
    counterweights : tuple of Unbalance
        Of each wheel, for all of the rotating and the share of the reciprocating mass.
    hammer_blows : tuple of float
        Largest vertical force at each wheel. [N]
    tractive_effort, swaying_couple : float
        Amplitudes of the force along the line of stroke and of its couple. [N], [N m]
    """

    counterweights: tuple[Unbalance, Unbalance]
    hammer_blows: tuple[float, float]
    tractive_effort: float
    swaying_couple: float


def locomotive_balance(
    layout: Layout, masses: LocomotiveMasses, speed: float, wheels: tuple[float, float]
) -> LocomotiveBalance:
    """Return the counterweights on the wheels of a driving axle and what they leave, for any number of cylinders.

    Parameters
    ----------
    layout : Layout
        The cylinders, with parallel axes.
    masses : LocomotiveMasses
        What moves. [kg], [m], [-]
    speed : float
        Angular speed of the axle. [rad/s]
    wheels : tuple of float
        Positions of the wheels, from the middle between the outermost cylinders. [m]

    Returns
    -------
    LocomotiveBalance
        Counterweights, forces and couple.

    References
    ----------
    bevan_1956, ch. 14; khurmi_gupta_2005, ch. 22.
    """
    reciprocating, rotating, radius, share = masses
    whole = rotating_unbalances(layout, rotating + share * reciprocating, radius)
    part = rotating_unbalances(layout, share * reciprocating, radius)
    first, second = (float(unbalance_force(one.mass_moment, speed)) for one in two_plane_counterweights(part, wheels))
    primary = InertiaHarmonics((1,), np.ones(1, dtype=complex))
    (left,) = free_forces(layout, (1 - share) * reciprocating, radius, speed, primary)
    axis = layout.places[0].axis
    return LocomotiveBalance(
        two_plane_counterweights(whole, wheels),
        (first, second),
        left.force.amplitude_along(axis),
        left.moment.amplitude_along(axis),
    )
