"""Any quantities over the crank angle as line charts, one panel below the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.quantities import Quantity
from crankwork.report.figure_look import (
    BOTTOM,
    DASH_DOT,
    DASHED,
    DOTTED,
    SOLID,
    Curve,
    add_axes,
    draw_curves,
    math_symbol,
    new_figure,
    svg,
    through_zero,
)  # fmt: skip
from crankwork.report.language import unit_name
from crankwork.report.linkage_look import (
    PLAIN,
    Style,
    axis_title,
    displayed_values,
    figure_look,
    over_drive_angle,
    over_time,
    quantity_of,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STYLES = (SOLID, DASHED, DASH_DOT, DOTTED)
_PANEL, _GAP, _LEGEND_ROW = 1.75, 0.2, 0.185
# what a page of a note holds with its caption [in]
_TALLEST = 8.4
# characters of a name that still fit beside a panel
_LONG = 20


def curves(
    degrees: Array,
    columns: Mapping[str, Array],
    panels: Sequence[str | Sequence[str]],
    title: str,
    style: Style = PLAIN,
) -> bytes:
    """Return quantities over the crank angle, one panel below the other.

    `columns`: values in SI by key, `joint_force.A` for what belongs to a point or link; `panels`: keys of each panel;
    those of one panel share a unit.
    """
    sets = [_panel((one,) if isinstance(one, str) else tuple(one), columns) for one in panels]
    if not sets:
        raise CrankworkError("curves need at least one key")
    legends = [_LEGEND_ROW * len(one) + 0.06 if _has_legend(one, style) else 0.0 for one in sets]
    room = (_TALLEST - BOTTOM - sum(legends)) / len(sets) - _GAP
    tall = 3.0 if len(sets) == 1 else min(_PANEL, room)
    with figure_look():
        figure = new_figure(BOTTOM + len(sets) * (tall + _GAP) + sum(legends))
        foot = BOTTOM
        for count, (quantities, legend) in enumerate(zip(reversed(sets), reversed(legends), strict=True)):
            axes = add_axes(figure, style.language, foot, tall)
            _draw(axes, degrees, [(row, columns[row.key]) for row in quantities], style)
            if count:
                axes.set_xlabel("")
                axes.tick_params(labelbottom=False)
            foot += tall + _GAP + legend
        return svg(figure, title, style.method)


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


def _draw(axes: Axes, degrees: Array, values: Sequence[tuple[Quantity, Array]], style: Style) -> None:
    at = degrees * style.period / 360.0 if style.period else degrees
    lines = [
        Curve(row.symbol(style.language), row.label(style.language), displayed_values(row, column), _STYLES[i % 4])
        for i, (row, column) in enumerate(values)
    ]
    first = values[0][0]
    unit = unit_name(first.unit, style.language)
    has_legend = _has_legend([row for row, _ in values], style)
    draw_curves(axes, at, lines, one_row=not has_legend)
    if style.period:
        over_time(axes, float(at[-1]), style.language)
    else:
        over_drive_angle(axes, (float(at[0]), float(at[-1])), style.language)
    through_zero(axes, *(one.values for one in lines))
    if not has_legend:
        axes.set_ylabel(axis_title(first, style.language).replace(" $", "\n$", 1))
    else:
        names = ", ".join(dict.fromkeys(math_symbol(one.symbol) for one in lines)) if len(lines) < 5 else ""
        axes.set_ylabel(f"{names}, {unit}" if names and unit else names or unit)
