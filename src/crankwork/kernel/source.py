"""The source of a kernel: straight lines of operations in loops over crank angles and designs.

Everything of a design stands in one store of rows, one lane for each design of a block, so that what a row holds can
be told from every other row and a loop over lanes becomes operations on several at once. Two lanes are written side by
side: what one waits for leaves room for the other.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from textwrap import indent
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import Value, number
from crankwork.kernel.plan import Level, Loop, Plan

# designs of a block: more where arrays go on with what is kept of them, fewer where that is to stay near
LANES, _NEAR_LANES = 64, 32
# what others wait for
_SLOW = ("sqrt", "div", "exp", "log", "log_ratio")
# rows that a loop may read in the places of others and still be turned into operations on several designs at once
_FEW_ROWS = 12
_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
_CALLED = {
    "sqrt": "math.sqrt", "exp": "exp", "log": "log", "log_ratio": "log_ratio", "sin": "math.sin", "cos": "math.cos",
    "tan": "math.tan", "arcsin": "math.asin", "arccos": "math.acos", "arctan": "math.atan", "half_turns": "half_turns",
}  # fmt: skip
_HEAD = """import math

import numpy as np

from crankwork.kernel.elementary import compiled, exp, half_turns, inside, log, log_ratio
"""
_RUN = """@compiled
def run(given, results, left_out, t, p, order, weights, degrees, first):
    s = np.empty({rows} * {lanes})
    b = np.empty(({columns}, {angles}, {lanes}))
    count = given.shape[1]
    for start in range(0, count, {lanes}):
        for row in range(given.shape[0]):
            for l in range({lanes}):
                s[row * {lanes} + l] = given[row, min(start + l, count - 1)]
{levels}
        for l in range(min({lanes}, count - start)):
{outputs}"""
_ARGUMENTS = "s, b, t, p, order, weights, degrees"
# what a reduction is before the first angle
_START = {"max": "-math.inf", "min": "math.inf"}


Thing = TypeVar("Thing", bound=Hashable)
# reductions that can be done as the angles go by
_WORKS = ("range", "tangents")
RUNNING = ("max", "min", "max_angle", "min_angle", "mean", "integral", *_WORKS)
# Under what a value of a design is stored: a reduction of columns, an input, any other by its place in the graph.
Place = tuple[str, *tuple[int, ...]] | int


class Rows(Generic[Thing]):
    """Which row of a store each thing has."""

    def __init__(self) -> None:
        self.of: dict[Thing, int] = {}

    def __call__(self, key: Thing) -> int:
        """Return the row of something, a new one where it has none."""
        return self.of.setdefault(key, len(self.of))


class Source:
    """A plan written out: a function for each level, and one that runs them for many designs.

    `rows` are those of the store of a block of designs, `columns` those of what is kept at each angle, `delays` those
    of the places of earlier angles, `order` the places of angles loop by loop, `used` what of designs is stored.
    The first `given` rows are what designs state and what follows of that alone, done for many of them by arrays: in
    a cycle that is calculated these are hundreds of lines, each done once, and compiling them takes longer than that.
    With `is_reduced` reductions are done as the angles go by; otherwise their columns are kept, and something else
    reduces them.
    """

    def __init__(self, plan: Plan, *, is_reduced: bool) -> None:
        self.plan, self.is_reduced = plan, is_reduced
        self.lanes = _NEAR_LANES if is_reduced else LANES
        self.rows, self.columns, self.delays = Rows[Place](), Rows[int](), Rows[float]()
        self.order: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        for at in range(plan.inputs):
            self.rows(("input", at))
        self.used = self._used_elsewhere()
        for one in plan.levels[0].designs:
            if one.at in self.used and one.kind != "input":
                self.rows(one.at)
        self.given = len(self.rows.of)
        for one in (one for level in plan.levels for one in (*level.delayed, *level.reductions)):
            if one.kind == "reduction":
                self.rows(self.place(one))
            if not is_reduced or one.kind == "delayed" or one.detail in _WORKS:
                for column in one.operands:
                    self.columns(column.at)
        for at in plan.moved:
            self.columns(at)
        self.text = "\n\n\n".join([_HEAD, *self._functions()]) + "\n"

    def place(self, value: Value) -> Place:
        """Return under what a value of a design is stored."""
        match value.kind:
            case "reduction":
                return value.detail, *(one.at for one in value.operands)
            case "input":
                return "input", value.detail
        return value.at

    def _used_elsewhere(self) -> set[int]:
        """Return which values of designs are used outside the lines that make them."""
        used = {one.at for one in (*self.plan.outputs.values(), *self.plan.ends)}
        for level in self.plan.levels:
            used.update(other.at for other in _taken(level.designs))
            used.update(other.at for loop in level.loops for other in _taken(loop.values, loop.columns))
        return used

    def _stored(self, key: Place, lane: str = "l") -> str:
        return f"s[{self.rows(key) * self.lanes} + {lane}]"

    def _functions(self) -> Iterator[str]:
        """Yield one function for each loop; and what calls them, one for each step, or one that runs all."""
        steps = dict[str, list[str]]()
        for at, level in enumerate(self.plan.levels):
            running = self._running(level) if self.is_reduced else []
            calls = []
            for kind, (lines, of) in enumerate(self._kinds(level, running).items()):
                # a function of its own: names that had a meaning in each loop would be told apart one by one
                rows = [f"        row_{row} = parts[part][{row + 2}]" for row in range(len(of[0]) - 2)]
                head = f"@inside\ndef loop_{at}_{kind}({_ARGUMENTS}, parts):\n    for part in range(len(parts)):"
                yield "\n".join([head, *rows, lines])
                calls.append(f"    loop_{at}_{kind}({_ARGUMENTS}, {tuple(map(tuple, of))})")
            if at:
                # those of the first level are given
                steps[f"designs_{at}"] = list(self._over_lanes(4, lambda lane: self._designs(level, lane), "l"))  # noqa: B023
            steps[f"level_{at}"] = [*self._begun(running), *calls, *self._ended(level, running)]
        if self.is_reduced:
            yield self._run(indent("\n".join(line for step in steps.values() for line in step), "    "))
            return
        for name, step in steps.items():
            yield "\n".join([f"@compiled\ndef {name}({_ARGUMENTS}):", *step, "    return"])

    def _run(self, levels: str) -> str:
        outputs, place = [], "first + start + l"
        for at, (key, value) in enumerate(self.plan.outputs.items()):
            shown = _name(value, "") if value.is_constant else self._stored(self.place(value))
            outputs.append(f"            {f'results[{at}, {place}]' if key else f'left_out[{place}]'} = {shown}")
        angles = self.plan.grid.degrees.size if self.columns.of else 1
        sizes = {
            "rows": len(self.rows.of),
            "columns": max(len(self.columns.of), 1),
            "angles": angles,
            "lanes": self.lanes,
        }
        return _RUN.format(levels=levels, outputs="\n".join(outputs), **sizes)

    def _kinds(self, level: Level, running: list[tuple[tuple[str, int], str, Value]]) -> dict[str, list[list[int]]]:
        """Return what is done in loops, and for each that does it its angles and the rows that it reads."""
        parts = dict[str, list[list[int]]]()
        for loop in level.loops:
            lines, rows = self._lines(level, loop, running)
            start = self.order.size
            self.order = np.concatenate([self.order, loop.angles])
            parts.setdefault(lines, []).append([start, self.order.size, *rows])
        return parts

    def _begun(self, running: list[tuple[tuple[str, int], str, Value]]) -> Iterator[str]:
        if running:
            first = [f"{self._stored(place)} = {_START.get(word, '0.0')}" for place, word, _ in running]
            yield from self._over_lanes(4, lambda _: first, "l")

    def _ended(self, level: Level, running: list[tuple[tuple[str, int], str, Value]]) -> Iterator[str]:
        for place, word, _ in running:
            yield from self._finished(place, word)
        for one in level.reductions if self.is_reduced else ():
            if one.detail in _WORKS:
                yield from self._range(one)

    def _designs(self, level: Level, lane: str) -> Iterator[str]:
        yield "pass"
        yield from self._taken_lines(_taken(level.designs), lane)
        for one in level.designs:
            made = self._stored(self.place(one), lane) if one.kind == "input" else self._expression(one, lane)
            yield f"{lane}{one.at} = {made}"
            if one.at in self.used and one.kind != "input":
                yield f"{self._stored(one.at, lane)} = {lane}{one.at}"

    def _taken_lines(self, values: Iterable[Value], lane: str) -> Iterator[str]:
        for one in values:
            if not one.by_angle:
                yield f"{lane}{one.at} = {self._stored(self.place(one), lane)}"

    def _running(self, level: Level) -> list[tuple[tuple[str, int], str, Value]]:
        """Return what reductions keep while the angles go by: where, what, of which column.

        A place stands before its value: where it is decided whether the place changes the value must be the old one.
        """
        found: dict[tuple[str, int], tuple[str, Value]] = {}
        for one in level.reductions:
            column, word = one.operands[0], one.detail
            if word.endswith("_angle"):
                found[word, column.at] = word, column
                word = word.removesuffix("_angle")
            elif word in _WORKS:
                word = "mean"
            found[word, column.at] = word, column
        every = ((place, word, column) for place, (word, column) in found.items())
        return sorted(every, key=lambda one: not one[1].endswith("_angle"))

    def _lines(
        self, level: Level, loop: Loop, running: list[tuple[tuple[str, int], str, Value]]
    ) -> tuple[str, list[int]]:
        """Return what is done in a loop, and the rows that it reads if others of its kind read theirs."""
        if not running:
            lines, rows = _shape("\n".join(self._loop(level, loop, running, ("l",))))
            if len(rows) <= _FEW_ROWS:
                return lines, rows
        # two lanes side by side where one waits
        lanes = self._lanes if any(one.kind in _SLOW for one in loop.values) else ("l",)
        return "\n".join(self._loop(level, loop, running, lanes)), []

    @property
    def _lanes(self) -> tuple[str, ...]:
        """Lanes written side by side, two where every moment counts."""
        return ("l", "h") if self.is_reduced else ("l",)

    def _loop(
        self, level: Level, loop: Loop, running: list[tuple[tuple[str, int], str, Value]], lanes: tuple[str, ...]
    ) -> Iterator[str]:
        yield "        for i in range(parts[part][0], parts[part][1]):"
        yield "            j = order[i]"
        if any(word in ("mean", "integral") for _, word, _ in running):
            yield "            weight = weights[j]"
        taken = _taken(loop.values, loop.columns)
        for one in taken:
            if one.by_angle and not one.by_design:
                yield f"            t{one.at} = t[{self.plan.row_of_angle[one.at]}, j]"
        yield from self._read(loop)
        value_of = dict(zip((one.at for one in level.columns), loop.columns, strict=True))
        kept = [at for at in value_of if at in self.columns.of]
        for at in kept:
            yield f"            c{at} = b[{self.columns(at)}, j]"

        def lines(lane: str) -> Iterator[str]:
            yield from self._taken_lines(taken, lane)
            for one in loop.values:
                is_read = one.kind in ("delayed", "moved")
                made = f"b{one.at}[{lane}]" if is_read else self._expression(one, lane)
                yield f"{lane}{one.at} = {made}"
            for at in kept:
                yield f"c{at}[{lane}] = {_name(value_of[at], lane)}"
            for place, word, column in running:
                yield self._step(place, word, _name(value_of[column.at], lane), lane)

        yield from self._over_lanes(12, lines, lanes)

    def _read(self, loop: Loop) -> Iterator[str]:
        """Yield where columns stand that were kept before."""
        for one in loop.values:
            if one.kind == "delayed":
                yield f"            b{one.at} = b[{self.columns(one.operands[0].at)}, p[{self.delays(one.detail)}, j]]"
            elif one.kind == "moved":
                yield f"            b{one.at} = b[{self.columns(one.detail.at)}, j]"

    def _step(self, place: tuple[str, int], word: str, value: str, lane: str) -> str:
        """Return how a reduction goes on with the value at an angle."""
        stored = self._stored(place, lane)
        if word in ("mean", "integral"):
            return f"{stored} += {value} * weight"
        best, sign = self._stored((word.removesuffix("_angle"), place[1]), lane), ">" if word.startswith("max") else "<"
        return f"{stored} = {'j' if word.endswith('_angle') else value} if {value} {sign} {best} else {stored}"

    def _finished(self, place: tuple[str, int], word: str) -> Iterator[str]:
        stored = self._stored(place)
        if word == "mean":
            yield f"    for l in range({self.lanes}):\n        {stored} /= {float(np.radians(self.plan.grid.cycle))!r}"
        elif word.endswith("_angle"):
            yield f"    for l in range({self.lanes}):\n        {stored} = math.radians(degrees[int({stored})])"

    def _range(self, one: Value) -> Iterator[str]:
        """Yield how far the integral of a column about its mean goes up and down, or what tangents cut off of it."""
        at, angles, word = one.operands[0].at, self.plan.grid.degrees.size, one.detail
        place = word, *(operand.at for operand in one.operands)
        mean = self._stored(("mean", at))
        high, low, work = (self._stored(other) for other in (place, ("low", *place), ("work", *place)))
        columns = ["c", "inertia", "upper", "lower"][: len(one.operands)]
        above, below = work, work
        if word == "tangents":
            above, below = (f"-{work} - {slope}[j][l] * inertia[j][l]" for slope in ("upper", "lower"))
        for name, column in zip(columns, one.operands, strict=True):
            yield f"    {name} = b[{self.columns(column.at)}]"
        yield f"    for l in range({self.lanes}):"
        yield f"        {low}, {high}, {work} = math.inf, -math.inf, 0.0"
        yield f"    for j in range({angles}):"
        yield f"        before, after = c[j], c[(j + 1) % {angles}]"
        yield f"        for l in range({self.lanes}):"
        yield f"            above, below = {above}, {below}"
        yield f"            {low} = below if below < {low} else {low}"
        yield f"            {high} = above if above > {high} else {high}"
        yield f"            {work} += ((before[l] + after[l]) / 2 - {mean}) * weights[j]"
        yield f"    for l in range({self.lanes}):"
        yield f"        {high} -= {low}"

    def _over_lanes(self, indent: int, lines: Callable[[str], Iterable[str]], lanes: Sequence[str]) -> Iterator[str]:
        """Yield a loop over lanes."""
        space = " " * indent
        yield f"{space}for l in range({self.lanes // len(lanes)}):"
        if "h" in lanes:
            yield f"{space}    h = l + {self.lanes // 2}"
        for together in zip(*map(lines, lanes), strict=True):
            yield from (f"{space}    {line}" for line in together)

    def _expression(self, one: Value, lane: str) -> str:
        operands = [_name(other, lane) for other in one.operands]
        if one.kind in _INFIX:
            return f"{operands[0]} {_INFIX[one.kind]} {operands[1]}"
        if one.kind == "choose":
            return f"{operands[1]} if {operands[0]} > 0.0 else {operands[2]}"
        return f"-{operands[0]}" if one.kind == "neg" else f"{_CALLED[one.kind]}({', '.join(operands)})"


def _shape(lines: str) -> tuple[str, list[int]]:
    """Return lines with names by the order in which they are met, and the rows of designs and of angles they read.

    What is done with each law of a kind is one function then. A loop that reduces keeps its rows, because what it
    writes must be told from what it reads, and so does one that reads many.
    """
    names, rows = dict[str, str](), dict[str, str]()
    lines = re.sub(r"\b([lhtbc])(\d+)\b", lambda one: one[1] + names.setdefault(one[2], str(len(names))), lines)
    for place in (r"(?<=\bs\[)\d+(?= \+ l\])", r"(?<=\bt\[)\d+(?=, j\])"):
        lines = re.sub(place, lambda one: rows.setdefault(one[0], f"row_{len(rows)}"), lines)
    return lines, [int(one) for one in rows]


def _taken(values: Iterable[Value], others: Iterable[Value] = ()) -> list[Value]:
    """Return what values, and others beside them, are made of that is made elsewhere."""
    made = {one.at for one in values}
    operands = [other for one in values if one.kind not in ("delayed", "input") for other in one.operands]
    taken = {one.at: one for one in (*operands, *others) if one.at not in made and not one.is_constant}
    return list(taken.values())


def _name(value: Value, lane: str) -> str:
    if value.is_constant:
        return repr(number(value)).replace("inf", "math.inf").replace("nan", "math.nan")
    return f"t{value.at}" if value.by_angle and not value.by_design else f"{lane}{value.at}"
