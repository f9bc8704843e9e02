"""Quantities of a linkage over the crank angle, and the energy-mass diagram, as graphs of a sheet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import Fluctuation, tangents
from crankwork.note.sheets.graph import KINDS, Curve, Graph, Side, graph
from crankwork.note.sheets.placing import Named, lines_of, names_beside
from crankwork.note.sheets.words import Words
from crankwork.report.linkage_look import displayed_values, quantity_of
from crankwork.report.tables import any_nonzero
from crankwork.show.scene import Box, Item, Polyline, Text, indexed, line, printable

MOST = len(KINDS)
_MARK = 30.0
# what may run far from zero
_FAR = frozenset(("crank_speed", "slider_displacement", "link_angle"))


def over_angle(
    name: str, keys: Sequence[str], known: Mapping[str, Array], degrees: Array, box: Box, words: Words
) -> Graph | None:
    """Return quantities of one unit over the crank angle, or over time, or None if none of them is known.

    `name`: key of the title among the words of sheets; `keys`: keys of the columns; the first five that are there are
    drawn.
    """
    present = any_nonzero(keys, known)[:MOST]
    if not present:
        return None
    curves, language = [], words.language
    for key, kind in zip(present, KINDS, strict=False):
        row = quantity_of(key)
        symbol = indexed(printable(row.symbol(language)))
        text = printable(row.label(language), 60) if len(present) > 1 else ""
        curves.append(Curve(key, symbol, text, degrees, displayed_values(row, known[key]), kind))
    if words.period:
        curves = [one._replace(x=one.x / 360.0 * words.period) for one in curves]
    elif degrees[0] == 0 and degrees[-1] < 360 and 360 - degrees[-1] <= degrees[1] - degrees[0] + 1e-9:
        # a table of a whole turn ends before the angle at which it starts again
        curves = [one._replace(x=np.append(one.x, 360.0), y=np.append(one.y, one.y[0])) for one in curves]
    low, high = _reach(name, curves)
    first = quantity_of(present[0])
    symbols = ", ".join(dict.fromkeys(one.symbol for one in curves)) if len(curves) < 4 else curves[0].symbol[:1]
    side = Side(symbols, first.unit, low, high)
    return graph(name, box, (_angles(curves, words), side), curves, words)


def _reach(name: str, curves: Sequence[Curve]) -> tuple[float, float]:
    """Return least and largest value, with zero between them but where it is far away."""
    low, high = min(float(np.nanmin(one.y)) for one in curves), max(float(np.nanmax(one.y)) for one in curves)
    if name in _FAR and high - low < 0.4 * max(abs(low), abs(high)):
        spare = 0.05 * (high - low) or 0.01 * abs(high)
        return low - spare, high + spare
    return min(0.0, low), max(0.0, high)


def _angles(curves: Sequence[Curve], words: Words) -> Side:
    ends = curves[0].x[[0, -1]]
    sign, unit = ("time", "s") if words.period else ("crank_angle", "deg")
    return Side(words.symbol(sign), unit, float(ends[0]), float(ends[1]))


def wittenbauer(known: Mapping[str, Array], degrees: Array, wanted: Fluctuation, box: Box, words: Words) -> Graph:
    """Return the energy-mass diagram, its tangents and the piece kl that they cut from the energy axis."""
    inertia, energy = known["reduced_inertia"], known["kinetic_energy_change"]
    found = tangents(inertia, energy, wanted)
    feet, slopes = (found.foot_max, found.foot_min), (found.slope_max, found.slope_min)
    width = float(np.max(inertia)) * 1.05
    low, high = min(0.0, *feet, float(energy.min())), max(0.0, *feet, float(energy.max()))
    sides = (
        Side(words.symbol("reduced_inertia"), "kg*m2", 0.0, width),
        Side(words.symbol("kinetic_energy_change"), "J", low, high),
    )
    curve = Curve("kinetic_energy_change", sides[1].symbol, "", inertia, energy)
    shown = graph("wittenbauer", box, sides, [curve], words)
    items: list[Item] = []
    angles = []
    for foot, slope, touch, name in zip(feet, slopes, (found.touch_max, found.touch_min), ("max", "min"), strict=True):
        end = _clipped(foot, slope, width, (low, high))
        items.append(Polyline(np.array([shown.point(0.0, foot), shown.point(*end)]), "thin", name=f"tangent_{name}"))
        touched = shown.point(float(inertia[touch]), float(energy[touch]))
        items.append(line(np.add(touched, (-1.5, 0)), np.add(touched, (1.5, 0))))
        on_paper = np.degrees(np.arctan(slope * shown.x.scale / shown.y.scale))
        angles.append(f"ψ_{{{name}}} = {words.number(float(on_paper))}°")
    marks = [int(np.argmin(np.abs(degrees - one))) for one in np.arange(0.0, float(degrees[-1]) - 1, _MARK)]
    points = [Named(f"{degrees[i]:g}", shown.point(float(inertia[i]), float(energy[i]))) for i in marks]
    points += [Named("k", shown.point(0.0, feet[0])), Named("l", shown.point(0.0, feet[1]))]
    items += names_beside(points, lines_of([*shown.items, *items]), shown.plot.inset(-6, -2, -4, -4))
    kl = abs(feet[0] - feet[1]) / shown.y.scale
    texts = [*angles, f"kl = {words.number(kl)} {words.unit('mm')}"]
    texts.append(f"{words.symbol('flywheel_inertia')} = {words.number(found.flywheel)} {words.unit('kg*m2')}")
    for count, text in enumerate(texts):
        items.append(Text((box.right - 2.0, box.top - 6.0 - 5.0 * count), text, 3.0, "end"))
    return shown.with_items(items)


def _clipped(foot: float, slope: float, width: float, reach: tuple[float, float]) -> tuple[float, float]:
    """Return where a line from the axis leaves the plot."""
    end = foot + slope * width
    if end > reach[1]:
        return (reach[1] - foot) / slope, reach[1]
    if end < reach[0]:
        return (reach[0] - foot) / slope, reach[0]
    return width, end
