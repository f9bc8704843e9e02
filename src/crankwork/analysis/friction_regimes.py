"""Where a linkage with friction locks, holds its load or has corners in its forces, over all crank angles."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from crankwork.analysis.operating_state import operating_state
from crankwork.analysis.prepared import Notice, PreparedLinkage
from crankwork.dynamics.friction import (
    Friction,
    FrictionForces,
    GuideFriction,
    PinFriction,
    friction_joints,
    solve_with_friction,
)
from crankwork.dynamics.friction_equations import CONVERGED, NO_POSITION, SELF_LOCKING, Truth
from crankwork.dynamics.operating_state import OperatingState
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion

# rows whose changes of sign divide the cycle
_CHANGES = ("margin", "ideal", "torque", "another")
_STEP = 1.0
# tolerance of the angle of a change of sign [deg]
_PLACED = 1e-10
_HALVINGS = 60


@dataclass(frozen=True)
class StepFunction:
    """A value that is constant between crank angles: each stretch owns its end. [deg]"""

    ends: tuple[float, ...]
    values: tuple[float, ...]

    def __call__(self, degrees: Array) -> Array:
        """Return the value at crank angles."""
        index = np.minimum(np.searchsorted(self.ends, degrees, side="left"), len(self.values) - 1)
        return np.asarray(self.values)[index]


@dataclass(frozen=True)
class FrictionEquilibrium:
    """The forces of a linkage with friction as a function of the crank angle; without masses where it `is_static`."""

    solved: PreparedLinkage
    senses: Mapping[Friction, StepFunction]
    is_static: bool = False
    # solved paths of its chains
    paths: dict[int, ChainPath] = field(default_factory=dict, compare=False, repr=False)

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        return self.solved.machine.cycle

    def running(self, grid: CrankGrid) -> OperatingState:
        """Return the linkage at work."""
        running = operating_state(self.solved, linkage_motion(self.solved.machine.mechanism, grid, paths=self.paths))
        return replace(running, mechanism=replace(running.mechanism, bodies=())) if self.is_static else running

    def at(self, degrees: Array, *, thorough: bool = False) -> FrictionForces:
        """Return forces, torque and status at crank angles. [deg]"""
        running = self.running(CrankGrid.from_degrees(degrees))
        senses = {key: steps(degrees) for key, steps in self.senses.items()}
        return solve_with_friction(
            running, friction_joints(running, self.solved.machine.friction, senses), thorough=thorough
        )

    def __call__(self, grid: CrankGrid) -> Array:
        """Return the pressing forces of the joints, shape (joints, n). [N]"""
        return np.stack([*self.at(grid.degrees).pressing.values()])


class FrictionRegimes:
    """Forces with friction over all crank angles: where they have corners, lock, or hold the load."""

    def __init__(self, balance: FrictionEquilibrium, span: tuple[float, float]) -> None:
        self._balance, self._span = balance, span
        start, end = span
        edges = [end for steps in balance.senses.values() for end in steps.ends]
        count = max(int(np.ceil((end - start) / _STEP)), 1)
        # values jump right after an edge
        after_edges = [edge + _PLACED / 2 for edge in edges if edge < end]
        self.degrees = np.unique([*np.linspace(start, end, count + 1), *edges, *after_edges])
        self.forces = balance.at(self.degrees, thorough=True)
        self._is_double = bool(self.forces.has_another.any())
        degrees, rows = self._with_vertices(self.degrees, self._rows_of(self.forces))
        if self._is_double:
            index = np.searchsorted(self.degrees, degrees, side="right") - 1
            rows["another"] = self._single(self.forces)[index]
        places = self._crossings(degrees, rows)
        is_known = bool(np.all(np.isin(self.forces.status, (CONVERGED, NO_POSITION))))
        self.is_free = is_known and not np.any(rows["margin"] < 0)
        self._changes = sorted({item for key in _CHANGES for item in places.get(key, ())})
        self.knots = tuple(sorted({item for place in places.values() for item in place} | set(edges)))

    def _rows(self, degrees: Array) -> dict[str, Array]:
        return self._rows_of(self._balance.at(degrees))

    @staticmethod
    def _single(forces: FrictionForces) -> Array:
        """Return -1 where another equilibrium exists, else 1."""
        return np.where(forces.has_another, -1.0, 1.0)

    def _rows_of(self, forces: FrictionForces) -> dict[str, Array]:
        """Return the quantities whose changes of sign are corners, or begin and end locking and holding."""
        locked = forces.status == SELF_LOCKING
        rows = {"margin": np.where(locked, -1.0, forces.margin), "ideal": forces.ideal_torque,
                "torque": np.asarray(forces.joint_forces.balancing_torque)}  # fmt: skip
        for law in self._balance.senses:
            if isinstance(law, GuideFriction):
                guide = forces.joint_forces.guides[law.slider]
                rows[f"{law.slider}.normal"] = np.asarray(guide.normal)
                if law.length:
                    tilting = law.tilting(np.asarray(guide.normal), np.asarray(guide.moment))
                    rows |= {f"{law.slider}.{sign}": guide.normal + sign * tilting for sign in (1, -1)}
        return rows

    def _with_vertices(self, degrees: Array, rows: dict[str, Array]) -> tuple[Array, dict[str, Array]]:
        """Return crank angles with vertices of margin and torque close to zero added, and the rows at all of them."""
        for _ in range(2):
            values = np.array([rows["margin"], rows["torque"]])
            low, middle, high = (np.abs(values[:, offset : values.shape[1] - 2 + offset]) for offset in range(3))
            curved = (middle < low) & (middle < high)
            bend = low - 2 * middle + high
            shift = np.divide(low - high, 2 * bend, out=np.zeros_like(bend), where=curved & (bend > 0))
            width = np.diff(degrees)
            place = degrees[1:-1] + shift * np.where(shift > 0, width[1:], width[:-1])
            new = np.setdiff1d(place[curved & (shift != 0)], degrees)
            if new.size:
                order = np.argsort(np.concatenate([degrees, new]))
                degrees = np.concatenate([degrees, new])[order]
                rows = {key: np.concatenate([rows[key], value])[order] for key, value in self._rows(new).items()}
        return degrees, rows

    def _crossings(self, degrees: Array, rows: Mapping[str, Array]) -> dict[str, list[float]]:
        """Return where rows change their signs, or begin or end to be NaN."""
        crossings: dict[str, list[float]] = {}
        brackets: list[tuple[int, int]] = []
        for number, (key, row) in enumerate(rows.items()):
            tolerance = 1e-13 * np.nanmax(np.abs(row), initial=0.0)
            signs = np.where(np.isnan(row), 2.0, np.sign(np.where(np.abs(row) <= tolerance, 0.0, row)))
            index = np.flatnonzero(signs[1:] != signs[:-1])
            ends = np.concatenate([index[signs[index] == 0], index[signs[index + 1] == 0] + 1])
            crossings[key] = degrees[ends].tolist()
            brackets += [(number, item) for item in index[(signs[index] != 0) & (signs[index + 1] != 0)].tolist()]
        if brackets:
            number, index = np.array(brackets).T
            values = np.array([*rows.values()])

            def value_at(places: Array, active: Truth) -> Array:
                by_key, row = self._rows(places), number[active]
                if self._is_double:
                    mask = row == keys.index("another")
                    by_key["another"] = np.ones(places.size)
                    if mask.any():
                        by_key["another"][mask] = self._single(self._balance.at(places[mask], thorough=True))
                return np.asarray(np.array([by_key[key] for key in keys])[row, np.arange(places.size)])

            keys = [*rows]
            ends_of = values[number, index], values[number, index + 1]
            placed = _between(value_at, degrees[index], degrees[index + 1], ends_of)
            for item, place in zip(number.tolist(), placed.tolist(), strict=True):
                crossings[keys[item]].append(place)
        return crossings

    @property
    def drives(self) -> StepFunction:
        """Driving side: 1 the crank, -1 the load, 0 where neither moves the other."""
        edges, middles = self._stretches()
        result, torques = self._balance.at(middles), self.forces.ideal_torque
        ideal, actual = result.ideal_torque, np.asarray(result.joint_forces.balancing_torque)
        least = 1e-12 * np.max(np.abs(torques), initial=0.0, where=np.isfinite(torques))
        both = np.where(np.minimum(ideal, actual) > least, 1.0, np.where(np.maximum(ideal, actual) < -least, -1.0, 0.0))
        return StepFunction(tuple(edges[1:].tolist()), tuple(both.tolist()))

    def _stretches(self) -> tuple[Array, Array]:
        """Return the edges of stretches in which nothing changes, and their middles. [deg]"""
        inner = [change for change in self._changes if self._span[0] + _PLACED < change < self._span[1] - _PLACED]
        edges = np.array([self._span[0], *inner, self._span[1]])
        return edges, (edges[1:] + edges[:-1]) / 2

    def notices(self, solved: PreparedLinkage, codes: Sequence[str]) -> Iterator[Notice]:
        """Yield notices where friction locks the driver or holds the load, or forces are not found or not unique.

        `codes`: of the notices to yield.
        """
        edges, middles = self._stretches()
        result = self._balance.at(middles, thorough=self._is_double)
        period = 0.0
        if solved.machine.mechanism.driver.law is not None:
            period = solved.machine.mechanism.driver.law.period / 360.0
        conditions = {
            "self_locking": result.status == SELF_LOCKING,
            "not_balanced": ~np.isin(result.status, (CONVERGED, SELF_LOCKING, NO_POSITION)),
            "two_balances": result.has_another,
            "friction_holds": (result.status == CONVERGED) & result.held,
        }
        # viscous friction alone holds no load
        is_dry = any(_is_dry(item) for item in solved.machine.friction)
        for code, is_so in conditions.items():
            if code in codes and (is_dry or code != "friction_holds"):
                yield from self._runs(code, edges, is_so, period)

    def _runs(self, code: str, edges: Array, is_so: Truth, period: float) -> Iterator[Notice]:
        """Yield a notice for each run of stretches, over the end of a cycle, too; times where a law drives. [s/deg]"""
        change = np.flatnonzero(np.diff(np.concatenate([[False], is_so, [False]]).astype(int)))
        runs = [
            (edges[first], edges[min(after, edges.size - 1)]) for first, after in zip(*[iter(change)] * 2, strict=True)
        ]
        start, end = self._span
        if len(runs) > 1 and (runs[0][0], runs[-1][1]) == (start, end) and end - start >= self._balance.cycle:
            runs = [*runs[1:-1], (runs[-1][0], runs[0][1])]
        suffix, scale = ("_time", period) if period else ("", 1.0)
        for low, high in runs:
            yield Notice(f"{code}{suffix}", {"from": float(low * scale), "to": float(high * scale)})


def _between(value_at: Callable[[Array, Truth], Array], low: Array, high: Array, ends: tuple[Array, Array]) -> Array:
    """Return where functions change their sign between two places each: Ridders' method, halving where they jump.

    `value_at` gives the functions in a mask at places. NaN counts as a sign of its own. `ends`: their values at both
    places.
    """
    (low, high), (first, last) = (low.copy(), high.copy()), (end.copy() for end in ends)
    for _ in range(_HALVINGS):
        active = high - low > _PLACED
        if not active.any():
            break
        a, b, at_a, at_b = low[active], high[active], first[active], last[active]
        middle = (a + b) / 2
        value = value_at(middle, active)
        with np.errstate(all="ignore"):
            root = np.sqrt(value**2 - at_a * at_b)
            nearer = middle + (middle - a) * np.sign(at_a - at_b) * value / root
        # a step beyond the root narrows the bracket from the other side, too
        beyond = np.clip(nearer + np.sign(nearer - middle) * _PLACED / 4, a, b)
        for candidate in (middle, nearer, beyond):
            place = np.where(np.isfinite(candidate), np.clip(candidate, a, b), middle)
            new_value = value if candidate is middle else value_at(place, active)
            is_inside = (place >= a) & (place <= b)
            same = is_inside & (_sign(new_value) == _sign(at_a))
            other = is_inside & ~same
            a, at_a = np.where(same, place, a), np.where(same, new_value, at_a)
            b, at_b = np.where(other, place, b), np.where(other, new_value, at_b)
        low[active], high[active], first[active], last[active] = a, b, at_a, at_b
    return np.asarray((low + high) / 2)


def _sign(values: Array) -> Array:
    return np.where(np.isnan(values), 2.0, np.where(values < 0, -1.0, 1.0))


def _is_dry(law: Friction) -> bool:
    """Return whether a law of friction has a part that does not vanish with the speed."""
    return bool(law.coefficient or (law.moment if isinstance(law, PinFriction) else law.force))
