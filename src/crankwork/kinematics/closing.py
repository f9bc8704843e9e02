"""What closes a chain of links: an equation for each coordinate of each pin, and two for each slide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import LinkMotion, guide_on_link, point_on_guide, point_on_link, seen_from
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain, ChainLink, Gear, Slide
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


class _Arms(NamedTuple):
    """The points of links that pins join, first one of each pin, then those that it is joined to.

    Each array has a column for each point; in those of two rows they are of x and of y.
    """

    row: Positions  # Which equations it is in, shape (2, points)
    place: Positions  # Which coordinates are those of the origin of its link, shape (2, points)
    angle: Positions  # Which is the angle
    along: Array  # Where it is in the frame of its link [m]
    across: Array
    sign: Array


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
        self._known = [(2 * pin, name) for pin, (name, _, _) in enumerate(self.pins) if name in self.chain.known]
        joined = [(pin, other, name, 1.0) for pin, (name, _, other) in enumerate(self.pins)]
        joined += [
            (pin, one, name, -1.0) for pin, (name, one, _) in enumerate(self.pins) if name not in self.chain.known
        ]
        pins, links, names, signs = zip(*joined, strict=True) if joined else ((), (), (), ())
        rows, origins = (2 * np.array(pins, dtype=np.intp), np.array([self.index[one] for one in links], dtype=np.intp))
        places = [self._link(link).points[name] for link, name in zip(links, names, strict=True)]
        along, across = np.array(places, dtype=float).reshape(-1, 2).T
        both = np.arange(2)[:, None]
        self._arms = _Arms(rows + both, origins + both, origins + 2, along, across, np.array(signs))
        # what of the derivative is the same everywhere
        self._slope = np.zeros((count, 3 * len(self.index)))
        self._slope[self._arms.row, self._arms.place] = self._arms.sign
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

    def closed(self, q: Array, around: Surroundings, at: Positions) -> tuple[Array, Array]:
        """Return what is left open at some of the positions, and its derivative by the coordinates of the links.

        Shapes (n, equations) and (n, equations, 3 m).
        """
        value, slope = np.empty((len(q), len(self.row_scale))), np.repeat(self._slope[None], len(q), axis=0)
        row, place, angle, along, across, sign = self._arms
        if around.lengths:
            along = self._stretched(around, at)
        turned, ends = q[:, angle], len(self.pins)
        cos, sin = np.cos(turned), np.sin(turned)
        arm_x, arm_y = plane.arm_along_x(along, cos, across, sin), plane.arm_along_y(along, sin, across, cos)
        points = q[:, place]
        points[:, 0] += arm_x
        points[:, 1] += arm_y
        value[:, row[:, :ends]] = points[:, :, :ends]
        value[:, row[:, ends:]] -= points[:, :, ends:]
        for first, name in self._known:
            x, y = around.points[name]
            value[:, first] -= x.position[at] if x.position.ndim else x.position
            value[:, first + 1] -= y.position[at] if y.position.ndim else y.position
        slope[:, row[0], angle], slope[:, row[1], angle] = -sign * arm_y, sign * arm_x
        self._close_slides(q, around, at, value, slope)
        for number, gear in enumerate(self.chain.gears, start=2 * (ends + len(self.chain.slides))):
            k, j = self.index[gear.link] + 2, self.index[gear.other] + 2
            value[:, number] = _gear(gear, q[:, k], q[:, j]) - gear.start
            slope[:, number, k], slope[:, number, j] = 1.0, -gear.ratio
        return value, slope

    def _stretched(self, around: Surroundings, at: Positions) -> Array:
        """Return how far points are along their links, some of which change their length, shape (n, points)."""
        along = np.tile(self._arms.along, (len(at), 1))
        for column, k in enumerate(self._arms.angle.tolist()):
            length = around.lengths.get(self.chain.links[k // 3].name)
            if length is not None and (self._arms.along[column] or self._arms.across[column]):
                along[:, column] = length.position[at]
        return along

    def _close_slides(self, q: Array, around: Surroundings, at: Positions, value: Array, slope: Array) -> None:
        """Put what slides leave open, and its derivative, into their rows."""
        frames = self.frames(q, None, None) if self.chain.slides else {}
        for number, slide in enumerate(self.chain.slides):
            row, k, frame = 2 * (len(self.pins) + number), self.index[slide.link], frames[slide.link]
            line = self.line(slide, frames, around, at)
            value[:, row] = seen_from(line, frame.origin).y.position
            # sine of the angle between the two x axes; at the solution its cosine is one
            value[:, row + 1] = frame.sin * line.cos - frame.cos * line.sin
            slope[:, row, k], slope[:, row, k + 1], slope[:, row + 1, k + 2] = -line.sin, line.cos, 1.0
            if slide.guide.link in self.index:
                j, base = self.index[slide.guide.link], frames[slide.guide.link].origin
                arm_x, arm_y = (mine.position - other.position for mine, other in zip(frame.origin, base, strict=True))
                slope[:, row, j], slope[:, row, j + 1] = line.sin, -line.cos
                slope[:, row, j + 2], slope[:, row + 1, j + 2] = -(arm_x * line.cos + arm_y * line.sin), -1.0

    def rates(self, q: Array, q_1: Array, q_2: Array, around: Surroundings, at: Positions) -> tuple[Array, Array]:
        """Return the first and the second derivative of what is left open, each shape (n, equations).

        They follow from those of the coordinates, and of what the links hang on.
        """
        frames = self.frames(q, q_1, q_2)
        rows: list[Transfer] = []
        for name, one, other in self.pins:
            end = point_of(self._link(other), name, frames[other], around, at)
            if name in self.chain.known:
                start = point_at(around.points[name], at)
            else:
                start = point_of(self._link(one), name, frames[one], around, at)
            rows += [Transfer(*(a - b for a, b in zip(*both, strict=True))) for both in zip(end, start, strict=True)]
        for slide in self.chain.slides:
            frame, line = frames[slide.link], self.line(slide, frames, around, at)
            turn = frame.angle_1 - line.angle_1, frame.angle_2 - line.angle_2
            rows += [seen_from(line, frame.origin).y, Transfer(_STILL, *turn)]
        for gear in self.chain.gears:
            own, others = frames[gear.link], frames[gear.other]
            turn = _gear(gear, own.angle_1, others.angle_1), _gear(gear, own.angle_2, others.angle_2)
            rows.append(Transfer(_STILL, *turn))
        first, second = (np.stack([row[order] for row in rows], axis=-1) for order in (1, 2))
        return first, second

    def _link(self, name: str) -> ChainLink:
        return self.chain.links[self.index[name] // 3]

    def line(self, slide: Slide, frames: dict[str, LinkMotion], around: Surroundings, at: Positions) -> LinkMotion:
        """Return the motion of the line that a slide is on."""
        carrier = frames.get(slide.guide.link)
        return line_at(around.guide(slide.guide), at) if carrier is None else guide_on_link(carrier, slide.guide)


def _gear(gear: Gear, turned: Array, other: Array) -> Array:
    """Return by how much a gear has turned further than another one that it meshes with makes it. [rad]"""
    return turned - gear.ratio * other


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
