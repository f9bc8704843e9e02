"""Every public name says what it is, and every number it takes says its unit."""

from __future__ import annotations

import ast
import re

import crankwork

ROOMS = ("kinematics/", "loads/", "working_cycle/", "dynamics/", "shaft/", "cylinders/")
NUMERIC = re.compile(r"\b(array|arrays|float|ArrayLike|Array|CrankGrid)\b")
UNIT = re.compile(r"\[[^\]\s][^\]]*\]")
SECTION = re.compile(r"^(\w+)\n-{3,}$", re.MULTILINE)
HEADER = re.compile(r"(?P<names>[*\w]+(?:, [*\w]+)*) : (?P<type>.+)")


def test_every_public_function_and_class_has_a_docstring(modules):
    assert [place for place, _, said in _documented(modules) if not said] == []


def test_every_documented_parameter_exists_and_the_other_way_round(modules):
    differences = [
        f"{place}: documents {documented}, takes {taken}"
        for place, node, said in _documented(modules)
        if isinstance(node, ast.FunctionDef)
        and (documented := [one for block in _parameters(said) for one in block[0]])
        and documented != (taken := _arguments(node))
    ]
    assert differences == []


def test_numbers_of_the_calculation_have_units(modules):
    missing = [
        f"{place}: {', '.join(names)}"
        for place, _, said in _documented(modules)
        if place.startswith(ROOMS)
        for names, kind, text in _parameters(said)
        if NUMERIC.search(kind) and len(UNIT.findall(text)) not in (1, len(names))
    ]
    assert missing == []


def test_only_what_users_import_has_sections(modules):
    """Of a formula notation says all that a section would."""
    long = [
        place for place, node, said in _documented(modules) if set(SECTION.findall(said)) - _sections(place, node, said)
    ]
    assert long == []


def _documented(modules):
    """Give every public function, class and method: where it is, what it is, and what it says of itself."""
    for module in modules:
        for name, node in _public(module.tree):
            yield f"{module.path}:{node.lineno}: {name}", node, ast.get_docstring(node) or ""


def _sections(place, node, said):
    """Return the sections that a docstring may have."""
    if any(isinstance(one, ast.Call) and ast.unparse(one.func) == "formula" for one in node.decorator_list):
        return {"Notes"}
    path, _, name = place.split(":")
    of_results = (path.removesuffix(".py").replace("/", "."), name.strip()) in crankwork._METHODS.values()
    if path == "machine.py" or of_results or name.strip().partition(".")[0] in crankwork.__all__:
        return {*SECTION.findall(said)}
    return {"Examples", "Notes"}


def _public(tree, prefix=""):
    """Give every public function, class and method with its dotted name."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            yield prefix + node.name, node
            if isinstance(node, ast.ClassDef):
                yield from _public(node, f"{prefix}{node.name}.")


def _arguments(node: ast.FunctionDef) -> list[str]:
    spec = node.args
    names = [one.arg for one in (*spec.posonlyargs, *spec.args)]
    names += [f"*{spec.vararg.arg}"] if spec.vararg else []
    names += [one.arg for one in spec.kwonlyargs]
    names += [f"**{spec.kwarg.arg}"] if spec.kwarg else []
    return [name for name in names if name not in ("self", "cls")]


def _parameters(docstring: str) -> list[tuple[list[str], str, str]]:
    """Return names, type and description of each block of the section Parameters."""
    _, _, rest = docstring.partition("Parameters\n----------\n")
    section = re.split(r"\n\n\w[\w ]*\n-{3,}\n", rest)[0]
    blocks: list[tuple[list[str], str, str]] = []
    for line in section.splitlines():
        header = HEADER.fullmatch(line)
        if header:
            blocks.append((header["names"].split(", "), header["type"], ""))
        elif blocks and line.strip():
            names, kind, text = blocks[-1]
            blocks[-1] = (names, kind, f"{text} {line.strip()}")
    return blocks


def test_how_a_docstring_is_read():
    docstring = (
        "Return the sum.\n\nParameters\n----------\nr, l : array, shape (n,)\n    Lengths. [m]\ncount : int\n"
        "    Two\n    lines.\n\nReturns\n-------\ntotal : float\n    Sum. [m]\n"
    )
    assert _parameters("Return nothing.") == []
    assert _parameters(docstring) == [
        (["r", "l"], "array, shape (n,)", " Lengths. [m]"),
        (["count"], "int", " Two lines."),
    ]
