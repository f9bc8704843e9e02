"""From memories to a graph: formulas opened, and of what is given that which designs differ in made an input.

The memories of some designs are walked side by side. They must be made the same way; numbers given that differ are
followed to the fields that are varied, and whatever else differs cannot be compiled.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import CrankworkError
from crankwork.formula.known import (
    Arithmetic,
    Chosen,
    Component,
    Delayed,
    Found,
    Given,
    HalfTurns,
    Harmonic,
    Known,
    Node,
    OfAngle,
    Pieces,
    Procedure,
    Root,
    Table,
    Total,
    Use,
    distinct,
    in_order,
)
from crankwork.formula.replay import Angles
from crankwork.kernel.derivative import ByAngle
from crankwork.kernel.graph import End, Graph, Value
from crankwork.kernel.graph import in_order as values_in_order

Array = NDArray[np.float64]

# How far a number given may be from what follows of a field, of its size.
_SAME = 1e-12
# How far the ends of a law may be from each other in two designs where they stay. [deg]
_SAME_END = 1e-9
# How far a direction may be from that of the stated design for its half turns to be the same. [rad]
_NEAR_DIRECTION = 1.0


# how many laws are loops of all that follows of them
_FEW_LAWS = 4
# how far beyond those that are compared an end is looked for: of what they span, and at least [deg]
_BEYOND, _LEAST_BEYOND = 0.5, 0.01
# steps to an angle, and how short the last one must be [deg]
_STEPS, _SETTLED = 6, 1e-7

# Why a calculation is not compiled.
Reason = Literal[
    "absent",
    "ways",
    "several_fields",
    "curved_field",
    "table",
    "direction",
    "ends",
    "solved",
    "procedure",
    "partial",
    "differs",
]


class NotCompiledError(CrankworkError):
    """A calculation that cannot be compiled: why, and the key at which that shows."""

    def __init__(self, reason: Reason, key: str) -> None:
        super().__init__(f"{reason}: {key}")
        self.reason, self.key = reason, key


@dataclass(frozen=True)
class _Wave:
    """A sine or cosine of so many waves over an angle. [deg]"""

    function: np.ufunc
    order: float

    def __call__(self, degrees: Array) -> Array:
        """Return it at crank angles."""
        return np.asarray(self.function(self.order * degrees))


class Designs:
    """The memories of some designs side by side: which numbers differ, and how they follow from the varied fields.

    `memories` and `fields` as a `Kernel` takes them.
    """

    def __init__(self, memories: Sequence[Mapping[str, Known]], fields: Array, keys: Iterable[str]) -> None:
        self.memories, self.fields = memories, fields
        self._alike: dict[int, tuple[Node, ...]] = {}
        self._told: dict[int, Known] = {}
        self.differs: dict[int, bool] = {}
        for key in keys:
            self.add(key)

    def add(self, key: str) -> None:
        """Look through what a key is made of; what is made in several ways is refused each time it is come upon."""
        if any(key not in one for one in self.memories):
            raise NotCompiledError("absent", key)
        knowns = tuple(one[key] for one in self.memories)
        fresh: list[int] = []
        try:
            self._walk(key, knowns, fresh)
        except NotCompiledError:
            for one in fresh:
                del self._alike[one]
            raise

    def _walk(self, key: str, knowns: tuple[Known, ...], fresh: list[int]) -> None:
        stack = [(tuple(one.node for one in knowns), key)]
        while stack:
            nodes, name = stack.pop()
            first = nodes[0]
            if id(first) in self._alike:
                continue
            for other in nodes[1:]:
                if not _are_alike(first, other):
                    raise NotCompiledError("ways", name)
            self._alike[id(first)] = nodes
            fresh.append(id(first))
            stack += [
                (tuple(one.node for one in operands), operands[0].key or name)
                for operands in zip(*(self.made_of(one) for one in nodes), strict=True)
            ]
        for known in in_order(knowns[:1], into=self.made_of):
            node = known.node
            if id(node) not in self.differs:
                below = any(self.differs[id(one.node)] for one in self.made_of(node))
                self.differs[id(node)] = below or len({one.value for one in self._alike[id(node)]}) > 1

    def made_of(self, node: Node) -> Sequence[Known]:
        """Return all that a node follows from, also where it is told in knowns for nothing but this."""
        match node:
            case Pieces(retold=retold) if retold is not None:
                return (self.told(node),)
            case Pieces(places=places):
                return (*node.operands, *(one for one in places if isinstance(one, Known)))
            case Found(by=by, retold=retold) if by is not None:
                return (*node.operands, by) if retold is None else (retold,)
            case Use(retold=retold) if retold is not None:
                return (retold,)
        return node.operands

    def told(self, node: Pieces) -> Known:
        """Return pieces as they are told in knowns."""
        if id(node) not in self._told and node.retold is not None:
            self._told[id(node)] = node.retold()
        return self._told[id(node)]

    def twins(self, node: Node) -> tuple[Node, ...]:
        """Return a node of the stated design and what stands in its place in the others."""
        return self._alike[id(node)]

    def followed(self, node: Given, graph: Graph) -> Value:
        """Return how a number that is given follows from the one field that moves it, which must be a straight line."""
        values = np.array([one.value for one in self.twins(node)], dtype=float)
        moved = [
            field
            for field in range(self.fields.shape[1])
            if len({values[0], values[1 + 2 * field], values[2 + 2 * field]}) > 1
        ]
        if len(moved) != 1:
            raise NotCompiledError("several_fields", node.path)
        x = self.fields[:, moved[0]]
        low, high = 1 + 2 * moved[0], 2 + 2 * moved[0]
        slope = (values[high] - values[low]) / (x[high] - x[low])
        offset = values[0] - slope * x[0]
        size = float(np.max(np.abs(values)))
        if np.max(np.abs(slope * x + offset - values)) > _SAME * size:
            raise NotCompiledError("curved_field", node.path)
        if abs(offset) <= _SAME * size:
            # the slope of a factor of units, found again to the last digit
            slope, offset = values[0] / x[0] if x[0] else slope, 0.0
        return graph.input(moved[0]) * float(slope) + float(offset)


def _are_alike(one: Node, other: Node) -> bool:
    """Return whether two nodes are made the same way of what may differ."""
    if type(one) is not type(other) or len(one.operands) != len(other.operands):
        return False
    match one, other:
        case Given(is_absent=a), Given(is_absent=b):
            return a == b
        case (Use(formula=f, inputs=i), Use(formula=g, inputs=j)) | (
            Arithmetic(function=f, inputs=i),
            Arithmetic(function=g, inputs=j),
        ):
            return f is g and _plain(i) == _plain(j)
        case OfAngle(), OfAngle():
            return (one.function, one.multiple, one.shift) == (other.function, other.multiple, other.shift)
        case Delayed(by=a, cycle=c), Delayed(by=b, cycle=d):
            return (a, c) == (b, d)
        case Pieces(), Pieces():
            return one.retold is not None or _end_alike(_plain(one.places), _plain(other.places))
        case Procedure(function=f, part=a), Procedure(function=g, part=b):
            return f == g and a == b
        case Harmonic(order=a, part=b), Harmonic(order=c, part=d):
            return (a, b) == (c, d)
        case (Component(at=a), Component(at=b)) | (Found(word=a), Found(word=b)):
            return bool(a == b)
    return True


def _plain(inputs: Iterable[Known | float]) -> list[float | None]:
    return [None if isinstance(one, Known) else float(one) for one in inputs]


def _end_alike(ends: list[float | None], others: list[float | None]) -> bool:
    """Return whether laws end at the same crank angles, but for rounding, or where the design puts them. [deg]"""
    return len(ends) == len(others) and all(
        a is b is None or (a is not None and b is not None and abs(a - b) <= _SAME_END)
        for a, b in zip(ends, others, strict=True)
    )


def _needs_more(value: Value) -> bool:
    if value.kind == "pieces":
        return any(end.value is not None for end in value.detail[0])
    return value.kind == "reduction" and value.detail.startswith("procedure")


class Trace:
    """Values of a graph for what is remembered.

    `looked`: crank angles at which tables of designs are compared [deg]; `is_shifted`: whether columns of other
    cylinders are calculated again at their own angle, not read from where they stand.
    """

    def __init__(
        self, designs: Designs, angles_at: Callable[[Any], Angles], looked: Array, *, is_shifted: bool
    ) -> None:
        self.graph, self._looked = Graph(), looked
        self._designs, self._angles_at, self._is_shifted = designs, angles_at, is_shifted
        # what must be above zero for a design to be as those that are compared
        self._guards: list[Value] = []
        self._ends: dict[int, tuple[End, Array]] = {}
        self._made: dict[tuple[int, float | None, float], Value] = {}
        self._by_angle = ByAngle(self.graph)
        self._waves: dict[tuple[str, float], _Wave] = {}
        # keys that were looked at and are the same in every design
        self.steady: set[str] = set()

    def compiling(self, keys: Iterable[str]) -> list[str]:
        """Return those of some keys that compile, that designs differ in, and that need loops and extremes alone.

        Neither laws that end where the design puts them, nor procedures.
        """
        found = []
        for key in keys:
            try:
                self._designs.add(key)
                value = self.value(self._designs.memories[0][key])
            except NotCompiledError:
                continue
            every = list(values_in_order([value]))
            if not value.by_design:
                self.steady.add(key)
            # a column that is kept is one of each design, whether or not it follows from what designs state
            elif any(one.kind == "input" for one in every) and not any(map(_needs_more, every)):
                found.append(key)
        return found

    def reductions(self, known: Known) -> frozenset[int]:
        """Return the places in the graph of what a value has of whole columns."""
        return frozenset(one.at for one in values_in_order([self.value(known)]) if one.kind == "reduction")

    def value(self, known: Known, *, shift: float = 0.0, fixed: float | None = None) -> Value:
        """Return the value of what is remembered, at angles larger by some degrees or at one angle. [deg]"""
        for one in in_order([known], into=self._into):
            self._once(one, shift, fixed)
        return self._made[id(known.node), fixed, shift]

    def _into(self, node: Node) -> Sequence[Known]:
        """Return what is to be made at the same angle before a node is."""
        if node.value is not None and not self._designs.differs[id(node)]:
            return ()
        if isinstance(node, Pieces | Use) and node.retold is not None:
            return self._designs.made_of(node)
        return () if isinstance(node, Delayed | Found) else node.operands

    def _once(self, known: Known, shift: float, fixed: float | None) -> None:
        node = known.node
        key = id(node), fixed, shift
        if key in self._made:
            return
        if node.value is not None and not self._designs.differs[id(node)]:
            self._made[key] = self.graph.constant(node.value)
            return

        def of(one: Known | float) -> Value | float:
            return self._made[id(one.node), fixed, shift] if isinstance(one, Known) else float(one)

        self._made[key] = self._value(known, of, shift, fixed)

    def _value(self, known: Known, of: Any, shift: float, fixed: float | None) -> Value:  # noqa: ANN401
        node = known.node
        match node:
            case Given():
                return self._designs.followed(node, self.graph)
            case Use(retold=retold) if retold is not None:
                return self._as_value(of(retold))
            case Use() | Arithmetic():
                function = node.formula.function if isinstance(node, Use) else node.function
                return self._as_value(function(*map(of, node.inputs)))
            case Total():
                return self._as_value(functools.reduce(operator.add, map(of, node.operands)))
            case Chosen():
                return self.graph.apply("choose", *map(of, node.operands))
            case Procedure():
                return self.graph.procedure(node.function, node.part, map(self.value, node.operands))
            case Harmonic():
                return self._harmonic(self.value(node.operands[0]), node)
            case Found():
                return self._found(known, node) if node.retold is None else self.value(node.retold)
            case Root() | Component():
                raise NotCompiledError("solved", known.key)
        return self._of_angles(known, of, shift, fixed)

    def _of_angles(self, known: Known, of: Any, shift: float, fixed: float | None) -> Value:  # noqa: ANN401
        """Return what is another at every crank angle."""
        node = known.node
        match node:
            case OfAngle():
                return self._of_angle(node, shift, fixed)
            case Delayed():
                return self._delayed(node, shift, fixed)
            case Pieces(retold=retold) if retold is not None:
                return self._as_value(of(self._designs.told(node)))
            case Pieces():
                return self._pieces(known, node, of, shift, fixed)
            case Table() if fixed is None:
                return self._table(node, shift)
            case HalfTurns() if fixed is None:
                return self._half_turns(node, of, shift)
        raise NotCompiledError("table", known.key)

    def _as_value(self, result: Any) -> Value:  # noqa: ANN401
        return result if isinstance(result, Value) else self.graph.constant(float(result))

    def _of_angle(self, node: OfAngle, shift: float, fixed: float | None) -> Value:
        if fixed is None:
            # counted from the start of the cycle, which a multiple is not
            function = "within" if node.function == "degrees" else node.function
            return self.graph.angle(function, node.multiple, node.shift + node.multiple * shift)
        angles: Angles = self._angles_at([fixed])
        column = getattr(angles.multiple(node.multiple).shifted(node.shift), node.function)
        return self.graph.constant(float(column[0]))

    def _delayed(self, node: Delayed, shift: float, fixed: float | None) -> Value:
        if fixed is not None:
            return self.value(node.of, fixed=(fixed - node.by) % node.cycle)
        if self._is_shifted:
            return self.value(node.of, shift=shift - node.by)
        # the end of a cycle is its start for other cylinders, also for one that is no later
        return self.graph.delayed(self.value(node.of, shift=shift), node.by or node.cycle)

    def _pieces(self, known: Known, node: Pieces, of: Any, shift: float, fixed: float | None) -> Value:  # noqa: ANN401
        laws = tuple(self._as_value(of(one)) for one in node.operands)
        ends = tuple(self._end(one) for one in node.places)
        if fixed is not None:
            if any(one.low <= fixed <= one.high for one in ends if one.value is not None):
                raise NotCompiledError("ends", known.key)
            return laws[min(int(np.searchsorted(node.ends, fixed, side="left")), len(laws) - 1)]
        pieces = self.graph.pieces(ends, laws, shift)
        # many laws are short loops of their own, and what follows of them one for all
        return self.graph.delayed(pieces, 0.0) if len(laws) > _FEW_LAWS else pieces

    def _end(self, place: Known | float) -> End:
        """Return where a law ends, in the designs that are compared and a little beyond."""
        if not isinstance(place, Known) or not self._designs.differs[id(place.node)]:
            angle = place.value if isinstance(place, Known) else place
            return End(angle, angle, angle)
        of_twins = [one.value or 0.0 for one in self._designs.twins(place.node)]
        low, high = min(of_twins), max(of_twins)
        if self._designs.fields.shape[1] == 1 and high - low <= _SAME * high:
            # made of the one number that differs, and there all the same
            return End(low, low, low)
        spare = _BEYOND * (high - low) + _LEAST_BEYOND
        end = End(place.value, low - spare, high + spare, self.value(place))
        self._ends[end.value.at if end.value else -1] = end, np.array(of_twins)
        return end

    @property
    def moving(self) -> list[tuple[Value, Array]]:
        """The ends of laws that follow from the design, and their crank angles in those that are compared. [deg]"""
        return [(end.value, angles) for end, angles in self._ends.values() if end.value is not None]

    def zones(self, breaks: Array) -> Array:
        """Return breaks with those between which designs choose their law. [deg]"""
        start, cycle = breaks[0], breaks[-1] - breaks[0]
        pieces = [one for one in self.graph.values if one.kind == "pieces"]
        moving = [(end, one.detail[1]) for one in pieces for end in one.detail[0] if end.value is not None]
        found = [(at - shift - start) % cycle + start for end, shift in moving for at in (end.low, end.high)]
        return distinct(np.concatenate([breaks, found]))

    def guard(self, *, is_sampled: bool) -> Value | None:
        """Return what is infinite for designs that are not as those that are compared, if there may be any."""
        ends = [(end, end.value) for end, _ in self._ends.values() if is_sampled and end.value is not None]
        guards = [*self._guards, *((value - end.low) * (end.high - value) for end, value in ends)]
        result = self.graph.constant(0.0)
        for one in guards:
            result = self.graph.apply("choose", one, result, math.inf)
        return result if guards else None

    def _table(self, node: Table, shift: float) -> Value:
        """Return what is read at the crank angle from a table that is the same for all designs."""
        if node.by is not None or not self._are_near(node, lambda one: one.function, 0.0):
            raise NotCompiledError("table", node.word)
        return self.graph.reading(node.function, shift)

    def _half_turns(self, node: HalfTurns, of: Any, shift: float) -> Value:  # noqa: ANN401
        """Return the half turns of a direction, which is roughly that of the stated design."""
        if not self._are_near(node, lambda one: one.near, _NEAR_DIRECTION):
            raise NotCompiledError("direction", node.operands[0].key)
        sin, cos = map(of, node.operands)
        near = self.graph.reading(node.near, shift)
        return self.graph.apply("half_turns", near, self.graph.apply("arctan", sin / cos))

    def _are_near(self, node: Node, function: Callable[[Any], Callable[[Array], Array]], limit: float) -> bool:
        """Return whether functions of the crank angle of all designs are as good as that of the stated one."""
        stated, *others = (np.asarray(function(one)(self._looked)) for one in self._designs.twins(node))
        return all(bool(np.all(np.abs(one - stated) <= limit)) for one in others)

    def _found(self, known: Known, node: Found) -> Value:
        match node.word:
            case "at" if node.by is not None and self._designs.differs[id(node.by.node)]:
                return self._at(node.operands[0], self.value(node.by))
            case "at" if len({getattr(one, "at", None) for one in self._designs.twins(node)}) == 1:
                return self.value(node.operands[0], fixed=node.at)
            case "reached" if node.by is not None:
                return self._reached(node, self.value(node.by))
            case "sine" | "cosine":
                return self.graph.apply("sin" if node.word == "sine" else "cos", self.value(node.operands[0]))
            case "mean" | "range" | "max" | "min" | "max_angle" | "min_angle" if node.operands[0].varies:
                return self.graph.reduction(node.word, self.value(node.operands[0]))
            case "time_ratio":
                return self._time_ratio(*map(self.value, node.operands))
            case "harmonic_mean":
                return 1.0 / self.graph.reduction("mean", 1.0 / self.value(node.operands[0]))
            case "tangents":
                return self.graph.reduction(node.word, *map(self.value, node.operands))
            case "work":
                pressure, volume = map(self.value, node.operands)
                return self.graph.reduction("integral", pressure * self._by_angle.of(volume))
        raise NotCompiledError("procedure", known.key or node.word)

    def _harmonic(self, column: Value, node: Harmonic) -> Value:
        """Return twice the mean of a column times a wave."""
        function = {"cosine": "cos", "sine": "sin"}[node.part]
        if node.order == int(node.order):
            wave = self.graph.angle(function, int(node.order), 0.0)
        else:
            self._waves.setdefault((function, node.order), _Wave(getattr(np, function), math.radians(node.order)))
            wave = self.graph.reading(self._waves[function, node.order], 0.0)
        return self.graph.reduction("mean", column * wave) * 2.0

    def _at(self, column: Known, degrees: Value) -> Value:
        try:
            return self.graph.at_angle(self.value(column), degrees)
        except TypeError:
            raise NotCompiledError("ends", column.key) from None

    def _reached(self, node: Found, wanted: Value) -> Value:
        """Return the crank angle where a column reaches a value, by Newton's steps. [deg]"""
        column = node.operands[0]
        try:
            slope = self._by_angle.of(self.value(column))
        except (KeyError, TypeError):
            raise NotCompiledError("ends", column.key) from None
        # a volume grows ever faster after a dead centre: from the far side steps do not go past it
        angle = self.graph.constant(max(one.value or 0.0 for one in self._designs.twins(node)))
        step = angle
        for _ in range(_STEPS):
            step = (self._at(column, angle) - wanted) / self.graph.at_angle(slope, angle) * (180 / math.pi)
            angle = angle - step
        self._guards.append(_SETTLED**2 - step * step)
        return angle

    def _time_ratio(self, high: Value, low: Value) -> Value:
        """Return the slower way between two crank angles over the faster one, whichever turns they stand in."""
        half = self.graph.apply("tan", (high - low) / 2.0)
        fast = self.graph.apply("arctan", self.graph.apply("sqrt", half * half)) * 2.0
        return (2 * math.pi - fast) / fast
