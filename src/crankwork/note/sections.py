"""A note put together of its cover and its sections: those of its school, or those that its document names."""

from __future__ import annotations

import datetime as dt
import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Protocol, TypeVar

from crankwork.locale import Language, say
from crankwork.machine import Document, Machine
from crankwork.note.captions import printed_date
from crankwork.note.document import (
    Block,
    Contents,
    Heading,
    ItemList,
    Note,
    PageBreak,
    Paragraph,
    Person,
    Reference,
    TitlePage,
)
from crankwork.note.legends import explained
from crankwork.note.options import NoteOptions

# headings of contents that fill a page to more than three fifths
_OWN_PAGE = 24
# who stands on a cover, in the order of each language, and who signs beside the name
_PEOPLE: dict[Language, tuple[str, ...]] = {
    "en": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "ru": ("author", "student_number", "group", "supervisor", "checked_by", "standards_by", "approved_by"),
    "vi": ("supervisor", "author", "student_number", "group", "checked_by", "standards_by", "approved_by"),
}
_SIGN = ("author", "supervisor", "checked_by", "standards_by", "approved_by")


class _Material(Protocol):
    @property
    def machine(self) -> Machine: ...
    @property
    def options(self) -> NoteOptions: ...


M = TypeVar("M", bound=_Material)


def note_of_sections(
    material: M,
    sections: Mapping[str, Callable[[M], Iterator[Block]]],
    order: tuple[str, ...],
    title: str,
    subtitle: str,
    *,
    with_results: bool = False,
) -> Note:
    """Return the note of some of these sections behind its cover and contents.

    `order`: those of the school. What a note cites stands in its list of sources, which is always there.
    """
    options, document = material.options, material.machine.document
    if options.author.strip():
        document = replace(document, author=(options.author,))
    chosen = document.sections
    if chosen and "sources" not in chosen:
        chosen = (*chosen, "sources")
    written = itertools.chain.from_iterable(sections[name](material) for name in chosen or order)
    blocks = tuple(explained(written, options.language, with_results=with_results))
    # on a page of their own where they fill it: Typst then sets the rest once, not again with every page found
    listed = sum(isinstance(block, Heading) and block.level <= 2 for block in blocks)
    front: list[Block] = [cover(document, options.language, subtitle), Contents()]
    if listed >= _OWN_PAGE:
        front.append(PageBreak())
    return Note(
        options.title or material.machine.title or title,
        options.language,
        (*front, *(_complete(blocks) if chosen else blocks)),
        tuple(author for author in document.author if author.strip()),
        document.date,
    )


def _complete(blocks: Iterable[Block]) -> Iterator[Block]:
    """Yield blocks without the paragraphs that refer to sections that were not chosen."""
    kept = list(blocks)
    labels = {getattr(item, "label", "") for item in kept}
    for block in kept:
        parts = (block.runs,) if isinstance(block, Paragraph) else block.items if isinstance(block, ItemList) else ()
        references = {run.label for runs in parts for run in runs if isinstance(run, Reference)}
        if references <= labels:
            yield block


def cover(document: Document, language: Language, subtitle: str) -> TitlePage:
    """Return the cover; `subtitle` names the kind of note where the document does not."""
    named = {key: say(f"note.cover_{key}", language, name=getattr(document, key)) for key in ("subject", "variant")}
    institution = (document.ministry, document.institution, document.faculty, document.department)
    above = (document.work, named["subject"] if document.subject else "")
    below = (document.subtitle or subtitle, document.designation, named["variant"] if document.variant else "")
    when = _when(document.date, document.year, language)
    return TitlePage(
        institution=tuple(filter(None, institution)),
        above=tuple(filter(None, above)),
        below=tuple(filter(None, below)),
        people=tuple(person for key in _PEOPLE[language] if (person := _person(document, key, language)).names),
        place=say("note.cover_place", language, city=document.city, when=when) if document.city else when,
    )


def _person(document: Document, key: str, language: Language) -> Person:
    value = getattr(document, key)
    # a name left open in the file gets no line
    names = tuple(name for name in ((value,) if isinstance(value, str) else value) if name.strip())
    label = say(f"note.cover_{'several_' if len(names) > 1 else ''}{key}", language)
    return Person(label, names, signs=language == "ru" and key in _SIGN)


def _when(date: dt.date | None, year: int, language: Language) -> str:
    """Return when a note was made as covers say it: the year alone, where reports in English give the day."""
    if date is not None:
        return printed_date(date, language) if language == "en" else str(date.year)
    return str(year) if year else ""
