"""The mechanism as one moving SVG: any linkage, link by link, from the motion of its named points."""

from __future__ import annotations

import html
import math
import re
import string
from typing import NamedTuple

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import Motion, motion
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import RRP
from crankwork.quantities import LANGUAGES, Language
from crankwork.report import drawing_parts as parts
from crankwork.report.drawing_parts import Stage
from crankwork.report.language import displayed, key_unit, label, number, symbol, unit_name

_SIZE = 420.0
_MARGIN, _FOOTER, _NARROWEST = 34.0, 44.0, 260.0
_STILL = 60.0
_READOUT = 15
_TITLES = ("moving drawing of the mechanism", "движущаяся схема механизма", "sơ đồ chuyển động của cơ cấu")
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class _Slider(NamedTuple):
    """A block in its guide: half sizes of the block, ends of the guide along it [px], and whether a head closes it."""

    dyad: RRP
    half_width: float
    half_height: float
    start: float
    end: float
    is_closed: bool


def moving_drawing(machine: Machine, *, language: Language = "en", seconds: float = 4.0, frames: int = 72) -> str:
    """Return the mechanism of a machine as an SVG that moves by itself, one revolution after the other.

    Lengths are to scale and the motion is exact; strokes, joints and letters have their own size.

    Parameters
    ----------
    machine : Machine
        What is drawn; its bore and clearance, if known, give the cylinder.
    language : str
        Language of title, description and numbers.
    seconds : float
        Time of one revolution. [s]
    frames : int
        Positions per revolution; between them points move on straight lines.

    Returns
    -------
    str
        A standalone SVG without script.

    Raises
    ------
    CrankworkError
        If the mechanism cannot turn, or fewer than 8 frames or no time are asked for.
    """
    if frames < 8 or not 0 < seconds < math.inf:
        raise CrankworkError("a moving drawing needs at least 8 frames and a time above zero")
    moving = motion(machine.mechanism, CrankGrid.from_degrees(np.arange(frames + 1) * 360 / frames))
    stage = Stage(_scale(moving, machine), f"{seconds:g}s", round(frames * _STILL / 360))
    sliders = [_slider(machine, dyad, moving, stage) for dyad in machine.mechanism.dyads]
    x, y, width, height = _view_box(machine, moving, stage, sliders)
    body = [
        *_fixed(machine, moving, stage, sliders),
        *_links(machine, moving, stage, sliders),
        *_names(machine, moving, stage, sliders),
        parts.scale_bar(x + _MARGIN / 2, y + height - 16, stage.scale, 0.3 * width, language),
        _readout(x + width - _MARGIN / 2, y + height - 16, stage, language),
    ]
    box = f"{x:.0f} {y:.0f} {width:.0f} {height:.0f}"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{width:.0f}" height="{height:.0f}" role="img">'
    )
    title, description = _title(machine, language), _description(machine, language, seconds)
    back = f'<rect x="{x:.0f}" y="{y:.0f}" width="{width:.0f}" height="{height:.0f}" fill="white"/>'
    lines = [head, f"<title>{title}</title>", f"<desc>{description}</desc>", back, *body, "</svg>", ""]
    return "\n".join(lines)


def _scale(moving: Motion, machine: Machine) -> float:
    """Return how many pixels a metre takes."""
    pivot_x, pivot_y = machine.mechanism.crank.pivot
    bore = machine.cylinder.bore if machine.cylinder else 0.0
    across = np.concatenate([[pivot_x], *(point.x.position for point in moving.points.values())])
    upward = np.concatenate([[pivot_y], *(point.y.position for point in moving.points.values())])
    return float(_SIZE / max(np.ptp(across), np.ptp(upward), 1.5 * bore))


def _slider(machine: Machine, dyad: RRP, moving: Motion, stage: Stage) -> _Slider:
    """Return block and guide of a slider; the guide of a cylinder ends at the head, the clearance above the piston."""
    along = moving.sliders[dyad.slider].position
    low, high = float(np.min(along)) * stage.scale, float(np.max(along)) * stage.scale
    stroke, cylinder = high - low, machine.cylinder
    half_width = max(stage.scale * cylinder.bore / 2 if cylinder else 0.4 * stroke, 24.0)
    half_height = max(min(0.6 * half_width, 0.45 * stroke), 14.0)
    gap = 0.2 * half_height
    if cylinder and cylinder.clearance_volume is not None:
        gap = stage.scale * cylinder.clearance_volume / (math.pi / 4 * cylinder.bore**2)
    elif cylinder and cylinder.compression_ratio is not None:
        gap = stroke / (cylinder.compression_ratio - 1)
    end = high + half_height + min(max(gap, 5.0), stroke)
    return _Slider(dyad, half_width, half_height, low - 0.4 * half_height, end, machine.gas is not None)


def _view_box(
    machine: Machine, moving: Motion, stage: Stage, sliders: list[_Slider]
) -> tuple[float, float, float, float]:
    """Return left, top, width and height of a picture in which nothing is cut off at any angle. [px]"""
    pivot = stage.fixed(machine.mechanism.crank.pivot)
    reach = [pivot + np.array(parts.GROUND_REACH)]
    reach += [stage.points(point) for point in moving.points.values()]
    for one in sliders:
        around = one.half_width + parts.HATCH
        walls = [(one.start - 2 * one.half_height, around), (one.end + parts.HATCH, around)]
        reach += [parts.on_guide(one.dyad, stage, s, side * t) for s, t in walls for side in (1, -1)]
    corners = np.vstack(reach)
    (left, top), (right, bottom) = corners.min(axis=0), corners.max(axis=0)
    spare = max(0.0, _NARROWEST - 2 * _MARGIN - (right - left)) / 2
    left, right = left - spare - _MARGIN, right + spare + _MARGIN
    return left, top - _MARGIN, right - left, bottom - top + 2 * _MARGIN + _FOOTER


def _fixed(machine: Machine, moving: Motion, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Draw what stands still: centre lines, the path of the crank pin, guides and the pivot."""
    crank = machine.mechanism.crank
    pivot, arm = stage.fixed(crank.pivot), crank.radius * stage.scale + 16
    drawn = [
        parts.centre_line(parts.moved(pivot, -right, -down), parts.moved(pivot, right, down))
        for right, down in ((arm, 0.0), (0.0, arm))
        if not any(parts.is_on_guide(one.dyad, crank.pivot, (right, -down)) for one in sliders)
    ]
    drawn.append(parts.path(stage.points(moving.points[crank.pin])))
    for one in sliders:
        foot = parts.foot_on_guide(one.dyad, stage, crank.pivot)
        ends = (min(foot, one.start) - 16, max(foot, one.end) + 20)
        drawn.append(parts.centre_line(*(parts.on_guide(one.dyad, stage, end, 0.0) for end in ends)))
        walls = (one.start, one.end, one.half_width + 1.5)
        drawn.append(parts.guide(one.dyad, stage, *walls, is_closed=one.is_closed))
    return [*drawn, parts.ground_pivot(pivot)]


def _links(machine: Machine, moving: Motion, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Draw what moves: blocks, links between their points, and joints upon them."""
    crank, dyads = machine.mechanism.crank, machine.mechanism.dyads
    at = {name: stage.points(point) for name, point in moving.points.items()}
    pivot = np.broadcast_to(stage.fixed(crank.pivot), at[crank.pin].shape)
    drawn = [parts.block(one.dyad, stage, at[one.dyad.slider], one.half_width, one.half_height) for one in sliders]
    drawn += [parts.link(stage, one.link, at[one.joint], at[one.slider], 3.0) for one in reversed(dyads)]
    drawn.append(parts.link(stage, crank.link, pivot, at[crank.pin], 5.0))
    return [*drawn, *(parts.joint(stage, place) for place in (pivot, *at.values()))]


def _names(machine: Machine, moving: Motion, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Write letters at the points and numbers at the links: 0 the frame, 1 the crank, then dyad by dyad."""
    crank = machine.mechanism.crank
    at = {name: stage.points(point) for name, point in moving.points.items()}
    pivot = np.broadcast_to(stage.fixed(crank.pivot), at[crank.pin].shape)
    letters = iter("ABCDEFGHIJKLMNPQRSTUVWXYZ" + string.ascii_lowercase)
    outward = parts.direction(pivot, at[crank.pin])
    drawn = [
        parts.name(stage, parts.moved(pivot, -22, 20), "O"),
        parts.number(stage, parts.moved(pivot, 32, 24), 0),
        parts.name(stage, at[crank.pin] + 17 * outward, next(letters)),
        parts.number(stage, (pivot + at[crank.pin]) / 2 + 13 * parts.normal(outward), 1),
    ]
    for count, one in enumerate(sliders):
        joint, pin = at[one.dyad.joint], at[one.dyad.slider]
        side = parts.on_guide(one.dyad, stage, 0.0, 1.0) - parts.on_guide(one.dyad, stage, 0.0, 0.0)
        along = parts.direction(joint, pin)
        drawn.append(parts.number(stage, (joint + pin) / 2 + 13 * parts.normal(along), 2 + 2 * count))
        drawn.append(parts.name(stage, pin - 14 * side, next(letters)))
        drawn.append(parts.number(stage, pin + max(14.0, one.half_width - 12) * side, 3 + 2 * count))
    return drawn


def _readout(x: float, y: float, stage: Stage, language: Language) -> str:
    """Write the crank angle, one text per step, each shown in its turn."""
    count = 360 // _READOUT
    sign, unit = symbol("crank_angle", language), unit_name("deg", language)
    texts = []
    for step in range(count):
        shown = ["hidden", "visible", "hidden"][0 if step else 1 : 3 if step < count - 1 else 2]
        times = [0.0, step / count, (step + 1) / count][0 if step else 1 : 3 if step < count - 1 else 2]
        angle = step * _READOUT
        text = f'<tspan font-style="italic">{sign}</tspan> = {angle}{unit}'
        turns = parts.animate("visibility", shown, stage, times=times)
        still = "visible" if angle == _STILL else "hidden"
        texts.append(f'<text x="{x:.1f}" y="{y:.1f}" visibility="{still}">{text}{turns}</text>')
    return f'<g class="angle" {parts.FONT} text-anchor="end">{"".join(texts)}</g>'


def _title(machine: Machine, language: Language) -> str:
    what = _TITLES[LANGUAGES.index(language)]
    own = _NOT_XML.sub("", machine.title).strip()
    return html.escape(f"{own}: {what}" if own else what[0].upper() + what[1:])


def _description(machine: Machine, language: Language, seconds: float) -> str:
    """Return the lengths in words, and the time of a revolution."""
    lengths = [("crank_radius", machine.mechanism.crank.radius)]
    lengths += [("rod_length", dyad.length) for dyad in machine.mechanism.dyads]
    texts = [
        f"{label(key, language)} {number(displayed(key, value), language)} {unit_name(key_unit(key), language)}"
        for key, value in lengths
    ]
    turn = {"en": "one revolution in {} s", "ru": "один оборот за {} с", "vi": "một vòng quay trong {} s"}[language]
    return html.escape("; ".join([*texts, turn.format(number(seconds, language))]))
