"""Interpolation of curves and legend numbers between machines that differ in one number."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from crankwork.analysis import Array
from crankwork.show.scene import Drawing, Plot, Polyline, Text, runs, visible_points_of_each

_NUMBER = re.compile(r"−?\d+(?:[.,]\d+)?")
# relative to the scales of a graph: an invisible distance, the tolerance of an interpolated curve, about the width of
# its line, and the tolerance if one of the machines is left out
_UNSEEN, _NEAR, _LEFT_OUT = 3e-4, 2e-3, 2e-2


class FigureInterpolation:
    """Figures of machines by the one number in which they differ. [SI]"""

    def __init__(self, values: Sequence[float], drawn: Sequence[Mapping[str, Drawing]]) -> None:
        self.values, self._drawn = np.array(values), drawn

    def drawings(self, name: str) -> list[Drawing]:
        """Return a figure of all machines; empty if one lacks it or it is a construction."""
        drawn = [figures[name] for figures in self._drawn if name in figures and not _is_constructed(figures[name])]
        return drawn if len(drawn) == len(self._drawn) else []

    def curve(self, name: str, index: int, x: Array, plots: Sequence[Plot], drawn: Sequence[Drawing]) -> dict[str, Any]:
        """Return the points of a curve in all machines; empty if polynomials do not interpolate it.

        `index`: of the graph in the figure; `plots`: this graph for machines whose number is `x`.
        """
        sampled = [drawing.plots[index] for drawing in drawn if index < len(drawing.plots)]
        sampled = [plot for plot in sampled if name in plot.curves]
        if len(sampled) < max(len(drawn), 3):
            return {}
        curves = [_at(plot, plots[0], name) for plot in (*sampled, *plots)]
        if len({curve.shape for curve in curves}) > 1:
            return {}
        finite = np.asarray(np.all(np.isfinite(curves), axis=(0, 1)))
        lines = [line for line in drawn[0].items if isinstance(line, Polyline) and line.name == name]
        if sum(len(line.points) for line in lines) != finite.sum() or any(line.closed for line in lines) or not lines:
            # bars, marks and areas, or gaps that differ between machines
            return {}
        points = np.array(curves[: len(sampled)])[..., finite]
        known = [curve[:, finite] for curve in curves[len(sampled) :]]
        low, high = np.sort([plots[0].x, plots[0].y]).T[..., None]
        size = high - low
        if np.all(np.abs(points - known[0]) < _UNSEEN * size):
            return {}
        rows = range(len(self.values))
        checks = [
            (_weights(self.values, number) @ points.swapaxes(0, 1), curve, _NEAR)
            for number, curve in zip(x, known, strict=True)
        ]
        for row in rows[1:-1]:
            rest = [other for other in rows if other != row]
            weights = _weights(self.values[rest], self.values[row])
            checks.append((weights @ points[rest].swapaxes(0, 1), points[row], _LEFT_OUT))
        for expected, actual, limit in checks:
            # ignore points outside the scales
            is_seen = np.all((actual > low - size) & (actual < high + size), axis=0)
            if np.any(np.abs(expected - actual)[:, is_seen] > limit * size):
                return {}
        kept = np.any(visible_points_of_each([(curve / size).T for curve in points], _UNSEEN), axis=0)
        decimals = [4 - math.floor(math.log10(extent)) for extent in size[:, 0]]
        across, up = (np.round(points[:, side][:, kept], decimals[side]).tolist() for side in (0, 1))
        angles = plots[0].curves[name][0] if plots[0].over else plots[0].angles.get(name, ())
        places = np.round(angles[finite][kept], 3).tolist() if len(angles) == len(finite) else []
        if len(lines) > 1 and not places:
            return {}
        same = all(position == across[0] for position in across)
        return {"between": {"x": across[:1] if same else across, "y": up, "at": places}}


def _is_constructed(drawn: Drawing) -> bool:
    """Return whether a drawing has construction lines in addition to curves."""
    return any(np.ndim(x) > 1 for plot in drawn.plots for x, _ in plot.curves.values())


def _at(plot: Plot, stated: Plot, name: str) -> Array:
    """Return the points of a curve, at the crank angles of the stated one if its own differ; shape (2, n)."""
    curve, (x, _) = np.array(plot.curves[name], dtype=float), stated.curves[name]
    degrees, wanted = (curve[0], x) if plot.over else (graph.angles.get(name, ()) for graph in (plot, stated))
    if len(x) == curve.shape[1] or len(degrees) != curve.shape[1] or len(wanted) != len(x):
        return curve
    return np.array([np.interp(wanted, degrees, row) for row in curve])


def _weights(values: Array, x: float) -> Array:
    """Return the Lagrange weights of values at x."""
    return np.array([
        np.prod([(x - other) / (value - other) for other in np.delete(values, k)]) for k, value in enumerate(values)
    ])  # fmt: skip


def number_in_legend(index: int, drawn: Sequence[Drawing]) -> tuple[int, list[str]] | None:
    """Return the legend row of an item and the number in it for each drawing; None if more than that differs."""
    row = len(_legend(drawn[0].items[:index]))
    texts = [rows[row] if row < len(rows := _legend(drawing.items)) else "" for drawing in drawn]
    numbers = [_NUMBER.findall(text) for text in texts]
    if len({_NUMBER.sub("#", text) for text in texts}) > 1 or any(len(matches) != 1 for matches in numbers):
        return None
    return row, [matches[0] for matches in numbers]


def _legend(items: Sequence[Any]) -> list[str]:
    """Return the texts of a legend."""
    pairs = pairwise(items)
    return [
        "".join(run.text for run in runs(text.text))
        for line, text in pairs
        if isinstance(line, Polyline) and line.name == "legend" and isinstance(text, Text)
    ]
