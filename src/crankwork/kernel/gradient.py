"""Derivatives of single values of a design by all that it states.

Reductions take columns at few crank angles, or at all of them. What columns change with there is found for all of them
at once, back through their operations; what depends on the design alone is followed forward, by all fields together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.derivative import PARTIALS
from crankwork.kernel.graph import COMPUTE, Value, number
from crankwork.kernel.plan import Loop
from crankwork.kernel.slopes import Taken, Taking
from crankwork.kernel.source import Rows, Source

Array = NDArray[np.float64]
Places = NDArray[np.intp]


class _Chunk(NamedTuple):
    """Crank angles at which a column is wanted, each in a panel [deg], and for which of the points asked for."""

    column: Value
    degrees: Array
    panels: Places
    points: Places
    is_square: bool = False


class _Part(NamedTuple):
    """What of a stage follows one loop: which of its angles, where each chunk stands in these, what is made there."""

    loop: Loop
    resolved: Mapping[int, Value]  # Columns, as this loop has them
    angles: Places
    ends: Places
    made: dict[int, Any]
    read: dict[int, tuple[_Stage, int]]  # Columns of other angles: in which stage, which chunk


class _Stage:
    """The crank angles at which columns of a level are wanted: first those that reductions take."""

    def __init__(self, chunks: Iterable[_Chunk]) -> None:
        self.chunks = list(chunks)
        self._own = len(self.chunks)
        self.parts: list[_Part] = []

    def join(self) -> None:
        """Put chunks behind one another."""
        none = np.zeros(0, dtype=np.intp)
        columns = zip(
            (np.zeros(0), none, none), *((one.degrees, one.panels, one.points) for one in self.chunks), strict=True
        )
        self.degrees, self.panels, self.points = map(np.concatenate, columns)
        self.starts = np.cumsum([0, *(one.degrees.size for one in self.chunks)])
        # what columns come to, and what is asked of them
        self.values, self.adjoint = np.zeros(self.degrees.size), np.zeros(self.degrees.size)
        self.adjoint[: self.starts[self._own]] = 1.0

    @property
    def is_read(self) -> bool:
        """Whether a point may stand more than once, for columns that are read elsewhere."""
        return self._own < len(self.chunks)

    def of(self, chunk: int) -> slice:
        """Return where a chunk stands."""
        return slice(self.starts[chunk], self.starts[chunk + 1])

    def within(self, part: _Part) -> Iterator[tuple[_Chunk, Value, slice]]:
        """Yield chunks, their columns, and where they stand in a part."""
        for chunk, first, last in zip(self.chunks, part.ends, part.ends[1:], strict=False):
            if first < last:
                yield chunk, part.resolved[chunk.column.at], slice(first, last)


class _Asked:
    """What reductions take of columns, equal points once."""

    def __init__(self) -> None:
        self.count = 0
        self._start: dict[tuple[int, int, bool, bytes, bytes], int] = {}
        self._of: dict[tuple[int, int, bool], list[tuple[Taken, Places]]] = {}

    def points(self, level: int, taken: Taken) -> slice:
        """Return the numbers of the points that are taken."""
        of = level, taken.column.at, taken.is_square
        start = self._start.setdefault((*of, taken.degrees.tobytes(), taken.panels.tobytes()), self.count)
        points = slice(start, start + taken.degrees.size)
        if points.stop > self.count:
            self.count = points.stop
            self._of.setdefault(of, []).append((taken, np.arange(points.start, points.stop)))
        return points

    def chunks(self, level: int) -> Iterator[_Chunk]:
        """Yield what is taken of each column of a level."""
        for (at, _, is_square), of in self._of.items():
            if at == level:
                degrees, panels, points = zip(*((one.degrees, one.panels, which) for one, which in of), strict=True)
                joined = np.concatenate(degrees), np.concatenate(panels), np.concatenate(points)
                yield _Chunk(of[0][0].column, *joined, is_square)


class Gradient:
    """The derivatives of the outputs of a plan by what a design states."""

    def __init__(self, source: Source) -> None:
        self._source, self._plan, panels = source, source.plan, source.plan.grid.panel
        # which loop each panel is in, and what depends on the crank angle alone
        self._loop_of: list[Places] = []
        self._tables: list[dict[int, Value]] = []
        none: tuple[Array, Places, dict[int, Any]] = np.zeros(0), np.zeros(0, dtype=np.intp), {}
        self._last = [none] * len(source.plan.levels)
        # by loops: what their values are made of that is made elsewhere
        self._leaves: dict[int, list[Value]] = {}
        self._numbers: dict[int, dict[int, Any]] = {}
        # what of designs columns take
        self._rows = Rows[int]()
        for level in source.plan.levels:
            loop_of, tables = np.zeros(panels[-1] + 1, dtype=np.intp), dict[int, Value]()
            for at, loop in enumerate(level.loops):
                loop_of[panels[loop.angles]] = at
                tables |= {one.detail.at: one.detail for one in loop.values if one.kind == "moved"}
                made = {one.at for one in loop.values if one.kind not in ("delayed", "moved")}
                every = {one.at: one for one in (*loop.values, *loop.columns)}
                every |= {other.at: other for one in loop.values if one.kind != "delayed" for other in one.operands}
                leaves = [one for at, one in every.items() if at not in made]
                self._numbers[id(loop)] = {one.at: number(one) for one in leaves if one.is_constant}
                self._leaves[id(loop)] = [one for one in leaves if not one.is_constant]
                for one in leaves:
                    if one.by_design and not one.by_angle:
                        self._rows(one.at)
                    elif not one.by_design and not one.is_constant:
                        tables[one.at] = one
            self._loop_of.append(loop_of)
            self._tables.append(tables)

    def __call__(self, store: Array, taking: Sequence[Taking | None]) -> Array:
        """Return the derivatives, shape (outputs, fields): `store` of the design, what is taken by levels."""
        with np.errstate(all="ignore"):
            return self._found(store, taking)

    def _found(self, store: Array, taking: Sequence[Taking | None]) -> Array:
        asked, takes = _Asked(), dict[int, tuple[list[tuple[slice, Array]], Array]]()
        for at, (level, of) in enumerate(zip(self._plan.levels, taking, strict=True)):
            for one in level.reductions:
                assert of is not None  # noqa: S101 - where there are reductions something is taken
                every = [each for each in of.of(one) if each.column.by_design and each.weights.size]
                takes[one.at] = [(asked.points(at, each), each.weights) for each in every], of.of_ends
        back = self._back(store, asked)
        plan, tangents, none = self._plan, _Tangents(self._source, store), np.zeros(self._plan.inputs)
        of_columns = np.zeros((len(self._rows.of), plan.inputs))
        for level in plan.levels:
            for one in (*level.designs, *level.reductions):
                if one.kind != "reduction":
                    tangents.add(one)
                else:
                    taken, ends = takes[one.at]
                    change = sum((of_columns.T @ (back[:, points] @ weights) for points, weights in taken), none)
                    # ends stand in the first level
                    moved = zip(plan.ends, ends.tolist(), strict=False)
                    tangents.of[one.at] = sum((weight * tangents.of[end.at] for end, weight in moved), change)
                if one.at in self._rows.of:
                    of_columns[self._rows(one.at)] = tangents.of[one.at]
        outputs = [one for key, one in plan.outputs.items() if key]
        return np.array([none if one.is_constant else tangents.of[one.at] for one in outputs])

    def _back(self, store: Array, asked: _Asked) -> Array:
        """Return what columns change with at the points that are asked for, shape (values of designs, points)."""
        stages = [_Stage(asked.chunks(at)) for at in range(len(self._plan.levels))]
        found = np.zeros((len(self._rows.of), asked.count))
        for at in reversed(range(len(stages))):
            self._split(at, stages)
        for at, stage in enumerate(stages):
            self._forward(at, stage, store)
        for stage in reversed(stages):
            for part in stage.parts:
                self._reverse(stage, part, found)
        return found

    def _split(self, at: int, stages: Sequence[_Stage]) -> None:
        """Part the angles of a stage by the loops that they are in, and ask others for columns of other angles."""
        stage, level, grid = stages[at], self._plan.levels[at], self._plan.grid
        stage.join()
        loop_of = self._loop_of[at][stage.panels]
        for place, loop in enumerate(level.loops):
            angles = np.flatnonzero(loop_of == place)
            if not angles.size:
                continue
            resolved = dict(zip((one.at for one in level.columns), loop.columns, strict=True))
            part = _Part(
                loop, resolved, angles, np.searchsorted(angles, stage.starts), dict(self._numbers[id(loop)]), {}
            )
            stage.parts.append(part)
            for one in loop.values:
                if one.kind == "delayed":
                    below, was = stages[one.level - 1], stage.panels[angles]
                    panels, middles = grid.panels_earlier(one.detail)
                    turns = np.rint((middles - grid.middles + one.detail) / grid.cycle) * grid.cycle
                    degrees = stage.degrees[angles] - one.detail + turns[was]
                    part.read[one.at] = below, len(below.chunks)
                    below.chunks.append(_Chunk(one.operands[0], degrees, panels[was], stage.points[angles]))

    def _forward(self, at: int, stage: _Stage, store: Array) -> None:
        """Make the values of a stage."""
        source, of_angle = self._source, self._of_angle(at, stage)
        for part in stage.parts:
            made = part.made
            for one in self._leaves[id(part.loop)]:
                if one.kind == "delayed":
                    below, chunk = part.read[one.at]
                    made[one.at] = below.values[below.of(chunk)]
                elif one.by_angle:
                    made[one.at] = of_angle[one.detail.at if one.kind == "moved" else one.at][part.angles]
                else:
                    made[one.at] = store[source.rows(source.place(one)), 0]
            for one in part.loop.values:
                if one.at not in made:
                    made[one.at] = COMPUTE[one.kind](*[made[other.at] for other in one.operands])
            for _, one, at_part in stage.within(part):
                stage.values[part.angles[at_part]] = np.broadcast_to(made[one.at], part.angles.size)[at_part]

    def _of_angle(self, at: int, stage: _Stage) -> dict[int, Any]:
        """Return what depends on the crank angle alone, which of means is the same in every design."""
        degrees, panels, found = self._last[at]
        if not (np.array_equal(degrees, stage.degrees) and np.array_equal(panels, stage.panels)):
            found = self._plan.at(self._tables[at].values(), stage.degrees, self._plan.grid.middles[stage.panels])
            self._last[at] = stage.degrees, stage.panels, found
        return found

    def _reverse(self, stage: _Stage, part: _Part, found: Array) -> None:
        """Follow what is asked of columns back to what of designs they take."""
        asked = _seeded(stage, part)
        for one in reversed(part.loop.values):
            what = asked.of.pop(one.at, None)
            if what is None or one.kind == "moved":
                continue
            if one.kind == "delayed":
                below, chunk = part.read[one.at]
                below.adjoint[below.of(chunk)] = what
            else:
                asked.follow(one, part.made, what)
        if asked.of:
            rows, points = np.array([self._rows(at) for at in asked.of]), stage.points[part.angles]
            changes = np.array(list(asked.of.values()))
            if stage.is_read:
                np.add.at(found, np.ix_(rows, points), changes)
            else:
                found[np.ix_(rows, points)] += changes


class _Sums:
    """What is asked of values, added up; `of`: by their places in the graph."""

    def __init__(self) -> None:
        self.of: dict[int, Array] = {}

    def add(self, one: Value, what: Array) -> None:
        """Ask more of a value, if designs differ in it."""
        if one.by_design:
            before = self.of.get(one.at)
            self.of[one.at] = what if before is None else before + what

    def follow(self, one: Value, made: Mapping[int, Any], what: Array) -> None:
        """Ask of what a value is made of."""
        match one.kind:
            case "add" | "sub":
                left, right = one.operands
                self.add(left, what)
                self.add(right, what if one.kind == "add" else -what)
            case "mul":
                for other, factor in zip(one.operands, reversed(one.operands), strict=True):
                    if other.by_design:
                        self.add(other, what * made[factor.at])
            case _:
                for other, partial in zip(one.operands, _partials(one, made), strict=True):
                    if other.by_design:
                        # where nothing is asked nothing follows, however steep it is
                        self.add(other, np.where(what == 0.0, 0.0, partial * what))


def _seeded(stage: _Stage, part: _Part) -> _Sums:
    """Return what is asked of columns themselves."""
    asked = _Sums()
    for chunk, one, at in stage.within(part):
        seed = np.zeros(part.angles.size)
        seed[at] = stage.adjoint[part.angles[at]]
        if not chunk.is_square:
            asked.add(one, seed)
        elif one.kind == "sqrt":
            asked.add(one.operands[0], seed)
        else:
            asked.add(one, 2.0 * part.made[one.at] * seed)
    return asked


class _Tangents:
    """How values of a design change with all that it states; `of`: by their places in the graph, shape (fields,)."""

    def __init__(self, source: Source, store: Array) -> None:
        self._source, self._store = source, store[:, 0]
        self._fields = np.eye(source.plan.inputs)
        self._values: dict[int, Any] = {}
        self.of: dict[int, Array] = {}

    def add(self, one: Value) -> None:
        """Add a value, after those that it is made of."""
        if one.kind == "input":
            self.of[one.at] = self._fields[one.detail]
            return
        values = self._values
        for other in one.operands:
            if other.at not in values:
                values[other.at] = number(other) if other.is_constant else self._stored(other)
        values[one.at] = COMPUTE[one.kind](*[values[other.at] for other in one.operands])
        if one.kind == "choose":
            # of what is not chosen nothing follows, not even what is no number
            chosen = one.operands[1 if values[one.operands[0].at] > 0 else 2]
            changes = [] if chosen.is_constant else [self.of[chosen.at]]
        else:
            both = zip(one.operands, _partials(one, values), strict=True)
            changes = [_times(by, self.of[other.at]) for other, by in both if not other.is_constant]
        self.of[one.at] = sum(changes[1:], changes[0]) if changes else np.zeros(len(self._fields))

    def _stored(self, one: Value) -> Any:  # noqa: ANN401
        return self._store[self._source.rows(self._source.place(one))]


def _partials(one: Value, made: Mapping[int, Any]) -> tuple[Any, ...]:
    """Return the derivatives of an operation by what it is of."""
    of = [made[other.at] for other in one.operands]
    return (0.0, of[0] > 0, ~(of[0] > 0)) if one.kind == "choose" else PARTIALS[one.kind](made[one.at], *of)


def _times(partial: Any, change: Array) -> Array:  # noqa: ANN401
    """Return a change times a derivative, which often is 1 or -1."""
    if type(partial) is float:
        return change if partial == 1.0 else -change if partial == -1.0 else partial * change
    return np.asarray(partial * change)
