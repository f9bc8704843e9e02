"""Comparison of results: with those of the same machine by other methods, or of another machine."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from crankwork.analysis.results import Results
from crankwork.analysis.rounding_noise import summary_without_rounding
from crankwork.errors import CrankworkError
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.quantities.key import key_of

# kinds of columns that are compared if two results have both
_MOTION = (
    "piston_displacement", "piston_velocity", "piston_acceleration", "slider_displacement", "slider_velocity",
    "slider_acceleration", "link_angle", "link_angular_velocity", "link_angular_acceleration",
)  # fmt: skip
_FORCES = (
    "piston_force", "side_force", "tangential_force", "crank_torque", "total_torque", "static_torque",
    "balancing_torque", "driving_torque", "driver_force", "driver_torque", "turning_moment", "load_torque",
    "excess_torque", "kinetic_energy_change",
)  # fmt: skip
# relative difference of values that is rounding
_TOLERANCE = 1e-12


class Comparison(NamedTuple):
    """Results to compare with: names, that of the results first, and other results in the same order."""

    names: tuple[str, ...]
    others: tuple[Results, ...]
    keys: tuple[str, ...]  # Columns that all have, under which names and differences are found
    trace: Mapping[str, TracedValue]
    columns: Mapping[str, Array]  # At the crank angles of the results [SI]
    is_of_methods: bool  # Whether one machine is compared by its methods, which are the names

    def columns_at(self, degrees: Array) -> dict[str, Array]:
        """Return the compared columns at crank angles [deg]; NaN at angles that a machine does not reach."""
        return _played(self.trace, CrankGrid.from_degrees(degrees))

    def values(self, results: Results) -> dict[str, tuple[float, ...]]:
        """Return single values by key, of all results in the order of the names, NaN for a missing one. [SI]

        Of methods, those in which they differ.
        """
        each = [summary_without_rounding(other) for other in (results, *self.others)]
        keys = dict.fromkeys(key for item in each for key in item)
        values = {key: tuple(item.get(key, math.nan) for item in each) for key in keys}
        return {key: value for key, value in values.items() if not self.is_of_methods or _differ(value)}


def comparison_key(key: str, name: str) -> str:
    """Return the key of a column of the results of a name."""
    return f"{key}.{name}"


def difference_key(key: str, name: str) -> str:
    """Return the key of the difference of the column of a name from that of the results."""
    return f"{key_of(key).derived('_difference')}.{name}"


def compare(results: Results, others: Mapping[str, Results], name: str = "") -> Results:
    """Return results with others beside them.

    Parameters
    ----------
    results : Results
        What is compared.
    others : mapping of str to Results
        What it is compared with, by name: another method, or another machine.
    name : str
        What the results are called among other machines; left out where the others are other methods.

    Returns
    -------
    Results
        The same results, which tables, summary, figures and notes then show beside the others.

    Raises
    ------
    CrankworkError
        If the others have nothing in common with them, or one has their name.

    Examples
    --------
    >>> import crankwork
    >>> machine = crankwork.read_machine(crankwork.template("slider-crank"))
    >>> textbook = crankwork.analyse(crankwork.with_method(machine, "textbook"))
    >>> both = crankwork.compare(crankwork.analyse(machine), {"textbook": textbook})
    >>> both.compared.names, both.compared.keys[:2]
    (('exact', 'textbook'), ('piston_displacement', 'piston_velocity'))
    """
    own = name or results.method.name
    if own in others:
        raise CrankworkError(ErrorMessage("compare_own", method=own))
    all_results = (results, *others.values())
    keys = tuple(_common(all_results)) if _share_abscissa(all_results) else ()
    trace: dict[str, TracedValue] = {}
    for key in keys:
        mine = results.trace[key].named(comparison_key(key, own))
        trace[comparison_key(key, own)] = mine
        for other, value in others.items():
            its = value.trace[key].named(comparison_key(key, other))
            trace[comparison_key(key, other)] = its
            trace[difference_key(key, other)] = (its - mine).named(difference_key(key, other))
    if not keys and not any(other.summary.keys() & results.summary.keys() for other in others.values()):
        raise CrankworkError(ErrorMessage("compare_nothing"))
    columns = _played(trace, results.grid)
    compared = Comparison((own, *others), tuple(others.values()), keys, trace, columns, is_of_methods=not name)
    return replace(results, compared=compared)


def _common(all_results: tuple[Results, ...]) -> Iterator[str]:
    """Yield the keys of columns that all results have."""
    # a cycle of one turn has no forces of a second one
    kinds = (*_MOTION, *_FORCES) if len({item.machine.cycle for item in all_results}) == 1 else _MOTION
    for kind in kinds:
        for key in all_results[0].columns:
            if key_of(key).quantity == kind and all(key in item.columns and key in item.trace for item in all_results):
                yield key


def _share_abscissa(all_results: tuple[Results, ...]) -> bool:
    """Return whether columns of all results are given at angles, or times, with the same meaning."""
    return len({item.period for item in all_results}) == 1 and not any(item.has_positions for item in all_results)


def _played(trace: Mapping[str, TracedValue], grid: CrankGrid) -> dict[str, Array]:
    with warnings.catch_warnings():
        # at an angle that a crank does not reach
        warnings.simplefilter("ignore", RuntimeWarning)
        return Program(trace)(grid) if trace else {}


def _differ(values: tuple[float, ...]) -> bool:
    size = max(abs(value) for value in values)
    return not max(values) - min(values) <= _TOLERANCE * size
