"""Crank, rods and pistons by Newton and Euler, in absolute coordinates, from the tables of a linkage.

Nothing here is taken from crankwork. Every body has three coordinates, joints and guides are equations between them,
and forces follow from one linear system at each crank angle; means and extremes are those of polynomials.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray[Any, np.dtype[np.float64]]
Values = dict[str, Any]
_UNITS = {
    "mm": 1e-3, "kg": 1.0, "kg*m2": 1.0, "deg": math.pi / 180, "rpm": math.pi / 30, "rad/s": 1.0, "rad/s2": 1.0,
    "m/s2": 1.0, "cm3": 1e-6,
}  # fmt: skip


def si(text: float | str) -> float:
    """Return a number of a file. [SI]"""
    if not isinstance(text, str):
        return float(text)
    number, _, unit = text.partition(" ")
    return float(number) * _UNITS[unit]


def _pair(texts: Sequence[str]) -> complex:
    return complex(*map(si, texts))


class Panels:
    """Gauss-Legendre between the breaks of a function over a cycle, and the polynomials through its values there."""

    def __init__(self, breaks: Array, order: int = 12, width: float = math.radians(4.0)) -> None:
        parts = [
            np.linspace(*ends, math.ceil((ends[1] - ends[0]) / width) + 1)[:-1] for ends in itertools.pairwise(breaks)
        ]
        self.edges = np.append(np.concatenate(parts), breaks[-1])
        self.half = np.diff(self.edges) / 2
        self.nodes, self.weights = np.polynomial.legendre.leggauss(order)
        self.angles = (self.edges[:-1] + self.half)[:, None] + self.half[:, None] * self.nodes
        degrees = np.arange(order)
        legendre = np.polynomial.legendre.legvander(self.nodes, order - 1)
        self.to_series = (legendre * self.weights[:, None] * (2 * degrees + 1) / 2).T

    def integral(self, values: Array) -> float:
        """Return the integral over the cycle of a function with values at the nodes."""
        return float(np.sum(values * self.weights * self.half[:, None]))

    def mean(self, values: Array) -> float:
        """Return the mean over the cycle."""
        return self.integral(values) / (self.edges[-1] - self.edges[0])

    def running(self, values: Array) -> Array:
        """Return the series of the integral from the start of the cycle, shape (panels, order + 1)."""
        series = np.polynomial.legendre.legint(values @ self.to_series.T, lbnd=-1, axis=1) * self.half[:, None]
        ends = np.cumsum(np.polynomial.legendre.legval(1.0, series.T))
        series[:, 0] += np.append(0.0, ends[:-1])
        return np.asarray(series)

    def at_nodes(self, series: Array) -> Array:
        """Return the values of series at the nodes."""
        return np.asarray(np.polynomial.legendre.legval(self.nodes, series.T))

    def at(self, series: Array, angles: Array) -> Array:
        """Return the values of series at crank angles. [rad]"""
        panel = np.clip(np.searchsorted(self.edges, angles, side="right") - 1, 0, len(self.half) - 1)
        places = (angles - self.edges[panel]) / self.half[panel] - 1
        vander = np.polynomial.legendre.legvander(places, series.shape[1] - 1)
        return np.asarray(np.sum(vander * series[panel], axis=1))

    def range(self, series: Array) -> tuple[float, float]:
        """Return the least and the largest value of series."""
        ends = np.polynomial.legendre.legval(np.array([-1.0, 1.0]), series.T)
        inner = self.at_nodes(series)
        reach = np.sum(np.abs(series[:, 1:]), axis=1)
        least, largest = float(min(ends.min(), inner.min())), float(max(ends.max(), inner.max()))
        for panel in np.flatnonzero((series[:, 0] + reach >= largest) | (series[:, 0] - reach <= least)):
            roots = np.polynomial.legendre.legroots(np.polynomial.legendre.legder(series[panel]))
            roots = roots.real[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1)]
            if roots.size:
                values = np.polynomial.legendre.legval(roots, series[panel])
                least, largest = min(least, values.min()), max(largest, values.max())
        return least, largest


class Joint(NamedTuple):
    """A point of one body at a point of another, or of the ground: number 0."""

    name: str
    body: int
    at: complex
    other: int
    at_other: complex


class Bodies:
    """A crank with rods and pistons, each a body with two coordinates of its centre of mass and an angle.

    What is returned over the crank angle has the shape (n, ...).
    """

    def __init__(self, values: Values) -> None:
        crank, self.values = values["crank"], values
        self.sense = -1.0 if crank.get("direction") == "clockwise" else 1.0
        self.start, self.speed = si(crank["start"]), si(crank["speed"])
        self.acceleration = si(crank["angular_acceleration"])
        self.pivot = _pair(values["fixed_points"][crank["pivot"]])
        pins = {crank["pin"]: complex(si(crank["radius"])), **{n: _pair(p) for n, p in crank.get("points", {}).items()}}
        centre = crank.get("centre", ["0 mm", "0 mm"])
        centre = pins[centre] if isinstance(centre, str) else _pair(centre)
        mass = si(crank.get("mass", 0))
        # mass, moment of inertia about the centre of mass, and this in the frame of the body; a crank states that about
        # its pivot
        self.bodies = [(0.0, 0.0, 0j), (mass, si(crank.get("inertia", 0)) - mass * abs(centre) ** 2, centre)]
        where = {name: (1, place) for name, place in pins.items()}
        self.joints = [Joint(crank["pivot"], 1, 0j, 0, self.pivot)]
        self.links: list[tuple[str, int, tuple[int, complex], complex, int]] = []
        self.sliders: dict[str, tuple[int, complex, complex]] = {}
        rods = values["links"].items()
        # a rod on another rod comes after it
        for name, rod in sorted(rods, key=lambda item: item[1]["joins"][0] not in pins):
            number, (first, last) = len(self.bodies), rod["joins"]
            self.bodies.append(
                (si(rod.get("mass", 0)), si(rod.get("inertia", 0)), _pair(rod.get("centre", ["0 mm"] * 2)))
            )
            where |= {point: (number, _pair(place)) for point, place in rod.get("points", {}).items()}
            slider, stated = next((n, one) for n, one in values["sliders"].items() if one["pin"] == last)
            guide = values["guides"][stated["guide"]]
            piston = len(self.bodies)
            self.bodies.append((si(stated["mass"]), 0.0, 0j))
            self.sliders[slider] = piston, _pair(guide["through"]), np.exp(1j * si(guide["angle"]))
            self.joints.append(Joint(first, number, 0j, *where[first]))
            self.joints.append(Joint(last, piston, 0j, number, complex(si(rod["length"]))))
            self.links.append((name, number, where[first], complex(si(rod["length"])), piston))
        self.names = self._names()
        self.count = 3 * (len(self.bodies) - 1)

    def _names(self) -> list[str]:
        """Return the names of joint forces: where several rods have one pin, that of the rod tells them apart."""
        at_pin = [joint.name for joint in self.joints]
        rods = {number: name for name, number, *_ in self.links}
        return [
            f"{joint.name}_{rods[joint.body]}" if at_pin.count(joint.name) > 1 else joint.name for joint in self.joints
        ]

    def places(self, angles: Array) -> tuple[Array, Array]:
        """Return origins and directions of the bodies at crank angles, both complex, shape (n, bodies)."""
        origins = np.zeros((angles.size, len(self.bodies)), dtype=complex)
        turns = np.ones_like(origins)
        origins[:, 1], turns[:, 1] = self.pivot, np.exp(1j * (self.start + self.sense * angles))
        for _, number, (other, at), length, piston in self.links:
            origins[:, number] = first = origins[:, other] + turns[:, other] * at
            slider = next(one for one in self.sliders.values() if one[0] == piston)
            away = (first - slider[1]) * np.conj(slider[2])
            root = np.sqrt(abs(length) ** 2 - away.imag**2)
            # outwards from the shaft: guides lead towards it
            origins[:, piston] = slider[1] + slider[2] * (away.real - root)
            turns[:, number] = (origins[:, piston] - first) / length
        return origins, turns

    def motion(self, angles: Array) -> tuple[Array, Array, Array]:
        """Return the derivatives of all coordinates, first and second, and the Jacobian of all constraints."""
        _, turns = self.places(angles)
        size, joints = angles.size, self.joints
        jacobian, curved = np.zeros((size, self.count, self.count)), np.zeros((size, self.count))
        arms = []
        for row, joint in enumerate(joints):
            for body, at, sign in ((joint.body, joint.at, 1.0), (joint.other, joint.at_other, -1.0)):
                if body == 0:
                    continue
                arm = turns[:, body] * (at - self.bodies[body][2])
                column = 3 * (body - 1)
                jacobian[:, 2 * row, column] = jacobian[:, 2 * row + 1, column + 1] = sign
                jacobian[:, 2 * row, column + 2], jacobian[:, 2 * row + 1, column + 2] = (
                    -sign * arm.imag,
                    sign * arm.real,
                )
                arms.append((row, body, sign * arm))
        row = 2 * len(joints)
        jacobian[:, row, 2] = 1.0
        for number, (piston, _, along) in enumerate(self.sliders.values()):
            across = 1j * along
            column = 3 * (piston - 1)
            jacobian[:, row + 1 + 2 * number, column : column + 2] = across.real, across.imag
            jacobian[:, row + 2 + 2 * number, column + 2] = 1.0
        driven = np.zeros((size, self.count))
        driven[:, row] = self.sense
        first = np.linalg.solve(jacobian, driven[..., None])[..., 0]
        for at, body, arm in arms:
            turned_arm = arm * first[:, 3 * (body - 1) + 2] ** 2
            curved[:, 2 * at] += turned_arm.real
            curved[:, 2 * at + 1] += turned_arm.imag
        second = np.linalg.solve(jacobian, curved[..., None])[..., 0]
        return first, second, jacobian

    @cached_property
    def masses(self) -> Array:
        """Mass or moment of inertia of each coordinate."""
        return np.array([one for mass, inertia, _ in self.bodies[1:] for one in (mass, mass, inertia)])

    def loads(self, pressures: Mapping[str, Array], size: int) -> Array:
        """Return forces of gas and weights on each coordinate; `pressures` by chamber, above those behind. [Pa]"""
        forces = np.zeros((size, self.count))
        for name, chamber in self.values["chambers"].items() if "chambers" in self.values else ():
            piston, _, along = self.sliders[chamber["slider"]]
            push = pressures[name] * chamber["sense"] * area(chamber)
            forces[:, 3 * (piston - 1)] += push * along.real
            forces[:, 3 * (piston - 1) + 1] += push * along.imag
        if self.values["method"]["weights"]:
            forces[:, 1::3] -= self.masses[1::3] * si(self.values["method"]["gravity"])
        return forces

    def forces(self, angles: Array, loads: Array) -> tuple[dict[str, Array], Array]:
        """Return the constraint forces: those in joints and at guides by key, and the torque of the driver."""
        first, second, jacobian = self.motion(angles)
        accelerated = self.masses * (second * self.speed**2 + first * self.acceleration)
        multipliers = np.linalg.solve(np.swapaxes(jacobian, 1, 2), (loads - accelerated)[..., None])[..., 0]
        found = {}
        for row, name in enumerate(self.names):
            for axis, letter in enumerate("xy"):
                found[f"joint_force_{letter}.{name}"] = -multipliers[:, 2 * row + axis]
        last = 2 * len(self.joints)
        for number, name in enumerate(self.sliders):
            found[f"normal_force.{name}"] = -multipliers[:, last + 1 + 2 * number]
        momentum = accelerated.reshape(angles.size, -1, 3).sum(axis=1)
        found |= {"shaking_force_x": -momentum[:, 0], "shaking_force_y": -momentum[:, 1]}
        return found, -multipliers[:, last] * self.sense


def area(chamber: Mapping[str, Any]) -> float:
    """Return the area that the gas of a chamber acts on. [m2]"""
    rod = si(chamber.get("rod_diameter", 0))
    return math.pi / 4 * (si(chamber["bore"]) ** 2 - rod**2)


class Turning:
    """How the crank of bodies turns over a cycle: torque of gas and weights, moment of inertia, speed.

    `breaks`: where pressures break, with both ends of the cycle [rad]; `pressures`: of each chamber at angles [Pa].
    """

    def __init__(self, bodies: Bodies, breaks: Array, pressures: Callable[[Array], Mapping[str, Array]]) -> None:
        self.bodies, self.panels = bodies, Panels(breaks)
        angles = self.panels.angles.ravel()
        first = bodies.motion(angles)[0]
        loads = bodies.loads(pressures(angles), angles.size)
        self.torque = np.sum(loads * first, axis=1).reshape(self.panels.angles.shape)
        given = si(bodies.values.get("flywheel", {}).get("inertia", 0))
        self.inertia = np.sum(bodies.masses * first**2, axis=1).reshape(self.torque.shape) + given
        self.mean = self.panels.mean(self.torque)
        self.work = self.panels.running(self.torque - self.mean)

    @property
    def excess(self) -> float:
        """Excess work of gas and weights. [J]"""
        least, largest = self.panels.range(self.work)
        return largest - least

    def squares(self, energy: float, wheel: float) -> Array:
        """Return the square of the speed at the nodes, with a flywheel and a kinetic energy at the start."""
        return np.asarray(2 * (energy + self.panels.at_nodes(self.work)) / (self.inertia + wheel))

    def extremes(self, energy: float, wheel: float) -> tuple[float, float]:
        """Return the least and the largest speed."""
        low, high = self.panels.range(self.squares(energy, wheel) @ self.panels.to_series.T)
        return math.sqrt(low), math.sqrt(high)

    def energy_of(self, mean: Callable[[float], float]) -> float:
        """Return the kinetic energy at the start with which a mean of the speed is that of the crank. [J]"""
        least = low = -self.panels.range(self.work)[0]
        guess = max(self.panels.mean(self.inertia) * self.bodies.speed**2 / 2, least + 1e-3 * self.excess)
        high = guess
        while mean(high) < self.bodies.speed:
            high += high - least
        for _ in range(100):
            miss = mean(guess) - self.bodies.speed
            low, high = (guess, high) if miss < 0 else (low, guess)
            step = 1e-6 * (guess - least)
            newton = guess - miss * step / (mean(guess + step) - self.bodies.speed - miss)
            following = newton if low < newton < high else (low + high) / 2
            if abs(following - guess) <= 1e-15 * guess:
                break
            guess = following
        return guess

    def fluctuation(self, wheel: float) -> float:
        """Return the fluctuation where the mean of the extremes is the speed of the crank."""
        energy = self.energy_of(lambda energy: sum(self.extremes(energy, wheel)) / 2)
        low, high = self.extremes(energy, wheel)
        return (high - low) / self.bodies.speed

    def speed(self, wheel: float, angles: Array) -> Array:
        """Return the speed at crank angles, its mean over the time that of the crank. [rad] -> [rad/s]"""
        energy = self.energy_of(lambda energy: 1 / self.panels.mean(self.squares(energy, wheel) ** -0.5))
        first = self.bodies.motion(angles)[0]
        given = si(self.bodies.values.get("flywheel", {}).get("inertia", 0))
        inertia = np.sum(self.bodies.masses * first**2, axis=1) + given + wheel
        return np.sqrt(2 * (energy + self.panels.at(self.work, angles)) / inertia)
