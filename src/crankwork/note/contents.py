"""What a note says, by the kind of machine."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

from crankwork.machine import Machine
from crankwork.note.options import NoteOptions

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.note.document import Note


def note_of(results: Results, options: NoteOptions | None = None) -> Note:
    """Return the calculation note of a machine.

    Parameters
    ----------
    results : Results
        Of an engine, a linkage, or a table of transfer functions.
    options : NoteOptions
        Language, title and what else may be chosen.

    Returns
    -------
    Note
        Its blocks in order, ready for a writer.
    """
    # the words of one kind of machine are not loaded for the other
    kind = "engine" if isinstance(results.machine, Machine) else "linkage"
    contents = importlib.import_module(f"crankwork.note.{kind}_note")
    note: Note = getattr(contents, f"{kind}_note")(results, options or NoteOptions())
    return note
