"""How far the results of a machine spread where numbers of its file are uncertain, and by which of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.polynomial import hermite_e

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.study.sought import Sought, sought_number

SAMPLES = 2000
_FEWEST, _MOST = 100, 1_000_000
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
    """

    results: Results
    given: Mapping[str, tuple[float, float]]
    found: Mapping[str, Spread] = field(repr=False)
    samples: int

    def __getitem__(self, key: str) -> Spread:
        return self.found[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)


def spread(
    description: Description,
    keys: Sequence[str] = (),
    *,
    samples: int = SAMPLES,
    seed: int = 0,
    overrides: Sequence[str | Setting] = (),
    told: Callable[[float], None] | None = None,
) -> Spreads:
    """Return how far single values spread with the numbers that a machine file states with a deviation, `75 ± 0.1 mm`.

    Deviations are standard ones of normal distributions, independent of each other. What each number does is taken to
    the second order from whole analyses beside the stated one; where draws of all numbers together show that this does
    not do, as where the largest of two peaks changes, the spread is that of more draws.

    Parameters
    ----------
    description : Description
        The machine file.
    keys : sequence of str
        Single values that are wanted; all by default.
    samples, seed : int
        How many draws, and from where the generator starts.
    overrides : sequence of str
        Settings laid over the file, `KEY=VALUE`.
    told : callable, optional
        Told the part that is done. [-]

    Returns
    -------
    Spreads
        Value, deviation and causes by key.

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
    beside = _Beside(description, overrides)
    stated = beside.results({})
    known = {key: value for key, value in stated.summary.items() if np.isfinite(value) and (not keys or key in keys)}
    for key in keys:
        if key not in stated.summary:
            # which names the nearest there are
            stated.value(key)
            raise CrankworkError(Refusal("spread_single", key=key[:60]))
    names, total = list(known), 4 * len(beside.given) + _LOOKS
    middle = np.array([known[key] for key in names])
    near = _Near(names, middle, math.radians(stated.machine.cycle))
    first, second = np.empty((2, len(beside.given), len(names)))
    for row, (cause, (value, deviation)) in enumerate(beside.given.items()):
        low_2, low, high, high_2 = (
            near.values(beside.results({cause: value + step * deviation})) for step in (-2, -1, 1, 2)
        )
        # by the deviation, without the terms of third and fourth order
        first[row] = (8 * (high - low) - (high_2 - low_2)) / 12
        second[row] = (16 * (high + low) - (high_2 + low_2) - 30 * middle) / 12
        if told is not None:
            told((4 * row + 4) / total)
    variances = first**2 + second**2 / 2
    deviations = np.sqrt(variances.sum(axis=0))
    generator = np.random.default_rng(seed)
    draws, drawn = _drawn(beside, near, _LOOKS, generator)
    model = draws @ first + draws**2 @ second / 2
    missed = np.sqrt(np.nanmean((drawn - middle - model) ** 2, axis=0))
    size = _NOTHING * np.maximum(np.abs(middle), np.max(np.abs(middle), initial=0.0) * _NOTHING)
    is_odd = ~(missed <= np.maximum(_MISSED * deviations, size))
    if is_odd.any():
        more, found = _drawn(beside, near, samples - _LOOKS, generator, told)
        draws, drawn = np.concatenate([draws, more]), np.concatenate([drawn, found])
        centred = drawn[:, is_odd] - np.nanmean(drawn[:, is_odd], axis=0)
        deviations[is_odd] = np.sqrt(np.nanmean(centred**2, axis=0))
        variances[:, is_odd] = _by_cause(draws, centred)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = variances / variances.sum(axis=0)
    spreads = {}
    for at, key in enumerate(names):
        if deviations[at] > size[at]:
            causes = sorted(map(Cause, beside.given, shares[:, at].tolist()), key=lambda one: -one.share)
            mean = float(np.nanmean(drawn[:, at])) if is_odd[at] else float(middle[at])
            is_away = abs(mean - middle[at]) > _AWAY * deviations[at] / math.sqrt(len(drawn))
            spreads[key] = Spread(
                float(middle[at]), float(deviations[at]), tuple(causes), bool(is_odd[at]), mean if is_away else None
            )
    return Spreads(stated, beside.given, spreads, samples if is_odd.any() else 0)


class _Beside:
    """Machines beside the stated one: with other values of its uncertain numbers."""

    def __init__(self, description: Description, overrides: Sequence[str | Setting]) -> None:
        self._description, self._overrides = description, list(overrides)
        deviations = description.machine(overrides).deviations
        if not deviations:
            raise CrankworkError(Refusal("no_deviation"))
        values = description.values_with(overrides)
        self._numbers: dict[str, Sought] = {key: sought_number(values, key) for key in deviations}
        self.given = {key: (one.now or 0.0, deviations[key]) for key, one in self._numbers.items()}

    def results(self, values: Mapping[str, float]) -> Results:
        """Return the results with other values of some numbers. [SI]"""
        changes = [Setting(key, key, self._numbers[key].written(value)) for key, value in values.items()]
        return analyse(self._description.machine([*self._overrides, *changes]))


def _by_cause(draws: Array, centred: Array) -> Array:
    """Return the part of a variance that follows from each number alone, by orthogonal polynomials of its draws."""
    found = np.zeros((draws.shape[1], centred.shape[1]))
    noise = np.nanmean(centred**2, axis=0) / len(draws)
    for order in range(1, _ORDERS + 1):
        basis = hermite_e.hermeval(draws, [0.0] * order + [1.0]) / math.sqrt(math.factorial(order))
        found += np.maximum(np.nanmean(basis[:, :, None] * centred[:, None, :], axis=0) ** 2 - noise, 0.0)
    return found


class _Near(NamedTuple):
    """Single values by their keys, crank angles as near as they can be to the stated ones. [SI]"""

    names: Sequence[str]
    middle: Array
    cycle: float

    def values(self, results: Results) -> Array:
        """Return the values of some results; NaN for those that there are not."""
        found = np.array([results.summary.get(key, np.nan) for key in self.names])
        is_angle = np.array([key.partition(".")[0].endswith(_ANGLES) for key in self.names])
        apart = found - self.middle
        return np.where(is_angle, found - self.cycle * np.round(apart / self.cycle), found)


def _drawn(
    beside: _Beside,
    near: _Near,
    count: int,
    generator: np.random.Generator,
    told: Callable[[float], None] | None = None,
) -> tuple[Array, Array]:
    """Return draws of all uncertain numbers, in deviations, and the single values they give; NaN without a machine."""
    draws = generator.standard_normal((count, len(beside.given)))
    found = np.full((count, len(near.names)), np.nan)
    for row, draw in enumerate(draws):
        values = {
            key: value + step * size for (key, (value, size)), step in zip(beside.given.items(), draw, strict=True)
        }
        try:
            found[row] = near.values(beside.results(values))
        except CrankworkError:
            continue
        if told is not None:
            told((row + 1) / count)
    return draws, found
