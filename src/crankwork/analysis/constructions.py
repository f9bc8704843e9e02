"""Constructions on the results of a machine that figures, sheets and notes share."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.cylinder_forces import COLUMNS, columns
from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.curves import LoadCurve
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import IndicatorDiagram, Segment
from crankwork.loads.load import ProcessForce
from crankwork.preparation.piston_kinematics import HARMONICS
from crankwork.shaft.flywheel import slope_largest, slope_least

_HALF = 360.0
_ROWS = 12


class Polytropes(NamedTuple):
    """Polytropes of compression and expansion, as far as a diagram has them."""

    exponents: Mapping[str, float]  # Exponents of `compression` and `expansion` [-]
    # Volumes in multiples of the clearance volume, and themselves, shape (n,) [-], [m3]
    multiples: Array
    volumes: Array
    # Pressures of `compression` and `expansion`, not a number beyond their ends, shape (n,) [Pa]
    pressures: Mapping[str, Array]


def polytropes(results: Results) -> Polytropes | None:
    """Return the polytropes of a diagram, of a calculated cycle before its corners were rounded; None without any."""
    space = results.solved.space
    diagram: IndicatorDiagram = space.theoretical or space.diagram
    result = _by_stroke(diagram, results.machine.cycle)
    if not result:
        return None
    spans = {name: _span(results, diagram, value) for name, value in result.items()}
    ratio = 1 + space.swept / space.clearance
    step = max(1.0, math.ceil(ratio / _ROWS))
    multiples = np.array([*np.arange(1.0, ratio - 1e-9, step), ratio])
    ends = [end / space.clearance for span in spans.values() for end in span]
    # an end near an integer multiple is that multiple
    ends = [end for end in ends if not np.any(np.isclose(end, multiples, rtol=1e-6))]
    volumes = np.unique(np.round([*multiples, *ends], 9)) * space.clearance
    within = {name: _is_within(volumes, *span) for name, span in spans.items()}
    kept = np.logical_or.reduce(list(within.values()))
    pressures = {}
    for name, segment in result.items():
        pressure, reference, exponent = segment.state
        values = np.asarray(polytropic_pressure(pressure, reference, volumes[kept], exponent))
        pressures[name] = np.where(within[name][kept], values, np.nan)
    exponents = {name: value.state[2] for name, value in result.items()}
    return Polytropes(exponents, volumes[kept] / space.clearance, volumes[kept], pressures)


def _by_stroke(diagram: IndicatorDiagram, cycle: float) -> dict[str, Segment]:
    """Return the polytropes of compression and expansion; the first of each half of the cycle."""
    half = min(cycle / 2, _HALF)
    values: dict[str, Segment] = {}
    for segment in diagram.segments:
        if segment.law == "polytropic":
            is_compression = segment.start < half if cycle > _HALF else segment.start >= half
            values.setdefault("compression" if is_compression else "expansion", segment)
    return {name: values[name] for name in ("compression", "expansion") if name in values}


def _span(results: Results, diagram: IndicatorDiagram, segment: Segment) -> tuple[float, float]:
    """Return the least and the largest volume of a polytrope, with that of the state it passes through. [m3]"""
    same = [piece for piece in diagram.segments if piece.law == "polytropic" and piece.state == segment.state]
    degrees = [angle for item in same for angle in (item.start, item.end)]
    volumes = results.columns_at(degrees, ("cylinder_volume",))["cylinder_volume"]
    reference = segment.state[1]
    return min(float(volumes.min()), reference), max(float(volumes.max()), reference)


def _is_within(volumes: Array, least: float, largest: float) -> Array:
    """Return which volumes a polytrope has, its ends included."""
    return np.asarray((volumes >= least * (1 - 1e-6)) & (volumes <= largest * (1 + 1e-6)))


_STEP = 0.5
# behind a corner of the pressure, where there may be a jump
_AFTER = 1e-6
# how many parts the tangents of a parabola are divided into
_PARTS = 6
# along a smooth law of a force
_SAMPLES = 201


def force_laws(results: Results) -> dict[str, tuple[Array, Array]]:
    """Return the forces that vary with the stroke of a piece, over its displacement, by its name. [m], [N]"""
    laws = {}
    for load in results.machine.loads if results.machine.linkage is not None else ():
        if isinstance(load, ProcessForce) and load.against == "stroke" and isinstance(load.force, LoadCurve):
            strokes, forces = np.array(load.force.at), np.array(load.force.values)
            if not np.ptp(forces):
                continue
            if load.force.interpolation != "linear":
                strokes = np.linspace(strokes[0], strokes[-1], _SAMPLES)
                forces = load.force(strokes)
            places = load.start + load.forward * strokes
            # as far as the piece goes
            travel = results.columns.get(f"slider_displacement.{load.slider}", places)
            inside = np.clip(places, np.min(travel), np.max(travel))
            order = np.argsort(places)
            reached = np.where(inside == places, forces, np.interp(inside, places[order], forces[order]))
            laws[load.slider] = inside, reached
    return laws


class FineColumns(NamedTuple):
    """Columns of one cylinder over the cycle, finer than the tables, at crank angles. [SI], [deg]"""

    degrees: Array
    columns: Mapping[str, Array]


def fine_columns(results: Results) -> FineColumns:
    """Return the columns of one cylinder, with every corner of the pressure among the angles.

    `results`: of a slider-crank; of an approximate method with the orders of the motion.
    """
    grid = CrankGrid.steps(_STEP, results.machine.cycle, special=_corners(results))
    keys = COLUMNS if results.method.is_exact else (*COLUMNS, *HARMONICS)
    return FineColumns(grid.degrees, columns(results.solved, grid, keys))


def _corners(results: Results) -> tuple[float, ...]:
    """Return the angles where the pressure may have a corner or, just behind them, a jump. [deg]"""
    if results.solved.space is None:
        return ()
    diagram = results.solved.space.diagram
    angles = {segment.start for segment in diagram.segments} | {angle for angle, _ in diagram.named.values()}
    last = results.machine.cycle - _AFTER
    return tuple(angles | {angle + _AFTER for angle in angles if angle < last})


class BrixPoints(NamedTuple):
    """Points of Brix's circle for a circle of radius 1 about the crankshaft, up towards top dead centre."""

    pole: Array  # Where the rays begin: right and up, in crank radii, shape (2,) [-]
    # Where they cut the circle, shape (n,) [-]
    across: Array
    up: Array


def brix_points(lengths: SliderCrank, degrees: Array) -> BrixPoints:
    """Return where rays from the shifted pole cut the circle; its height below the top is the displacement. [-]

    `degrees`: crank angles, which the rays make with the axis [deg].

    The pole lies half the crank-to-rod ratio towards bottom dead centre. Where the cylinder is offset, the axis is
    turned by the ratio of offset to rod length, which gives the displacement its part of the sine.
    """
    turn = float(lengths.offset / lengths.rod_length)
    pole = -float(lengths.rod_ratio) / 2 * np.array([np.sin(-turn), np.cos(turn)])
    angle = np.radians(degrees) - turn
    ray = np.array([np.sin(angle), np.cos(angle)])
    along = pole @ ray
    reach = -along + np.sqrt(along**2 + 1 - pole @ pole)
    return BrixPoints(pole, pole[0] + reach * ray[0], pole[1] + reach * ray[1])


class TollePoints(NamedTuple):
    """Points of Tolle's construction: displacement over the crank radius, acceleration over r w^2."""

    # A and B at the dead centres on the axis, C and D at the accelerations there, E where CD cuts the axis, F at the
    # acceleration -3 r/l next to E [-]
    a: tuple[float, float]
    b: tuple[float, float]
    c: tuple[float, float]
    d: tuple[float, float]
    e: tuple[float, float]
    f: tuple[float, float]


def tolle_points(ratio: float) -> TollePoints:
    """Return the points of Tolle's construction for a central slider-crank. [-]

    With two terms of the series both displacement and acceleration are quadratic in the cosine of the crank angle, so
    that one over the other is a parabola; CF and FD are its tangents at the dead centres.
    """
    cut = 1 + ratio
    return TollePoints((0.0, 0.0), (2.0, 0.0), (0.0, 1 + ratio), (2.0, ratio - 1), (cut, 0.0), (cut, -3 * ratio))


def tolle_parabola(ratio: float) -> tuple[Array, Array]:
    """Return displacement and acceleration by two terms of the series, the parabola that the tangents envelop. [-]

    In crank radii and r w^2, from top to bottom dead centre.
    """
    cosine = np.cos(np.radians(np.arange(0.0, 181.0, 3.0)))
    return 1 - cosine + ratio / 2 * (1 - cosine**2), cosine + ratio * (2 * cosine**2 - 1)


def tangent_ends(start: ArrayLike, corner: ArrayLike, end: ArrayLike) -> Array:
    """Return the lines that join equal parts of two tangents of a parabola, which are tangents as well, shape (n, 4).

    `start`, `corner` and `end`: where the tangents touch the parabola, and between them where they meet [any], shape
    (2,).
    """
    share = np.arange(1, _PARTS)[:, None] / _PARTS
    a, b, c = (np.array(item) for item in (start, corner, end))
    return np.hstack([a + (b - a) * share, b + (c - b) * share])


class Fluctuation(NamedTuple):
    """How evenly the crank turns: mean angular speed [rad/s] and its coefficient of fluctuation [-]."""

    mean: float
    delta: float


class Tangents(NamedTuple):
    """The tangents of the energy-mass curve at largest and smallest speed, y = slope x + foot. [J], [kg m2]

    `flywheel` is the reduced inertia that has to be added: where they meet, counted to the left.
    """

    slope_max: float
    slope_min: float
    foot_max: float
    foot_min: float
    touch_max: int
    touch_min: int

    @property
    def flywheel(self) -> float:
        """Reduced moment of inertia that keeps the speed within its limits. [kg m2]"""
        return (self.foot_max - self.foot_min) / (self.slope_max - self.slope_min)


def tangents(inertia: Array, energy: Array, wanted: Fluctuation) -> Tangents:
    """Return the two tangents of the energy-mass curve (artobolevsky_1988).

    `inertia` and `energy`: reduced moment of inertia [kg m2] and change of the kinetic energy [J] over one cycle.

    tan psi = w^2 (1 +- delta / 2)^2 / 2; the upper tangent touches the curve from above, the lower one from below.
    """
    high = float(slope_largest(wanted.mean, wanted.delta))
    low = float(slope_least(wanted.mean, wanted.delta))
    above, below = energy - high * inertia, energy - low * inertia
    i, j = int(np.argmax(above)), int(np.argmin(below))
    return Tangents(high, low, float(above[i]), float(below[j]), i, j)
