"""At which crank angle the piston has gone a way, by the law of cosines."""

from __future__ import annotations

import math

import pytest

import crankwork

pytestmark = pytest.mark.elsewhere

MACHINE = """
crank = { stroke = "80 mm", speed = "3000 rpm" }
rod.length = "140 mm"
cylinder.bore = "70 mm"
cylinder.travels = { ignition = "2.5 mm", port = "-18 mm" }
"""


def angle(way: float) -> float:
    """Return the crank angle at a way from the top: crank, rod and distance of the pin are a triangle. [deg]"""
    crank, rod = 40.0, 140.0
    distance = crank + rod - way
    return math.degrees(math.acos((crank**2 + distance**2 - rod**2) / (2 * crank * distance)))


def test_ways_from_either_dead_centre_have_their_angles() -> None:
    results = crankwork.analyse(crankwork.Description(MACHINE))
    for name, way in (("ignition", 2.5), ("port", 80.0 - 18.0)):
        assert math.degrees(results[f"travel_down.{name}"]) == pytest.approx(angle(way), rel=1e-9)
        assert math.degrees(results[f"travel_up.{name}"]) == pytest.approx(360 - angle(way), rel=1e-9)


def test_a_way_beyond_the_stroke_is_refused() -> None:
    with pytest.raises(crankwork.errors.InputError, match=r"cylinder.travels.port: the piston goes 80 mm"):
        crankwork.Description(MACHINE.replace("-18", "-81")).machine()
