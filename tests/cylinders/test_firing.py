"""Firing orders: the angles they give on a crankshaft, and every order a crankshaft allows."""

from itertools import permutations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.cylinders.arrangement import STANDARD_ORDERS, radial_order, standard_orders
from crankwork.cylinders.firing import (
    LayoutError,
    checked_order,
    even_angles,
    even_orders,
    firing_angles,
    intervals,
    is_even,
    order_text,
    possible_order,
    wrap_angle,
)
from each import for_each
from engines import standard_layout

every_standard = for_each(
    "standard",
    STANDARD_ORDERS,
    ids=lambda one: f"{one.kind}-{one.strokes}-{order_text(one.order)}-{one.axes[-1]:g}-{one.throws[-1]:g}",
)
# Cranks of the table of free forces, crank angle of each cylinder; Den Hartog, Mechanical Vibrations, chapter 5.
CRANKS = {
    "1-2": [(0, 0), (0, 180), (0, 270)],
    "1-3-2": [(0, 240, 120)],
    "1-3-4-2": [(0, 180, 180, 0)],
    "1-5-3-6-2-4": [(0, 240, 120, 120, 240, 0)],
    "1-5-2-6-8-4-7-3": [(0, 180, 90, 270, 270, 90, 180, 0)],
}


@st.composite
def cranks(draw):
    count = draw(st.integers(1, 6))
    step = draw(st.sampled_from([30, 60, 72, 90, 120, 180]))
    dead_centres = (0.0, *(float(draw(st.integers(0, 359 // step)) * step) for _ in range(count - 1)))
    return dead_centres, draw(st.sampled_from([360.0, 720.0]))


def _all_choices(order, dead_centres, cycle):
    """Every way to let the cylinders fire one after the other, each at one of its dead centres."""
    turns = range(round(cycle / 360))
    for turn in product(turns, repeat=len(order) - 1):
        angles = [0.0, *(dead_centres[k - 1] + 360 * t for k, t in zip(order[1:], turn, strict=True))]
        if all(one < other for one, other in zip(angles, [*angles[1:], cycle], strict=True)):
            yield angles


@given(cranks(), st.randoms(use_true_random=False))
def test_the_most_even_angles_of_an_order_are_found(crank, random):
    dead_centres, cycle = crank
    order = list(range(2, len(dead_centres) + 1))
    random.shuffle(order)
    order = (1, *order)
    choices = list(_all_choices(order, dead_centres, cycle))
    found = firing_angles(order, dead_centres, cycle)
    assert (found is None) == (not choices)
    if found is not None:
        in_order = [found[k - 1] for k in order]
        assert in_order in choices
        unevenness = [sum(step**2 for step in intervals(one, cycle)) for one in [in_order, *choices]]
        assert unevenness[0] == min(unevenness)


@given(cranks())
def test_every_even_order_of_a_crank_is_found_and_no_other(crank):
    dead_centres, cycle = crank
    expected = []
    for rest in permutations(range(2, len(dead_centres) + 1)):
        angles = firing_angles((1, *rest), dead_centres, cycle)
        if angles and is_even(intervals([angles[k - 1] for k in (1, *rest)], cycle)):
            expected.append((1, *rest))
    assert list(even_orders(dead_centres, cycle)) == sorted(expected)


@given(cranks())
def test_an_order_that_is_offered_is_possible(crank):
    dead_centres, cycle = crank
    order = possible_order(dead_centres, cycle)
    assert sorted(order) == list(range(1, len(dead_centres) + 1))
    assert firing_angles(order, dead_centres, cycle, together=True) is not None


def test_a_flat_four_cylinder_crank_has_two_even_orders():
    assert even_orders((0.0, 180.0, 180.0, 0.0), 720.0) == ((1, 2, 4, 3), (1, 3, 4, 2))


@given(st.integers(-(10**7), 10**7), st.sampled_from([360.0, 720.0]))
def test_wrapped_decimals_stay_decimals(hundredths, cycle):
    assert wrap_angle(hundredths / 100, cycle) == (hundredths % (cycle * 100)) / 100


def test_wrapping_leaves_what_is_no_decimal_as_it_is():
    assert wrap_angle(720 / 7, 720.0) == 720 / 7
    assert wrap_angle(-1e-14, 360.0) == 0.0


# --- orders that are none


@for_each(
    ("order", "cylinders", "message"),
    [
        ((1, 3, 2), 4, "1-3-2 leaves out cylinder 4"),
        ((1, 3, 4, 4), 4, "1-3-4-4 names cylinder 4 twice and leaves out cylinder 2"),
        ((1, 2, 5), 3, "no cylinder 5; an engine of 3 has the numbers 1 to 3"),
    ],
)
def test_an_order_that_is_none_is_refused(order, cylinders, message):
    with pytest.raises(LayoutError, match=message) as refused:
        checked_order(order, cylinders)
    assert refused.value.key == "engine.firing_order"


def test_an_order_may_begin_anywhere():
    assert checked_order((4, 2, 1, 3), 4) == (1, 3, 4, 2)


def test_even_angles_of_an_order():
    assert even_angles((1, 3, 4, 2), 720.0) == (0.0, 540.0, 180.0, 360.0)


# --- the library


@every_standard
def test_a_standard_crank_allows_its_order(standard):
    layout, _ = standard_layout(standard)
    for place in layout.places:
        pin = place.firing_angle + layout.places[0].axis + place.pin_angle
        assert abs(wrap_angle(pin - place.axis + 180) - 180) < 1e-9, (
            "the piston is not at top dead centre when it fires"
        )
    angles = [layout.places[number - 1].firing_angle for number in layout.firing_order]
    assert angles == sorted(angles)
    assert layout.firing_order == standard.order


# Intervals that are known for being uneven: parallel twins of 180 and 270 degrees, cross-plane four, V-twins of 45 and
# 90 degrees, V4 on cranks of 180 and 360 degrees, V6 and V10 of 90 degrees with common pins.
UNEVEN = {
    ("inline", "1-2", (0, 180)): (180, 540),
    ("inline", "1-2", (0, 270)): (450, 270),
    ("inline", "1-3-2-4", (0, 270, 90, 180)): (270, 180, 90, 180),
    ("V", "1-2", (-22.5, 22.5)): (405, 315),
    ("V", "1-2", (-45, 45)): (450, 270),
    ("V", "1-3-2-4", (0, 180)): (180, 270, 180, 90),
    ("V", "1-2-3-4", (0, 0)): (90, 270, 90, 270),
    ("V", "1-4-2-5-3-6", (0, 120, 240)): (90, 150) * 3,
    ("V", "1-6-5-10-2-7-3-8-4-9", (0, 72, 288, 144, 216)): (90, 54) * 5,
}


@every_standard
def test_a_standard_engine_fires_evenly_or_is_known_not_to(standard):
    layout, notices = standard_layout(standard)
    text = order_text(standard.order)
    keys = [(standard.kind, text, one) for one in (standard.throws, standard.axes) if standard.strokes == 4]
    known = next((UNEVEN[key] for key in keys if key in UNEVEN), None)
    angles = [layout.places[number - 1].firing_angle for number in layout.firing_order]
    steps = intervals(angles, layout.cycle)
    if known is None:
        assert notices == ()
        assert set(steps) == {layout.cycle / standard.cylinders}
    else:
        assert steps == known
        assert notices[0].code == "uneven_intervals"


@for_each("order", CRANKS)
def test_cranks_are_those_of_the_tables_of_free_forces(order):
    cylinders = order.count("-") + 1
    found = [one.throws for one in standard_orders("inline", cylinders) if order_text(one.order) == order]
    assert set(found) == set(CRANKS[order])


def test_the_most_usual_order_comes_first():
    firsts = {(kind, n): order_text(standard_orders(kind, n)[0].order) for kind, n in [("inline", 4), ("V", 8)]}
    assert firsts == {("inline", 4): "1-3-4-2", ("V", 8): "1-5-4-2-6-3-7-8"}
    assert standard_orders("inline", 11) == ()


@for_each(
    ("cylinders", "strokes", "order"),
    [(3, 4, "1-3-2"), (5, 4, "1-3-5-2-4"), (7, 4, "1-3-5-7-2-4-6"), (9, 4, "1-3-5-7-9-2-4-6-8"), (4, 2, "1-2-3-4")],
)
def test_radial_engines_fire_every_other_cylinder(cylinders, strokes, order):
    assert order_text(radial_order(cylinders, strokes)) == order
    layout, notices = standard_layout(standard_orders("radial", cylinders, strokes)[0])
    assert notices == ()
    assert {place.pin_angle for place in layout.places} == {0.0}


def test_a_radial_row_of_even_number_has_no_standard_in_four_strokes():
    assert standard_orders("radial", 8) == ()
    with pytest.raises(LayoutError, match="take 7 or 9"):
        radial_order(8, 4)
