"""Transmission quality of a linkage: transmission and pressure angles, and time ratios of strokes."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping

import numpy as np
from numpy.polynomial import legendre

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import FormulaCall, ProcedureValue, TracedValue, select
from crankwork.kinematics import plane_motion as angles
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.crank_range import CrankRange, line_of
from crankwork.kinematics.dyads import LinkMotion
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.dyads import RRP, RRR
from crankwork.mechanism.mechanism import Mechanism
from crankwork.preparation.prepared import Notice
from crankwork.quantities.key import key_of

FOLLOWED = ("transmission_cosine", "pressure_sine")
# beyond these forces grow, and a linkage may jam; of pressure angles the largest [deg]
USUAL = (40.0, 140.0)
USUAL_PRESSURE = 90.0 - USUAL[0]
_TURN = 360.0
# how far rounding leaves the cosine of links in line from one
_IN_LINE = 1e-13
_LOOK, _STILL = np.linspace(-1.0, 1.0, 17), 1e-9


def transmissions(mechanism: Mechanism, motion: Motion) -> Iterator[tuple[str, TracedValue]]:
    """Yield the transmission angle of every RRR dyad and the pressure angle of every RRP dyad; `motion` is traced."""
    for kind, name, item, other in _pairs(mechanism, motion.bar, motion.frames):
        if kind == "transmission":
            yield f"transmission_angle.{name}", angles.transmission_angle(item.cos, other.cos, item.sin, other.sin)
        else:
            yield f"pressure_angle.{name}", angles.pressure_angle(item.sin, other.cos, item.cos, other.sin)


def smooth_transmissions(
    mechanism: Mechanism, bar: Callable[[str], LinkMotion], frames: Mapping[str, LinkMotion]
) -> Iterator[tuple[str, Value]]:
    """Yield functions with the extremes of these angles, and without corners where links come into line."""
    for kind, name, item, other in _pairs(mechanism, bar, frames):
        if kind == "transmission":
            yield f"transmission_cosine.{name}", angles.transmission_cosine(item.cos, other.cos, item.sin, other.sin)
        else:
            yield f"pressure_sine.{name}", angles.pressure_sine(item.sin, other.cos, item.cos, other.sin)


def limits_of_transmissions(travel: CrankRange) -> dict[str, Array]:
    """Return these functions in the dead positions of a crank, taken from the closed curve of positions."""
    mechanism, frames = travel.circuit.mechanism, travel.circuit.stretch(np.array(travel.branch)).frames
    return dict(smooth_transmissions(mechanism, lambda link: line_of(link, frames, mechanism), frames))


def _pairs(
    mechanism: Mechanism, bar: Callable[[str], LinkMotion], frames: Mapping[str, LinkMotion]
) -> Iterator[tuple[str, str, LinkMotion, LinkMotion]]:
    """Yield the two links of RRR dyads, link and guide of RRP dyads, with the point between them."""
    for dyad in mechanism.dyads:
        match dyad:
            # the third side of a triangle that a motor deforms is no link
            case RRR() if mechanism.driver.link not in (dyad.link_a, dyad.link_b):
                yield "transmission", dyad.point, bar(dyad.link_a), bar(dyad.link_b)
            case RRP():
                yield "pressure", dyad.slider, bar(dyad.link), frames[dyad.piece]


def _in_line(value: TracedValue, formula: Callable[[TracedValue], TracedValue], limit: float) -> TracedValue:
    """Return the angle of an extreme cosine or sine, which rounding may leave off its limits."""
    if abs(value.value) < 1 - _IN_LINE:
        return formula(value)
    return TracedValue(ProcedureValue(limit, "in_line", (value,)))


def _or_limit(extreme: TracedValue, column: TracedValue, ends: Array, sign: float) -> TracedValue:
    """Return an extreme, or the limit in a dead position that is beyond it; `sign`: 1 of a largest, -1 of a least."""
    limit = sign * float(np.max(sign * ends, initial=-np.inf))
    if sign * limit <= sign * extreme.value:
        return extreme
    return TracedValue(ProcedureValue(limit, "branch", (column,)), extreme.key)


def quality_of(over: CycleInterpolant, ends: Mapping[str, Array]) -> tuple[dict[str, TracedValue], tuple[Notice, ...]]:
    """Return the extreme transmission and pressure angles, and notices of those that are unusual.

    `ends`: limits of the columns in dead positions.
    """
    result: dict[str, TracedValue] = {}
    notices: list[Notice] = []
    keys = [key for key in over.columns if key_of(key).quantity in ("transmission_cosine", "pressure_sine")]
    extremes = over.extremes(*keys)
    for key in keys:
        kind, name = key_of(key)
        largest, least = (
            _or_limit(extremes[f"{kind}_{word}.{name}"], over.columns[key], ends.get(key, np.empty(0)), sign)
            for word, sign in (("max", 1.0), ("min", -1.0))
        )
        if kind == "transmission_cosine":
            values = {
                "min": _in_line(largest, angles.transmission_of_cosine, 0.0),
                "max": _in_line(least, angles.transmission_of_cosine, math.pi),
            }
            result |= {f"transmission_angle_{word}.{name}": value for word, value in values.items()}
        else:
            worse = largest if largest.value >= -least.value else -least
            pressure = _in_line(worse, angles.pressure_of_sine, math.pi / 2).named(f"pressure_angle_max.{name}")
            if isinstance(pressure.node, FormulaCall):
                # for other inputs the other extreme may be the worse
                either = angles.pressure_of_sine(select(largest + least, largest, -least))
                pressure = TracedValue(FormulaCall(pressure.node.formula, pressure.node.inputs, either), pressure.key)
            result[pressure.key] = pressure
            values = {"min": angles.transmission_of_pressure(pressure)}
            result[f"transmission_angle_min.{name}"] = values["min"]
        worst = [math.degrees(value.value) for value in values.values()]
        notices += [
            Notice("transmission", {"name": name, "angle": item, "low": USUAL[0], "high": USUAL[1]})
            for item in worst
            if not USUAL[0] <= item <= USUAL[1]
        ]
    return result, tuple(notices)


def rocks(pivoted: Collection[str], key: str, travel: float) -> bool:
    """Say whether a column is that of a slider, or of a link that rocks about a fixed pivot, as `pivoted` ones do."""
    kind, name = key_of(key)
    return kind == "slider_displacement" or (travel < math.pi and name in pivoted)


def time_ratios(over: CycleInterpolant, summary: Mapping[str, TracedValue]) -> Iterator[tuple[str, TracedValue]]:
    """Yield the time of the slower stroke over that of the faster one, of columns that turn back twice in a turn."""
    turns = (over.edges[-1] - over.edges[0]) / _TURN
    for key in over.columns:
        kind, name = key_of(key)
        ends = [f"{kind}_{word}_angle.{name}" for word in ("max", "min")]
        if kind not in ("slider_displacement", "link_angle") or ends[0] not in summary:
            continue
        if _reversals(over.polynomials(key)) == 2 * turns:
            high, low = (summary[end] for end in ends)
            stroke = math.degrees(abs(high.value - low.value)) % _TURN
            slow, fast = max(stroke, _TURN - stroke), min(stroke, _TURN - stroke)
            yield f"time_ratio.{name}", TracedValue(ProcedureValue(slow / fast, "time_ratio", (high, low)))


def _reversals(coefficients: Array) -> int:
    """Return how often a column turns back in a closed cycle, from its Legendre coefficients between edges."""
    values = legendre.legval(_LOOK, coefficients.T).ravel()
    steps = np.diff(values)
    signs = np.sign(steps[np.abs(steps) > _STILL * np.ptp(values)])
    return int(np.count_nonzero(signs != np.roll(signs, 1)))
