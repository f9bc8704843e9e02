"""Derivatives: of operations by what they are of, and of a graph by the crank angle."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from crankwork.kernel.graph import Graph, Value, in_order, number

# of functions of an angle, as functions of it and the sign
_OF_ANGLE = {"sin": ("cos", 1.0), "cos": ("sin", -1.0), "one_minus_sin": ("cos", -1.0), "one_plus_sin": ("cos", 1.0)}

# By the name of an operation, of what it gives and what it is of: its derivatives by each of these. They are values of
# a graph, or numbers.
PARTIALS: dict[str, Callable[..., tuple[Any, ...]]] = {
    "add": lambda *_: (1.0, 1.0),
    "sub": lambda *_: (1.0, -1.0),
    "mul": lambda _, left, right: (right, left),
    "div": lambda one, _, right: (1.0 / right, -one / right),
    "neg": lambda *_: (-1.0,),
    "half_turns": lambda *_: (0.0, 0.0),
    "log_ratio": lambda _, left, right: (1.0 / left, -1.0 / right),
    "sqrt": lambda one, _: (0.5 / one,),
    "exp": lambda one, _: (one,),
    "log": lambda _, of: (1.0 / of,),
    "sin": lambda _, of: (np.cos(of),),
    "cos": lambda _, of: (-np.sin(of),),
    "tan": lambda one, _: (1.0 + one * one,),
    "arcsin": lambda _, of: (1.0 / np.sqrt(1.0 - of * of),),
    "arccos": lambda _, of: (-1.0 / np.sqrt(1.0 - of * of),),
    "arctan": lambda _, of: (1.0 / (1.0 + of * of),),
}


class ByAngle:
    """Derivatives of the values of a graph by the crank angle, each made once. [1/rad]"""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._made: dict[int, Value] = {}

    def of(self, value: Value) -> Value:
        """Return the derivative of a value."""
        for one in in_order([value], into=lambda one: one.at not in self._made):
            if one.at not in self._made:
                self._made[one.at] = self._derivative(one)
        return self._made[value.at]

    def _derivative(self, one: Value) -> Value:
        graph, moved = self._graph, [self._made[other.at] for other in one.operands]
        match one.kind:
            case "constant" | "input" | "reduction":
                return graph.constant(0.0)
            case "angle":
                return self._of_angle(*one.detail)
            case "pieces":
                ends, shift = one.detail
                return graph.pieces(ends, tuple(moved), shift)
            case "delayed":
                return graph.delayed(moved[0], one.detail)
            case "choose":
                return graph.apply("choose", one.operands[0], *moved[1:])
        result = graph.constant(0.0)
        if all(other.is_constant and not number(other) for other in moved):
            return result
        for change, partial in zip(moved, PARTIALS[one.kind](one, *one.operands), strict=True):
            result = result + change * partial
        return result

    def _of_angle(self, function: str, multiple: int, shift: float) -> Value:
        if function in ("angle", "within"):
            return self._graph.constant(multiple * (1.0 if function == "angle" else 180 / math.pi))
        other, sign = _OF_ANGLE[function]
        return self._graph.angle(other, multiple, shift) * (sign * multiple)
