"""Counterweights on the crankshaft: their effect, and the free forces that remain.

A counterweight turns forwards, so it can remove the forward part of the first order and nothing else. Half of a
reciprocating mass is that part, whatever the layout: the vector of a force that swings along a line is half a vector
that turns forwards and half one that turns backwards.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.cylinders.layout import Layout
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import to_number
from crankwork.kinematics.crank_grid import CrankGrid


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


ComplexArray = NDArray[np.complex128]

# A sum smaller than this share of its terms is rounding: it has no direction, and is zero.
_ROUNDING = 1e-13


def unit_vectors(degrees: ArrayLike) -> ComplexArray:
    """Return vectors of length one in given directions, exact at multiples of 90 degrees."""
    grid = CrankGrid.from_degrees(degrees)
    return np.asarray(grid.cos + 1j * grid.sin)


def vector_sum(terms: ArrayLike) -> complex:
    """Return the sum of vectors, zero where they cancel to rounding."""
    vectors = np.asarray(terms, dtype=complex)
    total = complex(vectors.sum())
    return total if abs(total) > _ROUNDING * float(np.abs(vectors).sum()) else 0j


class Ellipse(NamedTuple):
    """A vector made of one that turns with the crank and one that turns against it, at the same speed."""

    # The two where the crank angle of cylinder 1 is zero; force or moment [N or N m]
    forward: complex
    backward: complex

    @property
    def largest(self) -> float:
        """Largest size of the vector in a turn, the long half axis. [N or N m]"""
        return abs(self.forward) + abs(self.backward)

    @property
    def least(self) -> float:
        """Smallest size of the vector in a turn, the short half axis. [N or N m]"""
        return abs(abs(self.forward) - abs(self.backward))

    @property
    def direction(self) -> float:
        """Direction of the long axis from the reference direction, 0 to 180, and 0 of a circle. [deg]"""
        if not self.forward or not self.backward:
            return 0.0
        return float(np.degrees(np.angle(self.forward) + np.angle(self.backward)) / 2 % 180)

    def outline(self, count: int = 181) -> ComplexArray:
        """Return points of the closed ellipse for a figure, from the crank angle zero onwards.

        `count`: how many points; the last is the first.
        """
        turning = unit_vectors(np.linspace(0.0, 360.0, count))
        return np.asarray(self.forward * turning + self.backward * turning.conj())


class OrderBalance(NamedTuple):
    """Free force [N] of one order, and its moment along the shaft [N m]."""

    order: int
    force: Ellipse
    moment: Ellipse


def balance_sum(parts: Iterable[OrderBalance]) -> tuple[OrderBalance, ...]:
    """Return forces and moments added order by order, such as those of the cylinders and of counterweights.

    `parts`: of any orders, with moments about the same position.
    """
    of_order: dict[int, list[tuple[Ellipse, Ellipse]]] = {}
    for part in parts:
        of_order.setdefault(part.order, []).append((part.force, part.moment))
    return tuple(
        OrderBalance(
            order, *(Ellipse(*map(vector_sum, zip(*ellipses, strict=True))) for ellipses in zip(*balances, strict=True))
        )
        for order, balances in sorted(of_order.items())
    )
