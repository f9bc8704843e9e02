"""A cylinder once more, as any linkage: the forces of the crank gear from one linear system of all its links."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.cylinder_forces import TracedCylinder
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.cylinders.articulated import throw_mechanism
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.dynamics.reaction import JointForces
from crankwork.formula.replay import Program, Samples
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import body_motions, linkage_motion
from crankwork.kinematics.piston import only_rod
from crankwork.loads.applied_loads import AppliedForce, AppliedLoads
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Body, Mechanism, body_at
from crankwork.preparation.prepared import relative_difference

# where both ways are compared [deg]
_STEP, _FIRST = 30.0, 7.0


def joint_force_residuals(solved: TracedCylinder, samples: Samples) -> dict[str, float]:
    """Return how far torque and side force are from those of the linkage, as a share of the largest or of joint forces.

    Nothing for a method that only comes near the motion, and for a rod that hangs on another.
    """
    method = solved.method
    as_rigid = method.rod == "rigid" or not (solved.machine.masses and solved.machine.masses.rod_inertia_excess)
    rod = only_rod(solved.machine.mechanism)
    if rod is None or not method.is_exact or solved.articulated_rod is not None or not as_rigid:
        return {}
    grid = CrankGrid.from_degrees(np.arange(_FIRST, solved.machine.cycle, _STEP))
    own = samples(grid)
    mechanism, masses = solved.machine.mechanism, solved.machine.masses or CrankGearMasses()
    bodies = (body_at(mechanism.crank.link, masses.crank, 0.0, mechanism.crank.pin), *_bodies(rod, masses))
    gas = {rod.slider: own["gas_force"]} if "gas_force" in own else {}
    lean = solved.machine.inclination + math.radians(solved.lean)
    values = system_joint_forces(_running(solved, replace(mechanism, bodies=bodies), gas, grid, lean))
    (guide,) = values.guides.values()
    pressed = _largest(values)
    return {
        "joint_torque": relative_difference(
            own["crank_torque"], -values.balancing_torque, solved.lengths.crank_radius * pressed
        ),
        "joint_side_force": relative_difference(own["side_force"], -guide.normal, pressed),
    }


def throw_residuals(engine: MultiCylinderEngine, trace: Mapping[str, TracedValue]) -> dict[str, float]:
    """Return how far torque and load of a crankpin with articulated rods are from those of the same linkage.

    Empty for other engines, and for a method that approximates the motion.
    """
    solved, masses = engine.master, engine.each_masses
    places = engine.on_pin[engine.layout.places[0].crankpin]
    numbers = [place.number for place in places]
    is_rigid = solved.method.rod == "rigid" or not any(masses[number - 1].rod_inertia_excess for number in numbers)
    if not any(engine.engine.articulated_rods) or not solved.method.is_exact or not is_rigid:
        return {}
    mechanism = throw_mechanism(engine.layout, solved.lengths, engine.engine.articulated_rods)
    rods = [dyad for dyad in mechanism.dyads if isinstance(dyad, RRP)]
    bodies = [body_at(mechanism.crank.link, masses[numbers[0] - 1].crank, 0.0, mechanism.crank.pin)]
    pairs = tuple(zip(rods, numbers, strict=True))
    bodies += [body for rod, number in pairs for body in _bodies(rod, masses[number - 1])]
    grid = CrankGrid.from_degrees(np.arange(_FIRST, engine.layout.cycle, _STEP))
    pin = f"crankpin_load.{places[0].crankpin + 1}"
    torques = {f"torque.{number}": engine.of(number, "crank_torque") for number in numbers}
    gases = {rod.slider: engine.of(number, "gas_force") for rod, number in pairs if engine.has("gas_force")}
    own = Program({**torques, **gases, "load": trace[pin]})(grid)
    # the axis of cylinder 1 has the same direction in the mechanism as in the layout
    lean = solved.machine.inclination - math.radians(engine.layout.places[0].axis)
    pushing = {name: own[name] for name in gases}
    values = system_joint_forces(_running(solved, replace(mechanism, bodies=tuple(bodies)), pushing, grid, lean))
    pressed, torque = _largest(values), np.sum([own[key] for key in torques], axis=0)
    (joint,) = (
        pin for pin in values.pins.values() if pin.joint.link == rods[0].link and pin.joint.point == rods[0].joint
    )
    return {
        "throw_torque": relative_difference(torque, -values.balancing_torque, solved.lengths.crank_radius * pressed),
        "throw_load": relative_difference(own["load"], joint.resultant, pressed),
    }


def _largest(forces: JointForces) -> float:
    """Return the largest force in any joint, since a single joint may carry only rounding. [N]"""
    return max(float(np.max(pin.resultant)) for pin in forces.pins.values())


def _running(
    solved: TracedCylinder, mechanism: Mechanism, gas: Mapping[str, Array], grid: CrankGrid, lean: float
) -> OperatingState:
    """Return rods and pistons at work, the gas pushing the pistons by their names, with weights where they count.

    `lean`: from the upward vertical to what is up in the mechanism, with the rotation [rad].
    """
    machine, motion = solved.machine, linkage_motion(mechanism, grid)
    frames = {name: motion.frames[name] for name in gas}
    loads = [
        AppliedForce(name, value.origin, -gas[name] * value.cos, -gas[name] * value.sin)
        for name, value in frames.items()
    ]
    if machine.has_gravity:
        ones = np.ones(len(grid))
        down = solved.method.gravity * math.sin(lean), -solved.method.gravity * math.cos(lean)
        loads += [
            AppliedForce(body.link, centre, ones * body.mass * down[0], ones * body.mass * down[1])
            for body, centre, *_ in body_motions(mechanism, motion)
        ]
    return OperatingState(mechanism, motion, solved.speed, AppliedLoads(tuple(loads)), machine.angular_acceleration)


def _bodies(rod: RRP, masses: CrankGearMasses) -> Iterator[Body]:
    """Yield piston and rod; the two masses of the rod with the inertia of a rigid one about their centre."""
    yield body_at(rod.slider, masses.piston, 0.0, rod.slider)
    mass = masses.rod_small_end + masses.rod_big_end
    if mass or masses.rod_inertia_excess:
        share = masses.rod_small_end / mass if mass else 0.0
        inertia = masses.rod_inertia_excess + mass * share * (1 - share) * rod.length**2
        yield Body(rod.link, mass, inertia, rod.joint, rod.slider, share)
