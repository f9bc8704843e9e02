"""Hydraulic cylinders and motion laws, from machine files.

R. C. Hibbeler, A. Gupta: Engineering Mechanics (Statics, Dynamics), chapter 16, example 5: a window that a cylinder
opens. F. P. Beer, E. R. Johnston and others: Vector Mechanics for Engineers, sample problem 10.3, page 501: a lift
table of crossed arms. A. Esposito: Fluid Power with Applications, chapter 6, example 5, page 227: a cylinder on levers
of the three classes. Printed values were read from the public notebooks of the books' examples,
github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, so they are secondary
to the books. Peak factors: reference pages mechdesigner.support/motion-cam-law-cubic.htm and
.../motion-cam-law-modified-sinusoid.htm.
"""

import math

import pytest

import crankwork
from each import for_each
from machine_texts import analysed

LBF, INCH = 4.4482216152605, 0.0254


class TestWindow:
    """A window of 1 m, hinged 2 m from the foot of the cylinder, which extends at 0.5 m/s; at 30 degrees."""

    length = math.sqrt(5 - 4 * math.cos(math.radians(30)))
    results = analysed(f"""
        fixed_points = {{ A = ["0 m", "0 m"], O = ["2 m", "0 m"] }}
        driver.cylinder = ["A", "B"]
        driver.start = "{length!r} m"
        driver.law = [{{ kind = "constant", to = "1.6 m", speed = "0.5 m/s" }}]
        links.window = {{ joins = ["O", "B"], length = "1 m" }}
        positions.B = ["1.13 m", "0.5 m"]
    """)

    def test_the_window_turns_as_printed(self) -> None:
        # the window opens clockwise, away from the cylinder
        velocity = self.results.value("link_angular_velocity.window", at=0.0)
        acceleration = self.results.value("link_angular_acceleration.window", at=0.0)
        assert self.results.value("driver_displacement", at=0.0) == pytest.approx(1.239, abs=0.0012)
        assert -velocity == pytest.approx(0.62, abs=0.0012)
        # the book has rounded the angular velocity before
        assert -acceleration == pytest.approx(-0.416, abs=0.0012)

    def test_nothing_of_a_crank_is_printed(self) -> None:
        assert not any("crank" in key for key in (*self.results.summary, *self.results.columns))


def _lift(d: float) -> crankwork.Results:
    """Return the lift table with its load at a distance from one end: arms of 1.4 m, crossed in their middle."""
    length = math.sqrt(0.7**2 + 3.2**2 - 2 * 0.7 * 3.2 * 0.5)
    return analysed(f"""
        fixed_points = {{ E = ["0 m", "0 m"], H = ["3.2 m", "0 m"] }}
        driver.cylinder = ["H", "D"]
        driver.start = "{length!r} m"
        driver.law = [{{ kind = "constant", to = "{length + 1e-3!r} m", over = "1 min" }}]
        links.arm = {{ joins = ["E", "D"], length = "0.7 m", points = {{ C = ["1.4 m", "0 m"] }} }}
        links.cross = {{ joins = ["D", "F"], length = "0.7 m", points = {{ G = ["-0.7 m", "0 m"] }} }}
        guides.base.through = "E"
        sliders.roller = {{ pin = "F", guide = "base" }}
        links.table = {{ joins = ["C", "P"], length = "{d} m" }}
        guides.top = {{ through = ["0 m", "0 m"], link = "table" }}
        sliders.upper = {{ pin = "G", guide = "top" }}
        branch.table = 1
        positions = {{ D = ["0.35 m", "0.61 m"], F = ["0.7 m", "0 m"] }}
        loads = [{{ kind = "force", point = "P", y = "-4905 N" }}]
    """)


@for_each("d", [0.2, 0.6])
def test_beer_10_3_lift_table(d: float) -> None:
    # half the weight of a crate of 1000 kg is on each side, wherever it stands
    assert _lift(d).value("driver_force", at=0.0) == pytest.approx(5.16e3, rel=2e-3)
    assert _lift(d).value("driver_force", at=0.0) == pytest.approx(5157.17949, rel=1e-7)


@for_each(
    ("cylinder_at", "load_at", "sense", "expected"),
    [(-10.0, 10.0, 1, 1000.0), (20.0, 10.0, 1, 500.0), (10.0, 20.0, 1, 2000.0)],
    ids=["first class", "second class", "third class"],
)
def test_esposito_6_5_levers(cylinder_at: float, load_at: float, sense: int, expected: float) -> None:
    # the cylinder stands upright below the lever, or above it where that is of the first class
    foot = -0.3 if cylinder_at > 0 else 0.3
    results = analysed(f"""
        fixed_points = {{ O = ["0 m", "0 m"], A = ["{cylinder_at * INCH} m", "{foot} m"] }}
        driver.cylinder = ["A", "B"]
        driver.start = "0.3 m"
        driver.law = [{{ kind = "constant", to = "0.301 m", over = "1 min" }}]
        links.lever.joins = ["O", "B"]
        links.lever.length = "{abs(cylinder_at) * INCH} m"
        links.lever.points = {{ L = ["{load_at * INCH * math.copysign(1, cylinder_at)} m", "0 m"] }}
        positions.B = ["{cylinder_at * INCH} m", "0 m"]
        loads = [{{ kind = "force", point = "L", y = "{-1000 * LBF} N" }}]
    """)
    pushed = results.value("driver_force", at=0.0) / LBF
    assert pushed == pytest.approx(expected, rel=1e-9)


@for_each(
    ("kind", "velocity", "acceleration", "tolerance"),
    [("cubic", 1.5, 6.0, 1e-9), ("modified-sine", 1.76, 5.53, 1e-3), ("3-4-5", 1.875, 5.7735, 1e-5)],
)
def test_peak_factors_of_a_driven_slider(kind: str, velocity: float, acceleration: float, tolerance: float) -> None:
    results = analysed(f"""
        fixed_points.O = ["0 mm", "0 mm"]
        driver.slider = "piston"
        driver.law = [
            {{ kind = "{kind}", to = "250 mm", over = "0.4 s" }},
            {{ kind = "dwell", over = "0.2 s" }},
            {{ kind = "{kind}", to = "150 mm", over = "0.8 s" }},
        ]
        guides.line.through = "O"
        sliders.piston = {{ pin = "B", guide = "line" }}
        links.rod = {{ joins = ["B", "A"], length = "180 mm" }}
        links.arm = {{ joins = ["O", "A"], length = "120 mm" }}
    """)
    summary = results.summary
    assert summary["driver_velocity_max"] == pytest.approx(velocity * 0.1 / 0.4, rel=tolerance)
    assert summary["driver_velocity_min"] == pytest.approx(-velocity * 0.1 / 0.8, rel=tolerance)
    assert summary["driver_acceleration_max"] == pytest.approx(acceleration * 0.1 / 0.4**2, rel=tolerance)
    assert summary["slider_stroke.piston"] == pytest.approx(0.1, rel=1e-12)
