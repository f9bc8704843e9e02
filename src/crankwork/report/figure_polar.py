"""The polar diagram of the load on the crankpin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crankwork.dynamics.piston_forces import rotating_inertia_force
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities import Language
from crankwork.report.figure_data import Drawn
from crankwork.report.figure_labels import Line, label_points
from crankwork.report.figure_look import figure_word, legend_above, math_symbol, single_axes
from crankwork.report.language import displayed

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT = 5.0
_MARK = 30.0
_MARGIN = 1.12


def crankpin_polar(drawn: Drawn) -> bytes:
    """Return the load of the rod on the crankpin, tangential forces to the right and radial forces downward.

    The curve is that of the rod's force; the inertia force of the rod mass at the crankpin is the same at
    every angle, so that it shifts the pole from which the load is measured, not the curve.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    across, along = drawn.values("tangential_force"), drawn.values("radial_force")
    inertia = _big_end_inertia(drawn)
    figure, axes = single_axes(drawn.language, 2 if inertia else 0, height=_HEIGHT)
    axes.plot(across, along, color="black")
    _equal_scale(axes, np.append(across, 0.0), np.append(along, [0.0, -inertia]))
    axes.axhline(0, color="black", linewidth=0.8)
    axes.axvline(0, color="black", linewidth=0.8)
    if inertia:
        _pole(axes, inertia, drawn.language)
    axes.set_xlabel(drawn.title("tangential_force"))
    axes.set_ylabel(drawn.title("radial_force"))
    marks = np.arange(0.0, drawn.results.machine.cycle, _MARK)
    at = np.searchsorted(drawn.degrees, marks)
    points = [(f"{mark:g}", float(across[i]), float(along[i])) for mark, i in zip(marks, at, strict=True)]
    cross: list[Line] = [([0, 0], list(axes.get_ylim())), (list(axes.get_xlim()), [0, 0])]
    label_points(axes, points, (across, along), *cross)
    return drawn.forces_finished("crankpin_polar", figure)


def _big_end_inertia(drawn: Drawn) -> float:
    """Return the inertia force of the rod mass at the crankpin, never positive. [display unit]"""
    solved = drawn.results.solved
    masses = solved.machine.masses
    if masses is None or not masses.rod_big_end:
        return 0.0
    force = rotating_inertia_force(masses.rod_big_end, solved.lengths.crank_radius, solved.speed)
    return displayed("rotating_inertia_force", float(force), per_area=drawn.area)


def _equal_scale(axes: Axes, x: Array, y: Array) -> None:
    """Fit the values into the axes with the same scale both ways, the vertical axis downward."""
    box = axes.get_window_extent()
    middle = (np.min(x) + np.max(x)) / 2, (np.min(y) + np.max(y)) / 2
    scale = _MARGIN * max(np.ptp(x) / box.width, np.ptp(y) / box.height) or 1.0
    axes.set_xlim(middle[0] - scale * box.width / 2, middle[0] + scale * box.width / 2)
    axes.set_ylim(middle[1] + scale * box.height / 2, middle[1] - scale * box.height / 2)


def _pole(axes: Axes, inertia: float, language: Language) -> None:
    """Mark the pole, and the inertia force from it to the origin of the curve."""
    axes.plot([0], [-inertia], "o", color="black", markersize=5, fillstyle="none", label=figure_word("pole", language))
    name = f"{math_symbol(figure_word('big_end_symbol', language))} – {figure_word('big_end_inertia', language)}"
    axes.annotate("", (0, 0), (0, -inertia), arrowprops={"arrowstyle": "-|>", "linewidth": 1.8, "color": "black",
                  "shrinkA": 3, "shrinkB": 0})  # fmt: skip
    axes.plot([], [], color="black", linewidth=1.8, label=name)
    legend_above(axes)
