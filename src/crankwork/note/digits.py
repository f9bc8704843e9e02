"""How many digits the numbers of a line need, so that a pocket calculator gives the value printed after them."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.formula.expression import Expression, Operation, Symbol, evaluate, takes_angle
from crankwork.formula.lines import DelayedLine, FormulaLine, Line, SumLine, ValueLine

RESULT_DIGITS = 6
_MOST_DIGITS = 12
_UNITS = 2
_NEARLY_WHOLE = 1e-9
_SUMS = (operator.add, operator.sub)


def enough_digits(step: Line) -> int:
    """Return the significant digits of the numbers put in: six, and more where the value needs them.

    Put in as printed they give the printed value within two units of its last place; where no digits do, as in a
    difference of equal numbers, within two units of the last place of the largest term.
    """
    printed = as_printed(step.value)
    if isinstance(step, ValueLine | DelayedLine):
        return RESULT_DIGITS
    reached = []
    for digits in range(RESULT_DIGITS, _MOST_DIGITS + 1):
        terms = _terms(step, digits)
        if not all(map(math.isfinite, terms)):
            return RESULT_DIGITS
        missed = abs(sum(terms) - printed)
        if missed <= _UNITS * last_place(printed):
            return digits
        reached.append((digits, missed, max(map(abs, (*terms, printed)))))
    return next((digits for digits, missed, largest in reached if missed <= _UNITS * last_place(largest)), _MOST_DIGITS)


def _terms(step: FormulaLine | SumLine, digits: int) -> list[float]:
    """Return the terms of a line from its printed numbers."""
    if isinstance(step, SumLine):
        return [as_printed(term.value, digits) for term in step.terms]
    exact = _exact(step.expression, step.values)
    put_in = {name: exact.get(name, as_printed(value, digits)) for name, value in step.values.items()}
    with np.errstate(all="ignore"):
        try:
            return [sign * float(evaluate(term, put_in)) for term, sign in terms_of(step.expression)]
        except ZeroDivisionError:
            return [math.nan]


def terms_of(tree: Expression) -> Iterator[tuple[Expression, int]]:
    """Yield the terms of a sum with their signs; any other expression is one term."""
    match tree:
        case Operation(function, (left, right)) if function in _SUMS:
            yield from terms_of(left)
            yield from ((term, sign if function is operator.add else -sign) for term, sign in terms_of(right))
        case Operation(operator.neg, (operand,)):
            yield from ((term, -sign) for term, sign in terms_of(operand))
        case _:
            yield tree, 1


def _exact(tree: Expression, values: Mapping[str, float]) -> dict[str, float]:
    """Return the values printed without rounding: π itself, and arguments of functions that are whole degrees."""
    exact = {name: math.pi for name, value in values.items() if is_exact_pi(name, value)}
    stack = [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, Operation):
            stack += node.operands
            if takes_angle(node.function) and whole_degrees(node.operands[0], values) is not None:
                exact |= {name.name: values[name.name] for name in node.operands if isinstance(name, Symbol)}
    return exact


def whole_degrees(angle: Expression, values: Mapping[str, float]) -> float | None:
    """Return an angle in degrees where it is put in as a number of whole degrees, as it is printed then."""
    if not isinstance(angle, Symbol) or angle.name not in values:
        return None
    degrees = math.degrees(values[angle.name])
    return float(round(degrees)) if abs(degrees - round(degrees)) < _NEARLY_WHOLE else None


def is_exact_pi(name: str, value: float) -> bool:
    """Return whether an argument is π itself, which is printed as π; a document's 3.14 is a number."""
    return name == "pi" and value == math.pi


def as_printed(value: float, digits: int = RESULT_DIGITS) -> float:
    """Return a number as it is read when printed with some significant digits."""
    return float(f"{value:.{digits}g}")


def last_place(value: float) -> float:
    """Return one unit of the last place of a printed number."""
    if not value or not math.isfinite(value):
        return 0.0
    return float(10.0 ** (math.floor(math.log10(abs(value))) - RESULT_DIGITS + 1))
