"""What is measured with a ruler on the sheets of an engine: Tolle, the load from its pole, wear and oil holes."""

from __future__ import annotations

import functools
import math
import re
from pathlib import Path

import numpy as np
import pytest

from crankwork.analysis import analyse
from crankwork.analysis.whole_engine import as_engine
from crankwork.description.machine_file import read
from crankwork.note.sheets import drawn_sheets
from crankwork.show.scene import Polyline, Text

EXAMPLES = Path(__file__).parents[2] / "examples"


@functools.cache
def results(name):
    return as_engine(analyse(read(EXAMPLES / f"{name}.toml")))


@functools.cache
def figures(name, language="en"):
    return {one.name: one.drawing for sheet in drawn_sheets(results(name), language) for one in sheet.figures}


def lines_of(drawing, key):
    return [one.points for one in drawing.items if isinstance(one, Polyline) and one.name == key]


def said(drawing):
    return [one.text for one in drawing.items if isinstance(one, Text)]


def scale_of(drawing, sign):
    return float(re.search(rf"μ_\{{{sign}\}} = ([\d.]+)", "\n".join(said(drawing)))[1])


def test_tolle_stands_on_the_accelerations_at_the_dead_centres():
    """A C = r w^2 (1 + lambda) upward, B D = r w^2 (1 - lambda) and E F = 3 lambda r w^2 downward, lambda 0.25."""
    drawing = figures("spark-engine")["tolle"]
    upward, across = scale_of(drawing, "a"), scale_of(drawing, "x")
    unit = 0.0529 * (math.pi * 2300 / 30) ** 2
    for name, share in (("AC", 1.25), ("BD", -0.75), ("EF", -0.75)):
        (line,) = lines_of(drawing, name)
        assert (line[1, 1] - line[0, 1]) * upward == pytest.approx(share * unit, rel=1e-6), name
    (first,), (last,), (middle,) = (lines_of(drawing, name) for name in ("AC", "BD", "EF"))
    assert (last[0, 0] - first[0, 0]) * across == pytest.approx(105.8, rel=1e-9)
    assert (middle[0, 0] - first[0, 0]) * across == pytest.approx(105.8 * 1.25 / 2, rel=1e-9)


@pytest.mark.parametrize(("name", "rods"), [("spark-engine", 1), ("petrol-four", 1), ("radial-five", 5)])
def test_a_load_measured_from_its_pole_is_the_unrolled_load(name, rods):
    """The mean circle about the pole has the mean of the unrolled load, and the most distant point its largest."""
    drawing = figures(name)["crankpin_polar"]
    plot = next(one for one in drawing.plots if "pole" in one.curves)
    scale = scale_of(drawing, "F")
    low, high = plot.y
    zero = np.array([plot.box.left, plot.box.bottom + plot.box.height * (0.0 - low) / (high - low)])
    zero[0] += plot.box.width * (0.0 - plot.x[0]) / (plot.x[1] - plot.x[0])
    ways = [one for one in lines_of(drawing, "load") if len(one) > 100]
    pole = zero + np.array([0.0, plot.curves["pole"][1][0] / (high - low) * plot.box.height])
    (load,) = ways
    distances = np.hypot(*(load - pole).T) * scale
    listing = results(name).listings["bearing_loads"]
    row = listing.names.index("crankpin.1")
    unit = 1e3 if "kN" in " ".join(said(drawing)) else 1.0
    assert distances.max() * unit == pytest.approx(listing.columns["bearing_load_max"][row], rel=2e-3)
    (circle,) = lines_of(drawing, "mean")
    assert np.hypot(*(circle - pole).T) * scale * unit == pytest.approx(
        np.full(len(circle), listing.columns["mean_bearing_load"][row]), rel=1e-3
    )
    assert any(re.match(rf"{rods if rods > 1 else ''} ?/{{F}}_{{cr}}", one) for one in said(drawing))


@pytest.mark.parametrize("name", ["spark-engine", "petrol-four", "radial-five", "v8-diesel"])
def test_the_oil_hole_is_in_the_middle_of_the_rays_that_are_loaded_least(name):
    drawing = figures(name)["crankpin_wear"]
    columns = results(name).listings["crankpin_wear"].columns
    sums = columns["wear_sum.1"]
    hole, journal = lines_of(drawing, "oil_hole")[0], lines_of(drawing, "journal")[0]
    across, up = hole[1] - hole[0]
    middle = (journal.min(axis=0) + journal.max(axis=0)) / 2
    assert hole[0] == pytest.approx(middle, abs=0.02)
    least = columns["wear_ray_angle"][sums <= (1 + 1e-9) * sums.min()]
    away = (math.atan2(across, up) - least + math.pi) % math.tau - math.pi
    assert np.sum(away) == pytest.approx(0.0, abs=1e-6)


def test_wear_is_as_deep_as_the_sums_of_the_loads():
    """On the ray of the largest sum the worn line is deepest, elsewhere in proportion."""
    drawing = figures("spark-engine")["crankpin_wear"]
    columns = results("spark-engine").listings["crankpin_wear"].columns
    sums, rays = columns["wear_sum.1"], columns["wear_ray_angle"]
    (worn,), (journal,) = lines_of(drawing, "worn"), lines_of(drawing, "journal")
    middle, radius = (journal.min(axis=0) + journal.max(axis=0)) / 2, np.ptp(journal[:, 0]) / 2
    depth = radius - np.hypot(*(worn - middle).T)
    turned = np.arctan2(*(worn - middle).T) % math.tau
    found = [depth[int(np.argmin(np.abs(turned - one % math.tau)))] for one in rays]
    assert np.array(found) / max(found) == pytest.approx(sums / sums.max(), abs=0.02)


def test_the_shaft_of_a_whole_engine_has_wear_with_oil_holes_on_every_journal():
    drawing = figures("petrol-four")["main_wear"]
    assert len(lines_of(drawing, "oil_hole")) == len(lines_of(drawing, "journal")) == 5
    assert {"big_end_polar", "main_journal_polar", "accumulated_torque", "crank_speed"} <= figures("petrol-four").keys()


def test_lengths_of_the_position_plans_are_to_scale():
    """The press of the example has a rod of 600 mm, at twelve positions on its first sheet."""
    drawing = figures("press-geometry")["position_plans"]
    scale = float(re.search(r"/{μ}_{l} = ([\d.]+) mm/mm", "\n".join(said(drawing)))[1])
    bars = [one.points for one in drawing.items if isinstance(one, Polyline) and len(one.points) == 3]
    lengths = np.array([np.hypot(*(one[1] - one[0])) * scale for one in bars])
    # crank, rod and rocker at every position
    for length in (50.0, 600.0, 210.0):
        assert np.sum(np.abs(lengths - length) < 0.01) == 12
