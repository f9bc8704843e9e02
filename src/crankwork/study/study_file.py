"""Reader of study files: the fields that vary, objectives and limits."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, get_args

from crankwork import files
from crankwork.analysis import Results, analyse
from crankwork.analysis.requested_values import with_requested
from crankwork.description.document import (
    Description,
    NumericField,
    kind_of,
    load,
    numeric_field,
    single_kind,
    stated_value,
)
from crankwork.description.machine_file import Setting, input_error, parse, schema_text
from crankwork.description.schema import KeySpec, MapOf, OneOrMore, TableSpec, Values
from crankwork.description.value_types import Choice, Flag, MeasuredValue, Number, Reader, Text, shown
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage, Language
from crankwork.study.search import SearchMethod
from crankwork.study.variants import check_single
from crankwork.study.varied_field import VariedField, level_of
from crankwork.units import System, use_units
from crankwork.version import __version__

# designs of which all are kept if the file does not say
_FEW = 100_000
# number of points of a Sobol sequence of 30 bits
MAX_DESIGNS = 2**30
_MAX_FIELDS, _MAX_VALUES = 40, 10_000
# depth of tables of a machine file
_MAX_DEPTH = 4
GRID, LIST, DRAWN = "grid", "list", ("random", "latin", "sobol", "saltelli")
_LIMITS = {"at_least": -math.inf, "at_most": math.inf}
_SIGNS = {"minimise": 1.0, "maximise": -1.0}


class Count(NamedTuple):
    """Type of the number of designs."""

    def read(self, value: object, key: str, reader: Reader) -> int | None:
        """Return the integer; add an error if it is out of range."""
        if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= MAX_DESIGNS:
            return value
        if isinstance(value, int) and not isinstance(value, bool) and value > MAX_DESIGNS:
            reader.add_error(key, _many(value))
        else:
            reader.add_error(key, ErrorMessage("whole_range", value=shown(value), low="1", high=str(MAX_DESIGNS)))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of the integer."""
        return {"type": "integer", "minimum": 1, "maximum": MAX_DESIGNS}


class As(NamedTuple):
    """A value read later by the type of the field or result that it concerns; here only JSON types, or a table."""

    types: tuple[str, ...]
    entry: TableSpec | None = None

    def read(self, value: object, _: str, __: Reader) -> object:
        """Return the value as stated."""
        return value

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of the allowed types."""
        own: dict[str, Any] = {"type": list(self.types)}
        return own if self.entry is None else {"anyOf": [own, self.entry.schema(language)]}


_VALUE = As(("string", "number"))
_RANGE = TableSpec("range", {
    "from": KeySpec(_VALUE, instead_of=("uniform",)),
    "to": KeySpec(_VALUE, instead_of=("uniform",)),
    "steps": KeySpec(Number(1, _MAX_VALUES, whole=True), only={"from": ()}),
    "spacing": KeySpec(Choice(("even", "ratios")), default="even", only={"from": ()}),
    "uniform": KeySpec(As(("string",)), instead_of=("from", "to")),
})  # fmt: skip
_DESIGNS = TableSpec("designs", {
    "drawing": KeySpec(Choice((GRID, LIST, *DRAWN)), required=True),
    "count": KeySpec(Count(), required=True, only={"drawing": DRAWN}),
    "seed": KeySpec(Number(0, 2**31, whole=True), default=0, only={"drawing": DRAWN}),
    "angles": KeySpec(Number(36, 72_000, whole=True)),
    "best": KeySpec(Number(1, 1000, whole=True), default=10),
    "rows": KeySpec(Flag()),
    "chunk": KeySpec(Number(1, 2**17, whole=True)),
})  # fmt: skip
_SEARCH = TableSpec("search", {
    "way": KeySpec(Choice(get_args(SearchMethod)), default="slsqp"),
    "starts": KeySpec(Number(1, 1000, whole=True)),
    "seed": KeySpec(Number(0, 2**31, whole=True), default=0),
})  # fmt: skip
_OF_VALUE = TableSpec("limits", {name: KeySpec(_VALUE) for name in _LIMITS})
_KEY = Text(80)
STUDY_FILE = TableSpec("study", {
    "title": KeySpec(Text()),
    "machine": KeySpec(Text(), required=True),
    "designs": KeySpec(_DESIGNS),
    "vary": KeySpec(MapOf(As(("array", "string"), _RANGE), _MAX_FIELDS, _MAX_DEPTH), required=True),
    "settings": KeySpec(MapOf(As(("array", "string", "number", "boolean")), _MAX_FIELDS, _MAX_DEPTH)),
    "objectives": KeySpec(MapOf(Choice(tuple(_SIGNS)), 8, _MAX_DEPTH)),
    "limits": KeySpec(MapOf(_OF_VALUE, _MAX_FIELDS, _MAX_DEPTH)),
    "values": KeySpec(OneOrMore(_KEY, most=100)),
    "search": KeySpec(_SEARCH),
})  # fmt: skip


@dataclass(frozen=True)
class Study:
    """Designs to calculate, with objectives and limits. [SI]

    `objectives`: 1 to minimise a value, -1 to maximise it; `limits`: lower and upper; `keys`: every value that is
    calculated; `angles`: number of evenly spaced ones, None for exact extremes and integrals; `stated`: values of the
    machine of the file; `search`: options of the search for the best design.
    """

    name: str
    title: str
    machine: Description
    overrides: tuple[str | Setting, ...]
    varied: tuple[VariedField, ...]
    drawing: str
    count: int
    seed: int
    angles: int | None
    chunk: int | None
    best: int
    has_rows: bool
    objectives: Mapping[str, float]
    limits: Mapping[str, tuple[float, float]]
    keys: tuple[str, ...]
    stated: Mapping[str, float]
    units: System
    search: Mapping[str, Any]
    text: str = field(repr=False)

    @property
    def identity(self) -> dict[str, Any]:
        """Digests and values that identify the study: its text, the machine, the program, the stated machine."""
        written = "\0".join([self.text, self.machine.dump(), *map(str, self.overrides)])
        values = {key: f"{value:.9g}" for key, value in self.stated.items()}
        return {
            "study": hashlib.sha256(self.text.encode()).hexdigest(),
            "machine": hashlib.sha256(written.encode("utf-8", "surrogatepass")).hexdigest(),
            "version": __version__,
            "stated": values,
        }

    @property
    def digest(self) -> str:
        """Digest of the identity."""
        return hashlib.sha256(json.dumps(self.identity, sort_keys=True).encode()).hexdigest()


def load_study(path: str | Path, overrides: Sequence[str | Setting] = (), *, is_search: bool = False) -> Study:
    """Return the study of a file; an `InputError` lists every mistake with its line.

    `is_search`: the study is a search for the best design between two ends of each field.
    """
    path = Path(path)
    return read_study(files.read_text(path), str(path), overrides, folder=path.parent, is_search=is_search)


def read_study(
    text: str,
    name: str,
    overrides: Sequence[str | Setting] = (),
    *,
    folder: Path | None = None,
    is_search: bool = False,
) -> Study:
    """Return the study of a text, as `load_study` does."""
    values = parse(text, name)
    reader = Reader()
    machine = _machine(values, reader, folder or Path())
    for setting in overrides:
        key = setting.partition("=")[0].strip() if isinstance(setting, str) else ""
        if key.split(".")[0] in STUDY_FILE.keys.keys() - {"title"}:
            raise CrankworkError(ErrorMessage("set_of_study", key=key))
    if machine is not None:
        overrides = [*_settings(values, machine, reader), *overrides]
        stated = machine.values_with(overrides)
        reader.decimal_comma = stated.get("decimal_mark") == ","
        values["vary"] = _flat_fields(values.get("vary"), stated)
    for table in ("objectives", "limits"):
        if table in values:
            values[table] = _flat(values[table], is_plain=table == "objectives")
    read = STUDY_FILE.read(values, "", reader) or Values({}, STUDY_FILE)
    if is_search:
        _check_search(read, reader)
    elif "designs" not in read and not reader.has_errors("designs"):
        reader.add_error("designs", ErrorMessage("missing", advice='drawing = "sobol"'))
    varied = [] if machine is None else list(_varied(read, stated, reader, is_search=is_search))
    results = None if machine is None else _analysed(machine, overrides, reader)
    limits: dict[str, tuple[float, float]] = {}
    if results is not None:
        limits, results = _wanted(read, results, reader)
    count = 0 if is_search else _count(read, varied, reader)
    if reader.problems or machine is None or results is None:
        raise input_error(text, name, reader)
    designs, objectives, searched = read["designs"], read["objectives"], read["search"]
    keys = tuple(dict.fromkeys([*objectives, *limits, *(read["values"] or ())]))
    return Study(
        name=name,
        title=read["title"] or results.machine.title or "",
        machine=machine,
        overrides=tuple(overrides),
        varied=tuple(varied),
        drawing="" if is_search else designs["drawing"],
        count=count,
        seed=int((read["search"] if is_search and "search" in read else designs)["seed"] or 0),
        angles=None if designs["angles"] is None else int(designs["angles"]),
        chunk=None if designs["chunk"] is None else int(designs["chunk"]),
        best=int(designs["best"]),
        has_rows=count <= _FEW if designs["rows"] is None else designs["rows"],
        objectives={key: _SIGNS[word] for key, word in objectives.items()},
        limits=limits,
        keys=keys,
        stated={key: results.value(key) for key in keys},
        units=results.machine.units,
        search={key: searched[key] for key in _SEARCH.keys},
        text=text,
    )


def study_schema(language: Language = "en") -> str:
    """Return the JSON Schema of study files in a language, for editors."""
    return schema_text("crankwork study file", STUDY_FILE.schema(language))


def _machine(values: Mapping[str, Any], reader: Reader, folder: Path) -> Description | None:
    """Return the machine file that a study names, or None."""
    named = values.get("machine")
    if not isinstance(named, str) or not named:
        return None
    try:
        return load(folder / named)
    except CrankworkError as error:
        reader.add_error("machine", error.args[0])
        return None


def _settings(values: dict[str, Any], machine: Description, reader: Reader) -> Iterator[Setting]:
    """Yield the settings of a study, which hold for all its designs."""
    values["settings"] = _flat_fields(values.get("settings", {}), machine.values)
    for key, value in values["settings"].items() if isinstance(values["settings"], dict) else ():
        setting = Setting("settings", key, value)
        try:
            machine.values_with([setting])
        except CrankworkError as error:
            reader.add_error(f"settings.{key}", error.args[0])
        else:
            yield setting


def _analysed(machine: Description, overrides: Sequence[str | Setting], reader: Reader) -> Results | None:
    """Return the results of the stated machine; its own error is raised only if there is no other."""
    try:
        return analyse(machine.machine(overrides))
    except CrankworkError:
        if reader.problems:
            return None
        raise


def _flat_fields(table: object, stated: dict[str, Any], path: str = "") -> Any:  # noqa: ANN401 - any TOML value
    """Return fields by their dotted keys if the file nests tables."""
    if not isinstance(table, dict):
        return table
    flat: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{path}.{name}" if path else name
        if isinstance(value, dict) and _is_table(stated, key):
            flat |= _flat_fields(value, stated, key)
        else:
            flat[key] = value
    return flat


def _is_table(stated: dict[str, Any], key: str) -> bool:
    try:
        return isinstance(kind_of(stated, key), TableSpec | MapOf)
    except CrankworkError:
        return False


def _flat(table: object, path: str = "", *, is_plain: bool) -> Any:  # noqa: ANN401 - any TOML value
    """Return keys of results by their dotted keys; `is_plain`: they have a text each, not a table."""
    if not isinstance(table, dict):
        return table
    flat: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{path}.{name}" if path else name
        inner = value.values() if isinstance(value, dict) else ()
        is_table = any(is_plain or isinstance(entry, dict) for entry in inner)
        flat |= _flat(value, key, is_plain=is_plain) if is_table else {key: value}
    return flat


def _check_search(read: Values, reader: Reader) -> None:
    """Add an error unless a search has exactly one objective."""
    objectives = read["objectives"] or {}
    if len(objectives) > 1:
        reader.add_error("objectives", ErrorMessage("objectives_several", keys=list(objectives)))
    elif not objectives and not reader.has_errors("objectives"):
        reader.add_error("objectives", ErrorMessage("objective_none"))


def _varied(read: Values, stated: dict[str, Any], reader: Reader, *, is_search: bool) -> Iterator[VariedField]:
    """Yield the fields that vary, each read with the type of the machine file."""
    fields = read["vary"]
    if not fields and not reader.has_errors("vary"):
        reader.add_error("vary", ErrorMessage("vary_none"))
    for key, written in fields.items():
        path = f"vary.{key}"
        try:
            kind = kind_of(stated, key)
        except CrankworkError as error:
            reader.add_error(path, error.args[0])
            continue
        designs = {"drawing": None} if is_search else read["designs"] or {}
        variable = _Field(key, path, kind, stated, reader).varied(written, designs)
        if variable is not None and is_search and variable.law not in ("even", "ratios", "uniform"):
            reader.add_error(path, ErrorMessage("vary_ends"))
        elif variable is not None:
            yield variable


class _Field:
    """Reader of one field that varies."""

    def __init__(self, key: str, path: str, kind: Any, stated: dict[str, Any], reader: Reader) -> None:  # noqa: ANN401
        self._key, self._path, self._reader = key, path, reader
        self._kind = single_kind(kind, stated_value(stated, key))
        self._number: NumericField | None = None
        try:
            self._number = numeric_field(stated, key)
        except CrankworkError:
            # names and integers may be given in a list
            self._kind = kind

    def varied(self, written: object, designs: Mapping[str, Any]) -> VariedField | None:
        """Return how the field varies, or None after errors."""
        drawing = designs.get("drawing")
        if isinstance(written, list):
            return self._list(written)
        if self._number is None:
            self._add_error("", ErrorMessage("vary_words"))
            return None
        if isinstance(written, str):
            return self._spread("normal", written, "", drawing)
        if not isinstance(written, dict):
            self._add_error("", ErrorMessage("vary_form", value=shown(written)))
            return None
        read = _RANGE.read(written, self._path, self._reader)
        if read is None or self._reader.has_errors(self._path):
            return None
        if "uniform" in read:
            return self._spread("uniform", read["uniform"], ".uniform", drawing)
        for name in ("from", "to"):
            if name not in read:
                self._add_error(f".{name}", ErrorMessage("missing", advice=f"{name} = ..."))
                return None
        return self._range(read, drawing)

    def _list(self, written: list[Any]) -> VariedField | None:
        if not 1 <= len(written) <= _MAX_VALUES:
            wanted = ErrorMessage("entries_between", fewest="1", most=str(_MAX_VALUES))
            self._add_error("", ErrorMessage("entries", count=len(written), wanted=wanted))
            return None
        values = [self._read(entry, f"[{index}]") for index, entry in enumerate(written, start=1)]
        if any(value is None for value in values):
            return None
        if self._number is None:
            return VariedField(self._key, "words", values=tuple(written))
        return VariedField(self._key, "list", self._number, values=tuple(values))

    def _range(self, read: Values, drawing: object) -> VariedField | None:
        low, high = (self._read(read[name], f".{name}") for name in ("from", "to"))
        if low is None or high is None:
            return None
        if not low < high or (read["spacing"] == "ratios" and low <= 0):
            name = "vary_ratios" if low < high else "vary_empty"
            self._add_error(".to", ErrorMessage(name, start=shown(read["from"]), end=shown(read["to"])))
            return None
        if drawing == GRID and "steps" not in read:
            self._add_error("", ErrorMessage("vary_steps"))
            return None
        if drawing == LIST or ("steps" in read and drawing in DRAWN):
            self._add_error("", ErrorMessage("vary_no_grid", drawing=shown(drawing)))
            return None
        return VariedField(self._key, read["spacing"], self._number, (low, high), steps=int(read["steps"] or 0))

    def _spread(self, law: Any, written: object, suffix: str, drawing: object) -> VariedField | None:  # noqa: ANN401
        """Return a distribution from a value with its tolerance or standard deviation."""
        value = self._read(written, suffix)
        if value is None:
            return None
        deviation, tolerance = (
            sizes.get(self._path + suffix, 0.0) for sizes in (self._reader.deviations, self._reader.tolerances)
        )
        if not (tolerance if law == "uniform" else deviation):
            name = "vary_uniform" if deviation else "vary_form"
            self._add_error(suffix, ErrorMessage(name, value=shown(written)))
            return None
        if drawing in (GRID, LIST):
            self._add_error(suffix, ErrorMessage("vary_distribution", drawing=shown(drawing)))
            return None
        ends = (value, deviation) if law == "normal" else (value - tolerance, value + tolerance)
        return VariedField(self._key, law, self._number, ends)

    def _read(self, value: object, suffix: str) -> Any:  # noqa: ANN401 - any TOML value
        result = self._kind.read(value, f"{self._path}{suffix}", self._reader)
        return result.value if isinstance(result, MeasuredValue) else result

    def _add_error(self, suffix: str, message: ErrorMessage) -> None:
        self._reader.add_error(f"{self._path}{suffix}", message)


def _wanted(read: Values, results: Results, reader: Reader) -> tuple[dict[str, tuple[float, float]], Results]:
    """Check every key that is named, and return the limits [SI] and the results that have all keys."""
    named = {
        **{f"objectives.{key}": key for key in read["objectives"] or ()},
        **{f"limits.{key}": key for key in read["limits"] or ()},
        **{f"values[{index}]": key for index, key in enumerate(read["values"] or (), start=1)},
    }
    known = set()
    for path, key in named.items():
        try:
            results = with_requested(results, [key])
            check_single(results, key)
        except CrankworkError as error:
            reader.add_error(path, error.args[0])
        else:
            known.add(key)
    if not named and not reader.problems:
        reader.add_error("values", ErrorMessage("study_nothing"))
    with use_units(results.machine.units):
        stated = {key: ends for key, ends in (read["limits"] or {}).items() if ends is not None and key in known}
        return {key: _limits(key, ends, reader) for key, ends in stated.items()}, results


def _limits(key: str, stated: Values, reader: Reader) -> tuple[float, float]:
    """Return lower and upper limit of a value; a bare number is in the unit of the tables. [SI]"""
    ends = dict(_LIMITS)
    for name, written in stated.items():
        path = f"limits.{key}.{name}"
        if isinstance(written, bool) or not isinstance(written, int | float | str):
            reader.add_error(path, ErrorMessage("level_plain", text=shown(written)))
            continue
        try:
            ends[name] = level_of(key, str(written))
        except ValueError as error:
            reader.add_error(path, error.args[0])
    if not stated:
        reader.add_error(f"limits.{key}", ErrorMessage("missing", advice="at_most = ..."))
    elif not ends["at_least"] <= ends["at_most"]:
        reader.add_error(f"limits.{key}", ErrorMessage("limits_apart"))
    return ends["at_least"], ends["at_most"]


def _count(read: Values, varied: Sequence[VariedField], reader: Reader) -> int:
    """Return the number of designs."""
    designs: Mapping[str, Any] = read.get("designs") or {}
    drawing = designs.get("drawing")
    if drawing == GRID:
        count = math.prod(variable.count for variable in varied)
        if count > MAX_DESIGNS:
            reader.add_error("vary", _many(count))
        return count
    if drawing == LIST:
        lengths = {variable.count for variable in varied}
        if len(lengths) > 1:
            reader.add_error("vary", ErrorMessage("vary_lengths", counts=sorted(map(str, lengths))))
        return max(lengths, default=0)
    count = int(designs.get("count") or 0)
    if drawing == "saltelli" and count:
        block = len(varied) + 2
        if count < block:
            reader.add_error("designs.count", ErrorMessage("study_block", count=str(block)))
        return count // block * block
    return count


def _many(count: int) -> ErrorMessage:
    written = f"{count}" if count < 10**30 else "10^30"
    return ErrorMessage("study_count", count=written, most=str(MAX_DESIGNS))
