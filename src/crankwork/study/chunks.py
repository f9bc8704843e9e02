"""A chunk of a study: a function of study and number that gives the bytes of a Parquet file."""

from __future__ import annotations

import itertools
import json
import math
import threading
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from crankwork.errors import CrankworkError, InputError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.report.language import key_unit
from crankwork.study.designs import block_of, designs_of
from crankwork.study.machines import Machines
from crankwork.study.ranking import Histogram, Index, Moments, Shares, best, feasible, front, thinned
from crankwork.study.study_file import Study
from crankwork.units import coherent_unit, use_units

# designs of a chunk: at evenly spaced angles, with exact extremes, and analysed one by one
_SAMPLED, _EXACT, _ALONE = 2**16, 2**12, 2**6
# designs of a chunk without a value that are analysed to tell why
_LOOKED_INTO = 32
# designs that are calculated both ways before a kernel is believed
_CHECKED = 4
# how many designs stand for all of them in figures, about
_SHOWN = 400
# what stands in the metadata of a part
META = b"crankwork"
NUMBER = "design"


class Opened:
    """A study ready to be calculated: what compiles is compiled for each choice of words."""

    def __init__(self, study: Study) -> None:
        self.study, self._lock = study, threading.Lock()
        self._numbers = [at for at, one in enumerate(study.varied) if one.number is not None]
        self._words = [at for at, one in enumerate(study.varied) if one.number is None]
        self._machines: dict[tuple[int, ...], Machines | CrankworkError] = {}
        self._few = designs_of(study, 8, 0)[:, :_CHECKED]
        first = self._chosen(tuple(int(at) for at in self._few[self._words, 0]))
        self.reason = first.reason if isinstance(first, Machines) else "absent"
        self.at_key = first.at_key if isinstance(first, Machines) else study.keys[0]
        rows = study.chunk or (_ALONE if self.reason else _SAMPLED if study.angles else _EXACT)
        self.block = block_of(study)
        self.points = 1 << max((rows // self.block).bit_length() - 1, 0)
        self.chunks = -(-(study.count // self.block) // self.points)

    def _chosen(self, words: tuple[int, ...]) -> Machines | CrankworkError:
        """Return the machines of one choice of words, or why there are none."""
        with self._lock:
            if words not in self._machines:
                try:
                    self._machines[words] = self._with(words)
                except CrankworkError as error:
                    self._machines[words] = error
            return self._machines[words]

    def _with(self, words: tuple[int, ...]) -> Machines:
        study = self.study
        settings = [study.varied[at].setting(value) for at, value in zip(self._words, words, strict=True)]
        varied = [study.varied[at] for at in self._numbers]
        numbers = {one.key: one.number for one in varied if one.number is not None}
        spans = np.array([one.span for one in varied]).reshape(len(varied), 3)
        machines = Machines(study.machine, numbers, spans, study.keys, [*study.overrides, *settings])
        machines.compile(study.angles, self._few[self._numbers])
        return machines

    def values(self, designs: Array) -> tuple[Array, dict[int, CrankworkError], int]:
        """Return single values of designs, why there are none, and how many were analysed one by one."""
        count = designs.shape[1]
        found, alone = np.full((len(self.study.keys), count), np.nan), 0
        refused: dict[int, CrankworkError] = {}
        inside = np.ones(count, dtype=bool)
        for at in self._numbers:
            number = self.study.varied[at].number
            assert number is not None  # noqa: S101 - one that has
            out = (designs[at] < number.low) | (designs[at] > number.high)
            refused |= dict.fromkeys(np.flatnonzero(out & inside).tolist(), outside(number.key))
            inside &= ~out
        choices, of = np.unique(designs[self._words].T, axis=0, return_inverse=True)
        for at, choice in enumerate(choices):
            rows = np.flatnonzero((of.reshape(-1) == at) & inside)
            machines = self._chosen(tuple(int(one) for one in choice))
            if isinstance(machines, CrankworkError):
                refused |= dict.fromkeys(rows.tolist(), machines)
                continue
            part = machines.values(
                designs[self._numbers][:, rows], looked_into=None if machines.reason else _LOOKED_INTO
            )
            found[:, rows] = part.of
            refused |= {int(rows[at]): error for at, error in part.refused.items()}
            alone += part.one_by_one
        return found, refused, alone


def outside(key: str) -> CrankworkError:
    """Return why there is no machine with a drawn value."""
    return CrankworkError(Refusal("vary_outside", key=key))


_kept: dict[str, Opened] = {}
_keeping = threading.Lock()


def opened(study: Study) -> Opened:
    """Return a study ready to be calculated; of this process the last one is kept."""
    with _keeping:
        if study.digest not in _kept:
            _kept.clear()
            _kept[study.digest] = Opened(study)
        return _kept[study.digest]


@dataclass
class Reduced:
    """What is kept of designs, SI: counts and sums, and rows of the best ones, of the Pareto set and of some of all.

    `refused`: by the kind of reason how many designs have none of the values, and the reason of the first one;
    `alone`: why the calculation is not compiled and of what that shows, if it is not.
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

    def add(self, study: Study, other: Reduced) -> None:
        """Add what is kept of the designs that come next."""
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


def nothing(study: Study) -> Reduced:
    """Return what is kept of no designs."""
    none = np.zeros(0)
    fields, values = none.reshape(len(study.varied), 0), none.reshape(len(study.keys), 0)
    found = Reduced(none.astype(np.int64), fields, values)
    for key in study.keys:
        near = study.stated[key]
        found.moments[key], found.histograms[key] = Moments(near), Histogram()
        if block_of(study) > 1:
            found.shares[key] = Shares(near)
    return found


def reduced(study: Study, chunk: int) -> Reduced:
    """Return the designs of a chunk, and what is kept of them."""
    of = opened(study)
    fields = designs_of(study, of.points, chunk)
    values, refused, alone = of.values(fields)
    count = fields.shape[1]
    numbers = np.arange(count) + chunk * of.points * of.block
    found = Reduced(numbers, fields, values, count, int(within(study, values).sum()), alone)
    absent = int((~np.isfinite(values).any(axis=0)).sum()) - len(refused)
    for at in sorted(refused):
        _count(found.refused, reason_of(refused[at]), 1)
    if absent > 0:
        _count(found.refused, Refusal("vary_unlooked"), absent)
    for key, row in zip(study.keys, values, strict=True):
        finite, near = row[np.isfinite(row)], study.stated[key]
        found.moments[key] = Moments.of(finite, near)
        found.histograms[key] = Histogram.of(finite)
        if of.block > 1:
            found.shares[key] = Shares.of(row.reshape(-1, of.block), near)
    return found


def within(study: Study, values: Array) -> Index:
    """Return which designs have every value that objectives and limits need, and keep the limits."""
    place = {key: at for at, key in enumerate(study.keys)}
    found = feasible([values[place[key]] for key in study.limits], list(study.limits.values()), values.shape[1])
    objectives = values[[place[key] for key in study.objectives]]
    return np.asarray(found & np.isfinite(objectives).all(axis=0))


def is_shown(study: Study, numbers: Index) -> Index:
    """Return which designs stand for all of them in figures: those whose number is a multiple of a prime."""
    every = max(study.count // _SHOWN, 1)
    # of a grid no row or column has a divisor with it
    every = next(one for one in itertools.count(every) if all(one % part for part in range(2, math.isqrt(one) + 1)))
    return np.asarray(numbers % every == 0)


def kept_of(study: Study, numbers: Index, values: Array) -> tuple[Index, bool]:
    """Return which designs are kept, and whether their Pareto set was thinned.

    That is the best of each objective, the Pareto set, and some of all.
    """
    rows = np.flatnonzero(within(study, values))
    ranked, pareto, is_thinned = ranks(study, values[:, rows])
    every = [rows[one] for one in (*ranked.values(), pareto)]
    every.append(np.flatnonzero(is_shown(study, numbers)))
    return np.unique(np.concatenate(every)) if study.objectives else rows[:0], is_thinned


def ranks(study: Study, values: Array) -> tuple[dict[str, Index], Index, bool]:
    """Return the best designs for each objective, the Pareto set, and whether it was thinned."""
    place = {key: at for at, key in enumerate(study.keys)}
    costs = np.array([sign * values[place[key]] for key, sign in study.objectives.items()]).T
    ranked = {key: best(costs[:, at], study.best) for at, key in enumerate(study.objectives)}
    if len(study.objectives) < 2:
        return ranked, np.zeros(0, dtype=np.intp), False
    every = front(costs)
    pareto = thinned(costs, every)
    return ranked, pareto, len(pareto) < len(every)


def reason_of(error: CrankworkError) -> str:
    """Return why there is no machine: of several mistakes the first."""
    told: str = error.problems[0].message if isinstance(error, InputError) else error.args[0]
    return told


def by_kind(reasons: Iterable[str]) -> Counter[str]:
    """Return how often there is each kind of reason, under the first of its kind: each length is another sentence."""
    first, found = dict[str, str](), Counter[str]()
    for one in reasons:
        found[first.setdefault(getattr(one, "name", one), one)] += 1
    return found


def _count(refused: dict[str, tuple[int, str]], reason: str, count: int) -> None:
    kind = reason.name if isinstance(reason, Refusal) else "other"
    before, first = refused.get(kind, (0, reason))
    refused[kind] = before + count, first


def part_of(study: Study, chunk: int) -> bytes:
    """Return the file of a chunk."""
    found = reduced(study, chunk)
    kept, found.is_thinned = kept_of(study, found.numbers, found.values)
    rows = np.arange(found.designs) if study.has_rows else kept
    meta = {
        "chunk": chunk,
        "study": study.digest,
        "seed": study.seed,
        "kept": kept.tolist() if study.has_rows else None,
        "refused": {kind: [count, _plain(reason)] for kind, (count, reason) in found.refused.items()},
        "moments": {key: asdict(one) for key, one in found.moments.items()},
        "histograms": {key: asdict(one) for key, one in found.histograms.items()},
        "shares": {key: _lists(asdict(one)) for key, one in found.shares.items()},
        **{name: getattr(found, name) for name in ("designs", "within", "one_by_one", "is_thinned")},
    }
    return written(study, found.numbers[rows], found.fields[:, rows], found.values[:, rows], meta)


def written(study: Study, numbers: Index, fields: Array, values: Array, meta: Mapping[str, Any]) -> bytes:
    """Return rows as a Parquet file, with units of columns, and what is said of all of them."""
    import pyarrow as pa  # noqa: PLC0415 - an optional part
    import pyarrow.parquet as pq  # noqa: PLC0415

    columns, kinds = [pa.array(numbers)], [pa.field(NUMBER, pa.int64(), nullable=False)]
    for one, of in zip(study.varied, fields, strict=True):
        if one.number is None:
            columns.append(pa.array([str(one.values[int(at)]) for at in of], pa.string()))
            kinds.append(pa.field(one.key, pa.string()))
        else:
            columns.append(pa.array(of))
            kinds.append(pa.field(one.key, pa.float64(), metadata={"unit": coherent_unit(one.number.unit)}))
    with use_units("si"):
        for key, of in zip(study.keys, values, strict=True):
            columns.append(pa.array(of))
            kinds.append(pa.field(key, pa.float64(), metadata={"unit": coherent_unit(key_unit(key))}))
    table = pa.Table.from_arrays(columns, schema=pa.schema(kinds, {META: json.dumps(meta)}))
    sink = pa.BufferOutputStream()
    # numbers of designs hardly shrink, and a checksum tells what a disk has lost
    pq.write_table(table, sink, compression="NONE", use_dictionary=False, write_page_checksum=True)
    return bytes(sink.getvalue())


def read_part(study: Study, chunk: int, data: bytes) -> Reduced:
    """Return what a part keeps; a ValueError if it is not that part."""
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


def _read(study: Study, table: Any, meta: dict[str, Any]) -> Reduced:  # noqa: ANN401 - pyarrow has no types
    fields = []
    for one in study.varied:
        column = table[one.key].to_numpy()
        if one.number is None:
            places = {str(value): at for at, value in enumerate(one.values)}
            column = np.array([places[value] for value in column], dtype=float)
        fields.append(column)
    values = [table[key].to_numpy() for key in study.keys]
    return Reduced(
        numbers=table[NUMBER].to_numpy(),
        fields=np.array(fields, dtype=float).reshape(len(fields), table.num_rows),
        values=np.array(values, dtype=float).reshape(len(values), table.num_rows),
        refused={kind: (count, _reason(reason)) for kind, (count, reason) in meta["refused"].items()},
        moments={key: Moments(**one) for key, one in meta["moments"].items()},
        histograms={key: Histogram(**one) for key, one in meta["histograms"].items()},
        shares={key: Shares(**_arrays(one)) for key, one in meta["shares"].items()},
        **{name: meta[name] for name in ("designs", "within", "one_by_one", "is_thinned")},
    )


def _lists(values: dict[str, Any]) -> dict[str, Any]:
    return {name: one.tolist() if isinstance(one, np.ndarray) else one for name, one in values.items()}


def _arrays(values: dict[str, Any]) -> dict[str, Any]:
    return {name: np.array(one) if isinstance(one, list) else one for name, one in values.items()}


def _plain(reason: object) -> Any:  # noqa: ANN401 - plain data
    """Return a reason as plain data that it can be said from in any language."""
    match reason:
        case Refusal():
            return {"name": reason.name, "values": {key: _plain(one) for key, one in reason.values.items()}}
        case tuple() | list():
            return [isinstance(reason, tuple), [_plain(one) for one in reason]]
        case bool() | int() | float():
            return reason
        case _:
            return str(reason)


def _reason(data: Any) -> Any:  # noqa: ANN401 - plain data
    match data:
        case {"name": name, "values": values}:
            return Refusal(name, **{key: _reason(one) for key, one in values.items()})
        case [bool(is_tuple), list(entries)]:
            return tuple(map(_reason, entries)) if is_tuple else [_reason(one) for one in entries]
        case _:
            return data
