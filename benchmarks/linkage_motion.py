"""3,600 positions of a four-bar with a slider through second derivatives: closed-form dyads against batched Newton.

Run with `python benchmarks/linkage_motion.py`.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.position_analysis import place
from crankwork.mechanism.catalog import four_bar
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import LinkPoint, Mechanism

GRID = CrankGrid.from_degrees(np.arange(3600) * 0.1)
START = CrankGrid.from_degrees([0.0])


def machine() -> Mechanism:
    """Return a four-bar whose coupler drives a slider."""
    first = four_bar(0.05, 0.2, 0.12, 0.18)
    slider = RRP("tip", "pin", "link", 0.25, guide_point=(0.0, -0.05), block="ram")
    return replace(first, dyads=(*first.dyads, slider), points=(LinkPoint("tip", "coupler", 0.1, 0.03),))


def by_newton(mechanism: Mechanism) -> Mechanism:
    """Return the same mechanism with its dyads as chains, which are solved numerically."""
    frames = place(mechanism, START).links
    return replace(mechanism, dyads=tuple(as_chain(dyad, frames, 0.0) for dyad in mechanism.dyads))


def seconds(work: Callable[[], object], repeats: int) -> float:
    """Return the best time of some repeats. [s]"""
    best = np.inf
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - start)
    return float(best)


def ratio() -> float:
    """Print both times and return how many times faster the dyads are."""
    mechanism = machine()
    newton = by_newton(mechanism)
    closed = seconds(lambda: linkage_motion(mechanism, GRID), 50)
    kernels = seconds(lambda: place(mechanism, GRID), 50)
    solved = seconds(lambda: linkage_motion(newton, GRID), 3)
    print(f"dyads, checked for assembly  {closed * 1e6:10.0f} us")
    print(f"dyads alone                  {kernels * 1e6:10.0f} us")
    print(f"batched Newton               {solved * 1e6:10.0f} us")
    print(f"ratio                        {solved / closed:10.1f}, wanted 20")
    return solved / closed


if __name__ == "__main__":
    ratio()
