"""What burned when, from a known pressure: the first law read backwards, a fitted Wiebe function, polytropes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array
from crankwork.working_cycle.closed_gas import wiebe_burnt_fraction

_STEPS, _SETTLED, _DAMPED = 200, 1e-12, 1e-3
# of a change that tells a derivative
_NUDGE = 1e-6


@dataclass(frozen=True)
class BurningAnalysis:
    """What the analysis of a measured pressure is told. Angles are those of the machine. [deg], [K], [1/K]"""

    start: float  # Of the closed period
    end: float
    heat_ratio: float = 1.33  # At 0 K where it has a slope
    heat_ratio_slope: float = 0.0
    temperature: float | None = (
        None  # Of the gas at the start; without it temperatures and heat to the walls are unknown
    )
    wall_temperature: float | None = None  # Without it no heat goes to the walls
    motored_exponent: float = 1.35
    gas_constant: float = 287.0
    burning: tuple[float, float] | None = None  # Between which angles heat is released
    windows: tuple[tuple[float, float], ...] = ()  # In which polytropes are fitted


@formula("net_heat_rate", "heywood_1988, ch. 9")
def net_heat_rate(gamma_cyl: Value, p_cyl: Value, V_phi: Value, V: Value, p_phi: Value) -> Value:
    """Heat that the gas takes up by crank angle, by the first law: what burning gives less what the walls take."""
    return gamma_cyl / (gamma_cyl - 1) * p_cyl * V_phi + V * p_phi / (gamma_cyl - 1)


@formula("gross_heat_rate", "heywood_1988, ch. 9")
def gross_heat_rate(Q_net_1: Value, Q_wall_1: Value) -> Value:
    """Heat that burning releases by crank angle."""
    return Q_net_1 + Q_wall_1


@formula("burnt_fraction", "heywood_1988, ch. 9")
def released_fraction(Q_hr: Value, Q_hr_0: Value, Q_hr_1: Value) -> Value:
    """Heat released since the start of burning over that until its end."""
    return (Q_hr - Q_hr_0) / (Q_hr_1 - Q_hr_0)


class WiebeFit(NamedTuple):
    """The Wiebe function nearest to a heat: start and duration [deg], exponent, heat [J], scatter over the heat [-]."""

    start: float
    duration: float
    shape: float
    heat: float
    scatter: float


def wiebe_fit(degrees: Array, heat: Array, first: tuple[float, float]) -> WiebeFit | None:
    """Return the Wiebe function nearest to a heat released, by least squares; level and amplitude are free (vibe_1970).

    `first`: start and duration to begin with [deg]. None if none is nearest.
    """
    scale = float(np.ptp(heat)) or 1.0
    widest = np.log([1e4 * float(np.ptp(degrees)), 1e3])

    def left(unknowns: Array) -> tuple[Array, Array]:
        """Return what is left, with level and amplitude; of start, and logarithms of duration and exponent plus 1."""
        progress = np.clip((degrees - unknowns[0]) / np.exp(unknowns[1]), 0.0, 1.0)
        burnt = np.asarray(wiebe_burnt_fraction(progress, np.exp(unknowns[2]) - 1))
        basis = np.stack([np.ones_like(burnt), burnt], axis=1)
        parts = np.linalg.lstsq(basis, heat)[0]
        return (basis @ parts - heat) / scale, parts

    unknowns = np.array([first[0], np.log(first[1]), np.log(3.0)])
    residual, parts = left(unknowns)
    damping = _DAMPED
    for _ in range(_STEPS):
        slopes = np.stack([(left(unknowns + _NUDGE * unit)[0] - residual) / _NUDGE for unit in np.eye(3)], axis=1)
        normal = slopes.T @ slopes
        step = np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-30), -slopes.T @ residual)
        if np.any(np.abs((unknowns + step)[1:]) > widest):
            return None
        tried = left(unknowns + step)
        if tried[0] @ tried[0] < residual @ residual:
            is_settled = residual @ residual - tried[0] @ tried[0] <= _SETTLED * (residual @ residual)
            unknowns, (residual, parts), damping = unknowns + step, tried, damping / 10
            if is_settled:
                break
        elif damping > 1 / _SETTLED:
            break
        else:
            damping *= 10
    else:
        return None
    amplitude = float(parts[1])
    scatter = float(np.sqrt(np.mean(residual**2))) * scale / abs(amplitude)
    return WiebeFit(float(unknowns[0]), float(np.exp(unknowns[1])), float(np.exp(unknowns[2]) - 1), amplitude, scatter)


class Polytrope(NamedTuple):
    """A straight line in logarithms of pressure over volume: its exponent, and the scatter of ln p about it."""

    exponent: float
    scatter: float


def fitted_polytrope(volume: Array, pressure: Array) -> Polytrope:
    """Return the polytrope nearest to pressures over volumes. [m3], [Pa]"""
    x, y = np.log(volume), np.log(pressure)
    basis = np.stack([x - x.mean(), np.ones_like(x)], axis=1)
    line = np.linalg.lstsq(basis, y)[0]
    return Polytrope(-float(line[0]), float(np.sqrt(np.mean((basis @ line - y) ** 2))))
