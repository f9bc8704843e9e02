"""Solutions of `solve` as text and as plain data."""

from __future__ import annotations

from typing import Any

from crankwork.locale import Language, capital, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.report.display import displayed, key_unit, label, rounded
from crankwork.study.roots import Interval
from crankwork.study.solve import Solution
from crankwork.units import from_si, use_units

_DIGITS = 12


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
