"""Peak factors of the normalised motion laws, as handbooks and a design program print them.

Polynomials, cycloid, modified sine and modified trapezoid: R. L. Norton, Design of Machinery, 5th ed., McGraw-Hill,
New York 2012, chapter 8, table 8-3; the same in J. J. Uicker, G. R. Pennock, J. E. Shigley, Theory of Machines and
Mechanisms, 4th ed., Oxford 2011, chapter 6, and VDI 2143. Cubic and modified sine once more as the reference pages of
MechDesigner print them, mechdesigner.support/motion-cam-law-cubic.htm and .../motion-cam-law-modified-sinusoid.htm.
Velocity is counted in way over time, acceleration in way over its square, jerk in way over its cube.
"""

import math

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion_laws import law_at
from crankwork.mechanism.driver import Law, Segment
from each import for_each

PERIOD, WAY, SHARE = 3.0, 0.4, 0.5


def normalised(kind: str, degrees: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return velocity and acceleration of a rise in the first half of the period, over way and time."""
    law = Law((Segment(kind, WAY, SHARE), Segment("dwell", WAY, 1 - SHARE)), PERIOD, 0.0)
    _, velocity, acceleration = law_at(law, CrankGrid.from_degrees(degrees))
    lasts = PERIOD * SHARE
    return velocity * lasts / WAY, acceleration * lasts**2 / WAY


RISE = np.linspace(0.0, 180.0, 36001)


@for_each(
    ("kind", "velocity", "acceleration"),
    [
        ("parabolic", 2.0, 4.0),
        ("harmonic", 1.571, 4.935),
        ("cubic", 1.5, 6.0),
        ("3-4-5", 1.875, 5.7735),
        ("4-5-6-7", 2.1875, 7.5132),
        ("cycloidal", 2.0, 2 * math.pi),
        ("modified-sine", 1.7596, 5.5280),
        ("modified-trapezoidal", 2.0, 4.8881),
    ],
)
def test_peak_factors(kind: str, velocity: float, acceleration: float) -> None:
    v, a = normalised(kind, RISE)
    assert np.max(v) == pytest.approx(velocity, rel=3e-4 if kind == "harmonic" else 2e-5)
    assert np.max(np.abs(a)) == pytest.approx(acceleration, rel=3e-4 if kind == "harmonic" else 2e-5)


def test_cubic_of_a_design_program() -> None:
    v, a = normalised("cubic", RISE[1:])
    assert (np.max(v), np.max(a)) == pytest.approx((1.5, 6.0), rel=2e-4)
    # the page prints the jerk without its sign
    assert -np.diff(a) / np.diff(RISE[1:] / 180) == pytest.approx(12.0, rel=1e-6)


def test_modified_sine_of_a_design_program() -> None:
    v, a = normalised("modified-sine", RISE)
    assert (np.max(v), np.max(a)) == pytest.approx((1.76, 5.53), rel=1e-3)
    jerk = np.diff(a) / np.diff(RISE / 180)
    assert jerk[0] == pytest.approx(69.47, rel=1e-3)
    assert jerk[jerk.size // 2] == pytest.approx(-23.15, rel=1e-3)
    # between its peaks it is a sine over 180 degrees: a quarter on from the first, and half way between them
    _, a = normalised("modified-sine", np.array([22.5, 56.25, 90.0]))
    assert a / 5.52796 == pytest.approx([1.0, math.sqrt(0.5), 0.0], abs=1e-5)


@for_each(("kind", "jerk_first"), [("3-4-5", 60.0), ("cycloidal", 4 * math.pi**2), ("modified-trapezoidal", 61.43)])
def test_jerk_at_the_start(kind: str, jerk_first: float) -> None:
    _, a = normalised(kind, RISE)
    assert np.diff(a)[0] / np.diff(RISE / 180)[0] == pytest.approx(jerk_first, rel=1e-3)
