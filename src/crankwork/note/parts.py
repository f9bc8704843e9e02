"""What sections of notes are made of, as data: each part yields its blocks for a machine.

Conditions ask for keys of results, for parts of the machine, or for the school; none asks what kind of machine it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from crankwork.note.document import Block, Citation, Reference, Run, Runs, Table
from crankwork.note.material import Material
from crankwork.note.tables import angle_table, distinct_columns, listing_table, tabulated
from crankwork.note.wording import named

Condition = Callable[[Material], bool]
Value = str | Reference | Citation | Callable[[Material], Run | Runs]
Keys = tuple[str, ...] | Callable[[Material], Iterable[str]]
Part = Callable[[Material], Iterable[Block]]


def always(_: Material) -> bool:
    """Hold for every machine."""
    return True


@dataclass(frozen=True)
class Head:
    """A heading."""

    key: str
    level: int = 1

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        yield material.words.heading(self.key, self.level)


@dataclass(frozen=True)
class Text:
    """A sentence and what is put in."""

    key: str
    values: Mapping[str, Value] = field(default_factory=dict)

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        values = {name: value(material) if callable(value) else value for name, value in self.values.items()}
        yield material.words.paragraph(self.key, **values)


@dataclass(frozen=True)
class At:
    """The sentence that says where a group of lines is worked."""

    group: str

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        return material.worked_at(self.group)


@dataclass(frozen=True)
class Lines:
    """Equations of a group, or those of it that give some quantities; `intro`: a sentence before them."""

    group: str
    kinds: tuple[str, ...] = ()
    intro: str = ""
    first: bool = False  # One line of each formula
    source: str = ""  # What the sentence cites

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield them."""
        blocks = material.equations(self.group, *self.kinds, first=self.first)
        if not self.intro:
            return iter(blocks)
        return material.intro(self.intro, blocks, **({"source": Citation(self.source)} if self.source else {}))


@dataclass(frozen=True)
class Over:
    """A table over the crank angle of columns."""

    caption: str
    keys: Keys
    one_turn: bool = False

    def __call__(self, material: Material) -> Table | None:
        """Return it, None without columns."""
        keys = self.keys(material) if callable(self.keys) else self.keys
        return angle_table(material, self.caption, keys, until=360.0 if self.one_turn else math.inf)


@dataclass(frozen=True)
class Rows:
    """A table of a listing."""

    name: str
    caption: str

    def __call__(self, material: Material) -> Table | None:
        """Return it, None without a listing."""
        return listing_table(material, self.name, self.caption)


@dataclass(frozen=True)
class Listed:
    """A table of a listing, which stands without a reference."""

    name: str
    caption: str

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        table = listing_table(material, self.name, self.caption)
        yield from () if table is None else (replace(table, label=self.name),)


@dataclass(frozen=True)
class Places:
    """A table over the numbered positions, which stands without a reference; `filled`: columns of zeros left out."""

    caption: str
    kinds: Keys
    label: str = ""
    filled: bool = False

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        if callable(self.kinds):
            keys = list(self.kinds(material))
        else:
            keys = material.nonzero(*self.kinds) if self.filled else named(material.columns, *self.kinds)
        kept, sentences = distinct_columns(material, keys)
        yield from sentences
        yield from tabulated(material, self.caption, kept, self.label)


@dataclass(frozen=True)
class Shown:
    """Kinds of figures, and tables, after a sentence that refers to them by number; `short`: of short notes only."""

    figures: tuple[str, ...] = ()
    tables: tuple[Callable[[Material], Table | None], ...] = ()
    short: tuple[str, ...] = ()

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield them."""
        figures = (*self.figures, *(() if material.full else self.short))
        return material.presented([table(material) for table in self.tables], figures)


@dataclass(frozen=True)
class When:
    """Parts that stand only where a condition holds."""

    condition: Condition
    parts: tuple[Part, ...]

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield their blocks."""
        return written(self.parts if self.condition(material) else (), material)


@dataclass(frozen=True)
class Section:
    """A section of a note: its name in a machine file, its parts, and where it stands."""

    name: str
    parts: tuple[Part, ...]
    when: Condition = always


def full(material: Material) -> bool:
    """Return whether a note is to show everything."""
    return material.full


def in_full(table: Callable[[Material], Table | None]) -> Callable[[Material], Table | None]:
    """Return a table of the note that shows everything, None in another one."""
    return lambda material: table(material) if material.full else None


def has(*keys: str) -> Condition:
    """Return the condition that results have a column, single value, table or listing of each name."""
    return lambda material: all(map(material.has, keys))


def works(*groups: str) -> Condition:
    """Return the condition that there are lines of each group."""
    return lambda material: all(group in material.groups for group in groups)


def draws(*figures: str) -> Condition:
    """Return the condition that one of some figures is drawn."""
    return lambda material: any(name in material.drawn for name in figures)


def machine_has(part: str) -> Condition:
    """Return the condition that the machine has a part."""
    return lambda material: bool(getattr(material.machine, part))


def has_torques(material: Material) -> bool:
    """Return whether torques on a shaft are given."""
    return material.machine.turning is not None and bool(material.machine.turning.diagrams)


def school(*names: str) -> Condition:
    """Return the condition that the order of sections is that of one of some schools."""
    return lambda material: material.order in names


def driven(material: Material) -> bool:
    """Return whether a law over time drives, so that no crank turns at the speed of a flywheel."""
    return bool(material.results.period)


def drawn(material: Material) -> bool:
    """Return whether links are told one by one, of a linkage that was drawn."""
    return material.machine.linkage is not None


def turning(material: Material) -> bool:
    """Return whether links are told one by one, and a crank drives them."""
    return drawn(material) and not driven(material)


def every(*conditions: Condition) -> Condition:
    """Return the condition that all of some hold."""
    return lambda material: all(condition(material) for condition in conditions)


def either(*conditions: Condition) -> Condition:
    """Return the condition that one of some holds."""
    return lambda material: any(condition(material) for condition in conditions)


def lacks(condition: Condition) -> Condition:
    """Return the condition that another one does not hold."""
    return lambda material: not condition(material)


def amount(key: str, unit: str) -> Value:
    """Return a single value with its unit, to be put into a sentence."""
    return lambda material: material.words.amount(material.summary[key], unit, digits=material.digits)


def number(key: str) -> Value:
    """Return a single value without a unit, to be put into a sentence."""
    return lambda material: material.words.number(material.summary[key], digits=material.digits)


def written(parts: Iterable[Part], material: Material) -> Iterator[Block]:
    """Yield the blocks of parts."""
    for part in parts:
        yield from part(material)
