"""From a table of transfer functions to reduced inertia and torques, position by position, as a document does it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Notice
from crankwork.dynamics.efficiency import driving_torque
from crankwork.dynamics.reduction import dynamic_torque_steady
from crankwork.dynamics.tabulated import difference_derivative, tabulated_inertia
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.linkage_machine import TabulatedMachine
from crankwork.method import Method

GROUPS = {
    "dynamics": (
        "reduced_inertia", "reduced_inertia_1", "static_torque", "dynamic_torque", "balancing_torque",
        "driving_torque",
    )
}  # fmt: skip


@dataclass(frozen=True)
class SolvedTable:
    """A tabulated machine made ready: angular speed with the method's own pi. [rad/s]"""

    machine: TabulatedMachine
    method: Method
    speed: float


def analyse_tabulated(machine: TabulatedMachine) -> Results:
    """Return reduced inertia and torques at the positions of a table.

    Parameters
    ----------
    machine : TabulatedMachine
        Transfer functions, masses and torques.

    Returns
    -------
    Results
        Columns, summary and notices.

    References
    ----------
    artobolevsky_1988, ch. 15 and 16.
    """
    solved = SolvedTable(machine, machine.method, machine.speed * machine.method.pi / math.pi)
    grid = CrankGrid.from_degrees([round(math.degrees(one), 9) for one in machine.angles])
    inertia = tabulated_inertia(machine.bodies)
    if machine.reduced_inertia_1 is None:
        inertia_1 = difference_derivative(grid.angle, inertia, machine.differences)
    else:
        inertia_1 = np.array(machine.reduced_inertia_1)
    dynamic = np.asarray(dynamic_torque_steady(solved.speed, inertia_1))
    columns = {
        "crank_angle": grid.angle,
        "reduced_inertia": inertia,
        "reduced_inertia_1": inertia_1,
        "dynamic_torque": dynamic,
    }
    static = _static(machine, dynamic)
    if static is not None:
        columns |= {
            "static_torque": static,
            "balancing_torque": static + dynamic,
            "driving_torque": driving_torque(static, dynamic, machine.drive.efficiency),
        }
    return Results(solved, grid, columns, _summary(solved, columns), {}, _notices(machine), GROUPS)


def _static(machine: TabulatedMachine, dynamic: Array) -> Array | None:
    """Return the static torque, given or left of the balancing torque."""
    if machine.static_torque is not None:
        return np.array(machine.static_torque)
    if machine.balancing_torque is not None:
        return np.array(machine.balancing_torque) - dynamic
    return None


def _summary(solved: SolvedTable, columns: dict[str, Array]) -> dict[str, float]:
    machine = solved.machine
    result = {"rotational_speed": machine.speed, "speed": solved.speed}
    if machine.drive.efficiency != 1:
        result["efficiency"] = machine.drive.efficiency
    for key in ("reduced_inertia", "dynamic_torque", "driving_torque"):
        if key in columns:
            high, low = int(np.argmax(columns[key])), int(np.argmin(columns[key]))
            result |= {
                f"{key}_max": float(columns[key][high]),
                f"{key}_max_angle": float(columns["crank_angle"][high]),
                f"{key}_min": float(columns[key][low]),
                f"{key}_min_angle": float(columns["crank_angle"][low]),
            }
    return result


def _notices(machine: TabulatedMachine) -> tuple[Notice, ...]:
    notices = [Notice("positions", {"count": len(machine.angles)})]
    if machine.reduced_inertia_1 is not None:
        notices.append(Notice("given_derivative", {}))
    elif machine.differences != "spectral":
        notices.append(Notice("differences", {"scheme": machine.differences}))
    if machine.drive.exact_efficiency is not None:
        notices.append(Notice("rounded_efficiency", {
            "used": machine.drive.efficiency, "exact": machine.drive.exact_efficiency,
        }))  # fmt: skip
    return tuple(notices)
