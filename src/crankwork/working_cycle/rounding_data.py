"""What rounds a theoretical diagram: timings of valves and ignition, and the school."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Timing:
    """When things begin and end, as books give it, by the true dead centres.

    Parameters
    ----------
    ignition_advance, ignition_delay : float
        Spark or injection before top dead centre; from then until the pressure leaves the compression
        line. [deg]
    intake_opens, intake_closes : float
        Before top and after bottom dead centre; with two strokes the scavenging ports, before and
        after bottom. [deg]
    exhaust_opens, exhaust_closes : float
        Before bottom and after top dead centre; with two strokes the exhaust ports, before and
        after bottom. [deg]
    cycle : float
        720, or 360 for two strokes. [deg]
    """

    ignition_advance: float = 0.0
    ignition_delay: float = 0.0
    intake_opens: float = 0.0
    intake_closes: float = 0.0
    exhaust_opens: float = 0.0
    exhaust_closes: float = 0.0
    cycle: float = 720.0


@dataclass(frozen=True)
class Rounding:
    """How corners are rounded.

    Parameters
    ----------
    school : str
        `ru` or `vi`.
    peak_angle, peak_level : float and float or None
        Greatest pressure: after top dead centre, and over p_z (0.85 petrol, 1 diesel if left out). [deg], [-]
    join_after : float
        From there to the expansion line, at least. [deg]
    rise : float
        Pressure at c'' over that at c, of the Russian school. [-]
    filling_factor : float or None
        Wanted; the peak level is then solved for. [-]
    tolerance : float
        How near the wanted filling factor is enough. [-]
    """

    school: Literal["ru", "vi"] = "ru"
    peak_angle: float = 12.0
    peak_level: float | None = None
    join_after: float = 8.0
    rise: float = 1.2
    filling_factor: float | None = None
    tolerance: float = 1e-4
