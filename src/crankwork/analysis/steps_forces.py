"""Worked steps of the forces of an engine at one crank angle, from the gas to the crankshaft."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis.solved import WorkingSpace
from crankwork.analysis.steps_motion import EngineMoment, Function, acceleration_step, piston_steps, swing_steps
from crankwork.dynamics import force_parts
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics import rod_functions
from crankwork.loads import gas as gas_formulas
from crankwork.loads.gauge import gauge_pressure
from crankwork.steps import AnyStep, Given, Step, named_step, renamed, sum_step, worked_step

# Arguments of formulas that are columns of the results.
_ARGUMENTS = {
    "a": "piston_acceleration",
    "eps_r": "rod_angular_acceleration",
    "x": "piston_displacement",
    "p": "gas_pressure",
    "F_g": "gas_force",
    "F_j": "inertia_force",
    "F_w": "weight_force",
    "F_wn": "transverse_weight",
    "P": "piston_force",
    "N": "side_force",
    "T": "tangential_force",
}


def force_steps(moment: EngineMoment) -> Iterator[AnyStep]:
    """Yield the forces from the gas to the crankshaft.

    Parameters
    ----------
    moment : EngineMoment
        The engine at a crank angle; nothing without masses and gas.
    """
    if "piston_force" not in moment.known:
        return
    known = force_arguments(moment)
    yield from swing_steps(known)
    if moment.solved.space is not None:
        yield from _gas_steps(moment, moment.solved.space, known)
    yield from _inertia_steps(moment, known)
    yield from _piston_force_steps(moment, known)
    for function in (
        rod_functions.side_factor,
        rod_functions.rod_factor,
        rod_functions.radial_factor,
        rod_functions.tangential_factor,
    ):
        yield named_step(function, known)
    yield from _rod_steps(moment, known)
    yield from _crank_steps(moment, known)


def force_arguments(moment: EngineMoment) -> dict[str, float]:
    """Return what the formulas of forces take, by name of the argument. [SI]

    Parameters
    ----------
    moment : EngineMoment
        The engine at a crank angle.
    """
    machine, method = moment.solved.machine, moment.solved.method
    inclination = machine.cylinder.inclination if machine.cylinder else 0.0
    known = {
        **moment.functions,
        **{name: moment.known[key] for name, key in _ARGUMENTS.items() if key in moment.known},
        "g": method.gravity,
        "cos_theta": math.cos(inclination),
        "sin_theta": math.sin(inclination),
        "pi": method.pi,
    }
    known.setdefault("F_g", 0.0)
    if machine.masses is not None:
        masses = machine.masses
        known |= {"m_rec": masses.reciprocating, "m_rot": masses.rotating, "dJ": masses.rod_inertia_excess}
    return known


def _gas_steps(moment: EngineMoment, space: WorkingSpace, known: Mapping[str, float]) -> Iterator[AnyStep]:
    """Yield volume, pressure and gas force; a pressure that no polytrope gives is read from the diagram."""
    volume = named_step(gas_formulas.cylinder_volume, known, V_c=space.clearance, A=space.area)
    yield volume
    degrees, key = float(moment.grid.degrees[0]), "diagram_pressure" if space.ambient else "gas_pressure"
    segment = next((one for one in space.diagram.segments if degrees <= one.end), space.diagram.segments[-1])
    if segment.law == "polytropic":
        p_1, v_1, exponent = segment.state
        read: AnyStep = worked_step(gas_formulas.polytropic_pressure, p_1, v_1, volume.value, exponent, key=key)
    else:
        read = Given(key, float(space.diagram.pressure(moment.grid.degrees, np.array([volume.value]))[0]))
    yield read
    if space.ambient:
        yield worked_step(gauge_pressure, read.value, space.ambient)
    if not space.rod_area:
        yield named_step(gas_formulas.gas_force, known, A=space.area)
        return
    cylinder = moment.solved.machine.cylinder
    if cylinder is not None:
        diameter = cylinder.piston_rod_diameter
        yield named_step(gas_formulas.piston_area, known, D=diameter, key="piston_area.rod")
    yield named_step(
        gas_formulas.gas_force_double_acting, known, A=space.area, p_b=space.back_pressure, A_r=space.rod_area
    )


def _inertia_steps(moment: EngineMoment, known: Mapping[str, float]) -> Iterator[AnyStep]:
    """Yield inertia force and weight; the force with its own rod ratio where a document has one."""
    machine, method = moment.solved.machine, moment.solved.method
    if machine.masses is None:
        return
    ratio = method.inertia_rod_ratio
    acceleration = known["a"]
    if ratio is None or ratio == moment.solved.lengths.rod_ratio or method.is_exact:
        yield acceleration_step(known)
    else:
        other = moment.with_rod_ratio(ratio)
        steps = list(piston_steps(other))
        yield from (_of_own_ratio(one) for one in steps if one.key != "piston_displacement")
        step = _of_own_ratio(acceleration_step(other.functions, "inertia_acceleration"))
        yield step
        acceleration = step.value
    force = named_step(forces.inertia_force, known, a=acceleration)
    yield force if acceleration == known["a"] else renamed(force, a="inertia_acceleration")
    if machine.has_gravity:
        yield named_step(forces.weight_force, known)
        if "F_wn" in known:
            yield named_step(forces.transverse_weight, known)


def _of_own_ratio(step: AnyStep) -> AnyStep:
    """Return a step of the motion under names that tell its rod ratio from that of everything else."""
    own = {"lam": "rod_ratio.inertia", "l": "rod_length.inertia"}
    own |= {"x_1": "piston_transfer_1.inertia", "x_2": "piston_transfer_2.inertia"}
    key = step.key if step.key == "inertia_acceleration" else f"{step.key}.inertia"
    if not isinstance(step, Step):
        return step._replace(key=key)
    return renamed(step, **{name: own[name] for name in step.formula.arguments if name in own})._replace(key=key)


def _piston_force_steps(moment: EngineMoment, known: Mapping[str, float]) -> Iterator[AnyStep]:
    if moment.solved.machine.masses is None:
        yield sum_step("piston_force", [Given("gas_force", known["F_g"])])
    elif moment.solved.machine.has_gravity:
        yield named_step(forces.piston_force_with_weight, known)
    else:
        yield named_step(forces.piston_force, known)


_OF_ROD: tuple[tuple[Function, Function], ...] = (
    (forces.rod_force, force_parts.rod_force_of_couple),
    (forces.radial_force, force_parts.radial_force_of_couple),
    (forces.tangential_force, force_parts.tangential_force_of_couple),
)


def _rod_steps(moment: EngineMoment, known: Mapping[str, float]) -> Iterator[AnyStep]:
    """Yield what the rod passes on: alone, or with the correction couple that makes it a rigid rod."""
    couple = list(_couple_steps(moment, known))
    yield from couple
    added = couple[-1] if couple else None
    side: AnyStep = named_step(forces.side_force, known)
    if added is not None:
        shown = Given(added.key, added.value)
        side = sum_step("side_force", (side._replace(key="side_force.rod"), shown))
    if "F_wn" in known:
        yield side._replace(key="side_force.whole_rod")
        side = named_step(forces.side_force_less_weight, known, N=side.value)
    yield side
    for of_force, of_couple in _OF_ROD:
        step = named_step(of_force, known)
        if added is None:
            yield step
        else:
            part = named_step(of_couple, known, dN=added.value, key=f"{step.key}.couple")
            yield sum_step(step.key, (step._replace(key=f"{step.key}.rod"), part))


def _couple_steps(moment: EngineMoment, known: Mapping[str, float]) -> Iterator[Step]:
    """Yield the correction couple and the side force that holds it, where the rod is not two masses."""
    masses = moment.solved.machine.masses
    if masses is None or not masses.rod_inertia_excess or moment.solved.method.rod != "rigid":
        return
    couple = named_step(forces.correction_couple, known)
    yield couple
    yield named_step(forces.rod_transverse_force, known, M_c=couple.value)
    yield named_step(forces.side_force_of_couple, known, M_c=couple.value, key="side_force.couple")


def _crank_steps(moment: EngineMoment, known: Mapping[str, float]) -> Iterator[AnyStep]:
    machine = moment.solved.machine
    torque: AnyStep = named_step(forces.crank_torque, known)
    if machine.masses is not None:
        yield named_step(forces.rotating_inertia_force, known)
        if machine.has_gravity or machine.angular_acceleration:
            gravity = known["g"] if machine.has_gravity else 0.0
            of_mass = named_step(forces.rotating_torque, known, g=gravity)
            yield of_mass
            torque = sum_step(
                "crank_torque",
                (torque._replace(key="crank_torque.rod"), Given("rotating_torque", of_mass.value)),
            )
    yield torque
    distance = named_step(rod_functions.pin_distance, known)
    yield distance
    moment_of = forces.overturning_moment if known["e"] else force_parts.overturning_moment_central
    yield named_step(moment_of, known, h=distance.value)
