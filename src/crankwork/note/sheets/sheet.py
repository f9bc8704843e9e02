"""A sheet of paper: its size, millimetre grid, frame, title block, and the graphs on it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.note.sheets.graph import Graph
from crankwork.note.sheets.title_block import BLOCK, TitleBlock, corner_cell, title_block
from crankwork.note.sheets.words import Words
from crankwork.quantities import Language
from crankwork.show.scene import Box, Drawing, Item, Polyline, rectangle

Size = Literal["A1", "A0"]
SIZES: dict[Size, tuple[float, float]] = {"A1": (841.0, 594.0), "A0": (1189.0, 841.0)}
_BINDING, _EDGE = 20.0, 5.0
# layouts are laid out on the field of A1 between its margins
_FIELD = (816.0, 580.0)


class Paper(NamedTuple):
    """What sheets are drawn on: `A1` or `A0`, millimetre grid, frame, and the title block if they have one."""

    size: Size = "A1"
    has_grid: bool = False
    has_frame: bool = True
    block: TitleBlock | None = None

    @property
    def box(self) -> Box:
        """The whole paper. [mm]"""
        if self.size not in SIZES:
            raise CrankworkError(f"no paper of size {self.size} is known; take {' or '.join(SIZES)}")
        return Box(0.0, 0.0, *SIZES[self.size])

    @property
    def frame(self) -> Box:
        """What the frame encloses: a margin of 20 mm to the left, for binding, and of 5 mm elsewhere. [mm]"""
        return self.box.inset(_BINDING, _EDGE, _EDGE, _EDGE)

    @property
    def reserved(self) -> Box:
        """Where the title block is. [mm]"""
        return Box(self.frame.right - BLOCK.width, self.frame.bottom, BLOCK.width, BLOCK.height)

    def part(self, left: float, bottom: float, width: float, height: float) -> Box:
        """Return a box of a layout.

        `left`, `bottom`, `width` and `height`: on a field of 816 x 580 mm, which A1 has; larger paper stretches it
        [mm].
        """
        x, y = self.frame.width / _FIELD[0], (self.frame.height - 4.0) / _FIELD[1]
        return Box(self.frame.left + x * left, self.frame.bottom + y * bottom, x * width, y * height).inset(1, 1, 1, 1)


class Sheet(NamedTuple):
    """A sheet: name for its file, title, language, paper, graphs, and what else is drawn on it."""

    name: str
    title: str
    language: Language
    paper: Paper
    graphs: tuple[Graph, ...]
    more: tuple[Item, ...] = ()

    @property
    def items(self) -> tuple[Item, ...]:
        """All that is drawn, from the ground up."""
        paper = self.paper
        drawn: list[Item] = _millimetres(paper.frame) if paper.has_grid else []
        for one in self.graphs:
            drawn.extend(one.items)
        drawn.extend(self.more)
        if paper.has_frame:
            drawn += [rectangle(paper.box, "net"), rectangle(paper.frame, "thick")]
            if paper.block is not None:
                drawn += corner_cell(paper.block, paper.frame)
        if paper.block is not None:
            drawn += title_block(paper.block, self.title, paper.reserved, Words(self.language))
        return tuple(drawn)

    @property
    def drawing(self) -> Drawing:
        """The sheet as what is written."""
        box = self.paper.box
        return Drawing(self.title, self.language, box.width, box.height, self.items)

    def graph(self, name: str) -> Graph:
        """Return a graph by its name."""
        found = next((one for one in self.graphs if one.name == name), None)
        if found is None:
            raise CrankworkError(
                f"there is no graph {name} on this sheet; there is {', '.join(one.name for one in self.graphs)}"
            )
        return found


def numbered(sheets: Sequence[Sheet], paper: Paper) -> tuple[Sheet, ...]:
    """Return sheets that follow one another, each with its number in its title block."""
    if paper.block is None:
        return tuple(sheets)
    first, count = paper.block.sheet, max(paper.block.sheets, len(sheets))
    blocks = [paper.block._replace(sheet=first + at, sheets=count) for at in range(len(sheets))]
    return tuple(one._replace(paper=paper._replace(block=block)) for one, block in zip(sheets, blocks, strict=True))


def _millimetres(frame: Box) -> list[Item]:
    """Return the grid of millimetre paper, every tenth line bold."""
    items: list[Item] = []
    for start, end, low, high, is_upright in (
        (frame.left, frame.right, frame.bottom, frame.top, True),
        (frame.bottom, frame.top, frame.left, frame.right, False),
    ):
        for count, at in enumerate(np.arange(start, end + 1e-9, 1.0)):
            ends = [[at, low], [at, high]] if is_upright else [[low, at], [high, at]]
            items.append(Polyline(np.array(ends), "grid" if count % 10 else "grid_bold"))
    items.sort(key=lambda one: isinstance(one, Polyline) and one.kind == "grid_bold")
    return items
