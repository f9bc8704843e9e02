"""From the values of a machine file to masses on a shaft in given planes."""

from __future__ import annotations

import math
import string
from collections.abc import Sequence
from dataclasses import replace

from crankwork.cylinders.planes import PlaneMass, Rotor, Sector, arrangements, sector_moment
from crankwork.description.build import build_method, crank_speed
from crankwork.description.schema import Values
from crankwork.description.stated import stated_numbers
from crankwork.description.value_types import Reader
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank, Mechanism


def build_rotor(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of masses on a shaft, or None after complaints."""
    method, table = build_method(values["method"], reader), values["rotor"]
    if not method.is_exact:
        reader.add_error("method.kinematics", ErrorMessage("turning_exact"))
    train, crank = table["locomotive"], values["crank"]
    speed = crank_speed(crank["speed"], method) if "speed" in crank else None
    if {"speed", "wheel_diameter"} <= set(train):
        if speed is not None:
            reader.add_error("rotor.locomotive.speed", ErrorMessage("same", others=["crank.speed"]))
        speed = 2 * train.si("speed") / train.si("wheel_diameter") * math.pi / method.pi
    rotor = None if reader.problems else _rotor(table, reader)
    try:
        states = arrangements(rotor) if rotor is not None and not reader.problems else []
        if rotor is not None and states and rotor.arrangement > len(states):
            reader.add_error("rotor.arrangement", ErrorMessage("rotor_arrangement", count=len(states)))
        elif rotor is not None and states:
            _check_sectors(rotor, states[rotor.arrangement - 1].sizes.tolist(), reader)
    except CrankworkError as error:
        reader.add_error("rotor.masses", error.args[0])
    if rotor is None or reader.problems:
        return None
    return Machine(
        Mechanism(Crank(radius=0.0), ()),
        speed=speed or 1.0,
        title=values["title"] or "",
        rotor=replace(rotor, has_speed=speed is not None),
        method=method,
        table_step=values["table"].degrees("step"),
        table_special=tuple(values["table"].degrees("special_angles")),
        stated=stated_numbers(values),
    )


def _check_sectors(rotor: Rotor, sizes: Sequence[float], reader: Reader) -> None:
    """Report sectors that are wanted and too small for their moments."""
    for number, (mass, needed) in enumerate(zip(rotor.masses, sizes, strict=True), start=1):
        if mass.sector is not None and mass.sector.angle is None:
            most = float(sector_moment(*vars(replace(mass.sector, angle=math.pi)).values()))
            if needed > most:
                path = f"rotor.masses[{number}].sector"
                reader.add_error(path, ErrorMessage("rotor_sector", most=most, needed=needed))


def _rotor(table: Values, reader: Reader) -> Rotor:
    """Return the masses; report names and positions that do not fit together, and shares of nothing."""
    train, masses = table["locomotive"], list[PlaneMass]()
    for number, entry in enumerate(table["masses"]):
        path = f"rotor.masses[{number + 1}]"
        name = entry["name"] or string.ascii_uppercase[number % 26] + str(number // 26 or "")
        if name in {mass.name for mass in masses}:
            reader.add_error(f"{path}.name", ErrorMessage("rotor_name", name=name))
        ring = entry["sector"].made(Sector) if "sector" in entry else None
        if ring is not None and ring.inner_radius >= ring.outer_radius:
            reader.add_error(f"{path}.sector.inner_radius", ErrorMessage("rotor_ring"))
        if table["kind"] == "reciprocating" and "reciprocating" in entry:
            reader.add_error(f"{path}.reciprocating", ErrorMessage("rotor_mass"))
        pistons = entry.si("reciprocating") or 0.0
        masses.append(entry.made(PlaneMass, name=name, sector=ring, reciprocating=pistons))
    rotor = Rotor(
        tuple(masses),
        table["kind"],
        table["reciprocating_share"] or 0.0,
        table.si("rod_length"),
        table.si("reference"),
        tuple(place.value for place in table["bearings"] or ()),
        int(train["coupled"]) if "locomotive" in table else 0,
        (train.si("wheel_diameter"), train.si("wheel_load")),
        int(table["arrangement"]),
    )
    if rotor.bearings and (len(set(rotor.bearings)) == 1 or rotor.is_flat):
        reader.add_error("rotor.bearings", ErrorMessage("rotor_bearings"))
    # the share is an idle key
    has_pistons = rotor.kind != "reciprocating" and any(mass.reciprocating for mass in masses)
    if "locomotive" in table and not has_pistons:
        reader.add_error("rotor.locomotive", ErrorMessage("rotor_no_pistons"))
    return rotor
