"""The resistance of the process: cutting, pressing, pumping, against the stroke of a piece or the crank angle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.known import Known, Pieces, absent, given, is_known, named
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.memory import angle_of, interpolant_of
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import AppliedLoads, check_name, force_along_guide, force_at, torque_on
from crankwork.loads.remembered import curve_over_angle, curve_over_column
from crankwork.loads.table import Curve
from crankwork.mechanism.dyads import Branch
from crankwork.mechanism.mechanism import Mechanism

# share of the largest speed below which a piece is at rest, and the angle that it takes to reach that [deg]
_REST = 1e-12
_AT_REST = 1e-11
_DECIMALS = 9


@dataclass(frozen=True)
class ProcessForce:
    """A force against the working stroke of a sliding piece, along its guide."""

    slider: str  # The sliding piece
    force: Curve  # Force, positive against the forward stroke, at the stroke or the crank angle; a `Table` is one [N]
    # Argument of `force`: distance from `start`, or crank angle [m], [rad]
    against: Literal["stroke", "angle"] = "stroke"
    forward: Branch = 1  # 1 if the distance of the piece along its guide grows on the working stroke, -1 if it falls
    start: float = 0.0  # That distance where the working stroke begins [m]
    # On the working stroke only, or on the return stroke too, with the same direction
    acts: Literal["forward", "both"] = "forward"


@dataclass(frozen=True)
class ForceOnPoint:
    """A constant force at a point."""

    point: str  # Where it acts
    # Its components along the fixed axes [N]
    x: float
    y: float
    link: str = ""  # The link it acts on; empty for the first of the links that meet there


@dataclass(frozen=True)
class TorqueOnLink:
    """A torque on a link, constant or by the crank angle."""

    link: str
    torque: float | Curve  # Positive anticlockwise; a callable takes the crank angle in radians [N m]


class _Travel(NamedTuple):
    """Distance of a piece from the start of its working stroke, and its derivative. [m], [m]"""

    position: Value
    position_1: Value


def process_force(load: ProcessForce, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the force of a process on a sliding piece."""
    check_name("sliding piece", load.slider, motion.sliders)
    slide = motion.sliders[load.slider]
    start: Value = load.start
    if is_known(slide.position):
        start = given(f"slider_displacement.{load.slider}.start", start, f"{path}.start")
    # a rate with the sign of the velocity: the driver's coordinate may decrease
    rate = slide.position_1 if motion.driver is None else slide.position_1 * motion.driver.position_1
    travel = slide.position - start, rate
    travel = _Travel(*(travel if load.forward == 1 else (-travel[0], -travel[1])))
    force = _force(load, travel, motion, (load.slider, path))
    return AppliedLoads((force_along_guide(motion, load.slider, -force if load.forward == 1 else force),))


def _force(load: ProcessForce, travel: _Travel, motion: Motion, named_at: tuple[str, str]) -> Value:
    if is_known(travel.position):
        return _remembered(load, travel, motion, *named_at)
    force = np.asarray(load.force(travel.position if load.against == "stroke" else motion.grid.angle), dtype=float)
    if load.acts == "both":
        return force
    return np.where(travel.position_1 >= -_REST * np.max(np.abs(travel.position_1)), force, 0.0)


def _remembered(load: ProcessForce, travel: _Travel, motion: Motion, name: str, path: str) -> Known:
    """Return the force as a curve over travel or crank angle, piecewise if it acts on the working stroke only."""
    key, interpolator = f"process_force.{name}", interpolant_of(motion.grid)
    travel = travel._replace(position=named(travel.position, f"working_stroke.{name}"))
    columns = {"travel": travel.position} if load.against == "stroke" else {}
    over = interpolator(columns if load.acts == "both" else {**columns, "rate": travel.position_1})
    if load.against == "stroke":
        force = curve_over_column(load.force, over, "travel", key, f"{path}.force")
    else:
        force = curve_over_angle(load.force, angle_of(motion.grid), key, f"{path}.force")
    if load.acts == "both":
        return force
    (*ends, last), is_back = over.stretches("rate")
    # the force acts at rest: an interval of the return stroke does not own its end
    ends = [_rounded(end, over.breaks, back=back) for end, back in zip(ends, is_back, strict=False)]
    if is_back[-1] and not is_back[0]:
        ends, is_back = [*ends, math.nextafter(last, 0.0)], [*is_back, False]
    return Known(Pieces([*ends, last], tuple(absent(key) if back else force for back in is_back)), key)


def _rounded(end: float, breaks: Array, *, back: bool) -> float:
    """Return the end of an interval, rounded to a close breakpoint of the driver's law or to decimals. [deg]"""
    law = float(breaks[np.argmin(np.abs(breaks - end))])
    if abs(law - end) < _AT_REST:
        return law
    near = round(end, _DECIMALS)
    end = near if abs(near - end) < _AT_REST else end
    return math.nextafter(end, 0.0) if back else end


def constant_force(load: ForceOnPoint, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return a constant force at a point."""
    force: tuple[Value, Value] = np.array(load.x), np.array(load.y)
    if is_known(motion.grid.angle):
        x, y = ((f"load_{axis}.{load.point}", f"{path}.{axis}") for axis in "xy")
        force = given(x[0], load.x, x[1]), given(y[0], load.y, y[1])
    return force_at(mechanism, motion, load.point, force, load.link)


def link_torque(load: TorqueOnLink, motion: Motion, path: str = "") -> AppliedLoads:
    """Return a torque on a link."""
    torque: Value
    if is_known(motion.grid.angle):
        key = f"link_torque.{load.link}"
        if callable(load.torque):
            torque = curve_over_angle(load.torque, angle_of(motion.grid), key, f"{path}.torque")
        else:
            torque = given(key, load.torque, f"{path}.torque")
    else:
        torque = load.torque(motion.grid.angle) if callable(load.torque) else np.array(load.torque)
    return torque_on(motion, load.link, torque)
