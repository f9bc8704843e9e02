"""Orders of the piston acceleration, free forces and their ellipses."""

import mpmath
import numpy as np
import pytest

from crankwork.cylinders.balance import (
    ORDERS,
    InertiaHarmonics,
    free_force,
    free_forces,
    free_moment,
    inertia_harmonics,
    layout_factors,
    order_inertia_force,
    sampled_harmonics,
)
from crankwork.cylinders.counterweights import Ellipse, OrderBalance, balance_sum, unit_vectors, vector_sum
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.piston import textbook_transfer_2
from crankwork.kinematics.slider_crank import SliderCrank, piston_transfer_2, rod_swing
from crankwork.method import EXACT, TEXTBOOK
from each import for_each

pytestmark = pytest.mark.elsewhere

TURN = CrankGrid.from_degrees(np.arange(256) * (360 / 256))
CENTRAL, OFFSET = SliderCrank(0.04, 0.14), SliderCrank(0.04, 0.14, 0.012)


def _layout(pins, axes=None, positions=None) -> Layout:
    axes = [0.0] * len(pins) if axes is None else axes
    positions = np.arange(len(pins)) - (len(pins) - 1) / 2 if positions is None else positions
    places = [CylinderPlace(k + 1, axes[k], k, k, pins[k], float(positions[k]), 0.0) for k in range(len(pins))]
    return Layout("any", tuple(places), 720.0, tuple(range(1, len(pins) + 1)))


def _acceleration(slider_crank: SliderCrank):
    rod = rod_swing(slider_crank, TURN)
    return piston_transfer_2(slider_crank.crank_radius, slider_crank.rod_ratio, TURN.cos, rod.cos_sum, rod.cos)


# --- orders of the piston acceleration


@for_each("slider_crank", [CENTRAL, OFFSET], ids=["central", "offset"])
def test_the_orders_are_those_of_the_sampled_motion(slider_crank) -> None:
    orders = (1, 2, 3, 4, 5, 6)
    exact = inertia_harmonics(slider_crank, orders)
    sampled = sampled_harmonics(_acceleration(slider_crank), slider_crank.crank_radius, orders)
    assert exact.orders == sampled.orders == orders
    assert np.abs(exact.coefficients - sampled.coefficients).max() < 1e-14


def test_the_orders_add_up_to_the_acceleration() -> None:
    found = inertia_harmonics(OFFSET, range(1, 41))
    total = sum(
        (c * unit_vectors(q * TURN.degrees)).real for q, c in zip(found.orders, found.coefficients, strict=True)
    )
    assert np.abs(OFFSET.crank_radius * total - _acceleration(OFFSET)).max() < 1e-15


def test_two_terms_are_those_of_the_textbooks() -> None:
    found = inertia_harmonics(OFFSET, (1, 2, 3), TEXTBOOK)
    r, lam, e = OFFSET.crank_radius, OFFSET.rod_ratio, OFFSET.offset
    expected = textbook_transfer_2(r, TURN.cos, lam, TURN.cos_2, e, TURN.sin)
    sampled = sampled_harmonics(expected, r, (1, 2, 3))
    assert np.abs(found.coefficients - sampled.coefficients).max() < 1e-15


def test_a_series_ends_at_its_order() -> None:
    exact, series = (inertia_harmonics(CENTRAL, ORDERS, one) for one in (EXACT, EXACT.named("series:4")))
    assert series.coefficients.tolist() == [*exact.coefficients[:3], 0]


def test_the_second_order_is_the_fourier_integral_to_the_last_digit() -> None:
    """30 digits, from the position of the piston by two integrations by parts."""
    with mpmath.workdps(30):
        r, l = mpmath.mpf(CENTRAL.crank_radius), mpmath.mpf(CENTRAL.rod_length)  # noqa: E741

        def position(phi):
            return -r * mpmath.cos(phi) - mpmath.sqrt(l**2 - (r * mpmath.sin(phi)) ** 2)

        integral = mpmath.quad(lambda phi: position(phi) * mpmath.cos(2 * phi), mpmath.linspace(0, mpmath.pi, 9))
        expected = float(-4 * 2 / mpmath.pi * integral / r)
    assert inertia_harmonics(CENTRAL, (2,)).coefficients[0] == pytest.approx(expected, rel=4e-16)


def test_too_few_samples_are_refused() -> None:
    with pytest.raises(CrankworkError, match="12 samples of a turn do not show order 6; give more than 12"):
        sampled_harmonics(np.ones(12), 1.0)
    assert sampled_harmonics(np.ones(13), 1.0).coefficients == pytest.approx(0, abs=1e-15)


# --- ellipses


def test_an_ellipse_has_the_extremes_of_its_vector() -> None:
    ellipse = Ellipse(3 + 1j, -1 + 0.5j)
    turning = np.exp(1j * np.linspace(0, 2 * np.pi, 200001))
    vector = ellipse.forward * turning + ellipse.backward * turning.conj()
    length = np.abs(vector)
    assert ellipse.largest == pytest.approx(length.max(), rel=1e-9)
    assert ellipse.least == pytest.approx(length.min(), rel=1e-9)
    assert ellipse.direction == pytest.approx(np.degrees(np.angle(vector[length.argmax()])) % 180, abs=1e-2)


def test_a_circle_has_no_direction() -> None:
    assert Ellipse(2j, 0j).direction == 0
    assert Ellipse(2j, 0j).least == Ellipse(2j, 0j).largest == 2


def test_the_outline_is_closed_and_begins_at_crank_angle_zero() -> None:
    outline = Ellipse(3 + 1j, -1 + 0.5j).outline(25)
    assert outline.shape == (25,)
    assert outline[0] == outline[-1] == 2 + 1.5j
    assert outline[6] == pytest.approx(1j * (4 + 0.5j))


def test_sums_that_cancel_are_zero_and_others_are_kept() -> None:
    assert vector_sum(np.exp(2j * np.pi * np.arange(7) / 7)) == 0
    assert vector_sum([1.0, -1.0, 1e-12]) != 0
    assert vector_sum([]) == 0


# --- free forces


def test_a_single_cylinder_pushes_along_its_axis() -> None:
    layout = _layout([0.0], [30.0])
    (first, second) = free_forces(layout, 0.5, 0.04, 300.0, inertia_harmonics(CENTRAL, (1, 2), TEXTBOOK))
    assert first.force.largest == pytest.approx(order_inertia_force(0.5, 0.04, 300.0, 1.0), rel=1e-15)
    assert second.force.largest == pytest.approx(order_inertia_force(0.5, 0.04, 300.0, 2 / 7), rel=1e-15)
    assert first.force.least == pytest.approx(0, abs=1e-12)
    assert first.force.direction == second.force.direction == pytest.approx(30)
    # at its top dead centre the force is outwards
    at_top = first.force.forward + first.force.backward
    assert at_top == pytest.approx(1800 * np.exp(1j * np.radians(30)), rel=1e-15)


def test_a_boxer_of_two_leaves_a_couple_only() -> None:
    """Opposed cylinders 40 mm apart, crankpins opposite: pistons move in and out together."""
    layout = _layout([0.0, 180.0], [90.0, -90.0], [-0.02, 0.02])
    found = free_forces(layout, 0.5, 0.04, 300.0, inertia_harmonics(CENTRAL))
    for one, harmonic in zip(found, inertia_harmonics(CENTRAL).coefficients, strict=True):
        assert one.force == (0, 0)
        assert one.moment.largest == pytest.approx(1800 * abs(harmonic) * 0.04, rel=1e-14)
        assert one.moment.direction == pytest.approx(90)


def test_a_row_of_six_and_a_v12_are_free_of_the_first_orders() -> None:
    pins = [0.0, 240.0, 120.0, 120.0, 240.0, 0.0]
    positions = np.tile(np.arange(6) - 2.5, 2)
    v12 = _layout(pins * 2, [-30.0] * 6 + [30.0] * 6, positions)
    for layout in (_layout(pins), v12):
        *low, sixth = layout_factors(layout, (1, 2, 4, 5, 6))
        assert [(one.force, one.moment) for one in low] == [((0, 0), (0, 0))] * 4
        assert sixth.force.largest > 5


def test_factors_and_formulas_give_the_free_forces() -> None:
    """The route that a note prints: factor of the layout times the force of one cylinder."""
    layout = _layout([0.0, 240.0, 120.0], None, [-0.09, 0.0, 0.09])
    rods = inertia_harmonics(CENTRAL)
    free = free_forces(layout, 0.5, 0.04, 300.0, rods)
    for one, factor, harmonic in zip(free, layout_factors(layout, pitch=0.09), rods.coefficients, strict=True):
        force = order_inertia_force(0.5, 0.04, 300.0, abs(harmonic))
        assert free_force(factor.force.largest, force) == pytest.approx(one.force.largest, rel=1e-14)
        assert free_moment(factor.moment.largest, 0.09, force) == pytest.approx(one.moment.largest, rel=1e-14)


def test_moments_about_another_position_differ_by_the_force() -> None:
    layout = _layout([0.0, 270.0], None, [-0.05, 0.05])
    rods = inertia_harmonics(OFFSET, (1, 2, 3))
    middle = free_forces(layout, 0.5, 0.04, 300.0, rods)
    end = free_forces(layout, 0.5, 0.04, 300.0, rods, about=-0.05)
    for one, other in zip(middle, end, strict=True):
        assert other.force == one.force
        assert other.moment == pytest.approx([m + 0.05 * f for m, f in zip(one.moment, one.force, strict=True)])


def test_cylinders_may_differ_in_mass_radius_and_motion() -> None:
    layout = _layout([0.0, 90.0], [0.0, 60.0])
    masses, radii = [0.5, 0.7], [0.04, 0.05]
    rows = np.array([[1.0, 0.3], [0.9 + 0.1j, 0.2j]])
    together = free_forces(layout, masses, radii, 100.0, InertiaHarmonics((1, 2), rows))
    alone = []
    for place, mass, radius, row in zip(layout.places, masses, radii, rows, strict=True):
        # a cylinder of zero mass keeps the direction of cylinder 1
        only = [mass * (place.number == 1), mass * (place.number == 2)]
        alone += free_forces(layout, only, radius, 100.0, InertiaHarmonics((1, 2), row))
    for one, other in zip(together, balance_sum(alone), strict=True):
        assert one.force == pytest.approx(other.force)
        assert one.moment == pytest.approx(other.moment)


def test_harmonics_of_another_number_of_cylinders_are_refused() -> None:
    with pytest.raises(CrankworkError, match="harmonics of 3 cylinders do not fit a layout of 2"):
        free_forces(_layout([0.0, 180.0]), 1.0, 1.0, 1.0, InertiaHarmonics((1,), np.ones((3, 1), dtype=complex)))


def test_forces_of_different_orders_are_not_added() -> None:
    some = [OrderBalance(q, Ellipse(1j, 0j), Ellipse(0j, 2.0)) for q in (2, 1, 2)]
    assert balance_sum(some) == (
        OrderBalance(1, Ellipse(1j, 0j), Ellipse(0j, 2.0)),
        OrderBalance(2, Ellipse(2j, 0j), Ellipse(0j, 4.0)),
    )
