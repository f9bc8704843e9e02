"""Worked steps: a registered formula, the numbers put into it, and what it gave.

What adds up over bodies, loads or orders has no formula of a fixed number of arguments: a `SumStep` or `ProductStep`
has its terms as steps of their own and adds or multiplies their values in order. A `Given` is a number that enters
such a sum, or a group, without a formula of its own there: it was given, found by a solver, or shown before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from crankwork.formula.expression import FORMULAS, Expression, Formula, record


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
    named : tuple of (str, str)
        Arguments that stand for one of several values of their quantity, each with the key of that value.
    tree : Expression or None
        The formula as it is printed here, where that is not the whole formula: without what is absent, with plain
        arithmetic in place of the argument that it gives.
    """

    key: str
    formula: Formula
    values: Mapping[str, float]
    value: float
    named: tuple[tuple[str, str], ...] = ()
    tree: Expression | None = None

    @property
    def expression(self) -> Expression:
        """The formula as it is printed here."""
        return record(self.formula.shown) if self.tree is None else self.tree


class Given(NamedTuple):
    """A value without a formula of its own: given, read from a diagram, found by a solver, or shown before.

    Parameters
    ----------
    key : str
        Key of the value in a summary or table.
    value : float
        The value. [SI]
    """

    key: str
    value: float


class SumStep(NamedTuple):
    """A value that is the sum of others; made by `sum_step`.

    Parameters
    ----------
    key : str
        Key of the value in a summary or table.
    terms : tuple of Step, Given, SumStep or ProductStep
        What is added, in order; their keys are `key.NAME` where they are parts of the same quantity.
    value : float
        The sum. [SI]
    """

    key: str
    terms: tuple[AnyStep, ...]
    value: float


class ProductStep(NamedTuple):
    """A value that is the product of others; made by `product_step`.

    Parameters
    ----------
    key : str
        Key of the value in a summary or table.
    terms : tuple of Step, Given, SumStep or ProductStep
        What is multiplied, in order.
    value : float
        The product. [SI]
    """

    key: str
    terms: tuple[AnyStep, ...]
    value: float


AnyStep = Step | Given | SumStep | ProductStep


class StepGroup(NamedTuple):
    """Steps that belong together, in order of calculation.

    Parameters
    ----------
    name : str
        What they are about, for example `geometry`.
    steps : tuple of Step, Given, SumStep or ProductStep
        The steps.
    crank_angle : float or None
        Where they hold, if they vary with the crank angle. [rad]
    """

    name: str
    steps: tuple[AnyStep, ...]
    crank_angle: float | None = None


def worked_step(function: Callable[..., Any], *values: float | None, key: str = "") -> Step:
    """Return the step of a registered formula at plain numbers.

    Parameters
    ----------
    function : callable
        A function registered by `expressions.formula`.
    *values : float or None
        Its arguments, in order; None is what nobody stated, counts zero and is not printed.
        [SI, or the unit that the formula states]
    key : str
        Key of the value; by default the quantity that the formula gives.

    Returns
    -------
    Step
        The formula, its numbers and its value.
    """
    formula = FORMULAS[function.__name__]
    absent = [name for name, value in zip(formula.arguments, values, strict=True) if value is None]
    numbers = [0.0 if value is None else float(value) for value in values]
    put_in = {name: number for name, number in zip(formula.arguments, numbers, strict=True) if name not in absent}
    tree = record(formula.shown, absent) if absent else None
    return Step(key or formula.quantity, formula, put_in, float(function(*numbers)), tree=tree)


def named_step(function: Callable[..., Any], known: Mapping[str, float], *, key: str = "", **others: float) -> Step:
    """Return the step of a registered formula whose arguments are known by name.

    Parameters
    ----------
    function : callable
        A function registered by `expressions.formula`.
    known : mapping of str to float
        Values by name of the argument; more than the formula takes do no harm. [SI, or as the formula states]
    key : str
        Key of the value; by default the quantity that the formula gives.
    **others : float
        Arguments that are not known, or have another value here. [SI, or as the formula states]
    """
    values = {**known, **others}
    return worked_step(function, *(values[name] for name in FORMULAS[function.__name__].arguments), key=key)


def renamed(step: Step, **keys: str) -> Step:
    """Return a step that says which of several values of a quantity it takes.

    Parameters
    ----------
    step : Step
        The step.
    **keys : str
        Keys of values by argument; the symbol of the key is printed instead of that of the argument.
    """
    return step._replace(named=(*step.named, *keys.items()))


def sum_step(key: str, terms: Iterable[AnyStep]) -> SumStep:
    """Return the sum of steps, added in order.

    Parameters
    ----------
    key : str
        Key of the sum.
    terms : iterable of Step, Given, SumStep or ProductStep
        What is added.

    Examples
    --------
    >>> sum_step("efficiency", [Given("efficiency.one", 0.25), Given("efficiency.two", 0.5)]).value
    0.75
    """
    terms = tuple(terms)
    return SumStep(key, terms, float(sum(one.value for one in terms)))


def product_step(key: str, terms: Iterable[AnyStep]) -> ProductStep:
    """Return the product of steps, multiplied in order.

    Parameters
    ----------
    key : str
        Key of the product.
    terms : iterable of Step, Given, SumStep or ProductStep
        What is multiplied.
    """
    terms = tuple(terms)
    return ProductStep(key, terms, math.prod(one.value for one in terms))


def all_steps(steps: Iterable[AnyStep]) -> Iterator[AnyStep]:
    """Yield steps and, before each sum or product, its terms.

    Parameters
    ----------
    steps : iterable of Step, Given, SumStep or ProductStep
        For example the steps of a group.
    """
    for one in steps:
        if isinstance(one, SumStep | ProductStep):
            yield from all_steps(one.terms)
        yield one
