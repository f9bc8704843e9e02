"""A linkage as it is drawn with the mouse, as a machine file: pins in millimetres, links as the pins they join."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from crankwork.description.document import Description
from crankwork.description.kinds import Reader
from crankwork.description.written import document
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import Language, Refusal, say, told
from crankwork.machine import Machine
from crankwork.mechanism.dyads import Guide
from crankwork.mechanism.linkage import Linkage, Member
from crankwork.mechanism.mechanism import Crank
from crankwork.mechanism.structure import chain_mobility, structure
from crankwork.studio.form import stated_text
from crankwork.studio.handles import dyads
from crankwork.study.sought import kind_of
from crankwork.units import from_si, parse

_SPEED = "60 rpm"
_TYPED = (("radius", "length", "mm"), ("start", "angle", "deg"))
_LINK = '[crank]\nradius = "1 mm"\nstart = "0 deg"\n[links]\n'
# of a link, what stays with it whether it drives or not
_WEIGHS = ("mass", "inertia", "centre")
Written = Callable[[float], str]


class Pin(NamedTuple):
    """A pin where it was drawn, downward as a screen counts; on the ground, or sliding in a direction [deg]."""

    name: str
    x: float
    y: float
    ground: bool = False
    slides: float | None = None

    def place(self, written: Written) -> list[str]:
        """Return where it is, upward, as a file states it."""
        return [written(self.x), written(-self.y)]


def sketched(asked: Mapping[str, Any], language: Language) -> str:
    """Return the machine file of a sketch: `pins`, and `links` by name as the pins that they join.

    Lengths are those of the drawing, to three digits; where the other joints were drawn settles the branches.
    """
    pins, links = _read(asked)
    first = _driving(pins, links)
    if first is None:
        raise CrankworkError(Refusal("sketch_no_crank"))
    driving = sorted(links[first], key=lambda name: not pins[name].ground)
    others = {name: one for name, one in links.items() if name != first}
    values = linkage(pins, driving, others, _millimetres, _SPEED)
    return told_apart({"title": say("studio.own", language)} | values)


def _driving(pins: Mapping[str, Pin], links: Mapping[str, Sequence[str]]) -> str | None:
    """Return the link that drives: the first with two pins, one of them on the ground, neither of which slides."""
    pairs = (
        (name, one) for name, one in links.items() if len(one) == 2 and all(pins[end].slides is None for end in one)
    )
    return next((name for name, (start, end) in pairs if pins[start].ground != pins[end].ground), None)


def missing(asked: Mapping[str, Any], language: Language) -> str:
    """Return mobility and structure of a sketch as far as it goes, and what it needs to be a machine."""
    pins, links = _read(asked)
    if not links:
        return ""
    held = [name for one in links.values() for name in one]
    slid = [one.name for one in pins.values() if one.slides is not None]
    fixed = [name for name, one in pins.items() if one.ground] + slid
    # a piece slides on the ground, and a pin joins it to what else is there
    joints = sum(held.count(name) + fixed.count(name) - 1 for name in {*held}) + len(slid)
    freedom = int(chain_mobility(len(links) + len(slid), joints, 0))
    loose = [name for one in links.values() for name in one[:2] if held.count(name) == 1 and name not in fixed]
    first = _driving(pins, links)
    if first is None:
        advice = say("studio.driver_missing", language)
    elif freedom > 1 and loose:
        advice = say(f"studio.loose_{'ground' if freedom > 2 else 'slide'}", language, pin=loose[-1])
    elif freedom != 1:
        advice = say(f"studio.too_{'free' if freedom > 1 else 'stiff'}", language)
    else:
        found, problems = structure(_drawn(first, links, fixed, slid))
        advice = found.formula if found else told(problems[0].message, language)
    return f"W = {freedom} · {advice}"


def _drawn(first: str, links: Mapping[str, Sequence[str]], fixed: Sequence[str], slid: Sequence[str]) -> Linkage:
    """Return a sketch as a linkage without lengths."""
    nowhere = (0.0, 0.0)
    crank = next(name for name in links[first] if name not in fixed or name in slid)
    members = [Member(name, dict.fromkeys(one, nowhere)) for name, one in links.items() if name != first]
    pieces = [Member(f"{name}-", {name: nowhere}, guide=name) for name in slid]
    ground = {name: nowhere for name in fixed if name not in slid}
    guides = dict.fromkeys(slid, Guide())
    return Linkage(Crank(1.0, pin=crank, link=first), ground, (*members, *pieces), guides, driving=Member(first, {}))


def linkage(
    pins: Mapping[str, Pin], driving: Sequence[str], links: Mapping[str, Sequence[str]], written: Written, speed: str
) -> dict[str, Any]:
    """Return what a machine file states of pins by name and of links as the pins they join, ends first."""
    grounded = [name for name, one in pins.items() if one.ground]
    pivot, pin = (pins[name] for name in driving[:2])
    values: dict[str, Any] = {
        "fixed_points": {name: pins[name].place(written) for name in grounded},
        "crank": {"pivot": pivot.name, "pin": pin.name, "radius": _length(pivot, pin, written), "speed": speed,
                  "start": f"{_direction(pivot, pin):.6g} deg"} | _points([pins[name] for name in driving], written),
        "links": {name: {"joins": list(link[:2]), "length": _length(pins[link[0]], pins[link[1]], written)}
                  | _points([pins[one] for one in link], written) for name, link in links.items()},
    }  # fmt: skip
    slid = [one for one in pins.values() if one.slides is not None]
    if slid:
        values["guides"] = {f"g{k}": {"through": one.place(written), "angle": f"{one.slides:.4g} deg"}
                            for k, one in enumerate(slid, start=1)}  # fmt: skip
        values["sliders"] = {one.name: {"guide": f"g{k}", "pin": one.name} for k, one in enumerate(slid, start=1)}
    joined = [name for link in links.values() for name in link]
    fixed = {*driving, *grounded, *(one.name for one in slid)}
    free = [name for name in dict.fromkeys(joined) if name not in fixed and joined.count(name) > 1]
    positions = {name: pins[name].place(written) for name in [*free, *(one.name for one in slid)]}
    return values | ({"positions": positions} if positions else {})


def told_apart(values: dict[str, Any]) -> str:
    """Return a machine file whose positions are those that settle which way a group is assembled."""
    idle = _idle(Description(document({"format": 2} | values)), "position_unused")
    left = {name: at for name, at in values.get("positions", {}).items() if f"positions.{name}" not in idle}
    kept = {name: one for name, one in values.items() if name != "positions"}
    return document({"format": 2} | kept | ({"positions": left} if left else {}))


def _idle(stated: Description, *kinds: str) -> list[str]:
    """Return the positions that a machine file complains of in such a way."""
    try:
        stated.machine()
    except InputError as error:
        return [one.key for one in error.problems if getattr(one.message, "name", "") in kinds]
    except CrankworkError:
        pass
    return []


def swapped(stated: Description, name: str, machine: Machine) -> str:
    """Return a machine file in which a dyad goes together the other way."""
    known = dyads(machine) if machine.linkage else []
    now = next((one["branch"] for one in known if one["name"] == name), None)
    if now is None:
        raise CrankworkError(Refusal("branch_absent", name=name[:60], known=", ".join(stated.get("branch", {}))))
    stated[f"branch.{name}"] = -now
    for key in _idle(stated, "position_unused", "position_idle"):
        del stated[key]
    if stated.get("positions") == {}:
        del stated["positions"]
    return stated.dump()


def measured(typed: Sequence[str], language: Language) -> dict[str, Any]:
    """Return a length [mm] and a direction [deg] that were typed as a field of the file reads them."""
    if len(typed) != len(_TYPED) or not all(isinstance(one, str) for one in typed):
        raise CrankworkError(Refusal("sketch_damaged"))
    stated, found = Description(_LINK), dict[str, Any]()
    for (key, name, unit), text in zip(_TYPED, typed, strict=True):
        if not text:
            continue
        reader, path = Reader(), f"crank.{key}"
        one = kind_of(stated.values, path).read(stated_text(stated, path, text, language), path, reader)
        if one is None:
            return {"refusal": told(reader.problems[0].message, language)}
        found[name] = float(from_si(one.value, unit))
    return found


def redrawn(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Return a machine file with what has changed from one sketch to the next; all else that stands there stays."""
    weighed = _weighed(stated, before, now)
    for table in ("fixed_points", "links", "guides", "sliders", "positions"):
        was, there = before.get(table, {}), stated.values.get(table, {})
        for name in was:
            if name not in now.get(table, {}) and name in there:
                del stated[f"{table}.{name}"]
        for name, one in now.get(table, {}).items():
            if name in there and isinstance(one, Mapping):
                _merge(stated, f"{table}.{name}", was.get(name, {}), one)
            elif one != was.get(name) or name not in there:
                stated[f"{table}.{name}"] = one
    _merge(stated, "crank", before.get("crank", {}), now["crank"])
    for key, one in weighed.items():
        stated[key] = one
    _without_gone(stated, before, now)
    return stated.dump()


def _weighed(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a link weighs that drives from now on, and take out what the one weighed that did."""
    was, crank = before.get("crank", {}), now["crank"]
    if not was or (was["pivot"], was["pin"]) == (crank["pivot"], crank["pin"]):
        return {}
    joined = [crank["pivot"], crank["pin"]]
    name = next((name for name, one in before.get("links", {}).items() if sorted(one["joins"]) == sorted(joined)), None)
    for key in _WEIGHS:
        if f"crank.{key}" in stated:
            del stated[f"crank.{key}"]
    own = stated.values.get("links", {}).get(name, {})
    weighs = {key: own[key] for key in _WEIGHS if key in own}
    if own.get("joins") == joined[::-1] and isinstance(own.get("centre"), list):
        weighs["centre"] = [_turned(own["centre"][0], own["length"]), _turned(own["centre"][1])]
    return {f"crank.{key}": one for key, one in weighs.items()}


def _turned(place: str, length: str = "0 mm") -> str:
    """Return a coordinate of a link as it counts from its other end."""
    at, whole = (parse(one, ("length",)) for one in (place, length))
    return f"{from_si(whole.value - at.value, at.unit) + 0.0:.6g} {at.unit}"


def _without_gone(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> None:
    """Take out loads, friction and branches of links and pins that are drawn no more."""
    gone = _names(before) - _names(now)
    loads = stated.values.get("loads", [])
    for number, one in reversed(list(enumerate(loads, start=1))):
        named = [one.get("point"), one.get("link"), one.get("slider"), *one.get("between", ()), *one.get("links", ())]
        if gone.intersection(named):
            del stated[f"loads[{number}]"]
    for table in ("friction.pins", "friction.sliders", "branch"):
        for name in gone:
            if f"{table}.{name}" in stated:
                del stated[f"{table}.{name}"]


def _names(values: Mapping[str, Any]) -> set[str]:
    """Return what links, pins and points of a sketch are called."""
    crank, links = values.get("crank", {}), values.get("links", {})
    pins = [name for one in [crank, *links.values()] for name in (*one.get("joins", ()), *one.get("points", ()))]
    return {*links, *pins, *values.get("fixed_points", {}), *values.get("sliders", {}), crank.get("pin", "")}


def _merge(stated: Description, path: str, before: Mapping[str, Any], now: Mapping[str, Any]) -> None:
    """State what has changed in a table."""
    for name, one in now.items():
        if name == "points":
            _merge(stated, f"{path}.points", before.get(name, {}), one)
        elif one != before.get(name) or f"{path}.{name}" not in stated:
            stated[f"{path}.{name}"] = one
    for name in before.keys() - now.keys():
        if f"{path}.{name}" in stated:
            del stated[f"{path}.{name}"]


def _read(asked: Mapping[str, Any]) -> tuple[dict[str, Pin], dict[str, list[str]]]:
    """Return pins and links by name of what a page tells, where that makes sense."""
    try:
        pins = [Pin(str(one["name"])[:8], float(one["x"]), float(one["y"]), bool(one.get("ground")),
                    None if one.get("slides") is None else float(one["slides"])) for one in asked["pins"]]  # fmt: skip
        links = {str(link["name"])[:8]: [str(name) for name in link["pins"]] for link in asked["links"]}
    except (KeyError, TypeError, ValueError, AttributeError):
        raise CrankworkError(Refusal("sketch_damaged")) from None
    known = {one.name: one for one in pins}
    is_sound = all(math.isfinite(one.x) and math.isfinite(one.y) and one.name.isalnum() for one in pins)
    is_joined = all(name.isalnum() and len(link) > 1 and known.keys() >= {*link} for name, link in links.items())
    if not is_sound or not is_joined or len(pins) > 200:
        raise CrankworkError(Refusal("sketch_damaged"))
    # the first pin on the ground is the origin
    at = next((one for one in pins if one.ground), pins[0] if pins else Pin("", 0.0, 0.0))
    return {name: one._replace(x=one.x - at.x, y=one.y - at.y) for name, one in known.items()}, links


def _points(pins: Sequence[Pin], written: Written) -> dict[str, Any]:
    found = along_across(pins, written)
    return {"points": found} if found else {}


def along_across(pins: Sequence[Pin], written: Written) -> dict[str, list[str]]:
    """Return by name where further pins of a link are that runs from the first to the second."""
    start, end, *others = pins
    turn = math.radians(_direction(start, end))
    cosine, sine = math.cos(turn), math.sin(turn)
    away = {one.name: (one.x - start.x, start.y - one.y) for one in others}
    return {name: [written(x * cosine + y * sine), written(y * cosine - x * sine)] for name, (x, y) in away.items()}


def _length(one: Pin, other: Pin, written: Written) -> str:
    return written(math.hypot(other.x - one.x, other.y - one.y))


def _direction(one: Pin, other: Pin) -> float:
    """Return the direction from a pin to another, anticlockwise from the x axis [deg]"""
    return math.degrees(math.atan2(one.y - other.y, other.x - one.x))


def _millimetres(length: float) -> str:
    # what is drawn by hand has no more digits
    return f"{float(f'{length:.3g}') + 0.0:g} mm"
