"""The trace as lines that can be followed by hand, and as a list: symbols, then numbers, then the value.

A line stands for one formula, sum or value at one crank angle. Terms of what nobody stated are folded away, plain
arithmetic stands where it was written, and an operand has the symbol of the name it goes by here. Keys are those of the
summary and the columns; where a formula serves more than one quantity, the key of the line tells which it is,
`quantities.base_key(line.key)`, and not the quantity of the formula.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Expression, Formula, Number, Operation, Symbol, record, simplify, symbol
from crankwork.formula.replay import Angles, Program
from crankwork.formula.traced_value import (
    AngleFunction,
    AngleUnwrap,
    Arithmetic,
    Component,
    Delayed,
    FormulaCall,
    Input,
    Node,
    Piecewise,
    ProcedureValue,
    Root,
    Sum,
    Tabulated,
    TracedValue,
    in_order,
)
from crankwork.notation import ARGUMENTS
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import key_of

# an angle that was found is printed with ten digits; no such rest of a term reaches the other
_NOISE, _LARGEST_NOISE = 1e-10, 1e-4
# in SI: shorter than the nucleus of an atom
_ZERO_TOLERANCE = 1e-15
# what stands at an angle is the column itself there
_AT_AN_ANGLE = ("at", "max", "min")


class FormulaLine(NamedTuple):
    """A value that a formula gives."""

    key: str  # Key of the value
    formula: Formula  # What was computed, with its source
    # What was put in, by symbol of the expression [SI, or the unit that the formula states]
    values: Mapping[str, float]
    value: float  # What came out [SI, or the unit that the formula states]
    # Symbols that stand for one of several values of their quantity, each with the key of that value
    named: tuple[tuple[str, str], ...] = ()
    # The formula as it is printed here, where that is not the whole formula: without what is absent, with plain
    # arithmetic in place of the argument that it gives
    tree: Expression | None = None
    noise: frozenset[str] = frozenset()  # What of it rounding alone has left: names of `values`, and "" for the value

    @property
    def expression(self) -> Expression:
        """The formula as it is printed here."""
        return record(self.formula.shown) if self.tree is None else self.tree


class ValueLine(NamedTuple):
    """A value without a formula of its own: given, read from a diagram, found by a procedure, or shown before. [SI]"""

    key: str
    value: float
    is_noise: bool = False


class SumLine(NamedTuple):
    """A value that is the sum of others, and what is added, in order. [SI]"""

    key: str
    terms: tuple[ValueLine, ...]
    value: float
    is_noise: bool = False


class DelayedLine(NamedTuple):
    """A value that is that of a column, under its key, at another crank angle. [deg], [SI]"""

    key: str
    of: str
    degrees: float
    value: float


Line = FormulaLine | ValueLine | SumLine | DelayedLine


def without_noise(line: Line) -> Line:
    """Return a line as it is printed: values that are rounding noise become zero."""
    match line:
        case FormulaLine(noise=noise) if noise:
            values = {name: 0.0 if name in noise else value for name, value in line.values.items()}
            return line._replace(values=values, value=0.0 if "" in noise else line.value)
        case ValueLine(is_noise=True):
            return line._replace(value=0.0)
        case SumLine(terms=terms):
            terms = tuple(ValueLine(term.key, 0.0 if term.is_noise else term.value) for term in terms)
            return line._replace(terms=terms, value=0.0 if line.is_noise else line.value)
    return line


class Snapshot:
    """Everything that traced values are made of, at one crank angle, in degrees.

    The mark says whose values those are that vary with the crank angle, where they are not those of cylinder 1: after a
    point it ends their keys.
    """

    def __init__(self, angles_at: Callable[[Any], Angles], degrees: float, mark: str = "") -> None:
        self._angles_at, self.degrees, self._mark = angles_at, degrees, mark
        self._values: dict[int, tuple[Node, float]] = {}
        self._marks: dict[int, tuple[Node, object]] = {}
        self._first: dict[object, object] = {}

    def value(self, known: TracedValue) -> float:
        """Return the value of a known at this crank angle. [SI]"""
        known = self.law(known)
        if known.node.value is not None:
            return known.node.value
        if id(known.node) not in self._values:
            made = {str(id(operand.node)): operand for operand in self._made_of(known)}
            columns = Program(made)(self._angles_at(np.array([self.degrees])))
            self._values |= {id(operand.node): (operand.node, float(columns[key][0])) for key, operand in made.items()}
        return self._values[id(known.node)][1]

    def is_noise(self, known: TracedValue) -> bool:
        """Return whether a value is rounding noise of larger terms, which is printed as zero."""
        size = abs(self.value(known))
        if size > _LARGEST_NOISE or size < _ZERO_TOLERANCE:
            return 0 < size < _ZERO_TOLERANCE
        match self.law(known).node:
            case AngleFunction(function="sin" | "cos"):
                return size <= _NOISE
            case FormulaCall() | Arithmetic() | Sum():
                return without_noise(self.step(known if known.key else known.named("_"))).value == 0
        return False

    def _is_noise(self, operand: TracedValue | float) -> bool:
        return self.is_noise(operand) if isinstance(operand, TracedValue) else 0 < abs(operand) < _ZERO_TOLERANCE

    def law(self, known: TracedValue) -> TracedValue:
        """Return the law of a piecewise value at this crank angle, under the same name; other values as they are."""
        return self.own_law(known).named(known.key)

    def own_law(self, known: TracedValue) -> TracedValue:
        """Return the law of a piecewise value at this crank angle, under its own name."""
        while isinstance(known.node, Piecewise):
            index = min(int(np.searchsorted(known.node.ends, self.degrees, side="left")), len(known.node.operands) - 1)
            known = known.node.operands[index]
        return known

    def steps(self, traced_values: Iterable[TracedValue]) -> Iterator[Line]:
        """Yield the lines of values, each after the lines of its operands, each once."""
        done: set[tuple[object, str]] = set()
        stack = [(traced, False) for traced in reversed(tuple(traced_values))]
        while stack:
            known, is_open = stack.pop()
            law = self.law(known)
            mark = (self.same(law), known.key)
            if is_open:
                if not isinstance(law.node, Arithmetic) or known.key:
                    yield self.step(known)
                continue
            if mark in done:
                continue
            done.add(mark)
            stack.append((known, True))
            if isinstance(law.node, FormulaCall | Arithmetic | Sum):
                stack.extend(
                    (operand, False) for operand in reversed(law.node.operands) if isinstance(operand.node, _MADE)
                )

    def same(self, known: TracedValue) -> object:
        """Return the mark shared by all values that the same operation gives from the same operands."""
        if id(known.node) in self._marks:
            return self._marks[id(known.node)][1]
        for traced in in_order([known]):
            node, mark = traced.node, object()
            if id(node) in self._marks:
                continue
            if isinstance(node, FormulaCall | Arithmetic):
                made_by = node.formula.name if isinstance(node, FormulaCall) else node.function.__name__
                made_of = tuple(
                    self._marks[id(part.node)][1] if isinstance(part, TracedValue) else part for part in node.inputs
                )
                mark = self._first.setdefault((made_by, made_of), mark)
            self._marks[id(node)] = (node, mark)
        return self._marks[id(known.node)][1]

    def step(self, known: TracedValue) -> Line:
        """Return the line of one known.

        `known`: a use of a formula, a sum, or a value without a formula.
        """
        key, known = self._marked(known.key, known), self.law(known)
        match known.node:
            case FormulaCall(formula=formula, inputs=inputs):
                taken = dict(zip(formula.arguments, inputs, strict=True))
                return self._step(known.named(key), record(formula.shown), taken)
            case Arithmetic() if key:
                return self._step(known.named(key), Symbol("_"), {"_": TracedValue(known.node)})
            case Sum(operands=terms):
                shown = tuple(self._term(term) for term in terms if not term.is_absent)
                return SumLine(key, shown, self.value(known), _is_zero(*_sum_of(shown)))
            case Delayed(of=column, by=shift, cycle=cycle):
                return DelayedLine(key, column.key, (self.degrees - shift) % cycle, self.value(known))
            case ProcedureValue(word=word, at=angle, operands=(operand,)) if angle is not None and word in _AT_AN_ANGLE:
                return Snapshot(self._angles_at, angle).step(operand.named(known.key))
        return ValueLine(key, self.value(known), self.is_noise(known))

    def _term(self, known: TracedValue) -> ValueLine:
        return ValueLine(self._marked(known.key, known), self.value(known), self.is_noise(known))

    def _marked(self, key: str, known: TracedValue) -> str:
        # an angle counted from elsewhere is that of cylinder 1
        is_own = known.varies and not (isinstance(known.node, AngleFunction) and known.node.shift)
        return f"{key}.{self._mark}" if self._mark and key and is_own else key

    def _step(self, known: TracedValue, tree: Expression, taken: dict[str, TracedValue | float]) -> FormulaLine:
        inlined = _Inlined(taken)
        tree = simplify(inlined.tree(tree))
        used = symbols_of(tree)
        values = {
            name: self.value(item) if isinstance(item, TracedValue) else item for name, item in inlined.taken.items()
        }
        operands = {
            name: self._of_own_angle(operand)
            for name, operand in inlined.taken.items()
            if isinstance(operand, TracedValue) and name in used
        }
        named = tuple(
            (name, self._marked(item.key, item)) for name, item in operands.items() if self._is_renamed(name, item)
        )
        formula = known.node.formula if isinstance(known.node, FormulaCall) else _written_in_place(known)
        shown = {name: values[name] for name in used}
        noise = {name for name, operand in inlined.taken.items() if name in shown and self._is_noise(operand)}
        value = self.value(known)
        if 0 < abs(value) <= _LARGEST_NOISE:
            with suppress(ZeroDivisionError):
                printed = {name: 0.0 if name in noise else shown_value for name, shown_value in shown.items()}
                noise |= {""} if _is_zero(*_with_size(tree, printed)) else set()
        return FormulaLine(known.key, formula, shown, value, named, tree, frozenset(noise))

    def _of_own_angle(self, known: TracedValue) -> TracedValue:
        """Return sine or cosine of the own crank angle under a name that can be marked."""
        node = known.node
        if not (self._mark and isinstance(node, AngleFunction) and node.multiple == 1) or known.key:
            return known
        return known.named(f"crank_{node.function}") if node.function in ("sin", "cos") else known

    def _is_renamed(self, name: str, operand: TracedValue) -> bool:
        """Return whether an operand prints the symbol of its own key and not that of the argument."""
        return bool(operand.key) if self._mark and operand.varies else is_renamed(name, operand)

    def _made_of(self, known: TracedValue) -> Iterator[TracedValue]:
        """Yield the dependencies of a value that can be replayed at this crank angle."""
        stack, done = [known], set()
        while stack:
            operand = self.law(stack.pop())
            if id(operand.node) in done or not operand.varies:
                continue
            done.add(id(operand.node))
            if isinstance(operand.node, Root):
                continue
            yield operand
            if not isinstance(operand.node, Delayed):
                stack.extend(operand.node.operands)


def _is_zero(value: float, size: float) -> bool:
    return abs(value) <= _NOISE * size


def _sum_of(terms: Sequence[ValueLine]) -> tuple[float, float]:
    values = [0.0 if term.is_noise else term.value for term in terms]
    return sum(values), max(map(abs, values), default=0.0)


def _with_size(tree: Expression, values: Mapping[str, float]) -> tuple[float, float]:
    """Return the value of a tree, and the magnitude of its largest terms."""
    match tree:
        case Operation(function, operands):
            (value, size), *remaining = (_with_size(operand, values) for operand in operands)
            other, other_size = remaining[0] if remaining else (1.0, 0.0)
            with np.errstate(all="ignore"):
                result = float(function(value, other) if remaining else function(value))
            if function in (operator.add, operator.sub):
                return result, max(size, other_size)
            if function is operator.mul:
                return result, max(size * abs(other), abs(value) * other_size)
            if function is operator.truediv:
                return result, size / abs(other)
            if function is operator.neg:
                return result, size
            return result, 1.0 if function in (np.sin, np.cos) else abs(result)
        case Symbol(name):
            return values[name], abs(values[name])
        case Number(value):
            return value, abs(value)
    raise TypeError(f"{tree!r} is not part of a formula")


class _Inlined:
    """The arguments of a formula with plain arithmetic written out, and what takes the place of each symbol."""

    def __init__(self, taken: dict[str, TracedValue | float]) -> None:
        self.taken: dict[str, TracedValue | float] = {}
        self._trees = {name: self._tree_of(name, operand) for name, operand in taken.items()}

    def tree(self, tree: Expression) -> Expression:
        """Return a recorded formula with the operands it has here."""
        match tree:
            case Symbol(name):
                return self._trees[name]
            case Operation(function, operands):
                return Operation(function, tuple(self.tree(operand) for operand in operands))
        return tree

    def _tree_of(self, name: str, operand: TracedValue | float) -> Expression:
        if not isinstance(operand, TracedValue):
            if name in ARGUMENTS and not (name == "k_h" and operand in _WRITTEN_OUT):
                self.taken[name] = operand
                return Symbol(name)
            return Number(operand)
        if operand.is_absent:
            return Number(operand.value)
        if isinstance(operand.node, Arithmetic) and (not operand.key or name == "_"):
            parts = operand.node.inputs
            return Operation(
                operand.node.function, tuple(self._tree_of(f"{name}.{i}", part) for i, part in enumerate(parts))
            )
        if isinstance(operand.node, AngleFunction) and name not in ARGUMENTS:
            # no argument gives a symbol here
            operand = operand.named(f"crank_{operand.node.function}")
        name = _OF_ORDER.get((name, getattr(operand.node, "multiple", 0)), name)
        self.taken[name] = operand
        return Symbol(name)


# the first two orders are written out, where books write cos and cos 2
_WRITTEN_OUT = (1.0, 2.0)
_OF_ORDER = {
    ("cos_kphi", 1): "cos_phi",
    ("sin_kphi", 1): "sin_phi",
    ("cos_kphi", 2): "cos_2phi",
    ("sin_kphi", 2): "sin_2phi",
}


def _written_in_place(known: TracedValue) -> Formula:
    """Return plain arithmetic under the name of a quantity as a formula without a source."""
    return Formula(lambda value: value, base_key(known.key), "")


_PRIMED = ("{}′", "{}″")
# nodes with lines of their own
_MADE = FormulaCall | Arithmetic | Sum | Piecewise


def is_renamed(name: str, operand: TracedValue) -> bool:
    """Return whether an operand prints the symbol of its own key and not that of the argument."""
    if not operand.key:
        return False
    entry = ARGUMENTS.get(name)
    if isinstance(operand.node, AngleFunction) and entry is not None:
        return entry.quantity != "crank_angle" or not operand.key.startswith("crank_")
    if entry is None or not entry.quantity or "." in operand.key:
        return True
    if entry.pattern.endswith("₁") and base_key(operand.key) in QUANTITIES:
        # the state before goes by its own symbol where it has one: p_z
        own, other = (QUANTITIES[base_key(key)].symbol() for key in (operand.key, entry.quantity))
        return own != other
    if entry.pattern in _PRIMED and operand.key in QUANTITIES:
        # the part of one order goes by its own symbol: x'_I
        return QUANTITIES[operand.key].symbol() != symbol(name)
    return entry.pattern == "{}" and entry.quantity != operand.key


def symbols_of(tree: Expression) -> tuple[str, ...]:
    """Return the names of the symbols of a tree, in order, each once."""
    names: dict[str, None] = {}
    stack = [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, Symbol):
            names[node.name] = None
        elif isinstance(node, Operation):
            stack.extend(reversed(node.operands))
    return tuple(names)


class ExplainedValue(NamedTuple):
    """One value of an explanation."""

    known: TracedValue  # The value under the name it has here; of pieces the law that holds
    argument: str  # The argument of a formula that it stands for; a value without a name has its symbol
    degrees: float | None  # The crank angle, if it varies [deg]
    value: float  # The value [SI, or the unit of the argument]
    stretch: tuple[float, float] | None = None  # Where the law holds, of pieces [deg]
    residual: bool = False  # Whether it must vanish: an equation that unknowns are found from
    word: str = ""  # Of the value of a table, what kind of table it is
    own: str = ""  # Of a given law of pieces, the key that it has besides


class Explanation:
    """The dependencies of a value at one crank angle, in degrees."""

    def __init__(self, known: TracedValue, degrees: float, angles_at: Callable[[Any], Angles]) -> None:
        self._angles_at, self._target = angles_at, (known, degrees)
        self._moments: dict[float, Snapshot] = {}
        self._spelt: dict[tuple[int, float], TracedValue] = {}
        self._same = Snapshot(angles_at, degrees)

    def moment(self, degrees: float | None) -> Snapshot:
        """Return the lines of one crank angle. [deg]"""
        degrees = self._target[1] if degrees is None else degrees
        return self._moments.setdefault(degrees, Snapshot(self._angles_at, degrees))

    def __iter__(self) -> Iterator[ExplainedValue]:
        """Yield the values that the value depends on, operands before their results, each once."""
        done: set[tuple[object, str, float | None, bool]] = set()
        stack = [(*self._target, "", False, False)]
        while stack:
            known, degrees, argument, residual, is_open = stack.pop()
            law = self._spelled(self.moment(degrees).law(known), degrees)
            is_law = isinstance(known.node, Piecewise)
            angle = degrees if law.varies or is_law else None
            if is_open:
                yield self._explained(known, law, argument, angle, residual=residual)
                continue
            mark = (self._same.same(law), _name(known, argument), angle, residual)
            if mark in done or (law.is_absent and not is_law):
                continue
            done.add(mark)
            if law.varies:
                # evaluates all its dependencies at once
                self.moment(degrees).value(law)
            if is_law and isinstance(law.node, Input):
                stack.append((known, degrees, argument, residual, True))
                stack.append((self.moment(degrees).own_law(known), degrees, "", False, False))
                continue
            is_inlined = isinstance(law.node, Arithmetic) and not known.key
            if not is_inlined:
                stack.append((known, degrees, argument, residual, True))
            stack.extend((*operand, False) for operand in reversed(list(self._made_of(law, degrees))))

    def _spelled(self, law: TracedValue, degrees: float) -> TracedValue:
        """Return a value read from a table as the expression that interpolates it, if the table has one."""
        node = law.node
        if not isinstance(node, Tabulated) or not hasattr(node.function, "between"):
            return law
        if (id(node), degrees) not in self._spelt:
            position, argument = degrees, TracedValue(AngleFunction("angle"), "crank_angle")
            if node.by is not None:
                position, argument = self.moment(degrees).value(node.by), node.by
            self._spelt[id(node), degrees] = node.function.between(position, argument)
        return TracedValue(self._spelt[id(node), degrees].node, law.key)

    def _made_of(self, known: TracedValue, degrees: float) -> Iterator[tuple[TracedValue, float, str, bool]]:
        """Yield the dependencies of a value: each with its crank angle, its argument, and whether it must vanish."""
        if not isinstance(known.node, FormulaCall):
            yield from _made_of(known, degrees)
            return
        # operands that the printed line leaves out, as those of a zero factor, are not followed
        line = self.moment(degrees).step(known)
        shown = {key_of(name).quantity for name in line.values} if isinstance(line, FormulaLine) else set()
        for name, operand in zip(known.node.formula.arguments, known.node.inputs, strict=True):
            if name in shown and name != "pi":
                # a plain number is a constant of the analysis; its value is listed too
                yield operand if isinstance(operand, TracedValue) else TracedValue(Input(operand)), degrees, name, False

    def written(self, known: TracedValue, degrees: float) -> Iterator[tuple[TracedValue, float, str]]:
        """Yield the values printed in the line of a value: each with its crank angle [deg] and its argument.

        Operands of arithmetic without a name are included, absent values are not.
        """
        for operand, angle, argument, _ in self._made_of(self._spelled(known, degrees), degrees):
            if isinstance(operand.node, Arithmetic) and not operand.key:
                yield from self.written(operand, angle)
            elif not operand.is_absent:
                yield operand, angle, argument

    def _explained(
        self, known: TracedValue, law: TracedValue, argument: str, angle: float | None, *, residual: bool
    ) -> ExplainedValue:
        node, stretch = known.node, None
        table = self.moment(angle).law(known).node
        word = table.word if isinstance(table, Tabulated) else ""
        own = ""
        if isinstance(node, Piecewise) and angle is not None:
            own = self.moment(angle).own_law(known).key if isinstance(law.node, Input) else ""
            ends = [None, *node.ends.tolist()]
            end = next((k for k, limit in enumerate(ends) if limit is not None and angle <= limit), len(ends) - 1)
            stretch = (0.0 if ends[end - 1] is None else ends[end - 1], ends[end])
        moment = self.moment(angle)
        value = 0.0 if moment.is_noise(law) else moment.value(law)
        return ExplainedValue(law, argument, angle, value, stretch, residual, word, own)


def _name(known: TracedValue, argument: str) -> str:
    """Return the name of a value here: its key, or the argument that it stands for."""
    return argument if has_argument_symbol(known, argument) else known.key or argument


def has_argument_symbol(known: TracedValue, argument: str) -> bool:
    """Return whether a value without a formula has the symbol of an argument, as the state before has: p₁."""
    is_leaf = isinstance(known.node, Input | ProcedureValue)
    return is_leaf and argument in ARGUMENTS and ARGUMENTS[argument].pattern != "{}" and not is_renamed(argument, known)


def _made_of(known: TracedValue, degrees: float) -> Iterator[tuple[TracedValue, float, str, bool]]:
    """Yield the dependencies of a value that no formula gives."""
    match known.node:
        case Arithmetic(operands=operands) | Sum(operands=operands) | AngleUnwrap(operands=operands):
            yield from ((operand, degrees, "", False) for operand in operands)
        case Delayed(of=column, by=shift, cycle=cycle):
            yield column, (degrees - shift) % cycle, "", False
        case Component(operands=(root,)):
            yield from _of_root(root, degrees)
        case ProcedureValue(operands=operands, at=angle):
            yield from (
                (operand, degrees if angle is None else angle, "", False)
                for operand in operands
                # a whole column is no operand that has one value
                if angle is not None or not operand.varies
            )
        case Tabulated(by=argument, operands=operands):
            yield from ((item, degrees, "", False) for item in operands if not item.varies or item is argument)


def _of_root(root: TracedValue, degrees: float) -> Iterator[tuple[TracedValue, float, str, bool]]:
    """Yield the inputs of a root, and the equations that it solves."""
    yield from ((operand, degrees, "", False) for operand in root.node.operands)
    if isinstance(root.node, Root):
        yield from ((residual, degrees, "", True) for residual in root.node.residuals)


def is_given(entry: ExplainedValue) -> bool:
    """Return whether a value is given and not calculated."""
    return isinstance(entry.known.node, Input) and entry.stretch is None
