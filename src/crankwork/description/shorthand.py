"""The linkage that a crank mechanism or an engine is, and a machine file written out, with shorthand and defaults."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from crankwork.cylinders.articulated import articulated_stroke
from crankwork.cylinders.layout import CylinderPlace
from crankwork.description.document import Description, load
from crankwork.description.keys import CHAMBER_CYCLE, DIAGRAM, LOADING, OF_LINKAGE, OWN_SIZES
from crankwork.description.machine_file import OF_LIQUID, apply_settings, file_keys, idle_keys, read, with_first_sizes
from crankwork.description.schema import TableSpec, Values
from crankwork.description.table_file import resolve_file_columns
from crankwork.description.toml_edit import TomlPositions, key_text, toml, with_value
from crankwork.description.value_types import Reader
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.locale import Language, translate
from crankwork.machine import Engine, Gas, Machine
from crankwork.preparation.cylinders import each_cylinder
from crankwork.preparation.prepared import PreparedCylinder, prepare
from crankwork.units import from_si
from crankwork.working_cycle.pressure_models import MisfirePressure

_DIAGRAM = (*DIAGRAM, "valves")
_COUNTED = ("pressures", "ambient")
# of sums of angles [deg]
_ROUNDING = 1e-12
_ALONE = CylinderPlace(number=1, axis=0.0, crankpin=0, throw=0, pin_angle=0.0, position=0.0, firing_angle=0.0)
# tables that may be left out because all of them has a default
_ALWAYS = ("method", "table")


class CrankMechanism(NamedTuple):
    """The crank mechanism of one cylinder of an engine.

    `head`: direction from the shaft to its head, with the crank turning clockwise from the head of cylinder 1 [deg];
    `own`: suffix of its names; `joint`: pin of its rod.
    """

    solved: PreparedCylinder
    place: CylinderPlace
    head: float
    own: str
    joint: str

    @property
    def pin(self) -> str:
        """The name of its piston pin."""
        return f"B{self.own[1:]}"

    @property
    def length(self) -> float:
        """Length of its rod. [m]"""
        return (
            self.solved.lengths.rod_length
            if self.solved.articulated_rod is None
            else self.solved.articulated_rod.length
        )

    @property
    def offset(self) -> float:
        """Offset of its axis, positive towards the crankpin at 90 degrees. [m]"""
        return self.solved.lengths.offset if self.solved.articulated_rod is None else self.solved.articulated_rod.offset

    @property
    def top(self) -> float:
        """Distance of its piston pin from the shaft along its axis at top dead centre. [m]"""
        if self.solved.articulated_rod is not None:
            return articulated_stroke(self.solved.lengths, self.solved.articulated_rod).top
        return math.sqrt((self.length + self.solved.lengths.crank_radius) ** 2 - self.offset**2)

    def at(self, along: float, across: float) -> complex:
        """Return the position of a point given along the axis, and across it as the offset counts. [m]"""
        return complex(along, -across) * _direction(self.head)

    def pin_beyond(self, joint: complex) -> complex:
        """Return the position of the piston pin for a position of the joint of its rod. [m]"""
        seen = joint / _direction(self.head)
        return self.at(seen.real + math.sqrt(self.length**2 - (seen.imag + self.offset) ** 2), self.offset)


def crank_mechanisms(machine: Machine) -> list[CrankMechanism]:
    """Return the crank mechanisms of an engine, cylinder 1 first."""
    solved = prepare(machine, machine.method, PreparedCylinder)
    if machine.engine is None or len(machine.engine.layout.places) == 1:
        return [CrankMechanism(solved, _ALONE, _head(machine, 0.0, 0.0), "", "A")]
    first, *_ = places = machine.engine.layout.places
    return [
        CrankMechanism(
            cylinder,
            place,
            _head(machine, place.axis, first.axis),
            f"_{place.number}",
            f"A{place.crankpin + 1}" if cylinder.articulated_rod is None else f"C{place.number}",
        )
        for cylinder, place in zip(each_cylinder(solved), places, strict=True)
    ]


def _head(machine: Machine, axis: float, first: float) -> float:
    """Return the direction of a head; cylinder 1 is inclined as the machine. [deg]"""
    return _rounded(90.0 - axis + first - math.degrees(machine.inclination))


def _rounded(degrees: float) -> float:
    """Return an angle without the rounding of sums; one that has more digits keeps them. [deg]"""
    near = round(degrees, 9)
    return near if abs(near - degrees) <= _ROUNDING else degrees


def linkage_tables(values: Mapping[str, Any], machine: Machine) -> Iterator[tuple[str, Any]]:
    """Yield the keys of a linkage and their values, as a file states them."""
    loading = {key: values[key] for key in LOADING if key in values}
    # what is copied means what it means in its own format
    yield "format", values.get("format", 1) if loading or "cycle" in values else 2
    yield from ((key, values[key]) for key in ("title", "decimal_mark", "units") if key in values)
    if "document" in values:
        # the note of a linkage has other sections
        yield "document", {key: value for key, value in values["document"].items() if loading or key != "sections"}
    gears = crank_mechanisms(machine)
    yield "fixed_points", {"O": _place(0)}
    yield "crank", _crank(values["crank"], machine, gears)
    for mechanism in gears:
        yield f"links.rod{mechanism.own}", _rod(mechanism, gears)
    for mechanism in gears:
        through = mechanism.at(mechanism.top, mechanism.offset)
        yield f"guides.bore{mechanism.own}", {"through": _place(through), "angle": f"{mechanism.head + 180:.15g} deg"}
    mass = machine.masses.piston if machine.masses else 0.0
    for mechanism in gears:
        weighing = {"mass": _unit(mass, "kg")} if mass else {}
        weighing = {"mass": own} if (own := _own(values, "piston_masses", mechanism)) else weighing
        yield f"sliders.piston{mechanism.own}", {"guide": f"bore{mechanism.own}", "pin": mechanism.pin, **weighing}
    yield "positions", {name: _place(position) for name, position in _positions(gears)}
    for mechanism in gears:
        yield from _chambers(values, mechanism)
    yield from loading.items()
    if not has_other_forces(values):
        yield from _of_shaft(values, machine, gears)
    is_exact = machine.method.is_exact
    if "flywheel" in values:
        yield "flywheel", values["flywheel"]
    # the inertia of the rods says it of an exact method
    method = {key: value for key, value in values.get("method", {}).items() if key != "rod" or not is_exact}
    yield from ((key, table) for key, table in (("method", method), ("table", values.get("table"))) if table)


def given_motion_tables(values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the keys of links whose motion is given, and their values, for a table of transfer functions."""
    transfer, own = values["transfer"], ("file", "sheet", "angles", "bodies")
    reduced = {key: value for key, value in transfer.items() if key not in own}
    plain = {key: value for key, value in values.items() if not isinstance(value, Mapping)}
    tables = {key: value for key, value in values.items() if key not in ("transfer", "crank", *plain)}
    yield from {"format": values.get("format", 1), **plain}.items()
    yield "crank", {**values["crank"], **reduced}
    yield "table", {"angles": transfer["angles"]}
    yield from ((f"links.{key_text(name)}", body) for name, body in transfer["bodies"].items())
    yield from tables.items()


def _of_shaft(
    values: Mapping[str, Any], machine: Machine, gears: list[CrankMechanism]
) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the tables of crankshaft, bearings, balance and torsion."""
    shaft = _shaft(machine, machine.engine, gears) if machine.engine is not None else {}
    if machine.cylinder is not None and machine.gas is None:
        shaft["bore"] = _unit(machine.cylinder.bore, "mm")
    yield from ((key, table) for key, table in {"shaft": shaft}.items() if table)
    yield from ((key, values[key]) for key in ("bearings", "balance", "torsion") if key in values)


def linkage_values(values: Mapping[str, Any], machine: Machine) -> dict[str, Any]:
    """Return the values of the linkage that an engine is, nested as in a file."""
    nested: dict[str, Any] = {}
    for key, value in linkage_tables(values, machine):
        *tables, name = key.split(".")
        functools.reduce(lambda table, inner: table.setdefault(inner, {}), tables, nested)[name] = value
    return nested


def key_of_engine(key: str, values: Mapping[str, Any]) -> str:
    """Return the key of the file of an engine that a key of its linkage follows from, itself if it is copied."""
    for pattern, keys in OF_LINKAGE:
        if match := re.fullmatch(pattern, key):
            candidates = [match.expand(stated) for stated in keys]
            return next((stated for stated in candidates if stated.partition(".")[0] in values), candidates[0])
    return key


def _crank(stated: Mapping[str, Any], machine: Machine, gears: list[CrankMechanism]) -> dict[str, Any]:
    """Return the crank with all its pins; two pins of one throw have half of its mass each."""
    radius, pins = gears[0].solved.lengths.crank_radius, dict[str, complex]()
    throws = {mechanism.place.crankpin: mechanism.place.throw for mechanism in gears}
    for mechanism in gears:
        pins.setdefault(f"A{mechanism.place.crankpin + 1}", radius * _direction(-mechanism.place.pin_angle))
    crank: dict[str, Any] = {"pivot": "O", "pin": gears[0].joint, "radius": _unit(radius, "mm")}
    crank |= {key: stated[key] for key in ("speed", "angular_acceleration") if key in stated}
    crank |= {"start": f"{gears[0].head:.15g} deg", "direction": "clockwise"}
    if len(pins) > 1:
        crank["points"] = {name: _place(position) for name, position in pins.items() if name != gears[0].joint}
    throw = machine.masses.crank if machine.masses else 0.0
    shares = [throw / list(throws.values()).count(throw_of_pin) for throw_of_pin in throws.values()]
    mass = math.fsum(shares)
    turning = mass * radius**2
    if mass:
        centre = sum(share * position for share, position in zip(shares, pins.values(), strict=True)) / mass
        crank |= {"mass": _unit(mass, "kg"), "centre": gears[0].joint if len(pins) == 1 else _place(centre)}
    return crank | ({"inertia": _unit(turning, "kg*m2")} if turning else {})


def _rod(gear: CrankMechanism, gears: list[CrankMechanism]) -> dict[str, Any]:
    """Return the rod as a link from pin to piston pin, with the inertia of its masses if none is stated."""
    rod: dict[str, Any] = {"joins": [gear.joint, gear.pin], "length": _unit(gear.length, "mm")}
    knuckles = {
        other.joint: _place(
            other.solved.articulated_rod.knuckle_radius * _direction(-other.solved.articulated_rod.knuckle_angle)
        )
        for other in gears
        if other.solved.articulated_rod is not None and other.place.master == gear.place.number
    }
    rod |= {"points": knuckles} if knuckles else {}
    machine = gear.solved.machine
    masses = machine.masses or CrankGearMasses()
    mass = masses.rod_small_end + masses.rod_big_end
    if not mass:
        return rod
    centre = masses.rod_small_end / mass * gear.length
    inertia = mass * centre * (gear.length - centre)
    if machine.method.rod == "rigid" or not machine.method.is_exact:
        # what an approximate method leaves out counts in its errors
        inertia += masses.rod_inertia_excess
    return rod | {"mass": _unit(mass, "kg"), "centre": _place(centre), "inertia": _unit(inertia, "kg*m2")}


def _shaft(machine: Machine, engine: Engine, gears: list[CrankMechanism]) -> dict[str, Any]:
    """Return what the linkage does not show of the crankshaft."""
    places, names = engine.layout.places, {gear.place.number: f"piston{gear.own}" for gear in gears}
    shaft: dict[str, Any] = {"cylinders": list(names.values())}
    if len({place.position for place in places}) > 1 or engine.layout.journal_positions:
        shaft["positions"] = {names[place.number]: _unit(place.position, "mm") for place in places}
    if engine.layout.journal_positions:
        shaft["journals"] = [_unit(position, "mm") for position in engine.layout.journal_positions]
    pins = {place.crankpin: place.throw for place in places}
    if len(pins) > 1:
        shaft["throws"] = [
            [f"A{pin + 1}" for pin in sorted(pins) if pins[pin] == throw] for throw in sorted(set(pins.values()))
        ]
    if len(places) > 1:
        shaft["firing"] = {names[place.number]: f"{place.firing_angle:.15g} deg" for place in places}
    if machine.gas is None:
        shaft["period"] = f"{engine.layout.cycle:g} deg"
    if places[0].axis:
        shaft["reference"] = f"{_rounded(gears[0].head + places[0].axis):.15g} deg"
    if engine.misfires:
        shaft["misfire"] = [names[number] for number in engine.misfires]
    return shaft


def _positions(gears: list[CrankMechanism]) -> Iterator[tuple[str, complex]]:
    """Yield the positions of the piston pins at a crank angle of zero. [m]"""
    start, rods = gears[0].head, dict[int, tuple[complex, complex]]()
    for mechanism in sorted(gears, key=lambda gear: gear.place.master):
        rod_kind = mechanism.solved.articulated_rod
        if rod_kind is None:
            joint = mechanism.solved.lengths.crank_radius * _direction(start - mechanism.place.pin_angle)
            rods[mechanism.place.number] = joint, mechanism.pin_beyond(joint)
        else:
            joint, beyond = rods[mechanism.place.master]
            rod = (beyond - joint) / abs(beyond - joint)
            joint += rod_kind.knuckle_radius * rod * _direction(-rod_kind.knuckle_angle)
        yield mechanism.pin, mechanism.pin_beyond(joint)


def _chambers(values: Mapping[str, Any], gear: CrankMechanism) -> Iterator[tuple[str, Any]]:
    """Yield the chamber of a cylinder, and the chamber on the side of its piston rod."""
    cylinder, gas = gear.solved.machine.cylinder, gear.solved.machine.gas
    if cylinder is None or gas is None:
        return
    bore = _own(values, "bores", gear) or _unit(cylinder.bore, "mm")
    face = {"slider": f"piston{gear.own}", "bore": bore}
    space: dict[str, Any] = {"sense": 1}
    if cylinder.compression_ratio:
        # that of a cylinder with ports is calculated from the stated one
        space["compression_ratio"] = values["cylinder"].get("compression_ratio", cylinder.compression_ratio)
    clearance = _own(values, "clearance_volumes", gear)
    space |= (
        {"clearance_volume": clearance or _unit(cylinder.clearance_volume, "cm3")} if cylinder.clearance_volume else {}
    )
    stated = _calculated(values["cycle"], gas) if gas.calculated else _stated(values["gas"], gas, gear.place.number)
    plain: dict[str, Any] = {key: value for key, value in stated.items() if isinstance(value, str)}
    plain |= {"pressure_factor": gas.factor} if gas.factor != 1 else {}
    if "pressure" not in stated:
        plain["period"] = f"{gas.cycle:g} deg"
        is_stated = gas.calculated is None and gas.valves is None
        delay = gear.place.firing_angle + (gear.solved.begins if is_stated else 0.0)
        plain |= {"delay": f"{delay % gas.cycle:.15g} deg"} if delay else {}
    name = f"chambers.cylinder{gear.own}"
    yield name, {**face, **space, **plain}
    yield from ((f"{name}.{key}", value) for key, value in stated.items() if key not in plain)
    if cylinder.piston_rod_diameter:
        rod, back = _unit(cylinder.piston_rod_diameter, "mm"), values.get("gas", {}).get("back_pressure", "0 MPa")
        yield f"chambers.crank_end{gear.own}", {**face, "rod_diameter": rod, "sense": -1, "pressure": back}


def has_other_forces(values: Mapping[str, Any]) -> bool:
    """Return whether forces are other ones than those of the engine alone: of loads, own sizes or a liquid."""
    has_liquid = not OF_LIQUID.isdisjoint(values.get("gas", {}).get("valves", ()))
    return "loads" in values or has_liquid or not OWN_SIZES.keys().isdisjoint(values.get("engine", ()))


def _own(values: Mapping[str, Any], name: str, gear: CrankMechanism) -> str | None:
    """Return the size of a cylinder for itself as stated, None where all have the same."""
    sizes = values.get("engine", {}).get(name)
    return sizes[gear.place.number - 1] if sizes else None


def _stated(table: Mapping[str, Any], gas: Gas, number: int) -> dict[str, Any]:
    """Return the diagram of a cylinder as stated, or the pressure of a cylinder that stays open."""
    counted = {key: table[key] for key in _COUNTED if key in table}
    diagram: Any = functools.reduce(lambda inner, name: inner[name], gas.path.split(".")[1:], table)
    if isinstance(diagram, str) or "pressure" in diagram:
        return counted | {"pressure": _unit(gas.points[""].pressure or 0.0, "Pa")}
    if gas.measured is not None:
        counted["pressures"] = "absolute" if gas.is_absolute else "gauge"
        samples = {key: value for key, value in diagram["measured"].items() if key != "columns"}
        if "columns" in diagram["measured"]:
            samples["pressure_column"] = diagram["measured"]["columns"][number - 1]
        if gas.angle_shift or "shift" in samples:
            samples["shift"] = f"{gas.angle_shift:.15g} deg"
        diagram = {"measured": samples}
    return counted | {key: value for key, value in diagram.items() if key in _DIAGRAM}


def _calculated(stated: Mapping[str, Any], gas: Gas) -> dict[str, Any]:
    """Return the cycle of a cylinder as stated, and whether it misfires."""
    cycle = {key: value for key, value in stated.items() if key in CHAMBER_CYCLE.keys and key != "motored"}
    if isinstance(gas.calculated, MisfirePressure):
        cycle["motored"] = "compressed" if gas.calculated.ambient is None else "ambient"
    return {"pressures": "absolute", "ambient": _unit(gas.ambient, "Pa"), "cycle": cycle}


def _direction(degrees: float) -> complex:
    """Return the direction at an angle from the x-axis, anticlockwise."""
    radians = math.radians(degrees)
    return complex(math.cos(radians), math.sin(radians))


def _place(position: complex) -> list[str]:
    return [_unit(position.real, "mm"), _unit(position.imag, "mm")]


def _unit(value: float, unit: str) -> str:
    # smaller values come from rounding
    shown = from_si(value, unit) if abs(value) > 1e-15 else 0.0
    return f"{shown:.15g} {unit}"


def expanded(path: str | Path, overrides: Sequence[str] = (), language: Language = "en") -> str:
    """Return the text of a machine file with shorthand and defaults written out; these are marked by a comment."""
    read(path, overrides)
    description = load(path)
    for setting in apply_settings(description.values, overrides):
        description[setting.key] = setting.value
    values, keys = description.values, file_keys(description.values)
    if "transfer" in keys.keys:
        columns = resolve_file_columns(values, keys, Reader.of(values, Path(path).parent))
        description = Description(_text(given_motion_tables(columns)), description.name)
    elif "rod" in keys.keys:
        tables = list(linkage_tables(values, engine_of(description)))
        left_out = [
            f"# {translate('check.not_in_linkage', language, name=name)}\n" for name in _not_in_linkage(values, tables)
        ]
        description = Description("".join(left_out) + _text(tables), description.name)
    return _with_defaults(description, translate("check.by_default", language))


def _not_in_linkage(values: Mapping[str, Any], tables: Iterable[tuple[str, Any]]) -> list[str]:
    """Return what an engine states and its linkage has no keys for."""
    stated = {key for key, _ in tables}
    names = [f"[{name}]" for name in ("bearings", "balance", "test") if name in values.keys() - stated]
    names += ["[gas.combustion]"] if "combustion" in values.get("gas", {}) else []
    return names + (["rod.equivalent"] if "equivalent" in values["rod"] else [])


def linkage_of(description: Description) -> dict[str, Any]:
    """Return the values of the linkage that a crank mechanism or an engine is."""
    return linkage_values(description.values, engine_of(description))


def engine_of(description: Description) -> Machine:
    """Return the engine of a file, without loads, friction and motor."""
    # with these it may have sections of another note
    left_out = {*LOADING, "document"}
    alone = {key: value for key, value in with_first_sizes(description.values, Reader()).items() if key not in left_out}
    alone["crank"] = {"speed": "1 rad/s", **alone["crank"]}
    if not OF_LIQUID.isdisjoint(alone.get("gas", {}).get("valves", ())):
        # an engine has valves for gas; those of the liquid are copied as they are stated
        alone["gas"] = {
            **alone["gas"],
            "valves": {"suction": "1 bar", "discharge": "2 bar", "compression_exponent": 1.0},
        }
    if "engine" in alone:
        alone["engine"] = {key: value for key, value in alone["engine"].items() if key not in OWN_SIZES}
    return Description(alone, description.name, folder=description.folder).machine()


def _text(tables: Iterable[tuple[str, Any]]) -> str:
    """Return keys and tables as the text of a file."""
    lines = list[str]()
    for key, value in tables:
        for table in value if isinstance(value, list) else [value]:
            if isinstance(table, Mapping):
                lines += ["", f"[[{key}]]" if isinstance(value, list) else f"[{key}]"]
                lines += (f"{key_text(name)} = {toml(item)}" for name, item in table.items())
            else:
                lines.append(f"{key} = {toml(table)}")
    return "\n".join([*lines, ""])


def _with_defaults(description: Description, mark: str) -> str:
    """Return the text with every default that applies, each on a line with a mark, or named behind its inline table."""
    keys, text = file_keys(description.values), description.dump()
    values = keys.read(description.values, "", Reader.of(description.values)) or Values({}, keys)
    for name in _ALWAYS:
        kind = keys.keys[name].kind if name in keys.keys else None
        if isinstance(kind, TableSpec) and name not in values:
            values[name] = Values({}, kind)
    sealed = {name for charge in values.get("charges", {}).values() for name in charge["chambers"]}
    idle = idle_keys(keys, values)
    for path, table in _stated_tables("", values):
        is_sealed = path.removeprefix("chambers.") in sealed
        for name in table.table.keys:
            written = table.table.written_default(name, table)
            if name in table or written is None or (is_sealed and name in ("pressures", "period", "pressure_factor")):
                continue
            key = f"{path}.{name}".lstrip(".")
            text = text if key in idle else _marked(with_value(text, key, written), key, mark)
    return text


def _stated_tables(path: str, value: Any) -> Iterator[tuple[str, Values]]:  # noqa: ANN401 - tables and lists
    """Yield the tables in values, with their keys."""
    match value:
        case Values():
            yield path, value
            for name, item in value.items():
                yield from _stated_tables(f"{path}.{name}".lstrip("."), item)
        case Mapping():
            for name, item in value.items():
                yield from _stated_tables(f"{path}.{name}", item)
        case list():
            for index, item in enumerate(value, start=1):
                yield from _stated_tables(f"{path}[{index}]", item)


def _marked(text: str, key: str, mark: str) -> str:
    """Return a text with a comment after the line of a key with its default."""
    places = TomlPositions(text)
    around, _, name = key.rpartition(".")
    end = text.find("\n", places.pairs[key].end)
    end = len(text) if end < 0 else end
    if around not in places.inner:
        return f"{text[:end]}  # {mark}{text[end:]}"
    start = text.rfind("\n", 0, places.pairs[key].start) + 1
    is_marked = f"{mark}: " in text[start:end].partition("#")[2]
    comment = f", {name}" if is_marked else f"; {mark}: {name}" if "#" in text[start:end] else f"  # {mark}: {name}"
    return f"{text[:end]}{comment}{text[end:]}"
