"""What holds for every layout: phasors are the Fourier transform of the summed forces.

Forces are summed here sample by sample from the position of the pistons, not with the package.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from crankwork.cylinders.balance import (
    InertiaHarmonics,
    balance_shafts,
    free_forces,
    inertia_harmonics,
    layout_factors,
    sampled_harmonics,
    shaft_forces,
)
from crankwork.cylinders.counterweights import (
    OrderBalance,
    balance_sum,
    rotating_unbalances,
    throw_counterweights,
    turning_forces,
    unit_vectors,
)
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank

pytestmark = pytest.mark.elsewhere

COUNT = 512
DEGREES = np.arange(COUNT) * (360 / COUNT)
GRID = CrankGrid.from_degrees(DEGREES)
ORDERS = tuple(range(1, 13))
MANY = settings(max_examples=30)
angles = st.floats(-360.0, 360.0)
positions = st.floats(-1.0, 1.0)


class Drawn(NamedTuple):
    """Cylinders anywhere, with masses of their own and one crank gear."""

    layout: Layout
    masses: list[float]
    lengths: SliderCrank
    speed: float

    @property
    def size(self) -> float:
        """Largest force there could be. [N]"""
        return sum(self.masses) * self.lengths.crank_radius * self.speed**2


@st.composite
def engines(draw: st.DrawFn) -> Drawn:
    count = draw(st.integers(1, 9))
    places = tuple(
        CylinderPlace(k + 1, draw(angles), k, k, draw(angles) if k else 0.0, draw(positions), 0.0) for k in range(count)
    )
    r = draw(st.floats(0.01, 1.0))
    offset = draw(st.floats(-0.4, 0.4)) * r
    lengths = SliderCrank(r, (r + abs(offset)) * draw(st.floats(1.5, 8.0)), offset)
    masses = [draw(st.floats(0.1, 10.0)) for _ in range(count)]
    return Drawn(Layout("any", places, 720.0, tuple(range(1, count + 1))), masses, lengths, draw(st.floats(1.0, 700.0)))


def _accelerations(drawn: Drawn) -> NDArray[np.float64]:
    """Return d2x/dphi2 of each cylinder at the crank angles of cylinder 1. [m]"""
    r, l, e = drawn.lengths  # noqa: E741
    first = drawn.layout.places[0].axis
    rows = []
    for place in drawn.layout.places:
        phi = np.radians(DEGREES + first + place.pin_angle - place.axis)
        u, u_1, u_2 = r * np.sin(phi) - e, r * np.cos(phi), -r * np.sin(phi)
        s = np.sqrt(l**2 - u**2)
        rows.append(r * np.cos(phi) + (u_1**2 + u * u_2) / s + u**2 * u_1**2 / s**3)
    return np.array(rows)


def _forces(drawn: Drawn) -> NDArray[np.complex128]:
    """Return the inertia force of each cylinder, in the plane across the shaft. [N]"""
    axes = np.exp(1j * np.radians([place.axis for place in drawn.layout.places]))
    return np.array(drawn.masses)[:, None] * drawn.speed**2 * _accelerations(drawn) * axes[:, None]


def _free(drawn: Drawn, orders=ORDERS) -> tuple[OrderBalance, ...]:
    return free_forces(
        drawn.layout, drawn.masses, drawn.lengths.crank_radius, drawn.speed, inertia_harmonics(drawn.lengths, orders)
    )


@MANY
@given(drawn=engines())
def test_the_phasors_are_the_fourier_transform_of_the_summed_forces(drawn: Drawn) -> None:
    forces = _forces(drawn)
    arms = np.array([place.position for place in drawn.layout.places])
    force, moment = np.fft.fft(forces.sum(axis=0)) / COUNT, np.fft.fft(arms @ forces) / COUNT
    for one in _free(drawn):
        q = one.order
        assert one.force == pytest.approx((force[q], force[-q]), abs=1e-10 * drawn.size)
        assert one.moment == pytest.approx((moment[q], moment[-q]), abs=1e-10 * drawn.size)


@MANY
@given(drawn=engines())
def test_all_orders_together_are_the_summed_force(drawn: Drawn) -> None:
    total = np.zeros(COUNT, dtype=complex)
    for one in _free(drawn, range(1, 121)):
        turning = unit_vectors(one.order * DEGREES)
        total += one.force.forward * turning + one.force.backward * turning.conj()
    assert np.abs(total - _forces(drawn).sum(axis=0)).max() < 1e-10 * drawn.size


@MANY
@given(drawn=engines())
def test_harmonics_of_each_cylinder_sampled_by_its_own_angle_give_the_same(drawn: Drawn) -> None:
    """As for articulated rods, whose cylinders move differently."""
    # cylinder 1 by itself is at its own crank angle
    own = _accelerations(drawn._replace(layout=Layout("any", drawn.layout.places[:1], 720.0, (1,))))
    rows = np.repeat(own, len(drawn.masses), axis=0)
    harmonics = sampled_harmonics(rows, drawn.lengths.crank_radius, ORDERS)
    assert harmonics.coefficients.shape == (len(drawn.masses), len(ORDERS))
    found = free_forces(drawn.layout, drawn.masses, drawn.lengths.crank_radius, drawn.speed, harmonics)
    for one, other in zip(found, _free(drawn), strict=True):
        assert one.force == pytest.approx(other.force, abs=1e-10 * drawn.size)


@MANY
@given(drawn=engines(), turned=angles)
def test_a_leaning_engine_has_leaning_forces(drawn: Drawn, turned: float) -> None:
    places = drawn.layout.places
    leaning = tuple(
        CylinderPlace(one.number, one.axis + turned, one.crankpin, one.throw, one.pin_angle, one.position, 0.0)
        for one in places
    )
    found = _free(drawn._replace(layout=Layout("any", leaning, 720.0, drawn.layout.firing_order)))
    vector = np.exp(1j * np.radians(turned))
    for one, upright in zip(found, _free(drawn), strict=True):
        assert one.force == pytest.approx([vector * part for part in upright.force], abs=1e-10 * drawn.size)


@given(count=st.integers(2, 15), order=st.integers(1, 20))
def test_a_radial_engine_keeps_the_orders_next_to_its_number_of_cylinders(count: int, order: int) -> None:
    """Of n cylinders, order q turns forwards where n divides q - 1, backwards where it divides q + 1."""
    places = tuple(CylinderPlace(k + 1, k * 360 / count, 0, 0, 0.0, 0.0, 0.0) for k in range(count))
    (found,) = layout_factors(Layout("radial", places, 720.0, tuple(range(1, count + 1))), (order,))
    forward, backward = (count / 2 if (order + step) % count == 0 else 0 for step in (-1, 1))
    assert found.force == pytest.approx((forward, backward), abs=1e-12)
    assert (found.force.forward == 0, found.force.backward == 0) == (forward == 0, backward == 0)


@MANY
@given(drawn=engines(), rotating=st.floats(0.0, 10.0))
def test_counterweights_of_one_half_leave_nothing_of_the_first_order_that_turns_forwards(
    drawn: Drawn, rotating: float
) -> None:
    layout, r = drawn.layout, drawn.lengths.crank_radius
    weights = throw_counterweights(layout, drawn.masses, rotating, r)
    turning = [*rotating_unbalances(layout, rotating, r), *weights]
    unit = InertiaHarmonics((1,), np.ones(1, dtype=complex))
    primary = free_forces(layout, drawn.masses, r, drawn.speed, unit)
    (left,) = balance_sum([*primary, turning_forces(layout, turning, drawn.speed)])
    size = drawn.size + rotating * len(drawn.masses) * r * drawn.speed**2
    assert abs(left.force.forward) < 1e-12 * size
    assert abs(left.moment.forward) < 1e-12 * size
    assert left.force.backward == pytest.approx(primary[0].force.backward, abs=1e-12 * size)


@MANY
@given(drawn=engines(), first=positions, span=st.floats(0.1, 2.0))
def test_weights_on_two_shafts_in_two_planes_take_any_order_away(drawn: Drawn, first: float, span: float) -> None:
    for part in _free(drawn, (1, 2, 3)):
        weights = balance_shafts(part, drawn.speed, (first, first + span))
        (left,) = balance_sum([part, *shaft_forces(weights, drawn.speed)])
        assert left.force.largest < 1e-10 * drawn.size
        assert left.moment.largest < 1e-10 * drawn.size
