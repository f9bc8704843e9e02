"""The gas from intake closing to exhaust opening, as functions of crank angle and pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.kinematics.crank_grid import Array
from crankwork.loads import gas as gas_formulas
from crankwork.loads.indicator import VolumeAt
from crankwork.steps import Worked
from crankwork.working_cycle import first_law, wiebe, woschni
from crankwork.working_cycle.heat_data import HeatReleaseData, Stage, check_heat_release, stages

Flags = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class ClosedGas:
    """The enclosed gas: what its pressure does at any crank angle. Volumes [m3], mass [kg], heat [J], angles [deg]."""

    data: HeatReleaseData
    volume_at: VolumeAt
    volume_rate_at: VolumeAt
    clearance: float
    swept: float
    shut_volume: float
    mass: float
    heat: float
    piston_speed: float
    areas: tuple[float, float]
    burning: tuple[float, float]
    first: float

    @property
    def speed(self) -> float:
        """Angular speed of the crank. [rad/s]"""
        return self.data.rotational_speed * math.pi / 30

    def temperature(self, degrees: Array, pressure: Array) -> Array:
        """Return the temperature at crank angles [deg] and pressures [Pa]. [K]"""
        volume = self.volume_at(degrees)
        return np.asarray(first_law.gas_temperature(pressure, volume, self.mass, self.data.gas_constant))

    def _progress(self, degrees: Array) -> Array:
        start, end = self.burning
        return np.asarray(np.clip(wiebe.burning_progress(degrees, start, end - start), 0.0, 1.0))

    def burnt(self, degrees: Array) -> Array:
        """Return the burnt fraction at crank angles [deg]. [-]"""
        return np.asarray(wiebe.wiebe_burnt_fraction(self._progress(degrees), self.data.burning_shape))

    def is_burning(self, degrees: Array) -> Flags:
        """Return whether burning has begun at crank angles [deg]."""
        return np.asarray(degrees > self.burning[0])

    def gas_speed(self, volume: Array, pressure: Array, has_burnt: Flags) -> Array:
        """Return the gas speed at the walls at volumes [m3] and pressures [Pa]. [m/s]"""
        data = self.data
        motored = gas_formulas.polytropic_pressure(data.shut_pressure, self.shut_volume, volume, data.motored_exponent)
        factors = woschni.EXPANSION
        # late in the expansion of a cold charge the difference may turn negative; burning slows no gas down
        above = np.maximum(pressure, motored)
        factor = np.where(has_burnt, factors.burning, 0.0)
        shut = (data.shut_temperature, data.shut_pressure, self.shut_volume)
        return np.asarray(
            woschni.woschni_gas_speed(
                factors.piston, self.piston_speed, factor, self.swept, *shut, above, np.asarray(motored)
            )
        )

    def wall_rate(self, degrees: Array, pressure: Array, has_burnt: Flags) -> Array:
        """Return the heat to the walls at crank angles [deg] and pressures [Pa]. [J/rad]"""
        if not self.data.has_wall_loss:
            return np.zeros_like(pressure)
        return self._wall_rate(self.volume_at(degrees), pressure, has_burnt)

    def _wall_rate(self, volume: Array, pressure: Array, has_burnt: Flags) -> Array:
        data = self.data
        temperature = first_law.gas_temperature(pressure, volume, self.mass, data.gas_constant)
        speed = self.gas_speed(volume, pressure, has_burnt)
        coefficient = woschni.woschni_coefficient(data.bore, pressure, temperature, speed)
        x = (volume - self.clearance) / (math.pi * data.bore**2 / 4)
        area = woschni.wall_area(*self.areas, math.pi, data.bore, x)
        return np.asarray(woschni.wall_heat_rate(coefficient, area, temperature, data.wall_temperature, self.speed))

    def rates(self, degrees: Array, pressure: Array, stage: Stage) -> Array:
        """Return what pressure, work and heat to the walls do per radian.

        Parameters
        ----------
        degrees, pressure : array, shape (n,)
            Crank angles and pressures. [deg], [Pa]
        stage : Stage
            The part of the closed period.

        Returns
        -------
        array, shape (3, n)
            Rates. [Pa/rad], [J/rad], [J/rad]
        """
        data = self.data
        volume, growth = self.volume_at(degrees), self.volume_rate_at(degrees)
        temperature = first_law.gas_temperature(pressure, volume, self.mass, data.gas_constant)
        ratio = first_law.gas_heat_ratio(data.heat_ratio, data.heat_ratio_slope, temperature)
        burning: Array | float = 0.0
        if stage.burns:
            duration = math.radians(stage.end - stage.start)
            burning = wiebe.wiebe_burning_rate(self._progress(degrees), data.burning_shape, duration)
        wall = np.zeros_like(pressure)
        if data.has_wall_loss:
            wall = self._wall_rate(volume, pressure, np.full(len(volume), stage.has_burnt))
        rise = first_law.pressure_rise(ratio, volume, self.heat, burning, wall, pressure, growth)
        return np.array([rise, pressure * growth, wall])

    def integrated(self, stage: Stage, pressure: float, relative: float, absolute: float) -> tuple[VolumeAt, Array]:
        """Return the solution of the first law over one part of the closed period.

        Parameters
        ----------
        stage : Stage
            The part.
        pressure, relative, absolute : float
            Pressure at its start; relative and absolute tolerance, the latter by the size of each unknown.
            [Pa], [-], [-]

        Returns
        -------
        tuple of callable, array
            Pressure, work and heat to the walls within it and at its end. [Pa], [J], [J]
        """
        try:
            from scipy.integrate import solve_ivp  # noqa: PLC0415 - loaded where it is needed
        except ModuleNotFoundError:
            raise MissingExtraError("a cycle from the heat released", "dynamics") from None
        sizes = np.array([self.data.shut_pressure, 1.0, 1.0])
        sizes[1:] = self.data.shut_pressure * self.shut_volume + self.heat

        def right_side(angle: float, state: Array) -> Array:
            return np.radians(self.rates(np.array([angle]), state[:1], stage)[:, 0])

        solution = solve_ivp(
            right_side,
            (stage.start, stage.end),
            [pressure, 0.0, 0.0],
            method="DOP853",
            dense_output=True,
            rtol=relative,
            atol=absolute * sizes,
        )
        if not solution.success or solution.sol is None:
            raise CrankworkError(f"the first law could not be integrated: {solution.message}")
        return solution.sol, solution.y[:, -1]

    def energy_change(self, temperature: float) -> float:
        """Return the change of internal energy since intake closing, at a temperature [K]. [J]"""
        data = self.data
        constant = self.mass * data.gas_constant
        ratio = (data.heat_ratio, data.heat_ratio_slope)
        return first_law.internal_energy_change(constant, *ratio, data.shut_temperature, float(temperature))


def closed_gas(
    data: HeatReleaseData,
    volume_at: VolumeAt,
    volume_rate_at: VolumeAt,
    dead_centres: tuple[float, float],
    worked: Worked,
) -> ClosedGas:
    """Return the gas enclosed at intake closing, its constants worked out step by step.

    Parameters
    ----------
    data : HeatReleaseData
        What the cycle is made of.
    volume_at, volume_rate_at : callable
        Cylinder volume and its derivative. [deg] -> [m3], [deg] -> [m3/rad]
    dead_centres : tuple of float
        Top and bottom dead centre within one revolution. [deg]
    worked : Worked
        Where the steps are kept.

    Returns
    -------
    ClosedGas
        The gas.

    Raises
    ------
    CrankworkError
        If a number makes no sense.
    """
    check_heat_release(data)
    shut, begin, end = (one.start for one in stages(data, dead_centres))
    clearance, largest, shut_volume = (float(one) for one in volume_at(np.array([*dead_centres, shut])))
    area = float(gas_formulas.piston_area(math.pi, data.bore))
    stroke = (largest - clearance) / area
    heat = data.heat
    if heat is None:
        heat = worked(wiebe.fuel_heat, data.fuel_per_cycle, data.heating_value, data.burning_efficiency)
    state = (data.shut_pressure, shut_volume, data.gas_constant, data.shut_temperature)
    return ClosedGas(
        data=data,
        volume_at=volume_at,
        volume_rate_at=volume_rate_at,
        clearance=clearance,
        swept=largest - clearance,
        shut_volume=shut_volume,
        mass=worked(first_law.gas_mass, *state),
        heat=heat,
        piston_speed=stroke * data.rotational_speed / 30,
        areas=(
            area if data.head_area is None else data.head_area,
            area if data.crown_area is None else data.crown_area,
        ),
        burning=(begin, end),
        first=shut,
    )
