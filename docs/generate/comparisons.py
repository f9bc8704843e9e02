"""A plugin of pytest that writes down what the tests of `tests/literature` compare.

Each assertion of a comparison in these modules is replaced by a call of `_Recorder`, which notes both sides and decides
as the assertion does. `pytest -p comparisons --comparisons FILE tests/literature` writes the notes as JSON.
"""

from __future__ import annotations

import ast
import importlib.machinery
import importlib.util
import json
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

import numpy as np
import pytest

LITERATURE = Path(__file__).parents[2] / "tests" / "literature"
_RECORDER = "_note_comparison"
_OPERATORS = {"Eq": lambda a, b: a == b, "Lt": lambda a, b: a < b, "LtE": lambda a, b: a <= b}


class _Assertions(ast.NodeTransformer):
    """Turns `assert left == right` into a call that is given both sides, their text and the local names."""

    def visit_Assert(self, node: ast.Assert) -> ast.AST:
        test = node.test
        if not isinstance(test, ast.Compare) or len(test.ops) != 1 or type(test.ops[0]).__name__ not in _OPERATORS:
            return node
        arguments = [test.left, test.comparators[0]]
        # what is rounded for the comparison is noted as it was before
        exact = [_rounded(side) for side in arguments]
        facts: list[ast.expr] = [
            ast.Constant(type(test.ops[0]).__name__),
            *arguments,
            *(ast.Constant(None) if side is None else ast.Lambda(_NO_ARGUMENTS, side) for side in exact),
            ast.Constant(node.lineno),
            ast.Constant(ast.unparse(test.left)),
            ast.Call(ast.Name("locals", ast.Load()), [], []),
        ]
        call = ast.Call(ast.Name(_RECORDER, ast.Load()), facts, [])
        return ast.fix_missing_locations(ast.copy_location(ast.Assert(call, node.msg), node))


_NO_ARGUMENTS = ast.arguments(posonlyargs=[], args=[], kwonlyargs=[], kw_defaults=[], defaults=[])


def _rounded(side: ast.expr) -> ast.expr | None:
    """Return what is rounded by `round(x, digits)`, and the digits."""
    if not isinstance(side, ast.Call) or not isinstance(side.func, ast.Name) or side.func.id != "round":
        return None
    return ast.Tuple([side.args[0], side.args[1] if len(side.args) > 1 else ast.Constant(0)], ast.Load())


class _Loader(importlib.machinery.SourceFileLoader):
    """Reads a module of tests with its assertions replaced, never from bytecode."""

    def get_code(self, fullname: str) -> CodeType:
        """Return the code of the module."""
        path = self.get_filename(fullname)
        tree = _Assertions().visit(ast.parse(Path(path).read_bytes(), path))
        return compile(tree, path, "exec", dont_inherit=True)

    def exec_module(self, module: ModuleType) -> None:
        """Run the module, with the recorder among its names."""
        setattr(module, _RECORDER, _Recorder(Path(self.path).stem))
        super().exec_module(module)


class _Finder:
    """Finds the modules of `tests/literature`."""

    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None = None, _: object = None) -> Any:  # noqa: ANN401 - as Python wants it
        """Return how a module is loaded, None for all others."""
        file = LITERATURE / f"{name.rpartition('.')[2]}.py"
        if not file.name.startswith("test_") or not file.exists() or str(LITERATURE) not in map(str, path or ()):
            return None
        return importlib.util.spec_from_file_location(name, file, loader=_Loader(name, str(file)))


_current: dict[str, str] = {}
_notes: list[dict[str, Any]] = []


class _Recorder:
    """Notes the comparisons of one module."""

    def __init__(self, module: str) -> None:
        self.module = module

    def __call__(self, operator: str, *facts: Any) -> bool:  # noqa: ANN401 - any two things are compared
        left, right, exact_left, exact_right, line, written, names = facts
        holds = bool(np.all(_OPERATORS[operator](left, right)))
        if holds:
            common = {"module": self.module, "line": line, "written": written, **_current, **_case(names)}
            found, digits = (left, None) if exact_left is None else exact_left()
            printed = right if exact_right is None else exact_right()[0]
            if _is_expectation(left):
                found, printed = right, left
            kind = "limit" if operator != "Eq" else "value"
            _notes.extend({**common, "kind": kind, **note} for note in _values(found, printed, _half_of(digits)))
        return holds


def _case(names: Mapping[str, Any]) -> dict[str, Any]:
    """Return the local names that tell what is compared."""
    return {
        "names": {
            name: value for name, value in names.items()
            if isinstance(value, str | int | float) and not name.startswith("_") and len(str(value)) < 80
        }
    }  # fmt: skip


def _is_expectation(side: object) -> bool:
    return hasattr(side, "expected") and hasattr(side, "rel")


def _half_of(digits: int | None) -> float | None:
    """Return half of the last of so many decimals."""
    return None if digits is None else 0.5 * 10.0**-digits


def _values(found: Any, printed: Any, step: float | None, key: str = "") -> Iterator[dict[str, Any]]:  # noqa: ANN401
    """Yield what is compared as pairs of numbers; of many numbers the pair that differs most."""
    if any(map(np.iscomplexobj, (found, getattr(printed, "expected", printed)))):
        return
    tolerance = step
    if _is_expectation(printed):
        expected = printed.expected
        if isinstance(expected, Mapping):
            for name, value in expected.items():
                wanted = pytest.approx(value, rel=printed.rel, abs=printed.abs)
                yield from _values(found[name], wanted, None, str(name))
            return
        relative, absolute = printed.rel, printed.abs
        printed = expected
        sizes = np.max(np.abs(np.asarray(expected, dtype=float))) if np.size(expected) else 0.0
        tolerance = max((1e-6 if relative is None and absolute is None else relative or 0.0) * sizes, absolute or 0.0)
    try:
        one, other = (np.atleast_1d(np.asarray(side, dtype=float)) for side in (found, printed))
        one, other = np.broadcast_arrays(one, other)
    except (TypeError, ValueError):
        return
    if not one.size or any(isinstance(side, bool | np.bool_ | str) for side in (found, printed)):
        return
    place = int(np.argmax(np.abs(one - other)))
    pair = float(one.flat[place]), float(other.flat[place])
    if all(map(math.isfinite, pair)):
        yield {"found": pair[0], "printed": pair[1], "allowed": tolerance, "count": int(one.size), "key": key}


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the file that is written."""
    parser.addoption("--comparisons", help="write what tests of literature compare into this file")


def pytest_configure() -> None:
    """Read the modules with their assertions replaced."""
    sys.meta_path.insert(0, _Finder())  # type: ignore[arg-type]


def pytest_runtest_call(item: pytest.Item) -> None:
    """Remember which test runs, and what it and its class say of themselves."""
    function = getattr(item, "function", None)
    owner = getattr(item, "cls", None)
    _current.update(
        test=item.nodeid.partition("::")[2],
        said=(getattr(function, "__doc__", None) or "").strip(),
        case=((owner.__doc__ if owner else None) or "").strip(),
    )


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the notes."""
    if file := session.config.getoption("comparisons"):
        Path(file).write_text(json.dumps(_notes, ensure_ascii=False, indent=0), encoding="utf-8")
