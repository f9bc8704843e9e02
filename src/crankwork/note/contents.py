"""What a note says, by the kind of machine."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import TYPE_CHECKING, Any

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


def sheets_of(results: Results, options: NoteOptions | None = None) -> dict[str, bytes]:
    """Return the drawing sheets of a machine in every format, by the ending of their files.

    Parameters
    ----------
    results : Results
        Of an engine, a linkage, or a table of transfer functions.
    options : NoteOptions
        Language and author; sheets of the Russian school have a title block.

    Returns
    -------
    dict of str to bytes
        `-sheet-1.pdf`, `-sheet-1.svg`, `-sheet-1.dxf`, `-sheet-2.pdf` and so on.

    Raises
    ------
    MissingExtraError
        If Typst or ezdxf is not installed.
    """
    options = options or NoteOptions()
    kind = "engine" if isinstance(results.machine, Machine) else "linkage"
    sheet, title_block = _sheets("sheet"), _sheets("title_block")
    block = title_block.TitleBlock(drawn_by=options.author) if options.order == "ru" else None
    more: dict[str, Any] = {}
    if kind == "engine":
        # sheets say what the note says, which takes a crank gear of its own as an engine of one cylinder
        results = importlib.import_module("crankwork.note.engine_material").whole(results, options.order)
        known = _sheets("engine_whole").whole_engine_extra(results)
        more = {"per_area": options.per_area, "extra": known}
    drawn = getattr(_sheets(kind), f"{kind}_sheets")(results, options.language, paper=sheet.Paper(block=block), **more)
    return {
        f"-sheet-{number}.{ending}": getattr(_sheets(ending), f"sheet_{ending}")(one)
        for number, one in enumerate(drawn, start=1)
        for ending in ("pdf", "svg", "dxf")
    }


def _sheets(module: str) -> ModuleType:
    return importlib.import_module(f"crankwork.note.sheets.{module}")
