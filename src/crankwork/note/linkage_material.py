"""Data of the sections of the note of a linkage."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.plans import POSITION_STEP, positions, worked_position
from crankwork.analysis.rounding import summary_without_rounding, without_rounding
from crankwork.formula.lines import Line
from crankwork.machine import Machine, TransferTable
from crankwork.mechanism.structure import Structure, structure
from crankwork.note.document import Block, Table, listed
from crankwork.note.groups import Group
from crankwork.note.linkage_lines import linkage_lines
from crankwork.note.linkage_tables import Column, equations, position_tables, quantity_columns
from crankwork.note.options import NoteOptions
from crankwork.note.words import Words, named
from crankwork.report.figure_data import kind_of
from crankwork.report.figures import drawings
from crankwork.report.tables import any_nonzero
from crankwork.show.scene import Drawing

# figures that are no curves
_CONSTRUCTED = (
    "position_plans", "velocity_plan", "acceleration_plan", "force_plans", "zhukovsky_lever", "centrodes",
    "wittenbauer",
)  # fmt: skip


@dataclass(frozen=True)
class Material:
    """Results and what is chosen, and what follows from both, computed when a section asks for it."""

    results: Results  # Of a linkage, or of a table of transfer functions
    options: NoteOptions  # Language and what else is chosen

    @cached_property
    def words(self) -> Words:
        """The words of the language."""
        return Words(self.options.language, self.results.period, is_partial="crank_range" in self.results.summary)

    @property
    def machine(self) -> Machine:
        """The machine."""
        return self.results.machine

    @property
    def transfer(self) -> TransferTable:
        """Its transfer functions, where they are given."""
        if self.machine.transfer is None:
            raise TypeError("this machine has a mechanism instead of transfer functions")
        return self.machine.transfer

    @cached_property
    def structure(self) -> Structure | None:
        """Mobility and groups."""
        return structure(self.machine.drawn)[0]

    @cached_property
    def positions(self) -> Array:
        """The positions of the plans, as far as the linkage reaches them. [deg]"""
        return positions(self.machine)

    @property
    def first(self) -> int | None:
        """Number of the first position, counted from a crank angle of zero; none where they have no numbers."""
        numbers = self.positions / POSITION_STEP
        return round(float(numbers[0])) if np.allclose(numbers, np.round(numbers)) else None

    @cached_property
    def columns(self) -> Mapping[str, Array]:
        """All columns at the positions, as tables print them. [SI]"""
        return without_rounding(self.results.columns_at(self.positions), self.machine.speed)

    @cached_property
    def summary(self) -> Mapping[str, float]:
        """The single values, as tables print them. [SI]"""
        return summary_without_rounding(self.results)

    @cached_property
    def groups(self) -> dict[str, Group]:
        """Lines of the memory by the name of their group, worked where the plans are drawn."""
        position = worked_position(self.results) if self.machine.linkage is not None else None
        return {group.name: group for group in linkage_lines(self.results, position)}

    def lines(self, group: str, *kinds: str) -> tuple[Line, ...]:
        """Return the lines of a group, or those of it that give some quantities; none if there is no such group."""
        lines = self.groups[group].lines if group in self.groups else ()
        return tuple(line for line in lines if not kinds or line.key.partition(".")[0] in kinds)

    def equations(self, group: str, *kinds: str) -> Iterator[Block]:
        """Yield the equations of a group, or those of it that give some quantities."""
        return equations(self.lines(group, *kinds), self.words)

    def worked_at(self, group: str) -> Iterator[Block]:
        """Yield the sentence that says at which crank angle, or when, a group is worked."""
        shown_group = self.groups.get(group)
        if shown_group is not None and shown_group.degrees is not None:
            key = "worked_time" if self.words.period else "worked_position"
            yield self.words.paragraph(key, value=self.words.place_text(shown_group.degrees))

    def worked(self, group: str, *kinds: str) -> Iterator[Block]:
        """Yield the equations of a group after the sentence that says where it is worked."""
        yield from self.worked_at(group)
        yield from self.equations(group, *kinds)

    def nonzero(self, *kinds: str) -> list[str]:
        """Return the columns of some kinds that are not zero throughout."""
        return any_nonzero(named(self.columns, *kinds), self.results.columns)

    def of_axes(self, kind: str) -> list[str]:
        """Return the columns of a place, x and y of one point after the other."""
        names = (key.partition(".")[2] for key in named(self.columns, f"{kind}_x"))
        return [f"{kind}_{axis}.{name}" for name in names for axis in "xy"]

    def table(self, caption: str, keys: Iterable[str], label: str = "") -> Iterator[Table]:
        """Yield columns at the positions as a table."""
        return self.tabulated(caption, quantity_columns(keys, self.columns, self.words), label)

    def tabulated(self, caption: str, columns: Sequence[Column], label: str = "") -> Iterator[Table]:
        """Yield finished columns at the positions as a table."""
        return position_tables(caption, self.positions, columns, self.words, first=self.first, label=label)

    @cached_property
    def drawn(self) -> Mapping[str, Drawing]:
        """Figures by name; none if they are left out."""
        return drawings(self.results, language=self.options.language) if self.options.figures else {}

    def figures(self, *names: str) -> Iterator[Block]:
        """Yield figures, those that there are, after sentences that refer to them by number."""
        drawn = [figure_name for name in names for figure_name in self.drawn if kind_of(figure_name) == name]
        built = [name for name in drawn if name in _CONSTRUCTED]
        plain = [name for name in drawn if name not in built]
        sentences = [(("see_construction", "see_constructions"), built), (("see_figure", "see_figures"), plain)]
        # by their numbers
        for keys, shown in sorted((item for item in sentences if item[1]), key=lambda item: drawn.index(item[1][0])):
            references = listed([f"figure:{name}" for name in shown])
            yield self.words.paragraph(keys[len(shown) > 1], figures=references)
        for name in drawn:
            yield self.words.figure(name, self.drawn[name])
