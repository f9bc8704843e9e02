"""Crank angles with the sines and cosines that everything else shares."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# Angles closer than this are one row of a table. [deg]
_ANGLE_TOLERANCE = 1e-9
_DECIMALS = 9
_EPSILON = float(np.finfo(float).eps)
_SIN_OF_QUARTER = np.array([0.0, 1.0, 0.0, -1.0])
_COS_OF_QUARTER = np.array([1.0, 0.0, -1.0, 0.0])


@dataclass(frozen=True)
class CrankGrid:
    """Crank angles, their sine and cosine. Made by `from_degrees`, `from_radians` or `steps`.

    Parameters
    ----------
    degrees, angle, sin, cos : array, shape (n,)
        The angles in degrees and radians and their functions. [deg], [rad], [-], [-]
    """

    degrees: Array
    angle: Array
    sin: Array
    cos: Array

    @classmethod
    def from_degrees(cls, degrees: ArrayLike) -> Self:
        """Return the grid of the given angles; exact at every multiple of 90 degrees, and 0 equals 720."""
        degrees = np.asarray(degrees, dtype=float)
        quarter = np.rint(degrees / 90)
        rest = np.radians(degrees - 90 * quarter)
        turn = quarter.astype(np.int64) & 3
        sin_turn, cos_turn = _SIN_OF_QUARTER[turn], _COS_OF_QUARTER[turn]
        sin, cos = np.sin(rest), np.cos(rest)
        return cls(
            degrees, np.radians(degrees), sin_turn * cos + cos_turn * sin + 0.0, cos_turn * cos - sin_turn * sin + 0.0
        )

    @classmethod
    def from_radians(cls, angle: ArrayLike) -> Self:
        """Return the grid of the given angles in radians."""
        angle = np.asarray(angle, dtype=float)
        return cls(np.degrees(angle), angle, np.sin(angle), np.cos(angle))

    @classmethod
    def steps(cls, step: float, end: float, *, special: tuple[float, ...] = ()) -> Self:
        """Return the grid 0, step, 2 step, ..., end, with special angles sorted in.

        Parameters
        ----------
        step, end : float
            Step and last angle; the last angle is a row even where the step does not divide it. [deg]
        special : tuple of float
            Further angles. [deg]
        """
        count = math.ceil(end / step - _ANGLE_TOLERANCE)
        regular = np.append(np.arange(count) * step, end)
        far = [angle for angle in sorted(set(special)) if np.min(np.abs(regular - angle)) > _ANGLE_TOLERANCE]
        return cls.from_degrees(np.sort(np.append(regular, far)) if far else regular)

    @cached_property
    def sin_2(self) -> Array:
        """Sine of twice the angle."""
        return 2 * self.sin * self.cos + 0.0

    @cached_property
    def cos_2(self) -> Array:
        """Cosine of twice the angle."""
        cosine = (self.cos - self.sin) * (self.cos + self.sin)
        # at odd multiples of 45 degrees sine and cosine differ by rounding alone
        return np.where(np.abs(cosine) < _EPSILON, 0.0, cosine)

    @cached_property
    def one_minus_sin(self) -> Array:
        """1 - sin, without cancellation near 90 degrees."""
        return np.where(self.sin > 0, self._small_complement, 1 - self.sin)

    @cached_property
    def one_plus_sin(self) -> Array:
        """1 + sin, without cancellation near 270 degrees."""
        return np.where(self.sin < 0, self._small_complement, 1 + self.sin)

    @cached_property
    def _small_complement(self) -> Array:
        """1 - |sin|, from the square of the cosine."""
        return np.asarray(self.cos**2 / (1 + np.abs(self.sin)))

    @cached_property
    def _multiples(self) -> dict[int, Self]:
        return {1: self}

    @cached_property
    def _shifts(self) -> dict[float, Self]:
        return {}

    def multiple(self, order: int) -> Self:
        """Return the grid of a whole multiple of every angle.

        Parameters
        ----------
        order : int
            The multiple.
        """
        if order == 2 and order not in self._multiples:
            self._multiples[order] = type(self)(2 * self.degrees, 2 * self.angle, self.sin_2, self.cos_2)
        elif order not in self._multiples:
            self._multiples[order] = type(self).from_degrees(order * self.degrees)
        return self._multiples[order]

    def shifted(self, degrees: float) -> Self:
        """Return the grid of angles larger by some degrees.

        Parameters
        ----------
        degrees : float
            How much larger. [deg]
        """
        if not degrees:
            return self
        if degrees not in self._shifts:
            self._shifts[degrees] = type(self).from_degrees(self.degrees + degrees)
        return self._shifts[degrees]

    def earlier(self, by: Array, cycle: float) -> tuple[Self, NDArray[np.intp]]:
        """Return the distinct angles that lie earlier in the cycle by some amounts, and their index for each angle.

        Parameters
        ----------
        by : array, shape (m,)
            How much earlier. [deg]
        cycle : float
            Length of the cycle. [deg]

        Returns
        -------
        tuple of CrankGrid and array, shape (m, n)
            The grid, and for each amount the index of every angle in it.
        """
        local = (self.degrees - by[:, None]).ravel()
        if local.min() < -cycle or local.max() > cycle:
            local = np.mod(local, cycle)
        local = np.where(local < 0, local + cycle, local)
        reach = 1e-15 * (float(np.max(np.abs(self.degrees))) + float(np.max(by)) + cycle)
        local = decimals(local, reach)
        # the end of a cycle is its start
        local[cycle - local <= 1e-12 * cycle] = 0.0
        order = local.argsort()
        ascending = local[order]
        # angles that differ by rounding are one angle
        is_first = np.append(True, np.diff(ascending) > reach)
        place = np.empty(local.size, dtype=np.intp)
        place[order] = np.cumsum(is_first) - 1
        return type(self).from_degrees(ascending[is_first]), place.reshape(by.size, -1)

    def __getitem__(self, part: slice) -> Self:
        """Return a slice of the grid."""
        return type(self)(self.degrees[part], self.angle[part], self.sin[part], self.cos[part])

    def __len__(self) -> int:
        return self.angle.size


def decimals(degrees: Array, reach: float) -> Array:
    """Return angles rounded to decimals where rounding errors, at most `reach`, are all they miss them by. [deg]"""
    near = np.round(degrees, _DECIMALS)
    return np.where(np.abs(degrees - near) <= reach, near, degrees)
