"""Figures of cylinders: loads of bearings, wear, free forces and moments, masses in planes, harmonics of the torque."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Self

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.bearings import CrankpinLoad, PolarDiagram, WearRing, wear_rings
from crankwork.analysis.load_diagrams import Locus, crankpin_of_one
from crankwork.analysis.results import Listing
from crankwork.analysis.rotor_balance import polygons
from crankwork.locale import translate
from crankwork.report.display import link_label
from crankwork.report.look import Drawn
from crankwork.show.canvas import (
    BLACK,
    GREY,
    WIDER,
    Canvas,
    columns_of,
    current_layout,
    fitted_lines,
    is_narrow,
    scaled_height,
    text_width,
)
from crankwork.show.chart import (
    ARROW,
    BOTTOM,
    CIRCLE,
    TOP,
    ChartBox,
    Graph,
    Row,
    legend,
    legend_height,
    limits,
    over_cycle,
    round_ticks,
    sheet,
    small_text,
)
from crankwork.show.label_placement import label_marks, mark_point
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, STYLES

_HEIGHT, _MARGIN, _LOWEST = 340.0, 1.12, 0.55
# rays and circle of the mean of a polar diagram, and what is as narrow as a stick
_RAYS, _RAY, _MEAN, _STICK = 30.0, "#8c8c8c", 0.45, 0.12
# marks nearer than this to another one have no number [pt]
_CROWDED = 10.0
# what numbers and title take beside polar diagrams of main journals [pt]
_LEFT_MARGIN = 60.0
# the side of one at most, of several at least [pt]
_SIDE, _SMALLEST = 320.0, 72.0
# between values of neighbouring bars [pt]
_BETWEEN = 5.0
# of the inertia force of a piston, what of free forces is told in words, and what is rounding
_HARDLY, _LEFT = 1e-3, 1e-9
# how wide a locus is, of its length, that is a line
_LINE = 1e-6
_BALANCE_SIDE, _BALANCE_GAP, _TITLE = 220.0, 66.0, 36.0
# with the symbols of the axes
_SUMS = {"plane_moment": "plane_moment", "plane_couple": "rotor_couple"}
# side of a phase star at most [pt]
_STAR_SIDE = 150.0


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
    least = {panel: (_HARDLY if panel == "force" else _LEFT) * _inertia(engine) for panel in sizes}
    panels = [panel for panel in sizes if most[panel] > least[panel]] or ["force"]
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
    """Return the planes and directions of the masses, the polygon of their moments, and that of their couples."""
    drawn = polygons(machine.results)
    star = np.array(drawn["plane_moment"][1])
    panels: dict[str, tuple[str, tuple[str, ...], Array, Array]] = {
        "directions": ("plane_moment", drawn["plane_moment"][0], np.zeros((len(star) - 1, 2)), np.diff(star, axis=0)),
        **{kind: (kind, names, ends[:-1], ends[1:]) for kind, (names, ends) in drawn.items()},
    }
    trace, names = machine.results.trace, drawn["plane_moment"][0]
    along = np.array([trace[key].value for name in names if (key := f"plane_position.{name}") in trace])
    columns, has_planes = columns_of(2), along.size == len(names)
    side = min((current_layout().inner - (columns - 1) * _BALANCE_GAP) / columns, scaled_height(_BALANCE_SIDE))
    lines = -(-(len(panels) + has_planes) // columns)
    paper, graphs = Canvas(current_layout().width, TOP + lines * (side + _TITLE) + BOTTOM - _TITLE), dict[str, Graph]()
    boxes = [
        ChartBox(current_layout().left + column * (side + _BALANCE_GAP), TOP + row * (side + _TITLE), side, side)
        for row in range(lines)
        for column in range(columns)
    ]
    if has_planes:
        graphs["planes"] = _along_shaft(machine, paper, boxes.pop(0), names, along, np.diff(star, axis=0))
    for box, (name, (kind, sides, starts, ends)) in zip(boxes, panels.items(), strict=False):
        graphs[name] = _polygon(machine, paper, box, kind, sides, starts, ends)
    return paper, graphs


def _along_shaft(
    machine: Drawn, paper: Canvas, box: ChartBox, names: tuple[str, ...], along: Array, moments: Array
) -> Graph:
    """Draw a shaft from the side: a line in each plane, as high as the moment of its mass goes up."""
    z, up = machine.shown("plane_position", along), machine.shown("plane_moment", moments[:, 1])
    margin = 0.12 * float(np.ptp(z))
    low, high = min(0.0, float(up.min())), max(0.0, float(up.max()))
    x, y = (float(z.min()) - margin, float(z.max()) + margin), (low - 0.1 * (high - low), high + 0.1 * (high - low))
    graph = Graph(paper, box, x, y, machine.language)
    graph.frame(round_ticks(*x, 4), round_ticks(*y, 4))
    ends = [
        (graph.point(place, 0.0), graph.point(place, end)) for place, end in zip(z.tolist(), up.tolist(), strict=True)
    ]
    paper.segments(np.array([(*graph.point(float(z.min()), 0.0), *graph.point(float(z.max()), 0.0))]), width=0.9)
    for foot, head in ends:
        paper.segments(np.array([(*foot, *head)]), width=0.9)
        paper.dot(*head, 2.6)
    labels = [(link_label(name, machine.language), *head) for name, (_, head) in zip(names, ends, strict=True)]
    label_marks(paper, labels, frame=box)
    graph.curves["plane_moment"] = z, up
    graph.x_title(f"{machine.symbol('plane_position')}, {machine.unit('plane_position')}")
    graph.y_title(f"{machine.symbol('plane_moment_y')}, {machine.unit('plane_moment')}")
    return graph


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
        marks.append((link_label(name, machine.language), (tail[0] + head[0]) / 2, (tail[1] + head[1]) / 2))
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
