"""Chambers against volumes by hand, Schmidt's closed form, and quadrature of scipy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

from crankwork.dynamics.reduction import reduced_torque
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_mechanism, traced_motion
from crankwork.loads.chamber import Chamber, Charge, DeadVolume, Face
from crankwork.loads.chamber_gas import solve_chambers
from crankwork.loads.indicator import DiagramError, DiagramPoint, Piece
from crankwork.mechanism.dyads import RPP, RPR, RRP, Guide
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, slider_crank
from each import for_each

pytestmark = pytest.mark.elsewhere

TURN = CrankGrid.steps(1.0, 360.0)
ANGLES = np.array([0.0, 10.0, 77.0, 180.0, 200.5, 359.0])
GRID = CrankGrid.from_degrees(ANGLES)
BORE, ROD, RADIUS, LENGTH = 0.3, 0.05, 0.225, 1.2
AREA, LESS = math.pi * BORE**2 / 4, math.pi * ROD**2 / 4


def fill(mechanism, chambers, charges=None):
    return solve_chambers(chambers, charges or {}, traced_motion(mechanism, linkage_motion(mechanism, TURN)), math.pi)


def columns(filling, grid=GRID):
    return Program(filling.columns)(grid)


def single(filling, key):
    return filling.singles[key].value


def piston(degrees):
    """Return the way of the piston of the crank gear from top dead centre, by hand. [m]"""
    phi = np.radians(degrees)
    return RADIUS * (1 - np.cos(phi)) + LENGTH * (1 - np.sqrt(1 - (RADIUS / LENGTH * np.sin(phi)) ** 2))


STEAM = {
    "a": DiagramPoint(stroke=0.0, pressure=8e5), "b": DiagramPoint(stroke=0.4), "c": DiagramPoint(stroke=1.0),
    "d": DiagramPoint(stroke=1.0, pressure=1.2e5), "e": DiagramPoint(stroke=0.0, pressure=8e5),
}  # fmt: skip
LAWS = (Piece("constant", ("a", "b")), Piece("polytropic", ("b", "c"), 1.1), Piece("constant", ("d", "e")))


def test_a_diagram_may_come_later_and_its_pressure_be_greater():
    # the axis of the cylinder is turned by as much as its diagram comes later
    later, around = 130.0, 1e5
    points = {
        "a": DiagramPoint(0.0, 9e5), "b": DiagramPoint(40.0), "c": DiagramPoint(stroke=1.0),
        "d": DiagramPoint(stroke=1.0, pressure=around), "e": DiagramPoint(stroke=0.0, pressure=9e5),
    }  # fmt: skip
    gear = slider_crank(RADIUS, LENGTH)
    crank = replace(gear.crank, start=math.pi / 2 + math.radians(later))
    face = (Face("piston_pin", BORE, sense=-1),)
    chamber = Chamber(face, 2e-3, ambient=around, points=points, pieces=LAWS, delay=later, factor=1.1)
    found = fill(replace(gear, driver=crank), {"one": chamber})
    own = (ANGLES - later) % 360
    volume, burnt = (2e-3 + AREA * piston(at) for at in (own, 40.0))
    pressure = np.select([own <= 40, own <= 180], [9e5, 9e5 * (burnt / volume) ** 1.1], around)
    assert columns(found)["cylinder_volume.one"] == pytest.approx(volume, rel=1e-12)
    assert columns(found)["diagram_pressure.one"] == pytest.approx(pressure, rel=1e-12)
    assert columns(found)["gas_pressure.one"] == pytest.approx(1.1 * (pressure - around), rel=1e-12)
    least, largest = 2e-3, 2e-3 + AREA * 2 * RADIUS
    done = 9e5 * (burnt - least) + 9e5 * burnt / 0.1 * (1 - (burnt / largest) ** 0.1) - around * (largest - least)
    assert single(found, "indicated_work.one") == pytest.approx(1.1 * done, rel=1e-12)


@pytest.fixture(scope="module")
def steam():
    head = Chamber((Face("piston_pin", BORE, sense=-1),), 2e-3, ambient=1e5, points=STEAM, pieces=LAWS)
    crank = Chamber((Face("piston_pin", BORE, ROD),), compression_ratio=12.0, pressure=3e5, ambient=1e5)
    return fill(slider_crank(RADIUS, LENGTH), {"head": head, "crank": crank})


class TestDoubleActing:
    """The displacement of the catalogue's slider falls from r + l, so that the head end has the sense -1."""

    def test_volumes_are_those_by_hand(self, steam):
        found, way = columns(steam), piston(ANGLES)
        assert found["cylinder_volume.head"] == pytest.approx(2e-3 + AREA * way, rel=1e-13)
        swept = (AREA - LESS) * 2 * RADIUS
        assert single(steam, "swept_volume.crank") == pytest.approx(swept, rel=1e-13)
        assert single(steam, "clearance_volume.crank") == pytest.approx(swept / 11, rel=1e-13)
        expected = swept / 11 + (AREA - LESS) * (2 * RADIUS - way)
        assert found["cylinder_volume.crank"] == pytest.approx(expected, rel=1e-13)
        assert single(steam, "compression_ratio.head") == pytest.approx(1 + AREA * 0.45 / 2e-3, rel=1e-13)

    def test_the_diagram_is_the_one_of_the_strokes(self, steam):
        cut_off = brentq(lambda degrees: piston(degrees) - 0.18, 1, 179, xtol=1e-13)
        at = np.array([0.5 * cut_off, 0.5 * cut_off + 90, 200.0])
        admitted = 2e-3 + AREA * 0.18
        expanded = 8e5 * (admitted / (2e-3 + AREA * piston(at[1]))) ** 1.1
        found = columns(steam, CrankGrid.from_degrees(at))
        assert found["diagram_pressure.head"] == pytest.approx([8e5, expanded, 1.2e5], rel=1e-13)
        assert found["gas_pressure.head"] == pytest.approx([7e5, expanded - 1e5, 0.2e5], rel=1e-12)
        ends = admitted, 2e-3 + AREA * 0.45
        work = 8e5 * AREA * 0.18 + 8e5 * ends[0] * (1 - (ends[0] / ends[1]) ** 0.1) / 0.1 - 1.2e5 * AREA * 0.45
        assert single(steam, "indicated_work.head") == pytest.approx(work, rel=1e-13)
        assert single(steam, "indicated_mean_pressure.head") == pytest.approx(work / (AREA * 0.45), rel=1e-13)
        assert single(steam, "indicated_work.crank") == 0
        (notice,) = steam.notices
        assert notice == ("jump", {"point": "e", "angle": 360.0, "step": pytest.approx(6.8e5)})

    def test_both_faces_push_against_each_other(self, steam):
        found = columns(steam, CrankGrid.from_degrees([20.0]))
        assert found["gas_force.head"] == pytest.approx([-7e5 * AREA], rel=1e-13)
        assert found["gas_force.crank"] == pytest.approx([2e5 * (AREA - LESS)], rel=1e-13)
        mechanism = slider_crank(RADIUS, LENGTH)
        motion = linkage_motion(mechanism, CrankGrid.from_degrees([20.0]))
        torque = reduced_torque(motion, steam.loads(mechanism, motion))
        force = 7e5 * AREA - 2e5 * (AREA - LESS)
        slope = (piston(20.01) - piston(19.99)) / math.radians(0.02)
        assert torque == pytest.approx([force * slope], rel=1e-7)

    def test_remembered_loads_are_those_in_numbers(self, steam):
        mechanism = slider_crank(RADIUS, LENGTH)
        motion = linkage_motion(mechanism, GRID)
        knowns = traced_motion(mechanism, linkage_motion(mechanism, TURN))
        traced = steam.loads(traced_mechanism(mechanism), knowns).forces
        assert [one.x.key for one in traced] == ["load_x.piston_pin.head", "load_x.piston_pin.crank"]
        for one, other in zip(traced, steam.loads(mechanism, motion).forces, strict=True):
            assert Program({"": one.x})(GRID)[""] == pytest.approx(other.x, rel=1e-14)

    def test_a_shorter_period_is_passed_twice(self):
        points = {"a": DiagramPoint(0.0, 1e5), "m": DiagramPoint(360.0, 4e5), "b": DiagramPoint(720.0, 1e5)}
        gas = Chamber((Face("piston_pin", BORE, sense=-1),), 2e-3, cycle=720.0, points=points,
                      pieces=(Piece("rounded", ("a", "m", "b")),))  # fmt: skip
        turned = {**STEAM, "a": DiagramPoint(0.0, 8e5), "b": DiagramPoint(90.0), "c": DiagramPoint(180.0),
                  "d": DiagramPoint(180.0, 1.2e5), "e": DiagramPoint(360.0, 8e5)}  # fmt: skip
        steam = Chamber((Face("piston_pin", area=0.01),), 1e-3, points=turned, pieces=LAWS)
        filling = fill(slider_crank(RADIUS, LENGTH), {"gas": gas, "steam": steam})
        once, again = (columns(filling, CrankGrid.from_degrees(ANGLES + one)) for one in (0.5, 360.5))
        assert once["diagram_pressure.steam"] == pytest.approx(again["diagram_pressure.steam"], rel=1e-13)
        assert once["diagram_pressure.gas"][1] != pytest.approx(again["diagram_pressure.gas"][1], rel=0.1)


# beta: the displacer leads the piston by 60 degrees on one shaft, and they sweep part of the cylinder in common
STROKES, PHASE, AREAS = (0.06, 0.05), math.radians(60), (2e-3, 2e-3)
HOT, COLD, BETWEEN = 900.0, 320.0, 560.0
DEAD = {"hot": 20e-6, "cold": 15e-6, "between": 30e-6}


def beta(displacer, power):
    """Return chambers and charge of a beta machine; pieces move along +x towards the hot head."""
    hot = Chamber((Face(displacer, area=AREAS[0], sense=-1),), DEAD["hot"], ambient=1e6, temperature=HOT)
    cold = Chamber((Face(displacer, area=AREAS[0]), Face(power, area=AREAS[1], sense=-1)), DEAD["cold"], ambient=1e6,
                   temperature=COLD)  # fmt: skip
    charge = Charge(("hot", "cold"), (DeadVolume(DEAD["between"], BETWEEN),), mean_pressure=1e6, gas_constant=2077.0)
    return {"hot": hot, "cold": cold}, {"helium": charge}


def yokes():
    a, b = STROKES[0] / 2, STROKES[1] / 2
    first = RPP("crank_pin", "displacer", "block", Guide(angle=math.pi / 2))
    second = RPP("power_pin", "power", "power_block", Guide(angle=math.pi / 2))
    throw = LinkPoint("power_pin", "crank", b * math.cos(-PHASE), b * math.sin(-PHASE))
    return Mechanism(Crank(a), (first, second), points=(throw,))


class Schmidt:
    """The closed form: volumes over temperatures are Z (1 + c cos(phi - theta))."""

    def __init__(self):
        swept_hot, swept_cold = STROKES[0] * AREAS[0], STROKES[1] * AREAS[1]
        self.swept = swept_hot, swept_cold
        x, y = swept_hot / 2 - swept_cold / 2 * math.cos(PHASE), -swept_cold / 2 * math.sin(PHASE)
        # the cold space would be between (V_E + V_C) / 2 less and more than hypot(x, y): strokes overlap by the rest
        self.overlap = (swept_hot + swept_cold) / 2 - math.hypot(x, y)
        middle = (swept_hot / 2 + DEAD["hot"]) / HOT + DEAD["between"] / BETWEEN
        middle += ((swept_hot + swept_cold) / 2 + DEAD["cold"] - self.overlap) / COLD
        across = x / COLD - swept_hot / 2 / HOT, y / COLD
        self.share = math.hypot(*across) / middle
        self.angle = math.atan2(across[1], across[0])
        root = math.sqrt(1 - self.share**2)
        self.root, self.mass = root, 1e6 * middle * root / 2077.0
        works = -1e6 * math.pi * self.share / (1 + root)
        self.hot = works * swept_hot * math.sin(self.angle)

    def pressure(self, degrees):
        return 1e6 * self.root / (1 + self.share * np.cos(np.radians(degrees) - self.angle))


class TestStirling:
    def test_on_scotch_yokes_it_is_the_closed_form_of_schmidt(self):
        filling, schmidt = fill(yokes(), *beta("displacer", "power")), Schmidt()
        found = columns(filling)
        for name in ("hot", "cold"):
            assert found[f"diagram_pressure.{name}"] == pytest.approx(schmidt.pressure(ANGLES), rel=1e-12)
        assert single(filling, "gas_mass.helium") == pytest.approx(schmidt.mass, rel=1e-12)
        assert single(filling, "indicated_work.hot") == pytest.approx(schmidt.hot, rel=1e-11)
        # by the theorem of Carnot: the heat of each space is its work, and the ratio of both that of temperatures
        works = [single(filling, f"indicated_work.{name}") for name in ("hot", "cold")]
        assert works[1] / works[0] == pytest.approx(-COLD / HOT, rel=1e-11)

    def test_on_cranks_it_is_the_quadrature_of_the_volumes(self):
        """Cranks of other lengths than their yokes would have: nothing is a cosine any more."""
        chambers, charges = beta("displacer", "power")
        filling = fill(cranks(), chambers, charges)

        def way(degrees, radius, length, lag):
            phi = math.radians(degrees) - lag
            return radius * math.cos(phi) + math.sqrt(length**2 - (radius * math.sin(phi)) ** 2)

        def moved(degrees):
            return way(degrees, STROKES[0] / 2, 0.2, 0.0), way(degrees, STROKES[1] / 2, 0.11, PHASE)

        def cold(degrees):
            one, other = moved(degrees)
            return AREAS[0] * one - AREAS[1] * other

        near = min(range(360), key=cold)
        least = minimize_scalar(cold, bounds=(near - 1, near + 1), method="bounded", options={"xatol": 1e-9}).fun
        top = STROKES[0] / 2 + 0.2

        def volumes(degrees):
            return DEAD["hot"] + AREAS[0] * (top - moved(degrees)[0]), DEAD["cold"] + cold(degrees) - least

        def reduced(degrees):
            one, other = volumes(degrees)
            return one / HOT + other / COLD + DEAD["between"] / BETWEEN

        mean = quad(lambda degrees: 1 / reduced(degrees), 0, 360, epsrel=1e-13, epsabs=0, limit=200)[0] / 360
        expected = [1e6 / mean / reduced(one) for one in ANGLES]
        found = columns(filling)
        assert found["gas_pressure.hot"] == pytest.approx(np.array(expected) - 1e6, rel=1e-8)
        assert found["cylinder_volume.cold"] == pytest.approx([volumes(one)[1] for one in ANGLES], rel=1e-9)

        def power(degrees):
            step = 1e-3
            rate = (volumes(degrees + step)[0] - volumes(degrees - step)[0]) / (2 * step)
            return 1e6 / mean / reduced(degrees) * rate

        work = quad(power, 0, 360, epsabs=1e-9, limit=200)[0]
        assert single(filling, "indicated_work.hot") == pytest.approx(work, rel=1e-7)

    def test_mass_and_pressure_at_an_angle_say_as_much_as_the_mean(self):
        chambers, charges = beta("displacer", "power")
        gas, schmidt = charges["helium"], Schmidt()
        for stated in ({"mass": schmidt.mass}, {"pressure": float(schmidt.pressure(77.0)), "angle": 77.0}):
            charge = Charge(gas.chambers, gas.dead_volumes, gas_constant=2077.0, **stated)
            found = columns(fill(yokes(), chambers, {"helium": charge}))
            assert found["diagram_pressure.cold"] == pytest.approx(schmidt.pressure(ANGLES), rel=1e-12)

    @for_each("stated", [{"pressure": 2e5, "angle": 77.0}, {"mean_pressure": 2e5}])
    def test_a_polytrope_holds_for_all_the_volume(self, stated):
        chambers, _ = beta("displacer", "power")
        found = columns(fill(yokes(), chambers, {"air": Charge(("hot", "cold"), exponent=1.4, **stated)}), TURN)
        volume, pressure = found["cylinder_volume.hot"] + found["cylinder_volume.cold"], found["diagram_pressure.hot"]
        constant = pressure * volume**1.4
        assert constant == pytest.approx(constant[0], rel=1e-12)
        known = np.mean(pressure[:-1]) if "mean_pressure" in stated else pressure[77]
        assert known == pytest.approx(2e5, rel=1e-11)

    def test_chambers_that_are_empty_together_are_refused(self):
        chamber = Chamber((Face("displacer", area=1e-3),), temperature=300.0)
        with pytest.raises(
            DiagramError, match="no volume left at 180 deg; give one of them a clearance_volume"
        ) as told:
            fill(yokes(), {"only": chamber}, {"air": Charge(("only",), mean_pressure=1e5, gas_constant=287.0)})
        assert told.value.key == "charges.air"


def cranks():
    a, b = STROKES[0] / 2, STROKES[1] / 2
    throw = LinkPoint("power_pin", "crank", b * math.cos(-PHASE), b * math.sin(-PHASE))
    dyads = RRP("crank_pin", "displacer", "rod", 0.2), RRP("power_pin", "power", "power_rod", 0.11)
    return Mechanism(Crank(a), dyads, points=(throw,))


class TestOscillatingCylinder:
    """The cylinder swings about a fixed point and carries the guide: the gas pushes on it as well."""

    def test_the_gas_does_its_work_on_the_crank(self):
        radius, distance, pressure = 0.04, 0.15, 5e5
        lever = RPR("crank_pin", "pivot", "cylinder", "piston")
        mechanism = Mechanism(Crank(radius), (lever,), ground={"pivot": (distance, 0.0)})
        filling = fill(mechanism, {"steam": Chamber((Face("piston", area=1e-3),), pressure=pressure)})
        motion = linkage_motion(mechanism, GRID)
        loads = filling.loads(mechanism, motion)
        assert [one.link for one in loads.forces] == ["piston", "cylinder"]
        phi = np.radians(ANGLES)
        # virtual work: pressure times the rate of the length, by the law of cosines
        length = np.sqrt(radius**2 + distance**2 - 2 * radius * distance * np.cos(phi))
        expected = pressure * 1e-3 * radius * distance * np.sin(phi) / length
        assert reduced_torque(motion, loads) == pytest.approx(expected, abs=1e-12)
        volume = columns(filling)["cylinder_volume.steam"]
        assert volume == pytest.approx(1e-3 * (length - (distance - radius)), abs=1e-18)
