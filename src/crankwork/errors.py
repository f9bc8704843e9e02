"""Types of errors. Every message is a sentence with the place and the fix."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec

from crankwork.locale import ErrorMessage
from crankwork.resources import installable


class CrankworkError(Exception):
    """Base of all errors of crankwork; the text is for the user."""

    def __reduce__(self) -> tuple[object, ...]:
        # rebuilt from its text, not from the arguments of its class, when it comes from another process
        return _again, (type(self), self.args), self.__dict__


def _again(kind: type[CrankworkError], arguments: tuple[object, ...]) -> CrankworkError:
    return kind.__new__(kind, *arguments)


class GeometryError(CrankworkError):
    """A mechanism that cannot be assembled or cannot turn."""


class MethodError(CrankworkError):
    """A method that is not defined for the machine."""


class UnknownKeyError(CrankworkError, KeyError):
    """A key that results do not have; the text names the closest existing key."""

    # a KeyError would put its text in quotation marks
    __str__ = Exception.__str__


class MissingExtraError(CrankworkError):
    """A capability whose optional dependencies are not installed, all of them at once."""

    def __init__(self, capability: ErrorMessage, *extras: str) -> None:
        name = "extra_missing" if len(extras) == 1 else "extras_missing"
        super().__init__(ErrorMessage(name, capability=capability, what=installable(",".join(extras))))


def missing_extras(modules: Mapping[str, str]) -> tuple[str, ...]:
    """Return the extras of modules that are not installed, each once."""
    missing = (extra for module, extra in modules.items() if find_spec(module) is None)
    return tuple(dict.fromkeys(missing))


@dataclass(frozen=True)
class Problem:
    """One mistake in a description: its dotted key, and what to write instead."""

    key: str
    message: str


class InputError(CrankworkError):
    """Every mistake of one description, at once.

    `places`: the text before the key of each problem, `file:line` or `--set`.
    """

    def __init__(self, problems: list[Problem], places: list[str]) -> None:
        self.problems = problems
        self.places = places
        super().__init__("\n".join(self.lines()))

    def lines(self, tell: Callable[[str], str] = str) -> list[str]:
        """Return one line per problem, `place: key: message`; `tell` translates a message."""
        return [
            ": ".join(part for part in (place, problem.key, tell(problem.message)) if part)
            for place, problem in zip(self.places, self.problems, strict=True)
        ]


class RenamedKeyWarning(FutureWarning):
    """An old key of results was asked for; its argument says which key to use now."""
