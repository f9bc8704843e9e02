"""What rounds a theoretical diagram: timings of valves and ignition, and the school."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Timing:
    """When things begin and end, as books give it, by the true dead centres."""

    # Spark or injection before top dead centre; from then until the pressure leaves the compression line [deg]
    ignition_advance: float = 0.0
    ignition_delay: float = 0.0
    # Before top and after bottom dead centre; with two strokes the scavenging ports, before and after bottom [deg]
    intake_opens: float = 0.0
    intake_closes: float = 0.0
    # Before bottom and after top dead centre; with two strokes the exhaust ports, before and after bottom [deg]
    exhaust_opens: float = 0.0
    exhaust_closes: float = 0.0
    cycle: float = 720.0  # 720, or 360 for two strokes [deg]


@dataclass(frozen=True)
class Rounding:
    """How corners are rounded."""

    school: Literal["ru", "vi"] = "ru"  # `ru` or `vi`
    # Greatest pressure: after top dead centre, and over p_z (0.85 petrol, 1 diesel if left out) [deg], [-]
    peak_angle: float = 12.0
    peak_level: float | None = None
    join_after: float = 8.0  # From there to the expansion line, at least [deg]
    rise: float = 1.2  # Pressure at c'' over that at c, of the Russian school [-]
    filling_factor: float | None = None  # Wanted; the peak level is then solved for [-]
    tolerance: float = 1e-4  # How near the wanted filling factor is enough [-]
