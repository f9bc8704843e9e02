"""Linkages that PMKS+ shares, as a link or a file, read as machine files.

The text has fields between points: settings, pins, links, forces. Numbers are written to the base of 64, with a zero
before those below nothing, lengths and angles in thousandths.
"""

from __future__ import annotations

import math
import re
import string
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from itertools import takewhile
from typing import Any, NamedTuple
from urllib.parse import unquote

from crankwork.description.written import with_entry
from crankwork.errors import CrankworkError
from crankwork.locale import Language, Refusal, say
from crankwork.studio.sketch import Pin, along_across, linkage, told_apart

_DIGITS = string.digits + string.ascii_uppercase + string.ascii_lowercase + "_-"
# at the end, by the length of the text
_CHECKS = _DIGITS[:62]
_LINK = re.compile(r"(?:https?://\S*\?)?([\w-]{1,4}\.[\w,-]+\.[\w,-]+\.\w+\.\w+,\S+)")
_UNITS = ("in", "cm", "m")
_FORCES = ("lbf", "N")
_INERTIAS = ("lb*in2", "kg*cm2", "kg*m2")
# what it gives every link that was not weighed
_UNWEIGHED = (1.0, 1.0)
_CLOCKWISE, _SLIDES, _DRIVES, _GROUND, _WELDED = 1, 1, 2, 4, 8


class _Joint(NamedTuple):
    flags: int
    name: str
    at: tuple[float, float]
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
    """Return whether a text may be what PMKS+ shares.

    Examples
    --------
    >>> is_pmks("https://app.pmksplus.com/?0P.TY.K,0.101.MA,A,0,0,0...N_B"), is_pmks("[crank]")
    (True, False)
    """
    return _LINK.fullmatch(text.strip()) is not None


def from_pmks(text: str, language: Language) -> str:
    """Return the machine file of what PMKS+ shares."""
    found = _LINK.fullmatch(unquote(text.strip()))
    try:
        return _machine((found or [""])[1], language)
    except (ValueError, IndexError, KeyError, RuntimeError):
        raise CrankworkError(Refusal("pmks_damaged")) from None


def _machine(word: str, language: Language) -> str:
    text, check = word[:-1], word[-1:]
    if _CHECKS[len(text) % len(_CHECKS)] != check:
        raise ValueError
    fields = iter(text.split("."))
    flags, _, counts, kinds = (next(fields) for _ in range(4))
    joints = dict(map(_joint, takewhile(bool, fields)))
    links = dict(found for found in map(_link, takewhile(bool, fields)) if found is not None)
    forces = [_force(one) for one in takewhile(bool, fields)]
    unit, force_unit, inertia_unit = (of[_number(kinds[at])] for of, at in ((_UNITS, 0), (_FORCES, 2), (_INERTIAS, 0)))
    links, merged = _welded(joints, links)
    pins = {key: _pin(key, joints, links.values()) for key, one in joints.items() if not one.flags & _SLIDES}
    parts = {key: one.joints for key, one in links.items() if not one.is_piston and not _stands(one, pins)}
    drivers = [key for key, one in joints.items() if one.flags & _DRIVES]
    if len(drivers) > 1:
        raise CrankworkError(Refusal("pmks_inputs", names=", ".join(joints[key].name or key for key in drivers)))
    driver = next(iter(drivers), "")
    driving = next((key for key, one in parts.items() if driver in one), "")
    if driver not in pins or not pins[driver].ground or not driving:
        raise CrankworkError(Refusal("pmks_no_input"))
    order = {key: sorted(one, key=partial(_rank, driver, parts, pins)) for key, one in parts.items()}
    named = {key: [pins[one].name for one in ends] for key, ends in order.items()}
    values = linkage(
        {one.name: one for one in pins.values()}, named[driving],
        {links[key].name: one for key, one in named.items() if key != driving},
        partial(_written, unit), f"{_number(counts.split(',')[0])} rpm",
    )  # fmt: skip
    if _bits(flags) & _CLOCKWISE:
        values["crank"]["direction"] = "clockwise"
    tables = {key: values["crank"] if key == driving else values["links"][links[key].name] for key in parts}
    frames = {key: [pins[one] for one in ends[:2]] for key, ends in order.items()}
    for key, table in tables.items():
        if (links[key].mass, links[key].inertia) != _UNWEIGHED:
            table |= {"mass": f"{links[key].mass:g} kg", "inertia": f"{links[key].inertia:g} {inertia_unit}",
                      "centre": _place(frames[key], links[key].centre, unit)}  # fmt: skip
    for one in forces:
        link = merged.get(one.link, one.link)
        tables[link].setdefault("points", {})[one.name] = _place(frames[link], one.start, unit)
    turning = ", ".join(one.name for one in forces if one.is_local)
    head = f"# {say('studio.pmks_turning', language, names=turning)}\n" if turning else ""
    text = told_apart({"title": say("studio.pmks", language)} | values)
    for one in forces:
        text = with_entry(text, "loads", _load(one, force_unit))
    return head + text


def _welded(joints: Mapping[str, _Joint], links: Mapping[str, _Link]) -> tuple[dict[str, _Link], dict[str, str]]:
    """Return links of which those that meet in a welded joint are one, and what became of the others by their keys."""
    found, merged = dict(links), dict[str, str]()
    for key, joint in joints.items():
        first, *others = [name for name, one in found.items() if key in one.joints] or [""]
        if not joint.flags & _WELDED or any(found[name].is_piston for name in (first, *others) if name):
            continue
        for name in others:
            found[first] = _as_one(found[first], found.pop(name))
            merged = {old: first if new == name else new for old, new in merged.items()} | {name: first}
    return found, merged


def _as_one(one: _Link, other: _Link) -> _Link:
    """Return two links as one, with the mass of both about the centre of both."""
    joints = list(dict.fromkeys([*one.joints, *other.joints]))
    if (one.mass, one.inertia) == (other.mass, other.inertia) == _UNWEIGHED:
        return one._replace(joints=joints)
    mass = one.mass + other.mass
    # what has no mass has its centre anywhere
    share = other.mass / mass if mass else 0.5
    x, y = (a + share * (b - a) for a, b in zip(one.centre, other.centre, strict=True))
    about = sum(part.inertia + part.mass * math.dist(part.centre, (x, y)) ** 2 for part in (one, other))
    return one._replace(joints=joints, mass=mass, centre=(x, y), inertia=about)


def _joint(text: str) -> tuple[str, _Joint]:
    head, name, x, y, angle = text.split(",")[:5]
    return head[1:], _Joint(_bits(head[0]), name, (_thousandths(x), _thousandths(y)), _thousandths(angle))


def _link(text: str) -> tuple[str, _Link] | None:
    """Return a link; those that were welded into one are told beside it, and are none of their own."""
    head, name, mass, inertia, x, y, _, *joints = text.split(",")
    found = _Link(head[1] == "P", name, _thousandths(mass), _thousandths(inertia), (_thousandths(x), _thousandths(y)),
                  list(takewhile(bool, joints)))  # fmt: skip
    return (head[2:], found) if head[0] == "Y" else None


def _force(text: str) -> _Force:
    head, link, name, *numbers = text.split(",")
    x, y, end_x, end_y, size = map(_thousandths, numbers)
    return _Force(bool(_bits(head[0]) & 1), name, link, (x, y), (end_x, end_y), size)


def _pin(key: str, joints: Mapping[str, _Joint], links: Iterable[_Link]) -> Pin:
    """Return a pin, sliding where a piece joins it to a guide."""
    one = joints[key]
    held = [link.joints for link in links if key in link.joints]
    guides = [joints[other] for ends in held for other in ends if joints[other].flags & _SLIDES]
    if len(guides) > 1 or (one.flags & _WELDED and len(held) > 1):
        raise CrankworkError(Refusal("pmks_joint", name=one.name or key))
    x, y = one.at
    name = one.name if one.name.isalnum() else key
    return Pin(name, x, -y, bool(one.flags & _GROUND), _degrees(guides[0].angle) if guides else None)


def _stands(link: _Link, pins: Mapping[str, Pin]) -> bool:
    return all(key in pins and pins[key].ground for key in link.joints)


def _rank(driver: str, parts: Mapping[str, Sequence[str]], pins: Mapping[str, Pin], key: str) -> tuple[bool, bool]:
    """Return where a pin stands in its link: what drives it, what joins it to others, what is a point of it."""
    meets = sum(key in one for one in parts.values()) + pins[key].ground + (pins[key].slides is not None)
    return key != driver, meets < 2


def _load(force: _Force, unit: str) -> dict[str, Any]:
    turn = math.atan2(force.end[1] - force.start[1], force.end[0] - force.start[0])
    x, y = (f"{round(force.size * one, 6) + 0.0:g} {unit}" for one in (math.cos(turn), math.sin(turn)))
    return {"kind": "force", "point": force.name, "x": x, "y": y}


def _place(frame: Sequence[Pin], at: tuple[float, float], unit: str) -> list[str]:
    """Return where a point is in the frame of its link."""
    found: list[str] = along_across([*frame, Pin("S", at[0], -at[1])], partial(_written, unit))["S"]
    return found


def _degrees(angle: float) -> float:
    """Return an angle in degrees, a whole number where that is what its thousandths of a radian come from."""
    whole = round(math.degrees(angle))
    return whole if abs(math.radians(whole) - angle) <= 5e-4 else math.degrees(angle)


def _written(unit: str, length: float) -> str:
    return f"{round(length, 4) + 0.0:g} {unit}"


def _bits(text: str) -> int:
    found = 0
    for one in text:
        found = found * len(_DIGITS) + _DIGITS.index(one)
    return found


def _number(text: str) -> int:
    return -_bits(text[1:]) if text[:1] == "0" else _bits(text)


def _thousandths(text: str) -> float:
    return _number(text) / 1000
