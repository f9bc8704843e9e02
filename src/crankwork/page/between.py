"""Curves of figures between those of machines in which one number is another, and numbers in their legends."""

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
# of the scales of a graph: what nobody sees; how far a curve may be from what was calculated between, the width of its
# line, and how far where one of those it lies between is left out
_UNSEEN, _NEAR, _LEFT_OUT = 3e-4, 2e-3, 2e-2


class Between:
    """Figures of machines by the one number that differs in them. [SI]"""

    def __init__(self, values: Sequence[float], drawn: Sequence[Mapping[str, Drawing]]) -> None:
        self.values, self._drawn = np.array(values), drawn

    def drawings(self, name: str) -> list[Drawing]:
        """Return a figure of all machines, none where one of them lacks it, and of what is constructed."""
        found = [one[name] for one in self._drawn if name in one and not _is_constructed(one[name])]
        return found if len(found) == len(self._drawn) else []

    def curve(self, name: str, at: int, x: Array, plots: Sequence[Plot], drawn: Sequence[Drawing]) -> dict[str, Any]:
        """Return the points of a curve in all machines, nothing where polynomials between them are not the curve.

        `at`: which graph of the figure; `plots`: that graph of machines whose number is `x`.
        """
        others = [one.plots[at] for one in drawn if at < len(one.plots) and name in one.plots[at].curves]
        if len(others) < max(len(drawn), 3):
            return {}
        every = [_at(one, plots[0], name) for one in (*others, *plots)]
        if len({one.shape for one in every}) > 1:
            return {}
        finite = np.asarray(np.all(np.isfinite(every), axis=(0, 1)))
        lines = [one for one in drawn[0].items if isinstance(one, Polyline) and one.name == name]
        if sum(len(one.points) for one in lines) != finite.sum() or any(one.closed for one in lines) or not lines:
            # bars, marks and areas; or gaps that are no gaps elsewhere
            return {}
        points, known = np.array(every[: len(others)])[..., finite], [one[:, finite] for one in every[len(others) :]]
        low, high = np.sort([plots[0].x, plots[0].y]).T[..., None]
        size = high - low
        if np.all(np.abs(points - known[0]) < _UNSEEN * size):
            return {}
        rows = range(len(self.values))
        apart = [
            (_weights(self.values, one) @ points.swapaxes(0, 1), of, _NEAR) for one, of in zip(x, known, strict=True)
        ]
        for row in rows[1:-1]:
            rest = [one for one in rows if one != row]
            weights = _weights(self.values[rest], self.values[row])
            apart.append((weights @ points[rest].swapaxes(0, 1), points[row], _LEFT_OUT))
        for one, of, limit in apart:
            # what lies beyond the scales is not seen
            is_seen = np.all((of > low - size) & (of < high + size), axis=0)
            if np.any(np.abs(one - of)[:, is_seen] > limit * size):
                return {}
        kept = np.any(visible_points_of_each([(one / size).T for one in points], _UNSEEN), axis=0)
        decimals = [4 - math.floor(math.log10(one)) for one in size[:, 0]]
        across, up = (np.round(points[:, side][:, kept], decimals[side]).tolist() for side in (0, 1))
        angles = plots[0].curves[name][0] if plots[0].over else plots[0].angles.get(name, ())
        places = np.round(angles[finite][kept], 3).tolist() if len(angles) == len(finite) else []
        if len(lines) > 1 and not places:
            return {}
        same = all(one == across[0] for one in across)
        return {"between": {"x": across[:1] if same else across, "y": up, "at": places}}


def _is_constructed(drawn: Drawing) -> bool:
    """Return whether lines are drawn that are no curves, and stand upon them."""
    return any(np.ndim(x) > 1 for plot in drawn.plots for x, _ in plot.curves.values())


def _at(plot: Plot, stated: Plot, name: str) -> Array:
    """Return the points of a curve, at the crank angles of the stated one where it has others; shape (2, n)."""
    found, (x, _) = np.array(plot.curves[name], dtype=float), stated.curves[name]
    degrees, wanted = (found[0], x) if plot.over else (one.angles.get(name, ()) for one in (plot, stated))
    if len(x) == found.shape[1] or len(degrees) != found.shape[1] or len(wanted) != len(x):
        return found
    return np.array([np.interp(wanted, degrees, one) for one in found])


def _weights(values: Array, at: float) -> Array:
    """Return what each of some values weighs in a polynomial through them."""
    return np.array([
        np.prod([(at - other) / (one - other) for other in np.delete(values, k)]) for k, one in enumerate(values)
    ])  # fmt: skip


def number_in_legend(at: int, drawn: Sequence[Drawing]) -> tuple[int, list[str]] | None:
    """Return which row of a legend an item is, and the one number in it of each drawing; None where more differs."""
    row = len(_legend(drawn[0].items[:at]))
    texts = [rows[row] if row < len(rows := _legend(one.items)) else "" for one in drawn]
    numbers = [_NUMBER.findall(one) for one in texts]
    if len({_NUMBER.sub("#", one) for one in texts}) > 1 or any(len(one) != 1 for one in numbers):
        return None
    return row, [one[0] for one in numbers]


def _legend(items: Sequence[Any]) -> list[str]:
    """Return the texts that stand behind the lines of a legend."""
    pairs = pairwise(items)
    return [
        "".join(run.text for run in runs(text.text))
        for line, text in pairs
        if isinstance(line, Polyline) and line.name == "legend" and isinstance(text, Text)
    ]
