"""Lines of the memory that belong together in a note."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.lines import Line


class Group(NamedTuple):
    """Lines in the order of calculation: what they are about, and where they hold, if they vary. [deg]"""

    name: str
    lines: tuple[Line, ...]
    degrees: float | None = None
