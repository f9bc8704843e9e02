"""The type of a four-bar linkage: which of its links turn fully."""

from __future__ import annotations

from typing import Literal, NamedTuple

FourBarType = Literal["crank-rocker", "double crank", "double rocker", "rocker-crank", "triple rocker", "change point"]


class Grashof(NamedTuple):
    """The type of a four-bar linkage, and p + q - s - l: positive if its shortest link turns fully. [m]"""

    type: FourBarType
    margin: float


def grashof(crank: float, coupler: float, rocker: float, ground: float) -> Grashof:
    """Return the type of a four-bar linkage (norton_2012, ch. 2).

    Type and margin; `change point` where the links can all come into line. `crank`, `coupler`, `rocker` and `ground`:
    the lengths; the crank is the link that drives [m].
    """
    lengths = (crank, coupler, rocker, ground)
    shortest, longest = min(lengths), max(lengths)
    margin = sum(lengths) - 2 * shortest - 2 * longest
    if abs(margin) <= 1e-12 * longest:
        return Grashof("change point", 0.0)
    if margin < 0:
        return Grashof("triple rocker", margin)
    types: tuple[FourBarType, ...] = ("crank-rocker", "double rocker", "rocker-crank", "double crank")
    return Grashof(types[lengths.index(shortest)], margin)
