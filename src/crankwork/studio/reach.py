"""Results that depend on a number of a machine file."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.errors import CrankworkError
from crankwork.locale import Language
from crankwork.studio.form import form, stated_text

# relative change of the number, and relative difference of equal values
_MOVED = 0.01
_SAME = 1e-7


def dependent_results(results: Results, description: Description, key: str, language: Language) -> dict[str, list[str]]:
    """Return the single values and columns that change with a number.

    `description`: that of the results; it is changed.
    """
    rows = (row for group in form(description, language) for row in group["rows"])
    row = next((row for row in rows if row["key"] == key and "number" in row), None)
    if row is None:
        return {"values": [], "columns": []}
    number = row["number"]
    size = 1 if row.get("whole") else _MOVED * (abs(number) or 1.0)
    try:
        moved = _moved(description, key, f"{number + size:.9g}{row['after']}", language)
    except CrankworkError:
        moved = _moved(description, key, f"{number - size:.9g}{row['after']}", language)
    values = [name for name, value in results.summary.items() if not _same(value, moved.summary.get(name))]
    columns = [name for name, column in results.columns.items() if not _same(column, moved.columns.get(name))]
    return {"values": values, "columns": columns}


def _moved(description: Description, key: str, text: str, language: Language) -> Results:
    description[key] = stated_text(description, key, text, language)
    return analyse(description.machine())


def _same(value: object, other: object) -> bool:
    a, b = np.asarray(value, dtype=float), np.asarray(np.nan if other is None else other, dtype=float)
    return a.shape == b.shape and bool(
        np.allclose(a, b, rtol=_SAME, atol=_SAME * float(np.max(np.abs(a), initial=0.0)), equal_nan=True)
    )
