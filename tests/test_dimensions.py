"""Every formula keeps the dimensions that notation gives its arguments and its quantity."""

from __future__ import annotations

import re
from fractions import Fraction
from inspect import signature

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from crankwork.formula.expression import Formula
from crankwork.notation import ARGUMENTS, argument_unit
from rules import every_formula

BASES = ("kg", "m", "s", "K", "kmol")
_ADDS = (np.add, np.subtract)
_SIGNS = (np.negative, np.absolute)
_PURE = (np.sin, np.cos, np.tan, np.arcsin, np.arccos, np.arctan, np.exp, np.log)


class Dimensioned(NDArrayOperatorsMixin):
    """A number with the exponents of the base units that it measures in."""

    def __init__(self, value: float, powers: tuple[Fraction, ...] = (Fraction(0),) * len(BASES)) -> None:
        self.value, self.powers = value, powers

    def __repr__(self) -> str:
        return "*".join(f"{base}^{power}" for base, power in zip(BASES, self.powers, strict=True) if power) or "1"

    def __array_ufunc__(self, ufunc, method, *operands, **options):
        assert method == "__call__"
        assert not options
        numbers = [one if isinstance(one, Dimensioned) else Dimensioned(float(one)) for one in operands]
        with np.errstate(all="ignore"):
            return Dimensioned(ufunc(*(one.value for one in numbers)), _powers(ufunc, *numbers))


def _powers(ufunc, one, other=None):
    if ufunc in _ADDS:
        assert one.powers == other.powers, f"{ufunc.__name__} of {one} and {other}"
        return one.powers
    if ufunc in (np.multiply, np.divide):
        sign = 1 if ufunc is np.multiply else -1
        return tuple(a + sign * b for a, b in zip(one.powers, other.powers, strict=True))
    if ufunc in (np.power, np.sqrt):
        exponent = other or Dimensioned(0.5)
        assert not any(exponent.powers), f"power of {exponent}"
        return tuple(a * Fraction(exponent.value).limit_denominator(1000) for a in one.powers)
    if ufunc in _SIGNS:
        return one.powers
    if ufunc is np.arctan2:
        assert one.powers == other.powers, f"arctan2 of {one} and {other}"
    else:
        assert ufunc in _PURE, ufunc
        assert not any(one.powers), f"{ufunc.__name__} of {one}"
    return Dimensioned(0.0).powers


def _base(k: int) -> Dimensioned:
    return Dimensioned(1.0, tuple(Fraction(k == i) for i in range(len(BASES))))


_KG, _M, _S, _K, _KMOL = map(_base, range(len(BASES)))
_ONE = Dimensioned(1.0)
_N = _KG * _M / _S**2
_SYMBOLS = {
    "kg": _KG, "m": _M, "s": _S, "K": _K, "degC": _K, "kmol": _KMOL, "rad": _ONE, "N": _N, "Pa": _N / _M**2,
    "J": _N * _M, "kJ": _N * _M, "W": _N * _M / _S, "Hz": _ONE / _S, "rpm": _ONE / _S,
}  # fmt: skip


def dimension(unit: str) -> Dimensioned:
    """Return one of a unit, `kJ/(kmol*K2)`."""
    written = re.sub(r"([A-Za-z]+)(\d?)", lambda found: f"u['{found[1]}']**{found[2] or 1}", unit or "rad")
    return eval(written, {"__builtins__": {}, "u": _SYMBOLS})  # noqa: S307 - a unit of the package


def mismatch(formula: Formula) -> str:
    """Return what is wrong with the dimensions of a formula, if anything is, as it computes and as books print it."""
    expected = dimension(formula.unit)
    for function in (formula.function, formula.shown):
        values = (Dimensioned(0.5, dimension(argument_unit(name)).powers) for name in signature(function).parameters)
        try:
            found = function(*values)
        except AssertionError as wrong:
            return f"{formula.name}: {wrong}".splitlines()[0]
        if repr(found) != repr(expected):
            return f"{formula.name}: gives {found}, not {expected}"
    return ""


def test_every_formula_keeps_its_dimensions():
    wrong = [found for formula in every_formula().values() if not formula.constants and (found := mismatch(formula))]
    assert wrong == []


def test_only_formulas_whose_numbers_have_units_say_so():
    """Tables and correlations: what is exempt from the check above would fail it, and is not much."""
    exempt = [formula for formula in every_formula().values() if formula.constants]
    assert [formula.name for formula in exempt if not mismatch(formula)] == []
    assert len(exempt) < 0.1 * len(every_formula())


def test_some_formula_takes_every_argument():
    assert set(ARGUMENTS) == {name for formula in every_formula().values() for name in formula.arguments}


def test_a_range_is_one_of_an_argument():
    ranges = [(formula, name, *ends) for formula in every_formula().values() for name, ends in formula.valid.items()]
    assert ranges
    assert [formula.name for formula, name, low, high in ranges if name not in formula.arguments or low >= high] == []


WRONG = {
    "product": (lambda r, w: r * w, "m/s2"),
    "sum": (lambda r, w: r + w, "m"),
    "exponential": (lambda r, w: r * np.exp(w), "m"),
    "power": (lambda r, w: r**w, "m"),
    "angle": (lambda r, w: r * np.arctan2(r, w), "m"),
}
RIGHT = {
    "power": (lambda r, w: r * w**2, "m/s2"),
    "root": (lambda r, e: np.sqrt(r**2 - e**2) - -r, "m"),
    "angle": (lambda r, e: r * np.arctan2(r, e) * np.cos(r / e), "m"),
    "exponent": (lambda p, r_c: p ** (r_c + 1.5) / p, "kg/(m*s2)"),
    "amount": (lambda mc_gas, th_gas: mc_gas * th_gas, "kJ/kmol"),
}


def test_a_wrong_dimension_is_found_and_a_right_one_is_not():
    assert {name: mismatch(Formula(one, "speed", "", unit)) for name, (one, unit) in RIGHT.items()} == dict.fromkeys(
        RIGHT, ""
    )
    assert [name for name, (one, unit) in WRONG.items() if not mismatch(Formula(one, "speed", "", unit))] == []
