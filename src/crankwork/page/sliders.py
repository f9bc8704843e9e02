"""What a page calculates anew where its reader moves a slider: by the remembered calculation, in the browser."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding import rounding_of_extremes
from crankwork.errors import CrankworkError
from crankwork.formula.known import Delayed, Found, Given, Known, in_order
from crankwork.kernel.compiled import CONVERGED, Kernel
from crankwork.kernel.script import Script
from crankwork.kernel.trace import DesignTraces, Lowering
from crankwork.locale import Language, Refusal
from crankwork.locale.numbers import number
from crankwork.page.alike import is_beside, is_same_film, is_title, is_within, scaled, signed, staying
from crankwork.page.between import Between, number_in_legend
from crankwork.page.joints import is_label, joints_of, upon_joints
from crankwork.quantities import QUANTITIES, base_key
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.report.language import displayed
from crankwork.show.inline import frame_data, frame_marks
from crankwork.show.scene import Drawing, Plot, Polyline
from crankwork.units import to_si

# of its size, how far what is drawn may be from a column that it is taken for
_SAME = 1e-9
_SAME_PLACE = 1e-6
# what polynomials may leave out of a design that a browser takes
_FOLLOWED = 1e-6
# where tables of designs are compared [deg]
_LOOKED = 7.0
# rows that are calculated for the tables at most
_MOST_ROWS = 1000
# of an item: hidden, or faint, where sliders have moved
GONE, FAINT = "gone", "faint"


class Slider(NamedTuple):
    """A number of a machine file that a reader may move, between two values [SI], in the unit it is written in.

    `stop`: why the machine does not go as far as was asked, and as far as the field goes.
    """

    key: str
    now: float
    low: float
    high: float
    unit: str = ""
    stop: CrankworkError | None = None

    def shown(self, value: float) -> float:
        """Return a value in its unit."""
        origin, end = (float(to_si(one, self.unit)) for one in (0.0, 1.0)) if self.unit else (0.0, 1.0)
        return float(f"{(value - origin) / (end - origin):.12g}")


class Moved(NamedTuple):
    """Sliders, and results of designs: the stated one, a smaller and a larger value of each alone, one of all at once.

    `designs`: what the fields are in each, shape (m, fields). [SI]
    """

    sliders: tuple[Slider, ...]
    designs: Array
    results: tuple[Results, ...]


class Live:
    """What of a page follows its sliders."""

    def __init__(
        self,
        moved: Moved,
        language: Language,
        only: Collection[str] | None = None,
        around: Mapping[float, Results] | None = None,
        further: Mapping[float, Results] | None = None,
    ) -> None:
        """`only`: the names of the figures that are seen, of which none is drawn beside them.

        `around`: results by the one number that is moved; curves that are not calculated go between those of these.
        `further`: more of them, that what is calculated is compared with too.
        """
        self._moved, self._results, self._language = moved, moved.results, language
        self.memories = [dict(one.memory) for one in self._results]
        stated = self._results[0]
        self._angles_at, self._cycle = type(stated.grid).from_degrees, stated.machine.cycle
        self._designs = DesignTraces(self.memories, moved.designs, ())
        self._trace = self._new_trace()
        self._compared = [*moved.results, *(around or {}).values(), *(further or {}).values()]
        # reductions of columns that polynomials follow in every design
        self._converged: set[int] = set()
        keys = self._followed(self._trace.compiling(self.memories[0]))
        self._columns = [key for key in keys if self.memories[0][key].varies]
        self._singles = [key for key in keys if not self.memories[0][key].varies]
        if not keys:
            raise CrankworkError(Refusal("slider_nothing", keys=[one.key for one in moved.sliders]))
        self._drawings = [drawings(one, language=language, only=only) for one in self._results]
        self.drawn = self._drawings[0]
        self._between = Between(
            list(around or ()), [drawings(one, language=language, only=only) for one in (around or {}).values()]
        )
        # arrows of forces take room upon the paper, and move nothing
        self._films = [film_of(one, language=language) for one in self._results]
        self._shown = film_of(self._results[0], language=language, forces=True)
        self._replayed: dict[tuple[int, bytes], Array] = {}
        self._used: dict[str, None] = {}
        # what more than single values hangs on, and single values that are not calculated right everywhere
        self._relied: set[str] = set()
        self._wrong: set[str] = set()
        beyond = np.array([*(around or {}), *(further or {})])[:, None]
        self._at = np.concatenate([moved.designs, beyond]) if beyond.size else moved.designs
        limits = [rounding_of_extremes(one) for one in self._compared]
        self._rounding = {key: max(one.get(key, 0.0) for one in limits) for key in limits[0]}

    def _new_trace(self) -> Lowering:
        looked = np.arange(0.0, self._cycle, _LOOKED)
        return Lowering(self._designs, self._angles_at, looked, is_shifted=True)

    def _followed(self, keys: Sequence[str]) -> list[str]:
        """Return those of some keys for which polynomials follow all columns that their extremes and means are of.

        Steps and what is nothing but rounding are followed in no design, so that they would tell of none whether it is
        there; where a level column has its extreme, rounding tells otherwise in another calculation.
        """
        reductions = {key: self._trace.reductions(self.memories[0][key]) for key in keys}
        unsure = [key for key in keys if not reductions[key] <= self._converged]
        if unsure:
            kernel = Kernel(
                self.memories, self._moved.designs, unsure, self._angles_at, cycle=self._cycle,
                is_for_few=True, enough=_FOLLOWED,
            )  # fmt: skip
            designs = self._moved.designs.T
            for key, values, left in zip(
                unsure, kernel(designs).values, kernel.truncation_error_of(designs), strict=True
            ):
                whole = left <= CONVERGED
                slack = np.full(whole.sum(), _SAME)
                is_right = self.memories[0][key].varies or self._is_right(key, values[whole], whole, slack)
                if is_right and np.all(left <= _FOLLOWED):
                    self._converged |= reductions[key]
        return [key for key in keys if reductions[key] <= self._converged]

    def name(self, slider: Slider) -> str:
        """Return the key of the quantity that a field is, if a formula takes it."""
        for known in in_order(self.memories[0].values()):
            if isinstance(known.node, Given) and known.node.path == slider.key and base_key(known.key) in QUANTITIES:
                return known.key
        return ""

    def differs(self, key: str) -> bool:
        """Return whether designs may differ in a column or a single value, or some have none."""
        if key in self._trace.steady:
            # but for rounding
            return False
        values = [one.columns.get(key, one.summary.get(key)) for one in self._compared]
        if any(one is None for one in values):
            return True
        stated, *others = (np.asarray(one) for one in values)
        if any(not np.array_equal(stated, one, equal_nan=True) for one in others):
            return True
        known = self.memories[0].get(key)
        if known is None:
            return False
        # an extreme at the same place in these may stand elsewhere in others
        try:
            return self._designs.differs[id(known.node)]
        except KeyError:
            return True

    def follows(self, key: str) -> bool:
        """Return whether a column or a single value is calculated in the browser, and remember that it is wanted."""
        if key not in self._columns and key not in self._singles:
            return False
        if key in self._wrong or self._is_nowhere(key):
            return False
        self._used[key] = None
        return True

    def _is_nowhere(self, key: str) -> bool:
        """Return whether a place is that of an extreme which is rounding: it may be anywhere."""
        kind, dot, name = key.partition(".")
        of = f"{kind.removesuffix('_angle').removesuffix('_time')}{dot}{name}"
        return of != key and any(
            abs(one.summary.get(of, np.inf)) <= self._rounding.get(of, 0.0) for one in self._compared
        )

    def value_data(self, key: str) -> list[float]:
        """Return what takes a single value to its display unit, and what of it is rounding."""
        return [*scale(key), self._rounding.get(key, 0.0)]

    def nodes(self, knowns: Iterable[Known]) -> list[str]:
        """Return names under which what lies between keys is calculated, empty for what is not."""
        names = []
        for at, known in enumerate(knowns):
            name = f"#{at}"
            try:
                twins = self._designs.counterparts(known.node)
            except KeyError:
                names.append("")
                continue
            for memory, twin in zip(self.memories, twins, strict=True):
                memory[name] = Known(twin, known.key)
            names.append(name)
        live = set(self._followed(self._trace.compiling(one for one in names if one)))
        self._used |= dict.fromkeys(one for one in names if one in live)
        self._relied |= live
        return [one if one in live else "" for one in names]

    def figure(self, name: str) -> tuple[list[dict[str, Any]], list[str], bool]:
        """Return how the curves of each graph are made, what becomes of each item, and whether the figure differs."""
        every = [one.get(name) for one in self._drawings]
        drawn = every[0]
        assert drawn is not None  # noqa: S101 - the page has it
        there = [one for one in every if one is not None]
        if len(there) == len(every) and all(one.plots and one.plots[0].metre for one in there):
            return self._upon(there)
        others = self._between.drawings(name)
        plots = [self._plot(at, there, others) for at in range(len(drawn.plots))] if len(there) == len(every) else []
        signs = [Counter(map(signed, one.items)) for one in there[1:]]
        lines, is_scaled = staying(there), scaled(there)
        is_same = [
            (isinstance(item, Polyline) and item.name in lines)
            or (not is_scaled[at] and all(one[signed(item)] > 0 for one in signs))
            for at, item in enumerate(drawn.items)
        ]
        differs = len(there) < len(every) or not all(is_same)
        # graphs side by side have curves of one name
        live = [(made["curves"], plot.box) for made, plot in zip(plots, drawn.plots, strict=False) if made["curves"]]
        marks = [""] * len(drawn.items)
        for at, item in enumerate(drawn.items):
            before = drawn.items[at - 1] if at else None
            if is_same[at] or (
                isinstance(item, Polyline) and is_within(item, (box for curves, box in live if item.name in curves))
            ):
                continue
            is_legend = isinstance(before, Polyline) and before.name == "legend"
            if is_legend and live and (told := self._told(at, there)):
                plots[0].setdefault("told", []).append(told)
                continue
            if is_title(item, (box for _, box in live)):
                # its numbers keep the power of ten that it tells
                continue
            is_curve = isinstance(item, Polyline) and item.name
            # what stands at a value of the scales, and not what is told beside the graphs
            is_upon = is_beside(item, (box for _, box in live))
            marks[at] = GONE if is_upon and not (is_legend or is_curve) else FAINT
        following = {f"frame {at}" for at, one in enumerate(plots) if one["curves"]}
        marks = [frame if frame in following else mark for frame, mark in zip(frame_marks(drawn), marks, strict=True)]
        return plots if live else [], marks if differs else [], differs

    def _upon(self, drawn: Sequence[Drawing]) -> tuple[list[dict[str, Any]], list[str], bool]:
        """Return how a plan of positions follows its joints, what becomes of each item, and whether it differs."""
        found, upon = upon_joints(drawn, self._results)
        keys = {key for one in upon.get("items", {}).values() for corner in one for key in corner[:2] if key}
        differs = any(one != "" for one in found)
        if not keys or any(not self.follows(key) and self.differs(key) for key in keys):
            return [], [FAINT] * len(found) if differs else [], differs
        marks = [
            (GONE if is_label(item) else FAINT) if one is None else one
            for one, item in zip(found, drawn[0].items, strict=True)
        ]
        return [{"curves": {}, "upon": upon}], marks, differs

    def _plot(self, at: int, drawn: Sequence[Drawing], others: Sequence[Drawing]) -> dict[str, Any]:
        """Return the curves of a graph that follow, by name, each with what stands across and upward.

        `others`: the same drawing of the machines around.
        """
        plots = [one.plots[at] for one in drawn if at < len(one.plots)]
        found: dict[str, Any] = {"curves": {}}
        if len(plots) < len(drawn):
            return found
        # what comes to the same as another column where it was looked may part from it elsewhere
        memory = self.memories[0]
        own = {name for name in plots[0].curves if name in memory and memory[name].varies}
        lost = {name for name in own if name not in self._columns and self.differs(name)}
        for name in plots[0].curves:
            if all(name in one.curves for one in plots):
                x = self._moved.designs[: len(plots), 0]
                is_known = name not in lost and (name in own or not lost)
                of = (self._curve(name, plots) if is_known else {}) or self._between.curve(name, at, x, plots, others)
                if of:
                    found["curves"][name] = of
        return found | frame_data(plots[0])

    def _curve(self, name: str, plots: Sequence[Plot]) -> dict[str, Any]:
        x, y = ([one.curves[name][axis] for one in plots] for axis in (0, 1))
        if all(len(one) > 1 and np.ptp(one) == 0 for one in y):
            if any(one.x != plots[0].x for one in plots if one.over):
                return {}
            level = self._single([float(one[0]) for one in y])
            return {"level": level} if level else {}
        if plots[0].over:
            degrees = [
                self._results[at].degrees_of(1.0) * one if plots[0].over == "time" else one for at, one in enumerate(x)
            ]
            up = self._column(name, degrees, y)
            return {"y": up} if up else {}
        if not all(name in one.angles for one in plots):
            return {}
        degrees = [one.angles[name] for one in plots]
        if any(len(one) != len(other) for one, other in zip(degrees, x, strict=True)):
            return {}
        across, up = (self._column(name, degrees, of) for of in (x, y))
        return {"x": across, "y": up} if across and up else {}

    def _told(self, at: int, drawn: Sequence[Drawing]) -> list[Any]:
        """Return the row of a legend that an item is, the number in it, and the single value that it is everywhere."""
        row, numbers = number_in_legend(at, drawn) or (0, [])
        for key in self._singles if numbers else ():
            values = [float(f"{displayed(key, one[key].value):.4g}") for one in self.memories]
            if [number(one, self._language, digits=9) for one in values] == numbers:
                self._rely(key)
                return [row, numbers[0], key, *scale(key)]
        # of a figure between machines it is left out
        return [row, numbers[0], "", 0.0, 0.0] if numbers and len(self._between.values) else []

    def _single(self, values: Sequence[float]) -> list[Any]:
        """Return the single value that a level stands at in all designs, and by what it is multiplied."""
        wanted = np.array(values)
        if np.ptp(wanted) == 0:
            return []
        for key in self._singles:
            of = np.array([one[key].value for one in self.memories])
            factor = (of @ wanted) / (of @ of) if of.any() else 0.0
            if np.max(np.abs(factor * of - wanted)) <= _SAME * np.max(np.abs(wanted)):
                self._rely(key)
                return [key, factor]
        return []

    def _rely(self, key: str) -> None:
        self._used[key] = None
        self._relied.add(key)

    def _column(self, name: str, degrees: Sequence[Array], values: Sequence[Array]) -> list[Any]:
        """Return the column that a curve shows in all designs, and by what it is multiplied."""
        wanted = np.concatenate(values)
        seen = np.isfinite(wanted)
        wanted = wanted[seen]
        if not (self._columns and wanted.any()):
            return []
        every = np.concatenate([self._replay(at, one) for at, one in enumerate(degrees)], axis=1)[:, seen]
        with np.errstate(all="ignore"):
            factors = (every @ wanted) / np.sum(every**2, axis=1)
            apart = np.max(np.abs(factors[:, None] * every - wanted), axis=1)
        fitting = [at for at in np.argsort(apart) if apart[at] <= _SAME * np.max(np.abs(wanted))]
        if not fitting:
            return []
        best = next((at for at in fitting if self._columns[at] == name), fitting[0])
        self._used[self._columns[best]] = None
        return [self._columns[best], float(factors[best])]

    def _replay(self, at: int, degrees: Array) -> Array:
        """Return all columns that follow, of a design at crank angles, shape (columns, n)."""
        mark = at, degrees.tobytes()
        if mark not in self._replayed:
            found = self._results[at].columns_at(self._angles_at(degrees), self._columns)
            self._replayed[mark] = np.array([found[key] for key in self._columns])
        return self._replayed[mark]

    def machine(self) -> tuple[bool, dict[str, Any] | None]:
        """Return whether the machine moves otherwise in other designs, and how its joints follow if they do."""
        films = [one for one in self._films if one is not None]
        if all(is_same_film(films[0], one) for one in films[1:]) and len(films) in (0, len(self._films)):
            return False, None
        shown = [one for one in (self._shown,) if one is not None]
        joints = joints_of([*shown, *films[1:]], self._results)
        keys = [key for pair in (joints or {"joints": {}})["joints"].values() for key in pair]
        if not keys or any(not self.follows(key) and self.differs(key) for key in keys):
            return True, None
        return True, joints

    def data(self) -> tuple[dict[str, Any], str]:
        """Return what the browser calculates with, and the script that does."""
        stated, moved = self._results[0], self._moved
        rows = self._rows(stated.grid.degrees)
        kernel = Kernel(
            self.memories, moved.designs, list(self._used), self._angles_at, cycle=self._cycle,
            is_for_few=True, rows=rows,
        )  # fmt: skip
        self._check(kernel)
        script: Script = kernel.script()
        fields = []
        for one in moved.sliders:
            origin, end = (float(to_si(at, one.unit)) if one.unit else at for at in (0.0, 1.0))
            fields.append({"now": one.now, "scale": end - origin, "origin": origin})
        places = np.searchsorted(rows, stated.grid.degrees - _SAME).tolist()
        return {"fields": fields, "calculation": script.data, "rows": places, "far": _FOLLOWED}, script.text

    def _rows(self, rows: Array) -> Array:
        """Return crank angles of the tables, and those that other cylinders have there. [deg]"""
        known = in_order(self.memories[0][one] for one in self._used)
        delays = {one.node.by for one in known if isinstance(one.node, Delayed)}
        every = rows
        while True:
            more = np.concatenate([every, *(np.mod(every - by, self._cycle) for by in delays)])
            more = np.unique(np.round(more, 9))
            if more.size == every.size or more.size > _MOST_ROWS:
                return every
            every = more

    def _check(self, kernel: Kernel) -> None:
        """Find what is something else than in analyses, of designs that are followed; refuse it where curves are it."""
        found = kernel(self._at.T)
        whole, left_out = found.truncation_error <= _FOLLOWED, np.maximum(found.truncation_error, _SAME)
        self._wrong = {
            key
            for key, values in zip(self._used, found.values, strict=True)
            if not self.memories[0][key].varies and not self._is_right(key, values[whole], whole, left_out[whole])
        }
        if self._wrong & self._relied:
            raise CrankworkError(Refusal("slider_nothing", keys=[one.key for one in self._moved.sliders]))

    def _is_right(self, key: str, values: Array, whole: NDArray[np.bool_], left_out: Array) -> bool:
        """Return whether a single value is that of the analyses of some designs."""
        known = self.memories[0][key]
        count = len(self.memories)
        every = [one.get(key) for one in (*self.memories, *(one.memory for one in self._compared[count:]))][
            : whole.size
        ]
        if key.startswith("#"):
            # what lies between keys is known of those that were traced alone
            every, values, left_out = every[:count], values[: whole[:count].sum()], left_out[: whole[:count].sum()]
        if any(one is None for one in every):
            return False
        expected = np.array([one.value for one in every if one is not None])[whole[: len(every)]]
        # a place where a column is flat is known to the root of its digits
        is_place = "angle" in known.key or "time_ratio" in known.key
        # the mean of a column may be no more than its rounding
        of = known.node.operands if isinstance(known.node, Found) else ()
        columns = [self._results[0].columns.get(one.key, 0.0) for one in of]
        size = max(float(np.max(np.abs(one), initial=0.0)) for one in (expected, *columns, _SAME))
        return bool(
            np.all(np.abs(values - expected) <= np.maximum(_SAME_PLACE if is_place else _SAME, left_out) * size)
        )


def scale(key: str) -> list[float]:
    """Return what takes a value to its display unit: a factor, and what is added."""
    origin = displayed(key, 0.0)
    return [displayed(key, 1.0) - origin, origin]
