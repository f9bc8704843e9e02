"""Odd orders of free forces beyond the first, which offset cylinders have, by sums over one turn."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork

pytestmark = pytest.mark.elsewhere
ROOT = Path(__file__).parents[2]
R, L, E, SPEED, MASS = 0.047, 0.151, 0.009, 3100 * math.pi / 30, 0.77 + 1.13 * 43 / 151
THREE = """
format = 2
crank = { radius = "47 mm", speed = "3100 rpm" }
rod = { length = "151 mm", mass = "1.13 kg", centre_of_mass = "43 mm" }
piston.mass = "0.77 kg"
cylinder = { bore = "92 mm", offset = "9 mm" }
engine = { layout = "inline", cylinders = 3, firing_order = [1, 3, 2], strokes = 2, spacing = "110 mm" }
"""


def orders_of(forces: np.ndarray) -> np.ndarray:
    """Return the largest force of each order along one line, from samples of a turn."""
    return 2 * np.abs(np.fft.rfft(forces)) / len(forces)


def inertia_force(angle: np.ndarray) -> np.ndarray:
    """Return mass times acceleration of the piston by the chain rule, written out."""
    sine = (R * np.sin(angle) - E) / L
    cosine, slope = np.sqrt(1 - sine**2), R * np.cos(angle) / L
    turn = slope / cosine
    turn_2 = (-R * np.sin(angle) / L + sine * turn**2) / cosine
    return MASS * SPEED**2 * (-R * np.cos(angle) - L * (cosine * turn**2 + sine * turn_2))


def test_three_offset_cylinders_in_line_leave_the_third_order_free() -> None:
    """The throws stand at 120 degrees: what remains is three times each third order."""
    summary = crankwork.analyse(crankwork.read_machine(THREE)).summary
    angle = np.arange(720) * math.tau / 720
    free = orders_of(sum(inertia_force(angle + lead) for lead in (0.0, math.tau / 3, 2 * math.tau / 3)))
    assert summary["free_force.residual.3"] == pytest.approx(free[3], rel=1e-11) == pytest.approx(117.0265, abs=1e-4)
    assert summary["free_force.residual.6"] == pytest.approx(free[6], rel=1e-9)


def test_a_central_engine_has_no_odd_orders_to_list() -> None:
    found = crankwork.analyse(crankwork.read_machine(THREE.replace(', offset = "9 mm"', "")))
    rows = found.listings["balance"].names
    assert [row for row in rows if row.startswith("reciprocating")] == [f"reciprocating.{one}" for one in (1, 2, 4, 6)]


def test_cylinders_on_both_sides_of_the_crank_leave_a_force_and_a_moment_of_the_third_order() -> None:
    """Direct sums over the cycle, of an independent program."""
    results = crankwork.analyse(crankwork.read(ROOT / "examples/narrow-v6.toml"))
    assert results.summary["free_force.residual.3"] == pytest.approx(83.87, abs=5e-3)
    assert results.summary["free_moment.residual.3"] == pytest.approx(14.71, abs=5e-3)
    assert results.unmet == ()
