"""Every text is used, every key has its text, and what is the same in English is one text."""

from __future__ import annotations

import ast
import functools
import pickle
import re
from collections import defaultdict
from pathlib import Path
from typing import get_args

import click

from crankwork.analysis.results import Notice
from crankwork.cli import commands
from crankwork.cli.options import option_key, stand_in_key
from crankwork.description import machine_file
from crankwork.description.schema import TableSpec
from crankwork.kernel.lowering import Reason
from crankwork.locale import LANGUAGES, ErrorMessage, has_text, in_language, texts, translate
from crankwork.mechanism import dyads
from crankwork.notation import ARGUMENTS
from crankwork.note.captions import _PLACE, _SAME
from crankwork.quantities import QUANTITIES, SUBJECTS
from crankwork.report.notices import notice_text
from crankwork.study.study_file import STUDY_FILE
from crankwork.units import UNITS
from each import for_each
from rules import PACKAGE, source_trees

FILES = *machine_file.FILES, STUDY_FILE
TEMPLATES = sorted((PACKAGE / machine_file.TEMPLATES).glob("*.toml"))
ROOMS = sorted({path.stem for path in (PACKAGE / "locale").glob("*/*.toml")})
# rooms whose names are put together with their room where they are asked for, and the folder whose constants name them
NAMED_IN = {
    "assumptions": "", "captions": "note", "check": "report", "columns": "", "drawing": "report", "explain": "",
    "fields": "description", "figures": "",
    "headings": "note", "kinds": "",
    "marks": "", "memory": "", "note": "note", "notices": "", "refusals": "", "report": "", "seen": "note",
    "page": "", "sentences": "", "sheets": "note", "studio": "studio", "study": "study", "tables": "",
}  # fmt: skip


def texts_of(kind: object) -> set[str]:
    """Return the names of the texts that say what the keys of a table mean, and of those below."""
    if isinstance(kind, TableSpec):
        known = texts("fields", "en")
        own = {f"{kind.name}.{key}" if f"{kind.name}.{key}" in known else key for key in kind.keys}
        return own.union(*(texts_of(one.kind) for one in kind.keys.values()))
    below = getattr(kind, "entry", getattr(kind, "other", None))
    return texts_of(below) if below is not None else set()


def texts_of_help() -> set[str]:
    """Return the names of the texts that the help of every command is made of."""
    found = {"usage", "options", "commands"}
    for command in (commands, *commands.commands.values()):
        context = click.Context(command, info_name="crankwork", help_option_names=["-h", "--help"])
        options = [one for one in command.get_params(context) if isinstance(one, click.Option)]
        stand_ins = " ".join([*command.collect_usage_pieces(context), *(one.metavar or "" for one in options)])
        found |= {f"command_{command.name}", *map(stand_in_key, re.findall(r"[A-Z]+", stand_ins))}
        found |= {option_key(str(command.name), one) for one in options}
    return {one.removeprefix("help.") for one in found}


# and rooms with one text for each entry of a table
TABLES = {
    "arguments": ARGUMENTS,
    "definitions": QUANTITIES,
    "fields": set().union(*map(texts_of, FILES)),
    "help": texts_of_help(),
    "kinds": (*vars(dyads), "opposed"),
    "refusals": (*(f"dimension_{one.dimension}" for one in UNITS.values()), "or", "and"),
    "parts": texts("parts", "en"),
    "places": re.findall(r"\w{2,}\.?|p\.", _PLACE.pattern.replace("\\", "")),
    "quantities": QUANTITIES,
    "study": {f"because_{one}" for one in get_args(Reason)},
    "subjects": SUBJECTS,
    "symbols": QUANTITIES,
    "templates": {word for path in TEMPLATES for word in re.findall(r"\{(\w+)\}", path.read_text("utf-8"))},
    "units": {*UNITS, "kmol", "mol", "h"},
}


# methods of the words of notes and sheets, and the room that they add to their key
SAYING = {
    "heading": "headings", "title": "headings", "caption": "captions", "column": "columns", "term": "columns",
    "sentence": "sentences", "phrase": "sentences", "paragraph": "sentences",
}  # fmt: skip


@functools.cache
def constants() -> dict[Path, set[str]]:
    """Return the strings of each module, docstrings left out."""
    found = {}
    for path, tree in source_trees().items():
        nodes = list(ast.walk(tree))
        said = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
        found[path] = {
            node.value for node in nodes
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in said
        }  # fmt: skip
    return found


@functools.cache
def pieces(folder: str) -> set[str]:
    """Return what keys may be made of: constants, and what stands between dots, blanks and commas in them."""
    mine = set().union(*(some for path, some in constants().items() if path.is_relative_to(PACKAGE / folder)))
    return {piece for one in mine for piece in (one, *re.split(r"[., ]", one), one.replace(" ", "_"))}


def is_used(room: str, name: str) -> bool:
    if room == "studio" and re.search(rf"\bwords\.{name}\b", scripts()):
        return True
    if name in TABLES.get(room, ()) or any(f"{room}.{name}" in some for some in constants().values()):
        return True
    return room in NAMED_IN and is_made_of(name, pieces(NAMED_IN[room]))


@functools.cache
def scripts() -> str:
    """Return what runs in a browser."""
    return "".join(path.read_text("utf-8") for path in (PACKAGE / "browser").glob("*.js"))


def is_made_of(name: str, names: set[str]) -> bool:
    """Return whether a name is one of these, or put together of them: "way_" + way, "unknown_" + what + "_near"."""
    if name in names or f"{name}_angle" in names:
        return True
    starts = (one for one in names if one[-1:] == "_" and len(one) > 1 and name.startswith(one))
    ends = (one for one in names if one[:1] == "_" and len(one) > 1 and name.endswith(one))
    rests = {*(name.removeprefix(one) for one in starts), *(name.removesuffix(one) for one in ends)}
    return any(is_made_of(one, names) for one in rests if one)


def said_keys() -> set[str]:
    """Return the keys that calls spell whole, and those that the words of notes and sheets are asked for."""
    found = set()
    for path, tree in source_trees().items():
        for call in ast.walk(tree):
            match call:
                case ast.Call(func=ast.Name("translate"), args=[ast.Constant(str(key)), *_]):
                    found.add(key if "." in key else f"sheets.{key}")
                case ast.Call(func=ast.Attribute(_, verb), args=[ast.Constant(str(key)), *_]) if verb in SAYING:
                    if path.is_relative_to(PACKAGE / "note"):
                        found.add(_SAME.get(f"{SAYING[verb]}.{key}", f"{SAYING[verb]}.{key}"))
    return found - set(QUANTITIES)


def test_every_text_is_used():
    assert [(room, name) for room in ROOMS for name in texts(room, "en") if not is_used(room, name)] == []


def test_every_key_that_the_source_spells_has_its_text():
    found = said_keys()
    assert len(found) > 200
    assert {one for one in found if not has_text(one)} == set()
    assert {key for key in _SAME.values() if not has_text(key)} == set()
    assert {key for key in _SAME if has_text(key)} == set()


def test_every_quantity_has_name_symbol_and_definition():
    assert list(texts("quantities", "en")) == list(texts("definitions", "en")) == list(QUANTITIES)
    assert set(QUANTITIES) <= set(texts("symbols", "en"))


def test_what_is_the_same_in_english_is_one_text():
    """Two keys with one English text go apart in the other languages; symbols, subscripts and names of parts do not."""
    keys = defaultdict(list)
    for room in ROOMS:
        if room not in ("symbols", "marks", "units", "parts"):
            # a dimension is named in refusals only
            for name, said in texts(room, "en").items() if room != "refusals" else ():
                keys[said.casefold()].append(f"{room}.{name}")
    assert {said: some for said, some in keys.items() if len(some) > 1} == {}


def test_every_key_of_a_machine_file_says_what_it_means():
    assert {name for one in FILES for name in texts_of(one)} <= set(texts("fields", "en"))


def test_every_command_option_and_stand_in_of_the_help_has_its_text():
    assert texts_of_help() - {"columns.value"} == set(texts("help", "en"))


@for_each("language", LANGUAGES)
def test_every_notice_can_be_told(language):
    for code in texts("notices", "en"):
        values: dict[str, float | str] = dict.fromkeys(
            re.findall(r"\{(\w+)\}", translate(f"notices.{code}", "en")), 1.0
        )
        values |= {name: "fuel" for name in values if name in ("name", "names", "message")}
        values |= {
            name: one
            for name, one in (("quantity", "heat_to_coolant"), ("quantities", "joint_force"), ("argument", "t_c"))
            if name in values
        }
        told = notice_text(Notice(code, values).code, values, language)
        assert told
        assert "{" not in told


def test_a_refusal_says_the_same_in_every_language():
    refusal = ErrorMessage("missing", advice=(ErrorMessage("a_table", key="rod"), "[rod]"))
    assert refusal == "is missing; write a table [rod] or [rod]"
    assert [in_language(refusal, language) for language in LANGUAGES] == [
        str(refusal), "отсутствует; запишите таблицу [rod] или [rod]", "còn thiếu; hãy ghi bảng [rod] hoặc [rod]",
    ]  # fmt: skip
    assert in_language(pickle.loads(pickle.dumps(refusal)), "ru") == in_language(refusal, "ru")  # noqa: S301 - our own
    assert in_language(refusal.cleaned(str.upper), "en") == "is missing; write a table [ROD] or [ROD]"
    assert in_language("said by somebody else", "ru") == "said by somebody else"
