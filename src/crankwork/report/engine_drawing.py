"""How an engine is drawn: seen along its shaft, and each bank from the side, with gas, firing and forces."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis import Array
from crankwork.analysis.moving_engine import CylinderMoving, EngineMoving
from crankwork.machine import Machine
from crankwork.report.arrows import forces_of, with_forces
from crankwork.report.engine_sizes import Sizes, reach, sizes
from crankwork.report.linkage_drawing import hatched
from crankwork.report.sketch import Sketch, tints
from crankwork.show.moving import Part, part
from crankwork.show.scene import Box, Circle, Item, Pen, Polyline, Text, line, placed, rectangle, text_width

_TALL, _WIDE, _WIDE_ALONE, _GAP = 125.0, 250.0, 130.0, 14.0
_NONE, _PALE = Pen(0.0), Pen(0.15, grey=0.55)
_PISTON, _WEB, _WEIGHT = 0.87, 0.78, 0.6
_LABEL = 3.5
# how long a flash is seen [deg]
_FLASH = 40.0


def engine_sketch(
    machine: Machine, engine: EngineMoving, forces: Mapping[str, str] | None = None, frame: int | None = None
) -> Sketch:
    """Return an engine as it is drawn over all its angles.

    `forces`: what is written at those of the first cylinder, by key, where forces are drawn on all in front; `frame`:
    the only one that is looked at.
    """
    size = sizes(machine, engine)
    scale = _scale(engine, size, _rows(engine))
    # one unit is a millimetre of the paper from here on
    scaled = engine._replace(cylinders=tuple(_scaled(one, scale) for one in engine.cylinders))
    drawn, banks = _Engine(scaled, size.scaled(scale)), _rows(scaled)
    rows = [drawn.row(one).seen(*(each.place.number for each in one)) for one in banks]
    rows = [_stacked(rows)] if rows else []
    side = drawn.side()
    if forces is not None:
        first, *others = drawn.fronts()
        arrows = [*forces_of(first, forces), *(each for one in others for each in forces_of(one, {}))]
        side = with_forces(side, arrows, frame)
    return _beside([side.seen(), *rows])._replace(scale=scale, force_scale=side.force_scale)


def _rows(engine: EngineMoving) -> list[list[CylinderMoving]]:
    """Return the cylinders of each view from the side: a bank or two that lie opposite, of one throw only its first."""
    rows: list[list[CylinderMoving]] = []
    if len(engine.cylinders) == 1:
        return rows
    for one in engine.cylinders:
        for row in rows:
            if math.isclose(abs(row[0].axis @ one.axis), 1.0):
                row.append(one)
                break
        else:
            rows.append([one])
    return rows if max(one.place.throw for one in engine.cylinders) else rows[:1]


def _scale(engine: EngineMoving, size: Sizes, banks: list[list[CylinderMoving]]) -> float:
    """Return how many millimetres of the paper a metre takes."""
    wide, tall = np.ptp(reach(engine, size), axis=0)
    if not banks:
        return float(min(_TALL / tall, _WIDE_ALONE / wide))
    long = max(np.ptp([*size.stations.values()]) + size.bore, np.ptp(size.journals) + size.journal_length)
    rows = sum(float(np.ptp(_ends(row, size))) for row in banks)
    return float(min((_WIDE - _GAP) / (wide + long), 1.35 * _TALL / max(tall, rows)))


def _ends(row: list[CylinderMoving], size: Sizes) -> list[float]:
    """Return how far up and down a view from the side reaches. [m]"""
    around = max(size.crank + 1.4 * size.pin, size.counterweight)
    heads = [size.head(one) * (1 if one.axis @ row[0].axis > 0 else -1) for one in row]
    return [around, -around, *heads]


def _stacked(rows: list[Sketch]) -> Sketch:
    """Return sketches beneath each other."""
    found, low = [rows[0]], rows[0].low[1]
    for one in rows[1:]:
        found.append(one.moved(np.array([0.0, low - _GAP / 2 - one.high[1]])))
        low = found[-1].low[1]
    return Sketch.joined(found)


def _beside(views: list[Sketch]) -> Sketch:
    """Return views side by side, their middles on one level."""
    found, right = [views[0]], views[0].high[0]
    level = (views[0].low[1] + views[0].high[1]) / 2
    found += [
        one.moved(np.array([right + _GAP - one.low[0], level - (one.low[1] + one.high[1]) / 2])) for one in views[1:]
    ]
    return Sketch.joined(found)


class _Engine:
    """An engine on paper, in millimetres."""

    def __init__(self, engine: EngineMoving, size: Sizes) -> None:
        self._engine, self._size, self._cylinders = engine, size, engine.cylinders
        filled = [one for one in self._cylinders if one.pressure is not None]
        seen = tints([one.pressure for one in filled if one.pressure is not None])
        self._tints = {one.place.number: tint for one, tint in zip(filled, seen, strict=True)}

    def fronts(self) -> list[CylinderMoving]:
        """Return the cylinder of each bank that is nearest to who looks along the shaft."""
        near: dict[tuple[float, float], CylinderMoving] = {}
        for one in sorted(self._cylinders, key=lambda one: one.place.throw):
            near.setdefault((one.place.axis, one.offset), one)
        return list(near.values())

    def side(self) -> Sketch:
        """Return what is seen along the shaft: the nearest cylinder of each bank, those behind it in outlines."""
        fronts = self.fronts()
        pins = {one.place.crankpin for one in fronts}
        items = [*self._centre_lines(fronts), *(item for one in fronts for item in self._walls(one))]
        items += [self._number(one) for one in fronts]
        far = sorted((one for one in self._cylinders if one not in fronts), key=lambda one: -one.place.throw)
        behind = {one.place.crankpin: one for one in far if one.place.crankpin not in pins}
        parts = [_pale(self._crank(one)) for one in behind.values()]
        parts += [_pale(each) for one in far for each in (self._piston(one), self._rod(one))]
        parts += [each for one in fronts for each in self._gas(one)]
        parts += [self._piston(one) for one in fronts]
        cranks = {one.place.crankpin: one for one in [*self._cylinders, *fronts] if one.place.crankpin in pins}
        parts += [self._crank(one) for one in sorted(cranks.values(), key=lambda one: -one.place.throw)]
        # rods that others hang on lie under them
        parts += [self._rod(one) for one in sorted(fronts, key=lambda one: (one.place.master > 0, -one.place.number))]
        parts += [self._flash(one) for one in fronts if one.fires is not None]
        parts += self._letters() if len(self._cylinders) == 1 else []
        places = reach(self._engine, self._size)
        spare = np.array([3.0, 3.0 + 2 * _LABEL])
        return Sketch(items, _named("side", parts), places.min(axis=0) - spare, places.max(axis=0) + spare, 0.0)

    def _centre_lines(self, fronts: list[CylinderMoving]) -> list[Item]:
        r = self._size.crank
        items: list[Item] = [Circle((0.0, 0.0), r, Pen(0.2, (6.0, 1.5, 1.0, 1.5), 0.4))]
        items.append(line((-r - 4, 0.0), (r + 4, 0.0), "axis"))
        for one in fronts:
            foot = _across(one, one.offset)
            items.append(line(foot - (r + 4) * one.axis, foot + (self._size.head(one) + 3) * one.axis, "axis"))
        return items

    def _walls(self, one: CylinderMoving) -> list[Item]:
        """Return liner and head."""
        return [placed(item, _across(one, one.offset), _turn(one)) for item in self._liner(one)]

    def _liner(self, one: CylinderMoving, *, is_close: bool = False) -> list[Item]:
        """Return the walls of a cylinder along the x axis, hatched where neighbours leave room for it."""
        start, head, half = one.bottom - self._size.skirt, self._size.head(one), self._size.bore / 2 + 0.3
        corners = [np.array(at) for at in ((start, half), (head, half), (head, -half), (start, -half))]
        items: list[Item] = []
        for at in range(3):
            wall = hatched(corners[at], corners[at + 1])
            items += wall[:1] if is_close and at != 1 else wall
        return items

    def _number(self, one: CylinderMoving) -> Item:
        """Return the numbers of a bank above its head."""
        bank = [each.place.number for each in self._cylinders if each.place.axis == one.place.axis]
        runs = len(bank) > 2 and bank == list(range(bank[0], bank[-1] + 1))
        text = f"{bank[0]}–{bank[-1]}" if runs else ", ".join(map(str, bank))
        if len(self._cylinders) == 1:
            text = ""
        clear = 3.4 + _LABEL + abs(float(one.axis[0])) * text_width(text, _LABEL) / 2
        return self._written(text, _across(one, one.offset) + (self._size.head(one) + clear) * one.axis)

    @staticmethod
    def _written(text: str, at: Array) -> Text:
        return Text((float(at[0]), float(at[1]) - _LABEL / 2), text, _LABEL, "middle", halo=True)

    def _gas(self, one: CylinderMoving) -> Iterator[Part]:
        """Yield the gas between piston and head, the darker the higher its pressure."""
        if one.pressure is not None:
            at, depth = _across(one, one.offset) + self._size.head(one) * one.axis, self._depth(one)
            yield self._gas_part(one, at, _turn(one) + 180.0, depth)

    def _depth(self, one: CylinderMoving) -> Array:
        return self._size.head(one) - one.along - self._size.crown

    def _gas_part(self, one: CylinderMoving, at: ArrayLike, turn: float, depth: Array) -> Part:
        body = rectangle(Box(0.0, -self._size.bore / 2, 1.0, self._size.bore), "thin", 0.0)
        body = body._replace(kind=_NONE, name="gas")
        tint = self._tints[one.place.number]
        return part(f"gas.{one.place.number}", [body], at, turn, stretch=depth, tint=tint)

    def _piston(self, one: CylinderMoving) -> Part:
        return part(f"piston.{one.place.number}", self._piston_items(), one.piston, _turn(one))

    def _piston_items(self) -> list[Item]:
        """Return a piston whose crown looks along the x axis, its pin at the origin."""
        size, half = self._size, self._size.bore / 2 - 0.15
        body = rectangle(Box(-size.skirt, -half, size.skirt + size.crown, 2 * half), "medium", _PISTON)
        rings = [size.crown * share for share in (0.9, 0.78, 0.66)]
        return [body, *(line((at, -half), (at, half), "thin") for at in rings)]

    def _rod(self, one: CylinderMoving) -> Part:
        size, way = self._size, one.piston - one.joint
        turns, length = np.unwrap(np.arctan2(way[:, 1], way[:, 0])), float(np.hypot(*way[0]))
        knuckles = [each for each in self._cylinders if each.place.master == one.place.number]
        big, small = (0.62 if one.place.master else 1.35) * size.pin, 1.6 * size.wrist
        shank = [(0.7 * big, 0.5 * big), (length - 0.7 * small, 0.55 * small)]
        outline = np.array([*shank, *((x, -y) for x, y in reversed(shank))])
        items: list[Item] = [Polyline(outline, "medium", closed=True, fill=1.0)]
        if knuckles:
            items += self._knuckles(one, knuckles, float(turns[0]))
        else:
            items.append(Circle((0.0, 0.0), big, "medium", 1.0))
        items.append(Circle((length, 0.0), small, "medium", 1.0))
        eyes = ((0.0, 0.62 * big if one.place.master else size.pin), (length, size.wrist))
        items += [Circle((at, 0.0), radius, "thin", 1.0) for at, radius in eyes]
        return part(f"rod.{one.place.number}", items, one.joint, np.degrees(turns))

    def _knuckles(self, one: CylinderMoving, carried: list[CylinderMoving], turn: float) -> Iterator[Item]:
        """Yield the disc that knuckle pins stand in, as the master rod sees it."""
        away = np.array([each.joint[0] - one.joint[0] for each in carried])
        cos, sin = math.cos(turn), math.sin(turn)
        seen = away @ np.array([[cos, -sin], [sin, cos]])
        pin = 0.62 * self._size.pin
        yield Circle((0.0, 0.0), float(np.hypot(*seen.T).max()) + 1.35 * pin, "medium", 1.0)
        for x, y in seen.tolist():
            yield Circle((x, y), pin, "thin", 1.0)

    def _crank(self, one: CylinderMoving) -> Part:
        size, length = self._size, float(np.hypot(*one.pin[0]))
        turns = np.degrees(np.unwrap(np.arctan2(one.pin[:, 1], one.pin[:, 0])))
        items: list[Item] = []
        if size.counterweight > size.main:
            angles = np.radians(np.linspace(125.0, 235.0, 23))
            rim = size.counterweight * np.column_stack([np.cos(angles), np.sin(angles)])
            around = np.vstack([rim, [(0.0, -1.3 * size.main), (0.0, 1.3 * size.main)]])
            items.append(Polyline(around, "medium", closed=True, fill=_WEIGHT))
        web = _hull(1.3 * size.main, 1.3 * size.pin, length)
        items.append(Polyline(web, "medium", closed=True, fill=_WEB))
        items.append(Circle((length, 0.0), size.pin, "thin", 1.0))
        items.append(Circle((0.0, 0.0), size.main, "medium", 1.0))
        return part(f"crank.{one.place.crankpin + 1}", items, (0.0, 0.0), turns)

    def _flash(self, one: CylinderMoving) -> Part:
        at = _across(one, one.offset) + (self._size.head(one) - 0.16 * self._size.bore) * one.axis
        return self._flash_part(one, at)

    def _flash_part(self, one: CylinderMoving, at: ArrayLike) -> Part:
        """Return a star that is seen from when a cylinder fires."""
        rays = np.radians(np.arange(16) * 22.5)
        radii = np.where(np.arange(16) % 2, 0.07, 0.16) * self._size.bore
        outline = np.column_stack([np.cos(rays), np.sin(rays)]) * radii[:, None]
        star = Polyline(outline, "thin", closed=True, fill=0.0, name="flash")
        since = np.mod(self._engine.degrees - float(one.fires or 0.0) + 1e-6, self._engine.layout.cycle)
        return part(f"flash.{one.place.number}", [star], at, tint=np.where(since < _FLASH, 1.0, 0.0))

    def _letters(self) -> list[Part]:
        """Return the letters of the joints of a crank gear that is alone."""
        one, size = self._cylinders[0], self._size
        outward = one.pin / np.hypot(*one.pin[0])
        places = {
            "O": np.array([[-1.3 * size.main - 3.5, -1.3 * size.main - 3.5]]),
            "A": one.pin + (1.35 * size.pin + 3.5) * outward,
            "B": one.piston - _across(one, 1.6 * size.wrist + 3.0),
        }
        texts = {name: self._written(f"/{{{name}}}", np.zeros(2)) for name in places}
        return [part(f"text.{name}", [texts[name]], at) for name, at in places.items()]

    def row(self, bank: list[CylinderMoving]) -> Sketch:
        """Return a bank from the side, in its own plane: the shaft across, cylinders upward, those opposite down."""
        size, up, on = self._size, bank[0].axis, bank
        beside = size.journal_length / 2
        ends = [size.journals[0] - beside, size.journals[-1] + beside]
        numbers = [size.stations[one.place.number] for one in on]
        gaps = np.diff(sorted(numbers))
        is_close = bool(gaps.size and gaps.min() - size.bore < 6.0)
        items: list[Item] = [line((min(*ends, *numbers) - 6, 0.0), (max(*ends, *numbers) + 6, 0.0), "axis")]
        items += self._journals()
        signs = [1.0 if float(one.axis @ up) > 0 else -1.0 for one in on]
        for one, sign in zip(on, signs, strict=True):
            items += self._standing(one, sign, is_close=is_close)
        parts = [*(each for one, sign in zip(on, signs, strict=True) for each in self._behind(one, sign, up))]
        parts += self._throws(up, on)
        parts += [each for one, sign in zip(on, signs, strict=True) for each in self._in_front(one, sign)]
        beyond = size.bore / 2 + 3.5
        left, right = min(*ends, min(numbers) - beyond), max(*ends, max(numbers) + beyond)
        down, top = min(_ends(on, size)), max(_ends(on, size))
        room = 3.5 + 2 * _LABEL
        spare = room if any(float(one.axis @ up) < 0 for one in on) else 2.0
        return Sketch(
            items, _named(f"row.{bank[0].place.number}", parts),
            np.array([left - 2, down - spare]), np.array([right + 2, top + room]), 0.0,
        )  # fmt: skip

    def _journals(self) -> Iterator[Item]:
        size = self._size
        for at in size.journals:
            yield rectangle(
                Box(at - size.journal_length / 2, -size.main, size.journal_length, 2 * size.main), "medium", 1.0
            )

    def _throws(self, up: Array, shown: list[CylinderMoving]) -> Iterator[Part]:
        """Yield webs, counterweights and crankpins, each between its main journals, the rods of a bank upon them."""
        size = self._size
        for throw in range(len(size.journals) - 1):
            on = [one for one in self._cylinders if one.place.throw == throw]
            pins = {one.place.crankpin: one for one in sorted(on, key=lambda one: size.stations[one.place.number])}
            left = size.journals[throw] + size.journal_length / 2
            right = size.journals[throw + 1] - size.journal_length / 2
            web = 0.22 * (right - left)
            room = (right - left - 2 * web) / len(pins)
            for at, (crankpin, one) in enumerate(pins.items()):
                height = one.pin @ up
                start = left + web + at * room
                body = [rectangle(Box(start, -size.pin, room, 2 * size.pin), "medium", 1.0)]
                body += [self._big_end(each) for each in shown if each.place.crankpin == crankpin]
                yield part(f"crankpin.{crankpin + 1}", body, _upward(height))
                ways = ([left + web / 2] if at == 0 else []) + ([right - web / 2] if at == len(pins) - 1 else [])
                for count, middle in enumerate(ways, start=1):
                    yield from self._web(f"{crankpin + 1}.{count}", middle, web, height, one.pin @ _beside_of(up))

    def _big_end(self, one: CylinderMoving) -> Polyline:
        wide, half = min(1.1 * self._size.pin, 0.3 * self._size.bore), 1.35 * self._size.pin
        return rectangle(Box(self._size.stations[one.place.number] - wide / 2, -half, wide, 2 * half), "medium", 1.0)

    def _web(self, name: str, middle: float, wide: float, height: Array, across: Array) -> Iterator[Part]:
        """Yield a web, and a counterweight on it, as tall as they look from the side."""
        size = self._size
        low, high = (
            np.minimum(-1.3 * size.main, height - 1.3 * size.pin),
            np.maximum(1.3 * size.main, height + 1.3 * size.pin),
        )
        if size.counterweight > size.main:
            angles = np.radians(np.linspace(125.0, 235.0, 23))[:, None] + np.arctan2(across, height)
            rim = size.counterweight * np.cos(angles)
            yield _bar(f"weight.{name}", middle, (rim.min(axis=0), np.maximum(rim.max(axis=0), 0.0)), wide, _WEIGHT)
        yield _bar(f"web.{name}", middle, (low, high), wide, _WEB)

    def _standing(self, one: CylinderMoving, sign: float, *, is_close: bool) -> Iterator[Item]:
        """Yield liner, centre line and number of a cylinder."""
        at, head = self._size.stations[one.place.number], self._size.head(one)
        for item in self._liner(one, is_close=is_close):
            yield placed(item, (at, 0.0), 90.0 * sign)
        yield line((at, 0.0), (at, sign * (head + 3)), "axis")
        yield self._written(str(one.place.number), np.array([at, sign * (head + 3.4 + _LABEL)]))

    def _behind(self, one: CylinderMoving, sign: float, up: Array) -> Iterator[Part]:
        """Yield gas and rod of a cylinder."""
        size, at, number = self._size, self._size.stations[one.place.number], one.place.number
        if one.pressure is not None:
            yield self._gas_part(one, (at, sign * size.head(one)), -90.0 * sign, self._depth(one))
        ends = np.sort(np.stack([one.joint @ up, sign * one.along]), axis=0)
        wide = min(0.8 * size.pin, 0.25 * size.bore)
        body = rectangle(Box(0.0, -wide / 2, 1.0, wide), "thin", 1.0)._replace(kind=_NONE)
        # its ends are stretched, and hidden
        sides = [line((0.0, side), (1.0, side), "medium") for side in (wide / 2, -wide / 2)]
        yield part(f"rod.{number}", [body, *sides], _upward(ends[0], at), 90.0, stretch=ends[1] - ends[0])

    def _in_front(self, one: CylinderMoving, sign: float) -> Iterator[Part]:
        """Yield piston and flash of a cylinder."""
        size, at = self._size, self._size.stations[one.place.number]
        yield part(f"piston.{one.place.number}", self._piston_items(), _upward(sign * one.along, at), 90.0 * sign)
        if one.fires is not None:
            yield self._flash_part(one, (at, sign * (size.head(one) - 0.16 * size.bore)))


def _bar(name: str, at: float, ends: tuple[Array, Array], wide: float, fill: float) -> Part:
    """Return an upright bar whose ends move, without lines, because it is stretched."""
    body = rectangle(Box(0.0, -wide / 2, 1.0, wide), "thin", fill)._replace(kind=_NONE)
    return part(name, [body], _upward(ends[0], at), 90.0, stretch=ends[1] - ends[0])


def _upward(height: Array, at: float = 0.0) -> Array:
    return np.column_stack([np.full(len(height), at), height])


def _beside_of(up: Array) -> Array:
    """Return the direction a quarter turn clockwise."""
    return np.array([up[1], -up[0]])


def _across(one: CylinderMoving, distance: float) -> Array:
    """Return a way across the axis of a cylinder, towards the crankpin at 90 degrees."""
    return np.asarray(distance * _beside_of(one.axis))


def _turn(one: CylinderMoving) -> float:
    return 90.0 - one.place.axis


def _hull(first: float, other: float, apart: float) -> Array:
    """Return the outline round a circle at the origin and another along the x axis, shape (k, 2)."""
    lean = math.acos(max(-1.0, min(1.0, (first - other) / max(apart, 1e-9))))
    near, far = np.linspace(lean, math.tau - lean, 25), np.linspace(-lean, lean, 25)
    back = first * np.column_stack([np.cos(near), np.sin(near)])
    return np.vstack([back, other * np.column_stack([np.cos(far), np.sin(far)]) + (apart, 0.0)])


def _pale(one: Part) -> Part:
    """Return what stands behind in outlines."""
    return one._replace(
        items=tuple(item._replace(kind=_PALE, fill=None) for item in one.items if isinstance(item, Polyline | Circle))
    )


def _named(view: str, parts: Iterable[Part]) -> list[Part]:
    return [one._replace(name=f"{view}.{one.name}") for one in parts]


def _scaled(one: CylinderMoving, scale: float) -> CylinderMoving:
    return one._replace(
        offset=one.offset * scale, pin=one.pin * scale, joint=one.joint * scale, piston=one.piston * scale,
        top=one.top * scale, bottom=one.bottom * scale,
    )  # fmt: skip
