"""Any quantities over the crank angle as line charts, one panel below the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.locale.numbers import unit_name
from crankwork.quantities import Quantity
from crankwork.report.linkage_look import (
    PLAIN,
    Style,
    axis_title,
    displayed_values,
    drive_graph,
    math_symbol,
    quantity_of,
)
from crankwork.show.chart import BOTTOM, LEFT, RIGHT, TOP, WIDTH, Box, Row, legend, legend_height, limits, sign
from crankwork.show.paper import Paper, plain
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing

STYLES = (SOLID, DASHED, DASH_DOT, DOTTED)
_ALONE, _PANEL, _GAP = 216.0, 126.0, 16.0
# what a page of a note holds with its caption [pt]
_TALLEST = 600.0
# characters of a name that still fit beside a panel
_LONG = 20


def curves(
    degrees: Array,
    columns: Mapping[str, Array],
    panels: Sequence[str | Sequence[str]],
    title: str,
    style: Style = PLAIN,
) -> Drawing:
    """Return quantities over the crank angle, one panel below the other.

    `columns`: values in SI by key, `joint_force.A` for what belongs to a point or link; `panels`: keys of each panel;
    those of one panel share a unit.
    """
    sets = [_panel((one,) if isinstance(one, str) else tuple(one), columns) for one in panels]
    if not sets:
        raise CrankworkError("curves need at least one key")
    legends = [_rows(one, style) if _has_legend(one, style) else [] for one in sets]
    above = [legend_height(rows) for rows in legends]
    room = (_TALLEST - BOTTOM - sum(above)) / len(sets) - _GAP
    tall = _ALONE if len(sets) == 1 else min(_PANEL, room)
    paper = Paper(WIDTH, TOP + sum(above) + len(sets) * (tall + _GAP) - _GAP + BOTTOM)
    at = degrees * style.period / 360.0 if style.period else degrees
    top = TOP
    for quantities, rows, height in zip(sets, legends, above, strict=True):
        legend(paper, rows, top - 4)
        box = Box(LEFT, top + height, WIDTH - LEFT - RIGHT, tall)
        values = [displayed_values(row, columns[row.key]) for row in quantities]
        graph = drive_graph(paper, box, at, limits(*values), style, is_last=quantities is sets[-1])
        for number, (row, one) in enumerate(zip(quantities, values, strict=True)):
            graph.curve(row.key, at, one, STYLES[number % 4])
        graph.y_title(_title(quantities, style))
        top += height + tall + _GAP
    sign(paper, style.method)
    return paper.drawing(title, style.language)


def _panel(keys: tuple[str, ...], columns: Mapping[str, Array]) -> list[Quantity]:
    """Return the quantities of a panel."""
    missing = [key for key in keys if key not in columns]
    if missing:
        raise CrankworkError(f"there is no column {missing[0]}; there is {', '.join(columns)}")
    found = [quantity_of(key) for key in keys]
    units = {row.unit for row in found}
    if len(units) > 1:
        raise CrankworkError(f"{', '.join(keys)} have different units; give each a panel of its own")
    return found


def _has_legend(quantities: Sequence[Quantity], style: Style) -> bool:
    """Return whether names stand above a panel: there are several, or one too long for the axis."""
    return len(quantities) > 1 or len(quantities[0].label(style.language)) > _LONG


def _rows(quantities: Sequence[Quantity], style: Style) -> list[Row]:
    return [
        Row(f"{math_symbol(row.symbol(style.language))} – {plain(row.label(style.language))}", STYLES[number % 4])
        for number, row in enumerate(quantities)
    ]


def _title(quantities: Sequence[Quantity], style: Style) -> str:
    """Return what stands beside the vertical axis: the name, or where a legend has the names the symbols."""
    if not _has_legend(quantities, style):
        return axis_title(quantities[0], style.language)
    unit = unit_name(quantities[0].unit, style.language)
    signs = dict.fromkeys(math_symbol(row.symbol(style.language)) for row in quantities)
    names = ", ".join(signs) if len(quantities) < 5 else ""
    return f"{names}, {unit}" if names and unit else names or unit
