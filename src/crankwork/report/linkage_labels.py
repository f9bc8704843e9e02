"""Where the letters and numbers of a drawn linkage go: beside what they name, clear of the rest at every angle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.report.linkage_scene import SLOT, Scene

_TURNS = np.radians([45, 135, 315, 225, 90, 0, 180, 270, 20, 70, 110, 160, 200, 250, 290, 340])
_AROUND = np.column_stack([np.cos(_TURNS), np.sin(_TURNS)])
_REACHES = (15.0, 19.0, 24.0, 30.0)
_EVERY = 3
_STEP = 7.0


class Label(NamedTuple):
    """A text whose middle follows places, array of shape (n, 2); y upwards."""

    text: str
    places: Array
    is_number: bool

    @property
    def half(self) -> Array:
        """Half its width and height. [px]"""
        return np.array([4.4 * len(self.text) + 1.5, 6.5])


def labels(drawn: Scene, fixed: Sequence[Array] = (), *, every: int = _EVERY) -> list[Label]:
    """Return the names of points and the numbers of links."""
    obstacles = _samples(drawn, every)
    still = np.vstack([*fixed, np.zeros((0, 2))])
    count = obstacles.shape[0]
    obstacles = np.concatenate([obstacles, np.broadcast_to(still, (count, *still.shape))], axis=1)
    seen = np.ascontiguousarray(obstacles[..., 0]), np.ascontiguousarray(obstacles[..., 1])
    placed: list[Label] = []
    # without pivots there is no place for the number of the ground
    for text, is_number, ways in (one for one in _wanted(drawn) if one[2]):
        placed.append(_cheapest([(Label(text, place, is_number), extra) for place, extra in ways], seen, placed, every))
    return placed


def _cheapest(
    ways: Sequence[tuple[Label, float]], obstacles: tuple[Array, Array], placed: Sequence[Label], every: int
) -> Label:
    """Return the label that costs least; one that costs more at least than another does is not looked at."""
    best, found = np.inf, 0
    obstacles = _reachable([label for label, _ in ways], obstacles, every)
    names = np.array([one.places[::every] for one in placed]), np.array([[one.half] for one in placed])
    for at in sorted(range(len(ways)), key=lambda one: ways[one][1]):
        label, extra = ways[at]
        if extra > best:
            break
        cost = _cost(label, extra, obstacles, names, every)
        best, found = min((best, found), (cost, at))
    return ways[found][0]


def _reachable(ways: Sequence[Label], obstacles: tuple[Array, Array], every: int) -> tuple[Array, Array]:
    """Return the obstacles that a label could cover at one place or another."""
    places = np.array([one.places[::every] for one in ways])
    half = np.max([one.half for one in ways], axis=0)
    low, high = places.min(axis=0) - half, places.max(axis=0) + half
    x, y = obstacles
    near = (x > low[:, :1]) & (x < high[:, :1]) & (y > low[:, 1:]) & (y < high[:, 1:])
    kept = near.any(axis=0)
    return np.ascontiguousarray(x[:, kept]), np.ascontiguousarray(y[:, kept])


def _cost(label: Label, extra: float, obstacles: tuple[Array, Array], names: tuple[Array, Array], every: int) -> float:
    centre, half = label.places[::every, None], label.half
    near = [np.abs(one - centre[..., axis]) < half[axis] for axis, one in enumerate(obstacles)]
    cost = extra + 10.0 * float(np.count_nonzero(near[0] & near[1])) / len(centre)
    middles, halves = names
    if len(middles):
        covered = np.all(np.abs(middles - label.places[::every]) < half + halves + (7.0, 1.0), axis=2)
        cost += 60.0 * float(covered.mean(axis=1).sum())
    return cost


def _wanted(drawn: Scene) -> Iterator[tuple[str, bool, list[tuple[Array, float]]]]:
    """Yield each text with the places where it could go, and what each of them costs at least."""
    shape = drawn.skeleton
    seen: set[str] = set()
    for name, letter in shape.letters.items():
        if name in drawn.points and letter not in seen:
            seen.add(letter)
            wide = 4.4 * (len(letter) - 1)
            yield (
                letter,
                False,
                [
                    (drawn.points[name] + (reach + wide * abs(way[0])) * way, 0.4 * (reach - 15) + 0.2 * rank)
                    for reach in _REACHES
                    for rank, way in enumerate(_AROUND)
                ],
            )
    spots = [(side * x, -y) for x, y in ((32, 24), (30, 12), (36, 36), (12, 46)) for side in (1, -1)]
    yield (
        "0",
        True,
        [(drawn.points[name] + spot, 3.0 * rank) for rank, name in enumerate(shape.pivots) for spot in spots],
    )
    for one in shape.members:
        yield str(one.number), True, list(_number_ways(drawn, one.name))


def _number_ways(drawn: Scene, name: str) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a link or block, and what each of them costs at least."""
    for block in (one for one in drawn.blocks if one.name == name):
        ways = product((10, 18, 26), (-0.6, 0.0, 0.6, -1.3, 1.3), (1, -1))
        for reach, share, side in ways:
            yield block.pose.place(share * block.half[0], side * (block.half[1] + reach)), 0.3 * reach
    for slot in (one for one in drawn.slots if one.carrier == name):
        for share, side in product((0.2, 0.5, 0.8), (1, -1)):
            yield slot.line.place(slot.start + share * (slot.end - slot.start), side * (SLOT + 10)), 6.0
    for bar in (one for one in drawn.bars if one.name == name):
        if not bar.is_flat:
            yield np.asarray(np.mean(bar.nodes, axis=0)), -20.0
        for start, end in _edges(bar.nodes, is_flat=bar.is_flat):
            yield from _beside(start, end)


def _beside(start: Array, end: Array) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a line, its middle first."""
    along = end - start
    left = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    for share, side in product((0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8), (1, -1)):
        yield start + share * along + side * 13 * left, 8 * abs(share - 0.5)


def _edges(nodes: Sequence[Array], *, is_flat: bool) -> Iterator[tuple[Array, Array]]:
    yield from pairwise(nodes)
    if not is_flat:
        yield nodes[-1], nodes[0]


def _samples(drawn: Scene, every: int) -> Array:
    """Return places on everything that is drawn, shape (frames, k, 2)."""
    lines = [edge for bar in drawn.bars for edge in _edges(bar.nodes, is_flat=bar.is_flat)]
    for slot in drawn.slots:
        sides = (SLOT, -SLOT)
        lines += [(slot.line.place(slot.start, side), slot.line.place(slot.end, side)) for side in sides]
    for block in drawn.blocks:
        u, v = block.half
        lines += [(block.pose.place(-u, side), block.pose.place(u, side)) for side in (v, 0.0, -v)]
    for rail in drawn.rails:
        for side in (rail.half, rail.half + 6, -rail.half, -rail.half - 6):
            lines.append((rail.line.place(rail.start, side), rail.line.place(rail.end, side)))
    for at in (place for name, place in drawn.points.items() if name in drawn.skeleton.pivots):
        lines += [(at, np.add(at, foot)) for foot in ((-13.0, -24.0), (13.0, -24.0))]
        lines += [(np.add(at, (-26.0, drop)), np.add(at, (20.0, drop))) for drop in (-24.0, -31.0)]
    found = [place[::every, None] for place in drawn.points.values()]
    for start, end in lines:
        length = float(np.max(np.hypot(*(end - start).T)))
        shares = np.linspace(0, 1, max(2, int(length / _STEP)))[:, None]
        found.append(start[::every, None] + shares * (end - start)[::every, None])
    return np.concatenate(found, axis=1)
