"""Redundant links, with or without a stated share of the load: removed from the linkage if they fit its motion."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from crankwork.description.range_checks import check_redundant_fit
from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.redundant import RedundantLink
from crankwork.errors import Problem
from crankwork.locale import ErrorMessage
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.linkage import GROUND, Linkage, Member
from crankwork.mechanism.structure import mobility

_KEYS = ("share", "of")
# largest number of redundant links without a share, and of combinations tried
_MOST_UNSHARED, _MOST_TRIED = 3, 100


def geometry_of(link: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a link without those of its share of the load."""
    return {name: value for name, value in link.items() if name not in _KEYS}


def without_redundant(linkage: Linkage, values: Values, reader: Reader) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without the links with a share, and these links; report invalid shares."""
    links = values["links"]
    for name, link in links.items():
        for key, other in (_KEYS, _KEYS[::-1]):
            if key in link and other not in link:
                example = next((member_name for member_name in links if member_name != name), "rocker")
                reader.add_error(f"links.{name}.{other}", ErrorMessage(f"{other}_missing", name=name, example=example))
    shared = tuple(member for member in linkage.members if set(_KEYS) <= set(links.get(member.name, ())))
    if reader.problems or not shared:
        return linkage, ()
    if not mechanism_of(linkage)[1]:
        for member in shared:
            reader.add_error(f"links.{member.name}.share", ErrorMessage("share_needless", name=member.name))
        return linkage, ()
    without = replace(linkage, members=tuple(member for member in linkage.members if member not in shared))
    for member in shared:
        _check((linkage, without), member, links[member.name]["of"], reader)
    return without, shared


def without_unshared(linkage: Linkage, taken: tuple[Member, ...]) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without redundant links that fit and have no mass, and all links removed.

    `taken`: links with a share, removed already.
    """
    named = [problem.key.partition(".")[2] for problem in mechanism_of(linkage)[1] if _is_stiff(problem)]
    count = 1 - round(float(mobility(linkage).value))
    if not named or not 1 <= count <= _MOST_UNSHARED:
        return linkage, taken
    weightless = [member for member in linkage.members if not (member.mass or member.inertia or member.guide)]
    weightless.sort(key=lambda member: member.name not in named)
    for subset in itertools.islice(itertools.combinations(weightless, count), _MOST_TRIED):
        without = replace(linkage, members=tuple(member for member in linkage.members if member not in subset))
        if mechanism_of(without)[1]:
            continue
        fits = [check_redundant_fit(without, member, 0.0) for member in subset]
        if all(message is not None and message.name == "redundant_fits" for message in fits):
            return without, (*taken, *subset)
    return linkage, taken


def _is_stiff(problem: Problem) -> bool:
    return isinstance(problem.message, ErrorMessage) and problem.message.name == "stiff_one"


def _check(both: tuple[Linkage, Linkage], link: Member, other: str, reader: Reader) -> None:
    """Report a link that cannot have a share, and a link that it cannot share with.

    `both`: the linkage with all links, and without those with a share.
    """
    key, (full, without) = f"links.{link.name}", both
    if sum(point in without.owners for point in link.points) != 2:
        reader.add_error(f"{key}.share", ErrorMessage("share_joints", name=link.name))
    if link.mass or link.inertia:
        reader.add_error(f"{key}.mass", ErrorMessage("share_mass", name=link.name))
    known = [member.name for member in without.members if not member.guide]
    if other not in known:
        reader.add_error(f"{key}.of", ErrorMessage("absent_link", name=other, known=", ".join(known)))
    elif len(_joints(full, full.member(other))) != 2:
        reader.add_error(f"{key}.of", ErrorMessage("share_joints", name=other))


def _joints(linkage: Linkage, member: Member) -> list[str]:
    return [point for point in member.points if len(linkage.owners[point]) > 1]


def fitting(linkage: Linkage, members: tuple[Member, ...], values: Values, reader: Reader) -> tuple[RedundantLink, ...]:
    """Return redundant links that fit the motion of the linkage; report those that do not."""
    redundant = []
    for link in members:
        freedom = float(mobility(replace(linkage, members=(*linkage.members, link))).value)
        message = check_redundant_fit(linkage, link, freedom)
        if message is None or message.name != "redundant_fits":
            reader.add_error(f"links.{link.name}", message or ErrorMessage("share_driver", name=link.name))
            continue
        start, end = (point for point in link.points if point in linkage.owners)
        length = math.dist(link.points[start], link.points[end])
        if "share" not in values["links"][link.name]:
            redundant.append(RedundantLink(link, start, end, length))
            continue
        other = linkage.member(values["links"][link.name]["of"])
        near, far = _counted(linkage, other, (start, end))
        of_length = math.dist(other.points[near], other.points[far])
        share = values["links"][link.name]["share"]
        redundant.append(RedundantLink(link, start, end, length, share, other.name, near, far, of_length))
    return tuple(redundant)


def _counted(linkage: Linkage, other: Member, ends: tuple[str, str]) -> tuple[str, str]:
    """Return the two joints of a link, first that on a link which the ends belong to: the force counts there."""
    owners = {owner for end in ends for owner in linkage.owners[end]} - {GROUND}
    joints = _joints(linkage, other)
    near = next((joint for joint in joints if owners & {*linkage.owners[joint]} - {other.name}), joints[0])
    return near, next(joint for joint in joints if joint != near)
