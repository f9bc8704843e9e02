"""The mechanism side of the studio without a browser: what is added, drawn, taken out."""

from __future__ import annotations

import json
import re

import pytest

import crankwork
from crankwork.description.machine_file import template, template_names
from crankwork.locale import in_language
from crankwork.studio.form import form
from crankwork.studio.session import Session
from studio.asked import answer, drawn, rows_of, sketch


def test_a_constant_torque_is_one_number_with_a_slider_and_loads_as_a_list_of_one_does():
    found = answer(template("four-bar"), "add", key="torque:rocker")
    row = rows_of(found)["loads[1].torque"]
    assert (row["value"], row["number"], row["after"]) == ("-6 N*m", -6.0, " N*m")
    other = answer(found["text"], "set", fields={"loads[1].torque": "7,5"})
    assert 'torque = "7.5 N*m"\n' in other["text"]
    assert answer(other["text"].replace('"7.5 N*m"', '["7.5 N*m"]'))["summary"] == other["summary"]
    assert other["summary"]["driving_torque_max"] != pytest.approx(found["summary"]["driving_torque_max"])
    assert "steps" in answer(other["text"], "ahead", key="loads[1].torque")
    wrong = answer(found["text"], "set", fields={"loads[1].torque": "much"})
    assert "write it like" in wrong["refusals"][0]["text"]


def test_masses_and_loads_stay_with_their_link_when_one_before_it_is_taken_out():
    whole = {"1": "OA", "2": "AB", "3": "BC", "4": "BE", "5": "EF"}
    fields = {}
    for number in range(2, 6):
        fields |= {f"links.{number}.mass": f"{number} kg", f"links.{number}.centre": '["1 mm", "0 mm"]'}
    text = answer(drawn(whole)["text"], "set", fields=fields)["text"]
    for key in ("torque:3", "torque:5", "force:E"):
        text = answer(text, "add", key=key)["text"]
    # without C the rocker goes; what was links 4 and 5 closes the loop
    left = {name: pins for name, pins in whole.items() if name != "3"}
    read = crankwork.Description(drawn(left, before=sketch(whole), text=text)["text"]).values
    assert {name: one["mass"] for name, one in read["links"].items()} == {"2": "2 kg", "4": "4 kg", "5": "5 kg"}
    assert [one.get("link") or one["point"] for one in read["loads"]] == ["5", "E"]


def test_a_link_that_drives_from_now_on_brings_its_mass():
    fields = {"links.3.mass": "3 kg", "links.3.centre": '["10 mm", "0 mm"]', "crank.mass": "1 kg", "crank.centre": "A"}
    text = answer(drawn()["text"], "set", fields=fields)["text"]
    found = drawn({"2": "AB", "3": "BC", "4": "AO"}, before=sketch(), text=text)
    read = crankwork.Description(found["text"]).values
    assert (read["crank"]["pivot"], read["crank"]["mass"]) == ("C", "3 kg")
    assert (read["crank"]["centre"], "mass" in read["links"]["4"]) == (["50.8 mm", "0 mm"], False)


MISSING = (
    ({"1": "OA", "2": "AB"}, "", "W = 2 · let B slide (S)"),
    ({"1": "OA", "2": "AB"}, "B", "W = 1 · I(0,1) -> II(2,3)"),
    ({"1": "OA", "2": "AB", "3": "BE"}, "", "W = 3 · ground E"),
    ({"1": "OA", "2": "ABD", "3": "BC"}, "", "W = 1 · I(0,1) -> II(2,3)"),
    ({"1": "OA", "2": "AB", "3": "BE", "4": "EF"}, "", "W = 2 · join two links"),
    ({"1": "OA", "2": "AC"}, "", "W = 0 · take a link out"),
    ({"1": "AB"}, "", "W = 3 · begin a link at a pin on the ground"),
)


def test_mobility_structure_and_what_is_missing_are_told_of_a_sketch():
    for links, slides, comes in MISSING:
        asked = sketch(links, slides=slides) | {"do": "missing", "typed": ["", ""]}
        assert Session("en").answer(asked)["missing"][: len(comes)] == comes


def measured(*stated, language="en"):
    return Session(language).answer({"do": "missing", "pins": [], "links": [], "typed": stated})["measured"]


def test_what_is_typed_while_drawing_is_refused_as_the_command_line_refuses_it():
    failures = []
    for value in ("-3", "0", "abc", "1.7 cms", "1.7.0 cm"):
        stated = f"{value} mm" if value in ("-3", "0") else value
        with pytest.raises(crankwork.InputError) as error:
            crankwork.read_machine(template("four-bar").replace('"62.5 mm"', f'"{stated}"'))
        message = next(one.message for one in error.value.problems if one.key == "crank.radius")
        for language in ("en", "ru", "vi"):
            found = measured(value, "", language=language)
            failures += [(value, language, found)] if found != {"refusal": in_language(message, language)} else []
    assert failures == []


def test_lengths_and_directions_typed_while_drawing_have_units_of_their_own():
    assert measured("50 mm", "") == {"length": pytest.approx(50)}
    assert measured("1,7 cm", "-30") == {"length": pytest.approx(17), "angle": pytest.approx(-30)}
    assert measured("2", "0.5 rad") == {"length": pytest.approx(2), "angle": pytest.approx(28.6478898)}
    assert measured("", "") == {}


FOUR_BAR = """format = 2
fixed_points = {{ O = ["0 mm", "0 mm"], C = ["{frame} mm", "0 mm"] }}
crank = {{ pivot = "O", pin = "A", radius = "{crank} mm", speed = "60 rpm" }}
[links]
coupler = {{ joins = ["A", "B"], length = "{coupler} mm" }}
rocker = {{ joins = ["C", "B"], length = "{rocker} mm" }}
"""
SLIDER_CRANK = """format = 2
fixed_points = { O = ["0 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "30 mm", speed = "60 rpm" }
links = { rod = { joins = ["A", "B"], length = "35 mm" } }
guides = { g = { through = ["0 mm", "10 mm"] } }
sliders = { B = { guide = "g", pin = "B" } }
"""
# a slot that passes its pivot at 120 mm
INVERTED = """format = 2
fixed_points = { O = ["0 mm", "0 mm"], P = ["150 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
links = { lever = { joins = ["P", "Q"], length = "300 mm" } }
guides = { slot = { link = "lever", through = ["0 mm", "120 mm"] } }
sliders = { block = { guide = "slot", pin = "A" } }
"""
# the second pair hangs on the rocker of a parallelogram, whose end is 75 to 125 mm from F
SIX_BAR = (
    FOUR_BAR.format(crank=25, coupler=60, rocker=25, frame=60).replace(" }\ncrank", ', F = ["160 mm", "0 mm"] }\ncrank')
    + """link = { joins = ["B", "E"], length = "70 mm" }
output = { joins = ["F", "E"], length = "45 mm" }
"""
)


FULL_TURNS = (
    # b + c > a + g, and the crank shorter than the frame by more than the others differ; else links come into line
    (FOUR_BAR.format(crank=30, coupler=60, rocker=40, frame=90), "coupler ≥ 80.1 mm", "80.1 mm"),
    (FOUR_BAR.format(crank=30, coupler=40.5, rocker=70, frame=91), "rocker ≥ 80.6 mm", "80.6 mm"),
    (FOUR_BAR.format(crank=60, coupler=70, rocker=50, frame=60), "crank ≤ 39.9 mm", "39.9 mm"),
    (SLIDER_CRANK, "rod ≥ 40.1 mm", "40.1 mm"),
    (INVERTED, "crank ≤ 29.9 mm", "29.9 mm"),
    (SIX_BAR, "link ≥ 80.1 mm", "80.1 mm"),
)


@pytest.mark.slow
def test_what_a_full_turn_needs_is_said_with_a_length_that_gives_it():
    for text, needs, value in FULL_TURNS:
        turn = answer(text)["turn"]
        assert turn["text"].endswith(f"a full turn needs {needs}.")
        assert (turn["use"], turn["value"]) == (f"Use {value}", value)
        found = answer(text, "set", fields={turn["key"]: turn["value"]})
        assert (found["refusals"], found["turn"], found["data"]["film"]["turns"]) == ([], None, True), needs


def test_lengths_that_no_single_change_makes_turn_fully_offer_none():
    # of 60, 30, 30 on 60 a crank would have to have no length
    found = answer(FOUR_BAR.format(crank=60, coupler=30, rocker=30, frame=60))
    assert (found["data"]["film"]["turns"], found["turn"]) == (False, None)


@pytest.mark.slow
def test_a_dyad_is_put_together_the_other_way_in_the_text_and_back():
    first = drawn(at={"A": (60, 95), "B": (120, 95), "C": (120, 120)})
    assert first["dyads"][0]["changes"] == [90.0, 270.0]
    crossed = answer(first["text"], "swap", key="B")
    assert "[branch]\nB = -1\n" in crossed["text"]
    assert "[positions]" not in crossed["text"]
    assert (crossed["refusals"], crossed["dyads"][0]["branch"], crossed["data"]["film"]["turns"]) == ([], -1, True)
    back = answer(crossed["text"], "swap", key="B")
    assert back["dyads"] == first["dyads"]
    assert "no branch" in answer(back["text"], "swap", key="Z")["refusals"][0]["text"]


def test_a_slider_crank_that_is_drawn_in_its_change_point_has_the_branch_that_is_usual():
    found = drawn({"1": "OA", "2": "AB"}, at={"B": (60, 120)}, slides="B")
    assert [(one["kind"], one["branch"]) for one in found["dyads"]] == [("RRP", 1)]


def test_a_force_begins_along_the_way_of_its_point():
    text = drawn({"1": "OA", "2": "AB"}, at={"A": (60, 95), "B": (140, 120)}, slides="B")["text"]
    added = (crankwork.Description(answer(text, "add", key=f"force:{point}")["text"])["loads[1]"] for point in "AB")
    assert [(one["x"], one["y"]) for one in added] == [("0 N", "-100 N"), ("-100 N", "0 N")]


def test_fields_are_called_by_words_not_cut_at_a_bracket():
    """What may be a point or two numbers is called a point."""
    for language in ("ru", "vi"):
        found = []
        for name in template_names():
            rows = form(crankwork.Description(template(name)), language)
            found += re.findall(r'"label": "([^"]*)"', json.dumps(rows, ensure_ascii=False))
        assert len(found) > 50
        cut = [one for one in found if ("[" in one[:-1] and not one.endswith("]")) or one.endswith((" или", " hoặc"))]
        assert cut == [], language
