"""Small formulas of motion and forces with numbers that can be worked out by hand: 3-4-5 and 5-12-13 triangles."""

import math
from collections.abc import Callable

import pytest

from crankwork.cylinders import articulated, load_vectors
from crankwork.dynamics import piston_forces, reduction
from crankwork.dynamics.efficiency import efficiency_share
from crankwork.kinematics import kinematic_coefficients, motion_laws, piston, plane_motion, slider_crank
from crankwork.loads import gas
from crankwork.shaft import flywheel
from each import for_each

pytestmark = pytest.mark.elsewhere


CASES = (
    (slider_crank.rod_ratio, (0.05, 0.2), 0.25),
    (slider_crank.rod_sine, (0.25, 0.8, 0.1, 0.5), 0.15),
    (slider_crank.crank_rod_sine, (3 / 5, 12 / 13, 4 / 5, 5 / 13), 56 / 65),
    (slider_crank.crank_rod_cosine, (4 / 5, 12 / 13, 3 / 5, 5 / 13), 33 / 65),
    (slider_crank.rod_angle, (0.6, 0.8), math.asin(0.6)),
    (slider_crank.rod_factor, (0.8,), 1.25),
    (slider_crank.side_factor, (0.6, 0.8), 0.75),
    (slider_crank.rod_angular_velocity, (-0.25, 80), -20),
    (slider_crank.rod_angular_acceleration, (0.2, 10, 0.5, 8), 24),
    (slider_crank.relative_offset, (0.01, 0.05), 0.2),
    (slider_crank.stroke_central, (0.06,), 0.12),
    (piston.textbook_rod_transfer_1, (0.25, 0.8), 0.2),
    (piston.textbook_rod_transfer_2, (0.25, 0.8), -0.2),
    (articulated.articulated_rod_cosine, (0.6, 4, 1, 5), 0.8),
    # a direction in the second quadrant lies a half turn from the arc tangent of its slope
    (plane_motion.direction_of_slope, (0.6, -0.8, 1), math.atan2(0.6, -0.8)),
    (kinematic_coefficients.link_angular_velocity, (0.3, 20), 6),
    (kinematic_coefficients.slider_velocity, (0.04, 50), 2),
    (kinematic_coefficients.slider_acceleration, (0.03, 20, 0.05, 40), 14),
    (kinematic_coefficients.point_velocity_x, (0.03, 20), 0.6),
    (kinematic_coefficients.point_velocity_y, (0.04, 20), 0.8),
    (kinematic_coefficients.point_velocity, (0.6, 0.8), 1),
    (kinematic_coefficients.point_acceleration_x, (0.02, 10, 0.05, 20), 3),
    (kinematic_coefficients.point_acceleration_y, (0.03, 10, 0.05, 20), 4),
    (kinematic_coefficients.point_acceleration, (3, 4), 5),
    (kinematic_coefficients.coriolis_acceleration, (3, -0.5), -3),
    (load_vectors.turned_along, (2, 3, 0.6, 0.8), -0.2),
    (load_vectors.turned_across, (2, 3, 0.6, 0.8), 3.6),
    (piston_forces.transverse_weight, (3, 9.81, 0.5), 14.715),
    (reduction.balancing_torque_of_parts, (30, 12), 42),
    (efficiency_share, (0.25, 0.8), 0.2),
    (flywheel.work_of_mean_torque, (25, 12), 300),
    (flywheel.flywheel_beside_machine, (5, 1.5), 3.5),
    (gas.gauge_pressure, (1.6e5, 1e5), 6e4),
    # 0.8 of the straight line less 8/4, where the sine is one
    (motion_laws.sine_law, (0.2, 1.5, 0.4, 8, 2, math.pi / 2 - 0.8), -1.2),
)


@for_each(("formula", "operands", "expected"), CASES, ids=lambda case: case[0].__name__)
def test_a_formula_gives_what_a_calculation_by_hand_gives(
    formula: Callable[..., float], operands: tuple[float, ...], expected: float
) -> None:
    assert formula(*operands) == pytest.approx(expected, rel=1e-12)
