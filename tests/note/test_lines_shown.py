"""Every worked step: its formula gives its value, and its value is that of the results."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork import analyse, read_machine, template, template_names, with_method
from crankwork.analysis.forces import columns, force_functions
from crankwork.dynamics.efficiency import Parallel, Series, efficiency, remembered_efficiency
from crankwork.errors import MethodError
from crankwork.formula.expression import evaluate
from crankwork.formula.known import Given
from crankwork.formula.lines import FormulaLine, Moment, SumLine, ValueLine
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.quantities import QUANTITIES, base_key

EXAMPLES = Path(__file__).parents[2] / "examples"
MOTOR = '[motor]\nrated_power = "2.2 kW"\nrated_speed = "1430 rpm"\noverload = 2.2\npole_pairs = 2\nratio = 24\n'
LOADS = """
[[loads]]
kind = "force"
point = "P"
x = "-100 N"
[[loads]]
kind = "torque"
link = "rocker"
at = ["0 deg", "360 deg"]
torque = ["3 N*m", "3 N*m"]
[table]
"""
FLYWHEEL = "[flywheel]\nfluctuation = 0.04\n"


def _changed(name, *changes):
    text = template(name)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


RIGID = ('# inertia = "0.0042 kg*m2"', 'inertia = "0.0042 kg*m2"')
OFFSET = ('# offset = "0 mm"', 'offset = "7 mm"')
OTHER_OFFSET = ('# offset = "0 mm"', 'offset = "-7 mm"')
LEANING = ('# inclination = "0 deg"', 'inclination = "35 deg"')
WEIGHTS = ("# weights = true", "weights = true")
UNSTEADY = ('# angular_acceleration = "0 rad/s2"', 'angular_acceleration = "900 rad/s2"')
VARIANTS = {
    "rigid rod": _changed("engine", RIGID),
    "offset, rigid": _changed("engine", RIGID, OFFSET),
    "negative offset": _changed("engine", OTHER_OFFSET),
    "weight": _changed("engine", WEIGHTS),
    "everything": _changed("engine", RIGID, OFFSET, LEANING, WEIGHTS, UNSTEADY),
    "two rod ratios": _changed("engine", ("# inertia_rod_ratio", "inertia_rod_ratio"), UNSTEADY),
    "long crank": _changed("engine", ('length = "160 mm"', 'length = "120 mm"')),
    "double acting": _changed(
        "compressor", ('# piston_rod_diameter = "25 mm"', 'piston_rod_diameter = "25 mm"'),
        ("[gas]", '[gas]\nback_pressure = "0.4 bar"'),
    ),
    "gas alone": "\n".join(
        line for line in template("engine").splitlines() if "mass" not in line and "small_end_share" not in line
    ),
    "flywheel and motor": _changed("toggle-press", ("[table]", FLYWHEEL + MOTOR + '[table]')),
    "heavy rotor": _changed("crank-shaper", ("[table]", FLYWHEEL + MOTOR + 'inertia = "0.01 kg*m2"\n[table]')),
    "unsteady linkage": _changed(
        "four-bar",
        ('speed = "100 rpm"', 'speed = "100 rpm"\nangular_acceleration = "40 rad/s2"\ninertia = "0.1 kg*m2"'),
        ("[table]", LOADS),
    ),
}  # fmt: skip


GIVEN_DERIVATIVE = re.compile(r"reduced_inertia_1 = .*\n")


def _differences(scheme):
    """Return the press of the examples with its derivative from the positions of its table."""
    text = (EXAMPLES / "press.toml").read_text("utf-8")
    assert GIVEN_DERIVATIVE.search(text)
    return GIVEN_DERIVATIVE.sub(f'differences = "{scheme}"\n', text)


VARIANTS |= {f"press, {scheme}": _differences(scheme) for scheme in ("forward", "central", "spectral")}


def _machines():
    found = {path.name: crankwork.read(path) for path in sorted(EXAMPLES.glob("*.toml"))}
    found |= {name: read_machine(template(name)) for name in template_names()}
    return found | {name: read_machine(text) for name, text in VARIANTS.items()}


def _cases():
    for name, machine in _machines().items():
        methods = ("exact", "textbook", "series:6") if machine.lengths else ("",)
        for method in methods:
            yield pytest.param(machine, method, id=f"{name} {method}".strip())


every_machine = pytest.mark.parametrize(("machine", "method"), list(_cases()))


def _results(machine, method):
    return analyse(with_method(machine, method) if method else machine)


def _expected(results, group, key):
    """Return the value that the results have of a key at the crank angle of a group, or None."""
    if key in results.summary:
        return results.summary[key]
    if group.degrees is None or key not in results.columns:
        return None
    row = int(np.argmin(np.abs(results.grid.degrees - group.degrees)))
    if "piston_displacement" in results.columns and results.grid.degrees[row] != group.degrees:
        return None
    return float(results.columns[key][row])


def _assert_is_its_formula(step):
    """Assert that a step is its formula as printed: to the bit, unless books print another form than is computed."""
    found = evaluate(step.expression, step.values)
    if step.formula.printed is None:
        # the C library may round the square of one number otherwise than NumPy that of a column
        of_column = evaluate(step.expression, {name: np.array([one]) for name, one in step.values.items()})
        assert step.value in (found, float(np.squeeze(of_column))), step.key
    else:
        assert found == pytest.approx(step.value, rel=1e-13, abs=1e-14 * max(map(abs, step.values.values()))), step.key


@every_machine
def test_a_step_is_its_formula_at_its_values_and_the_value_of_the_results(machine, method, groups_of):
    results = _results(machine, method)
    compared = 0
    for group in groups_of(results):
        for step in group.lines:
            if isinstance(step, FormulaLine):
                _assert_is_its_formula(step)
            elif isinstance(step, SumLine):
                assert sum(one.value for one in step.terms) == step.value, step.key
            expected = _expected(results, group, step.key)
            if expected is not None:
                assert step.value == pytest.approx(expected, rel=1e-12, abs=0), step.key
                compared += 1
    assert compared > 5


@every_machine
def test_a_step_belongs_to_a_quantity_and_is_told_once(machine, method, groups_of):
    for group in groups_of(_results(machine, method)):
        assert {step.key for step in group.lines if base_key(step.key) not in QUANTITIES} == set()
        told = [step.key for step in group.lines]
        if group.name != "force_extremes":
            # each at its own crank angle, with terms that are called the same
            told = [step.key for step in group.lines if not isinstance(step, ValueLine)]
        assert sorted(told) == sorted(set(told)), group.name


# What a solver, an integral or an extreme over the revolution gives.
NO_FORMULA = {
    "crank_angle", "efficiency", "speed_fluctuation", "final_turn", "final_speed", "steady_speed",
    "steady_fluctuation", "mean_torque", "mean_friction_power", "kinetic_energy_change", "crank_speed",
    # a sum of what is shown
    "engine_indicated_power",
}  # fmt: skip
SOLVED_KINDS = (
    "joint_force", "normal_force", "normal_moment", "link_angle", "link_swing", "slider_stroke", "slider_displacement",
    "point_x", "point_y", "transmission_angle", "time_ratio", "shaking_force_max", "free_force", "free_moment",
    "torque_with_friction", "static_torque_with_friction",
)  # fmt: skip


@every_machine
def test_what_has_no_step_is_given_or_solved_for(machine, method, groups_of):
    results = _results(machine, method)
    shown = {step.key for group in groups_of(results) for step in group.lines}
    left = {key for key in {*results.summary, *results.columns} - shown - NO_FORMULA if base_key(key) in QUANTITIES}
    left = {key for key in left if not key.partition(".")[0].startswith(SOLVED_KINDS)}
    left -= {key for key, known in results.memory.items() if isinstance(known.node, Given)}
    # extremes over the revolution, where they stand, and the error of a method
    left = {key for key in left if not key.partition(".")[0].endswith(("_angle", "_time", "_error", "_max", "_min"))}
    left -= {"time"}
    left = {key for key in left if not isinstance(results.memory[key].node, Given)}
    if not getattr(machine, "loads", True):
        left -= {"static_torque"}
    if (space := getattr(results.solved, "space", None)) is not None and space.calculated is not None:
        # what a calculated cycle begins with stands among the givens
        left -= {"compression_ratio"}
    if "rod_length" not in results.summary:
        # worked by courses only that have a pi of their own
        left -= {"speed"}
    assert {key for key in left if not key.startswith("flywheel_inertia.") or results.summary[key]} == set()


@pytest.mark.parametrize("name", ["press", "press-geometry"])
def test_a_given_speed_is_not_worked_out_of_the_revolutions_that_follow_from_it(name, groups_of):
    machine = crankwork.read(EXAMPLES / f"{name}.toml")
    assert "speed" not in {group.name for group in groups_of(analyse(machine))}
    results = analyse(replace(machine, method=replace(machine.method, pi=3.14)))
    (step,) = next(group.lines for group in groups_of(results) if group.name == "speed")
    assert step.value == pytest.approx(14.65 * 3.14 / math.pi, rel=1e-15)
    assert results.summary["speed"] == pytest.approx(step.value, rel=1e-15)


@pytest.mark.parametrize("angle", [0.0, 37.3, 90.0, 181.0, 360.0])
@pytest.mark.parametrize("method", ["exact", "textbook", "series:9"])
def test_forces_are_those_of_the_columns_at_any_angle(angle, method, groups_of):
    results = _results(read_machine(VARIANTS["everything"]), method)
    force_angle = 720.0 - angle
    groups = {group.name: group for group in groups_of(results, angle, force_angle)}
    for name, degrees in (("motion", angle), ("forces", force_angle)):
        known = columns(results.solved, CrankGrid.from_degrees([degrees]))
        assert groups[name].degrees == degrees
        found = {step.key: step.value for step in groups[name].lines}
        assert len(found.keys() & known.keys()) >= (6 if name == "motion" else 12)
        for key in found.keys() & known.keys():
            # a force that passes zero keeps the rounding of its parts
            scale = max(np.max(np.abs(results.columns[key])), abs(known[key][0]))
            assert found[key] == pytest.approx(known[key][0], rel=1e-12, abs=1e-14 * scale), key


def test_ends_of_polytropes_are_those_of_the_diagram(groups_of):
    results = _results(read_machine(template("engine")), "exact")
    gas = {step.key: step.value for group in groups_of(results) if group.name == "gas" for step in group.lines}
    diagram = results.solved.space.diagram
    ends = [segment for segment in diagram.segments if segment.law == "polytropic"]
    assert [gas["diagram_pressure.c1"], gas["diagram_pressure.b1"]] == [
        pytest.approx(segment.pressures[-1], rel=1e-13) for segment in ends
    ]
    assert gas["diagram_pressure.c1"] == pytest.approx(diagram.named["c1"][1], rel=1e-13)


def test_flywheels_are_shown_in_all_four_ways(groups_of):
    results = _results(read_machine(VARIANTS["heavy rotor"]), "")
    wheel = next(group for group in groups_of(results) if group.name == "flywheel")
    shown = {step.key for step in wheel.lines}
    assert {key for key in results.summary if key.startswith("flywheel_inertia.") and results.summary[key]} <= shown
    assert {"excess_work", "whole_inertia.energy", "wittenbauer_slope.exact.largest", "energy_fluctuation"} <= shown


def test_forces_are_shown_in_the_working_stroke(groups_of):
    engine = {one.name: one.degrees for one in groups_of(analyse(read_machine(template("engine"))))}
    assert engine["motion"] == pytest.approx(30.0)
    assert engine["forces"] == pytest.approx(390.0)
    compressor = {one.name: one.degrees for one in groups_of(analyse(read_machine(template("compressor"))))}
    assert compressor["forces"] == pytest.approx(30.0)


def test_a_linkage_is_shown_at_the_nearest_angle_that_it_reaches(groups_of):
    results = analyse(crankwork.read(EXAMPLES / "press.toml"))
    groups = {group.name: group for group in groups_of(results, 100.0)}
    assert groups["torques"].degrees == pytest.approx(90.0)


def test_torques_of_a_linkage_are_shown_where_asked(groups_of):
    results = _results(read_machine(template("toggle-press")), "")
    row = int(np.argmax(np.abs(results.columns["static_torque"])))
    groups = {one.name: one for one in groups_of(results, float(results.grid.degrees[row]))}
    torques = {step.key: step.value for step in groups["torques"].lines}
    assert torques["static_torque"] == results.columns["static_torque"][row]
    reduced = next(step for step in groups["reduction"].lines if step.key == "reduced_torque")
    assert reduced.value == pytest.approx(-torques["static_torque"], rel=1e-13)
    assert torques["static_torque"]


def test_a_chain_of_efficiencies_multiplies_to_that_of_the_chain():
    chain = Series((Parallel((0.98, 0.98)), 0.98, 0.99, Parallel((0.9, Series((0.95, 0.8)), 0.7), (0.5, 0.3, 0.2))))
    found = remembered_efficiency(chain)
    assert found.value == 0.98 * 0.98 * 0.99 * (0.5 * 0.9 + 0.3 * (0.95 * 0.8) + 0.2 * 0.7)
    line = Moment(CrankGrid.from_degrees, 0.0).step(found)
    assert [key for _, key in line.named] == [f"efficiency.{i}" for i in range(1, 5)]
    assert efficiency(0.9) == 0.9


# --- helper functions of notes


def test_functions_of_the_rod_angle_turn_the_piston_force_into_the_others():
    results = analyse(
        read_machine(template("engine")), method=read_machine(template("engine")).method.named("textbook")
    )
    found = force_functions(results)
    force = results.columns["piston_force"]
    for key, other in (
        ("side_factor", "side_force"),
        ("rod_factor", "rod_force"),
        ("radial_factor", "radial_force"),
        ("tangential_factor", "tangential_force"),
    ):
        assert found[key].shape == force.shape
        assert found[key] * force == pytest.approx(results.columns[other], rel=1e-13, abs=1e-9)


def test_functions_of_the_rod_angle_are_those_of_printed_tables():
    """The tables of the field at a ratio of 1/4: tan, 1/cos, and both sums at 30 degrees."""
    results = analyse(crankwork.read(EXAMPLES / "spark-engine.toml"))
    row = int(np.argmin(np.abs(results.grid.degrees - 30.0)))
    beta = math.asin(0.25 * 0.5)
    expected = {
        "side_factor": math.tan(beta),
        "rod_factor": 1 / math.cos(beta),
        "radial_factor": math.cos(math.radians(30) + beta) / math.cos(beta),
        "tangential_factor": math.sin(math.radians(30) + beta) / math.cos(beta),
    }
    found = {key: values[row] for key, values in force_functions(results).items()}
    assert found == pytest.approx(expected, rel=1e-14)
    assert {key: round(value, 3) for key, value in found.items()} == {
        "side_factor": 0.126, "rod_factor": 1.008, "radial_factor": 0.803, "tangential_factor": 0.609,
    }  # fmt: skip


def test_a_linkage_has_no_functions_of_the_rod_angle():
    with pytest.raises(MethodError, match="engine only"):
        force_functions(analyse(read_machine(template("four-bar"))))
