"""Automatic valves: the diagram of a compressor or pump between two pressures, and its delivery."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import Piecewise, TracedValue, absent, given
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import piston_area
from crankwork.loads.indicator import (
    DeadCentres,
    DiagramError,
    DiagramPoint,
    IndicatorDiagram,
    Piece,
    VolumeAt,
    solve_diagram,
)
from crankwork.locale import ErrorMessage
from crankwork.quantities.key import key_of

_TURN = 360.0
_TEXT = "eastop_mcconkey_1993, ch. 12"


@formula("expanded_volume", _TEXT)
def expanded_volume(V_c: Value, p_dis: Value, p_suc: Value, n_2: Value) -> Value:
    """Volume to which the gas left in the clearance expands before the suction valve opens."""
    return V_c * np.power(p_dis / p_suc, 1 / n_2)


@formula("induced_volume", _TEXT)
def induced_volume(V_d: Value, V_c: Value, V_exp: Value) -> Value:
    """Volume drawn in during a cycle, at the state of the suction."""
    return V_d + V_c - V_exp


@formula("clearance_volumetric_efficiency", _TEXT)
def drawn_share(V_in: Value, V_d: Value) -> Value:
    """Volume drawn in over swept volume."""
    return V_in / V_d


@formula("inlet_flow", _TEXT)
def inlet_flow(V_in: Value, w: Value, phi_c: Value) -> Value:
    """Volume drawn in per unit of time."""
    return V_in * w / phi_c


@formula("free_air_delivery", _TEXT)
def free_air_delivery(Q_in: Value, p_suc: Value, T_suc: Value, p_free: Value, T_free: Value) -> Value:
    """Flow at the state of free air."""
    return Q_in * p_suc / p_free * (T_free / T_suc)


@formula("gas_mass_flow", _TEXT)
def mass_flow(p_suc: Value, Q_in: Value, R_gas: Value, T_suc: Value) -> Value:
    """Mass drawn in per unit of time."""
    return p_suc * Q_in / (R_gas * T_suc)


@formula("discharge_temperature", _TEXT)
def discharge_temperature(T_suc: Value, p_dis: Value, p_suc: Value, n_1: Value) -> Value:
    """Temperature at the end of compression."""
    return T_suc * np.power(p_dis / p_suc, (n_1 - 1) / n_1)


@formula("polytropic_exponent", _TEXT)
def exponent_of_temperatures(p_dis: Value, p_suc: Value, T_dis: Value, T_suc: Value) -> Value:
    """Exponent of the polytrope between two pressures and temperatures."""
    return np.log(p_dis / p_suc) / (np.log(p_dis / p_suc) - np.log(T_dis / T_suc))


@formula("isothermal_power", _TEXT)
def isothermal_power(p_suc: Value, Q_in: Value, p_dis: Value) -> Value:
    """Least power that compresses the gas drawn in: at constant temperature."""
    return p_suc * Q_in * np.log(p_dis / p_suc)


@formula("isothermal_efficiency", _TEXT)
def isothermal_efficiency(P_iso: Value, P_ind: Value) -> Value:
    """Isothermal power over the indicated power that the gas takes up."""
    return -P_iso / P_ind


@formula("discharge_coefficient", "subramanya_2005, ch. 16")
def discharge_coefficient(Q_del: Value, Q_in: Value) -> Value:
    """Measured flow over that of the valves and the stroke."""
    return Q_del / Q_in


@formula("pump_slip", "subramanya_2005, ch. 16")
def pump_slip(C_dis: Value) -> Value:
    """Share of the flow that is lost."""
    return 1 - C_dis


@formula("suction_pressure", "subramanya_2005, ch. 16")
def suction_of_height(p_0: Value, rho_liq: Value, g: Value, h_suc: Value) -> Value:
    """Pressure that is left where liquid is drawn up from a surface below the pump."""
    return p_0 - rho_liq * g * h_suc


@formula("discharge_pressure", "subramanya_2005, ch. 16")
def discharge_of_height(p_0: Value, rho_liq: Value, g: Value, h_dis: Value) -> Value:
    """Pressure behind a pump below the outlet of its pipe."""
    return p_0 + rho_liq * g * h_dis


@formula("pressure_head", "subramanya_2005, ch. 16")
def pressure_head(p_top: Value, rho_liq: Value, g: Value) -> Value:
    """Height of liquid that has a pressure."""
    return p_top / (rho_liq * g)


@formula("separation_speed", "subramanya_2005, ch. 16")
def separation_speed(w: Value, p_marg: Value, p_acc: Value) -> Value:
    """Speed at which the liquid in a pipe separates at the dead centre, where its friction is zero.

    Notes
    -----
    The pressure that speeds up the liquid grows with the square of the speed.
    """
    return w * np.sqrt(p_marg / p_acc)


@formula("acceleration_pressure", "subramanya_2005, ch. 16")
def acceleration_pressure(  # noqa: PLR0913 - one argument per symbol
    rho_liq: Value, l_pipe: Value, A_pipe: Value, V_rate_2: Value, w: Value, V_rate: Value, eps: Value
) -> Value:
    """Pressure that speeds up the liquid in a pipe as the volume of its chamber asks for."""
    return rho_liq * l_pipe / A_pipe * (V_rate_2 * w**2 + V_rate * eps)


@formula("friction_pressure", "subramanya_2005, ch. 16")
def friction_pressure(  # noqa: PLR0913 - one argument per symbol
    f_pipe: Value, l_pipe: Value, d_pipe: Value, rho_liq: Value, V_rate: Value, w: Value, A_pipe: Value
) -> Value:
    """Pressure that the friction of a pipe takes, by Darcy and Weisbach."""
    return f_pipe * l_pipe / d_pipe * (rho_liq / 2) * (V_rate * w / A_pipe) ** 2


@dataclass(frozen=True)
class Pipe:
    """A pipe full of liquid between a vessel and the valve of a chamber; friction after Darcy. [m], [-]"""

    length: float
    diameter: float
    friction: float = 0.0


@dataclass(frozen=True)
class Valves:
    """Opening pressures of valves, and the fluid that passes. [Pa], [K], [J/(kg K)], [m3/s], [kg/m3]

    A gas has an exponent of compression or a discharge temperature, a liquid has neither.
    """

    suction: float
    discharge: float
    compression_exponent: float | None = None
    expansion_exponent: float | None = None  # By default that of the compression
    temperature: float | None = None  # Of suction
    discharge_temperature: float | None = None
    gas_constant: float | None = None
    free_pressure: float | None = None
    free_temperature: float | None = None
    delivered: float | None = None  # As measured, at the state of the suction
    density: float | None = None  # Of a liquid
    suction_pipe: Pipe | None = None
    discharge_pipe: Pipe | None = None
    vapour_pressure: float | None = None
    linked: Mapping[str, TracedValue] = field(default_factory=dict)  # Numbers of a stage, by field

    @property
    def has_pipes(self) -> bool:
        """Whether the liquid in pipes changes the pressure."""
        return self.suction_pipe is not None or self.discharge_pipe is not None

    @property
    def exponents(self) -> tuple[float, float] | None:
        """Exponents of compression and expansion, of a gas."""
        exponent = self.compression_exponent
        if self.discharge_temperature is not None and self.temperature is not None:
            exponent = float(
                exponent_of_temperatures(self.discharge, self.suction, self.discharge_temperature, self.temperature)
            )
        return None if exponent is None else (exponent, self.expansion_exponent or exponent)

    def diagram(self, *, has_clearance: bool) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...]]:
        """Return points and laws of the cycle from the least volume: expansion, suction, compression, discharge."""
        exponents, low, high = self.exponents, self.suction, self.discharge
        points = {
            "d": DiagramPoint(stroke=0.0, pressure=high),
            "e": DiagramPoint(pressure=low),
            "a": DiagramPoint(stroke=1.0),
            "c": DiagramPoint(pressure=high),
            "f": DiagramPoint(stroke=0.0),
        }
        pieces = (
            Piece("polytropic", ("d", "e"), exponents and exponents[1]),
            Piece("constant", ("e", "a")),
            Piece("polytropic", ("a", "c"), exponents and exponents[0]),
            Piece("constant", ("c", "f")),
        )
        if exponents is not None and has_clearance:
            return points, pieces
        # without clearance the pressure falls at once where the piston turns back
        points = {**points, "d": DiagramPoint(stroke=0.0, pressure=low), "f": DiagramPoint(stroke=0.0, pressure=low)}
        del points["e"]
        drawn = Piece("constant", ("d", "a"))
        if exponents is not None:
            return points, (drawn, *pieces[2:])
        return {**points, "c": DiagramPoint(stroke=1.0, pressure=high)}, (drawn, pieces[3])


class Flow(NamedTuple):
    """Derivatives of a volume by the driver's coordinate, speed and acceleration of that coordinate, and pi."""

    rate: TracedValue
    rate_2: TracedValue
    speed: TracedValue
    change: TracedValue
    pi: float


@dataclass(frozen=True)
class StatedValves:
    """Valves with their path in the description; `own`: suffix of their keys, such as `.head`, or empty."""

    valves: Valves
    path: str
    own: str = ""

    def _given(self, key: str, name: str) -> TracedValue:
        value = getattr(self.valves, name)
        if name in self.valves.linked:
            return self.valves.linked[name].named(f"{key}{self.own}")
        return absent(key) if value is None else given(f"{key}{self.own}", value, f"{self.path}.{name}")

    @property
    def pressures(self) -> tuple[TracedValue, TracedValue]:
        """Pressures of suction and discharge. [Pa]"""
        return self._given("suction_pressure", "suction"), self._given("discharge_pressure", "discharge")

    def at_points(self, points: Mapping[str, DiagramPoint]) -> dict[str, TracedValue]:
        """Return the pressures of points with a stated pressure."""
        low, high = self.pressures
        return {
            name: high if point.pressure == self.valves.discharge else low
            for name, point in points.items()
            if point.pressure is not None
        }

    @property
    def temperature(self) -> TracedValue:
        """Temperature of suction. [K]"""
        return self._given("suction_temperature", "temperature")

    @property
    def exponents(self) -> tuple[TracedValue, TracedValue] | None:
        """Exponents of compression and expansion, of a gas."""
        if self.valves.exponents is None:
            return None
        low, high = self.pressures
        if self.valves.discharge_temperature is None:
            compression = self._given("compression_exponent", "compression_exponent")
        else:
            after = self._given("discharge_temperature", "discharge_temperature")
            compression = exponent_of_temperatures(high, low, after, self.temperature)
            compression = compression.named(f"polytropic_exponent{self.own}")
        expansion = self._given("expansion_exponent", "expansion_exponent")
        return compression, compression if expansion.is_absent else expansion

    def check(self, clearance: float, swept: float) -> None:
        """Raise if the clearance is so large that the discharge pressure is never reached. [m3]"""
        exponents = self.valves.exponents
        if exponents is None or not clearance:
            return
        most = self.valves.suction * min((1 + swept / clearance) ** exponent for exponent in exponents)
        if self.valves.discharge >= most:
            raise DiagramError(f"{self.path}.discharge", ErrorMessage("valves_closed", most=most / 1e6))

    def solved(
        self,
        points: Mapping[str, DiagramPoint],
        pieces: tuple[Piece, ...],
        volume_at: VolumeAt,
        centres: DeadCentres,
        clearance: str,
    ) -> IndicatorDiagram:
        """Return the diagram of a turn; its pieces are in no file, so that `clearance`, a path, is blamed for them."""
        try:
            diagram = solve_diagram(points, pieces, _TURN, volume_at, dead_centres=centres)
        except DiagramError as error:
            raise DiagramError(clearance, error.args[0]) from None
        return self.traced(diagram)

    def traced(self, diagram: IndicatorDiagram) -> IndicatorDiagram:
        """Return the diagram with traced pressures and exponents as operands of its laws."""
        exponents, (low, high) = self.exponents, self.pressures
        compression, expansion = exponents or (None, None)
        laws: dict[str, dict[str, tuple[TracedValue | None, ...]]] = {
            "polytropic": {"d": (high, expansion), "a": (low, compression)},
            "constant": {"d": (low,), "e": (low,), "c": (high,)},
        }
        operands = [
            [known for known in laws[segment.law][segment.origin] if known is not None] for segment in diagram.segments
        ]
        segments = tuple(
            replace(segment, operands=tuple(values)) for segment, values in zip(diagram.segments, operands, strict=True)
        )
        return replace(diagram, segments=segments, jumps=())

    def through_pipes(self, pressure: TracedValue, diagram: IndicatorDiagram, flow: Flow) -> TracedValue:
        """Return the pressure in the chamber; `pressure`: outside its pipes, `diagram`: its strokes."""
        laws = tuple(self._pipe_pressure(segment.origin == "d", flow) for segment in diagram.segments)
        taken = Piecewise([segment.end for segment in diagram.segments], laws, diagram.breaks.tolist())
        return (pressure - TracedValue(taken, f"pipe_pressure{self.own}")).named(pressure.key)

    def _pipe_pressure(self, is_suction: bool, flow: Flow) -> TracedValue:  # noqa: FBT001 - which of two strokes
        """Return the pressure loss in a pipe, zero without a pipe."""
        parts = self._pipe_parts("suction_pipe" if is_suction else "discharge_pipe", flow)
        if not parts:
            return absent("")
        pressure, lost = parts[0], parts[1] if len(parts) > 1 else None
        if lost is None:
            return pressure
        return pressure + lost if is_suction else pressure - lost

    def _pipe_parts(self, name: str, flow: Flow) -> tuple[TracedValue, ...]:
        """Return the pressures that speed up the liquid in a pipe and that its friction takes."""
        pipe = getattr(self.valves, name)
        if pipe is None:
            return ()
        own, path = f"{self.own}.{name.partition('_')[0]}", f"{self.path}.{name}"
        density = self._given("liquid_density", "density")
        length = given(f"pipe_length{own}", pipe.length, f"{path}.length")
        diameter = given(f"pipe_diameter{own}", pipe.diameter, f"{path}.diameter")
        area = piston_area(flow.pi, diameter).named(f"pipe_area{own}")
        pressure: TracedValue = acceleration_pressure(
            density, length, area, flow.rate_2, flow.speed, flow.rate, flow.change
        )
        pressure = pressure.named(f"acceleration_pressure{own}")
        if not pipe.friction:
            return (pressure,)
        factor = given(f"pipe_friction{own}", pipe.friction, f"{path}.friction")
        lost: TracedValue = friction_pressure(factor, length, diameter, density, flow.rate, flow.speed, area)
        return pressure, lost.named(f"friction_pressure{own}")

    def heads(self, flow: Flow, period: float) -> Iterator[TracedValue]:
        """Yield the largest heads in pipes and the speeds of separation, of a pump whose heights are stated."""
        if "gravity" not in self.valves.linked:
            return
        density, gravity = self._given("liquid_density", "density"), self.valves.linked["gravity"]
        boiling = self._given("vapour_pressure", "vapour_pressure")
        for name, outside in zip(("suction_pipe", "discharge_pipe"), self.pressures, strict=True):
            parts, own = self._pipe_parts(name, flow), f"{self.own}.{name.partition('_')[0]}"
            over = CycleInterpolant({part.key: part for part in parts}, CrankGrid.from_degrees, period)
            for kind, part in zip(("acceleration_head", "friction_head"), parts, strict=False):
                largest = over.extremes(part.key)[key_of(part.key).derived("_max")]
                yield pressure_head(largest, density, gravity).named(f"{kind}{own}")
                if kind == "acceleration_head" and not boiling.is_absent and outside.value > boiling.value:
                    margin = (outside - boiling).named(f"separation_margin{own}")
                    yield separation_speed(flow.speed, margin, largest).named(f"separation_speed{own}")

    def delivery(
        self,
        clearance: TracedValue,
        swept: TracedValue,
        power: TracedValue,
        per_time: Callable[[TracedValue], TracedValue],
    ) -> dict[str, TracedValue]:
        """Return the delivery of the valves by key; `per_time`: from a volume of a cycle to a flow."""
        values = self.drawn(clearance, swept)
        return values | self.passed(per_time(values[f"induced_volume{self.own}"]), power)

    def drawn(self, clearance: TracedValue, swept: TracedValue) -> dict[str, TracedValue]:
        """Return the volume drawn in during a cycle, and the expanded clearance volume, by key."""
        own, exponents, (low, high) = self.own, self.exponents, self.pressures
        volume, volumes = swept.named(f"induced_volume{own}"), list[TracedValue]()
        if exponents is not None and not clearance.is_absent:
            left = expanded_volume(clearance, high, low, exponents[1]).named(f"expanded_volume{own}")
            volume = induced_volume(swept, clearance, left).named(volume.key)
            volumes.append(left)
        share = drawn_share(volume, swept).named(f"clearance_volumetric_efficiency{own}")
        return {value.key: value for value in (*volumes, volume, share)}

    def passed(self, flow: TracedValue, power: TracedValue) -> dict[str, TracedValue]:
        """Return flows, temperature and isothermal power by key, from the inlet flow and the power of the gas."""
        values = {value.key: value for value in self._passed(flow.named(f"inlet_flow{self.own}"), power)}
        return {key: value for key, value in values.items() if not value.is_absent}

    def _passed(self, flow: TracedValue, power: TracedValue) -> Iterator[TracedValue]:
        own, exponents, (low, high) = self.own, self.exponents, self.pressures
        yield flow
        if "gravity" in self.valves.linked:
            yield from (low, high)
        if self.valves.delivered is not None:
            share = discharge_coefficient(self._given("delivered_flow", "delivered"), flow)
            share = share.named(f"discharge_coefficient{own}")
            yield from (share, pump_slip(share).named(f"pump_slip{own}"))
        if exponents is None:
            return
        if self.valves.discharge_temperature is not None:
            yield exponents[0]
        before, constant = self.temperature, self._given("specific_gas_constant", "gas_constant")
        if not before.is_absent:
            if self.valves.discharge_temperature is None:
                yield discharge_temperature(before, high, low, exponents[0]).named(f"discharge_temperature{own}")
            if not constant.is_absent:
                yield mass_flow(low, flow, constant, before).named(f"gas_mass_flow{own}")
            free = self._given("free_air_pressure", "free_pressure")
            if not free.is_absent:
                free_temperature = self._given("free_air_temperature", "free_temperature")
                yield free_air_delivery(flow, low, before, free, free_temperature).named(f"free_air_delivery{own}")
        least = isothermal_power(low, flow, high).named(f"isothermal_power{own}")
        yield least
        if power.value:
            yield isothermal_efficiency(least, power).named(f"isothermal_efficiency{own}")

    def work(self, clearance: float, swept: float) -> float:
        """Return the work of the gas in a cycle by its pressures, as an independent check. [J]"""
        low, high, exponents = self.valves.suction, self.valves.discharge, self.valves.exponents
        if exponents is None:
            return (low - high) * swept

        def compressed(volume: float, exponent: float) -> float:
            # n/(n-1) p V (r^((n-1)/n) - 1), accurate as n approaches 1
            growth, share = math.log(high / low), (exponent - 1) / exponent
            return low * volume * (math.expm1(share * growth) / share if share else growth)

        left = clearance * (high / low) ** (1 / exponents[1])
        return compressed(left, exponents[1]) - compressed(swept + clearance, exponents[0])
