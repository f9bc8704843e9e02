"""The note of a torsional system: what it shows without being asked for everything."""

from crankwork.note.document import Figure, Paragraph, Table
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections
from machine_texts import analysed

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
