"""Solve for a number of a machine file that gives a value of its results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField, numeric_field
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.study.roots import Interval, Jump, Root, RootSearchResult, Sample, find_roots
from crankwork.study.search_points import SearchPoints, search_points
from crankwork.study.target import Target, TargetText, is_rounding, parse_target, split_target, value_function
from crankwork.units import System

STEPS = 400
_MIN_STEPS, _MAX_STEPS = 10, 100_000
# errors of a value that other machines in the range may have
_LOCAL_ERRORS = ("result_absent", "result_absent_near", "angle_unreached")


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
        changed = [] if value is None else [Setting("--for", sought, number.written(value))]
        return description.machine([*overrides, *changed])

    target, machine, results = _first_with_value(parts, machine_with, where)
    value = value_function(target, machine, results)
    if is_rounding(target, results) and _is_zero(target, machine_with, where):
        value = _zero

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


def _zero(_: Machine) -> float:
    return 0.0
