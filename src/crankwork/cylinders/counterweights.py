"""Counterweights on the crankshaft: their effect, and the free forces that remain.

A counterweight turns forwards, so it can remove the forward part of the first order and nothing else. Half of a
reciprocating mass is that part, whatever the layout: the vector of a force that swings along a line is half a vector
that turns forwards and half one that turns backwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.cylinders.ellipse import Ellipse, OrderBalance, unit_vectors, vector_sum
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import to_number


@formula("counterweight_moment", "bevan_1956, ch. 14")
def counterweight_moment(m_rot: Value, k_b: Value, m_rec: Value, r: Value) -> Value:
    """Mass moment that balances the rotating mass and a share of the reciprocating mass of one throw."""
    return (m_rot + k_b * m_rec) * r


class Unbalance(NamedTuple):
    """A mass that turns with the crankshaft."""

    mass_moment: Value  # Mass times distance of its centre of mass from the crankshaft axis [kg m]
    angle: float  # Its direction, ahead of the crankpin of cylinder 1 [deg]
    position: float  # Its place along the shaft, as those of the cylinders [m]
    name: str = ""  # Its key: `throw.2`, `counterweights.3`
    # Its weight and what an angular acceleration takes, away from the shaft along its arm and with the rotation [N]
    held: BearingLoad | None = None


def rotating_unbalances(layout: Layout, mass: ArrayLike, crank_radius: float) -> tuple[Unbalance, ...]:
    """Return the rotating masses of the cylinders at their crankpins.

    `mass`: rotating mass of each cylinder; of a crankpin that several share, the part of each [kg], shape
    (cylinders,).
    """
    masses = np.broadcast_to(np.asarray(mass, dtype=float), (len(layout.places),))
    return tuple(
        Unbalance(float(m) * crank_radius, place.pin_angle, place.position)
        for m, place in zip(masses, layout.places, strict=True)
    )


def turning_forces(
    layout: Layout, unbalances: Sequence[Unbalance], speed: float, *, about: float = 0.0
) -> OrderBalance:
    """Return force and moment of masses that turn with the crankshaft: rotating masses, counterweights.

    Of the first order, nothing of it backwards [N], [N m]. `layout`: the cylinders, for the direction of the first.
    Source: den_hartog_1956, ch. 5.
    """
    at_zero = layout.places[0].axis + np.array([unbalance.angle for unbalance in unbalances])
    size = np.array([to_number(unbalance.mass_moment) for unbalance in unbalances]) * speed**2
    forces = size * unit_vectors(at_zero)
    arms = np.array([unbalance.position for unbalance in unbalances]) - about
    return OrderBalance(1, Ellipse(vector_sum(forces), 0j), Ellipse(vector_sum(arms * forces), 0j))


def throw_counterweights(
    layout: Layout, reciprocating: ArrayLike, rotating: ArrayLike, crank_radius: float, share: float = 0.5
) -> tuple[Unbalance, ...]:
    """Return one counterweight opposite each crankpin, for its rotating and a share of its reciprocating mass.

    It stands midway between the masses of its crankpin; of one that several cylinders share, each mass is the part of
    one. Half of the reciprocating mass removes all of the first order that turns forwards (kolchin_demidov_2008, ch. 8;
    taylor_1985, vol. 2, ch. 8, for radial engines).
    """
    count = len(layout.places)
    moments = np.broadcast_to(
        counterweight_moment(np.asarray(rotating), share, np.asarray(reciprocating), crank_radius), (count,)
    )
    of_pin: dict[int, list[int]] = {}
    for index, place in enumerate(layout.places):
        of_pin.setdefault(place.crankpin, []).append(index)
    positions = np.array([place.position for place in layout.places])
    weights = []
    for pin in sorted(of_pin):
        members = of_pin[pin]
        total = float(moments[members].sum())
        middle = float(moments[members] @ positions[members]) / total if total else float(positions[members].mean())
        weights.append(Unbalance(total, (layout.places[members[0]].pin_angle + 180) % 360, middle))
    return tuple(weights)


def in_two_planes(vectors: ArrayLike, positions: ArrayLike, planes: tuple[float, float]) -> tuple[complex, complex]:
    """Return the two vectors, one in each plane, with the sum and the moment of given vectors."""
    first, second = planes
    if first == second:
        raise CrankworkError(f"both planes are at {first * 1e3:g} mm; a couple needs two planes apart")
    vectors, arms = np.asarray(vectors, dtype=complex), np.asarray(positions, dtype=float)
    span = second - first
    return vector_sum(vectors * (second - arms) / span), vector_sum(vectors * (arms - first) / span)
