"""Vectors that turn with the crank and against it: the ellipses in which forces and moments of one order run.

Drawn in the plane across the shaft, real part along the reference direction of the engine and imaginary part 90 degrees
further with the rotation.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.kinematics.crank_grid import CrankGrid

ComplexArray = NDArray[np.complex128]

# A sum smaller than this share of its terms is rounding: it has no direction, and is zero.
_ROUNDING = 1e-13


def unit_vectors(degrees: ArrayLike) -> ComplexArray:
    """Return vectors of length one in given directions, exact at multiples of 90 degrees."""
    grid = CrankGrid.from_degrees(degrees)
    return np.asarray(grid.cos + 1j * grid.sin)


def vector_sum(terms: ArrayLike) -> complex:
    """Return the sum of vectors, zero where they cancel to rounding."""
    vectors = np.asarray(terms, dtype=complex)
    total = complex(vectors.sum())
    return total if abs(total) > _ROUNDING * float(np.abs(vectors).sum()) else 0j


class Ellipse(NamedTuple):
    """A vector made of one that turns with the crank and one that turns against it, at the same speed."""

    # The two where the crank angle of cylinder 1 is zero; force or moment [N or N m]
    forward: complex
    backward: complex

    @property
    def largest(self) -> float:
        """Largest size of the vector in a turn, the long half axis. [N or N m]"""
        return abs(self.forward) + abs(self.backward)

    @property
    def least(self) -> float:
        """Smallest size of the vector in a turn, the short half axis. [N or N m]"""
        return abs(abs(self.forward) - abs(self.backward))

    @property
    def direction(self) -> float:
        """Direction of the long axis from the reference direction, 0 to 180, and 0 of a circle. [deg]"""
        if not self.forward or not self.backward:
            return 0.0
        return float(np.degrees(np.angle(self.forward) + np.angle(self.backward)) / 2 % 180)

    def outline(self, count: int = 181) -> ComplexArray:
        """Return points of the closed ellipse for a figure, from the crank angle zero onwards.

        `count`: how many points; the last is the first.
        """
        turning = unit_vectors(np.linspace(0.0, 360.0, count))
        return np.asarray(self.forward * turning + self.backward * turning.conj())


class OrderBalance(NamedTuple):
    """Free force [N] of one order, and its moment along the shaft [N m]."""

    order: int
    force: Ellipse
    moment: Ellipse


def balance_sum(parts: Iterable[OrderBalance]) -> tuple[OrderBalance, ...]:
    """Return forces and moments added order by order, such as those of the cylinders and of counterweights.

    `parts`: of any orders, with moments about the same position.
    """
    of_order: dict[int, list[tuple[Ellipse, Ellipse]]] = {}
    for part in parts:
        of_order.setdefault(part.order, []).append((part.force, part.moment))
    return tuple(
        OrderBalance(order, *(_ellipse_sum(ellipses) for ellipses in zip(*balances, strict=True)))
        for order, balances in sorted(of_order.items())
    )


def _ellipse_sum(parts: Sequence[Ellipse]) -> Ellipse:
    return Ellipse(vector_sum([part.forward for part in parts]), vector_sum([part.backward for part in parts]))
