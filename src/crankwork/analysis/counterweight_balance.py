"""Shaking force and moment of the moving masses of a linkage, its orders, and the best counterweight on the crank."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.harmonics import amplitude_of_order, direction, size_of_sum
from crankwork.dynamics.link_loads import OperatingState, arm, inertia_loads, moment_of
from crankwork.dynamics.reaction import shaking_force
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, Sum, TracedValue, absent, given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.mechanism.mechanism import Crank

_ORDERS = (1, 2, 3, 4)
# share of the added forces below which their sum is rounding
_ROUNDING = 1e-13
_SAMPLES = 1440


def shaking(running: OperatingState) -> Iterator[tuple[str, TracedValue]]:
    """Yield force and moment of all moving masses on the ground, the moment about the pivot of the crank."""
    driver, loads = running.mechanism.driver, inertia_loads(running)
    x = total("shaking_force_x", [force.x for force in loads.forces])
    y = total("shaking_force_y", [force.y for force in loads.forces])
    yield from ((item.key, item) for item in (x, y, shaking_force(x, y).named("shaking_force")))
    if isinstance(driver, Crank):
        pivot = running.motion.frames[driver.link].origin
        moments = [
            moment_of(arm(pivot, force.point), (force.x, force.y), f"{force.link}.shaking") for force in loads.forces
        ]
        turning = [torque.torque for torque in loads.torques]
        stated = [item for item in (*moments, *turning) if not item.is_absent]
        if stated:
            yield "shaking_moment", total("shaking_moment", stated)


def counterweight_balance(
    driver: Crank, trace: Mapping[str, TracedValue], period: float
) -> Iterator[tuple[str, TracedValue]]:
    """Yield the largest force and moment of each order, and the best counterweight on the crank.

    It takes the part of the force that turns with the crank, which makes the mean square of the rest least.
    `period`: crank angle of a cycle [deg].
    """
    forces = trace["shaking_force_x"], trace["shaking_force_y"]
    moment_of_all = trace.get("shaking_moment", absent("shaking_moment"))
    grid, turns = CrankGrid.from_degrees(np.arange(_SAMPLES) * period / _SAMPLES), round(period / 360.0)
    terms = [term for force in forces for term in (force.node.operands if isinstance(force.node, Sum) else (force,))]
    columns = Program(
        {**dict(zip("xyz", (*forces, moment_of_all), strict=True)), **{str(n): term for n, term in enumerate(terms)}}
    )(grid)
    x, y, moments = (columns[axis] + np.zeros(_SAMPLES) for axis in "xyz")
    # terms that cancel leave rounding of their own size
    size = np.max(np.sum([np.abs(columns[str(n)] + np.zeros(_SAMPLES)) for n in range(len(terms))], axis=0))
    coefficients = _coefficients(x + 1j * y, size)
    axes = _coefficients(x, size), _coefficients(y, size)
    # of a cycle of two turns there are half orders too
    counts = range(1, _ORDERS[-1] * turns + 1)
    if moment_of_all.varies:
        yield from _moment_orders(moment_of_all, _coefficients(moments), counts, turns)
    for count in counts:
        parts_of_order = [_turning(forces, axes, count, turns, sense) for sense in (1, -1)]
        sizes = [size_of_sum(part) for part in parts_of_order if part]
        both = abs(coefficients[count]) + abs(coefficients[-count])
        formed = total("", sizes) if sizes else None
        force = ProcedureValue(float(both), "harmonic", forces, argument=formed)
        yield f"free_force.{count / turns:g}", TracedValue(force)
    w, sense = trace["speed"], driver.direction
    forward, parts = complex(coefficients[sense * turns]), _turning(forces, axes, turns, turns, sense)
    formed = size_of_sum(parts) / w / w if parts else None
    moment = ProcedureValue(abs(forward) / w.value**2, "fourier", forces, argument=formed)
    yield "counterweight_moment", TracedValue(moment)
    if forward and parts:
        angle = math.remainder(cmath.phase(-forward) - driver.start, math.tau)
        start = given("line_angle.crank", driver.start, "crank.start")
        cos, sin = (
            TracedValue(ProcedureValue(function(driver.start), word, (start,)))
            for word, function in (("cosine", math.cos), ("sine", math.sin))
        )
        across, up = (
            total("", [wave * take(part) for wave, part in parts if take(part)]) for take in (np.real, np.imag)
        )
        formed = direction(-(across * cos + up * sin), across * sin - up * cos)
        yield "counterweight_angle", TracedValue(ProcedureValue(angle, "fourier", forces, argument=formed))


def _turning(
    forces: tuple[TracedValue, TracedValue], axes: Sequence[NDArray[np.complex128]], count: int, turns: int, sense: int
) -> list[tuple[TracedValue, complex]]:
    """Return the waves of an order and the vectors by which they turn forward (1) or backward (-1) together.

    Empty if they are rounding.
    """
    vectors = (0.5, -0.5j * sense, 0.5j, 0.5 * sense)
    waves = [
        TracedValue(HarmonicCoefficient(2 * part, force, word, count / turns))
        for force, axis in zip(forces, axes, strict=True)
        for word, part in (("cosine", axis[count].real), ("sine", -axis[count].imag))
    ]
    return list(zip(waves, vectors, strict=True)) if any(wave.value for wave in waves) else []


def _coefficients(samples: NDArray[Any], size: float | None = None) -> NDArray[np.complex128]:
    """Return the Fourier coefficients of evenly spaced samples of a cycle; zero if they are rounding.

    `size`: largest sum of the terms of the samples by magnitude; by default the largest sample.
    """
    coefficients: NDArray[np.complex128] = np.fft.fft(samples) / samples.size
    coefficients[np.abs(coefficients) <= _ROUNDING * (np.max(np.abs(samples)) if size is None else size)] = 0.0
    return coefficients


def _moment_orders(
    moment: TracedValue, coefficients: NDArray[np.complex128], counts: Iterable[int], turns: int
) -> Iterator[tuple[str, TracedValue]]:
    """Yield the amplitude of each order of the shaking moment."""
    for count in counts:
        order, both = count / turns, 2 * complex(coefficients[count])
        yield f"shaking_moment_amplitude.{order:g}", amplitude_of_order(moment, order, both.real, -both.imag)
