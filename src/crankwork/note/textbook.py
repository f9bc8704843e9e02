"""Velocity and acceleration of the piston in one formula, as textbooks print them."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator

from crankwork.formula.expression import Expression, Operation, Symbol
from crankwork.formula.lines import FormulaLine, Line

# what follows from a transfer function, which stands before it
_OF_TRANSFER = {
    f"{key}{order}": f"{transfer}{order}"
    for key, transfer in (("piston_velocity", "piston_transfer_1"), ("piston_acceleration", "piston_transfer_2"))
    for order in ("", "_first_order", "_second_order")
} | {"inertia_acceleration": "piston_transfer_2.inertia"}
TRANSFER = tuple(_OF_TRANSFER.values())


def in_one_formula(lines: Iterable[Line]) -> Iterator[Line]:
    """Yield lines, the transfer functions of the piston put into what follows from them: v = R ω (sin φ + ...)."""
    all_lines = list(lines)
    known = {item.key: item for item in all_lines if isinstance(item, FormulaLine)}
    joined: dict[str, FormulaLine | None] = {}
    for key, factor in _OF_TRANSFER.items():
        line, transfer = known.get(key), known.get(factor)
        if line is not None and transfer is not None and (product := _joined(line, transfer)) is not None:
            joined[key], joined[factor] = product, None
    for each in all_lines:
        replaced = joined.get(each.key, each)
        if replaced is not None:
            yield replaced


def _joined(line: FormulaLine, transfer: FormulaLine) -> FormulaLine | None:
    """Return a product with a transfer function as a product with what that is a product of."""
    match line.expression, transfer.expression:
        case (
            Operation(operator.mul, (Symbol(name), speed)),
            Operation(operator.mul, (first, second))
            | Operation(operator.truediv, (Operation(operator.mul, (first, second)), _)) as whole,
        ):
            factor: Expression = Operation(operator.mul, (first, speed))
            if whole.function is operator.truediv:
                factor = Operation(operator.truediv, (factor, whole.operands[1]))
            tree = Operation(operator.mul, (factor, second))
            values = {key: value for key, value in line.values.items() if key != name}
            named = (*transfer.named, *(symbol for symbol in line.named if symbol[0] != name))
            return line._replace(values={**transfer.values, **values}, tree=tree, named=named)
    return None
