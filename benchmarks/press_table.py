"""The printed transfer functions of the press beside those of its geometry, position by position.

Run with `python benchmarks/press_table.py`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import crankwork

EXAMPLES = Path(__file__).parents[1] / "examples"
# heading, body and column of the document's table, key of the geometry's results
COLUMNS = (
    ("v2/w1", "rod", "velocity_ratio", "point_velocity.S2"),
    ("w2/w1", "rod", "rotation_ratio", "link_angular_velocity.rod"),
    ("w5/w1", "rocker", "rotation_ratio", "link_angular_velocity.rocker"),
    ("v4/w1", "punch", "velocity_ratio", "slider_velocity.punch"),
)


def differences() -> np.ndarray:
    """Print both tables with their differences and return these, shape (4, 12)."""
    bodies = {body.name: body for body in crankwork.read(EXAMPLES / "press.toml").bodies}
    results = crankwork.analyse(crankwork.read(EXAMPLES / "press-geometry.toml"))
    speed = results["speed"]
    rows = []
    for heading, body, column, key in COLUMNS:
        printed = np.array(getattr(bodies[body], column))
        computed = np.abs(results[key][:12]) / speed
        rows.append(computed - printed)
        print(heading)
        for name, values in (("printed", printed), ("computed", computed), ("difference", computed - printed)):
            print(f"  {name:<11}" + "".join(f"{value:8.3f}" for value in values))
    found = np.array(rows)
    print(f"root mean square of the differences {np.sqrt(np.mean(found**2)):.4f}")
    return found


if __name__ == "__main__":
    differences()
