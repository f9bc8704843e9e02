"""Format of numbers and units in a language."""

from __future__ import annotations

from collections.abc import Sequence

from crankwork.locale import Language, decimal, texts

_RAISED = str.maketrans("0123456789-−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻")


def unit_name(unit: str, language: Language) -> str:
    """Return a unit as that language prints it."""
    return texts("units", language).get(unit, unit)


def number(value: float, language: Language, *, digits: int = 6) -> str:
    """Return a number with up to `digits` significant digits, the language's decimal mark and a true minus sign."""
    text = f"{value + 0.0:.{digits}g}"
    if text in ("-0", "0"):
        return "0"
    mantissa, power, exponent = text.partition("e")
    if power:
        text = f"{mantissa[:-1]}10" if mantissa in ("1", "-1") else f"{mantissa}·10"
        text += str(int(exponent)).translate(_RAISED)
    return decimal(text, language).replace("-", "−")


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return rows of cells as indented lines with aligned columns."""
    width = [max(len(row[index]) for row in rows) for index in range(len(rows[0]))] if rows else []
    return ["  " + "  ".join(cell.ljust(size) for cell, size in zip(row, width, strict=True)).rstrip() for row in rows]
