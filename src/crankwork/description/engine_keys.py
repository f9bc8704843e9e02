"""The keys of the whole engine: its cylinders, bearings, counterweights, flywheel and calculated cycle."""

from __future__ import annotations

import math

from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.description.kinds import Choice, Flag, Number, Quantity, Text
from crankwork.description.schema import By, Key, ListOf, NameOr, Table

_LENGTH = Quantity(("length",), 1e-4, 100.0)
_SPACING = Quantity(("length",), 0.0, 100.0)
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
_ARTICULATED = Table("articulated", {
    "knuckle_radius": Key(_LENGTH, required=True),
    "rod_length": Key(_LENGTH),
    "knuckle_angles": Key(ListOf(_ANGLE, fewest=1)),
    "mass": Key(_MASS),
    "small_end_share": Key(_SHARE, instead_of=("centre_of_mass",), only=_OF_MASS),
    "centre_of_mass": Key(_LENGTH, instead_of=("small_end_share",), only=_OF_MASS),
    "inertia": Key(_INERTIA, instead_of=("radius_of_gyration",), only=_OF_MASS),
    "radius_of_gyration": Key(_LENGTH, instead_of=("inertia",), only=_OF_MASS),
})  # fmt: skip

_V, _W, _BANKS = {"layout": ("V",)}, {"layout": ("W",)}, {"layout": ("V", "boxer", "W")}
ENGINE = Table("engine", {
    "layout": Key(Choice(("inline", "V", "boxer", "W", "radial")), required=True),
    "cylinders": Key(Number(1, MOST_CYLINDERS, whole=True), required=True),
    "strokes": Key(Choice((4, 2)), default=4),
    "firing_order": Key(ListOf(Number(1, MOST_CYLINDERS, whole=True), fewest=1, most=MOST_CYLINDERS)),
    "bank_angle": Key(_ANGLE, required=True, only=_V),
    "bank_angles": Key(ListOf(_ANGLE, fewest=2, most=8), required=True, only=_W),
    "throws": Key(ListOf(_ANGLE, fewest=1, most=MOST_CYLINDERS), only={"layout": ("inline", "V", "boxer", "W")}),
    "pin_offset": Key(_ANGLE, default="0 deg", only=_V),
    "numbering": Key(Choice(("banks", "pairs")), only=_BANKS),
    "spacing": Key(_LENGTH),
    "bank_stagger": Key(_SPACING, only=_BANKS),
    "uneven": Key(Flag(), default=False),
    "own_throws": Key(Flag(), default=False, only=_V),
    "offsets": Key(ListOf(Quantity(("length",), -100.0, 100.0), fewest=1, most=MOST_CYLINDERS)),
    "articulated": Key(_ARTICULATED, only={"layout": ("V", "radial")}),
    "misfire": Key(ListOf(Number(1, MOST_CYLINDERS, whole=True), fewest=1, most=MOST_CYLINDERS)),
    "pressure_factors": Key(ListOf(Number(0.0, 10.0), fewest=1, most=MOST_CYLINDERS)),
})  # fmt: skip

BEARINGS = Table("bearings", {
    **dict.fromkeys(
        ("crankpin_diameter", "crankpin_length", "main_diameter", "main_length", "pin_diameter", "pin_length"),
        Key(_LENGTH),
    ),
    "rays": Key(Choice((12, 24)), default=12),
    "counterweight": Key(Quantity(("mass_moment",), 0.0, 1e6), default="0 kg*m"),
})  # fmt: skip

BALANCE = Table("balance", {
    "rotating_share": Key(Number(0.0, 2.0), default=0.0),
    "reciprocating_share": Key(Number(0.0, 2.0), default=0.0),
    "shafts": Key(ListOf(Choice((1, 2)), fewest=1, most=2)),
})  # fmt: skip

_SIZE = Quantity(("length",), 1e-6, 100.0)
_RIM = Table("rim", {
    "diameter": Key(_SIZE, required=True, instead_of=("speed", "stress")),
    "speed": Key(Quantity(("velocity",), 1e-3, 1e4), instead_of=("diameter", "stress")),
    "stress": Key(Quantity(("pressure",), 1.0, 1e10), instead_of=("diameter", "speed"), only={"density": ()}),
    "density": Key(Quantity(("density",), 1.0, 1e5)),
    "ratio": Key(Number(1e-3, 1e3), only={"density": ()}),
    "width": Key(_SIZE, instead_of=("ratio",), only={"density": ()}),
    "thickness": Key(_SIZE, instead_of=("ratio",), only={"density": ()}),
    "share": Key(Number(0.0, 1.0, above=True), default=1.0),
})  # fmt: skip

FLYWHEEL = Table("flywheel", {
    "fluctuation": Key(Number(1e-6, 1.0), instead_of=("percent", "speeds")),
    "percent": Key(Number(1e-4, 50.0), instead_of=("fluctuation", "speeds")),
    "speeds": Key(ListOf(Quantity(("speed",), 1e-6, 3e4), fewest=2, most=2), instead_of=("fluctuation", "percent")),
    "inertia": Key(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2", instead_of=("mass",)),
    "mass": Key(Quantity(("mass",), 0.0, 1e9, above=True), instead_of=("inertia",)),
    "radius_of_gyration": Key(_SIZE, instead_of=("rim",)),
    "rim": Key(_RIM, instead_of=("radius_of_gyration",)),
    "recovery": Key(Quantity(("time",), 1e-6, 1e6)),
})  # fmt: skip

_FUEL = Table("fuel", {
    "carbon": Key(_SHARE, required=True),
    "hydrogen": Key(_SHARE, required=True),
    "oxygen": Key(_SHARE, default=0.0),
    "molar_mass": Key(Number(1.0, 1000.0)),
    "heating_value": Key(Quantity(("specific_energy",), 1e6, 2e8), required=True),
})  # fmt: skip

_TIMING = Table("timing", {
    "intake_opens": Key(_EVENT),
    "intake_closes": Key(_EVENT),
    "exhaust_opens": Key(_EVENT),
    "exhaust_closes": Key(_EVENT),
    "ignition": Key(_BEFORE),
    "ignition_delay": Key(_EVENT),
    "peak": Key(_BEFORE, default="12 deg"),
})  # fmt: skip

_REAL, _IDEAL = ("petrol", "diesel"), ("otto", "ideal-diesel", "dual")
_OF_REAL, _OF_IDEAL, _OF_WIEBE = {"kind": _REAL}, {"kind": _IDEAL}, {"kind": ("wiebe",)}
_RATIOS = By("kind", dict.fromkeys(_IDEAL, 1.4) | {"wiebe": 1.33})
_INTAKE = By("kind", dict.fromkeys(_IDEAL, "0.1 MPa") | {"wiebe": "0.09 MPa"})
_WARM = By("kind", dict.fromkeys(_IDEAL, "300 K") | {"wiebe": "340 K"})
_CORNERS, _CLOSED = {"kind": _REAL + _IDEAL}, {"kind": (*_IDEAL, "wiebe")}
CYCLE = Table("cycle", {
    "kind": Key(Choice((*_REAL, *_IDEAL, "wiebe")), required=True),
    "cycle": Key(Choice(("720 deg", "360 deg")), default="720 deg"),
    "fuel": Key(NameOr(_FUEL), only=_OF_REAL),
    "excess_air": Key(Number(0.2, 20.0), only=_OF_REAL),
    "ambient_pressure": Key(_PRESSURE, default="0.1 MPa"),
    "ambient_temperature": Key(_TEMPERATURE, default="293 K", only=_OF_REAL),
    "charge_pressure": Key(_PRESSURE, only=_OF_REAL),
    "charge_temperature": Key(_TEMPERATURE, only=_OF_REAL),
    "intake_pressure": Key(_PRESSURE, default=_INTAKE),
    "intake_temperature": Key(_TEMPERATURE, default=_WARM, only=_CLOSED),
    "intake_loss_factor": Key(Number(0.0, 50.0), only=_OF_REAL),
    "intake_speed": Key(Quantity(("velocity",), 0.0, 1000.0), only=_OF_REAL),
    "residual_pressure": Key(_PRESSURE, only={"kind": (*_REAL, "wiebe")}),
    "residual_temperature": Key(_TEMPERATURE, only=_OF_REAL),
    "heating": Key(_RISE, only=_OF_REAL),
    "charge_up": Key(Number(0.5, 1.5), default=1.0, only=_OF_REAL),
    "scavenging": Key(Number(0.0, 1.5), default=1.0, only=_OF_REAL),
    "compression_exponent": Key(_EXPONENT, only=_OF_REAL),
    "expansion_exponent": Key(_EXPONENT, only=_OF_REAL),
    "heat_use": Key(Number(0.2, 1.2), only=_OF_REAL),
    "pressure_ratio": Key(Number(1.0, 5.0), only={"kind": ("diesel", *_IDEAL)}),
    "cut_off": Key(Number(1.0, 10.0), only=_OF_IDEAL),
    "heat": Key(Quantity(("specific_energy",), 0.0, 1e8), only=_OF_IDEAL),
    "peak_temperature": Key(_TEMPERATURE, only=_OF_IDEAL),
    "adiabatic_exponent": Key(Number(1.01, 2.0), default=_RATIOS, only=_CLOSED),
    "filling": Key(Number(0.5, 1.0), only=_CORNERS),
    "mechanical_loss": Key(ListOf(_SHARE, fewest=2, most=2), only=_OF_REAL),
    "heat_capacities": Key(Choice(("kolchin", "vietnamese", "linear")), default="kolchin", only=_OF_REAL),
    "power": Key(Quantity(("power",), 1.0, 1e9), only=_OF_REAL),
    "stroke_bore_ratio": Key(Number(0.2, 5.0), default=1.0, only=_OF_REAL),
    "lost_stroke": Key(Number(0.0, 0.6), only=_OF_REAL),
    "corners": Key(Choice(("rounded", "sharp")), only=_CORNERS),
    "peak_level": Key(Number(0.5, 1.0), only=_CORNERS),
    "school": Key(Choice(("ru", "vi")), default="ru", only=_CORNERS),
    "timing": Key(_TIMING),
    "combustion_start": Key(Quantity(("angle",), -math.pi / 2, math.pi / 2), default="20 deg", only=_OF_WIEBE),
    "combustion_duration": Key(Quantity(("angle",), math.radians(1), math.pi), default="50 deg", only=_OF_WIEBE),
    "shape": Key(Number(0.0, 10.0), default=2.0, only=_OF_WIEBE),
    "cycle_heat": Key(Quantity(("energy",), 1e-6, 1e9), only=_OF_WIEBE),
    "fuel_mass": Key(Quantity(("mass",), 1e-12, 1e3), only=_OF_WIEBE),
    "heating_value": Key(Quantity(("specific_energy",), 1e6, 2e8), only=_OF_WIEBE),
    "burning_efficiency": Key(Number(0.1, 1.0), default=1.0, only=_OF_WIEBE),
    "wall_temperature": Key(_TEMPERATURE, only=_OF_WIEBE),
    "motored": Key(Choice(("compressed", "ambient")), default="compressed"),
    "source": Key(Text()),
})  # fmt: skip

# of a chamber, whose period and pressure around stand beside it
HEAT_RELEASE = Table("cycle", {
    "kind": Key(Choice(("wiebe",)), required=True),
    **{
        name: CYCLE.keys[name]
        for name in (
            "intake_pressure", "intake_temperature", "residual_pressure", "adiabatic_exponent", "timing",
            "combustion_start", "combustion_duration", "shape", "fuel_mass", "heating_value", "wall_temperature",
            "source",
        )
    },
    "burning_efficiency": CYCLE.keys["burning_efficiency"]._replace(only={"fuel_mass": ()}),
    # none where nothing burns
    "cycle_heat": Key(Quantity(("energy",), 0.0, 1e9)),
})  # fmt: skip
