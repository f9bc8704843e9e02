"""Engines written out as linkages, and what may be done to the text of a linkage without making it another machine."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Mapping
from typing import Any

import numpy as np

from crankwork.analysis.results import Listing, Results
from crankwork.description.written import key_text, toml
from crankwork.quantities import QUANTITIES, base_key


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


def renamed(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a linkage whose links, joints, guides and chambers have other names."""
    kinds = ("fixed_points", "links", "guides", "sliders", "positions", "chambers")
    names = [name for kind in kinds for name in values.get(kind, {})]
    names += [values["crank"]["pin"], *values["crank"].get("points", {})]
    names += [point for link in values["links"].values() for point in link.get("points", {})]
    new = {name: f"q{(37 * number) % 101}.{number}".replace(".", "") for number, name in enumerate(names)}

    def other(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {new.get(key, key): other(item) for key, item in value.items()}
        if isinstance(value, list):
            return [other(item) for item in value]
        return new.get(value, value) if isinstance(value, str) else value

    result = dict(values)
    for kind in kinds:
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


def differences(engine: Results, form: Results, limit: float = 1e-9) -> list[str]:
    """Return where the results of an engine and of its form differ, without those of a calculated cycle."""
    lost, scales = of_cycle(engine), _scales(engine)
    pairs = [("summary", engine.summary, form.summary), ("column", engine.columns, form.columns)]
    empty = Listing({})
    pairs += [
        (f"listing {name}", listing.columns, form.listings.get(name, empty).columns)
        for name, listing in engine.listings.items()
    ]
    found = [f"listing {name}" for name in engine.listings.keys() ^ form.listings.keys()]
    for kind, own, other in pairs:
        found += [f"{kind} {key}" for key in (own.keys() ^ other.keys()) - lost]
        for key in own.keys() & other.keys() - lost:
            first, second = (_without_noise(key, values, limit, scales) for values in (own, other))
            scale = limit * scales.get(_unit(key), 1.0)
            same = first.shape == second.shape and np.allclose(first, second, rtol=0, atol=scale, equal_nan=True)
            found += [] if same else [f"{kind} {key}: {own[key]} is {other[key]}"]
    found += [f"check {key}" for key in (engine.checks.keys() ^ form.checks.keys()) - lost]
    return found + [
        f"check {key}: {value}" for key, value in form.checks.items() if value > form.allowed.get(key, limit)
    ]


def of_cycle(results: Results) -> set[str]:
    """Return the keys that a calculated cycle adds to the results of its engine."""
    space = getattr(results.solved, "space", None)
    found = set() if space is None or space.calculated is None else set(space.calculated.values)
    return (found | {key for key in results.summary if key.endswith(".cycle")}) - {"indicated_mean_pressure"}


def _unit(key: str) -> str:
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
    """Return a value, zero where it is the direction or the ratio of nothing; directions repeat after half a turn."""
    value = np.asarray(values[key], dtype=float)
    of_extreme = key.replace("_angle", "") if "_angle" in key else ""
    size = {
        "free_force_direction": "free_force", "harmonic_phase": "harmonic_amplitude",
        "bearing_load_ratio": "bearing_load_max",
    }.get(key, of_extreme)  # fmt: skip
    value = np.cos(2 * value) if size in values and key != "bearing_load_ratio" else value
    return np.where(np.abs(values[size]) <= 1e3 * limit * scales[_unit(size)], 0.0, value) if size in values else value
