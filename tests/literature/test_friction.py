"""Friction in pins and guides, from machine files.

F. P. Beer, E. R. Johnston: Vector Mechanics for Engineers (Statics), sample problems 8.6, page 423: a pulley on a
shaft, and 8.4, page 411: a wedge. T. Bevan: The Theory of Machines, chapter 6, example 1, page 185: two sliders that
touch obliquely. R. S. Khurmi, J. K. Gupta: Theory of Machines, chapter 7, example 10, page 162: a four-bar linkage.
Printed values were read from the public notebooks of the books' examples,
github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, so they are secondary
to the books. What the exact friction circle gives, and what a wedge does without rounded angles, was computed from the
balance of forces at 40 digits.
The dead band and the jamming guide are closed forms, worked out here.
"""

import functools
import math

import mpmath
import numpy as np
import pytest

from each import for_each
from machine_texts import analysed

LBF, INCH = 4.4482216152605, 0.0254


class TestPulley:
    """500 lbf on a pulley of 2 in radius that turns on a shaft of 1 in, f = 0.2; the rope on the other side is pulled.

    The rims are the ends of a lever; a slider below pulls one down by a rod, passing the position in which lever and
    rod stand square at half of each second.
    """

    file = """
        fixed_points = {{ O = ["0 in", "0 in"], Q = ["2 in", "-10 in"] }}
        driver.slider = "hand"
        driver.start = "0.05 in"
        driver.law = [
            {{ kind = "constant", to = "-0.05 in", over = "1 s" }},
            {{ kind = "constant", to = "0.05 in", over = "1 s" }},
        ]
        links.pulley = {{ joins = ["O", "B"], length = "2 in", points = {{ A = ["-2 in", "0 in"] }} }}
        links.rope = {{ joins = ["B", "C"], length = "10 in" }}
        guides.rail = {{ through = "Q", angle = "90 deg" }}
        sliders.hand = {{ guide = "rail", pin = "C" }}
        positions.B = ["2 in", "0 in"]
        loads = [{{ kind = "force", point = "A", y = "-500 lbf" }}]
        friction = {{ circle = "{circle}", pins.O = {{ coefficient = 0.2, radius = "1 in" }} }}
    """

    @for_each(("circle", "rises", "held"), [("tangent", 611.11111, 409.09091), ("sine", 608.7188255, 410.6986502)])
    def test_pull(self, circle: str, rises: float, held: float) -> None:
        results = analysed(self.file.format(circle=circle))
        pull = [-results.value("driver_force_with_friction", at=one) / LBF for one in (0.5, 1.5)]
        assert pull == pytest.approx([rises, held], rel=1e-8)
        assert -results.value("driver_force", at=0.5) / LBF == pytest.approx(500)

    def test_as_printed(self) -> None:
        results = analysed(self.file.format(circle="tangent"))
        pull = [-results.value("driver_force_with_friction", at=one) / LBF for one in (0.5, 1.5)]
        assert pull == pytest.approx([611, 409], abs=0.5)


WEDGE = """
    fixed_points.O = ["0 mm", "0 mm"]
    driver.slider = "wedge"
    driver.start = "-10 mm"
    driver.law = [
        {{ kind = "constant", to = "10 mm", over = "1 s" }},
        {{ kind = "constant", to = "-10 mm", over = "1 s" }},
    ]
    guides.floor = {{ through = "O", angle = "0 deg" }}
    guides.wall = {{ through = "O", angle = "{wall} deg" }}
    guides.face = {{ link = "wedge", angle = "{face} deg" }}
    sliders.wedge = {{ guide = "floor" }}
    sliders.touching = {{ guide = "face", pin = "P" }}
    sliders.block = {{ guide = "wall", pin = "P" }}
    positions.P = ["0 mm", "0 mm"]
    loads = [{{ kind = "force", point = "P", link = "block", x = "{x!r} N", y = "{y!r} N" }}]
    friction.sliders.wedge = {{ coefficient = {guides} }}
    friction.sliders.touching = {{ coefficient = {faces} }}
    friction.sliders.block = {{ coefficient = {guides} }}
"""


def test_a_wedge_raises_and_lowers_a_block() -> None:
    """400 lbf on a wedge of 8 degrees, f = 0.35 on all faces; it holds the block, and is pulled out."""
    weight = 400 * LBF
    results = analysed(WEDGE.format(wall=90, face=172, x=0.0, y=-weight, guides=0.35, faces=0.35))
    push = [results.value("driver_force_with_friction", at=one) / LBF for one in (0.5, 1.5)]
    assert push == pytest.approx([422.6938527689351, -205.4968080351542], rel=1e-12)
    assert push == pytest.approx([423, -206], rel=0.003)


def test_the_best_angle_of_two_sliders_that_touch_obliquely() -> None:
    """Guides at 60 degrees, f = 0.1 on both and 0.15 between the sliders."""
    theta, psi = math.radians(60), math.atan(0.15) + math.atan(0.1)
    best = (theta + psi) / 2

    def efficiency(alpha: float) -> float:
        # the normal of the face stands at alpha to the first guide
        load = (-math.cos(theta), -math.sin(theta))
        file = WEDGE.format(wall=60, face=math.degrees(alpha) + 90, x=load[0], y=load[1], guides=0.1, faces=0.15)
        results = analysed(file)
        return results.value("driver_force", at=0.5) / results.value("driver_force_with_friction", at=0.5)

    assert efficiency(best) == pytest.approx(0.7490126464905879, rel=1e-12)
    assert math.degrees(best) == pytest.approx(37.12, abs=0.005)
    assert efficiency(best) > max(efficiency(best - 0.01), efficiency(best + 0.01))


def test_a_four_bar_linkage_of_70_per_cent() -> None:
    """A crank of 300 mm with 50 N m turns a rocker of 360 mm; the crank at 60 degrees to the ground of 600 mm."""
    results = analysed("""
        fixed_points = { D = ["0 mm", "0 mm"], C = ["600 mm", "0 mm"] }
        crank = { pivot = "D", pin = "A", radius = "300 mm", speed = "100 rpm" }
        links.coupler = { joins = ["A", "B"], length = "360 mm" }
        links.rocker = { joins = ["C", "B"], length = "360 mm" }
        positions.B = ["500 mm", "350 mm"]
        loads = [{ kind = "torque", link = "rocker", torque = ["-58.14636704042652 N*m"] }]
        efficiency.chain = [0.7]
    """)
    assert abs(results.value("link_angular_velocity.rocker", at=60.0)) == pytest.approx(6.303388527506544)
    torque = abs(results.value("driving_torque", at=60.0))
    assert torque == pytest.approx(50)
    # read off a drawing
    assert 58.14636704042652 * 50 / torque == pytest.approx(58.6, rel=0.05)


class TestJammingGuide:
    """A piece of length L on a guide, pushed at a distance a from it: it presses on both its ends.

    Each end presses with P a / L, so that 2 f P a / L of the push P is lost: F = P (1 - 2 f a / L) arrives, and where
    2 f a >= L no push moves the piece. Where F drives it instead, the push is held back with F = P (1 + 2 f a / L);
    beyond L = 2 f a also with the other sign, pulling at the ends that press. The push comes through a slot across the
    guide, at the height of the crank pin.
    """

    file = """
        fixed_points.O = ["0 mm", "0 mm"]
        crank = {{ pivot = "O", pin = "A", radius = "100 mm", speed = "60 rpm" }}
        guides = {{ slot = {{ link = "yoke", angle = "90 deg" }}, bed = {{ through = "O", angle = "0 deg" }} }}
        sliders = {{ block = {{ guide = "slot", pin = "A" }}, yoke = {{ guide = "bed" }} }}
        loads = [{{ kind = "process", slider = "yoke", force = ["100 N"], stroke = "growing", acts = "both" }}]
        friction.sliders.yoke = {{ coefficient = 0.6, length = "{length} mm" }}
    """

    def test_the_push_that_moves_it(self) -> None:
        results = analysed(self.file.format(length=200))
        for degrees in (200.0, 270.0, 300.0):
            arm = 0.1 * abs(math.sin(math.radians(degrees)))
            push = 100 / (1 - 2 * 0.6 * arm / 0.2)
            assert abs(results.value("normal_force_with_friction.block", at=degrees)) == pytest.approx(push)
            assert results.value("torque_with_friction", at=degrees) == pytest.approx(push * arm)
            assert results.value("instantaneous_efficiency", at=degrees) == pytest.approx(100 / push)
            lost = results.value("friction_power", at=degrees)
            assert lost == pytest.approx((push - 100) * arm * 2 * math.pi)

    def test_the_load_drives_with_what_friction_leaves(self) -> None:
        results = analysed(self.file.format(length=200))
        push = 100 / (1 + 2 * 0.6 * 0.1 / 0.2)
        assert results.value("torque_with_friction", at=90.0) == pytest.approx(-0.1 * push)
        assert results.value("instantaneous_efficiency", at=90.0) == pytest.approx(push / 100)

    def test_it_jams_where_the_arm_is_too_long(self) -> None:
        results = analysed(self.file.format(length=100))
        half = math.degrees(math.asin(100 / 120))
        (jams,) = (one.values for one in results.notices if one.code == "self_locking")
        assert (jams["from"], jams["to"]) == pytest.approx((180 + half, 360 - half), abs=math.degrees(1e-9))
        assert math.isnan(results.columns_at([270.0])["torque_with_friction"][0])
        assert "mean_friction_power" not in results.summary

    def test_where_it_jams_the_load_is_held_in_two_ways(self) -> None:
        results = analysed(self.file.format(length=100))
        half = math.degrees(math.asin(100 / 120))
        (told,) = (one.values for one in results.notices if one.code == "two_balances")
        assert (told["from"], told["to"]) == pytest.approx((half, 180 - half), abs=math.degrees(1e-9))
        assert results.value("torque_with_friction", at=90.0) == pytest.approx(-10 / 2.2)


class TestDeadBand:
    """A piston that pushes a crank over its dead positions with friction circles in all three pins.

    The force in the rod touches the circles of both its pins: sin gamma = (rho_A + rho_B) / l against its axis where
    the rod swings back over the outer dead position, (rho_A - rho_B) / l over the inner one. The piston turns the
    crank only where that line passes the main bearing beyond its friction circle: r sin(phi + beta - gamma) - rho_A =
    rho_O at the ends.
    """

    r, length, radii, f = 0.1, 0.3, {"O": 0.03, "A": 0.025, "B": 0.02}, 0.12

    @functools.cached_property
    def results(self):
        return analysed("""
        fixed_points.O = ["0 mm", "0 mm"]
        crank = { pivot = "O", pin = "A", radius = "100 mm", speed = "60 rpm" }
        links.rod = { joins = ["A", "B"], length = "300 mm" }
        guides.bed = { through = "O", angle = "0 deg" }
        sliders.piston = { pin = "B", guide = "bed" }
        loads = [{ kind = "force", point = "B", link = "piston", x = "-1 kN" }]
        friction.circle = "sine"
        friction.pins.O = { coefficient = 0.12, radius = "30 mm" }
        friction.pins.A = { coefficient = 0.12, radius = "25 mm" }
        friction.pins.B = { coefficient = 0.12, radius = "20 mm" }
    """)

    def end(self, sign: int, start: float) -> float:
        """Return where the line touches the circle of the main bearing. [rad]"""
        with mpmath.workdps(40):
            sine = mpmath.sin(mpmath.atan(mpmath.mpf("0.12")))
            at = {name: sine * mpmath.mpf(str(one)) for name, one in self.radii.items()}
            r, length = mpmath.mpf("0.1"), mpmath.mpf("0.3")
            gamma = mpmath.asin((at["A"] + sign * at["B"]) / length)

            def beyond(phi: mpmath.mpf) -> mpmath.mpf:
                beta = mpmath.asin(r * mpmath.sin(phi) / length)
                return r * mpmath.sin(phi + beta - gamma) - at["A"] - at["O"]

            return float(mpmath.findroot(beyond, mpmath.mpf(start)))

    def test_its_ends(self) -> None:
        held = sorted(
            (one.values["from"], one.values["to"]) for one in self.results.notices if one.code == "friction_holds"
        )
        ends = np.radians(held)
        assert ends[0] == pytest.approx([0.0, self.end(1, 0.1)], abs=1e-9)
        assert ends[1] == pytest.approx([self.end(-1, 3.0), math.pi], abs=1e-9)

    def test_the_force_beyond_touches_all_three_circles(self) -> None:
        # moment of the force in the rod about the main bearing, at 60 degrees
        sine, phi = math.sin(math.atan(0.12)), math.radians(60)
        at = {name: sine * one for name, one in self.radii.items()}
        beta, gamma = math.asin(math.sin(phi) / 3), math.asin((at["A"] + at["B"]) / 0.3)
        force = 1000 / math.cos(beta - gamma)
        torque = force * (0.1 * math.sin(phi + beta - gamma) - at["A"] - at["O"])
        assert self.results.value("joint_force_with_friction.A", at=60.0) == pytest.approx(force)
        assert self.results.value("torque_with_friction", at=60.0) == pytest.approx(-torque)


class TestDrags:
    """A flywheel on two bearings with a constant drag and one with the speed, and a piece pushed along its guide."""

    results = analysed("""
        fixed_points.O = ["0 mm", "0 mm"]
        crank = { pivot = "O", pin = "A", radius = "100 mm", speed = "10 rad/s" }
        guides = { slot = { link = "yoke", angle = "90 deg" }, bed = { through = "O", angle = "0 deg" } }
        sliders = { block = { guide = "slot", pin = "A" }, yoke = { guide = "bed" } }
        friction.pins.O = { moment = "2 N*m", damping = "0.3 N*m*s/rad" }
        friction.sliders.yoke = { force = "20 N", damping = "50 N*s/m" }
    """)

    def test_torque_and_losses(self) -> None:
        # the yoke moves with 1 m/s sin phi
        sin = math.sin(math.radians(30.0))
        assert self.results.value("friction_torque.O", at=30.0) == pytest.approx(-5.0)
        assert self.results.value("friction_force.yoke", at=30.0) == pytest.approx(20 + 50 * sin)
        assert self.results.value("torque_with_friction", at=30.0) == pytest.approx(5 + (20 + 50 * sin) * 0.1 * sin)
        mean = 50 + 20 * 2 / math.pi + 50 / 2
        assert self.results.summary["mean_friction_power"] == pytest.approx(mean, rel=1e-12)
