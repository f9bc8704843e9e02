"""Counts the numbers of tests whose expected values crankwork did not make.

The count of a test function is that of the numbers written in it, in its cases, and in what it uses of its module.
`python tests/architecture/outside_values.py` prints what belongs into `outside_values.txt` beside this file.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

TESTS = Path(__file__).parents[1]
MARK = "elsewhere"


def _definitions(module: ast.Module) -> dict[str, list[ast.stmt]]:
    """Return what a module defines, by name."""
    found: dict[str, list[ast.stmt]] = {}
    for one in module.body:
        if isinstance(one, ast.FunctionDef | ast.ClassDef):
            found.setdefault(one.name, []).append(one)
        elif isinstance(one, ast.Assign | ast.AnnAssign | ast.AugAssign):
            targets = one.targets if isinstance(one, ast.Assign) else [one.target]
            for target in targets:
                for name in ast.walk(target):
                    if isinstance(name, ast.Name):
                        found.setdefault(name.id, []).append(one)
    return found


class _Definition(NamedTuple):
    """What a definition uses, and how many numbers are written in it."""

    names: frozenset[str]
    numbers: int

    @classmethod
    def of(cls, tree: ast.AST) -> _Definition:
        names, numbers = set(), 0
        for one in ast.walk(tree):
            if isinstance(one, ast.Name):
                names.add(one.id)
            elif isinstance(one, ast.arg):  # a fixture
                names.add(one.arg)
            elif isinstance(one, ast.Constant) and type(one.value) in (int, float):
                numbers += 1
        return cls(frozenset(names), numbers)


def _numbers(function: ast.AST, definitions: Mapping[str, list[_Definition]]) -> int:
    own = _Definition.of(function)
    used, waiting, seen = {id(own): own}, set(own.names), set[str]()
    while waiting:
        name = waiting.pop()
        if name in seen or name.startswith("test_"):
            continue
        seen.add(name)
        for one in definitions.get(name, ()):
            used[id(one)] = one
            waiting |= one.names
    return sum(one.numbers for one in used.values())


def _is_marked(decorators: list[ast.expr]) -> bool:
    return any(MARK in ast.unparse(one) for one in decorators)


def counted(tests: Path) -> Iterator[tuple[str, int]]:
    """Yield test functions marked `elsewhere`, and how many numbers they have."""
    for path in sorted(tests.rglob("test_*.py")):
        module = ast.parse(path.read_bytes())
        statements = _definitions(module)
        described = {id(one): _Definition.of(one) for several in statements.values() for one in several}
        definitions = {name: [described[id(one)] for one in several] for name, several in statements.items()}
        marks = statements.get("pytestmark", [])
        # the conftest of literature marks all of it
        all_marked = path.parent.name == "literature" or any(MARK in ast.unparse(one) for one in marks)
        where = path.relative_to(tests).as_posix()
        for one in module.body:
            inside = one.body if isinstance(one, ast.ClassDef) else [one]
            owner = f"{one.name}::" if isinstance(one, ast.ClassDef) else ""
            of_class = isinstance(one, ast.ClassDef) and _is_marked(one.decorator_list)
            for function in inside:
                if not isinstance(function, ast.FunctionDef) or not function.name.startswith("test_"):
                    continue
                if all_marked or of_class or _is_marked(function.decorator_list):
                    yield f"{where}::{owner}{function.name}", _numbers(function, definitions)


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else TESTS
    sys.stdout.writelines(f"{name} {count}\n" for name, count in counted(folder))
