"""The note of a shaft with torques on it: what acts, its excess work, its flywheel, how evenly it turns."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator

import numpy as np

from crankwork.analysis import Results
from crankwork.note.document import Block, ItemList, Note, Runs, Table
from crankwork.note.linkage_data import method
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_shaft import checks, comparison, conclusion, sources
from crankwork.note.linkage_tables import Column, equations, position_tables
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections
from crankwork.note.words import in_display_unit

_TABLES = (("torque", "drives"), ("load", "resists"))
# of a diagram that is told point by point
_MOST_POINTS = 60
# of a table over the angle
_MOST_ROWS = 120
# a speed changes little
_DIGITS = defaultdict(lambda: 4, crank_speed=6)
_COLUMNS = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip

Section = Callable[[Material], Iterator[Block]]


def turning_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of a shaft with torques on it (khurmi_gupta_2005, ch. 16)."""
    material = Material(results, options)
    words = material.words
    return note_of_sections(
        material, _SECTIONS, tuple(_SECTIONS), words.title("turning"), words.title("turning_subtitle")
    )


def _task(material: Material) -> Iterator[Block]:
    """Yield the task and the given data."""
    words, machine = material.words, material.machine
    turning = machine.turning
    if turning is None:
        return
    yield words.heading("task")
    yield words.paragraph("task_turning", cycle=words.amount(turning.cycle, "deg"))
    yield words.paragraph("table_speed", value=words.amount(material.results.solved.speed, "rad/s"))
    for table, verb in _TABLES:
        diagram = turning.diagrams.get(table)
        if diagram is None:
            yield words.paragraph(f"{verb}_mean")
            continue
        yield words.paragraph(verb, period=words.amount(diagram.period, "deg"))
        yield ItemList(tuple(_items(material, table)))
        if 0 < len(diagram.points) <= _MOST_POINTS:
            yield _points(material, table)
    yield method(material)


def _items(material: Material, table: str) -> Iterator[Runs]:
    """Yield the terms of a torque, in words."""
    words, turning = material.words, material.machine.turning
    diagram = turning.diagrams[table] if turning is not None else None
    if diagram is None:
        return
    if diagram.constant:
        yield words.sentence("item_constant", torque=words.amount(diagram.constant, "N*m"))
    if diagram.points:
        yield words.sentence("item_points", count=str(len(diagram.points)))
    for order, sine, cosine in diagram.harmonics:
        sine_, cosine_ = (words.amount(amplitude, "N*m") for amplitude in (sine, cosine))
        yield words.sentence("item_order", order=words.number(order), sine=sine_, cosine=cosine_)
    for stroke in diagram.strokes:
        values = {"work": words.amount(stroke.work, "J"), "start": words.amount(stroke.start, "deg")}
        if stroke.over:
            shape = words.phrase(f"shape_{stroke.shape}")
            yield words.sentence("item_stretch", over=words.amount(stroke.over, "deg"), shape=shape, **values)
        else:
            yield words.sentence("item_blow", **values)
    if diagram.loops:
        shown = "; ".join(words.amount(loop, "J") for loop in diagram.loops)
        yield words.sentence("item_loops", works=shown)
    if diagram.excess is not None:
        yield words.sentence("item_excess", work=words.amount(diagram.excess, "J"))
    if len(diagram.delays) > 1:
        delays = ", ".join(words.number(math.degrees(delay)) for delay in diagram.delays)
        yield words.sentence("item_cylinders", count=str(len(diagram.delays)), delays=delays)


def _points(material: Material, table: str) -> Table:
    """Return the points of a torque."""
    words, turning = material.words, material.machine.turning
    points = turning.diagrams[table].points if turning is not None else ()
    key = "turning_moment" if table == "torque" else "load_torque"
    rows = [(words.number(math.degrees(angle)), words.shown(key, torque)) for angle, torque in points]
    return words.table("points_of_torque", (words.titled("crank_angle"), words.titled(key)), rows, "rr")


def _moments(material: Material) -> Iterator[Block]:
    """Yield torque, mean and power."""
    words = material.words
    yield words.heading("turning_moments")
    if "turning_moment" in material.results.columns:
        yield from material.equations("stretches")
        yield from material.worked("turning_moments")
        yield words.paragraph("mean_of_torque")
    yield from material.equations("shaft_power")


def _excess(material: Material) -> Iterator[Block]:
    """Yield the extremes of the energy, and the excess work."""
    words, results = material.words, material.results
    yield words.heading("energy_extremes")
    listing = results.listings.get("energy_extremes")
    if listing is not None:
        yield words.paragraph("extremes_of_energy")
        columns = [
            (key, words.column_texts(in_display_unit(key, column.tolist()))) for key, column in listing.columns.items()
        ]
        rows = list(zip(*(texts for _, texts in columns), strict=True))
        titles = [words.titled(key) for key, _ in columns]
        yield words.table("energy_extremes", titles, rows, "r" * len(columns), "extremes")
    yield from material.equations("energy_extremes")
    yield from material.figures("turning_moment", "loops")


def _flywheel(material: Material) -> Iterator[Block]:
    """Yield the flywheel, given or found, and the fluctuation of the speed."""
    words = material.words
    lines = material.lines("flywheel")
    if lines:
        yield words.heading("flywheel")
        yield from equations(lines, words)


def _columns_and_speed(material: Material) -> Iterator[Block]:
    """Yield the table over the angle, and the speed."""
    words, results = material.words, material.results
    shown = [key for key in _COLUMNS if key in results.columns]
    if not shown:
        return
    yield words.heading("law_of_shaft")
    if "crank_speed" in shown:
        yield words.paragraph("speed_of_shaft")
    yield from material.equations("shaft_course")
    degrees = results.grid.degrees
    stride = math.ceil(degrees.size / _MOST_ROWS)
    rows = np.unique(np.append(np.arange(0, degrees.size, stride), degrees.size - 1))
    columns = {key: results.columns[key][rows] for key in shown}
    tabulated = [
        Column(words.titled(key), words.column_texts(in_display_unit(key, columns[key].tolist()), digits=_DIGITS[key]))
        for key in shown
    ]
    yield from position_tables("turning", degrees[rows], tabulated, words, first=None, label="turning")
    yield from material.figures("speed")


_SECTIONS: dict[str, Section] = {
    "task": _task, "moments": _moments, "energy": _excess, "flywheel": _flywheel, "law_of_motion": _columns_and_speed,
    "comparison": comparison, "checks": checks, "conclusion": conclusion, "sources": sources,
}  # fmt: skip
