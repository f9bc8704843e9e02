"""Tables of the note of an engine, and equations with what their symbols stand for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from crankwork.note.document import Cell, Math, Runs, Table
from crankwork.note.engine_material import Material
from crankwork.note.printed_units import printed_unit
from crankwork.note.table_width import SIZES, fits
from crankwork.note.words import EngineWords
from crankwork.report.language import displayed, key_unit, label, row_name

# rows that fit on a page, and parts and columns of a table that stand side by side
_LONG, _MOST_PARTS, _MOST = 24, 3, 10
_TURN = 360.0


def angle_table(material: Material, caption: str, keys: Iterable[str], *, one_turn: bool = False) -> Table | None:
    """Return a table over the crank angle; parts of a long narrow one stand side by side."""
    table = long_table(material, caption, keys, one_turn=one_turn)
    return None if table is None else folded(table)


def long_table(
    material: Material,
    caption: str,
    keys: Iterable[str],
    *,
    one_turn: bool = False,
    decimals: Mapping[str, int] | None = None,
) -> Table | None:
    """Return a table over the crank angle with one row for each."""
    words, degrees = material.words, material.results.grid.degrees
    present = [key for key in keys if key in material.columns]
    if not present:
        return None
    rows = degrees <= _TURN if one_turn else np.full(len(degrees), fill_value=True)
    columns = [((words.titled("crank_angle")), [words.number(float(angle)) for angle in degrees[rows]])]
    for key in present:
        texts = words.column_texts(material.columns[key][rows].tolist(), decimals=(decimals or {}).get(key))
        columns.append((words.titled(key), texts))
    return column_table(caption, columns, words)


def folded(table: Table) -> Table:
    """Return a long narrow table with its parts side by side; any other as it is."""
    count, rows = len(table.headings), list(table.rows)
    parts = min(_MOST // count, _MOST_PARTS)
    if len(rows) <= _LONG or parts == 1 or not parts:
        return table
    height = -(-len(rows) // parts)
    filled = rows + [("",) * count] * (height * parts - len(rows))
    side_by_side = zip(*(filled[part * height : (part + 1) * height] for part in range(parts)), strict=True)
    joined = [tuple(entry for row in joined_rows for entry in row) for joined_rows in side_by_side]
    return replace(table, headings=table.headings * parts, rows=joined, align=table.align * parts)


def column_table(caption: str, columns: Sequence[tuple[Runs, Sequence[Cell]]], words: EngineWords) -> Table:
    """Return a table of finished columns."""
    rows = list(zip(*(entries for _, entries in columns), strict=True))
    headings = tuple(heading for heading, _ in columns)
    return Table(
        words.caption(caption),
        headings,
        rows,
        wide=not fits(headings, rows, SIZES[-1]),
        align="c" + "r" * (len(columns) - 1),
        label=f"t:{caption}",
    )


def listing_table(material: Material, name: str, caption: str) -> Table | None:
    """Return a table of results that does not run over the crank angle."""
    words, sheet = material.words, material.results.listings.get(name)
    if sheet is None:
        return None
    columns: list[tuple[Runs, Sequence[str]]] = []
    # a crank mechanism by itself has no known journals
    rows = [k for k, row_key in enumerate(sheet.names) if material.has_engine or not row_key.startswith("main_journal")]
    if sheet.names:
        columns.append(((words.column("row"),), [row_name(sheet.names[k], words.language) for k in rows]))
    for key, column in material.listings[name].items():
        values = column[rows] if sheet.names else column
        if sheet.names and not np.any(np.nan_to_num(values)):
            continue
        entries = [words.number(float(item)) for item in values] if not columns else words.column_texts(values.tolist())
        columns.append((words.titled(key), entries))
    table = column_table(caption, columns, words)
    return replace(table, align=("l" if sheet.names else "c") + table.align[1:])


def value_table(caption: str, rows: Iterable[tuple[Cell, ...]], words: EngineWords) -> Table:
    """Return a table of single values: name, symbol, value, unit, and the crank angle where there is a fifth entry."""
    entries = list(rows)
    titles: list[str | Runs] = ["quantity", "symbol", "value", "unit"]
    if any(len(row) > len(titles) for row in entries):
        titles.append((words.column("at") + " ", Math(words.symbol("crank_angle"))))
    return words.table(caption, titles, entries, "lcrcr"[: len(titles)], f"t:{caption}")


def value_row(key: str, value: float, words: EngineWords, *, area: float | None = None) -> tuple[Cell, ...]:
    """Return name, symbol, value and unit of a single value."""
    return (
        label(key, words.language),
        Math(words.symbol(key)),
        words.number(displayed(key, value, per_area=area)),
        printed_unit(key_unit(key, per_area=area is not None), words.language) or "–",
    )
