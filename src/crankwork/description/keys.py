"""The keys of the machine file: kind, range and default of each, and when it applies.

Reader, error messages, schema and settings use them; the meaning of a key is a text of the file `fields`.
"""

from __future__ import annotations

import datetime as dt
import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description.schema import (
    DefaultBy,
    KeySpec,
    ListOf,
    MapOf,
    NameOr,
    Nested,
    NumberOr,
    OneOrMore,
    TableSpec,
    WordOr,
    nearest_name,
)
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Reader, Text, UnitOf, shown
from crankwork.locale import ErrorMessage, Language
from crankwork.machine import Document
from crankwork.method import STANDARD_GRAVITY
from crankwork.quantities import QUANTITIES
from crankwork.shaft.torsion_formulas import THROW_FORMULAS
from crankwork.working_cycle.schools import PEAK_LEVEL, SCHOOLS

LENGTH = Quantity(("length",), 1e-6, 100.0)
COORDINATE = Quantity(("length",), -1e3, 1e3)
SPEED = Quantity(("speed",), 1e-6, 3e4)
TORQUE = Quantity(("torque",), -1e9, 1e9)
NAME = Text(60)
TIME = Quantity(("time",), 1e-6, 1e6)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
NO_ANGLE = KeySpec(_ANGLE, default="0 deg")
INERTIA = KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2")
SHEET = KeySpec(Text(), only={"file": ()})
_FORCE = Quantity(("force",), -1e9, 1e9)
_MASS = Quantity(("mass", "mass_per_area"), 0.0, 1e6)
_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_VOLUME = Quantity(("volume",), 1e-15, 1e3)
_EXPONENT = Number(0.5, 3.0)

_PROCESS, _PUSH, _TURNS, _SPRING, _DAMPER = (
    {"kind": (kind,)} for kind in ("process", "force", "torque", "spring", "damper")
)
_BY_COLUMN, _BETWEEN = {"kind": ("process", "torque")}, {"kind": ("spring", "damper")}
_LOAD = TableSpec("load", {
    "kind": KeySpec(Choice(("process", "force", "torque", "spring", "damper")), required=True),
    "slider": KeySpec(NAME, required=("process",), only={"kind": ("process", "spring", "damper")}),
    "point": KeySpec(NAME, required=True, only=_PUSH),
    "link": KeySpec(NAME, required=("torque",), only={"kind": ("force", "torque")}),
    "between": KeySpec(ListOf(NAME, fewest=2, most=2), only=_BETWEEN),
    "links": KeySpec(ListOf(NAME, fewest=2, most=2), only={"between": ()}),
    "x": KeySpec(_FORCE, default="0 N", instead_of=("force",), only=_PUSH),
    "y": KeySpec(_FORCE, default="0 N", instead_of=("force",), only=_PUSH),
    "against": KeySpec(Choice(("stroke", "angle")), default="stroke", only=_PROCESS),
    "file": KeySpec(Text(1000), only=_BY_COLUMN),
    "sheet": SHEET,
    "at": KeySpec(ListOf(NumberOr(Quantity(("length", "angle"), -1e3, 1e3), Number(0.0, 1.0)), 2, from_file=True),
              only=_BY_COLUMN),
    "force": KeySpec(ListOf(_FORCE, fewest=1, from_file=True), required=("process",), instead_of=("x", "y"),
                 only={"kind": ("process", "force")}),
    "angle": KeySpec(_ANGLE, default="0 deg", only={**_PUSH, "force": ()}),
    "torque": KeySpec(ListOf(TORQUE, fewest=1, from_file=True), required=True, only=_TURNS),
    "curve": KeySpec(Choice(("straight", "smooth")), default="straight", only=_BY_COLUMN),
    "stroke": KeySpec(Choice(("growing", "falling")), default="growing", only=_PROCESS),
    "start": KeySpec(COORDINATE, only=_PROCESS),
    "acts": KeySpec(Choice(("forward", "both")), default="forward", only=_PROCESS),
    "stiffness": KeySpec(Quantity(("stiffness",), 0.0, 1e12), required=True, only=_SPRING),
    "free_length": KeySpec(COORDINATE, default="0 mm", only=_SPRING),
    "preload": KeySpec(_FORCE, default="0 N", only=_SPRING),
    "damping": KeySpec(Quantity(("damping",), 0.0, 1e12), required=True, only=_DAMPER),
})  # fmt: skip

_COEFFICIENT = KeySpec(Number(0.0, 1.0, message_kind="coefficient"), default=0.0)
_PIN_FRICTION = TableSpec("rubbing", {
    "coefficient": _COEFFICIENT,
    "radius": KeySpec(Quantity(("length",), 0.0, 10.0), required=True, only={"coefficient": ()}),
    "moment": KeySpec(Quantity(("torque",), 0.0, 1e9), default="0 N*m"),
    "damping": KeySpec(Quantity(("angular_damping",), 0.0, 1e9), default="0 N*m*s/rad"),
})  # fmt: skip
_SLIDER_FRICTION = TableSpec("rubbing_slider", {
    "coefficient": _COEFFICIENT,
    "length": KeySpec(LENGTH, only={"coefficient": ()}),
    "force": KeySpec(Quantity(("force",), 0.0, 1e9), default="0 N"),
    "damping": KeySpec(Quantity(("damping",), 0.0, 1e12), default="0 N*s/m"),
})  # fmt: skip
_FRICTION = TableSpec("friction", {
    "circle": KeySpec(Choice(("tangent", "sine")), default="tangent"),
    "pins": KeySpec(MapOf(_PIN_FRICTION, most=500)),
    "sliders": KeySpec(MapOf(_SLIDER_FRICTION, most=300)),
})  # fmt: skip

EFFICIENCY = TableSpec("efficiency", {
    "chain": KeySpec(Nested(Number(0.001, 1.0)), required=True, example="[0.95, 0.9]"),
    "decimals": KeySpec(Number(1, 6, whole=True)),
    "losses": KeySpec(Choice(("drive", "machine"))),
})  # fmt: skip

_MAINS = KeySpec(Quantity(("frequency", "speed"), 1e-6, 3e4), default="50 Hz")
MOTOR_SELECTION = KeySpec(TableSpec("motor_selection", {
    "reserve": KeySpec(Number(1.0, 10.0), default=1.0),
    "slip": KeySpec(Number(0.0, 0.5), default=0.04),
    "frequency": _MAINS,
}))  # fmt: skip
_MOTOR = TableSpec("motor", {
    "rated_power": KeySpec(Quantity(("power",), 1e-3, 1e9), required=True),
    "rated_speed": KeySpec(SPEED, required=True),
    "overload": KeySpec(Number(1.01, 10.0), required=True),
    "pole_pairs": KeySpec(Number(1, 24, whole=True), required=True),
    "frequency": _MAINS,
    "ratio": KeySpec(Number(1e-4, 1e4), default=1.0),
    "inertia": INERTIA,
})  # fmt: skip

_ANY_SPEED = Quantity(("speed",), -3e4, 3e4)
_ANY_ANGLE = Quantity(("angle",), -1e4, 1e4)
_TRANSIENT = TableSpec("transient", {
    "time": KeySpec(TIME, required=True),
    "torque": KeySpec(TORQUE),
    "motor": KeySpec(Flag()),
    "start": NO_ANGLE,
    "speed": KeySpec(_ANY_SPEED, default="0 rpm"),
    "until": KeySpec(Choice(("time", "rest", "steady")), default="time"),
    "step": KeySpec(TIME),
    "speeds": KeySpec(ListOf(_ANY_SPEED, most=20)),
    "stops": KeySpec(ListOf(_ANY_ANGLE, fewest=2, most=2)),
    "restitution": KeySpec(Number(0.0, 1.0), default=0.0, only={"stops": ()}),
})  # fmt: skip
# sections of notes in the order that most schools have
_ENGINE_SECTIONS = (
    "summary", "preface", "data", "method", "cycle", "indicator", "burning", "test", "kinematics", "displacement",
    "velocity", "acceleration", "dynamics", "inertia", "piston_forces", "crank_forces", "torque", "crankpin", "polar",
    "unrolled", "big_end", "wear", "mains", "balance", "evenness", "motor", "torsion", "comparison", "checks",
    "conclusion", "nomenclature", "sources", "appendix",
)  # fmt: skip
_LINKAGE_SECTIONS = (
    "summary", "task", "structure", "kinematics", "quality", "chambers", "stages", "forces", "balance", "reduction",
    "torques", "friction", "bearings", "harmonics", "motor", "flywheel", "law_of_motion", "torsion", "transient",
    "comparison", "checks", "conclusion", "nomenclature", "sources", "appendix",
)  # fmt: skip
_TRANSFER_SECTIONS = (
    "summary", "task", "static", "dynamic", "driving", "comparison", "checks", "conclusion", "nomenclature", "sources",
)  # fmt: skip
_TURNING_SECTIONS = (
    "summary", "task", "moments", "energy", "motor", "flywheel", "law_of_motion", "torsion", "comparison", "checks",
    "conclusion", "nomenclature", "sources",
)  # fmt: skip
_STAGES_SECTIONS = ("summary", "task", "stages", "comparison", "checks", "conclusion", "nomenclature", "sources")
_ROTOR_SECTIONS = (
    "summary", "task", "planes", "comparison", "checks", "conclusion", "nomenclature", "sources",
)  # fmt: skip
_TEST_SECTIONS = ("summary", "task", "test", "checks", "conclusion", "nomenclature", "sources")
_CLUTCH_SECTIONS = ("summary", "task", "clutch", "checks", "conclusion", "nomenclature", "sources")
_WORDS = Text(300)
_HEAD = (
    "title_en", "title_ru", "title_vi",
    "ministry", "institution", "faculty", "department", "work", "subject", "subtitle", "variant", "designation",
)  # fmt: skip
_PEOPLE = ("group", "supervisor", "checked_by", "standards_by", "approved_by", "city", "scale")


def with_defaults(keys: TableSpec, name: str, table: TableSpec, **defaults: object) -> TableSpec:
    """Return the keys of a file in which keys of one of its tables have other defaults and need not be stated."""
    own = {key: table.keys[key]._replace(required=False, default=default) for key, default in defaults.items()}
    table = table._replace(keys={**table.keys, **own})
    entry = KeySpec(table, required=any(key.required for key in table.keys.values()))
    return keys._replace(keys={**keys.keys, name: entry})


# those of a machine beside its mechanism and its gas
LOADING = {
    "loads": KeySpec(ListOf(_LOAD)),
    "friction": KeySpec(_FRICTION),
    "efficiency": KeySpec(EFFICIENCY),
    "motor": KeySpec(_MOTOR, instead_of=("motor_selection",)),
    "motor_selection": MOTOR_SELECTION._replace(instead_of=("motor",)),
    "transient": KeySpec(_TRANSIENT),
}


class Date(NamedTuple):
    """A day: a date of TOML, or the same as text."""

    def read(self, value: object, key: str, reader: Reader) -> dt.date | None:
        """Return the day."""
        if isinstance(value, dt.date) and not isinstance(value, dt.datetime):
            return value
        try:
            return dt.date.fromisoformat(value if isinstance(value, str) and len(value) == len("2026-05-31") else "")
        except ValueError:
            reader.add_error(key, ErrorMessage("no_day", value=shown(value)))
            return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a day."""
        return {"type": "string", "format": "date", "examples": ["2026-05-31"]}


class Section(NamedTuple):
    """The name of a section of a note."""

    options: tuple[str, ...]

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the name."""
        if isinstance(value, str) and value in self.options:
            return value
        nearest = nearest_name(value, self.options) if isinstance(value, str) else ""
        known = nearest or ", ".join(self.options)
        reader.add_error(
            key, ErrorMessage("no_section_near" if nearest else "no_section", value=shown(value), known=known)
        )
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of an enumeration."""
        return {"enum": list(self.options)}


_NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


class FigureName(NamedTuple):
    """The name of a figure, which its file has; which there are depends on results."""

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the name."""
        if isinstance(value, str) and _NAME.fullmatch(value):
            return value
        reader.add_error(key, ErrorMessage("figure_name", value=shown(value)))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a name."""
        return {"type": "string", "pattern": f"^{_NAME.pattern}$"}


class ColumnKey(NamedTuple):
    """The key of a column: a quantity, and after a dot what it is of."""

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the key."""
        kind = value.partition(".")[0] if isinstance(value, str) else ""
        if isinstance(value, str) and kind in QUANTITIES:
            return value
        known = nearest_name(kind, QUANTITIES) or "piston_force"
        reader.add_error(key, ErrorMessage("no_quantity_of_name", value=shown(value), known=known))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a key."""
        return {"type": "string", "minLength": 1}


class Figures(NamedTuple):
    """A table of figures: keys of the columns that each shows, by its name."""

    def read(self, value: object, key: str, reader: Reader) -> dict[str, tuple[str, ...]] | None:
        """Return the keys by name."""
        for name in value if isinstance(value, dict) else ():
            FigureName().read(name, f"{key}.{name}", reader)
        return MapOf(_CURVES, most=40).read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of the table."""
        return MapOf(_CURVES, most=40).schema(language) | {"propertyNames": FigureName().schema(language)}


_CURVES = OneOrMore(ColumnKey(), most=12)


def document_key(sections: tuple[str, ...]) -> KeySpec:
    """Return the key of the table for machines whose notes have these sections."""
    return KeySpec(
        TableSpec("document", {
            **dict.fromkeys(_HEAD, KeySpec(_WORDS)),
            **dict.fromkeys(("author", "student_number"), KeySpec(OneOrMore(_WORDS, most=12))),
            **dict.fromkeys(_PEOPLE, KeySpec(_WORDS)),
            "year": KeySpec(Number(1900, 2200, whole=True), instead_of=("date",)),
            "date": KeySpec(Date(), instead_of=("year",)),
            "sections": KeySpec(OneOrMore(Section(sections), most=40)),
            "sheets": KeySpec(OneOrMore(FigureName(), most=40)),
            "figures": KeySpec(Figures()),
        })
    )  # fmt: skip


ENGINE_DOCUMENT, LINKAGE_DOCUMENT = document_key(_ENGINE_SECTIONS), document_key(_LINKAGE_SECTIONS)
TEST_DOCUMENT = document_key(_TEST_SECTIONS)
TRANSFER_DOCUMENT, TURNING_DOCUMENT = document_key(_TRANSFER_SECTIONS), document_key(_TURNING_SECTIONS)
STAGES_DOCUMENT = document_key(_STAGES_SECTIONS)
ROTOR_DOCUMENT, CLUTCH_DOCUMENT = document_key(_ROTOR_SECTIONS), document_key(_CLUTCH_SECTIONS)


def stated_document(values: Mapping[str, Any]) -> Document:
    """Return the values of the table, text without surrounding blanks."""
    stated: Mapping[str, Any] = values.get("document") or {}
    texts: dict[str, Any] = {key: value.strip() if isinstance(value, str) else value for key, value in stated.items()}
    return Document(**texts | {"year": int(texts.get("year", 0))})


AMBIENT = DefaultBy("pressures", {"absolute": "101325 Pa"})
NO_ACCELERATION = KeySpec(Quantity(("angular_acceleration",), -1e6, 1e6), default="0 rad/s2")

_PAIR = KeySpec(ListOf(NAME, fewest=2, most=2), required=True)
_SHAFT_LENGTH = Quantity(("length",), 1e-6, 1e5)
_BORE = KeySpec(Quantity(("length",), 0.0, 100.0), default="0 mm")
_DISC_INERTIA = Quantity(("inertia",), 0.0, 1e12)
_STIFFNESS = Quantity(("torsional_stiffness",), 1e-9, 1e15)
_DAMPING = Quantity(("angular_damping",), 0.0, 1e12)
_MODULUS = Quantity(("pressure",), 1e3, 1e13)
_FREQUENCY = Quantity(("frequency", "speed"), 1e-9, 1e6)
_SIZE = KeySpec(Quantity(("length",), 1e-6, 10.0), required=True)

_DISC = TableSpec("disc", {
    "inertia": KeySpec(_DISC_INERTIA, required=True, instead_of=("mass",)),
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e9), instead_of=("inertia",)),
    "radius_of_gyration": KeySpec(Quantity(("length",), 1e-6, 100.0), required=True, only={"mass": ()}),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
})  # fmt: skip

_PART = TableSpec("shaft_part", {
    "length": KeySpec(_SHAFT_LENGTH, required=True),
    "diameter": KeySpec(_SIZE.kind, required=True),
    "bore": _BORE,
})  # fmt: skip

_THROW = TableSpec("throw", {
    "formula": KeySpec(
        Choice(tuple(THROW_FORMULAS), (("bicera", ErrorMessage("throw_charts")),)), default="ker-wilson"
    ),
    "journal_length": _SIZE,
    "journal_diameter": _SIZE,
    "journal_bore": _BORE,
    "pin_length": _SIZE,
    "pin_diameter": _SIZE,
    "pin_bore": _BORE,
    "web_thickness": _SIZE,
    "web_width": _SIZE,
    "radius": KeySpec(_SIZE.kind),
})  # fmt: skip

_FORMS = ("stiffness", "length", "parts", "throw")


def _instead(name: str) -> tuple[str, ...]:
    return tuple(form for form in _FORMS if form != name)


_OF_SHAFT = {
    "stiffness": KeySpec(_STIFFNESS, required=True, instead_of=_instead("stiffness")),
    "length": KeySpec(_SHAFT_LENGTH, instead_of=_instead("length"), only={"diameter": ()}),
    "diameter": KeySpec(_SIZE.kind, instead_of=("parts",)),
    "bore": _BORE._replace(only={"diameter": ()}),
    "parts": KeySpec(ListOf(_PART, fewest=1, most=50), instead_of=(*_instead("parts"), "diameter")),
    "throw": KeySpec(_THROW, instead_of=_instead("throw")),
    "modulus": KeySpec(_MODULUS),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
    "loss_factor": KeySpec(Number(0.0, 2.0), default=0.0),
}

_SHAFT = TableSpec("elastic_shaft", {
    "between": _PAIR,
    **_OF_SHAFT,
    "density": KeySpec(Quantity(("density",), 1.0, 1e5), only={"length": ()}),
    "elements": KeySpec(Number(1, 200, whole=True), only={"density": ()}),
})  # fmt: skip

_GEAR = TableSpec("gear_pair", {
    "between": _PAIR,
    "ratio": KeySpec(Number(-1e4, 1e4), required=True, instead_of=("teeth",)),
    "teeth": KeySpec(ListOf(Number(1, 1e5, whole=True), fewest=2, most=2), instead_of=("ratio",)),
})  # fmt: skip

_TORSION_DAMPER = TableSpec("damper", {
    "on": KeySpec(NAME, required=True),
    "inertia": KeySpec(_DISC_INERTIA._replace(low=1e-15), required=True),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
    "stiffness": KeySpec(_STIFFNESS),
    "mode": KeySpec(Number(1, 50, whole=True), default=1),
})  # fmt: skip

_EXCITATION = TableSpec("exciting_torque", {
    "disc": KeySpec(NAME, required=True),
    "torque": KeySpec(Quantity(("torque",), -1e12, 1e12), required=True),
    "order": KeySpec(Number(0.0, 1e3, above=True), required=True, instead_of=("frequency",)),
    "frequency": KeySpec(_FREQUENCY, instead_of=("order",)),
    "phase": KeySpec(Quantity(("angle",), -4 * math.pi, 4 * math.pi), default="0 deg"),
})  # fmt: skip

_COMMON = {
    "discs": KeySpec(MapOf(_DISC, most=200)),
    "shafts": KeySpec(MapOf(_SHAFT, most=200)),
    "gears": KeySpec(MapOf(_GEAR, most=50)),
    "dampers": KeySpec(MapOf(_TORSION_DAMPER, most=20)),
    "torques": KeySpec(ListOf(_EXCITATION, most=200)),
    "modulus": KeySpec(_MODULUS, default="80 GPa"),
    "reference_diameter": KeySpec(_SIZE.kind),
    "trials": KeySpec(ListOf(_FREQUENCY, most=20)),
    "speeds": KeySpec(ListOf(Quantity(("speed",), 1e-6, 3e4), fewest=2, most=2)),
    "orders": KeySpec(Number(0.5, 48.0), default=12.0),
    "modes": KeySpec(Number(1, 50, whole=True), default=10),
}

# torsional vibration of discs and shafts alone, and of a machine with a crankshaft
TORSION = KeySpec(TableSpec("torsion", _COMMON), required=True)
CRANKSHAFT_TORSION = KeySpec(TableSpec("torsion", {
    **_COMMON,
    "throw_shaft": KeySpec(TableSpec("elastic_shaft", _OF_SHAFT)),
    "throw_inertia": KeySpec(_DISC_INERTIA, default="0 kg*m2"),
}))  # fmt: skip

_ENGINE_LENGTH = Quantity(("length",), 1e-4, 100.0)
_SPACING = Quantity(("length",), 0.0, 100.0)
_PLAIN_MASS = Quantity(("mass",), 0.0, 1e6)
_INERTIA = Quantity(("inertia",), 0.0, 1e6)
_EVENT = Quantity(("angle",), 0.0, 0.75 * math.pi)
_BEFORE = Quantity(("angle",), math.radians(0.1), math.pi / 2)
_CYCLE_PRESSURE = Quantity(("pressure",), 100.0, 1e9)
_TEMPERATURE = Quantity(("temperature",), 100.0, 5000.0)
_RISE = Quantity(("temperature_rise",), -100.0, 1000.0)
_SHARE = Number(0.0, 1.0)

_OF_MASS = {"mass": ()}
_ARTICULATED = TableSpec("articulated", {
    "knuckle_radius": KeySpec(_ENGINE_LENGTH, required=True),
    "rod_length": KeySpec(_ENGINE_LENGTH),
    "knuckle_angles": KeySpec(ListOf(_ANGLE, fewest=1)),
    "mass": KeySpec(_PLAIN_MASS),
    "small_end_share": KeySpec(_SHARE, instead_of=("centre_of_mass",), only=_OF_MASS),
    "centre_of_mass": KeySpec(_ENGINE_LENGTH, instead_of=("small_end_share",), only=_OF_MASS),
    "inertia": KeySpec(_INERTIA, instead_of=("radius_of_gyration",), only=_OF_MASS),
    "radius_of_gyration": KeySpec(_ENGINE_LENGTH, instead_of=("inertia",), only=_OF_MASS),
})  # fmt: skip

_V, _W, _BANKS = {"layout": ("V",)}, {"layout": ("W",)}, {"layout": ("V", "boxer", "W")}
ENGINE = TableSpec("engine", {
    "layout": KeySpec(Choice(("inline", "V", "boxer", "W", "radial")), required=True),
    "cylinders": KeySpec(Number(1, MOST_CYLINDERS, whole=True), required=True),
    "strokes": KeySpec(Choice((4, 2)), default=4),
    "firing_order": KeySpec(ListOf(Number(1, MOST_CYLINDERS, whole=True), fewest=1, most=MOST_CYLINDERS)),
    "bank_angle": KeySpec(_ANGLE, required=True, only=_V),
    "bank_angles": KeySpec(ListOf(_ANGLE, fewest=2, most=8), required=True, only=_W),
    "throws": KeySpec(ListOf(_ANGLE, fewest=1, most=MOST_CYLINDERS), only={"layout": ("inline", "V", "boxer", "W")}),
    "pin_offset": KeySpec(_ANGLE, default="0 deg", only=_V),
    "numbering": KeySpec(Choice(("banks", "pairs")), only=_BANKS),
    "spacing": KeySpec(_ENGINE_LENGTH),
    "bank_stagger": KeySpec(_SPACING, only=_BANKS),
    "uneven": KeySpec(Flag(), default=False),
    "own_throws": KeySpec(Flag(), default=False, only=_V),
    "offsets": KeySpec(ListOf(Quantity(("length",), -100.0, 100.0), fewest=1, most=MOST_CYLINDERS)),
    "bores": KeySpec(ListOf(_ENGINE_LENGTH, fewest=1, most=MOST_CYLINDERS)),
    "clearance_volumes": KeySpec(ListOf(_VOLUME, fewest=1, most=MOST_CYLINDERS)),
    "piston_masses": KeySpec(ListOf(_PLAIN_MASS, fewest=1, most=MOST_CYLINDERS)),
    "articulated": KeySpec(_ARTICULATED, only={"layout": ("V", "radial")}),
    "misfire": KeySpec(ListOf(Number(1, MOST_CYLINDERS, whole=True), fewest=1, most=MOST_CYLINDERS)),
    "pressure_factors": KeySpec(ListOf(Number(0.0, 10.0), fewest=1, most=MOST_CYLINDERS)),
})  # fmt: skip

# lists of sizes that each cylinder has for itself, with the keys of those that all have
OWN_SIZES = {
    "bores": ("cylinder", "bore"),
    "clearance_volumes": ("cylinder", "clearance_volume"),
    "piston_masses": ("piston", "mass"),
}

BEARINGS = TableSpec("bearings", {
    **dict.fromkeys(
        ("crankpin_diameter", "crankpin_length", "main_diameter", "main_length", "pin_diameter", "pin_length"),
        KeySpec(_ENGINE_LENGTH),
    ),
    "rays": KeySpec(Choice((12, 24)), default=12),
    "counterweight": KeySpec(Quantity(("mass_moment",), 0.0, 1e6), default="0 kg*m"),
})  # fmt: skip

BALANCE = TableSpec("balance", {
    "rotating_share": KeySpec(Number(0.0, 2.0), default=0.0),
    "reciprocating_share": KeySpec(Number(0.0, 2.0), default=0.0),
    "shafts": KeySpec(ListOf(Choice((1, 2)), fewest=1, most=2)),
})  # fmt: skip

_RIM = TableSpec("rim", {
    "diameter": KeySpec(LENGTH, instead_of=("speed", "stress")),
    "speed": KeySpec(Quantity(("velocity",), 1e-3, 1e4), instead_of=("diameter", "stress")),
    "stress": KeySpec(Quantity(("pressure",), 1.0, 1e10), instead_of=("diameter", "speed"), only={"density": ()}),
    "density": KeySpec(Quantity(("density",), 1.0, 1e5)),
    "ratio": KeySpec(Number(1e-3, 1e3), only={"density": ()}),
    "width": KeySpec(LENGTH, instead_of=("ratio",), only={"density": ()}),
    "thickness": KeySpec(LENGTH, instead_of=("ratio",), only={"density": ()}),
    "share": KeySpec(Number(1e-6, 1.0), default=1.0),
})  # fmt: skip

FLYWHEEL = TableSpec("flywheel", {
    "fluctuation": KeySpec(Number(1e-6, 1.0), instead_of=("percent", "speeds")),
    "percent": KeySpec(Number(1e-4, 50.0, percent=1.0), instead_of=("fluctuation", "speeds")),
    "speeds": KeySpec(ListOf(Quantity(("speed",), 1e-6, 3e4), fewest=2, most=2), instead_of=("fluctuation", "percent")),
    "inertia": KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2", instead_of=("mass",)),
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e9, above=True), instead_of=("inertia",)),
    "radius_of_gyration": KeySpec(LENGTH, instead_of=("rim",)),
    "rim": KeySpec(_RIM, instead_of=("radius_of_gyration",)),
    "recovery": KeySpec(Quantity(("time",), 1e-6, 1e6)),
})  # fmt: skip

_FUEL = TableSpec("fuel", {
    "carbon": KeySpec(_SHARE, required=True),
    "hydrogen": KeySpec(_SHARE, required=True),
    "oxygen": KeySpec(_SHARE, default=0.0),
    "molar_mass": KeySpec(Number(1.0, 1000.0)),
    "heating_value": KeySpec(Quantity(("specific_energy",), 1e6, 2e8), required=True),
})  # fmt: skip


def _event(usual: str) -> KeySpec:
    """Return an event of the valves, which a calculation by Wiebe needs."""
    return KeySpec(_EVENT, default=DefaultBy("kind", {"wiebe": usual}))


_TIMING = TableSpec("timing", {
    "intake_opens": _event("15 deg"),
    "intake_closes": _event("50 deg"),
    "exhaust_opens": _event("60 deg"),
    "exhaust_closes": _event("15 deg"),
    "ignition": KeySpec(_BEFORE),
    "ignition_delay": KeySpec(_EVENT),
    "peak": KeySpec(_BEFORE, default="12 deg"),
})  # fmt: skip

_REAL, _IDEAL = ("petrol", "diesel"), ("otto", "ideal-diesel", "dual")
_PETROL, _DIESEL = _ASSIGNED = "assigned-petrol", "assigned-diesel"
_OF_ASSIGNED, _OF_EXPONENTS = {"kind": _ASSIGNED}, {"kind": _REAL + _ASSIGNED}
_OF_REAL, _OF_IDEAL, _OF_WIEBE = {"kind": _REAL}, {"kind": _IDEAL}, {"kind": ("wiebe",)}
_RATIOS = DefaultBy("kind", dict.fromkeys(_IDEAL, 1.4) | {"wiebe": 1.33})
_INTAKE = DefaultBy("kind", dict.fromkeys(_IDEAL, "0.1 MPa") | {"wiebe": "0.09 MPa"})
_WARM = DefaultBy("kind", dict.fromkeys(_IDEAL, "300 K") | {"wiebe": "340 K"})
_CORNERS, _CLOSED = {"kind": _REAL + _IDEAL + _ASSIGNED}, {"kind": (*_IDEAL, "wiebe")}
_LEVELS = {kind: PEAK_LEVEL["petrol" if kind in ("petrol", "otto", _PETROL) else "diesel"] for kind in _CORNERS["kind"]}


def _by_school(name: str) -> DefaultBy:
    """Return the default of a convention by the school that has it."""
    records = {key: record for key, record in SCHOOLS.items() if isinstance(record.get("source"), str)}
    return DefaultBy("school", {school: record[name] for school, record in records.items() if name in record})


CYCLE = TableSpec("cycle", {
    "kind": KeySpec(Choice((*_REAL, *_IDEAL, *_ASSIGNED, "wiebe")), required=True),
    "cycle": KeySpec(Choice(("720 deg", "360 deg")), default="720 deg"),
    "fuel": KeySpec(NameOr(_FUEL), only=_OF_REAL),
    "excess_air": KeySpec(Number(0.2, 20.0), only=_OF_REAL),
    "ambient_pressure": KeySpec(Quantity(("pressure",), 0.0, 1e9), default="0.1 MPa"),
    "ambient_temperature": KeySpec(_TEMPERATURE, default="293 K", only=_OF_REAL),
    "charge_pressure": KeySpec(_CYCLE_PRESSURE, only=_OF_REAL),
    "charge_temperature": KeySpec(_TEMPERATURE, only=_OF_REAL),
    "intake_pressure": KeySpec(_CYCLE_PRESSURE, required=_ASSIGNED, default=_INTAKE),
    "intake_temperature": KeySpec(_TEMPERATURE, default=_WARM, only=_CLOSED),
    "intake_loss_factor": KeySpec(Number(0.0, 50.0), only=_OF_REAL),
    "intake_speed": KeySpec(Quantity(("velocity",), 0.0, 1000.0), only=_OF_REAL),
    "residual_pressure": KeySpec(
        _CYCLE_PRESSURE, _ASSIGNED, default=DefaultBy("kind", {"wiebe": "0.11 MPa"}),
        only={"kind": (*_REAL, *_ASSIGNED, "wiebe")},
    ),
    "residual_temperature": KeySpec(_TEMPERATURE, only=_OF_REAL),
    "heating": KeySpec(_RISE, only=_OF_REAL),
    "charge_up": KeySpec(Number(0.5, 1.5), default=1.0, only=_OF_REAL),
    "scavenging": KeySpec(Number(0.0, 1.5), default=1.0, only=_OF_REAL),
    "compression_exponent": KeySpec(_EXPONENT, _ASSIGNED, ("compression_pressure",), only=_OF_EXPONENTS),
    "compression_pressure": KeySpec(_CYCLE_PRESSURE, instead_of=("compression_exponent",), only=_OF_ASSIGNED),
    "peak_pressure": KeySpec(_CYCLE_PRESSURE, _ASSIGNED, ("pressure_ratio",), only=_OF_ASSIGNED),
    "expansion_exponent": KeySpec(_EXPONENT, _ASSIGNED, ("expansion_pressure",), only=_OF_EXPONENTS),
    "expansion_pressure": KeySpec(_CYCLE_PRESSURE, instead_of=("expansion_exponent",), only=_OF_ASSIGNED),
    "total_volume": KeySpec(_VOLUME, only=_OF_ASSIGNED),
    "heat_use": KeySpec(Number(0.2, 1.2), only=_OF_REAL),
    "pressure_ratio": KeySpec(
        Number(1.0, 10.0), instead_of=("peak_pressure",), only={"kind": ("diesel", *_IDEAL, *_ASSIGNED)}
    ),
    "cut_off": KeySpec(
        Number(1.0, 10.0), (_DIESEL,), default=DefaultBy("kind", {_PETROL: 1.0}), only={"kind": _IDEAL + _ASSIGNED}
    ),
    "heat": KeySpec(Quantity(("specific_energy",), 0.0, 1e8), only=_OF_IDEAL),
    "peak_temperature": KeySpec(_TEMPERATURE, only=_OF_IDEAL),
    "adiabatic_exponent": KeySpec(Number(1.01, 2.0), default=_RATIOS, only=_CLOSED),
    "filling": KeySpec(Number(0.5, 1.0), only=_CORNERS),
    "mechanical_loss": KeySpec(ListOf(_SHARE, fewest=2, most=2), only=_OF_REAL),
    "heat_capacities": KeySpec(Choice(("kolchin", "vietnamese", "linear")), default="kolchin", only=_OF_REAL),
    "power": KeySpec(Quantity(("power",), 1.0, 1e9), only=_OF_REAL),
    "stroke_bore_ratio": KeySpec(Number(0.2, 5.0), default=1.0, only=_OF_REAL),
    "lost_stroke": KeySpec(Number(0.0, 0.6), only=_OF_REAL),
    "corners": KeySpec(Choice(("rounded", "sharp")), only=_CORNERS),
    "peak_level": KeySpec(Number(0.5, 1.0), default=DefaultBy("kind", _LEVELS), only=_CORNERS),
    "school": KeySpec(Choice(("ru", "vi", "none")), default="ru", only=_CORNERS),
    "rise": KeySpec(Number(1.0, 3.0), instead_of=("rise_share",), default=_by_school("rise"), only=_CORNERS),
    "rise_share": KeySpec(_SHARE, instead_of=("rise",), default=_by_school("rise_share"), only=_CORNERS),
    "blow_down": KeySpec(Choice(("exhaust", "intake")), default=_by_school("blow_down"), only=_CORNERS),
    "timing": KeySpec(_TIMING),
    "combustion_start": KeySpec(Quantity(("angle",), -math.pi / 2, math.pi / 2), default="20 deg", only=_OF_WIEBE),
    "combustion_duration": KeySpec(Quantity(("angle",), math.radians(1), math.pi), default="50 deg", only=_OF_WIEBE),
    "shape": KeySpec(Number(0.0, 10.0), default=2.0, only=_OF_WIEBE),
    "cycle_heat": KeySpec(Quantity(("energy",), 1e-6, 1e9), only=_OF_WIEBE),
    "fuel_mass": KeySpec(Quantity(("mass",), 1e-12, 1e3), only=_OF_WIEBE),
    "heating_value": KeySpec(Quantity(("specific_energy",), 1e6, 2e8), only=_OF_WIEBE),
    "burning_efficiency": KeySpec(Number(0.1, 1.0), default=1.0, only={**_OF_WIEBE, "fuel_mass": ()}),
    "wall_temperature": KeySpec(_TEMPERATURE, only=_OF_WIEBE),
    "motored": KeySpec(Choice(("compressed", "ambient")), default="compressed"),
    "source": KeySpec(Text()),
})  # fmt: skip

# of a chamber, which states period and ambient pressure itself; there is no combustion in one that states `motored`
CHAMBER_CYCLE = CYCLE._replace(keys={
    **{name: key for name, key in CYCLE.keys.items() if name not in ("cycle", "ambient_pressure")},
    "cycle_heat": KeySpec(Quantity(("energy",), 0.0, 1e9), only=_OF_WIEBE),
    "motored": CYCLE.keys["motored"]._replace(default=None),
})  # fmt: skip

# the keys of an engine that determine those of the linkage that it is, the likeliest first
OF_LINKAGE = (
    (r"crank\.(mass|inertia|centre.*)", ("crank.mass",)),
    (r"crank\.(start|points.*)", ("engine.throws", "engine.firing_order", "engine.layout", "cylinder.inclination")),
    (r"links\.rod(_\d+)?\.points.*", ("engine.articulated.knuckle_radius",)),
    (r"links\.rod(_\d+)?\.length", ("rod.length", "rod.ratio", "engine.articulated.rod_length")),
    (r"links\.rod(_\d+)?\.inertia", ("rod.inertia", "rod.radius_of_gyration", "rod.mass", "rod.small_end_mass")),
    (r"links\.rod(_\d+)?\.centre.*", ("rod.centre_of_mass", "rod.small_end_share", "rod.small_end_mass")),
    (r"links\.rod(_\d+)?\.mass", ("rod.mass", "rod.small_end_mass", "rod.big_end_mass")),
    (r"sliders\.piston(_\d+)?\.mass", ("piston.mass", "engine.piston_masses")),
    (r"guides\.bore(_\d+)?\..*", ("cylinder.offset", "engine.offsets", "engine.bank_angle", "cylinder.inclination")),
    (r"chambers\.[^.]+\.(faces\[1\]\.)?bore", ("cylinder.bore", "engine.bores")),
    (r"chambers\.[^.]+\.(faces\[1\]\.)?rod_diameter", ("cylinder.piston_rod_diameter",)),
    (
        r"chambers\.[^.]+\.(compression_ratio|clearance_volume)",
        ("cylinder.compression_ratio", "cylinder.clearance_volume", "engine.clearance_volumes"),
    ),
    (r"chambers\.[^.]+\.period", ("gas.cycle", "cycle.cycle")),
    (r"chambers\.[^.]+\.delay", ("engine.firing_order", "engine.layout")),
    (r"chambers\.[^.]+\.ambient", ("gas.ambient", "cycle.ambient_pressure")),
    (r"chambers\.[^.]+\.pressure_factor", ("engine.pressure_factors",)),
    (r"chambers\.crank_end(_\d+)?\.pressure", ("gas.back_pressure",)),
    (r"chambers\.[^.]+\.cycle(\..*)?", (r"cycle\1", "cycle")),
    (r"chambers\.[^.]+\.(.*)", (r"gas.\1", "gas", "cycle")),
)

_CRANK = TableSpec("crank", {
    "radius": KeySpec(LENGTH, required=True, instead_of=("stroke",)),
    "stroke": KeySpec(LENGTH, instead_of=("radius",)),
    "speed": KeySpec(Quantity(("speed",), 1e-6, 3e4), required=True),
    "angular_acceleration": NO_ACCELERATION,
    "mass": KeySpec(_MASS),
})  # fmt: skip

_ENDS = ("small_end_mass", "big_end_mass")
_PENDULUM = TableSpec("pendulum", {
    **dict.fromkeys(("small_end_period", "big_end_period"), KeySpec(Quantity(("time",), 1e-3, 1e3), required=True)),
    **dict.fromkeys(("small_end_diameter", "big_end_diameter"), KeySpec(LENGTH, required=True)),
})  # fmt: skip
_MEASURED_ROD = ("small_end_share", "centre_of_mass", "inertia", "radius_of_gyration")
_ROD = TableSpec("rod", {
    "ratio": KeySpec(Number(1e-6, 1e6), required=True, instead_of=("length",)),
    "length": KeySpec(LENGTH, instead_of=("ratio",)),
    "ratio_definition": KeySpec(Choice(("r/l", "l/r")), default="r/l"),
    "mass": KeySpec(_MASS),
    "small_end_share": KeySpec(Number(0.0, 1.0), instead_of=("centre_of_mass", *_ENDS)),
    "centre_of_mass": KeySpec(LENGTH, instead_of=("small_end_share", *_ENDS)),
    "small_end_mass": KeySpec(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "big_end_mass": KeySpec(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "inertia": KeySpec(Quantity(("inertia",), 0.0, 1e6), instead_of=("radius_of_gyration",)),
    "radius_of_gyration": KeySpec(LENGTH, instead_of=("inertia",)),
    "pendulum": KeySpec(_PENDULUM, instead_of=_MEASURED_ROD, only={"mass": ()}),
    "equivalent": KeySpec(Choice(("two masses", "three masses")), only={"mass": ()}),
})  # fmt: skip

_PISTON = TableSpec("piston", {"mass": KeySpec(_MASS)})

_CYLINDER = TableSpec("cylinder", {
    "bore": KeySpec(Quantity(("length",), 1e-4, 100.0), required=True),
    "displacement": KeySpec(_VOLUME),
    "stroke_bore_ratio": KeySpec(Number(0.2, 5.0)),
    "clearance_volume": KeySpec(_VOLUME._replace(low=0.0), instead_of=("compression_ratio",)),
    "compression_ratio": KeySpec(Number(1.001, 100.0), instead_of=("clearance_volume",)),
    "offset": KeySpec(Quantity(("length",), -100.0, 100.0), default="0 mm"),
    "inclination": KeySpec(_ANGLE),
    "travels": KeySpec(MapOf(Quantity(("length",), -100.0, 100.0), most=40)),
    "piston_rod_diameter": KeySpec(LENGTH),
})  # fmt: skip

POINT = TableSpec("point", {
    "angle": KeySpec(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9), instead_of=("stroke",)),
    "stroke": KeySpec(Number(0.0, 1.0), instead_of=("angle",)),
    "pressure": KeySpec(_PRESSURE),
    "volume": KeySpec(_VOLUME),
})  # fmt: skip

PIECE = TableSpec("piece", {
    "law": KeySpec(Choice(("constant", "polytropic", "rounded", "straight")), required=True),
    "points": KeySpec(ListOf(Text(60), fewest=2), required=True),
    "exponent": KeySpec(Number(0.0, 5.0), only={"law": ("polytropic",)}),
    "reference": KeySpec(Text(60), only={"law": ("polytropic",)}),
})  # fmt: skip

_PEG = TableSpec("peg", {
    "angle": KeySpec(_ANGLE, required=True, instead_of=("exponent",), example='"180 deg"'),
    "pressure": KeySpec(_PRESSURE, required=True, only={"angle": ()}, example='"1 bar"'),
    "exponent": KeySpec(Number(1.0, 2.0), instead_of=("angle",), example="1.32"),
    "from": KeySpec(_ANGLE, required=True, only={"exponent": ()}, example='"270 deg"'),
    "to": KeySpec(_ANGLE, required=True, only={"exponent": ()}, example='"330 deg"'),
})  # fmt: skip
# of a file with a column of angles, which steps replace
_OF_TABLE = ("angle_column", "pressure_column", "angle_unit", "time_column")
_OVER_TIME = {"time_column": ()}
_COLUMN = NameOr(Number(1, 16_384, whole=True))
MEASURED = TableSpec("measured", {
    "file": KeySpec(Text(1000), required=True, instead_of=("values",)),
    "values": KeySpec(ListOf(Number(-1e9, 1e9), fewest=8), instead_of=("file",), only={"step": ()}),
    "start": KeySpec(_ANGLE, default="0 deg", only={"step": ()}),
    "step": KeySpec(Quantity(("angle",), math.radians(0.01), math.radians(90)), instead_of=_OF_TABLE),
    "sheet": SHEET,
    "angle_column": KeySpec(_COLUMN),
    "pressure_column": KeySpec(_COLUMN),
    "angle_unit": KeySpec(UnitOf("angle")),
    "time_column": KeySpec(_COLUMN, instead_of=("angle_column", "angle_unit", "step")),
    "time_unit": KeySpec(UnitOf("time"), only=_OVER_TIME),
    "speed": KeySpec(SPEED, required=True, only=_OVER_TIME),
    "pressure_unit": KeySpec(UnitOf("pressure")),
    "shift": KeySpec(_ANGLE, default="0 deg"),
    "reversed": KeySpec(Flag(), default=False),
    "cycle": KeySpec(WordOr(Choice(("mean", "greatest peak", "least peak")), Number(1, 1e6, whole=True))),
    "rest_pressure": KeySpec(_PRESSURE),
    "peg": KeySpec(_PEG),
    "smooth": KeySpec(Quantity(("angle",), math.radians(0.1), math.radians(90))),
    "loss_angle": KeySpec(Quantity(("angle",), 0.0, math.radians(10))),
    "resample": KeySpec(Quantity(("angle",), math.radians(0.01), math.radians(30))),
})  # fmt: skip

_COLUMNS = KeySpec(ListOf(_COLUMN, fewest=2, most=MOST_CYLINDERS), instead_of=("pressure_column", "step"))
_OF_ALL = MEASURED._replace(keys={**MEASURED.keys, "columns": _COLUMNS})

_OPENING = Quantity(("pressure",), 1.0, 1e10)
_KELVIN = Quantity(("temperature",), 1.0, 1e4)
VALVES = TableSpec("valves", {
    "suction": KeySpec(_OPENING, required=True),
    "discharge": KeySpec(_OPENING, required=True),
    "compression_exponent": KeySpec(_EXPONENT, instead_of=("discharge_temperature",)),
    "expansion_exponent": KeySpec(_EXPONENT),
    "temperature": KeySpec(_KELVIN),
    "discharge_temperature": KeySpec(_KELVIN, instead_of=("compression_exponent",), only={"temperature": ()}),
    "gas_constant": KeySpec(Quantity(("specific_heat",), 1.0, 1e5), only={"temperature": ()}),
    "free_pressure": KeySpec(_OPENING, only={"temperature": (), "free_temperature": ()}, example='"0.1 MPa"'),
    "free_temperature": KeySpec(_KELVIN, only={"temperature": (), "free_pressure": ()}),
    "delivered": KeySpec(Quantity(("volume_rate",), 0.0, 1e6, above=True)),
})  # fmt: skip

_LIQUID = {"density": ()}
_HEIGHT = Quantity(("length",), -100.0, 1e4)
_PIPE = TableSpec("pipe", {
    "length": KeySpec(Quantity(("length",), 1e-3, 1e5), required=True),
    "diameter": KeySpec(LENGTH, required=True),
    "friction": KeySpec(Number(0.0, 1.0), default=0.0),
})  # fmt: skip
# those of a chamber may stand at the end of pipes
PIPED_VALVES = VALVES._replace(keys={
    **VALVES.keys,
    "suction": KeySpec(_OPENING, required=True, instead_of=("suction_height",)),
    "discharge": KeySpec(_OPENING, required=True, instead_of=("discharge_height",)),
    "suction_height": KeySpec(_HEIGHT, instead_of=("suction",), only={"density": ()}),
    "discharge_height": KeySpec(_HEIGHT, instead_of=("discharge",), only={"density": ()}),
    "density": KeySpec(Quantity(("density",), 1.0, 1e5), instead_of=("compression_exponent", "discharge_temperature")),
    "suction_pipe": KeySpec(_PIPE, only=_LIQUID),
    "discharge_pipe": KeySpec(_PIPE, only=_LIQUID),
    "vapour_pressure": KeySpec(_OPENING, only=_LIQUID),
})  # fmt: skip

_WINDOW = ListOf(_ANGLE, fewest=2, most=2)
_COMBUSTION = TableSpec("combustion", {
    "from": KeySpec(_ANGLE, required=True, example='"220 deg"'),
    "to": KeySpec(_ANGLE, required=True, example='"480 deg"'),
    "adiabatic_exponent": KeySpec(Number(1.01, 2.0), default=1.33),
    "temperature": KeySpec(_TEMPERATURE),
    "exponent_slope": KeySpec(Number(-1e-3, 1e-3), default=0.0, only={"temperature": ()}),
    "wall_temperature": KeySpec(_TEMPERATURE, only={"temperature": ()}),
    "burning": KeySpec(_WINDOW),
    "windows": KeySpec(ListOf(_WINDOW, fewest=1, most=20)),
})  # fmt: skip

# lists of a table of pressures over the stroke, from the top dead centre on
STROKES = {"720 deg": ("intake", "compression", "expansion", "exhaust"), "360 deg": ("down", "up")}
# keys of the pressure of a cylinder or chamber
PRESSURES = KeySpec(Choice(("gauge", "absolute")), default="gauge")
_PRESSURES = ListOf(Number(-1e9, 1e9), fewest=2, most=500)
_STROKES = TableSpec("stroke_table", {
    "shares": KeySpec(ListOf(Number(0.0, 1.0), fewest=2, most=500), required=True),
    **{name: KeySpec(_PRESSURES) for names in STROKES.values() for name in names},
    "largest": KeySpec(Quantity(("pressure",), 0.0, 1e10, above=True), instead_of=("unit",)),
    "unit": KeySpec(UnitOf("pressure"), instead_of=("largest",)),
    "law": KeySpec(Choice(("straight", "rounded")), default="straight"),
})  # fmt: skip
DIAGRAM = {
    "points": KeySpec(MapOf(POINT)),
    "pieces": KeySpec(ListOf(PIECE, fewest=1, most=500)),
    "strokes": KeySpec(_STROKES, instead_of=("points", "pieces")),
    "measured": KeySpec(MEASURED, instead_of=("points", "pieces", "strokes")),
}
_OWN = {**DIAGRAM, "valves": KeySpec(VALVES, instead_of=tuple(DIAGRAM))}
_GAS = TableSpec("gas", {
    "cycle": KeySpec(Choice(("720 deg", "360 deg")), required=True, instead_of=("pressure",)),
    "pressure": KeySpec(_PRESSURE, instead_of=("cycle", *DIAGRAM, "valves", "cylinders")),
    "ambient": KeySpec(Quantity(("pressure",), 0.0, 1e7), default=AMBIENT, only={"pressures": ("absolute",)}),
    "back_pressure": KeySpec(_PRESSURE),
    "pressures": PRESSURES,
    **DIAGRAM,
    "measured": DIAGRAM["measured"]._replace(kind=_OF_ALL),
    "valves": KeySpec(VALVES, instead_of=tuple(DIAGRAM), only={"pressures": ("absolute",), "cycle": ("360 deg",)}),
    "combustion": KeySpec(_COMBUSTION, only={"measured": ()}),
    "cylinders": KeySpec(MapOf(TableSpec("gas", _OWN), most=28)),
    "motored": KeySpec(NameOr(TableSpec("gas", DIAGRAM))),
})  # fmt: skip

_WARMER = Quantity(("temperature_rise",), 0.0, 2000.0, above=True)
WATER_HEAT = "4186.8 J/(kg*K)"
# what a test bed measured, by the quantities that it states
_TESTED: dict[Any, tuple[str, ...]] = {
    Quantity(("force",), 0.0, 1e9): ("brake_load", "brake_spring_load"),
    LENGTH: (
        "brake_arm", "brake_drum_diameter", "brake_rope_diameter", "brake_circumference", "card_length",
        "orifice_diameter",
    ),
    TORQUE: ("effective_torque",),
    Quantity(("power",), 0.0, 1e9): ("effective_power", "indicated_power"),
    Quantity(("area",), 0.0, 1.0): ("card_area", "card_loop_area"),
    Quantity(("pressure_by_length",), 1.0, 1e12): ("card_spring",),
    _CYCLE_PRESSURE: (
        "indicated_mean_pressure", "crank_side_pressure", "effective_mean_pressure", "air_pressure", "peak_pressure",
    ),
    SPEED: ("working_cycle_rate", "idle_speed"),
    Quantity(("mass_rate",), 0.0, 1e6, above=True): ("fuel_rate", "air_rate", "coolant_rate"),
    Quantity(("volume_rate",), 0.0, 1e3, above=True): ("fuel_flow",),
    Quantity(("density",), 0.01, 2e3): ("fuel_density",),
    Quantity(("fuel_consumption",), 1e-12, 1.0): ("effective_fuel_consumption",),
    Quantity(("specific_energy",), 1e6, 2e8): ("fuel_heating_value",),
    Quantity(("pressure",), 0.0, 1e7): ("orifice_drop", "mechanical_loss_constant"),
    _TEMPERATURE: ("air_temperature",),
    _WARMER: ("coolant_rise", "exhaust_rise"),
    Quantity(("pressure_by_velocity",), 0.0, 1e6): ("mechanical_loss_slope",),
    Quantity(("pressure_by_square_velocity",), 0.0, 1e5): ("mechanical_loss_square",),
    Number(0.0, 1.0): ("mechanical_loss_share",),
    Number(1.0, 100.0, above=True): ("compression_ratio",),
    Number(0.0, 1.0, above=True): ("mechanical_efficiency", "discharge_coefficient"),
}  # fmt: skip
TEST = TableSpec("test", {
    "cylinders": KeySpec(Number(1, MOST_CYLINDERS, whole=True)),
    "strokes": KeySpec(Choice((4, 2))),
    "one_cut": KeySpec(ListOf(Quantity(("force", "torque", "power"), 0.0, 1e9), fewest=2, most=MOST_CYLINDERS)),
    "load_powers": KeySpec(ListOf(Quantity(("power",), 0.0, 1e9), fewest=2, most=200), only={"load_fuel_rates": ()}),
    "load_fuel_rates": KeySpec(ListOf(Quantity(("mass_rate",), 0.0, 1e6, above=True), fewest=2, most=200),
                               only={"load_powers": ()}, example='["2 kg/h", "4 kg/h", "6 kg/h"]'),
    **{name: KeySpec(kind) for kind, names in _TESTED.items() for name in names},
    "coolant_heat": KeySpec(Quantity(("specific_heat",), 1.0, 1e5), default=WATER_HEAT,
                            only={"coolant_rate": ()}),
    "exhaust_heat": KeySpec(Quantity(("specific_heat",), 1.0, 1e5), default="1005 J/(kg*K)", only={"exhaust_rise": ()}),
    "heat_ratio": KeySpec(Number(1.0, 2.0, above=True), default=1.4, only={"compression_ratio": ()}),
})  # fmt: skip

METHOD = TableSpec("method", {
    "kinematics": KeySpec(Text(20), default="exact"),
    "rod": KeySpec(Choice(("rigid", "two-mass"))),
    "pi": KeySpec(Number(3.0, 3.2), default=math.pi),
    "gravity": KeySpec(Quantity(("acceleration",), 0.0, 100.0), default=f"{STANDARD_GRAVITY} m/s2"),
    "weights": KeySpec(Flag(), default=False),
    "inertia_rod_ratio": KeySpec(Number(1e-6, 1.0)),
})  # fmt: skip

TABLE = TableSpec("table", {
    "step": KeySpec(Quantity(("angle",), math.radians(0.01), math.radians(180)), default="10 deg"),
    "special_angles": KeySpec(ListOf(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9))),
})  # fmt: skip

FORMATS = (1, 2)
TITLE = {
    "title": KeySpec(Text()),
    "format": KeySpec(Choice(FORMATS), default=1),
    "decimal_mark": KeySpec(Choice((".", ",")), default="."),
    "units": KeySpec(Choice(("metric", "si", "imperial")), default="metric"),
}

MACHINE_FILE = TableSpec("file", {
    **TITLE,
    "document": ENGINE_DOCUMENT,
    "crank": KeySpec(_CRANK, required=True),
    "rod": KeySpec(_ROD, required=True),
    "piston": KeySpec(_PISTON),
    "cylinder": KeySpec(_CYLINDER),
    "gas": KeySpec(_GAS, instead_of=("cycle",)),
    "cycle": KeySpec(CYCLE, instead_of=("gas",)),
    "engine": KeySpec(ENGINE),
    "bearings": KeySpec(BEARINGS),
    "balance": KeySpec(BALANCE),
    "torsion": CRANKSHAFT_TORSION,
    **LOADING,
    "flywheel": KeySpec(FLYWHEEL),
    "test": KeySpec(TEST),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip
# a test alone, of an engine of which only its sizes are known
_TURNED = TableSpec("crank", {key: _CRANK.keys[key]._replace(required=False) for key in ("radius", "stroke", "speed")})
# of one cylinder and four strokes where nothing else is stated
_ALONE = TEST._replace(keys={
    **TEST.keys,
    "cylinders": TEST.keys["cylinders"]._replace(default=1),
    "strokes": TEST.keys["strokes"]._replace(default=4),
})  # fmt: skip
_BORED = ("bore", "displacement", "piston_rod_diameter")
TEST_FILE = TableSpec("file", {
    **TITLE,
    "document": TEST_DOCUMENT,
    "crank": KeySpec(_TURNED),
    "cylinder": KeySpec(TableSpec("cylinder", {key: _CYLINDER.keys[key]._replace(required=False) for key in _BORED})),
    "test": KeySpec(_ALONE, required=True),
    "method": KeySpec(METHOD),
})  # fmt: skip


_CLUTCH_SHAFT = {
    "speed": KeySpec(SPEED),
    "inertia": KeySpec(_DISC_INERTIA, instead_of=("mass",)),
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e9), instead_of=("inertia",)),
    "radius_of_gyration": KeySpec(LENGTH, required=True, only={"mass": ()}),
    "torque": KeySpec(TORQUE),
}
_OF_FACE = ("outer_diameter", "inner_diameter")
CLUTCH_FILE = TableSpec("file", {
    **TITLE,
    "document": CLUTCH_DOCUMENT,
    "clutch": KeySpec(TableSpec("clutch", {
        "contact": KeySpec(Choice(("uniform wear", "uniform pressure")), default="uniform wear",
                           only={"outer_diameter": ()}),
        "faces": KeySpec(Number(1, 1000, whole=True), default=2, instead_of=("cone_angle",), only={"friction": ()}),
        "friction": KeySpec(Number(0.0, 2.0, above=True)),
        "outer_diameter": KeySpec(LENGTH, instead_of=("mean_radius",)),
        "inner_diameter": KeySpec(LENGTH, required=True, only={"outer_diameter": ()}),
        "mean_radius": KeySpec(LENGTH, instead_of=_OF_FACE),
        "cone_angle": KeySpec(Quantity(("angle",), 0.01, math.pi / 2), instead_of=("faces",)),
        "force": KeySpec(Quantity(("force",), 0.0, 1e9, above=True), instead_of=("pressure", "torque", "power")),
        "pressure": KeySpec(Quantity(("pressure",), 1.0, 1e9), instead_of=("force", "torque", "power"),
                            only={"outer_diameter": ()}),
        "torque": KeySpec(Quantity(("torque",), 0.0, 1e9, above=True), instead_of=("force", "pressure", "power")),
        "power": KeySpec(Quantity(("power",), 0.0, 1e9, above=True), instead_of=("force", "pressure", "torque"),
                         only={"driving": ()}),
        "driving": KeySpec(TableSpec("clutch_shaft", _CLUTCH_SHAFT)),
        "driven": KeySpec(TableSpec("clutch_shaft", _CLUTCH_SHAFT)),
    }), required=True),
    "method": KeySpec(METHOD),
})  # fmt: skip


# for files in which a required power, a displacement or a ratio gives bore and stroke
_SIZED = with_defaults(MACHINE_FILE, "crank", _CRANK, radius=None)
SIZED_FILE = with_defaults(_SIZED, "cylinder", _CYLINDER, bore=None)

# for a calculation of a working cycle alone; only its motion needs a rod
CYCLE_FILE, SIZED_CYCLE_FILE = (with_defaults(keys, "rod", _ROD, ratio=0.25) for keys in (MACHINE_FILE, SIZED_FILE))


# for engines with loads, friction or a liquid, whose note is that of a linkage
_WITH_LIQUID = _GAS._replace(keys={**_GAS.keys, "valves": _GAS.keys["valves"]._replace(kind=PIPED_VALVES)})
LOADED_FILE, LOADED_SIZED_FILE = (
    keys._replace(keys={**keys.keys, "document": LINKAGE_DOCUMENT, "gas": keys.keys["gas"]._replace(kind=_WITH_LIQUID)})
    for keys in (MACHINE_FILE, SIZED_FILE)
)
# where an offset is all that is known of the cylinder
OFFSET_FILE, LOADED_OFFSET_FILE = (
    with_defaults(keys, "cylinder", _CYLINDER, bore=None) for keys in (MACHINE_FILE, LOADED_FILE)
)
GIVEN_SPEED = ((MACHINE_FILE, LOADED_FILE), (OFFSET_FILE, LOADED_OFFSET_FILE))
# where it starts by itself, or where nothing has a mass
UNIT_SPEED = tuple(tuple(with_defaults(keys, "crank", _CRANK, speed="1 rad/s") for keys in row) for row in GIVEN_SPEED)
