"""Numbers of machine files that are sought, against closed forms."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import crankwork
from crankwork import CrankworkError, Description
from crankwork.description.document import numeric_field
from crankwork.report.display import key_unit
from crankwork.study.solve import solution_data, solution_text
from crankwork.units import coherent_unit
from machine_texts import POINTS_ENGINE

pytestmark = pytest.mark.usefixtures("by_arrays")
ENGINE = Description(POINTS_ENGINE)
FOUR_BAR = Description(crankwork.template("four-bar"))
# one stroke down with gas, which a valve opens; the pressure then falls at once
VALVE = """
format = 2
crank = { radius = "45 mm", speed = "1500 rpm" }
rod.ratio = 0.25
cylinder = { bore = "85 mm", compression_ratio = 9 }
[gas]
cycle = "360 deg"
pressures = "absolute"
pieces = [
    { law = "polytropic", exponent = 1.3, points = ["t", "b"] },
    { law = "constant", points = ["b", "e"] },
]
[gas.points]
t = { angle = "0 deg", pressure = "3 MPa" }
b = { angle = "140 deg", pressure = "0.11 MPa" }
e = { angle = "360 deg", pressure = "3 MPa" }
"""


def solved(description, equation, sought, *limits, **how):
    return crankwork.solve(description, equation, sought, limits=limits or (None, None), **how)


def acceleration(phi: float, ratio: float) -> float:
    """Return the second derivative of the piston's place by the crank angle, over the crank radius."""
    cos_rod = math.sqrt(1 - (ratio * math.sin(phi)) ** 2)
    return math.cos(phi) + (ratio * math.cos(2 * phi) + ratio**3 * math.sin(phi) ** 4) / cos_rod**3


@pytest.mark.elsewhere
def test_piston_force_of_a_vertical_engine_reverses_where_inertia_is_gas_and_weight():
    intake = ("gas.points.d.pressure=0.105 MPa", "gas.points.a.pressure=0.105 MPa", "method.weights=true")
    found = solved(ENGINE, "piston_force@33deg = 0", "crank.speed", "100rpm", "6000rpm", overrides=intake, steps=12)
    mass = 0.55 + 0.275 * 0.90
    push = 0.005e6 * math.pi / 4 * 0.085**2 + mass * crankwork.read_machine(ENGINE.dump()).method.gravity
    expected = math.sqrt(push / (mass * 0.045 * acceleration(math.radians(33), 0.28125)))
    (root,) = found.roots
    assert root.at == pytest.approx(expected, rel=1e-10)
    assert (root.kind, found.jumps, found.without) == ("falling", (), ())
    # the file that says so has no force there
    changed = Description(ENGINE.dump())
    changed.replace({"crank.speed": found.sought.written(root.at), "gas.points.d.pressure": "0.105 MPa",
                     "gas.points.a.pressure": "0.105 MPa", "method.weights": True})  # fmt: skip
    assert abs(crankwork.analyse(changed.machine()).value("piston_force", 33)) < 1e-9


def time_ratio(coupler: float) -> float:
    """Return that of the rocker of the template, from its dead positions: crank and coupler in line."""
    frame, crank, rocker = 0.2, 0.0625, 0.1125

    def direction(reach: float) -> float:
        return math.acos((frame**2 + reach**2 - rocker**2) / (2 * frame * reach))

    apart = abs(direction(coupler + crank) - direction(coupler - crank))
    return (math.pi + apart) / (math.pi - apart)


@pytest.mark.elsewhere
def test_couplers_for_a_time_ratio():
    found = solved(FOUR_BAR, "time_ratio.rocker = 1.2", "links.coupler.length", "150.5 mm", "249 mm", steps=50)
    assert [time_ratio(one.at) for one in found.roots] == pytest.approx([1.2, 1.2], rel=1e-10)
    assert [one.at for one in found.roots] == pytest.approx([0.1553835651, 0.2223104821], rel=1e-9)


@pytest.mark.elsewhere
def test_a_ratio_of_one_is_touched_at_the_centric_four_bar():
    found = solved(FOUR_BAR, "time_ratio.rocker = 1", "links.coupler.length", "160 mm", "200 mm", steps=50)
    (root,) = found.roots
    assert root.kind == "touching"
    assert root.at == pytest.approx(math.sqrt(0.0625**2 + 0.2**2 - 0.1125**2), rel=1e-11)


@pytest.mark.elsewhere
def test_a_swing_is_least_at_the_centric_four_bar():
    least = 2 * math.asin(0.0625 / 0.1125)
    limits = ("155 mm", "230 mm")
    found = solved(FOUR_BAR, f"link_swing.rocker = {least!r} rad", "links.coupler.length", *limits, steps=50)
    (root,) = found.roots
    assert root.kind == "touching"
    assert root.at == pytest.approx(math.sqrt(0.0625**2 + 0.2**2 - 0.1125**2), rel=0, abs=1e-12 * 0.075)


def test_no_ratio_is_below_one_and_the_nearest_is_told():
    found = solved(FOUR_BAR, "time_ratio.rocker = 0.9", "links.coupler.length", "160 mm", "200 mm", steps=50)
    assert found.roots == ()
    assert found.nearest.value == pytest.approx(0.1, abs=1e-7)
    assert found.nearest.at == pytest.approx(math.sqrt(0.0625**2 + 0.2**2 - 0.1125**2), rel=1e-6)


@pytest.mark.elsewhere
def test_a_smooth_touching_root():
    found = solved(FOUR_BAR, "point_y.A@0 = 62.5 mm", "crank.start", "10 deg", "173 deg", steps=50)
    (root,) = found.roots
    assert root.kind == "touching"
    assert root.at == pytest.approx(math.pi / 2, rel=0, abs=1e-12 * math.radians(163))


@pytest.mark.elsewhere
def test_a_coupler_too_short_or_too_long_cannot_be_assembled():
    found = solved(FOUR_BAR, "point_y.B@0 = 80", "links.coupler.length", "10 mm", "400 mm", steps=12)
    fixed, crank, rocker = 200.0, 62.5, 112.5
    ends = [(1e3 * one.start, 1e3 * one.end) for one in found.without]
    assert ends[0] == pytest.approx((10.0, fixed - crank - rocker), abs=1e-3)
    assert ends[-1] == pytest.approx((fixed + crank + rocker, 400.0), abs=1e-3)
    # B at a height of 80 mm on its arc about C, seen from A at a crank angle of zero
    reached = [math.hypot(200 - crank + side * math.sqrt(rocker**2 - 80.0**2), 80.0) for side in (-1, 1)]
    assert [1e3 * one.at for one in found.roots] == pytest.approx(reached, rel=1e-10)


def test_an_event_that_passes_an_angle_makes_a_jump():
    valve = Description(VALVE)
    found = solved(valve, "gas_pressure@120deg = 0.05 MPa", "gas.points.b.angle", "100 deg", "160 deg", steps=40)
    assert found.roots == ()
    (jump,) = found.jumps
    assert math.degrees(jump.at) == pytest.approx(120.0)
    results = crankwork.analyse(valve.machine())
    assert jump.before == pytest.approx(0.11e6 - 101325 - 0.05e6)
    assert jump.after == pytest.approx(results.value("gas_pressure", 120) - 0.05e6)


def test_a_summary_value_by_a_field_of_an_entry_of_a_list():
    there = crankwork.analyse(crankwork.read_machine(ENGINE.dump(), overrides=["gas.pieces[5].exponent=1.3"]))
    wanted = f"crank_torque_max = {there['crank_torque_max']!r} N*m"
    (root,) = solved(ENGINE, wanted, "gas.pieces[5].exponent", "1.2", "1.45", steps=20).roots
    assert root.at == pytest.approx(1.3, rel=1e-11)


@pytest.mark.elsewhere
def test_a_value_by_law_is_asked_at_a_time():
    arm = crankwork.load(Path(__file__).parents[1] / "machines" / "elbow.toml")
    found = solved(arm, "driver_angle@0.6s = 10deg", "driver.law[1].to", "5deg", "30deg", steps=10)
    # halfway through a cubic law
    assert [math.degrees(one.at) for one in found.roots] == pytest.approx([20.0], rel=1e-11)
    assert found.is_time
    with pytest.raises(CrankworkError, match=r"^driver_angle varies over the cycle; say where .*: driver_angle@1.35s$"):
        solved(arm, "driver_angle = 10deg", "driver.law[1].to", "5deg", "30deg")


def test_a_value_that_nothing_changes_is_wanted_all_along_or_never():
    along = solved(ENGINE, "side_force@0 = 0", "crank.speed", steps=20)
    assert (along.roots, len(along.found.zero)) == ((), 1)
    assert (along.found.zero[0].start, along.found.zero[0].end) == pytest.approx(
        (along.places.values[0], along.places.values[-1])
    )
    never = solved(ENGINE, "stroke = 100 mm", "crank.speed", steps=20)
    assert (never.roots, never.found.zero) == ((), ())
    assert never.nearest.value == pytest.approx(-0.01)


def test_the_range_follows_from_the_file_or_is_asked_for():
    """Around the value, by limits that are near, of one turn; of an absent one nothing says it, default or not."""
    wanted = "piston_force@33deg = 0"
    for sought, ends, unit, is_even in (
        ("crank.speed", (300.0, 30000.0), math.pi / 30, False),
        ("rod.small_end_share", (0.0, 1.0), 1.0, True),
        ("cylinder.inclination", (-180.0, 180.0), math.pi / 180, True),
    ):
        places = solved(ENGINE, wanted, sought, steps=10).places
        assert (places.values[0] / unit, places.values[-1] / unit) == pytest.approx(ends), sought
        assert (places.is_even, places.is_stated) == (is_even, False), sought
    for sought in ("crank.angular_acceleration", "rod.inertia"):
        for limits, told in (((None, None), "--from"), (("0", None), "--to")):
            with pytest.raises(CrankworkError, match=rf"^{told}: is missing; nothing says how far"):
                solved(ENGINE, wanted, sought, *limits)


def test_an_absent_field_is_sought():
    found = solved(ENGINE, "crank_torque@30 = 200", "rod.inertia", "0 kg*m2", "1 kg*m2", steps=20)
    values = [crankwork.analyse(crankwork.read_machine(ENGINE.dump(), overrides=[f"rod.inertia={one} kg*m2"]))
              .value("crank_torque", 30) for one in (0.0, 1.0)]  # fmt: skip
    (root,) = found.roots
    assert root.at == pytest.approx((200.0 - values[0]) / (values[1] - values[0]), rel=1e-9)


def test_a_number_without_a_unit_is_in_the_system_that_the_machine_is_shown_in():
    found = [
        solved(ENGINE, wanted, "cylinder.bore", "80 mm", "110 mm", steps=10, overrides=[f"units={system}"])
        for system, wanted in (("imperial", "crank_torque_max = 300"), ("metric", "crank_torque_max = 300 lbf*ft"))
    ]
    assert [one.at for one in found[0].roots] == pytest.approx([one.at for one in found[1].roots])
    assert "= 300 lbf·ft" in solution_text(found[0])
    assert "= 406.745 N·m" in solution_text(found[1])
    assert solution_data(found[0])["wanted"]["unit"] == "lbf*ft"


def test_a_stroke_that_begins_and_ends_at_an_angle_makes_two_jumps():
    work = Description(
        '[crank]\nspeed = "100 rpm"\n[load]\nperiod = "360 deg"\n'
        '[[load.strokes]]\nwork = "1000 J"\nfrom = "100 deg"\nover = "40 deg"\n'
    )
    found = solved(work, "load_torque@120deg = 700 N*m", "load.strokes[1].from", "40 deg", "200 deg", steps=50)
    assert found.roots == ()
    assert [math.degrees(one.at) for one in found.jumps] == pytest.approx([80.0, 120.0])
    torque = 1000 / math.radians(40)
    assert [(one.before, one.after) for one in found.jumps] == [
        pytest.approx((-700.0, torque - 700.0)), pytest.approx((torque - 700.0, -700.0))
    ]  # fmt: skip


PRESENT = [
    ("engine", "crank_torque@37deg", "crank.radius"),
    ("points-engine", "indicated_power", "gas.points.z.pressure"),
    ("four-bar", "joint_force.B@80deg", "links.coupler.mass"),
    ("watt-six-bar", "transmission_angle_min.B", "crank.radius"),
    ("whole-engine", "total_torque@100deg", "piston.mass"),
    ("compressor", "piston_force_max", "cylinder.bore"),
    ("crank-shaper", "driving_torque_max", "crank.speed"),
    ("toggle-press", "static_torque@270deg", "links.lower.length"),
]


@pytest.mark.parametrize("present", [PRESENT[:4], pytest.param(PRESENT[4:], marks=pytest.mark.slow)])
def test_the_value_that_a_machine_has_is_found_at_its_own_number(present):
    missed = {}
    for name, key, sought in present:
        machine = Description(POINTS_ENGINE if name == "points-engine" else crankwork.template(name))
        column, _, place = key.partition("@")
        value = crankwork.analyse(machine.machine()).value(column, float(place.removesuffix("deg")) if place else None)
        now = numeric_field(machine.values, sought)
        limits = [now.written(share * now.now) for share in (0.937, 1.071)]
        found = solved(machine, f"{key} = {value!r} {coherent_unit(key_unit(column))}", sought, *limits, steps=12)
        if not min(abs(one.at / now.now - 1) for one in found.roots) < 1e-9:
            missed[name, sought] = found.roots
    assert missed == {}
