"""The Fourier series of the piston motion against the transform of the exact motion."""

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.series import acceleration_harmonic, acceleration_harmonics, series_transfer
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import EXACT
from each import for_each

pytestmark = pytest.mark.elsewhere

SAMPLES = 2048
TURN = CrankGrid.from_degrees(np.arange(SAMPLES) * (360 / SAMPLES))


def _spectrum(machine: SliderCrank) -> NDArray[np.complex128]:
    """Return the complex Fourier coefficients of exact x'', entry k belonging to order k."""
    return np.fft.rfft(piston_motion(machine, TURN).piston.position_2) * (2 / SAMPLES)


@for_each("ratio", [0.01, 0.1, 0.25, 0.34, 0.5, 0.8, 0.9])
def test_coefficients_are_those_of_the_transform_of_the_exact_acceleration(ratio: float) -> None:
    spectrum = _spectrum(SliderCrank(1.0, 1 / ratio))[1:101]
    series = [acceleration_harmonic(ratio, order) for order in range(1, 101)]
    assert np.max(np.abs(spectrum - series)) < 1e-13


@for_each("ratio", [0.95, 0.99])
def test_coefficients_near_the_limit_are_those_of_the_transform_relative_to_the_peak(ratio: float) -> None:
    peak = np.max(np.abs(piston_motion(SliderCrank(1.0, 1 / ratio), TURN).piston.position_2))
    spectrum = _spectrum(SliderCrank(1.0, 1 / ratio))[1:101]
    series = [acceleration_harmonic(ratio, order) for order in range(1, 101)]
    assert np.max(np.abs(spectrum - series)) < 1e-13 * peak


@for_each("ratio", [0.05, 0.25, 0.34, 0.5, 0.9, 0.99])
@for_each("order", [2, 4, 6, 20, 100])
def test_a_coefficient_is_exact_relative_to_itself(ratio: float, order: int) -> None:
    """A_2m = -(2m)^2/lambda times the Fourier coefficient of sqrt(1 - lambda^2 sin^2), a hypergeometric function."""
    m = order // 2
    with mpmath.workdps(60):
        lam = mpmath.mpf(ratio)
        leading = 2 * mpmath.binomial(mpmath.mpf(1) / 2, m) * (lam / 2) ** (2 * m)
        total = leading * mpmath.hyp2f1(m - mpmath.mpf(1) / 2, m + mpmath.mpf(1) / 2, 2 * m + 1, lam**2)
        assert abs(acceleration_harmonic(ratio, order) / (order**2 / lam * total) - 1) < 1e-14 * order


@for_each("ratio", [0.1, 0.2])
def test_the_first_coefficients_begin_as_the_books_print_them(ratio: float) -> None:
    powers = ratio ** np.arange(9)
    assert acceleration_harmonic(ratio, 2) == pytest.approx(
        powers[1] + powers[3] / 4 + 15 * powers[5] / 128 + 35 * powers[7] / 512, abs=0.1 * ratio**9
    )
    assert acceleration_harmonic(ratio, 4) == pytest.approx(
        -(powers[3] / 4 + 3 * powers[5] / 16 + 35 * powers[7] / 256), abs=0.2 * ratio**9
    )
    assert acceleration_harmonic(ratio, 6) == pytest.approx(
        9 * powers[5] / 128 + 45 * powers[7] / 512, abs=0.2 * ratio**9
    )


@for_each("order", [3, 5, 199])
def test_a_central_machine_has_no_odd_orders_but_the_first(order: int) -> None:
    assert acceleration_harmonic(0.3, 1) == 1
    assert acceleration_harmonic(0.3, order) == 0


def test_the_coefficients_of_a_machine_carry_its_radius() -> None:
    cosine, sine = acceleration_harmonics(SliderCrank(0.05, 0.2), 6)
    assert np.array_equal(cosine, [0.05 * acceleration_harmonic(0.25, order) for order in range(1, 7)])
    assert not sine.any()


def test_a_rod_hardly_longer_than_the_crank_does_not_take_forever() -> None:
    """The terms fall like (lambda^2)^k, so few of them would leave much of the sum."""
    assert acceleration_harmonic(0.999999, 2) == pytest.approx(1.6976198895121937, rel=1e-9)


@for_each("offset", [0.3, -0.3, 1e-6])
def test_offset_coefficients_are_those_of_the_transform(offset: float) -> None:
    machine = SliderCrank(1.0, 3.0, offset)
    cosine, sine = acceleration_harmonics(machine, 60)
    assert np.max(np.abs(cosine - 1j * sine - _spectrum(machine)[1:61])) < 1e-13


@for_each("spare", [1e-2, 1e-4, 1e-6])
def test_offset_coefficients_do_not_alias_where_the_crank_barely_turns(spare: float) -> None:
    """The spectrum falls like exp(-k sqrt(2 spare)), so the number of samples must follow the spare length."""
    machine = SliderCrank(1.0, 1.5, 0.5 - 1.5 * spare)
    samples = 2**17
    grid = CrankGrid.from_degrees(np.arange(samples) * (360 / samples))
    spectrum = np.fft.rfft(piston_motion(machine, grid).piston.position_2)[1:201] * (2 / samples)
    cosine, sine = acceleration_harmonics(machine, 200)
    assert np.max(np.abs(cosine - 1j * sine - spectrum)) < 1e-12


def test_an_offset_adds_to_the_first_order_what_the_textbook_says() -> None:
    ratio, offset = 0.01, 0.2
    cosine, sine = acceleration_harmonics(SliderCrank(1.0, 1 / ratio, offset), 2)
    assert sine[0] == pytest.approx(ratio * offset, rel=1e-3)
    assert cosine == pytest.approx([1, ratio], rel=1e-3)


@for_each("offset", [0.0, 0.3, -0.3])
def test_the_series_converges_to_exact_as_a_geometric_series(offset: float) -> None:
    machine = SliderCrank(1.0, 2.5, offset)
    exact = piston_motion(machine, TURN).piston
    previous = [np.inf] * 3
    for order in (2, 6, 12, 24):
        errors = [
            np.max(np.abs(one - other))
            for one, other in zip(series_transfer(machine, TURN, order), exact, strict=True)
        ]  # fmt: skip
        assert all(now < before / 4 for now, before in zip(errors, previous, strict=True))
        previous = errors
    for one, other in zip(series_transfer(machine, TURN, 80), exact, strict=True):
        assert np.max(np.abs(one - other)) < 2e-14


def test_the_series_near_the_limit_with_offset_still_converges() -> None:
    machine = SliderCrank(1.0, 1.5, 0.45)
    exact = piston_motion(machine, TURN).piston
    for one, other in zip(series_transfer(machine, TURN, 200), exact, strict=True):
        assert np.max(np.abs(one - other)) < 1e-8


@for_each("offset", [0.0, 0.4])
@for_each("order", [1, 2, 5])
def test_the_parts_of_a_truncated_series_are_derivatives_of_each_other(offset: float, order: int) -> None:
    x, x_1, x_2 = series_transfer(SliderCrank(1.0, 3.0, offset), TURN, order)
    step = np.radians(360 / SAMPLES)
    waves = np.fft.rfftfreq(SAMPLES, step / (2 * np.pi))
    assert np.max(np.abs(np.fft.irfft(1j * waves * np.fft.rfft(x), SAMPLES) - x_1)) < 1e-12
    assert np.max(np.abs(np.fft.irfft(1j * waves * np.fft.rfft(x_1), SAMPLES) - x_2)) < 1e-12


def test_the_series_displacement_is_zero_at_top_dead_centre() -> None:
    machine = SliderCrank(1.0, 3.0, 0.4)
    x, x_1, _ = series_transfer(machine, CrankGrid.from_radians([machine.top_dead_centre]), 3)
    assert abs(x[0]) < 1e-15
    # the dead centre is that of the exact motion, so the velocity of the truncated one is only near zero
    assert abs(x_1[0]) < 0.01


def test_series_and_exact_share_the_rod() -> None:
    machine = SliderCrank(1.0, 3.0, 0.4)
    exact, series = (piston_motion(machine, TURN, method) for method in (EXACT, EXACT.named("series:4")))
    for one, other in zip(exact.rod, series.rod, strict=True):
        assert np.array_equal(one, other)
