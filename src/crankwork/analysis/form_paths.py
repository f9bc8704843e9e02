"""Paths in a linkage of the inputs that its engine form is calculated from."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from crankwork.analysis.cell_gas import CellChambers, chambers_of
from crankwork.formula.traced_value import Input, TracedValue, in_order
from crankwork.machine import Machine
from crankwork.mechanism.cells import crank_cells

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
        **{f"rod.{end}_mass": f"{rod}.mass" for end in ("small_end", "big_end")},
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
        paths |= {"cylinder.bore": f"{head}.faces[1].bore", "gas.ambient": f"{head}.ambient"}
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
    """Give inputs of an engine form the paths of its linkage; empty for an input that the linkage does not state."""
    for known in in_order(traced):
        node = known.node
        if isinstance(node, Input) and _OF_ENGINES.match(node.path):
            tables = (node.path[: dot.start()] for dot in reversed([*_ENDS.finditer(node.path)]))
            table = next((table for table in tables if table in paths), "")
            node.path = f"{paths[table]}{node.path.removeprefix(table)}" if table else ""
