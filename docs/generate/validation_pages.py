"""The pages of validation: what the tests of `tests/literature` compare, by source."""

from __future__ import annotations

import ast
import io
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tokenize
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from crankwork.quantities import QUANTITIES, base_key
from html_text import code, raw, sentence, table, text

ROOT = Path(__file__).parents[2]
LITERATURE = ROOT / "tests" / "literature"
_REMARK = re.compile(
    r"\bprint|\bslip|misprint|\bround|\bcut\b|wrong|notebook|the book|\bnote has|contradict|error|takes .* for"
)
_KEY = re.compile(r"""['"]([a-z]\w+(?:[.@][^'"]*)?)['"]""")
# a wider tolerance is that of a number printed with few digits [-]
_FEW_DIGITS = 1e-6
_HEAD = """\
# Validation

Numbers that others printed, beside what crankwork computes. The tests of `tests/literature` hold the expected
numbers: as printed, or recalculated from the source without crankwork where it prints few digits or slips. This page
is made by running them and noting what each of them compares, so it shows nothing that is not tested. A test that
fails stops the build of this site.

**{sources} sources, {comparisons} comparisons of {numbers} numbers.** {few} of the compared values are known to few
digits; they differ by {few_median} in the median, within the tolerance of each. {many} are known to more digits than
six; the largest difference of these is {many_largest}. Where a source contradicts itself, the remarks below its table
name the slip.

Of many numbers compared at once the row shows the one that differs most. *Allowed* is the tolerance of the test, as a
rule half of the last printed digit, in the unit of the value. Values are in SI units unless the test converts them to
those of the source.
"""
_SOURCES = ("Source", "Numbers", "Median difference", "Largest difference", "Remarks")
_SHOWN_FIRST = 6
_HEADINGS = ("Case", "What", "Printed or recalculated", "Computed", "Difference", "Allowed")


def start(file: Path) -> subprocess.Popen[bytes]:
    """Begin to run the tests of literature with their comparisons noted in a file."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "comparisons", "--part", "light",
               "--comparisons", str(file), str(LITERATURE)]  # fmt: skip
    paths = os.pathsep.join([str(ROOT / "src"), str(ROOT / "tests"), str(Path(__file__).parent)])
    return subprocess.Popen(command, cwd=ROOT, env={**os.environ, "PYTHONPATH": paths}, stdout=subprocess.PIPE)


def finish(process: subprocess.Popen[bytes], file: Path) -> list[dict[str, Any]]:
    """Return the notes; a test that fails stops everything."""
    said, _ = process.communicate()
    if process.returncode:
        raise SystemExit(f"tests of literature fail:\n{said.decode()[-3000:]}")
    notes: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))
    return notes


class Module(NamedTuple):
    """A module of tests: its source, and remarks of comments by line."""

    name: str
    title: str
    source: str
    comments: Mapping[int, str]
    lines: list[str]
    slips: tuple[tuple[str, str], ...]

    @classmethod
    def read(cls, name: str) -> Module:
        """Read a module."""
        written = (LITERATURE / f"{name}.py").read_text(encoding="utf-8")
        tree = ast.parse(written)
        title, _, source = (ast.get_docstring(tree) or name).partition("\n\n")
        comments = {
            token.start[0]: token.string.lstrip("# ")
            for token in tokenize.generate_tokens(io.StringIO(written).readline)
            if token.type == tokenize.COMMENT and not token.string.startswith(("# fmt", "# noqa", "# type"))
        }
        slips = tuple(
            (node.name.removeprefix("test_").replace("_", " "), ast.get_docstring(node) or "")
            for node in ast.walk(tree)
            if isinstance(node, ast.FunctionDef) and re.search(r"\bslips?\b", node.name.replace("_", " "))
        )
        return cls(name, title.replace("\n", " "), source, comments, written.splitlines(), slips)

    def before(self, line: int) -> str:
        """Return the comment that ends above a line, or stands behind it."""
        above = []
        while (line := line - 1) in self.comments and self.lines[line - 1].lstrip().startswith("#"):
            above.append(self.comments[line])
        return " ".join(reversed(above))

    def about(self, case: str) -> str:
        """Return the comment above a case of a table."""
        place = next((at for at, line in enumerate(self.lines, 1) if line.strip().startswith(f'"{case}"')), 0)
        return self.before(place) if place else ""

    def remarks(self) -> list[str]:
        """Return the comments that tell where a source differs from itself or from the calculation."""
        found, line = [], 0
        for at in sorted(self.comments):
            if at == line + 1 and found and self.lines[at - 1].lstrip().startswith("#"):
                found[-1] += f" {self.comments[at]}"
            else:
                found.append(self.comments[at])
            line = at
        return [remark for remark in found if _REMARK.search(remark)]


def _case(note: Mapping[str, Any], module: Module) -> str:
    name = note["names"].get("name") or note["names"].get("case")
    if isinstance(name, str):
        about = module.about(name)
        return f"<strong>{text(name)}</strong>{'<br>' if about else ''}{text(about)}"
    said = (note["case"] or note["said"]).partition("\n\n")[0].replace("\n", " ")
    plain = note["test"].split("::")[-1].partition("[")[0].removeprefix("test_").replace("_", " ")
    return text(sentence(said or plain))


def _quantity(note: Mapping[str, Any]) -> str:
    stated = [note["key"], note["names"].get("key", ""), *_KEY.findall(note["written"])]
    key = next((key for key in stated if isinstance(key, str) and base_key(key.partition("@")[0]) in QUANTITIES), "")
    if not key:
        return code(note["key"] or note["written"])
    link = f"../reference/en/results/{_subject(base_key(key))}.html#{base_key(key)}"
    return f'<a href="{link}">{text(QUANTITIES[base_key(key)].label("en"))}</a><br>{code(key)}'


def _subject(key: str) -> str:
    from crankwork.quantities import SUBJECTS

    return next(name for name, rows in SUBJECTS.items() if any(row.key == key for row in rows))


def difference(note: Mapping[str, Any]) -> float:
    """Return the difference over the printed value, or itself where that is zero."""
    size = abs(note["printed"])
    return abs(note["found"] - note["printed"]) / (size or 1.0)


def _row(note: Mapping[str, Any], module: Module) -> tuple[str, ...]:
    count = f" (the largest of {note['count']})" if note["count"] > 1 else ""
    if note["kind"] == "limit":
        return (
            _case(note, module),
            code(note["written"]),
            "–",
            "–",
            f"{note['found']:.3g}{count}",
            f"{note['printed']:.3g}",
        )
    apart = difference(note)
    shown = f"{apart:.1e}" if 0 < apart < 1e-3 else f"{100 * apart:.2g} %"
    allowed = note["allowed"]
    return (
        _case(note, module),
        _quantity(note),
        f"{note['printed']:.10g}",
        f"{note['found']:.10g}",
        ("0" if apart == 0 else shown if note["printed"] else f"{apart:.1e}") + count,
        "exact" if not allowed else f"± {allowed:.2g}",
    )


def _by_module(notes: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    by_module: dict[str, list[dict[str, Any]]] = {}
    for note in notes:
        by_module.setdefault(note["module"], []).append(note)
    return dict(sorted(by_module.items()))


def _differences(notes: list[dict[str, Any]]) -> list[float]:
    return [difference(note) for note in notes if note["kind"] == "value" and note["printed"]]


def _source_row(module: Module, notes: list[dict[str, Any]], folder: str = "") -> tuple[str, ...]:
    own = _differences(notes)
    return (
        f'<a href="{folder}{module.name.removeprefix("test_")}.html">{text(module.title)}</a>',
        str(sum(note["count"] for note in notes)),
        f"{statistics.median(own):.1e}" if own else "–",
        f"{max(own):.1e}" if own else "–",
        str(len(module.remarks()) + len(module.slips)),
    )


def short(notes: list[dict[str, Any]]) -> str:
    """Return for the first page how many numbers there are, and the sources with the most comparisons."""
    by_module = _by_module(notes)
    most = sorted(by_module, key=lambda name: -len(_differences(by_module[name])))[:_SHOWN_FIRST]
    rows = [_source_row(Module.read(name), by_module[name], "validation/") for name in most]
    numbers = sum(note["count"] for note in notes)
    return (
        f"**{len(by_module)} sources, {len(notes)} comparisons of {numbers} numbers**; those with the most comparisons:"
        f"\n\n{raw([table(_SOURCES, rows)])}"
    )


def pages(notes: list[dict[str, Any]]) -> Iterator[tuple[str, str]]:
    """Yield the name of each page, without its ending, and its text."""
    by_module = _by_module(notes)
    modules = {name: Module.read(name) for name in by_module}
    values = [note for note in notes if note["kind"] == "value" and note["printed"]]
    digits = [note for note in values if (note["allowed"] or 0.0) > _FEW_DIGITS * abs(note["printed"])]
    many = [note for note in values if note not in digits]
    rows = [_source_row(module, by_module[name]) for name, module in modules.items()]
    head = _HEAD.format(
        sources=len(modules),
        comparisons=len(notes),
        numbers=sum(note["count"] for note in notes),
        few=len(digits),
        few_median=f"{100 * statistics.median(map(difference, digits)):.2g} %",
        many=len(many),
        many_largest=f"{max(map(difference, many)):.0e}",
    )
    toctree = "\n".join(["```{toctree}", ":hidden:", "", *(name.removeprefix("test_") for name in modules), "```"])
    yield "index", "\n".join([head, raw([table(_SOURCES, rows)]), toctree])
    for name, module in modules.items():
        yield name.removeprefix("test_"), _page(module, by_module[name])


def _page(module: Module, notes: list[dict[str, Any]]) -> str:
    rows = dict.fromkeys(_row(note, module) for note in notes if math.isfinite(note["found"]))
    parts = [f"# {module.title.rstrip('.')}\n", raw(f"<p>{text(part)}</p>" for part in module.source.split("\n\n"))]
    parts.append(raw([table(_HEADINGS, rows)]))
    told = [f"<li>{text(sentence(f'{name}: {said}' if said else name))}</li>" for name, said in module.slips]
    told += [f"<li>{text(sentence(remark))}</li>" for remark in dict.fromkeys(module.remarks())]
    if told:
        parts += ["## Slips and remarks\n", raw(["<ul>", *told, "</ul>"])]
    parts.append(f"The test: `tests/literature/{module.name}.py`.\n")
    return "\n".join(parts)
