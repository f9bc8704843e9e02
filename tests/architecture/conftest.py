"""The source tree as the tests of its architecture see it."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import NamedTuple

import pytest

from rules import PACKAGE, source_trees

ROOT = Path(__file__).parents[2]


class Module(NamedTuple):
    """A file of the package: where it is below src/crankwork, its text and its syntax tree."""

    path: str
    text: str
    tree: ast.Module


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def modules() -> list[Module]:
    """Every file of the package."""
    return [
        Module(path.relative_to(PACKAGE).as_posix(), path.read_text("utf-8"), tree)
        for path, tree in source_trees().items()
    ]
