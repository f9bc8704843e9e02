"""How figures of a machine tell it: its curves and values as displayed, titles, symbols, units, scales and axes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, TypeVar

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.bearings import BearingDiagrams
from crankwork.analysis.constructions import fine_columns
from crankwork.analysis.load_diagrams import EngineDiagrams
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.sampled_motion import reached_angles
from crankwork.analysis.vector_polygons import worked_position
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import ProcedureValue, breakpoints_of
from crankwork.locale import capital, has_text, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.structure import structure
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit, link_label, row_name, symbol
from crankwork.show.canvas import (
    GREY,
    MM,
    WIDER,
    Canvas,
    current_layout,
    is_narrow,
    plain,
    points_per_mm,
    round_scale,
    text_width,
)
from crankwork.show.chart import ChartBox, Graph, round_ticks, write_remark
from crankwork.show.scene import DASH_DOT, Drawing, Pen, printable, rotation_arrow
from crankwork.units import from_si

_DENSE_STEP = 2.0
# behind a corner, where there may be a jump [deg]
_AFTER = 1e-6
_DIGITS = 4
# length of a scale bar at least, radius of an arrow of rotation [mm]
_BAR, _ROTATION = 10.0, 5.0
# what would mark something in a text of a figure, where a name is the user's own
_SIGNS = frozenset(r"$\#{}%^~&")


def kind_of(name: str) -> str:
    """Return the name of a figure without the number of a crankpin, or of one that goes on."""
    return name.rstrip("0123456789").rstrip("_")


def figure_title(name: str, language: Language) -> str:
    """Return the title of a figure, for its caption."""
    kind = kind_of(name)
    number = name.removeprefix(kind).removeprefix("_")
    # some are called what their table or their quantity is
    room = next((room for room in ("figures", "tables", "quantities") if has_text(f"{room}.{kind}")), "")
    title = capital(translate(f"{room}.{kind}", language)) if room else plain(kind)
    return title + (f", {number}" if number else "")


class Style(NamedTuple):
    """How a figure is written: language, order of the links by number."""

    language: Language = "en"
    links: tuple[str, ...] = ()
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


_Number = TypeVar("_Number", int, str)


def key_of_links(names: Mapping[_Number, str], numbers: Iterable[_Number], language: Language) -> list[str]:
    """Return the names of the links or chambers with these numbers in a figure, since tables use names."""
    shown = {number: printable(link_label(names[number], language), 20) for number in numbers if number in names}
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
    base = key_of(key).quantity
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
# parts of an axis at most, on a page and in a column
_MOST_TICKS, _AROUND, _BEYOND = (12, 8), 0.5, 0.02


def angle_ticks(start: float, end: float) -> Array:
    """Return angles to mark between two, at most a dozen parts. [deg]"""
    least = (end - start) / _MOST_TICKS[is_narrow()]
    step = next((step_size for step_size in _TICKS if least <= step_size), 10.0 ** math.ceil(math.log10(least)))
    counts = range(math.ceil(start / step - 1e-9), math.floor(end / step + 1e-9) + 1)
    return np.array([count * step for count in counts])


def drive_graph(
    paper: Canvas, box: ChartBox, abscissas: Array, y: tuple[float, float], style: Style, *, is_last: bool = True
) -> Graph:
    """Return a graph over the angle of the crank between the ends of its motion, or over the time, frame drawn.

    `abscissas`: the angles [deg], or times where a law drives [s].
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
        paper.line([x, x], [graph.box.top, graph.box.top + graph.box.height], style=DASH_DOT, width=0.45, colour=GREY)
    if is_last:
        sign = math_symbol(QUANTITIES["crank_angle"].symbol(style.language))
        angle = f"{translate(f'drawing.angle_of_{style.turns}', style.language)} {sign}, °"
        graph.x_title(axis_title(QUANTITIES["time"], style.language) if style.period else angle)
    return graph


def scale_text(sign: str, value: float, unit: str, language: Language) -> str:
    """Return a scale as drawings state it, `mu_v = 0.02 (m/s)/mm`."""
    name = unit_name(unit, language)
    name = f"({name})" if "/" in name else name
    return f"{math_symbol(sign)} = {number(value, language)} {name}/{unit_name('mm', language)}"


def draw_scale(
    paper: Canvas, place: tuple[float, float], scale: tuple[str, float, str], language: Language, before: str = ""
) -> None:
    """Draw a scale, its symbol, value and unit: on a sheet in words, elsewhere as a bar, which is right in any size."""
    (x, y), (sign, value, unit) = place, scale
    if current_layout().is_sheet:
        paper.text(x, y, before + scale_text(sign, value, unit, language))
        return
    paper.text(x, y, before)
    x += text_width(before, 8.0) * WIDER
    shown = round_scale(value * _BAR, (1, 2, 5))
    length = shown / value * points_per_mm()
    paper.segments(
        np.array([(x, y, x + length, y), (x, y - 2.5, x, y + 2.5), (x + length, y - 2.5, x + length, y + 2.5)])
    )
    paper.text(x + length + 5, y + 3, f"{number(shown, language)} {unit_name(unit, language)}")


def draw_rotation(graph: Graph, pivot: Array, arms: Array) -> None:
    """Draw an arrow above the pivot of a crank; `arms`: the crank at two angles, one after the other, shape (2, 2)."""
    x, y = graph.point(*pivot)
    sense = arms[0, 0] * arms[1, 1] - arms[0, 1] * arms[1, 0]
    graph.paper.items += rotation_arrow((x * MM, -y * MM), _ROTATION, sense, kind=Pen(0.45 * MM))


class Reached(NamedTuple):
    """A machine over its motion: angles [deg], columns [SI], the row that is worked, whether it is a whole cycle."""

    degrees: Array
    columns: Mapping[str, Array]
    row: int
    is_whole: bool


@dataclass(frozen=True)
class Drawn:
    """Data of the figures of a machine, with its values, units and titles as displayed."""

    results: Results
    language: Language
    area: float | None  # Of the piston, by which forces are divided [m2]
    plans: tuple[list[tuple[float, float]], ...] = ()  # Sizes of plans of both kinds that stand there by turns

    @property
    def has_piston(self) -> bool:
        """Whether the motion of a piston is known."""
        return "piston_displacement" in self.results.columns

    @cached_property
    def style(self) -> Style:
        """How its figures are written."""
        results, machine = self.results, self.results.machine
        if machine.alone in ("turning", "torsion", "rotor"):
            return Style(self.language, turns="shaft")
        if machine.linkage is None:
            return Style(self.language, period=results.period)
        links, _ = structure(machine.linkage)
        ends = [results.summary[key] for key in ("crank_range_start", "crank_range_end") if key in results.summary]
        names = () if links is None else links.links
        return Style(self.language, names, results.period, tuple(np.degrees(ends).tolist()))

    @cached_property
    def reached(self) -> Reached:
        """Its columns at close angles as far as links reach, between its dead positions; of a table at its rows."""
        results = self.results
        if results.machine.rotor is not None:
            degrees = np.arange(361.0)
            return Reached(degrees, results.columns_at(degrees), 0, is_whole=True)
        if results.machine.linkage is None:
            columns = without_rounding(results.columns, results.machine.speed)
            return Reached(*_closed(results.grid.degrees, columns, results.machine.cycle), 0, is_whole=True)
        degrees, is_whole = reached_angles(results.machine, _DENSE_STEP)
        worked = worked_position(results)
        degrees = np.union1d(_with_corners(results, degrees), worked)
        columns = without_rounding(results.columns_at(degrees), results.solved.speed)
        return Reached(degrees, columns, int(np.searchsorted(degrees, worked)), is_whole)

    def at(self, degrees: Array) -> Iterator[Drawn]:
        """Yield it at some crank angles. [deg]"""
        angles = np.union1d(self.reached.degrees, degrees)
        columns = without_rounding(self.results.columns_at(angles), self.results.solved.speed)
        for row in np.searchsorted(angles, degrees).tolist():
            moved = replace(self)
            vars(moved)["reached"] = Reached(angles, columns, row, self.reached.is_whole)
            yield moved

    @cached_property
    def _fine(self) -> tuple[Array, Mapping[str, Array]]:
        fine = fine_columns(self.results)
        return fine.degrees, fine.columns

    @property
    def degrees(self) -> Array:
        """Crank angles of the columns of a piston, finer than tables. [deg]"""
        return self._fine[0]

    @property
    def columns(self) -> Mapping[str, Array]:
        """Columns of a piston. [SI]"""
        return self._fine[1]

    @property
    def cycle(self) -> float:
        """Length of the cycle. [deg]"""
        return self.results.machine.cycle

    @property
    def per_area(self) -> bool:
        """Whether forces are per piston area."""
        return self.area is not None

    def shown(self, key: str, values: Array | float) -> Array:
        """Return SI values in the display unit of a quantity. [display unit]"""
        return np.asarray(values) * displayed(key, 1.0, per_area=self.area)

    def unit(self, key: str) -> str:
        """Return the display unit of a quantity as the language prints it."""
        return unit_name(key_unit(key, per_area=self.per_area), self.language)

    def symbol(self, key: str) -> str:
        """Return the symbol of a quantity, between dollar signs."""
        return f"${QUANTITIES[key].symbol(self.language)}$"

    def title(self, key: str) -> str:
        """Return the axis title of a quantity: name, symbol, unit."""
        unit = self.unit(key)
        return f"{QUANTITIES[key].label(self.language)} {self.symbol(key)}" + (f", {unit}" if unit else "")

    def name_axes(self, graph: Graph, across: str, up: str) -> None:
        """Write the titles of both axes."""
        graph.x_title(self.title(across))
        graph.y_title(self.title(up))

    def named(self, key: str) -> str:
        """Return symbol and name of a quantity for a legend."""
        return f"{self.symbol(key)} – {QUANTITIES[key].label(self.language)}"

    def value(self, key: str, value: float, digits: int = 4) -> str:
        """Return an SI value with its unit."""
        shown = self.number(float(self.shown(key, value)), digits)
        unit = self.unit(key)
        return f"{shown}{unit}" if unit in ("", "°") else f"{shown}\N{NO-BREAK SPACE}{unit}"

    def stated(self, key: str, value: float) -> str:
        """Return symbol, SI value with its unit, and name of a quantity."""
        symbol, _, name = self.named(key).partition(" – ")
        return f"{symbol} = {self.value(key, value)} – {name}"

    def number(self, value: float, digits: int = 6) -> str:
        """Return a number as the language prints it."""
        return number(float(f"{value:.{digits}g}"), self.language, digits=max(digits, 9))

    def finished(self, name: str, paper: Canvas, remark: str = "", *, forces: bool = False, owner: str = "") -> Drawing:
        """Return a figure with its title; `owner`: what it is of."""
        if forces and self.per_area:
            remark = "; ".join(text for text in (remark, translate("report.per_area", self.language)) if text)
        write_remark(paper, remark)
        title = figure_title(name, self.language)
        return paper.drawing(f"{title}, {owner}" if owner else title, self.language)

    @cached_property
    def diagrams(self) -> EngineDiagrams:
        """Curves and diagrams of all cylinders."""
        return EngineDiagrams(self.results)

    @cached_property
    def bearings(self) -> BearingDiagrams:
        """The loads of its bearings."""
        return BearingDiagrams(self.results)

    @property
    def cylinders(self) -> int:
        """How many cylinders its torque is one of; none of a linkage."""
        return self.diagrams.count if self.has_piston else 0

    @property
    def shaft_frame(self) -> str:
        """The frame of the loads of main journals in words."""
        return "crank_one" if self.has_piston else "crank_up"

    def row(self, kind: str, name: str) -> str:
        """Return the name of a bearing in listings, a joint its own; `kind`: `crankpin` or `main_journal`."""
        return f"{kind}.{name}" if self.has_piston else name

    def row_text(self, kind: str, name: str) -> str:
        """Return what a bearing is called."""
        return row_name(self.row(kind, name), self.language) if self.has_piston else plain(name)

    def values(self, key: str) -> Array:
        """Return a column in its display unit."""
        return self.shown(key, self.columns[key])

    @property
    def other_pressures(self) -> dict[int, Array]:
        """Gas pressure of cylinders whose gas is not that of the first, by number, at their own crank angle. [MPa]"""
        machine = self.results.machine
        if machine.engine is None or not machine.engine.gases:
            return {}
        pressures = self.diagrams.other_pressures(self.degrees)
        return {number: self.shown("gas_pressure", pressure) for number, pressure in pressures.items()}


def drawn_of(results: Results, language: Language, *, per_area: bool = False) -> Drawn:
    """Return what the figures of a machine are drawn from."""
    area = results.summary.get("piston_area") if per_area else None
    if per_area and area is None and "piston_force" in results.columns:
        raise CrankworkError("forces per piston area need cylinder.bore")
    return Drawn(results, language, area)


def _with_corners(results: Results, degrees: Array) -> Array:
    """Return crank angles with those of extremes, and on both sides of where a load jumps or bends. [deg]"""
    breaks = breakpoints_of(
        [results.trace[key] for key in results.columns if key in results.trace], results.machine.cycle
    )
    single = (results.trace[key].node for key in results.summary if key in results.trace)
    extremes = [node.at for node in single if isinstance(node, ProcedureValue) and node.at is not None]
    breaks = np.concatenate([breaks - _AFTER, breaks, breaks + _AFTER, extremes])
    return np.union1d(degrees, breaks[(breaks >= degrees[0]) & (breaks <= degrees[-1])])


def _closed(degrees: Array, columns: Mapping[str, Array], cycle: float) -> tuple[Array, Mapping[str, Array]]:
    """Return a table closed over its cycle, with the first row repeated at the end."""
    step = float(degrees[-1] - degrees[-2]) if degrees.size > 1 else 0.0
    if not step or degrees[0] != 0 or abs(degrees[-1] + step - cycle) > _AFTER:
        return degrees, columns
    return np.append(degrees, cycle), {key: np.append(column, column[0]) for key, column in columns.items()}
