"""Natural and forced vibration of a torsional system as functions of its numbers, for a trace that is replayed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.torsional_system import (
    Complex,
    Modes,
    TorsionalStructure,
    TorsionalSystem,
    largest_of_waves,
    normalised,
)


@dataclass(frozen=True)
class NaturalModes:
    """Natural frequencies of a structure, and the relative amplitudes of its discs, mode by mode."""

    structure: TorsionalStructure
    listed: int

    @property
    def count(self) -> int:
        """How many modes are listed."""
        return min(self.listed, self._most)

    @property
    def _most(self) -> int:
        inner = sum(19 if item == 0 else (item or 1) - 1 for item in self.structure.elements)
        return max(len(set(self.structure.groups)) + inner - self.structure.free_parts, 0)

    @property
    def heavy(self) -> tuple[int, ...]:
        """Shafts whose own inertia counts."""
        return tuple(index for index, item in enumerate(self.structure.elements) if item is not None)

    @property
    def count_of_numbers(self) -> int:
        """How many numbers the system has."""
        structure = self.structure
        return structure.discs + len(structure.shafts) + len(structure.gears) + len(self.heavy)

    def system(self, numbers: Sequence[float] | Array) -> TorsionalSystem:
        """Return the system: inertias of discs, stiffnesses of shafts, ratios of gears, inertias of shafts."""
        discs, shafts, gears = self.structure.discs, len(self.structure.shafts), len(self.structure.gears)
        inertia, stiffness, ratio, own = np.split(np.asarray(numbers, dtype=float), np.cumsum([discs, shafts, gears]))
        of_shafts = np.zeros(shafts)
        of_shafts[list(self.heavy)] = own
        return TorsionalSystem(self.structure, inertia, stiffness, ratio, of_shafts)

    def modes(self, numbers: Sequence[float]) -> Modes:
        """Return the modes that twist, as many as are listed, the first disc at one."""
        modes = self.system(numbers).modes()
        kept = slice(modes.rigid, modes.rigid + self.count)
        shapes = [normalised(shape) for shape in modes.shape[kept]]
        return Modes(modes.frequency[kept], np.array(shapes).reshape(-1, self.structure.discs), 0)

    def __call__(self, _: Array, series: Array) -> list[float]:
        """Return frequencies [rad/s], then amplitudes mode by mode. `series`: coefficients of the numbers."""
        modes = self.modes([float(column[0, 0]) for column in series])
        missing = self.count - modes.frequency.size
        return [*modes.frequency.tolist(), *modes.shape.ravel().tolist(), *([np.nan] * missing)]


class Wave(NamedTuple):
    """One harmonic of a torque on a disc: where its parts stand among the numbers, and how it grows with the speed."""

    disc: int
    order: float  # Zero of a torque of a frequency of its own [-]
    cosine: int
    sine: int | None
    phase: float = 0.0  # By which it is ahead, beside its own [rad]
    is_inertia: bool = False  # Whether it grows with the square of the speed
    frequency: int | None = None  # Where that frequency stands among the numbers


class Vibration(NamedTuple):
    """Forced vibration at several speeds: complex amplitudes by order, and largest values over a cycle."""

    orders: Array  # (k,) [-]
    angle: Complex  # Of discs (speeds, k, discs) [rad]
    torque: Complex  # In shafts (speeds, k, shafts) [N m]
    largest_angle: Array  # (speeds, discs) [rad]
    largest_torque: Array  # (speeds, shafts) [N m]


@dataclass(frozen=True)
class ForcedVibration:
    """Forced vibration of a structure: largest angles of discs over a cycle, then largest torques in shafts.

    Numbers: those of the system with all rings, damping of discs, damping and loss factors of shafts, the speed, then
    those of the torques. `cycle`: angle after which all repeat [rad].
    """

    natural: NaturalModes
    waves: tuple[Wave, ...]
    cycle: float

    @property
    def first(self) -> int:
        """Where the numbers of the torques begin, behind the speed."""
        structure = self.natural.structure
        return self.natural.count_of_numbers + structure.discs + 2 * len(structure.shafts) + 1

    def system(self, numbers: Array) -> TorsionalSystem:
        """Return the system with what damps it."""
        structure, own = self.natural.structure, self.natural.count_of_numbers
        discs, shafts = structure.discs, len(structure.shafts)
        held, damping, loss = np.split(numbers[own : self.first - 1], np.cumsum([discs, shafts]))
        elastic = self.natural.system(numbers[:own])
        return replace(elastic, disc_damping=held, shaft_damping=damping, loss_factor=loss)

    def amplitudes(self, numbers: Array, speeds: Array) -> tuple[Array, Complex]:
        """Return the orders, and the complex amplitudes of torques on discs, shape (speeds, k, discs). [N m]"""
        orders = np.unique([wave.order for wave in self.waves if wave.frequency is None])
        torque = np.zeros((speeds.size, orders.size, self.natural.structure.discs), dtype=complex)
        stated, growth = float(numbers[self.first - 1]), None
        for wave in self.waves:
            if wave.frequency is None:
                if wave.is_inertia and growth is None:
                    growth = (speeds / stated) ** 2
                amplitude = self._amplitude(numbers, wave)
                torque[:, np.searchsorted(orders, wave.order), wave.disc] += (
                    growth * amplitude if wave.is_inertia and growth is not None else amplitude
                )
        return orders, torque

    def _amplitude(self, numbers: Array, wave: Wave) -> complex:
        own = numbers[self.first :]
        sine = 0.0 if wave.sine is None else own[wave.sine]
        return complex((own[wave.cosine] - 1j * sine) * np.exp(1j * wave.phase))

    def vibration(self, numbers: Array, speeds: Array) -> Vibration:
        """Return the forced vibration at speeds. [rad/s]"""
        system, structure = self.system(numbers), self.natural.structure
        orders, torque = self.amplitudes(numbers, speeds)
        count, kinds = speeds.size, orders.size
        frequency = np.outer(speeds, orders).ravel()
        angle, inside = system.forced(frequency, torque.reshape(count * kinds, structure.discs))
        angle = angle.reshape(count, kinds, structure.discs)
        inside = inside.reshape(count, kinds, len(structure.shafts))
        both = np.concatenate([angle, inside], axis=2)
        largest = np.zeros((count, both.shape[2]))
        if kinds:
            waves = both.swapaxes(0, 1).reshape(kinds, -1)
            largest = largest_of_waves(orders, waves, self.cycle).reshape(count, -1)
        for wave in self.waves:
            if wave.frequency is not None:
                own = np.zeros((1, structure.discs), dtype=complex)
                own[0, wave.disc] = self._amplitude(numbers, wave)
                alone = system.forced([numbers[self.first + wave.frequency]], own)
                largest = largest + np.abs(np.concatenate(alone, axis=1))
        return Vibration(orders, angle, inside, largest[:, : structure.discs], largest[:, structure.discs :])

    def __call__(self, _: Array, series: Array) -> list[float]:
        """Return largest angles [rad] and torques [N m] at the stated speed. `series`: coefficients of the numbers."""
        numbers = np.array([float(column[0, 0]) for column in series])
        vibration = self.vibration(numbers, numbers[self.first - 1 : self.first])
        return [*vibration.largest_angle[0].tolist(), *vibration.largest_torque[0].tolist()]


@dataclass(frozen=True)
class DampedDisc:
    """Frequency [rad/s] of the mode that a damper on a disc is made for, and its effective inertia there [kg m2]."""

    natural: NaturalModes
    disc: int
    mode: int

    def __call__(self, _: Array, series: Array) -> tuple[float, float]:
        """Return both. `series`: coefficients of the numbers."""
        return self.of([float(column[0, 0]) for column in series])

    def of(self, numbers: Sequence[float]) -> tuple[float, float]:
        """Return both from the numbers of the system; no numbers where there is no such mode or the disc stands."""
        modes = self.natural.system(numbers).modes()
        index = modes.rigid + self.mode - 1
        if index >= modes.frequency.size:
            return math.nan, math.nan
        shape = modes.shape[index]
        if abs(shape[self.disc]) <= 1e-6 * np.max(np.abs(shape)):
            return math.nan, math.nan
        # shapes have a modal inertia of one
        return float(modes.frequency[index]), float(1 / shape[self.disc] ** 2)


def damped_modes(system: TorsionalSystem) -> Complex:
    """Return the complex roots of free damped vibration, ascending by frequency: what decays and what turns. [rad/s]

    Of viscous damping; a loss factor damps as much as its viscous damping at no frequency of its own.
    """
    twist, factor, shaft, mass, to_discs = system.assembled
    count = mass.shape[0]
    stiffness = twist.T @ ((factor * system.stiffness[shaft])[:, None] * twist)
    damping = twist.T @ ((factor * system.shaft_damping[shaft])[:, None] * twist)
    damping = damping + to_discs.T * system.disc_damping @ to_discs
    top = np.concatenate([np.zeros((count, count)), np.eye(count)], axis=1)
    below = -np.linalg.solve(mass, np.concatenate([stiffness, damping], axis=1))
    roots = np.linalg.eigvals(np.concatenate([top, below]))
    size = float(np.max(np.abs(roots), initial=0.0))
    turning = roots[roots.imag > 1e-7 * size]
    return np.asarray(turning[np.argsort(turning.imag)])
