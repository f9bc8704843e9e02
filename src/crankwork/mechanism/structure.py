"""Structure of a linkage: mobility, Assur groups with their classes, and the structural formula."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal, NamedTuple

from crankwork.errors import Problem
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue, absent, given
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Cylinder, LinkMotor, rod_name
from crankwork.mechanism.linkage import GROUND, Linkage, Member

# largest number of sets of members examined for one group
_MAX_CANDIDATES = 20_000
ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")


@dataclass(frozen=True)
class AssurGroup:
    """Members that are solved together, in the order given."""

    members: tuple[str, ...]  # Their names
    # The class: 2 for a dyad, 3 around a link with three joints, otherwise the links of a closed loop
    number: int


@dataclass(frozen=True)
class Structure:
    """Mobility and groups of a linkage."""

    links: tuple[str, ...]  # Moving links, the driving ones first; their numbers in the formula
    joints: int  # Lower pairs (one degree of freedom), p5
    groups: tuple[AssurGroup, ...]  # Groups in the order in which they are solved
    drive: tuple[str, str] = (GROUND, "")  # The links between which the driver acts; ground and first link by default
    meshes: int = 0  # Pairs of gears, p4
    driven: str = ""  # The group member that stands for both links of a driver between links

    @property
    def mobility(self) -> int:
        """Degrees of freedom (Chebyshev)."""
        return int(chain_mobility(len(self.links), self.joints, self.meshes))

    @property
    def number(self) -> int:
        """The class of the mechanism, that of its highest group."""
        return max((group.number for group in self.groups), default=1)

    @property
    def formula(self) -> str:
        """The formula of structure, for example `I(0,1) -> II(2,3) -> II(4,5)`.

        A driver between links 1 and 2 joins them to one member `1+2`, which its group moves.
        """
        numbers = {name: str(count) for count, name in enumerate(self.links, start=1)}
        first, second = ({GROUND: "0", "": "1", **numbers}[name] for name in self.drive)
        inside = {**numbers, self.driven: f"{first}+{second}"} if self.driven else numbers
        groups = (
            f"{ROMAN[group.number]}({','.join(sorted((inside[name] for name in group.members), key=_first_number))})"
            for group in self.groups
        )
        return " -> ".join([f"I({first},{second})", *groups])


def _first_number(links: str) -> int:
    return int(links.partition("+")[0])


def mobility(linkage: Linkage) -> TracedValue:
    """Return the degrees of freedom of a linkage.

    `linkage`: crank, links and sliding pieces; a pin of k links counts k - 1 joints. Source: artobolevsky_1988, ch.
    2; Chebyshev's formula without higher pairs.
    """
    links, joints = given("moving_links", float(len(links_of(linkage)))), given("lower_pairs", float(_joints(linkage)))
    meshes = given("gear_meshes", float(len(linkage.geared))) if linkage.geared else absent("gear_meshes")
    freedom: TracedValue = chain_mobility(links, joints, meshes)
    return freedom


def _joints(linkage: Linkage) -> int:
    pins = sum(len(owners) - 1 for owners in linkage.owners.values())
    # the joint of the driver, but for a motor less the two pins of its third side, which is not a link
    own = -2 if isinstance(linkage.driver, LinkMotor) else 1
    return own + pins + len(linkage.geared) + sum(1 for member in linkage.members if member.guide)


def links_of(linkage: Linkage) -> tuple[str, ...]:
    """Return the moving links, driving ones first, with the rod of a cylinder, without the third side of a motor."""
    names = [member.name for member in linkage.members]
    match linkage.driver:
        case Cylinder(link=link):
            names = [link, rod_name(link), *names]
        case LinkMotor(link=link, links=links):
            names = [*links, *(name for name in names if name != link)]
        case _:
            names = [linkage.driver.link, *(crank.name for crank in linkage.geared), *names]
    return tuple(dict.fromkeys(names))


def structure(linkage: Linkage) -> tuple[Structure | None, list[Problem]]:
    """Return the structure of a linkage, or the problems that prevent it (artobolevsky_1988, ch. 2-3)."""
    problems = _underconstrained(linkage)
    if problems:
        return None, problems
    names = [member.name for member in linkage.members]
    solved: set[str] = set()
    groups: list[AssurGroup] = []
    bodies = {name: name for name in linkage.base}
    while len(solved) < len(names):
        rest = [name for name in names if name not in solved]
        equations = _Equations(linkage, solved)
        group = _smallest_group(linkage, rest, equations)
        if group is None:
            return None, [Problem("", _too_free(linkage, rest))]
        if equations.excess(group) > 0:
            return None, [_too_stiff(linkage, group, solved)]
        # a link of changing length moves its group on any carrier
        carrier = "" if linkage.driver.link in group else _only_carrier(linkage, group, bodies)
        stuck = next((name for name in group if carrier and linkage.member(name).guide), None)
        if stuck is not None:
            message = ErrorMessage("still_slider", slider=stuck, names=list(group), bearer=carrier)
            return None, [Problem(_key(linkage, stuck), message)]
        bodies |= {name: carrier or name for name in group}
        groups.append(AssurGroup(group, _class(linkage, group, solved)))
        solved |= set(group)
    links, driver = links_of(linkage), linkage.driver
    drive = links[:2] if isinstance(driver, Cylinder | LinkMotor) else (GROUND, links[0])
    driven = "" if drive[0] == GROUND else driver.link
    return Structure(links, _joints(linkage), tuple(groups), (drive[0], drive[1]), len(linkage.geared), driven), []


def _only_carrier(linkage: Linkage, group: tuple[str, ...], bodies: dict[str, str]) -> str:
    """Return the only body that carries all outer joints of a group, which cannot move on it; empty for none."""
    carriers = []
    for name in group:
        member = linkage.member(name)
        owners = ({bodies[link] for link in linkage.owners[point] if link in bodies} for point in member.points)
        carriers += [links for links in owners if links]
        carrier = (linkage.guides[member.guide].link or GROUND) if member.guide else ""
        carriers += [{bodies[carrier]}] if carrier in bodies else []
    return min(set.intersection(*carriers), default="") if carriers else ""


def _smallest_group(linkage: Linkage, rest: list[str], equations: _Equations) -> tuple[str, ...] | None:
    """Return the smallest set of members that solved ones determine or overdetermine, the first in order."""
    order = {name: number for number, name in enumerate(rest)}
    neighbours = [{order[name] for name in joined} for joined in _neighbours(linkage, rest, equations.known).values()]
    # only connected members: of two unconnected groups, one alone is determined
    candidates: list[tuple[int, ...]] = [(number,) for number in range(len(rest))]
    while candidates and len(candidates) <= _MAX_CANDIDATES:
        for candidate in candidates:
            names = tuple(rest[number] for number in candidate)
            if equations.excess(names) >= 0:
                return names
        candidates = sorted({
            tuple(sorted((*numbers, other)))
            for numbers in candidates
            for other in set().union(*(neighbours[number] for number in numbers)).difference(numbers)
        })  # fmt: skip
    return None


def known_points(linkage: Linkage, solved: Iterable[str]) -> set[str]:
    """Return the points that are placed once some members are solved."""
    members = {*linkage.base, *solved}
    return {name for name, owners in linkage.owners.items() if not members.isdisjoint(owners)}


class _Equations:
    """Counts the equations of the joints of members, given the solved ones."""

    def __init__(self, linkage: Linkage, solved: set[str]) -> None:
        self.members = {member.name: member for member in linkage.members}
        self.guides = linkage.guides
        self.known = known_points(linkage, solved)
        self.carriers = {"", *linkage.base, *solved}

    def excess(self, group: tuple[str, ...]) -> int:
        """Return the equations less the coordinates of members: 0 for a group, more if it is over-constrained."""
        pinned = [point for name in group for point in self.members[name].points]
        free = {point for point in pinned if point not in self.known}
        guides = [self.guides[guide].link for name in group if (guide := self.members[name].guide)]
        guided = sum(1 for link in guides if link in self.carriers or link in group)
        return 2 * (len(pinned) - len(free) + guided) - 3 * len(group)


def _class(linkage: Linkage, group: tuple[str, ...], solved: set[str]) -> int:
    """Return the class of a group: the links of its longest closed loop of inner joints, at least three."""
    if len(group) == 2:
        return 2
    neighbours = _neighbours(linkage, group, known_points(linkage, solved))
    return max([3, *(_longest_loop(neighbours, name) for name in group)])


def _neighbours(linkage: Linkage, members: Iterable[str], known: set[str]) -> dict[str, set[str]]:
    """Return for each member those connected to it at an unknown point or by a guide."""
    neighbours: dict[str, set[str]] = {name: set() for name in members}
    for point, owners in linkage.owners.items():
        if point not in known:
            for first, second in combinations([name for name in owners if name in neighbours], 2):
                neighbours[first].add(second)
                neighbours[second].add(first)
    for member in linkage.members:
        carrier = linkage.guides[member.guide].link if member.guide else ""
        if member.name in neighbours and carrier in neighbours:
            neighbours[member.name].add(carrier)
            neighbours[carrier].add(member.name)
    return neighbours


def _longest_loop(neighbours: dict[str, set[str]], first: str) -> int:
    def walk(path: list[str]) -> int:
        longest = len(path) if len(path) > 3 and first in neighbours[path[-1]] else 0
        return max([longest, *(walk([*path, name]) for name in neighbours[path[-1]] if name not in path)])

    return walk([first])


def _underconstrained(linkage: Linkage) -> list[Problem]:
    """Return the problems of members with fewer than two joints."""
    owners, problems = linkage.owners, []
    carriers = {guide.link for name, guide in linkage.guides.items() if any(m.guide == name for m in linkage.members)}
    for member in linkage.members:
        joints = [name for name in member.points if len(owners[name]) > 1]
        count = len(joints) + bool(member.guide) + (member.name in carriers)
        if count < 2:
            problems.append(Problem(_key(linkage, member.name), _underconstrained_message(member, joints, owners)))
    return problems


def _underconstrained_message(member: Member, joints: list[str], owners: Mapping[str, Sequence[str]]) -> ErrorMessage:
    if not joints:
        return ErrorMessage("hangs_on_guide" if member.guide else "hangs_alone", name=member.name)
    alone = tuple(name for name in member.points if len(owners[name]) == 1 and name != member.centre)
    key = "hangs_on_one_also" if alone else "hangs_on_one"
    return ErrorMessage(key, name=member.name, joint=joints[0], alone=alone)


def _too_free(linkage: Linkage, rest: list[str]) -> ErrorMessage:
    freedom, rest = float(mobility(linkage).value), _described(linkage, rest)
    return ErrorMessage("free_some" if len(rest) > 1 else "free_one", mobility=freedom, names=", ".join(rest))


def _too_stiff(linkage: Linkage, group: tuple[str, ...], solved: Iterable[str]) -> Problem:
    freedom, names = float(mobility(linkage).value), _described(linkage, group)
    if not names:
        key = "driver.cylinder" if isinstance(linkage.driver, Cylinder) else "driver.between"
        return Problem(key, ErrorMessage("driver_held", names=_described(linkage, sorted(solved)), mobility=freedom))
    message = ErrorMessage("stiff_some" if len(names) > 1 else "stiff_one", names=names, mobility=freedom)
    return Problem(_key(linkage, names[0]), message)


def _described(linkage: Linkage, members: Iterable[str]) -> list[str]:
    """Return the members without a link whose length drives."""
    return [name for name in members if name != linkage.driver.link]


def _key(linkage: Linkage, name: str) -> str:
    return f"{'sliders' if linkage.member(name).guide else 'links'}.{name}"


@formula("mobility", "artobolevsky_1988, ch. 2")
def chain_mobility(n_i: Value, p_5: Value, p_4: Value) -> Value:
    """Degrees of freedom of a planar chain whose higher pairs are gears."""
    return 3 * n_i - 2 * p_5 - p_4


FourBarType = Literal["crank-rocker", "double crank", "double rocker", "rocker-crank", "triple rocker", "change point"]


class Grashof(NamedTuple):
    """The type of a four-bar linkage, and p + q - s - l: positive if its shortest link turns fully. [m]"""

    type: FourBarType
    margin: float


def grashof(crank: float, coupler: float, rocker: float, ground: float) -> Grashof:
    """Return the type of a four-bar linkage (norton_2012, ch. 2).

    Type and margin; `change point` where the links can all come into line. `crank`, `coupler`, `rocker` and `ground`:
    the lengths; the crank is the link that drives [m].
    """
    lengths = (crank, coupler, rocker, ground)
    shortest, longest = min(lengths), max(lengths)
    margin = sum(lengths) - 2 * shortest - 2 * longest
    if abs(margin) <= 1e-12 * longest:
        return Grashof("change point", 0.0)
    if margin < 0:
        return Grashof("triple rocker", margin)
    types: tuple[FourBarType, ...] = ("crank-rocker", "double rocker", "rocker-crank", "double crank")
    return Grashof(types[lengths.index(shortest)], margin)
