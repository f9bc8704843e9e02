"""Machines of one file that differ in some numbers: many calculated at once, the others one by one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kernel.compiled import CONVERGED, BatchResult, Kernel
from crankwork.kernel.trace import NotCompiledError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.locale import Refusal
from crankwork.study.sought import Sought

# how far designs that are calculated both ways may be apart
_SAME = 1e-9
# the same where peaks may lie between the angles that are looked at
_SAMPLED = 0.1
# of a field that does not vary, how far beside it a second value is taken
_BESIDE = 1e-3
# parts of the way to the end of a range that are tried
_NEARER = (1.0, 0.5, 0.25, 0.1, 0.01)
# designs that a thread takes at a time
_TOGETHER = 4096


@dataclass
class Values:
    """Single values of designs, shape (keys, n), and why there is no machine for some. [SI]"""

    of: Array = field(repr=False)
    refused: dict[int, CrankworkError]
    one_by_one: int = 0


class Machines:
    """Machines of a file with other values of some numbers.

    `spans`: the least value of each, one between, and the largest, shape (fields, 3). [SI]
    """

    def __init__(
        self,
        description: Description,
        numbers: Mapping[str, Sought],
        spans: Array,
        keys: Sequence[str],
        overrides: Sequence[str | Setting] = (),
    ) -> None:
        self._description, self._overrides = description, list(overrides)
        self._numbers, self._spans, self.keys = numbers, spans, list(keys)
        self._kernel: Kernel | None = None
        # why the calculation is not compiled, and of what that shows
        self.reason, self.at_key = "", ""
        self.stated = self.results(spans[:, 1])
        for key in keys:
            check_single(self.stated, key)

    def results(self, design: Array) -> Results:
        """Return the results of one design."""
        written = [
            Setting(key, key, number.written(float(value)))
            for (key, number), value in zip(self._numbers.items(), design, strict=True)
        ]
        return analyse(self._description.machine([*self._overrides, *written]))

    def compile(self, steps: int | None, checked: Array, *, is_for_few: bool = False) -> None:
        """Compile the calculation, or remember why it cannot be; it must give what analyses of some designs do."""
        try:
            kernel = self.kernel(steps, is_for_few=is_for_few)
            self._check(kernel, checked, _SAME if steps is None else _SAMPLED)
        except NotCompiledError as error:
            self.reason, self.at_key = error.reason, error.key
        else:
            self._kernel = kernel

    def kernel(self, steps: int | None = None, **more: Any) -> Kernel:  # noqa: ANN401 - what kernels take
        """Return the calculation compiled; a `NotCompiledError` says why it cannot be."""
        middle = self._spans[:, 1]
        rows, found = [middle], [self.stated]
        for at, (low, _, high) in enumerate(self._spans):
            ends = (low, high) if low < high else middle[at] + np.array([-1, 1]) * _BESIDE * middle[at]
            for end in ends:
                row, results = self._beside(middle, at, end)
                rows.append(row)
                found.append(results)
        if any("crank_range" in one.summary for one in found):
            # dead positions move with the design
            raise NotCompiledError("partial", "crank_range")
        cycle = found[0].machine.cycle
        memories = [one.memory for one in found]
        return Kernel(memories, np.array(rows), self.keys, CrankGrid.from_degrees, cycle=cycle, steps=steps, **more)

    def _beside(self, middle: Array, at: int, end: float) -> tuple[Array, Results]:
        """Return a design with another value of one field, as near to the end of its range as there are machines."""
        for part in _NEARER:
            row = middle.copy()
            row[at] += part * (end - row[at])
            try:
                results = self.results(row)
            except CrankworkError:
                continue
            if all(key in results.memory for key in self.keys):
                return row, results
        raise NotCompiledError("absent", list(self._numbers)[at])

    def _check(self, kernel: Kernel, designs: Array, limit: float) -> None:
        """Refuse a kernel that gives something else than analyses, beside the size of each value."""
        found = kernel(designs)
        size = np.nanmax(np.abs(found.values), axis=1)
        for at, design in enumerate(designs.T):
            try:
                one = self.results(design)
            except CrankworkError:
                continue
            expected = np.array([single(one, key) for key in self.keys])
            if np.any(np.isnan(expected) & np.isfinite(found.values[:, at])):
                raise NotCompiledError("absent", self.keys[int(np.argmax(np.isnan(expected)))])
            apart = np.abs(expected - found.values[:, at]) - limit * size
            if limit > _SAME:
                # of peaks that are level, angles that are passed over may make another the largest
                apart[["_angle" in key for key in self.keys]] = -np.inf
            if found.truncation_error[at] <= CONVERGED and np.any(apart > 0):
                raise NotCompiledError("differs", self.keys[int(np.argmax(apart))])

    def check_at(self, kernel: Kernel, design: Array) -> None:
        """Refuse a kernel that gives something else than the analysis of one design, or no derivatives."""
        found, one = kernel.slopes(design)[0][: len(self.keys)], self.results(design)
        expected = np.array([single(one, key) for key in self.keys])
        if not np.all(np.abs(found - expected) <= _SAME * np.maximum(np.abs(expected), _SAME)):
            raise NotCompiledError("differs", self.keys[0])

    def values(self, designs: Array, *, workers: int = 1, looked_into: int | None = None) -> Values:
        """Return the single values of designs, shape (fields, n), of an analysis each where none are compiled.

        `looked_into`: how many designs without compiled values are analysed to tell why, all by default.
        """
        count = designs.shape[1]
        if self._kernel is None:
            found = BatchResult(np.full((len(self.keys), count), np.nan), np.full(count, np.inf))
        else:
            found = threaded(self._kernel, designs, workers)
        inexact = found.truncation_error > CONVERGED
        absent = ~np.isfinite(found.values).all(axis=0)
        left = np.flatnonzero(inexact)
        left = np.sort(np.concatenate([left, np.flatnonzero(absent & ~inexact)[:looked_into]]))
        values = Values(found.values, {}, left.size)
        for at in left:
            found.values[:, at] = np.nan
            try:
                results = self.results(designs[:, at])
                found.values[:, at] = [single(results, key) for key in self.keys]
                # where there is a machine without such a value it says so
                for key in self.keys:
                    results.value(key)
            except CrankworkError as error:
                values.refused[int(at)] = error
        return values


def single(results: Results, key: str) -> float:
    """Return a single value, also of those that lie between; NaN where there is none."""
    known = results.memory.get(key)
    return results.summary.get(key, math.nan) if known is None or known.varies else known.value


def check_single(results: Results, key: str) -> None:
    """Refuse a key that is no single value of results."""
    known = results.memory.get(key)
    if key not in results.summary and (key in results.columns if known is None else known.varies):
        raise UnknownKeyError(Refusal("sweep_single", key=key[:60]))
    results.value(key)


def threaded(kernel: Kernel, designs: Array, workers: int) -> BatchResult:
    """Return what a kernel gives for all designs, parts of them at the same time."""
    count = designs.shape[1]
    designs = np.ascontiguousarray(designs)
    found = BatchResult(np.empty((len(kernel.keys), count)), np.zeros(count))
    starts = range(0, count, _TOGETHER)
    run: Callable[[int], None] = lambda start: kernel.run(designs, found, start, min(start + _TOGETHER, count))  # noqa: E731
    if workers == 1 or len(starts) == 1:
        for start in starts:
            run(start)
        return found
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(run, starts))
    return found
