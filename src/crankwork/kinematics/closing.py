"""What closes a chain of links: an equation for each coordinate of each pin, and two for each slide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import LinkMotion, guide_on_link, point_on_guide, point_on_link, seen_from
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain, ChainLink, Gear
from crankwork.mechanism.dyads import Guide

Positions = NDArray[np.intp]

_STILL = np.array(0.0)


class Surroundings(Protocol):
    """What a chain hangs on: points that are placed, guides on links that are, and lengths that change."""

    @property
    def lengths(self) -> dict[str, Transfer]:
        """Lengths of links from their first joint to their second, where they change."""

    @property
    def points(self) -> dict[str, PointMotion]:
        """Points by name."""

    def guide(self, guide: Guide) -> LinkMotion:
        """Return the motion of a guide."""


class Row(NamedTuple):
    """An equation: its value and two derivatives, each shape (n,), and its derivative by the coordinates of links."""

    value: Transfer
    columns: list[tuple[int, Array, Array, Array]]


@dataclass
class ClosingEquations:
    """The closing equations of a chain, as many as its links have coordinates, less its own freedom."""

    chain: Chain
    freedom: int = 0

    def __post_init__(self) -> None:
        self.names = ", ".join(link.name for link in self.chain.links)
        self.index = {link.name: 3 * k for k, link in enumerate(self.chain.links)}
        owners: dict[str, list[str]] = {}
        for link in self.chain.links:
            for name in link.points:
                owners.setdefault(name, []).append(link.name)
        self.pins = [
            (name, links[0], other)
            for name, links in owners.items()
            for other in (links if name in self.chain.known else links[1:])
        ]
        count = 2 * len(self.pins) + 2 * len(self.chain.slides) + len(self.chain.gears)
        if count != 3 * len(self.index) - self.freedom:
            raise GeometryError(
                Refusal("chain_count", links=self.names, equations=count, coordinates=3 * len(self.index))
            )
        size = max(np.hypot(*point) for link in self.chain.links for point in link.points.values()) or 1.0
        self.scale = np.tile([size, size, 1.0], len(self.index))
        turning = [1.0] * len(self.chain.gears)
        self.row_scale = np.array([size] * 2 * len(self.pins) + [size, 1.0] * len(self.chain.slides) + turning)

    def frames(self, q: Array, q_1: Array | None, q_2: Array | None) -> dict[str, LinkMotion]:
        """Return the frames of the links from their coordinates."""
        # where only positions are wanted, links that do not turn spare what turning adds to their points
        zero = _STILL
        frames = {}
        for name, k in self.index.items():
            x, y, angle = (
                Transfer(q[:, k + j], zero if q_1 is None else q_1[:, k + j], zero if q_2 is None else q_2[:, k + j])
                for j in range(3)
            )
            cos, sin = np.cos(angle.position), np.sin(angle.position)
            frames[name] = LinkMotion(PointMotion(x, y), cos, sin, angle.position_1, angle.position_2)
        return frames

    def rows(self, q: Array, q_1: Array | None, q_2: Array | None, around: Surroundings, at: Positions) -> list[Row]:
        """Return all equations at some of the positions."""
        frames = self.frames(q, q_1, q_2)
        rows: list[Row] = []
        for name, one, other in self.pins:
            end, column = self._point(other, name, frames, around, at)
            if name in self.chain.known:
                rows += _pin(end, point_at(around.points[name], at), [column], [])
            else:
                start, against = self._point(one, name, frames, around, at)
                rows += _pin(end, start, [column], [against])
        for slide in self.chain.slides:
            rows += self._slide(slide.link, slide.guide, q, frames, around, at)
        return [*rows, *(self._gear(gear, q, frames) for gear in self.chain.gears)]

    def _gear(self, gear: Gear, q: Array, frames: dict[str, LinkMotion]) -> Row:
        """Return the equation of two links that gears turn together."""
        k, j = self.index[gear.link], self.index[gear.other]
        zero, one, other = np.zeros(len(q)), frames[gear.link], frames[gear.other]
        open_ = q[:, k + 2] - gear.start - gear.ratio * q[:, j + 2]
        rates = (a - gear.ratio * b for a, b in ((one.angle_1, other.angle_1), (one.angle_2, other.angle_2)))
        columns = [(k, zero, zero, zero + 1.0), (j, zero, zero, zero - gear.ratio)]
        return Row(Transfer(open_, *rates), columns)

    def _point(
        self, link: str, name: str, frames: dict[str, LinkMotion], around: Surroundings, at: Positions
    ) -> tuple[PointMotion, tuple[int, Array, Array]]:
        """Return the motion of a point of a link, and its derivative by the angle of the link."""
        k, frame = self.index[link], frames[link]
        point = point_of(self.chain.links[k // 3], name, frame, around, at)
        arm_x, arm_y = point.x.position - frame.origin.x.position, point.y.position - frame.origin.y.position
        return point, (k, -arm_y, arm_x)

    def _slide(
        self, link: str, guide: Guide, q: Array, frames: dict[str, LinkMotion], around: Surroundings, at: Positions
    ) -> list[Row]:
        """Return the two equations of a link whose x axis lies on a guide."""
        k, frame = self.index[link], frames[link]
        carrier = self.index.get(guide.link)
        line = line_at(around.guide(guide), at) if carrier is None else guide_on_link(frames[guide.link], guide)
        across = seen_from(line, frame.origin).y
        zero, one = np.zeros(len(q)), np.ones(len(q))
        columns = [(k, -line.sin + zero, line.cos + zero, zero)]
        # sine of the angle between the two x axes; at the solution its cosine is one
        sine = frame.sin * line.cos - frame.cos * line.sin
        turn = Transfer(sine, frame.angle_1 - line.angle_1, frame.angle_2 - line.angle_2)
        turns = [(k, zero, zero, one)]
        if carrier is not None:
            base = frames[guide.link].origin
            arm_x, arm_y = (mine.position - other.position for mine, other in zip(frame.origin, base, strict=True))
            columns.append((carrier, line.sin, -line.cos, -(arm_x * line.cos + arm_y * line.sin)))
            turns.append((carrier, zero, zero, -one))
        return [Row(across, columns), Row(turn, turns)]

    def jacobian(self, rows: list[Row], count: int) -> Array:
        """Return the derivative of the equations by the coordinates, shape (n, equations, 3 m)."""
        matrix = np.zeros((count, len(rows), 3 * len(self.index)))
        for row, equation in enumerate(rows):
            for k, x, y, angle in equation.columns:
                matrix[:, row, k], matrix[:, row, k + 1], matrix[:, row, k + 2] = x, y, angle
        return matrix


def _pin(
    end: PointMotion,
    start: PointMotion,
    ends: list[tuple[int, Array, Array]],
    starts: list[tuple[int, Array, Array]],
) -> list[Row]:
    """Return the two equations of a pin: that two points are one."""
    zero = np.zeros(np.shape(end.x.position))
    x_columns = [(k, zero + sign, zero, sign * x) for sign, side in ((1, ends), (-1, starts)) for k, x, _ in side]
    y_columns = [(k, zero, zero + sign, sign * y) for sign, side in ((1, ends), (-1, starts)) for k, _, y in side]
    apart = [Transfer(*(a - b for a, b in zip(one, two, strict=True))) for one, two in zip(end, start, strict=True)]
    return [Row(apart[0], x_columns), Row(apart[1], y_columns)]


def is_stretched(link: ChainLink, name: str, around: Surroundings) -> bool:
    """Return whether a point is the far end of a link whose length changes."""
    return link.name in around.lengths and link.points[name] != (0.0, 0.0)


def point_of(link: ChainLink, name: str, frame: LinkMotion, around: Surroundings, at: Positions) -> PointMotion:
    """Return the motion of a point of a link, whose length may change."""
    if is_stretched(link, name, around):
        return point_on_guide(frame, Transfer(*(one[at] for one in around.lengths[link.name])))
    return point_on_link(frame, *link.points[name])


def point_at(point: PointMotion, at: Positions) -> PointMotion:
    """Return a motion at some of the positions."""
    return PointMotion(*(Transfer(*(one[at] if one.ndim else one for one in side)) for side in point))


def line_at(line: LinkMotion, at: Positions) -> LinkMotion:
    """Return the motion of a line at some of the positions."""
    cos, sin, angle_1, angle_2 = (one[at] if one.ndim else one for one in line[1:])
    return LinkMotion(point_at(line.origin, at), cos, sin, angle_1, angle_2)
