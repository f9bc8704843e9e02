"""The sliders of a page: which numbers of a machine file a reader may move, and how far the machine goes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.kinds import shown
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.page.sliders import Moved, Slider
from crankwork.study.sought import Sought, limit, sought_number

_OPTION = "--slider"
_ASKED = re.compile(r"\s*(?P<key>[^=\s]+)\s*(?:=\s*(?P<low>[^:]+?)\s*\.\.\s*(?P<high>[^:]+?)\s*)?")
_NUMBER = re.compile(r"[+-]?[0-9.,]+(?:[eE][+-]?[0-9]+)?")
_MOST = 8
# of what a number is now, how far it goes where nobody says
_AROUND = 0.5
# halvings of the way to a machine that there is not
_NEARER = 12
# of the way to the last machine, how far a slider goes: beyond that forces grow without bounds
_WITHIN = 0.97
# where all sliders are moved at once, of the way to their ends
_TOGETHER = 0.3


def moved(
    description: Description,
    asked: Sequence[str],
    overrides: Sequence[str | Setting],
    stated: Results,
    around: float = _AROUND,
) -> Moved:
    """Return the sliders that options ask for, `crank.speed=1000..6000rpm`, with the results of designs between them.

    A range that nobody states is a share `around` of the number either way, within its limits; one that leads to where
    there is no machine ends before that.
    """
    if len(asked) > _MOST:
        raise CrankworkError(Refusal("slider_many", most=str(_MOST)))
    values = description.values_with(overrides)
    ranges = [_range(values, one, around) for one in asked]
    keys = [number.key for number, *_ in ranges]
    if len(set(keys)) < len(keys):
        raise CrankworkError(Refusal("slider_twice", key=next(key for key in keys if keys.count(key) > 1)))
    if "crank_range" in stated.summary:
        # dead positions move with the design
        raise CrankworkError(Refusal("slider_swings"))
    machines = _Machines(description, overrides, [number for number, *_ in ranges], stated)
    now = machines.now
    sliders, rows, found = [], [now], [stated]
    for at, (number, low, high) in enumerate(ranges):
        ends, stop = [], None
        for end in (low, high):
            reached, results, cause = machines.reached(at, end)
            ends.append(reached)
            stop = stop or cause
            rows.append(np.where(np.arange(now.size) == at, reached, now))
            found.append(results)
        if not ends[0] < ends[1]:
            raise CrankworkError(Refusal("slider_fixed", key=number.key)) from stop
        sliders.append(Slider(number.key, float(now[at]), ends[0], ends[1], number.unit, stop))
    together = _TOGETHER
    # of one slider the ends say it all
    while len(sliders) > 1 and together > 1e-3:
        row = now + together * np.array([one.high - one.now or one.low - one.now for one in sliders])
        try:
            results = machines.results(row)
        except CrankworkError:
            together /= 2
            continue
        return Moved(tuple(sliders), np.array([*rows, row]), (*found, results))
    return Moved(tuple(sliders), np.array(rows), tuple(found))


def ends(description: Description, key: str, low: str, high: str) -> list[float]:
    """Return between which values a number goes, as written; nothing where it may not, or is not between them. [SI]"""
    with suppress(CrankworkError):
        return list(_range(description.values_with(()), f"{key}={low}..{high}", _AROUND)[1:])
    return []


def around(description: Description, key: str, stated: Results, values: Sequence[float]) -> dict[float, Results]:
    """Return the results of machines with other values of one number, by what it is. [SI]

    In the order of the values; none where there is no such machine, and for the value that is stated the stated one.
    """
    number, *_ = _range(description.values_with(()), key, _AROUND)
    machines, found = _Machines(description, (), [number], stated), dict[float, Results]()
    for value in values:
        if number.low <= value <= number.high:
            with suppress(CrankworkError):
                found[value] = stated if value == machines.now[0] else machines.results(np.array([value]))
    return found


def _range(values: dict[str, object], text: str, around: float) -> tuple[Sought, float, float]:
    """Return the number that an option names, and between what it goes. [SI]"""
    match = _ASKED.fullmatch(text)
    if match is None:
        raise CrankworkError(Refusal("slider_form", text=text[:60]))
    key = match["key"]
    try:
        sought = sought_number(values, key)
    except CrankworkError as error:
        mistake = error.args[0]
        if mistake.name.startswith("sought"):
            raise CrankworkError(Refusal("slider_no_number", key=key[:60])) from None
        mistake = mistake.values["mistake"] if mistake.name == "option_key_wrong" else mistake
        raise CrankworkError(Refusal("option_wrong", option=f"{_OPTION} {key[:60]}", mistake=mistake)) from None
    if sought.now is None:
        raise CrankworkError(Refusal("slider_unstated", key=key))
    if match["low"] is None:
        reach = around * abs(sought.now) or around * min(sought.high, 1.0)
        return sought, max(sought.low, sought.now - reach), min(sought.high, sought.now + reach)
    low, high = match["low"], match["high"]
    unit = _NUMBER.sub("", high, count=1)
    # a unit that stands once holds for both
    low = f"{low}{unit}" if _NUMBER.fullmatch(low) else low
    option = f"{_OPTION} {key}"
    ends = [limit(sought, one, option) for one in (low, high)]
    assert ends[0] is not None and ends[1] is not None  # noqa: S101, PT018 - both are stated
    if not ends[0] < ends[1]:
        raise CrankworkError(Refusal("slider_empty", key=key, start=low, end=high))
    if not ends[0] <= sought.now <= ends[1]:
        raise CrankworkError(Refusal("slider_beside", key=key, now=shown(sought.written(sought.now))))
    return sought, ends[0], ends[1]


class _Machines:
    """Machines of a file that differ in what the sliders move."""

    def __init__(
        self, description: Description, overrides: Sequence[str | Setting], numbers: Sequence[Sought], stated: Results
    ) -> None:
        self._description, self._overrides, self._numbers, self._stated = description, overrides, numbers, stated
        self.now: Array = np.array([one.now for one in numbers])

    def results(self, design: Array) -> Results:
        """Return the results of a design that moves as the stated one does."""
        settings = [
            Setting(_OPTION, number.key, number.written(float(value)))
            for number, value in zip(self._numbers, design, strict=True)
        ]
        found = analyse(self._description.machine([*self._overrides, *settings]))
        if "crank_range" in found.summary and "crank_range" not in self._stated.summary:
            raise CrankworkError(Refusal("slider_no_turn"))
        return found

    def reached(self, at: int, end: float) -> tuple[float, Results, CrankworkError | None]:
        """Return how far one number goes to an end, the results there, and why it goes no further."""

        def tried(share: float) -> Results:
            row = self.now.copy()
            row[at] += share * (end - row[at])
            return self.results(row)

        try:
            return end, tried(1.0), None
        except CrankworkError as error:
            cause = error
        low, high, found = 0.0, 1.0, self._stated
        for _ in range(_NEARER):
            middle = (low + high) / 2
            try:
                found, low = tried(middle), middle
            except CrankworkError as error:
                cause, high = error, middle
        low *= _WITHIN
        return float(self.now[at] + low * (end - self.now[at])), tried(low) if low else found, cause
