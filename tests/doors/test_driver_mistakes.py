"""What is wrong with a driver is told at its line, with what to write instead."""

import math
import re

import pytest

import crankwork
from crankwork.locale import LANGUAGES, in_language
from each import for_each

BOOM = """
[fixed_points]
O = ["0 m", "0 m"]
A = ["0.6 m", "-0.5 m"]
[driver]
cylinder = ["A", "B"]
start = "1.3 m"
law = [{ kind = "3-4-5", to = "1.9 m", over = "4 s" }, { kind = "dwell", over = "1 s" }]
[links.boom]
joins = ["O", "B"]
length = "1.8 m"
[positions]
B = ["1.4 m", "0.6 m"]
"""
SLIDER = """
[fixed_points]
O = ["0 mm", "0 mm"]
[driver]
slider = "piston"
law = [{ kind = "cubic", to = "250 mm", over = "1 s" }, { kind = "cubic", to = "150 mm", over = "1 s" }]
[guides.line]
through = "O"
[sliders.piston]
pin = "B"
guide = "line"
[links.rod]
joins = ["B", "A"]
length = "180 mm"
[links.arm]
joins = ["O", "A"]
length = "120 mm"
"""
ELBOW = """
[fixed_points]
O = ["0 mm", "0 mm"]
E = ["600 mm", "100 mm"]
[driver]
between = ["upper", "lower"]
start = "0 deg"
law = [{ kind = "cubic", to = "25 deg", over = "1.2 s" }]
[links.upper]
joins = ["O", "C"]
length = "500 mm"
[links.lower]
joins = ["C", "D"]
length = "400 mm"
[links.rocker]
joins = ["E", "D"]
length = "600 mm"
[positions]
C = ["-100 mm", "490 mm"]
D = ["300 mm", "620 mm"]
"""
CRANK = """
[fixed_points]
O = ["0 mm", "0 mm"]
C = ["180 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "50 mm"
[driver]
start = "0 deg"
law = [{ kind = "cycloidal", to = "90 deg", over = "1 s" }]
[links.coupler]
joins = ["A", "B"]
length = "200 mm"
[links.rocker]
joins = ["C", "B"]
length = "120 mm"
"""
MISTAKES = {
    "two drivers": (BOOM, 'start = "1.3 m"', 'slider = "x"\nstart = "1.3 m"', "driver.slider", "one driver"),
    "a crank too": (BOOM, "[links.boom]", '[crank]\npivot = "O"\npin = "Z"\nradius = "1 m"\n[links.boom]',
        "driver.cylinder", "one driver"),
    "nobody drives": (BOOM, 'cylinder = ["A", "B"]\n', "", "driver", "nothing drives"),
    "a law and a speed": (CRANK, 'radius = "50 mm"', 'radius = "50 mm"\nspeed = "100 rpm"', "crank.speed",
        "take speed out"),
    "a law without a pivot": (CRANK, 'pivot = "O"\n', "", "crank.pivot", 'pivot = "O"'),
    "a flywheel": (CRANK, "[links.coupler]", "[flywheel]\nfluctuation = 0.05\n[links.coupler]", "flywheel",
        "crank.speed instead"),
    "an unknown slider": (SLIDER, 'slider = "piston"', 'slider = "ram"', "driver.slider", "piston"),
    "a guide that moves": (SLIDER, 'through = "O"', 'through = ["0 mm", "0 mm"]\nlink = "arm"', "driver.slider",
        "fixed guide"),
    "an unknown point": (BOOM, '["A", "B"]', '["A", "Z"]', "driver.cylinder", "A, B, O"),
    "one point twice": (BOOM, '["A", "B"]', '["A", "A"]', "driver.cylinder", "two different"),
    "one point": (BOOM, '["A", "B"]', '["A"]', "driver.cylinder", "write 2 of them"),
    "a cylinder on one link": (BOOM, '["A", "B"]', '["O", "B"]', "driver.cylinder", "different links"),
    "held links": (ELBOW, "[positions]", '[links.strut]\njoins = ["E", "C"]\n[positions]', "driver.between",
        "lower, rocker, strut and upper are held without the driver"),
    "no length left": (BOOM, 'start = "1.3 m"', 'start = "-1.3 m"', "driver.law", "above zero"),
    "an angle for a length": (BOOM, '"1.3 m"', '"13 deg"', "driver.start", '"0.5 m"'),
    "a length for an angle": (ELBOW, '"25 deg"', '"25 mm"', "driver.law[1].to", '"90 deg"'),
    "a dwell that moves": (BOOM, '"dwell", over', '"dwell", to = "2 m", over', "driver.law[2].to", "leave it out"),
    "no end": (BOOM, '"3-4-5", to = "1.9 m"', '"3-4-5"', "driver.law[1].to", 'to = "0.5 m"'),
    "no time": (BOOM, ', over = "4 s"', "", "driver.law[1].over", "over ="),
    "a ramp of another law": (BOOM, '"3-4-5"', '"3-4-5", ramp = 0.2', "driver.law[1].ramp", "trapezoidal"),
    "a speed of another law": (BOOM, 'over = "4 s"', 'speed = "1 m/s"', "driver.law[1].speed", "constant"),
    "a speed that turns": (BOOM, '"3-4-5", to = "1.9 m", over = "4 s"', '"constant", to = "1.9 m", speed = "4 rpm"',
        "driver.law[1].speed", '"0.1 m/s"'),
    "a speed to where it stands": (BOOM, '"3-4-5", to = "1.9 m", over = "4 s"',
        '"constant", to = "1.3 m", speed = "4 m/s"', "driver.law[1].speed", "dwell"),
    "a law that stands": (BOOM, 'start = "1.3 m"\nlaw = [{ kind = "3-4-5"', 'law = [{ kind = "constant"',
        "driver.start", "give start"),
    "a table without values": (BOOM, '"3-4-5"', '"table", at = [0.5]', "driver.law[1].at", "as many values"),
    "a table that falls": (BOOM, '"3-4-5"', '"table", at = [0.5, 0.4], values = ["1.4 m", "1.5 m"]', "driver.law[1].at",
        "rise"),
    "shares without a period": (BOOM, 'over = "4 s"', "over = 0.5", "driver.law[1].over", "period ="),
    "an unknown kind": (BOOM, '"3-4-5"', '"3-4"', "driver.law[1].kind", "3-4-5"),
    "links without a pin": (ELBOW, '["upper", "lower"]', '["upper", "rocker"]', "driver.between", "common"),
    "an unknown link": (ELBOW, '["upper", "lower"]', '["upper", "elbow"]', "driver.between", "lower, rocker, upper"),
    "no drawing": (ELBOW, 'C = ["-100 mm", "490 mm"]\n', "", "driver.between", "[positions]"),
    "beyond its reach": (BOOM, '"1.9 m"', '"2.9 m"', "driver.law", "what the links reach"),
    "through a dead position": (SLIDER, '"250 mm"', '"310 mm"', "driver.law", "what the links reach"),
    "a load by the crank angle": (SLIDER, "[links.rod]",
        '[[loads]]\nkind = "torque"\nlink = "arm"\ntorque = ["1 N*m", "2 N*m"]\nat = ["0 deg", "90 deg"]\n[links.rod]',
        "loads[1]", "by the stroke"),
}  # fmt: skip


@for_each(("text", "old", "new", "key", "advice"), MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake_is_told_at_its_line(text, old, new, key, advice):
    assert text.count(old) >= 1
    with pytest.raises(crankwork.InputError) as caught:
        crankwork.read_machine(text.replace(old, new, 1))
    problem = next((one for one in caught.value.problems if one.key == key), None)
    assert problem is not None, caught.value
    assert advice in str(problem.message), problem.message
    for language in LANGUAGES:
        assert not re.search(r"[{}]", in_language(problem.message, language))


def test_a_group_without_positions_asks_for_those_of_its_joints():
    text = SLIDER.replace(
        "[links.rod]",
        """
[guides.other]
through = ["300 mm", "250 mm"]
angle = "40 deg"
[sliders.piece]
pin = "D"
guide = "other"
[links.plate]
joins = ["C", "E"]
points = { D = ["40 mm", "30 mm"] }
[links.first]
joins = ["B", "C"]
length = "90 mm"
mass = "1 kg"
centre = ["3 mm", "2 mm"]
[links.last]
joins = ["O", "E"]
length = "200 mm"
[links.rod]""",
    ).replace('joins = ["C", "E"]', 'joins = ["C", "E"]\nlength = "80 mm"')
    with pytest.raises(crankwork.errors.InputError) as caught:
        crankwork.read_machine(text)
    wanted = {"first": "B, C", "plate": "C, E, D", "last": "O, E", "piece": "D"}
    assert {one.key.partition(".")[2]: one.message.values["joints"] for one in caught.value.problems} == wanted


def test_times_and_shares_must_agree():
    shares = SLIDER.replace('over = "1 s" }, {', "over = 0.5 }, {").replace('over = "1 s" }]', "over = 0.6 }]")
    for text, advice in (
        (shares.replace("[driver]", '[driver]\nperiod = "2 s"'), "add up to one"),
        (SLIDER.replace("[driver]", '[driver]\nperiod = "3 s"'), "take period out"),
    ):
        with pytest.raises(crankwork.InputError, match=advice):
            crankwork.read_machine(text)


@for_each("text", [BOOM, SLIDER, ELBOW, CRANK], ids=["boom", "slider", "elbow", "crank"])
def test_the_files_without_mistakes_are_computed(text):
    results = crankwork.analyse(crankwork.read_machine(text))
    assert results.notices[0].code == "by_law"
    assert results["time"][-1] == results.summary["period"]
    assert not results.unmet


@for_each("dead_at", [1, 2])
@for_each("first", ["table", "3-4-5", "cycloidal", "parabolic"])
def test_a_law_that_ends_at_a_dead_position_is_refused_whichever_segment_it_is(first, dead_at):
    """Segments that end between whole degrees of the period; the boom points away from the foot of its cylinder."""
    ends = {1: "1.7 m", 2: "1.3 m", dead_at: f"{1.8 + math.hypot(0.6, 0.5):.16g} m"}
    samples = ', at = [0.4], values = ["1.5 m"]' if first == "table" else ""
    law = f"""law = [
    {{ kind = "{first}", to = "{ends[1]}", over = "2 s"{samples} }},
    {{ kind = "constant", to = "{ends[2]}", over = "4.91 s" }},
]"""
    text = BOOM.replace(BOOM[BOOM.index("law =") : BOOM.index("\n[links.boom]")], law)
    with pytest.raises(crankwork.InputError, match="dead position") as caught:
        crankwork.read_machine(text)
    assert [one.key for one in caught.value.problems] == ["driver.law"]
