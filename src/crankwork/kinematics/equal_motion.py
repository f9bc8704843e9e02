"""The traced motion of a part that does what an earlier one does: later, and turned about the pivot of the crank."""

from __future__ import annotations

from crankwork.formula.traced_value import TracedValue, delayed
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import LinkMotion, named_link, named_point
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.position_analysis import Placed
from crankwork.mechanism.equal_parts import EqualPart

Vector = tuple[TracedValue, TracedValue]


class Follower:
    """Gives traced values of an equal part: those of the earlier part at its own crank angle, vectors turned."""

    def __init__(self, part: EqualPart) -> None:
        self.part = part
        angle = CrankGrid.from_degrees([part.turn])
        self._cos, self._sin = float(angle.cos[0]), float(angle.sin[0])
        self._later: dict[int, tuple[TracedValue, TracedValue]] = {}
        self._points: dict[tuple[int, int], tuple[PointMotion, PointMotion]] = {}

    def later(self, known: TracedValue) -> TracedValue:
        """Return a value at the crank angle of this part; the same node for the same value."""
        if not known.varies:
            return known
        if id(known.node) not in self._later:
            self._later[id(known.node)] = known, delayed(known, self.part.delay, self.part.cycle, known.key)
        return self._later[id(known.node)][1]

    def vector(self, x: TracedValue, y: TracedValue) -> Vector:
        """Return a vector at the crank angle of this part, turned to it."""
        return self._turned(self.later(x), self.later(y))

    def _turned(self, x: TracedValue, y: TracedValue) -> Vector:
        cos, sin = self._cos, self._sin
        if not sin:
            return (x, y) if cos > 0 else (-x, -y)
        if not cos:
            return (-y, x) if sin > 0 else (y, -x)
        return x * cos - y * sin, x * sin + y * cos

    def set_point(self, first: PointMotion, own: PointMotion) -> None:
        """Say which point stands for one of the earlier part, where both are known."""
        self._points[id(first.x.position.node), id(first.y.position.node)] = first, own

    def point(self, first: PointMotion, pivot: PointMotion) -> PointMotion:
        """Return the motion of a point; the same for the same point."""
        key = id(first.x.position.node), id(first.y.position.node)
        if key not in self._points:
            (x, *x_rates), (y, *y_rates) = first
            rates = [self.vector(*pair) for pair in zip(x_rates, y_rates, strict=True)]
            if self.part.turn:
                origin = pivot.x.position, pivot.y.position
                across = self._turned(self.later(x) - origin[0], self.later(y) - origin[1])
                place = tuple(start + way for start, way in zip(origin, across, strict=True))
            else:
                place = self.later(x), self.later(y)
            own = PointMotion(*(Transfer(place[side], *(rate[side] for rate in rates)) for side in (0, 1)))
            self._points[key] = first, own
        return self._points[key][1]

    def frame(self, first: LinkMotion, pivot: PointMotion) -> LinkMotion:
        """Return the motion of a frame."""
        return LinkMotion(
            self.point(first.origin, pivot),
            *self.vector(first.cos, first.sin),
            self.later(first.angle_1),
            self.later(first.angle_2),
        )


def place_equal(placed: Placed, part: EqualPart, pivot: PointMotion) -> None:
    """Add points, links and sliders of an equal part to those placed."""
    follower = Follower(part)
    for name, own in part.names.items():
        if name in placed.points and own in placed.points:
            follower.set_point(placed.points[name], placed.points[own])
    for name, point in [*placed.points.items()]:
        own_name = part.names.get(name)
        if own_name is not None and own_name not in placed.points:
            moved = named_point(follower.point(point, pivot), own_name)
            placed.points[own_name] = moved
            follower.set_point(point, moved)
    for frames in (placed.links, placed.bars):
        for name in part.first & frames.keys():
            frames[part.names[name]] = named_link(follower.frame(frames[name], pivot), part.names[name])
    for name in part.first & placed.sliders.keys():
        own, slide = part.names[name], map(follower.later, placed.sliders[name])
        placed.sliders[own] = Transfer(*(side.named(f"{side.key.partition('.')[0]}.{own}") for side in slide))
