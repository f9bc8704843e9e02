"""Bearings, their wear and the harmonics of the torque in the note of a linkage."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.note.document import Block, Citation, Runs
from crankwork.note.linkage_material import Material
from crankwork.note.words import in_display_unit, named

_SOURCE, _HARMONICS = "kolchin_demidov_2008, ch. 9", "den_hartog_1956, ch. 5"
_ON_PINS = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "main_journal_load")


def bearings(material: Material) -> Iterator[Block]:
    """Yield the section about the loads of the bearings, and the wear of crankpins and main journals."""
    words, results = material.words, material.results
    if "bearing_loads" not in results.listings:
        return
    yield words.heading("bearings")
    yield words.paragraph("joint_bearings", source=Citation(_SOURCE))
    yield from material.worked("joint_bearings", *_ON_PINS)
    yield from material.table("bearings", material.nonzero(*_ON_PINS), label="bearings")
    yield words.paragraph("joint_loads")
    yield from material.equations("bearing_sizes")
    yield _listing(material, "bearing_loads", "loads")
    yield from material.figures("crankpin_polar", "crankpin_load", "main_journal_polar")
    for key in named(material.summary, "oil_hole_angle"):
        angle = words.amount(material.summary[key], "deg", digits=4)
        yield words.paragraph("joint_wear", name=key.partition(".")[2], value=angle)
    for listing in ("crankpin_wear", "main_wear"):
        if listing in results.listings:
            yield _listing(material, listing, listing)
    yield from material.figures("crankpin_wear", "main_wear")


def harmonics(material: Material) -> Iterator[Block]:
    """Yield the section about the harmonics of the torque on the crank."""
    words = material.words
    if "torque_harmonics" not in material.results.listings:
        return
    yield words.heading("torque_harmonics")
    yield words.paragraph("crank_harmonics", source=Citation(_HARMONICS))
    yield from material.equations("crank_harmonics")
    yield _listing(material, "torque_harmonics", "harmonics")
    yield from material.figures("torque_harmonics")


def _listing(material: Material, name: str, caption: str) -> Block:
    """Return a listing as a table: a row for each bearing, ray or order."""
    words, listing = material.words, material.results.listings[name]
    headings: list[str | Runs] = []
    columns: list[list[str]] = []
    if listing.names:
        headings.append("row")
        columns.append([name.replace("_", " ") for name in listing.names])
    for number, (key, values) in enumerate(listing.columns.items()):
        shown = in_display_unit(key, values.tolist())
        is_first = number == 0 and not listing.names
        headings.append(words.titled(key))
        columns.append([words.number(value) for value in shown] if is_first else words.column_texts(shown))
    rows = list(zip(*columns, strict=True))
    align = ("l" if listing.names else "c") + "r" * (len(columns) - 1)
    return words.table(caption, headings, rows, align, name)
