"""Links, joints, mobility, groups and class of a linkage in its note."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.mechanism import four_bar_type
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.joints import Pin, group_links, joints, pivots_of
from crankwork.mechanism.linkage import GROUND
from crankwork.note.document import Block, Table
from crankwork.note.material import Material
from crankwork.note.parts import Section, drawn
from crankwork.note.tables import folded
from crankwork.report.display import link_label

_ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII")


def _structure(material: Material) -> Iterator[Block]:
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
    kinds = {frozenset(group_links(dyad)): type(dyad).__name__ for dyad in material.machine.mechanism.dyads}
    rows = [
        (
            str(number),
            ", ".join(
                f"{numbers[name]} ({link_label(name, words.language)})" for name in group.members if name in numbers
            ),
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
        name = (
            (joint.point or pivots.get(joint.link, ""))
            if isinstance(joint, Pin)
            else link_label(joint.link, words.language)
        )
        kind = words.term("turning" if isinstance(joint, Pin) else "sliding")
        rows.append((str(number), name, f"{ends[0]}–{ends[1]}", kind))
    if isinstance(driver, Cylinder):
        inside = "–".join(str(links.index(name)) for name in (driver.link, rod_name(driver.link)))
        rows.append((str(len(rows) + 1), link_label(driver.link, words.language), inside, words.term("sliding")))
    return folded(words.table("pairs", ("number", "pair", "between", "kind"), rows, "cccc"), most=2, long=6)


SECTIONS = (Section("structure", (_structure,), drawn),)
