"""Solve for several numbers of a machine file that together give as many values of its results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField, numeric_field
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage, Language, capital, translate
from crankwork.locale.numbers import aligned
from crankwork.report.display import displayed, key_unit, label, rounded
from crankwork.study.search import DesignSpace, check_scipy
from crankwork.study.solve import parse_target, split_target
from crankwork.study.study_text import value_text, with_unit
from crankwork.study.variants import single
from crankwork.study.varied_field import search_points
from crankwork.units import System, from_si, use_units

STARTS = 12
# largest distance of a value from its target, relative to the size of both, and of equal solutions in the range
_REACHED, _EQUAL = 1e-9, 1e-6
# relative step below which nothing changes
_STILL = 1e-15
_MAX_UNKNOWNS, _DIGITS = 8, 10


@dataclass(frozen=True)
class SeveralSolutions:
    """Numbers of a machine file that satisfy several equations. [SI]

    Parameters
    ----------
    title : str
        Title of the machine.
    wanted : dict of str to float
        The target of each value.
    unknowns : tuple of NumericField
        The unknowns.
    ranges : array, shape (unknowns, 2)
        Where they were unknowns.
    solutions : tuple of array, shape (unknowns,)
        Each solution found.
    nearest : array, shape (unknowns,)
        The numbers that come closest where there is no solution.
    reached : array, shape (equations,)
        The values there.
    starts : int
        Number of points from which solutions were unknowns; others may exist.
    units : str
        The system of units of the machine.
    """

    title: str
    wanted: dict[str, float]
    unknowns: tuple[NumericField, ...]
    ranges: Array
    solutions: tuple[Array, ...]
    nearest: Array
    reached: Array
    starts: int
    units: System


def solve_several(  # noqa: PLR0913 - equations, unknowns and options of the search
    description: Description,
    equations: Sequence[str],
    unknowns: Sequence[str],
    *,
    limits: Sequence[tuple[str | float | None, str | float | None]] = (),
    starts: int = STARTS,
    overrides: Sequence[str | Setting] = (),
    progress: Callable[[float], None] | None = None,
) -> SeveralSolutions:
    """Return numbers of the machine file, as many as there are equations, that satisfy all of them.

    Newton's steps start at the stated numbers and at points spread over the range.

    Parameters
    ----------
    description : Description
        The machine file.
    equations : sequence of str
        Values and targets, as `solve` takes them.
    unknowns : sequence of str
        Keys of the numbers, as in `--set`.
    limits : sequence of tuple
        Range of each number, as `solve` takes it.
    starts : int
        Number of points to start from.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    progress : callable, optional
        Called with the fraction done. [-]

    Raises
    ------
    CrankworkError
        If an equation or a number is invalid for this file, or there are not as many of both.
    """
    check_scipy(ErrorMessage("extra_solve"))
    from scipy.optimize import least_squares  # noqa: PLC0415 - an optional part

    if len(equations) != len(unknowns) or len(set(unknowns)) < len(unknowns) or len(unknowns) > _MAX_UNKNOWNS:
        raise CrankworkError(ErrorMessage("solve_counts", equations=len(equations), unknowns=len(unknowns)))
    stated = description.values_with(overrides)
    fields = tuple(numeric_field(stated, key) for key in unknowns)
    ends = [search_points(field, *pair, 2).values for field, pair in zip(fields, limits or [(None, None)] * len(fields),
                                                                         strict=True)]  # fmt: skip
    results = analyse(description.machine(overrides))
    wanted = dict[str, float]()
    for text in equations:
        parts = split_target(text)
        target = parse_target(parts, results)
        wanted[f"{target.key}@{parts.place}" if parts.place else target.key] = target.level
    levels = np.array(list(wanted.values()))
    bounds = {field.key: (float(low), float(high)) for field, (low, _, high) in zip(fields, ends, strict=True)}
    space = DesignSpace(
        description, bounds, list(wanted), start={}, overrides=overrides, seed=0, seen=lambda _, __: None
    )
    size = np.maximum(np.abs(levels), np.abs(np.nan_to_num(space.values(space.start))))
    size[size == 0.0] = 1.0

    def off(place: Array) -> Array:
        return np.asarray(np.nan_to_num((space.values(np.ascontiguousarray(place)) - levels) / size, nan=1e6))

    def slope(place: Array) -> Array:
        near = space.local_model(np.ascontiguousarray(place))
        return np.zeros((len(wanted), len(fields))) if near is None else np.asarray(near.slopes / size[:, None])

    def is_solution(exact: Results) -> bool:
        return bool(np.all(np.abs([single(exact, key) for key in wanted] - levels) <= 10 * _REACHED * size))

    solutions, closest = list[Array](), (np.inf, space.start)
    for index, start in enumerate([space.start, *space.sample(starts - 1)]):
        place = np.clip(start, 0.0, 1.0)
        if np.isfinite(space.values(place)).all():
            place = least_squares(
                off, place, slope, bounds=(0.0, 1.0), ftol=_STILL, xtol=_STILL, gtol=_STILL, max_nfev=60
            ).x
            distance = float(np.abs(off(place)).max())
            closest = min(closest, (distance, place), key=lambda pair: pair[0])
            if distance <= _REACHED and all(np.abs(place - other).max() > _EQUAL for other in solutions):
                solutions.append(place)
        if progress is not None:
            progress((index + 1) / starts)
    # the analysis decides, not the compiled values
    solutions = [place for place in solutions if is_solution(space.results(place))]
    return SeveralSolutions(
        results.machine.title or "", wanted, fields, np.array([[low, high] for low, _, high in ends]),
        tuple(sorted((space.design(place) for place in solutions), key=tuple)), space.design(closest[1]),
        space.values(closest[1]), starts, results.machine.units,
    )  # fmt: skip


def several_text(solution: SeveralSolutions, language: Language = "en") -> str:
    """Return equations, ranges and solutions as text."""
    with use_units(solution.units):
        return "\n".join(_lines(solution, language)).rstrip()


def _lines(solution: SeveralSolutions, language: Language) -> Iterator[str]:
    if solution.title:
        yield solution.title
    for key, level in solution.wanted.items():
        yield f"{capital(label(key, language))} = {value_text(key, level, language)}"
    ranges = zip(solution.unknowns, solution.ranges.tolist(), strict=True)
    yield from aligned(
        [(field.key, " … ".join(_shown(field, end, language) for end in ends)) for field, ends in ranges]
    )
    yield translate("study.several_missed", language, starts=solution.starts)
    yield from ("", translate("study.solutions" if solution.solutions else "study.none", language))
    for place in solution.solutions:
        yield from (*_numbers(solution, place, language), "")
    if not solution.solutions:
        reached = zip(solution.wanted, solution.reached.tolist(), strict=True)
        yield from (translate("study.several_nearest", language), *_numbers(solution, solution.nearest, language))
        yield from aligned([(label(key, language), value_text(key, value, language)) for key, value in reached])


def _numbers(solution: SeveralSolutions, place: Array, language: Language) -> list[str]:
    pairs = zip(solution.unknowns, place.tolist(), strict=True)
    return aligned([(field.key, _shown(field, value, language)) for field, value in pairs])


def _shown(field: NumericField, value: float, language: Language) -> str:
    return with_unit(float(from_si(value, field.unit)), field.unit, language, _DIGITS)


def several_data(solution: SeveralSolutions) -> dict[str, Any]:
    """Return equations and solutions as plain data, in the units of tables and of the file."""

    def numbers(place: Array) -> dict[str, Any]:
        pairs = zip(solution.unknowns, place.tolist(), strict=True)
        return {field.key: rounded(float(from_si(value, field.unit))) for field, value in pairs}

    with use_units(solution.units):
        return {
            "title": solution.title,
            "wanted": [{"key": key, "value": rounded(displayed(key, level)), "unit": key_unit(key)}
                       for key, level in solution.wanted.items()],
            "unknowns": [{"key": field.key, "unit": field.unit} for field in solution.unknowns],
            "range": {"from": numbers(solution.ranges[:, 0]), "to": numbers(solution.ranges[:, 1])},
            "starts": solution.starts,
            "solutions": [numbers(place) for place in solution.solutions],
            "nearest": None if solution.solutions else numbers(solution.nearest),
        }  # fmt: skip
