"""A schedule as JavaScript: a module within a page, and its numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby, pairwise
from typing import Any

import numpy as np

from crankwork.kernel.graph import KernelValue, in_order, number
from crankwork.kernel.grid import Polynomials
from crankwork.kernel.python_source import Source
from crankwork.kernel.schedule import Level, Loop

_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
_CALLED = {
    "sqrt": "sqrt", "exp": "exp", "log": "log", "sin": "sin", "cos": "cos", "tan": "tan", "arcsin": "asin",
    "arccos": "acos", "arctan": "atan",
}  # fmt: skip
# decimals of directions that only half turns are counted from [rad]
_ROUGH = 2
# first letters of names
_LETTERS = 26


class Script:
    """A schedule in the layout of its source, for one design at a time.

    `text`: the program; `data`: crank angles, their functions, and the layout of its stores.
    """

    def __init__(self, source: Source, polynomials: Polynomials) -> None:
        self._source, self._plan = source, source.plan
        # consecutive constants are declared together
        self.text = "".join(_joined(self._lines()))
        self.data = self._numbers(polynomials)

    def _numbers(self, polynomials: Polynomials) -> dict[str, Any]:
        source, grid = self._source, self._plan.grid
        earlier = [grid.earlier(delay) for delay in source.delays.of]
        outputs = self._plan.outputs
        return {
            "edges": grid.edges.tolist(),
            "nodes": polynomials.nodes.tolist(),
            "weights": polynomials.weights.tolist(),
            "rows": grid.degrees[grid.nodes :].tolist(),
            "order": _differences(source.order),
            "earlier": [_differences(indices) for indices in earlier if indices is not None],
            "angles": [self._of_angle(leaf) for leaf in self._leaves()],
            "sizes": [len(source.rows.of), len(source.columns.of), len(self._plan.of_angle)],
            "values": {
                key: source.rows(source.place(value)) for key, value in outputs.items() if value.detail != "column"
            },
            "columns": {
                key: source.columns(value.operands[0].index)
                for key, value in outputs.items()
                if value.detail == "column"
            },
            "reductions": [[self._reduction(value) for value in _reduced(level)] for level in self._plan.levels],
        }  # fmt: skip

    def _leaves(self) -> list[KernelValue]:
        return [value for value in in_order(self._plan.of_angle) if value.kind == "angle"]

    def _of_angle(self, leaf: KernelValue) -> list[Any]:
        """Return the name of a function of the crank angle, or its numbers if it has no name."""
        function, multiple, shift = leaf.detail
        if function == "within" and not shift:
            function = "degrees"
        if function not in ("reading", "within"):
            return [function, multiple, shift]
        values = self._plan.function_of_angle(leaf, slice(None))
        values_of_loops = (value for level in self._plan.levels for loop in level.loops for value in loop.values)
        users = {value.kind for value in values_of_loops if leaf in value.operands}
        numbers: list[Any] = (np.round(values, _ROUGH) if users == {"half_turns"} else values).tolist()
        return numbers

    def _reduction(self, value: KernelValue) -> list[Any]:
        columns = [self._source.columns(column.index) for column in value.operands]
        # a root has a corner where it is 0, and its square is smooth
        is_root, row = value.operands[0].kind == "sqrt", self._source.rows(self._source.place(value))
        return [f"{value.detail} root" if is_root else value.detail, row, *columns]

    def _lines(self) -> Iterator[str]:
        yield "var steps={table(q,t,n){for(let j=0;j<n;j+=1){"
        leaves = self._leaves()
        for row, leaf in enumerate(leaves):
            yield f"const {_name(leaf)}=q[{row}][j];"
        for value in in_order(self._plan.of_angle):
            if value.kind not in ("angle", "constant"):
                yield f"const {_name(value)}={_expression(value)};"
        for row, value in enumerate(self._plan.of_angle):
            yield f"t[{row}*n+j]={_name(value)};"
        yield "}},levels:["
        start = 0
        for level in self._plan.levels:
            yield "{designs(s){"
            yield from self._designs(level)
            yield "},loops:["
            for loop in level.loops:
                yield "(s,t,b,p,o,n)=>{"
                yield from self._loop(level, loop, start)
                yield "},"
                start += loop.angles.size
            yield "]},"
        yield "]};"

    def _designs(self, level: Level) -> Iterator[str]:
        source = self._source
        done = {value.index for value in level.designs}
        operands = (operand for value in level.designs if value.kind != "input" for operand in value.operands)
        yield from self._read(operand for operand in operands if operand.index not in done)
        for value in level.designs:
            result = f"s[{source.rows(source.place(value))}]" if value.kind == "input" else _expression(value)
            yield f"const {_name(value)}={result};"
            if value.index in source.used and value.kind != "input":
                yield f"s[{source.rows(value.index)}]={_name(value)};"

    def _loop(self, level: Level, loop: Loop, start: int) -> Iterator[str]:
        source, plan = self._source, self._plan
        done = {value.index for value in loop.values}
        operands = [operand for value in loop.values if value.kind != "delayed" for operand in value.operands]
        external = {
            value.index: value
            for value in (*operands, *loop.columns)
            if value.index not in done and not value.is_constant
        }
        yield from self._read(value for value in external.values() if not value.depends_on_angle)
        yield f"for(let i={start};i<{start + loop.angles.size};i+=1){{const j=o[i];"
        for value in external.values():
            if value.depends_on_angle:
                yield f"const {_name(value)}=t[{plan.row_of_angle[value.index]}*n+j];"
        for value in loop.values:
            if value.kind == "delayed":
                place = f"p[{source.delays(value.detail)}][j]"
                yield f"const {_name(value)}=b[{source.columns(value.operands[0].index)}*n+{place}];"
            else:
                yield f"const {_name(value)}={_expression(value)};"
        for column, value in zip(level.columns, loop.columns, strict=True):
            yield f"b[{source.columns(column.index)}*n+j]={_name(value)};"
        yield "}"

    def _read(self, values: Iterable[KernelValue]) -> Iterator[str]:
        for value in {value.index: value for value in values if not value.is_constant}.values():
            yield f"const {_name(value)}=s[{self._source.rows(self._source.place(value))}];"


def _reduced(level: Level) -> list[KernelValue]:
    return [value for value in level.reductions if value.detail != "column"]


def _joined(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines, with consecutive constants joined to one declaration."""
    for is_constant, group in groupby(lines, lambda line: line.startswith("const ")):
        if is_constant:
            yield f"const {','.join(line[len('const ') : -1] for line in group)};"
        else:
            yield from group


def _differences(numbers: Any) -> list[int]:  # noqa: ANN401 - integers
    """Return integers as differences from the previous one."""
    return [int(after - before) for before, after in pairwise([0, *numbers])]


def _expression(value: KernelValue) -> str:
    operands = [_name(operand) for operand in value.operands]
    match value.kind:
        case "neg":
            return f"-({operands[0]})"
        case "pow":
            return f"{operands[0]}**{operands[1]}"
        case "log_ratio":
            return f"Math.log({operands[0]}/{operands[1]})"
        case "choose":
            return f"({operands[0]}>0?{operands[1]}:{operands[2]})"
        case "half_turns":
            return f"Math.round(({operands[0]}-({operands[1]}))/Math.PI)"
    if value.kind in _INFIX:
        return f"{operands[0]}{_INFIX[value.kind]}{operands[1]}"
    return f"Math.{_CALLED[value.kind]}({operands[0]})"


def _name(value: KernelValue) -> str:
    if not value.is_constant:
        # as short as may be: of no reserved word, and of none of the arguments
        return chr(ord("a") + value.index % _LETTERS) + np.base_repr(value.index // _LETTERS, 36)
    text = repr(number(value)).replace("inf", "Infinity").replace("nan", "NaN").removesuffix(".0")
    return f"({text})" if text.startswith("-") else text
