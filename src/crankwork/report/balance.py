"""Figures of balance: free forces and moments, their loci, masses in planes of a shaft; harmonics of the torque."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.load_diagrams import Locus
from crankwork.analysis.rotor_balance import polygons
from crankwork.locale import translate
from crankwork.report.look import Drawn
from crankwork.show.canvas import (
    BLACK,
    WIDER,
    Canvas,
    columns_of,
    current_layout,
    fitted_lines,
    scaled_height,
    text_width,
)
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, Row, legend, legend_height, round_ticks, small_text
from crankwork.show.label_placement import label_marks
from crankwork.show.scene import DASHED, SOLID

# between values of neighbouring bars [pt]
_BETWEEN = 5.0
# of the inertia force of a piston, what of free forces is told in words, and what is rounding
_HARDLY, _LEFT = 1e-3, 1e-9
# how wide a locus is, of its length, that is a line
_LINE = 1e-6
_SIDE, _GAP, _TITLE = 220.0, 66.0, 36.0
# with the symbols of the axes
_SUMS = {"plane_moment": "plane_moment", "plane_couple": "rotor_couple"}
# side of a phase star at most [pt]
_STAR_SIDE = 150.0


class Bars(NamedTuple):
    """Bars of one kind: name of the kind, and height by order."""

    kind: str
    heights: Mapping[float, float]


def _fill(paper: Canvas, corners: tuple[float, float, float, float], kind: int) -> None:
    """Draw a bar from left, top, right, bottom [pt]: white, hatched, grey, hatched back, black or hatched across."""
    left, top, right, bottom = corners
    fill = ("#ffffff", "#ffffff", "#b0b0b0", "#ffffff", BLACK, "#ffffff")[kind]
    paper.area([left, right, right, left], [top, top, bottom, bottom], fill=fill, width=0.45)
    for slope in {1: (1,), 3: (-1,), 5: (1, -1)}.get(kind, ()):
        width = right - left
        rise = np.arange(top - width + 3.5, bottom, 3.5)
        start, end = np.maximum(rise, top), np.minimum(rise + width, bottom)
        a, b = left + (start - rise), left + (end - rise)
        if slope < 0:
            a, b = right - (start - rise), right - (end - rise)
        paper.segments(np.column_stack([a, start, b, end]), width=0.45)


def bar_graph(
    engine: Drawn,
    paper: Canvas,
    box: ChartBox,
    bars: Sequence[Bars],
    orders: Sequence[float],
    fills: Sequence[int],
) -> Graph:
    """Draw groups of bars over the orders."""
    most = max((max(bar.heights.values(), default=0.0) for bar in bars), default=0.0) or 1.0
    top_end = (1.22 if len(orders) < 8 else 1.1) * most
    graph = Graph(paper, box, (0.0, float(len(orders))), (0.0, top_end), engine.language, to_scale=False)
    has_any = any(bar.heights and max(bar.heights.values()) for bar in bars)
    ticks = round_ticks(0.0, top_end, max(3, round(box.height / 26))) if has_any else np.zeros(1)
    graph.frame(np.array([]), ticks)
    for place, order in enumerate(orders):
        present = [index for index, bar in enumerate(bars) if order in bar.heights]
        width = 0.45 / max(len(bars), 1)
        start = place + 0.5 - width * len(present) / 2
        values = [engine.number(bars[which].heights[order], 4) for which in present]
        room = box.width / len(orders) * width - _BETWEEN
        is_upright = any(WIDER * text_width(value, 7.0) > room for value in values)
        for index, (which, text) in enumerate(zip(present, values, strict=True)):
            height = bars[which].heights[order]
            left, right = graph.across(start + index * width), graph.across(start + (index + 1) * width)
            top, bottom = graph.down(height), graph.down(0.0)
            if height > 0.002 * most:
                _fill(paper, (float(left), float(top), float(right), float(bottom)), fills[which])
                if len(orders) < 8:
                    _value(paper, float(left + right) / 2, float(top) - 3, text, is_upright=is_upright)
            elif len(orders) < 8:
                small_text(paper, float(left + right) / 2, float(bottom) - 2.5, "0")
        if len(orders) <= 12 or order == round(order):
            small_text(paper, float(graph.across(place + 0.5)), box.top + box.height + 11, engine.number(order))
    for bar in bars:
        graph.curves[bar.kind] = np.array(list(bar.heights)), np.array(list(bar.heights.values()))
    return graph


def _value(paper: Canvas, middle: float, bottom: float, text: str, *, is_upright: bool) -> None:
    """Write a value over its bar, upward where bars are narrower than their values."""
    if is_upright:
        paper.upward_text(middle + 2.5, bottom - WIDER * text_width(text, 7.0) / 2, text, size=7.0)
    else:
        paper.text(middle, bottom, text, size=7.0, anchor="middle")


def swatches(paper: Canvas, texts: Sequence[str], fills: Sequence[int]) -> None:
    """Write the legend of bars above the graph, on as many lines as they need."""
    for text, fill, (left, line) in zip(texts, fills, _swatch_places(texts), strict=True):
        top = TOP - 4 + 13.4 * line
        _fill(paper, (left, top + 1.5, left + 13, top + 9.5), fill)
        paper.text(left + 18, top + 9, text)


def _swatch_places(texts: Sequence[str]) -> list[tuple[float, int]]:
    """Return the left side of the entries of a legend of bars, and their lines. [pt]"""
    left, line, places = current_layout().left, 0, list[tuple[float, int]]()
    for width in (WIDER * text_width(text, 8.0) + 26 for text in texts):
        if left > current_layout().left and left + width > current_layout().width - 4:
            left, line = current_layout().left, line + 1
        places.append((left, line))
        left += width
    return places


def balance_orders(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return free forces and moments per order: of each kind of mass, and what is left of all together."""
    balance, language = engine.diagrams.balance, engine.language
    kinds = {
        "reciprocating": balance.reciprocating,
        "rotating": (balance.rotating,),
        "counterweights": (balance.counterweights,) if balance.weights else (),
        "balance_shafts": balance.shafts,
        "knuckle_pins": balance.knuckles,
        "residual": balance.residual,
    }
    kinds = {name: parts for name, parts in kinds.items() if parts}
    order = ["reciprocating", "rotating", "balance_shafts", "counterweights", "residual", "knuckle_pins"]
    fills = [order.index(kind) for kind in kinds]
    sizes = {
        panel: {
            kind: {float(part.order): getattr(part, panel).largest for part in parts} for kind, parts in kinds.items()
        }
        for panel in (("force", "moment") if engine.diagrams.is_spread else ("force",))
    }
    most = {
        key: max((max(heights.values(), default=0.0) for heights in sizes[key].values()), default=0.0) for key in sizes
    }
    panels = [panel for panel in sizes if most[panel] > _free(engine, panel)] or ["force"]
    # of what has no bar nothing is told
    seen = [kind for kind in kinds if any(max(sizes[panel][kind].values()) > 0.002 * most[panel] for panel in panels)]
    texts = [translate(f"report.{kind}", language) for kind in seen or kinds]
    head = 13.4 * (1 + _swatch_places(texts)[-1][1] + len(sizes) - len(panels)) + 5
    height = scaled_height(150.0)
    paper = Canvas(current_layout().width, TOP + head + len(panels) * height + (len(panels) - 1) * 28 + BOTTOM)
    swatches(paper, texts, [order.index(kind) for kind in seen or kinds])
    for panel in (panel for panel in sizes if panel not in panels):
        key = f"free_{panel}"
        # of forces that cancel rounding is left
        size = f"≤ {engine.value(key, most[panel])}" if most[panel] > _LEFT * _inertia(engine) else "= 0"
        free = f"{translate(f'drawing.{key}', language)} {engine.symbol(key)}"
        text = translate("drawing.hardly_free", language, free=free, size=size)
        paper.text(current_layout().left, TOP + head - 9.4, text)
    orders = [float(part.order) for part in balance.reciprocating]
    graphs: dict[str, Graph] = {}
    for index, panel in enumerate(panels):
        key = f"free_{panel}"
        bars = [
            Bars(kind, {order: float(engine.shown(key, value)) for order, value in heights.items()})
            for kind, heights in sizes[panel].items()
        ]
        box = ChartBox(current_layout().left, TOP + head + index * (height + 28), current_layout().inner, height)
        graphs[panel] = bar_graph(engine, paper, box, bars, orders, fills)
        graphs[panel].y_title(f"{translate(f'drawing.{key}', language)} {engine.symbol(key)}, {engine.unit(key)}")
    graphs[panels[-1]].x_title(translate("report.order", language, order="$q$"))
    return paper, graphs


def _inertia(engine: Drawn) -> float:
    """Return the largest inertia force of one piston. [N]"""
    return float(np.max(np.abs(engine.columns["inertia_force"])))


def _free(engine: Drawn, panel: str) -> float:
    """Return the least free force that is drawn, or moment, taken as a force at a metre. [N], [N m]"""
    return (_HARDLY if panel == "force" else _LEFT) * _inertia(engine)


def curved_loci(engine: Drawn) -> dict[int, tuple[Locus, Locus]]:
    """Return the loci of the free forces that are curves; a force to and fro along a line is a number of its order."""
    return {order: pair for order, pair in engine.diagrams.loci.items() if not all(map(_is_line, pair))}


def _is_line(locus: Locus) -> bool:
    sizes = np.linalg.svd(np.column_stack([locus.across, locus.up]), compute_uv=False)
    return bool(sizes[1] <= _LINE * sizes[0])


def balance_ellipses(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the closed curves in which the free forces of each order run, before and after balancing."""
    loci, language = curved_loci(engine), engine.language
    is_balanced = bool(engine.diagrams.balance.weights or engine.diagrams.balance.shafts)
    styles = {"before": DASHED, "after": SOLID} if is_balanced else {}
    rows = [Row(translate(f"drawing.{name}", language), style) for name, style in styles.items()]
    columns = 2 if len(loci) > 1 else 1
    lines = -(-len(loci) // columns)
    side, gap = (scaled_height(170.0), 56.0) if columns == 2 else (scaled_height(240.0), 0.0)
    head = legend_height(rows) + 12
    start = (current_layout().width - columns * side - (columns - 1) * gap) / 2 + 16
    paper = Canvas(current_layout().width, TOP + head + lines * side + (lines - 1) * 52 + BOTTOM)
    # one for all graphs
    legend(paper, rows, TOP - 4)
    graphs: dict[str, Graph] = {}
    for index, (order, (before, after)) in enumerate(loci.items()):
        box = ChartBox(
            start + (index % columns) * (side + gap), TOP + head + (index // columns) * (side + 52), side, side
        )
        graphs[str(order)] = _locus(engine, paper, box, before, after, is_balanced=is_balanced)
        small_text(paper, box.left + side / 2, box.top - 5, translate("report.order", language, order=order))
        title = f"{engine.symbol('free_force')}, {engine.unit('free_force')}"
        graphs[str(order)].x_title(title)
        if not index % columns:
            graphs[str(order)].y_title(title, 30.0)
    return paper, graphs


def _locus(engine: Drawn, paper: Canvas, box: ChartBox, before: Locus, after: Locus, *, is_balanced: bool) -> Graph:
    """Draw the loci of one order, the reference direction of the engine upward."""
    reach = 1.15 * float(engine.shown("free_force", max(before.largest, after.largest)))
    graph = Graph(paper, box, (-reach, reach), (-reach, reach), engine.language)
    box, ticks = graph.box, round_ticks(-reach, reach, min(5, max(1, round(graph.box.height / 32))))
    graph.frame(ticks, ticks)
    middle = graph.point(0.0, 0.0)
    paper.segments(np.array([(middle[0], box.top, middle[0], box.top + box.height)]), width=0.45)
    drawn = [("before", before, DASHED if is_balanced else SOLID)] + ([("after", after, SOLID)] if is_balanced else [])
    for name, locus, style in drawn:
        across, up = engine.shown("free_force", locus.across), engine.shown("free_force", locus.up)
        graph.curve(name, across, up, style)
        if locus.largest > 1e-3 * max(before.largest, after.largest):
            end = graph.point(float(across[0]), float(up[0]))
            paper.arrow(middle, end, width=0.9)
        else:
            paper.dot(*middle, 2.2)
    return graph


def has_polygons(machine: Drawn) -> bool:
    """Return whether masses on a shaft form polygons."""
    return "planes" in machine.results.listings


def balance_polygons(machine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the directions of the masses, the polygon of their moments, and that of the couples of the moments."""
    drawn = polygons(machine.results)
    star = np.array(drawn["plane_moment"][1])
    panels: dict[str, tuple[str, tuple[str, ...], Array, Array]] = {
        "directions": ("plane_moment", drawn["plane_moment"][0], np.zeros((len(star) - 1, 2)), np.diff(star, axis=0)),
        **{kind: (kind, names, ends[:-1], ends[1:]) for kind, (names, ends) in drawn.items()},
    }
    columns = columns_of(2)
    side = min((current_layout().inner - (columns - 1) * _GAP) / columns, scaled_height(_SIDE))
    lines = -(-len(panels) // columns)
    paper, graphs = Canvas(current_layout().width, TOP + lines * (side + _TITLE) + BOTTOM - _TITLE), dict[str, Graph]()
    for index, (name, (kind, sides, starts, ends)) in enumerate(panels.items()):
        left = current_layout().left + (index % columns) * (side + _GAP)
        box = ChartBox(left, TOP + (index // columns) * (side + _TITLE), side, side)
        graphs[name] = _polygon(machine, paper, box, kind, sides, starts, ends)
    return paper, graphs


def _polygon(  # noqa: PLR0913 - where, what of, and its sides
    machine: Drawn, paper: Canvas, box: ChartBox, kind: str, names: tuple[str, ...], starts: Array, ends: Array
) -> Graph:
    """Draw vectors by their ends, each with its name beside it, in equal scales."""
    shown = machine.shown(kind, np.concatenate([starts, ends]))
    middle, reach = (shown.max(axis=0) + shown.min(axis=0)) / 2, 0.62 * float(np.ptp(shown, axis=0).max())
    x, y = ((float(value) - reach, float(value) + reach) for value in middle)
    graph = Graph(paper, box, x, y, machine.language)
    graph.frame(round_ticks(*x, 4), round_ticks(*y, 4))
    first, last = shown[: len(names)], shown[len(names) :]
    marks = []
    for name, start, end in zip(names, first, last, strict=True):
        tail, head = graph.point(*start.tolist()), graph.point(*end.tolist())
        paper.arrow(tail, head)
        marks.append((name, (tail[0] + head[0]) / 2, (tail[1] + head[1]) / 2))
    label_marks(paper, marks, dot=0.0, frame=box)
    graph.curves[kind] = last[:, 0], last[:, 1]
    for axis, write in (("x", graph.x_title), ("y", graph.y_title)):
        write(f"{machine.symbol(f'{_SUMS[kind]}_{axis}')}, {machine.unit(kind)}")
    return graph


def torque_harmonics(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the amplitudes of the harmonics of the torque as bars over the orders, of one cylinder and of all."""
    columns = engine.results.listings["torque_harmonics"].columns
    orders = columns["harmonic_order"].tolist()
    kinds = {"one_cylinder": "harmonic_amplitude", "all_cylinders": "total_harmonic_amplitude"}
    if engine.cylinders == 1:
        kinds.pop("all_cylinders")
    kinds = {name: key for name, key in kinds.items() if key in columns}
    bars = [
        Bars(name, dict(zip(orders, engine.shown(key, columns[key]).tolist(), strict=True)))
        for name, key in kinds.items()
    ]
    texts = [f"{engine.symbol(key)} – {translate(f'drawing.{name}', engine.language)}" for name, key in kinds.items()]
    height, is_alone = scaled_height(200.0), len(kinds) == 1
    paper = Canvas(current_layout().width, TOP + 19 + height + BOTTOM)
    swatches(paper, [] if is_alone else texts, [] if is_alone else [0, 4])
    graph = bar_graph(
        engine,
        paper,
        ChartBox(current_layout().left, TOP + 19, current_layout().inner, height),
        bars,
        orders,
        [0, 4],
    )
    graph.x_title(engine.title("harmonic_order"))
    symbols = ", ".join(engine.symbol(key) for key in kinds.values())
    shown = f"{symbols}, {engine.unit('harmonic_amplitude')}"
    graph.y_title(engine.title(*kinds.values()) if is_alone else shown)
    return paper, {"torque_harmonics": graph}


def phase_stars(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the phase stars of the orders up to 6, all unit vectors of one length, with the mean of each."""
    stars = engine.diagrams.phase_stars
    columns = columns_of(4 if len(stars) > 6 else 3)
    lines = -(-len(stars) // columns)
    side, gap, head = min((current_layout().width - 24) / columns - 8, scaled_height(_STAR_SIDE)), 8.0, 14.0
    left = (current_layout().width - columns * (side + gap) + gap) / 2
    paper = Canvas(current_layout().width, TOP + lines * (side + head) + 30)
    graphs: dict[str, Graph] = {}
    for k, star in enumerate(stars):
        box = ChartBox(left + (k % columns) * (side + gap), TOP + head + (k // columns) * (side + head), side, side)
        order = engine.number(star.order)
        graphs[order] = _star(paper, box, star.vectors.tolist(), star.sum, engine)
        text = f"$ν$ = {order}  ({engine.number(round(abs(star.sum), 9), 3)})"
        small_text(paper, box.left + side / 2, box.top - 3, text)
    foot = fitted_lines(translate("drawing.star_sum", engine.language), 8.0, current_layout().width / WIDER)
    paper.height += 10.0 * (len(foot) - 1)
    for count, text in enumerate(reversed(foot)):
        paper.text(current_layout().width / 2, paper.height - 18 - 10 * count, text, anchor="middle")
    return paper, graphs


def _star(paper: Canvas, box: ChartBox, vectors: Sequence[complex], total: complex, engine: Drawn) -> Graph:
    """Draw one phase star, its reference direction upward and angles with the rotation, clockwise."""
    directions: dict[tuple[float, float], list[int]] = {}
    for number, vector in enumerate(vectors, start=1):
        directions.setdefault((round(vector.real, 6) + 0.0, round(vector.imag, 6) + 0.0), []).append(number)
    # the mean has full length where all cylinders agree
    total /= len(vectors)
    reach = 1 + 22 / (box.width / 2 - 22)
    graph = Graph(paper, box, (-reach, reach), (-reach, reach), engine.language, to_scale=False)
    middle = graph.point(0.0, 0.0)
    if abs(total) > 1e-9:
        # a band, on which the unit vectors are seen
        band = 2.5 * np.array([total.real, total.imag]) / abs(total)
        ends_of_band = np.array([middle, graph.point(total.imag, total.real)]).repeat(2, axis=0)
        paper.area(*(ends_of_band + np.outer([1, -1, -1, 1], band)).T, fill="#c8c8c8")
    graph.curves["mean"] = np.array([total.imag]), np.array([total.real])
    ends = []
    for (up, across), numbers in directions.items():
        end = graph.point(across, up)
        paper.arrow(middle, end, width=0.45)
        ends.append((",".join(str(number) for number in numbers), *end))
    paper.dot(*middle, 1.6)
    label_marks(paper, ends, size=7.0, dot=0.0)
    up, across = np.array(list(directions)).T
    graph.curves["ends"] = across, up
    return graph
