"""Chunks of a study: each number gives designs, and one Parquet file of their results; statistics of designs."""

from __future__ import annotations

import functools
import json
import math
import threading
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.report.display import key_unit
from crankwork.study.roots import reason_of
from crankwork.study.study_file import GRID, LIST, Study
from crankwork.study.variants import MachineVariants
from crankwork.units import coherent_unit, use_units

# indices of designs, or a mask
Index = NDArray[Any]

# largest number of bins of a histogram, and of designs of a Pareto set
_BINS, MAX_PARETO = 128, 10_000
_FINEST = -1074
# number of designs from which clearly dominated ones are removed first
_FEW = 2000
# designs of a chunk: with sampled angles, with exact extremes, and analysed one by one
_SAMPLED, _EXACT, _ALONE = 2**16, 2**12, 2**6
# designs without a value that are analysed for the reason, in each chunk
_MAX_EXPLAINED = 32
# designs analysed to check a compiled calculation
_CHECKED = 4
# approximate number of designs plotted for all of them
_SHOWN = 400
# key of the metadata of a part
META = b"crankwork"
NUMBER = "design"
# bits of SciPy's Sobol sequences
_BITS = 30


def pareto_front(costs: Array) -> Index:
    """Return the designs that no other dominates, the first of equal ones; costs of shape (n, m)."""
    if len(costs) > _FEW:
        few = _promising(costs)
        return few[pareto_front(costs[few])] if len(few) < len(costs) else _sorted_out(costs)
    return _sorted_out(costs)


def _promising(costs: Array) -> Index:
    """Return the designs that a few good ones do not dominate."""
    low, high = costs.min(axis=0), costs.max(axis=0)
    shares = (costs - low) / np.where(high > low, high - low, 1.0)
    left = np.arange(len(costs))
    for weights in (np.ones(costs.shape[1]), *(1.0 + 4.0 * np.eye(costs.shape[1]))):
        good = costs[left[np.argmin(shares[left] @ weights)]]
        left = left[np.any(costs[left] < good, axis=1) | np.all(costs[left] == good, axis=1)]
    return left


def _sorted_out(costs: Array) -> Index:
    if len(costs) == 0:
        return np.zeros(0, dtype=np.intp)
    if costs.shape[1] <= 2:
        order = np.lexsort((costs[:, -1], costs[:, 0]))
        last = costs[order, -1]
        least = np.minimum.accumulate(np.concatenate([[np.inf], last[:-1]]))
        return np.sort(order[last < least])
    # a dominating design has the smaller sum, and comes first if rounding makes sums equal
    low, high = costs.min(axis=0), costs.max(axis=0)
    sums = ((costs - low) / np.where(high > low, high - low, 1.0)).sum(axis=1)
    left = np.lexsort((*costs.T[::-1], sums))
    kept = []
    while left.size:
        kept.append(left[0])
        left = left[1:][np.any(costs[left[1:]] < costs[left[0]], axis=1)]
    return np.sort(np.array(kept, dtype=np.intp))


def thin_front(costs: Array, places: Index, most: int = MAX_PARETO) -> Index:
    """Return at most so many designs of a Pareto set, evenly spaced along the first objective, with its ends."""
    if len(places) <= most:
        return places
    order = places[np.argsort(costs[places, 0], kind="stable")]
    return np.sort(order[np.linspace(0, len(order) - 1, most).astype(np.intp)])


def best_designs(cost: Array, count: int) -> Index:
    """Return the designs with the smallest cost in order; of equal ones the first."""
    near = np.arange(len(cost))
    if len(cost) > count:
        near = np.flatnonzero(cost <= np.partition(cost, count)[count])
    return near[np.argsort(cost[near], kind="stable")[:count]]


@dataclass
class Moments:
    """Count, extremes and sums of values about a value close to them."""

    near: float
    count: int = 0
    low: float = math.inf
    high: float = -math.inf
    total: float = 0.0
    squares: float = 0.0

    @classmethod
    def of(cls, values: Array, near: float) -> Moments:
        """Return the moments of finite values."""
        if not values.size:
            return cls(near)
        away = values - near
        return cls(near, values.size, float(values.min()), float(values.max()), float(away.sum()), float(away @ away))

    def add(self, other: Moments) -> None:
        """Add moments about the same value."""
        self.count += other.count
        self.low, self.high = min(self.low, other.low), max(self.high, other.high)
        self.total += other.total
        self.squares += other.squares

    @property
    def mean(self) -> float:
        """The mean."""
        return self.near + self.total / self.count if self.count else math.nan

    @property
    def deviation(self) -> float:
        """The standard deviation of the values as a sample."""
        if self.count < 2:
            return math.nan
        return math.sqrt(max(self.squares - self.total**2 / self.count, 0.0) / (self.count - 1))


@dataclass
class Histogram:
    """Number of values in each of at most 128 bins of the width 2^exponent, starting at `first` times the width.

    Widths that are powers of two can be doubled exactly, so that the order of histograms does not change their sum.
    """

    exponent: int = _FINEST
    first: int = 0
    counts: list[int] = field(default_factory=list)

    @classmethod
    def of(cls, values: Array) -> Histogram:
        """Return the histogram of finite values."""
        if not values.size:
            return cls()
        low, high = float(values.min()), float(values.max())
        # a bin for equal values is about 1e-13 of them wide, for zeros the finest
        size = max(high - low, abs(high), abs(low))
        exponent = max(math.frexp(size)[1] - 44, _FINEST) if size else _FINEST
        exponent = max(exponent, math.frexp((high - low) / _BINS)[1] - 1 if high > low else exponent)
        while math.floor(high / 2.0**exponent) - math.floor(low / 2.0**exponent) >= _BINS:
            exponent += 1
        places = np.floor(values / 2.0**exponent).astype(np.int64)
        first = int(places.min())
        return cls(exponent, first, np.bincount(places - first).tolist())

    def add(self, other: Histogram) -> None:
        """Add another histogram."""
        if not other.counts:
            return
        if not self.counts:
            self.exponent, self.first, self.counts = other.exponent, other.first, list(other.counts)
            return
        exponent = max(self.exponent, other.exponent)
        own, added = self._coarser(exponent), other._coarser(exponent)
        while max(own.end, added.end) - min(own.first, added.first) > _BINS:
            exponent += 1
            own, added = own._coarser(exponent), added._coarser(exponent)  # noqa: SLF001
        first = min(own.first, added.first)
        counts = np.zeros(max(own.end, added.end) - first, dtype=np.int64)
        for part in (own, added):
            counts[part.first - first : part.end - first] += np.array(part.counts, dtype=np.int64)
        self.exponent, self.first, self.counts = exponent, first, counts.tolist()

    @property
    def end(self) -> int:
        """Number of the bin after the last."""
        return self.first + len(self.counts)

    @property
    def edges(self) -> Array:
        """Edges of the bins."""
        return np.asarray(np.arange(self.first, self.end + 1) * 2.0**self.exponent)

    def _coarser(self, exponent: int) -> Histogram:
        if exponent == self.exponent:
            return self
        places = np.arange(self.first, self.end) >> min(exponent - self.exponent, 62)
        first = int(places[0])
        return Histogram(exponent, first, np.bincount(places - first, weights=self.counts).astype(int).tolist())


@dataclass
class Shares:
    """Sums over points for the Sobol indices of one value: first order by Saltelli, total by Jansen.

    `products`, `differences`: sums of the estimates for each field, and of their squares.
    """

    near: float
    points: int = 0
    total: float = 0.0
    squares: float = 0.0
    products: Array = field(default_factory=lambda: np.zeros((2, 0)))
    differences: Array = field(default_factory=lambda: np.zeros((2, 0)))

    @classmethod
    def of(cls, values: Array, near: float) -> Shares:
        """Return the sums of values of shape (points, fields + 2); points with a missing value are left out."""
        away = values[np.isfinite(values).all(axis=1)] - near
        first, second, mixed = away[:, :1], away[:, 1:2], away[:, 2:]
        products, differences = second * (mixed - first), (first - mixed) ** 2 / 2
        either = away[:, :2]
        total, squares = float(either.sum()), float((either**2).sum())
        sums = (np.array([terms.sum(axis=0), (terms**2).sum(axis=0)]) for terms in (products, differences))
        return cls(near, len(away), total, squares, *sums)

    def add(self, other: Shares) -> None:
        """Add sums about the same value."""
        self.points += other.points
        self.total += other.total
        self.squares += other.squares
        is_first = self.products.shape[1] == 0
        self.products = other.products if is_first else self.products + other.products
        self.differences = other.differences if is_first else self.differences + other.differences

    def indices(self) -> tuple[Array, Array, Array, Array] | None:
        """Return first-order indices and their errors, total ones and their errors; None if nothing varies."""
        if self.points < 2:
            return None
        variance = self.squares / (2 * self.points) - (self.total / (2 * self.points)) ** 2
        if variance <= (1e-13 * self.near) ** 2:
            return None
        indices = []
        for sums in (self.products, self.differences):
            mean = sums[0] / self.points
            error = np.sqrt(np.maximum(sums[1] / self.points - mean**2, 0.0) / self.points)
            indices += [mean / variance, error / variance]
        return indices[0], indices[1], indices[2], indices[3]


def feasible(values: Sequence[Array], limits: Sequence[tuple[float, float]], count: int) -> Index:
    """Return whether each design satisfies all limits; NaN does not."""
    is_feasible = np.ones(count, dtype=bool)
    for column, (low, high) in zip(values, limits, strict=True):
        is_feasible &= (column >= low) & (column <= high)
    return is_feasible


class PreparedStudy:
    """A study ready to be calculated; the calculation is compiled for each choice of the non-numeric fields."""

    def __init__(self, study: Study) -> None:
        self.study, self._lock = study, threading.Lock()
        self._numbers = [index for index, variable in enumerate(study.varied) if variable.number is not None]
        self._words = [index for index, variable in enumerate(study.varied) if variable.number is None]
        self._machines: dict[tuple[int, ...], MachineVariants | CrankworkError] = {}
        self._few = designs_of(study, 8, 0)[:, :_CHECKED]
        first = self._chosen(tuple(int(index) for index in self._few[self._words, 0]))
        self.reason = first.reason if isinstance(first, MachineVariants) else "absent"
        self.at_key = first.at_key if isinstance(first, MachineVariants) else study.keys[0]
        rows = study.chunk or (_ALONE if self.reason else _SAMPLED if study.angles else _EXACT)
        self.block = block_of(study)
        self.points = 1 << max((rows // self.block).bit_length() - 1, 0)
        self.chunks = -(-(study.count // self.block) // self.points)

    def _chosen(self, words: tuple[int, ...]) -> MachineVariants | CrankworkError:
        """Return the variants with one choice of the non-numeric fields, or the error that prevents them."""
        with self._lock:
            if words not in self._machines:
                try:
                    self._machines[words] = self._with(words)
                except CrankworkError as error:
                    self._machines[words] = error
            return self._machines[words]

    def _with(self, words: tuple[int, ...]) -> MachineVariants:
        study = self.study
        settings = [study.varied[index].setting(value) for index, value in zip(self._words, words, strict=True)]
        varied = [study.varied[index] for index in self._numbers]
        numbers = {variable.key: variable.number for variable in varied if variable.number is not None}
        spans = np.array([variable.span for variable in varied]).reshape(len(varied), 3)
        machines = MachineVariants(study.machine, numbers, spans, study.keys, [*study.overrides, *settings])
        machines.compile(study.angles, self._few[self._numbers])
        return machines

    def values(self, designs: Array) -> tuple[Array, dict[int, CrankworkError], int]:
        """Return single values of designs, errors by design, and the number of designs analysed one by one."""
        count = designs.shape[1]
        values, alone = np.full((len(self.study.keys), count), np.nan), 0
        refused: dict[int, CrankworkError] = {}
        inside = np.ones(count, dtype=bool)
        for index in self._numbers:
            number = self.study.varied[index].number
            assert number is not None  # noqa: S101 - numeric fields only
            out = (designs[index] < number.low) | (designs[index] > number.high)
            refused |= dict.fromkeys(np.flatnonzero(out & inside).tolist(), outside(number.key))
            inside &= ~out
        choices, choice_of = np.unique(designs[self._words].T, axis=0, return_inverse=True)
        for index, choice in enumerate(choices):
            rows = np.flatnonzero((choice_of.reshape(-1) == index) & inside)
            machines = self._chosen(tuple(int(word) for word in choice))
            if isinstance(machines, CrankworkError):
                refused |= dict.fromkeys(rows.tolist(), machines)
                continue
            part = machines.values(
                designs[self._numbers][:, rows], explained=None if machines.reason else _MAX_EXPLAINED
            )
            values[:, rows] = part.values
            refused |= {int(rows[row]): error for row, error in part.refused.items()}
            alone += part.one_by_one
        return values, refused, alone


def outside(key: str) -> CrankworkError:
    """Return the error of a drawn value outside the range of its field."""
    return CrankworkError(ErrorMessage("vary_outside", key=key))


_cache: dict[str, PreparedStudy] = {}
_cache_lock = threading.Lock()


def prepared_study(study: Study) -> PreparedStudy:
    """Return a study ready to be calculated; the last one is cached in this process."""
    with _cache_lock:
        if study.digest not in _cache:
            _cache.clear()
            _cache[study.digest] = PreparedStudy(study)
        return _cache[study.digest]


@dataclass
class StudyAggregate:
    """Aggregate of designs in SI: counts, sums, and rows of the best, of the Pareto set and of the plotted designs.

    `refused`: by kind of error, the number of designs without any value and the first message; `alone`: why the
    calculation is not compiled and the key that shows it, or None.
    """

    numbers: Index
    fields: Array
    values: Array
    designs: int = 0
    within: int = 0
    one_by_one: int = 0
    refused: dict[str, tuple[int, str]] = field(default_factory=dict)
    moments: dict[str, Moments] = field(default_factory=dict)
    histograms: dict[str, Histogram] = field(default_factory=dict)
    shares: dict[str, Shares] = field(default_factory=dict)
    is_thinned: bool = False
    alone: tuple[str, str] | None = None

    def add(self, study: Study, other: StudyAggregate) -> None:
        """Add the aggregate of the following designs."""
        self.numbers = np.concatenate([self.numbers, other.numbers])
        self.fields = np.concatenate([self.fields, other.fields], axis=1)
        self.values = np.concatenate([self.values, other.values], axis=1)
        rows, is_thinned = kept_of(study, self.numbers, self.values)
        self.numbers, self.fields, self.values = self.numbers[rows], self.fields[:, rows], self.values[:, rows]
        self.is_thinned |= other.is_thinned or is_thinned
        self.designs += other.designs
        self.within += other.within
        self.one_by_one += other.one_by_one
        for kind, (count, reason) in other.refused.items():
            before, first = self.refused.get(kind, (0, reason))
            self.refused[kind] = before + count, first
        for key in study.keys:
            self.moments[key].add(other.moments[key])
            self.histograms[key].add(other.histograms[key])
            if other.shares:
                self.shares[key].add(other.shares[key])


def empty_aggregate(study: Study) -> StudyAggregate:
    """Return the aggregate of no designs."""
    none = np.zeros(0)
    fields, values = none.reshape(len(study.varied), 0), none.reshape(len(study.keys), 0)
    aggregate = StudyAggregate(none.astype(np.int64), fields, values)
    for key in study.keys:
        near = study.stated[key]
        aggregate.moments[key], aggregate.histograms[key] = Moments(near), Histogram()
        if block_of(study) > 1:
            aggregate.shares[key] = Shares(near)
    return aggregate


def calculate_chunk(study: Study, chunk: int) -> StudyAggregate:
    """Return the aggregate of a chunk, with all its designs."""
    prepared = prepared_study(study)
    fields = designs_of(study, prepared.points, chunk)
    values, refused, alone = prepared.values(fields)
    count = fields.shape[1]
    numbers = np.arange(count) + chunk * prepared.points * prepared.block
    aggregate = StudyAggregate(numbers, fields, values, count, int(feasible_designs(study, values).sum()), alone)
    absent = int((~np.isfinite(values).any(axis=0)).sum()) - len(refused)
    for design in sorted(refused):
        _count(aggregate.refused, reason_of(refused[design]), 1)
    if absent > 0:
        _count(aggregate.refused, ErrorMessage("vary_unlooked"), absent)
    for key, row in zip(study.keys, values, strict=True):
        finite, near = row[np.isfinite(row)], study.stated[key]
        aggregate.moments[key] = Moments.of(finite, near)
        aggregate.histograms[key] = Histogram.of(finite)
        if prepared.block > 1:
            aggregate.shares[key] = Shares.of(row.reshape(-1, prepared.block), near)
    return aggregate


def feasible_designs(study: Study, values: Array) -> Index:
    """Return whether each design has the values of objectives and limits, and satisfies the limits."""
    place = {key: row for row, key in enumerate(study.keys)}
    is_within = feasible([values[place[key]] for key in study.limits], list(study.limits.values()), values.shape[1])
    objectives = values[[place[key] for key in study.objectives]]
    return np.asarray(is_within & np.isfinite(objectives).all(axis=0))


def is_shown(study: Study, numbers: Index) -> Index:
    """Return whether each design is plotted: every design whose number is a multiple of a prime."""
    stride = max(study.count // _SHOWN, 1)
    # a prime has no common divisor with the rows and columns of a grid
    while not all(stride % divisor for divisor in range(2, math.isqrt(stride) + 1)):
        stride += 1
    return np.asarray(numbers % stride == 0)


def kept_of(study: Study, numbers: Index, values: Array) -> tuple[Index, bool]:
    """Return the designs to keep and whether their Pareto set was thinned.

    Kept are the best designs of each objective, the Pareto set and the plotted designs.
    """
    rows = np.flatnonzero(feasible_designs(study, values))
    ranked, pareto, is_thinned = ranks(study, values[:, rows])
    selected = [rows[chosen] for chosen in (*ranked.values(), pareto)]
    selected.append(np.flatnonzero(is_shown(study, numbers)))
    return np.unique(np.concatenate(selected)) if study.objectives else rows[:0], is_thinned


def ranks(study: Study, values: Array) -> tuple[dict[str, Index], Index, bool]:
    """Return the best designs for each objective, the Pareto set, and whether it was thinned."""
    place = {key: row for row, key in enumerate(study.keys)}
    costs = np.array([sign * values[place[key]] for key, sign in study.objectives.items()]).T
    ranked = {key: best_designs(costs[:, column], study.best) for column, key in enumerate(study.objectives)}
    if len(study.objectives) < 2:
        return ranked, np.zeros(0, dtype=np.intp), False
    full_front = pareto_front(costs)
    pareto = thin_front(costs, full_front)
    return ranked, pareto, len(pareto) < len(full_front)


def by_kind(reasons: Iterable[str]) -> Counter[str]:
    """Count the messages of each kind under the first of the kind: texts differ in their numbers."""
    first, counts = dict[str, str](), Counter[str]()
    for reason in reasons:
        counts[first.setdefault(getattr(reason, "name", reason), reason)] += 1
    return counts


def _count(refused: dict[str, tuple[int, str]], reason: str, count: int) -> None:
    kind = reason.name if isinstance(reason, ErrorMessage) else "other"
    before, first = refused.get(kind, (0, reason))
    refused[kind] = before + count, first


def part_of(study: Study, chunk: int) -> bytes:
    """Return the Parquet file of a chunk."""
    aggregate = calculate_chunk(study, chunk)
    kept, aggregate.is_thinned = kept_of(study, aggregate.numbers, aggregate.values)
    rows = np.arange(aggregate.designs) if study.has_rows else kept
    meta = {
        "chunk": chunk,
        "study": study.digest,
        "seed": study.seed,
        "kept": kept.tolist() if study.has_rows else None,
        "refused": {kind: [count, _to_json(reason)] for kind, (count, reason) in aggregate.refused.items()},
        "moments": {key: asdict(stored) for key, stored in aggregate.moments.items()},
        "histograms": {key: asdict(stored) for key, stored in aggregate.histograms.items()},
        "shares": {key: asdict(stored) for key, stored in aggregate.shares.items()},
        **{name: getattr(aggregate, name) for name in ("designs", "within", "one_by_one", "is_thinned")},
    }
    return parquet_bytes(study, aggregate.numbers[rows], aggregate.fields[:, rows], aggregate.values[:, rows], meta)


def parquet_bytes(study: Study, numbers: Index, fields: Array, values: Array, meta: Mapping[str, Any]) -> bytes:
    """Return rows as a Parquet file with the units of columns and the metadata of the chunk."""
    import pyarrow as pa  # noqa: PLC0415 - an optional part
    import pyarrow.parquet as pq  # noqa: PLC0415

    columns, kinds = [pa.array(numbers)], [pa.field(NUMBER, pa.int64(), nullable=False)]
    for variable, column in zip(study.varied, fields, strict=True):
        if variable.number is None:
            columns.append(pa.array([str(variable.values[int(index)]) for index in column], pa.string()))
            kinds.append(pa.field(variable.key, pa.string()))
        else:
            columns.append(pa.array(column))
            kinds.append(pa.field(variable.key, pa.float64(), metadata={"unit": coherent_unit(variable.number.unit)}))
    with use_units("si"):
        for key, column in zip(study.keys, values, strict=True):
            columns.append(pa.array(column))
            kinds.append(pa.field(key, pa.float64(), metadata={"unit": coherent_unit(key_unit(key))}))
    table = pa.Table.from_arrays(columns, schema=pa.schema(kinds, {META: json.dumps(meta, default=np.ndarray.tolist)}))
    sink = pa.BufferOutputStream()
    # numbers hardly compress; the checksum detects damaged files
    pq.write_table(table, sink, compression="NONE", use_dictionary=False, write_page_checksum=True)
    return bytes(sink.getvalue())


def read_part(study: Study, chunk: int, data: bytes) -> StudyAggregate:
    """Return the aggregate in a part; raise ValueError if it is not that part."""
    import pyarrow as pa  # noqa: PLC0415 - an optional part
    import pyarrow.parquet as pq  # noqa: PLC0415

    try:
        table = pq.read_table(pa.BufferReader(data), page_checksum_verification=True)
        meta = json.loads(table.schema.metadata[META])
        if (meta["chunk"], meta["study"]) != (chunk, study.digest):
            raise ValueError("of another chunk")
        if meta["kept"] is not None:
            table = table.take(pa.array(meta["kept"], pa.int64()))
        return _read(study, table, meta)
    except (OSError, KeyError, TypeError, pa.ArrowException) as error:
        raise ValueError(str(error)) from error


def _read(study: Study, table: Any, meta: dict[str, Any]) -> StudyAggregate:  # noqa: ANN401 - pyarrow has no types
    fields = []
    for variable in study.varied:
        column = table[variable.key].to_numpy()
        if variable.number is None:
            places = {str(value): index for index, value in enumerate(variable.values)}
            column = np.array([places[value] for value in column], dtype=float)
        fields.append(column)
    values = [table[key].to_numpy() for key in study.keys]
    return StudyAggregate(
        numbers=table[NUMBER].to_numpy(),
        fields=np.array(fields, dtype=float).reshape(len(fields), table.num_rows),
        values=np.array(values, dtype=float).reshape(len(values), table.num_rows),
        refused={kind: (count, _reason(reason)) for kind, (count, reason) in meta["refused"].items()},
        moments={key: Moments(**stored) for key, stored in meta["moments"].items()},
        histograms={key: Histogram(**stored) for key, stored in meta["histograms"].items()},
        shares={key: Shares(**_arrays(stored)) for key, stored in meta["shares"].items()},
        **{name: meta[name] for name in ("designs", "within", "one_by_one", "is_thinned")},
    )


def _arrays(values: dict[str, Any]) -> dict[str, Any]:
    return {name: np.array(value) if isinstance(value, list) else value for name, value in values.items()}


def _to_json(reason: object) -> Any:  # noqa: ANN401 - plain data
    """Return a message as JSON data from which it can be translated again."""
    match reason:
        case ErrorMessage():
            return {"name": reason.name, "values": {key: _to_json(value) for key, value in reason.values.items()}}
        case tuple() | list():
            return [isinstance(reason, tuple), [_to_json(entry) for entry in reason]]
        case bool() | int() | float():
            return reason
        case _:
            return str(reason)


def _reason(data: Any) -> Any:  # noqa: ANN401 - plain data
    match data:
        case {"name": name, "values": values}:
            return ErrorMessage(name, **{key: _reason(value) for key, value in values.items()})
        case [bool(is_tuple), list(entries)]:
            return tuple(map(_reason, entries)) if is_tuple else [_reason(entry) for entry in entries]
        case _:
            return data


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
