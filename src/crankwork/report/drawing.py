"""The mechanism as one moving SVG: crank gears as engines are drawn, any other linkage link by link."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Sequence

from crankwork.analysis.moving import Course, course, drawn_mechanism, moving
from crankwork.analysis.skeleton import skeleton
from crankwork.errors import CrankworkError
from crankwork.locale import capital, say
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report import drawing_parts as parts
from crankwork.report.drawing_parts import Box, Stage
from crankwork.report.language import displayed, key_unit, label, symbol
from crankwork.report.linkage_drawing import linkage_drawing
from crankwork.report.linkage_engine import crank_gear, engine_drawing

_MARGIN, _FOOTER, _NARROWEST = 34.0, 44.0, 260.0
_STILL = 60.0
_READOUT = 15
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def moving_drawing(
    machine: Machine | Mechanism,
    *,
    language: Language = "en",
    seconds: float = 4.0,
    frames: int = 72,
    links: Sequence[str] = (),
    free: Course | None = None,
) -> str:
    """Return the mechanism of a machine as an SVG that moves by itself, one revolution after the other, or to and fro.

    Lengths are to scale and the motion is exact, points moving on straight lines between frames; strokes, joints,
    blocks and letters have their own size. Links are in the order of their numbers, as `Structure.links` gives them;
    without them those of a Machine, or group after group. `free`: how the crank of a machine let go moves, which is
    then drawn in its own time.
    """
    if frames < 8 or not 0 < seconds < math.inf:
        raise CrankworkError("a moving drawing needs at least 8 frames and a time above zero")
    mechanism, whole = (machine, None) if isinstance(machine, Mechanism) else (drawn_mechanism(machine), machine)
    way = free or course(mechanism, frames)
    seconds, frames = (way.own_time or seconds), len(way.degrees) - 1
    mechanism, moved = way.mechanism, moving(way.mechanism, way.degrees)
    duration, still = f"{seconds:g}s", round(frames * _STILL / mechanism.period)
    if whole is not None and whole.linkage is not None and not links:
        found, _ = structure(whole.linkage)
        links = found.links if found else ()
    gear = crank_gear(mechanism, whole.cylinder if whole else None, has_gas=bool(whole and whole.gas))
    if gear:
        drawn, reach, scale = engine_drawing(gear, moved, duration, still)
    else:
        drawn, reach, scale = linkage_drawing(skeleton(mechanism, links), moved, duration, still)
    x, y, width, height = _view_box(reach)
    stage = Stage(scale, duration, still)
    foot = [
        parts.scale_bar(x + _MARGIN / 2, y + height - 16, scale, 0.3 * width, language),
        _readout(x + width - _MARGIN / 2, y + height - 16, stage, way, language),
    ]
    box = f"{x:.0f} {y:.0f} {width:.0f} {height:.0f}"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{width:.0f}" height="{height:.0f}" role="img">'
    )
    title = _title(whole.title if whole else "", language)
    about = _description(way, language, seconds, links)
    back = f'<rect x="{x:.0f}" y="{y:.0f}" width="{width:.0f}" height="{height:.0f}" fill="white"/>'
    lines = [head, f"<title>{title}</title>", f"<desc>{about}</desc>", back, *drawn, *foot, "</svg>", ""]
    return "\n".join(lines)


def _view_box(reach: Box) -> tuple[float, float, float, float]:
    """Return left, top, width and height of a picture with room around what is drawn. [px]"""
    left, top, right, bottom = reach
    spare = max(0.0, _NARROWEST - 2 * _MARGIN - (right - left)) / 2
    left, right = left - spare - _MARGIN, right + spare + _MARGIN
    return left, top - _MARGIN, right - left, bottom - top + 2 * _MARGIN + _FOOTER


def period_of(mechanism: Mechanism) -> float:
    """Return the period of the law that drives; zero where a crank turns all the time. [s]"""
    return 0.0 if mechanism.driver.law is None else mechanism.driver.law.period


def _readout(x: float, y: float, stage: Stage, way: Course, language: Language) -> str:
    """Write the crank angle or the time, one text per step, each shown in its turn."""
    count, period = round(way.mechanism.period) // _READOUT, way.own_time or period_of(way.mechanism)
    sign, unit = symbol("crank_angle", language), unit_name("deg", language)
    if period:
        sign, unit = symbol("time", language), f" {unit_name('s', language)}"
    frames = len(way.degrees) - 1
    texts = []
    for step in range(count):
        shown = ["hidden", "visible", "hidden"][0 if step else 1 : 3 if step < count - 1 else 2]
        times = [0.0, step / count, (step + 1) / count][0 if step else 1 : 3 if step < count - 1 else 2]
        # to and fro, the angle in the middle of the time for which it is shown
        angle = step * _READOUT if way.turns else round(float(way.degrees[round((step + 0.5) / count * frames)]))
        shown_angle = number(period * step / count, language, digits=3) if period else number(angle, language)
        text = f'<tspan font-style="italic">{sign}</tspan> = {shown_angle}{unit}'
        turns = parts.animate("visibility", shown, stage, times=times)
        still = "visible" if step * _READOUT == _STILL else "hidden"
        texts.append(f'<text x="{x:.1f}" y="{y:.1f}" visibility="{still}">{text}{turns}</text>')
    return f'<g class="angle" {parts.FONT} text-anchor="end">{"".join(texts)}</g>'


def _title(title: str, language: Language) -> str:
    what = say("drawing.moving_drawing", language)
    own = _NOT_XML.sub("", title).strip()
    return html.escape(f"{own}: {what}" if own else capital(what))


def _description(way: Course, language: Language, seconds: float, links: Sequence[str]) -> str:
    """Return the lengths in words, what the numbers stand for, and the time of a revolution, or of to and fro."""
    mechanism = way.mechanism
    gear = crank_gear(mechanism)
    lengths = [("crank_radius", mechanism.driver.radius)] if isinstance(mechanism.driver, Crank) else []
    lengths += [("rod_length", rod.length) for rod in (gear.rods if gear else ())]
    texts = [
        f"{label(key, language)} {number(displayed(key, value), language)} {unit_name(key_unit(key), language)}"
        for key, value in lengths
    ]
    if not gear:
        members = sorted(skeleton(mechanism, links).members, key=lambda one: one.number)
        texts += [f"{one.number} – {one.name}" for one in members]
    every = "one_period" if period_of(mechanism) else "one_revolution" if way.turns else "to_and_fro"
    every = "in_its_time" if way.own_time else every
    texts.append(say(f"drawing.{every}", language, seconds=number(seconds, language)))
    return html.escape(_NOT_XML.sub("", "; ".join(texts)))
