"""The figures of the harmonics of the torque: amplitudes by order, and phase stars."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.locale import translate
from crankwork.report.balance import Bars, bar_graph, swatches
from crankwork.report.look import Drawn
from crankwork.show.canvas import WIDER, Canvas, fitted_lines
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, small_text
from crankwork.show.chart_layout import columns_of, current_layout, scaled_height
from crankwork.show.label_placement import label_marks

# side of a phase star at most [pt]
_SIDE = 150.0


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
    side, gap, head = min((current_layout().width - 24) / columns - 8, scaled_height(_SIDE)), 8.0, 14.0
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
