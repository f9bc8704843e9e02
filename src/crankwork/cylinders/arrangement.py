"""From arrangement, crank and firing order to a layout, or to the sentence that says why they do not fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import pairwise
from statistics import fmean
from typing import NamedTuple

from crankwork.cylinders.firing import (
    SAME_ANGLE,
    LayoutError,
    LayoutNotice,
    angle_list,
    checked_order,
    even_angles,
    even_orders,
    firing_angles,
    intervals,
    is_even,
    order_text,
    possible_order,
    wrapped,
)
from crankwork.cylinders.layout import Banks, Layout, Place
from crankwork.locale import Refusal


class Seat(NamedTuple):
    """Where a cylinder sits: number, bank and throw from 0, axis and split of its crankpin [deg], position [m].

    `top`: its own crank angle at top dead centre, from its axis [deg].
    """

    number: int
    bank: int
    throw: int
    axis: float
    pin_offset: float
    position: float
    top: float = 0.0

    @property
    def dead_centre(self) -> float:
        """Where its crankpin stands at its top dead centre. [deg]"""
        return self.axis + self.top


def arranged(
    banks: Banks,
    order: Sequence[int],
    *,
    strokes: int = 4,
    throws: Sequence[float] | None = None,
    uneven: bool = False,
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return the layout of any arrangement: W engines, narrow V engines and whatever has no name.

    Throws are angles along the shaft ahead of the first, positive with the rotation [deg]; without them they follow
    from even firing. Uneven intervals that are not `uneven` on purpose are a notice.

    At the crank angle phi of cylinder 1 from its own axis, the crankpin of cylinder k stands at
    phi + axis_1 + pin_k, so its own crank angle is phi - (axis_k - axis_1 - pin_k): the bracket is its firing angle,
    up to a whole turn. It fires at its top dead centre, which an offset moves from its axis.
    """
    seats = _seats(banks)
    if strokes not in (2, 4):
        raise LayoutError("engine.strokes", Refusal("strokes_wrong", count=strokes))
    order, cycle = checked_order(order, banks.cylinders), 180.0 * strokes
    if throws is None:
        pins = _pins_of_even_firing(banks, seats, order, cycle, uneven=uneven)
    else:
        pins = _pins_of_throws(seats, throws)
    firing = _firing(seats, pins, order, cycle)
    steps = intervals([firing[number - 1] for number in order], cycle)
    if is_even(steps):
        # the very angles k * cycle / n, whatever rounding the angles of banks and pins brought in
        firing = even_angles(order, cycle)
        notices: tuple[LayoutNotice, ...] = ()
    else:
        values = {"order": order_text(order), "intervals": angle_list(steps)}
        notices = () if uneven else (LayoutNotice("uneven_intervals", values),)
    own = [wrapped(angle + seats[0].top - seat.top, cycle) for angle, seat in zip(firing, seats, strict=True)]
    layout = Layout(banks.kind, _places(banks, seats, pins, own), cycle, order, _journals(seats, banks.spacing))
    return layout, notices


def _seats(banks: Banks) -> list[Seat]:
    """Return the seats by number, the throws in the order along the shaft."""
    count, rows = banks.cylinders, len(banks.axes)
    if count < 1 or count % rows:
        told = Refusal("cylinders_uneven" if rows > 1 else "cylinders_none", count=count, rows=rows)
        raise LayoutError("engine.cylinders", told)
    directions = {wrapped(axis) for axis in banks.axes}
    if len(directions) < rows and not banks.own_throws:
        key = "engine.bank_angle" if rows == 2 else "engine.bank_angles"
        raise LayoutError(key, Refusal("banks_together"))
    if banks.numbering not in ("banks", "pairs"):
        raise LayoutError("engine.numbering", Refusal("numbering_wrong", given=banks.numbering))
    per_bank = count // rows
    seats = []
    for bank, axis in enumerate(banks.axes):
        for at in range(per_bank):
            number = bank * per_bank + at + 1 if banks.numbering == "banks" else at * rows + bank + 1
            throw = at * rows + bank if banks.own_throws else at
            along = (at - (per_bank - 1) / 2) * banks.spacing + (bank - (rows - 1) / 2) * banks.stagger
            top = banks.tops[number - 1] if banks.tops else 0.0
            seats.append(Seat(number, bank, throw, axis, bank * banks.pin_offset, along, top))
    return sorted(seats)


def _pins_of_throws(seats: Sequence[Seat], throws: Sequence[float]) -> list[float]:
    count = max(seat.throw for seat in seats) + 1
    if len(throws) != count:
        raise LayoutError(
            "engine.throws",
            Refusal("throws_count", given=len(throws), count=count),
        )
    # the first throw belongs to cylinder 1, from whose crankpin all others count
    return [wrapped(throws[seat.throw] - throws[0] + seat.pin_offset) for seat in seats]


def _pins_of_even_firing(
    banks: Banks, seats: Sequence[Seat], order: tuple[int, ...], cycle: float, *, uneven: bool
) -> list[float]:
    """Return the crankpins that even intervals need, or raise if those of one throw disagree with its pins."""
    firing = even_angles(order, cycle)
    pins = [wrapped(seat.dead_centre - seats[0].dead_centre - firing[seat.number - 1]) for seat in seats]
    throws: dict[int, float] = {}
    for seat, pin in zip(seats, pins, strict=True):
        if seat.bank == 0 or banks.own_throws:
            throws[seat.throw] = pin
    following = _pins_of_throws(seats, [throws[at] for at in range(len(throws))])
    off = {
        seat.number: wrapped(pin - there + 180.0) - 180.0
        for seat, pin, there in zip(seats, pins, following, strict=True)
    }
    if max(abs(one) for one in off.values()) <= SAME_ANGLE:
        return following
    if uneven:
        return following
    raise _disagreement(banks, seats, following, order, cycle, off)


def _disagreement(
    banks: Banks,
    seats: Sequence[Seat],
    pins: Sequence[float],
    order: tuple[int, ...],
    cycle: float,
    off: Mapping[int, float],
) -> LayoutError:
    """Return what is wrong when the cylinders of a throw need other crankpins than it has, and what would help."""
    number = next(one for one, angle in off.items() if abs(angle) > SAME_ANGLE)
    seat = seats[number - 1]
    partner = next(one.number for one in seats if one.throw == seat.throw and one.bank == 0)
    split = wrapped(seat.pin_offset + off[number] + 180.0) - 180.0
    first_bank = [abs(angle - off[number]) <= SAME_ANGLE for one, angle in off.items() if seats[one - 1].bank]
    ways: list[str] = []
    if banks.kind == "V" and all(first_bank):
        ways.append(Refusal("way_pin_offset", angle=f"{split:.7g}"))
        bank_angle = banks.axes[1] - banks.axes[0] - off[number]
        if 0 < abs(bank_angle) < 180:
            ways.append(f"engine.bank_angle = {bank_angle:.7g}")
    dead_centres = _dead_centres(seats, pins)
    angles = firing_angles(order, dead_centres, cycle)
    if angles:
        steps = intervals([angles[one - 1] for one in order], cycle)
        ways.append(Refusal("way_uneven", intervals=angle_list(steps)))
    ways += [f"engine.firing_order = {list(one)}" for one in even_orders(dead_centres, cycle, limit=2)]
    if not ways:
        ways.append(Refusal("way_throws"))
    told = Refusal(
        "pins_ahead" if split > 0 else "pins_behind",
        partner=partner, number=number, order=order_text(order), angle=abs(split),
        given=seat.pin_offset, ways=reduce(_or, ways),
    )  # fmt: skip
    return LayoutError("engine.pin_offset" if banks.kind == "V" else "engine.firing_order", told)


def _or(first: str, other: str) -> Refusal:
    return Refusal("way_or", first=first, other=other)


def _dead_centres(seats: Sequence[Seat], pins: Sequence[float]) -> list[float]:
    return [wrapped(seat.dead_centre - seats[0].dead_centre - pin) for seat, pin in zip(seats, pins, strict=True)]


def _firing(seats: Sequence[Seat], pins: Sequence[float], order: tuple[int, ...], cycle: float) -> tuple[float, ...]:
    """Return the firing angles of the order, or raise with an order that the crank allows and a crank for the order."""
    dead_centres = _dead_centres(seats, pins)
    angles = firing_angles(order, dead_centres, cycle)
    if angles:
        return angles
    ways = [order_text(one) for one in even_orders(dead_centres, cycle, limit=3)]
    possible = possible_order(dead_centres, cycle)
    if not ways and possible:
        ways.append(order_text(possible))
    told = {"order": order_text(order), "others": ", ".join(ways)}
    if len({seat.throw for seat in seats}) == len(seats):
        needed = even_angles(order, cycle)
        pairs = zip(seats, needed, strict=True)
        throws = {seat.throw: wrapped(seat.dead_centre - seats[0].dead_centre - angle) for seat, angle in pairs}
        quoted = ", ".join(f'"{throws[at]:.7g} deg"' for at in sorted(throws))
        name = "order_refused_both" if ways else "order_refused_throws"
        raise LayoutError("engine.firing_order", Refusal(name, **told, throws=quoted))
    raise LayoutError("engine.firing_order", Refusal("order_refused_others" if ways else "order_refused", **told))


def _places(banks: Banks, seats: Sequence[Seat], pins: Sequence[float], firing: Sequence[float]) -> tuple[Place, ...]:
    common = banks.pin_offset == 0
    masters = {seat.throw: seat.number for seat in reversed(seats) if seat.bank == 0}
    rows = len(banks.axes)
    if banks.articulated and (banks.own_throws or not common):
        raise LayoutError("engine.articulated", Refusal("articulated_pins"))
    places = []
    for seat, pin, angle in zip(seats, pins, firing, strict=True):
        crankpin = seat.throw if common or banks.own_throws else seat.throw * rows + seat.bank
        master = masters[seat.throw] if banks.articulated and seat.bank else 0
        places.append(Place(seat.number, seat.axis, crankpin, seat.throw, pin, seat.position, angle, master, seat.top))
    return tuple(places)


def _journals(seats: Sequence[Seat], spacing: float) -> tuple[float, ...]:
    """Return the main journals: midway between throws, and half a distance beyond the outer ones."""
    if not spacing:
        return ()
    throws = [
        fmean(seat.position for seat in seats if seat.throw == at) for at in range(max(one.throw for one in seats) + 1)
    ]
    if len(throws) == 1:
        return (throws[0] - spacing / 2, throws[0] + spacing / 2)
    between = [(one + other) / 2 for one, other in pairwise(throws)]
    return (2 * throws[0] - between[0], *between, 2 * throws[-1] - between[-1])
