"""Quantities of bearing loads."""

from __future__ import annotations

from crankwork.quantities.quantity import Quantity

ROWS: tuple[Quantity, ...] = ()
