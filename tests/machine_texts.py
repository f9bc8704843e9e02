"""Machines that tests write down as text."""

from __future__ import annotations

from pathlib import Path

import crankwork


def analysed(text: str, *degrees: float) -> crankwork.Results:
    """Return the results of a machine file, at its own crank angles or at some others."""
    grid = crankwork.CrankGrid.from_degrees(degrees) if degrees else None
    return crankwork.analyse(crankwork.read_machine(text), grid)


# a geared five-bar without masses, and a torque on its second crank
FIVE_BAR = """
fixed_points = { O = ["0 mm", "0 mm"], E = ["180 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "60 mm", speed = "240 rpm" }
geared.second = { pivot = "E", ratio = -2, points = { D = ["45 mm", "0 mm"] } }
links.left = { joins = ["A", "C"], length = "200 mm" }
links.right = { joins = ["D", "C"], length = "210 mm" }
positions.C = ["110 mm", "200 mm"]
loads = [{ kind = "torque", link = "second", torque = ["7 N*m"] }]
"""

# a cylinder of an engine whose diagram is drawn point by point
POINTS_ENGINE = Path(__file__).with_name("machines").joinpath("points-engine.toml").read_text("utf-8")
# stroke of 100 mm
SLIDER_CRANK = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
links.rod = { joins = ["A", "B"], length = "200 mm" }
guides.bed = { angle = "0 deg" }
sliders.ram = { guide = "bed", pin = "B", mass = "2 kg" }
positions.B = ["250 mm", "0 mm"]
"""
