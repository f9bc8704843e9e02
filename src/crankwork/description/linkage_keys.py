"""The keys of a machine file that describes a linkage, or the transfer functions of one as a document prints them."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.description import document_keys
from crankwork.description.engine_keys import FLYWHEEL, HEAT_RELEASE
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
from crankwork.description.schema import Key, ListOf, Named, NameOr, Nested, NumberOr, Table
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
_NO_ANGLE = Key(_ANGLE, default="0 deg")
_INERTIA = Key(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2")
# of what turns about a pivot all of it counts, and a mass has the inertia of its distance
_TURNING = {"mass": Key(Quantity(("mass",), 1e-9, 1e6)), "inertia": _INERTIA._replace(default=None),
            "centre": Key(NameOr(_PLACE))}  # fmt: skip
_MASS = {**_TURNING, "inertia": _INERTIA._replace(only={"mass": ()})}

_CRANK = Table("driving", {
    "pivot": Key(_NAME, required=True),
    "pin": Key(_NAME, required=True),
    "radius": Key(_LENGTH, required=True),
    "speed": Key(_SPEED, required=True),
    "angular_acceleration": NO_ACCELERATION,
    "start": _NO_ANGLE,
    "direction": Key(Choice(("anticlockwise", "clockwise")), default="anticlockwise"),
    "points": Key(Named(_PLACE)),
    **_TURNING,
    "from": Key(_ANGLE),
    "to": Key(_ANGLE),
})  # fmt: skip

_COORDINATE_OF_DRIVER = Quantity(("length", "angle"), -1e3, 1e3)
_TIME = Quantity(("time",), 1e-6, 1e6)

_BY_TABLE, _MOVES = {"kind": ("table",)}, {"kind": tuple(one for one in get_args(LawKind) if one != "dwell")}
_SEGMENT = Table("segment", {
    "kind": Key(Choice(get_args(LawKind)), required=True),
    "to": Key(_COORDINATE_OF_DRIVER, only=_MOVES),
    "over": Key(NumberOr(_TIME, Number(0.0, 1.0, above=True)), required=True, instead_of=("speed",)),
    "speed": Key(Quantity(("velocity", "speed"), 0.0, 3e4, above=True), instead_of=("over",),
                 only={"kind": ("constant",)}),
    "ramp": Key(Number(0.0, 0.5, above=True), default=1 / 3, only={"kind": ("trapezoidal",)}),
    "at": Key(ListOf(Number(0.0, 1.0)), only=_BY_TABLE),
    "values": Key(ListOf(_COORDINATE_OF_DRIVER), only=_BY_TABLE),
})  # fmt: skip

_HALF = Table("half", {
    "mass": Key(Quantity(("mass",), 1e-9, 1e6), required=True),
    "inertia": _INERTIA,
    "centre": Key(_PLACE, required=True),
})  # fmt: skip

_DRIVER = Table("driver", {
    "slider": Key(_NAME),
    "cylinder": Key(ListOf(_NAME, fewest=2, most=2)),
    "barrel": Key(_HALF),
    "rod": Key(_HALF),
    "between": Key(ListOf(_NAME, fewest=2, most=2)),
    "start": Key(_COORDINATE_OF_DRIVER),
    "law": Key(ListOf(_SEGMENT, fewest=1, most=100), required=True),
    "period": Key(_TIME),
})  # fmt: skip

_GEARED = Table("geared", {
    "pivot": Key(_NAME, required=True),
    "ratio": Key(Number(-1e3, 1e3), required=True),
    "start": _NO_ANGLE,
    "points": Key(Named(_PLACE), required=True),
    "pressure_angle": Key(Quantity(("angle",), 0.0, math.radians(45))),
    **_TURNING,
})  # fmt: skip

_LINK = Table("link", {
    "joins": Key(ListOf(_NAME, fewest=2), required=True),
    "length": Key(_LENGTH),
    "points": Key(Named(_PLACE)),
    "share": Key(Number(-1e3, 1e3)),
    "of": Key(_NAME),
    **_MASS,
})  # fmt: skip

_SLIDER = Table("slider", {
    "guide": Key(_NAME, required=True),
    "pin": Key(_NAME),
    "points": Key(Named(_PLACE)),
    **_MASS,
})  # fmt: skip

_GUIDE = Table("guide", {
    "through": Key(NameOr(_PLACE), default=["0 mm", "0 mm"]),
    "angle": _NO_ANGLE,
    "link": Key(_NAME),
})  # fmt: skip

_PROCESS, _PUSH, _TURNS, _SPRING, _DAMPER = (
    {"kind": (one,)} for one in ("process", "force", "torque", "spring", "damper")
)
_BY_COLUMN, _BETWEEN = {"kind": ("process", "torque")}, {"kind": ("spring", "damper")}
_LOAD = Table("load", {
    "kind": Key(Choice(("process", "force", "torque", "spring", "damper")), required=True),
    "slider": Key(_NAME, required=("process",), only={"kind": ("process", "spring", "damper")}),
    "point": Key(_NAME, required=True, only=_PUSH),
    "link": Key(_NAME, required=("torque",), only={"kind": ("force", "torque")}),
    "between": Key(ListOf(_NAME, fewest=2, most=2), only=_BETWEEN),
    "links": Key(ListOf(_NAME, fewest=2, most=2), only={"between": ()}),
    "x": Key(_FORCE, default="0 N", only=_PUSH),
    "y": Key(_FORCE, default="0 N", only=_PUSH),
    "against": Key(Choice(("stroke", "angle")), default="stroke", only=_PROCESS),
    "file": Key(Text(1000), only=_BY_COLUMN),
    "sheet": SHEET,
    "at": Key(ListOf(Quantity(("length", "angle"), -1e3, 1e3), fewest=2, from_file=True), only=_BY_COLUMN),
    "force": Key(ListOf(_FORCE, fewest=1, from_file=True), required=True, only=_PROCESS),
    "torque": Key(ListOf(_TORQUE, fewest=1, from_file=True), required=True, only=_TURNS),
    "curve": Key(Choice(("straight", "smooth")), default="straight", only=_BY_COLUMN),
    "stroke": Key(Choice(("growing", "falling")), default="growing", only=_PROCESS),
    "start": Key(_COORDINATE, only=_PROCESS),
    "acts": Key(Choice(("forward", "both")), default="forward", only=_PROCESS),
    "stiffness": Key(Quantity(("stiffness",), 0.0, 1e12), required=True, only=_SPRING),
    "free_length": Key(Quantity(("length",), 0.0, 1e3), default="0 mm", only=_SPRING),
    "preload": Key(_FORCE, default="0 N", only=_SPRING),
    "damping": Key(Quantity(("damping",), 0.0, 1e12), required=True, only=_DAMPER),
})  # fmt: skip

_COEFFICIENT = Key(Number(0.0, 1.0, told="coefficient"), default=0.0)
_RUBBING_PIN = Table("rubbing", {
    "coefficient": _COEFFICIENT,
    "radius": Key(Quantity(("length",), 0.0, 10.0), required=True, only={"coefficient": ()}),
    "moment": Key(Quantity(("torque",), 0.0, 1e9), default="0 N*m"),
    "damping": Key(Quantity(("angular_damping",), 0.0, 1e9), default="0 N*m*s/rad"),
})  # fmt: skip
_RUBBING_SLIDER = Table("rubbing_slider", {
    "coefficient": _COEFFICIENT,
    "length": Key(_LENGTH, only={"coefficient": ()}),
    "force": Key(Quantity(("force",), 0.0, 1e9), default="0 N"),
    "damping": Key(Quantity(("damping",), 0.0, 1e12), default="0 N*s/m"),
})  # fmt: skip
_FRICTION = Table("friction", {
    "circle": Key(Choice(("tangent", "sine")), default="tangent"),
    "pins": Key(Named(_RUBBING_PIN, most=500)),
    "sliders": Key(Named(_RUBBING_SLIDER, most=300)),
})  # fmt: skip

EFFICIENCY = Table("efficiency", {
    "chain": Key(Nested(Number(0.001, 1.0)), required=True),
    "decimals": Key(Number(1, 6, whole=True)),
    "losses": Key(Choice(("drive", "machine"))),
})  # fmt: skip

_MOTOR = Table("motor", {
    "rated_power": Key(Quantity(("power",), 1e-3, 1e9), required=True),
    "rated_speed": Key(_SPEED, required=True),
    "overload": Key(Number(1.01, 10.0), required=True),
    "pole_pairs": Key(Number(1, 24, whole=True), required=True),
    "frequency": Key(_SPEED, default="50 Hz"),
    "ratio": Key(Number(1e-4, 1e4), default=1.0),
    "inertia": _INERTIA,
})  # fmt: skip

_ANY_SPEED = Quantity(("speed",), -3e4, 3e4)
_ANY_ANGLE = Quantity(("angle",), -1e4, 1e4)
_TRANSIENT = Table("transient", {
    "time": Key(_TIME, required=True),
    "torque": Key(_TORQUE),
    "motor": Key(Flag()),
    "start": _NO_ANGLE,
    "speed": Key(_ANY_SPEED, default="0 rpm"),
    "until": Key(Choice(("time", "rest", "steady")), default="time"),
    "step": Key(_TIME),
    "speeds": Key(ListOf(_ANY_SPEED, most=20)),
    "stops": Key(ListOf(_ANY_ANGLE, fewest=2, most=2)),
    "restitution": Key(Number(0.0, 1.0), default=0.0, only={"stops": ()}),
})  # fmt: skip

_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_ABSOLUTE = Quantity(("pressure",), 1.0, 1e10)
_TEMPERATURE = Key(Quantity(("temperature",), 1.0, 1e4))
_FACE = {
    "slider": Key(_NAME),
    "bore": Key(_LENGTH, instead_of=("area",)),
    "rod_diameter": Key(_LENGTH),
    "area": Key(Quantity(("area",), 1e-12, 1e4), instead_of=("bore",)),
    "sense": Key(Choice((1, -1)), default=1),
}
_OF_FACE = tuple(_FACE)

_CHAMBER = Table("chamber", {
    **_FACE,
    "faces": Key(ListOf(Table("chamber", _FACE), fewest=1, most=20), instead_of=_OF_FACE),
    "clearance_volume": Key(Quantity(("volume",), 0.0, 1e3), instead_of=("compression_ratio",)),
    "compression_ratio": Key(Number(1.0001, 1e4), instead_of=("clearance_volume",)),
    "period": Key(Choice(("360 deg", "720 deg")), default="360 deg"),
    "ambient": Key(Quantity(("pressure",), 0.0, 1e10), default=AMBIENT),
    "pressure": Key(_PRESSURE, instead_of=("points", "pieces", "measured", "cycle")),
    "pressure_factor": Key(Number(0.0, 10.0), default=1.0),
    "pressures": PRESSURES,
    **DIAGRAM,
    "valves": Key(PIPED_VALVES, instead_of=(*DIAGRAM, "pressure", "cycle"),
                  only={"pressures": ("absolute",), "period": ("360 deg",)}),
    "cycle": Key(HEAT_RELEASE, instead_of=("points", "pieces", "measured", "pressure")),
    "delay": Key(_TURN),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_DEAD_VOLUME = Table("dead_volume", {
    "volume": Key(Quantity(("volume",), 1e-15, 1e3), required=True),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_CHARGE = Table("charge", {
    "chambers": Key(ListOf(_NAME, fewest=1, most=20), required=True),
    "dead_volumes": Key(ListOf(_DEAD_VOLUME, most=50)),
    "gas_constant": Key(Quantity(("specific_heat",), 1.0, 1e5)),
    "exponent": Key(Number(0.0, 5.0)),
    "mean_pressure": Key(_ABSOLUTE, instead_of=("pressure", "mass")),
    "pressure": Key(_ABSOLUTE, instead_of=("mean_pressure", "mass")),
    "angle": Key(_TURN, default="0 deg", only={"pressure": ()}),
    "mass": Key(Quantity(("mass",), 1e-12, 1e6), instead_of=("mean_pressure", "pressure")),
})  # fmt: skip

LINKAGE_FILE = Table("file", {
    **TITLE,
    "document": document_keys.LINKAGE,
    "fixed_points": Key(Named(_PLACE)),
    "crank": Key(_CRANK, required=True),
    "geared": Key(Named(_GEARED, most=50)),
    "links": Key(Named(_LINK, most=500)),
    "guides": Key(Named(_GUIDE)),
    "sliders": Key(Named(_SLIDER, most=300)),
    "branch": Key(Named(Choice((1, -1)))),
    "positions": Key(Named(_PLACE)),
    "loads": Key(ListOf(_LOAD)),
    "friction": Key(_FRICTION),
    "chambers": Key(Named(_CHAMBER, most=50)),
    "charges": Key(Named(_CHARGE, most=20)),
    "efficiency": Key(EFFICIENCY),
    "motor": Key(_MOTOR),
    "flywheel": Key(FLYWHEEL),
    "transient": Key(_TRANSIENT),
    "method": Key(METHOD),
    "table": Key(TABLE),
})  # fmt: skip

# a crank that follows a law has no speed of its own, and other drivers have no crank
DRIVEN_FILE = LINKAGE_FILE._replace(keys={
    **LINKAGE_FILE.keys,
    "crank": Key(_CRANK._replace(keys={
        **{name: key._replace(required=False) for name, key in _CRANK.keys.items()},
        "angular_acceleration": NO_ACCELERATION._replace(default=None),
    })),
    "charges": Key(Named(_CHARGE._replace(keys={**_CHARGE.keys, "angle": Key(_TURN)}), most=20)),
    "driver": Key(_DRIVER, required=True),
    "table": Key(Table("table", {"step": Key(_TIME)})),
})  # fmt: skip

_BODY = Table("body", {
    "mass": Key(Quantity(("mass",), 0.0, 1e6), default="0 kg"),
    "inertia": _INERTIA,
    "velocity": Key(ListOf(_COORDINATE, fewest=2, from_file=True)),
    "rotation": Key(ListOf(Number(-1e3, 1e3), fewest=2, from_file=True)),
})  # fmt: skip
_TORQUES = ListOf(_TORQUE, fewest=2, from_file=True)
_TRANSFER = Table("transfer", {
    "file": Key(Text(1000)),
    "sheet": SHEET,
    "angles": Key(ListOf(_TURN, fewest=2, from_file=True), required=True),
    "bodies": Key(Named(_BODY), required=True),
    "reduced_inertia_1": Key(ListOf(Quantity(("inertia",), -1e9, 1e9), fewest=2, from_file=True),
                             instead_of=("differences",)),
    "differences": Key(Choice(("forward", "central", "spectral")), default="central",
                       instead_of=("reduced_inertia_1",)),
    "static_torque": Key(_TORQUES, instead_of=("balancing_torque",)),
    "balancing_torque": Key(_TORQUES, instead_of=("static_torque",)),
})  # fmt: skip

TRANSFER_FILE = Table("file", {
    **TITLE,
    "document": document_keys.TRANSFER,
    "crank": Key(Table("driving", {"speed": Key(_SPEED, required=True)}), required=True),
    "transfer": Key(_TRANSFER, required=True),
    "efficiency": Key(EFFICIENCY),
    "method": Key(METHOD),
})  # fmt: skip
