"""The task of a linkage and its structure: links, fixed points, guides, loads, joints, groups; its chambers."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.analysis.linkage import four_bar_type
from crankwork.analysis.stated import StatedChamber, StatedLoad, stated_chambers, stated_charges, stated_loads
from crankwork.locale import say
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.dyads import PRP, RRP, RRR, Dyad
from crankwork.mechanism.joints import Pin, joints, pivots_of
from crankwork.mechanism.linkage import GROUND, Member
from crankwork.mechanism.structure import links_of
from crankwork.note.document import Block, Citation, ItemList, Runs, Table
from crankwork.note.linkage_material import Material
from crankwork.note.words import Words, in_display_unit, named
from crankwork.quantities import QUANTITIES, base_key
from crankwork.report.language import called
from crankwork.report.summary import results_method

_ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")
_MOST_JOINTS = 3
_VOLUME, _CHARGE = "kolchin_demidov_2008, ch. 5", "urieli_berchowitz_1984"
_DELIVERED = "eastop_mcconkey_1993, ch. 12"
_MINUS = "\N{MINUS SIGN}"
_SINGLE = (
    "swept_volume", "clearance_volume", "compression_ratio", "gas_pressure_max", "indicated_work",
    "indicated_mean_pressure", "indicated_power",
)  # fmt: skip


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


def given_chambers(material: Material) -> Iterator[Block]:
    """Yield the chambers as they are given, and the gas sealed in them."""
    words = material.words
    given = stated_chambers(material.machine)
    if not given:
        return
    rows = [tuple(_given(chamber, material)) for chamber in given]
    sizes = (words.titled(key) for key in ("piston_area", "clearance_volume", "ambient_pressure"))
    yield words.table("chambers", ("chamber", "faces", *sizes, "gas"), rows, "llrrrl")
    for charge in stated_charges(material.machine):
        dead = "; ".join(_amount(volume, temperature, words) for volume, temperature in charge.dead_volumes) or "–"
        parts = {"name": charge.name, "chambers": ", ".join(charge.chambers), "dead": dead}
        if charge.exponent is None:
            yield words.paragraph("charge_given", **parts)
        else:
            yield words.paragraph("charge_polytrope", exponent=words.number(charge.exponent), **parts)


def _given(chamber: StatedChamber, material: Material) -> Iterator[str]:
    """Yield name, faces, areas, clearance, pressure around, and what gives the pressure of a chamber."""
    words, results = material.words, material.results
    yield chamber.name
    yield ", ".join(f"{slider} ({'+' if sense > 0 else _MINUS})" for slider, sense in chamber.faces)
    keys = [f"piston_area.{owner}" for owner in chamber.owners]
    yield "; ".join(words.number(in_display_unit(key, [results.value(key)])[0]) for key in keys)
    yield words.number(
        in_display_unit("clearance_volume", [results.summary.get(f"clearance_volume.{chamber.name}", 0.0)])[0]
    )
    # of gauge pressures the ambient pressure is not known
    yield words.number(in_display_unit("ambient_pressure", [chamber.ambient])[0]) if chamber.ambient else "–"
    amounts = {name: words.amount(value, unit) for name, (value, unit) in chamber.amounts.items()}
    pressure = say(f"sentences.of_{chamber.kind}", words.language, **chamber.names, **amounts)
    if chamber.delay:
        pressure = say("sentences.of_later", words.language, text=pressure, delay=words.amount(chamber.delay, "deg"))
    if chamber.factor != 1:
        pressure = say("sentences.of_factor", words.language, text=pressure, factor=words.number(chamber.factor))
    yield pressure


def _amount(volume: float, temperature: float | None, words: Words) -> str:
    shown = words.amount(volume, "cm3")
    return shown if temperature is None else f"{shown} ({words.amount(temperature, 'K')})"


def chambers(material: Material) -> Iterator[Block]:
    """Yield the section about the gas: volumes, pressures and forces, then work and power."""
    words, columns, machine = material.words, material.columns, material.machine
    if not machine.chambers:
        return
    yield words.heading("chambers")
    yield words.paragraph("chambers", source=Citation(_VOLUME))
    if any(charge.exponent is None for charge in machine.charges.values()):
        yield words.paragraph("isothermal", source=Citation(_CHARGE))
    yield from material.equations("charges")
    yield from material.worked("chambers")
    keys = named(columns, "cylinder_volume", "gas_pressure", "gas_force", "rod_load")
    yield from material.table("gas", keys, label="gas")
    yield from material.figures("chambers", "indicator")
    yield words.paragraph("gas_work")
    yield from material.equations("gas_work")
    rows = [(chamber.name, *_values(chamber.name, material)) for chamber in stated_chambers(machine)]
    titles = [words.titled(key, QUANTITIES[base_key(key)].unit) for key in _SINGLE]
    yield words.table("gas_work", ("chamber", *titles), rows, "l" + "r" * len(_SINGLE))
    if material.lines("delivery"):
        yield words.paragraph("delivery", source=Citation(_DELIVERED))
        yield from material.equations("delivery")


def _values(name: str, material: Material) -> Iterator[str]:
    """Yield the single values of a chamber; a dash for what it has not."""
    words, summary = material.words, material.results.summary
    for key in _SINGLE:
        value = summary.get(f"{key}.{name}", math.nan)
        yield words.number(in_display_unit(key.removesuffix("_max"), [value])[0])
