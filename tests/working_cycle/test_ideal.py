"""Ideal cycles: closed forms, energy, and the limits in which one becomes another."""

from dataclasses import replace

import mpmath
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.ideal import IdealData, ideal_cycle
from each import for_each

pytestmark = pytest.mark.elsewhere

RATIOS = st.floats(4.0, 24.0)
GAMMAS = st.floats(1.2, 1.6)
HEATS = st.floats(1e5, 3e6)
OTTO = IdealData("otto", 8.0, 1e5, 300.0, heat=1e6)
DIESEL = IdealData("ideal-diesel", 18.0, 1e5, 300.0, heat=1e6)
DUAL = IdealData("dual", 16.0, 1e5, 300.0, heat=1.2e6, pressure_ratio=1.4)


@given(ratio=RATIOS, gamma=GAMMAS, heat=HEATS, kind=st.sampled_from([OTTO, DIESEL, DUAL]))
def test_work_over_heat_is_the_closed_form(ratio, gamma, heat, kind):
    data = replace(kind, compression_ratio=ratio, adiabatic_exponent=gamma, heat=heat)
    try:
        values = ideal_cycle(data).values
    except CycleError:
        reject()
    assert values["thermal_efficiency"] == pytest.approx(values["thermal_efficiency.closed"], rel=1e-9)


@for_each("data", [OTTO, DIESEL, DUAL], ids=["otto", "diesel", "dual"])
def test_every_way_to_say_how_hot_gives_the_same_cycle(data):
    first = ideal_cycle(data)
    hot = max(value for key, value in first.values.items() if key.startswith("state_temperature"))
    ways = [{"heat": None, "peak_temperature": hot}]
    key = "pressure_ratio" if data.kind == "otto" else "cut_off"
    number = first.values["pressure_rise_ratio" if data.kind == "otto" else "cut_off"]
    ways.append({"heat": None, key: number})
    for way in ways:
        other = ideal_cycle(replace(data, **way)).values
        for name, value in first.values.items():
            assert other[name] == pytest.approx(value, rel=1e-12), name


def test_a_dual_cycle_without_cut_off_is_an_otto_and_without_pressure_rise_a_diesel():
    otto = ideal_cycle(IdealData("otto", 9.0, 1e5, 300.0, pressure_ratio=2.5)).values
    dual = ideal_cycle(IdealData("dual", 9.0, 1e5, 300.0, pressure_ratio=2.5, cut_off=1.0)).values
    diesel = ideal_cycle(IdealData("ideal-diesel", 18.0, 1e5, 300.0, cut_off=2.0)).values
    flat = ideal_cycle(IdealData("dual", 18.0, 1e5, 300.0, pressure_ratio=1.0, cut_off=2.0)).values
    for one, other in ((otto, dual), (diesel, flat)):
        for key in ("thermal_efficiency", "thermal_efficiency.closed", "ideal_mean_pressure", "heat_rejected"):
            assert other[key] == pytest.approx(one[key], rel=1e-13), key


def test_the_dual_cycle_in_30_digits():
    """Entropy in both directions of the cycle is the same, so the end of expansion follows from heats alone."""
    values = ideal_cycle(DUAL).values
    with mpmath.workdps(30):
        gas, gamma, first = mpmath.mpf(287), mpmath.mpf("1.4"), mpmath.mpf(300)
        c_v = gas / (gamma - 1)
        two = first * mpmath.mpf(16) ** (gamma - 1)
        three = two * mpmath.mpf("1.4")
        four = three + (mpmath.mpf("1.2e6") - c_v * (three - two)) / (gamma * c_v)
        gained = c_v * mpmath.log(three / two) + gamma * c_v * mpmath.log(four / three)
        five = first * mpmath.exp(gained / c_v)
        assert float(abs(values["state_temperature.5"] / five - 1)) < 1e-14
        work = mpmath.mpf("1.2e6") - c_v * (five - first)
        assert float(abs(values["ideal_work"] / work - 1)) < 1e-14


@for_each(
    ("data", "words"),
    [
        (replace(OTTO, heat=None), "write heat"),
        (replace(DIESEL, heat=None), "write heat"),
        (replace(DUAL, heat=None), "write heat, peak_temperature or cut_off as well"),
        (replace(DUAL, pressure_ratio=None), "write pressure_ratio"),
        (replace(OTTO, peak_temperature=2000.0), "more than once"),
        (replace(OTTO, heat=None, cut_off=2.0), "no cut_off"),
        (replace(DIESEL, heat=None, pressure_ratio=2.0), "no pressure_ratio"),
        (replace(OTTO, heat=None, peak_temperature=500.0), "must raise"),
        (replace(OTTO, heat=-1e6), "must raise"),
        (replace(DIESEL, heat=None, cut_off=30.0), "cut-off lie"),
        (replace(OTTO, compression_ratio=1.0), "above 1"),
    ],
)
def test_data_without_a_cycle_are_refused(data, words):
    with pytest.raises(CycleError, match=words):
        ideal_cycle(data)
