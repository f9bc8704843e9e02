"""The equilibrium equations of a mechanism with friction, solved group after group."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.dynamics.force_system import Equilibrium
from crankwork.dynamics.link_loads import OperatingState
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.loop_closure import solve_positions
from crankwork.mechanism.driver import Cylinder, LinkMotor
from crankwork.mechanism.joints import group_links
from crankwork.mechanism.mechanism import Mechanism

if TYPE_CHECKING:
    from crankwork.dynamics.friction import Friction, FrictionJoint

Status = NDArray[np.int8]
Truth = NDArray[np.bool_]
Rows = NDArray[np.intp] | slice

CONVERGED, NOT_CONVERGED, SELF_LOCKING, NO_POSITION = 0, 1, 2, 3
_TOLERANCE = 1e-13
# what pressing forces miss before the last step of Newton's method, of their size
_NEARLY = 1e-7
_ITERATIONS = 30
# iterations after which no other solution is expected
_MAX_TRIAL_STEPS = 12
# friction is increased to its full value in steps, starting from the solution without it
_STEPS = (0.25, 0.5, 0.75, 1.0)
# how often a matrix is squared to bound its spectral radius, and its norm then, of less than 1
_SQUARINGS, _CONTRACTS = 3, 0.5
# relative difference by which another solution is told from the first
_MIN_DIFFERENCE = 1e-6
# residuals of small forces are relative to this share of the largest force
_SMALL = 1e-2


class _Group(NamedTuple):
    """The equations of links that are solved together, their unknowns, and those of outer groups that act on them."""

    rows: NDArray[np.intp]
    columns: NDArray[np.intp]
    outer: NDArray[np.intp]


def _groups(mechanism: Mechanism, system: Equilibrium) -> Iterator[_Group]:
    """Yield the groups from the last one to the driver, or all links together if the driver is part of a group."""
    left_links, left_joints = list(range(len(system.links))), list(range(len(system.joints)))
    unknowns = system.matrix.shape[-1]
    if not isinstance(mechanism.driver, Cylinder | LinkMotor):
        for group in reversed(mechanism.dyads):
            links = [number for number in left_links if system.links[number] in group_links(group)]
            held = [number for number in left_joints if system.joints[number].link in group_links(group)]
            yield _group(system, links, held, [])
            left_links = [number for number in left_links if number not in links]
            left_joints = [number for number in left_joints if number not in held]
    yield _group(system, left_links, left_joints, range(2 * len(system.joints), unknowns))


def _group(system: Equilibrium, links: Sequence[int], held: Sequence[int], further: Sequence[int]) -> _Group:
    names = {system.links[number] for number in links}
    outer = [number for number, joint in enumerate(system.joints) if joint.other in names and number not in held]
    rows = np.array([3 * number + part for number in links for part in range(3)], dtype=np.intp)
    columns, outer_columns = (np.array([2 * number + part for number in numbers for part in range(2)], dtype=np.intp)
                              for numbers in (held, outer))  # fmt: skip
    return _Group(rows, np.append(columns, np.array(further, dtype=np.intp)), outer_columns)


class FrictionEquations:
    """The equilibrium equations with friction, which depends on their unknown forces.

    They are solved group after group, from the last to the driver: friction in a joint depends on the forces in it
    alone, and acts on the group that it holds and on inner ones.
    """

    def __init__(
        self, running: OperatingState, system: Equilibrium, right: Array, joints: Sequence[FrictionJoint]
    ) -> None:
        self._matrix, self._right = system.matrix, right.copy()
        # of each joint: the column of its first unknown, and the effect of its pressing force on the links
        self._parts: list[_Part] = []
        for joint in joints:
            unit = joint.unit_effect(running.motion, system)
            by_force = np.asarray(joint.sense * joint.factor)
            self._right -= unit * joint.friction(np.zeros_like(by_force))[:, None]
            self._parts.append(_Part(joint, 2 * system.joints.index(joint.joint), unit * by_force[:, None]))
        self._groups = tuple(_groups(running.mechanism, system))
        self._blocks: list[tuple[_Group, _Block]] = []

    def without_friction(self, right: Array) -> Array:
        """Return the unknowns without friction."""
        unknowns = np.full_like(right, np.nan)
        for group in self._groups:
            matrix, own = self._of(group, right, unknowns)
            unknowns[:, group.columns] = solve_positions(matrix, own)
        return unknowns

    def _of(self, group: _Group, right: Array, unknowns: Array) -> tuple[Array, Array]:
        """Return matrix and right side of a group, without the friction in joints of outer ones."""
        rows = self._matrix[:, group.rows]
        own = right[:, group.rows] - (rows[:, :, group.outer] @ unknowns[:, group.outer, None])[..., 0]
        return rows[:, :, group.columns], own

    def pressing(self, unknowns: Array) -> dict[Friction, Array]:
        """Return the pressing forces. [N]"""
        return {joint.law: joint.pressing(*unknowns[:, column : column + 2].T)[0] for joint, column, _ in self._parts}

    def solve(self, ideal: Array) -> tuple[Array, Array, Status]:
        """Return unknowns, residual and status; `ideal`: unknowns without friction, which tell the size of forces."""
        unknowns, largest = np.full_like(ideal, np.nan), np.max(np.abs(ideal), axis=1)
        status, residual = np.full(len(ideal), CONVERGED, dtype=np.int8), np.full(len(ideal), np.nan)
        self._blocks = []
        for group in self._groups:
            matrix, right = self._of(group, self._right, unknowns)
            for joint, column, effects in self._parts:
                if column in group.outer:
                    right -= effects[:, group.rows] * joint.pressing(*unknowns[:, column : column + 2].T)[0][:, None]
            place = {int(column): number for number, column in enumerate(group.columns)}
            parts = [
                _Part(joint, place[column], effects[:, group.rows])
                for joint, column, effects in self._parts
                if column in place
            ]
            block = _Block(matrix, right, parts, largest)
            self._blocks.append((group, block))
            unknowns[:, group.columns], own, own_status = block.solve()
            residual, status = np.fmax(residual, own), np.where(status == CONVERGED, own_status, status)
        unknowns[status != CONVERGED] = np.nan
        return unknowns, residual, status

    def margin(self, unknowns: Array) -> Array:
        """Return the determinant of the equations at a solution over that without friction. [-]"""
        margin = np.ones(len(unknowns))
        for group, block in self._blocks:
            margin *= block.margin(unknowns[:, group.columns])
        return np.where(np.isfinite(unknowns).all(axis=1), margin, np.nan)

    def has_another(self, unknowns: Array) -> Truth:
        """Return where another solution is found in a group."""
        result, largest = np.zeros(len(unknowns), dtype=bool), np.max(np.abs(unknowns), axis=1, initial=0.0)
        for group, block in self._blocks:
            result |= block.has_another(unknowns[:, group.columns], largest)
        return result


class _Part(NamedTuple):
    """A joint with friction, the column of its first unknown, and the effect of its pressing force on links."""

    joint: FrictionJoint
    column: int
    effects: Array


class _Block:
    """The equations of one group with friction in the joints that hold it."""

    def __init__(self, matrix: Array, right: Array, parts: Sequence[_Part], largest: Array) -> None:
        self._matrix, self._right, self._parts, self._largest = matrix, right, parts, largest
        self._ideal = solve_positions(matrix, right)
        # change of the unknowns by a unit of each pressing force, shape (n, unknowns, joints)
        unit = [-solve_positions(matrix, effects) for _, _, effects in parts]
        self._unit = np.stack(unit, axis=-1) if unit else np.zeros((*right.shape, 0))
        self._is_unique = self._contracts()

    def _contracts(self) -> Truth:
        """Return where there is one solution, and its determinant keeps its sign while friction grows.

        Pressing forces are seminorms of the unknowns: with a spectral radius below 1 of what units of each press in
        every joint, friction changes them by less than they differ.
        """
        gain = np.zeros((len(self._right), len(self._parts), len(self._parts)))
        for row, (joint, column, _) in enumerate(self._parts):
            gain[:, row] = joint.pressing(self._unit[:, column], self._unit[:, column + 1])[0]
        for _ in range(_SQUARINGS):
            gain = gain @ gain
        return np.asarray(gain.sum(axis=-1).max(axis=-1, initial=0.0) < _CONTRACTS)

    def _pressed(self, unknowns: Array, share: float, rows: Rows) -> tuple[Array, Array]:
        """Return the pressing forces, and the derivative of what they differ by from those they cause, at positions."""
        unit, pressing = self._unit[rows], np.empty((len(unknowns), len(self._parts)))
        derivative = np.empty((*pressing.shape, len(self._parts)))
        for row, (joint, column, _) in enumerate(self._parts):
            pressing[:, row], *slopes = joint.pressing(unknowns[:, column], unknowns[:, column + 1])
            first, second = (slope[:, None] * unit[:, column + side] for side, slope in enumerate(slopes))
            derivative[:, row] = -share * (first + second)
            derivative[:, row, row] += 1
        return pressing, derivative

    def _direct(self) -> Array:
        """Return the unknowns by Newton's method for the pressing forces alone, with full friction."""
        unknowns, pressing = self._ideal, np.zeros((len(self._right), len(self._parts)))
        for _ in range(_ITERATIONS):
            caused, derivative = self._pressed(unknowns, 1.0, slice(None))
            missing = pressing - caused
            pressing = pressing - solve_positions(derivative, missing)
            unknowns = self._ideal + (self._unit @ pressing[..., None])[..., 0]
            if not np.any((np.abs(missing) > _NEARLY * caused)[self._is_unique]):
                break
        return unknowns

    def solve(self) -> tuple[Array, Array, Status]:
        """Return unknowns, residual and status, from the solution without friction."""
        unknowns, all_rows = self._ideal.copy(), np.arange(len(self._ideal))
        status = np.where(np.isfinite(unknowns).all(axis=1), CONVERGED, NO_POSITION).astype(np.int8)
        turned, residual = np.zeros(len(unknowns), dtype=bool), np.full(len(unknowns), np.nan)
        if not self._parts:
            residual[status == CONVERGED] = 0.0
            return unknowns, residual, status
        is_left = status == CONVERGED
        if self._is_unique.any():
            direct = self._direct()
            missing, residual, derivative = self._miss(direct, 1.0, slice(None))
            is_done = self._is_unique & (residual < _TOLERANCE)
            unknowns[is_done], is_left = (direct - solve_positions(derivative, missing))[is_done], is_left & ~is_done
        grown = is_left.copy()
        for share in _STEPS if is_left.any() else ():
            rows, turns = all_rows[is_left], turned.copy()
            for step in range(_ITERATIONS + 1):
                missing, residual[rows], derivative = self._miss(unknowns[rows], share, rows)
                turned[rows] = self._determinant(unknowns[rows], share, rows) <= 0
                turns |= turned
                going = ~(residual[rows] < _TOLERANCE) & np.isfinite(residual[rows])
                rows = rows[going]
                if not rows.size or step == _ITERATIONS:
                    break
                unknowns[rows] -= solve_positions(derivative[going], missing[going])
            settled = residual < _TOLERANCE
            lost = np.where(settled, turned, turns)
            status[is_left & lost] = SELF_LOCKING
            status[is_left & ~lost & ~settled] = NOT_CONVERGED
            is_left &= status == CONVERGED
        # after one more step only rounding is left
        if (rows := all_rows[grown & (status == CONVERGED)]).size:
            missing, _, derivative = self._miss(unknowns[rows], 1.0, rows)
            unknowns[rows] -= solve_positions(derivative, missing)
        unknowns[status != CONVERGED] = np.nan
        return unknowns, residual, status

    def margin(self, unknowns: Array) -> Array:
        """Return the determinant of the equations at a solution over that without friction. [-]"""
        return self._determinant(unknowns, 1.0, slice(None))

    def _determinant(self, unknowns: Array, share: float, rows: Rows) -> Array:
        """Return the determinant of the equations over that without friction, 0 where it is unknown. [-]"""
        return np.asarray(np.linalg.det(np.nan_to_num(self._pressed(unknowns, share, rows)[1])))

    def has_another(self, unknowns: Array, largest: Array) -> Truth:
        """Return where another solution is found, from the opposite of all forces or of those in one joint."""
        result = np.zeros(len(unknowns), dtype=bool)
        if self._is_unique.all():
            return result
        for columns in (slice(None), *(slice(column, column + 2) for _, column, _ in self._parts)):
            start = self._ideal.copy()
            start[:, columns] *= -1
            difference = np.max(np.abs(self._settled(start) - unknowns), axis=1, initial=0.0)
            result |= ~self._is_unique & (difference > _MIN_DIFFERENCE * largest)
        return result

    def _settled(self, start: Array) -> Array:
        """Return the result of Newton's method with full friction, NaN without convergence."""
        unknowns, rows, ratio = start, np.arange(len(start)), np.full(len(start), np.nan)
        for _ in range(_MAX_TRIAL_STEPS):
            missing, ratio[rows], derivative = self._miss(unknowns[rows], 1.0, rows)
            going = ~(ratio[rows] < _TOLERANCE) & np.isfinite(ratio[rows])
            rows = rows[going]
            if not rows.size:
                break
            unknowns[rows] -= solve_positions(derivative[going], missing[going])
        unknowns[~(ratio < _TOLERANCE)] = np.nan
        return unknowns

    def _miss(self, unknowns: Array, share: float, rows: Rows) -> tuple[Array, Array, Array]:
        """Return the residual of the equilibrium at some positions, the same over the forces, and its derivative."""
        matrix, right = self._matrix[rows], self._right[rows]
        missing = (matrix @ unknowns[..., None])[..., 0] - right
        size = (np.abs(matrix) @ np.abs(unknowns)[..., None])[..., 0] + np.abs(right)
        derivative = matrix.copy()
        for joint, column, effects in self._parts:
            effect = effects[rows]
            pressing, by_first, by_second = joint.pressing(unknowns[:, column], unknowns[:, column + 1])
            missing += share * effect * pressing[:, None]
            size += np.abs(effect) * pressing[:, None]
            derivative[:, :, column] += share * effect * by_first[:, None]
            derivative[:, :, column + 1] += share * effect * by_second[:, None]
        # links that carry nothing have rounding errors only
        largest = np.maximum(np.max(np.abs(unknowns), axis=1, initial=0.0), self._largest[rows])
        size += _SMALL * np.abs(matrix).sum(axis=-1) * largest[:, None]
        ratio = np.divide(np.abs(missing), size, out=np.zeros_like(size), where=size != 0)
        return missing, ratio.max(axis=1, initial=0.0), derivative
