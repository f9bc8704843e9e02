"""Joint forces at change points: the common limit of both sides, where there is one."""

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
# forces lose one digit more than the motion they follow from: their nodes lie farther off
_NEAREST, _REACH = 0.25, 1.5
_SMOOTH = 1e-8
# without a common limit, the change point itself has no value [deg]
_ANGLE_TOLERANCE = 1e-6


def bridged_forces(reactions: dict[Joint, Reaction], passage: ChangePointPassage) -> dict[Joint, Reaction]:
    """Return traced reactions of a dyad that passes change points; numbers stay as they are."""
    if not all(isinstance(value, Known) for force in reactions.values() for value in force[1:]):
        return reactions
    columns: dict[str, Known] = {
        f"{number}.{index}": value
        for number, force in enumerate(reactions.values())
        for index, value in enumerate(force[1:])
    }
    varying = {key: column for key, column in columns.items() if column.varies}
    ends: list[float] = []
    laws: dict[str, list[Known]] = {key: [] for key in varying}
    for bridge in passage.bridges:
        nodes = _nodes(bridge)
        values = Program(varying)(CrankGrid.from_degrees(bridge.degrees + nodes))
        # a force that is negligible against the others is rough from rounding
        width, tolerance = bridge.width, _SMOOTH * max(float(np.max(np.abs(value))) for value in values.values())
        fits = {key: _limit(bridge.degrees, nodes, value, tolerance) for key, value in values.items()}
        if any(fit is None for fit in fits.values()):
            width, unknown = _ANGLE_TOLERANCE, Polynomial(bridge.degrees, _ANGLE_TOLERANCE, (np.nan,))
            fits = dict.fromkeys(values, unknown)
        ends += [bridge.degrees - width, bridge.degrees + width]
        for key, law in fits.items():
            if law is not None:
                laws[key] += [varying[key], Known(Table(law, "change_point"), varying[key].key)]
    for key, traced in varying.items():
        columns[key] = Known(Pieces([*ends, BEYOND], (*laws[key], traced)), traced.key)
    result: dict[Joint, Reaction] = {}
    for number, reaction in enumerate(reactions.values()):
        first, second = columns[f"{number}.0"], columns[f"{number}.1"]
        if isinstance(reaction, PinForce):
            result[reaction.joint] = PinForce(reaction.joint, first, second)
        else:
            result[reaction.joint] = GuideForce(reaction.joint, first, second)
    return result


def _nodes(bridge: ChangePointFit) -> Array:
    """Return angles on both sides of a change point, relative to it. [deg]"""
    near, far = _NEAREST * bridge.width, _REACH * bridge.width
    nodes = np.cos(np.pi * (2 * np.arange(_NODES // 2) + 1) / _NODES)
    offsets = np.sqrt((near**2 + far**2) / 2 + (far**2 - near**2) / 2 * nodes)
    return np.concatenate([-offsets, offsets[::-1]])


def _limit(degrees: float, nodes: Array, values: Array, tolerance: float) -> Polynomial | None:
    """Return the polynomial through values on both sides of a change point, or None if its error is too large."""
    reach = float(np.max(np.abs(nodes)))
    powers = chebyshev.chebvander(nodes / reach, _DEGREE)
    coefficients = np.linalg.lstsq(powers, values, rcond=None)[0]
    if not np.max(np.abs(powers @ coefficients - values)) <= tolerance:
        return None
    return Polynomial(degrees, reach, tuple(map(float, coefficients)))
