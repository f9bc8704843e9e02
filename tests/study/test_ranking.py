"""What is kept of designs that go by: the same as of all of them at once, whatever comes first."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from crankwork.study.chunks import Histogram, Moments, Shares, best_designs, pareto_front, thin_front


def by_definition(costs):
    """Return the designs that no other is as good as in everything, the first of equal ones."""
    found = []
    for at, one in enumerate(costs):
        as_good = np.all(costs <= one, axis=1)
        worse = as_good & np.any(costs < one, axis=1)
        equal_before = np.all(costs == one, axis=1) & (np.arange(len(costs)) < at)
        if not worse.any() and not equal_before.any():
            found.append(at)
    return found


def test_a_pareto_set_is_what_its_definition_says():
    wrong = []
    for objectives, count in itertools.product((1, 2, 3, 5), (0, 1, 300, 2000)):
        generator = np.random.default_rng(count + objectives)
        costs = generator.normal(size=(count, objectives)).round(1 if objectives < 3 else 6)
        if pareto_front(costs).tolist() != by_definition(costs):
            wrong.append((objectives, count))
    assert wrong == []


def test_a_large_pareto_set_is_thinned_and_keeps_its_ends():
    costs = np.stack([np.arange(100.0), -np.arange(100.0)], axis=1)
    found = thin_front(costs, pareto_front(costs), 11)
    assert found.size == 11
    assert (found[0], found[-1]) == (0, 99)


@given(st.lists(st.integers(-5, 5), max_size=60), st.integers(1, 70))
def test_the_best_are_the_first_of_all_in_order(costs, count):
    wanted = sorted(range(len(costs)), key=lambda at: costs[at])[:count]
    assert best_designs(np.array(costs, dtype=float), count).tolist() == wanted


finite = st.floats(-1e12, 1e12, allow_subnormal=False)


@settings(deadline=None)
@given(st.lists(st.lists(finite, max_size=20), min_size=1, max_size=6), st.randoms())
def test_a_histogram_is_the_same_in_any_order(parts, random):
    whole = Histogram.of(np.array([one for part in parts for one in part]))
    random.shuffle(parts)
    merged = Histogram()
    for part in parts:
        merged.add(Histogram.of(np.array(part)))
    assert merged == whole
    assert sum(merged.counts) == sum(map(len, parts))
    if merged.counts:
        counts, _ = np.histogram([one for part in parts for one in part], merged.edges)
        # NumPy counts what stands on the last edge into the last bin
        assert len(merged.counts) <= 128
        assert counts.tolist() == merged.counts


def test_moments_are_those_of_all_values():
    values = np.random.default_rng(3).normal(1e6, 2.0, 5000)
    found = Moments(1e6)
    for part in np.split(values, 10):
        found.add(Moments.of(part, 1e6))
    assert found.mean == pytest.approx(values.mean(), rel=1e-14)
    assert found.deviation == pytest.approx(values.std(ddof=1), rel=1e-10)
    assert (found.low, found.high) == (values.min(), values.max())


@pytest.mark.elsewhere
def test_indices_of_ishigamis_function():
    """With a = 7 and b = 0.1: 0.3139, 0.4424, 0 alone; 0.5576, 0.4424, 0.2437 in all (Saltelli 2008, ch. 4)."""
    points = stats.qmc.Sobol(6, rng=1).random(2**14) * 2 * np.pi - np.pi
    first, second = points[:, :3], points[:, 3:]

    def value(x):
        return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])

    mixed = [np.where(np.arange(3) == at, second, first) for at in range(3)]
    values = np.stack([value(one) for one in (first, second, *mixed)], axis=1)
    found = Shares(3.0)
    for part in np.split(values, 8):
        found.add(Shares.of(part, 3.0))
    alone, alone_error, total, total_error = found.indices()
    np.testing.assert_allclose(alone, [0.3139, 0.4424, 0.0], atol=4e-3)
    np.testing.assert_allclose(total, [0.5576, 0.4424, 0.2437], atol=4e-3)
    assert np.all(alone_error < 0.02)
    assert np.all(total_error < 0.02)


def test_what_does_not_vary_has_no_indices():
    assert Shares.of(np.full((50, 5), 7.25), 7.0).indices() is None
