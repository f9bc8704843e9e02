"""Symbols of the table of quantities and printed numbers as boxes."""

from __future__ import annotations

import re

from crankwork.locale import texts
from crankwork.locale.numbers import number
from crankwork.note.layout import (
    DOT,
    EQUALS,
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
from crankwork.quantities.quantity import own_name
from crankwork.report.display import link_label

_FUNCTION = re.compile(r"(?P<name>sin|cos|tan|tg|ctg|arcsin|arccos|arctan|arctg|ln|lg|exp) ?(?P<rest>\S.*)")
# the parts of a relative acceleration, and of a force along and across a link
_RAISED = re.compile(r"(?P<base>[aRN]_.+)\^(?P<above>[ntτkr])")
_SUM = re.compile(r" ?([+−=]) ?")
_MULTIPLE = re.compile(r"(?P<count>\d+(?:[.,]\d+)?)(?P<rest>\D.*)")
_SUBSTANCE = re.compile(r"(?P<base>\w)_(?P<below>[CHNO][CHNO₀-₉]*)")
_PLAIN = re.compile(r"(?P<base>[^_\s′″²₀-₉]+)(?:_(?P<below>[^\s′″²₀-₉]+))?")
# the subscript that stands for any link
_OF_EACH = re.compile("_i(?![a-z])")
_MARKS = re.compile(r"[′″²]+")
_LOW = re.compile(r"([₀-₉]+)")
_LOWERED = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
# what of a link or point: its guide, the arm from a joint, the load on it
_PARTS = frozenset((
    "guide", "shaking", "weight", "arm", "arms", "place", "carried", "load", "both", "normal",
    "start", "free", "preload", "piece", "end", "from", "damper",
))  # fmt: skip
# what belongs to parts of a balance, to directions or to numbered stages, never to what a file names
_OF_PARTS = ("heat_share", "stage_pressure_ratio", "stage_flow", "stage_power", "free_force", "free_moment",
             "rotor_unbalance", "rotor_unbalance_x", "rotor_unbalance_y", "rotor_couple", "rotor_couple_x",
             "rotor_couple_y", "plane_position")  # fmt: skip
# what belongs to masses in planes of a shaft
OF_MASSES = (
    "plane_",
    "sector_",
    "reciprocating_moment",
    "hammer_blow",
    "lifting_",
    "rail_load",
    "rotor_",
    "secondary_",
)
_WITHIN = str.maketrans({".": ",", "/": ":", "′": "'", "″": "'"})
_NUMBER = re.compile(r"(?P<sign>−?)(?:(?P<mantissa>[\d.,]+)(?:·|$))?(?:10(?P<exponent>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+))?")
_LEVEL = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")


def symbol_box(symbol: str) -> Box:
    """Return the box of a symbol, its subscript upright and its primes raised.

    Examples
    --------
    >>> symbol_box("v_п.ср")
    Script(base=Letter(text='v'), below=Upright(text='п.ср'), above=None)
    """
    if match := _RAISED.fullmatch(symbol):
        box = symbol_box(match["base"])
        return Script(
            box.base if isinstance(box, Script) else box, getattr(box, "below", None), Upright(match["above"])
        )
    over, slash, under = symbol.partition("/")
    if slash and over and under:
        top, bottom = symbol_box(over), symbol_box(under)
        tall = isinstance(top, Apply) or isinstance(bottom, Apply)
        return Fraction(top, bottom) if tall else row(top, Sign("/", "slash"), bottom)
    if " = " in symbol:
        return _sum_box(symbol)
    if symbol.isdecimal():
        return Digits(symbol)
    if match := _FUNCTION.fullmatch(symbol):
        rest = match["rest"]
        inside = _sum_box(rest[1:-1]) if rest.startswith("(") and rest.endswith(")") else None
        return Apply(Upright(match["name"]), Fence(inside) if inside else symbol_box(rest))
    if match := _MULTIPLE.fullmatch(symbol):
        return row(Digits(match["count"]), symbol_box(match["rest"]))
    if (match := _SUBSTANCE.fullmatch(symbol)) and _LOW.search(symbol):
        return Script(Letter(match["base"]), _substance_box(match["below"]))
    marks, low = "".join(_MARKS.findall(symbol)), "".join(_LOW.findall(symbol)).translate(_LOWERED)
    match = _PLAIN.fullmatch(_LOW.sub("", _MARKS.sub("", symbol)))
    if not match:
        return Upright(symbol)
    below = (match["below"] or "") + low
    if not below and not marks:
        return _base_box(match["base"])
    return Script(
        _base_box(match["base"]), Upright(below) if below else None, Upright(marks.replace("²", "2")) if marks else None
    )


def _substance_box(text: str) -> Row:
    """Return the box of a chemical formula: the numbers in it stay where they are."""
    boxes: list[Box] = []
    for part in filter(None, _LOW.split(text)):
        number = _LOW.fullmatch(part)
        boxes.append(Script(boxes.pop(), Upright(part.translate(_LOWERED))) if number else Upright(part))
    return row(*boxes)


def _sum_box(text: str) -> Row:
    """Return the box of symbols with plus, minus or a sign of equality between them."""
    signs = {"+": Sign("+"), "−": Sign("−"), "=": EQUALS}
    return row(*(signs.get(part) or symbol_box(part) for part in _SUM.split(text)))


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

    Examples
    --------
    >>> number_box(0.5, "ru")
    (Digits(text='0,5'), True)
    """
    text = number(value, language, digits=digits)
    match = _NUMBER.fullmatch(text)
    if not match:
        return Upright({"inf": "∞"}.get(text, text)), True
    parts: list[Box] = [MINUS] if match["sign"] else []
    mantissa, exponent = match["mantissa"], match["exponent"]
    if mantissa:
        parts.append(Digits(mantissa))
    if not exponent:
        return (row(*parts), False) if match["sign"] else (parts[0], True)
    above = Digits(exponent.lstrip("⁻").translate(_LEVEL))
    ten = Script(Digits("10"), None, row(MINUS, above) if exponent.startswith("⁻") else above)
    return row(*parts, *((DOT,) if mantissa else ()), ten), False


def subscript(name: str) -> str:
    """Return the name of a link or point for the subscript of a symbol, without what would end it or divide it.

    Examples
    --------
    >>> subscript("upper rod.x")
    'upper-rod,x'
    >>> subscript("P_coupler")
    'P_coupler'
    """
    return "-".join(name.translate(_WITHIN).split())


def owned_symbol(kind: str, shown: str, name: str, language: Language) -> str:
    """Return the symbol of a quantity with the name of the link or point that it belongs to in the subscript.

    Examples
    --------
    >>> owned_symbol("joint_force_x", "R_x", "A", "en"), owned_symbol("point_x", "x", "upper rod.guide", "en")
    ('R_x,A', 'x_upper-rod,g')
    """
    shown_name = own_name(kind, name)
    # of the centre of mass of a link
    owner, *parts = shown_name.split(" ", 1) if shown_name.startswith("S ") else shown_name.split(".")
    marks = texts("marks", language)
    crank = {"crank": link_label("crank", language)}
    owner = marks.get(owner, owner) if kind in _OF_PARTS else owner
    owner = link_label(owner, language) if kind.startswith(OF_MASSES) else owner
    names = [crank.get(owner, owner), *(marks[part] if part in _PARTS else crank.get(part, part) for part in parts)]
    name = subscript(".".join(names))
    if _OF_EACH.search(shown) and not kind.startswith("indicated"):
        return _OF_EACH.sub(f"_{name}", shown, count=1)
    return f"{shown}{',' if '_' in shown else '_'}{name}"
