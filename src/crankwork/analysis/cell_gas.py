"""The gas of a linkage in the cylinders that it is made of: chambers at the heads of pistons, and behind them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from crankwork.formula.traced_value import TracedValue
from crankwork.loads.chamber import Chamber
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.locale import ErrorMessage
from crankwork.machine import Gas, Machine
from crankwork.mechanism.cells import Cell, NoCellsError

if TYPE_CHECKING:
    from crankwork.working_cycle.calculated_cycle import CalculatedPressure

# of the size of a value, where rounding ends
_SAME = 1e-11
# fields that say where something is stated
_WHERE = ("path", "factor_path", "chamber", "rows")


@dataclass(frozen=True)
class CellChambers:
    """The chambers of a cylinder by name: at the head, and at the crank end, where there is none."""

    head: tuple[str, Chamber] | None = None
    crank_end: tuple[str, Chamber] | None = None


def chambers_of(machine: Machine, cells: Sequence[Cell]) -> dict[str, CellChambers]:
    """Return the chambers of each sliding piece."""
    chambers_by_slider = {cell.slider: CellChambers() for cell in cells}
    senses = {cell.slider: cell.sense for cell in cells}
    for name, chamber in machine.chambers.items():
        face = chamber.faces[0]
        if len(chamber.faces) > 1 or face.slider not in chambers_by_slider:
            raise NoCellsError(ErrorMessage("cells_chamber", name=name))
        # it shrinks towards the head
        side = "head" if face.sense == -senses[face.slider] else "crank_end"
        is_plain = side == "head" or (chamber.pressure is not None and chamber.factor == 1)
        if getattr(chambers_by_slider[face.slider], side) is not None or not is_plain:
            raise NoCellsError(ErrorMessage("cells_chamber", name=name))
        chambers_by_slider[face.slider] = replace(chambers_by_slider[face.slider], **{side: (name, chamber)})
    return chambers_by_slider


def bore_of(chamber: Chamber, machine: Machine) -> float:
    """Return the bore of a chamber with one face, stated or of its area. [m]"""
    face = chamber.faces[0]
    return face.bore if face.bore is not None else math.sqrt(4 * (face.area or 0.0) / machine.method.pi)


def gas_of(name: str, chamber: Chamber, cycle: float, crank_end: Chamber | None) -> Gas:
    """Return the gas of a chamber, with the pressure on the other side of the piston."""
    path = f"chambers.{name}"
    points, pieces = chamber.points, chamber.pieces
    if chamber.pressure is not None:
        points = {"o": DiagramPoint(0.0, chamber.pressure), "o'": DiagramPoint(cycle, chamber.pressure)}
        pieces = (Piece("constant", ("o", "o'")),)
    behind = 0.0 if crank_end is None else (crank_end.pressure or 0.0) - crank_end.ambient
    return Gas(
        cycle=cycle,
        points=points,
        pieces=pieces,
        valves=chamber.valves,
        measured=chamber.measured,
        angle_shift=chamber.angle_shift,
        resample=chamber.resample,
        is_absolute=bool(chamber.ambient),
        ambient=chamber.ambient,
        names_ambient=chamber.names_ambient,
        back_pressure=behind,
        calculated=cast("CalculatedPressure | None", chamber.calculated),
        factor=chamber.factor,
        factor_path=f"{path}.pressure_factor",
        path=path,
    )


def is_close(value: float, other: float) -> bool:
    """Return whether two numbers are equal within rounding."""
    return math.isclose(value, other, rel_tol=_SAME)


def nearly_equal(value: Any, other: Any) -> bool:  # noqa: ANN401 - numbers, and records of them
    """Return whether two values are equal within rounding, wherever each is stated."""
    if value is other:
        return True
    match value:
        case TracedValue():
            return isinstance(other, TracedValue) and is_close(value.value, other.value)
        case float() | int() if isinstance(other, float | int):
            return is_close(value, other)
        case np.ndarray():
            return (
                isinstance(other, np.ndarray) and value.shape == other.shape and np.allclose(value, other, 1e-12, 0.0)
            )
        case Mapping():
            return isinstance(other, Mapping) and value.keys() == other.keys() and all(
                nearly_equal(entry, other[name]) for name, entry in value.items()
            )  # fmt: skip
        case tuple():
            return isinstance(other, tuple) and len(value) == len(other) and all(map(nearly_equal, value, other))
    if is_dataclass(value):
        return type(value) is type(other) and all(
            nearly_equal(getattr(value, part.name), getattr(other, part.name))
            for part in fields(value)
            if part.name not in _WHERE
        )
    return bool(value == other)
