"""Dead centres and extremes of piston velocity and acceleration, by root finding."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.slider_crank import SliderCrank

_NEAR = 65
_MAX_STEPS = 40


def closed_in(function: Callable[[Array], Array], low: Array, high: Array, at_low: Array, at_high: Array) -> Array:
    """Return a root between each pair of angles at which a function has different signs, to the last bit. [deg]"""
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
    """Return where a function that grows or falls all the way reaches a value; the nearer end if it does not. [deg]"""
    angles = np.linspace(start, end, _NEAR)
    apart = function(angles) - wanted
    if apart[0] * apart[-1] >= 0:
        return start if abs(apart[0]) < abs(apart[-1]) else end
    at = int(np.argmax(np.sign(apart[1:]) != np.sign(apart[0])))
    low, high = slice(at, at + 1), slice(at + 1, at + 2)
    return float(
        closed_in(lambda degrees: function(degrees) - wanted, angles[low], angles[high], apart[low], apart[high])[0]
    )


def dead_centres(slider_crank: SliderCrank) -> tuple[float, float]:
    """Return the crank angles of top and bottom dead centre. [deg]

    Source: kolchin_demidov_2008, ch. 6; crank and rod in line.
    """
    return math.degrees(slider_crank.top_dead_centre), math.degrees(slider_crank.bottom_dead_centre)
