"""The machines of the repository, and which keys their results have."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import crankwork
import key_pages
from crankwork.formula.traced_value import Root, TracedValue, in_order
from crankwork.quantities import base_key
from crankwork.quantities.key import key_of

ROOT = Path(__file__).parents[2]
_TEMPLATE = "crankwork new "


def names() -> list[str]:
    """Return the files of examples and test machines, commands that write templates, and what shows keys."""
    folders = ("examples", "tests/machines", "docs/generate/key_examples")
    files = [path for folder in folders for path in sorted((ROOT / folder).glob("*.toml")) if _stands_alone(path)]
    templates = map(_TEMPLATE.__add__, crankwork.template_names())
    return [*(path.relative_to(ROOT).as_posix() for path in files), *templates, *dict(key_pages.changed())]


def _stands_alone(path: Path) -> bool:
    """Return whether a file is a machine and names no other file."""
    return path.name != "changes.toml" and not re.search(
        r"^(\[vary\]|[^#\n]*\bfile = )", path.read_text("utf-8"), re.MULTILINE
    )


def analysed(name: str) -> crankwork.Results:
    """Return the results of a machine."""
    if name.startswith(_TEMPLATE):
        return crankwork.analyse(crankwork.read_machine(crankwork.template(name.removeprefix(_TEMPLATE))))
    if name in (changed := dict(key_pages.changed())):
        return crankwork.analyse(crankwork.Description(changed[name]))
    return crankwork.analyse(crankwork.read(ROOT / name))


def keys_of(results: crankwork.Results) -> dict[str, str]:
    """Return the plainest key of each quantity in results; one that has an owner tells most."""
    found: dict[str, str] = {}
    traced = (value.key for value in _explained(results))
    listed = (key for listing in results.listings.values() for key in listing.columns)
    for key in (*results, *filter(None, traced), *listed):
        quantity = base_key(key)
        found[quantity] = max(found.get(quantity, key), key, key=_tells)
    return found


def _explained(results: crankwork.Results) -> Iterator[TracedValue]:
    """Yield the values of a trace, and of the equations that explanations show beside what is found from them."""
    values = list(in_order(results.trace.values()))
    yield from values
    yield from in_order([part for value in values if isinstance(value.node, Root) for part in value.node.residuals])


def _tells(key: str) -> tuple[bool, int]:
    return bool(key_of(key).owner), -len(key)


def keys_of_machine(name: str) -> dict[str, str]:
    """Return a key of each quantity in the results of a machine."""
    return keys_of(analysed(name))


def owners(keys: dict[str, dict[str, str]]) -> dict[str, tuple[str, str]]:
    """Return the plainest key of each quantity, and the machine whose results have it."""
    found: dict[str, tuple[str, str]] = {}
    for name, own in keys.items():
        for quantity, key in own.items():
            if quantity not in found or _tells(key) > _tells(found[quantity][0]):
                found[quantity] = key, name
    return found
