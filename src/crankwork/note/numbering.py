"""The numbers of sections, equations, tables, figures and sources, the same in every format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from crankwork.errors import CrankworkError
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.expression import Formula
from crankwork.note.captions import place_in_source
from crankwork.note.document import (
    Block,
    Bold,
    Citation,
    Equation,
    Figure,
    Heading,
    ItemList,
    Note,
    Paragraph,
    Reference,
    Run,
    Table,
)
from crankwork.quantities import Language
from crankwork.sources import school_source, source_language, sources


class Numbering(NamedTuple):
    """Numbers of the blocks by their place in the note (empty where a block has none), of labels and of sources."""

    blocks: tuple[str, ...]
    labels: dict[str, str]
    sources: dict[str, int]
    language: Language

    def reference(self, label: str) -> str:
        """Return the number of the block with a label."""
        if label not in self.labels:
            raise CrankworkError(f'the note refers to "{label}", which no block has as its label; label the block')
        return self.labels[label]

    def citation(self, source: str) -> str:
        """Return a source as `[2, ch. 6]`, the place as the language of the note abbreviates it."""
        key, _, place = source.partition(",")
        number = str(self.sources[key])
        return f"[{number}, {place_in_source(place.strip(), self.language)}]" if place.strip() else f"[{number}]"

    def words(self, run: str | Bold | Reference | Citation) -> str:
        """Return the text of a run that is no mathematics."""
        match run:
            case Bold(words):
                return words
            case Reference(label):
                return self.reference(label)
            case Citation(source):
                return self.citation(school_source(source, self.language))
        return run

    def mark(self, block: Equation, number: str, between: str = "\u2002") -> str:
        """Return the source and the number of an equation, printed beside it."""
        source = equation_source(block, self.language) if block.cites else ""
        return between.join(([self.citation(source)] if source else []) + ([f"({number})"] if number else []))


def numbering(note: Note) -> Numbering:
    """Return the numbers of everything that a note numbers."""
    counts: Counter[str] = Counter()
    sections = [0, 0, 0]
    numbers: list[str] = []
    labels: dict[str, str] = {}
    for block in note.blocks:
        number = _section_number(block, sections) if isinstance(block, Heading) else _plain_number(block, counts)
        numbers.append(number)
        label = getattr(block, "label", "")
        if label in labels:
            raise CrankworkError(f'two blocks of the note have the label "{label}"; give each its own')
        if label:
            labels[label] = f"({number})" if isinstance(block, Equation) else number
    return Numbering(tuple(numbers), labels, _source_numbers(note), note.language)


def _section_number(heading: Heading, sections: list[int]) -> str:
    """Return `2.1` and count on; a heading without number counts nothing."""
    if not heading.numbered:
        return ""
    level = min(max(heading.level, 1), 3)
    sections[level - 1] += 1
    sections[level:] = [0] * (3 - level)
    return ".".join(map(str, sections[:level]))


def _plain_number(block: Block, counts: Counter[str]) -> str:
    counted = isinstance(block, Table | Figure | Equation)
    if not counted:
        return ""
    kind = type(block).__name__
    counts[kind] += not (isinstance(block, Table) and not block.caption)
    return str(counts[kind])


def equation_source(block: Equation, language: Language) -> str:
    """Return the source of the formula of an equation in the school of a language, empty where it has none."""
    match block.step:
        case FormulaLine(formula=formula) | (Formula() as formula):
            return school_source(formula.source, language, formula.quantity)
    return ""


def _source_numbers(note: Note) -> dict[str, int]:
    keys = list(dict.fromkeys([*(key.partition(",")[0] for key in _cited(note)), *note.sources]))
    unknown = [key for key in keys if key not in sources()]
    if unknown:
        raise CrankworkError(f'the bibliography has no "{unknown[0]}"; add it to sources.bib or cite another source')
    # those in the language of the note first, as lists of references have them
    keys.sort(key=lambda key: source_language(key) != note.language)
    return {key: number for number, key in enumerate(keys, start=1)}


def _cited(note: Note) -> Iterator[str]:
    """Yield the sources in the order in which the text comes to them."""
    for block in note.blocks:
        if isinstance(block, Equation) and (source := equation_source(block, note.language)):
            yield source
        for run in _runs(block):
            if isinstance(run, Citation):
                yield school_source(run.source, note.language)


def _runs(block: Block) -> Iterator[Run]:
    match block:
        case Paragraph(runs):
            yield from runs
        case ItemList(items):
            for item in items:
                yield from item
        case Table(headings=headings):
            for heading in headings:
                yield from heading
