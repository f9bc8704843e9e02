"""Loads on the main journals.

The shaft is taken as throws simply supported at two main journals each, so that statics alone shares the forces.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from crankwork.cylinders.bearings import check_one_load_per_cylinder
from crankwork.cylinders.counterweights import Unbalance
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.load_vectors import BearingLoad, turned_by
from crankwork.errors import CrankworkError
from crankwork.expressions import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid


@formula("unbalance_force", "kolchin_demidov_2008, ch. 7")
def unbalance_force(Q_u: Value, w: Value) -> Value:
    """Centrifugal force of a mass on the crankshaft.

    Parameters
    ----------
    Q_u, w : array
        Mass times distance of its centre from the axis of rotation, angular speed. [kg m], [rad/s]

    Returns
    -------
    array
        Force away from the axis. [N]
    """
    return Q_u * w**2


@formula("journal_share", "kolchin_demidov_2008, ch. 7")
def journal_share(z_b: Value, z_left: Value, z_right: Value) -> Value:
    """Share of a force on a throw that its further journal carries; the nearer one carries the rest.

    Parameters
    ----------
    z_b, z_left, z_right : array
        Positions of the force and of the two journals along the shaft. [m], [m], [m]

    Returns
    -------
    array
        Share, one half in the middle. [-]
    """
    return (z_b - z_left) / (z_right - z_left)


def main_journal_loads(
    layout: Layout, loads: Sequence[BearingLoad], unbalances: Sequence[Unbalance], speed: float
) -> tuple[BearingLoad, ...]:
    """Return the force of every main bearing on its journal, in the shaft frame.

    Parameters
    ----------
    layout : Layout
        Cylinders and main journals.
    loads : sequence of BearingLoad of array, shape (n,)
        Force of each rod on its crankpin in the frame of its own crank, by cylinder, at the same instants. [N]
    unbalances : sequence of Unbalance
        Masses of the throws and counterweights; beyond the outermost journals they overhang the end throw. The rod
        masses at the crankpins are in the loads already.
    speed : float
        Angular speed. [rad/s]

    Returns
    -------
    tuple of BearingLoad of array, shape (n,)
        By journal, in the frame of the crank of cylinder 1; `turned_by` its direction gives the block frame. [N]

    Raises
    ------
    CrankworkError
        If loads, cylinders and journals do not belong together.

    References
    ----------
    kolchin_demidov_2008, ch. 7.

    Notes
    -----
    Minus the sum of what the throws on both sides of the journal hand on, each by its lever. With every force in
    the middle of its throw it is minus one half of the vector sum of the two throws.
    """
    check_one_load_per_cylinder(layout, loads)
    _check_journals(layout)
    journals, places = layout.journal_positions, layout.places
    along = np.array([place.position for place in places] + [one.position for one in unbalances])
    spans = np.array(
        [place.throw for place in places] + [_span(one.position, journals) for one in unbalances], dtype=int
    )
    forces = [turned_by(load, place.pin_angle) for place, load in zip(places, loads, strict=True)]
    forces += [_centrifugal(one, speed) for one in unbalances]
    shares = -journal_shares(along, spans, journals)
    x, y = (np.stack(np.broadcast_arrays(*parts)) for parts in zip(*forces, strict=True))
    return tuple(map(BearingLoad, shares @ x, shares @ y))


def journal_shares(along: ArrayLike, spans: ArrayLike, journals: Sequence[float]) -> Array:
    """Return which share of each force each main journal carries.

    Parameters
    ----------
    along : array, shape (forces,)
        Where the forces act along the shaft. [m]
    spans : array of int, shape (forces,)
        On which throw each acts, from 0. [-]
    journals : sequence of float, shape (journals,)
        Main journals along the shaft, ascending. [m]

    Returns
    -------
    array, shape (journals, forces)
        Shares; those of one force add up to 1. [-]
    """
    along, spans, position = np.asarray(along), np.asarray(spans), np.asarray(journals)
    far = journal_share(along, position[spans], position[spans + 1])
    shares, every = np.zeros((position.size, along.size)), np.arange(along.size)
    shares[spans, every] = 1 - far
    shares[spans + 1, every] = far
    return shares


def _span(position: float, journals: Sequence[float]) -> int:
    """Return the throw on which a position lies, the first or last one for what overhangs."""
    return int(np.clip(np.searchsorted(journals, position, side="right") - 1, 0, len(journals) - 2))


def _centrifugal(one: Unbalance, speed: float) -> BearingLoad:
    force, grid = unbalance_force(one.mass_moment, speed), CrankGrid.from_degrees(one.angle)
    return BearingLoad(np.atleast_1d(force * grid.cos), np.atleast_1d(force * grid.sin))


def _check_journals(layout: Layout) -> None:
    """Raise unless every throw lies between two main journals with its cylinders."""
    journals, throws = layout.journal_positions, max(place.throw for place in layout.places) + 1
    if len(journals) != throws + 1:
        raise CrankworkError(
            f"{throws} throws need {throws + 1} main journals, and {len(journals)} are given; "
            "give the position of one more journal than throws"
        )
    if any(left >= right for left, right in pairwise(journals)):
        raise CrankworkError("main journals must be given one after the other, with ascending positions")
    for place in layout.places:
        left, right = journals[place.throw], journals[place.throw + 1]
        if not left <= place.position <= right:
            raise CrankworkError(
                f"cylinder {place.number} stands at {place.position * 1e3:g} mm, outside the journals of its throw "
                f"({left * 1e3:g} to {right * 1e3:g} mm); move the cylinder or the journals"
            )
