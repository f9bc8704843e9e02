"""Flywheel and speed of engines count the inertia of their own rods and pistons, as those of linkages do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.description.shorthand import expanded
from each import failing
from shown import EXAMPLES

LIGHT = """
format = 2
title = "Single cylinder with a light flywheel: how far does the speed swing"
[crank]
stroke = "60 mm"
speed = "1500 rpm"
mass = "1.2 kg"
[rod]
length = "110 mm"
mass = "0.25 kg"
small_end_share = 0.3
[piston]
mass = "0.2 kg"
[cylinder]
bore = "66 mm"
compression_ratio = 9
[engine]
layout = "inline"
cylinders = 1
[gas]
cycle = "720 deg"
pressures = "absolute"
ambient = "0.1 MPa"
[gas.points]
r = { angle = "0 deg", pressure = "0.1 MPa" }
a = { angle = "180 deg", pressure = "0.1 MPa" }
c = { angle = "360 deg" }
z = { angle = "360 deg", pressure = "3.5 MPa" }
b = { angle = "540 deg" }
x = { angle = "540 deg", pressure = "0.1 MPa" }
e = { angle = "720 deg" }
[[gas.pieces]]
law = "constant"
points = ["r", "a"]
[[gas.pieces]]
law = "polytropic"
exponent = 1.33
points = ["a", "c"]
[[gas.pieces]]
law = "polytropic"
exponent = 1.28
points = ["z", "b"]
[[gas.pieces]]
law = "constant"
points = ["x", "e"]
[flywheel]
mass = "2.5 kg"
radius_of_gyration = "0.08 m"
"""


@pytest.mark.elsewhere
def test_a_light_flywheel_by_an_energy_balance_of_another_program() -> None:
    """With the stated speed amid the extremes, as books take it, and as the mean over the time."""
    summary = crankwork.analyse(crankwork.Description(LIGHT)).summary
    # with the flywheel alone they were 0.278859, 178.98 and 135.18
    assert summary["speed_fluctuation"] == pytest.approx(0.258618, rel=2e-6)
    assert summary["crank_speed_max"] == pytest.approx(169.913, rel=4e-6)
    assert summary["crank_speed_min"] == pytest.approx(126.902, rel=4e-6)


@pytest.mark.elsewhere
def test_with_its_old_flywheel_an_engine_runs_more_evenly() -> None:
    """By the energy balance of another program; its extremes are 589.190 and 583.671 rad/s amid the stated speed."""
    text = EXAMPLES["petrol-four"].read_text("utf-8")
    given = text.replace("fluctuation = 0.01", 'inertia = "0.14868155137 kg*m2"')
    assert given != text
    found = crankwork.analyse(crankwork.Description(given)).summary
    assert found["speed_fluctuation"] == pytest.approx(0.00941, abs=5e-6)
    assert found["crank_speed_max"] - found["crank_speed_min"] == pytest.approx(589.190 - 583.671, abs=1e-3)


def test_the_books_still_leave_out_rods_and_pistons() -> None:
    """Excess work of the total torque over the inertia that turns with the crank, extremes amid the stated speed."""
    machine = crankwork.load(EXAMPLES["petrol-four"])
    exact, books = (crankwork.analyse(machine, method=name).summary for name in ("exact", "textbook"))
    assert exact["excess_work.mertsalov"] == pytest.approx(511.317166892, rel=1e-9)
    assert exact["excess_work"] == pytest.approx(210.827579547, rel=1e-9)
    assert books["flywheel_inertia"] == pytest.approx(books["excess_work"] / (0.01 * books["speed"] ** 2), rel=1e-12)
    assert (books["crank_speed_max"] + books["crank_speed_min"]) / 2 == pytest.approx(books["speed"], rel=1e-12)
    assert "flywheel_inertia.exact" not in books


def test_an_engine_and_the_linkage_that_it_is_run_as_evenly(tmp_path: Path) -> None:
    keys = (
        "excess_work", "excess_work.mertsalov", "flywheel_inertia", "flywheel_inertia.energy",
        "flywheel_inertia.mertsalov", "flywheel_inertia.wittenbauer", "flywheel_inertia.exact", "speed_fluctuation",
        "crank_speed_max", "crank_speed_max_angle", "crank_speed_min", "crank_speed_min_angle",
    )  # fmt: skip
    degrees = np.arange(0.0, 720.0, 31.0)

    light = tmp_path / "light.toml"
    light.write_text(LIGHT, "utf-8")

    def check(path):
        one, other = (
            crankwork.analyse(crankwork.Description(text)) for text in (path.read_text("utf-8"), expanded(path))
        )
        same = {key: one.summary[key] for key in keys if key in one.summary}
        assert len(same) > 6
        assert {key: other.summary[key] for key in same} == pytest.approx(same, rel=1e-9, abs=1e-7)
        columns = [results.columns_at(degrees, ["kinetic_energy_change", "crank_speed"]) for results in (one, other)]
        for key, values in columns[0].items():
            assert columns[1][key] == pytest.approx(values, abs=1e-9 * np.max(np.abs(values)))

    assert failing({"light": light, "petrol": EXAMPLES["petrol-four"]}, check) == {}
