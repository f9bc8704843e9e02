"""Variants of one machine file: many are calculated at once by a compiled calculation, the others one by one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.analysis.requested_values import with_requested
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kernel.compiled import CONVERGED, BatchResult, Kernel
from crankwork.kernel.lowering import NotCompiledError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.quantities.key import key_of

# largest relative difference of compiled values and an analysis
_SAME = 1e-9
# the same if peaks may lie between sampled angles
_SAMPLED = 0.1
# relative offset of the second value of a field that does not vary
_OFFSET = 1e-3
# fractions of the distance to the end of a range that are tried
_NEARER = (1.0, 0.5, 0.25, 0.1, 0.01)
# calculations of one machine file, and designs drawn to see whether they have other laws
_MAX_KERNELS, _DRAWN = 8, 24
# designs of one batch of a thread
_BATCH_SIZE = 4096


@dataclass
class DesignValues:
    """Single values of designs, shape (keys, n), and the errors of designs without a machine. [SI]"""

    values: Array = field(repr=False)
    refused: dict[int, CrankworkError]
    one_by_one: int = 0


class MachineVariants:
    """Variants of a machine file with other values of some numbers.

    `spans`: least, intermediate and largest value of each number, shape (fields, 3). [SI]
    """

    def __init__(
        self,
        description: Description,
        numbers: Mapping[str, NumericField],
        spans: Array,
        keys: Sequence[str],
        overrides: Sequence[str | Setting] = (),
    ) -> None:
        self._description, self._overrides = description, list(overrides)
        self._numbers, self._spans, self.keys = numbers, spans, list(keys)
        # for designs with other laws, each around one of them
        self._kernels: list[Kernel] = []
        # why the calculation is not compiled, and the key that shows it
        self.reason, self.at_key = "", ""
        self.stated = self.results(spans[:, 1])
        for key in keys:
            check_single(self.stated, key)
        self.keys = [self.stated.current(key) for key in keys]

    def results(self, design: Array) -> Results:
        """Return the results of one design."""
        written = [
            Setting(key, key, number.written(float(value)))
            for (key, number), value in zip(self._numbers.items(), design, strict=True)
        ]
        return with_requested(analyse(self._description.machine([*self._overrides, *written])), self.keys)

    def compile(self, steps: int | None, checked: Array, *, is_for_few: bool = False) -> None:
        """Compile the calculation and check it against analyses of some designs; store the reason if that fails.

        A calculation follows the laws of the designs that it was traced from. Designs that have other laws, such as a
        force that begins earlier in the cycle than another one, get a calculation of their own, as far as they are
        among those checked or drawn.
        """
        limit = _SAME if steps is None else _SAMPLED
        low, _, high = self._spans.T[:, :, None]
        drawn = low + (high - low) * np.random.default_rng(0).random((len(low), _DRAWN))
        left, centre, part = np.concatenate([checked, drawn], axis=1), self._spans[:, 1], 1.0
        for _ in range(_MAX_KERNELS):
            try:
                kernel = self.kernel(steps, around=centre, part=part, is_for_few=is_for_few)
                self._check(kernel, checked if part == 1.0 else centre[:, None], limit)
            except NotCompiledError as error:
                if not self._kernels:
                    self.reason, self.at_key = self.reason or error.reason, self.at_key or error.key
                if error.reason not in ("ways", "absent"):
                    return
            except CrankworkError:
                # there is no such machine
                pass
            else:
                self._kernels.append(kernel)
                self.reason = self.at_key = ""
                batch = kernel(left)
                is_known = (batch.truncation_error <= CONVERGED) & np.isfinite(batch.values).all(axis=0)
                left = left[:, ~is_known]
            if not left.shape[1]:
                return
            centre, left, part = left[:, 0], left[:, 1:], _NEARER[-1]

    def kernel(
        self,
        steps: int | None = None,
        *,
        around: Array | None = None,
        part: float = 1.0,
        **more: Any,  # noqa: ANN401 - options of kernels
    ) -> Kernel:
        """Return the compiled calculation; raise NotCompiledError if it cannot be compiled.

        `around`: the design that numbers are varied from, over a `part` of their ranges; else the intermediate one.
        """
        middle = self._spans[:, 1] if around is None else around
        stated = self.stated if around is None else self.results(middle)
        rows, samples = [middle], [stated]
        for index, (low, _, high) in enumerate(self._spans):
            ends = (low, high) if low < high else middle[index] + np.array([-1, 1]) * _OFFSET * middle[index]
            for end in ends:
                row, results = self._near(middle, index, middle[index] + part * (end - middle[index]))
                rows.append(row)
                samples.append(results)
        if any("crank_range" in sample.summary for sample in samples):
            # limit positions move with the design
            raise NotCompiledError("partial", "crank_range")
        cycle = samples[0].machine.cycle
        traces = [holding_all(sample, self.keys).trace for sample in samples]
        return Kernel(traces, np.array(rows), self.keys, CrankGrid.from_degrees, cycle=cycle, steps=steps, **more)

    def _near(self, middle: Array, index: int, end: float) -> tuple[Array, Results]:
        """Return a design with another value of one field, as close to the end of its range as machines exist."""
        for part in _NEARER:
            row = middle.copy()
            row[index] += part * (end - row[index])
            try:
                results = self.results(row)
            except CrankworkError:
                continue
            if all(key in holding_all(results, self.keys).trace for key in self.keys):
                return row, results
        raise NotCompiledError("absent", list(self._numbers)[index])

    def _check(self, kernel: Kernel, designs: Array, limit: float) -> None:
        """Raise NotCompiledError if compiled values differ from analyses, relative to the size of each value."""
        batch = kernel(designs)
        size = np.nanmax(np.abs(batch.values), axis=1)
        for index, design in enumerate(designs.T):
            try:
                results = self.results(design)
            except CrankworkError:
                continue
            expected = np.array([single(results, key) for key in self.keys])
            if np.any(np.isnan(expected) & np.isfinite(batch.values[:, index])):
                raise NotCompiledError("absent", self.keys[int(np.argmax(np.isnan(expected)))])
            excess = np.abs(expected - batch.values[:, index]) - limit * size
            if limit > _SAME:
                # with sampled angles another of equal peaks may be the largest
                excess[["_angle" in key for key in self.keys]] = -np.inf
            if batch.truncation_error[index] <= CONVERGED and np.any(excess > 0):
                raise NotCompiledError("differs", self.keys[int(np.argmax(excess))])

    def check_at(self, kernel: Kernel, design: Array) -> None:
        """Raise NotCompiledError if compiled values differ from the analysis of one design."""
        compiled, results = kernel.slopes(design)[0][: len(self.keys)], self.results(design)
        expected = np.array([single(results, key) for key in self.keys])
        if not np.all(np.abs(compiled - expected) <= _SAME * np.maximum(np.abs(expected), _SAME)):
            raise NotCompiledError("differs", self.keys[0])

    def values(self, designs: Array, *, workers: int = 1, explained: int | None = None) -> DesignValues:
        """Return the single values of designs, shape (fields, n); without a compiled calculation each is analysed.

        `explained`: how many designs without compiled values are analysed for the reason, all by default.
        """
        count = designs.shape[1]
        batch = BatchResult(np.full((len(self.keys), count), np.nan), np.full(count, np.inf))
        for order, kernel in enumerate(self._kernels):
            others = np.flatnonzero(~((batch.truncation_error <= CONVERGED) & np.isfinite(batch.values).all(axis=0)))
            if others.size:
                found = threaded(kernel, designs[:, others], workers)
                is_better = (found.truncation_error <= CONVERGED) & np.isfinite(found.values).all(axis=0)
                kept = is_better | (order == 0)
                batch.values[:, others[kept]] = found.values[:, kept]
                batch.truncation_error[others[kept]] = found.truncation_error[kept]
        inexact = batch.truncation_error > CONVERGED
        absent = ~np.isfinite(batch.values).all(axis=0)
        left = np.flatnonzero(inexact)
        left = np.sort(np.concatenate([left, np.flatnonzero(absent & ~inexact)[:explained]]))
        values = DesignValues(batch.values, {}, left.size)
        for index in left:
            batch.values[:, index] = np.nan
            try:
                results = self.results(designs[:, index])
                batch.values[:, index] = [single(results, key) for key in self.keys]
                # raises the reason if a machine has no such value
                for key in self.keys:
                    results.value(key)
            except CrankworkError as error:
                values.refused[int(index)] = error
        return values


def single(results: Results, key: str) -> float:
    """Return a single value, also an intermediate one; NaN if there is none."""
    results = results.holding(key)
    known = results.trace.get(key)
    return results.summary.get(key, math.nan) if known is None or known.varies else known.value


def holding_all(results: Results, keys: Sequence[str]) -> Results:
    """Return results that have every key: with those of the other form of the machine where a key is one of these."""
    return results if all(key in results.trace for key in keys) else results.complete


def check_single(results: Results, key: str) -> None:
    """Raise UnknownKeyError if a key is not a single value of results."""
    results = results.holding(key)
    known = results.trace.get(key)
    if key not in results.summary and (key in results.columns if known is None else known.varies):
        values = {"at": f"{key[:60]}@90deg", "largest": key_of(key[:60]).derived("_max")}
        raise UnknownKeyError(ErrorMessage("single_needed", key=key[:60], **values))
    results.value(key)


def threaded(kernel: Kernel, designs: Array, workers: int) -> BatchResult:
    """Return the compiled values of all designs, calculated in threads."""
    count = designs.shape[1]
    designs = np.ascontiguousarray(designs)
    batch = BatchResult(np.empty((len(kernel.keys), count)), np.zeros(count))
    starts = range(0, count, _BATCH_SIZE)
    run: Callable[[int], None] = lambda start: kernel.run(designs, batch, start, min(start + _BATCH_SIZE, count))  # noqa: E731
    if workers == 1 or len(starts) == 1:
        for start in starts:
            run(start)
        return batch
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(run, starts))
    return batch
