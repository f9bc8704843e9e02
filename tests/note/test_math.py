"""Printed mathematics says what the formula computes: boxes are read back and evaluated."""

from __future__ import annotations

import contextlib
import math
import operator
import re
import xml.etree.ElementTree as ET
from decimal import Decimal
from fractions import Fraction as Exact

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from crankwork.formula.expression import Number, Operation, Symbol, record, symbol
from crankwork.kinematics import slider_crank
from crankwork.loads.gas import clearance_volume
from crankwork.note.layout import (
    CLOSE,
    DOT,
    MINUS,
    OPEN,
    PRODUCT,
    Apply,
    Digits,
    Fence,
    Fraction,
    Letter,
    Root,
    Row,
    Script,
    Sign,
    Upright,
    broken,
    row,
    width,
)
from crankwork.note.math import formula_box, mathml_box
from crankwork.note.pdf import typst_box
from crankwork.note.symbols import number_box, symbol_box
from crankwork.note.word_parts import omml_box
from crankwork.quantities import LANGUAGES

MATH = "http://schemas.openxmlformats.org/officeDocument/2006/math"
NAMESPACES = f'xmlns:m="{MATH}" xmlns:w="http://schemas.openxmlformats.org/wordprocessingml/2006/main"'

# --- reading boxes back

NAMES = {"r": 3, "x": 5, "sin_phi": -7, "beta_1": Exact(11, 13), "m_rec": 2}
BOXES = {name: symbol_box(symbol(name)) for name in NAMES}
FUNCTIONS = {"ln": np.log, "sin": np.sin, "cos": np.cos, "tan": np.tan, "arcsin": np.arcsin, "arctan": np.arctan,
             "arccos": np.arccos, "lg": np.log10, "max": np.maximum, "min": np.minimum, "tanh": np.tanh,
             "sinh": np.sinh, "cosh": np.cosh, "arctan2": np.arctan2, "arctg": np.arctan,
             "tg": np.tan, "sh": np.sinh, "ch": np.cosh, "th": np.tanh}  # fmt: skip


def read(box, number=float, root=np.sqrt):  # noqa: C901, PLR0912 - one case per kind of box
    """Return the value of a printed formula, by the rules by which people read one."""
    if box in BOXES.values():
        return next(Exact(NAMES[name]) for name, one in BOXES.items() if one == box)
    match box:
        case Digits(text):
            return number(text.replace(",", "."))
        case Letter("π"):
            return np.pi
        case Row((*parts, _, Upright("rad" | "рад"))):
            return _read_row(tuple(parts), number, root)
        case Row(parts):
            return _read_row(parts, number, root)
        case Fraction(top, bottom):
            return read(top, number, root) / read(bottom, number, root)
        case Root(inside):
            return root(read(inside, number, root))
        case Fence(inside, marks):
            value = read(inside, number, root)
            return abs(value) if marks == "||" else value
        case Script(Upright("e"), None, above):
            return np.exp(read(above, number, root))
        case Script(base, below, Row(parts)) if Script(base, below, parts[0]) in BOXES.values():
            return read(Script(base, below, parts[0]), number, root) ** read(Row(parts[1:]), number, root)
        case Script(base, below, above):
            bare = Script(base, below) if below else base
            return read(bare, number, root) ** read(above, number, root)
        case Apply(Script(name, None, above), argument):
            return read(Apply(name, argument), number, root) ** read(above, number, root)
        case Apply(Upright(name), Fence(Row(parts))) if any(getattr(one, "kind", "") == "comma" for one in parts):
            at = next(k for k, one in enumerate(parts) if getattr(one, "kind", "") == "comma")
            return FUNCTIONS[name](*(_read_row(one, number, root) for one in (parts[:at], parts[at + 1 :])))
        case Apply(Upright(name), argument):
            return FUNCTIONS[name](read(argument, number, root))
    raise AssertionError(box)


def _read_row(parts, number, root):
    """Add, multiply and divide, products and slashes before sums; a sign stands first or in parentheses."""
    total, product, sign, pending = 0, None, 1, operator.mul
    for k, part in enumerate(parts):
        match part:
            case Sign(text, "binary" | "prefix" as kind):
                assert kind == "binary" or k == 0, "a minus stands next to another sign"
                total += 0 if product is None else sign * product
                product, sign, pending = None, -1 if text == "−" else 1, operator.mul
            case Sign(_, "times"):
                pending = operator.mul
            case Sign(_, "slash"):
                pending = operator.truediv
            case _:
                value = read(part, number, root)
                product = value if product is None else pending(product, value)
    return total + (0 if product is None else sign * product)


def _some_function(value):
    return value * Exact(3, 7) + 11


LEAVES = st.one_of(
    st.sampled_from(list(NAMES)).map(Symbol), st.integers(-3, 6).map(Number), st.sampled_from([0.5, -1.25]).map(Number)
)
EXPONENTS = st.sampled_from([2, 3, 4, 5, 1, -1, -2])
TREES = st.recursive(
    LEAVES,
    lambda trees: st.one_of(
        *(st.builds(one, trees, trees) for one in (operator.add, operator.sub, operator.mul, operator.truediv)),
        st.builds(operator.pow, trees, EXPONENTS),
        trees.map(operator.neg),
        trees.map(np.sqrt),
    ),
    max_leaves=8,
)


def _exact(tree, values):
    match tree:
        case Symbol(name):
            return Exact(values[name])
        case Number(value):
            return Exact(value)
        case Operation(np.sqrt, (operand,)):
            return _some_function(_exact(operand, values))
        case Operation(function, operands):
            return function(*(_exact(one, values) for one in operands))


@given(tree=TREES, numbers=st.fixed_dictionaries(dict.fromkeys(NAMES, st.integers(-6, 6).filter(bool))))
def test_a_formula_printed_with_symbols_and_with_numbers_says_what_the_tree_computes(tree, numbers):
    for values, shown in ((NAMES, (tree,)), (numbers, (tree, numbers, "ru"))):
        # a tree may divide by zero with some numbers only
        with contextlib.suppress(ZeroDivisionError):
            expected = _exact(tree, values)
            assert read(formula_box(*shown), Exact, _some_function) == expected


@given(tree=TREES)
def test_digits_never_run_together(tree):
    for box in _all_boxes(formula_box(tree)):
        if isinstance(box, Row):
            for left, sign, right in zip(box.parts, box.parts[1:], box.parts[2:], strict=False):
                digits = isinstance(right, Digits) or (isinstance(left, Digits) and isinstance(right, Fraction))
                assert not (sign == PRODUCT and digits)


def _all_boxes(box):
    yield box
    for name in getattr(box, "__slots__", ()):
        inner = getattr(box, name)
        for one in inner if isinstance(inner, tuple) else (inner,):
            if hasattr(one, "__slots__") and not isinstance(one, str):
                yield from _all_boxes(one)


def _misprinted(formula, language, generator):
    """Return whether a formula reads as another number than it computes."""
    values = {name: float(generator.uniform(0.1, 0.9)) for name in formula.arguments}
    values |= {name: value for name, value in (("e", 0.05), ("lam_m", 2.0)) if name in values}
    with np.errstate(all="ignore"):
        expected = formula.function(**values)
        if not np.isfinite(expected):
            return False
        shown = read(formula_box(record(formula.function), values, language, digits=17))
    return shown != pytest.approx(expected, rel=1e-12)


def test_every_registered_formula_printed_with_numbers_gives_its_value(formulas):
    generator = np.random.default_rng(7)
    every = [(one, language) for language in LANGUAGES for one in formulas.values()]
    assert [(one.name, language) for one, language in every if _misprinted(one, language, generator)] == []


# --- numbers


@given(value=st.floats(-1e12, 1e12), language=st.sampled_from(LANGUAGES), digits=st.integers(3, 15))
def test_a_printed_number_is_the_rounding_of_the_exact_value(value, language, digits):
    shown = read(number_box(value, language, digits)[0], Decimal)
    unit = Decimal(10) ** (Decimal(value).adjusted() - digits + 1) if value else Decimal(1)
    assert abs(Decimal(shown) - Decimal(value)) <= unit / 2


NUMBERS = {
    (0.5, "en"): Digits("0.5"),
    (0.5, "vi"): Digits("0,5"),
    (-0.0, "en"): Digits("0"),
    (-2.5, "ru"): Row((Sign("−", "prefix"), Digits("2,5"))),
    (1.25e-7, "ru"): row(Digits("1,25"), DOT, Script(Digits("10"), None, row(MINUS, Digits("7")))),
    (1e9, "en"): Row((Script(Digits("10"), None, Digits("9")),)),
}
SYMBOLS = {
    "β": Letter("β"),
    "v_п.ср": Script(Letter("v"), Upright("п.ср")),
    "J′_пр": Script(Letter("J"), Upright("пр"), Upright("′")),
    "x_S″": Script(Letter("x"), Upright("S"), Upright("″")),
    "p_г₁": Script(Letter("p"), Upright("г1")),
    "M_CO₂": Script(Letter("M"), Row((Script(Upright("CO"), Upright("2")),))),
    "M_H₂O": Script(Letter("M"), Row((Script(Upright("H"), Upright("2")), Upright("O")))),
    "ΔJ": Row((Upright("Δ"), Letter("J"))),
    "sin 2φ": Apply(Upright("sin"), Row((Digits("2"), Letter("φ")))),
    "cos(φ+β)": Apply(Upright("cos"), Fence(Row((Letter("φ"), Sign("+"), Letter("β"))))),
    "1/cos β": Fraction(Digits("1"), Apply(Upright("cos"), Letter("β"))),
    "S/D": Row((Letter("S"), Sign("/", "slash"), Letter("D"))),
}


def test_how_numbers_and_symbols_print():
    assert {one: number_box(*one)[0] for one in NUMBERS} == NUMBERS
    assert {one: symbol_box(one) for one in SYMBOLS} == SYMBOLS


def test_an_exact_pi_stays_a_symbol_and_another_is_a_number():
    tree = record(lambda pi, D: pi * D)
    assert formula_box(tree, {"pi": math.pi, "D": 2}) == Row((Letter("π"), DOT, Digits("2")))
    assert formula_box(tree, {"pi": 3.14, "D": 2}) == Row((Digits("3.14"), DOT, Digits("2")))


def test_a_power_of_a_function_stands_at_its_name():
    assert formula_box(record(lambda sin_phi: sin_phi**2)) == Apply(
        Script(Upright("sin"), None, Digits("2")), Letter("φ")
    )


# --- lines


@given(tree=TREES, limit=st.floats(4, 20))
def test_a_broken_line_still_says_what_the_tree_computes(tree, limit):
    try:
        expected = _exact(tree, NAMES)
    except ZeroDivisionError:
        assume(False)
    lines = broken(row(formula_box(tree)), limit)
    assert _read_row(_closed(part for one in lines for part in one.parts), Exact, _some_function) == expected
    for one in lines:
        divisible = any(isinstance(part, Sign) and part.kind == "binary" for part in one.parts[1:])
        assert width(one) <= limit or not divisible


def _closed(parts):
    """Return parts with every divided pair of parentheses as one box again."""
    stack = [[]]
    for part in parts:
        if part == OPEN:
            stack.append([])
        elif part == CLOSE:
            inside = Fence(Row(tuple(stack.pop())))
            stack[-1].append(inside)
        else:
            stack[-1].append(part)
    (whole,) = stack
    return tuple(whole)


def test_a_long_numerator_is_divided():
    terms = [Fence(Row((Letter("a"), Sign("+"), Letter("b")))) for _ in range(12)]
    top = row(*(part for one in terms for part in (one, Sign("+"))), Letter("c"))
    lines = broken(row(Letter("x"), Sign("=", "relation"), Fraction(top, Letter("d"))), 15.0)
    assert all(width(one) <= 15.0 for one in lines)
    assert lines[0].parts[2:5] == (Fraction(Digits("1"), Letter("d")), DOT, OPEN)


def test_parentheses_of_different_lines_are_literal_in_word():
    top = row(*(part for _ in range(12) for part in (Letter("a"), Sign("+"))), Letter("c"))
    lines = broken(row(Letter("x"), Sign("=", "relation"), Fraction(top, Letter("d"))), 8.0)
    marks = []
    for one in lines:
        shown = ET.fromstring(f"<m:oMath {NAMESPACES}>{omml_box(one)}</m:oMath>")  # noqa: S314 - our own text
        for run in shown.iter(f"{{{MATH}}}r"):
            text = run.findtext(f"{{{MATH}}}t")
            assert (run.find(f"{{{MATH}}}rPr/{{{MATH}}}lit") is not None) == (text in "()")
            marks += [text] if text in "()" else []
    assert len(lines) > 2
    assert marks == ["(", ")"]


# --- the three formats


def _unsound(formula, language):
    """Return the format in which a formula is no sound text, or has other numbers than it is given."""
    tree = record(formula.function)
    for values in (None, dict.fromkeys(formula.arguments, -1234.5)):
        box = formula_box(tree, values, language)
        for xml in (f"<m:oMath {NAMESPACES}>{omml_box(box)}</m:oMath>", mathml_box(box)):
            ET.fromstring(xml)  # noqa: S314 - our own text
            if ("−1234" in re.sub("<[^>]+>", "", xml)) != (values is not None and bool(formula.arguments)):
                return "xml"
        unquoted = re.sub(r'"(?:[^"\\]|\\.)*"', "", typst_box(box))
        if unquoted.count("(") != unquoted.count(")"):
            return "typst"
    return ""


def test_every_formula_prints_in_every_format(formulas):
    every = [(one, language) for language in LANGUAGES for one in formulas.values()]
    assert [(one.name, language, said) for one, language in every if (said := _unsound(one, language))] == []


def test_the_formats_of_one_formula():
    tree = record(clearance_volume)
    assert typst_box(formula_box(tree)) == 'frac(attach(V, b: upright(d)), attach(r, b: "c") − 1)'
    assert typst_box(formula_box(tree, {"V_d": 0.5, "r_c": 8}, "ru")) == 'frac(0","5, 8 − 1)'
    shown = ET.fromstring(mathml_box(formula_box(tree)))  # noqa: S314 - our own text
    assert [one.tag for one in shown.iter()] == [
        "mfrac", "msub", "mi", "mi", "mrow", "msub", "mi", "mi", "mo", "mn",
    ]  # fmt: skip
    converted = omml_box(formula_box(record(slider_crank.rod_transfer_1)))
    word = ET.fromstring(f"<m:oMath {NAMESPACES}>{converted}</m:oMath>")  # noqa: S314 - our own text
    assert [one.tag for one in word] == [f"{{{MATH}}}f"]
    assert len(word.findall(f".//{{{MATH}}}func")) == 2


def test_a_decimal_comma_is_inside_one_number():
    box = formula_box(record(clearance_volume), {"V_d": 0.25}, "ru")
    assert "<mn>0,25</mn>" in mathml_box(box)
    # where it is text, LibreOffice sets a numerator to the left
    run = omml_box(box).partition("0,25</m:t>")[0].rpartition("<m:r>")[2]
    assert run.startswith('<m:rPr><m:sty m:val="p"/>')
    assert run.endswith('<m:t xml:space="preserve">')


def test_primes_stand_at_their_letter_in_browsers():
    second = '<msub><mrow><mi>x</mi><mtext>″</mtext></mrow><mi mathvariant="normal">B</mi></msub>'
    assert mathml_box(symbol_box("x″_B")) == second
    assert mathml_box(symbol_box("β′")) == "<mrow><mi>β</mi><mtext>′</mtext></mrow>"
