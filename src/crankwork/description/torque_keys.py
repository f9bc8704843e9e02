"""The keys of a machine file that describes a shaft by the torques on it."""

from __future__ import annotations

import math
from typing import get_args

from crankwork.description.cylinder_keys import FLYWHEEL
from crankwork.description.keys import METHOD, TABLE, TITLE, TURNING_DOCUMENT
from crankwork.description.load_keys import EFFICIENCY, MOTOR_SELECTION, SHEET
from crankwork.description.schema import KeySpec, ListOf, NumberOr, TableSpec
from crankwork.description.value_types import Choice, Number, Quantity, Text
from crankwork.shaft.torque_diagram import Shape

_TORQUE = Quantity(("torque",), -1e9, 1e9)
_SPEED = Quantity(("speed",), 1e-6, 3e4)
_ANGLE = Quantity(("angle",), 0.0, 1e5)
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
    "from": KeySpec(_ANGLE, default="0 deg"),
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
    "at": KeySpec(ListOf(_ANGLE, fewest=2, most=2000, from_file=True), only={"torque": ()}),
    "torque": KeySpec(ListOf(_TORQUE, 2, 2000, from_file=True), instead_of=_other("torque"), only={"at": ()}),
    "harmonics": KeySpec(ListOf(_HARMONIC, fewest=1, most=200), instead_of=_other("harmonics")),
    "strokes": KeySpec(ListOf(_STROKE, fewest=1, most=200), instead_of=_other("strokes")),
    "areas": KeySpec(ListOf(_ENERGY, fewest=2, most=1000, from_file=True), instead_of=_other("areas")),
    "excess_work": KeySpec(Quantity(("energy", "area"), 0.0, 1e12, above=True), instead_of=_other("excess_work")),
    "energy_fluctuation": KeySpec(Number(0.0, 1e3, above=True), instead_of=_other("energy_fluctuation")),
    "scale": KeySpec(_SCALE),
    "cylinders": KeySpec(Number(1, 48, whole=True), instead_of=("delays",)),
    "delays": KeySpec(ListOf(_ANGLE, fewest=1, most=48), instead_of=("cylinders",)),
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
