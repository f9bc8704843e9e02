"""Compiles the source with a statement in every block of a function that sets a byte.

The bytes lie in a file that a test process shares with the processes that it starts. Nothing but the standard library
is imported here, because every such process imports it.
"""

from __future__ import annotations

import ast
import builtins
import hashlib
import importlib.machinery
import json
import marshal
import mmap
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from types import CodeType
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "crankwork"
# what Numba compiles cannot set a byte
NOT_MARKED = frozenset({"kernel/elementary.py"})
SIZE = 1 << 17
BYTES, INDEX = "CRANKWORK_EXECUTED", "CRANKWORK_EXECUTED_INDEX"
_NAME = "__executed__"


class _Marker(ast.NodeTransformer):
    """Puts a statement at the beginning of each block; `lines` are the first and last line of each."""

    def __init__(self, first: int) -> None:
        self.first, self.lines = first, list[tuple[int, int]]()
        self.inside = False

    def block(self, body: list[ast.stmt]) -> list[ast.stmt]:
        at = 0
        while at < len(body) and (
            isinstance(body[at], ast.Global | ast.Nonlocal)
            or (isinstance(body[at], ast.Expr) and isinstance(getattr(body[at], "value", None), ast.Constant))
        ):
            at += 1
        if at == len(body):
            return body
        self.lines.append((body[at].lineno, body[-1].end_lineno or body[-1].lineno))
        number = self.first + len(self.lines) - 1
        mark = ast.parse(f"{_NAME}[{number}] = 1").body[0]
        for node in ast.walk(mark):
            ast.copy_location(node, body[at])
        return [*body[:at], mark, *body[at:]]

    def _function(self, node: Any) -> Any:
        outside, self.inside = self.inside, True
        self.generic_visit(node)
        node.body = self.block(node.body)
        self.inside = outside
        return node

    visit_FunctionDef = visit_AsyncFunctionDef = _function  # noqa: N815 - names of ast

    def generic_visit(self, node: ast.AST) -> ast.AST:
        super().generic_visit(node)
        if self.inside and isinstance(
            node, ast.If | ast.For | ast.While | ast.Try | ast.ExceptHandler | ast.match_case
        ):
            for name in ("body", "orelse", "finalbody"):
                body = getattr(node, name, None)
                if body and not (name == "orelse" and isinstance(node, ast.If) and isinstance(body[0], ast.If)):
                    setattr(node, name, self.block(body))
        return node


def marked(path: Path, first: int) -> tuple[CodeType, list[tuple[int, int]]]:
    """Return the code of a file with numbered blocks, and their lines."""
    tree = ast.parse(path.read_bytes(), str(path))
    marker = _Marker(first)
    marker.visit(tree)
    return compile(tree, str(path), "exec", dont_inherit=True), marker.lines


def prepare(folder: Path) -> Path:
    """Compile all files with marks into a folder, if they are not there yet; return the index of blocks."""
    digest = hashlib.sha256(Path(__file__).read_bytes() + sys.version.encode())
    paths = sorted(SOURCE.rglob("*.py"))
    for path in paths:
        digest.update(str(path).encode() + path.read_bytes())
    kept = folder / digest.hexdigest()[:20]
    index = kept / "index.json"
    if not index.exists():
        kept.mkdir(parents=True, exist_ok=True)
        blocks: list[tuple[str, int, int]] = []
        for path in paths:
            name = path.relative_to(SOURCE).as_posix()
            if name in NOT_MARKED:
                continue
            code, lines = marked(path, len(blocks))
            blocks += [(name, *ends) for ends in lines]
            (kept / name.replace("/", "%")).write_bytes(marshal.dumps(code))
        whole = kept / f"index-{os.getpid()}"
        whole.write_text(json.dumps(blocks), "utf-8")
        whole.replace(index)
    return index


class _Loader(importlib.machinery.SourceFileLoader):
    def get_code(self, fullname: str) -> CodeType | None:
        path = Path(self.get_filename(fullname))
        kept = Path(os.environ[INDEX]).parent / path.relative_to(SOURCE).as_posix().replace("/", "%")
        if not kept.exists():
            return super().get_code(fullname)
        return marshal.loads(kept.read_bytes())  # noqa: S302 - our own


class _Finder:
    @staticmethod
    def find_spec(name: str, path: Sequence[str] | None, target: Any = None) -> Any:
        if name != "crankwork" and not name.startswith("crankwork."):
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        plain = spec is not None and isinstance(spec.loader, importlib.machinery.SourceFileLoader)
        if plain and Path(spec.origin).is_relative_to(SOURCE):
            spec.loader = _Loader(name, spec.origin)
        return spec


def start() -> mmap.mmap:
    """Mark what this process imports from now on; the bytes are those of the file that the environment names."""
    with Path(os.environ[BYTES]).open("r+b") as file:
        shared = mmap.mmap(file.fileno(), SIZE)
    setattr(builtins, _NAME, shared)
    sys.meta_path.insert(0, _Finder())
    return shared
