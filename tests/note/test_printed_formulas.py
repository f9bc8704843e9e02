"""What is printed reads as what is calculated: a reader of plain text, written apart, gives the same numbers."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from crankwork.formula.calculation_lines import Explanation, FormulaLine, Snapshot, ValueLine, symbols_of, without_noise
from crankwork.formula.expression import FORMULAS, Operation, evaluate, record, symbol, text
from crankwork.formula.traced_value import Arithmetic, FormulaCall, Sum, given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.equations import distinct_values, line_parts, value_symbol
from crankwork.note.math import enough_digits
from note.built import broken, every_machine, groups, results, traced

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
# a number, a power, or a parenthesis
TOKENS = r"\d+(?:\.\d+)?(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?|[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+|\("
SIGNS = str.maketrans({"·": "*", "−": "-", "^": "**"})
FUNCTIONS = {
    "√": np.emath.sqrt, "exp": np.exp, "ln": np.emath.log, "lg": np.emath.log10, "sin": np.sin, "cos": np.cos,
    "tan": np.tan, "arctan": np.arctan, "arcsin": np.emath.arcsin, "arccos": np.emath.arccos, "sinh": np.sinh,
    "cosh": np.cosh, "tanh": np.tanh, "abs": np.abs, "sign": np.sign, "max": np.maximum, "min": np.minimum,
}  # fmt: skip
COMPLEX = {
    np.sqrt: np.emath.sqrt, np.log: np.emath.log, np.log10: np.emath.log10,
    np.arcsin: np.emath.arcsin, np.arccos: np.emath.arccos,
}  # fmt: skip


class Open(complex):
    """A function of something: a power after it could belong to its argument."""

    def __pow__(self, _):
        raise AssertionError("power of what?")


def value_of(line: str, known: dict[str, complex]) -> complex:
    """Return what a line of text is to someone who knows what each symbol is and reads nothing else."""
    assert not re.search("[·/^+−] ?−", line), f"{line!r}: two signs"
    names = {"(": complex, "π": math.pi} | known
    for name, function in FUNCTIONS.items():
        kind = complex if name in ("√", "abs") else Open
        names[f"{name}("] = lambda *of, function=function, kind=kind: kind(function(*of))
    names |= {shown: Open(value) for shown, value in known.items() if re.match("(sin|cos|tan)[ (]", shown)}
    spelt = {shown: f"of_{at}" for at, shown in enumerate(names)}

    def typed(found: re.Match) -> str:
        shown = found[0]
        if shown in spelt:
            return spelt[shown] + "(" * (shown == "(" or shown[:-1] in FUNCTIONS)
        if shown[0].isdecimal():
            return shown.translate(RAISED).replace("·10", "e")
        return f"**({shown.translate(RAISED)})"

    symbols = "|".join(re.escape(shown) for shown in sorted(names, key=len, reverse=True))
    source = re.sub(f"{symbols}|{TOKENS}", typed, line).translate(SIGNS)
    try:
        values = {spelt[shown]: value for shown, value in names.items()}
        return complex(eval(source, {"__builtins__": {}}, values))  # noqa: S307 - printed by the program itself
    except (SyntaxError, NameError, TypeError) as error:
        raise AssertionError(f"{line!r} cannot be read: {error}") from error


def test_what_is_no_line_of_a_book_cannot_be_read():
    for line in ("sin φ²", "ln(x)^2", "x·−x", "x + −x", "xx", "2x", "y", "x)", "(x", "x 2", "exp x"):
        with pytest.raises(AssertionError):
            value_of(line, {"x": 0.7, "sin φ": 0.5})
    assert value_of("−2·10⁻¹·(sin φ)²/x^2 + max(x, 3)", {"x": 0.5, "sin φ": 0.5}) == pytest.approx(2.8)


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
        found = value_of(line, known)
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
    *before, value = line_parts(step, "en")[: 1 - len(distinct_values(step)) or None]
    if len(before) < 2:
        return ""
    printed, *terms = (keyed_in(one) for one in (re.split("[\u00a0°%]", value)[0], *terms_of(before[-1])))
    largest = max(map(abs, (printed, *terms)))
    place = 10.0 ** (math.floor(math.log10(largest)) - 5) if largest else 0.0
    if step.value == 0 and "" in getattr(step, "noise", ()):
        return "" if abs(sum(terms)) <= max(2 * place, 1e-10) else f"{before[-1]} is not zero"
    return "" if abs(sum(terms) - printed) <= 2.0000001 * place else f"{before[-1]} = {sum(terms):.10g}, not {value}"


def keyed_in(printed: str) -> float:
    return value_of(printed.replace("\u00a0rad", "").replace("°)", "·π/180)"), {}).real


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
    at = Snapshot(CrankGrid.from_degrees, float(degrees[len(degrees) // 3]) + 7.3)
    wrong, seen = set(), set()
    for one in traced(results(case)):
        if not (isinstance(one.node, FormulaCall) or (isinstance(one.node, Arithmetic) and one.key)):
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
    trace, degrees = results(case).trace, results(case).grid.degrees
    for key in {"crank_torque", "gas_pressure", "driving_torque", "point_x.B"} & trace.keys():
        for at in degrees[[1, len(degrees) // 3, len(degrees) // 2]].tolist():
            told = Explanation(trace[key], at, CrankGrid.from_degrees)
            worked = (
                one for one in told if not one.residual and isinstance(one.known.node, FormulaCall | Arithmetic | Sum)
            )
            steps += [without_noise(told.moment(one.degrees).step(one.known)) for one in worked]
    return [f"{step.key}: {said}" for step in steps if (said := missed(step))]


@every_machine
def test_every_line_can_be_followed_with_a_calculator(cases):
    assert broken(missed_lines, cases) == {}


def test_a_difference_of_near_numbers_gets_more_digits_and_a_product_six():
    terms = [given("piston_mass", 1234.56789), given("rod_small_end_mass", -1234.56111)]
    line = Snapshot(CrankGrid.from_degrees, 0.0).step(total("reciprocating_mass", terms))
    assert enough_digits(line) == 9
    assert line_parts(line, "en")[1:] == ["1234.56789 + (−1234.56111)", "0.00678\u00a0kg"]
    formula, values = FORMULAS["piston_area"], {"pi": math.pi, "D": 0.0789123456}
    step = FormulaLine("piston_area", formula, values, formula.function(*values.values()))
    assert enough_digits(step) == 6
    assert line_parts(step, "en")[1] == "π·0.0789123²/4"
