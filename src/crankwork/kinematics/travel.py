"""How far the crank of a linkage gets, and through which change points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.circuits import Circuit, Part, assembled_stretches, circuit_through
from crankwork.kinematics.coordinates import Stretch, driver_coordinate
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import LinkMotion, turned
from crankwork.kinematics.passages import with_passages
from crankwork.kinematics.placement import assembled, place
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import RPR, RRP, RRR, Branch
from crankwork.mechanism.mechanism import Crank, Mechanism

_DENSE = CrankGrid.steps(1.0, 360.0)
_HEALTHY = 1e-3
_SAME = 1e-6
# a change point that lengths have moved off the end of a period by rounding is there [deg]
_AT_END = 0.01
# longest lengths beyond which a link is on its way to infinity
_RAN_AWAY = 100.0
_NEAR = 0.05
_BETWEEN = 400
_ASIDE = (0.15, 0.08, 0.05)


class Travel(NamedTuple):
    """The branch of a linkage that its stated position is on: from dead position to dead position of the crank."""

    circuit: Circuit
    branch: Part
    start: float  # Least and greatest crank angle [deg]
    end: float
    turns: int  # Turns of the crank after which everything repeats; none where it turns back
    changes: tuple[float, ...]  # Crank angles of change points that are passed [deg]
    stated: float  # Crank angle at which the branch was taken [deg]

    @property
    def is_whole(self) -> bool:
        """Whether the crank turns fully."""
        return self.turns > 0


def has_steady_crank(mechanism: Mechanism) -> bool:
    """Return whether a crank drives, at the angle of the tables and not by a law."""
    return isinstance(mechanism.driver, Crank) and mechanism.driver.law is None


def turns_fully(mechanism: Mechanism) -> bool:
    """Return whether a linkage can be assembled at and between all angles of its period."""
    try:
        assembled(mechanism, CrankGrid.steps(1.0, mechanism.period))
    except GeometryError:
        return False
    return True


def travel(mechanism: Mechanism, known: Travel | None = None) -> Travel:
    """Return how far the crank gets from the position at an angle of zero, or from the first that can be assembled.

    `known`: what was found before, which is taken if it was found of this mechanism.
    """
    mechanism = replace(mechanism, passages={})
    if known is not None and known.circuit.mechanism == mechanism:
        return known
    stated = _stated(mechanism)
    circuit = circuit_through(mechanism, stated)
    driver = driver_coordinate(mechanism)
    turns = abs(circuit.turns(mechanism.driver.link))
    branch = circuit.branch_at(driver)
    is_whole = turns > 0 and branch == circuit.whole
    if not circuit.curve.is_closed and (branch.start <= 0 or branch.end >= circuit.curve.length):
        raise _endless(circuit, 0 if branch.start <= 0 else -1)
    start, end = sorted(map(float, np.degrees(circuit.values(driver, np.array(branch)))))
    passed = _changes(circuit, branch)
    if not is_whole:
        # where dyads come to their ends together, curves cross in the dead position
        inner = (float(one) for one in passed if start + _SAME < one < end - _SAME)
        return Travel(circuit, branch, start, end, 0, tuple(sorted(inner)), stated)
    period = 360.0 * turns
    once = np.mod(passed, period)
    once = np.where(np.minimum(once, period - once) < _AT_END, 0.0, once)
    every = sorted({round(float(one), 9) for one in [*once, *(once[once < _SAME] + period)] if one <= period})
    return Travel(circuit, branch, 0.0, period, turns, tuple(every), stated)


def _endless(circuit: Circuit, end: int) -> GeometryError:
    """Return what is to be said of a curve that does not come back: of its first knots, or of its last ones."""
    curve, equations = circuit.curve, circuit.curve.system.equations
    if end == 0:
        arc, knots = curve.arc[[1, 0]], curve.knots[[1, 0]]
    else:
        arc, knots = curve.arc[-2:], curve.knots[-2:]
    reach = np.hypot(knots[:, 0::3], knots[:, 1::3])
    name = list(equations.index)[int(np.argmax(reach[1]))]
    before, last = np.degrees(circuit.values(driver_coordinate(circuit.mechanism), arc))
    if reach[1].max() < _RAN_AWAY:
        return GeometryError(Refusal("circuit_long", links=equations.names, angle=abs(last)))
    # where the reciprocal of its distance comes to nought
    near, far = 1 / reach.max(axis=1)
    return GeometryError(Refusal("runs_away", name=name, angle=float(last + (last - before) * far / (near - far))))


def _changes(circuit: Circuit, branch: Part) -> Array:
    """Return the crank angles of the change points on a branch: where a dyad changes from one of its own to the other.

    Where two curves cross, that is known to rounding; where more of them do, positions beside it tell. [deg]
    """
    driver, curve = driver_coordinate(circuit.mechanism), circuit.curve
    arc = curve.arc[curve.crossings]
    arc = np.concatenate([arc + k * curve.length for k in (-1, 0, 1)])
    arc = arc[(arc > branch.start) & (arc < branch.end)]
    found = list(np.degrees(circuit.values(driver, arc))) if arc.size else []
    between = np.linspace(branch.start, branch.end, _BETWEEN)[1:-1]
    there = circuit.stretch(between)
    for dyad in circuit.mechanism.dyads:
        if isinstance(dyad, RRR | RRP | RPR):
            sides = _side(dyad, there.frames, circuit.mechanism)
            clear = np.isfinite(sides)
            at, sides = between[clear], sides[clear]
            for one in np.flatnonzero(sides[1:] * sides[:-1] < 0):
                near = (at[one] + at[one + 1]) / 2
                if np.all(np.abs(arc - near) > _NEAR):
                    found.append(_crank_at_change(circuit, dyad, near))
                    arc = np.append(arc, near)
    return np.sort(np.array(found))


def _crank_at_change(circuit: Circuit, dyad: RRR | RRP | RPR, near: float) -> float:
    """Return the crank angle at which a dyad changes its branch, by interpolation from beside it. [deg]"""
    driver, degrees = driver_coordinate(circuit.mechanism), 0.0
    for reach in _ASIDE:
        at = near + reach * np.array([-1.0, -0.7, -0.4, 0.4, 0.7, 1.0])
        there = circuit.stretch(at)
        sides = _side(dyad, there.frames, circuit.mechanism)
        cranks = np.degrees(driver(there).position)
        degrees = float(np.polyval(np.polyfit(sides, cranks - cranks.mean(), at.size - 1), 0.0) + cranks.mean())
        near += float(np.polyval(np.polyfit(sides, at - near, at.size - 1), 0.0))
    return degrees


def _side(dyad: RRR | RRP | RPR, frames: Mapping[str, LinkMotion], mechanism: Mechanism) -> Array:
    """Return what has the sign of the branch of a dyad."""

    def line(link: str) -> LinkMotion:
        bar = mechanism.bars.get(link)
        return turned(frames[link], bar.angle) if bar else frames[link]

    match dyad:
        case RRR():
            a, b = line(dyad.link_a), line(dyad.link_b)
            return np.asarray(a.cos * b.sin - a.sin * b.cos)
        case RRP():
            a, b = line(dyad.link), frames[dyad.piece]
            return np.asarray(a.cos * b.cos + a.sin * b.sin)
        case RPR():
            a, b = frames[dyad.link], frames[dyad.block]
            x, y = (pin.position - pivot.position for pin, pivot in zip(b.origin, a.origin, strict=True))
            return np.asarray(x * b.cos + y * b.sin)


def branches_of(mechanism: Mechanism, there: Stretch) -> tuple[Branch, ...]:
    """Return the branches of the dyads that can be put together in two ways, at one position of a circuit."""
    signed = (one for one in mechanism.dyads if isinstance(one, RRR | RRP | RPR))
    return tuple(1 if float(_side(one, there.frames, mechanism)[0]) > 0 else -1 for one in signed)


def _stated(mechanism: Mechanism) -> float:
    """Return a crank angle on the branch that the position at zero is on, well away from where it ends. [deg]"""
    if any(isinstance(group, Chain) for group in mechanism.dyads):
        return 0.0
    stretches = [one for one in assembled_stretches(mechanism) if one[1] > one[0]]
    if not stretches:
        assembled(mechanism, _DENSE)
    here = [one for one in stretches if one[0] <= 0.0 < one[1]]
    start, end = here[-1] if here else min(stretches, key=lambda one: one[0] % 360.0)
    margins = [one.value / one.scale for one in place(mechanism, CrankGrid.from_degrees([0.0])).closures]
    if here and all(np.all(margin > _HEALTHY) for margin in margins):
        return 0.0
    return start + (end - start) * min(0.75, max(0.25, -start / (end - start)))


def near_changes(circuit: Circuit) -> list[tuple[float, float]]:
    """Return the crank angles of change points that lengths miss, and by how much of the longest. [deg], [-]"""
    crank = circuit.mechanism.crank
    at = circuit.curve.system.equations.index[crank.link] + 2
    return [
        (float(np.degrees(crank.direction * (one.u[at] - crank.start))) % 360.0, one.miss)
        for one in circuit.curve.nearly
    ]


def way_through(mechanism: Mechanism, known: Travel | None = None) -> tuple[Mechanism, Travel | None]:
    """Return a linkage that passes the change points on its way, as itself where it has none, and that way.

    No way where there is nothing to pass and the crank turns fully. `known`: what was found of the way before.
    """
    if not has_steady_crank(mechanism) or turns_fully(mechanism):
        return mechanism, None
    found = travel(mechanism, known)
    if not found.changes:
        return mechanism, found
    ends = (found.start, found.end)
    mechanism = replace(mechanism, passages={})
    return with_passages(mechanism, found.changes, ends, found.stated, is_whole=found.is_whole), found
