"""A field of a machine file that differs between designs, with its distribution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField
from crankwork.kinematics.crank_grid import Array

Law = Literal["list", "even", "ratios", "uniform", "normal", "words"]
# range of a normal distribution that a calculation is compiled for, in deviations
_FAR = 5.0
# least probability of a quantile
_MIN_PROBABILITY = 2.0**-40


@dataclass(frozen=True)
class VariedField:
    """A field that designs differ in. Designs hold it in SI; names and integers by their index in the list.

    `ends`: of a range or a uniform distribution; for a normal one mean and standard deviation.
    """

    key: str
    law: Law
    number: NumericField | None = None
    ends: tuple[float, float] = (0.0, 0.0)
    values: tuple[Any, ...] = ()
    steps: int = 0

    @property
    def unit(self) -> str:
        """Unit in the file."""
        return self.number.unit if self.number else ""

    @property
    def count(self) -> int:
        """Number of values of a grid, 0 for any number."""
        return len(self.values) or (self.steps + 1 if self.steps else 0)

    def of_places(self, places: NDArray[Any]) -> Array:
        """Return the values at indices of a list or a range, counted from 0."""
        if self.law == "words":
            return np.asarray(places, dtype=float)
        if self.values:
            return np.asarray(np.array(self.values, dtype=float)[places])
        return self.of_shares(places / self.steps)

    def of_shares(self, shares: Array) -> Array:
        """Return the quantiles of the distribution at probabilities."""
        low, high = self.ends
        if self.values:
            return self.of_places(np.minimum(shares * len(self.values), len(self.values) - 1).astype(np.intp))
        if self.law == "ratios":
            return np.where(shares < 1, low * (high / low) ** shares, high)
        if self.law == "normal":
            from scipy.special import ndtri  # noqa: PLC0415 - an optional part

            return np.asarray(low + high * ndtri(np.clip(shares, _MIN_PROBABILITY, 1 - _MIN_PROBABILITY)))
        return np.asarray(low * (1 - shares) + high * shares)

    @property
    def span(self) -> tuple[float, float, float]:
        """Least, intermediate and largest value of designs. [SI]"""
        low, high = (min(self.values), max(self.values)) if self.values and self.number else self.ends
        if self.law == "normal" and self.number is not None:
            low, high = (low - _FAR * high, low + _FAR * high)
            low, high = max(low, self.number.low), min(high, self.number.high)
        return low, (low * high) ** 0.5 if self.law == "ratios" else (low + high) / 2, high

    def setting(self, value: float) -> Setting:
        """Return the setting of a design."""
        stated = self.values[int(value)] if self.number is None else self.number.written(float(value))
        return Setting(self.key, self.key, stated)
