"""Boxes as MathML, the mathematics of web pages."""

from __future__ import annotations

from crankwork.note.characters import xml_text
from crankwork.note.layout import Apply, Box, Digits, Fence, Fraction, Letter, Marked, Root, Row, Script, Sign, Upright

_SPACES = {"prefix": "0", "times": "0.12em", "slash": "0", "binary": "0.25em", "relation": "0.35em"}


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
