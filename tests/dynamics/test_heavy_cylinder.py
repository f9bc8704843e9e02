"""Barrel and rod of a hydraulic cylinder with masses: against free bodies written out here, and against more routes."""

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.mechanism import operating_state
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.preparation.linkage import solve_linkage
from each import for_each

MACHINES = Path(__file__).parents[1] / "machines"
BARREL = 'barrel = { mass = "60 kg", inertia = "5 kg*m2", centre = ["0.4 m", "0.01 m"] }'
ROD = 'rod = { mass = "35 kg", inertia = "3 kg*m2", centre = ["0.5 m", "-0.02 m"] }'
BOOM = (MACHINES / "boom.toml").read_text("utf-8")
HEAVY = BOOM.replace('cylinder = ["A", "B"]', f'cylinder = ["A", "B"]\n{BARREL}\n{ROD}')
BETWEEN = (MACHINES / "cylinder-between-links.toml").read_text("utf-8")
DEGREES = np.arange(2.5, 360.0, 5.0)
G = 9.80665


def machine(text):
    return crankwork.read_machine(text)


@pytest.fixture(scope="module")
def heavy():
    results = crankwork.analyse(machine(HEAVY))
    return results, results.columns_at(DEGREES)


def test_barrel_and_rod_are_in_equilibrium_as_two_bodies(heavy):
    """Accelerations by differences of the written-out geometry, forces from Newton's and Euler's equations."""
    results, found = heavy

    def state(times):
        one = results.columns_at(times / 8.0 * 360.0, ["driver_displacement", "link_angle.cylinder"])
        q, angle = one["driver_displacement"], np.unwrap(one["link_angle.cylinder"])
        u, n = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        start = np.array([[0.6], [-0.5]])
        return np.array([start + 0.4 * u + 0.01 * n, start + (q - 0.5) * u + 0.02 * n]), angle, u, n

    # away from where the law breaks
    at, h = np.array([0.7, 1.9, 3.1, 6.2]), 2e-4
    (before, a_0, _, _), (place, a_1, u, n), (after, a_2, _, _) = (state(at + one * h) for one in (-1, 0, 1))
    acceleration, turning = (after - 2 * place + before) / h**2, (a_2 - 2 * a_1 + a_0) / h**2
    found = results.columns_at(at / 8.0 * 360.0)
    pin = np.array([found["joint_force_x.A"], found["joint_force_y.A"]])
    cylinder = np.array([[0.6], [-0.5]]), np.array([[0.6], [-0.5]]) + found["driver_displacement"] * u
    weight = np.array([[0.0], [-G]])
    driver, normal, moment = (found["driver_force"], found["normal_force.rod"], found["normal_moment.rod"])
    # on the barrel: its pin, its weight, the oil that pushes it back, and the rod across it
    left = pin - driver * u - normal * n + 60 * weight - 60 * acceleration[0]
    assert np.max(np.abs(left)) < 1e-3 * np.max(np.abs(driver)) / 10

    def cross(a, b):
        return a[0] * b[1] - a[1] * b[0]

    about = cylinder[1]
    turned = cross(cylinder[0] - about, pin) + cross(place[0] - about, 60 * (weight - acceleration[0]))
    assert turned - moment == pytest.approx(5 * turning, abs=1e-4 * np.max(np.abs(driver)))
    own = cross(place[1] - about, 35 * (weight - acceleration[1]))
    assert own + moment == pytest.approx(3 * turning, abs=1e-4 * np.max(np.abs(driver)))


@pytest.mark.slow
@for_each("ends", ['["F", "G"]', '["G", "F"]'])
@for_each("parts", [(BARREL, ROD), (BARREL,), (ROD,)])
def test_more_routes_agree_whichever_end_has_the_barrel(ends, parts):
    line = next(one for one in BETWEEN.split("\n") if one.startswith("cylinder ="))
    small = "\n".join(parts).replace("0.4 m", "0.04 m").replace("0.5 m", "0.05 m").replace("60 kg", "6 kg")
    one = machine(BETWEEN.replace(line, f"cylinder = {ends}\n{small}"))
    assert max(crankwork.analyse(one).checks.values()) < 1e-11


def test_all_joint_forces_are_those_of_one_system_of_two_links_more(heavy):
    results, _ = heavy
    one, grid = results.machine, crankwork.CrankGrid.from_degrees(DEGREES)
    solved = solve_linkage(one, traced_motion(one.mechanism, linkage_motion(one.mechanism, grid), one.linkage))
    running = operating_state(solved, linkage_motion(one.mechanism, grid))
    groups, system = joint_forces(running), system_joint_forces(running)
    largest = float(np.max(np.abs(system.balancing_torque)))
    assert groups.balancing_torque == pytest.approx(system.balancing_torque, abs=1e-12 * largest)
    for name, pin in system.pins.items():
        assert groups.pins[name].x == pytest.approx(pin.x, abs=1e-12 * largest)
        assert groups.pins[name].y == pytest.approx(pin.y, abs=1e-12 * largest)
    for name, guide in system.guides.items():
        assert groups.guides[name].normal == pytest.approx(guide.normal, abs=1e-12 * largest)
        assert groups.guides[name].moment == pytest.approx(guide.moment, abs=1e-12 * largest)


@for_each(
    ("text", "told"),
    [
        (HEAVY.replace('mass = "60 kg", ', ""), r"driver\.barrel\.mass"),
        (HEAVY.replace(', centre = ["0.5 m", "-0.02 m"]', ""), r"driver\.rod\.centre"),
        (
            (MACHINES / "driven-slider.toml")
            .read_text("utf-8")
            .replace('slider = "piston"', f'slider = "piston"\n{ROD}', 1),
            r"driver\.rod: rod belongs to a hydraulic cylinder",
        ),
    ],
)
def test_mistakes_are_told_with_their_place(text, told):
    with pytest.raises(crankwork.InputError, match=told):
        machine(text)
