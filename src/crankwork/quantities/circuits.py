"""Quantities of circuits: how far a crank gets that does not turn fully, and what it drives."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    Quantity("crank_range", "deg", "Angle of the crank between its dead positions."),
    Quantity("crank_range_start", "deg", "Crank angle of the dead position behind which it moves."),
    Quantity("crank_range_end", "deg", "Crank angle of the dead position up to which it moves."),
    Quantity("link_swing_circuit", "deg", "Difference of the extreme directions of a link on its circuit."),
    Quantity("slider_stroke_circuit", "mm", "Difference of the extreme displacements of a slider on its circuit."),
)
