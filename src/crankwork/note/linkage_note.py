"""The note of a linkage: which sections it has, in which order, by school."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

from crankwork.analysis import Results
from crankwork.note.chambers import chambers
from crankwork.note.document import Block, Note
from crankwork.note.legends import explained
from crankwork.note.linkage_data import structural_analysis, task
from crankwork.note.linkage_driver import driven_forces, driven_motion, driven_task
from crankwork.note.linkage_forces import balance, forces, reduction, torques
from crankwork.note.linkage_friction import friction
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_motion import kinematics, law_of_motion
from crankwork.note.linkage_quality import quality
from crankwork.note.linkage_shaft import appendix, checks, comparison, conclusion, flywheel, motor, sources
from crankwork.note.linkage_table_note import driving, dynamic, static, table_task
from crankwork.note.linkage_transient import transient
from crankwork.note.options import NoteOptions

Section = Callable[[Material], Iterator[Block]]

_COURSE: tuple[Section, ...] = (
    task, structural_analysis, kinematics, quality, chambers, forces, balance, reduction, torques, friction, motor,
    flywheel, law_of_motion, transient, comparison, checks, conclusion, sources, appendix,
)  # fmt: skip
# engineers who read English want the results before the way to them
_REPORT: tuple[Section, ...] = (
    task, conclusion, structural_analysis, kinematics, quality, chambers, forces, balance, reduction, torques, friction,
    motor, flywheel, law_of_motion, transient, comparison, checks, sources, appendix,
)  # fmt: skip
_DRIVEN: tuple[Section, ...] = (
    driven_task, structural_analysis, driven_motion, quality, chambers, driven_forces, friction, comparison, checks,
    conclusion, sources, appendix,
)  # fmt: skip
# the tables keep the numbers that courses of machines give them
_OF_TABLE: tuple[Section, ...] = (table_task, static, dynamic, driving, comparison, checks, conclusion, sources)


def linkage_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of a linkage, or of a table of transfer functions (artobolevsky_1988, ch. 2-16)."""
    material = Material(results, options)
    sections, title = _REPORT if options.order == "en" else _COURSE, "linkage"
    if results.period:
        sections = _DRIVEN
    if results.has_positions:
        sections, title = _OF_TABLE, "tabulated"
    words = material.words
    blocks = itertools.chain.from_iterable(section(material) for section in sections)
    title = results.machine.title or words.title(title)
    return Note.of(explained(blocks, options.language), options, title, words.title("linkage_subtitle"))
