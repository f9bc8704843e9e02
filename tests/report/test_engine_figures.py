"""Figures of a whole engine hold the numbers of its results, on the paper where their scales say."""

from __future__ import annotations

import cmath
import functools
import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from crankwork.analysis import Results, analyse
from crankwork.analysis.constructions import brix_points, tangent_ends, tolle_points
from crankwork.cylinders.arrangement import inline, radial, vee
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.machine import Bearings, Drive, Engine
from crankwork.report.figures import diagrams
from crankwork.report.gas import _short
from crankwork.report.look import Drawn, drawn_of
from crankwork.show.canvas import Canvas, fitted_lines, text_width
from crankwork.show.chart import round_ticks
from crankwork.show.label_placement import label_marks
from crankwork.show.svg import svg
from each import for_each
from shown import machine_of, results_of

LAYOUTS = {
    "inline-4": inline(4, (1, 3, 4, 2), spacing=0.12),
    "inline-6": inline(6, (1, 5, 3, 6, 2, 4), spacing=0.12),
    "V8": vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0, spacing=0.12, bank_stagger=0.02),
    "radial": radial(5, master=0),
}
ONE = {
    "kinematics", "brix", "tolle", "pressure", "indicator", "piston_forces", "rod_forces", "crankpin_forces", "torque",
    "crankpin_polar",
}  # fmt: skip
SVG = "{http://www.w3.org/2000/svg}"


class Case(NamedTuple):
    """An engine, and what figures of it are drawn from."""

    results: Results
    drawn: Drawn


def _case(results: Results) -> Case:
    return Case(results, drawn_of(results, "en"))


@functools.cache
def of_layout(layout: str) -> Case:
    """Return an engine of a layout."""
    return _case(_engine(layout))


def _engine(layout: str, /, **changes: object) -> Results:
    machine = machine_of("spark-engine")
    method = replace(machine.method, kinematics="exact", rod="rigid", inertia_rod_ratio=None)
    engine = replace(Engine(LAYOUTS[layout][0], bearings=Bearings(0.06, 0.03)), **changes)
    return analyse(replace(machine, method=method, engine=engine, drive=Drive(fluctuation=0.01)))


def _graphs(engine: Drawn, name: str):
    return diagrams(engine)[name].draw(engine)[1]


def _graph(engine: Drawn, name: str):
    return next(iter(_graphs(engine, name).values()))


@for_each("layout", LAYOUTS)
def test_polar_diagrams_of_the_crankpin_have_its_largest_and_mean_load_around_their_pole(layout):
    results, drawn = of_layout(layout)
    pins = [name for name in diagrams(drawn) if name.startswith("crankpin_polar")]
    for name in pins:
        graph = _graph(drawn, name)
        (x, y), pole = graph.curves["load"], graph.curves["pole"]
        pin = name.rpartition("_")[2] if name != "crankpin_polar" else "1"
        key = f"crankpin_load_max.{pin}" if len(pins) > 1 else "crankpin_load_max"
        assert np.max(np.hypot(x - pole[0], y - pole[1])) == pytest.approx(results.summary[key], rel=1e-12)
    graph = _graph(drawn, "crankpin_polar")
    (x, y), (a, b) = graph.curves["mean"], graph.curves["pole"]
    known = np.isfinite(x)
    mean = float(drawn.shown("crankpin_load", results.listings["bearing_loads"].columns["mean_bearing_load"][0]))
    assert np.hypot(x[known] - a, y[known] - b) == pytest.approx(mean, rel=1e-9)


def test_the_pole_of_one_cylinder_lies_at_the_inertia_force_of_its_big_end():
    results, engine = _case(results_of("spark-engine"))
    masses, solved = results.solved.machine.masses, results.solved
    expected = masses.rod_big_end * float(solved.lengths.crank_radius) * solved.speed**2
    graph = _graph(engine, "crankpin_polar")
    assert graph.curves["pole"][1][0] == pytest.approx(expected)
    np.testing.assert_allclose(graph.curves["load"][1][:-1], engine.columns["radial_force"], atol=1e-9)


def test_the_indicator_diagram_holds_its_named_points_and_the_sharp_one_if_known():
    results, drawn = _case(results_of("spark-engine"))
    graph = _graph(drawn, "indicator")
    named = results.solved.space.diagram.named
    expected = [(pressure - results.solved.space.ambient) / 1e6 for _, pressure in named.values()]
    np.testing.assert_allclose(graph.curves["points"][1], expected)
    assert "theoretical" not in graph.curves


@for_each("layout", LAYOUTS)
def test_cylinders_fire_before_their_largest_torque(layout):
    drawn = of_layout(layout).drawn
    paper, graphs = diagrams(drawn)["total_torque"].draw(drawn)
    graph = graphs["total_torque"]
    for number, torque in enumerate(drawn.diagrams.torques):
        peak = float(drawn.diagrams.degrees[np.argmax(torque)])
        above = [one for one in paper.texts if graph.box.top - 18 < one[2] and one[4] < graph.box.top]
        marks = [(left + right) / 2 for text, left, _, right, _ in above if str(number + 1) in text.split(",")]
        angles = [np.interp(one, [graph.box.left, graph.box.left + graph.box.width], graph.x) for one in marks]
        assert any(0 < (peak - one) % drawn.cycle < 110 for one in angles), (number, peak, angles)


def test_a_number_that_stands_twice_at_a_point_is_written_once():
    paper = Canvas(100.0, 100.0)
    label_marks(paper, [("0", 50.0, 50.0), ("0", 50.0, 50.0), ("6", 50.2, 50.0)])
    assert [text for text, *_ in paper.texts] == ["0, 6"]


def test_names_of_points_are_printable():
    assert [_short(name) for name in ("c1", "точка", "点$", "z_d")] == ["$c_1$", "точка", "点□", "$z_d$"]
    assert [_short(name) for name in ("r", "c'", "c''", "b3'")] == ["$r$", "$c′$", "$c″$", "$b′_3$"]
    assert _short("a" * 40) == f"{'a' * 15}…"


def test_the_big_end_is_pressed_from_below_when_the_rod_pushes():
    # at the largest gas pressure the rod is in compression: crankpin on the rod upward, piston pin on it downward
    engine = of_layout("inline-4").drawn
    for name, sign in (("big_end_polar", 1), ("small_end_polar", -1)):
        graph = _graph(engine, name)
        x, y = graph.curves["load"]
        largest = int(np.argmax(np.hypot(x, y)))
        assert sign * y[largest] > 5 * abs(x[largest])
        assert max(graph.y) == graph.y[1]


@for_each("layout", LAYOUTS)
def test_the_mean_of_the_unrolled_load_is_that_of_the_summary(layout):
    results, drawn = of_layout(layout)
    graph = _graph(drawn, "crankpin_load")
    key = next(key for key in results.summary if key.startswith("mean_crankpin_load"))
    assert graph.curves["mean"][1] == pytest.approx([results.summary[key]] * 2)
    degrees, load = graph.curves["pin_1"]
    # the curve is drawn straight from degree to degree
    assert np.trapezoid(load, degrees) / degrees[-1] == pytest.approx(results.summary[key], rel=1e-4)
    # other cylinders are replayed at the same angles but for rounding
    assert graph.curves["max"][1][0] == pytest.approx(load.max(), rel=1e-14)
    assert graph.curves["min"][1][0] == pytest.approx(load.min(), rel=1e-14)


@for_each("layout", LAYOUTS)
def test_main_journals_share_one_scale(layout):
    results, drawn = of_layout(layout)
    graphs = _graphs(drawn, "main_journal_polar")
    names = [name for name in results.listings["bearing_loads"].names if name.startswith("main_journal.")]
    assert [f"main_journal.{at}" for at in graphs] == names
    assert len({(graph.x, graph.y, graph.box.width, graph.box.height) for graph in graphs.values()}) == 1
    listing = results.listings["bearing_loads"]
    for name, graph in zip(names, graphs.values(), strict=True):
        expected = listing.columns["bearing_load_max"][listing.names.index(name)]
        assert np.max(np.hypot(*graph.curves["load"])) == pytest.approx(expected, rel=1e-9)


@for_each(("layout", "figure"), [(layout, figure) for layout in LAYOUTS for figure in ("crankpin_wear", "main_wear")])
def test_the_wear_ring_is_as_deep_as_the_sums_and_has_its_oil_hole_where_the_summary_says(layout, figure):
    results, drawn = of_layout(layout)
    graphs = _graphs(drawn, figure)
    columns = results.listings[figure].columns
    depths = np.array([1 - np.hypot(*graph.curves["ends"]) for graph in graphs.values()])
    sums = np.array([columns[f"wear_sum.{name}"] for name in graphs])
    np.testing.assert_allclose(depths / depths.max(), sums / sums.max(), atol=1e-12)
    x, y = next(iter(graphs.values())).curves["ends"]
    directions = np.degrees(np.arctan2(x, y)) % 360
    np.testing.assert_allclose(directions, np.degrees(columns["wear_ray_angle"]), atol=1e-9)
    x, y = _graph(drawn, "crankpin_wear").curves["oil_hole"]
    key = next(key for key in results.summary if key.startswith("oil_hole_angle"))
    assert np.arctan2(x[1], y[1]) % (2 * np.pi) == pytest.approx(results.summary[key] % (2 * np.pi), abs=1e-12)


@for_each("layout", LAYOUTS)
def test_the_total_torque_is_the_sum_of_the_cylinders_and_that_of_the_last_journal(layout):
    results, drawn = of_layout(layout)
    curves = _graph(drawn, "total_torque").curves
    each = drawn.diagrams.torques
    assert curves["cylinder_1"][1] == pytest.approx(each[0], abs=1e-9 * np.max(each))
    total = curves["total"][1]
    apart = np.abs(np.sum(each, axis=0) - total)[:-1]
    assert np.max(apart) < 1e-9 * np.max(total)
    assert curves["mean"][1] == pytest.approx([results.summary["mean_torque"]] * 2)
    assert curves["total"][1].max() == pytest.approx(results.summary["total_torque_max"], rel=2e-3)
    throws = {place.throw for place in drawn.results.machine.engine.layout.places}
    assert ("accumulated_torque" in diagrams(drawn)) == (len(throws) > 1)
    if len(throws) > 1:
        graphs = list(_graphs(drawn, "accumulated_torque").values())
        curve = next(iter(graphs[-1].curves.values()))[1]
        assert np.max(np.abs(curve - total)[:-1]) < 5e-5 * np.max(total)
        assert len({graph.y for graph in graphs}) == 1


@for_each("layout", ["inline-4", "inline-6", "V8"])
def test_the_sum_of_tangential_forces_is_that_of_one_cylinder_at_every_firing_angle(layout):
    results, drawn = of_layout(layout)
    degrees = results.grid.degrees
    # Direct sum: every cylinder does at its own crank angle what the first one does
    angles = [(degrees - place.firing_angle) % 720.0 for place in drawn.diagrams.engine.layout.places]
    expected = sum(analysed_alone().columns_at(angle)["tangential_force"] for angle in angles)
    assert results.columns["total_tangential_force"] == pytest.approx(expected, abs=1e-6 * np.max(expected))
    curve = _graph(drawn, "total_tangential_force").curves["total"]
    shown = np.interp(degrees, *curve)
    assert shown == pytest.approx(expected, abs=5e-3 * np.max(expected))
    # no weight: the torque is the sum at the crank radius
    torque = results.columns["total_torque"] / results.summary["crank_radius"]
    assert torque == pytest.approx(expected, abs=1e-6 * np.max(expected))


@functools.cache
def analysed_alone() -> Results:
    """Return the one cylinder of which the engines consist."""
    machine = machine_of("spark-engine")
    method = replace(machine.method, kinematics="exact", rod="rigid", inertia_rod_ratio=None)
    return analyse(replace(machine, method=method))


@for_each("layout", LAYOUTS)
def test_the_energy_spans_the_excess_work_and_the_speed_fluctuates_as_much_as_wanted(layout):
    results, drawn = of_layout(layout)
    graphs = _graphs(drawn, "excess_work")
    energy = graphs["energy"].curves
    work = results.summary["excess_work.mertsalov"]
    assert energy["max"][1][0] - energy["min"][1][0] == pytest.approx(work, rel=1e-9)
    assert energy["energy"][1][-1] == pytest.approx(0.0, abs=1e-9 * work)
    degrees, surplus = graphs["torque"].curves["surplus"]
    assert np.trapezoid(surplus, np.radians(degrees)) == pytest.approx(0.0, abs=2e-2 * work)
    curves = _graph(drawn, "crank_speed").curves
    high, low = curves["max"][1][0], curves["min"][1][0]
    # the mean over the time is not that of the extremes, for which the flywheel is found
    assert 2 * (high - low) / (high + low) == pytest.approx(0.01, rel=3e-3)
    assert curves["speed"][1].max() == pytest.approx(high, rel=1e-5)


@for_each("layout", LAYOUTS)
def test_bars_are_as_high_as_the_listings(layout):
    results, drawn = of_layout(layout)
    columns = results.listings["torque_harmonics"].columns
    bars = _graph(drawn, "torque_harmonics").curves
    np.testing.assert_allclose(bars["one_cylinder"][1], columns["harmonic_amplitude"])
    np.testing.assert_allclose(bars["all_cylinders"][1], columns["total_harmonic_amplitude"])
    balance = results.listings["balance"]
    for panel, graph in _graphs(drawn, "balance_orders").items():
        for name, free in zip(balance.names, balance.columns[f"free_{panel}"], strict=True):
            kind, _, order = name.partition(".")
            drawn_bars = dict(zip(*graph.curves[kind], strict=True))
            assert drawn_bars[float(order or 1)] == pytest.approx(free)


@for_each("layout", LAYOUTS)
def test_phase_stars_have_unit_vectors_of_one_length_and_their_mean(layout):
    drawn = of_layout(layout).drawn
    layout = drawn.diagrams.engine.layout
    graphs = _graphs(drawn, "phase_stars")
    for order, graph in graphs.items():
        x, y = graph.curves["ends"]
        assert np.hypot(x, y) == pytest.approx(1.0, abs=1e-5)
        # vectors by the definition, exp(-i nu theta), x to the right of the reference direction
        star = [cmath.exp(-1j * float(order) * math.radians(place.firing_angle)) for place in layout.places]
        mean = sum(star) / len(star)
        (across,), (up,) = graph.curves["mean"]
        assert (up, across) == pytest.approx((mean.real, mean.imag), abs=1e-9)
        assert len({graph.x, graph.y, *(other.x for other in graphs.values())}) == 1


def test_free_forces_have_loci_as_long_as_their_listing():
    # without free forces, and with forces to and fro along one line, which are a number of each order
    straight = [name for name in ("inline-4", "inline-6") if "balance_ellipses" in diagrams(of_layout(name).drawn)]
    assert straight == []
    twin = vee(2, (1, 2), 60.0, spacing=0.12, uneven=True)[0]
    results, engine = _case(_engine("inline-4", layout=twin, rotating_share=1.0, balance_shafts=(2,)))
    graphs = _graphs(engine, "balance_ellipses")
    balance = results.listings["balance"]
    expected = balance.columns["free_force"][balance.names.index("reciprocating.2")]
    assert np.max(np.hypot(*graphs["2"].curves["before"])) == pytest.approx(expected, rel=1e-9)
    assert np.max(np.hypot(*graphs["2"].curves["after"])) == pytest.approx(
        balance.columns["free_force"][balance.names.index("residual.2")], rel=1e-9
    )


def test_the_pole_of_brix_gives_the_displacement_to_second_order():
    degrees = np.arange(0.0, 361.0, 5.0)
    angle = np.radians(degrees)
    for ratio in (0.05, 0.1, 0.2):
        lengths = SliderCrank(1.0, 1 / ratio)
        sine = ratio * np.sin(angle)
        exact = 1 - np.cos(angle) + (1 - np.sqrt(1 - sine**2)) / ratio
        found = brix_points(lengths, degrees)
        np.testing.assert_allclose(np.hypot(found.across, found.up), 1.0, atol=1e-14)
        assert found.pole.tolist() == pytest.approx([0.0, -ratio / 2], abs=1e-15)
        assert np.max(np.abs(1 - found.up - exact)) < 0.13 * ratio**2


def test_brix_of_an_offset_crank_gear_is_turned():
    lengths, degrees = SliderCrank(1.0, 5.0, 0.15), np.arange(0.0, 361.0, 5.0)
    angle = np.radians(degrees)
    exact = np.sqrt(36 - 0.15**2) - np.cos(angle) - np.sqrt(25 - (np.sin(angle) - 0.15) ** 2)
    turned = np.max(np.abs(1 - brix_points(lengths, degrees).up - exact))
    straight = np.max(np.abs(1 - brix_points(lengths._replace(offset=0.0), degrees).up - exact))
    assert turned < 0.012
    assert straight > 0.025


@for_each("ratio", [0.2, 0.25, 0.31, 0.5])
def test_the_tangents_of_tolle_touch_the_parabola_of_two_terms(ratio):
    points = tolle_points(ratio)
    cosine = np.linspace(1, -1, 2001)
    x, y = 1 - cosine + ratio / 2 * (1 - cosine**2), cosine + ratio * (2 * cosine**2 - 1)
    assert (points.c[1], points.d[1], points.f[1]) == pytest.approx((1 + ratio, ratio - 1, -3 * ratio))
    # E is where CD cuts the axis
    slope = (points.d[1] - points.c[1]) / (points.d[0] - points.c[0])
    assert points.c[1] + slope * points.e[0] == pytest.approx(0.0, abs=1e-15)
    lines = tangent_ends(points.c, points.f, points.d).tolist()
    lines += [[*points.c, *points.f], [*points.f, *points.d]]
    for a, b, c, d in lines:
        above = (y - b) * (c - a) - (x - a) * (d - b)
        # the line touches the curve and never cuts it
        assert above.min() == pytest.approx(0.0, abs=1e-6)
        assert above.min() > -1e-12


def test_round_ticks_are_round_and_inside():
    assert round_ticks(-13.0, 27.0, 5).tolist() == [-10.0, 0.0, 10.0, 20.0]
    assert round_ticks(0.0, 0.3, 4).tolist() == [0.0, 0.1, 0.2, 0.3]


def test_text_is_as_wide_as_its_letters_and_breaks_between_words():
    assert text_width("$M_Σ$ – total", 10.0) == pytest.approx(2 * text_width("$M_Σ$ – total", 5.0))
    lines = fitted_lines("one two three four", 10.0, text_width("three four", 10.0) + 0.1)
    assert lines == ("one two", "three four")


def test_words_of_titles_are_escaped():
    assert b"<title>a &lt; b &amp; c</title>" in svg(Canvas(10, 10).drawing("a < b & c"))
