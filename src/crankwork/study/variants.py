"""Variants of one machine file, calculated at once by a compiled calculation or one by one, and their single values."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Results, analyse
from crankwork.analysis.requested_values import with_requested
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kernel.compiled import CONVERGED, BatchResult, Kernel
from crankwork.kernel.lowering import NotCompiledError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.quantities.key import key_of
from crankwork.report.dataset import check_extras
from crankwork.report.display import key_unit
from crankwork.units import coherent_unit, parse_in, use_units

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# largest relative difference of compiled values and an analysis
_SAME = 1e-9
# the same if peaks may lie between sampled angles
_SAMPLED = 0.1
# relative offset of the second value of a field that does not vary
_OFFSET = 1e-3
# fractions of the distance to the end of a range that are tried
_NEARER = (1.0, 0.5, 0.25, 0.1, 0.01)
# calculations of one machine file, and designs drawn to see whether they have other laws
_MAX_KERNELS, _MAX_FAILURES, _DRAWN = 8, 3, 24
# fraction of designs from which another calculation with friction is worth compiling
_WORTHWHILE = 0.1
# designs of one batch of a thread
_BATCH_SIZE = 4096
# designs analysed to check the compiled calculation
_CHECKED = 4


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
        analysed: dict[bytes, Results] | None = None,
    ) -> None:
        """`analysed`: where results of designs that are traced or checked are kept for other keys."""
        self._description, self._overrides, self._analysed = description, list(overrides), analysed
        self._numbers, self._spans, self.keys = numbers, spans, list(keys)
        # for designs with other laws, each around one of them
        self._kernels: list[Kernel] = []
        # why the calculation is not compiled, the key that shows it, and the single values that do not compile
        self.reason, self.at_key, self.refused = "", "", set[str]()
        self.stated = self._kept(spans[:, 1])
        for key in keys:
            check_single(self.stated, key)
        self.keys = [self.stated.current(key) for key in keys]

    def results(self, design: Array) -> Results:
        """Return the results of one design."""
        written = [number.setting(value) for number, value in zip(self._numbers.values(), design, strict=True)]
        return with_requested(analyse(self._description.machine([*self._overrides, *written])), self.keys)

    def _kept(self, design: Array) -> Results:
        """Return the results of a design that are kept."""
        if self._analysed is None:
            return self.results(design)
        if design.tobytes() not in self._analysed:
            self._analysed[design.tobytes()] = self.results(design)
        return with_requested(self._analysed[design.tobytes()], self.keys)

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
        failures = 0
        while len(self._kernels) < _MAX_KERNELS and failures < _MAX_FAILURES:
            unknown = np.arange(left.shape[1]) > (0 if part < 1.0 else -1)
            try:
                kernel = self.kernel(steps, around=centre, part=part, is_for_few=is_for_few)
                self._check(kernel, checked if part == 1.0 else centre[:, None], limit)
                is_known = _known(kernel(left))
            except NotCompiledError as error:
                failures += 1
                if not self._kernels:
                    self.reason, self.at_key = self.reason or error.reason, self.at_key or error.key
                    self.refused |= error.values
                if error.reason not in ("ways", "absent"):
                    return
            except CrankworkError:
                # there is no such machine
                pass
            else:
                # a calculation that does not know the design it was made for knows no others
                if part == 1.0 or is_known[0]:
                    self._kernels.append(kernel)
                    self.reason, self.at_key, unknown = "", "", ~is_known
                    # friction has so many laws that the next ones would know hardly more
                    failures += _MAX_FAILURES * (kernel.is_iterated and is_known.mean() < _WORTHWHILE)
                else:
                    failures += 1
            left = left[:, unknown]
            if not left.shape[1]:
                return
            centre, part = left[:, 0], _NEARER[-1]

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
        stated = self.stated if np.array_equal(middle, self._spans[:, 1]) else self._kept(middle)
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
        while True:
            traces = [holding_all(sample, self.keys).trace for sample in samples]
            try:
                return Kernel(
                    traces, np.array(rows), self.keys, CrankGrid.from_degrees, cycle=cycle, steps=steps, **more
                )
            except NotCompiledError as error:
                if error.reason != "several_fields" or len(rows) > 1 + 2 * len(self._spans):
                    raise
            # a design in which all fields differ tells sums of them from products
            rows.append(np.array([rows[2 + 2 * index][index] for index in range(len(self._spans))]))
            samples.append(self._kept(rows[-1]))

    def _near(self, middle: Array, index: int, end: float) -> tuple[Array, Results]:
        """Return a design with another value of one field, as close to the end of its range as machines exist."""
        for part in _NEARER:
            row = middle.copy()
            row[index] += part * (end - row[index])
            try:
                results = self._kept(row)
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
                results = self._kept(design)
            except CrankworkError:
                continue
            expected = np.array([single(results, key) for key in self.keys])
            if np.any(np.isnan(expected) & np.isfinite(batch.values[:, index])):
                keys = {key for key, value in zip(self.keys, expected, strict=True) if np.isnan(value)}
                raise NotCompiledError("absent", self.keys[int(np.argmax(np.isnan(expected)))], keys)
            excess = np.abs(expected - batch.values[:, index]) - limit * size
            if limit > _SAME:
                # with sampled angles another of equal peaks may be the largest
                excess[["_angle" in key for key in self.keys]] = -np.inf
            if batch.truncation_error[index] <= CONVERGED and np.any(excess > 0):
                keys = {key for key, more in zip(self.keys, excess, strict=True) if more > 0}
                raise NotCompiledError("differs", self.keys[int(np.argmax(excess))], keys)

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
            missing = np.flatnonzero(~_known(batch))
            if missing.size:
                result = threaded(kernel, designs[:, missing], workers)
                kept = _known(result) | (order == 0)
                batch.values[:, missing[kept]] = result.values[:, kept]
                batch.truncation_error[missing[kept]] = result.truncation_error[kept]
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


def _known(batch: BatchResult) -> NDArray[np.bool_]:
    """Return which designs a calculation has values of, shape (n,)."""
    return (batch.truncation_error <= CONVERGED) & np.isfinite(batch.values).all(axis=0)


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


@dataclass(frozen=True)
class Swept:
    """Single values of designs. [SI]

    Parameters
    ----------
    fields : mapping of str to array, shape (n,)
        Values of the fields, by the keys of the file.
    values : mapping of str to array, shape (n,)
        Single values by key, NaN without a machine.
    refused : mapping of str to int
        Number of designs without a machine, by reason.
    one_by_one : int
        Number of designs analysed one by one.
    reason : str
        Why the calculation was not compiled; empty if it was.
    units : mapping of str to str
        The SI units of fields and values, by their keys.
    about : mapping of str to str
        Origin of the designs, such as the seed of a sample.
    """

    fields: Mapping[str, Array]
    values: Mapping[str, Array] = field(repr=False)
    refused: Mapping[str, int]
    one_by_one: int = 0
    reason: str = ""
    units: Mapping[str, str] = field(default_factory=dict, repr=False)
    about: Mapping[str, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return next(iter(self.fields.values())).size

    def to_xarray(self) -> xr.Dataset:
        """Return fields and values over the designs, the fields as coordinates, with their units as attributes.

        Raises
        ------
        MissingExtraError
            If xarray is not installed.
        """
        check_extras("xarray")
        import xarray as xr  # noqa: PLC0415 - an optional part

        def variables(columns: Mapping[str, Array]) -> dict[str, tuple[str, Array, dict[str, str]]]:
            return {key: ("design", column, {"units": self.units.get(key, "")}) for key, column in columns.items()}

        return xr.Dataset(variables(self.values), variables(self.fields), dict(self.about))

    def to_dataframe(self) -> pd.DataFrame:
        """Return fields and values as a frame, a row for each design; units are among its `attrs`.

        Raises
        ------
        MissingExtraError
            If pandas is not installed.
        """
        check_extras("pandas")
        import pandas as pd  # noqa: PLC0415 - an optional part

        frame = pd.DataFrame({**self.fields, **self.values})
        frame.attrs.update(self.about, units=dict(self.units))
        return frame


def sweep(
    description: Description,
    designs: Mapping[str, Sequence[float | str]],
    keys: Sequence[str],
    *,
    steps: int | None = None,
    overrides: Sequence[str | Setting] = (),
    workers: int | None = None,
) -> Swept:
    """Return single values of many designs of a machine file.

    The calculation of one analysis is compiled and evaluated for all designs at once; extremes and integrals are those
    of the analysis. Designs that are not compiled accurately are analysed one by one.

    Parameters
    ----------
    description : Description
        The machine file.
    designs : mapping of str to sequence
        Values of fields by their keys, as many for each: numbers in SI, or texts with units.
    keys : sequence of str
        Keys of the summary.
    steps : int, optional
        Number of evenly spaced crank angles, if exact extremes and integrals are not needed.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    workers : int, optional
        Number of threads, by default that of the processors.

    Returns
    -------
    Swept
        Fields and values of each design.

    Raises
    ------
    CrankworkError
        If a field or a key does not exist, or the fields have different numbers of values.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> found = crankwork.sweep(d, {"crank.radius": ["40 mm", "50 mm"]}, ["stroke"])
    >>> found.values["stroke"]
    array([0.08, 0.1 ])
    """
    values = description.values_with(overrides)
    numbers = {key: numeric_field(values, key, "") for key in designs}
    columns = [_in_si(numbers[key], column) for key, column in designs.items()]
    if len({len(column) for column in columns}) != 1 or not columns[0]:
        raise CrankworkError(ErrorMessage("sweep_lengths", keys=", ".join(designs)))
    all_designs: Array = np.array(columns)
    spans = np.stack([all_designs.min(axis=1), np.median(all_designs, axis=1), all_designs.max(axis=1)], axis=1)
    machines = MachineVariants(description, numbers, spans, keys, overrides)
    machines.compile(steps, all_designs[:, np.linspace(0, all_designs.shape[1] - 1, _CHECKED).astype(int)])
    result = machines.values(all_designs, workers=workers or os.cpu_count() or 1)
    refused = Counter(str(error) for error in result.refused.values())
    fields = dict(zip(numbers, all_designs, strict=True))
    values_of = dict(zip(keys, result.values, strict=True))
    return Swept(fields, values_of, refused, result.one_by_one, machines.reason, units_of(numbers, keys))


def units_of(numbers: Mapping[str, NumericField], keys: Sequence[str]) -> dict[str, str]:
    """Return the SI units of fields and of single values."""
    with use_units("si"):
        values = {key: coherent_unit(key_unit(key)) for key in keys}
    return {key: coherent_unit(number.unit) if number.unit else "" for key, number in numbers.items()} | values


def _in_si(number: NumericField, values: Sequence[float | str]) -> list[float]:
    try:
        unit = number.unit, number.dimension
        return [parse_in(value, *unit) if isinstance(value, str) else float(value) for value in values]
    except ValueError as error:
        raise CrankworkError(ErrorMessage("option_wrong", option=number.key, mistake=error.args[0])) from None
