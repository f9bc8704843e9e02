"""Diagrams of the loads of bearings that figures and sheets draw, each computed once, when asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np

from crankwork.analysis.joint_bearings import FORCES
from crankwork.analysis.results import Results
from crankwork.cylinders.load_statistics import PolarDiagram, polar_diagram
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.cylinders.wear import OilHole, oil_hole
from crankwork.formula.traced_value import ProcedureValue, TracedValue, breakpoints_of
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities.key import key_of

__all__ = [
    "AFTER", "BearingDiagrams", "CrankpinLoad", "JointDiagrams", "PolarDiagram", "WearRing", "load_extremes",
    "wear_rings",
]  # fmt: skip

# Behind a corner of a load, where there may be a jump. [deg]
AFTER = 1e-6


class CrankpinLoad(NamedTuple):
    """Load of the rods on a crankpin."""

    size: Array  # Of the whole load, shape (n,) [N]
    polar: PolarDiagram  # Tangential to the right, radial downward
    inertia: float  # Inertia force of all rod masses at the crankpin, never positive; of rigid rods none apart [N]
    rods: int  # How many turn on it


class WearRing(NamedTuple):
    """Sums of loads on the rays of a journal [N], shape (rays,), and where its oil hole should be."""

    sums: Array
    hole: OilHole


class BearingDiagrams(Protocol):
    """Loads of crankpins and main journals for their diagrams."""

    @property
    def pin_sizes(self) -> tuple[Array, Mapping[str, Array]]:
        """Crank angles over the cycle without its end [deg], and the load on every distinct crankpin. [N]"""
        ...

    def crankpin(self, pin: str) -> CrankpinLoad:
        """Return the load on a crankpin with its polar diagram."""
        ...

    @property
    def journals(self) -> Mapping[str, PolarDiagram]:
        """Polar diagrams of the main journals. [N]"""
        ...


def wear_rings(results: Results, listing: str) -> tuple[Array, dict[str, WearRing]]:
    """Return the angles of the rays of wear diagrams [deg], and the rings by the name of the journal."""
    columns = dict(results.listings[listing].columns)
    angles = np.degrees(columns.pop("wear_ray_angle"))
    return angles, {key_of(key).owner: WearRing(sums, oil_hole(sums)) for key, sums in columns.items()}


def load_extremes(trace: Mapping[str, TracedValue]) -> list[float]:
    """Return the crank angles where the loads of bearings are largest and least. [deg]"""
    return [
        known.node.at
        for key, known in trace.items()
        if key.startswith("bearing_load_m") and isinstance(known.node, ProcedureValue) and known.node.at is not None
    ]


@dataclass(frozen=True)
class JointDiagrams:
    """Diagrams of the bearings of a linkage."""

    results: Results  # Of a linkage with loads of bearings

    def _names(self, listing: str) -> tuple[str, ...]:
        table = self.results.listings.get(listing)
        columns = () if table is None else tuple(table.columns)
        return tuple(key_of(key).owner for key in columns if key.startswith("wear_sum."))

    @property
    def pins(self) -> tuple[str, ...]:
        """The names of the crankpins."""
        return self._names("crankpin_wear")

    @cached_property
    def _loads(self) -> tuple[Array, dict[str, BearingLoad]]:
        """Crank angles with those of corners and extremes [deg], and loads in the frames of their cranks. [N]"""
        results, trace, cycle = self.results, self.results.trace, self.results.machine.cycle
        keys = {name: tuple(f"{kind}.{name}" for kind in FORCES[:2]) for name in self.pins}
        keys |= {name: (f"bearing_force_x.{name}", f"bearing_force_y.{name}") for name in self._names("main_wear")}
        components = [key for pair in keys.values() for key in pair]
        corners = breakpoints_of([trace[key] for key in components], cycle)
        angles = [np.arange(0.0, cycle), corners, corners[:-1] + AFTER, np.mod(load_extremes(trace), cycle)]
        degrees = np.unique(np.concatenate(angles))
        degrees = degrees[degrees < cycle]
        columns = results.columns_at(degrees, components)
        loads = {
            name: BearingLoad(-columns[x] if name in self.pins else columns[x], columns[y])
            for name, (x, y) in keys.items()
        }
        return degrees, loads

    @property
    def pin_sizes(self) -> tuple[Array, Mapping[str, Array]]:
        """Crank angles over the cycle without its end [deg], and the size of the load on every crankpin. [N]"""
        degrees, loads = self._loads
        return degrees, {name: loads[name].resultant for name in self.pins}

    def crankpin(self, pin: str) -> CrankpinLoad:
        """Return the load on a crankpin with its polar diagram."""
        degrees, loads = self._loads
        polar = polar_diagram(loads[pin], degrees, self.results.machine.cycle)
        return CrankpinLoad(loads[pin].resultant, polar, 0.0, 1)

    @property
    def journals(self) -> Mapping[str, PolarDiagram]:
        """Polar diagrams of the pivots of cranks, in the frames of their cranks. [N]"""
        degrees, loads = self._loads
        cycle = self.results.machine.cycle
        return {name: polar_diagram(loads[name], degrees, cycle, 0.0, 90.0) for name in self._names("main_wear")}
