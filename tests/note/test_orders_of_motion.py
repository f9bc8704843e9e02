"""The first two orders of the motion print as textbooks have them, and each by its own symbols."""

from __future__ import annotations

from pathlib import Path

import pytest

import crankwork
from crankwork.note.contents import note_of
from crankwork.note.document import Equation
from crankwork.note.equations import printed_equation
from crankwork.note.options import NoteOptions

EXAMPLES = Path(__file__).parents[2] / "examples"
TEXTBOOK = {
    "piston_displacement_first_order": "x_I = r − r·cos φ = ",
    "piston_velocity_first_order": "v_I = r·ω·sin φ = ",
    "piston_acceleration_first_order": "a_I = r·ω²·cos φ = ",
    "piston_displacement_second_order": "x_II = (r·λ − r·λ·cos 2φ)/4 = ",
    "piston_velocity_second_order": "v_II = r·λ·ω/2·sin 2φ = ",
    "piston_acceleration_second_order": "a_II = r·λ·ω²·cos 2φ = ",
}


def _printed(example: str) -> dict[str, str]:
    results = crankwork.analyse(crankwork.read(EXAMPLES / f"{example}.toml"))
    blocks = [one for one in note_of(results, NoteOptions(figures=False)).blocks if isinstance(one, Equation)]
    return {getattr(one.step, "key", ""): printed_equation(one, "en").text for one in blocks}


@pytest.fixture(scope="module")
def textbook() -> dict[str, str]:
    return _printed("slider-crank")


@pytest.fixture(scope="module")
def exact() -> dict[str, str]:
    return _printed("v8-diesel")


@pytest.mark.parametrize("key", TEXTBOOK)
def test_orders_of_a_textbook_follow_from_the_crank_angle_in_one_formula(textbook, key):
    assert textbook[key].startswith(TEXTBOOK[key])


@pytest.mark.parametrize(("word", "mark"), [("first", "I"), ("second", "II")])
def test_an_order_follows_from_the_transfer_function_of_its_own_order(exact, word, mark):
    assert exact[f"piston_velocity_{word}_order"].startswith(f"v_{mark} = x′_{mark}·ω = ")
    assert exact[f"piston_acceleration_{word}_order"].startswith(f"a_{mark} = x″_{mark}·ω² = ")
