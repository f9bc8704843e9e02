"""What the sections of the note of a linkage are made of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.moving import reached_angles
from crankwork.analysis.rounding import summary_without_rounding, without_rounding
from crankwork.formula.lines import Line
from crankwork.machine import Machine, TransferTable
from crankwork.mechanism.structure import Structure, structure
from crankwork.note.document import Block
from crankwork.note.groups import Group
from crankwork.note.linkage_lines import linkage_lines
from crankwork.note.linkage_words import Words
from crankwork.note.options import NoteOptions
from crankwork.report.figures import figures

_POSITION_STEP = 30.0
# columns without a value at many positions
_IN_PLACES = ("instant_centre_", "instantaneous_efficiency")


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
    def table(self) -> TransferTable:
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
        """The positions of the plans, every 30 degrees, as far as the linkage reaches them. [deg]"""
        reached, _ = reached_angles(self.machine, 1.0)
        every = np.arange(0.0, self.machine.cycle + _POSITION_STEP, _POSITION_STEP)
        inside = every[(every >= reached[0]) & (every <= reached[-1])]
        # a linkage that reaches none of them is shown where it does move
        return inside if inside.size else reached[::5]

    @property
    def first(self) -> int | None:
        """Number of the first position, counted from a crank angle of zero; none where they have no numbers."""
        numbers = self.positions / _POSITION_STEP
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
        """Lines of the memory by the name of their group, worked where the loads need the largest torque."""
        degrees = None
        if self.machine.turning is not None:
            return {one.name: one for one in linkage_lines(self.results)}
        largest = ("driver_force", "driver_torque") if self.results.period else ("static_torque",)
        key = next((one for one in largest if one in self.columns), None)
        if (self.machine.loads or self.machine.chambers) and key is not None:
            # in a change point forces may not be determined
            told = [one for name, one in self.columns.items() if not name.startswith(_IN_PLACES)]
            is_told = np.all(np.isfinite(told), axis=0)
            degrees = float(self.positions[int(np.argmax(np.where(is_told, np.abs(self.columns[key]), -1.0)))])
        return {one.name: one for one in linkage_lines(self.results, degrees)}

    def lines(self, group: str, *kinds: str) -> tuple[Line, ...]:
        """Return the lines of a group, or those of it that give some quantities; none if there is no such group."""
        lines = self.groups[group].lines if group in self.groups else ()
        return tuple(one for one in lines if not kinds or one.key.partition(".")[0] in kinds)

    @cached_property
    def drawn(self) -> Mapping[str, bytes]:
        """Figures by name; none if they are left out."""
        return figures(self.results, language=self.options.language) if self.options.figures else {}

    def figures(self, *names: str) -> Iterator[Block]:
        """Yield figures, those that there are."""
        for name in names:
            if name in self.drawn:
                yield self.words.figure(name, self.drawn[name])
