"""The note of a linkage: which sections it has, in which order, by school."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from crankwork.analysis import Results
from crankwork.note.chambers import chambers
from crankwork.note.document import Block, Note
from crankwork.note.linkage_bearings import bearings, harmonics
from crankwork.note.linkage_data import structural_analysis, task
from crankwork.note.linkage_driver import driven_forces, driven_motion, driven_task
from crankwork.note.linkage_forces import balance, forces, friction, reduction, torques
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_motion import kinematics, law_of_motion, transient
from crankwork.note.linkage_quality import quality
from crankwork.note.linkage_shaft import appendix, checks, comparison, conclusion, flywheel, motor, sources
from crankwork.note.linkage_table_note import driving, dynamic, static, table_task
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections

Section = Callable[[Material], Iterator[Block]]

_SECTIONS: dict[str, Section] = {
    "task": task, "structure": structural_analysis, "kinematics": kinematics, "quality": quality,
    "chambers": chambers, "forces": forces, "balance": balance, "reduction": reduction, "torques": torques,
    "friction": friction, "bearings": bearings, "harmonics": harmonics, "motor": motor, "flywheel": flywheel,
    "law_of_motion": law_of_motion, "transient": transient, "comparison": comparison, "checks": checks,
    "conclusion": conclusion, "sources": sources, "appendix": appendix,
}  # fmt: skip
# a driver with a law of its own needs a torque or force at every moment, and no flywheel
_DRIVEN = {"task": driven_task, "kinematics": driven_motion, "forces": driven_forces}
_NOT_DRIVEN = (
    "balance", "reduction", "torques", "bearings", "harmonics", "motor", "flywheel", "law_of_motion", "transient",
)  # fmt: skip
# the tables keep the numbers that courses of machines give them
_OF_TABLE: dict[str, Section] = {
    "task": table_task, "static": static, "dynamic": dynamic, "driving": driving, "comparison": comparison,
    "checks": checks, "conclusion": conclusion, "sources": sources,
}  # fmt: skip


def linkage_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of a linkage, or of a table of transfer functions (artobolevsky_1988, ch. 2-16)."""
    material = Material(results, options)
    sections, order, title = _SECTIONS, list(_SECTIONS), "linkage"
    if results.has_positions:
        sections, order, title = _OF_TABLE, list(_OF_TABLE), "tabulated"
    elif results.period:
        sections = {**_SECTIONS, **_DRIVEN, **dict.fromkeys(_NOT_DRIVEN, _nothing)}
    elif options.order == "en":
        # engineers who read English want the results before the way to them
        order = ["task", "conclusion", *(name for name in order if name not in ("task", "conclusion"))]
    words = material.words
    return note_of_sections(material, sections, tuple(order), words.title(title), words.title("linkage_subtitle"))


def _nothing(_: Material) -> Iterator[Block]:
    """Yield nothing: a section that such a machine has not."""
    yield from ()
