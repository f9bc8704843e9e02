"""All formats that a drawing can be written in."""

from __future__ import annotations

from collections.abc import Callable

from crankwork.show.dxf import dxf
from crankwork.show.film import Progress, gif, mp4
from crankwork.show.moving import Animation
from crankwork.show.moving_svg import moving_svg
from crankwork.show.pdf import pdf, png
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

FORMATS: dict[str, Callable[[Drawing, Theme], bytes]] = {"svg": svg, "pdf": pdf, "png": png, "dxf": dxf}
FILMS: dict[str, Callable[[Animation, Theme, Progress], bytes]] = {
    "svg": lambda film, theme, _: moving_svg(film, theme), "gif": gif, "mp4": mp4
}  # fmt: skip
# optional modules that each format needs, and the extra that has them
MODULES: dict[str, dict[str, str]] = {
    "svg": {}, "pdf": {"typst": "report"}, "png": {"typst": "report"}, "dxf": {"ezdxf": "report"},
    "gif": {"typst": "report", "PIL": "report"}, "mp4": {"typst": "report"},
}  # fmt: skip
