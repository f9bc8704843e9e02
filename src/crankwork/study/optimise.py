"""The best design of a machine file between bounds, subject to limits of values."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple, get_args

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.report.display import key_unit
from crankwork.study.search import REACHED, Candidate, DesignSpace, Problem, SearchMethod, searched, written_limits
from crankwork.study.study_file import Study
from crankwork.study.variants import Swept, units_of
from crankwork.units import coherent_unit, from_si, use_units

STARTS = 4
_SAME = 1e-8
# relative violation of a limit from which limits contradict each other
_MISSED = 1e-7


class ActiveConstraint(NamedTuple):
    """A limit of a value or a bound of a field that is active at an optimum. [SI]"""

    key: str
    sense: str
    level: float
    price: float  # Change of the objective by a change of the level


@dataclass(frozen=True)
class Optimum:
    """The best design found. [SI]

    Parameters
    ----------
    objective : str
        Key of the single value that is the least or the largest.
    sense : str
        "least" or "largest".
    fields : mapping of str to float
        Values of the fields, by the keys of the file.
    values : mapping of str to float
        The objective and the values with limits.
    gradient : mapping of str to float
        Derivative of the objective by each field.
    holding : tuple of ActiveConstraint
        Active limits and bounds.
    rest : float
        Share of the gradient that these leave, 0 at an optimum. [-]
    results : Results
        The full analysis of the design.
    history : Swept
        Every design calculated, in order, with units and seed, as a frame or a data set.
    places : tuple of mapping
        Optimum from each start that satisfies the limits: fields and objective.
    way, seed : str, int
        Method of the search, and seed of the starts.
    reason : str
        Why the calculation was not compiled, so that derivatives are differences of analyses; empty if it was.
    """

    objective: str
    sense: str
    fields: Mapping[str, float]
    values: Mapping[str, float]
    gradient: Mapping[str, float]
    holding: tuple[ActiveConstraint, ...]
    rest: float
    results: Results = field(repr=False)
    history: Swept = field(repr=False)
    places: tuple[Mapping[str, float], ...] = field(repr=False)
    way: SearchMethod
    seed: int
    reason: str = ""

    @property
    def value(self) -> float:
        """The objective."""
        return self.values[self.objective]


def optimise(  # noqa: PLR0913 - problem and options of the search
    description: Description,
    objective: str,
    bounds: Mapping[str, tuple[float | str, float | str]],
    *,
    sense: Literal["least", "largest"] = "least",
    limits: Sequence[str] = (),
    start: Mapping[str, float | str] | None = None,
    way: SearchMethod = "slsqp",
    starts: int | None = None,
    seed: int = 0,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Optimum:
    """Return the design of a machine file between bounds with the least or the largest objective.

    Derivatives are exact if the calculation can be compiled. The minimum of a largest value, as of a peak load, usually
    is where two peaks are equal; therefore each part of the cycle has its own peak.

    Parameters
    ----------
    description : Description
        The machine file.
    objective : str
        A single value: a key of the summary.
    bounds : mapping of str to tuple
        Lower and upper bound of each field: numbers in SI, or texts with units.
    sense : {"least", "largest"}
        Whether to minimise or to maximise the objective.
    limits : sequence of str
        Limits of single values: `stroke >= 80 mm`, `time_ratio.rocker = 1.2`.
    start : mapping of str to float or str, optional
        Start of the search; the values of the file by default.
    way : {"slsqp", "trust-constr", "evolution"}
        Sequential quadratic programming or a trust region from some starts, or differential evolution followed by the
        first of these.
    starts : int, optional
        Number of starts: the stated design and the best of a sample; by default four if the calculation is compiled.
    seed : int
        Seed of the sample.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    told : callable, optional
        Called with the fraction done. [-]

    Returns
    -------
    Optimum
        Fields, values, active constraints, gradient and history.

    Raises
    ------
    CrankworkError
        If an argument is invalid, there is no machine between the bounds, or the limits contradict each other.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> found = crankwork.optimise(d, "piston_acceleration_max", {"rod.length": ("150 mm", "220 mm")})
    >>> round(found.fields["rod.length"], 9)
    0.22
    """
    if way not in get_args(SearchMethod):
        raise CrankworkError(ErrorMessage("way_unknown", way=str(way)[:40], known=", ".join(get_args(SearchMethod))))
    stated_limits = written_limits(limits)
    keys = list(dict.fromkeys([objective, *(limit.key for limit in stated_limits)]))
    designs: list[Array] = []
    value_rows: list[Array] = []

    def seen(design: Array, values: Array) -> None:
        designs.append(design)
        value_rows.append(values)

    box = DesignSpace(description, bounds, keys, start=start or {}, overrides=overrides, seed=seed, seen=seen)
    with use_units(box.units):
        limits_in_si = [limit.in_si() for limit in stated_limits]
    sign = 1.0 if sense == "least" else -1.0
    while True:
        problem = Problem(box, objective, sign, limits_in_si)
        places = searched(problem, way, starts if starts is not None else 1 if box.reason else STARTS, seed, told)
        best = places[0]
        if best.violation > _MISSED:
            raise _contradiction(problem, best)
        results = box.results(best.point)
        difference = np.abs([results.value(key) for key in keys] - box.values(best.point))
        if box.reason or np.all(difference <= _SAME * np.maximum(np.abs(box.values(best.point)), _SAME)):
            break
        # far from where it was compiled the calculation takes another branch
        box.use_full_analyses("differs")
    history = Swept(
        dict(zip(bounds, np.array(designs).T, strict=True)), dict(zip(keys, np.array(value_rows).T, strict=True)), {},
        0, box.reason, units_of(box.numbers, keys),
        {"objective": objective, "sense": sense, "way": way, "seed": str(seed), "limits": ", ".join(limits)},
    )  # fmt: skip
    near = box.local_model(best.point)
    span = box.high - box.low
    slope = np.full(len(bounds), np.nan) if near is None else near.slopes[0] / span
    holding, rest = _holding(problem, list(bounds), best.point)
    return Optimum(
        objective, sense, dict(zip(bounds, box.design(best.point).tolist(), strict=True)),
        {key: results.value(key) for key in keys}, dict(zip(bounds, slope.tolist(), strict=True)), holding, rest,
        results, history,
        tuple(
            {**dict(zip(bounds, box.design(point).tolist(), strict=True)), objective: float(box.values(point)[0])}
            for point, _, violation in places if violation <= _MISSED
        ),
        way, seed, box.reason,
    )  # fmt: skip


def best_of(study: Study, progress: Callable[[float], None] | None = None) -> Optimum:
    """Return the best design of a study that was read as a search."""
    (objective, sign), *_ = study.objectives.items()
    return optimise(
        study.machine, objective, {variable.key: variable.ends for variable in study.varied},
        sense="least" if sign > 0 else "largest", limits=list(_limits_of(study)), way=study.search["way"],
        starts=None if study.search["starts"] is None else int(study.search["starts"]), seed=study.seed,
        overrides=study.overrides, told=progress,
    )  # fmt: skip


def _limits_of(study: Study) -> Iterator[str]:
    """Yield the limits of a study as text, in SI."""
    for key, (low, high) in study.limits.items():
        with use_units("si"):
            unit = coherent_unit(key_unit(key))
        levels = {"=": low} if low == high else {">=": low, "<=": high}
        yield from (f"{key} {sense} {level!r} {unit}".rstrip() for sense, level in levels.items() if np.isfinite(level))


def _holding(problem: Problem, fields: Sequence[str], point: Array) -> tuple[tuple[ActiveConstraint, ...], float]:
    """Return the active constraints of an optimum, and the share of the gradient that they leave."""
    price, box = problem.price(point), problem.box
    values = dict(zip(box.keys, box.values(point).tolist(), strict=True))
    active = [
        ActiveConstraint(limit.key, limit.sense, limit.level, float(multiplier))
        for limit, size, multiplier in zip(problem.limits, problem.sizes, price.limits, strict=True)
        if abs(values[limit.key] - limit.level) <= REACHED * size
    ]
    for row, key in enumerate(fields):
        for sense, level, multipliers in ((">=", box.low, price.low), ("<=", box.high, price.high)):
            if multipliers[row]:
                active.append(ActiveConstraint(key, sense, float(level[row]), float(multipliers[row])))
    return tuple(active), price.rest


def _contradiction(problem: Problem, best: Candidate) -> CrankworkError:
    """Return the error of contradicting limits, naming the one with the largest relative violation."""
    values = dict(zip(problem.box.keys, problem.box.values(best.point).tolist(), strict=True))
    missed = [
        (limit.violation(values[limit.key]) / size, limit)
        for limit, size in zip(problem.limits, problem.sizes, strict=True)
    ]
    _, worst = max(missed, key=lambda item: item[0])
    return CrankworkError(
        ErrorMessage(
            "limits_contradict", key=worst.key, value=_shown(worst.key, values[worst.key]),
            limit=f"{worst.key} {worst.sense} {_shown(worst.key, worst.level)}",
        )
    )  # fmt: skip


def _shown(key: str, value: float) -> str:
    unit = key_unit(key)
    return f"{float(from_si(value, unit)) if unit else value:.6g} {unit}".rstrip()
