"""A plan written out in the language of browsers: a module that a page has inside, and the numbers that it works on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby, pairwise
from typing import Any

import numpy as np

from crankwork.kernel.graph import Value, in_order, number
from crankwork.kernel.grid import Polynomials
from crankwork.kernel.plan import Level, Loop
from crankwork.kernel.source import Source

_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
_CALLED = {
    "sqrt": "sqrt", "exp": "exp", "log": "log", "sin": "sin", "cos": "cos", "tan": "tan", "arcsin": "asin",
    "arccos": "acos", "arctan": "atan",
}  # fmt: skip
# of directions that only half turns are counted from, so many decimals [rad]
_ROUGH = 2


class Script:
    """A plan in the layout of its source, for one design at a time.

    `text` says what is done, `data` what it is done with: crank angles, their functions, and where everything stands.
    """

    def __init__(self, source: Source, polynomials: Polynomials) -> None:
        self._source, self._plan = source, source.plan
        # what is named one after another is named at once
        self.text = "".join(_joined(self._lines()))
        self.data = self._numbers(polynomials)

    def _numbers(self, polynomials: Polynomials) -> dict[str, Any]:
        source, grid = self._source, self._plan.grid
        earlier = [grid.earlier(by) for by in source.delays.of]
        outputs = self._plan.outputs
        return {
            "edges": grid.edges.tolist(),
            "nodes": polynomials.nodes.tolist(),
            "weights": polynomials.weights.tolist(),
            "rows": grid.degrees[grid.nodes :].tolist(),
            "order": _apart(source.order),
            "earlier": [_apart(one) for one in earlier if one is not None],
            "angles": [self._of_angle(one) for one in self._leaves()],
            "sizes": [len(source.rows.of), len(source.columns.of), len(self._plan.of_angle)],
            "values": {
                key: source.rows(source.place(one)) for key, one in outputs.items() if one.detail != "column"
            },
            "columns": {
                key: source.columns(one.operands[0].at) for key, one in outputs.items() if one.detail == "column"
            },
            "reductions": [[self._reduction(one) for one in _reduced(level)] for level in self._plan.levels],
        }  # fmt: skip

    def _leaves(self) -> list[Value]:
        return [one for one in in_order(self._plan.of_angle) if one.kind == "angle"]

    def _of_angle(self, leaf: Value) -> list[Any]:
        """Return a function of the crank angle by its name, or the numbers of one that has none."""
        function, multiple, shift = leaf.detail
        if function == "within" and not shift:
            function = "degrees"
        if function not in ("reading", "within"):
            return [function, multiple, shift]
        values = self._plan.function_of_angle(leaf, slice(None))
        users = {
            one.kind
            for level in self._plan.levels
            for loop in level.loops
            for one in loop.values
            if leaf in one.operands
        }
        numbers: list[Any] = (np.round(values, _ROUGH) if users == {"half_turns"} else values).tolist()
        return numbers

    def _reduction(self, one: Value) -> list[Any]:
        columns = [self._source.columns(of.at) for of in one.operands]
        # a root has a corner where it vanishes, and its square has none
        is_root = one.operands[0].kind == "sqrt"
        return [f"{one.detail} root" if is_root else one.detail, self._source.rows(self._source.place(one)), *columns]

    def _lines(self) -> Iterator[str]:
        yield "var steps={table(q,t,n){for(let j=0;j<n;j+=1){"
        leaves = self._leaves()
        for at, one in enumerate(leaves):
            yield f"const v{one.at}=q[{at}][j];"
        for one in in_order(self._plan.of_angle):
            if one.kind not in ("angle", "constant"):
                yield f"const v{one.at}={_expression(one)};"
        for row, one in enumerate(self._plan.of_angle):
            yield f"t[{row}*n+j]=v{one.at};"
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
        made = {one.at for one in level.designs}
        yield from self._taken(
            one for of in level.designs if of.kind != "input" for one in of.operands if one.at not in made
        )
        for one in level.designs:
            given = f"s[{source.rows(source.place(one))}]" if one.kind == "input" else _expression(one)
            yield f"const v{one.at}={given};"
            if one.at in source.used and one.kind != "input":
                yield f"s[{source.rows(one.at)}]=v{one.at};"

    def _loop(self, level: Level, loop: Loop, start: int) -> Iterator[str]:
        source, plan = self._source, self._plan
        made = {one.at for one in loop.values}
        operands = [one for of in loop.values if of.kind != "delayed" for one in of.operands]
        taken = {one.at: one for one in (*operands, *loop.columns) if one.at not in made and not one.is_constant}
        yield from self._taken(one for one in taken.values() if not one.by_angle)
        yield f"for(let i={start};i<{start + loop.angles.size};i+=1){{const j=o[i];"
        for one in taken.values():
            if one.by_angle:
                yield f"const v{one.at}=t[{plan.row_of_angle[one.at]}*n+j];"
        for one in loop.values:
            if one.kind == "delayed":
                place = f"p[{source.delays(one.detail)}][j]"
                yield f"const v{one.at}=b[{source.columns(one.operands[0].at)}*n+{place}];"
            else:
                yield f"const v{one.at}={_expression(one)};"
        for column, value in zip(level.columns, loop.columns, strict=True):
            yield f"b[{source.columns(column.at)}*n+j]={_name(value)};"
        yield "}"

    def _taken(self, values: Iterable[Value]) -> Iterator[str]:
        for one in {one.at: one for one in values if not one.is_constant}.values():
            yield f"const v{one.at}=s[{self._source.rows(self._source.place(one))}];"


def _reduced(level: Level) -> list[Value]:
    return [one for one in level.reductions if one.detail != "column"]


def _joined(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines, what is named one after another named at once."""
    for is_name, some in groupby(lines, lambda one: one.startswith("const ")):
        if is_name:
            yield f"const {','.join(one[len('const ') : -1] for one in some)};"
        else:
            yield from some


def _apart(places: Any) -> list[int]:  # noqa: ANN401 - whole numbers
    """Return whole numbers as what each adds to the one before."""
    return [int(after - before) for before, after in pairwise([0, *places])]


def _expression(one: Value) -> str:
    operands = [_name(other) for other in one.operands]
    match one.kind:
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
    if one.kind in _INFIX:
        return f"{operands[0]}{_INFIX[one.kind]}{operands[1]}"
    return f"Math.{_CALLED[one.kind]}({operands[0]})"


def _name(value: Value) -> str:
    if not value.is_constant:
        return f"v{value.at}"
    written = repr(number(value)).replace("inf", "Infinity").replace("nan", "NaN").removesuffix(".0")
    return f"({written})" if written.startswith("-") else written
