"""A sheet as PDF, on a page of exactly its size."""

from __future__ import annotations

from crankwork.errors import MissingExtraError
from crankwork.locale import Refusal
from crankwork.note.sheets.sheet import Sheet
from crankwork.note.sheets.svg import sheet_svg

_PAGE = """#let data = sys.inputs
#set document(title: data.title, date: none)
#set page(width: float(data.width) * 1mm, height: float(data.height) * 1mm, margin: 0mm)
#set text(lang: data.language)
#image(bytes(data.drawing), format: "svg", width: 100%, height: 100%, alt: data.title)
"""


def sheet_pdf(sheet: Sheet) -> bytes:
    """Return a sheet as PDF, in true millimetres, the same bytes every time."""
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="PDF"), "report") from None
    box = sheet.paper.box
    inputs = {
        "title": sheet.title,
        "language": sheet.language,
        "width": f"{box.width:g}",
        "height": f"{box.height:g}",
        "drawing": sheet_svg(sheet).decode(),
    }
    compiled = typst.compile(_PAGE.encode(), format="pdf", sys_inputs=inputs, ignore_system_fonts=True)
    return bytes(compiled)
