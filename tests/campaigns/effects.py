"""Changes every value of machines made up at random and compares with what is told: `scripts/campaign effects`."""

from __future__ import annotations

import argparse
import runpy
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from campaigns.forms import drawn
from campaigns.grown import grown_file
from crankwork.errors import CrankworkError
from effects import mistold
from expansions import ROOT, written

plausible_file = runpy.run_path(str(Path(__file__).parents[1] / "doors" / "plausible.py"))["plausible_file"]
# processor time of one machine, those with friction take longer [s]
_LONGEST = 60


def _too_long(*_: object) -> None:
    raise TimeoutError


def _write(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def machine(seed: int, number: int) -> tuple[str, Path]:
    """Return the text of a machine file and the folder of its data; of each three, two are grown from files."""
    if number % 3:
        return grown_file(seed, number)
    other = number // 3
    text = written(drawn(seed, other)) if other % 2 else plausible_file(seed, other).text
    return text, ROOT / "examples"


def main(arguments: Sequence[str] | None = None) -> int:
    """Check machines and return how many are told wrongly."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first machine")
    options = parser.parse_args(arguments)
    signal.signal(signal.SIGPROF, _too_long)
    begun, wrong, checked, left = time.monotonic(), 0, 0, 0
    number = options.first - 1
    while checked < options.count:
        number += 1
        text, folder = machine(options.seed, number)
        signal.setitimer(signal.ITIMER_PROF, _LONGEST)
        try:
            keys = mistold(text, folder)
        except CrankworkError:
            continue
        except TimeoutError:
            left += 1
            continue
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        checked += 1
        if keys:
            wrong += 1
            _write(f"machine {number}: {', '.join(keys)}")
        if not checked % 10:
            _write(f"{checked} machines so far, {wrong} told wrongly, {left} left out as too slow")
    _write(f"{checked} machines, {wrong} told wrongly, {left} left out as too slow, {time.monotonic() - begun:.0f} s")
    return min(wrong, 1)


if __name__ == "__main__":
    sys.exit(main())
