"""One rule checked over many members, as over all formulas: every member that breaks it is told by name."""

from __future__ import annotations

import ast
import functools
import gc
import importlib
import pkgutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

import pytest

import crankwork
from crankwork.formula.expression import FORMULAS, Formula

Member = TypeVar("Member")
PACKAGE = Path(crankwork.__file__).parent


def failing(members: Mapping[str, Member], check: Callable[[Member], object]) -> dict[str, str]:
    """Return what is wrong with each member that does not pass a check, by name."""
    assert members, "a rule without members says nothing"
    wrong: dict[str, str] = {}
    for name, member in members.items():
        try:
            check(member)
        except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - told with the name of the member
            wrong[name] = f"{type(error).__name__}: {error}"[:600]
    return wrong


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
