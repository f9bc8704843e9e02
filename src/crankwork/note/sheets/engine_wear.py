"""The wear diagram of the crankpin: the sums of loads on each ray as depth below its surface."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.locale import say
from crankwork.note.sheets.engine_forces import crankpin_name
from crankwork.note.sheets.graph import Axis, Graph, heading, titled
from crankwork.note.sheets.words import Words
from crankwork.report.figure_data import Drawn
from crankwork.report.language import displayed
from crankwork.report.linkage_look import round_scale
from crankwork.show.scene import SMALL, TEXT, Box, Circle, Hatch, Item, Polyline, Text, line

_DEEPEST = 0.55
_BETWEEN = 12


def wear(drawn: Drawn, extra: Mapping[str, Array | float], box: Box, words: Words) -> Graph | None:
    """Return the wear diagram, or None where no sums are known.

    `extra`: with `wear_sums` and `wear_angle`, as `engine_sheets` says.
    """
    if "wear_sums" not in extra:
        return None
    sums = np.asarray(extra["wear_sums"], dtype=float) * displayed("piston_force", 1.0, per_area=drawn.area)
    angles = np.asarray(extra.get("wear_angle", np.arange(sums.size) * 2 * np.pi / max(sums.size, 1)), dtype=float)
    if sums.ndim != 1 or sums.size < 3 or angles.shape != sums.shape or not np.any(sums > 0):
        raise CrankworkError("wear_sums and wear_angle do not fit; give at least three sums and an angle for each")
    radius = min(box.width / 2 - 16.0, (box.height - 20.0) / 2 - 10.5)
    scale = round_scale(float(np.max(sums)) / (_DEEPEST * radius))
    centre = np.array([box.left + box.width / 2, box.bottom + 12.0 + radius])
    sign = "Σ" + say("symbols.sheet_load", words.language).partition("_")[0]
    depth = Axis(sign, words.unit_of("piston_force"), scale, 0.0, 0.0, radius)
    items = _ring(sums, angles, centre, (radius, scale))
    items += _rays(angles, centre, radius)
    at = float(extra.get("oil_hole_angle", angles[int(np.argmin(sums))]))
    hole = centre + (radius - 3.0) * _towards(at)
    items.append(Circle((float(hole[0]), float(hole[1])), 2.0, "medium", 1.0))
    title = titled(words.say("wear"), crankpin_name(extra, words.language))
    items += heading(title, [words.scale(sign, scale, depth.unit)], [], box)
    items.append(Circle((box.left + 3.0, box.bottom + 3.0), 1.4, "medium", 1.0))
    items.append(Text((box.left + 6.0, box.bottom + 3.0 - TEXT / 2), words.say("oil_hole")))
    ends = "; ".join(
        f"{sign}_{{{name}}} = {words.number(value, 3)} {words.unit(depth.unit)}"
        for name, value in (("max", float(sums.max())), ("min", float(sums.min())))
    )
    items.append(Text((box.right - 2.0, box.bottom + 3.0 - TEXT / 2), ends, TEXT, "end"))
    return Graph("wear", box, depth, depth, tuple(items))


def _towards(angle: float) -> Array:
    """Return a direction counted from the outer side of the pin, upward, with the rotation, clockwise."""
    return np.array([np.sin(angle), np.cos(angle)])


def _ring(sums: Array, angles: Array, centre: Array, size: tuple[float, float]) -> list[Item]:
    """Return the circle of the pin, the line of wear under it, and the hatch between."""
    radius, scale = size
    order = np.argsort(angles % (2 * np.pi))
    known = np.append(angles[order] % (2 * np.pi), angles[order][0] % (2 * np.pi) + 2 * np.pi)
    depth = np.append(sums[order], sums[order][0]) / scale
    fine = np.concatenate([np.linspace(a, b, _BETWEEN, endpoint=False) for a, b in itertools.pairwise(known)])
    fine = np.append(fine, known[-1])
    around = np.array([_towards(one) for one in fine])
    inner = centre + around * (radius - np.interp(fine, known, depth))[:, None]
    outer = centre + around * radius
    return [
        Hatch(np.vstack([outer, inner[::-1]])),
        Circle((float(centre[0]), float(centre[1])), radius, "thick"),
        Polyline(inner, "thick", name="wear_sums"),
    ]


def _rays(angles: Array, centre: Array, radius: float) -> list[Item]:
    """Return the rays with their numbers outside of the pin, and axes through its middle."""
    x, y = centre
    items: list[Item] = [
        line((x - radius - 2, y), (x + radius + 2, y), "axis"), line((x, y - radius - 2), (x, y + radius + 2), "axis")
    ]  # fmt: skip
    for count, angle in enumerate(angles):
        end, text = centre + radius * _towards(angle), centre + (radius + 5.0) * _towards(angle)
        items.append(line(centre + 0.12 * radius * _towards(angle), end, "net"))
        items.append(Text((float(text[0]), float(text[1]) - SMALL / 2), str(count + 1), SMALL, "middle"))
    return items
