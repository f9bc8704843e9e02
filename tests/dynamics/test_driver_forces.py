"""Force, torque and power of drivers that are no crank: by closed forms and by every route."""

import math
from dataclasses import replace

import numpy as np
import pytest

import driven
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState, link_wrenches
from crankwork.dynamics.routes import TORQUE_METHODS, torque_by_groups
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.motion_laws import law_at
from crankwork.kinematics.traced_motion import traced_mechanism, traced_motion
from crankwork.loads.load import ForceOnPoint, TorqueOnLink, Weight, applied_loads
from crankwork.mechanism.driver import Cylinder, DrivingSlider
from crankwork.mechanism.dyads import RRP, RRR, Chain, ChainLink, Guide
from crankwork.mechanism.mechanism import LinkPoint, Mechanism, body_at
from driven import there_and_back
from each import for_each

pytestmark = pytest.mark.elsewhere
GRID = CrankGrid.from_degrees(np.linspace(3.0, 350.0, 41))
DENSE = CrankGrid.steps(1.0, 360.0)


BOOM = replace(driven.BOOM, bodies=(body_at("boom", 120.0, 30.0, "T"),))
ELBOW = replace(
    driven.ELBOW,
    bodies=(body_at("upper", 4.0, 0.2, "P"), body_at("rocker", 3.0, 0.1, "D"), body_at("lower", 2.0, 0.05, "D")),
)
TURNED_ROUND = replace(BOOM, driver=Cylinder("B", "A", BOOM.driver.law))
LINKS = (
    ChainLink("cylinder", (0.4, -0.2), 2.0, {"A": (0.0, 0.0), "B": (0.8, 0.0)}),
    ChainLink("boom", (0.1, 0.5), -0.3, {"O": (0.0, 0.0), "B": (0.9, 0.0)}),
)
CHAIN = replace(BOOM, dyads=(Chain(LINKS, (), frozenset({"A", "O"}), 0.8, 0.9),))
DRIVEN = Mechanism(
    DrivingSlider("piston", Guide((0.0, 0.01), 0.2), there_and_back(0.18, 0.22)),
    (RRR("B", "O", "A", "rod", "arm", 0.2, 0.05),),
    (body_at("piston", 0.5, 0.0, "B"), body_at("rod", 0.7, 0.002, "S"), body_at("arm", 0.3, 0.001, "A")),
    ground={"O": (0.0, 0.0)},
    points=(LinkPoint("B", "piston", 0.0), LinkPoint("S", "rod", 0.1, -0.02)),
)
PUSHED = Mechanism(
    Cylinder("A", "C", there_and_back(0.35, 0.5)),
    (RRP("A", "C", "cylinder", 0.35, (0.0, 0.3), 0.1, block="ram"), RRR("C", "D", "E", "link", "arm", 0.4, 0.3)),
    (body_at("ram", 3.0, 0.0, "C"), body_at("link", 2.0, 0.1, "E")),
    ground={"A": (0.0, 0.0), "D": (0.6, 0.5)},
)
EVERY = {
    "boom": (BOOM, "boom"), "turned round": (TURNED_ROUND, "boom"), "chain": (CHAIN, "boom"), "driven": (DRIVEN, "arm"),
    "pushed": (PUSHED, "arm"), "elbow": (ELBOW, "rocker"),
}  # fmt: skip


def running(mechanism, link, grid=GRID):
    """Return a mechanism at work, with its weights and a torque."""
    motion = linkage_motion(mechanism, grid)
    _, rate, second = law_at(mechanism.driver.law, grid)
    loads = applied_loads(mechanism, motion, (Weight(9.81), TorqueOnLink(link, 3.0)))
    return OperatingState(mechanism, motion, rate, loads, second)


@for_each(("mechanism", "link"), EVERY.values(), ids=EVERY)
def test_every_route_gives_the_same(mechanism, link):
    at_work = running(mechanism, link)
    found = torque_by_groups(at_work)
    for name, route in TORQUE_METHODS.items():
        assert route(at_work) == pytest.approx(found, rel=1e-10, abs=1e-9), name


@for_each(("mechanism", "link"), EVERY.values(), ids=EVERY)
def test_the_memory_replayed_is_the_number(mechanism, link):
    motion = traced_motion(mechanism, linkage_motion(mechanism, DENSE))
    own = traced_mechanism(mechanism)
    _, rate, second = motion.driver
    loads = applied_loads(own, motion, (Weight(9.81), TorqueOnLink(link, 3.0)))
    traced = joint_forces(OperatingState(own, motion, rate, loads, second))
    expected = joint_forces(running(mechanism, link))
    columns = {"driven": traced.balancing_torque} | {name: pin.x for name, pin in traced.pins.items()}
    columns |= {name: guide.normal for name, guide in traced.guides.items()}
    numbers = {"driven": expected.balancing_torque} | {name: pin.x for name, pin in expected.pins.items()}
    numbers |= {name: guide.normal for name, guide in expected.guides.items()}
    assert columns.keys() == numbers.keys()
    for name, column in Program(columns)(GRID).items():
        assert column == pytest.approx(numbers[name] + 0.0 * GRID.angle, rel=1e-9, abs=1e-9), name


def test_a_cylinder_under_a_boom_by_hand():
    # weight of the boom times its lever, over the lever of the cylinder, moving slowly
    motion = linkage_motion(BOOM, GRID)
    loads = applied_loads(BOOM, motion, (ForceOnPoint("T", 0.0, -1000.0),))
    found = joint_forces(OperatingState(BOOM, motion, 0.0, loads)).balancing_torque
    (ox, oy), (ax, ay) = BOOM.ground["O"], BOOM.ground["A"]
    q = law_at(BOOM.driver.law, GRID).position
    base, arm = math.hypot(ax - ox, ay - oy), 0.9
    gamma = np.arccos((base**2 + arm**2 - q**2) / (2 * base * arm))
    direction = math.atan2(ay - oy, ax - ox) + gamma
    lever = base * arm * np.sin(gamma) / q
    reach = 2.0 * np.cos(direction) - 0.1 * np.sin(direction)
    assert found * lever == pytest.approx(1000.0 * reach, rel=1e-12)


def test_forces_of_the_motor_of_an_elbow_are_those_of_its_links_alone():
    # nothing but a couple holds a weightless link that is free at its end
    at_work = running(ELBOW, "rocker")
    found = joint_forces(at_work)
    torque, lower = found.balancing_torque, at_work.motion.frames["lower"]
    wrench = link_wrenches(at_work)["lower"]
    pin = found.pins["C"]
    way = at_work.motion.points["C"]
    x, y = way.x.position - lower.origin.x.position, way.y.position - lower.origin.y.position
    sign = 1.0 if pin.joint.link == "lower" else -1.0
    assert wrench.moment + torque + sign * (x * pin.y - y * pin.x) == pytest.approx(0.0, abs=1e-9)
