"""The keys of a machine file that describes a shaft by the torques on it."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.description import document_keys
from crankwork.description.engine_keys import FLYWHEEL
from crankwork.description.keys import METHOD, SHEET, TABLE, TITLE
from crankwork.description.kinds import Choice, Number, Quantity, Text
from crankwork.description.linkage_keys import EFFICIENCY
from crankwork.description.schema import Key, ListOf, NumberOr, Table
from crankwork.shaft.torque_diagram import Shape

_TORQUE = Quantity(("torque",), -1e9, 1e9)
_SPEED = Quantity(("speed",), 1e-6, 3e4)
_ANGLE = Quantity(("angle",), 0.0, 1e5)
_LENGTH = Key(Quantity(("length",), 1e-6, 100.0))
_ENERGY = Quantity(("energy", "area"), -1e12, 1e12)
_STRETCH = Quantity(("angle", "time"), 0.0, 1e5, above=True)

_HARMONIC = Table("harmonic", {
    "order": Key(Number(0.0, 1e3, above=True), required=True),
    "sin": Key(_TORQUE, default="0 N*m"),
    "cos": Key(_TORQUE, default="0 N*m"),
})  # fmt: skip

_BY_STRENGTH = {"shear_strength": ()}
_STROKE = Table("press_stroke", {
    "work": Key(_ENERGY, required=True, instead_of=("shear_energy", "shear_strength")),
    "shear_energy": Key(Quantity(("energy_per_area",), 0.0, 1e12, above=True), instead_of=("work", "shear_strength")),
    "shear_strength": Key(Quantity(("pressure",), 1.0, 1e11), instead_of=("work", "shear_energy")),
    "penetration": Key(Number(0.0, 1.0, above=True), required=True, only=_BY_STRENGTH),
    "punch_slope": Key(_LENGTH.kind, only=_BY_STRENGTH),
    "thickness": Key(_LENGTH.kind),
    "hole_diameter": Key(_LENGTH.kind, instead_of=("cut_width",), only={"thickness": ()}),
    "cut_width": Key(_LENGTH.kind, instead_of=("hole_diameter",), only={"thickness": ()}),
    "from": Key(_ANGLE, default="0 deg"),
    "over": Key(NumberOr(_STRETCH, Number(0.0, 1.0, above=True)), instead_of=("punch_stroke",)),
    "punch_stroke": Key(_LENGTH.kind, instead_of=("over",), only={"thickness": ()}),
    "shape": Key(Choice(get_args(Shape)), default="constant"),
    "peak": Key(Number(0.0, 1.0), default=0.5, only={"shape": ("triangle",)}),
})  # fmt: skip

_SCALE = Table("scale", {
    "torque": Key(Quantity(("torque_per_length",), 0.0, 1e15, above=True), instead_of=("work",)),
    "angle": Key(Quantity(("angle_per_length",), 0.0, 1e9, above=True), instead_of=("work",)),
    "work": Key(Quantity(("energy_per_area",), 0.0, 1e15, above=True), required=True, instead_of=("torque", "angle")),
})  # fmt: skip

FORMS = ("torque", "harmonics", "strokes", "areas", "excess_work", "energy_fluctuation")


def _other(*names: str) -> tuple[str, ...]:
    """Return the forms of a torque that are none of these."""
    return tuple(one for one in FORMS if one not in names)


_DIAGRAM = Table("torque_diagram", {
    "period": Key(Quantity(("angle", "time"), math.radians(1e-3), 1e5), instead_of=("rate",)),
    "rate": Key(Quantity(("speed",), 1e-6, 1e5), instead_of=("period",)),
    "constant": Key(_TORQUE, instead_of=("power", "at", "torque")),
    "power": Key(Quantity(("power",), -1e12, 1e12), instead_of=("constant", "at", "torque")),
    "file": Key(Text(1000)),
    "sheet": SHEET,
    "at": Key(ListOf(_ANGLE, fewest=2, most=2000, from_file=True), only={"torque": ()}),
    "torque": Key(ListOf(_TORQUE, fewest=2, most=2000, from_file=True), instead_of=_other("torque"), only={"at": ()}),
    "harmonics": Key(ListOf(_HARMONIC, fewest=1, most=200), instead_of=_other("harmonics")),
    "strokes": Key(ListOf(_STROKE, fewest=1, most=200), instead_of=_other("strokes")),
    "areas": Key(ListOf(_ENERGY, fewest=2, most=1000, from_file=True), instead_of=_other("areas")),
    "excess_work": Key(Quantity(("energy", "area"), 0.0, 1e12, above=True), instead_of=_other("excess_work")),
    "energy_fluctuation": Key(Number(0.0, 1e3, above=True), instead_of=_other("energy_fluctuation")),
    "scale": Key(_SCALE),
    "cylinders": Key(Number(1, 48, whole=True), instead_of=("delays",)),
    "delays": Key(ListOf(_ANGLE, fewest=1, most=48), instead_of=("cylinders",)),
})  # fmt: skip

TURNING_FILE = Table("file", {
    **TITLE,
    "document": document_keys.TURNING,
    "crank": Key(Table("turning_crank", {
        "speed": Key(_SPEED, instead_of=("largest_speed",)),
        "largest_speed": Key(_SPEED, instead_of=("speed",)),
        "inertia": Key(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2"),
    })),
    "torque": Key(_DIAGRAM, required=True),
    "load": Key(_DIAGRAM),
    "efficiency": Key(EFFICIENCY),
    "flywheel": Key(FLYWHEEL),
    "method": Key(METHOD),
    "table": Key(TABLE),
})  # fmt: skip

# a press, which a motor drives with the mean
PRESS_FILE = TURNING_FILE._replace(keys={
    **{name: key for name, key in TURNING_FILE.keys.items() if name != "torque"},
    "load": Key(_DIAGRAM, required=True),
})  # fmt: skip
