"""Lists of a machine file that refer to columns of a table file: replaced before values are read."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any, NamedTuple

from crankwork.description.schema import ListOf, MapOf, NumberOr, TableSpec
from crankwork.description.table_file import FileTable, read_table
from crankwork.description.value_types import Quantity, Reader, ValueType
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage
from crankwork.units import EXAMPLES, UNITS, known_unit

_REFERENCE = {"column", "unit"}


class _Place(NamedTuple):
    """A key whose value names a column: its table, the type of its entries, and its path."""

    holder: dict[str, Any]
    name: str
    entry: ValueType
    path: str


def resolve_file_columns(values: dict[str, Any], keys: TableSpec, reader: Reader) -> dict[str, Any]:
    """Return values with names of columns replaced by their numbers; report missing columns."""
    if not any(path for path, _, _ in _tables("", values, keys)):
        return values
    values = copy.deepcopy(values)
    for path, table, kind in _tables("", values, keys):
        file = table["file"]
        places = list(_places(path, table, kind))
        if not places:
            example = next(name for name, key in kind.keys.items() if _takes_columns(key.kind))
            reader.add_error(f"{path}.file", ErrorMessage("file_unused", example=example))
        sheet = table["sheet"] if isinstance(table.get("sheet"), str) else None
        try:
            read = read_table(reader.folder / file, name=file, sheet=sheet) if places else None
        except CrankworkError as error:
            # consequences of an unreadable file are not reported
            reader.add_error(f"{path}.file", *error.args, meant=path)
            read = None
        reader.notices += [(code, dict(details)) for code, details in read.notices] if read else []
        for place in places if read else ():
            try:
                place.holder[place.name] = _column(read, place) if read else []
            except CrankworkError as error:
                reader.add_error(place.path, *error.args, meant=path)
                del place.holder[place.name]
    return values


def _tables(path: str, value: object, kind: object) -> Iterator[tuple[str, dict[str, Any], TableSpec]]:
    """Yield the tables that name a file for their columns."""
    match kind:
        case TableSpec(keys=keys) if isinstance(value, dict):
            if isinstance(value.get("file"), str) and any(_takes_columns(key.kind) for key in keys.values()):
                yield path, value, kind
            for name, key in keys.items():
                yield from _tables(f"{path}.{name}".lstrip("."), value.get(name), key.kind)
        case ListOf(entry=TableSpec() as entry) if isinstance(value, list):
            for number, item in enumerate(value, start=1):
                yield from _tables(f"{path}[{number}]", item, entry)


def _places(path: str, table: dict[str, Any], kind: TableSpec) -> Iterator[_Place]:
    """Yield the keys of a table, and of those in it, that name a column."""
    for name, key in kind.keys.items():
        value = table.get(name)
        match key.kind:
            case ListOf(entry=entry, from_file=True) if value is not None and not isinstance(value, list):
                yield _Place(table, name, entry, f"{path}.{name}")
            case MapOf(entry=TableSpec() as inner) if isinstance(value, dict):
                for own, table_value in value.items():
                    if isinstance(table_value, dict):
                        yield from _places(f"{path}.{name}.{own}", table_value, inner)


def _takes_columns(kind: object) -> bool:
    return isinstance(kind, ListOf) and kind.from_file


def _column(table: FileTable, place: _Place) -> list[Any]:
    """Return the numbers of a column, with the unit of the machine file or else of the table."""
    value = place.holder[place.name]
    stated = value if isinstance(value, dict) and set(value) <= _REFERENCE else {"column": value}
    column, unit = stated.get("column"), stated.get("unit", "")
    if not isinstance(column, str | int) or isinstance(column, bool) or not isinstance(unit, str):
        raise CrankworkError(ErrorMessage("column_form", key=place.name))
    position = table.position(column)
    numbers: list[float] = table.columns((position,))[:, 0].tolist()
    unit = (known_unit(unit) or unit) if unit else table.units[position]
    entry = place.entry
    if isinstance(entry, NumberOr):
        # a column without a unit that has no other numbers is one of shares
        entry = entry.quantity if unit or not 0.0 <= min(numbers) <= max(numbers) <= 1.0 else entry.number
    if not isinstance(entry, Quantity):
        return numbers
    if unit not in UNITS or UNITS[unit].dimension not in entry.dimensions:
        example = EXAMPLES[entry.dimensions[0]].split()[1]
        name = f'"{column}"' if isinstance(column, str) else str(column)
        raise table.refused("column_unit", column=table.label(position), key=place.name, name=name, unit=example)
    return [f"{number!r} {unit}" for number in numbers]
