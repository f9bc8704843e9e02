"""From arrangement, crank and firing order to a layout, or to why they do not fit; named and customary engines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
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
    wrap_angle,
)
from crankwork.cylinders.layout import MOST_CYLINDERS, Banks, CylinderPlace, Layout
from crankwork.locale import ErrorMessage


def inline(  # noqa: PLR0913 - each argument is a key of the description
    cylinders: int,
    order: Sequence[int],
    *,
    spacing: float = 0.0,
    throws: Sequence[float] | None = None,
    strokes: int = 4,
    uneven: bool = False,
    tops: tuple[float, ...] = (),
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return an inline engine; throws [deg], uneven intervals and `tops` as for `build_layout`."""
    return build_layout(
        Banks("inline", cylinders, spacing=spacing, tops=tops), order, strokes=strokes, throws=throws, uneven=uneven
    )


def vee(  # noqa: PLR0913 - each argument is a key of the description
    cylinders: int,
    order: Sequence[int],
    bank_angle: float,
    *,
    spacing: float = 0.0,
    bank_stagger: float = 0.0,
    pin_offset: float = 0.0,
    numbering: str = "banks",
    throws: Sequence[float] | None = None,
    strokes: int = 4,
    uneven: bool = False,
    articulated: bool = False,
    own_throws: bool = False,
    tops: tuple[float, ...] = (),
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return a V engine, two cylinders to a throw or `own_throws`; throws [deg], uneven as for `build_layout`.

    The bank angle goes from the bank of cylinder 1 to the other, positive with the rotation [deg], the pin offset is
    how far the crankpins of the other bank are ahead on the same throw [deg]. Numbering is by `banks`, 1 to n/2 in the
    first, or by `pairs`, 1 and 2 on the first throw.
    """
    axes = (-bank_angle / 2, bank_angle / 2)
    if own_throws:
        # cylinders of both banks take turns along the shaft
        spacing, bank_stagger = 2 * spacing, bank_stagger or spacing
    banks = Banks("V", cylinders, axes, spacing, bank_stagger, pin_offset, numbering, own_throws, articulated, tops)
    return build_layout(banks, order, strokes=strokes, throws=throws, uneven=uneven)


def boxer(  # noqa: PLR0913 - each argument is a key of the description
    cylinders: int,
    order: Sequence[int],
    *,
    spacing: float = 0.0,
    bank_stagger: float | None = None,
    numbering: str = "banks",
    throws: Sequence[float] | None = None,
    strokes: int = 4,
    uneven: bool = False,
    tops: tuple[float, ...] = (),
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return a boxer engine: two opposed banks, each cylinder with a throw of its own.

    The spacing is that of neighbouring throws, half that of cylinders of a bank; the other bank stands as much farther
    along the shaft unless `bank_stagger` says otherwise [m]. All else as for `vee`.
    """
    stagger = spacing if bank_stagger is None else bank_stagger
    banks = Banks(
        "boxer", cylinders, (-90.0, 90.0), 2 * spacing, stagger, numbering=numbering, tops=tops, own_throws=True
    )
    return build_layout(banks, order, strokes=strokes, throws=throws, uneven=uneven)


def radial(  # noqa: PLR0913 - each argument is a key of the description
    cylinders: int,
    order: Sequence[int] | None = None,
    *,
    master: int = 1,
    span: float = 0.0,
    strokes: int = 4,
    uneven: bool = False,
    tops: tuple[float, ...] = (),
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return one row of a radial engine, numbered with the rotation, all rods on one crankpin.

    `order`: firing order; else every other cylinder in four strokes, every one in two; `master`: number of the
    cylinder whose rod carries the others; 0 if every rod turns on the crankpin itself; `uneven`: whether uneven
    intervals are wanted, so that there is no notice of them.
    """
    if not 0 <= master <= cylinders:
        raise LayoutError("engine.master", ErrorMessage("master_absent", number=master, count=cylinders))
    banks = Banks("radial", cylinders, tuple(index * 360 / cylinders for index in range(cylinders)), span, tops=tops)
    order = radial_order(cylinders, strokes) if order is None else order
    layout, notices = build_layout(banks, order, strokes=strokes, throws=(0.0,), uneven=uneven)
    places = tuple(replace(place, master=0 if place.number == master else master) for place in layout.places)
    return replace(layout, places=places), notices


class CylinderPosition(NamedTuple):
    """Position of a cylinder: number, bank and throw from 0, axis and split of its crankpin [deg], place [m].

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
        """Direction of its crankpin at its top dead centre. [deg]"""
        return self.axis + self.top


def build_layout(
    banks: Banks, order: Sequence[int], *, strokes: int = 4, throws: Sequence[float] | None = None, uneven: bool = False
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return the layout of any arrangement: W engines, narrow V engines and those without a name.

    Throws are angles along the shaft ahead of the first, positive with the rotation [deg]; without them they follow
    from even firing, and an empty order is one that they allow. Uneven intervals not `uneven` on purpose are a notice.

    At the crank angle phi of cylinder 1 from its own axis, the crankpin of cylinder k stands at
    phi + axis_1 + pin_k, so its own crank angle is phi - (axis_k - axis_1 - pin_k): the bracket is its firing angle,
    up to a whole turn. It fires at its top dead centre, which an offset moves from its axis.
    """
    seats = _seats(banks)
    if strokes not in (2, 4):
        raise LayoutError("engine.strokes", ErrorMessage("strokes_wrong", count=strokes))
    cycle = 180.0 * strokes
    if throws is not None:
        pins = _pins_of_throws(seats, throws)
        order = checked_order(order or _allowed_orders(_dead_centres(seats, pins), cycle)[0], banks.cylinders)
    else:
        order = checked_order(order, banks.cylinders)
        pins = _pins_of_even_firing(banks, seats, order, cycle, uneven=uneven)
    firing = _firing(seats, pins, order, cycle)
    steps = intervals([firing[number - 1] for number in order], cycle)
    if is_even(steps):
        # exact multiples of cycle / n, without the rounding of bank and pin angles
        firing = even_angles(order, cycle)
        notices: tuple[LayoutNotice, ...] = ()
    else:
        values = {"order": order_text(order), "intervals": angle_list(steps)}
        notices = () if uneven else (LayoutNotice("uneven_intervals", values),)
    own = [wrap_angle(angle + seats[0].top - seat.top, cycle) for angle, seat in zip(firing, seats, strict=True)]
    layout = Layout(banks.kind, _places(banks, seats, pins, own), cycle, order, _journals(seats, banks.spacing))
    return layout, notices


def _seats(banks: Banks) -> list[CylinderPosition]:
    """Return the cylinder positions by number, with throws in their order along the shaft."""
    count, rows = banks.cylinders, len(banks.axes)
    if count < 1 or count % rows:
        message = ErrorMessage("cylinders_uneven" if rows > 1 else "cylinders_none", count=count, rows=rows)
        raise LayoutError("engine.cylinders", message)
    directions = {wrap_angle(axis) for axis in banks.axes}
    if len(directions) < rows and not banks.own_throws:
        key = "engine.bank_angle" if rows == 2 else "engine.bank_angles"
        raise LayoutError(key, ErrorMessage("banks_together"))
    if banks.numbering not in ("banks", "pairs"):
        raise LayoutError("engine.numbering", ErrorMessage("numbering_wrong", given=banks.numbering))
    per_bank = count // rows
    seats = []
    for bank, axis in enumerate(banks.axes):
        for index in range(per_bank):
            number = bank * per_bank + index + 1 if banks.numbering == "banks" else index * rows + bank + 1
            throw = index * rows + bank if banks.own_throws else index
            along = (index - (per_bank - 1) / 2) * banks.spacing + (bank - (rows - 1) / 2) * banks.stagger
            top = banks.tops[number - 1] if banks.tops else 0.0
            seats.append(CylinderPosition(number, bank, throw, axis, bank * banks.pin_offset, along, top))
    return sorted(seats)


def _pins_of_throws(seats: Sequence[CylinderPosition], throws: Sequence[float]) -> list[float]:
    count = max(seat.throw for seat in seats) + 1
    if len(throws) != count:
        raise LayoutError("engine.throws", ErrorMessage("throws_count", given=len(throws), count=count))
    # the first throw is that of cylinder 1, from whose crankpin the others are measured
    return [wrap_angle(throws[seat.throw] - throws[0] + seat.pin_offset) for seat in seats]


def _pins_of_even_firing(
    banks: Banks, seats: Sequence[CylinderPosition], order: tuple[int, ...], cycle: float, *, uneven: bool
) -> list[float]:
    """Return the crankpins for even intervals; raise LayoutError if cylinders of one throw need different ones."""
    firing = even_angles(order, cycle)
    pins = [wrap_angle(seat.dead_centre - seats[0].dead_centre - firing[seat.number - 1]) for seat in seats]
    throws: dict[int, float] = {}
    for seat, pin in zip(seats, pins, strict=True):
        if seat.bank == 0 or banks.own_throws:
            throws[seat.throw] = pin
    following = _pins_of_throws(seats, [throws[throw] for throw in range(len(throws))])
    off = {
        seat.number: wrap_angle(pin - actual + 180.0) - 180.0
        for seat, pin, actual in zip(seats, pins, following, strict=True)
    }
    if max(abs(angle) for angle in off.values()) <= SAME_ANGLE:
        return following
    if uneven:
        return following
    raise _disagreement(banks, seats, following, order, cycle, off)


def _disagreement(
    banks: Banks,
    seats: Sequence[CylinderPosition],
    pins: Sequence[float],
    order: tuple[int, ...],
    cycle: float,
    off: Mapping[int, float],
) -> LayoutError:
    """Return the error that cylinders of a throw need other crankpins than it has, with remedies."""
    number = next(cylinder for cylinder, angle in off.items() if abs(angle) > SAME_ANGLE)
    seat = seats[number - 1]
    partner = next(candidate.number for candidate in seats if candidate.throw == seat.throw and candidate.bank == 0)
    split = wrap_angle(seat.pin_offset + off[number] + 180.0) - 180.0
    first_bank = [abs(angle - off[number]) <= SAME_ANGLE for cylinder, angle in off.items() if seats[cylinder - 1].bank]
    remedies: list[str] = []
    if banks.kind == "V" and all(first_bank):
        remedies.append(ErrorMessage("way_pin_offset", angle=f"{split:.7g}"))
        bank_angle = banks.axes[1] - banks.axes[0] - off[number]
        if 0 < abs(bank_angle) < 180:
            remedies.append(f"engine.bank_angle = {bank_angle:.7g}")
    dead_centres = _dead_centres(seats, pins)
    angles = firing_angles(order, dead_centres, cycle)
    if angles:
        steps = intervals([angles[cylinder - 1] for cylinder in order], cycle)
        remedies.append(ErrorMessage("way_uneven", intervals=angle_list(steps)))
    remedies += [f"engine.firing_order = {list(allowed)}" for allowed in even_orders(dead_centres, cycle, limit=2)]
    if not remedies:
        remedies.append(ErrorMessage("way_throws"))
    message = ErrorMessage(
        "pins_ahead" if split > 0 else "pins_behind",
        partner=partner, number=number, order=order_text(order), angle=abs(split),
        given=seat.pin_offset, ways=reduce(_or, remedies),
    )  # fmt: skip
    return LayoutError("engine.pin_offset" if banks.kind == "V" else "engine.firing_order", message)


def _or(first: str, other: str) -> ErrorMessage:
    return ErrorMessage("way_or", first=first, other=other)


def _allowed_orders(dead_centres: Sequence[float], cycle: float) -> Sequence[tuple[int, ...]]:
    """Return even orders of a crankshaft, or another one if it has none."""
    return even_orders(dead_centres, cycle, limit=3) or (possible_order(dead_centres, cycle),)


def _dead_centres(seats: Sequence[CylinderPosition], pins: Sequence[float]) -> list[float]:
    return [wrap_angle(seat.dead_centre - seats[0].dead_centre - pin) for seat, pin in zip(seats, pins, strict=True)]


def _firing(
    seats: Sequence[CylinderPosition], pins: Sequence[float], order: tuple[int, ...], cycle: float
) -> tuple[float, ...]:
    """Return the firing angles of the order; raise LayoutError with possible orders and a crank for this one."""
    dead_centres = _dead_centres(seats, pins)
    possible = _allowed_orders(dead_centres, cycle)
    # two fire at once where nothing else is allowed, as with opposed cranks of opposed cylinders
    together = firing_angles(possible[0], dead_centres, cycle) is None
    angles = firing_angles(order, dead_centres, cycle, together=together)
    if angles:
        return angles
    values = {"order": order_text(order), "others": ", ".join(order_text(allowed) for allowed in possible)}
    if len({seat.throw for seat in seats}) < len(seats):
        raise LayoutError("engine.firing_order", ErrorMessage("order_refused_others", **values))
    needed = even_angles(order, cycle)
    pairs = zip(seats, needed, strict=True)
    throws = {seat.throw: wrap_angle(seat.dead_centre - seats[0].dead_centre - angle) for seat, angle in pairs}
    quoted = ", ".join(f'"{throws[throw]:.7g} deg"' for throw in sorted(throws))
    raise LayoutError("engine.firing_order", ErrorMessage("order_refused_both", **values, throws=quoted))


def _places(
    banks: Banks, seats: Sequence[CylinderPosition], pins: Sequence[float], firing: Sequence[float]
) -> tuple[CylinderPlace, ...]:
    common = banks.pin_offset == 0
    masters = {seat.throw: seat.number for seat in reversed(seats) if seat.bank == 0}
    rows = len(banks.axes)
    if banks.articulated and (banks.own_throws or not common):
        raise LayoutError("engine.articulated", ErrorMessage("articulated_pins"))
    places = []
    for seat, pin, angle in zip(seats, pins, firing, strict=True):
        crankpin = seat.throw if common or banks.own_throws else seat.throw * rows + seat.bank
        master = masters[seat.throw] if banks.articulated and seat.bank else 0
        position = seat.position
        places.append(
            CylinderPlace(seat.number, seat.axis, crankpin, seat.throw, pin, position, angle, master, seat.top)
        )
    return tuple(places)


def _journals(seats: Sequence[CylinderPosition], spacing: float) -> tuple[float, ...]:
    """Return the main journals: midway between throws, and half a spacing beyond the outer ones."""
    if not spacing:
        return ()
    throws = [
        fmean(seat.position for seat in seats if seat.throw == throw)
        for throw in range(max(seat.throw for seat in seats) + 1)
    ]
    if len(throws) == 1:
        return (throws[0] - spacing / 2, throws[0] + spacing / 2)
    between = [(left + right) / 2 for left, right in pairwise(throws)]
    return (2 * throws[0] - between[0], *between, 2 * throws[-1] - between[-1])


_TURN = 360.0


class StandardOrder(NamedTuple):
    """A customary engine: kind, strokes, firing order, throws [deg], axes of the banks [deg], split of pins [deg]."""

    kind: str
    strokes: int
    order: tuple[int, ...]
    throws: tuple[float, ...]
    axes: tuple[float, ...] = (0.0,)
    pin_offset: float = 0.0
    numbering: str = "banks"

    @property
    def cylinders(self) -> int:
        """Number of cylinders."""
        return len(self.order)


def _row(  # noqa: PLR0913 - the columns of the table
    kind: str,
    strokes: int,
    order: str,
    throws: str,
    banks: str = "0",
    pin_offset: float = 0.0,
    numbering: str = "banks",
) -> StandardOrder:
    numbers = tuple(int(number) for number in order.split("-"))
    angles, axes = (tuple(float(value) for value in text.split()) for text in (throws, banks))
    return StandardOrder(kind, strokes, numbers, angles, axes, pin_offset, numbering)


STANDARD_ORDERS = (
    _row("inline", 4, "1", "0"),
    _row("inline", 4, "1-2", "0 0"),
    _row("inline", 4, "1-2", "0 180"),
    _row("inline", 4, "1-2", "0 270"),
    _row("inline", 4, "1-3-2", "0 240 120"),
    _row("inline", 4, "1-2-3", "0 120 240"),
    _row("inline", 4, "1-3-4-2", "0 180 180 0"),
    _row("inline", 4, "1-2-4-3", "0 180 180 0"),
    _row("inline", 4, "1-3-2-4", "0 270 90 180"),
    _row("inline", 4, "1-2-4-5-3", "0 216 144 72 288"),
    _row("inline", 4, "1-5-3-6-2-4", "0 240 120 120 240 0"),
    _row("inline", 4, "1-4-2-6-3-5", "0 120 240 240 120 0"),
    _row("inline", 4, "1-6-2-5-8-3-7-4", "0 180 270 90 90 270 180 0"),
    _row("inline", 4, "1-5-2-6-8-4-7-3", "0 180 90 270 270 90 180 0"),
    _row("inline", 4, "1-3-2-5-8-6-7-4", "0 180 270 90 90 270 180 0"),
    _row("inline", 2, "1", "0"),
    _row("inline", 2, "1-2", "0 180"),
    _row("inline", 2, "1-3-2", "0 120 240"),
    _row("inline", 2, "1-2-3", "0 240 120"),
    _row("inline", 2, "1-3-4-2", "0 90 270 180"),
    _row("inline", 2, "1-3-2-4", "0 180 270 90"),
    _row("inline", 2, "1-4-3-2-5", "0 144 216 288 72"),
    _row("inline", 2, "1-5-3-4-2-6", "0 120 240 180 300 60"),
    _row("inline", 2, "1-5-3-6-2-4", "0 120 240 60 300 180"),
    _row("V", 4, "1-2", "0", "-22.5 22.5"),
    _row("V", 4, "1-2", "0", "-45 45"),
    _row("V", 4, "1-3-2-4", "0 180", "-45 45", 0.0, "pairs"),
    _row("V", 4, "1-2-3-4", "0 0", "-45 45", 0.0, "pairs"),
    _row("V", 4, "1-4-2-5-3-6", "0 120 240", "-45 45"),
    _row("V", 4, "1-2-3-4-5-6", "0 120 240", "-30 30", -60.0, "pairs"),
    _row("V", 4, "1-2-3-4-5-6", "0 120 240", "-45 45", -30.0, "pairs"),
    _row("V", 4, "1-6-5-4-3-2", "0 240 120", "45 -45", 30.0, "pairs"),
    _row("V", 4, "1-2-3-4-5-6", "0 120 240", "-60 60", 0.0, "pairs"),
    _row("V", 4, "1-5-4-2-6-3-7-8", "0 90 270 180", "-45 45"),
    _row("V", 4, "1-8-4-3-6-5-7-2", "0 90 270 180", "45 -45", 0.0, "pairs"),
    _row("V", 4, "1-5-3-7-4-8-2-6", "0 180 180 0", "-45 45"),
    _row("V", 4, "1-6-2-7-4-9-5-10-3-8", "0 216 144 72 288", "-36 36"),
    _row("V", 4, "1-6-5-10-2-7-3-8-4-9", "0 72 288 144 216", "-45 45"),
    _row("V", 4, "1-7-5-11-3-9-6-12-2-8-4-10", "0 240 120 120 240 0", "-30 30"),
    _row("boxer", 4, "1-2", "0 180", "-90 90"),
    _row("boxer", 4, "1-3-2-4", "0 180 180 0", "-90 90", 0.0, "pairs"),
    _row("boxer", 4, "1-4-3-2", "0 180 180 0", "-90 90"),
    _row("boxer", 4, "1-6-2-4-3-5", "0 180 120 300 240 60", "-90 90"),
    _row("boxer", 4, "1-6-3-2-5-4", "0 180 120 300 240 60", "-90 90", 0.0, "pairs"),
    _row("W", 4, "1-5-9-3-7-11-4-8-12-2-6-10", "0 180 180 0", "-60 0 60"),
)


def radial_order(cylinders: int, strokes: int) -> tuple[int, ...]:
    """Return the firing order of a single-row radial engine numbered with the rotation.

    `cylinders` and `strokes`: how many; 4 strokes need an odd number, and every other cylinder fires.
    """
    step = strokes // 2
    if step == 2 and cylinders % 2 == 0 and cylinders:
        more = min(cylinders + 1, MOST_CYLINDERS - 1)
        raise LayoutError("engine.cylinders", ErrorMessage("radial_even", count=cylinders, fewer=more - 2, more=more))
    return tuple(index * step % cylinders + 1 for index in range(cylinders))


def standard_orders(kind: str, cylinders: int, strokes: int = 4) -> tuple[StandardOrder, ...]:
    """Return the customary firing orders and crankshafts of an engine, the most usual first."""
    if kind == "radial":
        if strokes == 4 and cylinders % 2 == 0:
            return ()
        axes = tuple(index * _TURN / cylinders for index in range(cylinders))
        return (StandardOrder(kind, strokes, radial_order(cylinders, strokes), (0.0,), axes),)
    wanted = (kind, strokes, cylinders)
    return tuple(
        standard for standard in STANDARD_ORDERS if (standard.kind, standard.strokes, standard.cylinders) == wanted
    )
