"""Which number of a machine file makes a value of its results what is wanted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.study.roots import Found, Jump, Root, Sample, Stretch, find_roots
from crankwork.study.sought import Places, Sought, places, sought_number
from crankwork.study.wanted import Wanted, Written, is_rounding, shortest, wanted, written
from crankwork.units import System

STEPS = 400
_FEWEST, _MOST = 10, 100_000
# refusals of a value that another machine in the range may have
_ELSEWHERE = ("result_absent", "angle_unreached")


@dataclass(frozen=True)
class Solution:
    """Where a value is what is wanted, in SI; `sought.written` returns a number as the machine file states it.

    Parameters
    ----------
    title : str
        That of the machine.
    wanted : Wanted
        The value: its key, where, and what it is to be.
    sought : Sought
        The number of the file.
    places : Places
        Where it was looked for. Two roots, or two ends of stretches, between two of these may be missed.
    found : Found
        Roots, jumps, stretches without a value, and what comes nearest; values are those above what is wanted.
    is_time : bool
        Whether the value is taken at a time, and not at a crank angle.
    units : str
        The system of units that the machine is shown in.
    """

    title: str
    wanted: Wanted
    sought: Sought
    places: Places
    found: Found
    is_time: bool = False
    units: System = "metric"

    @property
    def roots(self) -> tuple[Root, ...]:
        """The numbers that were sought."""
        return self.found.roots

    @property
    def jumps(self) -> tuple[Jump, ...]:
        """The numbers at which the value passes what is wanted without being it."""
        return self.found.jumps

    @property
    def without(self) -> tuple[Stretch, ...]:
        """The stretches of numbers for which there is no machine or no value, and why."""
        return self.found.without

    @property
    def nearest(self) -> Sample | None:
        """The number at which the value comes nearest to what is wanted."""
        return self.found.nearest


def solve(  # noqa: PLR0913 - what is asked, where to look, and what is laid over the file
    description: Description,
    equation: str,
    sought: str,
    *,
    limits: tuple[str | float | None, str | float | None] = (None, None),
    steps: int = STEPS,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Solution:
    """Return every number of a machine file that makes a value what is wanted, of those between some limits.

    Parameters
    ----------
    description : Description
        The machine file.
    equation : str
        The value and what it is to be: `piston_force@33deg = 0`, `time_ratio.rocker = 1.2`. A number without a unit is
        in the unit of the tables.
    sought : str
        Key of the number, as `--set` takes it.
    limits : tuple of str or float
        From where to where it is looked for, with a unit, or in that of the file; what is left out follows from the
        limits of the field or from the number that the file has.
    steps : int
        How many steps the range has, even ones or of equal ratios.
    overrides : sequence of str
        Settings laid over the file, `KEY=VALUE`.
    told : callable, optional
        Told the part of the range that is done. [-]

    Returns
    -------
    Solution
        Roots, jumps, stretches without a machine, and what comes nearest.

    Raises
    ------
    CrankworkError
        If the question cannot be asked of this file.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("four-bar"))
    >>> found = crankwork.solve(d, "link_swing.rocker = 80 deg", "crank.radius", limits=("40 mm", "100 mm"), steps=20)
    >>> [round(root.at, 6) for root in found.roots]
    [0.072126]
    """
    if not _FEWEST <= steps <= _MOST:
        raise CrankworkError(Refusal("steps_outside", fewest=str(_FEWEST), most=str(_MOST)))
    parts = written(equation)
    number = sought_number(description.values_with(overrides), sought)
    where = places(number, *limits, steps)

    def machine_with(value: float | None) -> Machine:
        changed = [] if value is None else [Setting("--for", sought, number.written(value))]
        return description.machine([*overrides, *changed])

    asked, machine, results = _first_with_value(parts, machine_with, where)
    value = shortest(asked, machine, results)
    if is_rounding(asked, results) and _is_nothing(asked, machine_with, where):
        value = _nothing

    def above(at: float) -> float:
        try:
            return value(machine_with(at)) - asked.level
        except UnknownKeyError:
            raise CrankworkError(Refusal("value_absent", key=asked.key)) from None

    found = find_roots(above, where.at, abs(asked.level), told)
    shown = results.machine
    return Solution(shown.title, asked, number, where, found, is_time=bool(results.period), units=shown.units)


def _first_with_value(
    parts: Written, machine_with: Callable[[float | None], Machine], where: Places
) -> tuple[Wanted, Machine, Results]:
    """Return what is asked of the machine of the file, or of the first one in the range that has such a value.

    If none has, what keeps the machine of the file from having it is raised.
    """
    first: CrankworkError | None = None
    for value in (None, *where.at.tolist()):
        try:
            machine = machine_with(value)
            results = analyse(machine)
        except CrankworkError as error:
            first = first or error
            continue
        try:
            return wanted(parts, results), machine, results
        except CrankworkError as error:
            if not isinstance(error.args[0], Refusal) or error.args[0].name not in _ELSEWHERE:
                raise
            first = first or error
    raise first or CrankworkError(Refusal("value_none"))


def _is_nothing(asked: Wanted, machine_with: Callable[[float | None], Machine], where: Places) -> bool:
    """Return whether only rounding is left of a value all over the range."""
    for value in where.at[:: len(where.at) // 4].tolist():
        try:
            if not is_rounding(asked, analyse(machine_with(value))):
                return False
        except CrankworkError:
            continue
    return True


def _nothing(_: Machine) -> float:
    return 0.0
