"""A machine file as an object: values and numbers by dotted key, changed in the text itself; origins of inputs."""

from __future__ import annotations

import copy
import datetime as dt
import functools
import math
import numbers
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from crankwork import files, units
from crankwork.description.keys import OF_LINKAGE
from crankwork.description.machine_file import (
    Setting,
    apply_override,
    apply_settings,
    entry_at,
    file_keys,
    parse,
    read_machine,
    steps_of,
)
from crankwork.description.schema import ListOf, NameOr, NumberOr, TableSpec, Values, nearest_name, stated_numbers
from crankwork.description.toml_edit import document, locate, with_value, without_key
from crankwork.description.value_types import MeasuredValue, Number, Quantity, Reader
from crankwork.errors import CrankworkError, InputError, UnknownKeyError
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine

_DECIMAL = r"[0-9]+(?:[.,][0-9]+)?"
_FOLLOWING = re.compile(
    rf"(?:(?P<factor>-?{_DECIMAL})\s*[*·×]\s*)?(?P<key>[a-z][^\s*/+]*\.[^\s*/+]+)(?:\s*/\s*(?P<divisor>{_DECIMAL}))?"
)

_SAME = 1e-9
# keys that determine a key which the file does not state
_FOLLOWS = (
    (r"engine\.bank_angle|cylinder\.inclination", ("engine.bank_angle", "engine.bank_angles", "engine.layout")),
    (r"engine\.(throws|firing_order)", ("engine.firing_order", "engine.layout")),
    (r"(gas|gas\.motored|gas\.cylinders\.\d+|chambers\.[^.]+)\.points\..*", (r"\1.pieces",)),
    (r"gas\.motored\.points\..*", ("gas.motored",)),
    # a chamber with one face may state the keys of the face itself
    (r"(chambers\.[^.]+)\.faces\[1\]\.(\w+)", (r"\1.\2",)),
    # the second joint of a link lies at its length
    (r"(links\.[^.]+)\.points\..*\[1\]", (r"\1.length",)),
    (r"(links\..*\.length|branch\..*|(links|sliders)\..*\.(points|centre).*)", ("positions",)),
    (r"crank\.(radius|stroke)|cylinder\.bore", ("cycle.power",)),
    (r"cylinder\.compression_ratio", ("cycle.timing",)),
    *OF_LINKAGE,
)


class Description:
    r"""A machine file that can be read, changed and written again.

    Keys are those of `--set`: `rod.ratio`, `gas.pieces[2].exponent`. What is not changed stays as it is in the text.

    Parameters
    ----------
    text : str or mapping
        The machine file, or what it states, as nested mappings and lists.
    name : str
        What messages call it.
    folder : Path or None
        Where files named in it are looked for.

    Raises
    ------
    CrankworkError
        If the text is no TOML.

    Examples
    --------
    >>> d = Description('[rod]\nlength = "160 mm"  # between the pins\n')
    >>> d["rod.ratio"] = 0.3
    >>> d["rod.mass"] = "0.9 kg"
    >>> print(d.dump(), end="")
    [rod]
    ratio = 0.3  # between the pins
    mass = "0.9 kg"
    """

    def __init__(self, text: str | Mapping[str, Any], name: str = "text", *, folder: Path | None = None) -> None:
        text = text if isinstance(text, str) else document(text)
        self._text, self.name, self.folder = text, name, folder
        try:
            self._values = parse(text, name)
        except InputError:
            # tells the other mistakes too
            read_machine(text, name, folder=folder)
            raise

    def __getitem__(self, key: str) -> Any:  # noqa: ANN401 - what the file states
        """Return a value as the file states it, or its default as a file would; KeyError if there is neither."""
        value = stated_value(self._values, key)
        if value is None:
            raise UnknownKeyError(ErrorMessage("not_stated", key=key[:60]))
        return copy.deepcopy(value)

    def __iter__(self) -> Iterator[str]:
        """Yield the key of every value of the file, as spelled there."""
        return _keys(self._values)

    def keys(self) -> tuple[str, ...]:
        """Return the key of every value that the file states."""
        return tuple(self)

    def get(self, key: str, default: Any = None) -> Any:  # noqa: ANN401 - what the file states
        """Return a value as the file states it, or its default as a file would, or else `default`."""
        try:
            return self[key]
        except UnknownKeyError:
            return default

    def __contains__(self, key: str) -> bool:
        """Return whether the file states a key."""
        return functools.reduce(_at, steps_of(key), self._values) is not None

    def __setitem__(self, key: str, value: Any) -> None:  # noqa: ANN401 - what a file may state
        """Set a value: text with a unit, number or table; keys that exclude it are removed."""
        self.replace(changes={key: value})

    def __delitem__(self, key: str) -> None:
        """Take a key, or a table, out of the file."""
        if key not in self:
            raise UnknownKeyError(ErrorMessage("not_stated", key=key[:60]))
        self._text = without_key(self._text, key)
        self._values = parse(self._text, self.name)

    def replace(self, changes: Mapping[str, Any]) -> None:
        """Set several values at once: all, or none after an error."""
        text, values = self._text, copy.deepcopy(self._values)
        for key, value in ((key, _plain(key, value)) for key, value in changes.items()):
            gives_way = apply_override(values, Setting("key", key, value))
            text = with_value(text, key, value, gives_way)
            if parse(text, self.name) != values:
                # an entry of an array of tables, [[loads]], would get another type
                raise CrankworkError(ErrorMessage("entry_table", key=key[:60]))
        self._text, self._values = text, values

    def values_with(self, overrides: Sequence[str | Setting]) -> dict[str, Any]:
        """Return the values of the file with overrides applied, as nested tables and lists."""
        values = self.values
        apply_settings(values, overrides)
        return values

    @property
    def values(self) -> dict[str, Any]:
        """A copy of the values of the file, as nested tables and lists."""
        return copy.deepcopy(self._values)

    @property
    def is_readable(self) -> bool:
        """Whether all values have the types of their keys, even if the machine is incomplete."""
        reader = Reader.of(self._values)
        return file_keys(self._values).read(self.values, "", reader) is not None and not reader.problems

    def dump(self) -> str:
        """Return the text, with the comments of whoever wrote it."""
        return self._text

    def machine(self, overrides: Sequence[str | Setting] = ()) -> Machine:
        """Return the machine that the file describes, with settings `KEY=VALUE` applied.

        Raises
        ------
        InputError
            With every mistake, each on its line.
        """
        return read_machine(self._text, self.name, overrides, folder=self.folder)

    def __repr__(self) -> str:
        return f"<Description {self.name}: {', '.join(self._values)}>"


def load(path: str | Path) -> Description:
    """Return a machine file, to be changed or computed.

    Raises
    ------
    CrankworkError
        If the file cannot be read, or is no TOML.
    """
    path = Path(path)
    text = files.read_text(path, advice=ErrorMessage("check_path_or_new", path=path))
    return Description(text, str(path), folder=path.parent)


def stated_value(values: dict[str, Any], key: str) -> Any:  # noqa: ANN401 - what a file may state
    """Return a value as a file states it, or its default as a file would; None if there is neither."""
    *path, last = steps_of(key)
    table: Any = functools.reduce(_at, path, values)
    keys: object = file_keys(values)
    kind = functools.reduce(entry_at, path, keys)
    value = _at(table, last)
    if value is None and isinstance(kind, TableSpec) and isinstance(last, str):
        return kind.written_default(last, Values(table if isinstance(table, Mapping) else {}, kind))
    return value


def _at(table: Any, step: str | int) -> Any:  # noqa: ANN401 - what a file has there
    """Return an entry of a table or list, None if there is none."""
    if isinstance(step, int):
        return table[step - 1] if isinstance(table, list) and 0 < step <= len(table) else None
    return table.get(step) if isinstance(table, dict) else None


def _keys(values: Any, path: str = "") -> Iterator[str]:  # noqa: ANN401 - what a file states
    """Yield the dotted keys of all values in a table; a list of values is one value."""
    if isinstance(values, Mapping):
        for name, value in values.items():
            yield from _keys(value, f"{path}.{name}".lstrip("."))
    elif isinstance(values, list) and values and all(isinstance(entry, Mapping) for entry in values):
        for number, value in enumerate(values, start=1):
            yield from _keys(value, f"{path}[{number}]")
    else:
        yield path


def _plain(key: str, value: Any) -> Any:  # noqa: ANN401 - what a program may set
    """Return a value as a file holds it: text, number, list or table."""
    if isinstance(value, Mapping):
        return {str(name): _plain(key, item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(key, item) for item in value]
    if isinstance(value, str | bool | dt.date):
        return value if isinstance(value, str | bool) else str(value)
    if isinstance(value, numbers.Real) and math.isfinite(value):
        return int(value) if isinstance(value, numbers.Integral) else float(value)
    raise CrankworkError(ErrorMessage("value_kind", key=str(key)[:60]))


class Origin(NamedTuple):
    """Origin of a value: kind, key, and line or option.

    Kinds: stated on a `line`, set by an `option`, `follows_line` or `follows_option` from such a value, or `default`.
    """

    kind: str
    path: str
    line: str = ""


class _File:
    """A machine file with settings applied."""

    def __init__(self, source: str, name: str, overrides: Sequence[str | Setting]) -> None:
        self._values, self._lines = parse(source, name), locate(source)
        self._settings = apply_settings(self._values, overrides)
        self._keys = file_keys(self._values)
        self._stated = stated_numbers(self._keys.read(self._values, "", Reader.of(self._values)) or {})

    def origin(self, path: str, values: Iterable[float]) -> Origin:
        """Return the origin of a value that the calculation attributes to a path.

        `values`: the value in SI, and in the units in which a plain number may be stated.
        """
        values = tuple(values)
        for name in self._candidates(path):
            origin = self._origin_at(name)
            if origin is not None:
                return origin if self._is(name, values) else origin._replace(kind=f"follows_{origin.kind}")
        return Origin("default", path)

    def _candidates(self, path: str) -> Iterator[str]:
        """Yield the possible keys of a value: its path, equivalent keys, and keys that determine it."""
        yield path
        around, _, entry = path.rpartition("[")
        if around in self._lines and path not in self._lines:
            # a list read from a column of a file
            yield around
        named = self._raw(around)
        if isinstance(named, str):
            # a position may be the name of a fixed point
            yield f"fixed_points.{named}[{entry}"
        *tables, last = path.split(".")
        known: Any = self._keys
        for name in tables:
            known = known.keys[name].kind if isinstance(known, TableSpec) and name in known.keys else None
        if isinstance(known, TableSpec) and last in known.keys:
            yield from (".".join([*tables, other]) for other in known.keys[last].instead_of)
        parts = re.split(r"[.\[]", path)
        above = [path[: len(path) - len("".join(parts[-1:])) - 1]]
        yield from (table for table in above if not isinstance(self._raw(table), dict | None))
        for pattern, keys in _FOLLOWS:
            match = re.fullmatch(pattern, path)
            yield from (match.expand(key) for key in keys if match)

    def _origin_at(self, name: str) -> Origin | None:
        setting = next(
            (candidate for candidate in self._settings if re.match(rf"{re.escape(candidate.key)}($|[.\[])", name)), None
        )
        if setting is not None:
            return Origin("option", name, setting.option)
        return Origin("line", name, str(self._lines[name])) if name in self._lines else None

    def _is(self, name: str, values: tuple[float, ...]) -> bool:
        stated = self._stated.get(name)
        if stated is None:
            return False
        return any(
            math.isclose(stated.value, value, rel_tol=_SAME) for value in (values[:1] if stated.unit else values)
        )

    def _raw(self, path: str) -> Any:  # noqa: ANN401 - whatever a file holds
        """Return the raw value at a path, None if there is none."""
        return functools.reduce(_at, path.split("."), self._values)


def origins(path: str | Path, overrides: Sequence[str | Setting] = ()) -> Callable[[str, Iterable[float]], Origin]:
    """Return a function that maps an input path and its value to its origin: line, option or default.

    A value that differs from the stated one follows from it.
    """
    return origins_of(files.read_text(Path(path)), str(path), overrides)


def origins_of(
    source: str, name: str = "text", overrides: Sequence[str | Setting] = ()
) -> Callable[[str, Iterable[float]], Origin]:
    """Return `origins` of a text."""
    return _File(source, name, overrides).origin


class NumericField(NamedTuple):
    """A number of a machine file: key, limits in SI, unit as written, dimension and stated value in SI."""

    key: str
    low: float
    high: float
    unit: str = ""
    dimension: str = ""
    now: float | None = None

    def written(self, value: float) -> str | float:
        """Return a value as the file states it."""
        number = float(units.from_si(value, self.unit))
        return f"{number!r} {self.unit}" if self.unit else number

    def setting(self, value: float, option: str = "") -> Setting:
        """Return the setting of a value in SI; `option`: what messages name, by default the key."""
        return Setting(option or self.key, self.key, self.written(float(value)))


def kind_of(values: dict[str, Any], key: str) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the value type of a key of a machine file; the error does not name the key."""
    kind: Any = file_keys(values)
    for step in steps_of(key):
        around, kind = kind, entry_at(kind, step)
        if kind is None:
            raise UnknownKeyError(_unknown(key, around, step))
    return kind


def numeric_field(values: dict[str, Any], key: str, option: str = "--for") -> NumericField:
    """Return the number of a machine file that a key names; it must be continuous. `option`: what messages name."""
    place = f"{option} {key[:60]}".lstrip()
    try:
        kind = kind_of(values, key)
    except UnknownKeyError as error:
        mistake = error.args[0]
        message = ErrorMessage("option_wrong", option=place, mistake=mistake)
        raise UnknownKeyError(mistake if mistake.name == "key_form" else message) from None
    now = stated_value(values, key)
    kind, reader = single_kind(kind, now), Reader(decimal_comma=True)
    match kind:
        case Quantity(dimensions, low, high):
            read = None if now is None else kind.read(now, key, reader)
            unit = units.EXAMPLES[dimensions[0]].split()[1]
            if not isinstance(read, MeasuredValue):
                return NumericField(key, low, high, unit, dimensions[0])
            return NumericField(key, low, high, read.unit or unit, read.dimension, read.value)
        case Number(low, high, whole=False):
            return NumericField(key, low, high, now=None if now is None else kind.read(now, key, reader))
        case Number():
            raise CrankworkError(ErrorMessage("sought_counts", place=place, key=key))
    raise CrankworkError(ErrorMessage("sought_no_number", place=place))


def single_kind(kind: Any, now: object) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the type of a number in a field that also allows something else."""
    if isinstance(kind, ListOf) and kind.may_be_one and isinstance(now, str):
        kind = kind.entry
    if isinstance(kind, NumberOr):
        kind = kind.kind_of(now)
    return kind.other if isinstance(kind, NameOr) else kind


def _unknown(key: str, around: object, step: str | int) -> ErrorMessage:
    """Return the error of a key that no file has."""
    if isinstance(around, TableSpec) and isinstance(step, str):
        nearest = nearest_name(step, tuple(around.keys))
        message = ErrorMessage("unknown_key_near", nearest=nearest) if nearest else None
        return message or ErrorMessage("unknown_key", known=", ".join(around.keys))
    return ErrorMessage("key_form", key=key[:60])


def follows_another(value: object) -> bool:
    """Return whether a setting may say that a number follows another one: `3.5 * crank.radius`."""
    return isinstance(value, str) and bool(_FOLLOWING.fullmatch(value))


def following(values: dict[str, Any], key: str, value: str) -> str | float:
    """Return what a number that follows another one amounts to; a text that names no number of the file as it is."""
    match: Any = _FOLLOWING.fullmatch(value)
    try:
        field = numeric_field(values, key)
        other = numeric_field(values, match["key"], f"{key} = {value[:60]}:")
    except CrankworkError:
        if match["key"] == value:
            # a name, such as that of a file
            return value
        raise
    if other.now is None:
        raise CrankworkError(ErrorMessage("following_nothing", key=key, other=other.key))
    if field.dimension != other.dimension:
        raise CrankworkError(ErrorMessage("following_kind", key=key, other=other.key))
    factor = float((match["factor"] or "1").replace(",", ".")) / float((match["divisor"] or "1").replace(",", "."))
    return field.written(factor * other.now)
