"""The note of a torsional system: what it shows without being asked for everything."""

import math
from pathlib import Path

from crankwork import analyse, load
from crankwork.note.document import Figure, ItemList, Paragraph, Table
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections
from machine_texts import analysed

EXAMPLES = Path(__file__).parents[2] / "examples"
FORCED = """
crank.speed = "300 rpm"
[torsion]
speeds = ["100 rpm", "600 rpm"]
discs.A = { inertia = "10 kg*m2", damping = "50 N*m*s/rad" }
discs.B.inertia = "4 kg*m2"
shafts.g = { between = ["ground", "A"], stiffness = "40 kN*m/rad" }
shafts.s = { between = ["A", "B"], stiffness = "20 kN*m/rad" }
torques = [{ disc = "B", torque = "100 N*m", order = 2 }]
"""


def test_it_has_figures_one_table_by_holzer_and_the_largest_vibration():
    made = note_of_sections(analysed(FORCED), NoteOptions(language="en"))
    figures = [block.name for block in made.blocks if isinstance(block, Figure)]
    assert figures == ["torsional_modes", "campbell", "torsional_response"]
    tables = {block.label: block.rows for block in made.blocks if isinstance(block, Table)}
    assert len(tables["holzer"]) == 2
    assert [row[1] for row in tables["torsional_nodes"]] == ["A – B"]
    assert [row[0] for row in tables["torsional_shafts"]] == ["g (ground – A)", "s (A – B)"]
    assert [row[1] for row in tables["torsional_vibration"]] == ["0.365", "0.3789", "–", "–"]
    said = [run for block in made.blocks if isinstance(block, Paragraph) for run in block.runs if isinstance(run, str)]
    assert " = 8.205° (B, 228.9\u00a0rpm)" in said
    assert not any("throw" in text for text in said)
    assert "critical speeds" in made.blocks[0].below[-1]


def test_the_lowest_frequency_has_its_digits_and_the_conclusion_tells_the_vibration():
    found = analyse(load(EXAMPLES / "vibrating-crankshaft.toml"))
    made = note_of_sections(found, NoteOptions(language="en", figures=False))
    tables = {block.label: block.rows for block in made.blocks if isinstance(block, Table)}
    assert tables["natural_modes"][0][1] == f"{found.summary['natural_frequency.1'] / (2 * math.pi):.2f}"
    # nodes of the modes that are drawn, of no others
    assert {row[0] for row in tables["torsional_nodes"]} == {"1", "2", "3", "4"}
    assert len(tables["holzer"][0]) == 7
    (items,) = [block.items for block in made.blocks if isinstance(block, ItemList)][-1:]
    told = " ".join(run for item in items for run in item if isinstance(run, str))
    assert all(part in told for part in ("30.48", "914.3", "crank 1"))


def test_main_results_stand_in_one_table():
    made = note_of_sections(analysed(FORCED), NoteOptions(language="en", figures=False))
    labels = [block.label for block in made.blocks if isinstance(block, Table)]
    assert labels.count("t:glance") == 1
    assert "t:summary" not in labels
