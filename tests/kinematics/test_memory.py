"""A motion that is remembered, replayed at any crank angles, is the motion computed at them."""

import pickle

import numpy as np
import pytest

from crankwork.formula.known import in_order
from crankwork.formula.replay import Program, replay
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.loops import as_chain
from crankwork.kinematics.memory import remembered_motion
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.placement import place
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism
from each import for_each

DENSE = CrankGrid.steps(1.0, 360.0)
GRID = CrankGrid.from_degrees([0.0, 12.34, 90.0, 179.999, 180.0, 200.5, 359.0])


def columns(motion):
    """Return every coordinate of a motion with its derivatives."""
    found = {}
    for name, point in motion.points.items():
        for axis, side in zip("xy", point, strict=True):
            found |= {("point", name, axis, order): one for order, one in enumerate(side)}
    for kind, coordinates in (("link", motion.links), ("slider", motion.sliders)):
        for name, one in coordinates.items():
            found |= {(kind, name, order): value for order, value in enumerate(one)}
    return found


@pytest.fixture(params=["as dyads", "as chains"])
def whole(request, linkages):
    """Give the linkages, or the same solved numerically."""
    if request.param == "as dyads":
        return linkages
    start = CrankGrid.from_degrees([0.0])
    return {
        name: one.__class__(
            one.crank, tuple(as_chain(dyad, place(one, start).links, 0.0) for dyad in one.dyads), one.bodies,
            one.ground, one.points,
        )
        for name, one in linkages.items()
    }  # fmt: skip


def test_the_memory_replayed_is_the_motion(whole):
    for name, mechanism in whole.items():
        remembered = columns(remembered_motion(mechanism, linkage_motion(mechanism, DENSE)))
        found, expected = Program(remembered)(GRID), columns(linkage_motion(mechanism, GRID))
        for key, value in expected.items():
            assert found[key] == pytest.approx(value + 0.0 * GRID.angle, rel=1e-14, abs=1e-14), (name, key)


def test_a_crank_that_starts_elsewhere_and_turns_back(linkages):
    one = linkages["crank shaper"]
    crank = Crank(one.crank.radius, one.crank.pivot, 0.3, -1, one.crank.pin, one.crank.link)
    mechanism = Mechanism(crank, one.dyads, one.bodies, one.ground, one.points)
    remembered = columns(remembered_motion(mechanism, linkage_motion(mechanism, DENSE)))
    found, expected = Program(remembered)(GRID), columns(linkage_motion(mechanism, GRID))
    for key, value in expected.items():
        assert found[key] == pytest.approx(value + 0.0 * GRID.angle, rel=1e-14, abs=1e-14), key


@for_each("direction", [1, -1])
def test_a_second_pin_of_the_crank_moves(direction):
    mechanism = Mechanism(Crank(0.1, direction=direction), (), points=(LinkPoint("throw", "crank", -0.02, 0.07),))
    motion = remembered_motion(mechanism, linkage_motion(mechanism, DENSE))
    phi = direction * GRID.angle
    expected = direction * (0.02 * np.sin(phi) - 0.07 * np.cos(phi))
    assert replay(motion.points["throw"].x.position_1, GRID) == pytest.approx(expected, abs=1e-15)


def test_what_a_chain_is_solved_for_vanishes(linkages):
    mechanism = linkages["crank shaper"]
    placed = place(mechanism, CrankGrid.from_degrees([0.0]))
    chains = Mechanism(mechanism.crank, tuple(as_chain(one, placed.links, 0.0) for one in mechanism.dyads),
                       mechanism.bodies, mechanism.ground, mechanism.points)  # fmt: skip
    motion = remembered_motion(chains, linkage_motion(chains, DENSE))
    roots = {
        known.node
        for point in motion.points.values()
        for known in in_order(point.x)
        if hasattr(known.node, "residuals")
    }
    assert roots
    for root in roots:
        assert root.residuals
        for one in root.residuals:
            assert np.max(np.abs(replay(one, GRID))) < 1e-12


def test_a_remembered_motion_can_be_pickled(linkages):
    mechanism = linkages["crank shaper"]
    motion = remembered_motion(mechanism, linkage_motion(mechanism, DENSE))
    again = pickle.loads(pickle.dumps(motion.sliders))  # noqa: S301 - our own bytes
    for name, slide in motion.sliders.items():
        assert np.array_equal(replay(again[name].position, GRID), replay(slide.position, GRID))


def test_a_joint_is_followed_from_the_lengths_on(linkages):
    """Every operand down to lengths, fixed points and the crank angle has a name."""
    mechanism = next(one for one in linkages.values() if type(one.dyads[0]).__name__ == "RRR")
    dyad = mechanism.dyads[0]
    motion = remembered_motion(mechanism, linkage_motion(mechanism, DENSE))
    keys = {known.key for known in in_order(motion.points[dyad.point].x)}
    assert {f"link_length.{dyad.link_a}", f"doubled_area.{dyad.point}", "crank_radius"} <= keys
