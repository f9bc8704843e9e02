"""Runs every script of the folder benchmarks, one after the other, and tells which of them were not satisfied.

Peers that are not installed are left out by the scripts themselves; `pip install -e '.[bench]'` brings JAX and
SUNDIALS, `apt-get install g++ libsleef-dev octave` the others.
"""

from __future__ import annotations

import argparse
import subprocess
import sys

from campaigns.marked import ROOT


def main() -> int:
    """Run the benchmarks; 1 if one of them ends with another status than 0."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="scripts, without .py; all otherwise")
    parser.add_argument("--count", type=int, default=1, help="how many times each runs")
    arguments = parser.parse_args()
    every = {one.stem: one for one in sorted((ROOT / "benchmarks").glob("*.py"))}
    if unknown := set(arguments.names) - every.keys():
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; there are {', '.join(every)}")
    scripts = [every[name] for name in arguments.names or every]
    failed = []
    for script in scripts * arguments.count:
        sys.stdout.write(f"== {script.name}\n")
        sys.stdout.flush()
        if subprocess.run([sys.executable, script], cwd=ROOT, check=False).returncode:
            failed.append(script.name)
    sys.stdout.write(f"{len(scripts)} scripts; not satisfied: {', '.join(failed) or 'none'}\n")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
