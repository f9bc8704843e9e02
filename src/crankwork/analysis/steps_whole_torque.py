"""Worked steps of the torque of an engine: every cylinder, the sum, along the shaft, and through an articulated rod."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.cylinders import WholeEngine
from crankwork.analysis.results import Results
from crankwork.cylinders.torque import cylinder_angle
from crankwork.formula.lines import Moment
from crankwork.formula.steps import AnyStep, Step
from crankwork.kinematics.crank_grid import CrankGrid


def torque_steps(results: Results, whole: WholeEngine, degrees: float) -> Iterator[AnyStep]:
    """Yield the torque of every cylinder, their sum, and the torques on main journals and crankpins.

    Parameters
    ----------
    results : Results
        Of an engine.
    whole : WholeEngine
        Its cylinders.
    degrees : float
        Crank angle of cylinder 1. [deg]
    """
    moment, memory = Moment(CrankGrid.from_degrees, degrees), results.memory
    for number, one in enumerate(whole.cylinders, start=1) if len(whole.cylinders) > 1 else ():
        yield _numbered(_here(whole, degrees, number).step(one.memory["crank_torque"]), number)
    for kind in ("throw_torque.", "total_torque", "crankpin_torque.", "journal_torque."):
        for key in [key for key in memory if key == kind or (key.startswith(kind) and kind.endswith("."))]:
            yield moment.step(memory[key])


def _here(whole: WholeEngine, degrees: float, number: int) -> Moment:
    """Return the crank angle of a cylinder of its own."""
    place = whole.layout.places[number - 1]
    return Moment(CrankGrid.from_degrees, float(cylinder_angle([degrees], place, whole.layout.cycle)[0]))


def articulated_steps(whole: WholeEngine, degrees: float) -> Iterator[AnyStep]:
    """Yield motion and forces of the first articulated rod, and what it adds to those of the master rod.

    Parameters
    ----------
    whole : WholeEngine
        The engine; nothing where no rod is articulated.
    degrees : float
        Crank angle of cylinder 1. [deg]
    """
    number = next((at for at, rod in enumerate(whole.engine.slaves, start=1) if rod is not None), 0)
    if not number:
        return
    own = whole.cylinders[number - 1].memory
    for step in _here(whole, degrees, number).steps(own[key] for key in _OF_SLAVE if key in own):
        yield _numbered(step, number)


_OF_SLAVE = (
    "piston_displacement", "piston_velocity", "piston_acceleration", "gas_force", "inertia_force", "piston_force",
    "side_force", "rod_force", "knuckle_couple", "knuckle_side_force",
)  # fmt: skip


def _numbered(step: AnyStep, number: int) -> AnyStep:
    """Return a line under the name of a cylinder."""
    if isinstance(step, Step) and step.named:
        step = step._replace(named=tuple((name, f"{key}.{number}") for name, key in step.named))
    return step._replace(key=f"{step.key}.{number}")
