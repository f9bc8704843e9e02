"""The calculation of one value as a list: all that it is made of, in order, down to what is given."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.calculation_lines import FormulaLine, Snapshot, is_renamed
from crankwork.formula.replay import Angles
from crankwork.formula.traced_value import (
    AngleFunction,
    AngleUnwrap,
    Arithmetic,
    Component,
    Delayed,
    FormulaCall,
    Input,
    Piecewise,
    ProcedureValue,
    Root,
    Sum,
    Tabulated,
    TracedValue,
)
from crankwork.notation import ARGUMENTS
from crankwork.quantities.key import key_of


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
                stack.append((_law_of(known, degrees), degrees, "", False, False))
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
            own = _law_of(known, angle).key if isinstance(law.node, Input) else ""
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


def _law_of(known: TracedValue, degrees: float) -> TracedValue:
    """Return the law of a piecewise value that holds at an angle, under its own name. [deg]"""
    while isinstance(known.node, Piecewise):
        index = min(int(np.searchsorted(known.node.ends, degrees, side="left")), len(known.node.operands) - 1)
        known = known.node.operands[index]
    return known


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
