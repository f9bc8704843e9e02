"""Harmonics of the torque: of one cylinder, their phase stars, and of all cylinders together."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.cylinders.layout import Layout
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid, decimals
from crankwork.shaft.curve import Curve

Phasors = NDArray[np.complex128]

_TURN = 360.0
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@formula("harmonic_amplitude", "den_hartog_1956, ch. 5")
def amplitude_of_harmonic(a_nu: Value, b_nu: Value) -> Value:
    """Amplitude of one harmonic of the torque."""
    return np.sqrt(a_nu**2 + b_nu**2)


@formula("total_harmonic_amplitude", "den_hartog_1956, ch. 5")
def amplitude_of_total(M_nu: Value, s_nu: Value) -> Value:
    """Amplitude of one harmonic of the torque of all cylinders."""
    return M_nu * s_nu


class TorqueHarmonics(NamedTuple):
    """Harmonics of a torque, arrays of shape (k,): M = mean + sum of a cos(nu phi) + b sin(nu phi).

    Orders count per revolution, so that 0.5 is once in four strokes; `phase` is the crank angle of the order, nu phi,
    at which the harmonic is largest. [-], [N m], [rad]
    """

    mean: float
    orders: Array
    cosine: Array
    sine: Array
    amplitude: Array
    phase: Array


def _harmonics(mean: float, orders: Array, cosine: Array, sine: Array) -> TorqueHarmonics:
    amplitude = np.asarray(amplitude_of_harmonic(cosine, sine))
    return TorqueHarmonics(mean, orders, cosine, sine, amplitude, np.arctan2(sine, cosine))


def torque_harmonics(samples: ArrayLike, cycle: float, count: int) -> TorqueHarmonics:
    """Return the harmonics of a torque that is sampled evenly, shape (count,) (den_hartog_1956, ch. 5). [N m]

    `samples`: torque at 0, cycle/n, 2 cycle/n, ...; the end of the cycle is not repeated [N m]; `count`: how many
    harmonics; fewer than half the samples.
    """
    samples = np.asarray(samples, dtype=float)
    if 2 * count >= samples.size:
        raise MethodError(f"{count} harmonics need more than {2 * count} samples, not {samples.size}; sample finer")
    parts = np.fft.rfft(samples)[: count + 1] / samples.size
    orders: Array = np.arange(1.0, count + 1) * (360.0 / cycle)
    return _harmonics(float(parts[0].real), orders, 2 * parts[1:].real, -2 * parts[1:].imag)


def curve_harmonics(curve: Curve, count: int) -> TorqueHarmonics:
    """Return the harmonics of a torque that is given as a curve, integrated between its corners, shape (count,).

    Source: den_hartog_1956, ch. 5; Gauss points in pieces of at most one radian of the highest order.
    """
    cycle = curve.cycle
    orders: Array = np.arange(1.0, count + 1) * (2 * math.pi / cycle)
    width = np.diff(curve.angle)
    parts = np.ceil(width * orders[-1]).astype(int)
    within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    edges = np.append(np.repeat(curve.angle[:-1], parts) + within * np.repeat(width / parts, parts), curve.angle[-1])
    half = np.diff(edges) / 2
    angle = (edges[:-1] + half)[:, None] + half[:, None] * _NODES
    weighted = curve(angle) * half[:, None] * _WEIGHTS * (2 / cycle)
    first, turned = np.exp(1j * orders[0] * angle), np.ones_like(angle, dtype=complex)
    sums = np.empty(count, dtype=complex)
    for index in range(count):
        # rotate to the next order
        turned = turned * first
        sums[index] = np.vdot(turned, weighted)
    cosine, sine = sums.real, -sums.imag
    return _harmonics(curve.mean, orders, cosine, sine)


class PhaseStar(NamedTuple):
    """Directions of one harmonic of every cylinder, shape (cylinders,), and their sum; a major order sums fully. [-]"""

    order: float
    vectors: Phasors
    sum: complex


def phase_star(layout: Layout, order: float) -> PhaseStar:
    """Return the phase star of one order: unit vectors exp(-i nu theta) at the firing angles theta, shape (cylinders,).

    Unit vectors by number of the cylinder, and their sum [-]. Source: den_hartog_1956, ch. 5.
    """
    (vectors,) = _unit_vectors(layout, [order])
    return PhaseStar(order, vectors, complex(np.sum(vectors)))


def phase_sums(layout: Layout, orders: Iterable[float]) -> Phasors:
    """Return the sum of the phase star of each order, shape (k,). [-]"""
    return np.asarray(_unit_vectors(layout, orders).sum(axis=1))


def _unit_vectors(layout: Layout, orders: Iterable[float]) -> Phasors:
    firing = np.outer(list(orders), [place.firing_angle for place in layout.places])
    reach = 1e-15 * (float(np.max(np.abs(firing))) + _TURN)
    grid = CrankGrid.from_degrees(decimals(np.mod(firing, _TURN), reach))
    return np.asarray(grid.cos - 1j * grid.sin)


def total_harmonics(harmonics: TorqueHarmonics, layout: Layout) -> TorqueHarmonics:
    """Return the harmonics of the torque of all cylinders, from those of one and the phase stars, shape (k,). [N m]

    Source: den_hartog_1956, ch. 5.
    """
    sums = phase_sums(layout, harmonics.orders.tolist())
    total = (harmonics.cosine - 1j * harmonics.sine) * sums
    amplitude = np.asarray(amplitude_of_total(harmonics.amplitude, np.abs(sums)))
    phase = np.arctan2(-total.imag, total.real)
    mean = harmonics.mean * len(layout.places)
    return TorqueHarmonics(mean, harmonics.orders, total.real, -total.imag, amplitude, phase)
