"""Drawings and figures of any linkage: parts where the motion says, plans that close, labels in each language."""

from __future__ import annotations

import json
import math
import re
import time
import warnings
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork import analyse, figures, read_machine, template
from crankwork.analysis.diagrams import Fluctuation, tangents
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
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_energy import speed_curve, wittenbauer
from crankwork.report.linkage_look import Style, axis_title, math_symbol
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.show.paper import plain
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg

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


def _tree(linkage, **options):
    return ET.fromstring(moving_drawing(linkage, frames=FRAMES, **options))  # noqa: S314 - our own text


def _values(element, name, kind="animate"):
    for one in element.findall(f"{SVG}{kind}"):
        if one.get("attributeName") == name:
            return one.get("values").split(";")
    still = element.get(name)
    return [re.sub(r"[a-z()]", "", still)] * (FRAMES + 1)


def _track(element, *names):
    return np.column_stack([np.array(_values(element, name), dtype=float) for name in names])


def _carried(group):
    """Return the corners of what is carried, at each frame."""
    rect = group.find(f"{SVG}rect")
    go = np.array([pair.split() for pair in _values(group, "transform", "animateTransform")], dtype=float)
    turn = np.radians(np.array(_values(rect, "transform", "animateTransform"), dtype=float))
    x, y, w, h = (float(rect.get(name)) for name in ("x", "y", "width", "height"))
    return [
        go + np.column_stack([u * np.cos(turn) - v * np.sin(turn), u * np.sin(turn) + v * np.cos(turn)])
        for u in (x, x + w)
        for v in (y, y + h)
    ]


def _groups(tree, kind):
    return [one for one in tree.iter(f"{SVG}g") if (one.get("class") or "").startswith(f"{kind} ")]


def test_joints_are_where_the_motion_says(linkage):
    tree, shape = _tree(linkage), skeleton(linkage)
    moving = linkage_motion(linkage, CrankGrid.from_degrees(np.arange(FRAMES + 1) * 360 / FRAMES))
    crank = next(one for one in tree.iter(f"{SVG}line") if one.get("class") == f"link {linkage.crank.link}")
    scale = np.hypot(*(_track(crank, "x2", "y2") - _track(crank, "x1", "y1")).T).mean() / linkage.crank.radius
    drawn = [_track(one, "cx", "cy") for one in tree.iter(f"{SVG}circle")]
    expected = {name: at for name, at in moving.points.items() if name in shape.letters and name not in shape.pivots}
    assert len(drawn) == len(expected) + len(shape.pivots)
    for point in expected.values():
        place = scale * np.column_stack([point.x.position, -point.y.position])
        assert min(np.abs(one - place).max() for one in drawn) < 0.2


def test_every_link_is_drawn_and_numbered(linkage):
    tree, shape = _tree(linkage), skeleton(linkage)
    drawn = {(one.get("class") or "").partition(" ")[2] for one in tree.iter() if one.get("class")}
    assert {one.name for one in shape.members} <= drawn
    numbers = sorted(int(one.text) for one in tree.iter(f"{SVG}text") if one.get("class") == "number")
    assert numbers == list(range(len(shape.members) + 1))


def test_blocks_stay_in_their_slots(linkage):
    tree, shape = _tree(linkage), skeleton(linkage)
    slots = {one.get("class").removeprefix("slot "): one for one in _groups(tree, "slot")}
    for block in _groups(tree, "block"):
        guide = shape.member(block.get("class").removeprefix("block ")).guide
        if guide.link:
            outer = np.array(_carried(slots[guide.link]))
            middle = np.mean(_carried(block), axis=0)
            axis = outer[2] - outer[0]
            share = np.sum((middle - outer[0]) * axis, axis=1) / np.sum(axis**2, axis=1)
            assert np.all((share > 0.02) & (share < 0.98))


def test_nothing_leaves_the_picture(linkage):
    tree = _tree(linkage)
    left, top, width, height = map(float, tree.get("viewBox").split())
    reach = [_track(one, *ends) for one in tree.iter(f"{SVG}line") for ends in (("x1", "y1"), ("x2", "y2"))]
    reach += [_track(one, "cx", "cy") + side * 6 for one in tree.iter(f"{SVG}circle") for side in (-1, 1)]
    for one in tree.iter(f"{SVG}text"):
        half = 4.4 * len("".join(one.itertext()))
        shifts = ((-2 * half, -10), (0, 2)) if one.find(f"{SVG}tspan") is not None else ((-half, -10), (half, 2))
        reach += [_track(one, "x", "y") + shift for shift in shifts]
    for one in (*_groups(tree, "slot"), *_groups(tree, "block")):
        reach += _carried(one)
    for one in tree.iter(f"{SVG}polygon"):
        reach += [
            np.array(re.findall(r"-?[\d.]+", text), dtype=float).reshape(-1, 2) for text in _values(one, "points")
        ]
    for one in tree.iter(f"{SVG}path"):
        reach.append(np.array(re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", one.get("d")), dtype=float))
    places = np.vstack(reach)
    assert np.all(places >= [left, top])
    assert np.all(places <= [left + width, top + height])


def test_a_drawing_is_small_quick_to_read_and_the_same_every_time(linkage):
    text = moving_drawing(linkage)
    assert text == moving_drawing(linkage)
    assert "script" not in text
    assert len(text) < 60_000


def test_numbers_follow_the_formula_of_structure():
    found, _ = structure(linkage_from(SHAPER)[0])
    members = skeleton(LINKAGES["described shaper"], found.links).members
    assert {one.name: one.number for one in members} == {"crank": 1, "lever": 2, "link": 3, "block": 4, "ram": 5}
    machine = Machine(LINKAGES["described shaper"], 10.0, linkage=linkage_from(SHAPER)[0])
    assert "4 – block" in _tree(machine).findtext(f"{SVG}desc")
    assert "4 – block" in _tree(LINKAGES["described shaper"], links=found.links).findtext(f"{SVG}desc")


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
    assert len(drawn) == 6
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
