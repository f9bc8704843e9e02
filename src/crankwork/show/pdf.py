"""A drawing as PDF and as PNG, on a page of exactly its size."""

from __future__ import annotations

from typing import Any

from crankwork.errors import MissingExtraError
from crankwork.locale import Refusal
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

_PAGE = """#let data = sys.inputs
#set document(title: data.title, date: none)
#set page(width: float(data.width) * 1mm, height: float(data.height) * 1mm, margin: 0mm)
#set text(lang: data.language)
#image(bytes(data.drawing), format: "svg", width: 100%, height: 100%, alt: data.title)
"""


def pdf(drawing: Drawing, theme: Theme = "print") -> bytes:
    """Return a drawing as PDF, in true millimetres, the same bytes every time."""
    return _placed(drawing, theme, "PDF", format="pdf")


def png(drawing: Drawing, theme: Theme = "print", pixels_per_inch: float = 200.0) -> bytes:
    """Return a drawing as a picture of pixels."""
    return _placed(drawing, theme, "PNG", format="png", ppi=pixels_per_inch)


def _placed(drawing: Drawing, theme: Theme, name: str, **how: Any) -> bytes:  # noqa: ANN401 - what typst takes
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names=name), "report") from None
    inputs = {
        "title": drawing.title,
        "language": drawing.language,
        "width": f"{drawing.width:g}",
        "height": f"{drawing.height:g}",
        "drawing": svg(drawing, theme).decode(),
    }
    return bytes(typst.compile(_PAGE.encode(), sys_inputs=inputs, ignore_system_fonts=True, **how))
