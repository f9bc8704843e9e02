"""Notices about arguments outside the range in which an empirical formula is valid."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from crankwork.formula.replay import Angles, replay
from crankwork.formula.traced_value import Array, FormulaCall, TracedValue, in_order

CODE = "formula_range"


def range_notices(
    traced_values: Iterable[TracedValue], angles: Angles | None = None
) -> Iterator[tuple[str, Mapping[str, float | str]]]:
    """Yield where formulas that traced values are made of are used outside the range that their source vouches for.

    Of each formula and argument at most one notice, about the value farthest outside, in the unit of the argument.
    `angles`: where to look at operands that vary with the crank angle; without it they are not looked at [rad].
    """
    farthest: dict[tuple[str, str], tuple[float, Mapping[str, float | str]]] = {}
    for node in (traced.node for traced in in_order(traced_values)):
        if not isinstance(node, FormulaCall):
            continue
        for name, operand in zip(node.formula.arguments, node.inputs, strict=True):
            if name not in node.formula.valid:
                continue
            low, high = node.formula.valid[name]
            values = _values(operand, angles)
            outside = np.maximum(low - values, values - high)
            index = int(np.argmax(outside)) if values.size else 0
            key = (node.formula.name, name)
            if values.size and outside[index] > max(0.0, farthest.get(key, (0.0, {}))[0]):
                about: dict[str, float | str] = {"quantity": node.formula.quantity, "argument": name}
                farthest[key] = float(outside[index]), about | {"value": float(values[index]), "low": low, "high": high}
    yield from ((CODE, values_of_notice) for _, values_of_notice in farthest.values())


def _values(operand: TracedValue | float, angles: Angles | None) -> Array:
    if not isinstance(operand, TracedValue):
        return np.array([operand])
    if not operand.varies:
        return np.array([operand.value])
    return np.empty(0) if angles is None else replay(operand, angles)
