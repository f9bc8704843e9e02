"""Articulated rods against thirty digits, against the plain slider-crank, virtual work and statics of rigid rods."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from crankwork.cylinders.arrangement import radial
from crankwork.cylinders.articulated import (
    ArticulatedRod,
    articulated_forces,
    articulated_motion,
    articulated_stroke,
    check_articulated_rod,
)
from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank
from each import for_each
from engines import cylinder_angle

pytestmark = pytest.mark.elsewhere

# About the size of a nine-cylinder aircraft engine.
MASTER = SliderCrank(0.0873, 0.349)
KNUCKLE = 0.0683
ANGLES = CrankGrid.from_degrees(np.arange(0.0, 720.0, 7.0))


@st.composite
def geometries(draw):
    """A crank with master and articulated rod that surely turn."""
    r = draw(st.floats(0.01, 0.2))
    l = r * draw(st.floats(2.6, 6.0))  # noqa: E741
    e = r * draw(st.floats(-0.3, 0.3))
    r_a = r * draw(st.floats(0.0, 1.0))
    axis = draw(st.floats(-180, 180))
    rod = ArticulatedRod(
        l - r_a * draw(st.floats(0.3, 1.0)), r_a, axis + draw(st.floats(-12, 12)), axis, r * draw(st.floats(-0.3, 0.3))
    )
    assume(rod.length > r + r_a + abs(rod.offset) + 0.02 * r)
    return SliderCrank(r, l, e), rod


def _distance(lengths, rod, psi):
    """The piston pin from the crankshaft by plain geometry of points, in as many digits as mpmath works with."""
    r, l, e = (mpmath.mpf(one) for one in lengths)  # noqa: E741
    l_a, r_a, knuckle, axis, offset = (mpmath.mpf(one) for one in rod)
    turn = mpmath.pi / 180
    crankpin = r * mpmath.expj(psi + axis * turn)  # in the axes of the master cylinder
    master_pin = mpmath.mpc(crankpin.real + mpmath.sqrt(l**2 - (crankpin.imag - e) ** 2), e)
    along = (master_pin - crankpin) / l
    pin = (crankpin + r_a * along * mpmath.expj(knuckle * turn)) * mpmath.expj(-axis * turn)
    return pin.real + mpmath.sqrt(l_a**2 - (pin.imag - offset) ** 2)


def _top(lengths, rod):
    near = math.radians(articulated_stroke(lengths, rod).top_angle)
    at = mpmath.findroot(lambda psi: mpmath.diff(lambda one: _distance(lengths, rod, one), psi), near)
    return at, _distance(lengths, rod, at)


@settings(max_examples=25)
@given(geometries(), st.floats(0, 6.28))
def test_motion_agrees_with_thirty_digits(geometry, psi):
    lengths, rod = geometry
    motion = articulated_motion(lengths, rod, CrankGrid.from_radians(np.array([psi])))
    with mpmath.workdps(40):
        top = _top(lengths, rod)[1]
        x = [top - _distance(lengths, rod, mpmath.mpf(psi))]
        x += [-mpmath.diff(lambda one: _distance(lengths, rod, one), mpmath.mpf(psi), order) for order in (1, 2)]
    scale = lengths.crank_radius / min(abs(motion.swing.cos[0]), abs(motion.master.cos[0])) ** 3
    for mine, exact in zip(motion.piston, x, strict=True):
        assert abs(mine[0] - float(exact)) < 2e-13 * scale


@settings(max_examples=25)
@given(geometries(), st.floats(0, 6.28))
def test_the_rod_angle_and_its_derivatives_belong_together(geometry, psi):
    lengths, rod = geometry
    motion = articulated_motion(lengths, rod, CrankGrid.from_radians(np.array([psi])))

    steps = 1e-4 * np.arange(-3, 4)
    near = articulated_motion(lengths, rod, CrankGrid.from_radians(psi + steps))
    first = np.dot([-1 / 60, 3 / 20, -3 / 4, 0, 3 / 4, -3 / 20, 1 / 60], near.rod.position) / 1e-4
    second = np.dot([-1 / 60, 3 / 20, -3 / 4, 0, 3 / 4, -3 / 20, 1 / 60], near.rod.position_1) / 1e-4
    assert motion.rod.position_1[0] == pytest.approx(first, abs=1e-9)
    assert motion.rod.position_2[0] == pytest.approx(second, abs=1e-9)
    assert motion.swing.sin**2 + motion.swing.cos**2 == pytest.approx(1, abs=1e-14)


@settings(max_examples=30)
@given(geometries())
def test_dead_centres_are_those_of_thirty_digits(geometry):
    lengths, rod = geometry
    articulated_rod = articulated_stroke(lengths, rod)
    with mpmath.workdps(40):
        at, top = _top(lengths, rod)
    assert math.radians(articulated_rod.top_angle) == pytest.approx(float(at), abs=1e-7)
    assert articulated_rod.top == pytest.approx(float(top), rel=1e-15)
    x = articulated_motion(lengths, rod, CrankGrid.from_degrees(np.arange(0, 360, 0.5))).piston.position
    assert x.min() >= -1e-15
    assert x.max() <= articulated_rod.stroke + 1e-15
    assert x.max() == pytest.approx(articulated_rod.stroke, rel=1e-4)


@for_each("offset", [0.0, 0.013])
def test_without_knuckle_radius_it_is_a_plain_slider_crank(offset):
    rod = ArticulatedRod(0.3, 0.0, 77.0, 40.0, offset)
    motion = articulated_motion(MASTER, rod, ANGLES)
    plain = piston_motion(SliderCrank(MASTER.crank_radius, 0.3, offset), ANGLES)
    for mine, other in zip(
        (*motion.piston, *motion.rod, *motion.swing), (*plain.piston, *plain.rod, *plain.swing), strict=True
    ):
        assert mine == pytest.approx(other, abs=1e-14)


def test_a_rod_on_the_axis_of_the_master_pin_is_the_master_rod():
    """A knuckle pin on the master rod itself and a slave that ends at its piston pin moves as the master piston."""
    rod = ArticulatedRod(MASTER.rod_length - KNUCKLE, KNUCKLE, 0.0, 0.0)
    motion, plain = articulated_motion(MASTER, rod, ANGLES), piston_motion(MASTER, ANGLES)
    assert motion.piston.position == pytest.approx(plain.piston.position, abs=1e-15)
    assert motion.piston.position_2 == pytest.approx(plain.piston.position_2, abs=1e-15)


def test_an_engine_seen_in_the_mirror_moves_the_same():
    rod = ArticulatedRod(0.28, KNUCKLE, 43.0, 40.0, 0.004)
    mirrored = rod._replace(knuckle_angle=-43.0, axis=-40.0, offset=-0.004)
    back = articulated_motion(MASTER, mirrored, CrankGrid.from_degrees(-ANGLES.degrees))
    there = articulated_motion(MASTER, rod, ANGLES)
    assert back.piston.position == pytest.approx(there.piston.position, abs=1e-15)
    assert back.piston.position_1 == pytest.approx(-there.piston.position_1, abs=1e-15)


# --- forces


@given(geometries(), st.floats(-1e5, 1e5))
def test_the_torque_is_the_virtual_work_of_the_piston_force(geometry, P):
    lengths, rod = geometry
    motion = articulated_motion(lengths, rod, ANGLES)
    forces = articulated_forces(np.full(len(ANGLES), P), lengths, rod, ANGLES, motion)
    torque = forces.tangential * lengths.crank_radius
    largest = np.hypot(forces.radial, forces.tangential).max() + np.abs(forces.master_side).max()
    assert torque == pytest.approx(P * motion.piston.position_1, abs=1e-12 * largest * lengths.crank_radius + 1e-300)


@settings(max_examples=30)
@given(geometries(), st.floats(0, 360))
def test_the_forces_are_those_of_two_rigid_rods_in_equilibrium(geometry, degrees):
    """Both rods and pistons as bodies: six equations for six unknown forces, solved at once."""
    lengths, rod = geometry
    grid, P = CrankGrid.from_degrees(np.array([degrees])), 1000.0
    motion = articulated_motion(lengths, rod, grid)
    got = articulated_forces(np.array([P]), lengths, rod, grid, motion)
    lean = math.radians(rod.axis)
    crankpin = lengths.crank_radius * np.exp(1j * (math.radians(degrees)))
    knuckle = complex(motion.knuckle.x.position[0], motion.knuckle.y.position[0])
    top = articulated_stroke(lengths, rod).top
    articulated_pin = complex(top - motion.piston.position[0], rod.offset)
    in_master = crankpin * np.exp(1j * lean)
    master_pin = complex(
        in_master.real + math.sqrt(lengths.rod_length**2 - (in_master.imag - lengths.offset) ** 2), lengths.offset
    ) * np.exp(-1j * lean)
    across = 1j * np.exp(-1j * lean)
    # unknown: wall of the slave (y), knuckle pin on the master rod (x, y), wall of the master, crankpin (x, y)
    arm, lever, to_master = articulated_pin - knuckle, knuckle - crankpin, master_pin - crankpin
    rows = np.array([
        [0, -1, 0, 0, 0, 0],
        [1, 0, -1, 0, 0, 0],
        [arm.real, 0, 0, 0, 0, 0],
        [0, 1, 0, across.real, 1, 0],
        [0, 0, 1, across.imag, 0, 1],
        [0, -lever.imag, lever.real, to_master.real * across.imag - to_master.imag * across.real, 0, 0],
    ])  # fmt: skip
    wall, _, _, master_wall, x, y = np.linalg.solve(rows, [P, 0, -arm.imag * P, 0, 0, 0])
    size = abs(complex(x, y)) + abs(master_wall) + P
    assert got.side[0] == pytest.approx(wall, abs=1e-11 * size)
    assert got.master_side[0] == pytest.approx(master_wall, abs=1e-11 * size)
    assert complex(got.x[0], got.y[0]) == pytest.approx(-complex(x, y), abs=1e-11 * size)
    assert math.hypot(got.radial[0], got.tangential[0]) == pytest.approx(abs(complex(x, y)), rel=1e-12)


def test_without_knuckle_radius_the_master_rod_feels_nothing():
    rod = ArticulatedRod(0.3, 0.0, 77.0, 40.0)
    P = np.linspace(-1e4, 1e4, len(ANGLES))
    forces = articulated_forces(P, MASTER, rod, ANGLES, articulated_motion(MASTER, rod, ANGLES))
    assert not forces.couple.any()
    assert not forces.master_side.any()
    plain = piston_motion(SliderCrank(MASTER.crank_radius, 0.3), ANGLES)
    assert forces.tangential == pytest.approx(P * plain.swing.sin_sum / plain.swing.cos, abs=1e-10)
    assert forces.radial == pytest.approx(P * plain.swing.cos_sum / plain.swing.cos, abs=1e-10)


# --- what cannot be assembled


@for_each(
    ("lengths", "rod", "message"),
    [
        (MASTER, ArticulatedRod(0.14, KNUCKLE, 110.0, 40.0), r"knuckle pin is 146[.]017 mm beside.*misses 6[.]017"),
        (SliderCrank(0.1, 0.08), ArticulatedRod(0.3, 0.02, 0.0, 0.0), "lengthen the rod"),
        (MASTER, ArticulatedRod(0.0, KNUCKLE, 40.0, 40.0), "longer than zero"),
    ],
)
def test_what_cannot_turn_is_refused(lengths, rod, message):
    with pytest.raises(GeometryError, match=message):
        articulated_motion(lengths, rod, ANGLES)


def test_the_missing_length_is_the_very_one():
    short = ArticulatedRod(0.14, KNUCKLE, 110.0, 40.0)
    with pytest.raises(GeometryError) as refused:
        check_articulated_rod(MASTER, short)
    missing = float(str(refused.value).split("misses ")[1].split(" mm")[0]) / 1e3
    check_articulated_rod(MASTER, short._replace(length=0.14 + missing + 1e-8))
    with pytest.raises(GeometryError):
        check_articulated_rod(MASTER, short._replace(length=0.14 + missing - 1e-8))


# --- a radial row


def _inertia_orders(cylinders, motion_of):
    """The Fourier transform of the summed vector of accelerations, in units of the crank radius."""
    layout, _ = radial(cylinders)
    degrees = np.arange(0.0, 720.0, 1.5)
    total = np.zeros(degrees.size, dtype=complex)
    for place in layout.places:
        own = CrankGrid.from_degrees(cylinder_angle(degrees, place, 720.0))
        # inertia acts away from the crankshaft where the piston accelerates towards it
        total += motion_of(place, own).piston.position_2 * np.exp(1j * math.radians(place.axis))
    return np.fft.fft(total) / degrees.size / MASTER.crank_radius


def _central(_place, own):
    return piston_motion(MASTER, own)


@for_each("cylinders", [5, 7, 9])
def test_equal_central_rods_of_a_radial_row_have_no_second_order(cylinders):
    parts = _inertia_orders(cylinders, _central)
    assert abs(parts[2]) == pytest.approx(cylinders / 2, rel=1e-13)
    assert abs(parts[-2]) < 1e-13
    assert max(abs(parts[4]), abs(parts[-4])) < 1e-13


def test_three_central_rods_have_a_second_order_turning_backwards():
    parts = _inertia_orders(3, _central)
    lam = MASTER.rod_ratio
    second = lam + lam**3 / 4 + 15 * lam**5 / 128 + 35 * lam**7 / 512
    assert abs(parts[-4]) == pytest.approx(1.5 * second, rel=1e-4)
    assert abs(parts[4]) < 1e-13


def test_articulated_rods_of_a_radial_row_leave_a_second_order():
    def motion(place, own):
        if not place.master:
            return piston_motion(MASTER, own)
        angle = (place.axis + 180.0) % 360.0 - 180.0
        rod = ArticulatedRod(MASTER.rod_length - KNUCKLE, KNUCKLE, angle, place.axis)
        return articulated_motion(MASTER, rod, own)

    parts = _inertia_orders(9, motion)
    assert abs(parts[2]) == pytest.approx(4.5, rel=0.01)
    assert 0.5 < abs(parts[4]) < 0.65, "it turns with the crank, twice as fast"
    assert abs(parts[-4]) < 1e-3
