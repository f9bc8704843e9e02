"""The keys of the machine file: kind, range and default of each, and when it applies.

Reader, error messages, schema and settings use them; the meaning of a key is a text of the file `fields`.
"""

from __future__ import annotations

import math

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description import document_keys
from crankwork.description.cylinder_keys import BALANCE, BEARINGS, CYCLE, ENGINE, FLYWHEEL
from crankwork.description.load_keys import LOADING, SHEET, with_defaults
from crankwork.description.schema import DefaultBy, KeySpec, ListOf, MapOf, NameOr, TableSpec, WordOr
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Text, UnitOf
from crankwork.method import STANDARD_GRAVITY

_LENGTH = Quantity(("length",), 1e-6, 100.0)
_MASS = Quantity(("mass", "mass_per_area"), 0.0, 1e6)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_VOLUME = Quantity(("volume",), 1e-15, 1e3)
AMBIENT = DefaultBy("pressures", {"absolute": "101325 Pa"})
NO_ACCELERATION = KeySpec(Quantity(("angular_acceleration",), -1e6, 1e6), default="0 rad/s2")

_CRANK = TableSpec("crank", {
    "radius": KeySpec(_LENGTH, required=True, instead_of=("stroke",)),
    "stroke": KeySpec(_LENGTH, instead_of=("radius",)),
    "speed": KeySpec(Quantity(("speed",), 1e-6, 3e4), required=True),
    "angular_acceleration": NO_ACCELERATION,
    "mass": KeySpec(_MASS),
})  # fmt: skip

_ENDS = ("small_end_mass", "big_end_mass")
_ROD = TableSpec("rod", {
    "ratio": KeySpec(Number(1e-6, 1e6), required=True, instead_of=("length",)),
    "length": KeySpec(_LENGTH, instead_of=("ratio",)),
    "ratio_definition": KeySpec(Choice(("r/l", "l/r")), default="r/l"),
    "mass": KeySpec(_MASS),
    "small_end_share": KeySpec(Number(0.0, 1.0), instead_of=("centre_of_mass", *_ENDS)),
    "centre_of_mass": KeySpec(_LENGTH, instead_of=("small_end_share", *_ENDS)),
    "small_end_mass": KeySpec(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "big_end_mass": KeySpec(_MASS, instead_of=("mass", "small_end_share", "centre_of_mass")),
    "inertia": KeySpec(Quantity(("inertia",), 0.0, 1e6), instead_of=("radius_of_gyration",)),
    "radius_of_gyration": KeySpec(_LENGTH, instead_of=("inertia",)),
})  # fmt: skip

_PISTON = TableSpec("piston", {"mass": KeySpec(_MASS)})

_CYLINDER = TableSpec("cylinder", {
    "bore": KeySpec(Quantity(("length",), 1e-4, 100.0), required=True),
    "displacement": KeySpec(_VOLUME),
    "stroke_bore_ratio": KeySpec(Number(0.2, 5.0)),
    "clearance_volume": KeySpec(_VOLUME, instead_of=("compression_ratio",)),
    "compression_ratio": KeySpec(Number(1.001, 100.0), instead_of=("clearance_volume",)),
    "offset": KeySpec(Quantity(("length",), -100.0, 100.0), default="0 mm"),
    "inclination": KeySpec(_ANGLE),
    "piston_rod_diameter": KeySpec(_LENGTH),
})  # fmt: skip

POINT = TableSpec("point", {
    "angle": KeySpec(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9), instead_of=("stroke",)),
    "stroke": KeySpec(Number(0.0, 1.0), instead_of=("angle",)),
    "pressure": KeySpec(_PRESSURE),
    "volume": KeySpec(_VOLUME),
})  # fmt: skip

PIECE = TableSpec("piece", {
    "law": KeySpec(Choice(("constant", "polytropic", "rounded")), required=True),
    "points": KeySpec(ListOf(Text(60), fewest=2), required=True),
    "exponent": KeySpec(Number(0.0, 5.0)),
    "reference": KeySpec(Text(60)),
})  # fmt: skip

_PEG = TableSpec("peg", {
    "angle": KeySpec(_ANGLE, required=True, instead_of=("exponent",), example='"180 deg"'),
    "pressure": KeySpec(_PRESSURE, required=True, only={"angle": ()}, example='"1 bar"'),
    "exponent": KeySpec(Number(1.0, 2.0), instead_of=("angle",), example="1.32"),
    "from": KeySpec(_ANGLE, required=True, only={"exponent": ()}, example='"270 deg"'),
    "to": KeySpec(_ANGLE, required=True, only={"exponent": ()}, example='"330 deg"'),
})  # fmt: skip
# of a file with a column of angles, which steps replace
_OF_TABLE = ("angle_column", "pressure_column", "angle_unit")
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
_EXPONENT = Number(0.5, 3.0)
_KELVIN = Quantity(("temperature",), 1.0, 1e4)
VALVES = TableSpec("valves", {
    "suction": KeySpec(_OPENING, required=True),
    "discharge": KeySpec(_OPENING, required=True),
    "compression_exponent": KeySpec(_EXPONENT, instead_of=("discharge_temperature",)),
    "expansion_exponent": KeySpec(_EXPONENT),
    "temperature": KeySpec(_KELVIN),
    "discharge_temperature": KeySpec(_KELVIN, instead_of=("compression_exponent",), only={"temperature": ()}),
    "gas_constant": KeySpec(Quantity(("specific_heat",), 1.0, 1e5), only={"temperature": ()}),
    "free_pressure": KeySpec(_OPENING, only={"temperature": (), "free_temperature": ()}),
    "free_temperature": KeySpec(_KELVIN, only={"temperature": (), "free_pressure": ()}),
    "delivered": KeySpec(Quantity(("volume_rate",), 0.0, 1e6, above=True)),
})  # fmt: skip

_LIQUID = {"density": ()}
_PIPE = TableSpec("pipe", {
    "length": KeySpec(Quantity(("length",), 1e-3, 1e5), required=True),
    "diameter": KeySpec(_LENGTH, required=True),
    "friction": KeySpec(Number(0.0, 1.0), default=0.0),
})  # fmt: skip
# those of a chamber may stand at the end of pipes
PIPED_VALVES = VALVES._replace(keys={
    **VALVES.keys,
    "density": KeySpec(Quantity(("density",), 1.0, 1e5), instead_of=("compression_exponent", "discharge_temperature")),
    "suction_pipe": KeySpec(_PIPE, only=_LIQUID),
    "discharge_pipe": KeySpec(_PIPE, only=_LIQUID),
    "vapour_pressure": KeySpec(_OPENING, only=_LIQUID),
})  # fmt: skip

# keys of the pressure of a cylinder or chamber
PRESSURES = KeySpec(Choice(("gauge", "absolute")), default="gauge")
DIAGRAM = {
    "points": KeySpec(MapOf(POINT)),
    "pieces": KeySpec(ListOf(PIECE, fewest=1, most=500)),
    "measured": KeySpec(MEASURED, instead_of=("points", "pieces")),
}
_OWN = {**DIAGRAM, "valves": KeySpec(VALVES, instead_of=tuple(DIAGRAM))}
_GAS = TableSpec("gas", {
    "cycle": KeySpec(Choice(("720 deg", "360 deg")), required=True),
    "ambient": KeySpec(Quantity(("pressure",), 0.0, 1e7), default=AMBIENT, only={"pressures": ("absolute",)}),
    "back_pressure": KeySpec(_PRESSURE),
    "pressures": PRESSURES,
    **DIAGRAM,
    "measured": DIAGRAM["measured"]._replace(kind=_OF_ALL),
    "valves": KeySpec(VALVES, instead_of=tuple(DIAGRAM), only={"pressures": ("absolute",), "cycle": ("360 deg",)}),
    "cylinders": KeySpec(MapOf(TableSpec("gas", _OWN), most=28)),
    "motored": KeySpec(NameOr(TableSpec("gas", DIAGRAM))),
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
    "document": document_keys.ENGINE,
    "crank": KeySpec(_CRANK, required=True),
    "rod": KeySpec(_ROD, required=True),
    "piston": KeySpec(_PISTON),
    "cylinder": KeySpec(_CYLINDER),
    "gas": KeySpec(_GAS, instead_of=("cycle",)),
    "cycle": KeySpec(CYCLE, instead_of=("gas",)),
    "engine": KeySpec(ENGINE),
    "bearings": KeySpec(BEARINGS),
    "balance": KeySpec(BALANCE),
    **LOADING,
    "flywheel": KeySpec(FLYWHEEL),
    "method": KeySpec(METHOD),
    "table": KeySpec(TABLE),
})  # fmt: skip


# for files in which a required power, a displacement or a ratio gives bore and stroke
_SIZED = with_defaults(MACHINE_FILE, "crank", _CRANK, radius=None)
SIZED_FILE = with_defaults(_SIZED, "cylinder", _CYLINDER, bore=None)

# for a calculation of a working cycle alone; only its motion needs a rod
CYCLE_FILE, SIZED_CYCLE_FILE = (with_defaults(keys, "rod", _ROD, ratio=0.25) for keys in (MACHINE_FILE, SIZED_FILE))


def with_loading(keys: TableSpec) -> TableSpec:
    """Return the keys of a file of an engine with loads or friction, whose note is that of a linkage."""
    return keys._replace(keys={**keys.keys, "document": document_keys.LINKAGE})


LOADED_FILE, LOADED_SIZED_FILE = map(with_loading, (MACHINE_FILE, SIZED_FILE))
STARTED_ENGINE = with_defaults(LOADED_FILE, "crank", _CRANK, speed="1 rad/s")
