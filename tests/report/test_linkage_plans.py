"""Plans of a linkage: positions, velocities, accelerations, forces, and the lever that they balance on."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from crankwork import analyse, read_machine
from crankwork.analysis.force_plans import force_plans
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.skeleton import skeleton
from crankwork.analysis.vector_polygons import accelerations, velocities
from crankwork.analysis.zhukovsky_lever import zhukovsky_lever
from crankwork.report import plans
from crankwork.report.figures import drawings
from crankwork.report.forces import _separated_sides
from crankwork.report.look import Style
from crankwork.report.plans import position_plans, velocity_plan
from crankwork.show.canvas import WIDTHS, use_layout
from crankwork.show.scene import Text as SceneText
from crankwork.show.scene import extent
from each import for_each
from linkages import FIRST, LINKAGES, SHAPER, mechanism_from
from looks import said
from shown import figures_of, in_parts, results_of

STIRLING = Path(__file__).parents[2].joinpath("examples", "beta-stirling.toml").read_text("utf-8")


@for_each("name", LINKAGES)
@for_each("degrees", [20.0, 100.0, 215.0, 340.0])
def test_plans_close(name, degrees):
    linkage = LINKAGES[name]
    moved = sample_motion(linkage, [degrees])
    speed, second = 12.0, -35.0
    plans = velocities(linkage, moved, 0, speed), accelerations(linkage, moved, 0, speed, second)
    for plan in plans:
        nodes = [np.zeros(2), *plan.nodes.values()]
        size = max(np.hypot(*one) for one in nodes)
        ends = {}
        for vector in plan.vectors:
            if vector.kind in {"normal", "coriolis"}:
                ends[vector.name] = vector.end
            elif vector.name in ends:
                np.testing.assert_allclose(vector.start, ends[vector.name], atol=1e-9 * size)
            if vector.kind not in {"normal", "coriolis"}:
                assert min(np.hypot(*(vector.end - one)) for one in nodes) < 1e-9 * size
    _check_directions(linkage, moved, *plans)


def _check_directions(linkage, moved, velocity, acceleration):
    """Relative velocities stand across their links, normal parts lie along them, tangential parts across."""
    shape = skeleton(linkage)
    at = {letter: _place(moved, shape, name) for name, letter in shape.letters.items()}
    for plan in (velocity, acceleration):
        for one in plan.vectors:
            pair = next(((b, a) for a in at for b in at if a != b and one.name == b + a), None)
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
    moved = sample_motion(linkage, [60.0])
    lever = moved.frames["lever"]
    along = lever.along[0]
    plan = accelerations(linkage, moved, 0, 10.0, 5.0)
    by_kind = {one.kind: one.end - one.start for one in plan.vectors if one.name == "AA2"}
    assert by_kind["coriolis"] @ along == pytest.approx(0, abs=1e-12)
    assert by_kind["sliding"] @ [-along[1], along[0]] == pytest.approx(0, abs=1e-12)
    (slip,) = (one for one in velocities(linkage, moved, 0, 10.0).vectors if one.name == "AA2")
    turning = float(lever.angle_1[0]) * 10
    assert np.hypot(*by_kind["coriolis"]) == pytest.approx(2 * abs(turning) * slip.length)


def test_crank_pin_moves_with_the_rotation():
    plan = velocities(FIRST, sample_motion(FIRST, [30.0]), 0, 10.0)
    np.testing.assert_allclose(plan.nodes["A"], 0.5 * np.array([-0.5, np.sqrt(0.75)]), atol=1e-12)


def test_position_plans_name_the_angle_as_the_language_does():
    for language, sign in (("en", "φ"), ("ru", "φ"), ("vi", "α")):
        assert f"{sign}1 = 30°" in said(position_plans(FIRST, style=Style(language)))


def _labelled(monkeypatch, module):
    """Return where the points that a figure names are collected: a list for each call."""
    seen: list[list[str]] = []
    monkeypatch.setattr(module, "label_points", lambda _, points, *__: seen.append([name for name, *_ in points]))
    return seen


def test_a_pole_has_a_letter_of_its_own(monkeypatch):
    seen = _labelled(monkeypatch, plans)
    known = {**SHAPER, "links": {**SHAPER["links"], "link": {**SHAPER["links"]["link"], "points": {"P": [0.1, 0.02]}}}}
    mechanism = mechanism_from(known)[0]
    velocity_plan(mechanism, sample_motion(mechanism, np.arange(0.0, 361.0, 30.0)), 1, 10.0)
    (names,) = seen
    assert names[0] == "o"
    assert "p" in names
    assert len(set(names)) == len(names)


def test_numbers_of_plans_do_not_grow_with_the_points_of_a_link(monkeypatch):
    seen = _labelled(monkeypatch, plans)
    points = {f"Q{k}": [0.01 * k, 0.001 * k * k] for k in range(12)}
    known = {**SHAPER, "links": {**SHAPER["links"], "link": {**SHAPER["links"]["link"], "points": points}}}
    position_plans(mechanism_from(known)[0])
    assert len(seen[0]) == 6 * 12


@for_each("name", ["crank-shaper", "watt-six-bar", "press", "scotch-yoke"])
def test_force_plans_close_and_have_the_joint_forces_of_the_columns(name):
    results = results_of(f"template {name}")
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


@for_each("name", ["press-geometry", "knuckle-press", "andrews-squeezer"])
def test_drawn_force_plans_are_closed_but_for_vectors_that_coincide(name):
    """Every vector starts where the one before it ends; only what would lie on another one is set aside."""
    results = results_of(name)
    for at in (30.0, 75.0, 210.0):
        for plan in force_plans(results, at):
            corners = np.vstack([np.zeros(2), np.cumsum([(one.x, -one.y) for one in plan.forces], axis=0)])
            span = np.ptp(corners, axis=0).max()
            if not span:
                continue
            corners *= 150.0 / span
            sides = np.array(_separated_sides(corners))
            assert np.hypot(*(sides[:, 1] - sides[:, 0]).sum(axis=0)) < 1e-6
            for index, (side, corner) in enumerate(zip(sides, corners, strict=False)):
                if np.any(side[0] != corner):
                    # set aside by more than a line's width: then it is level with another one at both ends
                    assert any(_angle(side, other) < 2.0 for k, other in enumerate(sides) if k != index)


def _angle(first, second):
    """Return the angle between two sides. [deg]"""
    (a, b), (c, d) = first[1] - first[0], second[1] - second[0]
    size = np.hypot(a, b) * np.hypot(c, d)
    return np.degrees(np.arcsin(min(1.0, abs(a * d - b * c) / size))) if size else 90.0


def test_the_plan_of_links_2_and_3_of_the_press_has_no_gap():
    """At 30 degrees R_A lies near F_3 and not on it, so that it starts where F_3 ends."""
    results = results_of("press-geometry")
    plan = next(plan for plan in force_plans(results, 30.0) if set(plan.links) == {"rod", "rocker"})
    ends = np.cumsum([(one.x, -one.y) for one in plan.forces], axis=0)
    corners = np.vstack([np.zeros(2), ends]) * 200.0 / np.ptp(ends, axis=0).max()
    for side, start, end in zip(_separated_sides(corners), corners, corners[1:], strict=False):
        assert side == pytest.approx(np.array([start, end]))


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
        assert {one.kind for one in plan.forces} == {"inertia", "pin", "guide", "driver"}
        largest = max(one.size for one in plan.forces)
        assert np.hypot(sum(one.x for one in plan.forces), sum(one.y for one in plan.forces)) < 1e-9 * largest
    assert "link 1" in " ".join(said(drawings(results)["force_plans"]))


@for_each("name", ["press-geometry", "opposed-pistons"])
def test_the_pivot_of_a_crank_has_its_own_name_in_force_plans(name):
    results = results_of(name)
    names = {one.name for plan in force_plans(results, 60.0) for one in plan.forces if one.kind == "pin"}
    assert "O" in names
    assert not any("pivot" in one for one in names)


# loads, gas on both sides, a group of class III, weights, and a slot
LEVERS = (["atkinson", "double-acting-steam", "template crank-shaper"],
          ["press-geometry", "knuckle-press", "andrews-squeezer"])  # fmt: skip


@in_parts("name", *LEVERS)
def test_the_lever_gives_the_balancing_torque_of_the_joint_forces(name):
    results = results_of(name)
    expected = results.columns["balancing_torque"]
    for at in range(0, len(expected), max(1, len(expected) // 12)):
        found = zhukovsky_lever(results, float(results.grid.degrees[at]))
        # at a dead position no force moves its point
        assert (found.torque if found else 0.0) == pytest.approx(expected[at], abs=1e-9 * np.max(np.abs(expected)))


@in_parts("name", *LEVERS)
def test_forces_and_arms_on_the_lever_balance_on_paper(name):
    """Arms measured from the pole to the lines of the forces, times the forces as told, are the torque."""
    results, one = results_of(name), figures_of(name, "en")["zhukovsky_lever"]
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


@for_each(("name", "sliders"), [("opposed-pistons", 2), ("double-acting-steam", 1), ("template press", 1)])
def test_every_plan_has_its_number_at_the_crank_pin_and_beside_each_guide(name, sliders):
    """Numbers of the way there on one side of a guide, of the way back on the other, none over another one."""
    drawing = drawings(results_of(name), only=["position_plans"])["position_plans"]
    texts = [one for one in drawing.items if isinstance(one, SceneText) and re.fullmatch(r"\d+(, \d+)*", one.text)]
    shown = sorted(int(number) for one in texts for number in one.text.split(", "))
    assert shown == sorted([*range(12)] * (1 + sliders))
    boxes = [extent(one) for one in texts]
    for at, one in enumerate(boxes):
        for other in boxes[:at]:
            apart = max(abs(one.left + one.width / 2 - other.left - other.width / 2) - (one.width + other.width) / 2,
                        abs(one.bottom - other.bottom) - (one.height + other.height) / 2)  # fmt: skip
            assert apart > -0.6, (texts[at].text,)


def test_a_plan_of_forces_on_one_line_has_its_own_height_in_a_narrow_figure():
    with use_layout(WIDTHS["85"]):
        drawn = drawings(analyse(read_machine(STIRLING)), only={"force_plans"})["force_plans"]
    assert 20.0 < drawn.height < 200.0
