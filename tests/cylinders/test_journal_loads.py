"""Loads on main journals: forces and moments of every throw add up to nothing, whatever acts on it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.cylinders.counterweights import Unbalance
from crankwork.cylinders.journal_loads import journal_share, main_journal_loads
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.cylinders.load_vectors import BearingLoad, rotated_by
from crankwork.errors import CrankworkError

pytestmark = pytest.mark.elsewhere

SPEED = 200.0


def _layout(throws, rods=1):
    places = [
        CylinderPlace(1 + k * rods + i, 90.0 * i, k, k, 137.0 * k, 0.1 * k + 0.02 * (i - (rods - 1) / 2), 0.0)
        for k in range(throws)
        for i in range(rods)
    ]
    return Layout("inline", tuple(places), 720.0, (1,), tuple(0.1 * k - 0.05 for k in range(throws + 1)))


@st.composite
def _shafts(draw):
    """Draw a shaft: places anywhere within their throws, loads, masses within the shaft and beyond its ends."""
    throws = draw(st.integers(1, 5))
    lengths = draw(st.lists(st.floats(0.05, 0.3), min_size=throws, max_size=throws))
    journals = np.cumsum([draw(st.floats(-1, 1)), *lengths])
    generator = np.random.default_rng(draw(st.integers(0, 2**32)))
    places = []
    for throw in range(throws):
        for _ in range(draw(st.integers(1, 3))):
            position = generator.uniform(journals[throw], journals[throw + 1])
            angle = generator.uniform(0, 360)
            places.append(CylinderPlace(len(places) + 1, 0.0, len(places), throw, angle, position, 0.0))
    loads = [BearingLoad(*generator.normal(0, 1e4, (2, 7))) for _ in places]
    reach = (journals[0] - 0.05, journals[-1] + 0.05)
    masses = [
        Unbalance(
            generator.uniform(0, 0.1), generator.uniform(0, 360), generator.uniform(*reach),
            held=BearingLoad(*generator.normal(0, 1e3, (2, 7))) if at % 2 else None,
        )
        for at in range(draw(st.integers(0, 6)))
    ]  # fmt: skip
    return Layout("inline", tuple(places), 720.0, (1,), tuple(journals.tolist())), loads, masses


@given(shaft=_shafts())
def test_a_shaft_of_hinged_throws_is_in_equilibrium(shaft):
    """Forces add up to nothing; about each journal the moment of all that is on one side of it does, too."""
    layout, loads, masses = shaft
    journals = np.array(layout.journal_positions)
    reactions = [one.x + 1j * one.y for one in main_journal_loads(layout, loads, masses, SPEED)]
    acting = [
        (place.position, (load.x + 1j * load.y) * np.exp(1j * np.radians(place.pin_angle)))
        for place, load in zip(layout.places, loads, strict=True)
    ]
    for one in masses:
        held = one.held.x + 1j * one.held.y if one.held is not None else np.zeros(7)
        acting.append((one.position, (one.mass_moment * SPEED**2 + held) * np.exp(1j * np.radians(one.angle))))
    every = acting + list(zip(journals, reactions, strict=True))
    tolerance = 1e-12 * sum(np.max(np.abs(force)) for _, force in every)
    assert np.max(np.abs(sum(force for _, force in every))) < tolerance
    for hinge in (*journals[1:-1], journals[0] - 1.0):
        moment = sum((z - hinge) * force for z, force in every if z > hinge)
        assert np.max(np.abs(moment)) < 10 * tolerance


def test_forces_in_the_middle_of_throws_give_minus_half_the_vector_sum():
    """R = -(R_i + R_{i+1}) / 2, the second turned by the angle between the cranks."""
    layout = _layout(3)
    loads = [BearingLoad(np.array([1000.0 * k, 50.0]), np.array([-300.0, 70.0 * k])) for k in (1, 2, 3)]
    found = main_journal_loads(layout, loads, (), SPEED)
    in_shaft = [rotated_by(load, 137.0 * k) for k, load in enumerate(loads)]
    for journal, (left, right) in enumerate(zip([None, *in_shaft], [*in_shaft, None], strict=True)):
        both = [one for one in (left, right) if one is not None]
        assert found[journal].x == pytest.approx(-sum(one.x for one in both) / 2)
        assert found[journal].y == pytest.approx(-sum(one.y for one in both) / 2)


def test_rods_side_by_side_load_the_nearer_journal_more():
    """Rods at 0.04 and 0.06 of a span of 0.1 share 0.6 : 0.4 and 0.4 : 0.6."""
    layout = _layout(1, rods=2)
    loads = [BearingLoad(np.array([100.0]), np.array([0.0])), BearingLoad(np.array([0.0]), np.array([100.0]))]
    left, right = main_journal_loads(layout, loads, (), SPEED)
    assert (*left.x, *left.y, *right.x, *right.y) == pytest.approx((-60, -40, -40, -60))


def test_a_counterweight_opposite_to_the_throw_takes_its_load_away():
    layout, nothing = _layout(1), np.zeros(3)
    throw = Unbalance(0.08, 0.0, 0.0)
    loads = [BearingLoad(nothing, nothing)]
    bare = main_journal_loads(layout, loads, [throw], SPEED)
    assert bare[0].x == pytest.approx(np.full(3, -0.08 * SPEED**2 / 2))
    halves = [Unbalance(0.04, 180.0, z) for z in (-0.03, 0.03)]
    for journal in main_journal_loads(layout, loads, [throw, *halves], SPEED):
        assert np.max(journal.resultant) < 1e-10


def test_what_overhangs_lifts_the_other_end():
    assert journal_share(0.15, 0.0, 0.1) == pytest.approx(1.5)
    loads = [BearingLoad(np.zeros(1), np.zeros(1))]
    left, right = main_journal_loads(_layout(1), loads, [Unbalance(1.0, 90.0, 0.1)], 1.0)
    assert (left.y[0], right.y[0]) == pytest.approx((0.5, -1.5))


def test_what_does_not_belong_together_is_refused():
    layout, loads = _layout(2), [BearingLoad(np.zeros(1), np.zeros(1))] * 2
    with pytest.raises(CrankworkError, match="1 loads are given for 2 cylinders"):
        main_journal_loads(layout, loads[:1], (), SPEED)
    with pytest.raises(CrankworkError, match="2 throws need 3 main journals, and 0 are given"):
        main_journal_loads(replace(layout, journal_positions=()), loads, (), SPEED)
    with pytest.raises(CrankworkError, match="ascending"):
        main_journal_loads(replace(layout, journal_positions=(0.0, 0.2, 0.1)), loads, (), SPEED)
    with pytest.raises(CrankworkError, match=r"cylinder 2 stands at 100 mm, .* \(20 to 60 mm\)"):
        main_journal_loads(replace(layout, journal_positions=(-0.05, 0.02, 0.06)), loads, (), SPEED)
