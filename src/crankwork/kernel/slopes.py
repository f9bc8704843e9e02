"""What more is asked of single values: how they change with what a design states, and in parts of the cycle."""

from __future__ import annotations

from collections.abc import Mapping

from crankwork.kernel.derivative import Derivatives
from crankwork.kernel.graph import Value, in_order


def by_field(key: str, field: int) -> str:
    """Return what the derivative of a single value by a field is called."""
    return f"{key} by {field}"


def in_part(key: str, part: int) -> str:
    """Return what a single value is called that looks for extremes in one part of the cycle."""
    return f"{key} in {part}"


def slopes_of(outputs: Mapping[str, Value], fields: int) -> dict[str, Value]:
    """Return the derivatives of single values by each field."""
    graph = next(iter(outputs.values())).graph
    by = [Derivatives(graph, field) for field in range(fields)]
    return {by_field(key, at): one.of(value) for key, value in outputs.items() for at, one in enumerate(by)}


def apart(value: Value, parts: int) -> list[Value]:
    """Return a single value with its one extreme looked for in each part of the cycle; none where it is no such one.

    The extreme of the whole cycle changes its place at once where two are level; each part's own goes on.
    """
    inner = list(in_order([value], into=lambda one: one.kind != "reduction"))
    extremes = [one for one in inner if one.kind == "reduction"]
    if len(extremes) != 1 or extremes[0].detail not in ("max", "min"):
        return []
    found = []
    for part in range(parts):
        made: dict[int, Value] = {}
        for one in inner:
            operands = [made.get(other.at, other) for other in one.operands]
            if one is extremes[0]:
                made[one.at] = one.graph.reduction(f"{one.detail} {part}", *one.operands)
            elif any(new is not old for new, old in zip(operands, one.operands, strict=True)):
                made[one.at] = one.graph.apply(one.kind, *operands)
        found.append(made[value.at])
    return found
