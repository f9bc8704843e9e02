"""Parts of a mechanism that are equal: what hangs on the crank, as one another but later and turned about its axis."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace

from crankwork.mechanism.dyads import Bar, Chain, Dyad, Guide
from crankwork.mechanism.joints import Joint, Pin, group_links, joints, links_of_points
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Body, Crank, LinkPoint, Mechanism

_Record = Dyad | Chain | LinkPoint | Body
# of the size of a value, where rounding begins
_SAME = 1e-12
# angles are cleaned of the rounding of what they are worked out of [deg]
_DIGITS, _ROUNDING = 9, 1e-11


@dataclass(frozen=True, eq=False)
class EqualPart:
    """A part between crank and ground that does what an earlier one does, later and turned about the crank's pivot."""

    # Names of links, sliding pieces and points of the earlier part, and those of this one
    names: Mapping[str, str]
    first: frozenset[str]  # Links of the earlier part
    links: frozenset[str]  # Links of this one
    delay: float  # Crank angle by which this one is later [deg]
    turn: float  # Angle from the earlier part to this one [deg]
    cycle: float = 360.0  # Crank angle after which both repeat [deg]
    # Names of chambers of the earlier part, and those of this one
    chambers: Mapping[str, str] = field(default_factory=dict)

    def joint_of_first(self, joint: Joint, known: Iterable[Joint]) -> Joint:
        """Return which joint is in the earlier part what a joint is in this one."""
        return next(other for other in known if self._stands_for(other, joint))

    def _stands_for(self, first: Joint, joint: Joint) -> bool:
        if type(first) is not type(joint) or first.link not in self.first or self.names[first.link] != joint.link:
            return False
        if isinstance(first, Pin) and isinstance(joint, Pin):
            return self.names.get(first.point, first.point) == joint.point
        return self.names.get(first.other, first.other) == joint.other


def equal_parts(mechanism: Mechanism) -> tuple[EqualPart, ...]:
    """Return the parts of a mechanism that are equal to an earlier one; none without a crank that drives."""
    crank = mechanism.driver
    if not isinstance(crank, Crank) or crank.law is not None or crank.geared or mechanism.passages:
        return ()
    owners, kinds, result = links_of_points(mechanism), list[_Part](), list[EqualPart]()
    for part in _parts(mechanism, crank):
        equal = next(filter(None, (_compared(kind, part, mechanism, crank, owners) for kind in kinds)), None)
        if equal is None:
            kinds.append(part)
        else:
            result.append(equal)
    return tuple(result)


def without(mechanism: Mechanism, parts: Iterable[EqualPart]) -> Mechanism:
    """Return a mechanism without some parts of it."""
    left_out = frozenset[str]().union(*(part.links for part in parts))
    if not left_out:
        return mechanism
    return replace(
        mechanism,
        dyads=tuple(group for group in mechanism.dyads if not left_out & {*group_links(group)}),
        bodies=tuple(body for body in mechanism.bodies if body.link not in left_out),
        points=tuple(point for point in mechanism.points if point.link not in left_out),
        bars={link: bar for link, bar in mechanism.bars.items() if link not in left_out},
    )


@dataclass(frozen=True)
class _Part:
    """Groups that hang together, and their links."""

    groups: tuple[Dyad | Chain, ...]
    links: frozenset[str]


def _parts(mechanism: Mechanism, crank: Crank) -> Iterator[_Part]:
    """Yield what hangs together without crank and ground, in the order of the groups."""
    sets: list[set[str]] = [{*group_links(group)} for group in mechanism.dyads]
    for joint in joints(mechanism):
        touched = {joint.link, joint.other} - {crank.link, GROUND}
        joined = [links for links in sets if links & touched]
        sets = [links for links in sets if not links & touched]
        sets += [set[str]().union(*joined)] if joined else []
    of_part = [(tuple(group for group in mechanism.dyads if links & {*group_links(group)}), links) for links in sets]
    for groups, links in sorted(of_part, key=lambda part: mechanism.dyads.index(part[0][0])):
        yield _Part(groups, frozenset(links))


def _compared(
    first: _Part, part: _Part, mechanism: Mechanism, crank: Crank, owners: Mapping[str, str]
) -> EqualPart | None:
    """Return how a part follows an earlier one, None if it differs."""
    if any(isinstance(group, Chain) for group in (*first.groups, *part.groups)):
        return None
    comparison = _Comparison(mechanism, crank, owners)
    is_equal = (
        comparison.same_records(first.groups, part.groups)
        and comparison.same_records(*(_of(mechanism.points, each.links) for each in (first, part)))
        and comparison.same_records(*(_of(mechanism.bodies, each.links) for each in (first, part)))
        and comparison.same_bars(first.links)
        and comparison.same_places()
    )
    if not is_equal or comparison.turn is None or comparison.ahead is None:
        return None
    turn = comparison.turn
    delay = _clean(math.degrees(crank.direction * (turn - comparison.ahead))) % 360.0
    return EqualPart(comparison.names, first.links, part.links, delay, _clean(math.degrees(turn)))


def _of(records: Sequence[LinkPoint] | Sequence[Body], links: frozenset[str]) -> tuple[LinkPoint | Body, ...]:
    """Return the points or bodies of some links."""
    return tuple(record for record in records if record.link in links)


class _Comparison:
    """Two parts compared piece by piece: which names stand for which, and the angles between the parts. [rad]"""

    def __init__(self, mechanism: Mechanism, crank: Crank, owners: Mapping[str, str]) -> None:
        self._mechanism, self._crank, self._owners = mechanism, crank, owners
        self.names: dict[str, str] = {}
        self.turn: float | None = None
        self.ahead: float | None = None

    def same_records(self, first: Sequence[_Record], other: Sequence[_Record]) -> bool:
        """Return whether dyads, points or bodies are the same ones but for names, places and directions."""
        return len(first) == len(other) and all(map(self._same, first, other))

    def _same(self, first: _Record, other: _Record) -> bool:
        if type(first) is not type(other):
            return False
        # the guide of this dyad stands in three fields
        guide = getattr(first, "guide", None) if hasattr(first, "guide_point") else None
        if guide is not None and not self._same_value("guide", guide, getattr(other, "guide")):  # noqa: B009
            return False
        left_out = {"guide_point", "guide_angle", "guide_link"}
        return all(
            self._same_value(entry.name, getattr(first, entry.name), getattr(other, entry.name))
            for entry in fields(first)
            if entry.name not in left_out
        )

    def _same_value(self, name: str, first: object, other: object) -> bool:
        match first, other:
            case str(), str():
                return (not first) == (not other) and (not first or self._named(first, other))
            case Guide(), Guide():
                return self._same_guides(first, other, is_fixed=name != "slot" and not first.link)
            case ((float() | int()), (float() | int())):
                return _is_same(first, other)
        return first == other

    def _named(self, first: str, other: str) -> bool:
        return self.names.setdefault(first, other) == other

    def _same_guides(self, first: Guide, other: Guide, *, is_fixed: bool) -> bool:
        if not is_fixed:
            carried = not (first.link or other.link) or self._named(first.link, other.link)
            return carried and all(map(_is_same, (*first.point, first.angle), (*other.point, other.angle)))
        return not other.link and self._is_turned(other.angle - first.angle) and self._same_place(
            first.point, other.point
        )  # fmt: skip

    def _is_turned(self, angle: float) -> bool:
        """Return whether something fixed is turned by the same angle as all that was compared before."""
        self.turn = math.remainder(angle, math.tau) if self.turn is None else self.turn
        return abs(math.remainder(angle - self.turn, math.tau)) <= _SAME * math.tau

    def _same_place(self, first: tuple[float, float], other: tuple[float, float]) -> bool:
        pivot = complex(*self._crank.pivot)
        start, end = complex(*first) - pivot, complex(*other) - pivot
        scale = max(abs(start), abs(end), self._crank.radius)
        if self.turn is None and abs(start) > _SAME * scale:
            self.turn = cmath.phase(end / start)
        return abs(end - start * cmath.exp(1j * (self.turn or 0.0))) <= 4 * _SAME * scale

    def same_bars(self, links: frozenset[str]) -> bool:
        """Return whether links of both parts have their joints at the same places."""
        bars = self._mechanism.bars
        for link in links:
            first, other = bars.get(link), bars.get(self.names[link])
            if (first is None) != (other is None):
                return False
            if isinstance(first, Bar) and isinstance(other, Bar):
                numbers = ((*bar.start, *bar.end, bar.angle) for bar in (first, other))
                if not all(map(_is_same, *numbers)):
                    return False
        return True

    def same_places(self) -> bool:
        """Return whether both parts hang at the same places of crank and ground, but for one angle at each."""
        return all(self._same_joints(*pair) for pair in self.names.items() if pair[0] in self._owners)

    def _same_joints(self, first: str, other: str) -> bool:
        owners = [self._owners.get(name, "") for name in (first, other)]
        if owners[0] == GROUND:
            places = self._mechanism.ground
            return owners[1] == GROUND and self._same_place(places[first], places[other])
        if owners[0] != self._crank.link:
            return owners[1] == self.names.get(owners[0])
        if owners[1] != self._crank.link:
            return False
        pins = [self._on_crank(name) for name in (first, other)]
        if not all(map(abs, pins)):
            return pins[0] == pins[1]
        angle = cmath.phase(pins[1] / pins[0])
        self.ahead = angle if self.ahead is None else self.ahead
        return _is_same(abs(pins[0]), abs(pins[1])) and abs(math.remainder(angle - self.ahead, math.tau)) <= 8 * _SAME

    def _on_crank(self, name: str) -> complex:
        if name == self._crank.pin:
            return complex(self._crank.radius)
        return next(complex(point.along, point.across) for point in self._mechanism.points if point.name == name)


def _is_same(first: float, other: float) -> bool:
    return abs(first - other) <= _SAME * max(abs(first), abs(other))


def _clean(angle: float) -> float:
    """Return an angle without the rounding of what it was worked out of. [deg]"""
    near = round(angle, _DIGITS)
    return near + 0.0 if abs(angle - near) <= _ROUNDING else angle
