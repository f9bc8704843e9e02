"""A linkage as it is drawn with the mouse, as a machine file: pins in millimetres, links as the pins they join."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from crankwork.description.document import Description
from crankwork.description.written import document
from crankwork.errors import CrankworkError
from crankwork.locale import Language, Refusal, say

_SPEED = "60 rpm"


class Pin(NamedTuple):
    """A pin where it was drawn, downward as a screen counts [mm]; on the ground, or sliding in a direction [deg]."""

    name: str
    x: float
    y: float
    ground: bool = False
    slides: float | None = None

    @property
    def place(self) -> list[str]:
        """Where it is, upward, as a file states it."""
        return [_millimetres(self.x), _millimetres(-self.y)]


def sketched(asked: Mapping[str, Any], language: Language) -> str:
    """Return the machine file of a sketch: `pins`, and `links` by the names of their pins, the one that drives first.

    Lengths are those of the drawing, to three digits; where the other joints were drawn settles the branches.
    """
    pins, links = _read(asked)
    grounded = {one.name for one in pins.values() if one.ground}
    first = next((link for link in links if len(link) == 2 and len(grounded.intersection(link)) == 1), None)
    if first is None:
        raise CrankworkError(Refusal("sketch_no_crank"))
    pivot, pin = sorted(first, key=lambda name: name not in grounded)
    values: dict[str, Any] = {
        "format": 2,
        "title": say("studio.own", language),
        "fixed_points": {name: pins[name].place for name in pins if name in grounded},
        "crank": {"pivot": pivot, "pin": pin, "radius": _length(pins[pivot], pins[pin]), "speed": _SPEED,
                  "start": f"{_direction(pins[pivot], pins[pin]):.4g} deg"},
        "links": {str(number): _link([pins[name] for name in link])
                  for number, link in enumerate((one for one in links if one is not first), start=2)},
    }  # fmt: skip
    slid = [one for one in pins.values() if one.slides is not None]
    if slid:
        values["guides"] = {f"g{k}": {"through": one.place, "angle": f"{one.slides:.4g} deg"}
                            for k, one in enumerate(slid, start=1)}  # fmt: skip
        values["sliders"] = {one.name: {"guide": f"g{k}", "pin": one.name} for k, one in enumerate(slid, start=1)}
    joined = [name for link in links if link is not first for name in link[:2]]
    fixed = {*grounded, pin, *(one.name for one in slid)}
    free = [name for name in dict.fromkeys(joined) if name not in fixed and joined.count(name) > 1]
    positions = {name: pins[name].place for name in free} | {one.name: one.place for one in slid}
    if positions:
        values["positions"] = positions
    return document(values)


def redrawn(stated: Description, drawn: Description) -> str:
    """Return a machine file with what a sketch has more than it; numbers that stand there stay."""
    there, fresh = stated.values, drawn.values
    for table in ("fixed_points", "links", "guides", "sliders", "positions"):
        for name, one in fresh.get(table, {}).items():
            if name not in there.get(table, {}):
                stated[f"{table}.{name}"] = one
                continue
            if table == "guides" and one["angle"] != there[table][name].get("angle", "0 deg"):
                stated[f"guides.{name}.angle"] = one["angle"]
            points = one.get("points", {}) if table == "links" else {}
            for point, place in points.items():
                if point not in there[table][name].get("points", {}):
                    stated[f"{table}.{name}.points.{point}"] = place
    return stated.dump()


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


def _link(pins: Sequence[Pin]) -> dict[str, Any]:
    """Return a link from its first pin to its second; further ones stand along and across it."""
    start, end, *others = pins
    link: dict[str, Any] = {"joins": [start.name, end.name], "length": _length(start, end)}
    if others:
        turn = math.radians(_direction(start, end))
        cosine, sine = math.cos(turn), math.sin(turn)
        away = {one.name: (one.x - start.x, start.y - one.y) for one in others}
        link["points"] = {
            name: [_millimetres(x * cosine + y * sine), _millimetres(y * cosine - x * sine)]
            for name, (x, y) in away.items()
        }
    return link


def _length(one: Pin, other: Pin) -> str:
    return _millimetres(math.hypot(other.x - one.x, other.y - one.y))


def _direction(one: Pin, other: Pin) -> float:
    """Return the direction from a pin to another, anticlockwise from the x axis [deg]"""
    return math.degrees(math.atan2(one.y - other.y, other.x - one.x))


def _millimetres(length: float) -> str:
    # what is drawn by hand has no more digits
    return f"{float(f'{length:.3g}') + 0.0:g} mm"
