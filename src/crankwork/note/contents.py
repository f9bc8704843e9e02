"""The note of a machine and its sheets: what results have decides what they say."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING, cast

from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage
from crankwork.note.document import Note
from crankwork.note.options import NoteOptions
from crankwork.note.pdf import pdf
from crankwork.note.sections import note_of_sections
from crankwork.note.web import web
from crankwork.note.word import word
from crankwork.quantities.quantity import use_numbers
from crankwork.report.display import for_readers, link_numbers, reader_units
from crankwork.report.summary import provenance
from crankwork.show.dxf import dxf
from crankwork.show.formats import pdf as page
from crankwork.show.svg import svg
from crankwork.units import use_units

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.note.document import Note
    from crankwork.quantities import Language


@for_readers
def note_of(results: Results, options: NoteOptions | None = None) -> Note:
    """Return the calculation note of a machine."""
    options = options or NoteOptions()
    with use_numbers(link_numbers(results)):
        note = note_of_sections(results, options)
    return replace(note, units=reader_units(results), provenance=provenance(results), results=results)


def sheets_of(results: Results, options: NoteOptions | None = None) -> dict[str, bytes]:
    """Return the drawing sheets of a machine in every format, by the ending of their files."""
    options = options or NoteOptions()
    if results.machine.alone:
        raise CrankworkError(ErrorMessage("sheets_of_shaft"))
    # few notes have sheets
    from crankwork.note import sheets  # noqa: PLC0415 - loaded where it is needed

    block = sheets.block_of(results.machine.document, cast("Language", options.order), options.author)
    paper = sheets.Paper(options.paper, has_grid=options.grid, block=block)
    with use_numbers(link_numbers(results)):
        drawn = sheets.drawn_sheets(results, options.language, paper=paper, per_area=options.per_area)
    formats = {"pdf": page, "svg": svg, "dxf": dxf}
    return {
        f"-sheet-{number}.{ending}": written(sheet.drawing, "black")
        for number, sheet in enumerate(drawn, start=1)
        for ending, written in formats.items()
    }


WRITERS = {".pdf": pdf, ".docx": word, ".html": web}
_MODULES: dict[str, dict[str, str]] = {".pdf": {"typst": "report"}, ".docx": {"docx": "report"}, ".html": {}}


def check_format(name: str, *, with_sheets: bool = False) -> None:
    """Raise unless a note of this format can be written, before anything is computed."""
    if PurePath(name).suffix.lower() not in WRITERS:
        raise CrankworkError(ErrorMessage("note_ending", name=name, known=", ".join(WRITERS)))
    modules = _MODULES[PurePath(name).suffix.lower()]
    if with_sheets:
        modules = modules | {"typst": "report", "ezdxf": "report"}
    if extras := missing_extras(modules):
        raise MissingExtraError(ErrorMessage("extra_note"), *extras)


def written_note(note: Note, name: str) -> bytes:
    """Return a note in the format that the ending of a file name asks for."""
    check_format(name)
    with use_units(note.units), use_numbers(link_numbers(note.results)):
        return WRITERS[PurePath(name).suffix.lower()](note)
