"""Linkages of every kind that tests draw: of the catalog, and described link by link."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.dyads import point_on_link
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.mechanism.catalog import (
    crank_shaper,
    four_bar,
    scotch_yoke,
    stephenson_six_bar,
    toggle_press,
    watt_six_bar,
    whitworth,
)
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.dyads import PRP, RRR, Guide
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism, body_at
from crankwork.mechanism.table_reader import linkage_from


def mechanism_from(tables):
    """Return the mechanism that some tables describe, or every problem that is in them."""
    linkage, problems = linkage_from(tables)
    return (None, problems) if linkage is None else mechanism_of(linkage)


class At(NamedTuple):
    """A point in the frame of a link."""

    link: str
    along: float = 0.0
    across: float = 0.0

    def on(self, there):
        """Return its motion."""
        return point_on_link(there.frames[self.link], self.along, self.across)


def distance(point, other):
    """Return the distance of two points. [m]"""

    def coordinate(there):
        (x, x_1, _), (y, y_1, _) = (
            tuple(b - a for a, b in zip(mine, its, strict=True))
            for mine, its in zip(point.on(there), other.on(there), strict=True)
        )
        far = np.hypot(x, y)
        return Transfer(far, (x * x_1 + y * y_1) / far, np.zeros_like(far))

    return coordinate


SHAPER = {
    "fixed_points": {"O": [0.0, 0.0], "B": [0.0, -0.15]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.05, "start": np.pi / 2, "direction": "clockwise"},
    "links": {"lever": {"joins": ["B", "C"], "length": 0.3}, "link": {"joins": ["C", "D"], "length": 0.2}},
    "guides": {"slot": {"link": "lever"}, "bed": {"through": [0.0, 0.14]}},
    "sliders": {"block": {"pin": "A", "guide": "slot"}, "ram": {"pin": "D", "guide": "bed", "mass": 20.0}},
}

TRIAD = {
    "fixed_points": {"O": [0.0, 0.0], "E": [0.2, 0.5], "F": [0.26, 0.4]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.03},
    "positions": {"B": [0.15, 0.03], "C": [0.2, 0.1], "D": [0.2, -0.05]},
    "links": {
        "rod": {"joins": ["A", "B"]},
        "plate": {"joins": ["B", "C", "D"]},
        "arm": {"joins": ["C", "E"]},
        "leg": {"joins": ["D", "F"]},
    },
}

CARRIED = {
    "fixed_points": {"O": [0.0, 0.0], "B": [0.18, 0.0], "E": [0.0, 0.1]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
    "links": {"rod": {"joins": ["A", "C"], "length": 0.2}, "rocker": {"joins": ["B", "C"], "length": 0.12}},
    "guides": {"line": {"link": "rod", "angle": 0.4}, "slot": {"link": "yoke", "angle": 1.3}},
    "sliders": {"yoke": {"guide": "line"}, "block": {"pin": "E", "guide": "slot"}},
}


def slotted_press():
    """Return the press of a Russian course project: crank, rod, slotted rocker, block and punch.

    The document gives the lengths of crank, rod and rocker and a table of transfer functions, not the positions
    of the pivots: pivot distance, start in the outer dead position and line of the punch are those that fit
    the table best.

    Links `rod` and `rocker`, sliding pieces `block` and `punch`, masses of the document.
    """
    crank, rod, rocker, ground = 0.05, 0.6, 0.21, 0.632
    reach = rod + crank
    start = math.acos((reach**2 + ground**2 - rocker**2) / (2 * reach * ground))
    distance, normal = 0.2013, math.radians(100.4)
    foot = (ground + distance * math.cos(normal), distance * math.sin(normal))
    return Mechanism(
        Crank(crank, start=start, direction=-1),
        (
            RRR("crank_pin", "rocker_pivot", "rocker_pin", "rod", "rocker", rod, rocker),
            PRP("punch_pin", "block", "punch", Guide(link="rocker"), Guide(foot, normal - math.pi / 2)),
        ),
        bodies=(
            body_at("rod", 255.1, 7.653, "rod_centre"),
            body_at("block", 81.6, 0.0, "punch_pin"),
            body_at("punch", 102.0, 0.0, "punch_pin"),
            body_at("rocker", 153.1, 153.1 * rocker**2 / 12, "rocker_centre"),
        ),
        ground={"rocker_pivot": (ground, 0.0)},
        points=(LinkPoint("rod_centre", "rod", rod / 2), LinkPoint("rocker_centre", "rocker", rocker / 2)),
    )


FIRST = four_bar(0.05, 0.2, 0.12, 0.18)

LINKAGES = {
    "four-bar": four_bar(0.05, 0.2, 0.12, 0.18, coupler_point=(0.1, 0.06)),
    "watt": watt_six_bar(FIRST, (0.08, 0.05), 0.2, 0.15, (0.4, 0.0)),
    "stephenson": stephenson_six_bar(FIRST, (0.1, 0.05), 0.25, 0.15, (0.25, 0.2)),
    "shaper": crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14),
    "whitworth": whitworth(0.05, 0.02, 0.06, 0.3, 0.01),
    "scotch yoke": scotch_yoke(0.05, 1.1),
    "toggle": toggle_press(0.05, 0.3, 0.2, 0.2, (0.35, 0.2)),
    "slotted press": slotted_press(),
    "described shaper": mechanism_from(SHAPER)[0],
    "class III": mechanism_from(TRIAD)[0],
    "carried yoke": mechanism_from(CARRIED)[0],
}
