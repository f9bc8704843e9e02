"""The joints of a mechanism: pins and guides, each with the two links that it connects."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

from crankwork.mechanism.driver import DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Chain, Dyad
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Mechanism


@dataclass(frozen=True)
class Pin:
    """A revolute joint."""

    name: str  # Name of the joint: that of its point, followed by that of the link if several links share the point
    # The connected link, and the link that carries the joint or `ground`
    link: str
    other: str
    point: str  # Its point; empty for the pivot of the crank, the origin of its frame


@dataclass(frozen=True)
class SlidingJoint:
    """A sliding joint: the x axis of the frame of a piece lies on a guide."""

    name: str  # Name of the joint, that of its piece
    # The sliding piece, and the link that carries the guide or `ground`
    link: str
    other: str


Joint = Pin | SlidingJoint


def joints(mechanism: Mechanism) -> tuple[Joint, ...]:
    """Return the joints of a mechanism, that of a driving link first, then group after group.

    If three or more links share a pin, the first one placed carries it.
    """
    owners = links_of_points(mechanism)
    result: list[Joint] = []
    match mechanism.driver:
        case Crank(link=crank, geared=geared):
            names = (crank, *(geared_crank.link for geared_crank in geared))
            result += [Pin(f"{name}_pivot", name, GROUND, "") for name in names]
        case DrivingSlider(link=piece):
            result.append(_on_guide(piece, ""))
    for group in mechanism.dyads:
        result += _chain_joints(group, owners) if isinstance(group, Chain) else _dyad_joints(group, owners)
    if isinstance(mechanism.driver, LinkMotor):
        result = [joint for joint in result if mechanism.driver.link not in (joint.link, joint.other)]
    count = Counter(joint.point for joint in result if isinstance(joint, Pin) and joint.point)
    return tuple(
        replace(joint, name=f"{joint.name}_{joint.link}")
        if isinstance(joint, Pin) and count[joint.point] > 1
        else joint
        for joint in result
    )


def links_of_points(mechanism: Mechanism) -> dict[str, str]:
    """Return the link, or `ground`, of each named point; of several links at a point the first."""
    owners = dict.fromkeys(mechanism.ground, GROUND)
    if isinstance(mechanism.driver, Crank):
        owners[mechanism.driver.pin] = mechanism.driver.link
    owners |= {point.name: point.link for point in mechanism.points}
    # the third side of the triangle of a motor carries no points
    third_side = mechanism.driver.link if isinstance(mechanism.driver, LinkMotor) else ""
    for group in mechanism.dyads:
        match group:
            case RRR():
                owners[group.point] = group.link_b if group.link_a == third_side else group.link_a
            case RRP():
                owners[group.slider] = group.piece
            case PRP():
                owners[group.point] = group.block_a
            case Chain():
                for link in group.links:
                    for name in link.points if link.name != third_side else ():
                        owners.setdefault(name, link.name)
    return owners


def group_links(group: Dyad | Chain) -> tuple[str, ...]:
    """Return the names of the links of a group."""
    match group:
        case RRR():
            return group.link_a, group.link_b
        case RRP():
            return group.link, group.piece
        case RPR() | RPP():
            return group.link, group.block
        case PRP():
            return group.block_a, group.block_b
        case Chain():
            return tuple(link.name for link in group.links)


def pivots_of(mechanism: Mechanism) -> dict[str, str]:
    """Return the named fixed pivots of cranks, by link."""
    if not isinstance(mechanism.driver, Crank):
        return {}
    named = {point: name for name, point in reversed([*mechanism.ground.items()])}
    places = {mechanism.driver.link: mechanism.driver.pivot}
    places |= {geared.link: geared.pivot for geared in mechanism.driver.geared}
    return {link: named[point] for link, point in places.items() if point in named}


def names_of_pivots(mechanism: Mechanism) -> dict[str, str]:
    """Return the names of the fixed points by the names of the pivot joints of cranks."""
    return {f"{link}_pivot": name for link, name in pivots_of(mechanism).items()}


def origin_of(mechanism: Mechanism, link: str) -> str:
    """Return the point at the origin of the frame of a link of a group."""
    group = next(candidate for candidate in mechanism.dyads if link in group_links(candidate))
    match group:
        case RRR():
            return group.joint_a if link == group.link_a else group.joint_b
        case RRP():
            return group.joint
        case Chain():
            points = next(member.points for member in group.links if member.name == link)
            return next(name for name, place in points.items() if place == (0.0, 0.0))
    raise ValueError(f"{link} has no origin at a pin")


def _dyad_joints(dyad: Dyad, owners: dict[str, str]) -> list[Joint]:
    """Return the three joints of a dyad: the outer ones, and between them the inner one."""

    def outer(point: str, link: str) -> Pin:
        return Pin(point, link, owners[point], point)

    match dyad:
        case RRR():
            inner = Pin(dyad.point, dyad.link_b, dyad.link_a, dyad.point)
            return [outer(dyad.joint_a, dyad.link_a), inner, outer(dyad.joint_b, dyad.link_b)]
        case RRP():
            inner = Pin(dyad.slider, dyad.piece, dyad.link, dyad.slider)
            return [outer(dyad.joint, dyad.link), inner, _on_guide(dyad.piece, dyad.guide_link)]
        case RPR():
            return [outer(dyad.joint, dyad.block), _on_guide(dyad.block, dyad.link), outer(dyad.pivot, dyad.link)]
        case PRP():
            inner = Pin(dyad.point, dyad.block_b, dyad.block_a, dyad.point)
            a, b = _on_guide(dyad.block_a, dyad.guide_a.link), _on_guide(dyad.block_b, dyad.guide_b.link)
            return [a, inner, b]
        case RPP():
            return [
                outer(dyad.joint, dyad.block),
                _on_guide(dyad.block, dyad.link),
                _on_guide(dyad.link, dyad.guide.link),
            ]


def _on_guide(piece: str, carrier: str) -> SlidingJoint:
    return SlidingJoint(piece, piece, carrier or GROUND)


def _chain_joints(chain: Chain, owners: dict[str, str]) -> Iterator[Joint]:
    for link in chain.links:
        for name in link.points:
            shared = sum(name in other.points for other in chain.links) > 1
            if name in chain.known or (shared and owners[name] != link.name):
                yield Pin(name, link.name, owners[name], name)
    for slide in chain.slides:
        yield _on_guide(slide.link, slide.guide.link)
