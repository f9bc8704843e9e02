"""The reference of keys: every key of machine files and study files, from the types that read them.

`PYTHONPATH=src python docs/generate/key_pages.py` prints the keys without a meaning of their own.
"""

from __future__ import annotations

import functools
import json
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from crankwork.description import schema as types
from crankwork.description.document import load
from crankwork.description.keys import ColumnKey, Date, FigureName, Figures, Section
from crankwork.description.machine_file import FILES, file_keys, template, template_names
from crankwork.description.schema import DefaultBy, KeySpec, MapOf, TableSpec
from crankwork.description.shorthand import expanded
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Text, UnitOf
from crankwork.locale import LANGUAGES, Language, translate
from crankwork.study.study_file import STUDY_FILE, As
from html_text import code, entry, raw, sentence, text

ROOT = Path(__file__).parents[2]
WORDS = tomllib.loads((Path(__file__).parent / "words.toml").read_text(encoding="utf-8"))
# where examples of keys are looked for, the plainest files first
KEY_EXAMPLES = Path(__file__).parent / "key_examples"
_FOLDERS = ("examples", "tests/machines", "docs/generate/key_examples", "tests/literature/assignments", "tests/golden")
_EXPANDED = ("narrow-v6", "petrol-four", "radial-five", "slider-crank")
_LONGEST_EXAMPLE, _LONGEST_TABLE = 90, 400
_ADDED = ", changed"


@dataclass
class Table:
    """A table of a file: where it stands, and what each of its keys may be in one file or another."""

    name: str
    places: list[str] = field(default_factory=list)
    keys: dict[str, list[KeySpec]] = field(default_factory=dict)
    specs: list[TableSpec] = field(default_factory=list)

    @property
    def page(self) -> str:
        """The name of the page on which it stands."""
        if self.name in ("file", *_OF_STUDIES):
            return "file" if self.name == "file" else "study"
        return self.places[0].partition(".")[0].removesuffix("[]")

    def meaning(self, key: str, language: Language) -> str:
        """Return what a key means."""
        return self.specs[0].meaning(key, language)

    def add(self, spec: TableSpec, place: str) -> None:
        """Add what one kind of file says of the table."""
        self.specs.append(spec)
        if place not in self.places:
            self.places.append(place)
        for key, stated in spec.keys.items():
            known = self.keys.setdefault(key, [])
            if all(stated is not other for other in known):
                known.append(stated)


_OF_STUDIES = ("study", "range", "designs", "search", "limits")


def inner_table(kind: Any) -> tuple[str, TableSpec] | None:  # noqa: ANN401 - each kind has its own type
    """Return the table that a kind of value is made of, and how its place is written: `[]` of a list, `.NAME`."""
    match kind:
        case TableSpec():
            return "", kind
        case As():
            return inner_table(kind.entry)
        case MapOf():
            below = inner_table(kind.entry)
            return below and (f".NAME{below[0]}", below[1])
        case types.ListOf() | types.Nested() | types.OneOrMore() | types.OneForAll():
            below = inner_table(kind.entry)
            return below and (f"[]{below[0]}", below[1])
        case types.NameOr():
            return inner_table(kind.other)
    return None


@functools.cache
def tables() -> dict[str, Table]:
    """Return every table of machine files and study files by its name."""
    found: dict[str, Table] = {}

    def walk(spec: TableSpec, place: str) -> None:
        found.setdefault(spec.name, Table(spec.name)).add(spec, place)
        for key, stated in spec.keys.items():
            if below := inner_table(stated.kind):
                walk(below[1], f"{place}.{key}{below[0]}".lstrip("."))

    for file in (*FILES, STUDY_FILE):
        walk(file, "")
    return found


@functools.cache
def examples() -> Mapping[tuple[str, str], tuple[str, str]]:
    """Return each key as some file states it, and the name of that file: the plainest that is not too long."""
    found: dict[tuple[str, str], tuple[str, str]] = {}

    def walk(spec: TableSpec, values: Mapping[str, Any], file: str) -> None:
        for key, value in values.items():
            if key not in spec.keys:
                continue
            below = inner_table(spec.keys[key].kind)
            written = f"{key} = {_toml(value)}"
            if below is not None and len(written) > _LONGEST_EXAMPLE:
                written = _in_lines(f"{tables()[spec.name].places[0]}.{key}".lstrip("."), key, value)
            known, _ = found.get((spec.name, key), ("", ""))
            if not known or len(written) < len(known) > (_LONGEST_EXAMPLE if below is None else _LONGEST_TABLE):
                found[spec.name, key] = written, file
            for inside in _inside(value, below[1]) if below else ():
                walk(below[1], inside, file)

    for file, written in (*_files(), *_expanded(), *changed()):
        values = tomllib.loads(written)
        walk(STUDY_FILE if "vary" in values else file_keys(values), values, file)
    return found


def _in_lines(place: str, key: str, value: Any) -> str:  # noqa: ANN401 - what a file has there
    """Return a table or a list of tables with a line for each of its keys or entries."""
    if isinstance(value, list):
        return "\n".join([f"{key} = [", *(f"  {_toml(item)}," for item in value), "]"])
    head = f"[{key if '[]' in place else place}]"
    return "\n".join([head, *(f"{name} = {_toml(item)}" for name, item in value.items())])


def _toml(value: Any) -> str:  # noqa: ANN401 - what a file has there
    """Return a value as a file states it on one line."""
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{name} = {_toml(item)}' for name, item in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    return json.dumps(value, ensure_ascii=False, default=str)


def _inside(value: Any, spec: TableSpec) -> Iterator[Mapping[str, Any]]:  # noqa: ANN401 - what a file has there
    """Yield the tables that a value is made of: itself, those of a list, or those below names of the user."""
    if isinstance(value, list):
        for one in value:
            yield from _inside(one, spec)
    elif isinstance(value, dict) and (set(value) <= set(spec.keys) or not all(map(_is_deep, value.values()))):
        yield value
    elif isinstance(value, dict):
        for one in value.values():
            yield from _inside(one, spec)


def _is_deep(value: object) -> bool:
    return isinstance(value, dict | list)


def _expanded() -> Iterator[tuple[str, str]]:
    """Yield examples as the linkages that they are, with every default written down."""
    for name in _EXPANDED:
        yield f"crankwork check examples/{name}.toml --expand", expanded(ROOT / "examples" / f"{name}.toml")


def changed() -> Iterator[tuple[str, str]]:
    """Yield files of the repository to which keys are added that no file states."""
    for change in tomllib.loads((KEY_EXAMPLES / "changes.toml").read_text(encoding="utf-8"))["changed"]:
        description = load(ROOT / change["file"])
        description.replace(dict(_leaves(change["to"])))
        yield f"{change['file']}{_ADDED}", description.dump()


def _leaves(values: Mapping[str, Any], place: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in values.items():
        if isinstance(value, dict):
            yield from _leaves(value, f"{place}{key}.")
        else:
            yield place + key, value


def _files() -> Iterator[tuple[str, str]]:
    """Yield name and text of machine files and study files."""
    yield from ((f"crankwork new {name}", template(name)) for name in template_names())
    for folder in _FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.toml")):
            written = path.read_text(encoding="utf-8")
            if path.name not in ("changed.toml", "changes.toml"):
                yield path.relative_to(ROOT).as_posix(), written


def example(table: Table, key: str) -> tuple[str, str]:
    """Return an example of a key as a file has it, and the name of that file; empty texts for none."""
    return examples().get((table.name, key), ("", ""))


def kind_text(kind: Any, language: Language) -> str:  # noqa: ANN401, C901, PLR0912 - one case per kind
    """Return what a value may be, as HTML."""
    words = WORDS[language]

    def said(which: str, **values: object) -> str:
        return str(words[which]).format(**values)

    def among(options: Any) -> str:  # noqa: ANN401 - words or numbers
        return ", ".join(code(json.dumps(option, ensure_ascii=False)) for option in options)

    match kind:
        case Quantity():
            return text(kind.schema(language)["description"])
        case Number():
            name = "whole" if kind.whole else f"number{'_above' * kind.above}"
            return text(said(name, low=f"{kind.low:g}", high=f"{kind.high:g}"))
        case Choice() | Section():
            return said("one_of", options=among(kind.options))
        case UnitOf():
            return said("unit", options=among(kind.options))
        case Flag():
            return text(words["flag"])
        case Date():
            return text(words["date"])
        case Text():
            return text(said("text", longest=kind.longest))
        case FigureName() | ColumnKey():
            return text(words["name"])
        case Figures():
            return said("named_values", entry=said("one_or_list", entry=words["name"]))
        case TableSpec():
            return said("table", name=_link(kind))
        case MapOf():
            name = "table_of_names" if inner_table(kind) else "named_values"
            return said(name, entry=kind_text(kind.entry, language))
        case types.ListOf():
            entries = said("list", entry=kind_text(kind.entry, language))
            return f"{entries}, {words['column']}" if kind.from_file else entries
        case types.Nested():
            return said("nested", entry=kind_text(kind.entry, language))
        case types.OneOrMore() | types.OneForAll():
            return said("one_or_list", entry=kind_text(kind.entry, language))
        case types.NameOr():
            return f"{words['name']} {words['or']} {kind_text(kind.other, language)}"
        case types.WordOr():
            return f"{kind_text(kind.words, language)} {words['or']} {kind_text(kind.number, language)}"
        case types.NumberOr():
            return f"{kind_text(kind.quantity, language)}; {words['or']} {kind_text(kind.number, language)}"
        case types.InertiaKind():
            return f"{kind_text(kind.quantity, language)}; {text(words['inertia'])}"
        case As():
            below = "" if kind.entry is None else f", {words['or']} {kind_text(kind.entry, language)}"
            return f"{text(words['named_kinds'])}{below}"
    schema = kind.schema(language)
    if schema.get("type") == "integer":
        return text(said("whole", low=schema["minimum"], high=schema["maximum"]))
    raise TypeError(f"no words for a {type(kind).__name__}")


def _link(spec: TableSpec) -> str:
    table = tables()[spec.name]
    return f'<a href="{table.page}.html#table-{table.name}">{code(spec.name)}</a>'


def _different(texts: Iterator[str]) -> str:
    return "<br>".join(dict.fromkeys(filter(None, texts)))


def _default(spec: KeySpec, language: Language) -> str:
    match spec.default:
        case None:
            return ""
        case DefaultBy(key, values):
            said = (
                translate("fields.default_with", language, default=json.dumps(default, ensure_ascii=False),
                          condition=" | ".join(f"{key} = {case}" for case, other in values.items() if other == default))
                for default in dict.fromkeys(values.values())
            )  # fmt: skip
            return text("; ".join(said))
    return code(json.dumps(spec.default, ensure_ascii=False))


def _conditions(spec: KeySpec, language: Language) -> str:
    conditions = (" | ".join(f"{key} = {option}" for option in options) or key for key, options in spec.only.items())
    return text("; ".join(translate("fields.with", language, condition=one) for one in conditions))


def _needed(specs: list[KeySpec], words: Mapping[str, str]) -> str:
    needed = [spec.required for spec in specs if spec.required]
    kinds = {kind: 0 for one in needed if isinstance(one, tuple) for kind in one}
    if kinds:
        return words["required_kinds"].format(kinds=" | ".join(kinds))
    if not needed or any(spec.instead_of for spec in specs):
        return ""
    return words["required"] if len(needed) == len(specs) else words["required_some"]


def key_entry(table: Table, key: str, language: Language) -> str:
    """Return the entry of a key."""
    words, specs = WORDS[language], table.keys[key]
    stated, file = example(table, key)
    shown = f"<pre>{code(stated)}</pre>" if "\n" in stated else code(stated)
    origin = words["added_to_file" if file.endswith(_ADDED) else "from_file"]
    shown += f" ({text(origin.format(file=f'`{file.removesuffix(_ADDED)}`'))})"
    facts = [
        (words["kind"], _different(kind_text(spec.kind, language) for spec in specs)),
        (words["default"], _different(_default(spec, language) for spec in specs)),
        (words["conditions"], _different(_conditions(spec, language) for spec in specs)),
        (words["instead"], ", ".join(map(code, dict.fromkeys(other for spec in specs for other in spec.instead_of)))),
        (words["example"], shown),
    ]
    said = text(sentence(table.meaning(key, language)))
    return entry(f"{table.name}.{key}", key, said, facts, _needed(specs, words))


def _title(page: str, language: Language) -> str:
    words = WORDS[language]
    return words[f"{page}_page"] if page in ("file", "study") else words["keys_page"].format(name=f"`{page}`")


def pages(language: Language) -> Iterator[tuple[str, str]]:
    """Yield the name of each page of a language, without its ending, and its text."""
    words, by_page = WORDS[language], dict[str, list[Table]]()
    for table in tables().values():
        by_page.setdefault(table.page, []).append(table)
    names = ["file", *sorted(set(by_page) - {"file", "study"}), "study"]
    toctree = "\n".join(["```{toctree}", ":maxdepth: 1", "", *names, "```"])
    yield "index", f"# {words['keys_title']}\n\n{words['keys_intro']}\n\n{toctree}\n"
    for page in names:
        parts = [f"# {_title(page, language)}\n"]
        for table in by_page[page]:
            places = [place for place in table.places if place]
            heading = places[0] if places else ""
            if heading and (heading != page or len(by_page[page]) > 1):
                several = sum(one.places[0] == heading for one in by_page[page]) > 1
                kind = f" ({words['variants'].get(table.name, table.name)})" if several else ""
                parts.append(f"## `[{heading}]`{kind}\n")
            at = words["at"].format(places=", ".join(f"`{place}`" for place in places)) if len(places) > 1 else ""
            inside = [f'<div id="table-{table.name}"></div>', f"<p>{text(at)}</p>" if at else ""]
            parts.append(raw([*inside, *(key_entry(table, key, language) for key in table.keys)]))
        yield page, "\n".join(parts)


def without_meaning() -> list[str]:
    """Return the keys that some language says nothing about but their own name."""
    return [
        f"{language}: {table.name}.{key}"
        for table in tables().values()
        for key in table.keys
        for language in LANGUAGES
        if len(said := table.meaning(key, language)) < 3 or said == key.replace("_", " ")
    ]


if __name__ == "__main__":
    sys.stdout.writelines(f"{line}\n" for line in without_meaning())
