"""Recently opened machines of this user: files by path, or texts without a file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

from crankwork import files

_NAME = "recent.json"
_MAX_ENTRIES = 8
_MAX_LENGTH = 2 * _MAX_ENTRIES * files.MAX_MACHINE_FILE


class Recent(NamedTuple):
    """A machine that was opened: the path of its file, or a name and its text."""

    name: str
    text: str | None = None


def recent(opened: Recent | None = None) -> list[Recent]:
    """Return the recent machines, with the one just opened first."""

    def change(text: str) -> str:
        before = _read(text)
        if opened is None or not _is_kept(opened):
            return text
        remaining = [entry for entry in before if entry.name != opened.name]
        return json.dumps([list(entry) for entry in [opened, *remaining][:_MAX_ENTRIES]])

    return _read(files.update_user_file(_NAME, change, limit=_MAX_LENGTH))


def named(machines: list[Recent]) -> list[list[str]]:
    """Return the names of machines and the folders of existing files, for the page."""
    existing = [machine for machine in machines if machine.text is not None or Path(machine.name).is_file()]
    return [[machine.name, "" if machine.text is not None else str(Path(machine.name).parent)] for machine in existing]


def _is_kept(machine: Recent) -> bool:
    try:
        size = len(f"{machine.name}{machine.text or ''}".encode())
    except UnicodeEncodeError:
        return False
    return bool(machine.name) and size <= files.MAX_MACHINE_FILE


def _read(text: str) -> list[Recent]:
    """Parse the list of recent machines; skip damaged entries."""
    try:
        entries = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    return [Recent(*entry) for entry in entries if _is_valid(entry)] if isinstance(entries, list) else []


def _is_valid(entry: object) -> bool:
    if not (isinstance(entry, list) and len(entry) == 2 and isinstance(entry[0], str)):
        return False
    is_text = isinstance(entry[1], str)
    return (is_text or (entry[1] is None and Path(entry[0]).is_absolute())) and _is_kept(Recent(*entry))
