"""The formula of Chebyshev for the mobility of a planar chain."""

from __future__ import annotations

from crankwork.expressions import Value, formula


@formula("mobility", "artobolevsky_1988, ch. 2")
def chain_mobility(n_i: Value, p_5: Value) -> Value:
    """Degrees of freedom of a planar chain without higher pairs.

    Parameters
    ----------
    n_i, p_5 : float
        Moving links, joints of one freedom. [-]

    Returns
    -------
    float
        Degrees of freedom. [-]
    """
    return 3 * n_i - 2 * p_5
