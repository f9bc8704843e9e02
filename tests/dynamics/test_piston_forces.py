"""Each force formula against cases that can be worked out by hand: 3-4-5 triangles, right angles, statics."""

import math

import numpy as np
import pytest

from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank, mean_piston_speed, rod_swing
from each import for_each

pytestmark = pytest.mark.elsewhere

SIDE, ALONG = 0.6, 0.8  # the rod leans by the angle of a 3-4-5 triangle


def test_velocity_and_acceleration_follow_from_the_transfer_functions() -> None:
    assert forces.piston_velocity(0.05, 200.0) == 10.0
    assert forces.piston_acceleration(0.05, 200.0, 0.02, -50.0) == 1999.0
    assert forces.piston_acceleration(0.05, 200.0, 0.02, 0.0) == 2000.0


def test_speeds_from_revolutions_per_minute() -> None:
    assert forces.angular_speed(math.pi, 30.0) == pytest.approx(math.pi, rel=1e-15)
    assert forces.angular_speed(3.14, 3000.0) == pytest.approx(314.0, rel=1e-15)
    assert mean_piston_speed(0.1, 3000.0) == pytest.approx(10.0, rel=1e-15)


def test_inertia_resists_acceleration_and_adds_to_the_other_forces() -> None:
    assert forces.inertia_force(2.0, 300.0) == -600.0
    assert forces.piston_force(1000.0, -600.0, 0.0) == 400.0
    assert forces.piston_force(1000.0, -600.0, 20.0) == 420.0


def test_a_weight_pushes_towards_the_crankshaft_of_an_upright_engine_and_away_in_a_hanging_one() -> None:
    assert forces.weight_force(2.0, 9.81, 1.0) == 19.62
    assert forces.weight_force(2.0, 9.81, -1.0) == -19.62
    assert forces.weight_force(2.0, 9.81, 0.0) == 0.0


def test_a_leaning_rod_splits_the_piston_force_as_a_triangle_does() -> None:
    assert forces.side_force(400.0, SIDE, ALONG, 0.0, 0.0) == pytest.approx(300.0, rel=1e-15)
    assert forces.rod_force(400.0, ALONG, 0.0, SIDE) == pytest.approx(500.0, rel=1e-15)


def test_the_wall_carries_what_holds_the_couple_and_less_of_a_weight_on_its_other_side() -> None:
    assert forces.side_force(400.0, SIDE, ALONG, 20.0, 5.0) == pytest.approx(315.0, rel=1e-15)
    assert forces.transverse_weight(2.0, 9.81, 0.5) == pytest.approx(9.81, rel=1e-15)


def test_radial_and_tangential_force_are_the_rod_force_in_the_frame_of_the_crank() -> None:
    assert forces.radial_force(400.0, 0.28, ALONG, 0.0, 1.0) == pytest.approx(500 * 0.28, rel=1e-15)
    assert forces.tangential_force(400.0, 0.96, ALONG, 0.0, 1.0) == pytest.approx(500 * 0.96, rel=1e-15)
    assert forces.crank_torque(480.0, 0.05, 0.0) == pytest.approx(24.0, rel=1e-15)
    assert forces.crank_torque(480.0, 0.05, -4.0) == pytest.approx(20.0, rel=1e-15)


def test_a_rotating_mass_pulls_outwards() -> None:
    assert forces.rotating_inertia_force(3.0, 0.1, 20.0) == pytest.approx(-120.0, rel=1e-15)


@for_each(
    ("phi", "theta", "torque"),
    [(0, 0, 0), (90, 0, 1), (180, 0, 0), (270, 0, -1), (0, 90, 1), (0, -90, -1), (90, -90, 0)],
)
def test_the_weight_of_the_crankpin_turns_the_crank_when_its_arm_lies_flat(
    phi: float, theta: float, torque: float
) -> None:
    """Positive with the rotation while the pin goes down, whichever way the cylinder leans."""
    at, lean = CrankGrid.from_degrees([phi]), CrankGrid.from_degrees([theta])
    found = forces.rotating_torque(2.0, 0.1, 10.0, at.sin[0], lean.cos[0], at.cos[0], lean.sin[0], 0.0)
    assert found == pytest.approx(2.0 * torque, abs=1e-15)


def test_speeding_up_takes_torque() -> None:
    assert forces.rotating_torque(2.0, 0.1, 0.0, 1.0, 1.0, 0.0, 0.0, 50.0) == pytest.approx(-1.0, rel=1e-15)


def test_the_frame_is_turned_against_the_crank() -> None:
    assert forces.overturning_moment(300.0, 0.2, 400.0, 0.0) == -60.0
    assert forces.overturning_moment(300.0, 0.2, 400.0, 0.01) == pytest.approx(-64.0, rel=1e-15)


def test_a_rod_with_more_inertia_than_its_two_masses_resists_its_swing() -> None:
    assert forces.correction_couple(0.02, 500.0) == -10.0
    assert forces.correction_couple(-0.02, 500.0) == 10.0
    assert forces.side_force_of_couple(-10.0, 0.25, ALONG) == pytest.approx(-50.0, rel=1e-15)


@pytest.mark.parametrize("offset", [0.0, 0.02, -0.03])
class TestRod:
    GRID = CrankGrid.steps(7.5, 360.0)

    def test_without_couple_the_rod_is_a_two_force_member(self, offset: float) -> None:
        """Whatever the crank carries, piston force and side force give it, turned by the crank angle."""
        swing = rod_swing(SliderCrank(0.05, 0.18, offset), self.GRID)
        P = 1000 * np.cos(self.GRID.angle + 0.3)
        rod = forces.rod_forces(P, self.GRID, swing)
        assert rod.along * swing.cos == pytest.approx(P, rel=1e-14, abs=1e-11)
        assert rod.along * swing.sin == pytest.approx(rod.side, rel=1e-14, abs=1e-11)
        assert rod.radial**2 + rod.tangential**2 == pytest.approx(rod.along**2, rel=1e-13, abs=1e-8)
        self._check_crankpin(P, rod)

    def test_a_couple_is_held_by_side_force_and_crankpin_alone(self, offset: float) -> None:
        lengths = SliderCrank(0.05, 0.18, offset)
        swing = rod_swing(lengths, self.GRID)
        P, couple = np.zeros(len(self.GRID)), 5 * np.sin(self.GRID.angle - 0.2)
        held = forces.side_force_of_couple(couple, lengths.rod_length, swing.cos)
        rod = forces.rod_forces(P, self.GRID, swing, dN=held)
        # moments about the crankpin: the side force acts at l cos(beta) from it
        assert rod.side * lengths.rod_length * swing.cos == pytest.approx(couple, rel=1e-14, abs=1e-14)
        assert rod.along == pytest.approx(rod.side * swing.sin, rel=1e-14, abs=1e-13)
        across = forces.rod_transverse_force(couple, lengths.rod_length)
        assert across == pytest.approx(rod.side * swing.cos, rel=1e-14, abs=1e-13)
        assert rod.radial**2 + rod.tangential**2 == pytest.approx(rod.along**2 + across**2, rel=1e-13, abs=1e-12)
        self._check_crankpin(P, rod)

    def test_weight_across_the_axis_is_carried_by_the_wall_beside_the_rod(self, offset: float) -> None:
        swing = rod_swing(SliderCrank(0.05, 0.18, offset), self.GRID)
        P = 1000 * np.cos(self.GRID.angle + 0.3)
        bare, weighed = (forces.rod_forces(P, self.GRID, swing, F_wn=weight) for weight in (0.0, 40.0))
        assert weighed.side == pytest.approx(bare.side - 40.0, abs=1e-11)
        for one, other in zip(weighed[1:], bare[1:], strict=True):
            assert np.array_equal(one, other)

    def _check_crankpin(self, P: Array, rod: forces.RodForces) -> None:
        """The crankpin gets what the piston pin gets: P towards the crankshaft and the wall's answer to N."""
        sin, cos = self.GRID.sin, self.GRID.cos
        assert rod.radial == pytest.approx(P * cos - rod.side * sin, rel=1e-13, abs=1e-10)
        assert rod.tangential == pytest.approx(P * sin + rod.side * cos, rel=1e-13, abs=1e-10)
