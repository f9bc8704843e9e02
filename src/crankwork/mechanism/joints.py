"""The joints of a mechanism: which pin or guide holds which link to which other one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

from crankwork.mechanism.chain import Chain
from crankwork.mechanism.driver import DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Dyad
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Mechanism


@dataclass(frozen=True)
class Pin:
    """A revolute joint."""

    name: str  # Name of the joint: that of its point, with that of the link where several links hang on one point
    # The link that is held, and the one that holds it or `ground`
    link: str
    other: str
    point: str  # Where it is; empty for the pivot of the crank, the origin of its frame


@dataclass(frozen=True)
class SlidingJoint:
    """A sliding joint, the x axis of the frame of its piece on the guide."""

    name: str  # Name of the joint, that of its piece
    # The sliding piece, and the link that carries the guide or `ground`
    link: str
    other: str


Joint = Pin | SlidingJoint


def joints(mechanism: Mechanism) -> tuple[Joint, ...]:
    """Return the joints of a mechanism, that of a driving link first, then group after group.

    Of three and more links on one pin the first that is placed carries the pin, and the others hang on it.
    """
    bearer = bearers(mechanism)
    found: list[Joint] = []
    match mechanism.driver:
        case Crank(link=crank, geared=geared):
            found += [Pin(f"{name}_pivot", name, GROUND, "") for name in (crank, *(one.link for one in geared))]
        case DrivingSlider(link=piece):
            found.append(_on_guide(piece, ""))
    for group in mechanism.dyads:
        found += _chain_joints(group, bearer) if isinstance(group, Chain) else _dyad_joints(group, bearer)
    if isinstance(mechanism.driver, LinkMotor):
        found = [one for one in found if mechanism.driver.link not in (one.link, one.other)]
    count = Counter(one.point for one in found if isinstance(one, Pin) and one.point)
    return tuple(
        replace(one, name=f"{one.name}_{one.link}") if isinstance(one, Pin) and count[one.point] > 1 else one
        for one in found
    )


def bearers(mechanism: Mechanism) -> dict[str, str]:
    """Return the link, or `ground`, that each named point belongs to; the first one of those that meet there."""
    bearer = dict.fromkeys(mechanism.ground, GROUND)
    if isinstance(mechanism.driver, Crank):
        bearer[mechanism.driver.pin] = mechanism.driver.link
    bearer |= {one.name: one.link for one in mechanism.points}
    # the third side of a triangle bears nothing
    third_side = mechanism.driver.link if isinstance(mechanism.driver, LinkMotor) else ""
    for group in mechanism.dyads:
        match group:
            case RRR():
                bearer[group.point] = group.link_b if group.link_a == third_side else group.link_a
            case RRP():
                bearer[group.slider] = group.piece
            case PRP():
                bearer[group.point] = group.block_a
            case Chain():
                for link in group.links:
                    for name in link.points if link.name != third_side else ():
                        bearer.setdefault(name, link.name)
    return bearer


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
    """Return the fixed points that cranks turn about by link, those that have names."""
    if not isinstance(mechanism.driver, Crank):
        return {}
    named = {at: name for name, at in reversed([*mechanism.ground.items()])}
    places = {mechanism.driver.link: mechanism.driver.pivot}
    places |= {one.link: one.pivot for one in mechanism.driver.geared}
    return {link: named[at] for link, at in places.items() if at in named}


def names_of_pivots(mechanism: Mechanism) -> dict[str, str]:
    """Return the names of fixed points by those of the joints in which cranks turn about them."""
    return {f"{link}_pivot": name for link, name in pivots_of(mechanism).items()}


def origin_of(mechanism: Mechanism, link: str) -> str:
    """Return the point from which the frame of a link of a group counts."""
    group = next(one for one in mechanism.dyads if link in group_links(one))
    match group:
        case RRR():
            return group.joint_a if link == group.link_a else group.joint_b
        case RRP():
            return group.joint
        case Chain():
            points = next(one.points for one in group.links if one.name == link)
            return next(name for name, place in points.items() if place == (0.0, 0.0))
    raise ValueError(f"{link} has no origin at a pin")


def _dyad_joints(dyad: Dyad, bearer: dict[str, str]) -> list[Joint]:
    """Return the three joints of a dyad: the outer ones, and between them the inner one."""

    def hung(point: str, link: str) -> Pin:
        return Pin(point, link, bearer[point], point)

    match dyad:
        case RRR():
            inner = Pin(dyad.point, dyad.link_b, dyad.link_a, dyad.point)
            return [hung(dyad.joint_a, dyad.link_a), inner, hung(dyad.joint_b, dyad.link_b)]
        case RRP():
            inner = Pin(dyad.slider, dyad.piece, dyad.link, dyad.slider)
            return [hung(dyad.joint, dyad.link), inner, _on_guide(dyad.piece, dyad.guide_link)]
        case RPR():
            return [hung(dyad.joint, dyad.block), _on_guide(dyad.block, dyad.link), hung(dyad.pivot, dyad.link)]
        case PRP():
            inner = Pin(dyad.point, dyad.block_b, dyad.block_a, dyad.point)
            a, b = _on_guide(dyad.block_a, dyad.guide_a.link), _on_guide(dyad.block_b, dyad.guide_b.link)
            return [a, inner, b]
        case RPP():
            return [
                hung(dyad.joint, dyad.block),
                _on_guide(dyad.block, dyad.link),
                _on_guide(dyad.link, dyad.guide.link),
            ]


def _on_guide(piece: str, carrier: str) -> SlidingJoint:
    return SlidingJoint(piece, piece, carrier or GROUND)


def _chain_joints(chain: Chain, bearer: dict[str, str]) -> Iterator[Joint]:
    for link in chain.links:
        for name in link.points:
            shared = sum(name in one.points for one in chain.links) > 1
            if name in chain.known or (shared and bearer[name] != link.name):
                yield Pin(name, link.name, bearer[name], name)
    for slide in chain.slides:
        yield _on_guide(slide.link, slide.guide.link)
