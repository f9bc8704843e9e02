"""From the values of a machine file to crankshaft, cylinders, bearings, and to friction and bearings of a linkage."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from crankwork.cylinders.arrangement import StandardOrder, boxer, build_layout, inline, radial, standard_orders, vee
from crankwork.cylinders.articulated import ArticulatedRod, check_articulated_rod
from crankwork.cylinders.firing import LayoutError, LayoutNotice, wrap_angle
from crankwork.cylinders.journal_loads import check_journals
from crankwork.cylinders.layout import Banks, Layout
from crankwork.description.build import build_torsion, rod_masses
from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import Circle, Friction, GuideFriction, PinFriction
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.errors import CrankworkError, GeometryError
from crankwork.kinematics.slider_crank import SliderCrank, turns_fully
from crankwork.locale import ErrorMessage
from crankwork.machine import Bearings, Engine, Machine, PinBearing, Shaft
from crankwork.mechanism.dyads import Chain, Point
from crankwork.mechanism.joints import Pin, names_of_pivots
from crankwork.mechanism.linkage import GROUND, Linkage
from crankwork.mechanism.mechanism import Crank, Mechanism

J = TypeVar("J")
_TABLES = ("shaft", "bearings", "balance", "torsion")
# of bearings, what any linkage has whose crank turns fully
_OF_LINKAGE = {"pins", "rays"}
# throws of two cylinders without a customary order
_PAIRS = {("V", 2, False): [0.0], ("boxer", 2, False): [0.0, 180.0]}


def build_engine(
    values: Values, lengths: tuple[float, float, float] | None, cycle: float, reader: Reader
) -> Engine | None:
    """Return the engine of a machine file, or None if it describes one crank mechanism only or after complaints.

    `lengths`: crank radius, rod length and offset, if they are known [m].
    """
    if not {"engine", "bearings", "balance", "flywheel"} & set(values):
        return None
    table = values["engine"]
    if "engine" not in values:
        table = table.but(layout="inline", cylinders=1)
    doubtful = ("layout", "cylinders", "firing_order", "bank_angle", "bank_angles", "throws")
    if reader.has_errors(*(f"engine.{key}" for key in doubtful)) or len(table) < 2:
        return None
    try:
        burns = "cycle" in values or ("gas" in values and "valves" not in values["gas"] and cycle > 360.0)
        layout, notices = _layout(table, round(cycle / 180), _tops(table, lengths), burns=burns)
        if table["uneven"] and _is_free_pair(table, round(cycle / 180), burns=burns):
            notices = (*notices, LayoutNotice("uneven_pair", {}))
    except LayoutError as error:
        reader.add_error(error.key, error.args[0])
        return None
    _check_places(layout, table, reader)
    rods = _articulated_rods(table, layout, lengths, reader)
    sizes, balance = values["bearings"], values["balance"]
    check_counterweights(sizes, balance, reader)
    return Engine(
        layout=layout,
        articulated_rods=rods,
        offsets=_offsets(values, layout, lengths, reader),
        articulated_masses=_articulated_rod_masses(table["articulated"], rods, reader),
        bearings=sizes.made(Bearings),
        counterweight=sizes.si("counterweight"),
        rotating_share=balance["rotating_share"],
        reciprocating_share=balance["reciprocating_share"],
        balance_shafts=tuple(dict.fromkeys(balance["shafts"])),
        notices=tuple((notice.code, notice.values) for notice in notices),
    )


def _check_places(layout: Layout, table: Values, reader: Reader) -> None:
    """Report cylinders outside the main journals of their throw."""
    if table.si("spacing"):
        try:
            check_journals(layout)
        except CrankworkError as error:
            reader.add_error("engine.bank_stagger" if "bank_stagger" in table else "engine.spacing", error.args[0])


def _tops(table: Values, lengths: tuple[float, float, float] | None) -> tuple[float, ...]:
    """Return the angles of top dead centres from the cylinder axes if offsets differ. [deg]"""
    offsets = [offset.value for offset in table["offsets"] if offset]
    if lengths is None or len(offsets) != int(table["cylinders"]) or len(set(offsets)) == 1:
        return ()
    if not all(turns_fully(SliderCrank(*lengths[:2], offset)) for offset in offsets):
        return ()
    return tuple(math.degrees(math.asin(offset / (lengths[0] + lengths[1]))) for offset in offsets)


def _layout(
    table: Values, strokes: int, tops: tuple[float, ...], *, burns: bool
) -> tuple[Layout, tuple[LayoutNotice, ...]]:
    """Return the layout that the keys describe; where nothing burns, two cylinders need no even intervals."""
    kind, cylinders = table["layout"], int(table["cylinders"])
    throws = table.degrees("throws") if "throws" in table else None
    usual = _usual(table, strokes)
    order = [int(number) for number in table["firing_order"] if number]
    is_pair = _is_free_pair(table, strokes, burns=burns)
    if not order and kind != "radial":
        if usual is not None:
            order, throws = list(usual.order), throws or list(usual.throws)
        elif throws is None:
            throws = _PAIRS.get((kind, cylinders, bool(table["own_throws"])))
            if throws is None:
                raise LayoutError("engine.firing_order", _no_order(table, strokes))
    options: dict[str, Any] = {
        "spacing": table.si("spacing") or 0.0, "strokes": strokes, "uneven": table["uneven"] or is_pair, "tops": tops,
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


def _no_order(table: Values, strokes: int) -> ErrorMessage:
    """Return the advice for a layout without a customary firing order, with the closest split of the pins."""
    requested = {"kind": table["layout"], "cylinders": int(table["cylinders"]), "strokes": strokes}
    half = (table.degrees("bank_angle") or 0.0) / 2
    for order in standard_orders(table["layout"], int(table["cylinders"]), strokes):
        if order.axes == (-half, half) and order.pin_offset:
            return ErrorMessage("order_unusual_near", **requested, pin_offset=f"{order.pin_offset:g}")
    return ErrorMessage("order_unusual", **requested)


def _is_free_pair(table: Values, strokes: int, *, burns: bool) -> bool:
    """Return whether the intervals of two cylinders are free: nothing burns, and no customary engine has them."""
    return int(table["cylinders"]) == 2 and not burns and _usual(table, strokes) is None


def _usual(table: Values, strokes: int) -> StandardOrder | None:
    """Return the customary engine with these keys."""
    half = (table.degrees("bank_angle") or 0.0) / 2
    throws = tuple(wrap_angle(throw - table.degrees("throws")[0]) for throw in table.degrees("throws"))
    for order in standard_orders(table["layout"], int(table["cylinders"]), strokes):
        fits = table["layout"] != "V" or (
            order.axes == (-half, half) and order.pin_offset == table.degrees("pin_offset")
        )
        if fits and throws in ((), order.throws) and table["numbering"] in (None, order.numbering):
            return order
    return None


def _offsets(
    values: Values, layout: Layout, lengths: tuple[float, float, float] | None, reader: Reader
) -> tuple[float, ...]:
    """Return the offset of each cylinder if offsets are stated; report cranks that cannot turn."""
    stated = values["engine"]["offsets"]
    if not stated or None in stated or lengths is None:
        return ()
    offsets, count = [offset.value for offset in stated], len(layout.places)
    if len(offsets) != count:
        reader.add_error("engine.offsets", ErrorMessage("offsets_count", count=len(offsets), cylinders=count))
        return ()
    if "offset" in values["cylinder"]:
        reader.add_error("engine.offsets", ErrorMessage("same", others=["cylinder.offset"]))
    if "articulated" in values["engine"]:
        reader.add_error("engine.offsets", ErrorMessage("offsets_articulated"))
    for number, offset in enumerate(offsets, start=1):
        if not turns_fully(SliderCrank(*lengths[:2], offset)):
            shown = {"length": lengths[1], "radius": lengths[0], "offset": abs(offset)}
            missing = lengths[0] + abs(offset) - lengths[1]
            texts = {name: f"{size * 1e3:.6g}" for name, size in {**shown, "missing": missing}.items()}
            reader.add_error(f"engine.offsets[{number}]", ErrorMessage("rod_short", **texts))
    return tuple(offsets)


def _articulated_rod_masses(
    table: Values, rods: tuple[ArticulatedRod | None, ...], reader: Reader
) -> CrankGearMasses | None:
    """Return the masses of the articulated rods if stated."""
    rod = next((articulated for articulated in rods if articulated is not None), None)
    if "mass" not in table or rod is None:
        return None
    return rod_masses(table, table["mass"].value, rod.length, reader, "engine.articulated")


def _articulated_rods(
    table: Values, layout: Layout, lengths: tuple[float, float, float] | None, reader: Reader
) -> tuple[ArticulatedRod | None, ...]:
    """Return the articulated rod of every cylinder, None for master rods."""
    values = table["articulated"]
    if lengths is None or "knuckle_radius" not in values:
        return ()
    radius = values["knuckle_radius"].value
    length = values.si("rod_length") or lengths[1] - radius
    places = [place for place in layout.places if place.master]
    between = {place.number: place.axis - layout.places[place.master - 1].axis for place in places}
    angles: Sequence[float] = list(between.values())
    if "knuckle_angles" in values:
        angles = values.degrees("knuckle_angles")
        if len(angles) != len(places):
            reader.add_error(
                "engine.articulated.knuckle_angles",
                ErrorMessage("knuckle_count", count=len(angles), articulated_rods=len(places)),
            )
            return ()
    if length <= 0:
        reader.add_error("engine.articulated.rod_length", ErrorMessage("articulated_length", length=length * 1e3))
        return ()
    if radius >= lengths[1]:
        message = ErrorMessage("knuckle_far", radius=radius * 1e3, rod=lengths[1] * 1e3)
        reader.add_error("engine.articulated.knuckle_radius", message)
        return ()
    of_number = dict(zip(between, angles, strict=True))
    rods = [
        ArticulatedRod(length, radius, of_number[place.number], between[place.number]) if place.master else None
        for place in layout.places
    ]
    for rod in rods:
        try:
            if rod is not None:
                check_articulated_rod(SliderCrank(*lengths), rod)
        except GeometryError as error:
            reader.add_error("engine.articulated.knuckle_radius", error.args[0])
            return ()
    return tuple(rods)


def build_friction(values: Values, linkage: Linkage, mechanism: Mechanism, reader: Reader) -> tuple[Friction, ...]:
    """Return the friction of pins and guides; report unknown joints."""
    table = values.get("friction")
    if table is None:
        return ()
    held = all_links_and_joints(mechanism)[1]
    guides = {joint.name: joint.name for joint in held if not isinstance(joint, Pin)}
    circle: Circle = table["circle"] or "tangent"
    pin_friction = tuple(
        PinFriction(
            joint.name,
            stated.si("radius") or 0.0,
            stated["coefficient"],
            stated.si("moment"),
            stated.si("damping"),
            circle,
        )
        for joint, stated in known_joints(table["pins"], pins_by_name(mechanism), "friction.pins", reader)
    )
    guide_friction = tuple(
        _guide(name, stated, _middle(name, linkage, mechanism))
        for name, stated in known_joints(table["sliders"], guides, "friction.sliders", reader)
    )
    return (*pin_friction, *guide_friction)


def _guide(name: str, values: Values, middle: Point) -> GuideFriction:
    length, force, damping = (values.si(key) or 0.0 for key in ("length", "force", "damping"))
    return GuideFriction(name, values["coefficient"], length, force, damping, middle)


def _middle(name: str, linkage: Linkage, mechanism: Mechanism) -> Point:
    """Return the origin of a sliding piece, a point of its guide, relative to the pin that it is solved at."""
    member = next((candidate for candidate in linkage.members if candidate.name == name), None)
    chained = (link.name for group in mechanism.dyads if isinstance(group, Chain) for link in group.links)
    if member is None or not member.points or name in chained:
        return 0.0, 0.0
    further = {placed.name: (placed.along, placed.across) for placed in mechanism.points if placed.link == name}
    point = next(iter(further), next(iter(member.points)))
    (x, y), (u, v) = further.get(point, (0.0, 0.0)), member.points[point]
    return x - u, y - v


def pins_by_name(mechanism: Mechanism) -> dict[str, Pin]:
    """Return the revolute joints by the names that files have for them; a pivot has that of its fixed point."""
    shown = names_of_pivots(mechanism)
    held = all_links_and_joints(mechanism)[1]
    return {shown.get(joint.name, joint.name): joint for joint in held if isinstance(joint, Pin)}


def known_joints(
    tables: Mapping[str, Values | None], known: Mapping[str, J], path: str, reader: Reader
) -> Iterator[tuple[J, Values]]:
    """Yield known joints with their tables; report unknown joints."""
    for name, table in tables.items():
        if name not in known:
            kind = "sliders" if path.endswith("sliders") else "pins"
            message = ErrorMessage(f"absent_rubbing_{kind}", name=name, known=", ".join(known) or "–")
            reader.add_error(f"{path}.{name}", message)
        elif table is not None:
            yield known[name], table


def check_friction(machine: Machine, reader: Reader) -> None:
    """Report friction in machines whose joint forces are calculated without it."""
    if not machine.friction:
        return
    crank = machine.mechanism.driver
    if machine.redundant:
        reader.add_error("friction", ErrorMessage("friction_redundant", name=machine.redundant[0].member.name))
    if machine.mechanism.passages:
        reader.add_error("friction", ErrorMessage("friction_passages"))
    toothed = [geared.link for geared in crank.geared if geared.pressure_angle] if isinstance(crank, Crank) else []
    if toothed:
        reader.add_error(f"geared.{toothed[0]}.pressure_angle", ErrorMessage("friction_teeth"))


def build_bearings(values: Values, mechanism: Mechanism, reader: Reader, *, turns: bool) -> Bearings:
    """Return the bearings of a linkage; report unknown joints, and links that a joint does not hold.

    `turns`: whether the crank turns fully.
    """
    if "bearings" not in values:
        return Bearings()
    table = values["bearings"]
    if not turns and not _of_crankshaft(values):
        reader.add_error("bearings", ErrorMessage("bearings_partial"))
    pins = pins_by_name(mechanism)
    names = {joint: name for name, joint in pins.items()}
    bearings = {}
    for joint, stated in known_joints(table["pins"], pins, "bearings.pins", reader):
        name, link, held = names[joint], stated["link"] or "", [joint.link, joint.other]
        bearings[name] = PinBearing(stated.si("diameter"), stated.si("length"), link)
        if link and (link == GROUND or link not in held):
            reader.add_error(
                f"bearings.pins.{name}.link", ErrorMessage("bearing_link", pin=name, known=", ".join(held))
            )
    made: Bearings = table.made(Bearings, pins=bearings)
    return made


def build_shaft(values: Values, reader: Reader) -> Shaft | None:
    """Return the crankshaft that a file describes, None if it says nothing of it."""
    if not _of_crankshaft(values):
        return None
    shaft, sizes, balance = (values[name] for name in _TABLES[:3])
    check_counterweights(sizes, balance, reader)
    firing = {name: math.degrees(angle.value) for name, angle in shaft["firing"].items() if angle is not None}
    return Shaft(
        cylinders=_names(shaft["cylinders"]),
        positions={name: position.value for name, position in shaft["positions"].items() if position is not None},
        journals=tuple(position.value for position in shaft["journals"] if position is not None),
        throws=tuple(_names(pins) for pins in shaft["throws"] if pins),
        firing=firing,
        period=float(shaft["period"].split()[0]) if shaft["period"] else None,
        reference=shaft.si("reference"),
        misfires=_names(shaft["misfire"]),
        bore=shaft.si("bore"),
        counterweight=sizes.si("counterweight"),
        rotating_share=balance["rotating_share"],
        reciprocating_share=balance["reciprocating_share"],
        balance_shafts=tuple(dict.fromkeys(balance["shafts"])),
    )


def _of_crankshaft(values: Values) -> tuple[str, ...]:
    """Return the tables of a file that say something of the crankshaft of rods and pistons."""
    return tuple(
        name for name in _TABLES if name in values and not (name == "bearings" and set(values[name]) <= _OF_LINKAGE)
    )


def check_counterweights(sizes: Values, balance: Values, reader: Reader) -> None:
    """Report counterweights that are stated twice: as mass moments, and as a share of the masses."""
    if sizes.si("counterweight") and balance["rotating_share"]:
        reader.add_error("bearings.counterweight", ErrorMessage("counterweight_twice"))


def with_crankshaft(machine: Machine, values: Values, reader: Reader) -> Machine | None:
    """Return a linkage with the torsional system of its crankshaft; None after complaints where it has none."""
    if machine.shaft is None:
        return machine
    # most linkages do not load it
    from crankwork.preparation.cylinder_form import engine_form_or_reason  # noqa: PLC0415

    form = engine_form_or_reason(machine)
    if isinstance(form, Machine):
        torsion = build_torsion(values, form.engine, form.lengths, reader)
        is_own = form.drive.inertia > machine.drive.inertia or {"mass", "centre"}.isdisjoint(values["crank"])
        if torsion is not None and is_own and "inertia" in values["crank"]:
            machine = replace(machine, notices=(*machine.notices, ("torsion_crank", {})))
        return None if reader.problems else replace(machine, torsion=torsion)
    if form.key:
        reader.add_error(form.key, form.message)
    else:
        for table in _of_crankshaft(values):
            reader.add_error(table, ErrorMessage("shaft_of_engine", reason=form.message))
    return None


def _names(listed: list[str | None]) -> tuple[str, ...]:
    return tuple(name for name in listed if name)
