"""What sheets have of links beside the figures: plans at a dozen positions, texts and tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.sampled_motion import SampledMotion, reached_angles, sample_motion
from crankwork.analysis.skeleton import Skeleton, numbered, skeleton
from crankwork.analysis.vector_polygons import accelerations, driver_rates, position_step, velocities
from crankwork.locale import decimal, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.structure import ROMAN, Structure, structure
from crankwork.note.sheets.packing import in_grid
from crankwork.note.sheets.sheet import Column, numbers, table, text_block
from crankwork.note.wording import named
from crankwork.quantities import Language
from crankwork.quantities.key import key_of
from crankwork.report.display import link_label, symbol
from crankwork.report.look import Style, displayed_values, math_symbol, position_text, quantity_of
from crankwork.report.plans import acceleration_plan, node_name, size_of, velocity_plan
from crankwork.report.summary import results_method
from crankwork.report.tables import any_nonzero
from crankwork.show.canvas import plain
from crankwork.show.scene import Drawing

# step of the motion that plans are taken from [deg]
_DENSE_STEP = 1.0
# which positions get an acceleration plan
_ACCELERATIONS = (1, 5, 9)
# points whose plans are compared, and what a reading on paper is rounded to [mm]
_MOST_COMPARED, _READING = 3, 1
# of the largest velocity or acceleration of a table, what is none
_ZERO_TOLERANCE = 1e-6
Draw = Callable[[], Drawing]
Pictures = dict[str, Draw]


def of_links(results: Results, language: Language) -> Pictures:
    """Return plans at a dozen positions, and the texts and tables of the sheets, of a linkage that was drawn."""
    machine = results.machine
    mechanism, (analysed, _) = machine.mechanism, structure(machine.drawn)
    style = Style(language, analysed.links if analysed is not None else (), period=results.period)
    degrees, _ = reached_angles(machine, _DENSE_STEP)
    angles = np.arange(0.0, 360.0, position_step(machine))
    nearest = [int(np.argmin(np.abs(degrees - angle))) for angle in angles]
    shown = [row for row, angle in zip(nearest, angles, strict=True) if abs(degrees[row] - angle) < _DENSE_STEP]
    data = positions(results, degrees[shown], skeleton(mechanism, style.links), style)
    drawn: Pictures = {"structure": partial(structure_block, data, analysed)} if analysed is not None else {}
    drawn |= {**motion_tables(data), **reactions_table(data)}
    return drawn | _plans(data, sample_motion(mechanism, data.degrees))


def _plans(data: Positions, moved: SampledMotion) -> Pictures:
    """Return velocity plans at all positions, acceleration plans at three of them, and the values read on them."""
    mechanism, style, language, scales = data.results.machine.mechanism, data.style, data.language, Scales()
    rates = driver_rates(data.results, data.columns)

    rows = range(len(data.degrees))
    chosen = [row for row in _ACCELERATIONS if row < len(rows)] or [0]
    first, second = rates.first.tolist(), rates.second.tolist()
    fast = [size_of(velocities(mechanism, moved, row, first[row], style.links)) for row in rows]
    faster = [size_of(accelerations(mechanism, moved, row, first[row], second[row], style.links)) for row in chosen]

    def moving_at(position: int) -> Drawing:
        plan = velocity_plan(mechanism, moved, position, first[position], style, position, fast)
        return scales.kept("v", position, plan)

    def accelerated(position: int) -> Drawing:
        plan = acceleration_plan(mechanism, moved, position, first[position], second[position], style, position, faster)
        return scales.kept("a", position, plan)

    moves = [row for row in rows if rates.first[row]]
    plans: Pictures = {
        "velocity_plans": _grid("velocity_plans", [partial(moving_at, row) for row in rows], 4, scales, language),
        "acceleration_plans": _grid(
            "acceleration_plans", [partial(accelerated, row) for row in chosen], 3, scales, language
        ),
        "scales": partial(scales_table, data, scales, {"v": moves, "a": chosen}),
    }
    if any(joint != data.shape.pin for joint in _joints(data, "point_velocity")):
        plans["compared"] = partial(compared_table, data, scales, [row for row in chosen if row in moves])
    return plans


def _grid(
    name: str, cells: Sequence[Callable[[], Drawing]], columns: int, scales: Scales, language: Language
) -> Callable[[], Drawing]:
    def remark() -> str:
        return translate("drawing.own_scales", language) if scales.differ(name[0]) else ""

    return partial(in_grid, cells, columns, translate(f"sheets.{name}", language), language, remark)


class Positions(NamedTuple):
    """Where a linkage is shown: results there by key, crank angles [deg], and the links as they are drawn."""

    results: Results
    columns: Mapping[str, Array]
    degrees: Array
    shape: Skeleton
    style: Style

    @property
    def language(self) -> Language:
        """The language of its texts."""
        return self.style.language

    def first(self, rows: Sequence[int]) -> list[Column]:
        """Return the columns that name these positions."""
        places = [position_text(float(self.degrees[row]), self.style) for row in rows]
        drive = symbol("time" if self.style.period else "crank_angle", self.language)
        position = Column(translate("columns.position", self.language), [str(row) for row in rows])
        return [position, Column(f"${drive}$", places)]

    def column(self, key: str, sign: str = "") -> Column:
        """Return a column of a quantity at all positions."""
        row, language = quantity_of(key), self.language
        head = f"{sign or math_symbol(row.symbol(language))}, {unit_name(row.unit, language)}"
        values = displayed_values(row, self.columns[key])
        return Column(head, numbers(values.tolist(), language))

    def number_of(self, link: str) -> str:
        """Return the number of a link, or its name where it has none."""
        own_number = next((member.number for member in self.shape.members if member.name == link), 0)
        return str(own_number) if own_number else plain(link)


def positions(results: Results, degrees: Array, shape: Skeleton, style: Style) -> Positions:
    """Return a linkage at crank angles. [deg]"""
    columns = without_rounding(results.columns_at(degrees), results.solved.speed)
    return Positions(results, columns, degrees, shape, style)


def structure_block(data: Positions, analysed: Structure) -> Drawing:
    """Draw the structure of the linkage: mobility, formula of structure and class, links, speed and method."""
    language, results = data.language, data.results
    count, low, high = len(analysed.links), analysed.joints, analysed.meshes
    sum_ = f"3·{count} − 2·{low}" + (f" − {high}" if high else "")
    entries = [
        f"${symbol('mobility', language)}$ = 3$n$ − 2$p_5$ − $p_4$ = {sum_} = {analysed.mobility}",
        f"{analysed.formula.replace('->', '→')}",
        f"{translate('columns.class', language)}: {ROMAN[min(analysed.number, len(ROMAN) - 1)]}",
    ]
    speed = results.solved.speed
    if speed and not data.style.period:
        row = quantity_of("rotational_speed")
        turns = number(float(displayed_values(row, np.asarray(speed))), language)
        entries.append(f"${row.symbol(language)}$ = {turns} {unit_name(row.unit, language)}")
        shown = number(float(f"{speed:.6g}"), language)
        entries.append(f"${symbol('speed', language)}_1$ = {shown} {unit_name('rad/s', language)}")
    entries.append(f"{translate('report.method', language)}: {results_method(results, language)}")
    names = ((number, link_label(name, language).replace("_", " ")) for number, name in numbered(data.shape) if number)
    links = [f"{number} – {plain(name)}" for number, name in names]
    if any(not link.endswith(f" {link.partition(' ')[0]}") for link in links):
        entries.append(f"{translate('columns.members', language)}: {', '.join(links)}")
    return text_block(entries, translate("headings.structure", language), language)


def motion_tables(data: Positions) -> dict[str, Draw]:
    """Return functions that draw the tables of velocities and of accelerations at all positions."""
    drawn: dict[str, Draw] = {}
    kinds = {
        "velocities": ("point_velocity", "slider_velocity", "link_angular_velocity"),
        "accelerations": ("point_acceleration", "slider_acceleration", "link_angular_acceleration"),
    }
    for name, (points, sliders, links) in kinds.items():
        columns = [data.column(f"{points}.{joint}") for joint in _joints(data, points)]
        columns += [data.column(key) for key in named(data.columns, sliders)]
        mark = symbol("speed" if name == "velocities" else "angular_acceleration", data.language)
        for key in named(data.columns, links):
            columns.append(data.column(key, f"${mark}_{data.number_of(key.partition('.')[2])}$"))
        if columns:
            title = translate(f"captions.{name}", data.language)
            drawn[name] = partial(table, data.first(range(len(data.degrees))), columns, title, data.language)
    return drawn


def _joints(data: Positions, kind: str) -> list[str]:
    """Return the points that are joints or draw a path, and of which results have a column."""
    shape = data.shape
    return [name for name in shape.letters if f"{kind}.{name}" in data.columns and name not in shape.centres]


def reactions_table(data: Positions) -> dict[str, Draw]:
    """Return the function that draws the table of forces in joints and guides and of the balancing torque or force."""
    kinds = ("joint_force", "normal_force", "balancing_torque", "driver_force")
    keys = [key for key in data.columns if key_of(key).quantity in kinds]
    keys = any_nonzero(keys, data.columns)
    if not any("." in key for key in keys):
        return {}
    columns = [data.column(key) for key in keys]
    title = translate("sheets.reactions", data.language)
    return {"reactions": partial(table, data.first(range(len(data.degrees))), columns, title, data.language)}


class Scales:
    """The scales of plans, as they were last drawn, by kind and position. [unit/mm]"""

    def __init__(self) -> None:
        self._found: dict[tuple[str, int], float] = {}

    def kept(self, sign: str, position: int, drawing: Drawing) -> Drawing:
        """Return a plan, and keep its scale."""
        (plot,) = drawing.plots
        self._found[sign, position] = (plot.x[1] - plot.x[0]) / plot.box.width
        return drawing

    def differ(self, sign: str) -> bool:
        """Return whether plans of a kind have scales of their own."""
        return len({f"{scale:.5g}" for (kind, _), scale in self._found.items() if kind == sign}) > 1

    def of(self, sign: str, position: int) -> float:
        """Return the scale of a plan, not a number where there is none."""
        return self._found.get((sign, position), float("nan"))


def scales_table(data: Positions, scales: Scales, seen: Mapping[str, Sequence[int]]) -> Drawing:
    """Draw the scales of the plans at all positions; `seen`: which positions have a plan that shows anything."""
    language, rows, columns = data.language, list[str](), list[list[str]]([] for _ in data.degrees)
    for sign, unit in (("v", "m/s"), ("a", "m/s2")):
        rows.append(f"$μ_{sign}$, ({unit_name(unit, language)})/{unit_name('mm', language)}")
        for position, column in enumerate(columns):
            is_seen = position in seen[sign]
            column.append(number(float(f"{scales.of(sign, position):.4g}"), language) if is_seen else "–")
    before = Column(translate("columns.position", language), rows)
    positions_ = [Column(str(position), column) for position, column in enumerate(columns)]
    return table([before], positions_, translate("sheets.scales", language), language)


def compared_table(data: Positions, scales: Scales, rows: Sequence[int]) -> Drawing:
    """Draw measured values on the plans at some positions beside calculated ones, and the difference."""
    language, pin = data.language, data.shape.pin
    points = [joint for joint in _joints(data, "point_velocity") if joint != pin][:_MOST_COMPARED]
    lines = [(position, name) for position in rows for name in points]
    shown: list[Column] = []
    for sign, key, unit in (("v", "point_velocity", "m/s"), ("a", "point_acceleration", "m/s2")):
        exact = [float(data.columns[f"{key}.{name}"][position]) for position, name in lines]
        known = [scales.of(sign, position) for position, _ in lines]
        # as they are read on paper [mm]
        ends = [round(value / scale, _READING) if math.isfinite(scale) else 0.0
                for value, scale in zip(exact, known, strict=True)]  # fmt: skip
        plans = [end * scale for end, scale in zip(ends, known, strict=True)]
        # values that are very small against the others have no relative difference
        least = _ZERO_TOLERANCE * max(exact, default=0.0)
        off = [100 * (drawn - calculated) / calculated if calculated > least else math.nan
               for drawn, calculated in zip(plans, exact, strict=True)]  # fmt: skip
        per, mm = unit_name(unit, language), unit_name("mm", language)
        shown += [
            Column(f"${sign}$ {translate('sheets.on_plan', language)}, {mm}", [number(end, language) for end in ends]),
            Column(f"${sign}$ {translate('sheets.graphic', language)}, {per}", numbers(plans, language)),
            Column(f"${sign}$ {translate('sheets.analytic', language)}, {per}", numbers(exact, language)),
            Column(f"Δ${sign}$, %", [_share(share, language) for share in off]),
        ]
    before = [
        *data.first([position for position, _ in lines]),
        Column(translate("columns.point", language), [node_name(plain(data.shape.letters[name])) for _, name in lines]),
    ]
    return table(before, shown, translate("sheets.compared", language), language)


def _share(value: float, language: Language) -> str:
    """Return a share to a hundredth of a percent, as lengths are read to a tenth of a millimetre."""
    shown = f"{value:.2f}".replace("-0.00", "0.00")
    return decimal(shown, language).replace("-", "−") if math.isfinite(value) else "–"
