"""The source of a kernel: operations without branches in loops over crank angles and designs.

All values of a block of designs are in one store of rows, one lane for each design, so that the compiler can see that
rows do not overlap and vectorises loops over lanes. Two lanes are written alternately, so that one fills the waiting
time of the other.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from textwrap import indent
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import KernelValue, number
from crankwork.kernel.schedule import Level, Loop, Schedule

# designs of a block: more if arrays process the stored columns, fewer if these are to stay in the cache
LANES, _NEAR_LANES = 64, 32
# operations with a long latency
_SLOW = ("sqrt", "div", "exp", "log", "log_ratio")
# largest number of parameters for rows with which the compiler still vectorises a loop
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
# initial value of a reduction
_START = {"max": "-math.inf", "min": "math.inf"}


Thing = TypeVar("Thing", bound=Hashable)
# reductions that can be accumulated over the angles
_WORKS = ("range", "tangents")
ACCUMULATED = ("max", "min", "max_angle", "min_angle", "mean", "integral", *_WORKS)
# Key of a stored design value: a reduction of columns, an input, any other by its index in the graph.
Place = tuple[str, *tuple[int, ...]] | int


class Rows(Generic[Thing]):
    """Assigns each key a row of a store."""

    def __init__(self) -> None:
        self.of: dict[Thing, int] = {}

    def __call__(self, key: Thing) -> int:
        """Return the row of a key, a new one if it has none."""
        return self.of.setdefault(key, len(self.of))


class Source:
    """A schedule as Python source: a function for each level, and one that runs them for many designs.

    `rows`: of the store of a block of designs; `columns`: of the columns stored at each angle; `delays`: of the indices
    of earlier angles; `order`: the indices of angles loop by loop; `used`: the design values that are stored. The first
    `given` rows are inputs and what follows from them alone, calculated by arrays for many designs: a calculated cycle
    has hundreds of such lines, whose compilation takes longer than that. With `is_reduced` reductions are accumulated
    in the loops; otherwise their columns are stored, and reduced elsewhere.
    """

    def __init__(self, plan: Schedule, *, is_reduced: bool) -> None:
        self.plan, self.is_reduced = plan, is_reduced
        self.lanes = _NEAR_LANES if is_reduced else LANES
        self.rows, self.columns, self.delays = Rows[Place](), Rows[int](), Rows[float]()
        self.order: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        for index in range(plan.inputs):
            self.rows(("input", index))
        self.used = self._used_elsewhere()
        for value in plan.levels[0].designs:
            if value.index in self.used and value.kind != "input":
                self.rows(value.index)
        self.given = len(self.rows.of)
        for value in (value for level in plan.levels for value in (*level.delayed, *level.reductions)):
            if value.kind == "reduction":
                self.rows(self.place(value))
            if not is_reduced or value.kind == "delayed" or value.detail in _WORKS:
                for column in value.operands:
                    self.columns(column.index)
        for index in plan.moved:
            self.columns(index)
        self.text = "\n\n\n".join([_HEAD, *self._functions()]) + "\n"

    def place(self, value: KernelValue) -> Place:
        """Return the key under which a design value is stored."""
        match value.kind:
            case "reduction":
                return value.detail, *(operand.index for operand in value.operands)
            case "input":
                return "input", value.detail
        return value.index

    def _used_elsewhere(self) -> set[int]:
        """Return the design values that are used outside the function that calculates them."""
        used = {value.index for value in (*self.plan.outputs.values(), *self.plan.ends)}
        for level in self.plan.levels:
            used.update(operand.index for operand in _external_operands(level.designs))
            for loop in level.loops:
                used.update(operand.index for operand in _external_operands(loop.values, loop.columns))
        return used

    def _stored(self, key: Place, lane: str = "l") -> str:
        return f"s[{self.rows(key) * self.lanes} + {lane}]"

    def _functions(self) -> Iterator[str]:
        """Yield one function for each loop, and those that call them: one for each step, or one that runs all."""
        steps = dict[str, list[str]]()
        for index, level in enumerate(self.plan.levels):
            running = self._running(level) if self.is_reduced else []
            calls = []
            for kind, (lines, parts) in enumerate(self._kinds(level, running).items()):
                # functions of their own: the compiler would rename the names that all loops share one by one
                rows = [f"        row_{row} = parts[part][{row + 2}]" for row in range(len(parts[0]) - 2)]
                head = f"@inside\ndef loop_{index}_{kind}({_ARGUMENTS}, parts):\n    for part in range(len(parts)):"
                yield "\n".join([head, *rows, lines])
                calls.append(f"    loop_{index}_{kind}({_ARGUMENTS}, {tuple(map(tuple, parts))})")
            if index:
                # those of the first level are given
                steps[f"designs_{index}"] = list(self._over_lanes(4, lambda lane: self._designs(level, lane), "l"))  # noqa: B023
            steps[f"level_{index}"] = [*self._begun(running), *calls, *self._ended(level, running)]
        if self.is_reduced:
            yield self._run(indent("\n".join(line for step in steps.values() for line in step), "    "))
            return
        for name, step in steps.items():
            yield "\n".join([f"@compiled\ndef {name}({_ARGUMENTS}):", *step, "    return"])

    def _run(self, levels: str) -> str:
        outputs, place = [], "first + start + l"
        for index, (key, value) in enumerate(self.plan.outputs.items()):
            shown = _name(value, "") if value.is_constant else self._stored(self.place(value))
            outputs.append(f"            {f'results[{index}, {place}]' if key else f'left_out[{place}]'} = {shown}")
        angles = self.plan.grid.degrees.size if self.columns.of else 1
        sizes = {"rows": len(self.rows.of), "columns": max(len(self.columns.of), 1), "angles": angles}
        return _RUN.format(levels=levels, outputs="\n".join(outputs), lanes=self.lanes, **sizes)

    def _kinds(
        self, level: Level, running: list[tuple[tuple[str, int], str, KernelValue]]
    ) -> dict[str, list[list[int]]]:
        """Return the bodies of loops, and for each body the angles and rows of the loops that have it."""
        parts = dict[str, list[list[int]]]()
        for loop in level.loops:
            lines, rows = self._lines(level, loop, running)
            start = self.order.size
            self.order = np.concatenate([self.order, loop.angles])
            parts.setdefault(lines, []).append([start, self.order.size, *rows])
        return parts

    def _begun(self, running: list[tuple[tuple[str, int], str, KernelValue]]) -> Iterator[str]:
        if running:
            first = [f"{self._stored(place)} = {_START.get(word, '0.0')}" for place, word, _ in running]
            yield from self._over_lanes(4, lambda _: first, "l")

    def _ended(self, level: Level, running: list[tuple[tuple[str, int], str, KernelValue]]) -> Iterator[str]:
        for place, word, _ in running:
            yield from self._finished(place, word)
        for value in level.reductions if self.is_reduced else ():
            if value.detail in _WORKS:
                yield from self._range(value)

    def _designs(self, level: Level, lane: str) -> Iterator[str]:
        yield "pass"
        yield from self._reads(_external_operands(level.designs), lane)
        for value in level.designs:
            is_input = value.kind == "input"
            result = self._stored(self.place(value), lane) if is_input else self._expression(value, lane)
            yield f"{lane}{value.index} = {result}"
            if value.index in self.used and not is_input:
                yield f"{self._stored(value.index, lane)} = {lane}{value.index}"

    def _reads(self, values: Iterable[KernelValue], lane: str) -> Iterator[str]:
        for value in values:
            if not value.depends_on_angle:
                yield f"{lane}{value.index} = {self._stored(self.place(value), lane)}"

    def _running(self, level: Level) -> list[tuple[tuple[str, int], str, KernelValue]]:
        """Return the accumulators of reductions: key, kind, column.

        An angle comes before its value: whether it changes depends on the old value.
        """
        accumulators: dict[tuple[str, int], tuple[str, KernelValue]] = {}
        for value in level.reductions:
            column, word = value.operands[0], value.detail
            if word.endswith("_angle"):
                accumulators[word, column.index] = word, column
                word = word.removesuffix("_angle")
            elif word in _WORKS:
                word = "mean"
            accumulators[word, column.index] = word, column
        rows = ((place, word, column) for place, (word, column) in accumulators.items())
        return sorted(rows, key=lambda row: not row[1].endswith("_angle"))

    def _lines(
        self, level: Level, loop: Loop, running: list[tuple[tuple[str, int], str, KernelValue]]
    ) -> tuple[str, list[int]]:
        """Return the body of a loop, and the rows that it reads if equal bodies differ in them."""
        if not running:
            lines, rows = _shape("\n".join(self._loop(level, loop, running, ("l",))))
            if len(rows) <= _FEW_ROWS:
                return lines, rows
        # two lanes alternate if one waits, where the source is optimised for speed
        lanes = ("l", "h") if self.is_reduced and any(value.kind in _SLOW for value in loop.values) else ("l",)
        return "\n".join(self._loop(level, loop, running, lanes)), []

    def _loop(
        self, level: Level, loop: Loop, running: list[tuple[tuple[str, int], str, KernelValue]], lanes: tuple[str, ...]
    ) -> Iterator[str]:
        yield "        for i in range(parts[part][0], parts[part][1]):"
        yield "            j = order[i]"
        if any(word in ("mean", "integral") for _, word, _ in running):
            yield "            weight = weights[j]"
        external = _external_operands(loop.values, loop.columns)
        for value in external:
            if value.depends_on_angle and not value.depends_on_design:
                yield f"            t{value.index} = t[{self.plan.row_of_angle[value.index]}, j]"
        yield from self._read(loop)
        value_of = dict(zip((column.index for column in level.columns), loop.columns, strict=True))
        stored = [index for index in value_of if index in self.columns.of]
        for index in stored:
            yield f"            c{index} = b[{self.columns(index)}, j]"

        def lines(lane: str) -> Iterator[str]:
            yield from self._reads(external, lane)
            for value in loop.values:
                is_read = value.kind in ("delayed", "moved")
                result = f"b{value.index}[{lane}]" if is_read else self._expression(value, lane)
                yield f"{lane}{value.index} = {result}"
            for index in stored:
                yield f"c{index}[{lane}] = {_name(value_of[index], lane)}"
            for place, word, column in running:
                yield self._step(place, word, _name(value_of[column.index], lane), lane)

        yield from self._over_lanes(12, lines, lanes)

    def _read(self, loop: Loop) -> Iterator[str]:
        """Yield references to stored columns."""
        for value in loop.values:
            if value.kind == "delayed":
                column, delay = self.columns(value.operands[0].index), self.delays(value.detail)
                yield f"            b{value.index} = b[{column}, p[{delay}, j]]"
            elif value.kind == "moved":
                yield f"            b{value.index} = b[{self.columns(value.detail.index)}, j]"

    def _step(self, place: tuple[str, int], word: str, value: str, lane: str) -> str:
        """Return the update of an accumulator with the value at an angle."""
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

    def _range(self, value: KernelValue) -> Iterator[str]:
        """Yield the range of the integral of a column about its mean, or what tangents cut off of it."""
        angles, word = self.plan.grid.degrees.size, value.detail
        at = tuple(operand.index for operand in value.operands)
        high, low, work = (self._stored((name, *at)) for name in (word, f"{word}_low", f"{word}_work"))
        mean = self._stored(("mean", at[0]))
        above, below = work, work
        if word == "tangents":
            above, below = (f"-{work} - {slope}[j][l] * inertia[j][l]" for slope in ("upper", "lower"))
        for name, index in zip(("c", "inertia", "upper", "lower"), at, strict=False):
            yield f"    {name} = b[{self.columns(index)}]"
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

    def _expression(self, value: KernelValue, lane: str) -> str:
        operands = [_name(operand, lane) for operand in value.operands]
        if value.kind in _INFIX:
            return f"{operands[0]} {_INFIX[value.kind]} {operands[1]}"
        if value.kind == "choose":
            return f"{operands[1]} if {operands[0]} > 0.0 else {operands[2]}"
        return f"-{operands[0]}" if value.kind == "neg" else f"{_CALLED[value.kind]}({', '.join(operands)})"


def _shape(lines: str) -> tuple[str, list[int]]:
    """Return lines with names numbered in order of appearance, and the rows of designs and angles that they read.

    Laws of one kind share a function this way. A loop that reduces keeps its rows, because the compiler must see that
    it reads and writes different rows, and so does one that reads many.
    """
    names, rows = dict[str, str](), dict[str, str]()
    lines = re.sub(r"\b([lhtbc])(\d+)\b", lambda match: match[1] + names.setdefault(match[2], str(len(names))), lines)
    for place in (r"(?<=\bs\[)\d+(?= \+ l\])", r"(?<=\bt\[)\d+(?=, j\])"):
        lines = re.sub(place, lambda match: rows.setdefault(match[0], f"row_{len(rows)}"), lines)
    return lines, [int(row) for row in rows]


def _external_operands(values: Iterable[KernelValue], columns: Iterable[KernelValue] = ()) -> list[KernelValue]:
    """Return columns and the operands of values that are calculated outside this function."""
    done = {value.index for value in values}
    operands = [operand for value in values if value.kind not in ("delayed", "input") for operand in value.operands]
    external = (value for value in (*operands, *columns) if value.index not in done and not value.is_constant)
    return list({value.index: value for value in external}.values())


def _name(value: KernelValue, lane: str) -> str:
    if value.is_constant:
        return repr(number(value)).replace("inf", "math.inf").replace("nan", "math.nan")
    return f"t{value.index}" if value.depends_on_angle and not value.depends_on_design else f"{lane}{value.index}"
