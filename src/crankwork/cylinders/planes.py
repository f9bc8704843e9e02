"""Masses on a shaft in given planes: what they leave unbalanced, and the masses that balance them.

A mass is a vector, its mass moment, in its direction; masses balance where the vectors, and their moments along the
shaft, add up to nothing. What is not known of some follows from that: four equations, or two for masses in one plane.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.cylinders.counterweights import counterweight_moment
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage

# of Newton's method: starts of an angle and of a place as a share of the length, how many in all, steps; what is
# settled, what is the same, and what is not determined
_TURNS, _PLACES, _STARTS, _STEPS = np.arange(6) * math.tau / 6 + 0.3, (-0.5, 0.5, 1.5), 20_000, 60
_SETTLED, _SAME, _SINGULAR = 1e-11, 1e-7, 1e-8


@formula("plane_moment_x", "khurmi_gupta_2005, ch. 21")
def plane_moment_x(Q_p: Value, theta_p: Value) -> Value:
    """Part of a mass moment along the direction from which angles count."""
    return Q_p * np.cos(theta_p)


@formula("plane_moment_y", "khurmi_gupta_2005, ch. 21")
def plane_moment_y(Q_p: Value, theta_p: Value) -> Value:
    """Part of a mass moment a quarter turn further with the rotation."""
    return Q_p * np.sin(theta_p)


@formula("rotor_unbalance", "khurmi_gupta_2005, ch. 21")
def moment_size(U_x: Value, U_y: Value) -> Value:
    """Magnitude of a mass moment of which both parts are known."""
    return np.sqrt(U_x**2 + U_y**2)


@formula("rotor_couple", "khurmi_gupta_2005, ch. 21")
def couple_size(C_x: Value, C_y: Value) -> Value:
    """Magnitude of a couple of masses of which both parts are known."""
    return np.sqrt(C_x**2 + C_y**2)


@formula("secondary_moment_x", "khurmi_gupta_2005, ch. 22")
def secondary_moment_x(Q_p: Value, theta_p: Value, r_p: Value, l: Value) -> Value:  # noqa: E741
    """Part along the line of stroke of the mass moment that stands for the second order of a piston."""
    return Q_p * r_p / l * np.cos(2 * theta_p)


@formula("secondary_moment_y", "khurmi_gupta_2005, ch. 22")
def secondary_moment_y(Q_p: Value, theta_p: Value, r_p: Value, l: Value) -> Value:  # noqa: E741
    """Part across the line of stroke of the mass moment that stands for the second order of a piston."""
    return Q_p * r_p / l * np.sin(2 * theta_p)


@formula("unbalanced_force_along", "khurmi_gupta_2005, ch. 22")
def force_along_stroke(w: Value, U_x: Value, U_y: Value, cos_phi: Value, sin_phi: Value) -> Value:
    """Unbalanced force along the line of stroke."""
    return w**2 * (U_x * cos_phi - U_y * sin_phi)


@formula("unbalanced_force_across", "khurmi_gupta_2005, ch. 22")
def force_across_stroke(w: Value, U_x: Value, U_y: Value, cos_phi: Value, sin_phi: Value) -> Value:
    """Unbalanced force across the line of stroke."""
    return w**2 * (U_x * sin_phi + U_y * cos_phi)


@formula("unbalanced_couple", "khurmi_gupta_2005, ch. 22")
def couple_along_stroke(w: Value, C_x: Value, C_y: Value, cos_phi: Value, sin_phi: Value) -> Value:
    """Unbalanced couple of the forces along the line of stroke."""
    return w**2 * (C_x * cos_phi - C_y * sin_phi)


@formula("lifting_rotation", "khurmi_gupta_2005, ch. 22")
def lifting_rotation(P_w: Value, Q_u: Value) -> Value:
    """Speed of rotation at which the hammer blow lifts a wheel."""
    return np.sqrt(P_w / Q_u)


@formula("plane_moment", "kolchin_demidov_2008, ch. 8")
def sector_moment(rho_s: Value, b_s: Value, R_o: Value, R_i: Value, z_s: Value, alpha_s: Value) -> Value:
    """Mass moment of counterweights that are sectors of a ring, about the axis of the ring."""
    return 2 * z_s * rho_s * b_s * (R_o**3 - R_i**3) * np.sin(alpha_s / 2) / 3


@formula("sector_angle", "kolchin_demidov_2008, ch. 8")
def sector_angle(Q_p: Value, rho_s: Value, b_s: Value, R_o: Value, R_i: Value, z_s: Value) -> Value:
    """Angle of the sectors of a ring that have a mass moment."""
    return 2 * np.arcsin(3 * Q_p / (2 * z_s * rho_s * b_s * (R_o**3 - R_i**3)))


@dataclass(frozen=True)
class Sector:
    """Counterweights that are sectors of a ring; the angle is None where it is wanted. [kg/m3], [m], [-], [rad]"""

    density: float
    width: float
    outer_radius: float
    inner_radius: float
    count: int = 1
    angle: float | None = None


class PlaneMass(NamedTuple):
    """A mass in a plane of a shaft; what is None is wanted. [kg], [m], [kg m], [rad], [m]"""

    name: str
    mass: float | None = None
    reciprocating: float = 0.0  # What moves along the line of stroke, at the same crank
    radius: float | None = None
    moment: float | None = None
    angle: float | None = None
    position: float | None = None
    sector: Sector | None = None

    def size(self, share: float) -> float | None:
        """Return the mass moment that counts as rotating, None if it is wanted. [kg m]"""
        if self.sector is not None:
            ring = vars(self.sector)
            return None if self.sector.angle is None else float(sector_moment(*ring.values()))
        if self.mass is None or self.radius is None:
            return self.moment
        return float(counterweight_moment(self.mass, share, self.reciprocating, self.radius))


@dataclass(frozen=True)
class Rotor:
    """Masses on a shaft, in one plane where none has a position.

    `share`: of the reciprocating masses that is balanced; `reference`: where couples count from [m]; `bearings`:
    positions of two [m]; `coupled`: axles of a locomotive that share what is balanced, zero without one; `wheel`: its
    diameter, and what stands on a wheel [m], [N].
    """

    masses: tuple[PlaneMass, ...]
    kind: Literal["rotating", "reciprocating"] = "rotating"
    share: float = 0.0
    rod_length: float | None = None
    reference: float | None = None
    bearings: tuple[float, ...] = ()
    coupled: int = 0
    wheel: tuple[float | None, float | None] = (None, None)
    arrangement: int = 1
    has_speed: bool = True

    @property
    def is_flat(self) -> bool:
        """Whether all masses lie in one plane."""
        return all(mass.position is None for mass in self.masses)

    @property
    def wanted(self) -> tuple[tuple[str, int], ...]:
        """What is wanted: `size`, `angle` or `position`, and the number of the mass from zero."""
        share, flat = self.share / max(self.coupled, 1), self.is_flat
        return tuple(
            (word, index)
            for index, mass in enumerate(self.masses)
            for word, value in (("size", mass.size(share)), ("angle", mass.angle), ("position", mass.position))
            if value is None and not (flat and word == "position")
        )

    @property
    def balancing(self) -> tuple[int, ...]:
        """The masses of unknown size and direction, where nothing else is wanted and formulas give them."""
        sized, turned = (tuple(index for kind, index in self.wanted if kind == word) for word in ("size", "angle"))
        count = 1 if self.is_flat else 2
        return sized if sized == turned and len(sized) == count and len(self.wanted) == 2 * count else ()


class Arrangement(NamedTuple):
    """Mass moments [kg m], directions [rad] and positions [m] with which masses balance, shape (..., masses)."""

    sizes: Array
    angles: Array
    places: Array

    def open_ends(self) -> Array:
        """Return what forces and couples leave open, along both directions, shape (..., 4)."""
        vectors = self.sizes * np.exp(1j * self.angles)
        return _parts(vectors.sum(-1), (self.places * vectors).sum(-1))


def _parts(force: NDArray[Any], couple: NDArray[Any]) -> Array:
    return np.stack([force.real, force.imag, couple.real, couple.imag], -1)


def arrangements(rotor: Rotor) -> list[Arrangement]:
    """Return every way in which wanted values balance the masses; what is stated, where nothing is wanted.

    CrankworkError if there is none, or if they may have any value.
    """
    share, wanted, equations = rotor.share / max(rotor.coupled, 1), rotor.wanted, 2 if rotor.is_flat else 4
    sizes, angles, places = (
        np.array([value or 0.0 for value in column])
        for column in zip(*((mass.size(share), mass.angle, mass.position) for mass in rotor.masses), strict=True)
    )
    if not wanted:
        return [Arrangement(sizes, angles, places)]
    if len(wanted) != equations:
        raise CrankworkError(ErrorMessage("rotor_wanted", count=len(wanted), equations=equations))
    unit, start, span = float(sizes.max()) or 1.0, float(places.min()), float(np.ptp(places)) or 1.0
    ways = _closed(Arrangement(sizes / unit, angles, (places - start) / span), wanted, equations)
    if not ways:
        raise CrankworkError(ErrorMessage("rotor_open"))
    turned = [index for word, index in wanted if word == "angle"]
    ways.sort(key=lambda balanced: tuple(np.round(balanced.angles[turned], 6)))
    return [Arrangement(balanced.sizes * unit, balanced.angles, balanced.places * span + start) for balanced in ways]


def _closed(known: Arrangement, wanted: tuple[tuple[str, int], ...], equations: int) -> list[Arrangement]:
    """Return the ways in which masses balance that are not negative, by Newton's method from a grid of starts."""
    grids: dict[str, Iterable[float]] = {"size": (1.0,), "angle": _TURNS, "position": _PLACES}
    starts = np.array(list(itertools.islice(itertools.product(*(grids[word] for word, _ in wanted)), _STARTS)))
    state = Arrangement(*(np.tile(part, (len(starts), 1)) for part in known))
    fields = {"size": state.sizes, "angle": state.angles, "position": state.places}
    for column, (word, index) in enumerate(wanted):
        fields[word][:, index] = starts[:, column]
    for _ in range(_STEPS):
        turned, none = np.exp(1j * state.angles), np.zeros_like(state.sizes)
        vectors = state.sizes * turned
        slopes = {
            "size": _parts(turned, state.places * turned), "angle": _parts(1j * vectors, 1j * state.places * vectors),
            "position": _parts(none + 0j, vectors),
        }  # fmt: skip
        matrix = np.stack([slopes[word][:, index, :equations] for word, index in wanted], -1)
        step = -(np.linalg.pinv(matrix) @ state.open_ends()[:, :equations, None])[..., 0]
        step /= np.maximum(1.0, np.abs(step).max(-1, keepdims=True))
        for column, (word, index) in enumerate(wanted):
            fields[word][:, index] += step[:, column]
    ways = list[Arrangement]()
    for row in np.flatnonzero(np.abs(state.open_ends()[:, :equations]).max(-1) < _SETTLED):
        balanced = Arrangement(*(part[row].copy() for part in state))
        for word, index in wanted:
            if word == "size" and balanced.sizes[index] < 0 and ("angle", index) in wanted:
                balanced.sizes[index], balanced.angles[index] = -balanced.sizes[index], balanced.angles[index] + math.pi
        balanced = balanced._replace(angles=np.mod(balanced.angles, math.tau))
        if balanced.sizes.min() > -_SETTLED and not any(_is_same(balanced, other) for other in ways):
            if np.linalg.svd(matrix[row], compute_uv=False)[-1] < _SINGULAR:
                raise CrankworkError(ErrorMessage("rotor_loose"))
            ways.append(balanced)
    return ways


def _is_same(first: Arrangement, second: Arrangement) -> bool:
    ends = [np.append(each.sizes * np.exp(1j * each.angles), each.places) for each in (first, second)]
    return bool(np.abs(ends[0] - ends[1]).max() < _SAME)
