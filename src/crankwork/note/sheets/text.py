"""Words on a sheet: entries in rows."""

from __future__ import annotations

from functools import partial

from crankwork.note.sheets.packing import flowed
from crankwork.quantities import Language
from crankwork.show.paper import Paper, fitted_lines, text_width
from crankwork.show.place import here
from crankwork.show.scene import Drawing


def text_block(entries: list[str], title: str, language: Language) -> Drawing:
    """Return entries in rows, as many as fit beside each other."""
    size, row = 8.5, 14.0
    # letters of a reader may be wider
    width = 0.82 * here().width
    rows = [
        line
        for one in flowed(entries, ";   ", width, partial(text_width, size=size))
        for line in fitted_lines(one, size, width)
    ]
    hand = Paper(here().width, row * len(rows))
    for at, text in enumerate(rows):
        hand.text(0.0, row * (at + 0.7), text, size=size)
    return hand.drawing(title, language)
