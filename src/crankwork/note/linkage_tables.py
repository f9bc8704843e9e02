"""Tables over positions of the crank, divided where they have too many columns, and equations with their legends."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from crankwork.analysis import Array
from crankwork.formula.lines import Line
from crankwork.note.document import Equation, Runs, Table
from crankwork.note.words import NoteWords, Words, in_display_unit
from crankwork.quantities import QUANTITIES, base_key

# columns of numbers beside position and crank angle that fit on a page
_MOST = 9


class Column:
    """A column of a table: heading and finished entries."""

    def __init__(self, heading: Runs, entries: Sequence[str]) -> None:
        self.heading = heading
        self.entries = entries


def quantity_column(key: str, values: Array, words: Words) -> Column:
    """Return a column of a quantity in its unit.

    `key`: key of the quantity, `joint_force.A` for what belongs to a point or link.
    """
    return Column(words.titled(key), words.column_texts(in_display_unit(key, values.tolist()), digits=4))


def quantity_columns(keys: Iterable[str], columns: Mapping[str, Array], words: Words) -> list[Column]:
    """Return columns of quantities, four digits for the largest value of each."""
    return [quantity_column(key, columns[key], words) for key in keys]


def position_tables(
    caption: str,
    degrees: Array,
    columns: Sequence[Column],
    words: Words,
    *,
    first: int | None = 0,
    label: str = "",
) -> Iterator[Table]:
    """Yield a table over the positions of the crank, in parts if it has too many columns.

    Positions are numbered from `first`, if it is given.
    """
    if not columns:
        return
    count = len(degrees)
    places = [words.place(float(angle)) for angle in degrees]
    heading: Runs = (places[0][0], ", °") if places[0][2] == "deg" else words.titled("time")
    before = [Column(heading, [words.number(value) for _, value, _ in places])]
    if first is not None:
        before.insert(0, Column((words.column("position"),), [str(first + k) for k in range(count)]))
    for part, columns_of_part in enumerate(_parts(columns), start=1):
        shown = [*before, *columns_of_part]
        rows = list(zip(*(column.entries for column in shown), strict=True))
        yield Table(
            words.caption(caption) if part == 1 else "",
            tuple(column.heading for column in shown),
            rows,
            align="c" * len(before) + "r" * len(columns_of_part),
            label=label if part == 1 else "",
        )


def _parts(columns: Sequence[Column]) -> Iterator[Sequence[Column]]:
    """Yield columns that fit on a page, about as many on each."""
    count = -(-len(columns) // _MOST)
    each = -(-len(columns) // count)
    for start in range(0, len(columns), each):
        yield columns[start : start + each]


def equations(steps: Iterable[Line], words: NoteWords, *, marks: Mapping[str, str] | None = None) -> Iterator[Equation]:
    """Yield equations of lines."""
    for step in steps:
        yield Equation(step, symbol=_mark(step.key, words, marks))


def _mark(key: str, words: NoteWords, marks: Mapping[str, str] | None) -> str:
    return (marks or {}).get(key) or (words.symbol(key) if base_key(key) in QUANTITIES else key)
