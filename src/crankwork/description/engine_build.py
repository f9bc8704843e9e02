"""From the values of a machine file to the whole engine: cylinders, bearings, counterweights, flywheel."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from crankwork.cylinders.arrangement import build_layout
from crankwork.cylinders.articulated import ArticulatedRod, check_articulated_rod
from crankwork.cylinders.engines import boxer, inline, radial, vee
from crankwork.cylinders.firing import LayoutError, LayoutNotice
from crankwork.cylinders.journal_loads import check_journals
from crankwork.cylinders.layout import Banks, Layout
from crankwork.cylinders.standard_orders import StandardOrder, standard_orders
from crankwork.description.build import rod_masses
from crankwork.description.kinds import Reader
from crankwork.description.schema import Values
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.errors import CrankworkError, GeometryError
from crankwork.kinematics.slider_crank import SliderCrank, turns_fully
from crankwork.locale import Refusal
from crankwork.machine import Bearings, Engine


def build_engine(
    values: Values, lengths: tuple[float, float, float] | None, cycle: float, reader: Reader
) -> Engine | None:
    """Return the whole engine of a machine file, or None if it describes one crank gear only or after complaints.

    `lengths`: crank radius, rod length and offset, if they are known [m].
    """
    if not {"engine", "bearings", "balance", "flywheel"} & set(values):
        return None
    table = values["engine"]
    if "engine" not in values:
        table = table.but(layout="inline", cylinders=1)
    doubtful = ("layout", "cylinders", "firing_order", "bank_angle", "bank_angles", "throws")
    if reader.doubts(*(f"engine.{key}" for key in doubtful)) or len(table) < 2:
        return None
    try:
        layout, notices = _layout(table, round(cycle / 180), _tops(table, lengths))
    except LayoutError as error:
        reader.complain(error.key, error.args[0])
        return None
    _check_places(layout, table, reader)
    slaves = _slaves(table, layout, lengths, reader)
    sizes, balance = values["bearings"], values["balance"]
    if sizes.si("counterweight") and balance["rotating_share"]:
        reader.complain("bearings.counterweight", Refusal("counterweight_twice"))
    return Engine(
        layout=layout,
        slaves=slaves,
        offsets=_offsets(values, layout, lengths, reader),
        slave_rod=_slave_rod(table["articulated"], slaves, reader),
        bearings=sizes.made(Bearings),
        counterweight=sizes.si("counterweight"),
        rotating_share=balance["rotating_share"],
        reciprocating_share=balance["reciprocating_share"],
        balance_shafts=tuple(dict.fromkeys(balance["shafts"])),
        notices=tuple((one.code, one.values) for one in notices),
    )


def _check_places(layout: Layout, table: Values, reader: Reader) -> None:
    """Complain of cylinders that stand outside the main journals of their throw."""
    if table.si("spacing"):
        try:
            check_journals(layout)
        except CrankworkError as error:
            reader.complain("engine.bank_stagger" if "bank_stagger" in table else "engine.spacing", error.args[0])


def _tops(table: Values, lengths: tuple[float, float, float] | None) -> tuple[float, ...]:
    """Return where offsets that differ put the top dead centres of the cylinders, from their axes. [deg]"""
    offsets = [one.value for one in table["offsets"] if one]
    if lengths is None or len(offsets) != int(table["cylinders"]) or len(set(offsets)) == 1:
        return ()
    if not all(turns_fully(SliderCrank(*lengths[:2], one)) for one in offsets):
        return ()
    return tuple(math.degrees(math.asin(one / (lengths[0] + lengths[1]))) for one in offsets)


def _layout(table: Values, strokes: int, tops: tuple[float, ...]) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return the layout that the keys describe."""
    kind, cylinders = table["layout"], int(table["cylinders"])
    throws = table.degrees("throws") if "throws" in table else None
    usual = _usual(table, strokes)
    order = [int(one) for one in table["firing_order"] if one]
    if not order and kind != "radial":
        if usual is None:
            raise LayoutError("engine.firing_order", _no_order(table, strokes))
        order = list(usual.order)
        throws = throws or list(usual.throws)
    options: dict[str, Any] = {
        "spacing": table.si("spacing") or 0.0, "strokes": strokes, "uneven": table["uneven"], "tops": tops,
    }  # fmt: skip
    articulated = "articulated" in table
    match kind:
        case "inline":
            return inline(cylinders, order, throws=throws, **options)
        case "radial":
            options["span"] = options.pop("spacing")
            return radial(cylinders, order or None, master=int(articulated), **options)
    options |= {
        "numbering": table["numbering"] or (usual.numbering if usual and "firing_order" not in table else "banks")
    }
    stagger = table.si("bank_stagger")
    match kind:
        case "V":
            options |= {"bank_stagger": stagger or 0.0, "pin_offset": table.degrees("pin_offset")}
            angle = table.degrees("bank_angle")
            options["own_throws"] = table["own_throws"]
            return vee(cylinders, order, angle, throws=throws, articulated=articulated, **options)
        case "boxer":
            return boxer(cylinders, order, bank_stagger=stagger, throws=throws, **options)
    axes = tuple(table.degrees("bank_angles"))
    sizes = {"numbering": options.pop("numbering"), "tops": options.pop("tops")}
    banks = Banks("W", cylinders, axes, options.pop("spacing"), stagger or 0.0, **sizes)
    return build_layout(banks, order, throws=throws, **options)


def _no_order(table: Values, strokes: int) -> Refusal:
    """Return what to write where no order is customary, or with which split of the pins one would be."""
    asked = {"kind": table["layout"], "cylinders": int(table["cylinders"]), "strokes": strokes}
    half = (table.degrees("bank_angle") or 0.0) / 2
    for one in standard_orders(table["layout"], int(table["cylinders"]), strokes):
        if one.axes == (-half, half) and one.pin_offset:
            return Refusal("order_unusual_near", **asked, pin_offset=f"{one.pin_offset:g}")
    return Refusal("order_unusual", **asked)


def _usual(table: Values, strokes: int) -> StandardOrder | None:
    """Return the customary engine with these keys."""
    half = (table.degrees("bank_angle") or 0.0) / 2
    for one in standard_orders(table["layout"], int(table["cylinders"]), strokes):
        fits = table["layout"] != "V" or (one.axes == (-half, half) and one.pin_offset == table.degrees("pin_offset"))
        if fits and table["numbering"] in (None, one.numbering):
            return one
    return None


def _offsets(
    values: Values, layout: Layout, lengths: tuple[float, float, float] | None, reader: Reader
) -> tuple[float, ...]:
    """Return the offset of each cylinder where they differ; complain where one cannot turn."""
    stated = values["engine"]["offsets"]
    if not stated or None in stated or lengths is None:
        return ()
    offsets, count = [one.value for one in stated], len(layout.places)
    if len(offsets) != count:
        reader.complain("engine.offsets", Refusal("offsets_count", count=len(offsets), cylinders=count))
        return ()
    if "offset" in values["cylinder"]:
        reader.complain("engine.offsets", Refusal("same", others=["cylinder.offset"]))
    if "articulated" in values["engine"]:
        reader.complain("engine.offsets", Refusal("offsets_articulated"))
    for number, offset in enumerate(offsets, start=1):
        if not turns_fully(SliderCrank(*lengths[:2], offset)):
            shown = {"length": lengths[1], "radius": lengths[0], "offset": abs(offset)}
            missing = lengths[0] + abs(offset) - lengths[1]
            told = {name: f"{one * 1e3:.6g}" for name, one in {**shown, "missing": missing}.items()}
            reader.complain(f"engine.offsets[{number}]", Refusal("rod_short", **told))
    return tuple(offsets)


def _slave_rod(table: Values, slaves: tuple[ArticulatedRod | None, ...], reader: Reader) -> CrankGearMasses | None:
    """Return the masses of the articulated rods where they have their own."""
    rod = next((one for one in slaves if one is not None), None)
    if "mass" not in table or rod is None:
        return None
    return rod_masses(table, table["mass"].value, rod.length, reader, "engine.articulated")


def _slaves(
    table: Values, layout: Layout, lengths: tuple[float, float, float] | None, reader: Reader
) -> tuple[ArticulatedRod | None, ...]:
    """Return the articulated rod of every cylinder that has one."""
    values = table["articulated"]
    if lengths is None or "knuckle_radius" not in values:
        return ()
    radius = values["knuckle_radius"].value
    length = values.si("rod_length") or lengths[1] - radius
    slaves = [one for one in layout.places if one.master]
    between = {one.number: one.axis - layout.places[one.master - 1].axis for one in slaves}
    angles: Sequence[float] = list(between.values())
    if "knuckle_angles" in values:
        angles = values.degrees("knuckle_angles")
        if len(angles) != len(slaves):
            reader.complain(
                "engine.articulated.knuckle_angles",
                Refusal("knuckle_count", count=len(angles), slaves=len(slaves)),
            )
            return ()
    if length <= 0:
        reader.complain(
            "engine.articulated.rod_length",
            Refusal("articulated_length", length=length * 1e3),
        )
        return ()
    if radius >= lengths[1]:
        told = Refusal("knuckle_far", radius=radius * 1e3, rod=lengths[1] * 1e3)
        reader.complain("engine.articulated.knuckle_radius", told)
        return ()
    of_number = dict(zip(between, angles, strict=True))
    rods = [
        ArticulatedRod(length, radius, of_number[one.number], between[one.number]) if one.master else None
        for one in layout.places
    ]
    for rod in rods:
        try:
            if rod is not None:
                check_articulated_rod(SliderCrank(*lengths), rod)
        except GeometryError as error:
            reader.complain("engine.articulated.knuckle_radius", error.args[0])
            return ()
    return tuple(rods)
