"""Figures of a linkage over its turn: curves, energy and speed, tangents, centrodes."""

from __future__ import annotations

import json
import math
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork import analyse, read_machine, template
from crankwork.analysis.constructions import Fluctuation, tangents
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.report.figures import curves, drawings
from crankwork.report.look import angle_ticks, axis_title, math_symbol
from crankwork.report.motion import instant_centres
from crankwork.show.canvas import ChartLayout, plain, use_layout
from crankwork.show.scene import Polyline, extent
from crankwork.show.scene import Text as SceneText
from crankwork.show.svg import svg
from each import for_each
from looks import said
from shown import figures_of, results_of

SVG = "{http://www.w3.org/2000/svg}"

DEGREES = np.arange(0.0, 361.0, 2.0)

GRID = CrankGrid.from_degrees(DEGREES)

INERTIA = 2 + 0.6 * np.cos(2 * GRID.angle) + 0.2 * GRID.sin

ENERGY = 120 * GRID.sin + 60 * np.cos(2 * GRID.angle) - 60

WANTED = Fluctuation(10.0, 0.05)


def test_tangents_leave_the_curve_on_one_side_and_give_the_flywheel():
    found = tangents(INERTIA, ENERGY, WANTED)
    assert np.all(found.slope_max * INERTIA + found.foot_max + 1e-9 >= ENERGY)
    assert np.all(found.slope_min * INERTIA + found.foot_min - 1e-9 <= ENERGY)
    whole = found.flywheel + INERTIA
    square = (found.foot_max + found.slope_max * -found.flywheel - ENERGY) * -2 / whole
    assert square.max() == pytest.approx(WANTED.mean**2 * (1 + WANTED.delta / 2) ** 2)
    assert square.min() == pytest.approx(WANTED.mean**2 * (1 - WANTED.delta / 2) ** 2)


def test_curves_without_a_key_or_of_different_units_are_refused():
    columns = {"joint_force.A": 900 * INERTIA, "joint_force.crank_pin": 800 * INERTIA, "crank_torque": ENERGY}
    for wrong in (["nothing"], [("crank_torque", "joint_force.A")], []):
        with pytest.raises(CrankworkError):
            curves(DEGREES, columns, wrong, "t")
    with pytest.raises(CrankworkError, match="not_a_row"):
        curves(DEGREES, {"not_a_row.A": INERTIA}, ["not_a_row.A"], "t")


def test_a_gap_in_a_curve_is_left_open():
    torque = np.where(np.abs(DEGREES - 90) < 1, np.nan, ENERGY)
    tree = ET.fromstring(svg(curves(DEGREES, {"crank_torque": torque}, ["crank_torque"], "t")))  # noqa: S314 - our own bytes
    parts = [one.get("d") for one in tree.iter(f"{SVG}path") if one.get("class") == "crank_torque"]
    assert len(parts) == 2
    assert not any("nan" in one for one in parts)


def test_a_name_with_dollars_keeps_its_letters_in_legends_and_titles():
    assert plain("$x^$") == r"\$x^\$"
    assert math_symbol("F_$x^$") == r"F \$x^\$"
    row = QUANTITIES["joint_force"]._replace(key="joint_force.$x^$")
    assert axis_title(row, "en").startswith(r"joint force, \$x^\$ R \$x^\$")


def test_both_sides_of_a_jump_of_a_load_are_drawn():
    """The load of a press ends at a dead position, where the joint force has a jump and no slope."""
    curves_of = {
        key: curve for plot in figures_of("template press")["joint_forces"].plots for key, curve in plot.curves.items()
    }
    x, y = curves_of["joint_force.D"]
    near = int(np.argmax(np.abs(np.diff(y))))
    assert np.diff(x)[near] == pytest.approx(1e-6, rel=1e-3)


def test_equal_chambers_are_one_loop_and_equal_joint_forces_stand_in_one_panel():
    drawn = figures_of("triplex-pump")
    loops = {one.name for one in drawn["indicator"].items if isinstance(one, Polyline)} & {"one", "two", "three"}
    assert loops == {"one"}
    assert drawn["indicator"].plots[0].curves.keys() == {"one", "two", "three"}
    of_pins, of_guides = (plot.curves.keys() for plot in drawn["joint_forces"].plots)
    assert of_pins == {f"joint_force.{name}" for name in ("O", "A1", "A2", "A3", "B1", "B2", "B3")}
    assert len(of_guides) == 3


def test_a_force_is_drawn_as_far_as_its_piece_goes_and_not_at_all_where_it_is_constant():
    """The template of a shaper states one force, which holds from -1 km to 1 km."""
    assert "process_force" not in figures_of("template crank-shaper")
    along = 'at = ["-9 m", "9 m"]\nforce = ["0 kN", "18 kN"]'
    results = analyse(read_machine(template("crank-shaper").replace('force = ["1.2 kN"]', along)))
    ((x, y),) = drawings(results, only=["process_force"])["process_force"].plots[0].curves.values()
    assert np.ptp(x) == pytest.approx(200.0, rel=2e-3)
    # 1 kN for every metre
    assert 1e3 * np.ptp(y) == pytest.approx(np.ptp(x), rel=1e-9)


def test_curves_that_fall_together_are_one_line_with_both_names():
    drawn = curves(DEGREES, {"joint_force.A": ENERGY, "joint_force.B": ENERGY * (1 + 1e-4), "joint_force.C": -ENERGY},
                   [["joint_force.A", "joint_force.B", "joint_force.C"]], "t")  # fmt: skip
    lines = {one.name for one in drawn.items if isinstance(one, Polyline) and one.name not in ("", "legend")}
    assert lines == {"joint_force.A", "joint_force.C"}
    named = [one.text for one in drawn.items if isinstance(one, SceneText) and one.halo]
    assert named == ["/{R}_{A}, /{R}_{B}", "/{R}_{C}"]


def test_a_table_of_a_motion_goes_on_to_the_end_of_its_turn():
    assert results_of("press").grid.degrees[-1] == 330
    (plot,) = figures_of("press")["torques"].plots
    for x, y in plot.curves.values():
        assert (x[-1], y[-1]) == (360, y[0])


@for_each("is_sheet", [False, True])
def test_the_angles_of_tangents_are_those_of_round_scales_and_give_the_flywheel(is_sheet):
    """What is measured on paper, with the angles and scales that are printed there, is what the file asks for."""
    results = results_of("template press")
    with use_layout(ChartLayout(1200.0, 70.0, 20.0, 0.8, is_sheet=True) if is_sheet else ChartLayout()):
        one = drawings(results, only=["wittenbauer"])["wittenbauer"]
    (plot,) = one.plots
    inertia, energy = np.ptp(plot.x) / plot.box.width, np.ptp(plot.y) / plot.box.height
    for scale in (inertia, energy):
        assert f"{scale:.6e}"[:8] in ("1.000000", "2.000000", "5.000000")
    said = [item.text for item in one.items if isinstance(item, SceneText)]
    told = [re.fullmatch(r"/{ψ}_{(max|min)} = ([\d.]+)°; .*", text) for text in said]
    angles = {found[1]: math.radians(float(found[2])) for found in told if found}
    lines = {item.name: item.points for item in one.items if isinstance(item, Polyline) and item.name in angles}
    for name, line in lines.items():
        across, up = line[-1] - line[0]
        assert math.atan2(up, across) == pytest.approx(angles[name], abs=2e-5)
    cut = lines["max"][0, 1] - lines["min"][0, 1]
    foot = next(text for text in said if "kl" in text)
    length, wheel = (float(found) for found in re.findall(r"= ([\d.]+) ", foot))
    assert length == pytest.approx(cut, rel=1e-4)
    assert cut * inertia / (math.tan(angles["max"]) - math.tan(angles["min"])) == pytest.approx(wheel, rel=1e-3)
    assert wheel == pytest.approx(results.summary["flywheel_inertia.exact"], rel=0.01)
    if not is_sheet:
        text = next(text for text in said if "/{μ}_{J}" in text and "=" in text and "tan" not in text)
        assert [float(found) for found in re.findall(r"= ([\d.]+) ", text)] == pytest.approx([inertia, energy])


def test_the_moving_centrode_rolls_on_the_fixed_one():
    """They touch at the instant centre, and where they go together their ways are as long."""
    results = results_of("template four-bar")
    degrees = np.linspace(20.0, 60.0, 401)
    moved = sample_motion(results.machine.mechanism, degrees)
    fixed, rolling = instant_centres(moved.frames["coupler"], 100)
    columns = results.columns_at(degrees[100:101])
    place = [float(columns[f"instant_centre_{axis}.coupler"][0]) for axis in "xy"]
    assert fixed[100] == pytest.approx(rolling[100])
    assert fixed[100] == pytest.approx(place)
    lengths = [np.hypot(*np.diff(one, axis=0).T) for one in (fixed, rolling)]
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-4)


NAMES = (
    "$x^$",
    r"$\frac{$",
    "%#{&~^\\$",
    "Ω‰→",
    "a_b^c",
    "{x}",
    "點",
    "x" * 60,
    "<&>\"'",
    "Ё ё Ự ợ",
    "<b>",
    "u^v",
    "a\\b",
)


@pytest.mark.slow
@for_each(("at", "name"), enumerate(NAMES))
def test_names_with_any_letters_are_printed_as_they_are(at, name):
    text = template("four-bar").replace('"A"', json.dumps(name, ensure_ascii=False))
    wanted = ("joint_forces", "position_plans") if at else None
    found = drawings(analyse(read_machine(text)), language=LANGUAGES[at % 3], only=wanted)
    assert len(found) == (2 if at else 18)
    for one in found.values():
        # the lengths of tables of letters are known for each of them
        assert all(np.isfinite(extent(item)).all() for item in one.items if isinstance(item, SceneText))
        assert ET.fromstring(svg(one)).tag == f"{SVG}svg"  # noqa: S314 - our own bytes
    # a low line is a blank
    assert any(name[:20].replace("_", " ") in one.replace("_", " ") for one in said(found["joint_forces"]))


def test_a_curve_of_one_point_and_one_of_zeros_are_drawn():
    one = curves(np.array([30.0]), {"crank_torque": np.array([5.0])}, ["crank_torque"], "t")
    none = curves(DEGREES, {"crank_torque": np.zeros(DEGREES.size)}, ["crank_torque"], "t")
    for drawing in (one, none):
        assert b"nan" not in svg(drawing)
        assert b"inf" not in svg(drawing)


def test_angles_are_marked_at_round_numbers_of_at_most_a_dozen_parts():
    steps = {12: 1, 24: 2, 60: 5, 120: 10, 180: 15, 360: 30, 720: 60, 1000: 90, 2160: 180, 4000: 360, 30000: 3600}
    assert {span: float(np.diff(angle_ticks(0.0, span))[0]) for span in steps} == steps
    assert angle_ticks(-95.0, 100.0).tolist() == [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0]
