"""How far the results of a machine spread where numbers of its file are uncertain, and by which of them."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.polynomial import hermite_e
from numpy.typing import NDArray

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.study.chunks import by_kind, reason_of
from crankwork.study.machines import Machines
from crankwork.study.sought import Sought, sought_number

SAMPLES = 2000
_FEWEST, _MOST = 100, 1_000_000
# deviations of the worst case, and at most
WITHIN, _FARTHEST = 3.0, 10.0
# up to so many numbers all machines are looked at whose numbers are off by as much as they may be
_CORNERS = 8
# how far from the stated value numbers may be drawn, in deviations, and how many are calculated both ways first
_FAR, _CHECKED = 5.0, 4
# so many draws are worth compiling by Numba; fewer are calculated with arrays
_MANY = 50_000
# how many times all numbers are drawn together to see whether each by itself tells enough, and how often at most
_LOOKS = 24
# share of a deviation by which what each number does alone may miss what all do together, root of the mean square
_MISSED = 0.08
_NOTHING = 1e-12
# standard errors that a mean must be away from a value to be told
_AWAY = 4.0
# of polynomials by which a value follows one number alone
_ORDERS = 4
# keys of crank angles, which go round
_ANGLES = ("_max_angle", "_min_angle")


class Cause(NamedTuple):
    """An uncertain number of the machine file, and what of the variance it brings."""

    key: str
    share: float  # Of the variance [-]


class Spread(NamedTuple):
    """A value, its standard deviation, and where that comes from, the greatest first. [SI]"""

    value: float
    deviation: float
    causes: tuple[Cause, ...]
    worst: tuple[float, float]  # The least and the largest with every number within so many deviations
    is_sampled: bool = False  # Whether it comes from draws, because numbers do not act one by one
    mean: float | None = None  # Of the draws, where the stated value is further from it than so many tell


@dataclass(frozen=True)
class Spreads(Mapping[str, Spread]):
    """The spread of single values by key.

    Parameters
    ----------
    results : Results
        Those of the machine as it is stated.
    given : mapping of str to tuple of float
        Uncertain numbers by their keys: value and standard deviation. [SI]
    found : mapping of str to Spread
        Of each single value that moves with them.
    samples : int
        Draws that those spreads rest on which are sampled.
    within : float
        Deviations that a number may be off by in the worst case.
    refused : mapping of str to int
        How many draws gave no machine, by reason.
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


def spread(  # noqa: PLR0913 - what spreads, how it is drawn, and how far the worst case is
    description: Description,
    keys: Sequence[str] = (),
    *,
    samples: int = SAMPLES,
    seed: int = 0,
    within: float = WITHIN,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Spreads:
    """Return how far single values spread with the numbers that a machine file states with a deviation, `75 ± 0.1 mm`.

    Deviations are standard ones of normal distributions, independent of each other. What each number does is taken to
    the second order from whole analyses beside the stated one; where draws of all numbers together show that this does
    not do, as where the largest of two peaks changes, the spread is that of more draws, many calculated at once.

    The worst case of a value is that of the machine in which each number is off by what moves the value most by itself,
    up to `within` deviations: exact where the value rises or falls with each number. Where numbers do not act one by
    one, all that are off by as much are looked at too, and the draws within.

    Parameters
    ----------
    description : Description
        The machine file.
    keys : sequence of str
        Single values that are wanted; all by default.
    samples, seed : int
        How many draws, and from where the generator starts.
    within : float
        Deviations that a number may be off by in the worst case. [-]
    overrides : sequence of str
        Settings laid over the file, `KEY=VALUE`.
    told : callable, optional
        Told the part that is done. [-]

    Returns
    -------
    Spreads
        Value, deviation, causes and worst case by key.

    Raises
    ------
    CrankworkError
        If the file states no deviation, or a machine beside the stated one cannot be.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> d["crank.radius"] = "50 ± 0.1 mm"
    >>> round(crankwork.spread(d)["stroke"].deviation * 1e3, 6)
    0.2
    """
    if not _FEWEST <= samples <= _MOST:
        raise CrankworkError(Refusal("samples_outside", fewest=str(_FEWEST), most=str(_MOST)))
    if not 0 < within <= _FARTHEST:
        raise CrankworkError(Refusal("within_outside", most=f"{_FARTHEST:g}"))
    beside = _Beside(description, overrides, seed)
    stated = beside.stated
    known = {key: value for key, value in stated.summary.items() if np.isfinite(value) and (not keys or key in keys)}
    for key in keys:
        if key not in stated.summary:
            # which names the nearest there are
            stated.value(key)
            raise CrankworkError(Refusal("spread_single", key=key[:60]))
    beside.near = near = _Near(list(known), np.array(list(known.values())), math.radians(stated.machine.cycle))
    middle = near.middle
    first, second = beside.alone(told)
    variances = first**2 + second**2 / 2
    deviations = np.sqrt(variances.sum(axis=0))
    draws = beside.draws(_LOOKS)
    drawn, reasons = beside.values(draws), list(beside.refused.values())
    model = draws @ first + draws**2 @ second / 2
    missed = np.sqrt(np.nanmean((drawn - middle - model) ** 2, axis=0))
    size = _NOTHING * np.maximum(np.abs(middle), np.max(np.abs(middle), initial=0.0) * _NOTHING)
    is_odd = ~(missed <= np.maximum(_MISSED * deviations, size))
    worst = _Worst(beside, first, second, within)
    if is_odd.any():
        odd = np.flatnonzero(is_odd)
        beside.compile(odd, samples)
        more = beside.draws(samples - _LOOKS)
        draws, drawn = np.concatenate([draws, more]), np.concatenate([drawn, beside.values(more, odd, told)])
        reasons += beside.refused.values()
        centred = drawn[:, is_odd] - np.nanmean(drawn[:, is_odd], axis=0)
        deviations[is_odd] = np.sqrt(np.nanmean(centred**2, axis=0))
        variances[:, is_odd] = _by_cause(draws, centred)
        worst.look_at(draws[(np.abs(draws) <= within).all(axis=1)], drawn[(np.abs(draws) <= within).all(axis=1)])
        worst.look_at_corners(odd)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = variances / variances.sum(axis=0)
    spreads = {}
    for at, key in enumerate(near.names):
        if deviations[at] > size[at]:
            causes = sorted(map(Cause, beside.given, shares[:, at].tolist()), key=lambda one: -one.share)
            mean = float(np.nanmean(drawn[:, at])) if is_odd[at] else float(middle[at])
            is_away = abs(mean - middle[at]) > _AWAY * deviations[at] / math.sqrt(len(drawn))
            spreads[key] = Spread(
                float(middle[at]), float(deviations[at]), tuple(causes), worst.of(at), bool(is_odd[at]),
                mean if is_away else None,
            )  # fmt: skip
    return Spreads(stated, beside.given, spreads, samples if is_odd.any() else 0, within, by_kind(reasons))


class _Near(NamedTuple):
    """Single values by their keys, crank angles as near as they can be to the stated ones. [SI]"""

    names: Sequence[str]
    middle: Array
    cycle: float

    def brought(self, found: Array) -> Array:
        """Return values of machines, shape (n, names), with angles as near as they can be."""
        is_angle = np.array([key.partition(".")[0].endswith(_ANGLES) for key in self.names])
        return np.where(is_angle, found - self.cycle * np.round((found - self.middle) / self.cycle), found)


class _Beside:
    """Machines beside the stated one: with other values of its uncertain numbers, which are told in deviations."""

    def __init__(self, description: Description, overrides: Sequence[str | Setting], seed: int) -> None:
        self._description, self._overrides = description, list(overrides)
        deviations = description.machine(overrides).deviations
        if not deviations:
            raise CrankworkError(Refusal("no_deviation"))
        values = description.values_with(overrides)
        self._numbers: dict[str, Sought] = {key: sought_number(values, key) for key in deviations}
        self.given = {key: (one.now or 0.0, deviations[key]) for key, one in self._numbers.items()}
        self._middle, self._sizes = np.array(list(self.given.values())).T
        self.stated = analyse(description.machine(overrides))
        self.near = _Near((), np.zeros(0), 0.0)
        self._compiled: list[tuple[NDArray[np.intp], Machines]] = []
        self._generator = np.random.default_rng(seed)
        self.refused: dict[int, str] = {}

    def draws(self, count: int) -> Array:
        """Return draws of all uncertain numbers, shape (count, numbers)."""
        return self._generator.standard_normal((count, len(self.given)))

    def alone(self, told: Callable[[float], None] | None) -> tuple[Array, Array]:
        """Return what a deviation of each number alone does, first and second order, shape (numbers, names)."""
        first, second = np.empty((2, len(self.given), len(self.near.names)))
        for row in range(len(self.given)):
            steps = np.zeros((4, len(self.given)))
            steps[:, row] = -2, -1, 1, 2
            low_2, low, high, high_2 = self.values(steps, is_needed=True)
            # without the terms of third and fourth order
            first[row] = (8 * (high - low) - (high_2 - low_2)) / 12
            second[row] = (16 * (high + low) - (high_2 + low_2) - 30 * self.near.middle) / 12
            if told is not None:
                told((4 * row + 4) / (4 * len(self.given) + _LOOKS))
        return first, second

    def compile(self, names: NDArray[np.intp], count: int) -> None:
        """Compile the calculation of some values, of as many as can be where one of them stands in the way."""
        low, high = (self._middle + sign * _FAR * self._sizes for sign in (-1, 1))
        ends = np.array([(one.low, one.high) for one in self._numbers.values()])
        spans = np.stack([np.maximum(low, ends[:, 0]), self._middle, np.minimum(high, ends[:, 1])], axis=1)
        few = self._designs(np.random.default_rng(0).standard_normal((_CHECKED, len(self.given))))

        def of(some: NDArray[np.intp]) -> list[tuple[NDArray[np.intp], Machines]]:
            keys = [self.near.names[at] for at in some]
            machines = Machines(self._description, self._numbers, spans, keys, self._overrides)
            machines.compile(None, few, is_for_few=count < _MANY)
            return [] if machines.reason else [(some, machines)]

        left = [names]
        while left:
            some = left.pop()
            found = of(some)
            if not found and some.size > 1:
                halves = np.array_split(some, 2)
                for half, other in (halves, halves[::-1]):
                    if one := of(half):
                        found += one
                        left.append(other)
                        break
            self._compiled += found

    def _designs(self, draws: Array) -> Array:
        return np.asarray((self._middle + draws * self._sizes).T)

    def values(
        self,
        draws: Array,
        names: NDArray[np.intp] | None = None,
        told: Callable[[float], None] | None = None,
        *,
        is_needed: bool = False,
    ) -> Array:
        """Return the values of machines off by so many deviations, shape (n, names); NaN where there is no machine.

        Why there is none is kept in `refused`. `names`: those that are wanted, all by default; `is_needed`: a machine
        that cannot be is refused.
        """
        found = np.full((len(draws), len(self.near.names)), np.nan)
        left = set(range(len(self.near.names))) if names is None else set(names.tolist())
        designs, self.refused = self._designs(draws), {}
        for some, machines in self._compiled:
            if left >= set(some.tolist()):
                values = machines.values(designs, workers=os.cpu_count() or 1)
                found[:, some] = values.of.T
                self.refused |= {at: reason_of(one) for at, one in values.refused.items()}
                left -= set(some.tolist())
        for row, design in enumerate(designs.T if left else ()):
            try:
                summary = self._results(design).summary
            except CrankworkError as error:
                if is_needed:
                    raise
                self.refused[row] = reason_of(error)
                continue
            for at in left:
                found[row, at] = summary.get(self.near.names[at], np.nan)
            if told is not None:
                told((row + 1) / len(draws))
        return self.near.brought(found)

    def _results(self, design: Array) -> Results:
        changes = [
            Setting(key, key, one.written(value))
            for (key, one), value, middle in zip(self._numbers.items(), design.tolist(), self._middle, strict=True)
            if value != middle
        ]
        return analyse(self._description.machine([*self._overrides, *changes]))


class _Worst:
    """The least and the largest of each value among machines whose numbers are off by so many deviations at most."""

    def __init__(self, beside: _Beside, first: Array, second: Array, within: float) -> None:
        self._beside, self._within = beside, within
        self._low, self._high = beside.near.middle.copy(), beside.near.middle.copy()
        wanted: dict[bytes, Array] = {}
        for sign in (-1.0, 1.0):
            with np.errstate(invalid="ignore", divide="ignore"):
                between = np.clip(np.nan_to_num(-first / second), -within, within)
            places = np.stack([np.full(first.shape, -within), np.full(first.shape, within), between])
            by = sign * (first * places + second * places**2 / 2)
            best = np.take_along_axis(places, np.argmax(by, axis=0)[None], axis=0)[0]
            # of rounding nothing follows
            best = np.where(np.ptp(by, axis=0) > _NOTHING * np.abs(beside.near.middle), best, 0.0)
            wanted |= {one.tobytes(): one for one in np.ascontiguousarray(best.T)}
        self._look_through(np.array(list(wanted.values())).reshape(len(wanted), len(beside.given)))

    def _look_through(self, draws: Array, names: NDArray[np.intp] | None = None) -> None:
        self.look_at(draws, self._beside.values(draws, names))

    def look_at(self, draws: Array, values: Array) -> None:
        """Look at the values of machines."""
        if len(draws):
            self._low = np.fmin(self._low, np.fmin.reduce(values, axis=0))
            self._high = np.fmax(self._high, np.fmax.reduce(values, axis=0))

    def look_at_corners(self, names: NDArray[np.intp]) -> None:
        """Look at all machines whose numbers are off by as much as they may be, where these are few enough."""
        count = len(self._beside.given)
        if count <= _CORNERS:
            signs = (np.arange(2**count)[:, None] >> np.arange(count) & 1) * 2 - 1
            self._look_through(np.asarray(self._within * signs), names)

    def of(self, at: int) -> tuple[float, float]:
        """Return the worst of a value at both ends."""
        return float(self._low[at]), float(self._high[at])


def _by_cause(draws: Array, centred: Array) -> Array:
    """Return the part of a variance that follows from each number alone, by orthogonal polynomials of its draws."""
    found = np.zeros((draws.shape[1], centred.shape[1]))
    noise = np.nanmean(centred**2, axis=0) / len(draws)
    for order in range(1, _ORDERS + 1):
        basis = hermite_e.hermeval(draws, [0.0] * order + [1.0]) / math.sqrt(math.factorial(order))
        found += np.maximum(np.nanmean(basis[:, :, None] * centred[:, None, :], axis=0) ** 2 - noise, 0.0)
    return found
