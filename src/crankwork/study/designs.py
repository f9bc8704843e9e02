"""The numbers of each design of a study, from its index alone."""

from __future__ import annotations

import functools
import threading

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.study.study_file import GRID, LIST, Study

# bits of SciPy's Sobol sequences
_BITS = 30


def block_of(study: Study) -> int:
    """Return the number of designs for each point: for Sobol indices two, and one for each field."""
    return len(study.varied) + 2 if study.drawing == "saltelli" else 1


def designs_of(study: Study, points: int, chunk: int) -> Array:
    """Return the designs of a chunk, shape (fields, n); each full chunk has the same number of points. [SI]"""
    block = block_of(study)
    first = chunk * points
    count = min(points, study.count // block - first)
    numbers = np.arange(first, first + count)
    if study.drawing == LIST:
        return np.array([field.of_places(numbers) for field in study.varied])
    if study.drawing == GRID:
        counts = tuple(field.count for field in study.varied)
        places = np.unravel_index(numbers, counts)
        return np.array([field.of_places(place) for field, place in zip(study.varied, places, strict=True)])
    shares = _shares(study, points, chunk)[:, :count]
    if block > 1:
        shares = _blocks(*np.split(shares, 2))
    return np.array([field.of_shares(share) for field, share in zip(study.varied, shares, strict=True)])


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
    """Return for each point its design, the second design, and the first with one field of the second after another."""
    fields, points = first.shape
    designs = np.repeat(first[:, :, None], fields + 2, axis=2)
    designs[:, :, 1] = second
    for row in range(fields):
        designs[row, :, 2 + row] = second[row]
    return designs.reshape(fields, points * (fields + 2))


class _Sobol:
    """A scrambled Sobol sequence in blocks of 2^m points.

    Points are XOR sums of direction numbers, so that every block is the first one XOR a mask: that of the powers of two
    whose sum is the index of its first point.
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
        """Return a cached sequence; its masks do not depend on the order of calls."""
        return cls(width, seed, points)

    @staticmethod
    def _whole(shares: Array) -> NDArray[np.int64]:
        return (shares.T * 2.0**_BITS).astype(np.int64)

    def block(self, number: int) -> Array:
        """Return the points of a block, shape (width, points)."""
        mask = np.zeros_like(self._first[:, :1])
        for power in range(number.bit_length()):
            if number >> power & 1:
                mask = mask ^ self._power(power)
        return np.asarray((self._first ^ mask) / 2.0**_BITS)

    def _power(self, power: int) -> NDArray[np.int64]:
        """Return the mask of the block at the index 2^power."""
        with self._lock:
            while len(self._powers) <= power:
                place = self._points << len(self._powers)
                self._sequence.fast_forward(place - self._place)
                self._place = place + 1
                self._powers.append(self._whole(self._sequence.random(1)) ^ self._first[:, :1])
            return self._powers[power]
