"""Rounded corners: where the named points lie, how smooth the curve is, and how much work is left."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from crankwork.errors import CrankworkError
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, VolumeAt, solve_diagram
from crankwork.working_cycle.rounding import (
    RoundedDiagram,
    Rounding,
    Timing,
    _filling,
    corners_of,
    rounded_diagram,
    theoretical_work,
)
from each import for_each
from engines import cylinder_volumes

PETROL = {"p_r": 1.18e5, "p_a": 0.85e5, "p_z": 6.2e6, "n1": 1.37, "n2": 1.25}
DIESEL = {"p_r": 1.1e5, "p_a": 0.9e5, "p_z": 8e6, "n1": 1.37, "n2": 1.26, "rho": 1.35}
THEORY = {"petrol": PETROL, "diesel": DIESEL}
RATIOS = {"petrol": 8.5, "diesel": 16.0}
VALVES = Timing(30.0, 8.0, 18.0, 60.0, 55.0, 20.0)
PORTS = Timing(25.0, 8.0, 50.0, 50.0, 62.0, 60.0, 360.0)
BARE = Timing()

SCHOOLS = for_each("school", ["ru", "vi"])
ENGINES = for_each("kind", ["petrol", "diesel"])
OFFSETS = for_each("offset", [0.0, 0.006, -0.006])
TIMINGS = for_each("timing", [VALVES, PORTS], ids=["valves", "ports"])
every_curve = for_each(
    ("school", "kind", "timing", "offset"),
    itertools.product(["ru", "vi"], THEORY, [VALVES, PORTS], [0.0, 0.006, -0.006]),
)


def _space(kind: str = "petrol", offset: float = 0.0) -> tuple[VolumeAt, tuple[float, float]]:
    lengths = SliderCrank(0.04, 0.14, offset)
    clearance = math.pi * 0.08**2 / 4 * lengths.stroke / (RATIOS[kind] - 1)
    return cylinder_volumes(lengths, 0.08, clearance)[0], dead_centres(lengths)


def _rounded(kind="petrol", timing=VALVES, offset=0.0, theory=None, **options) -> RoundedDiagram:
    theory = theory or THEORY[kind]
    if timing.cycle == 360:
        theory = theory | {"p_a": 1.25e5}
    return rounded_diagram(theory, timing, Rounding(**options), *_space(kind, offset))


def _pressure(diagram: IndicatorDiagram, volume_at: VolumeAt, *degrees: float) -> np.ndarray:
    at = np.array(degrees)
    return diagram.pressure(at, volume_at(at))


# --- the curve


@every_curve
def test_the_diagram_is_continuous_and_closed(school, kind, timing, offset):
    diagram = _rounded(kind, timing, offset, school=school).diagram
    volume_at, _ = _space(kind, offset)
    assert diagram.jumps == ()
    edges = [one.start for one in diagram.segments]
    for edge in edges[1:]:
        before, at, after = _pressure(diagram, volume_at, edge - 1e-7, edge, edge + 1e-7)
        assert before == pytest.approx(at, rel=1e-6)
        assert after == pytest.approx(at, rel=1e-6)
    first, last = _pressure(diagram, volume_at, 0.0, timing.cycle)
    assert first == pytest.approx(last, rel=1e-9)


@every_curve
def test_the_curve_has_no_corner_but_where_a_port_closes(school, kind, timing, offset):
    diagram = _rounded(kind, timing, offset, school=school).diagram
    volume_at, _ = _space(kind, offset)
    steepest = 0.0
    breaks = []
    for edge in [*(one.start for one in diagram.segments[1:]), timing.cycle]:
        step = 1e-3
        before = _pressure(diagram, volume_at, edge - 2 * step, edge - step, edge)
        after = _pressure(diagram, volume_at, *(np.array([0, step, 2 * step]) + 1e-9 + edge % timing.cycle))
        left = (3 * before[2] - 4 * before[1] + before[0]) / (2 * step)
        right = -(3 * after[0] - 4 * after[1] + after[2]) / (2 * step)
        steepest = max(steepest, abs(left), abs(right))
        if not (timing.cycle == 360 and edge == pytest.approx(diagram.named["a"][0])):
            breaks.append(abs(right - left))
    assert max(breaks) < 1e-3 * steepest


@every_curve
def test_no_rounded_piece_overshoots_its_points(school, kind, timing, offset):
    diagram = _rounded(kind, timing, offset, school=school).diagram
    for segment in diagram.segments:
        if segment.law == "rounded":
            for (start, low), (end, high) in itertools.pairwise(zip(segment.knots, segment.pressures, strict=True)):
                inside = segment.pressure(np.linspace(start, end, 50), np.empty(50))
                assert np.all(np.diff(inside) * np.sign(high - low) >= -1e-9 * max(low, high))


@ENGINES
@TIMINGS
@OFFSETS
def test_the_greatest_pressure_is_where_it_was_put(kind, timing, offset):
    result = _rounded(kind, timing, offset, peak_angle=13.0, peak_level=0.85)
    volume_at, (top, _) = _space(kind, offset)
    degrees = np.linspace(0.0, timing.cycle, 36001)
    pressure = result.diagram.pressure(degrees, volume_at(degrees))
    p_z = THEORY[kind]["p_z"]
    assert np.max(pressure) == pytest.approx(0.85 * p_z, rel=1e-4)
    expected = (top + 373.0) % timing.cycle
    assert degrees[np.argmax(pressure)] == pytest.approx(expected, abs=0.02)


def test_a_top_dead_centre_just_before_zero_may_be_written_either_way():
    volume_at, (top, bottom) = _space(offset=-0.006)
    one, other = (
        rounded_diagram(PETROL, VALVES, Rounding(), volume_at, (angle, bottom)) for angle in (top, top + 360.0)
    )
    assert top < 0
    assert other.diagram.named["c''"] == pytest.approx(one.diagram.named["c''"], rel=1e-12)


@SCHOOLS
@ENGINES
@for_each("advance", [15.0, 30.0, 45.0])
def test_burning_never_takes_the_pressure_below_the_compression_line(school, kind, advance):
    diagram = _rounded(kind, replace(VALVES, ignition_advance=advance), school=school).diagram
    volume_at, _ = _space(kind)
    theory = THEORY[kind]
    degrees = np.linspace(diagram.named["f"][0], 360.0, 500)
    line = theory["p_a"] * (volume_at(np.array([180.0])) / volume_at(degrees)) ** theory["n1"]
    assert np.all(diagram.pressure(degrees, volume_at(degrees)) > 0.999 * line)


# --- the named points


@OFFSETS
def test_the_points_of_the_russian_school(offset):
    result = _rounded(offset=offset, rise=1.2)
    volume_at, (top, bottom) = _space(offset=offset)
    named = result.diagram.named
    p_c = 0.85e5 * 8.5**1.37
    p_b = 6.2e6 / 8.5**1.25
    angles = {
        "a'": top + 20, "a": bottom, "a''": bottom + 60, "c'": top + 330, "f": top + 338, "c''": top + 360,
        "z_d": top + 372, "b'": bottom + 305, "b''": bottom + 360, "r'": top + 702,
    }  # fmt: skip
    assert {name: named[name][0] for name in named} == pytest.approx(angles, abs=1e-9)
    assert named["c''"][1] == pytest.approx(1.2 * p_c, rel=1e-12)
    assert named["z_d"][1] == pytest.approx(0.85 * 6.2e6, rel=1e-12)
    assert named["b''"][1] == pytest.approx((p_b + 1.18e5) / 2, rel=1e-12)
    assert (named["a"][1], named["a'"][1], named["r'"][1]) == (0.85e5, 0.85e5, 1.18e5)
    on_compression = 0.85e5 * (volume_at(np.array([bottom])) / volume_at(np.array([named["f"][0]]))) ** 1.37
    assert named["f"][1] == pytest.approx(on_compression[0], rel=1e-12)
    on_expansion = 6.2e6 * (volume_at(np.array([top])) / volume_at(np.array([named["b'"][0]]))) ** 1.25
    assert named["b'"][1] == pytest.approx(on_expansion[0], rel=1e-12)


@ENGINES
def test_the_points_of_the_vietnamese_school(kind):
    theory = THEORY[kind]
    result = _rounded(kind, school="vi")
    ratio, level = RATIOS[kind], 0.85 if kind == "petrol" else 1.0
    p_c = theory["p_a"] * ratio ** theory["n1"]
    p_b = theory["p_z"] * (theory.get("rho", 1.0) / ratio) ** theory["n2"]
    named = result.diagram.named
    assert result.peak_level == level
    assert named["c''"][1] == pytest.approx(p_c + (level * theory["p_z"] - p_c) / 3, rel=1e-12)
    assert named["z'"][1] == pytest.approx(level * theory["p_z"], rel=1e-12)
    assert named["b''"][1] == pytest.approx((p_b + theory["p_a"]) / 2, rel=1e-12)


# --- work


@for_each("ratio", [8.0, 8.5, 9.0])
@SCHOOLS
def test_a_petrol_engine_keeps_the_share_that_books_expect(school, ratio):
    lengths = SliderCrank(0.04, 0.14, 0.0)
    clearance = math.pi * 0.08**2 / 4 * 0.08 / (ratio - 1)
    space = cylinder_volumes(lengths, 0.08, clearance)[0], (0.0, 180.0)
    result = rounded_diagram(PETROL, VALVES, Rounding(school), *space)
    assert 0.90 < result.filling_factor < 0.98
    assert result.notices == ()


@ENGINES
@SCHOOLS
@OFFSETS
def test_nothing_is_lost_where_nothing_is_rounded(kind, school, offset):
    result = _rounded(kind, BARE, offset, school=school)
    assert result.filling_factor == pytest.approx(1.0, abs=1e-13)
    shapes = [one.law for one in result.diagram.segments]
    assert "rounded" not in shapes


@ENGINES
@OFFSETS
def test_two_strokes_without_ignition_advance_burn_on_the_vertical_where_the_cycle_begins(kind, offset):
    timing = replace(PORTS, ignition_advance=0.0, ignition_delay=0.0)
    result = _rounded(kind, timing, offset)
    assert result.filling_factor == pytest.approx(1.0, abs=1e-13)
    volume_at, (top, _) = _space(kind, offset)
    before, after = (_pressure(result.diagram, volume_at, (top + aside) % 360)[0] for aside in (-1e-6, 1e-6))
    theory = THEORY[kind]
    assert after == pytest.approx(theory["p_z"], rel=1e-5)
    assert before < 0.6 * after


@ENGINES
def test_a_diagram_written_by_hand_keeps_all_of_the_work(kind):
    volume_at, centres = _space(kind)
    theory = THEORY[kind]
    rho = theory.get("rho", 1.0)
    clearance = float(volume_at(np.array([360.0]))[0])
    low, high = 360.0, 400.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if volume_at(np.array([middle]))[0] < rho * clearance else (low, middle)
    points = {
        "r": DiagramPoint(0.0, theory["p_a"]), "a": DiagramPoint(180.0), "c": DiagramPoint(360.0),
        "y": DiagramPoint(360.0, theory["p_z"]), "z": DiagramPoint(low if rho > 1 else 360.0), "b": DiagramPoint(540.0),
        "o": DiagramPoint(540.0, theory["p_a"]), "end": DiagramPoint(720.0),
    }  # fmt: skip
    pieces = (
        Piece("constant", ("r", "a")), Piece("polytropic", ("a", "c"), theory["n1"]), Piece("constant", ("y", "z")),
        Piece("polytropic", ("z", "b"), theory["n2"]), Piece("constant", ("o", "end")),
    )  # fmt: skip
    diagram = solve_diagram(points, pieces, 720.0, volume_at, dead_centres=centres)
    corners = corners_of(theory, BARE, Rounding(), volume_at, centres)
    assert _filling(corners, diagram) == pytest.approx(1.0, abs=1e-9)


@ENGINES
def test_theoretical_work_is_the_mean_pressure_of_the_books(kind):
    """p_i' = p_c/(eps-1) [lam(rho-1) + lam rho/(n2-1) (1 - delta^(1-n2)) - 1/(n1-1) (1 - eps^(1-n1))]."""
    theory, epsilon = THEORY[kind], RATIOS[kind]
    volume_at, _ = _space(kind)
    n1, n2, rho = theory["n1"], theory["n2"], theory.get("rho", 1.0)
    p_c = theory["p_a"] * epsilon**n1
    lam, delta = theory["p_z"] / p_c, epsilon / rho
    bracket = lam * (rho - 1) + lam * rho / (n2 - 1) * (1 - delta ** (1 - n2)) - (1 - epsilon ** (1 - n1)) / (n1 - 1)
    clearance, largest = volume_at(np.array([360.0, 180.0]))
    work = theoretical_work(theory, volume_at, (180.0, 360.0, 540.0))
    assert work / (largest - clearance) == pytest.approx(p_c / (epsilon - 1) * bracket, rel=1e-12)


@ENGINES
@SCHOOLS
def test_the_filling_factor_is_a_ratio_of_areas(kind, school):
    result = _rounded(kind, school=school)
    volume_at, _ = _space(kind)

    def rate(angle):
        around = volume_at(np.array([angle - 1e-3, angle + 1e-3]))
        return _pressure(result.diagram, volume_at, angle)[0] * (around[1] - around[0]) / 2e-3

    edges = [one for one in result.diagram.breaks if 180 < one < 540]
    area = sum(quad(rate, *pair, epsrel=1e-9)[0] for pair in itertools.pairwise([180.0, *edges, 540.0]))
    theory = THEORY[kind]
    whole = theoretical_work(theory, volume_at, (180.0, 360.0, 540.0))
    assert result.filling_factor == pytest.approx(area / whole, rel=1e-7)


@settings(deadline=None, max_examples=15)
@given(scale=st.floats(0.3, 3.0), school=st.sampled_from(["ru", "vi"]))
def test_scaling_all_pressures_changes_nothing_else(scale, school):
    theory = {name: value * scale if name.startswith("p_") else value for name, value in PETROL.items()}
    one, other = _rounded(school=school), _rounded(theory=theory, school=school)
    assert other.filling_factor == pytest.approx(one.filling_factor, rel=1e-12)
    assert other.diagram.named["f"][1] == pytest.approx(scale * one.diagram.named["f"][1], rel=1e-12)


@pytest.mark.slow
@ENGINES
@SCHOOLS
@TIMINGS
def test_a_wanted_share_is_met_by_the_level_of_the_peak(kind, school, timing):
    wanted = _rounded(kind, timing, school=school, peak_level=0.87).filling_factor
    result = _rounded(kind, timing, school=school, filling_factor=wanted, tolerance=1e-9)
    assert result.filling_factor == pytest.approx(wanted, abs=1e-9)
    assert result.peak_level == pytest.approx(0.87, abs=1e-6)
    assert "round_unreachable" not in {code for code, _ in result.notices}


@for_each(("wanted", "level"), [(0.8, 0.80), (0.999, 0.95)])
def test_a_share_out_of_reach_is_said(wanted, level):
    result = _rounded(filling_factor=wanted)
    [(_, values)] = [one for one in result.notices if one[0] == "round_unreachable"]
    assert values == {"wanted": wanted, "obtained": result.filling_factor, "level": level}
    assert result.peak_level == level


# --- notices and refusals


@for_each(
    ("theory", "options", "code"),
    [
        ({"p_c": 2.0e6}, {}, "round_differs"),
        ({"p_b": 0.3e6}, {}, "round_differs"),
        ({"epsilon": 9.0}, {}, "round_differs"),
        ({}, {"rise": 1.3}, "round_rise"),
        ({}, {"peak_angle": 20.0}, "round_peak"),
        ({}, {"peak_level": 0.99}, "round_filling"),
        ({}, {"peak_level": 0.99}, "round_above"),
    ],
)
def test_what_is_unusual_is_said(theory, options, code):
    assert code in {one for one, _ in _rounded(theory=PETROL | theory, **options).notices}


def test_pressures_that_fit_their_lines_need_no_notice():
    fitting = {"p_c": 0.85e5 * 8.5**1.37, "p_b": 6.2e6 / 8.5**1.25, "epsilon": 8.5}
    assert _rounded(theory=PETROL | fitting).notices == ()


@for_each(
    ("timing", "theory", "options", "says"),
    [
        ({"ignition_delay": 30.0}, {}, {}, "after top dead centre"),
        ({"intake_closes": 151.0}, {}, {}, "events of compression must follow"),
        ({"intake_opens": 140.0}, {}, {}, "nothing is left of the exhaust stroke"),
        ({"cycle": 360.0, "intake_opens": 60.0}, {}, {}, "exhaust open first"),
        ({}, {"p_z": 0.0}, {}, "needs p_z"),
        ({}, {"p_r": 5e5}, {}, "has to fall"),
        ({}, {"p_z": 1.5e6}, {}, "does not lie between"),
        ({}, {}, {"peak_angle": 120.0}, "leaves no expansion"),
        ({}, {}, {"peak_angle": 0.0}, "leaves no expansion"),
    ],
)
def test_what_makes_no_diagram_is_refused(timing, theory, options, says):
    with pytest.raises(CrankworkError, match=says):
        _rounded(timing=replace(VALVES, **timing), theory=PETROL | theory, **options)
