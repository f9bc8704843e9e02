"""Pieces of WordprocessingML that text, tables and the cover of a note are made of."""

from __future__ import annotations

from crankwork.note.characters import xml_text

# twentieths of a point, for an A4 page upright and on its side
TEXT_WIDTH, WIDE_TEXT_WIDTH = 9638, 14570


def text_run(text: str, properties: str = "") -> str:
    """Return a run of text."""
    look = f"<w:rPr>{properties}</w:rPr>" if properties else ""
    return f'<w:r>{look}<w:t xml:space="preserve">{xml_text(text)}</w:t></w:r>'


def paragraph(content: str, style: str = "", properties: str = "") -> str:
    """Return a paragraph of runs."""
    named = f'<w:pStyle w:val="{style}"/>' if style else ""
    return f"<w:p><w:pPr>{named}{properties}</w:pPr>{content}</w:p>"


# the rest of its paragraph stands on the next page, as low as can be
PAGE_BREAK = paragraph(
    '<w:r><w:br w:type="page"/></w:r>', "", '<w:spacing w:before="0" w:after="0" w:line="20" w:lineRule="exact"/>'
)


def cell(width: int, content: str, place: str) -> str:
    """Return a cell of a table, its content at the top, in the middle or at the bottom."""
    size = f'<w:tcW w:w="{width}" w:type="dxa"/>'
    return f'<w:tc><w:tcPr>{size}<w:vAlign w:val="{place}"/></w:tcPr>{content}</w:tc>'
