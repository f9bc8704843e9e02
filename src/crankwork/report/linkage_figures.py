"""The figures of a drawn linkage, and of what is reduced to a driver: curves, centrodes, force polygons."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import combinations, pairwise

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.chambers import indicators
from crankwork.analysis.diagrams import Fluctuation
from crankwork.analysis.force_plans import ForcePlan, PlanForce, force_plans
from crankwork.analysis.moving import Frame, moving, reached_angles
from crankwork.analysis.plans import DriverRates, driver_rates, worked_position
from crankwork.analysis.rounding import without_rounding
from crankwork.analysis.skeleton import Member, skeleton
from crankwork.errors import CrankworkError
from crankwork.formula.known import Found, breaks_of
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Mechanism
from crankwork.mechanism.structure import structure
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.report.figure_data import figure_title
from crankwork.report.language import label, symbol
from crankwork.report.linkage_bearings import bearing_pictures
from crankwork.report.linkage_energy import speed_curve, wittenbauer
from crankwork.report.linkage_lever import lever_figure
from crankwork.report.linkage_look import (
    PLAIN,
    Style,
    axis_title,
    displayed_values,
    drive_graph,
    key_of_links,
    math_symbol,
    position_sign,
    position_text,
    quantity_of,
    scale_text,
)
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.report.summary import results_method
from crankwork.report.tables import any_nonzero
from crankwork.show.chart import (
    BOTTOM,
    DOT,
    TOP,
    ChartBox,
    Graph,
    Row,
    legend,
    legend_height,
    limits,
    round_ticks,
    sheet,
    write_method,
)
from crankwork.show.labels import label_marks, mark_point
from crankwork.show.paper import GREY, Canvas, plain
from crankwork.show.place import FINE, current_layout, points_per_mm, round_scale, scaled_height
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing

_DENSE_STEP = 2.0
_PER_PANEL = 4
# behind a corner, where there may be a jump [deg]
_AFTER = 1e-6
Pictures = dict[str, Callable[[], Drawing]]
STYLES = (SOLID, DASHED, DASH_DOT, DOTTED)
_ALONE, _PANEL, _GAP = 216.0, 126.0, 16.0
# what a page of a note holds with its caption [pt]
_TALLEST = 600.0
# characters of a name that still fit beside a panel
_LONG = 20
# what tells where something is
_PLACES = ("slider_displacement", "driver_displacement", "driver_angle", "link_angle", "point_x", "point_y")
# curves nearer than this share of the range fall together in print
_SAME, _ROUNDING = 0.003, 1e-9
_HIGH, _AROUND, _LINK = 300.0, 0.6, "#8c8c8c"
# dashes that short centrodes show, too
_ROLLING = (3.0, 1.5)
# how much of its way a centre must be near to be drawn, and how far it must go there
_SEEN, _SMALL = 0.3, 0.2
# a coupler that turns less than this share of the crank has its centre far away
_LEAST = 1e-6
_HEAD, _MARGIN, _LIST, _ROW, _FOOT = 16.0, 22.0, 150.0, 13.5, 34.0
# the tallest plan, and all of them together [pt]
_HIGHEST, _WHOLE = 230.0, 560.0
# a paper wider than this has two plans side by side [pt]
_TWO = 560.0
# how far apart forces are drawn that lie along each other, and what is as near as that [pt]
_LANE, _NEAR, _LANES = 6.0, 4.0, (0, 1, -1, 2, -2, 3, -3)
_LOAD, _REACTION = 0.9, 1.6
# a group of fewer forces has no plan, only two that are equal
_FEWEST, _MOST = 3, 4


def linkage_pictures(results: Results, language: Language) -> Pictures:
    """Return the functions that draw the figures of a linkage in the current layout."""
    style = Style(language, (), results_method(results, language), results.period)
    if results.machine.linkage is None:
        columns = without_rounding(results.columns, results.machine.speed)
        return _dynamics(*_closed(results.grid.degrees, columns, results.machine.cycle), style)
    return _of_drawing(results, results.machine.linkage, style)


def _of_drawing(results: Results, linkage: Linkage, style: Style) -> Pictures:
    """Return the figures of a linkage that was drawn, between its dead positions."""
    machine, (drawn_structure, _) = results.machine, structure(linkage)
    ends = [results.summary[key] for key in ("crank_range_start", "crank_range_end") if key in results.summary]
    style = style._replace(
        links=drawn_structure.links if drawn_structure is not None else (), limits=tuple(np.degrees(ends).tolist())
    )
    degrees, is_whole = reached_angles(machine, _DENSE_STEP)
    worked = worked_position(results)
    degrees = np.union1d(_with_corners(results, degrees), worked)
    known = without_rounding(results.columns_at(degrees), results.solved.speed)
    rates = driver_rates(results, known)
    drawn = _driver(degrees, known, style) if style.period else {}
    row = int(np.searchsorted(degrees, worked))
    drawn |= _plans(machine, degrees, row, rates, style, is_whole=is_whole)
    drawn |= _sliders(degrees, known, style)
    drawn |= _links(degrees, known, style)
    drawn |= _points(degrees, known, style)
    if not style.period:
        drawn |= centrodes(machine.mechanism, known, degrees, row, style)
    drawn |= chamber_figures(results, degrees, known, style)
    drawn |= _dynamics(degrees, known, style)
    if "joint_forces" in drawn:
        drawn |= force_figure(results, float(degrees[row]), style)
        drawn |= {} if style.period else lever_figure(results, float(degrees[row]), style)
    drawn |= bearing_pictures(results, style.language)
    drawn |= transient_figures(results, style)
    if is_whole:
        drawn |= _evenness(results, degrees, known, style)
    return drawn


def _with_corners(results: Results, degrees: Array) -> Array:
    """Return crank angles with those of extremes, and on both sides of where a load jumps or bends. [deg]"""
    breaks = breaks_of([results.memory[key] for key in results.columns if key in results.memory], results.machine.cycle)
    single = (results.memory[key].node for key in results.summary if key in results.memory)
    extremes = [node.at for node in single if isinstance(node, Found) and node.at is not None]
    breaks = np.concatenate([breaks, breaks + _AFTER, extremes])
    return np.union1d(degrees, breaks[(breaks >= degrees[0]) & (breaks <= degrees[-1])])


def _closed(degrees: Array, columns: Mapping[str, Array], cycle: float) -> tuple[Array, Mapping[str, Array]]:
    """Return a table closed over its cycle, with the first row repeated at the end."""
    step = float(degrees[-1] - degrees[-2])
    if degrees[0] != 0 or abs(degrees[-1] + step - cycle) > _AFTER:
        return degrees, columns
    return np.append(degrees, cycle), {key: np.append(column, column[0]) for key, column in columns.items()}


def _plans(machine: Machine, degrees: Array, row: int, rates: DriverRates, style: Style, *, is_whole: bool) -> Pictures:
    """Return position plans over the whole motion, and the plans of velocity and acceleration at one crank angle.

    `at`: which of the crank angles.
    """
    mechanism = machine.mechanism
    ends = None if is_whole else (float(degrees[0]), float(degrees[-1]))
    plans = {"position_plans": partial(position_plans, mechanism, ends, float(degrees[row]), style)}
    moved, first, second = moving(mechanism, degrees), float(rates.first[row]), float(rates.second[row])
    return plans | {
        "velocity_plan": partial(velocity_plan, mechanism, moved, row, first, style),
        "acceleration_plan": partial(acceleration_plan, mechanism, moved, row, first, second, style),
    }


def _driver(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return coordinate and rates of the driver, its force or torque, its power."""
    panels = [key for key in known if key.startswith("driver_")]
    return {"driver": partial(curves, degrees, known, panels, say("tables.driver", style.language), style)}


def _sliders(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    kinds = ("slider_displacement", "slider_velocity", "slider_acceleration")
    return _by_fours("sliders", kinds, _named(known, kinds[0]), degrees, known, style)


def _links(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return angle, angular velocity and acceleration of the links."""
    kinds = ("link_angle", "link_angular_velocity", "link_angular_acceleration")
    return _by_fours("links", kinds, _named(known, kinds[1]), degrees, known, style)


def _points(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return place, velocity and acceleration of the points that have names of their own."""
    kinds = ("point_x", "point_y", "point_velocity", "point_acceleration")
    names = [name for name in _named(known, kinds[2]) if "." not in name]
    return _by_fours("points", kinds, names, degrees, known, style)


def _named(known: Mapping[str, Array], kind: str) -> list[str]:
    """Return the names of the links or points that have a quantity."""
    return [key.partition(".")[2] for key in known if key.startswith(f"{kind}.")]


def _by_fours(
    figure: str,
    kinds: Sequence[str],
    names: Sequence[str],
    degrees: Array,
    known: Mapping[str, Array],
    style: Style,
) -> Pictures:
    """Return quantities of all that have them, a few in each figure; those after the first have numbers."""
    names = [name for name in names if all(f"{kind}.{name}" in known for kind in kinds)]
    pictures: Pictures = {}
    for first in range(0, len(names), _PER_PANEL):
        name = f"{figure}_{first // _PER_PANEL + 1}" if first else figure
        panels = [[f"{kind}.{name}" for name in names[first : first + _PER_PANEL]] for kind in kinds]
        pictures[name] = partial(curves, degrees, known, panels, figure_title(name, style.language), style)
    return pictures


def _dynamics(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return reduced inertia, torques and joint forces."""
    result: Pictures = {}
    inertia = any_nonzero(("reduced_inertia", "reduced_inertia_1"), known)
    if inertia and "dynamic_torque" in known:
        result["reduced_inertia"] = partial(
            curves, degrees, known, inertia, label("reduced_inertia", style.language), style
        )
    torques = any_nonzero(("static_torque", "dynamic_torque", "driving_torque"), known)
    if torques:
        # a machine that nobody drives
        gives = "driving_torque" in torques and np.nanmean(known["driving_torque"]) < 0
        sign = f"${symbol('driving_torque', style.language)}$"
        remark = say("drawing.gives_work", style.language, symbol=sign) if gives else ""
        title = label("driving_torque", style.language)
        result["torques"] = partial(curves, degrees, known, [torques], title, style, remark)
    result |= _friction(degrees, known, style)
    panels = []
    # magnitudes in pins, and apart from them forces of guides, which have a sign
    for kind in ("joint_force", "normal_force"):
        held = any_nonzero((key for key in known if key.partition(".")[0] == kind), known)
        panels += _panels(held)
    if panels:
        result["joint_forces"] = partial(
            curves, degrees, known, panels, say("tables.joint_forces", style.language), style
        )
    return result


def _friction(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return the driving forces and torques with and without friction, and the efficiency."""
    pairs = (("balancing_torque", "torque_with_friction"), ("driver_force", "driver_force_with_friction"),
             ("driver_torque", "driver_torque_with_friction"))  # fmt: skip
    panels = [[key for key in pair if key in known] for pair in pairs if pair[1] in known]
    ratio = [["instantaneous_efficiency"]] if "instantaneous_efficiency" in known else []
    if not panels or not all(np.isfinite(known[key]).any() for key in itertools.chain(*panels, *ratio)):
        return {}
    title = say("tables.friction", style.language)
    return {"friction": partial(curves, degrees, known, [*panels, *ratio], title, style)}


def _evenness(results: Results, degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return the energy-mass diagram and the speed with the flywheel found."""
    if "crank_speed" not in known:
        return {}
    speed, drive = results.solved.speed, results.machine.drive
    evenness = Fluctuation(speed, results.summary["speed_fluctuation"])
    pictures: Pictures = {"speed": partial(speed_curve, degrees, known["crank_speed"], evenness, style)}
    if drive.fluctuation is None:
        return pictures
    wanted = Fluctuation(speed, drive.fluctuation)
    energy, inertia = known["kinetic_energy_change"], known["reduced_inertia"]
    if np.any(inertia):
        # without masses the energy stands over one point
        pictures["wittenbauer"] = partial(wittenbauer, inertia, energy, wanted, degrees, style)
    return pictures


_KINDS = ("cylinder_volume", "gas_pressure", "gas_force", "rod_load")


def chamber_figures(
    results: Results, degrees: Array, known: Mapping[str, Array], style: Style = PLAIN
) -> dict[str, Callable[[], Drawing]]:
    """Return the figures of the gas by name; none without chambers."""
    panels = [keys for kind in _KINDS for keys in _panels([key for key in known if key.partition(".")[0] == kind])]
    if not panels:
        return {}
    return {
        "indicator": partial(indicator, results, style),
        "chambers": partial(curves, degrees, known, panels, say("figures.chambers", style.language), style),
    }


def indicator(results: Results, style: Style = PLAIN) -> Drawing:
    """Return pressure over volume of every chamber."""
    diagrams = indicators(results)
    volume, pressure = quantity_of("cylinder_volume"), quantity_of("diagram_pressure")
    drawn = {
        name: (displayed_values(volume, diagram.volume), displayed_values(pressure, diagram.pressure))
        for name, diagram in diagrams.items()
    }
    rows = [Row(plain(name), STYLES[k % 4]) for k, name in enumerate(drawn)] if len(drawn) > 1 else []
    paper, box = sheet(259.0, rows)
    x, y = (limits(*values, margin=0.05) for values in zip(*drawn.values(), strict=True))
    graph = Graph(paper, box, x, y, style.language)
    graph.frame(round_ticks(*x), round_ticks(*y, 10))
    for k, (name, (across, up)) in enumerate(drawn.items()):
        # tables of a law over time go by time
        angles = diagrams[name].degrees * (results.period / 360.0 if results.period else 1.0)
        graph.curve(name, across, up, STYLES[k % 4], angles=angles)
    graph.x_title(axis_title(volume, style.language))
    graph.y_title(axis_title(pressure, style.language))
    write_method(paper, style.method)
    return paper.drawing(say("figures.indicator", style.language), style.language)


def _panels(keys: Sequence[str]) -> list[Sequence[str]]:
    return [keys[start : start + _PER_PANEL] for start in range(0, len(keys), _PER_PANEL)]


_PANELS = (("crank_angle",), ("crank_speed",), ("kinetic_energy", "potential_energy"), ("driving_torque",))


def transient_figures(results: Results, style: Style) -> dict[str, Callable[[], Drawing]]:
    """Return crank angle, speed, energies and torque since a machine was let go; none where it was not."""
    if "transient" not in results.listings:
        return {}
    columns = results.listings["transient"].columns
    time = columns["time"]
    panels = [tuple(key for key in panel if key in columns and np.any(columns[key])) for panel in _PANELS]
    in_time = style._replace(period=float(time[-1]))
    shown = [panel for panel in panels if panel]
    title = say("tables.transient", style.language)
    return {"transient": partial(curves, 360.0 * time / time[-1], columns, shown, title, in_time)}


def curves(
    degrees: Array,
    columns: Mapping[str, Array],
    panels: Sequence[str | Sequence[str]],
    title: str,
    style: Style = PLAIN,
    remark: str = "",
) -> Drawing:
    """Return quantities over the crank angle, one panel below the other.

    `columns`: values in SI by key, `joint_force.A` for what belongs to a point or link; `panels`: keys of each panel;
    those of one panel share a unit; `remark`: what stands beneath.
    """
    all_panels = [_panel((panel,) if isinstance(panel, str) else tuple(panel), columns) for panel in panels]
    if not all_panels:
        raise CrankworkError("curves need at least one key")
    # quantities that are zero throughout are named in a remark
    sets = [panel for panel in all_panels if any(np.any(columns[row.key]) for row in panel)] or all_panels
    shown = [[displayed_values(row, columns[row.key]) for row in panel] for panel in sets]
    # beside a panel among others there is no room for a name
    has_legends = any(_has_legend(panel, style) for panel in sets)
    legends = [_rows(*panel, style) if has_legends else [] for panel in zip(sets, shown, strict=True)]
    above = [legend_height(rows) for rows in legends]
    room = (_TALLEST - BOTTOM - sum(above)) / len(sets) - _GAP
    high = scaled_height(_ALONE if len(sets) == 1 else min(_PANEL, room))
    paper = Canvas(current_layout().width, TOP + sum(above) + len(sets) * (high + _GAP) - _GAP + BOTTOM)
    abscissas = degrees * style.period / 360.0 if style.period else degrees
    top = TOP
    for quantities, values, rows, height in zip(sets, shown, legends, above, strict=True):
        legend(paper, rows, top - 4)
        box = ChartBox(current_layout().left, top + height, current_layout().inner, high)
        is_place = quantities[0].key.partition(".")[0] in _PLACES
        ends = limits(*values, is_place=is_place)
        graph = drive_graph(paper, box, abscissas, ends, style, is_last=quantities is sets[-1])
        _draw(graph, abscissas, quantities, values)
        graph.y_title(_title(quantities, style, has_legend=has_legends))
        top += height + graph.box.height + _GAP
    dead = "; ".join(f"{number(round(limit, 2), style.language)}°" for limit in style.limits)
    zero = [math_symbol(row.symbol(style.language)) for panel in all_panels if panel not in sets for row in panel]
    remarks = [
        say("drawing.dead_positions", style.language, angles=dead) if dead and not style.period else "",
        f"{' = '.join(zero)} = 0" if zero else "",
        remark,
    ]
    write_method(paper, style.method, "; ".join(text for text in remarks if text))
    return paper.drawing(title, style.language)


def _panel(keys: tuple[str, ...], columns: Mapping[str, Array]) -> list[Quantity]:
    """Return the quantities of a panel."""
    missing = [key for key in keys if key not in columns]
    if missing:
        raise CrankworkError(f"there is no column {missing[0]}; there is {', '.join(columns)}")
    quantities = [quantity_of(key) for key in keys]
    units = {row.unit for row in quantities}
    if len(units) > 1:
        raise CrankworkError(f"{', '.join(keys)} have different units; give each a panel of its own")
    return quantities


def _has_legend(quantities: Sequence[Quantity], style: Style) -> bool:
    """Return whether names stand above a panel: there are several, or one with a name of its own, or too long."""
    return len(quantities) > 1 or "." in quantities[0].key or len(quantities[0].label(style.language)) > _LONG


def _draw(graph: Graph, abscissas: Array, quantities: Sequence[Quantity], values: Sequence[Array]) -> None:
    """Draw the curves of a panel, and the extremes of one that is alone."""
    for order, together in enumerate(_together(values)):
        first, *further = together
        for other in further:
            graph.curves[quantities[other].key] = abscissas, values[other]
        graph.curve(quantities[first].key, abscissas, values[first], STYLES[order % 4])
    known = np.where(np.isfinite(values[0]), values[0], 0.0)
    if len(values) > 1 or np.ptp(known) <= _SAME * np.max(np.abs(known)):
        return
    for name, where in (("max", int(np.argmax(known))), ("min", int(np.argmin(known)))):
        # a value that is zero beside the largest is rounding
        value = float(known[where]) if abs(known[where]) > _ROUNDING * np.max(np.abs(known)) else 0.0
        mark_point(graph, name, float(abscissas[where]), value, graph.tick_text(value))


def _together(values: Sequence[Array]) -> list[list[int]]:
    """Return the groups of curves of a panel that coincide, so that each is drawn once."""
    size = max((float(np.ptp(row[np.isfinite(row)])) for row in values if np.isfinite(row).any()), default=0.0)
    # constants differ by rounding
    size += _ROUNDING * max((float(np.max(np.abs(row[np.isfinite(row)]), initial=0.0)) for row in values), default=0.0)
    groups: list[list[int]] = []
    for index, column in enumerate(values):
        for group in groups:
            if np.allclose(values[group[0]], column, rtol=0.0, atol=_SAME * size, equal_nan=True):
                group.append(index)
                break
        else:
            groups.append([index])
    return groups


def _rows(quantities: Sequence[Quantity], values: Sequence[Array], style: Style) -> list[Row]:
    rows = []
    for order, together in enumerate(_together(values)):
        signs = dict.fromkeys(math_symbol(quantities[index].symbol(style.language)) for index in together)
        names = (plain(quantities[index].label(style.language)) for index in together)
        rows.append(Row(f"{', '.join(signs)} – {'; '.join(names)}", STYLES[order % 4]))
    return rows


def _title(quantities: Sequence[Quantity], style: Style, *, has_legend: bool) -> str:
    """Return the title of the vertical axis: the name, or the symbols where a legend has the names."""
    if not has_legend:
        return axis_title(quantities[0], style.language)
    unit = unit_name(quantities[0].unit, style.language)
    signs = dict.fromkeys(math_symbol(row.symbol(style.language)) for row in quantities)
    names = ", ".join(signs) if len(quantities) < 5 else ""
    return f"{names}, {unit}" if names and unit else names or unit


def centrodes(
    mechanism: Mechanism, known: Mapping[str, Array], degrees: Array, row: int, style: Style
) -> dict[str, Callable[[], Drawing]]:
    """Return the function that draws both centrodes of a coupler at one crank angle; none if the centre is far away.

    `at`: which of the crank angles [deg].
    """
    names = [key.partition(".")[2] for key in known if key.startswith("instant_centre_x.")]
    moved = moving(mechanism, degrees)
    reach = _reach(np.vstack([point.place for point in moved.points.values()]))
    centres = {name: instant_centres(moved.frames[name], row) for name in names if name in moved.frames}
    name = max(centres, key=lambda link: _seen(centres[link][0], reach), default="")
    if not name or _seen(centres[name][0], reach) < _SEEN:
        return {}

    def draw() -> Drawing:
        fixed, rolling = centres[name]
        scale = float(displayed_values(QUANTITIES["point_x"], np.array(1.0)))
        places = {name: point.place[row] * scale for name, point in moved.points.items()}
        letters = skeleton(mechanism, style.links).letters
        # the letter that tables have, unless a point has it
        centre = symbol("instant_centre_x", style.language).partition("_")[2]
        centre += "₀" if centre in letters.values() else ""
        rows = [
            Row(say("drawing.fixed_centrode", style.language, link=plain(name))),
            Row(
                f"{say('drawing.moving_centrode', style.language)}, {position_text(float(degrees[row]), style)}",
                _ROLLING,
            ),
            Row(f"${centre}$ – {say('drawing.instant_centre', style.language)}", DOT),
        ]
        paper, box = sheet(scaled_height(_HIGH), rows)
        graph = _graph(paper, box, np.vstack([point.place * scale for point in moved.points.values()]), style)
        _linkage(graph, skeleton(mechanism, style.links).members, places)
        for key, path, dashes in (("fixed_centrode", fixed, SOLID), ("moving_centrode", rolling, _ROLLING)):
            graph.curve(key, *_within(graph, path * scale), dashes)
        marks = [(plain(letters[point]), *graph.point(*place)) for point, place in places.items() if point in letters]
        x, y = fixed[row] * scale
        if graph.x[0] < x < graph.x[1] and graph.y[0] < y < graph.y[1]:
            marks.append((f"${centre}$", *graph.point(float(x), float(y))))
        label_marks(paper, marks, frame=graph.box)
        unit = unit_name(QUANTITIES["point_x"].unit, style.language)
        graph.x_title(f"$x$, {unit}")
        graph.y_title(f"$y$, {unit}")
        write_method(paper, style.method)
        return paper.drawing(figure_title("centrodes", style.language), style.language)

    return {"centrodes": draw}


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


def _reach(places: Array) -> tuple[Array, Array]:
    """Return the middle of a linkage, and how far around it centres are shown, across and up."""
    low, high = places.min(axis=0), places.max(axis=0)
    return (low + high) / 2, np.full(2, float(np.max(high - low)) * (1 + _AROUND) / 2)


def _graph(paper: Canvas, box: ChartBox, places: Array, style: Style) -> Graph:
    """Return a graph of equal scales around a linkage, its frame drawn."""
    middle, size = _reach(places)
    unit = 2 * max(float(size[0]) / box.width, float(size[1]) / box.height) or 1.0
    half = unit * box.width / 2, unit * box.height / 2
    x = float(middle[0]) - half[0], float(middle[0]) + half[0]
    y = float(middle[1]) - half[1], float(middle[1]) + half[1]
    graph = Graph(paper, box, x, y, style.language, to_scale=False)
    graph.frame(round_ticks(*x), round_ticks(*y))
    return graph


def _linkage(graph: Graph, members: Sequence[Member], places: Mapping[str, Array]) -> None:
    """Draw the links as lines between their points."""
    for member in members:
        for start, end in combinations([places[name] for name in member.points if name in places], 2):
            x, y = graph.across(np.array([start[0], end[0]])), graph.down(np.array([start[1], end[1]]))
            graph.paper.line(x, y, width=1.8, colour=_LINK)


def _within(graph: Graph, path: Array) -> tuple[Array, Array]:
    """Return a path with gaps where it leaves the graph."""
    x, y = path.T
    with np.errstate(invalid="ignore"):
        inside = (x > graph.x[0]) & (x < graph.x[1]) & (y > graph.y[0]) & (y < graph.y[1])
    return np.where(inside, x, np.nan), np.where(inside, y, np.nan)


def force_figure(results: Results, degrees: float, style: Style) -> dict[str, Callable[[], Drawing]]:
    """Return the function that draws the force plans at a crank angle [deg]; none if no group has three forces."""
    plans = [plan for plan in force_plans(results, degrees) if len(plan.forces) >= _FEWEST][:_MOST]
    if not plans:
        return {}
    numbers = {member.name: member.number for member in skeleton(results.machine.mechanism, style.links).members}
    return {"force_plans": partial(_figure, plans, numbers, degrees, style)}


def _figure(plans: list[ForcePlan], numbers: dict[str, int], degrees: float, style: Style) -> Drawing:
    title, spans = figure_title("force_plans", style.language), [np.ptp(_ends(plan), axis=0) for plan in plans]
    # upright ones side by side where there is room
    upright = sum(bool(high > wide) for wide, high in spans)
    columns = 2 if current_layout().width > _TWO and upright > max(1, len(plans) / 2) else 1
    rows = [plans[start : start + columns] for start in range(0, len(plans), columns)]
    most = scaled_height(min(_HIGHEST, _WHOLE / len(rows)))
    heights = []
    for row in rows:
        listed = max(len(plan.forces) + len(plan.links) for plan in row)
        heights.append(max(_ROW * listed + _HEAD, *(_needed(plan, most, columns) for plan in row)))
    paper = Canvas(current_layout().width, TOP + sum(heights) + _HEAD * len(rows) + _FOOT)
    top, wide, scales = TOP, current_layout().width / columns, set[float]()
    for row, height in zip(rows, heights, strict=True):
        for index, plan in enumerate(row):
            scales.add(_plan(paper, plan, ChartBox(index * wide, top, wide, height), numbers, style.language))
        top += height + _HEAD
    shown = f"{position_sign(style)} = {position_text(degrees, style)}"
    paper.text(current_layout().width - 14, paper.height - 20, shown, anchor="end")
    remarks = ["force_plan", *(["own_scales"] if len(scales) > 1 else [])]
    write_method(paper, style.method, "; ".join(say(f"drawing.{remark}", style.language) for remark in remarks))
    return paper.drawing(f"{title}, {position_text(degrees, style)}", style.language)


def _scale(plan: ForcePlan, width: float, height: float) -> float:
    """Return the scale at which a polygon has room beside its list. [displayed unit/mm]"""
    # beside it letters stand between it and the list
    room = np.array([width - _LIST - 4 * _MARGIN, height - 2 * _MARGIN])
    return round_scale(float(points_per_mm() * np.max(np.ptp(_ends(plan), axis=0) / room)), FINE)


def _needed(plan: ForcePlan, most: float, columns: int) -> float:
    """Return the height of a plan, at most `most`. [pt]"""
    scale = _scale(plan, current_layout().width / columns, most)
    return float(np.ptp(_ends(plan), axis=0)[1]) * points_per_mm() / scale + 2 * _MARGIN


def _plan(paper: Canvas, plan: ForcePlan, place: ChartBox, numbers: dict[str, int], language: Language) -> float:
    """Draw the polygon of a group to its own scale, which is returned, and its forces beside it."""
    left, top, width, height = place
    row, ends, scale = QUANTITIES["joint_force"], _ends(plan), _scale(plan, width, height)
    width -= _LIST
    unit = points_per_mm() / scale
    middle = (ends.min(axis=0) + ends.max(axis=0)) / 2 * unit
    x, y = (middle[0] - width / 2, middle[0] + width / 2), (middle[1] - height / 2, middle[1] + height / 2)
    graph = Graph(paper, ChartBox(left, top + _HEAD, width, height), x, y, language, to_scale=False)
    marks = []
    corners = np.array([graph.point(*(end * unit)) for end in ends])
    sides = _separated_sides(corners)
    for index, force in enumerate(plan.forces):
        start, end = sides[index]
        for corner, moved in zip(corners[index : index + 2], sides[index], strict=True):
            if np.any(corner != moved):
                paper.line([corner[0], moved[0]], [corner[1], moved[1]], width=0.4, colour=GREY)
        paper.arrow(start, end, width=_REACTION if force.kind != "load" else _LOAD, style=SOLID)
        marks.append((_symbol(force, numbers, language), (start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    label_marks(paper, marks, dot=0.0)
    links = ", ".join(str(numbers.get(link, link)) for link in plan.links)
    head = say("drawing.links" if len(plan.links) > 1 else "drawing.link", language, links=links)
    paper.text(left + 14, top + 10, f"{head}: {scale_text('μ_F', scale, row.unit, language)}")
    for count, force in enumerate(plan.forces):
        shown = number(float(f"{_size(force):.4g}"), language)
        text = f"{_symbol(force, numbers, language)} = {shown} {unit_name(row.unit, language)}"
        paper.text(left + width, top + _HEAD + 12 + _ROW * count, text, size=8.5)
    names = {own_number: name for name, own_number in numbers.items()}
    for count, key in enumerate(key_of_links(names, (numbers[link] for link in plan.links if link in numbers))):
        paper.text(left + width, top + _HEAD + 12 + _ROW * (len(plan.forces) + count), key, size=8.5)
    return scale


def _ends(plan: ForcePlan) -> Array:
    """Return the corners of the polygon of a group, shape (n, 2). [displayed unit]"""
    ends = np.vstack([np.zeros(2), np.cumsum([(force.x, force.y) for force in plan.forces], axis=0)])
    return displayed_values(QUANTITIES["joint_force"], ends)


def _separated_sides(corners: Array) -> list[Array]:
    """Return the sides of a polygon, those that would lie over others shifted across. [pt]"""
    placed: list[Array] = []
    for start, end in pairwise(corners):
        side = end - start
        across = np.array([-side[1], side[0]]) / max(float(np.hypot(*side)), 1e-9)
        lanes = [np.array([start, end]) + lane * _LANE * across for lane in _LANES]
        free = [lane for lane in lanes if not any(_lie_over(lane, other) for other in placed)]
        placed.append((free or lanes)[0])
    return placed


def _lie_over(first: Array, second: Array) -> bool:
    """Return whether two sides lie along each other."""
    vector, length = first[1] - first[0], float(np.hypot(*(first[1] - first[0])))
    if length < _LANE:
        return False
    off = second - first[0]
    along, distance = off @ vector / length, np.abs(off @ np.array([-vector[1], vector[0]])) / length
    return bool(np.all(distance < _NEAR)) and min(along.max(), length) - max(along.min(), 0.0) > _LANE


def _size(force: PlanForce) -> float:
    values: Array = displayed_values(QUANTITIES["joint_force"], np.array(force.size))
    return float(values)


def _symbol(force: PlanForce, numbers: dict[str, int], language: Language) -> str:
    """Return the symbol of a force: that of its joint, of its guide, of the loads on its link, or of the driver."""
    if force.kind == "driver":
        return math_symbol(QUANTITIES["driver_force"].symbol(language))
    if force.kind == "load":
        return math_symbol(f"F_{numbers.get(force.name, plain(force.name))}")
    if force.kind == "guide":
        return math_symbol(f"N_{numbers.get(force.name, plain(force.name))}")
    return math_symbol(QUANTITIES["joint_force"]._replace(key=f"joint_force.{force.name}").symbol(language))
