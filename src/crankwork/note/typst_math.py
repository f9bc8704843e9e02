"""Boxes as Typst mathematics."""

from __future__ import annotations

from crankwork.note.characters import typst_string
from crankwork.note.layout import Apply, Box, Digits, Fence, Fraction, Letter, Root, Row, Script, Sign, Upright

_SIGNS = {"·": "dot.op", "": "thin", "/": "slash", "(": "paren.l", ")": "paren.r", ",": "comma thin", ";": '";" thin'}
_PRIMES = {"′": "prime", "″": "prime.double", "‴": "prime.triple"}


def typst_box(box: Box) -> str:  # noqa: C901 - one case per kind of box
    """Return a box as Typst mathematics."""
    match box:
        case Letter(text):
            return _letter(text)
        case Upright(text):
            return _upright(text)
        case Digits(text):
            # a number of Typst stands closer to its sign than a string does, and has no decimal comma
            return text.replace(",", '","')
        case Sign(text, kind):
            return "minus" if text == "−" and kind == "prefix" else _SIGNS.get(text, text)
        case Row(parts):
            return " ".join(map(typst_box, parts))
        case Fraction(top, bottom):
            return f"frac({typst_box(top)}, {typst_box(bottom)})"
        case Root(inside):
            return f"sqrt({typst_box(inside)})"
        case Fence(inside, marks):
            return f"lr({marks[0]} {typst_box(inside)} {marks[1]})"
        case Script(base, below, above):
            feet = f", b: {typst_box(below)}" if below else ""
            return f"attach({_base(base)}{feet}{f', t: {typst_box(above)}' if above else ''})"
        case Apply(name, argument):
            return f"{_name(name)} {typst_box(argument)}"


def _letter(text: str) -> str:
    """Return a variable; the fonts of mathematics have slanted Latin and Greek letters, the others come from text."""
    if len(text) == 1 and (text.isascii() or "α" <= text <= "ω"):
        return text
    if len(text) == 1 and "Α" <= text <= "Ω":
        return f"italic({text})"
    return f'#text(font: "Libertinus Serif", style: "italic", {typst_string(text)})'


def _upright(text: str) -> str:
    if text == "\u2009":
        return "med"
    if len(text) == 1 and "Α" <= text <= "Ω":
        return text
    if text in ("°", "%"):
        return text
    # a string keeps its distance
    if text == "d":
        return "upright(d)"
    return _PRIMES.get(text) or typst_string(text)


def _base(base: Box) -> str:
    return f"op({typst_string(base.text)})" if isinstance(base, Upright) and len(base.text) > 1 else typst_box(base)


def _name(name: Box) -> str:
    """Return the name of a function, which keeps its distance from what follows."""
    if isinstance(name, Script):
        return typst_box(name)
    return f"op({typst_box(name)})"
