"""Formulas that compute, differentiate, compile and print.

A formula is a plain function of its arguments, written with operators and NumPy functions. Called with
numbers or arrays it computes. Called with `Symbol`s it records the tree of what it does, so that the same
function shows itself, shows itself with numbers in, and evaluates to the very same bits.
"""

from __future__ import annotations

import inspect
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from crankwork.notation import ARGUMENTS
from crankwork.quantities import QUANTITIES, Language

# What a formula takes and gives: a float, an array, a complex number, or the symbols that record it.
Value = Any

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Formula:
    """A registered formula: what it gives, who says so, and the function that is the formula."""

    function: Callable[..., Any]
    quantity: str
    source: str

    @property
    def name(self) -> str:
        """The name of the function."""
        return self.function.__name__

    @property
    def arguments(self) -> tuple[str, ...]:
        """The names of the arguments, in order."""
        return tuple(inspect.signature(self.function).parameters)


FORMULAS: dict[str, Formula] = {}


def formula(quantity: str, source: str) -> Callable[[Function], Function]:
    """Register a function as the formula of a quantity and return it unchanged.

    Parameters
    ----------
    quantity : str
        Key of the quantity that the formula gives; a key of `quantities.QUANTITIES`.
    source : str
        Key of the bibliography, with page, chapter or equation.
    """

    def register(function: Function) -> Function:
        if function.__name__ in FORMULAS:
            raise ValueError(f"there are two formulas named {function.__name__}")
        FORMULAS[function.__name__] = Formula(function, quantity, source)
        return function

    return register


class Expression:
    """A node of a recorded formula: a symbol, a number or an operation."""

    __slots__ = ()

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *operands: object, **options: object) -> Expression:
        if method != "__call__" or options:
            return NotImplemented  # type: ignore[no-any-return]
        return _operation(_OPERATOR_OF.get(ufunc, ufunc), *operands)

    def __add__(self, other: object) -> Expression:
        return _operation(operator.add, self, other)

    def __radd__(self, other: object) -> Expression:
        return _operation(operator.add, other, self)

    def __sub__(self, other: object) -> Expression:
        return _operation(operator.sub, self, other)

    def __rsub__(self, other: object) -> Expression:
        return _operation(operator.sub, other, self)

    def __mul__(self, other: object) -> Expression:
        return _operation(operator.mul, self, other)

    def __rmul__(self, other: object) -> Expression:
        return _operation(operator.mul, other, self)

    def __truediv__(self, other: object) -> Expression:
        return _operation(operator.truediv, self, other)

    def __rtruediv__(self, other: object) -> Expression:
        return _operation(operator.truediv, other, self)

    def __pow__(self, other: object) -> Expression:
        return _operation(operator.pow, self, other)

    def __rpow__(self, other: object) -> Expression:
        return _operation(operator.pow, other, self)

    def __neg__(self) -> Expression:
        return _operation(operator.neg, self)


@dataclass(frozen=True, slots=True)
class Symbol(Expression):
    """An argument of a formula."""

    name: str


@dataclass(frozen=True, slots=True)
class Number(Expression):
    """A number written in a formula."""

    value: Any


@dataclass(frozen=True, slots=True)
class Operation(Expression):
    """A function applied to operands: an operator of Python or a NumPy ufunc."""

    function: Callable[..., Any]
    operands: tuple[Expression, ...]


_OPERATOR_OF: dict[np.ufunc, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.divide: operator.truediv,
    np.negative: operator.neg,
}


def _operation(function: Callable[..., Any], *operands: object) -> Operation:
    return Operation(function, tuple(one if isinstance(one, Expression) else Number(one) for one in operands))


def record(function: Callable[..., Any]) -> Expression:
    """Return the tree of a formula, its arguments as symbols.

    Examples
    --------
    >>> text(record(lambda r, w: r * w**2))
    'r·ω²'
    """
    tree = function(*(Symbol(name) for name in inspect.signature(function).parameters))
    return tree if isinstance(tree, Expression) else Number(tree)


def evaluate(tree: Expression, values: Mapping[str, Any]) -> Any:  # noqa: ANN401 - floats or arrays, as given
    """Return the value of a tree, from the same operations in the same order as the formula itself."""
    match tree:
        case Symbol(name):
            return values[name]
        case Number(value):
            return value
        case Operation(function, operands):
            return function(*(evaluate(one, values) for one in operands))
    raise TypeError(f"{tree!r} is not part of a formula")


_BINARY = {operator.add: (1, " + "), operator.sub: (1, " − "), operator.mul: (2, "·"), operator.truediv: (2, "/")}
_SUPERSCRIPTS = {2: "²", 3: "³", 4: "⁴"}
_SIGNED, _ATOM = 0, 5


def text(tree: Expression, values: Mapping[str, str] | None = None, language: Language = "en") -> str:
    """Return a tree as one line of text, with symbols, or with `values` in place of them.

    Parameters
    ----------
    tree : Expression
        A recorded formula.
    values : mapping of str to str, optional
        Printed numbers by argument name; an argument that is missing keeps its symbol.
    language : str
        Whose symbols to use: `en`, `ru` or `vi`.
    """
    return _text(tree, values or {}, language)[0]


def _text(tree: Expression, values: Mapping[str, str], language: Language) -> tuple[str, int]:
    """Return the text of a node and how tightly it binds, so that parentheses stand only where needed."""
    match tree:
        case Symbol(name) if name in values:
            number = values[name]
            return number, _SIGNED if number.startswith(("-", "−")) else _ATOM
        case Symbol(name):
            shown = symbol(name, language)
            return shown, 3 if " " in shown and not shown.endswith(")") else _ATOM
        case Number(value):
            shown = f"{value:.15g}".replace("-", "−")
            return shown, _SIGNED if shown.startswith("−") else _ATOM
        case Operation(function, (left, right)) if function in _BINARY:
            return _binary_text(function, left, right, values, language)
        case Operation(function, (base, exponent)) if function in (operator.pow, np.power):
            shown = _wrapped(base, 4, values, language)
            if isinstance(exponent, Number) and exponent.value in _SUPERSCRIPTS:
                return shown + _SUPERSCRIPTS[exponent.value], 3
            return f"{shown}^{_wrapped(exponent, 4, values, language)}", 3
        case Operation(function, (operand,)) if function is operator.neg:
            return "−" + _wrapped(operand, 2, values, language), _SIGNED
        case Operation(np.sqrt, (operand,)):
            return f"√({_text(operand, values, language)[0]})", _ATOM
        case Operation(function, operands):
            inside = ", ".join(_text(one, values, language)[0] for one in operands)
            return f"{function.__name__}({inside})", _ATOM
    raise TypeError(f"{tree!r} is not part of a formula")


def _binary_text(
    function: Callable[..., Any], left: Expression, right: Expression, values: Mapping[str, str], language: Language
) -> tuple[str, int]:
    """Return the text of a sum, difference, product or quotient.

    A sign may lead it, but two operators never stand side by side.
    """
    level, sign = _BINARY[function]
    left_text, binding = _text(left, values, language)
    if binding < level and binding != _SIGNED:
        left_text = f"({left_text})"
    right_text = _wrapped(right, level + (function in (operator.sub, operator.truediv)), values, language)
    if right_text.startswith("−"):
        right_text = f"({right_text})"
    return left_text + sign + right_text, level


def _wrapped(tree: Expression, level: int, values: Mapping[str, str], language: Language) -> str:
    shown, binding = _text(tree, values, language)
    return shown if binding >= level else f"({shown})"


def symbol(argument: str, language: Language = "en") -> str:
    """Return the printed symbol of a formula's argument."""
    entry = ARGUMENTS[argument]
    keys = [key for key in (entry.quantity, entry.extra) if key]
    return entry.pattern.format(*(QUANTITIES[key].symbol(language) for key in keys))
