"""Peak velocity, acceleration and jerk of motion laws over unit travel and time, each from its machine file.

Modified sine and cubic of mechdesigner.support, modified trapezoid of the tables of Norton, Design of Machinery; the
closed forms are integrals of the accelerations that define the laws, at 40 digits.
"""

import math

import pytest

from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

FOLLOWER = """
format = 2
guides.bed = { angle = "0 deg" }
sliders.ram = { guide = "bed", pin = "B" }
[driver]
slider = "ram"
start = "0 m"
jerk = true
law = [{ kind = "KIND", to = "1 m", over = "1 s" }, { kind = "dwell", over = "1 s" },
       { kind = "KIND", to = "0 m", over = "1 s" }]
"""
# velocity, acceleration and jerk, and the jerk midway
LAWS = {
    "modified-sine": (1.75960338595377, 5.527957070544091, 69.46635728872428, -23.15545242957476),
    "modified-trapezoidal": (2.0, 4.888123762813258, 61.42597481236732, -61.42597481236732),
    "cubic": (1.5, 6.0, 12.0, -12.0),
    "3-4-5": (1.875, 10 / math.sqrt(3), 60.0, -30.0),
    "cycloidal": (2.0, 2 * math.pi, 4 * math.pi**2, -4 * math.pi**2),
}
PRINTED = {"modified-sine": (1.76, 5.53, 69.47), "modified-trapezoidal": (2.0, 4.888, 61.426), "cubic": (1.5, 6, 12)}


@for_each("kind", LAWS)
def test_peaks_of_a_law(kind: str) -> None:
    results = analysed(FOLLOWER.replace("KIND", kind))
    *peaks, midway = LAWS[kind]
    for key, peak, printed in zip(("velocity", "acceleration", "jerk"), peaks, PRINTED.get(kind, peaks), strict=True):
        assert results[f"driver_{key}_max"] == pytest.approx(peak, rel=1e-12), key
        assert results[f"driver_{key}_min"] == pytest.approx(-peak, rel=1e-11), key
        assert peak == pytest.approx(printed, rel=1e-3)
    assert results.value("driver_jerk", 0.5) == pytest.approx(midway, rel=1e-12)
    assert results.value("driver_jerk", 1.5) == 0


def test_the_jerk_of_a_law_with_its_own_travel_and_time() -> None:
    """A cycloidal swing of 30 degrees in 0.2 s: 4 pi^2 h / T^3 at its ends."""
    results = analysed("""
        format = 2
        fixed_points = { O = ["0 mm", "0 mm"], C = ["200 mm", "0 mm"] }
        crank = { pivot = "O", pin = "A", radius = "50 mm" }
        links.coupler = { joins = ["A", "B"], length = "180 mm" }
        links.rocker = { joins = ["C", "B"], length = "120 mm" }
        positions.B = ["150 mm", "110 mm"]
        [driver]
        start = "60 deg"
        jerk = true
        law = [{ kind = "cycloidal", to = "90 deg", over = "0.2 s" }, { kind = "3-4-5", to = "60 deg", over = "0.4 s" }]
    """)
    assert results["driver_angular_jerk_max"] == pytest.approx(4 * math.pi**2 * math.pi / 6 / 0.2**3, rel=1e-12)
