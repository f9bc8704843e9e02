"""The one table of quantities: key, display unit, definition; name and symbol in each language are in `locale`.

Its rows stand in `quantities.toml`. Tables, figures, notes, the studio and the nomenclature page all read it.
"""

from __future__ import annotations

import re

from crankwork.locale import LANGUAGES, Language
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import Quantity
from crankwork.resources import read_resource

__all__ = ["LANGUAGES", "Language", "QUANTITIES", "Quantity", "SUBJECTS", "base_key", "subject"]

# a subject, or a row of it; thirty times faster than a reader of any TOML
_LINE = re.compile(r'^\[(\w+)\]$|^(\w+) = \["(.*?)", "(.*?)"(?:, "(.*)")?\]$', re.MULTILINE)


def _read_subjects() -> dict[str, tuple[Quantity, ...]]:
    """Return the rows of the table by subject."""
    subjects: dict[str, list[Quantity]] = {}
    for name, *row in _LINE.findall(read_resource("quantities", "quantities.toml")):
        if name:
            rows = subjects[name] = []
        else:
            rows.append(Quantity(*row))
    return {name: tuple(rows) for name, rows in subjects.items()}


SUBJECTS = _read_subjects()
QUANTITIES: dict[str, Quantity] = {row.key: row for rows in SUBJECTS.values() for row in rows}
_SUBJECT = {row.key: name for name, rows in SUBJECTS.items() for row in rows}


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
