"""Torsional vibration in a note: its system, natural modes, critical speeds, vibration over the speed, dampers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.note.document import Block, Citation
from crankwork.note.material import Material
from crankwork.note.parts import Head, Lines, Section, Shown, Text, When, has, lacks
from crankwork.note.tables import Column, quantity_columns
from crankwork.quantities.key import key_of
from crankwork.report.display import link_label

_HOLZER, _ORDERS = "holzer_1921", "den_hartog_1956, ch. 5"
# rows of critical speeds, and of tables by Holzer
_MOST_CRITICAL, _MOST_ROWS = 12, 40


class _Listing:
    """A listing as a table without a reference, its rows those of the greatest exciting torque if there are many."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        words, listing = material.words, material.results.listings.get(self.name)
        if listing is None:
            return
        rows = np.arange(len(next(iter(listing.columns.values()))))
        if "excitation_torque" in listing.columns:
            rows = np.sort(np.argsort(-listing.columns["excitation_torque"])[:_MOST_CRITICAL])
        rows = rows[:_MOST_ROWS]
        columns = {key: values[rows] for key, values in listing.columns.items()}
        made = [
            column._replace(heading=(link_label(key_of(key).owner, words.language),))
            if key.startswith("relative_amplitude.") else column
            for key, column in zip(columns, quantity_columns(material, columns, columns), strict=True)
        ]  # fmt: skip
        if listing.names:
            made.insert(
                0, Column((words.column("row"),), [link_label(listing.names[row], words.language) for row in rows])
            )
        cells = list(zip(*(column.entries for column in made), strict=True))
        align = "l" * bool(listing.names) + "r" * len(columns)
        yield words.table(self.name, [column.heading for column in made], cells, align, self.name)


def _alone(material: Material) -> bool:
    """Return whether discs and shafts are all that a file states."""
    turning = material.machine.turning
    return turning is not None and not turning.diagrams


SECTIONS = (
    Section("task", (
        Head("task"), Text("task_torsion", {
            "discs": lambda material: str(len(material.results.listings["torsional_discs"].names)),
            "shafts": lambda material: str(len(material.results.listings["torsional_shafts"].names)),
        }),
    ), _alone),
    Section("torsion", (
        Head("torsion"), When(lacks(_alone), (Text("torsion_of_engine"),)), _Listing("torsional_discs"),
        Lines("torsion", intro="torsion_lengths"),
        _Listing("torsional_shafts"),
        When(has("natural_modes"), (
            Text("torsion_modes", {"source": Citation("thomson_1988, ch. 6")}), _Listing("natural_modes"),
            Shown(("torsional_modes",)), _Listing("torsional_nodes"),
        )),
        When(has("holzer"), (Text("torsion_holzer", {"source": Citation(_HOLZER)}), _Listing("holzer"))),
        _Listing("holzer_trials"), _Listing("damped_modes"),
        When(has("critical_speeds"), (
            Text("torsion_critical", {"source": Citation(_ORDERS)}), _Listing("critical_speeds"), Shown(("campbell",)),
        )),
        When(has("torsional_response"), (Text("torsion_response"), Shown(("torsional_response",)))),
        Lines("torsional_dampers", intro="torsion_dampers"),
    ), has("torsional_discs")),
)  # fmt: skip
