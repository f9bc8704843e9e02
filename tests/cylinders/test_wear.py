"""The wear diagram: what is put on the rays comes back in the sums, wherever the journal is turned."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from crankwork.cylinders.load_vectors import BearingLoad, rotated_by
from crankwork.cylinders.wear import oil_hole, ray_angles, wear_sums, wear_table
from crankwork.errors import CrankworkError
from each import for_each

SIZES = arrays(float, 20, elements=st.floats(1.0, 1e5))
# half a degree from any ray and from any end of an arc
DIRECTIONS = arrays(np.int64, 20, elements=st.integers(0, 359)).map(lambda whole: whole + 0.5)
RAYS = st.sampled_from([12, 24, 36])


def _load(size, direction):
    size = np.asarray(size, dtype=float)
    return rotated_by(BearingLoad(size, 0 * size), direction)


@pytest.mark.slow
@given(size=SIZES, direction=DIRECTIONS, rays=RAYS)
def test_every_force_is_on_as_many_rays_as_its_arc_covers(size, direction, rays):
    """120 degrees hold 4 of 12 rays, 8 of 24, 12 of 36."""
    load = _load(size, direction)
    table = wear_table(load, rays)
    covered = rays // 3
    assert np.array_equal(np.count_nonzero(table, axis=1), np.full(20, covered))
    assert np.sum(wear_sums(load, rays=rays)) == pytest.approx(covered * np.sum(size), rel=1e-12)
    assert np.allclose(wear_sums(load, rays=rays), np.sum(table, axis=0))


@given(size=SIZES, direction=DIRECTIONS, rays=RAYS, steps=st.integers(0, 40))
def test_the_diagram_turns_with_the_loads(size, direction, rays, steps):
    load = _load(size, direction)
    further = rotated_by(load, steps * 360 / rays)
    assert np.allclose(wear_sums(further, rays=rays), np.roll(wear_sums(load, rays=rays), steps), rtol=1e-12)


def test_a_force_presses_where_it_comes_from():
    """Inertia pulls the crankpin outward, 0 degrees; the side towards the crankshaft, 180 degrees, is worn."""
    sums = wear_sums(_load(np.full(5, 10.0), 0.0))
    assert np.flatnonzero(sums).tolist() == [4, 5, 6, 7, 8]
    assert ray_angles(12)[6] == 180
    assert np.all(sums[4:9] == 50)
    hole = oil_hole(sums)
    assert (hole.angle, hole.arc, hole.least) == (0, 210, 0)


@for_each(("rays", "covered"), [(12, 5), (24, 9), (36, 13)])
def test_rays_at_the_very_ends_of_an_arc_are_on_it(rays, covered):
    """However the direction of the force was rounded."""
    direction = np.radians(np.arange(rays) * 360 / rays)
    load = BearingLoad(7.3 * np.cos(direction), 7.3 * np.sin(direction))
    assert np.count_nonzero(wear_table(load, rays), axis=1).tolist() == [covered] * rays


def test_a_small_table_by_hand():
    """Forces 100 N, 200 N and 400 N pressing at 0, 90 and 105 degrees, 12 rays every 30 degrees."""
    load = _load([100.0, 200.0, 400.0], np.array([180.0, 270.0, 285.0]))
    o = 0.0
    assert wear_table(load) == pytest.approx(
        np.array(
            [
                [100, 100, 100, o, o, o, o, o, o, o, 100, 100],
                [o, 200, 200, 200, 200, 200, o, o, o, o, o, o],
                [o, o, 400, 400, 400, 400, o, o, o, o, o, o],
            ]
        )
    )
    sums = wear_sums(load)
    assert sums == pytest.approx([100, 300, 700, 600, 600, 600, 0, 0, 0, 0, 100, 100])
    hole = oil_hole(sums)
    assert hole == pytest.approx((225, 120, 0))


def test_a_force_that_turns_evenly_in_the_journal_wears_it_evenly():
    degrees = np.arange(0, 360, 1.0) + 0.5
    sums = wear_sums(_load(np.ones(360), degrees), rays=24)
    assert sums == pytest.approx(np.full(24, 120.0))
    assert oil_hole(sums)[:2] == (0, 360)


@given(size=SIZES, direction=DIRECTIONS)
def test_loads_alike_on_both_sides_of_the_crank_wear_both_sides_alike(size, direction):
    load = _load(np.tile(size, 2), np.concatenate([direction, -direction]))
    sums = wear_sums(load)
    assert np.allclose(sums, np.roll(sums[::-1], 1), rtol=1e-12)


# --- the oil hole


@for_each(
    ("sums", "expected"),
    [
        ([5, 4, 3, 2, 1, 2, 3, 4, 5, 6, 7, 6], (120, 30, 1)),
        ([1, 4, 3, 2, 2, 2, 3, 4, 5, 6, 7, 1], (345, 60, 1)),
        ([0, 0, 3, 2, 0, 2, 3, 4, 5, 6, 7, 0], (0, 90, 0)),
        ([0, 9, 9, 9, 0, 3, 9, 9, 9, 9, 9, 9], (120, 30, 0)),
        ([1, 1, 1, 2], (90, 270, 1)),
        ([7, 7, 7], (0, 360, 7)),
        ([0, 0, 0], (0, 360, 0)),
    ],
    ids=["one ray", "over the end", "the longest arc", "the calmer neighbours", "four rays", "even", "nothing"],
)
def test_the_oil_hole_is_in_the_middle_of_the_least_loaded_arc(sums, expected):
    assert oil_hole(sums) == pytest.approx(expected)


@given(sums=arrays(float, 24, elements=st.integers(0, 5).map(float), unique=False), steps=st.integers(0, 23))
def test_the_oil_hole_turns_with_the_sums(sums, steps):
    hole, turned = oil_hole(sums), oil_hole(np.roll(sums, steps))
    assert (turned.arc, turned.least) == (hole.arc, hole.least)
    rays = np.arange(24)
    apart = np.abs((rays * 15 - turned.angle + 180) % 360 - 180)
    if hole.arc < 360:
        assert np.all(np.roll(sums, steps)[apart <= turned.arc / 2] == turned.least)


def test_rounding_does_not_split_the_least_loaded_arc():
    sums = np.array([0.1 + 0.2, 0.3, 0.3, 8.0, 9.0, 8.0])
    assert oil_hole(sums) == pytest.approx((60, 180, 0.3))


def test_rays_and_arcs_that_make_no_diagram_are_refused():
    load = _load([1.0], 0.0)
    with pytest.raises(CrankworkError, match="2 rays shows nothing; give at least 3"):
        wear_table(load, 2)
