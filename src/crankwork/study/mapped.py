"""Results of a machine over one or two numbers of its file: speed and load, and what does not depend on either."""

from __future__ import annotations

import contextlib
import functools
import itertools
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.formula.known import Given
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, Refusal, capital, say, told
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.report.language import displayed, displayed_column, key_unit, label, rounded
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.study.chunks import by_kind, reason_of
from crankwork.study.machines import Machines
from crankwork.study.running import each
from crankwork.study.sought import Places, Sought, places, sought_number
from crankwork.units import System, from_si, use_units

STEPS = 12
_FEWEST, _MOST = 1, 200
_AXES = 2
# points that are worth calculating together, and worth compiling for
_MANY, _WORTH_COMPILING = 48, 5000
_OVER = re.compile(
    r"\s*(?P<key>[^=\s]+)\s*=\s*(?P<low>[^:]+?)\s*\.\.\s*(?P<high>[^:]+?)\s*(?::\s*(?P<steps>[0-9]{1,4})\s*)?"
)
_NUMBER = re.compile(r"[+-]?[0-9.,]+(?:[eE][+-]?[0-9]+)?")
# of its size, how far a value that does not depend on a number may be off
_SAME = 1e-9


@dataclass(frozen=True)
class Map:
    """Single values over fields of a machine file, axes of arrays in the order of the fields. [SI]

    `independent`: by field the values that are the same all along it; what the file states is not among them.
    """

    title: str
    units: System
    fields: Mapping[str, Sought]
    at: Mapping[str, Places]
    values: Mapping[str, Array] = field(repr=False)
    independent: Mapping[str, Sequence[str]]
    refused: Mapping[str, int]

    @property
    def varying(self) -> list[str]:
        """The values that depend on a field."""
        return [key for key in self.values if not all(key in self.independent[one] for one in self.fields)]


def mapped(
    description: Description,
    over: Sequence[str],
    overrides: Sequence[str | Setting] = (),
    told_share: Callable[[float], None] | None = None,
    workers: int = 1,
) -> Map:
    """Return the single values of a machine over ranges of one or two numbers, `crank.speed=800..6000rpm`.

    `workers`: processes that share the points where these are many.
    """
    if not 1 <= len(over) <= _AXES:
        raise CrankworkError(Refusal("map_axes"))
    values = description.values_with(overrides)
    axes = [_axis(values, one) for one in over]
    fields = {number.key: number for number, _ in axes}
    if len(fields) < len(axes):
        raise CrankworkError(Refusal("map_twice", key=next(iter(fields))))
    at = {number.key: where for number, where in axes}
    shape = tuple(len(where.at) for where in at.values())
    every = list(np.ndindex(shape))
    designs = np.array([[where.at[one] for where, one in zip(at.values(), place, strict=True)] for place in every])
    of_points = None
    if len(every) >= _MANY:
        of_points = _together(description, fields, designs, overrides)
    if of_points is None:
        points = [[*overrides, *_settings(fields, design)] for design in designs]
        of_points = each(functools.partial(_point, description), points, workers)
    found: dict[str, Array] = {}
    given: set[str] = set()
    reasons = list[str]()
    machine: Machine | None = None
    for count, (place, point) in enumerate(zip(every, of_points, strict=True), start=1):
        if isinstance(point, str):
            reasons.append(point)
        else:
            machine = machine or description.machine([*overrides, *_settings(fields, designs[count - 1])])
            given |= point.given
            for key, value in point.summary.items():
                found.setdefault(key, np.full(shape, np.nan))[place] = value
        if told_share is not None:
            told_share(count / len(every))
    if machine is None:
        raise CrankworkError(Refusal("map_nothing", reason=reasons[0]))
    kept = {key: of for key, of in found.items() if key not in given}
    independent = {key: [one for one, of in kept.items() if _is_same(of, at)] for at, key in enumerate(fields)}
    return Map(machine.title or "", machine.units, fields, at, kept, independent, by_kind(reasons))


class _Point(NamedTuple):
    """Single values of a point, and which of them the file states."""

    summary: dict[str, float]
    given: set[str]


def _settings(fields: Mapping[str, Sought], design: Array) -> list[Setting]:
    """Return what states a point. [SI]"""
    every = zip(fields.items(), design.tolist(), strict=True)
    return [Setting("--over", key, field.written(value)) for (key, field), value in every]


def _together(
    description: Description, fields: Mapping[str, Sought], designs: Array, overrides: Sequence[str | Setting]
) -> Iterator[_Point | str] | None:
    """Return what is found at points, shape (n, fields), calculated at once; None where that cannot be. [SI]"""
    low, high = designs.min(axis=0), designs.max(axis=0)
    spans = np.stack([low, np.median(designs, axis=0), high], axis=1)
    corners = np.array(list(itertools.product(*spans[:, ::2])))
    try:
        machines = Machines(description, fields, spans, (), overrides)
    except CrankworkError:
        return None
    some = [machines.stated]
    for corner in corners:
        with contextlib.suppress(CrankworkError):
            some.append(machines.results(corner))
    machines.keys += some[0].summary
    if any(one.summary.keys() != some[0].summary.keys() for one in some):
        # what there is to be found changes with the point
        return None
    machines.compile(None, corners.T, is_for_few=len(designs) < _WORTH_COMPILING)
    if machines.reason:
        return None
    given = {key for one in some for key in one.summary if _is_given(one, key)}
    values = machines.values(designs.T)
    return (
        reason_of(values.refused[at])
        if at in values.refused
        else _Point({key: one for key, one in zip(machines.keys, of, strict=True) if np.isfinite(one)}, given)
        for at, of in enumerate(values.of.T.tolist())
    )


def _point(description: Description, settings: Sequence[str | Setting]) -> _Point | str:
    """Return what is found at a point, or why there is no machine."""
    try:
        results = analyse(description.machine(settings))
    except CrankworkError as error:
        return reason_of(error)
    return _Point(dict(results.summary), {key for key in results.summary if _is_given(results, key)})


def _axis(values: dict[str, object], text: str) -> tuple[Sought, Places]:
    """Return the number that an option names, and where it is looked at."""
    match = _OVER.fullmatch(text)
    if match is None:
        raise CrankworkError(Refusal("map_over", text=text[:60]))
    try:
        sought = sought_number(values, match["key"])
    except CrankworkError as error:
        mistake = error.args[0]
        if mistake.name != "option_key_wrong":
            raise
        option = f"--over {match['key'][:60]}"
        raise CrankworkError(Refusal("option_wrong", option=option, mistake=mistake.values["mistake"])) from None
    steps = int(match["steps"] or STEPS)
    if not _FEWEST <= steps <= _MOST:
        raise CrankworkError(Refusal("map_steps", most=str(_MOST)))
    return sought, places(sought, *ends_of(f"{match['low']}..{match['high']}"), steps)


def ends_of(text: str) -> tuple[str, str]:
    """Return both ends of a range; a unit that stands once holds for both.

    Examples
    --------
    >>> ends_of("800..6000 rpm")
    ('800 rpm', '6000 rpm')
    """
    low, _, high = (one.strip() for one in text.partition(".."))
    return (f"{low}{_NUMBER.sub('', high, count=1)}" if _NUMBER.fullmatch(low) else low), high


def _is_given(results: Results, key: str) -> bool:
    known = results.memory.get(key)
    return known is not None and isinstance(known.node, Given)


def _is_same(values: Array, axis: int) -> bool:
    """Return whether values are the same all along an axis, wherever there are any."""
    least, largest = (of(values, axis=axis) for of in (np.fmin.reduce, np.fmax.reduce))
    size = np.nanmax(np.abs(values), initial=0.0)
    return bool(np.all(~np.isfinite(least) | (largest - least <= _SAME * size)))


def map_files(found: Map) -> dict[str, bytes]:
    """Return what goes into the folder of a map."""
    data = json.dumps(map_data(found), ensure_ascii=False, indent=1)
    with use_units(found.units):
        return {"summary.json": f"{data}\n".encode(), "tables/map.csv": csv_of_sheet(_sheet(found))}


def _sheet(found: Map) -> Sheet:
    """Return every point of a map as a row."""
    grids = np.meshgrid(*(where.at for where in found.at.values()), indexing="ij")
    columns, units = {}, {}
    for (key, number_), grid in zip(found.fields.items(), grids, strict=True):
        columns[key], units[key] = np.asarray(from_si(grid.ravel(), number_.unit)), number_.unit
    for key in found.varying:
        columns[key], units[key] = displayed_column(key, found.values[key].ravel()), key_unit(key)
    return Sheet((), columns, units)


def map_data(found: Map) -> dict[str, object]:
    """Return a map as plain data, in the units of the file and the tables."""
    with use_units(found.units):
        sheet = _sheet(found)
        values = {
            key: [None if np.isnan(one) else rounded(one) for one in column.tolist()]
            for key, column in sheet.columns.items()
        }
        return {
            "title": found.title,
            "over": {key: len(where.at) for key, where in found.at.items()},
            "units": sheet.units,
            "values": values,
            "independent": {key: list(keys) for key, keys in found.independent.items()},
            "refused": [{"count": count, "reason": str(reason)} for reason, count in found.refused.items()],
        }


def map_text(found: Map, language: Language = "en") -> str:
    """Return in words how far values go and where, and which do not depend on a field."""
    with use_units(found.units):
        return "\n".join(_lines(found, language))


def _lines(found: Map, language: Language) -> Iterator[str]:
    if found.title:
        yield found.title
    for reason, count in found.refused.items():
        yield say("study.refused", language, count=str(count), reason=told(reason, language))
    yield from ("", say("study.ends", language))
    rows = [
        (label(key, language), *(_end(found, key, of, language) for of in (np.nanargmin, np.nanargmax)))
        for key in found.varying
        if not key.endswith("_angle")
    ]
    wide = [max((len(row[at]) for row in rows), default=0) for at in range(2)]
    yield from (f"  {name:<{wide[0]}}  {low:<{wide[1]}}  {high}" for name, low, high in rows)
    for key, keys in found.independent.items():
        names = ", ".join(label(one, language) for one in keys if not one.endswith("_angle"))
        yield from ("", say("study.independent", language, field=key), f"  {capital(names) if names else '-'}")


def _end(found: Map, key: str, of: Callable[[Array], np.intp], language: Language) -> str:
    """Return the least or the largest value, and where it is."""
    values = found.values[key]
    place = np.unravel_index(of(values), values.shape)
    where = (
        number(float(from_si(places.at[at], found.fields[one].unit)), language, digits=4)
        + f" {unit_name(found.fields[one].unit, language)}".rstrip()
        for (one, places), at in zip(found.at.items(), place, strict=True)
    )
    value = number(displayed(key, float(values[place])), language, digits=5)
    return f"{value} {unit_name(key_unit(key), language)}".rstrip() + f" ({', '.join(where)})"
