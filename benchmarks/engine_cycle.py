"""One engine at 72,001 crank angles: crankwork against the same calculation in GNU Octave, in one run.

The largest tangential forces agree to a thousandth: the curves of the script are splines.
Run with `python benchmarks/engine_cycle.py`; needs `octave` (or `octave-cli`) on the path.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import crankwork
from crankwork.analysis import columns, traced_cylinder

HERE = Path(__file__).parent
REPEATS, WANTED = 15, 4


def octave_seconds() -> tuple[float, float]:
    """Return the best processor time of the Octave script [s] and its largest tangential force [MPa]."""
    program = shutil.which("octave-cli") or shutil.which("octave")
    if program is None:
        sys.exit("Octave is not installed: apt-get install octave")
    script = str(HERE / "seed_script.m")
    done = subprocess.run([program, "--quiet", script], capture_output=True, text=True, check=True)  # noqa: S603
    seconds, check = map(float, done.stdout.split())
    return seconds, check


def crankwork_seconds() -> tuple[float, float]:
    """Return the best processor time [s] of all columns from a fresh grid, and the largest tangential force [MPa]."""
    machine = crankwork.read(HERE.parent / "examples" / "spark-engine.toml", ["method.inertia_rod_ratio=0.25"])
    solved = traced_cylinder(machine, machine.method)
    best = np.inf
    for _ in range(REPEATS + 1):
        start = time.process_time()
        state = columns(solved, crankwork.CrankGrid.steps(0.01, 720.0))
        best = min(best, time.process_time() - start)
    return best, float(np.max(state["tangential_force"])) / solved.space.area / 1e6


def ratio() -> float:
    """Print both times and return how many times faster crankwork is."""
    octave, check = octave_seconds()
    ours, largest = crankwork_seconds()
    print(f"Octave     {octave * 1e3:8.2f} ms   T max {check:.4f} MPa")
    print(f"crankwork  {ours * 1e3:8.2f} ms   T max {largest:.4f} MPa")
    print(f"ratio      {octave / ours:8.1f}, wanted {WANTED}; largest forces apart by {abs(largest / check - 1):.1e}")
    return octave / ours


if __name__ == "__main__":
    ratio()
