"""Springs, dampers, weights; every kind of load, the forces that a list of them makes, and their potential energy."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, given, is_traced, named
from crankwork.kinematics.bodies import broadcast, centre_of_mass
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.kinematic_coefficients import slider_velocity
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import (
    AppliedForce,
    AppliedLoads,
    check_name,
    combine_loads,
    force_between,
    force_on_slider,
)
from crankwork.loads.process import ForceOnPoint, ProcessForce, TorqueOnLink, constant_force, link_torque, process_force
from crankwork.locale import ErrorMessage
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import STANDARD_GRAVITY


@dataclass(frozen=True)
class Spring:
    """A straight spring between two points."""

    # The points it joins, of links or fixed
    start: str
    end: str
    stiffness: float  # Force per length [N/m]
    free_length: float  # Length at which it pulls with the preload only [m]
    preload: float = 0.0  # Pull at the free length [N]
    # Links it is fixed to; empty for the first of the links that meet there
    start_link: str = ""
    end_link: str = ""


@dataclass(frozen=True)
class SliderSpring:
    """A spring along a guide, between a sliding piece and the link of the guide."""

    slider: str  # The sliding piece
    stiffness: float  # Force per length [N/m]
    # Distance of the piece along its guide at which the spring pulls with the preload only [m]
    free_position: float = 0.0
    preload: float = 0.0  # Pull there, against the direction in which that distance counts [N]


@formula("spring_force", "norton_2012, ch. 8")
def spring_force(c: Value, s: Value, s_0: Value, F_0: Value) -> Value:
    """Pull of a linear spring."""
    return c * (s - s_0) + F_0


@formula("spring_length", "norton_2012, ch. 8")
def spring_length(dx: Value, dy: Value) -> Value:
    """Distance of the ends of a spring."""
    return np.sqrt(dx**2 + dy**2)


def _stated(
    load: Spring | SliderSpring, free: float, name: str, length: Value, path: str
) -> tuple[Value, Value, Value]:
    """Return stiffness, free length and preload of a spring, traced if its length is traced."""
    if not is_traced(length):
        return load.stiffness, free, load.preload
    pull, at_free = load.preload, given(f"spring_length.{name}.free", free, f"{path}.free_length")
    return (
        given(f"spring_stiffness.{name}", load.stiffness, f"{path}.stiffness"),
        at_free if free else absent("spring_length"),
        given(f"spring_force.{name}.preload", pull, f"{path}.preload") if pull else absent("spring_force"),
    )


def _ends(load: Spring | Damper, motion: Motion) -> tuple[str, Value, Value]:
    """Return the name of a spring or damper in keys, and how far its end is from its start along the axes. [m]"""
    for name in (load.start, load.end):
        check_name("point", name, motion.points)
    start, end = motion.points[load.start], motion.points[load.end]
    return f"{load.start}.{load.end}", end.x.position - start.x.position, end.y.position - start.y.position


def _length(load: Spring | Damper, x: Value, y: Value, kind: str) -> Value:
    """Return the length of a spring or damper; raise if both ends meet. [m]"""
    length = named(spring_length(x, y), f"{kind}_length.{load.start}.{load.end}")
    if not is_traced(length) and np.any(length == 0):
        raise GeometryError(ErrorMessage(f"{kind}_shut", start=load.start, end=load.end))
    return length


def _pull(load: Spring | Damper, mechanism: Mechanism, motion: Motion, pull: tuple[Value, Value]) -> AppliedLoads:
    """Return the pull of a spring or damper on its links; `pull`: on its start, along the axes. [N]"""
    return force_between(mechanism, motion, (load.start, load.end), pull, (load.start_link, load.end_link))


def point_spring(load: Spring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on the two links that it joins."""
    name, x, y = _ends(load, motion)
    length = _length(load, x, y, "spring")
    stiffness, free, preload = _stated(load, load.free_length, name, length, path)
    force = named(spring_force(stiffness, length, free, preload), f"spring_force.{name}")
    return _pull(load, mechanism, motion, (x / length * force, y / length * force))


def slider_spring(load: SliderSpring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on a sliding piece and on the link that carries its guide."""
    check_name("sliding piece", load.slider, motion.sliders)
    position = motion.sliders[load.slider].position
    stiffness, free, preload = _stated(load, load.free_position, load.slider, position, path)
    force = -named(spring_force(stiffness, position, free, preload), f"spring_force.{load.slider}")
    return force_on_slider(mechanism, motion, load.slider, force, other="_spring")


@dataclass(frozen=True)
class Damper:
    """A straight damper between two points."""

    # The points it joins, of links or fixed
    start: str
    end: str
    damping: float  # Force over the rate of its length [N s/m]
    # Links it is fixed to; empty for the first ones of those that meet there
    start_link: str = ""
    end_link: str = ""


@dataclass(frozen=True)
class SliderDamper:
    """A damper along a guide, between a sliding piece and the link of the guide."""

    slider: str  # The sliding piece
    damping: float  # Force over the velocity along the guide [N s/m]


@formula("damper_force", "norton_2012, ch. 10")
def damper_force(d: Value, v_l: Value) -> Value:
    """Pull of a damper."""
    return d * v_l


@formula("damper_velocity", "norton_2012, ch. 10")
def damper_velocity(dx: Value, dx_1: Value, dy: Value, dy_1: Value, s: Value, w: Value) -> Value:
    """Rate of the distance of the ends of a damper."""
    return (dx * dx_1 + dy * dy_1) / s * w


def point_damper(load: Damper, mechanism: Mechanism, motion: Motion, speed: Value, path: str = "") -> AppliedLoads:
    """Return the forces of a damper on the two links that it joins."""
    name, x, y = _ends(load, motion)
    length = _length(load, x, y, "damper")
    start, end = motion.points[load.start], motion.points[load.end]
    rates = end.x.position_1 - start.x.position_1, end.y.position_1 - start.y.position_1
    rate = named(damper_velocity(x, rates[0], y, rates[1], length, speed), f"damper_velocity.{name}")
    force = named(damper_force(_damping(load, name, rate, path), rate), f"damper_force.{name}")
    return _pull(load, mechanism, motion, (x / length * force, y / length * force))


def slider_damper(
    load: SliderDamper, mechanism: Mechanism, motion: Motion, speed: Value, path: str = ""
) -> AppliedLoads:
    """Return the forces of a damper on a sliding piece and on the link that carries its guide."""
    check_name("sliding piece", load.slider, motion.sliders)
    rate = named(slider_velocity(motion.sliders[load.slider].position_1, speed), f"slider_velocity.{load.slider}")
    force = -named(damper_force(_damping(load, load.slider, rate, path), rate), f"damper_force.{load.slider}")
    return force_on_slider(mechanism, motion, load.slider, force, ".damper")


def _damping(load: Damper | SliderDamper, name: str, rate: Value, path: str) -> Value:
    return given(f"damping.{name}", load.damping, f"{path}.damping") if is_traced(rate) else load.damping


@dataclass(frozen=True)
class Weight:
    """Gravity on every body."""

    gravity: float = STANDARD_GRAVITY  # Acceleration of free fall [m/s2]
    direction: float = -math.pi / 2  # Where it pulls, from the x axis [rad]


@formula("load_x", "artobolevsky_1988, ch. 12")
def weight_along(m_i: Value, g: Value, cos_ga: Value) -> Value:
    """Component of a weight along a fixed axis."""
    return m_i * g * cos_ga


def weight(load: Weight, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return the weights of the bodies of a mechanism."""
    gravity: Value = load.gravity
    if is_traced(motion.grid.angle):
        gravity = given("gravity", load.gravity, "method.gravity")
    forces = []
    for body in mechanism.bodies:
        x, y = (weight_along(body.mass, gravity, part) for part in (math.cos(load.direction), math.sin(load.direction)))
        x, y = named(x, f"load_x.{body.link}.weight"), named(y, f"load_y.{body.link}.weight")
        forces.append(
            AppliedForce(body.link, centre_of_mass(body, motion), broadcast(x, motion.grid), broadcast(y, motion.grid))
        )
    return AppliedLoads(tuple(forces))


@runtime_checkable
class LoadLaw(Protocol):
    """A load of one's own: what it puts on the links, wherever they are.

    Examples
    --------
    A pull on point C that grows with its distance from the origin:

    >>> class Tether:
    ...     def forces(self, mechanism, motion, speed):
    ...         at = motion.points["C"]
    ...         return force_at(mechanism, motion, "C", (-50.0 * at.x.position, -50.0 * at.y.position))
    >>> isinstance(Tether(), LoadLaw)
    True
    """

    def forces(self, mechanism: Mechanism, motion: Motion, speed: Value) -> AppliedLoads:
        """Return forces at moving points [N] and torques on links [N m]; `speed`: of the driver [rad/s] or [m/s]."""


Load = (
    ProcessForce | ForceOnPoint | TorqueOnLink | Spring | SliderSpring | Damper | SliderDamper
    | Weight | LoadLaw
)  # fmt: skip


def applied_loads(mechanism: Mechanism, motion: Motion, loads: Iterable[Load], speed: Value = 0.0) -> AppliedLoads:
    """Return the forces at moving points [N] and the torques on links [N m] that act on a mechanism.

    `speed`: rate of the driver's coordinate, which dampers follow [rad/s] or [m/s].
    """
    return combine_loads(
        _applied(load, mechanism, motion, speed, f"loads[{number}]") for number, load in enumerate(loads, start=1)
    )


def _applied(load: Load, mechanism: Mechanism, motion: Motion, speed: Value, path: str) -> AppliedLoads:
    match load:
        case ProcessForce():
            return process_force(load, motion, path)
        case ForceOnPoint():
            return constant_force(load, mechanism, motion, path)
        case TorqueOnLink():
            return link_torque(load, motion, path)
        case Spring():
            return point_spring(load, mechanism, motion, path)
        case SliderSpring():
            return slider_spring(load, mechanism, motion, path)
        case Damper():
            return point_damper(load, mechanism, motion, speed, path)
        case SliderDamper():
            return slider_damper(load, mechanism, motion, speed, path)
        case Weight():
            return weight(load, mechanism, motion)
    return load.forces(mechanism, motion, speed)


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
                energy += spring_energy(
                    load.stiffness, spring_length(*_ends(load, motion)[1:]), load.free_length, load.preload
                )
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
