"""Files that the package brings along."""

from __future__ import annotations

from pathlib import Path


def read_resource(*names: str) -> str:
    """Return the text of a file of the package."""
    return Path(__file__).parent.joinpath(*names).read_text(encoding="utf-8")


def resource_names(folder: str, suffix: str) -> list[str]:
    """Return the sorted stems of the package files in a folder that end with `suffix`."""
    entries = Path(__file__).parent.joinpath(folder).iterdir()
    return sorted(entry.name.removesuffix(suffix) for entry in entries if entry.name.endswith(suffix))
