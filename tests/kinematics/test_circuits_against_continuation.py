"""Circuits and limits of random linkages against a continuation with other unknowns, equations and steps."""

import math

import numpy as np
import pytest

from crankwork.kinematics.circuits import all_circuits
from crankwork.kinematics.configuration_curve import driver_coordinate, link_angle
from crankwork.mechanism.catalog import four_bar, stephenson_six_bar, watt_six_bar

pytestmark = pytest.mark.elsewhere

STEP = 0.02


class Loops:
    """Links as vectors in the complex plane: sums of length times direction that must come to a constant."""

    def __init__(self, loops, names):
        self.loops, self.names = loops, names  # each loop: {link: complex length}, constant
        count = range(len(names))
        self.others = [[one for one in count if one != left_out] for left_out in count]

    def value(self, angle):
        sums = [sum(z * np.exp(1j * angle[k]) for k, z in loop.items()) - end for loop, end in self.loops]
        return np.array([part for one in sums for part in (one.real, one.imag)])

    def jacobian(self, angle):
        matrix = np.zeros((2 * len(self.loops), len(self.names)))
        for row, (loop, _) in enumerate(self.loops):
            for k, z in loop.items():
                turned = 1j * z * np.exp(1j * angle[k])
                matrix[2 * row, k], matrix[2 * row + 1, k] = turned.real, turned.imag
        return matrix

    def way(self, angle):
        """The directions are the minors of the Jacobian, each with one column left out."""
        minors = np.linalg.det(self.jacobian(angle)[:, self.others].swapaxes(0, 1))
        return minors * (-1.0) ** np.arange(len(angle))

    def onto(self, angle):
        for _ in range(20):
            step = np.linalg.lstsq(self.jacobian(angle), -self.value(angle), rcond=None)[0]
            angle = angle + step
            if np.abs(step).max() < 1e-13:
                break
        return angle

    def follow(self, start):
        """Midpoint steps along the minors, then the nearest solution; back at the start when that lies on a step."""
        here, path = start, [start]
        while len(path) < 100_000:
            way = self.way(here)
            size = np.linalg.norm(way)
            step = min(STEP, 0.3 * size / np.linalg.norm(self.way(here + 1e-4 * way / size) - way) * 1e-4)
            middle = self.way(here + step / 2 * way / size)
            following = self.onto(here + step * middle / np.linalg.norm(middle))
            gap = np.angle(np.exp(1j * (start - here)))
            chord = following - here
            if len(path) > 3 and 0 < gap @ chord <= chord @ chord and np.linalg.norm(gap) < 1.5 * np.linalg.norm(chord):
                path.append(here + gap)
                return np.array(path)
            here = following
            path.append(here)
        raise AssertionError("never back")

    def turned_back(self, path, k):
        """Positions in which one direction turns back: there the minor without its column is zero."""
        minors = np.array([self.way(one)[k] for one in path])
        found = []
        for at in np.flatnonzero(minors[1:] * minors[:-1] < 0):
            low, high, sign = path[at], path[at + 1], np.sign(minors[at])
            for _ in range(60):
                middle = self.onto((low + high) / 2)
                low, high = (middle, high) if np.sign(self.way(middle)[k]) == sign else (low, middle)
            found.append((low + high) / 2)
        return found


def _crossings(centre, radius, other, far):
    gap = abs(other - centre)
    along = (radius**2 - far**2 + gap**2) / (2 * gap)
    if along**2 > radius**2:
        return []
    across = math.sqrt(radius**2 - along**2)
    direction = (other - centre) / gap
    return [centre + direction * complex(along, sign * across) for sign in (1, -1)]


def _random(random):
    crank, coupler, rocker, ground = random.uniform(0.3, 1.5, 4)
    first = four_bar(crank, coupler, rocker, ground)
    loops = [({0: crank, 1: coupler, 2: -rocker}, ground)]
    if (kind := random.integers(3)) == 0:
        return first, Loops(loops, ["crank", "coupler", "rocker"]), None
    pin, link, output = complex(*random.uniform(-0.8, 0.8, 2)), *random.uniform(0.5, 1.6, 2)
    pivot = complex(*random.uniform(-1.2, 1.2, 2))
    made, names = (pin.real, pin.imag), ["crank", "coupler", "rocker", "second_coupler", "output"]
    if kind == 1:
        loops.append(({2: pin, 3: link, 4: -output}, pivot - ground))
        there = watt_six_bar(first, made, link, output, (pivot.real, pivot.imag))
    else:
        loops.append(({0: crank, 1: pin, 3: link, 4: -output}, pivot))
        there = stephenson_six_bar(first, made, link, output, (pivot.real, pivot.imag))
    return there, Loops(loops, names), (kind, pin, link, output, pivot)


def _positions(mechanism, second, degrees):
    (dyad, *_), crank = mechanism.dyads, mechanism.crank.radius
    ground = complex(*mechanism.ground["rocker_pivot"])
    pin = crank * np.exp(1j * np.radians(degrees))
    for joint in _crossings(pin, dyad.length_a, ground, dyad.length_b):
        angles = [np.radians(degrees), np.angle(joint - pin), np.angle(joint - ground)]
        if second is None:
            yield np.array(angles)
            continue
        kind, place, link, output, pivot = second
        start = ground + place * np.exp(1j * angles[2]) if kind == 1 else pin + place * np.exp(1j * angles[1])
        for end in _crossings(start, link, pivot, output):
            yield np.array([*angles, np.angle(end - start), np.angle(end - pivot)])


def _apart(path, angles):
    """How far angles are from a path, in the plane through the nearest of its positions."""
    gaps = np.angle(np.exp(1j * (path - angles)))
    return float(np.linalg.norm(gaps, axis=1).min())


@pytest.mark.parametrize(
    "number", [pytest.param(one, marks=[pytest.mark.slow] if one % 8 else []) for one in range(40)]
)
def test_circuits_and_limits_are_those_of_another_continuation(number):
    random = np.random.default_rng(number)
    mechanism, loops, second = _random(random)
    paths = []
    for degrees in np.arange(0.35, 360, 0.8):
        for angles in _positions(mechanism, second, degrees):
            if all(_apart(path, angles) > 0.75 * STEP for path in paths):
                paths.append(loops.follow(angles))
    circuits = all_circuits(mechanism)
    assert len(circuits) == len(paths), (number, len(circuits), len(paths))
    for circuit in circuits:
        q, _ = circuit.curve.at(np.array([0.0]))
        index = circuit.curve.system.equations.index
        start = np.array([q[0, index[name] + 2] for name in loops.names])
        path = min(paths, key=lambda one: _apart(one, start))
        assert circuit.curve.is_closed
        for k, name in enumerate(loops.names):
            turns = round((path[-1, k] - path[0, k]) / math.tau)
            assert abs(circuit.turns(name)) == abs(turns)
            mine = circuit.values(link_angle(name), circuit.turning_points(link_angle(name)))
            its = np.array([one[k] for one in loops.turned_back(path, k)])
            assert len(mine) == len(its), (number, name, len(mine), len(its))
            if turns == 0 and len(its):
                mine, its = mine - mine.min(), its - its.min()
            assert np.sort(mine % math.tau if turns else mine) == pytest.approx(
                np.sort(its % math.tau if turns else its), abs=1e-8
            ), number
        dead = loops.turned_back(path, 0)
        branches = circuit.branches(driver_coordinate(mechanism))
        assert len(branches) == max(1, len(dead))
