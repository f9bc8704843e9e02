"""Layouts: pins from orders, firing from throws, positions and journals, and the sentences of refusal."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.cylinders.arrangement import STANDARD_ORDERS, boxer, build_layout, inline, radial, vee
from crankwork.cylinders.firing import LayoutError, order_text, wrap_angle
from crankwork.cylinders.layout import Banks
from each import for_each
from engines import standard_layout

every_standard = for_each(
    "standard",
    STANDARD_ORDERS,
    ids=lambda one: f"{one.kind}-{one.strokes}-{order_text(one.order)}-{one.axes[-1]:g}-{one.throws[-1]:g}",
)


def _pins(layout):
    return [place.pin_angle for place in layout.places]


@st.composite
def orders(draw, counts):
    count = draw(counts)
    return (1, *draw(st.permutations(range(2, count + 1))))


@given(orders(st.integers(1, 12)), st.sampled_from([2, 4]))
def test_an_inline_engine_of_any_order_gets_the_crank_it_needs(order, strokes):
    layout, notices = inline(len(order), order, strokes=strokes)
    assert notices == ()
    for at, number in enumerate(order):
        place = layout.places[number - 1]
        assert place.firing_angle == at * layout.cycle / len(order)
        assert abs(wrap_angle(place.firing_angle + place.pin_angle + 180) - 180) < 1e-9


@given(orders(st.sampled_from([2, 4, 6, 8])), st.integers(-170, 170))
def test_a_boxer_or_narrow_v_with_own_throws_gets_the_crank_it_needs(order, lean):
    banks = Banks("V", len(order), (-lean / 2, lean / 2), own_throws=True)
    layout, notices = build_layout(banks, order)
    first = layout.places[0]
    assert notices == ()
    for place in layout.places:
        pin = place.firing_angle + first.axis + place.pin_angle
        assert abs(wrap_angle(pin - place.axis + 180) - 180) < 1e-9


@for_each("standard", [one for one in STANDARD_ORDERS if not standard_layout(one)[1]])
def test_the_order_alone_gives_the_crank_of_every_even_standard(standard):
    layout, _ = standard_layout(standard)
    own = standard.kind in ("inline", "boxer")
    banks = Banks(
        standard.kind, standard.cylinders, standard.axes, 0, 0, standard.pin_offset, standard.numbering, own_throws=own
    )
    derived, _ = build_layout(banks, standard.order, strokes=standard.strokes)
    assert derived == layout


def test_the_cross_plane_v8():
    layout, notices = vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0, spacing=0.1, bank_stagger=0.02)
    assert notices == ()
    assert _pins(layout) == [0, 90, 270, 180, 0, 90, 270, 180]
    assert [place.crankpin for place in layout.places] == [0, 1, 2, 3] * 2
    assert [place.axis for place in layout.places] == [-45.0] * 4 + [45.0] * 4


def test_split_pins_are_crankpins_of_their_own_on_one_throw():
    layout, notices = vee(6, (1, 2, 3, 4, 5, 6), 60.0, pin_offset=-60.0, numbering="pairs")
    assert notices == ()
    assert [place.throw for place in layout.places] == [0, 0, 1, 1, 2, 2]
    assert [place.crankpin for place in layout.places] == [0, 1, 2, 3, 4, 5]
    assert _pins(layout) == [0, 300, 120, 60, 240, 180]


def test_a_flat_engine_with_common_pins_is_a_v_of_180_degrees_and_no_boxer():
    flat, _ = vee(2, (1, 2), 180.0, uneven=True, throws=(0.0,))
    opposed, notices = boxer(2, (1, 2))
    assert (_pins(flat), _pins(opposed)) == ([0, 0], [0, 180])
    assert notices == ()
    assert [place.throw for place in opposed.places] == [0, 1]


def test_a_v_of_15_degrees_has_throws_of_its_own():
    layout, notices = build_layout(Banks("W", 6, (-7.5, 7.5), numbering="pairs", own_throws=True), (1, 5, 3, 6, 2, 4))
    assert notices == ()
    assert _pins(layout) == [0, 255, 120, 135, 240, 15]
    assert [place.throw for place in layout.places] == [0, 1, 2, 3, 4, 5]


def test_uneven_firing_takes_the_crank_of_the_first_bank():
    layout, notices = vee(6, (1, 4, 2, 5, 3, 6), 90.0, uneven=True)
    given_throws, noticed = vee(6, (1, 4, 2, 5, 3, 6), 90.0, throws=(0.0, 120.0, 240.0))
    assert layout == given_throws
    assert notices == ()
    assert [one.code for one in noticed] == ["uneven_intervals"]
    assert noticed[0].values["intervals"] == "90, 150, 90, 150, 90, 150"


def test_throws_count_from_the_first():
    turned, _ = inline(3, (1, 3, 2), throws=(90.0, 330.0, 210.0))
    assert turned == inline(3, (1, 3, 2))[0]


# --- along the shaft


def test_journals_stand_between_the_cylinders_of_an_inline_engine():
    layout, _ = inline(4, (1, 3, 4, 2), spacing=0.1)
    assert [place.position for place in layout.places] == pytest.approx([-0.15, -0.05, 0.05, 0.15])
    assert layout.journal_positions == pytest.approx((-0.2, -0.1, 0, 0.1, 0.2))


def test_the_rods_of_a_v_stand_side_by_side_between_two_journals():
    layout, _ = vee(4, (1, 3, 2, 4), 90.0, spacing=0.1, bank_stagger=0.02, throws=(0.0, 180.0), numbering="pairs")
    assert [place.position for place in layout.places] == pytest.approx([-0.06, -0.04, 0.04, 0.06])
    assert layout.journal_positions == pytest.approx((-0.1, 0, 0.1))


def test_the_throws_of_a_boxer_stand_one_behind_the_other():
    layout, _ = boxer(4, (1, 4, 3, 2), spacing=0.05)
    assert [place.position for place in layout.places] == pytest.approx([-0.075, 0.025, -0.025, 0.075])
    assert [place.throw for place in layout.places] == [0, 2, 1, 3]
    assert layout.journal_positions == pytest.approx((-0.1, -0.05, 0, 0.05, 0.1))


@every_standard
def test_every_throw_lies_between_two_journals(standard):
    layout, _ = standard_layout(standard, spacing=0.1)
    throws = max(place.throw for place in layout.places) + 1
    positions = [place.position for place in layout.places]
    assert len(layout.journal_positions) == throws + 1
    assert min(positions) + max(positions) == pytest.approx(0.0, abs=1e-15)
    for place in layout.places:
        before, behind = layout.journal_positions[place.throw : place.throw + 2]
        assert before < place.position < behind


# --- articulated


def test_the_rods_of_a_radial_engine_hang_on_the_master():
    layout, notices = radial(7, master=4, span=0.2)
    assert notices == ()
    assert [place.master for place in layout.places] == [4, 4, 4, 0, 4, 4, 4]
    assert layout.firing_order == (1, 3, 5, 7, 2, 4, 6)
    assert layout.journal_positions == (-0.1, 0.1)
    assert {place.master for place in radial(7, master=0)[0].places} == {0}


def test_the_second_bank_of_a_v_may_hang_on_the_first():
    layout, _ = vee(12, (1, 7, 5, 11, 3, 9, 6, 12, 2, 8, 4, 10), 60.0, articulated=True)
    assert [place.master for place in layout.places] == [0] * 6 + [1, 2, 3, 4, 5, 6]


# --- refusals name the key and the way out


@for_each(
    ("make", "key", "parts"),
    [
        (
            lambda: inline(4, (1, 2, 3, 4), throws=(0, 180, 180, 0)),
            "engine.firing_order",
            [
                "does not allow the firing order 1-2-3-4",
                "it allows 1-2-4-3, 1-3-4-2",
                'throws = ["0 deg", "180 deg", "0 deg", "180 deg"]',
            ],
        ),
        (
            lambda: vee(6, (1, 2, 3, 4, 5, 6), 90.0, numbering="pairs"),
            "engine.pin_offset",
            [
                "2 30 deg behind that of 1",
                'engine.pin_offset = "-30 deg"',
                "engine.bank_angle = 120",
                "90, 150, 90, 150",
            ],
        ),
        (
            lambda: vee(8, (1, 5, 4, 2, 6, 3, 8, 7), 90.0),
            "engine.pin_offset",
            ["cylinders 3 and 7", "engine.firing_order = [1, 3, 4, 2, 6, 5, 7, 8]"],
        ),
        (lambda: inline(4, (1, 3, 4, 2), throws=(0, 180)), "engine.throws", ["2 angles", "4 throws"]),
        (lambda: vee(7, (1, 2, 3, 4, 5, 6, 7), 90.0), "engine.cylinders", ["a multiple of 2"]),
        (lambda: vee(2, (1, 2), 0.0), "engine.bank_angle", ["same direction"]),
        (lambda: build_layout(Banks("W", 3, (-60, 0, 300)), (1, 2, 3)), "engine.bank_angles", ["same direction"]),
        (
            lambda: build_layout(Banks("W", 6, (-60, 0, 60)), (1, 2, 3, 4, 5, 6)),
            "engine.firing_order",
            ["cylinders 1 and 3 are on one throw"],
        ),
        (lambda: inline(0, ()), "engine.cylinders", ["1 or more"]),
        (lambda: radial(8), "engine.cylinders", ["7 or 9"]),
        (lambda: radial(7, master=8), "engine.master", ["1 to 7"]),
        (lambda: inline(2, (1, 2), strokes=3), "engine.strokes", ["2 or 4"]),
        (lambda: vee(2, (1, 2), 90.0, numbering="zigzag"), "engine.numbering", ['"zigzag"']),
        (
            lambda: vee(6, (1, 2, 3, 4, 5, 6), 60.0, pin_offset=-60.0, numbering="pairs", articulated=True),
            "engine.articulated",
            ["leave out engine.pin_offset"],
        ),
    ],
)
def test_what_does_not_fit_is_refused_with_a_way_out(make, key, parts):
    with pytest.raises(LayoutError) as refused:
        make()
    assert refused.value.key == key
    assert [part for part in parts if part not in str(refused.value)] == []


def test_the_ways_out_of_a_refusal_work():
    assert vee(6, (1, 2, 3, 4, 5, 6), 90.0, pin_offset=-30.0, numbering="pairs")[1] == ()
    assert vee(6, (1, 2, 3, 4, 5, 6), 120.0, numbering="pairs")[1] == ()
    assert vee(8, (1, 3, 4, 2, 6, 5, 7, 8), 90.0, throws=(0, 90, 270, 180))[1] == ()
    assert inline(4, (1, 2, 3, 4), throws=(0, 180, 0, 180))[1] == ()
