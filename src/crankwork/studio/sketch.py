"""A linkage as it is drawn with the mouse, as a machine file: pins in millimetres, links as the pins they join."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from crankwork.description.document import Description
from crankwork.description.written import document
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import Language, Refusal, say

_SPEED = "60 rpm"
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
    """Return the machine file of a sketch: `pins`, and `links` by the names of their pins, the one that drives first.

    Lengths are those of the drawing, to three digits; where the other joints were drawn settles the branches.
    """
    pins, links = _read(asked)
    grounded = {one.name for one in pins.values() if one.ground}
    first = next((link for link in links if len(link) == 2 and len(grounded.intersection(link)) == 1), None)
    if first is None:
        raise CrankworkError(Refusal("sketch_no_crank"))
    driving = sorted(first, key=lambda name: name not in grounded)
    others = {str(number): one for number, one in enumerate((one for one in links if one is not first), start=2)}
    values = linkage(pins, driving, others, _millimetres, _SPEED)
    return told_apart({"title": say("studio.own", language)} | values)


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
    text = document({"format": 2} | values)
    try:
        Description(text).machine()
    except InputError as error:
        idle = [one.key for one in error.problems if getattr(one.message, "name", "") == "position_unused"]
        left = {name: at for name, at in values.get("positions", {}).items() if f"positions.{name}" not in idle}
        kept = {name: one for name, one in values.items() if name != "positions"}
        return document({"format": 2} | kept | ({"positions": left} if left else {}))
    except CrankworkError:
        pass
    return text


def redrawn(stated: Description, before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Return a machine file with what has changed from one sketch to the next; all else that stands there stays."""
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
    return stated.dump()


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


def _read(asked: Mapping[str, Any]) -> tuple[dict[str, Pin], list[list[str]]]:
    """Return pins by name and links of what a page tells, where that makes sense."""
    try:
        pins = [Pin(str(one["name"])[:8], float(one["x"]), float(one["y"]), bool(one.get("ground")),
                    None if one.get("slides") is None else float(one["slides"])) for one in asked["pins"]]  # fmt: skip
        links = [[str(name) for name in link] for link in asked["links"]]
    except (KeyError, TypeError, ValueError, AttributeError):
        raise CrankworkError(Refusal("sketch_damaged")) from None
    known = {one.name: one for one in pins}
    is_sound = all(math.isfinite(one.x) and math.isfinite(one.y) and one.name.isalnum() for one in pins)
    if not is_sound or len(pins) > 200 or not all(len(link) > 1 and known.keys() >= {*link} for link in links):
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
