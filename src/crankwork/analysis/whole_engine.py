"""From the results of one cylinder to those of the whole engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from crankwork.analysis.cylinders import WholeEngine, torque_curves, whole_engine
from crankwork.analysis.engine_balance import balance_checks, balance_listing, engine_balance
from crankwork.analysis.engine_bearings import (
    bearing_columns,
    bearing_listings,
    bearing_loads,
    bearing_summary,
    dense_loads,
)
from crankwork.analysis.engine_torque import (
    engine_torque,
    torque_checks,
    torque_columns,
    torque_listings,
    torque_summary,
)
from crankwork.analysis.results import Listing, Results
from crankwork.analysis.solved import Notice

_TABLES = {
    "engine_torque": ("crank_torque.", "total_torque"),
    "accumulated_torque": ("journal_torque.", "crankpin_torque."),
    "bearings": ("crankpin_", "big_end_load", "small_end_load"),
    "main_journals": ("main_journal_load.",),
    "speed": ("kinetic_energy_change", "crank_speed"),
}


def with_whole_engine(results: Results) -> Results:
    """Return the results of cylinder 1 with those of the engine it belongs to.

    Parameters
    ----------
    results : Results
        Of a machine with an engine.

    Returns
    -------
    Results
        Every column and single value of cylinder 1 as it was, and those of the engine.

    Raises
    ------
    CrankworkError
        If an articulated rod cannot be assembled all round.
    """
    whole = whole_engine(results.solved)
    notices = [Notice(*one) for one in whole.engine.notices]
    if any(whole.engine.slaves) and whole.masses.rod_inertia_excess:
        notices.append(Notice("articulated_two_mass", {}))
    if any(whole.engine.slaves) and whole.masses.rod_big_end:
        notices.append(Notice("articulated_big_ends", {}))
    if len({one.position for one in whole.layout.places}) == 1 < len({one.throw for one in whole.layout.places}):
        notices.append(Notice("no_spacing", {}))
    if "crank_torque" not in results.columns:
        notices.append(Notice("motion_only", {}))
        return replace(results, notices=(*results.notices, *notices))
    torque, told = engine_torque(whole, *torque_curves(whole))
    degrees, loads = dense_loads(whole)
    balance = engine_balance(whole)
    found = torque_columns(whole, torque, results.grid.degrees)
    found |= bearing_columns(bearing_loads(whole, results.grid.degrees))
    groups = {
        name: tuple(key for key in found if key.startswith(starts) and _belongs(name, key))
        for name, starts in _TABLES.items()
    }
    listings: dict[str, Listing] = torque_listings(whole, torque) | bearing_listings(whole, degrees, loads)
    if whole.machine.masses is not None:
        listings["balance"] = balance_listing(whole, balance)
    summary = _engine_summary(whole) | torque_summary(torque) | bearing_summary(whole, degrees, loads)
    told = (*told, *_torque_against_cycle(results.summary, summary))
    return replace(
        results,
        columns={**results.columns, **found},
        summary={**results.summary, **summary},
        checks={**results.checks, **torque_checks(whole, torque), **balance_checks(whole, balance)},
        notices=(*results.notices, *notices, *told),
        groups={**results.groups, **groups},
        listings={**results.listings, **listings},
    )


def _belongs(table: str, key: str) -> bool:
    """Return whether a key that begins like those of a table is one of them."""
    return table != "bearings" or not key.startswith("crankpin_torque")


def _torque_against_cycle(one: Mapping[str, float], whole: Mapping[str, float]) -> tuple[Notice, ...]:
    """Return how far the mean torque is from that of the calculation of the cycle."""
    if not {"effective_torque", "mechanical_efficiency"} <= set(one):
        return ()
    cycle, mean = one["effective_torque"] / one["mechanical_efficiency"], whole["mean_total_torque"]
    return (Notice("torque_of_cycle", {"torque": mean, "cycle": cycle, "percent": 100 * (mean / cycle - 1)}),)


def _engine_summary(whole: WholeEngine) -> dict[str, float]:
    spaces = [one.space for one in whole.cylinders]
    result = {"cylinder_count": float(len(whole.cylinders))}
    known = [space for space in spaces if space is not None]
    if len(known) == len(spaces):
        result["displacement"] = sum(space.swept for space in known)
    return result
