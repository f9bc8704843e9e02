"""Linearised reductions of columns, and derivatives of single values of a design by all its fields.

Reductions depend on columns at few crank angles, or at all of them. Columns are differentiated at all of these at once,
in reverse mode; values of the design alone in forward mode, by all fields together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import COMPUTE, PARTIALS, KernelValue, in_order, number
from crankwork.kernel.grid import Grid
from crankwork.kernel.python_source import Rows, Source
from crankwork.kernel.reductions import Block, Extreme
from crankwork.kernel.schedule import Loop

Array = NDArray[np.float64]
Places = NDArray[np.intp]


class _Chunk(NamedTuple):
    """Crank angles at which a column is needed, each in a panel [deg], and the seed points that need it."""

    column: KernelValue
    degrees: Array
    panels: Places
    points: Places
    is_square: bool = False


class _Part(NamedTuple):
    """The angles of a stage that are in one loop: their indices, the ends of chunks among them, and results there."""

    loop: Loop
    resolved: Mapping[int, KernelValue]  # Columns, as this loop has them
    angles: Places
    ends: Places
    results: dict[int, Any]
    read: dict[int, tuple[_Stage, int]]  # Columns at other angles: their stage and chunk


class _Stage:
    """Crank angles at which columns of a level are needed: those of reductions first."""

    def __init__(self, chunks: Iterable[_Chunk]) -> None:
        self.chunks = list(chunks)
        self._own = len(self.chunks)
        self.parts: list[_Part] = []

    def join(self) -> None:
        """Concatenate the chunks."""
        none = np.zeros(0, dtype=np.intp)
        columns = zip(
            (np.zeros(0), none, none),
            *((chunk.degrees, chunk.panels, chunk.points) for chunk in self.chunks),
            strict=True,
        )
        self.degrees, self.panels, self.points = map(np.concatenate, columns)
        self.starts = np.cumsum([0, *(chunk.degrees.size for chunk in self.chunks)])
        # values of the columns, and their adjoints
        self.values, self.adjoint = np.zeros(self.degrees.size), np.zeros(self.degrees.size)
        self.adjoint[: self.starts[self._own]] = 1.0

    @property
    def is_read(self) -> bool:
        """Whether points may occur more than once, for columns that are read at other angles."""
        return self._own < len(self.chunks)

    def of(self, chunk: int) -> slice:
        """Return the slice of a chunk."""
        return slice(self.starts[chunk], self.starts[chunk + 1])

    def within(self, part: _Part) -> Iterator[tuple[_Chunk, KernelValue, slice]]:
        """Yield chunks, their columns, and their slices in a part."""
        for chunk, first, last in zip(self.chunks, part.ends, part.ends[1:], strict=False):
            if first < last:
                yield chunk, part.resolved[chunk.column.index], slice(first, last)


class _SeedPoints:
    """Points at which reductions depend on columns, equal points once."""

    def __init__(self) -> None:
        self.count = 0
        self._start: dict[tuple[int, int, bool, bytes, bytes], int] = {}
        self._points: dict[tuple[int, int, bool], list[tuple[ColumnWeights, Places]]] = {}

    def points(self, level: int, weights: ColumnWeights) -> slice:
        """Return the numbers of the points of a reduction."""
        column = level, weights.column.index, weights.is_square
        start = self._start.setdefault((*column, weights.degrees.tobytes(), weights.panels.tobytes()), self.count)
        points = slice(start, start + weights.degrees.size)
        if points.stop > self.count:
            self.count = points.stop
            self._points.setdefault(column, []).append((weights, np.arange(points.start, points.stop)))
        return points

    def chunks(self, level: int) -> Iterator[_Chunk]:
        """Yield the points of each column of a level."""
        for (level_of, _, is_square), seeds in self._points.items():
            if level_of == level:
                columns = zip(*((seed.degrees, seed.panels, points) for seed, points in seeds), strict=True)
                degrees, panels, points = map(np.concatenate, columns)
                yield _Chunk(seeds[0][0].column, degrees, panels, points, is_square)


class Gradient:
    """Derivatives of the outputs of a schedule by the fields of a design."""

    def __init__(self, source: Source) -> None:
        self._source, self._plan, panels = source, source.plan, source.plan.grid.panel
        # the loop of each panel, and the functions of the crank angle alone
        self._loop_of: list[Places] = []
        self._tables: list[dict[int, KernelValue]] = []
        none: tuple[Array, Places, dict[int, Any]] = np.zeros(0), np.zeros(0, dtype=np.intp), {}
        self._last = [none] * len(source.plan.levels)
        # by loops: operands that are calculated elsewhere
        self._leaves: dict[int, list[KernelValue]] = {}
        self._numbers: dict[int, dict[int, Any]] = {}
        # rows of the design values that columns depend on
        self._rows = Rows[int]()
        for level in source.plan.levels:
            loop_of, tables = np.zeros(panels[-1] + 1, dtype=np.intp), dict[int, KernelValue]()
            for index, loop in enumerate(level.loops):
                loop_of[panels[loop.angles]] = index
                tables |= {value.detail.index: value.detail for value in loop.values if value.kind == "moved"}
                results = {value.index for value in loop.values if value.kind not in ("delayed", "moved")}
                used = {value.index: value for value in (*loop.values, *loop.columns)}
                for value in loop.values:
                    if value.kind != "delayed":
                        used |= {operand.index: operand for operand in value.operands}
                leaves = [value for key, value in used.items() if key not in results]
                self._numbers[id(loop)] = {leaf.index: number(leaf) for leaf in leaves if leaf.is_constant}
                self._leaves[id(loop)] = [leaf for leaf in leaves if not leaf.is_constant]
                for leaf in leaves:
                    if leaf.depends_on_design and not leaf.depends_on_angle:
                        self._rows(leaf.index)
                    elif not leaf.depends_on_design and not leaf.is_constant:
                        tables[leaf.index] = leaf
            self._loop_of.append(loop_of)
            self._tables.append(tables)

    def __call__(self, store: Array, adjoints: Sequence[ReductionAdjoint | None]) -> Array:
        """Return the derivatives, shape (outputs, fields): `store` of the design, adjoints of reductions by levels."""
        with np.errstate(all="ignore"):
            return self._derivatives(store, adjoints)

    def _derivatives(self, store: Array, adjoints: Sequence[ReductionAdjoint | None]) -> Array:
        seeds, weights_of = _SeedPoints(), dict[int, tuple[list[tuple[slice, Array]], Array]]()
        for index, (level, adjoint) in enumerate(zip(self._plan.levels, adjoints, strict=True)):
            for value in level.reductions:
                assert adjoint is not None  # noqa: S101 - every level with reductions has one
                all_terms = adjoint.weights(value)
                terms = [term for term in all_terms if term.column.depends_on_design and term.weights.size]
                weights_of[value.index] = (
                    [(seeds.points(index, term), term.weights) for term in terms],
                    adjoint.end_weights,
                )
        back = self._back(store, seeds)
        plan, tangents, none = self._plan, _Tangents(self._source, store), np.zeros(self._plan.inputs)
        of_columns = np.zeros((len(self._rows.of), plan.inputs))
        for level in plan.levels:
            for value in (*level.designs, *level.reductions):
                if value.kind != "reduction":
                    tangents.add(value)
                else:
                    weighted, ends = weights_of[value.index]
                    change = sum((of_columns.T @ (back[:, points] @ weights) for points, weights in weighted), none)
                    # ends are in the first level
                    moved = zip(plan.ends, ends.tolist(), strict=False)
                    tangents.of[value.index] = sum((weight * tangents.of[end.index] for end, weight in moved), change)
                if value.index in self._rows.of:
                    of_columns[self._rows(value.index)] = tangents.of[value.index]
        outputs = [value for key, value in plan.outputs.items() if key]
        return np.array([none if value.is_constant else tangents.of[value.index] for value in outputs])

    def _back(self, store: Array, seeds: _SeedPoints) -> Array:
        """Return the derivatives of columns at the seed points by design values, shape (design values, points)."""
        stages = [_Stage(seeds.chunks(index)) for index in range(len(self._plan.levels))]
        changes = np.zeros((len(self._rows.of), seeds.count))
        for index in reversed(range(len(stages))):
            self._split(index, stages)
        for index, stage in enumerate(stages):
            self._forward(index, stage, store)
        for stage in reversed(stages):
            for part in stage.parts:
                self._reverse(stage, part, changes)
        return changes

    def _split(self, index: int, stages: Sequence[_Stage]) -> None:
        """Split the angles of a stage by loops, and add chunks for columns at other angles to lower stages."""
        stage, level, grid = stages[index], self._plan.levels[index], self._plan.grid
        stage.join()
        loop_of = self._loop_of[index][stage.panels]
        for number_of_loop, loop in enumerate(level.loops):
            angles = np.flatnonzero(loop_of == number_of_loop)
            if not angles.size:
                continue
            resolved = dict(zip((column.index for column in level.columns), loop.columns, strict=True))
            ends, results = np.searchsorted(angles, stage.starts), dict(self._numbers[id(loop)])
            part = _Part(loop, resolved, angles, ends, results, {})
            stage.parts.append(part)
            for value in loop.values:
                if value.kind == "delayed":
                    below, own = stages[value.level - 1], stage.panels[angles]
                    panels, middles = grid.panels_earlier(value.detail)
                    turns = np.rint((middles - grid.middles + value.detail) / grid.cycle) * grid.cycle
                    degrees = stage.degrees[angles] - value.detail + turns[own]
                    part.read[value.index] = below, len(below.chunks)
                    below.chunks.append(_Chunk(value.operands[0], degrees, panels[own], stage.points[angles]))

    def _forward(self, index: int, stage: _Stage, store: Array) -> None:
        """Calculate the values of a stage."""
        source, of_angle = self._source, self._of_angle(index, stage)
        for part in stage.parts:
            results = part.results
            for leaf in self._leaves[id(part.loop)]:
                if leaf.kind == "delayed":
                    below, chunk = part.read[leaf.index]
                    results[leaf.index] = below.values[below.of(chunk)]
                elif leaf.depends_on_angle:
                    key = leaf.detail.index if leaf.kind == "moved" else leaf.index
                    results[leaf.index] = of_angle[key][part.angles]
                else:
                    results[leaf.index] = store[source.rows(source.place(leaf)), 0]
            for value in part.loop.values:
                if value.index not in results:
                    results[value.index] = COMPUTE[value.kind](*[results[operand.index] for operand in value.operands])
            for _, column, within in stage.within(part):
                full = np.broadcast_to(results[column.index], part.angles.size)
                stage.values[part.angles[within]] = full[within]

    def _of_angle(self, index: int, stage: _Stage) -> dict[int, Any]:
        """Return the functions of the crank angle alone, cached because means need the same angles in each design."""
        degrees, panels, values = self._last[index]
        if not (np.array_equal(degrees, stage.degrees) and np.array_equal(panels, stage.panels)):
            middles = self._plan.grid.middles[stage.panels]
            values = self._plan.at(self._tables[index].values(), stage.degrees, middles)
            self._last[index] = stage.degrees, stage.panels, values
        return values

    def _reverse(self, stage: _Stage, part: _Part, changes: Array) -> None:
        """Propagate the adjoints of columns back to the design values that they depend on."""
        adjoints = _seeded(stage, part)
        for value in reversed(part.loop.values):
            adjoint = adjoints.of.pop(value.index, None)
            if adjoint is None or value.kind == "moved":
                continue
            if value.kind == "delayed":
                below, chunk = part.read[value.index]
                below.adjoint[below.of(chunk)] = adjoint
            else:
                adjoints.propagate(value, part.results, adjoint)
        if adjoints.of:
            rows, points = np.array([self._rows(index) for index in adjoints.of]), stage.points[part.angles]
            added = np.array(list(adjoints.of.values()))
            if stage.is_read:
                np.add.at(changes, np.ix_(rows, points), added)
            else:
                changes[np.ix_(rows, points)] += added


class _Adjoints:
    """Sums of adjoints of values; `of`: by index in the graph."""

    def __init__(self) -> None:
        self.of: dict[int, Array] = {}

    def add(self, value: KernelValue, adjoint: Array) -> None:
        """Add to the adjoint of a value, if designs differ in it."""
        if value.depends_on_design:
            before = self.of.get(value.index)
            self.of[value.index] = adjoint if before is None else before + adjoint

    def propagate(self, value: KernelValue, results: Mapping[int, Any], adjoint: Array) -> None:
        """Add the adjoint of a value to its operands."""
        match value.kind:
            case "add" | "sub":
                left, right = value.operands
                self.add(left, adjoint)
                self.add(right, adjoint if value.kind == "add" else -adjoint)
            case "mul":
                for operand, factor in zip(value.operands, reversed(value.operands), strict=True):
                    if operand.depends_on_design:
                        self.add(operand, adjoint * results[factor.index])
            case _:
                for operand, partial in zip(value.operands, _partials(value, results), strict=True):
                    if operand.depends_on_design:
                        # an adjoint of 0 stays 0 even if the derivative is infinite
                        self.add(operand, np.where(adjoint == 0.0, 0.0, partial * adjoint))


def _seeded(stage: _Stage, part: _Part) -> _Adjoints:
    """Return the adjoints of the columns."""
    adjoints = _Adjoints()
    for chunk, column, within in stage.within(part):
        seed = np.zeros(part.angles.size)
        seed[within] = stage.adjoint[part.angles[within]]
        if not chunk.is_square:
            adjoints.add(column, seed)
        elif column.kind == "sqrt":
            adjoints.add(column.operands[0], seed)
        else:
            adjoints.add(column, 2.0 * part.results[column.index] * seed)
    return adjoints


class _Tangents:
    """Derivatives of design values by the fields; `of`: by index in the graph, shape (fields,)."""

    def __init__(self, source: Source, store: Array) -> None:
        self._source, self._store = source, store[:, 0]
        self._fields = np.eye(source.plan.inputs)
        self._values: dict[int, Any] = {}
        self.of: dict[int, Array] = {}

    def add(self, value: KernelValue) -> None:
        """Add a value, after its operands."""
        if value.kind == "input":
            self.of[value.index] = self._fields[value.detail]
            return
        results = self._values
        for operand in value.operands:
            if operand.index not in results:
                results[operand.index] = number(operand) if operand.is_constant else self._stored(operand)
        results[value.index] = COMPUTE[value.kind](*[results[operand.index] for operand in value.operands])
        if value.kind == "choose":
            # the other branch has no influence, even if it is nan
            chosen = value.operands[1 if results[value.operands[0].index] > 0 else 2]
            changes = [] if chosen.is_constant else [self.of[chosen.index]]
        else:
            both = zip(value.operands, _partials(value, results), strict=True)
            changes = [_times(partial, self.of[operand.index]) for operand, partial in both if not operand.is_constant]
        self.of[value.index] = sum(changes[1:], changes[0]) if changes else np.zeros(len(self._fields))

    def _stored(self, value: KernelValue) -> Any:  # noqa: ANN401
        return self._store[self._source.rows(self._source.place(value))]


def _partials(value: KernelValue, results: Mapping[int, Any]) -> tuple[Any, ...]:
    """Return the derivatives of an operation by its operands."""
    operands = [results[operand.index] for operand in value.operands]
    if value.kind == "choose":
        return 0.0, operands[0] > 0, ~(operands[0] > 0)
    return PARTIALS[value.kind](results[value.index], *operands)


def _times(partial: Any, change: Array) -> Array:  # noqa: ANN401
    """Return a change times a derivative, without multiplications by 1 or -1."""
    if type(partial) is float:
        return change if partial == 1.0 else -change if partial == -1.0 else partial * change
    return np.asarray(partial * change)


# slope of a level polynomial, relative to its range over the panel
_LEVEL = 1e-6


def part_key(key: str, part: int) -> str:
    """Return the key of a single value with the extreme of one part of the cycle."""
    return f"{key} in {part}"


def split_extreme(value: KernelValue, parts: int) -> list[KernelValue]:
    """Return a single value with its one extreme taken in each part of the cycle; empty if it has not exactly one.

    The position of the extreme of the whole cycle jumps if two are level; those of parts are continuous.
    """
    nodes = list(in_order([value], into=lambda node: node.kind != "reduction"))
    extremes = [node for node in nodes if node.kind == "reduction"]
    if len(extremes) != 1 or extremes[0].detail not in ("max", "min"):
        return []
    values = []
    for part in range(parts):
        results: dict[int, KernelValue] = {}
        for node in nodes:
            operands = [results.get(operand.index, operand) for operand in node.operands]
            if node is extremes[0]:
                results[node.index] = node.graph.reduction(f"{node.detail} {part}", *node.operands)
            elif any(new is not old for new, old in zip(operands, node.operands, strict=True)):
                results[node.index] = node.graph.apply(node.kind, *operands)
        values.append(results[value.index])
    return values


class ColumnWeights(NamedTuple):
    """Weights of a linearised reduction for a column, or its square, at crank angles with their panels. [deg]"""

    column: KernelValue
    degrees: Array
    panels: NDArray[np.intp]
    weights: Array
    is_square: bool = False


class ReductionAdjoint:
    """Derivatives of the reductions of one design by its columns, and by the crank angles of its ends of laws.

    `edges`: index of the end of a law at each edge of a panel, -1 if there is none.
    """

    def __init__(self, block: Block, grid: Grid, edges: NDArray[np.intp]) -> None:
        self._block, self._exact, self._edges = block, block.polynomials, edges
        self._degrees, self._weights = self._exact.nodes
        self._panels = grid.panel[: grid.nodes]
        # of the last reduction [1/deg]
        self.end_weights = np.zeros(int(edges.max(initial=-1)) + 1)

    def weights(self, reduction: KernelValue) -> list[ColumnWeights]:
        """Return the weights of the columns of a reduction, and set `end_weights` to those of the ends of laws."""
        self.end_weights = np.zeros_like(self.end_weights)
        column = reduction.operands[0]
        match reduction.detail:
            case "mean" | "integral":
                factor = 1.0 / (self._block.cycle if reduction.detail == "mean" else 1.0)
                if self._block.is_root(column):
                    return [self._of_root(column, factor)]
                return [self._integral(column, factor * self._weights, np.full(self._edges.size, factor))]
            case "range" | "tangents":
                slopes = reduction.operands[2:] or (None, None)
                both = zip((1.0, -1.0), self._block.range(reduction), slopes, strict=True)
                return [term for values in both for term in self._work(reduction, *values)]
            case "least":
                # only guards look at it
                return []
        return [self._extreme(reduction)]

    def _integral(self, column: KernelValue, weights: Array, at_edges: Array) -> ColumnWeights:
        """Return the weights of an integral; jumps at ends of laws, times a factor, are weights of their angles."""
        moving = np.flatnonzero(self._edges >= 0)
        if moving.size:
            values = self._block.column(column)[0, :, 0].reshape(-1, self._exact.each)
            jumps = np.pad(values[:-1, -1] - values[1:, 0], 1) * at_edges
            np.add.at(self.end_weights, self._edges[moving], np.radians(jumps[moving]))
        return ColumnWeights(column, self._degrees, self._panels, weights)

    def _of_root(self, column: KernelValue, factor: float) -> ColumnWeights:
        """Return the weights of an integral for the square of a column, which has no corner where it is 0."""
        weights = self._exact.at_roots(self._block.column(column)[..., :1] ** 2)
        terms = self._integral(column, factor * weights, np.full(self._edges.size, factor))
        return terms._replace(is_square=True)

    def _work(
        self, reduction: KernelValue, sign: float, extreme: Extreme, slope: KernelValue | None
    ) -> Iterator[ColumnWeights]:
        """Yield the weights of the work of a column about its mean at an extreme, less a slope times an inertia."""
        column, (panel, u) = reduction.operands[0], extreme.place
        self._add_corner(extreme, 1.0)
        part = self._exact.up_to(panel, u)
        share = part.sum() / self._block.cycle
        sign *= 1.0 if slope is None else -1.0
        before = np.arange(self._edges.size) <= panel
        yield self._integral(column, sign * (part - share * self._weights), sign * (before - share))
        if slope is not None:
            inertia = reduction.operands[1]
            for factor, other in ((inertia, slope), (slope, inertia)):
                value, *_ = self._exact.around(panel, u)
                read = float(value @ self._block.column(other)[0, self._exact.of_panel(panel), 0])
                yield self._point(factor, extreme, sign * read)

    def _extreme(self, reduction: KernelValue) -> ColumnWeights:
        extreme, is_angle = self._block.extreme(reduction)
        column, (panel, u) = reduction.operands[0], extreme.place
        is_square, nodes = self._block.is_root(column), self._exact.of_panel(panel)
        if not is_angle:
            weight = 0.5 / float(self._block.value(reduction)[0]) if is_square else 1.0
            self._add_corner(extreme, weight)
            return self._point(column, extreme, weight)._replace(is_square=is_square)
        _, first, second = self._exact.around(panel, u)
        values = extreme.columns[0, nodes, 0]
        if abs(first @ values) * np.ptp(np.radians(self._degrees[nodes])) > 2 * _LEVEL * np.ptp(values):
            # a corner is fixed, or moves with the end of a law
            if self._end(panel, u) >= 0:
                self.end_weights[self._end(panel, u)] += np.radians(1.0)
            return ColumnWeights(column, np.zeros(0), np.zeros(0, dtype=np.intp), np.zeros(0))
        return ColumnWeights(column, self._degrees[nodes], self._panels[nodes], -first / (second @ values), is_square)

    def _point(self, column: KernelValue, extreme: Extreme, weight: float) -> ColumnWeights:
        peaks = extreme.peaks
        return ColumnWeights(column, np.degrees(peaks.angle[:, 0]), peaks.panel[:, 0], np.array([weight]))

    def _add_corner(self, extreme: Extreme, weight: float) -> None:
        """Add the weight of the angle of an end of a law at which an extreme is, which moves along the column."""
        panel, u = extreme.place
        if self._end(panel, u) >= 0:
            _, first, _ = self._exact.around(panel, u)
            values = extreme.columns[0, self._exact.of_panel(panel), 0]
            self.end_weights[self._end(panel, u)] += np.radians(weight * float(first @ values))

    def _end(self, panel: int, u: float) -> int:
        """Return the index of the end of a law at a point of a panel, -1 if there is none."""
        return int(self._edges[panel + (u > 0)]) if abs(u) == 1.0 else -1
