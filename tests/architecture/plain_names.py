"""Words that no identifier of the source should have, and how many each package still has.

`PYTHONPATH=tests python tests/architecture/plain_names.py` prints what stands in `plain_names.txt`, and with the name
of a package where each of its words stands.
"""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from rules import PACKAGE, source_trees

# parts of identifiers: private words, each of which has several meanings
# fmt: off
WORDS = frozenset({
    "told", "retold", "tell", "say", "said", "spoken", "asked", "asking", "sought", "boundless", "loose", "rubbing",
    "rubbed", "rubs", "felt", "unfelt", "glide", "glided", "knowns", "memories", "remembered", "remember",
    "remembers", "apart", "beside", "alike", "aside", "anew", "upon", "beneath", "complain", "doubts", "doubt",
    "stands", "goes", "let", "nothing", "lingers", "patient", "creep", "led", "brief", "sound", "nobody",
    "deserted", "twins", "blows", "bearer", "bearers", "unsaid", "unsure", "misleading", "gone", "course",
    "courses", "spare", "talls", "looked", "laid", "happen", "saw", "slave", "slaves",
})
# fmt: on
# names of variables and arguments that say nothing of what they hold
NAMES = frozenset({"one", "every", "some", "found", "at", "of", "by", "here", "there", "others", "whole", "way"})
LIST = Path(__file__).with_suffix(".txt")


def _parts(identifier: str) -> Iterator[str]:
    """Yield the words of an identifier in snake or camel case, in lower case."""
    for word in identifier.split("_"):
        yield from (part.lower() for part in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", word))


def _identifiers(tree: ast.Module) -> Iterator[tuple[str, int, bool]]:
    """Yield what a module names, on which line, and whether it is a variable or an argument."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef() | ast.ClassDef():
                yield node.name, node.lineno, False
            case ast.arg():
                yield node.arg, node.lineno, True
            case ast.Name(ctx=ast.Store()):
                yield node.id, node.lineno, True
            case ast.Attribute(ctx=ast.Store()):
                yield node.attr, node.lineno, False


def _allowed(tree: ast.Module) -> set[int]:
    """Return where a module has arguments of what users call and of formulas, whose names are their notation."""
    return {
        argument.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
        and any("formula" in ast.unparse(decorator) for decorator in node.decorator_list)
        for argument in (*node.args.args, *node.args.kwonlyargs)
    }


def findings() -> Iterator[tuple[str, str, int, str]]:
    """Yield package, module, line and identifier of everything that should have another name."""
    for path, tree in source_trees().items():
        place = path.relative_to(PACKAGE)
        package = place.parts[0] if len(place.parts) > 1 else place.stem
        if place.stem != package:
            yield from ((package, str(place), 0, word) for word in WORDS & {*_parts(place.stem)})
        formulas = _allowed(tree)
        for name, line, is_variable in _identifiers(tree):
            if line in formulas:
                continue
            if WORDS & {*_parts(name)} or (is_variable and name in NAMES):
                yield package, str(place), line, name


def counts() -> Counter[str]:
    """Return how many names each package should change."""
    return Counter(package for package, *_ in findings())


def listed() -> dict[str, int]:
    """Return how many names each package may still have."""
    rows = (line.split() for line in LIST.read_text("utf-8").splitlines())
    return {package: int(count) for count, package in rows}


def main() -> None:
    """Print the list, or what stands in it for one package."""
    if len(sys.argv) > 1:
        for package, place, line, name in findings():
            if package == sys.argv[1]:
                sys.stdout.write(f"{place}:{line}: {name}\n")
        return
    for package, count in sorted(counts().items()):
        sys.stdout.write(f"{count} {package}\n")


if __name__ == "__main__":
    main()
