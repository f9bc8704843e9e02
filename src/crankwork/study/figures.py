"""Figures of a study: histograms, Pareto set, best designs, sensitivity; of a map: contour lines, or a curve."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Quantity
from crankwork.quantities.key import key_of
from crankwork.report.display import FILE_KEYS, displayed, displayed_column, key_unit, label
from crankwork.show.canvas import BLACK, GREY, WIDER, current_layout, fitted_lines, plain, text_width
from crankwork.show.chart import CIRCLE, DOT, Field, Graph, Row, contours, limits, round_ticks, sheet, small_text
from crankwork.show.scene import DASH_DOT, DASHED, Drawing
from crankwork.study.chunks import Histogram, Index, StudyAggregate, feasible_designs, is_shown, thin_front
from crankwork.study.parameter_map import Map
from crankwork.study.study_file import Study
from crankwork.study.study_text import axis_title, ranked, value_text
from crankwork.study.varied_field import VariedField
from crankwork.units import coherent_unit, from_si, use_units

_TALL, _LINES_TALL, _BAR = 190.0, 210.0, 21.0
_DIGITS, _FEW = 6, 4
# axes besides that of the objective, and dots of a Pareto set
_AXES, _DOTS = 6, 1000
_DARK, _FAINT = "#8c8c8c", "#cfcfcf"
_MAP_TALL, _WIDE_TALL = 250.0, 190.0
_LINES = 9
_MAP_DIGITS = 5


def found_drawings(study: Study, aggregate: StudyAggregate, language: Language) -> dict[str, Drawing]:
    """Return the figures of a study by name."""
    with use_units(study.units):
        return dict([
            *_histograms(study, aggregate, language), *_scatters(study, aggregate, language),
            *_parallels(study, aggregate, language), *_indices(study, aggregate, language),
        ])  # fmt: skip


def _span(values: Array) -> tuple[float, float]:
    """Return the ends of a scale that holds all values with a margin."""
    low, high = float(values.min()), float(values.max())
    room = 0.04 * (high - low) or 0.04 * abs(high) or 1.0
    return low - room, high + room


def _histograms(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, Drawing]]:
    for key, histogram in aggregate.histograms.items():
        if len(histogram.counts) > 1:
            yield f"histogram.{key}", _histogram(study, key, histogram, language)


def _histogram(study: Study, key: str, histogram: Histogram, language: Language) -> Drawing:
    """Return the histogram of a value, with the stated machine and the limits."""
    edges = displayed_column(key, histogram.edges)
    stated = displayed(key, study.stated[key])
    ends = [displayed(key, limit) for limit in study.limits.get(key, ()) if math.isfinite(limit)]
    rows = [Row(translate("study.as_stated", language, value=value_text(key, study.stated[key], language)), DASHED)]
    if ends:
        shown = " … ".join(dict.fromkeys(number(end, language, digits=_DIGITS) for end in ends))
        rows.append(Row(f"{translate('study.limit', language)} {shown} {unit_name(key_unit(key), language)}", DASH_DOT))
    paper, box = sheet(_TALL, [row._replace(text=plain(row.text)) for row in rows])
    x = _span(np.array([edges[0], edges[-1], stated, *ends]))
    top = 1.06 * max(histogram.counts)
    graph = Graph(paper, box, x, (0.0, top), language)
    steps, heights = np.repeat(edges, 2), np.concatenate([[0.0], np.repeat(histogram.counts, 2), [0.0]])
    graph.shade(steps, heights)
    graph.frame(round_ticks(*x), graph.up_ticks)
    graph.curve("count", steps, heights, width=0.45)
    for level, style in ((stated, DASHED), *((end, DASH_DOT) for end in dict.fromkeys(ends))):
        graph.curve("", [level, level], [0.0, top], style, width=0.9)
    graph.x_title(axis_title(key, language))
    graph.y_title(translate("study.count", language))
    return paper.drawing(translate("study.histogram_of", language, name=label(key, language)), language)


def _scatters(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the Pareto set over each two objectives, among the plotted designs."""
    for index, pair in enumerate(itertools.combinations(study.objectives, 2)):
        yield f"pareto_{index + 1}" if index else "pareto", _scatter(study, aggregate, pair, language)


def _scatter(study: Study, aggregate: StudyAggregate, pair: tuple[str, str], language: Language) -> Drawing:
    x, y = (displayed_column(key, aggregate.values[study.keys.index(key)]) for key in pair)
    best, pareto = ranked(study, aggregate)
    few = pareto[thin_front(np.array([x[pareto], y[pareto]]).T, np.arange(pareto.size), _DOTS)]
    is_within = feasible_designs(study, aggregate.values)
    shown = is_shown(study, aggregate.numbers) & np.isfinite(x) & np.isfinite(y)
    rows = [
        Row(translate("study.pareto_dots", language), DOT),
        Row(translate("study.best_dots", language), CIRCLE),
        Row(translate("study.some_within" if study.limits else "study.some", language), DOT, colour=_DARK),
    ]
    if study.limits:
        rows.append(Row(translate("study.some_outside", language), DOT, colour=_FAINT))
    paper, box = sheet(_LINES_TALL + 30, rows)
    seen = np.concatenate([few, np.flatnonzero(shown)])
    graph = Graph(paper, box, _span(x[seen]), _span(y[seen]), language)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    outside, inside = np.flatnonzero(shown & ~is_within), np.flatnonzero(shown & is_within)
    for rows_of, fill, radius in ((outside, _FAINT, 1.3), (inside, _DARK, 1.3), (few, BLACK, 1.5)):
        for index in rows_of:
            paper.dot(*graph.point(float(x[index]), float(y[index])), radius, fill=fill)
    for key in pair:
        for index in best[key][:1]:
            paper.dot(*graph.point(float(x[index]), float(y[index])), 2.8, fill="#ffffff", width=0.9)
    graph.x_title(_wanted(study, pair[0], language))
    graph.y_title(_wanted(study, pair[1], language))
    return paper.drawing(translate("study.pareto_of", language), language)


def _wanted(study: Study, key: str, language: Language) -> str:
    """Return the title of the axis of an objective: name, unit and sense."""
    end = "study.small_wanted" if study.objectives[key] > 0 else "study.large_wanted"
    return f"{axis_title(key, language)} ({translate(end, language)})"


class _Axis:
    """Axis of parallel coordinates: name, texts at its ends, and positions of designs from 0 to 1."""

    def __init__(self, name: str, values: Array, ends: tuple[str, str], span: tuple[float, float]) -> None:
        self.name, self.ends = name, ends
        low, high = span
        self.at = (values - low) / (high - low) if high > low else np.full(values.shape, 0.5)

    @classmethod
    def of_field(cls, field: VariedField, values: Array, language: Language) -> _Axis:
        """Return the axis of a field over its range; values that are not numbers by their order."""
        if field.number is None:
            return cls(field.key, values, (str(field.values[0]), str(field.values[-1])), (0.0, len(field.values) - 1.0))
        least, _, most = field.span
        if field.law == "normal":
            least, most = float(values.min()), float(values.max())
        ends = [number(float(from_si(end, field.unit)), language, digits=_FEW) for end in (least, most)]
        unit = unit_name(field.unit, language)
        return cls(field.key, values, (f"{ends[0]} {unit}".rstrip(), f"{ends[1]} {unit}".rstrip()), (least, most))

    @classmethod
    def of_value(cls, key: str, values: Array, language: Language) -> _Axis:
        """Return the axis of a value between the least and the largest one plotted."""
        least, most = float(np.nanmin(values)), float(np.nanmax(values))
        ends = value_text(key, least, language, _FEW), value_text(key, most, language, _FEW)
        return cls(label(key, language), values, ends, (least, most))


def _parallels(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the best designs of each objective across the fields that vary."""
    best, _ = ranked(study, aggregate)
    background = np.flatnonzero(is_shown(study, aggregate.numbers) & np.isfinite(aggregate.values).all(axis=0))
    for key, rows in best.items():
        if not rows.size:
            continue
        shown = np.concatenate([background, rows])
        axes = [_Axis.of_field(*pair, language) for pair in zip(study.varied, aggregate.fields[:, shown], strict=True)]
        last = _Axis.of_value(key, aggregate.values[study.keys.index(key), shown], language)
        for index, first in enumerate(range(0, len(axes), _AXES)):
            title = translate("study.parallel_of", language, name=label(key, language))
            name = f"parallel.{key}" + (f"_{index + 1}" if index else "")
            yield name, _parallel([*axes[first : first + _AXES], last], background.size, rows, title, language)


def _parallel(axes: list[_Axis], background: int, best: Index, title: str, language: Language) -> Drawing:
    rows = [
        Row(translate("study.best_line", language), width=0.9),
        Row(translate("study.best_lines", language, count=str(best.size)), width=0.45),
        Row(translate("study.some", language), width=0.45, colour=_FAINT),
    ]
    edge = 56.0
    across = np.linspace(edge, current_layout().width - edge, len(axes))
    room = min((across[1] - across[0]) - 6, 2 * edge - 8) / WIDER
    names = [_fitted(axis.name, room) for axis in axes]
    paper, box = sheet(_LINES_TALL, rows, below=24.0 + 10.0 * max(map(len, names)))
    top, bottom = box.top + 12, box.top + box.height
    down = np.array([bottom - (bottom - top) * axis.at for axis in axes])
    for index in range(background):
        paper.line(across, down[:, index], width=0.45, colour=_FAINT)
    paper.segments(np.array([(x, top, x, bottom) for x in across]), width=0.45, colour=GREY)
    for index in range(down.shape[1] - 1, background - 1, -1):
        paper.line(across, down[:, index], width=0.9 if index == background else 0.45)
    for x, coordinate, name in zip(across.tolist(), axes, names, strict=True):
        small_text(paper, x, top - 5, plain(coordinate.ends[1]))
        small_text(paper, x, bottom + 10, plain(coordinate.ends[0]))
        for index, part in enumerate(name):
            paper.text(x, bottom + 23 + 10 * index, plain(part), size=8.0, anchor="middle")
    return paper.drawing(title, language)


def _fitted(name: str, room: float) -> tuple[str, ...]:
    """Return a name broken into lines, a key of the file at its dots and underscores."""
    if " " in name:
        return fitted_lines(name, 8.0, room)
    lines: list[str] = []
    for part in name.replace(".", ". ").replace("_", "_ ").split():
        if lines and text_width(lines[-1] + part, 8.0) <= room:
            lines[-1] += part
        else:
            lines.append(part)
    return tuple(lines)


def _indices(study: Study, aggregate: StudyAggregate, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the Sobol indices of each value, of first order and total, the greatest first."""
    for key, shares in aggregate.shares.items():
        indices = shares.indices()
        if indices is not None:
            yield f"sensitivity.{key}", _bars(study, key, np.array(indices), language)


def _bars(study: Study, key: str, indices: Array, language: Language) -> Drawing:
    rows = [Row(translate(f"study.{bar}", language), width=0.0) for bar in ("bars_alone", "bars_whole", "bars_error")]
    order = np.argsort(-indices[2], kind="stable")
    paper, box = sheet(_BAR * len(order) + 8, rows, below=34.0)
    names = [study.varied[index].key for index in order]
    left = max(WIDER * text_width(name, 8.5) for name in names) + 12
    box = box._replace(left=left, width=current_layout().width - left - 78)
    graph = Graph(
        paper,
        box,
        (0.0, max(1.0, 1.02 * float((indices[::2] + indices[1::2]).max()))),
        (float(len(order)), 0.0),
        language,
    )
    ticks = round_ticks(*graph.x)
    graph.frame(ticks, np.zeros(0), labels=(True, False))
    for row, field in enumerate(order):
        first, first_error, total, total_error = indices[:, field].tolist()
        alone = max(first, 0.0), first_error, 0.18, graph.hatch
        for value, error, low, fill in (alone, (max(total, 0.0), total_error, 0.5, graph.shade)):
            high = low + 0.32
            corners = np.array([0.0, value, value, 0.0]), row + np.array([low, low, high, high])
            fill(*corners)
            graph.curve("", np.append(corners[0], 0.0), np.append(corners[1], row + low), width=0.45)
            middle = row + (low + high) / 2
            graph.curve("", [max(value - error, 0.0), value + error], [middle, middle], width=0.9)
        y = float(graph.down(row + 0.5)) + 3
        paper.text(left - 6, y, plain(names[row]), size=8.5, anchor="end")
        share = " / ".join(number(round(100 * max(fraction, 0.0), 1), language) for fraction in (first, total))
        paper.text(box.left + graph.box.width + 6, y, f"{share} %", size=8.0)
    graph.x_title(translate("study.share", language))
    return paper.drawing(translate("study.sensitivity_of", language, name=label(key, language)), language)


def map_drawings(parameter_map: Map, language: Language) -> dict[str, Drawing]:
    """Return a figure of every value that depends on a field, over the fields that it depends on."""
    with use_units(parameter_map.units):
        return {
            f"map.{key}": _drawing(parameter_map, key, language)
            for key in parameter_map.varying
            # the angle of the largest of two peaks is not a surface, nor is a stepped value
            if not key_of(key).quantity.endswith("_angle") and not _is_stepped(_dependent(parameter_map, key)[0])
        }


def _is_stepped(values: Array) -> bool:
    """Return whether few of all values differ, so that contours between them have no meaning."""
    known = values[np.isfinite(values)]
    return bool(2 * values.ndim * np.unique(known).size < known.size)


def _dependent(parameter_map: Map, key: str) -> tuple[Array, list[str]]:
    """Return values over the fields that they depend on, in display units, and these fields."""
    values = displayed_column(key, parameter_map.values[key])
    over = {
        field: index for index, field in enumerate(parameter_map.fields) if key not in parameter_map.independent[field]
    }
    for axis in sorted(set(range(values.ndim)) - set(over.values()), reverse=True):
        # equal along the axis, apart from points without a value
        values = np.fmax.reduce(values, axis=axis)
    return values, list(over)


def _drawing(parameter_map: Map, key: str, language: Language) -> Drawing:
    values, over = _dependent(parameter_map, key)
    rows = [Row(_largest(parameter_map, key, over, values, language), CIRCLE)]
    rows += [
        Row(translate("study.same_at", language, field=_symbol(parameter_map, field, language)), width=0.0)
        for field in parameter_map.fields
        if field not in over
    ]
    if np.isnan(values).any():
        rows.append(Row(translate("study.hatched", language), width=0.0))
    drawn = _surface if values.ndim == 2 else _curve
    return drawn(parameter_map, key, over, values, rows, language)


def _largest(parameter_map: Map, key: str, over: list[str], values: Array, language: Language) -> str:
    """Return the text of the largest value and its position."""
    place = np.unravel_index(np.nanargmax(values), values.shape)
    positions = []
    for field, index in zip(over, place, strict=True):
        text = _shown(float(_at(parameter_map, field)[index]), parameter_map.fields[field].unit, language)
        positions.append(f"{_symbol(parameter_map, field, language)} = {text}")
    value = _shown(float(values[place]), key_unit(key), language)
    return translate("study.largest", language, value=value, where=", ".join(positions))


def _shown(value: float, unit: str, language: Language) -> str:
    space = "" if unit == "deg" else " "
    return f"{number(value, language, digits=_MAP_DIGITS)}{space}{unit_name(unit, language)}".rstrip()


def _at(parameter_map: Map, field: str) -> Array:
    return np.asarray(from_si(parameter_map.points[field].values, parameter_map.fields[field].unit))


def _axis(parameter_map: Map, field: str, language: Language) -> str:
    unit, row = unit_name(parameter_map.fields[field].unit, language), _quantity(parameter_map, field)
    name = f"{plain(row.label(language))} ${row.symbol(language)}$" if row else plain(field)
    return f"{name}, {unit}" if unit else name


def _symbol(parameter_map: Map, field: str, language: Language) -> str:
    """Return the symbol of a field, its key if there is none."""
    row = _quantity(parameter_map, field)
    return f"${row.symbol(language)}$" if row else plain(field)


def _quantity(parameter_map: Map, field: str) -> Quantity | None:
    """Return the quantity that a field of a table states, by its own name or that of its table, or None."""
    table, _, key = field.partition(".")
    unit = coherent_unit(parameter_map.fields[field].unit)
    names = (f"rotational_{key}", f"{table}_{key}", FILE_KEYS.get(key, key))
    return next((QUANTITIES[name] for name in names if name in QUANTITIES and QUANTITIES[name].si_unit == unit), None)


def _ends(values: Array) -> tuple[float, float]:
    return float(values[0]), float(values[-1])


def _title(key: str, language: Language) -> str:
    return translate("study.map_of", language, name=label(key, language))


def _surface(
    parameter_map: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language
) -> Drawing:
    x, y = (_at(parameter_map, name) for name in over)
    paper, box = sheet(_MAP_TALL, [Row(capital(axis_title(key, language)), width=0.0), *rows])
    graph = Graph(paper, box, _ends(x), _ends(y), language)
    field = Field(x, y, values)
    for across, up in np.argwhere(field.holes):
        corners = x[[across, across + 1, across + 1, across]], y[[up, up, up + 1, up + 1]]
        graph.hatch(*corners)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    levels = round_ticks(low, high, _LINES)
    across, up = np.unravel_index(np.nanargmax(values), values.shape)
    largest = graph.point(float(x[across]), float(y[up]))
    contours(graph, field, levels[(levels > low) & (levels < high)], largest)
    paper.dot(*largest, 2.6, fill="#ffffff", width=0.9)
    graph.x_title(_axis(parameter_map, over[0], language))
    graph.y_title(_axis(parameter_map, over[1], language))
    return paper.drawing(_title(key, language), language)


def _curve(
    parameter_map: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language
) -> Drawing:
    x = _at(parameter_map, over[0])
    paper, box = sheet(_WIDE_TALL, rows)
    graph = Graph(paper, box, _ends(x), limits(values, is_place=True), language)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    graph.curve(key, x, values)
    for position, value in zip(x.tolist(), values.tolist(), strict=True):
        if np.isfinite(value):
            paper.dot(*graph.point(position, value), 1.3)
    largest = int(np.nanargmax(values))
    paper.dot(*graph.point(float(x[largest]), float(values[largest])), 2.6, fill="#ffffff", width=0.9)
    graph.x_title(_axis(parameter_map, over[0], language))
    graph.y_title(axis_title(key, language))
    return paper.drawing(_title(key, language), language)
