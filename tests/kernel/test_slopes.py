"""Derivatives of single values by what a design states: against forty digits, and against differences of values."""

from pathlib import Path

import mpmath
import numpy as np
import pytest

from crankwork.cylinders.load_vectors import bearing_load
from crankwork.formula.traced_value import AngleFunction, Piecewise, ProcedureValue, TracedValue, given
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.gradient import part_key
from crankwork.kinematics.crank_grid import CrankGrid
from varied import Varied

ROOT = Path(__file__).parents[2]
V_TWO = (ROOT / "tests" / "machines" / "v-two.toml").read_text(encoding="utf-8")
PETROL, STIRLING = (
    (ROOT / "examples" / f"{name}.toml").read_text(encoding="utf-8") for name in ("petrol-four", "beta-stirling")
)
WHEELS = [f"flywheel_inertia.{way}" for way in ("energy", "mertsalov", "wittenbauer", "exact")]
SLIDER_CRANK = """
[crank]
radius = "0.05 m"
speed = "270.0 rad/s"
[rod]
length = "0.19 m"
"""


def kernel(file, fields, keys, **asked):
    """Return a kernel of fields at the values that a file states, and those values."""
    varied = Varied(file, fields)
    return varied.kernel(keys, is_for_few=True, **asked), varied.middle


def of_known(trace, rows, keys):
    """Return a kernel of numbers that are given."""
    traces = [trace(*one) for one in rows]
    return Kernel(traces, np.array(rows), keys, CrankGrid.from_degrees, cycle=360.0, is_for_few=True)


def slopes(of, design):
    """Return values and derivatives by key."""
    return [dict(zip(of.keys, one.tolist(), strict=True)) for one in of.slopes(design)]


def differences(of, stated, at, part=1e-3):
    """Return how values change with a field: differences of the fourth order."""
    designs = stated[:, None] * np.ones(4)
    steps = np.array([-2, -1, 1, 2]) * part * stated[at]
    designs[at] += steps
    low_2, low, high, high_2 = of(designs).values.T
    return dict(zip(of.keys, (8 * (high - low) - (high_2 - low_2)) / (12 * steps[2]), strict=True))


@pytest.mark.elsewhere
def test_extremes_and_their_angles_change_as_with_forty_digits():
    fields = ["crank.radius", "rod.length", "crank.speed"]
    of, stated = kernel(SLIDER_CRANK, fields, ["piston_velocity_max", "piston_velocity_max_angle"])
    _, found = slopes(of, stated)

    def velocity(angle, r, l, w):  # noqa: E741 - the length of a rod
        s, c = mpmath.sin(angle), mpmath.cos(angle)
        return r * w * (s + r * s * c / mpmath.sqrt(l**2 - (r * s) ** 2))

    def peak(*design):
        return mpmath.findroot(lambda a: mpmath.diff(lambda b: velocity(b, *design), a), mpmath.mpf("1.3"))

    with mpmath.workdps(40):
        design = [mpmath.mpf(one) for one in stated]
        for at in range(3):
            order = tuple(int(one == at) for one in range(3))
            largest = mpmath.diff(lambda *one: velocity(peak(*one), *one), design, order)
            angle = mpmath.diff(peak, design, order)
            assert found["piston_velocity_max"][at] == pytest.approx(float(largest), rel=1e-12)
            assert found["piston_velocity_max_angle"][at] == pytest.approx(float(angle), rel=1e-9, abs=1e-12)


@pytest.mark.elsewhere
def test_a_mean_and_how_far_an_integral_goes_change_as_with_forty_digits():
    """Columns of two numbers given: a sin phi (2 + cos phi) + b sin^2 phi, and a vector that vanishes once."""

    def trace(a, b):
        sin, cos = TracedValue(AngleFunction("sin")), TracedValue(AngleFunction("cos"))
        a, b = given("a", a, "a"), given("b", b, "b")
        column = a * sin * (cos + 2.0) + b * sin * sin
        found = {word: TracedValue(ProcedureValue(1.0, word, (column,)), word) for word in ("mean", "range")}
        length = bearing_load(a * sin, b * (cos + 1.0))
        return found | {"length": TracedValue(ProcedureValue(1.0, "mean", (length,)), "length")}

    rows = [(2.0, 1.0), (1.9, 1.0), (2.1, 1.0), (2.0, 0.9), (2.0, 1.1)]
    of = of_known(trace, rows, ["mean", "range", "length"])
    found, by = slopes(of, np.array([2.0, 1.0]))

    def excess(a, b):
        def column(x):
            return a * mpmath.sin(x) * (mpmath.cos(x) + 2) + b * (mpmath.sin(x) ** 2 - mpmath.mpf("0.5"))

        ends = [mpmath.findroot(column, start) for start in (mpmath.mpf("0.1"), mpmath.mpf("3.3"))]
        return mpmath.quad(column, ends)

    def length(a, b):
        ends = [0, mpmath.pi]
        return mpmath.quad(lambda x: mpmath.hypot(a * mpmath.sin(x), b * (mpmath.cos(x) + 1)), ends) / mpmath.pi

    with mpmath.workdps(40):
        point = mpmath.mpf(2), mpmath.mpf(1)
        assert found["range"] == pytest.approx(float(excess(*point)), rel=1e-13)
        assert found["length"] == pytest.approx(float(length(*point)), rel=1e-13)
        for at, order in enumerate([(1, 0), (0, 1)]):
            assert by["range"][at] == pytest.approx(float(mpmath.diff(excess, point, order)), rel=1e-12)
            assert by["length"][at] == pytest.approx(float(mpmath.diff(length, point, order)), rel=1e-12)
    assert by["mean"] == pytest.approx([0.0, 0.5], rel=1e-15, abs=1e-15)


ENGINE_KEYS = [
    "piston_force_max", "side_force_min", "tangential_force_max_angle", "mean_torque", "flywheel_inertia",
    "total_torque_max", "mean_crankpin_load",
]  # fmt: skip
CYCLE_KEYS = [
    "gas_pressure_max", "piston_force_max", "piston_force_max_angle", "mean_torque", "total_torque_min", "excess_work",
    "mean_crankpin_load", "crankpin_load_max",
]  # fmt: skip


def test_derivatives_are_those_of_differences():
    wrong = {}
    for file, fields, keys in (
        (V_TWO, ["crank.radius", "rod.length", "crank.speed", "piston.mass"], ENGINE_KEYS),
        ("four-bar", ["crank.radius", "links.coupler.length", "links.rocker.mass"],
         ["joint_force_max.B", "joint_force_max_angle.B", "driving_torque_min", "time_ratio.rocker"]),
        (STIRLING, ["crank.radius", "crank.speed"], WHEELS),
        # laws end where the design says
        (PETROL, ["cylinder.compression_ratio", "cycle.excess_air"], CYCLE_KEYS),
    ):  # fmt: skip
        of, stated = kernel(file, fields, keys)
        values, found = slopes(of, stated)
        for at, field in enumerate(fields):
            for key, expected in differences(of, stated, at).items():
                size = max(abs(expected), abs(values[key] / stated[at]))
                if found[key][at] != pytest.approx(expected, abs=2e-8 * size):
                    wrong[key, field] = found[key][at], expected
    assert wrong == {}


def test_the_largest_of_parts_is_that_of_the_cycle_and_changes_as_it():
    keys = ["tangential_force_max", "tangential_force_min"]
    of, stated = kernel(V_TWO, ["crank.radius", "piston.mass"], keys, parts=16)
    for design in (0.99 * stated, stated):
        values, found = slopes(of, design)
        for key, best in zip(keys, (np.max, np.min), strict=True):
            parts = np.array([values[part_key(key, at)] for at in range(16)])
            assert best(parts) == values[key]
            assert found[part_key(key, int(np.argmin(np.abs(parts - values[key]))))] == found[key]


def test_a_peak_at_the_end_of_a_law_goes_with_it():
    """A slope that is cut off at an angle b: its top a sin b, its mean a (1 - cos b) / 2 pi."""

    def trace(a, b):
        laws = given("a", a, "a") * TracedValue(AngleFunction("sin")), given("none", 0.0)
        end = given("b", b, "b")
        y = TracedValue(Piecewise([end, 360.0], laws), "y")
        return {word: TracedValue(ProcedureValue(1.0, word, (y,)), word) for word in ("max", "max_angle", "mean")}

    rows = [(2.0, 60.0), (1.9, 60.0), (2.1, 60.0), (2.0, 59.0), (2.0, 61.0)]
    of = of_known(trace, rows, ["max", "max_angle", "mean"])
    sin, cos, degree = np.sqrt(0.75), 0.5, np.pi / 180
    _, found = slopes(of, np.array([2.0, 60.0]))
    assert found["max"] == pytest.approx([sin, 2 * cos * degree], rel=1e-12)
    assert found["max_angle"] == pytest.approx([0.0, degree], rel=1e-12)
    assert found["mean"] == pytest.approx([(1 - cos) / (2 * np.pi), 2 * sin * degree / (2 * np.pi)], rel=1e-12)
