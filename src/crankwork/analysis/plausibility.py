"""Values far outside normal design, each with the usual range, and work on the faster of two strokes."""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.cylinders.layout import Layout
from crankwork.formula.traced_value import Input, in_order
from crankwork.loads.load import ProcessForce
from crankwork.machine import InputNumber
from crankwork.preparation.prepared import Notice


class _Range(NamedTuple):
    """A range beyond which no engine is built, in SI, with keys of a file that decide.

    It is wider than the usual values in its source; without one it is a limit of this program.
    """

    quantity: str
    low: float
    high: float
    source: str
    keys: tuple[str, ...] = ()


# results that no machine has below 0; no efficiency is above 1
_SHARES = tuple(f"{name}_efficiency" for name in (
    "effective", "indicated", "mechanical", "thermal", "isothermal", "overall_isothermal"))  # fmt: skip
_POSITIVE = ("effective_torque", "effective_power", "indicated_power", "heat_rest")
_OWN = ""
_RESULTS = (
    _Range("mean_piston_speed", 0.0, 30.0, "heywood_1988", ("crank.speed",)),
    _Range("rod_ratio", 0.08, 0.45, "kolchin_demidov_2008", ("rod.length", "rod.ratio")),
    _Range("gas_pressure_max", 0.0, 35e6, _OWN, ("gas.points", "gas", "cycle", "cylinder.compression_ratio")),
    _Range("speed_fluctuation", 0.0, 0.5, "khurmi_gupta_2005", ("flywheel",)),
)
_WANTED = _Range("speed_fluctuation", 0.0, 0.25, "khurmi_gupta_2005", ("flywheel.percent", "flywheel.fluctuation"))
_STROKE = _Range("stroke_bore_ratio", 0.3, 5.0, "heywood_1988", ("cylinder.bore",))
# mass over piston area, of a piston with its crosshead too [kg/m2]
_PISTON = _Range("mass_per_area.of_piston", 10.0, 1e4, "kolchin_demidov_2008", ("piston.mass",))
_ROD = _Range("mass_per_area.of_rod", 10.0, 4000.0, "kolchin_demidov_2008", ("rod.mass", "rod.big_end_mass"))
# of numbers as they are stated, by their key
_STATED = {
    r"rod\.small_end_share": _Range("small_end_share", 0.1, 0.6, "kolchin_demidov_2008"),
    r"(gas\.points\.[^.]+|(chambers\..+\.)?cycle)\.(\w+_)?pressure": _Range("gas_pressure", 1e4, 1e8, _OWN),
    r"(chambers|gas|cycle)\.(.*[._])?temperature": _Range("cylinder_temperature", 50.0, 4000.0, _OWN),
}
# time of the slower stroke over that of the faster one
_CLEARLY_FASTER = 1.1
# orders of how many cylinders are compared, and how much better another has to be
_MOST_ORDERS, _BETTER, _ZERO = 6, 2.0, 1e-9


def implausible(results: Results, stated: Mapping[str, InputNumber]) -> Iterator[Notice]:
    """Yield a notice for each value far outside normal design; `stated`: numbers of the file by path."""
    machine = results.machine
    yield from _impossible(results, stated)
    yield from _fast_work(results)
    file = machine.inputs() if machine.inputs is not None else None
    is_gauge = file is None or "gas.pressures" not in file.stated or file.stated["gas.pressures"].value == "gauge"
    for path, number in stated.items():
        usual = next((usual for pattern, usual in _STATED.items() if re.fullmatch(pattern, path)), None)
        if usual is not None and not (is_gauge and path.startswith("gas.points")):
            yield from _outside(usual._replace(keys=(path,)), number.value, stated)
    if machine.lengths is None:
        return
    for usual in _RESULTS:
        yield from _outside(usual, results.summary.get(usual.quantity), stated)
    yield from _outside(_WANTED, machine.drive.fluctuation, stated)
    if machine.cylinder is not None:
        yield from _outside(_STROKE, 2 * float(machine.lengths[0]) / machine.cylinder.bore, stated)
        area, masses = math.pi / 4 * machine.cylinder.bore**2, machine.masses
        if masses is not None:
            rod = masses.rod_small_end + masses.rod_big_end
            yield from _outside(_PISTON, masses.piston / area or None, stated)
            yield from _outside(_ROD, rod / area or None, stated)
    if machine.engine is not None and "engine.throws[1]" not in stated:
        yield from _doubtful_order(machine.engine.layout)


def _impossible(results: Results, stated: Mapping[str, InputNumber]) -> Iterator[Notice]:
    """Yield a notice for each efficiency above 1, and for what a test gives below 0."""
    low, reported = 0.0 if results.machine.test is not None else -math.inf, set[str]()
    for key in (*_POSITIVE, *_SHARES):
        value = results.summary.get(key, 0.0)
        if value < low or (key in _SHARES and value > 1 + _ZERO):
            made_of = tuple(in_order([results.trace[key]]))
            paths = [known.node.path for known in made_of if isinstance(known.node, Input)]
            keys = [path for path in dict.fromkeys(paths) if path in stated]
            # what follows from something impossible is so too
            if reported.isdisjoint(known.key for known in made_of):
                yield Notice("impossible", {"quantity": key, "value": value, "keys": ", ".join(keys[:6])})
            reported.add(key)


def _fast_work(results: Results) -> Iterator[Notice]:
    """Yield a notice for each process force on the clearly faster stroke of a slider."""
    for number, load in enumerate(results.machine.loads, start=1):
        if not isinstance(load, ProcessForce) or load.acts == "both":
            continue
        ratio = results.summary.get(f"time_ratio.{load.slider}", 1.0)
        if ratio > _CLEARLY_FASTER:
            high, low = (results.summary[f"slider_displacement_{end}_angle.{load.slider}"] for end in ("max", "min"))
            if load.forward * ((high - low) % math.tau - math.pi) < 0:
                keys = {"path": f"loads[{number}].stroke", "direction": "crank.direction"}
                yield Notice("fast_work", {"name": load.slider, "ratio": ratio, **keys})


def _outside(usual: _Range, value: float | None, stated: Mapping[str, InputNumber]) -> Iterator[Notice]:
    if value is None or usual.low * (1 - _ZERO) <= value <= usual.high * (1 + _ZERO):
        return
    # of many points no single one is to blame
    path = next((key for key in usual.keys if any(path.startswith(key) for path in stated)), usual.keys[0])
    limits = {"low": usual.low, "high": usual.high}
    code = "implausible" if usual.source else "implausible_own"
    yield Notice(code, {"quantity": usual.quantity, "value": value, **limits, "path": path, "source": usual.source})


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
