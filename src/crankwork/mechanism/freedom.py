"""The formula of Chebyshev for the mobility of a planar chain."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("mobility", "artobolevsky_1988, ch. 2")
def chain_mobility(n_i: Value, p_5: Value) -> Value:
    """Degrees of freedom of a planar chain without higher pairs."""
    return 3 * n_i - 2 * p_5
