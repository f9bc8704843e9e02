"""The keys of the whole engine: its cylinders, bearings, counterweights, flywheel and calculated cycle."""

from __future__ import annotations

import math

from crankwork.description.schema import Choice, Flag, Key, ListOf, NameOr, Number, Quantity, Table, Text

_LENGTH = Quantity(("length",), 1e-4, 100.0)
_SPACING = Quantity(("length",), 0.0, 100.0)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_EVENT = Quantity(("angle",), 0.0, 0.75 * math.pi)
_BEFORE = Quantity(("angle",), math.radians(0.1), math.pi / 2)
_PRESSURE = Quantity(("pressure",), 100.0, 1e9)
_TEMPERATURE = Quantity(("temperature",), 100.0, 5000.0)
_RISE = Quantity(("temperature",), -100.0, 1000.0)
_EXPONENT = Number(0.5, 3.0)
_SHARE = Number(0.0, 1.0)

_ARTICULATED = Table({
    "knuckle_radius": Key(_LENGTH, "distance of the knuckle pins from the crankpin", required=True),
    "rod_length": Key(_LENGTH, "of the articulated rods; by default the master rod less the knuckle radius"),
    "knuckle_angles": Key(ListOf(_ANGLE, fewest=1),
                          "of the knuckle pins from the master rod, by cylinder after the master; "
                          "by default the angles between the cylinders"),
    "mass": Key(Quantity(("mass",), 0.0, 1e6), "mass of an articulated rod; by default its ends are those of the rod"),
    "small_end_share": Key(Number(0.0, 1.0), "share of that mass at the piston pin",
                           instead_of=("centre_of_mass",)),
    "centre_of_mass": Key(_LENGTH, "distance of its centre of mass from the knuckle pin axis",
                          instead_of=("small_end_share",)),
    "inertia": Key(Quantity(("inertia",), 0.0, 1e6), "its moment of inertia about the centre of mass",
                   instead_of=("radius_of_gyration",)),
    "radius_of_gyration": Key(_LENGTH, "its radius of gyration about the centre of mass", instead_of=("inertia",)),
})  # fmt: skip

ENGINE = Table({
    "layout": Key(Choice(("inline", "V", "boxer", "W", "radial")), "how the cylinders stand", required=True),
    "cylinders": Key(Number(1, 28, whole=True), "how many there are", required=True),
    "strokes": Key(Choice((4, 2)), "of a cycle, where no gas says it; by default 4"),
    "firing_order": Key(ListOf(Number(1, 28, whole=True), fewest=1, most=28),
                        "numbers of the cylinders as they fire; by default a usual order"),
    "bank_angle": Key(_ANGLE, "between the banks of a V"),
    "bank_angles": Key(ListOf(_ANGLE, fewest=2, most=8), "directions of the banks of a W from the upward vertical"),
    "throws": Key(ListOf(_ANGLE, fewest=1, most=28),
                  "angles of the crank throws from the first, with the rotation; by default from the firing order"),
    "pin_offset": Key(_ANGLE, "between the two pins of a split crankpin of a V"),
    "numbering": Key(Choice(("banks", "pairs")), "of a V: one bank after the other, or throw by throw"),
    "spacing": Key(_LENGTH, "between neighbouring crank throws along the shaft"),
    "bank_stagger": Key(_SPACING, "between the rods of one throw along the shaft"),
    "uneven": Key(Flag(), "say true where uneven firing intervals are meant"),
    "own_throws": Key(Flag(), "say true where every cylinder of a V has a throw of its own, as in a narrow one"),
    "offsets": Key(ListOf(Quantity(("length",), -100.0, 100.0), fewest=1, most=28),
                   "of each cylinder axis from the crankshaft axis, towards the crankpin at 90 degrees; "
                   "by default that of the cylinder"),
    "articulated": Key(_ARTICULATED, "rods of a radial or V engine that turn on the master rod"),
    "misfire": Key(ListOf(Number(1, 28, whole=True), fewest=1, most=28),
                   "numbers of the cylinders in which nothing burns"),
    "pressure_factors": Key(ListOf(Number(0.0, 10.0), fewest=1, most=28),
                            "of each cylinder, by which its gauge pressure differs; by default 1"),
})  # fmt: skip

BEARINGS = Table({
    "crankpin_diameter": Key(_LENGTH, "of the crankpin"),
    "crankpin_length": Key(_LENGTH, "working length of the crankpin bearing"),
    "main_diameter": Key(_LENGTH, "of the main journals"),
    "main_length": Key(_LENGTH, "working length of the main bearings"),
    "pin_diameter": Key(_LENGTH, "of the piston pin"),
    "pin_length": Key(_LENGTH, "working length of the small-end bearing"),
    "rays": Key(Choice((12, 24)), "rays of the wear diagram; by default 12"),
    "counterweight": Key(Quantity(("mass_moment",), 0.0, 1e6),
                         "mass times radius opposite each throw; by default none"),
})  # fmt: skip

BALANCE = Table({
    "rotating_share": Key(Number(0.0, 2.0), "share of the rotating mass balanced by counterweights; by default 0"),
    "reciprocating_share": Key(Number(0.0, 2.0), "share of the reciprocating mass balanced as well; by default 0"),
    "shafts": Key(ListOf(Choice((1, 2)), fewest=1, most=2), "orders that pairs of balance shafts take out"),
})  # fmt: skip

FLYWHEEL = Table({
    "fluctuation": Key(Number(1e-6, 1.0), "wanted: largest less least speed over the mean"),
    "inertia": Key(Quantity(("inertia",), 0.0, 1e9),
                   "of everything that turns with the crankshaft, without the flywheel to be found"),
})  # fmt: skip

_FUEL = Table({
    "carbon": Key(_SHARE, "mass of carbon in 1 kg", required=True),
    "hydrogen": Key(_SHARE, "mass of hydrogen in 1 kg", required=True),
    "oxygen": Key(_SHARE, "mass of oxygen in 1 kg"),
    "molar_mass": Key(Number(1.0, 1000.0), "of the vapour, in kg/kmol; petrol needs it"),
    "heating_value": Key(Quantity(("specific_energy",), 1e6, 2e8), "lower heating value", required=True),
})  # fmt: skip

_TIMING = Table({
    "intake_opens": Key(_EVENT, "before the top dead centre of gas exchange"),
    "intake_closes": Key(_EVENT, "after the bottom dead centre"),
    "exhaust_opens": Key(_EVENT, "before the bottom dead centre"),
    "exhaust_closes": Key(_EVENT, "after the top dead centre of gas exchange"),
    "ignition": Key(_BEFORE, "before the top dead centre of firing"),
    "ignition_delay": Key(_EVENT, "from ignition to the rise of pressure"),
    "peak": Key(_BEFORE, "of the greatest pressure after the top dead centre, 10 to 15 degrees as a rule"),
})  # fmt: skip

CYCLE = Table({
    "kind": Key(Choice(("petrol", "diesel", "otto", "ideal-diesel", "dual", "wiebe")),
                "calculation by Grinevetsky and Mazing for petrol or diesel, an ideal cycle, or heat release by Wiebe",
                required=True),
    "cycle": Key(Choice(("720 deg", "360 deg")), "four strokes or two; by default 720 deg"),
    "fuel": Key(NameOr(_FUEL), "petrol, diesel, or its composition"),
    "excess_air": Key(Number(0.2, 20.0), "air over what the fuel needs"),
    "ambient_pressure": Key(_PRESSURE, "of the surroundings and under the piston"),
    "ambient_temperature": Key(_TEMPERATURE, "of the surroundings"),
    "charge_pressure": Key(_PRESSURE, "behind the compressor of a charged engine"),
    "charge_temperature": Key(_TEMPERATURE, "behind the compressor and cooler"),
    "intake_pressure": Key(_PRESSURE, "at the end of intake"),
    "intake_temperature": Key(_TEMPERATURE, "at the start of compression, of ideal cycles and Wiebe"),
    "intake_loss_factor": Key(Number(0.0, 50.0), "of the intake, where its end pressure is not given"),
    "intake_speed": Key(Quantity(("velocity",), 0.0, 1000.0), "in the narrowest section of the intake"),
    "residual_pressure": Key(_PRESSURE, "of the residual gas"),
    "residual_temperature": Key(_TEMPERATURE, "of the residual gas"),
    "heating": Key(_RISE, "of the fresh charge on its way in"),
    "charge_up": Key(Number(0.5, 1.5), "factor of charging after the bottom dead centre"),
    "scavenging": Key(Number(0.0, 1.5), "factor of scavenging the residual gas"),
    "compression_exponent": Key(_EXPONENT, "n1 of the polytrope"),
    "expansion_exponent": Key(_EXPONENT, "n2 of the polytrope"),
    "heat_use": Key(Number(0.2, 1.2), "heat used up to the point z over that of the fuel"),
    "pressure_ratio": Key(Number(1.0, 5.0), "rise of pressure at constant volume, of diesel and dual cycles"),
    "cut_off": Key(Number(1.0, 10.0), "rise of volume at constant pressure, of ideal cycles"),
    "heat": Key(Quantity(("specific_energy",), 0.0, 1e8), "added to 1 kg of gas, of ideal cycles"),
    "peak_temperature": Key(_TEMPERATURE, "of an ideal cycle"),
    "adiabatic_exponent": Key(Number(1.01, 2.0), "of ideal cycles and Wiebe; by default 1.4 and 1.35"),
    "filling": Key(Number(0.5, 1.0), "of the rounded diagram: mean pressure over that of the sharp one"),
    "mechanical_loss": Key(ListOf(Number(0.0, 1.0), fewest=2, most=2),
                           "a and b of p_m = a + b v_p in MPa and MPa s/m; by default from the kind of engine"),
    "heat_capacities": Key(Choice(("kolchin", "vietnamese", "linear")), "law of the mean molar heats"),
    "power": Key(Quantity(("power",), 1.0, 1e9), "wanted effective power; bore and stroke follow"),
    "stroke_bore_ratio": Key(Number(0.2, 5.0), "stroke over bore, where they follow from the power"),
    "lost_stroke": Key(Number(0.0, 0.6), "share of the stroke that the ports of a two-stroke engine take"),
    "corners": Key(Choice(("rounded", "sharp")), "of the diagram; by default rounded"),
    "peak_level": Key(Number(0.5, 1.0), "greatest pressure of the rounded diagram over that of the sharp one"),
    "school": Key(Choice(("ru", "vi")), "whose construction rounds the corners"),
    "timing": Key(_TIMING, "of valves or ports and ignition"),
    "combustion_start": Key(Quantity(("angle",), -math.pi / 2, math.pi / 2), "before the top dead centre, for Wiebe"),
    "combustion_duration": Key(Quantity(("angle",), math.radians(1), math.pi), "for Wiebe"),
    "shape": Key(Number(0.0, 10.0), "exponent m of Wiebe"),
    "cycle_heat": Key(Quantity(("energy",), 1e-6, 1e9), "of the fuel, per cycle and cylinder, for Wiebe"),
    "fuel_mass": Key(Quantity(("mass",), 1e-12, 1e3), "burnt per cycle and cylinder, for Wiebe, instead of cycle_heat"),
    "heating_value": Key(Quantity(("specific_energy",), 1e6, 2e8), "lower one of the fuel, with fuel_mass"),
    "burning_efficiency": Key(Number(0.1, 1.0), "share of the heating value that is released; by default 1"),
    "wall_temperature": Key(_TEMPERATURE, "of the walls, for Woschni; without it there is no heat loss"),
    "motored": Key(Choice(("compressed", "ambient")),
                   "gas of a cylinder that misfires: compressed and expanded, or open to the surroundings; "
                   "by default compressed"),
    "source": Key(Text(), "where the data come from"),
})  # fmt: skip
