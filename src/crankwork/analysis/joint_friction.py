"""A linkage with friction in its joints: torque, forces, losses, efficiency, and where it locks or holds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from crankwork.analysis.friction_regimes import FrictionEquilibrium, FrictionRegimes, StepFunction
from crankwork.analysis.mechanism_trace import joint_columns
from crankwork.analysis.prepared import Notice, PreparedLinkage, relative_difference
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import (
    Friction,
    GuideFriction,
    PinFriction,
    friction_couple,
    friction_force,
    friction_power_of_guide,
    friction_power_of_pin,
    friction_radius,
    friction_radius_of_angle,
    friction_torque,
    instantaneous_efficiency,
    pressing_force,
    relative_rate,
    tilting_force,
)
from crankwork.dynamics.friction_equations import CONVERGED
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.operating_state import OperatingState
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.routes import torque_by_energy
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Component, Piecewise, ProcedureValue, Root, TracedValue, absent, given, total
from crankwork.kinematics import kinematic_coefficients as rates
from crankwork.kinematics.bodies import broadcast
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.traced_motion import interpolant_of
from crankwork.loads.applied_loads import AppliedLoads, force_on_slider, torque_on
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, names_of_pivots
from crankwork.mechanism.linkage import GROUND

COLUMNS = (
    "torque_with_friction", "static_torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction",
    "instantaneous_efficiency", "friction_power", "friction_torque", "friction_force", "joint_force_with_friction_x",
    "joint_force_with_friction_y", "joint_force_with_friction", "normal_force_with_friction",
    "normal_moment_with_friction",
)  # fmt: skip
# columns whose extremes are taken if the forces balance everywhere
FOLLOWED = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "friction_power",
    "joint_force_with_friction", "static_torque_with_friction",
)  # fmt: skip
_OF_MOTION = ("self_locking", "not_balanced", "two_balances")
_REST = 1e-12
_CLOSE = 1e-6


class FrictionColumns(NamedTuple):
    """Results that friction adds to those of a linkage: columns, checks, notices, and whether it never locks."""

    columns: dict[str, TracedValue]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    is_free: bool


# quantities of the numbers that are stated of a joint with friction by field, and the units of their display
STATED = {
    PinFriction: {
        "coefficient": ("pin_friction", ""), "radius": ("pin_radius", "mm"), "moment": ("constant_moment", "N*m"),
        "damping": ("angular_damping", "N*m*s/rad"),
    },
    GuideFriction: {
        "coefficient": ("guide_friction", ""), "length": ("piece_length", "mm"), "middle_x": ("piece_middle_x", "mm"),
        "middle_y": ("piece_middle_y", "mm"), "force": ("constant_force", "N"), "damping": ("damping", "N*s/m"),
    },
}  # fmt: skip


class _Place(NamedTuple):
    """A joint with friction, its law, its name in columns, and where the description states the law."""

    joint: Joint
    law: Friction
    name: str
    path: str


def add_friction(solved: PreparedLinkage, running: OperatingState, trace: Mapping[str, TracedValue]) -> FrictionColumns:
    """Return the results that friction adds to a linkage at work (artobolevsky_1988, ch. 11 and 14).

    `running`: the linkage at work, traced; `trace`: its columns without friction.
    """
    if not solved.machine.friction:
        return FrictionColumns({}, {}, (), is_free=False)
    motion = running.motion
    places, span = list(_places(solved)), _span(motion)
    velocities = {place.law: _velocity(motion, place, running.speed) for place in places}
    senses = _senses(motion, velocities)
    balance = FrictionEquilibrium(solved, senses)
    regimes = FrictionRegimes(balance, span)
    root, friction, forces = _with_friction(places, velocities, balance, regimes.knots, running)
    columns = {value.key: value for value in friction.values()}
    powers = [_power(place, friction[place.law], velocities[place.law]) for place in places]
    columns |= {power.key: power for power in powers} | {"friction_power": total("friction_power", powers)}
    columns |= joint_columns(solved.machine, forces, "_with_friction")
    notices, standing, is_free = [*regimes.notices(solved, _OF_MOTION)], regimes, regimes.is_free
    if solved.machine.mechanism.driver.law is not None:
        kind = "driver_torque" if solved.machine.mechanism.driver.turns else "driver_force"
        columns[f"{kind}_with_friction"] = forces.balancing_torque
    else:
        columns["torque_with_friction"] = forces.balancing_torque
        still = FrictionEquilibrium(solved, senses, is_static=True)
        static = forces.balancing_torque
        if solved.machine.mechanism.bodies:
            standing = FrictionRegimes(still, span)
            alone = replace(running, mechanism=replace(running.mechanism, bodies=()))
            static = _with_friction(places, velocities, still, standing.knots, alone)[2].balancing_torque
            is_free &= standing.is_free
        static = static.named("static_torque_with_friction")
        columns |= {static.key: static} | _efficiency(trace["static_torque"], static, standing)
    notices += standing.notices(solved, ("friction_holds",))
    checks = _checks(balance, regimes, columns, root)
    return FrictionColumns({key: value.named(key) for key, value in columns.items()}, checks, tuple(notices), is_free)


def mean_values(over: CycleInterpolant) -> Iterator[TracedValue]:
    """Yield the mean loss over a cycle, and the efficiency that the work of a cycle gives; nothing without friction."""
    if "friction_power" in over.columns:
        yield over.mean("friction_power", "mean_friction_power")
    if "torque_with_friction" in over.columns:
        keys = "static_torque", "torque_with_friction"
        ideal, actual = (over.mean(key, f"{key}.mean") for key in keys)
        if 0 < ideal.value <= actual.value:
            yield instantaneous_efficiency(ideal, actual).named("mean_efficiency")


def _places(solved: PreparedLinkage) -> Iterator[_Place]:
    """Yield the joints with friction."""
    machine, held = solved.machine, all_links_and_joints(solved.machine.mechanism)[1]
    for law in machine.friction:
        kind, name = (SlidingJoint, law.slider) if isinstance(law, GuideFriction) else (Pin, law.joint)
        joint = next(item for item in held if isinstance(item, kind) and item.name == name)
        shown = names_of_pivots(solved.machine.mechanism).get(name, name) if kind is Pin else name
        yield _Place(joint, law, shown, f"friction.{'pins' if kind is Pin else 'sliders'}.{shown}")


def _span(motion: Motion) -> tuple[float, float]:
    """Return the first and the last crank angle of a motion. [deg]"""
    over = interpolant_of(motion.grid)({})
    return float(over.edges[0]), float(over.edges[-1])


def _velocity(motion: Motion, place: _Place, w: TracedValue) -> TracedValue:
    """Return the relative angular or sliding velocity of the links of a joint."""
    rate = broadcast(relative_rate(motion, place.joint), motion.grid)
    if isinstance(place.joint, Pin):
        velocity: TracedValue = rates.link_angular_velocity(rate, w).named(f"relative_speed.{place.name}")
    else:
        velocity = rates.slider_velocity(rate, w).named(f"slider_velocity.{place.name}")
    return velocity


def _senses(motion: Motion, velocities: Mapping[Friction, TracedValue]) -> dict[Friction, StepFunction]:
    """Return the direction of the friction of each joint: against the velocity, none where a law dwells."""
    varying = {str(index): velocity for index, velocity in enumerate(velocities.values()) if velocity.varies}
    over = interpolant_of(motion.grid)(varying)
    end, steps = float(over.edges[-1]), []
    middles = (over.edges[1:] + over.edges[:-1]) / 2
    size = {
        index: max(float(np.max(np.abs(over.at(str(index), middles)))) if velocity.varies else abs(velocity.value), 0.0)
        for index, velocity in enumerate(velocities.values())
    }
    kinds = [isinstance(law, GuideFriction) for law in velocities]
    for index, velocity in enumerate(velocities.values()):
        ends, values = [end], [-float(np.sign(velocity.node.value or 0.0))]
        if velocity.varies:
            edges = np.unique([float(over.edges[0]), *over.breaks, *over.crossings(str(index)), end])
            inside = over.at(str(index), (edges[1:] + edges[:-1]) / 2)
            largest = max(size[other] for other, kind in enumerate(kinds) if kind == kinds[index])
            signs = np.where(np.abs(inside) > _REST * largest, -np.sign(inside), 0.0)
            kept = np.append(np.diff(signs) != 0, True)
            ends, values = edges[1:][kept].tolist(), signs[kept].tolist()
        steps.append(StepFunction(tuple(ends), tuple(values)))
    return dict(zip(velocities, steps, strict=True))


def _with_friction(
    places: Sequence[_Place],
    velocities: Mapping[Friction, TracedValue],
    balance: FrictionEquilibrium,
    knots: tuple[float, ...],
    running: OperatingState,
) -> tuple[Root, dict[Friction, TracedValue], JointForces]:
    """Return the pressing forces of the joints, the friction of each, and the joint forces with it.

    The pressing forces of all joints are found together; the difference of each from the force in its joint is the
    residual of an equation.
    """
    root = Root(balance)
    root.knots = knots
    friction, loads, pressing = dict[Friction, TracedValue](), AppliedLoads(), dict[Friction, TracedValue]()
    for index, place in enumerate(places):
        sense = _sense(balance.senses[place.law], velocities[place.law], place.name)
        kind = "joint_force_with_friction" if isinstance(place.joint, Pin) else "pressing_force"
        pressing[place.law] = TracedValue(Component(root, index), f"{kind}.{place.name}")
        value = friction[place.law] = _law(place, sense, pressing[place.law], velocities[place.law])
        loads = loads.also(_on_links(running, place, value))
    forces = joint_forces(replace(running, loads=running.loads.also(loads)))
    root.residuals = tuple(_missing(place, pressing[place.law], forces) for place in places)
    return root, friction, forces


def _sense(steps: StepFunction, velocity: TracedValue, name: str) -> TracedValue:
    values = tuple(
        TracedValue(ProcedureValue(value, "against", (velocity,)), "friction_sense") for value in steps.values
    )
    return (values[0] if len(values) == 1 else TracedValue(Piecewise(steps.ends, values))).named(
        f"friction_sense.{name}"
    )


def _stated(place: _Place, name: str) -> TracedValue:
    """Return a number of the friction in a joint; `name`: of its field."""
    value, (key, _) = getattr(place.law, name), STATED[type(place.law)][name]
    path = f"sliders.{place.name}.points" if name.startswith("middle") else f"{place.path}.{name}"
    return given(f"{key}.{place.name}", value, path) if value else absent(key)


def _law(place: _Place, sense: TracedValue, pressing: TracedValue, velocity: TracedValue) -> TracedValue:
    """Return the friction moment or force on the link that a joint holds."""
    law, name = place.law, place.name
    if isinstance(law, GuideFriction):
        coefficient = _stated(place, "coefficient")
        constant = _stated(place, "force")
        damping = _stated(place, "damping")
        force: TracedValue = friction_force(sense, coefficient, pressing, constant, damping, velocity)
        return force.named(f"friction_force.{name}")
    circle = friction_radius if law.circle == "tangent" else friction_radius_of_angle
    radius: TracedValue = absent("friction_radius")
    if law.coefficient:
        coefficient = _stated(place, "coefficient")
        radius = circle(coefficient, _stated(place, "radius"))
        radius = radius.named(f"friction_radius.{name}")
    constant = _stated(place, "moment")
    damping = _stated(place, "damping")
    moment: TracedValue = friction_torque(sense, radius, pressing, constant, damping, velocity)
    return moment.named(f"friction_torque.{name}")


def _on_links(running: OperatingState, place: _Place, value: TracedValue) -> AppliedLoads:
    """Return the friction of a joint as loads on its two links."""
    joint, law = place.joint, place.law
    if isinstance(law, PinFriction):
        return _torque_between(running, joint, value)
    force = force_on_slider(running.mechanism, running.motion, joint.link, value, ".friction")
    if not law.middle[1]:
        return force
    couple: TracedValue = friction_couple(value, _stated(place, "middle_y")).named(f"friction_couple.{place.name}")
    return force.also(_torque_between(running, joint, couple))


def _torque_between(running: OperatingState, joint: Joint, torque: TracedValue) -> AppliedLoads:
    """Return a torque on the link that a joint holds, and its reaction on the other."""
    own = torque_on(running.motion, joint.link, torque)
    return own if joint.other == GROUND else own.also(torque_on(running.motion, joint.other, -torque))


def _missing(place: _Place, pressing: TracedValue, forces: JointForces) -> TracedValue:
    """Return the difference of the pressing force of a joint from the force in it."""
    law, name = place.law, place.joint.name
    if isinstance(place.joint, Pin):
        force: TracedValue = forces.pins[name].resultant
        return pressing - force.named(f"joint_force.{place.name}")
    guide = forces.guides[name]
    tilting: TracedValue = absent("tilting_force")
    if isinstance(law, GuideFriction) and law.length:
        length = _stated(place, "length")
        tilting = tilting_force(guide.moment, guide.normal, _stated(place, "middle_x"), length).named(
            f"tilting_force.{place.name}"
        )
    pressed: TracedValue = pressing_force(guide.normal, tilting)
    return pressing - pressed.named(f"pressing_force.{place.name}")


def _power(place: _Place, friction: TracedValue, velocity: TracedValue) -> TracedValue:
    formula = friction_power_of_guide if isinstance(place.law, GuideFriction) else friction_power_of_pin
    power: TracedValue = formula(friction, velocity)
    return power.named(f"friction_power.{place.name}")


def _efficiency(ideal: TracedValue, actual: TracedValue, regimes: FrictionRegimes) -> dict[str, TracedValue]:
    """Return the efficiency, of the crank as driver or of the load; none where neither moves the other."""
    laws = {
        1: instantaneous_efficiency(ideal, actual),
        -1: instantaneous_efficiency(actual, ideal),
        0: absent("instantaneous_efficiency", np.nan),
    }
    steps = regimes.drives
    if not any(steps.values):
        return {}
    return {
        "instantaneous_efficiency": TracedValue(
            Piecewise(steps.ends, tuple(laws[int(value)] for value in steps.values))
        )
    }


def _checks(
    balance: FrictionEquilibrium, regimes: FrictionRegimes, columns: Mapping[str, TracedValue], root: Root
) -> dict[str, float]:
    """Return the error of the power balance, and the difference of forces found joint by joint from all at once."""
    # where loads jump with the friction or at an end, rounding decides which side an angle is on
    is_clear = np.diff(regimes.degrees, prepend=regimes.degrees[0], append=regimes.degrees[-1]) > _CLOSE
    degrees = regimes.degrees[(regimes.forces.status == CONVERGED) & is_clear[1:] & is_clear[:-1]]
    if not degrees.size:
        return {}
    grid = CrankGrid.from_degrees(degrees)
    values, running = balance.at(degrees), balance.running(grid)
    power = running.speed * np.asarray(values.joint_forces.balancing_torque)
    key = next(item for item in FOLLOWED if item in columns)
    missing = {str(index): residual for index, residual in enumerate(root.residuals)}
    torque, loss, *missed = Program({"": columns[key], "loss": columns["friction_power"], **missing})(grid).values()
    # a pressing force of zero has the rounding error of the other forces
    sizes = [*values.pressing.values(), *(np.asarray(pin.resultant) for pin in values.joint_forces.pins.values())]
    largest = max(float(np.max(size)) for size in sizes)
    return {
        "friction_power": relative_difference(running.speed * torque_by_energy(running) + loss, power),
        "friction_forces": max(
            relative_difference(torque, np.asarray(values.joint_forces.balancing_torque)),
            float(np.max(np.abs(missed))) / largest if largest else 0.0,
        ),
    }
