"""How an engine is drawn: seen along its shaft, and each bank from the side, with gas, firing and forces; its sizes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis import Array
from crankwork.analysis.sampled_motion import SampledCylinder, SampledEngine
from crankwork.machine import Bearings, Machine
from crankwork.report.drawn_links import hatched
from crankwork.report.sketch import Sketch, forces_of, tints, with_forces
from crankwork.show.animation import Part, part
from crankwork.show.scene import (
    ChartBox,
    Circle,
    Item,
    Pen,
    Polyline,
    Text,
    line,
    rectangle,
    rotation_arrow,
    text_width,
    use_layout,
)

_TALL, _WIDE, _WIDE_ALONE, _GAP = 125.0, 250.0, 130.0, 14.0
_NONE, _PALE = Pen(0.0), Pen(0.15, grey=0.55)
_PISTON, _WEB, _WEIGHT = 0.87, 0.78, 0.6
_LABEL = 3.5
# how long a flash is seen [deg]
_FLASH = 40.0
# of the bore, where nobody says: crankpin, journal, piston pin, the crown above its pin and the skirt below it
_PIN, _MAIN, _WRIST, _CROWN, _SKIRT = 0.27, 0.3, 0.12, 0.42, 0.3
_PITCH, _WALL = 1.25, 0.03
# of the pitch of throws
_JOURNAL = 0.3


def engine_sketch(
    machine: Machine,
    engine: SampledEngine,
    forces: Mapping[str, str] | None = None,
    frame: int | None = None,
    *,
    has_room: bool = True,
) -> Sketch:
    """Return an engine as it is drawn over all its angles.

    `forces`: what is written at those of the first cylinder, by key, where forces are drawn on all in front; `frame`:
    the only one that is looked at; `has_room`: whether there is room for forces.
    """
    size = sizes(machine, engine)
    scale = _scale(engine, size, _rows(engine))
    # one unit is a millimetre of the paper from here on
    scaled = engine._replace(cylinders=tuple(_scaled(cylinder, scale) for cylinder in engine.cylinders))
    drawn, banks = _Engine(scaled, size.scaled(scale)), _rows(scaled)
    rows = [drawn.row(bank).seen(*(each.place.number for each in bank)) for bank in banks]
    rows = [_stacked(rows)] if rows else []
    side = drawn.side()
    if forces is not None:
        first, *further = drawn.fronts()
        arrows = [*forces_of(first, forces), *(arrow for cylinder in further for arrow in forces_of(cylinder, {}))]
        side = with_forces(side, arrows, frame, has_room=has_room)
    return _side_by_side([side.seen(), *rows])._replace(scale=scale, force_scale=side.force_scale)


def _rows(engine: SampledEngine) -> list[list[SampledCylinder]]:
    """Return the cylinders of each view from the side: a bank or two that lie opposite, of one throw only its first."""
    rows: list[list[SampledCylinder]] = []
    if len(engine.cylinders) == 1:
        return rows
    for cylinder in engine.cylinders:
        for row in rows:
            if math.isclose(abs(row[0].axis @ cylinder.axis), 1.0):
                row.append(cylinder)
                break
        else:
            rows.append([cylinder])
    return rows if max(cylinder.place.throw for cylinder in engine.cylinders) else rows[:1]


def _scale(engine: SampledEngine, size: Sizes, banks: list[list[SampledCylinder]]) -> float:
    """Return the scale, in millimetres of the paper per metre."""
    wide, tall = np.ptp(reach(engine, size), axis=0)
    if not banks:
        return float(min(_TALL / tall, _WIDE_ALONE / wide))
    long = max(np.ptp([*size.stations.values()]) + size.bore, np.ptp(size.journals) + size.journal_length)
    rows = sum(float(np.ptp(_ends(row, size))) for row in banks)
    return float(min((_WIDE - _GAP) / (wide + long), 1.35 * _TALL / max(tall, rows)))


def _ends(row: list[SampledCylinder], size: Sizes) -> list[float]:
    """Return the upper and lower ends of a view from the side. [m]"""
    around = max(size.crank + 1.4 * size.pin, size.counterweight)
    heads = [size.head(cylinder) * (1 if cylinder.axis @ row[0].axis > 0 else -1) for cylinder in row]
    return [around, -around, *heads]


def _stacked(rows: list[Sketch]) -> Sketch:
    """Return sketches beneath each other."""
    placed_views, low = [rows[0]], rows[0].low[1]
    for view in rows[1:]:
        placed_views.append(view.moved(np.array([0.0, low - _GAP / 2 - view.high[1]])))
        low = placed_views[-1].low[1]
    return Sketch.joined(placed_views)


def _side_by_side(views: list[Sketch]) -> Sketch:
    """Return views side by side, their middles on one level."""
    placed_views, right = [views[0]], views[0].high[0]
    level = (views[0].low[1] + views[0].high[1]) / 2
    placed_views += [
        view.moved(np.array([right + _GAP - view.low[0], level - (view.low[1] + view.high[1]) / 2]))
        for view in views[1:]
    ]
    return Sketch.joined(placed_views)


class _Engine:
    """An engine on paper, in millimetres."""

    def __init__(self, engine: SampledEngine, size: Sizes) -> None:
        self._engine, self._size, self._cylinders = engine, size, engine.cylinders
        filled = [cylinder for cylinder in self._cylinders if cylinder.pressure is not None]
        seen = tints([cylinder.pressure for cylinder in filled if cylinder.pressure is not None])
        self._tints = {cylinder.place.number: tint for cylinder, tint in zip(filled, seen, strict=True)}

    def fronts(self) -> list[SampledCylinder]:
        """Return the cylinder of each bank that is nearest to who looks along the shaft."""
        near: dict[tuple[float, float], SampledCylinder] = {}
        for cylinder in sorted(self._cylinders, key=lambda item: item.place.throw):
            near.setdefault((cylinder.place.axis, cylinder.offset), cylinder)
        return list(near.values())

    def side(self) -> Sketch:
        """Return the view along the shaft: the nearest cylinder of each bank, those behind it in outlines."""
        fronts = self.fronts()
        pins = {cylinder.place.crankpin for cylinder in fronts}
        items = [*self._centre_lines(fronts), *(item for cylinder in fronts for item in self._walls(cylinder))]
        items += [self._number(cylinder) for cylinder in fronts]
        far = sorted((item for item in self._cylinders if item not in fronts), key=lambda item: -item.place.throw)
        behind = {cylinder.place.crankpin: cylinder for cylinder in far if cylinder.place.crankpin not in pins}
        parts = [_pale(self._crank(cylinder)) for cylinder in behind.values()]
        parts += [_pale(each) for cylinder in far for each in (self._piston(cylinder), self._rod(cylinder))]
        parts += [each for cylinder in fronts for each in self._gas(cylinder)]
        parts += [self._piston(cylinder) for cylinder in fronts]
        cranks = {
            cylinder.place.crankpin: cylinder
            for cylinder in [*self._cylinders, *fronts]
            if cylinder.place.crankpin in pins
        }
        parts += [self._crank(cylinder) for cylinder in sorted(cranks.values(), key=lambda item: -item.place.throw)]
        # rods that others hang on lie under them
        parts += [
            self._rod(cylinder)
            for cylinder in sorted(fronts, key=lambda item: (item.place.master > 0, -item.place.number))
        ]
        parts += [self._flash(cylinder) for cylinder in fronts if cylinder.fires is not None]
        parts += self._letters() if len(self._cylinders) == 1 else []
        places = reach(self._engine, self._size)
        margin = np.array([3.0, 3.0 + 2 * _LABEL])
        return Sketch(items, _named("side", parts), places.min(axis=0) - margin, places.max(axis=0) + margin, 0.0)

    def _centre_lines(self, fronts: list[SampledCylinder]) -> list[Item]:
        r = self._size.crank
        items: list[Item] = [Circle((0.0, 0.0), r, Pen(0.2, (6.0, 1.5, 1.0, 1.5), 0.4))]
        items.append(line((-r - 4, 0.0), (r + 4, 0.0), "axis"))
        items += rotation_arrow((0.0, 0.0), max(r, self._size.counterweight) + 4, -1.0, 300.0)
        for cylinder in fronts:
            foot = _across(cylinder, cylinder.offset)
            items.append(
                line(foot - (r + 4) * cylinder.axis, foot + (self._size.head(cylinder) + 3) * cylinder.axis, "axis")
            )
        return items

    def _walls(self, cylinder: SampledCylinder) -> list[Item]:
        """Return liner and head."""
        return [use_layout(item, _across(cylinder, cylinder.offset), _turn(cylinder)) for item in self._liner(cylinder)]

    def _liner(self, cylinder: SampledCylinder, *, is_close: bool = False) -> list[Item]:
        """Return the walls of a cylinder along the x axis, hatched where neighbours leave room for it."""
        start, head, half = cylinder.bottom - self._size.skirt, self._size.head(cylinder), self._size.bore / 2 + 0.3
        corners = [np.array(corner) for corner in ((start, half), (head, half), (head, -half), (start, -half))]
        items: list[Item] = []
        for side in range(3):
            wall = hatched(corners[side], corners[side + 1])
            items += wall[:1] if is_close and side != 1 else wall
        return items

    def _number(self, cylinder: SampledCylinder) -> Item:
        """Return the numbers of a bank above its head."""
        bank = [each.place.number for each in self._cylinders if each.place.axis == cylinder.place.axis]
        runs = len(bank) > 2 and bank == list(range(bank[0], bank[-1] + 1))
        text = f"{bank[0]}–{bank[-1]}" if runs else ", ".join(map(str, bank))
        if len(self._cylinders) == 1:
            text = ""
        clear = 3.4 + _LABEL + abs(float(cylinder.axis[0])) * text_width(text, _LABEL) / 2
        return self._written(
            text, _across(cylinder, cylinder.offset) + (self._size.head(cylinder) + clear) * cylinder.axis
        )

    @staticmethod
    def _written(text: str, position: Array) -> Text:
        return Text((float(position[0]), float(position[1]) - _LABEL / 2), text, _LABEL, "middle", halo=True)

    def _gas(self, cylinder: SampledCylinder) -> Iterator[Part]:
        """Yield the gas between piston and head, the darker the higher its pressure."""
        if cylinder.pressure is not None:
            top, depth = (
                _across(cylinder, cylinder.offset) + self._size.head(cylinder) * cylinder.axis,
                self._depth(cylinder),
            )
            yield self._gas_part(cylinder, top, _turn(cylinder) + 180.0, depth)

    def _depth(self, cylinder: SampledCylinder) -> Array:
        return self._size.head(cylinder) - cylinder.along - self._size.crown

    def _gas_part(self, cylinder: SampledCylinder, position: ArrayLike, turn: float, depth: Array) -> Part:
        body = rectangle(ChartBox(0.0, -self._size.bore / 2, 1.0, self._size.bore), "thin", 0.0)
        body = body._replace(kind=_NONE, name="gas")
        tint = self._tints[cylinder.place.number]
        return part(f"gas.{cylinder.place.number}", [body], position, turn, stretch=depth, tint=tint)

    def _piston(self, cylinder: SampledCylinder) -> Part:
        return part(f"piston.{cylinder.place.number}", self._piston_items(), cylinder.piston, _turn(cylinder))

    def _piston_items(self) -> list[Item]:
        """Return a piston whose crown looks along the x axis, its pin at the origin."""
        size, half = self._size, self._size.bore / 2 - 0.15
        body = rectangle(ChartBox(-size.skirt, -half, size.skirt + size.crown, 2 * half), "medium", _PISTON)
        rings = [size.crown * share for share in (0.9, 0.78, 0.66)]
        return [body, *(line((ring, -half), (ring, half), "thin") for ring in rings)]

    def _rod(self, cylinder: SampledCylinder) -> Part:
        size, rod = self._size, cylinder.piston - cylinder.joint
        turns, length = np.unwrap(np.arctan2(rod[:, 1], rod[:, 0])), float(np.hypot(*rod[0]))
        knuckles = [each for each in self._cylinders if each.place.master == cylinder.place.number]
        big, small = (0.62 if cylinder.place.master else 1.35) * size.pin, 1.6 * size.wrist
        shank = [(0.7 * big, 0.5 * big), (length - 0.7 * small, 0.55 * small)]
        outline = np.array([*shank, *((x, -y) for x, y in reversed(shank))])
        items: list[Item] = [Polyline(outline, "medium", closed=True, fill=1.0)]
        if knuckles:
            items += self._knuckles(cylinder, knuckles, float(turns[0]))
        else:
            items.append(Circle((0.0, 0.0), big, "medium", 1.0))
        items.append(Circle((length, 0.0), small, "medium", 1.0))
        eyes = ((0.0, 0.62 * big if cylinder.place.master else size.pin), (length, size.wrist))
        items += [Circle((distance, 0.0), radius, "thin", 1.0) for distance, radius in eyes]
        return part(f"rod.{cylinder.place.number}", items, cylinder.joint, np.degrees(turns))

    def _knuckles(self, cylinder: SampledCylinder, carried: list[SampledCylinder], turn: float) -> Iterator[Item]:
        """Yield the disc that knuckle pins stand in, as the master rod sees it."""
        away = np.array([each.joint[0] - cylinder.joint[0] for each in carried])
        cos, sin = math.cos(turn), math.sin(turn)
        seen = away @ np.array([[cos, -sin], [sin, cos]])
        pin = 0.62 * self._size.pin
        yield Circle((0.0, 0.0), float(np.hypot(*seen.T).max()) + 1.35 * pin, "medium", 1.0)
        for x, y in seen.tolist():
            yield Circle((x, y), pin, "thin", 1.0)

    def _crank(self, cylinder: SampledCylinder) -> Part:
        size, length = self._size, float(np.hypot(*cylinder.pin[0]))
        turns = np.degrees(np.unwrap(np.arctan2(cylinder.pin[:, 1], cylinder.pin[:, 0])))
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
        return part(f"crank.{cylinder.place.crankpin + 1}", items, (0.0, 0.0), turns)

    def _flash(self, cylinder: SampledCylinder) -> Part:
        position = (
            _across(cylinder, cylinder.offset) + (self._size.head(cylinder) - 0.16 * self._size.bore) * cylinder.axis
        )
        return self._flash_part(cylinder, position)

    def _flash_part(self, cylinder: SampledCylinder, position: ArrayLike) -> Part:
        """Return a star that is seen from when a cylinder fires."""
        rays = np.radians(np.arange(16) * 22.5)
        radii = np.where(np.arange(16) % 2, 0.07, 0.16) * self._size.bore
        outline = np.column_stack([np.cos(rays), np.sin(rays)]) * radii[:, None]
        star = Polyline(outline, "thin", closed=True, fill=0.0, name="flash")
        since = np.mod(self._engine.degrees - float(cylinder.fires or 0.0) + 1e-6, self._engine.layout.cycle)
        return part(f"flash.{cylinder.place.number}", [star], position, tint=np.where(since < _FLASH, 1.0, 0.0))

    def _letters(self) -> list[Part]:
        """Return the letters of the joints of a crank gear that is alone."""
        cylinder, size = self._cylinders[0], self._size
        outward = cylinder.pin / np.hypot(*cylinder.pin[0])
        places = {
            "O": np.array([[-1.3 * size.main - 3.5, -1.3 * size.main - 3.5]]),
            "A": cylinder.pin + (1.35 * size.pin + 3.5) * outward,
            "B": cylinder.piston - _across(cylinder, 1.6 * size.wrist + 3.0),
        }
        texts = {name: self._written(f"/{{{name}}}", np.zeros(2)) for name in places}
        return [part(f"text.{name}", [texts[name]], position) for name, position in places.items()]

    def row(self, bank: list[SampledCylinder]) -> Sketch:
        """Return a bank from the side, in its own plane: the shaft across, cylinders upward, those opposite down."""
        size, up, on = self._size, bank[0].axis, bank
        half = size.journal_length / 2
        ends = [size.journals[0] - half, size.journals[-1] + half]
        numbers = [size.stations[cylinder.place.number] for cylinder in on]
        gaps = np.diff(sorted(numbers))
        is_close = bool(gaps.size and gaps.min() - size.bore < 6.0)
        items: list[Item] = [line((min(*ends, *numbers) - 6, 0.0), (max(*ends, *numbers) + 6, 0.0), "axis")]
        items += self._journals()
        signs = [1.0 if float(cylinder.axis @ up) > 0 else -1.0 for cylinder in on]
        for cylinder, sign in zip(on, signs, strict=True):
            items += self._standing(cylinder, sign, is_close=is_close)
        parts = [*(each for cylinder, sign in zip(on, signs, strict=True) for each in self._behind(cylinder, sign, up))]
        parts += self._throws(up, on)
        parts += [each for cylinder, sign in zip(on, signs, strict=True) for each in self._in_front(cylinder, sign)]
        beyond = size.bore / 2 + 3.5
        left, right = min(*ends, min(numbers) - beyond), max(*ends, max(numbers) + beyond)
        down, top = min(_ends(on, size)), max(_ends(on, size))
        room = 3.5 + 2 * _LABEL
        foot = room if any(float(cylinder.axis @ up) < 0 for cylinder in on) else 2.0
        return Sketch(
            items, _named(f"row.{bank[0].place.number}", parts),
            np.array([left - 2, down - foot]), np.array([right + 2, top + room]), 0.0,
        )  # fmt: skip

    def _journals(self) -> Iterator[Item]:
        size = self._size
        for station in size.journals:
            yield rectangle(
                ChartBox(station - size.journal_length / 2, -size.main, size.journal_length, 2 * size.main),
                "medium",
                1.0,
            )

    def _throws(self, up: Array, shown: list[SampledCylinder]) -> Iterator[Part]:
        """Yield webs, counterweights and crankpins, each between its main journals, the rods of a bank upon them."""
        size = self._size
        for throw in range(len(size.journals) - 1):
            on = [cylinder for cylinder in self._cylinders if cylinder.place.throw == throw]
            pins = {
                cylinder.place.crankpin: cylinder
                for cylinder in sorted(on, key=lambda item: size.stations[item.place.number])
            }
            left = size.journals[throw] + size.journal_length / 2
            right = size.journals[throw + 1] - size.journal_length / 2
            web = 0.22 * (right - left)
            room = (right - left - 2 * web) / len(pins)
            for index, (crankpin, cylinder) in enumerate(pins.items()):
                height = cylinder.pin @ up
                start = left + web + index * room
                body = [rectangle(ChartBox(start, -size.pin, room, 2 * size.pin), "medium", 1.0)]
                body += [self._big_end(each) for each in shown if each.place.crankpin == crankpin]
                yield part(f"crankpin.{crankpin + 1}", body, _upward(height))
                ways = ([left + web / 2] if index == 0 else []) + ([right - web / 2] if index == len(pins) - 1 else [])
                for count, middle in enumerate(ways, start=1):
                    yield from self._web(f"{crankpin + 1}.{count}", middle, web, height, cylinder.pin @ _clockwise(up))

    def _big_end(self, cylinder: SampledCylinder) -> Polyline:
        wide, half = min(1.1 * self._size.pin, 0.3 * self._size.bore), 1.35 * self._size.pin
        return rectangle(
            ChartBox(self._size.stations[cylinder.place.number] - wide / 2, -half, wide, 2 * half), "medium", 1.0
        )

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

    def _standing(self, cylinder: SampledCylinder, sign: float, *, is_close: bool) -> Iterator[Item]:
        """Yield liner, centre line and number of a cylinder."""
        station, head = self._size.stations[cylinder.place.number], self._size.head(cylinder)
        for item in self._liner(cylinder, is_close=is_close):
            yield use_layout(item, (station, 0.0), 90.0 * sign)
        yield line((station, 0.0), (station, sign * (head + 3)), "axis")
        yield self._written(str(cylinder.place.number), np.array([station, sign * (head + 3.4 + _LABEL)]))

    def _behind(self, cylinder: SampledCylinder, sign: float, up: Array) -> Iterator[Part]:
        """Yield gas and rod of a cylinder."""
        size, station, number = self._size, self._size.stations[cylinder.place.number], cylinder.place.number
        if cylinder.pressure is not None:
            yield self._gas_part(cylinder, (station, sign * size.head(cylinder)), -90.0 * sign, self._depth(cylinder))
        ends = np.sort(np.stack([cylinder.joint @ up, sign * cylinder.along]), axis=0)
        wide = min(0.8 * size.pin, 0.25 * size.bore)
        body = rectangle(ChartBox(0.0, -wide / 2, 1.0, wide), "thin", 1.0)._replace(kind=_NONE)
        # its ends are stretched, and hidden
        sides = [line((0.0, side), (1.0, side), "medium") for side in (wide / 2, -wide / 2)]
        yield part(f"rod.{number}", [body, *sides], _upward(ends[0], station), 90.0, stretch=ends[1] - ends[0])

    def _in_front(self, cylinder: SampledCylinder, sign: float) -> Iterator[Part]:
        """Yield piston and flash of a cylinder."""
        size, station = self._size, self._size.stations[cylinder.place.number]
        yield part(
            f"piston.{cylinder.place.number}",
            self._piston_items(),
            _upward(sign * cylinder.along, station),
            90.0 * sign,
        )
        if cylinder.fires is not None:
            yield self._flash_part(cylinder, (station, sign * (size.head(cylinder) - 0.16 * size.bore)))


def _bar(name: str, station: float, ends: tuple[Array, Array], wide: float, fill: float) -> Part:
    """Return an upright bar whose ends move, without lines, because it is stretched."""
    body = rectangle(ChartBox(0.0, -wide / 2, 1.0, wide), "thin", fill)._replace(kind=_NONE)
    return part(name, [body], _upward(ends[0], station), 90.0, stretch=ends[1] - ends[0])


def _upward(height: Array, station: float = 0.0) -> Array:
    return np.column_stack([np.full(len(height), station), height])


def _clockwise(up: Array) -> Array:
    """Return the direction a quarter turn clockwise."""
    return np.array([up[1], -up[0]])


def _across(cylinder: SampledCylinder, distance: float) -> Array:
    """Return a vector across the axis of a cylinder, towards the crankpin at 90 degrees."""
    return np.asarray(distance * _clockwise(cylinder.axis))


def _turn(cylinder: SampledCylinder) -> float:
    return 90.0 - cylinder.place.axis


def _hull(first: float, other: float, distance: float) -> Array:
    """Return the outline round a circle at the origin and another along the x axis, shape (k, 2)."""
    lean = math.acos(max(-1.0, min(1.0, (first - other) / max(distance, 1e-9))))
    near, far = np.linspace(lean, math.tau - lean, 25), np.linspace(-lean, lean, 25)
    back = first * np.column_stack([np.cos(near), np.sin(near)])
    return np.vstack([back, other * np.column_stack([np.cos(far), np.sin(far)]) + (distance, 0.0)])


def _pale(part_: Part) -> Part:
    """Return a part behind others, in outlines."""
    return part_._replace(
        items=tuple(item._replace(kind=_PALE, fill=None) for item in part_.items if isinstance(item, Polyline | Circle))
    )


def _named(view: str, parts: Iterable[Part]) -> list[Part]:
    return [part_._replace(name=f"{view}.{part_.name}") for part_ in parts]


def _scaled(cylinder: SampledCylinder, scale: float) -> SampledCylinder:
    lengths = ("offset", "pin", "joint", "piston", "top", "bottom")
    return cylinder._replace(**{name: getattr(cylinder, name) * scale for name in lengths})


class Sizes(NamedTuple):
    """Sizes of the parts, and where they stand along the shaft. [m]"""

    bore: float
    crank: float  # Radius
    pin: float  # Radius of a crankpin
    main: float  # Radius of a main journal
    wrist: float  # Radius of a piston pin
    crown: float  # From the piston pin to the top of the piston
    skirt: float  # From the piston pin to its lower edge
    clearance: float  # Between piston and head at the top dead centre
    counterweight: float  # Radius of the counterweights, zero where there are none
    stations: dict[int, float]  # Where each cylinder stands along the shaft, by number
    journals: tuple[float, ...]  # Main journals along the shaft, one more than throws
    journal_length: float

    def scaled(self, scale: float) -> Sizes:
        """Return them in other units of length."""
        stations = {number: station * scale for number, station in self.stations.items()}
        journals = tuple(journal * scale for journal in self.journals)
        lengths = {
            name: value * scale for name, value in self._asdict().items() if name not in ("stations", "journals")
        }
        return Sizes(**lengths, stations=stations, journals=journals)

    def head(self, cylinder: SampledCylinder) -> float:
        """Return the distance of the head of a cylinder from the shaft, along its axis."""
        return cylinder.top + self.crown + self.clearance


def sizes(machine: Machine, engine: SampledEngine) -> Sizes:
    """Return the sizes of a machine with cylinders."""
    first, radius = engine.cylinders[0], float(np.hypot(*engine.cylinders[0].pin[0]))
    stroke, bore = first.top - first.bottom, machine.cylinder.bore if machine.cylinder else 2 * radius
    known = machine.engine.bearings if machine.engine else Bearings()
    # what is drawn beside the crank is no larger than the crank lets it be
    small = min(bore, 1.6 * stroke)
    skirt, crown = min(_SKIRT * bore, 0.35 * stroke), min(_CROWN * bore, 0.6 * stroke)
    lowest = min(cylinder.bottom for cylinder in engine.cylinders) - skirt
    stations, journals = _along_shaft(engine, bore)
    pitch = (journals[-1] - journals[0]) / max(len(journals) - 1, 1)
    return Sizes(
        bore,
        radius,
        known.crankpin_diameter / 2 if known.crankpin_diameter else min(_PIN * small, 0.45 * radius),
        known.main_diameter / 2 if known.main_diameter else min(_MAIN * small, 0.5 * radius),
        known.pin_diameter / 2 if known.pin_diameter else _WRIST * small,
        crown,
        skirt,
        _clearance(machine, stroke),
        min(1.35 * radius, lowest - _WALL * bore) if _has_counterweights(machine) else 0.0,
        stations,
        journals,
        min(known.main_length or _JOURNAL * pitch, 0.4 * pitch),
    )


def _clearance(machine: Machine, stroke: float) -> float:
    """Return the height of the clearance volume above the piston, by default a twentieth of the stroke. [m]"""
    cylinder = machine.cylinder
    if cylinder and cylinder.clearance_volume is not None:
        return min(cylinder.clearance_volume / (math.pi / 4 * cylinder.bore**2), stroke)
    if cylinder and cylinder.compression_ratio is not None:
        return min(stroke / (cylinder.compression_ratio - 1), stroke)
    return stroke / 20


def _has_counterweights(machine: Machine) -> bool:
    engine = machine.engine
    return engine is not None and bool(engine.counterweight or engine.rotating_share or engine.reciprocating_share)


def _along_shaft(engine: SampledEngine, bore: float) -> tuple[dict[int, float], tuple[float, ...]]:
    """Return positions of cylinders and main journals, by default at a usual distance. [m]"""
    places, given = engine.layout.places, engine.layout.journal_positions
    throws = 1 + max(place.throw for place in places)
    if given or throws == 1:
        span = (-_PITCH * bore / 2, _PITCH * bore / 2)
        return {place.number: place.position for place in places}, given or span
    pitch, middle = _PITCH * bore, (throws - 1) / 2
    stations = {place.number: (place.throw - middle) * pitch for place in places}
    return stations, tuple((index - 0.5 - middle) * pitch for index in range(throws + 1))


def reach(engine: SampledEngine, size: Sizes) -> Array:
    """Return places that an engine seen along the shaft reaches, shape (k, 2). [m]"""
    around = max(size.crank + 1.4 * size.pin, size.counterweight)
    corners = [np.array([[side * around, side * around] for side in (1, -1)])]
    for cylinder in engine.cylinders:
        across = np.array([cylinder.axis[1], -cylinder.axis[0]])
        corners += [
            (size.head(cylinder) * cylinder.axis + (cylinder.offset + side * size.bore / 2) * across)[None]
            for side in (1, -1)
        ]
    return np.vstack(corners)
