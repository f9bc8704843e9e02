"""Worked steps of the balance of an engine: orders, rotating masses, counterweights, balance shafts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np

from crankwork.analysis.cylinders import WholeEngine
from crankwork.analysis.engine_balance import EngineBalance, engine_balance
from crankwork.analysis.engine_bearings import rotating_masses
from crankwork.analysis.results import Results
from crankwork.cylinders.balance import (
    ORDERS,
    free_force,
    free_moment,
    inertia_harmonics,
    layout_factors,
    order_inertia_force,
    sampled_harmonics,
)
from crankwork.cylinders.counterweights import counterweight_moment, rotating_unbalances, turning_forces
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.formula.replay import replay
from crankwork.formula.steps import AnyStep, Given, Step, product_step, renamed, sum_step, worked_step
from crankwork.kinematics.crank_grid import CrankGrid

_SAMPLES = 720


def balance_steps(results: Results, whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield what the masses of an engine leave free, order by order; vector sums without a formula are given.

    Parameters
    ----------
    results : Results
        Of an engine with masses.
    whole : WholeEngine
        Its cylinders.
    """
    listing, balance = results.listings["balance"], engine_balance(whole)
    steps = [*_order_steps(whole), *_rotating_steps(whole, balance)]
    steps += [*_counterweight_steps(whole), *_shaft_steps(whole, balance)]
    yield from steps
    shown = {step.key for step in steps}
    for row, name in enumerate(listing.names):
        for key in ("free_force", "free_moment"):
            if key in listing.columns and f"{key}.{name}" not in shown:
                yield Given(f"{key}.{name}", float(listing.columns[key][row]))


def _coefficients(whole: WholeEngine) -> Mapping[str, np.ndarray[tuple[int], np.dtype[np.float64]]]:
    """Return the acceleration coefficients by order: of all cylinders alike, or of master and first slave."""
    lengths, method = whole.master.lengths, whole.master.method
    number = next((at for at, rod in enumerate(whole.engine.slaves, start=1) if rod is not None), 0)
    if number:
        turn = CrankGrid.from_degrees(np.arange(_SAMPLES) * 360 / _SAMPLES)
        pair = {".1": whole.master, f".{number}": whole.cylinders[number - 1]}
        rows = np.stack([replay(one.memory["piston_transfer_2"], turn) for one in pair.values()])
        found = np.abs(sampled_harmonics(rows, lengths.crank_radius).coefficients)
        return dict(zip(pair, found, strict=True))
    ratio = method.inertia_rod_ratio
    if ratio is not None and not method.is_exact:
        lengths = lengths._replace(rod_length=lengths.crank_radius / ratio)
    return {"": np.abs(inertia_harmonics(lengths, ORDERS, method).coefficients)}


def _order_steps(whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield the force of one cylinder and, where all are alike, of all together."""
    coefficients, pitch = _coefficients(whole), _pitch(whole)
    r, w, mass = whole.master.lengths.crank_radius, whole.master.speed, whole.masses.reciprocating
    factors = layout_factors(whole.layout, ORDERS, pitch or 1.0)
    for at, (order, factor) in enumerate(zip(ORDERS, factors, strict=True)):
        for name, found in coefficients.items():
            if not found[at]:
                # an order that the method does not have
                continue
            yield Given(f"acceleration_coefficient.{order}{name}", float(found[at]))
            one = worked_step(
                order_inertia_force, mass, r, w, float(found[at]), key=f"order_inertia_force.{order}{name}"
            )
            yield renamed(one, A_q=f"acceleration_coefficient.{order}{name}")
            if name:
                continue
            largest = factor.force.largest, factor.moment.largest
            yield Given(f"force_factor.{order}", largest[0])
            names = {"F_jq": one.key, "K_F": f"force_factor.{order}", "K_M": f"moment_factor.{order}"}
            step = worked_step(free_force, largest[0], one.value, key=f"free_force.reciprocating.{order}")
            yield _named(step, names)
            if pitch:
                yield Given(f"moment_factor.{order}", largest[1])
                step = worked_step(free_moment, largest[1], pitch, one.value, key=f"free_moment.reciprocating.{order}")
                yield _named(step, names)


def _named(step: Step, names: Mapping[str, str]) -> Step:
    return renamed(step, **{name: key for name, key in names.items() if name in step.formula.arguments})


def _pitch(whole: WholeEngine) -> float:
    """Return the distance between neighbouring cylinders of the first bank, of all where it has one; zero if none."""
    places = whole.layout.places
    for some in ([one for one in places if one.axis == places[0].axis], places):
        along = sorted({one.position for one in some})
        if len(along) > 1:
            return min(after - before for before, after in pairwise(along))
    return 0.0


def _rotating_steps(whole: WholeEngine, balance: EngineBalance) -> Iterator[AnyStep]:
    """Yield force and moment of the rotating masses, where those of all cylinders are the same."""
    masses = rotating_masses(whole)
    mass, r, w, pitch = float(masses[0]), whole.master.lengths.crank_radius, whole.master.speed, _pitch(whole)
    if not mass or not np.all(masses == mass):
        return
    one = worked_step(unbalance_force, mass * r, w, key="unbalance_force.rotating")
    yield product_step("shaft_unbalance.rotating", (Given("rotating_mass.of_cylinder", mass), Given("crank_radius", r)))
    yield one
    unit = turning_forces(whole.layout, rotating_unbalances(whole.layout, 1.0, 1.0), 1.0)
    shown = Given(one.key, one.value)
    if balance.rotating.force.largest or balance.rotating.moment.largest:
        factor = Given("force_factor.rotating", unit.force.largest)
        yield product_step("free_force.rotating", (factor, shown))
        if pitch:
            factor = Given("moment_factor.rotating", unit.moment.largest / pitch)
            yield product_step("free_moment.rotating", (factor, Given("balance_pitch", pitch), shown))


def _counterweight_steps(whole: WholeEngine) -> Iterator[AnyStep]:
    """Yield the counterweights that differ, each from the masses of its cylinders and what is given."""
    engine, r = whole.engine, whole.master.lengths.crank_radius
    rotating = rotating_masses(whole) * engine.rotating_share
    seen: set[float] = set()
    for pin, places in whole.on_pin.items():
        terms: list[AnyStep] = [
            worked_step(
                counterweight_moment,
                float(rotating[one.number - 1]),
                engine.reciprocating_share,
                whole.masses.reciprocating,
                r,
                key=f"counterweight_moment.{pin + 1}.{one.number}",
            )
            for one in places
        ]
        if engine.counterweight:
            terms.append(Given(f"counterweight_moment.{pin + 1}.given", engine.counterweight))
        total = sum_step(f"counterweight_moment.{pin + 1}", terms)
        if total.value and total.value not in seen:
            seen.add(total.value)
            yield total


def _shaft_steps(whole: WholeEngine, balance: EngineBalance) -> Iterator[AnyStep]:
    """Yield the mass moments of the balance shafts and the forces of their weights."""
    for at, weight in enumerate(balance.shaft_weights, start=1):
        yield Given(f"balance_shaft_moment.{at}", weight.mass_moment)
        yield worked_step(
            unbalance_force,
            weight.mass_moment,
            weight.order * whole.master.speed,
            key=f"unbalance_force.balance_shafts.{at}",
        )
