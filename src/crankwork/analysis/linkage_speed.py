"""How evenly a linkage runs: flywheel in four ways, and the steady speed that motor and loads settle at."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.evenness import sizes_of, sizes_of_given, wanted_fluctuation
from crankwork.analysis.linkage_memory import efficiency_of, speed_of
from crankwork.analysis.solved import Notice
from crankwork.errors import MethodError
from crankwork.formula.known import Found, Known, Table, absent, given
from crankwork.formula.over_cycle import OverCycle
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.shaft.curve import AtDegrees, Curve
from crankwork.shaft.fluctuation import excess_work, share_of_work, speed_of_energy, true_speed
from crankwork.shaft.flywheel import (
    WAYS,
    Flywheel,
    flywheel,
    flywheel_beside_machine,
    inertia_for_fluctuation,
    inertia_on_other_shaft,
    slope_largest,
    slope_least,
    slope_of_mean_speed,
    wittenbauer_slope_largest,
    wittenbauer_slope_least,
    work_of_mean_torque,
)
from crankwork.shaft.motor import GearedMotor
from crankwork.shaft.motor_choice import first_angle_beyond, needed_power
from crankwork.shaft.speed import ReducedMachine, steady_speed

_SLOPES = {
    "wittenbauer": (wittenbauer_slope_largest, wittenbauer_slope_least),
    "exact": (slope_largest, slope_least),
}


class Turn(NamedTuple):
    """How evenly a linkage runs: columns, single values, what lies between, residuals, what the reader should know."""

    columns: dict[str, Known]
    summary: dict[str, Known]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    between: dict[str, Known]


def turn_of(machine: Machine, over: OverCycle, memory: Mapping[str, Known]) -> Turn:
    """Return flywheel, motor and true speed of a linkage, as far as they are asked for."""
    drive, w = machine.drive, speed_of(machine)
    turn = Turn({}, {}, {}, (), {})
    if drive.fluctuation is None and drive.motor is None and drive.wheel is None:
        return turn
    resistance = _resistance(over, memory)
    inertia, load = _curves(over, memory["reduced_inertia"], resistance)
    added = 0.0
    if drive.fluctuation is not None or drive.wheel is not None:
        try:
            turn, added = _even(machine, memory, resistance, (inertia, load), w)
        except MethodError as error:
            return turn._replace(notices=(Notice("no_flywheel", {"message": error.args[0]}),))
    if drive.motor is not None and over.is_nothing("reduced_inertia") and not added + drive.motor.reduced_inertia:
        told = Notice("no_steady_speed", {"message": Refusal("masses_missing")})
        return turn._replace(notices=(*turn.notices, told))
    if drive.motor is not None:
        summary, told_too = _driven(machine, memory, drive.motor, (inertia, load), added)
        between = turn.between | _rotor(drive.motor)
        return turn._replace(summary={**turn.summary, **summary}, notices=turn.notices + told_too, between=between)
    return turn


def _resistance(over: OverCycle, memory: Mapping[str, Known]) -> Known:
    """Return the torque that loads and friction take at the mean speed; inertia is that of the reduced one."""
    static = memory["static_torque"]
    if "torque_with_friction" not in over.knowns:
        return static
    losses = memory["torque_with_friction"] - memory["balancing_torque"]
    return (static + losses).named("load_torque")


def _curves(over: OverCycle, inertia: Known, resistance: Known) -> tuple[Curve, Curve]:
    """Return reduced inertia and the torque of loads and friction, negative where it brakes, over one revolution."""

    def followed(known: Known) -> Curve:
        program = Program({"": known})
        return Curve.fitted(lambda angle: program(CrankGrid.from_radians(angle))[""], np.radians(over.edges))

    return followed(inertia), -followed(resistance)


def _even(
    machine: Machine, memory: Mapping[str, Known], resistance: Known, curves: tuple[Curve, Curve], w: Known
) -> tuple[Turn, float]:
    """Return the flywheel in four ways, where one is wanted, and with the exact one or a given one the true speed."""
    of, wanted, (inertia, load) = (resistance, memory["reduced_inertia"]), wanted_fluctuation(machine, w), curves
    found = [] if wanted is None else [flywheel(inertia, load, w.value, wanted.value, way) for way in WAYS]
    # a way that finds a negative inertia says that it needs none
    added = max(found[-1].inertia, 0.0) if found else 0.0
    turning, excess = true_speed(inertia + added, load, w.value), excess_work(load)
    wheels = (
        {} if wanted is None else {f"flywheel_inertia.{one.way}": _wheel(one, inertia, w, wanted, of) for one in found}
    )
    had = Known(Found(turning.fluctuation, "fluctuation", of), "speed_fluctuation")
    work = Known(Found(excess.work, "range", of), "excess_work")
    summary = {"excess_work": work, "speed_fluctuation": had if wanted is None or not added else wanted, **wheels}
    change = Known(Table(AtDegrees(excess.curve), "integral", np.degrees(load.angle), of[:1]), "kinetic_energy_change")
    energy = Known(Found(turning.energy, "energy", of), "kinetic_energy.start")
    exact = wheels["flywheel_inertia.exact"] if added else absent("flywheel_inertia")
    crank_speed = speed_of_energy(energy + change, memory["reduced_inertia"] + exact)
    columns = {"kinetic_energy_change": change, "crank_speed": crank_speed.named("crank_speed")}
    summary |= sizes_of(machine, exact, w) if added else sizes_of_given(machine, w)
    checks = {}
    if wanted is not None:
        more = turning.fluctuation - wanted.value
        checks["flywheel"] = abs(more) if added else max(more, 0.0)
    cycle = given("cycle_angle", float(load.angle[-1] - load.angle[0]))
    return Turn(columns, summary, checks, (), _of_energy(memory, work, cycle)), added


def _of_energy(memory: Mapping[str, Known], excess: Known, cycle: Known) -> dict[str, Known]:
    """Return the work of a cycle, and how much of it the kinetic energy takes and gives; nothing without either."""
    mean = memory.get("mean_torque")
    if mean is None or not mean.value:
        return {}
    work = work_of_mean_torque(mean, cycle)
    return {"work_per_cycle": work, "energy_fluctuation": share_of_work(excess, work)}


def _rotor(motor: GearedMotor) -> dict[str, Known]:
    """Return the moment of inertia of the rotor on the crank; nothing without one."""
    if not motor.inertia:
        return {}
    inertia = given("flywheel_inertia.motor", motor.inertia, "motor.inertia")
    ratio = given("gear_ratio", motor.ratio, "motor.ratio")
    return {"inertia_on_crank": inertia_on_other_shaft(inertia, ratio)}


def _excess(one: Flywheel, slopes: tuple[Known, ...], of: tuple[Known, ...]) -> Known:
    """Return the excess work in the sense of one way, by the slopes of its tangents if it has any."""
    if one.way == "energy":
        return Known(Found(one.excess, "range", of), "excess_work")
    return Known(Found(one.excess, "tangents", (*of, *slopes)), f"excess_work.{one.way}")


def _wheel(one: Flywheel, inertia: Curve, w: Known, wanted: Known, of: tuple[Known, ...]) -> Known:
    """Return the flywheel of one way; zero where the machine needs none."""
    key, way = f"flywheel_inertia.{one.way}", one.way
    slopes = tuple(
        slope(w, wanted).named(f"wittenbauer_slope.{way}.{word}")
        for word, slope in zip(("largest", "least"), _SLOPES.get(way, ()), strict=False)
    ) or 2 * (slope_of_mean_speed(w).named(f"wittenbauer_slope.{way}"),)
    whole: Known = inertia_for_fluctuation(_excess(one, slopes, of), wanted, w)
    parts = {"energy": ("mean", inertia.mean), "mertsalov": ("min", inertia.extremes().least)}
    if way in parts:
        word, value = parts[way]
        less = Known(Found(value, word, of[1:]), f"reduced_inertia.{word}")
        whole = flywheel_beside_machine(whole.named(f"whole_inertia.{way}"), less)
    return Known(Found(0.0, "none", (whole,)), key) if one.inertia <= 0 else whole.named(key)


def _driven(
    machine: Machine, memory: Mapping[str, Known], motor: GearedMotor, curves: tuple[Curve, Curve], added: float
) -> tuple[dict[str, Known], tuple[Notice, ...]]:
    """Return the power that the motor needs and the speed that it settles at."""
    drive, w, (inertia, load) = machine.drive, speed_of(machine), curves
    notices: tuple[Notice, ...] = ()
    mean, eta = (-load).mean, efficiency_of(drive)
    needed = float(needed_power(1.0, mean, w.value, drive.efficiency))
    power = Known(Found(needed, "need", (w, eta)), "motor_power")
    if mean > 0 and "mean_torque" in memory:
        power = needed_power(absent("power_reserve", 1.0), memory["mean_torque"], w, eta)
    result = {"motor_power": power}
    if needed > drive.rated_power:
        powers: dict[str, float | str] = {"needed": needed / 1e3, "rated": drive.rated_power / 1e3}
        notices = (Notice("overloaded", powers),)
    more, told = _steady(motor, w.value, inertia, load, added)
    return result | {key: Known(Found(value, "steady"), key) for key, value in more.items()}, notices + told


def _steady(
    motor: GearedMotor, speed: float, inertia: Curve, load: Curve, flywheel: float
) -> tuple[dict[str, float], tuple[Notice, ...]]:
    """Return the steady speed with the motor, or why there is none."""
    reduced = ReducedMachine.of_curves(inertia, load, motor, flywheel=flywheel + motor.reduced_inertia)
    run = steady_speed(reduced, speed)
    if run is not None:
        return {"steady_speed": run.mean_speed, "steady_fluctuation": run.fluctuation}, ()
    speeds = np.linspace(0.0, 2 * speed, 400)
    greatest = float(np.max(motor.torque(speeds)))
    stalls = first_angle_beyond(load * -1.0, greatest)
    if stalls is None:
        return {}, (Notice("no_steady_speed", {"message": Refusal("steady_unfound", speed=speed)}),)
    return {}, (Notice("stalls", {"torque": greatest, "angle": float(np.degrees(stalls))}),)
