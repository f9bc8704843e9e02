"""Uncertainty of results from uncertain numbers of the machine file, with their contributions: values, text, data."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import hermite_e
from numpy.typing import NDArray

from crankwork.analysis import Results, analyse
from crankwork.analysis.requested_values import with_requested
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.description.value_types import DEVIATIONS_OF_TOLERANCE
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import Component, in_order
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage, Language, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, displayed_size, key_unit, label, rounded
from crankwork.study.chunks import by_kind
from crankwork.study.roots import reason_of
from crankwork.study.variants import MachineVariants, check_single
from crankwork.units import use_units

SAMPLES = 2000
_MIN_SAMPLES, _MAX_SAMPLES = 100, 1_000_000
# standard deviations of the worst case, by default and at most
WITHIN, _MAX_WITHIN = 3.0, 10.0
# number of uncertain numbers up to which all corners of the worst case are analysed
_CORNERS = 8
# range of a compiled calculation in deviations, and number of designs analysed to check it
_FAR, _CHECKED = 5.0, 4
# number of draws from which Numba compiles the calculation
_MANY = 50_000
# draws of all numbers that check the second-order model, and the most where values with friction are analysed
_TEST_DRAWS, _ANALYSED = 24, 100
# largest root-mean-square error of the model, as a fraction of the deviation
_MISSED = 0.08
_ZERO_TOLERANCE = 1e-12
# standard errors between mean and stated value from which the mean is reported
_SIGNIFICANT = 4.0
# orders of the polynomials of a value in one number
_ORDERS = 4
# keys of crank angles, which are periodic
_ANGLES = ("_max_angle", "_min_angle")
# least share of the variance that is printed
_MIN_SHARE = 0.005


class Cause(NamedTuple):
    """An uncertain number of the machine file, and its contribution to the variance."""

    key: str
    share: float  # Of the variance [-]


class Spread(NamedTuple):
    """A value, its standard deviation and the contributions to it, the greatest first. [SI]"""

    value: float
    deviation: float
    causes: tuple[Cause, ...]
    worst: tuple[float, float]  # Least and largest value with every number within its tolerance or so many deviations
    is_sampled: bool = False  # From draws, because the numbers interact
    mean: float | None = None  # Of the draws, if it differs significantly from the stated value


@dataclass(frozen=True)
class Spreads(Mapping[str, Spread]):
    """The spread of single values by key.

    Parameters
    ----------
    results : Results
        Results of the stated machine.
    given : mapping of str to tuple of float
        Uncertain numbers by their keys: value and standard deviation. [SI]
    found : mapping of str to Spread
        Spread of each single value that depends on them.
    samples : int
        Number of draws of the sampled spreads.
    within : float
        Largest deviation in the worst case of a number without tolerance, in standard deviations.
    refused : mapping of str to int
        Number of draws without a machine, by reason.
    """

    results: Results
    given: Mapping[str, tuple[float, float]]
    found: Mapping[str, Spread] = field(repr=False)
    samples: int
    within: float
    refused: Mapping[str, int]

    def __getitem__(self, key: str) -> Spread:
        return self.found[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)


def spread(  # noqa: PLR0913 - results, draws and worst case
    description: Description,
    keys: Sequence[str] = (),
    *,
    samples: int = SAMPLES,
    seed: int = 0,
    within: float = WITHIN,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Spreads:
    """Return the spread of single values from the uncertain numbers of a machine file, `75 ± 0.1 mm` or `75 sd 0.1 mm`.

    The numbers have independent normal distributions: after `sd` stands the standard deviation, after `±` a tolerance,
    a third of which counts as one, so that 99.7 % lie within its limits. The effect of each number is taken to second
    order from analyses close to the stated machine; if draws of all numbers show that this is not accurate, as when
    another of two peaks becomes the largest, the spread comes from more draws, many of them calculated at once.

    The worst case of a value has each number where it changes the value most by itself, within the limits of its
    tolerance or `within` standard deviations: exact if the value is monotone in each number. If the numbers interact,
    all corners and the draws within count too.

    Parameters
    ----------
    description : Description
        The machine file.
    keys : sequence of str
        Single values, all by default.
    samples, seed : int
        Number of draws, and seed of the generator.
    within : float
        Largest deviation in the worst case of a number without tolerance, in standard deviations. [-]
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    told : callable, optional
        Called with the fraction done. [-]

    Returns
    -------
    Spreads
        Value, deviation, contributions and worst case by key.

    Raises
    ------
    CrankworkError
        If the file states no uncertain number, or a machine close to the stated one cannot be analysed.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> d["crank.radius"] = "50 sd 0.1 mm"
    >>> round(crankwork.spread(d)["stroke"].deviation * 1e3, 6)
    0.2
    """
    if not _MIN_SAMPLES <= samples <= _MAX_SAMPLES:
        raise CrankworkError(ErrorMessage("samples_outside", fewest=str(_MIN_SAMPLES), most=str(_MAX_SAMPLES)))
    if not 0 < within <= _MAX_WITHIN:
        raise CrankworkError(ErrorMessage("within_outside", most=f"{_MAX_WITHIN:g}"))
    neighbours = _Neighbours(description, overrides, seed, keys)
    stated = neighbours.stated
    known = {key: value for key, value in stated.summary.items() if np.isfinite(value) and (not keys or key in keys)}
    for key in keys:
        check_single(stated, key)
    neighbours.near = near = _Near(list(known), np.array(list(known.values())), math.radians(stated.machine.cycle))
    middle = near.middle
    # a few values with friction are compiled sooner than analysed
    is_slow = "friction_power" in stated.trace
    if keys and is_slow:
        neighbours.compile(np.arange(len(near.names)), samples)
    first, second = neighbours.alone(told)
    variances = first**2 + second**2 / 2
    deviations = np.sqrt(variances.sum(axis=0))
    draws = neighbours.draws(_TEST_DRAWS)
    drawn, reasons = neighbours.values(draws), list(neighbours.refused.values())
    model = draws @ first + draws**2 @ second / 2
    missed = np.sqrt(np.nanmean((drawn - middle - model) ** 2, axis=0))
    size = _ZERO_TOLERANCE * np.maximum(np.abs(middle), np.max(np.abs(middle), initial=0.0) * _ZERO_TOLERANCE)
    is_odd = ~(missed <= np.maximum(_MISSED * deviations, size))
    ends = neighbours.ends(within)
    worst = _Worst(neighbours, first, second, ends)
    if is_odd.any():
        odd = np.flatnonzero(is_odd)
        left = np.setdiff1d(odd, neighbours.known)
        neighbours.compile(left[[not _is_iterated(stated, near.names[index]) for index in left]], samples)
        if is_slow and len(np.setdiff1d(odd, neighbours.known)):
            samples = min(samples, _ANALYSED)
        more = neighbours.draws(samples - _TEST_DRAWS)
        draws, drawn = np.concatenate([draws, more]), np.concatenate([drawn, neighbours.values(more, odd, told)])
        reasons += neighbours.refused.values()
        centred = drawn[:, is_odd] - np.nanmean(drawn[:, is_odd], axis=0)
        deviations[is_odd] = np.sqrt(np.nanmean(centred**2, axis=0))
        variances[:, is_odd] = _by_cause(draws, centred)
        is_within = (np.abs(draws) <= ends).all(axis=1)
        worst.look_at(draws[is_within], drawn[is_within])
        worst.look_at_corners(odd)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = variances / variances.sum(axis=0)
    spreads = {}
    for index, key in enumerate(near.names):
        if deviations[index] > size[index]:
            causes = sorted(map(Cause, neighbours.given, shares[:, index].tolist()), key=lambda cause: -cause.share)
            mean = float(np.nanmean(drawn[:, index])) if is_odd[index] else float(middle[index])
            is_away = abs(mean - middle[index]) > _SIGNIFICANT * deviations[index] / math.sqrt(len(drawn))
            spreads[key] = Spread(
                float(middle[index]), float(deviations[index]), tuple(causes), worst.of(index), bool(is_odd[index]),
                mean if is_away else None,
            )  # fmt: skip
    return Spreads(stated, neighbours.given, spreads, samples if is_odd.any() else 0, within, by_kind(reasons))


def _is_iterated(results: Results, key: str) -> bool:
    """Return whether a value depends on unknowns that are solved for, which compile slowly and for few designs."""
    known = results.trace.get(key)
    return known is not None and any(isinstance(operand.node, Component) for operand in in_order([known]))


class _Near(NamedTuple):
    """Stated single values by their keys, with the period of crank angles. [SI]"""

    names: Sequence[str]
    middle: Array
    cycle: float

    def brought(self, values: Array) -> Array:
        """Return values, shape (n, names), with angles shifted by periods to the nearest of the stated ones."""
        is_angle = np.array([key_of(key).quantity.endswith(_ANGLES) for key in self.names])
        return np.where(is_angle, values - self.cycle * np.round((values - self.middle) / self.cycle), values)


class _Neighbours:
    """Variants of the stated machine; the uncertain numbers are given in deviations."""

    def __init__(
        self, description: Description, overrides: Sequence[str | Setting], seed: int, keys: Sequence[str]
    ) -> None:
        self._description, self._overrides, self._keys = description, list(overrides), keys
        machine = description.machine(overrides)
        deviations, self._tolerances = machine.deviations, machine.tolerances
        if not deviations:
            raise CrankworkError(ErrorMessage("no_deviation"))
        values = description.values_with(overrides)
        self._numbers: dict[str, NumericField] = {key: numeric_field(values, key) for key in deviations}
        self.given = {key: (number.now or 0.0, deviations[key]) for key, number in self._numbers.items()}
        self._middle, self._sizes = np.array(list(self.given.values())).T
        self.stated = with_requested(analyse(machine), keys)
        self.near = _Near((), np.zeros(0), 0.0)
        self._compiled: list[tuple[NDArray[np.intp], MachineVariants]] = []
        self._analysed: dict[bytes, Results] = {}
        self._generator = np.random.default_rng(seed)
        self.refused: dict[int, str] = {}

    def ends(self, within: float) -> Array:
        """Return how far each number may be off, in standard deviations: its tolerance, or `within` of them."""
        return np.array([DEVIATIONS_OF_TOLERANCE if key in self._tolerances else within for key in self.given])

    def draws(self, count: int) -> Array:
        """Return draws of all uncertain numbers, shape (count, numbers)."""
        return self._generator.standard_normal((count, len(self.given)))

    def alone(self, progress: Callable[[float], None] | None) -> tuple[Array, Array]:
        """Return first- and second-order effects of one deviation of each number, shape (numbers, names)."""
        first, second = np.empty((2, len(self.given), len(self.near.names)))
        for row in range(len(self.given)):
            steps = np.zeros((4, len(self.given)))
            steps[:, row] = -2, -1, 1, 2
            low_2, low, high, high_2 = self.values(steps, is_needed=True)
            # differences free of third- and fourth-order terms
            first[row] = (8 * (high - low) - (high_2 - low_2)) / 12
            second[row] = (16 * (high + low) - (high_2 + low_2) - 30 * self.near.middle) / 12
            if progress is not None:
                progress((4 * row + 4) / (4 * len(self.given) + _TEST_DRAWS))
        return first, second

    def compile(self, names: NDArray[np.intp], count: int) -> None:
        """Compile the calculation of some values, of as many as possible if one of them cannot be compiled."""
        low, high = (self._middle + sign * _FAR * self._sizes for sign in (-1, 1))
        ends = np.array([(number.low, number.high) for number in self._numbers.values()])
        spans = np.stack([np.maximum(low, ends[:, 0]), self._middle, np.minimum(high, ends[:, 1])], axis=1)
        few = self._designs(np.random.default_rng(0).standard_normal((_CHECKED, len(self.given))))

        parts = [names] if names.size else []
        while parts:
            part = parts.pop()
            keys = [self.near.names[index] for index in part]
            machines = MachineVariants(self._description, self._numbers, spans, keys, self._overrides, self._analysed)
            machines.compile(None, few, is_for_few=count < _MANY)
            if not machines.reason:
                self._compiled.append((part, machines))
                continue
            # without those that are told, if any are
            left = part[[key not in machines.refused for key in keys]]
            is_smaller = left.size < part.size
            parts += [half for half in np.array_split(left, 1 if is_smaller else 2) if half.size < part.size]
            parts = [part for part in parts if part.size]

    @property
    def known(self) -> list[int]:
        """Indices of the values that are compiled."""
        return [index for subset, _ in self._compiled for index in subset.tolist()]

    def _designs(self, draws: Array) -> Array:
        return np.asarray((self._middle + draws * self._sizes).T)

    def values(
        self,
        draws: Array,
        names: NDArray[np.intp] | None = None,
        progress: Callable[[float], None] | None = None,
        *,
        is_needed: bool = False,
    ) -> Array:
        """Return values of variants, shape (n, names), by deviations; NaN without a machine, reason in `refused`.

        `names`: indices of the values, all by default; `is_needed`: raise the error of a variant.
        """
        table = np.full((len(draws), len(self.near.names)), np.nan)
        left = set(range(len(self.near.names))) if names is None else set(names.tolist())
        designs, self.refused = self._designs(draws), {}
        for subset, machines in self._compiled:
            if left & set(subset.tolist()):
                values = machines.values(designs, workers=os.cpu_count() or 1)
                table[:, subset] = values.values.T
                self.refused |= {draw: reason_of(cause) for draw, cause in values.refused.items()}
                left -= set(subset.tolist())
        for row, design in enumerate(designs.T if left else ()):
            try:
                summary = self._results(design).summary
            except CrankworkError as error:
                if is_needed:
                    raise
                self.refused[row] = reason_of(error)
                continue
            for index in left:
                table[row, index] = summary.get(self.near.names[index], np.nan)
            if progress is not None:
                progress((row + 1) / len(draws))
        return self.near.brought(table)

    def _results(self, design: Array) -> Results:
        changes = [
            number.setting(value)
            for number, value, middle in zip(self._numbers.values(), design.tolist(), self._middle, strict=True)
            if value != middle
        ]
        return with_requested(analyse(self._description.machine([*self._overrides, *changes])), self._keys)


class _Worst:
    """Least and largest of each value among variants with each number within its own end, in deviations."""

    def __init__(self, neighbours: _Neighbours, first: Array, second: Array, ends: Array) -> None:
        self._neighbours, self._ends = neighbours, ends
        self._low, self._high = neighbours.near.middle.copy(), neighbours.near.middle.copy()
        wanted: dict[bytes, Array] = {}
        high = np.broadcast_to(ends[:, None], first.shape)
        for sign in (-1.0, 1.0):
            with np.errstate(invalid="ignore", divide="ignore"):
                between = np.clip(np.nan_to_num(-first / second), -high, high)
            places = np.stack([-high, high, between])
            change = sign * (first * places + second * places**2 / 2)
            best = np.take_along_axis(places, np.argmax(change, axis=0)[None], axis=0)[0]
            # ignore effects below rounding
            best = np.where(np.ptp(change, axis=0) > _ZERO_TOLERANCE * np.abs(neighbours.near.middle), best, 0.0)
            wanted |= {draw.tobytes(): draw for draw in np.ascontiguousarray(best.T)}
        self._look_through(np.array(list(wanted.values())).reshape(len(wanted), len(neighbours.given)))

    def _look_through(self, draws: Array, names: NDArray[np.intp] | None = None) -> None:
        self.look_at(draws, self._neighbours.values(draws, names))

    def look_at(self, draws: Array, values: Array) -> None:
        """Include the values of variants."""
        if len(draws):
            self._low = np.fmin(self._low, np.fmin.reduce(values, axis=0))
            self._high = np.fmax(self._high, np.fmax.reduce(values, axis=0))

    def look_at_corners(self, names: NDArray[np.intp]) -> None:
        """Analyse all corners, the variants with each number at an end, if they are few enough."""
        count = len(self._neighbours.given)
        if count <= _CORNERS:
            signs = (np.arange(2**count)[:, None] >> np.arange(count) & 1) * 2 - 1
            self._look_through(np.asarray(self._ends * signs), names)

    def of(self, index: int) -> tuple[float, float]:
        """Return the least and the largest of a value."""
        return float(self._low[index]), float(self._high[index])


def _by_cause(draws: Array, centred: Array) -> Array:
    """Return the part of a variance due to each number alone, by orthogonal polynomials of its draws."""
    variances = np.zeros((draws.shape[1], centred.shape[1]))
    noise = np.nanmean(centred**2, axis=0) / len(draws)
    for order in range(1, _ORDERS + 1):
        basis = hermite_e.hermeval(draws, [0.0] * order + [1.0]) / math.sqrt(math.factorial(order))
        variances += np.maximum(np.nanmean(basis[:, :, None] * centred[:, None, :], axis=0) ** 2 - noise, 0.0)
    return variances


def spread_text(spreads: Spreads, language: Language = "en") -> str:
    """Return every uncertain value with its deviation and contributions, as text."""
    with use_units(spreads.results.machine.units):
        return _text(spreads, language)


def _text(spreads: Spreads, language: Language) -> str:
    title = spreads.results.machine.title
    lines = [title] if title else []
    within = number(spreads.within, language)
    lines += [translate("study.normal", language), translate("study.worst", language, within=within), ""]
    rows = []
    for key, spread in spreads.items():
        causes = ", ".join(
            f"{cause.key} {number(100 * cause.share, language, digits=3)} %"
            for cause in spread.causes
            if cause.share > _MIN_SHARE
        )
        sign = translate("study.sampled", language) if spread.is_sampled else ""
        if spread.mean is not None:
            mean = number(displayed(key, spread.mean), language, digits=4)
            causes = f"{translate('study.mean', language, value=mean)}; {causes}"
        # significant digits of sampled deviations
        size = number(displayed_size(key, spread.deviation), language, digits=3 if spread.is_sampled else 6)
        shown = [number(displayed(key, spread.value), language), size]
        worst = " … ".join(number(displayed(key, end), language) for end in spread.worst)
        rows.append((label(key, language), " σ ".join(shown), worst, unit_name(key_unit(key), language), causes, sign))
    wide = [max((len(row[column]) for row in rows), default=0) for column in range(5)]
    lines += ["  ".join(cell.ljust(size) for cell, size in zip(row, [*wide, 0], strict=True)).rstrip() for row in rows]
    if spreads.samples:
        lines += [
            "",
            translate("study.samples", language, count=str(spreads.samples), sign=translate("study.sampled", language)),
        ]
    for reason, count in spreads.refused.items():
        lines += [
            "",
            translate("study.draws_refused", language, count=str(count), reason=in_language(reason, language)),
        ]
    return "\n".join(lines)


def spread_data(spreads: Spreads) -> dict[str, Any]:
    """Return the spreads as plain data, in the units of the tables."""
    with use_units(spreads.results.machine.units):
        return {
            "title": spreads.results.machine.title,
            "samples": spreads.samples,
            "within": spreads.within,
            "refused": [{"count": count, "reason": str(reason)} for reason, count in spreads.refused.items()],
            "spreads": {
                key: {
                    "value": rounded(displayed(key, spread.value)),
                    "deviation": rounded(displayed_size(key, spread.deviation)),
                    "unit": key_unit(key),
                    "least": rounded(displayed(key, spread.worst[0])),
                    "largest": rounded(displayed(key, spread.worst[1])),
                    "is_sampled": spread.is_sampled,
                    "mean": None if spread.mean is None else rounded(displayed(key, spread.mean)),
                    "causes": {cause.key: rounded(cause.share) for cause in spread.causes},
                }
                for key, spread in spreads.items()
            },
        }
