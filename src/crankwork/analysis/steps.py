"""Every calculated value of results as worked steps: formula, substituted numbers, value.

The values are those of the results: each formula takes the numbers that the calculation had. What has no formula of
its own, a sum over bodies or a value of a solver, is a `SumStep` or a `Given`. Keys are those of the summary and the
columns; a part of a quantity is `key.NAME`. Where a formula serves more than one quantity, the key of the step tells
which it is, `quantities.base_key(step.key)`, and not the quantity of the formula.
"""

from __future__ import annotations

import math

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved
from crankwork.errors import CrankworkError
from crankwork.formula.steps import StepGroup

DEFAULT_ANGLE = 30.0


def worked_steps(
    results: Results, *, crank_angle: float = DEFAULT_ANGLE, force_angle: float | None = None
) -> tuple[StepGroup, ...]:
    """Return the worked steps of everything that results hold.

    Parameters
    ----------
    results : Results
        Of an engine, a linkage, or a table of transfer functions.
    crank_angle : float
        Where what varies is shown. A linkage that does not reach it, or a table without it, is shown at the nearest
        crank angle of its columns. [deg]
    force_angle : float, optional
        Where forces, and inertia and torques of a linkage, are shown; by default at `crank_angle`, but for an engine
        as far into the last revolution of its cycle: in four strokes that is the working one. [deg]

    Returns
    -------
    tuple of StepGroup
        Groups in the order of the calculation.

    Raises
    ------
    CrankworkError
        If a crank angle lies outside the cycle.
    """
    solved = results.solved
    cycle = results.machine.cycle
    if isinstance(solved, Solved):
        if force_angle is None:
            force_angle = cycle - 360.0 + crank_angle
        from crankwork.analysis.steps_engine import engine_steps  # noqa: PLC0415 - loaded where it is needed

        return engine_steps(results, _checked(crank_angle, cycle), _checked(force_angle, cycle))
    from crankwork.analysis.steps_linkage import linkage_steps  # noqa: PLC0415 - loaded where it is needed

    angles = (crank_angle, crank_angle if force_angle is None else force_angle)
    at_motion, at_forces = (_nearest(results, _checked(angle, cycle)) for angle in angles)
    return linkage_steps(results, at_motion, at_forces)


def _checked(angle: float, cycle: float) -> float:
    if not (math.isfinite(angle) and 0 <= angle <= cycle):
        raise CrankworkError(f"there is no crank angle of {angle:g} deg in the cycle; take one from 0 to {cycle:g} deg")
    return angle


def _nearest(results: Results, angle: float) -> int:
    """Return the row of the columns whose crank angle is nearest."""
    return int(np.argmin(np.abs(results.grid.degrees - angle)))
