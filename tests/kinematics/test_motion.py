"""The motion of a mechanism: the generic dyad against the closed form, errors of methods, and refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from crankwork.analysis.one_cylinder import analyse_engine
from crankwork.errors import GeometryError, MethodError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.piston import as_slider_crank, piston_motion
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import RRP, Crank, Mechanism, slider_crank
from crankwork.method import EXACT, TEXTBOOK, Method
from each import for_each

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.steps(1.0, 720.0)
SERIES = EXACT.named("series:60")

Lengths = tuple[float, float, float]  # crank radius, rod length, offset


def _placed(lengths: Lengths, turned: float, direction: int, pivot: tuple[float, float]) -> Mechanism:
    """Return a slider-crank whose cylinder points to `turned`, its guide point somewhere on the axis."""
    r, l, e = lengths  # noqa: E741
    side = turned + direction * math.pi / 2
    guide = (
        pivot[0] + e * math.cos(side) + 0.07 * math.cos(turned),
        pivot[1] + e * math.sin(side) + 0.07 * math.sin(turned),
    )
    crank = Crank(r, pivot, turned, 1 if direction > 0 else -1)
    return Mechanism(crank, (RRP("crank_pin", "piston_pin", "rod", l, guide, turned),))


PLACES = [(math.pi / 2, -1, (0.0, 0.0)), (0.0, 1, (0.0, 0.0)), (2.2, 1, (0.3, -0.1)), (-1.0, -1, (-0.2, 0.5))]
MACHINES: list[Lengths] = [(0.05, 0.2, 0.0), (0.05, 0.2, 0.03), (0.05, 0.08, -0.02)]


@for_each("machine", MACHINES)
@for_each(("turned", "direction", "pivot"), PLACES)
def test_the_generic_dyad_gives_the_motion_of_the_closed_form(
    machine: Lengths, turned: float, direction: int, pivot: tuple[float, float]
) -> None:
    r, l, e = machine  # noqa: E741
    mechanism = _placed(machine, turned, direction, pivot)
    moved, closed = linkage_motion(mechanism, GRID), piston_motion(SliderCrank(*machine), GRID)
    slider, rod = moved.sliders["piston_pin"], moved.links["rod"]
    # the guide point stands 0.07 m along the axis
    assert slider.position == pytest.approx(math.sqrt((r + l) ** 2 - e**2) - 0.07 - closed.piston.position, abs=5e-15)
    swing = np.exp(1j * (turned - direction * closed.rod.position))
    assert np.exp(1j * rod.position) == pytest.approx(swing, abs=1e-13)
    for order in (1, 2):
        assert slider[order] == pytest.approx(-closed.piston[order], abs=5e-15)
        assert rod[order] == pytest.approx(-direction * closed.rod[order], abs=1e-13)


@for_each("machine", MACHINES)
@for_each(("turned", "direction", "pivot"), PLACES)
def test_a_slider_crank_is_recognised_wherever_it_stands(
    machine: Lengths, turned: float, direction: int, pivot: tuple[float, float]
) -> None:
    found = as_slider_crank(_placed(machine, turned, direction, pivot))
    assert found is not None
    assert found == pytest.approx(machine, rel=1e-14, abs=1e-16)


@for_each("machine", MACHINES)
def test_the_upright_engine_is_the_slider_crank_of_its_lengths(machine: Lengths) -> None:
    assert as_slider_crank(slider_crank(*machine)) == pytest.approx(machine, rel=1e-15)


@for_each("machine", MACHINES)
def test_the_piston_of_the_upright_engine_is_at_its_place_at_zero_and_ninety_degrees(machine: Lengths) -> None:
    r, l, e = machine  # noqa: E741
    moved = linkage_motion(slider_crank(r, l, e), CrankGrid.from_degrees([0.0, 90.0]))
    x, y = moved.points["piston_pin"]
    assert x.position == pytest.approx([e, e], abs=1e-16)
    assert y.position == pytest.approx([r + math.sqrt(l**2 - e**2), math.sqrt(l**2 - (r - e) ** 2)], rel=1e-14)
    pin = moved.points["crank_pin"]
    assert pin.x.position == pytest.approx([0, r], abs=1e-16)
    assert pin.y.position == pytest.approx([r, 0], abs=1e-16)


@for_each("machine", MACHINES)
def test_crank_and_rod_keep_their_lengths_and_the_slider_its_guide(machine: Lengths) -> None:
    r, l, e = machine  # noqa: E741
    moved = linkage_motion(slider_crank(r, l, e), GRID)
    pin, piston = moved.points["crank_pin"], moved.points["piston_pin"]
    assert np.hypot(pin.x.position, pin.y.position) == pytest.approx(r, rel=1e-15)
    rod = np.hypot(piston.x.position - pin.x.position, piston.y.position - pin.y.position)
    assert rod == pytest.approx(l, rel=1e-14)
    assert piston.x.position == pytest.approx(e, abs=1e-16)
    along = moved.links["rod"].position
    assert piston.x.position - pin.x.position == pytest.approx(l * np.cos(along), abs=1e-15)
    assert piston.y.position - pin.y.position == pytest.approx(l * np.sin(along), abs=1e-15)


@for_each("branch", [1, -1])
@for_each("guide_angle", [0.0, 0.4, 2.0, -2.5])
def test_transfer_functions_of_the_dyad_are_derivatives_of_its_positions(branch: int, guide_angle: float) -> None:
    """Spectral derivatives, on a mechanism that is no slider-crank because its guide is not along the crank's zero."""
    samples = 128
    grid = CrankGrid.from_degrees(np.arange(samples) * (360 / samples))
    dyad = RRP("crank_pin", "slide", "rod", 0.25, (0.03, -0.02), guide_angle, 1 if branch > 0 else -1)
    moved = linkage_motion(Mechanism(Crank(0.05, (0.01, 0.02), 0.7), (dyad,)), grid)
    slide, rod = moved.points["slide"], moved.links["rod"]
    for position, first, second in (slide.x, slide.y, moved.sliders["slide"], rod):
        assert _spectral_derivative(np.unwrap(position)) == pytest.approx(first, abs=1e-13)
        assert _spectral_derivative(first) == pytest.approx(second, abs=1e-13)


@for_each("branch", [1, -1])
def test_the_direction_of_a_link_does_not_jump_by_a_turn(branch: int) -> None:
    dyad = RRP("crank_pin", "slide", "rod", 0.25, (0.03, -0.02), 0.4, 1 if branch > 0 else -1)
    direction = linkage_motion(Mechanism(Crank(0.05), (dyad,)), GRID).links["rod"].position
    assert np.max(np.abs(np.diff(direction))) < 0.01


def _spectral_derivative(values: np.ndarray) -> np.ndarray:
    waves = 1j * np.arange(values.size // 2 + 1)
    waves[-1] = 0
    return np.fft.irfft(waves * np.fft.rfft(values), values.size)


def test_the_other_branch_is_the_slider_behind_the_joint() -> None:
    mechanism = slider_crank(0.05, 0.2)
    behind = replace(mechanism, dyads=(replace(mechanism.dyads[0], branch=-1),))
    ahead, mirrored = linkage_motion(mechanism, GRID), linkage_motion(behind, GRID)
    half_a_turn = GRID.from_degrees(GRID.degrees + 180)
    assert mirrored.sliders["piston_pin"].position == pytest.approx(
        -linkage_motion(mechanism, half_a_turn).sliders["piston_pin"].position, abs=1e-15
    )
    assert np.all(ahead.sliders["piston_pin"].position > mirrored.sliders["piston_pin"].position)


def _largest_errors(machine: Lengths, method: Method) -> list[float]:
    """Return the largest errors of x, dx/dphi and d2x/dphi2 over a turn, in units of r; the speed is 1 rad/s."""
    found = analyse_engine(Machine(slider_crank(*machine), speed=1.0), method=method).summary
    keys = ("piston_displacement_error", "piston_velocity_error", "piston_acceleration_error")
    return [found[key] / machine[0] for key in keys]


@for_each(
    ("ratio", "x", "x_1", "x_2"),
    [(0.25, 0.0020, 0.0026, 0.0082), (0.34, 0.0052, 0.0068, 0.0215), (0.5, 0.018, 0.024, 0.077)],
)
def test_the_textbook_error_is_what_the_field_knows_it_to_be(ratio: float, x: float, x_1: float, x_2: float) -> None:
    """Largest error over a turn in units of r, to the digits given."""
    digits = 4 if ratio < 0.5 else 3
    shown = _largest_errors((0.06, 0.06 / ratio, 0.0), TEXTBOOK)
    assert [round(one, digits) for one in shown] == [x, x_1, x_2]


def test_the_error_of_a_long_series_is_almost_nothing() -> None:
    assert max(_largest_errors((0.06, 0.2, 0.01), SERIES)) < 2e-14


# --- refusals


def test_a_dyad_that_does_not_reach_names_link_slider_angle_and_millimetres() -> None:
    with pytest.raises(GeometryError, match=r"rod does not reach the guide of piston_pin at .* of 90 deg.* 10 mm"):
        linkage_motion(slider_crank(0.05, 0.04), CrankGrid.steps(1.0, 360.0))
    with pytest.raises(GeometryError, match=r"at a crank angle of 270 deg: it is 12\.5 mm too short"):
        linkage_motion(slider_crank(0.05, 0.06, 0.0225), CrankGrid.steps(1.0, 360.0))


def test_a_dyad_that_just_reaches_is_refused_because_it_jams() -> None:
    with pytest.raises(GeometryError, match="90 deg"):
        linkage_motion(slider_crank(0.05, 0.05), CrankGrid.steps(90.0, 180.0))


@for_each("name", ["", "Exact", "series", "series:", "series:0", "series:201", "series:1.5", "taylor"])
def test_a_method_that_does_not_exist_is_refused_with_those_that_do(name: str) -> None:
    with pytest.raises(MethodError, match=r"write exact, textbook or series:N,? .*from 1 to 200") as caught:
        EXACT.named(name)
    assert f'"{name}"' in str(caught.value)


def test_an_order_of_five_thousand_digits_is_refused_like_any_other_and_briefly() -> None:
    with pytest.raises(MethodError, match="series:N") as caught:
        EXACT.named("series:" + "1" * 5000)
    assert len(str(caught.value)) < 200


@for_each("name", ["exact", "textbook", "series:1", "series:200"])
def test_a_method_is_found_by_the_name_it_has(name: str) -> None:
    assert EXACT.named(name).name == name
    assert TEXTBOOK.named(name) == EXACT.named(name)
    assert EXACT.named(name).is_exact == (name == "exact")
    assert EXACT.named(name).rod == ("rigid" if name == "exact" else "two-mass")


def test_a_method_keeps_the_constants_it_was_given() -> None:
    assert replace(EXACT, pi=3.14, gravity=9.8).named("textbook") == replace(TEXTBOOK, pi=3.14, gravity=9.8)
