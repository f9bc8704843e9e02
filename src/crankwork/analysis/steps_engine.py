"""Worked steps of an engine: lengths, speed, motion, masses, gas, forces and power."""

from __future__ import annotations

import importlib
import math
from collections.abc import Iterator, Mapping

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved
from crankwork.analysis.steps_extremes import extreme_steps, force_extreme_steps
from crankwork.analysis.steps_forces import force_steps
from crankwork.analysis.steps_motion import EngineMoment, harmonic_steps, motion_steps
from crankwork.dynamics import masses as mass_formulas
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics import lengths as length_formulas
from crankwork.kinematics.lengths import mean_piston_speed
from crankwork.loads import gas as gas_formulas
from crankwork.loads.indicator import Piece, Segment
from crankwork.machine import Machine
from crankwork.steps import AnyStep, Given, Step, StepGroup, named_step, renamed, worked_step


def engine_steps(results: Results, crank_angle: float, force_angle: float) -> tuple[StepGroup, ...]:
    """Return the worked steps of an engine.

    Parameters
    ----------
    results : Results
        Of an engine.
    crank_angle, force_angle : float
        Where the motion and the forces are shown. [deg]

    Returns
    -------
    tuple of StepGroup
        Groups `cycle` (the steps that the results themselves hold), `geometry`, `speed`, `motion`, `harmonics`,
        `extremes`, `masses`, `gas`, `forces`, `force_extremes`, `power`, and those of `steps_whole` for an engine of
        several; those without a step are left out.
    """
    solved: Solved = results.solved
    moving, loaded = EngineMoment.at(solved, crank_angle), EngineMoment.at(solved, force_angle)
    at, there = float(moving.grid.angle[0]), float(loaded.grid.angle[0])
    groups = (
        StepGroup("cycle", tuple(_cycle(results, solved))),
        StepGroup("geometry", tuple(_geometry(solved))),
        StepGroup("speed", tuple(_speed(solved))),
        StepGroup("motion", tuple(motion_steps(moving)), at),
        StepGroup("harmonics", tuple(harmonic_steps(moving)), at),
        StepGroup("extremes", tuple(extreme_steps(solved, results.summary))),
        StepGroup("masses", tuple(_masses(solved.machine))),
        StepGroup("gas", tuple(_gas(solved))),
        StepGroup("forces", tuple(force_steps(loaded)), there),
        StepGroup("force_extremes", tuple(force_extreme_steps(solved, results.summary))),
        StepGroup("power", tuple(_power(solved, results.summary))),
    )
    if solved.machine.engine is not None:
        # loaded when needed, as the analysis of whole engines is
        whole = importlib.import_module("crankwork.analysis.steps_whole")
        groups = (*groups, *whole.whole_engine_steps(results, force_angle))
    return tuple(group for group in groups if group.steps)


def _cycle(results: Results, solved: Solved) -> Iterator[AnyStep]:
    """Yield the steps of a calculated cycle, before them what was given and after them what was integrated.

    A value that the rest of the results has too is that `.cycle`. A size is calculated twice where it was rounded.
    """
    calculated = solved.space.calculated if solved.space is not None else None
    if calculated is None:
        return
    last = {step.key: at for at, step in enumerate(results.steps)}
    others = {"displacement"} if solved.machine.engine is not None else set()

    def key_of(key: str) -> str:
        return f"{key}.cycle" if f"{key}.cycle" in results.summary or key in others else key

    end = max((at for at, key in enumerate(calculated.values) if key in last), default=-1)
    known = [
        (at, Given(key_of(key), value))
        for at, (key, value) in enumerate(calculated.values.items())
        if key not in last and key_of(key) in results.summary
    ]
    yield from (one for at, one in known if at < end)
    for at, step in enumerate(results.steps):
        yield step._replace(key=key_of(step.key) if at == last[step.key] else f"{step.key}.before_rounding")
    yield from (one for at, one in known if at > end)


def _geometry(solved: Solved) -> Iterator[Step]:
    r, l, e = (float(one) for one in solved.lengths)  # noqa: E741
    known = {"r": r, "l": l, "e": e, "pi": math.pi}
    yield named_step(length_formulas.rod_ratio, known)
    if not e:
        yield named_step(length_formulas.stroke_central, known)
        return
    yield named_step(length_formulas.relative_offset, known)
    yield named_step(length_formulas.stroke_offset, known)
    top = length_formulas.top_dead_centre_angle if e > 0 else length_formulas.top_dead_centre_angle_before
    yield named_step(top, known)
    yield named_step(length_formulas.bottom_dead_centre_angle, known)


def _speed(solved: Solved) -> Iterator[Step]:
    n = solved.machine.speed * 30 / math.pi
    yield worked_step(forces.angular_speed, solved.method.pi, n)
    yield worked_step(mean_piston_speed, float(solved.lengths.stroke), n)


def _masses(machine: Machine) -> Iterator[Step]:
    masses = machine.masses
    if masses is not None:
        yield worked_step(mass_formulas.reciprocating_mass, masses.piston, masses.rod_small_end)
        yield worked_step(mass_formulas.rotating_mass, masses.crank, masses.rod_big_end)


def _gas(solved: Solved) -> Iterator[AnyStep]:
    """Yield areas and volumes of the cylinder, and both ends of each polytrope of the indicator diagram."""
    cylinder, space = solved.machine.cylinder, solved.space
    if cylinder is None:
        return
    yield worked_step(gas_formulas.piston_area, solved.method.pi, cylinder.bore)
    if space is None:
        return
    yield worked_step(gas_formulas.swept_volume, space.area, float(solved.lengths.stroke))
    if cylinder.clearance_volume is None and cylinder.compression_ratio is not None:
        yield worked_step(gas_formulas.clearance_volume, space.swept, cylinder.compression_ratio)
    yield worked_step(gas_formulas.compression_ratio, space.swept, space.clearance)
    for piece in _pieces(solved):
        for name in (piece.points[0], piece.points[-1]):
            if name != (piece.reference or piece.points[0]):
                yield from _polytrope_end(solved, name, piece.points[-1])


def _polytrope_end(solved: Solved, name: str, end: str) -> Iterator[AnyStep]:
    """Yield volume and pressure of the polytrope that ends at `end`, at one of its points."""
    if solved.space is None:
        return
    named = solved.space.diagram.named
    segment = next((one for one in _polytropes(solved) if abs(one.end - named[end][0]) < 1e-9), None)
    if segment is None:
        return
    start = next((one for one in _pieces(solved) if one.points[-1] == end), None)
    origin = (start.reference or start.points[0]) if start else ""
    x = EngineMoment.at(solved, named[name][0]).known["piston_displacement"]
    volume = worked_step(
        gas_formulas.cylinder_volume, solved.space.clearance, solved.space.area, x, key=f"cylinder_volume.{name}"
    )
    yield volume
    pressure, reference, exponent = segment.state
    found = worked_step(
        gas_formulas.polytropic_pressure, pressure, reference, volume.value, exponent, key=f"diagram_pressure.{name}"
    )
    yield renamed(found, p_1=f"diagram_pressure.{origin}", V_1=f"cylinder_volume.{origin}", V=volume.key)


def _pieces(solved: Solved) -> list[Piece]:
    """Return the polytropes of a diagram that was given by its points."""
    gas = solved.machine.gas
    return [one for one in gas.pieces if one.law == "polytropic"] if gas and gas.measured is None else []


def _polytropes(solved: Solved) -> tuple[Segment, ...]:
    segments = solved.space.diagram.segments if solved.space else ()
    return tuple(one for one in segments if one.law == "polytropic")


def _power(solved: Solved, summary: Mapping[str, float]) -> Iterator[AnyStep]:
    """Yield mean pressure, power and mean torque of the indicated work.

    The mean of the crank torque does the indicated work exactly where the motion is exact and steady. Else that mean
    is an integral of the results, and `mean_torque.indicated` is the torque that would do the work, for comparison.
    """
    if solved.space is None:
        return
    work, cycle = summary["indicated_work"], math.radians(solved.machine.cycle)
    yield Given("indicated_work", work)
    yield worked_step(gas_formulas.indicated_mean_pressure, work, solved.space.swept)
    yield worked_step(gas_formulas.indicated_power, work, solved.speed, cycle)
    if solved.method.is_exact and not solved.machine.angular_acceleration and summary["mean_torque"]:
        yield worked_step(gas_formulas.mean_torque, work, cycle)
    else:
        yield Given("mean_torque", summary["mean_torque"])
        yield worked_step(gas_formulas.mean_torque, work, cycle, key="mean_torque.indicated")
