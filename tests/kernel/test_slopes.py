"""Derivatives of single values by what a design states: against forty digits, and against differences of values."""

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.slopes import by_field, in_part
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.study.sought import sought_number

MACHINES = Path(__file__).parents[1] / "machines"
V_TWO = (MACHINES / "v-two.toml").read_text(encoding="utf-8")
FOUR_BAR = crankwork.template("four-bar")
STIRLING = (MACHINES.parents[1] / "examples" / "beta-stirling.toml").read_text(encoding="utf-8")
WHEELS = [f"flywheel_inertia.{way}" for way in ("energy", "mertsalov", "wittenbauer", "exact")]
RADIUS, LENGTH, SPEED = 0.05, 0.19, 270.0
SLIDER_CRANK = f"""
[crank]
radius = "{RADIUS} m"
speed = "{SPEED} rad/s"
[rod]
length = "{LENGTH} m"
"""


def kernel(file, fields, keys, **asked):
    """Return a kernel of fields at the values that a file states, and those values."""
    d = crankwork.Description(file)
    numbers = [sought_number(d.values, key) for key in fields]
    middle = np.array([one.now for one in numbers])
    rows = [middle]
    for at in range(len(fields)):
        rows += [np.where(np.arange(len(fields)) == at, factor * middle, middle) for factor in (0.98, 1.02)]
    found = [
        crankwork.analyse(
            d.machine([f"{key}={one.written(x)}" for key, one, x in zip(fields, numbers, row, strict=True)])
        )
        for row in rows
    ]
    memories = [one.memory for one in found]
    asked = {"is_for_few": True, "is_sloped": True} | asked
    return Kernel(memories, np.array(rows), keys, CrankGrid.from_degrees, cycle=found[0].machine.cycle, **asked), middle


def values(of, designs):
    return dict(zip(of.keys, of(designs).values, strict=True))


@pytest.mark.elsewhere
def test_extremes_and_their_angles_change_as_with_forty_digits():
    mpmath = pytest.importorskip("mpmath")
    fields = ["crank.radius", "rod.length", "crank.speed"]
    of, stated = kernel(SLIDER_CRANK, fields, ["piston_velocity_max", "piston_velocity_max_angle"])
    found = values(of, stated[:, None])

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
            assert found[by_field("piston_velocity_max", at)][0] == pytest.approx(float(largest), rel=1e-12)
            assert found[by_field("piston_velocity_max_angle", at)][0] == pytest.approx(
                float(angle), rel=1e-9, abs=1e-12
            )


@pytest.mark.elsewhere
def test_a_mean_and_how_far_an_integral_goes_change_as_with_forty_digits():
    """A column of two numbers given: a sin phi (2 + cos phi) + b sin^2 phi."""
    mpmath = pytest.importorskip("mpmath")
    from crankwork.formula.known import Found, Known, OfAngle, given

    def memory(a, b):
        sin, cos = Known(OfAngle("sin")), Known(OfAngle("cos"))
        column = given("a", a, "a") * sin * (cos + 2.0) + given("b", b, "b") * sin * sin
        return {word: Known(Found(1.0, word, (column,)), word) for word in ("mean", "range")}

    rows = [(2.0, 1.0), (1.9, 1.0), (2.1, 1.0), (2.0, 0.9), (2.0, 1.1)]
    of = Kernel([memory(*one) for one in rows], np.array(rows), ["mean", "range"], CrankGrid.from_degrees,
                cycle=360.0, is_sloped=True, is_for_few=True)  # fmt: skip
    found = values(of, np.array([[2.0], [1.0]]))

    def excess(a, b):
        def column(x):
            return a * mpmath.sin(x) * (mpmath.cos(x) + 2) + b * (mpmath.sin(x) ** 2 - mpmath.mpf("0.5"))

        ends = [mpmath.findroot(column, start) for start in (mpmath.mpf("0.1"), mpmath.mpf("3.3"))]
        return mpmath.quad(column, ends)

    with mpmath.workdps(40):
        point = mpmath.mpf(2), mpmath.mpf(1)
        assert found["range"][0] == pytest.approx(float(excess(*point)), rel=1e-13)
        for at, order in enumerate([(1, 0), (0, 1)]):
            expected = mpmath.diff(excess, point, order)
            assert found[by_field("range", at)][0] == pytest.approx(float(expected), rel=1e-12)
    assert found[by_field("mean", 0)][0] == pytest.approx(0.0, abs=1e-15)
    assert found[by_field("mean", 1)][0] == pytest.approx(0.5, rel=1e-15)


ENGINE_KEYS = ["piston_force_max", "side_force_min", "tangential_force_max_angle", "mean_torque", "flywheel_inertia"]


@pytest.mark.parametrize(
    ("file", "fields", "keys"),
    [
        (V_TWO, ["crank.radius", "rod.length", "crank.speed", "piston.mass"], ENGINE_KEYS),
        (FOUR_BAR, ["crank.radius", "links.coupler.length", "links.rocker.mass"],
         ["joint_force_max.B", "joint_force_max_angle.B", "driving_torque_min", "time_ratio.rocker"]),
        (STIRLING, ["crank.radius", "crank.speed"], WHEELS),
    ],
)  # fmt: skip
def test_derivatives_are_those_of_differences(file, fields, keys):
    of, stated = kernel(file, fields, keys)
    plain, _ = kernel(file, fields, keys, is_sloped=False)
    found = values(of, stated[:, None])
    for at in range(len(fields)):
        designs = stated[:, None] * np.ones(4)
        steps = np.array([-2, -1, 1, 2]) * 1e-3 * stated[at]
        designs[at] += steps
        by_key = values(plain, designs)
        for key in keys:
            low_2, low, high, high_2 = by_key[key]
            expected = (8 * (high - low) - (high_2 - low_2)) / (12 * steps[2])
            size = max(abs(expected), abs(found[key][0] / stated[at]))
            assert found[by_field(key, at)][0] == pytest.approx(expected, abs=2e-8 * size), (key, fields[at])


def test_the_largest_of_parts_is_that_of_the_cycle_and_changes_as_it():
    keys = ["tangential_force_max", "tangential_force_min"]
    of, stated = kernel(V_TWO, ["crank.radius", "piston.mass"], keys, parts=16)
    found = values(of, stated[:, None] * np.array([0.99, 1.0]))
    for key, best in zip(keys, (np.max, np.min), strict=True):
        parts = np.array([found[in_part(key, at)] for at in range(16)])
        np.testing.assert_array_equal(best(parts, axis=0), found[key])
        for design in (0, 1):
            at = int(np.argmin(np.abs(parts[:, design] - found[key][design])))
            for field in (0, 1):
                assert found[by_field(in_part(key, at), field)][design] == found[by_field(key, field)][design]


def test_compiled_loops_give_the_derivatives_that_arrays_give(monkeypatch, tmp_path):
    pytest.importorskip("numba")
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    asked = FOUR_BAR, ["crank.radius", "crank.speed"], ["joint_force_max.B"]
    few, stated = kernel(*asked)
    many, _ = kernel(*asked, is_for_few=False)
    designs = stated[:, None] * np.linspace(0.99, 1.01, 70)
    np.testing.assert_allclose(many(designs).values, few(designs).values, rtol=1e-10)
