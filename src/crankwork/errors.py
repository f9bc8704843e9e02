"""What can go wrong, as types. Every message is a sentence that names the place and the fix."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec

from crankwork.locale import Refusal
from crankwork.resources import installable


class CrankworkError(Exception):
    """Anything crankwork refuses to do; the text is meant for the user as it stands."""

    def __reduce__(
        self,
    ) -> tuple[Callable[..., CrankworkError], tuple[type[CrankworkError], object], dict[str, object]]:
        # by its text, not by the arguments of its class: otherwise it cannot come back from a process
        return _again, (type(self), self.args), self.__dict__


def _again(kind: type[CrankworkError], arguments: tuple[object, ...]) -> CrankworkError:
    return kind.__new__(kind, *arguments)


class GeometryError(CrankworkError):
    """A mechanism that cannot be assembled or cannot turn."""


class MethodError(CrankworkError):
    """A method asked for where it is not defined."""


class DoubtfulError(CrankworkError):
    """Results that were computed, but do not hold together or do not cover what was asked."""


class UnknownKeyError(CrankworkError, KeyError):
    """A key that results do not have; the text names the nearest that they have."""

    # a KeyError would put its text in quotation marks
    __str__ = Exception.__str__


class MissingExtraError(CrankworkError):
    """A capability whose optional dependencies are not installed, all of them at once."""

    def __init__(self, capability: Refusal, *extras: str) -> None:
        name = "extra_missing" if len(extras) == 1 else "extras_missing"
        super().__init__(Refusal(name, capability=capability, what=installable(",".join(extras))))


def missing_extras(modules: Mapping[str, str]) -> tuple[str, ...]:
    """Return the extras that bring the modules which are not installed, each once."""
    missing = (extra for module, extra in modules.items() if find_spec(module) is None)
    return tuple(dict.fromkeys(missing))


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

    def lines(self, tell: Callable[[str], str] = str) -> list[str]:
        """Return one line per problem, `place: key: message`; `tell` says a message in another language."""
        return [
            ": ".join(part for part in (place, problem.key, tell(problem.message)) if part)
            for place, problem in zip(self.places, self.problems, strict=True)
        ]
