"""Dead centres and extremes of piston velocity and acceleration, by root finding."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.slider_crank import SliderCrank

_SCAN = 720
_MAX_STEPS = 40


def closed_in(function: Callable[[Array], Array], low: Array, high: Array, at_low: Array, at_high: Array) -> Array:
    """Return a root between each pair of angles at which a function has different signs, to the last bit.

    `function`: takes and returns an array of shape (n,). [deg] -> any; `low`, `high`, `at_low` and `at_high`: the
    ends of the ranges [deg], and the function there.
    """
    root = high
    for _ in range(_MAX_STEPS):
        # one that is found waits for the others, and between its ends nothing is left
        apart = at_high - at_low
        root = high - at_high * (high - low) / np.where(apart == 0, 1.0, apart)
        value = function(root)
        if np.all((np.abs(high - low) <= 4 * np.spacing(np.abs(high))) | (value == 0)):
            break
        crossed = np.sign(value) != np.sign(at_high)
        # Illinois: the end that stays is halved, so that both ends close in
        low, at_low = np.where(crossed, high, low), np.where(crossed, at_high, at_low / 2)
        high, at_high = root, np.where(value == 0, at_high * 1e-300, value)
    return root


def reached(function: Callable[[Array], Array], wanted: float, start: float, end: float) -> float:
    """Return where a function that grows or falls all the way reaches a value; the nearer end if it does not.

    `function`: takes and returns an array of shape (n,). [deg] -> any; `start` and `end`: range to search [deg].
    """
    ends = np.array([[start], [end]], dtype=float)
    at_start, at_end = (function(one) - wanted for one in ends)
    if at_start[0] * at_end[0] >= 0:
        return start if abs(at_start[0]) < abs(at_end[0]) else end
    return float(closed_in(lambda degrees: function(degrees) - wanted, ends[0], ends[1], at_start, at_end)[0])


def dead_centres(slider_crank: SliderCrank) -> tuple[float, float]:
    """Return the crank angles of top and bottom dead centre. [deg]

    Source: kolchin_demidov_2008, ch. 6; crank and rod in line.
    """
    return math.degrees(slider_crank.top_dead_centre), math.degrees(slider_crank.bottom_dead_centre)
