"""Positions of a linkage or of the cylinders of an engine over the crank angle: the data of plans and drawings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.results import Results
from crankwork.cylinders.articulated import throw_mechanism
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import pass_change_points
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import linkage_motion
from crankwork.machine import Engine, Machine
from crankwork.mechanism.mechanism import Mechanism
from crankwork.preparation.reachable_motion import find_reachable_motion, open_range
from crankwork.working_cycle.pressure_models import CornerPressure

_TURN = 360.0
# on pins and wall of a cylinder
FORCES = ("piston_force", "side_force", "rod_force", "tangential_force")


class SampledCylinder(NamedTuple):
    """A cylinder over frames, seen along the shaft, which turns clockwise; the crankshaft is the origin."""

    place: CylinderPlace
    offset: float  # Of its axis, positive towards the crankpin at 90 degrees [m]
    pin: Array  # Crankpin, shape (n, 2) [m]
    joint: Array  # What its rod turns on, the crankpin or a knuckle pin, shape (n, 2) [m]
    piston: Array  # Piston pin, shape (n, 2) [m]
    top: float  # Distance of the piston pin along the axis at the dead centres [m]
    bottom: float
    pressure: Array | None = None  # Gauge pressure, shape (n,), where it is known [Pa]
    fires: float | None = None  # Crank angle at which it fires, at its top dead centre; None where nothing burns [deg]
    forces: Mapping[str, Array] = {}  # Those of `FORCES` that are known, by key, shape (n,) [N]

    @property
    def axis(self) -> Array:
        """The direction of its axis towards the head, shape (2,)."""
        angle = math.radians(self.place.axis)
        return np.array([math.sin(angle), math.cos(angle)])

    @property
    def along(self) -> Array:
        """Distance of the piston pin along the axis, shape (n,). [m]"""
        return np.asarray(self.piston @ self.axis)


class SampledEngine(NamedTuple):
    """All cylinders of an engine, or the one of a crank gear, by number."""

    degrees: Array  # Crank angles of cylinder 1, shape (n,) [deg]
    layout: Layout
    cylinders: tuple[SampledCylinder, ...]


def engine_moving(machine: Machine, degrees: Array, results: Results | None = None) -> SampledEngine | None:
    """Return a machine with cylinders at crank angles; None if it has no cylinders.

    `results`: without them pressures are not known.
    """
    lengths, engine = machine.lengths, machine.engine or _alone(machine)
    if lengths is None or engine is None:
        return None
    layout, columns = engine.layout, _columns(results, degrees)
    result: list[SampledCylinder] = []
    for crankpin in sorted({place.crankpin for place in layout.places}):
        mechanism = throw_mechanism(layout, lengths, engine.articulated_rods, engine.offsets, crankpin)
        points = {name: value.place for name, value in sample_motion(mechanism, degrees).points.items()}
        # dead centres lie between the sampled angles
        turn = sample_motion(mechanism, np.arange(_TURN)).points
        for place in (place for place in layout.places if place.crankpin == crankpin):
            offset = engine.offsets[place.number - 1] if engine.offsets else lengths.offset
            joint = points[f"C{place.number}" if place.master else "A"]
            cylinder = SampledCylinder(place, offset, points["A"], joint, points[f"B{place.number}"], 0.0, 0.0)
            reach = turn[f"B{place.number}"].place @ cylinder.axis
            cylinder = cylinder._replace(top=float(reach.max()), bottom=float(reach.min()))
            own = {key: values[place.number - 1] for key, values in columns.items()}
            if (pressure := own.pop("gas_pressure", None)) is not None:
                cylinder = cylinder._replace(pressure=pressure, fires=_fires(machine, engine, place))
            result.append(cylinder._replace(forces=own))
    return SampledEngine(degrees, layout, tuple(sorted(result, key=lambda item: item.place.number)))


def _alone(machine: Machine) -> Engine | None:
    """Return a machine with one cylinder as an engine."""
    if machine.cylinder is None:
        return None
    place = CylinderPlace(1, math.degrees(machine.inclination), 0, 0, pin_angle=0.0, position=0.0, firing_angle=0.0)
    return Engine(Layout("inline", (place,), machine.cycle, (1,)))


def _columns(results: Results | None, degrees: Array) -> dict[str, Array]:
    """Return gauge pressure and forces of every cylinder, as far as they are known, shape (cylinders, n). [SI]"""
    if results is None:
        return {}
    keys = [key for key in ("gas_pressure", *FORCES) if key in results.trace]
    angles = np.mod(degrees, results.machine.cycle)
    if results.machine.engine is None:
        return {key: values[None] for key, values in results.columns_at(angles, keys).items()}
    # machines of one cylinder do not load it
    from crankwork.analysis.cylinders import multi_cylinder_engine  # noqa: PLC0415

    engine = multi_cylinder_engine(results.solved)
    return {key: engine.each(key, angles) for key in keys if len(engine.has(key)) == len(engine.cylinders)}


def _fires(machine: Machine, engine: Engine, place: CylinderPlace) -> float | None:
    """Return when a cylinder fires, in four strokes a turn after it breathes: at its dead centre, or ignited. [deg]"""
    gas = engine.gases[place.number - 1] if engine.gases else machine.gas
    # without a calculated cycle two strokes may be those of a compressor
    burns = machine.engine is not None or (gas is not None and (gas.calculated is not None or gas.cycle > _TURN))
    if not burns or place.number in engine.misfires:
        return None
    later = _TURN if machine.cycle > _TURN else 0.0
    timing = gas.calculated.timing if gas is not None and isinstance(gas.calculated, CornerPressure) else None
    advance = timing.ignition_advance if timing is not None else 0.0
    return (place.firing_angle + place.top + later - advance) % machine.cycle


_MOST_FRAMES = 600


class Track(NamedTuple):
    """Places of a point and their first and second derivative by the crank angle, arrays of shape (n, 2). [m]"""

    place: Array
    place_1: Array
    place_2: Array


class Frame(NamedTuple):
    """A link that moves: its origin, the direction of its x axis, shape (n, 2), and the derivatives of its angle."""

    origin: Track
    along: Array
    angle_1: Array
    angle_2: Array


class SampledMotion(NamedTuple):
    """A linkage at crank angles."""

    degrees: Array  # Crank angles, shape (n,) [deg]
    points: Mapping[str, Track]  # Points by name [m]
    frames: Mapping[str, Frame]  # Links and sliding pieces by name
    sliders: Mapping[str, Array]  # Distance of each slider along its guide, shape (n,) [m]


def sample_motion(mechanism: Mechanism, degrees: ArrayLike) -> SampledMotion:
    """Return a linkage at crank angles."""
    result = linkage_motion(mechanism, CrankGrid.from_degrees(degrees))
    count = len(result.grid)

    def stacked(pair: Iterable[Array]) -> Array:
        return np.column_stack([np.broadcast_to(item, count) for item in pair])

    def track(point: PointMotion) -> Track:
        return Track(*(stacked(pair) for pair in zip(*point, strict=True)))

    frames = {
        name: Frame(
            track(value.origin),
            stacked((value.cos, value.sin)),
            np.broadcast_to(value.angle_1, count),
            np.broadcast_to(value.angle_2, count),
        )
        for name, value in result.frames.items()
    }
    points = {name: track(value) for name, value in result.points.items()}
    sliders = {name: np.broadcast_to(value.position, count) for name, value in result.sliders.items()}
    return SampledMotion(result.grid.degrees, points, frames, sliders)


def transfer_ratios(mechanism: Mechanism, degrees: ArrayLike) -> dict[str, Array]:
    """Return velocities of points and sliders and angular velocities of links, over that of the crank.

    `velocity_ratio.NAME` of points, `rotation_ratio.NAME` of links, `velocity_ratio.NAME` of sliders [m], [-].
    """
    values = linkage_motion(mechanism, CrankGrid.from_degrees(degrees))
    points = {name: np.hypot(x.position_1, y.position_1) for name, (x, y) in values.points.items()}
    ratios = {f"velocity_ratio.{name}": value for name, value in points.items() if name not in mechanism.ground}
    links = {name: value.position_1 for name, value in values.links.items() if name != mechanism.crank.link}
    ratios |= {f"rotation_ratio.{name}": value for name, value in links.items()}
    return ratios | {f"velocity_ratio.{name}": value.position_1 for name, value in values.sliders.items()}


def reached_angles(machine: Machine, step: float) -> tuple[Array, bool]:
    """Return crank angles of a cycle as far as a linkage reaches them [deg], and whether it reaches all.

    `step`: step [deg].
    """
    result = find_reachable_motion(machine, step)
    return result.grid.degrees, result.travel is None


class AnimationPath(NamedTuple):
    """Crank angles of a moving drawing at equal times, the last that of the first [deg], and the mechanism drawn."""

    degrees: Array
    mechanism: Mechanism
    turns: bool  # Whether the crank turns fully; it goes to and fro otherwise
    own_time: float = 0.0  # How long what is drawn takes, of a machine let go [s]


def animation_path(mechanism: Mechanism, frames: int) -> AnimationPath:
    """Return how the crank of a moving drawing goes: round, or to and fro between its dead positions."""
    mechanism, result = pass_change_points(mechanism)
    if result is None or result.is_whole:
        return AnimationPath(np.arange(frames + 1) * mechanism.period / frames, mechanism, turns=True)
    low, high = open_range(result)
    swung = (1 - np.cos(math.tau * np.arange(frames + 1) / frames)) / 2
    return AnimationPath(low + (high - low) * swung, mechanism, turns=False)


def transient_animation_path(results: Results) -> AnimationPath | None:
    """Return the crank angles of a transient motion at equal times; None if its dyads change their branches."""
    ran = results.listings.get("transient")
    happened = results.listings.get("transient_events", ran)
    if ran is None or happened is None or any(name.startswith("dead_position") for name in happened.names):
        return None
    time, angle = ran.columns["time"], ran.columns["crank_angle"]
    # the last interval of time may be shorter
    rows = np.arange(0, len(time) - (len(time) > 2), math.ceil(len(time) / _MOST_FRAMES))
    return AnimationPath(np.degrees(angle[rows]), results.machine.mechanism, turns=True, own_time=float(time[rows[-1]]))
