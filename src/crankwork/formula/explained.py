"""The memory of one value as a list: all that it is made of, in the order of calculation, down to what is given."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.known import (
    Arithmetic,
    Component,
    Delayed,
    Found,
    Given,
    HalfTurns,
    Known,
    OfAngle,
    Pieces,
    Root,
    Table,
    Total,
    Use,
)
from crankwork.formula.lines import FormulaLine, Moment, is_renamed
from crankwork.formula.replay import Angles
from crankwork.notation import ARGUMENTS


class Explained(NamedTuple):
    """One value of an explanation."""

    known: Known  # The value under the name it has here; of pieces the law that holds
    argument: str  # The argument of a formula that it stands for; a value without a name has its symbol
    degrees: float | None  # The crank angle, if it varies [deg]
    value: float  # The value [SI, or the unit of the argument]
    stretch: tuple[float, float] | None = None  # Where the law holds, of pieces [deg]
    residual: bool = False  # Whether it must vanish: an equation that unknowns are found from
    word: str = ""  # Of the value of a table, what kind of table it is
    own: str = ""  # Of a given law of pieces, the key that it has besides


class Explanation:
    """What a value is made of at one crank angle, in degrees."""

    def __init__(self, known: Known, degrees: float, angles_at: Callable[[Any], Angles]) -> None:
        self._angles_at, self._asked = angles_at, (known, degrees)
        self._moments: dict[float, Moment] = {}
        self._spelt: dict[tuple[int, float], Known] = {}
        self._same = Moment(angles_at, degrees)

    def moment(self, degrees: float | None) -> Moment:
        """Return the lines of one crank angle. [deg]"""
        degrees = self._asked[1] if degrees is None else degrees
        return self._moments.setdefault(degrees, Moment(self._angles_at, degrees))

    def __iter__(self) -> Iterator[Explained]:
        """Yield what the value is made of, operands before what is made of them, each once."""
        done: set[tuple[object, str, float | None, bool]] = set()
        stack = [(*self._asked, "", False, False)]
        while stack:
            known, degrees, argument, residual, is_open = stack.pop()
            law = self._spelled(self.moment(degrees).law(known), degrees)
            is_law = isinstance(known.node, Pieces)
            at = degrees if law.varies or is_law else None
            if is_open:
                yield self._explained(known, law, argument, at, residual=residual)
                continue
            mark = (self._same.same(law), _name(known, argument), at, residual)
            if mark in done or (law.is_absent and not is_law):
                continue
            done.add(mark)
            if law.varies:
                # once and for all that it is made of
                self.moment(degrees).value(law)
            if is_law and isinstance(law.node, Given):
                stack.append((known, degrees, argument, residual, True))
                stack.append((_law_of(known, degrees), degrees, "", False, False))
                continue
            is_inlined = isinstance(law.node, Arithmetic) and not known.key
            if not is_inlined:
                stack.append((known, degrees, argument, residual, True))
            stack.extend((*one, False) for one in reversed(list(self._made_of(law, degrees))))

    def _spelled(self, law: Known, degrees: float) -> Known:
        """Return a value of a table as what it is made of, if the table knows it."""
        node = law.node
        if not isinstance(node, Table) or not hasattr(node.function, "between"):
            return law
        if (id(node), degrees) not in self._spelt:
            at, by = degrees, Known(OfAngle("angle"), "crank_angle")
            if node.by is not None:
                at, by = self.moment(degrees).value(node.by), node.by
            self._spelt[id(node), degrees] = node.function.between(at, by)
        return Known(self._spelt[id(node), degrees].node, law.key)

    def _made_of(self, known: Known, degrees: float) -> Iterator[tuple[Known, float, str, bool]]:
        """Yield what a value is made of: the known, its crank angle, its argument, whether it must vanish."""
        if not isinstance(known.node, Use):
            yield from _made_of(known, degrees)
            return
        # what the line does without, as a factor of nothing, is not followed
        line = self.moment(degrees).step(known)
        shown = {name.partition(".")[0] for name in line.values} if isinstance(line, FormulaLine) else set()
        for name, one in zip(known.node.formula.arguments, known.node.inputs, strict=True):
            if name in shown and name != "pi":
                # a plain number is a constant of the analysis, and needs its value said as much
                yield one if isinstance(one, Known) else Known(Given(one)), degrees, name, False

    def written(self, known: Known, degrees: float) -> Iterator[tuple[Known, float, str]]:
        """Yield what stands in the line of a value: each known, its crank angle [deg] and its argument.

        What arithmetic without a name is made of stands there too, and nothing that nobody stated.
        """
        for one, at, argument, _ in self._made_of(self._spelled(known, degrees), degrees):
            if isinstance(one.node, Arithmetic) and not one.key:
                yield from self.written(one, at)
            elif not one.is_absent:
                yield one, at, argument

    def _explained(self, known: Known, law: Known, argument: str, at: float | None, *, residual: bool) -> Explained:
        node, stretch = known.node, None
        table = self.moment(at).law(known).node
        word = table.word if isinstance(table, Table) else ""
        own = ""
        if isinstance(node, Pieces) and at is not None:
            own = _law_of(known, at).key if isinstance(law.node, Given) else ""
            ends = [None, *node.ends.tolist()]
            end = next((k for k, one in enumerate(ends) if one is not None and at <= one), len(ends) - 1)
            stretch = (0.0 if ends[end - 1] is None else ends[end - 1], ends[end])
        moment = self.moment(at)
        value = 0.0 if moment.is_noise(law) else moment.value(law)
        return Explained(law, argument, at, value, stretch, residual, word, own)


def _name(known: Known, argument: str) -> str:
    """Return what tells a value from the same one under another name: its key, or the argument that it stands for."""
    return argument if goes_by_argument(known, argument) else known.key or argument


def goes_by_argument(known: Known, argument: str) -> bool:
    """Return whether a value without a formula has the symbol of an argument, as the state before has: p₁."""
    is_leaf = isinstance(known.node, Given | Found)
    return is_leaf and argument in ARGUMENTS and ARGUMENTS[argument].pattern != "{}" and not is_renamed(argument, known)


def _law_of(known: Known, degrees: float) -> Known:
    """Return the law that holds of pieces, under its own name. [deg]"""
    while isinstance(known.node, Pieces):
        at = min(int(np.searchsorted(known.node.ends, degrees, side="left")), len(known.node.operands) - 1)
        known = known.node.operands[at]
    return known


def _made_of(known: Known, degrees: float) -> Iterator[tuple[Known, float, str, bool]]:
    """Yield what a value is made of that no formula gives."""
    match known.node:
        case Arithmetic(operands=parts) | Total(operands=parts) | HalfTurns(operands=parts):
            yield from ((one, degrees, "", False) for one in parts)
        case Delayed(of=of, by=by, cycle=cycle):
            yield of, (degrees - by) % cycle, "", False
        case Component(operands=(root,)):
            yield from _of_root(root, degrees)
        case Found(operands=parts, at=at):
            yield from ((one, degrees if at is None else at, "", False) for one in parts if _stands(one, at))
        case Table(by=by, operands=parts):
            yield from ((one, degrees, "", False) for one in parts if not one.varies or one is by)


def _stands(one: Known, at: float | None) -> bool:
    """Return whether what a procedure took is a value: a whole column is none."""
    return at is not None or not one.varies


def _of_root(root: Known, degrees: float) -> Iterator[tuple[Known, float, str, bool]]:
    """Yield what a root was found from, and the equations of which it is the root."""
    yield from ((one, degrees, "", False) for one in root.node.operands)
    if isinstance(root.node, Root):
        yield from ((one, degrees, "", True) for one in root.node.residuals)


def is_given(one: Explained) -> bool:
    """Return whether a value is given and not calculated."""
    return isinstance(one.known.node, Given) and one.stretch is None
