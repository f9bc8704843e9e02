"""Worked steps of the torque of an engine: every cylinder, the sum, along the shaft, and through an articulated rod."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from crankwork.analysis.cylinders import WholeEngine, cylinder_columns
from crankwork.analysis.steps_motion import acceleration_step
from crankwork.cylinders import articulated, articulated_forces
from crankwork.cylinders.torque import cylinder_angle, torque_behind_throw, torque_of_crankpin
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads import gas as gas_formulas
from crankwork.steps import AnyStep, Given, named_step, renamed, sum_step, worked_step


@dataclass(frozen=True)
class WholeMoment:
    """All cylinders of an engine at one crank angle.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    degrees : float
        Crank angle of cylinder 1. [deg]
    """

    whole: WholeEngine
    degrees: float

    @classmethod
    def at(cls, whole: WholeEngine, degrees: float) -> Self:
        """Return the engine at a crank angle.

        Parameters
        ----------
        whole : WholeEngine
            The engine.
        degrees : float
            Crank angle of cylinder 1. [deg]
        """
        return cls(whole, degrees)

    @cached_property
    def found(self) -> Mapping[str, tuple[float, ...]]:
        """The columns of every cylinder at this angle, by number. [SI]"""
        rows = cylinder_columns(self.whole, np.array([self.degrees]))
        return {key: tuple(float(one) for one in row[:, 0]) for key, row in rows.items()}

    def of(self, number: int) -> Mapping[str, float]:
        """Return the columns of one cylinder at this angle.

        Parameters
        ----------
        number : int
            Its number.
        """
        return {key: row[number - 1] for key, row in self.found.items()}


def torque_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield the torque of every cylinder, their sum, and the torques on main journals and crankpins.

    Parameters
    ----------
    moment : WholeMoment
        The engine at a crank angle.
    """
    places = moment.whole.layout.places
    throws = sorted({place.throw for place in places})
    members = [[_of_cylinder(moment, place.number) for place in places if place.throw == throw] for throw in throws]
    if len(throws) == 1:
        yield sum_step("total_torque", members[0])
        return
    of_throw: list[AnyStep] = [
        some[0] if len(some) == 1 else sum_step(f"throw_torque.{at}", some) for at, some in enumerate(members, start=1)
    ]
    yield sum_step("total_torque", of_throw)
    journal = 0.0
    for at, step in enumerate(of_throw, start=1):
        names = {"M_j": f"journal_torque.{at}", "M_t": step.key}
        yield renamed(worked_step(torque_of_crankpin, journal, step.value, key=f"crankpin_torque.{at}"), **names)
        behind = worked_step(torque_behind_throw, journal, step.value, key=f"journal_torque.{at + 1}")
        yield renamed(behind, **names)
        journal = behind.value


def _of_cylinder(moment: WholeMoment, number: int) -> AnyStep:
    """Return the torque of a cylinder; given where that of a rotating mass is in it, which is shown for cylinder 1."""
    known, machine = moment.of(number), moment.whole.machine
    key = f"crank_torque.{number}" if len(moment.whole.cylinders) > 1 else "crank_torque"
    if machine.masses is not None and (machine.has_gravity or machine.angular_acceleration):
        return Given(key, known["crank_torque"])
    step = worked_step(
        forces.crank_torque, known["tangential_force"], moment.whole.master.lengths.crank_radius, key=key
    )
    return renamed(step, T=f"tangential_force.{number}") if len(moment.whole.cylinders) > 1 else step


def articulated_steps(moment: WholeMoment) -> Iterator[AnyStep]:
    """Yield motion and forces of the first articulated rod, and what it adds to those of the master rod.

    Parameters
    ----------
    moment : WholeMoment
        The engine at a crank angle; nothing where no rod is articulated.
    """
    whole = moment.whole
    number = next((at for at, rod in enumerate(whole.engine.slaves, start=1) if rod is not None), 0)
    rod = whole.engine.slaves[number - 1] if number else None
    if rod is None:
        return
    own, place = whole.cylinders[number - 1], whole.layout.places[number - 1]
    grid = CrankGrid.from_degrees(cylinder_angle([moment.degrees], place, whole.layout.cycle))
    moving = articulated.articulated_motion(own.lengths, rod, grid)
    arrays = {
        "sin_phi": grid.sin, "cos_phi": grid.cos, "sin_delta_a": moving.sin, "cos_delta_a": moving.cos,
        "x_A1": moving.knuckle.x.position_1, "x_A2": moving.knuckle.x.position_2,
        "y_A": moving.knuckle.y.position, "y_A1": moving.knuckle.y.position_1, "y_A2": moving.knuckle.y.position_2,
        "sin_beta_a": moving.swing.sin, "cos_beta_a": moving.swing.cos, "beta_a1": moving.rod.position_1,
        "sin_beta": moving.swing.sin, "cos_beta": moving.swing.cos,
        "x_1": moving.piston.position_1, "x_2": moving.piston.position_2,
    }  # fmt: skip
    known = {name: float(np.ravel(values)[0]) for name, values in arrays.items()} | {
        "r": own.lengths.crank_radius, "r_a": rod.knuckle_radius, "l_a": rod.length, "e": rod.offset,
        "w": own.speed, "eps": own.machine.angular_acceleration,
    }  # fmt: skip
    yield from _motion_of_slave(known, number)
    yield from _forces_of_slave(moment, known, number)
    master = float(np.ravel(moving.master.cos)[0])
    couple = moment.of(number)["knuckle_couple"]
    yield worked_step(
        articulated_forces.side_force_on_master, couple, own.lengths.rod_length, master,
        key=f"knuckle_side_force.{number}",
    )  # fmt: skip


def _motion_of_slave(known: Mapping[str, float], number: int) -> Iterator[AnyStep]:
    for function, key in (
        (articulated.knuckle_along, "knuckle_x"),
        (articulated.knuckle_across, "knuckle_y"),
        (articulated.articulated_rod_sine, "rod_sine"),
        (articulated.articulated_rod_transfer_1, "rod_transfer_1"),
        (articulated.articulated_rod_transfer_2, "rod_transfer_2"),
        (articulated.articulated_transfer_1, "piston_transfer_1"),
        (articulated.articulated_transfer_2, "piston_transfer_2"),
        (forces.piston_velocity, "piston_velocity"),
    ):
        yield named_step(function, known, key=f"{key}.{number}")
    yield acceleration_step(known, f"piston_acceleration.{number}")


def _forces_of_slave(moment: WholeMoment, known: Mapping[str, float], number: int) -> Iterator[AnyStep]:
    """Yield the force on the piston pin, what wall and rod take of it, and the moment on the master rod."""
    found, own = moment.of(number), moment.whole.cylinders[number - 1]
    gas = found.get("gas_force", 0.0)
    if own.space is not None and not own.space.rod_area:
        yield Given(f"gas_pressure.{number}", found["gas_pressure"])
        yield worked_step(gas_formulas.gas_force, found["gas_pressure"], own.space.area, key=f"gas_force.{number}")
    if own.machine.masses is not None:
        mass = own.machine.masses.reciprocating
        yield worked_step(forces.inertia_force, mass, found["piston_acceleration"], key=f"inertia_force.{number}")
        if own.machine.has_gravity:
            parts = (gas, found["inertia_force"], found["weight_force"])
            yield worked_step(forces.piston_force_with_weight, *parts, key=f"piston_force.{number}")
        else:
            yield worked_step(forces.piston_force, gas, found["inertia_force"], key=f"piston_force.{number}")
    known = {**known, "P": found["piston_force"]}
    yield named_step(forces.side_force, known, key=f"side_force.{number}")
    yield named_step(forces.rod_force, known, key=f"rod_force.{number}")
    yield named_step(articulated_forces.couple_of_knuckle, known, key=f"knuckle_couple.{number}")
