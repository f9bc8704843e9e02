"""A drawing as PDF and as PNG, on a page of exactly its size."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from crankwork.errors import MissingExtraError
from crankwork.locale import ErrorMessage
from crankwork.show.alt_text import alt_text
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

_PAGE = """#let data = sys.inputs
#set document(title: data.title, date: none)
#set page(width: float(data.width) * 1mm, height: float(data.height) * 1mm, margin: 0mm)
#set text(lang: data.language)
#for at in range(int(data.count)) {
  page(image(bytes(data.at(str(at))), format: "svg", width: 100%, height: 100%, alt: data.described))
}
"""


def pdf(drawing: Drawing, theme: Theme = "print") -> bytes:
    """Return a drawing as PDF, in true millimetres, the same bytes every time."""
    return _placed([drawing], theme, "PDF", format="pdf")[0]


def png(drawing: Drawing, theme: Theme = "print", pixels_per_inch: float = 200.0) -> bytes:
    """Return a drawing as a picture of pixels."""
    return pngs([drawing], theme, pixels_per_inch)[0]


def pngs(drawings: Sequence[Drawing], theme: Theme, pixels_per_inch: float, drawn: Sequence[bytes] = ()) -> list[bytes]:
    """Return drawings of one size as pictures of pixels, faster than one by one; `drawn`: their SVG, if at hand."""
    return _placed(drawings, theme, "PNG", drawn, format="png", ppi=pixels_per_inch)


def _placed(
    drawings: Sequence[Drawing],
    theme: Theme,
    name: str,
    drawn: Sequence[bytes] = (),
    **options: Any,  # noqa: ANN401 - what typst takes
) -> list[bytes]:
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names=name), "report") from None
    first = drawings[0]
    inputs = {
        "title": first.title,
        "described": alt_text(first),
        "language": first.language,
        "width": f"{first.width:g}",
        "height": f"{first.height:g}",
        "count": str(len(drawings)),
    }
    pictures = drawn or [svg(drawing, theme) for drawing in drawings]
    inputs |= {str(index): picture.decode() for index, picture in enumerate(pictures)}
    pages = typst.compile(_PAGE.encode(), sys_inputs=inputs, ignore_system_fonts=True, **options)
    return [bytes(page) for page in pages] if isinstance(pages, list) else [bytes(pages)]
