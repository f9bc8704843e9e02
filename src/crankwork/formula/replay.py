"""The memory played again at any crank angles.

A column is never interpolated: what a table shows, a quadrature sums or another cylinder delays are the same
operations at the angles wanted.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from crankwork.formula.known import (
    Arithmetic,
    Array,
    Component,
    Delayed,
    HalfTurns,
    Known,
    Node,
    OfAngle,
    Pieces,
    Root,
    Table,
    Total,
    Use,
    in_order,
)

# Rows that are replayed together, so that what lies between formulas stays in the cache.
_ROWS = (1024, 32768)
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

    def earlier(self, by: Array, cycle: float) -> tuple[Self, NDArray[np.intp]]:
        """Return the distinct angles that lie earlier in the cycle by each of some amounts, and their places."""
        ...

    def __getitem__(self, part: slice) -> Self: ...

    def __len__(self) -> int: ...


class Program:
    """What has to be done, in order, to replay some columns."""

    def __init__(self, knowns: Mapping[str, Known]) -> None:
        self.knowns = dict(knowns)
        self._order = [one.node for one in in_order(self.knowns.values(), into=_beside) if one.varies]
        self._spent = self._last_uses()
        nodes = [node for node in self._order if isinstance(node, Delayed)]
        self._earlier = [_Earlier(nodes, cycle) for cycle in sorted({node.cycle for node in nodes})]

    def __call__(self, angles: Angles) -> dict[str, Array]:
        """Return the columns at crank angles, by key; what does not vary with the angle is repeated. [SI]"""
        count = len(angles)
        result = {key: np.full(count, known.node.value) for key, known in self.knowns.items() if not known.varies}
        wanted = {key: known for key, known in self.knowns.items() if known.varies}
        rows = {key: np.empty(count) for key in wanted}
        together = min(max(_NUMBERS // max(len(self._order), 1), _ROWS[0]), _ROWS[1])
        for start in range(0, count, together):
            part = slice(start, min(start + together, count))
            # a vertical link has no slope, and its arc tangent is a right angle
            with np.errstate(divide="ignore"):
                values = self._replay(angles[part])
            for key, known in wanted.items():
                rows[key][part] = values[id(known.node)]
        return {key: result[key] if key in result else rows[key] for key in self.knowns}

    def _replay(self, angles: Angles) -> dict[int, Array]:
        values: dict[int, Array] = {}
        for one in self._earlier:
            values |= one(angles)
        for node, spent in zip(self._order, self._spent, strict=True):
            if id(node) not in values:
                values[id(node)] = _column(node, angles, values)
            for gone in spent:
                values.pop(gone, None)
        return values

    def _last_uses(self) -> list[list[int]]:
        """Return for each node in order which others nothing needs after it."""
        last = {id(one.node): at for at, node in enumerate(self._order) for one in _beside(node)}
        spent: list[list[int]] = [[] for _ in self._order]
        wanted = {id(known.node) for known in self.knowns.values()}
        for one, at in last.items():
            if one not in wanted:
                spent[at].append(one)
        return spent


def replay(known: Known, angles: Angles) -> Array:
    """Return one column at crank angles."""
    return Program({"": known})(angles)[""]


def _beside(node: Node) -> tuple[Known, ...]:
    """Return the operands that are replayed at the same angles: not those of a delay, and not the laws of pieces."""
    if isinstance(node, Delayed) or node.value is not None:
        return ()
    if isinstance(node, Table):
        return () if node.by is None else (node.by,)
    if isinstance(node, Pieces):
        return tuple(itertools.chain.from_iterable(_beside_law(law) for law in node.operands if law.varies))
    return node.operands


def _beside_law(law: Known) -> tuple[Known, ...]:
    """Return what a law of pieces needs at all angles; the formula of the law itself is used on its own stretch."""
    match law.node:
        case Use():
            return law.node.operands
        case Table(by=None):
            return ()
    return (law,)


class _Earlier:
    """Delayed columns: what is delayed is replayed once, at all the angles that any delay asks for."""

    def __init__(self, nodes: list[Delayed], cycle: float) -> None:
        self._nodes, self._cycle = [node for node in nodes if node.cycle == cycle], cycle
        self._by = np.array(sorted({node.by for node in self._nodes}))
        self._row = {float(one): at for at, one in enumerate(self._by)}
        self._program = Program({str(id(node.of.node)): node.of for node in self._nodes})

    def __call__(self, angles: Angles) -> dict[int, Array]:
        distinct, places = angles.earlier(self._by, self._cycle)
        columns = self._program(distinct)
        return {id(node): columns[str(id(node.of.node))][places[self._row[node.by]]] for node in self._nodes}


def _column(node: Node, angles: Angles, values: Mapping[int, Array]) -> Array:
    match node:
        case OfAngle():
            grid = angles.multiple(node.multiple).shifted(node.shift)
            column: Array = getattr(grid, node.function)
            return column
        case Use():
            return np.asarray(node.formula.function(*_inputs(node.inputs, values)))
        case Arithmetic():
            return np.asarray(node.function(*_inputs(node.inputs, values)))
        case Total():
            return np.asarray(sum(_inputs(node.operands, values)))
        case Pieces():
            return _piece_by_piece(node, angles, values)
        case Table():
            at = angles.degrees if node.by is None else np.asarray(_inputs((node.by,), values)[0])
            return np.asarray(node.function(at), dtype=float)
        case Root():
            return node.solve(_inputs(node.operands, values) if node.operands else angles)
        case Component():
            return np.asarray(values[id(node.operands[0].node)][node.at])
        case HalfTurns():
            sin, cos = _inputs(node.operands, values)
            return np.rint((node.near(angles.degrees) - np.arctan(sin / cos)) / np.pi)
    raise TypeError(f"{type(node).__name__} cannot be replayed")


def _inputs(inputs: Iterable[Known | float], values: Mapping[int, Array]) -> list[Array | float]:
    found: list[Array | float] = []
    for one in inputs:
        if not isinstance(one, Known):
            found.append(one)
        elif one.node.value is not None:
            found.append(one.node.value)
        else:
            found.append(values[id(one.node)])
    return found


def _piece_by_piece(node: Pieces, angles: Angles, values: Mapping[int, Array]) -> Array:
    """Return a column each stretch of which follows its own law."""
    law_of = np.minimum(np.searchsorted(node.ends, angles.degrees, side="left"), len(node.operands) - 1)
    result = np.empty(len(angles))
    for at, rows in _stretches(law_of):
        law = node.operands[at]
        match law.node:
            case Use(formula=formula, inputs=inputs) if law.varies:
                taken = [one[rows] if isinstance(one, np.ndarray) else one for one in _inputs(inputs, values)]
                result[rows] = formula.function(*taken)
            case Table(function=function, by=None):
                result[rows] = function(angles.degrees[rows])
            case inner:
                result[rows] = law.value if not law.varies else values[id(inner)][rows]
    return result


def _stretches(law_of: NDArray[np.intp]) -> Iterator[tuple[int, slice | NDArray[np.intp]]]:
    """Yield each law that is followed and its rows: a slice where angles ascend, which copies nothing."""
    step = np.diff(law_of)
    if np.all(step >= 0):
        edges = [0, *(np.flatnonzero(step) + 1).tolist(), law_of.size]
        yield from ((int(law_of[first]), slice(first, end)) for first, end in itertools.pairwise(edges) if end > first)
    else:
        yield from ((at, np.flatnonzero(law_of == at)) for at in sorted(set(law_of.tolist())))
