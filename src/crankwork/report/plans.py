"""Velocity and acceleration plans as figures: vectors from the pole to scale, and what each of them is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.sampled_motion import SampledMotion
from crankwork.analysis.vector_polygons import Kind, Vector, VectorPolygon, accelerations, velocities
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities import Language
from crankwork.report.display import symbol
from crankwork.report.look import (
    PLAIN,
    Style,
    draw_scale,
    figure_title,
    key_of_links,
    math_symbol,
    position_sign,
    position_text,
    scale_text,
)
from crankwork.show.canvas import WIDER, Canvas, plain, text_width
from crankwork.show.chart import ChartBox, Graph, write_remark
from crankwork.show.chart_layout import FINE, current_layout, is_narrow, points_per_mm, round_scale, scaled_height
from crankwork.show.label_placement import label_points
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, Drawing
from crankwork.show.scene import Style as Dashes

_TALL, _MARGIN, _LIST_WIDTH, _LIST, _ROW = 330.0, 26.0, 170.8, 150.0, 13.5
# height of a plan at least, and how many points that lie beneath others are explained
_LOWEST, _UNDER = 40.0, 3
# a linkage whose points have velocities or accelerations a billionth of this stands still
_STILL = 1e-3
# a plan smaller than this has a scale of its own [mm]
_READ = 15.0
_LOOKS: dict[Kind, tuple[float, Dashes]] = {
    "absolute": (0.9, SOLID), "relative": (0.45, SOLID), "tangential": (0.45, SOLID), "sliding": (0.45, SOLID),
    "normal": (0.45, DASHED), "coriolis": (0.45, DASH_DOT),
}  # fmt: skip
_MARKS: dict[Kind, str] = {
    "absolute": "", "relative": "", "normal": "^n", "tangential": "^{}", "coriolis": "^k", "sliding": "^r"
}  # fmt: skip


Size = tuple[float, float]


class _Kind(NamedTuple):
    """Velocities or accelerations: title, symbol, unit, symbol and unit of turning, pole, size of turning."""

    title: str
    sign: str
    unit: str
    turning: str
    turning_unit: str
    pole: str
    size: float


def velocity_plan(  # noqa: PLR0913 - a machine, its state, and how it is shown
    mechanism: Mechanism,
    moving: SampledMotion,
    index: int,
    speed: float,
    style: Style = PLAIN,
    position: int | None = None,
    among: Sequence[Size] = (),
) -> Drawing:
    """Return the velocity plan of a linkage at one crank angle; `position`: its number among others of these sizes."""
    kind = _Kind("velocity_plan", "v", "m/s", symbol("speed", style.language), "rad/s", "p", abs(speed))
    plan = velocities(mechanism, moving, index, speed, style.links)
    return _figure(plan, kind, moving.degrees[index], style, position, among)


def acceleration_plan(  # noqa: PLR0913 - a machine, its state, and how it is shown
    mechanism: Mechanism,
    moving: SampledMotion,
    index: int,
    speed: float,
    angular_acceleration: float = 0.0,
    style: Style = PLAIN,
    position: int | None = None,
    among: Sequence[Size] = (),
) -> Drawing:
    """Return the acceleration plan of a linkage at one crank angle; `position`: its number among others as large."""
    plan = accelerations(mechanism, moving, index, speed, angular_acceleration, style.links)
    pole = "q" if style.language == "en" else "π"
    kind = _Kind(
        "acceleration_plan", "a", "m/s2", symbol("angular_acceleration", style.language), "rad/s2", pole, speed**2
    )
    return _figure(plan, kind, moving.degrees[index], style, position, among)


def size_of(plan: VectorPolygon) -> Size:
    """Return width and height of a plan, in its unit."""
    width, height = np.ptp(_places(_seen(plan)), axis=0)
    return float(width), float(height)


def _longest(plan: VectorPolygon) -> float:
    return max((vector.length for vector in plan.vectors), default=0.0)


def _seen(plan: VectorPolygon) -> list[Vector]:
    """Return the vectors above rounding noise."""
    least = 1e-9 * max(_longest(plan), _STILL)
    return [vector for vector in plan.vectors if vector.length > least]


def _places(vectors: list[Vector]) -> Array:
    """Return the pole and the ends of vectors, shape (places, 2)."""
    return np.array([[0.0, 0.0], *(end for vector in vectors for end in (vector.start, vector.end))])


def _scale(size: Size, among: Sequence[Size], room: tuple[float, float]) -> float:
    """Return the scale of a plan: that of all, unless it would be too small to be read. [its unit/mm]"""
    scales = [
        round_scale(points_per_mm() * max(wide_high[0] / room[0], wide_high[1] / room[1], 1e-12), FINE)
        for wide_high in (size, *among)
    ]
    return max(scales) if max(size) / max(scales) > _READ else scales[0]


def _figure(
    plan: VectorPolygon, kind: _Kind, degrees: float, style: Style, position: int | None, among: Sequence[Size]
) -> Drawing:
    """Draw a plan, and beside it the values of its vectors and the angular rates of the links."""
    language, seen, size = style.language, _seen(plan), size_of(plan)
    # only beside one plan there is room for a list
    has_list = position is None and not is_narrow()
    side = current_layout().width - (_LIST_WIDTH if has_list else 0.0)
    rows = [] if position is not None else [*_rows(seen, plan, kind, language), *_link_names(style, plan)]
    # long names stand beside the outermost ends, those of one end together
    ends: dict[tuple[float, ...], str] = {}
    for name, node in plan.nodes.items():
        place = tuple(np.round(node / max(_longest(plan), 1e-12), 3).tolist())
        ends[place] = f"{ends[place]}, {node_name(name)}" if place in ends else node_name(name)
    margin = max([_MARGIN, *(WIDER * text_width(plain(text), 8.0) + 12 for text in ends.values())])
    listed = _ROW * len(rows) if has_list else 0.0
    high = max(scaled_height(_TALL), listed)
    room = side - 2 * min(margin, side / 8), max(high - 2 * _MARGIN, _LOWEST)
    scale = _scale(size, among, room)
    unit = points_per_mm() / scale
    high = max(max(size[1], 1e-12) * unit + 2 * _MARGIN, listed + 30) + 34
    # in two columns where it stands below
    below = 0.0 if has_list else _ROW * -(-len(rows) // 2)
    paper = Canvas(current_layout().width, high + below)
    places = _places(seen)
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    left, bottom = middle[0] - side / 2 / unit, middle[1] - (high + 34) / 2 / unit
    x, y = (left, left + current_layout().width / unit), (bottom, bottom + high / unit)
    graph = Graph(paper, ChartBox(0.0, 0.0, current_layout().width, high), x, y, language, to_scale=False)
    draw_vectors(graph, seen, unit)
    for count, row in enumerate(rows):
        left, top = (current_layout().width - _LIST, 23 + _ROW * count) if has_list else (
            14 + count % 2 * current_layout().width / 2, high - 6 + _ROW * (count // 2)
        )  # fmt: skip
        paper.text(left, top, row)
    if position is not None:
        scale_shown = scale_text(f"μ_{kind.sign}", scale, kind.unit, language) if seen else f"${kind.sign}$ = 0"
        shown = f"{translate('sheets.position', language)} {position}: {scale_shown}"
        paper.text(current_layout().width / 2, high - 20, shown, anchor="middle")
    else:
        draw_scale(paper, (14, high - 20), (f"μ_{kind.sign}", scale, kind.unit), language)
        shown = f"{position_sign(style)} = {position_text(float(degrees), style)}"
        paper.text(current_layout().width - 14, high - 20, shown, anchor="end")
        write_remark(paper, _remark(plan, kind, language))
    _nodes(graph, plan, kind.pole, unit)
    return paper.drawing(f"{figure_title(kind.title, language)}, {position_text(float(degrees), style)}", language)


def _link_names(style: Style, plan: VectorPolygon) -> list[str]:
    return key_of_links(dict(enumerate(style.links, start=1)), plan.turning, style.language)


def _remark(plan: VectorPolygon, kind: _Kind, language: Language) -> str:
    """Return the meaning of the sign of turning, and of points with the number of a link."""
    remarks = [translate("drawing.anticlockwise", language, symbol=kind.turning)]
    if plan.coincident:
        named_points = list(plan.coincident.items())[:_UNDER]
        points, links = (plain(name) for name, _ in named_points), (str(link) for _, (link, _) in named_points)
        link_points = (plain(point) for _, (_, point) in named_points)
        joined = {"points": ", ".join(points), "links": ", ".join(links), "others": ", ".join(link_points)}
        remarks.append(
            translate("drawing.beneath" if len(named_points) > 1 else "drawing.one_beneath", language, **joined)
        )
    return "; ".join(remarks)


def draw_vectors(graph: Graph, vectors: list[Vector], unit: float, widest: float = 0.9) -> None:
    """Draw the vectors of a plan; `unit`: points of the paper in its unit; `widest`: line. [pt]"""
    for vector in vectors:
        width, line = _LOOKS[vector.kind]
        start, end = (graph.point(*place) for place in (vector.start, vector.end))
        if vector.length * unit > 6:
            graph.paper.arrow(start, end, width=min(width, widest), style=line)
        else:
            graph.paper.line([start[0], end[0]], [start[1], end[1]], width=min(width, widest), style=line)


def _nodes(graph: Graph, plan: VectorPolygon, pole: str, unit: float) -> None:
    """Name the pole and the ends of the vectors."""
    taken = {node_name(name) for name in plan.nodes}
    points = [(next(letter for letter in (pole, "o", f"{pole}₀") if letter not in taken), 0.0, 0.0)]
    points += [(node_name(name), float(node[0]), float(node[1])) for name, node in plan.nodes.items()
               if np.hypot(*node) * unit > 1.0]  # fmt: skip
    label_points(graph, points)


def node_name(letter: str) -> str:
    """Return the letter of the end of a vector: that of its point, small."""
    return letter[0].lower() + letter[1:] if len(letter) <= 3 else letter


def _rows(vectors: list[Vector], plan: VectorPolygon, kind: _Kind, language: Language) -> list[str]:
    """Return the magnitudes of the vectors and the turning of the links."""
    rows, unit = [], unit_name(kind.unit, language)
    for vector in vectors:
        mark = vector_mark(vector.kind, language) if kind.sign == "a" else ""
        name = math_symbol(f"{kind.sign}_{vector.name}", mark)
        rows.append(f"{name} = {_four_digits(vector.length, language)} {unit}")
    unit = unit_name(kind.turning_unit, language)
    for link, value in plan.turning.items():
        if abs(value) > 1e-9 * max(kind.size, *(abs(rate) for rate in plan.turning.values())):
            name = math_symbol(f"{kind.turning}_{link}")
            rows.append(f"{name} = {_four_digits(value, language)} {unit}")
    return rows


def vector_mark(kind: Kind, language: Language) -> str:
    """Return what stands over the symbol of an acceleration of a kind: `^n` of a normal one."""
    return _MARKS[kind].format(translate("marks.tangential", language))


def _four_digits(value: float, language: Language) -> str:
    """Return a value to four digits, without a power of ten if it has no more than six."""
    return number(float(f"{value:.4g}"), language)
