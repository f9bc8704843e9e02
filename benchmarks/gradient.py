"""Derivatives of single values of a V-two by six fields, beside the values alone: one key, and many.

Run with `python benchmarks/gradient.py`, with Numba or without. Forward, one and seventy keys took 3.3 and 5.7 values;
back they take 3.2 to 3.9 and 1.8. The best processor times of twenty runs in turns are compared.
"""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

import crankwork
from crankwork.description.document import numeric_field
from crankwork.kernel.compiled import Kernel
from crankwork.kinematics.crank_grid import CrankGrid

FILE = Path(__file__).parents[1] / "tests" / "machines" / "v-two.toml"
FIELDS = ("crank.radius", "rod.length", "crank.speed", "piston.mass", "cylinder.bore", "cylinder.compression_ratio")
KEYS = (
    "mean_torque", "piston_force_max", "side_force_min", "tangential_force_max_angle", "flywheel_inertia",
    "total_torque_max", "mean_crankpin_load",
)  # fmt: skip
RUNS, WANTED = 20, 4


def kernel(count: int) -> tuple[Kernel, np.ndarray]:
    """Return a kernel of the first keys, and the design that the file states."""
    description = crankwork.Description(FILE.read_text(encoding="utf-8"))
    numbers = [numeric_field(description.values, key) for key in FIELDS]
    middle = np.array([one.now for one in numbers])
    rows = [middle, *(middle * (1 + sign * 0.02 * one) for one in np.eye(len(FIELDS)) for sign in (-1, 1))]
    memories = []
    for row in rows:
        stated = zip(FIELDS, numbers, row.tolist(), strict=True)
        machine = description.machine([f"{key}={one.written(value)}" for key, one, value in stated])
        memories.append(crankwork.analyse(machine).trace)
    found = Kernel(memories, np.array(rows), KEYS[:count], CrankGrid.from_degrees, cycle=machine.cycle, is_for_few=True)
    return found, middle


def ratio(count: int) -> float:
    """Return how many times as long as the values their derivatives take."""
    of, stated = kernel(count)
    functions = {"value": lambda: of(stated[:, None]), "gradient": lambda: of.slopes(stated)}
    spent: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(RUNS):
        for name, function in functions.items():
            start = time.process_time()
            function()
            spent[name].append(time.process_time() - start)
    return min(spent["gradient"]) / min(spent["value"])


if __name__ == "__main__":
    for count in (1, len(KEYS)):
        print(f"{count} keys by {len(FIELDS)} fields  {ratio(count):6.2f} values, wanted less than {WANTED}")
