"""A machine let go whose steps are compiled."""

from __future__ import annotations

import inspect
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import ModuleType

import numpy as np

from crankwork.formula.expression import FORMULAS
from crankwork.kernel.compiled import compiled, compiles
from crankwork.kinematics.crank_grid import Array
from crankwork.resources import read_resource
from crankwork.shaft.gauss_step import POINTS, Step
from crankwork.shaft.piecewise_fit import TO_POWERS, PiecewiseFit
from crankwork.shaft.transient import AT_END, LIGHT, MOST_STEPS, Direction, Integrator, TransientSystem

_AT_ONCE = 128


@lru_cache(maxsize=1)
def _module() -> ModuleType:
    """Return the module of compiled steps."""
    text = read_resource("shaft", "compiled_steps.py")
    # with the formula in its text, so that another formula is another module
    return compiled(f"{text}\n_FORMULA = {inspect.getsource(FORMULAS['acceleration_of_crank'].function)!r}\n")


class CompiledIntegrator(Integrator):
    """A motion whose steps are compiled where nothing happens, of a machine without motor and friction.

    What is asked after every step of another motion is asked after a few of its.
    """

    def __init__(self, machine: TransientSystem, coordinate: float, rate: float) -> None:
        if machine.motor is not None or machine.slipping is not None:
            raise TypeError("steps with motor or friction are not compiled")
        super().__init__(machine, coordinate, rate)
        self._kept = np.empty((_AT_ONCE, 5 + POINTS))

    @cached_property
    def _powers(self) -> dict[Direction, Array]:
        """Inertia, torque, damping and derivative of the inertia for each direction, shape (panels, 16, 4)."""
        J, _, grows, falls, damping, rate, J_1, V_1 = np.moveaxis(self.machine.reduced.powers, 1, 0)
        drive = float(self.machine.drive(np.zeros(1))[0]) * rate - V_1
        up, down = (np.stack([J, push + drive, damping, J_1], axis=-1) for push in (grows, falls))
        return {1: up, -1: down}

    def _advance(self, length: float, watched: Sequence[float]) -> float:
        """Take compiled steps up to a possible event, then one that locates it."""
        if watched or self.machine.changes:
            return super()._advance(length, watched)
        length, is_held_up = self._take_compiled_steps(length)
        return super()._advance(min(length, self.end - self.time), watched) if is_held_up else length

    def _take_compiled_steps(self, length: float) -> tuple[float, bool]:
        """Take compiled steps; return the length to try next, and whether it may not go on so."""
        (low, high), machine, edges, before = self.stretch, self.machine, self.machine.reduced.edges, self.before
        last = int(np.searchsorted(edges, high)) - 1 if math.isfinite(high) else edges.size - 2
        stops = [stop - self.base for stop in machine.stops]
        limits, law = np.array([max(low, stops[0]), min(high, stops[1])]), np.array([low, high, machine.period, last])
        state = np.zeros(7 + POINTS)
        state[:6] = self.time, self.q, self.v, self.base, length, self.largest
        if before is not None:
            state[6], state[7:] = before.length, before.stages
        kept = self._kept[: MOST_STEPS - len(self.trajectory.steps)]
        sizes = np.array([self.end, machine.size])
        direction, powers = float(self.direction), self._powers[self.direction]
        count = _module().take_steps(edges, powers, law, limits, direction, sizes, state, kept)
        self.trajectory.turned += kept[:count, 4].tolist()
        rows = zip(kept[:count, :4].tolist(), kept[:count, 5:].copy(), strict=True)
        self.trajectory.steps += [Step(time, q, v, step, stages) for (time, q, v, step), stages in rows]
        self.time, self.q, self.v, self.base, length, self.largest, was = state[:7].tolist()
        self.before = (self.trajectory.steps[-1] if count else before) if was else None
        return length, count < len(kept) and self.time < self.end * (1 - AT_END)


@dataclass(frozen=True)
class TransientReplay:
    """What a machine let go comes to: from polynomials of a trace over one cycle, where loads are of the angle alone.

    `breaks`: crank angles at which a law of the loads changes [rad]; `stops`, `restitution`: as in `TransientSystem`.
    """

    breaks: tuple[float, ...]
    stops: tuple[float, float]
    restitution: float

    def __call__(self, edges: Array, series: Array) -> tuple[float, float, float]:
        """Return time, turn of the crank and last speed. [s], [rad], [rad/s]

        `series`: Legendre coefficients of inertia, its derivative, torque of loads and damping, and of what is stated:
        time, torque of the drive, first angle and speed.
        """
        J, J_1, M, damping, *stated = series
        if not (np.isfinite(series).all() and np.min(J[:, 0]) > LIGHT * np.max(J[:, 0])):
            return math.nan, math.nan, math.nan
        end, torque, start, speed = (float(column[0, 0]) for column in stated)
        zeros, ones = np.zeros_like(J), np.eye(1, J.shape[1]) + np.zeros_like(J)
        powers = np.stack([J, zeros, M, M, damping, ones, J_1, zeros], axis=1) @ TO_POWERS
        reduced = PiecewiseFit(edges, np.asarray(powers, dtype=float), float(edges[-1] - edges[0]))
        machine = TransientSystem(reduced, self.breaks, torque, stops=self.stops, restitution=self.restitution)
        trajectory = (CompiledIntegrator if compiles() else Integrator)(machine, start, speed).until(end)
        if not trajectory.steps:
            return math.nan, math.nan, math.nan
        q, v = trajectory.steps[-1].end
        return trajectory.end, q + trajectory.turned[-1] - start, v
