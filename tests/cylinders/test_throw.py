"""The crank gear of a throw as a mechanism of dyads moves as the engine's own formulas say."""

import numpy as np
import pytest

from crankwork.cylinders.arrangement import radial, vee
from crankwork.cylinders.articulated import ArticulatedRod, articulated_motion, throw_mechanism
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank

pytestmark = pytest.mark.elsewhere

LENGTHS = SliderCrank(0.06, 0.21, 0.004)


def test_rods_on_one_crankpin_move_like_single_cylinders():
    layout = vee(2, (1, 2), 70.0, throws=(0.0,), uneven=True)[0]
    grid = CrankGrid.from_degrees(np.arange(0.0, 360.0, 7.0))
    moving = linkage_motion(throw_mechanism(layout, LENGTHS), grid)
    for place in layout.places:
        own = CrankGrid.from_degrees(grid.degrees - (place.axis - layout.places[0].axis))
        expected = piston_motion(LENGTHS, own).piston
        found = moving.sliders[f"B{place.number}"]
        assert np.ptp(found.position + expected.position) < 1e-12
        assert found.position_1 == pytest.approx(-expected.position_1, abs=1e-13)
        assert found.position_2 == pytest.approx(-expected.position_2, abs=1e-12)


def test_articulated_rods_move_like_their_own_formulas():
    layout = radial(5, master=1)[0]
    lengths = SliderCrank(0.06, 0.25)
    articulated_rods = [None, *(ArticulatedRod(0.19, 0.055, one.axis + 1.5, one.axis) for one in layout.places[1:])]
    grid = CrankGrid.from_degrees(np.arange(0.0, 360.0, 7.0))
    moving = linkage_motion(throw_mechanism(layout, lengths, articulated_rods), grid)
    for place, rod in zip(layout.places[1:], articulated_rods[1:], strict=True):
        own = CrankGrid.from_degrees(grid.degrees - place.axis)
        expected = articulated_motion(lengths, rod, own).piston
        found = moving.sliders[f"B{place.number}"]
        assert np.ptp(found.position + expected.position) < 1e-12
        assert found.position_1 == pytest.approx(-expected.position_1, abs=1e-13)
        assert found.position_2 == pytest.approx(-expected.position_2, abs=1e-12)
