"""The keys of an engine: its cylinders, bearings, counterweights, flywheel and calculated cycle."""

from __future__ import annotations

import math

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description.schema import DefaultBy, KeySpec, ListOf, NameOr, TableSpec
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Text
from crankwork.working_cycle.schools import PEAK_LEVEL, SCHOOLS

_LENGTH = Quantity(("length",), 1e-4, 100.0)
_SPACING = Quantity(("length",), 0.0, 100.0)
_VOLUME = Quantity(("volume",), 1e-15, 1e3)
_MASS = Quantity(("mass",), 0.0, 1e6)
_INERTIA = Quantity(("inertia",), 0.0, 1e6)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_EVENT = Quantity(("angle",), 0.0, 0.75 * math.pi)
_BEFORE = Quantity(("angle",), math.radians(0.1), math.pi / 2)
_PRESSURE = Quantity(("pressure",), 100.0, 1e9)
_TEMPERATURE = Quantity(("temperature",), 100.0, 5000.0)
_RISE = Quantity(("temperature",), -100.0, 1000.0)
_EXPONENT = Number(0.5, 3.0)
_SHARE = Number(0.0, 1.0)

_OF_MASS = {"mass": ()}
_ARTICULATED = TableSpec("articulated", {
    "knuckle_radius": KeySpec(_LENGTH, required=True),
    "rod_length": KeySpec(_LENGTH),
    "knuckle_angles": KeySpec(ListOf(_ANGLE, fewest=1)),
    "mass": KeySpec(_MASS),
    "small_end_share": KeySpec(_SHARE, instead_of=("centre_of_mass",), only=_OF_MASS),
    "centre_of_mass": KeySpec(_LENGTH, instead_of=("small_end_share",), only=_OF_MASS),
    "inertia": KeySpec(_INERTIA, instead_of=("radius_of_gyration",), only=_OF_MASS),
    "radius_of_gyration": KeySpec(_LENGTH, instead_of=("inertia",), only=_OF_MASS),
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
    "spacing": KeySpec(_LENGTH),
    "bank_stagger": KeySpec(_SPACING, only=_BANKS),
    "uneven": KeySpec(Flag(), default=False),
    "own_throws": KeySpec(Flag(), default=False, only=_V),
    "offsets": KeySpec(ListOf(Quantity(("length",), -100.0, 100.0), fewest=1, most=MOST_CYLINDERS)),
    "bores": KeySpec(ListOf(_LENGTH, fewest=1, most=MOST_CYLINDERS)),
    "clearance_volumes": KeySpec(ListOf(_VOLUME, fewest=1, most=MOST_CYLINDERS)),
    "piston_masses": KeySpec(ListOf(_MASS, fewest=1, most=MOST_CYLINDERS)),
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
        KeySpec(_LENGTH),
    ),
    "rays": KeySpec(Choice((12, 24)), default=12),
    "counterweight": KeySpec(Quantity(("mass_moment",), 0.0, 1e6), default="0 kg*m"),
})  # fmt: skip

BALANCE = TableSpec("balance", {
    "rotating_share": KeySpec(Number(0.0, 2.0), default=0.0),
    "reciprocating_share": KeySpec(Number(0.0, 2.0), default=0.0),
    "shafts": KeySpec(ListOf(Choice((1, 2)), fewest=1, most=2)),
})  # fmt: skip

_SIZE = Quantity(("length",), 1e-6, 100.0)
_RIM = TableSpec("rim", {
    "diameter": KeySpec(_SIZE, instead_of=("speed", "stress")),
    "speed": KeySpec(Quantity(("velocity",), 1e-3, 1e4), instead_of=("diameter", "stress")),
    "stress": KeySpec(Quantity(("pressure",), 1.0, 1e10), instead_of=("diameter", "speed"), only={"density": ()}),
    "density": KeySpec(Quantity(("density",), 1.0, 1e5)),
    "ratio": KeySpec(Number(1e-3, 1e3), only={"density": ()}),
    "width": KeySpec(_SIZE, instead_of=("ratio",), only={"density": ()}),
    "thickness": KeySpec(_SIZE, instead_of=("ratio",), only={"density": ()}),
    "share": KeySpec(Number(1e-6, 1.0), default=1.0),
})  # fmt: skip

FLYWHEEL = TableSpec("flywheel", {
    "fluctuation": KeySpec(Number(1e-6, 1.0), instead_of=("percent", "speeds")),
    "percent": KeySpec(Number(1e-4, 50.0, percent=1.0), instead_of=("fluctuation", "speeds")),
    "speeds": KeySpec(ListOf(Quantity(("speed",), 1e-6, 3e4), fewest=2, most=2), instead_of=("fluctuation", "percent")),
    "inertia": KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2", instead_of=("mass",)),
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e9, above=True), instead_of=("inertia",)),
    "radius_of_gyration": KeySpec(_SIZE, instead_of=("rim",)),
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
    "charge_pressure": KeySpec(_PRESSURE, only=_OF_REAL),
    "charge_temperature": KeySpec(_TEMPERATURE, only=_OF_REAL),
    "intake_pressure": KeySpec(_PRESSURE, required=_ASSIGNED, default=_INTAKE),
    "intake_temperature": KeySpec(_TEMPERATURE, default=_WARM, only=_CLOSED),
    "intake_loss_factor": KeySpec(Number(0.0, 50.0), only=_OF_REAL),
    "intake_speed": KeySpec(Quantity(("velocity",), 0.0, 1000.0), only=_OF_REAL),
    "residual_pressure": KeySpec(
        _PRESSURE, _ASSIGNED, default=DefaultBy("kind", {"wiebe": "0.11 MPa"}),
        only={"kind": (*_REAL, *_ASSIGNED, "wiebe")},
    ),
    "residual_temperature": KeySpec(_TEMPERATURE, only=_OF_REAL),
    "heating": KeySpec(_RISE, only=_OF_REAL),
    "charge_up": KeySpec(Number(0.5, 1.5), default=1.0, only=_OF_REAL),
    "scavenging": KeySpec(Number(0.0, 1.5), default=1.0, only=_OF_REAL),
    "compression_exponent": KeySpec(_EXPONENT, _ASSIGNED, ("compression_pressure",), only=_OF_EXPONENTS),
    "compression_pressure": KeySpec(_PRESSURE, instead_of=("compression_exponent",), only=_OF_ASSIGNED),
    "peak_pressure": KeySpec(_PRESSURE, _ASSIGNED, ("pressure_ratio",), only=_OF_ASSIGNED),
    "expansion_exponent": KeySpec(_EXPONENT, _ASSIGNED, ("expansion_pressure",), only=_OF_EXPONENTS),
    "expansion_pressure": KeySpec(_PRESSURE, instead_of=("expansion_exponent",), only=_OF_ASSIGNED),
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
