"""Torsional vibration of discs on elastic shafts: natural modes, Holzer's table, forced vibration, for a trace."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.kinematics.crank_grid import Array


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


Complex = NDArray[np.complex128]

# the number of an end that does not turn
GROUND = -1
# degree of the polynomials of a shaft with mass whose number of elements is not stated
_DEGREE = 20
# an amplitude below this part of the largest is that of a node
_NODE = 1e-9
# part of a frequency
_OFFSET = 1e-12
_NO_NUMBERS = partial(np.empty, 0)
# points of a cycle for each wave of the highest order, and least number of them
_PER_WAVE, _FEWEST = 16, 256


class Modes(NamedTuple):
    """Natural modes: angular frequencies, ascending, and the angles of discs in each, shape (modes, discs)."""

    frequency: Array  # Of turning without twist zero [rad/s]
    shape: Array  # [-]
    rigid: int  # How many modes are turning without twist


class HolzerRow(NamedTuple):
    """One disc of a table by Holzer, and the shaft that leads on from it."""

    disc: int
    amplitude: float  # [rad]
    torque: float  # Of its inertia [N m]
    shaft: int | None  # None behind the last disc, and in a mesh of gears
    sum: float  # Torque in that shaft [N m]


class HolzerTable(NamedTuple):
    """A table by Holzer: rows towards the last disc, and the torque that is left there. [N m]"""

    rows: tuple[HolzerRow, ...]
    remainder: float


@dataclass(frozen=True)
class TorsionalStructure:
    """What is joined to what: equal structures differ in numbers only."""

    discs: int
    shafts: tuple[tuple[int, int], ...]  # Discs at both ends of each shaft, one may be `GROUND`
    gears: tuple[tuple[int, int], ...] = ()  # Discs that turn at a fixed ratio
    # Elements of each shaft: none of one without mass, 0 for polynomials along it
    elements: tuple[int | None, ...] = ()
    rings: int = 0  # How many of the last discs are held by dampers without springs

    @cached_property
    def neighbours(self) -> tuple[tuple[tuple[int, int | None, int | None], ...], ...]:
        """Of each disc those beside it: their number, and that of the shaft or of the gears between them."""
        neighbours: list[list[tuple[int, int | None, int | None]]] = [[] for _ in range(self.discs)]
        for kind, pairs in enumerate((self.shafts, self.gears)):
            for index, (a, b) in enumerate(pairs):
                for disc, other in ((a, b), (b, a)):
                    if disc != GROUND:
                        neighbours[disc].append((other, None if kind else index, index if kind else None))
        return tuple(map(tuple, neighbours))

    @property
    def groups(self) -> list[int]:
        """The group of each disc: discs in mesh turn as one."""
        return _joined(self.discs, self.gears)

    @property
    def free_parts(self) -> int:
        """How many parts of the system turn without twisting any shaft."""
        own = [(a, b) for a, b in self.shafts if GROUND not in (a, b)]
        part = _joined(self.discs, (*own, *self.gears))
        held = {part[a if b == GROUND else b] for a, b in self.shafts if GROUND in (a, b)}
        return len(set(part) - held)

    @property
    def is_tree(self) -> bool:
        """Whether there is one way only between any two discs, all of which hang together."""
        inner = [(a, b) for a, b in self.shafts if GROUND not in (a, b)]
        edges = len(inner) + len(self.gears)
        return edges == self.discs - 1 and len(set(_joined(self.discs, (*inner, *self.gears)))) == 1

    def without_rings(self) -> TorsionalStructure:
        """Return the structure without what only dampers hold, which vibrates freely beside it."""
        kept = self.discs - self.rings
        shafts = tuple(pair for pair in self.shafts if max(pair) < kept)
        return TorsionalStructure(kept, shafts, self.gears, self.elements[: len(shafts)])


def _joined(count: int, pairs: Sequence[tuple[int, int]]) -> list[int]:
    """Return the least number of those that each is joined to."""
    label = list(range(count))
    for a, b in pairs:
        low, high = sorted((label[a], label[b]))
        label = [low if item == high else item for item in label]
    return label


@lru_cache(maxsize=1)
def _polynomial_mass() -> Array:
    """Return the mass matrix of a shaft of unit inertia: both ends, then integrals of Legendre polynomials."""
    nodes, weights = np.polynomial.legendre.leggauss(_DEGREE + 1)
    shapes: list[Array] = [(1 - nodes) / 2, (1 + nodes) / 2]
    for degree in range(1, _DEGREE):
        # with a slope whose square has an integral of one
        series = np.polynomial.legendre.legint(np.eye(degree + 1)[degree], lbnd=-1)
        shapes.append(np.asarray(math.sqrt(degree + 0.5) * np.polynomial.legendre.legval(nodes, series), dtype=float))
    values = np.array(shapes)
    return np.asarray(values * (weights / 2) @ values.T)


@dataclass(frozen=True, eq=False)
class TorsionalSystem:
    """Discs on elastic shafts with their numbers; what damps may be left out.

    Discs of a group turn at the ratios of their gears; the unknowns are the angles of the first disc of each group and
    those inside shafts that have mass.
    """

    structure: TorsionalStructure
    inertia: Array  # Of discs [kg m2]
    stiffness: Array  # Of shafts [N m/rad]
    ratio: Array = field(default_factory=_NO_NUMBERS)  # Of gears: speed of the second disc over that of the first [-]
    own_inertia: Array = field(default_factory=_NO_NUMBERS)  # Of shafts [kg m2]
    disc_damping: Array = field(default_factory=_NO_NUMBERS)  # Against the ground [N m s/rad]
    shaft_damping: Array = field(default_factory=_NO_NUMBERS)  # Relative [N m s/rad]
    loss_factor: Array = field(default_factory=_NO_NUMBERS)  # Of the stiffness of shafts [-]

    @cached_property
    def speed_ratios(self) -> Array:
        """Speed of each disc over that of the first disc of its group. [-]"""
        ratios = np.ones(self.structure.discs)
        done = set(self.structure.groups)
        stack = list(done)
        while stack:
            disc = stack.pop()
            for other, _, gear in self.structure.neighbours[disc]:
                if gear is not None and other not in done:
                    i = self.ratio[gear]
                    ratios[other] = ratios[disc] * (i if self.structure.gears[gear][0] == disc else 1 / i)
                    done.add(other)
                    stack.append(other)
        return ratios

    @cached_property
    def assembled(self) -> tuple[Array, Array, NDArray[np.intp], Array, Array]:
        """Twists by unknowns, their stiffness factors and shafts, the mass matrix, and discs by unknowns."""
        structure, count = self.structure, self.structure.discs
        rows: list[tuple[dict[int, float], float, int]] = []
        masses: list[tuple[list[int], Array]] = []
        unknowns = count
        for index, (a, b) in enumerate(structure.shafts):
            parts = structure.elements[index] if index < len(structure.elements) else None
            own = self.own_inertia[index] if parts is not None else 0.0
            inner = list(range(unknowns, unknowns + (0 if parts is None else (parts or _DEGREE) - 1)))
            unknowns += len(inner)
            if parts == 0:
                rows += [({a: 1.0, b: -1.0}, 1.0, index), *(({bubble: 1.0}, 2.0, index) for bubble in inner)]
                masses.append(([a, b, *inner], own * _polynomial_mass()))
                continue
            chain = [a, *inner, b]
            for first, second in itertools.pairwise(chain):
                rows.append(({first: 1.0, second: -1.0}, float(parts or 1), index))
                masses.append(([first, second], own / (parts or 1) / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])))
        twist, mass = np.zeros((len(rows), unknowns)), np.zeros((unknowns, unknowns))
        for row, (ends, _, _) in enumerate(rows):
            for place, sign in ends.items():
                if place != GROUND:
                    twist[row, place] += sign
        for places, part in masses:
            kept = [item for item, place in enumerate(places) if place != GROUND]
            where = [places[item] for item in kept]
            mass[np.ix_(where, where)] += part[np.ix_(kept, kept)]
        mass[range(count), range(count)] += self.inertia
        factor, shaft = (np.array([row[item] for row in rows]) for item in (1, 2))
        # discs in mesh turn as one
        groups = sorted(set(structure.groups))
        to_discs = np.zeros((unknowns, len(groups) + unknowns - count))
        for disc, group in enumerate(structure.groups):
            to_discs[disc, groups.index(group)] = self.speed_ratios[disc]
        inner_rows = np.arange(count, unknowns)
        to_discs[inner_rows, inner_rows - count + len(groups)] = 1.0
        return twist @ to_discs, factor, shaft.astype(int), to_discs.T @ mass @ to_discs, to_discs[:count]

    def modes(self) -> Modes:
        """Return the undamped natural modes.

        Squares of frequencies are singular values of the twists over the roots of stiffnesses and inertias, which have
        twice the digits of eigenvalues (thomson_1988, ch. 6); unknowns without inertia are eliminated first.
        """
        twist, factor, shaft, mass, to_discs = self.assembled
        root = np.sqrt(factor * self.stiffness[shaft])[:, None] * twist
        is_heavy = np.diag(mass) > 0
        if not is_heavy.any():
            return Modes(np.empty(0), np.empty((0, self.structure.discs)), 0)
        heavy, light = root[:, is_heavy], root[:, ~is_heavy]
        q, _ = np.linalg.qr(light)
        lower = np.linalg.cholesky(mass[np.ix_(is_heavy, is_heavy)])
        scaled = np.linalg.solve(lower, (heavy - q @ (q.T @ heavy)).T).T
        _, values, vectors = np.linalg.svd(scaled, full_matrices=True)
        count = vectors.shape[0]
        frequency = np.zeros(count)
        frequency[: values.size] = values[:count]
        order = np.argsort(frequency, kind="stable")
        angles = np.zeros((count, is_heavy.size))
        angles[:, is_heavy] = np.linalg.solve(lower.T, vectors[order].T).T
        if light.shape[1]:
            angles[:, ~is_heavy] = -np.linalg.lstsq(light, heavy @ angles[:, is_heavy].T)[0].T
        frequency, rigid = frequency[order], self.structure.free_parts
        frequency[:rigid] = 0.0
        return Modes(frequency, np.asarray(angles @ to_discs.T), rigid)

    def forced(self, frequency: ArrayLike, torque: Complex) -> tuple[Complex, Complex]:
        """Return complex amplitudes of the angles of discs and of the torques in shafts. [rad], [N m]

        `frequency`: angular frequencies of the torques, shape (n,) [rad/s]; `torque`: complex amplitudes on discs,
        shape (n, discs) [N m].
        """
        w = np.asarray(frequency, dtype=float)[:, None, None]
        twist, factor, shaft, mass, to_discs = self.assembled
        count = self.stiffness.size
        loss, damping = (item if item.size else np.zeros(count) for item in (self.loss_factor, self.shaft_damping))
        held = self.disc_damping if self.disc_damping.size else np.zeros(self.structure.discs)
        stiff = (factor * (self.stiffness * (1 + 1j * loss))[shaft])[:, None] * twist
        slow = (factor * damping[shaft])[:, None] * twist
        dynamic = twist.T @ stiff + 1j * w * (twist.T @ slow + to_discs.T * held @ to_discs) - w**2 * mass
        try:
            angle = np.linalg.solve(dynamic, (torque @ to_discs)[:, :, None])[:, :, 0]
        except np.linalg.LinAlgError:
            # without damping exactly at a natural frequency: beside it the amplitude is as good as infinite
            return self.forced(np.asarray(frequency, dtype=float) * (1 + _OFFSET), torque)
        # of a shaft with mass the torque at its middle part
        first = np.searchsorted(shaft, np.arange(count))
        inside = angle @ stiff[first].T + 1j * w[:, :, 0] * (angle @ slow[first].T)
        return angle @ to_discs.T, inside

    @cached_property
    def _links(self) -> list[tuple[int, int, int | None, float]]:
        """Of a tree, from its ends to the last disc: disc, the next one, the shaft between, ratio of their speeds.

        The speed is that over the one of the next disc, one at a shaft.
        """
        links: list[tuple[int, int, int | None, float]] = []

        def visit(disc: int, parent: int) -> None:
            for other, shaft, gear in self.structure.neighbours[disc]:
                if other not in (GROUND, parent):
                    visit(other, disc)
                    i = 1.0 if gear is None else self.ratio[gear]
                    forward = gear is None or self.structure.gears[gear][0] == disc
                    links.append((other, disc, shaft, float(i if forward else 1 / i)))

        visit(self.structure.discs - 1, GROUND)
        return links

    @cached_property
    def _held(self) -> Array:
        """Stiffness between each disc and the ground. [N m/rad]"""
        held = np.zeros(self.structure.discs)
        for (a, b), k in zip(self.structure.shafts, self.stiffness, strict=True):
            if GROUND in (a, b):
                held[a if b == GROUND else b] += k
        return held

    def trial(self, frequency: float) -> Array:
        """Return the angles of discs at a frequency that only the last disc is out of balance at, the first at one.

        Branches meet with one angle [rad/s] (holzer_1921).
        """
        torque = np.eye(1, self.structure.discs, self.structure.discs - 1).astype(complex)
        return normalised(self.forced([frequency], torque)[0][0].real)

    def holzer(self, frequency: float, angle: Array) -> HolzerTable:
        """Return the table by Holzer at a frequency [rad/s], of the angles of a mode or of a trial."""
        torque = self.inertia * frequency**2 * angle
        sums, rows = torque - self._held * angle, list[HolzerRow]()
        for disc, following, shaft, i in self._links:
            rows.append(HolzerRow(disc, float(angle[disc]), float(torque[disc]), shaft, float(sums[disc])))
            sums[following] += sums[disc] * i
        last = self.structure.discs - 1
        rows.append(HolzerRow(last, float(angle[last]), float(torque[last]), None, float(sums[last])))
        return HolzerTable(tuple(rows), float(sums[last]))


def normalised(shape: Array) -> Array:
    """Return the angles of a mode with one at the first disc, or at that which turns most if the first is a node."""
    largest = shape[np.argmax(np.abs(shape))]
    return np.asarray(shape / (shape[0] if abs(shape[0]) > _NODE * abs(largest) else largest))


def largest_of_waves(orders: Array, amplitudes: Complex, cycle: float) -> Array:
    """Return the largest size over a cycle [rad] of sums of waves, shape (k, n) -> (n,)."""
    count = max(_FEWEST, math.ceil(_PER_WAVE * float(np.max(orders)) * cycle / math.tau))
    angle = np.arange(count) * (cycle / count)
    waves = np.exp(1j * np.outer(angle, orders))
    values = (waves @ amplitudes).real
    best = np.argmax(np.abs(values), axis=0)
    columns = np.arange(amplitudes.shape[1])
    # one step of Newton from the largest point
    turned = waves[best] * amplitudes.T
    slope, bend = ((turned * (1j * orders) ** n).real.sum(axis=1) for n in (1, 2))
    step = np.where(bend == 0, 0.0, -slope / np.where(bend == 0, 1.0, bend))
    step = np.clip(step, -cycle / count, cycle / count)
    refined = (turned * np.exp(1j * np.outer(step, orders))).real.sum(axis=1)
    return np.asarray(np.maximum(np.abs(refined), np.abs(values[best, columns])))
