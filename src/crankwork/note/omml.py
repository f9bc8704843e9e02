"""Boxes as the mathematics of Word: equations that can be edited there."""

from __future__ import annotations

from crankwork.note.characters import xml_text
from crankwork.note.layout import Apply, Box, Digits, Fence, Fraction, Letter, Root, Row, Script, Sign, Upright

_FONT = '<w:rPr><w:rFonts w:ascii="Cambria Math" w:hAnsi="Cambria Math" w:cs="Cambria Math"/></w:rPr>'
# normal text keeps a decimal comma tight, where mathematics would put a space after it
# a parenthesis whose partner stands on another line is literal, or a reader of formulas looks for the partner
_STYLES = {"letter": '<m:sty m:val="i"/>', "upright": '<m:sty m:val="p"/>', "text": "<m:nor/>",
           "literal": '<m:lit/><m:sty m:val="p"/>'}  # fmt: skip


def omml_box(box: Box) -> str:  # noqa: C901 - one case per kind of box
    """Return a box as elements of Word's mathematics, prefixes `m` and `w` undeclared."""
    match box:
        case Letter(text):
            return _run(text, "letter")
        case Upright(text):
            return _run(text, "text")
        case Digits(text):
            return _run(text, "text")
        case Sign(text, "fence"):
            return _run(text, "literal")
        case Sign(text, _):
            return _run(text or "\u2009", "upright")
        case Row(parts):
            return "".join(map(omml_box, parts))
        case Fraction(top, bottom):
            return f"<m:f><m:num>{omml_box(top)}</m:num><m:den>{omml_box(bottom)}</m:den></m:f>"
        case Root(inside):
            hidden = '<m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/>'
            return f"<m:rad>{hidden}<m:e>{omml_box(inside)}</m:e></m:rad>"
        case Fence(inside, marks):
            ends = f'<m:dPr><m:begChr m:val="{marks[0]}"/><m:endChr m:val="{marks[1]}"/></m:dPr>'
            return f"<m:d>{ends}<m:e>{omml_box(inside)}</m:e></m:d>"
        case Script():
            return _script(box)
        case Apply(name, argument):
            return f"<m:func><m:fName>{omml_box(name)}</m:fName><m:e>{omml_box(argument)}</m:e></m:func>"


def _run(text: str, style: str) -> str:
    properties = f"<m:rPr>{_STYLES[style]}</m:rPr>{_FONT}"
    return f'<m:r>{properties}<m:t xml:space="preserve">{xml_text(text)}</m:t></m:r>'


def _script(box: Script) -> str:
    """Return a base with what stands at its foot and head; the name of the element says which of them there are."""
    kind = ("Sub" if box.below else "") + ("Sup" if box.above else "")
    below = f"<m:sub>{omml_box(box.below)}</m:sub>" if box.below else ""
    above = f"<m:sup>{omml_box(box.above)}</m:sup>" if box.above else ""
    return f"<m:s{kind}><m:e>{omml_box(box.base)}</m:e>{below}{above}</m:s{kind}>"
