"""Text of the user made safe for each format, and characters that no document may hold taken out."""

from __future__ import annotations

import html
import re
import unicodedata

_BLANK = re.compile("[\t\n\v\f\r\x85\u2028\u2029]")
# controls, halves of characters, what is none, and the byte order mark, which PDF/A forbids
_NONE = re.compile(
    "[\\x00-\\x1f\\x7f-\\x9f\\ud800-\\udfff\\ufdd0-\\ufdef\\ufeff"
    + "".join(f"\\U{plane:04x}fffe\\U{plane:04x}ffff" for plane in range(17))
    + "]"
)


def plain_text(text: str) -> str:
    r"""Return text in composed letters, on one line and without control characters.

    Examples
    --------
    >>> plain_text("one\ntwo\x07")
    'one two'
    """
    return _NONE.sub("", _BLANK.sub(" ", unicodedata.normalize("NFC", text)))


def typst_string(text: str) -> str:
    """Return text as a string of Typst, in which no character but these two means anything."""
    escaped = plain_text(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def xml_text(text: str) -> str:
    """Return text for an element or attribute of XML or HTML."""
    return html.escape(plain_text(text), quote=True)
