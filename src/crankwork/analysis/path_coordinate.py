"""A coordinate that grows along the whole path of a linkage, through the dead positions of its crank."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.circuits import with_branches
from crankwork.kinematics.configuration_curve import driver_coordinate
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.crank_range import CrankRange, branches_of
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.mechanism import Mechanism

# share of the path between dead positions within which rates by the crank lose their digits
CLOSE = 1e-6


class PathSegment(NamedTuple):
    """A branch of a linkage: the crank angle goes from one dead position to the next as the coordinate grows."""

    mechanism: Mechanism
    # Coordinates, and crank angles there [rad]
    low: float
    high: float
    first: float
    last: float
    turns_back: bool  # Whether its ends are dead positions; the coordinate is the crank angle where they are none

    def at(self, angle: float) -> float:
        """Return the coordinate of a crank angle of this branch. [rad]"""
        if not self.turns_back:
            return angle
        share = (angle - self.first) / (self.last - self.first)
        return self.low + (self.high - self.low) * math.acos(min(max(1 - 2 * share, -1.0), 1.0)) / math.pi

    def crank(self, u: Array) -> Transfer:
        """Return the crank angle and its derivatives by the coordinate. [rad]"""
        if not self.turns_back:
            return Transfer(u, np.ones_like(u), np.zeros_like(u))
        half, rate = (self.last - self.first) / 2, math.pi / (self.high - self.low)
        angle = rate * (u - self.low)
        # from the nearer end, where the difference to it is small
        away = half * 2 * np.sin(angle / 2) ** 2
        return Transfer(self.first + away, half * rate * np.sin(angle), half * rate**2 * np.cos(angle))


@dataclass(frozen=True)
class PathCoordinate:
    """A coordinate that grows along the whole path of a linkage, through the dead positions of its crank."""

    pieces: tuple[PathSegment, ...]
    period: float  # Infinite where the path has ends

    @property
    def ends(self) -> tuple[float, ...]:
        """Where pieces meet."""
        return (self.pieces[0].low, *(piece.high for piece in self.pieces))

    def each(self, u: Array) -> Iterator[tuple[PathSegment, NDArray[np.intp]]]:
        """Yield the pieces, and which of some coordinates of the first period are on them."""
        inner = [piece.low for piece in self.pieces[1:]]
        which = np.searchsorted(inner, u, side="right")
        for k, piece in enumerate(self.pieces):
            index = np.flatnonzero(which == k)
            if index.size:
                yield piece, index

    def within(self, u: Array) -> tuple[Array, Array]:
        """Return coordinates in the first period, and the crank angle of whole turns before it. [rad]"""
        if math.isinf(self.period):
            return u, np.zeros_like(u)
        turns = np.floor((u - self.ends[0]) / self.period)
        return u - turns * self.period, (0.0 if self.pieces[0].turns_back else self.period) * turns

    def places(self, u: Array) -> Iterator[tuple[PathSegment, NDArray[np.intp], Array]]:
        """Yield the pieces, which of some coordinates are on them, and the crank angles there, up to whole turns."""
        inside = self.within(u)[0]
        for piece, index in self.each(inside):
            yield piece, index, piece.crank(inside[index]).position

    def margin(self, u: Array) -> Array:
        """Return the distance of coordinates from the dead positions, over the path between these. [-]"""
        if not self.pieces[0].turns_back:
            return np.full_like(u, np.inf)
        distance = np.abs(self.within(u)[0][:, None] - np.array(self.ends)).min(axis=1)
        return np.asarray(distance / (self.ends[-1] - self.ends[0]))

    def off_dead_positions(self, u: Array) -> Array:
        """Return coordinates, moved off the dead positions to where a motion has rates by the crank."""
        return np.where(self.margin(u) < CLOSE, u + 2 * CLOSE * (self.ends[-1] - self.ends[0]) * _inward(self, u), u)

    def crank(self, u: Array) -> Transfer:
        """Return the crank angle and its derivatives by the coordinate, turns counted. [rad]"""
        inside, turned = self.within(u)
        result = np.empty((3, u.size))
        for piece, index in self.each(inside):
            result[:, index] = piece.crank(inside[index])
        return Transfer(result[0] + turned, result[1], result[2])

    def walls(self, start: float, stops: tuple[float, float]) -> tuple[float, float]:
        """Return the coordinates nearest to that of a start at which the crank is at one of its stops. [rad]"""
        if not self.pieces[0].turns_back:
            return stops
        u, around = self.coordinate(start), (0.0,) if math.isinf(self.period) else (-self.period, 0.0, self.period)
        coordinates = [
            piece.at(stop) + turn
            for piece in self.pieces
            for stop in stops
            if min(piece.first, piece.last) < stop < max(piece.first, piece.last)
            for turn in around
        ]
        below, above = [item for item in coordinates if item <= u], [item for item in coordinates if item >= u]
        return max(below, default=-math.inf), min(above, default=math.inf)

    def coordinate(self, angle: float) -> float:
        """Return the coordinate of a crank angle on the first piece. [rad]"""
        return self.pieces[0].at(angle)


def path_coordinate(machine: Machine, travel: CrankRange | None) -> PathCoordinate:
    """Return the coordinate along the path of a linkage: its crank angle, or one that grows where that turns back."""
    if travel is None or travel.is_whole:
        turn = math.radians(machine.cycle)
        return PathCoordinate((PathSegment(machine.mechanism, 0.0, turn, 0.0, turn, turns_back=False),), turn)
    circuit = travel.circuit
    only_dyads = all(isinstance(dyad, RRR | RRP | RPR) for dyad in machine.mechanism.dyads)
    parts = circuit.branches(driver_coordinate(circuit.mechanism))
    if not (only_dyads and circuit.curve.is_closed and not len(circuit.curve.crossings)):
        parts = [travel.branch]
    stated = next((k for k, part in enumerate(parts) if _same(part, travel.branch, circuit.curve.length)), 0)
    parts = [*parts[stated:], *parts[:stated]]
    pieces, low = [], 0.0
    for part in parts:
        first, last = (float(value) for value in circuit.values(driver_coordinate(circuit.mechanism), np.array(part)))
        mechanism = machine.mechanism
        if len(parts) > 1:
            middle = circuit.stretch(np.array([(part.start + part.end) / 2]))
            mechanism = with_branches(replace(mechanism, passages={}), branches_of(mechanism, middle))
        # the same rate at the dead position for the pieces on both sides of it
        high = low + math.pi * math.sqrt(abs(last - first) / 2)
        pieces.append(PathSegment(mechanism, low, high, first, last, turns_back=True))
        low = high
    return PathCoordinate(tuple(pieces), low if len(parts) > 1 else math.inf)


def _inward(chart: PathCoordinate, u: Array) -> Array:
    """Return the direction into a chart: backwards from its second half, if it has ends."""
    return np.where(np.isinf(chart.period) & (u > (chart.ends[0] + chart.ends[-1]) / 2), -1.0, 1.0)


def _same(first: tuple[float, float], second: tuple[float, float], length: float) -> bool:
    shift = (sum(first) - sum(second)) / 2
    return abs(shift - length * round(shift / length)) < 1e-6 * length
