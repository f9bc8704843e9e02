"""Friction beside the ideal forces: whatever drives, power balances, and what was there stays what it was."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.joint_friction import COLUMNS
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.mechanism.joints import Pin, names_of_pivots

ROOT = Path(__file__).parents[2]
MACHINES = ("driven-slider", "crank-by-table", "guide-on-rocker", "cylinder-between-links", "heavy-boom", "elbow")


def rubbing_everywhere(name: str) -> tuple[crankwork.Results, crankwork.Results]:
    """Return the results of a machine as it is, and with friction in all its joints."""
    text = (ROOT / f"tests/machines/{name}.toml").read_text("utf-8")
    machine = crankwork.read_machine(text)
    shown, held = names_of_pivots(machine.mechanism), all_links_and_joints(machine.mechanism)[1]
    text += "\n[friction.pins]\n"
    for joint in held:
        if isinstance(joint, Pin):
            text += (
                f"{shown.get(joint.name, joint.name)} = {{ coefficient = 0.05, radius = '5 mm', moment = '1 mN*m' }}\n"
            )
    text += "[friction.sliders]\n"
    for joint in held:
        if not isinstance(joint, Pin):
            text += f"{joint.name} = {{ coefficient = 0.05, length = '50 mm', damping = '1 N*s/m' }}\n"
    text = text.replace("1 mN*m", "0.001 N*m")
    return crankwork.analyse(machine), crankwork.analyse(crankwork.read_machine(text))


@pytest.mark.parametrize("names", [MACHINES[:2], pytest.param(MACHINES[2:], marks=pytest.mark.slow)])
def test_power_balances_whatever_drives(names: tuple[str, ...]) -> None:
    wrong = {}
    for name in names:
        plain, rubbing = rubbing_everywhere(name)
        assert {"friction_power", "friction_forces"} <= set(rubbing.checks), name
        power = rubbing.columns["friction_power"]
        wrong |= {(name, key): one for key, one in rubbing.checks.items() if not one < 1e-12}
        if rubbing.summary["mean_friction_power"] <= 0 or power.min() < -1e-12 * power.max():
            wrong[name, "friction_power"] = power
        for key, column in plain.columns.items():
            if not np.array_equal(column, rubbing.columns[key], equal_nan=True):
                wrong[name, key] = rubbing.columns[key]
        assert {key.partition(".")[0] for key in set(rubbing.columns) - set(plain.columns)} <= set(COLUMNS), name
    assert wrong == {}


HELD = """
    fixed_points.O = ["0 mm", "0 mm"]
    crank = {{ pivot = "O", pin = "A", radius = "100 mm", start = "{start} deg", speed = "60 rpm" }}
    loads = [{{ kind = "force", point = "A", x = "-1 kN" }}]
    friction.pins.O.moment = "20 N*m"
    links.rod = {{ joins = ["A", "B"], length = "300 mm" }}
    guides.bed = {{ through = "O", angle = "0 deg" }}
    sliders.piston = {{ pin = "B", guide = "bed" }}
"""


def test_a_load_that_is_held_over_the_end_of_a_cycle_is_told_once() -> None:
    # the load drives with 100 N m sin phi, and 20 N m hold that
    results = crankwork.analyse(crankwork.read_machine(HELD.format(start=5)))
    held = [one.values for one in results.notices if one.code == "friction_holds"]
    end = np.degrees(np.arcsin(0.2))
    expected = [(180 - end - 5, 175.0), (355.0, end - 5)]
    assert [(one["from"], one["to"]) for one in held] == [pytest.approx(one, abs=1e-7) for one in expected]
    ratio = results.columns_at([0.0, 90.0, 200.0])["instantaneous_efficiency"]
    power = 100 * np.sin(np.radians([95.0, 205.0]))
    assert np.isnan(ratio[0])
    assert ratio[1:] == pytest.approx([(power[0] - 20) / power[0], power[1] / (power[1] - 20)])


def test_friction_alone_is_a_torque() -> None:
    text = HELD.format(start=0).replace('x = "-1 kN"', 'x = "0 kN"')
    results = crankwork.analyse(crankwork.read_machine(text))
    assert results.columns["torque_with_friction"] == pytest.approx(20)
    assert "instantaneous_efficiency" not in results.columns
    assert "mean_efficiency" not in results.summary


OVERHUNG = """
    fixed_points.O = ["0 m", "0 m"]
    crank = {{ pivot = "O", pin = "A", radius = "0.1 m", speed = "60 rpm" }}
    links.rod = {{ joins = ["A", "B"], length = "0.3 m" }}
    guides.bed.through = ["0 m", "{beside} m"]
    sliders.ram = {{ guide = "bed", points = {{ B = ["{ahead} m", "-{beside} m"], C = ["0 m", "0 m"] }} }}
    friction.sliders.ram = {{ coefficient = {coefficient}, length = "{length} m" }}
    loads = [{{ kind = "force", point = "C", x = "100 N" }}]
"""


def overhung(length: float, coefficient: float = 0.15, beside: float = 0.2, ahead: float = 0.0) -> crankwork.Results:
    text = OVERHUNG.format(length=length, coefficient=coefficient, beside=beside, ahead=ahead)
    return crankwork.analyse(crankwork.read_machine(text))


@pytest.mark.elsewhere
def test_an_overhung_guide_is_pressed_by_the_moment_about_its_middle() -> None:
    """Three equations of the ram, beside its guide, solved for the force of the rod."""
    for sizes in ((0.5, 0.15, 0.2, 0.0), (0.5, 0.15, 0.2, 0.1), (0.4, 0.3, 0.1, -0.15), (0.061, 0.15, 0.2, 0.0)):
        results, (length, coefficient, beside, ahead) = overhung(*sizes), sizes
        phi = np.radians(results.grid.degrees)
        x, y = 0.1 * np.cos(phi), 0.1 * np.sin(phi)
        sin = -y / 0.3
        cos = np.sqrt(1 - sin**2)
        sense = -np.sign(np.round(results["slider_velocity.ram"], 12))
        pressing = np.maximum(np.abs(sin), 2 / length * np.abs(ahead * sin + beside * cos))
        rod = -100 / (cos - sense * coefficient * pressing)
        torque = rod * (x * sin - y * cos)
        assert results["torque_with_friction"] == pytest.approx(torque, abs=1e-11), sizes
        assert max(results.checks.values()) < 1e-12, sizes


@pytest.mark.elsewhere
def test_an_overhung_guide_jams_where_it_is_shorter_than_twice_the_overhang_times_friction() -> None:
    jammed, free = (
        [(one.values["from"], one.values["to"]) for one in overhung(length).notices if one.code == "self_locking"]
        for length in (0.0599, 0.0601)
    )
    # against the load, on the way back
    assert jammed == [pytest.approx((0.0, 180.0))]
    assert free == []


@pytest.mark.slow
def test_the_couple_of_friction_beside_a_pin_turns_the_link_that_carries_the_guide_too() -> None:
    text = (ROOT / "tests/machines/guide-on-rocker.toml").read_text("utf-8")
    block = 'block = { points = { D = ["12 mm", "-25 mm"] }, centre = "D", guide = "arm", mass = "0.8 kg" }'
    text = text.replace('block = { pin = "D", guide = "arm", mass = "0.8 kg" }', block)
    text += '\n[friction.sliders.block]\ncoefficient = 0.1\nlength = "50 mm"\n'
    results = crankwork.analyse(crankwork.read_machine(text))
    assert max(results.checks.values()) < 1e-12
    assert np.abs(results["friction_force.block"]).max() > 1


IDLE = """
    method.weights = true
    fixed_points = { O = ["0 mm", "0 mm"], O1 = ["3203.4 mm", "914.4 mm"] }
    crank = { pivot = "O", pin = "A", radius = "996.3 mm", speed = "55 rpm" }
    [links]
    coupler = { joins = ["A", "P"], length = "2148.1 mm" }
    rocker = { joins = ["O1", "P"], length = "2540.5 mm" }
    idle = { joins = ["P", "Q"], length = "1890.7 mm" }
    rod = { joins = ["P", "R"], length = "1890.7 mm" }
    [guides]
    beside = { through = ["2319.5 mm", "3485 mm"], angle = "45 deg" }
    bed = { through = ["-15.9 mm", "3146.5 mm"], angle = "135 deg" }
    [sliders]
    idler = { guide = "beside", pin = "Q" }
    ram = { guide = "bed", pin = "R", mass = "31 kg" }
    [positions]
    P = ["982 mm", "2148 mm"]
    Q = ["2319 mm", "3485 mm"]
    R = ["-354 mm", "3485 mm"]
    [friction]
    sliders.ram = { coefficient = 0.1, length = "50 mm" }
"""


@pytest.mark.slow
def test_links_that_carry_nothing_are_balanced_by_nothing() -> None:
    """Their forces are rounding, of which no share is too large."""
    results = crankwork.analyse(crankwork.read_machine(IDLE))
    assert "not_balanced" not in {one.code for one in results.notices}
    assert np.all(np.isfinite(results["torque_with_friction"]))
    assert max(results.checks.values()) < 1e-12
    assert np.abs(results["joint_force_with_friction.Q"]).max() < 1e-9


def test_friction_beside_teeth_is_refused_with_what_to_write() -> None:
    toothed = (ROOT / "tests/machines/toothed-five-bar.toml").read_text("utf-8")
    text = f'{toothed}\n[friction.pins]\nC = {{ coefficient = 0.1, radius = "10 mm" }}\n'
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(text)
    (line,) = str(refused.value).splitlines()
    assert "geared.second.pressure_angle: " in line
    # each of the ways out that it names
    assert crankwork.read_machine(text.replace('pressure_angle = "20 deg"\n', "")).friction
    (written,) = re.findall(r"efficiency\.chain = \[[\d.]+\]", line)
    assert crankwork.read_machine(f"{written}\n{toothed}").drive.efficiency == 0.95
