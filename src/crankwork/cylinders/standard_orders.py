"""The customary engines: firing orders with the crankshafts that belong to them."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.cylinders.firing import LayoutError
from crankwork.cylinders.layout import MOST_CYLINDERS
from crankwork.locale import ErrorMessage

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
