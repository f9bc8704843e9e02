"""Links too many, their part in what is borne stated or not: taken out of the linkage, if they fit where it moves."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from crankwork.description.kinds import Reader
from crankwork.description.linkage_reach import fit
from crankwork.description.schema import Values
from crankwork.dynamics.redundant import RedundantLink
from crankwork.errors import Problem
from crankwork.locale import Refusal
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.linkage import GROUND, Linkage, Member
from crankwork.mechanism.structure import mobility

_KEYS = ("share", "of")
# links too many that are found without being told of, and the ways to leave so many out that are tried
_MOST_UNSHARED, _MOST_TRIED = 3, 100


def geometry_of(link: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a link without those that say what it bears."""
    return {name: one for name, one in link.items() if name not in _KEYS}


def taken_out(linkage: Linkage, values: Values, reader: Reader) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without the links that have a share, and these; complain of what can have none."""
    links = values["links"]
    for name, link in links.items():
        for key, other in (_KEYS, _KEYS[::-1]):
            if key in link and other not in link:
                example = next((one for one in links if one != name), "rocker")
                reader.complain(f"links.{name}.{other}", Refusal(f"{other}_missing", name=name, example=example))
    shared = tuple(one for one in linkage.members if set(_KEYS) <= set(links.get(one.name, ())))
    if reader.problems or not shared:
        return linkage, ()
    if not mechanism_of(linkage)[1]:
        for one in shared:
            reader.complain(f"links.{one.name}.share", Refusal("share_needless", name=one.name))
        return linkage, ()
    without = replace(linkage, members=tuple(one for one in linkage.members if one not in shared))
    for one in shared:
        _check((linkage, without), one, links[one.name]["of"], reader)
    return without, shared


def without_unshared(linkage: Linkage, taken: tuple[Member, ...]) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without links too many that fit, have no mass and no share, and all that are taken out.

    The linkage as it is where it moves or nothing is to be taken out. `taken`: those with a share, taken out already.
    """
    named = [one.key.partition(".")[2] for one in mechanism_of(linkage)[1] if _is_stiff(one)]
    count = 1 - round(float(mobility(linkage).value))
    if not named or not 1 <= count <= _MOST_UNSHARED:
        return linkage, taken
    weightless = [one for one in linkage.members if not (one.mass or one.inertia or one.guide)]
    weightless.sort(key=lambda one: one.name not in named)
    for some in itertools.islice(itertools.combinations(weightless, count), _MOST_TRIED):
        without = replace(linkage, members=tuple(one for one in linkage.members if one not in some))
        if mechanism_of(without)[1]:
            continue
        told = [fit(without, one, 0.0) for one in some]
        if all(one is not None and one.name == "redundant_fits" for one in told):
            return without, (*taken, *some)
    return linkage, taken


def _is_stiff(problem: Problem) -> bool:
    return isinstance(problem.message, Refusal) and problem.message.name == "stiff_one"


def _check(both: tuple[Linkage, Linkage], one: Member, other: str, reader: Reader) -> None:
    """Complain of a link that cannot have a share, and of one that it cannot share with.

    `both`: the linkage with all links, and without those that have a share.
    """
    key, (whole, without) = f"links.{one.name}", both
    if sum(point in without.owners for point in one.points) != 2:
        reader.complain(f"{key}.share", Refusal("share_joints", name=one.name))
    if one.mass or one.inertia:
        reader.complain(f"{key}.mass", Refusal("share_mass", name=one.name))
    known = [member.name for member in without.members if not member.guide]
    if other not in known:
        reader.complain(f"{key}.of", Refusal("absent_link", name=other, known=", ".join(known)))
    elif len(_joints(whole, whole.member(other))) != 2:
        reader.complain(f"{key}.of", Refusal("share_joints", name=other))


def _joints(linkage: Linkage, member: Member) -> list[str]:
    return [point for point in member.points if len(linkage.owners[point]) > 1]


def fitting(linkage: Linkage, members: tuple[Member, ...], values: Values, reader: Reader) -> tuple[RedundantLink, ...]:
    """Return links too many that fit where the linkage moves, and complain of those that do not."""
    found = []
    for one in members:
        freedom = float(mobility(replace(linkage, members=(*linkage.members, one))).value)
        told = fit(linkage, one, freedom)
        if told is None or told.name != "redundant_fits":
            reader.complain(f"links.{one.name}", told or Refusal("share_driver", name=one.name))
            continue
        start, end = (point for point in one.points if point in linkage.owners)
        length = math.dist(one.points[start], one.points[end])
        if "share" not in values["links"][one.name]:
            found.append(RedundantLink(one, start, end, length))
            continue
        other = linkage.member(values["links"][one.name]["of"])
        near, far = _counted(linkage, other, (start, end))
        of_length = math.dist(other.points[near], other.points[far])
        share = values["links"][one.name]["share"]
        found.append(RedundantLink(one, start, end, length, share, other.name, near, far, of_length))
    return tuple(found)


def _counted(linkage: Linkage, other: Member, ends: tuple[str, str]) -> tuple[str, str]:
    """Return the joint of a link where the force along it counts, and the other: first where both hang on one link."""
    beside = {owner for end in ends for owner in linkage.owners[end]} - {GROUND}
    joints = _joints(linkage, other)
    near = next((one for one in joints if beside & {*linkage.owners[one]} - {other.name}), joints[0])
    return near, next(one for one in joints if one != near)
