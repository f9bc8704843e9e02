"""Themes of drawings, in print, in colour, or on dark ground, and drawings described in words."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Literal, NamedTuple, get_args

import numpy as np

from crankwork.locale import Language, translate
from crankwork.locale.numbers import number
from crankwork.show.scene import Drawing, Item, Polyline, Text, pen_of, runs

Theme = Literal["print", "colour", "dark", "black"]
# those that a user may ask for; sheets are black
THEMES: tuple[Theme, ...] = get_args(Theme)[:-1]
# a curve of fewer points is a level or a marked point
_MIN_POINTS = 3
# number of values that describe a drawing without scales
_MAX_VALUES = 6
_SPACES = re.compile(r"\s+")


class Palette(NamedTuple):
    """Colours of ground and ink, and of curves by their dashes; other lines have the colour of ink."""

    ground: str
    ink: str
    curves: dict[str, str]


# colours that people with red-green blindness can distinguish (Okabe and Ito); curves keep their dashes
_PALETTES: dict[Theme, Palette] = {
    # black, one accent and grey
    "print": Palette(
        "#ffffff", "#000000", {"solid": "#000000", "dashed": "#0072b2", "dash-dot": "#737373", "dotted": "#000000"}
    ),
    "black": Palette("#ffffff", "#000000", {}),
    "colour": Palette(
        "#ffffff", "#000000", {"solid": "#0072b2", "dashed": "#d55e00", "dash-dot": "#009e73", "dotted": "#a6548a"}
    ),
    "dark": Palette(
        "#14171c", "#e8e8e8", {"solid": "#56b4e9", "dashed": "#e69f00", "dash-dot": "#2fc79a", "dotted": "#dd9fc4"}
    ),
}
_DASHED = {0: "solid", 2: "dashed", 4: "dash-dot"}
KINDS = (*_DASHED.values(), "dotted")
# colours of filled parts
_FILLS: dict[str, dict[Theme, str]] = {
    "gas": {"colour": "#0072b2", "dark": "#56b4e9"},
    "flash": {"colour": "#e69f00", "dark": "#f0e442"},
    "force": {"colour": "#d55e00", "dark": "#e69f00"},
}
# a dash shorter than this is a dot, in widths of its line
_DOT = 1.5
_BLACK = "#000000"


def palette_of(theme: Theme) -> Palette:
    """Return ground and ink of a theme."""
    return _PALETTES[theme]


def themed(drawing: Drawing, theme: Theme) -> Drawing:
    """Return a drawing in the colours of a theme: curves by their dashes, other items between ground and ink."""
    return drawing._replace(items=tuple(themed_item(item, theme) for item in drawing.items))


def fill_colours(theme: Theme) -> dict[str, str]:
    """Return the fill colours of a theme by the name of the filled part."""
    return {name: colours.get(theme, _BLACK) for name, colours in _FILLS.items()}


def curve_kind(item: Polyline) -> str:
    """Return the dashes of a curve, which define its colour; empty for items without such a colour."""
    pen = pen_of(item.kind)
    if not item.name or item.fill is not None or not pen.width or pen.colour not in ("", _BLACK):
        return ""
    is_dotted = len(pen.dashes) == 2 and pen.dashes[0] < _DOT * pen.width
    return "dotted" if is_dotted else _DASHED.get(len(pen.dashes), "")


def themed_item(item: Item, theme: Theme) -> Item:
    """Return an item in the colours of a theme."""
    if not isinstance(item, Polyline):
        return item
    pen = pen_of(item.kind)
    if item.fill is not None:
        filled = _FILLS.get(item.name) if pen.colour in ("", _BLACK) else None
        return item if filled is None else item._replace(kind=pen._replace(colour=filled.get(theme, "")))
    kind = curve_kind(item)
    return item._replace(kind=pen._replace(colour=_PALETTES[theme].curves.get(kind, ""))) if kind else item


def alt_text(drawing: Drawing) -> str:
    """Describe a drawing in one sentence."""
    return ". ".join([drawing.title, "; ".join(_graphs(drawing) or _values(drawing))]).rstrip(". ")


def _graphs(drawing: Drawing) -> list[str]:
    """Return sentences about the ranges of the graphs and, for each, about its extremes."""
    sentences: list[str] = []
    over = ""
    # panels share the title below the last one
    for plot in reversed(drawing.plots):
        over = plot.titles.get("x", over)
        subject = plot.titles.get("y", over if plot.x == plot.y else "")
        curves = [(x, y) for x, y in plot.curves.values() if len(x) >= _MIN_POINTS and np.isfinite(y).any()]
        if not curves or not subject or not over:
            continue
        x, y = (np.concatenate([np.ravel(values) for values in column]) for column in zip(*curves, strict=True))
        least, largest = int(np.nanargmin(y)), int(np.nanargmax(y))
        values = {"low": y[least], "at_low": x[least], "high": y[largest], "at_high": x[largest]}
        ends = {"start": np.nanmin(x), "end": np.nanmax(x)}
        width = _sentence("drawing.width_in_words", over, ends, drawing.language)
        if width not in sentences and subject != over:
            sentences.append(width)
        sentences.append(_sentence("drawing.graph_in_words", subject, values, drawing.language))
    return list(dict.fromkeys(reversed(sentences)))


def _sentence(key: str, subject: str, values: Mapping[str, float], language: Language) -> str:
    shown = {name: number(float(f"{value:.4g}"), language) for name, value in values.items()}
    return translate(key, language, what=_plain(subject), **shown)


def _values(drawing: Drawing) -> list[str]:
    """Return the values written on a drawing."""
    texts = [item.text for item in drawing.items if isinstance(item, Text)]
    return list(dict.fromkeys(_plain(text) for text in texts if " = " in text or ": " in text))[:_MAX_VALUES]


def _plain(text: str) -> str:
    """Return a text without marks."""
    return _SPACES.sub(" ", "".join(run.text for run in runs(text)))
