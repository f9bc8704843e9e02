"""Dampers between two points and on sliding pieces: forces against the rate of their length."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import given, is_traced, named
from crankwork.kinematics.kinematic_coefficients import slider_velocity
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import AppliedLoads, check_name, force_between, force_on_slider
from crankwork.loads.spring import spring_length
from crankwork.locale import ErrorMessage
from crankwork.mechanism.mechanism import Mechanism


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
    for name in (load.start, load.end):
        check_name("point", name, motion.points)
    start, end = motion.points[load.start], motion.points[load.end]
    name = f"{load.start}.{load.end}"
    x, x_1, y, y_1 = (
        end_value - start_value
        for start_axis, end_axis in zip(start, end, strict=True)
        for start_value, end_value in zip(start_axis[:2], end_axis[:2], strict=True)
    )
    length = named(spring_length(x, y), f"damper_length.{name}")
    if not is_traced(length) and np.any(length == 0):
        raise GeometryError(ErrorMessage("damper_shut", start=load.start, end=load.end))
    rate = named(damper_velocity(x, x_1, y, y_1, length, speed), f"damper_velocity.{name}")
    force = named(damper_force(_damping(load, name, rate, path), rate), f"damper_force.{name}")
    return force_between(
        mechanism, motion, (load.start, load.end), (x / length * force, y / length * force),
        (load.start_link, load.end_link),
    )  # fmt: skip


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
