"""A motion that is remembered, replayed at any crank angles, is the motion computed at them."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from crankwork.formula.replay import replay
from crankwork.formula.traced_value import in_order
from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.position_analysis import place
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism
from each import for_each
from motions import not_alike, traced

DENSE = CrankGrid.steps(1.0, 360.0)
GRID = CrankGrid.from_degrees([0.0, 12.34, 90.0, 179.999, 180.0, 200.5, 359.0])


def solved(mechanism):
    """Return a mechanism whose dyads are solved numerically."""
    start = place(mechanism, CrankGrid.from_degrees([0.0])).links
    return replace(mechanism, dyads=tuple(as_chain(dyad, start, 0.0) for dyad in mechanism.dyads))


@pytest.mark.slow
@for_each("makes", [lambda one: one, solved], ids=["as dyads", "as chains"])
def test_the_memory_replayed_is_the_motion(linkages, makes):
    missed = {name: not_alike(*traced(makes(one), GRID), rel=1e-14, abs=1e-14) for name, one in linkages.items()}
    assert {name: keys for name, keys in missed.items() if keys} == {}


def test_a_crank_that_starts_elsewhere_and_turns_back(linkages):
    one = linkages["crank shaper"]
    turned = replace(one, driver=replace(one.crank, start=0.3, direction=-1))
    assert not_alike(*traced(turned, GRID), rel=1e-14, abs=1e-14) == []


@for_each("direction", [1, -1])
def test_a_second_pin_of_the_crank_moves(direction):
    mechanism = Mechanism(Crank(0.1, direction=direction), (), points=(LinkPoint("throw", "crank", -0.02, 0.07),))
    motion = traced_motion(mechanism, linkage_motion(mechanism, DENSE))
    phi = direction * GRID.angle
    expected = direction * (0.02 * np.sin(phi) - 0.07 * np.cos(phi))
    assert replay(motion.points["throw"].x.position_1, GRID) == pytest.approx(expected, abs=1e-15)


def test_what_a_chain_is_solved_for_vanishes(linkages):
    chains = solved(linkages["crank shaper"])
    motion = traced_motion(chains, linkage_motion(chains, DENSE))
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
    motion = traced_motion(mechanism, linkage_motion(mechanism, DENSE))
    again = pickle.loads(pickle.dumps(motion.sliders))  # noqa: S301 - our own bytes
    for name, slide in motion.sliders.items():
        assert np.array_equal(replay(again[name].position, GRID), replay(slide.position, GRID))


def test_a_joint_is_followed_from_the_lengths_on(linkages):
    """Every operand down to lengths, fixed points and the crank angle has a name."""
    mechanism = next(one for one in linkages.values() if type(one.dyads[0]).__name__ == "RRR")
    dyad = mechanism.dyads[0]
    motion = traced_motion(mechanism, linkage_motion(mechanism, DENSE))
    keys = {known.key for known in in_order(motion.points[dyad.point].x)}
    assert {f"link_length.{dyad.link_a}", f"doubled_area.{dyad.point}", "crank_radius"} <= keys
