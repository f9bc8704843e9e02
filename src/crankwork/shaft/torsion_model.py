"""A torsional system as a machine file states it: discs, shafts, gears, dampers, torques that excite it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from crankwork.shaft.torsional_system import GROUND, TorsionalStructure

GROUNDED = "ground"


class Disc(NamedTuple):
    """A disc: its inertia, or its mass and radius of gyration, and what damps it against the ground."""

    inertia: float | None = None  # [kg m2]
    mass: float | None = None  # [kg]
    radius_of_gyration: float | None = None  # [m]
    damping: float = 0.0  # [N m s/rad]


class ShaftPart(NamedTuple):
    """A part of a shaft of one section."""

    length: float  # [m]
    diameter: float  # [m]
    bore: float = 0.0  # [m]


class Throw(NamedTuple):
    """Sizes of a crank throw, and the formula of its stiffness. [m]"""

    formula: str
    journal_length: float
    journal_diameter: float
    pin_length: float
    pin_diameter: float
    web_thickness: float
    web_width: float
    journal_bore: float = 0.0
    pin_bore: float = 0.0
    radius: float | None = None  # That of the crank of the machine where it is not stated


class ElasticShaft(NamedTuple):
    """A shaft between two discs: its stiffness, or what that follows from; `path` in the file."""

    path: str
    between: tuple[str, str]
    stiffness: float | None = None  # [N m/rad]
    parts: tuple[ShaftPart, ...] = ()
    throw: Throw | None = None
    modulus: float | None = None  # Of itself, otherwise that of the system [Pa]
    density: float | None = None  # Of a shaft whose own mass counts [kg/m3]
    elements: int = 0  # 0 for polynomials along it
    damping: float = 0.0  # [N m s/rad]
    loss_factor: float = 0.0
    diameter: float | None = None  # Where the stress is asked for, if no part has it [m]
    bore: float = 0.0  # [m]


class GearPair(NamedTuple):
    """Two discs in mesh: speed of the second over that of the first, stated or by numbers of teeth."""

    between: tuple[str, str]
    ratio: float
    teeth: tuple[float, float] | None = None


class Damper(NamedTuple):
    """A ring on a disc, held by damping, and in a tuned damper by a spring."""

    on: str
    inertia: float  # [kg m2]
    damping: float = 0.0  # [N m s/rad]
    stiffness: float = 0.0  # [N m/rad]
    mode: int = 1  # Number of the mode that it is made for


class ExcitingTorque(NamedTuple):
    """A harmonic torque on a disc: of an order of the speed, or of a frequency."""

    disc: str
    torque: float  # Amplitude [N m]
    order: float | None = None
    frequency: float | None = None  # [rad/s]
    phase: float = 0.0  # By which it is ahead of a cosine [rad]


@dataclass(frozen=True)
class TorsionModel:
    """What a machine file states of a torsional system; discs of throws are not among `discs`."""

    discs: Mapping[str, Disc] = field(default_factory=dict)
    shafts: Mapping[str, ElasticShaft] = field(default_factory=dict)
    gears: Mapping[str, GearPair] = field(default_factory=dict)
    dampers: Mapping[str, Damper] = field(default_factory=dict)
    torques: tuple[ExcitingTorque, ...] = ()
    modulus: float = 80e9  # [Pa]
    reference_diameter: float | None = None  # [m]
    throws: tuple[str, ...] = ()  # Names of the discs that stand for the throws of a crankshaft
    throw_inertia: float = 0.0  # Of a throw beside what the machine states [kg m2]
    trials: tuple[float, ...] = ()  # Frequencies of tables by Holzer [rad/s]
    speeds: tuple[float, float] | None = None  # [rad/s]
    orders: float = 12.0  # Highest order
    modes: int = 10  # How many are listed at most


def walked(model: TorsionModel) -> tuple[str, ...]:
    """Return the names of the discs along the shaft, from the first one that is at an end; rings of dampers last."""
    names = (*model.throws, *model.discs)
    neighbours: dict[str, list[str]] = {name: [] for name in names}
    pairs = [*(shaft.between for shaft in model.shafts.values()), *(gear.between for gear in model.gears.values())]
    for first, second in pairs:
        if GROUNDED not in (first, second):
            neighbours[first].append(second)
            neighbours[second].append(first)
    done, order = set[str](), list[str]()
    for start in (*(name for name in names if len(neighbours[name]) == 1), *names):
        stack = [start]
        while stack:
            name = stack.pop()
            if name not in done:
                done.add(name)
                order.append(name)
                stack += [other for other in reversed(neighbours[name]) if other not in done]
    held = {name: damper.stiffness > 0 for name, damper in model.dampers.items()}
    return (*order, *(name for name in held if held[name]), *(name for name in held if not held[name]))


def structure_of(model: TorsionModel) -> TorsionalStructure:
    """Return what is joined to what; shafts and springs of dampers first, then dampers without springs."""
    number = {name: index for index, name in enumerate(walked(model))} | {GROUNDED: GROUND}
    dampers = sorted(model.dampers.items(), key=lambda item: item[1].stiffness <= 0)
    pairs = [*(shaft.between for shaft in model.shafts.values()), *((item.on, name) for name, item in dampers)]
    elements = [None if shaft.density is None else shaft.elements for shaft in model.shafts.values()]
    return TorsionalStructure(
        len(number) - 1,
        tuple((number[a], number[b]) for a, b in pairs),
        tuple((number[a], number[b]) for a, b in (gear.between for gear in model.gears.values())),
        (*elements, *([None] * len(dampers))),
        sum(damper.stiffness <= 0 for damper in model.dampers.values()),
    )
