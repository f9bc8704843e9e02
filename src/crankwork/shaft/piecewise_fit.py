"""Several quantities over one coordinate as polynomials on common panels, fitted once and evaluated often."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import legendre

from crankwork.kinematics.crank_grid import Array

_COUNT = 16
_NODES, _WEIGHTS = legendre.leggauss(_COUNT)
_DEGREES = np.arange(_COUNT)
_TO_SERIES = (_DEGREES + 0.5)[:, None] * legendre.legvander(_NODES, _COUNT - 1).T * _WEIGHTS
TO_POWERS = np.stack([np.pad(legendre.leg2poly(unit), (0, _COUNT - 1 - k)) for k, unit in enumerate(np.eye(_COUNT))])
_POWERS = np.arange(_COUNT)
_CONVERGED = 3e-14
_NO_BETTER = 0.1
_CUTS = 14
_MOST = 4000
# of half a panel, what rounding may put a coordinate beyond its end
_BEYOND = 1e-9


@dataclass(frozen=True)
class PiecewiseFit:
    """Quantities over a coordinate, repeated after a period where there is one."""

    edges: Array  # Where panels meet, ascending, shape (n + 1,) [unit of the coordinate]
    # Coefficients of ascending powers of the place on a panel from -1 to 1, shape (n, quantities, 16) [their units]
    powers: Array
    period: float = math.inf  # [unit of the coordinate]

    def __call__(self, coordinates: Array, low: float = -math.inf, high: float = math.inf) -> Array:
        """Return the quantities at some coordinates, shape (quantities, ...).

        `low`, `high`: ends of a stretch within the first period; beyond them its laws go on along their tangents.
        """
        shape, coordinates = np.shape(coordinates), np.ravel(coordinates)
        inside = np.clip(coordinates, low, high)
        turned = (
            0.0
            if math.isfinite(low) or math.isinf(self.period)
            else self.period * np.floor((inside - self.edges[0]) / self.period)
        )
        panel = np.searchsorted(self.edges, inside - turned, side="right") - 1
        last = np.searchsorted(self.edges, high, side="left") - 1 if math.isfinite(high) else len(self.edges) - 2
        panel = np.clip(panel, 0, last)
        start = self.edges[panel]
        place = 2 * (coordinates - turned - start) / (self.edges[panel + 1] - start) - 1
        held = np.clip(place, -1.0, 1.0)
        powers = self.powers[panel]
        places = np.ones((held.size, _COUNT))
        places[:, 1:] = held[:, None]
        np.multiply.accumulate(places, axis=1, out=places)
        values = (powers @ places[..., None])[..., 0].T
        beyond = place - held
        if np.any(np.abs(beyond) > _BEYOND):
            slopes = (powers[..., 1:] * _POWERS[1:] @ places[:, :-1, None])[..., 0].T
            values = values + slopes * beyond
        return np.asarray(values.reshape(-1, *shape))

    def with_slopes(self, *rows: tuple[int, int]) -> PiecewiseFit:
        """Return these quantities, some of them replaced by the derivatives of others: `(of, in the place of)`."""
        powers = self.powers.copy()
        for row, slope in rows:
            powers[:, slope, :-1] = self.powers[:, row, 1:] * _POWERS[1:] * (2 / np.diff(self.edges))[:, None]
            powers[:, slope, -1] = 0.0
        return replace(self, powers=powers)


def fit_piecewise(
    function: Callable[[Array], Array], breaks: Array, width: float, period: float = math.inf, *, groups: Sequence[int]
) -> PiecewiseFit:
    """Return the polynomials of some quantities, panels halved until they have converged.

    `function`: the quantities at ascending coordinates, shape (quantities, n), smooth between the breaks; `breaks`:
    ascending, over one period where there is one; `width`: of the widest panel; `alike`: a number for each quantity,
    the same where the largest of them says what counts.
    """
    parts = np.maximum(1, np.ceil(np.diff(breaks) / width - 1e-9)).astype(int)
    starts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks, breaks[1:], parts, strict=False)]
    low = np.concatenate(starts)
    high = np.append(low[1:], breaks[-1])
    kept: list[tuple[Array, Array]] = []
    series = _series(function, low, high)
    own, kinds = np.max(np.abs(series).sum(axis=2), axis=0), np.array(groups[: series.shape[1]])
    size = np.array([max(float(np.max(own[kinds == kind])), 1e-300) for kind in kinds])
    left = _tail(series, size)
    for _ in range(_CUTS):
        # what no number of panels follows is not followed by more of them
        done = left <= (_CONVERGED if low.size < _MOST else math.inf)
        kept.append((low[done], series[done]))
        low, high, before = low[~done], high[~done], left[~done]
        if not low.size:
            break
        middle = (low + high) / 2
        low, high = np.ravel(np.stack([low, middle], 1)), np.ravel(np.stack([middle, high], 1))
        series = _series(function, low, high)
        left = _tail(series, size)
        # where halving no longer helps there is nothing but rounding
        rounding = (left > _NO_BETTER * np.repeat(before, 2)) & (left < math.sqrt(_CONVERGED))
        left = np.where(rounding, 0.0, left)
    else:
        kept.append((low, series))
    begun = np.concatenate([panel_starts for panel_starts, _ in kept])
    order = np.argsort(begun)
    powers = np.concatenate([panel_series for _, panel_series in kept])[order] @ TO_POWERS
    return PiecewiseFit(np.append(begun[order], breaks[-1]), np.asarray(powers), period)


def _series(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Return Legendre coefficients on panels, shape (panels, quantities, 16)."""
    points = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _NODES
    order = np.argsort(low)
    values = function(points[order].ravel()).reshape(-1, low.size, _COUNT)
    back = np.empty_like(order)
    back[order] = np.arange(order.size)
    return np.asarray(np.moveaxis(values[:, back], 0, 1) @ _TO_SERIES.T)


def _tail(series: Array, size: Array) -> Array:
    """Return the last coefficients of panels over the sizes of the quantities, the largest of each panel."""
    return np.asarray(np.max(np.abs(series[..., -2:]).sum(axis=2) / size, axis=1, initial=0.0))
