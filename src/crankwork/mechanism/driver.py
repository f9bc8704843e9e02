"""What drives a mechanism, and the law by which its coordinate changes over one period."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

LawKind = Literal[
    "constant", "parabolic", "trapezoidal", "modified-trapezoidal", "cubic", "3-4-5", "4-5-6-7", "harmonic",
    "cycloidal", "modified-sine", "dwell", "table",
]  # fmt: skip


@dataclass(frozen=True)
class Segment:
    """A rise, a return or a rest of the coordinate."""

    kind: LawKind  # How it moves
    to: float  # The coordinate at its end [m] or [rad]
    share: float  # Its part of the period [-]
    ramp: float = 1 / 3  # Of a trapezoidal velocity, the part of the segment that each ramp takes [-]
    # Of a table, shares of the segment between 0 and 1, and the coordinate there [-], [m] or [rad]
    points: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class Law:
    """The coordinate of a driver over one period, segment after segment."""

    segments: tuple[Segment, ...]
    period: float  # [s]
    start: float  # The coordinate at time zero [m] or [rad]

    @property
    def returns(self) -> bool:
        """Whether the coordinate ends where it began."""
        return self.segments[-1].to == self.start
