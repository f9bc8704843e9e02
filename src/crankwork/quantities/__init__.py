"""The one table of quantities: key, display unit, definition; name and symbol in each language are in `locale`.

Tables, figures, notes, the studio and the nomenclature page all read it.
"""

from __future__ import annotations

from crankwork.locale import LANGUAGES, Language
from crankwork.quantities import (
    balance,
    bearings,
    chambers,
    circuits,
    cycle,
    cylinders,
    driver,
    engine,
    linkage,
    machine,
    shaft,
)
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import Quantity

__all__ = ["LANGUAGES", "Language", "QUANTITIES", "Quantity", "SUBJECTS", "base_key", "subject"]

# by subject, as a reader wants them: the whole before one cylinder, and last what its cycle was calculated with
SUBJECTS = {
    "machine": machine, "linkage": linkage, "driver": driver, "chambers": chambers, "circuits": circuits,
    "cylinders": cylinders, "shaft": shaft, "bearings": bearings, "balance": balance, "engine": engine, "cycle": cycle,
}  # fmt: skip
QUANTITIES: dict[str, Quantity] = {row.key: row for room in SUBJECTS.values() for row in room.ROWS}
_SUBJECT = {row.key: name for name, room in SUBJECTS.items() for row in room.ROWS}


def base_key(key: str) -> str:
    """Return the key of the table row behind a derived key.

    `piston_velocity_max_angle` is derived from `piston_velocity`, and `joint_force_max.A` from `joint_force`.
    """
    key = key_of(key).quantity
    for suffix in ("_angle", "_time", "_max", "_min", "_error", "_difference"):
        if key not in QUANTITIES:
            key = key.removesuffix(suffix)
    return key


def subject(key: str) -> str:
    """Return the subject, of `SUBJECTS`, that a key of results belongs to: `piston_area.cycle` to the cycle."""
    owner = key_of(key).owner
    return owner if owner in SUBJECTS else _SUBJECT[base_key(key)]
