"""Figures of what is found of a study: histograms, the Pareto set, the best designs, what decides."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, say
from crankwork.locale.numbers import number, unit_name
from crankwork.report.language import displayed, displayed_column, key_unit, label
from crankwork.show.chart import CIRCLE, DOT, Graph, Row, round_ticks, sheet, small_text
from crankwork.show.paper import BLACK, GREY, WIDER, fitted_lines, plain, text_width
from crankwork.show.place import current_layout
from crankwork.show.scene import DASH_DOT, DASHED, Drawing
from crankwork.study.chunks import Reduced, is_shown, within
from crankwork.study.found_text import ranked
from crankwork.study.ranking import Histogram, Index, thinned
from crankwork.study.study_file import Study
from crankwork.study.varied import Varied
from crankwork.units import from_si, use_units

_TALL, _LINES_TALL, _BAR = 190.0, 210.0, 21.0
_DIGITS, _FEW = 6, 4
# axes beside the one of the objective, and dots of a Pareto set
_AXES, _DOTS = 6, 1000
_DARK, _FAINT = "#8c8c8c", "#cfcfcf"


def found_drawings(study: Study, found: Reduced, language: Language) -> dict[str, Drawing]:
    """Return the figures of what is found by name."""
    with use_units(study.units):
        return dict([
            *_histograms(study, found, language), *_scatters(study, found, language),
            *_parallels(study, found, language), *_indices(study, found, language),
        ])  # fmt: skip


def _shown(key: str, value: float, language: Language, digits: int = _DIGITS) -> str:
    return f"{number(displayed(key, value), language, digits=digits)} {unit_name(key_unit(key), language)}".rstrip()


def _named(key: str, language: Language) -> str:
    unit = unit_name(key_unit(key), language)
    return plain(f"{label(key, language)}, {unit}" if unit else label(key, language))


def _span(values: Array) -> tuple[float, float]:
    """Return ends of a scale that holds all values, and not zero for its own sake."""
    low, high = float(values.min()), float(values.max())
    room = 0.04 * (high - low) or 0.04 * abs(high) or 1.0
    return low - room, high + room


def _histograms(study: Study, found: Reduced, language: Language) -> Iterator[tuple[str, Drawing]]:
    for key, one in found.histograms.items():
        if len(one.counts) > 1:
            yield f"histogram.{key}", _histogram(study, key, one, language)


def _histogram(study: Study, key: str, found: Histogram, language: Language) -> Drawing:
    """Return how many designs have which value, with that of the stated machine and the limits."""
    edges = displayed_column(key, found.edges)
    stated = displayed(key, study.stated[key])
    ends = [displayed(key, one) for one in study.limits.get(key, ()) if math.isfinite(one)]
    rows = [Row(say("study.as_stated", language, value=_shown(key, study.stated[key], language)), DASHED)]
    if ends:
        shown = " … ".join(dict.fromkeys(number(one, language, digits=_DIGITS) for one in ends))
        rows.append(Row(f"{say('study.limit', language)} {shown} {unit_name(key_unit(key), language)}", DASH_DOT))
    paper, box = sheet(_TALL, [row._replace(text=plain(row.text)) for row in rows])
    x = _span(np.array([edges[0], edges[-1], stated, *ends]))
    top = 1.06 * max(found.counts)
    graph = Graph(paper, box, x, (0.0, top), language)
    steps, heights = np.repeat(edges, 2), np.concatenate([[0.0], np.repeat(found.counts, 2), [0.0]])
    graph.shade(steps, heights)
    graph.frame(round_ticks(*x), graph.up_ticks)
    graph.curve("count", steps, heights, width=0.8)
    for level, style in ((stated, DASHED), *((one, DASH_DOT) for one in dict.fromkeys(ends))):
        graph.curve("", [level, level], [0.0, top], style, width=1.0)
    graph.x_title(_named(key, language))
    graph.y_title(say("study.count", language))
    return paper.drawing(say("study.histogram_of", language, name=label(key, language)), language)


def _scatters(study: Study, found: Reduced, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the Pareto set over each two objectives, among some of all designs."""
    for at, pair in enumerate(itertools.combinations(study.objectives, 2)):
        yield f"pareto_{at + 1}" if at else "pareto", _scatter(study, found, pair, language)


def _scatter(study: Study, found: Reduced, pair: tuple[str, str], language: Language) -> Drawing:
    x, y = (displayed_column(key, found.values[study.keys.index(key)]) for key in pair)
    best, pareto = ranked(study, found)
    few = pareto[thinned(np.array([x[pareto], y[pareto]]).T, np.arange(pareto.size), _DOTS)]
    is_within = within(study, found.values)
    some = is_shown(study, found.numbers) & np.isfinite(x) & np.isfinite(y)
    rows = [
        Row(say("study.pareto_dots", language), DOT),
        Row(say("study.best_dots", language), CIRCLE),
        Row(say("study.some_within" if study.limits else "study.some", language), DOT, colour=_DARK),
    ]
    if study.limits:
        rows.append(Row(say("study.some_outside", language), DOT, colour=_FAINT))
    paper, box = sheet(_LINES_TALL + 30, rows)
    seen = np.concatenate([few, np.flatnonzero(some)])
    graph = Graph(paper, box, _span(x[seen]), _span(y[seen]), language)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    outside, inside = np.flatnonzero(some & ~is_within), np.flatnonzero(some & is_within)
    for rows_of, fill, radius in ((outside, _FAINT, 1.3), (inside, _DARK, 1.3), (few, BLACK, 1.5)):
        for at in rows_of:
            paper.dot(*graph.point(float(x[at]), float(y[at])), radius, fill=fill)
    for key in pair:
        for at in best[key][:1]:
            paper.dot(*graph.point(float(x[at]), float(y[at])), 2.8, fill="#ffffff", width=1.0)
    graph.x_title(_wanted(study, pair[0], language))
    graph.y_title(_wanted(study, pair[1], language))
    return paper.drawing(say("study.pareto_of", language), language)


def _wanted(study: Study, key: str, language: Language) -> str:
    """Return what an axis of an objective says: its name, unit, and which end is wanted."""
    end = "study.small_wanted" if study.objectives[key] > 0 else "study.large_wanted"
    return f"{_named(key, language)} ({say(end, language)})"


class _Axis:
    """One axis of parallel coordinates: a name, what stands at its ends, and where designs stand on it, from 0 to 1."""

    def __init__(self, name: str, values: Array, ends: tuple[str, str], span: tuple[float, float]) -> None:
        self.name, self.ends = name, ends
        low, high = span
        self.at = (values - low) / (high - low) if high > low else np.full(values.shape, 0.5)

    @classmethod
    def of_field(cls, one: Varied, values: Array, language: Language) -> _Axis:
        """Return that of a field between the values that it may have, words by their order."""
        if one.number is None:
            return cls(one.key, values, (str(one.values[0]), str(one.values[-1])), (0.0, len(one.values) - 1.0))
        least, _, most = one.span
        if one.law == "normal":
            least, most = float(values.min()), float(values.max())
        ends = [number(float(from_si(end, one.unit)), language, digits=_FEW) for end in (least, most)]
        unit = unit_name(one.unit, language)
        return cls(one.key, values, (f"{ends[0]} {unit}".rstrip(), f"{ends[1]} {unit}".rstrip()), (least, most))

    @classmethod
    def of_value(cls, key: str, values: Array, language: Language) -> _Axis:
        """Return that of a value between the least and the largest that are shown."""
        least, most = float(np.nanmin(values)), float(np.nanmax(values))
        ends = _shown(key, least, language, _FEW), _shown(key, most, language, _FEW)
        return cls(label(key, language), values, ends, (least, most))


def _parallels(study: Study, found: Reduced, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the best designs of each objective across the fields that vary."""
    best, _ = ranked(study, found)
    some = np.flatnonzero(is_shown(study, found.numbers) & np.isfinite(found.values).all(axis=0))
    for key, rows in best.items():
        if not rows.size:
            continue
        shown = np.concatenate([some, rows])
        axes = [_Axis.of_field(one, of[shown], language) for one, of in zip(study.varied, found.fields, strict=True)]
        last = _Axis.of_value(key, found.values[study.keys.index(key), shown], language)
        for at, first in enumerate(range(0, len(axes), _AXES)):
            title = say("study.parallel_of", language, name=label(key, language))
            name = f"parallel.{key}" + (f"_{at + 1}" if at else "")
            yield name, _parallel([*axes[first : first + _AXES], last], some.size, rows, title, language)


def _parallel(axes: list[_Axis], some: int, best: Index, title: str, language: Language) -> Drawing:
    rows = [
        Row(say("study.best_line", language), width=2.0),
        Row(say("study.best_lines", language, count=str(best.size)), width=0.8),
        Row(say("study.some", language), width=0.6, colour=_FAINT),
    ]
    edge = 56.0
    across = np.linspace(edge, current_layout().width - edge, len(axes))
    room = min((across[1] - across[0]) - 6, 2 * edge - 8) / WIDER
    names = [_fitted(one.name, room) for one in axes]
    paper, box = sheet(_LINES_TALL, rows, below=24.0 + 10.0 * max(map(len, names)))
    top, bottom = box.top + 12, box.top + box.height
    down = np.array([bottom - (bottom - top) * one.at for one in axes])
    for at in range(some):
        paper.line(across, down[:, at], width=0.3, colour=_FAINT)
    paper.segments(np.array([(x, top, x, bottom) for x in across]), width=0.8, colour=GREY)
    for at in range(down.shape[1] - 1, some - 1, -1):
        paper.line(across, down[:, at], width=1.8 if at == some else 0.6)
    for x, one, name in zip(across.tolist(), axes, names, strict=True):
        small_text(paper, x, top - 5, plain(one.ends[1]))
        small_text(paper, x, bottom + 10, plain(one.ends[0]))
        for at, part in enumerate(name):
            paper.text(x, bottom + 23 + 10 * at, plain(part), size=8.0, anchor="middle")
    return paper.drawing(title, language)


def _fitted(name: str, room: float) -> tuple[str, ...]:
    """Return a name on lines, a key of the file broken at its dots and underscores."""
    if " " in name:
        return fitted_lines(name, 8.0, room)
    lines: list[str] = []
    for part in name.replace(".", ". ").replace("_", "_ ").split():
        if lines and text_width(lines[-1] + part, 8.0) <= room:
            lines[-1] += part
        else:
            lines.append(part)
    return tuple(lines)


def _indices(study: Study, found: Reduced, language: Language) -> Iterator[tuple[str, Drawing]]:
    """Yield the share of the variance that each field has, alone and with all others, the greatest first."""
    for key, one in found.shares.items():
        indices = one.indices()
        if indices is not None:
            yield f"sensitivity.{key}", _bars(study, key, np.array(indices), language)


def _bars(study: Study, key: str, indices: Array, language: Language) -> Drawing:
    rows = [Row(say(f"study.{one}", language), width=0.0) for one in ("bars_alone", "bars_whole", "bars_error")]
    order = np.argsort(-indices[2], kind="stable")
    paper, box = sheet(_BAR * len(order) + 8, rows, below=34.0)
    names = [study.varied[at].key for at in order]
    left = max(WIDER * text_width(one, 8.5) for one in names) + 12
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
    for row, at in enumerate(order):
        first, first_error, total, total_error = indices[:, at].tolist()
        alone = max(first, 0.0), first_error, 0.18, graph.hatch
        for value, error, low, fill in (alone, (max(total, 0.0), total_error, 0.5, graph.shade)):
            high = low + 0.32
            corners = np.array([0.0, value, value, 0.0]), row + np.array([low, low, high, high])
            fill(*corners)
            graph.curve("", np.append(corners[0], 0.0), np.append(corners[1], row + low), width=0.8)
            middle = row + (low + high) / 2
            graph.curve("", [max(value - error, 0.0), value + error], [middle, middle], width=1.4)
        y = float(graph.down(row + 0.5)) + 3
        paper.text(left - 6, y, plain(names[row]), size=8.5, anchor="end")
        share = " / ".join(number(round(100 * max(one, 0.0), 1), language) for one in (first, total))
        paper.text(box.left + graph.box.width + 6, y, f"{share} %", size=8.0)
    graph.x_title(say("study.share", language))
    return paper.drawing(say("study.sensitivity_of", language, name=label(key, language)), language)
