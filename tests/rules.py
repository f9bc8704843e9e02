"""What rules of the source look at: every formula, every module as a syntax tree."""

from __future__ import annotations

import ast
import functools
import gc
import importlib
import pkgutil
from pathlib import Path

import crankwork
from crankwork.formula.expression import FORMULAS, Formula

PACKAGE = Path(crankwork.__file__).parent


@functools.cache
def every_formula() -> dict[str, Formula]:
    """Return every registered formula by name; a module that needs a package that is not installed has none."""
    for module in pkgutil.walk_packages(crankwork.__path__, "crankwork."):
        if module.name.endswith("__main__"):
            continue
        try:
            importlib.import_module(module.name)
        except ModuleNotFoundError as absent:
            if absent.name is None or absent.name.startswith("crankwork"):
                raise
    return FORMULAS


@functools.cache
def source_trees() -> dict[Path, ast.Module]:
    """Return every module of the package, parsed."""
    # what is looked for in a million of new nodes again and again is no garbage
    gc.disable()
    try:
        return {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.rglob("*.py"))}
    finally:
        gc.enable()
