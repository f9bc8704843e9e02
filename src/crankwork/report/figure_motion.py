"""The figure of the motion: displacement, velocity and acceleration of the piston."""

from __future__ import annotations

from crankwork.report.figure_data import Drawn
from crankwork.report.figure_look import (
    BOTTOM,
    DASH_DOT,
    DASHED,
    add_axes,
    draw_curves,
    figure_word,
    new_figure,
    over_crank_angle,
    through_zero,
)

_PANEL, _GAP, _LEGEND = 1.75, 0.36, 0.3


def kinematics(drawn: Drawn) -> bytes:
    """Return three panels over one revolution; an approximate method shows the two orders it is made of.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    figure = new_figure(BOTTOM + 3 * _PANEL + 2 * _GAP + _LEGEND)
    turn = drawn.degrees <= 360
    has_orders = "piston_velocity_first_order" in drawn.columns
    for row, noun in enumerate(("displacement", "velocity", "acceleration")):
        key = f"piston_{noun}"
        axes = add_axes(figure, drawn.language, BOTTOM + (2 - row) * (_PANEL + _GAP), _PANEL)
        curves = [drawn.curve(key)]
        if has_orders:
            curves += [drawn.curve(f"{key}_first_order", DASHED), drawn.curve(f"{key}_second_order", DASH_DOT)]
        curves = [one._replace(values=one.values[turn]) for one in curves]
        draw_curves(axes, drawn.degrees[turn], curves, one_row=True)
        over_crank_angle(axes, 360.0, drawn.language)
        through_zero(axes, *(one.values for one in curves))
        axes.set_ylabel(drawn.title(key).replace(" $", "\n$", 1))
        if row < 2:
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
    return drawn.finished("kinematics", figure, figure_word("orders", drawn.language) if has_orders else "")
