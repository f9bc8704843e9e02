"""The search for the best design between bounds, by SciPy: with gradients from a place, or with many designs at once.

The largest of a column over a cycle has a corner where two peaks are level, which is where the least largest value
mostly stands. It is taken apart: the largest in each part of the cycle for itself must not be above a further
variable, which is made as small as can be.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.report.dataset import check_extras
from crankwork.study.box import PARTS, Box, Near
from crankwork.study.limits import Limit

Way = Literal["slsqp", "trust-constr", "evolution"]
# of the size of a value: a limit that is kept, and one that is reached
KEPT, REACHED = 1e-9, 1e-6
# of the bounds: a place that is at one
_AT_BOUND = 1e-8
# the slope of an objective over the bounds, beside its size, beside which what is left of it is judged
_FLAT = 1e-3
_ROUNDS = 100
# what stands in the place of values where there is no machine
_ABSENT = 1e3
# where an objective falls below this part of what it was it may have a corner at nothing, and its square has none
_NOTHING = 1e-2
_POPULATION, _GENERATIONS = 15, 150


class Lines(NamedTuple):
    """What is minimised at a place and what must not be below nothing, or must be nothing, with derivatives.

    `tops` are what the objective is the largest of, none where it has no corner.
    """

    value: float
    slope: Array
    above: Array
    above_slopes: Array
    level: Array
    level_slopes: Array
    tops: Array
    top_slopes: Array


class Place(NamedTuple):
    """A place that a search has come to."""

    at: Array
    value: float  # Of what is minimised, beside its size at the start
    missed: float  # The most by which a limit is missed, beside its size


class Price(NamedTuple):
    """What holds an optimum: how the objective changes with the limit or bound, and how well they explain it."""

    limits: Array  # By each limit, shape (limits,) [SI]
    low: Array  # By the lower bound of each field [SI]
    high: Array
    rest: float  # What of the gradient they leave, beside it


class Problem:
    """What is wanted of the designs between bounds: `sign` is 1 where the objective is to be least, -1 if largest."""

    def __init__(self, box: Box, objective: str, sign: float, limits: Sequence[Limit]) -> None:
        self.box, self.limits, self._sign = box, list(limits), sign
        self._row = {key: at for at, key in enumerate(box.keys)}
        self._objective = self._row[objective]
        stated = box.values(box.start)
        self.size = max(abs(float(stated[self._objective])), np.finfo(float).tiny)
        self.sizes = [max(abs(one.level), abs(float(stated[self._row[one.key]]))) or 1.0 for one in limits]
        kinds = box.is_extreme
        self.is_apart = kinds.get(objective) == ("max" if sign > 0 else "min")
        self._are_apart = [
            one.sense != "=" and kinds.get(one.key) == ("max" if one.sense == "<=" else "min") for one in limits
        ]
        self._found: dict[bytes, Lines | None] = {}
        self._absent = self._lines_of_nothing()

    def lines(self, at: Array) -> Lines | None:
        """Return what is minimised at a place, and its limits; None where there is no machine."""
        at = np.clip(at, 0.0, 1.0)
        key = at.tobytes()
        if key not in self._found:
            near = self.box.near(at)
            self._found[key] = None if near is None else self._lines(near)
        return self._found[key]

    def _lines(self, near: Near) -> Lines:
        n = near.slopes.shape[1]
        row, scale = self._objective, self._sign / self.size
        above: list[tuple[Array, Array]] = [(np.zeros(0), np.zeros((0, n)))]
        level = list(above)
        for limit, size, is_apart in zip(self.limits, self.sizes, self._are_apart, strict=True):
            of = self._row[limit.key]
            values, slopes = near.values[[of]], near.slopes[[of]]
            if is_apart and near.parts is not None:
                values, slopes = near.parts[0][of], near.parts[1][of]
            sign = -1.0 if limit.sense == "<=" else 1.0
            kept = level if limit.sense == "=" else above
            kept.append((sign * (values - limit.level) / size, sign * slopes / size))
        tops = (near.parts[0][row], near.parts[1][row]) if self.is_apart and near.parts is not None else above[0]
        rows = [np.concatenate(one) for kept in (above, level) for one in zip(*kept, strict=True)]
        value, slope = float(scale * near.values[row]), scale * near.slopes[row]
        return Lines(value, slope, rows[0], rows[1], rows[2], rows[3], scale * tops[0], scale * tops[1])

    def _lines_of_nothing(self) -> Lines:
        """Return what stands where there is no machine: worse than anything, without a slope."""
        lines = self.lines(self.box.start)
        assert lines is not None  # noqa: S101 - the start is a machine
        bad = [np.zeros_like(one) for one in lines[1:]]
        return Lines(_ABSENT, bad[0], bad[1] - _ABSENT, bad[2], bad[3] + _ABSENT, bad[4], bad[5] + _ABSENT, bad[6])

    def __call__(self, at: Array) -> Lines:
        """Return what is minimised at a place, whether or not there is a machine."""
        return self.lines(at) or self._absent

    def place(self, at: Array) -> Place:
        """Return what a search has come to."""
        at = np.clip(at, 0.0, 1.0)
        lines = self(at)
        missed = np.concatenate([-lines.above, np.abs(lines.level)])
        return Place(at, lines.value, float(np.max(missed, initial=0.0)))

    def many(self, places: Array, *, is_often: bool = False) -> tuple[Array, Array]:
        """Return what is minimised, shape (n,), and by how much each limit is missed, shape (limits, n)."""
        values = self.box.many(places, is_often=is_often)
        missed = np.array([
            [limit.missed(one) / size for one in values[self._row[limit.key]].tolist()]
            for limit, size in zip(self.limits, self.sizes, strict=True)
        ]).reshape(len(self.limits), places.shape[1])  # fmt: skip
        is_absent = ~np.isfinite(values).all(axis=0)
        found = self._sign / self.size * values[self._objective]
        return np.where(is_absent, np.inf, found), np.where(is_absent, _ABSENT, missed)

    def price(self, at: Array) -> Price:
        """Return what holds a place that is an optimum: multipliers, by least squares."""
        lines = self(at)
        n = at.size
        is_top = lines.tops >= lines.value - REACHED * max(abs(lines.value), 1e-3)
        tops = lines.top_slopes[is_top] if is_top.any() else lines.slope[None]
        is_reached = lines.above <= REACHED
        bounds = [(side, field) for side in (0, 1) for field in range(n) if abs(at[field] - side) <= _AT_BOUND]
        ways = np.array([np.eye(n)[field] * (1 - 2 * side) for side, field in bounds]).reshape(len(bounds), n)
        level = np.concatenate([lines.level_slopes, -lines.level_slopes])
        held = np.concatenate([lines.above_slopes[is_reached], level, ways])
        size = max(float(np.max(np.abs(tops))), _FLAT)
        # the tops together weigh one, and what holds balances them
        matrix = np.block([[tops.T / size, -held.T / size], [np.ones((1, len(tops))), np.zeros((1, len(held)))]])
        weights, rest = _scipy().nnls(matrix, np.append(np.zeros(n), 1.0))
        held_by = weights[len(tops) :] / max(weights[: len(tops)].sum(), np.finfo(float).tiny)
        reached, both, sides = np.split(held_by, [int(is_reached.sum()), int(is_reached.sum()) + len(level)])
        above = np.zeros(lines.above.size)
        above[is_reached] = reached
        equal = both[: lines.level.size] - both[lines.level.size :]
        low, high = np.zeros(n), np.zeros(n)
        for (side, field), weight in zip(bounds, sides, strict=True):
            (high if side else low)[field] = weight * (1 - 2 * side)
        real, span = self._sign * self.size, self.box.high - self.box.low
        return Price(self._by_limit(above, equal) * real, low * real / span, high * real / span, float(rest))

    def _by_limit(self, above: Array, level: Array) -> Array:
        """Return how what is minimised changes with each limit, of multipliers of all lines."""
        found, next_above, next_level = [], 0, 0
        for limit, size, is_apart in zip(self.limits, self.sizes, self._are_apart, strict=True):
            if limit.sense == "=":
                found.append(level[next_level] / size)
                next_level += 1
            else:
                count = PARTS if is_apart else 1
                sign = -1.0 if limit.sense == "<=" else 1.0
                found.append(sign * above[next_above : next_above + count].sum() / size)
                next_above += count
        return np.array(found)


def _scipy() -> Any:  # noqa: ANN401 - its stubs know fewer ways to call it than there are
    """Return the optimisers of SciPy."""
    check_extras("scipy")
    from scipy import optimize  # noqa: PLC0415 - an optional part

    return optimize


def searched(problem: Problem, way: Way, starts: int, seed: int, told: Callable[[float], None] | None) -> list[Place]:
    """Return the places that searches have come to, the best first: those that keep limits before those that miss."""
    box = problem.box
    first = [box.start]
    if way == "evolution":
        first = [_evolved(problem, seed)]
    elif starts > 1:
        first += _best_of(problem, box.drawn(16 * starts), starts - 1)
    local = _trusted if way == "trust-constr" else _stepped
    found = []
    for at, place in enumerate(first):
        found.append(_held(problem, place, local))
        if told is not None:
            told((at + 1) / len(first))
    return sorted(found, key=lambda one: (max(one.missed, KEPT), one.value))


def _best_of(problem: Problem, places: Array, count: int) -> list[Array]:
    """Return the best of some places, as far as they are machines."""
    values, missed = problem.many(np.ascontiguousarray(places.T))
    order = np.lexsort((values, np.maximum(missed.max(axis=0, initial=0.0), KEPT)))
    return [places[at] for at in order[:count] if np.isfinite(values[at])]


def _held(problem: Problem, start: Array, local: Callable[..., Place]) -> Place:
    """Return the best place near another; where limits are missed, the nearest to them is found first."""
    found = local(problem, start)
    if found.missed > KEPT:
        nearer = _stepped(problem, found.at, is_for_limits=True)
        if nearer.missed > KEPT:
            return nearer
        found = min(local(problem, nearer.at), nearer, key=lambda one: (max(one.missed, KEPT), one.value))
    if not problem.is_apart and 0 <= found.value < _NOTHING * problem.place(problem.box.start).value:
        squared = local(problem, found.at, power=2)
        found = min(found, squared, key=lambda one: (max(one.missed, KEPT), one.value))
    return found


def _stepped(problem: Problem, start: Array, *, power: int = 1, is_for_limits: bool = False) -> Place:
    """Return where sequential quadratic programming comes to."""
    form = _Form(problem, start, power=power, is_for_limits=is_for_limits)
    ends: list[dict[str, Any]] = [{"type": "ineq", "fun": form.above, "jac": form.above_slopes}]
    if form.has_levels:
        ends.append({"type": "eq", "fun": form.level, "jac": form.level_slopes})
    best = form.start
    # begun again with another guess of the curvature, it goes on where it stopped too early
    for _ in range(1 if problem.box.reason else 3):
        found = _scipy().minimize(
            form.value, best, jac=form.slope, method="SLSQP", bounds=form.bounds, constraints=ends,
            options={"ftol": 1e-15, "maxiter": _ROUNDS},
        )  # fmt: skip
        is_still = float(np.max(np.abs(found.x - best))) < 1e-10
        best = found.x
        if is_still:
            break
    return problem.place(best[: start.size])


def _trusted(problem: Problem, start: Array, *, power: int = 1) -> Place:
    """Return where a trust region comes to."""
    form = _Form(problem, start, power=power)
    ends = []
    if form.above(form.start).size:
        ends.append(_scipy().NonlinearConstraint(form.above, 0.0, np.inf, jac=form.above_slopes, hess=_scipy().BFGS()))
    if form.has_levels:
        ends.append(_scipy().NonlinearConstraint(form.level, 0.0, 0.0, jac=form.level_slopes, hess=_scipy().BFGS()))
    with warnings.catch_warnings():
        # that a straight line has no curvature
        warnings.simplefilter("ignore", UserWarning)
        found = _scipy().minimize(
            form.value, form.start, jac=form.slope, hess=_scipy().BFGS(), method="trust-constr", bounds=form.bounds,
            constraints=ends, options={"gtol": 1e-9, "xtol": 1e-9, "maxiter": _ROUNDS},
        )  # fmt: skip
    # from the inside of bounds and limits to them
    return _stepped(problem, problem.place(found.x[: start.size]).at, power=power)


def _evolved(problem: Problem, seed: int) -> Array:
    """Return the best place of designs that are crossed with each other, all of a generation at once."""
    ends: list[Any] = []
    if problem.limits:
        ends.append(_scipy().NonlinearConstraint(lambda at: _each(problem, at)[1], -np.inf, 0.0))
    found = _scipy().differential_evolution(
        lambda at: _each(problem, at)[0], [(0.0, 1.0)] * problem.box.start.size, constraints=ends, vectorized=True,
        updating="deferred", rng=np.random.default_rng(seed), polish=False, popsize=_POPULATION,
        maxiter=_GENERATIONS, tol=1e-6, x0=problem.box.start,
    )  # fmt: skip
    return np.asarray(found.x)


def _each(problem: Problem, places: Array) -> tuple[Any, Array]:
    """Return what `Problem.many` gives, of one place too."""
    values, missed = problem.many(places.reshape(len(places), -1), is_often=True)
    return (values, missed) if places.ndim > 1 else (values[0], missed[:, 0])


class _Form:
    """A problem as SciPy takes it: smooth, with one more variable where that takes it apart.

    With `is_for_limits` the objective is by how much limits are missed, without it a power of that of the problem.
    """

    def __init__(self, problem: Problem, start: Array, *, power: int = 1, is_for_limits: bool = False) -> None:
        self._problem, self._power, self._is_for_limits = problem, power, is_for_limits
        lines = problem(start)
        self._n = start.size
        self._has_more = is_for_limits or problem.is_apart
        more = [problem.place(start).missed if is_for_limits else lines.value] if self._has_more else []
        self.start = np.concatenate([start, more])
        self.bounds = [(0.0, 1.0)] * self._n + [(0.0, None) if is_for_limits else (None, None)] * len(more)
        self.has_levels = bool(lines.level.size) and not is_for_limits

    def value(self, z: Array) -> float:
        """Return what is minimised."""
        return float(z[self._n]) if self._has_more else float(self._problem(z).value ** self._power)

    def slope(self, z: Array) -> Array:
        """Return its derivatives."""
        if self._has_more:
            return np.append(np.zeros(self._n), 1.0)
        lines = self._problem(z)
        return np.asarray(lines.slope * (self._power * lines.value ** (self._power - 1)))

    def above(self, z: Array) -> Array:
        """Return what must not be below nothing."""
        lines = self._problem(z[: self._n])
        if self._is_for_limits:
            return np.asarray(np.concatenate([lines.above, lines.level, -lines.level]) + z[self._n])
        return np.concatenate([lines.above, z[self._n] - lines.tops]) if self._has_more else np.asarray(lines.above)

    def above_slopes(self, z: Array) -> Array:
        """Return the derivatives of what must not be below nothing."""
        lines = self._problem(z[: self._n])
        if self._is_for_limits:
            slopes = np.concatenate([lines.above_slopes, lines.level_slopes, -lines.level_slopes])
            return np.column_stack([slopes, np.ones(len(slopes))])
        if not self._has_more:
            return np.asarray(lines.above_slopes)
        slopes = np.concatenate([lines.above_slopes, -lines.top_slopes])
        return np.column_stack([slopes, np.append(np.zeros(lines.above.size), np.ones(lines.tops.size))])

    def level(self, z: Array) -> Array:
        """Return what must be nothing."""
        return np.asarray(self._problem(z[: self._n]).level)

    def level_slopes(self, z: Array) -> Array:
        """Return the derivatives of what must be nothing."""
        slopes = self._problem(z[: self._n]).level_slopes
        return np.column_stack([slopes, np.zeros(len(slopes))]) if self._has_more else np.asarray(slopes)
