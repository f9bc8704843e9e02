"""Everything that varies with the crank angle, as columns by key."""

from __future__ import annotations

import importlib
import math
from collections.abc import Mapping

import numpy as np

from crankwork.analysis.solved import Solved, WorkingSpace
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics import textbook
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.piston import PistonMotion, piston_motion
from crankwork.kinematics.series import acceleration_harmonics
from crankwork.loads import gas as gas_formulas

KINEMATICS = (
    "piston_displacement", "piston_velocity", "piston_acceleration",
    "rod_angle", "rod_angular_velocity", "rod_angular_acceleration",
)  # fmt: skip
HARMONICS = tuple(
    f"piston_{noun}_{order}_order"
    for noun in ("displacement", "velocity", "acceleration")
    for order in ("first", "second")
)
FORCES = (
    "gas_pressure", "gas_force", "inertia_acceleration", "inertia_force", "weight_force", "transverse_weight",
    "piston_force", "side_force", "rod_force",
    "rod_transverse_force", "radial_force", "tangential_force", "rotating_inertia_force", "rotating_torque",
    "crank_torque", "overturning_moment",
)  # fmt: skip


def columns(solved: Solved, grid: CrankGrid) -> dict[str, Array]:
    """Return all columns at ascending crank angles within one cycle.

    Parameters
    ----------
    solved : Solved
        Machine and method.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    dict of str to array, shape (n,)
        Columns by key. [SI]

    References
    ----------
    kolchin_demidov_2008, ch. 6 and 7.
    """
    machine, w, eps = solved.machine, solved.speed, solved.machine.angular_acceleration
    motion = solved.motion(grid)
    result = {
        "crank_angle": grid.angle,
        "piston_displacement": motion.piston.position,
        "piston_velocity": forces.piston_velocity(motion.piston.position_1, w),
        "piston_acceleration": _acceleration(motion, w, eps),
        "rod_angle": motion.rod.position,
        "rod_angular_velocity": motion.rod.position_1 * w,
        "rod_angular_acceleration": motion.rod.position_2 * w**2 + motion.rod.position_1 * eps,
    }
    if solved.space is not None:
        space = solved.space
        volume = gas_formulas.cylinder_volume(space.clearance, space.area, motion.piston.position)
        result["cylinder_volume"] = volume
        result["gas_pressure"] = space.diagram.pressure(grid.degrees, volume) - space.ambient
    if machine.masses is not None or solved.space is not None:
        result |= _forces(solved, grid, motion, result)
    return result


def _acceleration(motion: PistonMotion, w: float, eps: float) -> Array:
    if eps:
        return np.asarray(
            forces.piston_acceleration_unsteady(motion.piston.position_2, w, motion.piston.position_1, eps)
        )
    return np.asarray(forces.piston_acceleration(motion.piston.position_2, w))


def _forces(solved: Solved, grid: CrankGrid, motion: PistonMotion, known: Mapping[str, Array]) -> dict[str, Array]:
    """Return the force columns from pressure and acceleration."""
    machine, lengths, swing = solved.machine, solved.lengths, motion.swing
    r, l, e = lengths  # noqa: E741
    result = _axial_forces(solved, grid, known)
    P = result["piston_force"]
    if solved.slave is not None:
        return result | _slave_forces(solved, grid, P)
    rod = forces.rod_forces(P, swing)
    masses = machine.masses
    if masses is not None and masses.rod_inertia_excess and solved.method.rod == "rigid":
        couple = forces.correction_couple(masses.rod_inertia_excess, known["rod_angular_acceleration"])
        rod = forces.add_couple(rod, couple, l, grid, swing)
        result["rod_transverse_force"] = np.asarray(forces.rod_transverse_force(couple, l))
    side = rod.side
    if "transverse_weight" in result:
        side = np.asarray(forces.side_force_less_weight(side, result["transverse_weight"]))
    result |= {
        "side_force": side,
        "rod_force": rod.along,
        "radial_force": rod.radial,
        "tangential_force": rod.tangential,
        "crank_torque": forces.crank_torque(rod.tangential, r),
        "overturning_moment": forces.overturning_moment(side, r * grid.cos + l * swing.cos, P, e),
    }
    if masses is not None:
        result["rotating_inertia_force"] = _centrifugal(solved, grid)
        if machine.has_gravity or machine.angular_acceleration:
            result["rotating_torque"] = _rotating_torque(solved, masses.rotating, grid)
            result["crank_torque"] = result["crank_torque"] + result["rotating_torque"]
    return result


def _centrifugal(solved: Solved, grid: CrankGrid) -> Array:
    masses = solved.machine.masses
    rotating = masses.rotating if masses else 0.0
    force = forces.rotating_inertia_force(rotating, solved.lengths.crank_radius, solved.speed)
    return np.full_like(grid.angle, force)


def _slave_forces(solved: Solved, grid: CrankGrid, P: Array) -> dict[str, Array]:
    """Return the forces of a cylinder whose rod hangs on the master rod; those on the crankpin come through that."""
    room = importlib.import_module("crankwork.cylinders.articulated_forces")
    moving = importlib.import_module("crankwork.cylinders.articulated").articulated_motion(
        solved.lengths, solved.slave, grid
    )
    found = room.slave_forces(P, solved.lengths, solved.slave, grid, moving)
    torque = np.asarray(forces.crank_torque(found.tangential, solved.lengths.crank_radius))
    result = {
        "side_force": found.side,
        "rod_force": found.along,
        "radial_force": found.radial,
        "tangential_force": found.tangential,
        "knuckle_side_force": found.master_side,
        "knuckle_couple": found.couple,
        "crank_torque": torque,
        "overturning_moment": -torque,
    }
    return result | ({"rotating_inertia_force": _centrifugal(solved, grid)} if solved.machine.masses else {})


def _axial_forces(solved: Solved, grid: CrankGrid, known: Mapping[str, Array]) -> dict[str, Array]:
    """Return gas, inertia, weight and their sum along the cylinder axis."""
    machine, masses = solved.machine, solved.machine.masses
    result = {"gas_force": _gas_force(solved.space, known["gas_pressure"])} if solved.space is not None else {}
    if masses is None:
        return result | {"piston_force": result["gas_force"]}
    acceleration = _inertia_acceleration(solved, grid, known)
    if acceleration is not known["piston_acceleration"]:
        result["inertia_acceleration"] = acceleration
    result["inertia_force"] = forces.inertia_force(masses.reciprocating, acceleration)
    gas = result.get("gas_force", 0.0)
    if not machine.has_gravity:
        result["piston_force"] = forces.piston_force(gas, result["inertia_force"])
        return result
    inclination = machine.cylinder.inclination if machine.cylinder else 0.0
    weight = forces.weight_force(masses.reciprocating, solved.method.gravity, math.cos(inclination))
    result["weight_force"] = np.full_like(grid.angle, weight)
    across = forces.transverse_weight(masses.reciprocating, solved.method.gravity, math.sin(inclination))
    if across:
        result["transverse_weight"] = np.full_like(grid.angle, across)
    result["piston_force"] = forces.piston_force_with_weight(gas, result["inertia_force"], result["weight_force"])
    return result


def _gas_force(space: WorkingSpace, pressure: Array) -> Array:
    if not space.rod_area:
        return np.asarray(gas_formulas.gas_force(pressure, space.area))
    return np.asarray(gas_formulas.gas_force_double_acting(pressure, space.area, space.back_pressure, space.rod_area))


def _inertia_acceleration(solved: Solved, grid: CrankGrid, known: Mapping[str, Array]) -> Array:
    """Return the acceleration behind the inertia force, with its own rod ratio where a document has one."""
    ratio = solved.method.inertia_rod_ratio
    if ratio is None or ratio == solved.lengths.rod_ratio or solved.method.is_exact:
        return known["piston_acceleration"]
    lengths = solved.lengths._replace(rod_length=solved.lengths.crank_radius / ratio)
    motion = piston_motion(lengths, grid, solved.method)
    return _acceleration(motion, solved.speed, solved.machine.angular_acceleration)


def _rotating_torque(solved: Solved, mass: float, grid: CrankGrid) -> Array:
    machine = solved.machine
    inclination = machine.cylinder.inclination if machine.cylinder else 0.0
    gravity = solved.method.gravity if machine.has_gravity else 0.0
    cos, sin, r = math.cos(inclination), math.sin(inclination), solved.lengths.crank_radius
    return np.asarray(
        forces.rotating_torque(mass, r, gravity, grid.sin, cos, grid.cos, sin, machine.angular_acceleration)
    )


def harmonic_columns(solved: Solved, grid: CrankGrid) -> dict[str, Array]:
    """Return the first- and second-order parts of piston displacement, velocity and acceleration.

    Parameters
    ----------
    solved : Solved
        Machine and method; the textbook has its own two terms, the other methods true harmonics.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    dict of str to array, shape (n,)
        Columns by key of `HARMONICS`; displacement parts are zero at a crank angle of zero. [SI]

    References
    ----------
    kolchin_demidov_2008, ch. 6; taylor_1985, vol. 2, ch. 8.
    """
    r, lam, w = solved.lengths.crank_radius, solved.lengths.rod_ratio, solved.speed
    eps = solved.machine.angular_acceleration
    if solved.method.kinematics == "textbook" and solved.lengths.offset == 0:
        parts = (
            textbook.textbook_displacement_first(r, grid.cos),
            textbook.textbook_displacement_second(r, lam, grid.cos_2),
            textbook.textbook_transfer_1_first(r, grid.sin) * w,
            textbook.textbook_transfer_1_second(r, lam, grid.sin_2) * w,
            textbook.textbook_transfer_2_first(r, grid.cos) * w**2,
            textbook.textbook_transfer_2_second(r, lam, grid.cos_2) * w**2,
        )
        return _with_acceleration(dict(zip(HARMONICS, parts, strict=True)), eps / w)
    (c_1, c_2), (s_1, s_2) = acceleration_harmonics(solved.lengths, 2)
    parts = (
        c_1 * (1 - grid.cos) - s_1 * grid.sin,
        (c_2 * (1 - grid.cos_2) - s_2 * grid.sin_2) / 4,
        (c_1 * grid.sin - s_1 * grid.cos) * w,
        (c_2 * grid.sin_2 - s_2 * grid.cos_2) / 2 * w,
        (c_1 * grid.cos + s_1 * grid.sin) * w**2,
        (c_2 * grid.cos_2 + s_2 * grid.sin_2) * w**2,
    )
    return _with_acceleration(dict(zip(HARMONICS, parts, strict=True)), eps / w)


def _with_acceleration(parts: dict[str, Array], rate: float) -> dict[str, Array]:
    """Add what a changing speed does to the parts of the acceleration: velocity times eps / w. [1/s]"""
    if rate:
        for order in ("first", "second"):
            parts[f"piston_acceleration_{order}_order"] = (
                parts[f"piston_acceleration_{order}_order"] + rate * parts[f"piston_velocity_{order}_order"]
            )
    return parts
