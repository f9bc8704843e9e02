"""The formats in which a note can be written, by the ending of the file."""

from __future__ import annotations

from pathlib import PurePath

from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.note.document import Note
from crankwork.note.pdf import pdf
from crankwork.note.web import web
from crankwork.note.word import word

WRITERS = {".pdf": pdf, ".docx": word, ".html": web}
_MODULES: dict[str, dict[str, str]] = {".pdf": {"typst": "report"}, ".docx": {"docx": "report"}, ".html": {}}


def check_format(name: str, *, with_figures: bool = False, with_sheets: bool = False) -> None:
    """Raise unless a note of this format can be written, before anything is computed."""
    if PurePath(name).suffix.lower() not in WRITERS:
        raise CrankworkError(f"{name}: no format of a note has this ending; end it in {', '.join(WRITERS)}")
    modules = _MODULES[PurePath(name).suffix.lower()]
    if with_figures:
        modules = modules | {"matplotlib": "figures"}
    if with_sheets:
        modules = modules | {"typst": "report", "ezdxf": "report"}
    if extras := missing_extras(modules):
        raise MissingExtraError("this note", *extras)


def written_note(note: Note, name: str) -> bytes:
    """Return a note in the format that the ending of a file name asks for."""
    check_format(name)
    return WRITERS[PurePath(name).suffix.lower()](note)
