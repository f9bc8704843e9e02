"""Every worked step: its formula gives its value, and its value is that of the results."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinder_forces import columns, force_functions
from crankwork.dynamics.efficiency import efficiency, traced_efficiency
from crankwork.errors import MethodError
from crankwork.formula.calculation_lines import FormulaLine, Snapshot, SumLine, ValueLine
from crankwork.formula.expression import evaluate
from crankwork.formula.traced_value import Input
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.measured_pressure import MeasuredPressure
from crankwork.locale import has_text
from crankwork.note.lines import lines_of
from crankwork.quantities import QUANTITIES, base_key
from note.built import (
    BUILT,
    ENGINES,
    LINKAGES,
    SOME,
    VARIANTS,
    broken,
    groups,
    key_of,
    lines,
    looked_at,
    machine,
    results,
)

WAYS = tuple(f"everything: {way}" for way in ("exact", "textbook", "series:6"))
# groups of steps of whole engines, whose keys end with names and numbers
OF_ENGINES = {
    "firing", "engine_torque", "articulated", "bearings", "bearing_loads", "torque_harmonics", "uniformity", "balance",
}  # fmt: skip
# what a solver, an integral or an extreme over the revolution gives
NO_FORMULA = {
    "crank_angle", "efficiency", "speed_fluctuation", "final_turn", "final_speed", "steady_speed",
    "steady_fluctuation", "mean_torque", "mean_friction_power", "kinetic_energy_change", "crank_speed", "time",
    # a sum of what is shown
    "indicated_power",
}  # fmt: skip
SOLVED_KINDS = (
    "joint_force", "normal_force", "normal_moment", "link_angle", "link_swing", "slider_stroke", "slider_displacement",
    "point_x", "point_y", "transmission_angle", "time_ratio", "shaking_force_max", "free_force", "free_moment",
    "torque_with_friction", "static_torque_with_friction", "shaking_moment_amplitude", "mean_crankpin_load",
)  # fmt: skip
# extremes over the revolution, where they stand, and the error of a method
OVER_THE_REVOLUTION = ("_angle", "_time", "_error", "_max", "_min")

every_machine = looked_at(
    (*SOME, *WAYS, "press, central", "unsteady linkage", "heavy rotor", "I4"),
    (*VARIANTS, "long crank: textbook", "two rod ratios: series:6", *BUILT, *ENGINES),
    (*LINKAGES, "andrews-squeezer", "press template", "whitworth template"),
)


def expected(case, group, key):
    """Return the value that the results have of a key at the crank angle of a group, or None."""
    found = results(case)
    key = key_of(found, key)
    if key in found.summary:
        return found.summary[key]
    if group.degrees is None or key not in found.columns:
        return None
    row = int(np.argmin(np.abs(found.grid.degrees - group.degrees)))
    if "piston_displacement" in found.columns and found.grid.degrees[row] != group.degrees:
        return None
    return float(found.columns[key][row])


def is_its_formula(step):
    """Return whether a step is its formula as printed: to the bit, unless books print another than is computed."""
    found = evaluate(step.expression, step.values)
    if step.formula.printed is None:
        # the C library may round the square of one number otherwise than NumPy that of a column
        of_column = evaluate(step.expression, {name: np.array([one]) for name, one in step.values.items()})
        return step.value in (found, float(np.squeeze(of_column)))
    return found == pytest.approx(step.value, rel=1e-13, abs=1e-14 * max(map(abs, step.values.values())))


def wrong_values(case):
    """Return the steps that are not their formula or sum, or not what the results have."""
    compared = []
    for group in groups(case):
        for step in group.lines:
            right = True
            if isinstance(step, FormulaLine):
                right = is_its_formula(step)
            elif isinstance(step, SumLine):
                right = sum(one.value for one in step.terms) == step.value
            if (value := expected(case, group, step.key)) is not None:
                # an engine adds its cylinders in another order
                small = 1e-14 * max(abs(one.value) for one in group.lines) if group.name in OF_ENGINES else 0
                right = right and step.value == pytest.approx(value, rel=1e-12, abs=small)
            compared += [(step.key, right)] * (value is not None or not right)
    assert len(compared) > 5
    return [key for key, right in compared if not right]


@pytest.mark.slow
@every_machine
def test_a_step_is_its_formula_at_its_values_and_the_value_of_the_results(cases):
    assert broken(wrong_values, cases) == {}


def wrong_keys(case):
    """Return the steps that belong to no quantity, have a name without words, or are told twice."""
    wrong = []
    for group in groups(case):
        # extremes stand each at its own crank angle, with terms that are called the same
        told = [one.key for one in group.lines if group.name == "force_extremes" or not isinstance(one, ValueLine)]
        wrong += [f"{key} twice" for key in set(told) if told.count(key) > 1]
        for step in group.lines:
            kind, _, name = step.key.partition(".")
            is_named = all(part.isdigit() or has_text(f"report.{part}") for part in name.split(".") if part)
            if base_key(step.key) not in QUANTITIES or base_key(kind) not in QUANTITIES:
                wrong.append(f"{step.key} is no quantity")
            elif group.name in OF_ENGINES and not is_named:
                wrong.append(f"{step.key} has no name")
    return wrong


@every_machine
def test_a_step_belongs_to_a_quantity_and_is_told_once(cases):
    assert broken(wrong_keys, cases) == {}


def without_step(case):
    """Return the values that are neither shown nor given nor solved for."""
    found, given = results(case), getattr(results(case).machine, "loads", True)
    told = {step.key for group in groups(case) for step in group.lines}
    shown = {key for key, known in found.trace.items() if known.key in told} | told
    left = {key for key in {*found.summary, *found.columns} - shown - NO_FORMULA if base_key(key) in QUANTITIES}
    kinds = {key: key.partition(".")[0] for key in left}
    left = {key for key in left if not kinds[key].startswith(SOLVED_KINDS)}
    left = {key for key in left if not kinds[key].endswith(OVER_THE_REVOLUTION)}
    left = {key for key in left if not isinstance(found.trace[key].node, Input)}
    if not given:
        left -= {"static_torque"}
    if (space := getattr(found.solved, "space", None)) is not None and space.calculated is not None:
        # what a calculated cycle begins with stands among the givens
        left -= {"compression_ratio"}
    if "rod_length" not in found.summary:
        # worked by courses only that have a pi of their own
        left -= {"speed"}
    if "flywheel_inertia.exact" in found.summary:
        # it is that of the exact method
        left -= {"flywheel_inertia"}
    return {key for key in left if not key.startswith("flywheel_inertia.") or found.summary[key]}


@looked_at(SOME, (*WAYS, *VARIANTS, *ENGINES), (*LINKAGES, "andrews-squeezer", "whitworth template"))
def test_what_has_no_step_is_given_or_solved_for(cases):
    assert broken(without_step, cases) == {}


@pytest.mark.parametrize("name", ["press", "press-geometry"])
def test_a_given_speed_is_not_worked_out_of_the_revolutions_that_follow_from_it(name):
    assert not lines(name, "speed")
    one = machine(name)
    found = crankwork.analyse(replace(one, method=replace(one.method, pi=3.14)))
    (step,) = next(group.lines for group in lines_of(found) if group.name == "speed")
    assert step.value == pytest.approx(14.65 * 3.14 / math.pi, rel=1e-15)
    assert found.summary["speed"] == pytest.approx(step.value, rel=1e-15)


@pytest.mark.parametrize("method", ["exact", "textbook", "series:9"])
def test_forces_are_those_of_the_columns_at_any_angle(method):
    case, wrong = f"everything: {method}", []
    found = results(case)
    for angle in (0.0, 37.3, 181.0, 360.0):
        shown = {group.name: group for group in groups(case, angle, 720.0 - angle)}
        for name, degrees, least in (("motion", angle, 6), ("forces", 720.0 - angle, 12)):
            known = columns(found.solved, CrankGrid.from_degrees([degrees]))
            steps = {step.key: step.value for step in shown[name].lines if step.key in known}
            assert shown[name].degrees == degrees
            assert len(steps) >= least
            for key, value in steps.items():
                # a force that passes zero keeps the rounding of its parts
                scale = max(np.max(np.abs(found.columns[key])), abs(known[key][0]))
                if value != pytest.approx(known[key][0], rel=1e-12, abs=1e-14 * scale):
                    wrong.append((key, angle))
    assert wrong == []


def test_ends_of_polytropes_are_those_of_the_diagram():
    steps, diagram = lines("engine of points: exact", "gas"), results("engine of points: exact").solved.space.diagram
    ends = [segment for segment in diagram.segments if segment.law == "polytropic"]
    shown = [steps[f"diagram_pressure.{point}"].value for point in ("c1", "b1")]
    assert shown == pytest.approx([segment.pressures[-1] for segment in ends], rel=1e-13)
    assert shown[0] == pytest.approx(diagram.named["c1"][1], rel=1e-13)


def test_flywheels_are_shown_in_all_four_ways():
    summary, shown = results("heavy rotor").summary, lines("heavy rotor", "flywheel").keys()
    assert {key for key in summary if key.startswith("flywheel_inertia.") and summary[key]} <= shown
    assert {"excess_work", "whole_inertia.energy", "wittenbauer_slope.exact.largest", "energy_fluctuation"} <= shown


def test_steps_are_shown_in_the_working_stroke_and_at_the_nearest_angle_that_is_reached():
    engine = {one.name: one.degrees for one in groups("engine template: exact")}
    compressor = {one.name: one.degrees for one in groups("compressor template")}
    press = {one.name: one.degrees for one in groups("press", 100.0)}
    shown = (engine["motion"], engine["forces"], compressor["forces"], press["torques"])
    assert shown == pytest.approx((30.0, 390.0, 30.0, 90.0))


def test_torques_of_a_linkage_are_shown_where_asked():
    found = results("toggle-press template")
    row = int(np.argmax(np.abs(found.columns["static_torque"])))
    at = float(found.grid.degrees[row])
    torque = lines("toggle-press template", "torques", at)["static_torque"].value
    assert torque == found.columns["static_torque"][row] != 0
    reduced = lines("toggle-press template", "reduction", at)["reduced_torque"].value
    assert reduced == pytest.approx(-torque, rel=1e-13)


def test_a_chain_of_efficiencies_multiplies_to_that_of_the_chain():
    chain = ((0.98, 0.98), 0.98, 0.99, (0.9, 0.8, 0.7, 0.6))
    found = traced_efficiency(chain)
    assert found.value == pytest.approx(0.98 * 0.98 * 0.99 * 0.75, rel=1e-15)
    line = Snapshot(CrankGrid.from_degrees, 0.0).step(found)
    assert [key for _, key in line.named] == [f"efficiency.{i}" for i in range(1, 5)]
    assert efficiency((0.9,)) == 0.9


def test_a_measured_pressure_is_given_and_not_calculated():
    engine, degrees = machine("engine of points"), np.arange(721.0)
    pressure = 1e5 + 3e6 * np.exp(-(((degrees - 372) / 25) ** 2))
    measured = MeasuredPressure(degrees, pressure, range(2, 723))
    found = crankwork.analyse(replace(engine, gas=replace(engine.gas, points={}, pieces=(), measured=measured)))
    steps = {group.name: {step.key: step for step in group.lines} for group in lines_of(found)}
    read = steps["forces"]["diagram_pressure"]
    assert isinstance(read, ValueLine)
    assert read.value == pytest.approx(pressure[390], rel=1e-12)
    assert steps["gas"].keys() == {"piston_area", "swept_volume", "clearance_volume", "compression_ratio"}
    row = int(np.argmin(np.abs(found.grid.degrees - 390.0)))
    forces = {key: step.value for key, step in steps["forces"].items() if key in found.columns}
    assert forces == pytest.approx({key: found.columns[key][row] for key in forces}, rel=1e-12)
    power = {key: step.value for key, step in steps["power"].items()}
    assert power == pytest.approx({key: found.summary[key] for key in power}, rel=1e-12)


def test_a_linkage_that_cannot_turn_fully_is_shown_where_it_is():
    found = crankwork.analyse(crankwork.read_machine(crankwork.template("four-bar").replace('"62.5 mm"', '"150 mm"')))
    assert [notice.code for notice in found.notices] == ["partial", "unbounded", "transmission", "transmission"]
    for wanted, shown in ((30.0, 30.0), (300.0, 100.0), (0.0, 20.0)):
        there = lines_of(found, wanted)
        assert [one.degrees for one in there if one.degrees is not None] == pytest.approx([shown] * 7)
        row = int(np.argmin(np.abs(found.grid.degrees - shown)))
        steps = {step.key: step.value for group in there for step in group.lines if step.key in found.columns}
        assert len(steps) > 10
        assert steps == pytest.approx({key: found.columns[key][row] for key in steps}, rel=1e-12, abs=1e-300)


# --- functions of the rod angle, by which the piston force gives the other forces


def test_functions_of_the_rod_angle_are_those_of_printed_tables():
    """The tables of the field at a ratio of 1/4: tan, 1/cos, and both sums at 30 degrees."""
    found = results("spark-engine")
    row = int(np.argmin(np.abs(found.grid.degrees - 30.0)))
    beta = math.asin(0.25 * 0.5)
    expected = {
        "side_factor": math.tan(beta),
        "rod_factor": 1 / math.cos(beta),
        "radial_factor": math.cos(math.radians(30) + beta) / math.cos(beta),
        "tangential_factor": math.sin(math.radians(30) + beta) / math.cos(beta),
    }
    factors = {key: values[row] for key, values in force_functions(found).items()}
    forces = {
        key.replace("factor", "force"): value * found.columns["piston_force"][row] for key, value in factors.items()
    }
    assert forces == pytest.approx({key: found.columns[key][row] for key in forces}, rel=1e-13)
    assert factors == pytest.approx(expected, rel=1e-14)
    assert {key: round(value, 3) for key, value in factors.items()} == {
        "side_factor": 0.126, "rod_factor": 1.008, "radial_factor": 0.803, "tangential_factor": 0.609,
    }  # fmt: skip


def test_a_linkage_has_no_functions_of_the_rod_angle():
    with pytest.raises(MethodError, match="engine only"):
        force_functions(results("press"))
