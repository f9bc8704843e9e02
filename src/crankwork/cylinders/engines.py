"""The engines that have a name: inline, V, boxer, radial, and the customary ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from crankwork.cylinders.arrangement import build_layout, radial_order
from crankwork.cylinders.firing import LayoutError, LayoutNotice
from crankwork.cylinders.layout import Banks, Layout
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
