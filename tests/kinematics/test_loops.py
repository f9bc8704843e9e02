"""Newton's method on whole groups: the same as the dyads, and groups that are none."""

from dataclasses import replace

import numpy as np
import pytest

import linkages
from crankwork.errors import GeometryError
from crankwork.kinematics import chain_solver
from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.configuration_curve import driver_coordinate
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.crank_range import find_crank_range
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.position_analysis import ChainRoot, place
from crankwork.mechanism.dyads import Chain, ChainLink
from linkages import mechanism_from
from motions import changed

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(0.0, 360, 10))

TRIAD = changed(linkages.TRIAD, "links.plate.points", {"S": [0.05, 0.01]})


def test_every_dyad_moves_as_newton_finds(linkage):
    mechanism = linkage
    solved = linkage_motion(mechanism, GRID)
    chains = tuple(as_chain(dyad, solved.frames, 0.0) for dyad in mechanism.dyads)
    other = linkage_motion(replace(mechanism, dyads=chains), GRID)
    for order in range(3):
        for point, motion in solved.points.items():
            assert motion.x[order] == pytest.approx(other.points[point].x[order], abs=1e-12)
            assert motion.y[order] == pytest.approx(other.points[point].y[order], abs=1e-12)
        for slider, distance in solved.sliders.items():
            assert distance[order] == pytest.approx(other.sliders[slider][order], abs=1e-12)
        for link, angle in solved.links.items():
            if order:
                assert angle[order] == pytest.approx(other.links[link][order], abs=1e-12)


NEARLY_DEAD = {
    "fixed_points": {"O": (0, 0), "E": (0.029775615, -0.005602487)},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.081995565},
    "positions": {"B": (0.090128309, 0.070686406), "C": (0.166003812, 0.072204015), "D": (0.129969345, 0.046042581)},
    "links": {
        "plate": {"joins": ["B", "C"], "length": 0.075890678, "points": {"D": (0.039340259, -0.025435610)}},
        "rod": {"joins": ["A", "B"], "length": 0.071152719},
        "arm": {"joins": ["E", "D"], "length": 0.112720878},
    },
    "guides": {"line": {"through": (0.166003812, 0.072204015), "angle": -2.25226}},
    "sliders": {"piece": {"pin": "C", "guide": "line"}},
}


def test_a_group_of_class_iii_keeps_its_branch_up_to_its_dead_positions():
    """Positions follow the circuit, which goes by its arc and knows no dead position."""
    mechanism, problems = mechanism_from(NEARLY_DEAD)
    assert problems == []
    found = find_crank_range(mechanism)
    arc = np.linspace(found.branch.start, found.branch.end, 402)[1:-1]
    there = found.circuit.stretch(arc)
    cranks = found.circuit.values(driver_coordinate(mechanism), arc)
    solved = place(mechanism, CrankGrid.from_radians(cranks)).links
    for link in ("plate", "rod", "arm"):
        # what is lost near a dead position is the square root of the rounding
        assert solved[link].cos == pytest.approx(np.cos(there.angles[link].position), abs=1e-6)
        assert solved[link].sin == pytest.approx(np.sin(there.angles[link].position), abs=1e-6)


@pytest.fixture(scope="module")
def triad():
    mechanism, problems = mechanism_from(TRIAD)
    assert problems == []
    return mechanism


def test_a_triad_turns_with_constant_lengths(triad):
    solved = linkage_motion(triad, CrankGrid.from_degrees(np.arange(360.0)))
    c, e = solved.points["C"], solved.points["E"]
    assert np.hypot(c.x[0] - e.x[0], c.y[0] - e.y[0]) == pytest.approx(0.4, rel=1e-13)
    order = np.fft.fftfreq(360, 1 / 360)
    for point in ("B", "C", "D", "S"):
        for position, first, second in solved.points[point]:
            assert np.fft.ifft(1j * order * np.fft.fft(position)).real == pytest.approx(first, abs=1e-10)
            assert np.fft.ifft(1j * order * np.fft.fft(first)).real == pytest.approx(second, abs=1e-9)


def test_the_result_does_not_depend_on_the_grid(triad):
    whole = linkage_motion(triad, CrankGrid.from_degrees(np.arange(360.0))).points["S"]
    one = linkage_motion(triad, CrankGrid.from_degrees([217.0])).points["S"]
    for order in range(3):
        assert one.x[order][0] == pytest.approx(whole.x[order][217], abs=1e-13)


def test_a_triad_that_locks_is_named():
    mechanism, _ = mechanism_from(changed(TRIAD, "crank.radius", 0.9))
    with pytest.raises(GeometryError, match=r"links rod, plate, arm, leg cannot be brought from their start at 0 deg"):
        linkage_motion(mechanism, CrankGrid.from_degrees(np.arange(360.0)))


def test_a_start_that_does_not_close_is_refused(triad):
    (chain,) = triad.dyads
    rod = replace(chain.links[0], points={"A": (0.0, 0.0), "B": (9.0, 0.0)})
    far = replace(triad, dyads=(replace(chain, links=(rod, *chain.links[1:])),))
    with pytest.raises(GeometryError, match=r"cannot be assembled at a crank angle of 0 deg from the given start"):
        linkage_motion(far, GRID)


def test_a_chain_with_a_joint_missing_is_refused(triad):
    loose = Chain((ChainLink("rod", (0, 0), 0.0, {"crank_pin": (0, 0), "B": (1, 0)}),), known=frozenset({"crank_pin"}))
    with pytest.raises(GeometryError, match=r"2 equations for 3 coordinates"):
        linkage_motion(replace(triad, dyads=(loose,), points=()), GRID)


def test_a_turn_of_a_triad_is_followed_once(triad):
    """A thousand turns on it is where it was, and that is known without following them."""
    first = linkage_motion(triad, CrankGrid.from_degrees([17.0, 200.0])).points["S"]
    later = linkage_motion(triad, CrankGrid.from_degrees([360_017.0, 360_200.0])).points["S"]
    for order in range(3):
        assert later.x[order] == pytest.approx(first.x[order], abs=1e-11)
        assert later.y[order] == pytest.approx(first.y[order], abs=1e-11)


def test_a_chain_is_followed_on_from_where_it_was(triad, monkeypatch):
    """Asked for a little more it does not start again, and it gets where it gets when all is asked for at once."""
    index = next(at for at, group in enumerate(triad.dyads) if isinstance(group, Chain))
    starts = []
    begun = chain_solver._start
    monkeypatch.setattr(chain_solver, "_start", lambda *what: starts.append(1) or begun(*what))
    root = ChainRoot(triad, index)
    for degrees in (10.0, 60.0, 200.0, -30.0, 350.0):
        root(CrankGrid.from_degrees([0.0, degrees]))
    assert len(starts) == 1
    at_once = ChainRoot(triad, index)(CrankGrid.from_degrees([-30.0, 60.0, 200.0, 350.0]))
    assert root(CrankGrid.from_degrees([-30.0, 60.0, 200.0, 350.0])) == pytest.approx(at_once, abs=1e-12)
