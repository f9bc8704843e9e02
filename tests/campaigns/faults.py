"""Faults as people make them, drawn from the syntax tree of the source with the commit as seed.

Each kind finds the places where it is possible, and what would stand there. `drawn` takes at least ten places of every
package and eight of every kind; nobody edits the list.
"""

from __future__ import annotations

import ast
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from crankwork.quantities import QUANTITIES

# faults of each package, of each kind, and of all
EACH, EACH_KIND, TOTAL = 10, 8, 200


class Fault(NamedTuple):
    """One place of a file, by its bytes, and what would stand there."""

    kind: str
    file: str
    line: int
    start: int
    end: int
    instead: str

    @property
    def name(self) -> str:
        """The name under which results are kept."""
        return f"{self.file}:{self.line}:{self.start}:{self.kind}"

    @property
    def package(self) -> str:
        """The package that it is in; modules beside the packages are one."""
        first, _, rest = self.file.partition("/")
        return first if rest else "crankwork"

    def put_into(self, text: bytes) -> bytes:
        """Return the file with the fault."""
        return text[: self.start] + self.instead.encode() + text[self.end :]


@dataclass
class _File:
    """A file as its kinds look at it."""

    name: str
    data: bytes
    tree: ast.Module
    starts: list[int]

    def span(self, node: ast.AST) -> tuple[int, int]:
        return (
            self.starts[node.lineno - 1] + node.col_offset,  # type: ignore[attr-defined]
            self.starts[node.end_lineno - 1] + node.end_col_offset,  # type: ignore[attr-defined]
        )

    def text(self, node: ast.AST) -> str:
        start, end = self.span(node)
        return self.data[start:end].decode()

    def fault(self, kind: str, node: ast.AST, instead: str) -> Fault:
        return Fault(kind, self.name, node.lineno, *self.span(node), instead)  # type: ignore[attr-defined]

    def swap(self, kind: str, first: ast.expr, second: ast.expr) -> Fault | None:
        """Return the fault that two expressions stand in each other's place."""
        one, other = self.text(first), self.text(second)
        if one == other:
            return None
        start, middle = self.span(first)
        again, end = self.span(second)
        between = self.data[middle:again].decode()
        return Fault(kind, self.name, first.lineno, start, end, other + between + one)


Found = Iterator[Fault | None]
_ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow)
_MIRRORED = {ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "=="}
_UNIT_FACTORS = {10, 60, 90, 100, 180, 360, 720, 1000, 3600, 1e5, 1e6, 1e-2, 1e-3, 1e-6, 9.81, 0.5, 2}
_WRITES = {"write", "write_bytes", "write_text", "writestr", "_write_through", "fromstring", "encode", "getvalue"}
# what moves a whole file into its place, or waits until it is on the disk
_INTO_PLACE = {"replace", "fsync", "rename", "unlink", "flush"}
_EXITS = {"exit", "SystemExit", "Exit", "UsageError"}


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def _is_of_numbers(node: ast.AST) -> bool:
    return not any(
        isinstance(one, ast.JoinedStr | ast.List | ast.Tuple | ast.Dict)
        or (isinstance(one, ast.Constant) and isinstance(one.value, str | bytes))
        for one in ast.walk(node)
    )


def _of_factor(file: _File, node: ast.AST) -> Found:
    value = node.value if isinstance(node, ast.Return) else None
    if isinstance(value, ast.BinOp) and isinstance(value.op, _ARITHMETIC) and _is_of_numbers(value):
        yield file.fault("factor", value, f"({file.text(value)}) * 1.001")


def _of_sign(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub) and _is_of_numbers(node):
        sign = " - " if isinstance(node.op, ast.Add) else " + "
        yield file.fault("sign", node, file.text(node.left) + sign + f"({file.text(node.right)})")
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) and not _is_number(node.operand):
        yield file.fault("sign", node, file.text(node.operand))


def _of_unit(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.BinOp):
        for one in (node.left, node.right):
            if _is_number(one) and one.value in _UNIT_FACTORS:  # type: ignore[attr-defined]
                yield file.fault("unit", one, repr(one.value * 10))  # type: ignore[attr-defined]


def _of_shift(file: _File, node: ast.AST) -> Found:
    if not isinstance(node, ast.Subscript) or not isinstance(node.ctx, ast.Load):
        return
    places = [node.slice.lower, node.slice.upper] if isinstance(node.slice, ast.Slice) else [node.slice]
    for one in places:
        if one is not None and re.fullmatch(r"-?\d", text := file.text(one)):
            yield file.fault("shift", one, str(int(text) + (1 if int(text) >= 0 else -1)))


def _of_breakpoint(file: _File, node: ast.AST) -> Found:
    if not isinstance(node, ast.Compare) or len(node.ops) != 1 or type(node.ops[0]) not in _MIRRORED:
        return
    left, right = node.left, node.comparators[0]
    counted = any(
        (isinstance(one, ast.Constant) and type(one.value) is int) or "len(" in file.text(one) for one in (left, right)
    )
    if counted or isinstance(node.ops[0], ast.Eq | ast.NotEq):
        sign = f" {_MIRRORED[type(node.ops[0])]} "
        yield file.fault("breakpoint", node, file.text(left) + sign + file.text(right))
    # a tolerance that is a little larger is none the worse
    elif _is_number(right) and abs(right.value) > 1e-3:  # type: ignore[attr-defined]
        yield file.fault("breakpoint", right, repr(right.value * 1.1))  # type: ignore[attr-defined]
    elif isinstance(right, ast.Name | ast.Attribute | ast.Subscript):
        yield file.fault("breakpoint", right, f"({file.text(right)}) * 1.1")


def _of_owner(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.Call) and len(node.args) > 1:
        first, second, *_ = node.args
        if isinstance(first, ast.Name | ast.Attribute) and isinstance(second, ast.Name | ast.Attribute):
            yield file.swap("owner", first, second)


def _of_key(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value in QUANTITIES:
        keys = sorted(QUANTITIES)
        other = keys[(keys.index(node.value) + 1) % len(keys)]
        yield file.fault("key", node, f'"{other}"')


def _of_exit(file: _File, node: ast.AST) -> Found:
    if not file.name.startswith(("cli/", "__main__", "errors")):
        return
    if isinstance(node, ast.Call) and file.text(node.func).rpartition(".")[2] in _EXITS:
        for one in node.args:
            if _is_number(one):
                yield file.fault("exit", one, str((int(one.value) + 1) % 3))  # type: ignore[attr-defined]
    value = getattr(node, "value", None) if isinstance(node, ast.Return | ast.Assign) else None
    if isinstance(value, ast.Constant) and type(value.value) is int:
        yield file.fault("exit", value, str(value.value + 1))


def _of_half(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.Call) and file.text(node.func).rpartition(".")[2] in _WRITES:
        if node.args and not isinstance(node.args[-1], ast.Constant | ast.Starred):
            cut = file.text(node.args[-1])
            yield file.fault("half", node.args[-1], f"({cut})[: len({cut}) // 2]")
        elif not node.args and not node.keywords:
            whole = file.text(node)
            yield file.fault("half", node, f"(lambda whole: whole[: len(whole) // 2])({whole})")
    called = node.value if isinstance(node, ast.Expr) else None
    is_moving = isinstance(called, ast.Call) and file.text(called.func).rpartition(".")[2] in _INTO_PLACE
    if file.name == "files.py" and is_moving:
        yield file.fault("half", node, "pass")


def _of_legend(file: _File, node: ast.AST) -> Found:
    if isinstance(node, ast.List | ast.Tuple) and len(node.elts) > 1 and isinstance(node.ctx, ast.Load):
        first, second, *_ = node.elts
        if not isinstance(first, ast.Starred) and not isinstance(second, ast.Starred) and not _is_number(first):
            yield file.swap("legend", first, second)


KINDS: dict[str, Callable[[_File, ast.AST], Found]] = {
    "factor": _of_factor, "sign": _of_sign, "unit": _of_unit, "shift": _of_shift, "breakpoint": _of_breakpoint,
    "owner": _of_owner, "key": _of_key, "exit": _of_exit, "half": _of_half, "legend": _of_legend,
}  # fmt: skip
TEXT = "text"
# where curves, columns and their names stand side by side
_SHOWING = ("report/", "note/", "show/", "page/", "studio/", "study/")


def _code(tree: ast.Module) -> Iterator[ast.AST]:
    """Yield what is executed: no docstrings, annotations, or what only type checkers read."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        yield node
        for name, value in ast.iter_fields(node):
            if name not in ("annotation", "returns", "type_params"):
                children = value if isinstance(value, list) else [value]
                waiting += [one for one in children if isinstance(one, ast.AST)]


def places(source: Path) -> Iterator[Fault]:
    """Yield every fault that is possible in the source."""
    for path in sorted(source.rglob("*.py")):
        name, data = path.relative_to(source).as_posix(), path.read_bytes()
        starts = [0]
        for line in data.splitlines(keepends=True):
            starts.append(starts[-1] + len(line))
        file = _File(name, data, ast.parse(data), starts)
        for node in _code(file.tree):
            for kind, find in KINDS.items():
                if kind == "legend" and not name.startswith(_SHOWING):
                    continue
                yield from (one for one in find(file, node) if one is not None)
    for path in sorted((source / "locale").glob("*/*.toml")):
        at = 0
        for number, line in enumerate(path.read_bytes().splitlines(keepends=True), start=1):
            if b" = " in line:
                yield Fault(TEXT, path.relative_to(source).as_posix(), number, at, at + len(line), "")
            at += len(line)


def drawn(source: Path, seed: str, total: int = TOTAL) -> list[Fault]:
    """Return faults of every package and of every kind, and more of all until there are enough."""
    chance = random.Random(seed)  # noqa: S311 - the same faults for everybody
    by_package: dict[str, dict[str, list[Fault]]] = {}
    for fault in places(source):
        by_package.setdefault(fault.package, {}).setdefault(fault.kind, []).append(fault)
    taken: dict[str, Fault] = {}

    def take(package: str, kind: str) -> None:
        one = chance.choice(by_package[package][kind])
        taken[one.name] = one

    for package, kinds in sorted(by_package.items()):
        possible = sum(map(len, kinds.values()))
        while sum(one.package == package for one in taken.values()) < min(EACH, possible):
            take(package, chance.choice(sorted(kinds)))
    for kind in [*KINDS, TEXT]:
        packages = [package for package, kinds in sorted(by_package.items()) if kind in kinds]
        possible = sum(len(by_package[package][kind]) for package in packages)
        while sum(one.kind == kind for one in taken.values()) < min(EACH_KIND, possible):
            take(chance.choice(packages), kind)
    while len(taken) < total:
        package = chance.choice(sorted(by_package))
        take(package, chance.choice(sorted(by_package[package])))
    return list(taken.values())
