"""The polar diagrams of the bearing loads, and the load of the crankpin over the crank angle."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Self

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.bearings import CrankpinLoad, PolarDiagram, WearRing, wear_rings
from crankwork.analysis.load_diagrams import crankpin_of_one
from crankwork.analysis.results import Listing
from crankwork.locale import translate
from crankwork.report.look import Drawn
from crankwork.show.canvas import (
    GREY,
    WIDER,
    Canvas,
    columns_of,
    current_layout,
    fitted_lines,
    is_narrow,
    scaled_height,
)
from crankwork.show.chart import (
    ARROW,
    BOTTOM,
    CIRCLE,
    TOP,
    ChartBox,
    Graph,
    Row,
    limits,
    over_cycle,
    round_ticks,
    sheet,
    small_text,
)
from crankwork.show.label_placement import label_marks, mark_point
from crankwork.show.scene import DASH_DOT, DASHED, STYLES

_HEIGHT, _MARGIN, _LOWEST = 340.0, 1.12, 0.55
# rays and circle of the mean of a polar diagram, and what is as narrow as a stick
_RAYS, _RAY, _MEAN, _STICK = 30.0, "#8c8c8c", 0.45, 0.12
# marks nearer than this to another one have no number [pt]
_CROWDED = 10.0
# what numbers and title take beside polar diagrams of main journals [pt]
_LEFT_MARGIN = 60.0
# the side of one at most, of several at least [pt]
_SIDE, _SMALLEST = 320.0, 72.0


class _OverCycle(NamedTuple):
    """Mean and extremes of a load and where they are. [N], [deg]"""

    mean: float
    max: float
    max_angle: float
    min: float
    min_angle: float

    @classmethod
    def read(cls, listing: Listing, name: str) -> Self:
        """Return the row of a bearing."""
        row = listing.names.index(name)
        mean, *ends = (
            float(listing.columns[key][row]) for key in ("mean_bearing_load", "bearing_load_max", "bearing_load_min")
        )
        angles = (float(np.degrees(listing.columns[f"bearing_load_{end}_angle"][row])) for end in ("max", "min"))
        return cls(mean, *(value for pair in zip(ends, angles, strict=True) for value in pair))


def crankpin_polar(engine: Drawn, pin: str) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the load of all rods on a crankpin: tangential to the right, radial downward, seen from its pole."""
    return _pin_polar(engine, engine.bearings.crankpin(pin), engine.row("crankpin", pin))


def _pin_polar(engine: Drawn, load: CrankpinLoad, pin: str = "crankpin") -> tuple[Canvas, Mapping[str, Graph]]:
    """Draw the polar diagram of a crankpin with the inertia force of its rods from its pole."""
    rods, inertia = load.rods, load.inertia
    count = f"{rods} " if rods > 1 else ""
    pole = translate("drawing.pole_rods" if rods > 1 else "drawing.pole", engine.language)
    rows = [Row(f"O – {pole}", CIRCLE),
            Row(f"{count}{engine.stated('big_end_inertia_force', -inertia)}", ARROW)]  # fmt: skip
    titles = (
        f"{engine.symbol('tangential_force')}, {engine.unit('tangential_force')}",
        f"{engine.symbol('radial_force')}, {engine.unit('radial_force')}",
    )
    return _polar(engine, "crankpin_load", load.polar, rows if inertia else [], titles, pin)


def crankpin_polar_of_one(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the load of the one rod of a crank gear on its crankpin, from the columns of the results."""
    return _pin_polar(engine, crankpin_of_one(engine.results, engine.degrees, engine.columns))


def big_end_polar(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the load of the crankpin on the big-end bearing, in the frame of the rod."""
    return _rod_polar(engine, "big_end_load")


def small_end_polar(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the load of the piston pin on the small-end bearing, in the frame of the rod."""
    return _rod_polar(engine, "small_end_load")


def _rod_polar(engine: Drawn, key: str) -> tuple[Canvas, Mapping[str, Graph]]:
    unit = engine.unit(key)
    titles = (
        f"{engine.symbol(key)} {translate('drawing.across_rod', engine.language)}, {unit}",
        f"{engine.symbol(key)} {translate('drawing.along_rod', engine.language)}, {unit}",
    )
    return _polar(engine, key, engine.bearings.rod_ends[key.removesuffix("_load")], [], titles)


def _polar(
    engine: Drawn,
    key: str,
    diagram: PolarDiagram,
    rows: list[Row],
    titles: tuple[str, str],
    pin: str = "",
) -> tuple[Canvas, Mapping[str, Graph]]:
    """Draw a polar diagram with its pole, the rays from it, and a circle of the mean load.

    `pin`: the row of a crankpin among the loads of bearings. Scales are equal, but for a diagram that would be a stick.
    """
    across, down = (
        np.append(column, column[0]) for column in (engine.shown(key, diagram.across), engine.shown(key, diagram.down))
    )
    pole = tuple(float(coordinate) for coordinate in engine.shown(key, np.array(diagram.pole)))
    # along the rod is upward, not downward
    sign = 1.0 if pin else -1.0
    mean, wide = _mean(engine, pin or key.removesuffix("_load")), _wider(float(np.ptp(across)), float(np.ptp(down)))
    rows = [Row(engine.named(key)), *rows]
    if mean:
        # that of a crankpin has a name of its own
        mean_key = "mean_crankpin_load" if pin else "mean_bearing_load"
        rows = [*rows, Row(engine.stated(mean_key, mean), DASHED, _MEAN if wide == 1 else 0.0)]
    if wide > 1:
        rows = [*rows, Row(translate("drawing.wider_across", engine.language, factor=wide), width=0.0)]
    if is_narrow():
        # the title names the curve, and a list the symbols
        rows = [row._replace(text=row.text.partition(" – ")[0] if "=" in row.text else row.text) for row in rows[1:]]
    # marks cannot be distinguished on a lower diagram
    paper, box = sheet(_HEIGHT * max(1.0, _LOWEST / current_layout().tall), rows)
    # a circle where scales are equal, which would be an ellipse elsewhere
    radius = float(engine.shown(key, mean)) if wide == 1 else 0.0
    ends = np.array([0.0, *(coordinate + side * radius for coordinate in pole for side in (-1.0, 1.0))])
    box, x, y = _equal_scales(box, wide * np.append(across, ends[:3]), np.append(down, ends[[0, 3, 4]]))
    x = x[0] / wide, x[1] / wide
    graph = Graph(paper, box, x, (sign * y[0], sign * y[1]), engine.language)
    box = graph.box
    graph.frame(round_ticks(*x, min(7, round(box.width / 45))), round_ticks(min(graph.y), max(graph.y), 7))
    origin = graph.point(0.0, 0.0)
    paper.segments(np.array([(origin[0], box.top, origin[0], box.top + box.height)]), width=0.45)
    graph.curve("load", across, sign * down, angles=np.append(diagram.degrees, engine.cycle))
    graph.curves["pole"] = np.array([pole[0]]), sign * np.array([pole[1]])
    pole_on_paper = graph.point(pole[0], sign * pole[1])
    if pole[1]:
        paper.arrow(pole_on_paper, origin, width=0.9)
    marked = engine.shown(key, diagram.marks_across), sign * engine.shown(key, diagram.marks_down)
    kept = _spaced_marks(graph, diagram.marks, marked)
    marks, marked = diagram.marks[kept], (marked[0][kept], marked[1][kept])
    graph.curves["marks"] = marked
    _rays(graph, pole_on_paper, [coordinates[marks % _RAYS == 0] for coordinates in marked])
    if radius:
        around = np.radians(np.arange(0.0, 361.0, 3.0))
        circle = pole[0] + radius * np.sin(around), sign * pole[1] + radius * np.cos(around)
        graph.curve("mean", *circle, DASHED, width=_MEAN)
    places = zip(marks, graph.across(marked[0]), graph.down(marked[1]), strict=True)
    names = [("O", *pole_on_paper), *((f"{angle:g}", float(a), float(b)) for angle, a, b in places)]
    graph.x_title(titles[0])
    graph.y_title(titles[1], 48.0)
    label_marks(paper, names, frame=graph.box)
    paper.dot(*pole_on_paper, 2.6, fill="#ffffff", width=0.9)
    return paper, {key: graph}


def _mean(engine: Drawn, name: str) -> float:
    """Return the mean load of a bearing; nothing of one that no listing has. [N]"""
    listing = engine.results.listings.get("bearing_loads")
    if listing is None or name not in listing.names:
        return 0.0
    return _OverCycle.read(listing, name).mean


def _spaced_marks(graph: Graph, angles: Array, places: tuple[Array, Array]) -> list[int]:
    """Return the marks with room for their numbers, those at quarters of a turn first, then at its twelfths."""
    order = sorted(range(len(angles)), key=lambda k: (angles[k] % 90 > 0, angles[k] % _RAYS > 0, angles[k]))
    on_paper, kept = np.column_stack([graph.across(places[0]), graph.down(places[1])]), list[int]()
    for index in order:
        if not kept or np.hypot(*(on_paper[kept] - on_paper[index]).T).min() > _CROWDED:
            kept.append(index)
    return sorted(kept)


def _rays(graph: Graph, pole: tuple[float, float], ends: Sequence[Array]) -> None:
    """Draw a ray from the pole to every mark."""
    x, y = graph.across(ends[0]), graph.down(ends[1])
    graph.paper.segments(np.column_stack([np.full_like(x, pole[0]), np.full_like(y, pole[1]), x, y]), width=0.45,
                         colour=_RAY)  # fmt: skip


def _wider(across: float, along: float) -> int:
    """Return the factor by which a diagram is drawn wider, 1 unless it would be very narrow."""
    share = across / along if along else 1.0
    # on a sheet both scales are round only where one is ten times the other
    factors = (10,) if current_layout().is_sheet else (50, 20, 10, 5)
    return 1 if share > _STICK else next((factor for factor in factors if factor * share <= 0.8), factors[-1])


def _equal_scales(box: ChartBox, x: Array, y: Array) -> tuple[ChartBox, tuple[float, float], tuple[float, float]]:
    """Return a box, and ends of the scales that hold the points in it, equal both ways, the vertical one downward."""
    middle = (float(x.min()) + float(x.max())) / 2, (float(y.min()) + float(y.max())) / 2
    wide, high = float(np.ptp(x)) / box.width, float(np.ptp(y)) / box.height
    scale = _MARGIN * max(wide, high) or 1.0
    if current_layout().is_sheet:
        # of paper beside it other figures have the use
        most = max(wide, high, 1e-30)
        width, height = box.width * wide / most, box.height * high / most
        width, height = max(width, 0.3 * height), max(height, 0.3 * width)
        box = box._replace(left=box.left + (box.width - width) / 2, width=width, height=height)
    half = scale * box.width / 2, scale * box.height / 2
    return box, (middle[0] - half[0], middle[0] + half[0]), (middle[1] + half[1], middle[1] - half[1])


def crankpin_load(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the size of the load on every unlike crankpin over the crank angle, mean and extremes of the first."""
    degrees, loads = engine.bearings.pin_sizes
    sizes = {pin: engine.shown("crankpin_load", size) for pin, size in loads.items()}
    first = next(iter(sizes))
    extremes = _OverCycle.read(engine.results.listings["bearing_loads"], engine.row("crankpin", first))
    styles = dict(zip(sizes, itertools.cycle(STYLES), strict=False))
    rows = [Row(engine.row_text("crankpin", pin), style) for pin, style in styles.items()] if len(sizes) > 1 else []
    style = (10.0, 3.0) if len(sizes) > 1 else DASHED
    which = engine.row_text("crankpin", first) if len(sizes) > 1 else ""
    mean = engine.stated("mean_crankpin_load", extremes.mean)
    rows.append(Row(f"{mean}{', ' if which else ''}{which}", style, _MEAN))
    base = engine.symbol("crankpin_load")[:-1]
    ends = (
        f"{base}{',' if '_' in base else '_'}{name}$ = {engine.value('crankpin_load', value)} "
        f"({engine.number(round(angle, 1))}°)"
        for name, angle, value in (("max", extremes.max_angle, extremes.max), ("min", extremes.min_angle, extremes.min))
    )
    rows.append(Row(f"{which}{': ' if which else ''}{'; '.join(ends)}", width=0.0))
    paper, box = sheet(210.0, rows)
    _, high = limits(*sizes.values(), margin=0.14)
    # room for the name of a minimum near zero
    low = -0.08 * high if extremes.min < 0.08 * extremes.max else 0.0
    graph = over_cycle(paper, box, (low, high), engine.cycle, engine.language)
    for pin, values in sizes.items():
        graph.curve(f"pin_{pin}", np.append(degrees, engine.cycle), np.append(values, values[0]), styles[pin])
    level = float(engine.shown("crankpin_load", extremes.mean))
    graph.curve("mean", [0.0, engine.cycle], [level, level], style, width=0.45)
    for name, angle, value in (("max", extremes.max_angle, extremes.max), ("min", extremes.min_angle, extremes.min)):
        mark_point(graph, name, angle, float(engine.shown("crankpin_load", value)), name)
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(engine.title("crankpin_load"))
    return paper, {"crankpin_load": graph}


def main_journal_polar(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the loads of all main journals in the frame of the shaft, side by side on equal scales."""
    diagrams = engine.bearings.journals
    # common axes around the pole and all loads
    loads = [np.array([[0.0, *diagram.across], [0.0, *-diagram.down]]) for diagram in diagrams.values()]
    across, up = engine.shown("main_journal_load", np.hstack(loads))
    half = 0.59 * max(float(np.ptp(across)), float(np.ptp(up))) or 1.0
    middles = [float(np.min(values) + np.max(values)) / 2 for values in (across, up)]
    x, y = ((middle - half, middle + half) for middle in middles)
    columns = columns_of(min(len(diagrams), 2 if len(diagrams) in (2, 4) else 3))
    lines = -(-len(diagrams) // columns)
    side, gap = (current_layout().width - _LEFT_MARGIN - current_layout().right + 22) / columns - 22, (22.0, 26.0)
    side = min(side, max(scaled_height(_SIDE / lines), _SMALLEST))
    left = max(_LEFT_MARGIN, (current_layout().width - columns * (side + gap[0])) / 2)
    paper = Canvas(current_layout().width, TOP + 12 + lines * side + (lines - 1) * gap[1] + BOTTOM)
    graphs = {}
    for index, (name, diagram) in enumerate(diagrams.items()):
        column, line = index % columns, index // columns
        box = ChartBox(left + column * (side + gap[0]), TOP + 12 + line * (side + gap[1]), side, side)
        has_below = index + columns >= len(diagrams)
        small_text(paper, box.left + side / 2, box.top - 5, engine.row_text("main_journal", name))
        graphs[name] = _small_polar(engine, paper, box, diagram, (x, y), labels=(has_below, column == 0))
        title = f"{engine.symbol('main_journal_load')}, {engine.unit('main_journal_load')}"
        if has_below:
            graphs[name].x_title(title)
        if column == 0:
            graphs[name].y_title(title, 30.0)
    return paper, graphs


def _small_polar(
    engine: Drawn,
    paper: Canvas,
    box: ChartBox,
    diagram: PolarDiagram,
    axes: tuple[tuple[float, float], tuple[float, float]],
    *,
    labels: tuple[bool, bool],
) -> Graph:
    """Draw one of several polar diagrams, crank 1 upward, marked every 90 degrees."""
    graph = Graph(paper, box, axes[0], axes[1], engine.language)
    box, most = graph.box, min(5, max(1, round(graph.box.width / 32)))
    graph.frame(round_ticks(*graph.x, most), round_ticks(*graph.y, most), labels=labels)
    middle = graph.point(0.0, 0.0)
    paper.segments(np.array([(middle[0], box.top, middle[0], box.top + box.height)]), width=0.45)
    across, up = engine.shown("main_journal_load", diagram.across), -engine.shown("main_journal_load", diagram.down)
    across, up = np.append(across, across[0]), np.append(up, up[0])
    graph.curve("load", across, up, width=0.9, angles=np.append(diagram.degrees, engine.cycle))
    marked = (
        engine.shown("main_journal_load", diagram.marks_across),
        -engine.shown("main_journal_load", diagram.marks_down),
    )
    graph.curves["marks"] = marked
    places = zip(diagram.marks, graph.across(marked[0]), graph.down(marked[1]), strict=True)
    label_marks(paper, [(f"{angle:g}", float(a), float(b)) for angle, a, b in places], size=6.5, dot=1.3, frame=box)
    return graph


# The largest sum takes this share of the radius of the journal.
_DEEPEST = 0.45
_FOOT, _GAP, _ROOM, _HEAD = 40.0, 14.0, 26.0, 14.0
_HATCH = 4.0
# on a sheet none takes the room of other diagrams [pt]
_LARGEST = 270.0


def crankpin_wear(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the wear rings of all unlike crankpins."""
    return _rings(engine, "crankpin_wear", "crankpin")


def main_wear(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the wear rings of all main journals."""
    return _rings(engine, "main_wear", "main_journal")


def _rings(engine: Drawn, listing: str, thing: str) -> tuple[Canvas, Mapping[str, Graph]]:
    """Draw the rings of a listing side by side, depths on one scale."""
    angles, rings = wear_rings(engine.results, listing)
    rings = {name: ring._replace(sums=engine.shown("wear_sum", ring.sums)) for name, ring in rings.items()}
    across = columns_of(len(rings) if len(rings) < 3 else 2 if len(rings) == 4 else 3)
    lines = -(-len(rings) // across)
    side = min(
        (current_layout().width - 24 - (across - 1) * _GAP) / across,
        max(scaled_height(290.0) / min(lines, 2), _SMALLEST),
        _LARGEST if current_layout().is_sheet else math.inf,
    )
    start = (current_layout().width - across * side - (across - 1) * _GAP) / 2
    # across a ring its angle would stand on the worn surface
    below = 10.0 * any(ring.hole.arc < 360 for ring in rings.values())
    head = (_HEAD if len(rings) > 1 else 0.0) + below
    deepest = max(float(ring.sums.max()) for ring in rings.values()) or 1.0
    unit = engine.unit("wear_sum")
    largest = translate("drawing.largest", engine.language, value=f"{engine.number(deepest, 4)} {unit}")
    text = f"{engine.symbol('wear_sum')} – {largest}; {translate('drawing.worn', engine.language)}"
    frame = translate(f"drawing.{'crank_up' if thing == 'crankpin' else engine.shaft_frame}", engine.language)
    rows = [row for line_text in (text, frame) for row in fitted_lines(line_text, 8, current_layout().width / WIDER)]
    further = 12.0 * max(len(rows) - 2, 0)
    paper = Canvas(current_layout().width, TOP + lines * (side + head) + (lines - 1) * _GAP + _FOOT + further)
    graphs = {}
    for index, (name, ring) in enumerate(rings.items()):
        top = TOP + (index // across) * (side + head + _GAP) + head
        box = ChartBox(start + (index % across) * (side + _GAP), top, side, side)
        graphs[name] = _ring(engine, paper, box, angles, ring, deepest)
        if len(rings) > 1:
            small_text(paper, box.left + side / 2, top - 4 - below, engine.row_text(thing, name))
        if ring.hole.arc < 360:
            angle = engine.number(ring.hole.angle, 4)
            hole = translate("drawing.oil_hole_at", engine.language, angle=angle)
            small_text(paper, box.left + side / 2, top - 3, hole)
    for index, row in enumerate(rows):
        level = paper.height - 35 - further + 12 * index
        paper.text(current_layout().width / 2, level, row, size=8, anchor="middle")
    return paper, graphs


def _ring(engine: Drawn, paper: Canvas, box: ChartBox, angles: Array, ring: WearRing, deepest: float) -> Graph:
    """Draw a journal of radius 1, what is worn off it, its numbered rays and its oil hole."""
    reach = 1 + _ROOM / (box.width / 2 - _ROOM)
    graph = Graph(paper, box, (-reach, reach), (-reach, reach), engine.language, to_scale=False)
    depth = _DEEPEST * ring.sums / deepest
    fine = np.arange(0.0, 361.0, 2.0)
    worn = 1 - np.interp(fine, angles, depth, period=360)
    direction = _towards(fine)
    _hatch(graph, fine, worn)
    graph.curve("journal", *direction, width=0.45)
    graph.curve("worn", *(direction * worn), width=0.9)
    rays = _towards(angles)
    inner = rays * (1 - depth)
    x, y = graph.across(inner[0]), graph.down(inner[1])
    outer = rays * (1 + 5 / (box.width / 2 - _ROOM))
    graph.paper.segments(np.column_stack([x, y, graph.across(outer[0]), graph.down(outer[1])]), width=0.45)
    graph.curves["ends"] = inner[0], inner[1]
    step = 1 if len(angles) <= 12 or box.width > 200 else 2
    for ray in range(0, len(angles), step):
        place = rays[:, ray] * (1 + 14 / (box.width / 2 - _ROOM))
        small_text(paper, float(graph.across(place[0])), float(graph.down(place[1])) + 2.7, str(ray + 1))
    cross = np.array([[-0.12, 0, 0.12, 0], [0, -0.12, 0, 0.12]])
    centre = [graph.across(cross[:, 0]), graph.down(cross[:, 1]), graph.across(cross[:, 2]), graph.down(cross[:, 3])]
    paper.segments(np.column_stack(centre), width=0.45)
    _hole(graph, ring)
    return graph


def _hole(graph: Graph, ring: WearRing) -> None:
    """Draw the oil hole from the surface to the middle."""
    hole = ring.hole
    if hole.arc == 360:
        return
    axis = _towards(np.array([hole.angle]))[:, 0]
    half_width = np.array([axis[1], -axis[0]]) * 0.045
    walls = [np.array([half_width * side, axis + half_width * side]).T for side in (-1, 1)]
    for wall in walls:
        graph.paper.line(graph.across(wall[0]), graph.down(wall[1]), width=0.9)
    end = axis * 0.98
    graph.curve("oil_hole", [0.0, end[0]], [0.0, end[1]], DASH_DOT, width=0.45)


def _hatch(graph: Graph, angles: Array, worn: Array) -> None:
    """Hatch the ring between the worn surface and the journal, under 45 degrees."""
    radius = float(graph.across(1.0) - graph.across(0.0))
    along = np.arange(-radius, radius, 0.6)
    offsets = np.arange(-radius, radius, _HATCH)
    a, b = np.meshgrid(along, offsets)
    x, y = (a + b) / np.sqrt(2), (a - b) / np.sqrt(2)
    distance = np.hypot(x, y) / radius
    edge = np.interp(np.degrees(np.arctan2(x, y)), angles, worn, period=360)
    inside = np.pad((distance >= edge) & (distance <= 1), ((0, 0), (1, 1)))
    row, start = np.nonzero(inside[:, 1:] & ~inside[:, :-1])
    _, end = np.nonzero(inside[:, :-1] & ~inside[:, 1:])
    x0, y0 = float(graph.across(0.0)), float(graph.down(0.0))
    ends = np.column_stack([x0 + x[row, start], y0 - y[row, start], x0 + x[row, end - 1], y0 - y[row, end - 1]])
    graph.paper.segments(ends, width=0.45, colour=GREY)


def _towards(angles: Array) -> Array:
    """Return unit vectors, to the right and upward, clockwise from the upward direction, shape (2, n). [deg]"""
    return np.array([np.sin(np.radians(angles)), np.cos(np.radians(angles))])
