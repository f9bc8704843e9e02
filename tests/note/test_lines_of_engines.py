"""Worked steps of whole engines: values of the results at any crank angle, rows of the listings, factors of books."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinders import whole_engine
from crankwork.analysis.engine_balance import engine_balance
from crankwork.cylinders.engines import boxer, inline, radial, vee
from crankwork.formula.expression import evaluate
from crankwork.formula.lines import FormulaLine, SumLine, ValueLine
from crankwork.formula.replay import replay
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import has_text
from crankwork.machine import Bearings, Drive, Engine
from crankwork.quantities import QUANTITIES, base_key

EXAMPLES = Path(__file__).parents[2] / "examples"
PETROL = crankwork.read(EXAMPLES / "spark-engine.toml")
LAYOUTS = {
    "I1": inline(1, (1,))[0],
    "I4": inline(4, (1, 3, 4, 2), spacing=0.12)[0],
    "V6": vee(6, (1, 4, 2, 5, 3, 6), 90.0, spacing=0.12, bank_stagger=0.03, throws=(0, 120, 240), uneven=True)[0],
    "V8": vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0, spacing=0.12)[0],
    "B4": boxer(4, (1, 4, 3, 2), spacing=0.12)[0],
    "R7": radial(7, master=0)[0],
}
WHOLE = (
    "firing",
    "engine_torque",
    "articulated",
    "bearings",
    "bearing_loads",
    "torque_harmonics",
    "uniformity",
    "balance",
)


def _machine(layout, **changes):
    method = PETROL.method.named("exact")
    return replace(PETROL, method=replace(method, inertia_rod_ratio=None), engine=Engine(layout, **changes))


MACHINES = {path.stem: crankwork.read(path) for path in sorted(EXAMPLES.glob("*.toml"))}
MACHINES = {name: one for name, one in MACHINES.items() if getattr(one, "engine", None) is not None}
MACHINES |= {name: _machine(layout) for name, layout in LAYOUTS.items()}
SIZED = {"bearings": Bearings(0.06, 0.03, 0.07, 0.03, 0.025, 0.03), "counterweight": 0.02, "rotating_share": 0.4}
MACHINES |= {
    "weights": replace(_machine(LAYOUTS["V8"], **SIZED), has_gravity=True),
    "unsteady": replace(
        _machine(LAYOUTS["I4"]), drive=Drive(fluctuation=0.02, inertia=0.1), angular_acceleration=900.0
    ),
    "radial with weights": replace(MACHINES["radial-five"], has_gravity=True),
    "gas alone": replace(_machine(LAYOUTS["I4"]), masses=None),
    "motion alone": replace(_machine(LAYOUTS["I4"]), masses=None, gas=None),
    "enough": replace(_machine(LAYOUTS["I4"]), drive=Drive(fluctuation=0.02, inertia=1e3)),
    "shafts": _machine(LAYOUTS["I4"], balance_shafts=(2,), **SIZED),
}
every_machine = pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)


@pytest.fixture
def lines_of(groups_of):
    """Give the lines of a group by key."""

    def found(results, group, *degrees):
        groups = {one.name: one for one in groups_of(results, *degrees)}
        return {line.key: line for line in groups[group].lines} if group in groups else {}

    return found


@every_machine
@pytest.mark.parametrize("angle", [0.0, 17.3, 200.0, 355.5])
def test_steps_at_any_angle_are_the_columns_there(machine, angle, groups_of):
    results = crankwork.analyse(machine, CrankGrid.from_degrees([angle]))
    compared = set()
    for group in groups_of(results, angle, angle):
        if group.name not in ("engine_torque", "bearings"):
            continue
        assert group.degrees == angle
        for step in group.lines:
            if step.key in results.columns and step.key not in compared:
                scale = max(abs(results.columns[step.key][0]), *(abs(one.value) for one in group.lines))
                assert step.value == pytest.approx(results.columns[step.key][0], rel=1e-12, abs=1e-14 * scale), step.key
                compared.add(step.key)
    shown = ("crank_torque.", "total_torque", "journal_torque.", "crankpin_", "big_end", "small_end", "main_journal")
    wanted = {key for key in results.columns if key.startswith(shown)}
    assert wanted <= compared
    assert bool(wanted) == (machine is not MACHINES["motion alone"])


def _assert_is_its_formula(step):
    """Assert that a step is its formula as printed: to the bit, unless books print another form than is computed."""
    found = evaluate(step.expression, step.values)
    if step.formula.printed is None:
        assert found == step.value, step.key
    else:
        assert found == pytest.approx(step.value, rel=1e-13, abs=1e-14 * max(map(abs, step.values.values()))), step.key


@every_machine
def test_steps_are_their_formulas_belong_to_quantities_and_are_told_once(machine, groups_of):
    results = crankwork.analyse(machine)
    for group in groups_of(results):
        if group.name not in WHOLE:
            continue
        told = [step.key for step in group.lines if not isinstance(step, ValueLine)]
        assert sorted(told) == sorted(set(told))
        for step in group.lines:
            kind, _, name = step.key.partition(".")
            assert base_key(kind) in QUANTITIES, step.key
            assert all(part.isdigit() or has_text(f"report.{part}") for part in name.split(".") if part), step.key
            if isinstance(step, FormulaLine):
                _assert_is_its_formula(step)
            if isinstance(step, FormulaLine | SumLine) and step.key in results.summary:
                assert step.value == pytest.approx(results.summary[step.key], rel=1e-12), step.key


@every_machine
def test_rows_of_the_bearing_loads_are_those_of_the_lines(machine, lines_of):
    results = crankwork.analyse(machine)
    lines = lines_of(results, "bearing_loads")
    listing = results.listings.get("bearing_loads")
    for key in ("bearing_pressure", "bearing_pressure_max", "bearing_load_ratio") if listing else ():
        for name, value in zip(listing.names, listing.columns.get(key, ()), strict=False):
            shown = lines.get(f"{key}.{name}")
            assert np.isnan(value) if shown is None else shown.value == value, name
    assert bool(lines) == (listing is not None)


@every_machine
def test_what_formulas_leave_free_is_the_sum_of_the_vectors(machine):
    results = crankwork.analyse(machine)
    if "balance" not in results.listings:
        return
    listing = results.listings["balance"]
    balance = engine_balance(whole_engine(results.solved))
    for kind in ("force", "moment"):
        expected = [getattr(one, kind).largest for one in balance.rows.values()]
        found = listing.columns.get(f"free_{kind}", np.zeros(len(expected)))
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-13 * max(expected))


@every_machine
def test_the_harmonics_shown_are_those_in_which_all_cylinders_pull_together(machine, lines_of):
    results = crankwork.analyse(machine)
    lines = lines_of(results, "torque_harmonics")
    if lines:
        count, columns = len(machine.engine.layout.places), results.listings["torque_harmonics"].columns
        major = columns["harmonic_order"][np.isclose(columns["phase_sum"], count)][:3].tolist()
        kinds = ("harmonic_amplitude", "phase_sum", "total_harmonic_amplitude")
        assert list(lines) == [f"{kind}.{order:g}" for order in major for kind in kinds]
    uniform = len(set(map(id, whole_engine(results.solved).cylinders))) == 1
    assert bool(lines) == (uniform and "crank_torque" in results.columns)


@pytest.mark.parametrize("name", ["radial-five", "radial with weights"])
@pytest.mark.parametrize("angle", [10.0, 250.7, 463.0])
def test_the_articulated_rod_is_that_of_the_second_cylinder(name, angle, lines_of):
    results = crankwork.analyse(MACHINES[name])
    steps = lines_of(results, "articulated", 30.0, angle)
    whole = whole_engine(results.solved)
    keys = {
        "piston_velocity", "piston_acceleration", "gas_force", "inertia_force", "piston_force", "side_force",
        "rod_force", "knuckle_couple", "knuckle_side_force",
    }  # fmt: skip
    for key in keys:
        assert steps[f"{key}.2"].value == pytest.approx(
            replay(whole.of(2, key), CrankGrid.from_degrees([angle]))[0], rel=1e-11
        ), key
    assert math.asin(steps["rod_sine.articulated.2"].value) == pytest.approx(
        whole.each("rod_angle", [angle])[1, 0], rel=1e-12
    )
    # what the piston does, and what the mass at the knuckle pin and its weight do as that moves
    (x, y), mass = whole.cylinders[1].moving.slave.knuckle, whole.cylinders[1].machine.masses.rod_big_end
    a_x, a_y = (steps[f"knuckle_acceleration_{axis}.2"].value for axis in "xy")
    own = CrankGrid.from_degrees([angle - whole.layout.places[1].firing_angle])
    along, across = (replay(one.position_1, own)[0] for one in (x, y))
    torque = steps["piston_force.2"].value * steps["piston_transfer_1.2"].value
    torque -= mass * (a_x * along + a_y * across)
    if MACHINES[name].has_gravity:
        lean = math.radians(whole.layout.places[1].axis - whole.layout.places[0].axis)
        torque -= mass * whole.master.method.gravity * (math.cos(lean) * along - math.sin(lean) * across)
    shown = lines_of(results, "engine_torque", 30.0, angle)
    assert shown["crank_torque.2"].value == pytest.approx(torque, rel=1e-9)


def test_factors_of_usual_layouts_are_those_of_the_books(lines_of):
    """Kolchin and Demidov, ch. 8: four in line keep 4 P_jII, a cross-plane V8 keeps the moment sqrt(10) P_jI a."""
    four = lines_of(crankwork.analyse(MACHINES["I4"]), "balance")
    assert (four["force_factor.1"].value, four["force_factor.2"].value) == (0.0, pytest.approx(4.0))
    assert (four["moment_factor.1"].value, four["moment_factor.2"].value) == (0.0, 0.0)
    eight = lines_of(crankwork.analyse(MACHINES["V8"]), "balance")
    assert [eight[f"force_factor.{order}"].value for order in (1, 2, 4)] == pytest.approx([0, 0, math.sqrt(32)])
    assert eight["moment_factor.1"].value == pytest.approx(math.sqrt(10), rel=1e-13)
    assert eight["moment_factor.2"].value == 0


def test_the_textbook_shows_the_two_orders_that_it_has(lines_of):
    """m r w^2 and m r w^2 lambda."""
    results = crankwork.analyse(crankwork.with_method(MACHINES["petrol-four"], "textbook"))
    steps = lines_of(results, "balance")
    one = results["reciprocating_mass"] * results["crank_radius"] * results["speed"] ** 2
    assert steps["order_inertia_force.1"].value == pytest.approx(one, rel=1e-14)
    assert steps["free_force.reciprocating.2"].value == pytest.approx(4 * one * results["rod_ratio"], rel=1e-13)
    assert {key for key in steps if key.startswith("order_inertia_force")} == {
        "order_inertia_force.1", "order_inertia_force.2",
    }  # fmt: skip


def test_even_and_uneven_firing(lines_of):
    assert math.degrees(lines_of(crankwork.analyse(MACHINES["I4"]), "firing")["firing_interval"].value) == 180.0
    steps = lines_of(crankwork.analyse(MACHINES["V6"]), "firing")
    after = [math.degrees(steps[f"firing_interval.{k}"].value) for k in (1, 4, 2, 5, 3, 6)]
    assert "firing_interval" not in steps
    assert after == pytest.approx([90.0, 150.0] * 3)


def test_the_mean_torque_is_that_of_all_works(lines_of):
    results = crankwork.analyse(MACHINES["radial-five"])
    lines = lines_of(results, "uniformity")
    step = lines["mean_total_torque.indicated"]
    assert isinstance(step, SumLine)
    assert step.value == pytest.approx(lines["mean_total_torque"].value, rel=1e-9)
    assert len({one.value for one in step.terms}) > 1
    assert step.value * 4 * math.pi == pytest.approx(
        sum(one.space.work for one in whole_engine(results.solved).cylinders)
    )


def test_a_flywheel_that_is_not_needed_is_given_as_none(lines_of):
    steps = lines_of(crankwork.analyse(MACHINES["enough"]), "uniformity")
    assert steps["flywheel_inertia"] == ValueLine("flywheel_inertia", 0.0)
    assert 0 < steps["speed_fluctuation"].value < 0.02


def test_a_counterweight_takes_its_shares_and_what_is_given(lines_of):
    machine = _machine(LAYOUTS["I4"], counterweight=0.01, rotating_share=0.5, reciprocating_share=0.25)
    steps, m = lines_of(crankwork.analyse(machine), "balance"), machine.masses
    r = crankwork.analyse(machine)["crank_radius"]
    expected = (0.5 * (m.rod_big_end + m.crank) + 0.25 * m.reciprocating) * r + 0.01
    assert steps["counterweight_moment.1"].value == pytest.approx(expected, rel=1e-14)


def test_a_size_that_was_rounded_is_shown_before_and_after(groups_of):
    text = crankwork.template("whole-engine")
    for old, new in (
        ('radius = "40 mm"', "# radius"), ('bore = "80 mm"\n', ""), ('# power = "60 kW"', 'power = "60 kW"'),
    ):  # fmt: skip
        assert old in text
        text = text.replace(old, new, 1)
    results = crankwork.analyse(crankwork.read_machine(text))
    groups = groups_of(results)
    keys = [step.key for step in groups[0].lines]
    assert groups[0].name == "cycle"
    assert len(keys) == len(set(keys))
    steps = {step.key: step for step in groups[0].lines}
    asked, taken = steps["swept_volume.before_rounding"].value, steps["swept_volume.cycle"].value
    assert asked != taken
    assert taken == pytest.approx(results["swept_volume"], rel=1e-12)
    assert asked == pytest.approx(taken, rel=0.05)
    for key in keys:
        if key in results.summary:
            assert steps[key].value == pytest.approx(results.summary[key], rel=1e-12), key


def test_what_a_cycle_was_given_comes_before_what_it_calculates(groups_of):
    group = groups_of(crankwork.analyse(MACHINES["petrol-four"]))[0]
    keys = [step.key for step in group.lines]
    assert keys.index("excess_air") < keys.index("air_mass_needed") < keys.index("filling_factor.diagram")
    assert "displacement.cycle" in keys
