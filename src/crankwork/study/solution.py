"""What was found for a value that is wanted, as text and as plain data."""

from __future__ import annotations

from typing import Any

from crankwork.locale import Language, capital, say, told
from crankwork.locale.numbers import number, unit_name
from crankwork.report.language import displayed, key_unit, label, rounded
from crankwork.study.roots import Stretch
from crankwork.study.solve import Solution
from crankwork.units import from_si, use_units

_DIGITS = 12


def solution_text(solution: Solution, language: Language = "en") -> str:
    """Return what was asked, where it was looked for, and everything that was found there."""
    with use_units(solution.units):
        return _text(solution, language)


def _text(solution: Solution, language: Language) -> str:
    shown = _Shown(solution, language)
    found, lines = solution.found, [solution.title] if solution.title else []
    lines += [shown.question(), shown.range(), say("study.missed", language)]
    key = solution.sought.key
    if found.roots:
        rows = [(key, shown.number(one.at), shown.unit, say(f"study.{one.kind}", language)) for one in found.roots]
        lines += ["", say("study.solutions", language), *_aligned(rows)]
    if found.zero:
        rows = [(key, shown.stretch(one), shown.unit, "") for one in found.zero]
        lines += ["", say("study.all_along", language), *_aligned(rows)]
    if not found.roots and not found.zero:
        lines += ["", say("study.none", language), *shown.nearest()]
    if found.jumps:
        rows = [
            (key, shown.number(one.at), shown.unit,
             say("study.jumps_over", language, before=shown.value(one.before), after=shown.value(one.after)))
            for one in found.jumps
        ]  # fmt: skip
        lines += ["", say("study.jumps", language), *_aligned(rows)]
    if found.without:
        rows = [(key, shown.stretch(one), shown.unit, told(one.reason, language)) for one in found.without]
        lines += ["", say("study.without", language), *_aligned(rows)]
    return "\n".join(lines)


class _Shown:
    """The words for one solution: numbers in the units that the file and the tables have."""

    def __init__(self, solution: Solution, language: Language) -> None:
        self._solution, self._language = solution, language
        self.unit = unit_name(solution.sought.unit, language)

    def question(self) -> str:
        """Return what is wanted."""
        key, at, _ = self._solution.wanted
        name = label(key, self._language)
        if at is None:
            place = ""
        elif self._solution.is_time:
            place = f" ({number(at, self._language)} {unit_name('s', self._language)})"
        else:
            place = f" ({number(at, self._language)}°)"
        return f"{capital(name)}{place} = {self.value(0.0)}"

    def range(self) -> str:
        """Return where it was looked for."""
        at, is_even, is_stated = self._solution.places
        ends = {"start": self.number(float(at[0])), "end": f"{self.number(float(at[-1]))} {self.unit}".rstrip()}
        counted = {"field": self._solution.sought.key, "steps": len(at) - 1, **ends}
        if is_even:
            said = say("study.range_even", self._language, **counted, step=self.number(float(at[1] - at[0]), digits=4))
        else:
            ratio = number(float(at[1] / at[0]), self._language, digits=4)
            said = say("study.range_ratio", self._language, **counted, ratio=ratio)
        return said if is_stated else f"{said}; {say('study.range_chosen', self._language)}"

    def number(self, value: float, *, digits: int = _DIGITS) -> str:
        """Return the number that is sought."""
        return number(float(from_si(value, self._solution.sought.unit)), self._language, digits=digits)

    def value(self, above: float) -> str:
        """Return the value of the results, by how far it is above what is wanted."""
        key, _, level = self._solution.wanted
        shown = number(displayed(key, level + above), self._language)
        return f"{shown} {unit_name(key_unit(key), self._language)}".rstrip()

    def stretch(self, stretch: Stretch) -> str:
        """Return from where to where a stretch is, to the digits that are found of its ends."""
        start, end = (self.number(one, digits=5) for one in (stretch.start, stretch.end))
        return start if start == end else f"{start} … {end}"

    def nearest(self) -> list[str]:
        """Return what comes nearest."""
        found = self._solution.nearest
        if found is None:
            return []
        at = f"{self._solution.sought.key} = {self.number(found.at, digits=8)} {self.unit}".rstrip()
        return [f"  {say('study.nearest', self._language, value=self.value(found.value), at=at)}"]


def _aligned(rows: list[tuple[str, str, str, str]]) -> list[str]:
    """Return key, number, unit and words in columns."""
    wide = max(len(row[1]) for row in rows)
    return [
        f"  {key}  {shown:>{wide}} {unit}{'  ' if unit else ' '}{words}".rstrip() for key, shown, unit, words in rows
    ]


def solution_data(solution: Solution) -> dict[str, Any]:
    """Return what was asked and found as plain data, in the units of tables and of the file."""
    with use_units(solution.units):
        return _data(solution)


def _data(solution: Solution) -> dict[str, Any]:
    (key, at, level), sought, found = solution.wanted, solution.sought, solution.found

    def shown(value: float) -> float:
        return rounded(float(from_si(value, sought.unit)))

    def value(above: float) -> float:
        return rounded(displayed(key, level + above))

    def ends(stretch: Stretch) -> dict[str, Any]:
        return {"from": shown(stretch.start), "to": shown(stretch.end)}

    nearest = solution.nearest
    return {
        "title": solution.title,
        "wanted": {"key": key, "value": value(0.0), "unit": key_unit(key)},
        "at": None if at is None else {"value": at, "unit": "s" if solution.is_time else "deg"},
        "sought": {"key": sought.key, "unit": sought.unit},
        "range": {
            "from": shown(float(solution.places.at[0])),
            "to": shown(float(solution.places.at[-1])),
            "steps": len(solution.places.at) - 1,
            "even": solution.places.is_even,
            "stated": solution.places.is_stated,
        },
        "solutions": [
            {"value": shown(one.at), "written": sought.written(one.at), "kind": one.kind} for one in found.roots
        ],
        "all_along": [ends(one) for one in found.zero],
        "jumps": [
            {"value": shown(one.at), "before": value(one.before), "after": value(one.after)} for one in found.jumps
        ],
        "without": [{**ends(one), "reason": str(one.reason)} for one in found.without],
        "nearest": None if nearest is None else {"value": shown(nearest.at), "reached": value(nearest.value)},
    }
