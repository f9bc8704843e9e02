"""Dead centres and extremes of piston velocity and acceleration, by root finding."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid, cos_multiple, sin_multiple
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.series import acceleration_harmonics
from crankwork.kinematics.slider_crank import SliderCrank, piston_transfer_3
from crankwork.method import EXACT, Method

_SCAN = 720
_MAX_STEPS = 40


def roots(function: Callable[[Array], Array], start: float, end: float, *, scan: int = _SCAN) -> Array:
    """Return the sign changes of a function of the crank angle, to the last bit.

    Parameters
    ----------
    function : callable
        Takes and returns an array of shape (n,). [deg] -> any
    start, end : float
        Range to search. [deg]
    scan : int
        Number of equal steps in which each root is to stand alone.

    Returns
    -------
    array, shape (k,)
        The roots, ascending. [deg]
    """
    edges = np.linspace(start, end, scan + 1)
    exact = edges[function(edges) == 0]
    # a root close to one that an edge hits exactly would hide behind it
    aside = (end - start) / scan / 1000
    edges = np.sort(np.concatenate([edges, exact - aside, exact + aside]))
    values = function(edges)
    left = np.flatnonzero(values[:-1] * values[1:] < 0)
    low, high, at_low, at_high = edges[left], edges[left + 1], values[left], values[left + 1]
    root = high
    for _ in range(_MAX_STEPS):
        root = high - at_high * (high - low) / (at_high - at_low)
        value = function(root)
        if np.all((np.abs(high - low) <= 4 * np.spacing(np.abs(high))) | (value == 0)):
            break
        crossed = np.sign(value) != np.sign(at_high)
        # Illinois: the end that stays is halved, so that both ends close in
        low, at_low = np.where(crossed, high, low), np.where(crossed, at_high, at_low / 2)
        high, at_high = root, np.where(value == 0, at_high * 1e-300, value)
    return np.sort(np.concatenate([exact, root]))


def dead_centres(slider_crank: SliderCrank) -> tuple[float, float]:
    """Return the crank angles of top and bottom dead centre.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.

    Returns
    -------
    tuple of float
        Top and bottom. [deg]

    References
    ----------
    kolchin_demidov_2008, ch. 6; crank and rod in line.
    """
    return math.degrees(slider_crank.top_dead_centre), math.degrees(slider_crank.bottom_dead_centre)


def velocity_extremes(slider_crank: SliderCrank, method: Method = EXACT) -> tuple[Array, Array]:
    """Return where the piston velocity is extreme over one revolution, and dx/dphi there.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    method : Method
        Exact, series or textbook.

    Returns
    -------
    tuple of array, shape (k,)
        Crank angles [deg] and dx/dphi [m].

    References
    ----------
    kolchin_demidov_2008, ch. 6; roots of d2x/dphi2.
    """

    def second(degrees: Array) -> Array:
        return piston_motion(slider_crank, CrankGrid.from_degrees(degrees), method).piston.position_2

    angles = roots(second, 0.0, 360.0)
    return angles, piston_motion(slider_crank, CrankGrid.from_degrees(angles), method).piston.position_1


def acceleration_extremes(
    slider_crank: SliderCrank, method: Method = EXACT, *, unsteadiness: float = 0.0
) -> tuple[Array, Array]:
    """Return where the piston acceleration is extreme over one revolution, and the acceleration over w^2 there.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    method : Method
        Exact, series or textbook.
    unsteadiness : float
        Angular acceleration over the square of the angular speed. [-]

    Returns
    -------
    tuple of array, shape (k,)
        Crank angles [deg] and d2x/dphi2 + unsteadiness dx/dphi [m].

    References
    ----------
    kolchin_demidov_2008, ch. 6; roots of the derivative, d3x/dphi3 where the speed is constant.
    """

    def change(degrees: Array) -> Array:
        grid = CrankGrid.from_degrees(degrees)
        third = _third(slider_crank, grid, method)
        if not unsteadiness:
            return third
        return third + unsteadiness * piston_motion(slider_crank, grid, method).piston.position_2

    angles = np.array(sorted(set(np.mod(roots(change, -90.0, 270.0), 360.0).tolist())))
    piston = piston_motion(slider_crank, CrankGrid.from_degrees(angles), method).piston
    return angles, piston.position_2 + unsteadiness * piston.position_1


def _third(slider_crank: SliderCrank, grid: CrankGrid, method: Method) -> Array:
    """Return d3x/dphi3 by the method."""
    if method.is_exact:
        return piston_transfer_3(slider_crank, grid)
    if method.kinematics == "textbook":
        r, lam, e = slider_crank.crank_radius, slider_crank.rod_ratio, slider_crank.offset
        return np.asarray(-r * (grid.sin + 2 * lam * grid.sin_2) + lam * e * grid.cos)
    total = np.zeros_like(grid.angle)
    for k, (c, s) in enumerate(zip(*acceleration_harmonics(slider_crank, method.order), strict=True), start=1):
        if c or s:
            total += k * (s * cos_multiple(grid, k) - c * sin_multiple(grid, k))
    return total
