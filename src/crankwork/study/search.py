"""Search for the best design between bounds by SciPy, with gradients from a point or with differential evolution.

Designs have single values with derivatives. The largest value of a column over a cycle has a corner where two peaks are
equal, which is where its minimum usually is. Such an objective is split: the largest value in each part of the cycle
must not exceed a further variable, which is minimised.
"""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, MissingExtraError, UnknownKeyError, missing_extras
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.gradient import part_key
from crankwork.kernel.lowering import NotCompiledError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.study.variants import MachineVariants, single, threaded
from crankwork.study.varied_field import level, stated_limit
from crankwork.units import System

# parts of the cycle, each with its own extremes
PARTS = 24
# designs drawn if the stated design cannot be analysed
_MAX_TRIES = 100
# further points to compile the calculation at, and the half width of the range there, as a fraction of the bounds
_FURTHER_POINTS, _AROUND = 3, 0.02
# step of finite differences without a compiled calculation, as a fraction of the bounds
_STEP = 3e-5
# relative difference of equal values
_SAME = 1e-9
# rounding of a point at a bound
_ROUNDING = 1e-12
SearchMethod = Literal["slsqp", "trust-constr", "evolution"]
# relative tolerances of a satisfied limit and of an active one
KEPT, REACHED = 1e-9, 1e-6
# distance of a point from an active bound
_AT_BOUND = 1e-8
# least relative slope of an objective over the bounds to which the residual is compared
_FLAT = 1e-3
_ROUNDS = 100
# value in the place of all values if there is no machine
_ABSENT = 1e3
# below this fraction of its start an objective may have a corner at zero; its square has none
_NEAR_ZERO = 1e-2
_POPULATION, _GENERATIONS = 15, 150
Sense = Literal["<=", ">=", "="]
_FORM = re.compile(r"\s*(?P<key>[^<>=\s]+)\s*(?P<sense><=|>=|=)\s*(?P<level>[^<>=]+?)\s*")
_EXAMPLE = "stroke >= 80 mm"


class LocalModel(NamedTuple):
    """Single values of a design, shape (keys,), and their derivatives by the point, shape (keys, fields).

    `parts`: values and derivatives of the extremes in each part of the cycle, shape (keys, parts) and (keys, parts,
    fields).
    """

    values: Array
    slopes: Array
    parts: tuple[Array, Array] | None


def _in_si(number: NumericField, stated: float | str) -> float | None:
    """Return a bound in SI; text without a unit is in the unit of the file."""
    return stated_limit(number, stated if isinstance(stated, str) else str(number.written(float(stated))), number.key)


class DesignSpace:
    """Designs between bounds. A point is 0 at the lower bound of a field and 1 at the upper bound.

    `seen` is called with every design that is calculated and its values.
    """

    def __init__(  # noqa: PLR0913 - fields, bounds and results
        self,
        description: Description,
        bounds: Mapping[str, tuple[float | str, float | str]],
        keys: Sequence[str],
        *,
        start: Mapping[str, float | str],
        overrides: Sequence[str | Setting],
        seed: int,
        seen: Callable[[Array, Array], None],
    ) -> None:
        values = description.values_with(overrides)
        numbers = {key: numeric_field(values, key, "") for key in (*bounds, *start)}
        self.numbers = {key: numbers[key] for key in bounds}
        self.low, self.high = (
            np.array([_in_si(numbers[key], pair[end]) for key, pair in bounds.items()], dtype=float) for end in (0, 1)
        )
        for key, bound, low, high in zip(bounds, bounds.values(), self.low, self.high, strict=True):
            if not low < high:
                raise CrankworkError(ErrorMessage("bounds_empty", key=key, low=str(bound[0]), high=str(bound[1])))
        stated = {key: _in_si(numbers[key], value) for key, value in start.items()}
        for key, low, high in zip(bounds, self.low, self.high, strict=True):
            if not low <= stated.get(key, low) <= high:
                ends = {"low": str(bounds[key][0]), "high": str(bounds[key][1])}
                raise CrankworkError(ErrorMessage("limit_outside", option="start", key=key, **ends))
        middle = (self.low + self.high) / 2
        now = [stated.get(key, numbers[key].now) for key in bounds]
        first = np.clip(
            [half if value is None else value for value, half in zip(now, middle, strict=True)], self.low, self.high
        )
        self.keys, self._seen, self._seed = list(keys), seen, seed

        def around(design: Array, part: float = 1.0) -> MachineVariants:
            low, high = (design + sign * part * (self.high - self.low) for sign in (-1, 1))
            spans = np.array([np.maximum(low, self.low), design, np.minimum(high, self.high)]).T
            return MachineVariants(description, self.numbers, spans, keys, overrides)

        self._machines, self.start = self._first(around, first, is_stated=bool(start))
        self._kernel: Kernel | None = None
        self._many: Kernel | None = None
        self.reason = self._compiled(around)
        self._found: dict[bytes, LocalModel | Array] = {}
        self.is_extreme = self._extremes()

    def _compiled(self, around: Callable[..., MachineVariants]) -> str:
        """Compile the calculation; return the reason if that fails.

        The calculation may take other branches far from the start, or if a number is zero; then a narrower range is
        tried.
        """
        reason = ""
        places = [self.start, self.start, *self.sample(_FURTHER_POINTS)]
        for attempt, place in enumerate(places):
            try:
                varied = around(self.design(place), 1.0 if attempt == 0 else _AROUND)
                kernel = varied.kernel(parts=PARTS, is_for_few=True)
                varied.check_at(kernel, self.design(self.start))
            except NotCompiledError as error:
                reason = reason or error.reason
                if reason not in ("absent", "ways"):
                    break
            except CrankworkError:
                continue
            else:
                self._machines, self._kernel = varied, kernel
                return ""
        return reason

    def use_full_analyses(self, reason: str) -> None:
        """Discard the compiled calculation and analyse each design."""
        self._kernel, self.reason, self.is_extreme = None, reason, {}
        self._found.clear()

    def _first(
        self, around: Callable[..., MachineVariants], first: Array, *, is_stated: bool
    ) -> tuple[MachineVariants, Array]:
        """Return the variants around the first design that can be analysed, stated or drawn, and its point."""
        reasons: dict[str, list[str]] = {}
        drawn = self.low + self.sample(_MAX_TRIES) * (self.high - self.low)
        for design in [first, *drawn]:
            try:
                return around(design), (design - self.low) / (self.high - self.low)
            except UnknownKeyError as error:
                if getattr(error.args[0], "name", "") not in ("result_absent", "result_absent_near"):
                    raise
                reason = error.args[0]
            except CrankworkError as error:
                if is_stated:
                    raise CrankworkError(ErrorMessage("start_absent", reason=error.args[0])) from None
                reason = error.args[0]
            reasons.setdefault(getattr(reason, "name", ""), []).append(reason)
        most = max(reasons.values(), key=len)[0]
        raise CrankworkError(ErrorMessage("bounds_absent", count=str(_MAX_TRIES + 1), reason=most))

    def _extremes(self) -> dict[str, str]:
        """Return the values that are the extreme of those in the parts of the cycle, with "max" or "min"."""
        if self._kernel is None:
            return {}
        near = self.local_model(self.start)
        extremes = {}
        for row, key in enumerate(self.keys):
            if near is None or near.parts is None or np.isnan(near.parts[0][row]).any():
                continue
            size = _SAME * abs(near.values[row])
            for kind, best in (("max", near.parts[0][row].max()), ("min", near.parts[0][row].min())):
                if abs(best - near.values[row]) <= size:
                    extremes[key] = kind
        return extremes

    @property
    def units(self) -> System:
        """System of units of the machine."""
        return self._machines.stated.machine.units

    def sample(self, count: int) -> Array:
        """Return points spread evenly between the bounds, shape (count, fields)."""
        check_scipy(ErrorMessage("extra_study"))
        from scipy.stats import qmc  # noqa: PLC0415 - an optional part

        return np.asarray(qmc.LatinHypercube(self.low.size, rng=np.random.default_rng(self._seed)).random(count))

    def design(self, place: Array) -> Array:
        """Return the numbers of the design at a point. [SI]"""
        inside = self.low + np.clip(place, 0.0, 1.0) * (self.high - self.low)
        # exactly the bound, to the last digit
        return np.where(place >= 1 - _ROUNDING, self.high, np.where(place <= _ROUNDING, self.low, inside))

    def results(self, place: Array) -> Results:
        """Return the full analysis of the design at a point."""
        return self._machines.results(self.design(place))

    def values(self, place: Array) -> Array:
        """Return the single values of the design at a point; NaN if there is no machine."""
        near = self._at(place)
        return near if isinstance(near, np.ndarray) else near.values

    def local_model(self, place: Array) -> LocalModel | None:
        """Return values and derivatives at a point, or None if there is no machine."""
        near = self._at(place)
        if isinstance(near, np.ndarray) and np.isfinite(near).all():
            near = self._found[place.tobytes()] = self._by_differences(place)
        return near if isinstance(near, LocalModel) and np.isfinite(near.values).all() else None

    def _at(self, place: Array) -> LocalModel | Array:
        """Return the cached values at a point, with derivatives if the calculation is compiled."""
        key = place.tobytes()
        if key not in self._found:
            result = self._found[key] = self._analysed(place) if self._kernel is None else self._near(place)
            self._seen(self.design(place), result if isinstance(result, np.ndarray) else result.values)
        return self._found[key]

    def many(self, places: Array, *, is_often: bool = False) -> Array:
        """Return single values at points of shape (fields, n), shape (keys, n); `is_often`: compile for many calls."""
        if self._kernel is None:
            return np.array([self.values(np.ascontiguousarray(place)) for place in places.T]).T
        designs = self.low[:, None] + places * (self.high - self.low)[:, None]
        if is_often:
            self._many = self._many or self._machines.kernel()
            result = threaded(self._many, designs, os.cpu_count() or 1).values
        else:
            result = self._kernel(designs).values[: len(self.keys)]
        for design, values in zip(designs.T, result.T, strict=True):
            self._seen(design, values)
        return result

    def _near(self, place: Array) -> LocalModel:
        """Return values and derivatives of the compiled calculation at a point."""
        kernel: Kernel = self._kernel  # type: ignore[assignment]
        values, slopes = kernel.slopes(self.design(place))
        slopes = np.nan_to_num(slopes * (self.high - self.low))
        count, shape = len(self.keys), (len(self.keys), PARTS)
        parts = np.full(shape, np.nan), np.zeros((*shape, place.size))
        row_of = {key: row for row, key in enumerate(kernel.keys)}
        for row, key in enumerate(self.keys):
            if part_key(key, 0) in row_of:
                rows = slice(row_of[part_key(key, 0)], row_of[part_key(key, 0)] + PARTS)
                parts[0][row], parts[1][row] = values[rows], slopes[rows]
        return LocalModel(values[:count], slopes[:count], parts)

    def _analysed(self, place: Array) -> Array:
        try:
            results = self.results(place)
        except CrankworkError:
            return np.full(len(self.keys), np.nan)
        return np.array([single(results, key) for key in self.keys])

    def _by_differences(self, place: Array) -> LocalModel:
        """Return values and derivatives by differences of analyses inside the bounds."""
        slopes = np.empty((len(self.keys), self.low.size))
        middle = self.values(place)
        for index in range(self.low.size):
            # one-sided near a bound
            step = np.zeros(self.low.size)
            step[index] = _STEP
            if _STEP <= place[index] <= 1 - _STEP:
                low, high = (self._analysed(place + sign * step) for sign in (-1, 1))
                slopes[:, index] = (high - low) / (2 * _STEP)
            else:
                sign = 1 if place[index] < 0.5 else -1
                once, twice = (self._analysed(place + sign * many * step) for many in (1, 2))
                slopes[:, index] = sign * (4 * once - twice - 3 * middle) / (2 * _STEP)
        return LocalModel(middle, np.nan_to_num(slopes), None)


class Constraints(NamedTuple):
    """Objective, inequality constraints (>= 0) and equality constraints (= 0) at a point, with derivatives.

    `peaks`: the values of which the objective is the largest, empty if it has no corner.
    """

    value: float
    slope: Array
    inequalities: Array
    inequality_slopes: Array
    equalities: Array
    equality_slopes: Array
    peaks: Array
    peak_slopes: Array


class Candidate(NamedTuple):
    """A point that a search has reached."""

    point: Array
    value: float  # Of the objective, relative to its size at the start
    violation: float  # Largest violation of a limit, relative to its size


class Multipliers(NamedTuple):
    """Lagrange multipliers: change of the objective with each limit and bound, and the residual."""

    limits: Array  # By each limit, shape (limits,) [SI]
    low: Array  # By the lower bound of each field [SI]
    high: Array
    rest: float  # Share of the gradient that the constraints leave


class Problem:
    """Objective and limits between bounds; `sign` is 1 to minimise the objective, -1 to maximise it."""

    def __init__(self, box: DesignSpace, objective: str, sign: float, limits: Sequence[Limit]) -> None:
        self.box, self.limits, self._sign = box, list(limits), sign
        self._row = {key: row for row, key in enumerate(box.keys)}
        self._objective = self._row[objective]
        stated = box.values(box.start)
        self.size = max(abs(float(stated[self._objective])), np.finfo(float).tiny)
        self.sizes = [max(abs(limit.level), abs(float(stated[self._row[limit.key]]))) or 1.0 for limit in limits]
        kinds = box.is_extreme
        self.is_split = kinds.get(objective) == ("max" if sign > 0 else "min")
        self._are_split = [
            limit.sense != "=" and kinds.get(limit.key) == ("max" if limit.sense == "<=" else "min") for limit in limits
        ]
        self._found: dict[bytes, Constraints | None] = {}
        self._absent = self._absent_constraints()

    def constraints(self, point: Array) -> Constraints | None:
        """Return objective and constraints at a point; None if there is no machine."""
        point = np.clip(point, 0.0, 1.0)
        key = point.tobytes()
        if key not in self._found:
            near = self.box.local_model(point)
            self._found[key] = None if near is None else self._constraints(near)
        return self._found[key]

    def _constraints(self, near: LocalModel) -> Constraints:
        n = near.slopes.shape[1]
        row, scale = self._objective, self._sign / self.size
        above: list[tuple[Array, Array]] = [(np.zeros(0), np.zeros((0, n)))]
        level = list(above)
        for limit, size, is_split in zip(self.limits, self.sizes, self._are_split, strict=True):
            index = self._row[limit.key]
            values, slopes = near.values[[index]], near.slopes[[index]]
            if is_split and near.parts is not None:
                values, slopes = near.parts[0][index], near.parts[1][index]
            sign = -1.0 if limit.sense == "<=" else 1.0
            kept = level if limit.sense == "=" else above
            kept.append((sign * (values - limit.level) / size, sign * slopes / size))
        tops = (near.parts[0][row], near.parts[1][row]) if self.is_split and near.parts is not None else above[0]
        rows = [np.concatenate(arrays) for kept in (above, level) for arrays in zip(*kept, strict=True)]
        value, slope = float(scale * near.values[row]), scale * near.slopes[row]
        return Constraints(value, slope, rows[0], rows[1], rows[2], rows[3], scale * tops[0], scale * tops[1])

    def _absent_constraints(self) -> Constraints:
        """Return the substitute without a machine: worse than any machine, with zero slopes."""
        lines = self.constraints(self.box.start)
        assert lines is not None  # noqa: S101 - the start is a machine
        levels = (0.0, -_ABSENT, 0.0, _ABSENT, 0.0, _ABSENT, 0.0)
        return Constraints(_ABSENT, *map(np.full_like, lines[1:], levels))

    def __call__(self, point: Array) -> Constraints:
        """Return objective and constraints at a point, or the substitute if there is no machine."""
        return self.constraints(point) or self._absent

    def place(self, point: Array) -> Candidate:
        """Return the candidate at a point."""
        point = np.clip(point, 0.0, 1.0)
        lines = self(point)
        missed = np.concatenate([-lines.inequalities, np.abs(lines.equalities)])
        return Candidate(point, lines.value, float(np.max(missed, initial=0.0)))

    def many(self, places: Array, *, is_often: bool = False) -> tuple[Array, Array]:
        """Return objectives, shape (n,), and violations of each limit, shape (limits, n), at points."""
        values = self.box.many(places, is_often=is_often)
        missed = np.array([
            [limit.violation(value) / size for value in values[self._row[limit.key]].tolist()]
            for limit, size in zip(self.limits, self.sizes, strict=True)
        ]).reshape(len(self.limits), places.shape[1])  # fmt: skip
        is_absent = ~np.isfinite(values).all(axis=0)
        cost = self._sign / self.size * values[self._objective]
        return np.where(is_absent, np.inf, cost), np.where(is_absent, _ABSENT, missed)

    def price(self, point: Array) -> Multipliers:
        """Return the multipliers at an optimum, by non-negative least squares."""
        lines = self(point)
        n = point.size
        is_top = lines.peaks >= lines.value - REACHED * max(abs(lines.value), 1e-3)
        tops = lines.peak_slopes[is_top] if is_top.any() else lines.slope[None]
        is_reached = lines.inequalities <= REACHED
        bounds = [(side, field) for side in (0, 1) for field in range(n) if abs(point[field] - side) <= _AT_BOUND]
        ways = np.array([np.eye(n)[field] * (1 - 2 * side) for side, field in bounds]).reshape(len(bounds), n)
        level = np.concatenate([lines.equality_slopes, -lines.equality_slopes])
        held = np.concatenate([lines.inequality_slopes[is_reached], level, ways])
        size = max(float(np.max(np.abs(tops))), _FLAT)
        # the weights of the peaks sum to 1, and the constraints balance them
        matrix = np.block([[tops.T / size, -held.T / size], [np.ones((1, len(tops))), np.zeros((1, len(held)))]])
        weights, rest = _scipy().nnls(matrix, np.append(np.zeros(n), 1.0))
        held_by = weights[len(tops) :] / max(weights[: len(tops)].sum(), np.finfo(float).tiny)
        reached, both, sides = np.split(held_by, [int(is_reached.sum()), int(is_reached.sum()) + len(level)])
        above = np.zeros(lines.inequalities.size)
        above[is_reached] = reached
        equal = both[: lines.equalities.size] - both[lines.equalities.size :]
        low, high = np.zeros(n), np.zeros(n)
        for (side, field), weight in zip(bounds, sides, strict=True):
            (high if side else low)[field] = weight * (1 - 2 * side)
        real, span = self._sign * self.size, self.box.high - self.box.low
        return Multipliers(self._by_limit(above, equal) * real, low * real / span, high * real / span, float(rest))

    def _by_limit(self, above: Array, level: Array) -> Array:
        """Return the change of the objective with each limit, from the multipliers of all constraints."""
        changes, next_above, next_level = [], 0, 0
        for limit, size, is_split in zip(self.limits, self.sizes, self._are_split, strict=True):
            if limit.sense == "=":
                changes.append(level[next_level] / size)
                next_level += 1
            else:
                count = PARTS if is_split else 1
                sign = -1.0 if limit.sense == "<=" else 1.0
                changes.append(sign * above[next_above : next_above + count].sum() / size)
                next_above += count
        return np.array(changes)


def check_scipy(capability: ErrorMessage) -> None:
    """Raise unless SciPy is installed."""
    if extras := missing_extras({"scipy": "dynamics"}):
        raise MissingExtraError(capability, *extras)


def _scipy() -> Any:  # noqa: ANN401 - its stubs know fewer ways to call it than there are
    """Return scipy.optimize."""
    check_scipy(ErrorMessage("extra_study"))
    from scipy import optimize  # noqa: PLC0415 - an optional part

    return optimize


def searched(
    problem: Problem, method: SearchMethod, starts: int, seed: int, progress: Callable[[float], None] | None
) -> list[Candidate]:
    """Return the optima of the searches, the best first, those that satisfy the limits before the others."""
    box = problem.box
    first = [box.start]
    if method == "evolution":
        first = [_evolved(problem, seed)]
    elif starts > 1:
        first += _best_of(problem, box.sample(16 * starts), starts - 1)
    local = _trusted if method == "trust-constr" else _stepped
    candidates = []
    for index, place in enumerate(first):
        candidates.append(_held(problem, place, local))
        if progress is not None:
            progress((index + 1) / len(first))
    return sorted(candidates, key=lambda candidate: (max(candidate.violation, KEPT), candidate.value))


def _best_of(problem: Problem, places: Array, count: int) -> list[Array]:
    """Return the best of some points with a machine."""
    values, missed = problem.many(np.ascontiguousarray(places.T))
    order = np.lexsort((values, np.maximum(missed.max(axis=0, initial=0.0), KEPT)))
    return [places[index] for index in order[:count] if np.isfinite(values[index])]


def _held(problem: Problem, start: Array, local: Callable[..., Candidate]) -> Candidate:
    """Return the optimum from a start; if limits are violated, the violation is minimised first."""
    candidate = local(problem, start)
    if candidate.violation > KEPT:
        nearer = _stepped(problem, candidate.point, is_for_limits=True)
        if nearer.violation > KEPT:
            return nearer
        candidate = min(local(problem, nearer.point), nearer, key=lambda item: (max(item.violation, KEPT), item.value))
    if not problem.is_split and 0 <= candidate.value < _NEAR_ZERO * problem.place(problem.box.start).value:
        squared = local(problem, candidate.point, power=2)
        candidate = min(candidate, squared, key=lambda item: (max(item.violation, KEPT), item.value))
    return candidate


def _stepped(problem: Problem, start: Array, *, power: int = 1, is_for_limits: bool = False) -> Candidate:
    """Return the optimum by sequential quadratic programming."""
    form = _Form(problem, start, power=power, is_for_limits=is_for_limits)
    ends: list[dict[str, Any]] = [{"type": "ineq", "fun": form.inequalities, "jac": form.inequality_slopes}]
    if form.has_equalities:
        ends.append({"type": "eq", "fun": form.equalities, "jac": form.equality_slopes})
    best = form.start
    # restarts, with a new approximation of the curvature, continue where it stopped too early
    for _ in range(1 if problem.box.reason else 3):
        solution = _scipy().minimize(
            form.value, best, jac=form.slope, method="SLSQP", bounds=form.bounds, constraints=ends,
            options={"ftol": 1e-15, "maxiter": _ROUNDS},
        )  # fmt: skip
        is_still = float(np.max(np.abs(solution.x - best))) < 1e-10
        best = solution.x
        if is_still:
            break
    return problem.place(best[: start.size])


def _trusted(problem: Problem, start: Array, *, power: int = 1) -> Candidate:
    """Return the optimum by a trust region method."""
    form, scipy, ends = _Form(problem, start, power=power), _scipy(), []
    if form.inequalities(form.start).size:
        ends.append(scipy.NonlinearConstraint(form.inequalities, 0.0, np.inf, form.inequality_slopes, scipy.BFGS()))
    if form.has_equalities:
        ends.append(scipy.NonlinearConstraint(form.equalities, 0.0, 0.0, form.equality_slopes, scipy.BFGS()))
    with warnings.catch_warnings():
        # SciPy warns that a linear function has no curvature
        warnings.simplefilter("ignore", UserWarning)
        solution = scipy.minimize(
            form.value, form.start, jac=form.slope, hess=scipy.BFGS(), method="trust-constr", bounds=form.bounds,
            constraints=ends, options={"gtol": 1e-9, "xtol": 1e-9, "maxiter": _ROUNDS},
        )  # fmt: skip
    # from the interior to active bounds and limits
    return _stepped(problem, problem.place(solution.x[: start.size]).point, power=power)


def _evolved(problem: Problem, seed: int) -> Array:
    """Return the best point by differential evolution, all of a generation at once."""
    ends: list[Any] = []
    if problem.limits:
        ends.append(_scipy().NonlinearConstraint(lambda points: _each(problem, points)[1], -np.inf, 0.0))
    solution = _scipy().differential_evolution(
        lambda points: _each(problem, points)[0], [(0.0, 1.0)] * problem.box.start.size, constraints=ends,
        vectorized=True, updating="deferred", rng=np.random.default_rng(seed), polish=False, popsize=_POPULATION,
        maxiter=_GENERATIONS, tol=1e-6, x0=problem.box.start,
    )  # fmt: skip
    return np.asarray(solution.x)


def _each(problem: Problem, places: Array) -> tuple[Any, Array]:
    """Return the results of `Problem.many`, also for a single point."""
    values, missed = problem.many(places.reshape(len(places), -1), is_often=True)
    return (values, missed) if places.ndim > 1 else (values[0], missed[:, 0])


class _Form:
    """A smooth problem for SciPy, with a further variable if the objective is split.

    `is_for_limits`: minimise the violation of the limits; otherwise a power of the objective.
    """

    def __init__(self, problem: Problem, start: Array, *, power: int = 1, is_for_limits: bool = False) -> None:
        self._problem, self._power, self._is_for_limits = problem, power, is_for_limits
        lines = problem(start)
        self._n = start.size
        self._has_more = is_for_limits or problem.is_split
        more = [problem.place(start).violation if is_for_limits else lines.value] if self._has_more else []
        self.start = np.concatenate([start, more])
        self.bounds = [(0.0, 1.0)] * self._n + [(0.0, None) if is_for_limits else (None, None)] * len(more)
        self.has_equalities = bool(lines.equalities.size) and not is_for_limits

    def value(self, z: Array) -> float:
        """Return the objective."""
        return float(z[self._n]) if self._has_more else float(self._problem(z).value ** self._power)

    def slope(self, z: Array) -> Array:
        """Return the derivatives of the objective."""
        if self._has_more:
            return np.append(np.zeros(self._n), 1.0)
        lines = self._problem(z)
        return np.asarray(lines.slope * (self._power * lines.value ** (self._power - 1)))

    def inequalities(self, z: Array) -> Array:
        """Return the inequality constraints g(z) >= 0."""
        lines = self._problem(z[: self._n])
        if self._is_for_limits:
            return np.asarray(np.concatenate([lines.inequalities, lines.equalities, -lines.equalities]) + z[self._n])
        added = z[self._n] - lines.peaks if self._has_more else []
        return np.concatenate([lines.inequalities, added])

    def inequality_slopes(self, z: Array) -> Array:
        """Return the derivatives of the inequality constraints."""
        lines = self._problem(z[: self._n])
        if self._is_for_limits:
            slopes = np.concatenate([lines.inequality_slopes, lines.equality_slopes, -lines.equality_slopes])
            return np.column_stack([slopes, np.ones(len(slopes))])
        if not self._has_more:
            return np.asarray(lines.inequality_slopes)
        slopes = np.concatenate([lines.inequality_slopes, -lines.peak_slopes])
        return np.column_stack([slopes, np.append(np.zeros(lines.inequalities.size), np.ones(lines.peaks.size))])

    def equalities(self, z: Array) -> Array:
        """Return the equality constraints h(z) = 0."""
        return np.asarray(self._problem(z[: self._n]).equalities)

    def equality_slopes(self, z: Array) -> Array:
        """Return the derivatives of the equality constraints."""
        slopes = self._problem(z[: self._n]).equality_slopes
        return np.column_stack([slopes, np.zeros(len(slopes))]) if self._has_more else np.asarray(slopes)


class Limit(NamedTuple):
    """A single value and its upper, lower or required level. [SI]"""

    key: str
    sense: Sense
    level: float

    def violation(self, value: float) -> float:
        """Return by how much a value violates the limit; 0 if it is satisfied. [SI]"""
        above = value - self.level
        return {"<=": max(above, 0.0), ">=": max(-above, 0.0), "=": abs(above)}[self.sense]


class WrittenLimit(NamedTuple):
    """A limit as text."""

    key: str
    sense: Sense
    level: str

    def in_si(self) -> Limit:
        """Return the limit in SI; a bare number is in the unit of the tables."""
        return Limit(self.key, self.sense, level(self.key, self.level))


def written_limits(texts: Sequence[str]) -> list[WrittenLimit]:
    """Parse limits such as `stroke >= 80 mm`."""
    limits = []
    for text in texts:
        form = _FORM.fullmatch(text)
        if form is None or len(text) > 200:
            raise CrankworkError(ErrorMessage("limit_form", limit=text[:60], example=_EXAMPLE))
        limits.append(WrittenLimit(form["key"], form["sense"], form["level"]))  # type: ignore[arg-type]
    return limits
