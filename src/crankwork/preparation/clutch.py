"""A friction clutch: its torque, and the time, the speed and the heat of an engagement."""

from __future__ import annotations

from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import TracedValue, absent, given
from crankwork.loads.indicator import DiagramError
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.shaft.clutch import inertia_of_side, work_clutch

# quantities of the numbers that a file states, and those of a shaft behind its name
_QUANTITIES = {
    "faces": "friction_faces", "friction": "clutch_friction", "outer_diameter": "clutch_outer_diameter",
    "inner_diameter": "clutch_inner_diameter", "mean_radius": "clutch_radius", "cone_angle": "cone_angle",
    "force": "clutch_force", "pressure": "clutch_pressure", "torque": "clutch_torque",
    "power": "clutch_power",
}  # fmt: skip
_OF_SIDE = {"torque": "load", "radius_of_gyration": "gyration_radius"}


def worked_clutch(machine: Machine) -> dict[str, TracedValue]:
    """Return what follows for a clutch (khurmi_gupta_2005, ch. 10); raise DiagramError if nothing does."""
    worked = Calculation()
    for path, number in machine.stated.items():
        side, _, key = path.removeprefix("clutch.").rpartition(".")
        if path.startswith("clutch."):
            quantity = f"{side}_{_OF_SIDE.get(key, key)}" if side else _QUANTITIES[key]
            worked.given(quantity, number.value, path)
    if "clutch_friction" in worked.known and "cone_angle" not in worked.known:
        worked.known.setdefault("friction_faces", given("friction_faces", 2.0, "clutch.faces"))
    for side in ("driving", "driven"):
        if f"{side}_mass" in worked.known:
            sizes = {"m_cl": worked[f"{side}_mass"], "k_cl": worked[f"{side}_gyration_radius"]}
            worked(inertia_of_side, f"{side}_inertia", **sizes)
        worked.known.setdefault(f"{side}_load", absent(f"{side}_load"))
    worked.known.setdefault("driven_speed", absent("driven_speed"))
    work_clutch(worked, machine.clutch or "", machine.method.pi)
    if not worked.found.keys() - {"driving_inertia", "driven_inertia"}:
        raise DiagramError("clutch", ErrorMessage("clutch_nothing"))
    rate = worked.known.get("closing_acceleration")
    if rate is not None and rate.value <= 0:
        raise DiagramError("clutch.driven.torque", ErrorMessage("clutch_slips"))
    if "slip_time" in worked.known and worked["slip_time"].value < 0:
        raise DiagramError("clutch.driving.speed", ErrorMessage("clutch_slower"))
    return {key: value for key, value in {**worked.known, **worked.found}.items() if not value.is_absent}
