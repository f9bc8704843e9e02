"""Results are those of 0.1: tables, listings and single values of every example and template, but for what was mended.

Beside each machine stand its frozen results, one file per method; they are written once, by `scripts/freeze`, and never
again. What is mended is listed in `changed.toml`, whose head says how.
"""

import functools
import json
import math
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from crankwork.quantities.key import MOVED, RENAMED
from each import for_each

HERE = Path(__file__).parent
SAME, SAME_ANGLE = 1e-9, 1e-7
# how near another route comes to the rows of a column
ROUTES = 2e-6
# sums that cancel leave this much of what went into them
_ROUNDING = 1e-13
# equal cylinders have equal extremes, and rounding chooses among them
_FAR = 1e-2
MACHINES = sorted(path.relative_to(HERE).with_suffix("").as_posix() for path in HERE.glob("*/*.toml"))
FROZEN = sorted(path.relative_to(HERE).with_suffix("").as_posix() for path in HERE.glob("*/*.json"))


class Place(NamedTuple):
    """A number of the results: where it stands, what it was and is, and by how much of what may pass it differs."""

    machine: str
    key: str
    at: float | None
    old: float
    new: float
    scale: float
    allowed: float

    @property
    def difference(self) -> float:
        """By how much of the scale it differs; angles absolutely. [-], [rad]"""
        if math.isnan(self.old) or math.isnan(self.new):
            return 0.0 if math.isnan(self.old) and math.isnan(self.new) else math.inf
        return abs(self.new - self.old) / self.scale

    @property
    def differs(self) -> bool:
        """Whether it is another value."""
        return self.difference > self.allowed


def compared(machine: str, frozen: Mapping[str, Any], today: Mapping[str, Any], adapter: Any) -> Iterator[Place]:
    """Yield every frozen number with today's; a missing one is not a number."""
    largest = _largest(frozen, adapter)

    def place(key: str, name: str, at: float | None, old: float | None, new: float | None, scale: float) -> Place:
        before, now = (math.nan if one is None else one for one in (old, new))
        floor = _ROUNDING / SAME * largest.get(adapter.unit(name), 0.0)
        if adapter.is_angle(name) and not key.startswith("columns."):
            return Place(machine, key, at, before, now, 1.0, SAME_ANGLE)
        return Place(machine, key, at, before, now, max(scale, floor) or 1.0, SAME)

    tables = {"columns": frozen["columns"]} | {f"listings.{one}": table for one, table in frozen["listings"].items()}
    now = {"columns": today["columns"]} | {f"listings.{one}": table for one, table in today["listings"].items()}
    for table, columns in tables.items():
        for name, values in columns.items():
            rows = now.get(table, {}).get(name)
            if rows is None or len(rows) != len(values):
                rows = [None] * len(values)
            places, scale = frozen["degrees"] if table == "columns" else range(len(values)), _scale(values)
            for at, old, new in zip(places, values, rows, strict=True):
                yield place(f"{table}.{name}", name, at, old, new, scale)
    for name, value in frozen["summary"].items():
        scale = max(_scale([frozen["summary"].get(one)]) for one in _siblings(name))
        yield place(f"summary.{name}", name, None, value, today["summary"].get(name), scale)


def _keys(results: Mapping[str, Any]) -> set[str]:
    listed = {f"{listing}.{key}" for listing, one in results["listings"].items() for key in one}
    return {*results["columns"], *results["summary"], *listed}


def _siblings(key: str) -> list[str]:
    """Return the keys whose values have one scale: a value with its largest and smallest."""
    stem, _, owner = key.partition(".")
    stem = stem.removesuffix("_max").removesuffix("_min")
    return [one + (f".{owner}" if owner else "") for one in (stem, f"{stem}_max", f"{stem}_min")]


def _scale(values: list[float | None]) -> float:
    return max((abs(one) for one in values if one is not None and not math.isnan(one)), default=0.0)


def _largest(frozen: Mapping[str, Any], adapter: Any) -> dict[str, float]:
    """Return the largest value of each unit."""
    result: dict[str, float] = {}
    tables = [frozen["columns"], *frozen["listings"].values(), {key: [one] for key, one in frozen["summary"].items()}]
    for table in tables:
        for key, values in table.items():
            unit = adapter.unit(key)
            result[unit] = max(result.get(unit, 0.0), _scale(values))
    return result


@pytest.fixture(scope="module")
def places(adapter) -> Callable[[str], list[Place]]:
    """Give every frozen number of a machine with today's."""

    @functools.cache
    def compare(machine: str) -> list[Place]:
        frozen = _with_keys_of_today(json.loads((HERE / f"{machine}.json").read_text("utf-8")))
        file, _, method = machine.rpartition(".")
        at = functools.partial(adapter.values, HERE / f"{file}.toml", method.replace("-", ":"))
        today = at(frozen["degrees"])
        today = {**today, "listings": _rows_of_then(frozen, today)}
        assert not _keys(frozen) - _keys(today)
        found = list(compared(machine, frozen, today, adapter))
        return [one for one in found if not _is_of_an_equal_extreme(one, today, at)]

    return compare


def _with_keys_of_today(frozen: dict[str, Any]) -> dict[str, Any]:
    """Return frozen results under the keys that the values have today: those of an engine name the cylinder."""
    moved = MOVED if "cylinder_count" in frozen["summary"] else {}
    for table in ("summary", "columns"):
        frozen[table] = {moved.get(key, RENAMED.get(key, key)): value for key, value in frozen[table].items()}
    return frozen


def _rows_of_then(frozen: Mapping[str, Any], today: Mapping[str, Any]) -> dict[str, Any]:
    """Return today's listings with the rows that were frozen, in that order; there may be others now."""
    found = dict(today["listings"])
    for name, rows in frozen["rows"].items():
        now = today["rows"][name]
        assert set(rows) <= set(now), name
        found[name] = {key: [column[now.index(row)] for row in rows] for key, column in found[name].items()}
    return found


def _is_of_an_equal_extreme(place: Place, today: Mapping[str, Any], at: Callable[[list[float]], Any]) -> bool:
    """Say whether the frozen angle is that of another extreme, equal to the one found today but for rounding."""
    angle = re.fullmatch(r"summary\.(?P<stem>\w+)(?P<side>_max|_min)_angle(?P<owner>\..+)?", place.key)
    if angle is None or not _FAR < place.difference < math.inf:
        return False
    owner = angle["owner"] or ""
    column = at([math.degrees(place.old)])["columns"].get(angle["stem"] + owner)
    extreme = today["summary"][f"{angle['stem']}{angle['side']}{owner}"]
    return column is not None and abs(column[0] - extreme) <= SAME * abs(extreme)


def test_every_machine_is_frozen() -> None:
    assert {name.rpartition(".")[0] for name in FROZEN} == set(MACHINES)


@pytest.mark.parametrize("machine", MACHINES)
def test_only_what_is_listed_differs_from_frozen_results(machine, places) -> None:
    entries, unexplained = _entries(), {}
    for name in FROZEN:
        for one in places(name) if name.rpartition(".")[0] == machine else ():
            if one.differs and not any(_explains(entry, one) for entry in entries):
                unexplained.setdefault((name, one.key), []).append(one)
    assert not unexplained, "".join(
        f"\n{name}: {key}{'' if worst.at is None else f' at {worst.at:g}'}: was {worst.old:.12g}, is {worst.new:.12g}, "
        f"off by {worst.difference:.2g}, {len(all_)} in all"
        for (name, key), all_ in unexplained.items()
        for worst in [max(all_, key=lambda one: one.difference)]
    )


def test_what_is_listed_differs_as_listed(places) -> None:
    assert [
        f"{entry['machine']}: {entry['key']}: {flaw}"
        for entry in _entries()
        for flaw in _flaws(
            entry, [one for name in FROZEN if fnmatchcase(name, entry["machine"]) for one in places(name)]
        )
    ] == []


@functools.cache
def _entries() -> list[dict[str, Any]]:
    return tomllib.loads((HERE / "changed.toml").read_text("utf-8")).get("changed", [])


def _covers(entry: Mapping[str, Any], place: Place) -> bool:
    matches = _fits(place.key, entry["key"]) and _fits(place.machine, entry["machine"])
    of_column = "independent" in entry and isinstance(entry["independent"], list)
    return matches and (of_column or entry.get("at", place.at) == place.at)


_fits = functools.cache(fnmatchcase)


def _beside(entry: Mapping[str, Any], place: Place) -> float:
    """Return the independent value of a row of a column."""
    return dict(zip(entry["at"], entry["independent"], strict=True)).get(place.at, math.nan)


def _explains(entry: Mapping[str, Any], place: Place) -> bool:
    if not _covers(entry, place):
        return False
    if isinstance(entry.get("independent"), list):
        return abs(place.new - _beside(entry, place)) <= ROUTES * place.scale
    if "within" in entry:
        return place.difference <= entry["within"]
    return max(abs(entry["old"] - place.old), abs(entry["new"] - place.new)) <= place.allowed * place.scale


def _flaws(entry: Mapping[str, Any], places: list[Place]) -> Iterator[str]:
    """Yield what is wrong with an entry, given the numbers of all its machines."""
    about = [one for one in places if _covers(entry, one)]
    differing = [one for one in about if one.differs]
    if len(entry["reason"]) < 20:
        yield "gives no reason"
    if not differing:
        yield "differs no longer; take it out"
    elif "within" in entry:
        largest = max((one.difference for one in differing if _explains(entry, one)), default=0.0)
        if entry["within"] > 10 * largest:
            yield f"allows {entry['within']:g} where {largest:.2g} suffices; lower it"
    elif isinstance(entry["independent"], list):
        nearer = [
            one.at for one in differing if not abs(one.old - _beside(entry, one)) > abs(one.new - _beside(entry, one))
        ]
        if nearer:
            yield f"the independent values speak for the old ones at {nearer}"
    elif len(about) != 1:
        yield f"is {len(about)} numbers; name one machine, key and place, or give a bound with within"
    elif abs(entry["new"] - entry["independent"]) >= abs(entry["old"] - entry["independent"]):
        yield "the independent value speaks for the old one"


OLD = Place("engine.own", "summary.side_force_max", None, 100.0, 101.0, 1000.0, SAME)
LISTED = {"machine": "engine.own", "key": "summary.side_force_max", "reason": "It was read off a grid of degrees."}
ONE = {"old": 100.0, "new": 101.0, "independent": 101.0}


@for_each(
    ("change", "place", "explained", "flaw"),
    [
        (ONE, OLD, True, None),
        (ONE, OLD._replace(new=102.0), False, None),
        (ONE, OLD._replace(new=100.0), False, "differs no longer"),
        (ONE | {"independent": 100.2}, OLD, True, "speaks for the old one"),
        (ONE | {"key": "summary.*"}, OLD._replace(key="columns.side_force"), False, "differs no longer"),
        ({"at": [30.0], "independent": [101.0]}, OLD._replace(at=30.0), True, None),
        ({"at": [30.0], "independent": [101.0]}, OLD._replace(at=40.0), False, "speak for the old ones"),
        ({"at": [30.0], "independent": [100.4]}, OLD._replace(at=30.0), False, "speak for the old ones"),
        ({"within": 2e-3}, OLD, True, None),
        ({"within": 2e-3, "machine": "*", "key": "summary.*_max"}, OLD, True, None),
        ({"within": 5e-4}, OLD, False, "lower it"),
        ({"within": 0.1}, OLD, True, "lower it"),
        ({"within": 0.1}, OLD._replace(new=100.0), True, "differs no longer"),
        ({"within": 0.1}, OLD._replace(new=math.nan), False, "lower it"),
        ({"within": 2e-3, "reason": "better"}, OLD, True, "gives no reason"),
    ],
)
def test_how_a_listed_change_is_read(change, place, explained, flaw) -> None:
    entry = LISTED | change
    assert _explains(entry, place) is explained
    found = list(_flaws(entry, [place]))
    assert len(found) == (flaw is not None)
    assert (flaw or "") in "".join(found)
