"""What the studio is told of a machine file, without a browser."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.description.machine_file import template, template_names
from crankwork.errors import CrankworkError
from crankwork.page import sliders
from crankwork.studio import answers
from crankwork.studio.answers import Studio, opened_share, shared
from crankwork.studio.trials import StoppedError
from crankwork.study.mapped import map_text, mapped

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))


def rows_of(answer):
    return {row["key"]: row for group in answer["form"] for row in group["rows"]}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_opens_with_what_the_command_line_finds(path):
    answer = Studio("en", path).answer({"do": "show", "text": path.read_text("utf-8"), "figures": None})
    results = crankwork.analyse(crankwork.read(path))
    assert answer["refusals"] == []
    assert answer["summary"] == dict(results.summary)
    assert {re.sub(r"\[[12]\]$", "", key) for key in rows_of(answer)} == {*crankwork.load(path)} - {"format"}
    assert answer["checks"] == [len(results.checks) - len(results.unmet), len(results.checks)]
    assert set(answer["figures"]) <= set(answer["names"])


@pytest.mark.parametrize("name", template_names())
def test_a_field_typed_as_it_stands_changes_nothing(name, monkeypatch):
    text = template(name)
    studio = Studio("en")
    # what is drawn is not looked at
    monkeypatch.setattr(studio, "_seen", lambda *_: {})
    for key, row in rows_of(studio.answer({"do": "show", "text": text, "figures": None})).items():
        found = studio.answer({"do": "set", "text": text, "fields": {key: row["value"]}, "figures": None})
        assert found["text"] == text, key


def test_a_field_changes_in_the_text_and_keeps_what_is_said_beside_it():
    text = template("engine")
    found = Studio("en").answer({"do": "set", "text": text, "fields": {"crank.radius": "47,5,0 mm"}, "figures": None})
    assert 'radius = "47,5,0 mm"' in found["text"]
    assert found["text"].count("#") == text.count("#")
    assert found["refusals"]
    whole = Studio("en").answer({"do": "set", "text": text, "fields": {"crank.radius": "47.5 mm"}, "figures": None})
    assert whole["summary"]["stroke"] == pytest.approx(0.095)


@pytest.mark.parametrize(
    ("stated", "typed", "language", "comes"),
    [
        ("45 mm", "50", "en", "50 mm"),
        ("45 mm", "4,75 cm", "en", "4.75 cm"),
        ("45 mm", "47,125", "ru", "47.125 mm"),
        # it may be told by thousands
        ("45 mm", "1,700 mm", "en", "1,700 mm"),
        ("45 ± 0.1 mm", "47", "vi", "47 ± 0.1 mm"),
        ("45 mm ± 1 %", "47", "en", "47 mm ± 1 %"),
    ],
)
def test_a_number_typed_keeps_unit_and_tolerance(stated, typed, language, comes):
    text = template("engine").replace('radius = "45 mm"', f'radius = "{stated}"')
    studio = Studio(language)
    found = studio.answer({"do": "set", "text": text, "fields": {"crank.radius": typed}, "figures": []})
    assert f'radius = "{comes}"' in found["text"]
    row = rows_of(found)["crank.radius"]
    assert row["value"] == comes
    assert ("after" in row) == (found["refusals"] == [])


def test_a_point_is_two_numbers_and_names_are_told_apart_by_commas():
    text, studio = template("four-bar"), Studio("en")

    def typed(key, value):
        return studio.answer({"do": "set", "text": text, "fields": {key: value}, "figures": []})

    rows = rows_of(studio.answer({"do": "show", "text": text, "figures": []}))
    point = rows["links.coupler.points.P[2]"]
    assert [point[one] for one in ("name", "value", "number", "unit")] == ["P, y", "40 mm", 40.0, "mm"]
    assert rows["links.coupler.joins"]["value"] == "A, B"
    assert 'P = ["80 mm", "45 mm"]' in typed("links.coupler.points.P[2]", "45")["text"]
    assert 'joins = ["B", "A"]' in typed("links.coupler.joins", "B, A")["text"]
    assert typed("links.coupler.joins", "A B")["refusals"][0]["key"] == "links.coupler.joins"
    assert typed("links.coupler.points.P[1]", "8 mn")["refusals"][0]["key"] == "links.coupler.points.P[1]"
    gone = studio.answer({"do": "without", "text": text, "key": "fixed_points.C[1]", "figures": []})
    assert "C =" not in gone["text"]


@pytest.mark.parametrize("typed", ["-3 mm", "0 mm", "", "abc", "1.7 cms", "1.7.0 cm"])
@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_what_is_refused_is_told_as_the_command_line_tells_it(typed, language, tmp_path):
    from crankwork.locale import told

    found = Studio(language, Path("machine.toml")).answer(
        {"do": "set", "text": template("engine"), "fields": {"crank.radius": typed}, "figures": None}
    )
    with pytest.raises(crankwork.InputError) as error:
        crankwork.read_machine(found["text"], "machine.toml")
    assert [one["text"] for one in found["refusals"]] == error.value.lines(lambda one: told(one, language))
    lines = found["text"].splitlines()
    assert lines[found["refusals"][0]["line"] - 1].startswith(f'radius = "{typed}"')
    assert "data" not in found
    assert "form" in found


@pytest.mark.parametrize(
    ("name", "key", "value"),
    [
        ("four-bar", "crank", 1), ("four-bar", "links", 0), ("four-bar", "links.rocker", "x"),
        ("four-bar", "links.coupler.points", -1), ("four-bar", "links.coupler.joins", []), ("four-bar", "sliders", [1]),
        ("four-bar", "fixed_points", [["0 mm", "0 mm"]]), ("four-bar", "crank.pin", ["a", "b"]),
        ("four-bar", "crank.pivot", {"a": 1}), ("slider-crank", "rod", 0), ("press", "sliders.ram.pin", {}),
    ],
)  # fmt: skip
@pytest.mark.parametrize(
    "asks", [{"do": "show"}, {"do": "set", "fields": {"title": "x"}}, {"do": "add", "key": "masses:"}]
)
def test_what_no_key_may_state_is_refused_as_the_command_line_refuses_it(name, key, value, asks):
    description = crankwork.Description(template(name))
    description[key] = value
    with pytest.raises(crankwork.InputError) as error:
        description.machine()
    found = Studio("en").answer({**asks, "text": description.dump(), "figures": None})
    told = [one["text"].partition(": ")[2] for one in found["refusals"]]
    assert told == [one.partition(": ")[2] for one in error.value.lines()]


def test_a_length_without_a_space_is_a_length():
    text = template("four-bar").replace('"62.5 mm"', '"62.5mm"').replace('"112.5 mm"', '"112.5mm"')
    found = Studio("en").answer({"do": "show", "text": text, "figures": []})
    assert found["refusals"] == []
    offered = dict(found["additions"])
    for key in ("masses:", "links:B", "friction:"):
        if key in offered:
            assert Studio("en").answer({"do": "add", "text": text, "key": key, "figures": []})["refusals"] == []


def test_what_a_machine_has_not_is_refused_in_words():
    studio = Studio("en")
    for asks in ({"do": "swap", "key": "B"}, {"do": "set", "fields": {".".join("a" * 300): "1"}}):
        found = studio.answer({**asks, "text": template("slider-crank"), "figures": []})
        assert found["refusals"][0]["text"], asks


@pytest.mark.parametrize(
    ("name", "kinds"),
    [("press", {"motor", "friction", "torque", "spring", "links"}), ("slider-crank", {"gas", "flywheel"})],
)
def test_whatever_is_added_makes_a_machine_that_is_computed(name, kinds):
    text, studio = template(name), Studio("en")
    offered = studio.answer({"do": "show", "text": text, "figures": []})["additions"]
    first = {key.partition(":")[0]: key for key, _ in reversed(offered)}
    assert first.keys() >= kinds
    for key in first.values():
        found = studio.answer({"do": "add", "text": text, "key": key, "figures": []})
        assert found["refusals"] == [], key
        assert found["added"], key
        assert found["text"].count("#") == text.count("#")


def test_values_are_in_the_units_that_the_file_asks_for():
    text = f'units = "imperial"\n{template("slider-crank")}'
    found = Studio("en").answer({"do": "show", "text": text, "figures": []})
    assert found["scales"]["stroke"] == pytest.approx((1 / 0.0254, "in"))
    assert "<td>in" in found["values"]
    assert "<td>mm" not in found["values"]


def linked(*ends):
    """Return links of a sketch by the names of their pins, the first of which is called 1."""
    return [{"name": str(number), "pins": list(one)} for number, one in enumerate(ends, start=1)]


def drawn(**places):
    """Return a sketch of a four-bar, some of its pins elsewhere."""
    at = {"O": (60, 120), "A": (60, 90), "B": (140, 60), "C": (150, 120)} | places
    pins = [{"name": name, "x": x, "y": y, "ground": name in "OC"} for name, (x, y) in at.items()]
    return {"do": "sketch", "pins": pins, "links": linked("OA", "AB", "BC"), "figures": []}


def test_a_pin_that_is_moved_changes_what_meets_there_and_nothing_else():
    studio = Studio("en")
    first = studio.answer(drawn())["text"].replace('"60 rpm"', '"90 rpm"').replace('"30 mm"', '"31 mm"')
    moved = studio.answer({**drawn(B=(140, 50)), "before": drawn(), "text": first})
    rows = {key: row["value"] for key, row in rows_of(moved).items()}
    assert rows["links.2.length"] == "89.4 mm"
    assert rows["links.3.length"] == "70.7 mm"
    assert [rows[f"positions.B[{k}]"] for k in (1, 2)] == ["80 mm", "70 mm"]
    assert (rows["crank.radius"], rows["crank.speed"]) == ("31 mm", "90 rpm")
    assert moved["refusals"] == []


def test_a_pin_that_is_taken_out_takes_its_links_out_of_the_file():
    more = drawn()
    more["pins"] += [{"name": "D", "x": 100, "y": 40}]
    more["links"] = linked("OA", "ABD", "BC")
    studio = Studio("en")
    first = studio.answer(more)["text"]
    assert "points" in first
    found = studio.answer({**drawn(), "before": more, "text": first})
    assert "D" not in found["text"]
    assert found["refusals"] == []


def test_a_drawn_four_bar_has_its_torque_curve_after_masses_and_a_load():
    studio = Studio("en")
    found = studio.answer(drawn())
    for key in ("masses:", "torque:3"):
        found = studio.answer({"do": "add", "text": found["text"], "key": key, "figures": list(found["figures"])})
    assert "torques" in found["names"]
    assert set(found["figures"]) & {"torques", "reduced_inertia"}
    # a bar of 85.4 mm at 5 kg/m, about its middle
    assert rows_of(found)["links.2.mass"]["value"] == "0.43 kg"
    assert rows_of(found)["links.2.inertia"]["value"] == "2.6 kg*cm2"
    assert found["summary"]["driving_torque_max"] > 0
    offered = [key for key, _ in found["additions"]]
    rubbing = studio.answer({"do": "add", "text": found["text"], "key": "friction:", "figures": []})
    assert set(offered) - {key for key, _ in rubbing["additions"]} == {
        "friction:",
        "links:B",
        "slider:B",
        "links:A",
        "slider:A",
    }


def test_text_that_is_no_toml_is_refused_at_its_line():
    found = Studio("en").answer({"do": "show", "text": "[crank]\nradius = 45 mm\n", "figures": None})
    assert [one["line"] for one in found["refusals"]] == [2]
    assert "form" not in found


def test_a_shared_machine_comes_back_whole_and_a_damaged_one_is_refused():
    text = template("engine", "vi")
    word = shared(text)
    assert len(word) < len(text)
    assert opened_share(word) == text
    for damaged in (word[:-9], "crankwork:", "crankwork:ж", word[:60] + "A" + word[61:], word + "AAAA=A"):
        with pytest.raises(CrankworkError, match="shared whole"):
            opened_share(damaged)
    with pytest.raises(CrankworkError, match="shared whole"):
        opened_share(shared("#" * 10_000_000))


def test_files_that_a_text_names_are_read_only_where_that_is_allowed(tmp_path):
    text = template("engine").replace("[gas]", '[gas]\n[gas.measured]\nfile = "/etc/hostname"\n[spare]', 1)
    asked = {"do": "show", "text": text, "figures": None}
    studio = Studio("en")
    assert studio.answer(asked)["named"] == ["/etc/hostname"]
    assert studio.answer(asked)["refusals"] == []
    assert Studio("en", reads=True).answer(asked)["refusals"] != []
    with pytest.raises(CrankworkError, match="read only if you allow it"):
        Studio("en").export(text, "note.html")


def test_no_question_reads_a_file_before_that_is_allowed():
    text = template("engine").replace("[gas]", '[gas]\n[gas.measured]\nfile = "/etc/hostname"\n[spare]', 1)
    found = Studio("en").answer({"do": "explain", "text": text, "key": "swept_volume"})
    assert "read only if you allow it" in found["refusals"][0]["text"]
    assert Studio("en").answer({"do": "ahead", "text": text, "key": "crank.radius"}) == {}


@pytest.mark.parametrize(
    ("name", "key", "figures", "behind", "stays"),
    [
        ("four-bar", "crank.radius", ["links", "position_plans", "velocity_plan"], ["velocity_plan"], False),
        ("engine", "rod.length", ["kinematics", "pressure", "tolle"], ["tolle"], True),
        ("slider-crank", "crank.speed", ["kinematics"], [], False),
        ("stephenson-six-bar", "links.coupler.length", ["points", "position_plans"], [], False),
        ("engine", "rod.length", ["indicator"], [], True),
        ("petrol-four", "piston.mass", ["piston_forces"], [], False),
        ("petrol-four", "rod.ratio", ["indicator", "torque", "crankpin_polar", "main_wear"], ["main_wear"], True),
        # of the same look on paper, since all of it grows alike
        ("slider-crank", "crank.radius", ["tolle"], ["tolle"], False),
    ],
)
def test_what_a_page_calculates_itself_and_what_stays_behind(name, key, figures, behind, stays):
    path = next((one for one in EXAMPLES if one.stem == name), None)
    text = path.read_text("utf-8") if path else template(name)
    found = Studio("en").answer({"do": "ahead", "text": text, "key": key, "figures": figures})
    ahead = found["ahead"]
    assert (ahead["behind"], ahead["stays"]) == (behind, stays)
    assert ahead["figures"].keys() == set(figures) - set(behind)
    assert found["steps"].startswith("var steps=")
    assert len(ahead["data"]["sliders"]["values"]) > 5


@pytest.mark.parametrize(
    ("name", "key", "filed", "live"),
    [
        # nothing acts on the way back: where the least torque stands is rounding
        ("toggle-press", "fixed_points.E[2]", ["static_torque_min_angle"], ["pressure_angle_max.D"]),
        # the same 2 % away, as long as the weights are less than the force of the press
        ("press", "crank.speed", ["joint_force_max_angle.O"], ["dynamic_torque_max"]),
    ],
)
def test_values_that_may_be_others_elsewhere_are_no_live_ones(name, key, filed, live):
    found = Studio("en").answer({"do": "ahead", "text": template(name), "key": key, "figures": []})
    told = found["ahead"]["data"]["sliders"]
    assert set(filed) <= set(told["filed"])
    assert not set(filed) & told["values"].keys()
    assert set(live) <= told["values"].keys()


def test_steps_are_believed_as_far_as_there_are_machines():
    def trusted(name, key, **reach):
        asked = {"do": "ahead", "text": template(name), "key": key, "figures": [], **reach}
        found = Studio("en").answer(asked)["ahead"]
        (field,) = found["data"]["sliders"]["fields"]
        return pytest.approx(np.array(found["trusted"]) / field["now"], abs=1e-6)

    # of a longer crank the mechanism no longer turns
    assert trusted("four-bar", "crank.radius") == [0.5, 1.25]
    # the diagram still closes, for larger numbers it does not
    assert trusted("engine", "gas.points.e.pressure") == [0.5, 1.5]
    assert trusted("slider-crank", "crank.radius") == [0.5, 2.0]
    # to the ends of the slider, where the page tells them
    assert trusted("four-bar", "crank.speed", low="90 rpm", high="400 rpm") == [0.75, 4.0]
    assert trusted("four-bar", "crank.speed", low="90 kg", high="400 rpm") == [0.5, 2.0]


def test_scales_that_differ_by_rounding_are_the_same(monkeypatch):
    own, drawn = sliders.drawings, []

    def nudged(*told, **more):
        found = own(*told, **more)
        drawn.append(found)
        if len(drawn) == 1:
            return found
        return {
            name: one._replace(plots=tuple(plot._replace(y=tuple(np.nextafter(plot.y, 9))) for plot in one.plots))
            for name, one in found.items()
        }

    monkeypatch.setattr(sliders, "drawings", nudged)
    asked = {"do": "ahead", "text": template("four-bar"), "key": "crank.speed", "figures": ["reduced_inertia"]}
    assert Studio("en").answer(asked)["ahead"]["behind"] == []
    assert len(drawn) > 2


@pytest.mark.parametrize("machine", [False, True])
def test_while_a_number_is_held_no_more_is_drawn_than_is_asked_for(machine, monkeypatch):
    drawn = []
    for name in ("film_of", "inline_film", "form", "values"):
        own = getattr(answers, name)
        monkeypatch.setattr(
            answers, name, lambda *told, _own=own, _name=name, **more: drawn.append(_name) or _own(*told, **more)
        )
    asked = {
        "do": "set",
        "text": template("four-bar"),
        "fields": {"crank.radius": "60 mm"},
        "figures": ["velocity_plan"],
    }
    found = Studio("en").answer({**asked, "held": True, "machine": machine})
    assert found["figures"].keys() == {"velocity_plan"}
    assert drawn == (["film_of", "inline_film"] if machine else [])
    assert ("film" in found) is machine


def test_of_a_number_that_no_browser_follows_nothing_is_made():
    studio = Studio("en")
    for key in ("title", "crank.none"):
        assert studio.answer({"do": "ahead", "text": template("engine"), "key": key, "figures": []}) == {}
    swings = template("four-bar").replace('"62.5 mm"', '"100 mm"')
    assert studio.answer({"do": "ahead", "text": swings, "key": "crank.radius", "figures": []}) == {}


def test_a_value_is_explained_down_to_its_line():
    text = template("engine")
    found = Studio("en").answer({"do": "explain", "text": text, "key": "swept_volume"})["memories"]
    assert found["keys"].keys() == {"swept_volume"}
    lines = text.splitlines()
    bore = next(k for k, line in enumerate(lines, start=1) if line.startswith("bore"))
    assert any(f"line {bore}" in node.get("g", "") for node in found["nodes"])


@pytest.mark.parametrize(
    ("name", "start"),
    [("note.html", b"<!DOCTYPE"), ("page.html", b"<!DOCTYPE"), ("tables.xlsx", b"PK"), ("sheets.zip", b"PK"),
     ("machine.svg", b"<svg"), ("kinematics.dxf", b"  0"), ("torque.svg", b"<svg")],
)  # fmt: skip
def test_a_machine_is_exported_as_what_its_name_says(name, start):
    data = Studio("ru").export(template("engine"), name)
    assert data.lstrip(b"\xef\xbb\xbf").startswith((start, b"<?xml"))
    assert len(data) > 1000


def test_a_map_is_told_as_it_goes_on_and_ends_where_the_command_line_does():
    shares = []
    text = template("slider-crank")
    asked = {"text": text, "over": {"crank.radius": "40..60 mm"}}
    found = Studio("en").tried(asked, shares.append)
    expected = map_text(mapped(crankwork.Description(text), ["crank.radius=40..60 mm"]), "en")
    assert found["text"] == expected
    assert shares == pytest.approx([k / 13 for k in range(1, 14)])
    assert found["figures"]["map.stroke"][1].startswith("<svg")


def test_designs_are_swept_and_the_best_is_named():
    asked = {
        "text": template("slider-crank"), "over": {"crank.radius": "40..60 mm"}, "count": "64",
        "objectives": {"stroke": "maximise"},
    }  # fmt: skip
    shares = []
    found = Studio("en").tried(asked, shares.append)
    assert shares[-1] == 1.0
    assert "119" in found["text"]
    assert found["figures"]


@pytest.mark.parametrize(
    "asked",
    [
        {"over": {"crank.radius": "60..40 mm"}},
        {"over": {}},
        {"over": {"x": "1..2"}, "count": "9e9"},
        {"over": {"crank.radius": "40..60 mm"}, "count": "9" * 5000},
        {"text": "crank = 1", "over": {"crank.speed": "1..2 rpm"}},
    ],
)
def test_what_cannot_be_tried_is_refused_in_words(asked):
    found = Studio("en").tried({"text": template("slider-crank"), **asked}, lambda _: None)
    assert all(";" in one["text"] for one in found["refusals"])
    assert found["refusals"]


def test_a_trial_that_nobody_waits_for_ends():
    def told(_):
        raise StoppedError

    with pytest.raises(StoppedError):
        Studio("en").tried({"text": template("slider-crank"), "over": {"crank.radius": "40..60 mm"}}, told)
