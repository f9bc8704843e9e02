"""Values of engines far outside normal design, each with the usual range."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from crankwork.analysis.prepared import Notice
from crankwork.analysis.results import Results
from crankwork.cylinders.layout import Layout


class _Range(NamedTuple):
    """A range beyond which no engine is built, in SI and wider than its source."""

    key: str
    low: float
    high: float


_RANGES = (
    # kolchin_demidov_2008, ch. 6 and 7; heywood_1988, table 2.1; taylor_1985, ch. 11
    _Range("mean_piston_speed", 0.0, 30.0),
    _Range("rod_ratio", 0.08, 0.45),
    _Range("gas_pressure_max", 0.0, 35e6),
    _Range("speed_fluctuation", 0.0, 0.5),
)
# stroke over bore, and mass over piston area [kg/m2]
_STROKE, _PISTON, _ROD = (0.3, 5.0), (10.0, 3000.0), (10.0, 4000.0)
# orders of how many cylinders are compared, and how much better another has to be
_MOST_ORDERS, _BETTER, _ZERO = 6, 2.0, 1e-9


def implausible(results: Results) -> Iterator[Notice]:
    """Yield a notice for each value far outside normal design (kolchin_demidov_2008, heywood_1988, taylor_1985)."""
    machine = results.machine
    if machine.lengths is None:
        return
    for key, low, high in _RANGES:
        yield from _outside(key, results.summary.get(key), low, high)
    if machine.cylinder is not None:
        yield from _outside("stroke_bore_ratio", 2 * float(machine.lengths[0]) / machine.cylinder.bore, *_STROKE)
        area, masses = math.pi / 4 * machine.cylinder.bore**2, machine.masses
        if masses is not None:
            rod = masses.rod_small_end + masses.rod_big_end
            yield from _outside("mass_per_area.of_piston", masses.piston / area or None, *_PISTON)
            yield from _outside("mass_per_area.of_rod", rod / area or None, *_ROD)
    if machine.engine is not None and "engine.throws[1]" not in machine.stated:
        yield from _doubtful_order(machine.engine.layout)


def _outside(key: str, value: float | None, low: float, high: float) -> Iterator[Notice]:
    if value is not None and not low <= value <= high:
        yield Notice("implausible", {"quantity": key, "value": value, "low": low, "high": high})


def _doubtful_order(layout: Layout) -> Iterator[Notice]:
    """Yield a notice if another firing order of an engine in line at least halves its free moments (taylor_1985)."""
    count = len(layout.places)
    if layout.kind != "inline" or not 3 <= count <= _MOST_ORDERS:
        return
    along = tuple(place.position for place in layout.places)
    along = along if any(along) else tuple(number - (count - 1) / 2 for number in range(count))
    better = _better_order(layout.firing_order, layout.cycle, along)
    if better:
        yield Notice("firing_order", {"order": "-".join(map(str, layout.firing_order)), "better": better})


@functools.cache
def _better_order(stated: tuple[int, ...], cycle: float, along: tuple[float, ...]) -> str:
    """Return the firing order with the least free moments if it at least halves them, else an empty text."""
    count = len(stated)

    def moment(order: tuple[int, ...]) -> float:
        angles = np.empty(count)
        angles[np.array(order) - 1] = -math.radians(cycle) / count * np.arange(count)
        # forces of the second order are about a quarter of the first
        return float(sum(weight * abs(np.sum(along * np.exp(1j * n * angles))) for n, weight in ((1, 1.0), (2, 0.25))))

    own = moment(stated)
    best = min(((1, *rest) for rest in itertools.permutations(range(2, count + 1))), key=moment)
    is_better = own > _ZERO * math.fsum(map(abs, along)) and own > _BETTER * moment(best)
    return "-".join(map(str, best)) if is_better else ""
