"""How the source is divided, and who touches the disk."""

from __future__ import annotations

import ast

ALWAYS_DISK = {"makedirs", "mkdir", "read_bytes", "read_text", "rename", "rmdir", "touch", "unlink", "write_bytes",
               "write_text"}  # fmt: skip


def test_only_files_touches_the_disk(modules):
    calls = [
        f"{module.path}:{node.lineno}: {ast.unparse(node.func)}"
        for module in modules
        if module.path not in ("files.py", "resources.py")
        for node in ast.walk(module.tree)
        if isinstance(node, ast.Call) and _touches_the_disk(node)
    ]
    assert calls == []


def _touches_the_disk(call: ast.Call) -> bool:
    match call.func:
        case ast.Name("open"):
            return True
        case ast.Attribute(ast.Name("files"), _) | ast.Attribute(ast.Name("webbrowser"), "open"):
            return False
        case ast.Attribute(_, "open"):
            return True
        case ast.Attribute(ast.Name("os"), "replace" | "remove"):
            return True
        case ast.Attribute(_, "replace"):
            # str.replace takes two arguments, dataclasses.replace names what it replaces
            return len(call.args) == 1 and not call.keywords
        case ast.Attribute(_, name):
            return name in ALWAYS_DISK
    return False


COUNTED = {
    "open(name)": True,
    "path.open('w')": True,
    "path.replace(other)": True,
    "os.replace(one, other)": True,
    "path.parent.mkdir(parents=True)": True,
    "resources.files('crankwork').joinpath(name).read_text('utf-8')": True,
    "text.replace('.', ',')": False,
    "replace(method, order=2)": False,
    "dataclasses.replace(method, order=2)": False,
    "webbrowser.open(address)": False,
    "files.read_text(path)": False,
}


def test_what_counts_as_touching_the_disk():
    assert {code: _touches_the_disk(ast.parse(code, mode="eval").body) for code in COUNTED} == COUNTED


def test_files_stay_readable(modules):
    assert [module.path for module in modules if len(module.text.splitlines()) > 1000] == []


def test_every_all_is_sorted(modules):
    found = {
        module.path: ast.literal_eval(node.value)
        for module in modules
        for node in module.tree.body
        # names that are computed are not literals, and sorted where they are computed
        if isinstance(node, ast.Assign | ast.AnnAssign) and _assigns_all(node)
        if isinstance(node.value, ast.List | ast.Tuple)
    }
    assert {path: names for path, names in found.items() if list(names) != sorted(names)} == {}


def _assigns_all(node: ast.Assign | ast.AnnAssign) -> bool:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return any(isinstance(target, ast.Name) and target.id == "__all__" for target in targets)
