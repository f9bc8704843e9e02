"""What runs in a browser: plain modules and style sheets, joined for a page of one file."""

from __future__ import annotations

import re
from collections.abc import Iterator

from crankwork.resources import read_resource, resource_names

_IMPORT = re.compile(r'^import \{[^}]*\} from "\./(\w+)\.js";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=class|function|const)", re.MULTILINE)
_COMMENT = re.compile(r"^\s*//.*\n|/\*\*(?:[^*]|\*(?!/))*\*/\s*", re.MULTILINE)
_REMARK = re.compile(r"^/\*.*\*/\n", re.MULTILINE)
_INDENT = re.compile(r"^\s+", re.MULTILINE)
# around marks of a style sheet, and after the name of what is set
_SPACE = re.compile(r"\s*([{};,])\s*|(?<=[\w-])(:) ")


def script(entry: str) -> str:
    """Return a module and all it imports as one script, each after what it needs.

    A page opened from a file loads no modules; names at the top of modules are told apart by a test.
    """
    return "".join(
        _INDENT.sub("", _COMMENT.sub("", _EXPORT.sub("", _IMPORT.sub("", item)))) for item in _in_order(entry)
    )


def _in_order(entry: str) -> Iterator[str]:
    done: set[str] = set()

    def visit(name: str) -> Iterator[str]:
        if name not in done:
            done.add(name)
            text = read_resource("browser", f"{name}.js")
            for needed in _IMPORT.findall(text):
                yield from visit(needed)
            yield text

    yield from visit(entry)


def style(*names: str) -> str:
    """Return style sheets as one."""
    return "".join(_SPACE.sub(r"\1\2", _REMARK.sub("", read_resource("browser", f"{name}.css"))) for name in names)


def modules() -> list[str]:
    """Return the names of all modules."""
    return resource_names("browser", ".js")
