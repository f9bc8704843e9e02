"""What the masses of an engine leave unbalanced, order by order, before and after counterweights and balance shafts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from crankwork.analysis.crankshaft_bearings import (
    counterweights,
    reciprocating_masses,
    rotating_mass_of,
    rotating_masses,
)
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.analysis.results import Listing
from crankwork.cylinders.balance import (
    ALL_ORDERS,
    ORDERS,
    InertiaHarmonics,
    free_force,
    free_forces,
    free_moment,
    inertia_harmonics,
    layout_factors,
    order_inertia_force,
    sampled_harmonics,
)
from crankwork.cylinders.balance_shafts import ShaftWeight, balance_shafts, shaft_forces
from crankwork.cylinders.counterweights import Unbalance, counterweight_moment, rotating_unbalances, turning_forces
from crankwork.cylinders.ellipse import Ellipse, OrderBalance, balance_sum, unit_vectors
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.torque_harmonics import amplitude_of_harmonic
from crankwork.formula.replay import Samples, replay
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, TracedValue, given, in_order, total
from crankwork.kinematics.crank_grid import CrankGrid

# by which the first orders that samples cannot tell apart are below the first
_DECADES = 17
# parts of a degree in the finest samples
_MOST = 16
# of the largest order, where rounding begins
_ROUNDING = 1e-13
# to which layouts of designs are one
_DIGITS = 13


class EngineBalance(NamedTuple):
    """Free forces and moments [N], [N m]."""

    reciprocating: tuple[OrderBalance, ...]  # Of the reciprocating masses, by order
    # Of the rotating masses and of the counterweights, both of the first order
    rotating: OrderBalance
    counterweights: OrderBalance
    knuckles: tuple[OrderBalance, ...]  # What the masses at knuckle pins add to those at the crankpin
    shafts: tuple[OrderBalance, ...]  # Of the balance shafts
    residual: tuple[OrderBalance, ...]  # All together
    # The counterweights and the weights of the balance shafts
    weights: tuple[Unbalance, ...]
    shaft_weights: tuple[ShaftWeight, ...]
    harmonics: InertiaHarmonics  # Orders of the piston acceleration, of each cylinder where some rods are articulated

    @property
    def rows(self) -> dict[str, OrderBalance]:
        """What is free by name: of each kind of mass, and what is left."""
        found = {f"reciprocating.{one.order}": one for one in self.reciprocating} | {"rotating": self.rotating}
        if self.weights:
            found["counterweights"] = self.counterweights
        found |= {f"balance_shafts.{one.order}": one for one in self.shafts}
        found |= {f"knuckle_pins.{one.order}": one for one in self.knuckles}
        if self.weights or self.shafts or self.rotating.force.largest or self.rotating.moment.largest:
            found |= {f"residual.{one.order}": one for one in self.residual}
        return found


def engine_balance(whole: MultiCylinderEngine) -> EngineBalance:
    """Return what the masses of an engine leave free.

    Source: den_hartog_1956, ch. 5; taylor_1985, vol. 2, ch. 8.
    """
    layout, w = whole.layout, whole.master.speed
    r = whole.master.lengths.crank_radius
    harmonics = _harmonics(whole)
    reciprocating = free_forces(layout, reciprocating_masses(whole), r, w, harmonics)
    turning = rotating_unbalances(layout, rotating_masses(whole), r)
    weights = counterweights(whole, layout)
    rotating, balanced = turning_forces(layout, turning, w), turning_forces(layout, weights, w)
    knuckles = _knuckles(whole, harmonics.orders)
    before = balance_sum((*reciprocating, rotating, balanced, *knuckles))
    shaft_weights = tuple(
        weight
        for part in before
        if part.order in whole.engine.balance_shafts
        for weight in balance_shafts(part, w, _planes(whole, part))
    )
    shafts = shaft_forces(shaft_weights, w)
    residual = balance_sum((*before, *shafts))
    return EngineBalance(
        reciprocating, rotating, balanced, knuckles, shafts, residual, weights, shaft_weights, harmonics
    )


def _harmonics(whole: MultiCylinderEngine) -> InertiaHarmonics:
    """Return the orders of the piston acceleration, of each cylinder where some rods are articulated.

    Odd orders beyond the first are those of offset cylinders and articulated rods.
    """
    found = _all_harmonics(whole)
    size = np.abs(found.coefficients).reshape(-1, len(ALL_ORDERS)).max(axis=0)
    kept = [at for at, order in enumerate(ALL_ORDERS) if order in ORDERS or size[at] > _ROUNDING * size.max()]
    return InertiaHarmonics(tuple(ALL_ORDERS[at] for at in kept), found.coefficients[..., kept])


def _all_harmonics(whole: MultiCylinderEngine) -> InertiaHarmonics:
    lengths, method = whole.master.lengths, whole.master.method
    if whole.moves_alike:
        ratio = method.inertia_rod_ratio
        if ratio is not None and not method.is_exact:
            lengths = lengths._replace(rod_length=lengths.crank_radius / ratio)
        return inertia_harmonics(lengths, ALL_ORDERS, method)
    turn = _turn(whole)
    # that of the inertia force, where a document has its own
    own = [one.trace.get("inertia_acceleration", one.trace["piston_acceleration"]) for one in whole.cylinders]
    rows = [replay(one.node.operands[0], turn) for one in own]
    return sampled_harmonics(np.stack(rows), lengths.crank_radius, ALL_ORDERS)


def _turn(whole: MultiCylinderEngine) -> CrankGrid:
    """Return samples of one turn, so many that orders which they cannot tell apart are nothing.

    The orders of a slider-crank fall by a factor that comes near one where crank and offset come near the rod.
    """
    r, l, e = whole.master.lengths  # noqa: E741
    fall = math.acosh(max(l / (r + max(map(abs, (e, *whole.engine.offsets)))), 1.0 + 1e-9))
    least = 2 if any(whole.engine.articulated_rods) else 1
    count = 360 * min(max(math.ceil((_DECADES * math.log(10) / fall + max(ALL_ORDERS)) / 360), least), _MOST)
    return CrankGrid.from_degrees(np.arange(count) * (360 / count))


def _knuckles(whole: MultiCylinderEngine, orders: Sequence[int]) -> tuple[OrderBalance, ...]:
    """Return what masses at knuckle pins leave free beyond the same masses at the crankpin, by order."""
    w, r, parts = whole.master.speed, whole.master.lengths.crank_radius, list[OrderBalance]()
    for place, one in zip(whole.layout.places, whole.cylinders, strict=True):
        if one.moving.articulated_rod is None or "knuckle_mass" not in one.trace:
            continue
        own = _turn(whole).shifted(-place.firing_angle)
        x, y = (replay(side.position_2, own) for side in one.moving.articulated_rod.knuckle)
        away = (x + r * own.cos) + 1j * (y + r * own.sin)
        vectors = -one.trace["knuckle_mass"].value * w**2 * away * unit_vectors(place.axis)
        spectrum = np.fft.fft(vectors) / len(own)
        for order in orders:
            force = Ellipse(complex(spectrum[order]), complex(spectrum[-order]))
            parts.append(OrderBalance(order, force, Ellipse(*(place.position * one for one in force))))
    return balance_sum(parts)


def _planes(whole: MultiCylinderEngine, part: OrderBalance) -> tuple[float] | tuple[float, float]:
    """Return where the weights of a pair of shafts stand: in the middle, or at the outermost cylinders for a moment."""
    positions = [one.position for one in whole.layout.places]
    first, last = min(positions), max(positions)
    return (0.0,) if first == last or not part.moment.largest else (first, last)


def balance_trace(whole: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return what is free by row, and what it is made of: formulas where all cylinders are alike, else vector sums."""
    found = dict(_order_forces(whole, balance) | _rotating_forces(whole) | _weights(whole, balance))
    has_moments = bool(balance_pitch(whole.layout))
    for name, one in balance.rows.items():
        keys = [f"free_force.{row}" for row, other in balance.rows.items() if other.order == one.order]
        parts = [found[key] for key in keys if key in found] if name.startswith("residual") else _parts(name, found)
        told = _told(whole, balance, found, one.order) if name.startswith("residual") else {}
        sums = ProcedureValue(one.force.largest, "vector_sum", parts, argument=told.get("force"))
        force = found.setdefault(f"free_force.{name}", TracedValue(sums, f"free_force.{name}"))
        rest = {"free_force_min": one.force.least, "free_force_direction": math.radians(one.force.direction)}
        if has_moments:
            moment = TracedValue(ProcedureValue(one.moment.largest, "vector_sum", parts, argument=told.get("moment")))
            found.setdefault(f"free_moment.{name}", moment)
            rest["free_moment_min"] = one.moment.least
        found |= {
            f"{key}.{name}": TracedValue(ProcedureValue(value, "vector_sum", (force,))) for key, value in rest.items()
        }
    return {key: known.named(key) for key, known in found.items()}


def _parts(name: str, found: Mapping[str, TracedValue]) -> list[TracedValue]:
    """Return the forces that a row is the sum of."""
    kind, _, order = name.partition(".")
    start = f"order_inertia_force.{order}." if kind == "reciprocating" else f"unbalance_force.{kind}"
    return [known for key, known in found.items() if key.startswith(start)]


def _told(
    whole: MultiCylinderEngine, balance: EngineBalance, found: Mapping[str, TracedValue], order: int
) -> dict[str, TracedValue]:
    """Return force and moment that are left of an order, made of the forces of one cylinder and of each counterweight.

    Nothing where what turns does not follow from these: with balance shafts, and with articulated rods.
    """
    rows = {name: one for name, one in balance.rows.items() if one.order == order and not name.startswith("residual")}
    terms = list[tuple[TracedValue, OrderBalance]]()
    for name, one in rows.items():
        kind = name.partition(".")[0]
        if kind == "counterweights":
            for weight in balance.weights:
                if not isinstance(weight.mass_moment, TracedValue):
                    return {}
                force = unbalance_force(weight.mass_moment, whole.master.trace["speed"])
                terms.append((force, turning_forces(whole.layout, (weight,), whole.master.speed)))
        elif one.force.largest or one.moment.largest:
            key = {"reciprocating": f"order_inertia_force.{order}", "rotating": "unbalance_force.rotating"}.get(
                kind, ""
            )
            if key not in found:
                return {}
            terms.append((found[key], one))
    made = {}
    for kind in ("force", "moment"):
        ways = [
            [(force, getattr(getattr(one, kind), way) / force.value) for force, one in terms]
            for way in Ellipse._fields
        ]  # fmt: skip
        sizes = [_size_of(way) for way in ways if any(factor for _, factor in way)]
        if sizes:
            made[kind] = total("", sizes)
    return made


def _size_of(way: Sequence[tuple[TracedValue, complex]]) -> TracedValue:
    """Return the size of a sum of forces times vectors, which are those of the layout but for rounding."""
    x, y = (
        total("", [force * round(part, _DIGITS) for (force, _), part in zip(way, parts, strict=True)])
        for parts in ([one.real for _, one in way], [one.imag for _, one in way])
    )
    size: TracedValue = amplitude_of_harmonic(x, y)
    return size


def _order_forces(whole: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return the inertia force of each order of one cylinder and, where all are alike, what is free of it."""
    found, trace, layout = dict[str, TracedValue](), whole.master.trace, whole.layout
    of_articulated = balance.harmonics.coefficients.ndim > 1
    pitch, orders = balance_pitch(layout), balance.harmonics.orders
    for at, (order, factor) in enumerate(zip(orders, layout_factors(layout, orders, pitch or 1.0), strict=True)):
        for number, row in enumerate(np.atleast_2d(np.abs(balance.harmonics.coefficients)), start=1):
            name = f"{order}.{number}" if of_articulated else f"{order}"
            if not row[at]:
                # an order that the method does not have
                continue
            of = whole.cylinders[number - 1].trace
            acceleration = of.get("inertia_acceleration", of["piston_acceleration"])
            is_plain = "inertia_acceleration" not in of and not of_articulated
            by = _coefficient(of, order, balance.harmonics.coefficients[at]) if is_plain else None
            amplitude = ProcedureValue(float(row[at]), "harmonic", (acceleration,), argument=by)
            coefficient = TracedValue(amplitude, f"acceleration_coefficient.{name}")
            force = order_inertia_force(
                of["reciprocating_mass"], trace["crank_radius"], trace["speed"], coefficient
            ).named(f"order_inertia_force.{name}")
            found |= {one.key: one for one in (coefficient, force)}
            if not of_articulated:
                found |= _freed(f"reciprocating.{order}", f"{order}", factor, pitch, force)
    return found


def _coefficient(trace: Mapping[str, TracedValue], order: int, value: complex) -> TracedValue:
    """Return the amplitude of an order of the acceleration, over the crank radius, of its waves."""
    of, r = trace["piston_transfer_2"], trace["crank_radius"]
    waves = {"cosine": value.real * r.value, "sine": -value.imag * r.value}
    found: TracedValue = (
        amplitude_of_harmonic(*(TracedValue(HarmonicCoefficient(one, of, part, order)) for part, one in waves.items()))
        / r
    )
    return found


def _freed(row: str, name: str, factor: OrderBalance, pitch: float, force: TracedValue) -> dict[str, TracedValue]:
    """Return force and moment that a layout leaves free of a force that all cylinders have alike."""
    K_F = TracedValue(ProcedureValue(factor.force.largest, "vector_sum"), f"force_factor.{name}")
    found = [K_F, free_force(K_F, force).named(f"free_force.{row}")]
    if pitch:
        K_M, a_z = (
            TracedValue(ProcedureValue(factor.moment.largest, "vector_sum"), f"moment_factor.{name}"),
            given("balance_pitch", pitch, "engine.spacing"),
        )
        found += [K_M, free_moment(K_M, a_z, force).named(f"free_moment.{row}")]
    return {one.key: one for one in found}


def balance_pitch(layout: Layout) -> float:
    """Return the distance between neighbouring cylinders of the first bank, of all where it has one; zero if none."""
    places = layout.places
    for some in ([one for one in places if one.axis == places[0].axis], places):
        along = sorted({one.position for one in some})
        if len(along) > 1:
            return min(after - before for before, after in pairwise(along))
    return 0.0


def _rotating_forces(whole: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return force and moment of the rotating masses, where those of all cylinders are the same."""
    layout, masses = whole.layout, rotating_masses(whole)
    if not masses[0] or not np.all(masses == masses[0]):
        return {}
    mass, r, w = (
        rotating_mass_of(whole, layout.places[0]),
        *(whole.master.trace[key] for key in ("crank_radius", "speed")),
    )
    unbalance = (mass * r).named("shaft_unbalance.rotating")
    force = unbalance_force(unbalance, w).named("unbalance_force.rotating")
    pitch = balance_pitch(layout)
    factor = turning_forces(layout, rotating_unbalances(layout, 1.0, 1.0), 1.0)
    moment = Ellipse(*(part / (pitch or 1.0) for part in factor.moment))
    found = {one.key: one for one in (mass, unbalance, force)}
    return found | _freed("rotating", "rotating", factor._replace(moment=moment), pitch, force)


def _weights(whole: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return the mass moments of counterweights and balance shafts, and the forces of these."""
    moments = [one.mass_moment for one in balance.weights if isinstance(one.mass_moment, TracedValue)]
    found = {one.key: one for one in in_order(moments) if one.key.startswith(_OF_WEIGHTS)}
    for at, weight in enumerate(balance.shaft_weights, start=1):
        moment = TracedValue(ProcedureValue(weight.mass_moment, "vector_sum"), f"balance_shaft_moment.{at}")
        force = unbalance_force(moment, weight.order * whole.master.trace["speed"])
        found |= {moment.key: moment, f"unbalance_force.balance_shafts.{at}": force}
    return {key: one.named(key) for key, one in found.items()}


_OF_WEIGHTS = ("rotating_mass", "counterweight_moment")


def balance_summary(
    whole: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return what is left free by order, and the share of the reciprocating masses that counterweights take best."""
    kind = "residual" if any(name.startswith("residual") for name in balance.rows) else "reciprocating"
    free = [key for key in trace if key.startswith((f"free_force.{kind}.", f"free_moment.{kind}."))]
    return {key: trace[key] for key in free if trace[key].value} | _best_weights(whole, balance, trace)


def _best_weights(
    whole: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the share at which what turns with the crank is gone, or least, and the counterweights with that share.

    Nothing where the reciprocating masses on the throws cancel each other.
    """
    layout, r, w = whole.layout, whole.master.lengths.crank_radius, whole.master.speed
    before = balance_sum((*balance.reciprocating, *balance.knuckles))[0]
    turning = turning_forces(layout, rotating_unbalances(layout, reciprocating_masses(whole), r), w)
    swinging, whole_part = before.force.forward, turning.force.forward
    if not whole_part:
        swinging, whole_part = before.moment.forward, turning.moment.forward
    if not whole_part:
        return {}
    free = tuple(trace[key] for key in ("free_force.reciprocating.1", "free_moment.reciprocating.1") if key in trace)
    part, by = (swinging * whole_part.conjugate()).real / abs(whole_part) ** 2, None
    coefficient = trace.get("acceleration_coefficient.1")
    if coefficient is not None and not balance.knuckles:
        by = coefficient * round(part / coefficient.value, _DIGITS)
    share = TracedValue(ProcedureValue(part, "vector_share", free, argument=by))
    share = share.named("best_balanced_share")
    moments = [
        total(f"best_counterweight_moment.{pin + 1}", [
            counterweight_moment(
                rotating_mass_of(whole, place), share,
                whole.cylinders[place.number - 1].trace["reciprocating_mass"], whole.master.trace["crank_radius"],
            ).named(f"best_counterweight_moment.{pin + 1}.{place.number}")
            for place in whole.on_pin[pin]
        ])
        for pin in sorted(whole.on_pin)
    ]  # fmt: skip
    alike = all(math.isclose(one.value, moments[0].value, rel_tol=1e-12) for one in moments)
    if alike:
        moments = [moments[0].named("best_counterweight_moment")]
    return {one.key: one for one in (share, *moments)}


def balance_listing(whole: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]) -> Listing:
    """Return forces and moments by order: of each kind of mass, and what is left."""
    kinds = ["free_force", "free_force_min", "free_force_direction"]
    if balance_pitch(whole.layout):
        kinds += ["free_moment", "free_moment_min"]
    rows = tuple(balance.rows)
    return Listing({kind: np.array([trace[f"{kind}.{name}"].value for name in rows]) for kind in kinds}, rows)


def balance_checks(whole: MultiCylinderEngine, balance: EngineBalance, samples: Samples) -> dict[str, float]:
    """Return how far the orders are from the Fourier transform of the summed inertia forces."""
    if whole.machine.masses is None or whole.machine.angular_acceleration:
        return {}
    turn = _turn(whole)
    force = whole.each_of("inertia_force", samples(turn))
    # the inertia force is positive towards the crankshaft, the axis points to the head
    vectors = -force.T @ unit_vectors([one.axis for one in whole.layout.places])
    spectrum = np.fft.fft(vectors) / len(turn)
    scale = float(np.max(np.abs(force))) or 1.0
    # crank angles count from the axis of cylinder 1, which is where the phasors begin as well
    apart = [
        max(abs(spectrum[one.order] - one.force.forward), abs(spectrum[-one.order] - one.force.backward))
        for one in balance.reciprocating
    ]
    # an order that is not listed is none
    left = set(ALL_ORDERS) - {one.order for one in balance.reciprocating}
    apart += [abs(spectrum[order]) for one in left for order in (one, -one)]
    return {"free_forces": float(max(apart)) / scale}
