"""Files that the package brings along, and where the package itself comes from."""

from __future__ import annotations

import json
import shlex
from pathlib import Path


def read_resource(*names: str) -> str:
    """Return the text of a file of the package."""
    return Path(__file__).parent.joinpath(*names).read_text(encoding="utf-8")


def resource_names(folder: str, suffix: str) -> list[str]:
    """Return the sorted stems of the package files in a folder that end with `suffix`."""
    entries = Path(__file__).parent.joinpath(folder).iterdir()
    return sorted(entry.name.removesuffix(suffix) for entry in entries if entry.name.endswith(suffix))


def installable(extras: str) -> str:
    """Return what pip is told to install for some extras: from a checkout, or from where this came from."""
    checkout = Path(__file__).resolve().parents[2]
    if (checkout / "pyproject.toml").is_file():
        return f"-e {shlex.quote(f'{checkout}[{extras}]')}"
    # takes long, and only what fails asks for it
    from importlib.metadata import PackageNotFoundError, distribution  # noqa: PLC0415

    try:
        origin = json.loads(distribution("crankwork").read_text("direct_url.json") or "{}")
    except PackageNotFoundError:
        origin = {}
    vcs, url = origin.get("vcs_info"), origin.get("url")
    if vcs:
        url = f"{vcs['vcs']}+{url}@{vcs['commit_id']}"
    return shlex.quote(f"crankwork[{extras}] @ {url}" if url else f"crankwork[{extras}]")
