"""A sheet of paper: its format, millimetre grid, frame, title block, and the figures on it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Literal, NamedTuple, get_args

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.locale import translate
from crankwork.note.sheets.packing import Fit, Layout, Picture, Sizes, finished, grown, packed, worth
from crankwork.note.sheets.table import text_block
from crankwork.note.sheets.title_block import (
    TitleBlock,
    corner_cell,
    size_of_block,
    size_of_corner,
    title_block,
    title_height,
)
from crankwork.quantities import Language
from crankwork.show.chart_layout import ChartLayout, use_layout
from crankwork.show.scene import ChartBox, Drawing, Item, Polyline, rectangle

Size = Literal["A0", "A1", "A2", "A3"]
SIZES: tuple[Size, ...] = get_args(Size)
_LENGTHS: dict[Size, tuple[float, float]] = {
    "A0": (1189.0, 841.0), "A1": (841.0, 594.0), "A2": (594.0, 420.0), "A3": (420.0, 297.0)
}  # fmt: skip
# shares of the width that columns of figures have, and how many figures a sheet holds
_LAYOUTS: dict[Size, tuple[Layout, ...]] = {
    "A0": ((1 / 3,) * 3, (1 / 2, 1 / 2), (1.0,)),
    "A1": ((1 / 2, 1 / 2), (1 / 3,) * 3, (1.0,)),
    # one that is too tall to stand above the title block stands beside it
    "A2": ((1 / 2, 1 / 2), (1.0,), (0.65,)),
    "A3": ((1.0,), (1 / 2, 1 / 2), (0.52,)),
}
_MOST: dict[Size, int] = {"A0": 12, "A1": 8, "A2": 4, "A3": 2}
# how tall graphs are at least, against those of a text
_LEAST: dict[Size, float] = {"A0": 0.6, "A1": 0.6, "A2": 0.4, "A3": 0.38}
_BINDING, _EDGE = 20.0, 5.0
# how often figures are placed anew whose names need more room than was thought
_TRIES = 8


class Paper(NamedTuple):
    """The paper of sheets: format `A0` to `A3`, millimetre grid, frame, and the title block if they have one."""

    size: Size = "A1"
    has_grid: bool = False
    has_frame: bool = True
    block: TitleBlock | None = None

    @property
    def box(self) -> ChartBox:
        """The whole paper. [mm]"""
        return ChartBox(0.0, 0.0, *_LENGTHS[self.size])

    @property
    def frame(self) -> ChartBox:
        """The inside of the frame: a margin of 20 mm to the left, for binding, and of 5 mm elsewhere. [mm]"""
        return self.box.inset(_BINDING, _EDGE, _EDGE, _EDGE)

    @property
    def corner(self) -> ChartBox:
        """Where the cell in the upper left corner is. [mm]"""
        width, height = size_of_corner(self.block) if self.block is not None else (0.0, 0.0)
        return ChartBox(self.frame.left, self.frame.top - height, width, height)

    @property
    def reserved(self) -> ChartBox:
        """Where the title block is. [mm]"""
        width, height = size_of_block(self.block) if self.block is not None else (0.0, 0.0)
        return ChartBox(self.frame.right - width, self.frame.bottom, width, height)


class Sheet(NamedTuple):
    """A sheet: name for its file, title, language, paper, and the figures on it."""

    name: str
    title: str
    language: Language
    paper: Paper
    figures: tuple[Fit, ...]

    @property
    def items(self) -> tuple[Item, ...]:
        """All that is drawn, from the ground up."""
        paper = self.paper
        drawn: list[Item] = _millimetres(paper.frame) if paper.has_grid else []
        for figure in self.figures:
            drawn.extend(figure.drawing.items)
        if paper.has_frame:
            drawn += [rectangle(paper.box, "net"), rectangle(paper.frame, "thick")]
            if paper.block is not None:
                drawn += corner_cell(paper.block, paper.corner)
        if paper.block is not None:
            drawn += title_block(paper.block, self.title, paper.size, paper.reserved)
        return tuple(drawn)

    @property
    def drawing(self) -> Drawing:
        """The sheet as what is written."""
        box = self.paper.box
        plots = tuple(plot for figure in self.figures for plot in figure.drawing.plots)
        return Drawing(self.title, self.language, box.width, box.height, self.items, plots)

    def figure(self, name: str) -> Fit:
        """Return a figure by its name."""
        figure = next((fit for fit in self.figures if fit.name == name), None)
        if figure is None:
            raise CrankworkError(
                f"there is no figure {name} on this sheet; there is {', '.join(fit.name for fit in self.figures)}"
            )
        return figure


def sheets_with(
    name: str, title: str, pictures: Sequence[Picture], paper: Paper, language: Language
) -> Iterator[Sheet]:
    """Yield the sheets that pictures need on a paper, each with about as many."""
    if paper.size not in SIZES:
        raise CrankworkError(f"no paper of size {paper.size} is known; take {', '.join(SIZES)}")
    sizes, most = Sizes(), _MOST[paper.size]
    count = math.ceil(len(pictures) / most)
    ends = [len(pictures) * index // count for index in range(count + 1)]
    parts = [_packed(pictures[start:end], paper, sizes) for start, end in itertools.pairwise(ends)]
    if not all(parts):
        # a picture that does not fit even alone is named in its place
        fitting = [
            picture if _packed([picture], paper, sizes) else _without_room(picture, paper, language)
            for picture in pictures
        ]
        sizes = Sizes()
        best: list[tuple[int, float, list[list[Fit]]]] = [(0, 0.0, [])]
        for end in range(1, len(pictures) + 1):
            options = []
            for start in range(max(0, end - most), end):
                if part := _packed(fitting[start:end], paper, sizes):
                    used, lost, before = best[start]
                    options.append((used + 1, lost - math.fsum(map(worth, part)), [*before, part]))
            # of few sheets those with the largest pictures
            best.append(min(options, key=lambda option: option[:2]))
        parts = best[-1][2]
    for part in parts:
        rough, done = part, [finished(fit, _field(paper), paper.corner) for fit in part]
        for _ in range(_TRIES):
            if not grown(rough, done, sizes) or not (higher := _packed([fit.picture for fit in part], paper, sizes)):
                break
            rough, done = higher, [finished(fit, _field(paper), paper.corner) for fit in higher]
        yield Sheet(name, title, language, paper, tuple(done))


def _without_room(picture: Picture, paper: Paper, language: Language) -> Picture:
    """Return a sentence that says which figure a paper is too small for."""
    with use_layout(ChartLayout(is_rough=True)):
        title = picture.draw().title
    text = translate("sheets.no_room", language, title=title, size=paper.size)
    return Picture(picture.name, partial(text_block, [text], title, language), has_title=False)


def _field(paper: Paper) -> ChartBox:
    return paper.frame.inset(2, 2, 2, 5)


def _packed(pictures: Sequence[Picture], paper: Paper, sizes: Sizes) -> list[Fit]:
    taken = paper.corner, paper.reserved
    return packed(pictures, _field(paper), taken, _LAYOUTS[paper.size], _LEAST[paper.size], sizes)


def numbered(sheets: Sequence[Sheet], paper: Paper) -> tuple[Sheet, ...]:
    """Return sheets that follow one another, each with its number in its title block."""
    if paper.block is None:
        return tuple(sheets)
    first, count = paper.block.sheet, max(paper.block.sheets, len(sheets))
    height = min((title_height(paper.block, sheet.title) for sheet in sheets), default=paper.block.title_height)
    block = paper.block._replace(sheets=count, title_height=height)
    blocks = [block._replace(sheet=first + index) for index in range(len(sheets))]
    return tuple(sheet._replace(paper=paper._replace(block=block)) for sheet, block in zip(sheets, blocks, strict=True))


def _millimetres(frame: ChartBox) -> list[Item]:
    """Return the grid of millimetre paper, every tenth line bold."""
    items: list[Item] = []
    for start, end, low, high, is_upright in (
        (frame.left, frame.right, frame.bottom, frame.top, True),
        (frame.bottom, frame.top, frame.left, frame.right, False),
    ):
        for count, position in enumerate(np.arange(start, end + 1e-9, 1.0)):
            ends = [[position, low], [position, high]] if is_upright else [[low, position], [high, position]]
            items.append(Polyline(np.array(ends), "grid" if count % 10 else "grid_bold"))
    items.sort(key=lambda grid_line: isinstance(grid_line, Polyline) and grid_line.kind == "grid_bold")
    return items
