"""What may be added to a machine by one choice: tables with values to begin with, of the size of the machine."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description
from crankwork.description.kinds import Measure, Quantity, Reader
from crankwork.description.machine_file import file_keys, parse, template, template_names
from crankwork.description.schema import Table
from crankwork.description.written import with_entry
from crankwork.locale import Language, say
from crankwork.studio.form import first_value
from crankwork.units import from_si

LETTERS = "BCDEFGHIJKLMNPQRSTUVWXYZ"
# rated powers of asynchronous motors [kW] (IEC 60072-1)
_POWERS = (0.06, 0.09, 0.12, 0.18, 0.25, 0.37, 0.55, 0.75, 1.1, 1.5, 2.2, 3, 4, 5.5, 7.5, 11, 15, 18.5, 22, 30, 37, 45,
           55, 75, 90, 110, 132, 160, 200, 250, 315, 355, 400, 500, 1000)  # fmt: skip
_RATED_SPEED = 1430.0
# a steel bar 25 mm square [kg/m]
_BAR = 5.0
_FORCE = 100.0
_TABLES = ("motor", "flywheel", "transient", "piston", "cylinder", "gas", "engine", "bearings", "balance")


class Addition(NamedTuple):
    """What is added: its text, what stands in it, and its values by key; a key that ends with [] is an entry more."""

    name: str
    of: str
    fields: Mapping[str, Any]

    @property
    def key(self) -> str:
        """What a page calls it."""
        return f"{self.name}:{self.of}"

    def told(self, language: Language) -> str:
        """Return what it is called: a part of its own by its words, a table of the file by what that means."""
        if self.name in _TABLES:
            return say(f"fields.file.{self.name}", language)
        return say(f"studio.add_{self.name}", language, of=self.of)


def additions(description: Description, results: Results | None) -> list[Addition]:
    """Return what may be added to a machine; what needs its motion or torque only where it has results."""
    if results is None and not description.is_readable:
        return []
    values = description.values
    is_linkage = "chambers" in file_keys(values).keys
    found = [*(_of_linkage(values, results) if is_linkage else ()), *_sections(values, results)]
    return [one for one in found if one.fields]


def with_addition(description: Description, one: Addition) -> Description:
    """Return a machine file with an addition."""
    text = description.dump()
    for key, value in one.fields.items():
        if key.endswith("[]"):
            text = with_entry(text, key[:-2], value)
        else:
            changed = Description(text, description.name, folder=description.folder)
            changed[key] = value
            text = changed.dump()
    return Description(text, description.name, folder=description.folder)


def _of_linkage(values: Mapping[str, Any], results: Results | None) -> Iterator[Addition]:
    crank, links = values.get("crank", {}), values.get("links", {})
    grounded = values.get("fixed_points", {})
    size, unit = _size(crank)
    parts = [crank, *links.values(), *values.get("sliders", {}).values()]
    moving = [name for name in dict.fromkeys(name for one in parts for name in _points(one)) if name not in grounded]
    yield Addition("masses", "", dict(_masses(values)))
    for link in list(links)[::-1]:
        torque = f"{_round(_FORCE * size, 1):g} N*m"
        yield Addition("torque", link, {"loads[]": {"kind": "torque", "link": link, "torque": f"-{torque}"}})
    for point in moving[::-1]:
        x, y = (f"-{_FORCE:g} N", "0 N") if _goes_across(results, point) else ("0 N", f"-{_FORCE:g} N")
        force = {"kind": "force", "point": point, "x": x, "y": y}
        yield Addition("force", point, {"loads[]": force})
    for point in moving[::-1]:
        near = {name for one in parts if point in (held := [*_points(one), one.get("pivot")]) for name in held}
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
    yield Addition("friction", "", dict(_rubbing(values, size, unit)) if "friction" not in values else {})
    for name, one in {"crank": crank, **links}.items():
        path = "crank" if name == "crank" else f"links.{name}"
        long = size if name == "crank" else _si(one.get("length"))
        place = [_length(long / 2, unit), _length(long / 4, unit)]
        yield Addition("point", name, {f"{path}.points.{_free_names(values)[0]}": place} if long else {})
    if results is not None:
        for point in moving[::-1]:
            yield from _dyads(values, results, point, unit)


def _goes_across(results: Results | None, point: str) -> bool:
    """Return whether a point goes farther across than up, so that a force along x does the work."""
    if results is None or f"point_x.{point}" not in results:
        return False
    x, y = (float(np.ptp(results[f"point_{axis}.{point}"])) for axis in "xy")
    return x > y


def _masses(values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield mass, centre and inertia of links as of bars of steel, of sliding pieces as of a link."""
    links = values.get("links", {})
    longest = 0.0
    for name, one in links.items():
        long = _si(one.get("length"))
        longest = max(longest, long)
        if "mass" in one or not long:
            continue
        unit = _unit(one["length"])
        mass = _round(_BAR * long, 2)
        yield f"links.{name}.mass", f"{mass:g} kg"
        inertia = mass * long**2 / 12
        of = "kg*m2" if inertia > 0.01 else "kg*cm2"
        yield f"links.{name}.inertia", f"{_round(float(from_si(inertia, of)), 2):g} {of}"
        yield f"links.{name}.centre", [_length(long / 2, unit), f"0 {unit}"]
    for name, one in values.get("sliders", {}).items():
        if "mass" not in one and longest:
            yield f"sliders.{name}.mass", f"{_round(_BAR * longest, 2):g} kg"


def _rubbing(values: Mapping[str, Any], size: float, unit: str) -> Iterator[tuple[str, Any]]:
    crank, links = values.get("crank", {}), values.get("links", {})
    joints = [name for one in links.values() for name in one["joins"]]
    pins = dict.fromkeys([crank.get("pivot"), crank.get("pin"), *joints])
    sliders = values.get("sliders", {})
    ends = [name for name in pins if name and _is_joint(values, name)]
    yield "friction.pins", {name: {"coefficient": 0.1, "radius": _length(size / 10, unit)} for name in ends}
    if sliders:
        yield "friction.sliders", {name: {"coefficient": 0.1} for name in sliders}


def _dyads(values: Mapping[str, Any], results: Results, point: str, unit: str) -> Iterator[Addition]:
    """Yield two links, and a link with a sliding piece, that follow a point wherever it goes."""
    # a pin of three links has another name for each two
    if f"point_x.{point}" not in results.columns or point in values.get("friction", {}).get("pins", {}):
        return
    x, y = (np.asarray(results.column(f"point_{axis}.{point}")) for axis in "xy")
    middle = (float(x.min() + x.max()) / 2, float(y.min() + y.max()) / 2)
    about = float(np.hypot(x - middle[0], y - middle[1]).max())
    joint, pivot = _free_names(values)[:2]
    names = [str(one) for one in range(2, 600) if str(one) not in values.get("links", {})]
    # further from the middle than the point ever is, so that the links reach it everywhere
    far, long, short = 2.5 * about, 2.5 * about, 2.0 * about
    ground = (middle[0] + far, middle[1])
    apart = math.dist(ground, (x[0], y[0]))
    along = (apart**2 + long**2 - short**2) / (2 * apart)
    turn = math.atan2(ground[1] - y[0], ground[0] - x[0]) + math.acos(along / long)
    at = (x[0] + long * math.cos(turn), y[0] + long * math.sin(turn))
    yield Addition("links", point, {
        f"fixed_points.{pivot}": _place(ground, unit),
        f"links.{names[0]}": {"joins": [point, joint], "length": _length(long, unit)},
        f"links.{names[1]}": {"joins": [pivot, joint], "length": _length(short, unit)},
        f"positions.{joint}": _place(at, unit),
    })  # fmt: skip
    guide = next(name for name in (f"g{one}" for one in range(1, 600)) if name not in values.get("guides", {}))
    slid = (x[0] + math.sqrt(long**2 - (middle[1] - y[0]) ** 2), middle[1])
    yield Addition("slider", point, {
        f"links.{names[0]}": {"joins": [point, joint], "length": _length(long, unit)},
        f"guides.{guide}": {"through": _place(middle, unit), "angle": "0 deg"},
        f"sliders.{joint}": {"guide": guide, "pin": joint},
        f"positions.{joint}": _place(slid, unit),
    })  # fmt: skip


def _sections(values: Mapping[str, Any], results: Results | None) -> Iterator[Addition]:
    """Yield the tables that a machine file of this kind may have, as templates state them or of its size."""
    keys = file_keys(values)
    made = {
        "motor": _motor(values, results),
        "flywheel": {"fluctuation": 0.04},
        "transient": _transient(values, results),
    }
    for name in _TABLES:
        entry = keys.keys.get(name)
        if entry is None or name in values or any(one in values for one in entry.instead_of):
            continue
        table = made[name] if name in made else _of_template(keys, name) or _required(entry.kind)
        yield Addition(name, "", {name: table} if table else {})


@functools.cache
def _templates() -> list[Mapping[str, Any]]:
    return [parse(template(one), one) for one in template_names()]


def _of_template(keys: Table, name: str) -> Mapping[str, Any]:
    return next((one[name] for one in _templates() if file_keys(one) is keys and name in one), {})


def _required(kind: object) -> dict[str, Any]:
    if not isinstance(kind, Table):
        return {}
    return {name: first_value(one.kind) for name, one in kind.keys.items() if one.required is True}


def _motor(values: Mapping[str, Any], results: Results | None) -> dict[str, Any]:
    """Return a motor that bears the greatest torque of the crank, and a gear between them."""
    speed = _si(values.get("crank", {}).get("speed"), "speed")
    power = 1e-3 * speed * (_torque(results) or 0.0)
    if not speed:
        return {}
    return {
        "rated_power": f"{next((one for one in _POWERS if one >= power), 1000):g} kW",
        "rated_speed": f"{_RATED_SPEED:g} rpm", "overload": 2.2, "pole_pairs": 2,
        "ratio": _round(_RATED_SPEED / float(from_si(speed, "rpm")), 3),
    }  # fmt: skip


def _transient(values: Mapping[str, Any], results: Results | None) -> dict[str, Any]:
    """Return the start of a machine from rest, some turns long."""
    speed = _si(values.get("crank", {}).get("speed"), "speed")
    parts = [values.get("crank", {}), *values.get("links", {}).values(), *values.get("sliders", {}).values()]
    if not speed or not any("mass" in one for one in parts):
        return {}
    found: dict[str, Any] = {"time": f"{_round(10 * math.tau / speed, 2):g} s"}
    if "motor" not in values:
        found["torque"] = f"{_round(_torque(results) or _FORCE, 2):g} N*m"
    return found


def _torque(results: Results | None) -> float | None:
    """Return the greatest torque that drives [N·m]"""
    found = {} if results is None else results.summary
    ends = [abs(found[key]) for key in ("driving_torque_max", "driving_torque_min") if key in found]
    return max(ends, default=None)


def _free(results: Results | None, pivot: str, point: str, values: Mapping[str, Any], size: float) -> float:
    """Return how far a point is from a pivot at first; a spring of that length does not pull there [m]"""
    if results is None or f"point_x.{point}" not in results.columns:
        return size
    at = [float(np.asarray(results.column(f"point_{axis}.{point}"))[0]) for axis in "xy"]
    return math.dist(at, [_si(one) for one in values.get("fixed_points", {}).get(pivot, ("0 m", "0 m"))])


def _free_names(values: Mapping[str, Any]) -> list[str]:
    """Return letters that no point has yet."""
    used = {*values.get("fixed_points", {}), *values.get("sliders", {})}
    for table in ("links", "sliders", "geared"):
        used.update(name for one in values.get(table, {}).values() for name in _points(one))
    used.update(_points(values.get("crank", {})))
    return [one for one in (*LETTERS, *(f"P{number}" for number in range(1, 600))) if one not in used]


def _points(link: Mapping[str, Any]) -> list[str]:
    return [*link.get("joins", ()), *([link["pin"]] if "pin" in link else ()), *link.get("points", {})]


def _is_joint(values: Mapping[str, Any], name: str) -> bool:
    """Return whether one revolute joint is at a point: two links meet there, or one and the ground."""
    crank = values.get("crank", {})
    held = [one["joins"] for one in values.get("links", {}).values()]
    held += [[crank.get("pivot"), crank.get("pin")], list(values.get("fixed_points", {}))]
    held += [[one.get("pin")] for one in values.get("sliders", {}).values()]
    return sum(name in one for one in held) == 2


def _size(crank: Mapping[str, Any]) -> tuple[float, str]:
    """Return the radius of the crank, and the unit that it is stated in [m]"""
    stated = crank.get("radius")
    return _si(stated) or 0.1, _unit(stated)


def _read(stated: object, dimension: str) -> Measure | None:
    return Quantity((dimension,), -1e6, 1e6).read(stated, "", Reader(decimal_comma=True))


def _unit(stated: object) -> str:
    """Return the unit in which a length is stated."""
    found = _read(stated, "length")
    return found.unit if found else "mm"


def _si(stated: object, dimension: str = "length") -> float:
    """Return a stated number in SI, 0 where there is none."""
    found = _read(stated, dimension)
    return found.value if found else 0.0


def _round(number: float, digits: int) -> float:
    return float(f"{number:.{digits}g}")


def _length(length: float, unit: str) -> str:
    # no -0
    return f"{_round(float(from_si(length, unit)), 4) + 0.0:g} {unit}"


def _place(at: tuple[float, float], unit: str) -> list[str]:
    return [_length(one, unit) for one in at]
