"""Tooth forces between the wheel of a driving crank and those of geared cranks.

The wheels touch where both have the same velocity: on the line of centres, between the axes if they turn in opposite
senses, beyond one of them if the other is a ring.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from crankwork.dynamics.dyad_forces import force_along_x, force_along_y
from crankwork.dynamics.link_loads import Wrenches
from crankwork.formula.expression import Value, formula
from crankwork.formula.known import Known, Pieces, is_known, named
from crankwork.kinematics.memory import interpolant_of
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.driver import GearedCrank
from crankwork.mechanism.mechanism import Crank

_SOURCE = "artobolevsky_1988, ch. 13"


class Mesh(NamedTuple):
    """The force on the teeth of a geared crank, across the line of centres and along it, arrays of shape (n,). [N]"""

    link: str
    across: Value  # To the left of the direction from the driving pivot to its own
    separating: Value  # Away from the other teeth, never negative
    # Along the fixed axes
    x: Value
    y: Value


class Centres(NamedTuple):
    """The line of centres of two wheels: its length, and its direction from the driving wheel. [m]"""

    distance: Value
    cos: Value
    sin: Value


@formula("link_length", _SOURCE)
def centre_distance(r_x: Value, r_y: Value) -> Value:
    """Distance of the axes of two wheels."""
    return np.sqrt(r_x**2 + r_y**2)


@formula("tooth_force", _SOURCE)
def tooth_force(M_1: Value, i_g: Value, a_w: Value) -> Value:
    """Force between teeth across the line of centres, from the moment of what the wheel of a geared crank carries."""
    return M_1 * (1 - i_g) / a_w


@formula("separating_force", _SOURCE)
def separating_force(F_z: Value, mu_p: Value) -> Value:
    """Force between teeth along the line of centres, where that across it is positive."""
    return F_z * np.tan(mu_p)


def centres(crank: Crank, geared: GearedCrank) -> Centres:
    """Return the line of centres of the wheels of two cranks."""
    x, y = (its - mine for its, mine in zip(geared.pivot, crank.pivot, strict=True))
    distance = named(centre_distance(x, y), f"link_length.{geared.link}.centres")
    return Centres(
        distance,
        named(x / distance, f"line_cos.{geared.link}.centres"),
        named(y / distance, f"line_sin.{geared.link}.centres"),
    )


def meshes(crank: Crank, motion: Motion, wrenches: Wrenches) -> Iterator[Mesh]:
    """Yield the forces on the teeth of geared cranks whose pressure angle is given.

    `wrenches`: on every link, without bearings and teeth.
    """
    for geared in crank.geared:
        if geared.pressure_angle is None:
            continue
        line, moment = centres(crank, geared), wrenches[geared.link].moment
        if is_known(moment) and moment.is_absent:
            continue
        across = named(tooth_force(moment, geared.ratio, line.distance), f"tooth_force.{geared.link}")
        separating = _separating_force(across, geared, motion)
        along = -separating if _is_inside(geared) else separating
        x = named(force_along_x(along, line.cos, across, line.sin), f"joint_force_x.{geared.link}.teeth")
        y = named(force_along_y(along, line.sin, across, line.cos), f"joint_force_y.{geared.link}.teeth")
        yield Mesh(geared.link, across, separating, x, y)


def _is_inside(geared: GearedCrank) -> bool:
    """Return whether one of the wheels is a ring, so that teeth push the other towards its centre."""
    ratio: Any = geared.ratio
    return bool((ratio.value if is_known(ratio) else ratio) > 0)


def _separating_force(across: Value, geared: GearedCrank, motion: Motion) -> Value:
    """Return the force that separates the wheels, on either flank."""
    angle, key = geared.pressure_angle, f"separating_force.{geared.link}"
    if not is_known(across):
        return separating_force(np.abs(across), angle)
    push, pull = named(separating_force(across, angle), key), named(separating_force(-across, angle), key)
    if not across.varies:
        return push if across.value >= 0 else pull
    ends, is_pull = interpolant_of(motion.grid)({"": across}).stretches("")
    return Known(Pieces(ends, tuple(pull if is_pulling else push for is_pulling in is_pull)), key)


def on_cranks(crank: Crank, meshes_by_link: Mapping[str, Mesh]) -> dict[str, tuple[Value, Value]]:
    """Return the tooth forces on the crank and the geared cranks, along the fixed axes. [N]"""
    forces: dict[str, tuple[Value, Value]] = {name: (item.x, item.y) for name, item in meshes_by_link.items()}
    for mesh in meshes_by_link.values():
        x, y = forces.get(crank.link, (0.0, 0.0))
        forces[crank.link] = (x - mesh.x, y - mesh.y)
    return forces
