"""A drawing as an SVG element within a web page, in the ink and on the ground of the page."""

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
from crankwork.show.alt import described
from crankwork.show.chart import stretches
from crankwork.show.moving import MovingDrawing
from crankwork.show.moving_svg import film_body
from crankwork.show.paper import marked
from crankwork.show.scene import CAP_HEIGHT, Drawing, Item, LineKind, Pen, Plot, Polyline, Run, Text, pen_of, runs
from crankwork.show.svg import SvgWriter
from crankwork.show.theme import KINDS, Theme, curve_kind, fill_colours, look_of

# of a curve, what nobody sees on a screen [mm]
_UNSEEN = 0.05
# of a place told by its crank angle, between points of the curve [mm]
_MISPLACED = 0.3
_LETTERS = {10 * (at + 1): letter for at, letter in enumerate(string.ascii_lowercase)}
_QUOTED = re.compile(r"""="([^"\s=<>`'/&]+)"(?=[ >])""")
_FILLED = fill_colours("print")
# a number with a point ends where another point begins
_PARTED_BY_POINTS = re.compile(r"(?<=\.\d) (?=\.)|(?<=\.\d\d) (?=\.)")


def inline_svg(drawing: Drawing, name: str, about: str = "", marks: Sequence[str] = ()) -> str:
    """Return a drawing as an SVG element with the class `drawing`; `name`: by which the page knows it.

    `marks`: a class for each item, empty for most, by which the page finds what becomes of it.
    """
    # graphs side by side have curves of one name, drawn in the order of these
    angles = dict[str, list[Array]]()
    for plot in drawing.plots:
        for curve, one in plot.angles.items():
            parts = stretches(np.isfinite(sum(plot.curves[curve])))
            angles.setdefault(curve, []).extend(one[part] for part in parts)
    sizes = Counter(_hundredths(round(100 * one.height / CAP_HEIGHT)) for one in drawing.items if isinstance(one, Text))
    usual = max(sizes, key=lambda size: sizes[size], default="3")
    writer = _InlineWriter(drawing.height, angles, usual)
    written = _grouped(writer, drawing.items, marks) if marks else writer.written(drawing.items)
    return _element(drawing, name, about or described(drawing), written, usual)


def _grouped(writer: SvgWriter, items: Sequence[Item], marks: Sequence[str]) -> Iterator[str]:
    """Yield items in their order, those of one mark that follow one another in a group."""
    for mark, some in groupby(zip(marks, items, strict=True), key=lambda one: one[0]):
        written = writer.written(tuple(item for _, item in some))
        yield "".join([f'<g class="{mark}">', *written, "</g>"]) if mark else "".join(written)


def inline_film(film: MovingDrawing, name: str) -> str:
    """Return a film as an SVG element that stands still until the page moves its parts."""
    return _element(film.ground, name, film.about, film_body(film, _written))


def _written(items: tuple[Item, ...], height: float) -> Iterator[str]:
    return _InlineWriter(height, {}).written(items)


def _element(drawing: Drawing, name: str, about: str, written: Iterable[str], size: str = "3") -> str:
    width, height = (_hundredths(round(100 * one)) for one in (drawing.width, drawing.height))
    told, place = html.escape(about), f'viewBox="0 0 {width} {height}" style="max-width:{width}mm"'
    head = f'<svg class="drawing" data-figure="{html.escape(name)}" {place} font-size="{size}" role="img"'
    # HTML asks for quotation marks only where a value has blanks or signs of its own
    return _QUOTED.sub(r"=\1", "".join([head, f' aria-label="{told}">', *written, "</svg>"]))


class _InlineWriter(SvgWriter):
    """Items in colours of the page, curves by what they are, points apart by hundredths of a millimetre."""

    _SPACES = _JOIN = ""
    _SLANTED = ' class="di"'

    def __init__(self, height: float, angles: Mapping[str, list[Array]], usual: str = "") -> None:
        super().__init__(height, look_of("print"))
        self._angles, self._kind, self._usual = angles, "", usual

    def _unseen(self, item: Polyline) -> float:
        return _UNSEEN if item.name else super()._unseen(item)

    def _line(self, item: Polyline) -> str:
        if not item.name:
            return super()._line(item)
        if item.fill is not None and item.name in _FILLED:
            return super()._line(item._replace(name="", kind=pen_of(item.kind)._replace(colour=f"var(--{item.name})")))
        kept = self._kept.get(id(item.points), np.ones(len(item.points), dtype=bool))
        # of a curve with gaps, those of its next part
        every, at = self._angles.get(item.name), ""
        angles = every.pop(0) if every else None
        if angles is not None and len(angles) == len(kept):
            kept = _with_places(kept, item.points, angles)
            at = f' data-at="{_apart(angles[kept])}"'
        d = self._steps(item.points[kept], closed=item.closed)
        self._kind = curve_kind(item)
        look, self._kind = self._drawn_as(item.kind, item.fill), ""
        return f'<path data-curve="{html.escape(item.name)}"{at} d="{d}"{look}/>'

    def _drawn_as(self, kind: LineKind | Pen, fill: float | None = None) -> str:
        pen = pen_of(kind)
        if fill in (0, 1) and not pen.width and not pen.colour:
            return ' class="db"' if fill else ' class="dd"'
        return super()._drawn_as(kind, fill)

    def _drawn(self, colour: str) -> str:
        if self._kind:
            return f' stroke="var(--{self._kind})"'
        # what has no colour of its own is drawn with ink
        return "" if colour == "var(--ink)" else f' stroke="{colour}"'

    def _text(self, item: Text) -> str:
        # letters stand well enough by tenths
        x, down = item.place[0], self._height - item.place[1]
        return super()._text(item._replace(place=(round(x, 1), self._height - round(down, 1))))

    def _lettered(self, item: Text) -> str:
        kinds = [*([f"d{item.anchor[0]}"] if item.anchor != "start" else []), *(["dh"] if item.halo else [])]
        look = f' class="{" ".join(kinds)}"' if kinds else ""
        # a rule of the style sheet says the colour of texts
        return look + (f' style="fill:{self._shade(item.grey)}"' if item.grey else "")

    def _sized(self, size: float) -> str:
        written = self._number(size)
        return "" if written == self._usual else f' font-size="{written}"'

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
    """Return what a page draws the frame of a graph anew by, in other scales."""
    return {key: plot.frame[key] for key in ("ticks", "labels", "powers")} if plot.frame else {}


def frame_marks(drawing: Drawing) -> list[str]:
    """Return marks by which a page finds the frames of graphs."""
    marks = [""] * len(drawing.items)
    for at, plot in enumerate(drawing.plots):
        if plot.frame:
            first, last = plot.frame["items"]
            marks[first:last] = [f"frame {at}"] * (last - first)
    return marks


def figure_data(drawing: Drawing) -> dict[str, Any]:
    """Return where the graphs of a drawing stand, downward as SVG counts [mm], and the curves of its legend by row."""
    lines = [one for one in drawing.items if isinstance(one, Polyline) and one.name]
    rows = [_look(one) for one in lines if one.name == "legend"]
    named = {one: dict.fromkeys(line.name for line in lines if _look(line) == one) for one in rows}
    legend = [[name for name in named[one] if name != "legend"] for one in rows]
    return {"plots": [_plot(one, drawing.height) for one in drawing.plots], "legend": legend}


def _look(line: Polyline) -> tuple[object, ...]:
    pen = pen_of(line.kind)
    return (*(round(one / pen.width, 2) for one in pen.dashes if pen.width), round(pen.width, 3), pen.colour)


def _plot(plot: Plot, height: float) -> dict[str, Any]:
    box = plot.box
    place = [round(one, 3) for one in (box.left, height - box.top, box.width, box.height)]
    titles = [html_text(plot.titles.get(one, "")) for one in ("x", "y")]
    return {"box": place, "x": list(map(float, plot.x)), "y": list(map(float, plot.y)), "over": plot.over, "t": titles}


def _hundredths(count: int) -> str:
    """Return hundredths as a short number."""
    whole, part = divmod(abs(count), 100)
    return f"{'-' if count < 0 else ''}{whole or ''}{f'.{part:02d}'.rstrip('0') if part else '' if whole else '0'}"


def _parted(count: int) -> str:
    """Return hundredths parted from the number before by their sign or a space."""
    return _hundredths(count) if count < 0 else f" {_hundredths(count)}"


def _with_places(kept: NDArray[np.bool_], points: Array, angles: Array) -> NDArray[np.bool_]:
    """Return which points are kept that those between stand at their angles too, for a dot that goes along."""
    while True:
        between = np.column_stack([np.interp(angles, angles[kept], one) for one in points[kept].T])
        apart = np.where(kept, 0.0, np.hypot(*(points - between).T))
        stretch = np.cumsum(kept) - 1
        farthest = np.maximum.reduceat(apart, np.flatnonzero(kept))[stretch]
        wanted = (apart == farthest) & (farthest > _MISPLACED)
        if not wanted.any():
            return kept
        kept = kept | wanted


def _apart(angles: Array) -> str:
    """Return angles as what each adds to the one before, to tenths of a degree; a to z are whole degrees up to 26."""
    steps = np.diff(np.rint(angles * 10).astype(int), prepend=0).tolist()
    told = (_LETTERS.get(one) or f" {one // 10 if one % 10 == 0 else str(one / 10).removeprefix('0')}" for one in steps)
    # only numbers stand apart from each other
    return re.sub("(?<=[a-z]) ", "", "".join(told)).strip()


_GREYS = "".join(f"--g{one}:color-mix(in srgb,var(--ground) {5 * one}%,var(--ink));" for one in range(1, 20))
# what is drawn once and used again knows no ancestors, so classes stand alone
STYLE = (
    f":root{{{_GREYS}}}.drawing{{fill:none;stroke:var(--ink);stroke-linejoin:round}}"
    ".drawing text{fill:var(--ink);stroke:none;white-space:pre}"
    ".dd{fill:var(--ink);stroke:none}.db{fill:var(--ground);stroke:none}"
    ".dm{text-anchor:middle}.de{text-anchor:end}.di{font-style:italic}"
    ".drawing .dh{stroke:var(--ground);stroke-width:.2em;paint-order:stroke}"
)


def colours(theme: Theme) -> str:
    """Return what the style sheet of a page says of a theme: ground, ink and the colours of curves."""
    look = look_of(theme)
    curves = "".join(f"--{kind}:{look.curves.get(kind, look.ink)};" for kind in KINDS)
    fills = "".join(f"--{name}:{colour};" for name, colour in fill_colours(theme).items())
    return f"--ground:{look.ground};--ink:{look.ink};{curves}{fills}"
