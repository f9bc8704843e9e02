"""A linkage is worked where its plans are drawn; a column of its note is in the unit of its heading."""

from __future__ import annotations

import re

import numpy as np
import pytest

import crankwork
from crankwork.locale.numbers import unit_name
from crankwork.note.document import Equation, Figure, ItemList, Math, Paragraph, Reference, Table
from crankwork.note.numbering import numbering
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.units import UNITS, to_si
from each import failing
from note.built import EXAMPLES
from notes import blocks, note, printed, texts

PLANS = ("velocity_plan", "acceleration_plan", "force_plans")
NAMES = {unit_name(one, "en"): one for one in UNITS}
POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("press-geometry", 30.0),
        pytest.param("knuckle-press", 300.0, marks=pytest.mark.slow),
        pytest.param("excavator-boom", None, marks=pytest.mark.slow),
    ],
)
def test_a_note_is_worked_where_its_plans_are_drawn(name, shown):
    one = note(name, "en", figures=True)
    said = ["".join(map(str, block.runs)) for block in blocks(one, Paragraph)]
    found = [re.search(r" = ([\d.]+)", text) for text in said if text.startswith("Worked at")]
    worked = {float(one[1]) for one in found if one}
    plans = [block.drawing for block in blocks(one, Figure) if block.name in PLANS]
    found = [re.fullmatch(r"/\{[φt]\} = ([\d.]+)(?:°|\s*s)", item.text) for plan in plans for item in texts(plan)]
    drawn = [float(one[1]) for one in found if one]
    assert len(worked) == 1
    assert len(drawn) == len(plans) >= 2
    assert drawn == pytest.approx([*worked] * len(plans), rel=1e-3)
    assert shown is None or worked == {shown}


@pytest.mark.slow
def test_names_of_joints_have_no_underscores_and_plans_the_letters_of_their_school():
    one = note("knuckle-press", "ru", figures=True)
    shown = [str(run) for block in blocks(one, ItemList) for item in block.items for run in item]
    assert any(text.startswith("B 3: ") for text in shown)
    assert [text for text in shown if "B_" in text] == []
    assert any("^τ" in block.printed.text for block in blocks(one, Equation) if block.printed)


def test_figures_are_named_in_the_order_of_their_numbers():
    one = note("press-geometry", "en", figures=True)
    labels = [run.label for block in blocks(one, Paragraph) for run in block.runs if isinstance(run, Reference)]
    named = [int(numbering(one).reference(label)) for label in labels if label.startswith("f:")]
    assert len(named) > 10
    assert named == sorted(named)


@pytest.mark.slow
def test_the_direction_of_gravity_is_not_that_of_a_link():
    weights = [text for text in printed(note("knuckle-press", "en", figures=True)) if "·g·" in text]
    assert weights
    assert [text for text in weights if "cos θ_G" not in text] == []


# --- units of columns


def number_of(text: object) -> float:
    shown = text.replace("\u00a0", "").replace("\u202f", "") if isinstance(text, str) else ""
    found = re.fullmatch(r"([−-]?[\d.]+)(?:·10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+))?", shown)
    return float(found[1].translate(POWERS)) * 10.0 ** int((found[2] or "0").translate(POWERS)) if found else np.nan


def columns_of(name: str, units: str, school: str):
    """Yield the numbers of every column with a unit, in SI, with where it stands."""
    found = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml", [f"units={units}"]))
    one = note_of(found, NoteOptions(full=True, language="en", school=school, figures=False))
    for place, table in enumerate(blocks(one, Table)):
        for column, heading in enumerate(table.headings):
            said = "".join(run.content if isinstance(run, Math) else run for run in heading)
            if (unit := NAMES.get(said.rpartition(", ")[2])) is not None:
                cells = [number_of(row[column]) for row in table.rows]
                yield (place, table.caption, column), to_si(np.array(cells), unit)


def columns_agree(machine: tuple[str, str]) -> None:
    name, school = machine
    told = {units: dict(columns_of(name, units, school)) for units in ("si", "metric", "imperial")}
    assert told["si"].keys() == told["metric"].keys() == told["imperial"].keys()
    for place, si in told["si"].items():
        size = np.max(np.abs(si[np.isfinite(si)]), initial=0.0)
        for units in ("metric", "imperial"):
            # numbers of four digits in the least of the three
            np.testing.assert_allclose(told[units][place], si, rtol=0, atol=3e-3 * size, err_msg=f"{place}, {units}")


# engines with forces above 10 kN, linkages with free forces, a motion law, flywheels by all ways, torques by points
@pytest.mark.parametrize(
    "machines",
    [
        ["press", "punching-machine", "spark-engine vi"],
        pytest.param(
            ["v8-diesel vi", "excavator-boom", "opposed-pistons", "double-acting-steam"],
            marks=pytest.mark.slow,
        ),
    ],
    ids=["some", "more"],
)
def test_every_column_says_the_same_in_every_system_of_units(machines):
    assert failing({one: one.partition(" ")[::2] for one in machines}, columns_agree) == {}
