"""Styles and pages of a Word note: Times New Roman, black headings, A4."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from crankwork.note.captions import LANGUAGE_TAGS
from crankwork.quantities import Language

if TYPE_CHECKING:
    from docx.document import Document
    from docx.section import Section

_FONT = "Times New Roman"
_WORD = "http://schemas.openxmlformats.org/wordprocessingml/2006/main"
_CENTRE, _LEFT, _BOTH = "center", "left", "both"
FOOTER = (
    '<w:p><w:pPr><w:jc w:val="center"/></w:pPr><w:r><w:fldChar w:fldCharType="begin"/></w:r>'
    '<w:r><w:instrText xml:space="preserve"> PAGE </w:instrText></w:r><w:r><w:fldChar w:fldCharType="end"/></w:r></w:p>'
)

# identifier: name, size in half points, bold, alignment, space before and after in twentieths of a point, further
_STYLES = {
    "Normal": ("Normal", 24, False, _LEFT, 0, 80, ""),
    "BodyText": ("Body Text", 24, False, _BOTH, 0, 120, ""),
    "Heading1": ("heading 1", 30, True, _LEFT, 360, 160, "<w:keepNext/><w:keepLines/>"),
    "Heading2": ("heading 2", 26, True, _LEFT, 280, 120, "<w:keepNext/><w:keepLines/>"),
    "Heading3": ("heading 3", 24, True, _LEFT, 240, 100, "<w:keepNext/><w:keepLines/>"),
    "Title": ("Title", 40, True, _CENTRE, 240, 240, ""),
    "Subtitle": ("Subtitle", 28, False, _CENTRE, 0, 240, ""),
    "TitleLine": ("Title Line", 24, False, _CENTRE, 0, 80, ""),
    "Caption": ("caption", 24, False, _CENTRE, 120, 120, ""),
    "Drawing": ("Drawing", 24, False, _CENTRE, 160, 0, "<w:keepNext/>"),
    "TableText": ("Table Text", 20, False, _LEFT, 0, 0, ""),
    "ContentsTitle": ("Contents Title", 30, True, _LEFT, 240, 160, "<w:keepNext/>"),
    "Item": ("Item", 24, False, _BOTH, 0, 60, ""),
    "TOC1": ("toc 1", 24, False, _LEFT, 0, 60, ""),
    "TOC2": ("toc 2", 24, False, _LEFT, 0, 60, ""),
}
_TABS = '<w:tabs><w:tab w:val="right" w:leader="dot" w:pos="9638"/></w:tabs>'
_PLACES = {
    "Item": ("", '<w:ind w:left="425" w:hanging="425"/>'),
    "TOC1": (_TABS, ""),
    "TOC2": (_TABS, '<w:ind w:left="240"/>'),
}
_LEVELS = {"Heading1": 0, "Heading2": 1, "Heading3": 2}
_TIGHT = ("TableText", "TitleLine")


def set_styles(document: Document, language: Language) -> None:
    """Give a document the styles of a note and its language."""
    from docx.oxml import parse_xml  # noqa: PLC0415 - an optional part

    styles: Any = document.styles.element
    tag = LANGUAGE_TAGS[language]
    for name in _STYLES:
        for old in styles.xpath(f'w:style[@w:styleId="{name}"]'):
            styles.remove(old)
        styles.append(parse_xml(_style(name)))
    defaults = styles.xpath("w:docDefaults/w:rPrDefault/w:rPr")[0]
    for old in defaults.xpath("w:lang|w:rFonts"):
        defaults.remove(old)
    defaults.insert(0, parse_xml(f'<w:rFonts xmlns:w="{_WORD}" {_fonts()}/>'))
    defaults.append(parse_xml(f'<w:lang xmlns:w="{_WORD}" w:val="{tag}" w:eastAsia="{tag}" w:bidi="ar-SA"/>'))


def _fonts() -> str:
    return " ".join(f'w:{kind}="{_FONT}"' for kind in ("ascii", "hAnsi", "eastAsia", "cs"))


def _style(key: str) -> str:
    name, size, bold, align, before, after, keep = _STYLES[key]
    tabs, indent = _PLACES.get(key, ("", ""))
    level = f'<w:outlineLvl w:val="{_LEVELS[key]}"/>' if key in _LEVELS else ""
    line = 240 if key in _TIGHT else 276
    default = ' w:default="1"' if key == "Normal" else ""
    based = "" if key == "Normal" else '<w:basedOn w:val="Normal"/>'
    following = '<w:next w:val="BodyText"/>' if key in _LEVELS else ""
    return (
        f'<w:style xmlns:w="{_WORD}" w:type="paragraph"{default} w:styleId="{key}"><w:name w:val="{name}"/>{based}'
        f"{following}<w:qFormat/><w:pPr>{keep}{tabs}"
        f'<w:spacing w:before="{before}" w:after="{after}" w:line="{line}" w:lineRule="auto"/>'
        f'{indent}<w:jc w:val="{align}"/>{level}</w:pPr>'
        f'<w:rPr><w:rFonts {_fonts()}/>{"<w:b/>" if bold else ""}<w:color w:val="000000"/>'
        f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/></w:rPr></w:style>'
    )


def set_pages(section: Section, *, wide: bool) -> None:
    """Make the pages of a section A4, upright or on their side, with margins of 25, 15 and 20 mm."""
    from docx.enum.section import WD_ORIENT  # noqa: PLC0415 - an optional part
    from docx.shared import Mm  # noqa: PLC0415

    section.orientation = WD_ORIENT.LANDSCAPE if wide else WD_ORIENT.PORTRAIT
    section.page_width, section.page_height = (Mm(297), Mm(210)) if wide else (Mm(210), Mm(297))
    section.left_margin, section.right_margin = (Mm(20), Mm(20)) if wide else (Mm(25), Mm(15))
    section.top_margin, section.bottom_margin = (Mm(25), Mm(15)) if wide else (Mm(20), Mm(20))
