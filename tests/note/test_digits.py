"""Printed numbers give the printed value on a pocket calculator."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

import crankwork
from crankwork.formula.explained import Explanation
from crankwork.formula.expression import FORMULAS
from crankwork.formula.known import Arithmetic, Total, Use, given, total
from crankwork.formula.lines import FormulaLine, Moment, ValueLine, without_noise
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.digits import enough_digits
from crankwork.note.equations import line_parts, told_values

FILES = [*sorted(Path("examples").glob("*.toml")), *crankwork.template_names()]
CASES = [(file, way) for file in FILES for way in ("exact", "textbook")]
# what is zero but for rounding
NOTHING = 1e-15
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
CALCULATOR = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "arcsin": math.asin, "arccos": math.acos, "arctan": math.atan,
    "sqrt": math.sqrt, "exp": math.exp, "ln": math.log, "lg": math.log10, "abs": abs, "max": max, "min": min,
    "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh, "sign": lambda x: math.copysign(1.0, x) if x else 0.0,
    "pi": math.pi,
}  # fmt: skip


def keyed_in(printed: str) -> float:
    """Return what a calculator shows for a printed expression."""
    printed = printed.replace("\u00a0rad", "").replace("°)", "·π/180)")
    typed = re.sub(r"[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+", lambda found: f"**({found[0].translate(SUPERSCRIPTS)})", printed)
    # a power of ten belongs to its number
    typed = re.sub(r"(?<![\d.])10\*\*\((-?\d+)\)", r"1e\1", typed)
    typed = typed.replace("·", "*").replace("−", "-").replace("√", "sqrt").replace("^", "**").replace("π", "pi")
    return float(eval(typed, {"__builtins__": {}}, CALCULATOR))  # noqa: S307 - printed by the program itself


def terms(printed: str) -> list[float]:
    """Return the terms of a printed sum."""
    depth, parts = 0, [""]
    for at, letter in enumerate(printed):
        depth += (letter == "(") - (letter == ")")
        if depth == 0 and letter in "+−" and printed[max(at - 1, 0)] == " ":
            parts.append("")
        else:
            parts[-1] += letter
    return [keyed_in(part) for part in parts if part.strip()]


def last_place(value: float) -> float:
    return 10.0 ** (math.floor(math.log10(abs(value))) - 5) if value else 0.0


def missed(numbers: str, value: str) -> str:
    """Return what is wrong with a line, empty if its numbers give its value."""
    value = re.split("[\u00a0°%]", value)[0]
    found, printed = keyed_in(numbers), keyed_in(value)
    largest = max(map(abs, [*terms(numbers), printed]))
    # the printed values are decimals, their difference is not
    fits = abs(found - printed) <= 2.0000001 * last_place(largest) or max(abs(found), abs(printed)) < 1e-11 * largest
    return "" if fits or abs(printed) < NOTHING else f"{numbers} = {found:.10g}, not {value}"


@pytest.mark.parametrize(("file", "way"), CASES)
def test_every_line_can_be_followed_with_a_calculator(file, way, results_of, groups_of):
    wrong, count = [], 0
    for group in groups_of(results_of(file, way)):
        for step in group.lines:
            if isinstance(step, ValueLine):
                continue
            count += 1
            *before, value = line_parts(step, "en")[: 1 - len(told_values(step)) or None]
            # symbols, then numbers, unless those are the value
            if len(before) > 1 and (said := missed(before[-1], value)):
                wrong.append(f"{step.key}: {said}")
    assert count
    assert wrong == []


@pytest.mark.parametrize(("file", "way"), CASES)
def test_every_line_of_an_explanation_can_be_followed_with_a_calculator(file, way, results_of):
    results, wrong = results_of(file, way), []
    keys = [one for one in ("crank_torque", "gas_pressure", "driving_torque", "point_x.B") if one in results.memory]
    for key in keys:
        for at in results.grid.degrees[[1, len(results.grid) // 3, len(results.grid) // 2]].tolist():
            told = Explanation(results.memory[key], at, CrankGrid.from_degrees)
            for one in told:
                if one.residual or not isinstance(one.known.node, Use | Arithmetic | Total):
                    continue
                step = without_noise(told.moment(one.degrees).step(one.known))
                *before, value = line_parts(step, "en")[: 1 - len(told_values(step)) or None]
                if len(before) > 1 and (said := missed(before[-1], value)):
                    wrong.append(f"{key} at {at:g}: {step.key}: {said}")
    assert wrong == []


def test_a_difference_of_near_numbers_gets_more_digits():
    terms = [given("piston_mass", 1234.56789), given("rod_small_end_mass", -1234.56111)]
    line = Moment(CrankGrid.from_degrees, 0.0).step(total("reciprocating_mass", terms))
    assert enough_digits(line) == 9
    assert line_parts(line, "en")[1:] == ["1234.56789 + (−1234.56111)", "0.00678\u00a0kg"]


def test_a_product_of_moderate_numbers_has_six_digits():
    formula = FORMULAS["piston_area"]
    step = FormulaLine(
        "piston_area", formula, {"pi": math.pi, "D": 0.0789123456}, formula.function(math.pi, 0.0789123456)
    )
    assert enough_digits(step) == 6
    assert line_parts(step, "en")[1] == "π·0.0789123²/4"
