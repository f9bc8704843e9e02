"""Worked steps of the torques on the crank of a linkage, and of the efficiency of a chain of joints."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.linkage import SolvedLinkage
from crankwork.analysis.results import Results
from crankwork.dynamics import reduction
from crankwork.dynamics.efficiency import (
    Chain,
    Parallel,
    Series,
    driving_torque_as_brake,
    driving_torque_as_motor,
)
from crankwork.dynamics.force_parts import balancing_torque_of_parts, efficiency_share
from crankwork.steps import AnyStep, Given, Step, product_step, sum_step, worked_step


def torque_steps(results: Results, row: int) -> Iterator[Step]:
    """Yield static, dynamic, balancing and driving torque of a linkage.

    Parameters
    ----------
    results : Results
        Of a linkage with bodies, loads or a drive that has inertia.
    row : int
        Row of the columns.
    """
    solved: SolvedLinkage = results.solved
    machine, speed = solved.machine, solved.speed
    at = {key: float(column[row]) for key, column in results.columns.items()}
    if machine.loads:
        yield worked_step(reduction.static_torque, -at["static_torque"])
    if machine.angular_acceleration:
        yield worked_step(
            reduction.dynamic_torque, speed, at["reduced_inertia_1"], at["reduced_inertia"],
            machine.angular_acceleration,
        )  # fmt: skip
    else:
        yield worked_step(reduction.dynamic_torque_steady, speed, at["reduced_inertia_1"])
    yield from sum_and_drive(at["static_torque"], at["dynamic_torque"], machine.drive.efficiency)


def sum_and_drive(static: float, dynamic: float, chain_efficiency: float) -> Iterator[Step]:
    """Yield the sum of two torques and the torque of the motor, which drives or brakes.

    Parameters
    ----------
    static, dynamic : float
        Static and dynamic torque. [N m]
    chain_efficiency : float
        From motor to crank. [-]
    """
    whole = worked_step(balancing_torque_of_parts, static, dynamic)
    yield whole
    drive = driving_torque_as_motor if whole.value > 0 else driving_torque_as_brake
    yield worked_step(drive, static, dynamic, chain_efficiency)


def efficiency_steps(chain: Chain, key: str = "efficiency") -> AnyStep:
    """Return the efficiency of a chain of joints as products of what is in series and sums of what is parallel.

    Parameters
    ----------
    chain : float, Series or Parallel
        Efficiencies of joints. [-]
    key : str
        Key of the value; the parts are `key.1`, `key.2` and so on.

    Examples
    --------
    >>> round(efficiency_steps(Series((0.98, Parallel((0.9, 0.8)), 0.99))).value, 5)
    0.82467
    """
    match chain:
        case Series(parts):
            return product_step(key, [efficiency_steps(part, f"{key}.{i}") for i, part in enumerate(parts, start=1)])
        case Parallel(parts, shares):
            shares = shares or (1 / len(parts),) * len(parts)
            terms: list[AnyStep] = []
            for i, (share, part) in enumerate(zip(shares, parts, strict=True), start=1):
                inner = efficiency_steps(part, f"{key}.{i}.whole")
                terms += [worked_step(efficiency_share, share, inner.value, key=f"{key}.{i}")]
            return sum_step(key, terms)
        case value:
            return Given(key, float(value))
