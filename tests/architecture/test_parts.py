"""Every test belongs to one of the two parts, that of scripts/test or the rest."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def collected(*options: str) -> list[str]:
    words = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-n", "0", "-p", "no:cacheprovider", *options]
    told = subprocess.run(words, cwd=ROOT, env=os.environ, capture_output=True, text=True, check=True).stdout
    return [line for line in told.splitlines() if "::" in line and " " not in line.partition("[")[0]]


@pytest.mark.slow
def test_the_parts_together_are_all_tests() -> None:
    light, rest, every = collected("--part", "light"), collected("--part", "rest"), collected()
    assert sorted([*light, *rest]) == sorted(every)
    assert len(set(every)) == len(every) > len(light) > len(rest) > 0
