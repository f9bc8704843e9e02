"""Integrals over a working cycle, exact across the corners of the indicator diagram."""

from __future__ import annotations

import itertools

import numpy as np

from crankwork.kinematics.crank_grid import Array

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
# Longest interval that gets one set of eight nodes. [deg]
_WIDTH = 15.0


def quadrature(breaks: Array) -> tuple[Array, Array]:
    """Return Gauss-Legendre nodes and weights between the breaks (press_2007, sec. 4.6).

    Crank angles [deg] and weights [rad]; the sum of weight times integrand is the integral over angle. `breaks`:
    ascending crank angles between which the integrand is smooth [deg].
    """
    edges = np.concatenate([
        np.linspace(start, end, max(1, int(np.ceil((end - start) / _WIDTH))), endpoint=False)
        for start, end in itertools.pairwise(breaks)
    ] + [breaks[-1:]])  # fmt: skip
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    nodes = middle[:, None] + half[:, None] * _NODES
    weights = np.radians(half)[:, None] * _WEIGHTS
    return nodes.ravel(), weights.ravel()
