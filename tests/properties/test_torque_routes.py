"""Independent routes to one torque: joint forces in two ways, Zhukovsky's lever, virtual work, energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.friction import GuideFriction, PinFriction, friction_forces
from crankwork.dynamics.friction_equations import CONVERGED, NOT_CONVERGED
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.reduction import crank_torque
from crankwork.dynamics.routes import virtual_work_torque, zhukovsky_torque
from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import (
    ForceOnPoint,
    Load,
    ProcessForce,
    SliderSpring,
    Spring,
    TorqueOnLink,
    Weight,
    applied_loads,
)
from crankwork.mechanism.catalog import (
    crank_shaper,
    four_bar,
    scotch_yoke,
    stephenson_six_bar,
    toggle_press,
    watt_six_bar,
    whitworth,
)
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Chain, Dyad, Guide
from crankwork.mechanism.joints import SlidingJoint, group_links, joints
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at, slider_crank
from each import for_each
from linkages import mechanism_from, slotted_press

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(0.0, 360, 5))
FOUR_BAR = RRR("A", "B", "C", "rod", "rocker", 0.2, 0.12)
YOKE = RPP("A", "yoke", "yoke_block", Guide((0.0, 0.0), 1.2), Guide((0.1, 0.02), 0.3))
TRIAD, _ = mechanism_from(
    {
        "fixed_points": {"O": [0, 0], "E": [0.2, 0.5], "F": [0.26, 0.4]},
        "crank": {"pivot": "O", "pin": "A", "radius": 0.03},
        "positions": {"B": [0.15, 0.03], "C": [0.2, 0.1], "D": [0.2, -0.05]},
        "links": {
            "rod": {"joins": ["A", "B"]},
            "plate": {"joins": ["B", "C", "D"]},
            "arm": {"joins": ["C", "E"]},
            "leg": {"joins": ["D", "F"]},
        },
    }
)
assert TRIAD is not None

MECHANISMS = {
    "slider-crank": slider_crank(0.05, 0.2, 0.01),
    "four-bar": four_bar(0.05, 0.2, 0.12, 0.18),
    "watt": watt_six_bar(four_bar(0.05, 0.2, 0.12, 0.18), (0.08, 0.05), 0.2, 0.15, (0.4, 0.0)),
    "stephenson": stephenson_six_bar(four_bar(0.05, 0.2, 0.12, 0.18), (0.1, 0.05), 0.25, 0.15, (0.25, 0.2)),
    "crank shaper": crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14),
    "whitworth": whitworth(0.05, 0.02, 0.06, 0.3, 0.01),
    "scotch yoke": scotch_yoke(0.05, 1.1),
    "toggle press": toggle_press(0.05, 0.3, 0.2, 0.2, (0.28, 0.25)),
    "slotted press": slotted_press(),
    "triad": TRIAD,
    "offset slotted lever, clockwise": Mechanism(
        Crank(0.05, direction=-1, pin="A"),
        (RPR("A", "B", "lever", "block", Guide((0.03, 0.012), 0.2), -1), RRP("C", "ram", "rod", 0.3, (0.0, 0.1), 0.1)),
        ground={"B": (0.0, -0.15)},
        points=(LinkPoint("C", "lever", -0.02, -0.3),),
    ),
    "guide on the lever": Mechanism(
        Crank(0.05, start=0.3, pin="A"),
        (RPR("A", "B", "lever", "block"), PRP("D", "up", "ram", Guide((0.0, 0.01), 0.05, "lever"), Guide((0, 0.2)))),
        ground={"B": (0.0, -0.15)},
    ),
    "guides on rocker and yoke": Mechanism(
        Crank(0.05, start=0.3, pin="A"),
        (
            FOUR_BAR,
            YOKE,
            RRP("O", "S", "arm", 0.3, (0.02, 0.03), 0.4, 1, "rocker"),
            RRP("A", "T", "leg", 0.3, (0.02, 0.03), 0.4, -1, "yoke"),
        ),
        ground={"B": (0.18, 0.0), "O": (0.0, -0.1)},
    ),
    "yoke on the rod": Mechanism(
        Crank(0.05, start=0.3, pin="A"),
        (FOUR_BAR, RPP("O", "yoke", "yoke_block", Guide((0.01, 0.0), 1.3), Guide((0.02, 0.03), 0.4, "rod"))),
        ground={"B": (0.18, 0.0), "O": (0.0, 0.1)},
    ),
}


def working(mechanism: Mechanism, seed: int = 1) -> OperatingState:
    """Return a mechanism with a mass, a force and a torque on every link, springs and a process force."""
    chance = np.random.default_rng(seed)
    links = [mechanism.crank.link, *(link for group in mechanism.dyads for link in group_links(group))]
    centres = tuple(LinkPoint(f"centre_{link}", link, *chance.uniform(-0.1, 0.1, 2)) for link in links)
    bodies = tuple(body_at(link, chance.uniform(1, 5), chance.uniform(0.01, 0.1), f"centre_{link}") for link in links)
    mechanism = replace(mechanism, points=mechanism.points + centres, bodies=bodies)
    sliders = [joint.link for joint in joints(mechanism) if isinstance(joint, SlidingJoint)]
    resistance = LoadCurve((-2.0, 0.0, 0.01, 2.0), (50.0, 100.0, 200.0, 300.0), "monotone")
    loads: list[Load] = [
        Weight(),
        Spring(f"centre_{links[0]}", f"centre_{links[-1]}", 2000.0, 0.1, 10.0),
        *(TorqueOnLink(link, chance.uniform(-20, 20)) for link in links),
        *(ForceOnPoint(f"centre_{link}", *chance.uniform(-200, 200, 2)) for link in links),
        *(SliderSpring(slider, 1000.0, 0.01, 5.0) for slider in sliders),
        *(ProcessForce(slider, resistance) for slider in sliders),
    ]
    moved = linkage_motion(mechanism, GRID)
    return OperatingState(mechanism, moved, 30.0, applied_loads(mechanism, moved, loads), 15.0)


def columns_of(found: JointForces) -> dict[str, np.ndarray]:
    """Return every force and moment in the joints, and the balancing torque, by name."""
    pins = {f"{name}.{part}": getattr(pin, part) for name, pin in found.pins.items() for part in "xy"}
    guides = {
        f"{name}.{part}": getattr(guide, part) for name, guide in found.guides.items() for part in ("normal", "moment")
    }
    return {**pins, **guides, "balancing_torque": found.balancing_torque}


def check_routes(running: OperatingState) -> None:
    """Check that all routes agree to 1e-10 of the largest torque, and both solutions in all joint forces."""
    groups, system = joint_forces(running), system_joint_forces(running)
    expected = crank_torque(running).driving
    close = pytest.approx(expected, rel=0, abs=1e-10 * np.max(np.abs(expected)))
    assert groups.balancing_torque == close
    assert system.balancing_torque == close
    assert zhukovsky_torque(running) == close
    assert virtual_work_torque(running) == close
    columns, others = columns_of(groups), columns_of(system)
    assert list(columns) == list(others)
    largest = max(np.max(np.abs(column)) for column in columns.values())
    for key, column in columns.items():
        assert column == pytest.approx(others[key], rel=0, abs=1e-10 * largest), key


@for_each("name", MECHANISMS)
def test_all_routes_agree(name):
    check_routes(working(MECHANISMS[name]))


@for_each("name", [name for name in MECHANISMS if name not in ("triad", "slider-crank")])
def test_a_dyad_solved_as_a_group_of_any_class_gives_the_same_torque(name):
    running = working(MECHANISMS[name])
    chains = tuple(
        as_chain(dyad, running.motion.frames, 0.0) for dyad in running.mechanism.dyads if not isinstance(dyad, Chain)
    )
    other = replace(running, mechanism=replace(running.mechanism, dyads=chains))
    expected = joint_forces(running).balancing_torque
    found = joint_forces(other).balancing_torque
    assert found == pytest.approx(expected, rel=0, abs=1e-10 * np.max(np.abs(expected)))


share = st.floats(0, 1)


@st.composite
def six_bars(draw):
    """Return a six-bar that turns fully, away from singular positions, its second group of any type."""
    crank, ground = 0.05, 0.1 + 0.2 * draw(share)
    coupler, rocker = _two_lengths(draw, ground - crank, ground + crank)
    first = four_bar(crank, coupler, rocker, ground, branch=draw(st.sampled_from([1, -1])))
    start, turning = 6 * draw(share), draw(st.sampled_from([1, -1]))
    first = replace(first, driver=replace(first.crank, start=start, direction=turning))
    carrier = draw(st.sampled_from(["coupler", "rocker"]))
    pin = LinkPoint("P", carrier, 0.3 * draw(share) - 0.1, 0.2 * draw(share) - 0.1)
    first = replace(first, points=(pin,))
    x, y = (one.position for one in linkage_motion(first, GRID).points["P"])
    middle_x, middle_y = (x.max() + x.min()) / 2, (y.max() + y.min()) / 2
    size = np.hypot(x - middle_x, y - middle_y).max()
    direction = 2 * np.pi * draw(share)
    away = size * (1.5 + draw(share))
    pivot = (middle_x + away * np.cos(direction), middle_y + away * np.sin(direction))
    distance = np.hypot(x - pivot[0], y - pivot[1])
    ends = {**first.ground, "Q": pivot}
    branch = draw(st.sampled_from([1, -1]))
    group: Dyad
    match draw(st.sampled_from(["RRR", "RRP", "RPR", "PRP", "RPP"])):
        case "RRR":
            link, output = _two_lengths(draw, distance.min(), distance.max())
            group = RRR("P", "Q", "R", "link", "output", link, output, branch)
        case "RRP":
            across = (y - pivot[1]) * np.cos(direction) - (x - pivot[0]) * np.sin(direction)
            length = np.abs(across).max() * (1.2 + draw(share))
            group = RRP("P", "R", "link", length, pivot, direction, branch, block="ram")
        case "RPR":
            group = RPR("P", "Q", "lever", "block", Guide((0.1, 0.3 * distance.min() * draw(share)), 0.0), branch)
        case "PRP":
            turn = linkage_motion(first, GRID).links[carrier].position
            if np.ptp(turn) > 2:
                turn, carrier = np.zeros(1), ""
            square = (turn.max() + turn.min()) / 2 + np.pi / 2
            group = PRP("R", "one", "two", Guide((0.02, 0.01), 0.2, carrier), Guide(pivot, square + 0.2))
        case _:
            group = RPP("P", "yoke", "block", Guide((0.02, 0.01), 0.6 + 2 * draw(share)), Guide(pivot, direction))
    return replace(first, dyads=(*first.dyads, group), ground=ends)


def _two_lengths(draw, least, most):
    """Return two lengths that close a triangle over every distance of a range, with room to spare."""
    total, difference = most * (1.1 + draw(share)), least * 0.8 * (2 * draw(share) - 1)
    return (total + difference) / 2, (total - difference) / 2


@settings(max_examples=60)
@given(mechanism=six_bars(), seed=st.integers(0, 1000))
def test_all_routes_agree_on_any_six_bar(mechanism, seed):
    check_routes(working(mechanism, seed))


@settings(max_examples=20)
@given(mechanism=six_bars(), seed=st.integers(0, 1000), coefficient=st.floats(0, 0.2))
def test_friction_takes_the_power_that_the_crank_gives_more(mechanism, seed, coefficient):
    running = working(mechanism, seed)
    found = friction_forces(
        running,
        [
            GuideFriction(joint.link, coefficient, 0.1)
            if isinstance(joint, SlidingJoint)
            else PinFriction(joint.name, 0.01, coefficient)
            for joint in joints(running.mechanism)
        ],
    )
    assert NOT_CONVERGED not in found.status
    free = found.status == CONVERGED
    extra = 30.0 * (found.joint_forces.balancing_torque - found.ideal_torque)
    assert (found.power_loss[free] >= 0).all()
    largest = np.max(np.abs(30.0 * found.ideal_torque)) + np.max(found.power_loss[free], initial=0.0)
    assert extra[free] == pytest.approx(found.power_loss[free], rel=0, abs=1e-9 * largest)
