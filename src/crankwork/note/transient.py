"""The motion in time of a machine that is let go, in its note."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.note.document import Block, Citation, Table
from crankwork.note.material import Material
from crankwork.note.parts import Head, Section, Shown, Text, amount, turning
from crankwork.note.tables import Column, quantity_columns
from crankwork.note.wording import named
from crankwork.report.display import row_name

_DYNAMICS = "artobolevsky_1988, ch. 15"
_ROWS = 21
_MOST_EVENTS = 24
_SHOWN = ("time", "crank_angle", "crank_speed", "angular_acceleration", "kinetic_energy", "potential_energy")


def _driven(material: Material) -> Iterator[Block]:
    """Yield how the machine is let go, and what drives it."""
    words, wanted = material.words, material.machine.transient
    if wanted is None:
        return
    driven = "transient_motor" if wanted.motor else "transient_torque" if wanted.torque else "transient_free"
    yield words.paragraph(
        driven,
        angle=words.amount(wanted.start, "deg"),
        speed=words.amount(wanted.speed, "rad/s"),
        torque=words.amount(wanted.torque, "N*m"),
    )


def _motion(material: Material) -> Iterator[Block]:
    """Yield a table of some rows of the motion."""
    columns = material.results.listings["transient"].columns
    count = len(columns["time"])
    rows = np.unique(np.round(np.linspace(0, count - 1, min(_ROWS, count))).astype(int))
    keys = [*(key for key in _SHOWN if np.any(columns[key])), *named(columns, "slider_displacement")]
    yield _table("transient", {key: columns[key][rows] for key in keys}, material)


def _events(material: Material) -> Iterator[Block]:
    """Yield a table of what happened."""
    happened = material.results.listings.get("transient_events")
    if happened is not None:
        names = [row_name(name, material.words.language) for name in happened.names[:_MOST_EVENTS]]
        shown = {key: column[:_MOST_EVENTS] for key, column in happened.columns.items()}
        yield _table("transient_events", shown, material, names)


def _table(caption: str, columns: Mapping[str, Array], material: Material, names: Sequence[str] = ()) -> Table:
    """Return columns as a table, rows called by names where they have some."""
    made = quantity_columns(material, columns, columns)
    if names:
        made.insert(0, Column((material.words.column("event"),), names))
    rows = list(zip(*(column.entries for column in made), strict=True))
    align = "l" * bool(names) + "r" * len(columns)
    return material.words.table(caption, [column.heading for column in made], rows, align, caption)


SECTIONS = (
    Section("transient", (
        Head("transient"), Text("transient_equation", {"source": Citation(_DYNAMICS)}), _driven,
        Text("transient_end", {
            "time": amount("transient_time", "s"), "turn": amount("final_turn", "deg"),
            "speed": amount("final_speed", "rad/s"),
        }),
        _motion, Shown(("transient",)), _events,
    ), lambda material: turning(material) and material.has("transient")),
)  # fmt: skip
