"""What the masses of an engine leave unbalanced, order by order, before and after counterweights and balance shafts."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.analysis.cylinders import WholeEngine
from crankwork.analysis.engine_bearings import counterweights, rotating_masses
from crankwork.analysis.results import Listing
from crankwork.cylinders.balance import (
    ORDERS,
    InertiaHarmonics,
    free_forces,
    inertia_harmonics,
    sampled_harmonics,
)
from crankwork.cylinders.balance_shafts import ShaftWeight, balance_shafts, shaft_forces
from crankwork.cylinders.counterweights import Unbalance, rotating_unbalances, turning_forces
from crankwork.cylinders.ellipse import OrderBalance, balance_sum, unit_vectors
from crankwork.kinematics.crank_grid import CrankGrid

_SAMPLES = 720


class EngineBalance(NamedTuple):
    """Free forces and moments [N], [N m].

    Parameters
    ----------
    reciprocating : tuple of OrderBalance
        Of the reciprocating masses, by order.
    rotating, counterweights : OrderBalance
        Of the rotating masses and of the counterweights, both of the first order.
    shafts : tuple of OrderBalance
        Of the balance shafts.
    residual : tuple of OrderBalance
        All together.
    weights, shaft_weights : tuple
        The counterweights and the weights of the balance shafts.
    """

    reciprocating: tuple[OrderBalance, ...]
    rotating: OrderBalance
    counterweights: OrderBalance
    shafts: tuple[OrderBalance, ...]
    residual: tuple[OrderBalance, ...]
    weights: tuple[Unbalance, ...]
    shaft_weights: tuple[ShaftWeight, ...]


def engine_balance(whole: WholeEngine) -> EngineBalance:
    """Return what the masses of an engine leave free.

    Parameters
    ----------
    whole : WholeEngine
        The engine.

    References
    ----------
    den_hartog_1956, ch. 5; taylor_1985, vol. 2, ch. 8.
    """
    layout, masses, w = whole.layout, whole.masses, whole.master.speed
    r = whole.master.lengths.crank_radius
    reciprocating = free_forces(layout, masses.reciprocating, r, w, _harmonics(whole))
    turning = rotating_unbalances(layout, rotating_masses(whole), r)
    weights = counterweights(whole, layout)
    rotating, balanced = turning_forces(layout, turning, w), turning_forces(layout, weights, w)
    before = balance_sum((*reciprocating, rotating, balanced))
    shaft_weights = tuple(
        weight
        for part in before
        if part.order in whole.engine.balance_shafts
        for weight in balance_shafts(part, w, _planes(whole, part))
    )
    shafts = shaft_forces(shaft_weights, w)
    return EngineBalance(
        reciprocating, rotating, balanced, shafts, balance_sum((*before, *shafts)), weights, shaft_weights
    )


def _harmonics(whole: WholeEngine) -> InertiaHarmonics:
    """Return the orders of the piston acceleration, of each cylinder where some rods are articulated."""
    lengths, method = whole.master.lengths, whole.master.method
    if not any(whole.engine.slaves):
        ratio = method.inertia_rod_ratio
        if ratio is not None and not method.is_exact:
            lengths = lengths._replace(rod_length=lengths.crank_radius / ratio)
        return inertia_harmonics(lengths, ORDERS, method)
    turn = CrankGrid.from_degrees(np.arange(_SAMPLES) * 360 / _SAMPLES)
    rows = [one.motion(turn).piston.position_2 for one in whole.cylinders]
    return sampled_harmonics(np.stack(rows), lengths.crank_radius, ORDERS)


def _planes(whole: WholeEngine, part: OrderBalance) -> tuple[float] | tuple[float, float]:
    """Return where the weights of a pair of shafts stand: in the middle, or at the outermost cylinders for a moment."""
    positions = [one.position for one in whole.layout.places]
    first, last = min(positions), max(positions)
    return (0.0,) if first == last or not part.moment.largest else (first, last)


def balance_listing(whole: WholeEngine, balance: EngineBalance) -> Listing:
    """Return forces and moments by order: of each kind of mass, and what is left.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    balance : EngineBalance
        What is free.
    """
    rows = [(f"reciprocating.{one.order}", one) for one in balance.reciprocating]
    rows += [("rotating", balance.rotating)]
    if balance.weights:
        rows += [("counterweights", balance.counterweights)]
    rows += [(f"balance_shafts.{one.order}", one) for one in balance.shafts]
    if balance.weights or balance.shafts or balance.rotating.force.largest or balance.rotating.moment.largest:
        rows += [(f"residual.{one.order}", one) for one in balance.residual]
    columns = {
        "free_force": [one.force.largest for _, one in rows],
        "free_force_min": [one.force.least for _, one in rows],
        "free_force_direction": [np.radians(one.force.direction) for _, one in rows],
    }
    positions = {one.position for one in whole.layout.places}
    if len(positions) > 1:
        columns |= {
            "free_moment": [one.moment.largest for _, one in rows],
            "free_moment_min": [one.moment.least for _, one in rows],
        }
    return Listing({key: np.array(values) for key, values in columns.items()}, tuple(name for name, _ in rows))


def balance_checks(whole: WholeEngine, balance: EngineBalance) -> dict[str, float]:
    """Return how far the orders are from the Fourier transform of the summed inertia forces.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    balance : EngineBalance
        What is free.
    """
    if whole.machine.masses is None or whole.machine.angular_acceleration:
        return {}
    degrees = np.arange(_SAMPLES) * 360 / _SAMPLES
    force = whole.each("inertia_force", degrees)
    # the inertia force is positive towards the crankshaft, the axis points to the head
    vectors = -force.T @ unit_vectors([one.axis for one in whole.layout.places])
    spectrum = np.fft.fft(vectors) / _SAMPLES
    scale = float(np.max(np.abs(force))) or 1.0
    # crank angles count from the axis of cylinder 1, which is where the phasors begin as well
    apart = [
        max(abs(spectrum[one.order] - one.force.forward), abs(spectrum[-one.order] - one.force.backward))
        for one in balance.reciprocating
    ]
    return {"free_forces": float(max(apart)) / scale}
