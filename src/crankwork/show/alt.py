"""A drawing in words, for those who cannot see it: what its graphs show, from where to where, and their extremes."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from crankwork.locale import Language, say
from crankwork.locale.numbers import number
from crankwork.show.scene import Drawing, Text, runs

# a curve of fewer points is a level or a mark
_FEWEST = 3
# values that a drawing without scales is told by
_MOST = 6
_SPACES = re.compile(r"\s+")


def described(drawing: Drawing) -> str:
    """Return what a drawing shows, in one sentence."""
    return ". ".join([drawing.title, "; ".join(_graphs(drawing) or _values(drawing))]).rstrip(". ")


def _graphs(drawing: Drawing) -> list[str]:
    """Return the extremes of all graphs, and after those of one width from where to where they go."""
    told: list[str] = []
    over = ""
    # panels have the title of the last below them
    for plot in reversed(drawing.plots):
        over = plot.titles.get("x", over)
        what = plot.titles.get("y", over if plot.x == plot.y else "")
        curves = [(x, y) for x, y in plot.curves.values() if len(x) >= _FEWEST and np.isfinite(y).any()]
        if not curves or not what or not over:
            continue
        x, y = (np.concatenate([np.ravel(one) for one in column]) for column in zip(*curves, strict=True))
        least, largest = int(np.nanargmin(y)), int(np.nanargmax(y))
        values = {"low": y[least], "at_low": x[least], "high": y[largest], "at_high": x[largest]}
        ends = {"start": np.nanmin(x), "end": np.nanmax(x)}
        width = _said("drawing.width_in_words", over, ends, drawing.language)
        if width not in told and what != over:
            told.append(width)
        told.append(_said("drawing.graph_in_words", what, values, drawing.language))
    return list(dict.fromkeys(reversed(told)))


def _said(key: str, what: str, values: Mapping[str, float], language: Language) -> str:
    shown = {name: number(float(f"{value:.4g}"), language) for name, value in values.items()}
    return say(key, language, what=_plain(what), **shown)


def _values(drawing: Drawing) -> list[str]:
    """Return the values that stand on a drawing."""
    texts = (
        _plain(one.text) for one in drawing.items if isinstance(one, Text) and (" = " in one.text or ": " in one.text)
    )
    return list(dict.fromkeys(texts))[:_MOST]


def _plain(text: str) -> str:
    """Return a text without marks."""
    return _SPACES.sub(" ", "".join(one.text for one in runs(text)))
