"""What figures of linkages share: the look, a quantity for any key, and scales as drawings on paper state them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.locale import say
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.report.figure_look import LOOK, drawing_library, math_symbol, over_crank_angle, plain
from crankwork.report.language import number, symbol, unit_name
from crankwork.units import from_si

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS_PER_MM = 72 / 25.4
_DIGITS = 4


class Style(NamedTuple):
    """How a figure of a linkage is written: language, order of the links by number, how the numbers were made."""

    language: Language = "en"
    links: tuple[str, ...] = ()
    method: str = ""
    period: float = 0.0  # Of the law that drives; curves are over time then, and not over the crank angle [s]


PLAIN = Style()


def position_text(degrees: float, style: Style) -> str:
    """Return a crank angle with its unit, or the time where a law drives. [deg]"""
    if style.period:
        return (
            f"{number(degrees / 360.0 * style.period, style.language, digits=_DIGITS)} {unit_name('s', style.language)}"
        )
    return f"{number(degrees, style.language)}°"


def position_sign(style: Style, mark: str = "") -> str:
    """Return the symbol of the crank angle, or of the time where a law drives."""
    return f"${symbol('time' if style.period else 'crank_angle', style.language)}{mark}$"


@contextmanager
def figure_look() -> Iterator[None]:
    """Draw in the one look of all figures, whatever the settings of matplotlib are, and leave those alone."""
    mpl = drawing_library()
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(LOOK)
        yield


def quantity_of(key: str) -> Quantity:
    """Return the quantity of a key; that of `joint_force.A` is `joint_force`, with A added to name and symbol."""
    base = key.partition(".")[0]
    if base not in QUANTITIES:
        raise CrankworkError(f"{base} is not a quantity that figures know")
    return QUANTITIES[base]._replace(key=key)


def displayed_values(row: Quantity, values: Array) -> Array:
    """Return SI values in the display unit of a quantity."""
    shown: Array = from_si(values, row.unit)
    return shown


def axis_title(row: Quantity, language: Language) -> str:
    """Return the axis title of a quantity: name, symbol, unit."""
    unit = unit_name(row.unit, language)
    return f"{plain(row.label(language))} {math_symbol(row.symbol(language))}" + (f", {unit}" if unit else "")


_TICKS = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 90.0)
_MOST_TICKS = 12


def over_drive_angle(axes: Axes, ends: tuple[float, float], language: Language) -> None:
    """Make the horizontal axis the angle of the crank of a linkage between the ends of its motion. [deg]"""
    start, end = ends
    over_crank_angle(axes, end, language)
    if start:
        step = next((one for one in _TICKS if (end - start) / one <= _MOST_TICKS), _TICKS[-1])
        axes.set_xlim(start, end)
        axes.set_xticks([step * one for one in range(math.ceil(start / step), math.floor(end / step) + 1)])
    # a linkage has a crank, no crankshaft
    sign = math_symbol(QUANTITIES["crank_angle"].symbol(language))
    axes.set_xlabel(f"{say('drawing.angle_of_crank', language)} {sign}, °")


def over_time(axes: Axes, end: float, language: Language) -> None:
    """Make the horizontal axis the time from 0 to `end`. [s]"""
    axes.set_xlim(0, end)
    axes.set_xlabel(axis_title(QUANTITIES["time"], language))


def round_scale(least: float) -> float:
    """Return the smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not less.

    Examples
    --------
    >>> round_scale(0.013), round_scale(0.3), round_scale(0.5)
    (0.02, 0.4, 0.5)
    """
    power = math.floor(math.log10(least))
    for one in (1, 2, 2.5, 4, 5, 10):
        scale = float(f"{one}e{power}")
        if scale >= least * (1 - 1e-9):
            return scale
    return 10.0 ** (power + 1)


def scale_text(symbol: str, value: float, unit: str, language: Language) -> str:
    """Return a scale as drawings state it, `mu_v = 0.02 (m/s)/mm`."""
    name = unit_name(unit, language)
    name = f"({name})" if "/" in name else name
    return f"{math_symbol(symbol)} = {number(value, language)} {name}/{unit_name('mm', language)}"
