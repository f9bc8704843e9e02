"""The figures of motion: of the piston, Brix's and Tolle's constructions, the centrodes of a coupler."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import combinations

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.constructions import BrixPoints, brix_points, tangent_ends, tolle_parabola, tolle_points
from crankwork.analysis.sampled_motion import Frame, SampledMotion, sample_motion
from crankwork.analysis.skeleton import Skeleton, skeleton
from crankwork.locale import translate
from crankwork.locale.numbers import unit_name
from crankwork.quantities import QUANTITIES
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.display import symbol
from crankwork.report.forces import Line
from crankwork.report.gas import diagram, gas_exchange, mark_points, named_points
from crankwork.report.look import Drawn, Style, displayed_values, draw_rotation, figure_title, position_text, scale_text
from crankwork.show.canvas import (
    GREY,
    WIDER,
    Canvas,
    current_layout,
    is_narrow,
    plain,
    points_per_mm,
    scaled_height,
    text_width,
)
from crankwork.show.chart import (
    BOTTOM,
    DOT,
    TOP,
    ChartBox,
    Graph,
    Row,
    limits,
    name_at_the_end,
    over_cycle,
    round_ticks,
    sheet,
)
from crankwork.show.label_placement import label_marks
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, Drawing, flow_rows

_PANEL, _PANEL_GAP = 126.0, 20.0
_SIDES = ("AC", "BD", "CD", "EF", "CF", "FD")
_STEP = 30.0
_CIRCLE, _MARGIN, _TITLES = 190.0, 26.0, 44.0
# height of an indicator diagram, and what a number of its axes takes
_INDICATOR, _NUMBER = 230.0, 24.0
# height of the loop of gas exchange at least
_LOOP = 66.0
_HIGH, _AROUND, _LINK = 300.0, 0.6, "#8c8c8c"
# dashes that short centrodes show, too
_ROLLING = (3.0, 1.5)
# how much of its way a centre must be near to be drawn, and how far it must go there
_SEEN, _SMALL = 0.3, 0.2
# a coupler that turns less than this share of the crank has its centre far away
_LEAST = 1e-6
# share of its length by which a path is curved
_STRAIGHT = 1e-3


def kinematics(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return three panels over the cycle; an approximate method shows the two orders it is made of."""
    has_orders = "piston_velocity_first_order" in engine.columns
    panel = scaled_height(_PANEL * (0.75 if is_narrow() else 1.0))
    paper = Canvas(current_layout().width, TOP + 4 + 3 * panel + 2 * _PANEL_GAP + BOTTOM)
    graphs: dict[str, Graph] = {}
    top = TOP + 4
    for row, noun in enumerate(("displacement", "velocity", "acceleration")):
        keys = {f"piston_{noun}": SOLID}
        if has_orders:
            keys |= {f"piston_{noun}_first_order": DASHED, f"piston_{noun}_second_order": DASH_DOT}
        curves = [Line(key, engine.values(key), style) for key, style in keys.items()]
        box = ChartBox(current_layout().left, top, current_layout().inner, panel)
        ends = limits(*(curve.values for curve in curves))
        graph = over_cycle(paper, box, ends, engine.cycle, engine.language, numbers=row == 2)
        for curve in curves:
            graph.curve(curve.key, engine.degrees, curve.values, curve.style)
        rows = [Row(engine.symbol(curve.key), curve.style) for curve in curves]
        name_at_the_end(paper, rows if has_orders else [], box)
        graph.y_title(engine.title(f"piston_{noun}"), 42.0)
        graphs[noun] = graph
        top += graph.box.height + _PANEL_GAP
    graphs["acceleration"].x_title(engine.title("crank_angle"))
    return paper, graphs


def brix(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return Brix's circle beside the displacement over the crank angle, on one vertical scale."""
    lengths = engine.results.solved.lengths
    degrees, radius = engine.degrees, float(engine.shown("piston_displacement", lengths.crank_radius))
    turn = degrees <= 360
    degrees, exact = degrees[turn], engine.values("piston_displacement")[turn]
    circle = brix_points(lengths, degrees)
    error = float(np.max(np.abs(radius * (1 - circle.up) - exact)))
    shift = engine.value("piston_displacement", float(lengths.crank_radius * lengths.rod_ratio / 2))
    difference = f"{engine.number(error, 2)} {engine.unit('piston_displacement')}"
    half = f"{engine.symbol('rod_ratio')}{engine.symbol('crank_radius')}/2"
    rows = [
        Row(f"{translate('drawing.brix_circle', engine.language)} OO′ = {half} = {shift}", width=0.0),
        Row(
            translate(
                "drawing.brix_error", engine.language, symbol=engine.symbol("piston_displacement"), value=difference
            ),
            width=0.0,
        ),
    ]
    side = min(scaled_height(_CIRCLE), (0.36 if is_narrow() else 0.45) * current_layout().width)
    height = side * max(1.0, float(exact.max()) / (2 * radius))
    paper, box = sheet((height + _MARGIN - 10) / current_layout().tall, rows)
    top = box.top + _MARGIN - 14
    left = _MARGIN + side + (_TITLES if is_narrow() else _MARGIN - 6 + _TITLES)
    graph_box = ChartBox(left, top, current_layout().width - left - current_layout().right, height)
    graph = Graph(paper, graph_box, (0.0, 360.0), (float(exact.max()), 0.0), engine.language, "crank_angle")
    ring = Graph(paper, ChartBox(_MARGIN, top, side, side), (-radius, radius), (-radius, radius), engine.language)
    marks = np.arange(0.0, 360.0, _STEP)
    points = brix_points(lengths, marks)
    _projections(ring, graph, points, radius, marks)
    _rays(engine, ring, points, radius, marks)
    ticks = round_ticks(0.0, float(exact.max()), 8)
    for level in graph.down(ticks):
        corners = [left - 28, left - 4, left - 4, left - 28], [level - 5, level - 5, level + 5, level + 5]
        paper.area(*corners)
    graph.frame(np.arange(0.0, 361.0, 60.0 if graph.box.width > 6 * _NUMBER else 180.0), ticks)
    graph.curve("displacement", degrees, exact)
    graph.curves["construction"] = degrees, radius * (1 - circle.up)
    graph.x_title(engine.title("crank_angle"))
    title = engine.title("piston_displacement")
    graph.set_quantity(title)
    paper.text(current_layout().width - current_layout().right, top - 10, title, anchor="end")
    return paper, {"circle": ring, "displacement": graph}


def _rays(engine: Drawn, ring: Graph, points: BrixPoints, radius: float, marks: Array) -> None:
    """Draw the circle with its axes, the rays from the pole and their angles."""
    around = np.radians(np.arange(0.0, 361.0, 3.0))
    ring.curve("circle", radius * np.sin(around), radius * np.cos(around))
    axis = -points.pole / np.hypot(*points.pole) * radius * 1.08
    for x, y in (axis, (axis[1], -axis[0])):
        ring.paper.line(ring.across(np.array([-x, x])), ring.down(np.array([-y, y])), style=DASH_DOT, width=0.45)
    pole = radius * points.pole
    x, y = ring.across(radius * points.across), ring.down(radius * points.up)
    start = ring.point(float(pole[0]), float(pole[1]))
    centre = ring.point(0.0, 0.0)
    ring.paper.segments(np.column_stack([np.full_like(x, start[0]), np.full_like(y, start[1]), x, y]), width=0.45)
    ring.curves["points"] = radius * points.across, radius * points.up
    for mark, a, b in zip(marks, x, y, strict=True):
        ring.paper.dot(float(a), float(b), 1.4)
        out = np.array([a, b]) - centre
        place = np.array(centre) + out * (1 + 12 / float(np.hypot(*out)))
        ring.text_on_white(float(place[0]), float(place[1]) + 2.8, engine.number(float(mark)), "middle", 7.5)
    label_marks(ring.paper, [("O′", *start), ("O", *centre)], dot=0.0, frame=ring.box)
    for origin in (start, centre):
        ring.paper.dot(*origin, 2.0, fill="#ffffff", width=0.9)


def _projections(ring: Graph, graph: Graph, points: BrixPoints, radius: float, marks: Array) -> None:
    """Draw the lines from the points of the right half of the circle to the curve."""
    for mark, across, up in zip(marks, points.across, points.up, strict=True):
        if mark <= 180:
            x, y = ring.point(radius * float(across), radius * float(up))
            end = float(graph.across(mark))
            graph.paper.segments(np.array([[x, y, end, y]]), width=0.45, colour=GREY)
            graph.paper.dot(end, y, 1.4)


def indicator_brix(machine: Drawn) -> Drawing:
    """Return absolute pressure over volume with Brix's half circle below it, and beside it over the crank angle."""
    space, degrees = machine.results.solved.space, machine.degrees
    ambient = float(machine.shown("ambient_pressure", space.ambient))
    volume, (_, pressure) = machine.values("cylinder_volume"), diagram(machine)
    ends, reach = limits(pressure), 1.06 * float(np.max(volume))
    layout, high = current_layout(), scaled_height(_INDICATOR)
    wide = (0.36 if layout.is_sheet else 0.44) * layout.inner
    paper = Canvas(layout.width, TOP + high + BOTTOM + wide / 2 + _MARGIN)
    left = Graph(paper, ChartBox(layout.left, TOP, wide, high), (0.0, reach), ends, machine.language)
    # to a round scale it is narrower
    wide = left.box.width
    place = ChartBox(layout.left + wide + _TITLES, TOP, layout.inner - wide - _TITLES, high)
    right = Graph(paper, place, (0.0, machine.cycle), ends, machine.language, "crank_angle")
    paper.height = TOP + left.box.height + BOTTOM + max(wide / 2, _LOOP) + _MARGIN
    ticks = left.up_ticks
    named = ((machine.title(key), graph) for key, graph in (("cylinder_volume", left), ("crank_angle", right)))
    # symbol and unit alone where the words are wider than the axis
    titles = [title if text_width(title, 8.0) * WIDER <= graph.box.width + _NUMBER else title[title.index("$") :]
              for title, graph in named]  # fmt: skip
    marks = _half_circle(machine, left)
    volumes = round_ticks(0.0, reach, max(2, min(6, int(wide / _NUMBER))))
    _clear(left, volumes, titles[0], machine)
    left.frame(volumes, ticks)
    steps = (step for step in (90.0, 180.0) if machine.cycle / step * _NUMBER <= right.box.width)
    right.frame(np.arange(0.0, machine.cycle + 1, next(steps, 360.0)), ticks)
    left.curve("indicator", volume, pressure, angles=degrees)
    right.curve("pressure", degrees, pressure)
    for graph in (left, right):
        graph.level(ambient, DASH_DOT, "ambient")
    points = named_points(machine)
    mark_points(left, [(name, float(np.interp(angle, degrees, volume)), value) for name, angle, value in points])
    mark_points(right, points)
    unit = machine.unit("diagram_pressure")
    left.y_title(f"{machine.symbol('diagram_pressure')}, {unit}", 30.0)
    left.x_title(titles[0])
    right.set_quantity(f"{machine.symbol('diagram_pressure')}, {unit}")
    right.x_title(titles[1])
    label_marks(paper, marks, size=7.0, dot=1.2)
    clear = _NUMBER / 2  # Of the last number of the half circle
    foot = TOP + left.box.height + BOTTOM
    below = ChartBox(place.left + clear, foot, right.box.width - clear, max(wide / 2, _LOOP))
    gas_exchange(machine, paper, below, volume, pressure)
    return paper.drawing(figure_title("indicator_brix", machine.language), machine.language)


def _clear(graph: Graph, ticks: Array, title: str, machine: Drawn) -> None:
    """Clear the ground under the numbers and the title of a horizontal axis, so that no line runs through them."""
    texts = [(machine.number(float(tick)), float(graph.across(tick)), 12.5, 8.0) for tick in ticks]
    texts.append((title, graph.box.left + graph.box.width / 2, 26.0, 8.0))
    for text, middle, down, size in texts:
        half, foot = WIDER * text_width(text, size) / 2 + 1, graph.box.top + graph.box.height + down
        left, right, high, low = middle - half, middle + half, foot - 0.9 * size, foot + 0.4 * size
        graph.paper.area([left, right, right, left], [high, high, low, low])


def _half_circle(machine: Drawn, graph: Graph) -> list[tuple[str, float, float]]:
    """Draw the half circle of Brix between the volumes at the dead centres, and lines up to the diagram.

    Returned are the names of its points and where they are.
    """
    space, lengths, paper = machine.results.solved.space, machine.results.solved.lengths, graph.paper
    ends = machine.shown("cylinder_volume", np.array([space.clearance, space.clearance + space.swept]))
    first, last = graph.across(ends).tolist()
    radius, centre, level = (last - first) / 2, (first + last) / 2, graph.box.top + graph.box.height + BOTTOM
    points = brix_points(lengths, np.arange(0.0, 180.0 + _STEP, _STEP))
    pole = centre - radius * float(points.pole[1]), level
    x, y = centre - radius * points.up, level + radius * points.across
    around = np.radians(np.arange(0.0, 181.0, 3.0))
    paper.line(centre - radius * np.cos(around), level + radius * np.sin(around), width=0.9, name="circle")
    paper.segments(np.array([(first, level, last, level)]), width=0.45)
    paper.segments(np.column_stack([np.full_like(x, pole[0]), np.full_like(y, pole[1]), x, y]), width=0.45)
    foot = np.full_like(x, graph.box.top + graph.box.height)
    paper.segments(np.column_stack([x, y, x, foot]), width=0.45, colour=GREY)
    marks = [(machine.number(_STEP * k), *place) for k, place in enumerate(zip(x.tolist(), y.tolist(), strict=True))]
    captions = [
        f"OO′ = {machine.symbol('rod_ratio')}{machine.symbol('crank_radius')}/2",
        f"{machine.symbol('ambient_pressure')} = {machine.value('ambient_pressure', space.ambient)}",
    ]
    if current_layout().is_sheet:
        millimetres = (last - first) / points_per_mm()
        value = float(f"{machine.shown('stroke', space.swept / space.area) / millimetres:.4g}")
        sign = machine.symbol("piston_displacement").strip("$").partition("_")[0]
        captions.append(scale_text(f"μ_{sign}", value, "mm", machine.language))
    for row, text in enumerate(flow_rows(captions, ";  ", graph.box.width / WIDER, partial(text_width, size=8))):
        paper.text(centre, level + radius + 22 + 12 * row, text, size=8, anchor="middle")
    return [*marks, ("O", centre, level), ("O′", *pole)]


def tolle(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the acceleration over the displacement, and the tangents that envelop it by Tolle's construction."""
    lengths = engine.results.solved.lengths
    ratio, radius = float(lengths.rod_ratio), float(engine.shown("piston_displacement", lengths.crank_radius))
    unit = float(engine.shown("piston_acceleration", lengths.crank_radius * engine.results.solved.speed**2))
    turn = engine.degrees <= 360
    x, y = engine.values("piston_displacement")[turn], engine.values("piston_acceleration")[turn]
    points = tolle_points(ratio)
    corners = {name.upper(): (a * radius, b * unit) for name, (a, b) in points._asdict().items()}
    along, up = tolle_parabola(ratio)
    parabola = radius * along, unit * up
    rows = [
        Row(engine.title("piston_acceleration").rpartition(",")[0]),
        Row(translate("drawing.tangents", engine.language), width=0.45),
    ]
    differs = float(np.max(np.abs(np.interp(x, *parabola) - y))) > 2e-3 * unit
    if differs:
        rows.insert(1, Row(translate("drawing.parabola", engine.language), DOTTED))
    paper, box = sheet(270.0, rows)
    low, high = limits(np.array([corner[1] for corner in corners.values()]), y, margin=0.09)
    room = 0.04 * 2 * radius
    graph = Graph(paper, box, (-room, max(2 * radius, float(x.max())) + room), (low, high), engine.language)
    graph.frame(round_ticks(0.0, graph.x[1], 8), round_ticks(low, high, 9))
    tangents = tangent_ends(corners["C"], corners["F"], corners["D"])
    ends = np.column_stack([graph.across(tangents[:, 0]), graph.down(tangents[:, 1]),
                            graph.across(tangents[:, 2]), graph.down(tangents[:, 3])])  # fmt: skip
    paper.segments(ends, width=0.45)
    graph.curves["tangents"] = tangents[:, [0, 2]], tangents[:, [1, 3]]
    for first, second in map(tuple, _SIDES):
        pair = np.array([corners[first], corners[second]])
        graph.curve(first + second, pair[:, 0], pair[:, 1], DASHED if first + second == "CD" else SOLID, width=0.45)
    graph.curves["parabola"] = parabola
    if differs:
        graph.curve("parabola", *parabola, DOTTED)
    graph.curve("acceleration", x, y, width=0.9)
    places = [(name, *graph.point(*place)) for name, place in corners.items()]
    label_marks(paper, [*places, *_numbered(graph, tangents)], frame=box)
    graph.x_title(engine.title("piston_displacement"))
    graph.y_title(engine.title("piston_acceleration"), 48.0)
    return paper, {"tolle": graph}


def _numbered(graph: Graph, tangents: Array) -> list[tuple[str, float, float]]:
    """Return the parts of the two outer tangents with their numbers, where they stand on the paper."""
    numbered = [(f"{index}", *graph.point(*row[:2])) for index, row in enumerate(tangents.tolist(), start=1)]
    return numbered + [(f"{index}′", *graph.point(*row[2:])) for index, row in enumerate(tangents.tolist(), start=1)]


def _coupler(machine: Drawn) -> tuple[str, SampledMotion]:
    """Return the coupler whose instant centre is near most of the time, none where all are far away."""
    reached = machine.reached
    names = [key_of(key).owner for key in reached.columns if key.startswith("instant_centre_x.")]
    moved = sample_motion(machine.results.machine.mechanism, reached.degrees)
    reach = _reach(np.vstack([point.place for point in moved.points.values()]))
    seen = {name: _seen(instant_centres(moved.frames[name], reached.row)[0], reach)
            for name in names if name in moved.frames}  # fmt: skip
    name = max(seen, key=lambda link: seen[link], default="")
    return (name if name and seen[name] >= _SEEN else ""), moved


def has_centrodes(machine: Drawn) -> bool:
    """Return whether the instant centre of a coupler is near enough to be drawn."""
    return bool(_coupler(machine)[0])


def centrodes(machine: Drawn) -> Drawing:
    """Return both centrodes of a coupler at the angle that is worked."""
    (coupler, moved), style, mechanism = _coupler(machine), machine.style, machine.results.machine.mechanism
    degrees, row = machine.reached.degrees, machine.reached.row
    fixed, rolling = instant_centres(moved.frames[coupler], row)
    scale = float(displayed_values(QUANTITIES["point_x"], np.array(1.0)))
    places = {name: point.place[row] * scale for name, point in moved.points.items()}
    letters = skeleton(mechanism, style.links).letters
    # the letter that tables have, unless a point has it
    centre = symbol("instant_centre_x", style.language).partition("_")[2]
    centre += "₀" if centre in letters.values() else ""
    rows = [
        Row(translate("drawing.fixed_centrode", style.language, link=plain(number_of(coupler)))),
        Row(
            f"{translate('drawing.moving_centrode', style.language)}, {position_text(float(degrees[row]), style)}",
            _ROLLING,
        ),
        Row(f"${centre}$ – {translate('drawing.instant_centre', style.language)}", DOT),
    ]
    paper, box = sheet(scaled_height(_HIGH), rows)
    graph = _graph(paper, box, np.vstack([point.place * scale for point in moved.points.values()]), style)
    _linkage(graph, skeleton(mechanism, style.links), moved, row)
    for key, path, dashes in (("fixed_centrode", fixed, SOLID), ("moving_centrode", rolling, _ROLLING)):
        graph.curve(key, *_within(graph, path * scale), dashes)
    marks = [(plain(letters[point]), *graph.point(*place)) for point, place in places.items() if point in letters]
    x, y = fixed[row] * scale
    if graph.x[0] < x < graph.x[1] and graph.y[0] < y < graph.y[1]:
        marks.append((f"${centre}$", *graph.point(float(x), float(y))))
    label_marks(paper, marks, frame=graph.box)
    return _in_plane(graph, "centrodes", style)


def curved_paths(machine: Drawn) -> dict[str, Array]:
    """Return the paths of points with a name in the plane, without those on a line or on a circle about a pivot. [m]"""
    columns = machine.reached.columns
    names = [key_of(key).owner for key in columns if key.startswith("point_x.")]
    pivots = skeleton(machine.results.machine.mechanism, machine.style.links).pivots
    moved = sample_motion(machine.results.machine.mechanism, machine.reached.degrees).points
    fixed = [moved[pivot].place[0] for pivot in pivots if pivot in moved]
    paths = {
        name: np.column_stack([columns[f"point_{axis}.{name}"] for axis in "xy"]) for name in names if "." not in name
    }
    return {name: path for name, path in paths.items() if _is_curved(path, fixed)}


def _is_curved(path: Array, fixed: Sequence[Array]) -> bool:
    path = path[np.isfinite(path).all(axis=1)]
    sizes = np.linalg.svd(path - path.mean(axis=0), compute_uv=False)
    radii = [np.hypot(*(path - pivot).T) for pivot in fixed]
    return bool(sizes[1] > _STRAIGHT * sizes[0]) and all(np.ptp(radius) > _STRAIGHT * sizes[0] for radius in radii)


def path_figure(machine: Drawn, names: Sequence[str]) -> Drawing:
    """Return the paths of some points to scale, and the linkage at the angle that is worked."""
    style, mechanism, row = machine.style, machine.results.machine.mechanism, machine.reached.row
    scale = float(displayed_values(QUANTITIES["point_x"], np.array(1.0)))
    paths = {name: scale * path for name, path in curved_paths(machine).items() if name in names}
    moved, shape = sample_motion(mechanism, machine.reached.degrees), skeleton(mechanism, style.links)
    places = {name: point.place[row] * scale for name, point in moved.points.items()}
    paper, box = sheet(_HIGH, [Row(plain(name), line) for name, line in zip(paths, STYLES, strict=False)])
    graph = _graph(paper, box, np.vstack([*paths.values(), *places.values()]), style, 0.1)
    _linkage(graph, shape, moved, row)
    for (name, path), line in zip(paths.items(), STYLES, strict=False):
        graph.curve(f"path.{name}", path[:, 0], path[:, 1], line, angles=machine.reached.degrees)
    label_marks(paper, [(plain(shape.letters[name]), *graph.point(*place)) for name, place in places.items()
                        if name in shape.letters and name not in paths], frame=graph.box)  # fmt: skip
    return _in_plane(graph, "paths", style)


def _in_plane(graph: Graph, name: str, style: Style) -> Drawing:
    """Return the figure of a graph whose axes are coordinates."""
    unit = unit_name(QUANTITIES["point_x"].unit, style.language)
    graph.x_title(f"$x$, {unit}")
    graph.y_title(f"$y$, {unit}")
    return graph.paper.drawing(figure_title(name, style.language), style.language)


def instant_centres(frame: Frame, row: int) -> tuple[Array, Array]:
    """Return the instant centre on the ground, and on the coupler where it is at one crank angle. [m]"""
    rate = np.where(np.abs(frame.angle_1) > _LEAST, frame.angle_1, np.nan)
    offset = frame.origin.place_1 / rate[:, None]
    fixed = frame.origin.place + np.column_stack([-offset[:, 1], offset[:, 0]])
    across = np.column_stack([-frame.along[:, 1], frame.along[:, 0]])
    off = fixed - frame.origin.place
    u, v = np.sum(off * frame.along, axis=1), np.sum(off * across, axis=1)
    return fixed, frame.origin.place[row] + u[:, None] * frame.along[row] + v[:, None] * across[row]


def _seen(path: Array, reach: tuple[Array, Array]) -> float:
    """Return the share of the path of a centre that is near a linkage, zero for one that hardly moves there."""
    near = np.all(np.abs(path - reach[0]) < reach[1], axis=1)
    size = float(np.max(np.ptp(path[near], axis=0))) if np.any(near) else 0.0
    return float(np.mean(near)) if size > _SMALL * float(reach[1][0]) else 0.0


def _reach(places: Array, around: float = _AROUND) -> tuple[Array, Array]:
    """Return the middle of a linkage, and how far around it centres are shown, across and up."""
    low, high = places.min(axis=0), places.max(axis=0)
    return (low + high) / 2, np.full(2, float(np.max(high - low)) * (1 + around) / 2)


def _graph(paper: Canvas, box: ChartBox, places: Array, style: Style, around: float = _AROUND) -> Graph:
    """Return a graph of equal scales around a linkage, its frame drawn."""
    middle, size = _reach(places, around)
    unit = 2 * max(float(size[0]) / box.width, float(size[1]) / box.height) or 1.0
    half = unit * box.width / 2, unit * box.height / 2
    x = float(middle[0]) - half[0], float(middle[0]) + half[0]
    y = float(middle[1]) - half[1], float(middle[1]) + half[1]
    graph = Graph(paper, box, x, y, style.language, to_scale=False)
    graph.frame(round_ticks(*x), round_ticks(*y))
    return graph


def _linkage(graph: Graph, shape: Skeleton, moved: SampledMotion, row: int) -> None:
    """Draw the links as lines between their points, and the rotation of a crank that turns."""
    scale = float(displayed_values(QUANTITIES["point_x"], np.array(1.0)))
    places = {name: point.place[row] * scale for name, point in moved.points.items()}
    if shape.pin and row + 1 < len(moved.degrees):
        pivot = next(iter(shape.pivots))
        draw_rotation(graph, places[pivot], scale * moved.points[shape.pin].place[[row, row + 1]] - places[pivot])
    for member in shape.members:
        for start, end in combinations([places[name] for name in member.points if name in places], 2):
            x, y = graph.across(np.array([start[0], end[0]])), graph.down(np.array([start[1], end[1]]))
            graph.paper.line(x, y, width=0.9, colour=_LINK)


def _within(graph: Graph, path: Array) -> tuple[Array, Array]:
    """Return a path with gaps where it leaves the graph."""
    x, y = path.T
    with np.errstate(invalid="ignore"):
        inside = (x > graph.x[0]) & (x < graph.x[1]) & (y > graph.y[0]) & (y < graph.y[1])
    return np.where(inside, x, np.nan), np.where(inside, y, np.nan)
