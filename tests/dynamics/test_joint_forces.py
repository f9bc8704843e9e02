from dataclasses import replace

import numpy as np
import pytest

from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.loop_closure import solve_positions
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.load import ForceOnPoint, ProcessForce, TorqueOnLink, applied_loads
from crankwork.mechanism.catalog import crank_shaper, four_bar, scotch_yoke
from crankwork.mechanism.dyads import PRP, RRP, Guide
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at, slider_crank

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(7.0, 360, 10))


def at_rest(mechanism, *loads, grid=GRID):
    moved = linkage_motion(mechanism, grid)
    return OperatingState(mechanism, moved, loads=applied_loads(mechanism, moved, loads))


def test_piston_force_divides_into_rod_force_and_side_force():
    engine = slider_crank(0.05, 0.2)
    running = at_rest(engine, ForceOnPoint("piston_pin", 0.0, -1000.0))
    found = joint_forces(running)
    tan = -running.motion.frames["rod"].cos / running.motion.frames["rod"].sin
    assert found.pins["piston_pin"].y == pytest.approx(1000)
    assert np.abs(found.guides["piston_pin"].normal) == pytest.approx(1000 * np.abs(tan), abs=1e-9)
    assert found.pins["crank_pin"].resultant == pytest.approx(1000 * np.hypot(1, tan))
    x_1 = running.motion.sliders["piston_pin"].position_1
    assert found.balancing_torque == pytest.approx(1000 * x_1, abs=1e-9)


def test_inertia_of_a_piston_is_minus_mass_times_acceleration():
    engine = replace(slider_crank(0.05, 0.2), bodies=(body_at("piston_pin", 2.0, 0.0, "piston_pin"),))
    moved = linkage_motion(engine, GRID)
    found = joint_forces(OperatingState(engine, moved, 100.0, angular_acceleration=50.0))
    _, first, second = moved.sliders["piston_pin"]
    assert found.pins["piston_pin"].y == pytest.approx(2 * (second * 100**2 + first * 50), rel=1e-12)


def test_rotating_mass_pulls_at_the_pivot():
    crank = Mechanism(Crank(0.1), (), (body_at("crank", 3.0, 0.2, "crank_pin"),))
    found = joint_forces(OperatingState(crank, linkage_motion(crank, GRID), 20.0, angular_acceleration=4.0))
    pivot = found.pins["crank_pivot"]
    assert pivot.resultant == pytest.approx(3 * 0.1 * np.hypot(20**2, 4))
    assert found.balancing_torque == pytest.approx(4 * (0.2 + 3 * 0.1**2))


def test_a_torque_on_the_rocker_loads_the_coupler_along_its_length():
    bar = four_bar(0.05, 0.2, 0.12, 0.18)
    running = at_rest(bar, TorqueOnLink("rocker", 30.0))
    found = joint_forces(running)
    coupler, rocker = (running.motion.frames[name] for name in ("coupler", "rocker"))
    sine = coupler.cos * rocker.sin - coupler.sin * rocker.cos
    assert found.pins["coupler_pin"].resultant == pytest.approx(np.abs(30 / (0.12 * sine)))
    assert found.pins["crank_pin"].x == pytest.approx(found.pins["coupler_pin"].x)
    assert found.balancing_torque == pytest.approx(-30 * rocker.angle_1, abs=1e-12)


def test_clockwise_and_anticlockwise_are_mirror_images():
    bar, mirrored = four_bar(0.05, 0.2, 0.12, 0.18), four_bar(0.05, 0.2, 0.12, 0.18, branch=-1)
    mirrored = replace(mirrored, driver=replace(mirrored.crank, direction=-1))
    one = joint_forces(at_rest(bar, ForceOnPoint("coupler_pin", 100.0, 30.0)))
    other = joint_forces(at_rest(mirrored, ForceOnPoint("coupler_pin", 100.0, -30.0)))
    assert other.balancing_torque == pytest.approx(one.balancing_torque)
    assert other.pins["crank_pin"].x == pytest.approx(one.pins["crank_pin"].x)
    assert other.pins["crank_pin"].y == pytest.approx(-one.pins["crank_pin"].y)


def test_the_force_of_a_slot_is_square_to_it_and_acts_at_the_pin():
    shaper = crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14)
    load = ProcessForce("ram", lambda way: np.full_like(way, 500.0), acts="both")
    found = joint_forces(at_rest(shaper, load))
    slot = found.guides["block"]
    assert found.pins["crank_pin"].resultant == pytest.approx(np.abs(slot.normal))
    assert slot.moment == pytest.approx(0, abs=1e-12)


def test_the_moment_of_a_guide_follows_an_eccentric_load():
    yoke = replace(scotch_yoke(0.1), points=(LinkPoint("E", "yoke", 0.0, 0.05), LinkPoint("S", "block", 0.0)))
    found = joint_forces(at_rest(yoke, ForceOnPoint("E", -200.0, 80.0)))
    guide = found.guides["yoke"]
    assert guide.normal == pytest.approx(-80)
    # 200 N at 0.05 m above the guide, and the slot takes it at the height of the pin
    assert guide.moment == pytest.approx(-200 * (0.05 - 0.1 * GRID.sin), abs=1e-12)


def test_blocks_on_crossing_guides_share_the_force():
    crossing = Mechanism(
        Crank(0.1), (PRP("P", "one", "two", Guide((0.0, 0.0), np.pi / 2, "crank"), Guide((0.3, 0.2), 0.0)),)
    )
    at = CrankGrid.from_degrees(np.array([-40.0, 0.0, 30.0]))
    running = at_rest(crossing, ForceOnPoint("P", 50.0, 0.0, "two"), grid=at)
    found = joint_forces(running)
    # the second block runs level, so that the first one takes the whole level force
    assert found.pins["P"].x == pytest.approx(-50)
    assert found.balancing_torque == pytest.approx(-50 * running.motion.points["P"].x.position_1)


def test_a_second_rod_on_the_pin_adds_to_its_force():
    engine = slider_crank(0.05, 0.2)
    twin = RRP("crank_pin", "second", "second_rod", 0.2)
    both = Mechanism(engine.crank, (*engine.dyads, twin))
    found = joint_forces(at_rest(both, ForceOnPoint("piston_pin", 0.0, -100.0), ForceOnPoint("second", -100.0, 0.0)))
    one, other, pivot = (found.pins[name] for name in ("crank_pin_rod", "crank_pin_second_rod", "crank_pivot"))
    # what the pin puts on the rods the crank puts on the pin, and the pivot on the crank
    assert pivot.x == pytest.approx(one.x + other.x)
    assert pivot.y == pytest.approx(one.y + other.y)


def test_singular_systems_have_no_solution_and_do_not_spoil_the_others():
    matrix = np.array([np.eye(2), np.ones((2, 2))])
    found = solve_positions(matrix, np.array([[1.0, 2.0], [1.0, 2.0]]))
    assert found[0].tolist() == [1, 2]
    assert np.isnan(found[1]).all()
