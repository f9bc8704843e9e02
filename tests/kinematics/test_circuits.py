"""Circuits, branches and limits against closed forms."""

import math

import numpy as np
import pytest

from crankwork.errors import GeometryError
from crankwork.kinematics.circuits import all_circuits, circuit_at, circuit_through
from crankwork.kinematics.configuration_curve import driver_coordinate, link_angle, relative_angle
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.catalog import four_bar
from crankwork.mechanism.driver import Cylinder, DrivingSlider, Law, Segment
from crankwork.mechanism.dyads import RRR, Chain, Guide
from crankwork.mechanism.mechanism import LinkPoint, Mechanism, slider_crank
from each import for_each
from linkages import TRIAD, At, distance, mechanism_from
from motions import changed

pytestmark = pytest.mark.elsewhere

CRANK, COUPLER, ROCKER, GROUND = 0.15, 0.08, 0.15, 0.2
PARTIAL = four_bar(CRANK, COUPLER, ROCKER, GROUND)


def angle_opposite(opposite, one, other):
    """Law of cosines."""
    return math.degrees(math.acos((one**2 + other**2 - opposite**2) / (2 * one * other)))


STRETCHED = angle_opposite(ROCKER + COUPLER, CRANK, GROUND)
FOLDED = angle_opposite(ROCKER - COUPLER, CRANK, GROUND)
AT_STRETCHED = 180 - angle_opposite(CRANK, ROCKER + COUPLER, GROUND)
AT_FOLDED = 180 - angle_opposite(CRANK, ROCKER - COUPLER, GROUND)
OUTERMOST = 180 - angle_opposite(CRANK - COUPLER, ROCKER, GROUND)
INNERMOST = 180 - angle_opposite(CRANK + COUPLER, ROCKER, GROUND)


def swing(circuit, name, part=None):
    return math.degrees(circuit.extent(link_angle(name), part).travel)


@for_each(("branch", "degrees"), [(1, 20.0), (1, 40.0), (1, 75.0), (-1, 20.0), (-1, 79.0), (1, 300.0)])
def test_limits_of_a_crank_that_swings_do_not_depend_on_the_start(branch, degrees):
    circuit = circuit_through(four_bar(CRANK, COUPLER, ROCKER, GROUND, branch=branch), degrees)
    driver = driver_coordinate(PARTIAL)
    assert circuit.curve.is_closed
    assert math.degrees(circuit.extent(driver).travel) == pytest.approx(STRETCHED - FOLDED, abs=1e-9)
    assert pytest.approx(64.5329, abs=5e-5) == STRETCHED - FOLDED
    branches = circuit.branches(driver)
    swings = sorted(swing(circuit, "rocker", part) for part in branches)
    # the rocker turns back where coupler and crank are in line, once on each branch
    expected = sorted(np.ptp([AT_STRETCHED, AT_FOLDED, turned]) for turned in (OUTERMOST, INNERMOST))
    assert swings == pytest.approx(expected, abs=1e-9)
    assert swings == pytest.approx([23.8134, 43.9231], abs=2e-4)
    assert swing(circuit, "rocker") == pytest.approx(abs(OUTERMOST - INNERMOST), abs=1e-9)
    own = circuit.branch_at(driver)
    assert own.start <= 0 <= own.end


def test_a_mirrored_linkage_has_the_other_circuit():
    ends = [circuit.extent(driver_coordinate(PARTIAL)) for circuit in all_circuits(PARTIAL)]
    found = sorted((math.degrees(one.least) % 360, math.degrees(one.greatest) % 360) for one in ends)
    expected = [(FOLDED, STRETCHED), (360 - STRETCHED, 360 - FOLDED)]
    assert np.array(found) == pytest.approx(np.array(expected), abs=1e-9)


def test_every_position_of_a_turning_crank_is_on_its_circuit(linkage):
    circuit = circuit_through(linkage)
    driver = driver_coordinate(linkage)
    assert abs(circuit.turns(linkage.crank.link)) == 1
    assert circuit.branches(driver) == [circuit.full_part]
    arcs = np.linspace(0, circuit.curve.length, 37)
    there, degrees = circuit.stretch(arcs), np.degrees(circuit.values(driver, arcs))
    moved = linkage_motion(linkage, CrankGrid.from_degrees(degrees))
    for name, frame in moved.frames.items():
        for mine, its in zip(there.frames[name].origin, frame.origin, strict=True):
            assert mine.position == pytest.approx(its.position + np.zeros(37), abs=1e-11)
        assert there.frames[name].cos == pytest.approx(frame.cos + np.zeros(37), abs=1e-11)
    for name, place in circuit.sliders.items():
        rate = place(there).position_1 / driver(there).position_1
        assert place(there).position == pytest.approx(moved.sliders[name].position + np.zeros(37), abs=1e-11)
        assert rate == pytest.approx(moved.sliders[name].position_1 + np.zeros(37), abs=1e-9)


def test_a_slider_has_the_stroke_of_the_textbook():
    crank, rod, offset = 0.05, 0.2, 0.03
    circuit = circuit_through(slider_crank(crank, rod, offset))
    found = circuit.extent(circuit.sliders["piston_pin"])
    assert found.travel == pytest.approx(
        math.sqrt((rod + crank) ** 2 - offset**2) - math.sqrt((rod - crank) ** 2 - offset**2), abs=1e-14
    )
    assert len(all_circuits(slider_crank(crank, rod, offset))) == 2
    # driven by the piston the linkage is dead where crank and rod are in line
    assert len(circuit.branches(circuit.sliders["piston_pin"])) == 2


def test_lengths_and_angles_between_links_may_drive():
    circuit = circuit_through(PARTIAL, 40.0)
    diagonal = distance(At("crank", CRANK), At("rocker", 0.0))
    found = circuit.extent(diagonal)
    assert (found.least, found.greatest) == pytest.approx((ROCKER - COUPLER, ROCKER + COUPLER), abs=1e-12)
    opening = circuit.extent(relative_angle("crank", "coupler"))
    assert opening.travel == pytest.approx(math.tau, abs=1e-12)
    pin = circuit.extent(lambda there: At("crank", CRANK).on(there)[0])
    assert pin.greatest == pytest.approx(CRANK * math.cos(math.radians(FOLDED)), abs=1e-12)


@for_each("branch", [1, -1])
def test_a_parallelogram_goes_straight_on_through_its_change_points(branch):
    circuit = circuit_through(four_bar(0.3, 1.0, 0.3, 1.0, branch=branch), 40.0)
    there = circuit.stretch(np.linspace(0, circuit.curve.length, 400))
    crank, rocker = there.angles["crank"].position, there.angles["rocker"].position
    if branch == 1:
        assert rocker == pytest.approx(crank, abs=1e-12)
    else:
        crossed = np.arctan2(-1.3 * np.sin(crank / 2), 0.7 * np.cos(crank / 2)) * 2
        assert np.exp(1j * rocker) == pytest.approx(np.exp(1j * crossed), abs=1e-12)
    changes = circuit.values(driver_coordinate(circuit.mechanism), circuit.curve.arc[circuit.curve.crossings])
    assert np.degrees(changes) % 360 == pytest.approx([180, 0], abs=1e-9)


def test_a_kite_is_back_after_two_turns():
    circuit = circuit_through(four_bar(1.0, math.sqrt(2), math.sqrt(2), 1.0), 90.0)
    assert circuit.turns("crank") == 2
    there = circuit.stretch(np.linspace(0, circuit.curve.length, 300))
    half = there.angles["crank"].position / 2
    reach = np.cos(half) + np.sqrt(2 - np.sin(half) ** 2)
    frame = there.frames["coupler"]
    x = frame.origin.x.position + math.sqrt(2) * frame.cos
    assert x == pytest.approx(reach * np.cos(half), abs=1e-11)


def test_an_isosceles_slider_crank_passes_the_shaft():
    circuit = circuit_through(slider_crank(0.1, 0.1))
    assert circuit.extent(circuit.sliders["piston_pin"]).travel == pytest.approx(0.4, abs=1e-12)
    assert circuit.turns("crank") == -1


@for_each(("longer", "passes"), [(5e-10, True), (3e-9, False), (1e-7, False), (1e-5, False)])
def test_lengths_that_differ_by_little_are_equal_or_told(longer, passes):
    circuit = circuit_through(four_bar(0.3, 1.0 + longer, 0.3, 1.0), 40.0)
    assert bool(circuit.curve.crossings.size) == passes
    told = [one.miss for one in circuit.curve.near_crossings]
    assert told == pytest.approx([longer] * len(told), rel=0.02)
    assert bool(told) == (1e-9 < longer < 1e-6)
    # where they do not cross, the crank turns back just before the change point, and goes on crossed
    assert circuit.turns("crank") == int(passes)


def test_of_a_chain_the_stated_circuit_is_followed():
    mechanism, _ = mechanism_from(changed(TRIAD, "crank.radius", 0.9))
    assert isinstance(mechanism.dyads[0], Chain)
    (circuit,) = all_circuits(mechanism)
    assert circuit.curve.is_closed
    assert len(circuit.branches(driver_coordinate(mechanism))) % 2 == 0


BASE, ARM = math.hypot(0.3, -0.7), 0.9


def test_a_cylinder_is_dead_where_it_points_at_the_pivot():
    law = Law((Segment("3-4-5", 1.2, 1.0),), 5.0, 0.8)
    boom = Mechanism(
        Cylinder("A", "B", law),
        (RRR("A", "O", "B", "cylinder", "boom", 0.8, ARM, branch=-1),),
        ground={"O": (0.1, 0.5), "A": (0.4, -0.2)},
    )
    circuit = circuit_at(boom, CrankGrid.from_radians([1.0]))
    driver = driver_coordinate(boom)
    ends = circuit.extent(driver)
    assert circuit.values(driver, np.array([0.0])) == pytest.approx([1.0], abs=1e-14)
    assert (ends.least, ends.greatest) == pytest.approx((ARM - BASE, ARM + BASE), abs=1e-13)
    assert abs(circuit.turns("boom")) == 1
    for part in circuit.branches(driver):
        assert circuit.extent(link_angle("boom"), part).travel == pytest.approx(math.pi, abs=1e-9)


def test_a_driving_slider_has_the_circuit_of_the_crank():
    law = Law((Segment("3-4-5", 0.1, 1.0),), 5.0, 0.0)
    slider = Mechanism(
        DrivingSlider("piston", Guide(), law), (RRR("P", "O", "A", "rod", "crank", 0.2, 0.05),),
        ground={"O": (0.0, 0.0)}, points=(LinkPoint("P", "piston", 0.0),),
    )  # fmt: skip
    circuit = circuit_at(slider, CrankGrid.from_radians([0.2]))
    stroke = circuit.extent(driver_coordinate(slider))
    assert (stroke.least, stroke.greatest) == pytest.approx((0.15, 0.25), abs=1e-14)
    assert abs(circuit.turns("crank")) == 1


def test_no_circuit_passes_a_position_that_cannot_be_assembled():
    # from the pin to the other pivot it is 0.15 + 0.2, more than coupler and rocker
    with pytest.raises(GeometryError, match="too short"):
        circuit_through(PARTIAL, 180.0)
