"""Loads on the main journals.

The shaft is taken as throws simply supported at two main journals each, so that statics alone shares the forces.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from crankwork.cylinders.articulated import sine_and_cosine
from crankwork.cylinders.counterweights import Unbalance
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.cylinders.load_vectors import BearingLoad, rotated, rotated_by
from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import given, is_traced, named, sum_terms
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import ErrorMessage


@formula("unbalance_force", "kolchin_demidov_2008, ch. 7")
def unbalance_force(Q_u: Value, w: Value) -> Value:
    """Centrifugal force of a mass on the crankshaft."""
    return Q_u * w**2


@formula("unbalance_weight", "artobolevsky_1988, ch. 13")
def unbalance_weight(  # noqa: PLR0913 - one argument per symbol
    Q_u: Value, r: Value, g: Value, cos_phi: Value, cos_theta: Value, sin_phi: Value, sin_theta: Value
) -> Value:
    """Weight of a mass on the crankshaft at the crank radius, along its arm away from the crankshaft."""
    return -Q_u / r * g * (cos_phi * cos_theta - sin_phi * sin_theta)


@formula("unbalance_tangential_force", "artobolevsky_1988, ch. 13")
def unbalance_tangential_force(  # noqa: PLR0913 - one argument per symbol
    Q_u: Value, r: Value, g: Value, sin_phi: Value, cos_theta: Value, cos_phi: Value, sin_theta: Value, eps: Value
) -> Value:
    """Weight of a mass on the crankshaft across its arm, less what its angular acceleration takes."""
    return Q_u / r * g * (sin_phi * cos_theta + cos_phi * sin_theta) - Q_u * eps


@formula("journal_share", "kolchin_demidov_2008, ch. 7")
def journal_share(z_b: Value, z_left: Value, z_right: Value) -> Value:
    """Share of a force on a throw that its further journal carries; the nearer one carries the rest."""
    return (z_b - z_left) / (z_right - z_left)


def main_journal_loads(
    layout: Layout, loads: Sequence[BearingLoad], unbalances: Sequence[Unbalance], speed: Value
) -> tuple[BearingLoad, ...]:
    """Return the force of every main bearing on its journal, in the frame of the crank of cylinder 1. [N]

    `loads` are the forces of each rod on its crankpin in the frame of its own crank, at the same instants, with the rod
    masses in them; `unbalances` beyond the outermost journals overhang the end throw. `rotated_by` gives the block
    frame.

    Minus the sum of the shares of the throws on both sides of the journal, each by its lever. With every force in
    the middle of its throw it is minus one half of the vector sum of the two throws (kolchin_demidov_2008, ch. 7).
    """
    if len(loads) != len(layout.places):
        raise CrankworkError(
            f"{len(loads)} loads are given for {len(layout.places)} cylinders; give one load per cylinder"
        )
    check_journals(layout)
    journals, places = layout.journal_positions, layout.places
    acting = [
        _Acting(_in_shaft(load, place).named(str(place.number)), place.position, place.throw, str(place.number))
        for place, load in zip(places, loads, strict=True)
    ]
    acting += [
        _Acting(_of_mass(unbalance, speed), unbalance.position, _span(unbalance.position, journals), unbalance.name)
        for unbalance in unbalances
    ]
    held: list[list[BearingLoad]] = [[] for _ in journals]
    for force in acting:
        far = _far_share(force, journals[force.throw : force.throw + 2])
        for journal, share in ((force.throw, 1 - far), (force.throw + 1, far)):
            minus = -share
            part = BearingLoad(minus * force.load.x, minus * force.load.y)
            held[journal].append(part.named(f"main_journal.{journal + 1}.{force.name}"))
    return tuple(_sum(parts, f"main_journal.{number}") for number, parts in enumerate(held, start=1))


def _in_shaft(load: BearingLoad, place: CylinderPlace) -> BearingLoad:
    """Return a load on a crankpin in the frame of the shaft, with a traced angle if the load is traced."""
    if not is_traced(load.x):
        return rotated_by(load, place.pin_angle)
    pin = place.crankpin + 1
    angle = given(f"crankpin_angle.{pin}", math.radians(place.pin_angle), "engine.layout")
    return rotated(load, *sine_and_cosine(place.pin_angle, angle, (f"crankpin_sine.{pin}", f"crankpin_cosine.{pin}")))


class _Acting(NamedTuple):
    """A force on the shaft in its frame, with its position along the shaft, throw and name."""

    load: BearingLoad
    position: float
    throw: int
    name: str


def _far_share(force: _Acting, ends: Sequence[float]) -> Value:
    """Return the share of the further journal of a throw, traced if the force is."""
    if not is_traced(*force.load):
        return journal_share(force.position, *ends)
    names = (force.name, *(f"main_journal.{force.throw + offset}" for offset in (1, 2)))
    places = zip(names, (force.position, *ends), strict=True)
    stated = (given(f"shaft_position.{name}", position, "engine.spacing") for name, position in places)
    return named(journal_share(*stated), f"journal_share.{force.name}")


def _sum(loads: Sequence[BearingLoad], owner: str) -> BearingLoad:
    x = sum_terms(f"bearing_force_x.{owner}", [load.x for load in loads])
    return BearingLoad(x, sum_terms(f"bearing_force_y.{owner}", [load.y for load in loads]))


def _span(position: float, journals: Sequence[float]) -> int:
    """Return the throw at a position, the first or the last one for overhanging positions."""
    return min(max(bisect_right(journals, position) - 1, 0), len(journals) - 2)


def _of_mass(unbalance: Unbalance, speed: Value) -> BearingLoad:
    """Return the force of a mass on the shaft in the frame of the shaft."""
    grid = CrankGrid.from_degrees(unbalance.angle)
    force = named(unbalance_force(unbalance.mass_moment, speed), f"unbalance_force.{unbalance.name}")
    if unbalance.held is not None:
        return rotated_by(BearingLoad(force + unbalance.held.x, unbalance.held.y), unbalance.angle).named(
            unbalance.name
        )
    return BearingLoad(force * float(grid.cos), force * float(grid.sin)).named(unbalance.name)


def check_journals(layout: Layout) -> None:
    """Raise unless every throw lies between two main journals with its cylinders."""
    journals, throws = layout.journal_positions, max(place.throw for place in layout.places) + 1
    if len(journals) != throws + 1:
        raise CrankworkError(ErrorMessage("journals_count", throws=throws, needed=throws + 1, given=len(journals)))
    if any(left >= right for left, right in pairwise(journals)):
        raise CrankworkError(ErrorMessage("journals_rise"))
    for place in layout.places:
        left, right = journals[place.throw], journals[place.throw + 1]
        if not left <= place.position <= right:
            raise CrankworkError(
                ErrorMessage(
                    "cylinder_outside",
                    number=place.number,
                    position=place.position * 1e3,
                    left=left * 1e3,
                    right=right * 1e3,
                )
            )
