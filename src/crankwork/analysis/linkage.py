"""From a linkage to its results over one revolution: motion, reduced inertia, torques, joint forces, speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from crankwork.analysis.linkage_speed import flywheel_residual, speed_columns, speed_summary, transient_summary
from crankwork.analysis.results import Results
from crankwork.analysis.solved import Notice
from crankwork.analysis.tabulated import analyse_tabulated
from crankwork.dynamics.efficiency import driving_torque
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.reduction import crank_torque, reduced_inertia
from crankwork.dynamics.running import Running
from crankwork.dynamics.zhukovsky import virtual_work_torque, zhukovsky_torque
from crankwork.errors import CrankworkError, GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.quality import limits, time_ratio, transmission_extremes
from crankwork.linkage_machine import LinkageMachine, TabulatedMachine
from crankwork.loads.load import applied_loads
from crankwork.mechanism.dyads import RRP, RRR
from crankwork.method import Method

_DENSE_STEP = 1.0
_ROUNDING = 1e-12
DYNAMICS = (
    "reduced_inertia", "reduced_inertia_1", "static_torque", "dynamic_torque", "balancing_torque", "driving_torque",
)  # fmt: skip


@dataclass(frozen=True)
class SolvedLinkage:
    """A linkage made ready: angular speed with the method's own pi. [rad/s]"""

    machine: LinkageMachine
    method: Method
    speed: float


def solve_linkage(machine: LinkageMachine) -> SolvedLinkage:
    """Return a linkage made ready.

    Parameters
    ----------
    machine : LinkageMachine
        What to compute.
    """
    return SolvedLinkage(machine, machine.method, machine.speed * machine.method.pi / math.pi)


def reachable(machine: LinkageMachine, grid: CrankGrid) -> tuple[CrankGrid, tuple[Notice, ...]]:
    """Return the crank angles that the linkage can reach, and a notice if those are not all.

    Parameters
    ----------
    machine : LinkageMachine
        What to compute.
    grid : CrankGrid, shape (n,)
        Ascending crank angles. [rad]

    Raises
    ------
    GeometryError
        If it can be assembled nowhere.
    """
    try:
        linkage_motion(machine.mechanism, grid)
    except GeometryError as error:
        status = linkage_motion(machine.mechanism, grid, partial=True).status
        reached = np.flatnonzero(status == 0) if status is not None else np.empty(0, dtype=int)
        if reached.size < 2:
            raise
        kept = grid[slice(int(reached[0]), int(reached[-1]) + 1)]
        return kept, (
            Notice("partial", {"message": str(error), "from": float(kept.degrees[0]), "to": float(kept.degrees[-1])}),
        )
    return grid, ()


def linkage_columns(solved: SolvedLinkage, grid: CrankGrid) -> dict[str, Array]:
    """Return all columns of a linkage at ascending crank angles that it can reach.

    Parameters
    ----------
    solved : SolvedLinkage
        The linkage.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    dict of str to array, shape (n,)
        Columns by key; those of points, links, sliders and joints are `key.NAME`. [SI]

    References
    ----------
    artobolevsky_1988, ch. 13-16.
    """
    machine = solved.machine
    motion = linkage_motion(machine.mechanism, grid)
    columns = {"crank_angle": grid.angle, **dict(_motion_columns(machine, motion, solved.speed))}
    if machine.mechanism.bodies or machine.loads or machine.drive.inertia:
        running = running_at(solved, motion)
        torque = crank_torque(running)
        inertia = reduced_inertia(machine.mechanism, motion)
        dynamic = torque.dynamic + machine.drive.inertia * machine.angular_acceleration
        columns |= {
            "reduced_inertia": inertia.inertia + machine.drive.inertia,
            "reduced_inertia_1": inertia.inertia_1,
            "static_torque": torque.static,
            "dynamic_torque": dynamic,
            "balancing_torque": torque.static + dynamic,
            "driving_torque": driving_torque(torque.static, dynamic, machine.drive.efficiency),
            **dict(_force_columns(machine, joint_forces(running))),
        }
    return columns


def running_at(solved: SolvedLinkage, motion: Motion) -> Running:
    """Return the linkage at work, with its loads.

    Parameters
    ----------
    solved : SolvedLinkage
        The linkage.
    motion : Motion
        Its motion.
    """
    machine = solved.machine
    loads = applied_loads(machine.mechanism, motion, machine.loads)
    return Running(machine.mechanism, motion, solved.speed, loads, machine.angular_acceleration)


def _motion_columns(machine: LinkageMachine, motion: Motion, w: float) -> Iterator[tuple[str, Array]]:
    """Yield positions, velocities and accelerations of everything that moves."""
    eps = machine.angular_acceleration
    for name, (x, y) in motion.points.items():
        if name in machine.mechanism.ground:
            continue
        yield f"point_x.{name}", x.position
        yield f"point_y.{name}", y.position
        yield f"point_velocity.{name}", np.hypot(x.position_1, y.position_1) * w
        yield f"point_acceleration.{name}", np.hypot(*(one.position_2 * w**2 + one.position_1 * eps for one in (x, y)))
    for kind, coordinates in (("link", motion.links), ("slider", motion.sliders)):
        first = "link_angle" if kind == "link" else "slider_displacement"
        second = "link_angular_velocity" if kind == "link" else "slider_velocity"
        third = "link_angular_acceleration" if kind == "link" else "slider_acceleration"
        for name, one in coordinates.items():
            if name == machine.mechanism.crank.link:
                continue
            yield f"{first}.{name}", one.position
            yield f"{second}.{name}", one.position_1 * w
            yield f"{third}.{name}", one.position_2 * w**2 + one.position_1 * eps


def _force_columns(machine: LinkageMachine, found: JointForces) -> Iterator[tuple[str, Array]]:
    """Yield the forces in joints and guides; the joint of crank and ground has the name of its fixed point."""
    crank = machine.mechanism.crank
    pivot = next((name for name, place in machine.mechanism.ground.items() if place == crank.pivot), "")
    for joint, pin in found.pins.items():
        name = pivot if pivot and joint == f"{crank.link}_pivot" else joint
        yield f"joint_force_x.{name}", pin.x
        yield f"joint_force_y.{name}", pin.y
        yield f"joint_force.{name}", pin.resultant
    for name, guide in found.guides.items():
        yield f"normal_force.{name}", guide.normal
        yield f"normal_moment.{name}", guide.moment


def analyse_linkage(machine: LinkageMachine, grid: CrankGrid | None = None) -> Results:
    """Return everything a linkage does over one revolution.

    Parameters
    ----------
    machine : LinkageMachine
        What to compute.
    grid : CrankGrid, shape (n,), optional
        Ascending crank angles within one revolution; the machine's own table otherwise. [rad]

    Returns
    -------
    Results
        Columns, summary, checks and notices; only the angles that the linkage reaches.

    Raises
    ------
    CrankworkError
        If the linkage can be assembled nowhere.
    """
    solved = solve_linkage(machine)
    own_table = grid is None
    if grid is None:
        grid = CrankGrid.steps(machine.table_step, 360.0, special=machine.table_special)
    dense, notices = reachable(machine, CrankGrid.steps(_DENSE_STEP, 360.0))
    low, high = dense.degrees[0], dense.degrees[-1]
    inside = np.flatnonzero((grid.degrees >= low) & (grid.degrees <= high))
    if inside.size == 0 and own_table:
        grid, inside = dense, np.arange(len(dense))
    if inside.size == 0:
        raise CrankworkError(f"no angle of the table can be reached; the linkage moves from {low:g} to {high:g} deg")
    grid = grid[slice(int(inside[0]), int(inside[-1]) + 1)]
    known = linkage_columns(solved, dense)
    summary = _summary(solved, dense, known)
    columns = linkage_columns(solved, grid)
    checks = _checks(solved, dense)
    whole = not notices
    if whole and "reduced_inertia" in known:
        columns |= speed_columns(machine, solved.speed, known, grid.angle) if machine.drive.fluctuation else {}
        checks |= flywheel_residual(machine, solved.speed, known)
        found, told = speed_summary(machine, solved.speed, known)
        summary |= found
        notices += told
    summary |= transient_summary(machine)
    return Results(solved, grid, columns, summary, checks, notices, _groups(columns))


def analyse_any_linkage(machine: LinkageMachine | TabulatedMachine, grid: CrankGrid | None = None) -> Results:
    """Return the results of a linkage, or of a table of transfer functions at its own positions.

    Parameters
    ----------
    machine : LinkageMachine or TabulatedMachine
        What to compute.
    grid : CrankGrid, shape (n,), optional
        Crank angles of a linkage. [rad]
    """
    return analyse_linkage(machine, grid) if isinstance(machine, LinkageMachine) else analyse_tabulated(machine)


def _summary(solved: SolvedLinkage, dense: CrankGrid, known: Mapping[str, Array]) -> dict[str, float]:
    machine = solved.machine
    result = {"rotational_speed": machine.speed, "speed": solved.speed}
    if machine.angular_acceleration:
        result["angular_acceleration"] = machine.angular_acceleration
    if machine.drive.efficiency != 1:
        result["efficiency"] = machine.drive.efficiency
    if len(dense) == len(CrankGrid.steps(_DENSE_STEP, 360.0)):
        result |= _quality(machine)
    for key, values in known.items():
        kind, _, name = key.partition(".")
        if kind == "slider_displacement":
            result[f"slider_stroke.{name}"] = float(np.ptp(values))
        elif kind == "link_angle" and np.ptp(values) < math.pi:
            result[f"link_swing.{name}"] = float(np.ptp(values))
        elif (kind in ("joint_force", "slider_velocity") or key in DYNAMICS) and np.any(values):
            result |= _extremes(key, dense, values, both=key in DYNAMICS)
    if machine.loads and len(dense) == len(CrankGrid.steps(_DENSE_STEP, 360.0)):
        mean = float(np.mean(known["static_torque"][:-1]))
        result["mean_torque"] = mean if abs(mean) > _ROUNDING * np.max(np.abs(known["static_torque"])) else 0.0
    return result


def _quality(machine: LinkageMachine) -> dict[str, float]:
    """Return time ratios and the least transmission angles of a linkage that turns fully."""
    mechanism, result = machine.mechanism, {}
    for index, dyad in enumerate(mechanism.dyads):
        if isinstance(dyad, RRR | RRP):
            name = dyad.point if isinstance(dyad, RRR) else dyad.slider
            result[f"transmission_angle_min.{name}"] = math.radians(transmission_extremes(mechanism, index).least)
        for output in (dyad.piece,) if isinstance(dyad, RRP) else ():
            if limits(mechanism, output).degrees.size == 2:
                result[f"time_ratio.{output}"] = time_ratio(mechanism, output)
    return result


def _extremes(key: str, grid: CrankGrid, values: Array, *, both: bool) -> dict[str, float]:
    """Return extreme values and their crank angles; of a named key, `joint_force_max.A`."""
    kind, dot, name = key.partition(".")
    found = {"max": int(np.argmax(values))} | ({"min": int(np.argmin(values))} if both else {})
    result = {}
    for word, at in found.items():
        result[f"{kind}_{word}{dot}{name}"] = float(values[at])
        result[f"{kind}_{word}_angle{dot}{name}"] = float(grid.angle[at])
    return result


def _checks(solved: SolvedLinkage, grid: CrankGrid) -> dict[str, float]:
    """Return how far four independent routes to the balancing torque differ, relative to its largest value."""
    if not (solved.machine.mechanism.bodies or solved.machine.loads):
        return {}
    running = running_at(solved, linkage_motion(solved.machine.mechanism, grid))
    reference = joint_forces(running).balancing_torque
    torque = crank_torque(running)
    routes = {
        "whole_system": system_joint_forces(running).balancing_torque,
        "zhukovsky": zhukovsky_torque(running),
        "virtual_work": virtual_work_torque(running),
        "energy": torque.static + torque.dynamic,
    }
    scale = float(np.max(np.abs(reference))) or 1.0
    return {name: float(np.max(np.abs(one - reference))) / scale for name, one in routes.items()}


def _groups(columns: Mapping[str, Array]) -> dict[str, tuple[str, ...]]:
    """Return the keys of each table."""
    kinds = {
        "points": ("point_x", "point_y", "point_velocity", "point_acceleration"),
        "links": ("link_angle", "link_angular_velocity", "link_angular_acceleration",
                  "slider_displacement", "slider_velocity", "slider_acceleration"),
        "speed": ("crank_speed", "kinetic_energy_change"),
        "joint_forces": ("joint_force_x", "joint_force_y", "joint_force", "normal_force", "normal_moment"),
    }  # fmt: skip
    groups = {name: tuple(key for key in columns if key.partition(".")[0] in keys) for name, keys in kinds.items()}
    return {"dynamics": DYNAMICS, **groups}
