"""The keys of a machine file that describes a linkage, or the transfer functions of one as a document prints them."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.description.keys import MEASURED, METHOD, PIECE, POINT, TABLE
from crankwork.description.schema import (
    Choice,
    Key,
    ListOf,
    Named,
    NameOr,
    Nested,
    Number,
    NumberOr,
    Quantity,
    Table,
    Text,
)  # fmt: skip
from crankwork.mechanism.driver import LawKind

_LENGTH = Quantity(("length",), 1e-6, 100.0)
_COORDINATE = Quantity(("length",), -1e3, 1e3)
_PLACE = ListOf(_COORDINATE, fewest=2, most=2)
_ANGLE = Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9)
_TURN = Quantity(("angle",), 0.0, 4 * math.pi + 1e-9)
_SPEED = Quantity(("speed",), 1e-6, 3e4)
_INERTIA = Quantity(("inertia",), 0.0, 1e9)
_TORQUE = Quantity(("torque",), -1e9, 1e9)
_FORCE = Quantity(("force",), -1e9, 1e9)
_NAME = Text(60)
_MASS = {
    "mass": Key(Quantity(("mass",), 1e-9, 1e6), "its mass"),
    "inertia": Key(_INERTIA, "moment of inertia about the centre of mass"),
    "centre": Key(NameOr(_PLACE), "centre of mass: a point of the link, or [along, across]"),
}

_CRANK = Table({
    "pivot": Key(_NAME, "the fixed point it turns about", required=True),
    "pin": Key(_NAME, "name of its moving end", required=True),
    "radius": Key(_LENGTH, "distance from pivot to pin", required=True),
    "speed": Key(_SPEED, "rotational speed", required=True),
    "angular_acceleration": Key(Quantity(("angular_acceleration",), -1e6, 1e6), "change of the angular speed"),
    "start": Key(_ANGLE, "its direction from the x axis at a crank angle of zero"),
    "direction": Key(Choice(("anticlockwise", "clockwise")), "which way it turns"),
    "points": Key(Named(_PLACE), "further points: from the pivot towards the pin, and to the left of that"),
    "inertia": Key(_INERTIA, "moment of inertia about its axis, all that turns with it included"),
    "mass": Key(Quantity(("mass",), 1e-9, 1e6), "its mass, which its pivot bears"),
    "centre": Key(NameOr(_PLACE), "centre of mass: a point of it, or [along, across] from the pivot; else the pivot"),
    "from": Key(_ANGLE, "of a crank that does not turn fully, from where largest values count"),
    "to": Key(_ANGLE, "of a crank that does not turn fully, up to where largest values count"),
})  # fmt: skip

_COORDINATE_OF_DRIVER = Quantity(("length", "angle"), -1e3, 1e3)
_TIME = Quantity(("time",), 1e-6, 1e6)

_SEGMENT = Table({
    "kind": Key(Choice(get_args(LawKind)), "how it moves", required=True),
    "to": Key(_COORDINATE_OF_DRIVER, "the coordinate at its end; that of the beginning for a dwell"),
    "over": Key(NumberOr(_TIME, Number(0.0, 1.0, above=True)), "its time, or its share of the period",
                required=True, instead_of=("speed",)),
    "speed": Key(Quantity(("velocity", "speed"), 0.0, 3e4, above=True), "rate of a constant one, in place of its time",
                 instead_of=("over",)),
    "ramp": Key(Number(0.0, 0.5, above=True), "of a trapezoidal velocity, the part that each ramp takes"),
    "at": Key(ListOf(Number(0.0, 1.0)), "of a table, shares of the segment, rising between 0 and 1"),
    "values": Key(ListOf(_COORDINATE_OF_DRIVER), "of a table, the coordinate there"),
})  # fmt: skip

_DRIVER = Table({
    "slider": Key(_NAME, "the sliding piece on a fixed guide that drives"),
    "cylinder": Key(ListOf(_NAME, fewest=2, most=2), "the two points that a driving cylinder joins"),
    "between": Key(ListOf(_NAME, fewest=2, most=2), "the two moving links that a motor in their pin turns"),
    "start": Key(_COORDINATE_OF_DRIVER, "its coordinate at the beginning; that of the end without"),
    "law": Key(ListOf(_SEGMENT, fewest=1, most=100), "how its coordinate changes, segment by segment", required=True),
    "period": Key(_TIME, "time of the whole law, where segments are shares of it"),
})  # fmt: skip

_GEARED = Table({
    "pivot": Key(_NAME, "the fixed point it turns about", required=True),
    "ratio": Key(Number(-1e3, 1e3), "its speed over that of the crank, negative the other way round", required=True),
    "start": Key(_ANGLE, "direction of its x axis at a crank angle of zero"),
    "points": Key(Named(_PLACE), "its points: along its x axis, and to the left of that", required=True),
    "inertia": Key(_INERTIA, "moment of inertia about its axis"),
    "mass": Key(Quantity(("mass",), 1e-9, 1e6), "its mass, which its pivot bears"),
    "centre": Key(NameOr(_PLACE), "centre of mass: a point of it, or [along, across] from the pivot; else the pivot"),
})  # fmt: skip

_LINK = Table({
    "joins": Key(ListOf(_NAME, fewest=2), "names of its joints; its frame runs from the first to the second",
                 required=True),
    "length": Key(_LENGTH, "distance of the first two joints; may follow from positions"),
    "points": Key(Named(_PLACE), "further points of the link: [along, across] its frame"),
    "share": Key(Number(-1e3, 1e3), "of a link too many that fits, the force along it over that along the link `of`"),
    "of": Key(_NAME, "the link with which a link too many shares what they bear"),
    **_MASS,
})  # fmt: skip

_SLIDER = Table({
    "guide": Key(_NAME, "the guide it slides on", required=True),
    "pin": Key(_NAME, "its joint on the line of the guide"),
    "points": Key(Named(_PLACE), "further points: along and across the guide"),
    **_MASS,
})  # fmt: skip

_GUIDE = Table(
    {
        "through": Key(NameOr(_PLACE), "a fixed point, or [x, y]; in the frame of the link that carries it"),
        "angle": Key(_ANGLE, "direction in which distances count"),
        "link": Key(_NAME, "the link that carries it; fixed without"),
    }
)

_LOAD = Table({
    "kind": Key(Choice(("process", "force", "torque", "spring")), "what pushes", required=True),
    "slider": Key(_NAME, "the sliding piece it acts on"),
    "point": Key(_NAME, "the point it acts at"),
    "link": Key(_NAME, "the link it acts on"),
    "between": Key(ListOf(_NAME, fewest=2, most=2), "the two points a spring joins"),
    "x": Key(_FORCE, "component of a force"),
    "y": Key(_FORCE, "component of a force"),
    "against": Key(Choice(("stroke", "angle")), "what a table counts by; by default the stroke"),
    "at": Key(ListOf(Quantity(("length", "angle"), -1e3, 1e3), fewest=2), "strokes or crank angles of a table, rising"),
    "force": Key(ListOf(_FORCE, fewest=1), "forces of the table, positive against the working stroke"),
    "torque": Key(ListOf(_TORQUE, fewest=1), "torques of the table, positive anticlockwise"),
    "curve": Key(Choice(("straight", "smooth")), "between the points of the table"),
    "stroke": Key(Choice(("growing", "falling")), "whether the distance along the guide grows on the working stroke"),
    "start": Key(_COORDINATE, "distance along the guide where the working stroke begins; by default its end position"),
    "acts": Key(Choice(("forward", "both")), "on the working stroke only, or on the way back too"),
    "stiffness": Key(Quantity(("stiffness",), 0.0, 1e12), "of a spring"),
    "free_length": Key(Quantity(("length",), 0.0, 1e3), "length of a spring that does not pull, or its position"),
    "preload": Key(_FORCE, "pull of a spring at its free length"),
})  # fmt: skip

_EFFICIENCY = Table({
    "chain": Key(Nested(Number(0.001, 1.0)), "efficiencies in series; a list within is in parallel",
                 required=True),
    "decimals": Key(Number(1, 6, whole=True), "round the whole to so many decimals, as a document does"),
})  # fmt: skip

_MOTOR = Table(
    {
        "rated_power": Key(Quantity(("power",), 1e-3, 1e9), "power on its shaft", required=True),
        "rated_speed": Key(_SPEED, "speed at that power", required=True),
        "overload": Key(Number(1.01, 10.0), "greatest torque over rated torque", required=True),
        "pole_pairs": Key(Number(1, 24, whole=True), "pairs of poles", required=True),
        "frequency": Key(_SPEED, "of the mains, by default 50 Hz"),
        "ratio": Key(Number(1e-4, 1e4), "speed of the motor over that of the crank"),
        "inertia": Key(_INERTIA, "moment of inertia of its rotor"),
    }
)

_FLYWHEEL = Table(
    {
        "fluctuation": Key(Number(1e-6, 1.0), "wanted: largest less least speed over the mean", required=True),
    }
)

_TRANSIENT = Table(
    {
        "torque": Key(_TORQUE, "constant torque on the crank", required=True),
        "time": Key(Quantity(("time",), 1e-6, 1e6), "how long", required=True),
        "speed": Key(Quantity(("speed",), 0.0, 3e4), "speed of the crank at the start, at rest without"),
    }
)

_PRESSURE = Quantity(("pressure",), -1e8, 1e10)
_ABSOLUTE = Quantity(("pressure",), 1.0, 1e10)
_TEMPERATURE = Quantity(("temperature",), 1.0, 1e4)
_FACE = {
    "slider": Key(_NAME, "the sliding piece that is its wall"),
    "bore": Key(_LENGTH, "diameter of the face", instead_of=("area",)),
    "rod_diameter": Key(_LENGTH, "of a piston rod that takes its area from the bore"),
    "area": Key(Quantity(("area",), 1e-12, 1e4), "area of the face", instead_of=("bore",)),
    "sense": Key(Choice((1, -1)), "1 if the volume grows as the piece moves along its guide, -1 if it shrinks"),
}
_OF_FACE = tuple(_FACE)

_CHAMBER = Table({
    **_FACE,
    "faces": Key(ListOf(Table(_FACE), fewest=1, most=20), "its walls, where it has more than one", instead_of=_OF_FACE),
    "clearance_volume": Key(Quantity(("volume",), 0.0, 1e3), "its least volume", instead_of=("compression_ratio",)),
    "compression_ratio": Key(Number(1.0001, 1e4), "largest over least volume", instead_of=("clearance_volume",)),
    "period": Key(Choice(("360 deg", "720 deg")), "crank angle after which its pressure repeats; by default 360 deg"),
    "pressures": Key(Choice(("gauge", "absolute")), "what the pressures count from; by default gauge"),
    "ambient": Key(Quantity(("pressure",), 0.0, 1e10), "absolute pressure on the other side, for absolute pressures"),
    "pressure": Key(_PRESSURE, "a pressure that does not change", instead_of=("points", "pieces", "measured")),
    "points": Key(Named(POINT), "named points of its indicator diagram"),
    "pieces": Key(ListOf(PIECE, fewest=1, most=500), "laws between the points, in the order of the crank angle"),
    "measured": Key(MEASURED, "measured pressure instead of points and pieces", instead_of=("points", "pieces")),
    "temperature": Key(_TEMPERATURE, "absolute temperature of a sealed charge while it is here"),
})  # fmt: skip

_DEAD_VOLUME = Table({
    "volume": Key(Quantity(("volume",), 1e-15, 1e3), "its volume", required=True),
    "temperature": Key(_TEMPERATURE, "absolute temperature of the gas in it"),
})  # fmt: skip

_CHARGE = Table({
    "chambers": Key(ListOf(_NAME, fewest=1, most=20), "the chambers that it is sealed in", required=True),
    "dead_volumes": Key(ListOf(_DEAD_VOLUME, most=50), "volumes between them: exchangers, a regenerator"),
    "gas_constant": Key(Quantity(("specific_heat",), 1.0, 1e5), "its specific gas constant"),
    "exponent": Key(Number(0.0, 5.0), "of a polytrope that all of it follows; without one temperatures stay"),
    "mean_pressure": Key(_ABSOLUTE, "absolute, mean over the crank angle", instead_of=("pressure", "mass")),
    "pressure": Key(_ABSOLUTE, "absolute, at a crank angle", instead_of=("mean_pressure", "mass")),
    "angle": Key(_TURN, "that crank angle; by default zero"),
    "mass": Key(Quantity(("mass",), 1e-12, 1e6), "its mass", instead_of=("mean_pressure", "pressure")),
})  # fmt: skip

_TITLE = {"title": Key(Text(), "what the machine is called"),
          "decimal_mark": Key(Choice((".", ",")), 'put "," here to write 1,1 kg')}  # fmt: skip

LINKAGE_FILE = Table(
    {
        **_TITLE,
        "fixed_points": Key(Named(_PLACE), "pivots of the ground: [x, y]"),
        "crank": Key(_CRANK, "the driving link", required=True),
        "geared": Key(Named(_GEARED, most=50), "cranks that gears turn with the driving one, by name"),
        "links": Key(Named(_LINK, most=500), "links by name"),
        "guides": Key(Named(_GUIDE), "straight guides by name"),
        "sliders": Key(Named(_SLIDER, most=300), "sliding pieces by name"),
        "branch": Key(Named(Choice((1, -1))), "which way a group is assembled, 1 or -1, by the joint that it places"),
        "positions": Key(Named(_PLACE), "roughly where joints are at a crank angle of zero"),
        "loads": Key(ListOf(_LOAD), "what pushes the linkage"),
        "chambers": Key(Named(_CHAMBER, most=50), "gas between sliding pieces, by name"),
        "charges": Key(Named(_CHARGE, most=20), "gas that is sealed in chambers, by name"),
        "efficiency": Key(_EFFICIENCY, "of the joints between motor and process"),
        "motor": Key(_MOTOR, "an asynchronous motor on the crank"),
        "flywheel": Key(_FLYWHEEL, "a flywheel on the crank, to be found"),
        "transient": Key(_TRANSIENT, "motion from a crank angle of zero under a constant torque and the springs"),
        "method": Key(METHOD, "how to compute, and the constants of a document to reproduce"),
        "table": Key(TABLE, "the rows of the tables"),
    }
)

# a crank that follows a law has no speed of its own, and other drivers have no crank
DRIVEN_FILE = Table({
    **LINKAGE_FILE.keys,
    "crank": Key(Table({name: key._replace(required=False) for name, key in _CRANK.keys.items()}), "the driving link"),
    "driver": Key(_DRIVER, "what drives, and the law by which it moves", required=True),
    "table": Key(Table({"step": Key(_TIME, "step of the tables")}), "the rows of the tables"),
})  # fmt: skip

_RATIOS = ListOf(Number(-1e3, 1e3), fewest=2)
_BODY = Table(
    {
        "mass": Key(Quantity(("mass",), 0.0, 1e6), "its mass"),
        "inertia": Key(_INERTIA, "moment of inertia about the point whose velocity is given"),
        "velocity": Key(ListOf(_COORDINATE, fewest=2), "velocity over the angular speed of the crank, by position"),
        "rotation": Key(_RATIOS, "angular velocity over that of the crank, by position"),
    }
)
_TRANSFER = Table({
    "angles": Key(ListOf(_TURN, fewest=2), "crank angles of the positions", required=True),
    "bodies": Key(Named(_BODY), "moving masses by name", required=True),
    "reduced_inertia_1": Key(ListOf(Quantity(("inertia",), -1e9, 1e9), fewest=2),
                             "derivative of the reduced inertia, where a document prints its own",
                             instead_of=("differences",)),
    "differences": Key(Choice(("forward", "central", "spectral")), "how the derivative is taken from the positions",
                       instead_of=("reduced_inertia_1",)),
    "static_torque": Key(ListOf(_TORQUE, fewest=2), "torque that balances the loads, by position",
                         instead_of=("balancing_torque",)),
    "balancing_torque": Key(ListOf(_TORQUE, fewest=2), "static and dynamic torque together, by position",
                            instead_of=("static_torque",)),
})  # fmt: skip

TRANSFER_FILE = Table(
    {
        **_TITLE,
        "crank": Key(
            Table({"speed": Key(_SPEED, "rotational speed", required=True)}), "the driving link", required=True
        ),
        "transfer": Key(_TRANSFER, "transfer functions as numbers", required=True),
        "efficiency": Key(_EFFICIENCY, "of the joints between motor and process"),
        "method": Key(METHOD, "the constants of a document to reproduce"),
    }
)
