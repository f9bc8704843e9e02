"""A crank of its own mass: its pivot bears it, whatever else turns with it."""

import math

import pytest

import crankwork
from each import for_each

pytestmark = pytest.mark.elsewhere

FILE = """
fixed_points = { O = ["0 mm", "0 mm"], C = ["180 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "1500 rpm"MASS }
links.coupler = { joins = ["A", "B"], length = "200 mm" }
links.rocker = { joins = ["C", "B"], length = "150 mm"OTHER }
method.weights = WEIGHTS
"""


def analysed(mass, other="", *, weights=False):
    """Return the results of a four-bar whose crank has what is written of it."""
    text = FILE.replace("MASS", mass).replace("OTHER", other).replace("WEIGHTS", str(weights).lower())
    return crankwork.analyse(crankwork.read_machine(text))


OWN = ', mass = "2 kg", centre = ["20 mm", "0 mm"]'
W = 1500 * math.pi / 30


def test_its_centrifugal_force_is_at_its_pivot():
    results = analysed(OWN)
    at = [0.0, 77.0, 200.0]
    for degrees in at:
        angle = math.radians(degrees)
        # the ground holds it towards the axis
        assert results.value("joint_force_x.O", degrees) == pytest.approx(-2 * 0.02 * W**2 * math.cos(angle), abs=1e-9)
        assert results.value("joint_force_y.O", degrees) == pytest.approx(-2 * 0.02 * W**2 * math.sin(angle), abs=1e-9)
    assert results.summary["joint_force_max.O"] == pytest.approx(986.96, rel=1e-5)
    assert results.value("reduced_inertia", 0.0) == pytest.approx(2 * 0.02**2, rel=1e-14)


def test_its_weight_turns_it():
    results = analysed(OWN, weights=True)
    for degrees in (0.0, 60.0):
        torque = 2 * 9.80665 * 0.02 * math.cos(math.radians(degrees))
        assert results.value("balancing_torque", degrees) == pytest.approx(torque, rel=1e-12)
    assert not results.unmet


def test_its_inertia_is_about_its_axis():
    whole = OWN + ', inertia = "0.003 kg*m2"'
    assert analysed(whole).value("reduced_inertia", 0.0) == pytest.approx(0.003, rel=1e-14)
    accelerated = analysed(whole + ', angular_acceleration = "40 rad/s2"')
    assert accelerated.value("balancing_torque", 10.0) == pytest.approx(0.12, rel=1e-12)
    assert not accelerated.unmet
    # without a mass it is what it was: of all that turns, and no body
    alone = analysed(', inertia = "0.003 kg*m2"', ', mass = "1 kg", centre = "B"')
    assert alone.machine.drive.inertia == 0.003
    assert [one.link for one in alone.machine.mechanism.bodies] == ["rocker"]


def test_its_force_joins_those_of_the_linkage():
    rocker = ', mass = "1 kg", centre = "B"'
    alone, both = analysed(', inertia = "1e-3 kg*m2"', rocker), analysed(OWN, rocker)
    for degrees in (15.0, 140.0):
        more = both.value("joint_force_x.O", degrees) - alone.value("joint_force_x.O", degrees)
        assert more == pytest.approx(-2 * 0.02 * W**2 * math.cos(math.radians(degrees)), rel=1e-9)
        assert both.value("joint_force_x.A", degrees) == pytest.approx(
            alone.value("joint_force_x.A", degrees), rel=1e-12
        )


@for_each(
    ("mass", "key", "advice"),
    [
        (OWN + ', inertia = "1e-4 kg*m2"', "crank.inertia", "leave it out"),
        (', mass = "2 kg", centre = "Z"', "crank.centre", "O, A"),
    ],
)
def test_what_cannot_be_is_told(mass, key, advice):
    with pytest.raises(crankwork.InputError) as caught:
        analysed(mass)
    assert [one.key for one in caught.value.problems] == [key]
    assert advice in str(caught.value)
