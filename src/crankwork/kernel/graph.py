"""Graph of the operations of a calculation, equal operations once, and derivatives of them."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.traced_value import Operators

_OPERATIONS: dict[Callable[..., Any], str] = {
    operator.add: "add", operator.sub: "sub", operator.mul: "mul", operator.truediv: "div", operator.neg: "neg",
    operator.pow: "pow", np.add: "add", np.subtract: "sub", np.multiply: "mul", np.divide: "div", np.negative: "neg",
    np.power: "pow", np.square: "pow", np.sqrt: "sqrt", np.exp: "exp", np.log: "log", np.sin: "sin", np.cos: "cos",
    np.tan: "tan", np.arcsin: "arcsin", np.arccos: "arccos", np.arctan: "arctan",
}  # fmt: skip
COMPUTE: dict[str, Callable[..., Any]] = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": np.divide, "neg": operator.neg,
    "pow": np.power, "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "log_ratio": lambda x, y: np.log(x / y),
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "arcsin": np.arcsin, "arccos": np.arccos, "arctan": np.arctan,
    "half_turns": lambda near, angle: np.rint((near - angle) / math.pi),
    "choose": lambda condition, first, second: np.where(condition > 0, first, second),
}  # fmt: skip
# largest integer exponent of repeated multiplication
_MULTIPLIED = 8


class LawEnd(NamedTuple):
    """The end of a law in the stated design, and the interval of crank angles in which it is in other designs. [deg]

    `value`: its crank angle in each design, None if all are equal.
    """

    stated: float
    low: float
    high: float
    value: KernelValue | None = None


class KernelValue(Operators["KernelValue"]):
    """Node of the graph: an operation and its operands.

    `kind`: name of an operation, or constant, input, angle, pieces, delayed, moved or reduction, with its `detail`;
    `level`: the number of reductions, or columns at other angles, that must be complete before it.
    """

    __slots__ = ("depends_on_angle", "depends_on_design", "detail", "graph", "index", "kind", "level", "operands")

    def __init__(self, graph: KernelGraph, kind: str, operands: tuple[KernelValue, ...], detail: Any) -> None:  # noqa: ANN401
        self.graph, self.kind, self.operands, self.detail = graph, kind, operands, detail
        self.index = len(graph.values)
        # a column at another angle is read from its store, which each design has
        self.depends_on_design: bool = kind in ("input", "unknown", "delayed", "moved") or any(
            operand.depends_on_design for operand in operands
        )
        if kind == "pieces":
            self.depends_on_design |= any(end.value is not None for end in detail[0])
        self.depends_on_angle: bool = kind in ("angle", "unknown", "pieces", "moved") or (
            kind != "reduction" and any(operand.depends_on_angle for operand in operands)
        )
        waits: int = kind in ("reduction", "delayed")
        self.level: int = max((operand.level for operand in operands), default=0) + waits

    @property
    def is_constant(self) -> bool:
        """Whether it is a number."""
        return self.kind == "constant"

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *operands: Any, **options: object) -> KernelValue:  # noqa: ANN401
        if method != "__call__" or options or ufunc not in _OPERATIONS:
            return NotImplemented  # type: ignore[no-any-return]
        if ufunc is np.square:
            operands = (*operands, 2.0)
        return self.graph.apply(_OPERATIONS[ufunc], *operands)

    def _made(self, function: Callable[..., Any], *operands: Any) -> KernelValue:  # noqa: ANN401
        return self.graph.apply(_OPERATIONS[function], *operands)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.index}>"


class KernelGraph:
    """Values, equal ones once."""

    def __init__(self) -> None:
        self.values: list[KernelValue] = []
        self.functions: dict[int, Callable[..., Any]] = {}
        self._existing: dict[Any, KernelValue] = {}

    def _node(self, kind: str, operands: tuple[KernelValue, ...] = (), detail: Any = None) -> KernelValue:  # noqa: ANN401
        key = (kind, tuple(operand.index for operand in operands), detail)
        value = self._existing.get(key)
        if value is None:
            value = self._existing[key] = KernelValue(self, kind, operands, detail)
            self.values.append(value)
        return value

    def constant(self, number: float) -> KernelValue:
        """Return a number."""
        return self._node("constant", (), float(number).hex())

    def input(self, index: int) -> KernelValue:
        """Return a field of the design."""
        return self._node("input", (), index)

    def angle(self, function: str, multiple: int, shift: float) -> KernelValue:
        """Return a function of a multiple of the crank angle plus a shift. [deg]"""
        return self._node("angle", (), (function, multiple, shift))

    def reading(self, function: Callable[[Any], Any], shift: float) -> KernelValue:
        """Return the value of a Python function at the crank angle plus a shift. [deg]"""
        self.functions.setdefault(id(function), function)
        return self._node("angle", (), ("reading", id(function), shift))

    def unknown(self, *detail: Any) -> KernelValue:  # noqa: ANN401 - what tells it from others
        """Return a place for a value that is put in later."""
        return self._node("unknown", (), detail)

    def moved(self, value: KernelValue) -> KernelValue:
        """Return a function of the crank angle at angles that differ between designs: read from its store."""
        return self._node("moved", (), value)

    def pieces(self, ends: tuple[LawEnd, ...], laws: tuple[KernelValue, ...], shift: float) -> KernelValue:
        """Return consecutive laws over the crank angle plus a shift; each includes its end. [deg]"""
        return laws[0] if len({law.index for law in laws}) == 1 else self._node("pieces", laws, (ends, shift))

    def delayed(self, column: KernelValue, delay: float) -> KernelValue:
        """Return a column delayed by an angle. [deg]"""
        return self._node("delayed", (column,), delay) if column.depends_on_angle else column

    def at_angle(self, column: KernelValue, degrees: KernelValue, near: float) -> KernelValue:
        """Return the value of a column at a crank angle that depends on the design. [deg]

        `near`: that angle in the stated design, whose laws are taken.
        """
        results: dict[int, KernelValue] = {}
        for value in in_order([column], into=lambda node: node.depends_on_angle):
            if value.kind == "angle":
                function, multiple, shift = value.detail
                results[value.index] = self._of_angle(function, degrees * float(multiple) + shift)
            elif value.kind == "pieces" and not value.detail[1]:
                ends = value.detail[0]
                law = next((k for k, end in enumerate(ends) if near <= end.stated), len(ends) - 1)
                results[value.index] = results[value.operands[law].index]
            elif value.kind == "delayed" and not value.detail:
                results[value.index] = results[value.operands[0].index]
            elif value.depends_on_angle:
                if value.kind in ("pieces", "delayed"):
                    raise TypeError(f"{value!r} is none of one crank angle")
                results[value.index] = self.apply(value.kind, *(results[operand.index] for operand in value.operands))
            else:
                results[value.index] = value
        return results[column.index]

    def _of_angle(self, function: str, degrees: KernelValue) -> KernelValue:
        angle = degrees * (math.pi / 180)
        match function:
            case "within":
                return degrees
            case "angle":
                return angle
            case "sin" | "cos":
                return self.apply(function, angle)
            case "one_minus_sin" | "one_plus_sin":
                sin = self.apply("sin", angle)
                return 1.0 - sin if function == "one_minus_sin" else 1.0 + sin
        raise TypeError(f"{function} is read from a table")

    def reduction(self, word: str, *columns: KernelValue) -> KernelValue:
        """Return a reduction of columns over the cycle."""
        if word == "max" and columns[0].kind == "sqrt":
            return self.apply("sqrt", self.reduction(word, *columns[0].operands))
        return self._node("reduction", columns, word)

    def procedure(self, function: Callable[..., Any], part: int, columns: Iterable[KernelValue]) -> KernelValue:
        """Return one of the values that a function calculates from columns."""
        self.functions.setdefault(id(function), function)
        return self.reduction(f"procedure {id(function)} {part}", *columns)

    def apply(self, name: str, *operands: Any) -> KernelValue:  # noqa: ANN401 - values and numbers
        """Return the result of an operation, simplified if operands are 0 or 1."""
        values = tuple(value if isinstance(value, KernelValue) else self.constant(value) for value in operands)
        numbers = [number(value) if value.is_constant else None for value in values]
        if name == "choose":
            # a constant condition decides at once
            _, first, second = values
            if numbers[0] is not None or first is second:
                return first if numbers[0] is None or numbers[0] > 0 else second
            return self._node(name, values)
        if None not in numbers:
            with np.errstate(all="ignore"):
                return self.constant(float(COMPUTE[name](*numbers)))
        return self._simpler(name, values, numbers) or self._node(name, values)

    def _simpler(self, name: str, values: tuple[KernelValue, ...], numbers: list[Any]) -> KernelValue | None:
        if len(values) == 1:
            return self._of_one(name, *values)
        (left, right), (first, second) = values, numbers
        turned = self._without_signs(name, left, right)
        if turned is not None:
            return turned
        match name:
            case "add" if first == 0 or second == 0:
                return right if first == 0 else left
            case "sub" if second == 0:
                return left
            case "mul" if first == 0 or second == 0:
                return self.constant(0.0)
            case "mul" if first == 1 or second == 1:
                return right if first == 1 else left
            case "add" | "mul" if first is None and (second is not None or right.index < left.index):
                # one order of operands for commutative operations
                return self.apply(name, right, left)
            case "div" if first != 1:
                return left * self.reciprocal(right)
            case "pow":
                result = None if second is None else self._power(left, second)
                return result or self.apply("exp", right * self.apply("log", left))
        return None

    def _without_signs(self, name: str, left: KernelValue, right: KernelValue) -> KernelValue | None:
        """Return an equal operation with fewer changes of sign."""
        match name, left.kind, right.kind:
            case ("sub", "constant", _) if number(left) == 0:
                return -right
            case ("mul", "neg", "neg"):
                return left.operands[0] * right.operands[0]
            case ("mul", _, "constant") if number(right) == -1:
                return -left
            case ("mul", "constant", _) if number(left) == -1:
                return -right
            case ("mul", "neg", "constant"):
                return left.operands[0] * -number(right)
            case ("mul", "constant", "neg"):
                return right.operands[0] * -number(left)
            case ("add" | "sub", _, "neg"):
                return self.apply("sub" if name == "add" else "add", left, *right.operands)
        return None

    def _of_one(self, name: str, operand: KernelValue) -> KernelValue | None:
        """Simplify a double change of sign, and the logarithm of a quotient, which saves a division."""
        if name == operand.kind == "neg":
            return operand.operands[0]
        if name == "log" and operand.kind == "mul":
            for first, second in (operand.operands, operand.operands[::-1]):
                if second.kind == "div":
                    return self._node("log_ratio", (first, second.operands[1]))
        return None

    def reciprocal(self, value: KernelValue) -> KernelValue:
        """Return the reciprocal of a value: of a product that of its factors, which leaves few divisions by angle."""
        match value.kind:
            case "mul":
                left, right = value.operands
                return self.reciprocal(left) * self.reciprocal(right)
            case "div":
                return value.operands[1]
            case "neg":
                return -self.reciprocal(value.operands[0])
        return self.apply("div", 1.0, value)

    def _power(self, base: KernelValue, exponent: float) -> KernelValue | None:
        """Return a power with an exponent that needs no logarithm."""
        if exponent == 0:
            return self.constant(1.0)
        if exponent == 0.5:
            return self.apply("sqrt", base)
        if exponent < 0 and -exponent == round(-exponent) <= _MULTIPLIED:
            return self.apply("pow", self.reciprocal(base), -exponent)
        if exponent != round(exponent) or exponent > _MULTIPLIED:
            return None
        # by squaring, from the most significant digit
        result = base
        for digit in f"{int(exponent):b}"[1:]:
            result = result * result
            if digit == "1":
                result = result * base
        return result


def number(value: KernelValue) -> float:
    """Return the number of a constant."""
    return float.fromhex(value.detail)


def in_order(
    values: Iterable[KernelValue], *, into: Callable[[KernelValue], bool] = lambda _: True
) -> Iterator[KernelValue]:
    """Yield values and their operands, operands first, each once.

    `into`: whether to descend into the operands of a value.
    """
    done: set[int] = set()
    stack = [(value, False) for value in reversed(list(values))]
    while stack:
        value, is_ready = stack.pop()
        if is_ready:
            yield value
        elif value.index not in done:
            done.add(value.index)
            stack.append((value, True))
            if into(value):
                stack.extend((operand, False) for operand in reversed(value.operands))


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


_TINY = 1e-290


class ByAngle:
    """Derivatives of the values of a graph by the crank angle [1/rad], or by an unknown; created once each."""

    def __init__(self, graph: KernelGraph, unknown: KernelValue | None = None) -> None:
        self._graph, self._unknown = graph, unknown
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
            case "unknown" if value is self._unknown:
                return graph.constant(1.0)
            case "constant" | "input" | "reduction" | "unknown":
                return graph.constant(0.0)
            case "angle":
                return graph.constant(0.0) if self._unknown else self._of_angle(*value.detail)
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
        if value.kind == "sqrt":
            # a force of zero has no direction
            return graph.apply("choose", value - _TINY, changes[0] * 0.5 / value, 0.0)
        for change, partial in zip(changes, PARTIALS[value.kind](value, *value.operands), strict=True):
            result = result + change * partial
        return result

    def _of_angle(self, function: str, multiple: int, shift: float) -> KernelValue:
        if function in ("angle", "within"):
            return self._graph.constant(multiple * (1.0 if function == "angle" else 180 / math.pi))
        other, sign = _OF_ANGLE[function]
        return self._graph.angle(other, multiple, shift) * (sign * multiple)
