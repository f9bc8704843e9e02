"""Summary of the load of a bearing over the cycle: mean, extremes, pressure, reversal, wear and its oil hole."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from crankwork.analysis.results import Listing
from crankwork.cylinders import bearings as formulas
from crankwork.cylinders.load_statistics import reversal, reversal_of_polynomials
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.cylinders.wear import OilHoleOfPolynomials, oil_hole, ray_angles, wear_sums
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import FunctionValue, ProcedureValue, Tabulated, TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities.key import key_of

# between the loads that wear diagrams add up [deg]
WEAR_STEP = 10.0
_REVERSAL = ("reversal_duration", "reversal_ratio")
_LISTED = (
    "mean_bearing_load", "bearing_load_max", "bearing_load_max_angle", "bearing_load_min", "bearing_load_min_angle",
    "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max",
)  # fmt: skip


def load_values(
    name: str,
    key: str,
    over: CycleInterpolant,
    extremes: Mapping[str, TracedValue],
    size: tuple[TracedValue, TracedValue] | None = None,
) -> dict[str, TracedValue]:
    """Return mean and extremes of the load of a bearing, their ratio, and its pressures if its size is known.

    `key`: of the column of the load; `size`: diameter and length [m].
    """
    kind, owner = key_of(key)
    mean = over.mean(key, f"mean_bearing_load.{name}")
    values = {mean.key: mean}
    for word in ("max", "max_angle", "min", "min_angle"):
        extreme = extremes[f"{kind}_{word}" + (f".{owner}" if owner else "")]
        values[f"bearing_load_{word}.{name}"] = extreme.named(f"bearing_load_{word}.{name}")
    largest = values[f"bearing_load_max.{name}"]
    none = TracedValue(ProcedureValue(1.0, "none", (mean,)))
    ratio = formulas.bearing_load_ratio(largest, mean) if mean.value else none
    values[f"bearing_load_ratio.{name}"] = ratio.named(f"bearing_load_ratio.{name}")
    if size is not None:
        for word, load in (("", mean), ("_max", largest)):
            pressure = formulas.bearing_pressure(load, *size)
            values[f"bearing_pressure{word}.{name}"] = pressure.named(f"bearing_pressure{word}.{name}")
    return values


def reversal_values(
    key: str, over: CycleInterpolant, extremes: Mapping[str, TracedValue], owner: str = ""
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
            f"{kind}.{owner}" if owner else kind,
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


def wear_table(key: str, load: BearingLoad, traced: Iterable[TracedValue], rays: int) -> TracedValue:
    """Return the sums of loads on the rays of a journal.

    `load`: on the journal in its own frame every `WEAR_STEP` degrees [N]; `traced`: the same, traced.
    """
    return TracedValue(Tabulated(OnRays(wear_sums(load, rays=rays)), "wear", operands=traced), key)


def hole_of(key: str, table: TracedValue, forces: Iterable[TracedValue], rays: int) -> TracedValue:
    """Return the angle of the oil hole of a crankpin from the sums on its rays.

    `forces`: radial and tangential force of the rods, traced.
    """
    if not (isinstance(table.node, Tabulated) and isinstance(table.node.function, OnRays)):
        raise TypeError(f"{table!r} is not a table of wear")
    angle = math.radians(oil_hole(table.node.function.sums).angle)
    procedure = TracedValue(FunctionValue(angle, "oil_hole", forces, OilHoleOfPolynomials(WEAR_STEP, rays), 0))
    return TracedValue(ProcedureValue(angle, "oil_hole", (table,), argument=procedure), key)


def loads_listing(values: Mapping[str, TracedValue], *, with_reversal: bool = False) -> Listing:
    """Return the summary of the loads of all bearings over the cycle, a row for each."""
    names = tuple(key_of(key).owner for key in values if key.startswith("mean_bearing_load."))
    columns = {
        key: np.array([values[f"{key}.{name}"].value if f"{key}.{name}" in values else np.nan for name in names])
        for key in (*_LISTED, *(_REVERSAL if with_reversal else ()))
    }
    return Listing({key: values for key, values in columns.items() if not np.all(np.isnan(values))}, names)


def wear_listing(tables: Mapping[str, TracedValue], rays: int) -> Listing:
    """Return the wear of some journals over the directions of their rays, by the names of the journals."""
    degrees = ray_angles(rays)
    sums = {
        f"wear_sum.{name}": known.node.function(degrees)
        for name, known in tables.items()
        if isinstance(known.node, Tabulated)
    }
    return Listing({"wear_ray_angle": np.radians(degrees), **sums})
