"""The quantities of a dyad across change points, as numbers and as traced values."""

from __future__ import annotations

from typing import Any

import numpy as np

from crankwork.formula.traced_value import Piecewise, Tabulated, TracedValue, absent, given, is_traced
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import Through
from crankwork.mechanism.change_point import ChangePointPassage

# beyond every angle, and a multiple of a turn so that no column has a breakpoint there
BEYOND = 360e3
_OFFSET = 1e-3


def branch_sign(passage: ChangePointPassage, branch: Any, grid: CrankGrid) -> Any:  # noqa: ANN401 - a known or a number
    """Return the branch of a dyad at crank angles; it changes at each change point."""
    if not is_traced(branch):
        return branch * passage.signs(grid.degrees)
    ends = np.array([*passage.changes, BEYOND])
    # the sign of each interval is sampled inside it
    signs = passage.signs(np.array([*(change - _OFFSET for change in passage.changes), passage.changes[-1] + _OFFSET]))
    signs = signs * branch.value
    laws = [absent("branch", 1.0) if sign > 0 else given("branch", -1.0) for sign in signs]
    return TracedValue(Piecewise(ends.tolist(), tuple(laws)), "branch")


def change_point_replacement(passage: ChangePointPassage, grid: CrankGrid) -> Through:
    """Return the function that replaces quantities of a dyad near its change points by polynomials."""

    def through(key: str, value: Any) -> Any:  # noqa: ANN401 - a known or a number
        if is_traced(value):
            return _traced(passage, key, value)
        value, local = np.array(value + np.zeros_like(grid.degrees)), passage.within(grid.degrees)
        for bridge in passage.bridges:
            near = np.abs(local - bridge.degrees) <= bridge.width
            value[near] = bridge.columns[key](local[near])
        return value

    return through


def _traced(passage: ChangePointPassage, key: str, known: TracedValue) -> TracedValue:
    """Return a traced quantity: polynomials near change points, the formula elsewhere."""
    ends, laws = [], []
    for bridge in passage.bridges:
        ends += [bridge.degrees - bridge.width, bridge.degrees + bridge.width]
        laws += [known, TracedValue(Tabulated(bridge.columns[key], "change_point"), known.key)]
    return TracedValue(Piecewise([*ends, BEYOND], (*laws, known)), known.key)
