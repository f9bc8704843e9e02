"""How the joints of a drawn linkage follow columns, and what stands upon them: in a film, and in plans of positions."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.show.moving import Animation, Part
from crankwork.show.paper import GREY
from crankwork.show.scene import Circle, Drawing, Item, Plot, Polyline, Text, pen_of, placed

# millimetres that nobody sees
_UNSEEN = 0.05
# frames at which it is looked what stands upon what
_LOOKED = (0, 7, 19, 31)
# crank angles that plans show, whole multiples of it [deg]; how far from its joint a name may stand, and stray [mm]
_PLANNED, _NEAR, _STRAY = 2.0, 15.0, 0.5


def joints_of(films: Sequence[Animation], results: Sequence[Results]) -> dict[str, Any] | None:
    """Return scale and origin of a film, columns of its joints, and which of them links and labels stand upon.

    None where links are more than lines between joints, or joints do not follow columns in every design.
    """
    scales = [_Scale(film, one) for film, one in zip(films, results, strict=True)]
    stated, film = scales[0], films[0]
    if not all(one.is_exact for one in scales):
        return None
    for name in stated.fixed:
        places = np.array([one.fixed[name] for one in scales if name in one.fixed])
        if len(places) < len(scales) or np.max(np.ptp(places, axis=0)) * stated.scale > _UNSEEN:
            return None
    every = {one.name: _track(one, film) for one in film.parts if one.name.startswith("joint.")}
    links, labels = dict[str, list[str]](), dict[str, list[Any]]()
    for one in film.parts:
        kind = one.name.partition(".")[0]
        if kind == "link":
            upon = _upon(one, film, every)
            if upon is None:
                return None
            links[one.name] = upon
        elif kind == "text":
            beside = _beside(_track(one, film), every)
            labels |= {one.name: beside} if beside else {}
        elif kind not in ("joint", "force"):
            return None
    origin = [stated.origin[0], film.ground.height - stated.origin[1]]
    return {"scale": stated.scale, "origin": origin, "joints": stated.keys, "links": links, "labels": labels}


class _Scale:
    """How places in metres stand on the paper of a film: scale [mm/m], origin [mm], and joints that stand still [m]."""

    def __init__(self, film: Animation, results: Results) -> None:
        joints = [one for one in film.parts if one.name.startswith("joint.")]
        names = {one.name: one.name.removeprefix("joint.") for one in joints}
        self.keys = {
            part: [f"point_x.{name}", f"point_y.{name}"] for part, name in names.items() if f"point_x.{name}" in results
        }
        columns = results.columns_at(film.angles, [key for pair in self.keys.values() for key in pair])
        moving = [one for one in joints if one.name in self.keys]
        self.scale, self.origin, self.is_exact = 1.0, (0.0, 0.0), False
        self.fixed: dict[str, Array] = {}
        if not moving:
            return
        paper = np.concatenate([_track(one, film) for one in moving])
        at = np.concatenate([np.column_stack([columns[key] for key in self.keys[one.name]]) for one in moving])
        spread = at - at.mean(axis=0)
        self.scale = float(np.sum(spread * (paper - paper.mean(axis=0))) / np.sum(spread**2))
        origin = paper.mean(axis=0) - self.scale * at.mean(axis=0)
        self.origin = float(origin[0]), float(origin[1])
        self.is_exact = bool(np.max(np.abs(paper - self.scale * at - origin)) <= _UNSEEN)
        still = [one for one in joints if one.name not in self.keys]
        self.fixed = {one.name: (_track(one, film)[0] - origin) / self.scale for one in still}


def _track(part: Part, film: Animation) -> Array:
    """Return where a part is in all frames, shape (n, 2). [mm]"""
    return np.asarray(np.broadcast_to(part.shift, (len(film.angles), 2)))


def _upon(part: Part, film: Animation, joints: Mapping[str, Array]) -> list[str] | None:
    """Return the joints that the corners of a link are, if it is a line through joints."""
    if len(part.items) != 1 or not isinstance(part.items[0], Polyline):
        return None
    frames = [at for at in _LOOKED if at < len(film.angles)]
    corners = []
    for at in frames:
        row = at if len(part.shift) > 1 else 0
        item = placed(part.items[0], part.shift[row], float(part.turn[row]), float(part.stretch[row]))
        corners.append(item.points if isinstance(item, Polyline) else np.zeros((0, 2)))
    found = []
    for corner in np.moveaxis(np.array(corners), 1, 0):
        near = [name for name, track in joints.items() if np.max(np.abs(track[frames] - corner)) <= _UNSEEN]
        if not near:
            return None
        found.append(near[0])
    return found


def _beside(track: Array, joints: Mapping[str, Array]) -> list[Any]:
    """Return the joint that a label stays beside, and how far to the right and down."""
    for name, joint in joints.items():
        apart = track - joint
        if np.max(np.ptp(apart, axis=0)) <= _UNSEEN:
            return [name, round(float(apart[0, 0]), 2), round(-float(apart[0, 1]), 2)]
    return []


def upon_joints(drawn: Sequence[Drawing], results: Sequence[Results]) -> tuple[list[str | None], dict[str, Any]]:
    """Return what becomes of each item of a plan of positions, and how those follow that stand upon joints.

    An item is empty that stays, `upon N` where it follows, None where it does neither; told are, by N, the corners of a
    line, or the one joint that an item stays beside: columns of its place, crank angle, and where it stands now [mm].
    """
    plots = [one.plots[0] for one in drawn]
    stated = plots[0]
    if any(one.metre != stated.metre for one in plots):
        return [None] * len(drawn[0].items), {}
    places = _Places(results, [_origin(one) for one in plots], stated.metre)
    marks, told = list[str | None](), dict[str, Any]()
    for at, items in enumerate(_paired(drawn)):
        points = np.array([_points(one) for one in items])
        found = places.of(points, apart=is_label(items[0])) if len(items) == len(drawn) else None
        marks.append(None if found is None else f"upon {at}" if found else "")
        if found:
            told[str(at)] = [[*keys, degrees, *_shown(place, drawn[0])] for keys, degrees, place in found]
    return marks, {"scale": stated.metre, "origin": _shown(places.origins[0], drawn[0]), "items": told}


def _paired(drawn: Sequence[Drawing]) -> Iterator[list[Item]]:
    """Yield each item of the first drawing with those in its place in the others; alone where their number differs."""
    kinds = [[_kind(item) for item in one.items] for one in drawn]
    lists = [defaultdict[Any, list[Item]](list) for _ in drawn]
    for own, one, found in zip(kinds, drawn, lists, strict=True):
        for kind, item in zip(own, one.items, strict=True):
            found[kind].append(item)
    counted = Counter[Any]()
    for kind, item in zip(kinds[0], drawn[0].items, strict=True):
        every = [one[kind] for one in lists]
        at, counted[kind] = counted[kind], counted[kind] + 1
        yield [one[at] for one in every] if len({len(one) for one in every}) == 1 else [item]


class _Places:
    """Where joints stand on the paper of each of some designs, at the crank angles that plans show."""

    def __init__(self, results: Sequence[Results], origins: Sequence[Array], metre: float) -> None:
        self.origins = np.array(origins)
        names = [one.removeprefix("point_x.") for one in results[0].memory if one.startswith("point_x.")]
        keys = [(f"point_x.{one}", f"point_y.{one}") for one in names]
        degrees = np.arange(0.0, results[0].machine.cycle, _PLANNED)
        self._known = [(pair, float(one)) for pair in keys for one in degrees]
        columns = [one.columns_at(degrees, [key for pair in keys for key in pair]) for one in results]
        at = [
            np.column_stack([np.concatenate([one[pair[side]] for pair in keys]) for side in (0, 1)]) for one in columns
        ]
        self._at = metre * np.array(at) + self.origins[:, None]

    def of(self, points: Array, *, apart: bool) -> list[tuple[tuple[str, str], float, Array]] | None:
        """Return for each corner its joint, crank angle and place, of what stays `apart` from a joint those of that.

        Nothing is told of what stands still.
        """
        still = points - self.origins[:, None]
        if _are_same(points) or _are_same(still):
            return []
        found = []
        for corner, own in zip(np.moveaxis(points, 1, 0), np.moveaxis(still, 1, 0), strict=True):
            if _are_same(own):
                found.append((("", ""), 0.0, corner[0]))
                continue
            away = np.abs(self._at - corner[:, None]).max(axis=(0, 2))
            nearest = int(np.argmin(away))
            if away[nearest] > _UNSEEN:
                break
            found.append((*self._known[nearest], corner[0]))
        else:
            return found
        # a label, or a body that is not turned
        beside = points - points[:, :1]
        if not apart and not _are_same(beside):
            return None
        ways = points.mean(axis=1)[:, None] - self._at
        unsteady = np.ptp(ways, axis=0).max(axis=1)
        distance = np.where(unsteady <= (_STRAY if apart else _UNSEEN), np.hypot(*ways[0].T), np.inf)
        nearest = int(np.argmin(distance))
        return [(*self._known[nearest], self._at[0, nearest])] if distance[nearest] < _NEAR else None


def is_label(item: Item) -> bool:
    """Return whether an item is a name, clears the ground for one, or leads to one."""
    if not isinstance(item, Polyline):
        return isinstance(item, Text)
    pen = pen_of(item.kind)
    return pen.colour == GREY or (item.fill == 1 and not pen.width)


def _origin(plot: Plot) -> Array:
    """Return where the zero of both scales stands. [mm]"""
    box = plot.box
    across, up = (-one[0] / (one[1] - one[0]) for one in (plot.x, plot.y))
    return np.array([box.left + across * box.width, box.bottom + up * box.height])


def _kind(item: Item) -> tuple[Any, ...]:
    """Return what an item is but for its place."""
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
    """Return a place as SVG counts, downward. [mm]"""
    return [round(float(place[0]), 2), round(drawing.height - float(place[1]), 2)]
