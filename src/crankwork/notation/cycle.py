"""Arguments of the formulas of the working cycle."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {}
