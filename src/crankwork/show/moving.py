"""A drawing that moves: what stands still, and parts that move as rigid bodies from frame to frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.kinematics.crank_grid import Array
from crankwork.show.scene import Box, Circle, Drawing, Hatch, Item, Polyline, Text, pen_of, placed, runs

# of a movement, what nobody sees: millimetres, degrees, millimetres of a stretch, shares of a tint
_UNSEEN = np.array([0.05, 0.05, 0.1, 0.05, 0.03])


class Part(NamedTuple):
    """Items that move together, in millimetres of a frame of their own; a row of each track is a frame of the film.

    What is stretched grows along the x axis of that frame; `tint` says how much of it is seen, from 0 to 1.
    """

    name: str
    items: tuple[Item, ...]
    shift: Array  # Where the origin of its frame is, shape (n, 2) [mm]
    turn: Array  # How far its x axis has turned anticlockwise, shape (n,) [deg]
    stretch: Array  # shape (n,) [-]
    tint: Array  # shape (n,) [-]

    @property
    def track(self) -> Array:
        """All that changes of it, shape (n, 5)."""
        return np.column_stack([self.shift, self.turn, self.stretch, self.tint])

    def at(self, frame: int) -> list[Item]:
        """Return its items as one frame shows them."""
        tint, stretch = float(self.tint[frame]), float(self.stretch[frame])
        if tint <= 0:
            return []
        where = self.shift[frame], float(self.turn[frame]), stretch
        return [_faded(placed(one, *where), tint) for one in self.items]


def part(
    name: str,
    items: Sequence[Item],
    shift: ArrayLike,
    turn: ArrayLike = 0.0,
    *,
    stretch: ArrayLike = 1.0,
    tint: ArrayLike = 1.0,
) -> Part:
    """Return a part whose tracks may be single values where they do not change; one of them at least has a length."""
    shift = np.atleast_2d(np.asarray(shift, dtype=float))
    alone = [np.atleast_1d(np.asarray(one, dtype=float)) for one in (turn, stretch, tint)]
    count = max(len(shift), *map(len, alone))
    tracks = [np.broadcast_to(one, (count,)) for one in alone]
    return Part(name, tuple(items), np.broadcast_to(shift, (count, 2)), *tracks)


class MovingDrawing(NamedTuple):
    """A film at equal times: its last frame is the first again, or, to and fro, where it began."""

    ground: Drawing  # What stands still, title, language and paper
    parts: tuple[Part, ...]  # Those behind first; a track of one row stands still
    angles: Array  # Crank angle of each frame, shape (n,) [deg]
    seconds: float  # Time of one passage through all frames [s]
    readouts: tuple[str, ...]  # What is written beneath at each frame but the last
    readout: tuple[float, float]  # Where its line ends [mm]
    rest: int = 0  # The frame that is shown where nothing moves
    turns: bool = True  # Whether the crank turns fully; it goes to and fro otherwise
    about: str = ""  # What it shows, in words
    views: tuple[tuple[str, Box], ...] = ()  # What may be looked at alone: name, and where it is on the paper
    choices: Mapping[str, str] = {}  # What may be left out: how names of its parts begin, in words

    @property
    def frames(self) -> int:
        """How many frames there are, the last one, which is the first, not counted."""
        return len(self.angles) - 1

    def still(self, frame: int | None = None) -> Drawing:
        """Return a frame as a drawing, the one that is shown at rest if none is named."""
        at = self.rest if frame is None else frame % self.frames
        shown = [item for one in self.parts for item in one.at(at if len(one.shift) > 1 else 0)]
        readout = Text(self.readout, self.readouts[at], anchor="end")
        return self.ground._replace(items=(*self.ground.items, *shown, readout))


def _faded(item: Item, tint: float) -> Item:
    """Return an item of which a share is seen, on ground."""
    if tint >= 1 or isinstance(item, Hatch):
        return item
    if isinstance(item, Text):
        return item._replace(grey=1 - tint * (1 - item.grey))
    pen = pen_of(item.kind)
    if isinstance(item, Polyline | Circle):
        item = item._replace(fill=None if item.fill is None else 1 - tint * (1 - item.fill))
        return item._replace(kind=pen._replace(grey=1 - tint * (1 - pen.grey)))
    return item


def kept(track: Array) -> list[int]:
    """Return the frames between which a track is straight, but for what nobody sees, array of shape (n, 5)."""
    values = track / _UNSEEN
    found, parts = {0, len(values) - 1}, [(0, len(values) - 1)]
    while parts:
        first, last = parts.pop()
        shares = (np.arange(first + 1, last) - first)[:, None] / max(last - first, 1)
        straight = values[first] + shares * (values[last] - values[first])
        apart = np.abs(values[first + 1 : last] - straight).max(axis=1, initial=0.0)
        if apart.size and apart.max() > 1:
            middle = first + 1 + int(np.argmax(apart))
            found.add(middle)
            parts += [(first, middle), (middle, last)]
    return sorted(found)


def data(drawing: MovingDrawing) -> dict[str, Any]:
    """Return a film as a page plays it: for each part `shift` [x, y], `turn`, `stretch` and `tint`, where they change.

    A list has a value for each frame, a number stands for all of them; lengths and angles as SVG counts them, downward
    and clockwise. A part is moved by `translate(x y) rotate(turn) scale(stretch 1)` and the opacity `tint`.
    """
    tracks = {}
    for one in drawing.parts:
        x, y = one.shift[:, 0], drawing.ground.height - one.shift[:, 1]
        every = {"x": (x, None), "y": (y, None), "turn": (-one.turn, 0.0)}
        every |= {"stretch": (one.stretch, 1.0), "tint": (one.tint, 1.0)}
        rounded = {key: (np.round(values, 2) + 0.0, usual) for key, (values, usual) in every.items()}
        tracks[one.name] = {
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
        "readouts": ["".join(run.text for run in runs(one)) for one in drawing.readouts],
        "parts": tracks,
    }
