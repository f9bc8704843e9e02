"""What drives a linkage, its flywheel and its steady speed count the friction that stands beside them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from each import failing

pytestmark = pytest.mark.elsewhere
ROOT = Path(__file__).parents[2]
PRESS = ROOT / "examples/knuckle-press.toml"
MOTOR = (
    "motor.rated_power=2.2 kW", "motor.rated_speed=960 rpm", "motor.overload=2.2", "motor.pole_pairs=3",
    "motor.ratio=24", "motor.inertia=0.02 kg*m2",
)  # fmt: skip


def test_the_motor_gives_what_the_loads_take_and_what_friction_loses():
    """A cycle leaves no energy in masses, so the powers of loads and of joints add up."""

    def check(machine):
        summary = crankwork.analyse(machine).summary
        useful = crankwork.analyse(replace(machine, friction=())).summary["mean_torque"] * summary["speed"]
        needed = useful + summary["mean_friction_power"]
        found = {summary["mean_torque"] * summary["speed"], summary.get("motor_power", needed)}
        assert max(abs(one - needed) for one in found) < 1e-9 * needed
        assert summary.get("mean_efficiency", useful / needed) == pytest.approx(useful / needed, rel=1e-9)

    machines = {
        "press": crankwork.read(PRESS, MOTOR),
        "slide": crankwork.read(ROOT / "tests/machines/overhung-slide.toml"),
    }
    assert failing(machines, check) == {}
    # 931.64 W of loads and 469.49 W of friction; without friction the motor was told to need 931.6 W
    summary = crankwork.analyse(machines["press"]).summary
    assert summary["motor_power"] == pytest.approx(1401.12, abs=0.01)
    assert summary["mean_torque"] == pytest.approx(334.493, abs=1e-3)


def test_a_flywheel_beside_friction_keeps_the_speed_by_another_integration():
    """Trapezoids over torques at 7,200 crank angles, Newton's second law solved for the energy by bisection."""
    results = crankwork.analyse(crankwork.read(PRESS, ["flywheel.fluctuation=0.05"]), np.arange(0.0, 360.0, 0.05))
    columns, summary, step = results.columns, results.summary, math.radians(0.05)
    braking = columns["static_torque"] + columns["torque_with_friction"] - columns["balancing_torque"]
    energy = np.concatenate([[0.0], np.cumsum(braking.mean() - (braking + np.roll(braking, -1)) / 2) * step])[:-1]
    assert summary["excess_work"] == pytest.approx(np.ptp(energy), rel=1e-4) == pytest.approx(1532.54, abs=0.05)
    inertia = columns["reduced_inertia"] + summary["flywheel_inertia.exact"]

    def speeds(start):
        return np.sqrt(2 * (start + energy) / inertia)

    low, high = -energy.min(), 1e6
    for _ in range(200):
        middle = (low + high) / 2
        w = speeds(middle)
        low, high = (middle, high) if (w.max() + w.min()) / 2 < summary["speed"] else (low, middle)
    w = speeds(low)
    assert (w.max() - w.min()) / summary["speed"] == pytest.approx(0.05, rel=1e-4)
    # the curve has the stated speed as its mean over the time
    low, high = -energy.min(), 1e6
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if 1 / np.mean(1 / speeds(middle)) < summary["speed"] else (low, middle)
    assert columns["crank_speed"] == pytest.approx(speeds(low), rel=1e-5)


def test_losses_count_once():
    """An efficiency of the drive divides the power of loads and friction, one of the machine that of loads alone."""
    both = (*MOTOR, "efficiency.chain=[0.67]", "flywheel.fluctuation=0.05")
    with pytest.raises(crankwork.InputError, match=r'losses are stated twice.*losses = "drive"'):
        crankwork.read(PRESS, both)
    of = {}
    for losses in ("drive", "machine"):
        results = crankwork.analyse(crankwork.read(PRESS, (*both, f"efficiency.losses={losses}")))
        of[losses] = results.summary
    assert of["drive"]["motor_power"] == pytest.approx(1401.12 / 0.67, abs=0.01)
    assert of["machine"]["motor_power"] == pytest.approx(931.636 / 0.67, abs=0.01)
    assert of["drive"]["flywheel_inertia"] == pytest.approx(1744.6, abs=0.05)
    # the driver gives 1/0.67 of what loads and masses take, and gets 0.67 of what they give
    step = math.radians(0.05)
    results = crankwork.analyse(
        crankwork.read(PRESS, (*both, "efficiency.losses=machine")), np.arange(0.0, 360.0, 0.05)
    )
    needed = results["static_torque"] + results["dynamic_torque"]
    taken = np.where(needed > 0, needed / 0.67, needed * 0.67) - results["dynamic_torque"]
    energy = np.cumsum(taken.mean() - (taken + np.roll(taken, -1)) / 2) * step
    assert of["machine"]["excess_work"] == pytest.approx(np.ptp(energy), rel=1e-4)


def test_a_motor_that_friction_stalls_has_no_steady_speed():
    """Let go at its speed the same machine comes to rest: 60 kg m2 do not carry it through the stroke."""
    settings = (*MOTOR, "crank.inertia=60 kg*m2", "transient.time=3 s", "transient.speed=40 rpm")
    results = crankwork.analyse(crankwork.read(PRESS, settings))
    assert "steady_speed" not in results.summary
    assert {"stalls", "transient_comes_to_rest"} <= {one.code for one in results.notices}


def test_the_mean_efficiency_of_a_slider_crank_at_speed():
    """By an independent program: 0.8855; that of the loads alone, at rest, would be 0.8925."""
    results = crankwork.analyse(crankwork.read_machine(SLIDER_CRANK))
    assert results.summary["mean_efficiency"] == pytest.approx(0.8855, abs=5e-5)


SLIDER_CRANK = """
format = 2
fixed_points.O = ["39.792969479758383 mm", "1.0841635402625283 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "46.633850150694123 mm"
speed = "141.88703126521665 rpm"
start = "22.561368054280535 deg"
mass = "3.9481044259367493 kg"
inertia = "0.16377376252908174 kg*m2"
centre = ["35.049834223118246 mm", "-5.434509992223437 mm"]
[links.rod]
joins = ["A", "B"]
length = "158.31049836007728 mm"
mass = "18.688317528682024 kg"
inertia = "0.051084749409533399 kg*m2"
centre = ["92.7860587341453 mm", "23.066401018054869 mm"]
[guides]
bed = { through = ["27.64489738046408 mm", "60.537085970259376 mm"], angle = "-85.813369396206213 deg" }
[sliders]
piston = { pin = "B", guide = "bed", mass = "20.118083747622993 kg" }
[positions]
B = ["41.880704165085334 mm", "-133.93898277777191 mm"]
[[loads]]
kind = "damper"
slider = "piston"
damping = "192.76267020318431 N*s/m"
[[loads]]
kind = "torque"
link = "rod"
at = ["0 deg", "70 deg", "150 deg", "260 deg", "360 deg"]
torque = ["59.8814408345 N*m", "-29.8797716827 N*m", "-37.2636534114 N*m", "2.15998056953 N*m", "59.8814408345 N*m"]
[[loads]]
kind = "process"
slider = "piston"
stroke = "growing"
acts = "forward"
at = ["0 mm", "50 mm", "80 mm", "5000 mm"]
force = ["29.334372342018465 N", "167.30408377782578 N", "1895.9752536729522 N", "1620.8577211599561 N"]
[friction]
circle = "sine"
[friction.pins]
O = { coefficient = 0.072175585744053833, radius = "24.805111650333572 mm" }
A = { coefficient = 0.039528736859917285, radius = "18.904601863257696 mm" }
[friction.sliders]
piston = { coefficient = 0.036596772322128587, force = "2.9618341934695613 N" }
"""
