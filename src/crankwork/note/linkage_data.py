"""The task of a linkage and its structure: links, fixed points, guides, loads, joints and groups."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.analysis.linkage import four_bar_type
from crankwork.analysis.stated import StatedLoad, stated_loads
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.dyads import PRP, RRP, RRR, Dyad
from crankwork.mechanism.joints import Pin, joints, pivots_of
from crankwork.mechanism.linkage import GROUND, Member
from crankwork.mechanism.structure import links_of
from crankwork.note.chambers import given_chambers
from crankwork.note.document import Block, ItemList, Runs, Table
from crankwork.note.linkage_material import Material
from crankwork.note.words import Words
from crankwork.report.language import called
from crankwork.report.summary import results_method

_ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")
_MOST_JOINTS = 3


def task(material: Material) -> Iterator[Block]:
    """Yield the task and the given data."""
    words, machine = material.words, material.machine
    crank = machine.mechanism.crank
    yield words.heading("task")
    yield words.paragraph("task_partial" if words.is_partial else "task")
    (turning,) = words.sentence("clockwise" if crank.direction < 0 else "anticlockwise")
    yield words.paragraph(
        "crank",
        radius=words.amount(crank.radius, "mm"),
        direction=turning,
        start=words.amount(crank.start, "deg"),
        value=words.amount(material.results.solved.speed, "rad/s"),
    )
    for geared in crank.geared:
        yield words.paragraph("geared_crank", name=geared.link, ratio=words.number(geared.ratio))
    if machine.angular_acceleration:
        yield words.paragraph("acceleration", value=words.amount(machine.angular_acceleration, "rad/s2"))
    yield from given_parts(material)
    if machine.drive.inertia:
        yield words.paragraph("drive_inertia", value=words.amount(machine.drive.inertia, "kg*m2"))
    if machine.drive.fluctuation is not None:
        yield words.paragraph("fluctuation", value=words.number(machine.drive.fluctuation))
    yield words.paragraph("linkage_computed")
    yield method(material)
    if material.options.sheets:
        yield words.paragraph("sheets")


def method(material: Material) -> Block:
    """Return the paragraph that says how everything is computed."""
    results, words = material.results, material.words
    return words.paragraph(
        "linkage_method",
        method=results_method(results, words.language),
        pi=words.number(results.method.pi, digits=9 if results.method.pi == math.pi else 6),
    )


def given_parts(material: Material) -> Iterator[Block]:
    """Yield tables of the links, the fixed points and the guides, then loads and chambers."""
    words, machine = material.words, material.machine
    yield _links(material)
    yield from _places(material)
    if machine.loads:
        yield words.paragraph("outer_loads")
        yield ItemList(tuple(_outer_load(load, words) for load in stated_loads(machine)))
    elif machine.mechanism.bodies and not machine.chambers:
        yield words.paragraph("no_loads")
    yield from given_chambers(material)


def _links(material: Material) -> Table:
    """Return links and sliding pieces with their masses."""
    words, linkage = material.words, material.machine.drawn
    owners = linkage.owners
    rows = []
    numbers = {name: number for number, name in enumerate(links_of(linkage), start=1)}
    is_listed = linkage.driving.centre or linkage.driving.guide
    driving = (*([linkage.driving] if is_listed else []), *linkage.geared)
    for member in (*driving, *linkage.members):
        if member.name == linkage.driver.link and member not in driving:
            continue
        number = numbers[member.name]
        shared = [name for name in member.points if len(owners[name]) > 1]
        rows.append((
            str(number), called(member.name, words.language), ", ".join(shared), _length(member, shared, words),
            words.shown("body_mass", member.mass) if member.mass else "–",
            words.shown("body_inertia", member.inertia) if member.inertia else "–", _centre(member, words),
        ))  # fmt: skip
    masses = (words.titled(key) for key in ("body_mass", "body_inertia"))
    length, centre = ((words.column(name, "mm"),) for name in ("length", "centre"))
    return words.table("links", ("number", "link", "joints", length, *masses, centre), rows, "clcrrrc", "links")


def _length(member: Member, shared: list[str], words: Words) -> str:
    """Return the distances of the joints of a link: `600`, or `AB 100; BC 200` where there are more than two."""
    pairs = [(a, b) for i, a in enumerate(shared) for b in shared[i + 1 :]] if len(shared) <= _MOST_JOINTS else []
    spans = [(a, b, math.dist(member.points[a], member.points[b])) for a, b in pairs]
    if member.guide or not spans:
        return "–"
    if len(spans) == 1:
        return words.shown("point_x", spans[0][2])
    return "; ".join(f"{a}{b} {words.shown('point_x', span)}" for a, b, span in spans)


def _centre(member: Member, words: Words) -> str:
    if not member.centre:
        return "–"
    # the centre of a crank may be its pivot
    x, y = (words.shown("point_x", coordinate) for coordinate in member.points.get(member.centre, (0.0, 0.0)))
    named = "" if "." in member.centre or "_" in member.centre else f"{member.centre} "
    return f"{named}({x}; {y})"


def _places(material: Material) -> Iterator[Table]:
    """Yield fixed points and guides."""
    words, linkage = material.words, material.machine.drawn
    rows = [(name, words.shown("point_x", x), words.shown("point_y", y)) for name, (x, y) in linkage.ground.items()]
    axes = (words.titled("point_x"), words.titled("point_y"))
    if rows:
        yield words.table("pivots", ("point", *axes), rows, "crr")
    lines = [
        (
            name, guide.link or words.term("ground"), *(words.shown("point_x", value) for value in guide.point),
            words.number(math.degrees(guide.angle)),
        )
        for name, guide in linkage.guides.items()
    ]  # fmt: skip
    if lines:
        yield words.table("guides", ("guide", "carrier", *axes, "angle"), lines, "ccrrr")


def _outer_load(load: StatedLoad, words: Words) -> Runs:
    """Return a load in words."""
    amounts = {
        name: "…" if value is None else words.amount(value, unit) for name, (value, unit) in load.amounts.items()
    }
    return words.sentence(f"load_{load.kind}", **load.names, **amounts)


def structural_analysis(material: Material) -> Iterator[Block]:
    """Yield links, joints, mobility, groups and class."""
    words, analysed = material.words, material.structure
    if analysed is None:
        return
    yield words.heading("structure")
    yield words.paragraph("structure", n=str(len(analysed.links)), p=str(analysed.joints))
    yield _pairs(material, ("", *analysed.links))
    yield words.paragraph("chebyshev")
    yield from material.equations("structure")
    yield words.paragraph("one_driver" if material.words.period else "one_drive")
    numbers = {name: str(number) for number, name in enumerate(analysed.links, start=1)}
    driver = material.machine.mechanism.driver
    if isinstance(driver, Cylinder):
        # barrel and rod stand for one link of changing length
        numbers[driver.link] += f"+{numbers[rod_name(driver.link)]}"
    kinds = {_members(dyad): type(dyad).__name__ for dyad in material.machine.mechanism.dyads}
    rows = [
        (
            str(number),
            ", ".join(f"{numbers[name]} ({name})" for name in group.members if name in numbers),
            _ROMAN[group.number],
            words.kind(kinds.get(frozenset(group.members), "")),
        )
        for number, group in enumerate(analysed.groups, start=1)
    ]
    yield words.table("groups", ("group", "members", "class", "species"), rows, "clcc")
    yield words.paragraph("formula", formula=analysed.formula.replace("->", "→"), number=_ROMAN[analysed.number])
    kind = four_bar_type(material.machine)
    if kind:
        yield words.paragraph("grashof", type=words.kind(kind))


def _members(dyad: Dyad | Chain) -> frozenset[str]:
    match dyad:
        case RRR():
            return frozenset((dyad.link_a, dyad.link_b))
        case RRP():
            return frozenset((dyad.link, dyad.piece))
        case PRP():
            return frozenset((dyad.block_a, dyad.block_b))
        case Chain():
            return frozenset(link.name for link in dyad.links)
    return frozenset((dyad.link, dyad.block))


def _pairs(material: Material, links: tuple[str, ...]) -> Table:
    """Return the joints with the numbers of the links that they join."""
    words, driver = material.words, material.machine.mechanism.driver
    pivots = pivots_of(material.machine.mechanism)
    rows = []
    for number, joint in enumerate(joints(material.machine.mechanism), start=1):
        both = [joint.link, joint.other]
        if isinstance(driver, Cylinder) and isinstance(joint, Pin) and joint.point == driver.rod:
            # there the rod of the cylinder ends, not its barrel
            both = [rod_name(name) if name == driver.link else name for name in both]
        ends = sorted(0 if name == GROUND else links.index(name) for name in both)
        name = (joint.point or pivots.get(joint.link, "")) if isinstance(joint, Pin) else joint.link
        kind = words.term("turning" if isinstance(joint, Pin) else "sliding")
        rows.append((str(number), name, f"{ends[0]}–{ends[1]}", kind))
    if isinstance(driver, Cylinder):
        inside = "–".join(str(links.index(name)) for name in (driver.link, rod_name(driver.link)))
        rows.append((str(len(rows) + 1), driver.link, inside, words.term("sliding")))
    return words.table("pairs", ("number", "pair", "between", "kind"), rows, "cccc")
