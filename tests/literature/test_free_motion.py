"""Machines let go: pendulums, the N-four-bar and links that fall, from files, against closed forms."""

import math

import mpmath as mp
import numpy as np
import pytest

import crankwork
from each import for_each
from machine_texts import analysed

mp.mp.dps = 30
GRAVITY = "9.81"

# periods of a pendulum of 1 m by its amplitude in degrees, as printed (physics.gmu.edu/~mrseth/pass6.html)
PERIODS = {
    10: 2.0098926272986004, 20: 2.0214512578245762, 30: 2.04098988951913, 40: 2.068937851893589,
    50: 2.105934619283643, 60: 2.1528746668805154, 70: 2.210976180542186, 80: 2.2818859240196394,
}  # fmt: skip

PENDULUM = """
fixed_points.O = ["0 m", "0 m"]
crank.pivot = "O"
crank.pin = "P"
crank.radius = "1 m"
crank.speed = "60 rpm"
crank.mass = "1 kg"
crank.inertia = "1 kg*m2"
crank.centre = ["1 m", "0 m"]
crank.start = "{start} deg"
method = {{ weights = true, gravity = "9.81 m/s2" }}
transient = {{ time = "{time} s", step = "{step} s" }}
"""


def events(results: crankwork.Results, word: str) -> list[dict[str, float]]:
    listing = results.listings["transient_events"]
    return [
        {key: float(column[row]) for key, column in listing.columns.items()}
        for row, name in enumerate(listing.names)
        if name.startswith(word)
    ]


@for_each("amplitude", PERIODS)
def test_periods_of_a_pendulum(amplitude: int) -> None:
    results = analysed(PENDULUM.format(start=-90 - amplitude, time=2.9 * PERIODS[amplitude], step=0.1))
    back = events(results, "turns_back")
    assert [one["time"] for one in back] == pytest.approx(PERIODS[amplitude] * np.arange(1, 6) / 2, rel=1e-12)
    assert back[0]["crank_angle"] == pytest.approx(math.radians(2 * amplitude), rel=1e-12)


def test_the_pendulum_let_go_from_the_horizontal() -> None:
    """IFToMM benchmark A01; positions by Jacobi's elliptic functions."""
    results = analysed(PENDULUM.format(start=180, time=10, step=0.01))
    columns = results.listings["transient"].columns
    angle = math.pi + columns["crank_angle"]
    for time, x, y in (
        (2.5, -0.9963344039582815, -0.0855438804888806), (5.0, -0.9423054350437573, -0.3347543384140006),
        (9.99, -0.3164364699130323, -0.9486137045757765), (10.0, -0.2750874625761169, -0.9614192050991252),
    ):  # fmt: skip
        row = int(np.argmin(np.abs(columns["time"] - time)))
        assert (math.cos(angle[row]), math.sin(angle[row])) == pytest.approx((x, y), abs=1e-12)
    energy = columns["kinetic_energy"] + columns["potential_energy"]
    assert np.ptp(energy) < 1e-13 * columns["kinetic_energy"].max()


def four_bars(count: int, time: float) -> str:
    """IFToMM benchmark A02: `count` parallelograms of rods of 1 m and 1 kg in a row, pushed off upright with 1 m/s."""
    rod = 'length = "1 m", mass = "1 kg", inertia = "0.0833333333333333333 kg*m2"'
    places = range(1, count + 1)
    return "\n".join(
        [
            "[fixed_points]",
            *(f'A{k} = ["{k} m", "0 m"]' for k in (0, *places)),
            '[crank]\npivot = "A0"\npin = "B0"\nradius = "1 m"\nspeed = "60 rpm"\nstart = "90 deg"\nmass = "1 kg"',
            'inertia = "0.3333333333333333333 kg*m2"\ncentre = ["0.5 m", "0 m"]\n[links]',
            *(
                f'C{k} = {{ joins = ["B{k - 1}", "B{k}"], {rod}, points = {{ G{k} = ["0.5 m", "0 m"] }}, '
                f'centre = "G{k}" }}\n'
                f'R{k} = {{ joins = ["A{k}", "B{k}"], {rod}, points = {{ H{k} = ["0.5 m", "0 m"] }}, '
                f'centre = "H{k}" }}'
                for k in places
            ),
            "[positions]",
            *(f'B{k} = ["{k} m", "1 m"]' for k in places),
            f'[method]\nweights = true\ngravity = "{GRAVITY} m/s2"',
            f'[transient]\ntime = "{time} s"\nspeed = "-1 rad/s"\nstep = "0.01 s"',
        ]
    )


def turned(count: int, time: float) -> tuple[float, float]:
    """Angle from upright and rate of a pendulum that turns over, by elliptic functions (30 digits)."""
    inertia = mp.mpf(count + 1) / 3 + count
    weight = mp.mpf(GRAVITY) * (mp.mpf(count + 1) / 2 + count)
    whole = inertia / 2 + weight
    rate, k2 = mp.sqrt((whole + weight) / (2 * inertia)), 2 * weight / (whole + weight)
    u, quarter = rate * time - mp.ellipk(k2), mp.ellipk(k2)
    half_turns = mp.floor((u + quarter) / (2 * quarter))
    rest = u - 2 * half_turns * quarter
    from_bottom = mp.asin(mp.ellipfun("sn", rest, m=k2)) + half_turns * mp.pi
    return float(mp.pi + 2 * from_bottom), float(2 * rate * mp.sqrt(1 - k2 * mp.sin(from_bottom) ** 2))


@for_each("count", [1, 2, 6])
def test_the_n_four_bar_over_ten_seconds(count: int) -> None:
    """It passes two change points of every parallelogram each turn."""
    results = analysed(four_bars(count, 10.0))
    angle, rate = turned(count, 10.0)
    assert -results.summary["final_turn"] == pytest.approx(angle, abs=1e-9)
    assert -results.summary["final_speed"] == pytest.approx(rate, abs=1e-9)
    columns = results.listings["transient"].columns
    energy = columns["kinetic_energy"] + columns["potential_energy"]
    assert np.ptp(energy) < 1e-12 * columns["kinetic_energy"].max()
    assert results.checks["energy_balance"] < 1e-12
    passed = events(results, "change_point")
    assert len(passed) == math.floor(abs(angle) / math.pi + 0.5)
    assert [one["crank_angle"] for one in passed] == pytest.approx(
        [-math.pi / 2 - math.pi * k for k in range(len(passed))], abs=1e-12
    )


# two links of 10 kg and 0.375 m between wheels on a floor and a collar of 7 kg: as a trammel, both links in one
COLLAR = """
fixed_points.O = ["0 m", "0 m"]
crank = { pivot = "O", pin = "M", radius = "0.1875 m", start = "0 deg", speed = "60 rpm" }
links.link = { joins = ["M", "B"], length = "0.1875 m", mass = "20 kg", inertia = "0.234375 kg*m2", centre = "M" }
guides.rod = { angle = "90 deg" }
sliders.collar = { guide = "rod", pin = "B", mass = "7 kg" }
positions.B = ["0 m", "0.01 m"]
method = { weights = true, gravity = "9.81 m/s2" }
"""


def test_a_collar_falls_onto_a_spring() -> None:
    """Meriam and Kraige, 6/11: 2.54 m/s where the links are level, the spring of 30 kN/m gives way by 60.1 mm."""
    fallen = analysed(
        COLLAR + 'transient = { time = "2 s", start = "45 deg", stops = ["0 deg", "90 deg"], until = "rest" }'
    )
    (met,) = events(fallen, "stop")
    speed = 0.375 * abs(met["crank_speed"])
    assert speed == pytest.approx(2.54, rel=2e-3)
    assert speed == pytest.approx(2.54390445667142, rel=1e-12)
    sinking = COLLAR + 'loads = [{ kind = "spring", slider = "collar", stiffness = "30000 N/m" }]\n'
    sunk = analysed(sinking + f'transient = {{ time = "0.1 s", speed = "{met["crank_speed"]!r} rad/s" }}')
    way = 0.375 * math.sin(-events(sunk, "turns_back")[0]["crank_angle"])
    assert way == pytest.approx(0.0601, rel=2e-3)
    assert way == pytest.approx(0.06013928424680485, rel=1e-11)


def test_a_damper_on_a_yoke_slows_a_wheel_down() -> None:
    """J w' = -d (r sin phi)^2 w, so that w = w0 - d r^2 / J (phi / 2 - sin 2 phi / 4)."""
    results = analysed("""
        fixed_points.O = ["0 m", "0 m"]
        crank = { pivot = "O", pin = "A", radius = "0.1 m", speed = "60 rpm", inertia = "2 kg*m2" }
        guides = { slot = { link = "yoke", angle = "90 deg" }, bed = { through = "O", angle = "0 deg" } }
        sliders = { block = { guide = "slot", pin = "A" }, yoke = { guide = "bed" } }
        loads = [{ kind = "damper", slider = "yoke", damping = "60 N*s/m" }]
        transient = { speed = "10 rad/s", time = "3 s", step = "0.1 s" }
    """)
    columns = results.listings["transient"].columns
    angle = columns["crank_angle"]
    slowed = 60 * 0.1**2 / 2 * (angle / 2 - np.sin(2 * angle) / 4)
    assert columns["crank_speed"] == pytest.approx(10 - slowed, rel=1e-12)
    assert columns["crank_speed"][-1] < 8
    assert results.unmet == ()
