"""Arguments of the formulas of bearing loads."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {}
