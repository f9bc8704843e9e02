"""The trace evaluated again at any crank angles.

A column is never interpolated: what a table shows, a quadrature sums or another cylinder delays are the same
operations at the angles wanted.
"""

from __future__ import annotations

import functools
import itertools
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property, partial
from operator import itemgetter
from typing import Any, Literal, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from crankwork.formula.traced_value import (
    AngleFunction,
    AngleUnwrap,
    Arithmetic,
    Array,
    Component,
    Delayed,
    FormulaCall,
    Node,
    Piecewise,
    Root,
    Sum,
    Tabulated,
    TracedValue,
    in_order,
)

# Rows that are replayed together, so that what lies between formulas stays in the cache.
_ROWS = (2048, 32768)
# Numbers that may be held at once, so that a long chain is replayed in short parts.
_NUMBERS = 2**22


class Angles(Protocol):
    """Crank angles with their functions, as `CrankGrid` has them."""

    @property
    def degrees(self) -> Array:
        """The angles. [deg]"""
        ...

    def multiple(self, order: int) -> Self:
        """Return the grid of whole multiples of the angles."""
        ...

    def shifted(self, degrees: float) -> Self:
        """Return the grid of angles larger by some degrees."""
        ...

    def earlier(self, shifts: Array, cycle: float) -> tuple[Self, NDArray[np.intp]]:
        """Return the distinct angles that lie earlier in the cycle by each of some amounts, and their places."""
        ...

    def __getitem__(self, part: slice) -> Self: ...

    def __len__(self) -> int: ...


# What makes a column: a function, and what it takes.
_Step = tuple[Callable[..., Any], tuple[TracedValue | float, ...]]
# Stand for the angles at which columns are replayed.
_ANGLES, _DEGREES = TracedValue(Node(None)), TracedValue(AngleFunction("degrees"))


class Program:
    """The steps, in order, that replay some columns.

    A step takes columns and numbers out of slots and puts a column into one; the slot of what is spent is used again.
    """

    def __init__(self, columns: Mapping[str, TracedValue]) -> None:
        self.columns = dict(columns)
        steps: dict[int, _Step] = {}
        late: list[Delayed] = []

        def varying_operands(node: Node) -> list[TracedValue]:
            if isinstance(node, Delayed):
                late.append(node)
                return []
            _, inputs = steps[id(node)] = _step(node)
            return [item for item in inputs if type(item) is TracedValue and item.varies and item is not _ANGLES]

        varying = (column for column in columns.values() if column.varies)
        order = [column.node for column in in_order(varying, into=varying_operands)]
        # what pieces lead over a change point is 0/0 there and used on both sides of it only; a link that stands
        # still has no instant centre
        self._invalid: Literal["ignore", "warn"] = "ignore" if any(map(_may_have_no_value, order)) else "warn"
        for cycle in sorted({node.cycle for node in late}):
            together = [node for node in late if node.cycle == cycle]
            earlier = TracedValue(Node(None))
            steps[id(earlier.node)] = _Earlier(together, cycle), (_ANGLES,)
            steps |= {id(node): (itemgetter(id(node)), (earlier,)) for node in together}
            order.insert(0, earlier.node)
        self._slots: list[Any] = [None]
        self._slot_of = {id(_ANGLES.node): 0}
        self._steps = list(self._placed([(id(node), *steps[id(node)]) for node in order]))

    def _placed(
        self, steps: list[tuple[int, Callable[..., Any], tuple[TracedValue | float, ...]]]
    ) -> Iterator[tuple[int, Callable[..., Any], Callable[[list[Any]], Iterable[Any]]]]:
        """Yield of each step the slot of what it makes, its function, and what takes its operands out of the slots."""
        slots, slot_of, free = self._slots, self._slot_of, list[int]()
        last = {
            id(step_input.node): step_index
            for step_index, (_, _, inputs) in enumerate(steps)
            for step_input in inputs
            if type(step_input) is TracedValue and step_input.node.value is None
        }
        for kept in (_ANGLES, *self.columns.values()):
            last.pop(id(kept.node), None)
        for index, (made, function, inputs) in enumerate(steps):
            taken = []
            for operand in inputs:
                key = id(operand.node) if type(operand) is TracedValue else id(operand)
                slot = slot_of.get(key)
                if slot is None:
                    slot = slot_of[key] = len(slots)
                    slots.append(operand.node.value if type(operand) is TracedValue else operand)
                elif last.get(key) == index:
                    del last[key]
                    free.append(slot)
                taken.append(slot)
            if not free:
                free.append(len(slots))
                slots.append(None)
            slot = slot_of[made] = free.pop()
            # of one slot `itemgetter` would give what is in it
            yield slot, function, itemgetter(*taken) if len(taken) > 1 else itemgetter(slice(taken[0], taken[0] + 1))

    def __call__(self, angles: Angles) -> dict[str, Array]:
        """Return the columns at crank angles, by key; what does not vary with the angle is repeated. [SI]"""
        return dict(zip(self.columns, self.rows(angles), strict=True))

    def rows(self, angles: Angles, keys: Iterable[str] | None = None) -> Array:
        """Return the columns at crank angles, or those of some keys, each a row. [SI]"""
        count, kept = len(angles), self.columns.values() if keys is None else [self.columns[key] for key in keys]
        rows = np.empty((len(kept), count))
        wanted = []
        for row, known in zip(rows, kept, strict=True):
            if known.varies:
                wanted.append((row, self._slot_of[id(known.node)]))
            else:
                row[:] = known.value
        together = min(max(_NUMBERS // len(self._slots), _ROWS[0]), _ROWS[1])
        for start in range(0, count, together):
            part = slice(start, min(start + together, count))
            # a vertical link has no slope, and its arc tangent is a right angle
            with np.errstate(divide="ignore", invalid=self._invalid):
                columns = self._replay(angles if together >= count else angles[part])
            for row, slot in wanted:
                row[part] = columns[slot]
        return rows

    def _replay(self, angles: Angles) -> list[Any]:
        slots: list[Any] = [angles, *self._slots[1:]]
        for slot, function, operands in self._steps:
            slots[slot] = function(*operands(slots))
        return slots


class Samples:
    """Columns at crank angles; those at whole degrees of the cycle are replayed together, once. [deg]"""

    def __init__(self, program: Program, angles_at: Callable[[Any], Angles], cycle: float) -> None:
        self.program, self._angles_at, self._cycle = program, angles_at, cycle

    @cached_property
    def _at_whole_degrees(self) -> dict[str, Array]:
        return self.program(self._angles_at(np.arange(self._cycle + 1)))

    def __call__(self, angles: Angles) -> dict[str, Array]:
        """Return all columns at crank angles, by key. [SI]"""
        rows = np.rint(angles.degrees).astype(np.intp)
        if not (np.array_equal(rows, angles.degrees) and rows.min() >= 0 and rows.max() <= self._cycle):
            return self.program(angles)
        step = rows[1] - rows[0] if rows.size > 1 else 1
        # evenly spaced ones are not copied
        is_even = step > 0 and rows[-1] - rows[0] == step * (rows.size - 1) and np.all(np.diff(rows) == step)
        place = slice(rows[0], rows[-1] + 1, step) if is_even else rows
        return {key: column[place] for key, column in self._at_whole_degrees.items()}


def _may_have_no_value(node: Node) -> bool:
    """Return whether a column follows polynomials about change points, or is that of an instant centre."""
    if isinstance(node, FormulaCall):
        return node.formula.quantity in ("instant_centre_x", "instant_centre_y")
    return isinstance(node, Piecewise) and any(
        isinstance(law.node, Tabulated) and law.node.word == "change_point" for law in node.operands
    )


def replay(known: TracedValue, angles: Angles) -> Array:
    """Return one column at crank angles."""
    return Program({"": known})(angles)[""]


class _Earlier:
    """Delayed columns: what is delayed is replayed once, at all the angles that any delay asks for."""

    def __init__(self, nodes: list[Delayed], cycle: float) -> None:
        self._nodes, self._cycle = nodes, cycle
        self._by = np.array(sorted({node.by for node in nodes}))
        self._row = {float(shift): index for index, shift in enumerate(self._by)}
        self._program = Program({str(id(node.of.node)): node.of for node in nodes})

    def __call__(self, angles: Angles) -> dict[int, Array]:
        distinct, places = angles.earlier(self._by, self._cycle)
        columns = self._program(distinct)
        return {id(node): columns[str(id(node.of.node))][places[self._row[node.by]]] for node in self._nodes}


def _step(node: Node) -> _Step:
    """Return the function that computes a column, and its operands at the same angles."""
    match node:
        case FormulaCall():
            return node.formula.function, node.inputs
        case Arithmetic():
            return node.function, node.inputs
        case AngleFunction():
            return partial(_of_angle, node), (_ANGLES,)
        case Sum():
            return _sum, node.operands
        case Piecewise():
            laws = [_law(law) for law in node.operands]
            return partial(_piece_by_piece, node.ends, laws), (
                _DEGREES,
                *itertools.chain(*(inputs for _, inputs in laws)),
            )
        case Tabulated():
            return partial(_read, node.function), (_DEGREES if node.by is None else node.by,)
        case Root():
            return (partial(_solved, node), node.operands) if node.operands else (node.solve, (_ANGLES,))
        case Component():
            return itemgetter(node.at), node.operands
        case AngleUnwrap():
            return partial(_half_turns, node), (_DEGREES, *node.operands)
    raise TypeError(f"{type(node).__name__} cannot be replayed")


def _of_angle(node: AngleFunction, angles: Angles) -> Array:
    column: Array = getattr(angles.multiple(node.multiple).shifted(node.shift), node.function)
    return column


def _sum(*terms: Array) -> Array:
    return np.asarray(functools.reduce(operator.add, terms))


def _read(function: Callable[[Array], Array], argument: Array) -> Array:
    return np.asarray(function(np.asarray(argument)), dtype=float)


def _solved(root: Root, *columns: Array) -> Array:
    return root.solve(columns)


def _half_turns(node: AngleUnwrap, degrees: Array, sin: Array, cos: Array) -> Array:
    return np.asarray(np.rint((node.near(degrees) - np.arctan(sin / cos)) / np.pi))


def _law(law: TracedValue) -> _Step:
    """Return the step of one law of a piecewise column: a formula on its own interval only, other columns sliced."""
    if law.varies and (isinstance(law.node, FormulaCall) or (isinstance(law.node, Tabulated) and law.node.by is None)):
        return _step(law.node)
    return _itself, (law,)


def _itself(column: Array) -> Array:
    return column


def _piece_by_piece(ends: Array, laws: list[_Step], degrees: Array, *columns: Array | float) -> Array:
    """Return a column each stretch of which follows its own law."""
    law_of = np.minimum(np.searchsorted(ends, degrees, side="left"), len(laws) - 1)
    first = list(itertools.accumulate((len(inputs) for _, inputs in laws), initial=0))
    result = np.empty(degrees.size)
    for index, rows in _stretches(law_of):
        taken = columns[first[index] : first[index + 1]]
        result[rows] = laws[index][0](*(item[rows] if isinstance(item, np.ndarray) else item for item in taken))
    return result


def _stretches(law_of: NDArray[np.intp]) -> Iterator[tuple[int, slice | NDArray[np.intp]]]:
    """Yield each law that is followed and its rows: a slice where angles ascend, which copies nothing."""
    step = np.diff(law_of)
    if np.all(step >= 0):
        edges = [0, *(np.flatnonzero(step) + 1).tolist(), law_of.size]
        yield from ((int(law_of[first]), slice(first, end)) for first, end in itertools.pairwise(edges) if end > first)
    else:
        yield from ((index, np.flatnonzero(law_of == index)) for index in sorted(set(law_of.tolist())))
