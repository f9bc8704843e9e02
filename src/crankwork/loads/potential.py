"""The potential energy of loads: springs, weights and constant forces."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.bodies import centre_of_mass
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.loads.load import Load
from crankwork.loads.process import ForceOnPoint
from crankwork.loads.spring import SliderSpring, Spring, spring_length
from crankwork.loads.weight import Weight
from crankwork.mechanism.mechanism import Mechanism


@formula("potential_energy", "norton_2012, ch. 8")
def spring_energy(c: Value, s: Value, s_0: Value, F_0: Value) -> Value:
    """Potential energy of a linear spring."""
    return c * (s - s_0) ** 2 / 2 + F_0 * (s - s_0)


@formula("potential_energy", "artobolevsky_1988, ch. 15")
def energy_of_force(F_x: Value, r_x: Value, F_y: Value, r_y: Value) -> Value:
    """Potential energy of a constant force."""
    return -(F_x * r_x + F_y * r_y)


def has_potential(load: Load) -> bool:
    """Return whether a load has a potential energy."""
    return isinstance(load, Spring | SliderSpring | Weight | ForceOnPoint)


def potential_energy(mechanism: Mechanism, motion: Motion, loads: Iterable[Load]) -> Array:
    """Return the potential energy of the loads that have one (artobolevsky_1988, ch. 15). [J]"""
    energy = np.zeros_like(motion.grid.angle)
    for load in loads:
        match load:
            case Spring():
                (x, y), (u, v) = (motion.points[name] for name in (load.start, load.end))
                length = spring_length(u.position - x.position, v.position - y.position)
                energy += spring_energy(load.stiffness, length, load.free_length, load.preload)
            case SliderSpring():
                place = motion.sliders[load.slider].position
                energy += spring_energy(load.stiffness, place, load.free_position, load.preload)
            case ForceOnPoint():
                x, y = motion.points[load.point]
                energy += energy_of_force(load.x, x.position, load.y, y.position)
            case Weight():
                pull = load.gravity * math.cos(load.direction), load.gravity * math.sin(load.direction)
                for body in mechanism.bodies:
                    x, y = centre_of_mass(body, motion)
                    energy += energy_of_force(body.mass * pull[0], x.position, body.mass * pull[1], y.position)
    return energy
