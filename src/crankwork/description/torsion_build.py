"""From the values of a machine file to a torsional system, with the checks that need several keys."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from crankwork.description.schema import Values
from crankwork.description.stated import stated_numbers
from crankwork.description.value_types import Reader
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.shaft.torque_diagram import ShaftTorques
from crankwork.shaft.torsion_model import (
    GROUNDED,
    Damper,
    Disc,
    ElasticShaft,
    ExcitingTorque,
    GearPair,
    ShaftPart,
    Throw,
    TorsionModel,
    structure_of,
    walked,
)
from crankwork.shaft.torsional_system import NaturalModes

_TURN = 6.283185307179586
_MOST = 10_000


def build_torsion_alone(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of discs on shafts alone, or None after complaints."""
    from crankwork.description.build import build_method, crank_speed  # noqa: PLC0415 - which engines build this with

    method = build_method(values["method"], reader)
    if not method.is_exact:
        reader.add_error("method.kinematics", ErrorMessage("turning_exact"))
    model = build_torsion(values["torsion"], reader)
    stated = values["crank"]["speed"]
    speed = crank_speed(stated, method) if stated else 0.0
    if not speed and model is not None and any(torque.order is not None for torque in model.torques):
        reader.add_error("crank.speed", ErrorMessage("missing", advice=('speed = "1500 rpm"',)))
    if reader.problems or model is None:
        return None
    return Machine(
        Mechanism(Crank(radius=0.0), ()),
        speed=speed or 1.0,
        title=values["title"] or "",
        turning=ShaftTorques(None, None, _TURN),
        method=method,
        table_step=values["table"].degrees("step"),
        table_special=tuple(values["table"].degrees("special_angles")),
        stated=stated_numbers(values),
        torsion=model,
    )


def build_torsion(values: Values, reader: Reader, throws: int = 0, radius: float = 0.0) -> TorsionModel | None:
    """Return the torsional system, with a disc for each throw of a crankshaft of a radius, or None after complaints."""
    names = tuple(f"throw_{number}" for number in range(1, throws + 1))
    shafts = dict(_shafts(values, names, radius, reader))
    if reader.problems or any(
        item is None for table in ("discs", "gears", "dampers") for item in values[table].values()
    ):
        return None
    discs = {name: item.made(Disc) for name, item in values["discs"].items()}
    gears = {name: _gear(item) for name, item in values["gears"].items()}
    dampers = {
        name: item.made(Damper, stiffness=item.si("stiffness") or 0.0, mode=int(item["mode"]))
        for name, item in values["dampers"].items()
    }
    torques = tuple(item.made(ExcitingTorque) for item in values["torques"] if item is not None)
    speeds = tuple(item.value for item in values["speeds"] if item is not None)
    model = TorsionModel(
        discs, shafts, gears, dampers, torques, values.si("modulus"), values.si("reference_diameter"), names,
        values.si("throw_inertia") or 0.0, tuple(item.value for item in values["trials"] if item is not None),
        (speeds[0], speeds[1]) if len(speeds) == 2 else None, float(values["orders"]), int(values["modes"]),
    )  # fmt: skip
    _check(model, reader)
    return None if reader.problems else model


def _shafts(values: Values, throws: Sequence[str], radius: float, reader: Reader) -> Iterator[tuple[str, ElasticShaft]]:
    """Yield the shafts that are stated, and those between neighbouring throws."""
    if len(throws) > 1:
        path = "torsion.throw_shaft"
        if "throw_shaft" not in values:
            reader.add_error(path, ErrorMessage("missing", advice=('throw_shaft.stiffness = "1 MN*m/rad"',)))
            return
        for number, (before, after) in enumerate(itertools.pairwise(throws), start=1):
            yield f"crank_{number}", _shaft(values["throw_shaft"], (before, after), path, radius, reader)
    for name, item in values["shafts"].items():
        if item is not None and None not in item["between"] and len(item["between"]) == 2:
            first, second = item["between"]
            yield name, _shaft(item, (first, second), f"torsion.shafts.{name}", radius, reader)


def _shaft(values: Values, between: tuple[str, str], path: str, radius: float, reader: Reader) -> ElasticShaft:
    """Return a shaft; report sections that are no sections."""
    parts = [
        (f"{path}.parts[{number}]", part.made(ShaftPart))
        for number, part in enumerate(values["parts"], start=1)
        if part is not None and {"length", "diameter"} <= set(part)
    ]
    diameter, bore = values.si("diameter"), values.si("bore") or 0.0
    if "length" in values and diameter is not None:
        parts = [(path, ShaftPart(values.si("length"), diameter, bore))]
    if diameter is not None and bore >= diameter:
        reader.add_error(f"{path}.bore", ErrorMessage("torsion_bore"))
    for place, part in parts:
        if part.bore >= part.diameter and place != path:
            reader.add_error(f"{place}.bore", ErrorMessage("torsion_bore"))
    throw = None
    if "throw" in values and {"journal_length", "journal_diameter", "pin_length", "pin_diameter", "web_thickness",
                              "web_width"} <= set(values["throw"]):  # fmt: skip
        throw = values["throw"].made(Throw)
        if not throw.radius and not radius:
            reader.add_error(f"{path}.throw.radius", ErrorMessage("missing", advice=('radius = "60 mm"',)))
        for name in ("journal", "pin"):
            if getattr(throw, f"{name}_bore") >= getattr(throw, f"{name}_diameter"):
                reader.add_error(f"{path}.throw.{name}_bore", ErrorMessage("torsion_bore"))
    return ElasticShaft(
        path, between, values.si("stiffness"), tuple(part for _, part in parts), throw, values.si("modulus"),
        values.si("density"), int(values["elements"] or 0), values.si("damping"), float(values["loss_factor"]),
        diameter, bore,
    )  # fmt: skip


def _gear(values: Values) -> GearPair:
    first, second = values["between"]
    teeth = tuple(values["teeth"]) if len(values["teeth"]) == 2 else None
    return GearPair((first, second), teeth[0] / teeth[1] if teeth else float(values["ratio"]), teeth)


def _check(model: TorsionModel, reader: Reader) -> None:
    """Report names of discs that there are not, and what cannot vibrate."""
    _check_names(model, reader)
    for table in ("discs", "dampers"):
        for name in getattr(model, table):
            if name == GROUNDED or name in model.throws or (table == "dampers" and name in model.discs):
                reader.add_error(f"torsion.{table}.{name}", ErrorMessage("torsion_name", name=name))
    for name, gear in model.gears.items():
        if not gear.ratio:
            reader.add_error(f"torsion.gears.{name}.ratio", ErrorMessage("torsion_ratio"))
    if model.speeds is not None and model.speeds[0] >= model.speeds[1]:
        reader.add_error("torsion.speeds", ErrorMessage("torsion_speeds"))
    if not model.shafts:
        reader.add_error("torsion.shafts", ErrorMessage("torsion_empty"))
    if not reader.problems:
        _check_numbers(model, reader)


def _check_names(model: TorsionModel, reader: Reader) -> None:
    """Report names of discs that there are not, and shafts and gears between a disc and itself."""
    known = (*model.throws, *model.discs)
    pairs = [(item.path, item.between, (*known, GROUNDED)) for item in model.shafts.values()]
    pairs += [(f"torsion.gears.{name}", item.between, known) for name, item in model.gears.items()]
    named = [
        (f"{path}.between[{number}]", name, allowed)
        for path, pair, allowed in pairs
        for number, name in enumerate(pair, start=1)
    ]
    named += [(f"torsion.dampers.{name}.on", item.on, known) for name, item in model.dampers.items()]
    with_rings = (*known, *model.dampers)
    named += [
        (f"torsion.torques[{number}].disc", item.disc, with_rings) for number, item in enumerate(model.torques, 1)
    ]
    for path, name, allowed in named:
        if name not in allowed:
            reader.add_error(path, ErrorMessage("torsion_no_disc", name=name, known=", ".join(known)))
    for path, pair, _ in pairs:
        if pair[0] == pair[1]:
            reader.add_error(f"{path}.between", ErrorMessage("torsion_itself", name=pair[0]))


def _check_joined(model: TorsionModel, reader: Reader) -> None:
    """Report discs that nothing joins to the others, and rings of shafts and gears in which nothing can turn."""
    ends = [(item.path, item.between, 1.0) for item in model.shafts.values()]
    ends += [(f"torsion.gears.{name}", item.between, item.ratio) for name, item in model.gears.items()]
    ends += [(path, (second, first), 1 / ratio) for path, (first, second), ratio in ends]
    speed, parts = dict[str, float](), list[tuple[list[str], bool]]()
    for start in (*model.throws, *model.discs):
        if start in speed:
            continue
        speed[start], part, closing = 1.0, [start], ""
        for name in part:
            for path, other, ratio in ((path, pair[1], ratio) for path, pair, ratio in ends if pair[0] == name):
                if other != GROUNDED and speed.setdefault(other, speed[name] * ratio) and other not in part:
                    part.append(other)
                closing = path if not math.isclose(speed.get(other, 0.0), speed[name] * ratio) else closing
        held = any(GROUNDED in pair for _, pair, _ in ends if {*part} & {*pair})
        parts.append((part, held))
        if closing and not held:
            reader.add_error(closing, ErrorMessage("torsion_ring"))
    main, is_main_held = max(parts, key=lambda item: len(item[0]), default=([""], False))
    for (name, *_), held in ((part, held) for part, held in parts if part is not main):
        if not (held and is_main_held):
            path = f"torsion.discs.{name}" if name in model.discs else "torsion.shafts"
            reader.add_error(path, ErrorMessage("torsion_loose", name=name, other=main[0]))


def _check_numbers(model: TorsionModel, reader: Reader) -> None:
    """Report discs that hang on nothing, gears in a ring, a system that does not vibrate, and modes it has not."""
    structure = structure_of(replace(model, dampers={}))
    if len(set(structure.groups)) != structure.discs - len(structure.gears):
        reader.add_error("torsion.gears", ErrorMessage("torsion_gear_ring"))
    _check_joined(model, reader)
    heavy = any(disc.inertia or disc.mass for disc in model.discs.values()) or model.throws
    if not heavy and not any(shaft.density for shaft in model.shafts.values()):
        reader.add_error("torsion.discs", ErrorMessage("torsion_massless"))
    massive = {name for name, disc in model.discs.items() if disc.inertia or disc.mass} | {*model.throws}
    massive |= {name for shaft in model.shafts.values() if shaft.density for name in shaft.between}
    groups = {group for name, group in zip(walked(model), structure.groups, strict=False) if name in massive}
    light = len(set(structure.groups)) - len(groups)
    count = NaturalModes(structure, _MOST).count - light
    if not reader.problems and count < 1:
        reader.add_error("torsion.discs", ErrorMessage("torsion_no_mode"))
    for name, damper in model.dampers.items():
        if 0 < count < damper.mode:
            reader.add_error(f"torsion.dampers.{name}.mode", ErrorMessage("torsion_mode", count=str(count)))
