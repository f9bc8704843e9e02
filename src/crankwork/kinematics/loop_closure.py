"""What closes a chain of links: an equation for each coordinate of each pin, and two for each slide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import LinkMotion, guide_on_link, in_link_frame, point_on_guide, point_on_link
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import Chain, ChainLink, Gear, Guide, Slide

Positions = NDArray[np.intp]

_ZERO = np.array(0.0)


class ChainBoundary(Protocol):
    """The placed neighbours of a chain: points, guides on links, and lengths that change."""

    @property
    def lengths(self) -> dict[str, Transfer]:
        """Lengths of links from their first joint to their second, where they change."""

    @property
    def points(self) -> dict[str, PointMotion]:
        """Points by name."""

    def guide(self, guide: Guide) -> LinkMotion:
        """Return the motion of a guide."""


class _Arms(NamedTuple):
    """The points of links joined by pins: first one point of each pin, then the points joined to it.

    Arrays with a column for each point; arrays with two rows are of x and of y.
    """

    row: Positions  # Rows of its equations, shape (2, points)
    place: Positions  # Columns of the coordinates of the origin of its link, shape (2, points)
    angle: Positions  # Column of the angle of its link
    along: Array  # Position in the frame of its link [m]
    across: Array
    sign: Array


@dataclass
class LoopClosure:
    """The loop-closure equations of a chain: as many as its links have coordinates, less its degrees of freedom."""

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
                ErrorMessage("chain_count", links=self.names, equations=count, coordinates=3 * len(self.index))
            )
        size = max(np.hypot(*point) for link in self.chain.links for point in link.points.values()) or 1.0
        self.scale = np.tile([size, size, 1.0], len(self.index))
        turning = [1.0] * len(self.chain.gears)
        self._known = [(2 * pin, name) for pin, (name, _, _) in enumerate(self.pins) if name in self.chain.known]
        joined = [(pin, other, name, 1.0) for pin, (name, _, other) in enumerate(self.pins)]
        joined += [
            (pin, first, name, -1.0) for pin, (name, first, _) in enumerate(self.pins) if name not in self.chain.known
        ]
        pins, links, names, signs = zip(*joined, strict=True) if joined else ((), (), (), ())
        rows = 2 * np.array(pins, dtype=np.intp)
        origins = np.array([self.index[link_name] for link_name in links], dtype=np.intp)
        places = [self._link(link).points[name] for link, name in zip(links, names, strict=True)]
        along, across = np.array(places, dtype=float).reshape(-1, 2).T
        both = np.arange(2)[:, None]
        self._arms = _Arms(rows + both, origins + both, origins + 2, along, across, np.array(signs))
        # the constant part of the derivative
        self._slope = np.zeros((count, 3 * len(self.index)))
        self._slope[self._arms.row, self._arms.place] = self._arms.sign
        self.row_scale = np.array([size] * 2 * len(self.pins) + [size, 1.0] * len(self.chain.slides) + turning)

    def frames(self, q: Array, q_1: Array | None, q_2: Array | None) -> dict[str, LinkMotion]:
        """Return the frames of the links from their coordinates."""
        # without derivatives, zeros have no axis, so that links which do not rotate add nothing to their points
        zero = _ZERO
        frames = {}
        for name, k in self.index.items():
            x, y, angle = (
                Transfer(q[:, k + j], zero if q_1 is None else q_1[:, k + j], zero if q_2 is None else q_2[:, k + j])
                for j in range(3)
            )
            cos, sin = np.cos(angle.position), np.sin(angle.position)
            frames[name] = LinkMotion(PointMotion(x, y), cos, sin, angle.position_1, angle.position_2)
        return frames

    def residual(self, q: Array, boundary: ChainBoundary, positions: Positions) -> tuple[Array, Array]:
        """Return the residuals at some positions, and their derivative by the coordinates of the links.

        Shapes (n, equations) and (n, equations, 3 m).
        """
        value, slope = np.empty((len(q), len(self.row_scale))), np.repeat(self._slope[None], len(q), axis=0)
        row, place, angle, along, across, sign = self._arms
        if boundary.lengths:
            along = self._stretched(boundary, positions)
        turned, ends = q[:, angle], len(self.pins)
        cos, sin = np.cos(turned), np.sin(turned)
        arm_x, arm_y = plane.arm_along_x(along, cos, across, sin), plane.arm_along_y(along, sin, across, cos)
        points = q[:, place]
        points[:, 0] += arm_x
        points[:, 1] += arm_y
        value[:, row[:, :ends]] = points[:, :, :ends]
        value[:, row[:, ends:]] -= points[:, :, ends:]
        for first, name in self._known:
            x, y = boundary.points[name]
            value[:, first] -= x.position[positions] if x.position.ndim else x.position
            value[:, first + 1] -= y.position[positions] if y.position.ndim else y.position
        slope[:, row[0], angle], slope[:, row[1], angle] = -sign * arm_y, sign * arm_x
        self._close_slides(q, boundary, positions, value, slope)
        for number, gear in enumerate(self.chain.gears, start=2 * (ends + len(self.chain.slides))):
            k, j = self.index[gear.link] + 2, self.index[gear.other] + 2
            value[:, number] = _gear(gear, q[:, k], q[:, j]) - gear.start
            slope[:, number, k], slope[:, number, j] = 1.0, -gear.ratio
        return value, slope

    def _stretched(self, boundary: ChainBoundary, positions: Positions) -> Array:
        """Return the distances of points along their links, some of changing length, shape (n, points)."""
        along = np.tile(self._arms.along, (len(positions), 1))
        for column, k in enumerate(self._arms.angle.tolist()):
            length = boundary.lengths.get(self.chain.links[k // 3].name)
            if length is not None and (self._arms.along[column] or self._arms.across[column]):
                along[:, column] = length.position[positions]
        return along

    def _close_slides(
        self, q: Array, boundary: ChainBoundary, positions: Positions, value: Array, slope: Array
    ) -> None:
        """Set the residuals of the slides and their derivative in their rows."""
        frames = self.frames(q, None, None) if self.chain.slides else {}
        for number, slide in enumerate(self.chain.slides):
            row, k, frame = 2 * (len(self.pins) + number), self.index[slide.link], frames[slide.link]
            line = self.line(slide, frames, boundary, positions)
            value[:, row] = in_link_frame(line, frame.origin).y.position
            # sine of the angle between the two x axes; at the solution its cosine is one
            value[:, row + 1] = frame.sin * line.cos - frame.cos * line.sin
            slope[:, row, k], slope[:, row, k + 1], slope[:, row + 1, k + 2] = -line.sin, line.cos, 1.0
            if slide.guide.link in self.index:
                j, base = self.index[slide.guide.link], frames[slide.guide.link].origin
                arm_x, arm_y = (mine.position - other.position for mine, other in zip(frame.origin, base, strict=True))
                slope[:, row, j], slope[:, row, j + 1] = line.sin, -line.cos
                slope[:, row, j + 2], slope[:, row + 1, j + 2] = -(arm_x * line.cos + arm_y * line.sin), -1.0

    def residual_derivatives(
        self, q: Array, q_1: Array, q_2: Array, boundary: ChainBoundary, positions: Positions
    ) -> tuple[Array, Array]:
        """Return the first and second derivative of the residuals by the driver, each shape (n, equations).

        The derivatives of the coordinates and of the boundary are given.
        """
        frames = self.frames(q, q_1, q_2)
        rows: list[Transfer] = []
        for name, owner, other in self.pins:
            end = point_of(self._link(other), name, frames[other], boundary, positions)
            if name in self.chain.known:
                start = point_at(boundary.points[name], positions)
            else:
                start = point_of(self._link(owner), name, frames[owner], boundary, positions)
            rows += [Transfer(*(a - b for a, b in zip(*both, strict=True))) for both in zip(end, start, strict=True)]
        for slide in self.chain.slides:
            frame, line = frames[slide.link], self.line(slide, frames, boundary, positions)
            turn = frame.angle_1 - line.angle_1, frame.angle_2 - line.angle_2
            rows += [in_link_frame(line, frame.origin).y, Transfer(_ZERO, *turn)]
        for gear in self.chain.gears:
            own, partner = frames[gear.link], frames[gear.other]
            turn = _gear(gear, own.angle_1, partner.angle_1), _gear(gear, own.angle_2, partner.angle_2)
            rows.append(Transfer(_ZERO, *turn))
        first, second = (np.stack([row[order] for row in rows], axis=-1) for order in (1, 2))
        return first, second

    def _link(self, name: str) -> ChainLink:
        return self.chain.links[self.index[name] // 3]

    def line(
        self, slide: Slide, frames: dict[str, LinkMotion], boundary: ChainBoundary, positions: Positions
    ) -> LinkMotion:
        """Return the motion of the line that a slide is on."""
        carrier = frames.get(slide.guide.link)
        return (
            line_at(boundary.guide(slide.guide), positions) if carrier is None else guide_on_link(carrier, slide.guide)
        )


def _gear(gear: Gear, turned: Array, other: Array) -> Array:
    """Return the rotation of a gear beyond that imposed by its partner. [rad]"""
    return turned - gear.ratio * other


def is_stretched(link: ChainLink, name: str, boundary: ChainBoundary) -> bool:
    """Return whether a point is the far end of a link of changing length."""
    return link.name in boundary.lengths and link.points[name] != (0.0, 0.0)


def point_of(
    link: ChainLink, name: str, frame: LinkMotion, boundary: ChainBoundary, positions: Positions
) -> PointMotion:
    """Return the motion of a point of a link, whose length may change, at some of the positions."""
    if is_stretched(link, name, boundary):
        return point_on_guide(frame, Transfer(*(length[positions] for length in boundary.lengths[link.name])))
    return point_on_link(frame, *link.points[name])


def point_at(point: PointMotion, positions: Positions) -> PointMotion:
    """Return a motion at some of the positions."""
    return PointMotion(*(Transfer(*(value[positions] if value.ndim else value for value in side)) for side in point))


def line_at(line: LinkMotion, positions: Positions) -> LinkMotion:
    """Return the motion of a line at some of the positions."""
    cos, sin, angle_1, angle_2 = (value[positions] if value.ndim else value for value in line[1:])
    return LinkMotion(point_at(line.origin, positions), cos, sin, angle_1, angle_2)


def solve_positions(matrix: Array, right: Array) -> Array:
    """Return the solutions of linear systems, NaN where the position is unknown or singular.

    `matrix` and `right`: a system for each position, shape (n, k, k), (n, k).
    """
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        known = np.asarray(np.isfinite(matrix).all(axis=(-2, -1)) & np.isfinite(right).all(axis=-1))
        known &= np.linalg.det(np.where(known[:, None, None], matrix, 0.0)) != 0
        solution = np.full_like(right, np.nan)
        solution[known] = np.linalg.solve(matrix[known], right[known, :, None])[..., 0]
        return solution
