"""Machines that tests write down as text."""

from __future__ import annotations

import crankwork


def analysed(text: str, *degrees: float) -> crankwork.Results:
    """Return the results of a machine file, at its own crank angles or at some others."""
    grid = crankwork.CrankGrid.from_degrees(degrees) if degrees else None
    return crankwork.analyse(crankwork.read_machine(text), grid)
