"""The note of an engine: which sections it has, in which order, by school."""

from __future__ import annotations

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
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections

Section = Callable[[Material], Iterator[Block]]

_SECTIONS: dict[str, Section] = {
    "preface": preface, "data": data, "method": method, "cycle": cycle, "indicator": indicator,
    "kinematics": kinematics, "displacement": displacement, "velocity": velocity, "acceleration": acceleration,
    "dynamics": dynamics, "inertia": inertia, "piston_forces": along, "crank_forces": across, "torque": total,
    "crankpin": crankpin, "polar": polar, "unrolled": unrolled, "big_end": big_end, "wear": wear, "mains": mains,
    "balance": balance, "evenness": evenness, "comparison": comparison, "checks": checks, "conclusion": conclusion,
    "sources": sources, "appendix": appendix,
}  # fmt: skip
_ORDERS: dict[str, tuple[str, ...]] = {
    "ru": (
        "preface", "data", "cycle", "indicator", "kinematics", "dynamics", "torque", "crankpin", "mains", "balance",
        "evenness", "comparison", "checks", "conclusion", "sources", "appendix",
    ),
    # between the data and the checks the twelve sections that such notes have
    "vi": (
        "preface", "data", "cycle", "indicator", "displacement", "velocity", "acceleration", "inertia",
        "piston_forces", "crank_forces", "torque", "polar", "unrolled", "big_end", "wear", "comparison", "checks",
        "conclusion", "sources", "appendix",
    ),
    # engineers who read English want the results before the way to them
    "en": (
        "data", "method", "conclusion", "cycle", "indicator", "kinematics", "dynamics", "torque", "crankpin", "mains",
        "balance", "evenness", "comparison", "checks", "sources", "appendix",
    ),
}  # fmt: skip


def engine_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of an engine, or of a crank gear of which less is known (kolchin_demidov_2008, ch. 4-9)."""
    if options.order not in _ORDERS:
        raise CrankworkError(f'no school of notes is called "{options.order}"; take en, ru or vi')
    material = Material(as_engine(results), options, has_engine=results.machine.engine is not None)
    words = material.words
    return note_of_sections(
        material,
        _SECTIONS,
        _ORDERS[options.order],
        words.title("crank_gear"),
        words.title("subtitle"),
        with_results=True,
    )
