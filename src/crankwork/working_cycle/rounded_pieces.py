"""Parts of a diagram written as named points and pieces: smooth where they meet, and cut at the end of the cycle.

A rounded piece takes its slopes from its points alone. A point beside each of its ends, at the pressure that
makes the three-point end slope the wanted one, lets it leave one law and join the next without a corner.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.known import Known, KnownAngle, Pieces, plain
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Law, Piece
from crankwork.loads.monotone import hermite, hermite_slope, monotone_slopes
from crankwork.loads.retold import column, curve_laws

# points that only shape a curve have names that begin with this mark
AUXILIARY = "~"
_BESIDE = 0.2
_SAME = 1e-6


class Named(NamedTuple):
    """A point by name: crank angle [deg], pressure [Pa]."""

    name: str
    angle: Value
    pressure: Value


@dataclass(frozen=True)
class Part:
    """A law through points; a curve has slopes at its ends [Pa/deg], a polytrope an exponent and a reference."""

    law: Law
    points: tuple[Named, ...]
    slopes: tuple[Value, Value] = (0.0, 0.0)
    exponent: Value | None = None
    reference: str | None = None


def without_auxiliary(diagram: IndicatorDiagram) -> IndicatorDiagram:
    """Return a diagram without the names of points that only shape its curves."""
    named = {name: at for name, at in diagram.named.items() if not name.startswith(AUXILIARY)}
    return IndicatorDiagram(diagram.segments, named, diagram.jumps)


def written(
    parts: Sequence[Part], cycle: float, references: dict[str, DiagramPoint]
) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...]]:
    """Return points and pieces of parts that together make one cycle, begun anywhere.

    Points and pieces from 0 to the end of the cycle. `parts`: in order of the crank angle; parts without length are
    left out.
    """
    points, pieces = dict(references), []
    for part in inside_cycle(parts, cycle):
        knots = _shaped(part) if part.law == "rounded" else part.points
        names = tuple(_placed(points, one) for one in knots)
        pieces.append(Piece(part.law, names, part.exponent, part.reference))
    first, last = pieces[0].points[0], pieces[-1].points[-1]
    before = points[last].pressure
    if before is not None and points[first].pressure != before:
        # a vertical line where the cycle begins; of no length, but it closes the diagram
        foot = _placed(points, Named(f"{AUXILIARY}{last}", 0.0, before))
        pieces.insert(0, Piece("rounded", (foot, first)))
    return points, tuple(pieces)


def inside_cycle(parts: Sequence[Part], cycle: float) -> list[Part]:
    """Return parts from 0 to the end of the cycle, those without length left out."""
    inside = [one for part in parts for one in _within(part, cycle)]
    return sorted(inside, key=lambda one: plain(one.points[0].angle))


def remembered(
    parts: Sequence[Part], cycle: float, volume: Known, references: Mapping[str, tuple[Known, Known]]
) -> Known:
    """Return the pressure of parts made of knowns, every cubic between two knots a law of its own. [Pa]

    `references`: pressure and volume of the states that polytropes pass through.
    """
    degrees, ends, laws = KnownAngle().degrees, list[Value](), list[Known]()
    for part in inside_cycle(parts, cycle):
        if part.law != "rounded":
            ends.append(part.points[-1].angle)
            is_level = part.law == "constant"
            law = part.points[0].pressure if is_level else _on_polytrope(part, references, volume)
            laws.append(law)
            continue
        knots = _shaped(part)
        curve = curve_laws([one.angle for one in knots], [one.pressure for one in knots], degrees)
        for end, law in curve:
            ends.append(end)
            laws.append(law)
    return Known(Pieces([*ends[:-1], cycle], tuple(laws)), "diagram_pressure")


def _on_polytrope(part: Part, references: Mapping[str, tuple[Known, Known]], volume: Known) -> Known:
    law: Known = polytropic_pressure(*references[part.reference or ""], volume, part.exponent)
    return law


def _placed(points: dict[str, DiagramPoint], one: Named) -> str:
    """Put a point among the others and return its name, marked if another point has that name already."""
    name, number = one.name, 0
    while name in points and not _is_same(points[name], one):
        number += 1
        name = f"{AUXILIARY}{one.name.removeprefix(AUXILIARY)}{number}"
    points.setdefault(name, DiagramPoint(one.angle, one.pressure))
    return name


def _is_same(point: DiagramPoint, one: Named) -> bool:
    if point.angle is None or point.pressure is None or point.volume is not None:
        return False
    is_near = abs(point.pressure - one.pressure) <= 1e-9 * abs(one.pressure)
    return bool(is_near and abs(point.angle - one.angle) < _SAME)


def _within(part: Part, cycle: float) -> list[Part]:
    """Return a part moved into the cycle, in two if it crosses its end."""
    start, end = plain(part.points[0].angle), plain(part.points[-1].angle)
    if end - start < _SAME:
        return []
    turn = cycle * float(np.floor((start + _SAME) / cycle))
    if end <= turn + cycle + _SAME:
        return [_moved(part, -turn, cycle)]
    before, after = _halves(part, turn + cycle)
    return [_moved(before, -turn, cycle), _moved(after, -turn - cycle, cycle)]


def _moved(part: Part, by: float, cycle: float) -> Part:
    """Return a part moved along the crank angle, the ends of the cycle hit exactly."""
    moved = [one._replace(angle=one.angle + by) for one in part.points]
    snapped = [
        one._replace(angle=edge) if abs(plain(one.angle) - edge) < _SAME else one
        for one in moved
        for edge in [0.0 if plain(one.angle) < cycle / 2 else cycle]
    ]
    return Part(part.law, tuple(snapped), part.slopes, part.exponent, part.reference)


def _halves(part: Part, cut: float) -> tuple[Part, Part]:
    """Return the parts before and after a crank angle, the same curve where it is cut."""
    before = tuple(one for one in part.points if plain(one.angle) < cut - _SAME)
    after = tuple(one for one in part.points if plain(one.angle) > cut + _SAME)
    at = [one for one in part.points if abs(plain(one.angle) - cut) <= _SAME]
    slope: Value = 0.0
    if part.law == "rounded":
        knots = _shaped(part)
        x, y = column([one.angle for one in knots]), column([one.pressure for one in knots])
        curve, where = (x, y, monotone_slopes(x, y)), np.array([cut])
        pressure, slope = hermite(*curve, where)[0], hermite_slope(*curve, where)[0]
    else:
        pressure = part.points[0].pressure
    middle = at[0] if at else Named(f"{AUXILIARY}0", cut, pressure)
    first = Part(part.law, (*before, middle), (part.slopes[0], slope), part.exponent, part.reference)
    second = Part(part.law, (middle, *after), (slope, part.slopes[1]), part.exponent, part.reference)
    return first, second


def _shaped(part: Part) -> tuple[Named, ...]:
    """Return the points of a curve with one more beside each end, which give it its end slopes."""
    points = part.points
    if len(points) == 2:
        return _shaped_alone(points[0], points[1], part.slopes)
    start = _beside(points[0], points[1], part.slopes[0])
    end = _beside(points[-1], points[-2], part.slopes[1])
    return (points[0], start, *points[1:-1], end, points[-1])


def _beside(end: Named, inner: Named, slope: Value) -> Named:
    """Return the point beside an end for which (2h0 + h1) d0 - h0 d1 = (h0 + h1) slope, d1 being the next chord."""
    whole = inner.angle - end.angle
    near, far = _BESIDE * whole, (1 - _BESIDE) * whole
    rise = inner.pressure - end.pressure
    chord = (slope * whole + near * rise / far) / (2 * near + far + near * near / far)
    return Named(f"{AUXILIARY}{end.name}{inner.name}", end.angle + near, end.pressure + near * chord)


def _shaped_alone(start: Named, end: Named, slopes: tuple[Value, Value]) -> tuple[Named, ...]:
    """Return two points with one more beside each, for both end slopes at once."""
    whole, rise = end.angle - start.angle, end.pressure - start.pressure
    near, far = _BESIDE, 1 - 2 * _BESIDE
    # slopes of chords times the whole angle: near (first + last) + far middle = rise, (2 near + far) first - near
    # middle = (near + far) slope at the start, and so at the end
    at_start, at_end = (slope * (near + far) * whole / (2 * near + far) for slope in slopes)
    spread = near / (2 * near + far)
    middle = (rise - near * (at_start + at_end)) / (far + 2 * near * spread)
    first, last = at_start + spread * middle, at_end + spread * middle
    return (
        start,
        Named(f"{AUXILIARY}{start.name}{end.name}", start.angle + near * whole, start.pressure + near * first),
        Named(f"{AUXILIARY}{end.name}{start.name}", end.angle - near * whole, end.pressure - near * last),
        end,
    )
