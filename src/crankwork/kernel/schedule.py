"""Order of a calculation: once per crank angle, once per design, and for every design at every angle; shared sums."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import COMPUTE, KernelValue, in_order, number
from crankwork.kernel.grid import Grid

Array = NDArray[np.float64]
# relative difference of equal coefficients, for example of rounded directions of cylinders
_TOLERANCE = 1e-15
# coefficient of each column and its factor of the design; without a column, a term of the design alone
Form = dict[tuple[KernelValue | None, KernelValue | None], float]


class Loop(NamedTuple):
    """Operations at the angles at which the same laws hold: values in order, and the stored columns.

    `unused`: indices of those values that no later one needs, after each.
    """

    angles: NDArray[np.intp]
    values: tuple[KernelValue, ...]
    columns: tuple[KernelValue, ...]  # In the order of `Level.columns`
    unused: tuple[tuple[int, ...], ...]


class Level(NamedTuple):
    """Values that can be calculated when the reductions of lower levels are complete.

    `designs`: values of each design in order; `columns`: those that are reduced or read at other angles.
    """

    designs: tuple[KernelValue, ...]
    columns: tuple[KernelValue, ...]
    loops: tuple[Loop, ...]
    reductions: tuple[KernelValue, ...]
    delayed: tuple[KernelValue, ...]


class Schedule:
    """The order of a calculation: `outputs` of each design, and the number of its `inputs`.

    `ends`: ends of laws that depend on the design; `moved`: functions of the crank angle in panels that move with them.
    """

    def __init__(
        self,
        outputs: Mapping[str, KernelValue],
        grid: Grid,
        inputs: int,
        angles_at: Callable[[Any], Any],
        ends: Iterable[KernelValue] = (),
        *,
        shares: bool = True,
    ) -> None:
        self.outputs, self.grid, self.inputs = dict(outputs), grid, inputs
        self.ends = tuple(ends)
        self._angles_at, self._shares = angles_at, shares
        self.row_of_angle: dict[int, int] = {}
        self.of_angle: list[KernelValue] = []
        self.moved: dict[int, KernelValue] = {}
        self._rows: list[Array] = []
        needed = list(in_order([*outputs.values(), *self.ends]))
        levels = max((value.level for value in needed), default=0)
        done: set[int] = set()
        self.levels = tuple(self._level(index, needed, done) for index in range(levels + 1))

    @property
    def table(self) -> Array:
        """Functions of the crank angle alone, shape (rows, angles)."""
        return np.array(self._rows).reshape(len(self._rows), self.grid.degrees.size)

    def _level(self, level: int, needed: list[KernelValue], done: set[int]) -> Level:
        above = [value for value in needed if value.kind in ("reduction", "delayed") and value.level == level + 1]
        columns = tuple({column.index: column for reduced in above for column in reduced.operands}.values())
        # columns stored for other angles are read at their own angle too
        delayed_columns = [column for value in needed if value.kind == "delayed" for column in value.operands]
        stored = {column.index: column.graph.delayed(column, 0.0) for column in delayed_columns}
        stored = {index: value for index, value in stored.items() if value.level <= level}
        loops = tuple(self._loops(replaced(list(columns), stored)))
        # after laws have been chosen, for example the product of a law and an area no longer depends on the angle
        operands = [operand for loop in loops for value in loop.values for operand in value.operands]
        operands += [column for loop in loops for column in loop.columns]
        hoisted = [operand for operand in operands if not operand.depends_on_angle]
        own = [value for value in needed if value.level == level and not value.depends_on_angle]
        designs = [
            value
            for value in in_order([*own, *hoisted], into=lambda value: value.kind != "reduction")
            if value.kind not in ("constant", "reduction") and value.index not in done
        ]
        done.update(value.index for value in designs)
        reductions = tuple(value for value in above if value.kind == "reduction")
        delayed = tuple(value for value in above if value.kind == "delayed")
        return Level(tuple(designs), columns, loops, reductions, delayed)

    def _loops(self, columns: list[KernelValue]) -> Iterable[Loop]:
        """Yield loops over angles, one for each combination of laws of these columns."""
        if not columns:
            return
        used = [value for value in in_order(columns, into=_at_this_angle) if value.kind == "pieces"]
        panels: dict[tuple[Any, ...], list[int]] = {}
        for panel, middle in enumerate(self.grid.middles):
            is_moving = bool(self.grid.moves[panel])
            panels.setdefault((is_moving, *(self._laws_at(value, middle) for value in used)), []).append(panel)
        nodes = self.grid.nodes
        angles_of = {
            laws: np.flatnonzero(np.isin(self.grid.panel[:nodes], numbers)) for laws, numbers in panels.items()
        }
        # a row of tables next to a jump has the law of the analysis there, whichever law ends the panel
        rows: dict[tuple[Any, ...], list[int]] = {}
        for index in range(nodes, self.grid.degrees.size):
            is_moving, degrees = bool(self.grid.moves[self.grid.panel[index]]), float(self.grid.degrees[index])
            rows.setdefault((is_moving, *(self._laws_at(value, degrees) for value in used)), []).append(index)
        for combination in dict.fromkeys([*angles_of, *rows]):
            is_moving, *laws = combination
            angles = np.array([*angles_of.get(combination, ()), *rows.get(combination, ())], dtype=np.intp)
            chosen = {value.index: law for value, law in zip(used, laws, strict=True)}
            resolved = self._with_laws(columns, chosen, is_moving=is_moving)
            roots = [resolved[column.index] for column in columns]
            if self._shares:
                roots = replaced(roots, shared(roots, in_order(roots, into=_at_this_angle)))
                roots = _with_few_divisions(roots)
            needed = list(in_order(roots, into=lambda value: value.depends_on_design and _at_this_angle(value)))
            for value in needed:
                if value.depends_on_angle and not value.depends_on_design and value.kind != "delayed":
                    self._put_in_table(value, angles)
            values = [value for value in needed if value.depends_on_angle and value.depends_on_design]
            yield Loop(angles, tuple(values), tuple(roots), _unused(values, roots))

    def _laws_at(self, value: KernelValue, middle: float) -> tuple[int, int]:
        """Return the first and the last of the laws that may hold at a crank angle, depending on the design."""
        ends, shift = value.detail
        own, last = middle + shift + self._turn(middle, shift), len(ends) - 1
        if self.grid.each:
            law = next((k for k, end in enumerate(ends) if own <= end.stated), last)
            return law, law
        first = max((k + 1 for k, end in enumerate(ends[:last]) if end.high < own), default=0)
        return first, next((k for k in range(first, last) if ends[k].low >= own), last)

    def _turn(self, middle: Any, shift: float) -> Any:  # noqa: ANN401 - of one angle or of many
        """Return the turns that bring shifted crank angles into the cycle, equal for all angles of a panel. [deg]"""
        own = middle + shift
        return np.mod(own - self.grid.start, self.grid.cycle) + self.grid.start - own if shift else 0.0

    def _with_laws(
        self, columns: Iterable[KernelValue], chosen: Mapping[int, tuple[int, int]], *, is_moving: bool
    ) -> dict[int, KernelValue]:
        """Return the values by index, with pieces replaced by the law of a panel."""
        results: dict[int, KernelValue] = {}
        for value in in_order(columns, into=_at_this_angle):
            if value.kind == "pieces":
                (ends, shift), (first, last) = value.detail, chosen[value.index]
                result = results[value.operands[last].index]
                for law in reversed(range(first, last)):
                    own = value.graph.angle("within", 1, shift)
                    end = ends[law].stated if ends[law].value is None else ends[law].value
                    result = value.graph.apply("choose", own - end, result, results[value.operands[law].index])
                results[value.index] = result
            elif value.kind == "angle" and is_moving:
                results[value.index] = self.moved.setdefault(value.index, value.graph.moved(value))
            elif value.depends_on_angle and value.kind not in ("angle", "delayed"):
                operands = [results[operand.index] for operand in value.operands]
                results[value.index] = value.graph.apply(value.kind, *operands)
            else:
                results[value.index] = value
        return results

    def _put_in_table(self, value: KernelValue, angles: NDArray[np.intp]) -> None:
        row = self.row_of_angle.get(value.index)
        if row is None:
            row = self.row_of_angle[value.index] = len(self._rows)
            self.of_angle.append(value)
            self._rows.append(np.zeros(self.grid.degrees.size))
        self._rows[row][angles] = self.function_of_angle(value, angles)

    def function_of_angle(self, value: KernelValue, angles: NDArray[np.intp] | slice) -> Array:
        """Return a function of the crank angle alone at some angles of the grid."""
        values = self.at([value], self.grid.degrees[angles], self.grid.middles[self.grid.panel[angles]])
        return np.asarray(values[value.index], dtype=float)

    def at(self, values: Iterable[KernelValue], degrees: Array, middles: Array) -> dict[int, Any]:
        """Return functions of the crank angle alone at angles, with the middles of their panels. [deg]"""
        results: dict[int, Any] = {}
        angles = self._angles_at(degrees)
        for value in in_order(values):
            if value.kind == "constant":
                results[value.index] = number(value)
            elif value.kind != "angle":
                with np.errstate(all="ignore"):
                    results[value.index] = COMPUTE[value.kind](*(results[operand.index] for operand in value.operands))
            else:
                function, multiple, shift = value.detail
                own = degrees + shift + self._turn(middles, shift)
                match function:
                    case "within":
                        results[value.index] = own
                    case "reading":
                        results[value.index] = np.asarray(value.graph.functions[multiple](own), dtype=float)
                    case _:
                        results[value.index] = getattr(angles.multiple(multiple).shifted(shift), function)
        return results


def _unused(values: Sequence[KernelValue], kept: Iterable[KernelValue]) -> tuple[tuple[int, ...], ...]:
    """Return the indices of values that are used for the last time in each of them."""
    place = {value.index: number for number, value in enumerate(values)}
    last = place | {operand.index: number for number, value in enumerate(values) for operand in value.operands}
    unused: list[list[int]] = [[] for _ in values]
    for index in place.keys() - {value.index for value in kept}:
        unused[last[index]].append(index)
    return tuple(map(tuple, unused))


def _at_this_angle(value: KernelValue) -> bool:
    """Return whether the operands of a value are needed at the same crank angle."""
    return value.depends_on_angle and value.kind != "delayed"


def _with_few_divisions(roots: list[KernelValue]) -> list[KernelValue]:
    """Return values in which two independent reciprocals come from one division.

    1 / a and 1 / b are b and a times 1 / (a b): a division takes as long as a dozen products.
    """
    while True:
        divisions = [
            value
            for value in in_order(roots, into=_at_this_angle)
            if value.depends_on_angle and value.depends_on_design and value.kind == "div"
        ]
        pairs = ((first, second) for index, first in enumerate(divisions) for second in divisions[index + 1 :])
        pair = next(((first, second) for first, second in pairs if not _depends_on(second, first)), None)
        if pair is None:
            return roots
        (first, a), (second, b) = ((division, division.operands[1]) for division in pair)
        both = first.graph.apply("div", 1.0, a * b)
        roots = replaced(roots, {first.index: b * both, second.index: a * both})


def _depends_on(value: KernelValue, other: KernelValue) -> bool:
    return any(operand is other for operand in in_order([value], into=_at_this_angle))


def replaced(roots: list[KernelValue], replacements: dict[int, KernelValue]) -> list[KernelValue]:
    """Return values with some of their operands replaced."""
    results = dict(replacements)
    for value in in_order(roots, into=lambda node: node.index not in replacements and _at_this_angle(node)):
        if value.index not in results:
            operands = tuple(results[operand.index] for operand in value.operands) if _at_this_angle(value) else ()
            if all(new is old for new, old in zip(operands, value.operands, strict=False)):
                results[value.index] = value
            elif value.kind == "pieces":
                ends, shift = value.detail
                results[value.index] = value.graph.pieces(ends, operands, shift)
            else:
                results[value.index] = value.graph.apply(value.kind, *operands)
    return [results[root.index] for root in roots]


def shared(roots: Sequence[KernelValue], values: Iterable[KernelValue]) -> dict[int, KernelValue]:
    """Return replacements of such sums by index in the graph; `values`: all of the same angle.

    Only independent terms are added here, in any order. The order of other sums may protect digits.
    """
    forms: dict[int, Form] = {}
    used = {root.index: root for root in roots}
    for value in values:
        form = _form(value, forms)
        if form is None:
            used |= {operand.index: operand for operand in value.operands}
        else:
            forms[value.index] = form
    sums = {index: forms[index] for index in used if index in forms}
    sums = {index: form for index, form in sums.items() if sum(leaf is not None for leaf, _ in form) > 1}
    while (best := _commonest(sums.values())) is not None:
        (first, second, sign), _ = best
        both = first + second if sign > 0 else first - second
        for form in sums.values():
            for factor in {factor for leaf, factor in form if leaf is first}:
                if _is_pair(form, first, second, factor) == sign:
                    form[both, factor] = form.pop((first, factor))
                    del form[second, factor]
    return {index: _sum_of(form) for index, form in sums.items()}


def _form(value: KernelValue, forms: dict[int, Form]) -> Form | None:
    """Return the terms of a sum, None if a value is no sum."""
    if value.kind == "delayed":
        return {(value, None): 1.0}
    operands = [_of_operand(operand, forms) for operand in value.operands]
    match value.kind, operands:
        case "neg", [dict() as form]:
            return _scaled(form, -1.0)
        case "add" | "sub", [dict() as left, dict() as right]:
            terms = dict(left)
            for key, amount in _scaled(right, 1.0 if value.kind == "add" else -1.0).items():
                terms[key] = terms.get(key, 0.0) + amount
            return terms
        case "mul", [dict() as left, dict() as right]:
            for form, other in ((left, value.operands[1]), (right, value.operands[0])):
                if other.is_constant:
                    return _scaled(form, number(other))
                if not other.depends_on_angle and all(factor is None for _, factor in form):
                    return {(leaf, other): amount for (leaf, _), amount in form.items()}
    return None


def _of_operand(operand: KernelValue, forms: dict[int, Form]) -> Form | None:
    if operand.depends_on_angle:
        return forms.get(operand.index)
    return {(None, None): number(operand)} if operand.is_constant else {(None, operand): 1.0}


def _scaled(form: Form, factor: float) -> Form:
    return {key: factor * amount for key, amount in form.items()}


def _is_pair(form: Form, column: KernelValue, other: KernelValue, factor: KernelValue | None) -> int:
    """Return 1 if two columns have equal coefficients, -1 if opposite ones, otherwise 0."""
    first, second = form.get((column, factor), 0.0), form.get((other, factor), 0.0)
    for sign in (1, -1):
        if first and abs(first - sign * second) <= _TOLERANCE * abs(first):
            return sign
    return 0


def _commonest(forms: Iterable[Form]) -> tuple[tuple[KernelValue, KernelValue, int], int] | None:
    """Return the pair of columns with equal coefficients in most sums, if in several."""
    counted: Counter[tuple[KernelValue, KernelValue, int]] = Counter()
    for form in forms:
        leaves = sorted((key for key in form if key[0] is not None), key=lambda key: key[0].index)  # type: ignore[union-attr]
        for (first, factor), (second, second_factor) in combinations(leaves, 2):
            if factor is second_factor and (sign := _is_pair(form, first, second, factor)):  # type: ignore[arg-type]
                counted[first, second, sign] += 1  # type: ignore[index]
    best = counted.most_common(1)
    return best[0] if best and best[0][1] > 1 else None


def _sum_of(form: Form) -> KernelValue:
    """Return the value of a sum, with columns of one coefficient added first."""
    result: KernelValue | float = 0.0
    left = dict(form)
    while left:
        (leaf, factor), amount = next(iter(left.items()))
        keys = [
            key for key in left if key[1] is factor and abs(abs(left[key]) - abs(amount)) <= _TOLERANCE * abs(amount)
        ]
        keys = [(leaf, factor)] if leaf is None else [key for key in keys if key[0] is not None]
        total: KernelValue | float = 1.0 if leaf is None else leaf
        for key in keys:
            if key[0] is not leaf and key[0] is not None:
                total = total + key[0] if left[key] * amount > 0 else total - key[0]
        for key in keys:
            del left[key]
        result = result + total * amount * (1.0 if factor is None else factor)
    assert isinstance(result, KernelValue)  # noqa: S101 - a sum has two columns at least
    return result
