"""The flywheel in a note: its lines by every method, and a table that compares them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from crankwork.formula.known import Known, Use, in_order
from crankwork.formula.lines import Line
from crankwork.locale import capital
from crankwork.note.document import Block, Bold, Paragraph
from crankwork.note.linkage_tables import equations
from crankwork.note.words import NoteWords

WHEEL_SIZES = (
    "flywheel_mass", "rim_speed", "rim_stress", "rim_diameter", "rim_mass", "rim_section", "rim_thickness", "rim_width",
)  # fmt: skip
_WHEEL = ("wittenbauer_slope", "whole_inertia", "flywheel_inertia")
_OF_ALL = ("work_per_cycle", "energy_fluctuation", *WHEEL_SIZES)


def values_by_method(memory: Mapping[str, Known]) -> Iterator[Known]:
    """Yield the excess work, slopes and inertias of each method of finding the flywheel."""
    for key in memory:
        for known in in_order([memory[key]]) if key.startswith("flywheel_inertia.") else ():
            kind = known.key.partition(".")[0]
            if kind == "excess_work" or (kind in _WHEEL and isinstance(known.node, Use) and known.value > 0):
                yield known


def flywheel_by_methods(lines: Iterable[Line], summary: Mapping[str, float], words: NoteWords) -> Iterator[Block]:
    """Yield the lines of every method under its name, and the table of what they find."""
    methods = [key.partition(".")[2] for key in summary if key.startswith("flywheel_inertia.")]
    lines, last = tuple(lines), ""
    for line in lines:
        method = next((name for name in methods if name in line.key.split(".")), last or methods[0])
        if method != last and line.key not in _OF_ALL:
            yield Paragraph((Bold(capital(words.way(method))), ":"))
            last = method
        yield from equations((line,), words, marks=_marks(methods, words))
    excess = {
        name: line.value for name in methods for line in lines if line.key in (f"excess_work.{name}", "excess_work")
    }
    rows = [
        (words.way(name), words.shown("excess_work", excess[name]),
         words.shown("flywheel_inertia", summary[f"flywheel_inertia.{name}"]))
        for name in methods
        if name in excess
    ]  # fmt: skip
    titles = ("way", words.titled("excess_work"), words.titled("flywheel_inertia"))
    yield words.table("flywheels", titles, rows, "lrr", "flywheels")


def _marks(methods: Iterable[str], words: NoteWords) -> Mapping[str, str]:
    """Return symbols of the slopes and inertias of each method: its name does not stand in a symbol."""
    marks: dict[str, str] = {}
    for name in methods:
        for kind in ("excess_work", "flywheel_inertia", "whole_inertia"):
            marks[f"{kind}.{name}"] = words.symbol(kind)
        slope = words.symbol("wittenbauer_slope")
        ends = {"largest": "max", "least": "min"}
        marks[f"wittenbauer_slope.{name}"] = slope
        marks |= {f"wittenbauer_slope.{name}.{end}": f"{slope}_{mark}" for end, mark in ends.items()}
    return marks
