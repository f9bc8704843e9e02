"""The theoretical diagram of a calculated cycle: sharp corners, polytropes and straight lines between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from crankwork.kinematics.extremes import solve_monotone
from crankwork.loads.indicator import DiagramPoint, Piece, VolumeAt
from crankwork.locale import Refusal
from crankwork.working_cycle.calculated_cycle import Corners
from crankwork.working_cycle.fuels import CycleError

Points = dict[str, DiagramPoint]
_AngleOf = Callable[[float, float, float], float]


def theoretical_diagram(
    corners: Corners, cycle: float, volume_at: VolumeAt, dead_centres: tuple[float, float]
) -> tuple[Points, tuple[Piece, ...]]:
    """Return points and pieces of the theoretical diagram of a cylinder, absolute pressures.

    Four strokes: r, d begin the intake, a ends it; c, z (z' before it if combustion continues at constant pressure), b,
    e and r end the cycle. Two strokes: c, z, b at the opening of the ports, e and a at their closing. For
    `loads.indicator.solve_diagram`. Source: kolchin_demidov_2008, ch. 3; nguyen_tat_tien_2000.
    """
    top = dead_centres[0] % 360
    # a top dead centre just before 0 begins its cycle at the end of the previous one
    top = top + cycle - 360 if top > 180 else top
    bottom = top + (dead_centres[1] - dead_centres[0]) % 360
    clearance = float(volume_at(np.array([top]))[0])

    def angle_of(ratio: float, start: float, end: float) -> float:
        return _angle_of_volume(volume_at, ratio * clearance, start, end)

    if cycle == 360:
        points, pieces = _two_strokes(corners, top, bottom, angle_of)
    else:
        points, pieces = _four_strokes(corners, top, bottom, angle_of)
    return _from_zero(points, pieces, cycle)


def _four_strokes(corners: Corners, top: float, bottom: float, angle_of: _AngleOf) -> tuple[Points, list[Piece]]:
    firing = top + 360
    points = {
        "r": DiagramPoint(top, corners.p_r.value),
        "d": DiagramPoint(top, corners.p_a.value),
        "a": DiagramPoint(bottom, corners.p_a.value),
        "b": DiagramPoint(bottom + 360, corners.p_b.value),
        "e": DiagramPoint(bottom + 360, corners.p_r.value),
        "r'": DiagramPoint(top + 720, corners.p_r.value),
    }
    burning_points, burning = _burning(corners, firing, bottom + 360, angle_of)
    pieces = [
        Piece("rounded", ("r", "d")),
        Piece("constant", ("d", "a")),
        Piece("polytropic", ("a", "c"), corners.n1.value),
        *burning,
        Piece("rounded", ("b", "e")),
        Piece("constant", ("e", "r'")),
    ]
    return points | burning_points, pieces


def _two_strokes(corners: Corners, top: float, bottom: float, angle_of: _AngleOf) -> tuple[Points, list[Piece]]:
    opens, shuts = bottom, bottom
    if corners.psi.value:
        opens = angle_of(corners.epsilon.value, top, bottom)
        shuts = angle_of(corners.epsilon.value, top + 360, bottom)
    points = {
        "b": DiagramPoint(opens, corners.p_b.value),
        "e": DiagramPoint(opens, corners.p_a.value),
        "a": DiagramPoint(shuts, corners.p_a.value),
        "c'": DiagramPoint(top + 360, corners.p_c.value),
    }
    burning_points, burning = _burning(corners, top, opens, angle_of)
    pieces = [
        *burning,
        Piece("rounded", ("b", "e")),
        Piece("constant", ("e", "a")),
        Piece("polytropic", ("a", "c'"), corners.n1.value),
    ]
    return points | burning_points, pieces


def _burning(corners: Corners, firing: float, end: float, angle_of: _AngleOf) -> tuple[Points, list[Piece]]:
    """Return points and pieces from c over z to b."""
    points = {"c": DiagramPoint(firing, corners.p_c.value), "z": DiagramPoint(firing, corners.p_z.value)}
    pieces = [Piece("rounded", ("c", "z"))]
    if corners.rho.value > 1:
        points["z'"] = points["z"]
        points["z"] = DiagramPoint(angle_of(corners.rho.value, firing, end), corners.p_z.value)
        pieces = [Piece("rounded", ("c", "z'")), Piece("constant", ("z'", "z"))]
    return points, [*pieces, Piece("polytropic", ("z", "b"), corners.n2.value)]


def _angle_of_volume(volume_at: VolumeAt, volume: float, small: float, large: float) -> float:
    """Return the angle at which a volume is reached, between angles of a smaller and a larger volume."""
    low, high = float(small), float(large)
    ends = volume_at(np.array([low, high]))
    if not ends[0] <= volume <= ends[1] * (1 + 1e-12):
        raise CycleError(Refusal("volume_unreached", volume=volume * 1e6, least=ends[0] * 1e6, most=ends[1] * 1e6))
    return solve_monotone(volume_at, volume, low, high)


def _from_zero(points: Points, pieces: list[Piece], cycle: float) -> tuple[Points, tuple[Piece, ...]]:
    """Return the same diagram from 0 instead of from its first dead centre; the piece across the end is cut."""
    before: list[Piece] = []
    after: list[Piece] = []
    moved = dict(points)
    for piece in pieces:
        first, last = piece.points[0], piece.points[-1]
        start, end = (points[name].angle or 0.0 for name in (first, last))
        if end <= cycle:
            before.append(piece)
        elif start >= cycle:
            after.append(piece)
        else:
            pressure = points[first].pressure if piece.law == "constant" else None
            moved |= {"end": DiagramPoint(cycle, pressure), "start": DiagramPoint(0.0, pressure)}
            before.append(replace(piece, points=(first, "end")))
            after.append(replace(piece, points=("start", last), reference=first if piece.exponent else None))
    for name, point in points.items():
        if (point.angle or 0.0) > cycle:
            moved[name] = replace(point, angle=(point.angle or 0.0) - cycle)
    return moved, (*after, *before)
