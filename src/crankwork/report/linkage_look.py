"""Shared parts of figures of linkages: a quantity for any key, the axis of the driver, and scales."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.report.language import symbol
from crankwork.show.chart import ChartBox, Graph, round_ticks
from crankwork.show.paper import GREY, Canvas, plain
from crankwork.show.scene import DASH_DOT, printable
from crankwork.units import from_si

_DIGITS = 4
# what would mark something in a text of a figure, where a name is the user's own
_SIGNS = frozenset(r"$\#{}%^~&")


class Style(NamedTuple):
    """How a figure of a linkage is written: language, order of the links by number, how the numbers were made."""

    language: Language = "en"
    links: tuple[str, ...] = ()
    method: str = ""
    period: float = 0.0  # Of the law that drives; curves are over time then, and not over the crank angle [s]
    limits: tuple[float, ...] = ()  # Dead positions of a crank that turns back [deg]
    turns: str = "crank"  # What the angle is of: a linkage has a crank, no crankshaft


PLAIN = Style()


def math_symbol(sign: str, power: str = "") -> str:
    r"""Return a symbol `base_index` as figures set it, and one with a name that would mark something as plain text.

    `power`: what stands over the index, `^n`.

    Examples
    --------
    >>> print(math_symbol("v_п.ср"), math_symbol("F_$x^$"))
    $v_п.ср$ F \$x^\$
    """
    base, _, index = sign.partition("_")
    if _SIGNS.isdisjoint(index):
        return f"${sign}{power}$"
    return plain(f"{base} {index}") + (f"^{{{power[1:]}}}" if power else "")


def key_of_links(names: Mapping[int, str], numbers: Iterable[int]) -> list[str]:
    """Return the names of the links with these numbers on a plan, since tables use names."""
    shown = {number: printable(names[number], 20) for number in numbers if number in names}
    return [f"{number} – {plain(name)}" for number, name in shown.items() if name != str(number)]


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


_TICKS = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0, 720.0, 1800.0, 3600.0)
_MOST_TICKS, _AROUND, _BEYOND = 12, 0.5, 0.02


def angle_ticks(start: float, end: float) -> Array:
    """Return angles to mark between two, at most a dozen parts. [deg]"""
    most = 10.0 ** math.ceil(math.log10((end - start) / _MOST_TICKS))
    step = next((step_size for step_size in _TICKS if (end - start) / step_size <= _MOST_TICKS), most)
    counts = range(math.ceil(start / step - 1e-9), math.floor(end / step + 1e-9) + 1)
    return np.array([count * step for count in counts])


def drive_graph(
    paper: Canvas, box: ChartBox, abscissas: Array, y: tuple[float, float], style: Style, *, is_last: bool = True
) -> Graph:
    """Return a graph over the angle of the crank between the ends of its motion, or over the time, frame drawn.

    `at`: the angles [deg], or times where a law drives [s].
    """
    start, end = float(abscissas[0]), float(abscissas[-1])
    # an axis of one point goes around it
    start, end = (start, end) if end > start else (start - _AROUND, start + _AROUND)
    dead = () if style.period else style.limits
    if dead:
        room = _BEYOND * (dead[-1] - dead[0])
        start, end = min(start, dead[0] - room), max(end, dead[-1] + room)
    over = "time" if style.period else "crank_angle"
    graph = Graph(paper, box, (start, end), y, style.language, over)
    graph.frame(
        round_ticks(start, end) if style.period else angle_ticks(start, end),
        graph.up_ticks,
        labels=(is_last, True),
    )
    for limit in dead:
        x = float(graph.across(limit))
        paper.line([x, x], [graph.box.top, graph.box.top + graph.box.height], style=DASH_DOT, width=0.8, colour=GREY)
    if is_last:
        sign = math_symbol(QUANTITIES["crank_angle"].symbol(style.language))
        angle = f"{say(f'drawing.angle_of_{style.turns}', style.language)} {sign}, °"
        graph.x_title(axis_title(QUANTITIES["time"], style.language) if style.period else angle)
    return graph


def scale_text(sign: str, value: float, unit: str, language: Language) -> str:
    """Return a scale as drawings state it, `mu_v = 0.02 (m/s)/mm`."""
    name = unit_name(unit, language)
    name = f"({name})" if "/" in name else name
    return f"{math_symbol(sign)} = {number(value, language)} {name}/{unit_name('mm', language)}"
