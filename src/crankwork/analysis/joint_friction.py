"""A linkage with friction in its joints: torque, forces, losses, efficiency, and where it locks or holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.mechanism_trace import joint_columns
from crankwork.analysis.operating_state import operating_state
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import (
    Friction,
    FrictionForces,
    GuideFriction,
    PinFriction,
    friction_couple,
    friction_force,
    friction_joints,
    friction_power_of_guide,
    friction_power_of_pin,
    friction_radius,
    friction_radius_of_angle,
    friction_torque,
    instantaneous_efficiency,
    pressing_force,
    relative_rate,
    solve_with_friction,
    tilting_force,
)
from crankwork.dynamics.friction_equations import CONVERGED, NO_POSITION, SELF_LOCKING, Truth
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.routes import torque_by_energy
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import (
    Component,
    Piecewise,
    ProcedureValue,
    Root,
    TracedValue,
    absent,
    breakpoints_of,
    given,
    reached,
    total,
)
from crankwork.kinematics import kinematic_coefficients as rates
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion, broadcast, linkage_motion
from crankwork.kinematics.traced_motion import interpolant_of
from crankwork.loads.applied_loads import AppliedLoads, force_on_slider, torque_on
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.preparation.prepared import Notice, PreparedLinkage, relative_difference

# rows whose changes of sign divide the cycle
_CHANGES = ("margin", "ideal", "torque", "another")
_STEP = 1.0
# tolerance of the angle of a change of sign, and the width of its bracket, in which values may jump [deg]
_PLACED, _NARROW = 1e-10, 1e-12
# where changes of sign are looked for between two places: around the zero of a line, and evenly, as values may jump
_AROUND = np.outer((-1, 1), 10.0 ** -np.arange(1, 9)).ravel()
_EVENLY = np.arange(1, 16) / 16


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
        self.balance, self._span = balance, span
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
        # where a guide is pressed by another side, and what else the forces jump at
        self.corners = {key: tuple(sorted(ends)) for key, ends in places.items() if key not in _CHANGES}
        self.jumps = tuple(item for key in ("margin", "another") for item in places.get(key, ()))

    def _rows(self, degrees: Array) -> dict[str, Array]:
        return self._rows_of(self.balance.at(degrees))

    @staticmethod
    def _single(forces: FrictionForces) -> Array:
        """Return -1 where another equilibrium exists, else 1."""
        return np.where(forces.has_another, -1.0, 1.0)

    def _rows_of(self, forces: FrictionForces) -> dict[str, Array]:
        """Return the quantities whose changes of sign are corners, or begin and end locking and holding."""
        locked = forces.status == SELF_LOCKING
        rows = {"margin": np.where(locked, -1.0, forces.margin), "ideal": forces.ideal_torque,
                "torque": np.asarray(forces.joint_forces.balancing_torque)}  # fmt: skip
        for law in self.balance.senses:
            if isinstance(law, GuideFriction):
                guide = forces.joint_forces.guides[law.slider]
                tilting = law.tilting(np.asarray(guide.normal), np.asarray(guide.moment))
                rows |= {f"{law.slider}.{sign}": guide.normal + sign * tilting for sign in law.sides}
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

            def value_at(places: Array, index: NDArray[np.intp]) -> Array:
                by_key, row = self._rows(places), number[index]
                if self._is_double:
                    mask = row == keys.index("another")
                    by_key["another"] = np.ones(places.size)
                    if mask.any():
                        by_key["another"][mask] = self._single(self.balance.at(places[mask], thorough=True))
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
        result, torques = self.balance.at(middles), self.forces.ideal_torque
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
        result = self.balance.at(middles, thorough=self._is_double)
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
        if len(runs) > 1 and (runs[0][0], runs[-1][1]) == (start, end) and end - start >= self.balance.cycle:
            runs = [*runs[1:-1], (runs[-1][0], runs[0][1])]
        suffix, scale = ("_time", period) if period else ("", 1.0)
        for low, high in runs:
            yield Notice(f"{code}{suffix}", {"from": float(low * scale), "to": float(high * scale)})


def _between(
    value_at: Callable[[Array, NDArray[np.intp]], Array], low: Array, high: Array, ends: tuple[Array, Array]
) -> Array:
    """Return where functions change their sign between two places each, also where they jump.

    `value_at` gives those of some brackets at places. NaN counts as a sign of its own. `ends`: values at both places.
    """
    (low, high), values = (low.copy(), high.copy()), np.array(ends)
    while (left := np.flatnonzero(high - low > _NARROW)).size:
        shares = np.clip(_zero_of_line(*values[:, left])[:, None] + _AROUND, 0.0, 1.0)
        shares = np.sort(np.concatenate([shares, np.tile(_EVENLY, (left.size, 1))], axis=1), axis=1)
        places = low[left, None] + (high - low)[left, None] * shares
        inside = value_at(places.ravel(), np.repeat(left, shares.shape[1])).reshape(places.shape)
        places, inside = (
            np.column_stack([start[left], between, end[left]])
            for between, (start, end) in ((places, (low, high)), (inside, values))
        )
        # the first place that has not the sign of the lower end
        is_other = _sign(inside[:, 1:-1]) != _sign(inside[:, :1])
        after = np.argmax(np.concatenate([is_other, np.ones((left.size, 1), bool)], axis=1), axis=1)
        rows = np.arange(left.size)
        low[left], high[left] = (places[rows, after + side] for side in (0, 1))
        values[:, left] = [inside[rows, after + side] for side in (0, 1)]
    return np.asarray(low + (high - low) * _zero_of_line(*values))


def _zero_of_line(first: Array, last: Array) -> Array:
    """Return where lines between values at 0 and at 1 are zero, the middle where they are not."""
    with np.errstate(all="ignore"):
        share = first / (first - last)
    return np.where(np.isfinite(share), share, 0.5)


def _sign(values: Array) -> Array:
    return np.where(np.isnan(values), 2.0, np.where(values < 0, -1.0, 1.0))


def _is_dry(law: Friction) -> bool:
    """Return whether a law of friction has a part that does not vanish with the speed."""
    return bool(law.coefficient or (law.moment if isinstance(law, PinFriction) else law.force))


COLUMNS = (
    "torque_with_friction", "static_torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction",
    "instantaneous_efficiency", "friction_power", "friction_torque", "friction_force", "joint_force_with_friction_x",
    "joint_force_with_friction_y", "joint_force_with_friction", "normal_force_with_friction",
    "normal_moment_with_friction",
)  # fmt: skip
# columns whose extremes are taken if the forces balance everywhere
FOLLOWED = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "friction_power",
    "joint_force_with_friction", "static_torque_with_friction",
)  # fmt: skip
_OF_MOTION = ("self_locking", "not_balanced", "two_balances")
_REST = 1e-12
_CLOSE = 1e-6


class FrictionColumns(NamedTuple):
    """Results that friction adds to those of a linkage: columns, checks, notices, and whether it never locks."""

    columns: dict[str, TracedValue]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    is_free: bool


# quantities of the numbers that are stated of a joint with friction by field, and the units of their display
STATED = {
    PinFriction: {
        "coefficient": ("pin_friction", ""), "radius": ("pin_radius", "mm"), "moment": ("constant_moment", "N*m"),
        "damping": ("angular_damping", "N*m*s/rad"),
    },
    GuideFriction: {
        "coefficient": ("guide_friction", ""), "length": ("piece_length", "mm"), "middle_x": ("piece_middle_x", "mm"),
        "middle_y": ("piece_middle_y", "mm"), "force": ("constant_force", "N"), "damping": ("damping", "N*s/m"),
    },
}  # fmt: skip


class _Place(NamedTuple):
    """A joint with friction, its law, its name in columns, and where the description states the law."""

    joint: Joint
    law: Friction
    name: str
    path: str


def add_friction(solved: PreparedLinkage, running: OperatingState, trace: Mapping[str, TracedValue]) -> FrictionColumns:
    """Return the results that friction adds to a linkage at work (artobolevsky_1988, ch. 11 and 14).

    `running`: the linkage at work, traced; `trace`: its columns without friction.
    """
    if not solved.machine.friction:
        return FrictionColumns({}, {}, (), is_free=False)
    motion = running.motion
    places, span = list(_places(solved)), _span(motion)
    velocities = {place.law: _velocity(motion, place, running.speed) for place in places}
    senses = _senses(motion, velocities)
    balance = FrictionEquilibrium(solved, senses)
    regimes = FrictionRegimes(balance, span)
    traced = {place.law: _sense(senses[place.law], velocities[place.law], place.name) for place in places}
    root, friction, forces = _with_friction(places, velocities, traced, regimes, running)
    columns = {value.key: value for value in friction.values()}
    powers = [_power(place, friction[place.law], velocities[place.law]) for place in places]
    columns |= {power.key: power for power in powers} | {"friction_power": total("friction_power", powers)}
    columns |= joint_columns(solved.machine, forces, "_with_friction")
    notices, standing, is_free = [*regimes.notices(solved, _OF_MOTION)], regimes, regimes.is_free
    if solved.machine.mechanism.driver.law is not None:
        kind = "driver_torque" if solved.machine.mechanism.driver.turns else "driver_force"
        columns[f"{kind}_with_friction"] = forces.balancing_torque
    else:
        columns["torque_with_friction"] = forces.balancing_torque
        still = FrictionEquilibrium(solved, senses, is_static=True)
        static = forces.balancing_torque
        if solved.machine.mechanism.bodies:
            standing = FrictionRegimes(still, span)
            alone = replace(running, mechanism=replace(running.mechanism, bodies=()))
            static = _with_friction(places, velocities, traced, standing, alone)[2].balancing_torque
            is_free &= standing.is_free
        static = static.named("static_torque_with_friction")
        columns |= {static.key: static} | _efficiency(trace["static_torque"], static, standing)
    notices += standing.notices(solved, ("friction_holds",))
    checks = _checks(balance, regimes, columns, root)
    return FrictionColumns({key: value.named(key) for key, value in columns.items()}, checks, tuple(notices), is_free)


def mean_values(over: CycleInterpolant) -> Iterator[TracedValue]:
    """Yield the mean loss over a cycle, and the efficiency that the work of a cycle gives; nothing without friction."""
    if "friction_power" in over.columns:
        yield over.mean("friction_power", "mean_friction_power")
    if "torque_with_friction" in over.columns:
        keys = "static_torque", "torque_with_friction"
        ideal, actual = (over.mean(key, f"{key}.mean") for key in keys)
        if 0 < ideal.value <= actual.value:
            yield instantaneous_efficiency(ideal, actual).named("mean_efficiency")


def _places(solved: PreparedLinkage) -> Iterator[_Place]:
    """Yield the joints with friction."""
    machine, held = solved.machine, all_links_and_joints(solved.machine.mechanism)[1]
    for law in machine.friction:
        kind, name = (SlidingJoint, law.slider) if isinstance(law, GuideFriction) else (Pin, law.joint)
        joint = next(item for item in held if isinstance(item, kind) and item.name == name)
        shown = names_of_pivots(solved.machine.mechanism).get(name, name) if kind is Pin else name
        yield _Place(joint, law, shown, f"friction.{'pins' if kind is Pin else 'sliders'}.{shown}")


def _span(motion: Motion) -> tuple[float, float]:
    """Return the first and the last crank angle of a motion. [deg]"""
    over = interpolant_of(motion.grid)({})
    return float(over.edges[0]), float(over.edges[-1])


def _velocity(motion: Motion, place: _Place, w: TracedValue) -> TracedValue:
    """Return the relative angular or sliding velocity of the links of a joint."""
    rate = broadcast(relative_rate(motion, place.joint), motion.grid)
    if isinstance(place.joint, Pin):
        velocity: TracedValue = rates.link_angular_velocity(rate, w).named(f"relative_speed.{place.name}")
    else:
        velocity = rates.slider_velocity(rate, w).named(f"slider_velocity.{place.name}")
    return velocity


def _senses(motion: Motion, velocities: Mapping[Friction, TracedValue]) -> dict[Friction, StepFunction]:
    """Return the direction of the friction of each joint: against the velocity, none where a law dwells."""
    varying = {str(index): velocity for index, velocity in enumerate(velocities.values()) if velocity.varies}
    over = interpolant_of(motion.grid)(varying)
    end, steps = float(over.edges[-1]), []
    middles = (over.edges[1:] + over.edges[:-1]) / 2
    size = {
        index: max(float(np.max(np.abs(over.at(str(index), middles)))) if velocity.varies else abs(velocity.value), 0.0)
        for index, velocity in enumerate(velocities.values())
    }
    kinds = [isinstance(law, GuideFriction) for law in velocities]
    for index, velocity in enumerate(velocities.values()):
        ends, values = [end], [-float(np.sign(velocity.node.value or 0.0))]
        if velocity.varies:
            # at the start and the end of a cycle rounding decides on which side a dead centre is
            crossings = [item for item in over.crossings(str(index)) if np.abs(over.breaks - item).min() > _PLACED * 10]
            edges = np.unique([float(over.edges[0]), *over.breaks, *crossings, end])
            inside = over.at(str(index), (edges[1:] + edges[:-1]) / 2)
            largest = max(size[other] for other, kind in enumerate(kinds) if kind == kinds[index])
            signs = np.where(np.abs(inside) > _REST * largest, -np.sign(inside), 0.0)
            kept = np.append(np.diff(signs) != 0, True)
            ends, values = edges[1:][kept].tolist(), signs[kept].tolist()
        steps.append(StepFunction(tuple(ends), tuple(values)))
    return dict(zip(velocities, steps, strict=True))


def _with_friction(
    places: Sequence[_Place],
    velocities: Mapping[Friction, TracedValue],
    senses: Mapping[Friction, TracedValue],
    regimes: FrictionRegimes,
    running: OperatingState,
) -> tuple[Root, dict[Friction, TracedValue], JointForces]:
    """Return the pressing forces of the joints, the friction of each, and the joint forces with it.

    The pressing forces of all joints are found together; the difference of each from the force in its joint is the
    residual of an equation.
    """
    root = Root(regimes.balance)
    friction, loads, pressing = dict[Friction, TracedValue](), AppliedLoads(), dict[Friction, TracedValue]()
    for index, place in enumerate(places):
        kind = "joint_force_with_friction" if isinstance(place.joint, Pin) else "pressing_force"
        pressing[place.law] = TracedValue(Component(root, index), f"{kind}.{place.name}")
        value = friction[place.law] = _law(place, senses[place.law], pressing[place.law], velocities[place.law])
        loads = loads.also(_on_links(running, place, value))
    forces = joint_forces(replace(running, loads=running.loads.also(loads)))
    root.residuals = tuple(_missing(place, pressing[place.law], forces) for place in places)
    root.sides = tuple(_sides(places, senses.values(), forces, regimes.corners))
    corners = (item for ends in regimes.corners.values() for item in ends)
    root.knots = (*regimes.jumps, *corners, *(item for steps in regimes.balance.senses.values() for item in steps.ends))
    return root, friction, forces


def _sides(
    places: Sequence[_Place],
    senses: Iterable[TracedValue],
    forces: JointForces,
    corners: Mapping[str, tuple[float, ...]],
) -> Iterator[tuple[TracedValue, tuple[TracedValue, ...]]]:
    """Yield what presses at each end of a sliding piece, with where it goes to the other side of the guide."""
    pieces = [sense.node for sense in senses if isinstance(sense.node, Piecewise)]
    jumps = [place for node in pieces for place in node.places if isinstance(place, TracedValue)]
    for place in places:
        if isinstance(place.law, GuideFriction):
            normal, tilting = forces.guides[place.joint.name].normal, _tilting(place, place.law, forces)
            for sign in place.law.sides:
                column = normal + tilting if sign > 0 else normal - tilting
                ends = corners.get(f"{place.joint.name}.{sign}", ())
                # it may jump to the other side where friction changes its direction
                close = ([jump for jump in jumps if abs(jump.value - end) < _CLOSE] for end in ends)
                yield column, tuple((*near, reached(column, end))[0] for near, end in zip(close, ends, strict=True))


def _sense(steps: StepFunction, velocity: TracedValue, name: str) -> TracedValue:
    values = tuple(
        TracedValue(ProcedureValue(value, "against", (velocity,)), "friction_sense") for value in steps.values
    )
    # a law of the driver may jump where it does not pass zero
    fixed = {*breakpoints_of((velocity,), steps.ends[-1]).tolist(), steps.ends[-1]}
    ends = [end if end in fixed else reached(velocity, end) for end in steps.ends]
    return (values[0] if len(values) == 1 else TracedValue(Piecewise(ends, values))).named(f"friction_sense.{name}")


def _stated(place: _Place, name: str) -> TracedValue:
    """Return a number of the friction in a joint; `name`: of its field."""
    value, (key, _) = getattr(place.law, name), STATED[type(place.law)][name]
    path = f"sliders.{place.name}.points" if name.startswith("middle") else f"{place.path}.{name}"
    return given(f"{key}.{place.name}", value, path) if value else absent(key)


def _law(place: _Place, sense: TracedValue, pressing: TracedValue, velocity: TracedValue) -> TracedValue:
    """Return the friction moment or force on the link that a joint holds."""
    law, name = place.law, place.name
    if isinstance(law, GuideFriction):
        coefficient = _stated(place, "coefficient")
        constant = _stated(place, "force")
        damping = _stated(place, "damping")
        force: TracedValue = friction_force(sense, coefficient, pressing, constant, damping, velocity)
        return force.named(f"friction_force.{name}")
    circle = friction_radius if law.circle == "tangent" else friction_radius_of_angle
    radius: TracedValue = absent("friction_radius")
    if law.coefficient:
        coefficient = _stated(place, "coefficient")
        radius = circle(coefficient, _stated(place, "radius"))
        radius = radius.named(f"friction_radius.{name}")
    constant = _stated(place, "moment")
    damping = _stated(place, "damping")
    moment: TracedValue = friction_torque(sense, radius, pressing, constant, damping, velocity)
    return moment.named(f"friction_torque.{name}")


def _on_links(running: OperatingState, place: _Place, value: TracedValue) -> AppliedLoads:
    """Return the friction of a joint as loads on its two links."""
    joint, law = place.joint, place.law
    if isinstance(law, PinFriction):
        return _torque_between(running, joint, value)
    force = force_on_slider(running.mechanism, running.motion, joint.link, value, ".friction")
    if not law.middle[1]:
        return force
    couple: TracedValue = friction_couple(value, _stated(place, "middle_y")).named(f"friction_couple.{place.name}")
    return force.also(_torque_between(running, joint, couple))


def _torque_between(running: OperatingState, joint: Joint, torque: TracedValue) -> AppliedLoads:
    """Return a torque on the link that a joint holds, and its reaction on the other."""
    own = torque_on(running.motion, joint.link, torque)
    return own if joint.other == GROUND else own.also(torque_on(running.motion, joint.other, -torque))


def _missing(place: _Place, pressing: TracedValue, forces: JointForces) -> TracedValue:
    """Return the difference of the pressing force of a joint from the force in it."""
    law, name = place.law, place.joint.name
    if isinstance(place.joint, Pin):
        force: TracedValue = forces.pins[name].resultant
        return pressing - force.named(f"joint_force.{place.name}")
    pressed: TracedValue = pressing_force(forces.guides[name].normal, _tilting(place, law, forces))
    return pressing - pressed.named(f"pressing_force.{place.name}")


def _tilting(place: _Place, law: Friction, forces: JointForces) -> TracedValue:
    """Return the difference of the forces that press at both ends of a sliding piece."""
    if not isinstance(law, GuideFriction) or not law.length:
        return absent("tilting_force")
    guide, length = forces.guides[place.joint.name], _stated(place, "length")
    tilting: TracedValue = tilting_force(guide.moment, guide.normal, _stated(place, "middle_x"), length)
    return tilting.named(f"tilting_force.{place.name}")


def _power(place: _Place, friction: TracedValue, velocity: TracedValue) -> TracedValue:
    formula = friction_power_of_guide if isinstance(place.law, GuideFriction) else friction_power_of_pin
    power: TracedValue = formula(friction, velocity)
    return power.named(f"friction_power.{place.name}")


def _efficiency(ideal: TracedValue, actual: TracedValue, regimes: FrictionRegimes) -> dict[str, TracedValue]:
    """Return the efficiency, of the crank as driver or of the load; none where neither moves the other."""
    laws = {
        1: instantaneous_efficiency(ideal, actual),
        -1: instantaneous_efficiency(actual, ideal),
        0: absent("instantaneous_efficiency", np.nan),
    }
    steps = regimes.drives
    if not any(steps.values):
        return {}
    return {
        "instantaneous_efficiency": TracedValue(
            Piecewise(steps.ends, tuple(laws[int(value)] for value in steps.values))
        )
    }


def _checks(
    balance: FrictionEquilibrium, regimes: FrictionRegimes, columns: Mapping[str, TracedValue], root: Root
) -> dict[str, float]:
    """Return the error of the power balance, and the difference of forces found joint by joint from all at once."""
    # where loads jump with the friction or at an end, rounding decides which side an angle is on
    is_clear = np.diff(regimes.degrees, prepend=regimes.degrees[0], append=regimes.degrees[-1]) > _CLOSE
    degrees = regimes.degrees[(regimes.forces.status == CONVERGED) & is_clear[1:] & is_clear[:-1]]
    if not degrees.size:
        return {}
    grid = CrankGrid.from_degrees(degrees)
    values, running = balance.at(degrees), balance.running(grid)
    power = running.speed * np.asarray(values.joint_forces.balancing_torque)
    key = next(item for item in FOLLOWED if item in columns)
    missing = {str(index): residual for index, residual in enumerate(root.residuals)}
    torque, loss, *missed = Program({"": columns[key], "loss": columns["friction_power"], **missing})(grid).values()
    # a pressing force of zero has the rounding error of the other forces
    sizes = [*values.pressing.values(), *(np.asarray(pin.resultant) for pin in values.joint_forces.pins.values())]
    largest = max(float(np.max(size)) for size in sizes)
    return {
        "friction_power": relative_difference(running.speed * torque_by_energy(running) + loss, power),
        "friction_forces": max(
            relative_difference(torque, np.asarray(values.joint_forces.balancing_torque)),
            float(np.max(np.abs(missed))) / largest if largest else 0.0,
        ),
    }
