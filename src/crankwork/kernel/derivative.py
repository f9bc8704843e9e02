"""Derivatives of a graph, forward: by the crank angle, or by what a design states."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

from crankwork.kernel.graph import Graph, Value, in_order, number

# of functions of an angle, as functions of it and the sign
_OF_ANGLE = {"sin": ("cos", 1.0), "cos": ("sin", -1.0), "one_minus_sin": ("cos", -1.0), "one_plus_sin": ("cos", 1.0)}


class Derivatives:
    """Derivatives of the values of a graph, each made once: by the crank angle [rad], or by an input."""

    def __init__(self, graph: Graph, by: Literal["angle"] | int) -> None:
        self._graph, self._by = graph, by
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
            case "constant":
                return graph.constant(0.0)
            case "input":
                return graph.constant(float(one.detail == self._by))
            case "angle":
                return self._of_angle(*one.detail)
            case "pieces":
                ends, shift = one.detail
                return graph.pieces(ends, tuple(moved), shift)
            case "delayed":
                return graph.delayed(moved[0], one.detail)
            case "reduction":
                return self._of_reduction(one, moved)
        if all(other.is_constant and not number(other) for other in moved):
            return graph.constant(0.0)
        return self._of_operation(one, moved)

    def _of_angle(self, function: str, multiple: int, shift: float) -> Value:
        if self._by != "angle":
            return self._graph.constant(0.0)
        if function in ("angle", "within"):
            return self._graph.constant(multiple * (1.0 if function == "angle" else 180 / math.pi))
        other, sign = _OF_ANGLE[function]
        return self._graph.angle(other, multiple, shift) * (sign * multiple)

    def _of_reduction(self, one: Value, moved: list[Value]) -> Value:
        """Return how a reduction changes: an extreme as its column does where it stands, a mean by the mean of that.

        Where laws break does not move with designs, so that nothing comes from there.
        """
        graph, word, column = self._graph, one.detail, one.operands[0]
        kind, change = word.partition(" ")[0], moved[0]
        if self._by == "angle" or all(other.is_constant and not number(other) for other in moved):
            return graph.constant(0.0)
        if kind == "tangents":
            return graph.reduction(f"{word} slope", *one.operands, *moved)
        is_extreme = kind in ("max", "min")
        if not change.by_angle and (is_extreme or kind == "mean"):
            return change
        if column.kind == "sqrt" and kind not in ("mean", "integral", "range"):
            # the square has no corner where the root has one
            square = column.operands[0]
            change = graph.reduction(f"{word} slope", column, self._made[square.at])
            return change * (0.5 / one) if is_extreme else change
        return graph.reduction(f"{word} slope", column, change)

    def _of_operation(self, one: Value, moved: list[Value]) -> Value:
        if len(moved) == 1:
            return self._of_function(one, moved[0])
        if one.kind == "choose":
            return self._graph.apply("choose", one.operands[0], *moved[1:])
        (left, right), (left_1, right_1) = one.operands, moved
        match one.kind:
            case "add":
                return left_1 + right_1
            case "sub":
                return left_1 - right_1
            case "mul":
                return left_1 * right + left * right_1
            case "div":
                return (left_1 - one * right_1) / right
            case "half_turns":
                return self._graph.constant(0.0)
            case "log_ratio":
                return left_1 / left - right_1 / right
        raise TypeError(f"{one!r} has no derivative")

    def _of_function(self, one: Value, moved: Value) -> Value:
        of = one.operands[0]
        if one.kind == "neg":
            return -moved
        return moved * _SLOPES[one.kind](one, of)


def _applied(name: str, of: Value) -> Value:
    return of.graph.apply(name, of)


# derivatives of functions, by the function and what it is of
_SLOPES: dict[str, Callable[[Value, Value], Value]] = {
    "sqrt": lambda one, _: 0.5 / one,
    "exp": lambda one, _: one,
    "log": lambda _, of: 1.0 / of,
    "sin": lambda _, of: _applied("cos", of),
    "cos": lambda _, of: -_applied("sin", of),
    "tan": lambda one, _: 1.0 + one * one,
    "arcsin": lambda _, of: 1.0 / _applied("sqrt", 1.0 - of * of),
    "arccos": lambda _, of: -1.0 / _applied("sqrt", 1.0 - of * of),
    "arctan": lambda _, of: 1.0 / (1.0 + of * of),
}
