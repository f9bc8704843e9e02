"""The indicator diagram: laws between points, their work, and every way in which a diagram does not hang together."""

import itertools
import math
from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import DiagramError, DiagramPoint, IndicatorDiagram, Law, Piece, solve_diagram
from each import for_each

pytestmark = pytest.mark.elsewhere

P0 = 1e5
DEAD_CENTRES = (0.0, 180.0)


def volume_at(degrees: Array) -> Array:
    """Return the volume of a cylinder of 500 cm3 with an infinite rod and a compression ratio of 9. [m3]"""
    return np.asarray(6.25e-5 + 2.5e-4 * (1 - np.cos(np.radians(degrees))))


def _solve(
    points: Mapping[str, tuple[float | None, float | None]], *pieces: Piece, cycle: float = 720.0
) -> IndicatorDiagram:
    named = {name: DiagramPoint(*values) for name, values in points.items()}
    return solve_diagram(named, pieces, cycle, volume_at, dead_centres=DEAD_CENTRES)


def _error(points: Mapping[str, tuple[float | None, float | None]], *pieces: Piece) -> tuple[str, str]:
    """Return the key and the text of what is told of a diagram that is none."""
    with pytest.raises(DiagramError) as caught:
        _solve(points, *pieces)
    return caught.value.key, str(caught.value)


def _between(law: Law, *points: str, exponent: float | None = None, reference: str | None = None) -> Piece:
    return Piece(law, points, exponent, reference)


OTTO_POINTS: dict[str, tuple[float | None, float | None]] = {
    "r": (0.0, P0), "a": (180.0, None), "c": (360.0, None), "z": (360.0, 5e6),
    "b": (540.0, None), "b0": (540.0, P0), "r0": (720.0, None),
}  # fmt: skip
OTTO_PIECES = (
    _between("constant", "r", "a"),
    _between("polytropic", "a", "c", exponent=1.35),
    _between("polytropic", "z", "b", exponent=1.25),
    _between("constant", "b0", "r0"),
)


def _pressure(diagram: IndicatorDiagram, *degrees: float) -> list[float]:
    at = np.array(degrees)
    return [float(one) for one in diagram.pressure(at, volume_at(at))]


def _work_by_quadrature(diagram: IndicatorDiagram) -> float:
    """Return the integral of p dV/dphi by an adaptive rule between the breaks. [J]"""

    def integrand(degrees: float) -> float:
        rate = 2.5e-4 * math.sin(math.radians(degrees)) * math.pi / 180
        return _pressure(diagram, degrees)[0] * rate

    parts = [
        quad(integrand, start + 1e-12, end, epsabs=1e-9, epsrel=1e-13, limit=200)[0]
        for start, end in itertools.pairwise(diagram.breaks)
    ]
    return float(sum(parts))


class TestWork:
    def test_intake_and_exhaust_at_one_pressure_do_no_work(self) -> None:
        diagram = _solve({"r": (0.0, P0), "r0": (720.0, None)}, _between("constant", "r", "r0"))
        assert abs(diagram.work(volume_at)) < 1e-12

    def test_a_constant_does_pressure_times_change_of_volume(self) -> None:
        points = {"a": (0.0, 2e5), "b": (180.0, None), "c": (180.0, 1e5), "d": (360.0, None), "e": (360.0, 2e5)}
        diagram = _solve(
            points, _between("constant", "a", "b"), _between("constant", "c", "d"), _between("rounded", "d", "e"),
            cycle=360.0,
        )  # fmt: skip
        assert diagram.work(volume_at) == pytest.approx((2e5 - 1e5) * 5e-4, rel=1e-14)

    @for_each("exponent", [0.0, 0.5, 1.0, 1.25, 1.4, 3.0])
    def test_an_otto_cycle_does_its_textbook_work(self, exponent: float) -> None:
        """Compression to and expansion from 9 times the volume, the fourfold pressure after the vertical line."""
        top = P0 * 9**exponent
        points = {**OTTO_POINTS, "z": (360.0, 4 * top)}
        pieces = [OTTO_PIECES[0], OTTO_PIECES[3]]
        pieces[1:1] = [_between("polytropic", *names, exponent=exponent) for names in ("ac", "zb")]
        work = _solve(points, *pieces).work(volume_at)
        small, large = 6.25e-5, 5.625e-4
        isothermal = P0 * large * math.log(9)
        compression = isothermal if exponent == 1 else (top * small - P0 * large) / (exponent - 1)
        assert work == pytest.approx(3 * compression, rel=1e-13)

    @for_each("excess", [0.0, 1e-12, 1e-8, -1e-8, 1e-6, -1e-4])
    def test_an_exponent_next_to_one_does_nearly_isothermal_work(self, excess: float) -> None:
        """The work of compression is p V ln 9 (9^k - 1) / (k ln 9), in which expm1 keeps all digits."""
        pieces = (OTTO_PIECES[0], _between("polytropic", "a", "c", exponent=1 + excess), *OTTO_PIECES[2:])
        compression, expansion = _solve(OTTO_POINTS, *pieces).segments[1:3]
        k = (1 + excess) - 1
        expected = P0 * 5.625e-4 * (math.expm1(k * math.log(9)) / k if k else math.log(9))
        assert -compression.work(volume_at) == pytest.approx(expected, rel=1e-12)
        assert expansion.work(volume_at) > -compression.work(volume_at)

    @for_each("exponent", [1.0, 1.2, 1.4])
    def test_the_closed_forms_agree_with_numerical_quadrature(self, exponent: float) -> None:
        pieces = (OTTO_PIECES[0], _between("polytropic", "a", "c", exponent=exponent), *OTTO_PIECES[2:])
        diagram = _solve(OTTO_POINTS, *pieces)
        assert diagram.work(volume_at) == pytest.approx(_work_by_quadrature(diagram), rel=1e-9)

    def test_the_work_of_a_rounded_piece_agrees_with_numerical_quadrature(self) -> None:
        points = {"r": (0.0, P0), "a": (180.0, 0.8e5), "c": (350.0, 2e6), "z": (372.0, 5e6), "b": (500.0, 6e5),
                  "e": (560.0, P0), "r0": (720.0, P0)}  # fmt: skip
        diagram = _solve(points, _between("rounded", *points))
        assert diagram.work(volume_at) == pytest.approx(_work_by_quadrature(diagram), rel=1e-9)

    def test_a_vertical_line_does_no_work(self) -> None:
        """The Otto cycle with its combustion drawn as a piece of its own, and without it."""
        with_line = (*OTTO_PIECES[:2], _between("rounded", "c", "z"), *OTTO_PIECES[2:])
        assert _solve(OTTO_POINTS, *with_line).work(volume_at) == _solve(OTTO_POINTS, *OTTO_PIECES).work(volume_at)

    @given(st.floats(0.5, 2.0), st.floats(0.2, 3.0).filter(lambda n: abs(n - 1) > 1e-6), st.floats(0.05, 20.0))
    def test_pressures_scaled_do_work_scaled(self, factor: float, exponent: float, scale: float) -> None:
        def work(by: float) -> float:
            points = {name: (at, one and one * by) for name, (at, one) in OTTO_POINTS.items()}
            points["z"] = (360.0, 5e6 * factor * by)
            pieces = (OTTO_PIECES[0], _between("polytropic", "a", "c", exponent=exponent), *OTTO_PIECES[2:])
            return _solve(points, *pieces).work(volume_at)

        # the work of compression may nearly cancel that of expansion
        assert work(scale) == pytest.approx(scale * work(1.0), rel=1e-12, abs=1e-9 * scale)


class TestPressure:
    def test_a_polytrope_follows_the_volume(self) -> None:
        diagram = _solve(OTTO_POINTS, *OTTO_PIECES)
        at = np.linspace(181, 360, 50)
        expected = polytropic_pressure(P0, 5.625e-4, volume_at(at), 1.35)
        assert diagram.pressure(at, volume_at(at)) == pytest.approx(expected, rel=1e-14)

    def test_a_breakpoint_belongs_to_the_piece_that_ends_there(self) -> None:
        diagram = _solve(OTTO_POINTS, *OTTO_PIECES)
        before, beyond = _pressure(diagram, 360.0, math.nextafter(360.0, 361.0))
        assert before == pytest.approx(P0 * 9**1.35, rel=1e-14)
        assert beyond == pytest.approx(5e6, rel=1e-14)
        assert _pressure(diagram, 540.0)[0] == pytest.approx(5e6 / 9**1.25, rel=1e-14)
        assert _pressure(diagram, math.nextafter(540.0, 541.0)) == [P0]

    @for_each("step", [0.5, 1.0, 7.0, 45.0, 360.0])
    def test_the_pressure_at_an_angle_does_not_depend_on_the_other_angles(self, step: float) -> None:
        diagram = _solve(OTTO_POINTS, *OTTO_PIECES)
        at = np.arange(0.0, 720.1, step)
        together = diagram.pressure(at, volume_at(at)).tolist()
        assert together == [_pressure(diagram, one)[0] for one in at]

    def test_the_cycle_ends_with_the_pressure_it_starts_with(self) -> None:
        assert _pressure(_solve(OTTO_POINTS, *OTTO_PIECES), 0.0, 720.0) == [P0, P0]

    def test_a_rounded_piece_passes_through_its_points(self) -> None:
        points = {"r": (0.0, P0), "m": (100.0, 2e5), "n": (101.0, 7e5), "r0": (720.0, P0)}
        diagram = _solve(points, _between("rounded", *points))
        assert _pressure(diagram, 0.0, 100.0, 101.0, 720.0) == [P0, 2e5, 7e5, P0]
        assert diagram.breaks.tolist() == [0.0, 100.0, 101.0, 720.0]

    def test_a_printed_volume_replaces_that_of_the_cylinder(self) -> None:
        points = {name: DiagramPoint(*values) for name, values in OTTO_POINTS.items()}
        points["a"] = DiagramPoint(180.0, P0, volume=6e-4)
        diagram = solve_diagram(points, OTTO_PIECES, 720.0, volume_at, dead_centres=DEAD_CENTRES)
        assert _pressure(diagram, 360.0) == pytest.approx([P0 * (6e-4 / 6.25e-5) ** 1.35], rel=1e-14)

    def test_a_polytrope_may_pass_through_a_state_that_is_not_its_start(self) -> None:
        points = {**OTTO_POINTS, "y": (360.0, 4.2e6), "z3": (375.0, None)}
        pieces = (
            *OTTO_PIECES[:2],
            _between("polytropic", "y", "z3", exponent=0.0),
            _between("polytropic", "z3", "b", exponent=1.25, reference="z"),
            OTTO_PIECES[3],
        )
        diagram = _solve(points, *pieces)
        assert _pressure(diagram, 370.0) == [4.2e6]
        assert _pressure(diagram, 540.0) == pytest.approx([5e6 / 9**1.25], rel=1e-14)

    def test_the_corners_of_the_diagram_are_its_breaks_and_points(self) -> None:
        diagram = _solve(OTTO_POINTS, *OTTO_PIECES)
        assert diagram.breaks.tolist() == [0.0, 180.0, 360.0, 540.0, 720.0]
        assert diagram.named["c"] == (360.0, pytest.approx(P0 * 9**1.35, rel=1e-14))
        assert diagram.named["b"] == (540.0, pytest.approx(5e6 / 9**1.25, rel=1e-14))


class TestAngleFoundByPressure:
    @staticmethod
    def _compressor(delivery: float = 4e5, exponent: float = 1.3) -> IndicatorDiagram:
        points = {"a": (0.0, delivery), "b": (None, P0), "c": (180.0, None), "d": (None, delivery), "e": (360.0, None)}
        return _solve(
            points,
            _between("polytropic", "a", "b", exponent=exponent),
            _between("constant", "b", "c"),
            _between("polytropic", "c", "d", exponent=exponent),
            _between("constant", "d", "e"),
            cycle=360.0,
        )

    @given(st.floats(1.1e5, 8.9e5), st.floats(1.0, 1.67))
    def test_the_angle_is_where_the_polytrope_has_the_pressure(self, delivery: float, exponent: float) -> None:
        diagram = self._compressor(delivery, exponent)
        (opens, _), (delivers, _) = diagram.named["b"], diagram.named["d"]
        small, large = 6.25e-5, 5.625e-4
        expand, compress = (volume_at(np.array([one]))[0] for one in (opens, delivers))
        assert expand == pytest.approx(small * (delivery / P0) ** (1 / exponent), rel=1e-13)
        assert compress == pytest.approx(large * (P0 / delivery) ** (1 / exponent), rel=1e-13)
        assert 0 < opens < 180 < delivers < 360

    def test_a_pressure_reached_at_the_dead_centre_itself_is_found_there(self) -> None:
        points = {"a": (0.0, P0), "b": (180.0, None), "c": (None, 9 * P0), "c0": (360.0, P0), "d": (720.0, None)}
        diagram = _solve(
            points,
            _between("constant", "a", "b"),
            _between("polytropic", "b", "c", exponent=1.0),
            _between("constant", "c0", "d"),
        )
        assert diagram.named["c"][0] == pytest.approx(360.0, abs=1e-6)

    def test_a_compressor_takes_work(self) -> None:
        diagram = self._compressor()
        assert diagram.work(volume_at) == pytest.approx(_work_by_quadrature(diagram), rel=1e-9)
        assert diagram.work(volume_at) < 0

    def test_a_pressure_out_of_reach_is_refused_with_the_dead_centre(self) -> None:
        with pytest.raises(
            DiagramError, match='does not reach the pressure of "b" before the dead centre at 180 deg'
        ) as caught:
            self._compressor(delivery=4e6)
        assert caught.value.key == "gas.pieces[1]"

    @for_each("pressure", [None, 0.0, -1e5])
    def test_an_end_without_angle_needs_a_positive_pressure(self, pressure: float | None) -> None:
        error = _error({"a": (0.0, P0), "b": (None, pressure)}, _between("polytropic", "a", "b", exponent=1.3))
        assert error == ("gas.pieces[1]", 'point "b" needs an angle or a positive pressure; write one of them')


class TestRefusals:
    def test_an_unknown_point_is_named(self) -> None:
        error = _error({"a": (0.0, P0)}, _between("constant", "a", "q"))
        assert error == ("gas.pieces[1].points", 'there is no point "q" in [gas.points]')

    def test_an_unknown_reference_is_named(self) -> None:
        error = _error(OTTO_POINTS, OTTO_PIECES[0], _between("polytropic", "a", "c", exponent=1.3, reference="q"))
        assert error == ("gas.pieces[2].points", 'there is no point "q" in [gas.points]')

    def test_a_point_without_angle_is_named(self) -> None:
        key, told = _error({"a": (0.0, P0), "b": (None, None)}, _between("constant", "a", "b"))
        assert (key, told[:24]) == ("gas.pieces[1]", 'point "b" needs an angle')

    def test_a_point_without_pressure_is_named(self) -> None:
        key, told = _error({"a": (0.0, None), "b": (720.0, None)}, _between("constant", "a", "b"))
        assert key == "gas.pieces[1]"
        assert 'point "a" needs a pressure' in told

    def test_a_polytrope_without_exponent_is_refused(self) -> None:
        assert _error(OTTO_POINTS, OTTO_PIECES[0], _between("polytropic", "a", "c"))[0] == "gas.pieces[2].exponent"

    @for_each("pressure", [0.0, -1.0])
    def test_a_polytrope_needs_a_positive_pressure(self, pressure: float) -> None:
        error = _error({"a": (0.0, pressure), "b": (720.0, None)}, _between("polytropic", "a", "b", exponent=1.3))
        assert error == (
            "gas.pieces[1]", 'a polytrope needs a positive pressure at "a"; write one, or pressures = "absolute"'
        )  # fmt: skip

    def test_a_rounded_piece_needs_two_points(self) -> None:
        assert _error({"a": (0.0, P0)}, _between("rounded", "a"))[0] == "gas.pieces[1].points"

    def test_the_points_of_a_rounded_piece_must_rise(self) -> None:
        points = {"a": (0.0, P0), "b": (300.0, P0), "c": (200.0, P0), "d": (720.0, P0)}
        key, told = _error(points, _between("rounded", *points))
        assert key == "gas.pieces[1].points"
        assert "rising crank angles" in told

    def test_a_gap_names_both_angles(self) -> None:
        points = {"a": (0.0, P0), "b": (180.0, None), "c": (190.0, P0), "d": (720.0, None)}
        key, told = _error(points, _between("constant", "a", "b"), _between("constant", "c", "d"))
        assert key == "gas.pieces[2]"
        assert "starts at 190 deg" in told
        assert "end at 180 deg; fill the gap" in told

    def test_an_overlap_is_an_angle_that_goes_backwards(self) -> None:
        points = {"a": (0.0, P0), "b": (180.0, None), "c": (170.0, P0), "d": (720.0, None)}
        key, told = _error(points, _between("constant", "a", "b"), _between("constant", "c", "d"))
        assert key == "gas.pieces[2]"
        assert "do not let the angle go backwards" in told

    @for_each("law", ["constant", "polytropic"])
    def test_a_piece_that_goes_backwards_names_both_angles(self, law: Law) -> None:
        points = {"a": (0.0, P0), "b": (540.0, None), "c": (180.0, None), "d": (720.0, None)}
        pieces = (_between("constant", "a", "b"), _between(law, "b", "c", exponent=1.3), _between("constant", "c", "d"))
        key, told = _error(points, *pieces)
        assert key == "gas.pieces[2]"
        assert "goes backwards, from 540 to 180 deg" in told

    def test_a_diagram_that_does_not_start_at_zero_has_a_gap_there(self) -> None:
        key, told = _error({"a": (10.0, P0), "b": (720.0, None)}, _between("constant", "a", "b"))
        assert key == "gas.pieces[1]"
        assert "the pieces before it end at 0 deg; fill the gap" in told

    def test_a_diagram_that_ends_too_early_names_its_last_point(self) -> None:
        error = _error({"a": (0.0, P0), "b": (700.0, None)}, _between("constant", "a", "b"))
        assert error == ("gas.pieces", 'the pieces end at 700 deg (point "b"); the cycle is closed at 720 deg')

    def test_a_diagram_whose_ends_differ_names_both_pressures(self) -> None:
        key, told = _error({"a": (0.0, 1e5), "b": (720.0, 3e5)}, _between("rounded", "a", "b"))
        assert key == "gas.pieces"
        assert told.startswith("the diagram does not close: it starts at 0.1 MPa and ends at 0.3 MPa; let ")

    def test_ends_within_two_per_cent_of_the_highest_pressure_are_taken_as_closed(self) -> None:
        points = {"a": (0.0, 1.0e5), "m": (360.0, 1e6), "b": (720.0, 1.19e5)}
        assert _pressure(_solve(points, _between("rounded", *points)), 720.0) == [1.19e5]
        points["b"] = (720.0, 1.21e5)
        assert _error(points, _between("rounded", *points))[0] == "gas.pieces"


class TestPlacesByVolume:
    """The volume of the tests is that of a sine: the angle of a share of the stroke is arccos(1 - 2 share)."""

    POINTS: Mapping[str, DiagramPoint] = {
        "a": DiagramPoint(stroke=0.0, pressure=1e6), "b": DiagramPoint(stroke=0.3),
        "c": DiagramPoint(stroke=0.9), "d": DiagramPoint(stroke=0.9, pressure=1e5),
        "e": DiagramPoint(stroke=0.2), "f": DiagramPoint(stroke=0.0, pressure=1e6),
    }  # fmt: skip
    PIECES = (
        _between("constant", "a", "b"), _between("polytropic", "b", "c", exponent=1.1),
        _between("rounded", "c", "d"), _between("constant", "d", "e"), _between("polytropic", "e", "f", exponent=1.1),
    )  # fmt: skip

    def _solved(self, points: Mapping[str, DiagramPoint], cycle: float = 360.0) -> IndicatorDiagram:
        return solve_diagram(points, self.PIECES, cycle, volume_at, dead_centres=DEAD_CENTRES)

    def test_shares_of_the_stroke_are_passed_one_after_the_other(self) -> None:
        found = self._solved(self.POINTS).named
        out, back = (math.degrees(math.acos(1 - 2 * share)) for share in (0.3, 0.9))
        assert found["a"][0] == 0
        assert found["b"][0] == pytest.approx(out, rel=1e-14)
        assert found["c"][0] == pytest.approx(back, rel=1e-14)
        assert found["d"][0] == pytest.approx(360 - back, rel=1e-14)
        assert found["e"][0] == pytest.approx(360 - math.degrees(math.acos(0.6)), rel=1e-14)
        assert found["f"][0] == 360

    def test_a_volume_places_a_point_that_has_no_other_place(self) -> None:
        by_volume = {**self.POINTS, "b": DiagramPoint(volume=6.25e-5 + 0.3 * 5e-4)}
        expected, found = self._solved(self.POINTS).named["b"], self._solved(by_volume).named["b"]
        assert found == pytest.approx(expected, rel=1e-12)

    def test_a_volume_beyond_the_stroke_names_its_point(self) -> None:
        with pytest.raises(DiagramError) as caught:
            self._solved({**self.POINTS, "b": DiagramPoint(volume=6e-4)})
        assert caught.value.key == "gas.points.b.volume"
        assert "between 62.5 and 562.5 cm3" in str(caught.value)

    def test_a_polytrope_may_not_pass_an_empty_cylinder(self) -> None:
        points = {"a": DiagramPoint(0.0, 1e5), "b": DiagramPoint(180.0), "c": DiagramPoint(360.0, 1e5)}
        pieces = (_between("constant", "a", "b"), _between("polytropic", "b", "c", exponent=1.3))
        with pytest.raises(DiagramError, match="passes 360 deg, where the volume is zero; give a clearance"):
            solve_diagram(points, pieces, 360.0, lambda at: volume_at(at) - 6.25e-5, dead_centres=DEAD_CENTRES)


class TestJumps:
    def test_the_pressure_of_the_last_point_may_lie_a_jump_away(self) -> None:
        points = {"a": (0.0, 5e5), "b": (180.0, None), "c": (180.0, P0), "d": (360.0, 5e5)}
        diagram = _solve(points, _between("constant", "a", "b"), _between("constant", "c", "d"), cycle=360.0)
        assert diagram.jumps == (("d", 360.0, 4e5),)
        assert _pressure(diagram, 0.0, 180.0, 360.0) == [5e5, 5e5, P0]
        assert diagram.work(volume_at) == pytest.approx(4e5 * 5e-4, rel=1e-14)

    def test_a_pressure_other_than_the_computed_one_is_reported_as_a_jump(self) -> None:
        computed = P0 * 9**1.35
        points = {**OTTO_POINTS, "c": (360.0, 2.5e6)}
        (jump,) = _solve(points, *OTTO_PIECES).jumps
        assert jump == ("c", 360.0, pytest.approx(2.5e6 - computed, rel=1e-12))

    def test_rounding_in_a_document_is_no_jump(self) -> None:
        points = {**OTTO_POINTS, "c": (360.0, round(P0 * 9**1.35, -3))}
        assert _solve(points, *OTTO_PIECES).jumps == ()

    def test_what_follows_starts_from_the_given_pressure(self) -> None:
        points = {**OTTO_POINTS, "c": (360.0, 2.5e6), "z": (380.0, 5e6)}
        pieces = (*OTTO_PIECES[:2], _between("rounded", "c", "z"), *OTTO_PIECES[2:])
        diagram = _solve(points, *pieces)
        assert _pressure(diagram, 360.0) == pytest.approx([P0 * 9**1.35], rel=1e-14)
        assert _pressure(diagram, math.nextafter(360.0, 361.0)) == pytest.approx([2.5e6], rel=1e-12)

    def test_two_names_at_one_angle_are_a_vertical_line_and_no_jump(self) -> None:
        assert _solve(OTTO_POINTS, *OTTO_PIECES).jumps == ()

    def test_a_vertical_line_drawn_as_a_piece_leaves_no_segment(self) -> None:
        with_line = (*OTTO_PIECES[:2], _between("rounded", "c", "z"), *OTTO_PIECES[2:])
        diagram = _solve(OTTO_POINTS, *with_line)
        assert [segment.start for segment in diagram.segments] == [0.0, 180.0, 360.0, 540.0]
