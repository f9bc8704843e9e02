"""Data of a cycle from heat release, and the stages of its closed period."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage


@dataclass(frozen=True)
class HeatReleaseData:
    """Data of a cycle from heat release."""

    # Bore; revolutions per minute [m], [rpm]
    bore: float
    rotational_speed: float
    # Of the gas at intake closing [Pa], [K]
    shut_pressure: float
    shut_temperature: float
    heat: float | None = None  # Heat of the fuel per cycle; instead of it, the next three [J]
    # Mass of fuel, lower heating value, share of it that is released [kg], [J/kg], [-]
    fuel_per_cycle: float = 0.0
    heating_value: float = 0.0
    burning_efficiency: float = 1.0
    # Start of burning before top dead centre, duration, Wiebe exponent [deg], [deg], [-]
    burning_advance: float = 20.0
    burning_duration: float = 50.0
    burning_shape: float = 2.0
    # Ratio of specific heats (at 0 K where it has a slope), its change with temperature, specific gas
    # constant [-], [1/K], [J/(kg*K)]
    heat_ratio: float = 1.33
    heat_ratio_slope: float = 0.0
    gas_constant: float = 287.0
    has_wall_loss: bool = True  # Whether heat goes to the walls
    # Of the walls; areas of head and crown (the piston area if left out); polytrope without
    # burning [K], [m2], [m2], [-]
    wall_temperature: float = 450.0
    head_area: float | None = None
    crown_area: float | None = None
    motored_exponent: float = 1.35
    cycle: float = 720.0  # 720, or 360 for two strokes [deg]
    # After and before bottom dead centre; the ports of two strokes likewise, the last to close
    # and the first to open [deg]
    intake_closes: float = 50.0
    exhaust_opens: float = 60.0
    # Before and after top dead centre; with two strokes the scavenging ports open before bottom dead centre and the
    # exhaust ports shut after it [deg]
    intake_opens: float = 15.0
    exhaust_closes: float = 15.0
    # While gas is exchanged; with two strokes the first is that of scavenging [Pa]
    exhaust_pressure: float = 1.1e5
    intake_pressure: float = 0.9e5
    chamber: str = ""  # Path of its chamber in the description, in a linkage

    def stated_at(self, path: str) -> str:
        """Return the path in the description of the field that an engine states at `path`."""
        table, _, name = path.partition(".")
        if not self.chamber or path in ("", "crank.speed"):
            return path
        return {"cycle": f"{self.chamber}.{path}", "cylinder": f"{self.chamber}.{name}"}.get(table, "")


class Stage(NamedTuple):
    """Part of the closed period: from, to [deg]; whether fuel burns, and whether it has begun to."""

    start: float
    end: float
    burns: bool
    has_burnt: bool


def stages(data: HeatReleaseData, dead_centres: tuple[float, float]) -> tuple[Stage, Stage, Stage]:
    """Return compression, combustion and expansion in order; their length may be 0."""
    top, bottom = dead_centres
    closes = data.intake_closes
    if data.cycle == 360:
        # compression begins when the last ports close
        closes = max(closes, data.exhaust_closes)
    shut, opens = bottom + closes, bottom + 360.0 - data.exhaust_opens
    begin = top + 360.0 - data.burning_advance
    end = begin + data.burning_duration
    if begin < shut or end > opens:
        raise CrankworkError(ErrorMessage("burning_outside", begin=begin, end=end, shut=shut, opens=opens))
    return Stage(shut, begin, False, False), Stage(begin, end, True, True), Stage(end, opens, False, True)  # noqa: FBT003


_POSITIVE = (
    "bore", "rotational_speed", "shut_pressure", "shut_temperature", "burning_duration", "gas_constant",
    "wall_temperature", "exhaust_pressure", "intake_pressure",
)  # fmt: skip
_NOT_NEGATIVE = (
    "burning_shape", "fuel_per_cycle", "heating_value", "burning_efficiency", "intake_closes", "exhaust_opens",
    "intake_opens", "exhaust_closes",
)  # fmt: skip


def check_heat_release(data: HeatReleaseData) -> None:
    """Raise unless every number is valid by itself."""
    wrong = [name for name in _POSITIVE if not getattr(data, name) > 0]
    if wrong:
        raise CrankworkError(ErrorMessage("names_positive", names=", ".join(wrong)))
    wrong = [name for name in _NOT_NEGATIVE if not getattr(data, name) >= 0]
    if wrong or (data.heat is not None and data.heat < 0):
        raise CrankworkError(ErrorMessage("names_not_negative", names=", ".join(wrong) or "heat"))
    if data.cycle not in (360.0, 720.0):
        raise CrankworkError(ErrorMessage("cycle_angle", angle=data.cycle))
    if data.heat_ratio + data.heat_ratio_slope * data.shut_temperature <= 1:
        raise CrankworkError(ErrorMessage("heat_ratio_low"))
    if data.cycle == 360 and data.exhaust_opens < data.intake_opens:
        raise CrankworkError(ErrorMessage("ports_early", intake=data.intake_opens, exhaust=data.exhaust_opens))
