"""What a reader sees in a figure: its largest values, where they are reached, and what makes them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from crankwork.quantities.key import key_of
from crankwork.report.display import key_unit

if TYPE_CHECKING:
    from crankwork.note.document import Paragraph
    from crankwork.note.material import Material

# kind of figure: the single values that its sentence tells, of which each must be known
_VALUES: Mapping[str, tuple[str, ...]] = {
    "kinematics": ("piston_velocity_max", "piston_acceleration_max"),
    "pressure": ("gas_pressure_max",),
    "piston_forces": ("piston_force_max", "piston_force_min"),
    "crankpin_forces": ("tangential_force_max", "tangential_force_min"),
    "total_torque": ("total_torque_max", "total_torque_min"),
    "crankpin_polar": ("crankpin_load_max", "mean_crankpin_load"),
    "torques": ("driving_torque_max", "driving_torque_min"),
    "reduced_inertia": ("reduced_inertia_max", "reduced_inertia_min"),
}
# the sum of a force along the axis of a cylinder
_PARTS = ("gas_force", "inertia_force")


def reading(kind: str, material: Material, pin: str = "1") -> Paragraph | None:
    """Return the sentence that reads a figure of some kind, of one of several crankpins; None where it has none."""
    known = _known(kind, material, pin)
    if kind == "joint_forces":
        return _of_joints(material)
    if not known or (kind == "piston_forces" and not {*_PARTS} <= material.columns.keys()):
        return None
    words, values = material.words, dict[str, str]()
    for key, (value, angle) in known.items():
        area = material.summary["piston_area"] if material.per_area and kind.endswith("_forces") else 1.0
        values[key] = words.amount(value / area, key_unit(key, per_area=area != 1.0), digits=4)
        if angle is not None:
            values[f"{key}_angle"] = words.amount(angle, "deg", digits=4)
    if kind == "piston_forces":
        for end in ("max", "min"):
            angle = known[f"piston_force_{end}"][1]
            parts = material.results.columns_at(np.array([math.degrees(angle or 0.0)]), _PARTS)
            unit = key_unit("gas_force", per_area=material.per_area)
            values |= {f"{key}_{end}": words.amount(float(parts[key][0]) / area, unit, digits=4) for key in _PARTS}
    if kind == "total_torque":
        mean = material.summary.get("mean_torque", 0.0)
        if not mean:
            return None
        values["mean"] = words.amount(mean, "N*m", digits=4)
        values["ratio"] = words.number(max(abs(value) for value, _ in known.values()) / abs(mean), digits=2)
    return words.paragraph(f"reads_{kind}", **values)


def _known(kind: str, material: Material, pin: str) -> dict[str, tuple[float, float | None]]:
    """Return the values that a sentence tells, with the angles where they are reached; none unless all are known."""
    summary, listed = material.summary, dict[str, tuple[float, float | None]]()
    for key in _VALUES.get(kind, ()):
        own = next((name for name in (key, f"{key}.{pin}") if name in summary), None)
        if own is None:
            return {}
        place = key_of(own).derived("_angle")
        if key.endswith(("_max", "_min")) and place not in summary:
            return {}
        listed[key] = (summary[own], summary.get(place))
    return listed


def _of_joints(material: Material) -> Paragraph | None:
    """Return the sentence on the joint with the largest force."""
    words, summary = material.words, material.summary
    forces = {key: value for key, value in summary.items() if key_of(key).quantity == "joint_force_max"}
    if not forces:
        return None
    key = max(forces, key=forces.__getitem__)
    angle = summary.get(key_of(key).derived("_angle"))
    if angle is None:
        return None
    return words.paragraph(
        "reads_joint_forces",
        name=key_of(key).owner,
        value=words.amount(forces[key], key_unit(key), digits=4),
        angle=words.amount(angle, "deg", digits=4),
    )
