"""What a reader sees in a figure: its largest values, where they are reached, and what makes them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from crankwork.note.document import Citation
from crankwork.quantities.key import key_of
from crankwork.report.display import key_unit, row_name

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
    "shaft_output": ("effective_power", "effective_torque", "rotational_speed", "effective_fuel_consumption"),
    "diagram_output": ("indicated_power", "mean_torque"),
    "range_of_piston_forces": ("piston_force_max", "piston_force_min"),
    "crankpin_bearing": ("crankpin_load_max", "mean_crankpin_load"),
    "evenness": ("flywheel_inertia", "speed_fluctuation"),
}
# where usual values of the working cycle stand
_USUAL = "kolchin_demidov_2008, ch. 3"
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
        area = material.area(key)
        values[key] = words.amount(value / (area or 1.0), key_unit(key, per_area=area is not None), digits=4)
        if angle is not None:
            values[f"{key}_angle"] = words.angle(angle)
    if kind == "piston_forces":
        area = material.area("gas_force") or 1.0
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
        angle=words.angle(angle),
    )


def concluded(material: Material) -> Iterator[Paragraph]:
    """Yield what the results of an engine mean, in a few sentences."""
    words, summary, results = material.words, material.summary, material.results
    output = "shaft_output" if "effective_power" in summary else "diagram_output"
    sentences = [
        reading(kind, material) for kind in (output, "range_of_piston_forces", "total_torque", "crankpin_bearing")
    ]
    if "residual_temperature_deviation" in summary:
        odd = [notice for notice in results.notices if {"low", "high"} <= notice.values.keys()]
        sentences.insert(1, words.paragraph("reads_cycle_odd" if odd else "reads_cycle", source=Citation(_USUAL)))
    if "bearing_loads" in results.listings and material.has_engine:
        sentences.append(_of_mains(material))
    sentences.append(reading("evenness", material))
    if "balance" in results.listings:
        free = {key_of(key).owner.rpartition(".")[2]: value for key, value in summary.items()
                if key_of(key).quantity == "free_force"}  # fmt: skip
        order = max(free, key=free.__getitem__, default="")
        values = {"order": order, "value": words.amount(free[order], key_unit("free_force"), digits=4)} if order else {}
        sentences.append(words.paragraph("reads_free" if order else "reads_balanced", **values))
    yield from (paragraph for paragraph in sentences if paragraph is not None)


def _of_mains(material: Material) -> Paragraph | None:
    """Return the sentence on the main journal with the largest load."""
    words, listing = material.words, material.results.listings["bearing_loads"]
    rows = [row for row, name in enumerate(listing.names) if name.startswith("main_journal")]
    if not rows:
        return None
    load, angle = (listing.columns[f"bearing_load_max{place}"] for place in ("", "_angle"))
    row = max(rows, key=lambda index: float(load[index]))
    return words.paragraph(
        "reads_mains",
        name=row_name(listing.names[row], words.language),
        value=words.amount(float(load[row]), key_unit("bearing_load_max"), digits=4),
        angle=words.angle(float(angle[row])),
    )
