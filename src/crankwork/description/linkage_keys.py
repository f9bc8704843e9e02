"""The keys of a machine file that describes a linkage, or the transfer functions of one as a document prints them."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.description import document_keys
from crankwork.description.engine_keys import BEARINGS, FLYWHEEL, HEAT_RELEASE
from crankwork.description.keys import (
    AMBIENT,
    DIAGRAM,
    METHOD,
    NO_ACCELERATION,
    PIPED_VALVES,
    PRESSURES,
    SHEET,
    TABLE,
    TITLE,
)
from crankwork.description.kinds import Choice, Flag, Number, Quantity, Text
from crankwork.description.schema import KeySpec, ListOf, MapOf, NameOr, Nested, NumberOr, TableSpec
from crankwork.mechanism.driver import LawKind

_LENGTH = Quantity(("length",), 1e-6, 100.0)
_COORDINATE = Quantity(("length",), -1e3, 1e3)
_PLACE = ListOf(_COORDINATE, fewest=2, most=2)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_TURN = Quantity(("angle",), 0.0, 4 * math.pi + 1e-9)
_SPEED = Quantity(("speed",), 1e-6, 3e4)
_TORQUE = Quantity(("torque",), -1e9, 1e9)
_FORCE = Quantity(("force",), -1e9, 1e9)
_NAME = Text(60)
_NO_ANGLE = KeySpec(_ANGLE, default="0 deg")
_INERTIA = KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2")
# bodies that turn about a pivot: all inertia counts, also that of the mass at its distance
_TURNING = {"mass": KeySpec(Quantity(("mass",), 1e-9, 1e6)), "inertia": _INERTIA._replace(default=None),
            "centre": KeySpec(NameOr(_PLACE))}  # fmt: skip
_MASS = {**_TURNING, "inertia": _INERTIA._replace(only={"mass": ()})}

_CRANK = TableSpec("driving", {
    "pivot": KeySpec(_NAME, required=True),
    "pin": KeySpec(_NAME, required=True),
    "radius": KeySpec(_LENGTH, required=True),
    "speed": KeySpec(_SPEED, required=True),
    "angular_acceleration": NO_ACCELERATION,
    "start": _NO_ANGLE,
    "direction": KeySpec(Choice(("anticlockwise", "clockwise")), default="anticlockwise"),
    "points": KeySpec(MapOf(_PLACE)),
    **_TURNING,
    "from": KeySpec(_ANGLE),
    "to": KeySpec(_ANGLE),
})  # fmt: skip

_COORDINATE_OF_DRIVER = Quantity(("length", "angle"), -1e3, 1e3)
_TIME = Quantity(("time",), 1e-6, 1e6)

_BY_TABLE, _MOVES = {"kind": ("table",)}, {"kind": tuple(kind for kind in get_args(LawKind) if kind != "dwell")}
_SEGMENT = TableSpec("segment", {
    "kind": KeySpec(Choice(get_args(LawKind)), required=True),
    "to": KeySpec(_COORDINATE_OF_DRIVER, only=_MOVES),
    "over": KeySpec(NumberOr(_TIME, Number(0.0, 1.0, above=True)), required=True, instead_of=("speed",)),
    "speed": KeySpec(Quantity(("velocity", "speed"), 0.0, 3e4, above=True), instead_of=("over",),
                 only={"kind": ("constant",)}),
    "ramp": KeySpec(Number(0.0, 0.5, above=True), default=1 / 3, only={"kind": ("trapezoidal",)}),
    "at": KeySpec(ListOf(Number(0.0, 1.0)), only=_BY_TABLE),
    "values": KeySpec(ListOf(_COORDINATE_OF_DRIVER), only=_BY_TABLE),
})  # fmt: skip

_HALF = TableSpec("half", {
    "mass": KeySpec(Quantity(("mass",), 1e-9, 1e6), required=True),
    "inertia": _INERTIA,
    "centre": KeySpec(_PLACE, required=True),
})  # fmt: skip

_DRIVER = TableSpec("driver", {
    "slider": KeySpec(_NAME),
    "cylinder": KeySpec(ListOf(_NAME, fewest=2, most=2)),
    "barrel": KeySpec(_HALF),
    "rod": KeySpec(_HALF),
    "between": KeySpec(ListOf(_NAME, fewest=2, most=2)),
    "start": KeySpec(_COORDINATE_OF_DRIVER),
    "law": KeySpec(ListOf(_SEGMENT, fewest=1, most=100), required=True),
    "period": KeySpec(_TIME),
})  # fmt: skip

_GEARED = TableSpec("geared", {
    "pivot": KeySpec(_NAME, required=True),
    "ratio": KeySpec(Number(-1e3, 1e3), required=True),
    "start": _NO_ANGLE,
    "points": KeySpec(MapOf(_PLACE), required=True),
    "pressure_angle": KeySpec(Quantity(("angle",), 0.0, math.radians(45))),
    **_TURNING,
})  # fmt: skip

_LINK = TableSpec("link", {
    "joins": KeySpec(ListOf(_NAME, fewest=2), required=True),
    "length": KeySpec(_LENGTH),
    "points": KeySpec(MapOf(_PLACE)),
    "share": KeySpec(Number(-1e3, 1e3)),
    "of": KeySpec(_NAME),
    **_MASS,
})  # fmt: skip

_SLIDER = TableSpec("slider", {
    "guide": KeySpec(_NAME, required=True),
    "pin": KeySpec(_NAME),
    "points": KeySpec(MapOf(_PLACE)),
    **_MASS,
})  # fmt: skip

_GUIDE = TableSpec("guide", {
    "through": KeySpec(NameOr(_PLACE), default=["0 mm", "0 mm"]),
    "angle": _NO_ANGLE,
    "link": KeySpec(_NAME),
})  # fmt: skip

_PROCESS, _PUSH, _TURNS, _SPRING, _DAMPER = (
    {"kind": (kind,)} for kind in ("process", "force", "torque", "spring", "damper")
)
_BY_COLUMN, _BETWEEN = {"kind": ("process", "torque")}, {"kind": ("spring", "damper")}
_LOAD = TableSpec("load", {
    "kind": KeySpec(Choice(("process", "force", "torque", "spring", "damper")), required=True),
    "slider": KeySpec(_NAME, required=("process",), only={"kind": ("process", "spring", "damper")}),
    "point": KeySpec(_NAME, required=True, only=_PUSH),
    "link": KeySpec(_NAME, required=("torque",), only={"kind": ("force", "torque")}),
    "between": KeySpec(ListOf(_NAME, fewest=2, most=2), only=_BETWEEN),
    "links": KeySpec(ListOf(_NAME, fewest=2, most=2), only={"between": ()}),
    "x": KeySpec(_FORCE, default="0 N", only=_PUSH),
    "y": KeySpec(_FORCE, default="0 N", only=_PUSH),
    "against": KeySpec(Choice(("stroke", "angle")), default="stroke", only=_PROCESS),
    "file": KeySpec(Text(1000), only=_BY_COLUMN),
    "sheet": SHEET,
    "at": KeySpec(ListOf(Quantity(("length", "angle"), -1e3, 1e3), fewest=2, from_file=True), only=_BY_COLUMN),
    "force": KeySpec(ListOf(_FORCE, fewest=1, from_file=True), required=True, only=_PROCESS),
    "torque": KeySpec(ListOf(_TORQUE, fewest=1, from_file=True), required=True, only=_TURNS),
    "curve": KeySpec(Choice(("straight", "smooth")), default="straight", only=_BY_COLUMN),
    "stroke": KeySpec(Choice(("growing", "falling")), default="growing", only=_PROCESS),
    "start": KeySpec(_COORDINATE, only=_PROCESS),
    "acts": KeySpec(Choice(("forward", "both")), default="forward", only=_PROCESS),
    "stiffness": KeySpec(Quantity(("stiffness",), 0.0, 1e12), required=True, only=_SPRING),
    "free_length": KeySpec(Quantity(("length",), 0.0, 1e3), default="0 mm", only=_SPRING),
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
    "length": KeySpec(_LENGTH, only={"coefficient": ()}),
    "force": KeySpec(Quantity(("force",), 0.0, 1e9), default="0 N"),
    "damping": KeySpec(Quantity(("damping",), 0.0, 1e12), default="0 N*s/m"),
})  # fmt: skip
_FRICTION = TableSpec("friction", {
    "circle": KeySpec(Choice(("tangent", "sine")), default="tangent"),
    "pins": KeySpec(MapOf(_PIN_FRICTION, most=500)),
    "sliders": KeySpec(MapOf(_SLIDER_FRICTION, most=300)),
})  # fmt: skip

_BEARING_SIZE = KeySpec(Quantity(("length",), 1e-6, 10.0))
_BEARINGS = TableSpec("bearings", {
    "pins": KeySpec(MapOf(TableSpec("pin_bearing", {
        "diameter": _BEARING_SIZE,
        "length": _BEARING_SIZE,
        "link": KeySpec(_NAME),
    }), most=500)),
    "rays": BEARINGS.keys["rays"],
})  # fmt: skip

EFFICIENCY = TableSpec("efficiency", {
    "chain": KeySpec(Nested(Number(0.001, 1.0)), required=True),
    "decimals": KeySpec(Number(1, 6, whole=True)),
    "losses": KeySpec(Choice(("drive", "machine"))),
})  # fmt: skip

_MOTOR = TableSpec("motor", {
    "rated_power": KeySpec(Quantity(("power",), 1e-3, 1e9), required=True),
    "rated_speed": KeySpec(_SPEED, required=True),
    "overload": KeySpec(Number(1.01, 10.0), required=True),
    "pole_pairs": KeySpec(Number(1, 24, whole=True), required=True),
    "frequency": KeySpec(_SPEED, default="50 Hz"),
    "ratio": KeySpec(Number(1e-4, 1e4), default=1.0),
    "inertia": _INERTIA,
})  # fmt: skip

_ANY_SPEED = Quantity(("speed",), -3e4, 3e4)
_ANY_ANGLE = Quantity(("angle",), -1e4, 1e4)
_TRANSIENT = TableSpec("transient", {
    "time": KeySpec(_TIME, required=True),
    "torque": KeySpec(_TORQUE),
    "motor": KeySpec(Flag()),
    "start": _NO_ANGLE,
    "speed": KeySpec(_ANY_SPEED, default="0 rpm"),
    "until": KeySpec(Choice(("time", "rest", "steady")), default="time"),
    "step": KeySpec(_TIME),
    "speeds": KeySpec(ListOf(_ANY_SPEED, most=20)),
    "stops": KeySpec(ListOf(_ANY_ANGLE, fewest=2, most=2)),
    "restitution": KeySpec(Number(0.0, 1.0), default=0.0, only={"stops": ()}),
})  # fmt: skip

_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_ABSOLUTE = Quantity(("pressure",), 1.0, 1e10)
_TEMPERATURE = KeySpec(Quantity(("temperature",), 1.0, 1e4))
_FACE = {
    "slider": KeySpec(_NAME),
    "bore": KeySpec(_LENGTH, instead_of=("area",)),
    "rod_diameter": KeySpec(_LENGTH),
    "area": KeySpec(Quantity(("area",), 1e-12, 1e4), instead_of=("bore",)),
    "sense": KeySpec(Choice((1, -1)), default=1),
}
_OF_FACE = tuple(_FACE)

_CHAMBER = TableSpec("chamber", {
    **_FACE,
    "faces": KeySpec(ListOf(TableSpec("chamber", _FACE), fewest=1, most=20), instead_of=_OF_FACE),
    "clearance_volume": KeySpec(Quantity(("volume",), 0.0, 1e3), instead_of=("compression_ratio",)),
    "compression_ratio": KeySpec(Number(1.0001, 1e4), instead_of=("clearance_volume",)),
    "period": KeySpec(Choice(("360 deg", "720 deg")), default="360 deg"),
    "ambient": KeySpec(Quantity(("pressure",), 0.0, 1e10), default=AMBIENT),
    "pressure": KeySpec(_PRESSURE, instead_of=("points", "pieces", "measured", "cycle")),
    "pressure_factor": KeySpec(Number(0.0, 10.0), default=1.0),
    "pressures": PRESSURES,
    **DIAGRAM,
    "valves": KeySpec(PIPED_VALVES, instead_of=(*DIAGRAM, "pressure", "cycle"),
                  only={"pressures": ("absolute",), "period": ("360 deg",)}),
    "cycle": KeySpec(HEAT_RELEASE, instead_of=("points", "pieces", "measured", "pressure")),
    "delay": KeySpec(_TURN),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_DEAD_VOLUME = TableSpec("dead_volume", {
    "volume": KeySpec(Quantity(("volume",), 1e-15, 1e3), required=True),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_CHARGE = TableSpec("charge", {
    "chambers": KeySpec(ListOf(_NAME, fewest=1, most=20), required=True),
    "dead_volumes": KeySpec(ListOf(_DEAD_VOLUME, most=50)),
    "gas_constant": KeySpec(Quantity(("specific_heat",), 1.0, 1e5)),
    "exponent": KeySpec(Number(0.0, 5.0)),
    "mean_pressure": KeySpec(_ABSOLUTE, instead_of=("pressure", "mass")),
    "pressure": KeySpec(_ABSOLUTE, instead_of=("mean_pressure", "mass")),
    "angle": KeySpec(_TURN, default="0 deg", only={"pressure": ()}),
    "mass": KeySpec(Quantity(("mass",), 1e-12, 1e6), instead_of=("mean_pressure", "pressure")),
})  # fmt: skip

LINKAGE_FILE = TableSpec("file", {
    **TITLE,
    "document": document_keys.LINKAGE,
    "fixed_points": KeySpec(MapOf(_PLACE)),
    "crank": KeySpec(_CRANK, required=True),
    "geared": KeySpec(MapOf(_GEARED, most=50)),
    "links": KeySpec(MapOf(_LINK, most=500)),
    "guides": KeySpec(MapOf(_GUIDE)),
    "sliders": KeySpec(MapOf(_SLIDER, most=300)),
    "branch": KeySpec(MapOf(Choice((1, -1)))),
    "positions": KeySpec(MapOf(_PLACE)),
    "loads": KeySpec(ListOf(_LOAD)),
    "friction": KeySpec(_FRICTION),
    "bearings": KeySpec(_BEARINGS),
    "chambers": KeySpec(MapOf(_CHAMBER, most=50)),
    "charges": KeySpec(MapOf(_CHARGE, most=20)),
    "efficiency": KeySpec(EFFICIENCY),
    "motor": KeySpec(_MOTOR),
    "flywheel": KeySpec(FLYWHEEL),
    "transient": KeySpec(_TRANSIENT),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip

# a crank with a law has no speed, and other drivers have no crank
DRIVEN_FILE = LINKAGE_FILE._replace(keys={
    **{name: key for name, key in LINKAGE_FILE.keys.items() if name != "bearings"},
    "crank": KeySpec(_CRANK._replace(keys={
        **{name: key._replace(required=False) for name, key in _CRANK.keys.items()},
        "angular_acceleration": NO_ACCELERATION._replace(default=None),
    })),
    "charges": KeySpec(MapOf(_CHARGE._replace(keys={**_CHARGE.keys, "angle": KeySpec(_TURN)}), most=20)),
    "driver": KeySpec(_DRIVER, required=True),
    "table": KeySpec(TableSpec("table", {"step": KeySpec(_TIME)})),
})  # fmt: skip

_BODY = TableSpec("body", {
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e6), default="0 kg"),
    "inertia": _INERTIA,
    "velocity": KeySpec(ListOf(_COORDINATE, fewest=2, from_file=True)),
    "rotation": KeySpec(ListOf(Number(-1e3, 1e3), fewest=2, from_file=True)),
})  # fmt: skip
_TORQUES = ListOf(_TORQUE, fewest=2, from_file=True)
_TRANSFER = TableSpec("transfer", {
    "file": KeySpec(Text(1000)),
    "sheet": SHEET,
    "angles": KeySpec(ListOf(_TURN, fewest=2, from_file=True), required=True),
    "bodies": KeySpec(MapOf(_BODY), required=True),
    "reduced_inertia_1": KeySpec(ListOf(Quantity(("inertia",), -1e9, 1e9), fewest=2, from_file=True),
                             instead_of=("differences",)),
    "differences": KeySpec(Choice(("forward", "central", "spectral")), default="central",
                       instead_of=("reduced_inertia_1",)),
    "static_torque": KeySpec(_TORQUES, instead_of=("balancing_torque",)),
    "balancing_torque": KeySpec(_TORQUES, instead_of=("static_torque",)),
})  # fmt: skip

TRANSFER_FILE = TableSpec("file", {
    **TITLE,
    "document": document_keys.TRANSFER,
    "crank": KeySpec(TableSpec("driving", {"speed": KeySpec(_SPEED, required=True)}), required=True),
    "transfer": KeySpec(_TRANSFER, required=True),
    "efficiency": KeySpec(EFFICIENCY),
    "method": KeySpec(METHOD),
})  # fmt: skip
