"""From torques over the angle of a shaft to its power, its excess work, its flywheel and its speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.flywheel import extreme_speeds, recovery_torque_values, target_fluctuation, turning_inertia
from crankwork.analysis.motor_choice import mean_power, motor_choice
from crankwork.analysis.results import Listing, Results
from crankwork.analysis.speed import Balance, analyse_speed, excess_of, wheels_of, work_of
from crankwork.errors import MethodError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import (
    AngleFunction,
    ProcedureValue,
    TracedValue,
    absent,
    breakpoints_of,
    given,
    in_order,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.preparation.given_torques import (
    COLUMN_OF,
    NEGLIGIBLE,
    constant_torque,
    curve_of,
    excess_of_torques,
    impulsive_work,
    torque_keys,
    traced_torques,
    work_scale,
    works_at_once,
)
from crankwork.preparation.prepared import Notice, PreparedMachine
from crankwork.quantities.key import key_of
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import ExcessWork, TrueSpeed, acceleration_of_crank, fluctuation_of_inertia
from crankwork.shaft.torque_diagram import ShaftTorques, TorqueDiagram

COLUMNS = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip
_STRETCHES = ("sheared_area", "flat_shearing_force", "shearing_force", "stroke_work", "stroke_angle")
_ROUNDED = 1e-9
# of figures: distance from a jump at which a curve is drawn [deg], and largest number of points
_JUMP_OFFSET = 1e-7
_MOST_DRAWN = 4000


def analyse_turning(machine: Machine, turning: ShaftTorques, grid: CrankGrid | None = None) -> Results:
    """Return the results of a shaft over the period of the torques on it (khurmi_gupta_2005, ch. 16)."""
    w = _speed(machine)
    solved = PreparedMachine(machine, machine.method, w.value)
    grid = grid or CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    is_complete = all(diagram.is_complete for diagram in turning.diagrams.values())
    result = (_of_torque_curves if is_complete else _of_energies)(machine, turning, w)
    columns = {"crank_angle": TracedValue(AngleFunction("angle"), "crank_angle"), **result.columns}
    summary = {key: value.named(key) for key, value in result.summary.items()}
    trace = {**columns, **summary, **result.between}
    return Results(
        solved,
        grid,
        Program(columns)(grid),
        {key: value.value for key, value in summary.items()},
        result.checks,
        result.notices,
        {"turning": COLUMNS},
        result.listings,
        trace=trace,
    )


class _Turned(NamedTuple):
    """Results of a shaft."""

    columns: Mapping[str, TracedValue]
    summary: Mapping[str, TracedValue]
    between: Mapping[str, TracedValue]
    checks: Mapping[str, float]
    notices: tuple[Notice, ...]
    listings: Mapping[str, Listing]


def _speed(machine: Machine) -> TracedValue:
    """Return the mean speed of the shaft: stated, or that of its extremes."""
    if "crank.speed" in machine.stated or not machine.stated:
        return traced_inputs.speed(machine, machine.method)
    path = "crank.largest_speed"
    if path in machine.stated:
        largest = traced_inputs.speed_at(machine, machine.method, path, machine.stated[path].value, ".largest")
        if not machine.drive.inertia and (wanted := target_fluctuation(machine, largest)) is not None:
            return (largest / (1 + wanted / 2)).named("speed")
        mean = machine.speed * machine.method.pi / math.pi
        return TracedValue(ProcedureValue(mean, "of_largest", (largest,)), "speed")
    high, low = extreme_speeds(machine)
    return ((high + low) / 2).named("speed")


def _given_values(machine: Machine, w: TracedValue) -> dict[str, TracedValue]:
    speeds = traced_inputs.speeds(machine, w) if "crank.speed" in machine.stated else {w.key: w}
    return speeds | traced_inputs.efficiency(machine.drive)


def _power(machine: Machine, turning: ShaftTorques, mean: TracedValue, w: TracedValue) -> dict[str, TracedValue]:
    """Return the mean power of the shaft, and the motor that drives a load."""
    return motor_choice(machine, mean, w) if turning.torque is None else mean_power(mean, w)


def _per_cycle(machine: Machine, mean: TracedValue, excess: TracedValue) -> dict[str, TracedValue]:
    """Return the work of a cycle, the excess work and their ratio."""
    of_cycle = work_of(excess, mean, traced_inputs.cycle_angle(machine))
    return {key: of_cycle[key] for key in of_cycle if key == "work_per_cycle"} | {"excess_work": excess} | of_cycle


def _of_torque_curves(machine: Machine, turning: ShaftTorques, w: TracedValue) -> _Turned:
    """Return the results of torques that are given at every angle."""
    over = traced_torques(machine, turning, w)
    traced = over.columns
    means = {key: _mean(over, machine, turning, table, w) for table, key in torque_keys(turning)}
    mean = next(iter(means.values()))
    # a torque that is not given is constant
    drive, load = (traced.get(key, mean).named(key) for key in ("turning_moment", "load_torque"))
    columns = {"turning_moment": drive, "load_torque": load, "excess_torque": (drive - load).named("excess_torque")}
    net = columns["excess_torque"]
    torque, result = excess_of_torques(turning, over)
    own = turning_inertia(machine, "whole_inertia")
    balance = Balance(net, torque, own, Curve.constant(own.value, turning.cycle), result, sign=1.0)
    excess, turn = excess_of(balance), analyse_speed(machine, balance, w, mean, "extremes")
    columns |= turn.columns
    summary = {**_given_values(machine, w), "mean_torque": mean, **_power(machine, turning, mean, w)}
    summary |= _extremes_of(traced, over) | _per_cycle(machine, mean, excess) | turn.summary
    inertia = 0.0 if turn.speed is None else turn.speed.inertia.mean
    if turn.speed is not None:
        total_inertia = next(
            (value for key, value in turn.between.items() if key in ("whole_inertia", "flywheel_inertia")), own
        )
        acceleration = acceleration_of_crank(net, absent("speed"), total_inertia, absent("reduced_inertia_1"))
        columns["angular_acceleration"] = acceleration
        summary |= _extremes("angular_acceleration", acceleration, torque * (1 / inertia))
    checks = _checks(turning, over, columns, (result, turn.speed, inertia))
    notices = (*_notices(turning), *turn.notices)
    listings = {"energy_extremes": _listing(result, turn.speed)}
    columns = {key: value.named(key) for key, value in columns.items()}
    stretches = (
        item for item in in_order([*traced.values(), *means.values()]) if key_of(item.key).quantity in _STRETCHES
    )
    between = {stretch.key: stretch for stretch in stretches if stretch.key not in _STRETCHES} | turn.between
    summary |= {key: value for key, value in between.items() if key.startswith("shearing_force.")}
    return _Turned(columns, summary, between, checks, notices, listings)


def _mean(over: CycleInterpolant, machine: Machine, turning: ShaftTorques, table: str, w: TracedValue) -> TracedValue:
    """Return the mean of a torque, with the work that is done at one angle."""
    key, diagram = COLUMN_OF[table], turning.diagrams[table]
    mean = over.mean(key, "mean_torque")
    if not impulsive_work(diagram):
        return mean
    at_once = works_at_once(machine, turning, table, key, w)
    period = given("cycle_angle", diagram.period, f"{table}.period")
    evened = (at_once.named("stroke_work") / period).named("mean_torque")
    return evened if over.is_zero(key) else (mean.named("mean_torque.stretched") + evened).named("mean_torque")


def _extremes_of(traced: Mapping[str, TracedValue], over: CycleInterpolant) -> dict[str, TracedValue]:
    """Return the extremes of torques that are not constant."""
    values = dict[str, TracedValue]()
    for key, known in traced.items():
        if known.varies:
            values |= _extremes(key, known, curve_of(over, key))
    return values


def _extremes(key: str, known: TracedValue, curve: Curve) -> dict[str, TracedValue]:
    """Return the extremes of a column, on both sides of its jumps."""
    low, at_low, high, at_high = curve.extremes()
    result, negligible = dict[str, TracedValue](), NEGLIGIBLE * max(abs(low), abs(high))
    for word, extreme, phi in (("max", high, at_high), ("min", low, at_low)):
        value = extreme if abs(extreme) > negligible else 0.0
        degrees = math.degrees(phi)
        result[f"{key}_{word}"] = TracedValue(ProcedureValue(value, word, (known.named(key),), degrees))
        result[f"{key}_{word}_angle"] = TracedValue(ProcedureValue(phi, f"{word}_angle", (known.named(key),), degrees))
    return result


def _listing(excess: ExcessWork, speed: TrueSpeed | None) -> Listing:
    """Return the extremes of the energy in their order: angle, energy, work from the last extreme, speed."""
    angles, energy = _turning_points(excess.curve)
    columns: dict[str, Array] = {
        "crank_angle": angles,
        "kinetic_energy_change": energy,
        "loop_work": energy - np.roll(energy, 1),
    }
    if speed is not None:
        columns["crank_speed"] = np.sqrt(2 * (speed.energy + energy) / speed.inertia.mean)
    return Listing(columns)


def _turning_points(energy: Curve) -> tuple[Array, Array]:
    """Return angles and values of the local extremes of an energy, with both sides of its jumps. [rad], [J]"""
    middle = (energy.angle[1:] + energy.angle[:-1]) / 2
    angles = np.unique(np.concatenate([energy.angle, energy.derivative.zeros(), middle]))
    before = np.append(angles[1:], energy.angle[-1]) - 1e-12 * energy.cycle
    points = [(angle, float(value)) for angle, value in zip(angles[:-1], energy(angles[:-1]), strict=True)]
    ends = [(high, float(value)) for high, value in zip(angles[1:], energy(before[:-1]), strict=True)]
    size = max(abs(value) for _, value in points) or 1.0
    corners = list[tuple[float, float]]()
    for start, end in zip(points, ends, strict=True):
        for angle, value in (start, end):
            if not corners or abs(value - corners[-1][1]) > _ROUNDED * size:
                corners.append((angle, value))
    count = len(corners)
    if count < 3:
        return np.array([angle for angle, _ in corners]), np.array([value for _, value in corners])
    if abs(corners[0][1] - corners[-1][1]) <= _ROUNDED * size:
        corners.pop()
    kept = [
        item
        for last, item, following in zip([corners[-1], *corners[:-1]], corners, [*corners[1:], corners[0]], strict=True)
        if (item[1] - last[1]) * (following[1] - item[1]) < 0
    ]
    return np.array([angle for angle, _ in kept]), np.array([value for _, value in kept])


def _notices(turning: ShaftTorques) -> Iterator[Notice]:
    """Yield notices of work that is done at one angle, and of works that differ."""
    if any(impulsive_work(diagram) for diagram in turning.diagrams.values()):
        yield Notice("work_at_once", {})
    for name, diagram in turning.diagrams.items():
        if diagram.work < 0:
            yield Notice("torque_backwards", {"name": name, "torque": diagram.work / diagram.period})
    if turning.torque is not None and turning.load is not None:
        driven, taken = (item.work / item.period * turning.cycle for item in (turning.torque, turning.load))
        if abs(driven - taken) > _ROUNDED * max(abs(driven), abs(taken)):
            yield Notice("work_differs", {"driven": driven, "taken": taken})


def _checks(
    turning: ShaftTorques,
    over: CycleInterpolant,
    columns: Mapping[str, TracedValue],
    balance: tuple[ExcessWork, TrueSpeed | None, float],
) -> dict[str, float]:
    """Return residuals between integrated works and energies and those of the diagrams in closed form."""
    (values, speed, inertia), cycle = balance, turning.cycle
    works = {key: turning.diagrams[table].work_to for table, key in torque_keys(turning)}
    angles = np.linspace(0.0, cycle, 721)[:-1] + cycle / 1440
    end = np.array([cycle])
    size = max((float(np.ptp(np.append(work(angles), work(end)))) for work in works.values()), default=0.0) or 1.0
    residuals = {
        key: abs(over.integral(key) + impulsive_work(diagram) * cycle / diagram.period - float(works[key](end)[0]))
        for (_, key), diagram in zip(torque_keys(turning), turning.diagrams.values(), strict=True)
    }
    sense = {"turning_moment": 1.0, "load_torque": -1.0}
    energy = np.zeros_like(angles)
    for key, work in works.items():
        energy += sense[key] * (work(angles) - work(end) * angles / cycle)
    energy -= energy[0]
    checks = {"turning_work": max(residuals.values()) / size}
    gained = values.curve(angles) - values.curve(angles[:1])
    checks["turning_energy"] = float(np.max(np.abs(gained - energy))) / size
    if speed is not None:
        grid = CrankGrid.from_radians(angles)
        w = Program({"": columns["crank_speed"]})(grid)[""]
        gained = inertia / 2 * (w**2 - w[0] ** 2)
        checks["turning_speed"] = float(np.max(np.abs(gained - energy))) / size
    return checks


def _of_energies(machine: Machine, turning: ShaftTorques, w: TracedValue) -> _Turned:
    """Return the results of the areas of loops, or of the excess work alone."""
    ((table, diagram),) = turning.diagrams.items()
    summary, listings, between = _given_values(machine, w), dict[str, Listing](), dict[str, TracedValue]()
    mean = absent("mean_torque")
    if diagram.constant:
        mean = summary["mean_torque"] = constant_torque(machine, diagram, table, "mean_torque", w)
        summary |= _power(machine, turning, mean, w)
    checks = {}
    if diagram.loops:
        excess, energies = _of_loops(machine, diagram, table)
        between |= {energy.key: energy for energy in energies}
        levels = np.array([energy.value for energy in energies])
        number = np.arange(1.0, levels.size + 1)
        listings["energy_extremes"] = Listing({
            "loop_number": number,
            "loop_work": np.array(diagram.loops),
            "kinetic_energy_change": levels,
        })  # fmt: skip
        checks["turning_work"] = abs(float(np.ptp(np.cumsum(diagram.loops))) - excess.value) / (excess.value or 1.0)
        summary |= _per_cycle(machine, mean, excess)
    else:
        summary |= _of_excess(machine, diagram, table, mean)
        excess = summary["excess_work"].named("excess_work")
    notices, inertia = tuple[Notice, ...](), turning_inertia(machine, "whole_inertia")
    try:
        wheels = wheels_of(machine, w, target_fluctuation(machine, w), excess, inertia)
    except MethodError as error:
        notices = (Notice("no_flywheel", {"message": error.args[0]}),)
    else:
        inertia, between, summary = wheels.inertia, between | wheels.between, summary | wheels.summary
    if inertia.value > 0:
        delta: TracedValue = fluctuation_of_inertia(excess, inertia, w)
        summary["speed_fluctuation"] = delta = delta.named("speed_fluctuation")
        summary["crank_speed_max"], summary["crank_speed_min"] = w + delta * w / 2, w - delta * w / 2
        summary |= recovery_torque_values(machine, inertia, w, summary)
    return _Turned({}, summary, between, checks, notices, listings)


def _of_loops(machine: Machine, diagram: TorqueDiagram, table: str) -> tuple[TracedValue, list[TracedValue]]:
    """Return the excess work of loops about the mean, and the energy after each."""
    scale, after, energies = work_scale(machine, table), absent("kinetic_energy_change.0"), list[TracedValue]()
    for number, work in enumerate(diagram.loops, start=1):
        loop = _work_of(machine, f"{table}.areas[{number}]", f"loop_work.{number}", work, scale)
        after = (after + loop if number > 1 else loop).named(f"kinetic_energy_change.{number}")
        energies.append(after)
    ordered = sorted(energies, key=lambda item: item.value)
    least, largest = ordered[0], ordered[-1]
    return (largest - least).named("excess_work"), energies


def _work_of(machine: Machine, path: str, key: str, work: float, scale: TracedValue) -> TracedValue:
    """Return a work that is stated, or that of an area of the drawing."""
    area = traced_inputs.stated_value(machine, path, f"drawn_area.{key.rpartition('.')[2]}")
    plain = given(key, work, path)
    return plain if scale.is_absent or area.is_absent else traced_inputs.checked(scale * area, plain)


def _of_excess(machine: Machine, diagram: TorqueDiagram, table: str, mean: TracedValue) -> dict[str, TracedValue]:
    """Return an excess work that is stated, or that of its coefficient."""
    plain = given("excess_work", diagram.excess or 0.0, f"{table}.excess_work")
    coefficient = traced_inputs.stated_value(machine, f"{table}.energy_fluctuation", "energy_fluctuation")
    if coefficient.is_absent:
        return _per_cycle(machine, mean, _work_of(machine, f"{table}.excess_work", "excess_work", plain.value,
                                                  work_scale(machine, table)))  # fmt: skip
    result = _per_cycle(machine, mean, plain)
    work = result["work_per_cycle"].named("work_per_cycle")
    return {
        **result,
        "excess_work": traced_inputs.checked(coefficient * work, plain),
        "energy_fluctuation": coefficient,
    }


class TurningDiagram(NamedTuple):
    """A torque and its load as they are drawn, with the loops between them: middles and works [deg], [SI]."""

    degrees: Array
    torque: Array
    load: Array
    energy: Array
    loops: tuple[tuple[float, float, float], ...]  # Angle and torque of the middle of each, and its work


def turning_diagram(results: Results, step: float = 0.5) -> TurningDiagram | None:
    """Return the curves of the figure of a shaft, on both sides of every jump; None if no torque is given."""
    if "turning_moment" not in results.columns:
        return None
    cycle = results.machine.cycle
    shown = ("turning_moment", "load_torque", "kinetic_energy_change")
    breaks = breakpoints_of([results.trace[key] for key in shown], cycle)
    near_jumps = np.concatenate([breaks[1:] - _JUMP_OFFSET, breaks[:-1] + _JUMP_OFFSET])
    even = np.linspace(0.0, cycle, min(max(round(cycle / step), 360), _MOST_DRAWN) + 1)
    degrees = np.unique(np.concatenate([even, near_jumps]))
    result = results.columns_at(degrees, shown)
    extremes = results.listings["energy_extremes"].columns
    ends, works = np.degrees(extremes["crank_angle"]), extremes["loop_work"]
    loops = []
    for index, work in enumerate(works.tolist()):
        start, end = float(ends[index - 1]), float(ends[index])
        inside = (degrees > start) & (degrees < end) if start < end else (degrees > start) | (degrees < end)
        if start > end:
            # the larger part of a loop that goes on in the next period
            later = cycle - start > end
            inside &= degrees > start if later else degrees < end
        weight = np.abs(result["turning_moment"] - result["load_torque"])[inside]
        if weight.size and weight.any():
            middle = float(degrees[inside] @ weight / weight.sum())
            height = float(np.interp(middle, degrees, result["turning_moment"] + result["load_torque"])) / 2
            loops.append((middle, height, work))
    torque, load, energy = (result[key] for key in shown)
    return TurningDiagram(degrees, torque, load, energy, tuple(loops))
