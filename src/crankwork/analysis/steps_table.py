"""Worked steps of a table of transfer functions at one of its positions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

from crankwork.analysis.results import Results
from crankwork.analysis.steps_torque import sum_and_drive
from crankwork.dynamics.force_parts import central_difference, forward_difference, static_torque_of_balancing
from crankwork.dynamics.inertia_parts import reduced_inertia_of_rotation_ratio, reduced_inertia_of_velocity_ratio
from crankwork.dynamics.piston_forces import angular_speed
from crankwork.dynamics.reduction import dynamic_torque_steady, kinetic_energy
from crankwork.dynamics.tabulated import TabulatedBody, reduced_inertia_of_ratios
from crankwork.linkage_machine import TabulatedMachine
from crankwork.steps import AnyStep, Given, StepGroup, named_step, sum_step, worked_step


def table_steps(results: Results, row: int) -> tuple[StepGroup, ...]:
    """Return the worked steps of a table of transfer functions.

    Parameters
    ----------
    results : Results
        Of a tabulated machine.
    row : int
        The position.

    Returns
    -------
    tuple of StepGroup
        Groups `speed` of a method with a pi of its own, `reduction`, `torques`.
    """
    solved, angle = results.solved, float(results.grid.angle[row])
    return (
        *speed_steps(solved.method.pi, solved.machine.speed),
        StepGroup("reduction", tuple(_reduction(results, row)), angle),
        StepGroup("torques", tuple(_torques(results, row)), angle),
    )


def speed_steps(pi: float, speed: float) -> tuple[StepGroup, ...]:
    """Return the step from revolutions per minute to the angular speed, where it says anything.

    Parameters
    ----------
    pi, speed : float
        The constant of the method [-], the angular speed as it was given. [rad/s]

    Returns
    -------
    tuple of StepGroup
        None where pi is exact: the angular speed is what was given then, and the revolutions follow from it.
    """
    if pi == math.pi:
        return ()
    return (StepGroup("speed", (worked_step(angular_speed, pi, speed * 30 / math.pi),)),)


def _reduction(results: Results, row: int) -> Iterator[AnyStep]:
    machine: TabulatedMachine = results.solved.machine
    terms = []
    for body in machine.bodies:
        # a ratio that is given once holds at every position
        velocity, rotation = (
            ratios[row] if len(ratios) > 1 else ratios[0] for ratios in (body.velocity_ratio, body.rotation_ratio)
        )
        values = {"m_i": body.mass, "v_w": velocity, "J_S": body.inertia, "w_w": rotation}
        terms.append(named_step(_formula_of(body), values, key=f"reduced_inertia.{body.name}"))
    whole = sum_step("reduced_inertia", terms)
    yield whole
    yield worked_step(kinetic_energy, whole.value, results.solved.speed)
    yield _derivative(results, machine, row)


def _formula_of(body: TabulatedBody) -> Callable[..., Any]:
    """Return the formula of a body, without a term that is zero."""
    if not body.inertia:
        return reduced_inertia_of_velocity_ratio
    return reduced_inertia_of_ratios if body.mass else reduced_inertia_of_rotation_ratio


def _derivative(results: Results, machine: TabulatedMachine, row: int) -> AnyStep:
    """Return the derivative of the reduced inertia: of the document, by differences, or of all positions at once."""
    column, angle = results.columns["reduced_inertia"], results.grid.angle
    before, after = row - 1, (row + 1) % len(column)
    if machine.reduced_inertia_1 is not None or machine.differences == "spectral":
        return Given("reduced_inertia_1", float(results.columns["reduced_inertia_1"][row]))
    turn = 2 * math.pi
    ahead = float(angle[after] - angle[row]) % turn
    if machine.differences == "forward":
        return worked_step(forward_difference, column[after], column[row], ahead)
    behind = float(angle[row] - angle[before]) % turn
    return worked_step(central_difference, column[after], column[before], ahead + behind)


def _torques(results: Results, row: int) -> Iterator[AnyStep]:
    machine: TabulatedMachine = results.solved.machine
    at = {key: float(column[row]) for key, column in results.columns.items()}
    yield worked_step(dynamic_torque_steady, results.solved.speed, at["reduced_inertia_1"])
    if "static_torque" not in at:
        return
    if machine.static_torque is None and machine.balancing_torque is not None:
        yield worked_step(static_torque_of_balancing, machine.balancing_torque[row], at["dynamic_torque"])
    else:
        yield Given("static_torque", at["static_torque"])
    yield from sum_and_drive(at["static_torque"], at["dynamic_torque"], machine.drive.efficiency)
