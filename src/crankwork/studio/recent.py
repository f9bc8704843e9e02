"""The machines that were opened last by this user: files by their paths, and texts that stand in none."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

from crankwork import files

_NAME = "recent.json"
_MOST = 8
_LONGEST = 2 * _MOST * files.MAX_MACHINE_FILE


class Recent(NamedTuple):
    """A machine that was opened: what it is called, which is its path where it stands in a file; else its text."""

    name: str
    text: str | None = None


def recent(opened: Recent | None = None) -> list[Recent]:
    """Return the machines that were opened last, the one first that is opened now."""

    def change(text: str) -> str:
        before = _read(text)
        if opened is None or not _is_kept(opened):
            return text
        others = [one for one in before if one.name != opened.name]
        return json.dumps([list(one) for one in [opened, *others][:_MOST]])

    return _read(files.update_user_file(_NAME, change, limit=_LONGEST))


def named(found: list[Recent]) -> list[list[str]]:
    """Return what a page shows of machines: their names, and the folders of files that are there."""
    there = [one for one in found if one.text is not None or Path(one.name).is_file()]
    return [[one.name, "" if one.text is not None else str(Path(one.name).parent)] for one in there]


def _is_kept(one: Recent) -> bool:
    try:
        size = len(f"{one.name}{one.text or ''}".encode())
    except UnicodeEncodeError:
        return False
    return bool(one.name) and size <= files.MAX_MACHINE_FILE


def _read(text: str) -> list[Recent]:
    """Return what a list says; of one that was damaged what can be read."""
    try:
        found = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    return [Recent(*one) for one in found if _is_sound(one)] if isinstance(found, list) else []


def _is_sound(one: object) -> bool:
    if not (isinstance(one, list) and len(one) == 2 and isinstance(one[0], str)):
        return False
    is_text = isinstance(one[1], str)
    return (is_text or (one[1] is None and Path(one[0]).is_absolute())) and _is_kept(Recent(*one))
