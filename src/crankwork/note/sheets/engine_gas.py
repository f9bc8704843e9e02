"""Indicator diagram, the Brix semicircle under it, and the pressure over the crank angle beside it."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import brix_points
from crankwork.note.sheets.graph import Axis, Curve, Graph, Side, graph, heading
from crankwork.note.sheets.placing import Named, lines_of, names_beside
from crankwork.note.sheets.words import Words
from crankwork.report.figure_data import Drawn
from crankwork.report.language import displayed
from crankwork.report.linkage_look import round_scale
from crankwork.show.scene import SMALL, Arc, Box, Circle, Item, Text, line, printable

RAYS = 30.0
# beside the curve of an indicator diagram: labels of the axis, the arrow and its symbol
_BESIDE, _UNDER = 38.0, 26.0
_TOP_CENTRE = 19.0


def displacement_scale(drawn: Drawn, box: Box, semicircle: Box) -> float:
    """Return how much of the stroke a millimetre is, so that diagram and semicircle both fit. [mm/mm]

    `box` and `semicircle`: of the indicator diagram and of the Brix semicircle [mm].
    """
    stroke = _stroke(drawn)
    longest = stroke
    if "cylinder_volume" in drawn.columns and drawn.results.solved.space is not None:
        longest = float(np.max(drawn.columns["cylinder_volume"])) / drawn.results.solved.space.area * 1e3
    return round_scale(max(longest / (box.width - _BESIDE), stroke / 2 / (semicircle.height - _UNDER)))


def _stroke(drawn: Drawn) -> float:
    return float(np.ptp(drawn.values("piston_displacement")))


def top_centre(drawn: Drawn, box: Box, scale: float) -> float:
    """Return where top dead centre is along the sheet: behind the clearance volume, if there is gas. [mm]"""
    space = drawn.results.solved.space
    return box.left + _TOP_CENTRE + (space.clearance / space.area * 1e3 / scale if space is not None else 0.0)


def indicator(drawn: Drawn, box: Box, words: Words, pressure_scale: float, scale: float) -> Graph:
    """Return the pressure over the volume, with dead centres and the named points of the diagram.

    `pressure_scale` and `scale`: of pressure [MPa/mm] and of the stroke [mm/mm]; a volume is an area times a
    displacement.
    """
    space = drawn.results.solved.space
    volume, pressure = drawn.values("cylinder_volume"), drawn.values("gas_pressure")
    volume_scale = displayed("cylinder_volume", space.area * scale / 1e3)
    x = Side(words.symbol("cylinder_volume"), "cm3", 0.0, float(np.max(volume)), volume_scale, box.left + _TOP_CENTRE)
    y = pressure_side(drawn, words, pressure_scale)
    shown = graph("indicator", box, (x, y), [Curve("gas_pressure", y.symbol, "", volume, pressure)], words)
    shown = shown.with_items(_dead_centres(drawn, shown, words))
    angle = [(name, degrees) for name, (degrees, _) in space.diagram.named.items()]
    points = [
        Named(printable(name), shown.point(float(np.interp(at, drawn.degrees, volume)), value))
        for (name, at), value in zip(angle, _named_pressures(drawn), strict=True)
    ]
    return shown.with_items(names_beside(points, lines_of(shown.items), _room(shown)))


def developed(drawn: Drawn, box: Box, words: Words, pressure_scale: float) -> Graph:
    """Return the pressure over the crank angle with the named points, in the scale of the indicator diagram.

    `box`: where; of the same height and foot as that of the indicator diagram [mm].
    """
    pressure, y = drawn.values("gas_pressure"), pressure_side(drawn, words, pressure_scale)
    curve = Curve("gas_pressure", y.symbol, "", drawn.degrees, pressure)
    shown = graph("developed", box, (angle_side(drawn, words), y), [curve], words)
    named = drawn.results.solved.space.diagram.named
    points = [
        Named(printable(name), shown.point(degrees, value))
        for (name, (degrees, _)), value in zip(named.items(), _named_pressures(drawn), strict=True)
    ]
    return shown.with_items(names_beside(points, lines_of(shown.items), _room(shown)))


def pressure_side(drawn: Drawn, words: Words, scale: float | None = None) -> Side:
    """Return the axis of pressures."""
    return value_side("gas_pressure", [drawn.values("gas_pressure")], words, scale)


def value_side(key: str, values: list[Array], words: Words, scale: float | None = None) -> Side:
    """Return the axis of a quantity, with zero on it.

    `values`: what it has to show, in the display unit; `words`: language, forces as they are or per piston area.
    """
    low = min(0.0, *(float(np.min(one)) for one in values))
    high = max(0.0, *(float(np.max(one)) for one in values))
    if high - low <= 0:
        high = 1.0
    return Side(words.symbol(key), words.unit_of(key), low, high, scale)


def angle_side(drawn: Drawn, words: Words, end: float | None = None) -> Side:
    """Return the axis of the crank angle, over the cycle or to an end. [deg]"""
    return Side(words.symbol("crank_angle"), "deg", 0.0, end or float(drawn.results.machine.cycle))


def _named_pressures(drawn: Drawn) -> list[float]:
    space = drawn.results.solved.space
    return [displayed("gas_pressure", space.gauge(value)) for _, value in space.diagram.named.values()]


def _room(shown: Graph) -> Box:
    """Return where names of points may go."""
    return shown.plot.inset(0.5, 0.5, -8.0, -4.0)


def _dead_centres(drawn: Drawn, shown: Graph, words: Words) -> list[Item]:
    """Return the lines of the dead centres, from the foot of the box up."""
    space = drawn.results.solved.space
    items: list[Item] = []
    for key, volume in (("tdc", space.clearance), ("bdc", space.clearance + space.swept)):
        at = float(shown.x.place(displayed("cylinder_volume", volume)))
        items.append(line((at, shown.box.bottom), (at, shown.y.end + 8.5), "axis"))
        items.append(Text((at, shown.y.end + 9.3), words.say(key), SMALL, "middle"))
    return items


def brix(drawn: Drawn, box: Box, words: Words, scale: float, at: float) -> Graph:
    """Return the semicircle of Brix: rays from the shifted pole cut off the displacements of the piston.

    `drawn`: what the graphs share; of an engine whose cylinder is not offset. Source: kolchin_demidov_2008, ch. 6.
    """
    lengths = drawn.results.solved.lengths
    radius, shift = lengths.crank_radius * 1e3 / scale, lengths.crank_radius * lengths.rod_ratio / 2 * 1e3 / scale
    base = box.top - 6.0
    x = Axis(words.symbol("piston_displacement"), "mm", scale, at, at, at + 2 * radius)
    y = Axis("", "mm", scale, base, base - radius, base)
    # the heading follows the semicircle where its box is higher
    low = max(box.bottom, base - radius - 26.0)
    middle, pole = np.array([at + radius, base]), np.array([at + radius + shift, base])
    items: list[Item] = [
        line((at - 4, base), (at + 2 * radius + 4, base)),
        Arc((at + radius, base), radius, 180.0, 360.0, "thick"),
        line((at + radius, base + 3), (at + radius, base - radius), "axis"),
    ]
    items += [line((x, low + 17), (x, box.top), "axis") for x in (at, at + 2 * radius)]
    points, angles = [], np.arange(0.0, 181.0, RAYS)
    found = brix_points(lengths, angles)
    # the axis of the engine lies, its top on the left
    for degrees, foot in zip(angles, middle - radius * np.column_stack([found.up, found.across]), strict=True):
        items += [line(pole, foot), line(foot, (foot[0], base), "net")]
        items.append(line((foot[0], base - 1.2), (foot[0], base + 1.2)))
        if not 0 < degrees < 180:
            continue
        outside = (foot - middle) / radius
        place = foot + outside * 4.5
        points.append(Text((float(place[0]), float(place[1] - SMALL / 2)), f"{degrees:g}°", SMALL, "middle"))
    items += [Circle((float(one[0]), float(one[1])), 0.8, "thin", 1.0) for one in (middle, pole)]
    items += [
        Text((float(middle[0] - 1.5), base - 5), "O", anchor="end"),
        Text((float(pole[0] + 1.5), base + 1.2), "O′"),
    ]
    for name, x_at, anchor in (("tdc", at - 2, "end"), ("bdc", at + 2 * radius + 2, "start")):
        items.append(Text((x_at, base + 1.0), words.say(name), SMALL, "end" if anchor == "end" else "start"))
    foot_box = Box(box.left, low, box.width, 15.0)
    lower = heading(words.say("brix"), [], [], foot_box)
    shown = f"OO′ = {words.number(shift * scale)} {words.unit('mm')}"
    lower.append(Text((box.left + 1.5, low + 2.0), words.scale(x.symbol, scale, "mm")))
    lower.append(Text((box.right - 1.5, low + 2.0), shown, anchor="end"))
    return Graph("brix", box, x, y, (*items, *points, *lower))
