"""From a table of transfer functions to reduced inertia and torques, position by position, as a document does it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.results import Results
from crankwork.dynamics import reduction
from crankwork.dynamics.efficiency import driving_torque_as_brake, driving_torque_as_motor
from crankwork.formula.replay import Program, replay
from crankwork.formula.traced_value import (
    AngleFunction,
    Piecewise,
    ProcedureValue,
    Tabulated,
    TracedValue,
    absent,
    given,
    total,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Machine, TransferTable
from crankwork.preparation import traced_inputs
from crankwork.preparation.linkage import speed_of
from crankwork.preparation.prepared import Notice, PreparedMachine

DYNAMICS = (
    "reduced_inertia", "reduced_inertia_1", "static_torque", "dynamic_torque", "balancing_torque", "driving_torque",
)  # fmt: skip


def analyse_tabulated(machine: Machine, table: TransferTable) -> Results:
    """Return reduced inertia and torques at the positions of a table (artobolevsky_1988, ch. 15 and 16)."""
    solved = PreparedMachine(machine, machine.method, machine.speed * machine.method.pi / math.pi)
    grid = CrankGrid.from_degrees([round(math.degrees(angle), 9) for angle in table.angles])
    trace = _trace(machine, table, grid)
    columns = Program(trace)(grid)
    summary = _summary(machine, columns, trace)
    values = {key: value.value for key, value in summary.items()}
    groups = {"dynamics": DYNAMICS}
    return Results(solved, grid, columns, values, {}, _notices(machine, table), groups, trace={**trace, **summary})


@dataclass(frozen=True)
class Rows:
    """Numbers that are given at the positions of a table only. [deg]"""

    degrees: tuple[float, ...]
    values: tuple[float, ...]

    def __call__(self, degrees: Array) -> Array:
        """Return the numbers of the nearest positions."""
        return np.asarray(np.array(self.values)[self._nearest(degrees)])

    def _nearest(self, degrees: Array | float) -> NDArray[np.intp]:
        return np.asarray(np.argmin(np.abs(np.subtract.outer(degrees, self.degrees)), axis=-1))


@dataclass(frozen=True)
class StatedRows(Rows):
    """Numbers that a description states by position. `path`: where."""

    path: str

    def between(self, degrees: float, _: TracedValue) -> TracedValue:
        """Return the number of the nearest position as it is stated."""
        index = int(self._nearest(degrees))
        return given("", self.values[index], f"{self.path}[{index + 1}]")


def _trace(machine: Machine, table: TransferTable, grid: CrankGrid) -> dict[str, TracedValue]:
    """Return the columns of a table."""

    def row(key: str, values: Iterable[float], path: str = "", operands: tuple[TracedValue, ...] = ()) -> TracedValue:
        values, degrees = tuple(float(value) for value in values), tuple(grid.degrees.tolist())
        if len(values) == 1:
            return given(key, values[0], f"{path}[1]") if values[0] else absent(key)
        if path:
            return TracedValue(Tabulated(StatedRows(degrees, values, path), "given"), key)
        return TracedValue(Tabulated(Rows(degrees, values), "positions", operands=operands), key)

    def part(body: reduction.TabulatedBody) -> TracedValue:
        path = f"{table.of_bodies}.{body.name}"
        velocity = row(f"velocity_ratio.{body.name}", body.velocity_ratio, f"{path}.velocity")
        rotation = row(f"rotation_ratio.{body.name}", body.rotation_ratio, f"{path}.rotation")
        mass, inertia = (
            given(f"{key}.{body.name}", value, f"{path}.{name}") if value else absent(key)
            for key, name, value in (("body_mass", "mass", body.mass), ("body_inertia", "inertia", body.inertia))
        )
        result: TracedValue = reduction.reduced_inertia_of_ratios(mass, velocity, inertia, rotation)
        return result.named(f"reduced_inertia.{body.name}")

    w, inertia = speed_of(machine), total("reduced_inertia", [part(body) for body in table.bodies])
    trace = {"crank_angle": TracedValue(AngleFunction("angle"), "crank_angle"), "reduced_inertia": inertia}
    trace["reduced_inertia_1"] = change = _change(table, grid, inertia, row).named("reduced_inertia_1")
    dynamic: TracedValue = reduction.dynamic_torque(
        w, change, absent("reduced_inertia"), absent("angular_acceleration")
    )
    trace |= {"kinetic_energy": reduction.kinetic_energy(inertia, w), "dynamic_torque": dynamic.named("dynamic_torque")}
    static = _static(table, dynamic.named("dynamic_torque"), row)
    if static is None:
        return trace
    balancing: TracedValue = reduction.balancing_torque_of_parts(static, trace["dynamic_torque"])
    torques = static, trace["dynamic_torque"], traced_inputs.efficiency_of(machine.drive)
    drives = replay(balancing, grid) > 0
    # each position has its own law: no values are defined between positions
    laws = tuple((driving_torque_as_motor if drive else driving_torque_as_brake)(*torques) for drive in drives)
    driving = TracedValue(Piecewise(grid.degrees.tolist(), laws), "driving_torque")
    return trace | {"static_torque": static, "balancing_torque": balancing, "driving_torque": driving}


def _change(
    table: TransferTable, grid: CrankGrid, inertia: TracedValue, row: Callable[..., TracedValue]
) -> TracedValue:
    """Return the derivative of the reduced inertia: of the document, by differences, or of all positions at once."""
    key = "reduced_inertia_1"
    if table.reduced_inertia_1 is not None:
        return row(key, table.reduced_inertia_1, f"{table.of_crank}.reduced_inertia_1")
    column, operands = replay(inertia, grid), (inertia,)
    if table.differences == "spectral":
        return row(key, reduction.spectral_derivative(grid.angle, column), operands=operands)
    ahead = row("reduced_inertia.next", np.roll(column, -1), operands=operands)
    step = np.append(np.diff(grid.angle), grid.angle[0] + 2 * np.pi - grid.angle[-1])
    if table.differences == "forward":
        forward: TracedValue = reduction.forward_difference(ahead, inertia, row("crank_angle.step", step))
        return forward
    behind = row("reduced_inertia.previous", np.roll(column, 1), operands=operands)
    central: TracedValue = reduction.central_difference(ahead, behind, row("crank_angle.step", step + np.roll(step, 1)))
    return central


def _static(table: TransferTable, dynamic: TracedValue, row: Callable[..., TracedValue]) -> TracedValue | None:
    """Return the static torque, given or left of the balancing torque."""
    if table.static_torque is not None:
        return row("static_torque", table.static_torque, f"{table.of_crank}.static_torque")
    if table.balancing_torque is not None:
        balancing = row("balancing_torque", table.balancing_torque, f"{table.of_crank}.balancing_torque")
        left: TracedValue = reduction.static_torque_of_balancing(balancing, dynamic)
        return left.named("static_torque")
    return None


def _summary(
    machine: Machine, columns: Mapping[str, Array], trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    result = traced_inputs.speeds(machine, speed_of(machine)) | traced_inputs.efficiency(machine.drive)
    for key in ("reduced_inertia", "dynamic_torque", "driving_torque"):
        for word, find in (("max", np.argmax), ("min", np.argmin)) if key in columns else ():
            row, operands = int(find(columns[key])), (trace[key],)
            degrees = float(np.degrees(columns["crank_angle"][row]))
            result[f"{key}_{word}"] = TracedValue(ProcedureValue(float(columns[key][row]), word, operands, degrees))
            result[f"{key}_{word}_angle"] = TracedValue(
                ProcedureValue(float(columns["crank_angle"][row]), f"{word}_angle", operands, degrees)
            )
    return {key: value.named(key) for key, value in result.items()}


def _notices(machine: Machine, table: TransferTable) -> tuple[Notice, ...]:
    notices = [Notice("positions", {"count": len(table.angles)})]
    if table.reduced_inertia_1 is not None:
        notices.append(Notice("given_derivative", {}))
    elif table.differences != "spectral":
        notices.append(Notice("differences", {"scheme": table.differences}))
    if machine.drive.exact_efficiency is not None:
        notices.append(Notice("rounded_efficiency", {
            "used": machine.drive.efficiency, "exact": machine.drive.exact_efficiency,
        }))  # fmt: skip
    return tuple(notices)
