"""The section that puts the values of a machine beside those by other methods, or of another machine."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis import Results
from crankwork.note.document import Block, Heading, Reference, Runs, Table
from crankwork.note.printed_units import printed_unit
from crankwork.note.table_width import SIZES, fits
from crankwork.note.words import NoteWords
from crankwork.report.comparison import comparison_rows, shown_names
from crankwork.report.language import key_unit, label, told_as

_LABEL = "compared"
_DIGITS = 3


def comparison_blocks(
    results: Results, words: NoteWords, heading: Heading, caption: str, *, per_area: bool = False
) -> Iterator[Block]:
    """Yield the heading and the single values by each name; nothing where nothing is compared."""
    compared = results.compared
    if compared is None:
        return
    yield heading
    own, *others = shown_names(compared, words.language)
    key = "compared_methods" if compared.is_of_methods else "compared_machines"
    yield words.paragraph(key, table=Reference(_LABEL), own=own)
    titles: list[Runs] = [(words.column("quantity"),), (words.column("unit"),), (own,)]
    for other in others:
        titles += [(other,), ("Δ",)]
    rows = [
        (
            label(told_as(key, results) if key in results.memory else key, words.language),
            printed_unit(key_unit(key, per_area=per_area), words.language) or "–",
            words.number(values[0]),
            # after the own value come another and how far it is above it
            *(words.number(one, digits=_DIGITS if at % 2 else 6) for at, one in enumerate(values[1:])),
        )
        for key, values in comparison_rows(results, per_area=per_area).items()
        if not key.partition(".")[0].endswith(("_max_angle", "_min_angle", "_max_time", "_min_time"))
    ]
    align = "lc" + "r" * (len(titles) - 2)
    yield Table(caption, tuple(titles), rows, wide=not fits(titles, rows, SIZES[-1]), align=align, label=_LABEL)
