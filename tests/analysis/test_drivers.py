"""A boom on its cylinder from the machine file, against the equation of motion of a pendulum and the law of cosines."""

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork

pytestmark = pytest.mark.elsewhere
EXAMPLE = Path(__file__).parent.parent.parent / "examples" / "excavator-boom.toml"


@pytest.fixture(scope="module")
def boom():
    return crankwork.analyse(crankwork.read(EXAMPLE))


def raised(time):
    """Return the length of the cylinder in the first four seconds and its two rates."""
    z = time / 4
    way = 0.6
    length = 1.65 + way * (10 * z**3 - 15 * z**4 + 6 * z**5)
    rate = way / 4 * (30 * z**2 - 60 * z**3 + 30 * z**4)
    second = way / 16 * (60 * z - 180 * z**2 + 120 * z**3)
    return length, rate, second


def by_hand(time):
    """Return direction, angular velocity of the boom, force and power of the cylinder."""
    q, v, a = raised(time)
    base, arm = math.hypot(0.55, 0.55), 2.1
    cosine = (base**2 + arm**2 - q**2) / (2 * base * arm)
    gamma = math.acos(cosine)
    lever = base * arm * math.sin(gamma) / q
    omega = v / lever
    # v = lever omega, and lever' by gamma from the law of cosines
    lever_1 = (base * arm * cosine - lever**2) / q
    epsilon = (a - lever_1 * omega**2) / lever
    angle = gamma - math.pi / 4
    centre, tip = complex(2.4, -0.2), complex(5.1, -0.75)
    turned = complex(math.cos(angle), math.sin(angle))
    inertia = 3100 + 1150 * abs(centre) ** 2
    moment = inertia * epsilon + 1150 * 9.80665 * (centre * turned).real + 21e3 * (tip * turned).real
    force = moment / lever
    return angle, omega, force, force * v


def test_motion_force_and_power_are_those_by_hand(boom):
    keys = ("link_angle.boom", "link_angular_velocity.boom", "driver_force", "driver_power")
    for time in (0.1, 1.0, 1.7, 2.0, 3.2, 3.99):
        assert [boom.value(key, at=time) for key in keys] == pytest.approx(by_hand(time), rel=1e-12), time


def test_a_driven_piece_alone_follows_its_law():
    machine = crankwork.read_machine("""
[driver]
slider = "ram"
start = "10 mm"
law = [{ kind = "harmonic", to = "50 mm", over = "2 s" }]
[guides.bed]
through = ["0 mm", "0 mm"]
[sliders.ram]
guide = "bed"
pin = "A"
mass = "2 kg"
""")
    results = crankwork.analyse(machine)
    time = 0.7
    found = [results.value(key, at=time) for key in ("driver_velocity", "driver_force")]
    w = math.pi / 2
    assert found == pytest.approx([0.02 * w * math.sin(w * time), 2 * 0.02 * w**2 * math.cos(w * time)], rel=1e-12)
    assert not results.unmet


def test_single_values_are_at_their_times(boom):
    summary = boom.summary
    time = summary["driver_power_max_time"]
    times = time + np.array([-1e-3, 0.0, 1e-3])
    before, there, after = (by_hand(one)[3] for one in times)
    assert there == pytest.approx(summary["driver_power_max"], rel=1e-12)
    assert there > max(before, after)
    assert summary["period"] == 8.0
    assert summary["driver_velocity_max"] == pytest.approx(1.875 * 0.6 / 4, rel=1e-13)
    assert boom["time"][1] == 0.25
    assert not boom.unmet


def test_what_presumes_a_turning_shaft_is_absent(boom):
    assert boom.notices[0].code == "by_law"
    for key in ("mean_torque", "reduced_inertia", "dynamic_torque", "rotational_speed", "time_ratio"):
        assert not any(one.startswith(key) for one in (*boom.summary, *boom.columns))


SLIDER = (Path(__file__).parents[1] / "machines" / "driven-slider.toml").read_text("utf-8")


def law_jumps(text):
    results = crankwork.analyse(crankwork.read_machine(text))
    return [item.values for item in results.notices if item.code == "law_jump"]


def test_a_jump_of_the_speed_between_segments_is_told_with_its_place():
    assert law_jumps(SLIDER) == []
    values = law_jumps(SLIDER.replace('"4-5-6-7"', '"constant"'))[0]
    # 60 mm back in half of 0.8 s, after a dwell
    assert (values["path"], values["count"]) == ("driver.law[2]", 2)
    assert (values["time"], values["before"]) == (pytest.approx(0.4), pytest.approx(0.0, abs=1e-9))
    assert values["after"] == pytest.approx(-0.15)


def test_a_jump_of_the_speed_at_the_end_of_the_period_is_told():
    # from rest to 0.3 m/s over 60 mm in 0.4 s, and back with that as constant deceleration: at rest only at its start
    text = SLIDER.replace('"modified-sine"', '"constant-acceleration"').replace('"4-5-6-7"', '"constant-acceleration"')
    text = text.replace('    { kind = "dwell", over = 0.1 },\n', "").replace("over = 0.4", "over = 0.5")
    text = text.replace('to = "170 mm"', 'to = "170 mm", start_speed = "0.3 m/s"')
    values = law_jumps(text)[0]
    assert (values["path"], values["count"], values["time"]) == ("driver.law[2]", 1, pytest.approx(0.8))
    # 2 (-60 mm) / 0.4 s - 0.3 m/s at the end
    assert (values["before"], values["after"]) == (pytest.approx(-0.6), pytest.approx(0.0, abs=1e-6))


def test_a_law_that_goes_on_from_where_it_ends_has_no_jump_at_the_end():
    text = SLIDER.replace('to = "170 mm", over = 0.5', 'to = "240 mm", over = 0.5')
    assert law_jumps(text.replace("period", 'start = "170 mm"\nperiod').replace('"4-5-6-7"', '"cubic"')) == []
