"""The figures of forces and torque over the crank angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crankwork.quantities import QUANTITIES
from crankwork.report.figure_data import Drawn
from crankwork.report.figure_look import (
    DASH_DOT,
    DASHED,
    DOTTED,
    SOLID,
    Curve,
    draw_curves,
    math_symbol,
    over_crank_angle,
    single_axes,
    through_zero,
    with_unit,
)
from crankwork.report.language import displayed, number, unit_name

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _over_cycle(drawn: Drawn, curves: list[Curve], title: str) -> Figure:
    figure, axes = single_axes(drawn.language, len(curves))
    draw_curves(axes, drawn.degrees, curves)
    over_crank_angle(axes, drawn.results.machine.cycle, drawn.language)
    through_zero(axes, *(one.values for one in curves))
    axes.set_ylabel(title)
    return figure


def _forces(drawn: Drawn, name: str, curves: list[Curve]) -> bytes:
    symbols = ", ".join(math_symbol(one.symbol) for one in curves)
    title = with_unit(symbols, "piston_force", drawn.language, per_area=drawn.per_area)
    return drawn.forces_finished(name, _over_cycle(drawn, curves, title))


def piston_forces(drawn: Drawn) -> bytes:
    """Return the parts of the force on the piston and their sum; a part that is the whole sum stands for it.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    styles = {"gas_force": DASHED, "inertia_force": DASH_DOT, "weight_force": DOTTED}
    parts = [drawn.curve(key, style) for key, style in styles.items() if key in drawn.columns]
    if len(parts) == 1:
        return _forces(drawn, "piston_forces", [parts[0]._replace(style=SOLID)])
    return _forces(drawn, "piston_forces", [*parts, drawn.curve("piston_force")])


def rod_forces(drawn: Drawn) -> bytes:
    """Return the force along the rod and the side force.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    return _forces(drawn, "rod_forces", [drawn.curve("rod_force"), drawn.curve("side_force", DASHED)])


def crankpin_forces(drawn: Drawn) -> bytes:
    """Return the tangential and the radial force on the crankpin.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    curves = [drawn.curve("tangential_force"), drawn.curve("radial_force", DASHED)]
    return _forces(drawn, "crankpin_forces", curves)


def torque(drawn: Drawn) -> bytes:
    """Return the crank torque and its mean.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    language, mean = drawn.language, displayed("mean_torque", drawn.results.summary["mean_torque"])
    row, unit = QUANTITIES["mean_torque"], unit_name("N*m", drawn.language)
    if abs(mean) < 1e-6 * float(np.max(np.abs(drawn.values("crank_torque")))):
        mean = 0.0
    label = f"{row.label(language)}, {number(mean, language, digits=4)} {unit}"
    line = Curve(row.symbol(language), label, np.full_like(drawn.degrees, mean), DASHED)
    figure = _over_cycle(drawn, [drawn.curve("crank_torque"), line], drawn.title("crank_torque"))
    return drawn.finished("torque", figure)
