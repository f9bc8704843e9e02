"""What the studio is told of a machine file, without a browser."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.description.machine_file import template, template_names
from crankwork.errors import CrankworkError
from crankwork.locale import in_language
from crankwork.page import sliders
from crankwork.studio import session
from crankwork.studio.form import additions
from crankwork.studio.session import Session, StoppedError, opened_share, shared
from crankwork.study.parameter_map import map_text, mapped
from each import for_each
from studio.asked import answer, drawn, rows_of, sketch, typed

EXAMPLES = {one.stem: one for one in sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))}
# an engine, tables, a linkage with forces, a machine driven by a motor
SOME = ("spark-engine", "press", "excavator-boom", "punching-machine")
MEASURED = template("engine").replace("[gas]", '[gas]\n[gas.measured]\nfile = "/etc/hostname"\n[spare]', 1)


@pytest.mark.parametrize(
    "names", [SOME, pytest.param(EXAMPLES.keys() - set(SOME), marks=pytest.mark.slow)], ids=["some", "others"]
)
def test_every_example_opens_with_what_the_command_line_finds(names):
    failures = []
    for name in sorted(names):
        path = EXAMPLES[name]
        found = Session("en", path).answer({"do": "show", "text": path.read_text("utf-8"), "figures": None})
        results = crankwork.analyse(crankwork.read(path))
        fields = {re.sub(r"\[[12]\]$", "", key) for key in rows_of(found)}
        is_right = {
            "refusals": found["refusals"] == [],
            "summary": found["summary"] == dict(results.summary),
            "form": fields == {*crankwork.load(path)} - {"format"},
            "checks": found["checks"] == [len(results.checks) - len(results.unmet), len(results.checks)],
            "figures": len(found["figures"]) > 0 and set(found["figures"]) <= set(found["names"]),
        }
        failures += [(name, what) for what, is_so in is_right.items() if not is_so]
    assert failures == []


@pytest.mark.parametrize(
    "names",
    [("engine", "four-bar", "press"), pytest.param(template_names(), marks=pytest.mark.slow)],
    ids=["some", "every"],
)
def test_a_field_typed_as_it_stands_changes_nothing(names, monkeypatch):
    failures = []
    for name in names:
        text, studio = template(name), Session("en")
        # what is drawn is not looked at
        monkeypatch.setattr(studio, "_seen", lambda *_: {})
        for key, row in rows_of(studio.answer({"do": "show", "text": text})).items():
            found = studio.answer({"do": "set", "text": text, "fields": {key: row["value"]}})
            failures += [(name, key)] if found["text"] != text else []
    assert failures == []


def test_a_field_changes_in_the_text_and_keeps_what_is_said_beside_it():
    text = template("engine")
    found = typed(text, crank__radius="47,5,0 mm")
    assert 'radius = "47,5,0 mm"' in found["text"]
    assert found["text"].count("#") == text.count("#")
    assert found["refusals"]
    assert typed(text, crank__radius="47.5 mm")["summary"]["stroke"] == pytest.approx(0.095)


@pytest.mark.parametrize(
    ("stated", "value", "language", "comes"),
    [
        ("45 mm", "50", "en", "50 mm"),
        ("45 mm", "4,75 cm", "en", "4.75 cm"),
        ("45 mm", "47,125", "ru", "47.125 mm"),
        # it may be told by thousands
        ("45 mm", "1,700 mm", "en", "1,700 mm"),
        ("45 ± 0.1 mm", "47", "vi", "47 ± 0.1 mm"),
        ("45 mm ± 1 %", "47", "en", "47 mm ± 1 %"),
        ("45 sd 0.1 mm", "47", "ru", "47 sd 0.1 mm"),
    ],
)
def test_a_number_typed_keeps_unit_and_tolerance(stated, value, language, comes):
    text = template("engine").replace('radius = "45 mm"', f'radius = "{stated}"')
    found = typed(text, language, crank__radius=value)
    assert f'radius = "{comes}"' in found["text"]
    row = rows_of(found)["crank.radius"]
    assert row["value"] == comes
    assert ("after" in row) == (found["refusals"] == [])


def test_a_point_is_two_numbers_and_names_are_told_apart_by_commas():
    text = template("four-bar")

    def stated(key, value):
        return answer(text, "set", fields={key: value})

    rows = rows_of(answer(text))
    point = rows["links.coupler.points.P[2]"]
    assert [point[one] for one in ("name", "value", "number", "unit")] == ["P, y", "40 mm", 40.0, "mm"]
    assert rows["links.coupler.joins"]["value"] == "A, B"
    assert 'P = ["80 mm", "45 mm"]' in stated("links.coupler.points.P[2]", "45")["text"]
    assert 'joins = ["B", "A"]' in stated("links.coupler.joins", "B, A")["text"]
    for key, wrong in (("links.coupler.joins", "A B"), ("links.coupler.points.P[1]", "8 mn")):
        assert stated(key, wrong)["refusals"][0]["key"] == key
    assert "C =" not in answer(text, "without", key="fixed_points.C[1]")["text"]


def test_what_is_refused_is_told_as_the_command_line_tells_it():
    failures = []
    for language in ("en", "ru", "vi"):
        for value in ("-3 mm", "0 mm", "", "abc", "1.7 cms", "1.7.0 cm"):
            asked = {"do": "set", "text": template("engine"), "fields": {"crank.radius": value}, "figures": None}
            found = Session(language, Path("machine.toml")).answer(asked)
            with pytest.raises(crankwork.InputError) as error:
                crankwork.read_machine(found["text"], "machine.toml")
            lines = error.value.lines(lambda one, language=language: in_language(one, language))
            line = found["text"].splitlines()[found["refusals"][0]["line"] - 1]
            if (
                [one["text"] for one in found["refusals"]] != lines
                or not line.startswith(f'radius = "{value}"')
                or "data" in found
                or "form" not in found
            ):
                failures.append((language, value, found["refusals"]))
    assert failures == []


NO_KEY_MAY_STATE = (
    ("four-bar", "crank", 1), ("four-bar", "links", 0), ("four-bar", "links.rocker", "x"),
    ("four-bar", "links.coupler.points", -1), ("four-bar", "links.coupler.joins", []), ("four-bar", "sliders", [1]),
    ("four-bar", "fixed_points", [["0 mm", "0 mm"]]), ("four-bar", "crank.pin", ["a", "b"]),
    ("four-bar", "crank.pivot", {"a": 1}), ("slider-crank", "rod", 0), ("press", "sliders.ram.pin", {}),
)  # fmt: skip


def test_what_no_key_may_state_is_refused_as_the_command_line_refuses_it():
    failures = []
    for name, key, value in NO_KEY_MAY_STATE:
        description = crankwork.Description(template(name))
        description[key] = value
        with pytest.raises(crankwork.InputError) as error:
            description.machine()
        lines = [one.partition(": ")[2] for one in error.value.lines()]
        for asks in ({"do": "show"}, {"do": "set", "fields": {"title": "x"}}, {"do": "add", "key": "masses:"}):
            found = answer(description.dump(), **asks)["refusals"]
            if [one["text"].partition(": ")[2] for one in found] != lines:
                failures.append((name, key, asks["do"], found))
    assert failures == []


def test_a_length_without_a_space_is_a_length():
    text = template("four-bar").replace('"62.5 mm"', '"62.5mm"').replace('"112.5 mm"', '"112.5mm"')
    found = answer(text)
    assert found["refusals"] == []
    offered = {"weights:", "links:B"} & dict(found["additions"]).keys()
    assert offered
    assert [one for key in offered for one in answer(text, "add", key=key)["refusals"]] == []


def test_what_a_machine_has_not_is_refused_in_words():
    for asks in ({"do": "swap", "key": "B"}, {"do": "set", "fields": {".".join("a" * 300): "1"}}):
        assert answer(template("slider-crank"), **asks)["refusals"][0]["text"], asks


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("press", ("torque", "force", "spring", "weights", "links")),
        pytest.param(
            "press", ("damper", "point", "slider", "process", "friction", "motor", "transient"), marks=pytest.mark.slow
        ),
        ("slider-crank", ("flywheel", "gas", "engine", "bearings", "balance")),
        pytest.param("compressor", ("motor", "transient", "spring", "friction"), marks=pytest.mark.slow),
    ],
)
def test_whatever_is_added_makes_a_machine_that_is_computed(name, kinds):
    text = template(name)
    first = {key.partition(":")[0]: key for key, _ in reversed(answer(text)["additions"])}
    for key in [first[one] for one in kinds]:
        found = answer(text, "add", key=key)
        assert found["refusals"] == [], key
        assert found["added"], key
        assert found["text"].count("#") == text.count("#")


def test_an_engine_with_friction_is_held_by_its_joints_and_states_no_branches():
    found = answer(f'friction.sliders.piston.force = "20 N"\n{template("slider-crank")}')
    assert found["refusals"] == []
    assert found["dyads"] == []
    assert {(one["key"], one["from"], one["to"]) for one in found["handles"]} == {
        ("crank.radius", "joint.O", "joint.A"), ("rod.length", "joint.A", "joint.B"),
    }  # fmt: skip
    parts = found["data"]["film"]
    assert {"joint.O", "joint.A", "joint.B"} <= set(re.findall(r"joint\.[OAB]\b", str(parts)))


def test_friction_is_added_to_pins_that_several_rods_have_by_the_names_of_their_joints():
    text = EXAMPLES["v8-diesel"].read_text("utf-8")
    found = additions(crankwork.Description(text), crankwork.analyse(crankwork.Description(text)))
    (friction,) = (one for one in found if one.name == "friction")
    assert set(friction.fields["friction.pins"]) == {"O", *(f"B{number}" for number in range(1, 9))}
    # an engine that gives power needs no motor
    assert not any(one.name == "motor" for one in found)


def test_values_are_in_the_units_that_the_file_asks_for():
    text = f'units = "imperial"\n{template("slider-crank")}'
    found = answer(text)
    assert found["scales"]["stroke"] == pytest.approx((1 / 0.0254, "in"))
    assert "<td>in" in found["values"]
    assert "<td>mm" not in found["values"]


def test_a_pin_that_is_moved_changes_what_meets_there_and_nothing_else():
    first = drawn()["text"].replace('"60 rpm"', '"90 rpm"').replace('"30 mm"', '"31 mm"')
    moved = drawn(at={"B": (140, 50)}, before=sketch(), text=first)
    rows = {key: row["value"] for key, row in rows_of(moved).items()}
    assert rows["links.2.length"] == "89.4 mm"
    assert rows["links.3.length"] == "70.7 mm"
    assert [rows[f"positions.B[{k}]"] for k in (1, 2)] == ["80 mm", "70 mm"]
    assert (rows["crank.radius"], rows["crank.speed"]) == ("31 mm", "90 rpm")
    assert moved["refusals"] == []


def test_a_pin_that_is_taken_out_takes_its_links_out_of_the_file():
    more = {"1": "OA", "2": "ABD", "3": "BC"}
    first = drawn(more)["text"]
    assert "points" in first
    found = drawn(before=sketch(more), text=first)
    assert "D" not in found["text"]
    assert found["refusals"] == []


@pytest.mark.slow
def test_a_drawn_four_bar_has_its_torque_curve_after_masses_and_a_load():
    found = drawn()
    for key in ("masses:", "torque:3"):
        found = answer(found["text"], "add", key=key, figures=list(found["figures"]))
    assert "torques" in found["names"]
    assert set(found["figures"]) & {"torques", "reduced_inertia"}
    # a bar of 85.4 mm at 5 kg/m, about its middle
    assert rows_of(found)["links.2.mass"]["value"] == "0.43 kg"
    assert rows_of(found)["links.2.inertia"]["value"] == "2.6 kg*cm2"
    assert found["summary"]["driving_torque_max"] > 0
    rubbing = answer(found["text"], "add", key="friction:")
    offered, left = ({key for key, _ in one["additions"]} for one in (found, rubbing))
    assert offered - left == {"friction:", "links:B", "slider:B", "links:A", "slider:A"}


def test_text_that_is_no_toml_is_refused_at_its_line():
    found = answer("[crank]\nradius = 45 mm\n")
    assert [one["line"] for one in found["refusals"]] == [2, 1]
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


def test_files_that_a_text_names_are_read_only_where_that_is_allowed():
    found = answer(MEASURED)
    assert (found["named"], found["refusals"]) == (["/etc/hostname"], [])
    assert Session("en", reads=True).answer({"do": "show", "text": MEASURED, "figures": None})["refusals"] != []
    with pytest.raises(CrankworkError, match="read only if you allow it"):
        Session("en").export(MEASURED, "note.html")
    # nor does any other question read one
    explained = answer(MEASURED, "explain", key="swept_volume")
    assert "read only if you allow it" in explained["refusals"][0]["text"]
    assert answer(MEASURED, "ahead", key="crank.radius") == {}


@pytest.mark.parametrize(
    ("name", "key", "figures", "behind", "stays"),
    [
        ("four-bar", "crank.radius", ["links", "position_plans", "velocity_plan"], ["velocity_plan"], False),
        ("engine", "rod.length", ["kinematics", "pressure", "tolle"], ["tolle"], True),
        ("slider-crank", "crank.speed", ["kinematics"], [], False),
        pytest.param(
            "stephenson-six-bar", "links.coupler.length", ["points", "position_plans"], [], False,
            marks=pytest.mark.slow,
        ),
        ("engine", "rod.length", ["indicator"], [], True),
        pytest.param("petrol-four", "piston.mass", ["piston_forces"], [], False, marks=pytest.mark.slow),
        pytest.param(
            "petrol-four", "rod.ratio", ["indicator", "torque", "crankpin_polar", "main_wear"], ["main_wear"], True,
            marks=pytest.mark.slow,
        ),
        # of the same look on paper, since all of it grows alike
        ("slider-crank", "crank.radius", ["tolle"], ["tolle"], False),
    ],
)  # fmt: skip
def test_what_a_page_calculates_itself_and_what_stays_behind(name, key, figures, behind, stays):
    text = EXAMPLES[name].read_text("utf-8") if name in EXAMPLES else template(name)
    found = answer(text, "ahead", key=key, figures=figures)
    ahead = found["ahead"]
    assert (ahead["behind"], ahead["stays"]) == (behind, stays)
    assert ahead["figures"].keys() == set(figures) - set(behind)
    assert found["steps"].startswith("var steps=")
    assert len(ahead["data"]["sliders"]["values"]) > 5


@pytest.mark.slow
@for_each(
    ("name", "key", "filed", "live"),
    [
        # nothing acts on the way back: where the least torque stands is rounding
        ("toggle-press", "fixed_points.E[2]", ["static_torque_min_angle"], ["pressure_angle_max.D"]),
        # the same 2 % away, as long as the weights are less than the force of the press
        ("press", "crank.speed", ["oil_hole_angle.A"], ["dynamic_torque_max"]),
    ],
)
def test_values_that_may_be_others_elsewhere_are_no_live_ones(name, key, filed, live):
    data = answer(template(name), "ahead", key=key)["ahead"]["data"]["sliders"]
    assert set(filed) <= set(data["filed"])
    assert not set(filed) & data["values"].keys()
    assert set(live) <= data["values"].keys()


@pytest.mark.parametrize(
    ("name", "key", "reach", "trusted"),
    [
        # of a longer crank the mechanism no longer turns
        ("four-bar", "crank.radius", {}, [0.5, 1.25]),
        pytest.param("engine", "crank.speed", {}, [0.5, 2.0], marks=pytest.mark.slow),
        pytest.param("slider-crank", "crank.radius", {}, [0.5, 2.0], marks=pytest.mark.slow),
        # to the ends of the slider, where the page tells them
        ("four-bar", "crank.speed", {"low": "90 rpm", "high": "400 rpm"}, [0.75, 4.0]),
        pytest.param(
            "four-bar", "crank.speed", {"low": "90 kg", "high": "400 rpm"}, [0.5, 2.0], marks=pytest.mark.slow
        ),
    ],
)
def test_steps_are_believed_as_far_as_there_are_machines(name, key, reach, trusted):
    found = answer(template(name), "ahead", key=key, **reach)["ahead"]
    (field,) = found["data"]["sliders"]["fields"]
    assert np.array(found["trusted"]) / field["now"] == pytest.approx(trusted, abs=1e-6)


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
    found = answer(template("four-bar"), "ahead", key="crank.speed", figures=["reduced_inertia"])
    assert found["ahead"]["behind"] == []
    assert len(drawn) > 2


@pytest.mark.parametrize("machine", [False, True])
def test_while_a_number_is_held_no_more_is_drawn_than_is_asked_for(machine, monkeypatch):
    drawn = []
    for name in ("film_of", "inline_film", "form", "values"):
        own = getattr(session, name)
        monkeypatch.setattr(
            session, name, lambda *told, _own=own, _name=name, **more: drawn.append(_name) or _own(*told, **more)
        )
    asked = {"fields": {"crank.radius": "60 mm"}, "figures": ["velocity_plan"], "held": True, "machine": machine}
    found = answer(template("four-bar"), "set", **asked)
    assert found["figures"].keys() == {"velocity_plan"}
    assert drawn == (["film_of", "inline_film"] if machine else [])
    assert ("film" in found) is machine


def test_of_a_number_that_no_browser_follows_nothing_is_made():
    swings = template("four-bar").replace('"62.5 mm"', '"100 mm"')
    for text, key in ((template("engine"), "title"), (template("engine"), "crank.none"), (swings, "crank.radius")):
        assert answer(text, "ahead", key=key) == {}, key


def test_a_value_is_explained_down_to_its_line():
    text = template("engine")
    found = answer(text, "explain", key="swept_volume")["memories"]
    assert found["keys"].keys() == {"swept_volume"}
    bore = next(k for k, line in enumerate(text.splitlines(), start=1) if line.startswith("bore"))
    assert any(f"line {bore}" in node.get("g", "") for node in found["nodes"])


STARTS = {"tables.xlsx": b"PK", "machine.svg": b"<svg", "kinematics.dxf": b"  0", "torque.svg": b"<svg"}
DOCUMENTS = {"page.html": b"<!DOCTYPE", "note.html": b"<!DOCTYPE", "sheets.zip": b"PK"}


@pytest.mark.parametrize("starts", [STARTS, pytest.param(DOCUMENTS, marks=pytest.mark.slow)])
def test_a_machine_is_exported_as_what_its_name_says(starts):
    studio = Session("ru")
    found = {name: studio.export(template("engine"), name).lstrip(b"\xef\xbb\xbf") for name in starts}
    assert {name: data[:9] for name, data in found.items() if not data.startswith((starts[name], b"<?xml"))} == {}
    assert min(map(len, found.values())) > 1000


def test_a_map_is_told_as_it_goes_on_and_ends_where_the_command_line_does():
    shares = []
    text = template("slider-crank")
    asked = {"text": text, "over": {"crank.radius": "40..60 mm"}}
    found = Session("en").run_experiment(asked, shares.append)
    expected = map_text(mapped(crankwork.Description(text), ["crank.radius=40..60 mm"]), "en")
    assert found["text"] == expected
    assert shares == pytest.approx([k / 13 for k in range(1, 14)])
    assert found["figures"]["map.stroke"][1].startswith("<svg")


@pytest.mark.data
def test_designs_are_swept_and_the_best_is_named():
    asked = {
        "text": template("slider-crank"), "over": {"crank.radius": "40..60 mm"}, "count": "64",
        "objectives": {"stroke": "maximise"},
    }  # fmt: skip
    shares = []
    found = Session("en").run_experiment(asked, shares.append)
    assert shares[-1] == 1.0
    assert "119" in found["text"]
    assert found["figures"]


CANNOT_BE_TRIED = (
    {"over": {"crank.radius": "60..40 mm"}},
    {"over": {}},
    {"over": {"x": "1..2"}, "count": "9e9"},
    {"over": {"crank.radius": "40..60 mm"}, "count": "9" * 5000},
    {"text": "crank = 1", "over": {"crank.speed": "1..2 rpm"}},
)


def test_what_cannot_be_tried_is_refused_in_words():
    for asked in CANNOT_BE_TRIED:
        found = Session("en").run_experiment({"text": template("slider-crank"), **asked}, lambda _: None)
        assert found["refusals"], asked
        assert all(";" in one["text"] for one in found["refusals"]), asked


def test_a_trial_that_nobody_waits_for_ends():
    def told(_):
        raise StoppedError

    with pytest.raises(StoppedError):
        Session("en").run_experiment({"text": template("slider-crank"), "over": {"crank.radius": "40..60 mm"}}, told)


@pytest.mark.parametrize(("wide", "width"), [(390, 88), (1440, 140)])
def test_figures_are_as_wide_as_the_window_has_room_for(wide, width):
    found = Session("en").answer({"do": "show", "text": template("four-bar"), "figures": ["links"], "wide": wide})
    assert re.findall(r'viewBox="0 0 (\d+)', found["figures"]["links"]) == [str(width)]
