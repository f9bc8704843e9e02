"""Optima against closed forms and plain searches, what holds them, and what cannot be asked."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy import optimize as scipy_optimize

import crankwork
from crankwork.errors import CrankworkError

pytestmark = pytest.mark.usefixtures("by_arrays")
SLIDER_CRANK = crankwork.template("slider-crank")
FOUR_BAR = crankwork.template("four-bar")
V_TWO = (Path(__file__).parents[1] / "machines" / "v-two.toml").read_text(encoding="utf-8")
SIZES = {"rod.length": ("150 mm", "220 mm"), "crank.radius": ("30 mm", "60 mm")}


def of(file, *asked, **more):
    return crankwork.optimise(crankwork.Description(file), *asked, **more)


@pytest.mark.elsewhere
@pytest.mark.parametrize("way", ["slsqp", "trust-constr", "evolution"])
def test_the_least_acceleration_of_a_stroke(way):
    """The acceleration at top dead centre, r w^2 (1 + r/l), is least with the longest rod and the shortest crank."""
    found = of(SLIDER_CRANK, "piston_acceleration_max", SIZES, limits=["stroke >= 90 mm"], way=way)
    w, r, rod = found.results.summary["speed"], 0.045, 0.22
    assert found.fields == {"rod.length": pytest.approx(rod, rel=1e-9), "crank.radius": pytest.approx(r, rel=1e-8)}
    assert found.value == pytest.approx(r * w**2 * (1 + r / rod), rel=1e-8)
    assert found.gradient["crank.radius"] == pytest.approx(w**2 * (1 + 2 * r / rod), rel=1e-9)
    assert found.gradient["rod.length"] == pytest.approx(-((r * w / rod) ** 2), rel=1e-9)
    # what a longer stroke and a longer rod would change
    held = {(one.key, one.sense): one.price for one in found.holding}
    assert held == {
        ("stroke", ">="): pytest.approx(w**2 / 2 * (1 + 2 * r / rod), rel=1e-8),
        ("rod.length", "<="): pytest.approx(-((r * w / rod) ** 2), rel=1e-8),
    }
    assert found.rest < 1e-8
    assert not found.reason


@pytest.mark.elsewhere
def test_the_stroke_is_least_without_an_offset():
    found = of(SLIDER_CRANK, "stroke", {"cylinder.offset": ("-20 mm", "30 mm")})
    assert found.fields["cylinder.offset"] == pytest.approx(0.0, abs=1e-8 * 0.05)
    assert found.holding == ()


def time_ratio(crank, coupler, rocker, ground):
    """Return the slower stroke of the rocker over the faster one, of the positions with crank and coupler in line."""
    out, back = (
        math.acos((side**2 + ground**2 - rocker**2) / (2 * side * ground))
        for side in (coupler + crank, coupler - crank)
    )
    way = math.pi + abs(out - back)
    return way / (2 * math.pi - way)


@pytest.mark.elsewhere
def test_a_four_bar_for_a_time_ratio():
    found = of(FOUR_BAR, "joint_force_max.B", {"links.coupler.length": ("120 mm", "200 mm")},
               limits=["time_ratio.rocker = 1.2"])  # fmt: skip
    expected = scipy_optimize.brentq(lambda one: time_ratio(0.0625, one, 0.1125, 0.2) - 1.2, 0.1500001, 0.2, xtol=1e-15)
    assert found.fields["links.coupler.length"] == pytest.approx(expected, rel=1e-8)
    assert not found.reason


@pytest.mark.elsewhere
def test_half_of_the_reciprocating_masses_balances_a_v_of_90_degrees():
    """Of both cylinders of a throw (taylor_1985, vol. 2, ch. 8): the force of the first order turns with the crank."""
    file = V_TWO.replace("shafts = [1]", "reciprocating_share = 0.2\nrotating_share = 1.0")
    file = file.replace('counterweight = "0.02 kg*m"\n', "")
    found = of(file, "free_force.residual.1", {"balance.reciprocating_share": (0.0, 1.0)})
    assert found.fields["balance.reciprocating_share"] == pytest.approx(0.5, abs=1e-8)
    assert not found.reason


@pytest.mark.elsewhere
def test_the_least_peak_stands_where_two_peaks_are_level():
    """The gas pushes the crankpin where it fires, and inertia where gases change: the speed that makes them equal."""
    bounds = {"crank.speed": ("1000 rpm", "6000 rpm")}
    found, stated = of(V_TWO, "crankpin_load_max", bounds), crankwork.Description(V_TWO)

    def peak(speed):
        return crankwork.analyse(stated.machine([f"crank.speed={float(speed)!r} rad/s"])).summary[found.objective]

    near = [peak(found.fields["crank.speed"] * factor) for factor in (1 - 1e-6, 1.0, 1 + 1e-6)]
    assert near[1] < min(near[0], near[2])
    # to either side it rises along another peak
    slopes = np.diff(near) / (1e-6 * found.value)
    assert slopes[0] < -0.1
    assert slopes[1] > 0.1
    plain = scipy_optimize.minimize_scalar(
        peak, bounds=(400, 500), method="bounded", options={"xatol": 1e-3, "maxiter": 25}
    )
    assert plain.fun * (1 - 1e-4) < found.value <= plain.fun * (1 + 1e-12)
    assert found.rest < 1e-8


def test_the_same_seed_gives_the_same_and_tells_what_was_looked_at():
    bounds = {"rod.length": ("150 mm", "220 mm")}
    one, two = (of(SLIDER_CRANK, "piston_velocity_max", bounds, seed=3, sense="largest") for _ in range(2))
    assert one.fields == two.fields == {"rod.length": 0.15}
    assert (list(one.history.fields), list(one.history.values)) == (["rod.length"], ["piston_velocity_max"])
    np.testing.assert_array_equal(one.history.fields["rod.length"], two.history.fields["rod.length"])
    looked = one.history.values["piston_velocity_max"]
    np.testing.assert_array_equal(looked, two.history.values["piston_velocity_max"])
    assert looked.max() == pytest.approx(one.value, rel=1e-12)


def test_what_cannot_be_asked_is_refused():
    start, wrong = {"start": {"rod.length": "10 mm"}}, []
    for of_what, bounds, more, told in (
        ("piston_acc", SIZES, {}, "there is no result piston_acc"),
        ("piston_velocity", SIZES, {}, "piston_velocity_max"),
        ("stroke", {"crank.raduis": (1, 2)}, {}, "radius"),
        ("stroke", {"crank.radius": ("60 mm", "30 mm")}, {}, "smaller bound first"),
        ("stroke", {"crank.radius": ("60 kg", "30 mm")}, {}, "crank.radius"),
        ("stroke", SIZES, {"limits": ["stroke > 3"]}, "<=, >= or ="),
        ("stroke", SIZES, {"limits": ["stroke >= 3 kg"]}, "stroke"),
        ("stroke", SIZES, {"limits": ["strok >= 3 mm"]}, "stroke"),
        ("stroke", SIZES, {"way": "luck"}, "slsqp"),
        ("stroke", SIZES, start, "take a value between these"),
        ("stroke", {"rod.length": ("5 mm", "200 mm")}, start, "the start is no machine"),
        ("stroke", {"rod.length": ("5 mm", "40 mm")}, {}, "101 designs between the bounds"),
    ):
        with pytest.raises(CrankworkError) as refused:
            of(SLIDER_CRANK, of_what, bounds, **more)
        if told not in str(refused.value):
            wrong.append((told, str(refused.value)))
    assert wrong == []


@pytest.mark.slow
def test_limits_that_contradict_each_other_are_told_with_what_comes_nearest():
    with pytest.raises(CrankworkError, match=r"where they are missed least, .* is wanted") as told:
        of(SLIDER_CRANK, "piston_acceleration_max", SIZES, limits=["stroke >= 90 mm", "stroke <= 60 mm"])
    # both by the same part of themselves
    assert "75 mm" in str(told.value)
