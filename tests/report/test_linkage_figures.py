"""Drawings and figures of any linkage: parts where the motion says, plans that close, labels in each language."""

from __future__ import annotations

import json
import math
import re
import time
import warnings
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork import analyse, figures, read, read_machine, template
from crankwork.analysis.diagrams import Fluctuation, tangents
from crankwork.analysis.force_plans import force_plans
from crankwork.analysis.lever import zhukovsky_lever
from crankwork.analysis.moving import moving
from crankwork.analysis.plans import accelerations, velocities
from crankwork.analysis.skeleton import skeleton
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.machine import Machine
from crankwork.mechanism.catalog import (
    crank_shaper,
    four_bar,
    scotch_yoke,
    slotted_press,
    stephenson_six_bar,
    toggle_press,
    watt_six_bar,
    whitworth,
)
from crankwork.mechanism.description import linkage_from, mechanism_from
from crankwork.mechanism.mechanism import slider_crank
from crankwork.mechanism.structure import structure
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.report import linkage_plan_figures, linkage_positions
from crankwork.report.drawing import moving_drawing
from crankwork.report.figure_data import figure_title
from crankwork.report.figures import drawings
from crankwork.report.linkage_centrodes import instant_centres
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_energy import speed_curve, wittenbauer
from crankwork.report.linkage_look import Style, axis_title, math_symbol
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.show.moving_svg import moving_svg
from crankwork.show.paper import plain
from crankwork.show.place import Place, placed
from crankwork.show.scene import Drawing, Polyline, extent
from crankwork.show.scene import Text as SceneText
from crankwork.show.svg import svg

ROOT = Path(__file__).parents[2]
SVG = "{http://www.w3.org/2000/svg}"
FRAMES = 24
SHAPER = {
    "fixed_points": {"O": [0.0, 0.0], "B": [0.0, -0.15]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.05, "start": np.pi / 2, "direction": "clockwise"},
    "links": {"lever": {"joins": ["B", "C"], "length": 0.3}, "link": {"joins": ["C", "D"], "length": 0.2}},
    "guides": {"slot": {"link": "lever"}, "bed": {"through": [0.0, 0.14]}},
    "sliders": {"block": {"pin": "A", "guide": "slot"}, "ram": {"pin": "D", "guide": "bed", "mass": 20.0}},
}
TRIAD = {
    "fixed_points": {"O": [0.0, 0.0], "E": [0.2, 0.5], "F": [0.26, 0.4]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.03},
    "positions": {"B": [0.15, 0.03], "C": [0.2, 0.1], "D": [0.2, -0.05]},
    "links": {
        "rod": {"joins": ["A", "B"]},
        "plate": {"joins": ["B", "C", "D"]},
        "arm": {"joins": ["C", "E"]},
        "leg": {"joins": ["D", "F"]},
    },
}
CARRIED = {
    "fixed_points": {"O": [0.0, 0.0], "B": [0.18, 0.0], "E": [0.0, 0.1]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
    "links": {"rod": {"joins": ["A", "C"], "length": 0.2}, "rocker": {"joins": ["B", "C"], "length": 0.12}},
    "guides": {"line": {"link": "rod", "angle": 0.4}, "slot": {"link": "yoke", "angle": 1.3}},
    "sliders": {"yoke": {"guide": "line"}, "block": {"pin": "E", "guide": "slot"}},
}
FIRST = four_bar(0.05, 0.2, 0.12, 0.18)
LINKAGES = {
    "four-bar": four_bar(0.05, 0.2, 0.12, 0.18, coupler_point=(0.1, 0.06)),
    "watt": watt_six_bar(FIRST, (0.08, 0.05), 0.2, 0.15, (0.4, 0.0)),
    "stephenson": stephenson_six_bar(FIRST, (0.1, 0.05), 0.25, 0.15, (0.25, 0.2)),
    "shaper": crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14),
    "whitworth": whitworth(0.05, 0.02, 0.06, 0.3, 0.01),
    "scotch yoke": scotch_yoke(0.05, 1.1),
    "toggle": toggle_press(0.05, 0.3, 0.2, 0.2, (0.35, 0.2)),
    "slotted press": slotted_press(),
    "described shaper": mechanism_from(SHAPER)[0],
    "class III": mechanism_from(TRIAD)[0],
    "carried yoke": mechanism_from(CARRIED)[0],
}


@pytest.fixture(params=LINKAGES, name="linkage")
def _linkage(request):
    return LINKAGES[request.param]


def _film(linkage, **options):
    return moving_drawing(linkage, frames=FRAMES, **options)


def _parts(film, kind):
    """Return the parts of a kind by the rest of their names."""
    return {one.name.partition(".")[2]: one for one in film.parts if one.name.startswith(f"{kind}.")}


def _corners(part, frame):
    (outline,) = part.at(frame if len(part.shift) > 1 else 0)
    return outline.points


def test_joints_are_where_the_motion_says(linkage):
    film, shape = _film(linkage), skeleton(linkage)
    moving = linkage_motion(linkage, CrankGrid.from_degrees(np.arange(FRAMES + 1) * 360 / FRAMES))
    joints = _parts(film, "joint")
    pivot = next(name for name, at in shape.pivots.items() if at == linkage.crank.pivot)
    centre, pin = joints[pivot].shift, joints[linkage.crank.pin].shift
    scale = np.hypot(*(pin - centre).T).mean() / linkage.crank.radius
    expected = {name: at for name, at in moving.points.items() if name in shape.letters and name not in shape.pivots}
    assert joints.keys() == {*expected, *shape.pivots}
    for name, point in expected.items():
        place = np.column_stack([point.x.position, point.y.position]) - linkage.crank.pivot
        np.testing.assert_allclose(joints[name].shift - centre, scale * place, atol=1e-6)


def test_links_keep_their_length_and_end_in_their_joints(linkage):
    film, shape = _film(linkage), skeleton(linkage)
    joints = {name: np.broadcast_to(one.shift, (FRAMES + 1, 2)) for name, one in _parts(film, "joint").items()}
    for name, link in _parts(film, "link").items():
        member = shape.member(name.rpartition(".")[0])
        for frame in (0, 5, 11, 20):
            nodes = _corners(link, frame)
            ends = [one for one in member.points if np.hypot(*(nodes - joints[one][frame]).T).min() < 1e-6]
            assert len(ends) >= min(1, len(member.points)), name
            assert np.hypot(*(nodes[1] - nodes[0])) == pytest.approx(
                np.hypot(*np.diff(_corners(link, 0)[:2], axis=0)[0])
            )


def test_every_link_is_drawn_and_numbered(linkage):
    film, shape = _film(linkage), skeleton(linkage)
    names = [one.name.split(".") for one in film.parts]
    assert {one.name for one in shape.members} <= {one[1] for one in names if one[0] in {"link", "slot", "block"}}
    written = [one.items[0].text for one in _parts(film, "text").values()]
    assert sorted(int(one) for one in written if one.isdecimal()) == list(range(len(shape.members) + 1))


def test_blocks_stay_in_their_slots(linkage):
    film, shape = _film(linkage), skeleton(linkage)
    slots = {name.rpartition(".")[0]: one for name, one in _parts(film, "slot").items()}
    for name, block in _parts(film, "block").items():
        guide = shape.member(name).guide
        if guide.link:
            slot = slots[guide.link]
            turn = np.radians(slot.turn)
            along = np.sum((block.shift - slot.shift) * np.column_stack([np.cos(turn), np.sin(turn)]), axis=1)
            assert np.all(np.abs(along) < 0.96 * slot.items[0].points[:, 0].max())


def test_nothing_leaves_the_picture(linkage):
    film = _film(linkage)
    for frame in range(0, FRAMES, 5):
        drawn = film.still(frame)
        for one in map(extent, drawn.items):
            assert one.left >= 0
            assert one.bottom >= 0
            assert one.right <= drawn.width
            assert one.top <= drawn.height


def test_a_drawing_is_small_quick_to_read_and_the_same_every_time(linkage):
    text = moving_svg(_film(linkage))
    assert text == moving_svg(_film(linkage))
    assert len(text) < 70_000


def test_numbers_follow_the_formula_of_structure():
    found, _ = structure(linkage_from(SHAPER)[0])
    members = skeleton(LINKAGES["described shaper"], found.links).members
    assert {one.name: one.number for one in members} == {"crank": 1, "lever": 2, "link": 3, "block": 4, "ram": 5}
    machine = Machine(LINKAGES["described shaper"], 10.0, linkage=linkage_from(SHAPER)[0])
    assert "4 – block" in _film(machine).about


def test_points_keep_the_names_of_the_owner_and_catalog_points_get_letters():
    assert skeleton(LINKAGES["class III"]).letters == {name: name for name in "OABCDEF"}
    letters = skeleton(LINKAGES["slotted press"]).letters
    assert list(letters.values()) == ["O", "A", "B", "C", "D", "S2", "S3"]
    assert set(skeleton(slider_crank(0.05, 0.2)).letters.values()) == {"O", "A", "B"}


@pytest.mark.parametrize("degrees", [20.0, 100.0, 215.0, 340.0])
def test_plans_close(linkage, degrees):
    moved = moving(linkage, [degrees])
    speed, second = 12.0, -35.0
    plans = velocities(linkage, moved, 0, speed), accelerations(linkage, moved, 0, speed, second)
    for plan in plans:
        nodes = [np.zeros(2), *plan.nodes.values()]
        size = max(np.hypot(*one) for one in nodes)
        ends = {}
        for vector in plan.vectors:
            if vector.kind in {"normal", "coriolis"}:
                ends[vector.of] = vector.end
            elif vector.of in ends:
                np.testing.assert_allclose(vector.start, ends[vector.of], atol=1e-9 * size)
            if vector.kind not in {"normal", "coriolis"}:
                assert min(np.hypot(*(vector.end - one)) for one in nodes) < 1e-9 * size
    _check_directions(linkage, moved, *plans)


def _check_directions(linkage, moved, velocity, acceleration):
    """Relative velocities stand across their links, normal parts lie along them, tangential parts across."""
    shape = skeleton(linkage)
    at = {letter: _place(moved, shape, name) for name, letter in shape.letters.items()}
    for plan in (velocity, acceleration):
        for one in plan.vectors:
            pair = next(((b, a) for a in at for b in at if a != b and one.of == b + a), None)
            if pair is None or one.kind not in {"relative", "normal", "tangential"}:
                continue
            bar, vector = at[pair[0]] - at[pair[1]], one.end - one.start
            along, across = bar @ vector, bar[0] * vector[1] - bar[1] * vector[0]
            size = max(1.0, np.abs(vector).max()) * np.hypot(*bar)
            if one.kind == "normal":
                assert abs(across) < 1e-9 * size
                assert along <= 1e-12
            else:
                assert abs(along) < 1e-9 * size


def _place(moved, shape, name):
    if name in shape.pivots:
        return np.array(shape.pivots[name])
    return moved.points[name].place[0]


def test_sliding_goes_along_the_slot_and_coriolis_across():
    linkage = LINKAGES["shaper"]
    moved = moving(linkage, [60.0])
    lever = moved.frames["lever"]
    along = lever.along[0]
    plan = accelerations(linkage, moved, 0, 10.0, 5.0)
    by_kind = {one.kind: one.end - one.start for one in plan.vectors if one.of == "AA2"}
    assert by_kind["coriolis"] @ along == pytest.approx(0, abs=1e-12)
    assert by_kind["sliding"] @ [-along[1], along[0]] == pytest.approx(0, abs=1e-12)
    (slip,) = (one for one in velocities(linkage, moved, 0, 10.0).vectors if one.of == "AA2")
    turning = float(lever.angle_1[0]) * 10
    assert np.hypot(*by_kind["coriolis"]) == pytest.approx(2 * abs(turning) * slip.length)


def test_crank_pin_moves_with_the_rotation():
    plan = velocities(FIRST, moving(FIRST, [30.0]), 0, 10.0)
    np.testing.assert_allclose(plan.nodes["A"], 0.5 * np.array([-0.5, np.sqrt(0.75)]), atol=1e-12)


DEGREES = np.arange(0.0, 361.0, 2.0)
GRID = CrankGrid.from_degrees(DEGREES)
INERTIA = 2 + 0.6 * np.cos(2 * GRID.angle) + 0.2 * GRID.sin
ENERGY = 120 * GRID.sin + 60 * np.cos(2 * GRID.angle) - 60
WANTED = Fluctuation(10.0, 0.05)


def _figures(linkage, style):
    moved = moving(linkage, [60.0])
    yield position_plans(linkage, style=style)
    yield velocity_plan(linkage, moved, 0, 20.0, style)
    yield acceleration_plan(linkage, moved, 0, 20.0, 30.0, style)


def test_every_linkage_has_its_plans(linkage):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for data in _figures(linkage, Style("ru")):
            assert ET.fromstring(svg(data)).tag == f"{SVG}svg"  # noqa: S314 - our own bytes


def test_plans_are_the_same_every_time_and_differ_by_language():
    linkage = LINKAGES["shaper"]
    made = [[svg(one) for one in _figures(linkage, Style(language))] for language in LANGUAGES]
    assert made[1] == [svg(one) for one in _figures(linkage, Style("ru"))]
    for one, two, three in zip(*made, strict=True):
        assert len({one, two, three}) == 3
    for name in ("position_plans", "velocity_plan", "acceleration_plan", "wittenbauer", "speed"):
        assert len({figure_title(name, language) for language in LANGUAGES}) == 3


def test_tangents_leave_the_curve_on_one_side_and_give_the_flywheel():
    found = tangents(INERTIA, ENERGY, WANTED)
    assert np.all(found.slope_max * INERTIA + found.foot_max + 1e-9 >= ENERGY)
    assert np.all(found.slope_min * INERTIA + found.foot_min - 1e-9 <= ENERGY)
    whole = found.flywheel + INERTIA
    square = (found.foot_max + found.slope_max * -found.flywheel - ENERGY) * -2 / whole
    assert square.max() == pytest.approx(WANTED.mean**2 * (1 + WANTED.delta))
    assert square.min() == pytest.approx(WANTED.mean**2 * (1 - WANTED.delta))


def test_energy_and_speed_figures_differ_by_language():
    made = [svg(wittenbauer(INERTIA, ENERGY, WANTED, DEGREES, Style(language))) for language in LANGUAGES]
    made += [svg(speed_curve(DEGREES, 20 + 0.5 * GRID.sin, Style(language))) for language in LANGUAGES]
    assert len(set(made)) == 6
    assert all(ET.fromstring(one).tag == f"{SVG}svg" for one in made)  # noqa: S314 - our own bytes


def test_curves_take_any_keys():
    columns = {"joint_force.A": 900 * INERTIA, "joint_force.crank_pin": 800 * INERTIA, "crank_torque": ENERGY}
    panels = ["crank_torque", ("joint_force.A", "joint_force.crank_pin")]
    made = {svg(curves(DEGREES, columns, panels, "t", Style(language))) for language in LANGUAGES}
    assert len(made) == 3
    for wrong in (["nothing"], [("crank_torque", "joint_force.A")], []):
        with pytest.raises(CrankworkError):
            curves(DEGREES, columns, wrong, "t")
    with pytest.raises(CrankworkError, match="not_a_row"):
        curves(DEGREES, {"not_a_row.A": INERTIA}, ["not_a_row.A"], "t")


def _texts(drawing: Drawing | bytes) -> list[ET.Element]:
    data = drawing if isinstance(drawing, bytes) else svg(drawing)
    return list(ET.fromstring(data).iter(f"{SVG}text"))  # noqa: S314 - our own bytes


def _said(data: Drawing | bytes) -> list[str]:
    return ["".join(one.itertext()) for one in _texts(data)]


@pytest.mark.parametrize(
    ("language", "title"),
    [
        ("en", "angle of the crank φ, °"),
        ("ru", "угол поворота кривошипа φ, °"),
        ("vi", "góc quay của tay quay α, °"),
    ],
)
def test_the_axis_of_a_linkage_names_its_crank_and_no_crankshaft(language, title):
    grid = CrankGrid.steps(30, 360)
    torque = {"driving_torque": np.sin(grid.angle)}
    assert title in _said(curves(grid.degrees, torque, ["driving_torque"], "torque", Style(language)))
    assert title in _said(speed_curve(grid.degrees, 10 + np.sin(grid.angle), Style(language)))


def test_position_plans_name_the_angle_as_the_language_does():
    for language, sign in (("en", "φ"), ("ru", "φ"), ("vi", "α")):
        assert f"{sign}1 = 30°" in _said(position_plans(FIRST, style=Style(language)))


def test_a_gap_in_a_curve_is_left_open():
    torque = np.where(np.abs(DEGREES - 90) < 1, np.nan, ENERGY)
    tree = ET.fromstring(svg(curves(DEGREES, {"crank_torque": torque}, ["crank_torque"], "t")))  # noqa: S314 - our own bytes
    parts = [one.get("d") for one in tree.iter(f"{SVG}path") if one.get("class") == "crank_torque"]
    assert len(parts) == 2
    assert not any("nan" in one for one in parts)


@pytest.mark.parametrize("name", ["$x^$", r"$\frac{$", "%#{&~^\\$"])
def test_names_with_signs_of_formulas_are_drawn_as_they_stand(name):
    text = template("four-bar").replace('"A"', json.dumps(name))
    drawn = figures(analyse(read_machine(text)))
    assert len(drawn) == 11
    assert any(name in one for one in _said(drawn["joint_forces"]))


def test_a_name_with_dollars_keeps_its_letters_in_legends_and_titles():
    assert plain("$x^$") == r"\$x^\$"
    assert math_symbol("F_$x^$") == r"F \$x^\$"
    row = QUANTITIES["joint_force"]._replace(key="joint_force.$x^$")
    assert axis_title(row, "en").startswith(r"joint force, \$x^\$ R \$x^\$")


def _labelled(monkeypatch, module):
    """Return where the points that a figure names are collected: a list for each call."""
    seen: list[list[str]] = []
    monkeypatch.setattr(module, "label_points", lambda _, points, *__: seen.append([name for name, *_ in points]))
    return seen


def test_a_pole_has_a_letter_of_its_own(monkeypatch):
    seen = _labelled(monkeypatch, linkage_plan_figures)
    known = {**SHAPER, "links": {**SHAPER["links"], "link": {**SHAPER["links"]["link"], "points": {"P": [0.1, 0.02]}}}}
    mechanism = mechanism_from(known)[0]
    velocity_plan(mechanism, moving(mechanism, np.arange(0.0, 361.0, 30.0)), 1, 10.0)
    (names,) = seen
    assert names[0] == "o"
    assert "p" in names
    assert len(set(names)) == len(names)


def test_numbers_of_plans_do_not_grow_with_the_points_of_a_link(monkeypatch):
    seen = _labelled(monkeypatch, linkage_positions)
    points = {f"Q{k}": [0.01 * k, 0.001 * k * k] for k in range(12)}
    known = {**SHAPER, "links": {**SHAPER["links"], "link": {**SHAPER["links"]["link"], "points": points}}}
    position_plans(mechanism_from(known)[0])
    assert len(seen[0]) == 6 * 12


def test_the_foot_of_a_position_plan_stands_over_the_method():
    texts = _texts(position_plans(mechanism_from(SHAPER)[0], style=Style(method="exact")))
    feet = [float(one.get("y")) for one in texts if " = " in "".join(one.itertext())]
    (method,) = (one for one in texts if "".join(one.itertext()) == "exact")
    assert len(feet) == 2
    assert max(feet) < float(method.get("y")) - float(method.get("font-size"))


def test_time_grows_with_the_points_that_are_named_and_not_with_their_square():
    def seconds(count):
        points = {f"Q{k}": [0.1 * math.cos(k), 0.1 * math.sin(2 * k)] for k in range(count)}
        known = {**SHAPER, "links": {**SHAPER["links"], "link": {**SHAPER["links"]["link"], "points": points}}}
        mechanism = mechanism_from(known)[0]
        found = moving(mechanism, np.arange(0.0, 361.0, 30.0))
        started = time.process_time()
        velocity_plan(mechanism, found, 1, 10.0)
        return time.process_time() - started

    seconds(5)
    # eight times the points
    assert seconds(120) < 24 * seconds(15)


@pytest.mark.parametrize("name", ["crank-shaper", "watt-six-bar", "press", "scotch-yoke"])
def test_force_plans_close_and_have_the_joint_forces_of_the_columns(name):
    results = analyse(read_machine(template(name)))
    at = 60.0
    columns = results.columns_at(np.array([at]))
    plans = force_plans(results, at)
    assert len(plans) == len(results.machine.mechanism.dyads) + 1
    for plan in plans:
        largest = max(one.size for one in plan.forces)
        assert np.hypot(sum(one.x for one in plan.forces), sum(one.y for one in plan.forces)) < 1e-9 * largest
        for one in plan.forces:
            key = {"pin": f"joint_force.{one.name}", "guide": f"normal_force.{one.name}"}.get(one.kind)
            if key in columns:
                assert one.size == pytest.approx(abs(float(columns[key][0])), rel=1e-9), key


DRIVEN_SLIDER = """
format = 2
[fixed_points]
O = ["0 mm", "0 mm"]
[guides]
bed = { through = ["0 mm", "10 mm"], angle = "12 deg" }
[driver]
slider = "piston"
start = "180 mm"
law = [{ kind = "3-4-5", to = "220 mm", over = "1 s" }, { kind = "3-4-5", to = "180 mm", over = "1 s" }]
[sliders]
piston = { guide = "bed", pin = "A", mass = "2 kg", centre = ["0 mm", "0 mm"] }
[links]
rod = { joins = ["A", "B"], length = "160 mm", mass = "1 kg", inertia = "0.002 kg*m2", centre = ["60 mm", "0 mm"] }
arm = { joins = ["O", "B"], length = "90 mm", mass = "0.5 kg", inertia = "0.001 kg*m2", centre = ["40 mm", "5 mm"] }
[positions]
B = ["50 mm", "80 mm"]
[[loads]]
kind = "force"
point = "B"
y = "-300 N"
"""


def test_the_plan_of_a_driving_slider_has_the_force_of_its_driver():
    """Load, joint, guide and driver close the polygon; without the driver it gapes by as much as drives."""
    results = analyse(read_machine(DRIVEN_SLIDER))
    for at in (40.0, 200.0):
        *_, plan = force_plans(results, at)
        assert plan.links == ("piston",)
        assert {one.kind for one in plan.forces} == {"load", "pin", "guide", "driver"}
        largest = max(one.size for one in plan.forces)
        assert np.hypot(sum(one.x for one in plan.forces), sum(one.y for one in plan.forces)) < 1e-9 * largest
    assert "link 1" in " ".join(_said(drawings(results)["force_plans"]))


@pytest.mark.parametrize("name", ["press-geometry", "opposed-pistons"])
def test_the_pivot_of_a_crank_has_its_own_name_in_force_plans(name):
    results = analyse(read(ROOT / "examples" / f"{name}.toml"))
    names = {one.name for plan in force_plans(results, 60.0) for one in plan.forces if one.kind == "pin"}
    assert "O" in names
    assert not any("pivot" in one for one in names)


def test_both_sides_of_a_jump_of_a_load_are_drawn():
    """The load of a press ends at a dead position, where the joint force has a jump and no slope."""
    one = drawings(analyse(read_machine(template("press"))))["joint_forces"]
    x, y = one.plots[1].curves["joint_force.D"]
    near = int(np.argmax(np.abs(np.diff(y))))
    assert np.diff(x)[near] == pytest.approx(1e-6, rel=1e-3)


def test_curves_that_fall_together_are_one_line_with_both_names():
    drawn = curves(DEGREES, {"joint_force.A": ENERGY, "joint_force.B": ENERGY * (1 + 1e-4), "joint_force.C": -ENERGY},
                   [["joint_force.A", "joint_force.B", "joint_force.C"]], "t")  # fmt: skip
    lines = {one.name for one in drawn.items if isinstance(one, Polyline) and one.name not in ("", "legend")}
    assert lines == {"joint_force.A", "joint_force.C"}
    assert any("joint force, A; joint force, B" in one.text for one in drawn.items if isinstance(one, SceneText))


def test_a_table_of_a_motion_goes_on_to_the_end_of_its_turn():
    results = analyse(read(ROOT / "examples" / "press.toml"))
    assert results.grid.degrees[-1] == 330
    (plot,) = drawings(results)["torques"].plots
    for x, y in plot.curves.values():
        assert (x[-1], y[-1]) == (360, y[0])


LEVERS = (
    "press-geometry",
    "atkinson",
    "knuckle-press",
    "andrews-squeezer",
    "double-acting-steam",
    "crank-shaper",
)


def _machine(name):
    path = ROOT / "examples" / f"{name}.toml"
    return read(path) if path.exists() else read_machine(template(name))


@pytest.mark.parametrize("name", LEVERS)
def test_the_lever_gives_the_balancing_torque_of_the_joint_forces(name):
    results = analyse(_machine(name))
    expected = results.columns["balancing_torque"]
    for at in range(0, len(expected), max(1, len(expected) // 12)):
        found = zhukovsky_lever(results, float(results.grid.degrees[at]))
        # at a dead position no force moves its point
        assert (found.torque if found else 0.0) == pytest.approx(expected[at], abs=1e-9 * np.max(np.abs(expected)))


@pytest.mark.parametrize("name", LEVERS)
def test_forces_and_arms_on_the_lever_balance_on_paper(name):
    """Arms measured from the pole to the lines of the forces, times the forces as told, are the torque."""
    results = analyse(_machine(name))
    one = drawings(results)["zhukovsky_lever"]
    said = [item.text.replace("\xa0", " ") for item in one.items if isinstance(item, SceneText)]
    scale = float(next(re.search(r"= ([\d.]+) ", text)[1] for text in said if "/{μ}_{v} =" in text))
    rows = [text for text in said if ", /{h}_" in text or ", /{p" in text or ", /{ω}_" in text]
    rows = ";   ".join(rows).split(";   ")
    told = {}
    for row in rows:
        for part in row.split(", "):
            name_, _, value = part.partition(" = ")
            told[name_] = value
    equation = next(text for text in said if text.startswith("Σ"))
    equation = " ".join([equation, *(text for text in said if text.startswith(("+ ", "− ")))])
    terms = re.findall(r"([+−=]) ?(−?)(\S+) (\S+)", equation.removesuffix(" = 0"))

    def value(sign):
        text = told[sign.removesuffix("//{μ}_{v}")].replace("−", "-").split()
        return float(text[0]) * (1000.0 if text[1].startswith("kN") else 1.0)

    moment = 0.0
    for before, minus, force, arm in terms:
        size = value(force) * value(arm)
        size *= 1 / scale if arm.endswith("//{μ}_{v}") else 1.0
        moment += -size if "−" in (before, minus) else size
    largest = max(abs(value(force) * value(arm)) for _, _, force, arm in terms if not arm.endswith("/{μ}_{v}"))
    assert abs(moment) < 2e-3 * largest
    at = float(re.search(r", ([\d.]+)°", one.title)[1])
    (torque,) = results.columns_at(np.array([at]))["balancing_torque"]
    shown = next(text for text in said if text.startswith("/{M}_{b}"))
    found = float(re.search(r"= ([−\d.]+) k?N", shown)[1].replace("−", "-"))
    assert found * (1000.0 if " kN" in shown else 1.0) == pytest.approx(torque, rel=1e-4)


@pytest.mark.parametrize("is_sheet", [False, True])
def test_the_angles_of_tangents_are_those_of_round_scales_and_give_the_flywheel(is_sheet):
    """What is measured on paper, with the angles and scales that are printed there, is what the file asks for."""
    results = analyse(read_machine(template("press")))
    with placed(Place(1200.0, 70.0, 20.0, 0.8, is_sheet=True) if is_sheet else Place()):
        one = drawings(results)["wittenbauer"]
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
    assert wheel == pytest.approx(results.summary["flywheel_inertia.wittenbauer"], rel=0.01)
    if not is_sheet:
        text = next(text for text in said if "/{μ}_{J}" in text and "=" in text and "tan" not in text)
        assert [float(found) for found in re.findall(r"= ([\d.]+) ", text)] == pytest.approx([inertia, energy])


@pytest.mark.parametrize("name", ["opposed-pistons", "beta-stirling", "double-acting-steam"])
def test_gas_of_a_linkage_ends_at_its_pistons_and_heads(name):
    """The pistons move as their linkage says, the gas between them is as long as its volume says."""
    results = analyse(read_machine((ROOT / "examples" / f"{name}.toml").read_text("utf-8")))
    film = moving_drawing(results)
    assert "block" in {one.name.partition(".")[0] for one in film.parts}
    pistons, gases = _parts(film, "block"), _parts(film, "gas")
    assert gases.keys() == results.machine.chambers.keys()
    for chamber, one in gases.items():
        faces = results.machine.chambers[chamber].faces
        turn = math.radians(one.turn[0])
        along = np.array([math.cos(turn), math.sin(turn)])
        ends = [one.shift @ along, one.shift @ along + one.stretch]
        sides = []
        for face in faces:
            body = pistons[face.slider]
            length = np.ptp(body.items[0].points[:, 0]) / 2
            sides += [body.shift @ along - length, body.shift @ along + length]
            assert np.ptp(body.items[0].points[:, 1]) == pytest.approx(np.ptp(one.items[0].points[:, 1]))
        for end in ends:
            touches = min(np.abs(end - side).max() for side in sides)
            # within a thousandth of a millimetre at every frame, or a head that stands
            assert touches < 1e-3 or (len(faces) == 1 and np.ptp(end) < 1e-3)
        pressure = results.columns_at(film.angles % 360, [f"gas_pressure.{chamber}"])[f"gas_pressure.{chamber}"]
        assert np.all(np.diff(one.tint[np.argsort(pressure)]) > -1e-9)


@pytest.mark.parametrize("name", ["opposed-pistons", "beta-stirling", "double-acting-steam", "atkinson"])
def test_gas_of_a_linkage_is_darker_the_higher_its_pressure_in_all_its_chambers(name):
    """Of every still: what is filled between pistons, by the pressure that its chamber has at that angle."""
    results = analyse(read_machine((ROOT / "examples" / f"{name}.toml").read_text("utf-8")))
    film = moving_drawing(results)
    keys = [f"gas_pressure.{one}" for one in results.machine.chambers]
    columns = results.columns_at(np.mod(film.angles[:-1], results.machine.cycle), keys)
    seen = []
    for frame in range(0, film.frames, 3):
        fills = [one.fill for one in film.still(frame).items if isinstance(one, Polyline) and one.name == "gas"]
        seen += zip((columns[key][frame] for key in keys), fills, strict=True)
    fill = np.array(sorted(seen))[:, 1]
    assert np.all(np.diff(fill) < 1e-9)
    assert np.ptp(fill) > 0.5
    assert not any("flash" in one.name for one in film.parts)


def test_the_moving_centrode_rolls_on_the_fixed_one():
    """They touch at the instant centre, and where they go together their ways are as long."""
    results = analyse(read_machine(template("four-bar")))
    degrees = np.linspace(20.0, 60.0, 401)
    moved = moving(results.machine.mechanism, degrees)
    fixed, rolling = instant_centres(moved.frames["coupler"], 100)
    columns = results.columns_at(degrees[100:101])
    place = [float(columns[f"instant_centre_{axis}.coupler"][0]) for axis in "xy"]
    assert fixed[100] == pytest.approx(rolling[100])
    assert fixed[100] == pytest.approx(place)
    lengths = [np.hypot(*np.diff(one, axis=0).T) for one in (fixed, rolling)]
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-4)


@pytest.mark.parametrize("name", ["Ω‰→", "a_b^c", "{x}", "點", "x" * 60, "<&>\"'", "Ё ё Ự ợ"])
def test_figures_take_names_with_awkward_letters(name):
    text = template("four-bar").replace('"A"', json.dumps(name, ensure_ascii=False))
    for language in LANGUAGES:
        for one in drawings(analyse(read_machine(text)), language=language).values():
            texts = [item for item in one.items if isinstance(item, SceneText)]
            assert all(np.isfinite(extent(item)).all() for item in texts)
            # the lengths of tables of letters are known for each of them
            assert ET.fromstring(svg(one)).tag == f"{SVG}svg"  # noqa: S314 - our own bytes


def test_a_curve_of_one_point_and_one_of_zeros_are_drawn():
    one = curves(np.array([30.0]), {"crank_torque": np.array([5.0])}, ["crank_torque"], "t")
    none = curves(DEGREES, {"crank_torque": np.zeros(DEGREES.size)}, ["crank_torque"], "t")
    for drawing in (one, none):
        assert b"nan" not in svg(drawing)
        assert b"inf" not in svg(drawing)


@pytest.mark.parametrize(("name", "sliders"), [("opposed-pistons", 2), ("double-acting-steam", 1), ("press-start", 1)])
def test_every_plan_has_its_number_at_the_crank_pin_and_beside_each_guide(name, sliders):
    """Numbers of the way there on one side of a guide, of the way back on the other, none over another one."""
    drawing = drawings(analyse(read(ROOT / "examples" / f"{name}.toml")))["position_plans"]
    texts = [one for one in drawing.items if isinstance(one, SceneText) and re.fullmatch(r"\d+(, \d+)*", one.text)]
    shown = sorted(int(number) for one in texts for number in one.text.split(", "))
    assert shown == sorted([*range(12)] * (1 + sliders))
    boxes = [extent(one) for one in texts]
    for at, one in enumerate(boxes):
        for other in boxes[:at]:
            apart = max(abs(one.left + one.width / 2 - other.left - other.width / 2) - (one.width + other.width) / 2,
                        abs(one.bottom - other.bottom) - (one.height + other.height) / 2)  # fmt: skip
            assert apart > -0.6, (texts[at].text,)


@pytest.mark.parametrize("name", ["velocity_plan", "acceleration_plan", "force_plans"])
def test_plans_tell_the_names_of_the_links_that_they_number(name):
    results = analyse(read(Path(__file__).parents[2] / "examples" / "atkinson.toml"))
    said = [found for one in _said(drawings(results, language="ru")[name]) for found in re.findall(r"\d – (\S+)", one)]
    assert set(said) >= {"coupler", "rocker", "rod"}
