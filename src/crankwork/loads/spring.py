"""Springs between two points and on sliding pieces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, given, is_traced, named
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import AppliedLoads, check_name, force_between, force_on_slider
from crankwork.locale import ErrorMessage
from crankwork.mechanism.mechanism import Mechanism


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


def point_spring(load: Spring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on the two links that it joins."""
    for name in (load.start, load.end):
        check_name("point", name, motion.points)
    start, end = motion.points[load.start], motion.points[load.end]
    x, y = end.x.position - start.x.position, end.y.position - start.y.position
    name = f"{load.start}.{load.end}"
    length = named(spring_length(x, y), f"spring_length.{name}")
    if not is_traced(length) and np.any(length == 0):
        raise GeometryError(ErrorMessage("spring_shut", start=load.start, end=load.end))
    stiffness, free, preload = _stated(load, load.free_length, name, length, path)
    force = named(spring_force(stiffness, length, free, preload), f"spring_force.{name}")
    return force_between(
        mechanism, motion, (load.start, load.end), (x / length * force, y / length * force),
        (load.start_link, load.end_link),
    )  # fmt: skip


def slider_spring(load: SliderSpring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on a sliding piece and on the link that carries its guide."""
    check_name("sliding piece", load.slider, motion.sliders)
    position = motion.sliders[load.slider].position
    stiffness, free, preload = _stated(load, load.free_position, load.slider, position, path)
    force = -named(spring_force(stiffness, position, free, preload), f"spring_force.{load.slider}")
    return force_on_slider(mechanism, motion, load.slider, force, other="_spring")
