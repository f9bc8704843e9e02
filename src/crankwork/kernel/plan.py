"""What is calculated when: once for a crank angle, once for a design, and for every design at every angle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import COMPUTE, Value, in_order, number
from crankwork.kernel.grid import Grid
from crankwork.kernel.sums import shared

Array = NDArray[np.float64]


class Loop(NamedTuple):
    """What is done at the angles where the same laws hold: values in order, and where those that are kept go."""

    angles: NDArray[np.intp]
    values: tuple[Value, ...]
    columns: tuple[Value, ...]  # In the order of `Level.columns`


class Level(NamedTuple):
    """What can be calculated when the reductions of lower levels are known.

    `designs` are values of each design in order, `columns` what of the angles is reduced or read at other angles.
    """

    designs: tuple[Value, ...]
    columns: tuple[Value, ...]
    loops: tuple[Loop, ...]
    reductions: tuple[Value, ...]
    delayed: tuple[Value, ...]


class Plan:
    """The order of a calculation: `outputs` are wanted of each design, `inputs` how many things it states.

    `ends` are the ends of laws that follow from the design, `moved` what depends on the crank angle where that does.
    """

    def __init__(
        self,
        outputs: Mapping[str, Value],
        grid: Grid,
        inputs: int,
        angles_at: Callable[[Any], Any],
        ends: Iterable[Value] = (),
        *,
        shares: bool = True,
    ) -> None:
        self.outputs, self.grid, self.inputs = dict(outputs), grid, inputs
        self.ends = tuple(ends)
        self._angles_at, self._shares = angles_at, shares
        self.row_of_angle: dict[int, int] = {}
        self.of_angle: list[Value] = []
        self.moved: dict[int, Value] = {}
        self._rows: list[Array] = []
        needed = list(in_order([*outputs.values(), *self.ends]))
        levels = max((one.level for one in needed), default=0)
        made: set[int] = set()
        self.levels = tuple(self._level(at, needed, made) for at in range(levels + 1))

    @property
    def table(self) -> Array:
        """What depends on the crank angle alone, shape (rows, angles)."""
        return np.array(self._rows).reshape(len(self._rows), self.grid.degrees.size)

    def _level(self, level: int, needed: list[Value], made: set[int]) -> Level:
        above = [one for one in needed if one.kind in ("reduction", "delayed") and one.level == level + 1]
        columns = tuple({one.at: one for reduced in above for one in reduced.operands}.values())
        # what was kept for other angles is read at its own too
        kept = {of.at: of.graph.delayed(of, 0.0) for one in needed if one.kind == "delayed" for of in one.operands}
        kept = {at: one for at, one in kept.items() if one.level <= level}
        loops = tuple(self._loops(_replaced(list(columns), kept)))
        # with its laws chosen a product of a law and an area, say, is one of designs
        hoisted = [other for loop in loops for one in loop.values for other in one.operands if not other.by_angle]
        hoisted += [one for loop in loops for one in loop.columns if not one.by_angle]
        wanted = [one for one in needed if one.level == level and not one.by_angle]
        designs = [
            one
            for one in in_order([*wanted, *hoisted], into=lambda one: one.kind != "reduction")
            if one.kind not in ("constant", "reduction") and one.at not in made
        ]
        made.update(one.at for one in designs)
        reductions = tuple(one for one in above if one.kind == "reduction")
        delayed = tuple(one for one in above if one.kind == "delayed")
        return Level(tuple(designs), columns, loops, reductions, delayed)

    def _loops(self, columns: list[Value]) -> Iterable[Loop]:
        """Yield the loops over angles, one for each choice of laws that these columns follow."""
        if not columns:
            return
        used = [one for one in in_order(columns, into=_at_this_angle) if one.kind == "pieces"]
        panels: dict[tuple[Any, ...], list[int]] = {}
        for panel, middle in enumerate(self.grid.middles):
            is_moving = bool(self.grid.moves[panel])
            panels.setdefault((is_moving, *(self._laws_at(one, middle) for one in used)), []).append(panel)
        nodes = self.grid.nodes
        places = {of: np.flatnonzero(np.isin(self.grid.panel[:nodes], some)) for of, some in panels.items()}
        # a row of tables beside a jump follows the law that an analysis takes there, whichever ends the panel
        rows: dict[tuple[Any, ...], list[int]] = {}
        for at in range(nodes, self.grid.degrees.size):
            is_moving, degrees = bool(self.grid.moves[self.grid.panel[at]]), float(self.grid.degrees[at])
            rows.setdefault((is_moving, *(self._laws_at(one, degrees) for one in used)), []).append(at)
        for of in dict.fromkeys([*places, *rows]):
            is_moving, *laws = of
            angles = np.array([*places.get(of, ()), *rows.get(of, ())], dtype=np.intp)
            chosen = {one.at: law for one, law in zip(used, laws, strict=True)}
            resolved = self._with_laws(columns, chosen, is_moving=is_moving)
            roots = [resolved[one.at] for one in columns]
            if self._shares:
                roots = _replaced(roots, shared(roots, in_order(roots, into=_at_this_angle)))
                roots = _with_few_divisions(roots)
            every = list(in_order(roots, into=lambda one: one.by_design and _at_this_angle(one)))
            for one in every:
                if one.by_angle and not one.by_design and one.kind != "delayed":
                    self._put_in_table(one, angles)
            values = [one for one in every if one.by_angle and one.by_design]
            yield Loop(angles, tuple(values), tuple(roots))

    def _laws_at(self, value: Value, middle: float) -> tuple[int, int]:
        """Return the first and the last of the laws that may hold at a crank angle, of which designs choose."""
        ends, shift = value.detail
        at, last = middle + shift + self._turn(middle, shift), len(ends) - 1
        if self.grid.each:
            law = next((k for k, one in enumerate(ends) if at <= one.stated), last)
            return law, law
        first = max((k + 1 for k, one in enumerate(ends[:last]) if one.high < at), default=0)
        return first, next((k for k in range(first, last) if ends[k].low >= at), last)

    def _turn(self, middle: Any, shift: float) -> Any:  # noqa: ANN401 - of one angle or of many
        """Return what takes crank angles counted from elsewhere into the cycle, those of a panel all alike. [deg]"""
        own = middle + shift
        return np.mod(own - self.grid.start, self.grid.cycle) + self.grid.start - own if shift else 0.0

    def _with_laws(
        self, columns: Iterable[Value], chosen: Mapping[int, tuple[int, int]], *, is_moving: bool
    ) -> dict[int, Value]:
        """Return values by what they stand for, with the law of a panel in the place of pieces."""
        made: dict[int, Value] = {}
        for one in in_order(columns, into=_at_this_angle):
            if one.kind == "pieces":
                (ends, shift), (first, last) = one.detail, chosen[one.at]
                result = made[one.operands[last].at]
                for law in reversed(range(first, last)):
                    own = one.graph.angle("within", 1, shift)
                    end = ends[law].stated if ends[law].value is None else ends[law].value
                    result = one.graph.apply("choose", own - end, result, made[one.operands[law].at])
                made[one.at] = result
            elif one.kind == "angle" and is_moving:
                made[one.at] = self.moved.setdefault(one.at, one.graph.moved(one))
            elif one.by_angle and one.kind not in ("angle", "delayed"):
                operands = [made[other.at] for other in one.operands]
                made[one.at] = one.graph.apply(one.kind, *operands)
            else:
                made[one.at] = one
        return made

    def _put_in_table(self, value: Value, angles: NDArray[np.intp]) -> None:
        row = self.row_of_angle.get(value.at)
        if row is None:
            row = self.row_of_angle[value.at] = len(self._rows)
            self.of_angle.append(value)
            self._rows.append(np.zeros(self.grid.degrees.size))
        self._rows[row][angles] = self.function_of_angle(value, angles)

    def function_of_angle(self, value: Value, angles: NDArray[np.intp] | slice) -> Array:
        """Return what depends on the crank angle alone at some angles of the grid."""
        of = self.at([value], self.grid.degrees[angles], self.grid.middles[self.grid.panel[angles]])
        return np.asarray(of[value.at], dtype=float)

    def at(self, values: Iterable[Value], degrees: Array, middles: Array) -> dict[int, Any]:
        """Return what depends on the crank angle alone at angles, each in a panel with that middle. [deg]"""
        made: dict[int, Any] = {}
        angles = self._angles_at(degrees)
        for one in in_order(values):
            if one.kind == "constant":
                made[one.at] = number(one)
            elif one.kind != "angle":
                with np.errstate(all="ignore"):
                    made[one.at] = COMPUTE[one.kind](*(made[other.at] for other in one.operands))
            else:
                function, multiple, shift = one.detail
                own = degrees + shift + self._turn(middles, shift)
                match function:
                    case "within":
                        made[one.at] = own
                    case "reading":
                        made[one.at] = np.asarray(one.graph.functions[multiple](own), dtype=float)
                    case _:
                        made[one.at] = getattr(angles.multiple(multiple).shifted(shift), function)
        return made


def _at_this_angle(value: Value) -> bool:
    """Return whether what a value is made of is wanted at the same crank angle."""
    return value.by_angle and value.kind != "delayed"


def _with_few_divisions(roots: list[Value]) -> list[Value]:
    """Return values in which reciprocals that do not wait for each other come from one division.

    1 / a and 1 / b are b and a times 1 / (a b): a division takes as long as a dozen products.
    """
    while True:
        every = [one for one in in_order(roots, into=_at_this_angle) if one.by_angle and one.by_design]
        divided = [one for one in every if one.kind == "div"]
        pair = next(
            ((one, other) for at, one in enumerate(divided) for other in divided[at + 1 :] if not _needs(other, one)),
            None,
        )
        if pair is None:
            return roots
        (one, a), (other, b) = ((each, each.operands[1]) for each in pair)
        both = one.graph.apply("div", 1.0, a * b)
        roots = _replaced(roots, {one.at: b * both, other.at: a * both})


def _needs(value: Value, other: Value) -> bool:
    return any(one is other for one in in_order([value], into=_at_this_angle))


def _replaced(roots: list[Value], by: dict[int, Value]) -> list[Value]:
    """Return values with others in the place of some."""
    made = dict(by)
    for one in in_order(roots, into=lambda one: one.at not in by and _at_this_angle(one)):
        if one.at not in made:
            is_made_anew = _at_this_angle(one) and any(made[other.at] is not other for other in one.operands)
            operands = tuple(made[other.at] for other in one.operands) if is_made_anew else ()
            if is_made_anew and one.kind == "pieces":
                ends, shift = one.detail
                made[one.at] = one.graph.pieces(ends, operands, shift)
            else:
                made[one.at] = one.graph.apply(one.kind, *operands) if is_made_anew else one
    return [made[one.at] for one in roots]
