"""The keys of the machine file: what each means, its kind and its range. The schema and the reader come from here."""

from __future__ import annotations

import math

from crankwork.description.engine_keys import BALANCE, BEARINGS, CYCLE, ENGINE, FLYWHEEL
from crankwork.description.schema import Choice, Flag, Key, ListOf, Named, NameOr, Number, Quantity, Table, Text

_LENGTH = Quantity(("length",), 1e-6, 100.0)
_MASS = Quantity(("mass", "mass_per_area"), 0.0, 1e6)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_VOLUME = Quantity(("volume",), 1e-15, 1e3)

_CRANK = Table({
    "radius": Key(_LENGTH, "distance from crankshaft axis to crankpin axis", required=True, instead_of=("stroke",)),
    "stroke": Key(_LENGTH, "twice the crank radius", instead_of=("radius",)),
    "speed": Key(Quantity(("speed",), 1e-6, 3e4), "rotational speed", required=True),
    "angular_acceleration": Key(Quantity(("angular_acceleration",), -1e6, 1e6), "change of the angular speed"),
    "mass": Key(_MASS, "unbalanced mass of one crank throw, placed at the crankpin"),
})  # fmt: skip

_ROD = Table({
    "ratio": Key(Number(1e-6, 1e6), "crank-to-rod ratio, by default r/l", required=True,
                 instead_of=("length",)),
    "length": Key(_LENGTH, "distance between the pin axes", instead_of=("ratio",)),
    "ratio_definition": Key(Choice(("r/l", "l/r")), "what ratio means; books use both"),
    "mass": Key(_MASS, "mass of the connecting rod"),
    "small_end_share": Key(Number(0.0, 1.0), "share of the rod mass at the piston pin, 0.2 to 0.35 as a rule",
                           instead_of=("centre_of_mass", "small_end_mass", "big_end_mass")),
    "centre_of_mass": Key(_LENGTH, "distance of the centre of mass from the crankpin axis",
                          instead_of=("small_end_share", "small_end_mass", "big_end_mass")),
    "small_end_mass": Key(_MASS, "rod mass placed at the piston pin, as a document prints it",
                          instead_of=("mass", "small_end_share", "centre_of_mass")),
    "big_end_mass": Key(_MASS, "rod mass placed at the crankpin, as a document prints it",
                        instead_of=("mass", "small_end_share", "centre_of_mass")),
    "inertia": Key(Quantity(("inertia",), 0.0, 1e6), "moment of inertia about the centre of mass",
                   instead_of=("radius_of_gyration",)),
    "radius_of_gyration": Key(_LENGTH, "radius of gyration about the centre of mass", instead_of=("inertia",)),
})  # fmt: skip

_PISTON = Table({"mass": Key(_MASS, "mass of piston, rings and pin (and crosshead, if there is one)")})

_CYLINDER = Table({
    "bore": Key(Quantity(("length",), 1e-4, 100.0), "diameter", required=True),
    "clearance_volume": Key(_VOLUME, "volume at top dead centre", instead_of=("compression_ratio",)),
    "compression_ratio": Key(Number(1.001, 100.0), "total over clearance volume",
                             instead_of=("clearance_volume",)),
    "offset": Key(Quantity(("length",), -100.0, 100.0),
                  "distance of the cylinder axis from the crankshaft axis, towards the crankpin at 90 degrees"),
    "inclination": Key(_ANGLE, "from the upward vertical to the head, leaning towards the crankpin at 90 degrees"),
    "piston_rod_diameter": Key(_LENGTH, "of a double-acting piston"),
})  # fmt: skip

POINT = Table(
    {
        "angle": Key(
            Quantity(("angle",), 0.0, 4 * math.pi + 1e-9),
            "crank angle; without one, where a polytrope ends, or by stroke or volume",
            instead_of=("stroke",),
        ),
        "stroke": Key(
            Number(0.0, 1.0),
            "share of the stroke that the next passage of the piston has come to",
            instead_of=("angle",),
        ),
        "pressure": Key(_PRESSURE, "pressure; may be left out where a law that ends here gives it"),
        "volume": Key(
            _VOLUME, "volume to use for a polytrope through this point, where a document prints its own; or where it is"
        ),
    }
)

PIECE = Table({
    "law": Key(Choice(("constant", "polytropic", "rounded")), "what happens between the points", required=True),
    "points": Key(ListOf(Text(60), fewest=2), "names of the points, in the order of the crank angle", required=True),
    "exponent": Key(Number(0.0, 5.0), "polytropic exponent"),
    "reference": Key(Text(60), "the point whose pressure and volume the polytrope passes through, "
                               "by default the first"),
})  # fmt: skip

MEASURED = Table(
    {
        "file": Key(Text(1000), "CSV file with a column of crank angle and one of pressure", required=True),
        "angle_column": Key(Text(), "heading of the angle column; by default the first column"),
        "pressure_column": Key(Text(), "heading of the pressure column; by default the second column"),
        "angle_unit": Key(Choice(("deg", "rad")), "unit of the angles; by default deg"),
        "pressure_unit": Key(
            Choice(("MPa", "kPa", "Pa", "bar", "kgf/cm2", "psi")), "unit of the pressures", required=True
        ),
        "shift": Key(_ANGLE, "added to every angle, so that zero is top dead centre"),
        "resample": Key(
            Quantity(("angle",), math.radians(0.01), math.radians(30)), "step at which samples are resampled"
        ),
    }
)

_DIAGRAM = {
    "points": Key(Named(POINT), "named points of the indicator diagram"),
    "pieces": Key(ListOf(PIECE, fewest=1, most=500), "laws between the points, in the order of the crank angle"),
    "measured": Key(MEASURED, "measured pressure instead of points and pieces", instead_of=("points", "pieces")),
}

_GAS = Table(
    {
        "cycle": Key(Choice(("720 deg", "360 deg")), "crank angle of one working cycle", required=True),
        "pressures": Key(Choice(("gauge", "absolute")), "what the pressures count from; by default gauge"),
        "ambient": Key(
            Quantity(("pressure",), 0.0, 1e7), "absolute pressure on the crankcase side, for absolute pressures"
        ),
        "back_pressure": Key(_PRESSURE, "gauge pressure on the crank side of a double-acting piston"),
        **_DIAGRAM,
        "cylinders": Key(
            Named(Table(_DIAGRAM), most=28), "diagrams of cylinders that have their own, by their numbers"
        ),
        "motored": Key(
            NameOr(Table(_DIAGRAM)), 'diagram of the cylinders that misfire, or "ambient" where they stay open'
        ),
    }
)

METHOD = Table({
    "kinematics": Key(Text(20), "exact, textbook or series:N"),
    "rod": Key(Choice(("rigid", "two-mass")), "rigid rod, or two masses without the correction couple"),
    "pi": Key(Number(3.0, 3.2), "the value of pi that a document used, for example 3.14"),
    "gravity": Key(Quantity(("acceleration",), 0.0, 100.0), "acceleration of free fall"),
    "weights": Key(Flag(), "whether weights count; by default false"),
    "inertia_rod_ratio": Key(Number(1e-6, 1.0),
                             "another r/l for the inertia force alone, where a document mixes two"),
})  # fmt: skip

TABLE = Table(
    {
        "step": Key(Quantity(("angle",), math.radians(0.01), math.radians(180)), "step of the tables"),
        "special_angles": Key(ListOf(Quantity(("angle",), 0.0, 4 * math.pi + 1e-9)), "further angles of the tables"),
    }
)

_MACHINE = {
    "title": Key(Text(), "what the machine is called"),
    "decimal_mark": Key(Choice((".", ",")), 'put "," here to write 1,1 kg'),
    "crank": Key(_CRANK, "the crank", required=True),
    "rod": Key(_ROD, "the connecting rod", required=True),
    "piston": Key(_PISTON, "the piston"),
    "cylinder": Key(_CYLINDER, "the cylinder"),
    "gas": Key(_GAS, "the pressure in the cylinder", instead_of=("cycle",)),
    "cycle": Key(CYCLE, "a calculation of the working cycle, which gives that pressure", instead_of=("gas",)),
    "engine": Key(ENGINE, "the cylinders of an engine, like the one described"),
    "bearings": Key(BEARINGS, "sizes of its bearings"),
    "balance": Key(BALANCE, "counterweights and balance shafts"),
    "flywheel": Key(FLYWHEEL, "how evenly it shall run"),
    "method": Key(METHOD, "how to compute, and the constants of a document to reproduce"),
    "table": Key(TABLE, "the rows of the tables"),
}  # fmt: skip

MACHINE_FILE = Table(_MACHINE)


def _optional(table: Table, *names: str) -> Table:
    return Table({key: one._replace(required=one.required and key not in names) for key, one in table.keys.items()})


# where a wanted power gives bore and stroke
SIZED_FILE = Table(
    {
        **_MACHINE,
        "crank": _MACHINE["crank"]._replace(kind=_optional(_CRANK, "radius")),
        "cylinder": _MACHINE["cylinder"]._replace(kind=_optional(_CYLINDER, "bore")),
    }
)
