"""Torque of many cylinders on one shaft: firing intervals, sums, torque along the shaft."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.cylinders.firing import intervals, wrap_angle
from crankwork.cylinders.layout import Layout
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, is_traced, named, sum_terms


@formula("journal_torque", "kolchin_demidov_2008, ch. 9")
def torque_behind_throw(M_j: Value, M_t: Value) -> Value:
    """Torque that a main journal passes on, behind a throw."""
    return M_j + M_t


@formula("crankpin_torque", "kolchin_demidov_2008, ch. 9")
def torque_of_crankpin(M_j: Value, M_t: Value) -> Value:
    """Torque that a crankpin passes on: all that comes before it and half of its own."""
    return M_j + M_t / 2


@formula("mean_total_torque", "kolchin_demidov_2008, ch. 7")
def mean_torque_of_work(i_cyl: Value, W: Value, phi_c: Value) -> Value:
    """Mean torque of all cylinders, from their indicated work."""
    return i_cyl * W / phi_c


@formula("firing_interval", "kolchin_demidov_2008, ch. 7")
def even_firing_interval(phi_c: Value, i_cyl: Value) -> Value:
    """Angle between firings that follow each other evenly, the period of the total torque."""
    return phi_c / i_cyl


class TorquesAlongShaft(NamedTuple):
    """Torques transmitted by the parts of a shaft towards the output end behind the last throw, shape (n,) each. [N m]

    There is one journal more than throws: the first transmits nothing, the last one the total.
    """

    throws: tuple[Value, ...]
    journals: tuple[Value, ...]
    crankpins: tuple[Value, ...]


def torques_along_shaft(torques: Sequence[Value], layout: Layout) -> TorquesAlongShaft:
    """Return the torque on every main journal and crankpin: the accumulated torques of a shaft with a free front end.

    Torques of throws, on journals and on crankpins [N m]. `torques`: torque of each cylinder by number, at the same
    crank angles of cylinder 1 [N m]; `layout`: the cylinders; those of one throw act together, on a common pin or on
    split ones. Source: kolchin_demidov_2008, ch. 9.
    """
    if len(torques) != len(layout.places):
        raise MethodError(f"torques must be one row per cylinder, {len(layout.places)} rows, not {len(torques)}")
    count = max(place.throw for place in layout.places) + 1
    members = [[torques[place.number - 1] for place in layout.places if place.throw == index] for index in range(count)]
    throws = tuple(
        group[0] if len(group) == 1 else sum_terms(f"throw_torque.{index}", group)
        for index, group in enumerate(members, start=1)
    )
    journals = [absent("journal_torque.1") if is_traced(*torques) else np.zeros_like(throws[0])]
    crankpins = []
    for number, throw in enumerate(throws, start=1):
        crankpins.append(named(torque_of_crankpin(journals[-1], throw), f"crankpin_torque.{number}"))
        journals.append(named(torque_behind_throw(journals[-1], throw), f"journal_torque.{number + 1}"))
    return TorquesAlongShaft(throws, tuple(journals), tuple(crankpins))


def firing_intervals(layout: Layout) -> tuple[float, ...]:
    """Return the angles from each firing to the next, in the firing order, each at its own top dead centre. [deg]"""
    first, cycle = layout.places[0].top, layout.cycle
    fired = [wrap_angle(place.firing_angle + place.top - first, cycle) for place in layout.places]
    return intervals([fired[number - 1] for number in layout.firing_order], cycle)
