"""The quantities of a dyad led over change points, as numbers and as knowns."""

from __future__ import annotations

from typing import Any

import numpy as np

from crankwork.formula.known import Known, Pieces, Table, absent, given, is_known
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import Through
from crankwork.mechanism.passage import Passage

# beyond every angle, and the beginning of a turn so that no column breaks there
BEYOND = 360e3
_BESIDE = 1e-3


def passed_branch(passage: Passage, branch: Any, grid: CrankGrid) -> Any:  # noqa: ANN401 - a known or a number
    """Return the branch of a dyad at crank angles: with each change point it changes."""
    if not is_known(branch):
        return branch * passage.signs(grid.degrees)
    ends = np.array([*passage.changes, BEYOND])
    # each law is that of a place within its stretch
    signs = passage.signs(np.array([*(one - _BESIDE for one in passage.changes), passage.changes[-1] + _BESIDE]))
    signs = signs * branch.value
    laws = [absent("branch", 1.0) if sign > 0 else given("branch", -1.0) for sign in signs]
    return Known(Pieces(ends.tolist(), tuple(laws)), "branch")


def over_bridges(passage: Passage, grid: CrankGrid) -> Through:
    """Return what replaces the quantities of a dyad about its change points by polynomials."""

    def through(key: str, value: Any) -> Any:  # noqa: ANN401 - a known or a number
        if is_known(value):
            return _remembered(passage, key, value)
        value, local = np.array(value + np.zeros_like(grid.degrees)), passage.within(grid.degrees)
        for bridge in passage.bridges:
            near = np.abs(local - bridge.degrees) <= bridge.width
            value[near] = bridge.columns[key](local[near])
        return value

    return through


def _remembered(passage: Passage, key: str, known: Known) -> Known:
    """Return a quantity that follows its formula, and polynomials about change points."""
    ends, laws = [], []
    for bridge in passage.bridges:
        ends += [bridge.degrees - bridge.width, bridge.degrees + bridge.width]
        laws += [known, Known(Table(bridge.columns[key], "change_point"), known.key)]
    return Known(Pieces([*ends, BEYOND], (*laws, known)), known.key)
