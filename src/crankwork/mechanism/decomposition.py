"""Decomposition of a drawn linkage into a driver and ordered groups, each with its branch."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from crankwork.errors import Problem
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Cylinder
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Branch, Chain, ChainLink, Dyad, Guide, Point, Slide
from crankwork.mechanism.linkage import Linkage, Member
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at
from crankwork.mechanism.structure import known_points, structure

_IN_LINE = 1e-9


def mechanism_of(linkage: Linkage, solved: Mapping[str, Point] | None = None) -> tuple[Mechanism | None, list[Problem]]:
    """Return the mechanism of a linkage, or every problem that prevents it.

    Dyads and chains in the order of their solution, with points and masses. `solved`: points at a crank angle of zero,
    of the groups solved so far. A branch is that of the stated position of a joint, relative to its outer joints [m].
    """
    assembly, problems = structure(linkage)
    if assembly is None:
        return None, problems
    order = _Order(linkage, {**linkage.at_zero(), **(solved or {})})
    groups = [order.group([linkage.member(name) for name in group.members]) for group in assembly.groups]
    order.check_branches()
    if order.problems:
        return None, order.problems
    order.points += [LinkPoint(name, linkage.driver.link, *place) for name, place in linkage.driving.points.items()]
    for geared in linkage.geared:
        order.points += [LinkPoint(name, geared.name, *place) for name, place in geared.points.items()]
    massive = (member for member in (linkage.driving, *linkage.geared, *linkage.members) if member.centre)
    bodies = [body_at(member.name, member.mass, member.inertia, member.centre) for member in massive]
    halves = linkage.driver.halves if isinstance(linkage.driver, Cylinder) else ()
    # both frames are directed from barrel to rod
    for sense, half in zip((1, -1), halves, strict=False):
        name, (along, across) = f"{half.link}.centre", half.centre
        if half.mass:
            order.points.append(LinkPoint(name, half.link, sense * along, sense * across))
            bodies.append(body_at(half.link, half.mass, half.inertia, name))
    found_points, ground = tuple(order.points), dict(linkage.ground)
    return Mechanism(linkage.driver, tuple(groups), tuple(bodies), ground, found_points, order.bars), []


def linkage_of(mechanism: Mechanism) -> Linkage | None:
    """Return the linkage that `mechanism_of` makes a mechanism from, None for another driver or a chain."""
    ends, guides, branches = dict[str, dict[str, Point]](), dict[str, Guide](), dict[str, Branch]()
    origin, driver = (0.0, 0.0), mechanism.driver
    for dyad in mechanism.dyads:
        match dyad:
            case RRR():
                ends[dyad.link_a] = {dyad.joint_a: origin, dyad.point: (dyad.length_a, 0.0)}
                ends[dyad.link_b] = {dyad.joint_b: origin, dyad.point: (dyad.length_b, 0.0)}
                branches[dyad.point] = dyad.branch
            case RRP():
                ends[dyad.link] = {dyad.joint: origin, dyad.slider: (dyad.length, 0.0)}
                ends[dyad.piece], guides[dyad.piece] = {dyad.slider: origin}, dyad.guide
                branches[dyad.slider] = dyad.branch
            case RPR():
                ends[dyad.link], ends[dyad.block] = {dyad.pivot: origin}, {dyad.joint: origin}
                guides[dyad.block], branches[dyad.link] = replace(dyad.slot, link=dyad.link), dyad.branch
            case PRP():
                guides |= {dyad.block_a: dyad.guide_a, dyad.block_b: dyad.guide_b}
                ends |= {block: {dyad.point: origin} for block in (dyad.block_a, dyad.block_b)}
            case RPP():
                guides |= {dyad.link: dyad.guide, dyad.block: replace(dyad.slot, link=dyad.link)}
                ends |= {dyad.link: {}, dyad.block: {dyad.joint: origin}}
            case Chain():
                return None
    if not isinstance(driver, Crank) or driver.geared or any(body.share for body in mechanism.bodies):
        return None
    bodies = {body.link: (body.mass, body.inertia, body.start) for body in mechanism.bodies}
    driving, *members = (
        Member(
            name,
            placed | {point.name: (point.along, point.across) for point in mechanism.points if point.link == name},
            name if name in guides else "",
            *bodies.get(name, ()),
        )
        for name, placed in {driver.link: {}, **ends}.items()
    )
    return Linkage(driver, mechanism.ground, tuple(members), guides, branches, driving=driving)


@dataclass
class _Order:
    """The decomposition so far: solved members, drawn origins of their frames, further points."""

    linkage: Linkage
    drawn: Mapping[str, Point]
    solved: list[str] = field(default_factory=list)
    origins: dict[str, Point] = field(default_factory=dict)
    bars: dict[str, Bar] = field(default_factory=dict)
    points: list[LinkPoint] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list)
    branched: set[str] = field(default_factory=set)

    def group(self, members: list[Member]) -> Dyad | Chain:
        """Return the dyad or chain of some members and record the points that it places."""
        known = known_points(self.linkage, self.solved)
        pairs = (members, members[::-1]) if len(members) == 2 else ()
        dyads = (self._dyad(first, second, known) for first, second in pairs)
        made = next((dyad for dyad in dyads if dyad), None)
        self.solved += [member.name for member in members]
        return made or self._chain(members, known)

    def _dyad(self, a: Member, b: Member, known: set[str]) -> Dyad | None:
        """Return the dyad of two members, or None if they are not one in this order."""
        ka, kb = ([name for name in member.points if name in known] for member in (a, b))
        shared = [name for name in a.points if name in b.points and name not in known]
        guides = [self.linkage.guides.get(member.guide) for member in (a, b)]
        match guides, len(ka), len(kb), shared:
            case [None, None], 1, 1, [point]:
                return self._rrr(a, b, ka[0], kb[0], point)
            case [None, Guide(link=carrier) as guide], 1, 0, [point] if carrier != a.name:
                return self._rrp(a, b, ka[0], point, guide)
            case [None, Guide(link=a.name) as guide], 1, 1, []:
                return self._rpr(a, b, ka[0], kb[0], guide)
            case [Guide() as on_a, Guide() as on_b], 0, 0, [point] if a.name != on_b.link and b.name != on_a.link:
                guide_a, guide_b = self._shifted(on_a, a, point), self._shifted(on_b, b, point)
                self._place(a, a.points[point], {point})
                self._place(b, b.points[point], {point})
                return PRP(point, a.name, b.name, guide_a, guide_b)
            case [Guide() as guide, Guide(link=a.name) as slot], 0, 1, []:
                self._place(a, (0.0, 0.0), set())
                slot = _moved(slot, b.points[kb[0]])
                self._place(b, b.points[kb[0]], {kb[0]})
                return RPP(kb[0], a.name, b.name, slot, self._guide(guide))
        return None

    def _rrr(self, a: Member, b: Member, joint_a: str, joint_b: str, point: str) -> RRR:
        lengths = [self._placed_bar(member, joint, point) for member, joint in ((a, joint_a), (b, joint_b))]
        stated, drawn = self.linkage.positions, self.drawn
        side = 0.0
        if point in stated and {joint_a, joint_b} <= drawn.keys():
            (ax, ay), (bx, by), (cx, cy) = drawn[joint_a], drawn[joint_b], stated[point]
            side = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            side /= math.hypot(bx - ax, by - ay) * lengths[0] or 1.0
        return RRR(joint_a, joint_b, point, a.name, b.name, lengths[0], lengths[1], self._branch(point, side))

    def _rrp(self, link: Member, piece: Member, joint: str, point: str, guide: Guide) -> RRP:
        length = self._placed_bar(link, joint, point)
        line = self._shifted(guide, piece, point)
        self._place(piece, piece.points[point], {point})
        stated, drawn = self.linkage.positions, self.drawn
        ahead = 0.0
        if point in stated and joint in drawn:
            angle, (x, y) = line.angle + self._drawn_angle(line.link), _difference(drawn[joint], stated[point])
            ahead = (x * math.cos(angle) + y * math.sin(angle)) / length
        branch = self._branch(point, ahead)
        return RRP(joint, point, link.name, length, line.point, line.angle, branch, line.link, piece.name)

    def _rpr(self, lever: Member, block: Member, pivot: str, joint: str, guide: Guide) -> RPR:
        x, y = lever.points[pivot]
        slot = Guide((guide.point[0] - x, guide.point[1] - y), guide.angle)
        slot = _moved(slot, block.points[joint])
        self._place(lever, (x, y), {pivot})
        self._place(block, block.points[joint], {joint})
        drawn, ahead = self.drawn, 0.0
        stated = self.linkage.positions
        named = next((name for name in lever.points if name in stated and name != pivot), None)
        if {joint, pivot} <= drawn.keys() and named is not None:
            along, across = _difference(drawn[pivot], drawn[joint])
            (u, v), (p, q) = _difference(drawn[pivot], stated[named]), _difference((x, y), lever.points[named])
            angle = math.atan2(v, u) - math.atan2(q, p) + slot.angle
            ahead = (along * math.cos(angle) + across * math.sin(angle)) / (math.hypot(along, across) or 1.0)
        return RPR(joint, pivot, lever.name, block.name, slot, self._branch(lever.name, ahead))

    def _placed_bar(self, link: Member, joint: str, point: str) -> float:
        """Return the length of a link from a known joint to a new one, and record that line in its frame."""
        start, end = link.points[joint], link.points[point]
        along, across = _difference(start, end)
        bar = Bar(start, end, math.atan2(across, along))
        # the frame of a driving cylinder starts at the end that is known first
        if link.name != self.linkage.driver.link:
            self._place(link, (0.0, 0.0), {joint, point})
            if start != (0.0, 0.0) or bar.angle:
                self.bars[link.name] = bar
        return math.hypot(along, across)

    def _place(self, member: Member, origin: Point, without: set[str]) -> None:
        """Record the drawn origin of the solved frame of a member, and its points in that frame."""
        self.origins[member.name] = origin
        for name, place in member.points.items():
            if name not in without:
                self.points.append(LinkPoint(name, member.name, *_difference(origin, place)))

    def _guide(self, guide: Guide) -> Guide:
        """Return a guide in the solved frame of its carrier."""
        return replace(guide, point=_difference(self.origins.get(guide.link, (0.0, 0.0)), guide.point))

    def _shifted(self, guide: Guide, piece: Member, point: str) -> Guide:
        """Return the line on which a point of a sliding piece moves."""
        return self._guide(_moved(guide, piece.points[point]))

    def _branch(self, name: str, side: float) -> Branch:
        """Return the branch given for a joint or a lever, else that of the positions, else 1."""
        self.branched.add(name)
        given = self.linkage.branches.get(name)
        # a dyad in line to rounding is on no branch
        return given if given is not None else -1 if side < -_IN_LINE else 1

    def check_branches(self) -> None:
        """Report branches given for names without one."""
        for name in self.linkage.branches:
            if name not in self.branched:
                choice = ", ".join(sorted(self.branched))
                message = ErrorMessage("branch_absent" if choice else "branch_none", name=name, known=choice)
                self.problems.append(Problem(f"branch.{name}", message))

    def _drawn_ends(self, cylinder: Member) -> dict[str, Point]:
        """Return the drawn ends of a cylinder, which are points of other links."""
        drawn_points, ends = self.linkage.at_zero(), {}
        for end in cylinder.points:
            for name in self.linkage.owners[end]:
                member = self.linkage.member(name) if name not in self.linkage.base else cylinder
                drawn = [point for point in member.points if point in drawn_points][:2]
                if end in drawn_points:
                    ends[end] = drawn_points[end]
                elif len(drawn) == 2 and member is not cylinder:
                    (x, y), angle = drawn_points[drawn[0]], self._drawn_angle(name, drawn_points)
                    u, v = _difference(member.points[drawn[0]], member.points[end])
                    cos = math.cos(angle)
                    sin = math.sin(angle)
                    ends[end] = (x + u * cos - v * sin, y + u * sin + v * cos)
        return ends

    def _drawn_angle(self, link: str, stated: Mapping[str, Point] | None = None) -> float:
        """Return the initial direction of the drawn frame of a member, from stated or solved positions. [rad]"""
        if not link or link in self.linkage.base:
            return self.linkage.base_frame(link)[1] if link else 0.0
        member, drawn = self.linkage.member(link), self.drawn if stated is None else stated
        if member.guide:
            guide = self.linkage.guides[member.guide]
            return guide.angle + self._drawn_angle(guide.link)
        ends = [name for name in member.points if name in drawn][:2]
        if len(ends) < 2:
            return 0.0
        (x, y), (u, v) = (_difference(*(source[name] for name in ends)) for source in (drawn, member.points))
        return math.atan2(y, x) - math.atan2(v, u)

    def _chain(self, members: list[Member], known: set[str]) -> Chain:
        """Return members that are not a dyad as a chain, started from the positions."""
        links, slides = [], []
        for member in members:
            # a cylinder is drawn by its ends, which are points of other links
            drawn = self._drawn_ends(member) if member.name == self.linkage.driver.link else self.linkage.at_zero()
            anchor = next((name for name in member.points if name in drawn), None)
            if anchor is None or (not member.guide and sum(name in drawn for name in member.points) < 2):
                key = f"{'sliders' if member.guide else 'links'}.{member.name}"
                outer = [name for name in member.points if len(self.linkage.owners[name]) > 1] or list(member.points)
                message = ErrorMessage("positions_needed", name=member.name, joints=", ".join(outer))
                self.problems.append(Problem(key, message))
                continue
            angle, (u, v) = self._drawn_angle(member.name, drawn), member.points[anchor]
            cos, sin = math.cos(angle), math.sin(angle)
            origin = (drawn[anchor][0] - u * cos + v * sin, drawn[anchor][1] - u * sin - v * cos)
            links.append(ChainLink(member.name, origin, angle, dict(member.points)))
            if member.guide:
                slides.append(Slide(member.name, self._guide(self.linkage.guides[member.guide])))
        joints = {name for owner in members for name in owner.points}
        law = self.linkage.driver.law
        start, radian = (law.start if law else 0.0), 1.0
        if not self.linkage.driver.turns:
            points = [tuple(part.points.values()) for part in links]
            radian = max((math.dist(first, second) for own in points for first in own for second in own), default=1.0)
        return Chain(tuple(links), tuple(slides), frozenset(joints & known), start, radian)


def _moved(guide: Guide, offset: Point) -> Guide:
    """Return a guide whose line passes through a point given in the frame of its sliding piece."""
    cos, sin = math.cos(guide.angle), math.sin(guide.angle)
    (x, y), (u, v) = guide.point, offset
    return replace(guide, point=(x + u * cos - v * sin, y + u * sin + v * cos))


def _difference(start: Point, end: Point) -> Point:
    return end[0] - start[0], end[1] - start[1]
