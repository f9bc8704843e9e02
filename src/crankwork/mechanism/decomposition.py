"""From a linkage as drawn to a crank and ordered groups: which dyad each pair of members is, and its branch."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from crankwork.errors import Problem
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain, ChainLink, Slide
from crankwork.mechanism.driver import Cylinder
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Branch, Dyad, Guide, Point
from crankwork.mechanism.linkage import Linkage, Member
from crankwork.mechanism.mechanism import LinkPoint, Mechanism, body_at
from crankwork.mechanism.structure import known_points, structure

_IN_LINE = 1e-9


def mechanism_of(linkage: Linkage, solved: Mapping[str, Point] | None = None) -> tuple[Mechanism | None, list[Problem]]:
    """Return the mechanism that a linkage is, or every problem that keeps it from being one.

    Dyads and chains in the order in which they are solved, with the points and masses that go along. `solved`: where
    points are at a crank angle of zero, as far as the groups before have been solved. A branch is that of the stated
    position of a joint, seen from the points that it hangs on [m].
    """
    found, problems = structure(linkage)
    if found is None:
        return None, problems
    order = _Order(linkage, {**linkage.at_zero(), **(solved or {})})
    groups = [order.group([linkage.member(name) for name in group.members]) for group in found.groups]
    order.check_branches()
    if order.problems:
        return None, order.problems
    order.points += [LinkPoint(name, linkage.driver.link, *place) for name, place in linkage.driving.points.items()]
    order.points += [LinkPoint(name, one.name, *place) for one in linkage.geared for name, place in one.points.items()]
    massive = (one for one in (linkage.driving, *linkage.geared, *linkage.members) if one.centre)
    bodies = [body_at(one.name, one.mass, one.inertia, one.centre) for one in massive]
    halves = linkage.driver.halves if isinstance(linkage.driver, Cylinder) else ()
    # the frames of both lead from the end of the barrel to that of the rod
    for sense, half in zip((1, -1), halves, strict=False):
        name, (along, across) = f"{half.link}.centre", half.centre
        if half.mass:
            order.points.append(LinkPoint(name, half.link, sense * along, sense * across))
            bodies.append(body_at(half.link, half.mass, half.inertia, name))
    found_points, ground = tuple(order.points), dict(linkage.ground)
    return Mechanism(linkage.driver, tuple(groups), tuple(bodies), ground, found_points, order.bars), []


@dataclass
class _Order:
    """What is solved so far: the names of the members, the origins of their frames as drawn, further points."""

    linkage: Linkage
    at: Mapping[str, Point]
    solved: list[str] = field(default_factory=list)
    origins: dict[str, Point] = field(default_factory=dict)
    bars: dict[str, Bar] = field(default_factory=dict)
    points: list[LinkPoint] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list)
    branched: set[str] = field(default_factory=set)

    def group(self, members: list[Member]) -> Dyad | Chain:
        """Return the dyad or chain of some members and note what it places."""
        known = known_points(self.linkage, self.solved)
        pairs = (members, members[::-1]) if len(members) == 2 else ()
        dyads = (self._dyad(one, other, known) for one, other in pairs)
        made = next((dyad for dyad in dyads if dyad), None)
        self.solved += [one.name for one in members]
        return made or self._chain(members, known)

    def _dyad(self, a: Member, b: Member, known: set[str]) -> Dyad | None:
        """Return the dyad of two members, or None if it is none in this order."""
        ka, kb = ([name for name in one.points if name in known] for one in (a, b))
        shared = [name for name in a.points if name in b.points and name not in known]
        guides = [self.linkage.guides.get(one.guide) for one in (a, b)]
        match guides, len(ka), len(kb), shared:
            case [None, None], 1, 1, [point]:
                return self._rrr(a, b, ka[0], kb[0], point)
            case [None, Guide(link=carrier) as guide], 1, 0, [point] if carrier != a.name:
                return self._rrp(a, b, ka[0], point, guide)
            case [None, Guide(link=a.name) as guide], 1, 1, []:
                return self._rpr(a, b, ka[0], kb[0], guide)
            case [Guide() as one, Guide() as other], 0, 0, [point] if a.name != other.link and b.name != one.link:
                one, other = self._shifted(one, a, point), self._shifted(other, b, point)
                self._place(a, a.points[point], {point})
                self._place(b, b.points[point], {point})
                return PRP(point, a.name, b.name, one, other)
            case [Guide() as guide, Guide(link=a.name) as slot], 0, 1, []:
                self._place(a, (0.0, 0.0), set())
                slot = _moved(slot, b.points[kb[0]])
                self._place(b, b.points[kb[0]], {kb[0]})
                return RPP(kb[0], a.name, b.name, slot, self._guide(guide))
        return None

    def _rrr(self, a: Member, b: Member, joint_a: str, joint_b: str, point: str) -> RRR:
        lengths = [self._placed_bar(one, joint, point) for one, joint in ((a, joint_a), (b, joint_b))]
        stated, at = self.linkage.positions, self.at
        side = 0.0
        if point in stated and {joint_a, joint_b} <= at.keys():
            (ax, ay), (bx, by), (cx, cy) = at[joint_a], at[joint_b], stated[point]
            side = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            side /= math.hypot(bx - ax, by - ay) * lengths[0] or 1.0
        return RRR(joint_a, joint_b, point, a.name, b.name, lengths[0], lengths[1], self._branch(point, side))

    def _rrp(self, link: Member, piece: Member, joint: str, point: str, guide: Guide) -> RRP:
        length = self._placed_bar(link, joint, point)
        line = self._shifted(guide, piece, point)
        self._place(piece, piece.points[point], {point})
        stated, at = self.linkage.positions, self.at
        ahead = 0.0
        if point in stated and joint in at:
            angle, (x, y) = line.angle + self._drawn_angle(line.link), _difference(at[joint], stated[point])
            ahead = (x * math.cos(angle) + y * math.sin(angle)) / length
        branch = self._branch(point, ahead)
        return RRP(joint, point, link.name, length, line.point, line.angle, branch, line.link, piece.name)

    def _rpr(self, lever: Member, block: Member, pivot: str, joint: str, guide: Guide) -> RPR:
        x, y = lever.points[pivot]
        slot = Guide((guide.point[0] - x, guide.point[1] - y), guide.angle)
        slot = _moved(slot, block.points[joint])
        self._place(lever, (x, y), {pivot})
        self._place(block, block.points[joint], {joint})
        at, ahead = self.at, 0.0
        stated = self.linkage.positions
        named = next((name for name in lever.points if name in stated and name != pivot), None)
        if {joint, pivot} <= at.keys() and named is not None:
            along, across = _difference(at[pivot], at[joint])
            (u, v), (p, q) = _difference(at[pivot], stated[named]), _difference((x, y), lever.points[named])
            angle = math.atan2(v, u) - math.atan2(q, p) + slot.angle
            ahead = (along * math.cos(angle) + across * math.sin(angle)) / (math.hypot(along, across) or 1.0)
        return RPR(joint, pivot, lever.name, block.name, slot, self._branch(lever.name, ahead))

    def _placed_bar(self, link: Member, joint: str, point: str) -> float:
        """Return the length of a link from a known joint to a new one, and note where that line lies in its frame."""
        start, end = link.points[joint], link.points[point]
        along, across = _difference(start, end)
        bar = Bar(start, end, math.atan2(across, along))
        # the frame of a length that drives leads from the end that is known first
        if link.name != self.linkage.driver.link:
            self._place(link, (0.0, 0.0), {joint, point})
            if start != (0.0, 0.0) or bar.angle:
                self.bars[link.name] = bar
        return math.hypot(along, across)

    def _place(self, member: Member, origin: Point, without: set[str]) -> None:
        """Note where the origin of the frame in which a member is solved is drawn, and its points in that frame."""
        self.origins[member.name] = origin
        for name, place in member.points.items():
            if name not in without:
                self.points.append(LinkPoint(name, member.name, *_difference(origin, place)))

    def _guide(self, guide: Guide) -> Guide:
        """Return a guide in the frame in which its carrier is solved."""
        return replace(guide, point=_difference(self.origins.get(guide.link, (0.0, 0.0)), guide.point))

    def _shifted(self, guide: Guide, piece: Member, point: str) -> Guide:
        """Return the line that a point of a sliding piece runs on."""
        return self._guide(_moved(guide, piece.points[point]))

    def _branch(self, name: str, side: float) -> Branch:
        """Return the branch given for a joint or a lever, else that of the positions, else 1."""
        self.branched.add(name)
        given = self.linkage.branches.get(name)
        # in one line to rounding it is neither
        return given if given is not None else -1 if side < -_IN_LINE else 1

    def check_branches(self) -> None:
        """Note branches of what has none."""
        for name in self.linkage.branches:
            if name not in self.branched:
                choice = ", ".join(sorted(self.branched))
                told = Refusal("branch_absent" if choice else "branch_none", name=name, known=choice)
                self.problems.append(Problem(f"branch.{name}", told))

    def _joints(self, member: Member) -> list[str]:
        """Return the points of a member that something else is joined at."""
        return [name for name in member.points if len(self.linkage.owners[name]) > 1] or list(member.points)

    def _drawn_ends(self, cylinder: Member) -> dict[str, Point]:
        """Return where the ends of a cylinder are drawn, as points of links that are."""
        at, found = self.linkage.at_zero(), {}
        for end in cylinder.points:
            for name in self.linkage.owners[end]:
                member = self.linkage.member(name) if name not in self.linkage.base else cylinder
                drawn = [one for one in member.points if one in at][:2]
                if end in at:
                    found[end] = at[end]
                elif len(drawn) == 2 and member is not cylinder:
                    (x, y), angle = at[drawn[0]], self._drawn_angle(name, at)
                    (u, v), cos, sin = (
                        _difference(member.points[drawn[0]], member.points[end]),
                        math.cos(angle),
                        math.sin(angle),
                    )
                    found[end] = (x + u * cos - v * sin, y + u * sin + v * cos)
        return found

    def _drawn_angle(self, link: str, stated: Mapping[str, Point] | None = None) -> float:
        """Return the direction of the drawn frame of a member at the beginning, from stated or solved places. [rad]"""
        if not link or link in self.linkage.base:
            return self.linkage.base_frame(link)[1] if link else 0.0
        member, at = self.linkage.member(link), self.at if stated is None else stated
        if member.guide:
            guide = self.linkage.guides[member.guide]
            return guide.angle + self._drawn_angle(guide.link)
        ends = [name for name in member.points if name in at][:2]
        if len(ends) < 2:
            return 0.0
        (x, y), (u, v) = (_difference(*(source[name] for name in ends)) for source in (at, member.points))
        return math.atan2(y, x) - math.atan2(v, u)

    def _chain(self, members: list[Member], known: set[str]) -> Chain:
        """Return members that no dyad describes, with the start that the positions give."""
        links, slides = [], []
        for one in members:
            # a cylinder is drawn where its ends are, which are points of other links
            at = self._drawn_ends(one) if one.name == self.linkage.driver.link else self.linkage.at_zero()
            anchor = next((name for name in one.points if name in at), None)
            if anchor is None or (not one.guide and sum(name in at for name in one.points) < 2):
                key = f"{'sliders' if one.guide else 'links'}.{one.name}"
                self.problems.append(
                    Problem(key, Refusal("positions_needed", name=one.name, joints=", ".join(self._joints(one))))
                )
                continue
            angle, (u, v) = self._drawn_angle(one.name, at), one.points[anchor]
            cos, sin = math.cos(angle), math.sin(angle)
            origin = (at[anchor][0] - u * cos + v * sin, at[anchor][1] - u * sin - v * cos)
            links.append(ChainLink(one.name, origin, angle, dict(one.points)))
            if one.guide:
                slides.append(Slide(one.name, self._guide(self.linkage.guides[one.guide])))
        joints = {name for one in members for name in one.points}
        law = self.linkage.driver.law
        start, radian = (law.start if law else 0.0), 1.0
        if not self.linkage.driver.turns:
            points = [tuple(part.points.values()) for part in links]
            radian = max((math.dist(one, other) for own in points for one in own for other in own), default=1.0)
        return Chain(tuple(links), tuple(slides), frozenset(joints & known), start, radian)


def _moved(guide: Guide, by: Point) -> Guide:
    """Return a guide whose line is that of a point given in the frame of the piece that slides on it."""
    cos, sin = math.cos(guide.angle), math.sin(guide.angle)
    (x, y), (u, v) = guide.point, by
    return replace(guide, point=(x + u * cos - v * sin, y + u * sin + v * cos))


def _difference(start: Point, end: Point) -> Point:
    return end[0] - start[0], end[1] - start[1]
