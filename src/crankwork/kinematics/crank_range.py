"""The range of the crank of a linkage, the change points in it, and polynomials that replace formulas near them.

At a change point the two branches of a dyad meet and its formulas are 0/0; near it they lose digits with the square of
the distance. The motion itself is smooth there, so that polynomials through positions farther off, on one branch before
and on the other after it, give it to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from crankwork.errors import GeometryError
from crankwork.kinematics.circuits import Circuit, CircuitPart, assembled_stretches, circuit_through
from crankwork.kinematics.configuration_curve import Configurations, driver_coordinate
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import LinkMotion, rotated_frame
from crankwork.kinematics.position_analysis import assembled, place
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import RPR, RRP, RRR, Branch, Chain, ChangePointFit, ChangePointPassage, Polynomial
from crankwork.mechanism.mechanism import Crank, Mechanism

_DENSE = CrankGrid.steps(1.0, 360.0)
_HEALTHY = 1e-3
_SAME = 1e-6
# a change point this close to the end of a period is at the end: rounding of lengths moves it [deg]
_AT_END = 0.01
# distance in longest lengths beyond which a link goes to infinity
_RAN_AWAY = 100.0
_NEAR = 0.05
_BETWEEN = 400
_PROBE_OFFSETS = (0.15, 0.08, 0.05)
_TOUCHES = 1e-7
_DEGREE = 12
_NODES = 80
_REACHES = 45.0 * 0.75 ** np.arange(14)
# nodes nearest to the change point lose the most digits, as do the formulas at the ends of the polynomials
_NEAREST = 1 / 6
_USED = 1 / 2
# the widest reach is used whose last orders change little more than those of the best
_ENOUGH, _ROUNDING = 4.0, 5e-14


class CrankRange(NamedTuple):
    """The branch of a linkage with its stated position: from dead position to dead position of the crank."""

    circuit: Circuit
    branch: CircuitPart
    start: float  # Least and greatest crank angle [deg]
    end: float
    turns: int  # Turns of the crank in a period; 0 if it turns back
    changes: tuple[float, ...]  # Crank angles of the change points in it [deg]
    stated: float  # Crank angle at which the branch was chosen [deg]

    @property
    def is_whole(self) -> bool:
        """Whether the crank turns fully."""
        return self.turns > 0


def has_steady_crank(mechanism: Mechanism) -> bool:
    """Return whether a crank drives without a motion law."""
    return isinstance(mechanism.driver, Crank) and mechanism.driver.law is None


def turns_fully(mechanism: Mechanism) -> bool:
    """Return whether a linkage can be assembled at and between all angles of its period."""
    try:
        assembled(mechanism, CrankGrid.steps(1.0, mechanism.period))
    except GeometryError:
        return False
    return True


def find_crank_range(mechanism: Mechanism, known: CrankRange | None = None) -> CrankRange:
    """Return the range of the crank around the position at zero, or from the first that can be assembled.

    `known`: an earlier result, returned if it belongs to this mechanism.
    """
    mechanism = replace(mechanism, passages={})
    if known is not None and known.circuit.mechanism == mechanism:
        return known
    stated = _stated(mechanism)
    circuit = circuit_through(mechanism, stated)
    driver = driver_coordinate(mechanism)
    turns = abs(circuit.turns(mechanism.driver.link))
    branch = circuit.branch_at(driver)
    is_whole = turns > 0 and branch == circuit.full_part
    if not circuit.curve.is_closed and (branch.start <= 0 or branch.end >= circuit.curve.length):
        raise _endless(circuit, 0 if branch.start <= 0 else -1)
    start, end = sorted(map(float, np.degrees(circuit.values(driver, np.array(branch)))))
    passed = _changes(circuit, branch)
    if not is_whole:
        # where dyads reach their limits together, curves cross in the dead position
        inner = (float(change) for change in passed if start + _SAME < change < end - _SAME)
        return CrankRange(circuit, branch, start, end, 0, tuple(sorted(inner)), stated)
    period = 360.0 * turns
    once = np.mod(passed, period)
    once = np.where(np.minimum(once, period - once) < _AT_END, 0.0, once)
    angles = [*once, *(once[once < _SAME] + period)]
    changes = sorted({round(float(change), 9) for change in angles if change <= period})
    return CrankRange(circuit, branch, 0.0, period, turns, tuple(changes), stated)


def _endless(circuit: Circuit, end: int) -> GeometryError:
    """Return the error for a curve that does not close, from its first knots or its last ones."""
    curve, equations = circuit.curve, circuit.curve.system.equations
    if end == 0:
        arc, knots = curve.arc[[1, 0]], curve.knots[[1, 0]]
    else:
        arc, knots = curve.arc[-2:], curve.knots[-2:]
    reach = np.hypot(knots[:, 0::3], knots[:, 1::3])
    name = list(equations.index)[int(np.argmax(reach[1]))]
    before, last = np.degrees(circuit.values(driver_coordinate(circuit.mechanism), arc))
    if reach[1].max() < _RAN_AWAY:
        return GeometryError(ErrorMessage("circuit_long", links=equations.names, angle=abs(last)))
    # extrapolation of the reciprocal of the distance to zero
    near, far = 1 / reach.max(axis=1)
    return GeometryError(ErrorMessage("runs_away", name=name, angle=float(last + (last - before) * far / (near - far))))


def _changes(circuit: Circuit, branch: CircuitPart) -> Array:
    """Return the crank angles at which dyads on a branch change from one of their own branches to the other. [deg]

    Crossings of two curves are known to rounding; crossings of more are interpolated from positions nearby.
    """
    driver, curve = driver_coordinate(circuit.mechanism), circuit.curve
    arc = curve.arc[curve.crossings]
    arc = np.concatenate([arc + k * curve.length for k in (-1, 0, 1)])
    arc = arc[(arc > branch.start) & (arc < branch.end)]
    changes = list(np.degrees(circuit.values(driver, arc))) if arc.size else []
    between = np.linspace(branch.start, branch.end, _BETWEEN)[1:-1]
    poses = circuit.stretch(between)
    for dyad in circuit.mechanism.dyads:
        if isinstance(dyad, RRR | RRP | RPR):
            sides = _side(dyad, poses.frames, circuit.mechanism)
            clear = np.isfinite(sides)
            arcs, sides = between[clear], sides[clear]
            for index in np.flatnonzero(sides[1:] * sides[:-1] < 0):
                near = (arcs[index] + arcs[index + 1]) / 2
                if np.all(np.abs(arc - near) > _NEAR):
                    changes.append(_crank_at_change(circuit, dyad, near))
                    arc = np.append(arc, near)
    return np.sort(np.array(changes))


def _crank_at_change(circuit: Circuit, dyad: RRR | RRP | RPR, near: float) -> float:
    """Return the crank angle at which a dyad changes its branch, interpolated from positions nearby. [deg]"""
    driver, degrees = driver_coordinate(circuit.mechanism), 0.0
    for reach in _PROBE_OFFSETS:
        arcs = near + reach * np.array([-1.0, -0.7, -0.4, 0.4, 0.7, 1.0])
        poses = circuit.stretch(arcs)
        sides = _side(dyad, poses.frames, circuit.mechanism)
        cranks = np.degrees(driver(poses).position)
        degrees = float(np.polyval(np.polyfit(sides, cranks - cranks.mean(), arcs.size - 1), 0.0) + cranks.mean())
        near += float(np.polyval(np.polyfit(sides, arcs - near, arcs.size - 1), 0.0))
    return degrees


def line_of(link: str, frames: Mapping[str, LinkMotion], mechanism: Mechanism) -> LinkMotion:
    """Return the line between the joints of a link from its frame."""
    bar = mechanism.bars.get(link)
    return rotated_frame(frames[link], bar.angle) if bar else frames[link]


def _side(dyad: RRR | RRP | RPR, frames: Mapping[str, LinkMotion], mechanism: Mechanism) -> Array:
    """Return a quantity with the sign of the branch of a dyad."""
    match dyad:
        case RRR():
            a, b = (line_of(link, frames, mechanism) for link in (dyad.link_a, dyad.link_b))
            return np.asarray(a.cos * b.sin - a.sin * b.cos)
        case RRP():
            a, b = line_of(dyad.link, frames, mechanism), frames[dyad.piece]
            return np.asarray(a.cos * b.cos + a.sin * b.sin)
        case RPR():
            a, b = frames[dyad.link], frames[dyad.block]
            x, y = (pin.position - pivot.position for pin, pivot in zip(b.origin, a.origin, strict=True))
            return np.asarray(x * b.cos + y * b.sin)


def branches_of(mechanism: Mechanism, poses: Configurations) -> tuple[Branch, ...]:
    """Return the branches of the dyads with two ways of assembly, at one position of a circuit."""
    signed = (dyad for dyad in mechanism.dyads if isinstance(dyad, RRR | RRP | RPR))
    return tuple(1 if float(_side(dyad, poses.frames, mechanism)[0]) > 0 else -1 for dyad in signed)


def _stated(mechanism: Mechanism) -> float:
    """Return a crank angle on the branch of the position at zero, well away from its ends. [deg]"""
    if any(isinstance(group, Chain) for group in mechanism.dyads):
        return 0.0
    stretches = [stretch for stretch in assembled_stretches(mechanism) if stretch[1] > stretch[0]]
    if not stretches:
        assembled(mechanism, _DENSE)
    at_zero = [stretch for stretch in stretches if stretch[0] <= 0.0 < stretch[1]]
    start, end = at_zero[-1] if at_zero else min(stretches, key=lambda stretch: stretch[0] % 360.0)
    margins = [closure.value / closure.scale for closure in place(mechanism, CrankGrid.from_degrees([0.0])).closures]
    if at_zero and all(np.all(margin > _HEALTHY) for margin in margins):
        return 0.0
    return start + (end - start) * min(0.75, max(0.25, -start / (end - start)))


def near_changes(circuit: Circuit) -> list[tuple[float, float]]:
    """Return the crank angles of change points that lengths miss, and the relative errors of lengths. [deg], [-]"""
    crank = circuit.mechanism.crank
    angle_index = circuit.curve.system.equations.index[crank.link] + 2
    return [
        (float(np.degrees(crank.direction * (crossing.u[angle_index] - crank.start))) % 360.0, crossing.miss)
        for crossing in circuit.curve.near_crossings
    ]


def pass_change_points(mechanism: Mechanism, known: CrankRange | None = None) -> tuple[Mechanism, CrankRange | None]:
    """Return a linkage that passes the change points in the range of its crank, and that range.

    The linkage itself if there are none, without a range if the crank also turns fully. `known`: an earlier result.
    """
    if not has_steady_crank(mechanism) or turns_fully(mechanism):
        return mechanism, None
    reach = find_crank_range(mechanism, known)
    if not reach.changes:
        return mechanism, reach
    ends = (reach.start, reach.end)
    mechanism = replace(mechanism, passages={})
    return with_passages(mechanism, reach.changes, ends, reach.stated, is_whole=reach.is_whole), reach


def with_passages(
    mechanism: Mechanism, changes: Sequence[float], ends: tuple[float, float], stated: float, *, is_whole: bool = True
) -> Mechanism:
    """Return a mechanism that passes change points at crank angles between the ends of its motion.

    `stated`: crank angle at which its dyads are on their branches, or just after which [deg]; `is_whole`: whether the
    crank turns fully, so that everything repeats.
    """
    # a crank that turns fully goes on beyond its table; otherwise it does not
    period = ends[1] - ends[0] if is_whole else math.inf
    for index, group in enumerate(mechanism.dyads):
        if not isinstance(group, RRR | RRP | RPR):
            continue
        touched = tuple(change for change in changes if _touches(mechanism, index, change))
        if touched:
            passed = replace(
                mechanism, passages={**mechanism.passages, index: ChangePointPassage(touched, stated, period)}
            )
            bridges = tuple(_bridge(passed, index, change, changes, ends) for change in touched)
            mechanism = replace(
                mechanism, passages={**mechanism.passages, index: ChangePointPassage(touched, stated, period, bridges)}
            )
    return mechanism


def _touches(mechanism: Mechanism, index: int, degrees: float) -> bool:
    part = replace(mechanism, dyads=mechanism.dyads[: index + 1])
    closure = place(part, CrankGrid.from_degrees([degrees])).closures[index]
    return bool(np.all(np.abs(closure.value) <= _TOUCHES * closure.scale))


def _bridge(
    mechanism: Mechanism, index: int, degrees: float, changes: Sequence[float], ends: tuple[float, float]
) -> ChangePointFit:
    """Return the polynomials of a dyad near a change point, those that lose the fewest digits."""
    limits = [abs(change - degrees) / 2 for change in changes if change != degrees]
    if not math.isfinite(mechanism.passages[index].period):
        limits += [abs(end - degrees) for end in ends]
    widest = min([_REACHES[0], *limits])
    part = replace(mechanism, dyads=mechanism.dyads[: index + 1])
    reaches = [float(width) for width in _REACHES if width <= widest] or [widest]
    fits = [_fitted(part, index, degrees, reach) for reach in reaches]
    enough = _ENOUGH * max(min(left for _, _, left in fits), _ROUNDING)
    reach, columns = next((reach, columns) for reach, columns, left in fits if left <= enough)
    return ChangePointFit(degrees, _USED * reach, columns)


def _fitted(part: Mechanism, index: int, degrees: float, reach: float) -> tuple[float, Mapping[str, Polynomial], float]:
    """Return polynomials of the quantities of a dyad over a reach, and the effect of their last orders."""
    nearest = _NEAREST * reach
    nodes = np.cos(np.pi * (2 * np.arange(_NODES // 2) + 1) / _NODES)
    far = np.sqrt((nearest**2 + reach**2) / 2 + (reach**2 - nearest**2) / 2 * nodes)
    local = np.concatenate([-far, far[::-1]]) / reach
    values = _quantities(part, index, CrankGrid.from_degrees(degrees + reach * local))
    powers = chebyshev.chebvander(local, _DEGREE)
    near = chebyshev.chebvander(np.linspace(-_USED, _USED, 9), _DEGREE)
    columns, left = {}, 0.0
    for key, value in values.items():
        # the digits that formulas lose near the change point
        weight = np.abs(local) ** (2 if key.endswith("_1") else 1)
        full, reduced = (
            np.linalg.lstsq(powers[:, :count] * weight[:, None], value * weight, rcond=None)[0]
            for count in (_DEGREE + 1, _DEGREE - 1)
        )
        columns[key] = Polynomial(degrees, reach, tuple(map(float, full)))
        difference = np.abs(near @ full - near[:, : _DEGREE - 1] @ reduced).max()
        left = max(left, float(difference / (1 + np.abs(value).max()))) if np.isfinite(difference) else math.inf
    return reach, columns, left


def _quantities(part: Mechanism, index: int, grid: CrankGrid) -> dict[str, Array]:
    """Return the quantities of a dyad that are 0/0 at a change point."""
    placed, full = place(part, grid), np.zeros(len(grid))
    match part.dyads[index]:
        case RRR() as dyad:
            a, b = (placed.bars.get(link, placed.links[link]) for link in (dyad.link_a, dyad.link_b))
            quantities = {
                "arm_x": dyad.length_a * a.cos, "arm_y": dyad.length_a * a.sin,
                "rate_a": a.angle_1, "rate_b": b.angle_1, "rate_a_1": a.angle_2, "rate_b_1": b.angle_2,
            }  # fmt: skip
        case RRP() as dyad:
            a, b = placed.bars.get(dyad.link, placed.links[dyad.link]), placed.links[dyad.piece]
            reach = dyad.length * (a.cos * b.cos + a.sin * b.sin)
            quantities = {"reach": reach, "rate": a.angle_1 - b.angle_1, "rate_1": a.angle_2 - b.angle_2}
        case RPR() as dyad:
            a, b = placed.links[dyad.link], placed.links[dyad.block]
            x, y = (pin.position - pivot.position for pin, pivot in zip(b.origin, a.origin, strict=True))
            quantities = {
                "reach": x * b.cos + y * b.sin, "cos": b.cos, "sin": b.sin,
                "rate": b.angle_1, "rate_1": b.angle_2,
            }  # fmt: skip
    return {key: value + full for key, value in quantities.items()}
