"""Tables of notes: over the crank angle, over positions, of rows that are things, of single values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array
from crankwork.analysis.results import Listing
from crankwork.locale import has_text
from crankwork.note.captions import printed_unit
from crankwork.note.document import Block, Cell, Math, Run, Runs, Strong, Table
from crankwork.note.material import Material
from crankwork.note.table_width import PAGE, SIZES, fits, one_line_widths
from crankwork.note.wording import Words
from crankwork.report.display import displayed, key_unit, label, link_label, row_name

# rows that fit on a page, and parts and columns of a table that stand side by side
_LONG, _MOST_PARTS, _MOST_COLUMNS = 24, 3, 10
# columns of numbers that fit on a page together with position and crank angle
_MOST = 9
# angles that are the same [deg], and what is rounding, as a share of the largest value of a column
_NEAR = 1e-9
_NOISE = 1e-9
# how much wider than a page the lines of a table in parts may be
_ABOUT = 1.2
# rows and steps of a short table
_FEW, _STEPS = 13, 12


class Column(NamedTuple):
    """A column of a table: heading and finished entries."""

    heading: Runs
    entries: Sequence[Cell]


def quantity_column(
    material: Material, key: str, values: Array, *, digits: int | None = None, decimals: int | None = None
) -> Column:
    """Return a column of a quantity, whose values are in SI, in its unit."""
    words, shown = material.words, material.shown(key, values).tolist()
    return Column(words.titled(key), words.column_texts(shown, digits=digits, decimals=decimals))


def quantity_columns(
    material: Material, keys: Iterable[str], columns: Mapping[str, Array], decimals: Mapping[str, int] | None = None
) -> list[Column]:
    """Return columns of quantities; of a crank gear one less digit where another of the same unit has fewer decimals.

    `decimals`: of some columns, as they are stated.
    """
    words, chosen, fewest = material.words, dict(decimals or {}), dict[str, int]()
    shown: dict[str, list[float]] = {key: material.shown(key, columns[key]).tolist() for key in keys}
    needed = {key: words.decimals(values) for key, values in shown.items()}
    for key, count in needed.items():
        fewest[words.unit(key)] = min(count, fewest.get(words.unit(key), count))
    for key, count in needed.items():
        # plans of linkages are drawn from all digits
        if material.has_piston and fewest[words.unit(key)] < count <= 2 * words.digits:
            chosen.setdefault(key, count - 1)
    return [
        Column(words.titled(key), words.column_texts(values, decimals=chosen.get(key))) for key, values in shown.items()
    ]


def angle_table(material: Material, caption: str, keys: Iterable[str], *, until: float = math.inf) -> Table | None:
    """Return a table over the crank angle; parts of a long narrow one stand side by side."""
    table = long_table(material, caption, keys, until=until)
    return None if table is None else folded(table)


def long_table(
    material: Material,
    caption: str,
    keys: Iterable[str],
    *,
    until: float = math.inf,
    decimals: Mapping[str, int] | None = None,
) -> Table | None:
    """Return a table over the crank angle with one row for each, to the angle `until` [deg]."""
    words, degrees = material.words, material.results.grid.degrees
    known = [key for key in keys if key in material.columns]
    worked = np.abs(degrees - _worked(material, known, until)) < _NEAR
    rows = short_rows(material, until=until) | (worked & (degrees <= until + _NEAR))
    columns = quantity_columns(material, known, {key: material.columns[key][rows] for key in known}, decimals)
    if not columns:
        return None
    angles = [words.number(float(angle)) for angle in degrees[rows]]
    table = column_table(caption, [Column(words.titled("crank_angle"), angles), *columns], words)
    marked = worked[rows].tolist()
    return replace(
        table, rows=[tuple(map(Strong, row)) if mark else row for mark, row in zip(marked, table.rows, strict=True)]
    )


def _worked(material: Material, keys: Sequence[str], until: float) -> float:
    """Return the angle at which the note works most of some columns, none that it works: no number. [deg]"""
    shares = [
        (len({line.key for line in group.lines} & {*keys}), group.degrees)
        for group in material.groups.values()
        if group.degrees is not None
    ]
    share, worked = max(shares, default=(0, math.nan))
    if not share:
        return math.nan
    # what repeats is worked at one of its repetitions
    return worked if math.isinf(until) else worked % until


def short_rows(material: Material, *, until: float = math.inf) -> NDArray[np.bool]:
    """Return which rows a table over the crank angle has in this note, without that of the angle that is worked."""
    degrees = material.results.grid.degrees
    rows = degrees <= until + _NEAR
    if material.full or rows.sum() <= _FEW:
        return rows
    coarse = rows & _in_steps(degrees, float(degrees[rows][-1]))
    return coarse if coarse.any() else rows


def _in_steps(degrees: Array, end: float) -> NDArray[np.bool]:
    """Return which angles stand in a short table: whole twelfths of all."""
    steps = _STEPS * degrees / end
    return np.isclose(steps, np.round(steps), atol=1e-9)


def folded(table: Table, most: int = _MOST_PARTS, long: int = _LONG) -> Table:
    """Return a table of more than `long` rows with its parts side by side if it is narrow; any other as it is."""
    count, rows = len(table.headings), list(table.rows)
    parts = min(_MOST_COLUMNS // count, most)
    if len(rows) <= long or parts == 1 or not parts:
        return table
    height = -(-len(rows) // parts)
    filled = rows + [("",) * count] * (height * parts - len(rows))
    side_by_side = zip(*(filled[part * height : (part + 1) * height] for part in range(parts)), strict=True)
    joined = [tuple(entry for row in joined_rows for entry in row) for joined_rows in side_by_side]
    return replace(table, headings=table.headings * parts, rows=joined, align=table.align * parts)


def column_table(caption: str, columns: Sequence[Column], words: Words, first: str = "c") -> Table:
    """Return a table of finished columns; `first`: how the first one is aligned."""
    headings = tuple(column.heading for column in columns)
    rows = list(zip(*(column.entries for column in columns), strict=True))
    table = words.table(caption, headings, rows, first + "r" * (len(columns) - 1), f"t:{caption}")
    return replace(table, wide=not fits(headings, rows, SIZES[-1]))


def listing_table(material: Material, name: str, caption: str) -> Table | None:
    """Return a table of results that does not run over the crank angle."""
    words, listing = material.words, material.results.listings.get(name)
    if listing is None:
        return None
    columns: list[Column] = []
    # a crank mechanism by itself has no known journals
    hidden = "" if material.has_engine else "main_journal"
    rows = [k for k, row in enumerate(listing.names) if not (hidden and row.startswith(hidden))]
    if not material.full:
        # a row of nothing but rounding is left to the full note
        sizes = [np.abs(np.nan_to_num(values)) for values in listing.columns.values() if values.dtype.kind == "f"]
        seen = [k for k in rows if any(size[k] > _NOISE * size.max() for size in sizes)]
        rows = [
            k for n, k in enumerate(seen) if not any(_are_equal_rows(listing, k, other) for other in seen[:n])
        ] or rows
    if listing.names:
        columns.append(Column((words.column("row"),), [_row_text(listing.names[k], words) for k in rows]))
    shown, own = list[str](), dict[str, Array]()
    for key, values in listing.columns.items():
        if not columns and not own:
            shown.append(key)
            entries = [words.number(value) for value in material.shown(key, values).tolist()]
            columns.append(Column(words.titled(key), entries))
        elif not (listing.names and material.has_piston) or np.any(np.nan_to_num(values[rows])):
            own[key] = values[rows] if listing.names else values
            shown.append(key)
    columns += quantity_columns(material, own, own)
    symbols = {words.symbol(key): label(key, words.language) for key in shown}
    symbols.pop(words.symbol("crank_angle"), None)
    explained = tuple(symbols.items())
    return replace(column_table(caption, columns, words, "l" if listing.names else "c"), defined=explained)


def _are_equal_rows(listing: Listing, row: int, other: int) -> bool:
    """Return whether two rows of a table of results have the same numbers."""
    columns = (values for values in listing.columns.values() if values.dtype.kind == "f")
    return bool(listing.names) and all(np.isclose(values[row], values[other], equal_nan=True) for values in columns)


def _row_text(name: str, words: Words) -> str:
    """Return what a row of a listing is called; joints have names of their own."""
    if has_text(f"report.{name.partition('.')[0]}"):
        return row_name(name, words.language)
    return link_label(name, words.language).replace("_", " ")


def value_table(caption: str, rows: Iterable[tuple[Cell, ...]], words: Words, parts: int = 2) -> Table:
    """Return a table of single values: name, symbol, value, unit, and the crank angle where there is a fifth entry.

    `parts`: how many of its parts stand side by side where it is long.
    """
    entries = list(rows)
    titles: list[str | Runs] = ["quantity", "symbol", "value", "unit"]
    if all(row[len(titles) :] in ((), ("–",)) for row in entries):
        entries = [row[: len(titles)] for row in entries]
    if any(len(row) > len(titles) for row in entries):
        titles.append((words.column("at") + " ", words.place(0.0)[0]))
    table = words.table(caption, titles, entries, "lcrcr"[: len(titles)], f"t:{caption}")
    halves = folded(table, parts, _FEW)
    # names in many short lines beside each other take more room than below each other
    return halves if one_line_widths(halves.headings, halves.rows, SIZES[-1], _ABOUT * PAGE) else table


def symbol_table(meanings: Sequence[tuple[Cell, str]], words: Words) -> Table:
    """Return the meanings of symbols."""
    table = words.table("nomenclature", ("symbol", "meaning"), meanings, "ll", "t:nomenclature")
    return folded(table, most=2, long=_FEW)


def value_row(key: str, value: float, words: Words, *, area: float | None = None, digits: int = 6) -> tuple[Cell, ...]:
    """Return name, symbol, value and unit of a single value; a name may end in the unit of what is stored in it."""
    name, celsius, _ = label(key, words.language).partition(", °C")
    return (
        name,
        Math(words.symbol(key)),
        words.number(displayed(key, value, per_area=area), digits=min(digits, words.digits) if area else digits),
        celsius.removeprefix(", ") or printed_unit(key_unit(key, per_area=area is not None), words.language) or "–",
    )


def tabulated(
    material: Material, caption: str, keys: Iterable[str] | Sequence[Column], label: str = ""
) -> Iterator[Table]:
    """Yield a table over the numbered positions of columns, finished or by their keys."""
    known = {item: material.columns[item] for item in keys if isinstance(item, str)}
    made = dict(zip(known, quantity_columns(material, known, known), strict=True))
    columns = [made[item] if isinstance(item, str) else item for item in keys]
    tables = position_tables(caption, material.positions, columns, material.words, first=material.first, label=label)
    # a narrow one takes half the height
    return tables if material.full else map(partial(folded, most=2, long=_STEPS), tables)


def distinct_columns(material: Material, keys: Sequence[str]) -> tuple[list[str], list[Block]]:
    """Return the columns that neither are constant nor repeat another one, and the sentence that says what does."""
    words, kept, equal = material.words, list[str](), dict[str, list[Run]]()
    for key in () if material.full else keys:
        values = material.columns[key]
        limit = _NOISE * float(np.max(np.abs(values), initial=0.0))
        comparable = [other for other in kept if key_unit(other) == key_unit(key)]
        first = next((other for other in comparable if np.allclose(values, material.columns[other], 0.0, limit)), "")
        if first:
            equal.setdefault(first, [Math(words.symbol(first))]).extend((" = ", Math(words.symbol(key))))
        elif np.allclose(values, values[0], 0.0, limit):
            value = words.shown(key, float(values[0]), digits=material.digits)
            equal[key] = [Math(words.symbol(key)), f" = {value}\u00a0{words.unit(key)}".rstrip()]
        else:
            kept.append(key)
    if not equal or not kept:
        return list(keys), []
    shown = [run for index, part in enumerate(equal.values()) for run in ([", "] if index else []) + part]
    return kept, [words.paragraph("same_columns", equal=tuple(shown))]


def position_tables(
    caption: str,
    degrees: Array,
    columns: Sequence[Column],
    words: Words,
    *,
    first: int | None = 0,
    label: str = "",
) -> Iterator[Table]:
    """Yield a table over positions of the crank, in parts if it has too many columns.

    Positions are numbered from `first`, if it is given.
    """
    if not columns:
        return
    places = [words.place(float(angle)) for angle in degrees]
    heading: Runs = (places[0][0], ", °") if places[0][2] == "deg" else words.titled("time")
    before = [Column(heading, [words.number(value) for _, value, _ in places])]
    if first is not None:
        before.insert(0, Column((words.column("position"),), [str(first + k) for k in range(len(degrees))]))
    # about as many on each page
    each = -(-len(columns) // -(-len(columns) // _MOST))
    for start in range(0, len(columns), each):
        shown = [*before, *columns[start : start + each]]
        headings = [column.heading for column in shown]
        rows = list(zip(*(column.entries for column in shown), strict=True))
        align = "c" * len(before) + "r" * (len(shown) - len(before))
        table = words.table(caption, headings, rows, align, label)
        yield table if start == 0 else replace(table, caption="", label="")
