"""Diagrams of pages with sliders: what is seen stands where the machine of these numbers has it, or is pale."""

from __future__ import annotations

import re

import numpy as np
import pytest

import crankwork
from crankwork.page.sliders import LivePage
from crankwork.report.display import displayed
from crankwork.report.figures import drawings
from crankwork.show.canvas import SCREEN, use_layout
from crankwork.study.sliders import moved
from page.slid import design, document, live, move, results, shown


@pytest.mark.slow
def test_columns_and_values_of_another_design_make_its_curves(stored):
    """What a page stores says which column, which value and which factor each curve is."""
    failures, compared = [], {}
    for name in ("crank", "loop"):
        data = stored(document(name, "vi").encode())
        expected = results(name, design(name, crank_radius=48, crank_speed=2000))
        every = drawings(expected, only=set(data["figures"]))
        compared[name] = 0
        for figure, one in data["figures"].items():
            for at, plot in enumerate(one["plots"]):
                for curve, made in plot.get("curves", {}).items():
                    graph = every[figure].plots[at]
                    places = dict(zip("xy", graph.curves[curve], strict=True))
                    angles = type(expected.grid).from_degrees(graph.angles.get(curve, places["x"]))
                    for axis, (key, factor) in made.items():
                        column = (
                            expected.trace[key].value if axis == "level" else expected.columns_at(angles, [key])[key]
                        )
                        wanted = np.ma.masked_invalid(places.get(axis, places["y"]))
                        is_right = np.ma.allclose(factor * column, wanted, rtol=1e-9, atol=1e-9)
                        failures += [] if is_right else [(name, figure, curve, axis)]
                        compared[name] += 1
        for key, (factor, origin, _) in data["sliders"]["values"].items():
            value = expected.summary[key]
            is_right = factor * value + origin == pytest.approx(displayed(key, value), rel=1e-9, abs=1e-9)
            failures += [] if is_right else [(name, key)]
    assert failures == []
    assert compared == {"crank": 34, "loop": 22}


def test_what_polynomials_do_not_follow_is_named_and_links_stand_upon_joints(stored):
    data = stored(document("crank", "vi").encode())
    assert data["sliders"]["filed"] == ["counterweight_angle", "oil_hole_angle.A"]
    plans = ["position_plans", "velocity_plan", "acceleration_plan", "centrodes", "force_plans", "zhukovsky_lever"]
    of_sums = ["crankpin_wear", "main_wear", "torque_harmonics"]
    assert [name for name, one in data["figures"].items() if one.get("filed")] == plans + of_sums
    joints = data["sliders"]["joints"]
    places = ("A", "B", "P", "rocker.centre")
    assert joints["joints"] == {f"joint.{one}": [f"point_x.{one}", f"point_y.{one}"] for one in places}
    assert joints["links"] == {
        "link.crank.1": ["joint.O", "joint.A"],
        "link.coupler.1": ["joint.A", "joint.B", "joint.P"],
        "link.rocker.1": ["joint.C", "joint.B"],
    }
    assert [*joints["labels"].values()] == [
        ["joint.O", 0.0, 12.9], ["joint.A", -4.5, -0.0], ["joint.B", 3.18, -3.18], ["joint.P", -3.18, -3.18],
        ["joint.O", 92.71, 12.9], ["joint.rocker.centre", 3.84, -3.84], ["joint.O", 102.31, 7.2],
    ]  # fmt: skip
    assert [joints["scale"], *joints["origin"]] == pytest.approx([463.5355, 43.24097, 69.84587], rel=1e-5)


def drawn(page, figure, curve):
    """Return the points of a curve that is drawn, shape (2, n). [mm]"""
    path = page.locator(f"[data-figure={figure}] path[data-curve={curve}]").first.get_attribute("d")
    return np.array([[float(one) for one in pair.split()] for pair in re.split("[ML]", path)[1:]]).T


def moved_in_sight(page, at, value):
    """Move a number, look at the forces of the piston, and wait until they are drawn anew."""
    curve = "[data-figure=piston_forces] path[data-curve=piston_force]"
    before = page.locator(curve).first.get_attribute("d")
    move(page, at, value)
    shown(page, "piston_forces")
    page.wait_for_function(
        "([curve, before]) => document.querySelector(curve).getAttribute('d') !== before", arg=[curve, before]
    )


def test_curves_stand_where_the_analysis_has_them_in_scales_that_hold_them(slid):
    page = slid("engine")
    for value in (1000, 5900):
        moved_in_sight(page, 2, value)
        expected = results("engine", design("engine", crank_speed=value))
        figure = page.locator("[data-figure=piston_forces]")
        ticks = figure.locator("g.frame text.de").evaluate_all(
            "all => all.map((one) => [one.textContent, one.getAttribute('y')])"
        )
        up = sorted((float(text.replace("−", "-")), float(y)) for text, y in ticks)
        per_unit = (up[-1][1] - up[0][1]) / (up[-1][0] - up[0][0])
        box = figure.evaluate(
            "one => { const b = one.querySelector('g.frame path').getBBox(); return [b.y, b.height] }"
        )
        for key in ("piston_force", "inertia_force"):
            y = drawn(page, "piston_forces", key)[1]
            assert box[0] - 0.1 <= min(y)
            assert max(y) <= box[0] + box[1] + 0.1
            # the number of a tick stands a little below its line
            for end, extreme in ((min(y), "max"), (max(y), "min")):
                wanted = displayed(key, expected.summary[f"{key}_{extreme}"])
                found = [(up[0][0] + (end + 1.06 - up[0][1]) / per_unit) * unit for unit in (1.0, 1e3)]
                assert min(abs(one - wanted) for one in found) < 0.012 * abs(up[-1][0] - up[0][0]) * 1e3


def test_a_curve_begins_where_its_graph_does_with_its_dot(slid):
    page = slid("engine")
    with use_layout(SCREEN):
        box = drawings(live("engine").results[0], only={"piston_forces"})["piston_forces"].plots[0].box
    moved_in_sight(page, 0, live("engine").sliders[0].shown(live("engine").sliders[0].high))
    x = drawn(page, "piston_forces", "piston_force")[0]
    assert [x[0], x[-1]] == pytest.approx([box.left, box.left + box.width], abs=0.011)
    dots = page.locator("[data-figure=piston_forces] .cursor circle")
    assert dots.count() >= 2
    assert all(one.is_visible() for one in dots.all())


@pytest.mark.slow
def test_a_curve_is_not_taken_for_another_that_it_equals_in_the_designs_compared():
    description = crankwork.Description(crankwork.template("toggle-press"))
    one = moved(description, ["fixed_points.O[1]"], (), crankwork.analyse(description.machine()))
    followed = LivePage(one, "en", only={"links", "sliders"})
    # beyond change points the lower lever parts from the upper one
    levers = {name: made for plot in followed.figure("links")[0] for name, made in plot["curves"].items()}
    assert levers["link_angular_velocity.upper"]["y"][0] == "link_angular_velocity.upper"
    assert "link_angular_velocity.lower" not in levers
    assert followed.figure("sliders")[0] == []


@pytest.mark.slow
def test_a_block_follows_its_pin_where_its_guide_keeps_its_direction():
    description = crankwork.Description(crankwork.template("toggle-press"))
    results = crankwork.analyse(description.machine())
    joints = LivePage(moved(description, ["crank.radius"], (), results), "en").machine()[1]
    assert joints["labels"]["block.ram"] == ["joint.D", 0.0, 0.0]
    assert LivePage(moved(description, ["guides.bed.angle=-92..-88deg"], (), results), "en").machine()[1] is None


def test_curves_of_one_name_in_graphs_side_by_side_follow_each_its_own_or_are_pale(slid):
    page = slid("V8")
    loads = page.locator("[data-figure=main_journal_polar] path[data-curve=load]")
    before = loads.evaluate_all("all => all.map((one) => [one.getAttribute('d'), one.dataset.at ?? ''])")
    assert len(before) == 5
    assert all(at for _, at in before)
    move(page, 0, 300)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    after = loads.evaluate_all("all => all.map((one) => [one.getAttribute('d'), Boolean(one.closest('.faint'))])")
    assert sum(not is_faint for _, is_faint in after) >= 3
    for (was, _), (now, is_faint) in zip(before, after, strict=True):
        assert "NaN" not in now
        assert (was == now) == is_faint


def test_a_diagram_within_another_keeps_its_frame_and_marks_of_scales_go_with_them(slid):
    page = slid("loop")
    marks = page.locator("[data-figure=indicator] text").filter(has_text="BDC")
    titles = page.locator("[data-figure=kinematics] text").filter(has_text="m/s")
    assert titles.count() == 2
    move(page, 0, 66)
    move(page, 1, 2000)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    with use_layout(SCREEN):
        (around, within) = (one.box for one in drawings(live("loop").results[0], only={"indicator"})["indicator"].plots)
    ends = []
    for box, curve in ((around, "diagram_pressure"), (within, "gas_exchange")):
        x = drawn(page, "indicator", curve)[0]
        ends.append([(one - box.left) / box.width for one in (x.min(), x.max())])
    assert ends[1] == pytest.approx(ends[0], abs=5e-3)
    # nor are vectors drawn in two scales
    ticks = [
        page.locator(f"[data-figure=crankpin_polar] g.frame text.{side}").evaluate_all(
            f"all => all.map((one) => [one.textContent.replace('−', '-'), one.getAttribute('{axis}')].map(Number))"
        )
        for side, axis in (("dm", "x"), ("de", "y"))
    ]
    per_unit = [(one[-1][1] - one[0][1]) / (one[-1][0] - one[0][0]) for one in ticks]
    # half a tenth of a millimetre of 46
    assert per_unit[0] == pytest.approx(per_unit[1], rel=1.2e-3)
    assert marks.count() == 1
    shown(page, "indicator")
    assert not marks.is_visible()
    shown(page, "kinematics")
    assert [one.is_visible() for one in titles.all()] == [True, True]


def test_a_level_over_a_cycle_of_another_length_is_pale(slid):
    stated, longer = (live("punch").results[at].machine.cycle for at in (0, 1))
    assert stated != longer
    page = slid("punch")
    before = drawn_levels(page)
    assert before
    move(page, 0, round(live("punch").sliders[0].shown(0.6 * live("punch").sliders[0].now)))
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert [d for d, _ in drawn_levels(page)] == [d for d, _ in before]
    assert all(is_faint for _, is_faint in drawn_levels(page))


def drawn_levels(page):
    return page.locator("path[data-curve=max], path[data-curve=min], path[data-curve=mean]").evaluate_all(
        "all => all.map((one) => [one.getAttribute('d'), Boolean(one.closest('.faint, .filed'))])"
    )
