"""Engines written out as linkages, and what may be done to the text of a linkage without making it another machine."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from crankwork import Machine, analyse, read_machine, template, template_names
from crankwork.analysis.results import Listing, Results
from crankwork.description.toml_edit import key_text, toml
from crankwork.quantities import QUANTITIES, base_key

ROOT = Path(__file__).parents[1]
# shares of the limits that are found to be used
Shares = list[float]


def machine_files(*folders: str) -> dict[str, str]:
    """Return the text of every template, and of every file in folders, by name."""
    paths = (path for folder in folders for path in sorted((ROOT / folder).glob("*.toml")))
    return {name: template(name) for name in template_names()} | {path.stem: path.read_text("utf-8") for path in paths}


def written(values: Mapping[str, Any]) -> str:
    """Return tables as the text of a file; tables of tables by name have headings of their own."""
    lines, tables = list[str](), list[str]()
    for key, value in values.items():
        if not isinstance(value, Mapping):
            lines.append(f"{key_text(key)} = {toml(value)}")
        elif value and all(isinstance(item, Mapping) for item in value.values()):
            for name, table in value.items():
                tables += ["", f"[{key_text(key)}.{key_text(name)}]"]
                tables += (f"{key_text(field)} = {toml(item)}" for field, item in table.items())
        else:
            tables += [
                "",
                f"[{key_text(key)}]",
                *(f"{key_text(field)} = {toml(item)}" for field, item in value.items()),
            ]
    return "\n".join([*lines, *tables, ""])


_NAMED = ("fixed_points", "links", "guides", "sliders", "positions", "chambers")


def new_names(values: Mapping[str, Any]) -> dict[str, str]:
    """Return another name for each link, joint, guide and chamber of a linkage."""
    names = [name for kind in _NAMED for name in values.get(kind, {})]
    names += [values["crank"]["pin"], *values["crank"].get("points", {})]
    names += [point for link in values["links"].values() for point in link.get("points", {})]
    return {name: f"q{(37 * number) % 101}.{number}".replace(".", "") for number, name in enumerate(names)}


def renamed(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a linkage whose links, joints, guides and chambers have other names."""
    new = new_names(values)

    def other(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {new.get(key, key): other(item) for key, item in value.items()}
        if isinstance(value, list):
            return [other(item) for item in value]
        return new.get(value, value) if isinstance(value, str) else value

    result = dict(values)
    for kind in _NAMED:
        if kind in values:
            result[kind] = {new[name]: _with_other(item, other) for name, item in values[kind].items()}
    for kind in ("crank", "shaft"):
        if kind in values:
            result[kind] = _with_other(values[kind], other)
    return result


def _with_other(table: Any, other: Any) -> Any:
    """Return a table with other names in its values; points of diagrams keep theirs."""
    if not isinstance(table, Mapping):
        return table
    kept = ("pieces", "cycle", "valves", "measured", *(("points",) if "pieces" in table else ()))
    return {key: item if key in kept else other(item) for key, item in table.items()}


def shuffled(values: Mapping[str, Any], seed: int) -> dict[str, Any]:
    """Return a linkage whose tables stand in another order, and whose rods are drawn from the piston pin."""
    order = random.Random(seed)  # noqa: S311 - no secret

    def mixed(table: Mapping[str, Any]) -> dict[str, Any]:
        keys = list(table)
        order.shuffle(keys)
        return {key: table[key] for key in keys}

    tables = ("links", "guides", "sliders", "positions", "chambers", "crank")
    result = {key: mixed(value) if key in tables else value for key, value in values.items()}
    if "points" in result["crank"]:
        result["crank"]["points"] = mixed(result["crank"]["points"])
    result["links"] = {
        name: link if "points" in link or order.random() < 0.5 else _reversed(link)
        for name, link in result["links"].items()
    }
    return result


def _reversed(link: Mapping[str, Any]) -> dict[str, Any]:
    turned = {**link, "joins": link["joins"][::-1]}
    if isinstance(link.get("centre"), list):
        turned["centre"] = [f"{_mm(link['length']) - _mm(link['centre'][0]):.15g} mm", "0 mm"]
    return turned


def _mm(text: str) -> float:
    return float(text.removesuffix(" mm"))


def turned(values: Mapping[str, Any], degrees: float) -> dict[str, Any]:
    """Return a linkage rotated about the origin."""
    return _moved(values, lambda place: place * cmath.exp(1j * math.radians(degrees)), lambda angle: angle + degrees)


def mirrored(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the mirror image of a linkage at the vertical axis; its crank turns the other way."""
    moved = _moved(values, lambda place: -place.conjugate(), lambda angle: 180.0 - angle)
    ways = {"clockwise": "anticlockwise", "anticlockwise": "clockwise"}
    moved["crank"]["direction"] = ways[values["crank"].get("direction", "anticlockwise")]

    def across(points: Mapping[str, list[str]]) -> dict[str, list[str]]:
        return {name: [along, f"{-_mm(left):.15g} mm"] for name, (along, left) in points.items()}

    for table in (moved["crank"], *moved["links"].values()):
        if "points" in table:
            table["points"] = across(table["points"])
        if isinstance(table.get("centre"), list):
            table["centre"] = across({"": table["centre"]})[""]
    return moved


def _moved(values: Mapping[str, Any], place: Any, angle: Any) -> dict[str, Any]:
    def at(pair: list[str]) -> list[str]:
        found = place(complex(*map(_mm, pair)))
        return [f"{found.real:.15g} mm", f"{found.imag:.15g} mm"]

    def towards(text: str) -> str:
        return f"{(angle(float(text.removesuffix(' deg'))) + 540) % 720 - 540:.15g} deg"

    result = {key: {**value} if isinstance(value, Mapping) else value for key, value in values.items()}
    result["fixed_points"] = {name: at(pair) for name, pair in values["fixed_points"].items()}
    result["positions"] = {name: at(pair) for name, pair in values["positions"].items()}
    result["guides"] = {
        name: {**guide, "through": at(guide["through"]), "angle": towards(guide["angle"])}
        for name, guide in values["guides"].items()
    }
    result["crank"] = {**values["crank"], "start": towards(values["crank"]["start"])}
    result["links"] = {name: {**link} for name, link in values["links"].items()}
    if "reference" in values.get("shaft", {}):
        result["shaft"]["reference"] = towards(values["shaft"]["reference"])
    return result


def drawn_again(
    results: Results, names: Mapping[str, str], degrees: float = 0.0, reversed_links: Iterable[str] = ()
) -> Results:
    """Return the results of a linkage as those of another drawing of it.

    `names`: names in that drawing by those in this; `degrees`: by how much this is rotated against it;
    `reversed_links`: links that are drawn from the other end, by the names of that drawing.
    """

    def key_of(key: str) -> str:
        return ".".join("_".join(names.get(word, word) for word in part.split("_")) for part in key.split("."))

    def of(table: Mapping[str, Any]) -> dict[str, Any]:
        own = {key_of(key): value for key, value in table.items()}
        for key in [key for key in own if base_key(key).endswith("_x")]:
            across = key.replace("_x", "_y", 1)
            back = (own[key] + 1j * own[across]) * cmath.exp(-1j * math.radians(degrees))
            own[key], own[across] = back.real, back.imag
        for key in [key for key in own if base_key(key) == "link_angle"]:
            half = math.pi if key.partition(".")[2] in reversed_links else 0.0
            own[key] = own[key] - math.radians(degrees) + half
        return own

    groups = {name: tuple(map(key_of, keys)) for name, keys in results.groups.items()}
    listings = {
        name: Listing(of(listing.columns), tuple(map(key_of, listing.names)))
        for name, listing in results.listings.items()
    }
    tables = {name: of(getattr(results, name)) for name in ("columns", "summary", "checks", "allowed")}
    return replace(results, groups=groups, listings=listings, **tables)


def of_linkage(machine: Machine) -> Results:
    """Return the results of a machine as a linkage, also where it is an engine."""
    results = analyse(machine)
    if results.machine.linkage is None:
        assert results.other is not None, "not written as a linkage"
        return results.other
    return results


WAYS = ("again", "renamed", "shuffled", "turned")
_DEGREES = 37.0


def differences_as_drawn(
    engine: Results, values: Mapping[str, Any], way: str, seed: int = 1, shares: Shares | None = None
) -> list[str]:
    """Return where an engine differs from its linkage that is drawn in one of `WAYS`; `shares`: as in `differences`."""
    # weights point down, whichever way the machine is turned
    way = "again" if way == "turned" and engine.machine.has_gravity else way
    changed = {
        "again": dict, "renamed": renamed, "shuffled": lambda values: shuffled(values, seed),
        "turned": lambda values: turned(values, _DEGREES),
    }[way](values)  # fmt: skip
    names = {new: old for old, new in new_names(values).items()} if way == "renamed" else {}
    reversed_links = [
        name for name, link in values["links"].items() if way == "shuffled" and changed["links"][name] != link
    ]
    linkage = analyse(read_machine(written(changed), folder=ROOT)).complete
    drawn = drawn_again(linkage, names, _DEGREES if way == "turned" else 0.0, reversed_links)
    return [f"{way}: {line[:160]}" for line in differences(engine.complete, drawn, shares=shares)]


def differences(engine: Results, form: Results, limit: float = 1e-9, shares: Shares | None = None) -> list[str]:
    """Return where the results of an engine and of its form differ.

    `limit`: of the size of a value; `shares`: takes for each value by how much of its size it differs.
    """
    scales = _scales(engine)
    pairs = [("summary", engine.summary, form.summary), ("column", engine.columns, form.columns)]
    empty = Listing({})
    pairs += [
        (f"listing {name}", _by_name(listing), _by_name(form.listings.get(name, empty)))
        for name, listing in engine.listings.items()
    ]
    found = [f"listing {name}" for name in engine.listings.keys() ^ form.listings.keys()]
    found += [
        f"listing {name}: rows {listing.names}"
        for name, listing in engine.listings.items()
        if sorted(listing.names) != sorted(form.listings.get(name, empty).names)
    ]
    found += [
        f"table {name}: {sorted(set(engine.tables.get(name, ())) ^ set(form.tables.get(name, ())))}"
        for name in engine.tables.keys() | form.tables.keys()
        if set(engine.tables.get(name, ())) ^ set(form.tables.get(name, ()))
    ]
    for kind, own, other in pairs:
        found += [f"{kind} {key}" for key in own.keys() ^ other.keys()]
        for key in own.keys() & other.keys():
            first, second = (_without_noise(key, values, limit, scales) for values in (own, other))
            if first.shape != second.shape or np.any(np.isnan(first) != np.isnan(second)):
                found.append(f"{kind} {key}: {first} is {second}")
                continue
            apart = _apart(key, first, second, engine)
            room = _ANGLES if _unit(key) in _OF_ANGLES else limit * (_largest(own, key) + _SMALL * scales[_unit(key)])
            if kind == "column" and len(first) == len(engine.grid) and engine.grid.degrees[-1] == engine.machine.cycle:
                # where the cycle jumps at its end, the value is that of either side
                apart[-1] = min(apart[-1], _apart(key, first[:1], second[-1:], engine)[0])
            far = apart > room
            if shares is not None and kind in ("summary", "column") and not far.any():
                shares.append(limit * float(np.nanmax(np.append(apart / np.where(room, room, 1.0), 0.0))))
            if kind == "summary" and far.any() and _is_another_peak(key, float(second), engine, room):
                continue
            if kind == "listing bearing_loads" and far.any() and key.endswith("_angle"):
                names = sorted(engine.listings["bearing_loads"].names)
                far = [
                    row for row in np.flatnonzero(far) if not _is_same_load(names[row], engine, first[row], second[row])
                ]
                found += [f"{kind} {key}: {[names[row] for row in far]}"] if far else []
                continue
            found += [f"{kind} {key}: {own[key]} is {other[key]}"] if far.any() else []
    found += [f"check {key}" for key in engine.checks.keys() ^ form.checks.keys()]
    # where a linkage has no gas nothing says that it is an engine
    alike = _OF_SHORTHAND | ({"implausible"} if form.machine.lengths is None else set())
    found += [f"notice {code}" for code in (_codes(engine) ^ _codes(form)) - alike]
    return found + [
        f"check {key}: {value}" for key, value in form.checks.items() if value > form.allowed.get(key, limit)
    ]


def _by_name(listing: Listing) -> dict[str, Any]:
    """Return the columns of a table with its rows in the order of their names; files have their parts in any order."""
    rows = np.argsort(listing.names) if listing.names else slice(None)
    return {key: values[rows] for key, values in listing.columns.items()}


# angles may be apart by [rad]; what rounding leaves of the largest value of a unit, over the limit
_ANGLES, _SMALL = 1e-7, 1e-3
_OF_ANGLES = ("deg", "rad")
# directions repeat after a turn, those of lines after half of one
_DIRECTIONS = {
    **dict.fromkeys(("link_angle", "counterweight_angle", "harmonic_phase"), math.tau),
    "free_force_direction": math.pi,
}
# of what the file of an engine leaves open, and a drawing shows
_OF_SHORTHAND = {"upright", "uneven_intervals", "uneven_pair"}


def _apart(key: str, first: Any, second: Any, engine: Results) -> Any:
    """Return how far values are from one another, angles over the end of the cycle."""
    if _unit(key) not in _OF_ANGLES:
        return np.abs(first - second)
    period = _DIRECTIONS.get(base_key(key), math.radians(engine.machine.cycle))
    return np.abs((first - second + period / 2) % period - period / 2)


def _largest(values: Mapping[str, Any], key: str) -> float:
    """Return the size of a value: of a component that of the vector, of an extreme that of both."""
    keys = [key]
    for word, others in (("_x", ("_y",)), ("_y", ("_x",)), ("_max", ("_min",)), ("_min", ("_max",))):
        keys += [key.replace(word, other, 1) for other in others if word in key]
    sizes = [np.append(np.abs(np.asarray(values[one], dtype=float)), 0.0) for one in keys if one in values]
    return max(float(np.nanmax(size)) for size in sizes)


def _is_another_peak(key: str, angle: float, engine: Results, room: float) -> bool:
    """Return whether an angle is that of an extreme as large as the stated one."""
    word, dot, name = key.partition(".")
    extreme, column = word.removesuffix("_angle"), word.removesuffix("_angle").rpartition("_")[0]
    if not word.endswith(("_max_angle", "_min_angle")) or f"{column}{dot}{name}" not in engine:
        return False
    there = float(engine.columns_at([math.degrees(angle)], [f"{column}{dot}{name}"])[f"{column}{dot}{name}"][0])
    stated = engine.summary[f"{extreme}{dot}{name}"]
    return abs(there - stated) <= room * abs(stated)


def _is_same_load(bearing: str, engine: Results, first: float, second: float) -> bool:
    """Return whether the load of a bearing is the same at two angles, of which each has an extreme. [rad]"""
    kind, _, owner = bearing.rpartition(".")
    key = next(
        key
        for key in (f"{kind}_load.{owner}", f"{owner}_load", f"crankpin_load.{owner}", f"joint_force.{owner}")
        if key in engine
    )
    loads = engine.columns_at(np.sort(np.degrees([first, second])), [key])[key]
    return abs(loads[0] - loads[1]) <= 1e-9 * abs(loads[0])


def _codes(results: Results) -> set[str]:
    return {notice.code for notice in results.notices}


def _unit(key: str) -> str:
    word = key.partition(".")[0]
    if word not in QUANTITIES and word.endswith("_angle"):
        return "deg"
    quantity = QUANTITIES.get(base_key(key))
    return "" if quantity is None else quantity.unit


def _scales(results: Results) -> dict[str, float]:
    """Return the largest value of every unit, of angles a turn."""
    scales = {"": 1.0}
    tables = [results.summary, results.columns, *(listing.columns for listing in results.listings.values())]
    for table in tables:
        for key, value in table.items():
            values = np.abs(np.append(np.asarray(value, dtype=float), 0.0))
            scales[_unit(key)] = max(scales.get(_unit(key), 0.0), float(np.nanmax(values)))
    return scales


def _without_noise(key: str, values: Mapping[str, Any], limit: float, scales: Mapping[str, float]) -> Any:
    """Return a value, zero where it is the direction or the ratio of nothing."""
    value = np.asarray(values[key], dtype=float)
    of_extreme = key.replace("_angle", "") if "_angle" in key else ""
    size = {
        "free_force_direction": "free_force", "harmonic_phase": "harmonic_amplitude",
        "total_harmonic_phase": "total_harmonic_amplitude",
        "bearing_load_ratio": "bearing_load_max",
    }.get(key, of_extreme)  # fmt: skip
    return np.where(np.abs(values[size]) <= 1e3 * limit * scales[_unit(size)], 0.0, value) if size in values else value
