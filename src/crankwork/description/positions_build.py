"""The branches of a linkage from positions of its joints, and what is told of positions without effect."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from crankwork.description.kinds import Reader
from crankwork.errors import GeometryError, Problem
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.placement import place
from crankwork.kinematics.transfer import PointMotion
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.description import linkage_from
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Mechanism

# share of the size of a linkage by which a stated position may be rough
_ROUGHLY = 0.25


class Settled(NamedTuple):
    """A mechanism with its branches, what is wrong with it, and where its joints are at the beginning. [m]"""

    mechanism: Mechanism | None
    problems: list[Problem]
    places: Mapping[str, tuple[float, float]]


def settled(linkage: Linkage) -> Settled:
    """Return the mechanism of a linkage, its branches from stated positions as seen from solved ones.

    Where a link carries the points that the next group hangs on, these are known when its own group is solved: group
    after group settles its branch.
    """
    mechanism, problems = mechanism_of(linkage)
    solved: dict[str, tuple[float, float]] = {}
    for _ in mechanism.dyads if mechanism is not None and linkage.positions else ():
        if mechanism is None:
            break
        here = _placed(mechanism)
        places = {name: tuple(float(np.ravel(one.position)[0]) for one in point) for name, point in here.items()}
        solved = {name: (x, y) for name, (x, y) in places.items() if math.isfinite(x) and math.isfinite(y)}
        before = mechanism
        mechanism, problems = mechanism_of(linkage, solved)
        if mechanism == before:
            break
    return Settled(None if problems else mechanism, problems, solved)


def _placed(mechanism: Mechanism) -> Mapping[str, PointMotion]:
    """Return the points at the beginning, as far as groups close: a chain may need a branch before it settled first."""
    for count in range(len(mechanism.dyads), 0, -1):
        try:
            return place(replace(mechanism, dyads=mechanism.dyads[:count]), CrankGrid.from_degrees([0.0])).points
        except GeometryError:
            continue
    return {}


def told_positions(
    tables: Mapping[str, Any], linkage: Linkage, found: Settled, reader: Reader, *, is_new: bool
) -> Iterator[tuple[str, dict[str, float | str]]]:
    """Yield notices of positions far from where their joints are, unless they settle which branch of a dyad that is.

    In files of format 2 (`is_new`) complain of these, and of every position without which all would be the same.
    """
    if found.mechanism is None:
        return
    branches, starts = _settling(linkage, found.mechanism)
    size = max((math.dist(one, other) for one in found.places.values() for other in found.places.values()), default=0.0)
    for name, stated in linkage.positions.items():
        if name in branches:
            continue
        if name in found.places and math.dist(stated, found.places[name]) > _ROUGHLY * size:
            told = "position_far" if name in starts else "position_idle"
            values: dict[str, float | str] = {"name": name}
            values |= dict(zip("xy", (float(f"{1e3 * one:.4g}") for one in found.places[name]), strict=True))
            if is_new:
                reader.complain(f"positions.{name}", Refusal(told, **values))
            else:
                yield told, values
        elif is_new and name not in starts and _is_idle(tables, linkage, found.mechanism, name):
            reader.complain(f"positions.{name}", Refusal("position_unused"))


def _is_idle(tables: Mapping[str, Any], linkage: Linkage, mechanism: Mechanism, name: str) -> bool:
    """Return whether a linkage is the same without a stated position."""
    rest = {one: at for one, at in tables["positions"].items() if one != name}
    other, _ = linkage_from({**tables, "positions": rest})
    if other is None:
        return False
    names = {one.name for one in linkage.members}
    other = replace(other, members=tuple(one for one in other.members if one.name in names))
    return replace(other, positions={}) == replace(linkage, positions={}) and settled(other).mechanism == mechanism


def _settling(linkage: Linkage, mechanism: Mechanism) -> tuple[set[str], set[str]]:
    """Return the points whose stated positions settle a branch, and those where a chain begins."""
    branches, starts = set[str](), set[str]()
    for group in mechanism.dyads:
        match group:
            case RRR(point=name) | RRP(slider=name):
                branches |= {name} - set(linkage.branches)
            case RPR(link=name):
                branches |= set() if name in linkage.branches else set(linkage.member(name).points)
            case Chain(links=links):
                starts |= {name for link in links for name in link.points}
    return branches, starts
