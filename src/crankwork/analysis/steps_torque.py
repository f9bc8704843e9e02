"""Worked steps of the efficiency of a chain of joints."""

from __future__ import annotations

from crankwork.dynamics.efficiency import Chain, Parallel, Series
from crankwork.dynamics.force_parts import efficiency_share
from crankwork.formula.steps import AnyStep, Given, product_step, sum_step, worked_step


def efficiency_steps(chain: Chain, key: str = "efficiency") -> AnyStep:
    """Return the efficiency of a chain of joints as products of what is in series and sums of what is parallel.

    Parameters
    ----------
    chain : float, Series or Parallel
        Efficiencies of joints. [-]
    key : str
        Key of the value; the parts are `key.1`, `key.2` and so on.

    Examples
    --------
    >>> round(efficiency_steps(Series((0.98, Parallel((0.9, 0.8)), 0.99))).value, 5)
    0.82467
    """
    match chain:
        case Series(parts):
            return product_step(key, [efficiency_steps(part, f"{key}.{i}") for i, part in enumerate(parts, start=1)])
        case Parallel(parts, shares):
            shares = shares or (1 / len(parts),) * len(parts)
            terms: list[AnyStep] = []
            for i, (share, part) in enumerate(zip(shares, parts, strict=True), start=1):
                inner = efficiency_steps(part, f"{key}.{i}.whole")
                terms += [worked_step(efficiency_share, share, inner.value, key=f"{key}.{i}")]
            return sum_step(key, terms)
        case value:
            return Given(key, float(value))
