"""Chunks of a study: each chunk number gives designs, and the bytes of one Parquet file of their results."""

from __future__ import annotations

import functools
import json
import math
import threading
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.report.display import key_unit
from crankwork.study.ranking import Histogram, Index, Moments, Shares, best_designs, feasible, pareto_front, thin_front
from crankwork.study.roots import reason_of
from crankwork.study.study_file import GRID, LIST, Study
from crankwork.study.variants import MachineVariants
from crankwork.units import coherent_unit, use_units

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
