"""Drawings as SVG elements within a web page, in the colours of the page."""

from __future__ import annotations

import html
import re
import string
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.show.animation import Animation
from crankwork.show.canvas import marked
from crankwork.show.chart import true_slices
from crankwork.show.scene import (
    CAP_HEIGHT,
    ChartBox,
    Drawing,
    Item,
    LineKind,
    Pen,
    Plot,
    Polyline,
    Run,
    Text,
    pen_of,
    runs,
)
from crankwork.show.svg import SvgWriter, film_body
from crankwork.show.theme import KINDS, Theme, alt_text, curve_kind, fill_colours, palette_of

# deviation of a curve that is invisible on a screen [mm]
_INVISIBLE_DEVIATION = 0.05
# what of the margins of a film is not seen on a page [mm]
_EDGE = 4.0
# the same at a position that is given by its crank angle, between points of the curve [mm]
_MISPLACED = 0.3
_LETTERS = {10 * (index + 1): letter for index, letter in enumerate(string.ascii_lowercase)}
_QUOTED = re.compile(r"""="([^"\s=<>`'/&]+)"(?=[ >])""")
_FILLED = fill_colours("print")
# a number with a decimal point ends where the next point begins
_PARTED_BY_POINTS = re.compile(r"(?<=\.\d) (?=\.)|(?<=\.\d\d) (?=\.)")


def inline_svg(drawing: Drawing, name: str, about: str = "", marks: Sequence[str] = ()) -> str:
    """Return a drawing as an SVG element with the class `drawing`; `name`: by which the page finds it.

    `about`: alternative text; `marks`: a class for each item, mostly empty, by which the page finds it.
    """
    writer = _writer(drawing)
    written = _grouped(writer, drawing.items, marks) if marks else writer.written(drawing.items)
    return _element(drawing, name, about or alt_text(drawing), written, writer.usual)


def inline_positions(drawings: Sequence[Drawing | None], name: str, about: str, row: int) -> tuple[str, list[str]]:
    """Return one of some drawings as an element that has room for each, and what of each is not in all.

    A group of the element has that of its own.
    """
    lists = [[] if drawing is None else _each(drawing) for drawing in drawings]
    highest = max((drawing for drawing in drawings if drawing is not None), key=lambda drawing: drawing.height)
    steady = set.intersection(*(set(written) for written in lists if written))
    moving = ["".join(text for text in written if text not in steady) for written in lists]
    fixed = [text for text in lists[row] if text in steady]
    written = [*fixed, '<g class="moving">', moving[row], "</g>"]
    return _element(highest, name, about, written, _writer(highest).usual), moving


def _each(drawing: Drawing) -> list[str]:
    writer = _writer(drawing)
    return ["".join(writer.written((item,))) for item in drawing.items]


def _writer(drawing: Drawing) -> _InlineWriter:
    # panels have curves of the same name; their angles follow in the order of the panels
    angles = dict[str, list[Array]]()
    for plot in drawing.plots:
        for curve, column in plot.angles.items():
            parts = true_slices(np.isfinite(sum(plot.curves[curve])))
            angles.setdefault(curve, []).extend(column[part] for part in parts)
    heights = [round(100 * item.height / CAP_HEIGHT) for item in drawing.items if isinstance(item, Text)]
    sizes = Counter(map(_hundredths, heights))
    return _InlineWriter(drawing.height, angles, max(sizes, key=lambda size: sizes[size], default="3"))


def _grouped(writer: SvgWriter, items: Sequence[Item], marks: Sequence[str]) -> Iterator[str]:
    """Yield items in order, consecutive items of one mark in a group."""
    for mark, group in groupby(zip(marks, items, strict=True), key=lambda pair: pair[0]):
        written = writer.written(tuple(item for _, item in group))
        yield "".join([f'<g class="{mark}">', *written, "</g>"]) if mark else "".join(written)


def inline_film(film: Animation, name: str) -> str:
    """Return an animation as an SVG element that is at rest until the page moves its parts."""
    body = film_body(film, lambda items, height: _InlineWriter(height, {}).written(items))
    drawn, height = _element(film.ground, name, film.about, body), film.ground.height
    near = ChartBox(0.0, 0.0, film.ground.width, height).inset(*[_EDGE] * 4)
    boxes = near, film.covered or near
    views = [f"{box.left:.1f} {height - box.top:.1f} {box.width:.1f} {box.height:.1f}" for box in boxes]
    return re.sub(r'viewBox="[^"]*"', f'viewBox="{views[0]}" data-whole="{views[1]}"', drawn, count=1)


def _element(drawing: Drawing, name: str, about: str, written: Iterable[str], size: str = "3") -> str:
    width, height = (_hundredths(round(100 * size_mm)) for size_mm in (drawing.width, drawing.height))
    label, view = html.escape(about), f'viewBox="0 0 {width} {height}" style="max-width:{width}mm"'
    head = f'<svg class="drawing" data-figure="{html.escape(name)}" {view} font-size="{size}" role="img"'
    # HTML needs quotation marks only for values with blanks or special characters
    return _QUOTED.sub(r"=\1", "".join([head, f' aria-label="{label}">', *written, "</svg>"]))


class _InlineWriter(SvgWriter):
    """Writes items in the colours of the page, curves by their kind, points as steps in hundredths of a millimetre."""

    _SPACES = _JOIN = ""
    _SLANTED = ' class="di"'

    def __init__(self, height: float, angles: Mapping[str, list[Array]], usual: str = "") -> None:
        super().__init__(height, palette_of("print"))
        self._angles, self._kind, self.usual = angles, "", usual

    def _invisible_deviation(self, item: Polyline) -> float:
        return _INVISIBLE_DEVIATION if item.name else super()._invisible_deviation(item)

    def _line(self, item: Polyline) -> str:
        if not item.name:
            return super()._line(item)
        if item.fill is not None and item.name in _FILLED:
            return super()._line(item._replace(name="", kind=pen_of(item.kind)._replace(colour=f"var(--{item.name})")))
        mask = self._masks.get(id(item.points), np.ones(len(item.points), dtype=bool))
        # the next part of a curve with gaps
        remaining, places = self._angles.get(item.name), ""
        angles = remaining.pop(0) if remaining else None
        if angles is not None and len(angles) == len(mask):
            mask = _with_places(mask, item.points, angles)
            places = f' data-at="{_angle_steps(angles[mask])}"'
        d = self._steps(item.points[mask], closed=item.closed)
        self._kind = curve_kind(item)
        look, self._kind = self._drawn_as(item.kind, item.fill), ""
        return f'<path data-curve="{html.escape(item.name)}"{places} d="{d}"{look}/>'

    def _drawn_as(self, kind: LineKind | Pen, fill: float | None = None) -> str:
        pen = pen_of(kind)
        if fill in (0, 1) and not pen.width and not pen.colour:
            return ' class="db"' if fill else ' class="dd"'
        return super()._drawn_as(kind, fill)

    def _drawn(self, colour: str) -> str:
        if self._kind:
            return f' stroke="var(--{self._kind})"'
        # the colour of ink is inherited
        return "" if colour == "var(--ink)" else f' stroke="{colour}"'

    def _text(self, item: Text) -> str:
        # tenths of a millimetre are fine enough for text
        x, down = item.place[0], self._height - item.place[1]
        return super()._text(item._replace(place=(round(x, 1), self._height - round(down, 1))))

    def _lettered(self, item: Text) -> str:
        kinds = [*([f"d{item.anchor[0]}"] if item.anchor != "start" else []), *(["dh"] if item.halo else [])]
        look = f' class="{" ".join(kinds)}"' if kinds else ""
        # the style sheet has the colour of texts
        return look + (f' style="fill:{self._shade(item.grey)}"' if item.grey else "")

    def _sized(self, size: float) -> str:
        written = self._number(size)
        return "" if written == self.usual else f' font-size="{written}"'

    def _filled(self, fill: float | None, colour: str = "") -> str:
        return "" if fill is None else super()._filled(fill, colour)

    def _coloured(self, colour: str) -> str:
        return colour if colour.startswith("var") else super()._coloured(colour)

    def _shade(self, grey: float, colour: str = "") -> str:
        share = round(20 * grey)
        if colour:
            return f"color-mix(in srgb,var(--ground) {5 * share}%,{colour})"
        return "var(--ground)" if share == 20 else f"var(--g{share})" if share else "var(--ink)"

    def _number(self, value: float) -> str:
        return _hundredths(round(100 * value))

    def _steps(self, points: Array, *, closed: bool = False) -> str:
        places = np.rint(np.column_stack([points[:, 0], self._height - points[:, 1]]) * 100).astype(int)
        x, y = places[0].tolist()
        moves = np.diff(places, axis=0)
        if len(moves) == 1 and not moves.all():
            across, down = moves[0].tolist()
            return f"M{_hundredths(x)}{_parted(y)}{f'v{_hundredths(down)}' if down else f'h{_hundredths(across)}'}"
        body = _PARTED_BY_POINTS.sub("", "".join(map(_parted, moves.ravel().tolist())).removeprefix(" "))
        return f"M{_hundredths(x)}{_parted(y)}l{body}{'z' if closed else ''}"


def html_text(text: str) -> str:
    """Return a text with its marks as HTML.

    Examples
    --------
    >>> html_text("/{M}_{кр} = 10^{3}")
    '<i>M</i><sub>кр</sub> = 10<sup>3</sup>'
    """
    return "".join(_html(run) for run in runs(text))


def html_symbol(symbol: str) -> str:
    """Return a symbol `base_index` as HTML."""
    return html_text(marked(f"${symbol}$"))


def _html(run: Run) -> str:
    text = html.escape(run.text)
    shifted = {-1: f"<sub>{text}</sub>", 0: text, 1: f"<sup>{text}</sup>"}[run.shift]
    return f"<i>{shifted}</i>" if run.is_slanted else shifted


def frame_data(plot: Plot) -> dict[str, Any]:
    """Return the data from which a page redraws the frame of a graph in other scales."""
    return {key: plot.frame[key] for key in ("ticks", "labels", "powers")} if plot.frame else {}


def frame_marks(drawing: Drawing) -> list[str]:
    """Return marks by which a page finds the frames of graphs."""
    marks = [""] * len(drawing.items)
    for index, plot in enumerate(drawing.plots):
        if plot.frame:
            first, last = plot.frame["items"]
            marks[first:last] = [f"frame {index}"] * (last - first)
    return marks


def figure_data(drawing: Drawing) -> dict[str, Any]:
    """Return the positions of the graphs of a drawing, downward as in SVG [mm], and the curves of each legend row."""
    lines = [item for item in drawing.items if isinstance(item, Polyline) and item.name]
    rows = [_look(line) for line in lines if line.name == "legend"]
    named = {row: dict.fromkeys(line.name for line in lines if _look(line) == row) for row in rows}
    legend = [[name for name in named[row] if name != "legend"] for row in rows]
    return {"plots": [_plot(plot, drawing.height) for plot in drawing.plots], "legend": legend}


def _look(line: Polyline) -> tuple[object, ...]:
    pen = pen_of(line.kind)
    return (*(round(dash / pen.width, 2) for dash in pen.dashes if pen.width), round(pen.width, 3), pen.colour)


def _plot(plot: Plot, height: float) -> dict[str, Any]:
    box = plot.box
    place = [round(length, 3) for length in (box.left, height - box.top, box.width, box.height)]
    titles = [html_text(plot.titles.get(axis, "")) for axis in ("x", "y")]
    return {"box": place, "x": list(map(float, plot.x)), "y": list(map(float, plot.y)), "over": plot.over, "t": titles}


def _hundredths(count: int) -> str:
    """Format hundredths as a short number."""
    units, part = divmod(abs(count), 100)
    return f"{'-' if count < 0 else ''}{units or ''}{f'.{part:02d}'.rstrip('0') if part else '' if units else '0'}"


def _parted(count: int) -> str:
    """Format hundredths with a sign or a space that separates them from the number before."""
    return _hundredths(count) if count < 0 else f" {_hundredths(count)}"


def _with_places(mask: NDArray[np.bool_], points: Array, angles: Array) -> NDArray[np.bool_]:
    """Extend a mask of points until interpolation by the angle is close to all points, for a dot that moves along."""
    while True:
        interpolated = np.column_stack([np.interp(angles, angles[mask], column) for column in points[mask].T])
        distance = np.where(mask, 0.0, np.hypot(*(points - interpolated).T))
        interval = np.cumsum(mask) - 1
        farthest = np.maximum.reduceat(distance, np.flatnonzero(mask))[interval]
        added = (distance == farthest) & (farthest > _MISPLACED)
        if not added.any():
            return mask
        mask = mask | added


def _angle_steps(angles: Array) -> str:
    """Return angles as steps from the previous one, in tenths of a degree; a to z are whole degrees up to 26."""
    steps = np.diff(np.rint(angles * 10).astype(int), prepend=0).tolist()
    texts = (
        _LETTERS.get(step) or f" {step // 10 if step % 10 == 0 else str(step / 10).removeprefix('0')}" for step in steps
    )
    # only numbers need a separator
    return re.sub("(?<=[a-z]) ", "", "".join(texts)).strip()


_GREYS = "".join(f"--g{grey}:color-mix(in srgb,var(--ground) {5 * grey}%,var(--ink));" for grey in range(1, 20))
# elements that are reused with `use` have no ancestors, so classes have no context
STYLE = (
    f":root{{{_GREYS}}}.drawing{{fill:none;stroke:var(--ink);stroke-linejoin:round}}"
    ".drawing text{fill:var(--ink);stroke:none;white-space:pre}"
    ".dd{fill:var(--ink);stroke:none}.db{fill:var(--ground);stroke:none}"
    ".dm{text-anchor:middle}.de{text-anchor:end}.di{font-style:italic}"
    ".drawing .dh{stroke:var(--ground);stroke-width:.2em;paint-order:stroke}"
)


def colours(theme: Theme) -> str:
    """Return the variables of a theme for a style sheet: ground, ink and the colours of curves."""
    palette = palette_of(theme)
    curves = "".join(f"--{kind}:{palette.curves.get(kind, palette.ink)};" for kind in KINDS)
    fills = "".join(f"--{name}:{colour};" for name, colour in fill_colours(theme).items())
    return f"--ground:{palette.ground};--ink:{palette.ink};{curves}{fills}"
