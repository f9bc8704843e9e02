"""Rows of a table in one case of a test: every row that fails is told, by name."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import pytest

Test = Callable[..., None]


def for_each(names: str | Sequence[str], rows: Iterable[Any], ids: Any = None) -> Callable[[Test], Test]:
    """Call a test once for each row, like `pytest.mark.parametrize`, but as one case: with its fixtures as they are."""
    keys = [names] if isinstance(names, str) else list(names)
    table = list(rows)
    assert table, "a test of no rows tests nothing"

    def together(test: Test) -> Test:
        @functools.wraps(test)
        def every_row(*args: Any, **fixtures: Any) -> None:
            failures: list[BaseException] = []
            skipped: BaseException | None = None
            for at, row in enumerate(table):
                values = dict(zip(keys, row if len(keys) > 1 else [row], strict=True))
                try:
                    test(*args, **fixtures, **values)
                except pytest.skip.Exception as one:
                    skipped = one
                except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - told below, with all others
                    error.add_note(f"row {at}: {_label(ids, at, row) or values}")
                    failures.append(error)
            if failures:
                raise BaseExceptionGroup(f"{len(failures)} of {len(table)} rows", failures)
            if skipped is not None:
                raise skipped

        given = inspect.signature(test)
        rest = [one for key, one in given.parameters.items() if key not in keys]
        every_row.__signature__ = given.replace(parameters=rest)  # type: ignore[attr-defined]
        return every_row

    return together


def _label(ids: Any, at: int, row: Any) -> str:
    return "" if ids is None else str(ids(row) if callable(ids) else list(ids)[at])


def failing(members: Mapping[str, Any], check: Callable[[Any], object]) -> dict[str, str]:
    """Return what a check says of each member that it fails for, by name."""
    assert members, "a rule without members says nothing"
    found: dict[str, str] = {}
    for name, one in members.items():
        try:
            check(one)
        except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - told by name
            found[name] = f"{type(error).__name__}: {error}"
    return found
