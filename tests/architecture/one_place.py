"""The functions in which values of a quantity get their key, found in the syntax trees of the calculation.

A key is a text that begins with the key of a quantity: a literal, an f-string, a name of the module, a variable, an
element that a loop runs over, or an argument, which counts where it is passed. A value gets it by `named`, `given`,
`total`, `TracedValue` or `Key`, by a call of a registered formula, as key of a dict or as first of a pair that is
yielded or returned. `absent` is no value; what is read (`trace["key"]`), selected under its own key or delayed has its
key already.

`PYTHONPATH=src:tests python tests/architecture/one_place.py` prints what stands in `one_place.txt`.
"""

from __future__ import annotations

import ast
import itertools
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from crankwork.quantities import QUANTITIES
from rules import PACKAGE, source_trees

# where values get their keys; `formula` passes them on
PACKAGES = ("analysis", "cylinders", "dynamics", "loads", "preparation", "shaft")
_READ = (*PACKAGES, "formula")
# sizes of columns by quantity, no values
_SIZES = "analysis.rounding_noise"
LIST = Path(__file__).with_suffix(".txt")
# what gives a key, and the position of the argument
_GIVES = {"given": 0, "total": 0, "sum_terms": 0, "TracedValue": 1, "Key": 0, "setdefault": 0}
# arguments of these hold no results, but numbers of messages
_NO_RESULTS = ("Notice", "ErrorMessage")
# what is absent, and what has its key already
_NO_NEW = ("absent", "delayed")
_UNKNOWN = "\0"
_MOST = 100
_PASSES = 6
_DEPTH = 8


class Text(NamedTuple):
    """A text that an expression may have, up to what is not known of it, and the function that holds its beginning."""

    text: str
    place: str

    @property
    def quantity(self) -> str:
        """The quantity that it begins with, empty if none."""
        # what follows a quantity and is not known is an owner
        quantity = self.text.rstrip(_UNKNOWN).partition(".")[0]
        return quantity if quantity in QUANTITIES else ""


class _Function:
    """A function with what its names may hold."""

    def __init__(self, module: _Module, node: ast.FunctionDef, place: str, outer: _Function | None) -> None:
        self.module, self.node, self.place, self.outer = module, node, place, outer
        arguments = (*node.args.posonlyargs, *node.args.args)
        self.arguments = [argument.arg for argument in arguments if argument.arg not in ("self", "cls")]
        self.names = {*self.arguments, *(argument.arg for argument in node.args.kwonlyargs)}
        self.passed: dict[str, set[Text]] = defaultdict(set)
        self.values: dict[str, list[tuple[ast.expr, tuple[int | str, ...]]]] = defaultdict(list)
        for argument, default in zip(reversed(arguments), reversed(node.args.defaults), strict=False):
            self.values[argument.arg].append((default, ()))
        for argument, default in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True):
            if default is not None:
                self.values[argument.arg].append((default, ()))
        self.nodes = list(_own_nodes(node))
        self.calls = [item for item in self.nodes if isinstance(item, ast.Call)]
        for item in self.nodes:
            match item:
                case ast.Assign(targets=targets, value=value):
                    for target in targets:
                        self._bind(target, value, ())
                case ast.AnnAssign(target=target, value=ast.expr() as value):
                    self._bind(target, value, ())
                case ast.NamedExpr(target=target, value=value):
                    self._bind(target, value, ())
                case ast.For(target=target, iter=value) | ast.comprehension(target=target, iter=value):
                    self._bind(target, value, ("each",))

    def _bind(self, target: ast.expr, value: ast.expr, path: tuple[int | str, ...]) -> None:
        """Keep what a name is bound to: an expression, and which element of it."""
        match target:
            case ast.Name(id=name):
                self.values[name].append((value, path))
            case ast.Tuple(elts=parts) | ast.List(elts=parts):
                for index, part in enumerate(parts):
                    self._bind(part, value, (*path, index))


class _Module:
    """A module: its constants and the constants that it imports."""

    def __init__(self, path: Path, tree: ast.Module) -> None:
        self.name = ".".join(path.relative_to(PACKAGE).with_suffix("").parts)
        self.constants: dict[str, tuple[ast.expr, tuple[int | str, ...]]] = {}
        self.imported: dict[str, tuple[str, str]] = {}
        for node in tree.body:
            match node:
                case ast.Assign(targets=[ast.Name(id=name)], value=value):
                    self.constants[name] = value, ()
                case ast.Assign(targets=[ast.Tuple(elts=parts)], value=value):
                    for index, part in enumerate(parts):
                        if isinstance(part, ast.Name):
                            self.constants[part.id] = value, (index,)
                case ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value):
                    self.constants[name] = value, ()
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("crankwork."):
                for alias in node.names:
                    self.imported[alias.asname or alias.name] = ((node.module or "")[len("crankwork.") :], alias.name)


def _own_nodes(node: ast.FunctionDef) -> Iterator[ast.AST]:
    """Yield the nodes of a function without those of functions inside it."""
    rest: list[ast.AST] = [part for part in node.body if not isinstance(part, ast.FunctionDef | ast.ClassDef)]
    yield from rest
    while rest:
        for child in ast.iter_child_nodes(rest.pop()):
            if not isinstance(child, ast.FunctionDef | ast.ClassDef):
                yield child
                rest.append(child)


def _functions(module: _Module, node: ast.AST, name: str, outer: _Function | None) -> Iterator[_Function]:
    for child in ast.iter_child_nodes(node):
        match child:
            case ast.FunctionDef(name=own):
                function = _Function(module, child, f"{name}.{own}", outer)
                yield function
                yield from _functions(module, child, function.place, function)
            case ast.ClassDef(name=own):
                yield from _functions(module, child, f"{name}.{own}", outer)
            case ast.stmt():
                yield from _functions(module, child, name, outer)


class _Reader:
    """What expressions of the calculation may be as texts."""

    def __init__(self) -> None:
        trees = {
            path: tree for path, tree in source_trees().items() if path.relative_to(PACKAGE).parts[0] in _READ
        }  # fmt: skip
        modules = {path: _Module(path, tree) for path, tree in trees.items()}
        self.modules = {module.name: module for module in modules.values()}
        self.functions = [
            function
            for path, tree in trees.items()
            for function in _functions(modules[path], tree, modules[path].name, None)
        ]
        self.called: dict[str, list[_Function]] = defaultdict(list)
        self.formulas: dict[str, str] = {}
        for function in self.functions:
            self.called[function.node.name].append(function)
            for decorator in function.node.decorator_list:
                match decorator:
                    case ast.Call(func=ast.Name(id="formula"), args=[ast.Constant(value=quantity), *_]):
                        self.formulas[function.node.name] = quantity
        # texts pass through as many functions as call each other with them
        self._known: dict[tuple[object, ...], set[Text]] = {}
        for _ in range(_PASSES):
            if not sum(self._pass_arguments(function) for function in self.functions):
                break
            self._known.clear()

    def _pass_arguments(self, function: _Function) -> bool:
        """Keep the texts that a function passes to others; return whether there are new ones."""
        is_new = False
        for call in function.calls:
            if (name := _name_of(call.func)) in self.formulas or name in _NO_NEW:
                continue
            for target in self.called.get(name, ()):
                pairs = [*zip(target.arguments, call.args, strict=False)]
                pairs += [(keyword.arg, keyword.value) for keyword in call.keywords if keyword.arg in target.names]
                for argument, value in pairs:
                    texts = {text for text in self.texts(value, function, ()) if text.text != _UNKNOWN}
                    is_new |= not texts <= target.passed[argument]
                    target.passed[argument] |= texts
        return is_new

    def texts(self, node: ast.expr, function: _Function | _Module, path: tuple[int | str, ...]) -> set[Text]:
        """Return the texts that an expression, or what stands at a path of positions in it, may be."""
        known = id(node), id(function), path
        if known not in self._known:
            # what depends on itself adds nothing
            self._known[known] = set()
            self._known[known] = self._texts(node, function, path) if len(path) < _DEPTH else set()
        return self._known[known]

    def _texts(  # noqa: C901, PLR0912 - a case for each kind of node
        self, node: ast.expr, function: _Function | _Module, path: tuple[int | str, ...]
    ) -> set[Text]:
        place = function.place if isinstance(function, _Function) else ""

        def of(part: ast.expr, own: tuple[int | str, ...] = path) -> set[Text]:
            return self.texts(part, function, own)

        match node:
            case ast.Constant(value=str(text)) if not path:
                return {Text(text, place)}
            case ast.JoinedStr(values=parts) if not path:
                return self._joined(
                    [of(part.value) if isinstance(part, ast.FormattedValue) else of(part) for part in parts], place
                )
            case ast.BinOp(left=left, op=ast.Add(), right=right) if not path:
                return self._joined([of(left), of(right)], place)
            case ast.BinOp(left=left, op=ast.Add() | ast.BitOr(), right=right):
                return of(left) | of(right)
            case ast.IfExp(body=body, orelse=other):
                return of(body) | of(other)
            case ast.BoolOp(values=parts):
                return set().union(*map(of, parts))
            case ast.Name(id=name):
                return self._of_name(name, function, path)
            case ast.Tuple(elts=parts) | ast.List(elts=parts) | ast.Set(elts=parts) if path:
                return self._of_display(parts, path, of)
            case ast.Dict(keys=keys) if path and path[0] == "each":
                return set().union(
                    *(
                        of(key, path[1:]) if key is not None else of(value)
                        for key, value in zip(keys, node.values, strict=True)
                    )
                )
            case ast.ListComp(elt=element) | ast.GeneratorExp(elt=element) | ast.SetComp(elt=element) if (
                path and path[0] == "each"
            ):
                return of(element, path[1:])
            case ast.Subscript(value=value, slice=ast.Slice()) if path:
                return of(value)
            case ast.Subscript(value=value, slice=ast.Constant(value=int(index))):
                return of(value, (index, *path))
            case ast.Subscript(value=value) if isinstance(value, ast.Name | ast.Dict | ast.Subscript):
                return of(value, ("values", *path))
            case ast.Call(func=ast.Attribute(attr="derived", value=value), args=[suffix]) if not path:
                return self._joined([of(value), of(suffix)], place)
            case ast.Call(
                func=ast.Name(id="str" | "key_of" | "tuple" | "list" | "sorted" | "set" | "reversed"), args=[value]
            ):
                return of(value)
            case ast.Call(func=ast.Attribute(attr="fromkeys"), args=[value, *_]) if path and path[0] == "each":
                return of(value)
            case ast.Call(func=ast.Name(id="zip"), args=parts) if len(path) > 1 and path[0] == "each":
                index = path[1]
                return of(parts[index], ("each", *path[2:])) if isinstance(index, int) and index < len(parts) else set()
            case ast.Call(func=ast.Name(id="enumerate"), args=[value, *_]) if len(path) > 1:
                return of(value, ("each", *path[2:])) if path[1] == 1 else {Text(_UNKNOWN, place)}
            case ast.Call(func=ast.Attribute(attr="items", value=value), args=[]) if len(path) > 1:
                return of(value, ("each" if path[1] == 0 else "values", *path[2:]))
            case ast.Call(func=ast.Attribute(attr="keys", value=value), args=[]):
                return of(value)
            case ast.Call(func=ast.Attribute(attr="values", value=value), args=[]) if path:
                return of(value, ("values", *path[1:]))
            case ast.Dict(values=values) if path and path[0] == "values":
                return set().union(*(of(value, path[1:]) for value in values))
            case ast.Dict(values=values) if path and isinstance(path[0], str | int):
                return set().union(*(of(value, path[1:]) for value in values))
        return {Text(_UNKNOWN, place)}

    @staticmethod
    def _of_display(parts: list[ast.expr], path: tuple[int | str, ...], of: object) -> set[Text]:
        """Return the texts of an element of a tuple, or of all."""
        index, rest = path[0], path[1:]
        if isinstance(index, int) and not any(isinstance(part, ast.Starred) for part in parts):
            return of(parts[index], rest) if -len(parts) <= index < len(parts) else set()  # type: ignore[operator]
        return set().union(
            *(of(part.value, ("each", *rest)) if isinstance(part, ast.Starred) else of(part, rest) for part in parts)  # type: ignore[operator]
        )

    def _of_name(self, name: str, function: _Function | _Module, path: tuple[int | str, ...]) -> set[Text]:
        texts = set[Text]()
        scope: _Function | _Module | None = function
        while isinstance(scope, _Function):
            if name in scope.names or name in scope.values:
                for value, own in scope.values[name]:
                    texts |= self.texts(value, scope, (*own, *path))
                return texts | (scope.passed[name] if not path else set()) or {Text(_UNKNOWN, function.place)}  # type: ignore[union-attr]
            scope = scope.outer or scope.module
        module = scope
        place = function.place if isinstance(function, _Function) else ""
        if module is not None and name in module.imported:
            source, name = module.imported[name]
            module = self.modules.get(source)
        if module is None or name not in module.constants:
            return {Text(_UNKNOWN, place)}
        value, own = module.constants[name]
        return {Text(text.text, place) for text in self.texts(value, module, (*own, *path))}

    @staticmethod
    def _joined(parts: list[set[Text]], place: str) -> set[Text]:
        """Return the texts of a text in parts; it is the function that joins them that completes a quantity."""
        texts = {Text("", place)}
        for choices in parts:
            joined = set[Text]()
            for before, after in itertools.product(sorted(texts)[:_MOST], sorted(choices)[:_MOST]):
                if before.text.endswith(_UNKNOWN):
                    joined.add(before)
                elif not before.text:
                    joined.add(after)
                else:
                    ends = "." in before.text or after.text.startswith(".")
                    joined.add(Text(before.text + after.text, before.place if ends else place))
            texts = joined or {Text(_UNKNOWN, place)}
        return texts

    def keys(self, function: _Function) -> Iterator[set[Text]]:  # noqa: C901, PLR0912 - as above
        """Yield the keys that a function gives."""
        renamed, unkeyed = set[int](), set[int]()
        for node in function.nodes:
            match node:
                case ast.Call(func=ast.Attribute(attr="named", value=value)):
                    renamed.add(id(value))
                case ast.Call(func=ast.Name(id=name)) if name in _NO_RESULTS:
                    unkeyed.update(map(id, ast.walk(node)))
                case ast.Call(func=ast.Name(id="float"), args=[value]):
                    renamed.add(id(value))
        for node in function.nodes:
            if id(node) in unkeyed:
                continue
            match node:
                case ast.Call(func=func, args=args):
                    name = _name_of(func)
                    if name in self.formulas and id(node) not in renamed:
                        yield {Text(self.formulas[name], function.place)}
                    elif name == "named" and args:
                        yield self.texts(args[-1], function, ())
                    elif name == "dict" and args and isinstance(args[0], ast.Call) and _name_of(args[0].func) == "zip":
                        yield self.texts(args[0], function, ("each", 0))
                    elif name in _GIVES and len(args) > _GIVES[name]:
                        yield self.texts(args[_GIVES[name]], function, ())
                case ast.Dict(keys=keys, values=values):
                    for key, value in zip(keys, values, strict=True):
                        if key is not None and not _is_selected(key, value):
                            yield self.texts(key, function, ())
                case ast.DictComp(key=key, value=value) if not isinstance(value, ast.Subscript):
                    if _is_selected(key, value):
                        continue
                    yield self.texts(key, function, ())
                case ast.Assign(targets=targets, value=value):
                    for target in targets:
                        if isinstance(target, ast.Subscript) and not _is_selected(target.slice, value):
                            yield self.texts(target.slice, function, ())
                case (
                    ast.Yield(value=ast.Tuple(elts=[key, value, *_]))
                    | ast.Return(value=ast.Tuple(elts=[key, value, *_]))
                ) if not _is_selected(key, value):
                    yield self.texts(key, function, ())


def _name_of(function: ast.expr) -> str:
    return (
        function.id if isinstance(function, ast.Name) else function.attr if isinstance(function, ast.Attribute) else ""
    )


def _is_selected(key: ast.expr, value: ast.expr) -> bool:
    """Return whether a value is taken from others under the key that it had there, or is a text or several."""
    match value:
        case ast.Name() if ast.dump(value) == ast.dump(key):
            return True
        case ast.Constant(value=str()) | ast.JoinedStr() | ast.Tuple() | ast.Call(func=ast.Name(id="own_key")):
            return True
        case ast.Call(func=ast.Attribute(attr="named", value=selected), args=[own]) if ast.dump(own) == ast.dump(key):
            return _is_selected(key, selected)
        case ast.Subscript(slice=own) | ast.Call(func=ast.Attribute(attr="get"), args=[own, *_]):
            return ast.dump(own) == ast.dump(key)
    return False


@cache
def places() -> Mapping[str, tuple[str, ...]]:
    """Return the functions that give keys of each quantity."""
    reader, result = _Reader(), defaultdict[str, set[str]](set)
    for function in reader.functions:
        if function.module.name == _SIZES:
            continue
        for texts in reader.keys(function):
            for text in texts:
                if text.quantity and text.place.partition(".")[0] in PACKAGES:
                    result[text.quantity].add(text.place)
    return {quantity: tuple(sorted(result[quantity])) for quantity in sorted(result)}


def several() -> dict[str, tuple[str, ...]]:
    """Return the quantities that have more than one place, with their places."""
    return {quantity: found for quantity, found in places().items() if len(found) > 1}


def listed() -> dict[str, tuple[str, ...]]:
    """Return the quantities that may have more than one place, with their places."""
    rows = (line.split() for line in LIST.read_text("utf-8").splitlines())
    return {quantity: tuple(own) for quantity, *own in rows}


def main() -> None:
    """Print the list."""
    for quantity, own in several().items():
        sys.stdout.write(f"{quantity} {' '.join(own)}\n")


if __name__ == "__main__":
    main()
