"""The note of a linkage: which sections it has, in which order, by school."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from crankwork.analysis import Results
from crankwork.note import linkage_table_note as table
from crankwork.note.chambers import chambers
from crankwork.note.document import Block, Contents, Note, PageBreak, TitlePage
from crankwork.note.linkage_data import structural_analysis, task
from crankwork.note.linkage_driver import driven_forces, driven_motion, driven_task
from crankwork.note.linkage_forces import balance, forces, reduction, torques
from crankwork.note.linkage_friction import friction
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_motion import kinematics, law_of_motion
from crankwork.note.linkage_quality import quality
from crankwork.note.linkage_shaft import appendix, checks, conclusion, flywheel, motor, sources
from crankwork.note.linkage_tables import explained
from crankwork.note.linkage_transient import transient
from crankwork.note.options import NoteOptions

Section = Callable[[Material], Iterator[Block]]

_COURSE: tuple[Section, ...] = (
    task, structural_analysis, kinematics, quality, chambers, forces, balance, reduction, torques, friction, motor,
    flywheel, law_of_motion, transient, checks, conclusion, sources, appendix,
)  # fmt: skip
# engineers who read English want the results before the way to them
_REPORT: tuple[Section, ...] = (
    task, conclusion, structural_analysis, kinematics, quality, chambers, forces, balance, reduction, torques, friction,
    motor, flywheel, law_of_motion, transient, checks, sources, appendix,
)  # fmt: skip
_DRIVEN: tuple[Section, ...] = (
    driven_task, structural_analysis, driven_motion, quality, chambers, driven_forces, friction, checks, conclusion,
    sources, appendix,
)  # fmt: skip
# the tables keep the numbers that courses of machines give them
_OF_TABLE: tuple[Section, ...] = (
    table.table_task, table.static, table.dynamic, table.driving, checks, conclusion, sources,
)  # fmt: skip


def linkage_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of a linkage, or of a table of transfer functions (artobolevsky_1988, ch. 2-16)."""
    material = Material(results, options)
    words, of_table = material.words, results.machine.transfer is not None
    sections = _OF_TABLE if of_table else _REPORT if options.order == "en" else _COURSE
    if results.period:
        sections = _DRIVEN
    blocks: list[Block] = [TitlePage(), Contents(), PageBreak()]
    for section in sections:
        blocks.extend(section(material))
    title = options.title or results.machine.title or words.title("tabulated" if of_table else "linkage")
    return Note(
        title,
        options.language,
        tuple(explained(blocks, options.language)),
        subtitle=words.title("linkage_subtitle"),
        authors=(options.author,) if options.author else (),
    )
