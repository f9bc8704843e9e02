"""What a calculation comes to when its formulas are opened: operations on numbers, equal ones once."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

_OPERATIONS: dict[Callable[..., Any], str] = {
    operator.add: "add",
    operator.sub: "sub",
    operator.mul: "mul",
    operator.truediv: "div",
    operator.neg: "neg",
    operator.pow: "pow",
    np.add: "add",
    np.subtract: "sub",
    np.multiply: "mul",
    np.divide: "div",
    np.negative: "neg",
    np.power: "pow",
    np.square: "pow",
    np.sqrt: "sqrt",
    np.exp: "exp",
    np.log: "log",
    np.sin: "sin",
    np.cos: "cos",
    np.tan: "tan",
    np.arcsin: "arcsin",
    np.arccos: "arccos",
    np.arctan: "arctan",
}
COMPUTE: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": np.divide,
    "neg": operator.neg,
    "pow": np.power,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "log_ratio": lambda x, y: np.log(x / y),
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "arcsin": np.arcsin,
    "arccos": np.arccos,
    "arctan": np.arctan,
    "half_turns": lambda near, angle: np.rint((near - angle) / math.pi),
    "choose": lambda of, first, second: np.where(of > 0, first, second),
}
# largest whole exponent that is multiplied out
_MULTIPLIED = 8


class End(NamedTuple):
    """Where a law ends: in the stated design, and between which crank angles it is looked for in others. [deg]

    `value` is what it is in each design, None where it is the same in all.
    """

    stated: float
    low: float
    high: float
    value: Value | None = None


class Value:
    """One number of a calculation: how it is made of others.

    `kind` is the name of an operation, or constant, input, angle, pieces, delayed or reduction, with its `detail`.
    `by_design` and `by_angle` say what it varies with; `level` how many reductions, or columns of another angle, it
    waits for.
    """

    __slots__ = ("at", "by_angle", "by_design", "detail", "graph", "kind", "level", "operands")

    def __init__(self, graph: Graph, kind: str, operands: tuple[Value, ...], detail: Any) -> None:  # noqa: ANN401
        self.graph, self.kind, self.operands, self.detail = graph, kind, operands, detail
        self.at = len(graph.values)
        # a column of another angle is read where it was kept for each design
        self.by_design: bool = kind in ("input", "delayed", "moved") or any(one.by_design for one in operands)
        if kind == "pieces":
            self.by_design |= any(one.value is not None for one in detail[0])
        self.by_angle: bool = kind in ("angle", "pieces", "moved") or (
            kind != "reduction" and any(one.by_angle for one in operands)
        )
        waits: int = kind in ("reduction", "delayed")
        self.level: int = max((one.level for one in operands), default=0) + waits

    @property
    def is_constant(self) -> bool:
        """Whether it is a number."""
        return self.kind == "constant"

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *operands: Any, **options: object) -> Value:  # noqa: ANN401
        if method != "__call__" or options or ufunc not in _OPERATIONS:
            return NotImplemented  # type: ignore[no-any-return]
        if ufunc is np.square:
            operands = (*operands, 2.0)
        return self.graph.apply(_OPERATIONS[ufunc], *operands)

    def __add__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("add", self, other)

    def __radd__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("add", other, self)

    def __sub__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("sub", self, other)

    def __rsub__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("sub", other, self)

    def __mul__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("mul", self, other)

    def __rmul__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("mul", other, self)

    def __truediv__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("div", self, other)

    def __rtruediv__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("div", other, self)

    def __pow__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("pow", self, other)

    def __rpow__(self, other: Any) -> Value:  # noqa: ANN401
        return self.graph.apply("pow", other, self)

    def __neg__(self) -> Value:
        return self.graph.apply("neg", self)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.at}>"


class Graph:
    """Values, each way of making one once."""

    def __init__(self) -> None:
        self.values: list[Value] = []
        self.functions: dict[int, Callable[..., Any]] = {}
        self._found: dict[Any, Value] = {}

    def _made(self, kind: str, operands: tuple[Value, ...] = (), detail: Any = None) -> Value:  # noqa: ANN401
        key = (kind, tuple(one.at for one in operands), detail)
        value = self._found.get(key)
        if value is None:
            value = self._found[key] = Value(self, kind, operands, detail)
            self.values.append(value)
        return value

    def constant(self, number: float) -> Value:
        """Return a number."""
        return self._made("constant", (), float(number).hex())

    def input(self, at: int) -> Value:
        """Return what a design states in a place."""
        return self._made("input", (), at)

    def angle(self, function: str, multiple: int, shift: float) -> Value:
        """Return a function of a multiple of the crank angle counted from elsewhere. [deg]"""
        return self._made("angle", (), (function, multiple, shift))

    def reading(self, function: Callable[[Any], Any], shift: float) -> Value:
        """Return what a function gives at the crank angle counted from elsewhere. [deg]"""
        self.functions.setdefault(id(function), function)
        return self._made("angle", (), ("reading", id(function), shift))

    def moved(self, of: Value) -> Value:
        """Return what depends on the crank angle where that differs between designs: read from where it was put."""
        return self._made("moved", (), of)

    def pieces(self, ends: tuple[End, ...], laws: tuple[Value, ...], shift: float) -> Value:
        """Return laws that follow one another, counted from elsewhere; each owns its end. [deg]"""
        return laws[0] if len({one.at for one in laws}) == 1 else self._made("pieces", laws, (ends, shift))

    def delayed(self, column: Value, by: float) -> Value:
        """Return a column every value of which comes later by an angle. [deg]"""
        return self._made("delayed", (column,), by) if column.by_angle else column

    def at_angle(self, column: Value, degrees: Value) -> Value:
        """Return what a column amounts to at a crank angle that follows from the design. [deg]"""
        made: dict[int, Value] = {}
        for one in in_order([column], into=lambda one: one.by_angle):
            if one.kind == "angle":
                function, multiple, shift = one.detail
                made[one.at] = self._of_angle(function, degrees * float(multiple) + shift)
            elif one.by_angle:
                if one.kind in ("pieces", "delayed"):
                    raise TypeError(f"{one!r} is none of one crank angle")
                made[one.at] = self.apply(one.kind, *(made[other.at] for other in one.operands))
            else:
                made[one.at] = one
        return made[column.at]

    def _of_angle(self, function: str, at: Value) -> Value:
        angle = at * (math.pi / 180)
        match function:
            case "within":
                return at
            case "angle":
                return angle
            case "sin" | "cos":
                return self.apply(function, angle)
            case "one_minus_sin" | "one_plus_sin":
                sin = self.apply("sin", angle)
                return 1.0 - sin if function == "one_minus_sin" else 1.0 + sin
        raise TypeError(f"{function} is read from a table")

    def reduction(self, word: str, *columns: Value) -> Value:
        """Return what columns come to over the cycle."""
        if word == "max" and columns[0].kind == "sqrt":
            return self.apply("sqrt", self.reduction(word, *columns[0].operands))
        return self._made("reduction", columns, word)

    def procedure(self, function: Callable[..., Any], part: int, columns: Iterable[Value]) -> Value:
        """Return one of the values that a function finds of columns."""
        self.functions.setdefault(id(function), function)
        return self.reduction(f"procedure {id(function)} {part}", *columns)

    def apply(self, name: str, *operands: Any) -> Value:  # noqa: ANN401 - values and numbers
        """Return what an operation gives, without what zeros and ones do not change."""
        values = tuple(one if isinstance(one, Value) else self.constant(one) for one in operands)
        numbers = [number(one) if one.is_constant else None for one in values]
        if name == "choose":
            # a number decides at once
            _, first, second = values
            if numbers[0] is not None or first is second:
                return first if numbers[0] is None or numbers[0] > 0 else second
            return self._made(name, values)
        if None not in numbers:
            with np.errstate(all="ignore"):
                return self.constant(float(COMPUTE[name](*numbers)))
        return self._simpler(name, values, numbers) or self._made(name, values)

    def _simpler(self, name: str, values: tuple[Value, ...], numbers: list[Any]) -> Value | None:
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
            case "add" | "mul" if first is None and (second is not None or right.at < left.at):
                # the same whichever way it is written
                return self.apply(name, right, left)
            case "div" if first != 1:
                return left * self.reciprocal(right)
            case "pow":
                result = None if second is None else self._power(left, second)
                return result or self.apply("exp", right * self.apply("log", left))
        return None

    def _without_signs(self, name: str, left: Value, right: Value) -> Value | None:
        """Return an operation on what has its sign turned with the sign elsewhere, or with none at all."""
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

    def _of_one(self, name: str, of: Value) -> Value | None:
        """Return what has its sign turned twice, or the logarithm of a quotient, which saves a division."""
        if name == of.kind == "neg":
            return of.operands[0]
        if name == "log" and of.kind == "mul":
            for one, other in (of.operands, of.operands[::-1]):
                if other.kind == "div":
                    return self._made("log_ratio", (one, other.operands[1]))
        return None

    def reciprocal(self, value: Value) -> Value:
        """Return one over a value: of a product that of its factors, so that few divisions are left where it counts."""
        match value.kind:
            case "mul":
                left, right = value.operands
                return self.reciprocal(left) * self.reciprocal(right)
            case "div":
                return value.operands[1]
            case "neg":
                return -self.reciprocal(value.operands[0])
        return self.apply("div", 1.0, value)

    def _power(self, base: Value, exponent: float) -> Value | None:
        """Return a power with an exponent that needs no logarithm."""
        if exponent == 0:
            return self.constant(1.0)
        if exponent == 0.5:
            return self.apply("sqrt", base)
        if exponent < 0 and -exponent == round(-exponent) <= _MULTIPLIED:
            return self.apply("pow", self.reciprocal(base), -exponent)
        if exponent != round(exponent) or exponent > _MULTIPLIED:
            return None
        # by squares, from the most significant digit
        result = base
        for digit in f"{int(exponent):b}"[1:]:
            result = result * result
            if digit == "1":
                result = result * base
        return result


def number(value: Value) -> float:
    """Return the number that a constant is."""
    return float.fromhex(value.detail)


def in_order(values: Iterable[Value], *, into: Callable[[Value], bool] = lambda _: True) -> Iterator[Value]:
    """Yield all that values are made of, operands first, each once.

    `into`: whether what a value is made of is wanted too.
    """
    done: set[int] = set()
    stack = [(one, False) for one in reversed(list(values))]
    while stack:
        one, is_ready = stack.pop()
        if is_ready:
            yield one
        elif one.at not in done:
            done.add(one.at)
            stack.append((one, True))
            if into(one):
                stack.extend((other, False) for other in reversed(one.operands))
