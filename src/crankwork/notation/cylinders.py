"""Arguments of the formulas of many cylinders on one shaft."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {}
