"""Loads on crankpin, big end and small end, against vectors put together from Newton's laws and a printed table.

Printed numbers: Động lực học của cơ cấu khuỷu trục - thanh truyền, course note, Ho Chi Minh City University of
Technology and Education: P1 every 5 degrees, r/l = 0.25, 13.76 g/cm2 of rod mass at the crankpin.
"""

import math
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import crankwork
from crankwork.cylinders import load_vectors
from crankwork.cylinders.load_vectors import BearingLoad, rotated, rotated_by
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank, rod_swing
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

TESTS = Path(__file__).parents[1]
NOTE_ANGLE, _, _, NOTE_P1 = np.loadtxt(TESTS / "literature" / "data" / "vietnamese_engine.csv", delimiter=",").T
GRID = CrankGrid.steps(10.0, 720.0)
FORCES = st.floats(-1e5, 1e5, allow_subnormal=False)
COLUMNS = arrays(float, GRID.angle.size, elements=FORCES)
ANGLES = st.floats(-720, 720)


def _swing(ratio=0.3, offset=0.0):
    return rod_swing(SliderCrank(0.05, 0.05 / ratio, offset), GRID)


def _crank_frame_load(radial, tangential, inertia):
    return BearingLoad(-load_vectors.crankpin_radial_force(radial, inertia, 0.0), tangential)


def _close(one, other, tolerance=1e-13):
    scale = 1 + max(float(np.max(np.abs(part))) for part in (*one, *other))
    return all(np.all(np.abs(a - b) <= tolerance * scale) for a, b in zip(one, other, strict=True))


# --- frames


@given(radial=COLUMNS, tangential=COLUMNS, inertia=st.floats(-1e4, 0), ratio=st.floats(0.15, 0.6), angle=ANGLES)
def test_a_load_has_one_size_in_every_frame(radial, tangential, inertia, ratio, angle):
    load = _crank_frame_load(radial, tangential, inertia)
    scale = 1e-13 * (1 + np.max(load.resultant))
    frames = (
        load_vectors.big_end_bearing_load(load, _swing(ratio)),
        rotated(load, GRID.sin, GRID.cos),
        rotated_by(load, angle),
    )
    for other in frames:
        assert np.max(np.abs(other.resultant - load.resultant)) <= scale
    assert np.array_equal(load_vectors.crankpin_load(tangential, radial, inertia), load.resultant)


def test_quarter_turns_are_exact():
    load = BearingLoad(np.array([3.0]), np.array([4.0]))
    assert rotated_by(load, 90.0) == (np.array([-4.0]), np.array([3.0]))
    assert rotated_by(load, 720.0) == load


@given(size=st.floats(1e-3, 1e6), angle=st.floats(0, 359.999))
def test_the_direction_is_the_angle_of_the_vector(size, angle):
    load = rotated_by(BearingLoad(np.array([size]), np.array([0.0])), angle)
    assert load.resultant == pytest.approx(size, rel=1e-14)
    assert abs((load.direction[0] - angle + 180) % 360 - 180) < 1e-11
    assert 0 <= load.direction[0] < 360


def test_a_direction_just_below_zero_does_not_round_to_a_full_turn():
    assert BearingLoad(np.array([1.0]), np.array([-1e-30])).direction == [0.0]


# --- crankpin of an engine without gas

WITHOUT_GAS = """
title = "Without gas"
crank = { radius = "40 mm", speed = "3000 rpm", mass = "0.7 kg" }
rod = { length = "140 mm", mass = "0.8 kg", small_end_share = 0.25 }
piston = { mass = "0.5 kg" }
cylinder = { bore = "80 mm" }
engine = { layout = "inline", cylinders = 1 }
bearings = { crankpin_diameter = "50 mm", crankpin_length = "25 mm" }
"""


def test_pressure_and_load_ratio_are_those_of_the_inertia_forces():
    """The pin at r exp(i phi) bears 0.6 kg of the big end and, along the rod, what moves 0.7 kg in the cylinder."""
    phi, w = np.radians(np.arange(0, 360, 0.25)), 100 * np.pi
    beta = np.arcsin(0.04 * np.sin(phi) / 0.14)
    slope = 0.04 * np.cos(phi) / (0.14 * np.cos(beta))
    curve = (slope**2 * np.sin(beta) - 0.04 * np.sin(phi) / 0.14) / np.cos(beta)
    # of the piston pin at r cos(phi) + l cos(beta) over the crankshaft, away from it
    a = -(w**2) * (0.04 * np.cos(phi) + 0.14 * (np.cos(beta) * slope**2 + np.sin(beta) * curve))
    pin = -0.7 * a / np.cos(beta) * np.exp(-1j * beta) + 0.6 * 0.04 * w**2 * np.exp(1j * phi)
    load = np.abs(pin)
    assert load.max() == pytest.approx(0.04 * w**2 * (0.6 + 0.7 * (1 + 0.04 / 0.14)), rel=1e-12), "at the top"
    listing = analysed(WITHOUT_GAS).listings["bearing_loads"]
    found = {key: values[listing.names.index("crankpin.1")] for key, values in listing.columns.items()}
    assert found["bearing_load_ratio"] == pytest.approx(load.max() / load.mean(), rel=1e-9)
    assert found["bearing_pressure"] == pytest.approx(load.mean() / (0.05 * 0.025), rel=1e-9)
    assert found["bearing_pressure_max"] == pytest.approx(load.max() / (0.05 * 0.025), rel=1e-9)


# --- printed engine


def _note_load(angle, force):
    """Return the load on the crankpin with 30 digits, in the note's unit and from its numbers alone. [MN/m2]"""
    with mpmath.workdps(30):
        phi, force = mpmath.radians(mpmath.mpf(float(angle))), mpmath.mpf(float(force))
        beta = mpmath.asin(mpmath.mpf("0.25") * mpmath.sin(phi))
        inertia = -mpmath.mpf("13.76") * mpmath.mpf("0.0529") * (2300 * mpmath.pi / 30) ** 2 * mpmath.mpf("1e-5")
        along = force * mpmath.cos(phi + beta) / mpmath.cos(beta) + inertia
        across = force * mpmath.sin(phi + beta) / mpmath.cos(beta)
        return float(mpmath.hypot(along, across))


@pytest.fixture(scope="module")
def engine():
    results = crankwork.analyse(crankwork.read(TESTS.parent / "examples" / "spark-engine.toml"))
    masses, solved = results.machine.masses, results.solved
    inertia = float(load_vectors.big_end_inertia_force(masses.rod_big_end, solved.lengths.crank_radius, solved.speed))
    return results, inertia, solved.space.area


def test_the_crankpin_load_of_the_printed_engine(engine):
    """To the last printed digit, but for pressures that are not those of the note's own program."""
    results, inertia, area = engine
    load = _crank_frame_load(results["radial_force"], results["tangential_force"], inertia)
    rows = np.searchsorted(results.grid.degrees, NOTE_ANGLE - 1e-9)
    size = load.resultant[rows] / area / 1e6
    expected = np.array([_note_load(*row) for row in zip(NOTE_ANGLE, NOTE_P1, strict=True)])
    differ = NOTE_ANGLE[np.abs(size - expected) > 1e-6]
    assert differ.tolist() == [355, 510, 515, 520, 525, 530, 535, 540, 545]


def test_at_top_dead_centre_the_rod_pulls_with_all_of_it(engine):
    """P1 = -0.846907 at 0 degrees and K_R = -0.42227 of 13.76 g/cm2 at r w^2 = 3068.8 m/s2 add up. [MN/m2]"""
    results, inertia, area = engine
    load = _crank_frame_load(results["radial_force"], results["tangential_force"], inertia)
    assert load.x[0] / area / 1e6 == pytest.approx(0.846907 + 0.42227, abs=1e-5)
    assert load.y[0] == 0


# --- big end and small end


@given(force=COLUMNS, ratio=st.floats(0.1, 0.7), offset=st.floats(-0.01, 0.01))
def test_a_rod_without_mass_is_loaded_along_itself(force, ratio, offset):
    swing = _swing(ratio, offset)
    load = _crank_frame_load(force * swing.cos_sum / swing.cos, force * swing.sin_sum / swing.cos, 0.0)
    along = force / swing.cos
    assert _close(load_vectors.big_end_bearing_load(load, swing), (along, 0 * along))
    assert _close(load_vectors.small_end_bearing_load(force, force * swing.sin / swing.cos, swing), (-along, 0 * along))


@for_each("offset", [0.0, 0.004])
@for_each("inertia_excess", [0.0, -0.003])
def test_big_end_and_small_end_forces_move_the_rod(offset, inertia_excess):
    """Newton for the rod, force and moment: m a of its centre, J eps about it."""
    machine = crankwork.read_machine(crankwork.template("engine"))
    results = crankwork.analyse(crankwork.with_method(machine, "exact"))
    solved, w = results.solved, results.solved.speed
    r, l, _ = lengths = solved.lengths._replace(offset=offset)  # noqa: E741
    swing, masses, grid = rod_swing(lengths, results.grid), machine.masses, results.grid
    slope = lengths.rod_ratio * grid.cos / swing.cos
    eps = (slope**2 * swing.sin - lengths.rod_ratio * grid.sin) / swing.cos * w**2
    small, big = masses.rod_small_end, masses.rod_big_end
    # the piston pin is at r cos(phi) + l cos(beta), which changes twice
    a = r * grid.cos * w**2 + l * (swing.cos * slope**2 * w**2 + swing.sin * eps)
    gas = results["gas_force"]
    P = gas - masses.reciprocating * a
    side = P * swing.sin / swing.cos - inertia_excess * eps / (l * swing.cos)
    radial, tangential = P * grid.cos - side * grid.sin, P * grid.sin + side * grid.cos
    inertia = load_vectors.big_end_inertia_force(big, r, w)
    big_end = load_vectors.big_end_bearing_load(_crank_frame_load(radial, tangential, inertia), swing)
    pin = load_vectors.piston_pin_force(gas, masses.piston, a, 0.0)
    small_end = load_vectors.small_end_bearing_load(pin, side, swing)
    assert np.allclose(small_end.resultant, load_vectors.small_end_load(pin, side), rtol=1e-13)
    # in the cylinder frame, whose x is away from the crankshaft
    crank = -r * w**2 * np.exp(1j * grid.angle)
    along_rod = swing.cos - 1j * swing.sin
    forces = [(one.x + 1j * one.y) * along_rod for one in (big_end, small_end)]
    scale = np.max(big_end.resultant)
    assert np.max(np.abs(sum(forces) - (small * -a + big * crank))) < 1e-12 * scale
    centre = small / (small + big) * l
    arms = (-centre * along_rod, (l - centre) * along_rod)
    moment = sum((arm.conjugate() * force).imag for arm, force in zip(arms, forces, strict=True))
    rod_inertia = small * (l - centre) ** 2 + big * centre**2 + inertia_excess
    # beta turns against the rotation
    assert np.max(np.abs(moment + rod_inertia * eps)) < 1e-12 * scale * l


def test_the_weight_of_the_piston_group_acts_along_the_axis():
    without = load_vectors.piston_pin_force(100.0, 0.5, 20.0, 0.0)
    assert load_vectors.piston_pin_force(100.0, 0.5, 20.0, 0.5 * 9.81) - without == pytest.approx(4.905)
    assert math.isclose(without, 90.0)
