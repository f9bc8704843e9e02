"""What the masses of an engine leave unbalanced, order by order, before and after counterweights and balance shafts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
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
from crankwork.analysis.harmonics import amplitude_of_order, size_of_sum
from crankwork.analysis.results import Listing
from crankwork.cylinders.balance import (
    ALL_ORDERS,
    ORDERS,
    InertiaHarmonics,
    ShaftWeight,
    balance_shafts,
    free_force,
    free_forces,
    free_moment,
    inertia_harmonics,
    layout_factors,
    order_inertia_force,
    sampled_harmonics,
    shaft_forces,
)
from crankwork.cylinders.counterweights import (
    Ellipse,
    OrderBalance,
    Unbalance,
    balance_sum,
    counterweight_moment,
    rotating_unbalances,
    turning_forces,
    unit_vectors,
)
from crankwork.cylinders.journal_loads import unbalance_force
from crankwork.cylinders.layout import Layout
from crankwork.formula.replay import Samples, replay
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, TracedValue, given, in_order, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.quantities.key import key_of

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
        """Free forces by name: of each kind of mass, and the residual."""
        values = {f"reciprocating.{item.order}": item for item in self.reciprocating} | {"rotating": self.rotating}
        if self.weights:
            values["counterweights"] = self.counterweights
        values |= {f"balance_shafts.{shaft.order}": shaft for shaft in self.shafts}
        values |= {f"knuckle_pins.{knuckle.order}": knuckle for knuckle in self.knuckles}
        if self.weights or self.shafts or self.rotating.force.largest or self.rotating.moment.largest:
            values |= {f"residual.{item.order}": item for item in self.residual}
        return values


def engine_balance(engine: MultiCylinderEngine) -> EngineBalance:
    """Return the free forces and moments of the masses of an engine.

    Source: den_hartog_1956, ch. 5; taylor_1985, vol. 2, ch. 8.
    """
    layout, w = engine.layout, engine.master.speed
    r = engine.master.lengths.crank_radius
    harmonics = _harmonics(engine)
    reciprocating = free_forces(layout, reciprocating_masses(engine), r, w, harmonics)
    turning = rotating_unbalances(layout, rotating_masses(engine), r)
    weights = counterweights(engine, layout)
    rotating, balanced = turning_forces(layout, turning, w), turning_forces(layout, weights, w)
    knuckles = _knuckles(engine, harmonics.orders)
    before = balance_sum((*reciprocating, rotating, balanced, *knuckles))
    shaft_weights = tuple(
        weight
        for part in before
        if part.order in engine.engine.balance_shafts
        for weight in balance_shafts(part, w, _planes(engine, part))
    )
    shafts = shaft_forces(shaft_weights, w)
    residual = balance_sum((*before, *shafts))
    return EngineBalance(
        reciprocating, rotating, balanced, knuckles, shafts, residual, weights, shaft_weights, harmonics
    )


def _harmonics(engine: MultiCylinderEngine) -> InertiaHarmonics:
    """Return the orders of the piston acceleration, of each cylinder where some rods are articulated.

    Odd orders beyond the first are those of offset cylinders and articulated rods.
    """
    result = _all_harmonics(engine)
    size = np.abs(result.coefficients).reshape(-1, len(ALL_ORDERS)).max(axis=0)
    kept = [index for index, order in enumerate(ALL_ORDERS) if order in ORDERS or size[index] > _ROUNDING * size.max()]
    return InertiaHarmonics(tuple(ALL_ORDERS[index] for index in kept), result.coefficients[..., kept])


def _all_harmonics(engine: MultiCylinderEngine) -> InertiaHarmonics:
    lengths, method = engine.master.lengths, engine.master.method
    if engine.has_equal_motion:
        ratio = method.inertia_rod_ratio
        if ratio is not None and not method.is_exact:
            lengths = lengths._replace(rod_length=lengths.crank_radius / ratio)
        return inertia_harmonics(lengths, ALL_ORDERS, method)
    turn = _turn(engine)
    # that of the inertia force, where a document has its own
    own = [
        cylinder.trace.get("inertia_acceleration", cylinder.trace["piston_acceleration"])
        for cylinder in engine.cylinders
    ]
    rows = [replay(item.node.operands[0], turn) for item in own]
    return sampled_harmonics(np.stack(rows), lengths.crank_radius, ALL_ORDERS)


def _turn(engine: MultiCylinderEngine) -> CrankGrid:
    """Return samples of one turn, so many that the orders which they alias are negligible.

    The orders of a slider-crank fall by a factor that comes near one where crank and offset come near the rod.
    """
    r, l, e = engine.master.lengths  # noqa: E741
    fall = math.acosh(max(l / (r + max(map(abs, (e, *engine.engine.offsets)))), 1.0 + 1e-9))
    least = 2 if any(engine.engine.articulated_rods) else 1
    count = 360 * min(max(math.ceil((_DECADES * math.log(10) / fall + max(ALL_ORDERS)) / 360), least), _MOST)
    return CrankGrid.from_degrees(np.arange(count) * (360 / count))


def _knuckles(engine: MultiCylinderEngine, orders: Sequence[int]) -> tuple[OrderBalance, ...]:
    """Return the free forces of masses at knuckle pins less those of the same masses at the crankpin, by order."""
    w, r, parts = engine.master.speed, engine.master.lengths.crank_radius, list[OrderBalance]()
    for place, cylinder in zip(engine.layout.places, engine.cylinders, strict=True):
        if cylinder.moving.articulated_rod is None or "knuckle_mass" not in cylinder.trace:
            continue
        own = _turn(engine).shifted(-place.firing_angle)
        x, y = (replay(side.position_2, own) for side in cylinder.moving.articulated_rod.knuckle)
        away = (x + r * own.cos) + 1j * (y + r * own.sin)
        vectors = -cylinder.trace["knuckle_mass"].value * w**2 * away * unit_vectors(place.axis)
        spectrum = np.fft.fft(vectors) / len(own)
        for order in orders:
            force = Ellipse(complex(spectrum[order]), complex(spectrum[-order]))
            parts.append(OrderBalance(order, force, Ellipse(*(place.position * item for item in force))))
    return balance_sum(parts)


def _planes(engine: MultiCylinderEngine, part: OrderBalance) -> tuple[float] | tuple[float, float]:
    """Return the positions of the weights of a pair of shafts: the middle, or the outermost cylinders for a moment."""
    positions = [place.position for place in engine.layout.places]
    first, last = min(positions), max(positions)
    return (0.0,) if first == last or not part.moment.largest else (first, last)


def balance_trace(engine: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return the free forces and moments by row: formulas if all cylinders are equal, else vector sums."""
    values = dict(_order_forces(engine, balance) | _rotating_forces(engine) | _weights(engine, balance))
    has_moments = bool(balance_pitch(engine.layout))
    for name, row in balance.rows.items():
        keys = [f"free_force.{label}" for label, other in balance.rows.items() if other.order == row.order]
        parts = [values[key] for key in keys if key in values] if name.startswith("residual") else _parts(name, values)
        exact = _residual_formulas(engine, balance, values, row.order) if name.startswith("residual") else {}
        sums = ProcedureValue(row.force.largest, "vector_sum", parts, argument=exact.get("force"))
        force = values.setdefault(f"free_force.{name}", TracedValue(sums, f"free_force.{name}"))
        rest = {"free_force_min": row.force.least, "free_force_direction": math.radians(row.force.direction)}
        if has_moments:
            moment = TracedValue(ProcedureValue(row.moment.largest, "vector_sum", parts, argument=exact.get("moment")))
            values.setdefault(f"free_moment.{name}", moment)
            rest["free_moment_min"] = row.moment.least
        values |= {
            f"{key}.{name}": TracedValue(ProcedureValue(value, "vector_sum", (force,))) for key, value in rest.items()
        }
    return {key: known.named(key) for key, known in values.items()}


def _parts(name: str, values: Mapping[str, TracedValue]) -> list[TracedValue]:
    """Return the forces that a row is the sum of."""
    kind, order = key_of(name)
    start = f"order_inertia_force.{order}." if kind == "reciprocating" else f"unbalance_force.{kind}"
    return [known for key, known in values.items() if key.startswith(start)]


def _residual_formulas(
    engine: MultiCylinderEngine, balance: EngineBalance, values: Mapping[str, TracedValue], order: int
) -> dict[str, TracedValue]:
    """Return the residual force and moment of an order as sums of forces of one cylinder and of the counterweights.

    Empty with balance shafts and with articulated rods, of which no such sum is known.
    """
    rows = {
        name: value for name, value in balance.rows.items() if value.order == order and not name.startswith("residual")
    }
    terms = list[tuple[TracedValue, OrderBalance]]()
    for name, value in rows.items():
        kind = key_of(name).quantity
        if kind == "counterweights":
            for weight in balance.weights:
                if not isinstance(weight.mass_moment, TracedValue):
                    return {}
                force = unbalance_force(weight.mass_moment, engine.master.trace["speed"])
                terms.append((force, _over(turning_forces(engine.layout, (weight,), engine.master.speed), force.value)))
        elif kind == "reciprocating" and balance.harmonics.coefficients.ndim > 1:
            terms += _waves_of_cylinders(engine, balance, order)
        elif value.force.largest or value.moment.largest:
            key = {"reciprocating": f"order_inertia_force.{order}", "rotating": "unbalance_force.rotating"}.get(
                kind, ""
            )
            if key not in values:
                return {}
            terms.append((values[key], _over(value, values[key].value)))
    result = {}
    for kind in ("force", "moment"):
        sums = [
            [(force, getattr(getattr(item, kind), field)) for force, item in terms]
            for field in Ellipse._fields
        ]  # fmt: skip
        sizes = [size_of_sum(products) for products in sums if any(factor for _, factor in products)]
        if sizes:
            result[kind] = total("", sizes)
    return result


def _over(value: OrderBalance, force: float) -> OrderBalance:
    """Return the vectors of a free force and moment for a force of 1."""
    parts = (Ellipse(*(part / force for part in ellipse)) for ellipse in (value.force, value.moment))
    return OrderBalance(value.order, *parts)


def _waves_of_cylinders(
    engine: MultiCylinderEngine, balance: EngineBalance, order: int
) -> Iterator[tuple[TracedValue, OrderBalance]]:
    """Yield the waves of an order of the inertia force of each cylinder, with their vectors for a force of 1."""
    index, count = balance.harmonics.orders.index(order), len(engine.cylinders)
    speed = engine.master.trace["speed"]
    for number, cylinder in enumerate(engine.cylinders):
        own = cylinder.trace
        # what is multiplied by the square of the speed
        column = own.get("inertia_acceleration", own["piston_acceleration"]).node.operands[0]
        size = complex(balance.harmonics.coefficients[number, index]) * engine.master.lengths.crank_radius
        for part, value, unit in (("cosine", size.real, 1.0 + 0j), ("sine", -size.imag, -1j)):
            wave = TracedValue(HarmonicCoefficient(value, column, part, order))
            alone = InertiaHarmonics((order,), np.eye(count, dtype=complex)[:, [number]] * np.complex128(unit))
            (vectors,) = free_forces(engine.layout, np.ones(count), 1.0, 1.0, alone)
            yield own["reciprocating_mass"] * speed * speed * wave, vectors


def _order_forces(engine: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return the inertia force of each order of one cylinder and, if all are equal, the free force and moment."""
    values, trace, layout = dict[str, TracedValue](), engine.master.trace, engine.layout
    of_articulated = balance.harmonics.coefficients.ndim > 1
    pitch, orders = balance_pitch(layout), balance.harmonics.orders
    for index, (order, factor) in enumerate(zip(orders, layout_factors(layout, orders, pitch or 1.0), strict=True)):
        for number, row in enumerate(np.atleast_2d(np.abs(balance.harmonics.coefficients)), start=1):
            name = f"{order}.{number}" if of_articulated else f"{order}"
            if not row[index]:
                # an order that the method does not have
                continue
            own = engine.cylinders[number - 1].trace
            acceleration = own.get("inertia_acceleration", own["piston_acceleration"])
            is_plain = "inertia_acceleration" not in own and not of_articulated
            derivation = _coefficient(own, order, balance.harmonics.coefficients[index]) if is_plain else None
            amplitude = ProcedureValue(float(row[index]), "harmonic", (acceleration,), argument=derivation)
            coefficient = TracedValue(amplitude, f"acceleration_coefficient.{name}")
            force = order_inertia_force(
                own["reciprocating_mass"], trace["crank_radius"], trace["speed"], coefficient
            ).named(f"order_inertia_force.{name}")
            values |= {item.key: item for item in (coefficient, force)}
            if not of_articulated:
                values |= _freed(f"reciprocating.{order}", f"{order}", factor, pitch, force)
    return values


def _coefficient(trace: Mapping[str, TracedValue], order: int, value: complex) -> TracedValue:
    """Return the amplitude of an order of the acceleration, over the crank radius, of its waves."""
    transfer, r = trace["piston_transfer_2"], trace["crank_radius"]
    return amplitude_of_order(transfer, order, value.real * r.value, -value.imag * r.value) / r


def _freed(row: str, name: str, factor: OrderBalance, pitch: float, force: TracedValue) -> dict[str, TracedValue]:
    """Return the free force and moment of a layout for a force that is the same in all cylinders."""
    K_F = TracedValue(ProcedureValue(factor.force.largest, "vector_sum"), f"force_factor.{name}")
    values = [K_F, free_force(K_F, force).named(f"free_force.{row}")]
    if pitch:
        K_M = TracedValue(ProcedureValue(factor.moment.largest, "vector_sum"), f"moment_factor.{name}")
        a_z = given("balance_pitch", pitch, "engine.spacing")
        values += [K_M, free_moment(K_M, a_z, force).named(f"free_moment.{row}")]
    return {item.key: item for item in values}


def balance_pitch(layout: Layout) -> float:
    """Return the distance between neighbouring cylinders of the first bank, of all where it has one; zero if none."""
    places = layout.places
    for subset in ([place for place in places if place.axis == places[0].axis], places):
        along = sorted({item.position for item in subset})
        if len(along) > 1:
            return min(after - before for before, after in pairwise(along))
    return 0.0


def _rotating_forces(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return force and moment of the rotating masses, where those of all cylinders are the same."""
    layout, masses = engine.layout, rotating_masses(engine)
    if not masses[0] or not np.all(masses == masses[0]):
        return {}
    mass, r, w = (
        rotating_mass_of(engine, layout.places[0]),
        *(engine.master.trace[key] for key in ("crank_radius", "speed")),
    )
    unbalance = (mass * r).named("shaft_unbalance.rotating")
    force = unbalance_force(unbalance, w).named("unbalance_force.rotating")
    pitch = balance_pitch(layout)
    factor = turning_forces(layout, rotating_unbalances(layout, 1.0, 1.0), 1.0)
    moment = Ellipse(*(part / (pitch or 1.0) for part in factor.moment))
    values = {item.key: item for item in (mass, unbalance, force)}
    return values | _freed("rotating", "rotating", factor._replace(moment=moment), pitch, force)


def _weights(engine: MultiCylinderEngine, balance: EngineBalance) -> dict[str, TracedValue]:
    """Return the mass moments of counterweights and balance shafts, and the forces of these."""
    moments = [weight.mass_moment for weight in balance.weights if isinstance(weight.mass_moment, TracedValue)]
    values = {item.key: item for item in in_order(moments) if item.key.startswith(_OF_WEIGHTS)}
    for number, weight in enumerate(balance.shaft_weights, start=1):
        moment = TracedValue(ProcedureValue(weight.mass_moment, "vector_sum"), f"balance_shaft_moment.{number}")
        force = unbalance_force(moment, weight.order * engine.master.trace["speed"])
        values |= {moment.key: moment, f"unbalance_force.balance_shafts.{number}": force}
    return {key: value.named(key) for key, value in values.items()}


_OF_WEIGHTS = ("rotating_mass", "counterweight_moment")


def balance_summary(
    engine: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the residual by order, and the share of the reciprocating masses that counterweights take best."""
    kind = "residual" if any(name.startswith("residual") for name in balance.rows) else "reciprocating"
    free = [key for key in trace if key.startswith((f"free_force.{kind}.", f"free_moment.{kind}."))]
    return {key: trace[key] for key in free if trace[key].value} | _best_weights(engine, balance, trace)


def _best_weights(
    engine: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the balanced share with the least force that turns with the crank, and its counterweights.

    Empty if the reciprocating masses on the throws cancel each other.
    """
    layout, r, w = engine.layout, engine.master.lengths.crank_radius, engine.master.speed
    before = balance_sum((*balance.reciprocating, *balance.knuckles))[0]
    turning = turning_forces(layout, rotating_unbalances(layout, reciprocating_masses(engine), r), w)
    swinging, whole_part = before.force.forward, turning.force.forward
    if not whole_part:
        swinging, whole_part = before.moment.forward, turning.moment.forward
    if not whole_part:
        return {}
    free = tuple(trace[key] for key in ("free_force.reciprocating.1", "free_moment.reciprocating.1") if key in trace)
    part, derivation = (swinging * whole_part.conjugate()).real / abs(whole_part) ** 2, None
    coefficient = trace.get("acceleration_coefficient.1")
    if coefficient is not None and not balance.knuckles:
        derivation = coefficient * round(part / coefficient.value, _DIGITS)
    share = TracedValue(ProcedureValue(part, "vector_share", free, argument=derivation))
    share = share.named("best_balanced_share")
    moments = [
        total(f"best_counterweight_moment.{pin + 1}", [
            counterweight_moment(
                rotating_mass_of(engine, place), share,
                engine.cylinders[place.number - 1].trace["reciprocating_mass"], engine.master.trace["crank_radius"],
            ).named(f"best_counterweight_moment.{pin + 1}.{place.number}")
            for place in engine.on_pin[pin]
        ])
        for pin in sorted(engine.on_pin)
    ]  # fmt: skip
    if all(math.isclose(moment.value, moments[0].value, rel_tol=1e-12) for moment in moments):
        moments = [moments[0].named("best_counterweight_moment")]
    return {moment.key: moment for moment in (share, *moments)}


def balance_listing(engine: MultiCylinderEngine, balance: EngineBalance, trace: Mapping[str, TracedValue]) -> Listing:
    """Return forces and moments by order: of each kind of mass, and the residual."""
    kinds = ["free_force", "free_force_min", "free_force_direction"]
    if balance_pitch(engine.layout):
        kinds += ["free_moment", "free_moment_min"]
    rows = tuple(balance.rows)
    return Listing({kind: np.array([trace[f"{kind}.{name}"].value for name in rows]) for kind in kinds}, rows)


def balance_checks(engine: MultiCylinderEngine, balance: EngineBalance, samples: Samples) -> dict[str, float]:
    """Return how far the orders are from the Fourier transform of the summed inertia forces."""
    if engine.machine.masses is None or engine.machine.angular_acceleration:
        return {}
    turn = _turn(engine)
    force = engine.each_of("inertia_force", samples(turn))
    # the inertia force is positive towards the crankshaft, the axis points to the head
    vectors = -force.T @ unit_vectors([place.axis for place in engine.layout.places])
    spectrum = np.fft.fft(vectors) / len(turn)
    scale = float(np.max(np.abs(force))) or 1.0
    # crank angles count from the axis of cylinder 1, which is where the phasors begin as well
    residuals = [
        max(abs(spectrum[item.order] - item.force.forward), abs(spectrum[-item.order] - item.force.backward))
        for item in balance.reciprocating
    ]
    # orders that are not listed are zero
    left = set(ALL_ORDERS) - {item.order for item in balance.reciprocating}
    residuals += [abs(spectrum[order]) for item in left for order in (item, -item)]
    return {"free_forces": float(max(residuals)) / scale}
