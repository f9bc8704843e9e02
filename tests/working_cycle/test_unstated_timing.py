"""Valve timing that a release of heat takes where none is stated: told, and the work that follows from it."""

import itertools
import math

import numpy as np
import pytest

import crankwork

RADIUS, ROD, BORE, RATIO, EXPONENT, HEAT = 0.043, 0.145, 0.086, 10.0, 1.32, 1100.0
ENGINE = """
crank = { stroke = "86 mm", speed = "3000 rpm" }
rod.length = "145 mm"
cylinder = { bore = "86 mm", compression_ratio = 10 }
table.step = "30 deg"
[cycle]
kind = "wiebe"
intake_pressure = "0.09 MPa"
intake_temperature = "340 K"
cycle_heat = "1100 J"
combustion_start = "20 deg"
combustion_duration = "50 deg"
shape = 2
adiabatic_exponent = 1.32
"""


def volume(degrees: float) -> float:
    phi = math.radians(degrees)
    travel = RADIUS + ROD - RADIUS * math.cos(phi) - math.sqrt(ROD**2 - (RADIUS * math.sin(phi)) ** 2)
    area = math.pi / 4 * BORE**2
    return area * (2 * RADIUS / (RATIO - 1) + travel)


def burnt(degrees: float) -> float:
    share = min(max((degrees - 340.0) / 50.0, 0.0), 1.0)
    return 1 - math.exp(-math.log(1000) * share**3)


def closed_work(closes: float, opens: float) -> float:
    """Return the work of a closed cylinder by its first law, a quarter of a degree after another. [J]"""
    angles = np.arange(closes, opens + 1e-9, 0.25)
    pressure, work = 0.09e6, 0.0
    for low, high in itertools.pairwise(angles):
        before, after, heat = volume(low), volume(high), HEAT * (burnt(high) - burnt(low))
        # p V / (k - 1) grows by the heat less the work of the mean pressure
        rise = (after - before) / 2
        later = (pressure * (before / (EXPONENT - 1) - rise) + heat) / (after / (EXPONENT - 1) + rise)
        work += (pressure + later) * rise
        pressure = later
    return work


@pytest.mark.parametrize(("timing", "closes", "opens"), [("", 50, 60), ("intake_closes exhaust_opens", 0, 0)])
def test_the_work_is_that_of_the_timing_that_is_told(timing: str, closes: float, opens: float) -> None:
    description = crankwork.Description(ENGINE)
    for key in timing.split():
        description[f"cycle.timing.{key}"] = "0 deg"
    results = crankwork.analyse(description)
    assert results["closed_work"] == pytest.approx(closed_work(180.0 + closes, 540.0 - opens), rel=2e-5)
    told = {key: item.value for item in results.assumptions for key in item.keys if "timing" in key}
    events = {"intake_closes": "50 deg", "exhaust_opens": "60 deg"}
    assert {name: told.get(f"cycle.timing.{name}", "0 deg") for name in events} == (
        events if not timing else dict.fromkeys(events, "0 deg")
    )
