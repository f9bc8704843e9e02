"""What is measured with a ruler on the sheets of an engine: Tolle, the load from its pole, wear and oil holes."""

from __future__ import annotations

import functools
import math
import re

import numpy as np
import pytest

from crankwork.analysis.all_cylinders import with_engine_results
from each import for_each
from notes import lines, results, scale, sheets, texts


@functools.cache
def engine(name):
    return with_engine_results(results(name))


@functools.cache
def figures(name):
    return {one.name: one.drawing for sheet in sheets(name) for one in sheet.figures}


def said(drawing):
    return [one.text for one in texts(drawing)]


def test_tolle_stands_on_the_accelerations_at_the_dead_centres():
    """A C = r w^2 (1 + lambda) upward, B D = r w^2 (1 - lambda) and E F = 3 lambda r w^2 downward, lambda 0.25."""
    drawing = figures("spark-engine")["tolle"]
    upward, across = scale(drawing, "a"), scale(drawing, "x")
    unit = 0.0529 * (math.pi * 2300 / 30) ** 2
    (first,), (last,), (middle,) = (lines(drawing, name) for name in ("AC", "BD", "EF"))
    heights = [(line[1, 1] - line[0, 1]) * upward for line in (first, last, middle)]
    assert heights == pytest.approx([1.25 * unit, -0.75 * unit, -0.75 * unit], rel=1e-6)
    assert (last[0, 0] - first[0, 0]) * across == pytest.approx(105.8, rel=1e-9)
    assert (middle[0, 0] - first[0, 0]) * across == pytest.approx(105.8 * 1.25 / 2, rel=1e-9)


def check_polar(name, rods):
    """The mean circle about the pole has the mean of the unrolled load, and the most distant point its largest."""
    drawing = figures(name)["crankpin_polar"]
    plot = next(one for one in drawing.plots if "pole" in one.curves)
    unit = scale(drawing, "F") * (1e3 if "kN" in " ".join(said(drawing)) else 1.0)
    low, high = plot.y
    zero = np.array([plot.box.left, plot.box.bottom + plot.box.height * (0.0 - low) / (high - low)])
    zero[0] += plot.box.width * (0.0 - plot.x[0]) / (plot.x[1] - plot.x[0])
    pole = zero + np.array([0.0, plot.curves["pole"][1][0] / (high - low) * plot.box.height])
    (load,) = (one for one in lines(drawing, "load") if len(one) > 100)
    listing = engine(name).listings["bearing_loads"]
    row = listing.names.index("crankpin.1")
    largest = np.hypot(*(load - pole).T).max() * unit
    assert largest == pytest.approx(listing.columns["bearing_load_max"][row], rel=2e-3)
    (circle,) = lines(drawing, "mean")
    radii = np.hypot(*(circle - pole).T) * unit
    assert radii == pytest.approx(np.full(len(circle), listing.columns["mean_bearing_load"][row]), rel=1e-3)
    assert any(re.match(rf"{rods if rods > 1 else ''} ?/{{F}}_{{cr}}", one) for one in said(drawing))


def check_oil_hole(name):
    drawing = figures(name)["crankpin_wear"]
    columns = engine(name).listings["crankpin_wear"].columns
    sums = columns["wear_sum.1"]
    hole, journal = lines(drawing, "oil_hole")[0], lines(drawing, "journal")[0]
    across, up = hole[1] - hole[0]
    assert hole[0] == pytest.approx((journal.min(axis=0) + journal.max(axis=0)) / 2, abs=0.02)
    least = columns["wear_ray_angle"][sums <= (1 + 1e-9) * sums.min()]
    away = (math.atan2(across, up) - least + math.pi) % math.tau - math.pi
    assert np.sum(away) == pytest.approx(0.0, abs=1e-6)


def test_a_load_measured_from_its_pole_is_the_unrolled_load():
    check_polar("spark-engine", 1)


def test_the_oil_hole_is_in_the_middle_of_the_rays_that_are_loaded_least():
    check_oil_hole("spark-engine")


@pytest.mark.slow
@for_each(("name", "rods"), [("v8-diesel", 2), ("radial-five", 5)])
def test_load_and_oil_hole_of_a_pin_with_several_rods(name, rods):
    check_polar(name, rods)
    check_oil_hole(name)


def test_wear_is_as_deep_as_the_sums_of_the_loads():
    """On the ray of the largest sum the worn line is deepest, elsewhere in proportion."""
    drawing = figures("spark-engine")["crankpin_wear"]
    columns = engine("spark-engine").listings["crankpin_wear"].columns
    sums, rays = columns["wear_sum.1"], columns["wear_ray_angle"]
    (worn,), (journal,) = lines(drawing, "worn"), lines(drawing, "journal")
    middle, radius = (journal.min(axis=0) + journal.max(axis=0)) / 2, np.ptp(journal[:, 0]) / 2
    depth = radius - np.hypot(*(worn - middle).T)
    turned = np.arctan2(*(worn - middle).T) % math.tau
    found = [depth[int(np.argmin(np.abs(turned - one % math.tau)))] for one in rays]
    assert np.array(found) / max(found) == pytest.approx(sums / sums.max(), abs=0.02)


@pytest.mark.slow
def test_the_shaft_of_a_whole_engine_has_wear_with_oil_holes_on_every_journal():
    drawing = figures("v8-diesel")["main_wear"]
    assert len(lines(drawing, "oil_hole")) == len(lines(drawing, "journal")) == 5
    assert {"big_end_polar", "main_journal_polar", "accumulated_torque", "crank_speed"} <= figures("v8-diesel").keys()


def test_lengths_of_the_position_plans_are_to_scale():
    """The press of the example has a rod of 600 mm, at twelve positions on its first sheet."""
    drawing = figures("press-geometry")["position_plans"]
    unit = float(re.search(r"/{μ}_{l} = ([\d.]+) mm/mm", "\n".join(said(drawing)))[1])
    bars = [one.points for one in drawing.items if len(getattr(one, "points", ())) == 3]
    lengths = np.array([np.hypot(*(one[1] - one[0])) * unit for one in bars])
    # crank, rod and rocker at every position
    counts = {length: np.sum(np.abs(lengths - length) < 0.01) for length in (50.0, 600.0, 210.0)}
    assert counts == {50.0: 12, 600.0: 12, 210.0: 12}
