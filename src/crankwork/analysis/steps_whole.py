"""Worked steps of the whole engine: firing, torque, bearings, balance, and how evenly it runs."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from crankwork.analysis.cylinders import WholeEngine, whole_engine
from crankwork.analysis.results import Results
from crankwork.analysis.steps_whole_balance import balance_steps
from crankwork.analysis.steps_whole_bearings import bearing_steps, load_steps
from crankwork.analysis.steps_whole_torque import articulated_steps, torque_steps
from crankwork.cylinders.firing import is_even
from crankwork.cylinders.torque import even_firing_interval, firing_intervals, mean_torque_of_work
from crankwork.cylinders.torque_harmonics import amplitude_of_harmonic, amplitude_of_total
from crankwork.formula.steps import AnyStep, Given, StepGroup, renamed, sum_step, worked_step
from crankwork.loads import gas as gas_formulas
from crankwork.shaft.fluctuation import fluctuation_of_energy, fluctuation_of_inertia
from crankwork.shaft.flywheel import flywheel_beside_machine, inertia_for_fluctuation, work_of_mean_torque
from crankwork.working_cycle.engine_size import displacement

_SHOWN_ORDERS = 3


def whole_engine_steps(results: Results, crank_angle: float) -> tuple[StepGroup, ...]:
    """Return the worked steps of the engine that a crank gear belongs to.

    Parameters
    ----------
    results : Results
        Of a machine with an engine.
    crank_angle : float
        Crank angle of cylinder 1 where what varies is shown. [deg]

    Returns
    -------
    tuple of StepGroup
        Groups `firing`, `engine_torque`, `articulated`, `bearings`, `bearing_loads`, `torque_harmonics`,
        `uniformity`, `balance`; those without a step are empty.
    """
    whole = whole_engine(results.solved)
    firing = StepGroup("firing", tuple(_firing(whole)))
    if "crank_torque" not in results.columns:
        return (firing,)
    at = math.radians(crank_angle)
    return (
        firing,
        StepGroup("engine_torque", tuple(torque_steps(results, whole, crank_angle)), at),
        StepGroup("articulated", tuple(articulated_steps(whole, crank_angle)), at),
        StepGroup("bearings", tuple(bearing_steps(results, crank_angle)), at),
        StepGroup("bearing_loads", tuple(load_steps(results))),
        StepGroup("torque_harmonics", tuple(_harmonics(results, whole))),
        StepGroup("uniformity", tuple(_uniformity(results, whole))),
        StepGroup("balance", tuple(balance_steps(results, whole) if "balance" in results.listings else ())),
    )


def _is_uniform(whole: WholeEngine) -> bool:
    """Return whether every cylinder does what the first does."""
    return len(set(map(id, whole.cylinders))) == 1


def _firing(whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield number and volume of the cylinders and when they fire."""
    layout, count = whole.layout, float(len(whole.cylinders))
    yield Given("cylinder_count", count)
    if _is_uniform(whole):
        space = whole.master.space
        if space is not None:
            yield worked_step(displacement, space.swept, count)
    elif all(one.space is not None for one in whole.cylinders):
        yield sum_step(
            "displacement",
            [
                worked_step(gas_formulas.swept_volume, one.space.area, one.stroke[0], key=f"swept_volume.{number}")
                for number, one in enumerate(whole.cylinders, start=1)
                if one.space is not None
            ],
        )
    steps = firing_intervals(layout)
    if is_even(steps):
        yield worked_step(even_firing_interval, math.radians(layout.cycle), count)
    else:
        for number, step in zip(layout.firing_order, steps, strict=True):
            yield Given(f"firing_interval.{number}", math.radians(step))
    for place in layout.places:
        yield Given(f"firing_angle.{place.number}", math.radians(place.firing_angle))


def _uniformity(results: Results, whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield mean torque, fluctuation of the energy, the flywheel and the fluctuation of the speed with it."""
    summary, w, engine = results.summary, whole.master.speed, whole.engine
    yield from _mean_torque(results, whole)
    mean, excess = summary["mean_total_torque"], summary["excess_work"]
    yield Given("excess_work", excess)
    if mean:
        work = worked_step(work_of_mean_torque, mean, math.radians(whole.layout.cycle))
        yield work
        yield worked_step(fluctuation_of_energy, excess, abs(work.value))
    found = summary.get("flywheel_inertia")
    if found and engine.fluctuation is not None:
        key = "whole_inertia" if engine.inertia else "flywheel_inertia"
        needed = worked_step(inertia_for_fluctuation, excess, engine.fluctuation, w, key=key)
        yield needed
        if engine.inertia:
            yield worked_step(flywheel_beside_machine, needed.value, engine.inertia)
    elif found is not None:
        # what turns already is enough
        yield Given("flywheel_inertia", found)
    if "speed_fluctuation" in summary:
        step = worked_step(fluctuation_of_inertia, excess, engine.inertia + (found or 0.0), w)
        yield renamed(step, J="whole_inertia") if engine.inertia and found else step


def _mean_torque(results: Results, whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield the mean of the total torque: from the works where they are what the torque does, else as integrated."""
    mean, cycle = results.summary["mean_total_torque"], math.radians(whole.layout.cycle)
    works = [one.space.work for one in whole.cylinders if one.space is not None]
    if len(works) < len(whole.cylinders):
        yield Given("mean_total_torque", mean)
        return
    does_work = results.method.is_exact and not whole.machine.angular_acceleration and mean
    if not does_work:
        yield Given("mean_total_torque", mean)
    key = "mean_total_torque" if does_work else "mean_total_torque.indicated"
    if _is_uniform(whole):
        yield worked_step(mean_torque_of_work, float(len(works)), works[0], cycle, key=key)
        return
    each = [worked_step(gas_formulas.mean_torque, one, cycle, key=f"mean_torque.{k}") for k, one in enumerate(works, 1)]
    yield sum_step(key, each)


def _harmonics(results: Results, whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield the first harmonics in which all cylinders pull together, where every cylinder does the same."""
    count = len(whole.cylinders)
    if not _is_uniform(whole):
        return
    columns = results.listings["torque_harmonics"].columns
    major = np.flatnonzero(np.abs(columns["phase_sum"] - count) < 1e-9)[:_SHOWN_ORDERS]
    for number, row in enumerate(major, start=1):
        at = {key: float(column[row]) for key, column in columns.items()}
        yield Given(f"harmonic_order.{number}", at["harmonic_order"])
        one = worked_step(
            amplitude_of_harmonic, at["harmonic_cosine"], at["harmonic_sine"], key=f"harmonic_amplitude.{number}"
        )
        yield one
        yield Given(f"phase_sum.{number}", at["phase_sum"])
        step = worked_step(amplitude_of_total, one.value, at["phase_sum"], key=f"total_harmonic_amplitude.{number}")
        yield renamed(step, M_nu=one.key, s_nu=f"phase_sum.{number}")
