"""Values of one or several numbers of a machine file for which results are what is wanted."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Results, analyse, columns_only, value_only
from crankwork.analysis.requested_values import place_of, with_requested
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage, Language, capital, in_language, translate
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.machine import Machine
from crankwork.report.display import displayed, key_unit, label, rounded
from crankwork.study.roots import Interval, Jump, Root, RootSearchResult, Sample, find_roots
from crankwork.study.search import DesignSpace, check_scipy
from crankwork.study.study_text import value_text, with_unit
from crankwork.study.variants import single
from crankwork.study.varied_field import SearchPoints, level, search_points
from crankwork.units import System, from_si, use_units

# in SI: rounding
_SAME = 1e-12
_EXAMPLE = "piston_force@33deg = 0"
STEPS = 400
_MIN_STEPS, _MAX_STEPS = 10, 100_000
# by which factor a number may be off where nothing is found near it
_FAR_AROUND = 1000.0
# errors of a value that other machines in the range may have
_LOCAL_ERRORS = ("result_absent", "result_absent_near", "angle_unreached")
_DIGITS = 12
STARTS = 12
# largest distance of a value from its target, relative to the size of both, and of equal solutions in the range
_REACHED, _EQUAL = 1e-9, 1e-6
# relative step below which nothing changes
_STILL = 1e-15
_MAX_UNKNOWNS, _SEVERAL_DIGITS = 8, 10


class Target(NamedTuple):
    """A value of the results: key, crank angle or time, and its target. [SI]"""

    key: str
    position: float | None  # Crank angle [deg], or time with a time-based driver [s]
    level: float


class TargetText(NamedTuple):
    """An equation as text: left side, position after an @ there, right side."""

    key: str
    place: str
    level: str


def split_target(equation: str) -> TargetText:
    """Split the text of an equation."""
    left, sign, right = (part.strip() for part in equation.rpartition("="))
    key, place_sign, place = (part.strip() for part in left.rpartition("@"))
    key, place = (key, place) if place_sign else (left, "")
    if not sign or not key or not right or (place_sign and not place) or len(equation) > 200:
        raise CrankworkError(ErrorMessage("equation_form", equation=equation[:60], example=_EXAMPLE))
    return TargetText(key, place, right)


def parse_target(parts: TargetText, results: Results) -> Target:
    """Parse and validate a target equation against the results of the stated machine."""
    key, place, right = results.current(parts.key), parts.place, parts.level
    results = results if place else with_requested(results, [key])
    if key not in results:
        # raises an error with the nearest keys
        results.value(key)
    results = results.holding(key)
    known = results.trace.get(key)
    varies = known.varies if known is not None else key in results.columns
    if place and not varies:
        raise CrankworkError(ErrorMessage("place_meaningless", key=key))
    if varies and not place:
        example = f"{results.period / 2:g}s" if results.period else "90deg"
        raise CrankworkError(ErrorMessage("place_missing", key=key, example=f"{key}@{example}"))
    position = place_of(place, is_time=bool(results.period)) if place else None
    # raises an error for an angle outside the cycle
    results.value(key, position)
    with use_units(results.machine.units):
        return Target(key, position, level(key, right))


def value_function(target: Target, machine: Machine, results: Results) -> Callable[[Machine], float]:
    """Return the function that gives a value of variants of a machine by the cheapest analysis.

    Cheaper analyses are compared with the full one for this machine.
    """
    key, position, _ = target
    methods: list[Callable[[Machine], Results]] = [analyse]
    if machine.transient is not None:
        methods.insert(0, lambda variant: analyse(replace(variant, transient=None)))
    if position is None:
        methods.insert(0, lambda variant: value_only(variant, key))
    elif not results.has_positions:
        methods.insert(0, columns_only)
    value = results.value(key, position)
    for method in methods[:-1]:
        partial = method(machine)
        if key in partial.trace and math.isclose(partial.value(key, position), value, abs_tol=_SAME):
            return lambda variant: method(variant).value(key, position)
    requested = [key] if position is None else []
    return lambda variant: with_requested(analyse(variant), requested).value(key, position)


def is_rounding(target: Target, results: Results) -> bool:
    """Return whether a value is only the rounding error of larger ones."""
    results = results.holding(target.key)
    known: TracedValue | None = results.trace.get(target.key)
    if known is None or results.has_positions:
        return False
    return results.moment(0.0 if target.position is None else results.degrees_of(target.position)).is_noise(known)


@dataclass(frozen=True)
class Solution:
    """Solutions of a target equation, in SI; `sought.written` returns a number as the machine file states it.

    Parameters
    ----------
    title : str
        Title of the machine.
    wanted : Target
        The value: its key, crank angle or time, and target.
    sought : NumericField
        The unknown, a number of the file.
    places : SearchPoints
        Sampled values of the unknown. Two roots, or two ends of intervals, between two of these may be missed.
    found : RootSearchResult
        Roots, jumps, intervals without a value, and the nearest sample; values are differences from the target.
    is_time : bool
        Whether the value is taken at a time, and not at a crank angle.
    units : str
        The system of units of the machine.
    """

    title: str
    wanted: Target
    sought: NumericField
    places: SearchPoints
    found: RootSearchResult
    is_time: bool = False
    units: System = "metric"

    @property
    def roots(self) -> tuple[Root, ...]:
        """Solutions."""
        return self.found.roots

    @property
    def jumps(self) -> tuple[Jump, ...]:
        """Numbers at which the value jumps across the target."""
        return self.found.jumps

    @property
    def without(self) -> tuple[Interval, ...]:
        """Intervals without a machine or a value, and why."""
        return self.found.without

    @property
    def nearest(self) -> Sample | None:
        """The sample closest to the target."""
        return self.found.nearest


def solve(  # noqa: PLR0913 - equation, unknown and options of the search
    description: Description,
    equation: str,
    sought: str,
    *,
    limits: tuple[str | float | None, str | float | None] = (None, None),
    steps: int = STEPS,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Solution:
    """Return every value of a number of the machine file, between limits, that satisfies a target equation.

    Parameters
    ----------
    description : Description
        The machine file.
    equation : str
        The value and its target: `piston_force@33deg = 0`, `time_ratio.rocker = 1.2`. A number without a unit is in the
        unit of the tables.
    sought : str
        Key of the number, as in `--set`.
    limits : tuple of str or float
        Range of the search, with a unit, or in the unit of the file; by default from the limits of the field or around
        the number of the file, and farther from it where nothing is found.
    steps : int
        Number of steps of the range, even or of equal ratios.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    told : callable, optional
        Called with the fraction of the range done. [-]

    Returns
    -------
    Solution
        Roots, jumps, intervals without a machine, and the sample closest to the target.

    Raises
    ------
    CrankworkError
        If the equation or an argument is invalid for this file.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("four-bar"))
    >>> found = crankwork.solve(d, "link_swing.rocker = 80 deg", "crank.radius", limits=("40 mm", "100 mm"), steps=20)
    >>> [round(root.at, 6) for root in found.roots]
    [0.072126]
    """
    if not _MIN_STEPS <= steps <= _MAX_STEPS:
        raise CrankworkError(ErrorMessage("steps_outside", fewest=str(_MIN_STEPS), most=str(_MAX_STEPS)))
    parts = split_target(equation)
    number = numeric_field(description.values_with(overrides), sought)
    where = search_points(number, *limits, steps)

    def machine_with(value: float | None) -> Machine:
        changed = [] if value is None else [number.setting(value, "--for")]
        return description.machine([*overrides, *changed])

    target, machine, results = _first_with_value(parts, machine_with, where)
    value = value_function(target, machine, results)
    if is_rounding(target, results) and _is_zero(target, machine_with, where):
        value = lambda _: 0.0  # noqa: E731 - as the other ways to a value

    def above(field_value: float) -> float:
        try:
            return value(machine_with(field_value)) - target.level
        except UnknownKeyError:
            raise CrankworkError(ErrorMessage("value_absent", key=target.key)) from None

    result = find_roots(above, where.values, abs(target.level), told)
    if not (where.is_stated or result.roots or result.jumps or result.zero):
        wider = search_points(number, *limits, steps, _FAR_AROUND)
        if (second := find_roots(above, wider.values, abs(target.level), told)).roots:
            where, result = wider, second
    shown = results.machine
    return Solution(shown.title, target, number, where, result, is_time=bool(results.period), units=shown.units)


def _first_with_value(
    parts: TargetText, machine_with: Callable[[float | None], Machine], where: SearchPoints
) -> tuple[Target, Machine, Results]:
    """Return the target for the machine of the file, or for the first in the range that has such a value.

    If there is none, the error of the machine of the file is raised.
    """
    first: CrankworkError | None = None
    for value in (None, *where.values.tolist()):
        try:
            machine = machine_with(value)
            results = analyse(machine)
        except CrankworkError as error:
            first = first or error
            continue
        try:
            return parse_target(parts, results), machine, results
        except CrankworkError as error:
            if not isinstance(error.args[0], ErrorMessage) or error.args[0].name not in _LOCAL_ERRORS:
                raise
            first = first or error
    raise first or CrankworkError(ErrorMessage("value_none"))


def _is_zero(target: Target, machine_with: Callable[[float | None], Machine], where: SearchPoints) -> bool:
    """Return whether a value is rounding noise over the whole range."""
    for value in where.values[:: len(where.values) // 4].tolist():
        try:
            if not is_rounding(target, analyse(machine_with(value))):
                return False
        except CrankworkError:
            continue
    return True


def solution_text(solution: Solution, language: Language = "en") -> str:
    """Return the equation, the range and everything found there as text."""
    with use_units(solution.units):
        return _text(solution, language)


def _text(solution: Solution, language: Language) -> str:
    shown = _Shown(solution, language)
    result, lines = solution.found, [solution.title] if solution.title else []
    lines += [shown.question(), shown.range(), translate("study.missed", language)]
    key = solution.sought.key
    if result.roots:
        rows = [
            (key, shown.number(root.at), shown.unit, translate(f"study.{root.kind}", language)) for root in result.roots
        ]
        lines += ["", translate("study.solutions", language), *_aligned(rows)]
    if result.zero:
        rows = [(key, shown.stretch(interval), shown.unit, "") for interval in result.zero]
        lines += ["", translate("study.all_along", language), *_aligned(rows)]
    if not result.roots and not result.zero:
        lines += ["", translate("study.none", language), *shown.nearest()]
    if result.jumps:
        rows = [
            (key, shown.number(jump.at), shown.unit,
             translate("study.jumps_over", language, before=shown.value(jump.before), after=shown.value(jump.after)))
            for jump in result.jumps
        ]  # fmt: skip
        lines += ["", translate("study.jumps", language), *_aligned(rows)]
    if result.without:
        rows = [(key, shown.stretch(gap), shown.unit, in_language(gap.reason, language)) for gap in result.without]
        lines += ["", translate("study.without", language), *_aligned(rows)]
    return "\n".join(lines)


class _Shown:
    """Texts of one solution, with numbers in the units of the file and the tables."""

    def __init__(self, solution: Solution, language: Language) -> None:
        self._solution, self._language = solution, language
        self.unit = unit_name(solution.sought.unit, language)

    def question(self) -> str:
        """Return the equation."""
        key, position, _ = self._solution.wanted
        name = label(key, self._language)
        if position is None:
            place = ""
        elif self._solution.is_time:
            place = f" ({number(position, self._language)} {unit_name('s', self._language)})"
        else:
            place = f" ({number(position, self._language)}°)"
        return f"{capital(name)}{place} = {self.value(0.0)}"

    def range(self) -> str:
        """Return the range searched."""
        values, is_even, is_stated = self._solution.places
        ends = {"start": self.number(float(values[0])), "end": f"{self.number(float(values[-1]))} {self.unit}".rstrip()}
        counted = {"field": self._solution.sought.key, "steps": len(values) - 1, **ends}
        if is_even:
            step = self.number(float(values[1] - values[0]), digits=4)
            text = translate("study.range_even", self._language, **counted, step=step)
        else:
            ratio = number(float(values[1] / values[0]), self._language, digits=4)
            text = translate("study.range_ratio", self._language, **counted, ratio=ratio)
        return text if is_stated else f"{text}; {translate('study.range_chosen', self._language)}"

    def number(self, value: float, *, digits: int = _DIGITS) -> str:
        """Return a value of the unknown."""
        return number(float(from_si(value, self._solution.sought.unit)), self._language, digits=digits)

    def value(self, above: float) -> str:
        """Return a value of the results, by its difference from the target."""
        key, _, level = self._solution.wanted
        shown = number(displayed(key, level + above), self._language)
        return f"{shown} {unit_name(key_unit(key), self._language)}".rstrip()

    def stretch(self, stretch: Interval) -> str:
        """Return the ends of an interval, to the digits to which they are found."""
        start, end = (self.number(limit, digits=5) for limit in (stretch.start, stretch.end))
        return start if start == end else f"{start} … {end}"

    def nearest(self) -> list[str]:
        """Return the line of the sample closest to the target."""
        sample = self._solution.nearest
        if sample is None:
            return []
        place = f"{self._solution.sought.key} = {self.number(sample.at, digits=8)} {self.unit}".rstrip()
        return [f"  {translate('study.nearest', self._language, value=self.value(sample.value), at=place)}"]


def _aligned(rows: list[tuple[str, str, str, str]]) -> list[str]:
    """Return key, number, unit and text in columns."""
    wide = max(len(row[1]) for row in rows)
    return [
        f"  {key}  {shown:>{wide}} {unit}{'  ' if unit else ' '}{words}".rstrip() for key, shown, unit, words in rows
    ]


def solution_data(solution: Solution) -> dict[str, Any]:
    """Return equation and solutions as plain data, in the units of tables and of the file."""
    with use_units(solution.units):
        return _data(solution)


def _data(solution: Solution) -> dict[str, Any]:
    (key, position, level), field, result = solution.wanted, solution.sought, solution.found

    def shown(value: float) -> float:
        return rounded(float(from_si(value, field.unit)))

    def value(above: float) -> float:
        return rounded(displayed(key, level + above))

    def ends(stretch: Interval) -> dict[str, Any]:
        return {"from": shown(stretch.start), "to": shown(stretch.end)}

    nearest = solution.nearest
    return {
        "title": solution.title,
        "wanted": {"key": key, "value": value(0.0), "unit": key_unit(key)},
        "at": None if position is None else {"value": position, "unit": "s" if solution.is_time else "deg"},
        "sought": {"key": field.key, "unit": field.unit},
        "range": {
            "from": shown(float(solution.places.values[0])),
            "to": shown(float(solution.places.values[-1])),
            "steps": len(solution.places.values) - 1,
            "even": solution.places.is_even,
            "stated": solution.places.is_stated,
        },
        "solutions": [
            {"value": shown(root.at), "written": field.written(root.at), "kind": root.kind} for root in result.roots
        ],
        "all_along": [ends(interval) for interval in result.zero],
        "jumps": [
            {"value": shown(jump.at), "before": value(jump.before), "after": value(jump.after)} for jump in result.jumps
        ],
        "without": [{**ends(gap), "reason": str(gap.reason)} for gap in result.without],
        "nearest": None if nearest is None else {"value": shown(nearest.at), "reached": value(nearest.value)},
    }


@dataclass(frozen=True)
class SeveralSolutions:
    """Numbers of a machine file that satisfy several equations. [SI]

    Parameters
    ----------
    title : str
        Title of the machine.
    wanted : dict of str to float
        The target of each value.
    unknowns : tuple of NumericField
        The unknowns.
    ranges : array, shape (unknowns, 2)
        Where they were unknowns.
    solutions : tuple of array, shape (unknowns,)
        Each solution found.
    nearest : array, shape (unknowns,)
        The numbers that come closest where there is no solution.
    reached : array, shape (equations,)
        The values there.
    starts : int
        Number of points from which solutions were unknowns; others may exist.
    units : str
        The system of units of the machine.
    """

    title: str
    wanted: dict[str, float]
    unknowns: tuple[NumericField, ...]
    ranges: Array
    solutions: tuple[Array, ...]
    nearest: Array
    reached: Array
    starts: int
    units: System


def solve_several(  # noqa: PLR0913 - equations, unknowns and options of the search
    description: Description,
    equations: Sequence[str],
    unknowns: Sequence[str],
    *,
    limits: Sequence[tuple[str | float | None, str | float | None]] = (),
    starts: int = STARTS,
    overrides: Sequence[str | Setting] = (),
    progress: Callable[[float], None] | None = None,
) -> SeveralSolutions:
    """Return numbers of the machine file, as many as there are equations, that satisfy all of them.

    Newton's steps start at the stated numbers and at points spread over the range.

    Parameters
    ----------
    description : Description
        The machine file.
    equations : sequence of str
        Values and targets, as `solve` takes them.
    unknowns : sequence of str
        Keys of the numbers, as in `--set`.
    limits : sequence of tuple
        Range of each number, as `solve` takes it.
    starts : int
        Number of points to start from.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    progress : callable, optional
        Called with the fraction done. [-]

    Raises
    ------
    CrankworkError
        If an equation or a number is invalid for this file, or there are not as many of both.
    """
    check_scipy(ErrorMessage("extra_solve"))
    from scipy.optimize import least_squares  # noqa: PLC0415 - an optional part

    if len(equations) != len(unknowns) or len(set(unknowns)) < len(unknowns) or len(unknowns) > _MAX_UNKNOWNS:
        raise CrankworkError(ErrorMessage("solve_counts", equations=len(equations), unknowns=len(unknowns)))
    stated = description.values_with(overrides)
    fields = tuple(numeric_field(stated, key) for key in unknowns)
    ends = [search_points(field, *pair, 2).values for field, pair in zip(fields, limits or [(None, None)] * len(fields),
                                                                         strict=True)]  # fmt: skip
    results = analyse(description.machine(overrides))
    wanted = dict[str, float]()
    for text in equations:
        parts = split_target(text)
        target = parse_target(parts, results)
        wanted[f"{target.key}@{parts.place}" if parts.place else target.key] = target.level
    levels = np.array(list(wanted.values()))
    bounds = {field.key: (float(low), float(high)) for field, (low, _, high) in zip(fields, ends, strict=True)}
    space = DesignSpace(
        description, bounds, list(wanted), start={}, overrides=overrides, seed=0, seen=lambda _, __: None
    )
    size = np.maximum(np.abs(levels), np.abs(np.nan_to_num(space.values(space.start))))
    size[size == 0.0] = 1.0

    def off(place: Array) -> Array:
        return np.asarray(np.nan_to_num((space.values(np.ascontiguousarray(place)) - levels) / size, nan=1e6))

    def slope(place: Array) -> Array:
        near = space.local_model(np.ascontiguousarray(place))
        return np.zeros((len(wanted), len(fields))) if near is None else np.asarray(near.slopes / size[:, None])

    def is_solution(exact: Results) -> bool:
        return bool(np.all(np.abs([single(exact, key) for key in wanted] - levels) <= 10 * _REACHED * size))

    solutions, closest = list[Array](), (np.inf, space.start)
    for index, start in enumerate([space.start, *space.sample(starts - 1)]):
        place = np.clip(start, 0.0, 1.0)
        if np.isfinite(space.values(place)).all():
            place = least_squares(
                off, place, slope, bounds=(0.0, 1.0), ftol=_STILL, xtol=_STILL, gtol=_STILL, max_nfev=60
            ).x
            distance = float(np.abs(off(place)).max())
            closest = min(closest, (distance, place), key=lambda pair: pair[0])
            if distance <= _REACHED and all(np.abs(place - other).max() > _EQUAL for other in solutions):
                solutions.append(place)
        if progress is not None:
            progress((index + 1) / starts)
    # the analysis decides, not the compiled values
    solutions = [place for place in solutions if is_solution(space.results(place))]
    return SeveralSolutions(
        results.machine.title or "", wanted, fields, np.array([[low, high] for low, _, high in ends]),
        tuple(sorted((space.design(place) for place in solutions), key=tuple)), space.design(closest[1]),
        space.values(closest[1]), starts, results.machine.units,
    )  # fmt: skip


def several_text(solution: SeveralSolutions, language: Language = "en") -> str:
    """Return equations, ranges and solutions as text."""
    with use_units(solution.units):
        return "\n".join(_lines(solution, language)).rstrip()


def _lines(solution: SeveralSolutions, language: Language) -> Iterator[str]:
    if solution.title:
        yield solution.title
    for key, target in solution.wanted.items():
        yield f"{capital(label(key, language))} = {value_text(key, target, language)}"
    ranges = zip(solution.unknowns, solution.ranges.tolist(), strict=True)
    yield from aligned(
        [(field.key, " … ".join(_shown(field, end, language) for end in ends)) for field, ends in ranges]
    )
    yield translate("study.several_missed", language, starts=solution.starts)
    yield from ("", translate("study.solutions" if solution.solutions else "study.none", language))
    for place in solution.solutions:
        yield from (*_numbers(solution, place, language), "")
    if not solution.solutions:
        reached = zip(solution.wanted, solution.reached.tolist(), strict=True)
        yield from (translate("study.several_nearest", language), *_numbers(solution, solution.nearest, language))
        yield from aligned([(label(key, language), value_text(key, value, language)) for key, value in reached])


def _numbers(solution: SeveralSolutions, place: Array, language: Language) -> list[str]:
    pairs = zip(solution.unknowns, place.tolist(), strict=True)
    return aligned([(field.key, _shown(field, value, language)) for field, value in pairs])


def _shown(field: NumericField, value: float, language: Language) -> str:
    return with_unit(float(from_si(value, field.unit)), field.unit, language, _SEVERAL_DIGITS)


def several_data(solution: SeveralSolutions) -> dict[str, Any]:
    """Return equations and solutions as plain data, in the units of tables and of the file."""

    def numbers(place: Array) -> dict[str, Any]:
        pairs = zip(solution.unknowns, place.tolist(), strict=True)
        return {field.key: rounded(float(from_si(value, field.unit))) for field, value in pairs}

    with use_units(solution.units):
        return {
            "title": solution.title,
            "wanted": [{"key": key, "value": rounded(displayed(key, level)), "unit": key_unit(key)}
                       for key, level in solution.wanted.items()],
            "unknowns": [{"key": field.key, "unit": field.unit} for field in solution.unknowns],
            "range": {"from": numbers(solution.ranges[:, 0]), "to": numbers(solution.ranges[:, 1])},
            "starts": solution.starts,
            "solutions": [numbers(place) for place in solution.solutions],
            "nearest": None if solution.solutions else numbers(solution.nearest),
        }  # fmt: skip
