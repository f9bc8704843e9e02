"""The best design of a machine file between bounds, with limits to what it must keep."""

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
from crankwork.locale import Refusal
from crankwork.report.language import key_unit
from crankwork.study.box import Box
from crankwork.study.limits import written_limits
from crankwork.study.search import REACHED, Place, Problem, Way, searched
from crankwork.study.study_file import Study
from crankwork.study.sweep import Swept, units_of
from crankwork.units import coherent_unit, from_si, use_units

STARTS = 4
_SAME = 1e-8
# beside the size of a value, by how much a limit is contradicted
_MISSED = 1e-7


class Holding(NamedTuple):
    """What an optimum is held by: a limit of a value, or a bound of a field. [SI]"""

    key: str
    sense: str
    level: float
    price: float  # Change of the objective by a change of the level


@dataclass(frozen=True)
class Optimum:
    """The best design that was found. [SI]

    Parameters
    ----------
    objective : str
        Key of the single value that is the least or the largest.
    sense : str
        "least" or "largest".
    fields : mapping of str to float
        What the design states, by the keys of the file.
    values : mapping of str to float
        The objective and the values with limits.
    gradient : mapping of str to float
        Change of the objective by each field.
    holding : tuple of Holding
        The limits and bounds that hold it.
    rest : float
        What of the gradient they leave unexplained: nothing at an optimum. [-]
    results : Results
        The whole analysis of the design.
    history : Swept
        Every design that was looked at from one place to the next, with units and seed, as a frame or a data set.
    places : tuple of mapping
        Where the search from each start has come to: fields, and the objective where the limits are kept.
    way, seed : str, int
        How it was searched, and from where the generator of starts began.
    reason : str
        Why the calculation was not compiled, and derivatives are differences of analyses; empty where it was.
    """

    objective: str
    sense: str
    fields: Mapping[str, float]
    values: Mapping[str, float]
    gradient: Mapping[str, float]
    holding: tuple[Holding, ...]
    rest: float
    results: Results = field(repr=False)
    history: Swept = field(repr=False)
    places: tuple[Mapping[str, float], ...] = field(repr=False)
    way: Way
    seed: int
    reason: str = ""

    @property
    def value(self) -> float:
        """The objective."""
        return self.values[self.objective]


def optimise(  # noqa: PLR0913 - what is wanted of what, where, and how it is searched
    description: Description,
    objective: str,
    bounds: Mapping[str, tuple[float | str, float | str]],
    *,
    sense: Literal["least", "largest"] = "least",
    limits: Sequence[str] = (),
    start: Mapping[str, float | str] | None = None,
    way: Way = "slsqp",
    starts: int | None = None,
    seed: int = 0,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Optimum:
    """Return the design of a machine file between bounds whose objective is the least or the largest.

    Derivatives are exact where what an analysis remembers can be compiled. The least of a largest value, as of a peak
    load, mostly stands where two peaks are level: each part of the cycle has a peak of its own then.

    Parameters
    ----------
    description : Description
        The machine file.
    objective : str
        A single value: a key of the summary.
    bounds : mapping of str to tuple
        The fields that vary, from where to where: numbers in SI, or texts with units.
    sense : {"least", "largest"}
        What the objective is to be.
    limits : sequence of str
        What single values must keep to: `stroke >= 80 mm`, `time_ratio.rocker = 1.2`.
    start : mapping of str to float or str, optional
        Where to start with; what the file states by default.
    way : {"slsqp", "trust-constr", "evolution"}
        Sequential quadratic programming or a trust region from some starts, or differential evolution of many designs
        at once and then the first of these.
    starts : int, optional
        From how many places: the stated one and the best of others; four where the calculation is compiled.
    seed : int
        From where the generator of places starts.
    overrides : sequence of str
        Settings laid over the file, `KEY=VALUE`.
    told : callable, optional
        Told the part that is done. [-]

    Returns
    -------
    Optimum
        Fields and values, what holds them, gradient and history.

    Raises
    ------
    CrankworkError
        If the question cannot be asked, there is no machine between the bounds, or the limits contradict each other.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> found = crankwork.optimise(d, "piston_acceleration_max", {"rod.length": ("150 mm", "220 mm")})
    >>> round(found.fields["rod.length"], 9)
    0.22
    """
    if way not in get_args(Way):
        raise CrankworkError(Refusal("way_unknown", way=str(way)[:40], known=", ".join(get_args(Way))))
    wanted = written_limits(limits)
    keys = list(dict.fromkeys([objective, *(one.key for one in wanted)]))
    designs: list[Array] = []
    found: list[Array] = []

    def seen(design: Array, values: Array) -> None:
        designs.append(design)
        found.append(values)

    box = Box(description, bounds, keys, start=start or {}, overrides=overrides, seed=seed, seen=seen)
    with use_units(box.units):
        asked = [one.in_si() for one in wanted]
    sign = 1.0 if sense == "least" else -1.0
    while True:
        problem = Problem(box, objective, sign, asked)
        places = searched(problem, way, starts if starts is not None else 1 if box.reason else STARTS, seed, told)
        best = places[0]
        if best.missed > _MISSED:
            raise _contradiction(problem, best)
        results = box.results(best.at)
        apart = np.abs([results.value(key) for key in keys] - box.values(best.at))
        if box.reason or np.all(apart <= _SAME * np.maximum(np.abs(box.values(best.at)), _SAME)):
            break
        # far from where it was compiled the calculation goes another way
        box.give_up("differs")
    history = Swept(
        dict(zip(bounds, np.array(designs).T, strict=True)), dict(zip(keys, np.array(found).T, strict=True)), {}, 0,
        box.reason, units_of(box.numbers, keys),
        {"objective": objective, "sense": sense, "way": way, "seed": str(seed), "limits": ", ".join(limits)},
    )  # fmt: skip
    near = box.near(best.at)
    span = box.high - box.low
    slope = np.full(len(bounds), np.nan) if near is None else near.slopes[0] / span
    holding, rest = _holding(problem, list(bounds), best.at)
    return Optimum(
        objective, sense, dict(zip(bounds, box.design(best.at).tolist(), strict=True)),
        {key: results.value(key) for key in keys}, dict(zip(bounds, slope.tolist(), strict=True)), holding, rest,
        results, history,
        tuple(
            {**dict(zip(bounds, box.design(one.at).tolist(), strict=True)), objective: float(box.values(one.at)[0])}
            for one in places if one.missed <= _MISSED
        ),
        way, seed, box.reason,
    )  # fmt: skip


def best_of(study: Study, told: Callable[[float], None] | None = None) -> Optimum:
    """Return the best design of a study that was read as a search for it."""
    (objective, sign), *_ = study.objectives.items()
    return optimise(
        study.machine, objective, {one.key: one.ends for one in study.varied},
        sense="least" if sign > 0 else "largest", limits=list(_limits_of(study)), way=study.search["way"],
        starts=None if study.search["starts"] is None else int(study.search["starts"]), seed=study.seed,
        overrides=study.overrides, told=told,
    )  # fmt: skip


def _limits_of(study: Study) -> Iterator[str]:
    """Yield the limits of a study as they are written, in SI."""
    for key, (low, high) in study.limits.items():
        with use_units("si"):
            unit = coherent_unit(key_unit(key))
        every = {"=": low} if low == high else {">=": low, "<=": high}
        yield from (f"{key} {sense} {level!r} {unit}".rstrip() for sense, level in every.items() if np.isfinite(level))


def _holding(problem: Problem, fields: Sequence[str], at: Array) -> tuple[tuple[Holding, ...], float]:
    """Return the limits and bounds that hold an optimum, and what they leave unexplained."""
    price, box = problem.price(at), problem.box
    values = dict(zip(box.keys, box.values(at).tolist(), strict=True))
    found = [
        Holding(one.key, one.sense, one.level, float(by))
        for one, size, by in zip(problem.limits, problem.sizes, price.limits, strict=True)
        if abs(values[one.key] - one.level) <= REACHED * size
    ]
    for row, key in enumerate(fields):
        for sense, level, by in ((">=", box.low, price.low), ("<=", box.high, price.high)):
            if by[row]:
                found.append(Holding(key, sense, float(level[row]), float(by[row])))
    return tuple(found), price.rest


def _contradiction(problem: Problem, best: Place) -> CrankworkError:
    """Return the refusal of limits that no design keeps, with that which is missed most where all are missed least."""
    values = dict(zip(problem.box.keys, problem.box.values(best.at).tolist(), strict=True))
    missed = [
        (one.missed(values[one.key]) / size, one) for one, size in zip(problem.limits, problem.sizes, strict=True)
    ]
    _, worst = max(missed, key=lambda one: one[0])
    return CrankworkError(
        Refusal(
            "limits_contradict", key=worst.key, value=_shown(worst.key, values[worst.key]),
            limit=f"{worst.key} {worst.sense} {_shown(worst.key, worst.level)}",
        )
    )  # fmt: skip


def _shown(key: str, value: float) -> str:
    unit = key_unit(key)
    return f"{float(from_si(value, unit)) if unit else value:.6g} {unit}".rstrip()
