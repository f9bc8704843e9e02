"""From the tree of a formula to boxes: fractions, roots, powers, and parentheses only where they are needed.

Symbols stand side by side in a product; a dot comes where digits, fractions or functions would run together, and
everywhere once numbers are put in. Numbers are printed as they enter the formula: in SI, or in the unit that the
formula states (`n` in revolutions per minute), because only those numbers give the value that stands after them.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.calculation_lines import DelayedLine, FormulaLine, Line, SumLine, ValueLine
from crankwork.formula.expression import (
    Expression,
    Number,
    Operation,
    Symbol,
    evaluate,
    function_name,
    radians,
    symbol,
    takes_angle,
)
from crankwork.note.document import xml_text
from crankwork.note.layout import (
    DOT,
    MINUS,
    PRODUCT,
    SPACE,
    Apply,
    Box,
    Digits,
    Fence,
    Fraction,
    Letter,
    Marked,
    Root,
    Row,
    Script,
    Sign,
    Upright,
    first,
    last,
    leads_with_sign,
    row,
)
from crankwork.note.symbols import number_box, symbol_box
from crankwork.quantities import Language

_SIGNED, _SUM, _PRODUCT, _POWER, _ATOM = 0, 1, 2, 3, 5
RESULT_DIGITS = 6
_MOST_DIGITS = 12
_UNITS = 2
_NEARLY_WHOLE = 1e-9
_SUMS = (operator.add, operator.sub)
_SPACES = {"prefix": "0", "times": "0.12em", "slash": "0", "binary": "0.25em", "relation": "0.35em"}


class _Printing(NamedTuple):
    """Options of printing a formula."""

    values: Mapping[str, float]
    language: Language
    digits: int
    inline: bool = False
    symbols: Mapping[str, str] = MappingProxyType({})


def formula_box(
    tree: Expression,
    values: Mapping[str, float] | None = None,
    language: Language = "en",
    *,
    digits: int = 6,
    symbols: Mapping[str, str] | None = None,
) -> Box:
    """Return the boxes of a recorded formula, with symbols, or with numbers in place of them."""
    return _box(tree, _Printing(values or {}, language, digits, symbols=symbols or {}))[0]


def _box(tree: Expression, printing: _Printing) -> tuple[Box, int]:
    """Return the box of a node and how tightly it binds."""
    match tree:
        case Symbol(name):
            return _symbol(name, printing)
        case Number(math.pi):
            return symbol_box("π"), _ATOM
        case Number(value):
            return _bound(*number_box(value, printing.language, digits=15))
        case Operation(function, (left, right)) if function in (operator.add, operator.sub):
            sign = Sign("+" if function is operator.add else "−")
            return row(_box(left, printing)[0], sign, _wrapped(right, _SUM + (sign.text == "−"), printing)), _SUM
        case Operation(operator.mul, (left, right)):
            return _product(left, right, printing), _PRODUCT
        case Operation(operator.truediv, (left, right)):
            return _quotient(left, right, printing)
        case Operation(function, (base, exponent)) if function in (operator.pow, np.power):
            return _power(base, exponent, printing), _POWER
        case Operation(operator.neg, (operand,)):
            return row(MINUS, _wrapped(operand, _PRODUCT, printing)), _SIGNED
        case Operation(function, operands):
            return _function(function, operands, printing)
    raise TypeError(f"{tree!r} is not part of a formula")


def _bound(box: Box, plain: bool) -> tuple[Box, int]:  # noqa: FBT001 - as number_box returns it
    if plain:
        return box, _ATOM
    return box, _SIGNED if leads_with_sign(box) else _PRODUCT


def _symbol(name: str, printing: _Printing) -> tuple[Box, int]:
    value = printing.values.get(name)
    if value is not None and not is_exact_pi(name, value):
        return _bound(*number_box(value, printing.language, printing.digits))
    box = symbol_box(printing.symbols.get(name) or symbol(name, printing.language))
    if isinstance(box, Row) and any(isinstance(part, Sign) for part in box.parts):
        return box, _PRODUCT
    return box, _POWER if isinstance(box, Apply | Row) else _ATOM


def _wrapped(tree: Expression, level: int, printing: _Printing) -> Box:
    """Return the box of an operand, in parentheses if it binds less than `level` or begins with a minus."""
    box, binding = _box(tree, printing)
    return Fence(box) if binding < level or leads_with_sign(box) else box


def _product(left: Expression, right: Expression, printing: _Printing) -> Box:
    left_box, binding = _box(left, printing)
    if binding < _PRODUCT and binding != _SIGNED:
        left_box = Fence(left_box)
    right_box = _wrapped(right, _PRODUCT, printing)
    dotted = bool(printing.values) or _run_together(last(left_box), first(right_box))
    return row(left_box, DOT if dotted else PRODUCT, right_box)


def _run_together(left: Box, right: Box) -> bool:
    """Return whether two factors side by side could be read as something else."""
    match left, right:
        case (_, Digits() | Script(Digits())) | (Upright(), _) | (_, Upright()):
            return True
        case (Digits() | Script(Digits()), Fraction() | Script(above=Row() | Digits() | Upright() | Script())):
            return True
        case (Fraction(), Fraction()):
            return True
        case (Apply(), Apply()):
            return False
        case (Apply(), _):
            return True
    return False


def _quotient(left: Expression, right: Expression, printing: _Printing) -> tuple[Box, int]:
    """Return a fraction; in an exponent, and in a sum above or below another, one with a slash."""
    if printing.inline:
        return row(_wrapped(left, _PRODUCT, printing), Sign("/", "slash"), _wrapped(right, _POWER, printing)), _PRODUCT
    left, below = _parted(left)
    boxes = [
        _box(part, printing._replace(inline=isinstance(part, Operation) and part.function in _SUMS))[0]
        for part in (left, right if below is None else Operation(operator.mul, (below, right)))
    ]
    return Fraction(*boxes), _POWER


def _parted(tree: Expression) -> tuple[Expression, Expression | None]:
    """Return the numerator and the denominator of a product with fractions in it, None where there are none."""
    match tree:
        case Operation(operator.truediv, (left, right)):
            above, below = _parted(left)
            return above, right if below is None else Operation(operator.mul, (below, right))
        case Operation(operator.mul, (left, right)):
            (first_above, first_below), (second_above, second_below) = _parted(left), _parted(right)
            below = second_below if first_below is None else first_below
            if first_below is not None and second_below is not None:
                below = Operation(operator.mul, (first_below, second_below))
            return Operation(operator.mul, (first_above, second_above)), below
    return tree, None


def _power(base: Expression, exponent: Expression, printing: _Printing) -> Box:
    above = _box(exponent, printing._replace(inline=True))[0]
    box, base_binding = _box(base, printing)
    is_short = isinstance(exponent, Number) and exponent.value in (2, 3, 4)
    if isinstance(box, Apply) and isinstance(box.name, Upright) and is_short:
        return Apply(Script(box.name, None, above), box.argument)
    # primes of a symbol stay where they are, and the power follows them
    if isinstance(box, Script) and base_binding == _ATOM:
        raised = above if box.above is None else row(box.above, above)
        return Script(box.base, box.below, raised)
    return Script(box if base_binding > _POWER else Fence(box), None, above)


def _function(function: Any, operands: tuple[Expression, ...], printing: _Printing) -> tuple[Box, int]:  # noqa: ANN401
    """Return a root, a power of e, bars, or a name with its operands in parentheses."""
    if function is np.sqrt:
        return Root(_box(operands[0], printing)[0]), _ATOM
    if function is np.exp:
        return Script(Upright("e"), None, _box(operands[0], printing._replace(inline=True))[0]), _POWER
    if function in (np.absolute, abs):
        return Fence(_box(operands[0], printing)[0], "||"), _ATOM
    # a comma between numbers with decimal commas would not be seen
    between = Sign("," if printing.language == "en" else ";", "comma")
    inside: list[Box] = []
    for operand in operands:
        inside += [*([between] if inside else []), _box(operand, printing)[0]]
    if printing.values and takes_angle(function):
        degrees = whole_degrees(operands[0], printing.values)
        if degrees is None:
            inside += [SPACE, Upright(radians(printing.language))]
        else:
            inside = [number_box(degrees, printing.language)[0], Upright("°")]
    return Apply(Upright(function_name(function, printing.language)), Fence(row(*inside))), _POWER


def enough_digits(step: Line, least: int = RESULT_DIGITS) -> int:
    """Return the significant digits of the numbers put in: those of the value, and more where it needs them.

    Put in as printed they give the printed value within two units of its last place; where no digits do, as in a
    difference of equal numbers, within two units of the last place of the largest term.
    """
    printed = as_printed(step.value, least)
    if isinstance(step, ValueLine | DelayedLine):
        return least
    reached = []
    for digits in range(least, _MOST_DIGITS + 1):
        terms = _terms(step, digits)
        if not all(map(math.isfinite, terms)):
            return least
        missed = abs(sum(terms) - printed)
        if missed <= _UNITS * last_place(printed, least):
            return digits
        reached.append((digits, missed, max(map(abs, (*terms, printed)))))
    sufficient = (digits for digits, missed, largest in reached if missed <= _UNITS * last_place(largest, least))
    return next(sufficient, _MOST_DIGITS)


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


def as_printed(value: float, digits: int) -> float:
    """Return a number as it is read when printed with some significant digits."""
    return float(f"{value:.{digits}g}")


def last_place(value: float, digits: int) -> float:
    """Return one unit of the last place of a printed number."""
    if not value or not math.isfinite(value):
        return 0.0
    return float(10.0 ** (math.floor(math.log10(abs(value))) - digits + 1))


def mathml_box(box: Box) -> str:  # noqa: C901, PLR0912 - one case per kind of box
    """Return a box as one element of MathML."""
    match box:
        case Letter(text):
            # browsers slant Latin and Greek letters of mathematics, no others
            slanted = "" if "a" <= text.lower() <= "z" or "α" <= text.lower() <= "ω" else ' class="slanted"'
            return f"<mi{slanted}>{xml_text(text)}</mi>"
        case Upright(text):
            return _upright(text)
        case Digits(text):
            return f"<mn>{xml_text(text)}</mn>"
        case Sign(text, kind):
            return _sign(text, kind)
        case Row(parts):
            return f"<mrow>{''.join(map(mathml_box, parts))}</mrow>"
        case Fraction(top, bottom):
            return f"<mfrac>{mathml_box(top)}{mathml_box(bottom)}</mfrac>"
        case Root(inside):
            return f"<msqrt>{mathml_box(inside)}</msqrt>"
        case Fence(inside, marks):
            ends = [f'<mo stretchy="true" form="{form}">{mark}</mo>' for form, mark in zip(_FORMS, marks, strict=True)]
            return f"<mrow>{ends[0]}{mathml_box(inside)}{ends[1]}</mrow>"
        case Script():
            return _script(box)
        case Apply(name, argument):
            space = '<mo>\u2061</mo><mspace width="0.17em"/>'
            return f"<mrow>{mathml_box(name)}{space}{mathml_box(argument)}</mrow>"
        case Marked(inside, "bold"):
            return f'<mrow style="font-weight: bold">{mathml_box(inside)}</mrow>'
        case Marked(inside, "line"):
            return f'<mrow style="border-bottom: 1px solid; padding-bottom: 1px">{mathml_box(inside)}</mrow>'
        case Marked(inside, mark):
            return f'<mover>{mathml_box(inside)}<mo stretchy="true">{"→" if mark == "arrow" else "¯"}</mo></mover>'


_FORMS = ("prefix", "postfix")


def _upright(text: str) -> str:
    if text == "\u2009":
        return '<mspace width="0.25em"/>'
    if text.isalpha():
        return f'<mi mathvariant="normal">{xml_text(text)}</mi>'
    return f"<mtext>{xml_text(text)}</mtext>"


def _sign(text: str, kind: str) -> str:
    if kind == "comma":
        return f'<mo separator="true" lspace="0" rspace="0.2em">{text}</mo>'
    if kind == "fence":
        return f'<mo stretchy="false">{text}</mo>'
    form = "prefix" if kind == "prefix" else "infix"
    space = "0.2em" if text == "·" else _SPACES[kind]
    return f'<mo form="{form}" lspace="{space}" rspace="{space}">{text or chr(0x2062)}</mo>'


def _script(box: Script) -> str:
    base, above = mathml_box(box.base), box.above
    first, *further = above.parts if isinstance(above, Row) else (above,)
    if isinstance(first, Upright) and not first.text.strip("′″"):
        # raised by browsers once more, primes stand far above
        base, above = f"<mrow>{base}{mathml_box(first)}</mrow>", Row(tuple(further)) if further else None
    kind = ("sub" if box.below else "") + ("sup" if above else "")
    if not kind:
        return base
    return f"<m{kind}>{base}{''.join(mathml_box(part) for part in (box.below, above) if part)}</m{kind}>"
