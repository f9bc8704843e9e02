"""Examples with gas in chambers against geometry by hand, closed forms and quadrature; two turns against the engine."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve, minimize_scalar

import crankwork
from crankwork.kinematics.crank_grid import CrankGrid

pytestmark = pytest.mark.elsewhere

EXAMPLES = Path(__file__).parents[2] / "examples"
ANGLES = np.array([0.0, 7.0, 63.5, 140.0, 226.0, 311.0])


def analysed(name, *settings):
    return crankwork.analyse(crankwork.read(EXAMPLES / f"{name}.toml", settings), CrankGrid.from_degrees(ANGLES))


def least(function, start=0.0, end=360.0):
    """Return the least value of a function of the crank angle, and where it is. [deg]"""
    near = min(np.arange(start, end, 0.5), key=function)
    found = minimize_scalar(function, bounds=(near - 1, near + 1), method="bounded", options={"xatol": 1e-10})
    return found.fun, found.x


def rod_end(radius, length, degrees):
    """Return how far the end of a rod on a line through the shaft is from it, the crank at an angle to the line."""
    phi = math.radians(degrees)
    return radius * math.cos(phi) + math.sqrt(length**2 - (radius * math.sin(phi)) ** 2)


class TestAtkinson:
    """Coordinates from the equations of the linkage, by a solver that knows nothing of dyads."""

    def height(self, degrees, near):
        """Return the height of the piston in millimetres, and what was solved for: angles of coupler and rocker."""
        turn = math.radians(347.0 + degrees)
        crank = np.array([30 * math.cos(turn), 30 * math.sin(turn)])

        def arm(angle, along, across=0.0):
            sin, cos = math.sin(angle), math.cos(angle)
            return np.array([along * cos - across * sin, along * sin + across * cos])

        def open_by(angles):
            return crank + arm(angles[0], 50.1) - np.array([-39.6, -109.6]) - arm(angles[1], 124.3)

        angles = fsolve(open_by, near, xtol=1e-12)
        pin = crank + arm(angles[0], 120.4, -128.1)
        return pin[1] + math.sqrt(199**2 - (pin[0] + 49.8) ** 2), angles

    def heights(self):
        near, found = np.array([2.9, 1.8]), []
        for degrees in range(361):
            height, near = self.height(float(degrees), near)
            found.append(height)
        return np.array(found)

    def test_it_expands_farther_than_it_compresses(self):
        values = self.heights()
        volume = analysed("atkinson").columns_at(np.arange(361.0))["cylinder_volume.cylinder"]
        assert 1e9 * (volume - volume[0]) / (math.pi * 70**2 / 4) == pytest.approx(values[0] - values, abs=1e-9)
        before, turn, after = np.roll(values[:-1], 1), values[:-1], np.roll(values[:-1], -1)
        low, middle, *tops = np.sort(turn[(turn - before) * (after - turn) < 0])
        assert tops == pytest.approx([values[0]] * 2, abs=0.1)
        assert (values[0] - low) / (values[0] - middle) == pytest.approx(1.61, abs=0.005)


class TestBetaStirling:
    """Schmidt's analysis in closed form, with the strokes overlapping and a rod through the cold space."""

    def test_work_and_pressure(self):
        results = analysed("beta-stirling")
        face, rod = math.pi * 7.0**2 / 4 * 1e-4, math.pi * 1.2**2 / 4 * 1e-4
        # volumes are middle + cos * cosine + sin * sine of the crank angle
        hot = np.array([face * 0.03 + 20e-6, -face * 0.03, 0.0])
        cold = (face - rod) * np.array([0.0, 0.03 - 0.0125, -0.0216506351])
        cold[0] = math.hypot(cold[1], cold[2]) + 15e-6
        whole = hot / 900 + cold / 320
        whole[0] += 18e-6 / 900 + 30e-6 / 560 + 14e-6 / 320
        share, angle = math.hypot(whole[1], whole[2]) / whole[0], math.atan2(whole[2], whole[1])
        root = math.sqrt(1 - share**2)
        pressure = 1e6 * root / (1 + share * np.cos(np.radians(ANGLES) - angle))
        assert results["gas_pressure.hot"] == pytest.approx(pressure - 1e6, abs=1e-4)
        work = 2e6 * math.pi * (root - 1) / share * face * 0.03 * math.sin(angle)
        assert results["indicated_work.hot"] == pytest.approx(work, rel=1e-10)
        assert results["indicated_work.cold"] == pytest.approx(-work * 320 / 900, rel=1e-10)
        assert results["mean_torque"] == pytest.approx(work * (1 - 320 / 900) / math.tau, rel=1e-10)
        assert results["gas_mass.helium"] == pytest.approx(1e6 * whole[0] * root / 2077, rel=1e-10)


class TestOpposedPistons:
    """Two rods on two throws of one crank, and the volume between their ends."""

    def apart(self, degrees):
        upper = math.degrees(math.atan2(-11.2841, -63.9953))
        radius = math.hypot(11.2841, 63.9953)
        return rod_end(radius, 860.0, degrees - 5 + upper) - rod_end(75.0, 290.0, degrees - 5)

    def test_volume_and_work(self):
        results, area = analysed("opposed-pistons"), math.pi * 105**2 / 4 * 1e-9
        nearest, at = least(self.apart, -30.0, 30.0)
        farthest = -least(lambda degrees: -self.apart(degrees))[0]
        swept = area * (farthest - nearest)
        clearance = swept / 15
        assert abs(at) > 0.1
        expected = [clearance + area * (self.apart(one) - nearest) for one in ANGLES]
        assert results["cylinder_volume.cylinder"] == pytest.approx(expected, rel=1e-10)

        def power(degrees):
            rate = (self.apart(degrees + 1e-4) - self.apart(degrees - 1e-4)) / 2e-4
            return results.value("diagram_pressure.cylinder", degrees % 360) * area * rate

        ends = (0.0, 12.0, 112.0, 150.0, 242.0, 360.0)
        parts = [quad(power, one + 1e-9, two, epsabs=1e-3)[0] for one, two in itertools.pairwise(ends)]
        assert results["indicated_work.cylinder"] == pytest.approx(sum(parts), rel=1e-6)


class TestSteamEngine:
    """Admission, expansion along a hyperbola, exhaust and compression, by hand on both sides of the piston."""

    def side(self, swept):
        """Return the area of one diagram without its release, which is a curve. [J]"""
        clearance, high, low = 2200e-6, 8e5, 1.2e5
        cut_off, release, closing = (clearance + share * swept for share in (0.35, 0.95, 0.25))
        work = high * 0.35 * swept + high * cut_off * math.log(release / cut_off)
        return work - low * 0.75 * swept - low * closing * math.log(closing / clearance), high * cut_off / release

    def test_work_of_both_sides(self):
        results = analysed("double-acting-steam")
        for name, rod in (("head", 0.0), ("crank", 0.05)):
            area = math.pi * (0.3**2 - rod**2) / 4
            swept = area * 0.45
            assert results[f"swept_volume.{name}"] == pytest.approx(swept, rel=1e-12)
            work, released = self.side(swept)
            # the release falls from one pressure to the other over a twentieth of the stroke
            rest = results[f"indicated_work.{name}"] - work
            assert 1.2e5 * 0.05 * swept < rest < released * 0.05 * swept

    def test_the_sides_push_against_each_other(self):
        results = analysed("double-acting-steam")
        for row in range(len(ANGLES)):
            head, crank = (results[f"diagram_pressure.{name}"][row] - 1e5 for name in ("head", "crank"))
            force = math.pi * (0.3**2 * head - (0.3**2 - 0.05**2) * crank) / 4
            assert results["gas_force.head"][row] + results["gas_force.crank"][row] == pytest.approx(force, rel=1e-12)


FOUR_STROKE = """
    pressures = "absolute"
    ambient = "0.1 MPa"
    {points}
    a = {{ angle = "0 deg", pressure = "0.09 MPa" }}
    b = {{ angle = "180 deg" }}
    c = {{ angle = "360 deg" }}
    z = {{ angle = "375 deg", pressure = "5 MPa" }}
    d = {{ angle = "540 deg" }}
    e = {{ angle = "560 deg", pressure = "0.11 MPa" }}
    f = {{ angle = "720 deg" }}
"""


def four_stroke(name):
    laws = [("constant", "a", "b"), ("polytropic", "b", "c"), ("rounded", "c", "z"), ("polytropic", "z", "d"),
            ("rounded", "d", "e"), ("constant", "e", "f")]  # fmt: skip
    text = FOUR_STROKE.format(points=f"[{name}.points]")
    for law, start, end in laws:
        text += f'[[{name}.pieces]]\nlaw = "{law}"\npoints = ["{start}", "{end}"]\n'
        text += "exponent = 1.3\n" if law == "polytropic" else ""
    return text


def test_two_turns_of_a_linkage_are_those_of_an_engine():
    """The chain of the textbooks, from the piston to the crank, knows nothing of chambers, loads or guides."""
    engine = crankwork.read_machine(f"""
        crank = {{ radius = "45 mm", speed = "3000 rpm" }}
        rod.length = "160 mm"
        cylinder = {{ bore = "86 mm", compression_ratio = 9 }}
        [gas]
        cycle = "720 deg"
        {four_stroke("gas")}
    """)
    linkage = crankwork.read_machine(f"""
        fixed_points.O = ["0 mm", "0 mm"]
        crank = {{ pivot = "O", pin = "A", radius = "45 mm", speed = "3000 rpm" }}
        links.rod = {{ joins = ["A", "B"], length = "160 mm" }}
        guides.bore.through = "O"
        sliders.piston = {{ guide = "bore", pin = "B" }}
        [chambers.cylinder]
        slider = "piston"
        bore = "86 mm"
        sense = -1
        compression_ratio = 9
        period = "720 deg"
        {four_stroke("chambers.cylinder")}
        [flywheel]
        fluctuation = 0.02
    """)
    grid = CrankGrid.from_degrees(np.concatenate([ANGLES, 360 + ANGLES[1:], [720.0]]))
    one, other = crankwork.analyse(engine, grid), crankwork.analyse(linkage, grid)
    assert other["gas_force.cylinder"] == pytest.approx(-one["gas_force"], rel=1e-12)
    assert -other["balancing_torque"] == pytest.approx(one["crank_torque"], rel=1e-10, abs=1e-9)
    assert other["mean_torque"] == pytest.approx(one["mean_torque"], rel=1e-12)
    for key in ("indicated_work", "indicated_mean_pressure", "indicated_power"):
        assert other[f"{key}.cylinder"] == pytest.approx(one[key], rel=1e-12)
    assert other["gas_pressure_max_angle.cylinder"] == pytest.approx(one["gas_pressure_max_angle"], abs=1e-9)
    assert not other.unmet
    turning = one.columns_at(np.arange(0, 720, 0.05))["crank_torque"]
    excess = np.cumsum(turning - turning.mean()) * math.radians(0.05)
    assert other["excess_work"] == pytest.approx(np.ptp(excess), rel=1e-3)
    assert other.value("crank_speed", 500.0) > 0
    assert other.value("work_per_cycle") == pytest.approx(one["indicated_work"], rel=1e-10)


GEARED = """
    fixed_points = {{ O = ["0 mm", "0 mm"], Q = ["120 mm", "0 mm"] }}
    crank = {{ pivot = "O", pin = "A", radius = "20 mm", speed = "600 rpm" }}
    geared.half = {{ pivot = "Q", ratio = -0.5, points.D = ["25 mm", "0 mm"] }}
    guides.bore = {{ through = ["60 mm", "0 mm"], angle = "90 deg" }}
    sliders.piston = {{ guide = "bore", pin = "B" }}
    positions = {{ C = ["70 mm", "70 mm"], B = ["60 mm", "180 mm"] }}
    [links]
    a = {{ joins = ["A", "C"], length = "90 mm" }}
    b = {{ joins = ["D", "C"], length = "95 mm" }}
    rod = {{ joins = ["C", "B"], length = "120 mm" }}
    [chambers.room]
    slider = "piston"
    bore = "86 mm"
    sense = -1
    compression_ratio = 9
    pressures = "absolute"
    period = "{period} deg"
    [chambers.room.points]
    {points}
"""


def test_laws_over_one_turn_begin_anew_in_each_of_two():
    """Stated for both turns one after the other they give the same; there the gas does what its torque does."""
    points, laws = {1: "", 2: ""}, {1: "", 2: ""}
    for turn in (0, 1):
        for name, angle, pressure in (("a", 0, ', pressure = "0.1 MPa"'), ("b", 130, ""), ("c", 240, "")):
            points[2] += f'{name}{turn} = {{ angle = "{angle + 360 * turn} deg"{pressure} }}\n'
        pairs = [("polytropic", "a", "b", turn), ("polytropic", "b", "c", turn), ("rounded", "c", "a", turn + 1)]
        for law, start, end, after in pairs:
            exponent = "exponent = 1.35\n" if law == "polytropic" else ""
            laws[2] += (
                f'[[chambers.room.pieces]]\nlaw = "{law}"\npoints = ["{start}{turn}", "{end}{after}"]\n{exponent}'
            )
        if turn == 0:
            points[1], laws[1] = points[2] + 'a1 = { angle = "360 deg", pressure = "0.1 MPa" }\n', laws[2]
    points[2] += 'a2 = { angle = "720 deg", pressure = "0.1 MPa" }\n'
    once, twice = (
        crankwork.analyse(crankwork.read_machine(GEARED.format(period=360 * turns, points=points[turns]) + laws[turns]))
        for turns in (1, 2)
    )
    assert [one.values["turns"] for one in once.notices if one.code == "chamber_again"] == [2]
    assert not [one for one in twice.notices if one.code == "chamber_again"]
    rows = once.columns_at([100.0, 460.0], ["gas_pressure.room", "cylinder_volume.room"])
    assert abs(np.diff(rows["cylinder_volume.room"])[0]) > 0.01 * once["swept_volume.room"]
    for key in ("gas_pressure.room", "gas_force.room", "balancing_torque"):
        assert once[key] == pytest.approx(twice[key], rel=1e-12, abs=1e-12)
    for key in ("indicated_work.room", "indicated_power.room", "swept_volume.room"):
        assert once[key] == pytest.approx(twice[key], rel=1e-12)
    assert not once.unmet
    assert once.checks["work"] < 1e-9


class TestMeasured:
    """Samples of a smooth pressure beside a slider that moves as a cosine."""

    FILE = """
        fixed_points.O = ["0 mm", "0 mm"]
        crank = {{ pivot = "O", pin = "A", radius = "40 mm", speed = "600 rpm" }}
        guides = {{ bed = {{ through = "O" }}, slot = {{ link = "yoke", angle = "90 deg" }} }}
        sliders = {{ yoke = {{ guide = "bed" }}, block = {{ pin = "A", guide = "slot" }} }}
        [chambers.gas]
        slider = "yoke"
        area = "20 cm2"
        measured = {{ file = "{file}", pressure_unit = "bar", shift = "0 deg" }}
    """

    def read(self, folder, step):
        """Return the machine whose pressure leads its volume by a quarter of a turn, 3 and 1 bar around 4 bar."""
        angles = np.arange(0.0, 360.0 + step / 2, step)
        rows = [f"{one:g};{4 - 3 * math.sin(math.radians(one)) + math.cos(math.radians(one)):.12g}" for one in angles]
        (folder / "samples.csv").write_text("angle;p\n" + "\n".join(rows) + "\n", encoding="utf-8")
        return crankwork.read_machine(self.FILE.format(file="samples.csv"), folder=folder)

    def test_samples_do_the_work_of_their_curve(self, tmp_path):
        results = crankwork.analyse(self.read(tmp_path, 1.0), CrankGrid.from_degrees(ANGLES))
        assert results["gas_pressure.gas"][[0, 1, 3, 4]] == pytest.approx(
            1e5 * (4 - 3 * np.sin(np.radians(ANGLES)) + np.cos(np.radians(ANGLES)))[[0, 1, 3, 4]], rel=1e-9
        )
        # the integral of -3 sin by the volume, whose rate is -sin: 3 pi times half the stroke times the area
        assert results["indicated_work.gas"] == pytest.approx(3e5 * math.pi * 0.04 * 20e-4, rel=1e-5)
        assert results["cylinder_volume.gas"].min() >= 0
        assert not results.unmet

    def test_a_mistake_in_the_file_names_the_chamber(self, tmp_path):
        (tmp_path / "samples.csv").write_text("angle;p\n0;1\n10;x\n", encoding="utf-8")
        with pytest.raises(crankwork.InputError, match=r"chambers\.gas\.measured\.file.*samples\.csv"):
            crankwork.read_machine(self.FILE.format(file="samples.csv"), folder=tmp_path)
        (tmp_path / "samples.csv").write_text("angle;p\n0;1\n10;2\n", encoding="utf-8")
        with pytest.raises(crankwork.InputError, match=r"chambers\.gas\.measured: samples\.csv, only 2 samples"):
            crankwork.read_machine(self.FILE.format(file="samples.csv"), folder=tmp_path)


def test_a_cylinder_needs_a_clearance_only_where_its_pressure_follows_from_the_volume():
    text = """
        crank = { radius = "300 mm", speed = "250 rpm" }
        rod.length = "1.2 m"
        cylinder.bore = "0.5 m"
        [gas]
        cycle = "360 deg"
        [gas.points]
        start = { angle = "0 deg", pressure = "0.35 MPa" }
        cut = { stroke = 0.5 }
        low = { stroke = 0.5, pressure = "0.05 MPa" }
        end = { angle = "360 deg", pressure = "0.35 MPa" }
        [[gas.pieces]]
        law = "constant"
        points = ["start", "cut"]
        [[gas.pieces]]
        law = "constant"
        points = ["low", "end"]
    """
    results = crankwork.analyse(crankwork.read_machine(text))
    assert results["indicated_work"] == pytest.approx(0.3e6 * math.pi * 0.5**2 / 4 * 0.3, rel=1e-12)
    assert results.value("cylinder_volume", 0.0) == 0
    assert not results.unmet
    with pytest.raises(crankwork.InputError, match="cylinder: gas needs its smallest volume"):
        crankwork.read_machine(text.replace('"constant"', '"polytropic"\n        exponent = 1.2', 1))


ISOTHERMAL = """
format = 2
[fixed_points]
O = ["0 cm", "0 cm"]
[crank]
pivot = "O"
pin = "A"
radius = "25 cm"
speed = "300 rpm"
[links]
rod = {{ joins = ["A", "B"], length = "100 cm" }}
[guides]
bed = {{ through = "O", angle = "180 deg" }}
[sliders]
piston = {{ guide = "bed", pin = "B" }}
[positions]
B = ["{x} cm", "0 cm"]
[chambers.gas]
slider = "piston"
bore = "40 cm"
sense = {sense}
clearance_volume = "{clearance} cm3"
pressures = "absolute"
ambient = "1 bar"
valves = {{ suction = "1 bar", discharge = "7.5 bar", compression_exponent = 1.0 }}
"""


@pytest.mark.parametrize("clearance", ["0", "1e-6", "1e-4"])
@pytest.mark.parametrize(("x", "sense"), [(125, -1), (125, 1), (-125, -1)])
def test_a_compressor_with_hardly_a_clearance_takes_the_isothermal_work(clearance, x, sense):
    results = crankwork.analyse(crankwork.read_machine(ISOTHERMAL.format(clearance=clearance, x=x, sense=sense)))
    swept = math.pi / 4 * 0.4**2 * 0.5
    # the clearance gives back 6.5 times its share of the stroke at most
    assert results["indicated_work.gas"] == pytest.approx(-1e5 * swept * math.log(7.5), rel=2e-8)


def test_a_clearance_that_is_none_is_blamed_itself():
    with pytest.raises(crankwork.InputError, match=r"chambers\.gas\.clearance_volume: .* the volume is zero"):
        crankwork.analyse(crankwork.read_machine(ISOTHERMAL.format(clearance="1e-9", x=125, sense=-1)))
