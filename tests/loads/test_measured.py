"""Measured pressure: a known diagram comes back from its samples, however they were recorded."""

import itertools

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import Array
from crankwork.loads import pressure_processing
from crankwork.loads.indicator import DiagramError, IndicatorDiagram
from crankwork.loads.measured_pressure import MeasuredPressure, Preprocessing, recorded_cycles, wrap_is_rough
from each import for_each

CYCLE = 720.0


def _true_pressure(degrees: Array) -> Array:
    """Return a smooth pressure of period 720 degrees with its peak of 4.1 MPa at 365. [Pa]"""
    return np.asarray(1e5 + 4e6 * np.exp(12 * (np.cos(np.radians(degrees - 365) / 2) - 1)))


def _recorded(degrees: Array, pressure: Array | None = None, first_line: int = 2) -> MeasuredPressure:
    values = _true_pressure(degrees) if pressure is None else pressure
    rows = range(first_line, first_line + len(degrees))
    return MeasuredPressure(degrees, values, rows, treatment=Preprocessing(cycle="mean"))


def measured_diagram(
    measured: MeasuredPressure, cycle: float, *, shift: float = 0.0, step: float | None = None
) -> tuple[IndicatorDiagram, int, float]:
    """Return the diagram of a recording, its cycles, and the step from their end to their start."""
    around = pressure_processing.PressureReference(lambda degrees: 2 - np.cos(np.radians(degrees)))
    diagram, _ = pressure_processing.measured_diagram(measured, cycle, around, shift=shift, step=step, path="gas")
    recorded = recorded_cycles(measured, cycle, step=step, path="gas")
    return diagram, len(recorded.cycles), recorded.wrap


def _pressure(diagram: IndicatorDiagram, degrees: Array) -> Array:
    return diagram.pressure(degrees, np.zeros_like(degrees))


def _error(measured: MeasuredPressure, cycle: float = CYCLE) -> DiagramError:
    with pytest.raises(DiagramError) as caught:
        measured_diagram(measured, cycle)
    return caught.value


@for_each("step", [0.1, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, 2.0, 3.0])
@for_each("start", [0.0, -360.0, 57.0])
def test_samples_come_back_as_recorded(step: float, start: float) -> None:
    degrees = np.asarray(start + np.arange(round(CYCLE / step)) * step, float)
    diagram, cycles, _ = measured_diagram(_recorded(degrees), CYCLE)
    at = np.sort(np.mod(degrees, CYCLE))
    assert cycles == 1
    # angles are kept to a billionth of a degree, over which the pressure changes by less than a pascal
    assert np.max(np.abs(_pressure(diagram, at) - _true_pressure(at))) < 1e-3
    # no knot twice; the ends of the cycle may lie between samples
    assert np.min(np.diff(diagram.breaks)) > 0.01


def test_unevenly_spaced_samples_come_back_as_recorded() -> None:
    degrees = np.concatenate([np.arange(0.0, 340.0), np.arange(340.0, 390.0, 0.5), np.arange(390.0, 720.0)])
    diagram, _, _ = measured_diagram(_recorded(degrees), CYCLE)
    assert _pressure(diagram, degrees) == pytest.approx(_true_pressure(degrees), rel=1e-9)


def test_between_samples_the_curve_is_near_the_true_one() -> None:
    diagram, _, _ = measured_diagram(_recorded(np.arange(0.0, 720.0)), CYCLE)
    at = np.linspace(0, 720, 7201)
    assert np.max(np.abs(_pressure(diagram, at) - _true_pressure(at))) < 2e-4 * 4e6


def test_the_work_of_the_true_diagram_comes_back() -> None:
    def volume_at(degrees: Array) -> Array:
        return np.asarray(6e-5 + 2.5e-4 * (1 - np.cos(np.radians(degrees))))

    fine = np.linspace(0, 720, 72001)
    rate = 2.5e-4 * np.sin(np.radians(fine))
    # the integrand is smooth and periodic, so the sum over equal steps is the integral
    expected = float(np.sum((_true_pressure(fine) * rate)[:-1])) * np.radians(0.01)
    diagram, _, _ = measured_diagram(_recorded(np.arange(0.0, 720.0)), CYCLE)
    assert diagram.work(volume_at) == pytest.approx(expected, rel=1e-5)


def test_a_last_row_that_repeats_the_first_changes_nothing() -> None:
    degrees = np.arange(0.0, 720.5, 0.5)
    with_last, _, _ = measured_diagram(_recorded(degrees), CYCLE)
    without, _, _ = measured_diagram(_recorded(degrees[:-1]), CYCLE)
    at = np.linspace(0, 720, 1001)
    assert _pressure(with_last, at).tolist() == _pressure(without, at).tolist()


@for_each("start", [0.0, 30.0, -181.5])
def test_the_diagram_is_closed_bit_for_bit(start: float) -> None:
    diagram, _, _ = measured_diagram(_recorded(start + np.arange(0.0, 720.0)), CYCLE)
    first, last = _pressure(diagram, np.array([0.0, 720.0]))
    assert first == last
    assert (diagram.segments[0].start, diagram.segments[-1].end) == (0.0, 720.0)


@for_each("shift", [0.0, 25.0, -11.5, 360.0, -700.0])
def test_a_shift_puts_top_dead_centre_where_it_belongs(shift: float) -> None:
    degrees = np.arange(0.0, 720.0, 0.5)
    recorded = _recorded(degrees, _true_pressure(degrees + shift))
    diagram, _, _ = measured_diagram(recorded, CYCLE, shift=shift)
    assert _pressure(diagram, degrees) == pytest.approx(_true_pressure(degrees), rel=1e-9)


def test_two_cycles_are_averaged() -> None:
    degrees = np.arange(0.0, 1440.0)
    ripple = np.where(degrees < 720, 3e4, -1e4)
    diagram, cycles, _ = measured_diagram(_recorded(degrees, _true_pressure(degrees) + ripple), CYCLE)
    assert cycles == 2
    at = degrees[:720]
    assert _pressure(diagram, at) == pytest.approx(_true_pressure(at) + 1e4, rel=1e-12)


def test_noise_shrinks_with_the_root_of_the_number_of_cycles() -> None:
    noise = np.random.default_rng(3).normal(0, 1e4, 100 * 720)
    degrees = np.arange(0.0, 100 * 720.0)
    diagram, cycles, _ = measured_diagram(_recorded(degrees, _true_pressure(degrees) + noise), CYCLE)
    assert cycles == 100
    at = degrees[:720]
    assert 0.9e3 < np.std(_pressure(diagram, at) - _true_pressure(at)) < 1.1e3


def test_a_cycle_that_is_not_whole_is_left_out_of_the_average() -> None:
    degrees = np.arange(0.0, 1000.0)
    spoilt = np.where(degrees < 720, _true_pressure(degrees), 9e8)
    diagram, cycles, _ = measured_diagram(_recorded(degrees, spoilt), CYCLE)
    assert cycles == 1
    assert np.max(_pressure(diagram, degrees[:720])) < 4.2e6


@for_each("cycle", [360.0, 720.0])
def test_the_cycle_may_be_two_strokes_or_four(cycle: float) -> None:
    degrees = np.arange(0.0, 720.0)
    _, cycles, _ = measured_diagram(_recorded(degrees), cycle)
    assert cycles == 720 / cycle


@for_each("step", [0.5, 1.0, 2.0, 7.2, 0.7])
def test_resampling_sets_the_knots(step: float) -> None:
    degrees = np.arange(0.0, 720.0, 0.5)
    diagram, _, _ = measured_diagram(_recorded(degrees), CYCLE, step=step)
    expected = [*np.arange(0.0, 720.0, step), 720.0]
    assert diagram.breaks == pytest.approx(expected, abs=1e-8)
    at = diagram.breaks
    assert np.max(np.abs(_pressure(diagram, at) - _true_pressure(at))) < 1e-4 * 4e6


@for_each("step", [0.1, 0.2, 0.3, 0.6])
@for_each("start", [0.0, 0.35, -360.0])
def test_resampling_at_a_step_that_is_no_binary_fraction_keeps_every_knot_once(step: float, start: float) -> None:
    diagram, _, _ = measured_diagram(_recorded(start + np.arange(0.0, 720.0)), CYCLE, step=step)
    assert np.all(np.diff(diagram.breaks) > 0.04)
    assert np.all(np.isfinite(diagram.segments[0].pressures))


def test_a_smooth_wrap_is_not_worth_a_warning() -> None:
    diagram, _, wrap = measured_diagram(_recorded(np.arange(0.0, 721.0)), CYCLE)
    assert abs(wrap) < 1e-6
    assert not wrap_is_rough(diagram, wrap)


@for_each(("drift", "rough"), [(1e5, False), (-1e5, False), (3e5, True), (-3e5, True)])
def test_a_drift_over_the_cycle_shows_at_the_wrap(drift: float, *, rough: bool) -> None:
    degrees = np.arange(0.0, 721.0)
    drifting = 5e5 + _true_pressure(degrees) + drift * degrees / 720
    diagram, _, wrap = measured_diagram(_recorded(degrees, drifting), CYCLE)
    assert wrap == pytest.approx(drift, rel=1e-9)
    assert wrap_is_rough(diagram, wrap) == rough


def test_a_recording_that_starts_in_combustion_has_no_rough_wrap() -> None:
    """The last sample is one step before the first; on a steep curve they differ although nothing drifts."""
    degrees = 340 + np.arange(0.0, 720.0, 4.0)
    diagram, _, wrap = measured_diagram(_recorded(degrees), CYCLE)
    assert not wrap_is_rough(diagram, wrap)


def _without(first: int, behind: int) -> MeasuredPressure:
    return _recorded(np.delete(np.arange(0.0, 720.0), np.arange(first, behind)))


def _backwards(wrong: float) -> MeasuredPressure:
    return _recorded(np.concatenate([np.arange(0.0, 50.0), [wrong], np.arange(51.0, 720.0)]))


REFUSED = {
    "no samples": (_recorded(np.empty(0)), "only 0 samples; a cycle needs at least 8"),
    "too few samples": (_recorded(np.linspace(0, 720, 7)), "only 7 samples; a cycle needs at least 8"),
    "too many samples": (
        _recorded(np.linspace(0, 720, 60_001)),
        '60000 samples in one cycle; write resample = "0.1 deg"',
    ),
    "an angle again": (_backwards(49.0), "line 52: the angle goes backwards, from 49 to 49 deg"),
    "an angle before": (_backwards(48.0), "line 52: the angle goes backwards, from 49 to 48 deg"),
    "an angle below zero": (_backwards(-3.0), "line 52: the angle goes backwards, from 49 to -3 deg"),
    "a gap": (_without(100, 105), "line 102: gap from 99 to 105 deg where the usual step is 1 deg"),
    "a degree less": (_without(719, 720), "the samples cover 718 deg; one cycle is 720 deg"),
    "half a cycle": (_without(360, 720), "the samples cover 359 deg; one cycle is 720 deg"),
}


@for_each(("recorded", "told"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_recording_of_a_cycle_is_refused(recorded: MeasuredPressure, told: str) -> None:
    error = _error(recorded)
    assert error.key == "gas.measured"
    assert str(error).startswith(told)


def test_what_is_nearly_refused_is_taken() -> None:
    """Many samples to be resampled, a few missing ones, and a cycle less its last sample."""
    assert measured_diagram(_recorded(np.linspace(0, 720, 60_001)), CYCLE, step=0.5)[1] == 1
    assert measured_diagram(_without(100, 103), CYCLE)[1] == 1
    assert measured_diagram(_without(720, 720), CYCLE)[1] == 1


def test_the_knots_of_the_curve_rise() -> None:
    diagram, _, _ = measured_diagram(_recorded(np.arange(0.0, 720.0)), CYCLE)
    (segment,) = diagram.segments
    assert all(one < other for one, other in itertools.pairwise(segment.knots))
