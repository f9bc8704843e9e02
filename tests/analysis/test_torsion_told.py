"""What is refused and told of torsional systems: discs apart, nodes in discs, dampers of modes that there are not."""

import pytest

from crankwork.errors import InputError
from each import for_each
from machine_texts import analysed

FREE = """[torsion]
discs.A.inertia = "1 kg*m2"
discs.B.inertia = "2 kg*m2"
discs.C.inertia = "1 kg*m2"
shafts.x = { between = ["A", "B"], stiffness = "1 kN*m/rad" }
"""
JOINED = FREE + 'shafts.y = { between = ["B", "C"], stiffness = "1 kN*m/rad" }\n'
DAMPER = 'dampers.d = { on = "A", inertia = "1 kg*m2", damping = "1 N*m*s/rad", mode = 2 }\n'
REFUSED = {
    "a disc apart": (FREE, r'torsion\.discs\.C: no shaft or gear joins C to the others; .*between = \["A", "C"\]'),
    "no turning": (
        JOINED + 'gears.g = { between = ["A", "C"], ratio = 3 }\n',
        r"torsion\.(gears\.g|shafts\.y): closes a ring",
    ),
    "no such mode": (JOINED + DAMPER.replace("2 }", "3 }"), r"torsion\.dampers\.d\.mode: .* from 1 to 2"),
    "one inertia": (FREE.replace("2 kg", "0 kg").replace("discs.C", "#"), r"torsion\.discs: there is no natural freq"),
}


@for_each(["text", "told"], REFUSED.values(), [*REFUSED])
def test_what_cannot_vibrate_is_refused(text, told):
    with pytest.raises(InputError, match=told):
        analysed(text)


def test_a_node_in_a_disc_is_told():
    results = analysed(JOINED)
    assert [(notice.code, *notice.values.values()) for notice in results.notices] == [("torsion_node", 1, "B")]
    nodes = results.listings["torsional_nodes"]
    assert list(zip(nodes.columns["mode_number"], nodes.names, strict=True)) == [(1, "B"), (2, "x"), (2, "y")]


def test_a_ring_that_nothing_holds_is_told():
    results = analysed(JOINED + 'dampers.d = { on = "A", inertia = "1 kg*m2" }\n')
    assert "torsion_free_ring" in [notice.code for notice in results.notices]
    assert results.summary["optimum_damping.d"] > 0


def test_a_damper_may_be_for_a_mode_that_is_not_listed():
    few, all_modes = (analysed(text + DAMPER) for text in (JOINED.replace("\n", "\nmodes = 1\n", 1), JOINED))
    assert few.summary["optimum_damping.d"] == pytest.approx(all_modes.summary["optimum_damping.d"])
