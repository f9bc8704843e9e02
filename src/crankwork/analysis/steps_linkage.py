"""Worked steps of a linkage at one row of its columns: structure, motion, reduction to the crank, torques, shaft."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from crankwork.analysis.linkage import SolvedLinkage, running_at
from crankwork.analysis.results import Results
from crankwork.analysis.steps_shaft import flywheel_steps, motor_steps
from crankwork.analysis.steps_table import speed_steps, table_steps
from crankwork.analysis.steps_torque import torque_steps
from crankwork.dynamics import inertia_parts, link_loads, reduction
from crankwork.kinematics import transfer_rates as rates
from crankwork.kinematics.bodies import BodyMotion, body_motions
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.transfer import Transfer
from crankwork.mechanism.freedom import chain_mobility
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.structure import structure
from crankwork.steps import AnyStep, Given, Step, StepGroup, named_step, sum_step, worked_step

# Share of the largest rate that adding up coordinates may leave.
_ROUNDING = 1e-12


def linkage_steps(results: Results, row: int, force_row: int) -> tuple[StepGroup, ...]:
    """Return the worked steps of a linkage, or of a table of transfer functions.

    Parameters
    ----------
    results : Results
        Of either.
    row, force_row : int
        Rows of the columns where the motion, and where inertia and torques are shown.

    Returns
    -------
    tuple of StepGroup
        Groups `structure`, `speed`, `motion`, `inertia_loads`, `reduction`, `torques`, `flywheel`, `motor`; those
        without a step are left out.
    """
    solved = results.solved
    at, there = (float(results.grid.angle[one]) for one in (row, force_row))
    if not isinstance(solved, SolvedLinkage):
        return table_steps(results, force_row)
    motion = linkage_motion(solved.machine.mechanism, results.grid)
    known = {"w": solved.speed, "eps": solved.machine.angular_acceleration}
    groups = [
        StepGroup("structure", tuple(_structure(solved.machine.linkage))),
        *speed_steps(solved.method.pi, solved.machine.speed),
        StepGroup("motion", tuple(_motion(solved, motion, row, known)), at),
    ]
    if "reduced_inertia" in results.columns:
        bodies = body_motions(solved.machine.mechanism, motion)
        groups += [
            StepGroup("inertia_loads", tuple(_inertia_loads(bodies, motion, force_row, known)), there),
            StepGroup("reduction", tuple(_reduction(solved, bodies, motion, force_row)), there),
            StepGroup("torques", tuple(torque_steps(results, force_row)), there),
            StepGroup("flywheel", tuple(flywheel_steps(results))),
            StepGroup("motor", tuple(motor_steps(results))),
        ]
    return tuple(group for group in groups if group.steps)


def _structure(linkage: Linkage) -> Iterator[Step]:
    found, _ = structure(linkage)
    if found is not None:
        yield worked_step(chain_mobility, float(len(found.links)), float(found.joints))


def _motion(solved: SolvedLinkage, motion: Motion, row: int, known: Mapping[str, float]) -> Iterator[Step]:
    """Yield velocities and accelerations of points, links and sliders from their transfer functions."""
    mechanism, steady = solved.machine.mechanism, not known["eps"]
    for name, (x, y) in motion.points.items():
        if name in mechanism.ground:
            continue
        first, second = _rates(x, row), _rates(y, row)
        values = {**known, "x_P1": first[0], "x_P2": first[1], "y_P1": second[0], "y_P2": second[1]}
        yield named_step(rates.point_velocity, values, key=f"point_velocity.{name}")
        function = rates.point_acceleration_steady if steady else rates.point_acceleration
        yield named_step(function, values, key=f"point_acceleration.{name}")
    for name, one in motion.links.items():
        if name != mechanism.crank.link:
            values = {**known, **dict(zip(("theta_1", "theta_2"), _rates(one, row), strict=True))}
            yield named_step(rates.link_angular_velocity, values, key=f"link_angular_velocity.{name}")
            turning = rates.link_angular_acceleration_steady if steady else link_loads.link_angular_acceleration
            yield named_step(turning, values, key=f"link_angular_acceleration.{name}")
    for name, one in motion.sliders.items():
        values = {**known, **dict(zip(("s_1", "s_2"), _rates(one, row), strict=True))}
        yield named_step(rates.slider_velocity, values, key=f"slider_velocity.{name}")
        sliding = rates.slider_acceleration_steady if steady else rates.slider_acceleration
        yield named_step(sliding, values, key=f"slider_acceleration.{name}")


def _rates(coordinate: Transfer, row: int) -> tuple[float, float]:
    return float(coordinate.position_1[row]), float(coordinate.position_2[row])


def _inertia_loads(
    bodies: tuple[BodyMotion, ...], motion: Motion, row: int, known: Mapping[str, float]
) -> Iterator[Step]:
    """Yield inertia force along x and y and inertia torque of each body, with the accelerations not shown yet."""
    steady = not known["eps"]
    accelerating = rates.centre_acceleration_steady if steady else link_loads.centre_acceleration
    turning = rates.link_angular_acceleration_steady if steady else link_loads.link_angular_acceleration
    for name, body in _named(bodies):
        moving = [(axis, _rates(one, row)) for axis, one in zip("xy", body.centre, strict=True)]
        largest = max(abs(rate) for _, both in moving for rate in both)
        for axis, (q_1, q_2) in moving if body.body.mass else ():
            # what does not move along an axis has rounding there
            if max(abs(q_1), abs(q_2)) > _ROUNDING * largest:
                values = {**known, "q_1": q_1, "q_2": q_2}
                step = named_step(accelerating, values, key=f"centre_acceleration.{name}.{axis}")
                yield step
                force = link_loads.link_inertia_force
                yield worked_step(force, body.body.mass, step.value, key=f"link_inertia_force.{name}.{axis}")
        if body.body.inertia:
            values = {**known, "theta_1": float(body.angle_1[row]), "theta_2": float(body.angle_2[row])}
            step = named_step(turning, values, key=f"link_angular_acceleration.{name}")
            if body.body.link not in motion.links:
                yield step
            torque = link_loads.link_inertia_torque
            yield worked_step(torque, body.body.inertia, step.value, key=f"link_inertia_torque.{name}")


def _named(bodies: tuple[BodyMotion, ...]) -> Iterator[tuple[str, BodyMotion]]:
    """Yield the bodies with the names of their links, numbered where a link has more than one."""
    return zip(_distinct(one.body.link for one in bodies), bodies, strict=True)


def _distinct(names: Iterable[str]) -> list[str]:
    """Return names with a number from the second of the same name on."""
    seen: Counter[str] = Counter()
    result = []
    for name in names:
        seen[name] += 1
        result.append(name if seen[name] == 1 else f"{name}_{seen[name]}")
    return result


def _reduction(solved: SolvedLinkage, bodies: tuple[BodyMotion, ...], motion: Motion, row: int) -> Iterator[AnyStep]:
    """Yield reduced inertia and its derivative body by body, and the reduced torque load by load."""
    machine = solved.machine
    inertia: list[AnyStep] = []
    change: list[AnyStep] = []
    for name, body in _named(bodies):
        (x_1, x_2), (y_1, y_2) = (_rates(one, row) for one in body.centre)
        values = {
            "m_i": body.body.mass, "J_S": body.body.inertia, "x_S1": x_1, "x_S2": x_2, "y_S1": y_1, "y_S2": y_2,
            "theta_1": float(body.angle_1[row]), "theta_2": float(body.angle_2[row]),
        }  # fmt: skip
        of_body, change_of_body = _formulas_of(body)
        inertia.append(named_step(of_body, values, key=f"reduced_inertia.{name}"))
        change.append(named_step(change_of_body, values, key=f"reduced_inertia_1.{name}"))
    if machine.drive.inertia:
        inertia.append(Given("reduced_inertia.drive", machine.drive.inertia))
    if inertia:
        whole = sum_step("reduced_inertia", inertia)
        yield whole
        yield worked_step(reduction.kinetic_energy, whole.value, solved.speed)
    if change:
        yield sum_step("reduced_inertia_1", change)
    loads = _loads(solved, motion, row)
    if loads:
        yield sum_step("reduced_torque", loads)


def _formulas_of(body: BodyMotion) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Return the formulas of a body for the reduced inertia and its derivative, without terms that are zero."""
    if not body.body.inertia:
        return inertia_parts.reduced_inertia_of_mass, inertia_parts.reduced_inertia_1_of_mass
    if not body.body.mass:
        return inertia_parts.reduced_inertia_of_turning, inertia_parts.reduced_inertia_1_of_turning
    return reduction.reduced_inertia_of_body, reduction.reduced_inertia_1_of_body


def _loads(solved: SolvedLinkage, motion: Motion, row: int) -> list[AnyStep]:
    loads = running_at(solved, motion).loads
    names = _distinct([*(one.link for one in loads.forces), *(one.link for one in loads.torques)])
    result: list[AnyStep] = []
    for name, force in zip(names, loads.forces, strict=False):
        arrays = (force.x, force.at.x.position_1, force.y, force.at.y.position_1)
        values = [float(array[row]) for array in arrays]
        result.append(worked_step(reduction.reduced_torque_of_force, *values, key=f"reduced_torque.{name}"))
    for name, torque in zip(names[len(loads.forces) :], loads.torques, strict=True):
        values = [float(torque.torque[row]), float(torque.angle_1[row])]
        result.append(worked_step(reduction.reduced_torque_of_torque, *values, key=f"reduced_torque.{name}"))
    return result
