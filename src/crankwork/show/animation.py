"""Animations: a static drawing, and parts that move as rigid bodies from frame to frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.kinematics.crank_grid import Array
from crankwork.show.scene import ChartBox, Circle, Drawing, Hatch, Item, Polyline, Text, pen_of, runs, use_layout

# invisible deviations: millimetres, millimetres, degrees, scale, tint
_INVISIBLE_DEVIATIONS = np.array([0.05, 0.05, 0.1, 0.05, 0.03])


class Part(NamedTuple):
    """Items that move together, in millimetres of their own coordinates; a row of each track is a frame.

    `stretch` scales the x axis of these coordinates; `tint` is the visible share, from 0 to 1.
    """

    name: str
    items: tuple[Item, ...]
    shift: Array  # Position of the origin, shape (n, 2) [mm]
    turn: Array  # Rotation of the x axis, anticlockwise, shape (n,) [deg]
    stretch: Array  # shape (n,) [-]
    tint: Array  # shape (n,) [-]

    @property
    def track(self) -> Array:
        """All tracks, shape (n, 5)."""
        return np.column_stack([self.shift, self.turn, self.stretch, self.tint])

    def at(self, frame: int) -> list[Item]:
        """Return its items in one frame."""
        tint, stretch = float(self.tint[frame]), float(self.stretch[frame])
        if tint <= 0:
            return []
        position = self.shift[frame], float(self.turn[frame]), stretch
        return [_faded(use_layout(item, *position), tint) for item in self.items]


def part(
    name: str,
    items: Sequence[Item],
    shift: ArrayLike,
    turn: ArrayLike = 0.0,
    *,
    stretch: ArrayLike = 1.0,
    tint: ArrayLike = 1.0,
) -> Part:
    """Return a part; tracks that do not change may be single values, but at least one has a length."""
    shift = np.atleast_2d(np.asarray(shift, dtype=float))
    scalars = [np.atleast_1d(np.asarray(track, dtype=float)) for track in (turn, stretch, tint)]
    count = max(len(shift), *map(len, scalars))
    tracks = [np.broadcast_to(track, (count,)) for track in scalars]
    return Part(name, tuple(items), np.broadcast_to(shift, (count, 2)), *tracks)


class Animation(NamedTuple):
    """Frames at equal times: the last frame is the first again, or the start of a movement to and fro."""

    ground: Drawing  # Static items, title, language and paper
    parts: tuple[Part, ...]  # Parts from the back to the front; a track of one row is static
    angles: Array  # Crank angle of each frame, shape (n,) [deg]
    seconds: float  # Duration of all frames [s]
    readouts: tuple[str, ...]  # Text below each frame but the last
    readout: tuple[float, float]  # Right end of its line [mm]
    rest: int = 0  # The frame that is shown at rest
    turns: bool = True  # Whether the crank turns fully; otherwise it moves to and fro
    about: str = ""  # Alternative text
    views: tuple[tuple[str, ChartBox], ...] = ()  # Details: name, and box on the paper
    choices: Mapping[str, str] = {}  # Optional parts: prefix of their names, and text
    covered: ChartBox | None = None  # What it covers with these, where the paper is smaller [mm]

    @property
    def frames(self) -> int:
        """Number of frames, without the last one, which is the first again."""
        return len(self.angles) - 1

    def still(self, frame: int | None = None) -> Drawing:
        """Return a frame as a drawing, by default the one at rest."""
        index = self.rest if frame is None else frame % self.frames
        shown = [item for moving in self.parts for item in moving.at(index if len(moving.shift) > 1 else 0)]
        readout = Text(self.readout, self.readouts[index], anchor="end")
        return self.ground._replace(items=(*self.ground.items, *shown, readout))


def _faded(item: Item, tint: float) -> Item:
    """Return an item blended with the ground."""
    if tint >= 1 or isinstance(item, Hatch):
        return item
    if isinstance(item, Text):
        return item._replace(grey=1 - tint * (1 - item.grey))
    pen = pen_of(item.kind)
    if isinstance(item, Polyline | Circle):
        item = item._replace(fill=None if item.fill is None else 1 - tint * (1 - item.fill))
        return item._replace(kind=pen._replace(grey=1 - tint * (1 - pen.grey)))
    return item


def keyframes(track: Array) -> list[int]:
    """Return the frames between which a track is linear within invisible deviations, array of shape (n, 5)."""
    values = track / _INVISIBLE_DEVIATIONS
    frames, intervals = {0, len(values) - 1}, [(0, len(values) - 1)]
    while intervals:
        first, last = intervals.pop()
        shares = (np.arange(first + 1, last) - first)[:, None] / max(last - first, 1)
        straight = values[first] + shares * (values[last] - values[first])
        deviation = np.abs(values[first + 1 : last] - straight).max(axis=1, initial=0.0)
        if deviation.size and deviation.max() > 1:
            middle = first + 1 + int(np.argmax(deviation))
            frames.add(middle)
            intervals += [(first, middle), (middle, last)]
    return sorted(frames)


def data(drawing: Animation) -> dict[str, Any]:
    """Return an animation as data of a page: `shift` [x, y], `turn`, `stretch` and `tint` of each part, if they change.

    A list has a value for each frame, a number holds for all of them; lengths and angles as in SVG, downward and
    clockwise. A part is moved by `translate(x y) rotate(turn) scale(stretch 1)` and the opacity `tint`.
    """
    tracks = {}
    for moving in drawing.parts:
        x, y = moving.shift[:, 0], drawing.ground.height - moving.shift[:, 1]
        columns = {"x": (x, None), "y": (y, None), "turn": (-moving.turn, 0.0)}
        columns |= {"stretch": (moving.stretch, 1.0), "tint": (moving.tint, 1.0)}
        rounded = {key: (np.round(values, 2) + 0.0, usual) for key, (values, usual) in columns.items()}
        tracks[moving.name] = {
            key: float(values[0]) if np.all(values == values[0]) else values.tolist()
            for key, (values, usual) in rounded.items()
            if usual is None or np.any(values != usual)
        }
    return {
        "frames": drawing.frames,
        "seconds": drawing.seconds,
        "turns": drawing.turns,
        "rest": drawing.rest,
        "angles": np.round(drawing.angles, 3).tolist(),
        "readouts": ["".join(run.text for run in runs(readout)) for readout in drawing.readouts],
        "parts": tracks,
    }
