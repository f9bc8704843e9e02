"""A machine file as a form: its fields with meanings and values, and what may be added in proportion to the machine."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description, single_kind
from crankwork.description.keys import LOADING
from crankwork.description.machine_file import entry_at, file_keys, idle_keys, parse, steps_of, template, template_names
from crankwork.description.schema import DefaultBy, KeySpec, ListOf, NameOr, NumberOr, TableSpec, Values, WordOr
from crankwork.description.shorthand import linkage_of
from crankwork.description.toml_edit import toml, with_table_entry
from crankwork.description.value_types import Choice, Flag, MeasuredValue, Number, Quantity, Reader, Text
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES, Language, capital, decimal, translate
from crankwork.locale.numbers import unit_name
from crankwork.units import EXAMPLES, from_si

_NUMBER = re.compile(r"\s*[+-]?[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?\s*")
_COMMA = re.compile(r"(\s*[+-]?[0-9]+),([0-9]+)(?![0-9.,])")
_THOUSANDS = 3
# coordinates of a point by index
_AXES = {"1]": "x", "2]": "y"}
# fields of titles in a language, whose keys are no words
_TITLES = tuple(f"_{language}" for language in LANGUAGES)
_LEAVES = (Quantity, Number, NumberOr, WordOr, Choice, Flag, Text)
LETTERS = "BCDEFGHIJKLMNPQRSTUVWXYZ"
# rated powers of asynchronous motors [kW] (IEC 60072-1)
_POWERS = (0.06, 0.09, 0.12, 0.18, 0.25, 0.37, 0.55, 0.75, 1.1, 1.5, 2.2, 3, 4, 5.5, 7.5, 11, 15, 18.5, 22, 30, 37, 45,
           55, 75, 90, 110, 132, 160, 200, 250, 315, 355, 400, 500, 1000)  # fmt: skip
_RATED_SPEED = 1430.0
# a steel bar 25 mm square [kg/m]
_BAR = 5.0
_FORCE = 100.0
_TABLES = ("motor", "flywheel", "transient", "piston", "cylinder", "gas", "engine", "bearings", "balance")


def form(description: Description, language: Language) -> list[dict[str, Any]]:
    """Return the tables of a machine file in order, with their fields and those that may be added."""
    values = description.values
    kinds = file_keys(values)
    groups: dict[str, dict[str, Any]] = {}
    for key in _keys(description, kinds):
        path, table, entry = _place(kinds, key)
        means = _meaning(kinds, path, language)
        fresh = {"path": path, "means": means, "label": _heading(kinds, path, language), "rows": [], "more": []}
        group = groups.setdefault(path, fresh)
        group["rows"].append(_row(description, key, table, entry, language))
    idle = idle_keys(kinds, kinds.read(values, "", Reader.of(values)) or Values({}, kinds))
    for path, group in groups.items():
        table, stated = _kind(kinds, path), _stated(values, path)
        if isinstance(table, TableSpec):
            more = _more(table, path, stated, language)
            group["more"] = [row for row in more if row["key"] not in idle]
    # what stands on title pages is of no interest while the machine changes
    return sorted(groups.values(), key=lambda group: group["path"] == "document")


def _keys(description: Description, kinds: TableSpec) -> Iterator[str]:
    """Yield the keys of the fields of the machine; a point has one for each coordinate."""
    for key in description:
        match _kind(kinds, key), description[key]:
            case _ if key == "format":
                pass
            case ((ListOf(Quantity(), 2, 2) | NameOr(ListOf(Quantity(), 2, 2))), [_, _]):
                yield from (f"{key}[{number}]" for number in (1, 2))
            case _:
                yield key


def _place(kinds: TableSpec, key: str) -> tuple[str, object, KeySpec | None]:
    """Return the table of a key, its specification, and that of the key."""
    path, _, name = key.rpartition(".")
    table = _kind(kinds, path)
    return path, table, table.keys.get(name) if isinstance(table, TableSpec) else None


def _kind(kinds: object, path: str) -> object:
    return functools.reduce(entry_at, steps_of(path) if path else (), kinds)


def _stated(values: Mapping[str, Any], path: str) -> Mapping[str, Any]:
    table: Any = values
    for step in steps_of(path) if path else ():
        table = table[step - 1] if isinstance(step, int) else table.get(step, {})
    return table if isinstance(table, Mapping) else {}


def _meaning(kinds: TableSpec, path: str, language: Language) -> str:
    around, _, name = path.rpartition(".")
    table = _kind(kinds, around)
    return table.meaning(name, language) if path and isinstance(table, TableSpec) else ""


def _row(
    description: Description, key: str, table: object, entry: KeySpec | None, language: Language
) -> dict[str, Any]:
    """Return a field: key, name, meaning, value and how it can be changed."""
    name, stated = key.rpartition(".")[2], description[key]
    kind = entry.kind if entry else _kind(file_keys(description.values), key)
    name, bracket, number = name.partition("[")
    means = table.meaning(name, language) if isinstance(table, TableSpec) else ""
    axis = f", {_AXES[number]}" if bracket else ""
    label = _label(name, means, language)
    row: dict[str, Any] = {"key": key, "name": name + axis, "label": label + axis, "value": _written(kind, stated)}
    if means and means != label:
        row["means"] = means
    match kind:
        case Choice():
            row["options"] = list(map(str, kind.options))
        case Flag():
            row["options"] = ["false", "true"]
        case _:
            row |= _slid(kind, stated)
    if "number" in row:
        number_text, after = row["value"].removesuffix(row["after"]), row["after"].strip()
        row["shown"] = decimal(number_text, language)
        row["suffix"] = unit_name(row["unit"], language) if after.isascii() and " " not in after else after
    return row


def _written(kind: object, stated: object) -> str:
    """Return the value of a field as text, names separated by commas."""
    if isinstance(kind, ListOf) and isinstance(kind.entry, Text) and isinstance(stated, list):
        names = list(map(str, stated))
        if not any("," in name for name in names):
            return ", ".join(names)
    return stated if isinstance(stated, str) else toml(stated)


def _slid(kind: object, stated: object) -> dict[str, Any]:
    """Return the data of a field's slider: number, unit and limits; empty if it has none."""
    match single_kind(kind, stated), stated:
        case Quantity() as numeric, str():
            measure = numeric.read(stated, "", Reader())
            if isinstance(measure, MeasuredValue):
                low, high = (float(from_si(end, measure.unit)) for end in (numeric.low, numeric.high))
                return {"number": float(from_si(measure.value, measure.unit)), "unit": measure.unit,
                        "after": _after(stated), "low": low, "high": high}  # fmt: skip
        case Number() as numeric, int() | float() if not isinstance(stated, bool):
            slider = {"number": float(stated), "unit": "", "after": "", "low": numeric.low, "high": numeric.high}
            return slider | ({"whole": True} if numeric.whole else {})
    return {}


def _label(name: str, means: str, language: Language) -> str:
    """Return the label of a field: its key as words in English, otherwise the beginning of its meaning."""
    first = re.split(r"[;:(,]| – | \w+ \[", means)[0].strip()
    if first[:1].isalpha() and (language != "en" or name.endswith(_TITLES)):
        return capital(first)
    return capital(name.replace("_", " ")) if means else name


def _heading(kinds: TableSpec, path: str, language: Language) -> str:
    """Return the heading of a table, with the names of the user in it."""
    around, shown = "", []
    for part in path.split("."):
        name, _, number = part.partition("[")
        own = _label(name, _meaning(kinds, f"{around}.{name}".lstrip("."), language), language)
        shown.append(f"{own} {number}".rstrip("] "))
        around = f"{around}.{part}".lstrip(".")
    return " · ".join(shown)


def _after(stated: str) -> str:
    """Return the text after the number: unit and tolerance."""
    match = _NUMBER.match(stated)
    return f" {stated[match.end() :]}" if match else ""


def _more(table: TableSpec, path: str, stated: Mapping[str, Any], language: Language) -> Iterator[dict[str, Any]]:
    """Yield the fields that may be added to a table, each with an initial value."""
    for name, entry in table.keys.items():
        excluded = any(other in stated for other in entry.instead_of)
        fits = all(stated.get(key) in allowed if allowed else key in stated for key, allowed in entry.only.items())
        if name in stated or excluded or not fits or not isinstance(entry.kind, _LEAVES):
            continue
        first = (
            first_value(entry.kind) if entry.default is None or isinstance(entry.default, DefaultBy) else entry.default
        )
        written, means = first if isinstance(first, str) else toml(first), table.meaning(name, language)
        row: dict[str, Any] = {"key": f"{path}.{name}".lstrip("."), "name": name, "value": written,
                               "means": means, "label": _label(name, means, language)}  # fmt: skip
        if name == "mass" and "centre" in table.keys and "centre" not in stated and "joins" in stated:
            # a mass needs its centre
            row["also"] = {f"{path}.centre": "0.5"}
        yield row


def first_value(kind: object) -> object:
    """Return an initial value of a type."""
    match kind:
        case Quantity(dimensions=("mass", *_)):
            return "1 kg"
        case Quantity():
            return EXAMPLES[kind.dimensions[0]]
        case Number():
            return float(kind.example())
        case Choice():
            return kind.options[0]
        case Flag():
            return True
        case NumberOr(quantity=Quantity()):
            return first_value(kind.quantity)
        case NumberOr():
            return first_value(kind.number)
        case WordOr():
            return first_value(kind.words)
    return "..."


def stated_text(description: Description, key: str, typed: str, language: Language = "en") -> object:
    """Parse text typed into a field: text if the field holds text, otherwise TOML.

    A bare number gets the unit of the field, and a comma is a decimal comma unless it may separate thousands.
    """
    kind = single_kind(_kind(file_keys(description.values), key), description.get(key))
    if isinstance(kind, Text):
        return typed
    if isinstance(kind, ListOf) and isinstance(kind.entry, Text) and not typed.lstrip().startswith("["):
        return [text.strip() for text in typed.split(",")]
    if isinstance(kind, Quantity | Number):
        comma = _COMMA.match(typed)
        if comma and description.get("decimal_mark") != "," and (language != "en" or len(comma[2]) != _THOUSANDS):
            typed = f"{comma[1]}.{comma[2]}{typed[comma.end() :]}"
        stated = description.get(key)
        if isinstance(stated, str) and _NUMBER.fullmatch(typed):
            typed = typed.strip() + _after(stated)
    values: dict[str, Any]
    try:
        values = Description(f"value = {typed}\n").values if "\n" not in typed else {}
    except CrankworkError:
        return typed
    return values.get("value", typed)


class Addition(NamedTuple):
    """An addition: its kind, the part it is added to, and values by key; a key that ends with [] appends an entry."""

    name: str
    target: str
    fields: Mapping[str, Any]

    @property
    def key(self) -> str:
        """Identifier in the page."""
        return f"{self.name}:{self.target}"

    def label(self, language: Language) -> str:
        """Return the label: of a table of the file its meaning, otherwise a text of its own."""
        if self.name in _TABLES:
            return translate(f"fields.file.{self.name}", language)
        return translate(f"studio.add_{self.name}", language, of=self.target)


def additions(description: Description, results: Results | None) -> list[Addition]:
    """Return the additions to a machine; some need its motion or torque, so its results."""
    if results is None and not description.is_readable:
        return []
    values = description.values
    keys = file_keys(values).keys
    added = list(_sections(values, results))
    if "chambers" in keys:
        added = [*_of_linkage(values, results), *added]
    elif "rod" in keys and results is not None and results.method.is_exact:
        parts = _of_linkage(linkage_of(description), results)
        # the file of an engine has only these tables of a linkage
        added += (part for part in parts if all(re.split(r"[.[]", key)[0] in LOADING for key in part.fields))
    return [addition for addition in added if addition.fields]


def with_addition(description: Description, addition: Addition) -> Description:
    """Return a machine file with an addition."""
    text = description.dump()
    for key, value in addition.fields.items():
        if key.endswith("[]"):
            text = with_table_entry(text, key[:-2], value)
        else:
            changed = Description(text, description.name, folder=description.folder)
            changed[key] = value
            text = changed.dump()
    return Description(text, description.name, folder=description.folder)


def _of_linkage(values: Mapping[str, Any], results: Results | None) -> Iterator[Addition]:
    crank, links = values.get("crank", {}), values.get("links", {})
    grounded = values.get("fixed_points", {})
    size, unit = _si(crank.get("radius")) or 0.1, _unit(crank.get("radius"))
    parts = [crank, *links.values(), *values.get("sliders", {}).values()]
    moving = [name for name in dict.fromkeys(name for part in parts for name in _points(part)) if name not in grounded]
    yield Addition("masses", "", dict(_masses(values)))
    for link in list(links)[::-1]:
        torque = f"{_round(_FORCE * size, 1):g} N*m"
        yield Addition("torque", link, {"loads[]": {"kind": "torque", "link": link, "torque": f"-{torque}"}})
    for point in moving[::-1]:
        x, y = (f"-{_FORCE:g} N", "0 N") if _is_wide(results, point) else ("0 N", f"-{_FORCE:g} N")
        force = {"kind": "force", "point": point, "x": x, "y": y}
        yield Addition("force", point, {"loads[]": force})
    for point in moving[::-1]:
        near = {name for part in parts if point in (joints := [*_points(part), part.get("pivot")]) for name in joints}
        ends = next(([name, point] for name in grounded if name not in near), None)
        if ends is not None:
            free = _length(_free(results, ends[0], point, values, size), unit)
            spring = {"kind": "spring", "between": ends, "stiffness": "1 N/mm", "free_length": free}
            yield Addition("spring", point, {"loads[]": spring})
            yield Addition("damper", point, {"loads[]": {"kind": "damper", "between": ends, "damping": "10 N*s/m"}})
    for slider in values.get("sliders", {}):
        yield Addition("process", slider, {"loads[]": {
            "kind": "process", "slider": slider, "against": "angle", "at": ["0 deg", "180 deg", "360 deg"],
            "force": ["0 N", f"{_FORCE:g} N", "0 N"]}})  # fmt: skip
    if not values.get("method", {}).get("weights"):
        yield Addition("weights", "", {"method.weights": True})
    yield Addition("friction", "", dict(_friction(values, size, unit)) if "friction" not in values else {})
    for name, entry in {"crank": crank, **links}.items():
        path = "crank" if name == "crank" else f"links.{name}"
        long = size if name == "crank" else _si(entry.get("length"))
        place = [_length(long / 2, unit), _length(long / 4, unit)]
        yield Addition("point", name, {f"{path}.points.{_free_names(values)[0]}": place} if long else {})
    if results is not None:
        for point in moving[::-1]:
            yield from _dyads(values, results, point, unit)


def _is_wide(results: Results | None, point: str) -> bool:
    """Return whether a point moves farther along x than along y, so that a force along x does more work."""
    if results is None or f"point_x.{point}" not in results:
        return False
    x, y = (float(np.ptp(results[f"point_{axis}.{point}"])) for axis in "xy")
    return x > y


def _masses(values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield mass, centre and inertia of links as steel bars, and masses of sliders."""
    links = values.get("links", {})
    longest = 0.0
    for name, part in links.items():
        length = _si(part.get("length"))
        longest = max(longest, length)
        if "mass" in part or not length:
            continue
        unit = _unit(part["length"])
        mass = _round(_BAR * length, 2)
        yield f"links.{name}.mass", f"{mass:g} kg"
        inertia = mass * length**2 / 12
        inertia_unit = "kg*m2" if inertia > 0.01 else "kg*cm2"
        yield f"links.{name}.inertia", f"{_round(float(from_si(inertia, inertia_unit)), 2):g} {inertia_unit}"
        yield f"links.{name}.centre", [_length(length / 2, unit), f"0 {unit}"]
    for name, part in values.get("sliders", {}).items():
        if "mass" not in part and longest:
            yield f"sliders.{name}.mass", f"{_round(_BAR * longest, 2):g} kg"


def _friction(values: Mapping[str, Any], size: float, unit: str) -> Iterator[tuple[str, Any]]:
    crank, links = values.get("crank", {}), values.get("links", {})
    joints = [name for link in links.values() for name in link["joins"]]
    pins = dict.fromkeys([crank.get("pivot"), crank.get("pin"), *joints])
    sliders = values.get("sliders", {})
    ends = [name for name in pins if name and _is_joint(values, name)]
    if "efficiency" in values and "losses" not in values["efficiency"]:
        # friction counts in addition to it
        yield "efficiency.losses", "drive"
    yield "friction.pins", {name: {"coefficient": 0.1, "radius": _length(size / 10, unit)} for name in ends}
    if sliders:
        yield "friction.sliders", {name: {"coefficient": 0.1} for name in sliders}


def _dyads(values: Mapping[str, Any], results: Results, point: str, unit: str) -> Iterator[Addition]:
    """Yield a dyad of two links, and one of a link and a slider, that can follow a point everywhere."""
    # a pin of three links has a name for each pair
    if f"point_x.{point}" not in results.columns or point in values.get("friction", {}).get("pins", {}):
        return
    x, y = (np.asarray(results.column(f"point_{axis}.{point}")) for axis in "xy")
    middle = (float(x.min() + x.max()) / 2, float(y.min() + y.max()) / 2)
    about = float(np.hypot(x - middle[0], y - middle[1]).max())
    joint, pivot = _free_names(values)[:2]
    names = [str(number) for number in range(2, 600) if str(number) not in values.get("links", {})]
    # longer than the distance of the point from the middle, so that the links reach it everywhere
    far, long, short = 2.5 * about, 2.5 * about, 2.0 * about
    ground = (middle[0] + far, middle[1])
    distance = math.dist(ground, (x[0], y[0]))
    along = (distance**2 + long**2 - short**2) / (2 * distance)
    turn = math.atan2(ground[1] - y[0], ground[0] - x[0]) + math.acos(along / long)
    placed = (x[0] + long * math.cos(turn), y[0] + long * math.sin(turn))
    yield Addition("links", point, {
        f"fixed_points.{pivot}": _written_place(ground, unit),
        f"links.{names[0]}": {"joins": [point, joint], "length": _length(long, unit)},
        f"links.{names[1]}": {"joins": [pivot, joint], "length": _length(short, unit)},
        f"positions.{joint}": _written_place(placed, unit),
    })  # fmt: skip
    guide = next(name for name in (f"g{number}" for number in range(1, 600)) if name not in values.get("guides", {}))
    slid = (x[0] + math.sqrt(long**2 - (middle[1] - y[0]) ** 2), middle[1])
    yield Addition("slider", point, {
        f"links.{names[0]}": {"joins": [point, joint], "length": _length(long, unit)},
        f"guides.{guide}": {"through": _written_place(middle, unit), "angle": "0 deg"},
        f"sliders.{joint}": {"guide": guide, "pin": joint},
        f"positions.{joint}": _written_place(slid, unit),
    })  # fmt: skip


def _sections(values: Mapping[str, Any], results: Results | None) -> Iterator[Addition]:
    """Yield the tables that the machine file may have, as a template states them or of the size of the machine."""
    keys = file_keys(values)
    made = {
        "motor": _motor(values, results),
        "flywheel": {"fluctuation": 0.04},
        "transient": _transient(values, results),
    }
    for name in _TABLES:
        entry = keys.keys.get(name)
        if entry is None or name in values or any(key in values for key in entry.instead_of):
            continue
        if name in LOADING and results is not None and not results.method.is_exact:
            continue
        table = made[name] if name in made else _of_template(keys, name) or _required(entry.kind)
        yield Addition(name, "", {name: table} if table else {})


@functools.cache
def _templates() -> list[Mapping[str, Any]]:
    return [parse(template(name), name) for name in template_names()]


def _of_template(keys: TableSpec, name: str) -> Mapping[str, Any]:
    machines = (values for values in _templates() if file_keys(values).keys.get(name) is keys.keys[name])
    return next((values[name] for values in machines if name in values), {})


def _required(kind: object) -> dict[str, Any]:
    if not isinstance(kind, TableSpec):
        return {}
    return {name: first_value(field.kind) for name, field in kind.keys.items() if field.required is True}


def _motor(values: Mapping[str, Any], results: Results | None) -> dict[str, Any]:
    """Return a motor rated for the greatest torque of the crank, and a gear between them."""
    speed = _si(values.get("crank", {}).get("speed"), "speed")
    power = 1e-3 * speed * (_torque(results) or 0.0)
    if not speed or _mean_torque(results) > 0:
        return {}
    return {
        "rated_power": f"{next((rating for rating in _POWERS if rating >= power), 1000):g} kW",
        "rated_speed": f"{_RATED_SPEED:g} rpm", "overload": 2.2, "pole_pairs": 2,
        "ratio": _round(_RATED_SPEED / float(from_si(speed, "rpm")), 3),
    }  # fmt: skip


def _transient(values: Mapping[str, Any], results: Results | None) -> dict[str, Any]:
    """Return a start of the machine from rest, or an engine at its speed, over some turns."""
    speed = _si(values.get("crank", {}).get("speed"), "speed")
    parts = [values.get("crank", {}), *values.get("links", {}).values(), *values.get("sliders", {}).values()]
    parts += [values.get(part, {}) for part in ("rod", "piston")]
    if not speed or not any("mass" in part for part in parts):
        return {}
    settings: dict[str, Any] = {"time": f"{_round(10 * math.tau / speed, 2):g} s"}
    if "rod" in values:
        # an engine goes on at its speed, against what it gives or with what it takes
        settings["speed"] = values["crank"]["speed"]
        torque = _mean_torque(results)
        return settings | ({"torque": f"{_round(-torque, 3):g} N*m"} if torque and "motor" not in values else {})
    if "motor" not in values:
        settings["torque"] = f"{_round(_torque(results) or _FORCE, 2):g} N*m"
    return settings


def _torque(results: Results | None) -> float | None:
    """Return the largest torque of the crank by magnitude. [N·m]"""
    summary = {} if results is None else results.summary
    for torque in ("driving_torque", "total_torque", "crank_torque"):
        if f"{torque}_max" in summary:
            return max(abs(summary[f"{torque}_{end}"]) for end in ("max", "min"))
    return None


def _mean_torque(results: Results | None) -> float:
    """Return the mean torque that an engine gives, negative where it is driven; 0 for other machines. [N·m]"""
    if results is None or results.machine.lengths is None or "mean_torque" not in results.trace:
        return 0.0
    mean = results.trace["mean_torque"]
    return -mean.value if mean.key == "mean_driving_torque" else mean.value


def _free(results: Results | None, pivot: str, point: str, values: Mapping[str, Any], size: float) -> float:
    """Return the initial distance of a point from a pivot, the free length of a spring between them. [m]"""
    if results is not None and f"point_x.{point}" in results.columns:
        position = [float(np.asarray(results.column(f"point_{axis}.{point}"))[0]) for axis in "xy"]
    elif point in values.get("positions", {}):
        position = [_si(coordinate) for coordinate in values["positions"][point]]
    else:
        return size
    ground = values.get("fixed_points", {}).get(pivot, ("0 m", "0 m"))
    return math.dist(position, map(_si, ground))


def _free_names(values: Mapping[str, Any]) -> list[str]:
    """Return names that no point has yet."""
    used = {*values.get("fixed_points", {}), *values.get("sliders", {})}
    for table in ("links", "sliders", "geared"):
        used.update(name for link in values.get(table, {}).values() for name in _points(link))
    used.update(_points(values.get("crank", {})))
    return [name for name in (*LETTERS, *(f"P{number}" for number in range(1, 600))) if name not in used]


def _points(link: Mapping[str, Any]) -> list[str]:
    return [*link.get("joins", ()), *([link["pin"]] if "pin" in link else ()), *link.get("points", {})]


def _is_joint(values: Mapping[str, Any], name: str) -> bool:
    """Return whether there is exactly one revolute joint at a point: two links meet there, or one and the ground."""
    crank = values.get("crank", {})
    bodies = [part for table in ("links", "sliders", "geared") for part in values.get(table, {}).values()]
    held = [[crank.get("pivot"), *_points(crank)], list(values.get("fixed_points", {})), *map(_points, bodies)]
    return sum(name in names for names in held) == 2


def _read(stated: object, dimension: str) -> MeasuredValue | None:
    return Quantity((dimension,), -1e6, 1e6).read(stated, "", Reader(decimal_comma=True))


def _unit(stated: object) -> str:
    """Return the unit of a length."""
    measure = _read(stated, "length")
    return measure.unit if measure else "mm"


def _si(stated: object, dimension: str = "length") -> float:
    """Return a number in SI, 0 if there is none."""
    measure = _read(stated, dimension)
    return measure.value if measure else 0.0


def _round(number: float, digits: int) -> float:
    return float(f"{number:.{digits}g}")


def _length(length: float, unit: str) -> str:
    # no -0
    return f"{_round(float(from_si(length, unit)), 4) + 0.0:g} {unit}"


def _written_place(position: tuple[float, float], unit: str) -> list[str]:
    return [_length(coordinate, unit) for coordinate in position]
