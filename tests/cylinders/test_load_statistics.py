"""What a bearing load comes to, against loads whose means, extremes and reversals are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.cylinders.load_statistics import (
    LoadReversal,
    cycle_shares,
    load_reversal,
    load_statistics,
    polar_diagram,
    specific_loads,
)
from crankwork.cylinders.load_vectors import BearingLoad, turned_by
from crankwork.errors import CrankworkError

pytestmark = pytest.mark.elsewhere

DEGREES = np.arange(0.0, 720.5, 0.5)
PHI = np.radians(DEGREES)


def _along(force):
    """Return a load with this compression of the rod."""
    return BearingLoad(-np.asarray(force), np.zeros_like(force))


@given(angles=st.lists(st.floats(0, 719.99), min_size=1, max_size=40, unique=True).map(sorted), closed=st.booleans())
def test_shares_of_the_cycle_add_up_to_it(angles, closed):
    degrees = [*angles, angles[0] + 720] if closed else angles
    shares = cycle_shares(degrees, 720.0)
    assert np.sum(shares) == pytest.approx(1, rel=1e-12)
    assert np.all(shares >= 0)


@pytest.mark.parametrize("degrees", [[0.0, 30.0, 20.0], [0.0, 0.0, 10.0], [0.0, 360.0, 721.0]])
def test_angles_that_are_not_one_cycle_are_refused(degrees):
    with pytest.raises(CrankworkError, match="are not one cycle of 720 degrees; give ascending angles"):
        cycle_shares(degrees, 720.0)


@pytest.mark.parametrize("closed", [True, False])
def test_mean_and_extremes_of_a_known_load(closed):
    """Size 300 + 100 cos(phi - 60 deg) in a direction that turns; the mean is 300."""
    rows = slice(None) if closed else slice(-1)
    size = 300 + 100 * np.cos(PHI - np.pi / 3)
    load = turned_by(BearingLoad(size[rows], 0 * size[rows]), 1.7 * DEGREES[rows])
    statistics = load_statistics(load, DEGREES[rows], 720.0)
    assert statistics == pytest.approx((300, 400, 60, 200, 240, 4 / 3), rel=1e-12)
    pressures = specific_loads(statistics, 0.05, 0.03)
    assert pressures == pytest.approx((300 / 0.0015, 400 / 0.0015), rel=1e-12)


def test_a_bearing_without_load_has_a_ratio_of_one():
    nothing = np.zeros(DEGREES.size)
    assert load_statistics(BearingLoad(nothing, nothing), DEGREES, 720.0) == (0, 0, 0, 0, 0, 1)


# --- reversal


@given(level=st.floats(-0.95, 0.95), phase=st.floats(0, 360))
def test_the_reversal_of_a_cosine(level, phase):
    """cos(phi) + level is negative for 2 acos(level) of every turn."""
    force = np.cos(PHI - np.radians(phase)) + level
    reversal = load_reversal(_along(force), DEGREES, 720.0)
    tension = 2 * np.degrees(np.arccos(level))
    assert reversal.tension == pytest.approx(tension, abs=5e-3)
    assert reversal.compression == pytest.approx(360 - tension, abs=5e-3)
    assert reversal.duration == pytest.approx(min(tension, 360 - tension), abs=5e-3)
    assert reversal.ratio == pytest.approx((1 - abs(level)) / (1 + abs(level)), abs=2e-5)


@pytest.mark.parametrize("turn", [0.0, 200.0, 690.0])
def test_the_longest_unbroken_stretch_counts(turn):
    """Tension from 100 to 130 and from 700 over the end of the cycle to 20, wherever the cycle begins."""
    angles = np.array([0.0, 20.0, 100.0, 115.0, 130.0, 400.0, 700.0, 710.0])
    force = np.array([-1.0, 0.0, 0.0, -5.0, 0.0, 50.0, 0.0, -2.0])
    order = np.argsort((angles + turn) % 720)
    reversal = load_reversal(_along(force[order]), ((angles + turn) % 720)[order], 720.0)
    assert (reversal.tension, reversal.tension_peak, reversal.compression_peak) == (40.0, 5.0, 50.0)
    assert reversal.compression == 570.0


@pytest.mark.parametrize(("sign", "expected"), [(1, (720, 0, 3, 0)), (-1, (0, 720, 0, 3))])
def test_a_load_of_one_sign_does_not_reverse(sign, expected):
    force = sign * np.array([1.0, 2.0, 3.0])
    reversal = load_reversal(_along(force), [0.0, 100.0, 500.0], 720.0)
    assert (reversal.compression, reversal.tension, reversal.compression_peak, reversal.tension_peak) == expected
    assert (reversal.duration, reversal.ratio, reversal.is_enough()) == (0, 0, False)


@pytest.mark.parametrize(
    ("tension", "peak", "enough"), [(15.0, 3.0, True), (14.9, 3.0, False), (15.0, 2.9, False), (200.0, 80.0, True)]
)
def test_api_618_wants_15_degrees_and_3_per_cent(tension, peak, enough):
    assert LoadReversal(360 - tension, tension, 100.0, peak).is_enough() is enough


def test_no_load_has_no_ratio():
    assert LoadReversal(720.0, 0.0, 0.0, 0.0).ratio == 0


# --- polar diagram


def test_the_pole_of_the_polar_diagram_lies_below_by_the_inertia():
    radial, tangential = 1000 * np.cos(PHI), 700 * np.sin(PHI / 2)
    load = BearingLoad(-(radial - 250.0), tangential)
    diagram = polar_diagram(load, DEGREES, 720.0, inertia=-250.0, step=45.0)
    assert np.allclose(diagram.across, tangential)
    assert np.allclose(diagram.down, radial)
    assert diagram.pole == (0.0, 250.0)
    from_pole = np.hypot(diagram.across - diagram.pole[0], diagram.down - diagram.pole[1])
    assert np.allclose(from_pole, load.resultant, rtol=1e-13)
    assert diagram.marks.tolist() == np.arange(0, 720, 45).tolist()
    assert np.allclose(diagram.marks_across, 700 * np.sin(np.radians(diagram.marks) / 2))
    assert np.allclose(diagram.marks_down, 1000 * np.cos(np.radians(diagram.marks)))
