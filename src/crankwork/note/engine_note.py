"""The note of an engine: which sections it has, in which order, by school."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

from crankwork.analysis import Results
from crankwork.analysis.whole_engine import as_engine
from crankwork.errors import CrankworkError
from crankwork.note.document import Block, Note
from crankwork.note.engine_cycle import cycle, indicator
from crankwork.note.engine_data import data, method, preface
from crankwork.note.engine_end import appendix, checks, comparison, conclusion, sources
from crankwork.note.engine_forces import across, along, dynamics, inertia
from crankwork.note.engine_material import Material
from crankwork.note.engine_motion import acceleration, displacement, kinematics, velocity
from crankwork.note.engine_shaft import balance, big_end, crankpin, evenness, mains, polar, total, unrolled, wear
from crankwork.note.legends import explained
from crankwork.note.options import NoteOptions

Section = Callable[[Material], Iterator[Block]]

_ORDERS: dict[str, tuple[Section, ...]] = {
    "ru": (
        preface, data, cycle, indicator, kinematics, dynamics, total, crankpin, mains, balance, evenness, comparison,
        checks, conclusion, sources, appendix,
    ),
    # between the data and the checks the twelve sections that such notes have
    "vi": (
        preface, data, cycle, indicator, displacement, velocity, acceleration, inertia, along, across, total, polar,
        unrolled, big_end, wear, comparison, checks, conclusion, sources, appendix,
    ),
    # engineers who read English want the results before the way to them
    "en": (
        data, method, conclusion, cycle, indicator, kinematics, dynamics, total, crankpin, mains, balance, evenness,
        comparison, checks, sources, appendix,
    ),
}  # fmt: skip


def engine_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of an engine, or of a crank gear of which less is known (kolchin_demidov_2008, ch. 4-9)."""
    if options.order not in _ORDERS:
        raise CrankworkError(f'no school of notes is called "{options.order}"; take en, ru or vi')
    material = Material(as_engine(results), options, has_engine=results.machine.engine is not None)
    words = material.words
    blocks = itertools.chain.from_iterable(section(material) for section in _ORDERS[options.order])
    title = results.machine.title or words.title("crank_gear")
    return Note.of(explained(blocks, options.language, with_results=True), options, title, words.title("subtitle"))
