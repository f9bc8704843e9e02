"""Values of a number of a machine file for which a result is what is wanted, as text and as plain data."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from crankwork.analysis import Results, analyse, columns_only, value_only
from crankwork.analysis.requested_values import place_of, with_requested
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField, numeric_field
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.formula.traced_value import TracedValue
from crankwork.locale import ErrorMessage, Language, capital, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.report.display import displayed, key_unit, label, rounded
from crankwork.study.roots import Interval, Jump, Root, RootSearchResult, Sample, find_roots
from crankwork.study.varied_field import SearchPoints, search_points
from crankwork.units import System, from_si, parse_in, use_units

# in SI: rounding
_SAME = 1e-12
_EXAMPLE = "piston_force@33deg = 0"
STEPS = 400
_MIN_STEPS, _MAX_STEPS = 10, 100_000
# errors of a value that other machines in the range may have
_LOCAL_ERRORS = ("result_absent", "result_absent_near", "angle_unreached")
_DIGITS = 12


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


def level(key: str, text: str) -> float:
    """Return a target in SI; a bare number is in the unit of the tables."""
    try:
        return level_of(key, text)
    except ValueError as error:
        option = f"{key} = {text[:40]}"
        raise CrankworkError(ErrorMessage("option_wrong", option=option, mistake=error.args[0])) from None


def level_of(key: str, text: str) -> float:
    """Return a level of a value in SI; ValueError with the mistake if the text is none."""
    unit = key_unit(key)
    try:
        value = parse_in(text, unit) if unit else float(text.replace(",", "."))
    except ValueError as error:
        raise ValueError(error.args[0] if unit else ErrorMessage("level_plain", text=text[:40])) from None
    if not math.isfinite(value):
        raise ValueError(ErrorMessage("level_plain", text=text[:40]))
    return value


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
        the number of the file.
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
