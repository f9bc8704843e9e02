"""Worked steps of the bearings of an engine: at one crank angle, and what the loads come to over the cycle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.analysis.engine_bearings import bearing_loads, counterweights
from crankwork.analysis.results import Results
from crankwork.analysis.steps_whole_torque import WholeMoment
from crankwork.cylinders import bearings as bearing_formulas
from crankwork.cylinders.journal_loads import journal_share, unbalance_force
from crankwork.cylinders.layout import Place
from crankwork.cylinders.load_vectors import BearingLoad, bearing_load
from crankwork.machine import Bearings
from crankwork.steps import AnyStep, Given, Step, product_step, renamed, sum_step, worked_step


def bearing_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield the loads of crankpins, big end, small end and main journals.

    Parameters
    ----------
    moment : WholeMoment
        The engine at a crank angle.
    """
    whole = moment.whole
    loads = bearing_loads(whole, np.array([moment.degrees]))
    inertia = worked_step(
        bearing_formulas.big_end_inertia_force,
        whole.masses.rod_big_end,
        whole.master.lengths.crank_radius,
        whole.master.speed,
    )
    yield inertia
    on_pin = whole.on_pin
    for pin in loads.crankpins:
        yield from _crankpin_steps(moment, pin, on_pin[pin - 1], inertia.value)
    if any(whole.engine.slaves):
        # the master rod carries the others: its bearing is loaded as the crankpin is
        pin = whole.layout.places[0].crankpin + 1
        yield _resultant("big_end_load", loads.crankpins[pin])
    else:
        yield _of_one_rod(moment, 1, inertia.value, "big_end_load")
    yield from _small_end_steps(moment)
    yield from _unbalance_steps(moment)
    yield from _journal_steps(moment)
    for at, load in enumerate(loads.mains, start=1):
        yield _resultant(f"main_journal_load.{at}", load)


def _resultant(key: str, load: BearingLoad) -> Step:
    return worked_step(bearing_load, float(load.x[0]), float(load.y[0]), key=key)


def _of_one_rod(moment: WholeMoment, number: int, inertia: float, key: str) -> Step:
    known = moment.of(number)
    step = worked_step(
        bearing_formulas.crankpin_load, known["tangential_force"], known["radial_force"], inertia, key=key
    )
    if len(moment.whole.cylinders) == 1:
        return step
    return renamed(step, T=f"tangential_force.{number}", K=f"radial_force.{number}")


def _crankpin_steps(moment: WholeMoment, pin: int, places: tuple[Place, ...], inertia: float) -> Iterator[AnyStep]:
    """Yield radial and tangential force on a crankpin and their resultant; of several rods, the sums."""
    radial: list[AnyStep] = [
        worked_step(
            bearing_formulas.crankpin_radial_force,
            moment.of(place.number)["radial_force"],
            inertia,
            key=f"crankpin_radial_force.{pin}" + (f".{place.number}" if len(places) > 1 else ""),
        )
        for place in places
    ]
    tangential = sum_step(
        f"crankpin_tangential_force.{pin}",
        [Given(f"tangential_force.{one.number}", moment.of(one.number)["tangential_force"]) for one in places],
    )
    if len(places) == 1:
        yield radial[0]
        yield tangential
        yield _of_one_rod(moment, places[0].number, inertia, f"crankpin_load.{pin}")
        return
    whole = sum_step(f"crankpin_radial_force.{pin}", radial)
    yield whole
    yield tangential
    yield worked_step(bearing_load, -whole.value, tangential.value, key=f"crankpin_load.{pin}")


def _small_end_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield the force of piston 1 on its pin, its side force with what articulated rods add, and the resultant."""
    whole, known = moment.whole, moment.of(1)
    along: Step = worked_step(
        bearing_formulas.piston_pin_force,
        known.get("gas_force", 0.0),
        whole.masses.piston,
        known.get("inertia_acceleration", known["piston_acceleration"]),
    )
    if known.get("inertia_acceleration", known["piston_acceleration"]) != known["piston_acceleration"]:
        along = renamed(along, a="inertia_acceleration")
    yield along
    across: AnyStep = Given("side_force", known["side_force"])
    if "knuckle_side_force" in known:
        added = [
            Given(f"knuckle_side_force.{at}", moment.of(at)["knuckle_side_force"])
            for at, rod in enumerate(whole.engine.slaves, start=1)
            if rod is not None
        ]
        across = sum_step("side_force.small_end", (across, *added))
    yield across
    yield worked_step(bearing_formulas.small_end_load, along.value, across.value)


def _unbalance_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield the centrifugal forces of a throw and of each kind of counterweight."""
    whole = moment.whole
    if whole.masses.crank:
        parts = (
            Given("rotating_mass.throw", whole.masses.crank),
            Given("crank_radius", whole.master.lengths.crank_radius),
        )
        unbalance = product_step("shaft_unbalance.throw", parts)
        yield unbalance
        yield worked_step(unbalance_force, unbalance.value, whole.master.speed, key="unbalance_force.throw")
    kinds = dict.fromkeys(one.mass_moment for one in counterweights(whole, whole.layout))
    for at, mass_moment in enumerate(kinds, start=1):
        yield worked_step(unbalance_force, mass_moment, whole.master.speed, key=f"unbalance_force.counterweights.{at}")


def _journal_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield the share of each rod's force that the further journal carries, where the shaft is known."""
    journals = moment.whole.layout.journal_positions
    for place in moment.whole.layout.places:
        ends = journals[place.throw : place.throw + 2]
        if len(ends) == 2 and ends[0] < ends[1]:
            yield worked_step(journal_share, place.position, *ends, key=f"journal_share.{place.number}")


def load_steps(results: Results) -> Iterator[AnyStep]:
    """Yield what the bearing loads come to: mean and largest over the bearing's area, and their ratio.

    Parameters
    ----------
    results : Results
        Of an engine with bearing loads.
    """
    listing, sizes = results.listings["bearing_loads"], results.machine.engine.bearings  # type: ignore[union-attr]
    for row, name in enumerate(listing.names):
        at = {key: float(column[row]) for key, column in listing.columns.items()}
        mean, largest = at["mean_bearing_load"], at["bearing_load_max"]
        yield Given(f"mean_bearing_load.{name}", mean)
        yield Given(f"bearing_load_max.{name}", largest)
        if mean:
            yield worked_step(bearing_formulas.bearing_load_ratio, largest, mean, key=f"bearing_load_ratio.{name}")
        diameter, length = _size(sizes, name)
        if diameter is not None and length is not None:
            pressure = bearing_formulas.bearing_pressure
            yield worked_step(pressure, mean, diameter, length, key=f"bearing_pressure.{name}")
            yield worked_step(pressure, largest, diameter, length, key=f"bearing_pressure_max.{name}")
    for key, value in results.summary.items():
        if key.partition(".")[0] in ("mean_crankpin_load", "reversal_duration", "reversal_ratio"):
            yield Given(key, value)


def _size(sizes: Bearings, name: str) -> tuple[float | None, float | None]:
    match name.partition(".")[0]:
        case "small_end":
            return sizes.pin_diameter, sizes.pin_length
        case "main_journal":
            return sizes.main_diameter, sizes.main_length
        case _:
            return sizes.crankpin_diameter, sizes.crankpin_length
