"""Loads on a linkage: tables, process forces, springs, weights."""

from dataclasses import replace

import numpy as np
import pytest

from crankwork.dynamics.reduction import reduced_torque
from crankwork.errors import GeometryError, InputError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import body_motions, linkage_motion
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import (
    Damper,
    ForceOnPoint,
    ProcessForce,
    SliderDamper,
    SliderSpring,
    Spring,
    TorqueOnLink,
    Weight,
    applied_loads,
)
from crankwork.mechanism.catalog import crank_shaper, four_bar
from crankwork.mechanism.mechanism import Crank, Mechanism, body_at
from each import for_each
from linkages import slotted_press
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(0.0, 360, 5))
BAR = four_bar(0.05, 0.2, 0.12, 0.18)
CRANK = Mechanism(Crank(0.1), (), ground={"Q": (0.5, 0.0)})
TURNING = linkage_motion(CRANK, GRID)


@pytest.fixture(scope="module")
def shaper():
    mechanism = crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14)
    return mechanism, linkage_motion(mechanism, GRID)


def derivative(values):
    order = np.fft.rfftfreq(len(GRID), 1 / len(GRID))
    return np.fft.irfft(1j * order * np.fft.rfft(values), len(GRID))


class TestTable:
    def test_passes_its_points_and_is_zero_outside(self):
        at, values = (0.0, 0.1, 0.4), (0.0, 5.0, 3.0)
        for interpolation in ("linear", "monotone"):
            table = LoadCurve(at, values, interpolation)
            assert table(np.array(at)) == pytest.approx(values)
            assert table(np.array([-0.01, 0.41])).tolist() == [0, 0]

    def test_straight_between_points(self):
        assert LoadCurve((0.0, 2.0), (1.0, 5.0))(np.array([0.5])) == pytest.approx([2.0])

    def test_smooth_without_overshoot(self):
        values = LoadCurve((0.0, 1.0, 2.0, 3.0), (0.0, 0.0, 1.0, 1.0), "monotone")(np.linspace(0, 3, 301))
        assert values.min() == 0
        assert values.max() == 1
        assert np.all(np.diff(values) >= -1e-15)

    @for_each("interpolation", ["linear", "monotone"])
    def test_a_period_closes_the_curve(self, interpolation):
        open_end = LoadCurve((0.0, 1.0, 2.0), (1.0, 4.0, 2.0), interpolation, period=3.0)
        closed = LoadCurve((0.0, 1.0, 2.0, 3.0), (1.0, 4.0, 2.0, 1.0), interpolation, period=3.0)
        at = np.linspace(-3, 6, 50)
        assert open_end(at) == pytest.approx(closed(at))
        assert open_end(at) == pytest.approx(open_end(at + 3))

    @for_each(
        ("at", "values", "period", "message"),
        [
            ((0.0,), (1.0,), 0.0, "two points"),
            ((0.0, 1.0), (1.0,), 0.0, "two points"),
            ((0.0, float("nan")), (1.0, 2.0), 0.0, "finite"),
            ((0.0, 0.0), (1.0, 2.0), 0.0, "ascend"),
            ((0.0, 7.0), (1.0, 2.0), 6.0, "longer than its period"),
        ],
    )
    def test_refuses_what_is_no_table(self, at, values, period, message):
        with pytest.raises(ValueError, match=message):
            LoadCurve(at, values, period=period)


class TestProcess:
    def test_a_force_resists_the_forward_stroke_only(self, shaper):
        mechanism, moved = shaper
        loads = applied_loads(mechanism, moved, [ProcessForce("ram", lambda way: np.full_like(way, 500.0))])
        (force,) = loads.forces
        forward = moved.sliders["ram"].position_1 > 0
        assert force.link == "ram"
        assert force.x[forward] == pytest.approx(-500)
        assert force.x[~forward] == pytest.approx(0)
        assert force.y == pytest.approx(0)

    def test_on_both_strokes_and_the_other_way(self, shaper):
        mechanism, moved = shaper
        load = ProcessForce("ram", lambda way: np.full_like(way, 500.0), forward=-1, acts="both")
        (force,) = applied_loads(mechanism, moved, [load]).forces
        assert force.x == pytest.approx(500)

    def test_counts_the_stroke_from_its_start(self, shaper):
        mechanism, moved = shaper
        position = moved.sliders["ram"].position
        table = LoadCurve((0.0, 1.0), (0.0, 1000.0))
        load = ProcessForce("ram", table, forward=-1, start=float(position.max()), acts="both")
        (force,) = applied_loads(mechanism, moved, [load]).forces
        assert force.x == pytest.approx(1000 * (position.max() - position), abs=1e-9)

    def test_against_the_crank_angle(self, shaper):
        mechanism, moved = shaper
        load = ProcessForce("ram", lambda angle: 100 * np.sin(angle), against="angle", acts="both")
        (force,) = applied_loads(mechanism, moved, [load]).forces
        assert force.x == pytest.approx(-100 * GRID.sin)

    def test_the_work_of_a_stroke_is_the_area_of_its_table(self, shaper):
        mechanism, _ = shaper
        fine = CrankGrid.from_degrees(np.arange(0.0, 360, 0.05))
        moved = linkage_motion(mechanism, fine)
        ram = moved.sliders["ram"].position
        load = ProcessForce("ram", LoadCurve((0.02, 0.05), (800.0, 200.0)), start=float(ram.min()))
        torque = reduced_torque(moved, applied_loads(mechanism, moved, [load]))
        assert np.mean(torque) * 2 * np.pi == pytest.approx(-500 * 0.03, rel=2e-3)

    def test_torque_by_the_crank_angle(self):
        (torque,) = applied_loads(CRANK, TURNING, [TorqueOnLink("crank", np.cos)]).torques
        assert torque.torque == pytest.approx(GRID.cos)

    def test_a_force_on_a_fixed_point_does_nothing(self):
        assert applied_loads(CRANK, TURNING, [ForceOnPoint("Q", 1.0, 2.0)]).forces == ()

    def test_a_force_names_its_link_where_several_meet(self):
        bar, moved = BAR, linkage_motion(BAR, GRID)
        loads = [ForceOnPoint("coupler_pin", 1.0, 0.0), ForceOnPoint("coupler_pin", 1.0, 0.0, "rocker")]
        assert [one.link for one in applied_loads(bar, moved, loads).forces] == ["coupler", "rocker"]


class TestSpring:
    def test_between_points_does_the_work_of_its_energy(self):
        bar, moved = BAR, linkage_motion(BAR, GRID)
        x, y = (
            a.position - b.position for a, b in zip(moved.points["crank_pin"], moved.points["coupler_pin"], strict=True)
        )
        assert np.hypot(x, y) == pytest.approx(0.2)
        spring = Spring("rocker_pivot", "crank_pin", 3000.0, 0.1, 20.0)
        x, y = (one.position for one in moved.points["crank_pin"])
        length = np.hypot(x - 0.18, y)
        energy = 1500 * (length - 0.1) ** 2 + 20 * length
        found = reduced_torque(moved, applied_loads(bar, moved, [spring]))
        assert found == pytest.approx(-derivative(energy), abs=1e-9)

    def test_ends_that_meet_have_no_direction(self):
        with pytest.raises(GeometryError, match="ends of the spring"):
            applied_loads(CRANK, TURNING, [Spring("crank_pin", "crank_pin", 1.0, 0.0)])

    def test_on_a_fixed_guide(self, shaper):
        mechanism, moved = shaper
        loads = applied_loads(mechanism, moved, [SliderSpring("ram", 100.0, 0.05, 7.0)])
        (force,) = loads.forces
        assert force.x == pytest.approx(-100 * (moved.sliders["ram"].position - 0.05) - 7)

    def test_on_a_moving_guide_pulls_piece_and_carrier(self, shaper):
        mechanism, moved = shaper
        loads = applied_loads(mechanism, moved, [SliderSpring("block", 100.0, 0.15, 7.0)])
        piece, carrier = loads.forces
        assert (piece.link, carrier.link) == ("block", "lever")
        assert carrier.x == pytest.approx(-piece.x)
        way = moved.sliders["block"].position - 0.15
        assert reduced_torque(moved, loads) == pytest.approx(-derivative(50 * way**2 + 7 * way), abs=1e-9)


class TestDamper:
    """What a damper takes is its coefficient times the square of the rate of its length."""

    def test_between_points_takes_the_square_of_the_rate_of_its_length(self):
        bar, moved = BAR, linkage_motion(BAR, GRID)
        x, y = (one.position for one in moved.points["crank_pin"])
        rate = derivative(np.hypot(x - 0.18, y))
        found = reduced_torque(moved, applied_loads(bar, moved, [Damper("rocker_pivot", "crank_pin", 40.0)], -3.0))
        assert found == pytest.approx(3.0 * 40.0 * rate**2, abs=1e-9)

    def test_ends_that_meet_have_no_direction(self):
        with pytest.raises(GeometryError, match="ends of the damper"):
            applied_loads(CRANK, TURNING, [Damper("crank_pin", "crank_pin", 1.0)])

    @for_each("name", ["ram", "block"])
    def test_on_a_guide(self, shaper, name):
        mechanism, moved = shaper
        rate = derivative(moved.sliders[name].position)
        found = reduced_torque(moved, applied_loads(mechanism, moved, [SliderDamper(name, 40.0)], 3.0))
        assert found == pytest.approx(-3.0 * 40.0 * rate**2, abs=1e-9)


class TestWeight:
    def test_pulls_each_body_at_its_centre(self):
        press = slotted_press()
        moved = linkage_motion(press, GRID)
        loads = applied_loads(press, moved, [Weight(10.0, 0.0)])
        assert [one.link for one in loads.forces] == ["rod", "block", "punch", "rocker"]
        assert loads.forces[0].x == pytest.approx(2551)
        assert loads.forces[0].y == pytest.approx(0)

    def test_centre_between_two_points(self):
        body = replace(body_at("coupler", 2.0, 0.1, "crank_pin"), end="coupler_pin", share=0.25)
        bar = replace(BAR, bodies=(body,))
        moved = linkage_motion(bar, GRID)
        (found,) = body_motions(bar, moved)
        start, end = (np.array(moved.points[name].x) for name in ("crank_pin", "coupler_pin"))
        assert np.array(found.centre.x) == pytest.approx(0.75 * start + 0.25 * end, abs=1e-15)


def test_a_body_whose_turning_is_unknown_is_refused_if_it_has_inertia():
    moved = replace(TURNING, frames={}, links={})
    with pytest.raises(GeometryError, match="does not say how it turns"):
        body_motions(replace(CRANK, bodies=(body_at("crank", 1.0, 0.5, "crank_pin"),)), moved)
    (found,) = body_motions(replace(CRANK, bodies=(body_at("crank", 1.0, 0.0, "crank_pin"),)), moved)
    assert not found.angle_1.any()


def test_rates_of_a_table_are_read_where_there_are_no_frames():
    moved = replace(TURNING, frames={})
    (found,) = body_motions(replace(CRANK, bodies=(body_at("crank", 1.0, 0.5, "crank_pin"),)), moved)
    assert found.angle_1 == pytest.approx(1)


@for_each(
    "load",
    [
        ForceOnPoint("nowhere", 1.0, 0.0),
        TorqueOnLink("nowhere", 1.0),
        ProcessForce("nowhere", np.cos),
        Damper("nowhere", "tip", 1.0),
        SliderDamper("nowhere", 1.0),
        Spring("nowhere", "tip", 1.0, 1.0),
        Spring("tip", "nowhere", 1.0, 1.0),
        SliderSpring("nowhere", 1.0),
    ],
)
def test_a_load_on_nothing_names_what_there_is(shaper, load):
    with pytest.raises(GeometryError, match=r"no [a-z ]+ nowhere to load; choose from .*(tip|ram|lever)"):
        applied_loads(shaper[0], shaper[1], [load])


def test_no_loads():
    assert applied_loads(CRANK, TURNING, []).forces == ()


_JUMPING = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
links.rod = { joins = ["A", "B"], length = "200 mm" }
sliders.ram = { pin = "B", guide = "bed" }
guides.bed = { through = ["0 mm", "0 mm"], angle = "0 deg" }
positions.B = ["200 mm", "0 mm"]
loads = [{ kind = "process", slider = "ram", start = "150 mm", at = AT, force = ["10 kN", "10 kN", "25 kN", "25 kN"] }]
"""


def test_a_stroke_given_twice_is_a_jump_of_the_force() -> None:
    """By the area under the force, 10 kN over 20 mm and 25 kN over 20 mm: 700 J in each turn."""
    results = analysed(_JUMPING.replace("AT", '["40 mm", "60 mm", "60 mm", "80 mm"]'))
    assert results["mean_torque"] * 2 * np.pi == pytest.approx(700.0, rel=1e-9)
    # on the way out the ram is 210 mm from the pivot, 60 mm of its stroke, where r^2 + x^2 - 2 r x cos = l^2
    jump = 360.0 - np.degrees(np.arccos((0.05**2 + 0.21**2 - 0.2**2) / (2 * 0.05 * 0.21)))
    before, after = np.abs(results.columns_at([jump - 1e-6, jump + 1e-6])["static_torque"])
    assert after / before == pytest.approx(2.5, rel=1e-5)


@for_each(
    "at",
    [
        '["40 mm", "60 mm", "50 mm", "80 mm"]',
        '["40 mm", "40 mm", "60 mm", "80 mm"]',
        '["40 mm", "60 mm", "60 mm", "60 mm"]',
        '["40 mm", "60 mm", "60 mm", "80 mm"], curve = "smooth"',
        '["40 deg", "60 deg", "60 deg", "80 deg"], against = "angle"',
    ],
)
def test_a_jump_stands_between_straight_parts_over_the_stroke(at: str) -> None:
    with pytest.raises(InputError, match="must rise"):
        analysed(_JUMPING.replace("AT", at))
