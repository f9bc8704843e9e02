"""Reduced inertia from a table of transfer functions, as a document prints them, and its derivative by differences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array

Differences = Literal["forward", "central", "spectral"]


@dataclass(frozen=True)
class TabulatedBody:
    """A body whose motion is a column of numbers."""

    name: str
    # Mass, and moment of inertia about the point whose speed is given [kg], [kg m2]
    mass: float = 0.0
    inertia: float = 0.0
    # Speed of that point over the angular speed of the crank, one for each crank angle [m]
    velocity_ratio: tuple[float, ...] = (0.0,)
    rotation_ratio: tuple[float, ...] = (0.0,)  # Angular speed of the body over that of the crank [-]


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_ratios(m_i: Value, v_w: Value, J_S: Value, w_w: Value) -> Value:
    """Part of one body in the reduced moment of inertia, from its speeds over that of the crank."""
    return m_i * v_w**2 + J_S * w_w**2


def difference_derivative(crank_angle: ArrayLike, values: ArrayLike, scheme: Differences = "central") -> Array:
    """Return the derivative by the crank angle of a column that repeats every revolution. [kg m2]

    Differences are to the next angle, from the last to the next, or of the trigonometric polynomial through all values.

    Forward and central differences are those of printed tables. For a computed motion the exact derivative is
    available, see `reduction.reduced_inertia`.
    """
    angle, column = np.asarray(crank_angle, dtype=float), np.asarray(values, dtype=float)
    next_angle = np.append(angle[1:], angle[0] + 2 * np.pi)
    step = next_angle - angle
    if angle.shape != column.shape or np.any(step <= 0):
        raise ValueError("crank angles must ascend within one revolution, with one value each")
    if scheme == "forward":
        return np.asarray((np.roll(column, -1) - column) / step)
    if scheme == "central":
        return np.asarray((np.roll(column, -1) - np.roll(column, 1)) / (step + np.roll(step, 1)))
    if np.ptp(step) > 1e-9:
        raise ValueError("the spectral derivative needs equidistant crank angles over the whole revolution")
    orders = np.fft.rfftfreq(column.size, 1 / column.size)
    if column.size % 2 == 0:
        orders[-1] = 0.0
    return np.fft.irfft(1j * orders * np.fft.rfft(column), column.size)
