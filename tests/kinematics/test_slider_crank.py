"""Exact slider-crank kinematics against forty digits, up to where the crank barely turns."""

import functools
import itertools
from typing import Any

import mpmath
import numpy as np
import pytest

from crankwork.errors import GeometryError
from crankwork.formula.expression import FORMULAS, Expression, Number, Operation, Symbol, record
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.piston import exact_piston, piston_motion, textbook_piston
from crankwork.kinematics.slider_crank import SliderCrank, check_slider_crank, rod_cosine, rod_swing
from each import for_each

pytestmark = pytest.mark.elsewhere

RADIUS, LIMIT = 0.075, 0.999999

# rod ratio, and offset over the largest offset with which the crank turns
CENTRAL = [(ratio, 0.0) for ratio in (1e-8, 1e-3, 0.25, 0.34, 0.5, 0.9, 0.99, LIMIT)]
SHARES = [side * share for share in (1e-6, 0.1, LIMIT) for side in (-1, 1)]
OFFSET = [(ratio, share) for ratio in (1e-3, 0.25, 0.5, 0.99) for share in SHARES]


def _machine(ratio: float, share: float) -> SliderCrank:
    """Return a machine whose radius and offset together are, with a share of 0.999999, that part of the rod."""
    rod = RADIUS / ratio
    limit = rod * LIMIT - RADIUS if abs(share) == LIMIT else abs(share) * (rod - RADIUS)
    return SliderCrank(RADIUS, rod, float(np.copysign(limit, share)) if share else 0.0)


def _angles(machine: SliderCrank) -> Array:
    """Return every degree of two turns, and angles ever closer to dead centres and to 90 and 270 degrees."""
    critical = [np.degrees(machine.top_dead_centre), np.degrees(machine.bottom_dead_centre), 90.0, 270.0]
    near = [angle + side * 10.0**-k for angle in critical for k in range(7) for side in (-1, 1)]
    return np.concatenate([np.arange(0.0, 361.0), near, critical])


@functools.cache
def _forty_digits(machine: SliderCrank) -> tuple[Array, ...]:
    """Return angle, x, x', x'', rod angle and its two derivatives, from the closed form of the positions.

    With s = r sin(phi) - e across the axis and h = sqrt(l^2 - s^2) along it, x = top - r cos(phi) - h; the
    derivatives of h come from differentiating h^2 + s^2 = l^2 once and twice.
    """
    degrees = _angles(machine)
    rows = []
    with mpmath.workdps(40):
        r, l, e = map(mpmath.mpf, machine)  # noqa: E741 - the rod length of the subject
        for angle in degrees:
            phi = mpmath.radians(mpmath.mpf(angle))
            sin, cos = mpmath.sin(phi), mpmath.cos(phi)
            s, s_1, s_2 = r * sin - e, r * cos, -r * sin
            h = mpmath.sqrt(l**2 - s**2)
            h_1 = -s * s_1 / h
            h_2 = -(s * s_2 + s_1**2 + h_1**2) / h
            beta_1 = s_1 / h
            rows.append((
                mpmath.sqrt((r + l) ** 2 - e**2) - r * cos - h,
                r * sin - h_1,
                r * cos - h_2,
                mpmath.asin(s / l),
                beta_1,
                s_2 / h - s_1 * h_1 / h**2,
            ))  # fmt: skip
        exact = np.array(rows, dtype=object).T
        rounded = exact.astype(float)
        return degrees, *np.stack([rounded, (exact - rounded).astype(float)], axis=1)


def _error(shown: Array, exact: Array) -> float:
    """Return the largest difference; `exact` is the rounded value and what its rounding left over."""
    return float(np.max(np.abs((shown - exact[0]) - exact[1])))


def _largest(exact: Array) -> float:
    return float(np.max(np.abs(exact[0])))


every_machine = for_each("machine", [_machine(*one) for one in CENTRAL + OFFSET])
every_offset = for_each("machine", [_machine(*one) for one in OFFSET])


@every_machine
def test_displacement_is_exact_to_a_part_in_ten_trillion_of_half_the_stroke(machine: SliderCrank) -> None:
    degrees, x, *_ = _forty_digits(machine)
    shown = piston_motion(machine, CrankGrid.from_degrees(degrees)).piston.position
    # half the stroke is the radius, unless the offset lengthens it; with an offset the displacement is a difference
    # of lengths, so a rod of a thousand radii leaves a few roundings of its own length
    assert _error(shown, x) < max(1e-13 * machine.stroke / 2, 1e-15 * machine.rod_length)


@every_machine
@for_each("order", [1, 2])
def test_transfer_functions_are_exact_relative_to_their_largest_value(machine: SliderCrank, order: int) -> None:
    degrees, *exact = _forty_digits(machine)
    shown = piston_motion(machine, CrankGrid.from_degrees(degrees)).piston
    assert _error(shown[order], exact[order]) < 1e-13 * _largest(exact[order])


@every_machine
def test_rod_angle_and_its_derivatives_are_exact(machine: SliderCrank) -> None:
    degrees, _, _, _, beta, beta_1, beta_2 = _forty_digits(machine)
    rod = piston_motion(machine, CrankGrid.from_degrees(degrees)).rod
    assert _error(rod.position, beta) < 1e-13 * max(_largest(beta), machine.rod_ratio)
    assert _error(rod.position_1, beta_1) < 1e-13 * _largest(beta_1)
    assert _error(rod.position_2, beta_2) < 1e-13 * _largest(beta_2)


@for_each("share", [-0.5, 1e-3, 0.1, LIMIT])
@for_each("ratio", [1e-3, 0.25, 0.99, 1 - 1e-9])
def test_displacement_with_offset_near_the_top_is_that_of_forty_digits(ratio: float, share: float) -> None:
    """Where it all but vanishes, it errs by less than a rounding of the lengths that are left over there."""
    machine = _machine(ratio, share) if ratio < LIMIT else SliderCrank(1.0, 1 / ratio, share * (1 / ratio - 1))
    top = float(np.degrees(machine.top_dead_centre))
    grid = CrankGrid.from_degrees([top + side * 10.0**-k for k in range(-1, 7) for side in (-1, 1)])
    shown = piston_motion(machine, grid).piston.position
    with mpmath.workdps(40):
        r, l, e = map(mpmath.mpf, machine)  # noqa: E741
        for degrees, found in zip(grid.degrees, shown, strict=True):
            phi = mpmath.radians(mpmath.mpf(float(degrees)))
            along = r * mpmath.cos(phi) + mpmath.sqrt(l**2 - (r * mpmath.sin(phi) - e) ** 2)
            expected = mpmath.sqrt((r + l) ** 2 - e**2) - along
            assert abs(found - expected) < 1e-15 * max(r, abs(e)), degrees


@every_machine
def test_the_printed_cosine_of_the_rod_is_the_safe_one(machine: SliderCrank) -> None:
    with mpmath.workdps(40):
        r, l, e = map(mpmath.mpf, machine)  # noqa: E741
        for degrees in (0.0, 33.0, 89.9999, 90.0, 215.0, 270.0):
            sin_phi = mpmath.sin(mpmath.radians(mpmath.mpf(degrees)))
            values = {
                "sin_beta": (r * sin_phi - e) / l, "r": r, "l": l, "e": e,
                "less_sin_phi": 1 - sin_phi, "more_sin_phi": 1 + sin_phi,
            }  # fmt: skip
            safe, printed = (_in_mpmath(record(one), values) for one in (SHOWN.function, SHOWN.shown))
            assert abs(safe / printed - 1) < mpmath.mpf(10) ** -30


SHOWN = FORMULAS[rod_cosine.__name__]


def _in_mpmath(tree: Expression, values: dict[str, Any]) -> Any:
    match tree:
        case Symbol(name):
            return values[name]
        case Number(value):
            return mpmath.mpf(value)
        case Operation(np.sqrt, (operand,)):
            return mpmath.sqrt(_in_mpmath(operand, values))
        case Operation(function, operands):
            return function(*(_in_mpmath(one, values) for one in operands))
    raise TypeError(tree)


@every_machine
def test_sines_and_cosines_of_the_rod_belong_to_angles(machine: SliderCrank) -> None:
    swing = rod_swing(machine, CrankGrid.from_degrees(_angles(machine)))
    assert np.all(swing.cos > 0)
    assert np.max(np.abs(swing.sin**2 + swing.cos**2 - 1)) < 1e-15
    assert np.max(np.abs(swing.sin_sum**2 + swing.cos_sum**2 - 1)) < 2e-15


@for_each("offset", [0.0, 0.01, -0.01])
def test_a_second_turn_repeats_the_first_bit_for_bit(offset: float) -> None:
    machine = SliderCrank(RADIUS, 0.3, offset)
    degrees = np.arange(0, 361, 0.5)
    first = piston_motion(machine, CrankGrid.from_degrees(degrees))
    for turn in (360.0, -720.0):
        other = piston_motion(machine, CrankGrid.from_degrees(degrees + turn))
        for one, two in zip((*first.piston, *first.rod), (*other.piston, *other.rod), strict=True):
            assert one.tobytes() == two.tobytes()


@for_each("offset", [0.0, 0.012, -0.012, 0.2])
def test_the_mirrored_machine_turned_backwards_moves_alike(offset: float) -> None:
    degrees = np.arange(0, 361.0)
    one = piston_motion(SliderCrank(RADIUS, 0.3, offset), CrankGrid.from_degrees(degrees))
    two = piston_motion(SliderCrank(RADIUS, 0.3, -offset), CrankGrid.from_degrees(-degrees))
    for (x, x_1, x_2), (y, y_1, y_2), sign in ((one.piston, two.piston, 1), (one.rod, two.rod, -1)):
        assert np.array_equal(x, sign * y)
        assert np.array_equal(x_1, -sign * y_1)
        assert np.array_equal(x_2, sign * y_2)


@for_each("offset", [0.0, 0.012])
@for_each(("factor", "tolerance"), [(2.0, 0.0), (1000.0, 2e-15), (1e-3, 2e-15)])
def test_lengths_scale_the_motion_and_leave_the_angles(offset: float, factor: float, tolerance: float) -> None:
    grid = CrankGrid.steps(1.0, 360.0)
    small = piston_motion(SliderCrank(RADIUS, 0.3, offset), grid)
    large = piston_motion(SliderCrank(RADIUS * factor, 0.3 * factor, offset * factor), grid)
    for one, two in zip(small.piston, large.piston, strict=True):
        assert np.max(np.abs(two - factor * one)) <= tolerance * factor * np.max(np.abs(one)) * 2
    for one, two in zip(small.rod, large.rod, strict=True):
        assert np.max(np.abs(two - one)) <= tolerance * np.max(np.abs(one)) * 2


@for_each("offset", [0.0, 0.4])
def test_textbook_approaches_exact_with_the_cube_of_the_ratio(offset: float) -> None:
    """Halving the ratio divides the error by eight; with offset, e/r held, the next term of the root is a cube too."""
    grid = CrankGrid.steps(1.0, 360.0)
    errors = []
    for ratio in (0.04, 0.02, 0.01):
        machine = SliderCrank(1.0, 1 / ratio, offset)
        exact, approximate = (
            exact_piston(machine, grid, rod_swing(machine, grid), machine.rod_ratio),
            textbook_piston(machine, grid, machine.rod_ratio),
        )
        errors.append([
            float(np.ptp(exact.position - approximate.position)) if offset else _gap(exact, approximate, 0),
            _gap(exact, approximate, 1),
            _gap(exact, approximate, 2),
        ])  # fmt: skip
    for coarse, fine in itertools.pairwise(errors):
        for one, other in zip(coarse, fine, strict=True):
            assert one / other == pytest.approx(8, rel=0.01)


def _gap(exact: tuple[Array, ...], approximate: tuple[Array, ...], order: int) -> float:
    return float(np.max(np.abs(exact[order] - approximate[order])))


def test_textbook_displacement_with_offset_counts_from_top_dead_centre_to_the_order_it_has() -> None:
    """The two-term displacement starts at the crank angle zero, where a small offset leaves second-order distance."""
    machine = SliderCrank(1.0, 4.0, 0.1)
    grid = CrankGrid.steps(1.0, 360.0)
    exact, approximate = (
        exact_piston(machine, grid, rod_swing(machine, grid), machine.rod_ratio),
        textbook_piston(machine, grid, machine.rod_ratio),
    )
    assert _gap(exact, approximate, 0) < 0.0020 + 0.25 * 0.1**2


@for_each("ratio", [1e-4, 1e-6, 1e-8])
def test_a_very_long_rod_leaves_a_pure_cosine(ratio: float) -> None:
    grid = CrankGrid.steps(1.0, 360.0)
    x, x_1, x_2 = piston_motion(SliderCrank(RADIUS, RADIUS / ratio), grid).piston
    second_order = RADIUS * ratio * (1 + 1e-6)
    assert np.max(np.abs(x - RADIUS * (1 - grid.cos))) <= second_order / 2
    assert np.max(np.abs(x_1 - RADIUS * grid.sin)) <= second_order / 2
    assert np.max(np.abs(x_2 - RADIUS * grid.cos)) <= second_order


# --- dead centres and stroke


@every_offset
def test_dead_centres_are_those_of_forty_digits(machine: SliderCrank) -> None:
    with mpmath.workdps(40):
        r, l, e = map(mpmath.mpf, machine)  # noqa: E741
        top, bottom = mpmath.asin(e / (l + r)), mpmath.pi + mpmath.asin(e / (l - r))
        assert abs(machine.top_dead_centre / top - 1) < 1e-14
        assert abs(machine.bottom_dead_centre / bottom - 1) < 1e-14


@for_each(("ratio", "share"), [one for one in OFFSET if one[0] > 0.1 and abs(one[1]) < LIMIT])
def test_crank_and_rod_are_in_line_at_the_dead_centres_and_the_piston_stands_still(ratio: float, share: float) -> None:
    machine = _machine(ratio, share)
    grid = CrankGrid.from_radians([machine.top_dead_centre, machine.bottom_dead_centre])
    (x, x_1, _), _, swing = piston_motion(machine, grid)
    assert np.max(np.abs(swing.sin_sum)) < 1e-15
    assert np.max(np.abs(x_1)) < 1e-14 * RADIUS
    assert abs(x[0]) < 1e-14 * RADIUS
    assert x[1] == pytest.approx(machine.stroke, rel=1e-14)


@every_offset
def test_the_stroke_with_offset_is_that_of_forty_digits_and_longer_than_two_radii(machine: SliderCrank) -> None:
    with mpmath.workdps(40):
        r, l, e = map(mpmath.mpf, machine)  # noqa: E741
        expected = mpmath.sqrt((l + r) ** 2 - e**2) - mpmath.sqrt((l - r) ** 2 - e**2)
        assert abs(machine.stroke / expected - 1) < 1e-13
        assert expected > 2 * r


def test_the_stroke_without_offset_is_two_radii() -> None:
    machine = SliderCrank(RADIUS, 0.3)
    assert machine.stroke == 2 * RADIUS
    assert (machine.top_dead_centre, machine.bottom_dead_centre) == (0, np.pi)


def test_an_offset_moves_both_dead_centres_towards_itself() -> None:
    machine = SliderCrank(0.05, 0.2, 0.03)
    assert np.sin(machine.top_dead_centre) == pytest.approx(0.03 / 0.25, rel=1e-15)
    assert np.sin(machine.bottom_dead_centre) == pytest.approx(-0.03 / 0.15, rel=1e-14)


# --- a batch of designs


@for_each("offsets", [(0.0, 0.0), (0.01, -0.02)])
def test_a_row_of_a_batch_is_the_single_machine(offsets: tuple[float, float]) -> None:
    grid = CrankGrid.steps(1.0, 360.0)
    lengths = [(0.05, 0.2, offsets[0]), (0.06, 0.18, offsets[1])]
    batch = SliderCrank(*(np.array(column)[:, None] for column in zip(*lengths, strict=True)))
    together = exact_piston(batch, grid, rod_swing(batch, grid), batch.rod_ratio)
    for row, one in enumerate(lengths):
        machine = SliderCrank(*one)
        for shown, alone in zip(
            together, exact_piston(machine, grid, rod_swing(machine, grid), machine.rod_ratio), strict=True
        ):
            assert np.array_equal(shown[row], alone)


# --- refusals


@for_each(
    ("lengths", "missing"),
    [((0.05, 0.04, 0.0), "10"), ((0.05, 0.06, 0.02), "10"), ((0.05, 0.06, -0.0125), "2.5"), ((0.05, 0.05, 0.0), "0")],
)
def test_a_rod_too_short_is_refused_with_the_millimetres_that_are_missing(
    lengths: tuple[float, float, float], missing: str
) -> None:
    with pytest.raises(GeometryError, match=rf"misses {missing} mm: lengthen the rod"):
        check_slider_crank(SliderCrank(*lengths))


def test_a_refusal_names_the_lengths_it_compared() -> None:
    with pytest.raises(GeometryError, match=r"rod \(60 mm\) must be longer .* \(50 \+ 20 mm\)"):
        check_slider_crank(SliderCrank(0.05, 0.06, -0.02))


@for_each("lengths", [(0.05, 0.0500001, 0.0), (0.05, 0.07, 0.0199), (0.05, 0.07, -0.0199)])
def test_a_rod_that_is_just_long_enough_is_accepted(lengths: tuple[float, float, float]) -> None:
    check_slider_crank(SliderCrank(*lengths))


@for_each("lengths", [(float("nan"), 0.2, 0.0), (0.05, float("nan"), 0.0), (0.05, 0.2, float("nan"))])
def test_lengths_that_are_not_numbers_are_refused(lengths: tuple[float, float, float]) -> None:
    with pytest.raises(GeometryError):
        check_slider_crank(SliderCrank(*lengths))
