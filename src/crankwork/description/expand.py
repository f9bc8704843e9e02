"""A machine file written out: its shorthand as tables of a linkage, with every default."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from crankwork.description.cylinder_keys import OWN_SIZES
from crankwork.description.document import Description, load
from crankwork.description.file_columns import resolve_file_columns
from crankwork.description.load_keys import LOADING
from crankwork.description.machine_file import file_keys, idle_keys, read, settings_of, with_first_sizes
from crankwork.description.schema import TableSpec, Values
from crankwork.description.shorthand import given_motion_tables, linkage_tables, linkage_values
from crankwork.description.toml_edit import TomlPositions, key_text, toml, with_value
from crankwork.description.value_types import Reader
from crankwork.locale import Language, translate
from crankwork.machine import Machine

# tables that may be left out because all of them has a default
_ALWAYS = ("method", "table")


def expanded(path: str | Path, overrides: Sequence[str] = (), language: Language = "en") -> str:
    """Return the text of a machine file with shorthand and defaults written out; these are marked by a comment."""
    read(path, overrides)
    description = load(path)
    for setting in settings_of(overrides):
        description[setting.key] = setting.value
    values, keys = description.values, file_keys(description.values)
    if "transfer" in keys.keys:
        columns = resolve_file_columns(values, keys, Reader.of(values, Path(path).parent))
        description = Description(_text(given_motion_tables(columns)), description.name)
    elif "rod" in keys.keys:
        description = Description(_text(linkage_tables(values, engine_of(description))), description.name)
    return _with_defaults(description, translate("check.by_default", language))


def linkage_of(description: Description) -> dict[str, Any]:
    """Return the values of the linkage that a crank mechanism or an engine is."""
    return linkage_values(description.values, engine_of(description))


def engine_of(description: Description) -> Machine:
    """Return the engine of a file, without loads, friction and motor."""
    # with these it may have sections of another note
    left_out = {*LOADING, "document"}
    alone = {key: value for key, value in with_first_sizes(description.values, Reader()).items() if key not in left_out}
    alone["crank"] = {"speed": "1 rad/s", **alone["crank"]}
    if "engine" in alone:
        alone["engine"] = {key: value for key, value in alone["engine"].items() if key not in OWN_SIZES}
    return Description(alone, description.name, folder=description.folder).machine()


def _text(tables: Iterable[tuple[str, Any]]) -> str:
    """Return keys and tables as the text of a file."""
    lines = list[str]()
    for key, value in tables:
        for table in value if isinstance(value, list) else [value]:
            if isinstance(table, Mapping):
                lines += ["", f"[[{key}]]" if isinstance(value, list) else f"[{key}]"]
                lines += (f"{key_text(name)} = {toml(item)}" for name, item in table.items())
            else:
                lines.append(f"{key} = {toml(table)}")
    return "\n".join([*lines, ""])


def _with_defaults(description: Description, mark: str) -> str:
    """Return the text with every default that applies, each on a line with a mark, or named behind its inline table."""
    keys, text = file_keys(description.values), description.dump()
    values = keys.read(description.values, "", Reader.of(description.values)) or Values({}, keys)
    for name in _ALWAYS:
        kind = keys.keys[name].kind if name in keys.keys else None
        if isinstance(kind, TableSpec) and name not in values:
            values[name] = Values({}, kind)
    sealed = {name for charge in values.get("charges", {}).values() for name in charge["chambers"]}
    idle = idle_keys(keys, values)
    for path, table in _stated_tables("", values):
        is_sealed = path.removeprefix("chambers.") in sealed
        for name in table.table.keys:
            written = table.table.written_default(name, table)
            if name in table or written is None or (is_sealed and name in ("pressures", "period", "pressure_factor")):
                continue
            key = f"{path}.{name}".lstrip(".")
            text = text if key in idle else _marked(with_value(text, key, written), key, mark)
    return text


def _stated_tables(path: str, value: Any) -> Iterator[tuple[str, Values]]:  # noqa: ANN401 - tables and lists
    """Yield the tables in values, with their keys."""
    match value:
        case Values():
            yield path, value
            for name, item in value.items():
                yield from _stated_tables(f"{path}.{name}".lstrip("."), item)
        case Mapping():
            for name, item in value.items():
                yield from _stated_tables(f"{path}.{name}", item)
        case list():
            for index, item in enumerate(value, start=1):
                yield from _stated_tables(f"{path}[{index}]", item)


def _marked(text: str, key: str, mark: str) -> str:
    """Return a text with a comment after the line of a key with its default."""
    places = TomlPositions(text)
    around, _, name = key.rpartition(".")
    end = text.find("\n", places.pairs[key].end)
    end = len(text) if end < 0 else end
    if around not in places.inner:
        return f"{text[:end]}  # {mark}{text[end:]}"
    start = text.rfind("\n", 0, places.pairs[key].start) + 1
    is_marked = f"{mark}: " in text[start:end].partition("#")[2]
    comment = f", {name}" if is_marked else f"; {mark}: {name}" if "#" in text[start:end] else f"  # {mark}: {name}"
    return f"{text[:end]}{comment}{text[end:]}"
