"""From the table of a driver to its law, with what is wrong in it."""

from __future__ import annotations

import itertools
import math

from crankwork.description.kinds import Measure, Reader
from crankwork.description.schema import Values
from crankwork.locale import Refusal
from crankwork.mechanism.driver import Law, Segment

# what presumes a crank that turns evenly
_TURNING = ("efficiency", "motor", "flywheel", "transient")
_WITHOUT_DRIVER = ("speed", "angular_acceleration")
_SUM = 1e-9


def check_driver(values: Values, reader: Reader) -> None:
    """Complain of what a machine with a driver cannot have, or lacks."""
    driver, crank = values["driver"], values.get("crank")
    for name in _TURNING:
        if name in values:
            reader.complain(name, Refusal("needs_turning", key=name))
    if crank is None:
        if not {"slider", "cylinder", "between"} & set(driver):
            reader.complain("driver", Refusal("driver_none"))
        return
    for name in _WITHOUT_DRIVER:
        if name in crank:
            reader.complain(f"crank.{name}", Refusal("crank_with_law", key=name))
    for name, example in (("pivot", "O"), ("pin", "A"), ("radius", "50 mm")):
        if name not in crank:
            reader.complain(f"crank.{name}", Refusal("missing", advice=(f'{name} = "{example}"',)))


def check_halves(values: Values, reader: Reader) -> None:
    """Complain of barrel and rod where no cylinder drives."""
    driver = values["driver"]
    for name in ("barrel", "rod"):
        if name in driver and "cylinder" not in driver and not reader.doubts("driver.cylinder"):
            reader.complain(f"driver.{name}", Refusal("half_alone", key=name))


def check_loads(values: Values, reader: Reader) -> None:
    """Complain of loads that count by a crank angle which nothing has."""
    for number, load in enumerate(values["loads"], start=1):
        if load and ((load["kind"] == "torque" and "at" in load) or load["against"] == "angle"):
            reader.complain(f"loads[{number}]", Refusal("load_by_angle"))


def check_gas(values: Values, reader: Reader) -> None:
    """Complain of gas whose pressure counts by the crank angle, which a driver with a law has not."""
    for name, one in values.get("chambers", {}).items():
        path, table = f"chambers.{name}", one or {}
        keys = [
            key
            for key in ("measured", "cycle", "period", "delay")
            if key in table and (key, table[key]) != ("period", "360 deg")
        ]
        points = table.get("points", {}).items()
        keys += [f"points.{point}.angle" for point, placed in points if placed and "angle" in placed]
        for key in keys:
            reader.complain(f"{path}.{key}", Refusal("gas_by_angle"))
    for name, one in values.get("charges", {}).items():
        if one and "angle" in one:
            reader.complain(f"charges.{name}.angle", Refusal("charge_by_angle"))


def build_law(values: Values, reader: Reader) -> Law | None:
    """Return the law of a driver, or None after complaints."""
    driver = values["driver"]
    wanted = "length" if {"slider", "cylinder"} & set(driver) else "angle"
    places = [_place(driver, "start", "driver.start", wanted, reader)]
    segments = [(number, one) for number, one in enumerate(driver["law"], start=1) if one is not None]
    for number, one in segments:
        places.append(_end(one, number, places, wanted, reader))
        _check_kind(one, f"driver.law[{number}]", wanted, reader)
    if reader.problems:
        return None
    if places[0] is None:
        places[0] = next((one for one in reversed(places) if one is not None), None)
    if places[0] is None:
        reader.complain("driver.start", Refusal("driver_start"))
        return None
    filled = [float(places[0])]
    for place in places[1:]:
        filled.append(filled[-1] if place is None else float(place))
    if "start" not in driver and not _moves([one for _, one in segments], filled):
        reader.complain("driver.start", Refusal("law_stands"))
        return None
    if min(filled) <= 0 and "cylinder" in driver:
        reader.complain("driver.law", Refusal("cylinder_short"))
        return None
    times = _times(driver, [one for _, one in segments], filled, reader)
    if times is None:
        return None
    period = math.fsum(times)
    made = tuple(
        Segment(
            one["kind"], to, time / period, one["ramp"] or Segment.ramp,
            tuple(zip(one["at"], (place.value for place in one["values"]), strict=True)),
        )
        for (_, one), to, time in zip(segments, filled[1:], times, strict=True)
    )  # fmt: skip
    return Law(made, period, filled[0])


def _moves(segments: list[Values], places: list[float]) -> bool:
    """Return whether any segment ends or passes elsewhere than where the law begins."""
    passed = (place.value for one in segments for place in one["values"])
    return any(place != places[0] for place in itertools.chain(places, passed))


def _place(table: Values, key: str, path: str, wanted: str, reader: Reader) -> float | None:
    """Return a value of the coordinate in SI; complain where it is an angle and should be a length."""
    one: Measure | None = table[key]
    if one is not None and one.dimension != wanted:
        reader.complain(path, Refusal(f"driver_{wanted}"))
    return None if one is None else one.value


def _end(one: Values, number: int, before: list[float | None], wanted: str, reader: Reader) -> float | None:
    """Return where a segment ends, None for where it began."""
    path = f"driver.law[{number}]"
    if one["kind"] == "dwell":
        return before[-1]
    if "to" not in one:
        reader.complain(f"{path}.to", Refusal("law_to", example="0.5 m" if wanted == "length" else "90 deg"))
    return _place(one, "to", f"{path}.to", wanted, reader)


def _check_kind(one: Values, path: str, wanted: str, reader: Reader) -> None:
    """Complain of a rate that is none of the coordinate, and of a table that is none."""
    if "speed" in one and one["speed"].dimension != ("velocity" if wanted == "length" else "speed"):
        reader.complain(f"{path}.speed", Refusal(f"driver_speed_{wanted}"))
    if one["kind"] == "table":
        _check_table(one, path, wanted, reader)


def _check_table(one: Values, path: str, wanted: str, reader: Reader) -> None:
    """Complain of a table that does not rise, or whose columns do not match."""
    at, values = one["at"], one["values"]
    if len(at) != len(values) or not at:
        reader.complain(f"{path}.at", Refusal("law_table"))
    elif None not in at and any(b <= a for a, b in itertools.pairwise([0.0, *at, 1.0])):
        reader.complain(f"{path}.at", Refusal("law_table_rises"))
    for number, value in enumerate(values, start=1):
        if value is not None and value.dimension != wanted:
            reader.complain(f"{path}.values[{number}]", Refusal(f"driver_{wanted}"))


def _times(driver: Values, segments: list[Values], places: list[float], reader: Reader) -> list[float] | None:
    """Return the time of each segment. [s]"""
    period = driver.si("period")
    times, shares = [], []
    for number, (one, (low, high)) in enumerate(zip(segments, itertools.pairwise(places), strict=True), start=1):
        if "speed" in one:
            times.append(abs(high - low) / one["speed"].value)
            if not times[-1]:
                reader.complain(f"driver.law[{number}].speed", Refusal("law_still"))
                return None
        elif isinstance(one["over"], Measure):
            times.append(one["over"].value)
        elif period is None:
            reader.complain(f"driver.law[{number}].over", Refusal("law_period"))
            return None
        else:
            times.append(one["over"] * period)
            shares.append(one["over"])
    if period is not None and abs(math.fsum(times) - period) > _SUM * period:
        told = Refusal("law_shares" if shares else "law_times", whole=f"{math.fsum(times):.6g}", period=f"{period:.6g}")
        reader.complain("driver.period", told)
        return None
    return times
