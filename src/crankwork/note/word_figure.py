"""A figure of a note in Word: its picture, which newer programs draw by its lines, and its caption."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.note.characters import xml_text
from crankwork.note.document import Figure
from crankwork.note.word_xml import paragraph, text_run

# as wide as the text at most [mm]
_WIDEST = 169.6
# English metric units
_EMU = 36000
_DRAWING = "http://schemas.openxmlformats.org/drawingml/2006"


def figure_xml(block: Figure, words: str, k: int, picture: str, lines: str) -> Iterator[str]:
    """Yield the k-th figure and its caption; `picture` and `lines` are the names of its parts."""
    drawing = block.drawing
    width = min(drawing.width, _WIDEST)
    size = f'cx="{round(width * _EMU)}" cy="{round(drawing.height * width / drawing.width * _EMU)}"'
    about = f'id="{k}" name="drawing{k}" descr="{xml_text(block.alt)}"'
    blip = (
        f'<a:blip r:embed="{picture}"><a:extLst><a:ext uri="{{96DAC541-7B7A-43D3-8B79-37D633B846F1}}">'
        '<asvg:svgBlip xmlns:asvg="http://schemas.microsoft.com/office/drawing/2016/SVG/main" '
        f'r:embed="{lines}"/></a:ext></a:extLst></a:blip>'
    )
    shape = (
        f"<pic:pic><pic:nvPicPr><pic:cNvPr {about}/><pic:cNvPicPr/></pic:nvPicPr><pic:blipFill>{blip}"
        f'<a:stretch><a:fillRect/></a:stretch></pic:blipFill><pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext {size}/>'
        '</a:xfrm><a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr></pic:pic>'
    )
    inline = (
        f'<w:r><w:drawing><wp:inline xmlns:wp="{_DRAWING}/wordprocessingDrawing" xmlns:a="{_DRAWING}/main" '
        f'xmlns:pic="{_DRAWING}/picture" distT="0" distB="0" distL="0" distR="0"><wp:extent {size}/>'
        f'<wp:docPr {about}/><a:graphic><a:graphicData uri="{_DRAWING}/picture">{shape}</a:graphicData></a:graphic>'
        "</wp:inline></w:drawing></w:r>"
    )
    yield paragraph(inline, "Drawing")
    yield paragraph(text_run(words), "Caption", '<w:jc w:val="center"/>')
