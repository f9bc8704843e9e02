"""The keys of what acts on a machine except gas, of friction, and of what drives it: of linkages and of engines."""

from __future__ import annotations

import math

from crankwork.description.schema import KeySpec, ListOf, MapOf, Nested, NumberOr, TableSpec
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Text

LENGTH = Quantity(("length",), 1e-6, 100.0)
COORDINATE = Quantity(("length",), -1e3, 1e3)
SPEED = Quantity(("speed",), 1e-6, 3e4)
TORQUE = Quantity(("torque",), -1e9, 1e9)
NAME = Text(60)
TIME = Quantity(("time",), 1e-6, 1e6)
NO_ANGLE = KeySpec(Quantity(("angle",), -4 * math.pi - 1e-9, 4 * math.pi + 1e-9), default="0 deg")
INERTIA = KeySpec(Quantity(("inertia",), 0.0, 1e9), default="0 kg*m2")
SHEET = KeySpec(Text(), only={"file": ()})
_FORCE = Quantity(("force",), -1e9, 1e9)

_PROCESS, _PUSH, _TURNS, _SPRING, _DAMPER = (
    {"kind": (kind,)} for kind in ("process", "force", "torque", "spring", "damper")
)
_BY_COLUMN, _BETWEEN = {"kind": ("process", "torque")}, {"kind": ("spring", "damper")}
_LOAD = TableSpec("load", {
    "kind": KeySpec(Choice(("process", "force", "torque", "spring", "damper")), required=True),
    "slider": KeySpec(NAME, required=("process",), only={"kind": ("process", "spring", "damper")}),
    "point": KeySpec(NAME, required=True, only=_PUSH),
    "link": KeySpec(NAME, required=("torque",), only={"kind": ("force", "torque")}),
    "between": KeySpec(ListOf(NAME, fewest=2, most=2), only=_BETWEEN),
    "links": KeySpec(ListOf(NAME, fewest=2, most=2), only={"between": ()}),
    "x": KeySpec(_FORCE, default="0 N", only=_PUSH),
    "y": KeySpec(_FORCE, default="0 N", only=_PUSH),
    "against": KeySpec(Choice(("stroke", "angle")), default="stroke", only=_PROCESS),
    "file": KeySpec(Text(1000), only=_BY_COLUMN),
    "sheet": SHEET,
    "at": KeySpec(ListOf(NumberOr(Quantity(("length", "angle"), -1e3, 1e3), Number(0.0, 1.0)), 2, from_file=True),
              only=_BY_COLUMN),
    "force": KeySpec(ListOf(_FORCE, fewest=1, from_file=True), required=True, only=_PROCESS),
    "torque": KeySpec(ListOf(TORQUE, fewest=1, from_file=True), required=True, only=_TURNS),
    "curve": KeySpec(Choice(("straight", "smooth")), default="straight", only=_BY_COLUMN),
    "stroke": KeySpec(Choice(("growing", "falling")), default="growing", only=_PROCESS),
    "start": KeySpec(COORDINATE, only=_PROCESS),
    "acts": KeySpec(Choice(("forward", "both")), default="forward", only=_PROCESS),
    "stiffness": KeySpec(Quantity(("stiffness",), 0.0, 1e12), required=True, only=_SPRING),
    "free_length": KeySpec(Quantity(("length",), 0.0, 1e3), default="0 mm", only=_SPRING),
    "preload": KeySpec(_FORCE, default="0 N", only=_SPRING),
    "damping": KeySpec(Quantity(("damping",), 0.0, 1e12), required=True, only=_DAMPER),
})  # fmt: skip

_COEFFICIENT = KeySpec(Number(0.0, 1.0, message_kind="coefficient"), default=0.0)
_PIN_FRICTION = TableSpec("rubbing", {
    "coefficient": _COEFFICIENT,
    "radius": KeySpec(Quantity(("length",), 0.0, 10.0), required=True, only={"coefficient": ()}),
    "moment": KeySpec(Quantity(("torque",), 0.0, 1e9), default="0 N*m"),
    "damping": KeySpec(Quantity(("angular_damping",), 0.0, 1e9), default="0 N*m*s/rad"),
})  # fmt: skip
_SLIDER_FRICTION = TableSpec("rubbing_slider", {
    "coefficient": _COEFFICIENT,
    "length": KeySpec(LENGTH, only={"coefficient": ()}),
    "force": KeySpec(Quantity(("force",), 0.0, 1e9), default="0 N"),
    "damping": KeySpec(Quantity(("damping",), 0.0, 1e12), default="0 N*s/m"),
})  # fmt: skip
_FRICTION = TableSpec("friction", {
    "circle": KeySpec(Choice(("tangent", "sine")), default="tangent"),
    "pins": KeySpec(MapOf(_PIN_FRICTION, most=500)),
    "sliders": KeySpec(MapOf(_SLIDER_FRICTION, most=300)),
})  # fmt: skip

EFFICIENCY = TableSpec("efficiency", {
    "chain": KeySpec(Nested(Number(0.001, 1.0)), required=True, example="[0.95, 0.9]"),
    "decimals": KeySpec(Number(1, 6, whole=True)),
    "losses": KeySpec(Choice(("drive", "machine"))),
})  # fmt: skip

_MAINS = KeySpec(Quantity(("frequency", "speed"), 1e-6, 3e4), default="50 Hz")
MOTOR_SELECTION = KeySpec(TableSpec("motor_selection", {
    "reserve": KeySpec(Number(1.0, 10.0), default=1.0),
    "slip": KeySpec(Number(0.0, 0.5), default=0.04),
    "frequency": _MAINS,
}))  # fmt: skip
_MOTOR = TableSpec("motor", {
    "rated_power": KeySpec(Quantity(("power",), 1e-3, 1e9), required=True),
    "rated_speed": KeySpec(SPEED, required=True),
    "overload": KeySpec(Number(1.01, 10.0), required=True),
    "pole_pairs": KeySpec(Number(1, 24, whole=True), required=True),
    "frequency": _MAINS,
    "ratio": KeySpec(Number(1e-4, 1e4), default=1.0),
    "inertia": INERTIA,
})  # fmt: skip

_ANY_SPEED = Quantity(("speed",), -3e4, 3e4)
_ANY_ANGLE = Quantity(("angle",), -1e4, 1e4)
_TRANSIENT = TableSpec("transient", {
    "time": KeySpec(TIME, required=True),
    "torque": KeySpec(TORQUE),
    "motor": KeySpec(Flag()),
    "start": NO_ANGLE,
    "speed": KeySpec(_ANY_SPEED, default="0 rpm"),
    "until": KeySpec(Choice(("time", "rest", "steady")), default="time"),
    "step": KeySpec(TIME),
    "speeds": KeySpec(ListOf(_ANY_SPEED, most=20)),
    "stops": KeySpec(ListOf(_ANY_ANGLE, fewest=2, most=2)),
    "restitution": KeySpec(Number(0.0, 1.0), default=0.0, only={"stops": ()}),
})  # fmt: skip


def with_defaults(keys: TableSpec, name: str, table: TableSpec, **defaults: object) -> TableSpec:
    """Return the keys of a file in which keys of one of its tables have other defaults and need not be stated."""
    own = {key: table.keys[key]._replace(required=False, default=default) for key, default in defaults.items()}
    table = table._replace(keys={**table.keys, **own})
    entry = KeySpec(table, required=any(key.required for key in table.keys.values()))
    return keys._replace(keys={**keys.keys, name: entry})


# keys of a machine that are not about its mechanism or its gas
LOADING = {
    "loads": KeySpec(ListOf(_LOAD)),
    "friction": KeySpec(_FRICTION),
    "efficiency": KeySpec(EFFICIENCY),
    "motor": KeySpec(_MOTOR, instead_of=("motor_selection",)),
    "motor_selection": MOTOR_SELECTION._replace(instead_of=("motor",)),
    "transient": KeySpec(_TRANSIENT),
}
