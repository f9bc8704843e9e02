"""Many designs of one file: values as analyses give them, what is refused counted, what does not compile told."""

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.description.document import numeric_field
from crankwork.errors import CrankworkError
from crankwork.kernel import compiled as compiled_kernels
from each import for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
FOUR_BAR = crankwork.template("four-bar")


pytestmark = pytest.mark.usefixtures("by_arrays")


def test_values_are_those_of_single_analyses():
    d = crankwork.Description(crankwork.template("slider-crank"))
    radii = ["40 mm", "45 mm", "50 mm", "55 mm"]
    found = crankwork.sweep(d, {"crank.radius": radii}, ["stroke", "piston_acceleration_max"])
    assert found.one_by_one == 0
    assert not found.reason
    assert len(found) == 4
    for at, radius in enumerate(radii):
        d["crank.radius"] = radius
        one = crankwork.analyse(d)
        for key, values in found.values.items():
            assert values[at] == pytest.approx(one.summary[key], rel=1e-12)


@for_each(
    ("key", "stated", "value", "reason"),
    [
        ("rod.length", ["180 mm", "200 mm", "220 mm"], "joint_force_max.O", "curved_field"),
        ("piston.mass", ["0.7 kg", "0.8 kg", "0.9 kg"], "joint_force_max.O", ""),
        ("friction.sliders.piston.force", ["10 N", "20 N", "30 N"], "mean_friction_power", ""),
    ],
)
def test_numbers_of_an_engine_with_friction_change_it_as_in_single_analyses(key, stated, value, reason):
    text = f'friction.sliders.piston.force = "20 N"\n{crankwork.template("slider-crank")}'
    d = crankwork.Description(text)
    found = crankwork.sweep(d, {key: stated}, [value])
    assert found.reason == reason
    assert found.one_by_one == (len(stated) if reason else 0)
    for at, one in enumerate(stated):
        d[key] = one
        assert found.values[value][at] == pytest.approx(crankwork.analyse(d).summary[value], rel=1e-12)
    assert np.ptp(found.values[value]) > 0.01 * found.values[value][0]


def test_designs_that_cannot_be_assembled_are_counted_by_reason():
    d = crankwork.Description(FOUR_BAR)
    lengths = [0.05, 0.06, 0.16, 0.17, 0.18, 0.19, 0.2]
    found = crankwork.sweep(d, {"links.coupler.length": lengths}, ["joint_force_max.B"])
    refused = sum(found.refused.values())
    assert refused == 2
    assert np.isnan(found.values["joint_force_max.B"]).sum() == refused
    assert all("joint_force_max.B" in reason or "; " in reason for reason in found.refused)


def test_what_does_not_compile_is_analysed_one_by_one():
    d = crankwork.load(EXAMPLES / "radial-five.toml")
    found = crankwork.sweep(d, {"rod.mass": ["2 kg", "2.1 kg"]}, ["best_balanced_share"])
    assert found.reason == "procedure"
    assert found.one_by_one == 2
    for mass, value in zip(("2 kg", "2.1 kg"), found.values["best_balanced_share"], strict=True):
        d["rod.mass"] = mass
        assert value == crankwork.analyse(d).summary["best_balanced_share"]


def test_a_kernel_that_says_something_else_than_analyses_is_not_believed(monkeypatch):
    d = crankwork.Description(FOUR_BAR)
    asked = {"crank.radius": ["60 mm", "61 mm", "62 mm"]}, ["joint_force_max.B", "joint_force_max_angle.B"]
    assert [crankwork.sweep(d, *asked, steps=steps).reason for steps in (None, 72)] == ["", ""]
    run = compiled_kernels.Kernel.run

    def wrong(kernel, designs, found, first, last):
        run(kernel, designs, found, first, last)
        found.values[0, first:last] *= 1.2

    monkeypatch.setattr(compiled_kernels.Kernel, "run", wrong)
    found = [crankwork.sweep(d, *asked, steps=steps) for steps in (None, 72)]
    assert [(one.reason, one.one_by_one) for one in found] == [("differs", 3)] * 2


def test_several_threads_give_the_same(monkeypatch):
    monkeypatch.setattr("crankwork.study.variants._BATCH_SIZE", 8)
    d = crankwork.Description(crankwork.template("slider-crank"))
    asked = {"crank.radius": np.linspace(0.03, 0.05, 50), "crank.speed": np.linspace(200, 300, 50)}
    one, two = (crankwork.sweep(d, asked, ["piston_velocity_max"], workers=count) for count in (1, 3))
    np.testing.assert_array_equal(one.values["piston_velocity_max"], two.values["piston_velocity_max"])


def test_what_cannot_be_asked_is_refused():
    d, wrong = crankwork.Description(crankwork.template("slider-crank")), []
    for designs, key, told in (
        ({"crank.radius": ["1 mm", "2 mm"], "crank.speed": ["9 rpm"]}, "stroke", "different numbers of values"),
        ({"crank.raduis": ["1 mm"]}, "stroke", "radius"),
        ({"crank.radius": ["1 kg"]}, "stroke", "crank.radius"),
        ({"crank.radius": ["50 mm"]}, "stroek", "stroke"),
        ({"crank.radius": ["50 mm"]}, "piston_velocity", "piston_velocity_max"),
        ({"crank.radius": []}, "stroke", "different numbers of values"),
    ):
        with pytest.raises(CrankworkError) as refused:
            crankwork.sweep(d, designs, [key])
        if told not in str(refused.value):
            wrong.append((told, str(refused.value)))
    assert wrong == []


@pytest.mark.data
def test_units_and_seed_go_with_designs_into_a_file(tmp_path):
    import pandas as pd
    import xarray

    d = crankwork.Description(crankwork.template("slider-crank"))
    speeds = ["1000 rpm"] * 2
    found = crankwork.sweep(d, {"crank.radius": ["40 mm", "50 mm"], "crank.speed": speeds}, ["stroke", "speed"])
    data = found.to_xarray()
    assert data["stroke"].attrs["units"] == data["crank.radius"].attrs["units"] == "m"
    assert data["crank.speed"].attrs["units"] == "rad/s"
    assert data["speed"].attrs["units"] == "rad/s"
    assert data["stroke"].values == pytest.approx([0.08, 0.1])
    assert isinstance(data, xarray.Dataset)
    of, rods = "piston_acceleration_max", {"rod.length": (0.15, 0.22)}
    best = crankwork.optimise(d, of, rods, limits=["stroke >= 90 mm"], seed=7)
    assert best.fields["rod.length"] == pytest.approx(0.22)
    best.history.to_dataframe().to_parquet(tmp_path / "course.parquet")
    assert list(found.to_dataframe().columns) == ["crank.radius", "crank.speed", "stroke", "speed"]
    read = pd.read_parquet(tmp_path / "course.parquet")
    assert read.attrs["seed"] == "7"
    assert read.attrs["units"] == {"rod.length": "m", "piston_acceleration_max": "m/s2", "stroke": "m"}
    assert len(read) == len(best.history)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["press", "toggle-press"])
def test_designs_whose_force_begins_at_other_angles_have_calculations_of_their_own(name):
    """The slide passes points of its force more or less often; dead centres pass the start of the cycle."""
    d = crankwork.Description(crankwork.template(name))
    fields = ("crank.radius", "links.rod.length")
    stated = [numeric_field(d.values_with(()), key).now for key in fields]
    draw = np.random.default_rng(3)
    designs = {key: now * (1 + 0.02 * draw.uniform(-1, 1, 80)) for key, now in zip(fields, stated, strict=True)}
    keys = ["motor_power", "joint_force_max.A", "driving_torque_max", "mean_torque"]
    found = crankwork.sweep(d, {key: column.tolist() for key, column in designs.items()}, keys)
    assert not found.reason
    assert found.one_by_one <= 8
    for place in range(0, 80, 16):
        results = crankwork.analyse(
            d.machine([f"{key} = {float(column[place])!r} m" for key, column in designs.items()])
        )
        for key in keys:
            assert found.values[key][place] == pytest.approx(results.value(key), rel=1e-9)
