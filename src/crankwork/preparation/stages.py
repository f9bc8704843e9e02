"""The states, flows, powers and heats of the stages of a compressor, from one delivery or size."""

from __future__ import annotations

import math
from collections.abc import Mapping

from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, given, total
from crankwork.loads import stages as formulas
from crankwork.loads import valves
from crankwork.loads.gas import piston_area
from crankwork.loads.indicator import DiagramError
from crankwork.loads.stages import Stages
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.working_cycle.engine_size import bore_and_stroke

# quantities of the numbers that a file states, those of each stage behind the others
_QUANTITIES = {
    "count": "stage_count", "ratio_limit": "limit_ratio", "temperature_limit": "limit_temperature",
    "discharge_temperature": "discharge_temperature", "temperature": "suction_temperature",
    "final_temperature": "suction_temperature", "flow": "inlet_flow", "free_flow": "free_air_delivery",
    "mass_flow": "gas_mass_flow", "free_pressure": "free_air_pressure", "free_temperature": "free_air_temperature",
    "gas_constant": "specific_gas_constant", "heat_capacity": "gas_heat_capacity", "bore": "bore", "stroke": "stroke",
    "stroke_bore_ratio": "stroke_bore_ratio", "piston_speed": "mean_piston_speed", "sides": "piston_sides",
    "shaft_power": "shaft_power", "water_rise": "water_rise", "water_flow": "water_flow",
    "water_heat_capacity": "water_heat_capacity", "suction": "suction_pressure", "discharge": "discharge_pressure",
    "between": "discharge_pressure", "losses": "cooler_pressure_loss", "temperatures": "suction_temperature",
    "exponent": "compression_exponent", "expansion_exponent": "expansion_exponent", "clearance": "clearance_ratio",
    "volumetric_efficiency": "clearance_volumetric_efficiency",
}  # fmt: skip
# logarithm of the largest ratio of pressures that is a number
_MOST_HEATING = 600.0
# values that a chamber of a stage takes over, by the fields of its valves
_OF_VALVES = ("suction", "discharge", "temperature", "exponent", "expansion_exponent", "gas_constant", "free_pressure",
              "free_temperature")  # fmt: skip


def stage_values(
    machine: Machine, stages: Stages, drawn: Mapping[str, TracedValue] | None = None
) -> dict[str, TracedValue]:
    """Return the single values of stages by key; `drawn`: values of the chambers of a linkage, by key."""
    compressor = _Compressor(machine, stages, drawn)
    compressor.find_states()
    compressor.find_flows()
    compressor.find_powers()
    compressor.find_heats()
    return compressor.values


def stage_states(machine: Machine, stages: Stages) -> tuple[dict[str, TracedValue], ...]:
    """Return pressures, temperature and exponents of each stage, by the names that a file gives them."""
    states = _Compressor(machine, stages, {})
    states.find_states()
    known = [{name: states.of(_QUANTITIES[name], index) for name in _OF_VALVES} for index in range(states.count)]
    return tuple({name: value for name, value in stage.items() if not value.is_absent} for stage in known)


class _Compressor:
    """The stages of one machine, calculated in order; `values` has what is known so far, by key."""

    def __init__(self, machine: Machine, stages: Stages, drawn: Mapping[str, TracedValue] | None) -> None:
        self.machine, self.stages, self.drawn, self.pi = machine, stages, drawn, machine.method.pi
        self.values: dict[str, TracedValue] = {}
        self.w, self.turn = traced_inputs.speed(machine, machine.method), given("cycle_angle", 2 * self.pi)
        self.count, self._z = self._number()

    def _keep(self, key: str, value: TracedValue) -> TracedValue:
        self.values[key] = value.named(key)
        return self.values[key]

    def _given(self, name: str, index: int = 0) -> TracedValue:
        """Return a stated number, of a list the entry of a stage or the one for all; absent if it is not stated."""
        entries, key = self.stages.numbers.get(name, ()), _QUANTITIES[name]
        if not entries:
            return absent(key)
        index, path = min(index, len(entries) - 1), f"stages.{name}"
        is_one = path in self.machine.stated or not self.machine.stated or len(entries) == 1
        return given(key, entries[index], path if is_one else f"{path}[{index + 1}]")

    def of(self, key: str, index: int) -> TracedValue:
        """Return a value of a stage or one of all, absent if there is none."""
        return self.values.get(f"{key}.{index + 1}", self.values.get(key, absent(key)))

    def _number(self) -> tuple[int, TracedValue]:
        """Return the number of stages, stated or the least that keeps to a limit."""
        limit, hot = self._given("ratio_limit"), self._given("temperature_limit")
        if limit.is_absent and hot.is_absent:
            count = self._given("count")
            return int(count.value) or 1, count
        if limit.is_absent:
            cold = self._given("temperature")
            for index in range(len(self.stages.numbers.get("temperatures", ()))):
                warm = self._given("temperatures", index)
                cold = warm if warm.value > cold.value else cold
            exponent = self._given("exponent")
            warmer = math.log(hot.value / cold.value)
            if warmer <= 0 or exponent.value * warmer > _MOST_HEATING * (exponent.value - 1):
                stated = {"low": cold.value, "exponent": exponent.value}
                raise DiagramError("stages.temperature_limit", ErrorMessage("stages_no_limit", **stated))
            limit = formulas.ratio_of_temperature(hot, cold, exponent)
        limit = self._keep("limit_ratio", limit)
        needed = formulas.needed_stages(self._given("discharge"), self._given("suction"), limit)
        needed = self._keep("needed_stages", needed)
        # a number that rounding lifts above a whole one is that one
        least = max(1, math.ceil(needed.value - 1e-9))
        value = TracedValue(ProcedureValue(float(least), "whole_above", (needed,)))
        return least, self._keep("stage_count", value)

    def find_states(self) -> None:
        """Find pressures, temperatures and exponents of each stage."""
        self._find_entries()
        behind = self._given("suction")
        for index in range(self.count):
            owner, before = f".{index + 1}", behind
            if index and "losses" in self.stages.numbers:
                before = behind - self._given("losses", index - 1)
            low = self._keep(f"suction_pressure{owner}", before)
            behind = self._keep(f"discharge_pressure{owner}", self._behind(index, behind))
            self._check(index, low.value, behind.value)
            self._keep(f"stage_pressure_ratio{owner}", behind / low)
            cold, hot = self.of("suction_temperature", index), self._given("discharge_temperature")
            exponent = self.of("compression_exponent", index)
            if exponent.is_absent:
                exponent = self.of("compression_exponent", 0)
                if not index:
                    exponent = valves.exponent_of_temperatures(behind, low, hot, cold)
                exponent = self._keep(f"compression_exponent{owner}", exponent)
            if not cold.is_absent:
                warm = valves.discharge_temperature(cold, behind, low, exponent) if hot.is_absent or index else hot
                self._keep(f"discharge_temperature{owner}", warm)

    def _check(self, index: int, low: float, high: float) -> None:
        """Raise for a stage that does not raise the pressure, or a temperature behind it that no polytrope has."""
        if not 0 < low < high:
            first, last = (self._given(name).value for name in ("suction", "discharge"))
            stated, code = {"low": low / 1e6, "high": high / 1e6, "number": index + 1}, "stages_rise"
            if last <= first:
                place, code, stated = "discharge", "stages_back", {"low": first / 1e6, "high": last / 1e6}
            elif "between" in self.stages.numbers:
                place = "between"
            else:
                place, code = "temperatures", "stages_apart"
            before = self.values[f"discharge_pressure.{index}"].value if index else low
            if before < high and low < before:
                place, code = "losses", "stages_loss"
                stated = {"loss": (before - low) / 1e6, "low": before / 1e6, "number": index + 1}
            raise DiagramError(f"stages.{place}", ErrorMessage(code, **stated))
        hot, cold = self._given("discharge_temperature"), self._given("temperature").value
        if not index and not hot.is_absent and not cold <= hot.value < cold * high / low:
            message = ErrorMessage("valves_temperature", low=cold, high=cold * high / low)
            raise DiagramError("stages.discharge_temperature", message)

    def _find_entries(self) -> None:
        """Find what is stated of the gas, and of each stage but its pressures."""
        for name in ("gas_constant", "heat_capacity", "free_pressure", "free_temperature"):
            if not (value := self._given(name)).is_absent:
                self._keep(value.key, value)
        for index in range(self.count):
            cold = self._given("temperatures", index - 1) if index else absent("suction_temperature")
            cold = self._given("temperature") if cold.is_absent else cold
            for value in (self._given("exponent", index), self._given("expansion_exponent", index), cold):
                if not value.is_absent:
                    self._keep(f"{value.key}.{index + 1}", value)

    def _behind(self, index: int, before: TracedValue) -> TracedValue:
        """Return the pressure behind a stage; `before`: that behind the stage before it."""
        if index + 1 == self.count:
            return self._given("discharge")
        if "between" in self.stages.numbers:
            return self._given("between", index)
        ratio = formulas.equal_ratio(self._given("discharge"), self._given("suction"), self._z)
        return before * self._best(index, ratio.named("stage_pressure_ratio.equal"))

    def _best(self, index: int, ratio: TracedValue) -> TracedValue:
        """Return the pressure ratio with which all stages together take up the least work."""
        cold = self.of("suction_temperature", index)
        for other in range(self.count):
            warm = self.of("suction_temperature", other)
            if not warm.is_absent and warm.value != cold.value:
                ratio = formulas.cooled_ratio(ratio, warm, cold, self.of("compression_exponent", index), self._z)
        return ratio.named(f"stage_pressure_ratio.best.{index + 1}")

    def _expansion(self, index: int) -> TracedValue:
        own = self.of("expansion_exponent", index)
        return self.of("compression_exponent", index) if own.is_absent else own

    def _pressures(self, index: int) -> tuple[TracedValue, TracedValue]:
        return self.of("discharge_pressure", index), self.of("suction_pressure", index)

    def find_flows(self) -> None:
        """Find what each stage draws in, and sizes."""
        low, cold = self.of("suction_pressure", 0), self.of("suction_temperature", 0)
        constant = self.of("specific_gas_constant", 0)
        free = self.of("free_air_pressure", 0), self.of("free_air_temperature", 0)
        first = self._keep("stage_flow.1", self._first_flow(low, cold, constant, free))
        for index in range(1, self.count):
            later, warm = first * low / self.of("suction_pressure", index), self.of("suction_temperature", index)
            if not warm.is_absent and warm.value != cold.value:
                later = later * (warm / cold)
            later = self._keep(f"stage_flow.{index + 1}", later)
            if self.drawn is not None:
                self._keep(f"stage_flow_error.{index + 1}", self._of_chambers(index) / later - 1)
        if not constant.is_absent and not cold.is_absent and "gas_mass_flow" not in self.values:
            self._keep("gas_mass_flow", valves.mass_flow(low, first, constant, cold))
        if not free[0].is_absent and "free_air_delivery" not in self.values:
            self._keep("free_air_delivery", valves.free_air_delivery(first, low, cold, *free))
        if self.drawn is None:
            self._find_sizes()

    def _first_flow(
        self, low: TracedValue, cold: TracedValue, constant: TracedValue, free: tuple[TracedValue, TracedValue]
    ) -> TracedValue:
        """Return what the first stage draws in: its chambers, a stated delivery, or by its size."""
        flow, mass, free_flow = (self._given(name) for name in ("flow", "mass_flow", "free_flow"))
        if self.drawn is not None:
            return self._of_chambers(0)
        if not mass.is_absent:
            return self._keep("gas_mass_flow", mass) * constant * cold / low
        if not free_flow.is_absent:
            return self._keep("free_air_delivery", free_flow) * free[0] / low * (cold / free[1])
        if flow.is_absent:
            share, swept = self._by_clearance(0), self._first_swept()
            flow = swept if share.is_absent else swept * share
        return flow

    def _of_chambers(self, index: int) -> TracedValue:
        """Return what the chambers of a stage draw in."""
        flows = [(self.drawn or {})[f"inlet_flow.{name}"] for name in self.stages.chambers[index]]
        return total(f"stage_flow.drawn.{index + 1}", flows)

    def _by_clearance(self, index: int) -> TracedValue:
        """Return the volumetric efficiency by the clearance of a stage, absent without one."""
        clearance, share = self._given("clearance", index), self._given("volumetric_efficiency", index)
        key = f"clearance_volumetric_efficiency.{index + 1}"
        if clearance.is_absent:
            return share if share.is_absent else self._keep(key, share)
        clearance = self._keep(f"clearance_ratio.{index + 1}", clearance)
        share = formulas.efficiency_of_clearance(clearance, *self._pressures(index), self._expansion(index))
        return self._keep(key, share)

    def _stroke(self) -> TracedValue | None:
        """Return the stroke, stated or that of a mean piston speed."""
        stroke, speed = self._given("stroke"), self._given("piston_speed")
        if not speed.is_absent:
            stroke = speed * self.pi / self.w
        return self.values.get("stroke") if stroke.is_absent else stroke

    def _first_swept(self) -> TracedValue:
        """Return what the pistons of the first stage sweep per unit of time, by their size."""
        bore, stroke, ratio = self._given("bore"), self._stroke(), self._given("stroke_bore_ratio")
        bore, stroke = bore_and_stroke(self.pi, None, None if ratio.is_absent else ratio, bore, stroke)
        area = piston_area(self.pi, self._keep("bore.1", bore))
        volume = self._keep("swept_volume.1", area * self._keep("stroke", stroke))
        return self._keep("swept_flow.1", volume * self._given("sides") * self.w / self.turn)

    def _find_sizes(self) -> None:
        """Find volumetric efficiencies, what pistons sweep, and bores."""
        first, stroke, ratio = self.of("stage_flow", 0), self._stroke(), self._given("stroke_bore_ratio")
        if "bore" in self.stages.numbers and "swept_flow.1" not in self.values:
            # a size beside a delivery gives what the clearance must be
            share = self._keep("clearance_volumetric_efficiency.1", first / self._first_swept())
            clearance = formulas.clearance_of_efficiency(share, *self._pressures(0), self._expansion(0))
            self._keep("clearance_ratio.1", clearance)
            stroke = self._stroke()
        for index in range(self.count):
            owner = f".{index + 1}"
            if f"swept_flow{owner}" in self.values:
                continue
            flow, share = self.of("stage_flow", index), self._by_clearance(index)
            swept = self._keep(f"swept_flow{owner}", flow if share.is_absent else flow / share)
            if self.stages.has_speed:
                volume = swept * self.turn / (self._given("sides") * self.w)
                volume = self._keep(f"swept_volume{owner}", volume)
                if stroke is None and ratio.is_absent:
                    continue
                shape = None if index or ratio.is_absent else ratio
                bore, stroke = bore_and_stroke(self.pi, volume, shape, None, stroke)
                self._keep(f"bore{owner}", bore)
                self._keep("stroke", stroke)
        if "free_air_delivery" in self.values:
            self._keep("free_volumetric_efficiency", self.values["free_air_delivery"] / self.of("swept_flow", 0))

    def _power(self, index: int, flow: TracedValue, high: TracedValue, low: TracedValue) -> TracedValue:
        """Return the power of a stage by what it draws in."""
        exponent = self.of("compression_exponent", index)
        if exponent.value == 1:
            return valves.isothermal_power(low, flow, high)  # type: ignore[no-any-return]
        return formulas.stage_power(exponent, low, flow, high)  # type: ignore[no-any-return]

    def find_powers(self) -> None:
        """Find powers, and what several stages save."""
        powers = []
        for index in range(self.count):
            owner, (high, low), clearance = f".{index + 1}", self._pressures(index), self.of("clearance_ratio", index)
            exponents = self.of("compression_exponent", index), self._expansion(index)
            flow = self.of("stage_flow", index)
            if clearance.is_absent or exponents[0].value == exponents[1].value:
                power = self._power(index, flow, high, low)
            else:
                swept = self.of("swept_flow", index)
                filled = ((1 + clearance) * swept).named(f"filled_flow{owner}")
                taken = self._power(index, filled, high, low).named(f"stage_power.compression.{index + 1}")
                back = formulas.returned_power(clearance, swept, exponents[1], low, high)
                power = taken - self._keep(f"returned_power{owner}", back)
            powers.append(self._keep(f"stage_power{owner}", power))
        power = self._keep("stage_power", total("", powers))
        first = self.of("stage_flow", 0)
        _, low = self._pressures(0)
        high = self._pressures(self.count - 1)[0]
        least = self._keep("isothermal_power", valves.isothermal_power(low, first, high))
        self._keep("isothermal_efficiency", formulas.isothermal_share(least, power))
        if self.count > 1:
            single = self._keep("single_stage_power", self._power(0, first, high, low))
            self._keep("stage_saving", formulas.stage_saving(power, single))
        if self.drawn is not None:
            return
        shaft, losses = self._given("shaft_power"), traced_inputs.efficiency_of(self.machine.drive)
        if not shaft.is_absent:
            self._keep("mechanical_efficiency", power / self._keep("shaft_power", shaft))
        elif not losses.is_absent:
            shaft = self._keep("motor_power", power / losses)
        if not shaft.is_absent:
            self._keep("overall_isothermal_efficiency", least / shaft)

    def find_heats(self) -> None:
        """Find the work on a kilogram, and heats that coolers, walls and water take."""
        mass, capacity = self.of("gas_mass_flow", 0), self.of("gas_heat_capacity", 0)
        if mass.is_absent:
            return
        self._keep("specific_work", self.values["stage_power"] / mass)
        if capacity.is_absent:
            return
        walls, coolers = list[TracedValue](), list[TracedValue]()
        for index in range(self.count):
            owner, power = f".{index + 1}", self.of("stage_power", index)
            hot, before = self.of("discharge_temperature", index), self.of("suction_temperature", index)
            walls.append(
                self._keep(f"cylinder_heat{owner}", formulas.cylinder_heat(power, mass, capacity, hot, before))
            )
            is_last = index + 1 == self.count
            behind = self._given("final_temperature") if is_last else self.of("suction_temperature", index + 1)
            if not behind.is_absent:
                heat = self._keep(f"cooler_heat{owner}", formulas.cooler_heat(mass, capacity, hot, behind))
                self._keep(f"specific_cooler_heat{owner}", heat / mass)
                coolers.append(heat)
        self._keep("cylinder_heat", total("", walls))
        self._keep("heat_removed", total("", [*walls, *coolers]))
        if coolers:
            heat, water = self._keep("cooler_heat", total("", coolers)), self._given("water_heat_capacity")
            rise, flow = self._given("water_rise"), self._given("water_flow")
            if not rise.is_absent:
                self._keep("water_flow", formulas.water_flow(heat, water, rise))
            elif not flow.is_absent:
                self._keep("water_rise", heat / (water * flow))
