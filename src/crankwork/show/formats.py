"""Every format that a drawing can be written in."""

from __future__ import annotations

from collections.abc import Callable

from crankwork.show.dxf import dxf
from crankwork.show.film import Told, gif, mp4
from crankwork.show.moving import MovingDrawing
from crankwork.show.moving_svg import moving_svg
from crankwork.show.pdf import pdf, png
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

FORMATS: dict[str, Callable[[Drawing, Theme], bytes]] = {"svg": svg, "pdf": pdf, "png": png, "dxf": dxf}
FILMS: dict[str, Callable[[MovingDrawing, Theme, Told], bytes]] = {
    "svg": lambda film, theme, _: moving_svg(film, theme), "gif": gif, "mp4": mp4
}  # fmt: skip
# what each needs that the base installation lacks: module, and the extra that has it
MODULES: dict[str, dict[str, str]] = {
    "svg": {}, "pdf": {"typst": "report"}, "png": {"typst": "report"}, "dxf": {"ezdxf": "report"},
    "gif": {"typst": "report", "PIL": "report"}, "mp4": {"typst": "report"},
}  # fmt: skip
