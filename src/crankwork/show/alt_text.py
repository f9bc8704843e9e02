"""Alternative text of drawings: the quantities of its graphs, their ranges and extremes."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from crankwork.locale import Language, translate
from crankwork.locale.numbers import number
from crankwork.show.scene import Drawing, Text, runs

# a curve of fewer points is a level or a marked point
_MIN_POINTS = 3
# number of values that describe a drawing without scales
_MAX_VALUES = 6
_SPACES = re.compile(r"\s+")


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
