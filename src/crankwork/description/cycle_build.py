"""From the table of a working cycle to what gives the pressure, and the size of an engine to a power."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Literal, NamedTuple, cast

import numpy as np

from crankwork.description.schema import Measure, Reader
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.extremes import dead_centres
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank, turns_fully
from crankwork.locale import Refusal
from crankwork.machine import Gas
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, CalculatedPressure
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import FUELS, Fuel
from crankwork.working_cycle.grinevetsky import grinevetsky
from crankwork.working_cycle.heat_data import HeatReleaseData
from crankwork.working_cycle.ideal import IdealData, ideal_cycle
from crankwork.working_cycle.pressures import CornerPressure, HeatReleasePressure
from crankwork.working_cycle.rounding import Rounding, Timing

_IDEAL = ("otto", "ideal-diesel", "dual")
_CORNERS = {"corners", "school", "timing", "filling", "peak_level"}
_COMMON = {"kind", "cycle", "source", "ambient_pressure", "motored"}
_OF_REAL = {
    "fuel", "excess_air", "ambient_temperature", "charge_pressure", "charge_temperature", "intake_pressure",
    "intake_loss_factor", "intake_speed",
    "residual_pressure", "residual_temperature", "heating", "charge_up", "scavenging", "compression_exponent",
    "expansion_exponent", "heat_use", "pressure_ratio", "mechanical_loss", "heat_capacities", "power",
    "stroke_bore_ratio", "lost_stroke",
}  # fmt: skip
_OF_IDEAL = {
    "intake_pressure", "intake_temperature", "heat", "peak_temperature", "pressure_ratio", "cut_off",
    "adiabatic_exponent",
}  # fmt: skip
_OF_WIEBE = {
    "intake_pressure", "intake_temperature", "residual_pressure", "combustion_start", "combustion_duration", "shape",
    "cycle_heat", "fuel_mass", "heating_value", "burning_efficiency", "wall_temperature", "adiabatic_exponent",
    "timing",
}  # fmt: skip
_KEYS = (
    {"petrol": _COMMON | _OF_REAL - {"pressure_ratio"} | _CORNERS, "diesel": _COMMON | _OF_REAL | _CORNERS}
    | dict.fromkeys(_IDEAL, _COMMON | _OF_IDEAL | _CORNERS)
    | {"wiebe": _COMMON | _OF_WIEBE}
)
_NAMES = {"ambient_pressure": 0.1e6, "ambient_temperature": 293.0}


class Cycle(NamedTuple):
    """The gas of a calculated cycle, and the machine file's values with what followed from it."""

    gas: Gas
    values: Mapping[str, Any]


def build_cycle(values: Mapping[str, Any], reader: Reader, pi: float) -> Cycle | None:
    """Return the gas of a calculated cycle, or None after complaints."""
    table = values.get("cycle", {})
    kind = table.get("kind")
    if kind is None:
        return None
    for key in sorted(set(table) - _KEYS[kind]):
        reader.complain(f"cycle.{key}", Refusal("cycle_key", kind=kind))
    ratio = values.get("cylinder", {}).get("compression_ratio")
    if ratio is None:
        if not reader.doubts("cylinder.compression_ratio", "cylinder.clearance_volume"):
            reader.complain("cylinder.compression_ratio", Refusal("cycle_ratio"))
        return None
    if reader.doubts("cycle", "crank.speed") or "speed" not in values.get("crank", {}):
        return None
    try:
        return _built(values, table, float(ratio), pi)
    except CrankworkError as error:
        reader.complain(_blamed(error.args[0], table), error.args[0])
        return None


def _blamed(message: str, table: Mapping[str, Any]) -> str:
    """Return the key that a message begins with, or the table."""
    word = message.split(maxsplit=1)[0].rstrip(",:") if message else ""
    return f"cycle.{word}" if word in table else "cycle"


def _built(values: Mapping[str, Any], table: Mapping[str, Any], ratio: float, pi: float) -> Cycle:
    kind = table["kind"]
    angle = float(table.get("cycle", "720 deg").split()[0])
    timing = _timing(table.get("timing", {}), angle)
    ambient = _si(table, "ambient_pressure") or 0.1e6
    pressure: CalculatedPressure
    if kind == "wiebe":
        pressure = HeatReleasePressure(_heat_release(values, table, angle))
    else:
        if kind in _IDEAL:
            cycle = ideal_cycle(_ideal(table, ratio, angle))
        else:
            cycle = grinevetsky(_data(values, table, ratio, angle, timing, pi))
            values = _sized(values, cycle) if "power" in table else values
        if "geometric_compression_ratio" in cycle.memory:
            values = _with_ratio(values, cycle.memory["geometric_compression_ratio"].value)
        rounds = table.get("corners", "rounded" if "timing" in table else "sharp") == "rounded"
        pressure = CornerPressure(cycle, timing if rounds else None, _rounding(table))
    gas = Gas(cycle=angle, is_absolute=True, ambient=ambient, names_ambient=True, calculated=pressure)
    return Cycle(gas, values)


def _si(table: Mapping[str, Any], key: str) -> float | None:
    measure = table.get(key)
    return None if measure is None else float(measure.value)


def _degrees(table: Mapping[str, Any], key: str, default: float = 0.0) -> float:
    value = _si(table, key)
    return default if value is None else round(math.degrees(value), 9)


def _timing(table: Mapping[str, Any], angle: float) -> Timing:
    return Timing(
        ignition_advance=_degrees(table, "ignition"),
        ignition_delay=_degrees(table, "ignition_delay"),
        intake_opens=_degrees(table, "intake_opens"),
        intake_closes=_degrees(table, "intake_closes"),
        exhaust_opens=_degrees(table, "exhaust_opens"),
        exhaust_closes=_degrees(table, "exhaust_closes"),
        cycle=angle,
    )


def _rounding(table: Mapping[str, Any]) -> Rounding:
    peak = _degrees(table.get("timing", {}), "peak", Rounding().peak_angle)
    school = cast("Literal['ru', 'vi']", table.get("school", "ru"))
    return Rounding(school=school, peak_angle=peak, peak_level=table.get("peak_level"))


def _ideal(table: Mapping[str, Any], ratio: float, angle: float) -> IdealData:
    return IdealData(
        kind=table["kind"],
        compression_ratio=ratio,
        pressure=_si(table, "intake_pressure") or 0.1e6,
        temperature=_si(table, "intake_temperature") or 300.0,
        heat=_si(table, "heat"),
        peak_temperature=_si(table, "peak_temperature"),
        pressure_ratio=table.get("pressure_ratio"),
        cut_off=table.get("cut_off"),
        adiabatic_exponent=table.get("adiabatic_exponent", 1.4),
        angle=angle,
    )


def _data(
    values: Mapping[str, Any], table: Mapping[str, Any], ratio: float, angle: float, timing: Timing, pi: float
) -> GrinevetskyData:
    """Return the data of a calculation by Grinevetsky and Mazing."""
    known = {one.name for one in fields(GrinevetskyData)}
    plain = {key: one for key, one in table.items() if key in known and isinstance(one, float)}
    measured = {key: float(one.value) for key, one in table.items() if key in known and isinstance(one, Measure)}
    size: dict[str, Any] = {}
    if "power" in table:
        size["rounds_size"] = True
    else:
        bore, stroke = _si(values.get("cylinder", {}), "bore"), _stroke_of_piston(values)
        size |= {"bore": bore, "stroke": stroke} if bore and stroke else {}
    loss = table.get("mechanical_loss")
    lost = table.get("lost_stroke", _lost_stroke(values, timing) if angle == 360 else 0.0)
    return GrinevetskyData(**(_NAMES | plain | measured | size | {
        "kind": table["kind"],
        "compression_ratio": ratio,
        "rotational_speed": values["crank"]["speed"].value * 30 / math.pi,
        "fuel": _fuel(table.get("fuel")),
        "heat_capacities": table.get("heat_capacities", "kolchin"),
        "strokes": 4 if angle == 720 else 2,
        "cylinders": int(values.get("engine", {}).get("cylinders", 1)),
        "mechanical_loss": None if loss is None or None in loss else (loss[0] * 1e6, loss[1] * 1e6),
        "lost_stroke": lost,
        "pi": pi,
    }))  # fmt: skip


def _stroke(crank: Mapping[str, Any]) -> float | None:
    if "radius" in crank:
        return 2 * float(crank["radius"].value)
    return _si(crank, "stroke")


def _stroke_of_piston(values: Mapping[str, Any]) -> float | None:
    """Return the stroke, longer than twice the crank radius where the cylinder axis passes the shaft."""
    stroke, lengths = _stroke(values.get("crank", {})), _rod_of(values)
    offsets = values.get("engine", {}).get("offsets") or [values.get("cylinder", {}).get("offset")]
    offset = 0.0 if offsets[0] is None else float(offsets[0].value)
    if stroke is None or not offset or not turns_fully(lengths := lengths._replace(offset=offset)):
        return stroke
    return float(lengths.stroke)


def _rod_of(values: Mapping[str, Any]) -> SliderCrank:
    """Return crank and rod on the axis; a radius of one where only their ratio is given."""
    rod, stroke = values.get("rod", {}), _stroke(values.get("crank", {}))
    radius, ratio = (stroke or 2.0) / 2, rod.get("ratio", 0.25)
    if "length" in rod and stroke:
        return SliderCrank(radius, float(rod["length"].value))
    return SliderCrank(radius, radius * ratio if rod.get("ratio_definition") == "l/r" else radius / ratio)


def _fuel(given: object) -> Fuel | None:
    """Return a fuel by name or by its composition."""
    if given is None:
        return None
    if isinstance(given, str):
        if given not in FUELS:
            raise CrankworkError(Refusal("fuel_unknown", fuel=given, known=tuple(FUELS)))
        return FUELS[given]
    table = cast("Mapping[str, Any]", given)
    parts = [table.get(key, 0.0) for key in ("carbon", "hydrogen", "oxygen")]
    if abs(sum(parts) - 1) > 0.01:
        raise CrankworkError(Refusal("fuel_parts", sum=sum(parts)))
    return Fuel(parts[0], parts[1], parts[2], table.get("molar_mass"), _si(table, "heating_value"))


def _lost_stroke(values: Mapping[str, Any], timing: Timing) -> float:
    """Return the share of the stroke after the last port has shut, from the ratio of rod and crank."""
    closes, lengths = max(timing.intake_closes, timing.exhaust_closes), _rod_of(values)
    if not closes or not turns_fully(lengths):
        return 0.0
    bottom = dead_centres(lengths)[1]
    x = piston_motion(lengths, CrankGrid.from_degrees(np.array([bottom + closes]))).piston.position[0]
    return 1 - float(x) / float(lengths.stroke)


def _sized(values: Mapping[str, Any], cycle: CalculatedCycle) -> dict[str, Any]:
    """Return the values with the bore and stroke that a power asks for, in whole millimetres."""
    crank = {key: one for key, one in values["crank"].items() if key != "stroke"}
    radius = crank.get("radius") or Measure(round(cycle.values["stroke"], 3) / 2, "length")
    cylinder = values.get("cylinder", {})
    bore = cylinder.get("bore") or Measure(round(cycle.values["bore"], 3), "length")
    return {**values, "crank": {**crank, "radius": radius}, "cylinder": {**cylinder, "bore": bore}}


def _with_ratio(values: Mapping[str, Any], ratio: float) -> dict[str, Any]:
    return {**values, "cylinder": {**values["cylinder"], "compression_ratio": ratio}}


def _heat_release(values: Mapping[str, Any], table: Mapping[str, Any], angle: float) -> HeatReleaseData:
    """Return the data of a release of heat; what is not given stays as usual."""
    timing = table.get("timing", {})
    given: dict[str, Any] = {
        "heat": _si(table, "cycle_heat"),
        "fuel_per_cycle": _si(table, "fuel_mass"),
        "heating_value": _si(table, "heating_value"),
        "burning_efficiency": table.get("burning_efficiency"),
        "burning_shape": table.get("shape"),
        "heat_ratio": table.get("adiabatic_exponent"),
        "has_wall_loss": "wall_temperature" in table,
        "wall_temperature": _si(table, "wall_temperature"),
        "exhaust_pressure": _si(table, "residual_pressure"),
        "intake_pressure": _si(table, "intake_pressure"),
    }
    angles = {
        "burning_advance": (table, "combustion_start"),
        "burning_duration": (table, "combustion_duration"),
        "intake_opens": (timing, "intake_opens"),
        "intake_closes": (timing, "intake_closes"),
        "exhaust_opens": (timing, "exhaust_opens"),
        "exhaust_closes": (timing, "exhaust_closes"),
    }
    given |= {name: _degrees(place, key) for name, (place, key) in angles.items() if key in place}
    of_fuel = [key for key in ("fuel_mass", "heating_value", "burning_efficiency") if key in table]
    if given["heat"] is not None and of_fuel:
        raise CrankworkError(Refusal("cycle_heat_twice", names=", ".join(of_fuel)))
    if given["heat"] is None and not {"fuel_mass", "heating_value"} <= set(of_fuel):
        raise CrankworkError(Refusal("cycle_heat_missing"))
    bore = _si(values.get("cylinder", {}), "bore")
    if bore is None:
        raise CrankworkError(Refusal("cycle_bore_missing"))
    return HeatReleaseData(
        bore=bore,
        rotational_speed=values["crank"]["speed"].value * 30 / math.pi,
        shut_pressure=_si(table, "intake_pressure") or 0.09e6,
        shut_temperature=_si(table, "intake_temperature") or 340.0,
        cycle=angle,
        **{name: one for name, one in given.items() if one is not None},
    )
