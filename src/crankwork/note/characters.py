"""Text of the user made safe for each format, and characters that no document may hold taken out."""

from __future__ import annotations

import html
import unicodedata

_BLANKS = "\t\n\v\f\r\x85\u2028\u2029"


def plain_text(text: str) -> str:
    r"""Return text in composed letters, on one line and without control characters.

    Examples
    --------
    >>> plain_text("one\ntwo\x07")
    'one two'
    """
    if text.isascii() and text.isprintable():
        return text
    composed = unicodedata.normalize("NFC", text)
    spaced = "".join(" " if character in _BLANKS else character for character in composed)
    return "".join(character for character in spaced if _is_allowed(character))


def _is_allowed(character: str) -> bool:
    code = ord(character)
    if unicodedata.category(character) in ("Cc", "Cs"):
        return False
    # the byte order mark is no character of a text, and PDF/A forbids it
    return code != 0xFEFF and code & 0xFFFE != 0xFFFE and not 0xFDD0 <= code <= 0xFDEF


def typst_string(text: str) -> str:
    """Return text as a string of Typst, in which no character but these two means anything."""
    escaped = plain_text(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def xml_text(text: str) -> str:
    """Return text for an element or attribute of XML or HTML."""
    return html.escape(plain_text(text), quote=True)
