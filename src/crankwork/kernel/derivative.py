"""Derivatives: of operations by their operands, and of a graph by the crank angle."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from crankwork.kernel.graph import KernelGraph, KernelValue, in_order, number

# derivatives of functions of an angle, as other functions and a sign
_OF_ANGLE = {"sin": ("cos", 1.0), "cos": ("sin", -1.0), "one_minus_sin": ("cos", -1.0), "one_plus_sin": ("cos", 1.0)}

# By the name of an operation: its derivatives by each operand, as functions of its result and its operands. They are
# values of a graph, or numbers.
PARTIALS: dict[str, Callable[..., tuple[Any, ...]]] = {
    "add": lambda *_: (1.0, 1.0),
    "sub": lambda *_: (1.0, -1.0),
    "mul": lambda _, left, right: (right, left),
    "div": lambda result, _, right: (1.0 / right, -result / right),
    "neg": lambda *_: (-1.0,),
    "half_turns": lambda *_: (0.0, 0.0),
    "log_ratio": lambda _, left, right: (1.0 / left, -1.0 / right),
    "sqrt": lambda result, _: (0.5 / result,),
    "exp": lambda result, _: (result,),
    "log": lambda _, operand: (1.0 / operand,),
    "sin": lambda _, operand: (np.cos(operand),),
    "cos": lambda _, operand: (-np.sin(operand),),
    "tan": lambda result, _: (1.0 + result * result,),
    "arcsin": lambda _, operand: (1.0 / np.sqrt(1.0 - operand * operand),),
    "arccos": lambda _, operand: (-1.0 / np.sqrt(1.0 - operand * operand),),
    "arctan": lambda _, operand: (1.0 / (1.0 + operand * operand),),
}


class ByAngle:
    """Derivatives of the values of a graph by the crank angle, created once each. [1/rad]"""

    def __init__(self, graph: KernelGraph) -> None:
        self._graph = graph
        self._derivatives: dict[int, KernelValue] = {}

    def of(self, value: KernelValue) -> KernelValue:
        """Return the derivative of a value."""
        for operand in in_order([value], into=lambda node: node.index not in self._derivatives):
            if operand.index not in self._derivatives:
                self._derivatives[operand.index] = self._derivative(operand)
        return self._derivatives[value.index]

    def _derivative(self, value: KernelValue) -> KernelValue:
        graph, changes = self._graph, [self._derivatives[operand.index] for operand in value.operands]
        match value.kind:
            case "constant" | "input" | "reduction":
                return graph.constant(0.0)
            case "angle":
                return self._of_angle(*value.detail)
            case "pieces":
                ends, shift = value.detail
                return graph.pieces(ends, tuple(changes), shift)
            case "delayed":
                return graph.delayed(changes[0], value.detail)
            case "choose":
                return graph.apply("choose", value.operands[0], *changes[1:])
        result = graph.constant(0.0)
        if all(change.is_constant and not number(change) for change in changes):
            return result
        for change, partial in zip(changes, PARTIALS[value.kind](value, *value.operands), strict=True):
            result = result + change * partial
        return result

    def _of_angle(self, function: str, multiple: int, shift: float) -> KernelValue:
        if function in ("angle", "within"):
            return self._graph.constant(multiple * (1.0 if function == "angle" else 180 / math.pi))
        other, sign = _OF_ANGLE[function]
        return self._graph.angle(other, multiple, shift) * (sign * multiple)
