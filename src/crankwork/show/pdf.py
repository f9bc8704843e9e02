"""A drawing as PDF, on a page of exactly its size."""

from __future__ import annotations

from crankwork.errors import MissingExtraError
from crankwork.locale import Refusal
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg

_PAGE = """#let data = sys.inputs
#set document(title: data.title, date: none)
#set page(width: float(data.width) * 1mm, height: float(data.height) * 1mm, margin: 0mm)
#set text(lang: data.language)
#image(bytes(data.drawing), format: "svg", width: 100%, height: 100%, alt: data.title)
"""


def pdf(drawing: Drawing) -> bytes:
    """Return a drawing as PDF, in true millimetres, the same bytes every time."""
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="PDF"), "report") from None
    inputs = {
        "title": drawing.title,
        "language": drawing.language,
        "width": f"{drawing.width:g}",
        "height": f"{drawing.height:g}",
        "drawing": svg(drawing).decode(),
    }
    compiled = typst.compile(_PAGE.encode(), format="pdf", sys_inputs=inputs, ignore_system_fonts=True)
    return bytes(compiled)
