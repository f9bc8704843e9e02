"""Linkages as a whole: transfer functions, constant lengths, mirror symmetry, what cannot be assembled."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.catalog import four_bar
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Crank, Mechanism
from each import for_each

pytestmark = pytest.mark.elsewhere

TURN = CrankGrid.from_degrees(np.arange(0.0, 360, 1.5))
length = st.floats(0.2, 3.0)


def spectral(values):
    order = np.fft.fftfreq(values.size, 1 / values.size)
    return np.fft.ifft(1j * order * np.fft.fft(values)).real


def check_derivatives(transfer, scale=1.0):
    position, first, second = transfer
    assert spectral(position) == pytest.approx(first, abs=1e-11 * scale)
    assert spectral(first) == pytest.approx(second, abs=1e-10 * scale)


def test_transfer_functions_are_the_spectral_derivatives(linkage):
    solved = linkage_motion(linkage, TURN)
    for point in solved.points.values():
        check_derivatives(point.x)
        check_derivatives(point.y)
    for slider in solved.sliders.values():
        check_derivatives(slider)
    for link in solved.links.values():
        assert spectral(link.position_1) == pytest.approx(link.position_2, abs=1e-9)


def test_the_rate_of_a_link_turns_its_direction(linkage):
    solved = linkage_motion(linkage, TURN)
    for link in solved.frames.values():
        if link.rotates:
            assert spectral(link.cos) == pytest.approx(-link.sin * link.angle_1, abs=1e-10)


@settings(max_examples=25)
@given(length, length, length, st.sampled_from([1, -1]))
def test_lengths_are_constant_and_the_branch_stays(coupler, rocker, ground, branch):
    crank = 0.15
    lengths = (crank, coupler, rocker, ground)
    assume(sum(lengths) - 2 * min(lengths) - 2 * max(lengths) > 1e-3)
    solved = linkage_motion(four_bar(*lengths, branch=branch), TURN)
    a, c, b = (solved.points[name] for name in ("crank_pin", "coupler_pin", "rocker_pivot"))
    assert np.hypot(c.x[0] - a.x[0], c.y[0] - a.y[0]) == pytest.approx(coupler, rel=1e-13)
    assert np.hypot(c.x[0] - b.x[0], c.y[0] - b.y[0]) == pytest.approx(rocker, rel=1e-13)
    side = (b.x[0] - a.x[0]) * (c.y[0] - a.y[0]) - (b.y[0] - a.y[0]) * (c.x[0] - a.x[0])
    assert np.all(side * branch > 0)


@settings(max_examples=25)
@given(length, length, length)
def test_a_mirrored_linkage_moves_as_in_a_mirror(coupler, rocker, ground):
    lengths = (0.15, coupler, rocker, ground)
    assume(sum(lengths) - 2 * min(lengths) - 2 * max(lengths) > 1e-3)
    one = four_bar(*lengths)
    other = replace(four_bar(*lengths, branch=-1), driver=replace(one.crank, direction=-1))
    first, second = (linkage_motion(each, TURN) for each in (one, other))
    for name in first.points:
        for order in range(3):
            assert first.points[name].x[order] == pytest.approx(second.points[name].x[order], abs=1e-12)
            assert first.points[name].y[order] == pytest.approx(-second.points[name].y[order], abs=1e-12)


def test_the_angle_of_a_link_that_turns_fully_has_no_jump():
    machine = four_bar(0.1, 0.2, 0.2, 0.05)
    coarse = CrankGrid.from_degrees(np.arange(0, 721, 60.0))
    angle = linkage_motion(machine, coarse).links["rocker"].position
    assert angle[-1] - angle[0] == pytest.approx(4 * np.pi)


@for_each(
    ("lengths", "degrees", "text"),
    [
        (
            (3, 4, 5, 11),
            np.arange(360.0),
            "do not meet at coupler_pin at a crank angle of 180 deg: together they are 5000 mm too short",
        ),
        ((1, 6, 2, 4), np.arange(360.0), "coupler is 1000 mm too long; shorten it, lengthen rocker"),
        (
            (2, 4, 2, 4),
            np.arange(360.0),
            "coupler and rocker are in line at a crank angle of 0 deg: a singular position",
        ),
        ((2, 4, 2, 4), np.arange(0.5, 360), "coupler and rocker are in line at a crank angle of 180 deg"),
        ((2, 4, 2, 4), np.arange(15.0, 360, 30), "coupler and rocker are in line at a crank angle of 180 deg"),
    ],
)
def test_what_cannot_be_assembled_is_named_with_angle_and_length(lengths, degrees, text):
    with pytest.raises(GeometryError, match=text):
        linkage_motion(four_bar(*lengths), CrankGrid.from_degrees(degrees))


def test_a_parallelogram_works_on_either_side_of_its_change_points():
    solved = linkage_motion(four_bar(2, 4, 2, 4), CrankGrid.from_degrees(np.arange(1.0, 180)))
    assert solved.links["rocker"].position_1 == pytest.approx(1.0)


def test_a_short_rod_names_its_guide():
    machine = Mechanism(Crank(0.05, pin="A"), (RRP("A", "P", "rod", 0.04),))
    with pytest.raises(
        GeometryError, match=r"rod does not reach the guide of P at a crank angle of .* it is 10 mm too short"
    ):
        linkage_motion(machine, TURN)


def test_a_dyad_on_nothing_is_refused():
    with pytest.raises(GeometryError, match="rests on 'X'"):
        linkage_motion(Mechanism(Crank(0.05), (RRP("X", "P", "rod", 0.4),)), TURN)
