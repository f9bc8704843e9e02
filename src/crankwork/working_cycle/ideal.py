"""Ideal cycles: Otto, Diesel and dual, of 1 kg of a gas with constant heats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from crankwork.steps import Worked
from crankwork.working_cycle import ideal_formulas as formulas
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners
from crankwork.working_cycle.fuels import CycleError

IdealKind = Literal["otto", "ideal-diesel", "dual"]


@dataclass(frozen=True)
class IdealData:
    """Data of an ideal cycle; how hot it becomes is said once.

    Parameters
    ----------
    kind : {"otto", "ideal-diesel", "dual"}
        Heat at constant volume, at constant pressure, or first the one and then the other.
    compression_ratio : float
        Largest over smallest volume. [-]
    pressure, temperature : float
        Absolute state at the start of compression. [Pa], [K]
    heat, peak_temperature : float or None
        Heat added to 1 kg of gas, or the highest temperature. [J/kg], [K]
    pressure_ratio : float or None
        Rise of pressure at constant volume: needed by a dual cycle, one of the ways to say how hot an Otto cycle
        becomes. [-]
    cut_off : float or None
        Rise of volume at constant pressure: one of the ways to say how hot the other two become. [-]
    adiabatic_exponent, gas_constant : float
        Ratio of specific heats, gas constant. [-], [J/(kg K)]
    angle : {720, 360}
        Crank angle of the cycle. [deg]
    """

    kind: IdealKind
    compression_ratio: float
    pressure: float
    temperature: float
    heat: float | None = None
    peak_temperature: float | None = None
    pressure_ratio: float | None = None
    cut_off: float | None = None
    adiabatic_exponent: float = 1.4
    gas_constant: float = 287.0
    angle: float = 720.0


class _Heated(NamedTuple):
    """Highest pressure [Pa] and temperature [K], that before constant pressure [K], pressure and cut-off ratio [-]."""

    pressure: float
    hottest: float
    between: float
    ratio: float
    cut_off: float


def ideal_cycle(data: IdealData) -> CalculatedCycle:
    """Return an ideal cycle, every value a worked step.

    Parameters
    ----------
    data : IdealData
        What is known.

    Returns
    -------
    CalculatedCycle
        States `state_pressure.1`, `state_temperature.1` and so on, heats, work, efficiency both as work over heat
        and in closed form (`thermal_efficiency.closed`), mean pressure.

    Raises
    ------
    CycleError
        If no cycle follows from the data.

    References
    ----------
    cengel_boles_2015, ch. 9; kolchin_demidov_2008, ch. 2.
    """
    _check(data)
    worked = Worked()
    ratio, exponent = data.compression_ratio, data.adiabatic_exponent
    capacity = worked(formulas.isochoric_heat, data.gas_constant, exponent)
    cold = worked(formulas.compressed_temperature, data.temperature, ratio, exponent, key="state_temperature.2")
    pressure = worked(formulas.compressed_pressure, data.pressure, ratio, exponent, key="state_pressure.2")
    heated = _HEATINGS[data.kind](worked, data, cold, pressure, capacity)
    if not (heated.hottest > cold and heated.ratio >= 1 and 1 <= heated.cut_off < ratio):
        raise CycleError(
            f"the heat leads from {cold:g} K after compression to {heated.hottest:g} K with a pressure ratio of "
            f"{heated.ratio:g} and a cut-off ratio of {heated.cut_off:g}; heat must raise the temperature, and the "
            f"cut-off lie between 1 and the compression ratio {ratio:g}"
        )
    last = _results(worked, data, heated, cold, capacity)
    corners = Corners(
        data.pressure, data.pressure, pressure, heated.pressure, last, heated.cut_off, exponent, exponent, ratio
    )
    hottest = "4" if data.kind == "dual" else "3"
    values = {
        "compression_ratio": ratio,
        "state_pressure.1": data.pressure,
        "state_temperature.1": data.temperature,
        f"state_pressure.{hottest}": heated.pressure,
        f"state_temperature.{hottest}": heated.hottest,
        "gas_heat_ratio": exponent,
        "specific_gas_constant": data.gas_constant,
        "pressure_rise_ratio": heated.ratio,
        "cut_off": heated.cut_off,
    } | ({"heat_added": data.heat} if data.heat else {})
    return CalculatedCycle(data.kind, data.angle, corners, tuple(worked.steps), values | worked.values)


def _otto(worked: Worked, data: IdealData, cold: float, pressure: float, capacity: float) -> _Heated:
    hot = data.peak_temperature
    if data.heat is not None:
        hot = worked(formulas.isochorically_heated, cold, data.heat, capacity, key="state_temperature.3")
    if data.pressure_ratio is not None:
        ratio = data.pressure_ratio
        hot = worked(formulas.raised_temperature, ratio, cold, key="state_temperature.3")
    elif hot is not None:
        ratio = worked(formulas.pressure_ratio_of_heat, hot, cold)
    else:
        raise CycleError("an Otto cycle needs heat, peak_temperature or pressure_ratio")
    highest = worked(formulas.raised_pressure, ratio, pressure, key="state_pressure.3")
    return _Heated(highest, hot, hot, ratio, 1.0)


def _diesel(worked: Worked, data: IdealData, cold: float, pressure: float, capacity: float) -> _Heated:
    hot, exponent = data.peak_temperature, data.adiabatic_exponent
    if data.heat is not None:
        hot = worked(formulas.isobarically_heated, cold, data.heat, exponent, capacity, key="state_temperature.3")
    if data.cut_off is not None:
        cut = data.cut_off
        hot = worked(formulas.cut_off_temperature, cut, cold, key="state_temperature.3")
    elif hot is not None:
        cut = worked(formulas.diesel_cut_off, hot, cold)
    else:
        raise CycleError("a Diesel cycle needs heat, peak_temperature or cut_off")
    return _Heated(pressure, hot, cold, 1.0, cut)


def _dual(worked: Worked, data: IdealData, cold: float, pressure: float, capacity: float) -> _Heated:
    if data.pressure_ratio is None:
        raise CycleError("a dual cycle needs pressure_ratio, and heat, peak_temperature or cut_off")
    ratio, hot, exponent = data.pressure_ratio, data.peak_temperature, data.adiabatic_exponent
    between = worked(formulas.raised_temperature, ratio, cold, key="state_temperature.3")
    highest = worked(formulas.raised_pressure, ratio, pressure, key="state_pressure.3")
    if data.heat is not None:
        numbers = (between, data.heat, capacity, cold, exponent)
        hot = worked(formulas.dually_heated, *numbers, key="state_temperature.4")
    if data.cut_off is not None:
        cut = data.cut_off
        hot = worked(formulas.dual_cut_off_temperature, cut, between, key="state_temperature.4")
    elif hot is not None:
        cut = worked(formulas.dual_cut_off, hot, between)
    else:
        raise CycleError("a dual cycle needs heat, peak_temperature or cut_off besides pressure_ratio")
    return _Heated(highest, hot, between, ratio, cut)


_HEATINGS = {"otto": _otto, "ideal-diesel": _diesel, "dual": _dual}


def _results(worked: Worked, data: IdealData, heated: _Heated, cold: float, capacity: float) -> float:
    """Work expansion, heats, work, efficiency and mean pressure; return the pressure after expansion. [Pa]"""
    ratio, exponent, dual = data.compression_ratio, data.adiabatic_exponent, data.kind == "dual"
    point = "5" if dual else "4"
    last = worked(
        formulas.dual_expanded_temperature if dual else formulas.expanded_temperature,
        heated.hottest, heated.cut_off, ratio, exponent, key=f"state_temperature.{point}",
    )  # fmt: skip
    pressure = worked(
        formulas.expanded_pressure,
        heated.pressure, heated.cut_off, ratio, exponent, key=f"state_pressure.{point}",
    )  # fmt: skip
    added = data.heat
    if added is None and data.kind == "otto":
        added = worked(formulas.isochoric_heat_added, capacity, heated.hottest, cold)
    elif added is None and data.kind == "ideal-diesel":
        added = worked(formulas.isobaric_heat_added, exponent, capacity, heated.hottest, cold)
    elif added is None:
        added = worked(formulas.dual_heat_added, capacity, heated.between, cold, exponent, heated.hottest)
    rejected = worked(formulas.dual_heat_rejected if dual else formulas.heat_rejected, capacity, last, data.temperature)
    work = worked(formulas.ideal_work, added, rejected)
    worked(formulas.thermal_efficiency, work, added)
    closed = "thermal_efficiency.closed"
    if data.kind == "otto":
        worked(formulas.otto_efficiency, ratio, exponent, key=closed)
    else:
        worked(formulas.dual_efficiency, ratio, exponent, heated.ratio, heated.cut_off, key=closed)
    worked(formulas.ideal_mean_pressure, work, data.pressure, ratio, data.gas_constant, data.temperature)
    return pressure


def _check(data: IdealData) -> None:
    """Raise unless the data are those of one cycle."""
    if data.kind not in _HEATINGS:
        raise CycleError(f'kind is "{data.kind}"; write one of {", ".join(_HEATINGS)}')
    for name in ("pressure", "temperature", "gas_constant"):
        if not getattr(data, name) > 0:
            raise CycleError(f"{name} is {getattr(data, name):g}; it must be above 0")
    for name in ("compression_ratio", "adiabatic_exponent"):
        if not getattr(data, name) > 1:
            raise CycleError(f"{name} is {getattr(data, name):g}; it must be above 1")
    ways = [data.heat, data.peak_temperature]
    ways += [] if data.kind == "dual" else [data.pressure_ratio]
    ways += [data.cut_off]
    if sum(way is not None for way in ways) > 1:
        raise CycleError("say once how hot the cycle becomes: by heat, by peak temperature, or by one ratio")
    if (data.kind == "otto" and data.cut_off) or (data.kind == "ideal-diesel" and data.pressure_ratio):
        raise CycleError(f"a cycle of kind {data.kind} has no " + ("cut_off" if data.cut_off else "pressure_ratio"))
