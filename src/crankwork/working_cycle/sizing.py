"""Bore and stroke of the engine that a cycle asks for, or the power of one whose size is known."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.kinematics.lengths import mean_piston_speed
from crankwork.loads.gas import piston_area, swept_volume
from crankwork.steps import Worked
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.calculated_cycle import Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.performance import effective_mean_pressure, mechanical_loss_pressure

_SETTLED = 1e-13
_LONGEST = 200


class Size(NamedTuple):
    """A sized engine.

    Parameters
    ----------
    bore, stroke, swept_volume, displacement, effective_pressure : float
        Of one cylinder, of one, of one, of all; mean pressure. [m], [m], [m3], [m3], [Pa]
    """

    bore: float
    stroke: float
    swept_volume: float
    displacement: float
    effective_pressure: float

    def work_results(self, worked: Worked, data: GrinevetskyData, fuel: float) -> None:
        """Work power, torque and fuel per time.

        Parameters
        ----------
        worked : Worked
            Where the steps are kept.
        data : GrinevetskyData
            Speed and strokes.
        fuel : float
            Fuel per effective work. [kg/J]
        """
        speed = data.rotational_speed
        power = worked(
            engine_size.effective_power, self.effective_pressure, self.displacement, speed, float(data.strokes)
        )
        worked(engine_size.effective_torque, power, data.pi, speed)
        worked(engine_size.fuel_rate, power, fuel)
        worked(engine_size.power_per_litre, power, self.displacement)


def sized(worked: Worked, data: GrinevetskyData, indicated: float) -> tuple[Size, list[Notice]]:
    """Return the size of the engine, worked step by step.

    Parameters
    ----------
    worked : Worked
        Where the steps are kept.
    data : GrinevetskyData
        With power, or with bore and stroke.
    indicated : float
        Indicated mean pressure. [Pa]

    Returns
    -------
    tuple
        The size; a notice where it was rounded.

    Raises
    ------
    CycleError
        If mechanical losses leave no power.

    Notes
    -----
    Losses depend on the mean piston speed and that on the stroke to be found: the calculation is repeated until the
    stroke stays, and its last pass is the one that is shown.
    """
    if data.bore is not None and data.stroke is not None:
        return _of_size(worked, data, indicated, data.bore, data.stroke), []
    stroke = 0.0
    for _ in range(_LONGEST):
        found = _of_power(Worked(), data, indicated, stroke)
        if abs(found.stroke - stroke) <= _SETTLED * found.stroke:
            break
        stroke = found.stroke
    else:
        raise CycleError("no stroke gives the wanted power at this speed; lower the speed or the stroke-bore ratio")
    size = _of_power(worked, data, indicated, stroke)
    if not data.rounds_size:
        return size, []
    bore, stroke = (round(one * 1e3) / 1e3 for one in (size.bore, size.stroke))
    said = {
        "bore": size.bore * 1e3,
        "stroke": size.stroke * 1e3,
        "bore_taken": bore * 1e3,
        "stroke_taken": stroke * 1e3,
    }
    return _of_size(worked, data, indicated, bore, stroke), [("cycle_rounded_size", said)]


def _effective(worked: Worked, data: GrinevetskyData, indicated: float, stroke: float) -> float:
    """Return the effective mean pressure at a stroke. [Pa]"""
    if not isinstance(data.mechanical_loss, tuple):
        raise CycleError("mechanical losses need the two coefficients of p_m = a + b v_p")
    speed = worked(mean_piston_speed, stroke, data.rotational_speed)
    loss = worked(mechanical_loss_pressure, *data.mechanical_loss, speed)
    effective = worked(effective_mean_pressure, indicated, loss)
    if effective <= 0:
        raise CycleError(
            f"at a mean piston speed of {speed:g} m/s the losses, {loss / 1e6:g} MPa, take all of the indicated mean "
            f"pressure, {indicated / 1e6:g} MPa; lower speed or stroke, or give other mechanical losses"
        )
    return effective


def _of_power(worked: Worked, data: GrinevetskyData, indicated: float, stroke: float) -> Size:
    """Return the size that the power asks for if the stroke were the one given."""
    effective = _effective(worked, data, indicated, stroke)
    speed = data.rotational_speed
    whole = worked(engine_size.displacement_of_power, float(data.strokes), data.power or 0.0, effective, speed)
    one = worked(engine_size.swept_volume_of_one, whole, float(data.cylinders))
    bore = worked(engine_size.bore_of_volume, one, data.pi, data.stroke_bore_ratio)
    return Size(bore, worked(engine_size.stroke_of_bore, data.stroke_bore_ratio, bore), one, whole, effective)


def _of_size(worked: Worked, data: GrinevetskyData, indicated: float, bore: float, stroke: float) -> Size:
    """Return the size of an engine whose bore and stroke are known."""
    area = worked(piston_area, data.pi, bore)
    one = worked(swept_volume, area, stroke)
    whole = worked(engine_size.displacement, one, float(data.cylinders))
    return Size(bore, stroke, one, whole, _effective(worked, data, indicated, stroke))
