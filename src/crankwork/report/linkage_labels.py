"""Where the letters and numbers of a drawn linkage go: beside what they name, clear of the rest at every angle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array
from crankwork.mechanism.driver import rod_name
from crankwork.mechanism.linkage import GROUND
from crankwork.report.linkage_scene import SLOT, Scene

_TURNS = np.radians([45, 135, 315, 225, 90, 0, 180, 270, 20, 70, 110, 160, 200, 250, 290, 340])
_AROUND = np.column_stack([np.cos(_TURNS), np.sin(_TURNS)])
_REACHES = (15.0, 19.0, 24.0, 30.0)
# a centre of mass nearer than this to a joint has no name
_JOINT = 10.0
# under a support and beside it, where no link goes
_SUPPORTS = (0.0, -43.0), (-27.0, -12.0), (27.0, -12.0)
_EVERY = 3
_STEP = 7.0
# a number nearer than this to a link is read as that of the link
_NEAR = 15.0


class Label(NamedTuple):
    """A text whose middle follows places, array of shape (n, 2); y upwards."""

    text: str
    places: Array
    is_number: bool

    @property
    def half(self) -> Array:
        """Half its width and height. [px]"""
        return np.array([4.4 * len(self.text) + 1.5, 6.5])


def labels(drawn: Scene, fixed: Sequence[Array] = (), *, stride: int = _EVERY) -> list[Label]:
    """Return the names of points and the numbers of links."""
    obstacles, owners = _samples(drawn, stride)
    still = np.vstack([*fixed, np.zeros((0, 2))])
    count = obstacles.shape[0]
    obstacles = np.concatenate([obstacles, np.broadcast_to(still, (count, *still.shape))], axis=1)
    owners += [""] * len(still)
    placed: list[Label] = []
    # without pivots there is no place for the number of the ground
    for text, link, ways in (label for label in _wanted(drawn) if label[2]):
        # places on other links, of which a number could be
        is_other = np.array([bool(link and owner and owner != link) for owner in owners])
        seen = _Seen(np.ascontiguousarray(obstacles[..., 0]), np.ascontiguousarray(obstacles[..., 1]), is_other)
        choices = [(Label(text, place, bool(link)), extra) for place, extra in ways]
        placed.append(_cheapest(choices, seen, placed, stride))
    return placed


class _Seen(NamedTuple):
    """Places on all that is drawn, shape (frames, k), and which of them are on links that a number is not of."""

    x: Array
    y: Array
    is_other: NDArray[np.bool_]


def _cheapest(ways: Sequence[tuple[Label, float]], seen: _Seen, placed: Sequence[Label], stride: int) -> Label:
    """Return the label that costs least; one that costs more at least than another does is not looked at."""
    best, chosen = np.inf, 0
    seen = _reachable([label for label, _ in ways], seen, stride)
    names = np.array([label.places[::stride] for label in placed]), np.array([[label.half] for label in placed])
    for index in sorted(range(len(ways)), key=lambda candidate: ways[candidate][1]):
        label, extra = ways[index]
        if extra > best:
            break
        cost = _cost(label, extra, seen, names, stride)
        best, chosen = min((best, chosen), (cost, index))
    return ways[chosen][0]


def _reachable(ways: Sequence[Label], seen: _Seen, stride: int) -> _Seen:
    """Return the places that a label could cover, or be read as the number of, at one place or another."""
    places = np.array([label.places[::stride] for label in ways])
    half = np.max([label.half for label in ways], axis=0) + (_NEAR if seen.is_other.any() else 0.0)
    low, high = places.min(axis=0) - half, places.max(axis=0) + half
    near = (seen.x > low[:, :1]) & (seen.x < high[:, :1]) & (seen.y > low[:, 1:]) & (seen.y < high[:, 1:])
    kept = near.any(axis=0)
    return _Seen(np.ascontiguousarray(seen.x[:, kept]), np.ascontiguousarray(seen.y[:, kept]), seen.is_other[kept])


def _cost(label: Label, extra: float, seen: _Seen, names: tuple[Array, Array], stride: int) -> float:
    centre, half = label.places[::stride, None], label.half
    off = seen.x - centre[..., 0], seen.y - centre[..., 1]
    covered = (np.abs(off[0]) < half[0]) & (np.abs(off[1]) < half[1])
    cost = extra + 10.0 * float(np.count_nonzero(covered)) / len(centre)
    if seen.is_other.any():
        # a number as close to another link as to its own is misleading
        distance = np.hypot(off[0][:, seen.is_other], off[1][:, seen.is_other]).min(axis=1)
        cost += 60.0 * float(np.mean(distance < _NEAR))
    middles, halves = names
    if len(middles):
        covers = np.all(np.abs(middles - label.places[::stride]) < half + halves + (11.0, 2.0), axis=2)
        cost += 60.0 * float(covers.mean(axis=1).sum())
    return cost


def _wanted(drawn: Scene) -> Iterator[tuple[str, str, list[tuple[Array, float]]]]:
    """Yield each text, the link it numbers, the places where it could be, and the least cost of each."""
    shape = drawn.skeleton
    seen: set[str] = set()
    for name, letter in shape.letters.items():
        if name in drawn.points and letter not in seen and not _is_crossed(drawn, name):
            seen.add(letter)
            wide = 4.4 * (len(letter) - 1)
            supports = _SUPPORTS if name in shape.pivots else ()
            yield (
                letter,
                "",
                [(drawn.points[name] + spot, 0.0) for spot in supports]
                + [
                    (
                        drawn.points[name] + (reach + wide * abs(direction[0])) * direction,
                        0.4 * (reach - 15) + 0.2 * rank,
                    )
                    for reach in _REACHES
                    for rank, direction in enumerate(_AROUND)
                ],
            )
    spots = [(side * x, -y) for x, y in ((32, 24), (30, 12), (36, 36), (12, 46)) for side in (1, -1)]
    yield (
        "0",
        GROUND,
        [(drawn.points[name] + spot, 3.0 * rank) for rank, name in enumerate(shape.pivots) for spot in spots],
    )
    for member in shape.members:
        yield str(member.number), member.name, list(_number_ways(drawn, member.name))
        if member.rod:
            yield str(member.rod), rod_name(member.name), list(_number_ways(drawn, rod_name(member.name)))


def _is_crossed(drawn: Scene, name: str) -> bool:
    """Return whether a joint goes over a centre of mass, whose name would be in a heap with its own."""
    place, joints = (
        drawn.points[name],
        [letter for letter in drawn.skeleton.letters if letter not in drawn.skeleton.centres],
    )
    return name in drawn.skeleton.centres and any(
        np.hypot(*(drawn.points[joint] - place).T).min() < _JOINT for joint in joints if joint in drawn.points
    )


def _number_ways(drawn: Scene, name: str) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a link or block, and the least cost of each."""
    for block in (item for item in drawn.blocks if item.name == name):
        ways = product((10, 18, 26), (-0.6, 0.0, 0.6, -1.3, 1.3), (1, -1))
        for reach, share, side in ways:
            yield block.pose.place(share * block.half[0], side * (block.half[1] + reach)), 0.3 * reach
    for slot in (item for item in drawn.slots if item.carrier == name):
        for share, side in product((0.2, 0.5, 0.8), (1, -1)):
            yield slot.line.place(slot.start + share * (slot.end - slot.start), side * (SLOT + 10)), 6.0
    for bar in (item for item in drawn.bars if item.name == name):
        if not bar.is_flat:
            yield np.asarray(np.mean(bar.nodes, axis=0)), -8.0
        for start, end in _edges(bar.nodes, is_flat=bar.is_flat):
            yield from _places_along(start, end)


def _places_along(start: Array, end: Array) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a line, its middle first."""
    along = end - start
    left = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    for share, side in product((0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8), (1, -1)):
        yield start + share * along + side * 13 * left, 8 * abs(share - 0.5)


def _edges(nodes: Sequence[Array], *, is_flat: bool) -> Iterator[tuple[Array, Array]]:
    yield from pairwise(nodes)
    if not is_flat:
        yield nodes[-1], nodes[0]


def _samples(drawn: Scene, stride: int) -> tuple[Array, list[str]]:
    """Return places on everything that is drawn, shape (frames, k, 2), and the links that they are on."""
    lines = [(bar.name, edge) for bar in drawn.bars for edge in _edges(bar.nodes, is_flat=bar.is_flat)]
    for slot in drawn.slots:
        sides = (SLOT, -SLOT)
        ends = ((slot.line.place(slot.start, side), slot.line.place(slot.end, side)) for side in sides)
        lines += [(slot.carrier, end) for end in ends]
    for block in drawn.blocks:
        u, v = block.half
        rows = np.linspace(v, -v, max(3, int(v / _STEP))).tolist()
        lines += [(block.name, (block.pose.place(-u, side), block.pose.place(u, side))) for side in rows]
    for rail in drawn.rails:
        for side in (rail.half, rail.half + 6, -rail.half, -rail.half - 6):
            lines.append(("", (rail.line.place(rail.start, side), rail.line.place(rail.end, side))))
    for pivot in (place for name, place in drawn.points.items() if name in drawn.skeleton.pivots):
        feet = [(pivot, np.add(pivot, foot)) for foot in ((-13.0, -24.0), (13.0, -24.0))]
        feet += [(np.add(pivot, (-26.0, drop)), np.add(pivot, (20.0, drop))) for drop in (-24.0, -31.0)]
        lines += [("", foot_line) for foot_line in feet]
    samples, owners = [place[::stride, None] for place in drawn.points.values()], [""] * len(drawn.points)
    for name, (start, end) in lines:
        length = float(np.max(np.hypot(*(end - start).T)))
        shares = np.linspace(0, 1, max(2, int(length / _STEP)))[:, None]
        samples.append(start[::stride, None] + shares * (end - start)[::stride, None])
        owners += [name] * len(shares)
    return np.concatenate(samples, axis=1), owners
