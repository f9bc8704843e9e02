"""Live calculation of a page with sliders, compiled for the browser; figures between, and joints they follow."""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding_noise import rounding_of_values
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import Delayed, FormulaCall, Input, ProcedureValue, TracedValue, in_order
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.javascript import Script
from crankwork.kernel.lowering import DesignTraces, Lowering
from crankwork.locale import ErrorMessage, Language
from crankwork.locale.numbers import number
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import Key, key_of
from crankwork.report.display import displayed
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.show.animation import Animation, Part
from crankwork.show.canvas import GREY
from crankwork.show.inline import frame_data, frame_marks
from crankwork.show.scene import (
    Arc,
    ChartBox,
    Circle,
    Drawing,
    Hatch,
    Item,
    Plot,
    Polyline,
    Text,
    pen_of,
    runs,
    use_layout,
    visible_points_of_each,
)
from crankwork.units import to_si

# relative difference of a curve and the column that it shows
_SAME = 1e-9
_SAME_PLACE = 1e-6
# truncation error up to which the browser accepts a design
_FOLLOWED = 1e-6
# step of the angles at which designs are compared [deg]
_SAMPLE_STEP = 7.0
# largest number of rows calculated for the tables
_MAX_ROWS = 1000
# classes of an item after a slider has moved
HIDDEN, FAINT = "gone", "faint"
# invisible distance, and margin of a graph for the labels of its scales [mm]
_UNSEEN, _MARGIN = 1e-3, 8.0
# invisible difference of moving parts, in millimetres and degrees
_UNSEEN_MOVE = 0.05
_NUMBER = re.compile(r"−?\d+(?:[.,]\d+)?")
# relative to the scales of a graph: an invisible distance, the tolerance of an interpolated curve, about the width of
# its line, and the tolerance if one of the machines is left out
_UNSEEN_ON_GRAPH, _NEAR, _LEFT_OUT = 3e-4, 2e-3, 2e-2
# invisible distance [mm]
_UNSEEN_PLACE = 0.05
# frames in which parts are matched with joints
_PROBE_FRAMES = (0, 7, 19, 31)
# step of the crank angles of superimposed positions [deg]; distance of a label from its joint, and tolerance of it [mm]
_PLANNED, _NEAR_PLACE, _STRAY = 2.0, 15.0, 0.5


class Slider(NamedTuple):
    """A number of a machine file with a slider: stated value and range [SI], and its unit.

    `stop`: the error beyond the range, if the range is less than requested.
    """

    key: str
    now: float
    low: float
    high: float
    unit: str = ""
    stop: CrankworkError | None = None

    def shown(self, value: float) -> float:
        """Return a value in its unit."""
        origin, end = (float(to_si(bound, self.unit)) for bound in (0.0, 1.0)) if self.unit else (0.0, 1.0)
        return float(f"{(value - origin) / (end - origin):.12g}")


class SliderDesigns(NamedTuple):
    """Sliders with results: of the stated design, a smaller and a larger value of each field, and all fields at once.

    `designs`: values of the fields, shape (m, fields). [SI]
    """

    sliders: tuple[Slider, ...]
    designs: Array
    results: tuple[Results, ...]


class LivePage:
    """The parts of a page that follow its sliders."""

    def __init__(
        self,
        moved: SliderDesigns,
        language: Language,
        only: Collection[str] | None = None,
        around: Mapping[float, Results] | None = None,
        further: Mapping[float, Results] | None = None,
    ) -> None:
        """`only`: names of the figures shown; no others are drawn.

        `around`: results by the one number that is moved, between which other curves are interpolated.

        `further`: more of these results, for checks.
        """
        self._moved, self._results, self._language = moved, moved.results, language
        self.traces = [dict(result.trace) for result in self._results]
        stated = self._results[0]
        self._angles_at, self._cycle = type(stated.grid).from_degrees, stated.machine.cycle
        self._designs = DesignTraces(self.traces, moved.designs, ())
        degrees = np.arange(0.0, self._cycle, _SAMPLE_STEP)
        self._trace = Lowering(self._designs, self._angles_at, degrees, is_shifted=True)
        self._compared = [*moved.results, *(around or {}).values(), *(further or {}).values()]
        # reductions whose columns are interpolated accurately in every design
        self._converged: set[int] = set()
        keys = self._followed(self._trace.compiling(self.traces[0]))
        self._columns = [key for key in keys if self.traces[0][key].varies]
        self._singles = [key for key in keys if not self.traces[0][key].varies]
        if not keys:
            raise CrankworkError(ErrorMessage("slider_nothing", keys=[slider.key for slider in moved.sliders]))
        self._drawings = [drawings(result, language=language, only=only) for result in self._results]
        self.drawn = self._drawings[0]
        self._between = FigureInterpolation(
            list(around or ()), [drawings(result, language=language, only=only) for result in (around or {}).values()]
        )
        # without force arrows, which change the layout but not the motion
        self._films = [film_of(result, language=language) for result in self._results]
        self._shown = film_of(self._results[0], language=language, forces=True)
        self._replayed: dict[tuple[int, bytes], Array] = {}
        self._used: dict[str, None] = {}
        # keys that figures depend on, and single values that differ from analyses
        self._relied: set[str] = set()
        self._wrong: set[str] = set()
        beyond = np.array([*(around or {}), *(further or {})])[:, None]
        self._at = np.concatenate([moved.designs, beyond]) if beyond.size else moved.designs
        limits = [rounding_of_values(result) for result in self._compared]
        self._rounding = {key: max(limit.get(key, 0.0) for limit in limits) for key in limits[0]}

    def _followed(self, keys: Sequence[str]) -> list[str]:
        """Return the keys whose extremes and means come from accurately interpolated columns.

        Steps and columns of rounding errors are accurate in no design, so they are left out: their extremes are
        arbitrary.
        """
        reductions = {key: self._trace.reductions(self.traces[0][key]) for key in keys}
        unconverged = [key for key in keys if not reductions[key] <= self._converged]
        if unconverged:
            kernel = Kernel(
                self.traces, self._moved.designs, unconverged, self._angles_at, cycle=self._cycle,
                is_for_few=True, enough=_FOLLOWED,
            )  # fmt: skip
            designs = self._moved.designs.T
            for key, values, left in zip(
                unconverged, kernel(designs).values, kernel.truncation_error_of(designs), strict=True
            ):
                is_exact = left <= _FOLLOWED
                slack = np.maximum(left[is_exact], _SAME)
                is_right = self.traces[0][key].varies or self._is_right(key, values[is_exact], is_exact, slack)
                if is_right and np.all(left <= _FOLLOWED):
                    self._converged |= reductions[key]
        return [key for key in keys if reductions[key] <= self._converged]

    def name(self, slider: Slider) -> str:
        """Return the key of the quantity of a field if a formula uses it as it is, otherwise an empty text."""
        for known in in_order(self.traces[0].values()):
            node = known.node
            if (
                isinstance(node, Input)
                and node.value is not None
                and node.path == slider.key
                and base_key(known.key) in QUANTITIES
            ):
                value = float(to_si(node.value, node.unit)) if node.unit else node.value
                # coordinates follow from a distance and a direction
                return known.key if math.isclose(value, slider.now, rel_tol=1e-9) else ""
        return ""

    def differs(self, key: str) -> bool:
        """Return whether a column or a single value may differ between designs, or is absent in some."""
        if key in self._trace.steady:
            # equal up to rounding
            return False
        values = [result.columns.get(key, result.summary.get(key)) for result in self._compared]
        if any(value is None for value in values):
            return True
        stated, *remaining = (np.asarray(value) for value in values)
        if any(not np.array_equal(stated, other, equal_nan=True) for other in remaining):
            return True
        known = self.traces[0].get(key)
        if known is None:
            return False
        # an extreme at the same angle in these designs may be elsewhere in others
        try:
            return self._designs.differs[id(known.node)]
        except KeyError:
            return True

    def follows(self, key: str) -> bool:
        """Return whether a key is calculated in the browser, and mark it as used."""
        if key not in self._columns and key not in self._singles:
            return False
        if key in self._wrong or self._is_nowhere(key):
            return False
        self._used[key] = None
        return True

    def _size(self, known: TracedValue) -> float:
        """Return the size of what a single value is calculated from, to which its rounding is proportional."""
        match known.node:
            case ProcedureValue(operands=operands):
                columns = [self._results[0].columns.get(operand.key, 0.0) for operand in operands]
                return max((float(np.max(np.abs(column))) for column in columns), default=0.0)
            case FormulaCall(formula=formula, inputs=inputs) if not known.value:
                sizes = (self._size(value) if isinstance(value, TracedValue) else value for value in inputs)
                return abs(float(formula.function(*sizes)))
        return abs(float(known.value))

    def _is_nowhere(self, key: str) -> bool:
        """Return whether a key is the position of an extreme that is rounding noise."""
        kind, name = key_of(key)
        extreme = str(Key(kind.removesuffix("_angle").removesuffix("_time"), name))
        return extreme != key and any(
            abs(result.summary.get(extreme, np.inf)) <= self._rounding.get(extreme, 0.0) for result in self._compared
        )

    def value_data(self, key: str) -> list[float]:
        """Return the conversion of a single value to its display unit, and its rounding error."""
        return [*scale(key), self._rounding.get(key, 0.0)]

    def nodes(self, traced: Iterable[TracedValue]) -> list[str]:
        """Return the names of intermediate values in the calculation, empty for those that are not calculated."""
        names = []
        for index, known in enumerate(traced):
            name = f"#{index}"
            try:
                counterparts = self._designs.counterparts(known.node)
            except KeyError:
                names.append("")
                continue
            for trace, counterpart in zip(self.traces, counterparts, strict=True):
                trace[name] = TracedValue(counterpart, known.key)
            names.append(name)
        live = set(self._followed(self._trace.compiling(key for key in names if key)))
        self._used |= dict.fromkeys(key for key in names if key in live)
        self._relied |= live
        return [key if key in live else "" for key in names]

    def figure(self, name: str) -> tuple[list[dict[str, Any]], list[str], bool]:
        """Return the curves of each graph that follow, the marks of items, and whether the figure differs."""
        all_drawn = [figures.get(name) for figures in self._drawings]
        drawn = all_drawn[0]
        assert drawn is not None  # noqa: S101 - the page has it
        available = [drawing for drawing in all_drawn if drawing is not None]
        is_complete = len(available) == len(all_drawn)
        if is_complete and all(drawing.plots and drawing.plots[0].metre for drawing in available):
            return self._bound_plan(available)
        surrounding = self._between.drawings(name)
        plots = [self._plot(index, available, surrounding) for index in range(len(drawn.plots))] if is_complete else []
        signs = [Counter(map(signature, drawing.items)) for drawing in available[1:]]
        lines, is_scaled = unchanged_curves(available) | {"legend"}, scaled(available)
        named = [{_name_of_curve(item) for item in drawing.items} for drawing in available]
        is_same = [
            (isinstance(item, Polyline) and item.name in lines)
            # names stand elsewhere where curves are others
            or (bool(_name_of_curve(item)) and all(_name_of_curve(item) in names for names in named))
            or (not is_scaled[index] and all(sign[signature(item)] > 0 for sign in signs))
            for index, item in enumerate(drawn.items)
        ]
        differs = not is_complete or not all(is_same)
        # graphs side by side may have curves of the same name
        live = [(made["curves"], plot.box) for made, plot in zip(plots, drawn.plots, strict=False) if made["curves"]]
        marks = [""] * len(drawn.items)
        for index, item in enumerate(drawn.items):
            before = drawn.items[index - 1] if index else None
            if is_same[index] or (
                isinstance(item, Polyline) and is_within(item, (box for curves, box in live if item.name in curves))
            ):
                continue
            is_legend = isinstance(before, Polyline) and before.name == "legend"
            if is_legend and live and (legend_row := self._legend_value(index, available)):
                plots[0].setdefault("told", []).append(legend_row)
                continue
            if is_title(item, (box for _, box in live)):
                # the scale keeps the power of ten in its title
                continue
            is_curve = isinstance(item, Polyline) and item.name
            # an item on the graph or its scales, not a text next to it
            is_on_graph = is_near(item, (box for _, box in live))
            marks[index] = HIDDEN if is_on_graph and not (is_legend or is_curve) else FAINT
        following = {f"frame {index}" for index, plot in enumerate(plots) if plot["curves"]}
        marks = [frame if frame in following else mark for frame, mark in zip(frame_marks(drawn), marks, strict=True)]
        return plots if live else [], marks if differs else [], differs

    def _bound_plan(self, drawn: Sequence[Drawing]) -> tuple[list[dict[str, Any]], list[str], bool]:
        """Return how superimposed positions follow their joints, the marks of items, and whether they differ."""
        marks_of_items, bindings = bind_to_joints(drawn, self._results)
        items = bindings.get("items", {}).values()
        keys = {key for corners in items for corner in corners for key in corner[:2] if key}
        differs = any(mark != "" for mark in marks_of_items)
        if not keys or any(not self.follows(key) and self.differs(key) for key in keys):
            return [], [FAINT] * len(marks_of_items) if differs else [], differs
        marks = [
            (HIDDEN if is_label(item) else FAINT) if mark is None else mark
            for mark, item in zip(marks_of_items, drawn[0].items, strict=True)
        ]
        return [{"curves": {}, "upon": bindings}], marks, differs

    def _plot(self, index: int, drawn: Sequence[Drawing], surrounding: Sequence[Drawing]) -> dict[str, Any]:
        """Return the curves of a graph that follow, by name, with their columns across and upward.

        `surrounding`: the same figure of the machines to interpolate between.
        """
        plots = [drawing.plots[index] for drawing in drawn if index < len(drawing.plots)]
        graph: dict[str, Any] = {"curves": {}}
        if len(plots) < len(drawn):
            return graph
        # a column equal to another one at the samples may differ elsewhere
        trace = self.traces[0]
        own = {name for name in plots[0].curves if name in trace and trace[name].varies}
        lost = {name for name in own if name not in self._columns and self.differs(name)}
        for name in plots[0].curves:
            if all(name in plot.curves for plot in plots):
                x = self._moved.designs[: len(plots), 0]
                is_known = name not in lost and (name in own or not lost)
                curve = self._curve(name, plots) if is_known else {}
                if curve := curve or self._between.curve(name, index, x, plots, surrounding):
                    graph["curves"][name] = curve
        return graph | frame_data(plots[0])

    def _curve(self, name: str, plots: Sequence[Plot]) -> dict[str, Any]:
        x, y = ([plot.curves[name][axis] for plot in plots] for axis in (0, 1))
        if all(len(values) > 1 and np.ptp(values) == 0 for values in y):
            if any(plot.x != plots[0].x for plot in plots if plot.over):
                return {}
            level = self._single([float(values[0]) for values in y])
            return {"level": level} if level else {}
        if plots[0].over:
            degrees = [
                self._results[index].degrees_of(1.0) * values if plots[0].over == "time" else values
                for index, values in enumerate(x)
            ]
            up = self._column(name, degrees, y)
            return {"y": up} if up else {}
        if not all(name in plot.angles for plot in plots):
            return {}
        degrees = [plot.angles[name] for plot in plots]
        if any(len(a) != len(b) for a, b in zip(degrees, x, strict=True)):
            return {}
        across, up = (self._column(name, degrees, values) for values in (x, y))
        return {"x": across, "y": up} if across and up else {}

    def _legend_value(self, index: int, drawn: Sequence[Drawing]) -> list[Any]:
        """Return the row of a legend item, its number, and the single value that the number is in every design."""
        row, numbers = number_in_legend(index, drawn) or (0, [])
        for key in self._singles if numbers else ():
            values = [float(f"{displayed(key, trace[key].value):.4g}") for trace in self.traces]
            if [number(value, self._language, digits=9) for value in values] == numbers:
                self._rely(key)
                return [row, numbers[0], key, *scale(key)]
        # interpolated figures leave it out
        return [row, numbers[0], "", 0.0, 0.0] if numbers and len(self._between.values) else []

    def _single(self, values: Sequence[float]) -> list[Any]:
        """Return the single value of a constant curve in all designs, and its factor."""
        wanted = np.array(values)
        if np.ptp(wanted) == 0:
            return []
        for key in self._singles:
            singles = np.array([trace[key].value for trace in self.traces])
            factor = (singles @ wanted) / (singles @ singles) if singles.any() else 0.0
            if np.max(np.abs(factor * singles - wanted)) <= _SAME * np.max(np.abs(wanted)):
                self._rely(key)
                return [key, factor]
        return []

    def _rely(self, key: str) -> None:
        self._used[key] = None
        self._relied.add(key)

    def _column(self, name: str, degrees: Sequence[Array], values: Sequence[Array]) -> list[Any]:
        """Return the column of a curve in all designs, and its factor."""
        wanted = np.concatenate(values)
        seen = np.isfinite(wanted)
        wanted = wanted[seen]
        if not (self._columns and wanted.any()):
            return []
        columns = np.concatenate([self._replay(index, angles) for index, angles in enumerate(degrees)], axis=1)[:, seen]
        with np.errstate(all="ignore"):
            factors = (columns @ wanted) / np.sum(columns**2, axis=1)
            error = np.max(np.abs(factors[:, None] * columns - wanted), axis=1)
        fitting = [index for index in np.argsort(error) if error[index] <= _SAME * np.max(np.abs(wanted))]
        if not fitting:
            return []
        best = next((index for index in fitting if self._columns[index] == name), fitting[0])
        self._used[self._columns[best]] = None
        return [self._columns[best], float(factors[best])]

    def _replay(self, index: int, degrees: Array) -> Array:
        """Return all live columns of a design at crank angles, shape (columns, n)."""
        mark = index, degrees.tobytes()
        if mark not in self._replayed:
            columns = self._results[index].columns_at(self._angles_at(degrees), self._columns)
            self._replayed[mark] = np.array([columns[key] for key in self._columns])
        return self._replayed[mark]

    def machine(self) -> tuple[bool, dict[str, Any] | None]:
        """Return whether the motion differs between designs, and the joints if the animation can follow them."""
        films = [film for film in self._films if film is not None]
        if all(is_same_film(films[0], film) for film in films[1:]) and len(films) in (0, len(self._films)):
            return False, None
        joints = joints_of([*filter(None, (self._shown,)), *films[1:]], self._results)
        keys = [key for pair in (joints or {"joints": {}})["joints"].values() for key in pair]
        if not keys or any(not self.follows(key) and self.differs(key) for key in keys):
            return True, None
        return True, joints

    def data(self) -> tuple[dict[str, Any], str]:
        """Return the data and the script of the calculation in the browser."""
        stated, moved = self._results[0], self._moved
        rows = self._rows(stated.grid.degrees)
        kernel = Kernel(
            self.traces, moved.designs, list(self._used), self._angles_at, cycle=self._cycle,
            is_for_few=True, rows=rows,
        )  # fmt: skip
        self._check(kernel)
        script: Script = kernel.script()
        fields = []
        for slider in moved.sliders:
            origin, end = (float(to_si(value, slider.unit)) if slider.unit else value for value in (0.0, 1.0))
            fields.append({"now": slider.now, "scale": end - origin, "origin": origin})
        places = np.searchsorted(rows, stated.grid.degrees - _SAME).tolist()
        return {"fields": fields, "calculation": script.data, "rows": places, "far": _FOLLOWED}, script.text

    def _rows(self, rows: Array) -> Array:
        """Return the crank angles of the tables, and those of other cylinders at the same time. [deg]"""
        known = in_order(self.traces[0][key] for key in self._used)
        delays = {traced.node.by for traced in known if isinstance(traced.node, Delayed)}
        angles = rows
        while True:
            more = np.concatenate([angles, *(np.mod(angles - delay, self._cycle) for delay in delays)])
            more = np.unique(np.round(more, 9))
            if more.size == angles.size or more.size > _MAX_ROWS:
                return angles
            angles = more

    def _check(self, kernel: Kernel) -> None:
        """Compare compiled values with analyses; exclude single values that differ, raise if a figure uses one."""
        batch = kernel(self._at.T)
        is_exact, left_out = batch.truncation_error <= _FOLLOWED, np.maximum(batch.truncation_error, _SAME)
        self._wrong = {
            key
            for key, values in zip(self._used, batch.values, strict=True)
            if not self.traces[0][key].varies
            and not self._is_right(key, values[is_exact], is_exact, left_out[is_exact])
        }
        if self._wrong & self._relied:
            raise CrankworkError(ErrorMessage("slider_nothing", keys=[slider.key for slider in self._moved.sliders]))

    def _is_right(self, key: str, values: Array, is_exact: NDArray[np.bool_], left_out: Array) -> bool:
        """Return whether a single value is equal to that of analyses of the designs."""
        known = self.traces[0][key]
        count = len(self.traces)
        traces = (*self.traces, *(result.trace for result in self._compared[count:]))
        all_traced = [trace.get(key) for trace in traces][: is_exact.size]
        if key.startswith("#"):
            # intermediate values are available for the traced designs only
            exact = is_exact[:count].sum()
            all_traced, values, left_out = all_traced[:count], values[:exact], left_out[:exact]
        if any(traced is None for traced in all_traced):
            return False
        expected = np.array([traced.value for traced in all_traced if traced is not None])[is_exact[: len(all_traced)]]
        # the position of an extreme has half as many exact digits
        is_place = "angle" in known.key or "time_ratio" in known.key
        # the mean of a column may be rounding noise, and what follows from it too
        size = max(float(np.max(np.abs(expected), initial=0.0)), self._size(known), _SAME)
        return bool(
            np.all(np.abs(values - expected) <= np.maximum(_SAME_PLACE if is_place else _SAME, left_out) * size)
        )


def scale(key: str) -> list[float]:
    """Return factor and offset from SI to the display unit of a key."""
    origin = displayed(key, 0.0)
    return [displayed(key, 1.0) - origin, origin]


def is_same_film(film: Animation, other: Animation) -> bool:
    """Return whether two animations have no visible difference."""
    own, other_parts = ({part.name: part for part in each.parts} for each in (film, other))
    return own.keys() == other_parts.keys() and all(
        part.track.shape == other_parts[name].track.shape
        and bool(np.all(np.abs(part.track - other_parts[name].track) < _UNSEEN_MOVE))
        and list(map(signature, part.items)) == list(map(signature, other_parts[name].items))
        for name, part in own.items()
    )


def scaled(drawn: Sequence[Drawing]) -> list[bool]:
    """Return which items lie within graphs whose scales differ: equal on paper, they mean different values."""
    boxes = []
    for own, *other_plots in zip(*(drawing.plots for drawing in drawn), strict=False):
        is_other = ~np.all([_is_near_scale(own, plot) for plot in other_plots], axis=0)
        if is_other.any():
            across, up = np.where(is_other, _MARGIN, 0.0)
            box = own.box
            boxes += [box._replace(height=box.height + across), box._replace(width=box.width + up)]
    items, frames = drawn[0].items, frame_marks(drawn[0])
    # legends do not depend on the scales
    legend = {id(item) for pair in pairwise(items) for item in pair if getattr(pair[0], "name", "") == "legend"}
    return [
        not frame and id(item) not in legend and is_within(item, boxes)
        for frame, item in zip(frames, items, strict=True)
    ]


def _is_near_scale(plot: Plot, other_plot: Plot) -> list[bool]:
    """Return for x and y whether the scales are equal up to rounding."""
    return [
        bool(np.all(np.abs(np.subtract(own, ends)) <= _SAME_PLACE * abs(own[0] - own[1])))
        for own, ends in zip((plot.x, plot.y), (other_plot.x, other_plot.y), strict=True)
    ]


def is_within(item: Item, boxes: Iterable[ChartBox]) -> bool:
    """Return whether the middle of an item lies within one of the boxes."""
    match item:
        case Text(place=place):
            x, y = place
        case Circle(centre=centre) | Arc(centre=centre):
            x, y = centre
        case Polyline(points=points) | Hatch(points=points):
            x, y = (np.min(points, axis=0) + np.max(points, axis=0)) / 2
    return any(0 <= x - box.left <= box.width and 0 <= y - box.bottom <= box.height for box in boxes)


def is_title(item: Item, boxes: Iterable[ChartBox]) -> bool:
    """Return whether an item is the title of an axis of a graph: upright left of it, or below its middle."""
    if not isinstance(item, Text):
        return False
    x, y = item.place
    return any(
        (x < box.left and box.bottom < y < box.top)
        if item.angle == 90
        else y < box.bottom and abs(x - box.left - box.width / 2) < _UNSEEN
        for box in boxes
    )


def is_near(item: Item, boxes: Iterable[ChartBox]) -> bool:
    """Return whether an item lies within one of the boxes or its margin for labels."""
    return is_within(item, (box.inset(*[-_MARGIN] * 4) for box in boxes))


def unchanged_curves(drawn: Sequence[Drawing]) -> set[str]:
    """Return the names of curves that are equal in every design up to rounding, which may thin them differently."""
    constant, moving = set[str](), set[str]()
    for plots in zip(*(drawing.plots for drawing in drawn), strict=False):
        for name, curve in plots[0].curves.items():
            other_curves = [plot.curves.get(name, ()) for plot in plots[1:]]
            is_same = all(len(other) == 2 and _are_near(curve, other) for other in other_curves)
            (constant if is_same else moving).add(name)
    return constant - moving


def _are_near(first: Sequence[Array], second: Sequence[Array]) -> bool:
    """Return whether two curves are the same line; either may have additional points at extremes."""
    (x, y), (across, up) = map(np.asarray, first), map(np.asarray, second)
    shared, common = np.isin(x, across), np.isin(across, x)
    if shared.sum() == common.sum() and 2 * shared.sum() > max(x.size, across.size):
        x, y, across, up = x[shared], y[shared], across[common], up[common]
    if x.shape != across.shape:
        return False
    near = [_SAME_PLACE * np.max(np.abs(values[np.isfinite(values)]), initial=0.0) for values in (x, y)]
    return np.allclose(x, across, rtol=0, atol=near[0]) and np.allclose(y, up, rtol=0, atol=near[1], equal_nan=True)


def signature(item: Item) -> tuple[Any, ...]:
    """Return a key that is equal for items that look the same."""

    def rounded(numbers: Any) -> bytes:  # noqa: ANN401 - numbers
        return (np.rint(np.asarray(numbers, dtype=float) / _UNSEEN) + 0.0).tobytes()

    match item:
        case Polyline():
            return "line", rounded(item.points), item.kind, item.fill, item.name
        case Text():
            return "text", rounded(item.place), item.text, item.angle
        case Circle():
            return "circle", rounded((*item.centre, item.radius)), item.fill
        case Arc():
            return "arc", rounded((*item.centre, item.radius, item.start, item.end))
        case Hatch():
            return "hatch", rounded(item.points)


class FigureInterpolation:
    """Figures of machines by the one number in which they differ. [SI]"""

    def __init__(self, values: Sequence[float], drawn: Sequence[Mapping[str, Drawing]]) -> None:
        self.values, self._drawn = np.array(values), drawn

    def drawings(self, name: str) -> list[Drawing]:
        """Return a figure of all machines; empty if one lacks it or it is a construction."""
        drawn = [figures[name] for figures in self._drawn if name in figures]
        curves = (x for drawing in drawn for plot in drawing.plots for x, _ in plot.curves.values())
        return [] if len(drawn) < len(self._drawn) or any(np.ndim(x) > 1 for x in curves) else drawn

    def curve(self, name: str, index: int, x: Array, plots: Sequence[Plot], drawn: Sequence[Drawing]) -> dict[str, Any]:
        """Return the points of a curve in all machines; empty if polynomials do not interpolate it.

        `index`: of the graph in the figure; `plots`: this graph for machines whose number is `x`.
        """
        sampled = [drawing.plots[index] for drawing in drawn if index < len(drawing.plots)]
        sampled = [plot for plot in sampled if name in plot.curves]
        if len(sampled) < max(len(drawn), 3):
            return {}
        curves = [_at(plot, plots[0], name) for plot in (*sampled, *plots)]
        if len({curve.shape for curve in curves}) > 1:
            return {}
        finite = np.asarray(np.all(np.isfinite(curves), axis=(0, 1)))
        lines = [line for line in drawn[0].items if isinstance(line, Polyline) and line.name == name]
        if sum(len(line.points) for line in lines) != finite.sum() or any(line.closed for line in lines) or not lines:
            # bars, marks and areas, or gaps that differ between machines
            return {}
        points = np.array(curves[: len(sampled)])[..., finite]
        known = [curve[:, finite] for curve in curves[len(sampled) :]]
        low, high = np.sort([plots[0].x, plots[0].y]).T[..., None]
        size = high - low
        if np.all(np.abs(points - known[0]) < _UNSEEN_ON_GRAPH * size):
            return {}
        rows = range(len(self.values))
        checks = [
            (_weights(self.values, number) @ points.swapaxes(0, 1), curve, _NEAR)
            for number, curve in zip(x, known, strict=True)
        ]
        for row in rows[1:-1]:
            rest = [other for other in rows if other != row]
            weights = _weights(self.values[rest], self.values[row])
            checks.append((weights @ points[rest].swapaxes(0, 1), points[row], _LEFT_OUT))
        for expected, actual, limit in checks:
            # ignore points outside the scales
            is_seen = np.all((actual > low - size) & (actual < high + size), axis=0)
            if np.any(np.abs(expected - actual)[:, is_seen] > limit * size):
                return {}
        kept = np.any(visible_points_of_each([(curve / size).T for curve in points], _UNSEEN_ON_GRAPH), axis=0)
        decimals = [4 - math.floor(math.log10(extent)) for extent in size[:, 0]]
        across, up = (np.round(points[:, side][:, kept], decimals[side]).tolist() for side in (0, 1))
        angles = plots[0].curves[name][0] if plots[0].over else plots[0].angles.get(name, ())
        places = np.round(angles[finite][kept], 3).tolist() if len(angles) == len(finite) else []
        if len(lines) > 1 and not places:
            return {}
        same = all(position == across[0] for position in across)
        return {"between": {"x": across[:1] if same else across, "y": up, "at": places}}


def _at(plot: Plot, stated: Plot, name: str) -> Array:
    """Return the points of a curve, at the crank angles of the stated one if its own differ; shape (2, n)."""
    curve, (x, _) = np.array(plot.curves[name], dtype=float), stated.curves[name]
    degrees, wanted = (curve[0], x) if plot.over else (graph.angles.get(name, ()) for graph in (plot, stated))
    if len(x) == curve.shape[1] or len(degrees) != curve.shape[1] or len(wanted) != len(x):
        return curve
    return np.array([np.interp(wanted, degrees, row) for row in curve])


def _weights(values: Array, x: float) -> Array:
    """Return the Lagrange weights of values at x."""
    return np.array([
        np.prod([(x - other) / (value - other) for other in np.delete(values, k)]) for k, value in enumerate(values)
    ])  # fmt: skip


def number_in_legend(index: int, drawn: Sequence[Drawing]) -> tuple[int, list[str]] | None:
    """Return the legend row of an item and the number in it for each drawing; None if more than that differs."""
    row = len(_legend(drawn[0].items[:index]))
    texts = [rows[row] if row < len(rows := _legend(drawing.items)) else "" for drawing in drawn]
    numbers = [_NUMBER.findall(text) for text in texts]
    if len({_NUMBER.sub("#", text) for text in texts}) > 1 or any(len(matches) != 1 for matches in numbers):
        return None
    return row, [matches[0] for matches in numbers]


def _name_of_curve(item: Item) -> str:
    return item.text if isinstance(item, Text) and item.halo else ""


def _legend(items: Sequence[Any]) -> list[str]:
    """Return the texts of a legend."""
    pairs = pairwise(items)
    return [
        "".join(run.text for run in runs(text.text))
        for line, text in pairs
        if isinstance(line, Polyline) and line.name == "legend" and isinstance(text, Text)
    ]


def joints_of(films: Sequence[Animation], results: Sequence[Results]) -> dict[str, Any] | None:
    """Return scale and origin of an animation, columns of its joints, and the joints of links and labels.

    None if links are more than lines between joints, or joints do not follow columns in every design.
    """
    scales = [_Scale(film, result) for film, result in zip(films, results, strict=True)]
    stated, film = scales[0], films[0]
    if not all(scale.is_exact for scale in scales):
        return None
    for name in stated.fixed:
        places = np.array([scale.fixed[name] for scale in scales if name in scale.fixed])
        if len(places) < len(scales) or np.max(np.ptp(places, axis=0)) * stated.scale > _UNSEEN_PLACE:
            return None
    tracks = {part.name: _track(part, film) for part in film.parts if part.name.startswith("joint.")}
    links, labels = dict[str, list[str]](), dict[str, list[Any]]()
    for part in film.parts:
        kind = key_of(part.name).quantity
        if kind == "link":
            corners = _corner_joints(part, film, tracks)
            if corners is None:
                return None
            links[part.name] = corners
        elif kind in ("text", "block"):
            offset = _label_offset(_track(part, film), tracks)
            # a block follows its pin where its guide keeps its direction
            turns = [item.turn for other in films for item in other.parts if item.name == part.name]
            if kind == "block" and (not offset or np.ptp(np.concatenate(turns)) > _UNSEEN_PLACE):
                return None
            labels |= {part.name: offset} if offset else {}
        elif kind not in ("joint", "force"):
            return None
    origin = [stated.origin[0], film.ground.height - stated.origin[1]]
    return {"scale": stated.scale, "origin": origin, "joints": stated.keys, "links": links, "labels": labels}


class _Scale:
    """Transformation from metres to the paper of an animation: scale [mm/m], origin [mm], and fixed joints [m]."""

    def __init__(self, film: Animation, results: Results) -> None:
        joints = [part for part in film.parts if part.name.startswith("joint.")]
        names = {part.name: part.name.removeprefix("joint.") for part in joints}
        self.keys = {
            part: [f"point_x.{name}", f"point_y.{name}"] for part, name in names.items() if f"point_x.{name}" in results
        }
        columns = results.columns_at(film.angles, [key for pair in self.keys.values() for key in pair])
        moving = [part for part in joints if part.name in self.keys]
        self.scale, self.origin, self.is_exact = 1.0, (0.0, 0.0), False
        self.fixed: dict[str, Array] = {}
        if not moving:
            return
        paper = np.concatenate([_track(part, film) for part in moving])
        positions = np.concatenate([np.column_stack([columns[key] for key in self.keys[part.name]]) for part in moving])
        spread = positions - positions.mean(axis=0)
        self.scale = float(np.sum(spread * (paper - paper.mean(axis=0))) / np.sum(spread**2))
        origin = paper.mean(axis=0) - self.scale * positions.mean(axis=0)
        self.origin = float(origin[0]), float(origin[1])
        self.is_exact = bool(np.max(np.abs(paper - self.scale * positions - origin)) <= _UNSEEN_PLACE)
        still = [part for part in joints if part.name not in self.keys]
        self.fixed = {part.name: (_track(part, film)[0] - origin) / self.scale for part in still}


def _track(part: Part, film: Animation) -> Array:
    """Return the position of a part in all frames, shape (n, 2). [mm]"""
    return np.asarray(np.broadcast_to(part.shift, (len(film.angles), 2)))


def _corner_joints(part: Part, film: Animation, joints: Mapping[str, Array]) -> list[str] | None:
    """Return the joints at the corners of a link, None unless each corner is at one."""
    if len(part.items) != 1 or not isinstance(part.items[0], Polyline):
        return None
    frames = [frame for frame in _PROBE_FRAMES if frame < len(film.angles)]
    corners = []
    for frame in frames:
        row = frame if len(part.shift) > 1 else 0
        item = use_layout(part.items[0], part.shift[row], float(part.turn[row]), float(part.stretch[row]))
        corners.append(item.points if isinstance(item, Polyline) else np.zeros((0, 2)))
    names = []
    for corner in np.moveaxis(np.array(corners), 1, 0):
        near = [name for name, track in joints.items() if np.max(np.abs(track[frames] - corner)) <= _UNSEEN_PLACE]
        if not near:
            return None
        names.append(near[0])
    return names


def _label_offset(track: Array, joints: Mapping[str, Array]) -> list[Any]:
    """Return the joint that a label follows, and its offset to the right and down; empty if there is none."""
    for name, joint in joints.items():
        offset = track - joint
        if np.max(np.ptp(offset, axis=0)) <= _UNSEEN_PLACE:
            return [name, round(float(offset[0, 0]), 2), round(-float(offset[0, 1]), 2)]
    return []


def bind_to_joints(drawn: Sequence[Drawing], results: Sequence[Results]) -> tuple[list[str | None], dict[str, Any]]:
    """Return the marks of the items of superimposed positions, and the joints that these items follow.

    The mark is empty for an item that stays, `upon N` for one that follows, None for one that does neither. By N, the
    bindings give for the corners of a line, or for the one joint that an item keeps its distance to: columns of the
    position, crank angle, and stated position [mm].
    """
    plots = [drawing.plots[0] for drawing in drawn]
    stated = plots[0]
    if any(plot.metre != stated.metre for plot in plots):
        return [None] * len(drawn[0].items), {}
    places = _Places(results, [_origin(plot) for plot in plots], stated.metre)
    marks, bindings = list[str | None](), dict[str, Any]()
    for index, items in enumerate(_paired(drawn)):
        points = np.array([_points(item) for item in items])
        binding = places.of(points, is_offset=is_label(items[0])) if len(items) == len(drawn) else None
        marks.append(None if binding is None else f"upon {index}" if binding else "")
        if binding:
            bindings[str(index)] = [[*keys, degrees, *_shown(place, drawn[0])] for keys, degrees, place in binding]
    return marks, {"scale": stated.metre, "origin": _shown(places.origins[0], drawn[0]), "items": bindings}


def _paired(drawn: Sequence[Drawing]) -> Iterator[list[Item]]:
    """Yield each item of the first drawing with its counterparts in the others, alone if their number differs."""
    kinds = [[_kind(item) for item in drawing.items] for drawing in drawn]
    lists = [defaultdict[Any, list[Item]](list) for _ in drawn]
    for own, drawing, items_by_kind in zip(kinds, drawn, lists, strict=True):
        for kind, item in zip(own, drawing.items, strict=True):
            items_by_kind[kind].append(item)
    counted = Counter[Any]()
    for kind, item in zip(kinds[0], drawn[0].items, strict=True):
        groups = [items[kind] for items in lists]
        position, counted[kind] = counted[kind], counted[kind] + 1
        yield [group[position] for group in groups] if len({len(group) for group in groups}) == 1 else [item]


class _Places:
    """Positions of joints on the paper of each design, at the crank angles of superimposed positions."""

    def __init__(self, results: Sequence[Results], origins: Sequence[Array], metre: float) -> None:
        self.origins = np.array(origins)
        names = [key.removeprefix("point_x.") for key in results[0].trace if key.startswith("point_x.")]
        keys = [(f"point_x.{name}", f"point_y.{name}") for name in names]
        degrees = np.arange(0.0, results[0].machine.cycle, _PLANNED)
        self._known = [(pair, float(angle)) for pair in keys for angle in degrees]
        columns = [result.columns_at(degrees, [key for pair in keys for key in pair]) for result in results]
        positions = [
            np.column_stack([np.concatenate([values[pair[side]] for pair in keys]) for side in (0, 1)])
            for values in columns
        ]
        self._at = metre * np.array(positions) + self.origins[:, None]

    def of(self, points: Array, *, is_offset: bool) -> list[tuple[tuple[str, str], float, Array]] | None:
        """Return joint, crank angle and position for each corner, or for the joint an item keeps its distance to.

        Empty for an item that stays; `is_offset`: only the distance to one joint counts.
        """
        still = points - self.origins[:, None]
        if _are_same(points) or _are_same(still):
            return []
        bindings = []
        for corner, own in zip(np.moveaxis(points, 1, 0), np.moveaxis(still, 1, 0), strict=True):
            if _are_same(own):
                bindings.append((("", ""), 0.0, corner[0]))
                continue
            away = np.abs(self._at - corner[:, None]).max(axis=(0, 2))
            nearest = int(np.argmin(away))
            if away[nearest] > _UNSEEN_PLACE:
                break
            bindings.append((*self._known[nearest], corner[0]))
        else:
            return bindings
        # a label, or a body that does not rotate
        relative = points - points[:, :1]
        if not is_offset and not _are_same(relative):
            return None
        offsets = points.mean(axis=1)[:, None] - self._at
        unsteady = np.ptp(offsets, axis=0).max(axis=1)
        distance = np.where(unsteady <= (_STRAY if is_offset else _UNSEEN_PLACE), np.hypot(*offsets[0].T), np.inf)
        nearest = int(np.argmin(distance))
        return [(*self._known[nearest], self._at[0, nearest])] if distance[nearest] < _NEAR_PLACE else None


def is_label(item: Item) -> bool:
    """Return whether an item is a label, its background, or its leader line."""
    if not isinstance(item, Polyline):
        return isinstance(item, Text)
    pen = pen_of(item.kind)
    return pen.colour == GREY or (item.fill == 1 and not pen.width)


def _origin(plot: Plot) -> Array:
    """Return the position of the origin of both scales. [mm]"""
    box = plot.box
    across, up = (-scale[0] / (scale[1] - scale[0]) for scale in (plot.x, plot.y))
    return np.array([box.left + across * box.width, box.bottom + up * box.height])


def _kind(item: Item) -> tuple[Any, ...]:
    """Return a key of an item without its position."""
    match item:
        case Polyline():
            return "line", len(item.points), item.kind, item.closed, item.fill
        case Circle():
            return "circle", round(item.radius, 3), item.kind, item.fill
        case Text():
            return "text", item.text, item.height, item.anchor
    return (type(item).__name__,)


def _points(item: Item) -> Array:
    match item:
        case Circle():
            return np.array([item.centre])
        case Text():
            return np.array([item.place])
        case Polyline():
            return item.points
    return np.full((1, 2), np.nan)


def _are_same(points: Array) -> bool:
    return bool(np.max(np.ptp(points, axis=0)) <= _UNSEEN_PLACE)


def _shown(place: Array, drawing: Drawing) -> list[float]:
    """Return a position in SVG coordinates, y downward. [mm]"""
    return [round(float(place[0]), 2), round(drawing.height - float(place[1]), 2)]
