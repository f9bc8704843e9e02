"""The gas of a linkage in the cylinders that it is made of: chambers at the heads of pistons, and behind them.

Also where the linkage states what its engine form is calculated from.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from crankwork.formula.traced_value import Input, TracedValue, in_order
from crankwork.loads.chamber import Chamber
from crankwork.loads.indicator import constant_diagram
from crankwork.locale import ErrorMessage
from crankwork.machine import Gas, Machine
from crankwork.mechanism.cells import Cell, NoCellsError, crank_cells

if TYPE_CHECKING:
    from crankwork.working_cycle.calculated_cycle import CalculatedPressure

# keys of an engine that a linkage does not have
_OF_ENGINES = re.compile(r"(rod|piston|cylinder|gas|cycle|engine)[.\[]|crank\.stroke$")
# of a key, and of the tables around it
_ENDS = re.compile(r"(?=[.\[]|$)")


def linkage_paths(machine: Machine) -> dict[str, str]:
    """Return where a linkage that has an engine form states the inputs of engines, by their path in a file of these.

    Of what several cylinders have alike it is the path of one of them.
    """
    cells = crank_cells(machine.mechanism).cells
    cell = next(each for each in cells if not each.master)
    chambers = chambers_of(machine, cells)[cell.slider]
    guides = {each.slider: machine.drawn.member(each.slider).guide for each in cells}
    rod, guide = f"links.{cell.link}", f"guides.{guides[cell.slider]}"
    paths = {
        "rod.length": f"{rod}.length",
        **{f"rod.{end}mass": f"{rod}.mass" for end in ("small_end_", "big_end_", "")},
        "rod.inertia": f"{rod}.inertia",
        "piston.mass": f"sliders.{cell.slider}.mass",
        "cylinder.offset": f"{guide}.through",
        "cylinder.inclination": f"{guide}.angle",
        "cylinder.bore": "shaft.bore",
        "engine.bank_angle": f"{guide}.angle",
        "engine.layout": "crank.points",
        "engine.throws": "crank.points",
        "engine.cylinders": "shaft.cylinders",
        "engine.firing_order": "shaft.firing",
        "engine.spacing": "shaft.positions",
        "engine.strokes": "shaft.period",
        **{
            f"engine.offsets[{number}]": f"guides.{guides[name]}.through"
            for number, name in enumerate(machine.shaft.cylinders if machine.shaft is not None else (), start=1)
        },
    }
    articulated = next((each for each in cells if each.master), None)
    if articulated is not None:
        own, table = f"links.{articulated.link}", "engine.articulated"
        paths |= {f"{table}.rod_length": f"{own}.length", f"{table}.inertia": f"{own}.inertia"}
        paths |= {f"{table}.{end}_mass": f"{own}.mass" for end in ("small_end", "big_end")}
        paths |= {
            f"{table}.{key}": f"links.{articulated.master}.points" for key in ("knuckle_radius", "knuckle_angles")
        }
    return paths | _of_gas(chambers)


def _of_gas(chambers: CellChambers) -> dict[str, str]:
    paths = dict[str, str]()
    if chambers.head is not None:
        head = f"chambers.{chambers.head[0]}"
        paths |= {f"cylinder.{key}": f"{head}.{key}" for key in ("clearance_volume", "compression_ratio")}
        paths |= {"cylinder.bore": f"{head}.faces[1].bore", "gas.ambient": f"{head}.ambient", "gas.points": head}
        paths |= dict.fromkeys(("gas.cycle", "cycle.cycle"), f"{head}.period")
        paths |= {"cycle.ambient_pressure": f"{head}.ambient", "gas.valves": f"{head}.valves"}
    if chambers.crank_end is not None:
        behind = f"chambers.{chambers.crank_end[0]}"
        paths |= {
            "cylinder.piston_rod_diameter": f"{behind}.faces[1].rod_diameter",
            "gas.back_pressure": f"{behind}.pressure",
        }
    return paths


def relocate(traced: Iterable[TracedValue], paths: Mapping[str, str]) -> None:
    """Give inputs of an engine form the paths of its linkage."""
    for known in in_order(traced):
        if isinstance(known.node, Input):
            known.node.path = relocated(known.node.path, paths)


def relocated(path: str, paths: Mapping[str, str]) -> str:
    """Return where a linkage states an input of its engine form; empty if it does not."""
    if not _OF_ENGINES.match(path):
        return path
    tables = (path[: dot.start()] for dot in reversed([*_ENDS.finditer(path)]))
    table = next((table for table in tables if table in paths), "")
    return f"{paths[table]}{path.removeprefix(table)}" if table else ""


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
        points, pieces = constant_diagram(chamber.pressure, cycle)
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
