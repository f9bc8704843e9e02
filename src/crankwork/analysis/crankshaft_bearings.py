"""The loads of the bearings of an engine: crankpins, big end, small end, main journals, and their wear."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

import numpy as np

from crankwork.analysis.bearings import Bearing, bearing_size, loads_on_crankpin
from crankwork.analysis.cylinder_forces import force_on_rod, inertia_at_big_end, joint_names, on_piston_pin
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.cylinders import load_vectors as formulas
from crankwork.cylinders.counterweights import Unbalance, counterweight_moment, throw_counterweights
from crankwork.cylinders.journal_loads import main_journal_loads, unbalance_tangential_force, unbalance_weight
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.dynamics.reaction import pin_columns
from crankwork.formula.traced_value import (
    Delayed,
    FormulaCall,
    Node,
    TracedAngle,
    TracedValue,
    absent,
    given,
    in_order,
    total,
)
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.slider_crank import RodSwing
from crankwork.preparation import traced_inputs
from crankwork.quantities.key import key_of

_ON_SHAFT = ("shaft_unbalance", "counterweight_moment", "unbalance_", "journal_share", "bearing_force_")
_OF_ROD = ("crankpin_radial_force", "crankpin_tangential_force", "tangential_force")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine")


def bearing_trace(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return the loads of the bearings by key: sizes, and components in the frame of each.

    Source: kolchin_demidov_2008, ch. 9.
    """
    master = engine.master.trace
    inertia = inertia_at_big_end(engine.master, master)
    forces = {place.number: _of_rod(engine, place, inertia) for place in engine.layout.places}
    values = {crankpin.key: crankpin for crankpin in (inertia, *_crankpins(engine, forces, inertia))}
    rods = [BearingLoad(-along, across) for along, across in forces.values()]
    load, size = rods[0], _of_one_rod(engine, 1, rods[0], inertia)
    if any(engine.engine.articulated_rods):
        # the master rod carries the others: its bearing is loaded as the crankpin is
        pin = engine.layout.places[0].crankpin + 1
        load = BearingLoad(-values[f"crankpin_radial_force.{pin}"], values[f"crankpin_tangential_force.{pin}"])
        size = values[f"crankpin_load.{pin}"]
    on_rod = formulas.big_end_bearing_load(load, RodSwing(*(master[key] for key in _SWING))).named("big_end")
    values |= {item.key: item for item in (*on_rod, size.named("big_end_load"), *_small_end(engine))}
    layout = _spaced(engine.layout)
    masses = [_held(engine, shaft_unbalance) for shaft_unbalance in shaft_unbalances(engine, layout)]
    mains = main_journal_loads(layout, rods, masses, master["speed"])
    for number, load in enumerate(mains, start=1):
        values |= {item.key: item for item in (*load, load.resultant.named(f"main_journal_load.{number}"))}
    ends = [part for load in mains for part in load]
    return {item.key: item for item in in_order(ends, into=_of_shaft) if item.key.startswith(_ON_SHAFT)} | values


def _of_shaft(node: Node) -> tuple[TracedValue, ...]:
    """Return the operands of loads of main journals, down to the loads of the rods."""
    is_of_rod = isinstance(node, FormulaCall) and node.formula.quantity in _OF_ROD
    return () if is_of_rod or isinstance(node, Delayed) else node.operands


def _of_rod(engine: MultiCylinderEngine, place: CylinderPlace, inertia: TracedValue) -> tuple[TracedValue, TracedValue]:
    """Return the load of a rod on its crankpin along and across the crank arm, of its forces and its mass there."""
    name = f"{place.crankpin + 1}.{place.number}" if len(engine.on_pin[place.crankpin]) > 1 else f"{place.crankpin + 1}"
    trace = engine.cylinders[place.number - 1].trace
    # the master rod transmits the inertia of an articulated rod's mass at its knuckle pin
    own = absent(inertia.key) if "knuckle_side_force" in trace else inertia
    weight, tangential = (
        engine.of(place.number, key) if key in trace else absent(key)
        for key in ("big_end_weight", "big_end_tangential_force")
    )
    along: TracedValue = formulas.crankpin_radial_force(engine.of(place.number, "radial_force"), own, weight)
    across = engine.of(place.number, "tangential_force")
    if not tangential.is_absent:
        across = formulas.crankpin_tangential_force(across, tangential).named(f"crankpin_tangential_force.{name}")
    return along.named(f"crankpin_radial_force.{name}"), across


def _crankpins(
    engine: MultiCylinderEngine, rods: Mapping[int, tuple[TracedValue, TracedValue]], inertia: TracedValue
) -> Iterator[TracedValue]:
    """Yield radial and tangential force on every distinct crankpin and their resultant."""
    for pin in distinct_crankpins(engine):
        numbers = [item.number for item in engine.on_pin[pin - 1]]
        along, across = rods[numbers[0]]
        of_one = _of_one_rod(engine, numbers[0], BearingLoad(-along, across), inertia) if len(numbers) == 1 else None
        yield from loads_on_crankpin(str(pin), [rods[number] for number in numbers], of_one)


def _of_one_rod(engine: MultiCylinderEngine, number: int, rod: BearingLoad, inertia: TracedValue) -> TracedValue:
    if "big_end_weight" in engine.cylinders[number - 1].trace:
        size: TracedValue = rod.resultant
        return size
    T, K = engine.of(number, "tangential_force"), engine.of(number, "radial_force")
    load: TracedValue = formulas.crankpin_load(T, K, inertia)
    return load


def _small_end(engine: MultiCylinderEngine) -> Iterator[TracedValue]:
    """Yield the force of piston 1 on its pin, its side force with that of articulated rods, and the load."""
    trace = engine.master.trace
    force, *transverse = on_piston_pin(engine.master, trace)
    articulated = [engine.of(number, "knuckle_side_force") for number in engine.has("knuckle_side_force")]
    across = [trace["side_force"], *articulated, *transverse]
    yield force
    side = total("side_force.small_end", across) if len(across) > 1 else across[0]
    swing = RodSwing(*(trace[key] for key in _SWING))
    yield from formulas.small_end_bearing_load(force, side, swing).named("small_end")
    size: TracedValue = formulas.small_end_load(force, side)
    yield size


def distinct_crankpins(engine: MultiCylinderEngine) -> tuple[int, ...]:
    """Return the numbers of the crankpins whose loads are not the delayed loads of an earlier one."""
    cycle, seen, kept = engine.layout.cycle, set(), []
    for pin, places in engine.on_pin.items():
        forms = [
            tuple(
                sorted(
                    (
                        round((place.firing_angle - first.firing_angle) % cycle, 6),
                        id(engine.cylinders[place.number - 1]),
                    )
                    for place in places
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
    if len(journals) > 1 and all(item < other for item, other in pairwise(journals)):
        return layout
    throws = max(place.throw for place in layout.places) + 1
    places = tuple(replace(place, position=float(place.throw)) for place in layout.places)
    return replace(layout, places=places, journal_positions=tuple(throw - 0.5 for throw in range(throws + 1)))


def shaft_unbalances(engine: MultiCylinderEngine, layout: Layout) -> tuple[Unbalance, ...]:
    """Return the throws and counterweights of the crankshaft.

    `layout`: its cylinders, along the shaft as they are to be taken [m].
    """
    if engine.machine.masses is None:
        return counterweights(engine, layout)
    trace, result = engine.master.trace, []
    mass, r = trace["crank_mass"], trace["crank_radius"]
    pins = {place.crankpin: place.throw for place in layout.places}
    for pin, members in engine.on_pin.items():
        place = layout.places[members[0].number - 1]
        middle = float(np.mean([layout.places[member.number - 1].position for member in members]))
        # split pins share the mass of their throw
        share = list(pins.values()).count(place.throw)
        moment = (mass / share * r if share > 1 else mass * r).named("shaft_unbalance.throw")
        result.append(Unbalance(moment, place.pin_angle, middle, f"throw.{pin + 1}"))
    return (*(item for item in result if item.mass_moment.value), *counterweights(engine, layout))


def _held(engine: MultiCylinderEngine, mass: Unbalance) -> Unbalance:
    """Return a mass on the shaft with its weight and its inertia across, where the machine has them."""
    machine, moving = engine.machine, engine.master.moving
    if not (machine.has_gravity or machine.angular_acceleration):
        return mass
    g = traced_inputs.gravity(machine, engine.master.method)
    cos, sin = traced_inputs.inclination(machine, engine.master.lean)
    angle, r = moving.angle.shifted(mass.angle), moving.lengths.crank_radius
    along = unbalance_weight(mass.mass_moment, r, g, angle.cos, cos, angle.sin, sin)
    across = unbalance_tangential_force(
        mass.mass_moment, r, g, angle.sin, cos, angle.cos, sin, moving.angular_acceleration
    )
    named = along.named(f"unbalance_weight.{mass.name}"), across.named(f"unbalance_tangential_force.{mass.name}")
    return mass._replace(held=BearingLoad(*named))


def counterweights(engine: MultiCylinderEngine, layout: Layout) -> tuple[Unbalance, ...]:
    """Return the counterweights of the engine, one opposite each crankpin; none where there are none.

    `layout`: its cylinders, along the shaft as they are to be taken [m].
    """
    r, share = engine.master.lengths.crank_radius, engine.engine.reciprocating_share
    rotating = rotating_masses(engine) * engine.engine.rotating_share
    weights = throw_counterweights(layout, reciprocating_masses(engine), rotating, r, share)
    result = [
        weight._replace(mass_moment=_counterweight(engine, pin), name=f"counterweights.{pin + 1}")
        for weight, pin in zip(weights, engine.on_pin, strict=True)
        if weight.mass_moment + engine.engine.counterweight
    ]
    return tuple(result)


def _counterweight(engine: MultiCylinderEngine, pin: int) -> TracedValue:
    """Return the mass moment of a counterweight: of the masses of each cylinder on its pin, and the given one."""
    description, trace, terms = engine.engine, engine.master.trace, []
    key = f"counterweight_moment.{pin + 1}"
    if engine.machine.masses is not None and (description.rotating_share or description.reciprocating_share):
        for place in engine.on_pin[pin]:
            moment = counterweight_moment(
                description.rotating_share * rotating_mass_of(engine, place),
                given("balanced_share", description.reciprocating_share, "balance.reciprocating_share"),
                engine.cylinders[place.number - 1].trace["reciprocating_mass"],
                trace["crank_radius"],
            )
            terms.append(moment.named(f"{key}.{place.number}"))
    if description.counterweight:
        terms.append(given(f"{key}.given", description.counterweight, "bearings.counterweight"))
    return total(key, terms)


def rotating_mass_of(engine: MultiCylinderEngine, place: CylinderPlace) -> TracedValue:
    """Return the rotating mass of a cylinder, that of a shared throw divided among its cylinders."""
    on_throw = [place.throw for place in engine.layout.places].count(place.throw)
    trace = engine.master.trace
    own = engine.cylinders[place.number - 1].trace
    mass = own.get("knuckle_mass", trace["rod_big_end_mass"]) + trace["crank_mass"] / on_throw
    return mass.named("rotating_mass.of_cylinder")


def rotating_masses(engine: MultiCylinderEngine) -> Array:
    """Return the rotating masses, that of a shared throw divided among its cylinders, shape (cylinders,)."""
    throws, crank = [place.throw for place in engine.layout.places], engine.masses.crank
    ends = [each_mass.rod_big_end for each_mass in engine.each_masses]
    return np.array([end + crank / throws.count(throw) for end, throw in zip(ends, throws, strict=True)])


def reciprocating_masses(engine: MultiCylinderEngine) -> Array:
    """Return the reciprocating masses, shape (cylinders,). [kg]"""
    return np.array([each_mass.reciprocating for each_mass in engine.each_masses])


def master_joints(engine: MultiCylinderEngine, loads: Mapping[str, TracedValue]) -> Iterator[TracedValue]:
    """Yield the forces in the joints of every distinct master rod, under the keys of a single rod.

    Its crankpin, piston pin and wall also carry forces of articulated rods. `loads`: those of the crankpins.
    """
    pin, piston = joint_names(engine.master)
    for crankpin in distinct_crankpins(engine):
        passed = [engine.of(item.number, "knuckle_side_force") for item in engine.on_pin[crankpin - 1] if item.master]
        if not passed:
            continue
        place = next(item for item in engine.on_pin[crankpin - 1] if not item.master)
        number, own = place.number, "" if place.number == 1 else f".{place.number}"
        angle = TracedAngle().shifted(-place.firing_angle)
        radial, tangential = (loads[f"crankpin_{axis}_force.{crankpin}"] for axis in ("radial", "tangential"))
        yield from force_on_rod(f"{pin}{own}", radial, tangential, angle).values()
        side = total(f"knuckle_side_force{own}", passed)
        x, y = (engine.of(number, f"joint_force_{axis}.{piston}") for axis in "xy")
        across = (x - side).named(f"joint_force_x.{piston}{own}")
        yield from pin_columns(f"{piston}{own}", across, y).values()
        yield (engine.of(number, f"normal_force.{piston}") - side).named(f"normal_force.{piston}{own}")


def engine_bearings(engine: MultiCylinderEngine, trace: Mapping[str, TracedValue]) -> Iterator[Bearing]:
    """Yield the bearings of an engine: distinct crankpins, both ends of the rod of cylinder 1, main journals."""
    sizes, pins = engine.engine.bearings, distinct_crankpins(engine)
    for load in [key for key in trace if key_of(key).quantity.endswith("_load")]:
        name = load.replace("_load", "", 1)
        kind, number = key_of(name)
        part = _SIZES.get(kind, "crankpin")
        diameter, length = (getattr(sizes, f"{part}_{size}") for size in ("diameter", "length"))
        yield Bearing(
            name,
            load,
            number,
            number if kind == "crankpin" and len(pins) > 1 else "",
            bearing_size(kind, diameter, length, f"bearings.{part}_"),
            is_crankpin=kind == "crankpin",
            is_journal=kind == "main_journal",
            reversing="bearing_force_x.small_end" if name == "small_end" else "",
        )


# prefix of the sizes of a bearing in a description; `crankpin` of the others
_SIZES = {"small_end": "pin", "main_journal": "main"}
