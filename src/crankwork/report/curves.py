"""Curves of quantities over the angle or the time of what drives, one panel below the other; of several results too."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.compare import Comparison, comparison_key, difference_key
from crankwork.errors import CrankworkError
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.comparison import shown_names
from crankwork.report.display import displayed, in_own_units, key_unit, symbol
from crankwork.report.look import (
    PLAIN,
    Style,
    axis_title,
    displayed_values,
    drive_graph,
    key_of_links,
    math_symbol,
    quantity_of,
)
from crankwork.show.canvas import Canvas, plain
from crankwork.show.chart import (
    BOTTOM,
    LEGEND_ROW,
    TOP,
    ChartBox,
    Graph,
    Row,
    limits,
    name_at_the_end,
    over_cycle,
    round_ticks,
    sheet,
    write_remark,
)
from crankwork.show.chart_layout import current_layout, scaled_height
from crankwork.show.label_placement import mark_point
from crankwork.show.scene import STYLES, Drawing
from crankwork.show.scene import Style as Dashes

_ALONE, _PANEL, _GAP = 216.0, 126.0, 16.0
# what a page of a note holds with its caption [pt]
_TALLEST = 600.0
# characters of a name that fit beside a panel
_LONG = 36
# what tells where something is
_PLACES = ("slider_displacement", "driver_displacement", "driver_angle", "link_angle", "point_x", "point_y")
# curves nearer than this share of the range fall together in print
_SAME, _ROUNDING = 0.003, 1e-9
# of a comparison
_STEP, _MOST = 1.0, 2000
# a cycle of more has no lines at multiples of 90 degrees
_LONG_CYCLE = 720.0
_COLOURS = ("#000000", "#b03030", "#2f5fa8", "#3a7d44", "#8a5a9c", "#a87b1f", "#4d4d4d")
_UPPER, _LOWER, _BETWEEN = 110.0, 62.0, 12.0
# what a page of a note holds of it together with its caption, without axis and edges [pt]
_TALLEST_NOTE = 540.0
# what a figure shows: of each row the first kind that there is
_DRAWN = (
    ("piston_displacement", "slider_displacement", "link_angle", "turning_moment"),
    ("piston_velocity", "slider_velocity", "link_angular_velocity", "excess_torque"),
    ("piston_acceleration", "slider_acceleration", "link_angular_acceleration", "kinetic_energy_change"),
    ("total_torque", "crank_torque", "driving_torque", "balancing_torque", "static_torque", "driver_force",
     "driver_torque"),
)  # fmt: skip


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
    room = (_TALLEST - BOTTOM) / len(sets) - _GAP
    high = scaled_height(_ALONE if len(sets) == 1 else min(_PANEL, room))
    paper = Canvas(current_layout().width, TOP + len(sets) * (high + _GAP) - _GAP + BOTTOM)
    abscissas = degrees * style.period / 360.0 if style.period else degrees
    top = TOP
    for quantities, values in zip(sets, shown, strict=True):
        box = ChartBox(current_layout().left, top, current_layout().inner, high)
        name_at_the_end(paper, _rows(quantities, values, style), box)
        is_place = key_of(quantities[0].key).quantity in _PLACES
        ends = limits(*values, is_place=is_place)
        graph = drive_graph(paper, box, abscissas, ends, style, is_last=quantities is sets[-1])
        _draw(graph, abscissas, quantities, values)
        graph.y_title(_title(quantities, style))
        top += graph.box.height + _GAP
    dead = "; ".join(f"{number(round(limit, 2), style.language)}°" for limit in style.limits)
    owners = {key_of(row.key).owner for panel in all_panels for row in panel}
    known = {number: name for number, name in enumerate(style.links, 1) if name in owners and number_of(name) != name}
    zero = [math_symbol(row.symbol(style.language)) for panel in all_panels if panel not in sets for row in panel]
    remarks = [
        translate("drawing.dead_positions", style.language, angles=dead) if dead and not style.period else "",
        f"{' = '.join(zero)} = 0" if zero else "",
        remark,
        *key_of_links(known, known, style.language),
    ]
    write_remark(paper, "; ".join(text for text in remarks if text))
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
        # a value that is very small against the largest is rounding
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


def _is_on_axis(quantities: Sequence[Quantity], style: Style) -> bool:
    """Return whether the title of the axis says what the curves are: all of one kind, whose name is not too long."""
    kinds = {key_of(row.key).quantity for row in quantities}
    return len(kinds) == 1 and len(quantities[0].label(style.language)) <= _LONG


def _rows(quantities: Sequence[Quantity], values: Sequence[Array], style: Style) -> list[Row]:
    """Return the names of the curves of a panel: symbols, and what the title of its axis does not say."""
    rows, is_on_axis = [], _is_on_axis(quantities, style)
    if is_on_axis and len(quantities) == 1:
        return []
    for order, together in enumerate(_together(values)):
        signs = dict.fromkeys(math_symbol(quantities[index].symbol(style.language)) for index in together)
        names = "; ".join(plain(quantities[index].label(style.language)) for index in together)
        meant = "" if is_on_axis else f" – {names}"
        rows.append(Row(f"{', '.join(signs)}{meant}", STYLES[order % 4]))
    return rows


def _title(quantities: Sequence[Quantity], style: Style) -> str:
    """Return the title of the vertical axis: the name of what all curves are, or the symbols of several."""
    if _is_on_axis(quantities, style):
        alone = quantities[0] if len(quantities) == 1 else QUANTITIES[key_of(quantities[0].key).quantity]
        return axis_title(alone, style.language)
    unit = unit_name(quantities[0].unit, style.language)
    names = ", ".join(dict.fromkeys(math_symbol(row.symbol(style.language)) for row in quantities))
    return f"{names}, {unit}" if unit else names


@in_own_units
def comparison_figure(results: Results, compared: Comparison, language: Language, *, per_area: bool = False) -> Drawing:
    """Return the figure of a comparison: quantities by each name, and below each its differences."""
    keys = drawn_keys(compared)
    # two machines have pistons of their own
    per_area = per_area and compared.is_of_methods
    cycle = results.machine.cycle
    degrees = np.linspace(0.0, cycle, min(round(cycle / _STEP), _MOST) + 1)
    area = results.summary["piston_area"] if per_area else None
    columns = compared.columns_at(degrees)
    other_names, named = compared.names[1:], shown_names(compared, language)
    looks = zip(named, _looks(compared.names), strict=True)
    rows = [Row(shown, style, colour=colour) for shown, (_, style, colour) in looks]
    if len(other_names) == 1:
        rows.append(Row(f"Δ: {translate('report.less', language, name=named[1], other=named[0])}", width=0.0))
    else:
        rows.append(Row(f"Δ: {translate('report.less_own', language, other=named[0])}", width=0.0))
    room = (_TALLEST_NOTE - LEGEND_ROW * len(rows)) / len(keys) - 1.5 * _BETWEEN
    upper, lower = (min(most, share * room) for most, share in ((_UPPER, 0.63), (_LOWER, 0.37)))
    paper, box = sheet(len(keys) * (upper + lower + 1.5 * _BETWEEN) - _BETWEEN, rows)
    abscissas = _across(results, degrees)
    top = box.top
    for key in keys:
        scale, unit = displayed(key, 1.0, per_area=area), unit_name(key_unit(key, per_area=per_area), language)
        sign = QUANTITIES[key_of(key).quantity]._replace(key=key).symbol(language)
        for names, place, tall, mark in (
            ([(comparison_key(key, name), name) for name in compared.names], top, upper, f"${sign}$"),
            (
                [(difference_key(key, name), name) for name in other_names],
                top + upper + _BETWEEN / 2,
                lower,
                f"$Δ{sign}$",
            ),
        ):
            is_last = key == keys[-1] and place > top
            curves = {name: columns[column] * scale for column, name in names}
            graph = _graph(
                paper, ChartBox(box.left, place, box.width, tall), abscissas, curves, results, language, numbers=is_last
            )
            for name, style, colour in _looks(compared.names):
                if name in curves:
                    graph.curve(name, abscissas, curves[name], style, colour=colour)
            graph.y_title(f"{mark}, {unit}" if unit else mark)
            if is_last:
                graph.x_title(_x_title(results, language))
        top += upper + lower + 1.5 * _BETWEEN
    return paper.drawing(translate("figures.comparison", language), language)


def drawn_keys(compared: Comparison) -> list[str]:
    """Return the columns that a figure shows; of several links or sliders the last, which others move."""
    selected = []
    for kinds in _DRAWN:
        keys = {key_of(key).quantity: key for key in compared.keys if np.any(compared.columns[_own(compared, key)])}
        selected += [keys[kind] for kind in kinds if kind in keys][:1]
    return selected


def _own(compared: Comparison, key: str) -> str:
    return comparison_key(key, compared.names[0])


def _looks(names: tuple[str, ...]) -> list[tuple[str, Dashes, str]]:
    return [
        (name, STYLES[min(index, len(STYLES) - 1)], _COLOURS[index % len(_COLOURS)]) for index, name in enumerate(names)
    ]


def _across(results: Results, degrees: Array) -> Array:
    return degrees * results.period / 360.0 if results.period else degrees


def _x_title(results: Results, language: Language) -> str:
    key = "time" if results.period else "crank_angle"
    return f"{QUANTITIES[key].label(language)} ${symbol(key, language)}$, {unit_name(key_unit(key), language)}"


def _graph(  # noqa: PLR0913 - place, curves and how they are told
    paper: Canvas,
    box: ChartBox,
    abscissas: Array,
    curves: Mapping[str, Array],
    results: Results,
    language: Language,
    *,
    numbers: bool,
) -> Graph:
    """Return a graph that holds all numbers of some curves, with its frame drawn."""
    y = limits(*curves.values())
    if results.period or results.machine.cycle > _LONG_CYCLE:
        over = "time" if results.period else "crank_angle"
        graph = Graph(paper, box, (0.0, float(abscissas[-1])), y, language, over)
        graph.frame(round_ticks(0.0, float(abscissas[-1])), round_ticks(*y, 4), labels=(numbers, True))
        return graph
    return over_cycle(paper, box, y, float(abscissas[-1]), language, numbers=numbers)
