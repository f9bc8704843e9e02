"""Lists of a machine file that stand in the columns of a table: put in their place before anything is read."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from crankwork.description.kinds import Kind, Quantity, Reader
from crankwork.description.schema import ListOf, Named, Table
from crankwork.description.table_file import FileTable, read_table
from crankwork.errors import CrankworkError
from crankwork.locale import Refusal
from crankwork.units import EXAMPLES, UNITS

_REFERENCE = {"column", "unit"}


class _Place(NamedTuple):
    """A key whose value names a column: the table that holds it, what it is, and its path."""

    holder: dict[str, Any]
    name: str
    entry: Kind
    path: str


def with_columns(values: dict[str, Any], keys: Table, reader: Reader, folder: Path) -> dict[str, Any]:
    """Return values with the numbers of a file where they name its columns; complain of what is not there."""
    if not any(path for path, _, _ in _tables("", values, keys)):
        return values
    values = copy.deepcopy(values)
    for path, table, kind in _tables("", values, keys):
        file = table["file"]
        places = list(_places(path, table, kind))
        if not places:
            reader.complain(f"{path}.file", Refusal("file_unused", example=_example(kind)))
        try:
            read = read_table(folder / file, name=file, sheet=_sheet(table)) if places else None
        except CrankworkError as error:
            # what follows from a file that is none is not told
            reader.complain(f"{path}.file", error.args[0], meant=path)
            read = None
        for one in places if read else ():
            try:
                one.holder[one.name] = _column(read, one) if read else []
            except CrankworkError as error:
                reader.complain(one.path, error.args[0], meant=path)
                del one.holder[one.name]
    return values


def _tables(path: str, value: object, kind: object) -> Iterator[tuple[str, dict[str, Any], Table]]:
    """Yield the tables that name a file for their columns."""
    match kind:
        case Table(keys=keys) if isinstance(value, dict):
            if isinstance(value.get("file"), str) and any(_takes_columns(one.kind) for one in keys.values()):
                yield path, value, kind
            for name, one in keys.items():
                yield from _tables(f"{path}.{name}".lstrip("."), value.get(name), one.kind)
        case ListOf(entry=Table() as entry) if isinstance(value, list):
            for number, one in enumerate(value, start=1):
                yield from _tables(f"{path}[{number}]", one, entry)


def _places(path: str, table: dict[str, Any], kind: Table) -> Iterator[_Place]:
    """Yield the keys of a table, and of those in it, that name a column."""
    for name, key in kind.keys.items():
        value = table.get(name)
        match key.kind:
            case ListOf(entry=entry, from_file=True) if value is not None and not isinstance(value, list):
                yield _Place(table, name, entry, f"{path}.{name}")
            case Named(entry=Table() as inner) if isinstance(value, dict):
                for own, one in value.items():
                    if isinstance(one, dict):
                        yield from _places(f"{path}.{name}.{own}", one, inner)


def _sheet(table: dict[str, Any]) -> str | None:
    sheet = table.get("sheet")
    return sheet if isinstance(sheet, str) else None


def _takes_columns(kind: object) -> bool:
    return isinstance(kind, ListOf) and kind.from_file


def _example(kind: Table) -> str:
    return next(name for name, one in kind.keys.items() if _takes_columns(one.kind))


def _column(table: FileTable, place: _Place) -> list[Any]:
    """Return the numbers of a column, with the unit that is stated or that the file gives it."""
    value = place.holder[place.name]
    stated = value if isinstance(value, dict) and set(value) <= _REFERENCE else {"column": value}
    column, unit = stated.get("column"), stated.get("unit", "")
    if not isinstance(column, str | int) or isinstance(column, bool) or not isinstance(unit, str):
        raise CrankworkError(Refusal("column_form", key=place.name))
    at = table.position(column)
    numbers: list[float] = table.columns((at,))[:, 0].tolist()
    if not isinstance(place.entry, Quantity):
        return numbers
    unit = unit or table.units[at]
    if unit not in UNITS or UNITS[unit].dimension not in place.entry.dimensions:
        example = EXAMPLES[place.entry.dimensions[0]].split()[1]
        name = f'"{column}"' if isinstance(column, str) else str(column)
        raise table.refused("column_unit", column=table.told(at), key=place.name, name=name, unit=example)
    return [f"{one!r} {unit}" for one in numbers]
