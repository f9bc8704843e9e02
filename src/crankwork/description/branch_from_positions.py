"""The branches of a linkage from positions of its joints, and notices of positions without effect."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from crankwork.description.value_types import Reader
from crankwork.errors import GeometryError, Problem
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.position_analysis import place
from crankwork.locale import ErrorMessage
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Mechanism
from crankwork.mechanism.table_reader import linkage_from

# share of the size of a linkage by which a stated position may differ
_ROUGHLY = 0.25


class BranchedMechanism(NamedTuple):
    """A mechanism with its branches, its problems, and the positions of its joints at the start. [m]"""

    mechanism: Mechanism | None
    problems: list[Problem]
    places: Mapping[str, tuple[float, float]]


def branches_from_positions(linkage: Linkage) -> BranchedMechanism:
    """Return the mechanism of a linkage with branches from stated positions, group after group.

    A group may need solved positions of points on links of groups before it.
    """
    mechanism, problems = mechanism_of(linkage)
    solved: dict[str, tuple[float, float]] = {}
    for _ in mechanism.dyads if mechanism is not None and linkage.positions else ():
        if mechanism is None:
            break
        points = _placed(mechanism)
        places = {name: tuple(float(np.ravel(axis.position)[0]) for axis in point) for name, point in points.items()}
        solved = {name: (x, y) for name, (x, y) in places.items() if math.isfinite(x) and math.isfinite(y)}
        before = mechanism
        mechanism, problems = mechanism_of(linkage, solved)
        if mechanism == before:
            break
    return BranchedMechanism(None if problems else mechanism, problems, solved)


def _placed(mechanism: Mechanism) -> Mapping[str, PointMotion]:
    """Return the points at the start, of as many groups as can be assembled with the branches so far."""
    for count in range(len(mechanism.dyads), 0, -1):
        try:
            return place(replace(mechanism, dyads=mechanism.dyads[:count]), CrankGrid.from_degrees([0.0])).points
        except GeometryError:
            continue
    return {}


def position_notices(
    tables: Mapping[str, Any], linkage: Linkage, branched: BranchedMechanism, reader: Reader, *, is_new: bool
) -> Iterator[tuple[str, dict[str, float | str]]]:
    """Yield notices of positions far from their joints, unless they decide the branch of a dyad.

    In files of format 2 (`is_new`) report these, and all positions without effect.
    """
    if branched.mechanism is None:
        return
    branches, starts = _settling(linkage, branched.mechanism)
    size = max(
        (math.dist(first, second) for first in branched.places.values() for second in branched.places.values()),
        default=0.0,
    )
    for name, stated in linkage.positions.items():
        if name in branches:
            continue
        if name in branched.places and math.dist(stated, branched.places[name]) > _ROUGHLY * size:
            code = "position_far" if name in starts else "position_idle"
            values: dict[str, float | str] = {"name": name}
            values |= dict(zip("xy", (float(f"{1e3 * axis:.4g}") for axis in branched.places[name]), strict=True))
            if is_new:
                reader.add_error(f"positions.{name}", ErrorMessage(code, **values))
            else:
                yield code, values
        elif is_new and name not in starts and _is_idle(tables, linkage, branched.mechanism, name):
            yield "position_unused", {"name": name}


def _is_idle(tables: Mapping[str, Any], linkage: Linkage, mechanism: Mechanism, name: str) -> bool:
    """Return whether a linkage is the same without a stated position."""
    rest = {joint: position for joint, position in tables["positions"].items() if joint != name}
    other, _ = linkage_from({**tables, "positions": rest})
    if other is None:
        return False
    names = {member.name for member in linkage.members}
    other = replace(other, members=tuple(member for member in other.members if member.name in names))
    return (
        replace(other, positions={}) == replace(linkage, positions={})
        and branches_from_positions(other).mechanism == mechanism
    )


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
