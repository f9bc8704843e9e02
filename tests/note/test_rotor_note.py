"""Notes of masses in planes of a shaft: their data, what is wanted of them, and symbols that tell one from another."""

from __future__ import annotations

import pytest

from crankwork.analysis import analyse
from crankwork.description.machine_file import read_machine, template
from crankwork.note.document import Equation, ItemList, Table
from crankwork.note.equations import printed_equation
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of


@pytest.fixture(scope="module")
def blocks():
    return note_of(analyse(read_machine(template("balancing"))), NoteOptions(language="en")).blocks


def _table(blocks, label):
    return next(block for block in blocks if isinstance(block, Table) and block.label == label)


def test_masses_stand_as_they_are_given_and_what_is_wanted_is_marked(blocks):
    assert [list(row) for row in _table(blocks, "t:masses").rows] == [
        ["left", "?", "–", "600", "?", "−750"],
        ["1", "150", "180", "300", "0", "−350"],
        ["2", "150", "180", "300", "90", "350"],
        ["right", "?", "–", "600", "?", "750"],
    ]
    values = {row[0]: row[2] for row in _table(blocks, "t:data").rows}
    assert values["rotational speed"] == "300"
    assert values["wheel diameter"] == "1800"


def test_symbols_of_a_mass_have_its_name_on_both_sides(blocks):
    texts = [printed_equation(block, "en").text for block in blocks if isinstance(block, Equation)]
    assert any("z_right − z_left" in text for text in texts)
    assert any(text.startswith("m_left = Q_left/r_left = ") for text in texts)
    assert any(text.startswith("θ_left = arctan(Q_y,left/Q_x,left) = ") for text in texts)
    assert any("C_Σ,x·ω²" in text or "C_Σ,x ω²" in text for text in texts), texts


def test_the_conclusion_tells_what_swings(blocks):
    items = next(block.items for block in blocks if isinstance(block, ItemList))
    told = ["".join(str(run) for run in runs) for runs in items]
    assert [text.partition(" ")[0] for text in told] == ["The", "Along", "The"]
    assert "−25.1\u00a0kN and 25.1\u00a0kN" in told[1]
