"""Efficiency of chains of joints, and the driving torque with it."""

from __future__ import annotations

import math
import operator
from dataclasses import dataclass
from functools import reduce

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue, given, total


@dataclass(frozen=True)
class Series:
    """Joints or chains through which all power flows, one after the other."""

    parts: tuple[Chain, ...]  # Their efficiencies [-]


@dataclass(frozen=True)
class Parallel:
    """Joints or chains between which the power divides."""

    parts: tuple[Chain, ...]  # Their efficiencies [-]
    shares: tuple[float, ...] = ()  # Share of the power through each; equal where none are given [-]


Chain = float | Series | Parallel


def efficiency(chain: Chain) -> float:
    """Return the efficiency of a chain (artobolevsky_1988, ch. 14). [-]

    Product of efficiencies in series, weighted mean of parallel ones. `chain`: efficiencies of joints, from more than 0
    to 1, in series and parallel.

    Examples
    --------
    >>> round(efficiency(Series((0.98, Parallel((0.9, 0.8)), 0.99))), 5)
    0.82467
    """
    return traced_efficiency(chain).value


def traced_efficiency(chain: Chain, key: str = "efficiency", path: str = "efficiency.chain") -> TracedValue:
    """Return the traced efficiency of a chain; its parts have the keys `key.1`, `key.2` and so on."""
    match chain:
        case Series(parts):
            factors = [
                traced_efficiency(part, f"{key}.{index}", f"{path}[{index}]")
                for index, part in enumerate(parts, start=1)
            ]
            return reduce(operator.mul, factors).named(key)
        case Parallel(parts, shares):
            shares = shares or (1 / len(parts),) * len(parts)
            if len(shares) != len(parts) or not math.isclose(sum(shares), 1.0) or min(shares) < 0:
                raise ValueError(f"{len(parts)} parallel chains need as many shares, none negative, that sum to 1")
            terms = []
            for number, (share, part) in enumerate(zip(shares, parts, strict=True), start=1):
                # a single efficiency has a key of its own, so that its symbol in the formula has an index
                own = "efficiency" if isinstance(part, float | int) else f"{key}.{number}.0"
                inner = traced_efficiency(part, own, f"{path}[{number}]")
                terms.append(efficiency_share(share, inner).named(f"{key}.{number}"))
            return total(key, terms)
        case value:
            if not 0 < value <= 1:
                raise ValueError(f"an efficiency lies above 0 and not above 1, not at {value:g}")
            return given(key, value, path)


@formula("efficiency", "artobolevsky_1988, ch. 14")
def efficiency_share(k_i: Value, eta_i: Value) -> Value:
    """Part of one of several parallel chains in their efficiency."""
    return k_i * eta_i


@formula("driving_torque", "artobolevsky_1988, ch. 14")
def driving_torque_as_motor(M_st: Value, M_dyn: Value, eta: Value) -> Value:
    """Torque of a motor that drives the crank."""
    return (M_st + M_dyn) / eta


@formula("driving_torque", "artobolevsky_1988, ch. 14")
def driving_torque_as_brake(M_st: Value, M_dyn: Value, eta: Value) -> Value:
    """Torque of a motor that the crank drives."""
    return (M_st + M_dyn) * eta
