"""All cylinders of an engine on one grid: each is the one-cylinder engine at its own crank angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from crankwork.analysis.solved import Solved, solve_slave
from crankwork.analysis.state import columns
from crankwork.cylinders.articulated import ArticulatedRod
from crankwork.cylinders.layout import Layout, Place
from crankwork.cylinders.torque import cylinder_angles
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Engine, Machine
from crankwork.shaft.curve import Curve

# Corners of diagrams that only rounding has set apart are one. [deg]
_SAME_ANGLE = 1e-7


class WholeEngine(NamedTuple):
    """An engine made ready: the solved crank gear of every cylinder by number; alike ones are the same object."""

    machine: Machine
    engine: Engine
    cylinders: tuple[Solved, ...]

    @property
    def layout(self) -> Layout:
        """Where the cylinders stand and when they fire."""
        return self.engine.layout

    @property
    def master(self) -> Solved:
        """Cylinder 1."""
        return self.cylinders[0]

    @property
    def masses(self) -> CrankGearMasses:
        """Masses of one crank gear, zero where none are known."""
        return self.machine.masses or CrankGearMasses()

    @property
    def on_pin(self) -> dict[int, tuple[Place, ...]]:
        """The cylinders of each crankpin."""
        pins = sorted({place.crankpin for place in self.layout.places})
        return {pin: tuple(one for one in self.layout.places if one.crankpin == pin) for pin in pins}


def whole_engine(solved: Solved) -> WholeEngine:
    """Return the engine that a solved crank gear is the first cylinder of.

    Parameters
    ----------
    solved : Solved
        Of a machine with an engine.

    Raises
    ------
    CrankworkError
        If an articulated rod cannot be assembled all round.
    """
    machine = solved.machine
    engine = machine.engine
    if engine is None:
        raise TypeError("this machine is one crank gear only")
    kinds: dict[object, Solved] = {}
    for at in range(len(engine.layout.places)):
        kind = _kind(machine, engine, at)
        if kind not in kinds:
            slave, lean, is_first = kind
            alike = replace(solved, machine=_own_machine(machine, lean, is_first=is_first))
            kinds[kind] = alike if slave is None else solve_slave(alike, slave)
            if at == 0:
                kinds[kind] = solved
    cylinders = tuple(kinds[_kind(machine, engine, at)] for at in range(len(engine.layout.places)))
    return WholeEngine(machine, engine, cylinders)


def _kind(machine: Machine, engine: Engine, at: int) -> tuple[ArticulatedRod | None, float, bool]:
    """Return what tells a cylinder from the others: its rod and, where it matters, its lean and its share of a throw.

    With weight or a changing speed a bank leans by its own angle, and the mass of a throw counts for the first
    cylinder on it only.
    """
    places, slave = engine.layout.places, engine.slaves[at] if engine.slaves else None
    if not (machine.has_gravity or machine.angular_acceleration):
        return slave, 0.0, True
    first = next(one for one in places if one.crankpin == places[at].crankpin)
    return slave, places[at].axis - places[0].axis, places[at] is first


def _own_machine(machine: Machine, lean: float, *, is_first: bool) -> Machine:
    """Return the machine as a cylinder of that lean sees it. [deg]"""
    if lean and machine.cylinder is not None:
        inclination = machine.cylinder.inclination + float(np.radians(lean))
        machine = replace(machine, cylinder=replace(machine.cylinder, inclination=inclination))
    if not is_first and machine.masses is not None:
        machine = replace(machine, masses=replace(machine.masses, crank=0.0))
    return machine


def cylinder_columns(whole: WholeEngine, degrees: Array) -> dict[str, Array]:
    """Return the columns of every cylinder at crank angles of cylinder 1.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    degrees : array, shape (n,)
        Crank angles of cylinder 1, within one cycle. [deg]

    Returns
    -------
    dict of str to array, shape (cylinders, n)
        Columns that all cylinders have, by key; `crank_angle` is that of each cylinder. [SI]
    """
    local = cylinder_angles(degrees, whole.layout)
    rows: list[dict[str, Array]] = [{} for _ in whole.cylinders]
    for kind in dict.fromkeys(map(id, whole.cylinders)):
        members = [at for at, one in enumerate(whole.cylinders) if id(one) == kind]
        angles, place = np.unique(local[members], return_inverse=True)
        found = columns(whole.cylinders[members[0]], CrankGrid.from_degrees(angles))
        for at, index in zip(members, place.reshape(len(members), -1), strict=True):
            rows[at] = {key: values[index] for key, values in found.items()}
    shared = [key for key in rows[0] if all(key in row for row in rows)]
    slaves = {key for row in rows for key in row if key.startswith("knuckle_")}
    none = np.zeros_like(degrees)
    return {key: np.stack([row[key] for row in rows]) for key in shared} | {
        key: np.stack([row.get(key, none) for row in rows]) for key in slaves
    }


def breaks(whole: WholeEngine) -> Array:
    """Return the crank angles of cylinder 1 where the pressure of any cylinder has a corner.

    Parameters
    ----------
    whole : WholeEngine
        The engine.

    Returns
    -------
    array, shape (m,)
        From 0 to the end of the cycle. [deg]
    """
    cycle = whole.layout.cycle
    found = [np.array([0.0, cycle])]
    for one, place in zip(whole.cylinders, whole.layout.places, strict=True):
        own = one.space.diagram.breaks if one.space is not None else np.array([0.0])
        found.append((own + place.firing_angle) % cycle)
    angles = np.unique(np.concatenate(found))
    kept = angles[np.append(True, np.diff(angles) > _SAME_ANGLE)]
    kept[-1] = cycle
    return np.asarray(kept)


def torque_curves(whole: WholeEngine) -> tuple[Curve, Curve]:
    """Return the torque of cylinder 1 and that of all over the cycle, exact across the corners of every diagram.

    Parameters
    ----------
    whole : WholeEngine
        The engine.

    Returns
    -------
    tuple of Curve
        Torque on the crankshaft. [N m]
    """
    edges = np.radians(breaks(whole))

    def torque(which: Sequence[int]) -> Curve:
        def total(angle: Array) -> Array:
            return np.asarray(cylinder_columns(whole, np.degrees(angle))["crank_torque"][list(which)].sum(axis=0))

        return Curve.fitted(total, edges)

    every = torque(range(len(whole.cylinders)))
    return (every if len(whole.cylinders) == 1 else torque([0])), every
