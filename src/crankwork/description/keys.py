"""The keys of the machine file: kind, range and default of each, and when it applies.

Reader, refusals, schema and settings come from here; what a key means is a text of the room `fields`.
"""

from __future__ import annotations

import math

from crankwork.description import document_keys
from crankwork.description.engine_keys import BALANCE, BEARINGS, CYCLE, ENGINE, FLYWHEEL
from crankwork.description.kinds import Choice, Flag, Number, Quantity, Text
from crankwork.description.schema import By, Key, ListOf, Named, NameOr, Table, WordOr
from crankwork.method import STANDARD_GRAVITY

_LENGTH = Quantity(("length",), 1e-6, 100.0)
_MASS = Quantity(("mass", "mass_per_area"), 0.0, 1e6)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_VOLUME = Quantity(("volume",), 1e-15, 1e3)
AMBIENT = By("pressures", {"absolute": "101325 Pa"})
NO_ACCELERATION = Key(Quantity(("angular_acceleration",), -1e6, 1e6), default="0 rad/s2")

_CRANK = Table("crank", {
    "radius": Key(_LENGTH, required=True, instead_of=("stroke",)),
    "stroke": Key(_LENGTH, instead_of=("radius",)),
    "speed": Key(Quantity(("speed",), 1e-6, 3e4), required=True),
    "angular_acceleration": NO_ACCELERATION,
    "mass": Key(_MASS),
})  # fmt: skip

_ENDS = ("small_end_mass", "big_end_mass")
_ROD = Table("rod", {
    "ratio": Key(Number(1e-6, 1e6), required=True, instead_of=("length",)),
    "length": Key(_LENGTH, instead_of=("ratio",)),
    "ratio_definition": Key(Choice(("r/l", "l/r")), default="r/l"),
    "mass": Key(_MASS),
    "small_end_share": Key(Number(0.0, 1.0), instead_of=("centre_of_mass", *_ENDS)),
    "centre_of_mass": Key(_LENGTH, instead_of=("small_end_share", *_ENDS)),
    "small_end_mass": Key(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "big_end_mass": Key(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "inertia": Key(Quantity(("inertia",), 0.0, 1e6), instead_of=("radius_of_gyration",)),
    "radius_of_gyration": Key(_LENGTH, instead_of=("inertia",)),
})  # fmt: skip

_PISTON = Table("piston", {"mass": Key(_MASS)})

_CYLINDER = Table("cylinder", {
    "bore": Key(Quantity(("length",), 1e-4, 100.0), required=True),
    "clearance_volume": Key(_VOLUME, instead_of=("compression_ratio",)),
    "compression_ratio": Key(Number(1.001, 100.0), instead_of=("clearance_volume",)),
    "offset": Key(Quantity(("length",), -100.0, 100.0), default="0 mm"),
    "inclination": Key(_ANGLE),
    "piston_rod_diameter": Key(_LENGTH),
})  # fmt: skip

POINT = Table("point", {
    "angle": Key(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9), instead_of=("stroke",)),
    "stroke": Key(Number(0.0, 1.0), instead_of=("angle",)),
    "pressure": Key(_PRESSURE),
    "volume": Key(_VOLUME),
})  # fmt: skip

PIECE = Table("piece", {
    "law": Key(Choice(("constant", "polytropic", "rounded")), required=True),
    "points": Key(ListOf(Text(60), fewest=2), required=True),
    "exponent": Key(Number(0.0, 5.0)),
    "reference": Key(Text(60)),
})  # fmt: skip

SHEET = Key(Text(), only={"file": ()})
_PEG = Table("peg", {
    "angle": Key(_ANGLE, required=True, instead_of=("exponent",)),
    "pressure": Key(_PRESSURE, required=True, only={"angle": ()}),
    "exponent": Key(Number(1.0, 2.0), instead_of=("angle",)),
    "from": Key(_ANGLE, required=True, only={"exponent": ()}),
    "to": Key(_ANGLE, required=True, only={"exponent": ()}),
})  # fmt: skip
_COLUMN = NameOr(Number(1, 16_384, whole=True))
MEASURED = Table("measured", {
    "file": Key(Text(1000), required=True),
    "sheet": SHEET,
    "angle_column": Key(_COLUMN),
    "pressure_column": Key(_COLUMN),
    "angle_unit": Key(Choice(("deg", "rad"))),
    "pressure_unit": Key(Choice(("MPa", "kPa", "Pa", "bar", "kgf/cm2", "psi", "atm", "hPa"))),
    "shift": Key(_ANGLE, default="0 deg"),
    "cycle": Key(WordOr(Choice(("mean", "greatest peak", "least peak")), Number(1, 1e6, whole=True))),
    "rest_pressure": Key(_PRESSURE),
    "peg": Key(_PEG),
    "smooth": Key(Quantity(("angle",), math.radians(0.1), math.radians(90))),
    "loss_angle": Key(Quantity(("angle",), 0.0, math.radians(10))),
    "resample": Key(Quantity(("angle",), math.radians(0.01), math.radians(30))),
})  # fmt: skip

_OPENING = Quantity(("pressure",), 1.0, 1e10)
_EXPONENT = Number(0.5, 3.0)
_KELVIN = Quantity(("temperature",), 1.0, 1e4)
VALVES = Table("valves", {
    "suction": Key(_OPENING, required=True),
    "discharge": Key(_OPENING, required=True),
    "compression_exponent": Key(_EXPONENT, instead_of=("discharge_temperature",)),
    "expansion_exponent": Key(_EXPONENT),
    "temperature": Key(_KELVIN),
    "discharge_temperature": Key(_KELVIN, instead_of=("compression_exponent",), only={"temperature": ()}),
    "gas_constant": Key(Quantity(("specific_heat",), 1.0, 1e5), only={"temperature": ()}),
    "free_pressure": Key(_OPENING, only={"temperature": (), "free_temperature": ()}),
    "free_temperature": Key(_KELVIN, only={"temperature": (), "free_pressure": ()}),
    "delivered": Key(Quantity(("volume_rate",), 0.0, 1e6, above=True)),
})  # fmt: skip

_LIQUID = {"density": ()}
_PIPE = Table("pipe", {
    "length": Key(Quantity(("length",), 1e-3, 1e5), required=True),
    "diameter": Key(_LENGTH, required=True),
    "friction": Key(Number(0.0, 1.0), default=0.0),
})  # fmt: skip
# those of a chamber may stand at the end of pipes
PIPED_VALVES = VALVES._replace(keys={
    **VALVES.keys,
    "density": Key(Quantity(("density",), 1.0, 1e5), instead_of=("compression_exponent", "discharge_temperature")),
    "suction_pipe": Key(_PIPE, only=_LIQUID),
    "discharge_pipe": Key(_PIPE, only=_LIQUID),
    "vapour_pressure": Key(_OPENING, only=_LIQUID),
})  # fmt: skip

# what the pressure of a cylinder or chamber is made of
PRESSURES = Key(Choice(("gauge", "absolute")), default="gauge")
DIAGRAM = {
    "points": Key(Named(POINT)),
    "pieces": Key(ListOf(PIECE, fewest=1, most=500)),
    "measured": Key(MEASURED, instead_of=("points", "pieces")),
}
_GAS = Table("gas", {
    "cycle": Key(Choice(("720 deg", "360 deg")), required=True),
    "ambient": Key(Quantity(("pressure",), 0.0, 1e7), default=AMBIENT, only={"pressures": ("absolute",)}),
    "back_pressure": Key(_PRESSURE),
    "pressures": PRESSURES,
    **DIAGRAM,
    "valves": Key(VALVES, instead_of=tuple(DIAGRAM), only={"pressures": ("absolute",), "cycle": ("360 deg",)}),
    "cylinders": Key(Named(Table("gas", DIAGRAM), most=28)),
    "motored": Key(NameOr(Table("gas", DIAGRAM))),
})  # fmt: skip

METHOD = Table("method", {
    "kinematics": Key(Text(20), default="exact"),
    "rod": Key(Choice(("rigid", "two-mass"))),
    "pi": Key(Number(3.0, 3.2), default=math.pi),
    "gravity": Key(Quantity(("acceleration",), 0.0, 100.0), default=f"{STANDARD_GRAVITY} m/s2"),
    "weights": Key(Flag(), default=False),
    "inertia_rod_ratio": Key(Number(1e-6, 1.0)),
})  # fmt: skip

TABLE = Table("table", {
    "step": Key(Quantity(("angle",), math.radians(0.01), math.radians(180)), default="10 deg"),
    "special_angles": Key(ListOf(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9))),
})  # fmt: skip

FORMATS = (1, 2)
TITLE = {
    "title": Key(Text()),
    "format": Key(Choice(FORMATS), default=1),
    "decimal_mark": Key(Choice((".", ",")), default="."),
    "units": Key(Choice(("metric", "si", "imperial")), default="metric"),
}

MACHINE_FILE = Table("file", {
    **TITLE,
    "document": document_keys.ENGINE,
    "crank": Key(_CRANK, required=True),
    "rod": Key(_ROD, required=True),
    "piston": Key(_PISTON),
    "cylinder": Key(_CYLINDER),
    "gas": Key(_GAS, instead_of=("cycle",)),
    "cycle": Key(CYCLE, instead_of=("gas",)),
    "engine": Key(ENGINE),
    "bearings": Key(BEARINGS),
    "balance": Key(BALANCE),
    "flywheel": Key(FLYWHEEL),
    "method": Key(METHOD),
    "table": Key(TABLE),
})  # fmt: skip


def _optional(table: Table, *names: str) -> Table:
    keys = {key: one._replace(required=one.required and key not in names) for key, one in table.keys.items()}
    return table._replace(keys=keys)


# where a wanted power gives bore and stroke
SIZED_FILE = MACHINE_FILE._replace(keys={
    **MACHINE_FILE.keys,
    "crank": Key(_optional(_CRANK, "radius"), required=True),
    "cylinder": Key(_optional(_CYLINDER, "bore")),
})  # fmt: skip
