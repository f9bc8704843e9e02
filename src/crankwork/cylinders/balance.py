"""Free forces and moments of any layout, order by order.

The force of a cylinder acts along its axis. Drawn in the plane across the shaft, real part along the reference
direction of the engine and imaginary part 90 degrees further with the rotation, an order of it is the sum of a vector
that turns forwards at q times the crank speed and one that turns backwards. So is the sum over all cylinders, and its
tip draws an ellipse.

A moment is the sum of position times force, drawn the same way: it points where its force at a positive position does.

A balance shaft beside the crankshaft turns with or against it at a multiple of its speed: the forward part of an order
takes a shaft that turns with the crankshaft, the backward part one that turns against it. Where the cylinders stand in
one plane the two parts are equal, and the two shafts are the pair of Lanchester.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.cylinders.counterweights import (
    ComplexArray,
    Ellipse,
    OrderBalance,
    balance_sum,
    in_two_planes,
    unit_vectors,
    vector_sum,
)
from crankwork.cylinders.layout import Layout
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.series import acceleration_harmonics
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import EXACT, Method

# the orders of rods whose line passes through the crankshaft
ORDERS = (1, 2, 4, 6)
ALL_ORDERS = (1, 2, 3, 4, 5, 6)


@formula("order_inertia_force", "taylor_1985, vol. 2, ch. 8")
def order_inertia_force(m_rec: Value, r: Value, w: Value, A_q: Value) -> Value:
    """Amplitude of one order of the inertia force of one cylinder."""
    return m_rec * r * w**2 * A_q


@formula("free_force", "den_hartog_1956, ch. 5")
def free_force(K_F: Value, F_jq: Value) -> Value:
    """Largest free force of one order."""
    return K_F * F_jq


@formula("free_moment", "den_hartog_1956, ch. 5")
def free_moment(K_M: Value, a_z: Value, F_jq: Value) -> Value:
    """Largest free moment of one order."""
    return K_M * a_z * F_jq


class InertiaHarmonics(NamedTuple):
    """Orders of the piston acceleration x''/r = Re sum C_q exp(i q phi)."""

    orders: tuple[int, ...]  # The orders q
    # The coefficients C_q, by the crank angle of each cylinder's own axis, shape (orders,) [-]
    coefficients: ComplexArray


def inertia_harmonics(
    slider_crank: SliderCrank, orders: Sequence[int] = ORDERS, method: Method = EXACT
) -> InertiaHarmonics:
    """Return the orders of the piston acceleration of a slider-crank, shape (orders,). [-]

    `method`: exact, a series to some order, or the two terms of the textbooks, where the second is the crank-to-rod
    ratio. Source: taylor_1985, vol. 2, ch. 8; kolchin_demidov_2008, ch. 6, for the two terms.
    """
    r, ratio = float(slider_crank.crank_radius), float(slider_crank.rod_ratio)
    if method.kinematics == "textbook":
        offset = float(slider_crank.offset) / r
        two_terms = {1: complex(1.0, -ratio * offset), 2: complex(ratio)}
        return InertiaHarmonics(tuple(orders), np.array([two_terms.get(order, 0j) for order in orders]))
    cosine, sine = acceleration_harmonics(slider_crank, max(orders))
    chosen = np.array(orders) - 1
    coefficients = (cosine[chosen] - 1j * sine[chosen]) / r
    if method.kinematics == "series":
        coefficients[np.array(orders) > method.order] = 0.0
    return InertiaHarmonics(tuple(orders), coefficients)


def sampled_harmonics(acceleration: ArrayLike, crank_radius: float, orders: Sequence[int] = ORDERS) -> InertiaHarmonics:
    """Return the orders of any piston acceleration, as that of an articulated rod, shape (orders,). [-]

    `acceleration`: d2x/dphi2 at n equal steps of one turn, from the crank angle zero of the cylinder, without the
    last [m].
    """
    samples = np.asarray(acceleration, dtype=float)
    count = samples.shape[-1]
    if count <= 2 * max(orders):
        raise CrankworkError(
            f"{count} samples of a turn do not show order {max(orders)}; give more than {2 * max(orders)}"
        )
    spectrum = np.fft.rfft(samples)[..., list(orders)]
    return InertiaHarmonics(tuple(orders), spectrum * (2 / (count * crank_radius)))


def free_forces(
    layout: Layout,
    mass: ArrayLike,
    crank_radius: ArrayLike,
    speed: float,
    harmonics: InertiaHarmonics,
    *,
    about: float = 0.0,
) -> tuple[OrderBalance, ...]:
    """Return the free force and moment [N], [N m] of each order of the reciprocating masses.

    Masses and radii are of each cylinder where they differ, harmonics a row of each; moments are `about` a position
    along the shaft [m], by default the middle between the outermost cylinders. For other layouts taylor_1985, vol. 2,
    ch. 8. Source: den_hartog_1956, ch. 5.
    """
    places = layout.places
    if harmonics.coefficients.ndim > 1 and len(harmonics.coefficients) != len(places):
        raise CrankworkError(
            f"harmonics of {len(harmonics.coefficients)} cylinders do not fit a layout of {len(places)}; "
            "give one row for each cylinder, or one for all"
        )
    axes = np.array([place.axis for place in places])
    lead = places[0].axis + np.array([place.pin_angle for place in places]) - axes
    arms = np.array([place.position for place in places]) - about
    size = np.asarray(mass) * np.asarray(crank_radius) * speed**2 / 2 * unit_vectors(axes)
    rows = np.broadcast_to(harmonics.coefficients, (len(places), len(harmonics.orders)))
    result = []
    for order, coefficients in zip(harmonics.orders, rows.T, strict=True):
        turned = coefficients * unit_vectors(order * lead)
        forward, backward = size * turned, size * turned.conj()
        force = Ellipse(vector_sum(forward), vector_sum(backward))
        result.append(OrderBalance(order, force, Ellipse(vector_sum(arms * forward), vector_sum(arms * backward))))
    return tuple(result)


def layout_factors(layout: Layout, orders: Sequence[int] = ORDERS, pitch: float = 1.0) -> tuple[OrderBalance, ...]:
    """Return the free forces in units of the force of one cylinder, and the moments in that force times a pitch. [-]

    Factors of m r w^2 A_q, and of that times the pitch. `pitch`: distance along the shaft that is the unit of the
    moments [m]. Source: den_hartog_1956, ch. 5.
    """
    factors = free_forces(layout, 1.0, 1.0, 1.0, InertiaHarmonics(tuple(orders), np.ones(len(orders), dtype=complex)))
    return tuple(balance._replace(moment=Ellipse(*(part / pitch for part in balance.moment))) for balance in factors)


class ShaftPlace(NamedTuple):
    """Where a balance shaft lies beside the crankshaft."""

    # Distance from the crankshaft axis along the reference direction of the engine, and 90 degrees
    # further with the rotation [m]
    height: float = 0.0
    side: float = 0.0


class ShaftWeight(NamedTuple):
    """A weight on a balance shaft."""

    order: int  # Speed of the shaft over that of the crankshaft
    sense: int  # 1 where it turns with the crankshaft, -1 against it
    mass_moment: float  # Mass times eccentricity [kg m]
    # Its direction from the reference direction at crank angle zero, positive with the crank's rotation [deg]
    angle: float
    position: float  # Its place along the shaft, as those of the cylinders [m]
    place: ShaftPlace = ShaftPlace()  # Where the shaft lies


def balance_shafts(
    part: OrderBalance,
    speed: float,
    planes: tuple[float] | tuple[float, float] = (0.0,),
    places: tuple[ShaftPlace, ShaftPlace] = (ShaftPlace(), ShaftPlace()),
) -> tuple[ShaftWeight, ...]:
    """Return the weights that balance one order (taylor_1985, vol. 2, ch. 8).

    As many weights as are needed; none for what is balanced already. `part`: what is free, its moment about the
    position zero [N], [N m]; `planes`: positions of the weights along the shafts: one takes the force, two take force
    and moment [m]; `places`: where the shaft that turns with the crank lies, and the one that turns against it [m].
    """
    weights = []
    for sense, force, moment, place in zip((1, -1), part.force, part.moment, places, strict=True):
        for needed, plane in zip(_needed(force, moment, planes), planes, strict=True):
            if needed:
                mass_moment = abs(needed) / (part.order * speed) ** 2
                angle = float(np.degrees(np.angle(-needed)) % 360)
                weights.append(ShaftWeight(part.order, sense, mass_moment, angle, plane, place))
    return tuple(weights)


def shaft_forces(weights: Sequence[ShaftWeight], speed: float, *, about: float = 0.0) -> tuple[OrderBalance, ...]:
    """Return force and moment of balance shafts, order by order (den_hartog_1956, ch. 5).

    To be added to those of the cylinders by `balance_sum` [N], [N m].
    """
    forces = []
    for weight in weights:
        force = weight.mass_moment * (weight.order * speed) ** 2 * complex(unit_vectors(weight.angle))
        forward, backward = (force, 0j) if weight.sense > 0 else (0j, force)
        arm = weight.position - about
        forces.append(OrderBalance(weight.order, Ellipse(forward, backward), Ellipse(arm * forward, arm * backward)))
    return balance_sum(forces)


def _needed(force: complex, moment: complex, planes: tuple[float, ...]) -> tuple[complex, ...]:
    """Return the forces to be balanced in each plane."""
    if len(planes) == 1:
        return (force,)
    first, second = planes
    # a moment is a force at one end and its opposite at the other
    couple = moment / (second - first) if second != first else 0j
    return in_two_planes([force, -couple, couple], [0.0, first, second], (first, second))
