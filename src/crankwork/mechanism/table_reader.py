"""Linkages described in tables, with every mistake in what they say together at once.

The tables come from `description`, which has checked keys and types.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from itertools import product
from typing import Any

from crankwork.errors import Problem
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Cylinder, CylinderPart, DrivingSlider, GearedCrank, Law, LinkMotor
from crankwork.mechanism.dyads import Branch, Guide, Point
from crankwork.mechanism.linkage import GROUND, LengthInertia, Linkage, MassPerLength, Member
from crankwork.mechanism.mechanism import Crank, Driver
from crankwork.mechanism.structure import structure

Table = Mapping[str, Any]

_MASS = ("mass", "inertia", "centre")
_DRIVERS = ("slider", "cylinder", "between")
_HALVES = ("barrel", "rod")
_SAME = 1e-12
# axes of wheels that turn about one point are less apart [m]
_TOGETHER = 1e-9


def linkage_from(tables: Table) -> tuple[Linkage | None, list[Problem]]:
    """Return the linkage that tables describe, or every problem in them."""
    reader = _Reader(tables)
    linkage = reader.linkage()
    return (None, reader.problems) if reader.problems else (linkage, [])


@dataclass
class _Reader:
    """Reads the tables and collects the problems."""

    tables: Table
    problems: list[Problem] = field(default_factory=list)

    def linkage(self) -> Linkage:
        """Return the linkage, which is valid only without problems."""
        ground, positions = (
            {name: (point[0], point[1]) for name, point in self._table(key).items()}
            for key in ("fixed_points", "positions")
        )
        guides = {name: self._guide(name, guide, ground) for name, guide in self._table("guides").items()}
        law: Any = self._table("driver").get("law")
        named = [name for name in _DRIVERS if name in self._table("driver")]
        sliders = tuple(self._sliders())
        driver: Driver
        if named:
            if len(named) > 1 or "crank" in self.tables:
                further = ", ".join([*named[1:], *(["crank"] if "crank" in self.tables else [])])
                self._problem(f"driver.{named[0]}", ErrorMessage("drivers_many", one=named[0], others=further))
            driver, driving = self._driving_slider(sliders, guides, law)
        else:
            driver, driving = self._crank(ground, law)
        geared: tuple[Member, ...] = ()
        if isinstance(driver, Crank):
            cranks, geared = self._geared(ground)
            driver = replace(driver, geared=cranks)
        elif "geared" in self.tables:
            self._problem("geared", ErrorMessage("geared_alone"))
        drawn = Linkage(driver, ground, (), positions=positions, driving=driving, geared=geared).at_zero()
        links = tuple(self._links(drawn))
        members = (*links, *(slider for slider in sliders if slider.name != driving.name))
        branches: dict[str, Branch] = {name: 1 if value == 1 else -1 for name, value in self._table("branch").items()}
        linkage = Linkage(driver, ground, members, guides, branches, positions, driving, geared)
        self._names(linkage)
        if self.problems or not named:
            return linkage
        if named[0] == "cylinder":
            return self._with_cylinder(linkage, law)
        return self._with_motor(linkage, law) if named[0] == "between" else linkage

    def _problem(self, key: str, message: str) -> None:
        self.problems.append(Problem(key, message))

    def _table(self, key: str) -> Table:
        return self.tables.get(key, {})  # type: ignore[no-any-return]

    def _word(self, key: str, value: str) -> str:
        if not value:
            self._problem(key, ErrorMessage("name_needed"))
        return value

    def _driving_slider(
        self, sliders: tuple[Member, ...], guides: Mapping[str, Guide], law: Law
    ) -> tuple[DrivingSlider, Member]:
        """Return the driving slider, also as a member; an empty one without a valid slider."""
        name = self._table("driver").get("slider")
        no_driver = DrivingSlider("", Guide(), law), Member("", {})
        if name is None:
            return no_driver
        slider = next((candidate for candidate in sliders if candidate.name == name), None)
        if slider is None:
            known = ", ".join(candidate.name for candidate in sliders)
            self._problem("driver.slider", ErrorMessage("absent_slider", name=name[:40], known=known))
            return no_driver
        guide = guides.get(slider.guide, Guide())
        if guide.link:
            self._problem(
                "driver.slider", ErrorMessage("driven_on_link", name=slider.name, guide=slider.guide, link=guide.link)
            )
        return DrivingSlider(slider.name, guide, law), slider

    def _two(self, key: str, known: Mapping[str, object] | set[str], refusal: str) -> tuple[str, str] | None:
        """Return two different, known names."""
        names = self._table("driver")[key]
        for name in names:
            if name not in known:
                self._problem(f"driver.{key}", ErrorMessage(refusal, name=name[:40], known=", ".join(sorted(known))))
        if names[0] == names[1]:
            self._problem(f"driver.{key}", ErrorMessage("driver_same", name=names[0][:40]))
        return None if self.problems else (names[0], names[1])

    def _with_cylinder(self, linkage: Linkage, law: Law) -> Linkage:
        """Return a linkage with a link of changing length between two of its points."""
        ends = self._two("cylinder", set(linkage.owners), "absent_point")
        if ends is None:
            return linkage
        taken = {existing.name for existing in linkage.members}
        name = next(word for word in ("cylinder", "hydraulic_cylinder", "cylinder_link") if word not in taken)
        both = set(linkage.owners[ends[0]]) & set(linkage.owners[ends[1]])
        if both:
            message = ErrorMessage("cylinder_idle", first=ends[0], second=ends[1], name=min(both))
            self._problem("driver.cylinder", message)
        member = Member(name, {ends[0]: (0.0, 0.0), ends[1]: (law.start, 0.0)})
        members = (*linkage.members, member)
        halves = tuple(self._half(part, f"{name}_{part}" if part in taken else part) for part in _HALVES)
        halves = halves if any(half.mass for half in halves) else ()
        return replace(linkage, driver=Cylinder(*ends, law, name, halves), members=members)

    def _half(self, name: str, link: str) -> CylinderPart:
        """Return the barrel or the rod of a cylinder, massless by default."""
        table = self._table("driver").get(name)
        if table is None:
            return CylinderPart(link, 0.0, 0.0, (0.0, 0.0))
        return CylinderPart(link, table["mass"], table.get("inertia", 0.0), tuple(table["centre"]))

    def _with_motor(self, linkage: Linkage, law: Law) -> Linkage:
        """Return a linkage with the third side of the triangle of a motor between two links."""
        links = self._two("between", {link.name for link in linkage.members if not link.guide}, "absent_link")
        if links is None:
            return linkage
        first, second = (linkage.member(name) for name in links)
        pin = next((name for name in first.points if name in second.points), "")
        if not pin:
            self._problem("driver.between", ErrorMessage("motor_pin", first=first.name, second=second.name))
            return linkage
        drawn, linkages = linkage.at_zero(), []
        for end_a, end_b in product(self._joints(linkage, first, pin), self._joints(linkage, second, pin)):
            if not {end_a, end_b, pin} <= drawn.keys():
                continue
            sides = tuple(
                math.dist(link.points[pin], link.points[end]) for link, end in ((first, end_a), (second, end_b))
            )
            (cx, cy), (ax, ay), (bx, by) = drawn[pin], drawn[end_a], drawn[end_b]
            angle = math.remainder(math.atan2(by - cy, bx - cx) - math.atan2(ay - cy, ax - cx), math.tau)
            a, b = sides
            opened = angle + law.start
            length = math.sqrt(max(a * a + b * b - 2 * a * b * math.cos(opened), 0.0))
            motor = LinkMotor(links, pin, (a, b), angle, law)
            member = Member(motor.link, {end_a: (0.0, 0.0), end_b: (length, 0.0)})
            linkages.append(replace(linkage, driver=motor, members=(*linkage.members, member)))
        if not linkages:
            self._problem("driver.between", ErrorMessage("motor_drawn", first=first.name, second=second.name, pin=pin))
            return linkage
        # of several third sides the first that leaves dyads only
        structures = ((candidate, structure(candidate)[0]) for candidate in linkages)
        return next((candidate for candidate, made in structures if made and made.number <= 2), linkages[0])

    @staticmethod
    def _joints(linkage: Linkage, member: Member, pin: str) -> list[str]:
        return [name for name in member.points if name != pin and len(linkage.owners[name]) > 1]

    def _crank(self, ground: Mapping[str, Point], law: Law | None) -> tuple[Crank, Member]:
        table = self._table("crank")
        pivot, pin = self._word("crank.pivot", table["pivot"]), self._word("crank.pin", table["pin"])
        if pivot and pivot not in ground:
            self._problem("crank.pivot", ErrorMessage("pivot_unknown", name=pivot))
        if pin in ground:
            self._problem("crank.pin", ErrorMessage("pin_fixed", name=pin))
        radius, start = float(table["radius"]), float(table.get("start", 0.0))
        sense: Branch = -1 if table.get("direction") == "clockwise" else 1
        pivoted = ground.get(pivot, (0.0, 0.0))
        crank = Crank(radius, pivoted, start, sense, pin, law=law)
        points = self._points("crank", table, {pin, *ground})
        places = {pivot: (0.0, 0.0), pin: (radius, 0.0), **points}
        return crank, self._turning("crank", Member(crank.link, points), table, places)

    def _points(self, key: str, table: Table, placed: Container[object]) -> dict[str, Point]:
        """Return the points of a body; report those that have their place already."""
        points = _points(table)
        for point in filter(placed.__contains__, points):
            self._problem(f"{key}.points.{point}", ErrorMessage("point_placed", name=point))
        return points

    def _geared(self, ground: Mapping[str, Point]) -> tuple[tuple[GearedCrank, ...], tuple[Member, ...]]:
        """Return the geared cranks, also as members."""
        cranks, members = [], []
        for name, table in self._table("geared").items():
            key = f"geared.{name}"
            pivot = self._word(f"{key}.pivot", table["pivot"])
            ratio = table["ratio"]
            angle = table.get("pressure_angle")
            if pivot and pivot not in ground:
                self._problem(f"{key}.pivot", ErrorMessage("pivot_unknown", name=pivot))
            if not ratio:
                self._problem(f"{key}.ratio", ErrorMessage("ratio_zero"))
            axes = [ground.get(name, (0.0, 0.0)) for name in (pivot, str(self._table("crank").get("pivot")))]
            if angle is not None and (ratio == 1 or math.dist(*axes) < _TOGETHER):
                self._problem(f"{key}.pressure_angle", ErrorMessage("wheels_apart"))
            crank = GearedCrank(name, ground.get(pivot, (0.0, 0.0)), ratio, table.get("start", 0.0), angle)
            points = self._points(key, table, {self._table("crank").get("pin"), *ground})
            if not points:
                self._problem(f"{key}.points", ErrorMessage("geared_points"))
            cranks.append(crank)
            members.append(self._turning(key, Member(name, points), table, {pivot: (0.0, 0.0), **points}))
        return tuple(cranks), tuple(members)

    def _turning(self, key: str, member: Member, table: Table, places: Mapping[str, Point]) -> Member:
        """Return a crank with its mass; its moment of inertia is stated about its axis unless the file says otherwise.

        `places`: its points in its frame, the pivot first.
        """
        if not any(name in table for name in _MASS):
            return member
        member, mass = _weighed(table, member, places, 0.0)
        inertia = self._inertia(table)
        centre = table.get("centre", next(iter(places)))
        points, places = dict(member.points), dict(places)
        if not isinstance(centre, str):
            name = f"{member.name}.centre"
            points[name] = places[name] = _centre_place(centre, places)
            member = replace(member, centre_share=_share(centre))
            centre = name
        elif centre not in places:
            known = ", ".join(places)
            self._problem(f"{key}.centre", ErrorMessage("centre_unknown", centre=centre, link=member.name, known=known))
            return member
        if isinstance(table.get("inertia"), LengthInertia):
            if not mass:
                self._problem(f"{key}.inertia", ErrorMessage("only_beside", key="mass", advice='mass = "2 kg"'))
            return self._of_length(key, table, _replaced(member, points, mass, 0.0, centre), places)
        turning = mass * math.hypot(*places[centre]) ** 2
        if table.get("inertia_about") == "centre":
            return _replaced(member, points, mass, inertia, centre)
        if "inertia" in table and inertia < turning * (1 - _SAME):
            self._problem(f"{key}.inertia", ErrorMessage("crank_inertia_small", least=turning))
        own = max(inertia - turning, 0.0) if "inertia" in table else 0.0
        return _replaced(member, points, mass, own, centre)

    def _links(self, drawn: Mapping[str, Point]) -> Iterator[Member]:
        for name, table in self._table("links").items():
            key, joins = f"links.{name}", table["joins"]
            if len(set(joins)) < len(joins):
                self._problem(f"{key}.joins", ErrorMessage("joins_twice", names=", ".join(joins)[:80]))
                continue
            points = _points(table)
            for point in {*points, ""}.intersection(joins[:2]):
                self._problem(f"{key}.points.{point}", ErrorMessage("point_of_joint", name=point))
            places = self._joint_places(key, table, list(joins), points, drawn)
            yield self._with_mass(key, table, Member(name, {**places, **points}))

    def _joint_places(
        self, key: str, table: Table, joins: list[str], points: Mapping[str, Point], drawn: Mapping[str, Point]
    ) -> dict[str, Point]:
        """Return the joints of a link in its frame, from its length or their drawn positions."""
        first, second, *further = joins
        if "length" in table:
            length = float(table["length"])
        elif first in drawn and second in drawn:
            length = math.dist(drawn[first], drawn[second])
            if length == 0:
                self._problem(key, ErrorMessage("joints_together", first=first, second=second))
                length = 1.0
        else:
            self._problem(f"{key}.length", ErrorMessage("link_length", first=first, second=second))
            length = 1.0
        places = {first: (0.0, 0.0), second: (length, 0.0)}
        for name in further:
            if name in points:
                continue
            if not {first, second, name} <= drawn.keys():
                self._problem(f"{key}.points.{name}", ErrorMessage("link_point", name=name, first=first, second=second))
                continue
            (x, y), (ax, ay), (bx, by) = drawn[name], drawn[first], drawn[second]
            cos, sin = (bx - ax) / math.dist((ax, ay), (bx, by)), (by - ay) / math.dist((ax, ay), (bx, by))
            places[name] = ((x - ax) * cos + (y - ay) * sin, (y - ay) * cos - (x - ax) * sin)
        return places

    def _sliders(self) -> Iterator[Member]:
        for name, table in self._table("sliders").items():
            key = f"sliders.{name}"
            guide = self._word(f"{key}.guide", table["guide"])
            points = self._points(key, table, {table.get("pin")})
            if "pin" in table:
                points = {self._word(f"{key}.pin", table["pin"]): (0.0, 0.0), **points}
            yield self._with_mass(key, table, Member(name, points, guide))

    def _with_mass(self, key: str, table: Table, member: Member) -> Member:
        if not any(name in table for name in _MASS):
            return member
        if "mass" not in table:
            self._problem(f"{key}.mass", ErrorMessage("number_missing"))
        member, mass = _weighed(table, member, member.points, 1.0)
        inertia = self._inertia(table)
        centre = table.get("centre", next(iter(member.points), (0.0, 0.0)) if member.guide else None)
        if not isinstance(centre, str):
            name, place = f"{member.name}.centre", _centre_place(centre or 0.0, member.points)
            member = replace(member, centre_share=_share(centre))
            if centre is None:
                self._problem(f"{key}.centre", ErrorMessage("pair_missing"))
            member = _replaced(member, {**member.points, name: place}, mass, inertia, name)
            return self._of_length(key, table, member, member.points)
        if centre not in member.points:
            message = ErrorMessage(
                "centre_unknown" if member.guide else "centre_of_link",
                centre=centre, link=member.name, known=", ".join(member.points),
            )  # fmt: skip
            self._problem(f"{key}.centre", message)
            return member
        return self._of_length(key, table, _replaced(member, member.points, mass, inertia, centre), member.points)

    @staticmethod
    def _inertia(table: Table) -> float:
        """Return a moment of inertia that is stated as a number; zero for one that follows from a length. [kg m2]"""
        stated = table.get("inertia", 0.0)
        return 0.0 if isinstance(stated, LengthInertia) else float(stated)

    def _of_length(self, key: str, table: Table, member: Member, places: Mapping[str, Point]) -> Member:
        """Return a body with the moment of inertia that follows from a radius, or from its first two places."""
        if radius := table.get("radius_of_gyration"):
            return replace(member, inertia=member.mass * radius**2, gyration_radius=radius)
        stated = table.get("inertia")
        if not isinstance(stated, LengthInertia):
            return member
        first, second, *_ = places.values()
        length, middle = math.dist(first, second), ((first[0] + second[0]) / 2, (first[1] + second[1]) / 2)
        if stated.about_end and math.dist(places[member.centre], middle) > _SAME * length:
            self._problem(f"{key}.inertia", ErrorMessage("inertia_about_end"))
        own = stated.about_centre(member.mass, length)
        return replace(member, inertia=own, length_inertia=stated, bar_length=length)

    def _guide(self, name: str, table: Table, ground: Mapping[str, Point]) -> Guide:
        key, through = f"guides.{name}", table.get("through", [0.0, 0.0])
        link = self._word(f"{key}.link", table["link"]) if "link" in table else ""
        links = self.tables.get("links")
        if link and isinstance(links, dict) and [through] == list(links.get(link, {}).get("joins", ()))[:1]:
            through = [0.0, 0.0]  # Where the frame of the link begins
        if not isinstance(through, str):
            point = through[0], through[1]
        elif through in ground and not link:
            point = ground[through]
        else:
            refusal = "through_of_link" if link else "through_unknown"
            self._problem(f"{key}.through", ErrorMessage(refusal, name=through, link=link))
            point = (0.0, 0.0)
        return Guide(point, table.get("angle", 0.0), link)

    def _names(self, linkage: Linkage) -> None:
        """Report names that are used twice or unknown."""
        names = {*linkage.base} - {GROUND}
        for member in linkage.members:
            table = "sliders" if member.guide else "links"
            if member.name in names:
                self._problem(f"{table}.{member.name}", ErrorMessage("link_named_twice", name=member.name))
            names.add(member.name)
            if member.guide and member.guide not in linkage.guides:
                self._problem(f"{table}.{member.name}.guide", ErrorMessage("guide_unknown", name=member.guide))
        for name, guide in linkage.guides.items():
            if guide.link and guide.link not in names:
                self._problem(
                    f"guides.{name}.link",
                    ErrorMessage("carrier_unknown", name=guide.link, known=", ".join(sorted(names))),
                )
        placed = {linkage.driver.pin} if isinstance(linkage.driver, Crank) else set(linkage.driving.points)
        for name in linkage.positions:
            if name in linkage.ground or name in placed:
                self._problem(f"positions.{name}", ErrorMessage("position_known", name=name))


def _weighed(table: Table, member: Member, places: Mapping[str, Point], without: float) -> tuple[Member, float]:
    """Return a body and its mass [kg]; one stated per length is that of a bar between the first two places."""
    mass = table.get("mass", without)
    if not isinstance(mass, MassPerLength):
        return member, mass
    first, second, *_ = places.values()
    length = math.dist(first, second)
    return replace(member, length_mass=mass, bar_length=length), mass.value * length


def _replaced(member: Member, points: Mapping[str, Point], mass: float, inertia: float, centre: str) -> Member:
    values = {entry.name: getattr(member, entry.name) for entry in fields(member)}
    return Member(**{**values, "points": points, "mass": mass, "inertia": inertia, "centre": centre})


def _share(centre: object) -> float | None:
    """Return the share of the distance of the first two joints that a centre of mass is stated by."""
    return float(centre) if isinstance(centre, int | float) else None


def _centre_place(centre: Any, places: Mapping[str, Point]) -> Point:  # noqa: ANN401 - a share, or a pair
    """Return a centre of mass in the frame of its body; of a share, on the line of its first two joints."""
    share = _share(centre)
    if share is None:
        return centre[0], centre[1]
    first, second, *_ = *places.values(), (0.0, 0.0)
    return first[0] + share * (second[0] - first[0]), first[1] + share * (second[1] - first[1])


def _points(table: Table) -> dict[str, Point]:
    return {name: (point[0], point[1]) for name, point in table.get("points", {}).items()}
