"""The formats in which a note can be written, by the ending of the file."""

from __future__ import annotations

from pathlib import PurePath

from crankwork.errors import CrankworkError
from crankwork.note.document import Note
from crankwork.note.pdf import pdf
from crankwork.note.web import web
from crankwork.note.word import word

WRITERS = {".pdf": pdf, ".docx": word, ".html": web}


def check_format(name: str) -> None:
    """Raise unless the ending of a file name is one of the formats, before anything is computed.

    Parameters
    ----------
    name : str
        Name or path of the file.

    Raises
    ------
    CrankworkError
        With the endings that there are.
    """
    if PurePath(name).suffix.lower() not in WRITERS:
        raise CrankworkError(f"{name}: no format of a note has this ending; end it in {', '.join(WRITERS)}")


def written_note(note: Note, name: str) -> bytes:
    """Return a note in the format that the ending of a file name asks for.

    Parameters
    ----------
    note : Note
        The note.
    name : str
        Name or path of the file; nothing is written.
    """
    check_format(name)
    return WRITERS[PurePath(name).suffix.lower()](note)
