"""How well a linkage moves and passes on forces: range, ends, time ratio, transmission and pressure angles."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.transmission_quality import USUAL, USUAL_PRESSURE
from crankwork.note.document import Block, Citation, Reference, Runs, Table
from crankwork.note.lines import WORST_ANGLES, extreme_of, worst_angles
from crankwork.note.material import Material
from crankwork.note.parts import Section, drawn
from crankwork.note.printed_units import printed_unit
from crankwork.note.tables import tabulated
from crankwork.note.wording import named
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit

_SOURCE = "norton_2012, ch. 4"
_TRAVEL = {"slider_displacement": "slider_stroke", "link_angle": "link_swing"}
_ANGLES = ("transmission_angle", "pressure_angle")
_NONE = "–"


def _quality(material: Material) -> Iterator[Block]:
    """Yield the section about range, ends, time ratio, transmission and pressure angles."""
    blocks = [*_range(material), *_ends(material), *_transmission(material)]
    if blocks:
        yield material.words.heading("quality")
        yield from blocks


def _range(material: Material) -> Iterator[Block]:
    """Yield the range of a crank that does not turn fully, and the travel of its links, on branch and circuit."""
    words, summary = material.words, material.summary
    if "crank_range" not in summary:
        return
    ends = {name: words.amount(summary[f"crank_range_{name}"], "deg") for name in ("start", "end")}
    yield words.paragraph("crank_range", value=words.amount(summary["crank_range"], "deg"), **ends)
    rows = []
    for kind in _TRAVEL.values():
        for key in named(summary, kind, f"{kind}_circuit"):
            name = key_of(key).owner
            reached = (_value(material, f"{reach}.{name}") for reach in (kind, f"{kind}_circuit"))
            row = (words.part(name), _unit(material, key), *reached)
            if row not in rows:
                rows.append(row)
    if rows:
        yield words.paragraph("reach", table=Reference("t:reach"))
        yield words.table("reach", ("link", "unit", "on_branch", "on_circuit"), rows, "lcrr", "t:reach")


def _ends(material: Material) -> Iterator[Block]:
    """Yield both ends of what slides or rocks, the way between them, and the ratio of the times of both strokes."""
    words, summary = material.words, material.summary
    rows = []
    for kind, travel in _TRAVEL.items():
        for key in named(summary, f"{kind}_min"):
            name = key_of(key).owner
            ends = [f"{kind}_{word}.{name}" for word in ("min", "max")]
            shown = [text for end in ends for text in (_value(material, end), _place(material, end))]
            ways = [_value(material, f"{quantity}.{name}") for quantity in (travel, "time_ratio")]
            rows.append((words.part(name), _unit(material, key), *shown, *ways))
    if not rows:
        return
    has_ratio = any(key.startswith("time_ratio.") for key in summary)
    yield words.paragraph("ends", table=Reference("t:ends"))
    if has_ratio:
        yield words.paragraph("time_ratio")
    angle_title = words.reached_at()
    titles: list[str | Runs] = ["link", "unit", "least", angle_title, "largest", angle_title, "travel"]
    if has_ratio:
        titles.append(words.titled("time_ratio"))
    else:
        rows = [row[:-1] for row in rows]
    yield words.table("ends", titles, rows, "lc" + "r" * (len(titles) - 2), "t:ends")


def _transmission(material: Material) -> Iterator[Block]:
    """Yield the extreme transmission and pressure angles, worked where they are reached, and all over the positions."""
    words, columns = material.words, material.columns
    keys = named(columns, *_ANGLES)
    if not keys:
        return
    yield words.heading("transmission", 2)
    if named(columns, "transmission_angle"):
        low, high = (words.number(angle) + "°" for angle in USUAL)
        yield words.paragraph("transmission", source=Citation(_SOURCE), low=low, high=high)
    if named(columns, "pressure_angle"):
        yield words.paragraph("pressure", source=Citation(_SOURCE), limit=words.number(USUAL_PRESSURE) + "°")
    yield from _worst(material)
    if material.full:
        yield from tabulated(material, "transmission_angles", keys)


def _worst(material: Material) -> Iterator[Block]:
    """Yield the extreme angles, each worked where it is reached, and all of them in a table."""
    words = material.words
    extremes = [(key, extreme_of(material.results, key)) for key in worst_angles(material.results)]
    if not extremes:
        return
    yield words.paragraph("worst_angles")
    for key, extreme in extremes if material.full else ():
        if extreme is not None:
            name, symbol, value = (
                words.part(key_of(key).owner),
                words.place(extreme.at)[0],
                words.place_text(extreme.at),
            )
            yield words.paragraph("worst_angle", name=name, place=symbol, value=value)
            lines = [line for line in material.lines("transmission") if line.key in (extreme.key, key)]
            yield from material.worked(lines)
    yield _limits(material)


def _limits(material: Material) -> Table:
    """Return the extreme angles of every pin and slider, each with where it is reached."""
    words, summary = material.words, material.summary
    kinds = [angle_kind for angle_kind in WORST_ANGLES if named(summary, angle_kind)]
    names = dict.fromkeys(key_of(key).owner for key in named(summary, *kinds))
    rows = [
        (
            words.part(name),
            *(text for end in kinds for text in (_value(material, f"{end}.{name}"), _place(material, f"{end}.{name}"))),
        )
        for name in names
    ]
    angles = [title for kind in kinds for title in (words.titled(kind, "deg"), words.reached_at())]
    return words.table("limits", ("transmitting", *angles), rows, "l" + "r" * len(angles), "limits")


def _value(material: Material, key: str) -> str:
    summary = material.summary
    return material.words.number(displayed(key, summary[key]), digits=material.digits) if key in summary else _NONE


def _unit(material: Material, key: str) -> str:
    return printed_unit(key_unit(key), material.words.language)


def _place(material: Material, key: str) -> str:
    """Return the crank angle or time at which an extreme is reached."""
    extreme = extreme_of(material.results, key)
    return _NONE if extreme is None else material.words.number(material.words.place(extreme.at)[1], digits=4)


SECTIONS = (Section("quality", (_quality,), drawn),)
