"""Values that are only rounding: tables print zero where exact arithmetic would give zero."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities.key import key_of

# of the size that a quantity has in a machine, the part that is rounding
_ROUNDING = 1e-12
_PLACES = ("point_x", "point_y", "slider_displacement", "driver_displacement")
_SPEEDS = ("link_angular_velocity", "driver_speed")
_ACCELERATIONS = ("link_angular_acceleration", "driver_angular_acceleration")
_FORCES = (
    "joint_force_x", "joint_force_y", "joint_force", "axial_force", "normal_force", "tooth_force", "separating_force",
    "driver_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "main_journal_load",
    "free_force",
)  # fmt: skip
# torques, sized also by forces times distances
_TORQUES = (
    "static_torque", "balancing_torque", "driving_torque", "driver_torque", "normal_moment", "kinetic_energy_change",
    "total_torque", "excess_work", "shaking_moment_amplitude",
)  # fmt: skip
# single values that are no extremes of a column, and may be what is left of terms that cancel
_LEFT = ("free_force", "excess_work", "shaking_moment_amplitude")
# quantities that are sized together
_SIZED_TOGETHER = (
    _PLACES,
    ("point_velocity_x", "point_velocity_y", "point_velocity", "slider_velocity", "driver_velocity"),
    ("point_acceleration_x", "point_acceleration_y", "point_acceleration", "slider_acceleration",
     "coriolis_acceleration", "driver_acceleration"),
    ("reduced_inertia", "reduced_inertia_1"),
    ("dynamic_torque", "kinetic_energy"),
    _FORCES,
    ("shaking_force_x", "shaking_force_y", "shaking_force"),
    ("velocity_ratio",),
)  # fmt: skip


def without_rounding(columns: Mapping[str, Array], speed: float) -> dict[str, Array]:
    """Return columns, zero where they are negligible against the size of their quantity. `speed`: of the crank."""
    sizes = _sizes(columns, speed)
    return {
        key: np.where(np.isfinite(value), 0.0, value) if _is_rounding(key, _largest(value), sizes) else value
        for key, value in columns.items()
    }


def summary_without_rounding(results: Results) -> dict[str, float]:
    """Return the single values; what is negligible against its column or the size of its quantity is zero."""
    limits = rounding_of_values(results)
    return {key: 0.0 if abs(value) <= limits.get(key, 0.0) else value for key, value in results.summary.items()}


def rounding_of_values(results: Results) -> dict[str, float]:
    """Return the size of rounding of single values by key: extremes of columns, and what is left of sums."""
    summary, sizes = results.summary, _sizes(results.columns, results.machine.speed)
    values = {key: _ROUNDING * sizes[kind] for key in summary if (kind := key_of(key).quantity) in _LEFT}
    for column in results.columns:
        ends = [key for end in ("_max", "_min") if (key := key_of(column).derived(end)) in summary]
        size = max([sizes.get(key_of(column).quantity, 0.0), *(abs(summary[key]) for key in ends)])
        values |= dict.fromkeys(ends, _ROUNDING * size)
    return values


def _sizes(columns: Mapping[str, Array], speed: float) -> dict[str, float]:
    """Return the size of each kind of quantity; that of angles is one radian."""
    largest: dict[str, float] = {}
    for key, value in columns.items():
        kind = key_of(key).quantity
        largest[kind] = max(largest.get(kind, 0.0), _largest(value))

    def most(kinds: tuple[str, ...]) -> float:
        return max(largest.get(kind, 0.0) for kind in kinds)

    sizes = {kind: most(group) for group in _SIZED_TOGETHER for kind in group}
    fastest = max(speed, most(_SPEEDS))
    sizes |= dict.fromkeys(("link_angle", "driver_angle", "rotation_ratio"), 1.0)
    sizes |= dict.fromkeys(_SPEEDS, fastest)
    sizes |= dict.fromkeys(_ACCELERATIONS, max(fastest**2, most(_ACCELERATIONS)))
    return sizes | dict.fromkeys(_TORQUES, max(most(_TORQUES), sizes["kinetic_energy"], most(_FORCES) * most(_PLACES)))


def _largest(column: Array) -> float:
    return float(np.max(np.abs(column[np.isfinite(column)]), initial=0.0))


def _is_rounding(key: str, largest: float, sizes: Mapping[str, float]) -> bool:
    return 0.0 < largest <= _ROUNDING * sizes.get(key_of(key).quantity, 0.0)
