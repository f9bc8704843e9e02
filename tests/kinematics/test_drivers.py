"""Drivers that are no crank: each against closed forms, and against the same linkage driven by its crank."""

import math

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.motion_laws import law_at
from crankwork.mechanism.driver import Cylinder, DrivingSlider, Law, LinkMotor, Segment
from crankwork.mechanism.dyads import RRP, RRR, Chain, ChainLink, Guide
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism
from driven import BOOM, ELBOW, there_and_back
from each import for_each
from motions import coordinates, not_alike, traced

pytestmark = pytest.mark.elsewhere
GRID = CrankGrid.from_degrees(np.linspace(3.0, 350.0, 41))


class TestCylinderOnABoom:
    def test_the_angle_is_that_of_the_law_of_cosines(self):
        q = law_at(BOOM.driver.law, GRID).position
        (ox, oy), (ax, ay) = BOOM.ground["O"], BOOM.ground["A"]
        base, arm = math.hypot(ax - ox, ay - oy), 0.9
        cosine = (base**2 + arm**2 - q**2) / (2 * base * arm)
        gamma = np.arccos(cosine)
        gamma_1 = q / (base * arm * np.sin(gamma))
        gamma_2 = (1 / (base * arm) - cosine * gamma_1**2) / np.sin(gamma)
        angle, angle_1, angle_2 = linkage_motion(BOOM, GRID).links["boom"]
        assert angle == pytest.approx(math.atan2(ay - oy, ax - ox) + gamma, abs=1e-12)
        assert angle_1 == pytest.approx(gamma_1, rel=1e-12)
        assert angle_2 == pytest.approx(gamma_2, rel=1e-11)

    def test_the_tip_moves_with_the_boom(self):
        motion = linkage_motion(BOOM, GRID)
        angle, angle_1, angle_2 = motion.links["boom"]
        arm = 2.0 + 0.1j
        place = (0.1 + 0.5j) + arm * np.exp(1j * angle)
        turned = arm * np.exp(1j * angle)
        for order, expected in enumerate((place, 1j * angle_1 * turned, (1j * angle_2 - angle_1**2) * turned)):
            found = motion.points["T"].x[order] + 1j * motion.points["T"].y[order]
            assert found == pytest.approx(expected, rel=1e-12)


def inverse(driven, position, position_1, position_2):
    """Return first and second derivative by another coordinate, whose derivatives by the present one are known."""
    first = position_1 / driven.position_1
    return position, first, (position_2 - first * driven.position_2) / driven.position_1**2


class TestDrivenSliderCrank:
    """The slider drives the crank, which is then a rocker: the inverse of the crank-driven slider-crank."""

    radius, rod, offset = 0.05, 0.2, 0.01

    def both(self):
        degrees = np.linspace(20.0, 160.0, 29)
        forward = Mechanism(
            Crank(self.radius, pin="A"),
            (RRP("A", "B", "rod", self.rod, (0.0, self.offset)),),
            points=(LinkPoint("S", "rod", 0.07, 0.02),),
        )
        cranked = linkage_motion(forward, CrankGrid.from_degrees(degrees))
        way = cranked.sliders["B"]
        shares = (way.position - way.position[0]) / (way.position[-1] - way.position[0])
        law = Law((Segment("constant", float(way.position[-1]), 1.0),), 2.0, float(way.position[0]))
        backward = Mechanism(
            DrivingSlider("piston", Guide((0.0, self.offset)), law),
            (RRR("B", "O", "A", "rod", "arm", self.rod, self.radius, branch=-1),),
            ground={"O": (0.0, 0.0)},
            points=(LinkPoint("B", "piston", 0.0), LinkPoint("S", "rod", self.rod - 0.07, -0.02)),
        )
        return degrees, cranked, linkage_motion(backward, CrankGrid.from_degrees(360.0 * shares))

    def test_it_is_the_inverse(self):
        degrees, cranked, driven = self.both()
        way = cranked.sliders["B"]
        angle = driven.links["arm"]
        assert angle.position == pytest.approx(np.radians(degrees), abs=1e-12)
        assert angle.position_1 == pytest.approx(1 / way.position_1, rel=1e-11)
        assert angle.position_2 == pytest.approx(-way.position_2 / way.position_1**3, rel=1e-10)
        assert driven.sliders["piston"].position == pytest.approx(way.position, rel=1e-14)
        for axis in (0, 1):
            expected = inverse(way, *cranked.points["S"][axis])
            for found, one in zip(driven.points["S"][axis], expected, strict=True):
                assert found == pytest.approx(one, rel=1e-9, abs=1e-10)


SLIDING_CYLINDER = Mechanism(
    # a cylinder that pushes a slider along its guide
    Cylinder("A", "C", there_and_back(0.35, 0.5)),
    (RRP("A", "C", "cylinder", 0.35, (0.0, 0.3), 0.1, block="ram"),),
    ground={"A": (0.0, 0.0)},
)


def test_a_cylinder_that_pushes_a_slider():
    q = law_at(SLIDING_CYLINDER.driver.law, GRID).position
    motion = linkage_motion(SLIDING_CYLINDER, GRID)
    # distance of A from the line, and where its foot is along it
    along, across = 0.3 * math.sin(0.1), 0.3 * math.cos(0.1)
    reach = np.sqrt(q**2 - across**2)
    slide = motion.sliders["ram"]
    assert slide.position == pytest.approx(reach - along, rel=1e-13)
    assert slide.position_1 == pytest.approx(q / reach, rel=1e-12)
    assert slide.position_2 == pytest.approx(-(across**2) / reach**3, rel=1e-11)
    angle = motion.links["cylinder"]
    gamma = np.arcsin(across / q)
    assert angle.position == pytest.approx(0.1 + gamma, rel=1e-13)
    gamma_1 = -across / q / reach
    assert angle.position_1 == pytest.approx(gamma_1, rel=1e-12)
    assert angle.position_2 == pytest.approx(across / q**2 / reach + across / reach**3, rel=1e-11)


def test_a_motor_between_two_links_opens_their_angle():
    q = law_at(ELBOW.driver.law, GRID).position
    motion = linkage_motion(ELBOW, GRID)
    upper, lower, rocker = (motion.links[one] for one in ("upper", "lower", "rocker"))
    # directions run from O and D to C, so that they close at C
    assert np.mod(lower.position - upper.position, 2 * math.pi) == pytest.approx(2.0 + q, abs=1e-12)
    assert lower.position_1 - upper.position_1 == pytest.approx(1.0, abs=1e-11)
    assert lower.position_2 - upper.position_2 == pytest.approx(0.0, abs=1e-9)
    step = 1e-5
    before, after = (linkage_motion(ELBOW, CrankGrid.from_degrees(GRID.degrees + d)) for d in (-step, step))
    grown = law_at(ELBOW.driver.law, CrankGrid.from_degrees(GRID.degrees + step)).position
    grown = grown - law_at(ELBOW.driver.law, CrankGrid.from_degrees(GRID.degrees - step)).position
    moving = np.abs(grown) > 1e-9
    found = (after.links["rocker"].position - before.links["rocker"].position)[moving] / grown[moving]
    assert found == pytest.approx(rocker.position_1[moving], rel=1e-4)


def as_chain(mechanism):
    """Return the boom as a chain that is solved numerically."""
    motion = linkage_motion(mechanism, CrankGrid.from_degrees([0.0]))
    start = mechanism.driver.law.start
    links = tuple(
        ChainLink(name, mechanism.ground[pin], float(motion.links[name].position[0]), {pin: (0, 0), "B": (length, 0)})
        for name, pin, length in (("cylinder", "A", start), ("boom", "O", mechanism.dyads[0].length_b))
    )
    chain = Chain(links, (), frozenset({"A", "O"}), start, 0.9)
    return Mechanism(mechanism.driver, (chain,), ground=mechanism.ground, points=mechanism.points)


def test_a_cylinder_in_a_chain_is_the_one_in_a_dyad():
    found, expected = (coordinates(linkage_motion(one, GRID)) for one in (as_chain(BOOM), BOOM))
    assert not_alike(found, expected, rel=1e-10, abs=1e-11) == []


@for_each("mechanism", [BOOM, as_chain(BOOM), SLIDING_CYLINDER, ELBOW], ids=["boom", "chain", "slider", "elbow"])
def test_the_memory_replayed_is_the_motion(mechanism):
    assert not_alike(*traced(mechanism, GRID), rel=1e-13, abs=1e-13) == []


def test_a_crank_that_follows_a_law_is_the_crank_at_that_angle():
    law = there_and_back(0.2, 2.5)
    dyads = (RRR("A", "B", "C", "rod", "rocker", 0.2, 0.12),)
    still, swung = (Mechanism(Crank(0.05, start=0.3, direction=-1, pin="A", law=one), dyads, ground={"B": (0.18, 0.0)})
                    for one in (None, law))  # fmt: skip
    q = law_at(law, GRID).position
    expected = coordinates(linkage_motion(still, CrankGrid.from_radians(q)))
    replayed, found = traced(swung, GRID)
    assert not_alike(found, expected, rel=1e-14, abs=1e-15) == []
    assert not_alike(replayed, expected, rel=1e-13, abs=1e-14) == []


@for_each("branch", [1, -1])
@for_each("is_swapped", [False, True])
def test_links_with_a_motor_between_them_pass_the_line(is_swapped, branch):
    """The angle between the links goes round more than once; the third side alone says where they are."""
    sides, opened, ground = (0.15, 0.26), branch * 2.4, 0.3
    links, own = (("l2", "l1"), sides[::-1]) if is_swapped else (("l1", "l2"), sides)
    law = Law((Segment("constant", 7.0, 0.6), Segment("constant", -1.0, 0.4)), 5.0, -1.0)
    angle = -opened if is_swapped else opened
    motor = Mechanism(
        LinkMotor(links, "A", own, angle, law),
        (RRR("O", "B", "C", "third_side", "l3", 0.4, 0.2), RRR("O", "C", "A", "l1", "l2", *sides, branch=branch)),
        ground={"O": (0.0, 0.0), "B": (ground, 0.0)},
    )
    grid = CrankGrid.from_degrees(np.linspace(0.0, 360.0, 500))
    motion, q = linkage_motion(motor, grid), law_at(law, grid).position
    gamma = angle + q if not is_swapped else -(angle + q)
    side = np.sqrt(sides[0] ** 2 + sides[1] ** 2 - 2 * sides[0] * sides[1] * np.cos(gamma))
    base = motion.links["third_side"].position
    inside = np.arctan2(sides[1] * np.sin(gamma), sides[0] - sides[1] * np.cos(gamma))
    first, second = motion.links["l1"], motion.links["l2"]
    assert np.cos(first.position - base - inside) == pytest.approx(1.0, abs=1e-14)
    assert np.cos(second.position - first.position - gamma) == pytest.approx(1.0, abs=1e-14)
    there = motion.points["C"]
    assert np.hypot(there.x.position, there.y.position) == pytest.approx(side, rel=1e-13)
    # rates by differences of the same motion
    step = 1e-4
    ahead, behind = (linkage_motion(motor, CrankGrid.from_degrees(grid.degrees[1:-1] + d)) for d in (step, -step))
    rate = np.gradient(q, grid.degrees)[1:-1]
    smooth = np.abs(grid.degrees[1:-1] - 216.0) > 1.0
    for name in ("l1", "l2", "third_side", "l3"):
        for order in (0, 1):
            grown = (ahead.links[name][order] - behind.links[name][order]) / (2 * step)
            expected = motion.links[name][order + 1][1:-1] * rate
            assert grown[smooth] == pytest.approx(expected[smooth], rel=2e-5, abs=2e-6)
    assert not_alike(*traced(motor, grid), rel=1e-12, abs=1e-12) == []
