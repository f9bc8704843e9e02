"""Small steps that only their own numbers show: ends of ranges, a bar, a place in a link, a key, a factor."""

from __future__ import annotations

import io
import json
import math
import re
import sys
import tomllib
import zipfile
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import crankwork
from crankwork import cli, files, progress, units
from crankwork.analysis.input_loads import FrictionInput
from crankwork.analysis.motion_range import full_turn_bounds
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.transmission_quality import USUAL, USUAL_PRESSURE
from crankwork.cli.__init__ import studio
from crankwork.cli.options import DoubtfulError, parse_count
from crankwork.cylinders.firing import possible_order
from crankwork.description.machine_file import template
from crankwork.description.shorthand import expanded
from crankwork.formula.traced_value import given
from crankwork.kernel.grid import with_delayed_breakpoints
from crankwork.loads import curves, pressure_processing
from crankwork.locale.numbers import number
from crankwork.mechanism.structure import _longest_loop
from crankwork.mechanism.table_reader import linkage_from
from crankwork.note import material
from crankwork.note.forces import _friction_of_joint
from crankwork.note.options import NoteOptions
from crankwork.note.sheets.sheet import _LAYOUTS
from crankwork.note.wording import Words
from crankwork.page import sliders
from crankwork.report import drawing
from crankwork.report.drawing import moving_drawing
from crankwork.show.formats import gif
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, ChartBox, Text
from crankwork.show.svg import _short_number, moving_svg
from crankwork.show.theme import fill_colours
from crankwork.studio import session, sketch
from crankwork.studio.form import additions, with_addition
from crankwork.study.chunks import Shares, empty_aggregate
from crankwork.study.runner import ExecutionOptions, _Pool, _written
from crankwork.study.sliders import moved
from crankwork.study.study_file import _flat, read_study
from crankwork.study.study_text import found_files
from each import failing


def test_a_count_has_at_most_nine_digits() -> None:
    assert [parse_count(text) for text in ("0", "123456789", "1234567890", "²", "-1", "")] == [0, 123456789, 0, 0, 0, 0]


def test_a_value_in_a_small_unit_is_multiplied_by_a_whole_number() -> None:
    assert [units.from_si(value, "mm") for value in (0.0009, 0.0018, 0.0579)] == [0.9, 1.8, 57.9]


def test_nothing_is_printed_without_a_sign() -> None:
    assert [_short_number(value) for value in (-0.001, 0.0, -0.5, 2.0, 1.257)] == ["0", "0", "-0.5", "2", "1.26"]
    assert [number(value, "en") for value in (-0.0, -1e-9, 123456.7, 1234567.0)] == [
        "0",
        "−10⁻⁹",
        "123457",
        "1.23457·10⁶",
    ]


def test_a_key_that_cannot_be_printed_is_told_in_letters() -> None:
    results = crankwork.analyse(crankwork.read_machine(template("slider-crank")))
    with pytest.raises(crankwork.UnknownKeyError, match=r"no result a\\x07b; list"):
        results.value("a\x07b")


def test_a_bar_is_shown_once_a_second_has_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    # a clock that has run for a long while, and a terminal
    now, screen = [5000.0], io.StringIO()
    screen.isatty = lambda: True  # type: ignore[method-assign]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(progress.sys, "stderr", screen)
    with progress.progress_bar() as told:
        now[0] += 0.9
        told(0.2)
        assert screen.getvalue() == ""
        now[0] += 0.2
        told(0.5)
        assert "50%" in screen.getvalue()
        told(0.75)
        assert "75%" in screen.getvalue()


def test_a_joint_that_is_drawn_has_its_place_along_and_across_its_link() -> None:
    tables = {
        "fixed_points": {"O": [0.0, 0.0], "E": [0.6, 0.1], "F": [0.3, 0.9]},
        "crank": {"pivot": "O", "pin": "A", "radius": math.hypot(0.1, 0.2), "start": math.atan2(0.2, 0.1)},
        # from A to B 0.5 long, in the direction (0.6, 0.8); C lies 0.2 along and 0.1 across
        "positions": {"B": [0.4, 0.6], "C": [0.14, 0.42]},
        "links": {
            "plate": {"joins": ["A", "B", "C"]},
            "arm": {"joins": ["B", "E"], "length": 0.6},
            "leg": {"joins": ["C", "F"], "length": 0.6},
        },
    }
    linkage, problems = linkage_from(tables)
    assert problems == []
    assert linkage.member("plate").points["C"] == pytest.approx((0.2, 0.1), abs=1e-12)


def test_a_method_is_written_out_with_its_gravity(tmp_path) -> None:
    """An engine is written out as a linkage, and what its method states goes with it."""
    path = tmp_path / "my.toml"
    path.write_text(template("engine"), "utf-8")
    method = tomllib.loads(expanded(path, ["method.gravity=9.7 m/s2", "method.weights=true"]))["method"]
    assert (method["gravity"], method["weights"]) == ("9.7 m/s2", True)


@pytest.mark.elsewhere
def test_mechanical_losses_of_a_file_are_in_megapascals() -> None:
    """Kolchin and Demidov: p_M = 0.034 + 0.0113 v_p, at 14.56 m/s by hand 0.198528 MPa."""
    text = template("whole-engine")
    assert text.count("[cycle]") == 1
    machine = crankwork.read_machine(text.replace("[cycle]", "[cycle]\nmechanical_loss = [0.034, 0.0113]"))
    summary = crankwork.analyse(machine).summary
    by_hand = 0.034e6 + 0.0113e6 * summary["mean_piston_speed"]
    assert summary["mechanical_loss_pressure"] == pytest.approx(by_hand, rel=1e-12)


@pytest.mark.elsewhere
def test_gas_left_in_the_clearance_expands_to_the_volume_of_its_polytrope() -> None:
    """V_c (p_2 / p_1)^(1/n), and what is induced is the swept and the clearance volume without it."""
    results = crankwork.analyse(crankwork.read_machine(template("compressor")))
    summary = results.summary
    left = summary["clearance_volume"] * (5.0 / 0.95) ** (1 / 1.25)
    assert summary["expanded_volume"] == pytest.approx(left, rel=1e-9)
    swept = summary["swept_volume"] + summary["clearance_volume"]
    assert summary["induced_volume"] == pytest.approx(swept - left, rel=1e-9)


@pytest.mark.compiled
def test_kernels_that_begin_alike_are_different_kernels(tmp_path, monkeypatch) -> None:
    from crankwork.kernel.compiled import compiled

    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    same = "".join(f"x{number} = {number}\n" for number in range(100))
    assert [compiled(f"{same}y = {number}\n").y for number in (1, 2)] == [1, 2]


def test_workers_are_as_many_as_asked_for_and_none_for_all_processors() -> None:
    from crankwork.cli import _number_of

    assert (_number_of(None, None), _number_of(None, "tcp://here:1"), _number_of("3", None)) == (0, 0, 3)
    assert _number_of("1024", None) == 1024
    for wrong in (("3", "tcp://here:1"), ("1025", None), ("0", None)):
        with pytest.raises(crankwork.CrankworkError):
            _number_of(*wrong)


def test_every_addition_to_a_linkage_states_keys_that_there_are() -> None:
    """One of each kind; each makes a file that is read."""
    description = crankwork.Description(template("four-bar"))
    offered = {one.name: one for one in additions(description, crankwork.analyse(description.machine()))}
    wrong = failing(offered, lambda one: with_addition(description, one).machine())
    assert wrong == {}
    assert {"spring", "damper", "links", "slider"} <= offered.keys()


def test_two_links_that_are_added_stand_beside_the_middle_of_the_path_of_their_point() -> None:
    description = crankwork.Description(template("four-bar"))
    results = crankwork.analyse(description.machine())
    found = {one.target: one for one in additions(description, results) if one.name == "links"}
    assert found
    for point, one in found.items():
        (pivot,) = (places for key, places in one.fields.items() if key.startswith("fixed_points."))
        across, up = (results.column(f"point_{axis}.{point}") for axis in "xy")
        middle = [(ends.min() + ends.max()) / 2e-3 for ends in (across, up)]
        assert float(pivot[1].removesuffix(" mm")) == pytest.approx(middle[1], rel=0.01, abs=0.5), point
        # farther than the point ever is
        assert float(pivot[0].removesuffix(" mm")) - middle[0] > 1e3 * (across.max() - across.min()) / 2, point


def test_a_link_that_is_given_a_mass_has_its_centre_in_the_middle() -> None:
    text = re.sub(r", mass = .*(?= \})", "", template("four-bar"))
    description = crankwork.Description(text)
    (masses,) = (
        one for one in additions(description, crankwork.analyse(description.machine())) if one.name == "masses"
    )
    centres = {key: place for key, place in masses.fields.items() if key.endswith(".centre")}
    assert centres == {"links.coupler.centre": ["87.5 mm", "0 mm"], "links.rocker.centre": ["56.25 mm", "0 mm"]}


def test_colours_of_a_moving_picture_are_others_in_the_dark_for_areas_and_lines() -> None:
    style = moving_svg(moving_drawing(crankwork.read_machine(template("engine")), frames=8), "colour").decode()
    dark = style[style.index("@media (prefers-color-scheme: dark)") :].partition("</style>")[0]
    rules = set(re.findall(r'\[(\w+)="#\w+"\]\{(\w+):#\w+\}', dark))
    assert rules == {("fill", "fill"), ("stroke", "stroke")}


def test_a_view_has_room_around_what_stands_in_it() -> None:
    sketch = SimpleNamespace(
        views=[((1, 2), np.array([1.0, 2.0]), np.array([11.0, 32.0])), ((), np.zeros(2), np.ones(2))]
    )
    ((name, box), (other, _)) = drawing._views(sketch, 100.0, "en")
    room = drawing._AROUND
    assert room > 0
    assert tuple(box) == pytest.approx((1 - room, 100 - 32 - room, 10 + 2 * room, 30 + 2 * room))
    assert "1, 2" in name
    assert name != other


def test_a_loop_has_at_least_four_members() -> None:
    triangle = {"a": {"b", "c"}, "b": {"a", "c"}, "c": {"a", "b"}}
    square = {"a": {"b", "d"}, "b": {"a", "c"}, "c": {"b", "d"}, "d": {"c", "a"}}
    assert [_longest_loop(beside, "a") for beside in (triangle, square)] == [0, 4]


def test_a_port_has_at_most_five_digits() -> None:
    for port in ("065535", "65536", "-1", "x"):
        with pytest.raises(crankwork.CrankworkError, match="--port"):
            studio.main(["absent.toml", "--port", port, "--no-browser"], standalone_mode=False)


def test_an_archive_holds_its_files_whole() -> None:
    packed = session._zipped({"-sheet-1.svg": b"<svg/>", "note.pdf": b"%PDF" * 100})
    with zipfile.ZipFile(io.BytesIO(packed)) as folder:
        assert {name: folder.read(name) for name in folder.namelist()} == {
            "sheet-1.svg": b"<svg/>",
            "note.pdf": b"%PDF" * 100,
        }


def test_a_branch_goes_with_its_joint() -> None:
    description = crankwork.Description(template("four-bar"))
    assert "branch.B" in description
    sketch._delete_removed(description, description.values, description.values)
    assert "branch.B" in description
    sketch._delete_removed(description, description.values, {"crank": description.values["crank"]})
    assert "branch.B" not in description


def test_a_moment_of_a_guide_that_is_rounding_beside_the_torques_is_nothing() -> None:
    columns = {"driving_torque": np.array([10.0, -7.0]), "normal_moment.bed": np.array([1e-15, -3e-16])}
    found = without_rounding(columns, 10.0)
    assert np.array_equal(found["driving_torque"], columns["driving_torque"])
    assert not np.any(found["normal_moment.bed"])


def test_the_first_of_compared_machines_has_solid_lines() -> None:
    assert list(STYLES) == [SOLID, DASHED, DASH_DOT, DOTTED]


def test_a_folder_of_a_study_that_a_full_disk_cannot_hold_is_named(tmp_path, monkeypatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.StudyFolder, "_open", full)
    with pytest.raises(crankwork.CrankworkError, match=rf"^{re.escape(str(tmp_path))}: cannot be written \(no space"):
        files.StudyFolder(tmp_path, b"{}", resume=False)


def test_a_lever_that_would_only_swing_is_refused_with_its_lengths_in_millimetres() -> None:
    with pytest.raises(crankwork.CrankworkError, match=r"the crank \(40 mm\) .* pivot \(50 mm\)"):
        crankwork.whitworth(crank=0.04, pivot_distance=0.05, arm=0.1, link=0.3)


def test_delayed_breaks_are_closed_unless_they_are_more_than_allowed() -> None:
    breaks, delays = np.array([0.0, 360.0]), [360.0 / 11]
    assert np.allclose(with_delayed_breakpoints(breaks, delays, 11), np.arange(12) * 360.0 / 11)
    assert np.array_equal(with_delayed_breakpoints(breaks, delays, 10), breaks)


def test_a_bend_that_vanishes_at_the_end_of_the_range_is_found() -> None:
    ends = -8.0, 8.0
    for root in (ends[1], 1.25, -2.5):
        assert pressure_processing._zero(lambda by, root=root: by - root, *ends) == pytest.approx(root, abs=1e-4)
    assert pressure_processing._zero(lambda by: by * by + 1.0, *ends) is None


def test_abscissas_that_are_remembered_are_found_as_numbers_are() -> None:
    x = np.array([0.0, 10.0, 25.0, 40.0])
    traced = np.empty(4, dtype=object)
    for at, one in enumerate(x):
        traced[at] = given("crank_angle", one)
    at = np.array([5.0, 12.0, 39.0])
    assert curves._interval(traced, at).tolist() == curves._interval(x, at).tolist() == [0, 1, 2]


def test_the_least_number_that_a_machine_may_have_is_one() -> None:
    machine = crankwork.read_machine(template("slider-crank"))
    assert replace(machine, speed=sys.float_info.min).speed == sys.float_info.min
    with pytest.raises(crankwork.CrankworkError, match=r"^speed = 0\.0 cannot be"):
        replace(machine, speed=0.0)


def test_a_title_of_an_axis_is_upright_beside_a_graph_or_below_its_middle() -> None:
    box = ChartBox(left=100.0, bottom=200.0, width=300.0, height=150.0)
    upright = [Text((x, 275.0), "y", 9.0, angle=90.0) for x in (60.0, 110.0)]
    below = [Text((x, y), "x", 9.0) for x, y in ((250.0, 180.0), (130.0, 180.0), (250.0, 260.0))]
    assert [sliders.is_title(one, [box]) for one in (*upright, *below)] == [True, False, True, False, False]


def studied(folder: Path, more: str = ""):
    """Return a study of a crank gear in a folder."""
    (folder / "machine.toml").write_text(template("slider-crank"), "utf-8")
    vary = 'crank.radius = { from = "40 mm", to = "50 mm", steps = 4 }'
    text = f'machine = "machine.toml"\nvalues = "stroke"\n[designs]\ndrawing = "grid"\n[vary]\n{vary}\n{more}'
    return read_study(text, "study.toml", folder=folder)


def test_one_objective_has_no_pareto_set(tmp_path) -> None:
    one = '[objectives]\nstroke = "minimise"\n'
    studies = [studied(tmp_path, text) for text in (one, f'{one}piston_acceleration_max = "minimise"\n')]
    tables = [{name.rpartition("/")[2] for name in found_files(each, empty_aggregate(each))} for each in studies]
    assert "best.stroke.csv" in tables[0] & tables[1]
    assert ["pareto.csv" in each for each in tables] == [False, True]


def test_values_of_a_study_may_stand_in_tables_of_tables() -> None:
    limits = {"joint_force_max": {"A": {"at_most": "5 kN"}, "B": {}}, "stroke": "minimise"}
    assert _flat(limits, is_plain=False) == {
        "joint_force_max.A": {"at_most": "5 kN"}, "joint_force_max.B": {}, "stroke": "minimise",
    }  # fmt: skip


def test_one_worker_is_a_thread_and_several_are_processes(tmp_path) -> None:
    study = studied(tmp_path)
    assert study.angles is None
    assert [_Pool(study, ExecutionOptions(), workers)._by_threads for workers in (1, 2)] == [True, False]


def test_a_figure_of_a_shaft_with_one_crankpin_does_not_say_of_which() -> None:
    titles = []
    for name in ("v-two", "twin"):
        results = crankwork.analyse(crankwork.read(Path(__file__).parent / f"machines/{name}.toml"))
        titles.append(material.Material(results, NoteOptions(full=True, figures=False))._title("crankpin_polar"))
    assert titles[1] == f"{titles[0]}, crankpin\u00a01"


def test_columns_of_a_sheet_are_equally_wide() -> None:
    assert {shares for layouts in _LAYOUTS.values() for shares in layouts if len(set(shares)) > 1} == set()
    assert {sum(shares) for layouts in _LAYOUTS.values() for shares in layouts if len(shares) > 1} == {1.0}


def test_transmission_angles_are_usual_where_pressure_angles_are() -> None:
    assert (USUAL, USUAL_PRESSURE) == ((40.0, 140.0), 50.0)


def test_every_end_has_its_exit_status(monkeypatch) -> None:
    monkeypatch.setattr(cli, "_discard_output", lambda _: None)
    ends = {
        0: None, 1: DoubtfulError("doubtful"), 2: crankwork.CrankworkError("wrong"), 130: KeyboardInterrupt(),
    }  # fmt: skip
    more = {1: BrokenPipeError(), 2: OSError(28, "No space left on device")}
    for code, error in (*ends.items(), *more.items()):

        def commands(error=error, **_: object) -> None:
            if error is not None:
                raise error

        monkeypatch.setattr(cli, "commands", commands)
        assert cli._exit_code() == code, error


def test_sliders_of_a_machine_that_turns_back_are_refused() -> None:
    description = crankwork.Description(template("four-bar"))
    # the shortest and the longest link are together longer than the others: no link turns fully
    description["links.coupler.length"] = "130 mm"
    results = crankwork.analyse(description)
    assert "crank_range" in results.summary
    with pytest.raises(crankwork.CrankworkError, match="turns back at dead positions"):
        moved(description, ["crank.speed"], (), results)


@pytest.mark.elsewhere
def test_what_a_full_turn_needs_of_a_four_bar() -> None:
    """By Grashof: the shortest and the longest link together no longer than the two others, each length by itself."""
    description = crankwork.Description(template("four-bar"))
    shifted = {"fixed_points.O": ["50 mm", "30 mm"], "fixed_points.C": ["250 mm", "30 mm"]}
    description.replace({**shifted, "crank.radius": "60 mm", "links.coupler.length": "130 mm"})
    found = full_turn_bounds(description.machine().mechanism)
    assert [(one.key, one.sign, round(1e3 * one.length, 9)) for one in found] == [
        ("links.coupler.length", "≥", 200 + 60 - 112.5),
        ("links.rocker.length", "≥", 200 + 60 - 130),
        ("crank.radius", "≤", 130 + 112.5 - 200),
    ]


def test_an_offset_that_is_too_large_is_told_in_millimetres() -> None:
    text = template("whole-engine")
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(text.replace("[engine]", '[engine]\noffsets = ["0 mm", "0 mm", "0 mm", "200 mm"]', 1))
    assert re.search(r"crank radius and offset together \(\d+(\.\d+)? \+ 200 mm\)", str(refused.value))


def test_a_film_has_all_its_frames() -> None:
    film = moving_drawing(crankwork.read_machine(template("slider-crank")), frames=8)
    with Image.open(io.BytesIO(gif(film))) as picture:
        assert picture.n_frames == 8
        picture.seek(7)
        picture.load()


def test_areas_are_filled_with_colours() -> None:
    for theme in ("print", "colour", "dark"):
        assert {bool(re.fullmatch("#[0-9a-f]{6}", one)) for one in fill_colours(theme).values()} == {True}, theme


def test_a_study_is_another_one_if_its_end_is(tmp_path) -> None:
    least, most = (studied(tmp_path, f'[objectives]\nstroke = "{way}imise"\n') for way in ("min", "max"))
    assert least.identity["study"] != most.identity["study"]
    assert json.loads(_written(least))["study"] == least.identity["study"]


@pytest.mark.elsewhere
def test_what_two_points_tell_of_the_share_of_a_field() -> None:
    """Saltelli: products of one sample with the other's change, over the variance; two points are enough."""
    values = np.array([[1.0, 2.0, 3.0], [4.0, 2.0, 1.0]])
    shares = Shares.of(values, 0.0)
    first, _, total, _ = shares.indices()
    variance = np.var(values[:, :2])
    assert first == pytest.approx([np.mean(values[:, 1] * (values[:, 2] - values[:, 0])) / variance])
    assert total == pytest.approx([np.mean((values[:, 0] - values[:, 2]) ** 2) / 2 / variance])
    assert Shares.of(values[:1], 0.0).indices() is None


def test_what_rubs_is_written_with_its_values_and_units() -> None:
    joint = FrictionInput("B_upper", {"pin_friction": (0.08, ""), "pin_radius": (0.035, "mm")})
    words = "".join(one if isinstance(one, str) else "*" for one in _friction_of_joint(joint, Words("en")))
    assert words == "B upper: * = 0.08, * = 35\N{NO-BREAK SPACE}mm"


def test_a_law_without_a_start_begins_where_it_ends() -> None:
    text = (Path(__file__).parents[1] / "examples/excavator-boom.toml").read_text("utf-8")
    start = 'start = "1.65 m"\n'
    assert start in text
    laws = [crankwork.read_machine(one).mechanism.driver.law for one in (text, text.replace(start, ""))]
    assert laws[0] == laws[1]


def test_every_other_cylinder_of_an_order_fires_in_the_second_turn() -> None:
    assert possible_order((0.0, 120.0, 240.0), 720.0) == (1, 3, 2)
    assert possible_order((0.0, 120.0, 240.0), 360.0) == (1, 2, 3)


def test_a_folder_that_holds_what_no_run_wrote_is_full(tmp_path) -> None:
    (tmp_path / files.MANIFEST).write_text("{}", "utf-8")
    files._check_empty(tmp_path)
    (tmp_path / "mine.txt").write_text("mine", "utf-8")
    with pytest.raises(crankwork.CrankworkError, match="holds files already"):
        files._check_empty(tmp_path)


def test_a_file_of_the_user_is_kept_up_to_its_limit_and_begun_anew_above_it(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    read = list[str]()
    for length in (8, 9):
        (tmp_path / "crankwork").mkdir(exist_ok=True)
        (tmp_path / "crankwork" / "list").write_text("x" * length, "utf-8")
        files.update_user_file("list", lambda before: read.append(before) or before, limit=8)
    assert read == ["x" * 8, ""]


def test_a_crank_that_reaches_over_the_pivot_of_a_shaper_is_told_in_millimetres() -> None:
    with pytest.raises(crankwork.CrankworkError, match=r"crank \(300 mm\) .* pivot \(250 mm\)"):
        crankwork.crank_shaper(crank=0.3, pivot_distance=0.25, lever=0.6, link=0.3, ram_height=0.2)


def test_a_decimal_comma_does_not_hide_the_mistakes_after_it() -> None:
    with pytest.raises(crankwork.CrankworkError) as told:
        crankwork.Description('[crank]\nradius = 45,5\nspeed = "rapid"\n').machine()
    assert "write 45.5" in str(told.value)
    assert "rapid" in str(told.value)
