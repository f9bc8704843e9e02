"""Which figures of a machine there could be and are not, and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from crankwork.analysis import Results
from crankwork.locale import say
from crankwork.mechanism.driver import Cylinder, LinkMotor
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import label
from crankwork.report.tables import any_nonzero

_DRAWN = ("reduced_inertia", "static_torque", "dynamic_torque", "driving_torque", "joint_force")


def not_drawn(results: Results, language: Language) -> Iterator[str]:
    """Yield sentences about figures that are left out."""
    names = list(dict.fromkeys(label(kind, language) for kind in _zero(results)))
    if names:
        yield say("report.not_drawn_zero", language, names=", ".join(names))
    if results.machine.linkage is not None and _has_no_groups(results):
        yield say("report.no_force_plans", language)


def _zero(results: Results) -> Iterator[str]:
    """Yield the quantities that figures are of and that are zero throughout."""
    for kind in _DRAWN:
        keys: Iterable[str] = [key for key in results.columns if key.partition(".")[0] == kind and kind in QUANTITIES]
        if keys and not any_nonzero(keys, results.columns):
            yield kind


def _has_no_groups(results: Results) -> bool:
    """Return whether there are joint forces, but a driver within a group, so that none is apart from it."""
    has_forces = any(key.startswith("joint_force.") for key in results.columns)
    return has_forces and isinstance(results.machine.mechanism.driver, Cylinder | LinkMotor)
