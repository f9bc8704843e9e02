"""Dead centres and extremes of piston velocity and acceleration, by root finding."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.slider_crank import SliderCrank

_NEAR = 65
_MAX_STEPS = 40


def bracketed_roots(
    function: Callable[[Array], Array], low: Array, high: Array, at_low: Array, at_high: Array
) -> Array:
    """Return a root between each pair of angles at which a function has different signs, to the last bit. [deg]"""
    root = high
    for _ in range(_MAX_STEPS):
        # a converged interval waits for the others, with equal values at its ends
        difference = at_high - at_low
        root = high - at_high * (high - low) / np.where(difference == 0, 1.0, difference)
        value = function(root)
        # where a step leads nowhere, or the interval is none, nothing is left to find
        if np.all((np.minimum(np.abs(high - low), np.abs(root - high)) <= 4 * np.spacing(np.abs(high))) | (value == 0)):
            break
        crossed = np.sign(value) != np.sign(at_high)
        # Illinois method: the value at the retained end is halved, so that both ends converge
        low, at_low = np.where(crossed, high, low), np.where(crossed, at_high, at_low / 2)
        high, at_high = root, np.where(value == 0, at_high * 1e-300, value)
    return root


def solve_monotone(function: Callable[[Array], Array], target: float, start: float, end: float) -> float:
    """Solve function(angle) = target for a monotone function; the nearer end if there is no solution. [deg]"""
    angles = np.linspace(start, end, _NEAR)
    residual = function(angles) - target
    if residual[0] * residual[-1] >= 0:
        return start if abs(residual[0]) < abs(residual[-1]) else end
    index = int(np.argmax(np.sign(residual[1:]) != np.sign(residual[0])))
    ends = [(values[index : index + 1], values[index + 1 : index + 2]) for values in (angles, residual)]
    return float(bracketed_roots(lambda degrees: function(degrees) - target, *ends[0], *ends[1])[0])


def dead_centres(slider_crank: SliderCrank) -> tuple[float, float]:
    """Return the crank angles of top and bottom dead centre. [deg]

    Source: kolchin_demidov_2008, ch. 6; crank and rod in line.
    """
    return math.degrees(slider_crank.top_dead_centre), math.degrees(slider_crank.bottom_dead_centre)
