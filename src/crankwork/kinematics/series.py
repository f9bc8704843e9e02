"""Slider-crank motion as a Fourier series in the crank angle, to any order.

x'' = r (cos phi + A2 cos 2 phi + A4 cos 4 phi + ...) for a central mechanism; dividing by the order
once gives x', twice gives x. An offset brings odd orders and sines.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, is_traced, named, sum_terms, to_number
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.slider_crank import SliderCrank, piston_transfer_2, rod_swing

# Above this ratio the closed form needs too many terms.
_CLOSED_FORM_RATIO = 0.999
_MAX_SAMPLES = 2**18
_KEYS = ("piston_displacement", "piston_transfer_1", "piston_transfer_2")


def acceleration_harmonic(rod_ratio: float, order: int) -> float:
    """Return the coefficient A of cos(order phi) in x''/r of a central slider-crank. [-]

    `order`: order: 1, or an even number; other odd orders are absent. Source: taylor_1985, vol. 2, ch. 8.

    A_2m = (2m)^2/lambda sum over k >= m of C(1/2, k) (-1)^(k+m) lambda^2k 2^(1-2k) C(2k, k-m), from the
    binomial series of the square root. All terms of one sum have one sign, so nothing cancels.

    Examples
    --------
    >>> round(acceleration_harmonic(0.25, 2), 6)
    0.254025
    """
    if order == 1:
        return 1.0
    if order % 2:
        return 0.0
    if rod_ratio > _CLOSED_FORM_RATIO:
        return float(_transform(SliderCrank(1.0, 1 / rod_ratio), order).cosine[-1])
    m = order // 2
    # the term k = m, then the ratio of successive terms
    term = 2.0
    for k in range(1, m + 1):
        term *= abs(0.5 - k + 1) / k * rod_ratio**2 / 4
    total, k = term, m
    while term > total * 1e-18 and term > 0:
        k += 1
        term *= (k - 1.5) / k * rod_ratio**2 / 4 * (2 * k) * (2 * k - 1) / ((k - m) * (k + m))
        total += term
    sign = 1.0 if m % 2 else -1.0
    return sign * order**2 / rod_ratio * total


class Harmonics(NamedTuple):
    """Cosine and sine coefficients of x'' by order, entry 0 being order 1. [m]"""

    cosine: Array
    sine: Array


def acceleration_harmonics(slider_crank: SliderCrank, order: int) -> Harmonics:
    """Return the Fourier coefficients of d2x/dphi2 for orders 1 to `order`, shape (order,). [m]

    Coefficients; closed form for a central mechanism, transform of the exact motion with an offset or a rod hardly
    longer than the crank. Source: taylor_1985, vol. 2, ch. 8.
    """
    orders = range(1, order + 1)
    ratio = float(slider_crank.rod_ratio)
    if slider_crank.offset == 0 and ratio <= _CLOSED_FORM_RATIO:
        cosine = np.array([acceleration_harmonic(ratio, k) for k in orders])
        return Harmonics(slider_crank.crank_radius * cosine, np.zeros(order))
    return _transform(slider_crank, order)


def _transform(slider_crank: SliderCrank, order: int) -> Harmonics:
    """Return the coefficients by a fast Fourier transform of the exact motion."""
    samples = _samples(slider_crank, order)
    grid = CrankGrid.from_degrees(np.arange(samples) * (360 / samples))
    rod = rod_swing(slider_crank, grid)
    exact = piston_transfer_2(slider_crank.crank_radius, slider_crank.rod_ratio, grid.cos, rod.cos_sum, rod.cos)
    spectrum = np.fft.rfft(exact)[1 : order + 1] * (2 / samples)
    if slider_crank.offset == 0:
        # a central mechanism is symmetric: no sines, and no odd orders but the first
        spectrum.imag = 0.0
        spectrum[2::2] = 0.0
    return Harmonics(spectrum.real, -spectrum.imag)


def _samples(slider_crank: SliderCrank, order: int) -> int:
    """Return how many samples of a turn hold the motion to rounding.

    Harmonics fall off as exp(-k d), where cosh d is the reach of the rod over that of crank and offset.
    """
    reach = 1 / (1 - float(slider_crank.clearance / slider_crank.rod_length))
    decay = float(np.arccosh(reach))
    wanted = 2 * (order + 40 / decay)
    return int(min(_MAX_SAMPLES, 2 ** np.ceil(np.log2(max(wanted, 256)))))


@formula("piston_displacement", "taylor_1985, vol. 2, ch. 8")
def series_displacement_term(  # noqa: PLR0913 - two coefficients and two angles
    a_k: Value, cos_kphi_0: Value, b_k: Value, sin_kphi_0: Value, cos_kphi: Value, sin_kphi: Value, k_h: Value
) -> Value:
    """One order of the displacement, from the angle where it is to be zero."""
    return (a_k * cos_kphi_0 + b_k * sin_kphi_0 - (a_k * cos_kphi + b_k * sin_kphi)) / k_h**2


@formula("piston_transfer_1", "taylor_1985, vol. 2, ch. 8")
def series_transfer_1_term(a_k: Value, sin_kphi: Value, b_k: Value, cos_kphi: Value, k_h: Value) -> Value:
    """One order of dx/dphi."""
    return (a_k * sin_kphi - b_k * cos_kphi) / k_h


@formula("piston_transfer_2", "taylor_1985, vol. 2, ch. 8")
def series_transfer_2_term(a_k: Value, cos_kphi: Value, b_k: Value, sin_kphi: Value) -> Value:
    """One order of d2x/dphi2."""
    return a_k * cos_kphi + b_k * sin_kphi


def order_terms(grid: CrankGrid, order: int, a_k: Value, b_k: Value, start: tuple[Value, Value]) -> Transfer:
    """Return one order of displacement, dx/dphi and d2x/dphi2.

    `start`: cosine and sine of order times the crank angle where the displacement is to be zero.
    """
    sin, cos = grid.multiple(order).sin, grid.multiple(order).cos
    return Transfer(
        series_displacement_term(a_k, start[0], b_k, start[1], cos, sin, float(order)),
        series_transfer_1_term(a_k, sin, b_k, cos, float(order)),
        series_transfer_2_term(a_k, cos, b_k, sin),
    )


def series_transfer(slider_crank: SliderCrank, grid: CrankGrid, order: int) -> Transfer:
    """Return displacement, dx/dphi and d2x/dphi2 as sums of the orders 1 to `order`. [m]

    x, x', x''; the displacement is zero at the top dead centre of the mechanism. Source: taylor_1985, vol. 2, ch. 8.
    """
    lengths = SliderCrank(*map(to_number, slider_crank))
    dead_centre, has_trace = lengths.top_dead_centre, is_traced(*slider_crank)
    terms: list[tuple[int, Transfer]] = []
    for k, (c, s) in enumerate(zip(*acceleration_harmonics(lengths, order), strict=True), start=1):
        if c == 0 and s == 0:
            continue
        at_top = (float(np.cos(k * dead_centre)), float(np.sin(k * dead_centre)))
        taken = traced_order(slider_crank, k, (float(c), float(s)), at_top) if has_trace else (c, s, at_top)
        terms.append((k, order_terms(grid, k, *taken)))
    sums = (_sum(key, [(k, term[i]) for k, term in terms]) for i, key in enumerate(_KEYS))
    return Transfer(*sums)


def traced_order(
    slider_crank: SliderCrank, order: int, coefficients: tuple[float, float], start: tuple[float, float]
) -> tuple[TracedValue, TracedValue, tuple[TracedValue, TracedValue]]:
    """Return the coefficients of one order as traced values; of a central mechanism those of the sines are absent.

    `start`: cosine and sine of order times the crank angle where the displacement is to be zero.
    """
    a_k, b_k = coefficients
    first = TracedValue(ProcedureValue(a_k, "harmonic", slider_crank), f"series_cosine.{order}")
    if b_k == 0 and start == (1.0, 0.0):
        return first, absent(""), (absent("", 1.0), absent(""))
    return (
        first,
        TracedValue(ProcedureValue(b_k, "harmonic", slider_crank), f"series_sine.{order}"),
        (
            TracedValue(ProcedureValue(start[0], "dead_centre", slider_crank)),
            TracedValue(ProcedureValue(start[1], "dead_centre", slider_crank)),
        ),
    )


def _sum(key: str, terms: list[tuple[int, Value]]) -> Value:
    return sum_terms(key, [named(term, f"{key}.k{k}") for k, term in terms])
