"""The torque of the whole engine: sum, torques along the shaft, harmonics, and how evenly it runs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.crankshaft_bearings import rotating_mass_of
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.analysis.flywheel import turning_inertia
from crankwork.analysis.harmonics import amplitude_of_order, curve_of, order_count, traced_harmonics
from crankwork.analysis.motor_choice import motor_of_crank
from crankwork.analysis.reduction import MOVING, REDUCTION
from crankwork.analysis.speed import Balance, analyse_speed, delivered_or_needed
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.torque import (
    amplitude_of_total,
    curve_harmonics,
    phase_sums,
    torque_harmonics,
    torques_along_shaft,
    total_harmonics,
)
from crankwork.dynamics.piston_forces import crank_torque
from crankwork.dynamics.reduction import dynamic_torque, static_torque_of_balancing
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Samples
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, total
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.preparation import traced_inputs
from crankwork.preparation.prepared import Notice
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import Mean, TrueSpeed, excess_work

_SAMPLES = 1440
# share of the largest torque of a cylinder below which a mean is rounding
_CANCELLED = 1e-13


class EngineTorque(NamedTuple):
    """Torque of cylinder 1 and of all over the cycle, the speed, and their trace."""

    # Torques [N m]
    cylinder: Curve
    total: Curve
    speed: TrueSpeed | None  # With the flywheel, where anything has an inertia
    # Energy and speed over the crank angle; single values; intermediate values
    columns: Mapping[str, TracedValue]
    summary: Mapping[str, TracedValue]
    between: Mapping[str, TracedValue]
    checks: Mapping[str, float]
    notices: tuple[Notice, ...]  # Why there is no flywheel, or no steady speed


def torque_trace(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return the torques of all cylinders, their sums and those along the shaft."""
    tangential = [engine.of(place.number, "tangential_force") for place in engine.layout.places]
    each = [_torque(engine, number, force) for number, force in enumerate(tangential, start=1)]
    along = torques_along_shaft(each, engine.layout)
    values = [*tangential, *each] if len(each) > 1 else []
    if len(along.throws) > 1:
        values += [*along.throws, *along.journals[1:], *along.crankpins]
    values.append(total("total_torque", along.throws))
    if len(each) > 1:
        values.append(total("total_tangential_force", tangential))
    return {item.key: item for item in values}


def _torque(engine: MultiCylinderEngine, number: int, tangential: TracedValue) -> TracedValue:
    """Return the torque of a cylinder from its tangential force at the crank angle of cylinder 1."""
    own, weight = engine.cylinders[number - 1].trace, absent("rotating_torque")
    if "rotating_torque" in own:
        weight = engine.of(number, "rotating_torque")
    torque: TracedValue = crank_torque(tangential, own["crank_radius"], weight)
    return torque.named(engine.of(number, "crank_torque").key)


def engine_reduction(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return the reduced moment of inertia of all cylinders and of rotating parts, with its derivative."""
    if engine.machine.masses is None:
        return {}
    places, r = engine.layout.places, engine.master.trace["crank_radius"]
    numbers = [place.number for place in places]
    parts, parts_1 = (
        [engine.of(number, f"{key}.{item}") for item in MOVING for number in engine.has(f"{key}.{item}")]
        for key in ("reduced_inertia", "reduced_inertia_1")
    )
    for number, place in zip(numbers, places, strict=True):
        mass = rotating_mass_of(engine, place)
        if "knuckle_mass" in engine.cylinders[number - 1].trace:
            mass = mass - engine.cylinders[number - 1].trace["knuckle_mass"]
        parts.append((mass * r * r).named(f"reduced_inertia.rotating.{number}"))
    if engine.machine.drive.inertia:
        parts.append(turning_inertia(engine.machine, "reduced_inertia.drive"))
    values = total("total_reduced_inertia", parts), total("total_reduced_inertia_1", parts_1)
    return dict(zip(REDUCTION, values, strict=True))


def engine_torque(
    engine: MultiCylinderEngine,
    trace: Mapping[str, TracedValue],
    over: CycleInterpolant,
    extremes: Mapping[str, TracedValue],
) -> EngineTorque:
    """Return the torque of the engine with the flywheel it needs, and why there is none."""
    first = engine.of(1, "crank_torque").key
    cylinder, all_ = (curve_of(over, key) for key in (first, "total_torque"))
    w = engine.master.trace["speed"]
    largest = max(map(abs, cylinder.extremes()[::2]))
    balance = _balance(engine, trace, over, all_, largest)
    mean = over.mean("total_torque", "mean_total_torque")
    if engine.machine.angular_acceleration and balance.torque.key == "static_torque":
        # the torque that accelerates the parts is not periodic
        mean = (
            -TracedValue(ProcedureValue(-balance.curve.mean, "mean", (balance.torque,)), "mean_driving_torque")
        ).named(mean.key)
    if abs(mean.value) <= _CANCELLED * largest:
        # without gas, weights and inertia leave a mean of rounding only
        mean = TracedValue(ProcedureValue(0.0, "mean", (trace["total_torque"],)), mean.key)
    mean = delivered_or_needed(mean)
    summary = {"mean_torque": mean}
    summary |= {key: value for key, value in extremes.items() if key.startswith("total_torque_")}
    # textbooks draw the extremes as far above the mean as below it
    kind: Mean = "extremes" if engine.master.method.kinematics == "textbook" else "time"
    summary |= motor_of_crank(engine.machine, mean, w, max(map(abs, all_.extremes()[::2])))
    turn = analyse_speed(engine.machine, balance, w, mean, kind)
    between = dict(turn.between)
    shown = {**turn.summary, **between}
    summary |= {key: shown[key] for key in ("excess_work", "energy_fluctuation") if key in shown} | turn.summary
    named = {key: known if known is mean else known.named(key) for key, known in summary.items()}
    between |= {} if balance.torque.key == "total_torque" else {balance.torque.key: balance.torque}
    return EngineTorque(cylinder, all_, turn.speed, turn.columns, named, between, turn.checks, turn.notices)


def _balance(
    engine: MultiCylinderEngine,
    trace: Mapping[str, TracedValue],
    over: CycleInterpolant,
    total_torque: Curve,
    largest: float,
) -> Balance:
    """Return the torque of gas and weights on the crank, with the reduced inertia of all moving parts.

    By the textbook method: the torque of all cylinders at constant speed, with the inertia of rotating parts only.
    """
    drive, total_ = turning_inertia(engine.machine, "reduced_inertia.drive"), trace["total_torque"]
    if "reduced_inertia" not in trace or not has_own_inertia(engine):
        constant = Curve.constant(drive.value, total_torque.cycle)
        return Balance(total_, total_torque, drive, constant, excess_work(total_torque), sign=1.0)
    w, eps = engine.master.trace["speed"], traced_inputs.acceleration(engine.machine)
    inertia, inertia_1 = trace["reduced_inertia"], trace["reduced_inertia_1"]
    own = inertia if drive.is_absent else (inertia - drive).named("reduced_inertia.cylinders")
    dynamic = dynamic_torque(w, inertia_1, own, eps).named("dynamic_torque")
    static = static_torque_of_balancing((-total_).named("balancing_torque"), dynamic).named("static_torque")
    J, J_1 = (curve_of(over, key) for key in ("reduced_inertia", "reduced_inertia_1"))
    torque = total_torque + J_1 * (w.value**2 / 2)
    if not eps.is_absent:
        torque = torque + (J + -drive.value) * eps.value
    if max(map(abs, torque.extremes()[::2])) <= 10 * _CANCELLED * largest:
        # without gas and weights rounding is all that is left
        torque = torque * 0.0
    return Balance(static, torque, inertia, J, excess_work(torque))


def has_own_inertia(engine: MultiCylinderEngine) -> bool:
    """Return whether rods and pistons count in the speed; by the textbook method they do not."""
    return engine.machine.masses is not None and engine.master.method.kinematics != "textbook"


def harmonics_trace(
    engine: MultiCylinderEngine, torque: EngineTorque, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the harmonics of the torque of one cylinder and of all, each under its order: `harmonic_amplitude.2.5`."""
    layout, first = engine.layout, engine.of(1, "crank_torque")
    count = order_count(layout.cycle)
    harmonics = curve_harmonics(torque.cylinder, count)
    all_ = None if engine.is_uniform else curve_harmonics(torque.total, count)
    values = {known.key: known for known in traced_harmonics(harmonics, first)}
    stars = phase_sums(layout, harmonics.orders.tolist())
    for index, order in enumerate(harmonics.orders.tolist()):
        star = TracedValue(ProcedureValue(abs(stars[index]), "phase_star"), f"phase_sum.{order:g}")
        if all_ is None:
            amplitude = amplitude_of_total(values[f"harmonic_amplitude.{order:g}"], star)
        else:
            total = trace["total_torque"]
            waves = amplitude_of_order(total, order, float(all_.cosine[index]), float(all_.sine[index]))
            amplitude = TracedValue(ProcedureValue(float(all_.amplitude[index]), "fourier", (total,), None, waves))
        amplitude = amplitude.named(f"total_harmonic_amplitude.{order:g}")
        values |= {known.key: known for known in (star, amplitude)}
    return values


def torque_checks(
    engine: MultiCylinderEngine, torque: EngineTorque, samples: Samples, moved: float
) -> dict[str, float]:
    """Return the residuals between sums over cylinders, phase stars and the total.

    `moved`: the most work that the torque of a cylinder could do [J].
    """
    works = [cylinder.space.work for cylinder in engine.cylinders if cylinder.space is not None]
    result = {}
    if len(works) == len(engine.cylinders) and not engine.machine.angular_acceleration:
        work = torque.total.mean * torque.total.cycle
        result["engine_work"] = abs(work - sum(works)) / (len(works) * moved)
    count = _common_samples(engine.layout)
    if engine.is_uniform and len(engine.cylinders) > 1 and count:
        degrees: Array = np.arange(float(count)) * (engine.layout.cycle / count)
        each = engine.each_of("crank_torque", samples(CrankGrid.from_degrees(degrees)))
        count = order_count(engine.layout.cycle)
        harmonics = torque_harmonics(each[0], engine.layout.cycle, count)
        stars = total_harmonics(harmonics, engine.layout)
        direct = torque_harmonics(each.sum(axis=0), engine.layout.cycle, count)
        difference = np.hypot(stars.cosine - direct.cosine, stars.sine - direct.sine)
        result["phase_stars"] = float(np.max(difference)) / (float(np.max(harmonics.amplitude)) or 1.0)
    return result


def _common_samples(layout: Layout) -> int:
    """Return how many samples of a cycle have one at every firing; 0 if no moderate number has.

    Those at whole degrees where they do.
    """
    firing = np.array([place.firing_angle for place in layout.places]) / layout.cycle
    for count in range(round(layout.cycle), 2 * _SAMPLES):
        if np.max(np.abs(firing * count - np.rint(firing * count))) < 1e-9 * count:
            return count
    return 0
