"""Torsional vibration from machine files: against integration in time, limits and closed forms."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import crankwork
from crankwork.errors import InputError
from each import for_each
from machine_texts import POINTS_ENGINE, analysed

pytestmark = pytest.mark.elsewhere

GEARED = """
crank.speed = "300 rpm"
[torsion]
discs.rotor = { inertia = "2 kg*m2", damping = "30 N*m*s/rad" }
discs.pinion.inertia = "0.1 kg*m2"
discs.wheel.inertia = "1 kg*m2"
discs.load = { inertia = "5 kg*m2", damping = "20 N*m*s/rad" }
shafts.first = { between = ["rotor", "pinion"], stiffness = "8 kN*m/rad", damping = "15 N*m*s/rad", diameter = "60 mm" }
shafts.second = { between = ["wheel", "load"], stiffness = "20 kN*m/rad", damping = "10 N*m*s/rad" }
gears.mesh = { between = ["pinion", "wheel"], ratio = 0.5 }
dampers.ring = { on = "rotor", inertia = "0.5 kg*m2", damping = "12 N*m*s/rad" }
torques = [
    { disc = "rotor", torque = "400 N*m", order = 2 },
    { disc = "load", torque = "300 N*m", order = 1.5, phase = "40 deg" },
]
"""


def test_forced_vibration_is_what_integration_in_time_settles_to():
    results = analysed(GEARED)
    w, i = 10 * math.pi, 0.5
    # rotor, pinion with the wheel at its speed, load, ring
    J = np.array([2.0, 0.1 + 1.0 * i**2, 5.0, 0.5])

    def rates(t, state):
        angle, speed = state[:4], state[4:]
        twist = 8e3 * (angle[0] - angle[1]) + 15.0 * (speed[0] - speed[1])
        behind = 2e4 * (i * angle[1] - angle[2]) + 10.0 * (i * speed[1] - speed[2])
        rubbed = 12.0 * (speed[0] - speed[3])
        torque = np.array([
            400.0 * math.cos(2 * w * t) - twist - rubbed - 30.0 * speed[0],
            twist - i * behind,
            300.0 * math.cos(1.5 * w * t + math.radians(40)) + behind - 20.0 * speed[2],
            rubbed,
        ])  # fmt: skip
        return np.concatenate([speed, torque / J])

    period = 4 * math.pi / w
    after = 40 * period
    found = solve_ivp(rates, (0, after + period), np.zeros(8), method="DOP853", rtol=1e-11, atol=1e-13,
                      t_eval=after + np.linspace(0, period, 40_001))  # fmt: skip
    angle, speed = found.y[:4], found.y[4:]
    # it may also turn at a constant angle, which is no vibration
    angle = angle - angle[:, :-1].mean(axis=1, keepdims=True)
    for name, column in (("rotor", angle[0]), ("pinion", angle[1]), ("load", angle[2]), ("ring", angle[3])):
        assert results[f"vibration_amplitude.{name}"] == pytest.approx(np.max(np.abs(column)), rel=1e-6), name
    torque = 8e3 * (angle[0] - angle[1]) + 15.0 * (speed[0] - speed[1])
    assert results["vibration_torque.first"] == pytest.approx(np.max(np.abs(torque)), rel=2e-6)
    stress = 16 * np.max(np.abs(torque)) / (math.pi * 0.06**3)
    assert results["vibration_stress.first"] == pytest.approx(stress, rel=2e-6)


def test_a_stiff_crankshaft_turns_as_one_body_with_the_harmonics_of_all_cylinders():
    engine = f"""{POINTS_ENGINE}
[torsion]
throw_inertia = "0.05 kg*m2"
shafts.rear = {{ between = ["throw_1", "flywheel"], stiffness = "1e9 kN*m/rad" }}
discs.flywheel.inertia = "0.5 kg*m2"
"""
    results = analysed(engine)
    harmonics = results.listings["torsional_discs"].columns["disc_inertia"].sum()
    whole = crankwork.analyse(crankwork.read_machine(POINTS_ENGINE))
    w = results["speed"]
    from crankwork.analysis.all_cylinders import with_engine_results

    columns = with_engine_results(whole).listings["torque_harmonics"].columns
    order = columns["harmonic_order"]
    keep = order <= 12
    waves = (columns["harmonic_cosine"] - 1j * columns["harmonic_sine"])[keep] / (harmonics * (order[keep] * w) ** 2)
    turn = np.linspace(0, 4 * math.pi, 20_001)
    largest = np.max(np.abs((np.exp(1j * np.outer(turn, order[keep])) @ waves).real))
    assert results["vibration_amplitude.throw_1"] == pytest.approx(largest, rel=1e-6)
    assert results["vibration_amplitude.flywheel"] == pytest.approx(largest, rel=1e-6)


THROW = """
[torsion]
modulus = "80 GPa"
discs = { A.inertia = "1 kg*m2", B.inertia = "1 kg*m2" }
[torsion.shafts.crank]
between = ["A", "B"]
[torsion.shafts.crank.throw]
formula = "%s"
journal_length = "60 mm"
journal_diameter = "100 mm"
journal_bore = "40 mm"
pin_length = "70 mm"
pin_diameter = "90 mm"
pin_bore = "30 mm"
web_thickness = "50 mm"
web_width = "150 mm"
radius = "120 mm"
"""
# lengths by hand in metres: D_j^4 over the sections of journal, pin and web (h b^3)
JOURNAL, PIN, WEB = (0.1**4 / size for size in (0.1**4 - 0.04**4, 0.09**4 - 0.03**4, 0.05 * 0.15**3))
LENGTHS = {
    "ker-wilson": 0.10 * JOURNAL + 0.106 * PIN + 0.082 * WEB,
    "carter": 0.10 * JOURNAL + 0.0525 * PIN + 0.18 * WEB,
    "timoshenko": 0.105 * JOURNAL + 0.115 * PIN + 0.1116 * WEB,
}


@for_each("formula", LENGTHS)
def test_lengths_of_throws_are_those_of_their_formulas(formula):
    results = analysed(THROW % formula)
    assert results["equivalent_length.crank"] == pytest.approx(LENGTHS[formula], rel=1e-12)
    stiffness = 80e9 * math.pi * 0.1**4 / 32 / LENGTHS[formula]
    assert results["torsional_stiffness.crank"] == pytest.approx(stiffness, rel=1e-12)
    assert results["natural_frequency.1"] == pytest.approx(math.sqrt(2 * stiffness), rel=1e-12)


def test_a_throw_is_weakest_where_its_section_is_whatever_its_diameter():
    """A hollow pin of 90 mm beside a journal of 80 mm: 16 T D / (pi (D^4 - d^4)) counts, not the diameter."""
    hollow = [f"torsion.throw_shaft.throw.pin_{key}" for key in ("diameter=90 mm", "bore=80 mm")]
    example = Path(__file__).parents[2] / "examples" / "vibrating-crankshaft.toml"
    results = crankwork.analyse(crankwork.read(example, overrides=hollow))
    for throw in (1, 2, 3):
        stress = 16 * results[f"vibration_torque.crank_{throw}"] * 0.09 / (math.pi * (0.09**4 - 0.08**4))
        assert results[f"vibration_stress.crank_{throw}"] == pytest.approx(stress, rel=1e-12)


def test_a_formula_with_charts_says_so_and_names_those_without():
    with pytest.raises(InputError, match=r"formula: .*charts.*timoshenko.*stiffness"):
        crankwork.read_machine(THROW % "BICERA")


DRAWN = """
[fixed_points]
shaft = ["0 mm", "0 mm"]
[crank]
pivot = "shaft"
pin = "P"
radius = "60 mm"
speed = "1500 rpm"
mass = "3 kg"
centre = "P"
inertia = "0.0108 kg*m2"
[links.rod]
joins = ["P", "W"]
length = "200 mm"
mass = "2.2 kg"
centre = ["60 mm", "0 mm"]
inertia = "0.01848 kg*m2"
[guides.rail]
through = ["0 mm", "0 mm"]
angle = "0 deg"
[sliders.piston]
guide = "rail"
pin = "W"
mass = "1.5 kg"
[positions]
W = ["260 mm", "0 mm"]
[torsion]
throw_inertia = "0.02 kg*m2"
discs.wheel.inertia = "0.5 kg*m2"
shafts.rear = { between = ["throw_1", "wheel"], stiffness = "350 kN*m/rad" }
"""


def test_a_drawn_crank_with_rod_and_piston_is_a_throw():
    """Two discs, the first with the mean of twice the kinetic energy over the square of the speed."""
    phi, r, l = np.linspace(0, 2 * math.pi, 4000, endpoint=False), 0.06, 0.2  # noqa: E741
    pin = r * np.exp(1j * phi)
    end = (pin.real + np.sqrt(l**2 - pin.imag**2)).astype(complex)
    rates = [np.fft.ifft(1j * np.fft.fftfreq(4000, 1 / 4000) * np.fft.fft(x)) for x in (end, pin + 0.3 * (end - pin))]
    turn = r * np.cos(phi) / np.sqrt(l**2 - pin.imag**2)
    reduced = 1.5 * abs(rates[0]) ** 2 + 2.2 * abs(rates[1]) ** 2 + 0.01848 * turn**2
    throw, k = float(np.mean(reduced)) + 3 * r**2 + 0.02, 350e3
    results = analysed(DRAWN)
    assert results["natural_frequency.1"] == pytest.approx(math.sqrt(k * (1 / throw + 1 / 0.5)), rel=1e-10)
    heavier = analysed(DRAWN.replace('mass = "3 kg"\ncentre = "P"\n', ""))
    assert [notice.code for notice in heavier.notices if notice.code.startswith("torsion_crank")]
    with pytest.raises(InputError, match=r"torsion: only for a crank with rods and pistons"):
        analysed(
            DRAWN.replace("radius =", 'points = { Q = ["90 mm", "0 mm"] }\nradius =').replace(
                '["P", "W"]', '["Q", "W"]'
            )
        )


def one_disc(damper: str, ratio: float) -> crankwork.Results:
    """Return a disc on a shaft with a damper, excited at a part of its own frequency of 100 rad/s."""
    return analysed(f"""
        [torsion]
        discs.wheel.inertia = "2 kg*m2"
        shafts.rod = {{ between = ["ground", "wheel"], stiffness = "20 kN*m/rad" }}
        dampers.ring = {{ on = "wheel", inertia = "0.5 kg*m2", {damper} }}
        torques = [{{ disc = "wheel", torque = "20 N*m", frequency = "{100 * ratio!r} rad/s" }}]
    """)


def test_dampers_have_the_peaks_of_den_hartog():
    """J. P. Den Hartog, Mechanical Vibrations, ch. 3 and 5: the peak with the best damper."""
    mu, still = 0.25, 1e-3
    best = one_disc('damping = "1 N*m*s/rad"', 0.5)
    assert best["optimum_damping.ring"] == pytest.approx(2 * 0.5 * 100 / math.sqrt(2 * 1.25 * 2.25), rel=1e-12)
    assert best["least_magnification.ring"] == pytest.approx(1 + 2 / mu, rel=1e-12)
    untuned = f'damping = "{best["optimum_damping.ring"]!r} N*m*s/rad"'
    peak = one_disc(untuned, math.sqrt(2 / (2 + mu)))["vibration_amplitude.wheel"]
    assert peak == pytest.approx(still * (1 + 2 / mu), rel=1e-9)
    assert all(one_disc(untuned, ratio)["vibration_amplitude.wheel"] < peak for ratio in (0.8, 0.9, 0.97, 1.05))
    spring = one_disc('damping = "1 N*m*s/rad", stiffness = "3 kN*m/rad"', 0.5)
    assert spring["optimum_stiffness.ring"] == pytest.approx(0.5 * (100 / 1.25) ** 2, rel=1e-12)
    assert spring["least_magnification.ring"] == pytest.approx(3.0, rel=1e-12)
    assert spring["optimum_damping.ring"] == pytest.approx(2 * 0.5 * 100 * math.sqrt(0.75 / 15.625), rel=1e-12)
    tuned = f'damping = "{spring["optimum_damping.ring"]!r} N*m*s/rad", stiffness = "3200 N*m/rad"'
    # both fixed points, which no damping moves
    inside = math.sqrt(mu / (2 + mu))
    for square in ((1 - inside) / (1 + mu), (1 + inside) / (1 + mu)):
        height = one_disc(tuned, math.sqrt(square))["vibration_amplitude.wheel"]
        assert height == pytest.approx(still * math.sqrt(1 + 2 / mu), rel=1e-9)


def test_the_stress_of_a_hollow_shaft_is_that_of_the_twist_of_a_single_disc():
    """At half of its frequency the disc swings by 20 / (20000 - 2 * 50^2) rad."""
    results = analysed("""
        [torsion]
        discs.wheel.inertia = "2 kg*m2"
        torques = [{ disc = "wheel", torque = "20 N*m", frequency = "50 rad/s" }]
        [torsion.shafts.rod]
        between = ["ground", "wheel"]
        stiffness = "20 kN*m/rad"
        diameter = "30 mm"
        bore = "20 mm"
    """)
    torque = 20e3 * 20 / (20e3 - 2 * 50**2)
    assert results["vibration_torque.rod"] == pytest.approx(torque, rel=1e-12)
    assert results["vibration_stress.rod"] == pytest.approx(
        16 * torque * 0.03 / (math.pi * (0.03**4 - 0.02**4)), rel=1e-12
    )


def test_free_vibration_with_damping_is_that_of_a_torsional_pendulum():
    """T. Bevan, The Theory of Machines, ex. 15.5: 2.11 per second without damping, a ratio of 0.988 with it."""
    results = analysed("""
        [torsion]
        modulus = "12e6 psi"
        discs.disc = { inertia = "500 lb*ft2", damping = "86.9 N*m*s/rad" }
        shafts.wire = { between = ["ground", "disc"], length = "36 in", diameter = "1 in" }
    """)
    columns = results.listings["damped_modes"].columns
    J, w = 500 * 0.45359237 * 0.3048**2, results["natural_frequency.1"]
    assert w / math.tau == pytest.approx(2.11, abs=5e-3)
    ratio = 86.9 / (2 * J * w)
    assert columns["damping_ratio"] == pytest.approx([ratio], rel=1e-9)
    assert columns["damped_frequency"] == pytest.approx([w * math.sqrt(1 - ratio**2)], rel=1e-9)
    assert columns["damped_frequency"][0] / w == pytest.approx(0.988, abs=5e-4)


def test_a_sweep_compiles_and_solving_finds_a_stiffness():
    description = crankwork.Description(GEARED)
    keys = ["natural_frequency.1", "relative_amplitude.1.load", "vibration_amplitude.rotor", "optimum_damping.ring"]
    inertias = [1.5, 2.0, 2.5]
    swept = crankwork.sweep(description, {"torsion.discs.rotor.inertia": inertias}, keys)
    assert swept.reason == ""
    for index, inertia in enumerate(inertias):
        alone = analysed(GEARED.replace("2 kg*m2", f"{inertia} kg*m2"))
        for key in keys:
            assert swept.values[key][index] == pytest.approx(alone[key], rel=1e-9)


HELD = 'shafts.s = { between = ["A", "ground"], stiffness = "1 N*m/rad" }'
ONE = 'discs = { A.inertia = "1 kg*m2" }'
REFUSED = {
    ONE: "torsion.shafts",
    f'{ONE}\nshafts.s = {{ between = ["A", "C"], stiffness = "1 N*m/rad" }}': "between[2]",
    f'{ONE}\nshafts.s = {{ between = ["A", "A"], stiffness = "1 N*m/rad" }}': "between",
    f'discs = {{ A.inertia = "0 kg*m2" }}\n{HELD}': "torsion.discs",
    f'discs = {{ A.inertia = "1 kg*m2", ground.inertia = "1 kg*m2" }}\n{HELD}': "torsion.discs.ground",
    f'{ONE}\nshafts.s = {{ between = ["A", "ground"], length = "1 m" }}': "length",
    f'{ONE}\nshafts.s = {{ between = ["A", "ground"], length = "1 m", diameter = "2 cm", bore = "2 cm" }}': "bore",
    f'{ONE}\nspeeds = ["9 rpm", "2 rpm"]\n{HELD}': "torsion.speeds",
    f'{ONE}\ntorques = [{{ disc = "A", torque = "1 N*m", order = 1 }}]\n{HELD}': "crank.speed",
}


@for_each("text", REFUSED)
def test_what_cannot_vibrate_is_refused_at_its_key(text):
    with pytest.raises(InputError) as refused:
        crankwork.read_machine(f"[torsion]\n{text}")
    assert any(REFUSED[text] in problem.key for problem in refused.value.problems), str(refused.value)
