"""Values with their calculation.

A traced value is a node of the calculation, and the name it goes by where it is used. Formulas make traced values of
traced values; outside formulas a traced value takes part in plain sums, products and quotients only and refuses
everything else, because what is not traced could neither be explained nor replayed. What does not vary with the crank
angle has its value at once; a column is replayed at whatever angles are asked for.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from crankwork.formula.expression import Formula

Array = NDArray[np.float64]
Made = TypeVar("Made")


class Operators(Generic[Made]):
    """The operators of Python: each makes a value of a function and its operands by `_made`."""

    __slots__ = ()

    def _made(self, function: Callable[..., Any], *operands: Any) -> Made:  # noqa: ANN401 - values and numbers
        raise NotImplementedError

    def __add__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.add, self, other)

    def __radd__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.add, other, self)

    def __sub__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.sub, self, other)

    def __rsub__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.sub, other, self)

    def __mul__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.mul, self, other)

    def __rmul__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.mul, other, self)

    def __truediv__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.truediv, other, self)

    def __pow__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.pow, self, other)

    def __rpow__(self, other: Any) -> Made:  # noqa: ANN401
        return self._made(operator.pow, other, self)

    def __neg__(self) -> Made:
        return self._made(operator.neg, self)


class Node:
    """A node of the computation graph: its operands, and its value, None where that varies with the crank angle."""

    __slots__ = ("operands", "value")

    def __init__(self, value: float | None, operands: Iterable[TracedValue] = ()) -> None:
        self.value, self.operands = value, tuple(operands)


class Input(Node):
    """A value of the description, at `path` in the file; an absent one is a neutral number that nobody stated.

    `unit` is stated where formulas take it in another unit than the SI unit of its quantity.
    """

    __slots__ = ("is_absent", "path", "unit")

    def __init__(self, value: float, path: str = "", unit: str = "", *, is_absent: bool = False) -> None:
        super().__init__(float(value))
        self.path, self.unit, self.is_absent = path, unit, is_absent


class AngleFunction(Node):
    """A function of a whole multiple of the crank angle, counted from elsewhere: an attribute of its grid. [deg]"""

    __slots__ = ("function", "multiple", "shift")

    def __init__(self, function: str, multiple: int = 1, shift: float = 0.0) -> None:
        super().__init__(None)
        self.function, self.multiple, self.shift = function, multiple, shift


class FormulaCall(Node):
    """A formula with its operands; plain numbers among them are constants of the analysis.

    `general_form`: expression valid for all inputs; `inputs` hold only the branch taken for these.
    """

    __slots__ = ("formula", "general_form", "inputs")

    def __init__(
        self, formula: Formula, inputs: tuple[TracedValue | float, ...], general_form: TracedValue | None = None
    ) -> None:
        self.value, self.operands = _value(formula.function, inputs)
        self.formula, self.inputs, self.general_form = formula, inputs, general_form


class Arithmetic(Node):
    """A sum, difference, product or quotient, printed where it stands."""

    __slots__ = ("function", "inputs")

    def __init__(self, function: Callable[..., Any], inputs: tuple[TracedValue | float, ...]) -> None:
        self.value, self.operands = _value(function, inputs)
        self.function, self.inputs = function, inputs


class Sum(Node):
    """The sum of its operands, added in order."""

    __slots__ = ()

    def __init__(self, terms: tuple[TracedValue, ...]) -> None:
        self.value, self.operands = _value(lambda *values: sum(values), terms)


class Delayed(Node):
    """The same column at another crank angle: every value later by `by`, the cycle closed. [deg]"""

    __slots__ = ("by", "cycle", "of")

    def __init__(self, column: TracedValue, shift: float, cycle: float) -> None:
        super().__init__(column.node.value, (column,))
        self.of, self.by, self.cycle = column, shift, cycle


class Conditional(Node):
    """One of two values: the first where another is above zero, else the second."""

    __slots__ = ()

    def __init__(self, condition: TracedValue, first: TracedValue, second: TracedValue) -> None:
        super().__init__((first if condition.value > 0 else second).value, (condition, first, second))


class Piecewise(Node):
    """Laws that follow one another over the crank angle; each owns its end and not its start. [deg]

    A law is a formula of columns other than the pieces, a table, or a value. `knots` are further angles where
    the column is not smooth. An end may be a known. `general_form` gives the column as an expression valid for all
    inputs, where laws are tables of numbers.
    """

    __slots__ = ("ends", "general_form", "knots", "places")

    def __init__(
        self,
        ends: Iterable[float | TracedValue],
        laws: tuple[TracedValue, ...],
        knots: Iterable[float] = (),
        general_form: Callable[[], TracedValue] | None = None,
    ) -> None:
        super().__init__(None, laws)
        self.places, self.general_form = tuple(ends), general_form
        self.ends = np.array([to_number(end) for end in self.places], dtype=float)
        self.knots = (*self.ends.tolist(), *knots)


class Tabulated(Node):
    """What is defined on rows of its own: measured, integrated or counted. `knots` are where it is not smooth. [deg]

    `word` says what kind of table it is, `operands` what it was made from. It is read at the crank angle [deg], or
    `by` another column. A function with `between` says what a value is made of at one place.
    """

    __slots__ = ("by", "function", "knots", "word")

    def __init__(
        self,
        function: Callable[[Array], Array],
        word: str,
        knots: Iterable[float] = (),
        operands: Iterable[TracedValue] = (),
        argument: TracedValue | None = None,
    ) -> None:
        super().__init__(None, operands if argument is None else (argument, *operands))
        self.function, self.word, self.knots, self.by = function, word, tuple(knots), argument


class Root(Node):
    """Unknowns at which residuals vanish, on one circuit: `solve` gives them and their derivatives, shape (k, n).

    It takes the crank angles, or the columns that the unknowns follow `of`. `residuals` are what must vanish; they
    are made of components of the root; `knots` are crank angles where unknowns are not smooth [deg]. `sides` are
    columns where whose signs change residuals have corners, each with the crank angles of that.
    """

    __slots__ = ("knots", "residuals", "sides", "solve")

    def __init__(self, solve: Callable[[Any], Array], operands: Iterable[TracedValue] = ()) -> None:
        super().__init__(None, operands)
        self.solve: Callable[[Any], Array] = solve
        self.residuals: tuple[TracedValue, ...] = ()
        self.knots: tuple[float, ...] = ()
        self.sides: tuple[tuple[TracedValue, tuple[TracedValue, ...]], ...] = ()


class Component(Node):
    """One of the unknowns of a root, or of their derivatives, shape (n,)."""

    __slots__ = ("at",)

    def __init__(self, root: Root, index: int) -> None:
        super().__init__(None, (TracedValue(root),))
        self.at = index


class AngleUnwrap(Node):
    """Number of half turns that unwraps the arc tangent of a slope to a continuous direction.

    `near` is roughly the direction at crank angles, operands are its sine and cosine. [deg] -> [rad]
    """

    __slots__ = ("near",)

    def __init__(self, sin: TracedValue, cos: TracedValue, near: Callable[[Array], Array]) -> None:
        super().__init__(None, (sin, cos))
        self.near = near


class ProcedureValue(Node):
    """A single value that a procedure found: the largest of a column, its mean, a root, an angle.

    `word` names the procedure, `operands` are what it was applied to, `at` is the crank angle where the value stands,
    if it stands at one [deg]. `by` is that angle where it follows from other traced values, or what a column
    reaches; of other words the same value made of traced values alone.
    """

    __slots__ = ("at", "by", "word")

    def __init__(
        self,
        value: float,
        word: str,
        operands: Iterable[TracedValue] = (),
        angle: float | None = None,
        argument: TracedValue | None = None,
    ) -> None:
        super().__init__(float(value), operands)
        self.word, self.at, self.by = word, angle, argument

    @property
    def general_form(self) -> TracedValue | None:
        """The same value made of traced values alone, where there is such a way."""
        return None if self.word in ("at", "reached") else self.by


class HarmonicCoefficient(ProcedureValue):
    """A part of a harmonic of a column, of so many waves in a turn of the crank: its `cosine` or `sine`."""

    __slots__ = ("order", "part")

    def __init__(self, value: float, column: TracedValue, part: str, order: float) -> None:
        super().__init__(value, "fourier", (column,))
        self.part, self.order = part, order


class FunctionValue(ProcedureValue):
    """A single value that `function` found with others, of which it is one: of columns over a cycle and single values.

    It takes edges of panels [rad] and Legendre coefficients of its operands on them, shape (operands, panels, k). Where
    designs differ in it they are not made the same way.
    """

    __slots__ = ("function", "part")

    def __init__(
        self,
        value: float,
        word: str,
        operands: Iterable[TracedValue],
        function: Callable[[Array, Array], Sequence[float]],
        part: int,
    ) -> None:
        super().__init__(value, word, operands)
        self.function, self.part = function, part


class TracedValue(Operators["TracedValue"]):
    """A value with its calculation, under the name it has here.

    The key is that of the quantity, with what tells it from others of that quantity after a point: `joint_force.A`.

    Examples
    --------
    >>> r, w = given("crank_radius", 0.05), given("speed", 100.0)
    >>> (r * w).value
    5.0
    """

    __slots__ = ("key", "node")
    __array_ufunc__ = None

    def __init__(self, node: Node, key: str = "") -> None:
        self.node, self.key = node, key

    @property
    def value(self) -> float:
        """The value, where it does not vary with the crank angle. [SI]"""
        if self.node.value is None:
            raise TypeError(f"{self!r} varies with the crank angle; replay it at the angles wanted")
        return self.node.value

    @property
    def varies(self) -> bool:
        """Whether it varies with the crank angle."""
        return self.node.value is None

    @property
    def is_absent(self) -> bool:
        """Whether it is an input that was not stated."""
        return isinstance(self.node, Input) and self.node.is_absent

    def named(self, key: str) -> TracedValue:
        """Return the same value under another name."""
        return TracedValue(self.node, key)

    def __repr__(self) -> str:
        return f"<known {self.key or type(self.node).__name__}>"

    def _made(self, function: Callable[..., Any], *operands: Any) -> TracedValue:  # noqa: ANN401
        return TracedValue(Arithmetic(function, operands))

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError(f"{self!r} is traced: only formulas, sums, products and quotients may take it")

    # a number taken out of the trace would be lost to notes, checks and replay
    __bool__ = __float__ = __int__ = __complex__ = __len__ = __iter__ = __getitem__ = __pow__ = __rpow__ = _refuse
    __lt__ = __le__ = __gt__ = __ge__ = __abs__ = __round__ = __array__ = __array_function__ = _refuse
    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other or self._refuse()


class TracedAngle:
    """The crank angle as a known: what `CrankGrid` has as arrays."""

    def __init__(self, multiple: int = 1, shift: float = 0.0) -> None:
        self._multiple, self._shift = multiple, shift
        self._made: dict[object, Any] = {}

    def _function(self, name: str) -> TracedValue:
        if name not in self._made:
            self._made[name] = TracedValue(AngleFunction(name, self._multiple, self._shift))
        known: TracedValue = self._made[name]
        return known

    angle = property(lambda self: self._function("angle"))
    degrees = property(lambda self: self._function("degrees"))
    sin = property(lambda self: self._function("sin"))
    cos = property(lambda self: self._function("cos"))
    sin_2 = property(lambda self: self.multiple(2).sin)
    cos_2 = property(lambda self: self.multiple(2).cos)
    one_minus_sin = property(lambda self: self._function("one_minus_sin"))
    one_plus_sin = property(lambda self: self._function("one_plus_sin"))

    def multiple(self, order: int) -> TracedAngle:
        """Return a whole multiple of the angle."""
        made: TracedAngle = self._made.setdefault(order, TracedAngle(order * self._multiple, order * self._shift))
        return self if order == 1 else made

    def shifted(self, degrees: float) -> TracedAngle:
        """Return the angle counted from elsewhere, larger by some degrees."""
        made: TracedAngle = self._made.setdefault(
            ("shift", degrees), TracedAngle(self._multiple, self._shift + degrees)
        )
        return made if degrees else self


def given(key: str, value: float, path: str = "", unit: str = "") -> TracedValue:
    """Return a stated value. [SI]

    `unit`: the unit in which formulas take it, where that is not the SI unit of its quantity.
    """
    return TracedValue(Input(value, path, unit), key)


def absent(key: str, neutral: float = 0.0) -> TracedValue:
    """Return an input that is not stated: a neutral number, whose terms are not printed."""
    return TracedValue(Input(neutral, is_absent=True), key)


def named(value: Any, key: str) -> Any:  # noqa: ANN401 - a number stays what it is
    """Return a known under a name; a number as it is, so that the same code serves both."""
    return value.named(key) if type(value) is TracedValue else value


def total(key: str, terms: Iterable[TracedValue]) -> TracedValue:
    """Return the sum of terms; of one term, that term under the name of the sum."""
    terms = tuple(terms)
    return terms[0].named(key) if len(terms) == 1 else TracedValue(Sum(terms), key)


def sum_terms(key: str, terms: Sequence[Any]) -> Any:  # noqa: ANN401 - numbers give numbers, traced give traced
    """Return the sum of terms in order, traced under a key if they are traced."""
    return total(key, terms) if is_traced(*terms) else sum(terms)


def to_number(value: Any) -> Any:  # noqa: ANN401 - whatever number it is
    """Return the number behind a value that may be traced, for procedures that are not traced."""
    return value.value if isinstance(value, TracedValue) else value


def reached(column: TracedValue, degrees: float, level: TracedValue | float = 0.0) -> TracedValue:
    """Return the crank angle at which a column reaches a level. [deg]"""
    traced = level if isinstance(level, TracedValue) else given("", level)
    return TracedValue(ProcedureValue(degrees, "reached", (column,), degrees, traced))


def select(condition: Any, first: Any, second: Any) -> Any:  # noqa: ANN401 - numbers, arrays of them, or of traced values
    """Return the first of two values where another is above zero, else the second."""
    if any(isinstance(value, np.ndarray) and value.dtype == object for value in (condition, first, second)):
        return np.frompyfunc(select, 3, 1)(condition, first, second)
    if is_traced(condition, first, second):
        values = (condition, first, second)
        return TracedValue(
            Conditional(*(value if isinstance(value, TracedValue) else TracedValue(Input(value)) for value in values))
        )
    return np.where(condition > 0, first, second)[()]


def delayed(known: TracedValue, shift: float, cycle: float, key: str) -> TracedValue:
    """Return a column every value of which comes later by an angle, the cycle closed; both in degrees."""
    return TracedValue(Delayed(known, shift % cycle, cycle), key) if shift % cycle else known.named(key)


def is_traced(*values: object) -> bool:
    """Return whether any of the values is traced."""
    return TracedValue in map(type, values)


def in_order(
    values: Iterable[TracedValue], *, into: Callable[[Node], Sequence[TracedValue]] | None = None
) -> Iterator[TracedValue]:
    """Yield values and all their dependencies, operands before their results, each node once.

    `into`: returns the dependencies of a node to follow; its operands by default.
    """
    done: set[int] = set()
    stack: list[TracedValue | None] = list(reversed(tuple(values)))
    # what is made of operands on the stack, each after a gap below them
    made: list[TracedValue] = []
    while stack:
        known = stack.pop()
        if known is None:
            yield made.pop()
        elif id(known.node) not in done:
            done.add(id(known.node))
            operands = known.node.operands if into is None else into(known.node)
            if operands:
                made.append(known)
                stack.append(None)
                stack.extend(operands[::-1])
            else:
                yield known


def breakpoints_of(columns: Iterable[TracedValue], cycle: float, start: float = 0.0) -> Array:
    """Return the breakpoints of columns, angles where they are not smooth, with start and end of the cycle. [deg]

    `cycle` and `start`: length and beginning of the cycle [deg].
    """
    breaks = _breaks(tuple(columns), {})
    inside = start + np.mod(np.array(sorted(breaks), dtype=float) - start, cycle)
    edges = unique_sorted(np.concatenate([[start], inside, [start + cycle]]))
    # breakpoints that differ by rounding only are merged
    kept = edges[np.append(np.diff(edges) > _SAME_ANGLE, True)]
    kept[0] = start
    return np.asarray(kept)


_SAME_ANGLE = 1e-7


def unique_sorted(values: Array) -> Array:
    """Return the different ones of some numbers, ascending; `numpy.unique` would load masked arrays for it."""
    ordered = np.sort(values)
    return np.asarray(ordered[np.append(True, np.diff(ordered) > 0)]) if ordered.size else ordered


def _breaks(knowns: tuple[TracedValue, ...], memo: dict[frozenset[Node], set[float]]) -> set[float]:
    late = dict[tuple[float, float], dict[Node, TracedValue]]()

    def undelayed(node: Node) -> list[TracedValue]:
        if isinstance(node, Delayed):
            late.setdefault((node.by, node.cycle), {})[node.of.node] = node.of
            return []
        operands = (*node.operands, *node.residuals) if isinstance(node, Root) else node.operands
        return [operand for operand in operands if operand.node.value is None]

    nodes = [known.node for known in in_order((known for known in knowns if known.varies), into=undelayed)]
    breaks = {angle for node in nodes if isinstance(node, Piecewise | Tabulated | Root) for angle in node.knots}
    for (by, cycle), earlier in late.items():
        # most cylinders have the same columns
        key = frozenset(earlier)
        if key not in memo:
            memo[key] = _breaks(tuple(earlier.values()), memo)
        breaks |= {(angle + by) % cycle for angle in memo[key]}
    return breaks


def _value(
    function: Callable[..., Any], inputs: Sequence[TracedValue | float]
) -> tuple[float | None, tuple[TracedValue, ...]]:
    """Return the value of a constant expression, or None if it varies with the crank angle, and its traced operands."""
    numbers = [item.node.value if type(item) is TracedValue else item for item in inputs]
    value = None if None in numbers else float(function(*numbers))
    return value, tuple([item for item in inputs if type(item) is TracedValue])
