"""The forces from the gas to the crankshaft of one cylinder, traced."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

from crankwork.analysis.reduction import REDUCTION, cylinder_reduction
from crankwork.analysis.results import Results
from crankwork.cylinders.articulated import (
    KnuckleMass,
    articulated_forces,
    knuckle_acceleration_across,
    knuckle_acceleration_along,
)
from crankwork.cylinders.load_vectors import (
    big_end_inertia_force,
    big_end_tangential_force,
    big_end_weight,
    crankpin_radial_force,
    crankpin_tangential_force,
    piston_pin_force,
)
from crankwork.dynamics import piston_forces as forces
from crankwork.dynamics.masses import CrankGearMasses, reciprocating_mass, rotating_mass
from crankwork.dynamics.reaction import joint_force, pin_columns
from crankwork.errors import MethodError
from crankwork.formula.expression import Value
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue, absent
from crankwork.kinematics import slider_crank
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.piston import only_rod
from crankwork.machine import Machine
from crankwork.method import Method
from crankwork.preparation import traced_inputs
from crankwork.preparation.cylinder_gas import gas_of_cylinder
from crankwork.preparation.piston_kinematics import KINEMATICS, CylinderKinematics, harmonic_trace, inertia_acceleration
from crankwork.preparation.prepared import PreparedCylinder, prepare

FORCES = (
    "gas_pressure", "gas_force", "inertia_acceleration", "inertia_force", "weight_force", "transverse_weight",
    "piston_force", "side_force", "rod_force",
    "rod_transverse_force", "radial_force", "tangential_force", "rotating_inertia_force", "rotating_torque",
    "crank_torque", "overturning_moment",
)  # fmt: skip
COLUMNS = ("crank_angle", *KINEMATICS, "cylinder_volume", *FORCES, "knuckle_side_force", "knuckle_couple", *REDUCTION)


def cylinder_trace(solved: PreparedCylinder) -> dict[str, TracedValue]:
    """Return everything about one cylinder by key: motion, gas and forces, each traced.

    Source: kolchin_demidov_2008, ch. 6 and 7.
    """
    trace = gas_of_cylinder(solved) | harmonic_trace(solved)
    moving = solved.moving._replace(trace=trace)
    if solved.machine.masses is not None:
        trace |= _by_key(_masses(solved, solved.machine.masses, moving))
    if solved.machine.masses is not None or solved.space is not None:
        trace |= _by_key(_axial_forces(solved, moving))
        trace |= _by_key(
            _articulated_forces(solved, moving) if solved.articulated_rod is not None else _rod_forces(solved, moving)
        )
    if "piston_force" in trace:
        trace |= _by_key(_in_joints(solved, moving))
    if solved.machine.masses is not None:
        trace |= _by_key(cylinder_reduction(moving))
    return trace


class TracedCylinder(PreparedCylinder):
    """A crank gear with everything about it traced."""

    @cached_property
    def trace(self) -> dict[str, TracedValue]:
        """Everything about the cylinder by key."""
        return cylinder_trace(self)


def traced_cylinder(machine: Machine, method: Method) -> TracedCylinder:
    """Return the crank gear of a machine, made ready for a method."""
    return prepare(machine, method, TracedCylinder)


def columns(solved: TracedCylinder, grid: CrankGrid, keys: Iterable[str] = COLUMNS) -> dict[str, Array]:
    """Return columns of one cylinder at crank angles within one cycle. [SI]

    `keys`: which; those that the machine does not have are left out.
    """
    return Program({key: solved.trace[key] for key in keys if key in solved.trace})(grid)


def _by_key(values: Iterable[TracedValue]) -> dict[str, TracedValue]:
    return {item.key: item for item in values}


def _masses(solved: PreparedCylinder, masses: CrankGearMasses, moving: CylinderKinematics) -> Iterator[TracedValue]:
    area = moving.trace.get("piston_area")
    if moving.articulated_rod is not None:
        engine, own = solved.machine.engine, moving.articulated_rod.own.length
        is_own = engine is not None and engine.articulated_masses is not None
        rod = (own, "engine.articulated") if is_own else (moving.lengths.rod_length, "rod")
        piston, crank, small, big, *excess = traced_inputs.masses(solved.machine, masses, area, *rod)
        yield from (piston, small, big.named("knuckle_mass"), *excess, reciprocating_mass(piston, small))
        return
    piston, crank, small, big, *excess = traced_inputs.masses(solved.machine, masses, area, moving.lengths.rod_length)
    yield from (piston, small, crank, big, *excess, reciprocating_mass(piston, small), rotating_mass(crank, big))


def _axial_forces(solved: PreparedCylinder, moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield inertia, weight and, with the gas, their sum along the cylinder axis."""
    machine, trace = solved.machine, moving.trace
    inertia, weight = absent("inertia_force"), absent("weight_force")
    if machine.masses is not None:
        mass, acceleration = trace["reciprocating_mass"], inertia_acceleration(solved)
        if acceleration is not trace["piston_acceleration"]:
            yield acceleration
        inertia = forces.inertia_force(mass, acceleration)
        yield inertia
        if machine.has_gravity:
            g = traced_inputs.gravity(machine, solved.method)
            cos, sin = traced_inputs.inclination(machine, solved.lean)
            weight = forces.weight_force(mass, g, cos)
            yield weight
            across = forces.transverse_weight(mass, g, sin)
            if across.value:
                yield across
    yield forces.piston_force(trace.get("gas_force", absent("gas_force")), inertia, weight)


def _rod_forces(solved: PreparedCylinder, moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield the forces of the rod, alone or with the correction couple that makes it a rigid rod, and the torque."""
    trace, (r, l, e), angle = moving.trace, moving.lengths, moving.angle  # noqa: E741
    P, swing = trace["piston_force"], moving.motion.swing
    couple = list(_couple(solved, moving, l))
    yield from couple
    dN = couple[-1] if couple else absent("side_force.couple")
    across = trace.get("transverse_weight", absent("transverse_weight"))
    rod = forces.rod_forces(P, angle, swing, dN=dN, F_wn=across)
    yield from rod
    yield slider_crank.side_factor(swing.sin, swing.cos)
    yield slider_crank.rod_factor(swing.cos)
    yield slider_crank.radial_factor(swing.cos_sum, swing.cos)
    yield slider_crank.tangential_factor(swing.sin_sum, swing.cos)
    rotating = list(_rotating(solved, moving))
    yield from rotating
    weight = next((item for item in rotating if item.key == "rotating_torque"), absent("rotating_torque"))
    yield forces.crank_torque(rod.tangential, r, weight)
    yield forces.overturning_moment(rod.side, trace["pin_distance"], P, e)


def _in_joints(solved: PreparedCylinder, moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield the forces in the joints by the names that they have in a linkage, x towards the crankpin at 90 degrees.

    Those of the crankpin or the knuckle pin on the rod, and of the rod and of the guide on the piston.
    """
    trace, angle = moving.trace, moving.angle
    pin, piston = joint_names(solved)
    pressed, *transverse = on_piston_pin(solved, trace)
    side = -trace["side_force"]
    for weight in transverse:
        side = side - weight
    if solved.articulated_rod is None:
        yield from force_on_rod(pin, *_on_crankpin(solved, moving), angle).values()
    else:
        yield from pin_columns(pin, -trace["knuckle_force_y"], -trace["knuckle_force_x"]).values()
    yield from pin_columns(piston, side, pressed).values()
    yield (-trace["side_force"]).named(f"normal_force.{piston}")


def force_on_rod(name: str, radial: TracedValue, tangential: TracedValue, angle: Value) -> dict[str, TracedValue]:
    """Return the force of a crankpin on its rods by key, from the load of the crankpin at a crank angle."""
    x, y = radial * angle.sin - tangential * angle.cos, radial * angle.cos + tangential * angle.sin
    return pin_columns(name, x, y, joint_force(tangential, radial))


def on_piston_pin(solved: PreparedCylinder, trace: Mapping[str, TracedValue]) -> list[TracedValue]:
    """Return the force of the piston on its pin along the axis, and the weight of the piston across it if it leans."""
    mass, along, across = absent("piston_mass"), absent("weight_force.piston"), list[TracedValue]()
    if solved.machine.masses is not None:
        mass = trace["piston_mass"]
        if solved.machine.has_gravity:
            g = traced_inputs.gravity(solved.machine, solved.method)
            cos, sin = traced_inputs.inclination(solved.machine, solved.lean)
            along = forces.weight_force(mass, g, cos).named("weight_force.piston")
            transverse = forces.transverse_weight(mass, g, sin).named("transverse_weight.piston")
            across = [transverse] if transverse.value else []
    # that of the inertia force, where a document has its own
    acceleration = trace.get("inertia_acceleration", trace["piston_acceleration"])
    return [piston_pin_force(trace.get("gas_force", absent("gas_force")), mass, acceleration, along), *across]


def inertia_at_big_end(solved: PreparedCylinder, trace: Mapping[str, TracedValue]) -> TracedValue:
    """Return the inertia force of the mass of the rod at the crankpin, absent if its masses are unknown."""
    if solved.machine.masses is None:
        return absent("big_end_inertia_force")
    force: TracedValue = big_end_inertia_force(trace["rod_big_end_mass"], trace["crank_radius"], trace["speed"])
    return force


def _on_crankpin(solved: PreparedCylinder, moving: CylinderKinematics) -> tuple[TracedValue, TracedValue]:
    """Return radial and tangential force of a rod on the crankpin, with the mass and the weight of its big end."""
    trace = moving.trace
    radial, tangential = trace["radial_force"], trace["tangential_force"]
    if solved.machine.masses is not None:
        weight = trace.get("big_end_weight", absent("big_end_weight"))
        radial = crankpin_radial_force(radial, inertia_at_big_end(solved, trace), weight)
        if "big_end_tangential_force" in trace:
            tangential = crankpin_tangential_force(tangential, trace["big_end_tangential_force"])
    return radial, tangential


def joint_names(solved: PreparedCylinder) -> tuple[str, str]:
    """Return the names of the pin that the rod of a cylinder turns on, and of its piston pin."""
    rod = only_rod(solved.machine.mechanism)
    pin, piston = ("crank_pin", "piston_pin") if rod is None else (rod.joint, rod.slider)
    return (pin if solved.articulated_rod is None else "knuckle_pin"), piston


def _couple(solved: PreparedCylinder, moving: CylinderKinematics, length: Value) -> Iterator[TracedValue]:
    """Yield the couple that makes two masses a rigid rod, if it has one, and the forces that hold it."""
    masses = solved.machine.masses
    if masses is not None and masses.rod_inertia_excess and solved.method.rod == "rigid":
        excess, turning = (moving.trace[key] for key in ("rod_inertia_excess", "rod_angular_acceleration"))
        couple = forces.correction_couple(excess, turning)
        yield from (couple, forces.rod_transverse_force(couple, length))
        yield forces.side_force_of_couple(couple, length, moving.motion.swing.cos).named("side_force.couple")


def _rotating(solved: PreparedCylinder, moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield the inertia force of the rotating mass, and its torque where it has one."""
    machine, trace, angle = solved.machine, moving.trace, moving.angle
    if machine.masses is None:
        return
    mass, r = trace["rotating_mass"], moving.lengths.crank_radius
    yield forces.rotating_inertia_force(mass, r, moving.speed)
    if machine.has_gravity or machine.angular_acceleration:
        g = traced_inputs.gravity(machine, solved.method)
        cos, sin = traced_inputs.inclination(machine, solved.lean)
        eps, big = moving.angular_acceleration, trace["rod_big_end_mass"]
        yield forces.rotating_torque(mass, r, g, angle.sin, cos, angle.cos, sin, eps)
        yield big_end_weight(big, g, angle.cos, cos, angle.sin, sin)
        yield big_end_tangential_force(big, g, angle.sin, cos, angle.cos, sin, r, eps)


def _articulated_forces(solved: PreparedCylinder, moving: CylinderKinematics) -> Iterator[TracedValue]:
    """Yield the forces of a cylinder whose rod hangs on the master rod; those on the crankpin come through that."""
    if solved.articulated_rod is None or moving.articulated_rod is None:
        return
    trace, rod = moving.trace, moving.articulated_rod
    couple = list(_couple(solved, moving, rod.own.length))
    yield from couple
    mass, accelerations = absent("knuckle_mass"), [absent(f"knuckle_acceleration_{item}") for item in "xy"]
    if "knuckle_mass" in trace:
        w, eps, (x, y) = moving.speed, moving.angular_acceleration, rod.knuckle
        mass = trace["knuckle_mass"]
        accelerations = [
            knuckle_acceleration_along(x.position_2, w, x.position_1, eps),
            knuckle_acceleration_across(y.position_2, w, y.position_1, eps),
        ]
        yield from accelerations
    g = traced_inputs.gravity(solved.machine, solved.method)
    lean_cos, lean_sin = traced_inputs.inclination(solved.machine, solved.lean)
    dN, across = couple[-1] if couple else absent("side_force.couple"), trace.get("transverse_weight", absent(""))
    held = KnuckleMass(mass, accelerations[0], accelerations[1], g, lean_cos, lean_sin, dN, across)
    result = articulated_forces(trace["piston_force"], moving.lengths, solved.articulated_rod, moving.angle, rod, held)
    yield from (result.side.named("side_force"), result.along.named("rod_force"), *result.knuckle)
    yield from (result.radial.named("radial_force"), result.tangential.named("tangential_force"))
    yield from (result.couple.named("knuckle_couple"), result.master_side.named("knuckle_side_force"))
    torque = forces.crank_torque(result.tangential.named("tangential_force"), moving.lengths.crank_radius, absent(""))
    yield from (torque, (-torque).named("overturning_moment"))


FACTORS = ("side_factor", "rod_factor", "radial_factor", "tangential_factor")


def force_functions(results: Results) -> dict[str, Array]:
    """Return tan beta, 1 / cos beta, cos(phi + beta) / cos beta and sin(phi + beta) / cos beta. [-]

    `side_factor`, `rod_factor`, `radial_factor`, `tangential_factor` at the crank angles of the columns. Source:
    kolchin_demidov_2008, ch. 7.
    """
    solved = results.solved
    if not isinstance(solved, TracedCylinder):
        raise MethodError("functions of the rod angle exist for an engine only; give the results of one")
    return columns(solved, results.grid, FACTORS)
