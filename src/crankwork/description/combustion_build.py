"""From the values of a machine file to what the analysis of combustion is told."""

from __future__ import annotations

import math

from crankwork.description.schema import Values, no_effect_message
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.locale import ErrorMessage
from crankwork.working_cycle.burning_analysis import BurningAnalysis


def build_combustion(values: Values, reader: Reader, *, is_absolute: bool) -> BurningAnalysis | None:
    """Return what the analysis of combustion is told, None without it or after complaints."""
    stated, path = values.get("combustion"), "gas.combustion"
    if stated is None or not {"from", "to"} <= set(stated):
        return None
    if not is_absolute:
        reader.add_error(path, no_effect_message("pressures", "gauge", ("absolute",)))
    start, end, cycle = stated.degrees("from"), stated.degrees("to"), float(values["cycle"].split()[0])
    windows = [_pair(window) for window in stated["windows"] if window and None not in window]
    burning = _pair(stated["burning"]) if stated["burning"] and None not in stated["burning"] else None
    for key, first, last, low, high in (
        ("to", start, end, 0.0, cycle),
        *(("burning", *pair, start, end) for pair in ([burning] if burning else [])),
        *((f"windows[{number}]", *window, 0.0, cycle) for number, window in enumerate(windows, start=1)),
    ):
        if not low <= first < last <= high:
            reader.add_error(f"{path}.{key}", ErrorMessage("angles_between", low=f"{low:g}", high=f"{high:g}"))
    return BurningAnalysis(
        start,
        end,
        stated["adiabatic_exponent"],
        stated["exponent_slope"],
        stated.si("temperature"),
        stated.si("wall_temperature"),
        burning=burning,
        windows=tuple(windows),
    )


def _pair(angles: list[MeasuredValue]) -> tuple[float, float]:
    """Return two angles. [deg]"""
    first, last = (round(math.degrees(angle.value), 9) for angle in angles)
    return first, last
