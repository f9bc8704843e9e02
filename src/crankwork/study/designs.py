"""What each design of a study states, by its number alone."""

from __future__ import annotations

import functools
import threading

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.study.study_file import GRID, LIST, Study

# bits of a Sobol sequence as SciPy has it
_BITS = 30


def block_of(study: Study) -> int:
    """Return how many designs there are of one point: for Sobol indices two, and one more for each field."""
    return len(study.varied) + 2 if study.drawing == "saltelli" else 1


def designs_of(study: Study, points: int, chunk: int) -> Array:
    """Return the designs of a chunk, shape (fields, n), of which each full one has a number of points. [SI]"""
    block = block_of(study)
    first = chunk * points
    count = min(points, study.count // block - first)
    numbers = np.arange(first, first + count)
    if study.drawing == LIST:
        return np.array([one.of_places(numbers) for one in study.varied])
    if study.drawing == GRID:
        counts = tuple(one.count for one in study.varied)
        places = np.unravel_index(numbers, counts)
        return np.array([one.of_places(at) for one, at in zip(study.varied, places, strict=True)])
    shares = _shares(study, points, chunk)[:, :count]
    if block > 1:
        shares = _blocks(*np.split(shares, 2))
    return np.array([one.of_shares(at) for one, at in zip(study.varied, shares, strict=True)])


def _shares(study: Study, points: int, chunk: int) -> Array:
    """Return points of the unit cube, shape (dimensions, points)."""
    from scipy.stats import qmc  # noqa: PLC0415 - an optional part

    width = len(study.varied) * (2 if study.drawing == "saltelli" else 1)
    if study.drawing in ("sobol", "saltelli"):
        return _Sobol.of(width, study.seed, points).block(chunk)
    generator = np.random.default_rng([study.seed, chunk])
    if study.drawing == "latin":
        return np.asarray(qmc.LatinHypercube(width, rng=generator).random(points)).T
    return generator.random((width, points))


def _blocks(first: Array, second: Array) -> Array:
    """Return points, others, and the first with one field of the others after another; all of a point side by side."""
    fields, points = first.shape
    found = np.repeat(first[:, :, None], fields + 2, axis=2)
    found[:, :, 1] = second
    for at in range(fields):
        found[at, :, 2 + at] = second[at]
    return found.reshape(fields, points * (fields + 2))


class _Sobol:
    """A scrambled Sobol sequence in blocks of 2^m points.

    Binary digits of its points are sums of directions, so that a block is the first one with a number laid over it,
    which is that of the powers of two that its first place is the sum of.
    """

    def __init__(self, width: int, seed: int, points: int) -> None:
        from scipy.stats import qmc  # noqa: PLC0415 - an optional part

        self._sequence = qmc.Sobol(width, scramble=True, rng=seed, bits=_BITS)
        self._place, self._points = points, points
        self._first = self._whole(self._sequence.random(points))
        self._powers: list[NDArray[np.int64]] = []
        self._lock = threading.Lock()

    @classmethod
    @functools.lru_cache(maxsize=2)
    def of(cls, width: int, seed: int, points: int) -> _Sobol:
        """Return a sequence that is kept: what it has found of itself does not depend on who asked first."""
        return cls(width, seed, points)

    @staticmethod
    def _whole(shares: Array) -> NDArray[np.int64]:
        return (shares.T * 2.0**_BITS).astype(np.int64)

    def block(self, number: int) -> Array:
        """Return the points of a block, shape (width, points)."""
        laid_over = np.zeros_like(self._first[:, :1])
        for power in range(number.bit_length()):
            if number >> power & 1:
                laid_over = laid_over ^ self._power(power)
        return np.asarray((self._first ^ laid_over) / 2.0**_BITS)

    def _power(self, power: int) -> NDArray[np.int64]:
        """Return what is laid over the first block by that of the place 2^power."""
        with self._lock:
            while len(self._powers) <= power:
                place = self._points << len(self._powers)
                self._sequence.fast_forward(place - self._place)
                self._place = place + 1
                self._powers.append(self._whole(self._sequence.random(1)) ^ self._first[:, :1])
            return self._powers[power]
