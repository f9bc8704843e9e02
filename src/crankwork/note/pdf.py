"""A note as PDF, set by Typst: tagged, archivable (PDF/A-2a), the same bytes every time."""

from __future__ import annotations

import re

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.locale import Refusal
from crankwork.note.document import Note
from crankwork.note.numbering import numbering
from crankwork.note.typst_parts import typst_source

_NO_GLYPH = re.compile(r'the text `"(?P<text>.+?)"` could not be displayed', re.DOTALL)


def pdf(note: Note) -> bytes:
    """Return a note as a PDF file."""
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="PDF"), "report") from None
    source = typst_source(note, numbering(note)).encode("utf-8")
    try:
        return typst.compile(source, format="pdf", ignore_system_fonts=True, pdf_standards="a-2a")
    except typst.TypstError as error:
        missing = _NO_GLYPH.search(str(error))
        if not missing:
            raise
        raise _missing_character(missing["text"]) from None


def _missing_character(text: str) -> CrankworkError:
    # Typst writes rare characters as \u{1f600}
    shown = re.sub(r"\\u\{([0-9a-fA-F]+)\}", lambda code: chr(int(code[1], 16)), text)
    codes = " ".join(f"U+{ord(character):04X}" for character in shown)
    return CrankworkError(Refusal("glyph_missing", character=shown, codes=codes))
