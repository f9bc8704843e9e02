"""What a description states of the loads on a linkage, as names and numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.loads.load import Load
from crankwork.loads.process import ForceOnPoint, ProcessForce, ProcessForceAtPoint, TorqueOnLink
from crankwork.loads.spring import SliderSpring, Spring
from crankwork.loads.weight import Weight
from crankwork.machine import Machine


class StatedLoad(NamedTuple):
    """A load as a description states it."""

    kind: str  # `slider`, `point`, `force`, `torque`, `spring`, `slider_spring` or `weight`
    names: Mapping[str, str]  # What it acts on: `name`, and the `other` end of a spring
    # Values and the units in which they are told; of a table its largest, none of a law that is a program [SI]
    amounts: Mapping[str, tuple[float | None, str]]


def stated_loads(machine: Machine) -> tuple[StatedLoad, ...]:
    """Return the loads of a linkage as its description states them."""
    return tuple(_stated(one) for one in machine.loads)


def _stated(load: Load) -> StatedLoad:
    match load:
        case ProcessForce():
            return StatedLoad("slider", {"name": load.slider}, {"force": (_largest(load.force), "N")})
        case ProcessForceAtPoint():
            return StatedLoad("point", {"name": load.point}, {"force": (_largest(load.force), "N")})
        case ForceOnPoint():
            return StatedLoad("force", {"name": load.point}, {"x": (load.x, "N"), "y": (load.y, "N")})
        case TorqueOnLink():
            return StatedLoad("torque", {"name": load.link}, {"torque": (_largest(load.torque), "N*m")})
        case Spring():
            amounts = {"stiffness": (load.stiffness, "N/m"), "free": (load.free_length, "mm")}
            return StatedLoad("spring", {"name": load.start, "other": load.end}, amounts)
        case SliderSpring():
            return StatedLoad("slider_spring", {"name": load.slider}, {"stiffness": (load.stiffness, "N/m")})
        case Weight():
            return StatedLoad("weight", {}, {"gravity": (load.gravity, "m/s2")})


def _largest(force: object) -> float | None:
    """Return the largest value of a constant or of a table, nothing of a law that is a program."""
    values = getattr(force, "values", force)
    return None if callable(values) else float(np.max(np.abs(np.asarray(values, dtype=float))))
