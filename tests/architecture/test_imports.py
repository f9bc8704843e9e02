"""What is imported, and where."""

from __future__ import annotations

import ast
import subprocess
import sys

import pytest

HEAVY = ("docx", "ezdxf", "lxml", "matplotlib", "numba", "numpy", "pydantic", "scipy", "typst", "xlsxwriter")


@pytest.mark.parametrize("name", ["crankwork", "crankwork.cli"])
def test_importing_loads_nothing_heavy(name):
    code = f"import sys, {name}; print(*[heavy for heavy in {HEAVY!r} if heavy in sys.modules])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout.split(), result.stderr) == (0, [], "")


def test_no_import_of_crankwork_inside_a_function(modules):
    hidden = [
        f"{module.path}:{node.lineno}"
        for module in modules
        for function in ast.walk(module.tree)
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        for node in ast.walk(function)
        if isinstance(node, ast.Import | ast.ImportFrom)
        and any(name.partition(".")[0] == "crankwork" for name in _imported_names(node))
    ]
    assert hidden == []


def _imported_names(node: ast.Import | ast.ImportFrom) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return ["crankwork" if node.level else node.module or ""]
