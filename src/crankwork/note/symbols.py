"""Symbols of the table of quantities and printed numbers as boxes."""

from __future__ import annotations

import re

from crankwork.note.layout import (
    DOT,
    MINUS,
    Apply,
    Box,
    Digits,
    Fence,
    Fraction,
    Letter,
    Row,
    Script,
    Sign,
    Upright,
    row,
)
from crankwork.quantities import Language
from crankwork.report.language import number

_FUNCTION = re.compile(r"(?P<name>sin|cos|tan|tg|ctg|arcsin|arccos|arctan|arctg|ln|lg|exp) ?(?P<rest>\S.*)")
_SUM = re.compile(r" ?([+−]) ?")
_MULTIPLE = re.compile(r"(?P<count>\d+(?:[.,]\d+)?)(?P<rest>\D.*)")
_PLAIN = re.compile(r"(?P<base>[^_\s′″₀-₉]+)(?:_(?P<below>[^\s′″₀-₉]+))?")
_MARKS = re.compile(r"[′″]+")
_LOW = re.compile(r"[₀-₉]+")
_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_POWER = re.compile(r"(?P<sign>−?)(?:(?P<mantissa>[\d.,]+)(?P<dot>·)?)?(?:10\^(?P<exponent>−?-?\d+))?")


def symbol_box(symbol: str) -> Box:
    """Return the box of a symbol, its subscript upright and its primes raised.

    Parameters
    ----------
    symbol : str
        As the tables write it: `v_п.ср`, `x_S′`, `J′_пр`, `sin 2φ`, `cos(φ + β)`.

    Examples
    --------
    >>> symbol_box("v_п.ср")
    Script(base=Letter(text='v'), below=Upright(text='п.ср'), above=None)
    """
    over, slash, under = symbol.partition("/")
    if slash and over and under:
        top, bottom = symbol_box(over), symbol_box(under)
        tall = isinstance(top, Apply) or isinstance(bottom, Apply)
        return Fraction(top, bottom) if tall else row(top, Sign("/", "slash"), bottom)
    if symbol.isdecimal():
        return Digits(symbol)
    if found := _FUNCTION.fullmatch(symbol):
        rest = found["rest"]
        inside = _sum_box(rest[1:-1]) if rest.startswith("(") and rest.endswith(")") else None
        return Apply(Upright(found["name"]), Fence(inside) if inside else symbol_box(rest))
    if found := _MULTIPLE.fullmatch(symbol):
        return row(Digits(found["count"]), symbol_box(found["rest"]))
    marks, low = "".join(_MARKS.findall(symbol)), "".join(_LOW.findall(symbol)).translate(_LOWERED)
    found = _PLAIN.fullmatch(_LOW.sub("", _MARKS.sub("", symbol)))
    if not found:
        return Upright(symbol)
    below = (found["below"] or "") + low
    if not below and not marks:
        return _base_box(found["base"])
    return Script(_base_box(found["base"]), Upright(below) if below else None, Upright(marks) if marks else None)


def _sum_box(text: str) -> Row:
    """Return the box of symbols with plus or minus between them."""
    return row(*(Sign(part) if part in ("+", "−") else symbol_box(part) for part in _SUM.split(text)))


def _base_box(base: str) -> Box:
    """Return the box of a symbol without subscript: one letter slants, and so do two small ones, a name does not."""
    if base[0] in "ΔδΣ" and len(base) == 2 and base[1].isalpha():
        return row(Upright(base[0]), Letter(base[1]))
    if len(base) == 2 and base.islower() and base.isalpha():
        return row(Letter(base[0]), Letter(base[1]))
    # a letter may carry a bar or dot as a character of its own
    letters = [character for character in base if character.isalnum()]
    return Letter(base) if len(letters) == 1 and letters[0].isalpha() and base[0] == letters[0] else Upright(base)


def number_box(value: float, language: Language, digits: int = 6) -> tuple[Box, bool]:
    """Return the box of a number in SI or any unit, and whether it is a single run of digits.

    Parameters
    ----------
    value : float
        What is printed.
    language : str
        Whose decimal mark.
    digits : int
        Significant digits.

    Examples
    --------
    >>> number_box(0.5, "ru")
    (Digits(text='0,5'), True)
    """
    return printed_number_box(number(value, language, digits=digits))


def printed_number_box(text: str) -> tuple[Box, bool]:
    """Return the box of a number that is printed already, and whether it is a single run of digits."""
    found = _POWER.fullmatch(text)
    if not found or not (found["mantissa"] or found["exponent"]):
        return Upright({"inf": "∞"}.get(text, text)), True
    if not found["exponent"]:
        mantissa = Digits(found["mantissa"])
        return (row(MINUS, mantissa), False) if found["sign"] else (mantissa, True)
    exponent = found["exponent"].replace("-", "−")
    above = row(MINUS, Digits(exponent[1:])) if exponent.startswith("−") else Digits(exponent)
    parts: list[Box] = [MINUS] if found["sign"] else []
    if found["mantissa"]:
        parts += [Digits(found["mantissa"]), DOT]
    return row(*parts, Script(Digits("10"), None, above)), False
