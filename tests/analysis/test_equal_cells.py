"""Equal cells of a linkage are traced once, and have the results of each traced for itself and of one linear system."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork as cw
from crankwork import CrankGrid, analyse, read_machine
from crankwork.analysis.operating_state import operating_state
from crankwork.description.shorthand import expanded
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.formula.traced_value import Delayed
from crankwork.kinematics.motion import linkage_motion
from crankwork.preparation import linkage as linkage_preparation
from crankwork.preparation.equal_cells import equal_cells
from each import for_each
from expansions import differences

ROOT = Path(__file__).parents[2]
TWIN = """
format = 2
[fixed_points]
O = ["10 mm", "-5 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "50 mm"
speed = "900 rpm"
start = "20 deg"
points = { C = ["0 mm", "50 mm"] }
mass = "2 kg"
centre = ["0 mm", "0 mm"]
[links.rod]
joins = ["A", "B"]
length = "180 mm"
mass = "1.2 kg"
centre = ["60 mm", "4 mm"]
inertia = "0.004 kg*m2"
[links.other_rod]
joins = ["C", "D"]
length = "180 mm"
mass = "1.2 kg"
centre = ["60 mm", "4 mm"]
inertia = "0.004 kg*m2"
[guides.bore]
through = ["10 mm", "-5 mm"]
angle = "0 deg"
[guides.other_bore]
through = ["10 mm", "-5 mm"]
angle = "60 deg"
[sliders.piston]
guide = "bore"
pin = "B"
mass = "0.8 kg"
[sliders.other_piston]
guide = "other_bore"
pin = "D"
mass = "0.8 kg"
[chambers.head]
clearance_volume = "60 cm3"
ambient = "0.1 MPa"
faces = [{ slider = "piston", bore = "80 mm", sense = -1 }]
pressures = "absolute"
valves = { suction = "0.1 MPa", discharge = "0.4 MPa" }
[chambers.other_head]
clearance_volume = "60 cm3"
ambient = "0.1 MPa"
faces = [{ slider = "other_piston", bore = "80 mm", sense = -1 }]
pressures = "absolute"
valves = { suction = "0.1 MPa", discharge = "0.4 MPa" }
"""
# where a column has its largest value anywhere, or rounding alone
_WITHOUT_PLACE = ("shaking_force_max_angle", "counterweight_")


def each_for_itself(monkeypatch, machine):
    with monkeypatch.context() as patch:
        patch.setattr(linkage_preparation, "equal_cells", lambda _: ())
        return analyse(machine)


def differing(results, others):
    found = differences(results, others)
    return [line for line in found if not line.partition(" ")[2].startswith(_WITHOUT_PLACE)]


@for_each("name", ["petrol-four", "two-stroke", "narrow-v6", "v8-diesel"])
def test_an_expanded_engine_has_the_results_of_each_cylinder_traced_for_itself(name, monkeypatch):
    text = expanded(ROOT / "examples" / f"{name}.toml", ["method.kinematics=exact"])
    machine = read_machine(text, folder=ROOT / "examples")
    assert len(equal_cells(machine)) >= {"narrow-v6": 4, "v8-diesel": 7}.get(name, 2)
    assert differing(each_for_itself(monkeypatch, machine), analyse(machine)) == []


def test_a_twin_cylinder_has_the_results_of_each_cylinder_traced_for_itself(monkeypatch):
    machine = read_machine(TWIN)
    (part,) = equal_cells(machine)
    # the guide is 60 degrees ahead, the pin 90
    assert (part.delay, part.turn) == (330.0, 60.0)
    expected = each_for_itself(monkeypatch, machine)
    assert differing(expected, analyse(machine)) == []
    late = replace(part, delay=part.delay + 0.001)
    monkeypatch.setattr(linkage_preparation, "equal_cells", lambda _: (late,))
    assert len(differing(expected, analyse(machine))) > 20


@pytest.mark.elsewhere
def test_the_forces_of_an_equal_cell_are_those_of_one_linear_system_of_all_links():
    results = analyse(read_machine(TWIN))
    solved, grid = results.solved, CrankGrid.from_degrees(np.arange(1.5, 360.0, 7.0))
    running = operating_state(solved, linkage_motion(solved.machine.mechanism, grid))
    pins = system_joint_forces(running).pins
    columns = results.columns_at(grid.degrees, [key for key in results.columns if key.startswith("joint_force")])
    for own, name in {"A": "A", "B": "B", "C": "C", "D": "D", "crank_pivot": "O"}.items():
        for axis in "xy":
            force = getattr(pins[own], axis)
            assert columns[f"joint_force_{axis}.{name}"] == pytest.approx(force, abs=1e-9 * np.abs(force).max()), name


@for_each(
    "change",
    [
        {'length = "180 mm"\nmass = "1.2 kg"\ncentre = ["60 mm", "4 mm"]\ninertia = "0.004 kg*m2"\n[guides':
         'length = "180.0001 mm"\nmass = "1.2 kg"\ncentre = ["60 mm", "4 mm"]\ninertia = "0.004 kg*m2"\n[guides'},
        {'pin = "D"\nmass = "0.8 kg"': 'pin = "D"\nmass = "0.80001 kg"'},
        {'points = { C = ["0 mm", "50 mm"] }': 'points = { C = ["0 mm", "50.0001 mm"] }'},
        {'through = ["10 mm", "-5 mm"]\nangle = "60 deg"': 'through = ["10 mm", "-5.001 mm"]\nangle = "60 deg"'},
        {'slider = "other_piston", bore = "80 mm"': 'slider = "other_piston", bore = "80.0001 mm"'},
        {'[links.rod]': '[method]\nweights = true\n[links.rod]'},
        {'[links.rod]': '[[loads]]\nkind = "spring"\nslider = "piston"\nstiffness = "1 N/mm"\n'
         'free_length = "0 mm"\n[links.rod]'},
        {'[links.rod]': '[friction.pins.B]\nradius = "10 mm"\ncoefficient = 0.1\n[links.rod]'},
    ],
)  # fmt: skip
def test_cells_that_differ_are_traced_each(change):
    text = TWIN
    for old, new in change.items():
        assert old in text
        text = text.replace(old, new, 1)
    assert equal_cells(read_machine(text)) == ()


def test_gas_at_another_part_of_the_cycle_makes_another_cell():
    text = expanded(ROOT / "examples" / "petrol-four.toml", ["method.kinematics=exact"])
    assert 'delay = "540 deg"' in text
    machine = read_machine(text, folder=ROOT / "examples")
    later = read_machine(text.replace('delay = "540 deg"', 'delay = "530 deg"'), folder=ROOT / "examples")
    assert (len(equal_cells(machine)), len(equal_cells(later))) == (3, 2)


@for_each(
    "field", ["links.other_rod.length", "links.rod.length", "sliders.other_piston.mass", "crank.radius", "crank.speed"]
)
def test_a_sweep_of_one_of_several_equal_cells_is_that_of_single_analyses(field):
    description = cw.Description(TWIN)
    keys = ["joint_force_max.D", "joint_force_max.B", "slider_stroke.other_piston", "joint_force_max.O"]
    start = {"sliders.other_piston.mass": 0.8, "crank.radius": 50.0, "crank.speed": 900.0}.get(field, 180.0)
    unit = {"mass": "kg", "speed": "rpm"}.get(field.rpartition(".")[2], "mm")
    values = [f"{factor * start:.12g} {unit}" for factor in (1.0, 1.05, 1.1)]
    swept = cw.sweep(description, {field: values}, keys)
    for row, value in enumerate(values):
        single = analyse(read_machine(TWIN, overrides=[f"{field}={value}"]))
        for key in keys:
            assert swept.values[key][row] == pytest.approx(single.summary[key], rel=1e-9), (key, value)


def test_columns_of_an_equal_cell_follow_from_the_first():
    trace = analyse(read_machine(TWIN)).trace
    for key in ("slider_velocity.other_piston", "joint_force.D", "gas_pressure.other_head", "pressure_angle.D"):
        assert isinstance(trace[key].node, Delayed), key
