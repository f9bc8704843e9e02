"""The resistance of the process: cutting, pressing, pumping, against the stroke of a piece or the crank angle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import AppliedLoads, check_name, force_along_guide, force_at, torque_on
from crankwork.loads.table import Curve
from crankwork.mechanism.dyads import Branch
from crankwork.mechanism.mechanism import Mechanism

# share of the largest speed below which a piece counts as at rest
_REST = 1e-12


@dataclass(frozen=True)
class ProcessForce:
    """A force against the working stroke of a sliding piece, along its guide.

    Parameters
    ----------
    slider : str
        The sliding piece.
    force : callable
        Force, positive against the forward stroke, at the stroke or the crank angle; a `Table` is one. [N]
    against : {"stroke", "angle"}
        What `force` is given by: the way from `start`, or the crank angle. [m], [rad]
    forward : {1, -1}
        1 if the distance of the piece along its guide grows on the working stroke, -1 if it falls.
    start : float
        That distance where the working stroke begins. [m]
    acts : {"forward", "both"}
        On the working stroke only, or on the way back too, with the same direction.
    """

    slider: str
    force: Curve
    against: Literal["stroke", "angle"] = "stroke"
    forward: Branch = 1
    start: float = 0.0
    acts: Literal["forward", "both"] = "forward"


@dataclass(frozen=True)
class ProcessForceAtPoint:
    """A force of fixed direction at a point, against its way in the opposite direction.

    Parameters
    ----------
    point : str
        Where it acts.
    direction : float
        Direction of the working stroke from the x axis; a positive force acts the other way. [rad]
    force : callable
        Force at the stroke or the crank angle. [N]
    against : {"stroke", "angle"}
        What `force` is given by: the way of the point in that direction, or the crank angle. [m], [rad]
    start : float
        Coordinate of the point in that direction where the working stroke begins. [m]
    acts : {"forward", "both"}
        On the working stroke only, or always.
    link : str
        The link it acts on; empty for the first one of those that meet there.
    """

    point: str
    direction: float
    force: Curve
    against: Literal["stroke", "angle"] = "stroke"
    start: float = 0.0
    acts: Literal["forward", "both"] = "forward"
    link: str = ""


@dataclass(frozen=True)
class ForceOnPoint:
    """A constant force at a point.

    Parameters
    ----------
    point : str
        Where it acts.
    x, y : float
        Its components along the fixed axes. [N]
    link : str
        The link it acts on; empty for the first one of those that meet there.
    """

    point: str
    x: float
    y: float
    link: str = ""


@dataclass(frozen=True)
class TorqueOnLink:
    """A torque on a link, constant or by the crank angle.

    Parameters
    ----------
    link : str
        The link.
    torque : float or callable
        Positive anticlockwise; a callable takes the crank angle in radians. [N m]
    """

    link: str
    torque: float | Curve


class _Way(NamedTuple):
    """How far a piece or point has come on its forward stroke, and its speed there. [m], [m]"""

    position: Array
    position_1: Array


def process_force(load: ProcessForce, motion: Motion) -> AppliedLoads:
    """Return the force of a process on a sliding piece.

    Parameters
    ----------
    load : ProcessForce
        The process.
    motion : Motion
        Where the piece is.
    """
    check_name("sliding piece", load.slider, motion.sliders)
    slide = motion.sliders[load.slider]
    way = _Way(load.forward * (slide.position - load.start), load.forward * slide.position_1)
    return AppliedLoads((force_along_guide(motion, load.slider, -load.forward * _force(load, way, motion)),))


def process_force_at_point(load: ProcessForceAtPoint, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return the force of a process at a point.

    Parameters
    ----------
    load : ProcessForceAtPoint
        The process.
    mechanism : Mechanism
        Whose point it is.
    motion : Motion
        Where the point is.
    """
    check_name("point", load.point, motion.points)
    x, y = motion.points[load.point]
    cos, sin = np.cos(load.direction), np.sin(load.direction)
    way = _Way(x.position * cos + y.position * sin - load.start, x.position_1 * cos + y.position_1 * sin)
    force = -_force(load, way, motion)
    return force_at(mechanism, motion, load.point, (force * cos, force * sin), load.link)


def _force(load: ProcessForce | ProcessForceAtPoint, way: _Way, motion: Motion) -> Array:
    force = np.asarray(load.force(way.position if load.against == "stroke" else motion.grid.angle), dtype=float)
    if load.acts == "both":
        return force
    forward = way.position_1 >= -_REST * np.max(np.abs(way.position_1))
    return np.where(forward, force, 0.0)


def constant_force(load: ForceOnPoint, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return a constant force at a point.

    Parameters
    ----------
    load : ForceOnPoint
        The force.
    mechanism : Mechanism
        Whose point it is.
    motion : Motion
        Where the point is.
    """
    return force_at(mechanism, motion, load.point, (np.array(load.x), np.array(load.y)), load.link)


def link_torque(load: TorqueOnLink, motion: Motion) -> AppliedLoads:
    """Return a torque on a link.

    Parameters
    ----------
    load : TorqueOnLink
        The torque.
    motion : Motion
        How the link turns.
    """
    torque = load.torque(motion.grid.angle) if callable(load.torque) else np.array(load.torque)
    return torque_on(motion, load.link, torque)
