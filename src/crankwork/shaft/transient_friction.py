"""Friction in transient motion: moments and forces that depend on the joint forces that they change."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.dynamics.friction import FrictionJoint, PinFriction
from crankwork.kinematics.crank_grid import Array

# rows of one joint: its rate by the coordinate, then pairs of its two unknowns: constant while it grows and while it
# falls, with the square of the rate, with the rate, with the acceleration
_GROWS, _FALLS, _SQUARE, _RATE, _ACCELERATION, _OWN = 1, 3, 5, 7, 9, 11
_ITERATIONS = 40
_SETTLED = 1e-14
_LOCKED = 1e-9


class FrictionState(NamedTuple):
    """Rate, acceleration without friction and inertia of the coordinate at some places, arrays of shape (n,)."""

    rate: Array
    acceleration: Array
    inertia: Array


@dataclass(frozen=True)
class TransientFriction:
    """Joints with friction, whose rows of a machine's quantities begin at a place."""

    joints: tuple[FrictionJoint, ...]
    first: int

    @property
    def count(self) -> int:
        """Rows of one joint: its own, and two for the effect of the friction of each joint on its unknowns."""
        return _OWN + 2 * len(self.joints)

    def rates(self, rows: Array) -> Array:
        """Return the relative rates of the joints by the coordinate, shape (joints, n)."""
        return rows[self.first : self.first + self.count * len(self.joints) : self.count]

    def frictions(self, rows: Array, direction: int, senses: Array, state: FrictionState) -> Array:
        """Return the friction of each joint on the link that it holds, shape (joints, n). [N m] or [N]

        `rows`: the quantities of the machine, shape (rows, n); `senses`: directions of the relative rates as the
        coordinate grows. NaN where the joints lock.
        """
        blocks = rows[self.first :].reshape(len(self.joints), self.count, -1)
        rates = np.stack([block[0] for block in blocks])
        v, a, J = state
        row = _GROWS if direction > 0 else _FALLS
        # the two unknowns of every joint without friction, and what a unit of each friction adds to them
        free = np.stack(
            [
                block[row : row + 2] + block[_SQUARE : _SQUARE + 2] * v * v + block[_RATE : _RATE + 2] * v
                + block[_ACCELERATION : _ACCELERATION + 2] * a
                for block in blocks
            ]
        )  # fmt: skip
        by_friction = np.stack(
            [
                block[_ACCELERATION : _ACCELERATION + 2, None] * (rates / J)[None]
                + block[_OWN:].reshape(2, len(blocks), -1)
                for block in blocks
            ]
        )
        return self._solved(free, by_friction, -direction * senses[:, None] * np.ones_like(v), rates * v)

    def senses(self, rows: Array) -> Array:
        """Return the signs of the relative rates at one place, shape (joints,)."""
        return np.sign(self.rates(rows)[:, 0])

    def _solved(self, free: Array, by_friction: Array, against: Array, velocity: Array) -> Array:
        """Return frictions m of m = s (f P(m) + c) - d v by Newton's method, from none."""
        count, n = velocity.shape
        drags = (pair.law.moment if isinstance(pair.law, PinFriction) else pair.law.force for pair in self.joints)
        constant = np.stack(
            [
                drag * s - pair.law.damping * v
                for pair, drag, s, v in zip(self.joints, drags, against, velocity, strict=True)
            ]
        )
        frictions, sign = np.zeros((count, n)), np.ones(n)
        for _ in range(_ITERATIONS):
            pairs = free + np.einsum("iakn,kn->ian", by_friction, frictions)
            matrix, missing = np.zeros((n, count, count)), frictions - constant
            for i, joint in enumerate(self.joints):
                pressing, by_one, by_two = joint.pressing(pairs[i, 0], pairs[i, 1])
                share = against[i] * joint.factor
                missing[i] -= share * pressing
                matrix[:, i] = (-share * (by_one * by_friction[i, 0] + by_two * by_friction[i, 1])).T
            matrix += np.eye(count)
            move = np.linalg.solve(matrix, missing.T[..., None])[..., 0].T
            frictions = frictions - move
            sign = np.linalg.det(matrix)
            if np.all(np.abs(move) <= _SETTLED * (np.abs(frictions) + np.abs(constant) + 1e-300)):
                break
        else:
            settled = np.all(np.abs(move) <= _LOCKED * (np.abs(frictions) + 1e-300), axis=0)
            frictions = np.where(settled, frictions, np.nan)
        # without friction the determinant is one; where it has changed its sign no force balances
        return np.where(sign > 0, frictions, np.nan)
