"""What holds for every engine, compressor and pump of one crank: statics, energy, symmetry and scale.

The machines are drawn at random: lengths, offset, masses, inertia of the rod, speed, angular acceleration, weights and
gas. What is compared with is written out here from Newton's laws, not taken from the package.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import crankwork
from crankwork.analysis import columns, traced_cylinder
from crankwork.analysis.cylinder_forces import COLUMNS
from crankwork.dynamics.masses import CrankGearMasses, rod_inertia_excess, rod_small_end_mass
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.machine import Cylinder, Gas, Machine
from crankwork.mechanism.mechanism import slider_crank
from crankwork.method import EXACT, TEXTBOOK, Method
from crankwork.preparation.piston_kinematics import HARMONICS
from crankwork.report.tables import table_column
from each import for_each

Values = NDArray[Any]

GRID = CrankGrid.steps(7.5, 720.0)
ONE_TURN = CrankGrid.steps(7.5, 360.0)
TWO_MASS = replace(EXACT, rod="two-mass")
METHODS = (EXACT, TWO_MASS, TEXTBOOK, EXACT.named("series:6"))
FEW = settings(max_examples=12)
MANY = settings(max_examples=25)


class Rod(NamedTuple):
    """A connecting rod as a body: mass, distance of its centre from the crankpin, inertia about it. [kg, m, kg m2]"""

    mass: float
    centre: float
    inertia: float


class Drawn(NamedTuple):
    """A machine with the lengths and the rod it was made from."""

    machine: Machine
    lengths: tuple[float, float, float]
    rod: Rod


def _otto(pressure: float, exponent: float) -> Gas:
    """Return a closed four-stroke diagram, spark at 350 degrees and exhaust valve at 490. [Pa, gauge]"""
    points = {
        "r": DiagramPoint(0.0, 2e4),
        "a": DiagramPoint(170.0),
        "c": DiagramPoint(350.0),
        "z": DiagramPoint(363.0, pressure),
        "b": DiagramPoint(490.0),
        "e": DiagramPoint(560.0, 2e4),
        "r0": DiagramPoint(720.0),
    }
    pieces = (
        Piece("constant", ("r", "a")),
        Piece("polytropic", ("a", "c"), exponent),
        Piece("rounded", ("c", "z")),
        Piece("polytropic", ("z", "b"), exponent),
        Piece("rounded", ("b", "e")),
        Piece("constant", ("e", "r0")),
    )
    return Gas(points=points, pieces=pieces)


@st.composite
def machines(draw: st.DrawFn, *, has_gas: bool = True, is_steady: bool = False, is_upright: bool = True) -> Drawn:
    """Return any crank gear from a model engine to a ship's, its rod 1.1 to 10 times as long as it must be."""
    r = draw(st.floats(0.01, 1.0))
    e = draw(st.sampled_from([0.0, 0.0, -0.4, -0.05, 0.1, 0.7])) * r
    l = (r + abs(e)) * draw(st.floats(1.1, 10.0))  # noqa: E741
    mass = draw(st.floats(0.01, 100.0))
    centre = draw(st.floats(0.05, 0.95)) * l
    rod = Rod(mass, centre, mass * (draw(st.floats(0.1, 0.8)) * l) ** 2)
    small = rod_small_end_mass(mass, centre, l)
    masses = CrankGearMasses(
        piston=draw(st.floats(0.01, 100.0)),
        rod_small_end=small,
        rod_big_end=mass - small,
        crank=draw(st.sampled_from([0.0, 3.0])),
        rod_inertia_excess=rod_inertia_excess(rod.inertia, mass, centre, l),
    )
    machine = Machine(
        slider_crank(r, l, e),
        draw(st.floats(1.0, 900.0)),
        0.0 if is_steady else draw(st.sampled_from([0.0, -500.0, 40.0, 2000.0])),
        cylinder=Cylinder(
            bore=2 * r * draw(st.floats(0.3, 2.0)),
            compression_ratio=draw(st.floats(3.0, 22.0)),
            inclination=0.0 if is_upright else draw(st.floats(-math.pi, math.pi)),
        ),
        masses=masses,
        gas=_otto(draw(st.floats(1e6, 2e7)), draw(st.floats(1.0, 1.5))) if has_gas else None,
        has_gravity=draw(st.booleans()),
    )
    return Drawn(machine, (r, l, e), rod)


def _columns(machine: Machine, method: Method = EXACT, grid: CrankGrid = GRID) -> dict[str, Array]:
    return columns(traced_cylinder(machine, method), grid)


def _assert_equal(one: Array, other: Array, tolerance: float, scale: float = 0.0) -> None:
    """Assert that two arrays agree relative to the largest value there is, or to `scale` if that is larger."""
    largest = max(float(np.max(np.abs(one))), float(np.max(np.abs(other))), scale)
    assert float(np.max(np.abs(one - other))) <= tolerance * largest


# Statics


@MANY
@given(machines(), st.sampled_from(METHODS))
def test_radial_and_tangential_force_have_the_resultant_of_the_rod(drawn: Drawn, method: Method) -> None:
    found = _columns(drawn.machine, method)
    across = found.get("rod_transverse_force", np.zeros(len(GRID)))
    is_more = bool(drawn.machine.masses.rod_inertia_excess)
    assert ("rod_transverse_force" in found) == (method.rod == "rigid" and is_more)
    resultant = found["rod_force"] ** 2 + across**2
    _assert_equal(found["tangential_force"] ** 2 + found["radial_force"] ** 2, resultant, 2e-14)
    _assert_equal(found["piston_force"] ** 2 + found["side_force"] ** 2, resultant, 2e-14)


@MANY
@given(machines(), st.sampled_from((TWO_MASS, TEXTBOOK)))
def test_the_torque_on_the_crank_turns_the_frame_backwards(drawn: Drawn, method: Method) -> None:
    """T r = N h + P e, with h the height of the piston pin above the crankshaft."""
    r, l, e = drawn.lengths  # noqa: E741
    found = _columns(drawn.machine, method)
    h = r * GRID.cos + np.sqrt(l**2 - (r * GRID.sin - e) ** 2)
    by_side, by_axis = found["side_force"] * h, found["piston_force"] * e
    scale = float(np.max(np.abs(by_side)) + np.max(np.abs(by_axis)))
    _assert_equal(found["tangential_force"] * r, by_side + by_axis, 1e-14, scale)
    _assert_equal(found["overturning_moment"], -(by_side + by_axis), 1e-14, scale)


@MANY
@given(machines())
def test_the_piston_force_does_at_the_piston_the_power_it_does_at_the_crankpin(drawn: Drawn) -> None:
    found = _columns(drawn.machine, TWO_MASS)
    power = found["piston_force"] * found["piston_velocity"]
    _assert_equal(found["tangential_force"] * drawn.lengths[0] * drawn.machine.speed, power, 1e-13)


@FEW
@given(machines())
def test_forces_per_piston_area_are_forces_over_the_area(drawn: Drawn) -> None:
    results = crankwork.analyse(drawn.machine, ONE_TURN)
    area = math.pi * drawn.machine.cylinder.bore**2 / 4 if drawn.machine.cylinder else 0.0
    for key in ("piston_force", "inertia_force", "side_force", "tangential_force", "radial_force"):
        per_area = table_column(results, key, per_area=True)
        _assert_equal(per_area, np.asarray(results[key]) / area / 1e6, 1e-14)
    for key in ("gas_pressure", "piston_velocity"):
        assert table_column(results, key, per_area=True).tolist() == table_column(results, key).tolist()


@MANY
@given(st.floats(0.02, 1.0), st.floats(0.02, 1.0), st.floats(1.0, 1.5))
def test_masses_given_per_area_make_all_forces_per_area_independent_of_the_bore(
    bore: float, other: float, exponent: float
) -> None:
    """As long as the compression ratio stays."""
    tables = []
    for one in (bore, other):
        area = math.pi * one**2 / 4
        masses = CrankGearMasses(150.0 * area, 50.0 * area, 100.0 * area, 200.0 * area)
        machine = Machine(
            slider_crank(0.05, 0.2), 250.0, cylinder=Cylinder(one, compression_ratio=9.0), masses=masses,
            gas=_otto(4e6, exponent),
        )  # fmt: skip
        found = _columns(machine)
        tables.append({key: found[key] / area for key in ("piston_force", "side_force", "crank_torque", "gas_force")})
    for key, values in tables[0].items():
        _assert_equal(values, tables[1][key], 1e-13)


# The rod as a rigid body


def _newton_euler(drawn: Drawn, grid: CrankGrid) -> dict[str, Array]:
    """Return side force, rod on crankpin and torque from the equations of motion of piston, rod and crank.

    Complex coordinates in the frame of the cylinder: real part towards the crankpin at 90 degrees, imaginary part
    towards the head. The rod points from crankpin to piston pin in the direction psi.
    """
    machine, (r, l, e), rod = drawn  # noqa: E741
    masses, w, eps = machine.masses, machine.speed, machine.angular_acceleration
    assert masses is not None
    assert machine.cylinder is not None
    phi, theta = grid.angle, machine.cylinder.inclination
    gravity = 9.80665 if machine.has_gravity else 0.0
    fall = gravity * (math.sin(theta) - 1j * math.cos(theta))

    arm = 1j * r * np.exp(-1j * phi)
    arm_2 = arm * (-1j * eps - w**2)
    sin_psi = np.sqrt(1 - ((e - r * np.sin(phi)) / l) ** 2)
    along = (e - r * np.sin(phi)) / l + 1j * sin_psi
    psi_1 = r * np.cos(phi) * w / (l * sin_psi)
    psi_2 = (r * np.cos(phi) * eps - r * np.sin(phi) * w**2 - l * along.real * psi_1**2) / (l * sin_psi)
    swing_2 = along * (1j * psi_2 - psi_1**2)
    piston_2 = (arm_2 + l * swing_2).imag
    centre_2 = arm_2 + rod.centre * swing_2

    gas = _columns(machine, EXACT, grid).get("gas_force", np.zeros(len(grid)))
    on_rod_up = -gas + masses.piston * (fall.imag - piston_2)  # from the piston, along the cylinder
    rest = rod.mass * (centre_2 - fall)
    # moments about the crankpin: the unknown part is the force of the piston across the cylinder
    turning = rod.inertia * psi_2 + (np.conj(rod.centre * along) * rest).imag
    on_rod_across = (l * along.real * on_rod_up - turning) / (l * along.imag)
    at_piston = on_rod_across + 1j * on_rod_up
    on_crank = at_piston - rest
    inwards = on_crank * np.conj(-arm / r)
    forwards = on_crank * np.conj(-1j * arm / r)
    crank = masses.crank * (fall - arm_2)
    torque = r * (forwards + crank * np.conj(-1j * arm / r)).real
    return {
        "side": on_rod_across - masses.piston * fall.real,
        "radial": inwards.real,
        "tangential": forwards.real,
        "torque": torque,
        "scale": np.abs(at_piston) + np.abs(rest),
    }


def _big_end(drawn: Drawn, grid: CrankGrid) -> tuple[Array, Array]:
    """Return what the rod mass at the crankpin adds to radial and tangential force by inertia and weight. [N]"""
    machine = drawn.machine
    assert machine.masses is not None
    assert machine.cylinder is not None
    mass, r = machine.masses.rod_big_end, drawn.lengths[0]
    gravity = 9.80665 if machine.has_gravity else 0.0
    down = grid.angle + machine.cylinder.inclination
    inwards = mass * (gravity * np.cos(down) - r * machine.speed**2)
    forwards = mass * (gravity * np.sin(down) - r * machine.angular_acceleration)
    return inwards, forwards


@MANY
@given(machines(is_upright=False))
def test_the_crankpin_carries_what_a_rigid_rod_brings(drawn: Drawn) -> None:
    found, expected = _columns(drawn.machine), _newton_euler(drawn, GRID)
    inwards, forwards = _big_end(drawn, GRID)
    scale = float(np.max(expected["scale"]))
    _assert_equal(found["radial_force"] + inwards, expected["radial"], 1e-12, scale)
    _assert_equal(found["tangential_force"] + forwards, expected["tangential"], 1e-12, scale)
    _assert_equal(found["crank_torque"], expected["torque"], 1e-12, scale * drawn.lengths[0])


@MANY
@given(machines())
def test_the_wall_of_an_upright_cylinder_carries_what_a_rigid_rod_brings(drawn: Drawn) -> None:
    found, expected = _columns(drawn.machine), _newton_euler(drawn, GRID)
    _assert_equal(found["side_force"], expected["side"], 1e-12, float(np.max(expected["scale"])))


@MANY
@given(machines(has_gas=False))
def test_three_masses_take_the_torque_of_the_rigid_rod(drawn: Drawn) -> None:
    """Their torque is their inertia times the velocity, mass by mass: no couple is needed."""
    machine, (r, l, e), rod = drawn  # noqa: E741
    machine = replace(machine, has_gravity=False)
    masses, w, eps = machine.masses, machine.speed, machine.angular_acceleration
    assert masses is not None
    at_piston, at_crank = rod.inertia / (l * (l - rod.centre)), rod.inertia / (l * rod.centre)
    at_centre = rod.mass - at_piston - at_crank
    phi = ONE_TURN.angle
    sin_psi = np.sqrt(1 - ((e - r * np.sin(phi)) / l) ** 2)
    along = (e - r * np.sin(phi)) / l + 1j * sin_psi
    psi_1 = r * np.cos(phi) / (l * sin_psi)
    psi_2 = (-r * np.sin(phi) - l * along.real * psi_1**2) / (l * sin_psi)
    arm = 1j * r * np.exp(-1j * phi)
    torque, scale = np.zeros(len(phi)), 0.0
    for mass, share in (
        (masses.piston + at_piston, 1.0), (at_crank + masses.crank, 0.0), (at_centre, rod.centre / l)
    ):  # fmt: skip
        first = -1j * arm + share * l * 1j * along * psi_1
        second = -arm + share * l * along * (1j * psi_2 - psi_1**2)
        part = -mass * ((second * w**2 + first * eps) * np.conj(first)).real
        torque += part
        scale = max(scale, float(np.max(np.abs(part))))
    _assert_equal(_columns(machine, EXACT, ONE_TURN)["crank_torque"], torque, 1e-12, scale)


def _kinetic_energy(drawn: Drawn, phi: Values) -> Values:
    """Return the kinetic energy at any, also complex, crank angle at constant speed. [J]"""
    machine, (r, l, e), rod = drawn  # noqa: E741
    masses, w = machine.masses, machine.speed
    assert masses is not None
    sin_beta = (r * np.sin(phi) - e) / l
    cos_beta = np.sqrt(1 - sin_beta**2)
    swing = r * np.cos(phi) / (l * cos_beta) * w
    piston = r * w * (np.sin(phi) + np.cos(phi) * sin_beta / cos_beta)
    across = r * w * np.cos(phi) * (1 - rod.centre / l)
    down = r * w * np.sin(phi) + rod.centre * sin_beta * swing
    return np.asarray(masses.piston * piston**2 + rod.mass * (across**2 + down**2) + rod.inertia * swing**2) / 2


@MANY
@given(machines(has_gas=False, is_steady=True))
def test_the_inertia_torque_takes_up_the_kinetic_energy(drawn: Drawn) -> None:
    drawn = drawn._replace(machine=replace(drawn.machine, has_gravity=False))
    step = 1e-30
    expected = -_kinetic_energy(drawn, ONE_TURN.angle + 1j * step).imag / step
    energy = float(np.max(_kinetic_energy(drawn, ONE_TURN.angle).real))
    _assert_equal(_columns(drawn.machine, EXACT, ONE_TURN)["crank_torque"], expected, 1e-12, energy)


# Work


@FEW
@given(machines(is_steady=True, is_upright=False))
def test_the_crank_gets_in_a_cycle_the_work_of_the_gas(drawn: Drawn) -> None:
    results = crankwork.analyse(drawn.machine)
    summary = results.summary
    # what the shaft must be given is told as a positive torque too
    sign = -1 if summary["indicated_work"] < 0 else 1
    assert summary["mean_torque"] >= 0
    assert sign * summary["mean_torque"] * 4 * math.pi == pytest.approx(summary["indicated_work"], rel=1e-10)
    assert summary["indicated_mean_pressure"] < summary["gas_pressure_max"]
    assert results.checks["work"] < 1e-10


@FEW
@given(machines(has_gas=False, is_steady=True, is_upright=False), st.sampled_from((EXACT, TWO_MASS)))
def test_inertia_and_weight_do_no_work_in_a_turn_at_constant_speed(drawn: Drawn, method: Method) -> None:
    results = crankwork.analyse(drawn.machine, method=method)
    assert abs(results.summary["mean_torque"]) < 1e-10 * float(np.max(np.abs(results["crank_torque"])))


@MANY
@given(machines(has_gas=False, is_steady=True))
def test_in_two_terms_the_inertia_torque_has_the_four_harmonics_of_the_books(drawn: Drawn) -> None:
    """Two-term acceleration times two-term velocity: sines of one to four times the crank angle."""
    machine, (r, l, _), _ = drawn  # noqa: E741
    machine = replace(machine, mechanism=slider_crank(r, l), has_gravity=False)
    found = _columns(machine, TEXTBOOK, ONE_TURN)
    assert machine.masses is not None
    lam, mass = r / l, machine.masses.reciprocating
    coefficients = (lam / 4, -1 / 2, -3 * lam / 4, -(lam**2) / 4)
    harmonics = sum(c * np.sin(n * ONE_TURN.angle) for n, c in enumerate(coefficients, start=1))
    by_two_terms = found["inertia_force"] * found["piston_velocity"] / machine.speed
    _assert_equal(by_two_terms, mass * r**2 * machine.speed**2 * np.asarray(harmonics), 1e-13)


# Symmetry and scale

EVEN = ("piston_displacement", "piston_acceleration", "rod_angular_velocity", "inertia_force", "piston_force",
        "rod_force", "radial_force")  # fmt: skip
ODD = ("piston_velocity", "rod_angle", "rod_angular_acceleration", "side_force", "tangential_force", "crank_torque",
       "overturning_moment", "rod_transverse_force")  # fmt: skip


@MANY
@given(machines(has_gas=False, is_upright=False), st.sampled_from((EXACT, TEXTBOOK)))
def test_an_engine_in_a_mirror_runs_backwards(drawn: Drawn, method: Method) -> None:
    """Offset, inclination and angular acceleration change sides; what was at an angle is at minus that angle."""
    r, l, e = drawn.lengths  # noqa: E741
    machine = drawn.machine
    assert machine.cylinder is not None
    mirrored = replace(
        machine,
        mechanism=slider_crank(r, l, -e),
        angular_acceleration=-machine.angular_acceleration,
        cylinder=replace(machine.cylinder, inclination=-machine.cylinder.inclination),
    )
    one, other = _columns(machine, method, ONE_TURN), _columns(mirrored, method, ONE_TURN)
    for key in (*EVEN, *ODD):
        if key in one:
            backwards = other[key][::-1] * (1 if key in EVEN else -1)
            # the displacement counts from a dead centre that is a root of the difference of squares
            _assert_equal(one[key], backwards, 1e-13, l if key == "piston_displacement" else 0.0)


@MANY
@given(machines(has_gas=False), st.floats(0.1, 10.0), st.sampled_from((EXACT, TEXTBOOK)))
def test_a_larger_engine_has_larger_forces_at_the_same_speed(drawn: Drawn, k: float, method: Method) -> None:
    r, l, e = drawn.lengths  # noqa: E741
    machine = replace(drawn.machine, has_gravity=False)
    assert machine.masses is not None
    masses = replace(machine.masses, rod_inertia_excess=machine.masses.rod_inertia_excess * k**2)
    larger = replace(machine, mechanism=slider_crank(k * r, k * l, k * e), masses=masses)
    one, other = _columns(machine, method, ONE_TURN), _columns(larger, method, ONE_TURN)
    powers = dict.fromkeys(("piston_displacement", "piston_velocity", "piston_acceleration", "inertia_force",
                            "side_force", "tangential_force", "radial_force"), 1)  # fmt: skip
    powers |= {"rod_angle": 0, "rod_angular_acceleration": 0, "crank_torque": 2, "overturning_moment": 2}
    for key, power in powers.items():
        _assert_equal(other[key], one[key] * k**power, 2e-13, k * l if key == "piston_displacement" else 0.0)


@MANY
@given(machines(has_gas=False), st.floats(0.1, 10.0), st.sampled_from(METHODS))
def test_a_faster_engine_has_forces_larger_by_the_square(drawn: Drawn, k: float, method: Method) -> None:
    machine = replace(drawn.machine, has_gravity=False)
    faster = replace(machine, speed=k * machine.speed, angular_acceleration=k**2 * machine.angular_acceleration)
    one, other = _columns(machine, method, ONE_TURN), _columns(faster, method, ONE_TURN)
    powers = dict.fromkeys(("piston_acceleration", "rod_angular_acceleration", "inertia_force", "side_force",
                            "tangential_force", "radial_force", "crank_torque"), 2)  # fmt: skip
    powers |= {"piston_displacement": 0, "rod_angle": 0, "piston_velocity": 1, "rod_angular_velocity": 1}
    for key, power in powers.items():
        _assert_equal(other[key], one[key] * k**power, 1e-13)


@MANY
@given(machines(is_upright=False), st.sampled_from(METHODS))
def test_a_cycle_ends_as_it_began_bit_for_bit(drawn: Drawn, method: Method) -> None:
    solved = traced_cylinder(drawn.machine, method)
    ends = CrankGrid.from_degrees([0.0, 720.0])
    for key, (first, last) in columns(solved, ends, (*COLUMNS, *HARMONICS)).items():
        assert first == last or key == "crank_angle", key


# Approximations


@MANY
@given(machines(), st.sampled_from(["displacement", "velocity", "acceleration"]))
def test_the_two_orders_of_the_books_add_up_to_their_motion(drawn: Drawn, noun: str) -> None:
    r, l, _ = drawn.lengths  # noqa: E741
    machine = replace(drawn.machine, mechanism=slider_crank(r, l), angular_acceleration=0.0)
    solved = traced_cylinder(machine, TEXTBOOK)
    first, second, whole = (f"piston_{noun}{part}" for part in ("_first_order", "_second_order", ""))
    found = columns(solved, GRID, (first, second, whole))
    _assert_equal(found[first] + found[second], found[whole], 1e-15)


@for_each(
    ("ratio", "errors"),
    [(0.25, (0.0020, 0.0026, 0.0082)), (0.34, (0.0052, 0.0068, 0.0215)), (0.5, (0.018, 0.024, 0.077))],
)
def test_the_summary_says_by_how_much_the_two_terms_err(ratio: float, errors: tuple[float, float, float]) -> None:
    """In units of radius, of radius and speed, and of radius and speed squared."""
    r, w = 0.07, 130.0
    machine = Machine(slider_crank(r, r / ratio), w)
    summary = crankwork.analyse(machine, method=TEXTBOOK).summary
    assert not [key for key in crankwork.analyse(machine).summary if key.endswith("_error")]
    phi = np.linspace(0, 2 * np.pi, 720_001)
    sin_beta = ratio * np.sin(phi)
    cos_beta = np.sqrt(1 - sin_beta**2)
    rod_1 = ratio * np.cos(phi) / cos_beta
    exact = (
        1 - np.cos(phi) + (1 - cos_beta) / ratio,
        np.sin(phi) + np.cos(phi) * sin_beta / cos_beta,
        np.cos(phi) - np.sin(phi) * sin_beta / cos_beta + np.cos(phi) * rod_1 / cos_beta**2,
    )
    two_terms = (
        1 - np.cos(phi) + ratio / 2 * np.sin(phi) ** 2,
        np.sin(phi) + ratio / 2 * np.sin(2 * phi),
        np.cos(phi) + ratio * np.cos(2 * phi),
    )
    for i, noun in enumerate(("displacement", "velocity", "acceleration")):
        found = summary[f"piston_{noun}_error"] / (r * w**i)
        assert found == pytest.approx(np.max(np.abs(exact[i] - two_terms[i])), rel=1e-9)
        decimals = len(str(errors[i]).partition(".")[2])
        assert round(found, decimals) == pytest.approx(errors[i], abs=0.5 * 10**-decimals)
