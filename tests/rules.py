"""One rule checked over many members that a fixture makes: every member that breaks it is told by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

import pytest

Member = TypeVar("Member")


def failing(members: Mapping[str, Member], check: Callable[[Member], object]) -> dict[str, str]:
    """Return what is wrong with each member that does not pass a check, by name."""
    assert members, "a rule without members says nothing"
    wrong: dict[str, str] = {}
    for name, member in members.items():
        try:
            check(member)
        except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - told with the name of the member
            wrong[name] = f"{type(error).__name__}: {error}"[:600]
    return wrong
