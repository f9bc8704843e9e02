"""Formulas that compute, differentiate, compile and print.

A formula is a plain function of its arguments, written with operators and NumPy functions. Called with
numbers or arrays it computes. Called with `Symbol`s it records the tree of what it does, so that the same
function shows itself, shows itself with numbers in, and evaluates to the very same bits.
"""

from __future__ import annotations

import functools
import inspect
import math
import operator
import re
import sys
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, TypeVar, cast

import numpy as np

from crankwork.formula.traced_value import FormulaCall, Operators, TracedValue, is_traced
from crankwork.locale import decimal, translate
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
    stated_unit: str | None = None
    constants: str = ""
    valid: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    printed: Callable[..., Any] | None = None

    @property
    def unit(self) -> str:
        """The unit of the value: the SI unit of the quantity, unless the formula states another; "" is none."""
        return QUANTITIES[self.quantity].si_unit if self.stated_unit is None else self.stated_unit

    def __reduce__(self) -> tuple[Callable[..., Formula], tuple[Callable[..., Any]]]:
        # by the name of what callers see, so that it is found registered where it is read again
        return _registered, (getattr(sys.modules[self.function.__module__], self.name),)

    @property
    def shown(self) -> Callable[..., Any]:
        """The function in the form that books print."""
        return self.printed or self.function

    @property
    def name(self) -> str:
        """The name of the function."""
        return self.function.__name__

    @functools.cached_property
    def arguments(self) -> tuple[str, ...]:
        """The names of the arguments, in order."""
        return tuple(inspect.signature(self.function).parameters)

    @functools.cached_property
    def is_root(self) -> bool:
        """Whether it is the square root of what its arguments come to."""
        recorded = self.function(*map(Symbol, self.arguments))
        return isinstance(recorded, Operation) and recorded.function is np.sqrt


FORMULAS: dict[str, Formula] = {}


def _registered(function: Callable[..., Any]) -> Formula:
    return FORMULAS[function.__name__]


def formula(
    quantity: str,
    source: str,
    *,
    unit: str | None = None,
    constants: str = "",
    valid: Mapping[str, tuple[float, float]] = MappingProxyType({}),
    printed: Callable[..., Any] | None = None,
) -> Callable[[Function], Function]:
    """Register a function as the formula of a quantity.

    Called with numbers it is that function; called with a known among its arguments it returns a known of that
    quantity, which keeps the formula and its operands. `source` is a key of the bibliography, with page, chapter or
    equation. `unit` is stated where it is not the SI unit of the quantity, as that of a sine or of a transfer function;
    `constants` where numbers in the formula, drawn from measurements or tables, have units; `valid` is the range of an
    argument, in its unit, outside which the source does not vouch for the formula; `printed` is the form that books
    print, of some of the same arguments, where the safe way to compute is unreadable.
    """

    def register(function: Function) -> Function:
        if function.__name__ in FORMULAS:
            raise ValueError(f"there are two formulas named {function.__name__}")
        entry = FORMULAS[function.__name__] = Formula(function, quantity, source, unit, constants, valid, printed)

        @functools.wraps(function)
        def compute_or_trace(*operands: Any) -> Any:  # noqa: ANN401 - numbers give numbers, traced give traced
            if is_traced(*operands):
                return TracedValue(FormulaCall(entry, operands), quantity)
            # through the entry, as in replays, so that `instead` replaces both
            return entry.function(*operands)

        return cast("Function", compute_or_trace)

    return register


class Expression(Operators["Operation"]):
    """A node of a recorded formula: a symbol, a number or an operation."""

    __slots__ = ()

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *operands: object, **options: object) -> Expression:
        if method != "__call__" or options:
            return NotImplemented  # type: ignore[no-any-return]
        return _operation(_OPERATOR_OF.get(ufunc, ufunc), *operands)

    def _made(self, function: Callable[..., Any], *operands: object) -> Operation:
        return _operation(function, *operands)


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
    return Operation(function, tuple(item if isinstance(item, Expression) else Number(item) for item in operands))


def record(function: Callable[..., Any], absent: Collection[str] = ()) -> Expression:
    """Return the tree of a formula, its arguments as symbols, without the terms of arguments that are absent.

    Examples
    --------
    >>> text(record(lambda r, w: r * w**2))
    'r·ω²'
    >>> text(record(lambda r, w, e: r * w**2 + e, ["e"]))
    'r·ω²'
    """
    names = inspect.signature(function).parameters
    tree = function(*(Number(0.0) if name in absent else Symbol(name) for name in names))
    if not isinstance(tree, Expression):
        return Number(tree)
    return simplify(tree) if absent else tree


def evaluate(tree: Expression, values: Mapping[str, Any]) -> Any:  # noqa: ANN401 - floats or arrays, as given
    """Return the value of a tree, from the same operations in the same order as the formula itself."""
    match tree:
        case Symbol(name):
            return values[name]
        case Number(value):
            return value
        case Operation(function, operands):
            return function(*(evaluate(operand, values) for operand in operands))
    raise TypeError(f"{tree!r} is not part of a formula")


_BINARY = {operator.add: (1, " + "), operator.sub: (1, " − "), operator.mul: (2, "·"), operator.truediv: (2, "/")}
_SUPERSCRIPTS = {2: "²", 3: "³", 4: "⁴"}
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_SIGNED, _ATOM = 0, 5
_FENCED = re.compile(r"\([^()]*\)")
_BETWEEN_TERMS = (" + ", " − ")
_FUNCTIONS_OF_ANGLES = ("sin", "cos", "tan", "tg")


def text(tree: Expression, values: Mapping[str, str] | None = None, language: Language = "en") -> str:
    """Return a tree as one line of text, with symbols, or with `values` in place of them.

    `values`: printed numbers by argument name; an argument that is missing keeps its symbol.
    """
    return _text(tree, values or {}, language)[0]


def _text(tree: Expression, values: Mapping[str, str], language: Language) -> tuple[str, int]:
    """Return the text of a node and how tightly it binds, so that parentheses stand only where needed."""
    match tree:
        case Symbol(name) if name in values:
            return values[name], _binding(values[name])
        case Symbol(name):
            shown = symbol(name, language)
            return shown, _binding(shown)
        case Number(value):
            shown = "π" if value == math.pi else decimal(f"{value:.15g}", language).replace("-", "−")
            return shown, _binding(shown)
        case Operation(function, (left, right)) if function in _BINARY:
            return _binary_text(function, left, right, values, language)
        case Operation(function, (base, exponent)) if function in (operator.pow, np.power):
            shown = _wrapped(base, 4, values, language)
            if isinstance(exponent, Number) and exponent.value in _SUPERSCRIPTS:
                return shown + _SUPERSCRIPTS[exponent.value], 3
            return f"{shown}^{_wrapped(exponent, 4, values, language)}", 3
        case Operation(function, (operand,)) if function is operator.neg:
            shown = _wrapped(operand, 2, values, language)
            return f"−({shown})" if shown.startswith("−") else f"−{shown}", _SIGNED
        case Operation(np.sqrt, (operand,)):
            return f"√({_text(operand, values, language)[0]})", _ATOM
        case Operation(function, operands):
            inside = [_text(argument, values, language)[0] for argument in operands]
            return _function_text(function, inside, language), _ATOM
    raise TypeError(f"{tree!r} is not part of a formula")


def _function_text(function: Callable[..., Any], inside: list[str], language: Language) -> str:
    # a comma between numbers with decimal commas would not be seen
    listed = (", " if language == "en" else "; ").join(inside)
    if takes_angle(function) and not listed.endswith("°") and not any(map(str.isalpha, listed)):
        listed += f"\u00a0{radians(language)}"
    return f"{function_name(function, language)}({listed})"


def _binding(shown: str) -> int:
    """Return how tightly a printed number or symbol binds: 2·10⁻⁵ is a product, v/ω a quotient, sin φ like a power."""
    outside = _FENCED.sub("", shown)
    if any(sign in outside for sign in _BETWEEN_TERMS):
        return 1
    if shown.startswith(("-", "−")):
        return _SIGNED
    if "·" in outside or "/" in outside:
        return 2
    return 3 if shown[-1] in _RAISED or shown.startswith(_FUNCTIONS_OF_ANGLES) else _ATOM


def takes_angle(function: Callable[..., Any]) -> bool:
    """Return whether a function takes an angle, so that a number put into it needs its unit."""
    return function in (np.sin, np.cos, np.tan)


def radians(language: Language) -> str:
    """Return the unit of such a number."""
    return translate("units.rad", language)


_NAMES = {"log": "ln", "log10": "lg", "absolute": "abs", "maximum": "max", "minimum": "min"}
_RUSSIAN_NAMES = {"tan": "tg", "arctan": "arctg", "sinh": "sh", "cosh": "ch", "tanh": "th"}


def function_name(function: Callable[..., Any], language: Language = "en") -> str:
    """Return the name of a function as books of that language print it.

    Examples
    --------
    >>> function_name(np.log), function_name(np.arctan, "ru")
    ('ln', 'arctg')
    """
    name = _NAMES.get(function.__name__, function.__name__)
    return _RUSSIAN_NAMES.get(name, name) if language == "ru" else name


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


def simplify(tree: Expression) -> Expression:
    """Return a tree without the terms and factors that are plain zeros and ones.

    `tree`: a recorded formula; numbers stand where operands are absent.

    Examples
    --------
    >>> simplify(Operation(operator.add, (Symbol("r"), Operation(operator.mul, (Number(0.0), Symbol("e"))))))
    Symbol(name='r')
    """
    if not isinstance(tree, Operation):
        return tree
    operands = tuple(simplify(operand) for operand in tree.operands)
    numbers = [operand.value if isinstance(operand, Number) else None for operand in operands]
    function = tree.function
    is_power = function in (operator.pow, np.power)
    if None not in numbers and (is_power or any(was != is_ for was, is_ in zip(tree.operands, operands, strict=True))):
        return Number(float(function(*numbers)))
    left = operands[0]
    if function is operator.neg:
        return Number(0.0) if numbers[0] == 0 else Operation(function, operands)
    if len(operands) == 2:
        right = operands[1]
        folded = _folded(function, left, right, numbers)
        if folded is not None:
            return folded
    if function is np.sqrt and isinstance(left, Operation) and left.function in (operator.pow, np.power):
        base, exponent = left.operands
        if exponent == Number(2) and isinstance(base, Operation | Symbol):
            return base
    return Operation(function, operands)


def _folded(function: Callable[..., Any], left: Expression, right: Expression, numbers: list[Any]) -> Expression | None:
    zero_left, zero_right = numbers[0] == 0, numbers[1] == 0
    if function is operator.add and (zero_left or zero_right):
        return right if zero_left else left
    if function is operator.sub and (zero_left or zero_right):
        return left if zero_right else Operation(operator.neg, (right,))
    if function is operator.mul and (zero_left or zero_right):
        return Number(0.0)
    if function in (operator.mul, operator.truediv) and numbers[1] == 1:
        return left
    if function is operator.mul and numbers[0] == 1:
        return right
    if function is operator.truediv and (zero_left or numbers[1] == math.inf):
        return Number(0.0)
    if function is operator.sub and numbers[0] is not None and numbers[0] == numbers[1]:
        return Number(0.0)
    if function in (operator.pow, np.power) and numbers[0] in (0, 1):
        return left
    return None
