"""The one table of quantities: key, display unit, definition; name and symbol in each language are in `locale`.

Tables, figures, notes, the studio and the nomenclature page all read it.
"""

from __future__ import annotations

from crankwork.locale import LANGUAGES, Language
from crankwork.quantities import balance, bearings, chambers, circuits, cycle, cylinders, driver, engine, linkage, shaft
from crankwork.quantities.quantity import Quantity

__all__ = ["LANGUAGES", "Language", "QUANTITIES", "Quantity", "base_key"]

_ROOMS = (engine, cycle, cylinders, bearings, balance, linkage, shaft, driver, chambers, circuits)
QUANTITIES: dict[str, Quantity] = {row.key: row for room in _ROOMS for row in room.ROWS}


def base_key(key: str) -> str:
    """Return the key of the table row behind a derived key.

    `piston_velocity_max_angle` is derived from `piston_velocity`, and `joint_force_max.A` from `joint_force`.
    """
    key = key.partition(".")[0]
    for suffix in ("_angle", "_time", "_max", "_min", "_error", "_difference"):
        if key not in QUANTITIES:
            key = key.removesuffix(suffix)
    return key
