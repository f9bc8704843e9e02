"""Formulas compute, differentiate, compile and print, and all four agree."""

from __future__ import annotations

import importlib
import inspect
import operator
import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from crankwork.formula.expression import (
    Expression,
    Formula,
    Number,
    Operation,
    Symbol,
    evaluate,
    function_name,
    record,
    symbol,
    text,
)
from crankwork.quantities import LANGUAGES
from each import failing
from rules import every_formula

Recorded = Callable[..., Any]


def _random_arguments(formula: Formula, size: int | None = None) -> dict[str, Any]:
    """Return arguments between 0.1 and 0.9, other ones for each formula but always the same.

    An offset is smaller and a rod longer, so that no rod is too short for it; a greatest torque exceeds the rated one;
    the links of a dyad meet.
    """
    ranges = {"e": (0.02, 0.18), "l": (1.2, 2.0), "l_a": (1.2, 2.0), "lam_m": (1.5, 3.0)}
    ranges |= {"l_i": (1.2, 2.0), "l_k": (1.2, 2.0), "d_sq": (0.7, 0.9), "e_s": (0.1, 0.6)}
    # a sector is large enough for its moment, and a pendulum longer than its arm
    ranges |= {"R_o": (2.0, 3.0), "Q_p": (1e-3, 4e-3), "L_s": (1.2, 2.0)}
    generator = np.random.default_rng(sum(map(ord, formula.name)))
    return {name: generator.uniform(*ranges.get(name, (0.1, 0.9)), size) for name in formula.arguments}


def test_no_other_formula_has_taken_the_name() -> None:
    taken = [
        name
        for name, one in every_formula().items()
        if getattr(importlib.import_module(one.function.__module__), name).__wrapped__ is not one.function
    ]
    assert taken == []


# --- it prints


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_formula_prints_with_a_symbol_for_each_argument(language: Any) -> None:
    def check(formula: Formula) -> None:
        shown = text(record(formula.shown), language=language)
        symbols = [symbol(name, language) for name in _printed_arguments(formula)]
        assert all(symbols)
        assert [one for one in symbols if one not in shown] == []
        assert len(set(symbols)) == len(symbols), "two arguments of one formula print the same symbol"

    assert failing(every_formula(), check) == {}


def test_a_formula_with_numbers_prints_those_numbers_and_no_symbol() -> None:
    def check(formula: Formula) -> None:
        values = {name: f"{1.001 + k / 1000:.3f}" for k, name in enumerate(_printed_arguments(formula))}
        shown = text(record(formula.shown), values).replace("\u00a0rad)", ")")
        assert [number for number in values.values() if number not in shown] == []
        functions = {function_name(one) for one in _functions_of(record(formula.shown))}
        assert set(re.findall(r"[^\W\d_²³⁴]\w*", shown)) <= functions | {"π"}

    assert failing(every_formula(), check) == {}


def test_a_formula_printed_with_numbers_evaluates_to_its_value() -> None:
    def check(formula: Formula) -> None:
        values = _random_arguments(formula)
        shown = text(record(formula.function), {name: repr(float(value)) for name, value in values.items()})
        shown = shown.replace("\u00a0rad)", ")")
        read_back = _value_of_text(shown, {function_name(one): one for one in _functions_of(record(formula.function))})
        assert read_back == pytest.approx(formula.function(**values), rel=1e-13)

    assert failing(every_formula(), check) == {}


def _printed_arguments(formula: Formula) -> tuple[str, ...]:
    """Return the arguments of the form that books print, which are some of those of the formula."""
    printed = tuple(inspect.signature(formula.shown).parameters)
    assert set(printed) <= set(formula.arguments)
    return printed


def _operations(tree: Expression) -> set[Callable[..., Any]]:
    if not isinstance(tree, Operation):
        return set()
    return {tree.function}.union(*map(_operations, tree.operands))


def _functions_of(tree: Expression) -> set[np.ufunc]:
    return {one for one in _operations(tree) if isinstance(one, np.ufunc)}


# --- it computes: the tree and the function, bit for bit


@pytest.mark.parametrize("kind", ["float", "numpy scalar", "array", "complex array"])
def test_the_tree_gives_the_very_same_bits_as_the_function(kind: str) -> None:
    def check(formula: Formula) -> None:
        values = _random_arguments(formula, None if kind in ("float", "numpy scalar") else 100)
        if kind == "float":
            values = {name: float(value) for name, value in values.items()}
        if kind == "complex array":
            values = {name: value + 1j * value[::-1] for name, value in values.items()}
        direct, recorded = formula.function(**values), evaluate(record(formula.function), values)
        assert np.array_equal(direct, recorded)
        assert np.all(np.isfinite(direct))

    assert failing(every_formula(), check) == {}


# --- it compiles


@pytest.mark.compiled
def test_a_formula_compiles_and_agrees_with_itself() -> None:
    """Of the formulas, the first with each operation, and of each number of arguments."""
    import numba

    sample, seen = {}, set[object]()
    for name, formula in sorted(every_formula().items()):
        new = {*_operations(record(formula.function)), len(formula.arguments)} - seen
        if new:
            sample[name] = formula
            seen |= new

    def check(formula: Formula) -> None:
        compiled = numba.njit(formula.function)
        for column in np.array(list(_random_arguments(formula, 20).values())).T:
            assert compiled(*column) == pytest.approx(formula.function(*column), rel=1e-14)

    assert failing(sample, check) == {}


# --- it differentiates


def test_the_complex_step_derivative_is_that_of_forty_digits() -> None:
    def check(formula: Formula) -> None:
        values = {name: float(value) for name, value in _random_arguments(formula).items()}
        tree = record(formula.function)
        exact = {name: mpmath.mpf(value) for name, value in values.items()}
        size = abs(_in_mpmath(tree, exact))
        h = mpmath.mpf(10) ** -12
        for name in formula.arguments:
            sides = [_in_mpmath(tree, exact | {name: exact[name] + step}) for step in (h, -h)]
            expected = (sides[0] - sides[1]) / (2 * h)
            derivative = np.imag(formula.function(**(values | {name: complex(values[name], 1e-200)}))) / 1e-200
            assert abs(derivative - expected) <= 1e-13 * (size + abs(expected)), name

    with mpmath.workdps(40):
        assert failing(every_formula(), check) == {}


_IN_MPMATH = {"arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2", "power": "power"}


def _in_mpmath(tree: Expression, values: Mapping[str, Any]) -> Any:
    match tree:
        case Symbol(name):
            return values[name]
        case Number(value):
            return mpmath.mpf(value)
        case Operation(function, operands):
            if isinstance(function, np.ufunc):
                function = getattr(mpmath, _IN_MPMATH.get(function.__name__, function.__name__))
            return function(*(_in_mpmath(one, values) for one in operands))
    raise TypeError(tree)


# --- recording


def test_every_way_to_write_an_operation_is_recorded() -> None:
    tree = record(
        lambda r, x: (2 + r) * (x - 1) / (3 - x) ** 2 + -r * 4 + 5 / x + 2**r + np.float64(2) * r - np.add(r, x)
    )
    values = {"r": 0.3, "x": 0.7}
    r, x = values.values()
    expected = (2 + r) * (x - 1) / (3 - x) ** 2 + -r * 4 + 5 / x + 2**r + np.float64(2) * r - np.add(r, x)
    assert evaluate(tree, values) == expected


def test_a_formula_without_arguments_is_a_number() -> None:
    assert evaluate(record(lambda: 2.5), {}) == 2.5


def test_what_is_not_a_formula_is_refused() -> None:
    with pytest.raises(TypeError):
        np.add.reduce(Symbol("r"))  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="not part of a formula"):
        evaluate("r", {})  # type: ignore[arg-type]


# --- printing: the text says what the tree says

PRINTED: dict[str, Recorded] = {
    "r − (x − r)": lambda r, x: r - (x - r),
    "r + x + r": lambda r, x: r + (x + r),
    "r/(x·r)": lambda r, x: r / (x * r),
    "(r + x)²": lambda r, x: (r + x) ** 2,
    "(−r)²·x": lambda r, x: (-r) ** 2 * x,
    "−r²": lambda r: -(r**2),
    "(cos φ)³": lambda cos_phi: cos_phi**3,
    "r^(x + 1)": lambda r, x: r ** (x + 1),
    "(r^x)²": lambda r, x: (r**x) ** 2,
    "√(r + 1)/2": lambda r: np.sqrt(r + 1) / 2,
    "r⁴": lambda r: r**4,
    "r^5": lambda r: r**5,
}


def test_parentheses_stand_where_they_are_needed_and_only_there() -> None:
    assert {shown: text(record(function)) for shown, function in PRINTED.items()} == {one: one for one in PRINTED}


def test_numbers_print_with_all_that_they_say() -> None:
    """A square as a square of any type of exponent, a sign under a power, every digit of a conversion factor."""
    squares: list[Recorded] = [lambda r: r**2.0, lambda r: r ** np.float64(2), lambda r: r ** np.int64(2)]
    assert [text(record(one)) for one in squares] == ["r²"] * 3
    assert _value_of_text(text(record(lambda x: (-2) ** x), {"x": "2"}), {}) == 4
    assert float(text(record(lambda: 735.49875))) == 735.49875


def test_a_sign_never_stands_next_to_another_operator() -> None:
    recorded: list[Recorded] = [lambda r, x: r + -x, lambda r: r * -2, lambda r: r - -2 * r]
    shown = [text(record(one)) for one in recorded]
    shown += [text(record(lambda r, x: r + x), {"r": "5", "x": three}) for three in ("-3", "−3")]
    assert [one for one in shown if re.search(r"[+−·/-] ?[−-]", one)] == []


NAMES = {"r": "r", "x": "x", "sin_phi": "sin φ", "beta_1": "β′"}
LEAVES = st.one_of(
    st.sampled_from(list(NAMES)).map(Symbol), st.integers(-3, 6).map(Number), st.sampled_from([0.5, -1.25]).map(Number)
)
EXPONENTS = st.sampled_from([2, 3, 4, 5, 1, -1, -2])
TREES = st.recursive(
    LEAVES,
    lambda trees: st.one_of(
        *(st.builds(one, trees, trees) for one in (operator.add, operator.sub, operator.mul, operator.truediv)),
        st.builds(operator.pow, trees, EXPONENTS),
        st.builds(lambda base, exponent: base ** (exponent + Symbol("k")), trees, EXPONENTS),
        trees.map(operator.neg),
        trees.map(np.sqrt),
    ),
    max_leaves=8,
)
VALUES = st.integers(-6, 6).filter(bool)


@given(tree=TREES, numbers=st.fixed_dictionaries(dict.fromkeys(NAMES, VALUES)), minus=st.sampled_from("-−"))
def test_a_printed_tree_evaluates_to_the_value_of_the_tree(
    tree: Expression, numbers: dict[str, int], minus: str
) -> None:
    """With numbers and with symbols; in fractions, where every operation is exact; a function stands for the root."""
    exact: dict[str, Any] = {name: Fraction(value) for name, value in numbers.items()} | {"k": Fraction(2)}
    try:
        expected = _in_fractions(tree, exact)
    except ZeroDivisionError:
        assume(False)
    with_numbers = text(tree, {name: str(value).replace("-", minus) for name, value in exact.items()})
    assert _value_of_text(with_numbers, {"sqrt": _some_function}, Fraction) == expected
    with_symbols = text(tree, {"k": "2"})
    assert not re.search("φ *[²³⁴^]", with_symbols), "the power would belong to the angle"
    with_symbols = with_symbols.replace("sin φ", "sine").replace("β′", "beta_1")
    named = {"sqrt": _some_function, "sine": exact["sin_phi"], **exact}
    assert _value_of_text(with_symbols, named, Fraction) == expected


def _some_function(value: Fraction) -> Fraction:
    return value * Fraction(3, 7) + 11


def _in_fractions(tree: Expression, values: Mapping[str, Fraction]) -> Any:
    match tree:
        case Symbol(name):
            return values[name]
        case Number(value):
            return Fraction(value)
        case Operation(np.sqrt, (operand,)):
            return _some_function(_in_fractions(operand, values))
        case Operation(function, operands):
            return function(*(_in_fractions(one, values) for one in operands))
    raise TypeError(tree)


def _value_of_text(shown: str, names: Mapping[str, Any], number: Callable[[str], Any] = float) -> Any:
    """Return the value of a printed formula, read with the precedence that mathematics and Python share."""
    for printed, written in {"·": "*", "−": "-", "^": "**", "²": "**2", "³": "**3", "⁴": "**4", "√": "sqrt"}.items():
        shown = shown.replace(printed, written)
    shown = re.sub(r"(?<![\w.])(\d+\.?\d*(?:e[+-]?\d+)?)", r"_number('\1')", shown)
    return eval(shown, {"__builtins__": {}, "_number": number, "π": np.pi, **names})  # noqa: S307 - text printed by the package
