"""The list of figures of a slider-crank and of an engine, those of the torque and two constructions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import BrixPoints, brix_points, tangent_ends, tolle_parabola, tolle_points
from crankwork.locale import say
from crankwork.report.engine_figure_bearings import (
    big_end_polar,
    crankpin_load,
    crankpin_polar,
    crankpin_polar_of_one,
    crankpin_wear,
    main_journal_polar,
    main_wear,
    small_end_polar,
)
from crankwork.report.engine_figure_cylinder import (
    crankpin_forces,
    firings,
    indicator,
    kinematics,
    piston_forces,
    pressure,
    rod_forces,
    torque,
)
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.engine_figure_orders import (
    balance_ellipses,
    balance_orders,
    has_free_forces,
    phase_stars,
    torque_harmonics,
)
from crankwork.report.figure_data import kind_of
from crankwork.report.language import row_name
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet, small_text
from crankwork.show.labels import label_marks, mark_point
from crankwork.show.paper import BLACK, GREY, Canvas
from crankwork.show.place import current_layout, scaled_height
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing, Style

_MANY, _FIRING = 8, 15.0
_PANEL_GAP, _NAMES = 15.0, 24.0
_THIN, _NAMED = 0.8, 1.3
# of the torques of cylinders, and what is lighter than black
_DASHES: tuple[Style, ...] = (DOTTED, DASH_DOT, (3.0, 2.0), (12.0, 2.0, 1.5, 2.0, 1.5, 2.0))
_LIGHTER = "#808080"
_SIDES = ("AC", "BD", "CD", "EF", "CF", "FD")
_STEP = 30.0
_CIRCLE, _MARGIN, _TITLES = 190.0, 26.0, 44.0


def total_torque(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque of each cylinder, thin, and their sum with its mean."""
    language, torque = engine.language, engine.diagrams.torque
    each = engine.shown("crank_torque", engine.diagrams.torques)
    shown = each if len(each) <= _MANY else each[:1]
    total = engine.shown("total_torque", torque.total(np.radians(engine.diagrams.degrees)))
    total[-1] = total[0]
    mean = float(engine.shown("mean_total_torque", engine.diagrams.excess.mean_torque))
    mean = 0.0 if abs(mean) < 1e-9 * float(np.max(np.abs(total))) else mean
    rows = [
        Row(engine.named("total_torque"), width=_NAMED),
        Row(f"{engine.named('mean_total_torque')}, {engine.value('mean_total_torque', mean)}", DASHED),
        *_of_cylinders(engine, len(shown)),
        Row(f"▼ – {say('drawing.fires', language)}", width=0.0),
    ]
    paper, box = sheet(225.0 + _FIRING, rows)
    box = box._replace(top=box.top + _FIRING, height=box.height - _FIRING)
    graph = over_cycle(paper, box, limits(total, shown), engine.cycle, language)
    firings(engine, graph)
    for index, torque_curve in enumerate(shown):
        style, colour = _look(index)
        graph.curve(f"cylinder_{index + 1}", engine.diagrams.degrees, torque_curve, style, width=_THIN, colour=colour)
    graph.curve("total", engine.diagrams.degrees, total, width=_NAMED)
    graph.level(mean, DASHED, "mean")
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(f"{engine.symbol('total_torque')}, {engine.symbol('crank_torque')}, {engine.unit('total_torque')}")
    if len(shown) > 1:
        peaks = [(index, int(np.argmax(torque_curve))) for index, torque_curve in enumerate(shown)]
        tips = [(str(k + 1), *graph.point(engine.diagrams.degrees[peak], shown[k][peak])) for k, peak in peaks]
        label_marks(paper, tips, size=7.5, dot=1.2, frame=graph.box)
    return paper, {"total_torque": graph}


def _look(cylinder: int) -> tuple[Style, str]:
    """Return dashes and shade of the torque of a cylinder, no two alike of as many as are shown."""
    return _DASHES[cylinder % len(_DASHES)], (BLACK, _LIGHTER)[cylinder // len(_DASHES)]


def _of_cylinders(engine: EngineDrawn, count: int) -> list[Row]:
    """Return the legend of the torques of so many cylinders, one line for each dash pattern."""
    rows = []
    for first in range(min(count, len(_DASHES))):
        numbers = ", ".join(str(index + 1) for index in range(first, count, len(_DASHES)))
        key = "drawing.cylinders" if "," in numbers else "drawing.cylinder"
        which = say(key, engine.language, number=numbers)
        other = _LIGHTER if "," in numbers else ""
        rows.append(Row(f"{engine.named('crank_torque')}, {which}", _DASHES[first], _THIN, other=other))
    return rows


def accumulated_torque(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque on every main journal that carries some, in panels of one scale."""
    journals = engine.shown("journal_torque", engine.diagrams.journal_torques)
    height = scaled_height(max(52.0, min(110.0, 560.0 / len(journals))))
    paper = Canvas(current_layout().width, TOP + len(journals) * height + (len(journals) - 1) * _PANEL_GAP + BOTTOM)
    graphs, ends, top = {}, limits(journals), TOP
    for index, values in enumerate(journals):
        is_last = index == len(journals) - 1
        box = ChartBox(current_layout().left, top, current_layout().inner, height)
        graph = over_cycle(paper, box, ends, engine.cycle, engine.language, numbers=is_last)
        graph.curve(f"journal_{index + 2}", engine.diagrams.degrees, values)
        graph.y_title(f"{engine.symbol('journal_torque')[:-1]}{index + 2}$, {engine.unit('journal_torque')}")
        name = row_name(f"main_journal.{index + 2}", engine.language)
        small_text(paper, graph.box.left + graph.box.width - 3, box.top - 2, name, "end")
        graphs[str(index + 2)] = graph
        top += graph.box.height + _PANEL_GAP
    graph.x_title(engine.title("crank_angle"))
    return paper, graphs


def excess_work(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the total torque less its mean, hatched where it gives energy, and below it the work of that."""
    language, excess = engine.language, engine.diagrams.excess
    angle = np.radians(engine.diagrams.degrees)
    surplus = engine.shown("total_torque", engine.diagrams.torque.total(angle) - excess.mean_torque)
    surplus[-1] = surplus[0]
    energy = engine.shown("excess_work", excess.curve(angle))
    upper, lower = scaled_height(120.0), scaled_height(150.0)
    paper = Canvas(current_layout().width, TOP + upper + _PANEL_GAP + lower + BOTTOM)
    box = ChartBox(current_layout().left, TOP, current_layout().inner, upper)
    torque = over_cycle(paper, box, limits(surplus), engine.cycle, language, numbers=False)
    _hatch(torque, engine.diagrams.degrees, surplus)
    torque.curve("surplus", engine.diagrams.degrees, surplus)
    torque.y_title(
        f"{engine.symbol('total_torque')} − {engine.symbol('mean_total_torque')}, {engine.unit('total_torque')}"
    )
    box = box._replace(top=TOP + torque.box.height + _PANEL_GAP, height=lower)
    # room for names above and below
    low, high = limits(energy, margin=max(0.16, _NAMES / lower))
    graph = over_cycle(paper, box, (low, high), engine.cycle, language)
    graph.curve("energy", engine.diagrams.degrees, energy)
    extremes = excess.curve.extremes()
    unit_less = [float(engine.shown("excess_work", value_si)) for value_si in (extremes.largest, extremes.least)]
    for name, value, place in zip(("max", "min"), unit_less, (extremes.at_largest, extremes.at_least), strict=True):
        graph.level(value, DASH_DOT, f"level_{name}")
        symbol = engine.symbol("excess_work")[:-1]
        sign = f"{symbol}{',' if '_' in symbol else '_'}{name}$"
        mark_point(graph, name, float(np.degrees(place)), value, sign)
    place = 0.5 * engine.cycle * (0.02 if np.degrees(extremes.at_largest) > 0.1 * engine.cycle else 1.9)
    _span(graph, place, unit_less, f"{engine.symbol('excess_work')} = {engine.value('excess_work', excess.work)}")
    engine.name_axes(graph, "crank_angle", "excess_work")
    return paper, {"torque": torque, "energy": graph}


def _hatch(graph: Graph, degrees: Array, values: Array) -> None:
    """Hatch what lies over the horizontal axis."""
    angles = np.arange(0.0, degrees[-1], degrees[-1] / 144)
    over = np.interp(angles, degrees, values)
    x, y, zero = graph.across(angles), graph.down(over), float(graph.down(0.0))
    kept = over > 0
    graph.paper.segments(np.column_stack([x, np.full_like(x, zero), x, y])[kept], width=0.5, colour=GREY)


def _span(graph: Graph, angle: float, ends: list[float], text: str) -> None:
    """Draw a double arrow between two levels with a text above the graph, where no curve is."""
    x = float(graph.across(angle))
    top, bottom = (float(graph.down(end)) for end in ends)
    graph.paper.arrow((x, (top + bottom) / 2), (x, top), width=0.8)
    graph.paper.arrow((x, (top + bottom) / 2), (x, bottom), width=0.8)
    graph.paper.text(x, graph.box.top - 5, text, size=8.5, anchor="start" if angle < graph.x[1] / 2 else "end")


def crank_speed(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the angular speed over the cycle with its mean and its extremes."""
    language, speed = engine.language, engine.diagrams.torque.speed
    if speed is None:
        raise TypeError("this engine has no moment of inertia that its speed would follow from")
    values = engine.shown("crank_speed", speed.speed(np.radians(engine.diagrams.degrees)))
    mean = float(engine.shown("speed", engine.results.solved.speed))
    rows = [
        Row(engine.named("crank_speed")),
        Row(
            f"{engine.symbol('speed')} – {say('report.mean', language)},"
            f" {engine.value('speed', engine.results.solved.speed)}",
            DASHED,
        ),
        Row(f"{engine.named('speed_fluctuation')}, {engine.number(speed.fluctuation, 4)}", width=0.0),
    ]
    paper, box = sheet(200.0, rows)
    room = 0.16 * float(np.ptp(values))
    graph = over_cycle(paper, box, (float(values.min()) - room, float(values.max()) + room), engine.cycle, language)
    graph.curve("speed", engine.diagrams.degrees, values)
    graph.level(mean, DASHED, "mean")
    ends = speed.extremes
    for name, value, angle in (("max", ends.largest, ends.at_largest), ("min", ends.least, ends.at_least)):
        text = f"{engine.symbol('speed')[:-1]}_{name}$ = {engine.value('crank_speed', value, 5)}"
        mark_point(graph, name, float(np.degrees(angle)), float(engine.shown("crank_speed", value)), text)
    engine.name_axes(graph, "crank_angle", "crank_speed")
    return paper, {"crank_speed": graph}


def brix(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
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
        Row(f"{say('drawing.brix_circle', engine.language)} OO′ = {half} = {shift}"),
        Row(
            say("drawing.brix_error", engine.language, symbol=engine.symbol("piston_displacement"), value=difference),
            width=0.0,
        ),
    ]
    side = min(scaled_height(_CIRCLE), 0.45 * current_layout().width)
    height = side * max(1.0, float(exact.max()) / (2 * radius))
    paper, box = sheet((height + _MARGIN - 10) / current_layout().tall, rows)
    top = box.top + _MARGIN - 14
    left = _MARGIN + side + _MARGIN - 6 + _TITLES
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
    graph.frame(np.arange(0.0, 361.0, 60.0), ticks)
    graph.curve("displacement", degrees, exact)
    graph.curves["construction"] = degrees, radius * (1 - circle.up)
    graph.x_title(engine.title("crank_angle"))
    title = engine.title("piston_displacement")
    graph.set_quantity(title)
    paper.text(current_layout().width - current_layout().right, top - 10, title, anchor="end")
    return paper, {"circle": ring, "displacement": graph}


def _rays(engine: EngineDrawn, ring: Graph, points: BrixPoints, radius: float, marks: Array) -> None:
    """Draw the circle with its axes, the rays from the pole and their angles."""
    around = np.radians(np.arange(0.0, 361.0, 3.0))
    ring.curve("circle", radius * np.sin(around), radius * np.cos(around))
    axis = -points.pole / np.hypot(*points.pole) * radius * 1.08
    for x, y in (axis, (axis[1], -axis[0])):
        ring.paper.line(ring.across(np.array([-x, x])), ring.down(np.array([-y, y])), style=DASH_DOT, width=0.6)
    pole = radius * points.pole
    x, y = ring.across(radius * points.across), ring.down(radius * points.up)
    start = ring.point(float(pole[0]), float(pole[1]))
    centre = ring.point(0.0, 0.0)
    ring.paper.segments(np.column_stack([np.full_like(x, start[0]), np.full_like(y, start[1]), x, y]), width=0.6)
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
            graph.paper.segments(np.array([[x, y, end, y]]), width=0.5, colour=GREY)
            graph.paper.dot(end, y, 1.4)


def tolle(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
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
        Row(say("drawing.tangents", engine.language), width=0.5),
    ]
    differs = float(np.max(np.abs(np.interp(x, *parabola) - y))) > 2e-3 * unit
    if differs:
        rows.insert(1, Row(say("drawing.parabola", engine.language), DOTTED, 1.0))
    paper, box = sheet(270.0, rows)
    low, high = limits(np.array([corner[1] for corner in corners.values()]), y, margin=0.09)
    room = 0.04 * 2 * radius
    graph = Graph(paper, box, (-room, max(2 * radius, float(x.max())) + room), (low, high), engine.language)
    graph.frame(round_ticks(0.0, graph.x[1], 8), round_ticks(low, high, 9))
    tangents = tangent_ends(corners["C"], corners["F"], corners["D"])
    ends = np.column_stack([graph.across(tangents[:, 0]), graph.down(tangents[:, 1]),
                            graph.across(tangents[:, 2]), graph.down(tangents[:, 3])])  # fmt: skip
    paper.segments(ends, width=0.5)
    graph.curves["tangents"] = tangents[:, [0, 2]], tangents[:, [1, 3]]
    for first, second in map(tuple, _SIDES):
        pair = np.array([corners[first], corners[second]])
        graph.curve(first + second, pair[:, 0], pair[:, 1], DASHED if first + second == "CD" else SOLID, width=0.7)
    graph.curves["parabola"] = parabola
    if differs:
        graph.curve("parabola", *parabola, DOTTED, width=1.0)
    graph.curve("acceleration", x, y, width=1.6)
    places = [(name, *graph.point(*place)) for name, place in corners.items()]
    label_marks(paper, [*places, *_numbered(graph, tangents)], frame=box)
    graph.x_title(engine.title("piston_displacement"))
    graph.y_title(engine.title("piston_acceleration"), 48.0)
    return paper, {"tolle": graph}


def _numbered(graph: Graph, tangents: Array) -> list[tuple[str, float, float]]:
    """Return the parts of the two outer tangents with their numbers, where they stand on the paper."""
    numbered = [(f"{index}", *graph.point(*row[:2])) for index, row in enumerate(tangents.tolist(), start=1)]
    return numbered + [(f"{index}′", *graph.point(*row[2:])) for index, row in enumerate(tangents.tolist(), start=1)]


Draw = Callable[[EngineDrawn], tuple[Canvas, Mapping[str, Graph]]]
# what draws it, and the column it needs
_ONE_CYLINDER: dict[str, tuple[Draw, str]] = {
    "kinematics": (kinematics, "piston_displacement"),
    "brix": (brix, "piston_displacement"),
    "tolle": (tolle, "piston_displacement"),
    "pressure": (pressure, "gas_pressure"),
    "indicator": (indicator, "gas_pressure"),
    "piston_forces": (piston_forces, "piston_force"),
    "rod_forces": (rod_forces, "rod_force"),
    "crankpin_forces": (crankpin_forces, "tangential_force"),
    "torque": (torque, "crank_torque"),
    "crankpin_polar": (crankpin_polar_of_one, "tangential_force"),
}
_LOADS: dict[str, Draw] = {
    "crankpin_load": crankpin_load,
    "big_end_polar": big_end_polar,
    "small_end_polar": small_end_polar,
    "main_journal_polar": main_journal_polar,
    "crankpin_wear": crankpin_wear,
    "main_wear": main_wear,
}
_OF_FORCES = ("piston_forces", "rod_forces", "crankpin_forces", "crankpin_polar", *_LOADS)


def engine_pictures(engine: EngineDrawn) -> dict[str, Callable[[], Drawing]]:
    """Return the functions that draw the figures of a machine in the current layout."""
    listed = figure_list(engine)
    numbered = {name.rstrip("0123456789") for name in listed}

    def picture(name: str, draw: Draw) -> Drawing:
        kind = kind_of(name)
        # of several crankpins the first has a number too
        first = next(iter(engine.diagrams.pin_sizes[1]), "1") if f"{name}_" in numbered else ""
        title = f"{name}_{first}" if first else name
        return engine.finished(title, draw(engine)[0], _remark(engine, kind), forces=kind in _OF_FORCES)

    return {name: partial(picture, name, draw) for name, draw in listed.items()}


def figure_list(engine: EngineDrawn) -> dict[str, Draw]:
    """Return the functions that draw the figures of a machine."""
    machine, columns = engine.results.machine, engine.columns
    result = {name: draw for name, (draw, key) in _ONE_CYLINDER.items() if key in columns}
    if machine.engine is None or "crank_torque" not in columns:
        return result
    result |= _polars(engine) | _LOADS
    if engine.diagrams.count > 1:
        result["total_torque"] = total_torque
    if engine.diagrams.has_throws:
        result["accumulated_torque"] = accumulated_torque
    result["excess_work"] = excess_work
    if engine.diagrams.torque.speed is not None:
        result["crank_speed"] = crank_speed
    result["torque_harmonics"] = torque_harmonics
    if engine.diagrams.count > 1:
        result["phase_stars"] = phase_stars
    result["balance_orders"] = balance_orders
    if has_free_forces(engine):
        result["balance_ellipses"] = balance_ellipses
    return result


def _polars(engine: EngineDrawn) -> dict[str, Draw]:
    """Return the polar diagram of every unlike crankpin; the first has no number."""

    def of_pin(pin: str) -> Draw:
        return lambda engine_: crankpin_polar(engine_, pin)

    pins = list(engine.diagrams.pin_sizes[1])
    return {"crankpin_polar" if index == 0 else f"crankpin_polar_{pin}": of_pin(pin) for index, pin in enumerate(pins)}


def _remark(engine: EngineDrawn, kind: str) -> str:
    """Return the remark at the lower left of a figure: the frame of its vectors."""
    frames = {
        "crankpin_polar": "crank_up",
        "big_end_polar": "rod_up",
        "small_end_polar": "rod_up",
        "main_journal_polar": "crank_one",
    }
    if kind == "kinematics" and "piston_velocity_first_order" in engine.columns:
        return say("drawing.orders", engine.language)
    return say(f"drawing.{frames[kind]}", engine.language) if kind in frames else ""
