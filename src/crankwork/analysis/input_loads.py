"""What a description states of the loads on a linkage, as names and numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.loads.chamber import Chamber, face_names
from crankwork.loads.load import (
    Damper,
    ForceOnPoint,
    Load,
    ProcessForce,
    SliderDamper,
    SliderSpring,
    Spring,
    TorqueOnLink,
    Weight,
)
from crankwork.machine import Machine
from crankwork.mechanism.joints import names_of_pivots


class LoadInput(NamedTuple):
    """A load as a description states it."""

    kind: str  # `slider`, `point`, `force`, `torque`, `spring`, `damper`, either with `slider_`, or `weight`
    names: Mapping[str, str]  # What it acts on: `name`, and the `other` end of a spring or damper
    # Values and the units in which they are displayed; the largest of a table, None for a program [SI]
    amounts: Mapping[str, tuple[float | None, str]]


def stated_loads(machine: Machine) -> tuple[LoadInput, ...]:
    """Return the loads of a linkage as its description states them."""
    return tuple(_stated(load) for load in machine.loads)


def _stated(load: Load) -> LoadInput:
    match load:
        case ProcessForce():
            return LoadInput("slider", {"name": load.slider}, {"force": (_largest(load.force), "N")})
        case ForceOnPoint():
            return LoadInput("force", {"name": load.point}, {"x": (load.x, "N"), "y": (load.y, "N")})
        case TorqueOnLink():
            return LoadInput("torque", {"name": load.link}, {"torque": (_largest(load.torque), "N*m")})
        case Spring():
            amounts = {"stiffness": (load.stiffness, "N/m"), "free": (load.free_length, "mm")}
            return LoadInput("spring", {"name": load.start, "other": load.end}, amounts)
        case SliderSpring():
            return LoadInput("slider_spring", {"name": load.slider}, {"stiffness": (load.stiffness, "N/m")})
        case Damper():
            amounts = {"damping": (load.damping, "N*s/m")}
            return LoadInput("damper", {"name": load.start, "other": load.end}, amounts)
        case SliderDamper():
            return LoadInput("slider_damper", {"name": load.slider}, {"damping": (load.damping, "N*s/m")})
        case Weight():
            return LoadInput("weight", {}, {"gravity": (load.gravity, "m/s2")})
    return LoadInput("program", {"name": type(load).__name__}, {})


def _largest(force: object) -> float | None:
    """Return the largest value of a constant or of a table, None for a law that is a program."""
    values = getattr(force, "values", force)
    return None if callable(values) else float(np.max(np.abs(np.asarray(values, dtype=float))))


class FrictionInput(NamedTuple):
    """A joint with friction as a description states it."""

    name: str
    amounts: Mapping[str, tuple[float, str]]  # Values by key of quantity, and the units of their display [SI]


def stated_friction(machine: Machine) -> tuple[FrictionInput, ...]:
    """Return the joints with friction of a linkage as its description states them."""
    if not machine.friction:
        return ()
    # linkages without friction do not load it
    from crankwork.analysis.joint_friction import STATED  # noqa: PLC0415
    from crankwork.dynamics.friction import PinFriction  # noqa: PLC0415

    shown = names_of_pivots(machine.mechanism)
    result = []
    for item in machine.friction:
        amounts = {key: (getattr(item, field), unit) for field, (key, unit) in STATED[type(item)].items()}
        name = shown.get(item.joint, item.joint) if isinstance(item, PinFriction) else item.slider
        result.append(FrictionInput(name, {key: value for key, value in amounts.items() if value[0]}))
    return tuple(result)


class ChamberInput(NamedTuple):
    """A chamber as a description states it."""

    name: str
    faces: tuple[tuple[str, int], ...]  # Sliding pieces and the senses in which they move
    owners: tuple[str, ...]  # What follows a key in the name of what belongs to each face
    ambient: float  # Pressure on the other side [Pa]
    kind: str  # Where its pressure comes from: `charge`, `constant`, `valves`, `samples`, `heat`, `cycle` or `laws`
    names: Mapping[str, str]  # The `name` of the charge, the `file` of samples, or the `count` of laws
    amounts: Mapping[str, tuple[float, str]]  # Values and the units in which they are told [SI]
    factor: float = 1.0  # Of its gauge pressure
    delay: float = 0.0  # By which its diagram comes later [rad]


class ChargeInput(NamedTuple):
    """What is sealed in chambers as a description states it."""

    name: str
    chambers: tuple[str, ...]
    dead_volumes: tuple[tuple[float, float | None], ...]  # Volumes, and temperatures if they have one [m3], [K]
    exponent: float | None  # That of a polytrope


def stated_chambers(machine: Machine) -> tuple[ChamberInput, ...]:
    """Return the chambers of a linkage as its description states them."""
    return tuple(_stated_chamber(name, value, machine) for name, value in machine.chambers.items())


def stated_charges(machine: Machine) -> tuple[ChargeInput, ...]:
    """Return the gas charges sealed in the chambers of a linkage."""
    return tuple(
        ChargeInput(
            name, value.chambers, tuple((dead.volume, dead.temperature) for dead in value.dead_volumes), value.exponent
        )
        for name, value in machine.charges.items()
    )


def _stated_chamber(name: str, chamber: Chamber, machine: Machine) -> ChamberInput:
    charge = next((key for key, value in machine.charges.items() if name in value.chambers), "")
    names, amounts = dict[str, str](), dict[str, tuple[float, str]]()
    if charge:
        kind, names = "charge" if chamber.temperature is None else "charge_at", {"name": charge}
        amounts = {} if chamber.temperature is None else {"temperature": (chamber.temperature, "K")}
    elif chamber.pressure is not None:
        kind, amounts = "constant", {"pressure": (chamber.pressure, "MPa")}
    elif chamber.valves is not None:
        kind = "valves"
        amounts = {"suction": (chamber.valves.suction, "MPa"), "discharge": (chamber.valves.discharge, "MPa")}
    elif chamber.measured is not None:
        kind, names = "samples", {"file": chamber.measured.file or "–"}
    elif chamber.calculated is not None:
        kind = "cycle" if chamber.calculated.has_corners else "heat"
        amounts = {"cycle": (math.radians(chamber.cycle), "deg")}
    else:
        kind, names = "laws", {"count": str(len(chamber.pieces))}
        law = machine.mechanism.driver.law
        amounts = {"cycle": (math.radians(chamber.cycle), "deg") if law is None else (law.period, "s")}
    return ChamberInput(
        name, tuple((face.slider, face.sense) for face in chamber.faces), face_names(name, chamber), chamber.ambient,
        kind, names, amounts, chamber.factor, math.radians(chamber.delay),
    )  # fmt: skip
