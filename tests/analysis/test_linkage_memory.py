"""Results of a linkage are values of their memory, and single values are exact over the crank angle."""

import math
import pickle
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from crankwork import analyse, figures, read, read_machine, template
from crankwork.analysis.mechanism import operating_state
from crankwork.dynamics.routes import TORQUE_METHODS, torque_by_groups
from crankwork.formula.calculation_lines import Snapshot
from crankwork.formula.expression import FORMULAS
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import TorqueOnLink
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.web import web

NAMES = ("four-bar", "crank-shaper", "toggle-press", "scotch-yoke", "whitworth", "press", "stephenson-six-bar")
FLYWHEEL = """[flywheel]
fluctuation = {}
[motor]
rated_power = "2.2 kW"
rated_speed = "1430 rpm"
overload = 2.2
pole_pairs = 2
ratio = 24
[table]"""


# components that the loads of bearings are made of, and what harmonics are those of
_OF_BEARINGS = ("bearing_force_x", "bearing_force_y", "total_torque")


def loaded(torque, name="four-bar"):
    """Return the results of a linkage without masses whose crank bears a torque."""
    machine = read_machine(template(name))
    crank = machine.mechanism.crank.link
    bare = replace(machine.mechanism, bodies=())
    return analyse(replace(machine, mechanism=bare, loads=(TorqueOnLink(crank, torque),)))


def test_columns_and_single_values_are_those_of_the_memory_and_checks_share_no_formula_with_forces_in_joints():
    wrong = {}
    for name in NAMES:
        results = analyse(read_machine(template(name)))
        unlisted = {key.partition(".")[0] for key in set(results.trace) ^ {*results.columns, *results.summary}}
        listed = {key.partition(".")[0] for one in results.listings.values() for key in one.columns}
        assert unlisted - listed <= {"mobility", "work_per_cycle", "energy_fluctuation", *_OF_BEARINGS}, name
        again = Program({key: results.trace[key] for key in results.columns})(results.grid)
        for key, column in results.columns.items():
            there = ~np.isnan(column) if key.startswith("instant_centre") else slice(None)
            if not np.array_equal(again[key][there], column[there]):
                wrong[name, key] = again[key], column
        assert {key: results.trace[key].value for key in results.summary} == dict(results.summary), name
        running = operating_state(results.solved, linkage_motion(results.machine.mechanism, results.grid))
        forces = called(torque_by_groups, running)
        assert len(forces) >= 3, name
        wrong |= {(name, key): one for key, route in TORQUE_METHODS.items() if (one := called(route, running) & forces)}
        assert len(called(TORQUE_METHODS["energy"], running)) >= 3, name
    assert wrong == {}


def test_results_can_be_pickled():
    results = analyse(read_machine(template("toggle-press").replace("[table]", FLYWHEEL.format(0.04))))
    again = pickle.loads(pickle.dumps(results))  # noqa: S301 - our own bytes
    grid = CrankGrid.from_degrees([12.3])
    assert again.columns_at(grid)["crank_speed"] == results.columns_at(grid)["crank_speed"]


def test_the_stroke_of_the_shaper():
    summary = analyse(read_machine(template("crank-shaper"))).summary
    assert summary["slider_stroke.ram"] == pytest.approx(0.2, rel=1e-13)
    assert summary["mean_torque"] == pytest.approx(1200 * 0.2 / math.tau, rel=1e-12)


def test_a_torque_over_a_third_of_the_turn_has_a_third_of_it_as_mean():
    torque = LoadCurve(
        tuple(map(math.radians, (0.0, 120.0, 120.0, 360.0))), (-300.0, -300.0, 0.0, 0.0), period=math.tau
    )
    assert loaded(torque).summary["mean_torque"] == pytest.approx(100.0, rel=1e-12)


def test_extremes_stand_where_calculus_puts_them():
    summary = loaded(lambda x: -(5000 + 900 * np.sin(2 * x) - 600 * np.cos(2 * x))).summary
    assert summary["static_torque_max"] == pytest.approx(5000 + math.hypot(900, 600), rel=1e-13)
    assert summary["static_torque_max_angle"] == pytest.approx((math.pi - math.atan(900 / 600)) / 2, abs=1e-7)
    assert summary["static_torque_min_angle"] == pytest.approx(math.pi - math.atan(900 / 600) / 2, abs=1e-7)


def test_the_excess_work_of_a_smooth_torque_is_exact():
    text = template("four-bar").replace("[table]", FLYWHEEL.format(0.04))
    machine = read_machine(text)
    loads = (TorqueOnLink(machine.mechanism.crank.link, lambda x: -2000 - 500 * np.sin(x)),)
    results = analyse(replace(machine, mechanism=replace(machine.mechanism, bodies=()), loads=loads))
    assert results.summary["excess_work"] == pytest.approx(1000.0, rel=1e-12)


def test_no_flywheel_is_told_of_a_machine_that_needs_none():
    """Of its own the machine runs more evenly than asked: that is what summary, table and check say."""
    text = template("whitworth").replace("[table]", FLYWHEEL.format(0.04))
    text = text.replace("[crank]", '[crank]\ninertia = "50 kg*m2"')
    results = analyse(read_machine(text))
    assert results.summary["flywheel_inertia.exact"] == 0.0
    speed = results.columns_at(CrankGrid.steps(0.1, 360.0))["crank_speed"]
    own = 2 * (speed.max() - speed.min()) / (speed.max() + speed.min())
    assert own < 0.04
    assert results.summary["speed_fluctuation"] == pytest.approx(own, rel=1e-5)
    assert results.checks["flywheel"] == 0.0


def test_a_crank_whose_mass_lies_on_its_axis_needs_no_flywheel():
    """Nothing that moves has a mass, though the crank has one."""
    text = """
fixed_points = { O = ["0 mm", "0 mm"], C = ["180 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm", mass = "3 kg" }
links.coupler = { joins = ["A", "B"], length = "200 mm" }
links.rocker = { joins = ["C", "B"], length = "120 mm" }
flywheel.fluctuation = 0.04
"""
    load = '[[loads]]\nkind = "force"\npoint = "B"\nx = "40 N"\n'
    free, driven = (analyse(read_machine(text + more)) for more in ("", load))
    for results, codes in ((free, ["no_flywheel"]), (driven, [])):
        assert [one.code for one in results.notices if one.code == "no_flywheel"] == codes
        assert "wittenbauer" not in figures(results)
        assert "(0; 0)" in web(note_of(results, NoteOptions(full=True, figures=False))).decode()
    assert driven.summary["flywheel_inertia"] > 0
    assert driven.summary["speed_fluctuation"] == pytest.approx(0.04, rel=1e-9)


def test_a_joint_force_is_followed_down_to_masses_and_lengths():
    results = analyse(read_machine(template("crank-shaper")))
    force = results.trace["joint_force.B"]
    keys = {one.key for one in in_order([force])}
    assert {"crank_radius", "body_mass.lever", "link_length.link", "speed", "link_inertia_force.lever.x"} <= keys
    moment = Snapshot(CrankGrid.from_degrees, 100.0)
    last = list(moment.steps([force]))[-1]
    assert last.value == pytest.approx(results["joint_force.B"][10], rel=1e-14)


def called(route, running):
    """Return the formulas of the dynamics that a route calls."""
    formulas = {
        id(one.function.__code__): name for name, one in FORMULAS.items() if "dynamics" in one.function.__module__
    }
    found = set()

    def note(frame, event, _):
        if event == "call" and id(frame.f_code) in formulas:
            found.add(formulas[id(frame.f_code)])

    sys.setprofile(note)
    try:
        route(running)
    finally:
        sys.setprofile(None)
    return found


def test_a_machine_that_is_driven_by_gas_has_a_positive_share_of_its_work_in_motion():
    trace = analyse(read(Path(__file__).parents[2] / "examples" / "atkinson.toml")).trace
    assert trace["work_per_cycle"].value == pytest.approx(trace["indicated_work.cylinder"].value, rel=1e-9)
    assert trace["energy_fluctuation"].value == pytest.approx(
        trace["excess_work"].value / trace["work_per_cycle"].value
    )


DWELLS = """format = 2
loads = [{ kind = "process", slider = "B", stroke = "growing", force = ["100 N"], acts = "forward" }]
[guides]
g1 = { angle = "0 deg" }
g2 = { angle = "90 deg" }
[links]
rod = { joins = ["A", "B"], length = "200 mm" }
[sliders]
A = { guide = "g1", pin = "A", mass = "1 kg" }
B = { guide = "g2", pin = "B", mass = "20 kg" }
[driver]
slider = "A"
start = "50 mm"
law = [{ kind = "parabolic", to = "100 mm", over = 0.5 }, { kind = "dwell", over = 0.5 }]
period = "2 s"
"""


def test_force_and_acceleration_break_together_where_the_driver_comes_to_rest():
    results = analyse(read_machine(DWELLS))
    before, at, after = (float(results.value("joint_force.B", time)) for time in (1 - 1e-9, 1.0, 1 + 1e-9))
    assert after == pytest.approx(100 / math.cos(math.pi / 6), rel=1e-12)  # at rest the rod alone bears the force
    assert at == pytest.approx(before, rel=1e-6)
    assert results.summary["joint_force_max.B"] == pytest.approx(after, rel=1e-12)
