"""A column of a note is in the unit of its heading: the same note in three systems of units says the same."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.locale.numbers import unit_name
from crankwork.note.contents import note_of
from crankwork.note.document import Math, Table
from crankwork.note.options import NoteOptions
from crankwork.units import UNITS, to_si

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = {unit_name(one, "en"): one for one in UNITS}
POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")


def said(runs):
    return "".join(one.content if isinstance(one, Math) and isinstance(one.content, str) else str(one) for one in runs)


def number_of(text):
    if not isinstance(text, str):
        return np.nan
    found = re.fullmatch(r"([−-]?[\d.]+)(?:·10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+))?", text.replace("\u00a0", "").replace("\u202f", ""))
    if found is None:
        return np.nan
    return float(found[1].translate(POWERS)) * 10.0 ** int((found[2] or "0").translate(POWERS))


def columns_of(name, units, school):
    """Return the numbers of every column with a unit, in SI, with where it stands."""
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml", [f"units={units}"]))
    note = note_of(results, NoteOptions(language="en", school=school, figures=False))
    for place, table in enumerate(one for one in note.blocks if isinstance(one, Table)):
        for column, heading in enumerate(table.headings):
            unit = NAMES.get(said(heading).rpartition(", ")[2])
            if unit is not None:
                cells = [number_of(row[column]) for row in table.rows]
                yield (place, table.caption, column), to_si(np.array(cells), unit)


# engines with forces above 10 kN, linkages with free forces, a motion law, flywheels by all ways, torques by points
@pytest.mark.parametrize(
    ("name", "school"),
    [("v8-diesel", ""), ("v8-diesel", "vi"), ("atkinson", ""), ("excavator-boom", ""), ("press", ""),
     ("two-stroke", ""), ("punching-machine", ""), ("opposed-pistons", ""), ("knuckle-press", ""),
     ("double-acting-steam", "")],
)  # fmt: skip
def test_every_column_says_the_same_in_every_system_of_units(name, school):
    told = {units: dict(columns_of(name, units, school)) for units in ("si", "metric", "imperial")}
    assert told["si"].keys() == told["metric"].keys() == told["imperial"].keys()
    for place, si in told["si"].items():
        size = np.max(np.abs(si[np.isfinite(si)]), initial=0.0)
        for units in ("metric", "imperial"):
            # numbers of four digits in the least of the three
            np.testing.assert_allclose(told[units][place], si, rtol=0, atol=3e-3 * size, err_msg=f"{place}, {units}")
