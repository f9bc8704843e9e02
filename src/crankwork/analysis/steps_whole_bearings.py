"""Worked steps of the bearings of an engine: at one crank angle, and what the loads come to over the cycle."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.results import Results
from crankwork.formula.known import Given
from crankwork.formula.lines import Moment
from crankwork.formula.steps import AnyStep
from crankwork.kinematics.crank_grid import CrankGrid

_AT_ONCE = (
    "big_end_inertia_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "big_end_load",
    "weight_force.piston", "transverse_weight.piston", "piston_pin_force", "side_force.small_end", "small_end_load",
    "shaft_unbalance", "unbalance_force", "journal_share", "bearing_force_x", "bearing_force_y", "main_journal_load",
)  # fmt: skip
_OVER_CYCLE = (
    "mean_bearing_load", "bearing_load_max", "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max",
    "mean_crankpin_load", "reversal_duration", "reversal_ratio",
)  # fmt: skip


def bearing_steps(results: Results, degrees: float) -> Iterator[AnyStep]:
    """Yield the loads of crankpins, big end, small end and main journals at a crank angle.

    Parameters
    ----------
    results : Results
        Of an engine.
    degrees : float
        Crank angle of cylinder 1. [deg]
    """
    yield from _of_kinds(results, _AT_ONCE, Moment(CrankGrid.from_degrees, degrees))


def load_steps(results: Results) -> Iterator[AnyStep]:
    """Yield what the bearing loads come to: mean and largest over the bearing's area, and their ratio.

    Parameters
    ----------
    results : Results
        Of an engine with bearing loads.
    """
    yield from _of_kinds(results, _OVER_CYCLE, Moment(CrankGrid.from_degrees, 0.0))


def _of_kinds(results: Results, kinds: tuple[str, ...], moment: Moment) -> Iterator[AnyStep]:
    for kind in kinds:
        for key, known in results.memory.items():
            if (key == kind or key.startswith(f"{kind}.")) and not isinstance(known.node, Given):
                yield moment.step(known)
