"""Limits of single values: what a design must keep to."""

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
    """A single value and what it must not be above, below or other than. [SI]"""

    key: str
    sense: Sense
    level: float

    def missed(self, value: float) -> float:
        """Return by how much a value misses it; nothing where it is kept. [SI]"""
        above = value - self.level
        return {"<=": max(above, 0.0), ">=": max(-above, 0.0), "=": abs(above)}[self.sense]


class WrittenLimit(NamedTuple):
    """A limit as it is written."""

    key: str
    sense: Sense
    level: str

    def in_si(self) -> Limit:
        """Return it in SI; a bare number is in the unit of the tables."""
        return Limit(self.key, self.sense, level(self.key, self.level))


def written_limits(texts: Sequence[str]) -> list[WrittenLimit]:
    """Return limits as they are written, `stroke >= 80 mm`."""
    found = []
    for one in texts:
        form = _FORM.fullmatch(one)
        if form is None or len(one) > 200:
            raise CrankworkError(Refusal("limit_form", limit=one[:60], example=_EXAMPLE))
        found.append(WrittenLimit(form["key"], form["sense"], form["level"]))  # type: ignore[arg-type]
    return found
