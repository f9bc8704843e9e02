"""Everything that a number of a machine file reaches."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description
from crankwork.errors import CrankworkError
from crankwork.locale import Language
from crankwork.studio.form import form, stated_text

# of what a number is, how far it is moved; of what a value is, what does not count as another
_MOVED = 0.01
_SAME = 1e-7


def reached(results: Results, description: Description, key: str, language: Language) -> dict[str, list[str]]:
    """Return the single values and columns that are others where a number is a little larger, or smaller.

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
    values = [one for one, value in results.summary.items() if not _same(value, moved.summary.get(one))]
    columns = [one for one, column in results.columns.items() if not _same(column, moved.columns.get(one))]
    return {"values": values, "columns": columns}


def _moved(description: Description, key: str, text: str, language: Language) -> Results:
    description[key] = stated_text(description, key, text, language)
    return analyse(description.machine())


def _same(one: object, other: object) -> bool:
    a, b = np.asarray(one, dtype=float), np.asarray(np.nan if other is None else other, dtype=float)
    return a.shape == b.shape and bool(
        np.allclose(a, b, rtol=_SAME, atol=_SAME * float(np.max(np.abs(a), initial=0.0)), equal_nan=True)
    )
