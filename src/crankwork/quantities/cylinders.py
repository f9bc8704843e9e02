"""Quantities of many cylinders on one shaft."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS: tuple[Quantity, ...] = ()
