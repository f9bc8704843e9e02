"""Polynomials that replace the formulas of dyads near change points.

At a change point the two branches of a dyad meet and its formulas are 0/0; near it they lose digits with the square of
the distance. The motion itself is smooth there, so that polynomials through positions farther off, on one branch before
and on the other after it, give it to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.polynomial import chebyshev

from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.placement import place
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.mechanism import Mechanism
from crankwork.mechanism.passage import ChangePointFit, ChangePointPassage, Polynomial

_TOUCHES = 1e-7
_DEGREE = 12
_NODES = 80
_REACHES = 45.0 * 0.75 ** np.arange(14)
# nodes nearest to the change point lose the most digits, as do the formulas at the ends of the polynomials
_NEAREST = 1 / 6
_USED = 1 / 2
# the widest reach is used whose last orders change little more than those of the best
_ENOUGH, _ROUNDING = 4.0, 5e-14


def with_passages(
    mechanism: Mechanism, changes: Sequence[float], ends: tuple[float, float], stated: float, *, is_whole: bool = True
) -> Mechanism:
    """Return a mechanism that passes change points at crank angles between the ends of its motion.

    `stated`: crank angle at which its dyads are on their branches, or just after which [deg]; `is_whole`: whether the
    crank turns fully, so that everything repeats.
    """
    # a crank that turns fully goes on beyond its table; otherwise it does not
    period = ends[1] - ends[0] if is_whole else math.inf
    for index, group in enumerate(mechanism.dyads):
        if not isinstance(group, RRR | RRP | RPR):
            continue
        touched = tuple(change for change in changes if _touches(mechanism, index, change))
        if touched:
            passed = replace(
                mechanism, passages={**mechanism.passages, index: ChangePointPassage(touched, stated, period)}
            )
            bridges = tuple(_bridge(passed, index, change, changes, ends) for change in touched)
            mechanism = replace(
                mechanism, passages={**mechanism.passages, index: ChangePointPassage(touched, stated, period, bridges)}
            )
    return mechanism


def _touches(mechanism: Mechanism, index: int, degrees: float) -> bool:
    part = replace(mechanism, dyads=mechanism.dyads[: index + 1])
    closure = place(part, CrankGrid.from_degrees([degrees])).closures[index]
    return bool(np.all(np.abs(closure.value) <= _TOUCHES * closure.scale))


def _bridge(
    mechanism: Mechanism, index: int, degrees: float, changes: Sequence[float], ends: tuple[float, float]
) -> ChangePointFit:
    """Return the polynomials of a dyad near a change point, those that lose the fewest digits."""
    limits = [abs(change - degrees) / 2 for change in changes if change != degrees]
    if not math.isfinite(mechanism.passages[index].period):
        limits += [abs(end - degrees) for end in ends]
    widest = min([_REACHES[0], *limits])
    part = replace(mechanism, dyads=mechanism.dyads[: index + 1])
    reaches = [float(width) for width in _REACHES if width <= widest] or [widest]
    fits = [_fitted(part, index, degrees, reach) for reach in reaches]
    enough = _ENOUGH * max(min(left for _, _, left in fits), _ROUNDING)
    reach, columns = next((reach, columns) for reach, columns, left in fits if left <= enough)
    return ChangePointFit(degrees, _USED * reach, columns)


def _fitted(part: Mechanism, index: int, degrees: float, reach: float) -> tuple[float, Mapping[str, Polynomial], float]:
    """Return polynomials of the quantities of a dyad over a reach, and the effect of their last orders."""
    nearest = _NEAREST * reach
    nodes = np.cos(np.pi * (2 * np.arange(_NODES // 2) + 1) / _NODES)
    far = np.sqrt((nearest**2 + reach**2) / 2 + (reach**2 - nearest**2) / 2 * nodes)
    local = np.concatenate([-far, far[::-1]]) / reach
    values = _quantities(part, index, CrankGrid.from_degrees(degrees + reach * local))
    powers = chebyshev.chebvander(local, _DEGREE)
    near = chebyshev.chebvander(np.linspace(-_USED, _USED, 9), _DEGREE)
    columns, left = {}, 0.0
    for key, value in values.items():
        # the digits that formulas lose near the change point
        weight = np.abs(local) ** (2 if key.endswith("_1") else 1)
        full, reduced = (
            np.linalg.lstsq(powers[:, :count] * weight[:, None], value * weight, rcond=None)[0]
            for count in (_DEGREE + 1, _DEGREE - 1)
        )
        columns[key] = Polynomial(degrees, reach, tuple(map(float, full)))
        difference = np.abs(near @ full - near[:, : _DEGREE - 1] @ reduced).max()
        left = max(left, float(difference / (1 + np.abs(value).max()))) if np.isfinite(difference) else math.inf
    return reach, columns, left


def _quantities(part: Mechanism, index: int, grid: CrankGrid) -> dict[str, Array]:
    """Return the quantities of a dyad that are 0/0 at a change point."""
    placed, full = place(part, grid), np.zeros(len(grid))
    match part.dyads[index]:
        case RRR() as dyad:
            a, b = (placed.bars.get(link, placed.links[link]) for link in (dyad.link_a, dyad.link_b))
            quantities = {
                "arm_x": dyad.length_a * a.cos, "arm_y": dyad.length_a * a.sin,
                "rate_a": a.angle_1, "rate_b": b.angle_1, "rate_a_1": a.angle_2, "rate_b_1": b.angle_2,
            }  # fmt: skip
        case RRP() as dyad:
            a, b = placed.bars.get(dyad.link, placed.links[dyad.link]), placed.links[dyad.piece]
            reach = dyad.length * (a.cos * b.cos + a.sin * b.sin)
            quantities = {"reach": reach, "rate": a.angle_1 - b.angle_1, "rate_1": a.angle_2 - b.angle_2}
        case RPR() as dyad:
            a, b = placed.links[dyad.link], placed.links[dyad.block]
            x, y = (pin.position - pivot.position for pin, pivot in zip(b.origin, a.origin, strict=True))
            quantities = {
                "reach": x * b.cos + y * b.sin, "cos": b.cos, "sin": b.sin,
                "rate": b.angle_1, "rate_1": b.angle_2,
            }  # fmt: skip
    return {key: value + full for key, value in quantities.items()}
