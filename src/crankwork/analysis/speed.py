"""How evenly a machine runs: excess work, flywheel, speed over a cycle, the speed that a motor settles at."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.analysis.flywheel import (
    flywheel_dimensions,
    given_flywheel_dimensions,
    recovery_torque_values,
    target_fluctuation,
)
from crankwork.errors import MethodError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import (
    FormulaCall,
    FunctionValue,
    ProcedureValue,
    Tabulated,
    TracedValue,
    absent,
    given,
    select,
)
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.machine import Drive, Machine
from crankwork.preparation import traced_inputs
from crankwork.preparation.prepared import Notice
from crankwork.shaft.curve import AtDegrees, Curve
from crankwork.shaft.fluctuation import (
    ExcessWork,
    Mean,
    SpeedOfPolynomials,
    TrueSpeed,
    excess_work,
    fluctuation_of_inertia,
    share_of_work,
    speed_of_energy,
    true_speed,
)
from crankwork.shaft.flywheel import (
    check_fluctuation,
    flywheel_beside_machine,
    inertia_for_fluctuation,
    inertia_on_other_shaft,
    slope_largest,
    slope_least,
    slope_of_mean_speed,
    wittenbauer_slope_largest,
    wittenbauer_slope_least,
    work_of_mean_torque,
    works_of_tangents,
)
from crankwork.shaft.motor import GearedMotor, first_angle_beyond, needed_power
from crankwork.shaft.steady_speed import ReducedMachine, steady_speed

_SLOPES = {
    "wittenbauer": (wittenbauer_slope_largest, wittenbauer_slope_least),
    "exact": (slope_largest, slope_least),
}
# relative difference of the textbook fluctuation from that of the speeds, above which it is reported [-]
_BOOKS_ARE_NEAR = 0.01


class Balance(NamedTuple):
    """Torque on the crank over a cycle, without the constant torque that balances it, and the reduced inertia."""

    torque: TracedValue  # Without that of inertia [N m]
    curve: Curve  # The same, positive where it drives [N m]
    inertia: TracedValue  # Without a flywheel to be found; absent where nothing of it is known [kg m2]
    inertia_curve: Curve
    excess: ExcessWork
    sign: float = -1.0  # Of `torque` where it drives: that of loads brakes


def has_friction(drive: Drive, over: CycleInterpolant) -> bool:
    """Return whether friction counts in the driving torque: it is known, and no efficiency replaces it."""
    return "torque_with_friction" in over.columns and drive.losses != "machine"


def balance_of(
    machine: Machine, over: CycleInterpolant, trace: Mapping[str, TracedValue], *, counts_efficiency: bool = True
) -> Balance:
    """Return the torque of loads and losses on the crank of a linkage, with its reduced inertia.

    Losses are those of friction at the mean speed, or else those of an efficiency as the calculation uses it, unless
    the motor has them.
    """
    torque, drive = trace["static_torque"], machine.drive
    if has_friction(drive, over):
        torque = (torque + (trace["torque_with_friction"] - trace["balancing_torque"])).named("load_torque")
    elif counts_efficiency and drive.efficiency != 1 and drive.losses != "drive" and torque.varies:
        torque = (torque + (trace["driving_torque"] - trace["balancing_torque"])).named("load_torque")
    edges, inertia = np.radians(over.edges), trace["reduced_inertia"]
    program = Program({"torque": torque, "inertia": inertia})

    def followed(key: str) -> Curve:
        return Curve.fitted(lambda angle: program.rows(CrankGrid.from_radians(angle), (key,))[0], edges)

    load = -followed("torque")
    return Balance(torque, load, inertia, followed("inertia"), excess_work(load))


def delivered_or_needed(delivered: TracedValue) -> TracedValue:
    """Return the mean torque of a machine: delivered or, under the key of a driving torque, that of its driver."""
    return delivered if delivered.value >= 0 else (-delivered).named("mean_driving_torque")


class SpeedResults(NamedTuple):
    """Results for the speed of a machine: columns, single values, residuals, notices, intermediate values."""

    columns: dict[str, TracedValue]
    summary: dict[str, TracedValue]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    between: dict[str, TracedValue]
    speed: TrueSpeed | None = None
    added: float = 0.0  # Moment of inertia of a flywheel that was found [kg m2]


def has_flywheel(drive: Drive) -> bool:
    """Return whether a flywheel is given or to be sized."""
    return drive.fluctuation is not None or drive.wheel is not None


def excess_of(balance: Balance) -> TracedValue:
    """Return the excess work of a balance."""
    return TracedValue(ProcedureValue(balance.excess.work, "range", (balance.torque,)), "excess_work")


def work_of(excess: TracedValue, mean: TracedValue | None, cycle: TracedValue) -> dict[str, TracedValue]:
    """Return the work of a cycle and the ratio of the excess work to it; empty without a mean torque."""
    if mean is None or not mean.value:
        return {}
    work = work_of_mean_torque(mean, cycle)
    return {"work_per_cycle": work, "energy_fluctuation": share_of_work(excess, work)}


def analyse_speed(
    machine: Machine, balance: Balance, w: TracedValue, mean_torque: TracedValue | None, mean: Mean = "time"
) -> SpeedResults:
    """Return excess work, flywheel, fluctuation and speed of a machine, as far as its inertia is known.

    `mean`: kind of mean that its stated speed is.
    """
    excess = excess_of(balance)
    turn = _speed(machine, balance, w, excess, mean)
    between = turn.between | work_of(excess, mean_torque, traced_inputs.cycle_angle(machine))
    return turn._replace(summary={excess.key: excess, **turn.summary}, between=between)


def _speed(machine: Machine, balance: Balance, w: TracedValue, excess: TracedValue, mean: Mean) -> SpeedResults:
    """Return flywheel, fluctuation and speed."""
    change = TracedValue(
        Tabulated(
            AtDegrees(balance.excess.curve), "integral", np.degrees(balance.excess.curve.angle), (balance.torque,)
        ),
        "kinetic_energy_change",
    )
    columns, wanted = {"kinetic_energy_change": change}, target_fluctuation(machine, w)
    works = _works(balance, w, wanted) if balance.inertia.varies else {}
    mertsalov = {value.key: value for method, value in works.items() if method == "mertsalov"}
    if not (has_flywheel(machine.drive) or machine.drive.inertia):
        return SpeedResults(columns, mertsalov, {}, (), {})
    try:
        by_all_methods = partial(_by_all_methods, balance, works, w)
        summary, between, wheel, inertia = wheels_of(machine, w, wanted, excess, balance.inertia, by_all_methods)
    except MethodError as error:
        return SpeedResults(columns, {}, {}, (Notice("no_flywheel", {"message": error.args[0]}),), {})
    summary |= mertsalov
    if not (inertia.varies or inertia.value > 0):
        missing = () if wanted is None else (Notice("no_flywheel", {"message": ErrorMessage("masses_missing")}),)
        return SpeedResults(columns, summary, {}, missing, between)
    try:
        speed = true_speed(balance.inertia_curve + wheel.value, balance.curve, w.value, balance.excess, mean=mean)
    except MethodError as error:
        return SpeedResults(columns, summary, {}, (Notice("no_steady_speed", {"message": error.args[0]}),), between)
    energy = TracedValue(ProcedureValue(speed.energy, "energy", (balance.torque,)), "kinetic_energy.start")
    columns["crank_speed"] = speed_of_energy(energy + change, inertia).named("crank_speed")
    operands = (balance.torque, inertia, w)
    result = SpeedOfPolynomials(balance.sign, mean)
    if not inertia.varies:
        summary["speed_fluctuation"] = fluctuation_of_inertia(excess, inertia, w)
    elif wanted is not None and wheel.value:
        summary["speed_fluctuation"] = wanted
    else:
        summary["speed_fluctuation"] = TracedValue(FunctionValue(speed.fluctuation, "fluctuation", operands, result, 0))
    summary |= _extremes(speed, columns["crank_speed"], operands, result)
    summary |= recovery_torque_values(machine, inertia, w, summary)
    checks = {}
    if wanted is not None and balance.inertia.varies:
        more = speed.fluctuation - wanted.value
        checks["flywheel"] = abs(more) if wheel.value else max(more, 0.0)
    low, _, high, _ = speed.extremes
    swings, notices = 2 * (high - low) / (high + low), tuple[Notice, ...]()
    if abs(swings / (speed.fluctuation or swings or 1.0) - 1) > _BOOKS_ARE_NEAR:
        notices = (Notice("fluctuation_of_books", {"books": speed.fluctuation, "speeds": swings}),)
    return SpeedResults(columns, summary, checks, notices, between, speed, wheel.value)


def _works(balance: Balance, w: TracedValue, wanted: TracedValue | None) -> dict[str, TracedValue]:
    """Return the excess work of each method that uses tangents, from their slopes.

    Mertsalov's is the excess work of the torque at the mean speed, with the torque of inertia.
    """
    slopes: dict[str, tuple[TracedValue, TracedValue]] = {}
    slopes["mertsalov"] = 2 * (slope_of_mean_speed(w).named("wittenbauer_slope.mertsalov"),)
    for method, (largest, least) in _SLOPES.items() if wanted is not None else ():
        ends = {"largest": largest(w, wanted), "least": least(w, wanted)}
        slopes[method] = tuple(value.named(f"wittenbauer_slope.{method}.{end}") for end, value in ends.items())
    values = works_of_tangents(balance.inertia_curve, balance.excess, [(a.value, b.value) for a, b in slopes.values()])
    return {
        method: TracedValue(
            ProcedureValue(work, "tangents", (balance.torque, balance.inertia, *ends)), f"excess_work.{method}"
        )
        for (method, ends), work in zip(slopes.items(), values, strict=True)
    }


def _extremes(
    speed: TrueSpeed, column: TracedValue, operands: tuple[TracedValue, ...], solution: SpeedOfPolynomials
) -> dict[str, TracedValue]:
    """Return the extremes of the speed, each with its angle."""
    low, at_low, high, at_high = speed.extremes
    result = {}
    for part, (word, value, angle) in ((1, ("max", high, at_high)), (3, ("min", low, at_low))):
        degrees = math.degrees(angle)
        derivation, where = (
            TracedValue(FunctionValue(item, word, operands, solution, part + k))
            for k, item in enumerate((value, angle))
        )
        result[f"crank_speed_{word}"] = TracedValue(ProcedureValue(value, word, (column,), degrees, derivation))
        result[f"crank_speed_{word}_angle"] = TracedValue(
            ProcedureValue(angle, f"{word}_angle", (column,), degrees, where)
        )
    return result


class Wheels(NamedTuple):
    """The flywheel for a wanted fluctuation with its sizes, or those of one that is given."""

    summary: dict[str, TracedValue]
    between: dict[str, TracedValue]
    wheel: TracedValue  # Moment of inertia of one that was found; zero if none is needed
    inertia: TracedValue  # Of all that turns with the crank, this flywheel too


def wheels_of(
    machine: Machine,
    w: TracedValue,
    wanted: TracedValue | None,
    excess: TracedValue,
    own: TracedValue,
    by_all_methods: Callable[[TracedValue], dict[str, TracedValue]] | None = None,
) -> Wheels:
    """Return the flywheel of a machine from its excess work and the moment of inertia without it.

    `by_all_methods`: the flywheels for a wanted fluctuation by each method, if that inertia varies.
    """
    if wanted is None:
        return Wheels(given_flywheel_dimensions(machine, w), {}, absent("flywheel_inertia"), own)
    check_fluctuation(wanted.value, w.value)
    wheels, between = dict[str, TracedValue](), dict[str, TracedValue]()
    if own.varies and by_all_methods is not None:
        wheels = by_all_methods(wanted)
        wheel = wheels["flywheel_inertia.exact"]
        total_inertia = (own + wheel).named("whole_inertia")
    else:
        wheel = total_inertia = inertia_for_fluctuation(excess, wanted, w).named("flywheel_inertia")
        if not own.is_absent:
            total_inertia = total_inertia.named("whole_inertia")
            wheel = flywheel_beside_machine(total_inertia, own)
        wheel = _needed(wheel)
        between = {total_inertia.key: total_inertia} if wheel.value else {}
    summary = {"flywheel_inertia": wheel, **wheels, **(flywheel_dimensions(machine, wheel, w) if wheel.value else {})}
    return Wheels(summary, between, wheel, total_inertia if wheel.value else own)


def _by_all_methods(
    balance: Balance, works: Mapping[str, TracedValue], w: TracedValue, wanted: TracedValue
) -> dict[str, TracedValue]:
    """Return the flywheel for a wanted fluctuation by each method, from its excess work."""
    energy = TracedValue(ProcedureValue(balance.excess.work, "range", (balance.torque, balance.inertia)), "excess_work")
    works = {"energy": energy, **works}
    return {f"flywheel_inertia.{method}": _wheel(method, work, balance, w, wanted) for method, work in works.items()}


def _wheel(method: str, work: TracedValue, balance: Balance, w: TracedValue, wanted: TracedValue) -> TracedValue:
    """Return the flywheel of one method from its excess work."""
    wheel: TracedValue = inertia_for_fluctuation(work, wanted, w)
    if method in ("energy", "mertsalov"):
        own = balance.inertia_curve
        word, value = ("mean", own.mean) if method == "energy" else ("min", own.extremes().least)
        less = TracedValue(ProcedureValue(value, word, (balance.inertia,)), f"reduced_inertia.{word}")
        wheel = flywheel_beside_machine(wheel.named(f"whole_inertia.{method}"), less)
    return _needed(wheel).named(f"flywheel_inertia.{method}")


def _needed(wheel: TracedValue) -> TracedValue:
    """Return a flywheel, zero where the machine turns evenly enough without one."""
    needed, node = select(wheel, wheel, 0.0), wheel.node
    if wheel.value <= 0:
        return TracedValue(ProcedureValue(0.0, "none", (wheel,), argument=needed))
    assert isinstance(node, FormulaCall)  # noqa: S101 - a needed flywheel comes from a formula
    return TracedValue(FormulaCall(node.formula, node.inputs, needed), wheel.key)


def _rotor(motor: GearedMotor) -> dict[str, TracedValue]:
    """Return the moment of inertia of the rotor on the crank; empty without one."""
    if not motor.inertia:
        return {}
    inertia = given("flywheel_inertia.motor", motor.inertia, "motor.inertia")
    ratio = given("gear_ratio", motor.ratio, "motor.ratio")
    return {"inertia_on_crank": inertia_on_other_shaft(inertia, ratio)}


def driven_by_motor(
    machine: Machine,
    motor: GearedMotor,
    balance: Balance,
    w: TracedValue,
    mean_torque: TracedValue | None,
    added: float,
) -> SpeedResults:
    """Return the power that the motor needs and the speed that it settles at; `added`: a flywheel [kg m2]."""
    drive, inertia, load = machine.drive, balance.inertia_curve, balance.curve
    if not balance.inertia.varies and not balance.inertia.value and not added + motor.reduced_inertia:
        return SpeedResults({}, {}, {}, (Notice("no_steady_speed", {"message": ErrorMessage("masses_missing")}),), {})
    mean, eta, notices = (-load).mean, traced_inputs.efficiency_of(drive), tuple[Notice, ...]()
    if mean > 0 and mean_torque is not None:
        power: TracedValue = needed_power(absent("power_reserve", 1.0), mean_torque, w, eta)
    else:
        power = TracedValue(ProcedureValue(float(needed_power(1.0, mean, w.value, drive.efficiency)), "need", (w, eta)))
    if power.value > drive.rated_power:
        powers: dict[str, float | str] = {"needed": power.value / 1e3, "rated": drive.rated_power / 1e3}
        notices = (Notice("overloaded", powers),)
    values, reasons = _steady(motor, w.value, inertia, load, added)
    steady = {key: TracedValue(ProcedureValue(value, "steady"), key) for key, value in values.items()}
    return SpeedResults({}, {"motor_power": power, **steady}, {}, notices + reasons, _rotor(motor))


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
        return {}, (Notice("no_steady_speed", {"message": ErrorMessage("steady_unfound", speed=speed)}),)
    return {}, (Notice("stalls", {"torque": greatest, "angle": float(np.degrees(stalls))}),)
