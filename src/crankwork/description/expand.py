"""A machine file written out: what its shorthand stands for, in the tables of a linkage, with every default."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, cast

from crankwork.analysis import solve
from crankwork.description.document import Description, load
from crankwork.description.kinds import Reader
from crankwork.description.locate import Places
from crankwork.description.machine_file import file_keys, input_error, read, settings_of
from crankwork.description.schema import Table, Values
from crankwork.description.written import key_text, toml, with_value
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.locale import Language, Refusal, say
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import crank_of
from crankwork.units import from_si

# of a crank gear, what the tables of a linkage have no words for
_UNSAID = ("engine", "bearings", "balance")
_DIAGRAM = ("pressures", "ambient", "points", "pieces", "measured")
# tables that may be left out because all of them has a default
_ALWAYS = ("method", "table")


def expanded(path: str | Path, overrides: Sequence[str] = (), language: Language = "en") -> str:
    """Return the text of a machine file with its shorthand and its defaults written out; these are marked by a comment.

    What cannot be said in the tables of a linkage is refused.
    """
    machine = read(path, overrides)
    description = load(path)
    for one in settings_of(overrides):
        description[one.key] = one.value
    if machine.linkage is None:
        reader = Reader()
        _refuse(description.values, machine, reader)
        if reader.problems:
            raise input_error(description.dump(), description.name, reader)
        description = Description(_linkage_text(description.values, machine), description.name)
    return _with_defaults(description, say("check.by_default", language))


def _refuse(stated: Mapping[str, Any], machine: Machine, reader: Reader) -> None:
    """Complain of everything that no table of a linkage says."""
    if machine.transfer is not None:
        reader.complain("transfer", Refusal("unsaid_transfer"))
    is_alone = machine.engine is not None and len(machine.engine.layout.places) == 1
    for key in _UNSAID:
        if key in stated and not (key == "engine" and is_alone):
            reader.complain(key, Refusal(f"unsaid_{key}"))
    if machine.gas is not None and machine.gas.calculated is not None and not _drawn(machine)[1]:
        reader.complain("cycle", Refusal("unsaid_cycle"))
    if machine.transfer is None and not machine.method.is_exact:
        reader.complain("method.kinematics", Refusal("unsaid_method"))


def _linkage_text(values: Mapping[str, Any], machine: Machine) -> str:
    """Return the tables of a linkage for a crank gear."""
    lines = []
    for key, value in _tables(values, machine):
        for one in value if isinstance(value, list) else [value]:
            if isinstance(one, Mapping):
                lines += ["", f"[[{key}]]" if isinstance(value, list) else f"[{key}]"]
                lines += (f"{key_text(name)} = {toml(it)}" for name, it in one.items())
            else:
                lines.append(f"{key} = {toml(one)}")
    return "\n".join([*lines, ""])


def _tables(values: Mapping[str, Any], machine: Machine) -> Iterator[tuple[str, Any]]:
    """Yield the keys of a linkage and their values, as a file states them."""
    yield "format", 2
    yield from ((key, values[key]) for key in ("title", "decimal_mark") if key in values)
    yield "fixed_points", {"O": _place(0.0, 0.0)}
    gear = _Gear.of(machine)
    yield "crank", _crank(values["crank"], machine, gear)
    yield "links.rod", _rod(machine, gear)
    yield "guides.bore", {"through": gear.place(gear.top), "angle": _unit(gear.head + math.pi, "deg")}
    mass = machine.masses.piston if machine.masses else 0.0
    yield "sliders.piston", {"guide": "bore", "pin": "B", **({"mass": _unit(mass, "kg")} if mass else {})}
    yield "positions", {"B": gear.place(gear.at_zero)}
    yield from _chambers(values, machine)
    if "fluctuation" in values.get("flywheel", {}):
        yield "flywheel", {"fluctuation": values["flywheel"]["fluctuation"]}
    method = {
        key: one for key, one in values.get("method", {}).items() if key in ("kinematics", "pi", "gravity", "weights")
    }
    yield from ((key, one) for key, one in (("method", method), ("table", values.get("table"))) if one)


class _Gear(NamedTuple):
    """The lengths of a crank gear, and the direction of its head; the crank turns clockwise from there. [m], [rad]"""

    radius: float
    length: float
    offset: float
    head: float

    @classmethod
    def of(cls, machine: Machine) -> _Gear:
        rod = cast("RRP", machine.mechanism.dyads[0])
        leaning = machine.cylinder.inclination if machine.cylinder else 0.0
        return cls(crank_of(machine.mechanism.driver).radius, rod.length, rod.guide_point[0], math.pi / 2 - leaning)

    @property
    def top(self) -> float:
        """How far the piston pin is from the shaft, along the axis, at top dead centre."""
        return math.sqrt((self.length + self.radius) ** 2 - self.offset**2)

    @property
    def at_zero(self) -> float:
        """How far it is at a crank angle of zero."""
        return self.radius + math.sqrt(self.length**2 - self.offset**2)

    def place(self, along: float) -> list[str]:
        """Return a place on the axis of the cylinder, so far from the shaft."""
        cos, sin = math.cos(self.head), math.sin(self.head)
        return _place(along * cos + self.offset * sin, along * sin - self.offset * cos)


def _crank(stated: Mapping[str, Any], machine: Machine, gear: _Gear) -> dict[str, Any]:
    crank = {"pivot": "O", "pin": "A", "radius": _unit(gear.radius, "mm")}
    crank |= {key: stated[key] for key in ("speed", "angular_acceleration") if key in stated}
    crank |= {"start": _unit(gear.head, "deg"), "direction": "clockwise"}
    mass = machine.masses.crank if machine.masses else 0.0
    turning = mass * gear.radius**2 + machine.drive.inertia
    crank |= {"mass": _unit(mass, "kg"), "centre": "A"} if mass else {}
    return crank | ({"inertia": _unit(turning, "kg*m2")} if turning else {})


def _rod(machine: Machine, gear: _Gear) -> dict[str, Any]:
    """Return the rod as a link from crankpin to piston pin, its inertia that of its masses where it is not given."""
    rod: dict[str, Any] = {"joins": ["A", "B"], "length": _unit(gear.length, "mm")}
    masses = machine.masses or CrankGearMasses()
    mass = masses.rod_small_end + masses.rod_big_end
    if not mass:
        return rod
    centre = masses.rod_small_end / mass * gear.length
    inertia = mass * centre * (gear.length - centre)
    inertia += masses.rod_inertia_excess if machine.method.rod == "rigid" else 0.0
    return rod | {"mass": _unit(mass, "kg"), "centre": _place(centre, 0.0), "inertia": _unit(inertia, "kg*m2")}


def _chambers(values: Mapping[str, Any], machine: Machine) -> Iterator[tuple[str, Any]]:
    """Yield the chamber of the gas, and that of the pressure beside a piston rod."""
    cylinder, gas = machine.cylinder, machine.gas
    if cylinder is None or gas is None:
        return
    bore, ratio, volume = _unit(cylinder.bore, "mm"), cylinder.compression_ratio, cylinder.clearance_volume
    room: dict[str, Any] = {"compression_ratio": ratio} if ratio else {}
    room |= {"clearance_volume": _unit(volume, "cm3")} if volume else {}
    stated = (
        _calculated(machine) if gas.calculated else {key: one for key, one in values["gas"].items() if key in _DIAGRAM}
    )
    plain = {key: one for key, one in stated.items() if isinstance(one, str)}
    period = f"{gas.cycle:g} deg"
    yield "chambers.cylinder", {"slider": "piston", "bore": bore, "sense": 1, **room, "period": period, **plain}
    yield from ((f"chambers.cylinder.{key}", one) for key, one in stated.items() if key not in plain)
    if cylinder.piston_rod_diameter:
        rod, back = _unit(cylinder.piston_rod_diameter, "mm"), values["gas"]["back_pressure"]
        yield (
            "chambers.crank_end",
            {"slider": "piston", "bore": bore, "rod_diameter": rod, "sense": -1, "pressure": back},
        )


def _calculated(machine: Machine) -> dict[str, Any]:
    """Return the diagram of a calculated cycle: its points and laws, none where it has no corners."""
    points, pieces = _drawn(machine)
    ambient = _unit(machine.gas.ambient, "Pa") if machine.gas else ""
    return {
        "pressures": "absolute", "ambient": ambient,
        "points": {name: _point(one) for name, one in points.items()},
        "pieces": [_given(law=one.law, points=list(one.points), exponent=one.exponent, reference=one.reference)
                   for one in pieces],
    }  # fmt: skip


def _drawn(machine: Machine) -> tuple[Mapping[str, DiagramPoint], tuple[Piece, ...]]:
    space = solve(machine, machine.method).space
    return space.calculated.drawn if space is not None and space.calculated is not None else ({}, ())


def _point(one: DiagramPoint) -> dict[str, Any]:
    return _given(
        angle=None if one.angle is None else f"{one.angle:.15g} deg",
        stroke=one.stroke,
        pressure=None if one.pressure is None else _unit(one.pressure, "Pa"),
        volume=None if one.volume is None else _unit(one.volume, "cm3"),
    )


def _given(**values: Any) -> dict[str, Any]:  # noqa: ANN401 - as a file states them
    """Return the values that there are."""
    return {key: one for key, one in values.items() if one is not None}


def _place(x: float, y: float) -> list[str]:
    return [_unit(x, "mm"), _unit(y, "mm")]


def _unit(value: float, unit: str) -> str:
    # what is nearer to zero than rounding is zero
    shown = from_si(value, unit) if abs(value) > 1e-15 else 0.0
    return f"{shown:.15g} {unit}"


def _with_defaults(description: Description, mark: str) -> str:
    """Return the text with every default that applies, each on a line with a mark, or named behind its inline table."""
    keys, text = file_keys(description.values), description.dump()
    found = keys.read(description.values, "", Reader()) or Values({}, keys)
    for name in _ALWAYS:
        kind = keys.keys[name].kind if name in keys.keys else None
        if isinstance(kind, Table) and name not in found:
            found[name] = Values({}, kind)
    sealed = {name for one in found.get("charges", {}).values() for name in one["chambers"]}
    for path, table in _stated_tables("", found):
        is_sealed = path.removeprefix("chambers.") in sealed
        for name in table.table.keys:
            written = table.table.written_default(name, table)
            if name in table or written is None or (is_sealed and name in ("pressures", "period")):
                continue
            key = f"{path}.{name}".lstrip(".")
            text = _marked(with_value(text, key, written), key, mark)
    return text


def _stated_tables(path: str, value: Any) -> Iterator[tuple[str, Values]]:  # noqa: ANN401 - tables and lists
    """Yield the tables that stand in values, with their keys."""
    match value:
        case Values():
            yield path, value
            for name, one in value.items():
                yield from _stated_tables(f"{path}.{name}".lstrip("."), one)
        case Mapping():
            for name, one in value.items():
                yield from _stated_tables(f"{path}.{name}", one)
        case list():
            for at, one in enumerate(value, start=1):
                yield from _stated_tables(f"{path}[{at}]", one)


def _marked(text: str, key: str, mark: str) -> str:
    """Return a text with a comment behind the line of a key that has its default."""
    places = Places(text)
    around, _, name = key.rpartition(".")
    end = text.find("\n", places.pairs[key].end)
    end = len(text) if end < 0 else end
    if around not in places.inner:
        return f"{text[:end]}  # {mark}{text[end:]}"
    start = text.rfind("\n", 0, places.pairs[key].start) + 1
    told = f"{mark}: " in text[start:end].partition("#")[2]
    comment = f", {name}" if told else f"; {mark}: {name}" if "#" in text[start:end] else f"  # {mark}: {name}"
    return f"{text[:end]}{comment}{text[end:]}"
