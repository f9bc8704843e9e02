"""The mechanism side of the studio without a browser: what is added, drawn, taken out."""

from __future__ import annotations

import json
import re

import pytest

import crankwork
from crankwork.description.machine_file import template, template_names
from crankwork.locale import told
from crankwork.studio.answers import Studio


def rows_of(answer):
    return {row["key"]: row for group in answer["form"] for row in group["rows"]}


def test_a_constant_torque_is_one_number_with_a_slider_and_loads_as_a_list_of_one_does():
    studio = Studio("en")
    text = template("four-bar")
    found = studio.answer({"do": "add", "text": text, "key": "torque:rocker", "figures": []})
    row = rows_of(found)["loads[1].torque"]
    assert (row["value"], row["number"], row["after"]) == ("-6 N*m", -6.0, " N*m")
    typed = studio.answer({"do": "set", "text": found["text"], "fields": {"loads[1].torque": "7,5"}, "figures": []})
    assert 'torque = "7.5 N*m"\n' in typed["text"]
    listed = typed["text"].replace('"7.5 N*m"', '["7.5 N*m"]')
    assert studio.answer({"do": "show", "text": listed, "figures": []})["summary"] == typed["summary"]
    assert typed["summary"]["driving_torque_max"] != pytest.approx(found["summary"]["driving_torque_max"])
    held = studio.answer({"do": "ahead", "text": typed["text"], "key": "loads[1].torque", "figures": []})
    assert "steps" in held
    wrong = studio.answer({"do": "set", "text": found["text"], "fields": {"loads[1].torque": "much"}, "figures": []})
    assert "write it like" in wrong["refusals"][0]["text"]


def sketch(links, **more):
    """Return a sketch of a six-bar, or of what is left of it; pins of a name have a place of their own."""
    at = {
        "O": (60, 120),
        "A": (60, 90),
        "B": (140, 60),
        "C": (150, 120),
        "D": (100, 40),
        "E": (190, 60),
        "F": (200, 120),
    }
    held = {name for one in links.values() for name in one}
    pins = [{"name": name, "x": x, "y": y, "ground": name in "OCF"} for name, (x, y) in at.items() if name in held]
    listed = [{"name": name, "pins": list(one)} for name, one in links.items()]
    return {"do": "sketch", "pins": pins, "links": listed, "figures": [], **more}


def test_masses_and_loads_stay_with_their_link_when_one_before_it_is_taken_out():
    studio = Studio("en")
    whole = sketch({"1": "OA", "2": "AB", "3": "BC", "4": "BE", "5": "EF"})
    text = studio.answer(whole)["text"]
    for number in range(2, 6):
        text = studio.answer({"do": "set", "text": text, "figures": [], "fields": {
            f"links.{number}.mass": f"{number} kg", f"links.{number}.centre": '["1 mm", "0 mm"]'}})["text"]  # fmt: skip
    for key in ("torque:3", "torque:5", "force:E"):
        text = studio.answer({"do": "add", "text": text, "key": key, "figures": []})["text"]
    # without C the rocker goes; what was links 4 and 5 closes the loop
    left = sketch({"1": "OA", "2": "AB", "4": "BE", "5": "EF"}, before=whole, text=text)
    found = studio.answer(left)["text"]
    read = crankwork.Description(found).values
    assert {name: one["mass"] for name, one in read["links"].items()} == {"2": "2 kg", "4": "4 kg", "5": "5 kg"}
    assert [one.get("link") or one["point"] for one in read["loads"]] == ["5", "E"]


def test_a_link_that_drives_from_now_on_brings_its_mass():
    studio = Studio("en")
    whole = sketch({"1": "OA", "2": "AB", "3": "BC"})
    text = studio.answer(whole)["text"]
    fields = {"links.3.mass": "3 kg", "links.3.centre": '["10 mm", "0 mm"]', "crank.mass": "1 kg", "crank.centre": "A"}
    text = studio.answer({"do": "set", "text": text, "figures": [], "fields": fields})["text"]
    found = studio.answer(sketch({"2": "AB", "3": "BC", "4": "AO"}, before=whole, text=text))
    read = crankwork.Description(found["text"]).values
    assert (read["crank"]["pivot"], read["crank"]["mass"]) == ("C", "3 kg")
    assert (read["crank"]["centre"], "mass" in read["links"]["4"]) == (["50.8 mm", "0 mm"], False)


@pytest.mark.parametrize(
    ("links", "slides", "comes"),
    [
        ({"1": "OA", "2": "AB"}, "", "W = 2 · let B slide (S)"),
        ({"1": "OA", "2": "AB"}, "B", "W = 1 · I(0,1) -> II(2,3)"),
        ({"1": "OA", "2": "AB", "3": "BE"}, "", "W = 3 · ground E"),
        ({"1": "OA", "2": "ABD", "3": "BC"}, "", "W = 1 · I(0,1) -> II(2,3)"),
        ({"1": "OA", "2": "AB", "3": "BE", "4": "EF"}, "", "W = 2 · join two links"),
        ({"1": "OA", "2": "AC"}, "", "W = 0 · take a link out"),
        ({"1": "AB"}, "", "W = 3 · begin a link at a pin on the ground"),
    ],
    ids=["two", "slider", "three", "four-bar", "five-bar", "held", "hanging"],
)
def test_mobility_structure_and_what_is_missing_are_told_of_a_sketch(links, slides, comes):
    asked = sketch(links)
    for pin in asked["pins"]:
        pin.update({"slides": 0} if pin["name"] in slides else {})
    found = Studio("en").answer({**asked, "do": "missing", "typed": ["", ""]})
    assert found["missing"].startswith(comes)


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
@pytest.mark.parametrize("typed", ["-3", "0", "abc", "1.7 cms", "1.7.0 cm"])
def test_what_is_typed_while_drawing_is_refused_as_the_command_line_refuses_it(typed, language):
    found = Studio(language).answer({"do": "missing", "pins": [], "links": [], "typed": [typed, ""]})["measured"]
    stated = f"{typed} mm" if typed in ("-3", "0") else typed
    with pytest.raises(crankwork.InputError) as error:
        crankwork.read_machine(template("four-bar").replace('"62.5 mm"', f'"{stated}"'))
    message = next(one.message for one in error.value.problems if one.key == "crank.radius")
    assert found == {"refusal": told(message, language)}


def test_lengths_and_directions_typed_while_drawing_have_units_of_their_own():
    def read(*typed):
        return Studio("en").answer({"do": "missing", "pins": [], "links": [], "typed": typed})["measured"]

    assert read("50 mm", "") == {"length": pytest.approx(50)}
    assert read("1,7 cm", "-30") == {"length": pytest.approx(17), "angle": pytest.approx(-30)}
    assert read("2", "0.5 rad") == {"length": pytest.approx(2), "angle": pytest.approx(28.6478898)}
    assert read("", "") == {}


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


@pytest.mark.parametrize(
    ("text", "needs", "value"),
    [
        # b + c > a + g, and the crank shorter than the frame by more than the others differ; else links come into line
        (FOUR_BAR.format(crank=30, coupler=60, rocker=40, frame=90), "coupler ≥ 80.1 mm", "80.1 mm"),
        (FOUR_BAR.format(crank=30, coupler=40.5, rocker=70, frame=91), "rocker ≥ 80.6 mm", "80.6 mm"),
        (FOUR_BAR.format(crank=60, coupler=70, rocker=50, frame=60), "crank ≤ 39.9 mm", "39.9 mm"),
        (SLIDER_CRANK, "rod ≥ 40.1 mm", "40.1 mm"),
        (INVERTED, "crank ≤ 29.9 mm", "29.9 mm"),
        (SIX_BAR, "link ≥ 80.1 mm", "80.1 mm"),
    ],
    ids=["coupler", "rocker", "crank", "slider-crank", "inverted", "six-bar"],
)
def test_what_a_full_turn_needs_is_said_with_a_length_that_gives_it(text, needs, value):
    studio = Studio("en")
    turn = studio.answer({"do": "show", "text": text, "figures": []})["turn"]
    assert turn["text"].endswith(f"a full turn needs {needs}.")
    assert (turn["use"], turn["value"]) == (f"Use {value}", value)
    found = studio.answer({"do": "set", "text": text, "fields": {turn["key"]: turn["value"]}, "figures": []})
    assert (found["refusals"], found["turn"], found["data"]["film"]["turns"]) == ([], None, True)


def test_lengths_that_no_single_change_makes_turn_fully_offer_none():
    # of 60, 30, 30 on 60 a crank would have to have no length
    text = FOUR_BAR.format(crank=60, coupler=30, rocker=30, frame=60)
    found = Studio("en").answer({"do": "show", "text": text, "figures": []})
    assert found["data"]["film"]["turns"] is False
    assert found["turn"] is None


def test_a_dyad_is_put_together_the_other_way_in_the_text_and_back():
    studio = Studio("en")
    drawn = sketch({"1": "OA", "2": "AB", "3": "BC"})
    at = {"O": (60, 120), "A": (60, 95), "B": (120, 95), "C": (120, 120)}
    drawn["pins"] = [one | dict(zip("xy", at[one["name"]], strict=True)) for one in drawn["pins"]]
    first = studio.answer(drawn)
    assert first["dyads"][0]["changes"] == [90.0, 270.0]
    crossed = studio.answer({"do": "swap", "text": first["text"], "key": "B", "figures": []})
    assert "[branch]\nB = -1\n" in crossed["text"]
    assert "[positions]" not in crossed["text"]
    assert (crossed["refusals"], crossed["dyads"][0]["branch"], crossed["data"]["film"]["turns"]) == ([], -1, True)
    back = studio.answer({"do": "swap", "text": crossed["text"], "key": "B", "figures": []})
    assert back["dyads"] == first["dyads"]
    assert "no branch" in studio.answer({"do": "swap", "text": back["text"], "key": "Z"})["refusals"][0]["text"]


def test_a_slider_crank_that_is_drawn_in_its_change_point_has_the_branch_that_is_usual():
    drawn = sketch({"1": "OA", "2": "AB"})
    at = {"O": (60, 120), "A": (60, 90), "B": (60, 120)}
    drawn["pins"] = [one | dict(zip("xy", at[one["name"]], strict=True)) for one in drawn["pins"]]
    drawn["pins"][2]["slides"] = 0
    found = Studio("en").answer(drawn)
    assert [(one["kind"], one["branch"]) for one in found["dyads"]] == [("RRP", 1)]


def test_a_force_begins_along_the_way_of_its_point():
    drawn = sketch({"1": "OA", "2": "AB"})
    at = {"O": (60, 120), "A": (60, 95), "B": (140, 120)}
    drawn["pins"] = [one | dict(zip("xy", at[one["name"]], strict=True)) for one in drawn["pins"]]
    drawn["pins"][2]["slides"] = 0
    text = Studio("en").answer(drawn)["text"]
    forces = {}
    for point in "AB":
        added = Studio("en").answer({"do": "add", "text": text, "key": f"force:{point}", "figures": []})["text"]
        forces[point] = crankwork.Description(added)["loads[1]"]
    assert {key: (one["x"], one["y"]) for key, one in forces.items()} == {
        "A": ("0 N", "-100 N"),
        "B": ("-100 N", "0 N"),
    }


@pytest.mark.parametrize("language", ["ru", "vi"])
def test_fields_are_called_by_words_not_cut_at_a_bracket(language):
    """What may be a point or two numbers is called a point."""
    found = []
    for name in template_names():
        rows = Studio(language).answer({"do": "show", "text": template(name), "figures": []})["form"]
        found += re.findall(r'"label": "([^"]*)"', json.dumps(rows, ensure_ascii=False))
    assert len(found) > 50
    assert not [one for one in found if ("[" in one[:-1] and not one.endswith("]")) or one.endswith((" или", " hoặc"))]
