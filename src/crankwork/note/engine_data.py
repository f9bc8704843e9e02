"""The beginning of the note of an engine: preface, input data and method."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.formula.known import Given, Node, in_order
from crankwork.machine import Bearings, Engine
from crankwork.note.document import Block, Cell, Citation, Reference
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import value_row, value_table
from crankwork.note.words import EngineWords
from crankwork.quantities import cycle as cycle_quantities
from crankwork.report.summary import results_method

GEAR = ("rotational_speed", "angular_acceleration", "stroke", "crank_radius", "rod_length", "rod_ratio", "offset")
_SIZES = (
    ("bearing_diameter", "crankpin_diameter", "crankpin"), ("bearing_length", "crankpin_length", "crankpin"),
    ("bearing_diameter", "main_diameter", "main_journal"), ("bearing_length", "main_length", "main_journal"),
    ("bearing_diameter", "pin_diameter", "small_end"), ("bearing_length", "pin_length", "small_end"),
)  # fmt: skip
_OF_ROD = ("rod_mass", "small_end_share", "rod_centre_distance", "rod_inertia", "rod_gyration_radius")
_ELSEWHERE = ("cylinder_count", "displacement")
_SOURCES = {"first": "kolchin_demidov_2008, ch. 7", "second": "kolchin_demidov_2008, ch. 9"}


def preface(material: Material) -> Iterator[Block]:
    """Yield the preface of notes that have one."""
    yield material.words.heading("preface")
    yield material.words.paragraph("preface")


def data(material: Material) -> Iterator[Block]:
    """Yield the input data and, except where it is a section of its own, the method."""
    words = material.words
    yield words.heading("data")
    yield words.paragraph("data", table=Reference("t:data"))
    yield value_table("data", _rows(material), words)
    if material.order != "en":
        yield from _how(material)
    yield from material.intro(
        "geometry", material.equations("geometry") + material.equations("speed", "speed", "mean_piston_speed")
    )
    if material.results.solved.space is None:
        yield from material.intro("volumes", material.equations("gas"))


def method(material: Material) -> Iterator[Block]:
    """Yield the section about the method, with what it follows."""
    yield material.words.heading("method")
    yield from _how(material)


def _how(material: Material) -> Iterator[Block]:
    """Yield method, constants, crank-to-rod ratio of every stage, and conventions."""
    words, results = material.words, material.results
    yield words.paragraph(
        "method",
        method=results_method(results, words.language),
        pi=words.number(results.method.pi, digits=9 if results.method.pi == math.pi else 6),
        gravity=words.number(results.method.gravity),
    )
    used, ratio = results.method.inertia_rod_ratio, results.summary["rod_ratio"]
    if used is not None and not results.method.is_exact:
        yield words.paragraph("two_ratios", used=words.number(used), ratio=words.number(ratio))
    else:
        yield words.paragraph("one_ratio", ratio=words.number(ratio))
    yield words.paragraph("conventions")
    if "piston_force" in results.columns:
        yield words.paragraph("references", **{name: Citation(source) for name, source in _SOURCES.items()})


def _rows(material: Material) -> Iterator[tuple[Cell, ...]]:
    """Yield the rows of the input data."""
    words, machine = material.words, material.machine
    # values calculated from them are in the equations after the table
    known = {value.key: value.value for value in in_order(material.results.memory.values()) if _is_stated(value.node)}
    if "crank_radius" in known:
        known.pop("stroke", None)
    known |= {"rotational_speed": machine.speed, "angular_acceleration": machine.angular_acceleration}
    known |= {"offset": material.summary.get("offset", 0.0)}
    for key in GEAR:
        if known.get(key):
            yield value_row(key, known[key], words)
    yield from _cylinder(material)
    yield from _masses(material)
    if machine.gas is not None:
        yield value_row("cycle_angle", math.radians(machine.gas.cycle), words)
        if machine.gas.is_absolute:
            yield value_row("ambient_pressure", machine.gas.ambient, words)
    engine = machine.engine
    if engine is not None:
        yield from _engine(engine, words) if len(engine.layout.places) > 1 else ()
        yield from _sizes(engine.bearings, words)
        if machine.drive.fluctuation is not None:
            yield value_row("speed_fluctuation", machine.drive.fluctuation, words)


def _is_stated(node: Node) -> bool:
    return isinstance(node, Given) and bool(node.path) and not node.is_absent


def _cylinder(material: Material) -> Iterator[tuple[Cell, ...]]:
    cylinder = material.machine.cylinder
    if cylinder is not None:
        for key in ("bore", "clearance_volume", "compression_ratio", "inclination"):
            value = getattr(cylinder, key)
            if value:
                yield value_row(key, value, material.words)


def _masses(material: Material) -> Iterator[tuple[Cell, ...]]:
    masses = material.machine.masses
    if masses is not None:
        rod = _rod(material) or {
            "rod_small_end_mass": masses.rod_small_end,
            "rod_big_end_mass": masses.rod_big_end,
            "rod_inertia_excess": masses.rod_inertia_excess,
        }
        parts = {"piston_mass": masses.piston, **rod, "crank_mass": masses.crank}
        area = material.summary.get("piston_area") if material.per_area else None
        yield from (value_row(key, value, material.words, area=area) for key, value in parts.items() if value)


def _rod(material: Material) -> dict[str, float]:
    """Return the mass of the rod and its centre, for a rod whose parts follow from them."""
    memory = material.results.memory
    behind = in_order([memory[key] for key in ("reciprocating_mass", "correction_couple") if key in memory])
    known = {traced.key: traced.value for traced in behind if traced.key in _OF_ROD and isinstance(traced.value, float)}
    if "small_end_share" in known:
        known.pop("rod_centre_distance", None)
    return {key: known[key] for key in _OF_ROD if key in known} if "rod_mass" in known else {}


def _engine(engine: Engine, words: EngineWords) -> Iterator[tuple[Cell, ...]]:
    layout = engine.layout
    yield value_row("cylinder_count", float(len(layout.places)), words)
    yield (words.term("arrangement"), "–", words.kind(layout.kind), "–")
    yield (words.term("order"), "–", "–".join(map(str, layout.firing_order)), "–")


def _sizes(bearings: Bearings, words: EngineWords) -> Iterator[tuple[Cell, ...]]:
    for key, name, part in _SIZES:
        value = getattr(bearings, name)
        if value is not None:
            yield value_row(f"{key}.{part}", value, words)


def cycle_keys(material: Material) -> list[str]:
    """Return the keys of the inputs of the working cycle: its values without a line."""
    given = {row.key for row in cycle_quantities.ROWS} - {line.key for line in material.cycle}
    return [key for key in material.summary if key in given and key not in _ELSEWHERE]
