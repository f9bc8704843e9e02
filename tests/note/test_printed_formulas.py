"""What is printed reads as what is calculated: a reader of plain text, written apart, gives the same numbers."""

from __future__ import annotations

import math
import re

import numpy as np

from crankwork.formula.explained import Explanation
from crankwork.formula.expression import FORMULAS, Operation, evaluate, record, symbol, text
from crankwork.formula.known import Arithmetic, Total, Use, given, total
from crankwork.formula.lines import FormulaLine, Moment, ValueLine, symbols_of, without_noise
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.digits import enough_digits
from crankwork.note.equations import line_parts, told_values, value_symbol
from note.built import broken, every_machine, groups, remembered, results

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
POWER = re.compile(r"[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+")
NUMBER = re.compile(r"\d+(\.\d+)?(·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
FUNCTIONS = {
    "√": np.emath.sqrt, "exp": np.exp, "ln": np.emath.log, "lg": np.emath.log10, "sin": np.sin, "cos": np.cos,
    "tan": np.tan, "arctan": np.arctan, "arcsin": np.emath.arcsin, "arccos": np.emath.arccos, "sinh": np.sinh,
    "cosh": np.cosh, "tanh": np.tanh, "abs": np.abs, "sign": np.sign, "max": np.maximum, "min": np.minimum,
}  # fmt: skip
COMPLEX = {
    np.sqrt: np.emath.sqrt, np.log: np.emath.log, np.log10: np.emath.log10,
    np.arcsin: np.emath.arcsin, np.arccos: np.emath.arccos,
}  # fmt: skip


class Reader:
    """Someone who reads one line of text and knows what each symbol is."""

    def __init__(self, line: str, known: dict[str, complex]) -> None:
        known = {"π": math.pi} | known
        self.line, self.known, self.at = line, sorted(known.items(), key=lambda one: -len(one[0])), 0

    def value(self) -> complex:
        found = self.sum()
        assert self.at == len(self.line), f"{self.line!r} cannot be read from {self.line[self.at :]!r} on"
        return found

    def take(self, sign: str) -> bool:
        is_next = self.line.startswith(sign, self.at)
        self.at += len(sign) * is_next
        return is_next

    def sum(self) -> complex:
        found = -self.product() if self.take("−") else self.product()
        while True:
            if self.take(" + "):
                found += self.product()
            elif self.take(" − "):
                found -= self.product()
            else:
                return found

    def product(self) -> complex:
        found = self.power()
        while True:
            if self.take("·"):
                found *= self.power()
            elif self.take("/"):
                found /= self.power()
            else:
                return found

    def power(self) -> complex:
        base, is_open = self.atom()
        raised = POWER.match(self.line, self.at)
        assert not (is_open and (raised or self.line.startswith("^", self.at))), f"{self.line!r}: power of what?"
        if raised:
            self.at = raised.end()
            return base ** int(raised[0].translate(RAISED))
        return base ** self.power() if self.take("^") else base

    def atom(self) -> tuple[complex, bool]:
        """Return a value, and whether a power after it could belong to its argument."""
        for shown, value in self.known:
            if self.take(shown):
                return value, shown.startswith(("sin ", "cos ", "tan ", "sin(", "cos("))
        if self.take("("):
            return self.fenced()[0], False
        if found := NUMBER.match(self.line, self.at):
            self.at = found.end()
            mantissa, _, exponent = found[0].partition("·10")
            return float(mantissa) * 10.0 ** int(exponent.translate(RAISED) or 0), False
        for name, function in FUNCTIONS.items():
            if self.take(f"{name}("):
                return function(*self.fenced()), name not in ("√", "abs")
        raise AssertionError(f"{self.line!r} cannot be read from {self.line[self.at :]!r} on")

    def fenced(self) -> list[complex]:
        found = [self.sum()]
        while self.take(", "):
            found.append(self.sum())
        assert self.take(")"), f"{self.line!r}: no end of parentheses at {self.line[self.at :]!r}"
        return found


def add_meaning(shown: str, value: complex, known: dict[str, complex]) -> None:
    """Add what a symbol says of the letters that it is printed with: v/ω of v and of ω."""
    top, slash, bottom = shown.partition("/")
    if " − " in shown or (" + " in shown and not shown.endswith(")")):
        one, sign, rest = re.split(r" ([−+]) ", shown)
        value, shown = (value - float(one)) * (-1 if sign == "−" else 1), rest
    elif slash:
        known.setdefault(bottom, 1.7)
        value, shown = value * known[bottom], top
        if top == "1":
            known[bottom], shown = 1 / (value / known[bottom]), bottom
            value = known[bottom]
    elif shown.endswith("²"):
        value, shown = np.emath.sqrt(value), shown[:-1]
    assert abs(known.setdefault(shown, value) - value) < 1e-12, f"{shown} stands for two values"


def misread(tree, symbols: dict[str, str], values: dict[str, float]) -> str:
    """Return what is wrong with a printed formula, empty if it reads as it computes, whatever its operands are."""
    line, random = text(tree, symbols), np.random.default_rng(7)
    put_in, known, stands_for = {}, {}, {}
    for name, shown in symbols.items():
        if shown in stands_for:
            if values[stands_for[shown]] != values[name]:
                return f"{line}: two operands are {shown}"
            put_in[name] = put_in[stands_for[shown]]
        else:
            stands_for[shown] = name
            put_in[name] = math.pi if name == "pi" else complex(random.uniform(0.4, 1.6))
            add_meaning(shown, put_in[name], known)
    with np.errstate(all="ignore"):
        wanted = evaluated(tree, put_in)
        found = Reader(line, known).value()
    return "" if abs(found - wanted) <= 1e-9 * abs(wanted) else f"{line} reads {found}, not {wanted}"


def evaluated(tree, put_in):
    """Return the value of a tree, complex where a root or an arc has no real one."""
    match tree:
        case Operation(function, operands):
            return COMPLEX.get(function, function)(*(evaluated(one, put_in) for one in operands))
    return evaluate(tree, put_in)


def misread_formula(name: str) -> str:
    tree = record(FORMULAS[name].shown)
    symbols = {one: symbol(one) for one in symbols_of(tree)}
    return misread(tree, symbols, dict(zip(symbols, range(len(symbols)), strict=True)))


def test_every_registered_formula_reads_as_it_computes(formulas):
    assert broken(misread_formula, sorted(formulas)) == {}


def missed(step) -> str:
    """Return what is wrong with the numbers of a line, empty if a calculator finds the printed value from them."""
    *before, value = line_parts(step, "en")[: 1 - len(told_values(step)) or None]
    if len(before) < 2:
        return ""
    printed, *terms = (keyed_in(one) for one in (re.split("[\u00a0°%]", value)[0], *terms_of(before[-1])))
    largest = max(map(abs, (printed, *terms)))
    place = 10.0 ** (math.floor(math.log10(largest)) - 5) if largest else 0.0
    if step.value == 0 and "" in getattr(step, "noise", ()):
        return "" if abs(sum(terms)) <= max(2 * place, 1e-10) else f"{before[-1]} is not zero"
    return "" if abs(sum(terms) - printed) <= 2.0000001 * place else f"{before[-1]} = {sum(terms):.10g}, not {value}"


def keyed_in(printed: str) -> float:
    return Reader(printed.replace("\u00a0rad", "").replace("°)", "·π/180)"), {}).value().real


def terms_of(printed: str) -> list[str]:
    """Return the terms of a printed sum."""
    depth, parts = 0, [""]
    for before, letter in zip(" " + printed, printed, strict=False):
        depth += (letter == "(") - (letter == ")")
        if depth == 0 and letter in "+−" and before == " ":
            parts.append("−" * (letter == "−"))
        elif depth or letter != " ":
            parts[-1] += letter
    return [part for part in parts if part]


def misread_formulas(case: str) -> list[str]:
    """Return what is wrong with the formulas that results remember, between the crank angles of their tables."""
    degrees = results(case).grid.degrees
    at = Moment(CrankGrid.from_degrees, float(degrees[len(degrees) // 3]) + 7.3)
    wrong, seen = set(), set()
    for one in remembered(results(case)):
        if not (isinstance(one.node, Use) or (isinstance(one.node, Arithmetic) and one.key)):
            continue
        step = without_noise(at.step(one))
        wrong.add(missed(step))
        shown = {name: value_symbol(key, "en") for name, key in step.named}
        shown = {name: shown.get(name) or symbol(name) for name in symbols_of(step.expression)}
        mark = (step.expression, tuple(shown.items()))
        if mark not in seen:
            seen.add(mark)
            wrong.add(misread(step.expression, shown, step.values))
    return sorted(wrong - {""})


@every_machine
def test_every_formula_of_a_machine_reads_as_it_computes(cases):
    assert broken(misread_formulas, cases) == {}


def missed_lines(case: str) -> list[str]:
    """Return the lines of a note, and of explanations at three crank angles, whose numbers do not give the value."""
    steps = [without_noise(one) for group in groups(case) for one in group.lines if not isinstance(one, ValueLine)]
    assert steps
    memory, degrees = results(case).memory, results(case).grid.degrees
    for key in {"crank_torque", "gas_pressure", "driving_torque", "point_x.B"} & memory.keys():
        for at in degrees[[1, len(degrees) // 3, len(degrees) // 2]].tolist():
            told = Explanation(memory[key], at, CrankGrid.from_degrees)
            worked = (one for one in told if not one.residual and isinstance(one.known.node, Use | Arithmetic | Total))
            steps += [without_noise(told.moment(one.degrees).step(one.known)) for one in worked]
    return [f"{step.key}: {said}" for step in steps if (said := missed(step))]


@every_machine
def test_every_line_can_be_followed_with_a_calculator(cases):
    assert broken(missed_lines, cases) == {}


def test_a_difference_of_near_numbers_gets_more_digits_and_a_product_six():
    terms = [given("piston_mass", 1234.56789), given("rod_small_end_mass", -1234.56111)]
    line = Moment(CrankGrid.from_degrees, 0.0).step(total("reciprocating_mass", terms))
    assert enough_digits(line) == 9
    assert line_parts(line, "en")[1:] == ["1234.56789 + (−1234.56111)", "0.00678\u00a0kg"]
    formula, values = FORMULAS["piston_area"], {"pi": math.pi, "D": 0.0789123456}
    step = FormulaLine("piston_area", formula, values, formula.function(*values.values()))
    assert enough_digits(step) == 6
    assert line_parts(step, "en")[1] == "π·0.0789123²/4"
