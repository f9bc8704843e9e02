"""Slider-crank motion as a Fourier series in the crank angle, to any order.

x'' = r (cos phi + A2 cos 2 phi + A4 cos 4 phi + ...) for a central mechanism; dividing by the order
once gives x', twice gives x. An offset brings odd orders and sines.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid, cos_multiple, sin_multiple
from crankwork.kinematics.slider_crank import SliderCrank, piston_transfer_2, rod_swing

# Above this ratio the closed form needs too many terms.
_CLOSED_FORM_RATIO = 0.999
_MAX_SAMPLES = 2**18


def acceleration_harmonic(rod_ratio: float, order: int) -> float:
    """Return the coefficient A of cos(order phi) in x''/r of a central slider-crank.

    Parameters
    ----------
    rod_ratio : float
        Crank radius over rod length, below 1. [-]
    order : int
        Order: 1, or an even number; other odd orders are absent.

    Returns
    -------
    float
        The coefficient. [-]

    Notes
    -----
    A_2m = (2m)^2/lambda sum over k >= m of C(1/2, k) (-1)^(k+m) lambda^2k 2^(1-2k) C(2k, k-m), from the
    binomial series of the square root. All terms of one sum have one sign, so nothing cancels.

    References
    ----------
    taylor_1985, vol. 2, ch. 8.

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
    """Return the Fourier coefficients of d2x/dphi2 for orders 1 to `order`.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    order : int
        Highest order.

    Returns
    -------
    Harmonics of array, shape (order,)
        Coefficients; closed form for a central mechanism, transform of the exact motion with an offset or a
        rod hardly longer than the crank. [m]

    References
    ----------
    taylor_1985, vol. 2, ch. 8.
    """
    orders = range(1, order + 1)
    ratio = float(slider_crank.rod_ratio)
    if slider_crank.offset == 0 and ratio <= _CLOSED_FORM_RATIO:
        cosine = np.array([acceleration_harmonic(ratio, one) for one in orders])
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


def series_transfer(slider_crank: SliderCrank, grid: CrankGrid, order: int) -> tuple[Array, Array, Array]:
    """Return displacement, dx/dphi and d2x/dphi2 as sums of the orders 1 to `order`.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]
    order : int
        Highest order.

    Returns
    -------
    tuple of array, shape (n,)
        x, x', x''; the displacement is zero at the top dead centre of the mechanism. [m]

    References
    ----------
    taylor_1985, vol. 2, ch. 8.
    """
    harmonics = acceleration_harmonics(slider_crank, order)
    dead_centre = slider_crank.top_dead_centre
    x, x_1, x_2 = np.zeros((3, *grid.angle.shape))
    for k, (c, s) in enumerate(zip(*harmonics, strict=True), start=1):
        if c == 0 and s == 0:
            continue
        cos, sin = cos_multiple(grid, k), sin_multiple(grid, k)
        at_top = c * np.cos(k * dead_centre) + s * np.sin(k * dead_centre)
        x += (at_top - (c * cos + s * sin)) / k**2
        x_1 += (c * sin - s * cos) / k
        x_2 += c * cos + s * sin
    return x, x_1, x_2
