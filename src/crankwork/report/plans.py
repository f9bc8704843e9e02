"""Plans as figures: positions of a linkage, and vectors of velocities and accelerations to scale."""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.sampled_motion import SampledMotion, sample_motion
from crankwork.analysis.skeleton import MovingFrame, Skeleton, skeleton
from crankwork.analysis.vector_polygons import Kind, Vector, VectorPolygon, accelerations, velocities
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities import Language
from crankwork.report.display import symbol
from crankwork.report.drawn_links import HATCH, SLOT, Rail, Scene, corners, scene, slot_middle, walls
from crankwork.report.look import (
    PLAIN,
    Style,
    draw_rotation,
    draw_scale,
    figure_title,
    key_of_links,
    math_symbol,
    position_sign,
    position_text,
    scale_text,
)
from crankwork.show.canvas import (
    BLACK,
    FINE,
    WIDER,
    Canvas,
    current_layout,
    font_size,
    is_narrow,
    plain,
    points_per_mm,
    round_scale,
    scaled_height,
    text_width,
)
from crankwork.show.chart import ChartBox, Graph, write_remark
from crankwork.show.label_placement import label_marks, label_points
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, Drawing
from crankwork.show.scene import Style as Dashes

_TALL, _MARGIN, _LIST_WIDTH, _LIST, _ROW = 330.0, 26.0, 170.8, 150.0, 13.5
# height of a plan beside another one at most, of the width that it has
_EVEN = 1.3
# height of a plan at least, and how many points that lie beneath others are explained
_LOWEST, _UNDER = 40.0, 3
# a linkage whose points have velocities or accelerations a billionth of this stands still
_STILL = 1e-3
# of the largest value of a plan, what is none beside it
_ZERO = 1e-5
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
_STEP = 2.0
# steps of the plans of a crank that swings; that of one that turns is the last
_STEPS, _WIDEST_STEP, _MOST = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0), 30.0, 12
_POSITION_MARGIN, _FOOT = 24.0, 50.0
_TALLEST = 560.0
# points whose places have the numbers of the plans; of more nobody could tell which number is whose
_NUMBERED = 6
_THIN, _BLOCK, WHITE = "#8c8c8c", "#d9d9d9", "#ffffff"
# size of the numbers beside guides, and places so near that their numbers stand together [pt]
_NUMBER, _TOGETHER = 8.0, 2.5
# of names of points [pt], what is free about them, and where they stand at a support [units of the picture]
_LETTER, _CLEAR, _BY_SUPPORT = 9.0, 6.0, ((0.0, -33.0), (-24.0, -16.0), (24.0, -16.0))
# parts are drawn smaller than on a screen: units of the picture in a point of the paper
_UNITS = 1.5


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
    """Draw a plan, and beside it the values of its vectors and the angular rates of the links.

    Those that stand at one place by turns have no number: each has all rows, and room for the largest.
    """
    language, seen, size = style.language, _seen(plan), size_of(plan)
    by_turns = position is None and bool(among)
    if by_turns:
        size, among = (max(width for width, _ in among), max(height for _, height in among)), ()
    # only beside one plan there is room for a list
    has_list = position is None and not is_narrow()
    side = current_layout().width - (_LIST_WIDTH if has_list else 0.0)
    rows = [] if position is not None else [
        *_rows(plan.vectors if by_turns else seen, plan, kind, language, all_turning=by_turns),
        *key_of_links(dict(enumerate(style.links, start=1)), plan.turning, style.language),
    ]  # fmt: skip
    # long names stand beside the outermost ends, those of one end together
    ends: dict[tuple[float, ...], str] = {}
    for name, node in plan.nodes.items():
        place = tuple(np.round(node / max(_longest(plan), 1e-12), 3).tolist())
        ends[place] = f"{ends[place]}, {node_name(name)}" if place in ends else node_name(name)
    margin = max([_MARGIN, *(WIDER * text_width(plain(text), 8.0) + 12 for text in ends.values())])
    margin = side if by_turns else margin
    listed = _ROW * len(rows) if has_list else 0.0
    high = max(scaled_height(_TALL), listed)
    wide = side - 2 * min(margin, side / 8)
    # plans beside each other are about as large, however they lie
    room = wide, max(min(high - 2 * _MARGIN, _EVEN * wide if position is not None else math.inf), _LOWEST)
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


def _rows(
    vectors: list[Vector], plan: VectorPolygon, kind: _Kind, language: Language, *, all_turning: bool
) -> list[str]:
    """Return the magnitudes of the vectors and the turning of the links; `all_turning`: of all that turn somewhere."""
    rows, unit, least = [], unit_name(kind.unit, language), _ZERO * _longest(plan)
    for vector in vectors:
        mark = vector_mark(vector.kind, language) if kind.sign == "a" else ""
        name = math_symbol(f"{kind.sign}_{vector.name}", mark)
        rows.append(f"{name} = {_four_digits(vector.length if vector.length > least else 0.0, language)} {unit}")
    unit = unit_name(kind.turning_unit, language)
    least = _ZERO * max(kind.size, *(abs(rate) for rate in plan.turning.values()))
    for link, value in plan.turning.items():
        if abs(value) > least or (all_turning and value):
            name = math_symbol(f"{kind.turning}_{link}")
            rows.append(f"{name} = {_four_digits(value if abs(value) > least else 0.0, language)} {unit}")
    return rows


def vector_mark(kind: Kind, language: Language) -> str:
    """Return what stands over the symbol of an acceleration of a kind: `^n` of a normal one."""
    return _MARKS[kind].format(translate("marks.tangential", language))


def _four_digits(value: float, language: Language) -> str:
    """Return a value to four digits, without a power of ten if it has no more than six."""
    return number(float(f"{value:.4g}"), language)


class _Sheet(NamedTuple):
    """A graph in units of the picture, with the parts at all angles and the indices of the plans."""

    graph: Graph
    drawn: Scene
    plans: list[int]
    main: int


def position_plans(
    mechanism: Mechanism,
    ends: tuple[float, float] | None = None,
    worked: float = _WIDEST_STEP,
    style: Style = PLAIN,
    step: float = _WIDEST_STEP,
) -> Drawing:
    """Return the position plans of a linkage over each other, numbered from 0.

    `ends`: crank angles between which a crank swings that does not turn fully [deg]; `worked`: near what crank angle
    the plan is that is drawn bold, with names of points; `step`: of a crank that turns [deg].
    """
    shape = skeleton(mechanism, style.links)
    first, last = ends or (0.0, mechanism.period)
    if ends is not None:
        step = next(size for size in _STEPS if (last - first) / size <= _MOST or size == _WIDEST_STEP)
    degrees = step * np.arange(math.ceil(first / step), math.ceil(last / step))
    if not degrees.size:
        degrees = np.array([(first + last) / 2])
    main = int(np.argmin(np.abs(degrees - worked)))
    moved = sample_motion(mechanism, np.union1d(np.append(np.arange(first, last, _STEP), last), degrees))
    plans = [int(np.argmin(np.abs(moved.degrees - angle))) for angle in degrees]
    drawn, paper = _scaled(shape, moved)
    sheet = _sheet(drawn, plans, main, style)
    _ground(sheet)
    for plan in plans:
        if plan != plans[main]:
            _plan(sheet, plan, is_main=False)
    _paths(sheet, shape.coupler_points)
    _plan(sheet, plans[main], is_main=True)
    _texts(sheet, list(_number_guides(sheet)))
    if ends is None and shape.pin:
        _rotation(sheet)
    foot, hand = sheet.graph.box.height - 20, sheet.graph.paper
    draw_scale(hand, (0.03 * hand.width, foot), ("μ_l", paper, "mm"), style.language)
    shown = f"{position_sign(style, f'_{main}')} = {position_text(float(degrees[main]), style)}"
    hand.text(0.97 * hand.width, foot, shown, anchor="end")
    made = hand.drawing(figure_title("position_plans", style.language), style.language)
    return made._replace(plots=tuple(plot._replace(metre=1e3 / paper) for plot in made.plots))


def _sheet(drawn: Scene, plans: list[int], main: int, style: Style) -> _Sheet:
    """Return an empty sheet that holds the linkage at all angles, with a foot for the scale."""
    places = _seen_positions(drawn)
    (left, bottom), (right, top) = places.min(axis=0) - _POSITION_MARGIN, places.max(axis=0) + _POSITION_MARGIN
    margin = max(0.0, _UNITS * current_layout().width - (right - left)) / 2
    left, right, bottom = left - margin, right + margin, bottom - _FOOT
    box = ChartBox(0.0, 0.0, (right - left) / _UNITS, (top - bottom) / _UNITS)
    paper = Canvas(box.width, box.height)
    graph = Graph(paper, box, (left, right), (bottom, top), style.language, to_scale=False)
    return _Sheet(graph, drawn, plans, main)


def _scaled(shape: Skeleton, moved: SampledMotion) -> tuple[Scene, float]:
    """Return a linkage as large as its paper takes it, and how many of its millimetres are one of paper."""
    room = _UNITS * (current_layout().width - 2 * _POSITION_MARGIN)
    drawn, scale = scene(shape, moved, room)
    # walls, supports and pieces are as large at any scale, so that what joins their middles is less than all
    paper = round_scale(_UNITS * points_per_mm() * 1e3 / scale, FINE)
    while True:
        drawn, _ = scene(shape, moved, room * _UNITS * points_per_mm() * 1e3 / paper / scale)
        if np.all(
            np.ptp(_seen_positions(drawn), axis=0)
            <= _UNITS * np.array([current_layout().width - _POSITION_MARGIN, scaled_height(_TALLEST)])
        ):
            return drawn, paper
        paper = round_scale(1.01 * paper, FINE)


def _seen_positions(drawn: Scene) -> Array:
    """Return places that the parts of a linkage reach, without points of which nothing is drawn."""
    shape = drawn.skeleton
    named = {*shape.letters, *shape.pivots, *shape.coupler_points}
    return corners(drawn._replace(points={name: point for name, point in drawn.points.items() if name in named}))


def _ground(sheet: _Sheet) -> None:
    """Draw guides and pivots, hatched."""
    for rail in sheet.drawn.rails:
        ends = np.array([rail.line.place(end)[0] for end in (rail.start - 14, rail.end + 14)])
        _line_of(sheet.graph, ends, width=0.45, style=DASH_DOT)
        for wall in walls(rail):
            _hatched(sheet.graph, *wall)
    for name in sheet.drawn.skeleton.pivots:
        x, y = sheet.drawn.points[name][0]
        _area_of(sheet.graph, np.array([[x, y], [x - 13, y - 24], [x + 13, y - 24]]), WHITE)
        _hatched(sheet.graph, np.array([x + 20, y - 24]), np.array([x - 20, y - 24]))


def _line_of(graph: Graph, points: Array, *, width: float, style: Dashes = SOLID, colour: str = BLACK) -> None:
    graph.paper.line(graph.across(points[:, 0]), graph.down(points[:, 1]), width=width, style=style, colour=colour)


def _area_of(graph: Graph, points: Array, fill: str) -> None:
    graph.paper.area(graph.across(points[:, 0]), graph.down(points[:, 1]), fill=fill, width=0.9)


def _hatched(graph: Graph, start: Array, end: Array) -> None:
    """Draw a wall, hatched on the left of the way from start to end."""
    length = float(np.hypot(*(end - start)))
    ahead = (end - start) / length
    slant = HATCH * (np.array([-ahead[1], ahead[0]]) - ahead)
    _line_of(graph, np.array([start, end]), width=0.9)
    feet = start + np.arange(HATCH, length + 0.1, HATCH)[:, None] * ahead
    ends = [side(row[:, axis]) for row in (feet, feet + slant) for axis, side in ((0, graph.across), (1, graph.down))]
    graph.paper.segments(np.column_stack(ends), width=0.45)


def _plan(sheet: _Sheet, row: int, *, is_main: bool) -> None:
    """Draw the linkage at one crank angle."""
    colour, width = (BLACK, 0.9) if is_main else (_THIN, 0.45)
    graph = sheet.graph
    for bar in sheet.drawn.bars:
        nodes = np.array([node[row] for node in (*bar.nodes, bar.nodes[0])])
        _line_of(graph, nodes, width=width, colour=colour)
    for slot in sheet.drawn.slots:
        middle, half = slot_middle(slot)
        if is_main:
            _rectangle(graph, MovingFrame(middle, slot.line.along), (half, SLOT), row, WHITE)
        else:
            ends = np.array([slot.line.place(end)[row] for end in (slot.start, slot.end)])
            _line_of(graph, ends, width=width, colour=colour)
    for block in sheet.drawn.blocks:
        if is_main:
            _rectangle(graph, block.pose, block.half, row, _BLOCK)
    joints = [place[row] for name, place in sheet.drawn.points.items() if name in sheet.drawn.skeleton.letters]
    for x, y in joints:
        place = graph.point(float(x), float(y))
        if is_main:
            graph.paper.dot(*place, 2.5, fill=WHITE, width=0.9)
        else:
            graph.paper.dot(*place, 0.9, fill=_THIN)


def _rectangle(graph: Graph, pose: MovingFrame, half: tuple[float, float], row: int, fill: str) -> None:
    u, v = half
    _area_of(graph, np.array([pose.place(x, y)[row] for x, y in ((u, v), (-u, v), (-u, -v), (u, -v))]), fill)


def _rotation(sheet: _Sheet) -> None:
    """Draw an arrow about the pivot of the crank, in the sense in which its angle grows."""
    drawn, row = sheet.drawn, sheet.plans[sheet.main]
    pivot = drawn.points[next(iter(drawn.skeleton.pivots))][0]
    # above the pivot, whose name stands below
    draw_rotation(sheet.graph, pivot, drawn.points[drawn.skeleton.pin][[row, row + 1]] - pivot)


def _paths(sheet: _Sheet, names: Sequence[str]) -> None:
    """Draw the paths of the crank pin and of the coupler points."""
    for name in (*([sheet.drawn.skeleton.pin] if sheet.drawn.skeleton.pin else []), *names):
        _line_of(sheet.graph, sheet.drawn.points[name], width=0.45, style=DASH_DOT)


def _number_guides(sheet: _Sheet) -> Iterator[str]:
    """Number fixed guides and yield what slides there; where pieces share a stretch, the numbers are of the first."""
    numbered = list[Rail]()
    guide = {member.name: member.guide for member in sheet.drawn.skeleton.members}
    for rail in sheet.drawn.rails:
        if any(
            guide[rail.name] == guide[one.name] and rail.start < one.end and one.start < rail.end for one in numbered
        ):
            yield rail.name
        elif _number_guide(sheet, rail):
            numbered.append(rail)
            yield rail.name


def _number_guide(sheet: _Sheet, rail: Rail) -> bool:
    """Write the numbers of the plans beside a fixed guide, those of the way there on one side, of the way back on one.

    Numbers of places that fall together stand together. Return whether what slides there has a point to number.
    """
    member = sheet.drawn.skeleton.member(rail.name)
    if not member.points or member.has_rod:
        return False
    track = rail.line.seen(sheet.drawn.points[member.points[0]])[:, 0]
    seen, ahead = track[sheet.plans], np.gradient(track)[sheet.plans] > 0
    for side, chosen in ((1, ahead), (-1, ~ahead)):
        together: list[list[int]] = []
        for index in sorted(np.flatnonzero(chosen).tolist(), key=lambda plan: float(seen[plan])):
            if together and seen[index] - seen[together[-1][0]] < _TOGETHER * _UNITS:
                together[-1].append(index)
            else:
                together.append([index])
        numbers = [(", ".join(map(str, sorted(group))), float(seen[group[0]])) for group in together]
        _write_along(sheet, rail, side, numbers)
    return True


def _write_along(sheet: _Sheet, rail: Rail, side: int, numbers: Sequence[tuple[str, float]]) -> None:
    """Write numbers in a row along a guide, each with a line from the wall at its place on the guide."""
    x, y = rail.line.along[0]
    wide = max((text_width(text, _NUMBER) for text, _ in numbers), default=0.0) + 3.0
    spacing = min(wide / max(abs(x), 1e-9), 1.15 * font_size(_NUMBER) / max(abs(y), 1e-9)) * _UNITS
    wall = rail.half + HATCH
    out = wall + _UNITS * (8.0 + abs(y) * wide / 2 + abs(x) * 0.5 * font_size(_NUMBER))
    for (text, position), place in zip(numbers, _spread([position for _, position in numbers], spacing), strict=True):
        ends = [rail.line.place(*end)[0] for end in ((position, side * wall), (place, side * (0.6 * wall + 0.4 * out)))]
        sheet.graph.paper.line(*np.array([sheet.graph.point(*end) for end in ends]).T, width=0.45, colour=_THIN)
        middle = sheet.graph.point(*rail.line.place(place, side * out)[0])
        sheet.graph.text_on_white(middle[0], middle[1] + 0.35 * font_size(_NUMBER), text, "middle", _NUMBER)


def _spread(places: Sequence[float], spacing: float) -> list[float]:
    """Return places in order moved no nearer than a distance, as little as can be."""
    groups = [[place, 1] for place in places]
    # groups that touch become one about their common middle
    index = 0
    while index + 1 < len(groups):
        (first, count), (second, more) = groups[index], groups[index + 1]
        if second - first < spacing * (count + more) / 2:
            groups[index : index + 2] = [[(first * count + second * more) / (count + more), count + more]]
            index = max(index - 1, 0)
        else:
            index += 1
    return [middle + (rank - (count - 1) / 2) * spacing for middle, count in groups for rank in range(int(count))]


def _texts(sheet: _Sheet, numbered_guides: Container[str]) -> None:
    """Write names of points at the bold plan, and the numbers of the plans at points that show the motion."""
    drawn, plans = sheet.drawn, sheet.plans
    row = plans[sheet.main]
    named = {letter: drawn.points[name][row] for name, letter in reversed([*drawn.skeleton.letters.items()])
             if name in drawn.points}  # fmt: skip
    # in their order: that of a set is another one in every process
    pivots = dict.fromkeys(drawn.skeleton.letters.get(name, "") for name in drawn.skeleton.pivots)
    places = {letter: _place_of_name(sheet, letter, named[letter]) for letter in pivots if letter in named}
    supports = {letter: place for letter, place in places.items() if place is not None}
    for letter, (x, y) in supports.items():
        # other names keep clear of it
        wide, high = _half(letter) / _UNITS
        sheet.graph.paper.texts.append((letter, x - wide, y - high, x + wide, y + high))
    marks = [
        (_slanted(letter), *sheet.graph.point(*place)) for letter, place in named.items() if letter not in supports
    ]
    label_marks(sheet.graph.paper, marks, size=_LETTER, dot=0.0)
    numbered = [drawn.skeleton.driven] if drawn.skeleton.driven else []
    slides = [member for member in drawn.skeleton.members if member.guide and not member.guide.link and member.points]
    numbered += [slide.points[0] for slide in slides if slide.name not in numbered_guides]
    # what is on a sliding piece goes as its joint does
    couplers = [name for name in drawn.skeleton.coupler_points if not any(name in slide.points for slide in slides)]
    numbered += couplers[: max(_NUMBERED - len(numbered), 0)]
    points = [
        (str(count), float(drawn.points[name][plan, 0]), float(drawn.points[name][plan, 1]))
        for name in dict.fromkeys(numbered)
        for count, plan in enumerate(plans)
    ]
    label_points(sheet.graph, points)
    for letter, (x, y) in supports.items():
        sheet.graph.text_on_white(x, y + 0.35 * font_size(_LETTER), _slanted(letter), "middle", _LETTER)


def _half(letter: str) -> Array:
    """Return half the width and height of the name of a point. [units of the picture]"""
    return _UNITS * np.array([text_width(_slanted(letter), _LETTER) / 2 + 2, 0.6 * font_size(_LETTER)])


def _place_of_name(sheet: _Sheet, letter: str, place: Array) -> tuple[float, float] | None:
    """Return where the name of a fixed joint stands under its support or beside it, unless bold links are there."""
    row, drawn = sheet.plans[sheet.main], sheet.drawn
    bold = [np.array([node[row] for node in (*bar.nodes, bar.nodes[0])]) for bar in drawn.bars]
    shares = np.linspace(0.0, 1.0, 60)[:, None]
    lines = [start + shares * (end - start) for outline in bold for start, end in pairwise(outline)]
    slots = [slot.line.place(end)[row] for slot in drawn.slots for end in np.linspace(slot.start, slot.end, 60)]
    seen = np.vstack([*lines, *slots, *(block.pose.origin[row] for block in drawn.blocks)])
    half = _half(letter)
    for foot in _BY_SUPPORT:
        offset = np.sign(foot[0]) * half[0], -half[1] * (foot[0] == 0)
        middle = place + np.array(foot) + offset
        if not np.any(np.all(np.abs(seen - middle) < half + _CLEAR, axis=1)):
            return sheet.graph.point(*middle)
    return None


def _slanted(name: str) -> str:
    """Return the name of a point in slanted letters, where none of them would mark something."""
    return f"${name}$" if name.isalnum() else plain(name)
