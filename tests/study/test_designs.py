"""Designs by their number: what SciPy draws, in any order of chunks; grids as products; distributions as stated."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy import stats

from crankwork.description.machine_file import template
from crankwork.study.chunks import designs_of
from crankwork.study.study_file import read_study

HEAD = 'machine = "machine.toml"\nvalues = "stroke"\n[designs]\n'


@pytest.fixture
def study(tmp_path):
    (tmp_path / "machine.toml").write_text(template("slider-crank"), encoding="utf-8")

    def read(designs, vary):
        return read_study(f"{HEAD}{designs}\n[vary]\n{vary}\n", "study.toml", folder=tmp_path)

    return read


FIELDS = """
crank.radius = { from = "40 mm", to = "50 mm" }
crank.speed = { from = "100 rad/s", to = "10000 rad/s", spacing = "ratios" }
rod.ratio = "0.25 sd 0.01"
"""


def test_sobol_points_are_those_of_scipy_in_any_order(study):
    one = study('drawing = "sobol"\ncount = 1000\nseed = 5', FIELDS)
    points = stats.qmc.Sobol(3, rng=5).random(1024)[:1000]
    wanted = np.stack(
        [0.04 * (1 - points[:, 0]) + 0.05 * points[:, 0], 100 * 100 ** points[:, 1],
         stats.norm(0.25, 0.01).ppf(points[:, 2])]
    )  # fmt: skip
    for chunk in (3, 0, 7, 1):
        found = designs_of(one, 128, chunk)
        np.testing.assert_allclose(found, wanted[:, chunk * 128 : chunk * 128 + 128], rtol=1e-12)
    assert designs_of(one, 128, 7).shape == (3, 1000 - 7 * 128)


def test_a_latin_hypercube_has_one_design_in_every_stripe_of_a_chunk(study):
    one = study('drawing = "latin"\ncount = 256', FIELDS)
    for chunk in range(4):
        radius, speed, _ = designs_of(one, 64, chunk)
        assert sorted(((radius - 0.04) / 0.01 * 64).astype(int)) == list(range(64))
        assert sorted((np.log(speed / 100) / math.log(100) * 64).astype(int)) == list(range(64))


def test_draws_are_as_distributed(study):
    one = study('drawing = "random"\ncount = 20000', FIELDS)
    radius, _, ratio = designs_of(one, 16384, 0)
    assert stats.kstest(radius, stats.uniform(0.04, 0.01).cdf).pvalue > 1e-3
    assert stats.kstest(ratio, stats.norm(0.25, 0.01).cdf).pvalue > 1e-3
    assert not np.array_equal(designs_of(one, 4096, 0)[0, :9], designs_of(one, 4096, 1)[0, :9])


def test_a_grid_is_every_combination_the_last_field_first(study):
    one = study(
        'drawing = "grid"',
        'crank.radius = ["40 mm", "45 mm"]\ncrank.speed = { from = "100 rad/s", to = "200 rad/s", steps = 2 }\n'
        "rod.ratio = [0.2, 0.3]",
    )
    wanted = list(itertools.product((0.04, 0.045), (100, 150, 200), (0.2, 0.3)))
    assert one.count == 12
    found = np.concatenate([designs_of(one, 4, chunk) for chunk in range(3)], axis=1)
    np.testing.assert_allclose(found.T, wanted)


def test_lists_may_stand_side_by_side(study):
    one = study('drawing = "list"', 'crank.radius = ["40 mm", "45 mm"]\nrod.ratio = [0.2, 0.3]')
    np.testing.assert_allclose(designs_of(one, 4, 0), [[0.04, 0.045], [0.2, 0.3]])


def test_words_are_drawn_as_often_as_each_other(study):
    one = study(
        'drawing = "sobol"\ncount = 512', 'method.kinematics = ["exact", "textbook"]\ncrank.radius = "45 sd 1 mm"'
    )
    words, _ = designs_of(one, 512, 0)
    assert np.bincount(words.astype(int)).tolist() == [256, 256]


def test_a_point_of_indices_is_a_block_of_designs(study):
    one = study('drawing = "saltelli"\ncount = 100', FIELDS)
    assert one.count == 100
    blocks = designs_of(one, 4, 1).reshape(3, 4, 5)
    first, second = blocks[:, :, 0], blocks[:, :, 1]
    for at in range(3):
        mixed = blocks[:, :, 2 + at]
        np.testing.assert_array_equal(mixed[at], second[at])
        np.testing.assert_array_equal(np.delete(mixed, at, 0), np.delete(first, at, 0))
