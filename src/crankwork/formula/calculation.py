"""A calculation step by step: what is known so far, and what formulas make of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Self

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.formula.expression import FORMULAS, Formula
from crankwork.formula.traced_value import TracedValue, absent, given
from crankwork.locale import ErrorMessage, has_text
from crankwork.notation import ARGUMENTS
from crankwork.quantities import base_key


class Calculation:
    """Works formulas on what is known so far and keeps what they give, in order.

    An argument of a formula is what is named in the call, else what is known by its name, else the known quantity that
    notation says it stands for. The mark follows the key of everything worked here, to tell it from what is worked
    again.

    Examples
    --------
    >>> from crankwork.kinematics.slider_crank import mean_piston_speed
    >>> worked = Calculation()
    >>> _ = worked.given("stroke", 0.09), worked.given("rotational_speed", 3000.0)
    >>> worked(mean_piston_speed).value
    9.0
    >>> list(worked.found)
    ['mean_piston_speed']
    """

    def __init__(self, mark: str = "") -> None:
        self.known: dict[str, TracedValue] = {}
        self.found: dict[str, TracedValue] = {}
        self._mark = mark

    def __call__(self, function: Callable[..., Any], key: str = "", /, **arguments: TracedValue | float) -> TracedValue:
        """Return the value of a registered formula, stored under its quantity or a key.

        `key`: key of the value; by default the quantity that the formula gives; `**others`: arguments that stand for
        something else than the quantity known so far [as the formula takes them].
        """
        formula = FORMULAS[function.__name__]
        taken = {name: arguments[name] if name in arguments else self._operand(name) for name in formula.arguments}
        try:
            with np.errstate(all="ignore"):
                result: TracedValue = function(*taken.values())
        except ArithmeticError:
            raise _no_number(formula, taken) from None
        if not result.varies and not math.isfinite(result.value):
            raise _no_number(formula, taken)
        return self.keep(result.named(key or formula.quantity))

    def _operand(self, name: str) -> TracedValue:
        return self.known[name] if name in self.known else self.known[ARGUMENTS[name].quantity]

    def __getitem__(self, key: str) -> TracedValue:
        return self.known[key]

    def keep(self, known: TracedValue) -> TracedValue:
        """Keep a result under its key; what is worked from now on takes it for its quantity."""
        marked = known.named(f"{known.key}{self._mark}")
        self.known[known.key] = self.found[known.key] = marked
        return marked

    def given(self, key: str, value: float, path: str = "", unit: str = "") -> TracedValue:
        """Take a stated value, in the unit that formulas take it in."""
        self.known[key] = given(key, value, path, unit)
        return self.known[key]

    def absent(self, key: str, neutral: float = 0.0) -> TracedValue:
        """Take a quantity that there is none of here."""
        self.known[key] = absent(key, neutral)
        return self.known[key]

    def again(self, mark: str) -> Self:
        """Return a calculation that begins with what is known here and marks what it works."""
        other = type(self)(mark)
        other.known = dict(self.known)
        return other


def _no_number(formula: Formula, taken: Mapping[str, TracedValue | float]) -> CrankworkError:
    """Return the refusal of operands from which no number follows, by the names that they have."""
    named = {
        name: operand for name, operand in taken.items() if isinstance(operand, TracedValue) and not operand.is_absent
    }
    made_of = [
        ErrorMessage("operand", quantity=_quantity(operand.key or ARGUMENTS[name].quantity), value=operand.value)
        for name, operand in named.items()
    ]
    return CrankworkError(ErrorMessage("no_number", quantity=_quantity(formula.quantity), operands=made_of))


def _quantity(key: str) -> str:
    name = f"quantities.{base_key(key)}"
    return ErrorMessage(name) if has_text(name) else key
