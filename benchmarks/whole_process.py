"""How long whole processes take, start to files on disk: engines with all figures, notes in every format.

Run with `python benchmarks/whole_process.py`; best of five, warm. Limits are those that users notice: 2 s for a run
with all figures, 3 s for a note as PDF or for Word, 2 s as a web page. Beside each time stands its ratio to the start
of Python with NumPy and matplotlib, which moves with the machine as the rest does.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
ENGINES = ("petrol-four", "v8-diesel", "radial-five", "two-stroke")
NOTES = ("spark-engine", "petrol-four", "press")
LIMITS = {"run": 2.0, "pdf": 3.0, "docx": 3.0, "html": 2.0}
_TIMES = 5


def seconds(*words: str) -> float:
    """Return the shortest time of a command of Python. [s]"""
    variables = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
    variables.pop("PYTHONDONTWRITEBYTECODE", None)
    found = []
    for _ in range(_TIMES):
        started = time.perf_counter()
        subprocess.run([sys.executable, *words], env=variables, check=True, capture_output=True)  # noqa: S603 - our own
        found.append(time.perf_counter() - started)
    return min(found)


def main() -> None:
    """Print every time beside its limit and the ratio to the start of Python."""
    start = seconds("-c", "import numpy, matplotlib.figure")
    print(f"{'Python with NumPy and matplotlib':<36}{start:6.2f} s")
    with tempfile.TemporaryDirectory() as folder:
        jobs = [("run", name, ("run", "-o", f"{folder}/{name}")) for name in ENGINES]
        jobs += [
            (ending, name, ("report", "-o", f"{folder}/{name}.{ending}"))
            for name in NOTES
            for ending in ("pdf", "docx", "html")
        ]
        for kind, name, (command, *words) in jobs:
            example = str(ROOT / "examples" / f"{name}.toml")
            taken = seconds("-m", "crankwork", command, example, *words, "--overwrite")
            print(f"{kind:<5}{name:<31}{taken:6.2f} s, limit {LIMITS[kind]:.0f} s, ratio {taken / start:5.1f}")


if __name__ == "__main__":
    main()
