"""A note put together of its sections: those of its school, or those that its document names."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Protocol, TypeVar

from crankwork.machine import Machine
from crankwork.note.cover import cover
from crankwork.note.document import Block, Contents, Heading, ItemList, Note, PageBreak, Paragraph, Reference
from crankwork.note.legends import explained
from crankwork.note.options import NoteOptions

# headings of contents that fill a page to more than three fifths
_OWN_PAGE = 24


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
