"""The door for study files: which fields of a machine file vary and how, what is wanted of the designs."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, get_args

from crankwork import __version__, files
from crankwork.analysis import Results, analyse
from crankwork.description.document import Description, load, stated_value
from crankwork.description.kinds import Choice, Flag, Measure, Number, Reader, Text, shown
from crankwork.description.machine_file import Setting, input_error, parse, schema_text
from crankwork.description.schema import Key, Named, OneOrMore, Table, Values
from crankwork.errors import CrankworkError
from crankwork.locale import Language, Refusal
from crankwork.report.language import key_unit
from crankwork.study.machines import check_single
from crankwork.study.search import Way
from crankwork.study.sought import Sought, kind_of, single_kind, sought_number
from crankwork.study.varied import Varied
from crankwork.units import System, parse_in, use_units

# more points there are none of a Sobol sequence of 30 bits
MOST = 2**30
_MOST_FIELDS, _MOST_VALUES = 40, 10_000
# tables of a machine file within each other
_DEEP = 4
GRID, LIST, DRAWN = "grid", "list", ("random", "latin", "sobol", "saltelli")
_LIMITS = {"at_least": -math.inf, "at_most": math.inf}
_SIGNS = {"minimise": 1.0, "maximise": -1.0}


class Count(NamedTuple):
    """How many designs there are."""

    def read(self, value: object, key: str, reader: Reader) -> int | None:
        """Return the whole number."""
        if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= MOST:
            return value
        if isinstance(value, int) and not isinstance(value, bool) and value > MOST:
            reader.complain(key, _many(value))
        else:
            reader.complain(key, Refusal("whole_range", value=shown(value), low="1", high=str(MOST)))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a whole number."""
        return {"type": "integer", "minimum": 1, "maximum": MOST}


class As(NamedTuple):
    """What is read by the kind of the field or value that it concerns, once that is known: of types, or a table."""

    types: tuple[str, ...]
    entry: Table | None = None

    def read(self, value: object, _: str, __: Reader) -> object:
        """Return what the file states."""
        return value

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of any of these."""
        own: dict[str, Any] = {"type": list(self.types)}
        return own if self.entry is None else {"anyOf": [own, self.entry.schema(language)]}


_VALUE = As(("string", "number"))
_RANGE = Table("range", {
    "from": Key(_VALUE, instead_of=("uniform",)),
    "to": Key(_VALUE, instead_of=("uniform",)),
    "steps": Key(Number(1, _MOST_VALUES, whole=True), only={"from": ()}),
    "spacing": Key(Choice(("even", "ratios")), default="even", only={"from": ()}),
    "uniform": Key(As(("string",)), instead_of=("from", "to")),
})  # fmt: skip
_DESIGNS = Table("designs", {
    "drawing": Key(Choice((GRID, LIST, *DRAWN)), required=True),
    "count": Key(Count(), required=True, only={"drawing": DRAWN}),
    "seed": Key(Number(0, 2**31, whole=True), default=0, only={"drawing": DRAWN}),
    "angles": Key(Number(36, 72_000, whole=True)),
    "best": Key(Number(1, 1000, whole=True), default=10),
    "rows": Key(Flag(), default=False),
    "chunk": Key(Number(1, 2**17, whole=True)),
})  # fmt: skip
_SEARCH = Table("search", {
    "way": Key(Choice(get_args(Way)), default="slsqp"),
    "starts": Key(Number(1, 1000, whole=True)),
    "seed": Key(Number(0, 2**31, whole=True), default=0),
})  # fmt: skip
_OF_VALUE = Table("limits", {name: Key(_VALUE) for name in _LIMITS})
_KEY = Text(80)
STUDY_FILE = Table("study", {
    "title": Key(Text()),
    "machine": Key(Text(), required=True),
    "designs": Key(_DESIGNS),
    "vary": Key(Named(As(("array", "string"), _RANGE), _MOST_FIELDS, _DEEP), required=True),
    "objectives": Key(Named(Choice(tuple(_SIGNS)), 8, _DEEP)),
    "limits": Key(Named(_OF_VALUE, _MOST_FIELDS, _DEEP)),
    "values": Key(OneOrMore(_KEY, most=100)),
    "search": Key(_SEARCH),
})  # fmt: skip


@dataclass(frozen=True)
class Study:
    """What is to be found of which designs. [SI]

    `objectives`: 1 for a value that is to be small, -1 for one that is to be large; `limits`: from and to; `keys`:
    every value that is calculated; `angles`: evenly spaced ones, None for exact extremes and integrals;
    `stated`: values of the machine as its file states it; `search`: what is said of how the best design is sought.
    """

    name: str
    title: str
    machine: Description
    overrides: tuple[str | Setting, ...]
    varied: tuple[Varied, ...]
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
        """What makes the study this one: its text, the machine, the program, and what the stated machine has."""
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
        """The identity in one word."""
        return hashlib.sha256(json.dumps(self.identity, sort_keys=True).encode()).hexdigest()


def load_study(path: str | Path, overrides: Sequence[str | Setting] = (), *, is_search: bool = False) -> Study:
    """Return the study that a file describes; an `InputError` tells every mistake of it, each on its line.

    `is_search`: the best design between two ends of each field is sought, and none are drawn.
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
    """Return the study that a text describes, as `load_study` does."""
    values = parse(text, name)
    reader = Reader()
    machine = _machine(values, reader, folder or Path())
    if machine is not None:
        stated = machine.values_with(overrides)
        reader.decimal_comma = stated.get("decimal_mark") == ","
        values["vary"] = _flat_fields(values.get("vary"), stated)
    for table in ("objectives", "limits"):
        if table in values:
            values[table] = _flat(values[table])
    read = STUDY_FILE.read(values, "", reader) or Values({}, STUDY_FILE)
    if is_search:
        _check_search(read, reader)
    elif "designs" not in read and not reader.doubts("designs"):
        reader.complain("designs", Refusal("missing", advice='drawing = "sobol"'))
    varied = [] if machine is None else list(_varied(read, stated, reader, is_search=is_search))
    results = None if machine is None else _analysed(machine, overrides, reader)
    limits = {} if results is None else _wanted(read, results, reader)
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
        has_rows=designs["rows"],
        objectives={key: _SIGNS[word] for key, word in objectives.items()},
        limits=limits,
        keys=keys,
        stated={key: results.value(key) for key in keys},
        units=results.machine.units,
        search={key: searched[key] for key in _SEARCH.keys},
        text=text,
    )


def study_schema(language: Language = "en") -> str:
    """Return the JSON Schema of study files, for editors, its descriptions in a language."""
    return schema_text("crankwork study file", STUDY_FILE.schema(language))


def _machine(values: Mapping[str, Any], reader: Reader, folder: Path) -> Description | None:
    """Return the machine file that a study names."""
    named = values.get("machine")
    if not isinstance(named, str) or not named:
        return None
    try:
        return load(folder / named)
    except CrankworkError as error:
        reader.complain("machine", error.args[0])
        return None


def _analysed(machine: Description, overrides: Sequence[str | Setting], reader: Reader) -> Results | None:
    """Return the results of the stated machine, whose own mistakes are told where nothing else is wrong."""
    try:
        return analyse(machine.machine(overrides))
    except CrankworkError:
        if reader.problems:
            return None
        raise


def _flat_fields(table: object, stated: dict[str, Any], path: str = "") -> Any:  # noqa: ANN401 - what the file states
    """Return fields by their dotted keys, where the file has tables within tables."""
    if not isinstance(table, dict):
        return table
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{path}.{name}" if path else name
        if isinstance(value, dict) and _is_table(stated, key):
            found |= _flat_fields(value, stated, key)
        else:
            found[key] = value
    return found


def _is_table(stated: dict[str, Any], key: str) -> bool:
    try:
        return isinstance(kind_of(stated, key), Table | Named)
    except CrankworkError:
        return False


def _flat(table: object, path: str = "") -> Any:  # noqa: ANN401 - what the file states
    """Return values of the results by their dotted keys."""
    if not isinstance(table, dict):
        return table
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{path}.{name}" if path else name
        is_table = isinstance(value, dict) and not _LIMITS.keys() & value.keys() and value
        found |= _flat(value, key) if is_table else {key: value}
    return found


def _check_search(read: Values, reader: Reader) -> None:
    """Refuse a search for the best design that does not say by which one value."""
    objectives = read["objectives"] or {}
    if len(objectives) > 1:
        reader.complain("objectives", Refusal("objectives_several", keys=list(objectives)))
    elif not objectives and not reader.doubts("objectives"):
        reader.complain("objectives", Refusal("objective_none"))


def _varied(read: Values, stated: dict[str, Any], reader: Reader, *, is_search: bool) -> Iterator[Varied]:
    """Yield the fields that vary, each read as the machine file reads it."""
    fields = read["vary"]
    if not fields and not reader.doubts("vary"):
        reader.complain("vary", Refusal("vary_none"))
    for key, written in fields.items():
        path = f"vary.{key}"
        try:
            kind = kind_of(stated, key)
        except CrankworkError as error:
            reader.complain(path, error.args[0])
            continue
        designs = {"drawing": None} if is_search else read["designs"] or {}
        one = _Field(key, path, kind, stated, reader).varied(written, designs)
        if one is not None and is_search and one.law not in ("even", "ratios", "uniform"):
            reader.complain(path, Refusal("vary_ends"))
        elif one is not None:
            yield one


class _Field:
    """A field that varies, and how what is said of it is read."""

    def __init__(self, key: str, path: str, kind: Any, stated: dict[str, Any], reader: Reader) -> None:  # noqa: ANN401
        self._key, self._path, self._reader = key, path, reader
        self._kind = single_kind(kind, stated_value(stated, key))
        self._number: Sought | None = None
        try:
            self._number = sought_number(stated, key)
        except CrankworkError:
            # words and counts may stand in a list
            self._kind = kind

    def varied(self, written: object, designs: Mapping[str, Any]) -> Varied | None:
        """Return how the field varies, or None after complaints."""
        drawing = designs.get("drawing")
        if isinstance(written, list):
            return self._list(written)
        if self._number is None:
            self._complain("", Refusal("vary_words"))
            return None
        if isinstance(written, str):
            return self._spread("normal", written, "", drawing)
        if not isinstance(written, dict):
            self._complain("", Refusal("vary_form", value=shown(written)))
            return None
        read = _RANGE.read(written, self._path, self._reader)
        if read is None or self._reader.doubts(self._path):
            return None
        if "uniform" in read:
            return self._spread("uniform", read["uniform"], ".uniform", drawing)
        for name in ("from", "to"):
            if name not in read:
                self._complain(f".{name}", Refusal("missing", advice=f"{name} = ..."))
                return None
        return self._range(read, drawing)

    def _list(self, written: list[Any]) -> Varied | None:
        if not 1 <= len(written) <= _MOST_VALUES:
            wanted = Refusal("entries_between", fewest="1", most=str(_MOST_VALUES))
            self._complain("", Refusal("entries", count=len(written), wanted=wanted))
            return None
        values = [self._read(one, f"[{at}]") for at, one in enumerate(written, start=1)]
        if any(one is None for one in values):
            return None
        if self._number is None:
            return Varied(self._key, "words", values=tuple(written))
        return Varied(self._key, "list", self._number, values=tuple(values))

    def _range(self, read: Values, drawing: object) -> Varied | None:
        low, high = (self._read(read[name], f".{name}") for name in ("from", "to"))
        if low is None or high is None:
            return None
        if not low < high or (read["spacing"] == "ratios" and low <= 0):
            name = "vary_ratios" if low < high else "vary_empty"
            self._complain(".to", Refusal(name, start=shown(read["from"]), end=shown(read["to"])))
            return None
        if drawing == GRID and "steps" not in read:
            self._complain("", Refusal("vary_steps"))
            return None
        if drawing == LIST or ("steps" in read and drawing in DRAWN):
            self._complain("", Refusal("vary_no_grid", drawing=shown(drawing)))
            return None
        return Varied(self._key, read["spacing"], self._number, (low, high), steps=int(read["steps"] or 0))

    def _spread(self, law: Any, written: object, at: str, drawing: object) -> Varied | None:  # noqa: ANN401
        """Return a distribution about a value that is stated with what it may be off by."""
        value = self._read(written, at)
        if value is None:
            return None
        deviation = self._reader.deviations.get(self._path + at)
        if not deviation:
            self._complain(at, Refusal("vary_form", value=shown(written)))
            return None
        if drawing in (GRID, LIST):
            self._complain(at, Refusal("vary_distribution", drawing=shown(drawing)))
            return None
        ends = (value, deviation) if law == "normal" else (value - deviation, value + deviation)
        return Varied(self._key, law, self._number, ends)

    def _read(self, value: object, at: str) -> Any:  # noqa: ANN401 - a number, or what the file may state
        found = self._kind.read(value, f"{self._path}{at}", self._reader)
        return found.value if isinstance(found, Measure) else found

    def _complain(self, at: str, message: Refusal) -> None:
        self._reader.complain(f"{self._path}{at}", message)


def _wanted(read: Values, results: Results, reader: Reader) -> dict[str, tuple[float, float]]:
    """Return limits of values after a look at every key that is named. [SI]"""
    named = {
        **{f"objectives.{key}": key for key in read["objectives"] or ()},
        **{f"limits.{key}": key for key in read["limits"] or ()},
        **{f"values[{at}]": key for at, key in enumerate(read["values"] or (), start=1)},
    }
    known = set()
    for path, key in named.items():
        try:
            check_single(results, key)
        except CrankworkError as error:
            reader.complain(path, error.args[0])
        else:
            known.add(key)
    if not named and not reader.problems:
        reader.complain("values", Refusal("study_nothing"))
    with use_units(results.machine.units):
        return {key: _limits(key, one, reader) for key, one in (read["limits"] or {}).items() if one and key in known}


def _limits(key: str, stated: Values, reader: Reader) -> tuple[float, float]:
    """Return from and to what a value may be; a bare number is in the unit of the tables. [SI]"""
    unit, ends = key_unit(key), dict(_LIMITS)
    for name, written in stated.items():
        path = f"limits.{key}.{name}"
        if isinstance(written, bool) or not isinstance(written, int | float | str):
            reader.complain(path, Refusal("level_plain", text=shown(written)))
            continue
        try:
            value = parse_in(str(written), unit) if unit else float(str(written).replace(",", "."))
        except ValueError as error:
            reader.complain(path, error.args[0] if unit else Refusal("level_plain", text=str(written)[:40]))
            continue
        if math.isfinite(value):
            ends[name] = value
        else:
            reader.complain(path, Refusal("level_plain", text=str(written)[:40]))
    if not ends["at_least"] <= ends["at_most"]:
        reader.complain(f"limits.{key}", Refusal("limits_apart"))
    return ends["at_least"], ends["at_most"]


def _count(read: Values, varied: Sequence[Varied], reader: Reader) -> int:
    """Return how many designs there are."""
    designs: Mapping[str, Any] = read.get("designs") or {}
    drawing = designs.get("drawing")
    if drawing == GRID:
        count = math.prod(one.count for one in varied)
        if count > MOST:
            reader.complain("vary", _many(count))
        return count
    if drawing == LIST:
        lengths = {one.count for one in varied}
        if len(lengths) > 1:
            reader.complain("vary", Refusal("vary_lengths", counts=sorted(map(str, lengths))))
        return max(lengths, default=0)
    count = int(designs.get("count") or 0)
    if drawing == "saltelli" and count:
        block = len(varied) + 2
        if count < block:
            reader.complain("designs.count", Refusal("study_block", count=str(block)))
        return count // block * block
    return count


def _many(count: int) -> Refusal:
    written = f"{count}" if count < 10**30 else "10^30"
    return Refusal("study_count", count=written, most=str(MOST))
