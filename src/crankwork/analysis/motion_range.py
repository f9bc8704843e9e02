"""Range of motion of a linkage: dead positions, swing and stroke, change points, lengths to turn fully."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyval, polyvander
from numpy.typing import ArrayLike

from crankwork.analysis.transmission_quality import limits_of_transmissions
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import ProcedureValue, TracedValue
from crankwork.kinematics.circuits import Extent
from crankwork.kinematics.configuration_curve import link_angle
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import CrankRange
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.position_analysis import place
from crankwork.mechanism.dyads import RPR, RRP, RRR, Chain, Dyad
from crankwork.mechanism.mechanism import Mechanism
from crankwork.preparation.reachable_motion import EDGE
from crankwork.quantities.key import key_of

_DENSE = CrankGrid.steps(0.1, 360.0)
_PASSED = 1e-9


class LengthBound(NamedTuple):
    """The key of a length, and its least or greatest value. [m]"""

    key: str
    sign: str
    length: float


def full_turn_bounds(mechanism: Mechanism) -> Iterator[LengthBound]:
    """Yield the bounds of lengths with which the first dyad that does not close all round would close."""
    placed = place(mechanism, _DENSE)
    still = np.zeros(len(_DENSE))
    points = {name: np.array([axis.position + still for axis in value]) for name, value in placed.points.items()}
    for dyad, closure in zip(mechanism.dyads, placed.closures, strict=True):
        # a change point is passed
        if np.all(closure.value > -_PASSED * closure.scale):
            continue
        yield from _of_dyad(dyad, points)
        yield from _of_crank(mechanism, dyad)
        return


def _of_dyad(dyad: Dyad | Chain, points: Mapping[str, Array]) -> Iterator[LengthBound]:
    match dyad:
        case RRR():
            distance = np.hypot(*(points[dyad.joint_a] - points[dyad.joint_b]))
            near, far = float(distance.min()), float(distance.max())
            links = (dyad.link_a, dyad.length_a), (dyad.link_b, dyad.length_b)
            for (link, own), (_, other) in (links, links[::-1]):
                least, most = max(far - other, other - near), other + near
                if least <= most:
                    yield LengthBound(
                        f"links.{link}.length", "≥" if own < least else "≤", least if own < least else most
                    )
        case RRP(guide_link=""):
            x, y = (points[dyad.joint].T - dyad.guide_point).T
            offset = np.abs(y * math.cos(dyad.guide_angle) - x * math.sin(dyad.guide_angle))
            yield LengthBound(f"links.{dyad.link}.length", "≥", float(offset.max()))


def _of_crank(mechanism: Mechanism, dyad: Dyad | Chain) -> Iterator[LengthBound]:
    """Yield the greatest length of the crank for a dyad between crank and ground."""
    crank = mechanism.crank
    match dyad:
        case RRR() if crank.pin in (dyad.joint_a, dyad.joint_b):
            other = dyad.joint_b if dyad.joint_a == crank.pin else dyad.joint_a
            if other in mechanism.ground:
                frame = math.dist(crank.pivot, mechanism.ground[other])
                short = abs(dyad.length_a - dyad.length_b)
                yield LengthBound("crank.radius", "≤", min(dyad.length_a + dyad.length_b - frame, frame - short))
        case RRP(guide_link="") if dyad.joint == crank.pin:
            x, y = (item - other for item, other in zip(crank.pivot, dyad.guide_point, strict=True))
            offset = abs(y * math.cos(dyad.guide_angle) - x * math.sin(dyad.guide_angle))
            yield LengthBound("crank.radius", "≤", dyad.length - offset)
        case RPR() if dyad.joint == crank.pin and dyad.pivot in mechanism.ground:
            (x, y), angle = dyad.slot.point, dyad.slot.angle
            offset = abs(y * math.cos(angle) - x * math.sin(angle))
            yield LengthBound("crank.radius", "≤", math.dist(crank.pivot, mechanism.ground[dyad.pivot]) - offset)


# how much an unbounded column grows on the way to an extreme
_OFFSETS = (1e-4, 1e-7)
# distance that counts as the angle itself [deg]
_ITSELF = 1e-7
_GROWS = 10.0
# how far from a dead position its row stands [deg], and from where limits in it are found
_INSIDE = 1e-8
_REACH, _NOISE = 1e-3, 1e-9
_ROOTS = (1 - np.cos(np.pi * (np.arange(10) + 0.5) / 10)) / 2


def rows_inside(travel: CrankRange, degrees: ArrayLike) -> CrankGrid:
    """Return the angles of a table that lie between dead positions, up to whole turns, and in these. [deg]"""
    angles = np.asarray(degrees, dtype=float)
    first, last = math.floor((travel.start - angles.max()) / 360.0), math.ceil((travel.end - angles.min()) / 360.0)
    shifted = np.unique(np.round(np.concatenate([angles + 360.0 * turn for turn in range(first, last + 1)]), 9))
    edge = EDGE * (travel.end - travel.start)
    inside = shifted[(shifted > travel.start + edge) & (shifted < travel.end - edge)]
    dead = [row for end, row in _dead_rows(travel) if np.any(np.abs(shifted - end) <= edge)]
    return CrankGrid.from_degrees(np.sort([*inside, *dead]))


def _dead_rows(travel: CrankRange) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return both dead positions, each with the angle of its row, so little inside that formulas hold there. [deg]"""
    return (travel.start, travel.start + _INSIDE), (travel.end, travel.end - _INSIDE)


def with_limits(
    columns: Mapping[str, Array], trace: Mapping[str, TracedValue], travel: CrankRange, table: CrankGrid
) -> dict[str, Array]:
    """Return the columns of a table with their limits in dead positions, and without a value where they have none.

    A column goes there with the square root of the distance, in which it is followed by a polynomial.
    """
    result, width = {key: values.copy() for key, values in columns.items()}, travel.end - travel.start
    cosines = limits_of_transmissions(travel)
    varying = {key: trace[key] for key in columns if trace[key].varies}
    for index, (end, row) in enumerate(_dead_rows(travel)):
        rows = np.flatnonzero(table.degrees == row)
        if not rows.size:
            continue
        side = 1.0 if index == 0 else -1.0
        without = find_singular_columns(varying, [end], [side], width)
        angles = CrankGrid.from_degrees(end + side * _REACH * width * _ROOTS**2)
        for key, values in Program(varying)(angles).items():
            kind, name = key_of(key)
            if any(key in part for part in without):
                limit = math.nan
            elif kind == "transmission_angle":
                cosine = cosines[f"transmission_cosine.{name}"][index]
                limit = math.acos(max(-1.0, min(1.0, cosine)))
            else:
                limit = float(polyval(0.0, np.linalg.solve(polyvander(_ROOTS, _ROOTS.size - 1), values)))
                limit = 0.0 if abs(limit) <= _NOISE * np.max(np.abs(values)) else limit
            result[key][rows] = limit
    return result


class SingularColumns(NamedTuple):
    """Columns that have no value somewhere, and at which crank angles. [deg]"""

    unbounded: Mapping[str, tuple[float, ...]]  # They grow beyond all bounds towards the angle
    undetermined: Mapping[str, tuple[float, ...]]  # They stay finite, with no limit that both sides have in common


def find_singular_columns(
    columns: Mapping[str, TracedValue], ends: Iterable[float], towards: Iterable[float], width: float
) -> SingularColumns:
    """Return the columns that grow beyond all bounds towards some crank angles, and those that have no value there.

    `ends`: the angles; `towards`: on which side of each the motion is, 1 or -1; `width`: scale of the offsets [deg].
    """
    offsets = np.array([*(width * np.array(_OFFSETS)), _ITSELF])
    angles = np.array([*ends])
    degrees = np.array([end + side * offsets for end, side in zip(angles, towards, strict=True)])
    if not degrees.size or not columns:
        return SingularColumns({}, {})
    values = Program(columns)(CrankGrid.from_degrees(degrees.ravel()))
    grown, without = dict[str, tuple[float, ...]](), dict[str, tuple[float, ...]]()
    for key, column in values.items():
        far, near, exact = np.abs(column.reshape(degrees.shape)).T
        grows = ~(near <= _GROWS * far + 1e-9 * np.max(far))
        # at a change point without a common limit a column has no value
        missing = ~np.isfinite(exact) & ~grows
        grown |= {key: tuple(angles[grows].tolist())} if grows.any() else {}
        without |= {key: tuple(angles[missing].tolist())} if missing.any() else {}
    return SingularColumns(grown, without)


def limits_of(travel: CrankRange, trace: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the range of a crank that turns back, and swing and stroke on its branch and on the whole circuit."""
    circuit, values = travel.circuit, {}
    for key, degrees in (
        ("crank_range", travel.end - travel.start),
        ("crank_range_start", travel.start),
        ("crank_range_end", travel.end),
    ):
        values[key] = TracedValue(ProcedureValue(math.radians(degrees), "circuit"), key)
    angles = {name: (f"link_angle.{name}", link_angle(name)) for name in circuit.curve.system.equations.index}
    sliders = {name: (f"slider_displacement.{name}", value) for name, value in circuit.sliders.items()}
    for kind, each in (("link_swing", angles), ("slider_stroke", sliders)):
        for name, (column, coordinate) in each.items():
            if column not in trace or (kind == "link_swing" and name in sliders):
                continue
            on_branch, engine = circuit.extents(coordinate, travel.branch, circuit.full_part)
            turns = kind == "link_swing" and circuit.turns(name) != 0
            for key, extent, word in ((kind, on_branch, "branch"), (f"{kind}_circuit", engine, "circuit")):
                if not (kind == "link_swing" and _is_full(extent)) and not (turns and extent is engine):
                    values[f"{key}.{name}"] = TracedValue(
                        ProcedureValue(extent.travel, word, (trace[column],)), f"{key}.{name}"
                    )
    return values


def _is_full(extent: Extent) -> bool:
    return extent.travel >= math.tau - 1e-9


def clear_of_changes(mechanism: Mechanism, moved: Motion) -> Motion:
    """Return the motion without the surroundings of change points, in which nothing is compared."""
    clear = np.ones(len(moved.grid), dtype=bool)
    for passage in mechanism.passages.values():
        clear &= ~passage.is_bridged(moved.grid.degrees)
    return moved if clear.all() else linkage_motion(mechanism, CrankGrid.from_degrees(moved.grid.degrees[clear]))
