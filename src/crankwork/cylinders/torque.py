"""Torque of many cylinders on one shaft: firing intervals, sums, torque along the shaft, harmonics and phase stars."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.cylinders.firing import intervals, wrap_angle
from crankwork.cylinders.layout import Layout
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, is_traced, named, sum_terms
from crankwork.kinematics.crank_grid import Array, CrankGrid, decimals
from crankwork.shaft.curve import Curve


@formula("journal_torque", "kolchin_demidov_2008, ch. 9")
def torque_behind_throw(M_j: Value, M_t: Value) -> Value:
    """Torque that a main journal passes on, behind a throw."""
    return M_j + M_t


@formula("crankpin_torque", "kolchin_demidov_2008, ch. 9")
def torque_of_crankpin(M_j: Value, M_t: Value) -> Value:
    """Torque that a crankpin passes on: all that comes before it and half of its own."""
    return M_j + M_t / 2


@formula("mean_total_torque", "kolchin_demidov_2008, ch. 7")
def mean_torque_of_work(i_cyl: Value, W: Value, phi_c: Value) -> Value:
    """Mean torque of all cylinders, from their indicated work."""
    return i_cyl * W / phi_c


@formula("firing_interval", "kolchin_demidov_2008, ch. 7")
def even_firing_interval(phi_c: Value, i_cyl: Value) -> Value:
    """Angle between firings that follow each other evenly, the period of the total torque."""
    return phi_c / i_cyl


class TorquesAlongShaft(NamedTuple):
    """Torques transmitted by the parts of a shaft towards the output end behind the last throw, shape (n,) each. [N m]

    There is one journal more than throws: the first transmits nothing, the last one the total.
    """

    throws: tuple[Value, ...]
    journals: tuple[Value, ...]
    crankpins: tuple[Value, ...]


def torques_along_shaft(torques: Sequence[Value], layout: Layout) -> TorquesAlongShaft:
    """Return the torque on every main journal and crankpin: the accumulated torques of a shaft with a free front end.

    Torques of throws, on journals and on crankpins [N m]. `torques`: torque of each cylinder by number, at the same
    crank angles of cylinder 1 [N m]; `layout`: the cylinders; those of one throw act together, on a common pin or on
    split ones. Source: kolchin_demidov_2008, ch. 9.
    """
    if len(torques) != len(layout.places):
        raise MethodError(f"torques must be one row per cylinder, {len(layout.places)} rows, not {len(torques)}")
    count = max(place.throw for place in layout.places) + 1
    members = [[torques[place.number - 1] for place in layout.places if place.throw == index] for index in range(count)]
    throws = tuple(
        group[0] if len(group) == 1 else sum_terms(f"throw_torque.{index}", group)
        for index, group in enumerate(members, start=1)
    )
    journals = [absent("journal_torque.1") if is_traced(*torques) else np.zeros_like(throws[0])]
    crankpins = []
    for number, throw in enumerate(throws, start=1):
        crankpins.append(named(torque_of_crankpin(journals[-1], throw), f"crankpin_torque.{number}"))
        journals.append(named(torque_behind_throw(journals[-1], throw), f"journal_torque.{number + 1}"))
    return TorquesAlongShaft(throws, tuple(journals), tuple(crankpins))


def firing_intervals(layout: Layout) -> tuple[float, ...]:
    """Return the angles from each firing to the next, in the firing order, each at its own top dead centre. [deg]"""
    first, cycle = layout.places[0].top, layout.cycle
    fired = [wrap_angle(place.firing_angle + place.top - first, cycle) for place in layout.places]
    return intervals([fired[number - 1] for number in layout.firing_order], cycle)


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
