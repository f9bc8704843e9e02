"""How the joints of a drawn linkage follow columns, and what stands upon them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.show.moving import MovingDrawing, Part
from crankwork.show.scene import Polyline, placed

# millimetres that nobody sees
_UNSEEN = 0.05
# frames at which it is looked what stands upon what
_LOOKED = (0, 7, 19, 31)


def joints_of(films: Sequence[MovingDrawing], results: Sequence[Results]) -> dict[str, Any] | None:
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

    def __init__(self, film: MovingDrawing, results: Results) -> None:
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


def _track(part: Part, film: MovingDrawing) -> Array:
    """Return where a part is in all frames, shape (n, 2). [mm]"""
    return np.asarray(np.broadcast_to(part.shift, (len(film.angles), 2)))


def _upon(part: Part, film: MovingDrawing, joints: Mapping[str, Array]) -> list[str] | None:
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
