"""Forces between the teeth of a driving crank's wheel and those of the cranks that it turns.

The wheels touch where both move alike: on the line of their centres, between them where they turn against each other,
beyond one of them where the other is a ring.
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
    across: Value  # To the left of the way from the driving pivot to its own
    apart: Value  # Away from the other teeth, never negative
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


def centres(crank: Crank, one: GearedCrank) -> Centres:
    """Return the line of centres of the wheels of two cranks."""
    x, y = (its - mine for its, mine in zip(one.pivot, crank.pivot, strict=True))
    distance = named(centre_distance(x, y), f"link_length.{one.link}.centres")
    return Centres(
        distance,
        named(x / distance, f"line_cos.{one.link}.centres"),
        named(y / distance, f"line_sin.{one.link}.centres"),
    )


def meshes(crank: Crank, motion: Motion, wrenches: Wrenches) -> Iterator[Mesh]:
    """Yield the forces on the teeth of geared cranks whose pressure angle is given.

    `wrenches`: what acts on every link but its bearings and teeth.
    """
    for one in crank.geared:
        if one.pressure_angle is None:
            continue
        line, moment = centres(crank, one), wrenches[one.link].moment
        if is_known(moment) and moment.is_absent:
            continue
        across = named(tooth_force(moment, one.ratio, line.distance), f"tooth_force.{one.link}")
        apart = _apart(across, one, motion)
        along = -apart if _is_inside(one) else apart
        x = named(force_along_x(along, line.cos, across, line.sin), f"joint_force_x.{one.link}.teeth")
        y = named(force_along_y(along, line.sin, across, line.cos), f"joint_force_y.{one.link}.teeth")
        yield Mesh(one.link, across, apart, x, y)


def _is_inside(one: GearedCrank) -> bool:
    """Return whether one of the wheels is a ring, in which the other is pushed towards its centre."""
    ratio: Any = one.ratio
    return bool((ratio.value if is_known(ratio) else ratio) > 0)


def _apart(across: Value, one: GearedCrank, motion: Motion) -> Value:
    """Return the force that separates the wheels, whichever flanks touch."""
    angle, key = one.pressure_angle, f"separating_force.{one.link}"
    if not is_known(across):
        return separating_force(np.abs(across), angle)
    push, pull = named(separating_force(across, angle), key), named(separating_force(-across, angle), key)
    if not across.varies:
        return push if across.value >= 0 else pull
    ends, is_pull = interpolant_of(motion.grid)({"": across}).stretches("")
    return Known(Pieces(ends, tuple(pull if one else push for one in is_pull)), key)


def on_cranks(crank: Crank, found: Mapping[str, Mesh]) -> dict[str, tuple[Value, Value]]:
    """Return what teeth put on the crank and on the geared ones, along the fixed axes. [N]"""
    forces: dict[str, tuple[Value, Value]] = {name: (one.x, one.y) for name, one in found.items()}
    for one in found.values():
        x, y = forces.get(crank.link, (0.0, 0.0))
        forces[crank.link] = (x - one.x, y - one.y)
    return forces
