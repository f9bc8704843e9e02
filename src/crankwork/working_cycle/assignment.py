"""The working cycle of an assignment, whose sheet gives pressures and exponents in place of a fuel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value, formula
from crankwork.loads.gas import compression_ratio
from crankwork.locale import ErrorMessage
from crankwork.working_cycle import charge, engine_size, grinevetsky
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners
from crankwork.working_cycle.fuels import CycleError

AssignedKind = Literal["assigned-petrol", "assigned-diesel"]


@formula("compression_exponent", "kolchin_demidov_2008, ch. 3")
def compression_exponent(p_c: Value, p_a: Value, r_c: Value) -> Value:
    """Exponent of the polytrope between the pressures at both ends of compression."""
    return np.log(p_c / p_a) / np.log(r_c)


@formula("expansion_exponent", "kolchin_demidov_2008, ch. 3")
def expansion_exponent(p_z: Value, p_exp: Value, delta_post: Value) -> Value:
    """Exponent of the polytrope between the pressures at both ends of expansion."""
    return np.log(p_z / p_exp) / np.log(delta_post)


@dataclass(frozen=True)
class AssignedData:
    """What an assignment gives; of two equivalent values one is None. [SI]"""

    kind: AssignedKind
    angle: float  # Crank angle of the cycle [deg]
    # At the points a, z and r, absolute [Pa]
    intake_pressure: float
    peak_pressure: float | None
    residual_pressure: float
    pressure_ratio: float | None  # Of burning, in place of the pressure at z [-]
    # Of the polytropes [-], or the pressures at their ends [Pa]
    compression_exponent: float | None
    compression_pressure: float | None
    expansion_exponent: float | None
    expansion_pressure: float | None
    cut_off: float  # Volume at z over the clearance volume [-]
    compression_ratio: float | None  # Or both volumes [-], [m3]
    clearance_volume: float | None = None
    total_volume: float | None = None


# keys of quantities that are named otherwise in a file
_KEYS = {"peak_pressure": "combustion_pressure", "pressure_ratio": "pressure_rise_ratio"}
_OF_CYLINDER = ("compression_ratio", "clearance_volume")


def assigned_cycle(data: AssignedData) -> CalculatedCycle:
    """Return the cycle of an assignment: pressures at c, z and b, and the mean pressure of the sharp diagram."""
    worked = Calculation()
    for name, value in vars(data).items():
        if name in ("kind", "angle") or value is None:
            continue
        table = "cylinder" if name in _OF_CYLINDER else "cycle"
        worked.given(_KEYS.get(name, name), value, f"{table}.{name}")
    if data.cut_off == 1.0:
        worked.absent("cut_off", 1.0)
    stated = dict(worked.known)
    if data.total_volume is not None:
        total, clearance = worked["total_volume"], worked["clearance_volume"]
        worked(compression_ratio, V_d=total - clearance)
    if data.compression_exponent is None:
        worked(compression_exponent)
    else:
        worked(charge.compression_pressure)
    worked(grinevetsky.dual_pressure if data.peak_pressure is None else grinevetsky.pressure_rise_ratio)
    _check(worked)
    worked(grinevetsky.afterexpansion)
    if data.expansion_exponent is None:
        worked(expansion_exponent)
    else:
        worked(grinevetsky.expansion_pressure)
    if 1.0 not in (worked["compression_exponent"].value, worked["expansion_exponent"].value):
        worked(engine_size.theoretical_mean_pressure)
    worked.absent("lost_stroke")
    names = (
        "residual_pressure", "intake_pressure", "compression_pressure", "combustion_pressure", "expansion_pressure",
        "cut_off", "compression_exponent", "expansion_exponent", "compression_ratio", "lost_stroke",
    )  # fmt: skip
    corners = Corners(*(worked[name] for name in names))
    if data.total_volume is not None:
        corners = corners._replace(V_a=worked["total_volume"])
    shown = {key: known for key, known in stated.items() if not known.is_absent}
    return CalculatedCycle(data.kind, data.angle, corners, shown | worked.found)


def _check(worked: Calculation) -> None:
    """Raise where the data contradict one another."""
    rise, cut_off, ratio = (worked[key].value for key in ("pressure_rise_ratio", "cut_off", "compression_ratio"))
    if rise < 1 or not 1 <= cut_off < ratio:
        raise CycleError(ErrorMessage("assigned_backwards", rise=rise, cut_off=cut_off, ratio=ratio))
