"""Mutants: formulas that are wrong by a little, or by one operator."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from crankwork.formula.expression import Expression, Formula, Operation, evaluate, record

KINDS = ("factor", "offset", "operator")
BY = 1e-3
_OPERATORS = {
    operator.add: operator.sub,
    operator.sub: operator.add,
    operator.mul: operator.truediv,
    operator.truediv: operator.mul,
}
# where a formula has no operator, the function in it is another
_FUNCTIONS: Mapping[Any, Any] = {
    np.sin: np.cos,
    np.cos: np.sin,
    np.tan: np.sin,
    np.arctan: np.sin,
    np.sqrt: np.log,
    operator.pow: operator.mul,
    operator.neg: operator.pos,
}


@dataclass
class Mutant:
    """A formula made wrong; `largest` is the largest value that it had so far, for the offset."""

    formula: Formula
    kind: str
    largest: float = field(default=0.0, compare=False)

    @property
    def name(self) -> str:
        """The name under which exceptions and survivors are listed."""
        return f"{self.formula.name}.{self.kind}"

    @property
    def function(self) -> Callable[..., Any]:
        """What is called in place of the formula."""
        own = self.formula.function
        if self.kind == "factor":
            return lambda *operands: own(*operands) * (1 + BY)
        if self.kind == "offset":
            return lambda *operands: self._offset(own(*operands))
        tree, names = swapped(record(own)), self.formula.arguments
        return lambda *operands: evaluate(tree, dict(zip(names, operands, strict=True)))

    def _offset(self, value: Any) -> Any:
        # a formula may be asked for symbols
        if not isinstance(value, float | int | np.ndarray):
            return value
        self.largest = max(self.largest, float(np.max(np.abs(value), initial=0.0)))
        return value + BY * self.largest


def mutants(formula: Formula) -> list[Mutant]:
    """Return the mutants of a formula: three, or two of one in which nothing can be swapped."""
    kinds = KINDS if _places(record(formula.function)) else KINDS[:2]
    return [Mutant(formula, kind) for kind in kinds]


def swapped(tree: Expression) -> Expression:
    """Return a tree with one operator swapped: the one in the middle, + and - before * and /."""
    places = _places(tree)
    best = [place for place in places if place[0] == places[0][0]]
    return _swapped_at(tree, best[len(best) // 2][1])


def _places(tree: Expression) -> list[tuple[int, tuple[int, ...]]]:
    """Return how much each place where something can be swapped says, least first, and the way to it."""

    def walk(tree: Expression, way: tuple[int, ...]) -> Iterator[tuple[int, tuple[int, ...]]]:
        if isinstance(tree, Operation):
            if tree.function in (operator.add, operator.sub):
                yield 0, way
            elif tree.function in _OPERATORS:
                yield 1, way
            elif tree.function in _FUNCTIONS:
                yield 2, way
            for at, one in enumerate(tree.operands):
                yield from walk(one, (*way, at))

    return sorted(walk(tree, ()))


def _swapped_at(tree: Expression, way: tuple[int, ...]) -> Expression:
    assert isinstance(tree, Operation)
    if not way:
        return Operation({**_OPERATORS, **_FUNCTIONS}[tree.function], tree.operands)
    at, *rest = way
    operands = list(tree.operands)
    operands[at] = _swapped_at(operands[at], tuple(rest))
    return Operation(tree.function, tuple(operands))
