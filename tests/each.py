"""One case for many members of a kind: each is checked, and all that fail are told by name."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Collection, Mapping
from typing import Any

import pytest

Members = Mapping[str, Any] | Collection[Any]


def each(members: Members, later: Members = ()) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Return what makes one case of a test of one member; `later`: those that are left to a slow case.

    The first parameters of the test are the member, or what it is a plain tuple of; the others are fixtures. A member
    that is a `functools.partial` is made when its turn comes.
    """
    parts = {"few": _named(members), "rest": _named(later)}
    first = next(iter(parts["few"].values()))
    count = len(first) if type(first) is tuple else 1

    def decorated(test: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(test)
        def checked(part: str = "few", **fixtures: Any) -> None:
            failed = []
            for name, member in parts[part].items():
                try:
                    given = member() if isinstance(member, functools.partial) else member
                    test(*(given if type(given) is tuple else (given,)), **fixtures)
                except (Exception, pytest.fail.Exception) as error:
                    told = AssertionError(f"{name}: {type(error).__name__}: {error}")
                    failed.append(told.with_traceback(error.__traceback__))
            if failed:
                raise ExceptionGroup(f"{len(failed)} of {len(parts[part])} fail", failed)

        own = list(inspect.signature(test).parameters.values())[count:]
        part = [inspect.Parameter("part", inspect.Parameter.POSITIONAL_OR_KEYWORD)] if later else []
        checked.__signature__ = inspect.Signature([*part, *own])  # type: ignore[attr-defined]
        del checked.__wrapped__
        if later:
            return pytest.mark.parametrize("part", ["few", pytest.param("rest", marks=pytest.mark.slow)])(checked)
        return checked

    return decorated


def _named(members: Members) -> dict[str, Any]:
    return dict(members) if isinstance(members, Mapping) else {str(one): one for one in members}
