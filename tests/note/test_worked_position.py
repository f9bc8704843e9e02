"""A linkage is worked where its plans are drawn."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import crankwork
from crankwork.note.contents import note_of
from crankwork.note.document import Equation, Figure, ItemList, Paragraph, Reference
from crankwork.note.equations import printed_equation
from crankwork.note.numbering import numbering
from crankwork.note.options import NoteOptions
from crankwork.show.scene import Text

EXAMPLES = Path(__file__).parents[2] / "examples"
PLANS = ("velocity_plan", "acceleration_plan", "force_plans")


@pytest.mark.parametrize(
    ("name", "shown"), [("knuckle-press", 300.0), ("excavator-boom", None), ("press-geometry", 30.0)]
)
def test_a_note_is_worked_where_its_plans_are_drawn(name, shown):
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml"))
    blocks = note_of(results, NoteOptions()).blocks
    said = ["".join(map(str, one.runs)) for one in blocks if isinstance(one, Paragraph)]
    worked = {
        float(found[1]) for one in said if one.startswith("Worked at") and (found := re.search(r" = ([\d.]+)", one))
    }
    plans = [one.drawing for one in blocks if isinstance(one, Figure) and one.name in PLANS]
    texts = [item.text for one in plans for item in one.items if isinstance(item, Text)]
    drawn = [float(found[1]) for one in texts if (found := re.fullmatch(r"/\{[φt]\} = ([\d.]+)(?:°|\s*s)", one))]
    assert len(worked) == 1
    assert len(drawn) == len(plans) >= 2
    assert drawn == pytest.approx([*worked] * len(plans), rel=1e-3)
    assert shown is None or worked == {shown}


def test_names_of_joints_have_no_underscores_and_plans_the_letters_of_their_school():
    results = crankwork.analyse(crankwork.read(EXAMPLES / "knuckle-press.toml"))
    blocks = note_of(results, NoteOptions(language="ru")).blocks
    shown = [str(run) for one in blocks if isinstance(one, ItemList) for item in one.items for run in item]
    assert any(one.startswith("B upper: ") for one in shown)
    assert not [one for one in shown if "B_" in one]
    plan = next(one.drawing for one in blocks if isinstance(one, Figure) and one.name == "acceleration_plan")
    texts = [item.text for item in plan.items if isinstance(item, Text)]
    assert any("^{τ}" in one for one in texts)
    assert "точное решение" in texts


def test_figures_are_named_in_the_order_of_their_numbers():
    results = crankwork.analyse(crankwork.read(EXAMPLES / "knuckle-press.toml"))
    note = note_of(results, NoteOptions())
    numbers = numbering(note)
    named = [
        int(numbers.reference(run.label))
        for one in note.blocks
        if isinstance(one, Paragraph)
        for run in one.runs
        if isinstance(run, Reference) and run.label.startswith("figure:")
    ]
    assert len(named) > 10
    assert named == sorted(named)


def test_the_direction_of_gravity_is_not_that_of_a_link():
    results = crankwork.analyse(crankwork.read(EXAMPLES / "knuckle-press.toml"))
    told = results.explain("load_y.pitman.weight") if "load_y.pitman.weight" in results.memory else ""
    shown = [
        printed_equation(one, "en").text
        for one in note_of(results, NoteOptions(figures=False)).blocks
        if isinstance(one, Equation)
    ]
    weights = [one for one in [*shown, told] if "·g·" in one]
    assert weights
    assert all("cos θ_G" in one for one in weights)
