"""Joint forces at change points: the limit common to both sides, where there is one."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev

from crankwork.dynamics.reaction import GuideForce, PinForce, Reaction
from crankwork.formula.known import Known, Pieces, Table
from crankwork.formula.replay import Program
from crankwork.kinematics.bridges import BEYOND
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.mechanism.joints import Joint
from crankwork.mechanism.passage import ChangePointFit, ChangePointPassage, Polynomial

_DEGREE, _NODES = 12, 40
# forces lose one digit more than the motion that they follow: they are taken a little farther off
_NEAREST, _REACH = 0.25, 1.5
_SMOOTH = 1e-8
# where there is no common limit, nothing is told of the change point itself [deg]
_ITSELF = 1e-6


def bridged_forces(reactions: dict[Joint, Reaction], passage: ChangePointPassage) -> dict[Joint, Reaction]:
    """Return remembered reactions of a dyad that passes change points; numbers stay as they are."""
    if not all(isinstance(value, Known) for one in reactions.values() for value in one[1:]):
        return reactions
    columns: dict[str, Known] = {
        f"{number}.{at}": value for number, one in enumerate(reactions.values()) for at, value in enumerate(one[1:])
    }
    varying = {key: one for key, one in columns.items() if one.varies}
    ends: list[float] = []
    laws: dict[str, list[Known]] = {key: [] for key in varying}
    for bridge in passage.bridges:
        nodes = _nodes(bridge)
        values = Program(varying)(CrankGrid.from_degrees(bridge.degrees + nodes))
        # a force that is nothing beside the others is not smooth, for rounding
        width, spare = bridge.width, _SMOOTH * max(float(np.max(np.abs(one))) for one in values.values())
        found = {key: _limit(bridge.degrees, nodes, one, spare) for key, one in values.items()}
        if any(one is None for one in found.values()):
            width, unknown = _ITSELF, Polynomial(bridge.degrees, _ITSELF, (np.nan,))
            found = dict.fromkeys(values, unknown)
        ends += [bridge.degrees - width, bridge.degrees + width]
        for key, law in found.items():
            if law is not None:
                laws[key] += [varying[key], Known(Table(law, "change_point"), varying[key].key)]
    for key, one in varying.items():
        columns[key] = Known(Pieces([*ends, BEYOND], (*laws[key], one)), one.key)
    result: dict[Joint, Reaction] = {}
    for number, reaction in enumerate(reactions.values()):
        first, second = columns[f"{number}.0"], columns[f"{number}.1"]
        if isinstance(reaction, PinForce):
            result[reaction.joint] = PinForce(reaction.joint, first, second)
        else:
            result[reaction.joint] = GuideForce(reaction.joint, first, second)
    return result


def _nodes(bridge: ChangePointFit) -> Array:
    """Return angles on both sides of a change point, less it. [deg]"""
    near, far = _NEAREST * bridge.width, _REACH * bridge.width
    nodes = np.cos(np.pi * (2 * np.arange(_NODES // 2) + 1) / _NODES)
    beside = np.sqrt((near**2 + far**2) / 2 + (far**2 - near**2) / 2 * nodes)
    return np.concatenate([-beside, beside[::-1]])


def _limit(degrees: float, nodes: Array, values: Array, spare: float) -> Polynomial | None:
    """Return the polynomial through values on both sides of a change point, or None if it misses one by too much."""
    reach = float(np.max(np.abs(nodes)))
    powers = chebyshev.chebvander(nodes / reach, _DEGREE)
    found = np.linalg.lstsq(powers, values, rcond=None)[0]
    if not np.max(np.abs(powers @ found - values)) <= spare:
        return None
    return Polynomial(degrees, reach, tuple(map(float, found)))
