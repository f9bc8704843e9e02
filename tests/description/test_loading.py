"""Loads, friction and a motor in the file of an engine: mistakes, sources and notices are those of that file."""

from __future__ import annotations

import pytest

import crankwork
from crankwork.description.document import origins_of
from crankwork.description.machine_file import template
from crankwork.errors import InputError
from crankwork.formula.traced_value import Input, in_order
from each import for_each

GEAR = """
crank = { radius = "50 mm", speed = "300 rpm" }
rod = { ratio = 0.25, mass = "1.2 kg", small_end_share = 0.3 }
piston.mass = "0.8 kg"
cylinder = { bore = "80 mm", compression_ratio = 8 }
gas.cycle = "360 deg"
gas.pressures = "absolute"
gas.pieces = [{ law = "polytropic", points = ["a", "b"], exponent = 1.3 }, { law = "constant", points = ["c", "d"] }]
gas.points.a = { angle = "0 deg", pressure = "1 MPa" }
gas.points.b.angle = "180 deg"
gas.points.c = { angle = "180 deg", pressure = "0.1 MPa" }
gas.points.d = { angle = "360 deg", pressure = "1 MPa" }
friction.pins.A = { coefficient = 0.1, radius = "20 mm" }
"""


@for_each(
    ("changed", "place"),
    [
        (('piston.mass = "0.8 kg"', 'piston.mass = "1e-10 kg"'), "text:4: piston.mass: "),
        (('"20 mm" }', '"20 mm" }\nflywheel = { percent = 1, recovery = "1 s" }'), "text:14: flywheel.recovery: "),
        (('"360 deg", pressure = "1 MPa"', '"360 deg"'), "text:8: gas.pieces: the diagram does not close"),
        (("friction.pins.A", "friction.pins.C"), "text:13: friction.pins.C: "),
        (("coefficient = 0.1", "coeficient = 0.1"), "text:13: friction.pins.A.coeficient: "),
        (('"20 mm" }', '"20 mm" }\nefficiency.chain = [0.9]'), "text:14: efficiency: "),
        (('"20 mm" }', '"20 mm" }\ndocument.sections = ["dynamics"]'), "text:14: document.sections[1]: "),
        (('"20 mm" }', '"20 mm" }\nmethod.kinematics = "textbook"'), "text:14: method.kinematics: friction counts in"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_at_the_line_of_the_file(changed, place) -> None:
    assert changed[0] in GEAR
    with pytest.raises(InputError) as refusal:
        crankwork.read_machine(GEAR.replace(*changed, 1))
    assert str(refusal.value).startswith(place), refusal.value


def test_what_a_setting_adds_is_told_of_the_setting() -> None:
    with pytest.raises(
        InputError, match=r"--set friction\.sliders\.bore: nothing slides by the name \"bore\"; there is"
    ):
        crankwork.read_machine(GEAR, overrides=["friction.sliders.bore.force=1 N"])


def test_every_number_of_the_calculation_is_from_a_line_of_the_file_or_a_default() -> None:
    results = crankwork.analyse(crankwork.read_machine(GEAR))
    origin = origins_of(GEAR)
    leaves = {
        known.node.path: known.node for known in in_order(results.trace.values()) if isinstance(known.node, Input)
    }
    places = {path: origin(path, (node.value,)) for path, node in leaves.items() if path}
    expected = {
        "crank.radius": ("line", "2"), "links.rod.length": ("follows_line", "3"), "links.rod.mass": ("line", "3"),
        "links.rod.centre[1]": ("follows_line", "3"), "sliders.piston.mass": ("line", "4"),
        "chambers.cylinder.faces[1].bore": ("line", "5"), "chambers.cylinder.pieces[1].exponent": ("line", "8"),
        "chambers.cylinder.points.a.pressure": ("line", "9"), "friction.pins.A.radius": ("line", "13"),
    }  # fmt: skip
    assert {path: (places[path].kind, places[path].line) for path in expected} == expected
    # directions of the axis and the way of assembly are those of an upright cylinder
    unstated = {path for path, place in places.items() if place.kind == "default"}
    assert {path.partition(".")[0] for path in unstated} <= {"fixed_points", "crank", "guides", "branch", "chambers"}


def test_numbers_and_deviations_are_those_that_the_file_states() -> None:
    machine = crankwork.read_machine(GEAR.replace('"1.2 kg"', '"1.2 ± 0.03 kg"'))
    assert machine.deviations == {"rod.mass": pytest.approx(0.01)}
    assert machine.tolerances == {"rod.mass": pytest.approx(0.03)}
    assert machine.stated["rod.ratio"].value == 0.25
    assert not any(path.startswith("links") for path in machine.stated)


def test_what_a_linkage_does_not_have_is_told() -> None:
    text = template("whole-engine")
    machine = crankwork.read_machine(f'loads = [{{ kind = "torque", link = "crank", torque = "1 N*m" }}]\n{text}')
    told = [(code, values.get("name")) for code, values in machine.notices]
    wanted = [("loaded_without", name) for name in ("bearings", "balance") if f"[{name}]" in text]
    assert wanted
    assert [one for one in told if one[0] == "loaded_without"] == wanted
