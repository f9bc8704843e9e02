"""Model of the transient simulation: masses, loads and friction along one coordinate, as polynomials."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from crankwork.analysis.flywheel import turning_inertia
from crankwork.analysis.path_coordinate import PathCoordinate, PathSegment
from crankwork.analysis.prepared import PreparedLinkage
from crankwork.dynamics.force_system import full_equilibrium
from crankwork.dynamics.friction import FrictionJoint, friction_joints
from crankwork.dynamics.link_loads import link_wrenches
from crankwork.dynamics.operating_state import OperatingState
from crankwork.dynamics.reduction import reduced_inertia, reduced_torque
from crankwork.errors import MethodError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import TracedValue, absent, breakpoints_of, given, total
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.traced_motion import traced_mechanism, traced_motion
from crankwork.loads.applied_loads import AppliedLoads
from crankwork.loads.load import (
    Damper,
    ProcessForce,
    SliderDamper,
    TorqueOnLink,
    applied_loads,
    has_potential,
    potential_energy,
)
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine, Transient
from crankwork.shaft.piecewise_fit import fit_piecewise
from crankwork.shaft.transient import LIGHT, OWN, RATE, Direction, TransientFriction, TransientSystem

_WIDTH = math.pi / 8
_LOOKS, _HALVINGS, _NEGLIGIBLE = 2001, 60, 1e-12
# inertia and its derivative; energy and torques; damping; rate of the crank
_GROUPS = (0, 1, 1, 1, 2, 3, 0, 1)


@dataclass(frozen=True)
class TransientModel:
    """A linkage in transient motion: its masses and loads along the coordinate of a chart."""

    solved: PreparedLinkage
    chart: PathCoordinate
    flywheel: float = 0.0  # Moment of inertia on the crank, added to that of the machine [kg m2]
    # Solved paths of the chains of each branch
    paths: dict[float, dict[int, ChainPath]] = field(default_factory=dict, compare=False, repr=False)

    @property
    def machine(self) -> Machine:
        """The machine."""
        return self.solved.machine

    @property
    def wanted(self) -> Transient:
        """The transient simulation that is asked for."""
        if self.machine.transient is None:
            raise TypeError("no transient is asked for")
        return self.machine.transient

    @property
    def crank_inertia(self) -> float:
        """Moment of inertia that turns with the crank. [kg m2]"""
        motor = self.machine.drive.motor
        return self.machine.drive.inertia + self.flywheel + (motor.reduced_inertia if motor else 0.0)

    def moved(self, piece: PathSegment, angle: Array, direction: Direction = 1) -> Motion:
        """Return the motion of a branch at crank angles, forwards or backwards. [rad]"""
        paths = self.paths.setdefault(piece.low, {})
        motion = linkage_motion(piece.mechanism, CrankGrid.from_radians(angle), paths=paths)
        return motion if direction > 0 else _backwards(motion)

    def loads(
        self, piece: PathSegment, motion: Motion, speed: Value = 0.0, *, with_potential: bool = True
    ) -> AppliedLoads:
        """Return the applied loads at some speeds of the crank. [rad/s]"""
        loads = [load for load in self.machine.loads if with_potential or not has_potential(load)]
        gas = self.solved.filling.loads(piece.mechanism, motion)
        return applied_loads(piece.mechanism, motion, loads, speed).also(gas)

    def inertia(self, piece: PathSegment, motion: Motion) -> Array:
        """Return the reduced moment of inertia with all that turns with the crank. [kg m2]"""
        still = np.zeros_like(motion.grid.angle)
        return np.asarray(reduced_inertia(piece.mechanism, motion).inertia + still + self.crank_inertia)

    def _columns(self, u: Array) -> Array:
        result = np.zeros((OWN + self._slip_row_count, u.size))
        for piece, index in self.chart.each(u):
            q, q_1, _ = piece.crank(u[index])
            motion = self.moved(piece, q)
            result[0, index] = self.inertia(piece, motion) * q_1**2
            result[1, index] = potential_energy(piece.mechanism, motion, self.machine.loads)
            result[RATE, index] = q_1
            dampers = [load for load in self.machine.loads if isinstance(load, Damper | SliderDamper)]
            result[4, index] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, dampers, 1.0)) * q_1**2
            torques = [
                reduced_torque(item, self.loads(piece, item, with_potential=False)) * q_1
                for item in ((motion, _backwards(motion)) if self.is_two_sided else (motion, motion))
            ]
            if not piece.turns_back:
                result[6, index] = reduced_inertia(piece.mechanism, motion).inertia_1
                held = [load for load in self.machine.loads if has_potential(load)]
                result[7, index] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, held))
            if self.machine.friction:
                result[OWN:, index] = self._slip_rows(piece, motion, piece.crank(u[index]))
            result[2:4, index] = torques if piece.last >= piece.first else torques[::-1]
        return result

    @cached_property
    def _joints(self) -> tuple[FrictionJoint, ...]:
        """The joints with friction."""
        piece = self.chart.pieces[0]
        middle = np.array([(piece.first + piece.last) / 2])
        return friction_joints(OperatingState(piece.mechanism, self.moved(piece, middle)), self.machine.friction)

    @property
    def _slipping(self) -> TransientFriction | None:
        return TransientFriction(self._joints, OWN) if self.machine.friction else None

    @property
    def _slip_row_count(self) -> int:
        return self._slipping.count * len(self._joints) if self._slipping else 0

    @property
    def _slip_groups(self) -> tuple[int, ...]:
        """Groups of the rows of friction by order of magnitude."""
        if self._slipping is None:
            return ()
        kinds = (3, *(kind for kind in (5, 5, 6, 7, 8) for _ in range(2)), *(9 for _ in range(2 * len(self._joints))))
        return kinds * len(self._joints)

    def _slip_rows(self, piece: PathSegment, motion: Motion, crank: Transfer) -> Array:
        """Return the rows of `TransientFriction`: rates of the joints, unknowns by cause, shape (rows, n)."""
        still = OperatingState(piece.mechanism, motion)
        system, back = full_equilibrium(still), _backwards(motion)
        dampers = [load for load in self.machine.loads if isinstance(load, Damper | SliderDamper)]
        motions = (motion, back) if piece.last >= piece.first else (back, motion)
        causes = [
            *(OperatingState(piece.mechanism, motion, 0.0, self.loads(piece, item)) for item in motions),
            OperatingState(piece.mechanism, motion, 1.0),
            OperatingState(piece.mechanism, motion, 0.0, applied_loads(piece.mechanism, motion, dampers, 1.0)),
            OperatingState(piece.mechanism, motion, 0.0, angular_acceleration=1.0),
        ]
        right = [system.right_side(link_wrenches(cause)) + np.zeros((len(motion.grid), 1)) for cause in causes]
        right += [-joint.unit_effect(motion, system) for joint in self._joints]
        grows, falls, square, rate, acceleration, *own = np.moveaxis(
            np.linalg.solve(system.matrix, np.stack(right, axis=-1)), -1, 0
        )
        _, q_1, q_2 = (item[:, None] for item in crank)
        by_cause = [grows, falls, square * q_1**2 + acceleration * q_2, rate * q_1, acceleration * q_1, *own]
        rows = []
        for friction_joint in friction_joints(still, self.machine.friction):
            first = 2 * system.joints.index(friction_joint.joint)
            rows += [
                friction_joint.rate * crank.position_1,
                *(each[:, first + k] for each in by_cause[:5] for k in range(2)),
            ]
            rows += [each[:, first + k] for k in range(2) for each in by_cause[5:]]
        return np.stack(rows)

    @cached_property
    def is_two_sided(self) -> bool:
        """Whether loads differ when the crank turns back."""
        processes = (load for load in self.machine.loads if isinstance(load, ProcessForce))
        return any(process.acts == "forward" for process in processes)

    @cached_property
    def system(self) -> TransientSystem:
        """The equation of motion along the coordinate."""
        wanted, ends = self.wanted, self.chart.ends
        breaks = np.unique(np.concatenate([ends, *(self._breaks(piece) for piece in self.chart.pieces)]))
        reduced = fit_piecewise(self._columns, breaks, _WIDTH, self.chart.period, groups=(*_GROUPS, *self._slip_groups))
        # towards dead positions the derivatives by the crank angle are differences of infinite terms
        dead = self.chart.pieces[0].turns_back
        reduced = reduced.with_slopes((0, 6), (1, 7)) if dead else reduced
        places = np.linspace(ends[0], ends[-1], _LOOKS)
        inertia = reduced(places)[0]
        if not np.min(inertia) > LIGHT * np.max(inertia):
            light = self.chart.crank(places[[np.argmin(inertia)]]).position
            raise MethodError(ErrorMessage("transient_light", angle=math.degrees(float(light[0]))))
        slipping = self._slipping
        if slipping is not None:
            breaks = np.unique(np.concatenate([breaks, _roots(lambda u: slipping.rates(reduced(u)), breaks)]))
        return TransientSystem(
            reduced,
            tuple(map(float, breaks)),
            slipping=slipping,
            dead=frozenset(ends) if dead else frozenset(),
            changes=self._changes,
            torque=wanted.torque,
            motor=self.machine.drive.motor if wanted.motor else None,
            stops=self.chart.walls(wanted.start, wanted.stops),
            restitution=wanted.restitution,
        )

    def traced(self, motion: Motion, flywheel: TracedValue | None) -> tuple[TracedValue, ...]:
        """Return the traced operands of a motion in time, as `TransientReplay` takes them.

        Empty where they depend on more than the crank angle. `motion`: over the crank angle, traced; `flywheel`: added
        to that of the machine.
        """
        machine, wanted = self.machine, self.wanted
        if self.chart.pieces[0].turns_back or machine.friction or machine.drive.motor or self.is_two_sided:
            return ()
        mechanism = traced_mechanism(machine.mechanism, machine.linkage)
        added = [turning_inertia(machine, "reduced_inertia.drive"), *([] if flywheel is None else [flywheel])]
        dampers = [load for load in machine.loads if isinstance(load, Damper | SliderDamper)]
        undamped = [load for load in machine.loads if load not in dampers]
        pushed = applied_loads(mechanism, motion, undamped).also(self.solved.filling.loads(mechanism, motion))
        damped = applied_loads(mechanism, motion, dampers, 1.0)
        stated = (
            ("transient_time", wanted.time, "time"),
            ("driving_torque", wanted.torque, "torque"),
            ("crank_angle", wanted.start, "start"),
            ("speed", wanted.speed, "speed"),
        )
        inertia: TracedValue
        inertia, inertia_1 = reduced_inertia(mechanism, motion, total("reduced_inertia", added))
        return (
            inertia,
            inertia_1,
            reduced_torque(motion, pushed),
            -reduced_torque(motion, damped) if dampers else absent("damping"),
            *(given(key, value, f"transient.{name}") if value else absent(key) for key, value, name in stated),
        )

    @property
    def _changes(self) -> tuple[float, ...]:
        """The coordinates of change points, of a crank that turns fully. [rad]"""
        if self.chart.pieces[0].turns_back:
            return ()
        passages = self.machine.mechanism.passages.values()
        coordinates = {
            math.radians(change % math.degrees(self.chart.period)) for passage in passages for change in passage.changes
        }
        return tuple(sorted(coordinates))

    def _breaks(self, piece: PathSegment) -> Array:
        """Return the coordinates on a branch at which a law of the loads changes."""
        jumping = (ProcessForce, TorqueOnLink)
        if not (any(isinstance(load, jumping) for load in self.machine.loads) or self.machine.chambers):
            return np.empty(0)
        start, end = sorted(map(math.degrees, (piece.first, piece.last)))
        inside = np.linspace(start, end, 363)[1:-1]
        motion = linkage_motion(piece.mechanism, CrankGrid.from_degrees(inside))
        traced = traced_motion(piece.mechanism, motion, self.machine.linkage)
        torque = reduced_torque(traced, self.loads(piece, traced))
        if not isinstance(torque, TracedValue):
            return np.empty(0)
        angles = np.radians(breakpoints_of([torque], end - start, start))
        if not piece.turns_back:
            return angles
        share = (angles - piece.first) / (piece.last - piece.first)
        return np.asarray(piece.low + (piece.high - piece.low) * np.arccos(np.clip(1 - 2 * share, -1, 1)) / math.pi)


def _backwards(motion: Motion) -> Motion:
    """Return a motion whose crank turns back."""
    angle = motion.grid.angle
    return replace(motion, driver=Transfer(angle, np.full_like(angle, -1.0), np.zeros_like(angle)))


def _roots(function: Callable[[Array], Array], breaks: Array) -> Array:
    """Return the zeros at which functions change their signs between the first and the last of the breaks."""
    places = np.unique(np.concatenate([breaks, np.linspace(breaks[0], breaks[-1], _LOOKS)]))
    values = function(places)
    values = np.where(np.abs(values) <= _NEGLIGIBLE * np.max(np.abs(values), axis=1, keepdims=True), 0.0, values)
    result = []
    for row, k in zip(*np.nonzero(values[:, 1:] * values[:, :-1] < 0), strict=True):
        low, high, below = places[k], places[k + 1], values[row, k] < 0
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if (function(np.array([middle]))[row, 0] < 0) == below else (low, middle)
        result.append(high)
    exact = places[np.any((values == 0) & np.any(values != 0, axis=1, keepdims=True), axis=0)]
    return np.concatenate([np.array(result), exact[np.isin(exact, places[1:-1])]])
