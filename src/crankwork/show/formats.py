"""Every format that a drawing can be written in."""

from __future__ import annotations

from collections.abc import Callable

from crankwork.show.dxf import dxf
from crankwork.show.pdf import pdf, png
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

FORMATS: dict[str, Callable[[Drawing, Theme], bytes]] = {"svg": svg, "pdf": pdf, "png": png, "dxf": dxf}
# what each needs that the base installation lacks: module, and the extra that has it
MODULES: dict[str, dict[str, str]] = {
    "svg": {}, "pdf": {"typst": "report"}, "png": {"typst": "report"}, "dxf": {"ezdxf": "report"},
}  # fmt: skip
