"""The keys of a machine file that describes a linkage, or the transfer functions of one as a document prints them."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description.cylinder_keys import BALANCE, BEARINGS, CHAMBER_CYCLE, FLYWHEEL
from crankwork.description.keys import (
    AMBIENT,
    DIAGRAM,
    LINKAGE_DOCUMENT,
    METHOD,
    NO_ACCELERATION,
    PIPED_VALVES,
    PRESSURES,
    TABLE,
    TITLE,
    TRANSFER_DOCUMENT,
)
from crankwork.description.load_keys import (
    COORDINATE,
    EFFICIENCY,
    INERTIA,
    LENGTH,
    LOADING,
    NAME,
    NO_ANGLE,
    SHEET,
    SPEED,
    TIME,
    TORQUE,
    with_defaults,
)
from crankwork.description.schema import InertiaKind, KeySpec, ListOf, MapOf, NameOr, NumberOr, TableSpec
from crankwork.description.value_types import Choice, Number, Quantity, Text
from crankwork.mechanism.driver import LawKind

_PLACE = ListOf(COORDINATE, fewest=2, most=2)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_TURN = Quantity(("angle",), 0.0, 4 * math.pi + 1e-9)
_OF_MASS = {"mass": KeySpec(Quantity(("mass",), 1e-9, 1e6)), "centre": KeySpec(NameOr(_PLACE))}
_INERTIA = InertiaKind(Quantity(("inertia",), 0.0, 1e9))
# bodies that turn about a pivot: all inertia counts, also that of the mass at its distance
_TURNING = {**_OF_MASS, "inertia": INERTIA._replace(default=None),
            "inertia_about": KeySpec(Choice(("pivot", "centre")), default="pivot",
                                     only={"inertia": (), "mass": ()})}  # fmt: skip
_MASS = {**_OF_MASS, "inertia": INERTIA._replace(only={"mass": ()})}

_CRANK = TableSpec("driving", {
    "pivot": KeySpec(NAME, required=True),
    "pin": KeySpec(NAME, required=True),
    "radius": KeySpec(LENGTH, required=True),
    "speed": KeySpec(SPEED, required=True),
    "angular_acceleration": NO_ACCELERATION,
    "start": NO_ANGLE,
    "direction": KeySpec(Choice(("anticlockwise", "clockwise")), default="anticlockwise"),
    "points": KeySpec(MapOf(_PLACE)),
    **_TURNING,
    "inertia": _TURNING["inertia"]._replace(kind=_INERTIA),
    "from": KeySpec(_ANGLE),
    "to": KeySpec(_ANGLE),
})  # fmt: skip

_RATE_OF_DRIVER = Quantity(("velocity", "speed"), -3e4, 3e4)
_COORDINATE_OF_DRIVER = Quantity(("length", "angle"), -1e3, 1e3)

_BY_TABLE, _MOVES = {"kind": ("table",)}, {"kind": tuple(kind for kind in get_args(LawKind) if kind != "dwell")}
_SEGMENT = TableSpec("segment", {
    "kind": KeySpec(Choice(get_args(LawKind)), required=True),
    "to": KeySpec(_COORDINATE_OF_DRIVER, only=_MOVES),
    "over": KeySpec(NumberOr(TIME, Number(0.0, 1.0, above=True)), required=True, instead_of=("speed",)),
    "speed": KeySpec(Quantity(("velocity", "speed"), 0.0, 3e4, above=True), instead_of=("over",),
                 only={"kind": ("constant",)}),
    "ramp": KeySpec(Number(0.0, 0.5, above=True), default=1 / 3, only={"kind": ("trapezoidal",)}),
    "start_speed": KeySpec(_RATE_OF_DRIVER, only={"kind": ("constant-acceleration", "table")}),
    "end_speed": KeySpec(_RATE_OF_DRIVER, only=_BY_TABLE),
    "ends": KeySpec(Choice(("rest", "natural")), default="rest", only=_BY_TABLE),
    "at": KeySpec(ListOf(Number(0.0, 1.0)), only=_BY_TABLE),
    "values": KeySpec(ListOf(_COORDINATE_OF_DRIVER), only=_BY_TABLE),
})  # fmt: skip

_HALF = TableSpec("half", {
    "mass": KeySpec(Quantity(("mass",), 1e-9, 1e6), required=True),
    "inertia": INERTIA,
    "centre": KeySpec(_PLACE, required=True),
})  # fmt: skip

_DRIVER = TableSpec("driver", {
    "slider": KeySpec(NAME),
    "cylinder": KeySpec(ListOf(NAME, fewest=2, most=2)),
    "barrel": KeySpec(_HALF),
    "rod": KeySpec(_HALF),
    "between": KeySpec(ListOf(NAME, fewest=2, most=2)),
    "start": KeySpec(_COORDINATE_OF_DRIVER),
    "law": KeySpec(ListOf(_SEGMENT, fewest=1, most=100), required=True),
    "period": KeySpec(TIME),
})  # fmt: skip

_GEARED = TableSpec("geared", {
    "pivot": KeySpec(NAME, required=True),
    "ratio": KeySpec(Number(-1e3, 1e3), required=True),
    "start": NO_ANGLE,
    "points": KeySpec(MapOf(_PLACE), required=True),
    "pressure_angle": KeySpec(Quantity(("angle",), 0.0, math.radians(45))),
    **_TURNING,
})  # fmt: skip

_LINK = TableSpec("link", {
    "joins": KeySpec(ListOf(NAME, fewest=2), required=True),
    "length": KeySpec(LENGTH),
    "points": KeySpec(MapOf(_PLACE)),
    "share": KeySpec(Number(-1e3, 1e3)),
    "of": KeySpec(NAME),
    **_MASS,
    "inertia": _MASS["inertia"]._replace(kind=_INERTIA),
})  # fmt: skip

_SLIDER = TableSpec("slider", {
    "guide": KeySpec(NAME, required=True),
    "pin": KeySpec(NAME),
    "points": KeySpec(MapOf(_PLACE)),
    **_MASS,
})  # fmt: skip

_GUIDE = TableSpec("guide", {
    "through": KeySpec(NameOr(_PLACE), default=["0 mm", "0 mm"]),
    "angle": NO_ANGLE,
    "link": KeySpec(NAME),
})  # fmt: skip

_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_ABSOLUTE = Quantity(("pressure",), 1.0, 1e10)
_TEMPERATURE = KeySpec(Quantity(("temperature",), 1.0, 1e4))
_FACE = {
    "slider": KeySpec(NAME),
    "bore": KeySpec(LENGTH, instead_of=("area",)),
    "rod_diameter": KeySpec(LENGTH),
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
    "cycle": KeySpec(CHAMBER_CYCLE, instead_of=("points", "pieces", "measured", "pressure")),
    "delay": KeySpec(_TURN),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_DEAD_VOLUME = TableSpec("dead_volume", {
    "volume": KeySpec(Quantity(("volume",), 1e-15, 1e3), required=True),
    "temperature": _TEMPERATURE,
})  # fmt: skip

_CHARGE = TableSpec("charge", {
    "chambers": KeySpec(ListOf(NAME, fewest=1, most=20), required=True),
    "dead_volumes": KeySpec(ListOf(_DEAD_VOLUME, most=50)),
    "gas_constant": KeySpec(Quantity(("specific_heat",), 1.0, 1e5)),
    "exponent": KeySpec(Number(0.0, 5.0)),
    "mean_pressure": KeySpec(_ABSOLUTE, instead_of=("pressure", "mass")),
    "pressure": KeySpec(_ABSOLUTE, instead_of=("mean_pressure", "mass")),
    "angle": KeySpec(_TURN, default="0 deg", only={"pressure": ()}),
    "mass": KeySpec(Quantity(("mass",), 1e-12, 1e6), instead_of=("mean_pressure", "pressure")),
})  # fmt: skip

_ALONG = Quantity(("length",), -100.0, 100.0)
_SHAFT = TableSpec("shaft", {
    "cylinders": KeySpec(ListOf(NAME, fewest=1, most=MOST_CYLINDERS)),
    "positions": KeySpec(MapOf(_ALONG, most=MOST_CYLINDERS)),
    "journals": KeySpec(ListOf(_ALONG, fewest=2, most=MOST_CYLINDERS + 1)),
    "throws": KeySpec(ListOf(ListOf(NAME, fewest=1, most=MOST_CYLINDERS), fewest=1, most=MOST_CYLINDERS)),
    "firing": KeySpec(MapOf(_TURN, most=MOST_CYLINDERS)),
    "period": KeySpec(Choice(("360 deg", "720 deg"))),
    "reference": KeySpec(_ANGLE),
    "misfire": KeySpec(ListOf(NAME, fewest=1, most=MOST_CYLINDERS)),
    "bore": KeySpec(LENGTH),
})  # fmt: skip

_BEARING_SIZE = KeySpec(Quantity(("length",), 1e-6, 10.0))
_PIN_BEARING = TableSpec("pin_bearing", {
    "diameter": _BEARING_SIZE,
    "length": _BEARING_SIZE,
    "link": KeySpec(NAME),
})  # fmt: skip
_BEARINGS = BEARINGS._replace(keys={**BEARINGS.keys, "pins": KeySpec(MapOf(_PIN_BEARING, most=500))})

LINKAGE_FILE = TableSpec("file", {
    **TITLE,
    "document": LINKAGE_DOCUMENT,
    "fixed_points": KeySpec(MapOf(_PLACE)),
    "crank": KeySpec(_CRANK, required=True),
    "geared": KeySpec(MapOf(_GEARED, most=50)),
    "links": KeySpec(MapOf(_LINK, most=500)),
    "guides": KeySpec(MapOf(_GUIDE)),
    "sliders": KeySpec(MapOf(_SLIDER, most=300)),
    "branch": KeySpec(MapOf(Choice((1, -1)))),
    "positions": KeySpec(MapOf(_PLACE)),
    "chambers": KeySpec(MapOf(_CHAMBER, most=50)),
    "charges": KeySpec(MapOf(_CHARGE, most=20)),
    "shaft": KeySpec(_SHAFT),
    "bearings": KeySpec(_BEARINGS),
    "balance": KeySpec(BALANCE),
    **LOADING,
    "flywheel": KeySpec(FLYWHEEL),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip

STARTED_FILE = with_defaults(LINKAGE_FILE, "crank", _CRANK, speed="1 rad/s")

# a crank with a law has no speed, and other drivers have no crank, whose turn the loads of bearings need
_OF_CRANKSHAFT = ("shaft", "bearings", "balance")
DRIVEN_FILE = LINKAGE_FILE._replace(keys={
    **{name: key for name, key in LINKAGE_FILE.keys.items() if name not in _OF_CRANKSHAFT},
    "crank": KeySpec(_CRANK._replace(keys={
        **{name: key._replace(required=False) for name, key in _CRANK.keys.items()},
        "angular_acceleration": NO_ACCELERATION._replace(default=None),
    })),
    "charges": KeySpec(MapOf(_CHARGE._replace(keys={**_CHARGE.keys, "angle": KeySpec(_TURN)}), most=20)),
    "driver": KeySpec(_DRIVER, required=True),
    "table": KeySpec(TableSpec("table", {"step": KeySpec(TIME)})),
})  # fmt: skip

_BODY = TableSpec("body", {
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e6), default="0 kg"),
    "inertia": INERTIA,
    "velocity": KeySpec(ListOf(COORDINATE, fewest=2, from_file=True)),
    "rotation": KeySpec(ListOf(Number(-1e3, 1e3), fewest=2, from_file=True)),
})  # fmt: skip
_TORQUES = ListOf(TORQUE, fewest=2, from_file=True)
_POSITIONS = KeySpec(ListOf(_TURN, fewest=2, from_file=True), required=True)
_REDUCED = {
    "reduced_inertia_1": KeySpec(ListOf(Quantity(("inertia",), -1e9, 1e9), fewest=2, from_file=True),
                             instead_of=("differences",)),
    "differences": KeySpec(Choice(("forward", "central", "spectral")), default="central",
                       instead_of=("reduced_inertia_1",)),
    "static_torque": KeySpec(_TORQUES, instead_of=("balancing_torque",)),
    "balancing_torque": KeySpec(_TORQUES, instead_of=("static_torque",)),
}  # fmt: skip
_TRANSFER = TableSpec("transfer", {
    "file": KeySpec(Text(1000)),
    "sheet": SHEET,
    "angles": _POSITIONS,
    "bodies": KeySpec(MapOf(_BODY), required=True),
    **_REDUCED,
})  # fmt: skip

TRANSFER_FILE = TableSpec("file", {
    **TITLE,
    "document": TRANSFER_DOCUMENT,
    "crank": KeySpec(TableSpec("driving", {"speed": KeySpec(SPEED, required=True)}), required=True),
    "transfer": KeySpec(_TRANSFER, required=True),
    "efficiency": KeySpec(EFFICIENCY),
    "method": KeySpec(METHOD),
})  # fmt: skip

# of links whose motion is given, which transfer functions as a document prints them are short for
GIVEN_MOTION_FILE = TRANSFER_FILE._replace(keys={
    **{name: key for name, key in TRANSFER_FILE.keys.items() if name != "transfer"},
    "crank": KeySpec(TableSpec("transfer", {"speed": KeySpec(SPEED, required=True), **_REDUCED}), required=True),
    "links": KeySpec(MapOf(_BODY), required=True),
    "table": KeySpec(TableSpec("transfer", {"angles": _POSITIONS}), required=True),
})  # fmt: skip
