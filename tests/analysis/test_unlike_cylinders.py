"""Cylinders that differ by their pressure: misfire, diagrams of their own, factors; each against one alone."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinder_forces import traced_cylinder
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.mechanism.mechanism import slider_crank

ROOT = Path(__file__).parents[2]
FOUR = (ROOT / "examples/petrol-four.toml").read_text("utf-8")
SPARK = (ROOT / "examples/spark-engine.toml").read_text("utf-8")
DIAGRAM = SPARK + '\n[engine]\nlayout = "inline"\ncylinders = 4\n'
MOTORED = """
[gas.motored.points]
r = { angle = "0 deg", pressure = "0 MPa" }
a = { angle = "180 deg", pressure = "-0.01 MPa" }
c = { angle = "360 deg", pressure = "1 MPa" }
b = { angle = "540 deg", pressure = "-0.01 MPa" }
e = { angle = "720 deg", pressure = "0 MPa" }

[[gas.motored.pieces]]
law = "rounded"
points = ["r", "a", "c", "b", "e"]
"""
OWN = MOTORED.replace("gas.motored", "gas.cylinders.2")
DEGREES = np.arange(0.0, 720.0, 2.5)


def of(text, *settings):
    return crankwork.read_machine(text, overrides=settings, folder=ROOT)


def alone(machine, number):
    """Return one cylinder of an engine as an engine of its own."""
    gas = machine.engine.gases[number - 1]
    return crankwork.analyse(replace(machine, gas=gas, engine=None))


@pytest.mark.slow
def test_the_torque_is_the_sum_of_engines_of_one_cylinder():
    narrow, diesel = ((ROOT / f"examples/{name}.toml").read_text("utf-8") for name in ("narrow-v6", "v8-diesel"))
    own = ("engine.misfire=[3]", "gas.motored=ambient", "engine.pressure_factors=[1.1, 1, 1, 0.8]")
    for text, *settings in (
        (FOUR, "engine.misfire=[3]"),
        (FOUR, "engine.misfire=[1, 4]", "cycle.motored=ambient"),
        (FOUR, "engine.pressure_factors=[1, 0.9, 1.05, 1]", "crank.angular_acceleration=300 rad/s2"),
        (DIAGRAM + MOTORED, "engine.misfire=[2]", "method.kinematics=exact"),
        (DIAGRAM + OWN, "method.kinematics=exact", *own),
        (narrow, "engine.misfire=[4]"),
        (diesel, "engine.misfire=[2, 7]"),
    ):
        machine = of(text, *settings)
        results = crankwork.analyse(machine, crankwork.CrankGrid.from_degrees(DEGREES))
        total, crank, rod = np.zeros_like(DEGREES), machine.mechanism.crank.radius, machine.mechanism.dyads[0].length
        for place in machine.engine.layout.places:
            offsets = machine.engine.offsets
            lengths = slider_crank(crank, rod, offsets[place.number - 1]) if offsets else machine.mechanism
            one = alone(replace(machine, mechanism=lengths), place.number)
            total += one.columns_at((DEGREES - place.firing_angle) % 720, ["crank_torque"])["crank_torque"]
        assert results["total_torque"] == pytest.approx(total, abs=1e-12 * np.max(np.abs(total))), settings
        assert max(results.checks.values()) < 1e-9, settings


def test_a_misfire_brings_half_orders_that_phase_stars_say():
    machine = of(FOUR, "engine.misfire=[3]")
    results, places = crankwork.analyse(machine), machine.engine.layout.places
    fires, dead = (np.fft.rfft(torque(alone(machine, one))) / len(_FINE) * 2 for one in (1, 3))
    expected = np.zeros_like(fires)
    for place in places:
        turned = np.exp(-1j * np.arange(len(fires)) * 2 * math.pi * place.firing_angle / 720)
        expected += turned * (dead if place.number == 3 else fires)
    listed = results.listings["torque_harmonics"].columns
    amplitudes = dict(zip(listed["harmonic_order"].tolist(), listed["total_harmonic_amplitude"].tolist(), strict=True))
    for order in (0.5, 1.0, 1.5, 2.0, 2.5, 4.0):
        # samples alias a little at the jumps of the pressure
        assert amplitudes[order] == pytest.approx(abs(expected[round(2 * order)]), rel=1e-5)
    # stars of four even firings vanish below the second order: what is left is the one cylinder that misses
    assert amplitudes[0.5] == pytest.approx(abs(fires[1] - dead[1]), rel=1e-5)
    even = crankwork.analyse(of(FOUR)).listings["torque_harmonics"].columns["total_harmonic_amplitude"]
    assert even[0] < 1e-9 * amplitudes[0.5]


_FINE = np.arange(0.0, 720.0, 0.01)


def torque(results):
    return results.columns_at(_FINE, ["crank_torque"])["crank_torque"]


def test_a_cylinder_that_misfires_compresses_and_expands_its_charge():
    wrong = []
    for name in ("otto", "ideal-diesel", "dual", "wiebe", "two-stroke-ports", "v-two"):
        text = (ROOT / f"tests/machines/{name}.toml").read_text("utf-8")
        text = text if "[engine]" in text else text + '\n[engine]\nlayout = "inline"\ncylinders = 2\nuneven = true\n'
        machine = of(text, "engine.misfire=[2]")
        fires, dead = (alone(machine, one) for one in (1, 2))
        at = np.arange(0.0, machine.cycle, 0.05)
        burnt, motored = (one.columns_at(at, ["gas_pressure"])["gas_pressure"] for one in (fires, dead))
        # the greatest pressure stands at the least volume but for what walls take
        top = at[np.argmax(motored)] % 360
        is_at_top = min(top, 360 - top) < (3 if name == "wiebe" else 0.1)
        # compression and expansion give and take the same work
        is_without_work = dead.summary["indicated_work"] < 0.05 * fires.summary["indicated_work"]
        if not (is_at_top and is_without_work and np.max(motored) <= np.max(burnt)):
            wrong.append((name, top, dead.summary["indicated_work"]))
    assert wrong == []


def test_the_work_of_each_cylinder_is_that_of_its_torque():
    for setting in ("engine.misfire=[3]", "engine.pressure_factors=[1, 0.7, 1, 1.2]"):
        trace = crankwork.analyse(of(FOUR, setting)).trace
        keys = [f"crank_torque.{number}" for number in range(1, 5)]
        over = CycleInterpolant({key: trace[key] for key in keys}, crankwork.CrankGrid.from_degrees, 720.0)
        found = [over.mean(key, "").value * 4 * math.pi for key in keys]
        work = [trace[f"indicated_work.{number}"].value for number in range(1, 5)]
        assert found == pytest.approx(work, abs=1e-9 * abs(work[0])), setting


def test_a_factor_multiplies_work_and_gauge_pressure():
    machine = of(DIAGRAM, "engine.pressure_factors=[1.25, 1, 1, 1]", "gas.pressures=gauge")
    plain = crankwork.analyse(of(DIAGRAM))
    results = crankwork.analyse(machine)
    assert results["gas_pressure"] == pytest.approx(1.25 * plain["gas_pressure"], rel=1e-14)
    assert results.summary["indicated_work"] == pytest.approx(1.25 * plain.summary["indicated_work"], rel=1e-14)


def test_equal_cylinders_are_one_node_and_a_cylinder_that_differs_has_its_own():
    trace = crankwork.analyse(of(FOUR, "engine.misfire=[3]")).trace
    nodes = [trace[f"tangential_force.{number}"].node.of.node for number in (2, 3, 4)]
    assert nodes[0] is nodes[2] is trace["tangential_force"].node
    assert nodes[1] is not nodes[0]


def test_an_engine_without_any_combustion_is_dragged():
    results = crankwork.analyse(of(FOUR, "engine.misfire=[1, 2, 3, 4]"))
    assert results.trace["mean_torque"].key == "mean_driving_torque"
    assert results.checks["phase_stars"] < 1e-9


def test_a_crankpin_whose_cylinder_misfires_has_a_load_of_its_own():
    machine = of(FOUR, "engine.misfire=[3]")
    results, one = crankwork.analyse(machine, crankwork.CrankGrid.from_degrees(DEGREES)), alone(machine, 3)
    assert "crankpin_load.2" not in results.columns
    at = (DEGREES - machine.engine.layout.places[2].firing_angle) % 720
    found = one.columns_at(at, ["tangential_force", "radial_force"])
    inertia = 0.716 * 0.725 * 0.039 * machine.speed**2
    expected = np.hypot(found["tangential_force"], found["radial_force"] - inertia)
    assert results["crankpin_load.3"] == pytest.approx(expected, rel=1e-12)


def test_mistakes_are_told_with_their_place():
    two = "engine.misfire=[2]"
    for text, settings, told in (
        (FOUR, ["engine.misfire=[5]"], r"engine\.misfire\[1\]: there is no cylinder 5; write numbers from 1 to 4"),
        (FOUR, ["engine.misfire=[2, 2]"], r"engine\.misfire\[2\]: cylinder 2 is named twice"),
        (FOUR, ["engine.pressure_factors=[1, 1]"], r"engine\.pressure_factors: has 2 entries"),
        (FOUR, [two, "engine.pressure_factors=[1, 0.5, 1, 1]"], r"pressure_factors\[2\]: nothing burns"),
        (DIAGRAM, [two], r"engine\.misfire: the pressure of a cylinder that misfires is not known"),
        (DIAGRAM, [two, "gas.motored=cold"], r'gas\.motored: write motored = "ambient"'),
        (DIAGRAM + OWN, [two], r"engine\.misfire\[1\]: cylinder 2 has a diagram of its own"),
        (DIAGRAM + OWN.replace("cylinders.2", "cylinders.5"), [], r"gas\.cylinders\.5: is no cylinder"),
        (SPARK + OWN, [], r"gas\.cylinders: there is one crank gear only"),
        (DIAGRAM + MOTORED.replace("720", "700"), [two], r"gas\.motored\.pieces: "),
        (DIAGRAM + OWN.replace('"b", "e"]', '"b", "q"]'), [], r"gas\.cylinders\.2\.pieces\[1\]\.points\[5\]: "),
        (DIAGRAM, [two, "gas.motored.measured.file=none.csv"], r"gas\.motored\.measured"),
    ):
        with pytest.raises(crankwork.InputError, match=told):
            of(text, *settings)


def test_each_cylinder_may_have_a_file_of_samples(tmp_path):
    degrees = np.arange(0.0, 720.0, 1.0)
    for number, peak in enumerate((5.0, 4.0), start=1):
        bump = peak * np.exp(-(((degrees - 370) / 30) ** 2))
        rows = "\n".join(f"{one:g},{two:.9f}" for one, two in zip(degrees, bump, strict=True))
        (tmp_path / f"{number}.csv").write_text(f"angle,pressure\n{rows}\n", "utf-8")
    head = SPARK.partition("[gas]")[0]
    text = head + '[gas]\ncycle = "720 deg"\n[engine]\nlayout = "inline"\ncylinders = 2\nuneven = true\n'
    text += 'firing_order = [1, 2]\nthrows = ["0 deg", "180 deg"]\n'
    for number in (1, 2):
        text += f'[gas.cylinders.{number}.measured]\nfile = "{number}.csv"\npressure_unit = "MPa"\n'
    machine = crankwork.read_machine(text, folder=tmp_path)
    results = crankwork.analyse(machine)
    ratio = results.trace["indicated_work.2"].value / results.trace["indicated_work.1"].value
    assert ratio == pytest.approx(0.8, rel=1e-9)
    with pytest.raises(crankwork.InputError, match=r"gas\.points: no diagram for these cylinders: 2; add"):
        crankwork.read_machine(text.partition("[gas.cylinders.2")[0], folder=tmp_path)
    (tmp_path / "2.csv").write_text("angle,pressure\n0,1\n1,2\n", "utf-8")
    with pytest.raises(crankwork.InputError, match=r"gas\.cylinders\.2\.measured: 2\.csv, only 2 samples"):
        crankwork.read_machine(text, folder=tmp_path)


def test_the_calculation_of_the_cycle_is_compared_with_cylinders_as_calculated_that_turn_evenly():
    wrong = {}
    for told, *settings in (
        ("torque_of_cycle",),
        ("cycle_in_every", "engine.misfire=[1]"),
        ("cycle_in_every", "engine.misfire=[1, 2, 3, 4]"),
        ("cycle_in_every", "engine.pressure_factors=[1, 0.9, 1, 1]"),
        ("cycle_in_every", "engine.pressure_factors=[0.9, 0.9, 0.9, 0.9]"),
        ("torque_of_cycle", "engine.pressure_factors=[1, 1, 1, 1]"),
        ("", "crank.angular_acceleration=1e4 rad/s2"),
        ("cycle_in_every", "crank.angular_acceleration=1e4 rad/s2", "engine.misfire=[2]"),
    ):
        codes = {one.code for one in crankwork.analyse(of(FOUR, *settings)).notices}
        if codes & {"torque_of_cycle", "cycle_in_every"} != ({told} if told else set()):
            wrong[tuple(settings)] = codes
    assert wrong == {}


def test_a_machine_says_what_a_cylinder_is_solved_for():
    machine = of(FOUR, "engine.misfire=[1]")
    assert traced_cylinder(machine, machine.method).space.calculated.values["effective_power"] > 50e3
