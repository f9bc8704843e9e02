"""Positions of crank, rods and pistons of every cylinder of an engine, its gas pressure, and when it fires."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.cylinders.articulated import throw_mechanism
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.kinematics.crank_grid import Array
from crankwork.machine import Engine, Machine
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
