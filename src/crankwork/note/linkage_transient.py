"""A machine let go: what drives it, how it moves in time, what happens on the way."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.note.document import Block, Citation, Runs, Table
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import quantity_columns
from crankwork.note.linkage_words import Words, named
from crankwork.report.language import row_name

_SOURCE = "artobolevsky_1988, ch. 15"
_ROWS = 21
_MOST_EVENTS = 24
_SHOWN = ("time", "crank_angle", "crank_speed", "angular_acceleration", "kinetic_energy", "potential_energy")


def transient(material: Material) -> Iterator[Block]:
    """Yield the section about the motion in time, where a machine is let go."""
    words, results, wanted = material.words, material.results, material.machine.transient
    if wanted is None or "transient" not in results.listings:
        return
    yield words.heading("transient")
    yield words.paragraph("transient_equation", source=Citation(_SOURCE))
    driven = "transient_motor" if wanted.motor else "transient_torque" if wanted.torque else "transient_free"
    yield words.paragraph(
        driven,
        angle=words.amount(wanted.start, "deg"),
        speed=words.amount(wanted.speed, "rad/s"),
        torque=words.amount(wanted.torque, "N*m"),
    )
    yield words.paragraph(
        "transient_end",
        time=words.amount(results.summary["transient_time"], "s"),
        turn=words.amount(results.summary["final_turn"], "deg"),
        speed=words.amount(results.summary["final_speed"], "rad/s"),
    )
    columns = results.listings["transient"].columns
    count = len(columns["time"])
    rows = np.unique(np.round(np.linspace(0, count - 1, min(_ROWS, count))).astype(int))
    keys = [*(key for key in _SHOWN if np.any(columns[key])), *named(columns, "slider_displacement")]
    yield _table("transient", {key: columns[key][rows] for key in keys}, words)
    yield from material.figures("transient")
    happened = results.listings.get("transient_events")
    if happened is not None:
        names = [row_name(one, words.language) for one in happened.names[:_MOST_EVENTS]]
        shown = {key: one[:_MOST_EVENTS] for key, one in happened.columns.items()}
        yield _table("transient_events", shown, words, names)


def _table(caption: str, columns: dict[str, np.ndarray], words: Words, names: list[str] | None = None) -> Table:
    """Return columns as a table, rows called by names where they have some."""
    made = quantity_columns(columns, columns, words)
    titles: list[Runs] = [one.heading for one in made]
    entries = [one.entries for one in made]
    if names is not None:
        titles.insert(0, (words.column("event"),))
        entries.insert(0, names)
    align = "l" * (names is not None) + "r" * len(made)
    return Table(words.caption(caption), tuple(titles), list(zip(*entries, strict=True)), align=align, label=caption)
