"""Limits of single values of a design."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Literal, NamedTuple

from crankwork.errors import CrankworkError
from crankwork.locale import Refusal
from crankwork.study.wanted import level

Sense = Literal["<=", ">=", "="]
_FORM = re.compile(r"\s*(?P<key>[^<>=\s]+)\s*(?P<sense><=|>=|=)\s*(?P<level>[^<>=]+?)\s*")
_EXAMPLE = "stroke >= 80 mm"


class Limit(NamedTuple):
    """A single value and its upper, lower or required level. [SI]"""

    key: str
    sense: Sense
    level: float

    def violation(self, value: float) -> float:
        """Return by how much a value violates the limit; 0 if it is satisfied. [SI]"""
        above = value - self.level
        return {"<=": max(above, 0.0), ">=": max(-above, 0.0), "=": abs(above)}[self.sense]


class WrittenLimit(NamedTuple):
    """A limit as text."""

    key: str
    sense: Sense
    level: str

    def in_si(self) -> Limit:
        """Return the limit in SI; a bare number is in the unit of the tables."""
        return Limit(self.key, self.sense, level(self.key, self.level))


def written_limits(texts: Sequence[str]) -> list[WrittenLimit]:
    """Parse limits such as `stroke >= 80 mm`."""
    limits = []
    for text in texts:
        form = _FORM.fullmatch(text)
        if form is None or len(text) > 200:
            raise CrankworkError(Refusal("limit_form", limit=text[:60], example=_EXAMPLE))
        limits.append(WrittenLimit(form["key"], form["sense"], form["level"]))  # type: ignore[arg-type]
    return limits
