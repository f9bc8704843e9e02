"""Single values that nothing names beforehand: a column at a crank angle or time, and the extremes of any column."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from crankwork.analysis.mechanism import singular_ends
from crankwork.analysis.motion_range import find_singular_columns
from crankwork.analysis.results import Results
from crankwork.errors import CrankworkError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import ProcedureValue, TracedValue
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.quantities.key import Key, key_of
from crankwork.units import parse_in

_EXTREMES = ("_max", "_min", "_max_angle", "_min_angle")


def with_requested(results: Results, keys: Iterable[str]) -> Results:
    """Return results that also have the single values that keys ask of columns.

    `crank_torque@33deg` is a column at a crank angle, or at a time, `slider_position.C@0.2s`, of a machine in time;
    `joint_force_max.A` with `_max_angle`, `_min` and `_min_angle` are the extremes of a column that has no such value.
    A key that asks nothing of a column is left out; a place that this machine does not have is an error.
    """
    added: dict[str, TracedValue] = {}
    for key in keys:
        if key in results or key in added:
            continue
        if "@" in key:
            added[key] = _at_place(results, key)
        elif column := _column_of(results, key):
            added |= _extremes(results, column)
    if not added:
        return results
    values = {key: known.value for key, known in added.items()}
    return replace(results, summary={**results.summary, **values}, trace={**results.trace, **added})


def place_of(text: str, *, is_time: bool) -> float:
    """Return a crank angle [deg] or a time [s] after an @."""
    try:
        value = parse_in(text, "s" if is_time else "deg")
    except ValueError as error:
        raise CrankworkError(ErrorMessage("option_wrong", option=f"@{text}", mistake=error.args[0])) from None
    return value if is_time else round(math.degrees(value), 9)


def _at_place(results: Results, key: str) -> TracedValue:
    """Return a column at the place that a key names."""
    column, _, text = key.rpartition("@")
    place = place_of(text, is_time=bool(results.period))
    value, known = results.value(column, place), results.holding(column).trace.get(column)
    if known is None or not known.varies:
        name = "place_meaningless" if known is None or column in results.summary else "value_untraced"
        raise CrankworkError(ErrorMessage(name, key=column))
    return TracedValue(ProcedureValue(value, "at", (known,), results.degrees_of(place)), key)


def _column_of(results: Results, key: str) -> str:
    """Return the key of the column whose extreme a key names, or an empty text."""
    quantity, owner = key_of(key)
    for ending in _EXTREMES:
        column = str(Key(quantity.removesuffix(ending), owner))
        known = results.holding(column).trace.get(column) if quantity.endswith(ending) else None
        if known is not None and known.varies:
            return column
    return ""


def _extremes(results: Results, column: str) -> dict[str, TracedValue]:
    """Return the extremes of a column with their crank angles; none of a column that grows beyond all bounds."""
    start, end = 0.0, results.machine.cycle
    columns = {column: results.holding(column).trace[column]}
    is_partial = "crank_range" in results.summary
    if is_partial:
        start, end = (math.degrees(results.summary[f"crank_range_{word}"]) for word in ("start", "end"))
    ends = singular_ends(results.machine, (start, end) if is_partial else None)
    if any(find_singular_columns(columns, *ends, end - start)):
        return {}
    return CycleInterpolant(columns, CrankGrid.from_degrees, end - start, start).extremes(column)
