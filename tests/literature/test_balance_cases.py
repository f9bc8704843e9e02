"""Balance of engines and locomotives as books print it.

Bevan, The Theory of Machines, ch. 14, and Sarkar, Theory of Machines, ch. 12, both as recalculated in
FOSSEE/Python-Textbook-Companions; the factors of the customary layouts are those of Den Hartog, Mechanical Vibrations,
ch. 5, and Taylor, The Internal-Combustion Engine, vol. 2, ch. 8.
"""

import cmath
import math

import numpy as np
import pytest

from crankwork.cylinders.balance import InertiaHarmonics, free_forces, inertia_harmonics, layout_factors
from crankwork.cylinders.counterweights import (
    OrderBalance,
    balance_sum,
    counterweight_moment,
    in_two_planes,
    rotating_unbalances,
    throw_counterweights,
    turning_forces,
    unit_vectors,
    vector_sum,
)
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import TEXTBOOK
from each import for_each
from machine_texts import analysed

INLINE_PINS = {
    "I1": (0,),
    "I2_360": (0, 0),
    "I2_180": (0, 180),
    "I2_270": (0, 270),
    "I3_120": (0, 240, 120),
    "I4_flat": (0, 180, 180, 0),
    "I4_cross_1423": (0, 180, 270, 90),
    "I5_12453": (0, 288, 144, 216, 72),
    "I6_120": (0, 240, 120, 120, 240, 0),
    "I8_90": (0, 180, 90, 270, 270, 90, 180, 0),
}
# force and moment of the orders 1, 2, 4, 6
INLINE_FACTORS = {
    "I1": ((1, 0), (1, 0), (1, 0), (1, 0)),
    "I2_360": ((2, 0), (2, 0), (2, 0), (2, 0)),
    "I2_180": ((0, 1), (2, 0), (2, 0), (2, 0)),
    "I2_270": ((1.414214, 0.707107), (0, 1), (2, 0), (0, 1)),
    "I3_120": ((0, 1.732051), (0, 1.732051), (0, 1.732051), (3, 0)),
    "I4_flat": ((0, 0), (4, 0), (4, 0), (4, 0)),
    "I4_cross_1423": ((0, 1.414214), (0, 4), (4, 0), (0, 4)),
    "I5_12453": ((0, 3.373717), (0, 3.690262), (0, 3.373717), (0, 3.373717)),
    "I6_120": ((0, 0), (0, 0), (0, 0), (6, 0)),
    "I8_90": ((0, 0), (0, 0), (8, 0), (0, 0)),
}
# least and largest force of the orders 1, 2
V2_FACTORS = {
    45: ((0.292893, 1.707107), (0.541196, 1.306563)),
    60: ((0.5, 1.5), (0.866025, 0.866025)),
    90: ((1, 1), (0, 1.414214)),
    180: ((0, 2), (0, 0)),
}
RADIAL_FACTORS = {3: (1.5, 1.5), 5: (2.5, 0), 7: (3.5, 0), 9: (4.5, 0)}


def _layout(pins, axes=(0.0,), pitch=1.0) -> Layout:
    """Return cylinders in a row, or around one crankpin where the pitch is zero."""
    count = max(len(pins), len(axes))
    pins, axes = (list(one) * (count // len(one)) for one in (pins, axes))
    first = -(count - 1) / 2 * pitch
    places = [
        CylinderPlace(k + 1, float(axes[k]), k if pitch else 0, k, float(pins[k]), first + k * pitch, 0.0)
        for k in range(count)
    ]
    return Layout("any", tuple(places), 720.0, tuple(range(1, count + 1)))


class TestCustomaryLayouts:
    """Factors of m r w^2 A_q, and of that times the pitch."""

    @for_each("name", INLINE_PINS)
    def test_inline(self, name: str) -> None:
        found = layout_factors(_layout(INLINE_PINS[name]))
        assert [one.order for one in found] == [1, 2, 4, 6]
        for one, (force, moment) in zip(found, INLINE_FACTORS[name], strict=True):
            assert one.force.largest == pytest.approx(force, abs=5.1e-7)
            assert one.moment.largest == pytest.approx(moment, abs=5.1e-7)
            assert (one.force.largest == 0) == (force == 0), "what cancels is zero, not rounding"

    @for_each("angle", V2_FACTORS)
    def test_v2_with_one_crankpin(self, angle: int) -> None:
        found = layout_factors(_layout((0, 0), (-angle / 2, angle / 2), 0.0), (1, 2))
        for one, extremes in zip(found, V2_FACTORS[angle], strict=True):
            assert (one.force.least, one.force.largest) == pytest.approx(extremes, abs=5.1e-7)

    @for_each("count", RADIAL_FACTORS)
    def test_radial(self, count: int) -> None:
        found = layout_factors(_layout((0,), np.arange(count) * 360 / count, 0.0), (1, 2))
        for one, factor in zip(found, RADIAL_FACTORS[count], strict=True):
            assert one.force.largest == pytest.approx(factor, abs=1e-14 * count)
            assert one.force.least == pytest.approx(factor, abs=1e-14 * count)

    def test_the_pitch_is_the_unit_of_the_moments(self) -> None:
        layout = _layout(INLINE_PINS["I5_12453"], pitch=0.094)
        moments = [one.moment.largest for one in layout_factors(layout, pitch=0.094)]
        assert moments == pytest.approx([moment for _, moment in INLINE_FACTORS["I5_12453"]], abs=5.1e-7)


FILE = """
format = 2
crank = { radius = "50 mm", speed = "600 rpm" }
rod = { length = "200 mm", mass = "0 kg", small_end_share = 0.5 }
piston.mass = "1 kg"
cylinder.bore = "80 mm"
[engine]
"""
ORDERS = {
    "I4_flat": [1, 3, 4, 2], "I5_12453": [1, 2, 4, 5, 3], "I6_120": [1, 5, 3, 6, 2, 4],
    "I8_90": [1, 4, 2, 3, 8, 5, 7, 6],
}  # fmt: skip


@pytest.mark.elsewhere
class TestLayoutsFromFiles:
    """The same factors, and largest over single force, of engines that machine files describe."""

    @for_each("name", INLINE_PINS)
    def test_inline(self, name: str) -> None:
        pins = INLINE_PINS[name]
        throws = ", ".join(f'"{pin} deg"' for pin in pins)
        order = ORDERS.get(name, [*range(1, len(pins) + 1)])
        results = analysed(f"""{FILE}
            layout = "inline"
            cylinders = {len(pins)}
            firing_order = {order}
            throws = [{throws}]
            spacing = "100 mm"
            uneven = true
        """)
        for q, (force, moment) in zip((1, 2, 4, 6), INLINE_FACTORS[name], strict=True):
            assert results.value(f"force_factor.{q}") == pytest.approx(force, abs=5.1e-7)
            if len(pins) > 1:
                assert results.value(f"moment_factor.{q}") == pytest.approx(moment, abs=5.1e-7)

    @for_each("angle", V2_FACTORS)
    def test_v2_with_one_crankpin(self, angle: int) -> None:
        more = f'layout = "V"\ncylinders = 2\nbank_angle = "{angle} deg"\nfiring_order = [1, 2]\nuneven = true'
        results = analysed(f"{FILE}{more}")
        for q, extremes in zip((1, 2), V2_FACTORS[angle], strict=True):
            single = results.value(f"order_inertia_force.{q}")
            ends = [results.value(f"free_force{end}.reciprocating.{q}") / single for end in ("_min", "")]
            assert ends == pytest.approx(extremes, abs=5.1e-7)

    @for_each("count", RADIAL_FACTORS)
    def test_radial(self, count: int) -> None:
        results = analysed(f'{FILE}layout = "radial"\ncylinders = {count}')
        for q, factor in zip((1, 2), RADIAL_FACTORS[count], strict=True):
            assert results.value(f"force_factor.{q}") == pytest.approx(factor, abs=1e-13)


class TestBevan:
    """Examples of chapter 14, weights in pounds, lengths in inches."""

    @for_each(("position", "far", "near"), [(-10.0, 24, 144), (10.0, 24, 96)])
    def test_example_1_a_weight_balanced_in_two_planes(self, position: float, far: float, near: float) -> None:
        """200 lb at 9 in, 10 in outside or inside of the first plane; planes 50 in apart, weights at 15 in."""
        first, second = in_two_planes([200 * 9.0], [position], (0.0, 50.0))
        assert first / 15 == pytest.approx(near, rel=1e-14)
        assert second / 15 == pytest.approx(far if position > 0 else -far, rel=1e-14)

    def test_example_2_four_weights_in_one_plane(self) -> None:
        loads = [(200 * 9.0, 0), (300 * 7.0, 45), (240 * 10.0, 120), (260 * 12.0, 255)]
        total = vector_sum([moment * unit_vectors(angle) for moment, angle in loads])
        assert abs(total) / 24 == pytest.approx(57.9, abs=0.05)
        assert math.degrees(cmath.phase(total)) == pytest.approx(23.28, abs=5e-3)

    def test_example_5_half_of_the_reciprocating_weight(self) -> None:
        """300 rpm, stroke 15 in, revolving 180 lb, reciprocating 150 lb; the printed force is cut off."""
        moment = counterweight_moment(180, 0.5, 150, 7.5)
        assert moment / 6 == pytest.approx(318.8, abs=0.051)
        speed, one = math.pi * 300 / 30, _layout((0,))
        rod = inertia_harmonics(SliderCrank(7.5 / 12, 3.0), (1,), TEXTBOOK)
        masses = 150 / 32.2, 180 / 32.2
        weights = throw_counterweights(one, *masses, 7.5 / 12)
        turning = [*rotating_unbalances(one, masses[1], 7.5 / 12), *weights]
        (left,) = balance_sum([*free_forces(one, masses[0], 7.5 / 12, speed, rod), turning_forces(one, turning, speed)])
        assert math.floor(left.force.largest) == 1436
        assert left.force.least == pytest.approx(left.force.largest, rel=1e-12)
        assert left.force.forward == pytest.approx(0, abs=1e-9)

    def test_example_12_radial_engine_of_three_cylinders(self) -> None:
        """1500 rpm, 4 lb, stroke 5 in, rod 9 in, weight at 3.5 in; printed 4.29 lb and 266 lb."""
        layout = _layout((0,), (0, 120, 240), 0.0)
        (weight,) = throw_counterweights(layout, 4.0, 0.0, 2.5)
        assert weight.mass_moment / 3.5 == pytest.approx(4.285714, abs=5.1e-7)
        assert weight.angle == 180
        rod = inertia_harmonics(SliderCrank(2.5, 9.0), (1, 2), TEXTBOOK)
        speed = math.pi * 1500 / 30
        second = free_forces(layout, 4 / 32.2, 2.5 / 12, speed, rod)[1]
        assert second.force.largest == pytest.approx(266.0672, abs=5.1e-5)
        assert second.force.forward == 0
        assert second.force.least == second.force.largest

    def test_example_13_three_rows_of_four(self) -> None:
        """2000 rpm, 6 lb, crank 3 in, rod 11 in; twice and six times the force of one, as rows at 60 degrees have."""
        pins, axes = (0, 180, 180, 0), (-60, 0, 60)
        places = [
            CylinderPlace(1 + k + 4 * row, axis, k, k, pins[k], k - 1.5, 0.0)
            for row, axis in enumerate(axes)
            for k in range(4)
        ]
        layout = Layout("W", tuple(places), 720.0, tuple(range(1, 13)))
        rod = inertia_harmonics(SliderCrank(3.0, 11.0), (1, 2), TEXTBOOK)
        first, second = free_forces(layout, 6 / 32.2, 3 / 12, math.pi * 2000 / 30, rod)
        assert first.force == (0, 0)
        assert math.floor(second.force.least) == 1114
        assert math.floor(second.force.largest) == 3343
        assert second.force.direction == pytest.approx(90.0)


class TestSarkar:
    """Illustrations of chapter 12."""

    def test_illustration_1_two_thirds_of_the_reciprocating_mass(self) -> None:
        """250 rpm, stroke 18 cm, 120 kg and 70 kg, weight at 15 cm; at 30 degrees printed 3263.971 N, with 57.3."""
        share, speed = 2 / 3, 250 * math.pi / 30
        assert counterweight_moment(70, share, 120, 0.09) / 0.15 == pytest.approx(90, rel=1e-14)
        angle = math.radians(30)
        one = _layout((0,))
        rod = inertia_harmonics(SliderCrank(0.09, 0.4), (1,), TEXTBOOK)
        turning = [*rotating_unbalances(one, 70, 0.09), *throw_counterweights(one, 120, 70, 0.09, share)]
        (left,) = balance_sum([*free_forces(one, 120, 0.09, speed, rod), turning_forces(one, turning, speed)])
        turn = complex(math.cos(angle), math.sin(angle))
        found = abs(left.force.forward * turn + left.force.backward / turn)
        assert found == pytest.approx(3264.065, abs=5.1e-4)
        assert found == pytest.approx(3263.971, rel=5e-5)

    def test_illustration_3_locomotive_with_inside_cylinders(self) -> None:
        """300 rpm, stroke 0.6 m, 0.7 m apart, 130 kg and 210 kg, share 0.67; a wheel has 100.44 kg at 0.64 m."""
        share, speed = 0.67, 300 * math.pi / 30
        left = self._left((1 - share) * 210, speed)
        assert left.force.largest == pytest.approx(29018.117, abs=5.1e-4)
        assert left.moment.largest == pytest.approx(10156.341, abs=5.1e-4)
        part = share * 210 / (130 + share * 210) * 100.44 * 0.64
        assert unbalance_force(part, speed) == pytest.approx(32975.566, abs=5.1e-4)

    def test_illustration_7_share_that_keeps_the_hammer_blow(self) -> None:
        """90 km/h, wheel 1.7 m, 300 kg, cranks 0.3 m, 0.7 m apart; hammer blow 40 kN, a wheel's part 69.625 c kg m."""
        speed = 25 / 0.85
        share = 40e3 / unbalance_force(69.625, speed)
        assert share == pytest.approx(0.664, abs=5.1e-4)
        left = self._left((1 - share) * 300, speed)
        assert left.force.largest == pytest.approx(36980.420, abs=5.1e-4)
        assert left.moment.largest == pytest.approx(12943.147, abs=5.1e-4)

    def _left(self, unbalanced: float, speed: float) -> OrderBalance:
        """Return what two cylinders at right angles leave of the first order along the line of stroke."""
        primary = InertiaHarmonics((1,), np.ones(1, dtype=complex))
        return free_forces(_layout((0, 90), pitch=0.7), unbalanced, 0.3, speed, primary)[0]
