"""What a reader sees in a figure: its largest values, where they are reached, and what makes them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from crankwork.note.document import Citation, Paragraph, Run
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import own_name
from crankwork.report.display import display_key, key_unit, link_label, row_name

if TYPE_CHECKING:
    from crankwork.note.material import Material

# kind of figure: the single values that its sentence tells, of which each must be known
_VALUES: Mapping[str, tuple[str, ...]] = {
    "kinematics": ("piston_velocity_max", "piston_acceleration_max"),
    "brix": ("stroke",),
    "tolle": ("piston_acceleration_max", "piston_acceleration_min", "piston_velocity_max"),
    "pressure": ("gas_pressure_max",),
    "indicator": ("indicated_work", "indicated_mean_pressure"),
    "stage_indicator": ("stage_power", "single_stage_power"),
    "rod_loads": ("piston_rod_load_max", "piston_rod_load_min"),
    "pump_flow": ("vessel_flow_max", "vessel_flow_min", "flow_pulsation"),
    "excess_work": ("excess_work",),
    "turning_moment": ("mean_torque", "excess_work"),
    "speed": ("crank_speed_max", "crank_speed_min"),
    "piston_forces": ("piston_force_max", "piston_force_min"),
    "crankpin_forces": ("tangential_force_max", "tangential_force_min"),
    "total_torque": ("total_torque_max", "total_torque_min"),
    "wittenbauer": ("crank_speed_max", "crank_speed_min"),
    "crankpin_polar": ("crankpin_load_max", "mean_crankpin_load"),
    "torques": ("driving_torque_max", "driving_torque_min"),
    "reduced_inertia": ("reduced_inertia_max", "reduced_inertia_min"),
    "shaft_output": ("effective_power", "effective_torque", "rotational_speed", "effective_fuel_consumption"),
    "diagram_output": ("indicated_power", "mean_torque"),
    "range_of_piston_forces": ("piston_force_max", "piston_force_min"),
    "crankpin_bearing": ("crankpin_load_max", "mean_crankpin_load"),
    "evenness": ("flywheel_inertia", "speed_fluctuation"),
    "stages": ("motor_power", "stage_saving", "heat_removed"),
    "test": ("indicated_power", "effective_power", "mechanical_loss_power", "mechanical_efficiency"),
    "clutch": ("clutch_torque", "clutch_force"),
    "engagement": ("engaged_speed", "slip_heat"),
}
# residuals and differences below this share are those of the computer's arithmetic
ROUNDING = 1e-9
# vectors of plans that are long enough to be read well [mm]
LEGIBLE = 10.0
# mean of a torque over its largest value that sampling leaves of none
_NO_MEAN = 1e-3
# where usual values of the working cycle stand
_USUAL = "kolchin_demidov_2008, ch. 3"
# the sum of a force along the axis of a cylinder
_PARTS = ("gas_force", "inertia_force")


def reading(kind: str, material: Material, pin: str = "1") -> Paragraph | None:
    """Return the sentence that reads a figure of some kind, of one of several crankpins; None where it has none."""
    known, mean = _known(kind, material, pin), material.summary.get("mean_torque", 0.0)
    # what a driver must give is against the torque that is drawn
    mean = -mean if _is_driven(material) else mean
    if kind in _OF_MACHINES:
        return _OF_MACHINES[kind](material)
    parts_known = kind != "piston_forces" or {*_PARTS} <= material.columns.keys()
    if not known or not parts_known or (kind == "total_torque" and not mean):
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
        values["mean"] = words.amount(mean, "N*m", digits=4)
        values["ratio"] = words.number(max(abs(value) for value, _ in known.values()) / abs(mean), digits=2)
    if kind == "brix":
        moved = material.results.columns_at(np.array([90.0]), ("piston_displacement",))["piston_displacement"][0]
        values |= {"angle": words.angle(0.5 * math.pi), "value": words.amount(moved, key_unit("stroke"), digits=4),
                   "share": words.number(100.0 * moved / known["stroke"][0], digits=4)}  # fmt: skip
    if kind == "excess_work" and "excess_work.mertsalov" in material.summary:
        values[kind] = words.amount(material.summary["excess_work.mertsalov"], "J", digits=4)
    return words.paragraph(f"reads_{kind}", **values)


def _known(kind: str, material: Material, pin: str) -> dict[str, tuple[float, float | None]]:
    """Return the values that a sentence tells, with the angles where they are reached; none unless all are known."""
    summary, listed = material.summary, dict[str, tuple[float, float | None]]()
    for key in _VALUES.get(kind, ()):
        own = key if key in summary else f"{key}.{pin}"
        place = key_of(own).derived("_angle")
        if own not in summary or (key.endswith(("_max", "_min")) and place not in summary):
            return {}
        listed[key] = (summary[own], summary.get(place))
    return listed


def _of_largest(kind: str, sentence: str, material: Material) -> Paragraph | None:
    """Return the sentence on the joint, or the chamber, with the largest value of a kind."""
    words, summary = material.words, material.summary
    reached = {key: key_of(key).derived("_angle") for key in summary if key_of(key).quantity == f"{kind}_max"}
    key = max(reached, key=summary.__getitem__, default="")
    if reached.get(key) not in summary:
        return None
    name, angle = own_name(kind, key_of(key).owner), words.angle(summary[reached[key]])
    return words.paragraph(sentence, name=name, value=words.amount(summary[key], key_unit(key), digits=4), angle=angle)


def _of_rotor(material: Material) -> Paragraph | None:
    """Return the sentence on what pistons leave unbalanced: forces along and across their line, and the couple."""
    words, summary, values = material.words, material.summary, dict[str, str]()
    for name, keys in _SWINGING.items():
        key = next((key for key in keys if key in summary), "")
        if key:
            values[name] = words.amount(summary[key], key_unit(key), digits=4)
    if not {"along", "across"} <= values.keys():
        return words.paragraph("reads_left", **values) if {"force", "moment"} <= values.keys() else None
    sentence = words.sentence("reads_unbalanced", **values)
    return Paragraph((*sentence, " ", *words.sentence("reads_couple", **values)) if "couple" in values else sentence)


def _of_hammer(material: Material) -> Paragraph | None:
    """Return the sentence on the largest hammer blow, and the speed at which it lifts a wheel."""
    words, summary, values = material.words, material.summary, dict[str, str]()
    for kind, choose in (("hammer_blow", max), ("lifting_speed", min)):
        known = [value for key, value in summary.items() if key_of(key).quantity == kind]
        if known:
            values[kind] = words.amount(choose(known), key_unit(kind), digits=4)
    return words.paragraph("reads_hammer", **values) if len(values) > 1 else None


# amplitudes of what swings at the speed of a shaft
_SWINGING = {
    "along": ("tractive_effort_variation", "free_force.along"), "across": ("free_force.across",),
    "couple": ("swaying_couple", "free_moment.along"), "force": ("free_force.1",), "moment": ("free_moment.1",),
}  # fmt: skip


def concluded(material: Material) -> Iterator[Paragraph]:
    """Yield what the results of an engine mean, in a few sentences."""
    words, summary, results = material.words, material.summary, material.results
    output = "shaft_output" if "effective_power" in summary else "diagram_output"
    sentences = [
        _of_power(material) if _is_driven(material) and "shaft_power" in summary else reading(output, material),
        *(reading(kind, material) for kind in ("range_of_piston_forces", "total_torque", "crankpin_bearing")),
    ]
    if "residual_temperature_deviation" in summary:
        odd = [notice for notice in results.notices if {"low", "high"} <= notice.values.keys()]
        sentences.insert(1, words.paragraph("reads_cycle_odd" if odd else "reads_cycle", source=Citation(_USUAL)))
    if "bearing_loads" in results.listings and material.has_engine:
        sentences.append(reading("main_journal_polar", material))
    sentences.append(reading("evenness", material))
    if "balance" in results.listings:
        sentences.append(_of_orders(material))
    yield from (paragraph for paragraph in sentences if paragraph is not None)
    yield from _of_torsion(material).values()


def _of_orders(material: Material) -> Paragraph:
    """Return the sentences on the largest free force, and on the largest free moment where there is one."""
    words, runs = material.words, list[Run]()
    for kind in ("free_force", "free_moment"):
        free = {key_of(key).owner.rpartition(".")[2]: value for key, value in material.summary.items()
                if key_of(key).quantity == kind}  # fmt: skip
        order = max(free, key=free.__getitem__, default="")
        if order:
            shown = words.amount(free[order], key_unit(kind), digits=4)
            runs += [" ", *words.sentence(f"reads_{kind}", order=order, value=shown)]
        elif not runs:
            runs += [" ", *words.sentence("reads_balanced")]
    return Paragraph(tuple(runs[1:]))


def _of_torsion(material: Material) -> dict[str, Paragraph]:
    """Return what figures of torsional vibration mean: lowest frequency, strongest resonance, largest stress."""
    words, summary, critical = material.words, material.summary, material.results.listings.get("critical_speeds")
    read = dict[str, Paragraph]()
    lowest = "natural_frequency.1"
    if lowest in summary:
        shown = words.amount(summary[lowest], key_unit(lowest), digits=4)
        read["torsional_modes"] = words.paragraph("reads_torsion", natural_frequency=shown)
    if critical is not None and critical.columns["critical_speed"].size:
        row = int(np.argmax(np.abs(critical.columns["excitation_torque"])))
        mode, order, speed = (
            float(critical.columns[key][row]) for key in ("mode_number", "harmonic_order", "critical_speed")
        )
        read["campbell"] = words.paragraph(
            "reads_critical", order=words.number(order), mode=words.number(mode),
            critical_speed=words.amount(speed, "rpm", digits=4),
        )  # fmt: skip
    stresses = [key for key in summary if key_of(key).quantity == "vibration_stress"]
    if stresses:
        largest = max(stresses, key=summary.__getitem__)
        name = link_label(key_of(largest).owner, words.language)
        shown = words.amount(summary[largest], key_unit(largest), digits=4)
        read["torsional_response"] = words.paragraph("reads_vibration", value=shown, name=name)
    return read


def concluded_of_linkage(material: Material) -> Iterator[Paragraph]:
    """Yield what the results of a linkage mean, in a few sentences."""
    words, summary, checks = material.words, material.summary, material.results.checks
    sentences = (_of_output(material), reading("joint_forces", material), reading("torques", material),
                 *(reading(kind, material) for kind in ("stages", "test", "clutch", "engagement")),
                 *_of_torsion(material).values())  # fmt: skip
    yield from (sentence for sentence in sentences if sentence is not None)
    masses = {key_of(key).owner: value for key, value in summary.items() if key_of(key).quantity == "plane_mass"}
    balanced = [
        f"{link_label(name, words.language)} – {words.amount(mass, 'kg', digits=4)}, "
        f"{words.amount(summary[f'plane_angle.{name}'], 'deg', digits=4)}"
        for name, mass in masses.items()
        if f"plane_angle.{name}" in summary
    ]
    if balanced:
        yield words.paragraph("reads_planes", values="; ".join(balanced))
    yield from filter(None, (reading(kind, material) for kind in ("unbalanced", "hammer_blow")))
    if "mean_torque" in summary and "shaft_power" in summary and summary["shaft_power"] > 0:
        yield _of_power(material)
    elif "dynamic_torque_max" in summary and "static_torque_max" not in summary and not words.is_partial:
        torque = material.columns.get("driving_torque", np.zeros(2))[:-1]
        # losses take power also where no load does
        if abs(np.mean(torque)) <= _NO_MEAN * np.max(np.abs(torque)):
            yield words.paragraph("reads_idle")
    wheel = next((key for key in ("flywheel_inertia", "flywheel_inertia.exact") if summary.get(key, 0.0) > 0), "")
    wanted = material.machine.drive.fluctuation or summary.get("speed_fluctuation")
    if wheel and wanted:
        shown = words.amount(summary[wheel], key_unit(wheel), digits=4)
        yield words.paragraph("reads_evenness", flywheel_inertia=shown, speed_fluctuation=words.number(wanted))
    if agree(checks) and "whole_system" in checks:
        agreement = words.sentence("reads_agreement")
        if material.plan_difference is not None:
            share = words.number(100.0 * material.plan_difference, digits=2)
            agreement += (" ", *words.sentence("reads_plans", share=share, length=words.number(LEGIBLE)))
        yield Paragraph(agreement)


def _of_power(material: Material) -> Paragraph:
    """Return the sentence on the mean torque and power that a machine takes, and on the size of its motor."""
    words, summary = material.words, material.summary
    known = [key for key in ("mean_torque", "shaft_power", "standard_motor_power") if key in summary]
    amounts = {key: words.amount(summary[key], key_unit(key), digits=4) for key in known}
    return words.paragraph("reads_motor" if "standard_motor_power" in known else "reads_power", **amounts)


def _is_driven(material: Material) -> bool:
    """Return whether the mean torque is what the driver of a machine must give."""
    return display_key("mean_torque", material.results) == "mean_driving_torque"


def agree(checks: Mapping[str, float]) -> bool:
    """Return whether there are checks, and nothing is left but rounding."""
    return bool(checks) and max(checks.values()) < ROUNDING


def _of_output(material: Material) -> Paragraph | None:
    """Return the sentence on the slider that travels farthest, or on the link that turns fastest without one."""
    words, summary = material.words, material.summary
    for kind, travel in (("slider", "slider_stroke"), ("link_angular", "link_swing")):
        reached = {key_of(key).owner for key in summary if key_of(key).quantity == f"{kind}_velocity_max"}
        ways = {key_of(key).owner: value for key, value in summary.items() if key_of(key).quantity == travel}
        if not reached & ways.keys():
            continue
        name = max(reached & ways.keys(), key=ways.__getitem__)
        values = {"name": words.part(name), "stroke": words.amount(ways[name], key_unit(travel), digits=4)}
        for noun in ("velocity", "acceleration"):
            ends = [f"{kind}_{noun}_{end}" for end in ("max", "min")]
            end = max(ends, key=lambda key: abs(summary[f"{key}.{name}"]))
            values[noun] = words.amount(abs(summary[f"{end}.{name}"]), key_unit(end), digits=4)
            over, unit = ("time", "s") if words.period else ("angle", "deg")
            values[f"{noun}_angle"] = words.amount(summary[f"{end}_{over}.{name}"], unit, digits=4)
        return words.paragraph("reads_slider" if kind == "slider" else "reads_rocker", **values)
    return None


def _of_bearing(kind: str, sentence: str, material: Material) -> Paragraph | None:
    """Return the sentence on the bearing of a kind with the largest load."""
    words, listing = material.words, material.results.listings["bearing_loads"]
    rows = [row for row, name in enumerate(listing.names) if name.startswith(kind)]
    if not rows:
        return None
    area, columns, values = material.area("bearing_load_max"), listing.columns, dict[str, str]()
    load = columns["bearing_load_max"]
    row, *equal = (index for index in rows if load[index] >= max(load[rows]) * (1 - ROUNDING))
    numbers = "".join(f", {listing.names[index].rpartition('.')[2]}" for index in equal)
    for end in ("max", "min"):
        value = float(columns[f"bearing_load_{end}"][row]) / (area or 1.0)
        values[end] = words.amount(value, key_unit("bearing_load_max", per_area=bool(area)), digits=4)
        values[f"{end}_angle"] = words.angle(float(columns[f"bearing_load_{end}_angle"][row]))
    return words.paragraph(sentence, name=f"{row_name(listing.names[row], words.language)}{numbers}", **values)


def _of_wear(material: Material) -> Paragraph | None:
    """Return the sentence on the ray of a crankpin that is worn most."""
    words, columns = material.words, material.results.listings["crankpin_wear"].columns
    sums = {key: values for key, values in columns.items() if key.startswith("wear_sum") and np.ptp(values) > 0}
    if not sums:
        return None
    key = max(sums, key=lambda pin: float(np.max(sums[pin])))
    ray, name = float(columns["wear_ray_angle"][np.argmax(sums[key])]), key.replace("wear_sum", "crankpin")
    return words.paragraph("reads_wear", name=row_name(name, words.language), angle=words.angle(ray))


_OF_MACHINES: Mapping[str, Callable[[Material], Paragraph | None]] = {
    "joint_forces": partial(_of_largest, "joint_force", "reads_joint_forces"),
    "chambers": partial(_of_largest, "gas_pressure", "reads_chambers"), "sliders": _of_output, "unbalanced": _of_rotor,
    "hammer_blow": _of_hammer, "crankpin_wear": _of_wear, "balance_orders": _of_orders,
    "crankpin_load": partial(_of_bearing, "crankpin", "reads_load"),
    "big_end_polar": partial(_of_bearing, "big_end", "reads_load"),
    "main_journal_polar": partial(_of_bearing, "main_journal", "reads_mains"),
    "torsional_modes": lambda material: _of_torsion(material).get("torsional_modes"),
    "torsional_response": lambda material: _of_torsion(material).get("torsional_response"),
    "campbell": lambda material: _of_torsion(material).get("campbell"),
}  # fmt: skip
