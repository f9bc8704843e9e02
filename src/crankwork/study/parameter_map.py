"""Maps: results of a machine over one or two numbers of its file."""

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
from crankwork.analysis.requested_values import with_requested
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import Input
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage, Language, capital, in_language, translate
from crankwork.locale.numbers import aligned
from crankwork.machine import Machine
from crankwork.report.display import displayed_column, key_unit, label, rounded
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.study.chunks import by_kind
from crankwork.study.roots import reason_of
from crankwork.study.runner import each
from crankwork.study.study_text import value_text, with_unit
from crankwork.study.variants import MachineVariants
from crankwork.study.varied_field import SearchPoints, search_points
from crankwork.units import System, from_si, use_units

STEPS = 12
_MIN_STEPS, _MAX_STEPS = 1, 200
_AXES = 2
# number of points from which they are calculated together, and compiled
_MANY, _WORTH_COMPILING = 48, 5000
_OVER = re.compile(
    r"\s*(?P<key>[^=\s]+)\s*=\s*(?P<low>[^:]+?)\s*\.\.\s*(?P<high>[^:]+?)\s*(?::\s*(?P<steps>[0-9]{1,4})\s*)?"
)
_NUMBER = re.compile(r"[+-]?[0-9.,]+(?:[eE][+-]?[0-9]+)?")
# relative difference of a value that does not depend on a number
_SAME = 1e-9


@dataclass(frozen=True)
class Map:
    """Single values over fields of a machine file, axes of arrays in the order of the fields. [SI]

    `independent`: by field, the values that do not depend on it; values stated in the file are left out.
    """

    title: str
    units: System
    fields: Mapping[str, NumericField]
    points: Mapping[str, SearchPoints]
    values: Mapping[str, Array] = field(repr=False)
    independent: Mapping[str, Sequence[str]]
    refused: Mapping[str, int]

    @property
    def varying(self) -> list[str]:
        """Values that depend on a field."""
        return [key for key in self.values if not all(key in self.independent[name] for name in self.fields)]


def mapped(
    description: Description,
    over: Sequence[str],
    overrides: Sequence[str | Setting] = (),
    progress: Callable[[float], None] | None = None,
    workers: int = 1,
    *,
    keys: Sequence[str] = (),
) -> Map:
    """Return the single values of a machine over ranges of one or two numbers, `crank.speed=800..6000rpm`.

    `keys`: which values, those of the summary by default; `workers`: processes for many points.
    """
    if not 1 <= len(over) <= _AXES:
        raise CrankworkError(ErrorMessage("map_axes"))
    values = description.values_with(overrides)
    axes = [_axis(values, text) for text in over]
    fields = {number.key: number for number, _ in axes}
    if len(fields) < len(axes):
        raise CrankworkError(ErrorMessage("map_twice", key=next(iter(fields))))
    positions = {number.key: where for number, where in axes}
    grids = np.meshgrid(*(where.values for where in positions.values()), indexing="ij")
    designs = np.stack([grid.ravel() for grid in grids], axis=1)
    shape = grids[0].shape
    indices = list(np.ndindex(shape))
    of_points = None
    if len(indices) >= _MANY:
        of_points = _together(description, fields, designs, overrides, keys)
    if of_points is None:
        points = [[*overrides, *_settings(fields, design)] for design in designs]
        of_points = each(functools.partial(_point, description, keys), points, workers)
    columns: dict[str, Array] = {}
    given: set[str] = set()
    reasons = list[str]()
    machine: Machine | None = None
    for count, (place, point) in enumerate(zip(indices, of_points, strict=True), start=1):
        if isinstance(point, str):
            reasons.append(point)
        else:
            machine = machine or description.machine([*overrides, *_settings(fields, designs[count - 1])])
            given |= point.given
            for key, value in point.summary.items():
                columns.setdefault(key, np.full(shape, np.nan))[place] = value
        if progress is not None:
            progress(count / len(indices))
    if machine is None:
        raise CrankworkError(ErrorMessage("map_nothing", reason=reasons[0]))
    kept = {key: column for key, column in columns.items() if key not in given}
    independent = {
        key: [name for name, column in kept.items() if _is_same(column, axis)] for axis, key in enumerate(fields)
    }
    return Map(machine.title or "", machine.units, fields, positions, kept, independent, by_kind(reasons))


class _Point(NamedTuple):
    """Single values of a point, and the keys of those stated in the file."""

    summary: dict[str, float]
    given: set[str]


def _settings(fields: Mapping[str, NumericField], design: Array) -> list[Setting]:
    """Return the settings of a point. [SI]"""
    return [field.setting(value, "--over") for field, value in zip(fields.values(), design.tolist(), strict=True)]


def _together(
    description: Description,
    fields: Mapping[str, NumericField],
    designs: Array,
    overrides: Sequence[str | Setting],
    keys: Sequence[str],
) -> Iterator[_Point | str] | None:
    """Return the results at points, shape (n, fields), calculated together; None if that is not possible. [SI]"""
    low, high = designs.min(axis=0), designs.max(axis=0)
    spans = np.stack([low, np.median(designs, axis=0), high], axis=1)
    corners = np.array(list(itertools.product(*spans[:, ::2])))
    try:
        machines = MachineVariants(description, fields, spans, keys, overrides)
    except CrankworkError:
        return None
    samples = [machines.stated]
    for corner in corners:
        with contextlib.suppress(CrankworkError):
            samples.append(machines.results(corner))
    if not keys:
        machines.keys += samples[0].summary
    if not keys and any(sample.summary.keys() != samples[0].summary.keys() for sample in samples):
        # the keys of results differ between points
        return None
    machines.compile(None, corners.T, is_for_few=len(designs) < _WORTH_COMPILING)
    if machines.reason:
        return None
    given = {key for sample in samples for key in sample.summary if _is_given(sample, key)}
    values = machines.values(designs.T)
    return (
        reason_of(values.refused[index])
        if index in values.refused
        else _Point({key: value for key, value in zip(machines.keys, column, strict=True) if np.isfinite(value)}, given)
        for index, column in enumerate(values.values.T.tolist())
    )


def _point(description: Description, keys: Sequence[str], settings: Sequence[str | Setting]) -> _Point | str:
    """Return the results at a point, or the reason why there is no machine."""
    try:
        results = with_requested(analyse(description.machine(settings)), keys)
        values = {key: results.value(key) for key in keys} if keys else dict(results.summary)
    except CrankworkError as error:
        return reason_of(error)
    return _Point(values, {key for key in values if _is_given(results, key)})


def _axis(values: dict[str, object], text: str) -> tuple[NumericField, SearchPoints]:
    """Return the number that an option names, and its points."""
    match = _OVER.fullmatch(text)
    if match is None:
        raise CrankworkError(ErrorMessage("map_over", text=text[:60]))
    variable = numeric_field(values, match["key"], "--over")
    steps = int(match["steps"] or STEPS)
    if not _MIN_STEPS <= steps <= _MAX_STEPS:
        raise CrankworkError(ErrorMessage("map_steps", most=str(_MAX_STEPS)))
    options = (f"--over {variable.key}",) * 2
    return variable, search_points(variable, *ends_of(f"{match['low']}..{match['high']}"), steps, options=options)


def ends_of(text: str) -> tuple[str, str]:
    """Return both ends of a range; one unit applies to both.

    Examples
    --------
    >>> ends_of("800..6000 rpm")
    ('800 rpm', '6000 rpm')
    """
    low, _, high = (part.strip() for part in text.partition(".."))
    return (f"{low}{_NUMBER.sub('', high, count=1)}" if _NUMBER.fullmatch(low) else low), high


def _is_given(results: Results, key: str) -> bool:
    known = results.trace.get(key)
    return known is not None and isinstance(known.node, Input)


def _is_same(values: Array, axis: int) -> bool:
    """Return whether values are equal along an axis, apart from points without a value."""
    least, largest = (reduce(values, axis=axis) for reduce in (np.fmin.reduce, np.fmax.reduce))
    size = np.nanmax(np.abs(values), initial=0.0)
    return bool(np.all(~np.isfinite(least) | (largest - least <= _SAME * size)))


def map_files(parameter_map: Map) -> dict[str, bytes]:
    """Return the files of a map's folder."""
    data = json.dumps(map_data(parameter_map), ensure_ascii=False, indent=1)
    with use_units(parameter_map.units):
        return {"summary.json": f"{data}\n".encode(), "tables/map.csv": csv_of_sheet(_sheet(parameter_map))}


def _sheet(parameter_map: Map) -> Sheet:
    """Return every point of a map as a row."""
    grids = np.meshgrid(*(where.values for where in parameter_map.points.values()), indexing="ij")
    columns, units = {}, {}
    for (key, number_), grid in zip(parameter_map.fields.items(), grids, strict=True):
        columns[key], units[key] = np.asarray(from_si(grid.ravel(), number_.unit)), number_.unit
    for key in parameter_map.varying:
        columns[key], units[key] = displayed_column(key, parameter_map.values[key].ravel()), key_unit(key)
    return Sheet((), columns, units)


def map_data(parameter_map: Map) -> dict[str, object]:
    """Return a map as plain data, in the units of the file and the tables."""
    with use_units(parameter_map.units):
        sheet = _sheet(parameter_map)
        values = {
            key: [None if np.isnan(value) else rounded(value) for value in column.tolist()]
            for key, column in sheet.columns.items()
        }
        return {
            "title": parameter_map.title,
            "over": {key: len(where.values) for key, where in parameter_map.points.items()},
            "units": sheet.units,
            "values": values,
            "independent": {key: list(keys) for key, keys in parameter_map.independent.items()},
            "refused": [{"count": count, "reason": str(reason)} for reason, count in parameter_map.refused.items()],
        }


def map_text(parameter_map: Map, language: Language = "en") -> str:
    """Return as text the extremes of values with their positions, and the values independent of a field."""
    with use_units(parameter_map.units):
        return "\n".join(_lines(parameter_map, language))


def _lines(parameter_map: Map, language: Language) -> Iterator[str]:
    if parameter_map.title:
        yield parameter_map.title
    for reason, count in parameter_map.refused.items():
        yield translate("study.refused", language, count=str(count), reason=in_language(reason, language))
    yield from ("", translate("study.ends", language))
    rows = [
        (label(key, language), *(_end(parameter_map, key, locate, language) for locate in (np.nanargmin, np.nanargmax)))
        for key in parameter_map.varying
        if not key.endswith("_angle")
    ]
    yield from aligned(rows)
    for key, keys in parameter_map.independent.items():
        names = ", ".join(label(name, language) for name in keys if not name.endswith("_angle"))
        yield from ("", translate("study.independent", language, field=key), f"  {capital(names) if names else '-'}")


def _end(parameter_map: Map, key: str, locate: Callable[[Array], np.intp], language: Language) -> str:
    """Return the least or the largest value with its position as text."""
    values = parameter_map.values[key]
    place = np.unravel_index(locate(values), values.shape)
    where = []
    for (name, axis), index in zip(parameter_map.points.items(), place, strict=True):
        unit = parameter_map.fields[name].unit
        where.append(with_unit(float(from_si(axis.values[index], unit)), unit, language, 4))
    return f"{value_text(key, float(values[place]), language, 5)} ({', '.join(where)})"
