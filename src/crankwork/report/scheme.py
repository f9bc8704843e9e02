"""The scheme of a crank gear: its lengths and angles, its forces and the senses in which they are counted."""

from __future__ import annotations

import math

import numpy as np

from crankwork.analysis import Array
from crankwork.quantities import Language
from crankwork.report.display import symbol
from crankwork.show.canvas import Canvas
from crankwork.show.scene import DASH_DOT, Anchor, Drawing

# paper, centre of the crank, and the lengths that are drawn, of no machine [pt]
_WIDTH, _HEIGHT = 260.0, 310.0
_CENTRE, _CRANK, _ROD = np.array([120.0, 236.0]), 62.0, 158.0
_ANGLE, _FORCE, _BORE, _PISTON = math.radians(48.0), 56.0, 56.0, 34.0
_ACCENT = "#1f5fae"


def crank_gear_scheme(title: str, language: Language = "en") -> Drawing:
    """Return the scheme of a crank gear with its axis upward and its crank turning clockwise; not to scale."""
    canvas = Canvas(_WIDTH, _HEIGHT)
    along, across = np.array([math.sin(_ANGLE), -math.cos(_ANGLE)]), np.array([math.cos(_ANGLE), math.sin(_ANGLE)])
    pin = _CENTRE + _CRANK * along
    tilt = math.asin(_CRANK * math.sin(_ANGLE) / _ROD)
    rod = np.array([math.sin(tilt), math.cos(tilt)])
    piston = pin - _ROD * rod
    _mechanism(canvas, pin, piston)
    _angles(canvas, tilt, piston, language)
    _lengths(canvas, pin, piston, rod, across, language)
    side = _FORCE * math.tan(tilt)
    forces = (
        ("piston_force", piston, np.array([0.0, _FORCE]), (-5.0, 0.0)),
        ("side_force", piston, np.array([-max(side, 26.0), 0.0]), (2.0, -6.0)),
        ("rod_force", pin, 0.9 * _FORCE * rod, (5.0, 8.0)),
        ("tangential_force", pin, _FORCE * math.sin(_ANGLE + tilt) * across, (6.0, 2.0)),
        ("radial_force", pin, -_FORCE * max(math.cos(_ANGLE + tilt), 0.45) * along, (5.0, 9.0)),
    )
    for key, start, reach, (right, down) in forces:
        end = start + reach
        canvas.arrow(start.tolist(), end.tolist(), width=0.9, colour=_ACCENT)
        anchor: Anchor = "end" if right < 0 else "start"
        text = f"${symbol(key, language)}$"
        canvas.text(end[0] + right, end[1] + down, text, size=10.0, anchor=anchor, colour=_ACCENT)
    return canvas.drawing(title, language)


def _mechanism(canvas: Canvas, pin: Array, piston: Array) -> None:
    """Draw axis, crank circle, crank, rod, piston and cylinder walls."""
    (x, y), top = _CENTRE, piston[1] - _PISTON / 2 - 30.0
    canvas.line([x, x], [top - 12.0, y + _CRANK + 10.0], style=DASH_DOT, width=0.45)
    circle = np.linspace(0.0, 2 * math.pi, 121)
    canvas.line(x + _CRANK * np.sin(circle), y - _CRANK * np.cos(circle), style=(4.0, 4.0), width=0.45)
    for wall, side in ((x - _BORE / 2, -1.0), (x + _BORE / 2, 1.0)):
        canvas.line([wall, wall], [top, piston[1] + 46.0], width=0.9)
        ends = [(wall, lower, wall + side * 6.0, lower - 6.0) for lower in np.arange(top + 6.0, piston[1] + 46.0, 8.0)]
        canvas.segments(np.array(ends), width=0.45)
    half = _BORE / 2 - 1.5
    left, right, up, down = x - half, x + half, piston[1] - _PISTON / 2, piston[1] + _PISTON / 2
    canvas.area([left, right, right, left], [up, up, down, down], fill="#eeeeee", width=0.9)
    canvas.line([piston[0], pin[0]], [piston[1], pin[1]], width=0.9)
    canvas.line([x, pin[0]], [y, pin[1]], width=0.9)
    for place in (_CENTRE, pin, piston):
        canvas.dot(place[0], place[1], 3.0, fill="#ffffff", width=0.9)


def _angles(canvas: Canvas, tilt: float, piston: Array, language: Language) -> None:
    """Draw crank angle, rod angle and the sense of rotation."""
    (x, y), radius = _CENTRE, 26.0
    turn = np.linspace(0.0, _ANGLE, 25)
    canvas.line(x + radius * np.sin(turn[:-3]), y - radius * np.cos(turn[:-3]), width=0.45)
    _head(canvas, _CENTRE, radius, _ANGLE)
    middle = _ANGLE / 2
    canvas.text(
        x + 34.0 * math.sin(middle) - 3.0,
        y - 34.0 * math.cos(middle),
        f"${symbol('crank_angle', language)}$",
        size=10.0,
    )
    radius, swing = 74.0, np.linspace(0.0, tilt, 15)
    canvas.line(piston[0] + radius * np.sin(swing), piston[1] + radius * np.cos(swing), width=0.45)
    canvas.text(piston[0] + 4.0, piston[1] + radius + 11.0, f"${symbol('rod_angle', language)}$", size=10.0)
    radius, sweep = _CRANK + 9.0, np.radians(np.linspace(200.0, 262.0, 40))
    canvas.line(x + radius * np.sin(sweep[:-2]), y - radius * np.cos(sweep[:-2]), width=0.9)
    _head(canvas, _CENTRE, radius, sweep[-1])
    canvas.text(
        x - radius - 8.0, y + 8.0, f"${symbol('speed', language)}$, ${symbol('crank_torque', language)}$",
        size=10.0, anchor="end",
    )  # fmt: skip


def _head(canvas: Canvas, centre: Array, radius: float, angle: float) -> None:
    """Draw the head of a clockwise arrow on a circle, which ends at an angle from the axis."""
    back = angle - 7.0 / radius
    start, end = (centre + radius * np.array([math.sin(turned), -math.cos(turned)]) for turned in (back, angle))
    canvas.arrow(start.tolist(), end.tolist(), width=0.45)


def _lengths(canvas: Canvas, pin: Array, piston: Array, rod: Array, across: Array, language: Language) -> None:
    """Name crank and rod, and draw the displacement of the piston from its upper end."""
    middle = _CENTRE + 0.3 * (pin - _CENTRE) + 10.0 * across
    canvas.text(middle[0], middle[1], f"${symbol('crank_radius', language)}$", size=10.0)
    middle = piston + 0.62 * _ROD * rod + np.array([7.0, -2.0])
    canvas.text(middle[0], middle[1], f"${symbol('rod_length', language)}$", size=10.0)
    level, right = _CENTRE[1] - _CRANK - _ROD, _CENTRE[0] + _BORE / 2 + 16.0
    for height in (level, piston[1]):
        canvas.line([_CENTRE[0], right + 4.0], [height, height], width=0.45)
    canvas.arrow((right, level), (right, piston[1]), width=0.45)
    canvas.text(right + 5.0, (level + piston[1]) / 2 + 3.0, f"${symbol('piston_displacement', language)}$", size=10.0)
