"""The keys of a file of a linkage, of transfer functions as a document prints them, of torques or masses on a shaft."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description.keys import (
    AMBIENT,
    BALANCE,
    BEARINGS,
    CHAMBER_CYCLE,
    COORDINATE,
    CRANKSHAFT_TORSION,
    DIAGRAM,
    EFFICIENCY,
    FLYWHEEL,
    INERTIA,
    LENGTH,
    LINKAGE_DOCUMENT,
    LOADING,
    METHOD,
    MOTOR_SELECTION,
    NAME,
    NO_ACCELERATION,
    NO_ANGLE,
    PIPED_VALVES,
    PRESSURES,
    ROTOR_DOCUMENT,
    SHEET,
    SPEED,
    STAGES_DOCUMENT,
    TABLE,
    TIME,
    TITLE,
    TORQUE,
    TORSION,
    TRANSFER_DOCUMENT,
    TURNING_DOCUMENT,
    WATER_HEAT,
    with_defaults,
)
from crankwork.description.schema import InertiaKind, KeySpec, ListOf, MapOf, NameOr, NumberOr, OneForAll, TableSpec
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Text
from crankwork.mechanism.driver import LawKind
from crankwork.shaft.torque_diagram import Shape

# two coordinates, or a distance and its direction
_PLACE = ListOf(Quantity(("length", "angle"), -1e3, 1e3), fewest=2, most=2, first=COORDINATE)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_TURN = Quantity(("angle",), 0.0, 4 * math.pi + 1e-9)
_OF_MASS = {"mass": KeySpec(Quantity(("mass",), 1e-9, 1e6)), "centre": KeySpec(NameOr(_PLACE))}
_MASS_OF_LINK = KeySpec(Quantity(("mass", "mass_per_length"), 1e-9, 1e6))
_CENTRE = KeySpec(NumberOr(NameOr(_PLACE), Number(-10.0, 10.0)))
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
    "speed": KeySpec(SPEED._replace(negative="speed_clockwise"), required=True),
    "angular_acceleration": NO_ACCELERATION,
    "start": NO_ANGLE,
    "direction": KeySpec(Choice(("anticlockwise", "clockwise")), default="anticlockwise"),
    "points": KeySpec(MapOf(_PLACE)),
    **_TURNING,
    "mass": _MASS_OF_LINK,
    "centre": _CENTRE,
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
    "law": KeySpec(ListOf(_SEGMENT, fewest=1, most=100), required=True, instead_of=("velocity",)),
    "velocity": KeySpec(_RATE_OF_DRIVER, instead_of=("law",)),
    "acceleration": KeySpec(Quantity(("acceleration", "angular_acceleration"), -1e6, 1e6), only={"velocity": ()}),
    "period": KeySpec(TIME),
    "jerk": KeySpec(Flag()),
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
    "mass": _MASS_OF_LINK,
    "centre": _CENTRE,
    "inertia": _MASS["inertia"]._replace(kind=_INERTIA, instead_of=("radius_of_gyration",)),
    "radius_of_gyration": KeySpec(LENGTH, instead_of=("inertia",), only={"mass": ()}),
})  # fmt: skip

_SLIDER = TableSpec("slider", {
    "guide": KeySpec(NAME, required=True),
    "pin": KeySpec(NAME),
    "points": KeySpec(MapOf(_PLACE)),
    "crosshead_mass": KeySpec(Quantity(("mass",), 0.0, 1e6), only={"pin": ()}),
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
    "pressure": KeySpec(_PRESSURE, instead_of=(*DIAGRAM, "cycle")),
    "pressure_factor": KeySpec(Number(0.0, 10.0), default=1.0),
    "pressures": PRESSURES,
    **DIAGRAM,
    "valves": KeySpec(PIPED_VALVES, instead_of=(*DIAGRAM, "pressure", "cycle"),
                  only={"pressures": ("absolute",), "period": ("360 deg",)}),
    "cycle": KeySpec(CHAMBER_CYCLE, instead_of=(*DIAGRAM, "pressure")),
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

_VESSEL = TableSpec("vessel", {
    "chambers": KeySpec(ListOf(NAME, fewest=1, most=50), required=True),
    "side": KeySpec(Choice(("discharge", "suction")), default="discharge"),
    "length": KeySpec(Quantity(("length",), 1e-3, 1e5), only={"diameter": ()}),
    "diameter": KeySpec(LENGTH, only={"length": ()}),
    "friction": KeySpec(Number(0.0, 1.0, above=True), required=True, only={"length": ()}, example="0.02"),
})  # fmt: skip
_MOST_STAGES = 12
_POSITIVE = Quantity(("pressure",), 0.0, 1e10)
_STAGE_EXPONENT = OneForAll(Number(1.0, 3.0), _MOST_STAGES)
_COOLED = OneForAll(_TEMPERATURE.kind, _MOST_STAGES)
_OF_HEAT = {"gas_constant": (), "temperature": ()}
# of stages alone and of those whose chambers are told
_OF_STAGES = {
    "suction": KeySpec(_ABSOLUTE, required=True),
    "discharge": KeySpec(_ABSOLUTE, required=True),
    "between": KeySpec(OneForAll(_ABSOLUTE, _MOST_STAGES)),
    "losses": KeySpec(OneForAll(_POSITIVE, _MOST_STAGES)),
    "exponent": KeySpec(_STAGE_EXPONENT, required=True, instead_of=("discharge_temperature",)),
    "discharge_temperature": KeySpec(_TEMPERATURE.kind, instead_of=("exponent",), only={"temperature": ()}),
    "expansion_exponent": KeySpec(_STAGE_EXPONENT),
    "temperature": _TEMPERATURE,
    "temperatures": KeySpec(_COOLED, only={"temperature": ()}),
    "final_temperature": KeySpec(_TEMPERATURE.kind, only={"heat_capacity": ()}),
    "gas_constant": KeySpec(Quantity(("specific_heat",), 1.0, 1e5), only={"temperature": ()}),
    "heat_capacity": KeySpec(Quantity(("specific_heat",), 1.0, 1e6), only=_OF_HEAT),
    "free_pressure": KeySpec(_ABSOLUTE, only={"temperature": (), "free_temperature": ()}, example='"0.1 MPa"'),
    "free_temperature": KeySpec(_TEMPERATURE.kind, only={"temperature": (), "free_pressure": ()}),
    "water_rise": KeySpec(Quantity(("temperature_rise",), 0.0, 1e3, above=True), instead_of=("water_flow",),
                      only={"heat_capacity": ()}),
    "water_flow": KeySpec(Quantity(("mass_rate",), 0.0, 1e6, above=True), instead_of=("water_rise",),
                      only={"heat_capacity": ()}),
    "water_heat_capacity": KeySpec(Quantity(("specific_heat",), 1.0, 1e6), default=WATER_HEAT,
                               only={"heat_capacity": ()}),
}  # fmt: skip
_DELIVERIES = ("flow", "free_flow", "mass_flow")
_RATE = Quantity(("volume_rate",), 0.0, 1e6, above=True)
_STAGES = TableSpec("stages", {
    "count": KeySpec(Number(1, _MOST_STAGES, whole=True), default=1, instead_of=("ratio_limit", "temperature_limit")),
    "ratio_limit": KeySpec(Number(1.01, 100.0), instead_of=("count", "temperature_limit")),
    "temperature_limit": KeySpec(_TEMPERATURE.kind, instead_of=("count", "ratio_limit"),
                             only={"temperature": (), "exponent": ()}),
    **_OF_STAGES,
    "between": _OF_STAGES["between"]._replace(instead_of=("ratio_limit", "temperature_limit")),
    "clearance": KeySpec(OneForAll(Number(0.0, 0.9), _MOST_STAGES), instead_of=("volumetric_efficiency",)),
    "volumetric_efficiency": KeySpec(OneForAll(Number(0.05, 1.0), _MOST_STAGES), instead_of=("clearance",)),
    "flow": KeySpec(_RATE, instead_of=("free_flow", "mass_flow")),
    "free_flow": KeySpec(_RATE, instead_of=("flow", "mass_flow"), only={"free_pressure": ()}),
    "mass_flow": KeySpec(Quantity(("mass_rate",), 0.0, 1e6, above=True), instead_of=("flow", "free_flow"),
                     only={"gas_constant": ()}),
    "bore": KeySpec(LENGTH),
    "stroke": KeySpec(LENGTH, instead_of=("stroke_bore_ratio", "piston_speed")),
    "stroke_bore_ratio": KeySpec(Number(0.2, 5.0), instead_of=("stroke", "piston_speed")),
    "piston_speed": KeySpec(Quantity(("velocity",), 0.0, 100.0, above=True),
                        instead_of=("stroke", "stroke_bore_ratio")),
    "sides": KeySpec(Number(1, 48, whole=True), default=1),
    "shaft_power": KeySpec(Quantity(("power",), 0.0, 1e9, above=True)),
})  # fmt: skip
_STAGES_OF_CHAMBERS = TableSpec("stages", {
    **_OF_STAGES,
    "chambers": KeySpec(ListOf(ListOf(NAME, fewest=1, most=50), fewest=1, most=_MOST_STAGES), required=True,
                    example='[["low"], ["high"]]'),
})  # fmt: skip
STAGES_FILE = TableSpec("file", {
    **TITLE,
    "document": STAGES_DOCUMENT,
    "crank": KeySpec(TableSpec("driving", {"speed": KeySpec(SPEED, required=True)})),
    "stages": KeySpec(_STAGES, required=True),
    "efficiency": KeySpec(EFFICIENCY),
    "method": KeySpec(METHOD),
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
    "extents": KeySpec(ListOf(NAME, fewest=1, most=50)),
    "chambers": KeySpec(MapOf(_CHAMBER, most=50)),
    "charges": KeySpec(MapOf(_CHARGE, most=20)),
    "stages": KeySpec(_STAGES_OF_CHAMBERS),
    "vessels": KeySpec(MapOf(_VESSEL, most=20)),
    "shaft": KeySpec(_SHAFT),
    "bearings": KeySpec(_BEARINGS),
    "balance": KeySpec(BALANCE),
    "torsion": CRANKSHAFT_TORSION,
    **LOADING,
    "flywheel": KeySpec(FLYWHEEL),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip

UNIT_SPEED_FILE = with_defaults(LINKAGE_FILE, "crank", _CRANK, speed="1 rad/s")

# a crank with a law has no speed, and other drivers have no crank, whose turn the loads of bearings need
_OF_CRANKSHAFT = ("stages", "vessels", "shaft", "bearings", "balance", "torsion")
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
_TORQUE = Quantity(("torque",), -1e9, 1e9)
_SPEED = Quantity(("speed",), 1e-6, 3e4)
_ANY_TURN = Quantity(("angle",), 0.0, 1e5)
_LENGTH = KeySpec(Quantity(("length",), 1e-6, 100.0))
_ENERGY, _PER_AREA = Quantity(("energy", "area"), -1e12, 1e12), Quantity(("energy_per_area",), 0.0, 1e12, above=True)
_STRETCH = Quantity(("angle", "time"), 0.0, 1e5, above=True)

_HARMONIC = TableSpec("harmonic", {
    "order": KeySpec(Number(0.0, 1e3, above=True), required=True),
    "sin": KeySpec(_TORQUE, default="0 N*m"),
    "cos": KeySpec(_TORQUE, default="0 N*m"),
})  # fmt: skip

_BY_STRENGTH = {"shear_strength": ()}
_STROKE = TableSpec("press_stroke", {
    "work": KeySpec(_ENERGY, required=True, instead_of=("shear_energy", "shear_strength")),
    "shear_energy": KeySpec(_PER_AREA, instead_of=("work", "shear_strength")),
    "shear_strength": KeySpec(Quantity(("pressure",), 1.0, 1e11), instead_of=("work", "shear_energy")),
    "penetration": KeySpec(Number(0.0, 1.0, above=True), required=True, only=_BY_STRENGTH),
    "punch_slope": KeySpec(_LENGTH.kind, only=_BY_STRENGTH),
    "thickness": KeySpec(_LENGTH.kind),
    "hole_diameter": KeySpec(_LENGTH.kind, instead_of=("cut_width",), only={"thickness": ()}),
    "cut_width": KeySpec(_LENGTH.kind, instead_of=("hole_diameter",), only={"thickness": ()}),
    "from": KeySpec(_STRETCH._replace(above=False), default="0 deg"),
    "over": KeySpec(NumberOr(_STRETCH, Number(0.0, 1.0, above=True)), instead_of=("punch_stroke",)),
    "punch_stroke": KeySpec(_LENGTH.kind, instead_of=("over",), only={"thickness": ()}),
    "shape": KeySpec(Choice(get_args(Shape)), default="constant"),
    "peak": KeySpec(Number(0.0, 1.0), default=0.5, only={"shape": ("triangle",)}),
})  # fmt: skip

_SCALE = TableSpec("scale", {
    "torque": KeySpec(Quantity(("torque_per_length",), 0.0, 1e15, above=True), instead_of=("work",)),
    "angle": KeySpec(Quantity(("angle_per_length",), 0.0, 1e9, above=True), instead_of=("work",)),
    "work": KeySpec(_PER_AREA._replace(high=1e15), required=True, instead_of=("torque", "angle")),
})  # fmt: skip

FORMS = ("torque", "harmonics", "strokes", "areas", "excess_work", "energy_fluctuation")


def _other(*names: str) -> tuple[str, ...]:
    """Return the other forms of a torque."""
    return tuple(form for form in FORMS if form not in names)


_DIAGRAM = TableSpec("torque_diagram", {
    "period": KeySpec(Quantity(("angle", "time"), math.radians(1e-3), 1e5), instead_of=("rate",)),
    "rate": KeySpec(Quantity(("speed",), 1e-6, 1e5), instead_of=("period",)),
    "constant": KeySpec(_TORQUE, instead_of=("power", "at", "torque")),
    "power": KeySpec(Quantity(("power",), -1e12, 1e12), instead_of=("constant", "at", "torque")),
    "file": KeySpec(Text(1000)),
    "sheet": SHEET,
    "at": KeySpec(ListOf(_ANY_TURN, fewest=2, most=2000, from_file=True), only={"torque": ()}),
    "torque": KeySpec(ListOf(_TORQUE, 2, 2000, from_file=True), instead_of=_other("torque"), only={"at": ()}),
    "harmonics": KeySpec(ListOf(_HARMONIC, fewest=1, most=200), instead_of=_other("harmonics")),
    "strokes": KeySpec(ListOf(_STROKE, fewest=1, most=200), instead_of=_other("strokes")),
    "areas": KeySpec(ListOf(_ENERGY, fewest=2, most=1000, from_file=True), instead_of=_other("areas")),
    "excess_work": KeySpec(Quantity(("energy", "area"), 0.0, 1e12, above=True), instead_of=_other("excess_work")),
    "energy_fluctuation": KeySpec(Number(0.0, 1e3, above=True), instead_of=_other("energy_fluctuation")),
    "scale": KeySpec(_SCALE),
    "cylinders": KeySpec(Number(1, 48, whole=True), instead_of=("delays", *FORMS[3:])),
    "delays": KeySpec(ListOf(_ANY_TURN, fewest=1, most=48), instead_of=("cylinders", *FORMS[3:])),
})  # fmt: skip

_REACH, _OWN_MASS = Quantity(("length",), -1e3, 1e3), Quantity(("mass",), 0.0, 1e6)
_SECTOR = TableSpec("sector", {
    "inner_radius": KeySpec(Quantity(("length",), 0.0, 100.0), required=True),
    "outer_radius": KeySpec(_LENGTH.kind, required=True),
    "width": KeySpec(_LENGTH.kind, required=True),
    "density": KeySpec(Quantity(("density",), 1.0, 1e5), default="7850 kg/m3"),
    "count": KeySpec(Number(1, 48, whole=True), default=1),
    "angle": KeySpec(Quantity(("angle",), 0.0, math.pi, above=True)),
})  # fmt: skip
_PLANE_MASS = TableSpec("rotor_mass", {
    "name": KeySpec(NAME),
    "mass": KeySpec(_OWN_MASS, instead_of=("moment", "sector")),
    "reciprocating": KeySpec(_OWN_MASS, instead_of=("moment", "sector"), only={"mass": ()}),
    "radius": KeySpec(_LENGTH.kind, instead_of=("moment", "sector")),
    "moment": KeySpec(Quantity(("mass_moment",), 0.0, 1e6), instead_of=("mass", "reciprocating", "radius", "sector")),
    "sector": KeySpec(_SECTOR, instead_of=("mass", "reciprocating", "radius", "moment")),
    "angle": KeySpec(Quantity(("angle",), -4 * math.pi, 4 * math.pi)),
    "position": KeySpec(_REACH),
})  # fmt: skip
_PISTONS = {"kind": ("reciprocating",)}
ROTOR_FILE = TableSpec("file", {
    **TITLE,
    "document": ROTOR_DOCUMENT,
    "crank": KeySpec(TableSpec("rotor_crank", {"speed": KeySpec(_SPEED)})),
    "rotor": KeySpec(TableSpec("rotor", {
        "kind": KeySpec(Choice(("rotating", "reciprocating")), default="rotating"),
        "masses": KeySpec(ListOf(_PLANE_MASS, fewest=1, most=60), required=True),
        "reciprocating_share": KeySpec(Number(0.0, 1.0), default=0.0, only={"kind": ("rotating",)}),
        "rod_length": KeySpec(_LENGTH.kind, only=_PISTONS),
        "reference": KeySpec(_REACH),
        "bearings": KeySpec(ListOf(_REACH, fewest=2, most=2), only={"kind": ("rotating",)}),
        "arrangement": KeySpec(Number(1, 100, whole=True), default=1),
        "locomotive": KeySpec(TableSpec("locomotive", {
            "speed": KeySpec(Quantity(("velocity",), 1e-3, 1e3), only={"wheel_diameter": ()}),
            "wheel_diameter": KeySpec(_LENGTH.kind),
            "wheel_load": KeySpec(Quantity(("force",), 0.0, 1e9, above=True)),
            "coupled": KeySpec(Number(1, 12, whole=True), default=1),
        })),
    }), required=True),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip

TURNING_FILE = TableSpec("file", {
    **TITLE,
    "document": TURNING_DOCUMENT,
    "crank": KeySpec(TableSpec("turning_crank", {
        "speed": KeySpec(_SPEED, instead_of=("largest_speed",)),
        "largest_speed": KeySpec(_SPEED, instead_of=("speed",)),
        "inertia": KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2"),
    })),
    "torque": KeySpec(_DIAGRAM, required=True),
    "load": KeySpec(_DIAGRAM),
    "efficiency": KeySpec(EFFICIENCY),
    "flywheel": KeySpec(FLYWHEEL),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip

# a press, which a motor drives with the mean
PRESS_FILE = TURNING_FILE._replace(keys={
    **{name: key for name, key in TURNING_FILE.keys.items() if name != "torque"},
    "load": KeySpec(_DIAGRAM, required=True),
    "motor_selection": MOTOR_SELECTION,
})  # fmt: skip

# discs on elastic shafts, which nothing but stated torques excites
TORSION_FILE = TURNING_FILE._replace(keys={
    **{name: TURNING_FILE.keys[name] for name in (*TITLE, "document", "method", "table")},
    "crank": KeySpec(TableSpec("turning_crank", {"speed": KeySpec(_SPEED)})),
    "torsion": TORSION,
})  # fmt: skip
