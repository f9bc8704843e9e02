"""The loads of the bearings of an engine: crankpins, big end, small end, main journals, and their wear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from crankwork.analysis.cylinders import WholeEngine, cylinder_columns
from crankwork.analysis.results import Listing
from crankwork.cylinders.bearings import (
    big_end_bearing_load,
    big_end_inertia_force,
    crank_frame_load,
    piston_pin_force,
    small_end_bearing_load,
)
from crankwork.cylinders.counterweights import Unbalance, throw_counterweights
from crankwork.cylinders.journal_loads import main_journal_loads
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.load_statistics import LoadStatistics, load_reversal, load_statistics, specific_loads
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.cylinders.wear import oil_hole, ray_angles, wear_sums
from crankwork.kinematics.crank_grid import Array, CrankGrid

_DENSE_STEP, _WEAR_STEP = 1.0, 10.0


class BearingLoads(NamedTuple):
    """Loads of the bearings over the crank angle.

    Parameters
    ----------
    crankpins : mapping of int to BearingLoad, shape (n,)
        Force of the rods on each crankpin in the frame of its crank, by its number; of alike ones the first. [N]
    big_end, small_end : BearingLoad, shape (n,)
        Of the rod of cylinder 1, in the frame of the rod. [N]
    mains : tuple of BearingLoad, shape (n,)
        Force of the bearing on each main journal, in the frame of the crankshaft. [N]
    """

    crankpins: Mapping[int, BearingLoad]
    big_end: BearingLoad
    small_end: BearingLoad
    mains: tuple[BearingLoad, ...]


def bearing_loads(whole: WholeEngine, degrees: Array) -> BearingLoads:
    """Return the loads of the bearings at crank angles of cylinder 1.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    degrees : array, shape (n,)
        Crank angles of cylinder 1. [deg]

    References
    ----------
    kolchin_demidov_2008, ch. 9.
    """
    found, masses = cylinder_columns(whole, degrees), whole.masses
    r, w = whole.master.lengths.crank_radius, whole.master.speed
    inertia = float(big_end_inertia_force(masses.rod_big_end, r, w))
    rods = [
        crank_frame_load(K, T, inertia) for K, T in zip(found["radial_force"], found["tangential_force"], strict=True)
    ]
    crankpins = {}
    for pin, places in whole.on_pin.items():
        loads = [rods[place.number - 1] for place in places]
        crankpins[pin + 1] = BearingLoad(sum(one.x for one in loads), sum(one.y for one in loads))  # type: ignore[arg-type]
    layout = _spaced(whole.layout)
    mains = main_journal_loads(layout, rods, shaft_unbalances(whole, layout), w)
    swing = whole.master.motion(CrankGrid.from_degrees(found["crank_angle"][0] * 180 / np.pi)).swing
    of_master = crankpins[whole.layout.places[0].crankpin + 1] if any(whole.engine.slaves) else rods[0]
    side = found["side_force"][0]
    if "knuckle_side_force" in found:
        side = side + found["knuckle_side_force"].sum(axis=0)
    gas = found["gas_force"][0] if "gas_force" in found else np.zeros_like(degrees)
    # that of the inertia force, where a document has its own
    acceleration = found.get("inertia_acceleration", found["piston_acceleration"])[0]
    on_pin = piston_pin_force(gas, masses.piston, acceleration)
    kept = {pin: crankpins[pin] for pin in unlike_pins(whole)}
    return BearingLoads(
        kept, big_end_bearing_load(of_master, swing), small_end_bearing_load(on_pin, side, swing), mains
    )


def unlike_pins(whole: WholeEngine) -> tuple[int, ...]:
    """Return the numbers of the crankpins whose loads are not those of an earlier one, only later.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    """
    cycle, seen, kept = whole.layout.cycle, set(), []
    for pin, places in whole.on_pin.items():
        forms = [
            tuple(
                sorted(
                    (
                        round((one.firing_angle - first.firing_angle) % cycle, 6),
                        id(whole.cylinders[one.number - 1]),
                    )
                    for one in places
                )
            )
            for first in places
        ]
        if min(forms) not in seen:
            kept.append(pin + 1)
        seen.add(min(forms))
    return tuple(kept)


def _spaced(layout: Layout) -> Layout:
    """Return the layout with a pitch of its own where none is known: without one, forces act mid-throw."""
    journals = layout.journal_positions
    if len(journals) > 1 and all(one < other for one, other in pairwise(journals)):
        return layout
    throws = max(place.throw for place in layout.places) + 1
    places = tuple(replace(place, position=float(place.throw)) for place in layout.places)
    return replace(layout, places=places, journal_positions=tuple(at - 0.5 for at in range(throws + 1)))


def shaft_unbalances(whole: WholeEngine, layout: Layout) -> tuple[Unbalance, ...]:
    """Return the throws and counterweights of the crankshaft.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    layout : Layout
        Its cylinders, along the shaft as they are to be taken. [m]
    """
    r, found = whole.master.lengths.crank_radius, []
    pins = {place.crankpin: place.throw for place in layout.places}
    for members in whole.on_pin.values():
        place = layout.places[members[0].number - 1]
        middle = float(np.mean([layout.places[one.number - 1].position for one in members]))
        # split pins share the mass of their throw
        share = list(pins.values()).count(place.throw)
        found.append(Unbalance(whole.masses.crank / share * r, place.pin_angle, middle))
    return (*found, *counterweights(whole, layout))


def counterweights(whole: WholeEngine, layout: Layout) -> tuple[Unbalance, ...]:
    """Return the counterweights of the engine, one opposite each crankpin; none where there are none.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    layout : Layout
        Its cylinders, along the shaft as they are to be taken. [m]
    """
    engine, masses = whole.engine, whole.masses
    r = whole.master.lengths.crank_radius
    rotating = rotating_masses(whole) * engine.rotating_share
    share = engine.reciprocating_share
    weights = throw_counterweights(layout, masses.reciprocating, rotating, r, share)
    added = (one._replace(mass_moment=one.mass_moment + engine.counterweight) for one in weights)
    return tuple(one for one in added if one.mass_moment)


def rotating_masses(whole: WholeEngine) -> Array:
    """Return the rotating mass of each cylinder, that of a shared throw divided among its cylinders.

    Parameters
    ----------
    whole : WholeEngine
        The engine.

    Returns
    -------
    array, shape (cylinders,)
        Masses. [kg]
    """
    throws, masses = [one.throw for one in whole.layout.places], whole.masses
    return np.array([masses.rod_big_end + masses.crank / throws.count(throw) for throw in throws])


def bearing_columns(loads: BearingLoads) -> dict[str, Array]:
    """Return the sizes of the loads, and those of the crankpins by component.

    Parameters
    ----------
    loads : BearingLoads
        The loads.

    Returns
    -------
    dict of str to array, shape (n,)
        Columns by key. [N]
    """
    result = {}
    for pin, load in loads.crankpins.items():
        result[f"crankpin_radial_force.{pin}"] = -load.x
        result[f"crankpin_tangential_force.{pin}"] = load.y
        result[f"crankpin_load.{pin}"] = load.resultant
    result["big_end_load"] = loads.big_end.resultant
    result["small_end_load"] = loads.small_end.resultant
    return result | {f"main_journal_load.{at}": one.resultant for at, one in enumerate(loads.mains, start=1)}


def dense_loads(whole: WholeEngine) -> tuple[Array, BearingLoads]:
    """Return crank angles one degree apart, without the end of the cycle, and the loads there.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    """
    degrees = np.arange(0.0, whole.layout.cycle, _DENSE_STEP)
    return degrees, bearing_loads(whole, degrees)


def bearing_listings(whole: WholeEngine, degrees: Array, loads: BearingLoads) -> dict[str, Listing]:
    """Return what the loads come to over the cycle, and the wear of crankpins and main journals.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    degrees : array, shape (n,)
        Evenly spaced crank angles over one cycle, without its end. [deg]
    loads : BearingLoads, shape (n,)
        The loads there. [N]
    """
    sizes, cycle = whole.engine.bearings, whole.layout.cycle
    pin = sizes.crankpin_diameter, sizes.crankpin_length
    main = sizes.main_diameter, sizes.main_length
    rows = [(f"crankpin.{number}", load, pin) for number, load in loads.crankpins.items()]
    rows += [("big_end", loads.big_end, pin), ("small_end", loads.small_end, (sizes.pin_diameter, sizes.pin_length))]
    rows += [(f"main_journal.{at}", load, main) for at, load in enumerate(loads.mains, start=1)]
    statistics = [load_statistics(load, degrees, cycle) for _, load, _ in rows]
    columns = {
        "mean_bearing_load": [one.mean for one in statistics],
        "bearing_load_max": [one.max for one in statistics],
        "bearing_load_max_angle": [np.radians(one.max_angle) for one in statistics],
        "bearing_load_min": [one.min for one in statistics],
        "bearing_load_min_angle": [np.radians(one.min_angle) for one in statistics],
        "bearing_load_ratio": [one.ratio for one in statistics],
    }
    pressures = [_pressures(one, size) for one, (_, _, size) in zip(statistics, rows, strict=True)]
    if any(np.isfinite(one[1]) for one in pressures):
        columns |= {
            "bearing_pressure": [one[0] for one in pressures],
            "bearing_pressure_max": [one[1] for one in pressures],
        }
    result = {"bearing_loads": Listing({key: np.array(one) for key, one in columns.items()}, tuple(r[0] for r in rows))}
    rays = np.radians(ray_angles(sizes.rays))
    coarse = slice(None, None, round(_WEAR_STEP / _DENSE_STEP))
    for name, some in (("crankpin_wear", dict(loads.crankpins)), ("main_wear", dict(enumerate(loads.mains, start=1)))):
        sums = {
            f"wear_sum.{at}": wear_sums(BearingLoad(load.x[coarse], load.y[coarse]), rays=sizes.rays)
            for at, load in some.items()
        }
        result[name] = Listing({"wear_ray_angle": rays, **sums})
    return result


def _pressures(statistics: LoadStatistics, size: tuple[float | None, float | None]) -> tuple[float, float]:
    diameter, length = size
    if diameter is None or length is None:
        return float("nan"), float("nan")
    return specific_loads(statistics, diameter, length)


def bearing_summary(whole: WholeEngine, degrees: Array, loads: BearingLoads) -> dict[str, float]:
    """Return mean and largest crankpin load, where the oil hole should be, and the reversal of the small-end load.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    degrees : array, shape (n,)
        Evenly spaced crank angles over one cycle, without its end. [deg]
    loads : BearingLoads, shape (n,)
        The loads there. [N]
    """
    result: dict[str, float] = {}
    cycle, coarse = whole.layout.cycle, slice(None, None, round(_WEAR_STEP / _DENSE_STEP))
    for pin, load in loads.crankpins.items():
        found = load_statistics(load, degrees, cycle)
        name = f".{pin}" if len(loads.crankpins) > 1 else ""
        hole = oil_hole(wear_sums(BearingLoad(load.x[coarse], load.y[coarse]), rays=whole.engine.bearings.rays))
        result |= {
            f"mean_crankpin_load{name}": found.mean,
            f"crankpin_load_max{name}": found.max,
            f"crankpin_load_max_angle{name}": float(np.radians(found.max_angle)),
            f"oil_hole_angle{name}": float(np.radians(hole.angle)),
        }
    reversal = load_reversal(loads.small_end, degrees, cycle)
    return result | {"reversal_duration": float(np.radians(reversal.duration)), "reversal_ratio": reversal.ratio}
