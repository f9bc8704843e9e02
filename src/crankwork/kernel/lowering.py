"""Lower the traces of several designs to one kernel graph; inputs in which the designs differ become arguments.

The traces are walked side by side. They must have the same structure; inputs that differ are linear functions of the
varied fields, and other differences cannot be compiled.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import CrankworkError
from crankwork.formula.replay import Angles, replay
from crankwork.formula.traced_value import (
    AngleFunction,
    AngleUnwrap,
    Arithmetic,
    Component,
    Conditional,
    Delayed,
    FormulaCall,
    FunctionValue,
    HarmonicCoefficient,
    Input,
    Node,
    Piecewise,
    ProcedureValue,
    Root,
    Sum,
    Tabulated,
    TracedValue,
    in_order,
    unique_sorted,
)
from crankwork.kernel.graph import ByAngle, KernelGraph, KernelValue, LawEnd
from crankwork.kernel.graph import in_order as values_in_order
from crankwork.kernel.schedule import replaced

Array = NDArray[np.float64]
T = TypeVar("T")

# Tolerance of an input as a linear function of a field, relative to its size.
_TOLERANCE = 1e-12
# how far a column may pass a point of a table, relative to the distance of its neighbours
_PASSED = 1e-9
# Tolerance of the ends of a law that are equal in all designs. [deg]
_END_TOLERANCE = 1e-9
# Largest change of a direction from the stated design for which its half turns are the same. [rad]
_NEAR_DIRECTION = 1.0


# largest number of laws for which all dependent columns are in the same loops
_FEW_LAWS = 4
# margin around the ends of a law in the compared designs: relative to their range, and at least [deg]
_BEYOND, _MIN_BEYOND = 0.5, 0.01
# Newton steps to an angle, and the largest last step [deg]
_STEPS, _CONVERGED = 6, 1e-7
# Newton steps to forces with friction, and the largest last step relative to their size
_FORCE_STEPS, _SETTLED = 5, 1e-8
# share of the largest force that counts as force
_SMALL = 1e-6

# procedures that look at a whole column
_REDUCTIONS = (
    "mean", "range", "max", "min", "max_angle", "min_angle", "harmonic_mean", "tangents", "work", "fourier",
    "error",
)  # fmt: skip
# Why a calculation is not compiled.
Reason = Literal[
    "absent", "ways", "several_fields", "curved_field", "table", "direction", "ends", "solved", "procedure", "partial",
    "differs",
]  # fmt: skip


class NotCompiledError(CrankworkError):
    """A calculation that cannot be compiled: the reason, a key that shows it, and the `values` that cannot."""

    def __init__(self, reason: Reason, key: str, values: Collection[str] = ()) -> None:
        super().__init__(f"{reason}: {key}")
        self.reason, self.key, self.values = reason, key, set(values)


def compiled_values(compile_one: Callable[[str], T], keys: Iterable[str]) -> dict[str, T]:
    """Return what is made of each key; raise the first error, with all keys of which nothing is made."""
    results, errors = dict[str, T](), dict[str, NotCompiledError]()
    for key in keys:
        try:
            results[key] = compile_one(key)
        except NotCompiledError as error:
            errors[key] = error
    for first in errors.values():
        raise NotCompiledError(first.reason, first.key, errors)
    return results


@dataclass(frozen=True)
class _Wave:
    """A sine or cosine of some order over an angle. [deg]"""

    function: np.ufunc
    order: float

    def __call__(self, degrees: Array) -> Array:
        """Return its values at crank angles."""
        return np.asarray(self.function(self.order * degrees))


class DesignTraces:
    """Traces of some designs side by side: which numbers differ, and how they depend on the varied fields.

    `traces` and `fields` as of a `Kernel`.
    """

    def __init__(self, traces: Sequence[Mapping[str, TracedValue]], fields: Array, keys: Iterable[str]) -> None:
        self.traces, self.fields = traces, fields
        self._matched: dict[int, tuple[Node, ...]] = {}
        self._general_forms: dict[int, TracedValue] = {}
        self.differs: dict[int, bool] = {}
        self.roots: list[Node] = []
        compiled_values(self.add, keys)

    def add(self, key: str) -> None:
        """Compare the dependencies of a key; a difference of structure raises an error on each call."""
        if any(key not in trace for trace in self.traces):
            raise NotCompiledError("absent", key)
        traced = tuple(trace[key] for trace in self.traces)
        new: list[int] = []
        try:
            self._walk(key, traced, new)
        except NotCompiledError:
            for node in new:
                del self._matched[node]
            raise

    def _walk(self, key: str, traced: tuple[TracedValue, ...], new: list[int]) -> None:
        stack = [(tuple(known.node for known in traced), key)]
        while stack:
            nodes, name = stack.pop()
            first = nodes[0]
            if id(first) in self._matched:
                continue
            for other in nodes[1:]:
                # of general forms these are compared
                are_general = _has_general_form(first) and _has_general_form(other)
                if not are_general and not _have_same_structure(first, other):
                    raise NotCompiledError("ways", name)
            self._matched[id(first)] = nodes
            new.append(id(first))
            needed = [(*self.dependencies(node), *_solved(node)) for node in nodes]
            if len({len(operands) for operands in needed}) > 1:
                raise NotCompiledError("ways", name)
            stack += [
                (tuple(operand.node for operand in operands), operands[0].key or name)
                for operands in zip(*needed, strict=True)
            ]
        roots = [self._matched[node][0] for node in new if isinstance(self._matched[node][0], Root)]
        self.differs |= {id(root): True for root in roots}
        self.roots += roots
        below_roots = (known for root in roots for known in _solved(root))
        for known in in_order((*below_roots, *traced[:1]), into=self.dependencies):
            node = known.node
            if id(node) not in self.differs:
                below = any(self.differs[id(operand.node)] for operand in self.dependencies(node))
                self.differs[id(node)] = below or len({other.value for other in self._matched[id(node)]}) > 1

    def dependencies(self, node: Node) -> Sequence[TracedValue]:
        """Return the dependencies of a node, those of its general form if it has one."""
        match node:
            case Piecewise(general_form=retold) if retold is not None:
                return (self.general_form(node),)
            case Piecewise(places=places):
                return (*node.operands, *(place for place in places if isinstance(place, TracedValue)))
            case ProcedureValue(by=argument, general_form=retold) if argument is not None:
                return (*node.operands, argument) if retold is None else (retold,)
            case FormulaCall(general_form=retold) if retold is not None:
                return (retold,)
        return node.operands

    def general_form(self, node: Piecewise) -> TracedValue:
        """Return the general form of pieces."""
        if id(node) not in self._general_forms and node.general_form is not None:
            self._general_forms[id(node)] = node.general_form()
        return self._general_forms[id(node)]

    def counterparts(self, node: Node) -> tuple[Node, ...]:
        """Return a node of the stated design and the corresponding nodes of the others."""
        return self._matched[id(node)]

    def linear_dependence(self, node: Input, graph: KernelGraph) -> KernelValue:
        """Return an input as a linear function of the field that changes it, or of several.

        These take a design in which all fields differ, so that products are found.
        """
        values = np.array([counterpart.value for counterpart in self.counterparts(node)], dtype=float)
        size = float(np.max(np.abs(values)))
        pairs = np.abs(values[1 : 1 + 2 * self.fields.shape[1]].reshape(-1, 2) - values[0]).max(axis=1)
        moved = np.flatnonzero(pairs > _TOLERANCE * size).tolist()
        if not moved and np.ptp(values) <= _TOLERANCE * size:
            return graph.constant(values[0])
        if len(moved) != 1 and (not moved or len(values) <= 1 + 2 * self.fields.shape[1]):
            raise NotCompiledError("several_fields", node.path)
        x, low, high = self.fields[:, moved], 1 + 2 * np.array(moved), 2 + 2 * np.array(moved)
        slopes = (values[high] - values[low]) / np.diag(x[high] - x[low])
        offset = values[0] - x[0] @ slopes
        if np.max(np.abs(x @ slopes + offset - values)) > _TOLERANCE * size:
            raise NotCompiledError("curved_field", node.path)
        if abs(offset) <= _TOLERANCE * size:
            # exact to the last digit, if the field only has another unit
            slopes, offset = values[:1] / x[0] if len(moved) == 1 and x[0, 0] else slopes, 0.0
        terms = (graph.input(index) * slope for index, slope in zip(moved, slopes.tolist(), strict=True))
        return sum(terms, graph.constant(float(offset)))


def _solved(node: Node) -> Sequence[TracedValue]:
    """Return what the unknowns of a root follow from, and where they have corners."""
    if not isinstance(node, Root):
        return ()
    return (*node.residuals, *(known for column, ends in node.sides for known in (column, *ends)))


def _has_general_form(node: Node) -> bool:
    return isinstance(node, FormulaCall | ProcedureValue) and node.general_form is not None


def _have_same_structure(first: Node, second: Node) -> bool:
    """Return whether two nodes have the same structure, so that only their numbers may differ."""
    if type(first) is not type(second) or len(first.operands) != len(second.operands):
        return False
    match first, second:
        case Input(is_absent=a), Input(is_absent=b):
            return a == b
        case (FormulaCall(formula=f, inputs=i), FormulaCall(formula=g, inputs=j)) | (
            Arithmetic(function=f, inputs=i),
            Arithmetic(function=g, inputs=j),
        ):
            return f is g and _plain(i) == _plain(j)
        case AngleFunction(), AngleFunction():
            return (first.function, first.multiple, first.shift) == (second.function, second.multiple, second.shift)
        case Delayed(by=a, cycle=c), Delayed(by=b, cycle=d):
            return (a, c) == (b, d)
        case Piecewise(), Piecewise():
            return first.general_form is not None or _end_at_same_angles(_plain(first.places), _plain(second.places))
        case FunctionValue(function=f, part=a), FunctionValue(function=g, part=b):
            return f == g and a == b
        case HarmonicCoefficient(order=a, part=b), HarmonicCoefficient(order=c, part=d):
            return (a, b) == (c, d)
        case (Component(at=a), Component(at=b)) | (ProcedureValue(word=a), ProcedureValue(word=b)):
            return bool(a == b)
    return True


def _plain(inputs: Iterable[TracedValue | float]) -> list[float | None]:
    return [None if isinstance(value, TracedValue) else float(value) for value in inputs]


def _end_at_same_angles(ends: list[float | None], other_ends: list[float | None]) -> bool:
    """Return whether laws end at the same crank angles but for rounding, or at ones that depend on the design. [deg]"""
    return len(ends) == len(other_ends) and all(
        a is b is None or (a is not None and b is not None and abs(a - b) <= _END_TOLERANCE)
        for a, b in zip(ends, other_ends, strict=True)
    )


def _is_delicate(node: ProcedureValue) -> bool:
    """Return whether a value may be rounding: a small difference of columns, the direction of a vector near zero."""
    formed = node.general_form
    return node.word == "error" or (formed is not None and getattr(formed.node, "word", "") == "direction")


def _needs_more(value: KernelValue) -> bool:
    if value.kind == "pieces":
        return any(end.value is not None for end in value.detail[0])
    return value.kind == "reduction" and value.detail.startswith("procedure")


class Lowering:
    """Converts traced values to values of a graph.

    `sample_angles`: crank angles at which tables of designs are compared [deg]; `is_shifted`: whether columns of other
    cylinders are calculated again at their own angle instead of being read from the stored column; `beforehand`: the
    index of the input that a node is, by its id.
    """

    def __init__(
        self,
        designs: DesignTraces,
        angles_at: Callable[[Any], Angles],
        sample_angles: Array,
        *,
        is_shifted: bool,
        is_exact: bool = False,
        beforehand: Mapping[int, int] | None = None,
    ) -> None:
        self.graph, self._sample_angles, self._beforehand = KernelGraph(), sample_angles, beforehand or {}
        self._designs, self.angles_at, self._is_shifted, self._is_exact = designs, angles_at, is_shifted, is_exact
        # positive for designs that are within the range of the compared ones
        self._guards: list[KernelValue] = []
        self._ends: dict[int, tuple[LawEnd, Array, TracedValue]] = {}
        self._values: dict[tuple[int, float | None, float], KernelValue] = {}
        self._by_angle = ByAngle(self.graph)
        self._roots: dict[tuple[int, float | None, float], list[KernelValue]] = {}
        self._waves: dict[tuple[str, float], _Wave] = {}
        # keys with the same value in every design
        self.steady: set[str] = set()

    def compiling(self, keys: Iterable[str]) -> list[str]:
        """Return the keys that compile, differ between designs, and need only loops and extremes.

        That is, neither laws whose ends depend on the design nor procedures.
        """
        compiled = []
        for key in keys:
            node = self._designs.traces[0][key].node
            if isinstance(node, ProcedureValue) and _is_delicate(node):
                continue
            try:
                self._designs.add(key)
                value = self.value(self._designs.traces[0][key])
            except NotCompiledError:
                continue
            nodes = list(values_in_order([value]))
            if not value.depends_on_design:
                self.steady.add(key)
            # a stored column depends on the design formally, even without inputs
            elif any(node.kind == "input" for node in nodes) and not any(map(_needs_more, nodes)):
                compiled.append(key)
        return compiled

    def reductions(self, known: TracedValue) -> frozenset[int]:
        """Return the indices in the graph of the reductions that a value depends on."""
        return frozenset(node.index for node in values_in_order([self.value(known)]) if node.kind == "reduction")

    def value(self, known: TracedValue, *, shift: float = 0.0, fixed: float | None = None) -> KernelValue:
        """Return a traced value in the graph, at angles larger by a shift or at a fixed angle. [deg]"""
        for operand in in_order([known], into=self._into):
            self._add(operand, shift, fixed)
        return self._values[id(known.node), fixed, shift]

    def _into(self, node: Node) -> Sequence[TracedValue]:
        """Return the operands that are needed at the same angle before a node."""
        if node.value is not None and not self._designs.differs[id(node)]:
            return ()
        if isinstance(node, Piecewise | FormulaCall) and node.general_form is not None:
            return self._designs.dependencies(node)
        return () if isinstance(node, Delayed | ProcedureValue) else node.operands

    def _add(self, known: TracedValue, shift: float, fixed: float | None) -> None:
        node = known.node
        key = id(node), fixed, shift
        if key in self._values:
            return
        if id(node) in self._beforehand:
            self._values[key] = self.graph.input(self._beforehand[id(node)])
            return
        if node.value is not None and not self._designs.differs[id(node)]:
            self._values[key] = self.graph.constant(node.value)
            return

        def value_of(operand: TracedValue | float) -> KernelValue | float:
            return self._values[id(operand.node), fixed, shift] if isinstance(operand, TracedValue) else float(operand)

        self._values[key] = self._value(known, value_of, shift, fixed)

    def _value(self, known: TracedValue, value_of: Any, shift: float, fixed: float | None) -> KernelValue:  # noqa: ANN401
        node = known.node
        match node:
            case Input():
                return self._designs.linear_dependence(node, self.graph)
            case FormulaCall(general_form=retold) if retold is not None:
                return self._as_value(value_of(retold))
            case FormulaCall() | Arithmetic():
                function = node.formula.function if isinstance(node, FormulaCall) else node.function
                return self._as_value(function(*map(value_of, node.inputs)))
            case Sum():
                return self._as_value(functools.reduce(operator.add, map(value_of, node.operands)))
            case Conditional():
                return self.graph.apply("choose", *map(value_of, node.operands))
            case ProcedureValue(word="harmonic" | "fourier") if self._is_zero(node):
                return self.graph.constant(0.0)
            case ProcedureValue():
                return self._found(known, node) if node.general_form is None else self.value(node.general_form)
            case Root():
                return self.graph.constant(0.0)
            case Component(operands=(root,), at=index):
                return self._unknowns(root, shift, fixed, known.key)[index]
        return self._of_angles(known, value_of, shift, fixed)

    def _of_angles(self, known: TracedValue, value_of: Any, shift: float, fixed: float | None) -> KernelValue:  # noqa: ANN401
        """Lower a node whose value depends on the crank angle."""
        node = known.node
        match node:
            case AngleFunction():
                return self._of_angle(node, shift, fixed)
            case Delayed():
                return self._delayed(node, shift, fixed)
            case Piecewise(general_form=retold) if retold is not None:
                return self._as_value(value_of(self._designs.general_form(node)))
            case Piecewise():
                return self._pieces(known, node, value_of, shift, fixed)
            case Tabulated(by=argument) if argument is not None:
                return self._table_over(node, value_of(argument), shift, fixed)
            case Tabulated() if fixed is None:
                return self._table(node, shift)
            case AngleUnwrap() if fixed is None:
                return self._half_turns(node, value_of, shift)
        raise NotCompiledError("table", known.key)

    def _as_value(self, result: Any) -> KernelValue:  # noqa: ANN401
        return result if isinstance(result, KernelValue) else self.graph.constant(float(result))

    def _of_angle(self, node: AngleFunction, shift: float, fixed: float | None) -> KernelValue:
        if fixed is None:
            # within the cycle, which a multiple is not
            function = "within" if node.function == "degrees" else node.function
            return self.graph.angle(function, node.multiple, node.shift + node.multiple * shift)
        angles: Angles = self.angles_at([fixed])
        column = getattr(angles.multiple(node.multiple).shifted(node.shift), node.function)
        return self.graph.constant(float(column[0]))

    def _delayed(self, node: Delayed, shift: float, fixed: float | None) -> KernelValue:
        if fixed is not None:
            return self.value(node.of, fixed=(fixed - node.by) % node.cycle)
        if self._is_shifted:
            return self.value(node.of, shift=shift - node.by)
        # the end of a cycle is its start for other cylinders, also for one without a delay
        return self.graph.delayed(self.value(node.of, shift=shift), node.by or node.cycle)

    def _pieces(
        self,
        known: TracedValue,
        node: Piecewise,
        value_of: Any,  # noqa: ANN401
        shift: float,
        fixed: float | None,
    ) -> KernelValue:
        laws = tuple(self._as_value(value_of(operand)) for operand in node.operands)
        ends = tuple(self._end(place) for place in node.places)
        if fixed is not None:
            if any(end.low <= fixed <= end.high for end in ends if end.value is not None):
                raise NotCompiledError("ends", known.key)
            return laws[min(int(np.searchsorted(node.ends, fixed, side="left")), len(laws) - 1)]
        pieces = self._stored(self.graph.pieces(ends, laws, shift), len(laws))
        if getattr(node.operands[0].node, "word", "") == "against":
            self._keep_sides(node.operands[0].node.operands[0], -pieces, shift)
        return pieces

    def _stored(self, pieces: KernelValue, count: int) -> KernelValue:
        """Return pieces, stored if they are of many laws or many operations follow.

        They have short loops of their own then, and the columns that depend on them one common loop.
        """
        return self.graph.delayed(pieces, 0.0) if count > _FEW_LAWS or self._designs.roots else pieces

    def _end(self, place: TracedValue | float) -> LawEnd:
        """Return the end of a law, with the interval of the compared designs and a margin."""
        if not isinstance(place, TracedValue) or not self._designs.differs[id(place.node)]:
            angle = place.value if isinstance(place, TracedValue) else place
            return LawEnd(angle, angle, angle)
        angles = np.array([node.value or 0.0 for node in self._designs.counterparts(place.node)])
        return self._law_end(angles, self.value(place), place)

    def _law_end(self, angles: Array, value: KernelValue | None, place: TracedValue) -> LawEnd:
        """Return the end of a law that is at these angles in the compared designs; `place`: what it follows from."""
        low, high = float(angles.min()), float(angles.max())
        is_single = self._designs.fields.shape[1] == 1
        if value is None or value.kind == "constant" or (is_single and high - low <= _TOLERANCE * high):
            # depends on numbers that differ, but is constant
            return LawEnd(low, low, low)
        margin = _BEYOND * (high - low) + _MIN_BEYOND
        end = LawEnd(float(angles[0]), low - margin, high + margin, value)
        self._ends[value.index] = end, angles, place
        return end

    def reduced_before_ends(self) -> dict[int, TracedValue]:
        """Return what must be reduced from columns before the ends of laws are known, by the ids of the nodes."""

        def into(node: Node) -> Sequence[TracedValue]:
            return () if is_reduced(node) else (*self._designs.dependencies(node), *_solved(node))

        def is_reduced(node: Node) -> bool:
            if not isinstance(node, ProcedureValue) or node.general_form is not None:
                return False
            return isinstance(node, FunctionValue) or node.word in _REDUCTIONS

        places = [
            place
            for end, _, place in self._ends.values()
            if end.value is not None and (end.value.level > 0 or id(place.node) in self._beforehand)
        ]
        below = {id(known.node): known for known in in_order(places, into=into) if is_reduced(known.node)}
        return {index: known for index, known in below.items() if self._designs.differs[index]}

    @property
    def moving(self) -> list[tuple[KernelValue, Array]]:
        """Ends of laws that depend on the design, and their crank angles in the compared designs. [deg]"""
        return [(end.value, angles) for end, angles, _ in self._ends.values() if end.value is not None]

    def zones(self, breaks: Array) -> Array:
        """Return breakpoints, with those between which designs choose their law. [deg]"""
        start, cycle = breaks[0], breaks[-1] - breaks[0]
        pieces = [value for value in self.graph.values if value.kind == "pieces"]
        moving = [(end, value.detail[1]) for value in pieces for end in value.detail[0] if end.value is not None]
        added = [(angle - shift - start) % cycle + start for end, shift in moving for angle in (end.low, end.high)]
        return unique_sorted(np.concatenate([breaks, added]))

    def guard(self, *, is_sampled: bool) -> KernelValue | None:
        """Return a value that is infinite for designs outside the range of the compared ones; None if none can be."""
        ends = [(end, end.value) for end, *_ in self._ends.values() if is_sampled and end.value is not None]
        guards = [*self._guards, *((value - end.low) * (end.high - value) for end, value in ends)]
        result = self.graph.constant(0.0)
        for guard in guards:
            result = self.graph.apply("choose", guard, result, math.inf)
        return result if guards else None

    def _table(self, node: Tabulated, shift: float) -> KernelValue:
        """Return a table over the crank angle that is the same for all designs."""
        if not self._are_near(node, lambda table: table.function, 0.0):
            raise NotCompiledError("table", node.word)
        return self.graph.reading(node.function, shift)

    def _table_over(self, node: Tabulated, x: KernelValue, shift: float, fixed: float | None) -> KernelValue:
        """Return a table of points over a column: a law between each two angles at which the column passes a point."""
        function: Any = node.function
        argument, compared = node.by, self._designs.counterparts(node)
        is_same = all(isinstance(other, Tabulated) and other.function == function for other in compared)
        if argument is None or not is_same or not hasattr(function, "law_at"):
            raise NotCompiledError("table", node.word)
        passed = [other.knots for other in compared if isinstance(other, Tabulated)]
        if len({len(knots) for knots in passed}) > 1:
            raise NotCompiledError("ways", argument.key)
        knots = np.array(passed)[:, np.argsort(passed[0])]
        if np.any(np.diff(knots, axis=1) < 0):
            raise NotCompiledError("ways", argument.key)
        last = max(float(self._sample_angles[-1]), float(knots[0, -1])) if knots.size else 0.0
        edges = np.array([0.0, *knots[0], last])
        at_knots, between = (
            replay(argument, self.angles_at(angles)) + np.zeros(len(angles))
            for angles in (knots[0], [fixed] if fixed is not None else (edges[1:] + edges[:-1]) / 2)
        )
        ends = []
        for angles, value in zip(knots.T, at_knots.tolist(), strict=True):
            corner = function.corner_near(value)
            is_fixed = not self._designs.differs[id(argument.node)]
            end = None if is_fixed else self._angle_where(argument, self.graph.constant(corner), angles.tolist())
            ends.append(self._law_end(angles, end, argument))
        if fixed is not None and any(end.low <= fixed <= end.high for end in ends if end.value is not None):
            raise NotCompiledError("ends", argument.key)
        laws = [self._as_value(function.law_at(value)(x)) for value in between.tolist()]
        ends.append(LawEnd(math.inf, math.inf, math.inf))
        if fixed is None and x.depends_on_design:
            # a design whose column passes points more or less often has other laws
            size = float(np.abs(at_knots).max(initial=0.0)) or 1.0
            within = [
                self._within(x / size, *np.array(function.ends_around(value)) / size) for value in between.tolist()
            ]
            inside = self.graph.pieces(tuple(ends), tuple(within), shift)
            self._guards.append(self.graph.reduction("min", inside) + _PASSED)
        return self._stored(self.graph.pieces(tuple(ends), tuple(laws), shift), 0)

    def _within(self, x: KernelValue, low: float, high: float) -> KernelValue:
        """Return a value that is negative where a column is not between two abscissas."""
        if math.isinf(low) or math.isinf(high):
            return self._as_value(1.0 if low == -high else (high - x if math.isinf(low) else x - low))
        return (x - low) * (high - x) / (high - low) ** 2

    def _half_turns(self, node: AngleUnwrap, value_of: Any, shift: float) -> KernelValue:  # noqa: ANN401
        """Return the half turns of a direction that is close to that of the stated design."""
        if not self._are_near(node, lambda turns: turns.near, _NEAR_DIRECTION):
            raise NotCompiledError("direction", node.operands[0].key)
        sin, cos = map(value_of, node.operands)
        near = self.graph.reading(node.near, shift)
        return self.graph.apply("half_turns", near, self.graph.apply("arctan", sin / cos))

    def _are_near(self, node: Node, function: Callable[[Any], Callable[[Array], Array]], limit: float) -> bool:
        """Return whether functions of the crank angle are close to that of the stated design in all designs."""
        stated, *compared = (
            np.asarray(function(counterpart)(self._sample_angles)) for counterpart in self._designs.counterparts(node)
        )
        return all(bool(np.all(np.abs(values - stated) <= limit)) for values in compared)

    def _found(self, known: TracedValue, node: ProcedureValue) -> KernelValue:
        match node:
            case FunctionValue():
                return self.graph.procedure(node.function, node.part, map(self.value, node.operands))
            case ProcedureValue(word="against") if len({x.value for x in self._designs.counterparts(node)}) == 1:
                return self.graph.constant(node.value or 0.0)
            case HarmonicCoefficient():
                return self._harmonic(self.value(node.operands[0]), node)
        return self._of_word(known, node)

    def _of_word(self, known: TracedValue, node: ProcedureValue) -> KernelValue:
        """Lower the value of a procedure that is known by its word alone."""
        match node.word:
            case "at" if node.by is not None and self._designs.differs[id(node.by.node)]:
                return self._at(node.operands[0], self.value(node.by), node.at or 0.0)
            case "at" if len({getattr(other, "at", None) for other in self._designs.counterparts(node)}) == 1:
                return self.value(node.operands[0], fixed=node.at)
            case "reached" if node.by is not None:
                angles = [counterpart.value or 0.0 for counterpart in self._designs.counterparts(node)]
                return self._angle_where(node.operands[0], self.value(node.by), angles)
            case "sine" | "cosine":
                return self.graph.apply("sin" if node.word == "sine" else "cos", self.value(node.operands[0]))
            case "mean" | "range" | "max" | "min" | "max_angle" | "min_angle" if node.operands[0].varies:
                return self.graph.reduction(node.word, self.value(node.operands[0]))
            case "direction" | "time_ratio" | "error":
                methods: dict[str, Callable[..., KernelValue]] = {
                    "direction": self._direction,
                    "time_ratio": self._time_ratio,
                    "error": self._largest_size,
                }
                return methods[node.word](*map(self.value, node.operands))
            case "harmonic_mean":
                return 1.0 / self.graph.reduction("mean", 1.0 / self.value(node.operands[0]))
            case "tangents":
                return self.graph.reduction(node.word, *map(self.value, node.operands))
            case "work":
                pressure, volume = map(self.value, node.operands)
                return self.graph.reduction("integral", pressure * self._slope(volume, "table", node.operands[1].key))
        raise NotCompiledError("procedure", known.key or node.word)

    def _keep_sides(self, column: TracedValue, signs: KernelValue, shift: float) -> None:
        """Guard that a column has these signs."""
        size = float(np.max(np.abs(replay(column, self.angles_at(self._sample_angles))), initial=0.0)) or 1.0
        inside = signs * self.value(column, shift=shift) / size
        self._guards.append(self.graph.reduction("least", inside) + _PASSED)

    def _unknowns(self, known: TracedValue, shift: float, fixed: float | None, key: str) -> list[KernelValue]:
        """Return the unknowns of a root by Newton's method, from the residuals of all unknowns being zero.

        As in an analysis the determinant of the equations tells whether there are such forces: a guard.
        """
        root, where = known.node, (id(known.node), fixed, shift)
        if where in self._roots:
            return self._roots[where]
        if not isinstance(root, Root) or not root.residuals or root.operands:
            raise NotCompiledError("solved", key)
        stated = np.abs(root.solve(self.angles_at(self._sample_angles)))
        if len(stated) != len(root.residuals):
            # positions of links with their derivatives, which no forces are
            raise NotCompiledError("solved", key)
        unknowns = [self.graph.unknown(*where, index) for index in range(len(root.residuals))]
        # what follows from the places of unknowns is not kept
        self._roots[where], kept = unknowns, dict(self._values)
        try:
            residuals = [self.value(residual, shift=shift, fixed=fixed) for residual in root.residuals]
        except NotCompiledError:
            del self._roots[where]
            raise
        finally:
            self._values = kept
        indices = [unknown.index for unknown in unknowns]
        steps, margin = self._newton_step(unknowns, residuals)
        values = [-start for start in replaced(residuals, dict.fromkeys(indices, self.graph.constant(0.0)))]
        for _ in range(_FORCE_STEPS):
            *last, determinant = replaced([*steps, margin], dict(zip(indices, values, strict=True)))
            values = [value - step for value, step in zip(values, last, strict=True)]
        self._roots[where] = values
        open_yet, size = (functools.reduce(operator.add, (x * x for x in row)) for row in (last, values))
        # where all forces vanish rounding is left of them
        least = (_SMALL * float(np.nanmax(stated))) ** 2
        settled = self.graph.apply("choose", (size + least) * _SETTLED**2 - open_yet, determinant, -1.0)
        self._guards.append(settled if fixed is not None else self.graph.reduction("least", settled))
        for column, places in root.sides if self._is_exact and fixed is None else ():
            ends = (*map(self._end, places), LawEnd(math.inf, math.inf, math.inf))
            edges = np.array([0.0, *(end.stated for end in ends[:-1]), self._sample_angles[-1]])
            signs = np.sign(replay(column, self.angles_at((edges[1:] + edges[:-1]) / 2)))
            pieces = self.graph.pieces(ends, tuple(map(self._as_value, signs.tolist())), shift)
            self._keep_sides(column, self._stored(pieces, 0), shift)
        return values

    def _newton_step(
        self, unknowns: Sequence[KernelValue], residuals: Sequence[KernelValue]
    ) -> tuple[list[KernelValue], KernelValue]:
        """Return how far unknowns are above the root of linearised residuals, and the determinant of the latter."""
        slopes = [ByAngle(self.graph, unknown) for unknown in unknowns]
        rows = [[*(slope.of(residual) for slope in slopes), residual] for residual in residuals]
        determinant = self.graph.constant(1.0)
        for place, pivot in enumerate(rows):
            determinant = determinant * pivot[place]
            pivot[place:] = [value / pivot[place] for value in pivot[place:]]
            for row in rows:
                if row is not pivot:
                    row[place:] = [
                        value - row[place] * other for value, other in zip(row[place:], pivot[place:], strict=True)
                    ]
        return [row[-1] for row in rows], determinant

    def _is_zero(self, node: Node) -> bool:
        """Return whether a value is zero in every design compared: what cancels leaves rounding elsewhere."""
        return all(other.value == 0.0 for other in self._designs.counterparts(node))

    def _direction(self, x: KernelValue, y: KernelValue) -> KernelValue:
        """Return the angle of a vector from its half, by the quotient that does not cancel."""
        apply, size = self.graph.apply, self.graph.apply("sqrt", x * x + y * y)
        return apply("choose", x, apply("arctan", y / (size + x)), apply("arctan", (size - x) / y)) * 2.0

    def _harmonic(self, column: KernelValue, node: HarmonicCoefficient) -> KernelValue:
        """Return twice the mean of a column times a wave."""
        function = {"cosine": "cos", "sine": "sin"}[node.part]
        if node.order == int(node.order):
            wave = self.graph.angle(function, int(node.order), 0.0)
        else:
            self._waves.setdefault((function, node.order), _Wave(getattr(np, function), math.radians(node.order)))
            wave = self.graph.reading(self._waves[function, node.order], 0.0)
        return self.graph.reduction("mean", column * wave) * 2.0

    def at_input(self, place: TracedValue, index: int) -> KernelValue:
        """Return the column that reaches zero at a place, at an angle that is an input. [deg]"""
        node = place.node
        assert isinstance(node, ProcedureValue)  # noqa: S101 - so corners are traced
        return self._at(node.operands[0], self.graph.input(index), node.at or 0.0)

    def _at(self, column: TracedValue, degrees: KernelValue, near: float) -> KernelValue:
        try:
            return self.graph.at_angle(self.value(column), degrees, near)
        except TypeError:
            raise NotCompiledError("ends", column.key) from None

    def _angle_where(self, column: TracedValue, target: KernelValue, angles: Sequence[float]) -> KernelValue:
        """Return the crank angle at which a column reaches a value, by Newton's method. [deg]

        `angles`: where it does so in the compared designs, the stated one first.
        """
        # a volume grows ever faster after a dead centre: from the far side steps do not overshoot
        near, start = angles[0], max(angles)
        slope = self._slope(self.value(column), "ends", column.key)
        step = angle = self.graph.constant(start)
        for _ in range(_STEPS):
            step = (self._at(column, angle, near) - target) / self.graph.at_angle(slope, angle, near) * (180 / math.pi)
            angle = angle - step
        self._guards.append(_CONVERGED**2 - step * step)
        return angle

    def _slope(self, column: KernelValue, reason: Reason, key: str) -> KernelValue:
        """Return the derivative of a column by the crank angle, which tables have not."""
        try:
            return self._by_angle.of(column)
        except (KeyError, TypeError):
            raise NotCompiledError(reason, key) from None

    def _largest_size(self, column: KernelValue) -> KernelValue:
        high, low = self.graph.reduction("max", column), self.graph.reduction("min", column)
        return self.graph.apply("choose", high + low, high, -low)

    def _time_ratio(self, high: KernelValue, low: KernelValue) -> KernelValue:
        """Return the longer way between two crank angles over the shorter one, regardless of full turns."""
        half = self.graph.apply("tan", (high - low) / 2.0)
        fast = self.graph.apply("arctan", self.graph.apply("sqrt", half * half)) * 2.0
        return (2 * math.pi - fast) / fast
