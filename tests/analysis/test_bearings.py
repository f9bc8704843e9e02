"""Bearings of linkages: as those of the engine that a linkage is, and by Newton's and Euler's equations in NumPy."""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np
import pytest

import crankwork
from crankwork import InputError, analyse, read_machine
from crankwork.description.shorthand import expanded
from crankwork.kinematics.crank_grid import CrankGrid
from expansions import of_linkage

pytestmark = pytest.mark.elsewhere

COUNT = 720
DEGREES = np.arange(COUNT) * 360.0 / COUNT
R, L, C, D, SPEED, TORQUE = 0.05, 0.2, 0.15, 0.21, 40.0, -25.0
# mass, moment of inertia, centre along and across each link [kg], [kg m2], [m]
CRANK, COUPLER, ROCKER = (1.2, 0.001, 0.02, 0.0), (0.8, 0.004, 0.09, 0.02), (1.1, 0.003, 0.06, -0.01)
FOUR_BAR = f"""
fixed_points = {{ O = ["0 mm", "0 mm"], E = ["{D} m", "0 mm"] }}
positions.B = ["150 mm", "140 mm"]
loads = [{{ kind = "torque", link = "rocker", torque = ["{TORQUE} N*m"] }}]
[crank]
pivot = "O"
pin = "A"
radius = "{R} m"
speed = "{SPEED} rad/s"
start = "30 deg"
direction = "DIRECTION"
mass = "{CRANK[0]} kg"
inertia = "{CRANK[1]} kg*m2"
centre = ["{CRANK[2]} m", "{CRANK[3]} m"]
[links.coupler]
joins = ["A", "B"]
length = "{L} m"
mass = "{COUPLER[0]} kg"
inertia = "{COUPLER[1]} kg*m2"
centre = ["{COUPLER[2]} m", "{COUPLER[3]} m"]
[links.rocker]
joins = ["E", "B"]
length = "{C} m"
mass = "{ROCKER[0]} kg"
inertia = "{ROCKER[1]} kg*m2"
centre = ["{ROCKER[2]} m", "{ROCKER[3]} m"]
[bearings]
rays = 24
pins = {{ A = {{ diameter = "30 mm", length = "20 mm" }}, B = {{ link = "rocker" }} }}
"""


def derivative(values: Any) -> Any:
    """Return the derivative of a periodic function of the crank angle, sampled evenly over a turn."""
    orders = np.fft.fftfreq(COUNT, 1.0 / COUNT)
    return np.fft.ifft(1j * orders * np.fft.fft(values))


class Forces(NamedTuple):
    """Forces on the crank at O, on the coupler at A, on the rocker at B and E as complex numbers, and the torque."""

    o: Any
    a: Any
    b: Any
    e: Any
    torque: Any  # That the driver gives, with the rotation [N m]
    crank: Any  # Directions of the links
    coupler: Any
    rocker: Any
    moment: Any  # Of all inertia about O


@functools.cache
def newton_euler(direction: int) -> Forces:
    """Return the forces in a four-bar from a system of nine equations at every crank angle."""
    crank = np.exp(1j * (math.radians(30) + direction * np.radians(DEGREES)))
    a = R * crank
    # the circles about A and E meet above the line between them
    way = D - a
    far = np.abs(way)
    along = (L**2 - C**2 + far**2) / (2 * far)
    b = a + way / far * (along + 1j * np.sqrt(L**2 - along**2))
    coupler, rocker = (b - a) / L, (b - D) / C
    forces, torques, centres = [], [], []
    for origin, line, (mass, inertia, u, v) in ((0, crank, CRANK), (a, coupler, COUPLER), (D, rocker, ROCKER)):
        centre = origin + line * (u + 1j * v)
        forces.append(mass * SPEED**2 * derivative(derivative(centre)))
        # of a direction exp(i theta) the second derivative has theta'' across it
        torques.append(inertia * SPEED**2 * (derivative(derivative(line)) / line).imag)
        centres.append(centre)
    matrix, right = np.zeros((COUNT, 9, 9)), np.zeros((COUNT, 9))
    places = {0: [(0, 0j, 1), (2, a, -1)], 1: [(2, a, 1), (4, b, -1)], 2: [(4, b, 1), (6, D + 0j, 1)]}
    for body, held in places.items():
        for column, place, sign in held:
            lever = place - centres[body]
            matrix[:, 3 * body, column] = matrix[:, 3 * body + 1, column + 1] = sign
            matrix[:, 3 * body + 2, column] = -sign * lever.imag
            matrix[:, 3 * body + 2, column + 1] = sign * lever.real
        right[:, 3 * body], right[:, 3 * body + 1] = forces[body].real, forces[body].imag
        right[:, 3 * body + 2] = torques[body] - (TORQUE if body == 2 else 0.0)
    matrix[:, 2, 8] = 1.0
    found = np.linalg.solve(matrix, right[..., None])[..., 0]
    o, at_a, at_b, e = (found[:, k] + 1j * found[:, k + 1] for k in (0, 2, 4, 6))
    arms = (np.conj(centre) * force for centre, force in zip(centres, forces, strict=True))
    moment = -sum(one.imag for one in arms) - sum(torques)
    return Forces(o, at_a, at_b, e, direction * found[:, 8], crank, coupler, rocker, moment)


@functools.cache
def four_bar(direction: int) -> crankwork.Results:
    word = "anticlockwise" if direction == 1 else "clockwise"
    return analyse(read_machine(FOUR_BAR.replace("DIRECTION", word)), CrankGrid.from_degrees(DEGREES))


DIRECTIONS = (1, -1)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_loads_in_the_frame_of_the_crank_are_those_of_newton_and_euler(direction):
    results, forces = four_bar(direction), newton_euler(direction)
    on_pin = -forces.a / forces.crank
    size = np.max(np.abs(forces.a))
    found = results.columns
    assert found["crankpin_radial_force.A"] == pytest.approx(-on_pin.real, rel=1e-9, abs=1e-9 * size)
    assert found["crankpin_tangential_force.A"] == pytest.approx(direction * on_pin.imag, rel=1e-9, abs=1e-9 * size)
    assert found["crankpin_load.A"] == pytest.approx(np.abs(forces.a), rel=1e-9)
    on_shaft = forces.o / forces.crank
    components = results.columns_at(DEGREES, ["bearing_force_x.O", "bearing_force_y.O"])
    assert components["bearing_force_x.O"] == pytest.approx(on_shaft.real, rel=1e-9, abs=1e-9 * size)
    assert components["bearing_force_y.O"] == pytest.approx(direction * on_shaft.imag, rel=1e-9, abs=1e-9 * size)
    assert found["main_journal_load.O"] == pytest.approx(np.abs(forces.o), rel=1e-9)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_means_and_extremes_are_those_of_fine_samples(direction):
    listing, forces = four_bar(direction).listings["bearing_loads"], newton_euler(direction)
    assert listing.names == ("O", "A", "B", "E")
    for at, force in enumerate((forces.o, forces.a, forces.b, forces.e)):
        load = np.abs(force)
        # of a smooth periodic function the mean of even samples has nearly all digits, and the peak of samples is near
        assert listing.columns["mean_bearing_load"][at] == pytest.approx(np.mean(load), rel=1e-9)
        assert listing.columns["bearing_load_max"][at] == pytest.approx(np.max(load), rel=3e-4)
        assert listing.columns["bearing_load_max"][at] >= np.max(load) * (1 - 1e-9)
        assert listing.columns["bearing_load_min"][at] == pytest.approx(np.min(load), rel=1e-3)
        ratio = listing.columns["bearing_load_max"][at] / np.mean(load)
        assert listing.columns["bearing_load_ratio"][at] == pytest.approx(ratio, rel=1e-9)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_a_load_reverses_along_the_rod_or_along_the_link_that_is_stated(direction):
    results, forces = four_bar(direction), newton_euler(direction)
    # of A along the coupler, of B along the rocker, which the file names, of E along the rocker
    along = {"A": forces.a / forces.coupler, "B": forces.b / forces.rocker, "E": forces.e / forces.rocker}
    for name, force in along.items():
        pressed = force.real < 0
        turned = np.flatnonzero(pressed != np.roll(pressed, 1))
        lengths = np.diff(np.append(turned, turned[0] + COUNT)) if turned.size else np.array([])
        longest = [max(lengths[pressed[turned] == side], default=0) for side in (True, False)]
        duration = min(longest) * 360.0 / COUNT
        assert math.degrees(results[f"reversal_duration.{name}"]) == pytest.approx(duration, abs=1.0), name
        peaks = max(-force.real.min(), 0.0), max(force.real.max(), 0.0)
        assert results[f"reversal_ratio.{name}"] == pytest.approx(min(peaks) / max(peaks), rel=1e-3), name
    assert "reversal_duration.O" not in results


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_wear_is_the_sum_of_the_loads_within_60_degrees_and_the_hole_stands_where_there_is_least(direction):
    results, forces = four_bar(direction), newton_euler(direction)
    for name, listing, force in (
        ("A", "crankpin_wear", -forces.a / forces.crank),
        ("O", "main_wear", forces.o / forces.crank),
    ):
        # angles count with the rotation, every 10 degrees
        load = (force.real + 1j * direction * force.imag)[::20]
        pressed = np.degrees(np.angle(-load))
        rays = np.arange(24) * 15.0
        apart = np.abs((rays - pressed[:, None] + 180.0) % 360.0 - 180.0)
        sums = np.sum(np.where(apart <= 60.0 + 1e-9, np.abs(load)[:, None], 0.0), axis=0)
        assert results.listings[listing].columns[f"wear_sum.{name}"] == pytest.approx(sums, rel=1e-9), name
        if name == "A":
            least = np.flatnonzero(sums == sums.min())
            # the rays without a load follow one another
            assert np.degrees(results["oil_hole_angle.A"]) == pytest.approx(np.mean(rays[least]), abs=1e-9)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_harmonics_are_the_fourier_coefficients_of_the_torque_that_is_delivered(direction):
    results, forces = four_bar(direction), newton_euler(direction)
    torque = -forces.torque
    assert results["balancing_torque"] == pytest.approx(forces.torque, rel=1e-9, abs=1e-9 * np.max(np.abs(torque)))
    assert results["total_torque"] == pytest.approx(torque, rel=1e-9, abs=1e-9 * np.max(np.abs(torque)))
    angle, columns = np.radians(DEGREES), results.listings["torque_harmonics"].columns
    assert columns["harmonic_order"].tolist() == list(range(1, 13))
    size = np.max(np.abs(torque))
    for at, order in enumerate(range(1, 13)):
        cosine, sine = 2 * np.mean(torque * np.cos(order * angle)), 2 * np.mean(torque * np.sin(order * angle))
        assert columns["total_harmonic_cosine"][at] == pytest.approx(cosine, abs=1e-9 * size)
        assert columns["total_harmonic_sine"][at] == pytest.approx(sine, abs=1e-9 * size)
        assert columns["total_harmonic_amplitude"][at] == pytest.approx(math.hypot(cosine, sine), abs=1e-9 * size)
        assert results[f"total_harmonic_phase.{order}"] == pytest.approx(math.atan2(sine, cosine), abs=1e-6)


def test_orders_of_the_shaking_moment_are_its_fourier_coefficients():
    results, forces = four_bar(1), newton_euler(1)
    assert results["shaking_moment"] == pytest.approx(forces.moment, abs=1e-9 * np.max(np.abs(forces.moment)))
    for order in (1, 2, 3, 4):
        amplitude = 2 * abs(np.mean(forces.moment * np.exp(-1j * order * np.radians(DEGREES))))
        assert results.summary[f"shaking_moment_amplitude.{order}"] == pytest.approx(amplitude, rel=1e-9)


def test_pressures_are_loads_over_diameter_and_length():
    results = four_bar(1)
    for word in ("", "_max"):
        load = results["bearing_load_max.A" if word else "mean_bearing_load.A"]
        assert results[f"bearing_pressure{word}.A"] == pytest.approx(load / (0.03 * 0.02), rel=1e-12)
    assert "bearing_pressure.B" not in results


@functools.cache
def both(name: str) -> tuple[crankwork.Results, crankwork.Results]:
    """Return the results of an engine and of the linkage that it is."""
    return analyse(crankwork.read(name)), of_linkage(read_machine(expanded(name)))


def test_an_engine_and_the_linkage_that_it_is_have_the_same_bearings_and_harmonics():
    engine, linkage = both("examples/petrol-four.toml")
    keys = ("radial", "tangential")
    there = linkage.columns_at(engine.grid, [f"crankpin_{key}_force.A1" for key in keys])
    for key in keys:
        column = engine.column(f"crankpin_{key}_force.1")
        size = np.max(np.abs(column))
        assert there[f"crankpin_{key}_force.A1"] == pytest.approx(column, rel=1e-9, abs=1e-9 * size), key
    for kind in ("mean_bearing_load", "bearing_load_max", "bearing_load_min", "bearing_load_ratio"):
        for mine, its in (("crankpin.1", "A1"), ("small_end", "B1")):
            assert linkage[f"{kind}.{its}"] == pytest.approx(engine[f"{kind}.{mine}"], rel=1e-9), (kind, its)
    sums = engine.listings["crankpin_wear"].columns["wear_sum.1"]
    assert linkage.listings["crankpin_wear"].columns["wear_sum.A1"] == pytest.approx(sums, rel=1e-9)
    assert linkage.summary["oil_hole_angle.A1"] == pytest.approx(engine.summary["oil_hole_angle"], rel=1e-9)
    for key in ("reversal_duration", "reversal_ratio"):
        assert linkage[f"{key}.B1"] == pytest.approx(engine.summary[key], rel=1e-9), key
    amplitudes = engine.listings["torque_harmonics"].columns["total_harmonic_amplitude"]
    found = linkage.listings["torque_harmonics"].columns["total_harmonic_amplitude"]
    assert found == pytest.approx(amplitudes, rel=1e-9, abs=1e-9 * np.max(amplitudes))


V_TWO = """
fixed_points = { O = ["0 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "40 mm", speed = "200 rad/s", points = { K = ["-20 mm", "30 mm"] } }
links.left = { joins = ["A", "B"], length = "140 mm", mass = "0.5 kg", centre = ["40 mm", "0 mm"] }
links.right = { joins = ["A", "C"], length = "140 mm", mass = "0.5 kg", centre = ["40 mm", "0 mm"] }
links.third = { joins = ["K", "F"], length = "150 mm", mass = "0.3 kg", centre = ["50 mm", "0 mm"] }
guides = { a = { through = "O", angle = "45 deg" }, b = { through = "O", angle = "135 deg" }, c = { through = "O" } }
sliders.one = { pin = "B", guide = "a", mass = "0.8 kg" }
sliders.two = { pin = "C", guide = "b", mass = "0.6 kg" }
sliders.three = { pin = "F", guide = "c", mass = "0.4 kg" }
"""


def test_of_several_rods_a_crankpin_bears_the_sum_and_the_arm_of_every_pin_is_its_own():
    results = analyse(read_machine(V_TWO), CrankGrid.from_degrees(DEGREES))
    force = {
        name: results[f"joint_force_x.{name}"] + 1j * results[f"joint_force_y.{name}"]
        for name in ("A_left", "A_right", "K")
    }
    turned = np.exp(1j * np.radians(DEGREES))
    arm = (-0.02 + 0.03j) / abs(-0.02 + 0.03j) * turned
    for name, on_rods, direction in (("A", force["A_left"] + force["A_right"], turned), ("K", force["K"], arm)):
        load = -on_rods / direction
        size = np.max(np.abs(load))
        assert results[f"crankpin_radial_force.{name}"] == pytest.approx(-load.real, abs=1e-9 * size), name
        assert results[f"crankpin_tangential_force.{name}"] == pytest.approx(load.imag, abs=1e-9 * size), name
        assert results[f"crankpin_load.{name}"] == pytest.approx(np.abs(load), rel=1e-9), name
        assert results.summary[f"mean_crankpin_load.{name}"] == pytest.approx(np.mean(np.abs(load)), rel=1e-6), name
        assert results.summary[f"crankpin_load_max.{name}"] == pytest.approx(np.max(np.abs(load)), rel=1e-3), name
    assert results.listings["bearing_loads"].names == ("O", "A_left", "B", "A_right", "C", "K", "F", "A")


CRANK_AND_PISTON = """
fixed_points = { O = ["0 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "40 mm", speed = "200 rad/s", start = "90 deg", direction = "clockwise" }
links.rod = { joins = ["A", "B"], length = "140 mm", mass = "0.5 kg", centre = ["40 mm", "0 mm"] }
guides.axis = { through = "O", angle = "90 deg" }
sliders.piston = { pin = "B", guide = "axis", mass = "0.8 kg" }
[bearings]
crankpin_diameter = "48 mm"
crankpin_length = "25 mm"
pin_diameter = "22 mm"
pin_length = "30 mm"
rays = 24
[bearings.pins]
A = { diameter = "48 mm", length = "25 mm" }
B = { diameter = "22 mm", length = "30 mm" }
"""


def test_one_table_has_the_sizes_of_an_engine_and_those_of_pins_and_pressures_are_the_same():
    results = analyse(read_machine(CRANK_AND_PISTON))
    every = results.complete
    for mine, its, area in (("A", "crankpin.1", 0.048 * 0.025), ("B", "small_end", 0.022 * 0.03)):
        for kind, load in (("bearing_pressure", "mean_bearing_load"), ("bearing_pressure_max", "bearing_load_max")):
            assert every[f"{kind}.{its}"] == pytest.approx(every[f"{kind}.{mine}"], rel=1e-9), kind
            assert every[f"{kind}.{mine}"] == pytest.approx(every[f"{load}.{mine}"] / area, rel=1e-12), kind
    # as many rays in both forms, with the same loads on them
    mine, its = (form.listings["crankpin_wear"].columns for form in (results, results.other))
    assert mine["wear_sum.A"] == pytest.approx(its["wear_sum.1"], rel=1e-9)
    assert mine["wear_sum.A"].size == 24


def test_a_crank_that_turns_back_has_no_bearings_over_a_cycle():
    text = FOUR_BAR.replace("DIRECTION", "anticlockwise").replace(f'length = "{C} m"', 'length = "55 mm"')
    with pytest.raises(InputError, match="this crank turns back"):
        read_machine(text)


@pytest.mark.parametrize(
    ("was", "written", "told"),
    [
        ("pins = { A", "pins = { X", 'there is no pin "X"; there is O, A, B, E'),
        ('link = "rocker"', 'link = "crank"', 'is no link of the pin "B", which joins rocker, coupler'),
        ("rays = 24", "rays = 10", "12 or 24"),
    ],
)  # fmt: skip
def test_mistakes_are_told_with_what_there_is(was, written, told):
    text = FOUR_BAR.replace("DIRECTION", "anticlockwise")
    with pytest.raises(InputError) as caught:
        read_machine(text.replace(was, written))
    assert told in str(caught.value)
