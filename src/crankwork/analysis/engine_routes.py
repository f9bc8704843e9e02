"""A cylinder once more, as any linkage: the forces of the crank gear from one linear system of all its links."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from crankwork.analysis.forces import columns
from crankwork.analysis.solved import SolvedCylinder, apart
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.dynamics.running import Running
from crankwork.kinematics.bodies import body_motions
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.piston import only_rod
from crankwork.loads.applied import AppliedForce, AppliedLoads
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Body, Crank, body_at

# where both ways are compared [deg]
_STEP, _FIRST = 30.0, 7.0


def joint_force_residuals(solved: SolvedCylinder) -> dict[str, float]:
    """Return how far torque and side force are from those of the linkage, as a share of the largest or of joint forces.

    Nothing for a method that only comes near the motion, and for a rod that hangs on another.
    """
    method = solved.method
    as_rigid = method.rod == "rigid" or not (solved.machine.masses and solved.machine.masses.rod_inertia_excess)
    rod = only_rod(solved.machine.mechanism)
    if rod is None or not method.is_exact or solved.slave is not None or not as_rigid:
        return {}
    grid = CrankGrid.from_degrees(np.arange(_FIRST, solved.machine.cycle, _STEP))
    own = columns(solved, grid, ("crank_torque", "side_force", "gas_force"))
    running = _running(solved, rod, grid, own.get("gas_force", np.zeros(len(grid))))
    found = system_joint_forces(running)
    (guide,) = found.guides.values()
    # of a heavy rod without a piston what remains of its forces is their rounding
    pressed = max(float(np.max(pin.resultant)) for pin in found.pins.values())
    return {
        "joint_torque": apart(own["crank_torque"], -found.balancing_torque, solved.lengths.crank_radius * pressed),
        "joint_side_force": apart(own["side_force"], -guide.normal, pressed),
    }


def _running(solved: SolvedCylinder, rod: RRP, grid: CrankGrid, gas_force: Array) -> Running:
    machine = solved.machine
    masses = machine.masses or CrankGearMasses()
    mechanism = replace(machine.mechanism, bodies=tuple(_bodies(machine.mechanism.crank, rod, masses)))
    motion = linkage_motion(mechanism, grid)
    frame = motion.frames[rod.slider]
    loads = [AppliedForce(rod.slider, frame.origin, -gas_force * frame.cos, -gas_force * frame.sin)]
    if machine.has_gravity:
        lean = machine.cylinder.inclination if machine.cylinder is not None else 0.0
        down = solved.method.gravity * math.sin(lean), -solved.method.gravity * math.cos(lean)
        loads += [
            AppliedForce(body.link, centre, *(np.full(len(grid), body.mass * one) for one in down))
            for body, centre, *_ in body_motions(mechanism, motion)
        ]
    return Running(mechanism, motion, solved.speed, AppliedLoads(tuple(loads)), machine.angular_acceleration)


def _bodies(crank: Crank, rod: RRP, masses: CrankGearMasses) -> Iterator[Body]:
    """Yield piston, rod and crank; the two masses of the rod with the inertia of a rigid one about their centre."""
    yield body_at(rod.slider, masses.piston, 0.0, rod.slider)
    yield body_at(crank.link, masses.crank, 0.0, crank.pin)
    whole = masses.rod_small_end + masses.rod_big_end
    if whole or masses.rod_inertia_excess:
        share = masses.rod_small_end / whole if whole else 0.0
        inertia = masses.rod_inertia_excess + whole * share * (1 - share) * rod.length**2
        yield Body(rod.link, whole, inertia, rod.joint, rod.slider, share)
