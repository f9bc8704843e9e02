"""A disc clutch that brings an inertia to speed: U. C. Jindal, Machine Design, ex. 22.1.

As recalculated in github.com/FOSSEE/Python-Textbook-Companions: 300 rpm, 7.2 kg m2, uniform wear with 0.1 MPa between
70 and 110 mm, friction 0.28; 44.33 N m of one face, 6.16 rad/s2, 5.1 s and 3553.06 J. The torque of the
clutch stands in the file; time and angle of the slip are found, and the heat follows from them here.
"""

import math

import pytest

from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

STARTED = """
format = 2
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "50 mm", inertia = "7.2 kg*m2" }
links.rod = { joins = ["A", "B"], length = "200 mm" }
guides.bed = { angle = "0 deg" }
sliders.ram = { guide = "bed", pin = "B" }
positions.B = ["250 mm", "0 mm"]
transient = { time = "6 s", torque = "TORQUE N*m", speeds = ["300 rpm"], step = "0.1 s" }
"""


@pytest.mark.parametrize("faces", [1, 2])
def test_slip_of_a_clutch(faces: int) -> None:
    """With both faces half of the time, and the same heat, that of the inertia at speed."""
    force = 2 * math.pi * 0.1e6 * 0.07 * 0.04
    torque = faces * 0.28 * force * 0.09
    results = analysed(STARTED.replace("TORQUE", repr(torque)))
    assert torque / faces == pytest.approx(44.3341555275, abs=5e-10)
    met = results.listings["transient_events"].columns
    time, angle = met["time"][0], met["crank_angle"][0]
    assert time == pytest.approx(5.10204081633 / faces, rel=1e-9)
    assert results.listings["transient"].columns["angular_acceleration"][1] == pytest.approx(
        6.15752160104 * faces, rel=1e-9
    )
    speed = 10 * math.pi
    assert torque * (speed * time - angle) == pytest.approx(3553.05758439, rel=1e-9)
    assert torque * angle == pytest.approx(7.2 * speed**2 / 2, rel=1e-9)
