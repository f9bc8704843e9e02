"""Worked steps: a registered formula, the numbers put into it, and what it gave."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from crankwork.expressions import FORMULAS, Formula


class Step(NamedTuple):
    """One calculated value that can be shown: symbols, then numbers, then the value.

    Parameters
    ----------
    key : str
        Key of the value in a summary or table, by default the quantity that the formula gives.
    formula : Formula
        What was computed, with its source.
    values : mapping of str to float
        What was put in, by argument name. [SI, or the unit that the formula states]
    value : float
        What came out. [SI, or the unit that the formula states]
    """

    key: str
    formula: Formula
    values: Mapping[str, float]
    value: float


class Worked:
    """Computes by registered formulas and keeps every step, in order.

    Examples
    --------
    >>> from crankwork.dynamics.piston_forces import mean_piston_speed
    >>> worked = Worked()
    >>> worked(mean_piston_speed, 0.09, 3000.0)
    9.0
    >>> worked.steps[0].key, dict(worked.steps[0].values)
    ('mean_piston_speed', {'stroke': 0.09, 'n': 3000.0})
    """

    def __init__(self) -> None:
        self.steps: list[Step] = []

    def __call__(self, function: Callable[..., Any], *values: float, key: str = "") -> float:
        """Return the value of a registered formula at plain numbers, remembered under `key`."""
        step = worked_step(function, *values, key=key)
        self.steps.append(step)
        return step.value

    @property
    def values(self) -> dict[str, float]:
        """The values by key; of a key computed twice, the last."""
        return {step.key: step.value for step in self.steps}


def worked_step(function: Callable[..., Any], *values: float, key: str = "") -> Step:
    """Return the step of a registered formula at plain numbers.

    Parameters
    ----------
    function : callable
        A function registered by `expressions.formula`.
    *values : float
        Its arguments, in order. [SI, or the unit that the formula states]
    key : str
        Key of the value; by default the quantity that the formula gives.

    Returns
    -------
    Step
        The formula, its numbers and its value.
    """
    formula = FORMULAS[function.__name__]
    put_in = {name: float(value) for name, value in zip(formula.arguments, values, strict=True)}
    return Step(key or formula.quantity, formula, put_in, float(function(*put_in.values())))
