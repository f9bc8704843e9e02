"""Sketches: a linkage drawn with the mouse as a machine file, and the dimensions and dyads that can be dragged.

Pins are in millimetres, links join pins. A linkage shared by PMKS+, as a link or a file, is a sketch too: the text has
fields between points, settings, pins, links, forces. Numbers are in base 64, negative ones with a leading zero, lengths
and angles in thousandths.
"""

from __future__ import annotations

import math
import re
import string
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import takewhile
from typing import Any, NamedTuple
from urllib.parse import unquote

from crankwork.description.document import Description, kind_of
from crankwork.description.keys import LOADING
from crankwork.description.toml_edit import document, with_table_entry
from crankwork.description.value_types import Reader
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import ErrorMessage, Language, in_language, translate
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR, Guide
from crankwork.mechanism.linkage import Linkage, Member
from crankwork.mechanism.mechanism import Crank
from crankwork.mechanism.structure import chain_mobility, structure
from crankwork.studio.form import stated_text
from crankwork.units import from_si, parse

_SPEED = "60 rpm"
_TYPED = (("radius", "length", "mm"), ("start", "angle", "deg"))
_LINK = '[crank]\nradius = "1 mm"\nstart = "0 deg"\n[links]\n'
# mass properties of a link, which may become the crank
_WEIGHS = ("mass", "inertia", "centre")
Written = Callable[[float], str]
_DIGITS = string.digits + string.ascii_uppercase + string.ascii_lowercase + "_-"
# check digit at the end, by the length of the text
_CHECKS = _DIGITS[:62]
_SHARED = re.compile(r"(?:https?://\S*\?)?([\w-]{1,4}\.[\w,-]+\.[\w,-]+\.\w+\.\w+,\S+)")
_UNITS = ("in", "cm", "m")
_FORCES = ("lbf", "N")
_INERTIAS = ("lb*in2", "kg*cm2", "kg*m2")
# default mass and inertia of a link in PMKS+
_UNWEIGHED = (1.0, 1.0)
_CLOCKWISE, _SLIDES, _DRIVES, _GROUND, _WELDED = 1, 1, 2, 4, 8


class Pin(NamedTuple):
    """A pin as drawn, y downward as on screen; on the ground, or sliding in a direction [deg]."""

    name: str
    x: float
    y: float
    ground: bool = False
    slides: float | None = None

    def place(self, written: Written) -> list[str]:
        """Return its coordinates, y upward, as text."""
        return [written(self.x), written(-self.y)]


def sketched(request: Mapping[str, Any], language: Language) -> str:
    """Return the machine file of a sketch: `pins`, and `links` by name as the pins that they join.

    Lengths are those of the drawing, rounded to three digits; the drawn joint positions decide the branches.
    """
    pins, links = _read(request)
    first = _driving(pins, links)
    if first is None:
        raise CrankworkError(ErrorMessage("sketch_no_crank"))
    driving = sorted(links[first], key=lambda name: not pins[name].ground)
    driven = {name: joins for name, joins in links.items() if name != first}
    values = linkage(pins, driving, driven, _millimetres, _SPEED)
    return with_branch_positions({"title": translate("studio.own", language)} | values)


def _driving(pins: Mapping[str, Pin], links: Mapping[str, Sequence[str]]) -> str | None:
    """Return the crank: the first link of two pins, one of them on the ground, that do not slide."""
    pairs = {name: [pins[end] for end in joins] for name, joins in links.items() if len(joins) == 2}
    fixed = (name for name, (a, b) in pairs.items() if a.slides is None and b.slides is None and a.ground != b.ground)
    return next(fixed, None)


def missing(request: Mapping[str, Any], language: Language) -> str:
    """Return mobility and structure of a sketch, and what it lacks to be a machine."""
    pins, links = _read(request)
    if not links:
        return ""
    held = [name for joins in links.values() for name in joins]
    slid = [pin.name for pin in pins.values() if pin.slides is not None]
    fixed = [name for name, pin in pins.items() if pin.ground] + slid
    # a slider on the ground, with a pin to the links
    joints = sum(held.count(name) + fixed.count(name) - 1 for name in {*held}) + len(slid)
    freedom = int(chain_mobility(len(links) + len(slid), joints, 0))
    free_pins = [name for joins in links.values() for name in joins[:2] if held.count(name) == 1 and name not in fixed]
    first = _driving(pins, links)
    if first is None:
        advice = translate("studio.driver_missing", language)
    elif freedom > 1 and free_pins:
        advice = translate(f"studio.loose_{'ground' if freedom > 2 else 'slide'}", language, pin=free_pins[-1])
    elif freedom != 1:
        advice = translate(f"studio.too_{'free' if freedom > 1 else 'stiff'}", language)
    else:
        group, problems = structure(_drawn(first, links, fixed, slid))
        advice = group.formula if group else in_language(problems[0].message, language)
    return f"W = {freedom} · {advice}"


def _drawn(first: str, links: Mapping[str, Sequence[str]], fixed: Sequence[str], slid: Sequence[str]) -> Linkage:
    """Return a sketch as a linkage without lengths."""
    nowhere = (0.0, 0.0)
    crank = next(name for name in links[first] if name not in fixed or name in slid)
    members = [Member(name, dict.fromkeys(joins, nowhere)) for name, joins in links.items() if name != first]
    pieces = [Member(f"{name}-", {name: nowhere}, guide=name) for name in slid]
    ground = {name: nowhere for name in fixed if name not in slid}
    guides = dict.fromkeys(slid, Guide())
    return Linkage(Crank(1.0, pin=crank, link=first), ground, (*members, *pieces), guides, driving=Member(first, {}))


def linkage(
    pins: Mapping[str, Pin], driving: Sequence[str], links: Mapping[str, Sequence[str]], written: Written, speed: str
) -> dict[str, Any]:
    """Return the tables of a machine file from pins by name and links as the pins they join, ends first."""
    grounded = [name for name, drawn in pins.items() if drawn.ground]
    pivot, pin = (pins[name] for name in driving[:2])
    values: dict[str, Any] = {
        "fixed_points": {name: pins[name].place(written) for name in grounded},
        "crank": {"pivot": pivot.name, "pin": pin.name, "radius": _length(pivot, pin, written), "speed": speed,
                  "start": f"{_direction(pivot, pin):.6g} deg"} | _points([pins[name] for name in driving], written),
        "links": {name: {"joins": list(link[:2]), "length": _length(pins[link[0]], pins[link[1]], written)}
                  | _points([pins[name] for name in link], written) for name, link in links.items()},
    }  # fmt: skip
    slid = [piece for piece in pins.values() if piece.slides is not None]
    if slid:
        values["guides"] = {f"g{k}": {"through": piece.place(written), "angle": f"{piece.slides:.4g} deg"}
                            for k, piece in enumerate(slid, start=1)}  # fmt: skip
        values["sliders"] = {piece.name: {"guide": f"g{k}", "pin": piece.name} for k, piece in enumerate(slid, start=1)}
    joined = [name for link in links.values() for name in link]
    fixed = {*driving, *grounded, *(piece.name for piece in slid)}
    free = [name for name in dict.fromkeys(joined) if name not in fixed and joined.count(name) > 1]
    positions = {name: pins[name].place(written) for name in [*free, *(piece.name for piece in slid)]}
    return values | ({"positions": positions} if positions else {})


def with_branch_positions(values: dict[str, Any]) -> str:
    """Return a machine file with only those positions that decide a branch."""
    idle = _idle(Description(document({"format": 2} | values)), "position_unused")
    left = {name: position for name, position in values.get("positions", {}).items() if f"positions.{name}" not in idle}
    kept = {name: table for name, table in values.items() if name != "positions"}
    return document({"format": 2} | kept | ({"positions": left} if left else {}))


def _idle(stated: Description, *kinds: str) -> list[str]:
    """Return the keys of positions with errors or notices of these kinds."""
    try:
        notices = stated.machine().notices
        return [f"positions.{values['name']}" for code, values in notices if code in kinds]
    except InputError as error:
        return [problem.key for problem in error.problems if getattr(problem.message, "name", "") in kinds]
    except CrankworkError:
        pass
    return []


def swapped(stated: Description, name: str, machine: Machine) -> str:
    """Return a machine file with a dyad in its other branch."""
    known = dyads(machine) if machine.linkage else []
    now = next((dyad["branch"] for dyad in known if dyad["name"] == name), None)
    if now is None:
        raise CrankworkError(ErrorMessage("branch_absent", name=name[:60], known=", ".join(stated.get("branch", {}))))
    stated[f"branch.{name}"] = -now
    for key in _idle(stated, "position_unused", "position_idle"):
        del stated[key]
    if stated.get("positions") == {}:
        del stated["positions"]
    return stated.dump()


def measured(typed: Sequence[str], language: Language) -> dict[str, Any]:
    """Return a typed length [mm] and direction [deg], parsed as fields of the file."""
    if len(typed) != len(_TYPED) or not all(isinstance(text, str) for text in typed):
        raise CrankworkError(ErrorMessage("sketch_damaged"))
    stated, values = Description(_LINK), dict[str, Any]()
    for (key, name, unit), text in zip(_TYPED, typed, strict=True):
        if not text:
            continue
        reader, path = Reader(), f"crank.{key}"
        measure = kind_of(stated.values, path).read(stated_text(stated, path, text, language), path, reader)
        if measure is None:
            return {"refusal": in_language(reader.problems[0].message, language)}
        values[name] = float(from_si(measure.value, unit))
    return values


def redrawn(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Return a machine file with the changes from one sketch to the next."""
    weighed = _moved_masses(stated, before, now)
    for table in ("fixed_points", "links", "guides", "sliders", "positions"):
        was, existing = before.get(table, {}), stated.values.get(table, {})
        for name in was:
            if name not in now.get(table, {}) and name in existing:
                del stated[f"{table}.{name}"]
        for name, value in now.get(table, {}).items():
            if name in existing and isinstance(value, Mapping):
                _merge(stated, f"{table}.{name}", was.get(name, {}), value)
            elif value != was.get(name) or name not in existing:
                stated[f"{table}.{name}"] = value
    _merge(stated, "crank", before.get("crank", {}), now["crank"])
    for key, value in weighed.items():
        stated[key] = value
    _delete_removed(stated, before, now)
    return stated.dump()


def _moved_masses(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    """Return the mass properties of a link that becomes the crank, and delete those of the former crank."""
    was, crank = before.get("crank", {}), now["crank"]
    if not was or (was["pivot"], was["pin"]) == (crank["pivot"], crank["pin"]):
        return {}
    joined = [crank["pivot"], crank["pin"]]
    links = before.get("links", {})
    name = next((name for name, link in links.items() if sorted(link["joins"]) == sorted(joined)), None)
    for key in _WEIGHS:
        if f"crank.{key}" in stated:
            del stated[f"crank.{key}"]
    own = stated.values.get("links", {}).get(name, {})
    weighs = {key: own[key] for key in _WEIGHS if key in own}
    match own:
        case {"joins": joins, "centre": [along, across]} if joins == joined[::-1]:
            weighs["centre"] = [_turned(along, own["length"]), _turned(across)]
        case {"joins": joins, "centre": int(share) | float(share)} if joins == joined[::-1]:
            weighs["centre"] = 1 - share
    return {f"crank.{key}": value for key, value in weighs.items()}


def _turned(place: str, length: str = "0 mm") -> str:
    """Return a coordinate of a link measured from its other end."""
    start, total = (parse(text, ("length",)) for text in (place, length))
    return f"{from_si(total.value - start.value, start.unit) + 0.0:.6g} {start.unit}"


def _delete_removed(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> None:
    """Delete loads, friction and branches of links and pins that were removed."""
    removed = _names(before) - _names(now)
    loads = stated.values.get("loads", [])
    for number, load in reversed(list(enumerate(loads, start=1))):
        named = [load.get(key) for key in ("point", "link", "slider")]
        if removed.intersection([*named, *load.get("between", ()), *load.get("links", ())]):
            del stated[f"loads[{number}]"]
    for table in ("friction.pins", "friction.sliders", "branch"):
        for name in removed:
            if f"{table}.{name}" in stated:
                del stated[f"{table}.{name}"]


def _names(values: Mapping[str, Any]) -> set[str]:
    """Return the names of links, pins and points of a sketch."""
    crank, links = values.get("crank", {}), values.get("links", {})
    pins = [name for link in [crank, *links.values()] for name in (*link.get("joins", ()), *link.get("points", ()))]
    return {*links, *pins, *values.get("fixed_points", {}), *values.get("sliders", {}), crank.get("pin", "")}


def _merge(stated: Description, path: str, before: Mapping[str, Any], now: Mapping[str, Any]) -> None:
    """Set the changed values of a table."""
    for name, value in now.items():
        if name == "points":
            _merge(stated, f"{path}.points", before.get(name, {}), value)
        elif value != before.get(name) or f"{path}.{name}" not in stated:
            stated[f"{path}.{name}"] = value
    for name in before.keys() - now.keys():
        if f"{path}.{name}" in stated:
            del stated[f"{path}.{name}"]


def _read(request: Mapping[str, Any]) -> tuple[dict[str, Pin], dict[str, list[str]]]:
    """Return pins and links by name from a request, if it is valid."""
    try:
        pins = [Pin(str(pin["name"])[:8], float(pin["x"]), float(pin["y"]), bool(pin.get("ground")),
                    None if pin.get("slides") is None else float(pin["slides"]))
                for pin in request["pins"]]  # fmt: skip
        links = {str(link["name"])[:8]: [str(name) for name in link["pins"]] for link in request["links"]}
    except (KeyError, TypeError, ValueError, AttributeError):
        raise CrankworkError(ErrorMessage("sketch_damaged")) from None
    known = {pin.name: pin for pin in pins}
    is_valid = all(math.isfinite(pin.x) and math.isfinite(pin.y) and pin.name.isalnum() for pin in pins)
    is_joined = all(name.isalnum() and len(link) > 1 and known.keys() >= {*link} for name, link in links.items())
    if not is_valid or not is_joined or len(pins) > 200:
        raise CrankworkError(ErrorMessage("sketch_damaged"))
    # the first pin on the ground is the origin
    origin = next((pin for pin in pins if pin.ground), pins[0] if pins else Pin("", 0.0, 0.0))
    return {name: pin._replace(x=pin.x - origin.x, y=pin.y - origin.y) for name, pin in known.items()}, links


def _points(pins: Sequence[Pin], written: Written) -> dict[str, Any]:
    points = along_across(pins, written)
    return {"points": points} if points else {}


def along_across(pins: Sequence[Pin], written: Written) -> dict[str, list[str]]:
    """Return the coordinates of further pins of a link in the frame of its first two."""
    start, end, *further = pins
    turn = math.radians(_direction(start, end))
    cosine, sine = math.cos(turn), math.sin(turn)
    away = {pin.name: (pin.x - start.x, start.y - pin.y) for pin in further}
    return {name: [written(x * cosine + y * sine), written(y * cosine - x * sine)] for name, (x, y) in away.items()}


def _length(start: Pin, end: Pin, written: Written) -> str:
    return written(math.hypot(end.x - start.x, end.y - start.y))


def _direction(start: Pin, end: Pin) -> float:
    """Return the direction from one pin to another, anticlockwise from the x axis. [deg]"""
    return math.degrees(math.atan2(start.y - end.y, end.x - start.x))


def _millimetres(length: float) -> str:
    # a drawing by hand has three digits
    return f"{float(f'{length:.3g}') + 0.0:g} mm"


class Handle(NamedTuple):
    """A dimension between two parts of the drawing; its field is proportional to the distance to the `power`."""

    key: str
    start: str
    end: str
    power: int = 1


def handles(values: Mapping[str, Any], groups: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Return the dimensions that a machine file states as numbers, with the numbers."""
    numbers = {row["key"]: row for group in groups for row in group["rows"] if "number" in row}
    listed = _of_linkage(values) if "links" in values or "sliders" in values else _of_crank_mechanism(values)
    return [
        {"key": handle.key, "from": handle.start, "to": handle.end, "power": handle.power,
         "number": numbers[handle.key]["number"], "unit": numbers[handle.key]["after"].strip()}
        for handle in listed
        if handle.key in numbers
    ]  # fmt: skip


def _of_crank_mechanism(values: Mapping[str, Any]) -> Iterator[Handle]:
    crank, rod, piston = (f"side.{part}.1" for part in ("crank", "rod", "piston"))
    if not LOADING.keys().isdisjoint(values):
        # drawn as a linkage
        number = "" if values.get("engine", {}).get("cylinders", 1) == 1 else "1"
        crank, rod, piston = "joint.O", f"joint.A{number}", f"joint.B{number}"
    yield Handle("crank.radius", crank, rod)
    yield Handle("crank.stroke", crank, rod)
    yield Handle("rod.length", rod, piston)
    definition = values.get("rod", {}).get("ratio_definition", "r/l")
    yield Handle("rod.ratio", rod, piston, -1 if definition == "r/l" else 1)


def _of_linkage(values: Mapping[str, Any]) -> Iterator[Handle]:
    crank = values.get("crank", {})
    if "pivot" in crank and "pin" in crank:
        yield Handle("crank.radius", f"joint.{crank['pivot']}", f"joint.{crank['pin']}")
    for name, link in values.get("links", {}).items():
        joins = link.get("joins", []) if isinstance(link, Mapping) else []
        if len(joins) > 1:
            yield Handle(f"links.{name}.length", f"joint.{joins[0]}", f"joint.{joins[1]}")


def dyads(machine: Machine) -> list[dict[str, Any]]:
    """Return the dyads with two branches: branch, parts, and where the branch changes.

    `at`: the joint where links come into line; `ends`: the joints at its ends; `others`: points that turn with a lever.
    """
    mechanism, drawn, listed = machine.mechanism, machine.drawn, list[dict[str, Any]]()
    if not {"rod.length", "rod.ratio"}.isdisjoint(machine.stated):
        # the file of an engine states no branches
        return []
    for index, dyad in enumerate(mechanism.dyads):
        parts: dict[str, Any]
        match dyad:
            case RRR():
                parts = {"kind": "RRR", "name": dyad.point, "ends": [dyad.joint_a, dyad.joint_b], "at": dyad.point,
                         "links": [dyad.link_a, dyad.link_b]}  # fmt: skip
            case RRP(guide_link=""):
                direction = [math.cos(dyad.guide_angle), -math.sin(dyad.guide_angle)]
                parts = {"kind": "RRP", "name": dyad.slider, "ends": [dyad.joint], "at": dyad.slider,
                         "links": [dyad.link], "way": direction}  # fmt: skip
            case RPR():
                turning = [name for name in drawn.member(dyad.link).points if name != dyad.pivot]
                parts = {"kind": "RPR", "name": dyad.link, "ends": [dyad.pivot], "at": dyad.joint, "links": [dyad.link],
                         "others": turning}  # fmt: skip
            case _:
                continue
        passage = mechanism.passages.get(index)
        changes = [] if passage is None else [float(angle) for angle in passage.changes]
        listed.append({**parts, "branch": dyad.branch, "changes": changes})
    return listed


class _Joint(NamedTuple):
    flags: int
    name: str
    position: tuple[float, float]
    angle: float


class _Link(NamedTuple):
    is_piston: bool
    name: str
    mass: float
    inertia: float
    centre: tuple[float, float]
    joints: list[str]


class _Force(NamedTuple):
    is_local: bool
    name: str
    link: str
    start: tuple[float, float]
    end: tuple[float, float]
    size: float


def is_pmks(text: str) -> bool:
    """Return whether a text may be a linkage shared by PMKS+.

    Examples
    --------
    >>> is_pmks("https://app.pmksplus.com/?0P.TY.K,0.101.MA,A,0,0,0...N_B"), is_pmks("[crank]")
    (True, False)
    """
    return _SHARED.fullmatch(text.strip()) is not None


def from_pmks(text: str, language: Language) -> str:
    """Return the machine file of a linkage shared by PMKS+."""
    match = _SHARED.fullmatch(unquote(text.strip()))
    try:
        return _machine((match or [""])[1], language)
    except (ValueError, IndexError, KeyError, RuntimeError):
        raise CrankworkError(ErrorMessage("pmks_damaged")) from None


def _machine(word: str, language: Language) -> str:
    text, check = word[:-1], word[-1:]
    if _CHECKS[len(text) % len(_CHECKS)] != check:
        raise ValueError
    fields = iter(text.split("."))
    flags, _, counts, kinds = (next(fields) for _ in range(4))
    joints = dict(map(_joint, takewhile(bool, fields)))
    links = dict(pair for pair in map(_link, takewhile(bool, fields)) if pair is not None)
    forces = [_force(force) for force in takewhile(bool, fields)]
    unit, force_unit, inertia_unit = _UNITS[_number(kinds[0])], _FORCES[_number(kinds[2])], _INERTIAS[_number(kinds[0])]
    links, merged = _welded(joints, links)
    pins = {key: _pin(key, joints, links.values()) for key, joint in joints.items() if not joint.flags & _SLIDES}
    ground = {key for key, pin in pins.items() if pin.ground}
    parts = {key: body.joints for key, body in links.items() if not body.is_piston and not ground >= {*body.joints}}
    drivers = [key for key, joint in joints.items() if joint.flags & _DRIVES]
    if len(drivers) > 1:
        raise CrankworkError(ErrorMessage("pmks_inputs", names=", ".join(joints[key].name or key for key in drivers)))
    driver = next(iter(drivers), "")
    driving = next((key for key, ends in parts.items() if driver in ends), "")
    if driver not in pins or not pins[driver].ground or not driving:
        raise CrankworkError(ErrorMessage("pmks_no_input"))
    order = {key: sorted(ends, key=partial(_rank, driver, parts, pins)) for key, ends in parts.items()}
    named = {key: [pins[end].name for end in ends] for key, ends in order.items()}
    values = linkage(
        {pin.name: pin for pin in pins.values()}, named[driving],
        {links[key].name: ends for key, ends in named.items() if key != driving},
        partial(_written, unit), f"{_number(counts.split(',')[0])} rpm",
    )  # fmt: skip
    if _bits(flags) & _CLOCKWISE:
        values["crank"]["direction"] = "clockwise"
    tables = {key: values["crank"] if key == driving else values["links"][links[key].name] for key in parts}
    frames = {key: [pins[end] for end in ends[:2]] for key, ends in order.items()}
    for key, table in tables.items():
        if (links[key].mass, links[key].inertia) != _UNWEIGHED:
            table |= {"mass": f"{links[key].mass:g} kg", "inertia": f"{links[key].inertia:g} {inertia_unit}",
                      "centre": _place(frames[key], links[key].centre, unit)}  # fmt: skip
    for force in forces:
        link = merged.get(force.link, force.link)
        tables[link].setdefault("points", {})[force.name] = _place(frames[link], force.start, unit)
    turning = ", ".join(force.name for force in forces if force.is_local)
    head = f"# {translate('studio.pmks_turning', language, names=turning)}\n" if turning else ""
    text = with_branch_positions({"title": translate("studio.pmks", language)} | values)
    for force in forces:
        text = with_table_entry(text, "loads", _load(force, force_unit))
    return head + text


def _welded(joints: Mapping[str, _Joint], links: Mapping[str, _Link]) -> tuple[dict[str, _Link], dict[str, str]]:
    """Return links, merged where they meet in a welded joint, and the new keys of the merged links."""
    result, merged = dict(links), dict[str, str]()
    for key, joint in joints.items():
        first, *further = [name for name, link in result.items() if key in link.joints] or [""]
        if not joint.flags & _WELDED or any(result[name].is_piston for name in (first, *further) if name):
            continue
        for name in further:
            result[first] = _as_one(result[first], result.pop(name))
            merged = {old: first if new == name else new for old, new in merged.items()} | {name: first}
    return result, merged


def _as_one(first: _Link, second: _Link) -> _Link:
    """Return two links merged, with the mass of both about their common centre."""
    joints = list(dict.fromkeys([*first.joints, *second.joints]))
    if (first.mass, first.inertia) == (second.mass, second.inertia) == _UNWEIGHED:
        return first._replace(joints=joints)
    mass = first.mass + second.mass
    # without mass any centre will do
    share = second.mass / mass if mass else 0.5
    x, y = (a + share * (b - a) for a, b in zip(first.centre, second.centre, strict=True))
    about = sum(part.inertia + part.mass * math.dist(part.centre, (x, y)) ** 2 for part in (first, second))
    return first._replace(joints=joints, mass=mass, centre=(x, y), inertia=about)


def _joint(text: str) -> tuple[str, _Joint]:
    head, name, x, y, angle = text.split(",")[:5]
    return head[1:], _Joint(_bits(head[0]), name, (_thousandths(x), _thousandths(y)), _thousandths(angle))


def _link(text: str) -> tuple[str, _Link] | None:
    """Return a link, None for one that was welded into another."""
    head, name, mass, inertia, x, y, _, *joints = text.split(",")
    link = _Link(head[1] == "P", name, _thousandths(mass), _thousandths(inertia), (_thousandths(x), _thousandths(y)),
                  list(takewhile(bool, joints)))  # fmt: skip
    return (head[2:], link) if head[0] == "Y" else None


def _force(text: str) -> _Force:
    head, link, name, *numbers = text.split(",")
    x, y, end_x, end_y, size = map(_thousandths, numbers)
    return _Force(bool(_bits(head[0]) & 1), name, link, (x, y), (end_x, end_y), size)


def _pin(key: str, joints: Mapping[str, _Joint], links: Iterable[_Link]) -> Pin:
    """Return a pin, with the direction of its guide if it slides."""
    joint = joints[key]
    held = [link.joints for link in links if key in link.joints]
    guides = [joints[other] for ends in held for other in ends if joints[other].flags & _SLIDES]
    if len(guides) > 1 or (joint.flags & _WELDED and len(held) > 1):
        raise CrankworkError(ErrorMessage("pmks_joint", name=joint.name or key))
    x, y = joint.position
    name = joint.name if joint.name.isalnum() else key
    return Pin(name, x, -y, bool(joint.flags & _GROUND), _degrees(guides[0].angle) if guides else None)


def _rank(driver: str, parts: Mapping[str, Sequence[str]], pins: Mapping[str, Pin], key: str) -> tuple[bool, bool]:
    """Return the sorting key of a pin in its link: the driver first, then joints, then points."""
    meets = sum(key in part for part in parts.values()) + pins[key].ground + (pins[key].slides is not None)
    return key != driver, meets < 2


def _load(force: _Force, unit: str) -> dict[str, Any]:
    turn = math.atan2(force.end[1] - force.start[1], force.end[0] - force.start[0])
    x, y = (f"{round(force.size * component, 6) + 0.0:g} {unit}" for component in (math.cos(turn), math.sin(turn)))
    return {"kind": "force", "point": force.name, "x": x, "y": y}


def _place(frame: Sequence[Pin], position: tuple[float, float], unit: str) -> list[str]:
    """Return the coordinates of a point in the frame of its link."""
    coordinates: list[str] = along_across([*frame, Pin("S", position[0], -position[1])], partial(_written, unit))["S"]
    return coordinates


def _degrees(angle: float) -> float:
    """Return an angle in degrees, rounded to an integer if its thousandths of a radian allow that."""
    rounded = round(math.degrees(angle))
    return rounded if abs(math.radians(rounded) - angle) <= 5e-4 else math.degrees(angle)


def _written(unit: str, length: float) -> str:
    return f"{round(length, 4) + 0.0:g} {unit}"


def _bits(text: str) -> int:
    number = 0
    for digit in text:
        number = number * len(_DIGITS) + _DIGITS.index(digit)
    return number


def _number(text: str) -> int:
    return -_bits(text[1:]) if text[:1] == "0" else _bits(text)


def _thousandths(text: str) -> float:
    return _number(text) / 1000
