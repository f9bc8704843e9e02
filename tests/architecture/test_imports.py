"""What is imported, and where."""

from __future__ import annotations

import ast
import subprocess
import sys

# Imports that no import checker sees, by module: one door, which loads a name of the package when it is first used.
# names of the package, and kernels from the files where Numba keeps them
STRING_IMPORTS = {"__init__.py": ["crankwork.*"], "kernel/compiled.py": ["*"]}

IMPORTING = {"__import__", "exec_module", "import_module", "resolve_name", "run_module", "run_path"}

HEAVY = ("docx", "ezdxf", "lxml", "matplotlib", "numba", "numpy", "pydantic", "scipy", "typst", "xlsxwriter")


def test_importing_loads_nothing_heavy():
    code = f"import sys, crankwork, crankwork.cli; print(*[heavy for heavy in {HEAVY!r} if heavy in sys.modules])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout.split(), result.stderr) == (0, [], "")


def test_modules_imported_by_a_string_are_those_listed(modules):
    found = {module.path: [_text(one) for one in _string_imports(module.tree)] for module in modules}
    assert {path: names for path, names in found.items() if names} == STRING_IMPORTS


def _string_imports(tree: ast.Module) -> list[ast.expr | None]:
    """Return what is imported by a string, wherever a way to do so is called, given away or taken in."""
    calls = {id(node.func): node for node in ast.walk(tree) if isinstance(node, ast.Call)}
    found: list[ast.expr | None] = []
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(attr=name) | ast.Name(id=name) if name in IMPORTING:
                call = calls.get(id(node))
                found.append(call.args[0] if call and call.args else None)
            case ast.ImportFrom(names=names) if any(one.name in IMPORTING and one.asname for one in names):
                found.append(None)
            case ast.Constant(value=str(name)) if name in IMPORTING:
                found.append(None)
    return found


def _text(node: ast.expr | None) -> str:
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.JoinedStr(values=values):
            return "".join(_text(one) for one in values)
        case _:
            return "*"


COUNTED = {
    "importlib.import_module('crankwork.analysis.one_cylinder')": ["crankwork.analysis.one_cylinder"],
    "importlib.import_module(f'crankwork.note.{kind}_note')": ["crankwork.note.*_note"],
    "importlib.import_module(name)": ["*"],
    "import_module('.loads', 'crankwork')": [".loads"],
    "__import__('crankwork.loads')": ["crankwork.loads"],
    "load = importlib.import_module": ["*"],
    "from importlib import import_module as load": ["*"],
    "getattr(importlib, 'import_module')(name)": ["*"],
    "import crankwork.loads.gas": [],
    "modules[name]": [],
}


def test_what_counts_as_an_import_by_a_string():
    assert {code: [_text(one) for one in _string_imports(ast.parse(code))] for code in COUNTED} == COUNTED
