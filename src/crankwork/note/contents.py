"""What a note says, by the kind of machine."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import TYPE_CHECKING

from crankwork.machine import Machine
from crankwork.note.options import NoteOptions

if TYPE_CHECKING:
    from crankwork.analysis import Results
    from crankwork.kinematics.crank_grid import Array
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
    more = {"per_area": options.per_area, "extra": _whole_engine(results)} if kind == "engine" else {}
    drawn = getattr(_sheets(kind), f"{kind}_sheets")(results, options.language, paper=sheet.Paper(block=block), **more)
    return {
        f"-sheet-{number}.{ending}": getattr(_sheets(ending), f"sheet_{ending}")(one)
        for number, one in enumerate(drawn, start=1)
        for ending in ("pdf", "svg", "dxf")
    }


def _whole_engine(results: Results) -> dict[str, Array | float]:
    """Return what the sheets of an engine show of all its cylinders and of the first crankpin, as far as known."""
    columns, wear = results.columns, results.listings.get("crankpin_wear")
    found: dict[str, Array | float] = {"crank_angle": results.grid.angle}
    for key, own in (("total_torque", "total_torque"), ("crankpin_load", "crankpin_load.1")):
        if own in columns:
            found[key] = columns[own]
    if "mean_total_torque" in results.summary and "total_torque" in found:
        found["total_torque_mean"] = results.summary["mean_total_torque"]
    if wear is not None and "wear_sum.1" in wear.columns:
        found |= {"wear_sums": wear.columns["wear_sum.1"], "wear_angle": wear.columns["wear_ray_angle"]}
    return found


def _sheets(module: str) -> ModuleType:
    return importlib.import_module(f"crankwork.note.sheets.{module}")
