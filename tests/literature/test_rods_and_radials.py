"""Rods as masses with the same inertia, pendulum tests, and radial engines, each from its machine file.

R. S. Khurmi, J. K. Gupta: Theory of Machines, ch. 15, and T. Bevan: The Theory of Machines, ch. 14, as recalculated in
github.com/FOSSEE/Python-Textbook-Companions; the second radial engine is the problem of Fig. 12.43 of holooly.com.
"""

import math

import pytest

from crankwork.errors import InputError
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere
POUND, INCH, GRAVITY = 0.45359237, 0.0254, 32.2 * 12 * 0.0254

SWUNG = """
format = 2
crank = { radius = "0.2 m", speed = "200 rpm" }
method.gravity = "9.81 m/s2"
[rod]
length = "0.85 m"
mass = "55 kg"
pendulum.small_end_period = "1.83 s"
pendulum.big_end_period = "1.68 s"
pendulum.small_end_diameter = "75 mm"
pendulum.big_end_diameter = "100 mm"
equivalent = """


def test_a_rod_that_swung_on_both_bores() -> None:
    """Khurmi 15.17: k = 0.345 m, 6.56 kg m2, 13.32 and 41.68 kg."""
    results = analysed(f'{SWUNG}"two masses"')
    worked = {
        "rod_inertia": (6.555248, 5.1e-7), "equivalent_mass.small_end": (13.315431, 5.1e-7),
        "equivalent_mass.other": (41.684569, 5.1e-7), "equivalent_distance": (0.195121, 5.1e-7),
    }  # fmt: skip
    for key, (value, tolerance) in worked.items():
        assert results[key] == pytest.approx(value, abs=tolerance), key
    assert math.sqrt(results["rod_inertia"] / 55) == pytest.approx(0.345234, abs=5.1e-7)


def test_a_rod_as_two_masses() -> None:
    """Khurmi 15.15: 0.17 and 14.83 kg, 2.33 mm; its inertia is that of a much shorter rod."""
    results = analysed("""
        format = 2
        crank = { radius = "50 mm", speed = "200 rpm" }
        [rod]
        length = "300 mm"
        mass = "15 kg"
        centre_of_mass = "100 mm"
        inertia = "7000 kg*mm2"
        equivalent = "two masses"
    """)
    assert results["equivalent_mass.small_end"] == pytest.approx(0.172981878089, abs=5e-13)
    assert results["equivalent_mass.other"] == pytest.approx(14.8270181219, abs=5e-11)
    assert results["equivalent_distance"] == pytest.approx(2.33333333333e-3, abs=5e-15)


ENGINE = """
format = 2
crank = { radius = "0.3 m", speed = "125 rpm" }
cylinder = { bore = "300 mm", inclination = "90 deg" }
piston.mass = "300 kg"
method = { weights = true, gravity = "9.81 m/s2", rod = "rigid", kinematics = "KINEMATICS" }
[rod]
length = "1.5 m"
mass = "250 kg"
centre_of_mass = "0.5 m"
radius_of_gyration = "0.65 m"
equivalent = "three masses"
"""


def test_inertia_torque_with_the_rod_as_a_body() -> None:
    """Khurmi 15.20: 3840 N m with the weight of the rod; the exact torque of the inertia is 3415.7234 N m."""
    exact = analysed(ENGINE.replace("KINEMATICS", "exact"), 30, 330)["crank_torque"]
    assert (exact[1] - exact[0]) / 2 == pytest.approx(3415.7234, abs=5.1e-5)
    assert exact[1] == pytest.approx(3840, abs=5)
    book = analysed(ENGINE.replace("KINEMATICS", "textbook"), 30, 330)["crank_torque"]
    # the book takes 3352.37 of piston and ends, 57.50 of the couple and 424.785 of the weight
    assert (book[1] - book[0]) / 2 == pytest.approx(3352.37 + 57.50, abs=0.3)
    assert (book[1] + book[0]) / 2 == pytest.approx(424.785, abs=5.1e-4)


def test_three_masses_have_the_inertia_of_the_rod() -> None:
    """Those of 15.20: mass, centre and moment of inertia, 250 kg at 0.5 and 1 m from the ends."""
    results = analysed(ENGINE.replace("KINEMATICS", "exact"))
    small, big, centre = (results[f"equivalent_mass.{place}"] for place in ("small_end", "big_end", "centre"))
    assert small + big + centre == pytest.approx(250, rel=1e-14)
    assert small * 1.0 == pytest.approx(big * 0.5, rel=1e-14)
    assert small * 1.0**2 + big * 0.5**2 == pytest.approx(250 * 0.65**2, rel=1e-14)


def test_periods_of_no_rod_are_refused() -> None:
    with pytest.raises(InputError, match="centre of mass would not lie"):
        analysed(f'{SWUNG}"two masses"'.replace("1.83 s", "0.2 s"))
    with pytest.raises(InputError, match="needs inertia"):
        analysed("""
            format = 2
            crank = { radius = "50 mm", speed = "200 rpm" }
            rod = { length = "300 mm", mass = "15 kg", centre_of_mass = "100 mm", equivalent = "two masses" }
        """)


RADIAL = """
format = 2
crank = { stroke = "STROKE", speed = "SPEED" }
cylinder.bore = "100 mm"
rod = { length = "ROD", mass = "0 kg", small_end_share = 0.5 }
piston.mass = "MASS"
engine = { layout = "radial", cylinders = 3, firing_order = [1, 3, 2] }
method.kinematics = "textbook"
"""


def _radial(**values: str) -> str:
    text = RADIAL
    for word, value in values.items():
        text = text.replace(word, value)
    return text


def test_a_radial_engine_by_direct_and_reverse_cranks() -> None:
    """Fig. 12.43: 120 mm stroke, 240 mm rods, 1 kg, 2400 rpm; primary 5684.892 N, secondary 1421.223 N."""
    results = analysed(_radial(STROKE="120 mm", ROD="240 mm", MASS="1 kg", SPEED="2400 rpm"))
    assert results["free_force.reciprocating.1"] == pytest.approx(5684.89213503, abs=5e-8)
    assert results["free_force.reciprocating.2"] == pytest.approx(1421.22303376, abs=5e-8)


def test_a_radial_engine_and_its_counterweight() -> None:
    """Bevan 14.12: 1500 rpm, 4 lb, stroke 5 in, rod 9 in; 4.29 lb at 3.5 in, and 266 lbf of the second order."""
    results = analysed(
        _radial(STROKE="5 in", ROD="9 in", MASS="4 lb", SPEED="1500 rpm") + "balance.reciprocating_share = 0.5"
    )
    moment = results["best_counterweight_moment"]
    assert moment / (3.5 * INCH) / POUND == pytest.approx(4.285714, abs=5.1e-7)
    assert results["free_force.reciprocating.2"] / POUND / GRAVITY == pytest.approx(266.0672, abs=5.1e-5)
    assert results["free_force.residual.2"] == pytest.approx(results["free_force.reciprocating.2"], rel=1e-12)
