"""Efficiency of chains of joints, and the driving torque with it."""

from __future__ import annotations

import operator
from functools import reduce

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue, given, total

# Efficiencies of joints through which all power flows, one after the other, from more than 0 to 1; inner ones are of
# joints between which the power divides equally [-]
Chain = tuple[float | tuple[float, ...], ...]


def efficiency(chain: Chain) -> float:
    """Return the efficiency of a chain (artobolevsky_1988, ch. 14). [-]

    Product of efficiencies in series, mean of parallel ones.

    Examples
    --------
    >>> round(efficiency((0.98, (0.9, 0.8), 0.99)), 5)
    0.82467
    """
    return traced_efficiency(chain).value


def traced_efficiency(chain: Chain) -> TracedValue:
    """Return the traced efficiency of a chain; its parts have the keys `efficiency.1`, `efficiency.2` and so on."""
    factors = []
    for index, part in enumerate(chain, start=1):
        key, path = f"efficiency.{index}", f"efficiency.chain[{index}]"
        if isinstance(part, tuple):
            terms = [
                efficiency_share(1 / len(part), given("efficiency", value, f"{path}[{number}]")).named(
                    f"{key}.{number}"
                )
                for number, value in enumerate(part, start=1)
            ]
            factors.append(total(key, terms))
        else:
            factors.append(given(key, part, path))
    return reduce(operator.mul, factors).named("efficiency")


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
