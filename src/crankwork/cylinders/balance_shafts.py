"""Balance shafts beside the crankshaft, with or against its rotation at a multiple of its speed.

The forward part of an order takes a shaft that turns with the crankshaft, the backward part one that turns against it.
Where the cylinders stand in one plane the two parts are equal, and the two shafts are the pair of Lanchester.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.cylinders.counterweights import in_two_planes
from crankwork.cylinders.ellipse import Ellipse, OrderBalance, balance_sum, unit_vectors


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
        force = _force(weight, speed)
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


def _force(weight: ShaftWeight, speed: float) -> complex:
    """Return the force of a weight at crank angle zero."""
    return weight.mass_moment * (weight.order * speed) ** 2 * complex(unit_vectors(weight.angle))
