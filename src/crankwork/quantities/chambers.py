"""Quantities of chambers of gas and of what is sealed in them."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS = (
    Quantity("face_sense", "", "1 where a chamber grows as its face moves along the guide, -1 where it shrinks."),
    Quantity("face_volume", "cm3", "What faces have added to their chamber, from where it is least if that is known."),
    Quantity("cylinder_volume_1", "cm3", "Derivative of `cylinder_volume` by the crank angle in radians."),
    Quantity("gas_mass", "g", "Mass enclosed: from intake closing to exhaust opening, or for good."),
    Quantity("dead_volume", "cm3", "Volume of a part of the gas that no face changes."),
    Quantity("reduced_volume", "cm3/K", "Volume of a part of the gas over its absolute temperature, or their sum."),
)  # fmt: skip
