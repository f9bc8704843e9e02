"""Torque, force and heat of friction clutches from their machine files.

R. S. Khurmi, J. K. Gupta: Theory of Machines. S. Chand, New Delhi 2005, chapter 10: a single plate clutch, both sides
effective, 300 and 200 mm, 0.1 N/mm2, friction 0.3, 2500 rpm, transmits 61.693 kW as printed with rounded steps. The
other values follow from integrals over the face and from the balance of momentum and energy, worked here.
"""

import math

import pytest

from crankwork.errors import CrankworkError
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

PLATE = """
format = 2
[clutch]
contact = "CONTACT"
friction = 0.3
outer_diameter = "300 mm"
inner_diameter = "200 mm"
pressure = "0.1 MPa"
driving.speed = "2500 rpm"
"""
SHAFTS = """
format = 2
[clutch]
torque = "150 N*m"
[clutch.driving]
speed = "750 rpm"
mass = "60 kg"
radius_of_gyration = "140 mm"
[clutch.driven]
speed = "90 rpm"
inertia = "0.128 kg*m2"
"""


def _of_rings(is_worn: bool) -> tuple[float, float]:
    """Return force and torque of two faces of 0.1 to 0.15 m, summed over thin rings. [N], [N m]"""
    force = torque = 0.0
    count = 20_000
    for ring in range(count):
        radius = 0.1 + 0.05 * (ring + 0.5) / count
        pressure = 0.1e6 * (0.1 / radius if is_worn else 1.0)
        normal = pressure * 2 * math.pi * radius * 0.05 / count
        force += normal
        torque += 2 * 0.3 * normal * radius
    return force, torque


def test_power_of_a_plate_as_printed() -> None:
    results = analysed(PLATE.replace("CONTACT", "uniform wear"))
    assert results["clutch_power"] == pytest.approx(61_693, rel=2e-4)


@for_each("contact", ["uniform wear", "uniform pressure"])
def test_a_face_is_the_sum_of_its_rings(contact: str) -> None:
    results = analysed(PLATE.replace("CONTACT", contact))
    force, torque = _of_rings(contact == "uniform wear")
    assert results["clutch_force"] == pytest.approx(force, rel=1e-8)
    assert results["clutch_torque"] == pytest.approx(torque, rel=1e-8)
    stated = PLATE.replace("CONTACT", contact).replace('pressure = "0.1 MPa"', f'torque = "{torque!r} N*m"')
    assert analysed(stated)["clutch_pressure"] == pytest.approx(0.1e6, rel=1e-8)


def test_a_cone_presses_by_its_angle() -> None:
    cone = PLATE.replace("CONTACT", "uniform wear") + 'cone_angle = "12 deg"\n'
    force, torque = _of_rings(True)
    # one surface instead of two, with the normal force of the wedge
    results = analysed(cone)
    assert results["clutch_torque"] == pytest.approx(torque / 2 / math.sin(math.radians(12)), rel=1e-8)
    needed = cone.replace('pressure = "0.1 MPa"', f'torque = "{results["clutch_torque"]!r} N*m"')
    assert analysed(needed)["clutch_force"] == pytest.approx(force, rel=1e-8)


@for_each("driven", ["", 'torque = "30 N*m"'])
def test_two_shafts_come_to_one_speed(driven: str) -> None:
    """Stepped in time, with half the error of a step in every step."""
    results = analysed(SHAFTS + driven)
    first, second, load = 750 * math.pi / 30, 90 * math.pi / 30, 30.0 if driven else 0.0
    rates = -150 / (60 * 0.14**2), (150 - load) / 0.128
    time = (first - second) / (rates[1] - rates[0])
    common = first + rates[0] * time
    # work of the load and change of kinetic energy
    before = (60 * 0.14**2 * first**2 + 0.128 * second**2) / 2
    after = (60 * 0.14**2 + 0.128) * common**2 / 2
    heat = before - after - load * (second + common) / 2 * time
    assert results["slip_time"] == pytest.approx(time, rel=1e-12)
    assert results["engaged_speed"] == pytest.approx(common, rel=1e-12)
    assert results["slip_heat"] == pytest.approx(heat, rel=1e-9)


def test_heat_of_momentum_needs_no_torque() -> None:
    without = analysed(SHAFTS.replace('torque = "150 N*m"\n', ""))
    with_torque = analysed(SHAFTS)
    assert without["slip_heat"] == pytest.approx(with_torque["slip_heat"], rel=1e-12)
    assert without["engaged_speed"] == pytest.approx(with_torque["engaged_speed"], rel=1e-12)


def test_a_driving_shaft_that_keeps_its_speed() -> None:
    """As much heat as the driven shaft gains, and twice what a load takes from that."""
    kept = SHAFTS.replace('mass = "60 kg"\nradius_of_gyration = "140 mm"\n', "").replace("90 rpm", "0 rpm")
    kept = kept.replace('speed = "0 rpm"\n', "")
    results = analysed(kept)
    assert results["slip_heat"] == pytest.approx(0.128 * (25 * math.pi) ** 2 / 2, rel=1e-12)
    assert results["engaged_speed"] == pytest.approx(25 * math.pi, rel=1e-12)


@for_each(
    "text",
    [
        SHAFTS + 'torque = "9 kN*m"',
        PLATE.replace("CONTACT", "uniform wear").replace("200 mm", "300 mm"),
        '[clutch]\nforce = "5 N"\n',
        SHAFTS.replace("90 rpm", "900 rpm"),
    ],
)
def test_what_never_engages_is_refused(text: str) -> None:
    with pytest.raises(CrankworkError, match=r"never comes|not below the outer|nothing follows|must be faster"):
        analysed(text)


def test_a_shaft_at_rest_is_brought_to_a_speed_that_is_kept() -> None:
    results = analysed(
        'format = 2\nclutch.torque = "180 N*m"\nclutch.driving.speed = "900 rpm"\n'
        'clutch.driven = { inertia = "1.4 kg*m2", torque = "20 N*m" }\n'
    )
    speed, time = 900 * math.pi / 30, results["slip_time"]
    # momentum of the driven shaft, and what the driving shaft delivers less what the other takes
    assert (180 - 20) * time == pytest.approx(1.4 * speed, rel=1e-12)
    taken = 1.4 * speed**2 / 2 + 20 * speed * time / 2
    assert results["slip_heat"] == pytest.approx(180 * speed * time - taken, rel=1e-12)
