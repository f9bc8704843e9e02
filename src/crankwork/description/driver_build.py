"""From the table of a driver to its law, and checks of the table."""

from __future__ import annotations

import itertools
import math

from crankwork.description.schema import Values
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Law, Segment

# tables for a crank with a constant mean speed
_TURNING = ("efficiency", "motor", "motor_selection", "flywheel", "transient")
_WITHOUT_DRIVER = ("speed", "angular_acceleration")
_SUM = 1e-9


def check_driver(values: Values, reader: Reader) -> None:
    """Report tables and keys that a machine with a driver cannot have, or needs."""
    driver, crank = values["driver"], values.get("crank")
    for name in _TURNING:
        if name in values:
            reader.add_error(name, ErrorMessage("needs_turning", key=name))
    if crank is None:
        if not {"slider", "cylinder", "between"} & set(driver):
            reader.add_error("driver", ErrorMessage("driver_none"))
        return
    for name in _WITHOUT_DRIVER:
        if name in crank:
            reader.add_error(f"crank.{name}", ErrorMessage("crank_with_law", key=name))
    for name, example in (("pivot", "O"), ("pin", "A"), ("radius", "50 mm")):
        if name not in crank:
            reader.add_error(f"crank.{name}", ErrorMessage("missing", advice=(f'{name} = "{example}"',)))


def check_halves(values: Values, reader: Reader) -> None:
    """Report barrel and rod without a driving cylinder."""
    driver = values["driver"]
    for name in ("barrel", "rod"):
        if name in driver and "cylinder" not in driver and not reader.has_errors("driver.cylinder"):
            reader.add_error(f"driver.{name}", ErrorMessage("half_alone", key=name))


def check_loads(values: Values, reader: Reader) -> None:
    """Report loads over the crank angle in a machine without one."""
    for number, load in enumerate(values["loads"], start=1):
        if load and ((load["kind"] == "torque" and "at" in load) or load["against"] == "angle"):
            reader.add_error(f"loads[{number}]", ErrorMessage("load_by_angle"))


def check_gas(values: Values, reader: Reader) -> None:
    """Report gas with a pressure over the crank angle, which a driver with a law does not have."""
    for name, charge in values.get("chambers", {}).items():
        path, table = f"chambers.{name}", charge or {}
        keys = [
            key
            for key in ("measured", "cycle", "period", "delay")
            if key in table and (key, table[key]) != ("period", "360 deg")
        ]
        points = table.get("points", {}).items()
        keys += [f"points.{point}.angle" for point, placed in points if placed and "angle" in placed]
        for key in keys:
            reader.add_error(f"{path}.{key}", ErrorMessage("gas_by_angle"))
    for name, charge in values.get("charges", {}).items():
        if charge and "angle" in charge:
            reader.add_error(f"charges.{name}.angle", ErrorMessage("charge_by_angle"))


def build_law(values: Values, reader: Reader) -> Law | None:
    """Return the law of a driver, or None after complaints."""
    driver = values["driver"]
    wanted = "length" if {"slider", "cylinder"} & set(driver) else "angle"
    places = [_place(driver, "start", "driver.start", wanted, reader)]
    segments = [(number, segment) for number, segment in enumerate(driver["law"], start=1) if segment is not None]
    for number, segment in segments:
        places.append(_end(segment, number, places, wanted, reader))
        _check_kind(segment, f"driver.law[{number}]", wanted, reader)
    if reader.problems:
        return None
    if places[0] is None:
        places[0] = next((start for start in reversed(places) if start is not None), None)
    if places[0] is None:
        reader.add_error("driver.start", ErrorMessage("driver_start"))
        return None
    filled = [float(places[0])]
    for place in places[1:]:
        filled.append(filled[-1] if place is None else float(place))
    passed = (place.value for _, segment in segments for place in segment["values"])
    if "start" not in driver and all(place == filled[0] for place in itertools.chain(filled, passed)):
        reader.add_error("driver.start", ErrorMessage("law_stands"))
        return None
    if min(filled) <= 0 and "cylinder" in driver:
        reader.add_error("driver.law", ErrorMessage("cylinder_short"))
        return None
    times = _times(driver, [segment for _, segment in segments], filled, reader)
    if times is None:
        return None
    period = math.fsum(times)
    made = tuple(
        Segment(
            segment["kind"], to, time / period, segment["ramp"] or Segment.ramp,
            tuple(zip(segment["at"], (place.value for place in segment["values"]), strict=True)), _rates(segment),
        )
        for (_, segment), to, time in zip(segments, filled[1:], times, strict=True)
    )  # fmt: skip
    return Law(made, period, filled[0])


def _place(table: Values, key: str, path: str, wanted: str, reader: Reader) -> float | None:
    """Return a value of the coordinate in SI; report a wrong dimension."""
    measure: MeasuredValue | None = table[key]
    if measure is not None and measure.dimension != wanted:
        reader.add_error(path, ErrorMessage(f"driver_{wanted}"))
    return None if measure is None else measure.value


def _end(segment: Values, number: int, before: list[float | None], wanted: str, reader: Reader) -> float | None:
    """Return the end of a segment, None for its start."""
    path = f"driver.law[{number}]"
    if segment["kind"] == "dwell":
        return before[-1]
    if "to" not in segment:
        reader.add_error(f"{path}.to", ErrorMessage("law_to", example="0.5 m" if wanted == "length" else "90 deg"))
    return _place(segment, "to", f"{path}.to", wanted, reader)


def _rates(segment: Values) -> tuple[float | None, float | None]:
    """Return the rates at both ends of a segment, None where they follow from the points of a table."""
    usual = None if segment["ends"] == "natural" else 0.0
    start, end = (segment.si(f"{end}_speed") for end in ("start", "end"))
    return usual if start is None else start, usual if end is None else end


def _check_kind(segment: Values, path: str, wanted: str, reader: Reader) -> None:
    """Report a rate of a wrong dimension, and an invalid table."""
    for key in ("speed", "start_speed", "end_speed"):
        if key in segment and segment[key].dimension != ("velocity" if wanted == "length" else "speed"):
            reader.add_error(f"{path}.{key}", ErrorMessage(f"driver_speed_{wanted}"))
    if segment["kind"] == "table":
        _check_table(segment, path, wanted, reader)


def _check_table(segment: Values, path: str, wanted: str, reader: Reader) -> None:
    """Report a table that does not rise, or with columns of different lengths."""
    times, values = segment["at"], segment["values"]
    if len(times) != len(values) or not times:
        reader.add_error(f"{path}.at", ErrorMessage("law_table"))
    elif None not in times and any(b <= a for a, b in itertools.pairwise([0.0, *times, 1.0])):
        reader.add_error(f"{path}.at", ErrorMessage("law_table_rises"))
    for number, value in enumerate(values, start=1):
        if value is not None and value.dimension != wanted:
            reader.add_error(f"{path}.values[{number}]", ErrorMessage(f"driver_{wanted}"))


def _times(driver: Values, segments: list[Values], places: list[float], reader: Reader) -> list[float] | None:
    """Return the time of each segment. [s]"""
    period = driver.si("period")
    times, shares = [], []
    for number, (segment, (low, high)) in enumerate(zip(segments, itertools.pairwise(places), strict=True), start=1):
        if "speed" in segment:
            times.append(abs(high - low) / segment["speed"].value)
            if not times[-1]:
                reader.add_error(f"driver.law[{number}].speed", ErrorMessage("law_still"))
                return None
        elif isinstance(segment["over"], MeasuredValue):
            times.append(segment["over"].value)
        elif period is None:
            reader.add_error(f"driver.law[{number}].over", ErrorMessage("law_period"))
            return None
        else:
            times.append(segment["over"] * period)
            shares.append(segment["over"])
    if period is not None and abs(math.fsum(times) - period) > _SUM * period:
        text = ErrorMessage(
            "law_shares" if shares else "law_times", whole=f"{math.fsum(times):.6g}", period=f"{period:.6g}"
        )
        reader.add_error("driver.period", text)
        return None
    return times
