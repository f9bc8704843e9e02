"""Quadrature over the cycle: exact for polynomials between the breaks, in radians."""

import itertools
import math

import numpy as np
import pytest

from crankwork.loads.indicator import quadrature
from each import for_each

pytestmark = pytest.mark.elsewhere

BREAKS = np.array([0.0, 7.0, 180.0, 350.5, 720.0])


def test_the_weights_add_up_to_the_angle_of_the_cycle() -> None:
    _, weights = quadrature(BREAKS)
    assert np.sum(weights) == pytest.approx(4 * math.pi, rel=1e-14)
    assert np.all(weights > 0)


def test_the_nodes_rise_and_never_stand_on_a_break() -> None:
    nodes, _ = quadrature(BREAKS)
    assert np.all(np.diff(nodes) > 0)
    assert not set(nodes) & set(BREAKS)
    for start, end in itertools.pairwise(BREAKS):
        inside = np.count_nonzero((start < nodes) & (nodes < end))
        assert inside == 8 * math.ceil((end - start) / 15)


@for_each("degree", range(16))
def test_a_polynomial_up_to_degree_fifteen_is_integrated_exactly(degree: int) -> None:
    nodes, weights = quadrature(np.array([0.0, 15.0]))
    assert len(nodes) == 8
    exact = math.radians(15) / (degree + 1)
    assert weights @ (nodes / 15) ** degree == pytest.approx(exact, rel=1e-13)


def test_degree_sixteen_is_too_much_for_eight_nodes() -> None:
    nodes, weights = quadrature(np.array([0.0, 15.0]))
    assert abs(weights @ (2 * nodes / 15 - 1) ** 16 - math.radians(15) / 17) > 2e-7


def test_a_step_at_a_break_does_no_harm() -> None:
    nodes, weights = quadrature(BREAKS)
    assert weights @ np.where(nodes > 180, 5.0, 2.0) == pytest.approx(math.pi * (2 + 15), rel=1e-14)
    # and a break in the wrong place would be seen
    assert abs(weights @ np.where(nodes > 100, 5.0, 2.0) - math.radians(2 * 100 + 5 * 620)) > 1e-3


@for_each("order", [0.5, 1, 2, 4])
def test_the_harmonics_of_an_engine_are_integrated_to_rounding(order: float) -> None:
    nodes, weights = quadrature(np.array([0.0, 720.0]))
    assert weights @ np.sin(np.radians(order * nodes)) ** 2 == pytest.approx(2 * math.pi, rel=1e-14)
