"""What can go wrong, as types. Every message is a sentence that names the place and the fix."""

from __future__ import annotations

from dataclasses import dataclass


class CrankworkError(Exception):
    """Anything crankwork refuses to do; the text is meant for the user as it stands."""


class GeometryError(CrankworkError):
    """A mechanism that cannot be assembled or cannot turn."""


class MethodError(CrankworkError):
    """A method asked for where it is not defined."""


class MissingExtraError(CrankworkError):
    """A capability whose optional dependency is not installed."""

    def __init__(self, capability: str, extra: str) -> None:
        super().__init__(f"{capability} needs an optional part; install it with: pip install 'crankwork[{extra}]'")


@dataclass(frozen=True)
class Problem:
    """One mistake in a description: the dotted key it concerns, and what to write instead."""

    key: str
    message: str


class InputError(CrankworkError):
    """Every mistake of one description, at once.

    `places` holds, for each problem, the text that stands before the key (`file:line` or `--set`).
    """

    def __init__(self, problems: list[Problem], places: list[str]) -> None:
        self.problems = problems
        self.places = places
        super().__init__("\n".join(self.lines()))

    def lines(self) -> list[str]:
        """Return one line per problem, `place: key: message`."""
        return [
            ": ".join(part for part in (place, problem.key, problem.message) if part)
            for place, problem in zip(self.places, self.problems, strict=True)
        ]
