"""The look of figures: black lines told apart by style, axes through zero, symbols with upright subscripts."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.errors import MissingExtraError
from crankwork.locale import Refusal
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import key_unit, number, unit_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Style = str | tuple[float, tuple[float, ...]]
SOLID: Style = "-"
DASHED: Style = (0, (5, 2))
DASH_DOT: Style = (0, (7, 2, 1.5, 2))
DOTTED: Style = (0, (1.2, 1.6))
GREY = "0.45"
WIDTH = 6.4

BOTTOM = 0.62
_LEFT, _RIGHT, _TOP, _LEGEND_ROW = 0.98, 0.25, 0.12, 0.185
_TICK_LABELS = 0.6
LOOK: Any = {
    "font.family": "DejaVu Serif",
    "mathtext.fontset": "dejavuserif",
    "font.size": 9.0,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.2,
    "grid.color": "0.88",
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "svg.fonttype": "path",
    "svg.hashsalt": "crankwork",
}

# what would mean something in mathtext, where a name is the user's own
_MATH_SIGNS = frozenset(r"$#\{}%^_~&")


class Curve(NamedTuple):
    """A line of a figure: symbol as `base_subscript`, name, values in the unit of the axis, line style."""

    symbol: str
    label: str
    values: Array
    style: Style = SOLID


def drawing_library() -> ModuleType:
    """Return matplotlib, imported even where the environment asks for a way to show figures that is not installed."""
    known = "matplotlib" in sys.modules
    # matplotlib does not load at all where a notebook has left its own way to the programs that it starts
    shown_by = None if known else os.environ.pop("MPLBACKEND", None)
    try:
        import matplotlib as mpl  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_figures"), "figures") from None
    finally:
        if shown_by is not None:
            os.environ["MPLBACKEND"] = shown_by
    if shown_by:
        with contextlib.suppress(ValueError):
            mpl.rcParams["backend"] = shown_by
    return mpl


def plain(text: str) -> str:
    r"""Return a text with names of the user's own as matplotlib takes it for that.

    Examples
    --------
    >>> print(plain("force at the joint, $x^$"))
    force at the joint, \$x^\$
    """
    return text.replace("$", r"\$")


def math_symbol(symbol: str) -> str:
    r"""Return a symbol `base_subscript` as mathtext, its subscript upright.

    Examples
    --------
    >>> print(math_symbol("v_п.ср"), math_symbol("β"))
    $v_{\text{п.ср}}$ $β$
    """
    base, _, subscript = symbol.partition("_")
    if not _MATH_SIGNS.isdisjoint(subscript):
        return plain(f"{base} {subscript}")
    return rf"${base}_{{\text{{{subscript}}}}}$" if subscript else f"${base}$"


def with_unit(text: str, key: str, language: Language, *, per_area: bool = False) -> str:
    """Return an axis title, `text, unit`."""
    unit = unit_name(key_unit(key, per_area=per_area), language)
    return f"{text}, {unit}" if unit else text


def quantity_title(key: str, language: Language, *, per_area: bool = False) -> str:
    """Return the axis title of a quantity: name, symbol, unit."""
    row = QUANTITIES[key]
    name = f"{plain(row.label(language))} {math_symbol(row.symbol(language))}"
    return with_unit(name, key, language, per_area=per_area)


def new_figure(height: float, width: float = WIDTH) -> Figure:
    """Return an empty figure."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - an optional part

    return Figure(figsize=(width, height))


def add_axes(figure: Figure, language: Language, bottom: float, height: float) -> Axes:
    """Return axes across the figure, numbers printed as the language does."""
    from matplotlib.ticker import FuncFormatter  # noqa: PLC0415 - an optional part

    width, full = figure.get_size_inches()
    axes = figure.add_axes((_LEFT / width, bottom / full, (width - _LEFT - _RIGHT) / width, height / full))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: number(value, language)))
    axes.yaxis.set_label_coords(-_TICK_LABELS / (width - _LEFT - _RIGHT), 0.5)
    axes.grid(visible=True)
    axes.set_axisbelow(True)
    return axes


def single_axes(language: Language, legend_rows: int, *, height: float = 3.0) -> tuple[Figure, Axes]:
    """Return a figure with one pair of axes and room for a legend above it."""
    legend = _LEGEND_ROW * legend_rows + 0.06 if legend_rows else 0.0
    figure = new_figure(BOTTOM + height + _TOP + legend)
    return figure, add_axes(figure, language, BOTTOM, height)


def over_crank_angle(axes: Axes, end: float, language: Language) -> None:
    """Make the horizontal axis the crank angle from 0 to `end`. [deg]"""
    axes.set_xlim(0, end)
    axes.set_xticks(np.arange(0, end + 1, 90 if end > 360 else 30))
    axes.set_xlabel(quantity_title("crank_angle", language))


def through_zero(axes: Axes, *values: Array) -> None:
    """Scale the vertical axis to the values and let the horizontal axis cross it at zero.

    Tick labels stay below the figure, where no curve runs over them.
    """
    # what is not determined at an angle is no number there
    low = min(0.0, *(float(np.nanmin(one)) for one in values))
    high = max(0.0, *(float(np.nanmax(one)) for one in values))
    margin = 0.05 * (high - low) or 1.0
    axes.set_ylim(low - margin if low < 0 else 0, high + margin if high > 0 or low == 0 else 0)
    if low < 0 < high:
        axes.spines["bottom"].set_visible(False)
        axes.tick_params(axis="x", length=0)
        axes.axhline(0, color="black", linewidth=0.8)
        ticks = axes.get_xticks()
        axes.plot(ticks, np.zeros_like(ticks), "|", color="black", markersize=6, markeredgewidth=0.8, clip_on=False)


def draw_curves(axes: Axes, x: Array, curves: Sequence[Curve], *, one_row: bool = False) -> None:
    """Draw curves, and a legend above the axes that names them; one row of symbols suffices beside axis titles."""
    for curve in curves:
        name = math_symbol(curve.symbol) if one_row else f"{math_symbol(curve.symbol)} – {plain(curve.label)}"
        axes.plot(x, curve.values, color="black", linestyle=curve.style, label=name)
    if len(curves) > 1 or not one_row:
        legend_above(axes, columns=len(curves) if one_row else 1)


def legend_above(axes: Axes, *, columns: int = 1) -> None:
    """Put the legend above the axes, left aligned."""
    axes.legend(
        loc="lower left", bbox_to_anchor=(0, 1), ncols=columns, handlelength=3.2, labelspacing=0.25,
        borderpad=0.2, borderaxespad=0.1,
    )  # fmt: skip


def svg(figure: Figure, title: str, method: str, remark: str = "") -> bytes:
    """Return a figure as SVG, the same bytes every time."""
    height = figure.get_size_inches()[1]
    figure.text(0.985, 0.07 / height, method, color=GREY, size=7, ha="right", va="bottom")
    figure.text(0.02, 0.07 / height, remark, color=GREY, size=7, va="bottom")
    stream = io.BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": "crankwork", "Title": title})
    return stream.getvalue()
