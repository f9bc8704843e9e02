"""What a linkage is made of: its mobility, its Assur groups and their classes, the formula of its structure."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from crankwork.errors import Problem
from crankwork.formula.expression import Value, formula
from crankwork.formula.known import Known, absent, given
from crankwork.locale import Refusal
from crankwork.mechanism.driver import Cylinder, LinkMotor, rod_name
from crankwork.mechanism.linkage import GROUND, Linkage, Member

# sets of members looked at for one group; larger groups than any linkage has
_MOST_CANDIDATES = 20_000
_ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")


@dataclass(frozen=True)
class AssurGroup:
    """Members that have to be solved together, in the order given."""

    members: tuple[str, ...]  # Their names
    # The class: 2 for a dyad, 3 for a group about a link with three joints, 4 and more for a
    # closed loop of as many links
    number: int


@dataclass(frozen=True)
class Structure:
    """Mobility and groups of a linkage."""

    links: tuple[str, ...]  # Moving links, the driving ones first; their numbers in the formula
    joints: int  # Joints of one freedom, p5
    groups: tuple[AssurGroup, ...]  # Groups in the order in which they are solved
    drive: tuple[str, str] = (GROUND, "")  # What the driver moves against each other; the first link by default
    meshes: int = 0  # Pairs of gears, p4
    driven: str = ""  # The member of a group that a driver between two links makes of them

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

        A driver between links 1 and 2 makes one link of them, `1+2`, that its group moves.
        """
        numbers = {name: str(count) for count, name in enumerate(self.links, start=1)}
        first, second = ({GROUND: "0", "": "1", **numbers}[name] for name in self.drive)
        inside = {**numbers, self.driven: f"{first}+{second}"} if self.driven else numbers
        groups = (
            f"{_ROMAN[group.number]}({','.join(sorted((inside[name] for name in group.members), key=_first_number))})"
            for group in self.groups
        )
        return " -> ".join([f"I({first},{second})", *groups])


def _first_number(links: str) -> int:
    return int(links.partition("+")[0])


def mobility(linkage: Linkage) -> Known:
    """Return the degrees of freedom of a linkage.

    `linkage`: crank, links and sliding pieces; a pin of k links counts k - 1 joints. Source: artobolevsky_1988, ch.
    2; Chebyshev's formula without higher pairs.
    """
    links, joints = given("moving_links", float(len(links_of(linkage)))), given("lower_pairs", float(_joints(linkage)))
    meshes = given("gear_meshes", float(len(linkage.geared))) if linkage.geared else absent("gear_meshes")
    found: Known = chain_mobility(links, joints, meshes)
    return found


def _joints(linkage: Linkage) -> int:
    pins = sum(len(owners) - 1 for owners in linkage.owners.values())
    # that of the driver: a pivot, a guide, or barrel and rod; a motor sits in a pin, and its third side in none
    own = -2 if isinstance(linkage.driver, LinkMotor) else 1
    return own + pins + len(linkage.geared) + sum(1 for one in linkage.members if one.guide)


def links_of(linkage: Linkage) -> tuple[str, ...]:
    """Return the moving links, the driving ones first: the rod of a cylinder is one, a third side is none."""
    names = [one.name for one in linkage.members]
    match linkage.driver:
        case Cylinder(link=link):
            names = [link, rod_name(link), *names]
        case LinkMotor(link=link, links=links):
            names = [*links, *(name for name in names if name != link)]
        case _:
            names = [linkage.driver.link, *(one.name for one in linkage.geared), *names]
    return tuple(dict.fromkeys(names))


def structure(linkage: Linkage) -> tuple[Structure | None, list[Problem]]:
    """Return the structure of a linkage, or what keeps it from having one (artobolevsky_1988, ch. 2-3).

    The structure where there is no problem.
    """
    problems = _loose_ends(linkage)
    if problems:
        return None, problems
    names = [one.name for one in linkage.members]
    solved: set[str] = set()
    groups: list[AssurGroup] = []
    bodies = {name: name for name in linkage.base}
    while len(solved) < len(names):
        rest = [name for name in names if name not in solved]
        equations = _Equations(linkage, solved)
        found = _smallest_group(linkage, rest, equations)
        if found is None:
            return None, [Problem("", _too_free(linkage, rest))]
        if equations.excess(found) > 0:
            return None, [_too_stiff(linkage, found, solved)]
        # a link of changing length moves its group, whatever bears it
        bearer = "" if linkage.driver.link in found else _only_bearer(linkage, found, bodies)
        stuck = next((name for name in found if bearer and linkage.member(name).guide), None)
        if stuck is not None:
            return None, [Problem(_key(linkage, stuck), _too_still(stuck, found, bearer))]
        bodies |= {name: bearer or name for name in found}
        groups.append(AssurGroup(found, _class(linkage, found, solved)))
        solved |= set(found)
    links, driver = links_of(linkage), linkage.driver
    drive = links[:2] if isinstance(driver, Cylinder | LinkMotor) else (GROUND, links[0])
    driven = "" if drive[0] == GROUND else driver.link
    return Structure(links, _joints(linkage), tuple(groups), (drive[0], drive[1]), len(linkage.geared), driven), []


def _only_bearer(linkage: Linkage, some: tuple[str, ...], bodies: dict[str, str]) -> str:
    """Return the one body that bears all outer joints of a group, so that it cannot move on it; else nothing."""
    bearers = []
    for name in some:
        member = linkage.member(name)
        owners = ({bodies[one] for one in linkage.owners[point] if one in bodies} for point in member.points)
        bearers += [one for one in owners if one]
        carrier = (linkage.guides[member.guide].link or GROUND) if member.guide else ""
        bearers += [{bodies[carrier]}] if carrier in bodies else []
    return min(set.intersection(*bearers), default="") if bearers else ""


def _smallest_group(linkage: Linkage, rest: list[str], equations: _Equations) -> tuple[str, ...] | None:
    """Return the fewest members that what is solved determines, or overdetermines; those named first go first."""
    order = {name: number for number, name in enumerate(rest)}
    beside = [{order[one] for one in some} for some in _beside(linkage, rest, equations.known).values()]
    # only members that hang together: of two groups that do not, one alone is determined
    candidates: list[tuple[int, ...]] = [(number,) for number in range(len(rest))]
    while candidates and len(candidates) <= _MOST_CANDIDATES:
        for some in candidates:
            names = tuple(rest[one] for one in some)
            if equations.excess(names) >= 0:
                return names
        candidates = sorted({
            tuple(sorted((*some, other)))
            for some in candidates
            for other in set().union(*(beside[one] for one in some)).difference(some)
        })  # fmt: skip
    return None


def known_points(linkage: Linkage, solved: Iterable[str]) -> set[str]:
    """Return the points that are placed once some members are solved."""
    members = {*linkage.base, *solved}
    return {name for name, owners in linkage.owners.items() if not members.isdisjoint(owners)}


class _Equations:
    """Counts what the joints demand of members, while some others are solved."""

    def __init__(self, linkage: Linkage, solved: set[str]) -> None:
        self.members = {one.name: one for one in linkage.members}
        self.guides = linkage.guides
        self.known = known_points(linkage, solved)
        self.carriers = {"", *linkage.base, *solved}

    def excess(self, some: tuple[str, ...]) -> int:
        """Return the equations less the coordinates of members: 0 for a group, more if it is over-constrained."""
        pinned = [point for name in some for point in self.members[name].points]
        free = {point for point in pinned if point not in self.known}
        guides = [self.guides[guide].link for name in some if (guide := self.members[name].guide)]
        guided = sum(1 for link in guides if link in self.carriers or link in some)
        return 2 * (len(pinned) - len(free) + guided) - 3 * len(some)


def _class(linkage: Linkage, some: tuple[str, ...], solved: set[str]) -> int:
    """Return the class of a group: the links of its longest closed loop of inner joints, and at least three."""
    if len(some) == 2:
        return 2
    beside = _beside(linkage, some, known_points(linkage, solved))
    return max([3, *(_longest_loop(beside, name) for name in some)])


def _beside(linkage: Linkage, some: Iterable[str], known: set[str]) -> dict[str, set[str]]:
    """Return for each of some members those that are joined to it at a point not known, or by a guide."""
    beside: dict[str, set[str]] = {name: set() for name in some}
    for point, owners in linkage.owners.items():
        if point not in known:
            for one, other in combinations([name for name in owners if name in beside], 2):
                beside[one].add(other)
                beside[other].add(one)
    for member in linkage.members:
        carrier = linkage.guides[member.guide].link if member.guide else ""
        if member.name in beside and carrier in beside:
            beside[member.name].add(carrier)
            beside[carrier].add(member.name)
    return beside


def _longest_loop(beside: dict[str, set[str]], first: str) -> int:
    def walk(path: list[str]) -> int:
        longest = len(path) if len(path) > 3 and first in beside[path[-1]] else 0
        return max([longest, *(walk([*path, name]) for name in beside[path[-1]] if name not in path)])

    return walk([first])


def _loose_ends(linkage: Linkage) -> list[Problem]:
    """Return what hangs on fewer than two joints, and names that stand for nothing."""
    owners, problems = linkage.owners, []
    carriers = {guide.link for name, guide in linkage.guides.items() if any(m.guide == name for m in linkage.members)}
    for one in linkage.members:
        joints = [name for name in one.points if len(owners[name]) > 1]
        count = len(joints) + bool(one.guide) + (one.name in carriers)
        if count < 2:
            problems.append(Problem(_key(linkage, one.name), _loose(one, joints, owners)))
    return problems


def _loose(one: Member, joints: list[str], owners: Mapping[str, Sequence[str]]) -> Refusal:
    if not joints:
        return Refusal("hangs_on_guide" if one.guide else "hangs_alone", name=one.name)
    alone = tuple(name for name in one.points if len(owners[name]) == 1 and name != one.centre)
    told = "hangs_on_one_also" if alone else "hangs_on_one"
    return Refusal(told, name=one.name, joint=joints[0], alone=alone)


def _too_free(linkage: Linkage, rest: list[str]) -> Refusal:
    freedom, rest = float(mobility(linkage).value), _described(linkage, rest)
    return Refusal("free_some" if len(rest) > 1 else "free_one", mobility=freedom, names=", ".join(rest))


def _too_stiff(linkage: Linkage, some: tuple[str, ...], solved: Iterable[str]) -> Problem:
    freedom, names = float(mobility(linkage).value), _described(linkage, some)
    if not names:
        key = "driver.cylinder" if isinstance(linkage.driver, Cylinder) else "driver.between"
        return Problem(key, Refusal("driver_held", names=_described(linkage, sorted(solved)), mobility=freedom))
    told = Refusal("stiff_some" if len(names) > 1 else "stiff_one", names=names, mobility=freedom)
    return Problem(_key(linkage, names[0]), told)


def _described(linkage: Linkage, some: Iterable[str]) -> list[str]:
    """Return members as far as they are described as such: a length that drives is not."""
    return [name for name in some if name != linkage.driver.link]


def _too_still(slider: str, some: tuple[str, ...], bearer: str) -> Refusal:
    return Refusal("still_slider", slider=slider, names=list(some), bearer=bearer)


def _key(linkage: Linkage, name: str) -> str:
    return f"{'sliders' if linkage.member(name).guide else 'links'}.{name}"


@formula("mobility", "artobolevsky_1988, ch. 2")
def chain_mobility(n_i: Value, p_5: Value, p_4: Value) -> Value:
    """Degrees of freedom of a planar chain whose higher pairs are gears."""
    return 3 * n_i - 2 * p_5 - p_4
