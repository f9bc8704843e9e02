from dataclasses import replace

import numpy as np
import pytest

from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reduction import crank_torque, kinetic_energy, reduced_inertia, reduced_torque
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import body_motions, linkage_motion
from crankwork.loads.applied_loads import NO_LOADS
from crankwork.loads.load import ForceOnPoint, TorqueOnLink, Weight, applied_loads
from crankwork.mechanism.catalog import four_bar, scotch_yoke, watt_six_bar
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at
from each import for_each
from linkages import slotted_press

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(0.0, 360, 1))


@pytest.fixture(scope="module")
def six_bar() -> Mechanism:
    bare = watt_six_bar(four_bar(0.05, 0.2, 0.12, 0.18), (0.08, 0.05), 0.2, 0.15, (0.4, 0.0))
    centre = LinkPoint("S", "second_coupler", 0.09, 0.03)
    bodies = (body_at("second_coupler", 2.0, 0.03, "S"), body_at("crank", 1.0, 0.01, "crank_pin"))
    return replace(bare, points=(*bare.points, centre), bodies=bodies)


def test_a_crank_alone_has_the_inertia_about_its_pivot():
    crank = Mechanism(Crank(0.3, direction=-1), (), (body_at("crank", 2.0, 0.5, "crank_pin"),))
    found = reduced_inertia(crank, linkage_motion(crank, GRID))
    assert found.inertia == pytest.approx(0.5 + 2 * 0.3**2)
    assert found.inertia_1 == pytest.approx(0, abs=1e-15)


def test_a_yoke_has_the_inertia_of_its_speed():
    yoke = replace(scotch_yoke(0.1), points=(LinkPoint("S", "yoke", 0.0),), bodies=(body_at("yoke", 3.0, 1.0, "S"),))
    found = reduced_inertia(yoke, linkage_motion(yoke, GRID))
    assert found.inertia == pytest.approx(3 * (0.1 * GRID.sin) ** 2, abs=1e-15)
    assert found.inertia_1 == pytest.approx(3 * 0.1**2 * 2 * GRID.sin * GRID.cos, abs=1e-15)


def test_without_bodies_there_is_no_inertia():
    bare = four_bar(0.05, 0.2, 0.12, 0.18)
    found = reduced_inertia(bare, linkage_motion(bare, GRID))
    assert not found.inertia.any()
    assert not found.inertia_1.any()


@for_each("name", ["six-bar", "press"])
def test_the_derivative_is_that_of_the_inertia(six_bar, name):
    mechanism = six_bar if name == "six-bar" else slotted_press()
    inertia, inertia_1 = reduced_inertia(mechanism, linkage_motion(mechanism, GRID))
    order = np.fft.rfftfreq(len(GRID), 1 / len(GRID))
    assert np.fft.irfft(1j * order * np.fft.rfft(inertia), len(GRID)) == pytest.approx(inertia_1, abs=1e-10)


def test_kinetic_energy_is_that_of_the_bodies(six_bar):
    moved, w = linkage_motion(six_bar, GRID), 12.0
    energy = sum(
        one.body.mass / 2 * w**2 * (one.centre.x.position_1**2 + one.centre.y.position_1**2)
        + one.body.inertia / 2 * (w * one.angle_1) ** 2
        for one in body_motions(six_bar, moved)
    )
    assert kinetic_energy(reduced_inertia(six_bar, moved).inertia, w) == pytest.approx(energy)


def test_reduced_torque_of_weights_is_the_fall_of_the_potential_energy(six_bar):
    moved = linkage_motion(six_bar, GRID)
    height = sum(one.body.mass * one.centre.y.position for one in body_motions(six_bar, moved))
    order = np.fft.rfftfreq(len(GRID), 1 / len(GRID))
    slope = np.fft.irfft(1j * order * np.fft.rfft(9.80665 * height), len(GRID))
    found = reduced_torque(moved, applied_loads(six_bar, moved, [Weight()]))
    assert found == pytest.approx(-slope, abs=1e-9)


def test_reduced_torque_on_the_crank_is_that_torque_in_its_sense():
    crank = Mechanism(Crank(0.3, direction=-1), ())
    moved = linkage_motion(crank, GRID)
    loads = applied_loads(crank, moved, [TorqueOnLink("crank", -5.0)])
    assert reduced_torque(moved, loads) == pytest.approx(5.0)


def test_crank_torque_of_a_mass_on_the_crank():
    crank = Mechanism(Crank(0.5), (), (body_at("crank", 2.0, 0.0, "crank_pin"),))
    moved = linkage_motion(crank, GRID)
    loads = applied_loads(crank, moved, [ForceOnPoint("crank_pin", 0.0, -10.0)])
    found = crank_torque(OperatingState(crank, moved, 7.0, loads, 3.0))
    assert found.static == pytest.approx(5 * GRID.cos, abs=1e-12)
    assert found.dynamic == pytest.approx(0.5 * 3.0, abs=1e-12)
    assert found.driving == pytest.approx(found.static + found.dynamic)


def test_the_inertia_does_no_net_work(six_bar):
    moved = linkage_motion(six_bar, GRID)
    found = crank_torque(OperatingState(six_bar, moved, 30.0))
    assert np.mean(found.dynamic) == pytest.approx(0, abs=1e-12 * np.max(np.abs(found.dynamic)))


def test_no_loads_no_torque(six_bar):
    assert not reduced_torque(linkage_motion(six_bar, GRID), NO_LOADS).any()
