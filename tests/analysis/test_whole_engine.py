"""The whole engine: each cylinder is the engine of one cylinder, and sums, orders and energies agree."""

from __future__ import annotations

import functools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis import columns
from crankwork.analysis.all_cylinders import EngineTrace
from crankwork.analysis.cylinder_balance import engine_balance
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.analysis.one_cylinder import own_key
from crankwork.analysis.shaft_torque import engine_torque
from crankwork.cylinders.arrangement import boxer, inline, radial, vee
from crankwork.cylinders.articulated import articulated_motion
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Bearings, Drive, Engine, Machine
from crankwork.report.summary import summary_data
from engines import cylinder_angle

EXAMPLES = Path(__file__).parents[2] / "examples"
ENGINES = ("petrol-four", "v8-diesel", "radial-five", "two-stroke")
PETROL = crankwork.read(EXAMPLES / "spark-engine.toml")
LAYOUTS = {
    "I4": inline(4, (1, 3, 4, 2), spacing=0.12)[0],
    "V6": vee(6, (1, 4, 2, 5, 3, 6), 90.0, spacing=0.12, bank_stagger=0.03, throws=(0, 120, 240), uneven=True)[0],
    "V8": vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0, spacing=0.12, bank_stagger=0.03)[0],
    "B4": boxer(4, (1, 4, 3, 2), spacing=0.12)[0],
    "R7": radial(7, master=0)[0],
}


def _machine(layout, **changes) -> Machine:
    method = PETROL.method.named("exact")
    return replace(PETROL, method=replace(method, inertia_rod_ratio=None), engine=Engine(layout, **changes))


@functools.cache
def analysed(name):
    return crankwork.analyse(_machine(LAYOUTS[name]))


@pytest.mark.parametrize("name", LAYOUTS)
def test_a_cylinder_is_the_engine_of_one_cylinder_to_the_last_bit(name):
    machine, layout = _machine(LAYOUTS[name]), LAYOUTS[name]
    alone = crankwork.analyse(replace(machine, engine=None))
    whole = multi_cylinder_engine(replace(alone.solved, machine=machine))
    degrees = np.arange(0.0, 720.0, 7.5)
    for at, place in enumerate(layout.places):
        local = np.mod(degrees - place.firing_angle, 720.0)
        order = np.argsort(local)
        single = columns(alone.solved, CrankGrid.from_degrees(local[order]))
        if float(place.firing_angle).is_integer():
            for key, values in single.items():
                assert np.array_equal(whole.each(key, degrees)[at][order], values), key
    results = analysed(name)
    assert np.array_equal(results["crank_torque.1"], alone["crank_torque"])
    for key, values in alone.columns.items():
        assert np.array_equal(results.columns[own_key(machine, key)], values), key


def test_checks_hold():
    wrong = {}
    for name in LAYOUTS:
        checks = analysed(name).checks
        assert {"engine_work", "phase_stars", "free_forces"} <= set(checks), name
        wrong |= {(name, key): one for key, one in checks.items() if not one < 1e-10}
    for name in ENGINES:
        checks = crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml")).checks
        assert ("first_law" in checks) == (name == "two-stroke"), name
        exact = ("work", "engine_work", "free_forces")
        assert set(exact) <= set(checks), name
        wrong |= {(name, key): one for key, one in checks.items() if not one < (1e-10 if key in exact else 1e-8)}
    assert wrong == {}


@pytest.mark.parametrize("name", LAYOUTS)
def test_the_torque_curve_is_the_torque_and_loads_of_a_shaft_are_in_equilibrium(name):
    """The main bearings hold what rods and throws put on the shaft, at every crank angle."""
    results, layout = analysed(name), LAYOUTS[name]
    machine, whole = results.machine, multi_cylinder_engine(results.solved)
    torque = engine_torque(*EngineTrace.of(whole.master)[:4])
    degrees = np.arange(3.7, 720.0, 11.31)
    found = whole.each("crank_torque", degrees)
    scale = float(np.max(np.abs(found)))
    assert torque.cylinder(np.radians(degrees)) == pytest.approx(found[0], abs=1e-8 * scale)
    assert torque.total(np.radians(degrees)) == pytest.approx(found.sum(axis=0), abs=1e-8 * scale)
    degrees = np.arange(0.0, 720.0, 15.0)
    mains = [name for name in results.listings["bearing_loads"].names if name.startswith("main_journal.")]
    loads = results.columns_at(degrees, [f"bearing_force_{axis}.{name}" for name in mains for axis in "xy"])
    radial, tangential = whole.each("radial_force", degrees), whole.each("tangential_force", degrees)
    r, w = whole.master.lengths.crank_radius, whole.master.speed
    total = np.zeros(len(degrees), dtype=complex)
    throws = {place.crankpin: place for place in layout.places}
    for at, place in enumerate(layout.places):
        outward = -radial[at] + machine.masses.rod_big_end * r * w**2
        total += (outward + 1j * tangential[at]) * np.exp(1j * np.radians(place.pin_angle))
    for place in throws.values():
        total += machine.masses.crank * r * w**2 * np.exp(1j * np.radians(place.pin_angle))
    held = sum(loads[f"bearing_force_x.{name}"] + 1j * loads[f"bearing_force_y.{name}"] for name in mains)
    assert np.max(np.abs(held + total)) < 1e-10 * np.max(np.abs(radial))


def test_counterweights_take_the_load_off_the_main_bearings():
    layout = LAYOUTS["I4"]
    bare = analysed("I4").listings["bearing_loads"]
    with_weights = crankwork.analyse(_machine(layout, rotating_share=1.0)).listings["bearing_loads"]
    middle = bare.names.index("main_journal.3")
    assert with_weights.columns["mean_bearing_load"][middle] < bare.columns["mean_bearing_load"][middle]


def test_full_counterweights_and_shafts_leave_nothing_of_the_first_two_orders():
    machine = _machine(LAYOUTS["I4"], rotating_share=1.0, balance_shafts=(2,))
    whole = multi_cylinder_engine(crankwork.analyse(machine).solved)
    left = {one.order: one for one in engine_balance(whole).residual}
    single = machine.masses.reciprocating * whole.master.lengths.crank_radius * whole.master.speed**2
    assert left[1].force.largest < 1e-9 * single
    assert left[2].force.largest < 1e-9 * single
    assert left[4].force.largest > 0


def test_a_radial_engine_of_five_or_more_has_no_free_second_order():
    for cylinders in (5, 9):
        machine = _machine(radial(cylinders, master=0)[0])
        whole = multi_cylinder_engine(crankwork.analyse(machine).solved)
        free = {one.order: one.force.largest for one in engine_balance(whole).reciprocating}
        assert free[2] == 0, cylinders
        # half of every reciprocating mass turns with the crank
        single = machine.masses.reciprocating * whole.master.lengths.crank_radius * whole.master.speed**2
        assert free[1] == pytest.approx(cylinders / 2 * single, rel=0.02), cylinders


def test_the_torque_of_an_articulated_cylinder_is_that_of_the_power_of_its_piston_and_its_knuckle_pin():
    results = crankwork.analyse(crankwork.read(EXAMPLES / "radial-five.toml"))
    whole = multi_cylinder_engine(results.solved)
    degrees = np.arange(1.0, 720.0, 9.0)
    pushed, turned = whole.each("piston_force", degrees), whole.each("crank_torque", degrees)
    for at, (solved, rod) in enumerate(zip(whole.cylinders, whole.engine.articulated_rods, strict=True)):
        if rod is None:
            continue
        grid = CrankGrid.from_degrees(cylinder_angle(degrees, whole.layout.places[at], 720.0))
        moving = articulated_motion(solved.lengths, rod, grid)
        mass, w = solved.machine.masses.rod_big_end, solved.speed
        accelerated = sum(one.position_1 * one.position_2 for one in moving.knuckle)
        torque = pushed[at] * moving.piston.position_1 - mass * w**2 * accelerated
        assert turned[at] == pytest.approx(torque, abs=1e-9 * np.max(np.abs(torque)))


def test_strokes_of_articulated_cylinders_differ_from_that_of_the_master():
    whole = multi_cylinder_engine(crankwork.analyse(crankwork.read(EXAMPLES / "radial-five.toml")).solved)
    strokes = [one.stroke[0] for one in whole.cylinders]
    assert strokes[0] == pytest.approx(0.115)
    assert strokes[1] == pytest.approx(strokes[4], abs=1e-9)
    assert strokes[2] == pytest.approx(strokes[3], abs=1e-9)
    assert len({round(one, 6) for one in strokes}) == 3


def test_the_flywheel_gives_the_wanted_fluctuation():
    machine = replace(_machine(LAYOUTS["I4"]), drive=Drive(fluctuation=0.01, inertia=0.05))
    results = crankwork.analyse(machine)
    assert results["speed_fluctuation"] == pytest.approx(0.01, rel=1e-12)
    w, degrees = results["speed"], np.arange(7200) / 10 + 0.05
    columns = results.columns_at(degrees, ["crank_speed", "reduced_inertia"])
    assert 1 / np.mean(1 / columns["crank_speed"]) == pytest.approx(w, rel=1e-8)
    # the energy of all masses and of the flywheel gains what the gas does
    inertia = columns["reduced_inertia"] + results["flywheel_inertia"]
    energy = inertia * columns["crank_speed"] ** 2 / 2
    torque = results.columns_at(degrees, ["total_torque", "reduced_inertia_1"])
    gas = torque["total_torque"] + w**2 / 2 * torque["reduced_inertia_1"]
    work = np.cumsum(gas - np.mean(gas)) * np.radians(0.1)
    assert np.ptp(energy - work) < 0.005 * np.ptp(work)


def test_excess_work_is_that_of_a_fine_sum():
    results = analysed("I4")
    whole = multi_cylinder_engine(results.solved)
    degrees = np.linspace(0.0, 720.0, 14401)
    torque = whole.each("crank_torque", degrees).sum(axis=0)
    excess = np.cumsum((torque - np.mean(torque[:-1]))[:-1]) * np.radians(0.05)
    assert results["excess_work.mertsalov"] == pytest.approx(np.ptp(excess), rel=1e-3)


def test_specific_loads_need_the_sizes():
    layout = LAYOUTS["I4"]
    assert "bearing_pressure" not in analysed("I4").listings["bearing_loads"].columns
    sized = crankwork.analyse(_machine(layout, bearings=Bearings(0.06, 0.03)))
    listing = sized.listings["bearing_loads"]
    largest = listing.columns["bearing_load_max"][0] / (0.06 * 0.03)
    assert listing.columns["bearing_pressure_max"][0] == pytest.approx(largest, rel=1e-15)
    assert np.isnan(listing.columns["bearing_pressure_max"][listing.names.index("main_journal.1")])


def test_crankpins_that_only_differ_in_time_are_listed_once():
    names = {layout: analysed(layout).listings["bearing_loads"].names for layout in ("I4", "V8")}
    pins = {layout: [name for name in every if name.startswith("crankpin")] for layout, every in names.items()}
    assert pins == {"I4": ["crankpin.1"], "V8": ["crankpin.1", "crankpin.4"]}


def test_weights_act_along_each_bank():
    """Weights towards the shaft are those of the lean of each bank, both from the vertical as the V stands upright."""
    machine = replace(_machine(LAYOUTS["V8"]), has_gravity=True)
    whole = multi_cylinder_engine(crankwork.analyse(machine).solved)
    found = whole.each("weight_force", np.arange(0.0, 720.0, 1.0))
    weight = machine.masses.reciprocating * machine.method.gravity
    assert found == pytest.approx(np.full_like(found, weight * np.cos(np.radians(45.0))))


def test_listings_reach_the_tables():
    results = crankwork.analyse(crankwork.read(EXAMPLES / "petrol-four.toml"))
    assert {"firing", "torque_harmonics", "bearing_loads", "crankpin_wear", "main_wear", "balance"} == set(
        results.listings
    )
    assert {"engine_torque", "accumulated_torque", "bearings", "main_journals", "speed"} <= set(results.tables)
    assert results.listings["firing"].columns["firing_interval"] == pytest.approx(np.radians(180.0))


@pytest.mark.parametrize("name", ["v-twin", "narrow-v6", "radial-five"])
def test_the_best_share_leaves_least_of_what_turns_with_the_crank(name: str) -> None:
    """Tried out: what is left of the first order is least at that share, with counterweights of that mass moment."""
    v_twin = EXAMPLES.parent / "tests" / "machines" / "v-two.toml"
    machine = crankwork.read(v_twin if name == "v-twin" else EXAMPLES / f"{name}.toml")
    machine = replace(machine, method=machine.method.named("exact"))

    def left(share: float) -> float:
        engine = replace(
            machine.engine, rotating_share=1.0, reciprocating_share=share, counterweight=0.0, balance_shafts=()
        )
        (first, *_) = engine_balance(
            multi_cylinder_engine(crankwork.analyse(replace(machine, engine=engine)).solved)
        ).residual
        return abs(first.force.forward) or abs(first.moment.forward)

    found = crankwork.analyse(machine)
    best = found.value("best_balanced_share")
    assert left(best) < min(left(best - 1e-4), left(best + 1e-4))
    if name == "v-twin":
        # half of a mass that swings turns with the crank, whatever the angle of the banks
        assert best == pytest.approx(0.5, abs=1e-12)
        assert found.value("best_counterweight_moment") == pytest.approx(
            (found["rotating_mass"] * 2 - found.trace["crank_mass"].value + found["reciprocating_mass"])
            * found["crank_radius"]
        )


def test_what_is_free_of_forces_stands_before_one_cylinder_and_its_cycle() -> None:
    results = crankwork.analyse(crankwork.read(EXAMPLES / "petrol-four.toml"))
    keys = list(summary_data(results)["summary"])
    assert keys.index("free_force.residual.2") < keys.index("piston_velocity_max") < keys.index("excess_air")
    assert set(keys) == set(results.summary)
    second = 4 * results["reciprocating_mass"] * results["crank_radius"] * results["speed"] ** 2 * results["rod_ratio"]
    # lambda cos 2 phi and what the next powers of lambda add to it, below lambda^2 / 4
    assert results["free_force.residual.2"] == pytest.approx(second, rel=results["rod_ratio"] ** 2 / 3)
    assert not any(key.startswith("best_") for key in keys)
