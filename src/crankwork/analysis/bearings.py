"""The bearings of a machine: their loads over the cycle, how these reverse, wear, oil holes, and diagrams of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Listing, Results
from crankwork.cylinders import load_vectors as formulas
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.cylinders.wear import (
    OilHole,
    OilHoleOfPolynomials,
    PolarDiagram,
    oil_hole,
    polar_diagram,
    ray_angles,
    reversal,
    reversal_of_polynomials,
    wear_sums,
)
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import (
    FunctionValue,
    ProcedureValue,
    Sum,
    Tabulated,
    TracedValue,
    breakpoints_of,
    given,
    total,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.quantities.key import key_of

__all__ = ["AFTER", "Bearing", "BearingCycle", "BearingDiagrams", "CrankpinLoad", "PolarDiagram", "WearRing"]

# Behind a corner of a load, where there may be a jump. [deg]
AFTER = 1e-6
# Load of rods on a crankpin: towards the shaft, with the rotation, and its size.
ON_CRANKPIN = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load")
# Components of the load of a bearing in its own frame.
IN_FRAME = ("bearing_force_x", "bearing_force_y")
# between the loads that wear diagrams add up [deg]
_WEAR_STEP = 10.0
_REVERSAL = ("reversal_duration", "reversal_ratio")
_LISTED = (
    "mean_bearing_load", "bearing_load_max", "bearing_load_max_angle", "bearing_load_min", "bearing_load_min_angle",
    "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max", *_REVERSAL,
)  # fmt: skip
_OF_CRANKPIN = {
    "mean_crankpin_load": "mean_bearing_load", "crankpin_load_max": "bearing_load_max",
    "crankpin_load_max_angle": "bearing_load_max_angle",
}  # fmt: skip


class Bearing(NamedTuple):
    """A bearing of a machine."""

    name: str  # `crankpin.1`, `big_end`, or that of a joint
    load: str  # Column of the size of its load
    number: str = ""  # Its name among those of its kind
    owner: str = ""  # Of its values that are shown alone; empty where no other bearing has them
    size: tuple[TracedValue, TracedValue] | None = None  # Diameter and length [m]
    is_crankpin: bool = False
    is_journal: bool = False  # Of a crank in the ground
    reversing: str = ""  # Column of the component that reverses

    @property
    def components(self) -> tuple[str, str]:
        """The columns of the load along and across the arm of its crank, of a crankpin and a journal."""
        along, across = ON_CRANKPIN[:2] if self.is_crankpin else IN_FRAME
        owner = self.number if self.is_crankpin else self.name
        return f"{along}.{owner}", f"{across}.{owner}"


def bearing_size(
    name: str, diameter: float | None, length: float | None, path: str
) -> tuple[TracedValue, TracedValue] | None:
    """Return diameter and length of a bearing, if both are stated. `path`: where, up to `diameter`."""
    if diameter is None or length is None:
        return None
    return (
        given(f"bearing_diameter.{name}", diameter, f"{path}diameter"),
        given(f"bearing_length.{name}", length, f"{path}length"),
    )


def loads_on_crankpin(
    pin: str, rods: Sequence[tuple[TracedValue, TracedValue]], size: TracedValue | None
) -> Iterator[TracedValue]:
    """Yield radial and tangential force of all rods on a crankpin, and the size of the load.

    `rods`: both forces of each; `size`: of the load of a rod that is alone.
    """
    radial, tangential, load = ON_CRANKPIN
    along = total(f"{radial}.{pin}", [rod[0] for rod in rods])
    across = total(f"{tangential}.{pin}", [rod[1] for rod in rods])
    resultant = BearingLoad(-along, across).resultant if size is None else size
    yield from (along, across, resultant.named(f"{load}.{pin}"))


class BearingCycle:
    """What the loads of the bearings of a machine come to over its cycle, computed when it is asked for.

    `components`: columns of the loads of crankpins and journals; `columns_at`: their values at crank angles;
    `cycle`: of the machine [deg]; `rays`: how many diagrams of wear have.
    """

    def __init__(
        self,
        bearings: Iterable[Bearing],
        components: Mapping[str, TracedValue],
        over: CycleInterpolant,
        columns_at: Callable[[CrankGrid], Mapping[str, Array]],
        cycle: float,
        rays: int,
    ) -> None:
        self._bearings, self._components, self._over = tuple(bearings), components, over
        self._columns_at, self._cycle, self._rays = columns_at, cycle, rays
        self._crankpins = [bearing for bearing in self._bearings if bearing.is_crankpin]
        self._journals = [bearing for bearing in self._bearings if bearing.is_journal]

    @cached_property
    def crankpins(self) -> dict[str, TracedValue]:
        """Mean, extremes, pressures, wear and oil hole of each crankpin."""
        values = self._statistics(self._crankpins)
        for bearing in self._crankpins:
            table, key = self._wear(bearing), _owned("oil_hole_angle", bearing.owner)
            values |= {table.key: table, key: _hole(key, table, self._traced(bearing), self._rays)}
        return values

    @cached_property
    def values(self) -> dict[str, TracedValue]:
        """Mean, extremes, pressures and reversal of the load of every bearing, wear of crankpins and main journals."""
        values = self._statistics(self._bearings) | self.crankpins
        for bearing in self._bearings:
            if bearing.reversing:
                extremes = self._over.extremes(bearing.reversing)
                values |= reversal_values(bearing.reversing, self._over, extremes, bearing.owner)
        return values | {table.key: table for table in map(self._wear, self._journals)}

    def summary(self) -> dict[str, TracedValue]:
        """Return mean and largest load of each crankpin, and where its oil hole should be."""
        result = dict[str, TracedValue]()
        for bearing in self._crankpins:
            keys = {
                _owned(key, bearing.owner): f"{statistic}.{bearing.name}" for key, statistic in _OF_CRANKPIN.items()
            }
            result |= {key: self.crankpins[statistic].named(key) for key, statistic in keys.items()}
            hole = _owned("oil_hole_angle", bearing.owner)
            result[hole] = self.crankpins[hole]
        return result

    def listings(self) -> dict[str, Listing]:
        """Return the summary of the loads over the cycle, and the wear of crankpins and main journals."""
        result = {"bearing_loads": _loads_listing(self.values)} if self._bearings else {}
        for listing, bearings in (("crankpin_wear", self._crankpins), ("main_wear", self._journals)):
            tables = {bearing.number: self.values[f"wear_sum.{bearing.name}"] for bearing in bearings}
            if tables:
                result[listing] = _wear_listing(tables, self._rays)
        return result

    def _statistics(self, bearings: Iterable[Bearing]) -> dict[str, TracedValue]:
        extremes, values = self._over.extremes(*(bearing.load for bearing in bearings)), dict[str, TracedValue]()
        for bearing in bearings:
            values |= _load_values(bearing, self._over, extremes)
        return values

    @cached_property
    def _at_steps(self) -> Mapping[str, Array]:
        """The components of loads at the steps of wear diagrams. [N]"""
        return self._columns_at(CrankGrid.from_degrees(np.arange(0.0, self._cycle, _WEAR_STEP)))

    def _traced(self, bearing: Bearing) -> tuple[TracedValue, TracedValue]:
        along, across = (self._components[key] for key in bearing.components)
        return along, across

    def _wear(self, bearing: Bearing) -> TracedValue:
        """Return the sums of loads on the rays of a journal, in its own frame."""
        along, across = (self._at_steps[key] for key in bearing.components)
        sums = wear_sums(BearingLoad(-along if bearing.is_crankpin else along, across), rays=self._rays)
        return TracedValue(Tabulated(OnRays(sums), "wear", operands=self._traced(bearing)), f"wear_sum.{bearing.name}")


def _owned(quantity: str, owner: str) -> str:
    return f"{quantity}.{owner}" if owner else quantity


def _load_values(
    bearing: Bearing, over: CycleInterpolant, extremes: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return mean and extremes of the load of a bearing, their ratio, and its pressures if its size is known."""
    name, column = bearing.name, key_of(bearing.load)
    mean = over.mean(bearing.load, f"mean_bearing_load.{name}")
    values = {mean.key: mean}
    for word in ("max", "max_angle", "min", "min_angle"):
        extreme = extremes[column.derived(f"_{word}")]
        values[f"bearing_load_{word}.{name}"] = extreme.named(f"bearing_load_{word}.{name}")
    largest = values[f"bearing_load_max.{name}"]
    none = TracedValue(ProcedureValue(1.0, "none", (mean,)))
    ratio = formulas.bearing_load_ratio(largest, mean) if mean.value else none
    values[f"bearing_load_ratio.{name}"] = ratio.named(f"bearing_load_ratio.{name}")
    if bearing.size is not None:
        for word, load in (("", mean), ("_max", largest)):
            pressure = formulas.bearing_pressure(load, *bearing.size)
            values[f"bearing_pressure{word}.{name}"] = pressure.named(f"bearing_pressure{word}.{name}")
    return values


def reversal_values(
    key: str, over: CycleInterpolant, extremes: Mapping[str, TracedValue], owner: str
) -> dict[str, TracedValue]:
    """Return duration and ratio of the reversal of a load along one direction.

    `key`: of the column of that load; `owner`: of the keys that are returned.
    """
    peaks = extremes[key_of(key).derived("_max")].value, extremes[key_of(key).derived("_min")].value
    turned, column = reversal(*over.sign_intervals(key), peaks), (over.columns[key],)
    numbers = (math.radians(turned.duration), turned.ratio)
    values = (
        TracedValue(
            FunctionValue(value, "reversal", column, reversal_of_polynomials, part),
            _owned(kind, owner),
        )
        for part, (kind, value) in enumerate(zip(_REVERSAL, numbers, strict=True))
    )
    return {known.key: known for known in values}


@dataclass(frozen=True)
class OnRays:
    """Sums of loads by the direction of a ray. [deg] -> [N]"""

    sums: Array

    def __call__(self, degrees: Array) -> Array:
        """Return the sum on the ray at each direction."""
        return np.asarray(self.sums[np.rint(degrees * self.sums.size / 360).astype(int) % self.sums.size])


def _hole(key: str, table: TracedValue, forces: Iterable[TracedValue], rays: int) -> TracedValue:
    """Return the angle of the oil hole of a crankpin from the sums on its rays.

    `forces`: radial and tangential force of the rods, traced.
    """
    if not (isinstance(table.node, Tabulated) and isinstance(table.node.function, OnRays)):
        raise TypeError(f"{table!r} is not a table of wear")
    angle = math.radians(oil_hole(table.node.function.sums).angle)
    procedure = TracedValue(FunctionValue(angle, "oil_hole", forces, OilHoleOfPolynomials(_WEAR_STEP, rays), 0))
    return TracedValue(ProcedureValue(angle, "oil_hole", (table,), argument=procedure), key)


def _loads_listing(values: Mapping[str, TracedValue]) -> Listing:
    """Return the summary of the loads of all bearings over the cycle, a row for each."""
    names = tuple(key_of(key).owner for key in values if key.startswith("mean_bearing_load."))
    columns = {
        key: np.array([values[f"{key}.{name}"].value if f"{key}.{name}" in values else np.nan for name in names])
        for key in _LISTED
    }
    return Listing({key: values for key, values in columns.items() if not np.all(np.isnan(values))}, names)


def _wear_listing(tables: Mapping[str, TracedValue], rays: int) -> Listing:
    """Return the wear of some journals over the directions of their rays, by the names of the journals."""
    degrees = ray_angles(rays)
    sums = {
        f"wear_sum.{name}": known.node.function(degrees)
        for name, known in tables.items()
        if isinstance(known.node, Tabulated)
    }
    return Listing({"wear_ray_angle": np.radians(degrees), **sums})


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


def wear_rings(results: Results, listing: str) -> tuple[Array, dict[str, WearRing]]:
    """Return the angles of the rays of wear diagrams [deg], and the rings by the name of the journal."""
    columns = dict(results.listings[listing].columns)
    angles = np.degrees(columns.pop("wear_ray_angle"))
    return angles, {key_of(key).owner: WearRing(sums, oil_hole(sums)) for key, sums in columns.items()}


def _load_extremes(trace: Mapping[str, TracedValue]) -> list[float]:
    """Return the crank angles where the loads of bearings are largest and least. [deg]"""
    return [
        known.node.at
        for key, known in trace.items()
        if key.startswith("bearing_load_m") and isinstance(known.node, ProcedureValue) and known.node.at is not None
    ]


@dataclass(frozen=True)
class BearingDiagrams:
    """Diagrams of the loads of bearings that figures and sheets draw, each computed once, when asked for."""

    results: Results  # With loads of bearings

    def _numbers(self, listing: str) -> tuple[str, ...]:
        table = self.results.listings.get(listing)
        columns = () if table is None else tuple(table.columns)
        return tuple(key_of(key).owner for key in columns if key.startswith("wear_sum."))

    @property
    def pins(self) -> tuple[str, ...]:
        """The names of the crankpins."""
        return self._numbers("crankpin_wear")

    @cached_property
    def _components(self) -> dict[str, tuple[str, str]]:
        """The columns of the loads of crankpins, of main journals and of the ends of the rod of cylinder 1."""
        trace, (along, across), (x, y) = self.results.trace, ON_CRANKPIN[:2], IN_FRAME
        keys = {pin: (f"{along}.{pin}", f"{across}.{pin}") for pin in self.pins}
        for number in self._numbers("main_wear"):
            owner = f"main_journal.{number}" if f"{x}.main_journal.{number}" in trace else number
            keys[f"main_journal.{number}"] = f"{x}.{owner}", f"{y}.{owner}"
        return keys | {end: (f"{x}.{end}", f"{y}.{end}") for end in ("big_end", "small_end") if f"{x}.{end}" in trace}

    @cached_property
    def _loads(self) -> tuple[Array, dict[str, BearingLoad]]:
        """Crank angles with those of corners and extremes [deg], and the loads, each in its own frame. [N]"""
        results, trace, cycle = self.results, self.results.trace, self.results.machine.cycle
        components = [key for pair in self._components.values() for key in pair]
        corners = breakpoints_of([trace[key] for key in components], cycle)
        angles = [np.arange(0.0, cycle), corners, corners[:-1] + AFTER, np.mod(_load_extremes(trace), cycle)]
        degrees = np.unique(np.concatenate(angles))
        degrees = degrees[degrees < cycle]
        columns = results.columns_at(degrees, components)
        return degrees, {
            name: BearingLoad(-columns[x] if name in self.pins else columns[x], columns[y])
            for name, (x, y) in self._components.items()
        }

    @property
    def pin_sizes(self) -> tuple[Array, Mapping[str, Array]]:
        """Crank angles over the cycle without its end [deg], and the size of the load on every crankpin. [N]"""
        degrees, loads = self._loads
        return degrees, {pin: loads[pin].resultant for pin in self.pins}

    def crankpin(self, pin: str) -> CrankpinLoad:
        """Return the load of all rods on a crankpin with its polar diagram."""
        degrees, loads = self._loads
        trace = self.results.trace
        radial = trace[self._components[pin][0]].node
        rods = len(radial.operands) if isinstance(radial, Sum) else 1
        # the rods of a linkage are rigid
        inertia = rods * trace["big_end_inertia_force"].value if "big_end_inertia_force" in trace else 0.0
        polar = polar_diagram(loads[pin], degrees, self.results.machine.cycle, inertia)
        return CrankpinLoad(loads[pin].resultant, polar, inertia, rods)

    @property
    def rod_ends(self) -> dict[str, PolarDiagram]:
        """Polar diagrams of `big_end` and `small_end` of the rod of cylinder 1, in the frame of the rod. [N]"""
        degrees, loads = self._loads
        cycle = self.results.machine.cycle
        return {end: polar_diagram(loads[end], degrees, cycle) for end in ("big_end", "small_end") if end in loads}

    @property
    def journals(self) -> Mapping[str, PolarDiagram]:
        """Polar diagrams of the main journals, in the frames of their cranks. [N]"""
        degrees, loads = self._loads
        cycle = self.results.machine.cycle
        return {
            number: polar_diagram(loads[f"main_journal.{number}"], degrees, cycle, 0.0, 90.0)
            for number in self._numbers("main_wear")
        }
