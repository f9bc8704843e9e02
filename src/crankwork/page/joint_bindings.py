"""Joints that drawings of linkages follow, in animations and superimposed positions."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.quantities.key import key_of
from crankwork.show.animation import Animation, Part
from crankwork.show.canvas import GREY
from crankwork.show.scene import Circle, Drawing, Item, Plot, Polyline, Text, pen_of, use_layout

# invisible distance [mm]
_UNSEEN = 0.05
# frames in which parts are matched with joints
_PROBE_FRAMES = (0, 7, 19, 31)
# step of the crank angles of superimposed positions [deg]; distance of a label from its joint, and tolerance of it [mm]
_PLANNED, _NEAR, _STRAY = 2.0, 15.0, 0.5


def joints_of(films: Sequence[Animation], results: Sequence[Results]) -> dict[str, Any] | None:
    """Return scale and origin of an animation, columns of its joints, and the joints of links and labels.

    None if links are more than lines between joints, or joints do not follow columns in every design.
    """
    scales = [_Scale(film, result) for film, result in zip(films, results, strict=True)]
    stated, film = scales[0], films[0]
    if not all(scale.is_exact for scale in scales):
        return None
    for name in stated.fixed:
        places = np.array([scale.fixed[name] for scale in scales if name in scale.fixed])
        if len(places) < len(scales) or np.max(np.ptp(places, axis=0)) * stated.scale > _UNSEEN:
            return None
    tracks = {part.name: _track(part, film) for part in film.parts if part.name.startswith("joint.")}
    links, labels = dict[str, list[str]](), dict[str, list[Any]]()
    for part in film.parts:
        kind = key_of(part.name).quantity
        if kind == "link":
            corners = _corner_joints(part, film, tracks)
            if corners is None:
                return None
            links[part.name] = corners
        elif kind == "text":
            offset = _label_offset(_track(part, film), tracks)
            labels |= {part.name: offset} if offset else {}
        elif kind not in ("joint", "force"):
            return None
    origin = [stated.origin[0], film.ground.height - stated.origin[1]]
    return {"scale": stated.scale, "origin": origin, "joints": stated.keys, "links": links, "labels": labels}


class _Scale:
    """Transformation from metres to the paper of an animation: scale [mm/m], origin [mm], and fixed joints [m]."""

    def __init__(self, film: Animation, results: Results) -> None:
        joints = [part for part in film.parts if part.name.startswith("joint.")]
        names = {part.name: part.name.removeprefix("joint.") for part in joints}
        self.keys = {
            part: [f"point_x.{name}", f"point_y.{name}"] for part, name in names.items() if f"point_x.{name}" in results
        }
        columns = results.columns_at(film.angles, [key for pair in self.keys.values() for key in pair])
        moving = [part for part in joints if part.name in self.keys]
        self.scale, self.origin, self.is_exact = 1.0, (0.0, 0.0), False
        self.fixed: dict[str, Array] = {}
        if not moving:
            return
        paper = np.concatenate([_track(part, film) for part in moving])
        positions = np.concatenate([np.column_stack([columns[key] for key in self.keys[part.name]]) for part in moving])
        spread = positions - positions.mean(axis=0)
        self.scale = float(np.sum(spread * (paper - paper.mean(axis=0))) / np.sum(spread**2))
        origin = paper.mean(axis=0) - self.scale * positions.mean(axis=0)
        self.origin = float(origin[0]), float(origin[1])
        self.is_exact = bool(np.max(np.abs(paper - self.scale * positions - origin)) <= _UNSEEN)
        still = [part for part in joints if part.name not in self.keys]
        self.fixed = {part.name: (_track(part, film)[0] - origin) / self.scale for part in still}


def _track(part: Part, film: Animation) -> Array:
    """Return the position of a part in all frames, shape (n, 2). [mm]"""
    return np.asarray(np.broadcast_to(part.shift, (len(film.angles), 2)))


def _corner_joints(part: Part, film: Animation, joints: Mapping[str, Array]) -> list[str] | None:
    """Return the joints at the corners of a link, None unless each corner is at one."""
    if len(part.items) != 1 or not isinstance(part.items[0], Polyline):
        return None
    frames = [frame for frame in _PROBE_FRAMES if frame < len(film.angles)]
    corners = []
    for frame in frames:
        row = frame if len(part.shift) > 1 else 0
        item = use_layout(part.items[0], part.shift[row], float(part.turn[row]), float(part.stretch[row]))
        corners.append(item.points if isinstance(item, Polyline) else np.zeros((0, 2)))
    names = []
    for corner in np.moveaxis(np.array(corners), 1, 0):
        near = [name for name, track in joints.items() if np.max(np.abs(track[frames] - corner)) <= _UNSEEN]
        if not near:
            return None
        names.append(near[0])
    return names


def _label_offset(track: Array, joints: Mapping[str, Array]) -> list[Any]:
    """Return the joint that a label follows, and its offset to the right and down; empty if there is none."""
    for name, joint in joints.items():
        offset = track - joint
        if np.max(np.ptp(offset, axis=0)) <= _UNSEEN:
            return [name, round(float(offset[0, 0]), 2), round(-float(offset[0, 1]), 2)]
    return []


def bind_to_joints(drawn: Sequence[Drawing], results: Sequence[Results]) -> tuple[list[str | None], dict[str, Any]]:
    """Return the marks of the items of superimposed positions, and the joints that these items follow.

    The mark is empty for an item that stays, `upon N` for one that follows, None for one that does neither. By N, the
    bindings give for the corners of a line, or for the one joint that an item keeps its distance to: columns of the
    position, crank angle, and stated position [mm].
    """
    plots = [drawing.plots[0] for drawing in drawn]
    stated = plots[0]
    if any(plot.metre != stated.metre for plot in plots):
        return [None] * len(drawn[0].items), {}
    places = _Places(results, [_origin(plot) for plot in plots], stated.metre)
    marks, bindings = list[str | None](), dict[str, Any]()
    for index, items in enumerate(_paired(drawn)):
        points = np.array([_points(item) for item in items])
        binding = places.of(points, is_offset=is_label(items[0])) if len(items) == len(drawn) else None
        marks.append(None if binding is None else f"upon {index}" if binding else "")
        if binding:
            bindings[str(index)] = [[*keys, degrees, *_shown(place, drawn[0])] for keys, degrees, place in binding]
    return marks, {"scale": stated.metre, "origin": _shown(places.origins[0], drawn[0]), "items": bindings}


def _paired(drawn: Sequence[Drawing]) -> Iterator[list[Item]]:
    """Yield each item of the first drawing with its counterparts in the others, alone if their number differs."""
    kinds = [[_kind(item) for item in drawing.items] for drawing in drawn]
    lists = [defaultdict[Any, list[Item]](list) for _ in drawn]
    for own, drawing, items_by_kind in zip(kinds, drawn, lists, strict=True):
        for kind, item in zip(own, drawing.items, strict=True):
            items_by_kind[kind].append(item)
    counted = Counter[Any]()
    for kind, item in zip(kinds[0], drawn[0].items, strict=True):
        groups = [items[kind] for items in lists]
        position, counted[kind] = counted[kind], counted[kind] + 1
        yield [group[position] for group in groups] if len({len(group) for group in groups}) == 1 else [item]


class _Places:
    """Positions of joints on the paper of each design, at the crank angles of superimposed positions."""

    def __init__(self, results: Sequence[Results], origins: Sequence[Array], metre: float) -> None:
        self.origins = np.array(origins)
        names = [key.removeprefix("point_x.") for key in results[0].trace if key.startswith("point_x.")]
        keys = [(f"point_x.{name}", f"point_y.{name}") for name in names]
        degrees = np.arange(0.0, results[0].machine.cycle, _PLANNED)
        self._known = [(pair, float(angle)) for pair in keys for angle in degrees]
        columns = [result.columns_at(degrees, [key for pair in keys for key in pair]) for result in results]
        positions = [
            np.column_stack([np.concatenate([values[pair[side]] for pair in keys]) for side in (0, 1)])
            for values in columns
        ]
        self._at = metre * np.array(positions) + self.origins[:, None]

    def of(self, points: Array, *, is_offset: bool) -> list[tuple[tuple[str, str], float, Array]] | None:
        """Return joint, crank angle and position for each corner, or for the joint an item keeps its distance to.

        Empty for an item that stays; `is_offset`: only the distance to one joint counts.
        """
        still = points - self.origins[:, None]
        if _are_same(points) or _are_same(still):
            return []
        bindings = []
        for corner, own in zip(np.moveaxis(points, 1, 0), np.moveaxis(still, 1, 0), strict=True):
            if _are_same(own):
                bindings.append((("", ""), 0.0, corner[0]))
                continue
            away = np.abs(self._at - corner[:, None]).max(axis=(0, 2))
            nearest = int(np.argmin(away))
            if away[nearest] > _UNSEEN:
                break
            bindings.append((*self._known[nearest], corner[0]))
        else:
            return bindings
        # a label, or a body that does not rotate
        relative = points - points[:, :1]
        if not is_offset and not _are_same(relative):
            return None
        offsets = points.mean(axis=1)[:, None] - self._at
        unsteady = np.ptp(offsets, axis=0).max(axis=1)
        distance = np.where(unsteady <= (_STRAY if is_offset else _UNSEEN), np.hypot(*offsets[0].T), np.inf)
        nearest = int(np.argmin(distance))
        return [(*self._known[nearest], self._at[0, nearest])] if distance[nearest] < _NEAR else None


def is_label(item: Item) -> bool:
    """Return whether an item is a label, its background, or its leader line."""
    if not isinstance(item, Polyline):
        return isinstance(item, Text)
    pen = pen_of(item.kind)
    return pen.colour == GREY or (item.fill == 1 and not pen.width)


def _origin(plot: Plot) -> Array:
    """Return the position of the origin of both scales. [mm]"""
    box = plot.box
    across, up = (-scale[0] / (scale[1] - scale[0]) for scale in (plot.x, plot.y))
    return np.array([box.left + across * box.width, box.bottom + up * box.height])


def _kind(item: Item) -> tuple[Any, ...]:
    """Return a key of an item without its position."""
    match item:
        case Polyline():
            return "line", len(item.points), item.kind, item.closed, item.fill
        case Circle():
            return "circle", round(item.radius, 3), item.kind, item.fill
        case Text():
            return "text", item.text, item.height, item.anchor
    return (type(item).__name__,)


def _points(item: Item) -> Array:
    match item:
        case Circle():
            return np.array([item.centre])
        case Text():
            return np.array([item.place])
        case Polyline():
            return item.points
    return np.full((1, 2), np.nan)


def _are_same(points: Array) -> bool:
    return bool(np.max(np.ptp(points, axis=0)) <= _UNSEEN)


def _shown(place: Array, drawing: Drawing) -> list[float]:
    """Return a position in SVG coordinates, y downward. [mm]"""
    return [round(float(place[0]), 2), round(drawing.height - float(place[1]), 2)]
