"""From the table of a working cycle to the calculated pressure, and the size of an engine from its power."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Literal, NamedTuple, cast

import numpy as np

from crankwork.description.kinds import MeasuredValue, Reader
from crankwork.description.schema import Values
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


class Cycle(NamedTuple):
    """The gas of a calculated cycle, and the values of the machine file with the calculated sizes."""

    gas: Gas
    values: Values


def build_cycle(values: Values, reader: Reader, pi: float) -> Cycle | None:
    """Return the gas of a calculated cycle, or None after complaints."""
    table = values["cycle"]
    if "kind" not in table:
        return None
    ratio = values["cylinder"]["compression_ratio"]
    if ratio is None:
        if not reader.doubts("cylinder.compression_ratio", "cylinder.clearance_volume"):
            reader.complain("cylinder.compression_ratio", Refusal("cycle_ratio"))
        return None
    if reader.doubts("cycle", "crank.speed") or "speed" not in values["crank"]:
        return None
    try:
        return _built(values, table, float(ratio), pi)
    except CrankworkError as error:
        reader.complain(_blamed(error.args[0], table), error.args[0])
        return None


def _blamed(message: str, table: Values) -> str:
    """Return the key at the beginning of a message, or the table."""
    word = message.split(maxsplit=1)[0].rstrip(",:") if message else ""
    return f"cycle.{word}" if word in table else "cycle"


def _built(values: Values, table: Values, ratio: float, pi: float) -> Cycle:
    kind = table["kind"]
    angle = float(table["cycle"].split()[0])
    timing = _timing(table["timing"], angle)
    ambient = table.si("ambient_pressure")
    pressure: CalculatedPressure
    if kind == "wiebe":
        bore, speed = values["cylinder"].si("bore"), values["crank"]["speed"].value
        pressure = HeatReleasePressure(heat_release_data(table, angle, bore, speed))
    else:
        if kind in _IDEAL:
            state = {"pressure": table.si("intake_pressure"), "temperature": table.si("intake_temperature")}
            cycle = ideal_cycle(table.made(IdealData, compression_ratio=ratio, **state, angle=angle))
        else:
            cycle = grinevetsky(_data(values, table, ratio, angle, timing, pi))
            values = _sized(values, cycle) if "power" in table else values
        if "geometric_compression_ratio" in cycle.memory:
            geometric = cycle.memory["geometric_compression_ratio"].value
            values = values.but(cylinder=values["cylinder"].but(compression_ratio=geometric))
        rounds = (table["corners"] or ("rounded" if "timing" in table else "sharp")) == "rounded"
        pressure = CornerPressure(cycle, timing if rounds else None, _rounding(table))
    return Cycle(Gas(cycle=angle, is_absolute=True, ambient=ambient, names_ambient=True, calculated=pressure), values)


def _timing(table: Values, angle: float) -> Timing:
    events = ("ignition_delay", "intake_opens", "intake_closes", "exhaust_opens", "exhaust_closes")
    degrees = {name: table.degrees(name) or 0.0 for name in events}
    return Timing(ignition_advance=table.degrees("ignition") or 0.0, cycle=angle, **degrees)


def _rounding(table: Values) -> Rounding:
    school = cast("Literal['ru', 'vi']", table["school"])
    return Rounding(school=school, peak_angle=table["timing"].degrees("peak"), peak_level=table["peak_level"])


def _data(values: Values, table: Values, ratio: float, angle: float, timing: Timing, pi: float) -> GrinevetskyData:
    """Return the data of a calculation by Grinevetsky and Mazing."""
    size: dict[str, Any] = {}
    if "power" in table:
        size["rounds_size"] = True
    else:
        bore, stroke = values["cylinder"].si("bore"), _stroke_of_piston(values)
        size |= {"bore": bore, "stroke": stroke} if bore and stroke else {}
    loss, lost = table["mechanical_loss"], table["lost_stroke"]
    if lost is None:
        lost = _lost_stroke(values, timing) if angle == 360 else 0.0
    return table.made(
        GrinevetskyData,
        compression_ratio=ratio,
        rotational_speed=values["crank"]["speed"].value * 30 / math.pi,
        fuel=_fuel(table["fuel"]),
        strokes=4 if angle == 720 else 2,
        cylinders=int(values["engine"]["cylinders"] or 1),
        mechanical_loss=None if not loss or None in loss else (loss[0] * 1e6, loss[1] * 1e6),
        lost_stroke=lost,
        pi=pi,
        **size,
    )


def _stroke(crank: Values) -> float | None:
    stroke: float | None = 2 * crank.si("radius") if "radius" in crank else crank.si("stroke")
    return stroke


def _stroke_of_piston(values: Values) -> float | None:
    """Return the stroke, longer than twice the crank radius where the cylinder axis passes the shaft."""
    stroke, lengths = _stroke(values["crank"]), _rod_of(values)
    offsets = values["engine"]["offsets"] or [values["cylinder"]["offset"]]
    offset = 0.0 if offsets[0] is None else float(offsets[0].value)
    if stroke is None or not offset or not turns_fully(lengths := lengths._replace(offset=offset)):
        return stroke
    return float(lengths.stroke)


def _rod_of(values: Values) -> SliderCrank:
    """Return crank and rod without offset, of radius 1 if only their ratio is given."""
    rod, stroke = values["rod"], _stroke(values["crank"])
    radius, ratio = (stroke or 2.0) / 2, rod["ratio"] or 0.25
    if "length" in rod and stroke:
        return SliderCrank(radius, float(rod["length"].value))
    return SliderCrank(radius, radius * ratio if rod["ratio_definition"] == "l/r" else radius / ratio)


def _fuel(given: object) -> Fuel | None:
    """Return a fuel by name or by its composition."""
    if given is None:
        return None
    if isinstance(given, str):
        if given not in FUELS:
            raise CrankworkError(Refusal("fuel_unknown", fuel=given, known=tuple(FUELS)))
        return FUELS[given]
    table = cast("Values", given)
    parts = [table[key] or 0.0 for key in ("carbon", "hydrogen", "oxygen")]
    if abs(sum(parts) - 1) > 0.01:
        raise CrankworkError(Refusal("fuel_parts", sum=sum(parts)))
    return Fuel(parts[0], parts[1], parts[2], table["molar_mass"], table.si("heating_value"))


def _lost_stroke(values: Values, timing: Timing) -> float:
    """Return the share of the stroke after the last port has shut, from the ratio of rod and crank."""
    closes, lengths = max(timing.intake_closes, timing.exhaust_closes), _rod_of(values)
    if not closes or not turns_fully(lengths):
        return 0.0
    bottom = dead_centres(lengths)[1]
    x = piston_motion(lengths, CrankGrid.from_degrees(np.array([bottom + closes]))).piston.position[0]
    return 1 - float(x) / float(lengths.stroke)


def _sized(values: Values, cycle: CalculatedCycle) -> Values:
    """Return the values with the bore and stroke required for a power, in whole millimetres."""
    crank, cylinder = values["crank"], values["cylinder"]
    radius = crank["radius"] or MeasuredValue(round(cycle.values["stroke"], 3) / 2, "length")
    bore = cylinder["bore"] or MeasuredValue(round(cycle.values["bore"], 3), "length")
    return values.but(crank=crank.but(radius=radius), cylinder=cylinder.but(bore=bore))


def build_heat_release(
    table: Values, angle: float, bore: float | None, speed: float, chamber: str, reader: Reader
) -> HeatReleasePressure | None:
    """Return the pressure of a chamber by a release of heat, or None after complaints.

    `angle`: of its cycle [deg]; `speed`: of the crank [rad/s]; `chamber`: where the description has it.
    """
    try:
        return HeatReleasePressure(replace(heat_release_data(table, angle, bore, speed), chamber=chamber))
    except CrankworkError as error:
        reader.complain(f"{chamber}.cycle", error.args[0])
        return None


def heat_release_data(table: Values, angle: float, bore: float | None, speed: float) -> HeatReleaseData:
    """Return the data of a release of heat, with defaults for missing values."""
    timing = table["timing"]
    given: dict[str, Any] = {
        "heat": table.si("cycle_heat"),
        "fuel_per_cycle": table.si("fuel_mass"),
        "heating_value": table.si("heating_value"),
        "burning_efficiency": table["burning_efficiency"],
        "burning_shape": table["shape"],
        "heat_ratio": table["adiabatic_exponent"],
        "has_wall_loss": "wall_temperature" in table,
        "wall_temperature": table.si("wall_temperature"),
        "exhaust_pressure": table.si("residual_pressure"),
        "intake_pressure": table.si("intake_pressure"),
    }
    angles = {
        "burning_advance": (table, "combustion_start"),
        "burning_duration": (table, "combustion_duration"),
        "intake_opens": (timing, "intake_opens"),
        "intake_closes": (timing, "intake_closes"),
        "exhaust_opens": (timing, "exhaust_opens"),
        "exhaust_closes": (timing, "exhaust_closes"),
    }
    given |= {name: place.degrees(key) for name, (place, key) in angles.items()}
    of_fuel = [key for key in ("fuel_mass", "heating_value", "burning_efficiency") if key in table]
    if given["heat"] is not None and of_fuel:
        raise CrankworkError(Refusal("cycle_heat_twice", names=", ".join(of_fuel)))
    if given["heat"] is None and not {"fuel_mass", "heating_value"} <= set(of_fuel):
        raise CrankworkError(Refusal("cycle_heat_missing"))
    if bore is None:
        raise CrankworkError(Refusal("cycle_bore_missing"))
    return HeatReleaseData(
        bore=bore,
        rotational_speed=speed * 30 / math.pi,
        shut_pressure=table.si("intake_pressure"),
        shut_temperature=table.si("intake_temperature"),
        cycle=angle,
        **{name: value for name, value in given.items() if value is not None},
    )
