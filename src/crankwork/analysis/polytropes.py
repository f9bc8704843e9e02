"""The polytropes of an indicator diagram as tables give them: pressure over multiples of the clearance volume."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import IndicatorDiagram, Segment

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
