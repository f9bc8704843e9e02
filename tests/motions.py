"""Motions as tests compare them, and tables of linkages with a change."""

from __future__ import annotations

import pytest

from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_motion


def changed(tables, key, value):
    """Return the tables with one entry, at a dotted key, put in or (with None) taken out."""
    head, _, rest = key.partition(".")
    table = dict(tables)
    if rest:
        table[head] = changed(table.get(head, {}), rest, value)
    elif value is None:
        table.pop(head)
    else:
        table[head] = value
    return table


def coordinates(motion):
    """Return every coordinate of a motion with its derivatives."""
    found = {}
    for name, point in motion.points.items():
        for axis, side in zip("xy", point, strict=True):
            found |= {("point", name, axis, order): one for order, one in enumerate(side)}
    for kind, moved in (("link", motion.links), ("slider", motion.sliders)):
        for name, one in moved.items():
            found |= {(kind, name, order): value for order, value in enumerate(one)}
    return found


def traced(mechanism, grid):
    """Return the coordinates of a mechanism at some angles as they are remembered of a whole turn, and as computed."""
    motion = traced_motion(mechanism, linkage_motion(mechanism, CrankGrid.steps(1.0, 360.0)))
    return Program(coordinates(motion))(grid), coordinates(linkage_motion(mechanism, grid))


def not_alike(found, expected, **within):
    """Return the names of values that are not as expected."""
    return [key for key, value in expected.items() if found[key] != pytest.approx(value + 0 * found[key], **within)]
