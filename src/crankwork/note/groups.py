"""Lines of the memory that belong together in a note."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.lines import Line

DELIVERY = (
    "expanded_volume", "induced_volume", "clearance_volumetric_efficiency", "inlet_flow.", "inlet_flow",
    "discharge_coefficient",
    "pump_slip", "polytropic_exponent", "discharge_temperature", "gas_mass_flow", "free_air_delivery",
    "isothermal_power", "isothermal_efficiency",
)  # fmt: skip


class Group(NamedTuple):
    """Lines in the order of calculation: what they are about, and where they hold, if they vary. [deg]"""

    name: str
    lines: tuple[Line, ...]
    degrees: float | None = None
