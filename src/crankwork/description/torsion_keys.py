"""The keys of the table of a machine file about torsional vibration."""

from __future__ import annotations

import math

from crankwork.description.schema import KeySpec, ListOf, MapOf, TableSpec
from crankwork.description.value_types import Choice, Number, Quantity, Text
from crankwork.shaft.torsion_formulas import THROW_FORMULAS

_NAME = Text(60)
_PAIR = KeySpec(ListOf(_NAME, fewest=2, most=2), required=True)
_LENGTH = Quantity(("length",), 1e-6, 1e5)
_BORE = KeySpec(Quantity(("length",), 0.0, 100.0), default="0 mm")
_INERTIA = Quantity(("inertia",), 0.0, 1e12)
_STIFFNESS = Quantity(("torsional_stiffness",), 1e-9, 1e15)
_DAMPING = Quantity(("angular_damping",), 0.0, 1e12)
_MODULUS = Quantity(("pressure",), 1e3, 1e13)
_FREQUENCY = Quantity(("frequency", "speed"), 1e-9, 1e6)
_SIZE = KeySpec(Quantity(("length",), 1e-6, 10.0), required=True)

_DISC = TableSpec("disc", {
    "inertia": KeySpec(_INERTIA, required=True, instead_of=("mass",)),
    "mass": KeySpec(Quantity(("mass",), 0.0, 1e9), instead_of=("inertia",)),
    "radius_of_gyration": KeySpec(Quantity(("length",), 1e-6, 100.0), required=True, only={"mass": ()}),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
})  # fmt: skip

_PART = TableSpec("shaft_part", {
    "length": KeySpec(_LENGTH, required=True),
    "diameter": KeySpec(_SIZE.kind, required=True),
    "bore": _BORE,
})  # fmt: skip

_THROW = TableSpec("throw", {
    "formula": KeySpec(Choice(tuple(THROW_FORMULAS)), default="ker-wilson"),
    "journal_length": _SIZE,
    "journal_diameter": _SIZE,
    "journal_bore": _BORE,
    "pin_length": _SIZE,
    "pin_diameter": _SIZE,
    "pin_bore": _BORE,
    "web_thickness": _SIZE,
    "web_width": _SIZE,
    "radius": KeySpec(_SIZE.kind),
})  # fmt: skip

_FORMS = ("stiffness", "length", "parts", "throw")


def _instead(name: str) -> tuple[str, ...]:
    return tuple(form for form in _FORMS if form != name)


_OF_SHAFT = {
    "stiffness": KeySpec(_STIFFNESS, required=True, instead_of=_instead("stiffness")),
    "length": KeySpec(_LENGTH, instead_of=_instead("length"), only={"diameter": ()}),
    "diameter": KeySpec(_SIZE.kind, instead_of=("parts",)),
    "bore": _BORE._replace(only={"diameter": ()}),
    "parts": KeySpec(ListOf(_PART, fewest=1, most=50), instead_of=(*_instead("parts"), "diameter")),
    "throw": KeySpec(_THROW, instead_of=_instead("throw")),
    "modulus": KeySpec(_MODULUS),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
    "loss_factor": KeySpec(Number(0.0, 2.0), default=0.0),
}

_SHAFT = TableSpec("elastic_shaft", {
    "between": _PAIR,
    **_OF_SHAFT,
    "density": KeySpec(Quantity(("density",), 1.0, 1e5), only={"length": ()}),
    "elements": KeySpec(Number(1, 200, whole=True), only={"density": ()}),
})  # fmt: skip

_GEAR = TableSpec("gear_pair", {
    "between": _PAIR,
    "ratio": KeySpec(Number(-1e4, 1e4), required=True, instead_of=("teeth",)),
    "teeth": KeySpec(ListOf(Number(1, 1e5, whole=True), fewest=2, most=2), instead_of=("ratio",)),
})  # fmt: skip

_DAMPER = TableSpec("damper", {
    "on": KeySpec(_NAME, required=True),
    "inertia": KeySpec(_INERTIA._replace(low=1e-15), required=True),
    "damping": KeySpec(_DAMPING, default="0 N*m*s/rad"),
    "stiffness": KeySpec(_STIFFNESS),
    "mode": KeySpec(Number(1, 50, whole=True), default=1),
})  # fmt: skip

_EXCITATION = TableSpec("exciting_torque", {
    "disc": KeySpec(_NAME, required=True),
    "torque": KeySpec(Quantity(("torque",), -1e12, 1e12), required=True),
    "order": KeySpec(Number(0.0, 1e3, above=True), required=True, instead_of=("frequency",)),
    "frequency": KeySpec(_FREQUENCY, instead_of=("order",)),
    "phase": KeySpec(Quantity(("angle",), -4 * math.pi, 4 * math.pi), default="0 deg"),
})  # fmt: skip

_COMMON = {
    "discs": KeySpec(MapOf(_DISC, most=200)),
    "shafts": KeySpec(MapOf(_SHAFT, most=200)),
    "gears": KeySpec(MapOf(_GEAR, most=50)),
    "dampers": KeySpec(MapOf(_DAMPER, most=20)),
    "torques": KeySpec(ListOf(_EXCITATION, most=200)),
    "modulus": KeySpec(_MODULUS, default="80 GPa"),
    "reference_diameter": KeySpec(_SIZE.kind),
    "trials": KeySpec(ListOf(_FREQUENCY, most=20)),
    "speeds": KeySpec(ListOf(Quantity(("speed",), 1e-6, 3e4), fewest=2, most=2)),
    "orders": KeySpec(Number(0.5, 48.0), default=12.0),
    "modes": KeySpec(Number(1, 50, whole=True), default=10),
}

# of discs and shafts alone, and of a machine with a crankshaft
TORSION = KeySpec(TableSpec("torsion", _COMMON), required=True)
CRANKSHAFT_TORSION = KeySpec(TableSpec("torsion", {
    **_COMMON,
    "throw_shaft": KeySpec(TableSpec("elastic_shaft", _OF_SHAFT)),
    "throw_inertia": KeySpec(_INERTIA, default="0 kg*m2"),
}))  # fmt: skip
