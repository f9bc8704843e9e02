"""Reader of linkages shared by PMKS+, as a link or a file.

The text has fields between points: settings, pins, links, forces. Numbers are in base 64, negative ones with a leading
zero, lengths and angles in thousandths.
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

from crankwork.description.toml_edit import with_table_entry
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage, Language, translate
from crankwork.studio.sketch import Pin, along_across, linkage, with_branch_positions

_DIGITS = string.digits + string.ascii_uppercase + string.ascii_lowercase + "_-"
# check digit at the end, by the length of the text
_CHECKS = _DIGITS[:62]
_LINK = re.compile(r"(?:https?://\S*\?)?([\w-]{1,4}\.[\w,-]+\.[\w,-]+\.\w+\.\w+,\S+)")
_UNITS = ("in", "cm", "m")
_FORCES = ("lbf", "N")
_INERTIAS = ("lb*in2", "kg*cm2", "kg*m2")
# default mass and inertia of a link in PMKS+
_UNWEIGHED = (1.0, 1.0)
_CLOCKWISE, _SLIDES, _DRIVES, _GROUND, _WELDED = 1, 1, 2, 4, 8


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
    return _LINK.fullmatch(text.strip()) is not None


def from_pmks(text: str, language: Language) -> str:
    """Return the machine file of a linkage shared by PMKS+."""
    match = _LINK.fullmatch(unquote(text.strip()))
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
