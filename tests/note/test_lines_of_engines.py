"""Worked steps of whole engines: values of the results at any crank angle, rows of the listings, factors of books."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinder_balance import engine_balance
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.formula.calculation_lines import SumLine, ValueLine
from crankwork.formula.replay import replay
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.lines import lines_of
from note.built import BUILT, broken, laid_out, lines, looked_at, machine, results

EXAMPLES = ("narrow-v6", "petrol-four", "radial-five", "two-stroke", "v8-diesel")
# of every cylinder and bearing
SHOWN = ("crank_torque.", "total_torque", "journal_torque.", "crankpin_", "big_end", "small_end", "main_journal")
SOME = ("I4", "V6", "weights", "radial with weights", "four without gas")
OTHERS = sorted({*BUILT, *EXAMPLES} - set(SOME))

every_machine = looked_at(SOME, OTHERS)


def wrong_at(name, *angles):
    """Return the steps that are not the columns of the results at crank angles."""
    found = crankwork.analyse(machine(name), CrankGrid.from_degrees(list(angles)))
    wrong, wanted = [], {key for key in found.columns if key.startswith(SHOWN)}
    assert bool(wanted) == (name != "four without gas")
    for row, angle in enumerate(angles):
        compared = set()
        for group in lines_of(found, angle, angle):
            if group.name not in ("engine_torque", "bearings"):
                continue
            assert group.degrees == angle
            for step in group.lines:
                if step.key in found.columns and step.key not in compared:
                    compared.add(step.key)
                    column = found.columns[step.key][row]
                    scale = max(abs(column), *(abs(one.value) for one in group.lines))
                    if step.value != pytest.approx(column, rel=1e-12, abs=1e-14 * scale):
                        wrong.append((step.key, angle))
        wrong += [(key, angle) for key in wanted - compared]
    return wrong


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cases", "angles"),
    [(SOME, (17.3, 355.5)), pytest.param(OTHERS, (200.0,), marks=pytest.mark.slow)],
    ids=["some", "more"],
)
def test_steps_at_any_angle_are_the_columns_there(cases, angles):
    assert broken(wrong_at, [(name, *angles) for name in cases]) == {}


def wrong_rows(name):
    """Return the bearings of which the listing and the lines say something else."""
    listing, steps = results(name).listings.get("bearing_loads"), lines(name, "bearing_loads")
    assert bool(steps) == (listing is not None)
    wrong = []
    for key in ("bearing_pressure", "bearing_pressure_max", "bearing_load_ratio") if listing else ():
        for bearing, value in zip(listing.names, listing.columns.get(key, ()), strict=False):
            shown = steps.get(f"{key}.{bearing}")
            if not (np.isnan(value) if shown is None else shown.value == value):
                wrong.append(f"{key}.{bearing}")
    return wrong


@every_machine
def test_rows_of_the_bearing_loads_are_those_of_the_lines(cases):
    assert broken(wrong_rows, cases) == {}


def wrong_balance(name):
    """Return the free forces and moments by formulas that are not the sums of the vectors."""
    listing, wrong = results(name).listings.get("balance"), []
    if listing:
        rows = engine_balance(multi_cylinder_engine(results(name).solved)).rows.values()
        for kind in ("force", "moment"):
            expected = [getattr(one, kind).largest for one in rows]
            found = listing.columns.get(f"free_{kind}", np.zeros(len(expected)))
            if found != pytest.approx(expected, rel=1e-12, abs=1e-13 * max(expected)):
                wrong.append((kind, found))
    assert bool(listing) == (machine(name).masses is not None)
    return wrong


@every_machine
def test_what_formulas_leave_free_is_the_sum_of_the_vectors(cases):
    assert broken(wrong_balance, cases) == {}


def wrong_harmonics(name):
    """Return the harmonics that are shown where they are not those in which all cylinders pull together."""
    found, shown = results(name), list(lines(name, "torque_harmonics"))
    uniform = len(set(map(id, multi_cylinder_engine(found.solved).cylinders))) == 1
    if not (uniform and "crank_torque" in found.columns):
        return shown
    count, columns = len(machine(name).engine.layout.places), found.listings["torque_harmonics"].columns
    major = columns["harmonic_order"][np.isclose(columns["phase_sum"], count)][:3].tolist()
    kinds = ("harmonic_amplitude", "phase_sum", "total_harmonic_amplitude")
    return shown if shown != [f"{kind}.{order:g}" for order in major for kind in kinds] else []


@every_machine
def test_the_harmonics_shown_are_those_in_which_all_cylinders_pull_together(cases):
    assert broken(wrong_harmonics, cases) == {}


@pytest.mark.parametrize(
    ("name", "angles"),
    [("radial with weights", (250.7,)), pytest.param("radial-five", (10.0, 463.0), marks=pytest.mark.slow)],
)
def test_the_articulated_rod_is_that_of_the_second_cylinder(name, angles):
    whole = multi_cylinder_engine(results(name).solved)
    own_keys = (
        "piston_velocity", "piston_acceleration", "gas_force", "inertia_force", "piston_force", "side_force",
        "rod_force", "knuckle_couple", "knuckle_side_force",
    )  # fmt: skip
    (x, y), mass = whole.cylinders[1].moving.articulated_rod.knuckle, whole.cylinders[1].machine.masses.rod_big_end
    for angle in angles:
        steps = {key: step.value for key, step in lines(name, "articulated", 30.0, angle).items()}
        for key in own_keys:
            own = replay(whole.of(2, key), CrankGrid.from_degrees([angle]))[0]
            assert steps[f"{key}.2"] == pytest.approx(own, rel=1e-11), (key, angle)
        rod_angle = whole.each("rod_angle", [angle])[1, 0]
        assert math.asin(steps["rod_sine.articulated.2"]) == pytest.approx(rod_angle, rel=1e-12)
        # what the piston does, and what the mass at the knuckle pin and its weight do as that moves
        turned = CrankGrid.from_degrees([angle - whole.layout.places[1].firing_angle])
        along, across = (replay(one.position_1, turned)[0] for one in (x, y))
        torque = steps["piston_force.2"] * steps["piston_transfer_1.2"]
        torque -= mass * (steps["knuckle_acceleration_x.2"] * along + steps["knuckle_acceleration_y.2"] * across)
        if machine(name).has_gravity:
            lean = math.radians(whole.layout.places[1].axis - whole.layout.places[0].axis)
            torque -= mass * whole.master.method.gravity * (math.cos(lean) * along - math.sin(lean) * across)
        shown = lines(name, "engine_torque", 30.0, angle)["crank_torque.2"].value
        assert shown == pytest.approx(torque, rel=1e-9), angle


def test_factors_of_usual_layouts_are_those_of_the_books():
    """Kolchin and Demidov, ch. 8: four in line keep 4 P_jII, a cross-plane V8 keeps the moment sqrt(10) P_jI a."""
    four, eight = lines("I4", "balance"), lines("V8", "balance")
    assert (four["force_factor.1"].value, four["force_factor.2"].value) == (0.0, pytest.approx(4.0))
    assert (four["moment_factor.1"].value, four["moment_factor.2"].value) == (0.0, 0.0)
    assert [eight[f"force_factor.{order}"].value for order in (1, 2, 4)] == pytest.approx([0, 0, math.sqrt(32)])
    assert eight["moment_factor.1"].value == pytest.approx(math.sqrt(10), rel=1e-13)
    assert eight["moment_factor.2"].value == 0


def test_the_textbook_shows_the_two_orders_that_it_has():
    """m r w^2 and m r w^2 lambda."""
    found, steps = results("petrol-four: textbook"), lines("petrol-four: textbook", "balance")
    one = found["reciprocating_mass"] * found["crank_radius"] * found["speed"] ** 2
    assert steps["order_inertia_force.1"].value == pytest.approx(one, rel=1e-14)
    assert steps["free_force.reciprocating.2"].value == pytest.approx(4 * one * found["rod_ratio"], rel=1e-13)
    orders = [key for key in steps if key.startswith("order_inertia_force")]
    assert sorted(orders) == ["order_inertia_force.1", "order_inertia_force.2"]


def test_even_and_uneven_firing():
    assert math.degrees(lines("I4", "firing")["firing_interval"].value) == 180.0
    steps = lines("V6", "firing")
    assert "firing_interval" not in steps
    after = [math.degrees(steps[f"firing_interval.{k}"].value) for k in (1, 4, 2, 5, 3, 6)]
    assert after == pytest.approx([90.0, 150.0] * 3)


def test_the_mean_torque_is_that_of_all_works():
    cylinders = multi_cylinder_engine(results("radial with weights").solved).cylinders
    steps = lines("radial with weights", "uniformity")
    step = steps["mean_torque.indicated"]
    assert isinstance(step, SumLine)
    assert step.value == pytest.approx(steps["mean_total_torque"].value, rel=1e-9)
    assert len({one.value for one in step.terms}) > 1
    assert step.value * 4 * math.pi == pytest.approx(sum(one.space.work for one in cylinders))


def test_a_flywheel_that_is_not_needed_is_given_as_none():
    steps = lines("enough", "uniformity")
    assert steps["flywheel_inertia"] == ValueLine("flywheel_inertia", 0.0)
    assert 0 < steps["speed_fluctuation"].value < 0.02


def test_a_counterweight_takes_its_shares_and_what_is_given():
    found = crankwork.analyse(laid_out("I4", counterweight=0.01, rotating_share=0.5, reciprocating_share=0.25))
    balance = next(one for one in lines_of(found) if one.name == "balance")
    shown = next(step for step in balance.lines if step.key == "counterweight_moment.1")
    m = found.machine.masses
    expected = (0.5 * (m.rod_big_end + m.crank) + 0.25 * m.reciprocating) * found["crank_radius"] + 0.01
    assert shown.value == pytest.approx(expected, rel=1e-14)


def test_a_size_that_was_rounded_is_shown_before_and_after():
    text = crankwork.template("whole-engine")
    for old, new in (
        ('radius = "40 mm"', "# radius"), ('bore = "80 mm"\n', ""), ('# power = "60 kW"', 'power = "60 kW"'),
    ):  # fmt: skip
        assert old in text
        text = text.replace(old, new, 1)
    found = crankwork.analyse(crankwork.read_machine(text))
    cycle = lines_of(found)[0]
    steps = {step.key: step.value for step in cycle.lines}
    assert cycle.name == "cycle"
    assert len(cycle.lines) == len(steps)
    asked, taken = steps["swept_volume.before_rounding"], steps["swept_volume.cycle"]
    assert asked != taken
    assert taken == pytest.approx(found["swept_volume"], rel=1e-12)
    assert asked == pytest.approx(taken, rel=0.05)
    known = {key: value for key, value in steps.items() if key in found.summary}
    assert known == pytest.approx({key: found.summary[key] for key in known}, rel=1e-12)


def test_what_a_cycle_was_given_comes_before_what_it_calculates():
    keys = list(lines("petrol-four", "cycle"))
    assert keys.index("excess_air") < keys.index("air_mass_needed") < keys.index("filling_factor.diagram")
    assert "displacement.cycle" in keys
